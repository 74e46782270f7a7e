/* Pieces of a sheet that come to rest, sleep and wake, each for itself, through the public header alone. */
#include "host.h"

static const float dt = 1.0f / 60.0f;
enum { HALF_SECOND = 30, STRIPS = 4 };

#define Tick(host) OK(Host_Tick(host, dt, 2))

/* One bit for each piece that is awake. */
static uint32_t Awake(const Host* host, kiriSheet sheet)
{
    uint32_t bits = 0;
    int32_t awake, pieces = Host_Counts(host, sheet).pieces;
    for (int32_t p = 0; p < pieces; ++p) {
        bits |= World_PieceState(host->world, sheet, p).asleep ? 0u : 1u << p;
    }
    OK(kiriSheet_IsAwake(host->world, sheet, &awake));
    assert_int_equal(awake, bits != 0);
    return bits;
}

static void SleepAll(Host* host, kiriSheet sheet)
{
    for (int k = 0; k < 900 && Awake(host, sheet) != 0; ++k) {
        Tick(host);
    }
    assert_int_equal(Awake(host, sheet), 0);
}

/* The index that the strip from u = strip / 4 on has now. */
static int32_t StripAt(const Host* host, kiriSheet sheet, int strip)
{
    const float rest[2] = { ((float)strip + 0.55f) / STRIPS, 0.48f };
    kiriPointState point = World_PointState(host->world, sheet, rest);
    return World_PieceOf(host->world, point.frame);
}

static kiriFrame FrameAt(const Host* host, kiriSheet sheet, int strip)
{
    return Host_FrameOf(host, sheet, StripAt(host, sheet, strip));
}

static uint32_t Bit(const Host* host, kiriSheet sheet, int strip)
{
    return 1u << StripAt(host, sheet, strip);
}

static kiriSheetDef StripsDef(void)
{
    kiriSheetDef def = SheetOf(16, 8);
    def.maxFrames = 64;
    def.collisionPoints = 24;
    def.material.airDamping = 4.0f;
    def.material.flexDamping = 0.02f;
    return def;
}

/* A square in four strips, of two frames and more each, without gravity. */
static kiriSheet AddFineStrips(Host* host, kiriSheetDef* def, int32_t squares)
{
    World_StopGravity(host->world);
    kiriSheet sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, squares, squares);
    for (int i = 1; i < STRIPS; ++i) {
        float u = (float)i / STRIPS + 0.011f;
        const float line[4] = { u, -0.1f, u, 1.1f };
        Host_Cut(host, sheet, line, 2);
    }
    Tick(host);
    assert_int_equal(Host_Counts(host, sheet).pieces, STRIPS);
    return sheet;
}

static kiriSheet AddStrips(Host* host, kiriSheetDef* def)
{
    return AddFineStrips(host, def, 16);
}

static kiriSheet StartStrips(Host* host)
{
    kiriSheetDef def = StripsDef();
    Host_Start(host);
    return AddStrips(host, &def);
}

static void Throw(Host* host, kiriSheet sheet, int strip, float up)
{
    const float velocity[3] = { 0.0f, 0.0f, up };
    OK(kiriFrame_SetPieceVelocity(host->world, FrameAt(host, sheet, strip), velocity, noVector));
}

/* ---- Falling asleep ---- */

/* The faster a strip is thrown the later it sleeps. Until then it moves as where nothing sleeps, to the last bit; and
   then no more. */
TEST(OneByOne)
{
    static const float speeds[STRIPS] = { 0.0f, 1.0f, 0.01f, 0.1f };
    static const int order[STRIPS] = { 0, 2, 3, 1 };
    HOST_PAIR(hosts);
    kiriSheet sheets[2];
    int asleepAt[STRIPS] = { 0 };
    for (int h = 0; h < 2; ++h) {
        kiriSheetDef def = StripsDef();
        def.sleepSpeed = h == 0 ? def.sleepSpeed : 0.0f;
        Host_Start(&hosts[h]);
        sheets[h] = AddStrips(&hosts[h], &def);
        for (int i = 0; i < STRIPS; ++i) {
            Throw(&hosts[h], sheets[h], i, speeds[i]);
        }
    }
    kiriPieceState rested[STRIPS];
    for (int tick = 1; tick < 400; ++tick) {
        Tick(&hosts[0]);
        Tick(&hosts[1]);
        for (int i = 0; i < STRIPS; ++i) {
            kiriPieceState one = World_PieceState(hosts[0].world, sheets[0], StripAt(&hosts[0], sheets[0], i));
            kiriPieceState other = World_PieceState(hosts[1].world, sheets[1], StripAt(&hosts[1], sheets[1], i));
            assert_false(other.asleep);
            if (one.asleep && asleepAt[i] == 0) {
                asleepAt[i] = tick;
                rested[i] = one;
                assert_true(one.momentum[0] == 0.0 && one.momentum[1] == 0.0 && one.momentum[2] == 0.0);
            }
            assert_memory_equal(one.center, asleepAt[i] > 0 ? rested[i].center : other.center, sizeof(one.center));
            assert_memory_equal(one.lower, asleepAt[i] > 0 ? rested[i].lower : other.lower, sizeof(one.lower));
        }
    }
    assert_true(asleepAt[0] >= HALF_SECOND && asleepAt[1] > 0);
    for (int i = 1; i < STRIPS; ++i) {
        assert_true(asleepAt[order[i]] > asleepAt[order[i - 1]] + 10);
    }
}

/* What sleeps takes nothing from the budget. */
TEST(Work)
{
    kiriSheetDef def = StripsDef();
    def.gridResolution = 40;
    def.frameCount = 200;
    def.maxFrames = 400;
    START_HOST(host);
    kiriSheet sheet = AddStrips(&host, &def);
    Tick(&host);
    kiriProfile profile = World_Profile(host.world);
    int32_t all = profile.solverIterations;
    SleepAll(&host, sheet);
    Throw(&host, sheet, 2, 0.1f);
    Tick(&host);
    OK(kiriWorld_GetProfile(host.world, &profile));
    assert_true(profile.solverIterations > 0 && 2 * profile.solverIterations < all);
}

/* ---- Waking ---- */

typedef enum Call {
    FORCE,
    TORQUE,
    POINT_FORCE,
    IMPULSE,
    VELOCITY,
    HOLD,
    PIN,
    PIN_MOVES,
    PIN_GOES,
    CONTACT,
    NO_FORCE,
    LINE,
    PRESSURE,
    GRAVITY,
    SETTINGS,
    WAKE,
    SHEET_VELOCITY,
    CALLS
} Call;

/* To the third strip alone, up to NO_FORCE. */
static void Perform(Host* host, kiriSheet sheet, Call call)
{
    static const float some[3] = { 1e-4f, 0.0f, 1e-4f }, eye[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    static const float at[2] = { 0.6f, 0.48f }, from[2] = { 0.1f, 0.5f }, to[2] = { 0.9f, 0.5f };
    kiriFrame frame = FrameAt(host, sheet, 2);
    kiriSheetSettings settings;
    kiriPointState point = World_PointState(host->world, sheet, at);
    kiriContact contact = {
        .point = -1, .restPoint = { at[0], at[1] }, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.01f
    };
    switch (call) {
    case FORCE:
    case NO_FORCE:
        OK(kiriFrame_ApplyForce(host->world, frame, call == FORCE ? some : noVector, noVector));
        break;
    case TORQUE:
        OK(kiriFrame_ApplyForce(host->world, frame, noVector, some));
        break;
    case POINT_FORCE:
        OK(kiriSheet_ApplyForce(host->world, sheet, at, some, noVector));
        break;
    case IMPULSE:
        OK(kiriSheet_ApplyImpulse(host->world, sheet, at, some));
        break;
    case VELOCITY:
        OK(kiriFrame_SetPieceVelocity(host->world, frame, some, noVector));
        break;
    case HOLD:
        OK(kiriFrame_Hold(host->world, frame, point.position, eye));
        break;
    case CONTACT:
        contact.offset += point.position[2];
        OK(kiriSheet_SetContacts(host->world, sheet, &contact, 1));
        break;
    case LINE:
        OK(kiriSheet_ApplyLineLoad(host->world, sheet, from, to, some));
        break;
    case PRESSURE:
        OK(kiriSheet_ApplyPressure(host->world, sheet, 0.01f));
        break;
    case GRAVITY:
        OK(kiriWorld_SetGravity(host->world, some));
        break;
    case SETTINGS:
        OK(kiriSheet_GetSettings(host->world, sheet, &settings));
        settings.friction *= 0.5f;
        OK(kiriSheet_SetSettings(host->world, sheet, &settings));
        break;
    case SHEET_VELOCITY:
        OK(kiriSheet_SetVelocity(host->world, sheet, some, noVector));
        break;
    default:
        OK(kiriSheet_Wake(host->world, sheet));
        break;
    }
}

static kiriPin PinStrip(Host* host, kiriSheet sheet)
{
    static const float at[2] = { 0.6f, 0.48f };
    kiriPointState point = World_PointState(host->world, sheet, at);
    return Host_Pin(host, sheet, at[0], at[1], point.position[0], point.position[1], point.position[2]);
}

static void PerformWithPin(Host* host, kiriSheet sheet, Call call)
{
    static const float elsewhere[3] = { 0.6f, 0.48f, 0.01f };
    kiriPin pin = PinStrip(host, sheet);
    if (call != PIN) {
        SleepAll(host, sheet);
        OK(call == PIN_MOVES ? kiriPin_SetTarget(host->world, pin, elsewhere) : kiriDestroyPin(host->world, pin));
    }
}

/* What is new to a piece wakes it, and no other. */
TEST(CallsWake)
{
    for (int call = 0; call < CALLS; ++call) {
        HOST(host);
        kiriSheet sheet = StartStrips(&host);
        SleepAll(&host, sheet);
        if (call == PIN || call == PIN_MOVES || call == PIN_GOES) {
            PerformWithPin(&host, sheet, (Call)call);
        } else {
            Perform(&host, sheet, (Call)call);
        }
        Tick(&host);
        uint32_t expected = call < NO_FORCE ? Bit(&host, sheet, 2) : call == NO_FORCE ? 0 : 15;
        if (Awake(&host, sheet) != expected) {
            fail_msg("call %d: %x are awake", call, Awake(&host, sheet));
        }
    }
}

/* Contacts that a piece fell asleep with leave it asleep, whatever others get. */
TEST(ContactsOfOthers)
{
    HOST(host);
    kiriSheet sheet = StartStrips(&host);
    kiriContact contacts[2] = { { .point = -1, .restPoint = { 0.1f, 0.5f }, .normal = { 0, 0, 1 }, .offset = -0.5f },
                                { .point = -1, .restPoint = { 0.6f, 0.5f }, .normal = { 0, 0, 1 }, .offset = -0.5f } };
    for (int k = 0; k < 60; ++k) {
        OK(kiriSheet_SetContacts(host.world, sheet, contacts, 2));
        Tick(&host);
    }
    assert_int_equal(Awake(&host, sheet), 0);
    for (int k = 0; k < 5; ++k) {
        contacts[1].offset -= 0.1f;
        OK(kiriSheet_SetContacts(host.world, sheet, contacts, 2));
        Tick(&host);
        assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 2));
    }
    OK(kiriSheet_SetContacts(host.world, sheet, contacts + 1, 1)); /* the first one's is gone */
    Tick(&host);
    assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 2) | Bit(&host, sheet, 0));
}

/* Each corner of a small sheet lies in a groove: two contacts at one point, of one obstacle. Asleep they are told what
   each pushed with. */
TEST(ContactsOfOnePoint)
{
    enum { CONTACTS = 8 };
    static const float slope = 0.6f, rise = 0.8f, down[3] = { 0.0f, 0.0f, -9.81f };
    kiriContact contacts[CONTACTS];
    const kiriContactForce* told;
    kiriSheetDef def = Host_SmallDef();
    int32_t count;
    def.framePoints = NULL;
    def.frameCount = 1;
    START_HOST(host);
    OK(kiriWorld_SetGravity(host.world, down));
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
    memset(contacts, 0, sizeof(contacts));
    for (int k = 0; k < CONTACTS; ++k) {
        contacts[k].point = -1;
        contacts[k].restPoint[0] = k / 2 % 2 ? 0.9f : 0.1f;
        contacts[k].restPoint[1] = k / 4 ? 0.9f : 0.1f;
        contacts[k].normal[0] = k % 2 ? slope : -slope;
        contacts[k].normal[2] = rise;
        contacts[k].friction = 0.3f;
        contacts[k].offset = contacts[k].normal[0] * contacts[k].restPoint[0];
    }
    double pushed[CONTACTS][3];
    for (int tick = 0; tick < 300; ++tick) {
        OK(kiriSheet_SetContacts(host.world, sheet, contacts, CONTACTS));
        Tick(&host);
        OK(kiriSheet_GetContactForces(host.world, sheet, &told, &count));
        assert_int_equal(count, CONTACTS);
        for (int k = 0; k < count && Awake(&host, sheet) != 0; ++k) {
            memcpy(pushed[k], told[k].impulse, sizeof(pushed[k]));
        }
    }
    assert_int_equal(Awake(&host, sheet), 0);
    double weight = 9.81 * Host_Totals(&host, sheet).mass * (double)dt;
    int differ = 0;
    for (int k = 0; k < CONTACTS; ++k) {
        for (int n = 0; n < 3; ++n) {
            assert_true(fabs(told[k].impulse[n] - pushed[k][n]) < 0.01 * weight);
        }
        differ += k % 2 && fabs(pushed[k][0] - pushed[k - 1][0]) > 0.01 * weight;
    }
    assert_true(differ > 0);
}

/* ---- Cuts ---- */

/* A slit wakes the piece that it is in, and what cuts it in two both parts; the strips beside it share squares with
   it. */
TEST(CutWakesItsPiece)
{
    static const float slit[4] = { 0.6f, 0.3f, 0.65f, 0.6f };
    static const float loop[8] = { 0.6f, 0.7f, 0.7f, 0.7f, 0.65f, 0.9f, 0.6f, 0.7f };
    HOST(host);
    kiriSheet sheet = StartStrips(&host);
    SleepAll(&host, sheet);
    Host_Cut(&host, sheet, slit, 2);
    assert_int_equal(Awake(&host, sheet), 0);
    Tick(&host);
    assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 2));
    SleepAll(&host, sheet);
    Host_Cut(&host, sheet, loop, 4);
    Tick(&host);
    assert_int_equal(Host_Counts(&host, sheet).pieces, STRIPS + 1);
    assert_int_equal(__builtin_popcount(Awake(&host, sheet)), 2);
    assert_true((Awake(&host, sheet) & Bit(&host, sheet, 2)) != 0);
}

/* ---- Obstacles ---- */

static kiriObstacle AddBall(Host* host, float u, float v, float z, float up)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_SPHERE);
    def.radius = 0.03f;
    Set3(def.position, u, v, z);
    def.velocity[2] = up;
    return World_AddObstacle(host->world, &def);
}

TEST(ObstacleWakesWhatIsNear)
{
    HOST(host);
    kiriSheet sheet = StartStrips(&host);
    SleepAll(&host, sheet);
    AddBall(&host, 0.37f, 0.5f, -0.2f, 0.3f);
    uint32_t near = Bit(&host, sheet, 1);
    int tick = 0;
    for (; tick < 60 && Awake(&host, sheet) == 0; ++tick) {
        Tick(&host);
    }
    assert_true(tick > 10 && tick < 60);
    double height = World_PieceState(host.world, sheet, StripAt(&host, sheet, 1)).center[2];
    for (int k = 0; k < 30; ++k) {
        assert_int_equal(Awake(&host, sheet), near);
        Tick(&host);
    }
    assert_true(World_PieceState(host.world, sheet, StripAt(&host, sheet, 1)).center[2] > height + 0.05);
}

/* Away from under a piece, an obstacle wakes that. */
TEST(ObstacleGoes)
{
    HOST(host);
    kiriSheet sheet = StartStrips(&host);
    kiriObstacle ball = AddBall(&host, 0.37f, 0.5f, -0.032f, 0.0f);
    SleepAll(&host, sheet);
    OK(kiriDestroyObstacle(host.world, ball));
    assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 1));
}

/* A ball comes up through the plane of the sheet, while the last strip sleeps or moves. */
static void PassThrough(Host* host, kiriSheet sheet, float u, bool isLastAwake, uint32_t woken)
{
    uint32_t last = isLastAwake ? Bit(host, sheet, 3) : 0;
    AddBall(host, u, 0.5f, -0.3f, 3.0f);
    for (int k = 0; k < 12; ++k) {
        if (isLastAwake) {
            Throw(host, sheet, 3, 0.1f);
        }
        Tick(host);
        assert_int_equal(Awake(host, sheet) & ~woken, last);
    }
    assert_int_equal(Awake(host, sheet), last | woken);
}

/* A ball is put there, taken to elsewhere, put there again and destroyed. */
static void PutAndTake(Host* host, kiriSheet sheet, float u, uint32_t woken)
{
    static const float eye[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, far[3] = { 0.5f, 0.5f, -3.0f };
    const float there[3] = { u, 0.5f, -0.032f };
    kiriObstacle ball = AddBall(host, far[0], far[1], far[2], 0.0f);
    for (int round = 0; round < 2; ++round) {
        OK(kiriObstacle_SetPose(host->world, ball, there, eye));
        Tick(host);
        assert_int_equal(Awake(host, sheet), woken);
        SleepAll(host, sheet);
        OK(round == 0 ? kiriObstacle_SetPose(host->world, ball, far, eye) : kiriDestroyObstacle(host->world, ball));
        assert_int_equal(Awake(host, sheet), woken);
        SleepAll(host, sheet);
    }
}

/* Where a strip has left a large sheet is no piece: an obstacle that moves there, is put there or taken away, in
   a sheet that sleeps or of which a strip moves, wakes what is beside the gap, and that alone. */
TEST(ObstacleBesideGone)
{
    static const float places[3] = { 0.39f, 0.527f, 0.233f }; /* amid the strip that left; near the strip after, and before it */
    static const int woken[3] = { -1, 2, 0 };
    for (int run = 0; run < 12; ++run) {
        int place = run % 3;
        bool isMoving = run / 3 % 2 == 0, detaches = run >= 6;
        kiriSheet part;
        kiriSheetDef def = StripsDef();
        START_HOST(host);
        host.every = 8;
        kiriSheet sheet = AddFineStrips(&host, &def, 68);
        if (detaches) {
            OK(kiriFrame_DetachPiece(host.world, FrameAt(&host, sheet, 1), &part));
            OK(kiriDestroySheet(host.world, part));
        } else {
            OK(kiriFrame_DestroyPiece(host.world, FrameAt(&host, sheet, 1)));
        }
        SleepAll(&host, sheet);
        uint32_t beside = woken[place] >= 0 ? Bit(&host, sheet, woken[place]) : 0;
        if (isMoving) {
            PassThrough(&host, sheet, places[place], detaches, beside);
        } else {
            PutAndTake(&host, sheet, places[place], beside);
        }
    }
}

/* Strips on a floor sleep while one is pushed about. All the while the floor bears the weight of all. */
TEST(FloorBearsSleepers)
{
    static const float down[3] = { 0.0f, 0.0f, -9.81f };
    kiriSheetDef def = StripsDef();
    kiriObstacleState felt;
    def.position[2] = 0.001f;
    START_HOST(host);
    kiriSheet sheet = AddStrips(&host, &def);
    kiriObstacle floor = World_AddFloor(host.world);
    OK(kiriWorld_SetGravity(host.world, down));
    double weight = 9.81 * Host_Totals(&host, sheet).mass;
    for (int k = 0; k < 240; ++k) {
        const float push[3] = { k % 2 == 0 ? 0.3f : -0.3f, 0.0f, 0.0f };
        OK(kiriFrame_ApplyForce(host.world, FrameAt(&host, sheet, 2), push, (const float[3]){ 0.0f, 0.0f, 0.0f }));
        Tick(&host);
        OK(kiriObstacle_GetState(host.world, floor, &felt));
        if (k > 120) {
            assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 2));
            assert_true(fabs(-felt.impulse[2] / (weight * (double)dt) - 1.0) < 0.02);
        }
    }
    int32_t contacts = felt.contacts;
    SleepAll(&host, sheet);
    Tick(&host);
    OK(kiriObstacle_GetState(host.world, floor, &felt));
    assert_true(fabs(-felt.impulse[2] / (weight * (double)dt) - 1.0) < 0.02 && felt.contacts >= contacts / 2);
}

/* What a table bears of strips that sleep follows the length of the tick, and where its centre of mass is: it is moved
   too little to wake anybody. */
TEST(WhatSleepersPressWith)
{
    static const float down[3] = { 0.0f, 0.0f, -9.81f }, eye[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    float at[3] = { 0.5f, 0.5f, -0.1f };
    kiriSheetDef def = StripsDef();
    kiriObstacleState is[3];
    def.position[2] = 0.001f;
    START_HOST(host);
    kiriSheet sheet = AddStrips(&host, &def);
    kiriObstacleDef tableDef = ObstacleOf(KIRI_OBSTACLE_BOX);
    tableDef.size[0] = tableDef.size[1] = 3.0f;
    tableDef.size[2] = 0.2f;
    memcpy(tableDef.position, at, sizeof(at));
    kiriObstacle table = World_AddObstacle(host.world, &tableDef);
    OK(kiriWorld_SetGravity(host.world, down));
    SleepAll(&host, sheet);
    for (int k = 0; k < 3; ++k) {
        OK(Host_Tick(&host, k == 1 ? 0.5f * dt : dt, 2));
        OK(kiriObstacle_GetState(host.world, table, &is[k]));
        at[0] += k == 1 ? 1e-4f : 0.0f;
        OK(kiriObstacle_SetPose(host.world, table, at, eye));
    }
    assert_int_equal(Awake(&host, sheet), 0);
    assert_true(fabs(-is[0].impulse[2] / (9.81 * Host_Totals(&host, sheet).mass * (double)dt) - 1.0) < 0.02);
    for (int k = 0; k < 3; ++k) {
        double turn = is[0].angularImpulse[k] + (k == 1 ? 1e-4 * is[0].impulse[2] : 0.0);
        assert_true(fabs(is[1].impulse[k] - 0.5 * is[0].impulse[k]) < 1e-12);
        assert_true(fabs(is[2].impulse[k] - is[0].impulse[k]) < 1e-12);
        assert_true(fabs(is[1].angularImpulse[k] - 0.5 * is[0].angularImpulse[k]) < 1e-12);
        assert_true(fabs(is[2].angularImpulse[k] - turn) < 1e-3 * 1e-4 * fabs(is[0].impulse[2]));
    }
    assert_true(is[0].contacts > 0 && is[1].contacts == is[0].contacts && is[2].contacts == is[0].contacts);
}

/* ---- Pieces that touch ---- */

/* The first strip is carried over the second, and laid down there. */
TEST(PiecesThatTouch)
{
    static const float down[3] = { 0.0f, 0.0f, -9.81f };
    static const struct {
        float velocity[3];
        int ticks;
    } ways[] = { { { 0.0f, 0.0f, 0.6f }, 6 }, { { 1.0f, 0.0f, 0.0f }, 15 }, { { 0.0f, 0.0f, 0.0f }, 1 } };
    kiriSheetDef def = StripsDef();
    def.material.airDamping = 0.5f;
    def.touchesSheets = 1;
    def.contactThickness = 0.01f;
    def.position[2] = 0.005f;
    START_HOST(host);
    kiriSheet sheet = AddStrips(&host, &def);
    World_AddFloor(host.world);
    for (size_t i = 0; i < sizeof(ways) / sizeof(ways[0]); ++i) {
        for (int k = 0; k < ways[i].ticks; ++k) {
            OK(kiriFrame_SetPieceVelocity(host.world, FrameAt(&host, sheet, 0), ways[i].velocity, noVector));
            Tick(&host);
        }
    }
    OK(kiriFrame_DestroyPiece(host.world, FrameAt(&host, sheet, 2))); /* so that the last one touches noVector */
    OK(kiriWorld_SetGravity(host.world, down));
    uint32_t both = Bit(&host, sheet, 0) | Bit(&host, sheet, 1), awake = 15;
    int together = 0;
    for (int k = 0; k < 900 && (awake & both) != 0; ++k) {
        const float push[3] = { k % 2 == 0 ? 0.3f : -0.3f, 0.0f, 0.0f };
        OK(kiriFrame_ApplyForce(host.world, FrameAt(&host, sheet, 3), push, noVector));
        Tick(&host);
        awake = Awake(&host, sheet);
        together += (awake & both) == both;
        assert_true((awake & both) == 0 || (awake & both) == both);
    }
    assert_true(together > HALF_SECOND && (awake & both) == 0 && awake == Bit(&host, sheet, 3));
    double above = World_PieceState(host.world, sheet, StripAt(&host, sheet, 0)).center[2];
    assert_true(above > 0.01 && above < 0.03);
    /* What wakes one of them wakes the other. */
    OK(kiriFrame_ApplyForce(host.world, FrameAt(&host, sheet, 1), (const float[3]){ 0.0f, 0.0f, 1e-3f }, noVector));
    Tick(&host);
    Tick(&host);
    assert_int_equal(Awake(&host, sheet) & both, both);
}

/* ---- Parts ---- */

/* A piece that sleeps sleeps on as a sheet of its own, and so do those that are left. */
TEST(DetachAsleep)
{
    HOST(host);
    kiriSheet sheet = StartStrips(&host), part;
    SleepAll(&host, sheet);
    Throw(&host, sheet, 0, 0.5f);
    OK(kiriFrame_DetachPiece(host.world, FrameAt(&host, sheet, 2), &part));
    int32_t awake = World_IsAwake(host.world, part);
    assert_false(awake);
    assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 0));
    OK(kiriFrame_DestroyPiece(host.world, FrameAt(&host, sheet, 0)));
    assert_int_equal(Awake(&host, sheet), 0);
    Tick(&host);
    Throw(&host, sheet, 1, 0.5f);
    Tick(&host);
    assert_int_equal(Awake(&host, sheet), Bit(&host, sheet, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
}

/* ---- Memory ---- */
