/* Sheets that are put elsewhere with what holds them, and worlds whose origin is moved: nothing is kicked. */
#include "host.h"

/* ---- A sheet that is held ---- */

enum { POINTS, HINGE, CLAMP, HOLD, ON_OBSTACLE, KINDS };
enum { ALONE, THEN_SET, SET_FIRST, ORDERS };

typedef struct Scene {
    Host host;
    kiriSheet sheet;
    kiriPin pins[3];
    int32_t pinCount;
    kiriFrame held;
    kiriFrameState hold; /* where the host has it */
    kiriObstacle obstacle;
} Scene;

typedef struct Motion {
    float rotation[9], way[3];
} Motion;

static void MovePlace(const Motion* motion, const float from[3], float to[3])
{
    for (int i = 0; i < 3; ++i) {
        double sum = motion->way[i];
        for (int k = 0; k < 3; ++k) {
            sum += (double)motion->rotation[3 * k + i] * from[k];
        }
        to[i] = (float)sum;
    }
}

static void TurnAxes(const Motion* motion, const float from[9], float to[9])
{
    const Motion turn = { { motion->rotation[0], motion->rotation[1], motion->rotation[2], motion->rotation[3],
                            motion->rotation[4], motion->rotation[5], motion->rotation[6], motion->rotation[7],
                            motion->rotation[8] },
                          { 0.0f, 0.0f, 0.0f } };
    for (int k = 0; k < 3; ++k) {
        MovePlace(&turn, from + 3 * k, to + 3 * k);
    }
}

static void AddPin(Scene* scene, float u, float v)
{
    kiriPinDef def = Host_PinDef(u, v, u, v, 1.0f);
    def.obstacle = scene->obstacle;
    OK(kiriCreatePin(scene->host.world, scene->sheet, &def, &scene->pins[scene->pinCount++]));
}

static void AddBox(Scene* scene)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_BOX);
    def.size[0] = def.size[1] = def.size[2] = 0.1f;
    def.groups = 0;
    OK(kiriCreateObstacle(scene->host.world, &def, &scene->obstacle));
}

static void Start(Scene* scene, int kind, int model, int skinning)
{
    kiriFrame frames[32];
    int32_t count;
    memset(scene, 0, sizeof(*scene));
    Host_Start(&scene->host);
    kiriSheetDef def = SheetOf(12, 8);
    def.position[2] = 1.0f;
    def.model = model;
    def.skinning = skinning;
    def.sleepSpeed = 0.0f;
    def.material.airDamping = 8.0f;
    OK(kiriCreateRectangle(scene->host.world, 1.0f, 1.0f, 10, 10, &def, &scene->sheet));
    switch (kind) {
    case HINGE:
        OK(kiriSheet_HingeLine(scene->host.world, scene->sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 1.0f, 0.0f },
                               &scene->pins[scene->pinCount++]));
        break;
    case CLAMP:
        OK(kiriSheet_ClampLine(scene->host.world, scene->sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 1.0f, 0.0f },
                               &scene->pins[scene->pinCount++]));
        break;
    case HOLD:
        OK(kiriSheet_GetFrames(scene->host.world, scene->sheet, frames, 32, &count));
        OK(kiriFrame_GetState(scene->host.world, frames[0], &scene->hold));
        OK(kiriFrame_Hold(scene->host.world, frames[0], scene->hold.position, scene->hold.rotation));
        scene->held = frames[0];
        break;
    default:
        if (kind == ON_OBSTACLE) {
            AddBox(scene);
        }
        AddPin(scene, 0.0f, 0.0f);
        AddPin(scene, 1.0f, 0.0f);
        AddPin(scene, 0.5f, 0.0f);
    }
}

/* What holds it goes along, by the host's own arithmetic. */
static void SetAll(Scene* scene, const Motion* motion, const kiriPinState* pins)
{
    float place[3], axes[9];
    for (int32_t i = 0; i < scene->pinCount && scene->obstacle == 0; ++i) {
        MovePlace(motion, pins[i].target, place);
        TurnAxes(motion, pins[i].rotation, axes);
        OK(pins[i].type == KIRI_PIN_POINT ? kiriPin_SetTarget(scene->host.world, scene->pins[i], place)
                                          : kiriPin_SetPose(scene->host.world, scene->pins[i], place, axes));
    }
    if (scene->held != 0) {
        MovePlace(motion, scene->hold.position, place);
        TurnAxes(motion, scene->hold.rotation, axes);
        OK(kiriFrame_Hold(scene->host.world, scene->held, place, axes));
    }
    if (scene->obstacle != 0) {
        kiriObstacleState state = World_ObstacleState(scene->host.world, scene->obstacle);
        MovePlace(motion, state.position, place);
        TurnAxes(motion, state.rotation, axes);
        OK(kiriObstacle_SetPose(scene->host.world, scene->obstacle, place, axes));
    }
}

static void Teleport(Scene* scene, const Motion* motion, int order)
{
    kiriPinState pins[3];
    for (int32_t i = 0; i < scene->pinCount; ++i) {
        OK(kiriPin_GetState(scene->host.world, scene->pins[i], &pins[i]));
    }
    if (order == SET_FIRST) {
        SetAll(scene, motion, pins);
    }
    OK(kiriSheet_Transform(scene->host.world, scene->sheet, motion->rotation, motion->way));
    if (order == THEN_SET || (order == ALONE && scene->obstacle != 0)) {
        SetAll(scene, motion, pins);
    }
}

/* The second scene has as much more energy, J. */
static double EnergyApart(const Scene scenes[2])
{
    return World_Energy(scenes[1].host.world, scenes[1].sheet) - World_Energy(scenes[0].host.world, scenes[0].sheet);
}

/* Two sheets fall to rest; one is put elsewhere, and both go on alike. */
static void CheckTeleport(int kind, int order, int model, int skinning, int32_t ticks)
{
    static const Motion motion = { { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f }, { 10.0f, -3.0f, 2.0f } };
    Scene scenes[2];
    for (int k = 0; k < 2; ++k) {
        Start(&scenes[k], kind, model, skinning);
        World_Ticks(scenes[k].host.world, ticks, 1.0f / 60.0f, 1);
    }
    kiriTotals totals = Host_Totals(&scenes[0].host, scenes[0].sheet);
    double scale = 9.81 * totals.mass, lifted = scale * motion.way[2];
    Teleport(&scenes[1], &motion, order);
    for (int32_t tick = 0; tick < 6; ++tick) {
        double apart = fabs(EnergyApart(scenes) - lifted);
        if (!(apart < 1e-6 * scale)) {
            fail_msg("kind %d, order %d, model %d, skinning %d, tick %d: %g J of %g", kind, order, model, skinning,
                     (int)tick, apart, scale);
        }
        for (int k = 0; k < 2; ++k) {
            OK(kiriWorld_Tick(scenes[k].host.world, 1.0f / 60.0f, 1));
        }
    }
    Host_Stop(&scenes[0].host);
    Host_Stop(&scenes[1].host);
}

TEST(SheetsAtRest)
{
    for (int kind = 0; kind < KINDS; ++kind) {
        for (int order = 0; order < ORDERS; ++order) {
            for (int model = KIRI_MODEL_LINKS; model <= KIRI_MODEL_AFFINE; ++model) {
                CheckTeleport(kind, order, model, (kind + order + model) % 2, 150);
            }
        }
    }
}

/* A target that is set before counts as moved, though by nothing: that step is one of backward Euler. */
TEST(SwingingSheets)
{
    for (int kind = 0; kind < KINDS; ++kind) {
        for (int order = ALONE; order < SET_FIRST && kind != ON_OBSTACLE; ++order) {
            CheckTeleport(kind, order, KIRI_MODEL_LINKS, KIRI_SKINNING_LINEAR, 17);
            CheckTeleport(kind, order, KIRI_MODEL_LINKS, KIRI_SKINNING_SMOOTH, 17);
            CheckTeleport(kind, order, KIRI_MODEL_AFFINE, KIRI_SKINNING_LINEAR, 17);
        }
    }
}

/* ---- Pins that the host moves in every tick ---- */

enum { MOVED_FIRST, MOVED_THEN, MOVED_ELSEWHERE_FIRST, MOVES };

static void MovePins(Scene* scene, int32_t tick, const Motion* motion)
{
    for (int32_t i = 0; i < scene->pinCount; ++i) {
        static const float u[3] = { 0.0f, 1.0f, 0.5f };
        const float at[3] = { u[i], 0.0f, 1.0f + 0.0078125f * (float)tick };
        float place[3];
        MovePlace(motion, at, place);
        OK(kiriPin_SetTarget(scene->host.world, scene->pins[i], place));
    }
}

TEST(MovingPins)
{
    static const Motion none = { { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f }, { 0.0f, 0.0f, 0.0f } },
                        away = { { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f }, { 16.0f, -4.0f, 2.0f } };
    for (int move = 0; move < MOVES; ++move) {
        Scene scenes[2];
        for (int k = 0; k < 2; ++k) {
            const Motion* motion = &none;
            Start(&scenes[k], POINTS, KIRI_MODEL_LINKS, KIRI_SKINNING_LINEAR);
            for (int32_t tick = 0; tick < 40; ++tick) {
                bool isTime = k == 1 && tick == 30;
                if (!isTime || move != MOVED_THEN) {
                    MovePins(&scenes[k], tick, isTime && move == MOVED_ELSEWHERE_FIRST ? &away : motion);
                }
                if (isTime) {
                    OK(kiriSheet_Transform(scenes[k].host.world, scenes[k].sheet, away.rotation, away.way));
                    motion = &away;
                }
                if (isTime && move == MOVED_THEN) {
                    MovePins(&scenes[k], tick, motion);
                }
                OK(kiriWorld_Tick(scenes[k].host.world, 1.0f / 60.0f, 1));
            }
        }
        kiriTotals totals = Host_Totals(&scenes[0].host, scenes[0].sheet);
        double scale = 9.81 * totals.mass, apart = EnergyApart(scenes) - scale * away.way[2];
        assert_true(fabs(apart) < 1e-6 * scale);
        Host_Stop(&scenes[0].host);
        Host_Stop(&scenes[1].host);
    }
}

/* ---- Another origin ---- */

enum { SHIFT_AT = 44, SHIFT_AGAIN = 51, SCENE_TICKS = 55 };

typedef struct Everything {
    Host host;
    kiriObstacle ball;
    kiriBlade blade;
    kiriFrame held;
    kiriSheet sheets[6];
    float origin[3]; /* where it was at the start */
} Everything;

static void From(const Everything* all, float x, float y, float z, float place[3])
{
    place[0] = x - all->origin[0];
    place[1] = y - all->origin[1];
    place[2] = z - all->origin[2];
}

static kiriObstacle AddObstacle(Everything* all, int32_t type, float x, float y, float z)
{
    kiriObstacleDef def = ObstacleOf(type);
    def.radius = 0.2f;
    From(all, x, y, z, def.position);
    return World_AddObstacle(all->host.world, &def);
}

/* Bits of `how`: settings of a sheet. */
enum { TOUCHES = 1, SMOOTH = 2, AFFINE = 4, SLEEPS = 8, PLANAR = 16, FOLDS = 32 };

static kiriSheet AddSheet(Everything* all, float x, float y, float z, int how)
{
    kiriSheetDef def = SheetOf(12, (how & FOLDS) != 0 ? 36 : 6);
    def.selfContact = (how & FOLDS) != 0;
    if (def.selfContact) {
        Set3(def.axisV, 0.0f, 0.28f, 0.96f);
    }
    def.collisionPoints = 8;
    def.touchesSheets = (how & TOUCHES) != 0;
    def.skinning = (how & SMOOTH) != 0 ? KIRI_SKINNING_SMOOTH : KIRI_SKINNING_LINEAR;
    def.model = (how & AFFINE) != 0 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS;
    def.planar = (how & PLANAR) != 0;
    def.sleepSpeed = (how & SLEEPS) != 0 ? 0.5f : 0.0f;
    From(all, x, y, z, def.position);
    return World_AddRectangle(all->host.world, 1.0f, 1.0f, 10, 10, &def);
}

static void PinTo(Everything* all, kiriSheet sheet, float u, float v, float x, float y, float z, kiriObstacle obstacle)
{
    kiriPinDef def = DefaultPin();
    def.restPoint[0] = u;
    def.restPoint[1] = v;
    def.obstacle = obstacle;
    From(all, x, y, z, def.target);
    World_AddPin(all->host.world, sheet, &def);
}

static void StartEverything(Everything* all)
{
    const kiriBudget budget = { 100, 1200, 400, 0 };
    memset(all, 0, sizeof(*all));
    Host_Start(&all->host);
    kiriWorld* world = all->host.world;
    AddObstacle(all, KIRI_OBSTACLE_PLANE, 0.0f, 0.0f, 0.0f);
    all->ball = AddObstacle(all, KIRI_OBSTACLE_SPHERE, 0.5f, 0.5f, 0.6f);
    OK(kiriObstacle_SetVelocity(world, all->ball, (float[]){ 0.3f, 0.1f, 0.2f }, (float[]){ 0.0f, 1.0f, 0.5f }));
    all->sheets[0] = AddSheet(all, 0.0f, 0.0f, 1.0f, TOUCHES | SMOOTH); /* falls on the ball */
    all->sheets[1] = AddSheet(all, 0.2f, 0.1f, 1.05f, TOUCHES);         /* and one on it */
    all->sheets[2] = AddSheet(all, 3.0f, 0.0f, 1.0f, AFFINE);           /* hangs, and is cut by the blade */
    all->sheets[3] = AddSheet(all, 6.0f, 0.0f, 0.0022f, SLEEPS);        /* lies on the floor */
    all->sheets[4] = AddSheet(all, 9.0f, 0.0f, 1.0f, PLANAR);
    all->sheets[5] = AddSheet(all, 12.0f, 0.0f, 0.05f, FOLDS); /* stands, and falls over itself */
    PinTo(all, all->sheets[2], 0.0f, 0.0f, 3.0f, 0.0f, 1.0f, 0);
    PinTo(all, all->sheets[2], 1.0f, 0.0f, 4.0f, 0.0f, 1.0f, 0);
    PinTo(all, all->sheets[0], 1.0f, 0.0f, 1.0f, 0.0f, 1.0f, all->ball);
    World_Clamp(world, all->sheets[4], (float[]){ 0.0f, 0.0f }, (float[]){ 0.0f, 1.0f });
    all->held = Host_FrameOf(&all->host, all->sheets[1], 0);
    kiriFrameState state = World_FrameState(world, all->held);
    OK(kiriFrame_Hold(world, all->held, state.position, state.rotation));
    OK(kiriBeginBlade(world, all->sheets[2], &all->blade));
    OK(kiriWorld_SetBudget(world, &budget));
}

/* Acts of the host before a tick, all at places of the world. */
static void ActOnEverything(Everything* all, int32_t tick)
{
    float from[3], to[3];
    kiriFrameState state;
    const float x = 2.9f + 0.02f * (float)tick;
    From(all, x, -0.5f, 0.75f, from);
    From(all, x, 1.0f, 0.75f, to);
    OK(kiriBlade_MoveEdge(all->host.world, all->blade, from, to));
    if (tick == SHIFT_AT - 6 || tick == SHIFT_AT + 5) {
        float at = 0.008f * (float)tick;
        Host_Cut(&all->host, all->sheets[0], (float[]){ -0.1f, at, 1.1f, at + 0.1f }, 2);
    }
    if (tick == SHIFT_AT - 1) {
        OK(kiriFrame_GetState(all->host.world, all->held, &state));
        state.position[2] += 0.125f;
        OK(kiriFrame_Hold(all->host.world, all->held, state.position, state.rotation));
        kiriContact contact = { .point = -1, .restPoint = { 0.5f, 0.5f }, .normal = { 0.0f, 0.0f, 1.0f } };
        contact.offset = 0.875f - all->origin[2];
        OK(kiriSheet_SetContacts(all->host.world, all->sheets[4], &contact, 1));
    }
}

static void CompareEverything(const Everything* a, const Everything* b, int32_t tick)
{
    assert_int_equal(Host_SheetCount(&a->host), Host_SheetCount(&b->host));
    for (int32_t s = 0; s < Host_SheetCount(&a->host); ++s) {
        kiriSheet id = Host_SheetAt(&a->host, s);
        kiriTotals one = Host_Totals(&a->host, id), other = Host_Totals(&b->host, id);
        double scale = 9.81 * one.mass + fabs(one.elasticEnergy), most = 0.0, mostRest = 0.0;
        kiriMesh from = Host_Mesh(&a->host, id), to = Host_Mesh(&b->host, id);
        assert_int_equal(from.vertexCount, to.vertexCount);
        for (int32_t i = 0; i < 2 * from.vertexCount; ++i) { /* far off, floats place the blade more roughly */
            double apart = fabs((double)from.restPositions[i] - to.restPositions[i]);
            mostRest = apart > mostRest ? apart : mostRest;
        }
        if (mostRest > 1e-5) {
            fail_msg("tick %d, sheet %d: %g m apart in the rest plane", (int)tick, (int)s, mostRest);
        }
        for (int32_t i = 0; i < 3 * from.vertexCount; ++i) {
            double apart = fabs((double)from.positions[i] - to.positions[i] - b->origin[i % 3]);
            most = apart > most ? apart : most;
        }
        double energy = fabs(one.elasticEnergy + one.kineticEnergy - other.elasticEnergy - other.kineticEnergy);
        int32_t awake = World_IsAwake(a->host.world, id);
        int32_t otherAwake = World_IsAwake(b->host.world, id);
        if (most > (s == 5 ? 2e-3 : 1e-5) || energy > (s == 5 ? 1e-3 : 2e-5) * scale || awake != otherAwake) {
            fail_msg("tick %d, sheet %d: %g m, %g J of %g, awake %d and %d", (int)tick, (int)s, most, energy, scale,
                     (int)awake, (int)otherAwake);
        }
    }
}

static void ShiftEverything(Everything* all, float x, float y, float z)
{
    const float by[3] = { x, y, z };
    OK(kiriWorld_ShiftOrigin(all->host.world, by));
    for (int i = 0; i < 3; ++i) {
        all->origin[i] += by[i];
    }
    Host_Validate(&all->host);
}

/* World 1 is shifted twice. World 2 becomes in each tick a copy of world 0, shifted. Rounding moved sheets by 2.3 mm with
   this seed, by normals of contacts and by holds. In folds it still chooses normals, and moves sheet 5 by 1.2 mm. */
TEST(Origin)
{
    static Everything worlds[3];
    int32_t pending = 0, contacts = 0, slept = 0;
    uint32_t seed = 3;
    for (int k = 0; k < 3; ++k) {
        StartEverything(&worlds[k]);
    }
    for (int32_t tick = 0; tick < SCENE_TICKS; ++tick) {
        kiriResult results[3];
        ActOnEverything(&worlds[0], tick);
        ActOnEverything(&worlds[1], tick);
        uint64_t hash = Host_Hash(&worlds[1].host);
        OK(kiriWorld_ShiftOrigin(worlds[1].host.world, (float[]){ 0.0f, -0.0f, 0.0f }));
        assert_int_equal(kiriWorld_ShiftOrigin(worlds[1].host.world, (float[3]){ 3e38f }), KIRI_ERROR_ARGUMENT);
        assert_true(hash == Host_Hash(&worlds[1].host));
        if (tick == SHIFT_AT || tick == SHIFT_AGAIN) {
            ShiftEverything(&worlds[1], 64.0f, -32.0f, tick == SHIFT_AT ? 16.0f : -8.0f);
        }
        World_Copy(worlds[2].host.world, worlds[0].host.world, kiriWorld_Snapshot);
        Set3(worlds[2].origin, 0.0f, 0.0f, 0.0f);
        ShiftEverything(&worlds[2], 0.25f * (float)(Random(&seed) % 64), -8.0f, 0.25f * (float)(Random(&seed) % 64));
        for (int k = 0; k < 3; ++k) {
            results[k] = Host_Tick(&worlds[k].host, 1.0f / 60.0f, 2);
            assert_int_equal(results[0], results[k]);
            CompareEverything(&worlds[0], &worlds[k], tick);
        }
        pending += tick >= SHIFT_AT && results[0] == KIRI_PENDING;
        contacts += tick == SHIFT_AT ? World_ObstacleState(worlds[0].host.world, worlds[0].ball).contacts : 0;
        slept += tick == SHIFT_AT && !World_IsAwake(worlds[0].host.world, worlds[0].sheets[3]);
    }
    assert_true(pending > 3 && contacts > 0 && slept == 1); /* all of it was going on */
    for (int k = 0; k < 3; ++k) {
        Host_Stop(&worlds[k].host);
    }
}
