#include "defaults.h"
#include "extremes.h"
#include "scoped.h"

#include "core/kiri_vec.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#define MOST_FRAMES 4096
#define MOST_PINS 4096

struct Trial {
    const Extreme* extreme;
    double size, dt;
    int substeps;
    uint32_t seed; /* of what a script varies */
    int tick;
    kiriWorld* world;
    kiriSheet sheet;
    kiriFrame frames[MOST_FRAMES];
    kiriFrameState start[MOST_FRAMES], now[MOST_FRAMES];
    int frameCount, startCount;
    kiriPin pins[MOST_PINS];
    int pinned[MOST_PINS]; /* index of the frame */
    float targets[MOST_PINS][3];
    float pinStiffness;
    int pinCount;
    kiriContact contacts[256];
    int contactCount;
    kiriVec3 gravity;
    bool moved; /* the host moves frames in this tick: energy comes and goes */
    Outcome outcome;
    double lost; /* J: in earlier ticks, and not given back */
};

static double Or(double value, double usual)
{
    return value != 0.0 ? value : usual;
}

static double Share(uint32_t* seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed / 4294967296.0;
}

double Extreme_Calm(const Extreme* extreme)
{
    return Or(extreme->calm, 1e-3);
}
double Extreme_Gain(const Extreme* extreme)
{
    return Or(extreme->gain, 1e-6);
}

/* ---- Talking to the library -------------------------------------------------------------------------------------- */

static void Call(Trial* trial, kiriResult result, const char* name)
{
    if (result != KIRI_OK && trial->outcome.failed == NULL) {
        trial->outcome.failed = name;
    }
}

#define CALL(call) Call(trial, call, #call)

static void ReadFrames(Trial* trial)
{
    int32_t count = 0;
    CALL(kiriSheet_GetFrames(trial->world, trial->sheet, trial->frames, MOST_FRAMES, &count));
    trial->frameCount = count < MOST_FRAMES ? count : MOST_FRAMES;
    for (int i = 0; i < trial->frameCount; ++i) {
        CALL(kiriFrame_GetState(trial->world, trial->frames[i], &trial->now[i]));
    }
}

static void HoldAt(Trial* trial, int frame, kiriVec3 x, kiriMat3 A)
{
    float position[3], rotation[9];
    kiriVec3_Store(position, x);
    kiriVec3_Store(&rotation[0], A.u);
    kiriVec3_Store(&rotation[3], A.v);
    kiriVec3_Store(&rotation[6], A.d);
    CALL(kiriFrame_Hold(trial->world, trial->frames[frame], position, rotation));
    trial->moved = true;
}

static void LetGo(Trial* trial)
{
    for (int i = 0; i < trial->frameCount; ++i) {
        CALL(kiriFrame_Hold(trial->world, trial->frames[i], NULL, NULL));
    }
}

static void PinFrame(Trial* trial, int frame)
{
    kiriPinDef def = DefaultPin();
    memcpy(def.restPoint, trial->now[frame].restPoint, sizeof(def.restPoint));
    memcpy(def.target, trial->now[frame].position, sizeof(def.target));
    def.stiffness = trial->pinStiffness;
    CALL(kiriCreatePin(trial->world, trial->sheet, &def, &trial->pins[trial->pinCount]));
    memcpy(trial->targets[trial->pinCount], def.target, sizeof(def.target));
    trial->pinned[trial->pinCount++] = frame;
}

static void MovePin(Trial* trial, int pin, kiriVec3 target)
{
    kiriVec3_Store(trial->targets[pin], target);
    CALL(kiriPin_SetTarget(trial->world, trial->pins[pin], trial->targets[pin]));
}

static void RemovePins(Trial* trial)
{
    while (trial->pinCount > 0) {
        CALL(kiriDestroyPin(trial->world, trial->pins[--trial->pinCount]));
    }
}

static void SetGravity(Trial* trial, double z)
{
    float gravity[3] = { 0.0f, 0.0f, (float)z };
    trial->gravity = kiriVec3_Load(gravity);
    CALL(kiriWorld_SetGravity(trial->world, gravity));
}

/* From and to in shares of the size. */
static void Cut(Trial* trial, double u0, double v0, double u1, double v1)
{
    const Extreme* e = trial->extreme;
    double s = trial->size;
    float line[4] = { (float)(e->rest + s * u0), (float)(e->rest + s * v0), (float)(e->rest + s * u1),
                      (float)(e->rest + s * v1) };
    kiriCut cut = 0;
    CALL(kiriSheet_Cut(trial->world, trial->sheet, line, 2, &cut));
    trial->moved = true;
}

/* The frame that is nearest to a place, in shares of the size. */
static int Nearest(const Trial* trial, double u, double v)
{
    int best = 0;
    double least = HUGE_VAL;
    for (int i = 0; i < trial->frameCount; ++i) {
        double x = (trial->now[i].restPoint[0] - trial->extreme->rest) / trial->size - u;
        double y = (trial->now[i].restPoint[1] - trial->extreme->rest) / trial->size - v;
        if (x * x + y * y < least) {
            least = x * x + y * y;
            best = i;
        }
    }
    return best;
}

/* ---- Scripts ----------------------------------------------------------------------------------------------------- */

static bool Begins(const Trial* trial)
{
    return trial->tick == 0;
}
static bool Ends(const Trial* trial)
{
    return trial->tick == (int)Or(trial->extreme->cause, 30);
}
static bool Works(const Trial* trial)
{
    return trial->tick < (int)Or(trial->extreme->cause, 30);
}

/* By two corners. */
static void Hang(Trial* trial)
{
    if (Begins(trial)) {
        PinFrame(trial, Nearest(trial, 0.0, 1.0));
        PinFrame(trial, Nearest(trial, 1.0, 1.0));
        SetGravity(trial, -Or(trial->extreme->gravity, 9.81));
    }
    if (Ends(trial)) {
        RemovePins(trial);
        SetGravity(trial, 0.0);
    }
}

static void Fly(Trial* trial)
{
    if (Begins(trial)) {
        SetGravity(trial, -Or(trial->extreme->gravity, 9.81));
    }
}

static void Nothing(Trial* trial)
{
}

static kiriVec3 StartOf(const Trial* trial, int frame)
{
    return kiriVec3_Load(trial->start[frame].position);
}

static kiriVec3 Middle(const Trial* trial)
{
    double half = trial->extreme->rest + 0.5 * trial->size;
    return kiriVec3_Make(trial->extreme->place + half, trial->extreme->place + half, trial->extreme->place);
}

/* Every frame is held where a map of the start takes it; then all are let go. */
static void HoldMapped(Trial* trial, kiriVec3 scale, kiriMat3 A)
{
    for (int i = 0; Works(trial) && i < trial->frameCount; ++i) {
        kiriVec3 off = kiriVec3_Sub(StartOf(trial, i), Middle(trial));
        kiriVec3 to = kiriVec3_Make(scale.x * off.x, scale.y * off.y, scale.z * off.z);
        HoldAt(trial, i, kiriVec3_Add(Middle(trial), to), A);
    }
    if (Ends(trial)) {
        LetGo(trial);
    }
}

static kiriMat3 Axes(double u, double v)
{
    return (kiriMat3){ { u, 0.0, 0.0 }, { 0.0, v, 0.0 }, { 0.0, 0.0, u * v } };
}

/* Something that is done to a sheet in each tick, in one line. */
#define ACT(name, what)                                                                                                \
    static void name(Trial* trial)                                                                                     \
    {                                                                                                                  \
        what;                                                                                                          \
    }

ACT(Stretch, HoldMapped(trial, kiriVec3_Make(10.0, 10.0, 1.0), Axes(1.0, 1.0)))
ACT(Line, HoldMapped(trial, kiriVec3_Make(1.0, 0.0, 1.0), Axes(1.0, 1.0)))
ACT(Point, HoldMapped(trial, kiriVec3_Make(0.0, 0.0, 0.0), Axes(1.0, 1.0)))

/* The places are mirrored, and the frames stand as they stood, or turned by pi about their normal, their u, or their v
   (that one is a rigid motion of the whole). */
ACT(Mirror, HoldMapped(trial, kiriVec3_Make(-1.0, 1.0, 1.0), Axes(1.0, 1.0)))
ACT(MirrorSpun, HoldMapped(trial, kiriVec3_Make(-1.0, 1.0, 1.0), Axes(-1.0, -1.0)))
ACT(MirrorAboutU, HoldMapped(trial, kiriVec3_Make(-1.0, 1.0, 1.0), Axes(1.0, -1.0)))
ACT(MirrorAboutV, HoldMapped(trial, kiriVec3_Make(-1.0, 1.0, 1.0), Axes(-1.0, 1.0)))

/* Every second frame is turned. */
static void HoldTurned(Trial* trial, kiriMat3 A)
{
    for (int i = 0; Works(trial) && i < trial->frameCount; ++i) {
        HoldAt(trial, i, StartOf(trial, i), i % 2 == 0 ? A : Axes(1.0, 1.0));
    }
    if (Ends(trial)) {
        LetGo(trial);
    }
}

/* By pi, but for a milliradian: exactly by pi is an equilibrium, from which nothing has to recover. */
static kiriMat3 HalfTurn(double u, double v)
{
    return kiriMat3_MulMat(kiriMat3_Cayley(kiriVec3_Make(1e-3, 1e-3, 1e-3)), Axes(u, v));
}

ACT(TurnAboutN, HoldTurned(trial, HalfTurn(-1.0, -1.0)))
ACT(TurnAboutU, HoldTurned(trial, HalfTurn(1.0, -1.0)))
ACT(TurnAboutV, HoldTurned(trial, HalfTurn(-1.0, 1.0)))
ACT(TurnExactly, HoldTurned(trial, Axes(1.0, -1.0)))

/* At the same place, and turned at random: for all that the library knows, crumpled. */
static void Crumple(Trial* trial)
{
    uint32_t seed = 2463534242u;
    for (int i = 0; Works(trial) && i < trial->frameCount; ++i) {
        double x = 8.0 * Share(&seed) - 4.0, y = 8.0 * Share(&seed) - 4.0, z = 8.0 * Share(&seed) - 4.0;
        HoldAt(trial, i, Middle(trial), kiriMat3_Cayley(kiriVec3_Make(x, y, z)));
    }
    if (Ends(trial)) {
        LetGo(trial);
    }
}

/* All held, and carried about in circles. */
static void HoldAll(Trial* trial)
{
    kiriMat3 turn = kiriMat3_Cayley(kiriVec3_Make(0.0, 0.0, 0.1 * trial->tick));
    for (int i = 0; Works(trial) && i < trial->frameCount; ++i) {
        kiriVec3 off = kiriVec3_Sub(StartOf(trial, i), Middle(trial));
        HoldAt(trial, i, kiriVec3_Add(Middle(trial), kiriMat3_Mul(turn, off)), turn);
    }
    if (Ends(trial)) {
        LetGo(trial);
    }
}

/* All pinned, and the pins pull them ten sizes apart. */
static void PinAll(Trial* trial)
{
    for (int i = 0; Begins(trial) && i < trial->frameCount; ++i) {
        PinFrame(trial, i);
        kiriVec3 off = kiriVec3_Sub(StartOf(trial, i), Middle(trial));
        MovePin(trial, i, kiriVec3_AddScaled(Middle(trial), 10.0, off));
    }
    if (Ends(trial)) {
        RemovePins(trial);
    }
}

/* A pin that moves goes evenly from substep to substep, and what it gives depends on where the sheet is in between:
   only with one substep is its work known from outside. */
static void Teleport(Trial* trial)
{
    if (Begins(trial)) {
        PinFrame(trial, Nearest(trial, 0.0, 1.0));
    }
    if (trial->tick == 5) {
        MovePin(trial, 0, kiriVec3_Make(100.0 * trial->size, 0.0, 0.0));
        trial->moved = trial->substeps > 1;
    }
    if (trial->tick == 10) {
        MovePin(trial, 0, StartOf(trial, trial->pinned[0]));
        trial->moved = trial->substeps > 1;
    }
}

/* The floor is in the middle of a tilted sheet: contacts push half of it out. */
static void Floor(Trial* trial)
{
    const float* points = NULL;
    int32_t count = 0;
    CALL(kiriSheet_GetCollisionPoints(trial->world, trial->sheet, &points, &count));
    trial->contactCount = 0;
    for (int32_t i = 0; Works(trial) && i < count && i < 256; ++i) {
        kiriContact contact = {
            .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = (float)(0.01 * trial->size), .friction = 0.5f
        };
        trial->contacts[trial->contactCount++] = contact;
    }
    CALL(kiriSheet_SetContacts(trial->world, trial->sheet, trial->contacts, trial->contactCount));
    if (Begins(trial)) {
        SetGravity(trial, -9.81);
    }
    if (Ends(trial)) {
        SetGravity(trial, 0.0);
    }
}

/* Forces and torques of one short tick start a spin of 1e4 rad/s. */
static void Spin(Trial* trial)
{
    trial->dt = Begins(trial) ? 1e-6 : Or(trial->extreme->dt, 1.0 / 60.0);
    for (int i = 0; Begins(trial) && i < trial->frameCount; ++i) {
        kiriVec3 off = kiriVec3_Sub(StartOf(trial, i), Middle(trial)), w = kiriVec3_Make(0.0, 0.0, 1e4);
        float force[3], torque[3];
        kiriVec3_Store(force, kiriVec3_Scale(trial->now[i].mass / trial->dt, kiriVec3_Cross(w, off)));
        kiriVec3_Store(torque, kiriVec3_Scale(trial->now[i].mass * trial->now[i].area / 6.0 / trial->dt, w));
        CALL(kiriFrame_ApplyForce(trial->world, trial->frames[i], force, torque));
        trial->moved = true;
    }
}

/* Pinned at a corner; torques a thousand times as large as would turn a free frame by one radian in a tick. */
static void Twist(Trial* trial)
{
    for (int i = 0; Works(trial) && i < trial->frameCount; ++i) {
        const kiriFrameState* f = &trial->now[i];
        double size = 1e3 * (double)f->mass * (double)f->area / 6.0 / (trial->dt * trial->dt);
        float none[3] = { 0.0f, 0.0f, 0.0f }, torque[3];
        kiriVec3_Store(torque, kiriVec3_Scale(size, kiriVec3_Make(i % 3 - 1, i % 2, (i + 1) % 3 - 1)));
        CALL(kiriFrame_ApplyForce(trial->world, trial->frames[i], none, torque));
        trial->moved = true;
    }
    if (Begins(trial)) {
        PinFrame(trial, Nearest(trial, 0.0, 1.0));
    }
    if (Ends(trial)) {
        RemovePins(trial);
    }
}

/* It hangs, and every tick is of another length, up to 8 times, with 1 to 4 substeps. */
static void HangUnevenly(Trial* trial)
{
    double dt = Or(trial->extreme->dt, 1.0 / 60.0) * pow(8.0, Share(&trial->seed) - 0.5);
    trial->dt = fmin(fmax(dt, 1e-6), 10.0);
    trial->substeps = 1 + (int)(4.0 * Share(&trial->seed));
    Hang(trial);
}

static void ThenHang(Trial* trial)
{
    --trial->tick;
    Hang(trial);
    ++trial->tick;
}

/* Twenty strips, a millionth of the size wide. */
static void Slivers(Trial* trial)
{
    for (int i = 0; Begins(trial) && i < 20; ++i) {
        Cut(trial, -0.1, 0.3 + 1e-6 * i, 1.1, 0.3 + 1e-6 * i);
    }
    ThenHang(trial);
}

/* The lower half hangs by a bridge, a millionth of the size wide. */
static void Neck(Trial* trial)
{
    if (Begins(trial)) {
        Cut(trial, -0.1, 0.51, 0.53, 0.51);
        Cut(trial, 1.1, 0.51, 0.53 + 1e-6, 0.51);
    }
    ThenHang(trial);
}

/* Three bridges below each other. */
static void Thread(Trial* trial)
{
    for (int i = 0; Begins(trial) && i < 3; ++i) {
        Cut(trial, -0.1, 0.3 + 0.15 * i, 0.43, 0.3 + 0.15 * i);
        Cut(trial, 1.1, 0.3 + 0.15 * i, 0.43 + 1e-6, 0.3 + 0.15 * i);
    }
    ThenHang(trial);
}

static void Star(Trial* trial)
{
    for (int i = 0; Begins(trial) && i < 32; ++i) {
        kiriMat3 turn = kiriMat3_Cayley(kiriVec3_Make(0.0, 0.0, 0.1 * i));
        Cut(trial, 0.47 - 0.4 * turn.u.x, 0.47 - 0.4 * turn.u.y, 0.47 + 0.4 * turn.u.x, 0.47 + 0.4 * turn.u.y);
    }
    ThenHang(trial);
}

/* 23 by 22 pieces. */
static void Confetti(Trial* trial)
{
    for (int i = 1; Begins(trial) && i < 23; ++i) {
        Cut(trial, i / 23.0, -0.1, i / 23.0, 1.1);
    }
    for (int i = 1; Begins(trial) && i < 22; ++i) {
        Cut(trial, -0.1, i / 22.0, 1.1, i / 22.0);
    }
    ThenHang(trial);
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

const Extreme extremes[] = {
    { .name = "plain", .script = Hang, .ticks = 900 },
    { .name = "h/L 0.1", .script = Hang, .thinness = 0.1 },
    { .name = "h/L 1e-2", .script = Hang, .thinness = 1e-2 },
    { .name = "h/L 1e-4", .script = Hang, .thinness = 1e-4, .ticks = 900 },
    { .name = "h/L 1e-5", .script = Hang, .thinness = 1e-5, .calm = 2e-2 },
    { .name = "h/L 1e-6", .script = Hang, .thinness = 1e-6, .calm = 2e-2 },
    { .name = "E 1e2", .script = Hang, .modulus = 1e2, .calm = 2e-2 },
    { .name = "E 1e5", .script = Hang, .modulus = 1e5 },
    { .name = "E 1e7", .script = Hang, .modulus = 1e7, .calm = 2e-2 },
    { .name = "E 1e11", .script = Hang, .modulus = 1e11 },
    { .name = "E 1e13", .script = Hang, .modulus = 1e13 },
    { .name = "density 1e-6", .script = Hang, .density = 1e-6 },
    { .name = "density 1e-3", .script = Hang, .density = 1e-3 },
    { .name = "density 1", .script = Hang, .density = 1.0 },
    { .name = "density 1e6", .script = Hang, .density = 1e6, .calm = 2e-2 },
    { .name = "E 1e13, density 1e-6", .script = Hang, .size = 0.05, .modulus = 1e13, .density = 1e-6 },
    { .name = "dt 1e-6", .script = Hang, .dt = 1e-6, .cause = 300, .calm = 1.0 },
    { .name = "dt 1e-4", .script = Hang, .dt = 1e-4, .cause = 3000, .ticks = 90000, .calm = 2e-2, .full = true },
    { .name = "dt 0.1", .script = Hang, .dt = 0.1 },
    { .name = "dt 1", .script = Hang, .dt = 1.0 },
    { .name = "dt 10", .script = Hang, .dt = 10.0 },
    { .name = "dt varies", .script = HangUnevenly, .ticks = 900 },
    { .name = "dt varies by 0.1", .script = HangUnevenly, .dt = 0.1 },
    { .name = "dt varies, E 1e5", .script = HangUnevenly, .modulus = 1e5, .ticks = 900 },
    { .name = "gravity 1e2", .script = Hang, .gravity = 1e2 },
    { .name = "gravity 1e3", .script = Hang, .gravity = 1e3 },
    { .name = "gravity 1e5", .script = Hang, .gravity = 1e5 },
    { .name = "prediction at 1e5 g", .script = Fly, .gravity = 1e5, .ticks = 60, .calm = 1.0 },
    { .name = "size 1e-4", .script = Hang, .size = 1e-4 },
    { .name = "size 1e4", .script = Hang, .size = 1e4, .dt = 0.5, .ticks = 1200, .calm = 5e-2 },
    { .name = "rest at 1e5", .script = Hang, .rest = 1e5, .ticks = 900 },
    { .name = "world at 1e5", .script = Hang, .place = 1e5, .ticks = 900 },
    { .name = "both at 1e5", .script = Hang, .rest = 1e5, .place = 1e5, .ticks = 900 },
    { .name = "speed 1e4", .script = Hang, .speed = 1e4 },
    { .name = "prediction at 1e4", .script = Nothing, .speed = 1e4, .calm = 1.0 },
    { .name = "spin 1e4", .script = Spin, .cause = 1, .ticks = 900 },
    { .name = "spin 1e4, E 1e13", .script = Spin, .cause = 1, .ticks = 900, .modulus = 1e13 },
    { .name = "torques 1e3", .script = Twist },
    { .name = "torques 1e3, E 1e13", .script = Twist, .modulus = 1e13 },
    { .name = "torques 1e3, dt 1e-4", .script = Twist, .dt = 1e-4, .ticks = 300, .calm = 1.0 },
    { .name = "torques, one frame", .script = Twist, .frames = 1 },
    { .name = "stretched x 10", .script = Stretch, .cause = 3 },
    { .name = "crushed: line", .script = Line, .cause = 3 },
    { .name = "crushed: point", .script = Point, .cause = 3 },
    { .name = "crumpled", .script = Crumple, .cause = 3 },
    { .name = "crumpled, 64", .script = Crumple, .cause = 3, .frames = 64, .full = true },
    { .name = "mirrored", .script = Mirror, .cause = 3 },
    { .name = "mirrored, pi n", .script = MirrorSpun, .cause = 3 },
    { .name = "mirrored, pi u", .script = MirrorAboutU, .cause = 3 },
    { .name = "mirrored, pi v", .script = MirrorAboutV, .cause = 3 },
    { .name = "turned by pi: n", .script = TurnAboutN, .cause = 3 },
    { .name = "turned by pi: u", .script = TurnAboutU, .cause = 3 },
    { .name = "turned by pi: v", .script = TurnAboutV, .cause = 3 },
    { .name = "turned by pi, exactly", .script = TurnExactly, .cause = 3, .calm = 1.0 },
    { .name = "one frame", .script = Hang, .frames = 1 },
    { .name = "one frame, spun", .script = Spin, .frames = 1, .cause = 1 },
    { .name = "2000 frames",
      .script = Hang,
      .frames = 2000,
      .grid = 64,
      .cause = 10,
      .ticks = 40,
      .calm = 1.0,
      .full = true },
    { .name = "a frame two cells", .script = Hang, .frames = 128, .ticks = 1200, .full = true },
    { .name = "a frame two cells, point", .script = Point, .frames = 32, .grid = 8, .cause = 3, .full = true },
    { .name = "all held", .script = HoldAll },
    { .name = "all pinned", .script = PinAll },
    { .name = "pin teleports", .script = Teleport, .cause = 10 },
    { .name = "contacts 1e9", .script = Floor },
    { .name = "slivers 1e-6", .script = Slivers, .resample = true },
    { .name = "neck 1e-6", .script = Neck, .resample = true, .ticks = 1200 },
    { .name = "three necks", .script = Thread, .resample = true, .ticks = 1200 },
    { .name = "32 cuts, one point", .script = Star, .grid = 32 },
    { .name = "506 confetti", .script = Confetti, .grid = 64, .ticks = 60, .full = true },
};
const int extremeCount = sizeof(extremes) / sizeof(extremes[0]);

/* ---- Making a trial ---------------------------------------------------------------------------------------------- */

static kiriSheetDef DefOf(const Extreme* e, bool damped)
{
    kiriSheetDef def = DefaultSheet();
    def.sleepSpeed = 0.0f;
    double size = Or(e->size, 1.0);
    kiriMaterial material = { (float)Or(e->modulus, 1e9),
                              0.3f,
                              (float)(size * Or(e->thinness, 1e-3)),
                              (float)Or(e->density, 700.0),
                              damped ? 0.5f : 0.0f,
                              damped ? 2e-3f : 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.material = material;
    def.frameCount = (int32_t)Or(e->frames, 9);
    def.maxFrames = MOST_FRAMES;
    def.rigidWeight = e->resample ? 0.95f : 2.0f;
    def.gridResolution = (int32_t)Or(e->grid, 16);
    def.snapDistance = (float)(1e-8 * size);
    def.collisionPoints = 30;
    def.iterations = (int32_t)Or(e->iterations, 2);
    for (int k = 0; k < 3; ++k) {
        def.position[k] = (float)e->place;
        def.velocity[k] = (float)(e->speed / 1.7320508);
    }
    return def;
}

static void Start(Trial* trial, const Extreme* e, bool damped)
{
    enum { SIDE = 12 };
    static float positions[2 * (SIDE + 1) * (SIDE + 1)];
    static int32_t indices[6 * SIDE * SIDE];
    memset(trial, 0, sizeof(*trial));
    trial->extreme = e;
    trial->size = Or(e->size, 1.0);
    trial->dt = Or(e->dt, 1.0 / 60.0);
    trial->substeps = e->substeps > 0 ? e->substeps : 1;
    trial->seed = 19650218u;
    trial->outcome.finite = true;
    trial->outcome.recovered = -1;
    kiriWorldDef worldDef = DefaultWorld();
    CALL(kiriCreateWorld(&worldDef, &trial->world));
    SetGravity(trial, 0.0);
    kiriSheetDef def = DefOf(e, damped);
    trial->pinStiffness = 10.0f * def.material.youngsModulus * def.material.thickness;
    CALL(kiriFillRectangle((float)trial->size, (float)trial->size, SIDE, SIDE, positions, indices));
    for (int i = 0; i < 2 * (SIDE + 1) * (SIDE + 1); ++i) {
        positions[i] += (float)e->rest;
    }
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = (SIDE + 1) * (SIDE + 1);
    def.triangleCount = 2 * SIDE * SIDE;
    CALL(kiriCreateSheet(trial->world, &def, &trial->sheet));
    ReadFrames(trial);
    memcpy(trial->start, trial->now, sizeof(trial->start));
    trial->startCount = trial->frameCount;
}

/* ---- Measuring --------------------------------------------------------------------------------------------------- */

static bool AreFinite(const float* values, int count)
{
    for (int i = 0; i < count; ++i) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

static bool IsFinite(Trial* trial, const kiriTotals* t)
{
    kiriMesh mesh;
    const float* points = NULL;
    int32_t count = 0;
    CALL(kiriSheet_GetMesh(trial->world, trial->sheet, &mesh));
    CALL(kiriSheet_GetCollisionPoints(trial->world, trial->sheet, &points, &count));
    bool finite = AreFinite(mesh.positions, 3 * mesh.vertexCount) && AreFinite(mesh.normals, 3 * mesh.vertexCount) &&
                  AreFinite(points, 3 * count) && isfinite(t->kineticEnergy) && isfinite(t->elasticEnergy);
    for (int k = 0; k < 3; ++k) {
        finite = finite && isfinite(t->center[k]) && isfinite(t->momentum[k]) && isfinite(t->angularMomentum[k]);
    }
    for (int i = 0; i < trial->frameCount; ++i) {
        const kiriFrameState* f = &trial->now[i];
        finite = finite && AreFinite(f->position, 3) && AreFinite(f->rotation, 9) && AreFinite(f->velocity, 3) &&
                 AreFinite(f->angularVelocity, 3);
    }
    return finite;
}

/* Energy of the pins, and how much of it float positions leave unknown. */
static double PinEnergy(const Trial* trial, double* unknown)
{
    double sum = 0.0;
    for (int i = 0; i < trial->pinCount; ++i) {
        kiriVec3 x = kiriVec3_Load(trial->now[trial->pinned[i]].position), target = kiriVec3_Load(trial->targets[i]);
        double off = kiriVec3_Length(kiriVec3_Sub(x, target)), k = trial->pinStiffness;
        double rounding = FLT_EPSILON * kiriVec3_Length(x);
        sum += 0.5 * k * off * off;
        *unknown += k * rounding * (off + rounding);
    }
    return sum;
}

/* Rms distance from the rigid placement that fits best, over the size. */
static double ShapeError(const Trial* trial)
{
    kiriVec3 center = { 0.0, 0.0, 0.0 }, rest = center;
    int count = trial->frameCount;
    for (int i = 0; i < count; ++i) {
        const kiriFrameState* f = &trial->now[i];
        center = kiriVec3_AddScaled(center, 1.0 / count, kiriVec3_Load(f->position));
        rest = kiriVec3_AddScaled(rest, 1.0 / count, kiriVec3_Make(f->restPoint[0], f->restPoint[1], 0.0));
    }
    kiriMat3 sum = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
    for (int i = 0; i < count; ++i) {
        const kiriFrameState* f = &trial->now[i];
        kiriVec3 off = kiriVec3_Sub(kiriVec3_Load(f->position), center);
        sum.u = kiriVec3_AddScaled(sum.u, f->restPoint[0] - rest.x, off);
        sum.v = kiriVec3_AddScaled(sum.v, f->restPoint[1] - rest.y, off);
    }
    sum.d = kiriVec3_Normalize(kiriVec3_Cross(sum.u, sum.v));
    sum.d = kiriVec3_Scale(kiriVec3_Length(sum.u) + kiriVec3_Length(sum.v), sum.d);
    kiriMat3 R = kiriMat3_Rotation(sum);
    double squares = 0.0;
    for (int i = 0; i < count; ++i) {
        const kiriFrameState* f = &trial->now[i];
        kiriVec3 to = kiriVec3_AddScaled(kiriVec3_AddScaled(center, f->restPoint[0] - rest.x, R.u),
                                         f->restPoint[1] - rest.y, R.v);
        kiriVec3 off = kiriVec3_Sub(kiriVec3_Load(f->position), to);
        squares += kiriVec3_Dot(off, off);
    }
    return sqrt(squares / count) / trial->size;
}

static double GravityEnergy(const Trial* trial, const kiriTotals* t)
{
    return -t->mass * kiriVec3_Dot(trial->gravity, kiriVec3_Make(t->center[0], t->center[1], t->center[2]));
}

/* Positions are kept as doubles: so well known are velocities, strains and the work of gravity. And the solver looks
   for the least of a sum in which the way that gravity would take a free sheet in a step counts: 1e-12 of that is
   nothing. */
static double RoundingEnergy(const Trial* trial, const kiriTotals* t)
{
    const Extreme* e = trial->extreme;
    double far = 0.0, tension = Or(e->modulus, 1e9) * Or(e->thinness, 1e-3) * trial->size;
    for (int i = 0; i < trial->frameCount; ++i) {
        far = fmax(far, kiriVec3_Length(kiriVec3_Load(trial->now[i].position)));
    }
    double off = 8.0 * DBL_EPSILON * far, speed = off / trial->dt, fall = trial->dt * kiriVec3_Length(trial->gravity);
    return sqrt(2.0 * t->mass * t->kineticEnergy) * speed + t->mass * speed * speed +
           trial->frameCount * (sqrt(2.0 * tension * t->elasticEnergy) * off + tension * off * off) +
           4.0 * DBL_EPSILON * fabs(GravityEnergy(trial, t)) + 1e-12 * t->mass * fall * fall;
}

/* J: what the floor may have done in the tick: it pushes what is inside out, at 1 m/s at most. */
static double PushEnergy(Trial* trial)
{
    const kiriContactForce* forces = NULL;
    int32_t count = 0;
    double sum = 0.0;
    CALL(kiriSheet_GetContactForces(trial->world, trial->sheet, &forces, &count));
    for (int32_t i = 0; i < count; ++i) {
        sum += forces[i].impulse[2];
    }
    return sum;
}

/* ---- Running ----------------------------------------------------------------------------------------------------- */

static void TickAndCompare(Trial* trial, kiriTotals* after, double* peak)
{
    Outcome* outcome = &trial->outcome;
    kiriTotals before;
    double unknown = 0.0;
    CALL(kiriSheet_GetTotals(trial->world, trial->sheet, &before));
    double had = before.kineticEnergy + before.elasticEnergy + PinEnergy(trial, &unknown);
    *peak = fmax(*peak, had);
    CALL(kiriWorld_Tick(trial->world, (float)trial->dt, trial->substeps));
    CALL(kiriSheet_GetTotals(trial->world, trial->sheet, after));
    ReadFrames(trial);
    had += PushEnergy(trial);
    double has = after->kineticEnergy + after->elasticEnergy + PinEnergy(trial, &unknown);
    double work = GravityEnergy(trial, &before) - GravityEnergy(trial, after);
    unknown += RoundingEnergy(trial, &before) + RoundingEnergy(trial, after);
    /* Steps of second order may give energy back that they took, up to 2 % of the kinetic energy. */
    double credit = fmin(trial->lost, 0.02 * fmax(before.kineticEnergy, after->kineticEnergy));
    double gain = has - had - work - unknown - credit;
    trial->lost = fmax(-gain, 0.0);
    gain /= had + fabs(work) + 1e-9 * *peak + DBL_MIN;
    if (!trial->moved && gain > outcome->gain) {
        outcome->gain = gain;
        outcome->gainTick = trial->tick;
    }
    outcome->finite = outcome->finite && IsFinite(trial, after);
    double far = 0.0;
    for (int i = 0; i < trial->frameCount; ++i) {
        far = fmax(far, kiriVec3_Length(kiriVec3_Load(trial->now[i].position)));
    }
    outcome->spacing = fmax(outcome->spacing, FLT_EPSILON * far / trial->size);
    kiriProfile profile;
    CALL(kiriWorld_GetProfile(trial->world, &profile));
    outcome->solved = profile.systemsSolved > outcome->solved ? profile.systemsSolved : outcome->solved;
}

static bool IsFine(const Outcome* outcome)
{
    return outcome->failed == NULL && outcome->finite;
}

static Outcome RunOnce(const Extreme* e, bool damped)
{
    FREED(Trial, trial) = malloc(sizeof(*trial));
    Start(trial, e, damped);
    int ticks = (int)Or(e->ticks, 600), cause = (int)Or(e->cause, 30);
    double largest = 0.0, peak = 0.0, size = trial->size;
    double floor = 0.5 * Or(e->modulus, 1e9) * Or(e->thinness, 1e-3) * size * size * size * FLT_EPSILON * FLT_EPSILON;
    kiriTotals totals;
    for (trial->tick = 0; trial->tick < ticks && IsFine(&trial->outcome); ++trial->tick) {
        trial->moved = false;
        e->script(trial);
        TickAndCompare(trial, &totals, &peak);
        largest = fmax(largest, totals.elasticEnergy);
        /* Positions are known to a float: what strains of that size store is rest. */
        bool calm = totals.elasticEnergy <= Extreme_Calm(e) * largest + floor;
        if (!calm) {
            trial->outcome.recovered = -1;
        } else if (trial->tick >= cause && trial->outcome.recovered < 0) {
            trial->outcome.recovered = trial->tick - cause;
        }
    }
    trial->outcome.elastic = largest > 0.0 ? totals.elasticEnergy / largest : 0.0;
    kiriCounts counts;
    CALL(kiriSheet_GetCounts(trial->world, trial->sheet, &counts));
    trial->outcome.shape = counts.pieces == 1 ? ShapeError(trial) : -1.0;
    trial->outcome.frames = trial->frameCount;
    kiriDestroyWorld(trial->world);
    Outcome outcome = trial->outcome;
    return outcome;
}

Outcome Extreme_Run(const Extreme* extreme)
{
    Outcome free = RunOnce(extreme, false), damped = RunOnce(extreme, true);
    Outcome both = damped;
    both.finite = free.finite && damped.finite;
    both.failed = free.failed != NULL ? free.failed : damped.failed;
    both.gain = free.gain;
    both.gainTick = free.gainTick;
    if (damped.gain > free.gain) {
        both.gain = damped.gain;
        both.gainTick = damped.gainTick;
    }
    both.spacing = fmax(free.spacing, damped.spacing);
    both.solved = free.solved > damped.solved ? free.solved : damped.solved;
    return both;
}

/* ---- At random --------------------------------------------------------------------------------------------------- */

/* Sometimes, a value of any size within decades. */
static void Vary(uint32_t* seed, double chance, double low, double high, double* value)
{
    double share = Share(seed), exponent = low + (high - low) * Share(seed);
    if (share < chance) {
        *value = pow(10.0, exponent);
    }
}

Extreme Extreme_Random(uint32_t* seed)
{
    Extreme e = extremes[0];
    do {
        e = extremes[(int)(Share(seed) * extremeCount)];
    } while (e.full || e.rest > 0.0);
    Vary(seed, 0.7, -6.0, -1.0, &e.thinness);
    Vary(seed, 0.7, 2.0, 13.0, &e.modulus);
    Vary(seed, 0.7, -6.0, 6.0, &e.density);
    Vary(seed, 0.5, -6.0, 1.0, &e.dt);
    Vary(seed, 0.3, 0.0, 5.0, &e.gravity);
    Vary(seed, 0.5, -4.0, 4.0, &e.size);
    Vary(seed, 0.3, 0.0, 4.0, &e.speed);
    Vary(seed, 0.2, 0.0, 5.0, &e.place);
    /* Farther out floats would not tell the ends of the sheet apart. */
    e.place = fmin(e.place, Or(e.size, 1.0) / (double)FLT_EPSILON);
    e.frames = e.frames > 0 ? e.frames : 1 + (int)(30.0 * Share(seed));
    e.iterations = 1 + (int)(4.0 * Share(seed));
    e.substeps = 1 + (int)(2.0 * Share(seed));
    e.ticks = 100;
    e.calm = 1.0;
    e.gain = 1e-5;
    e.name = "random";
    return e;
}
