/* Swipes of a blade over a curtain part it at any speed, whether the curtain is still or sways, and leave no crumbs: no
   pieces below a square of the snap distance. A blade that is held still, saws or chops leaves none.

   test_swipe [RUNS [FIRST [TEST [SECONDS]]]]    RUNS runs of each kind, the first with seed FIRST; a blade is held for
   SECONDS s */
#include "host.h"

#include <stdio.h>

#define PI 3.14159265358979323846

static int32_t runCount = 0, firstSeed = 1, heldSeconds = RUNS(10);

/* ---- The curtain ------------------------------------------------------------------------------------------------- */

enum { STILL, SWAYS, BLOWN, MOTIONS };
static const double dt = 1.0 / 60.0;

typedef struct Curtain {
    Host host;
    kiriSheet sheet;
    kiriBlade blade;
    int32_t motion, tick;
    uint32_t seed;
    double snap;
} Curtain;

static double Uniform(Curtain* curtain, double low, double high)
{
    return RandomBetween(&curtain->seed, low, high);
}

static void Tick(Curtain* curtain)
{
    if (curtain->motion == BLOWN) {
        const float gust = (float)(sin(0.05 * curtain->tick) + 0.5 * sin(0.17 * curtain->tick));
        const kiriWind wind = { { 0.3f * gust, gust, 0.0f }, 1.2f, 1.0f, 0.0f };
        OK(kiriSheet_SetWind(curtain->host.world, curtain->sheet, &wind));
    }
    kiriResult result = Host_Tick(&curtain->host, (float)dt, 2);
    assert_true(result >= 0);
    ++curtain->tick;
}

/* In the plane of x and z, 1 m wide and high, pinned along its upper border. A still one has no weight. */
static void Start(Curtain* curtain, int32_t motion, uint32_t seed)
{
    static const int32_t squares[4] = { 16, 24, 32, 40 };
    memset(curtain, 0, sizeof(*curtain));
    curtain->seed = 2654435761u * seed + 77u;
    curtain->motion = motion;
    curtain->snap = 1e-4;
    Random(&curtain->seed);
    Host_Start(&curtain->host);
    curtain->host.every = 1000;
    if (motion == STILL) {
        World_StopGravity(curtain->host.world);
    }
    kiriSheetDef def = DefaultSheet();
    int32_t grid = squares[(Random(&curtain->seed) >> 8) % 4];
    def.gridResolution = grid;
    def.frameCount = 9;
    def.collisionPoints = 0;
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    curtain->sheet = Host_AddRectangle(&curtain->host, &def, 1.0f, 1.0f, grid, grid);
    for (int k = 0; k < 2; ++k) {
        Host_Pin(&curtain->host, curtain->sheet, (float)k, 1.0f, (float)k, 0.0f, 1.0f);
    }
    if (motion == SWAYS) {
        const float push[3] = { (float)Uniform(curtain, -0.05, 0.05), (float)Uniform(curtain, -0.3, 0.3), 0.0f };
        kiriFrame frames[64];
        int32_t count = World_GetFrames(curtain->host.world, curtain->sheet, frames, 64);
        for (int32_t i = 0; i < 10; ++i) {
            OK(kiriFrame_ApplyForce(curtain->host.world, frames[0], push, noVector));
            OK(kiriFrame_ApplyForce(curtain->host.world, frames[count / 2], push, noVector));
            Tick(curtain);
        }
    }
    for (int32_t i = 0; motion == BLOWN && i < 20; ++i) {
        Tick(curtain);
    }
}

typedef struct Areas {
    int32_t pieces;
    double least, second;
} Areas;

static Areas Look(const Curtain* curtain)
{
    Areas areas = { Host_Counts(&curtain->host, curtain->sheet).pieces, 1.0, 0.0 };
    double most = 0.0;
    for (int32_t i = 0; i < areas.pieces; ++i) {
        kiriPieceState piece = World_PieceState(curtain->host.world, curtain->sheet, i);
        areas.least = fmin(areas.least, piece.area);
        areas.second = fmax(areas.second, fmin(most, piece.area));
        most = fmax(most, piece.area);
    }
    return areas;
}

/* ---- The blade --------------------------------------------------------------------------------------------------- */

/* An edge that leans, or the ray of a mouse; its middle is at a place in the plane of the undeformed curtain. */
typedef struct Knife {
    double lean[2];
    bool isRay;
    float eye[3];
} Knife;

static Knife MakeKnife(Curtain* curtain)
{
    Knife knife;
    knife.lean[0] = Uniform(curtain, -0.4, 0.4);
    knife.lean[1] = Uniform(curtain, -0.4, 0.4);
    knife.isRay = (Random(&curtain->seed) & 256) != 0;
    knife.eye[0] = (float)Uniform(curtain, 0.0, 1.0);
    knife.eye[1] = -3.0f;
    knife.eye[2] = (float)Uniform(curtain, 0.0, 1.0);
    return knife;
}

static void MoveTo(const Curtain* curtain, const Knife* knife, double x, double z)
{
    kiriWorld* world = curtain->host.world;
    if (knife->isRay) {
        const float way[3] = { (float)x - knife->eye[0], -knife->eye[1], (float)z - knife->eye[2] };
        OK(kiriBlade_MoveRay(world, curtain->blade, knife->eye, way, 20.0f));
        return;
    }
    const float from[3] = { (float)(x - 4.0 * knife->lean[0]), -4.0f, (float)(z - 4.0 * knife->lean[1]) };
    const float to[3] = { (float)(x + 4.0 * knife->lean[0]), 4.0f, (float)(z + 4.0 * knife->lean[1]) };
    OK(kiriBlade_MoveEdge(world, curtain->blade, from, to));
}

/* ---- Swipes ------------------------------------------------------------------------------------------------------ */

/* A straight swipe in any direction, at 0.1 to 100 m/s. */
static void Swipe(Curtain* curtain)
{
    Knife knife = MakeKnife(curtain);
    double speed = 0.1 * pow(1000.0, Uniform(curtain, 0.0, 1.0)), angle = Uniform(curtain, 0.0, 2.0 * PI);
    double x = Uniform(curtain, 0.3, 0.7), z = Uniform(curtain, 0.3, 0.7), way[2] = { cos(angle), sin(angle) };
    double length = 2.6, from = -0.5 * length - Uniform(curtain, 0.0, 1.0) * fmin(speed * dt, 1.0);
    for (double s = from;; s += speed * dt) {
        MoveTo(curtain, &knife, x + s * way[0], z + s * way[1]);
        Tick(curtain);
        if (s > 0.5 * length) {
            break;
        }
    }
}

/* No bridge and no crumb is left. A curtain that sways may come over a slow blade again. */
static bool IsParted(const Curtain* curtain, Areas areas)
{
    return (areas.pieces == 2 || (curtain->motion != STILL && areas.pieces > 2)) &&
           areas.least > curtain->snap * curtain->snap && areas.second > 1e-2;
}

/* A blade that is held amid a curtain. */
static void Hold(Curtain* curtain)
{
    Knife knife = MakeKnife(curtain);
    double x = Uniform(curtain, 0.2, 0.8), z = Uniform(curtain, 0.2, 0.8);
    for (int32_t i = 0; i < 60 * heldSeconds; ++i) {
        MoveTo(curtain, &knife, x, z);
        Tick(curtain);
    }
}

static bool HasNoCrumbs(const Curtain* curtain, Areas areas)
{
    return areas.least > curtain->snap * curtain->snap;
}

/* Back and forth along nearly the same line, amid a still curtain: a slit, and nothing comes off. */
static void Saw(Curtain* curtain)
{
    Knife knife = MakeKnife(curtain);
    double speed = Uniform(curtain, 0.5, 10.0), angle = Uniform(curtain, 0.0, 2.0 * PI);
    for (int32_t i = 0; i < 240; ++i) {
        double s = 0.2 * sin(speed * i * dt), t = 0.5 * curtain->snap * sin(0.7 * i);
        MoveTo(curtain, &knife, 0.5 + s * cos(angle) - t * sin(angle), 0.5 + s * sin(angle) + t * cos(angle));
        Tick(curtain);
    }
}

static bool IsWhole(const Curtain* curtain, Areas areas)
{
    return areas.pieces == 1;
}

/* An edge in the plane of the curtain goes across that plane, to and fro. */
static void Chop(Curtain* curtain)
{
    double speed = Uniform(curtain, 0.5, 20.0), angle = Uniform(curtain, 0.0, 2.0 * PI);
    double x = 2.0 * cos(angle), z = 2.0 * sin(angle);
    for (int32_t i = 0; i < 60; ++i) {
        const double y = 0.3 * cos(speed * i * dt);
        const float from[3] = { (float)(0.5 - x), (float)y, (float)(0.5 - z) };
        const float to[3] = { (float)(0.5 + x), (float)y, (float)(0.5 + z) };
        OK(kiriBlade_MoveEdge(curtain->host.world, curtain->blade, from, to));
        Tick(curtain);
    }
}

/* A ray that ends behind the first layer that it meets, as in the manual: it parts. */
static void Finger(Curtain* curtain)
{
    double speed = Uniform(curtain, 0.5, 10.0), angle = Uniform(curtain, 0.0, 2.0 * PI);
    const float eye[3] = { (float)Uniform(curtain, 0.2, 0.8), -2.0f, (float)Uniform(curtain, 0.2, 0.8) };
    for (double s = -1.0; s < 1.0 + speed * dt; s += speed * dt) {
        const float way[3] = { (float)(0.5 + s * cos(angle)) - eye[0], -eye[1],
                               (float)(0.5 + s * sin(angle)) - eye[2] };
        kiriSheet met;
        kiriHit hit;
        OK(kiriWorld_Raycast(curtain->host.world, eye, way, 20.0f, &met, &hit));
        float length = met != 0 ? hit.distance + 0.05f : 20.0f;
        OK(kiriBlade_MoveRay(curtain->host.world, curtain->blade, eye, way, length));
        Tick(curtain);
    }
}

static bool IsDivided(const Curtain* curtain, Areas areas)
{
    return areas.pieces >= 2 && areas.second > 1e-2;
}

typedef struct Runs {
    const char* name;
    void (*cut)(Curtain* curtain);
    bool (*isRight)(const Curtain* curtain, Areas areas);
    int32_t motion, usual; /* runs, where no number is given */
} Runs;

static Runs allRuns[] = {
    { "SwipeStill", Swipe, IsParted, STILL, 8 },  { "SwipeSwaying", Swipe, IsParted, SWAYS, 9 },
    { "SwipeBlown", Swipe, IsParted, BLOWN, 6 },  { "HoldSwaying", Hold, HasNoCrumbs, SWAYS, 4 },
    { "HoldBlown", Hold, HasNoCrumbs, BLOWN, 4 }, { "Saw", Saw, IsWhole, STILL, 5 },
    { "Chop", Chop, HasNoCrumbs, STILL, 5 },      { "Finger", Finger, IsDivided, STILL, 5 },
};
enum { KINDS = sizeof(allRuns) / sizeof(allRuns[0]), SWAYING_SWIPES = 1, BLOWN_SWIPES };

static bool Run(const Runs* runs, uint32_t seed)
{
    Curtain curtain;
    Start(&curtain, runs->motion, seed);
    curtain.blade = World_BeginBlade(curtain.host.world, curtain.sheet);
    runs->cut(&curtain);
    OK(kiriBlade_End(curtain.host.world, curtain.blade));
    Tick(&curtain);
    Tick(&curtain);
    Areas areas = Look(&curtain);
    bool isRight = runs->isRight(&curtain, areas);
    if (!isRight) {
        printf("%s %u: %d pieces, the least %g m^2, the second %g m^2\n", runs->name, (unsigned)seed, areas.pieces,
               areas.least, areas.second);
    }
    Host_Stop(&curtain.host);
    return isRight;
}

static void CheckRuns(void** state)
{
    const Runs* runs = *state;
    int32_t wrong = 0, count = runCount > 0 ? runCount : runs->usual;
    for (int32_t i = firstSeed; i < firstSeed + count; ++i) {
        wrong += !Run(runs, (uint32_t)i);
    }
    if (runCount > 0 || wrong > 0) {
        printf("%s: %d of %d wrong\n", runs->name, (int)wrong, (int)count);
    }
    assert_int_equal(wrong, 0);
}

SETUP
{
    runCount = count > 1 ? atoi(words[1]) : runCount;
    firstSeed = count > 2 ? atoi(words[2]) : firstSeed;
    cmocka_set_test_filter(count > 3 ? words[3] : NULL);
    heldSeconds = count > 4 ? atoi(words[4]) : heldSeconds;
    for (int k = 0; k < KINDS; ++k) {
        Test_Add(allRuns[k].name, CheckRuns, &allRuns[k], __LINE__);
    }
}
