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
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = def.target[0] = u;
    def.restPoint[1] = def.target[1] = v;
    def.target[2] = 1.0f;
    def.obstacle = scene->obstacle;
    OK(kiriCreatePin(scene->host.world, scene->sheet, &def, &scene->pins[scene->pinCount++]));
}

static void AddBox(Scene* scene)
{
    kiriObstacleDef def;
    kiriDefaultObstacleDef(&def);
    def.type = KIRI_OBSTACLE_BOX;
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
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.gridResolution = 12;
    def.frameCount = 8;
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
        kiriObstacleState state;
        OK(kiriObstacle_GetState(scene->host.world, scene->obstacle, &state));
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

/* What moves it and what is stored in it, with what gravity can give, J. */
static double EnergyOf(const Scene* scene)
{
    kiriTotals totals = Host_Totals(&scene->host, scene->sheet);
    return totals.kineticEnergy + totals.elasticEnergy + 9.81 * totals.mass * totals.center[2];
}

/* Two sheets fall to rest; one is put elsewhere, and both go on alike. */
static void CheckTeleport(int kind, int order, int model, int skinning, int32_t ticks)
{
    static const Motion motion = { { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f }, { 10.0f, -3.0f, 2.0f } };
    Scene scenes[2];
    for (int k = 0; k < 2; ++k) {
        Start(&scenes[k], kind, model, skinning);
        for (int32_t tick = 0; tick < ticks; ++tick) {
            OK(kiriWorld_Tick(scenes[k].host.world, 1.0f / 60.0f, 1));
        }
    }
    kiriTotals totals = Host_Totals(&scenes[0].host, scenes[0].sheet);
    double scale = 9.81 * totals.mass, lifted = scale * motion.way[2];
    Teleport(&scenes[1], &motion, order);
    for (int32_t tick = 0; tick < 6; ++tick) {
        double apart = fabs(EnergyOf(&scenes[1]) - EnergyOf(&scenes[0]) - lifted);
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

static void TestSheetsAtRest(void** state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; ++kind) {
        for (int order = 0; order < ORDERS; ++order) {
            for (int model = KIRI_MODEL_LINKS; model <= KIRI_MODEL_AFFINE; ++model) {
                CheckTeleport(kind, order, model, (kind + order + model) % 2, 150);
            }
        }
    }
}

/* A target that is set before counts as moved, though by nothing: that step is one of backward Euler. */
static void TestSwingingSheets(void** state)
{
    (void)state;
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

static void TestMovingPins(void** state)
{
    (void)state;
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
        double scale = 9.81 * totals.mass, apart = EnergyOf(&scenes[1]) - EnergyOf(&scenes[0]) - scale * away.way[2];
        assert_true(fabs(apart) < 1e-6 * scale);
        Host_Stop(&scenes[0].host);
        Host_Stop(&scenes[1].host);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestSheetsAtRest),
        cmocka_unit_test(TestSwingingSheets),
        cmocka_unit_test(TestMovingPins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
