/* A blade that goes on: whatever the sheet does between its moves, it parts what it goes through, and nothing else. */
#include "host.h"

typedef struct Stage {
    Host host;
    kiriSheet sheet;
    kiriBlade blade;
} Stage;

/* ---- Sheets ---- */

static kiriSheetDef Def(int32_t grid, int32_t frames)
{
    kiriSheetDef def = SheetOf(grid, frames);
    def.collisionPoints = 0;
    return def;
}

/* A sheet of 1 m in the plane of x and y, that nothing pulls at. */
static void Stage_Stop(Stage* stage)
{
    Host_Stop(&stage->host);
}

static void Stage_StartFlat(Stage* stage, int32_t grid, int32_t frames)
{
    kiriSheetDef def = Def(grid, frames);
    Host_Start(&stage->host);
    stage->host.every = 20;
    World_StopGravity(stage->host.world);
    stage->sheet = Host_AddRectangle(&stage->host, &def, 1.0f, 1.0f, grid, grid);
}

/* A curtain in the plane of x and z, pinned at its upper corners. */
static void Stage_StartCurtain(Stage* stage, int32_t grid, int32_t ticks)
{
    kiriSheetDef def = Def(grid, 9);
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    Host_Start(&stage->host);
    stage->host.every = 40;
    stage->sheet = Host_AddRectangle(&stage->host, &def, 1.0f, 1.0f, grid, grid);
    for (int k = 0; k < 2; ++k) {
        Host_Pin(&stage->host, stage->sheet, (float)k, 1.0f, (float)k, 0.0f, 1.0f);
    }
    Host_Ticks(&stage->host, ticks, 1.0f / 60.0f, 2);
}

static int32_t Pieces(const Stage* stage)
{
    return Host_Counts(&stage->host, stage->sheet).pieces;
}

static double LeastArea(Stage* stage)
{
    double least = 1e9;
    for (int32_t i = 0; i < Pieces(stage); ++i) {
        kiriPieceState piece = World_PieceState(stage->host.world, stage->sheet, i);
        least = piece.area < least ? piece.area : least;
    }
    return least;
}

/* ---- Moves ---- */

/* An edge along z over a place. */
static void MoveTo(Stage* stage, double x, double y)
{
    const float from[3] = { (float)x, (float)y, -1.0f }, to[3] = { (float)x, (float)y, 1.0f };
    OK(kiriBlade_MoveEdge(stage->host.world, stage->blade, from, to));
}

static void Tick(Stage* stage)
{
    OK(Host_Tick(&stage->host, 1.0f / 60.0f, 1));
}

/* From one place to another, a tick after each step. */
static void Draw(Stage* stage, double x0, double y0, double x1, double y1, int32_t steps)
{
    for (int32_t i = 0; i <= steps; ++i) {
        MoveTo(stage, x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps);
        Tick(stage);
    }
}

static void Begin(Stage* stage)
{
    OK(kiriBeginBlade(stage->host.world, stage->sheet, &stage->blade));
}

static void EndAndTick(Stage* stage)
{
    OK(kiriBlade_End(stage->host.world, stage->blade));
    Tick(stage);
    Tick(stage);
}

/* ---- Swipes ---- */

enum { AT_REST, IN_WIND, SLOW_MOTION, MOTIONS };

typedef struct Swipe {
    int32_t grid, steps, motion, budget; /* budget 0: none */
    double height, wave;
} Swipe;

/* Gusts push it to and fro, and lips apart. */
static void Blow(const Stage* stage, int32_t step)
{
    const float force[3] = { 0.0f, step / 3 % 2 == 0 ? -1.5f : 1.5f, 0.3f };
    kiriFrame frames[64];
    int32_t count = World_GetFrames(stage->host.world, stage->sheet, frames, 64);
    OK(kiriFrame_ApplyForce(stage->host.world, frames[count / 2], force, noVector));
    OK(kiriFrame_ApplyForce(stage->host.world, frames[0], force, noVector));
}

/* The ray of a mouse, seen from 2 m in front of the curtain. */
static void MoveMouse(const Stage* stage, const Swipe* swipe, double share)
{
    static const float eye[3] = { 0.5f, -2.0f, 0.5f };
    double turn = 3.0 * share, bow = turn - floor(turn); /* three arches */
    const float way[3] = { (float)(-0.65 + 1.3 * share), 2.0f,
                           (float)(swipe->height + swipe->wave * 4.0 * bow * (1.0 - bow)) };
    OK(kiriBlade_MoveRay(stage->host.world, stage->blade, eye, way, 20.0f));
}

static void Finish(Stage* stage)
{
    int32_t ticks = 0;
    kiriResult result = KIRI_PENDING;
    for (; result == KIRI_PENDING || ticks < 5; ++ticks) {
        result = Host_Tick(&stage->host, 1.0f / 60.0f, 1);
        assert_true(result >= 0 && ticks < 5000);
    }
}

static void CheckSwipe(const Swipe* swipe)
{
    SCOPED(Stage, stage, Stage_Stop);
    const kiriBudget budget = { 4 * swipe->budget, 40 * swipe->budget, 40 * swipe->budget, 0 };
    Stage_StartCurtain(&stage, swipe->grid, swipe->motion == AT_REST ? 100 : 20);
    OK(kiriWorld_SetBudget(stage.host.world, &budget));
    Begin(&stage);
    for (int32_t i = 0; i <= swipe->steps; ++i) {
        MoveMouse(&stage, swipe, (double)i / swipe->steps);
        if (swipe->motion == IN_WIND) {
            Blow(&stage, i);
        }
        assert_true(Host_Tick(&stage.host, swipe->motion == SLOW_MOTION ? 1.0f / 600.0f : 1.0f / 60.0f, 2) >= 0);
    }
    OK(kiriBlade_End(stage.host.world, stage.blade));
    Finish(&stage);
    if (Pieces(&stage) != 2 || LeastArea(&stage) < 0.1) {
        fail_msg("grid %d, %d steps, motion %d, budget %d, height %g, wave %g: %d pieces, the least %g",
                 (int)swipe->grid, (int)swipe->steps, (int)swipe->motion, (int)swipe->budget, swipe->height,
                 swipe->wave, (int)Pieces(&stage), LeastArea(&stage));
    }
}

/* Once across, in one step or many, part it, each time. */
TEST(SwipesPart)
{
    static const int32_t steps[4] = { 1, 3, 20, 90 };
    for (int32_t motion = 0; motion < MOTIONS; ++motion) {
        for (int k = 0; k < RUNS(16); ++k) {
            const Swipe swipe = { 32, steps[k % 4], motion, k % 8 < 4 ? 0 : 10, 0.0, k < 8 ? 0.0 : 0.1 };
            CheckSwipe(&swipe);
        }
    }
    for (int k = 0; k < 2; ++k) {
        const Swipe fine = { 128, 20, k == 0 ? AT_REST : IN_WIND, 0, k == 0 ? 0.1 : -0.1, k == 0 ? 0.0 : 0.1 };
        CheckSwipe(&fine);
    }
}

/* ---- Paths ---- */

/* A circle that a hand draws on a curtain in a light wind: it comes round beside where it began, and the curtain is
   elsewhere by then. The hand first waits for `held` ticks. Slivers may come off where it overlaps. Returns whether a
   disc came off. */
static bool IsDiscCut(int k, int32_t held, double radius, double widening)
{
    static const float eye[3] = { 0.5f, -2.0f, 0.5f };
    SCOPED(Stage, stage, Stage_Stop);
    int32_t steps = 6 + 7 * k, large = 0, count;
    Stage_StartCurtain(&stage, 16 + 2 * k, 20);
    Begin(&stage);
    for (int32_t t = -held; t <= steps + steps / 10; ++t) {
        int32_t i = t > 0 ? t : 0;
        double turn = 6.283185307179586 * i / steps, r = radius * (1.0 + widening * i / steps);
        const float way[3] = { (float)(r * cos(turn)), 2.0f, (float)(r * sin(turn)) };
        const float force[3] = { 0.0f, 0.05f * (float)((t + held) / 4 % 2) - 0.025f, 0.0f };
        kiriFrame frames[64];
        OK(kiriBlade_MoveRay(stage.host.world, stage.blade, eye, way, 20.0f));
        OK(kiriSheet_GetFrames(stage.host.world, stage.sheet, frames, 64, &count));
        OK(kiriFrame_ApplyForce(stage.host.world, frames[(t + held) % count], force, noVector));
        Tick(&stage);
    }
    EndAndTick(&stage);
    for (int32_t i = 0; i < Pieces(&stage); ++i) {
        large += World_PieceState(stage.host.world, stage.sheet, i).area > 2.0 * radius * radius;
    }
    return large == 2;
}

static int32_t CountDiscs(int32_t count, int32_t held)
{
    uint32_t seed = 2;
    int32_t discs = 0;
    for (int k = 0; k < count; ++k) {
        double radius = RandomBetween(&seed, 0.06, 0.2);
        discs += IsDiscCut(k % 12, held, radius, RandomBetween(&seed, -0.02, 0.02));
    }
    return discs;
}

TEST(CirclesByHand)
{
    assert_int_equal(CountDiscs(RUNS(36), 0), RUNS(36));
}

/* A blade that waits where the circle begins closes it as well. */
TEST(CirclesAfterWaiting)
{
    assert_int_equal(CountDiscs(12, 10), 12);
}

/* A loop that ends where it began, to the bit, is closed. */
TEST(ClosedLoop)
{
    static const double corners[5][2] = { { 0.3, 0.3 }, { 0.7, 0.32 }, { 0.68, 0.7 }, { 0.31, 0.69 }, { 0.3, 0.3 } };
    SCOPED(Stage, stage, Stage_Stop);
    Stage_StartFlat(&stage, 16, 8);
    Begin(&stage);
    for (int k = 0; k < 5; ++k) {
        MoveTo(&stage, corners[k][0], corners[k][1]);
        Tick(&stage);
    }
    EndAndTick(&stage);
    assert_int_equal(Pieces(&stage), 2);
    assert_true(LeastArea(&stage) > 0.1);
}

/* A blade that stands in a sheet at rest does nothing. */
TEST(StandsStill)
{
    SCOPED(Stage, stage, Stage_Stop);
    Stage_StartFlat(&stage, 16, 8);
    Begin(&stage);
    uint32_t revision = Host_Mesh(&stage.host, stage.sheet).revision;
    for (int k = 0; k < 30; ++k) {
        MoveTo(&stage, 0.4, 0.6);
        Tick(&stage);
    }
    assert_int_equal(Host_Mesh(&stage.host, stage.sheet).revision, revision);
    Draw(&stage, 0.4, 0.6, 1.2, 0.6, 3);
    revision = Host_Mesh(&stage.host, stage.sheet).revision;
    Draw(&stage, 1.3, 0.6, 1.3, 0.2, 3); /* outside */
    EndAndTick(&stage);
    assert_int_equal(Host_Mesh(&stage.host, stage.sheet).revision, revision);
    assert_int_equal(Pieces(&stage), 1);
}

/* Out over a border, back in, and out again: each time it parts. */
TEST(LeavesAndComesBack)
{
    SCOPED(Stage, stage, Stage_Stop);
    Stage_StartFlat(&stage, 16, 8);
    Begin(&stage);
    Draw(&stage, -0.1, 0.25, 1.1, 0.31, 11);
    assert_int_equal(Pieces(&stage), 2);
    Draw(&stage, 1.1, 0.31, 1.1, 0.72, 3);
    Draw(&stage, 1.1, 0.72, -0.1, 0.68, 7);
    assert_int_equal(Pieces(&stage), 3);
    Draw(&stage, -0.1, 0.68, 0.5, -0.1, 1);
    Draw(&stage, 0.5, -0.1, 0.51, 1.1, 40); /* across its own cuts */
    EndAndTick(&stage);
    assert_int_equal(Pieces(&stage), 8);
    assert_true(LeastArea(&stage) > 0.01);
}

/* An edge that ends above the sheet for half of its way cuts the other half. */
TEST(ShortEdge)
{
    SCOPED(Stage, stage, Stage_Stop);
    double longest = 0.0;
    Stage_StartFlat(&stage, 16, 8);
    Begin(&stage);
    for (int k = 0; k <= 24; ++k) {
        const float x = -0.1f + 1.2f * (float)k / 24.0f, to[3] = { x, 0.55f, 1.0f }, from[3] = { x, 0.55f, x - 0.503f };
        OK(kiriBlade_MoveEdge(stage.host.world, stage.blade, from, to));
        Tick(&stage);
    }
    EndAndTick(&stage);
    assert_int_equal(Pieces(&stage), 1);
    kiriMesh mesh = Host_Mesh(&stage.host, stage.sheet);
    for (int32_t v = 17 * 17; v < mesh.vertexCount; ++v) {
        const float* rest = &mesh.restPositions[2 * (size_t)v];
        assert_float_equal(rest[1], 0.55f, 1e-4f);
        longest = rest[0] > longest ? rest[0] : longest;
    }
    assert_float_equal(longest, 0.503f, 1e-4f);
}

/* An edge that turns while it moves, fast. */
TEST(TurningEdge)
{
    for (int steps = 1; steps < 12; steps += 5) {
        SCOPED(Stage, stage, Stage_Stop);
        Stage_StartFlat(&stage, 16, 8);
        Begin(&stage);
        for (int k = 0; k <= steps; ++k) {
            double x = -0.3 + 1.6 * k / steps, tilt = -0.6 + 1.2 * k / steps;
            const float from[3] = { (float)x, (float)(0.45 - tilt), -1.0f },
                        to[3] = { (float)x, (float)(0.45 + tilt), 1.2f };
            OK(kiriBlade_MoveEdge(stage.host.world, stage.blade, from, to));
            Tick(&stage);
        }
        EndAndTick(&stage);
        assert_int_equal(Pieces(&stage), 2);
        assert_true(LeastArea(&stage) > 0.2);
    }
}

/* ---- Layers ---- */

/* Folded in half over x = 0.5, the upper layer 0.1 m above the lower. */
static void StartFolded(Stage* stage)
{
    static const float turned[9] = { -1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, -1.0f };
    float points[16];
    kiriFrame frames[8];
    for (int k = 0; k < 8; ++k) {
        points[2 * k] = 0.125f + 0.25f * (float)(k / 2);
        points[2 * k + 1] = 0.25f + 0.5f * (float)(k % 2);
    }
    kiriSheetDef def = Def(16, 8);
    def.framePoints = points;
    Host_Start(&stage->host);
    World_StopGravity(stage->host.world);
    stage->sheet = Host_AddRectangle(&stage->host, &def, 1.0f, 1.0f, 16, 16);
    int32_t count = World_GetFrames(stage->host.world, stage->sheet, frames, 8);
    assert_int_equal(count, 8);
    for (int k = 0; k < 8; ++k) {
        const float u = points[2 * k], at[3] = { u < 0.5f ? u : 1.0f - u, points[2 * k + 1], u < 0.5f ? 0.0f : 0.1f };
        OK(kiriFrame_Hold(stage->host.world, frames[k], at, u < 0.5f ? worldAxes : turned));
    }
    Tick(stage);
}

/* Through both layers beside each other; and over the fold, from the open side or from the fold's. */
TEST(Fold)
{
    static const double ways[3][4] = { { 0.2, -0.2, 0.23, 1.2 }, { -0.2, 0.5, 0.8, 0.52 }, { 0.8, 0.5, -0.2, 0.53 } };
    for (int k = 0; k < 9; ++k) {
        static const int32_t steps[3] = { 1, 20, 111 };
        const double* way = ways[k / 3];
        SCOPED(Stage, stage, Stage_Stop);
        StartFolded(&stage);
        Begin(&stage);
        Draw(&stage, way[0], way[1], way[2], way[3], steps[k % 3]);
        EndAndTick(&stage);
        if (Pieces(&stage) != (k < 3 ? 3 : 2) || LeastArea(&stage) < 0.15) {
            fail_msg("way %d, %d steps: %d pieces, the least %g", k / 3, (int)steps[k % 3], (int)Pieces(&stage),
                     LeastArea(&stage));
        }
    }
}

/* Every frame of a piece gets the same push. */
static void Push(const Stage* stage, int32_t piece, float y, float z)
{
    const float push[3] = { 0.0f, y, z };
    const kiriFrame* frames;
    int32_t count;
    OK(kiriSheet_GetPieceFrames(stage->host.world, stage->sheet, piece, &frames, &count));
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_ApplyForce(stage->host.world, frames[i], push, noVector));
    }
}

/* Three strips that drift apart while the blade goes through them. */
TEST(SeveralPieces)
{
    for (int steps = 1; steps <= 40; steps += 13) {
        static const float lines[2][4] = { { 0.35f, -0.1f, 0.35f, 1.1f }, { 0.7f, -0.1f, 0.7f, 1.1f } };
        SCOPED(Stage, stage, Stage_Stop);
        Stage_StartFlat(&stage, 16, 12);
        Host_Cut(&stage.host, stage.sheet, lines[0], 2);
        Host_Cut(&stage.host, stage.sheet, lines[1], 2);
        Tick(&stage);
        for (int32_t piece = 0; piece < 3; ++piece) {
            Push(&stage, piece, 0.5f * (float)(piece - 1), 0.5f * (float)piece);
        }
        Begin(&stage);
        Draw(&stage, -0.2, 0.5, 1.2, 0.52, steps);
        EndAndTick(&stage);
        if (Pieces(&stage) != 6 || LeastArea(&stage) < 0.02) {
            fail_msg("%d steps: %d pieces, the least %g", steps, (int)Pieces(&stage), LeastArea(&stage));
        }
    }
}

/* One blade for all sheets. */
TEST(AllSheets)
{
    SCOPED(Stage, stage, Stage_Stop);
    kiriSheet others[2];
    Stage_StartFlat(&stage, 16, 8);
    kiriSheetDef def = Def(12, 6);
    for (int k = 0; k < 2; ++k) {
        def.position[2] = 0.2f * (float)(k + 1);
        def.position[0] = 0.1f * (float)k;
        others[k] = Host_AddRectangle(&stage.host, &def, 1.0f, 1.0f, 12, 12);
    }
    OK(kiriBeginBlade(stage.host.world, 0, &stage.blade));
    Draw(&stage, -0.2, 0.5, 1.3, 0.52, 13);
    EndAndTick(&stage);
    assert_int_equal(Pieces(&stage), 2);
    assert_int_equal(Host_Counts(&stage.host, others[0]).pieces, 2);
    assert_int_equal(Host_Counts(&stage.host, others[1]).pieces, 2);
}

/* ---- Sheets that move ---- */

/* A blade that falls with the sheet and crosses it meanwhile leaves one straight line, without hairs at its steps. */
TEST(FallsAlong)
{
    SCOPED(Stage, stage, Stage_Stop);
    kiriSheetDef def = Def(16, 8);
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    Host_Start(&stage.host);
    stage.sheet = Host_AddRectangle(&stage.host, &def, 1.0f, 1.0f, 16, 16);
    Begin(&stage);
    double fallen = 0.0, speed = 0.0;
    for (int k = 0; k <= 30; ++k) {
        const float x = -0.1f + 1.2f * (float)k / 30.0f, z = (float)(0.53 - fallen);
        const float from[3] = { x, -1.0f, z }, to[3] = { x, 1.0f, z };
        OK(kiriBlade_MoveEdge(stage.host.world, stage.blade, from, to));
        Tick(&stage);
        kiriTotals totals = Host_Totals(&stage.host, stage.sheet);
        fallen = 0.5 - totals.center[2];
        speed = totals.momentum[2] / totals.mass;
    }
    EndAndTick(&stage);
    assert_true(speed < -4.0);
    assert_int_equal(Pieces(&stage), 2);
    kiriMesh mesh = Host_Mesh(&stage.host, stage.sheet);
    for (int32_t v = 17 * 17; v < mesh.vertexCount; ++v) {
        assert_float_equal(mesh.restPositions[2 * (size_t)v + 1], 0.53f, 2e-3f);
    }
}

/* A piece gets a sheet of its own while the blade is in it: a blade for all goes on in it. */
TEST(Detached)
{
    static const float line[4] = { -0.1f, 0.3f, 1.1f, 0.3f };
    for (int lower = 0; lower < 2; ++lower) {
        SCOPED(Stage, stage, Stage_Stop);
        Stage_StartFlat(&stage, 16, 8);
        Host_Cut(&stage.host, stage.sheet, line, 2);
        Tick(&stage);
        OK(kiriBeginBlade(stage.host.world, 0, &stage.blade));
        double y = lower ? 0.15 : 0.6;
        Draw(&stage, -0.1, y, 0.5, y, 5);
        kiriFrame frame = 0;
        for (int32_t piece = 0; piece < 2; ++piece) {
            kiriPieceState at = World_PieceState(stage.host.world, stage.sheet, piece);
            frame = at.center[1] > 0.3 ? frame : Host_FrameOf(&stage.host, stage.sheet, piece);
        }
        kiriSheet detached = World_Detach(stage.host.world, frame);
        Draw(&stage, 0.6, y, 1.1, y, 5);
        EndAndTick(&stage);
        assert_int_equal(Pieces(&stage), lower ? 1 : 2);
        assert_int_equal(Host_Counts(&stage.host, detached).pieces, lower ? 2 : 1);
    }
}

/* In the tick of the cut the part that falls is apart from the part that is held, by what it falls in it: 3/4 g dt^2 in
   two steps. */
TEST(OpensAtOnce)
{
    const double dt = 1.0 / 60.0, fallen = 0.75 * 9.81 * dt * dt;
    SCOPED(Stage, stage, Stage_Stop);
    Stage_StartCurtain(&stage, 32, 200);
    static const float from[3] = { -0.2f, -1.0f, 0.5f }, to[3] = { -0.2f, 1.0f, 0.5f };
    static const float beyond[2][3] = { { 1.2f, -1.0f, 0.5f }, { 1.2f, 1.0f, 0.5f } };
    Begin(&stage);
    OK(kiriBlade_MoveEdge(stage.host.world, stage.blade, from, to));
    OK(kiriBlade_MoveEdge(stage.host.world, stage.blade, beyond[0], beyond[1]));
    OK(Host_Tick(&stage.host, (float)dt, 2));
    assert_int_equal(Pieces(&stage), 2);
    kiriMesh mesh = Host_Mesh(&stage.host, stage.sheet);
    double gap = 0.0;
    int32_t lips = 0;
    for (int32_t a = 33 * 33; a < mesh.vertexCount; ++a) {
        for (int32_t b = a + 1; b < mesh.vertexCount; ++b) {
            const float *p = &mesh.restPositions[2 * (size_t)a], *q = &mesh.restPositions[2 * (size_t)b];
            if (p[0] == q[0] && p[1] == q[1]) {
                gap += fabs(mesh.positions[3 * (size_t)a + 2] - mesh.positions[3 * (size_t)b + 2]);
                ++lips;
            }
        }
    }
    assert_true(lips > 30);
    if (gap / lips < 0.7 * fallen) {
        fail_msg("lips are %g m apart, and %g m have been fallen", gap / lips, fallen);
    }
}

/* ---- Calls ---- */

/* Edges of any size, and of none. */
TEST(ExtremeEdges)
{
    static const float edges[8][6] = {
        { 0.5f, -1.0f, 0.0f, 0.5f, 2.0f, 0.0f },   { 3e38f, -3e38f, 3e38f, -3e38f, 3e38f, -3e38f },
        { 0.5f, 0.5f, -1e30f, 0.5f, 0.5f, 1e30f }, { 0.6f, 0.6f, 0.0f, 0.6f, 0.6f, 0.0f },
        { -1.0f, 0.4f, 0.0f, 2.0f, 0.4f, 0.0f },   { 0.3f, 0.3f, -1e-30f, 0.3f, 0.3f, 1e-30f },
        { 0.2f, 0.2f, -1.0f, 0.8f, 0.8f, 1.0f },   { 0.8f, 0.8f, 1.0f, 0.2f, 0.2f, -1.0f }
    };
    SCOPED(Stage, stage, Stage_Stop);
    Stage_StartFlat(&stage, 8, 4);
    Begin(&stage);
    for (int k = 0; k < 64; ++k) {
        const float* edge = edges[(3 * k + k / 8) % 8];
        OK(kiriBlade_MoveEdge(stage.host.world, stage.blade, edge, edge + 3));
        OK(Host_Tick(&stage.host, 1e-3f, 1));
    }
    OK(kiriBlade_End(stage.host.world, stage.blade));
}

enum { CALLS = 24 };

/* A swipe, call by call. */
static kiriResult Call(Stage* stage, int k)
{
    kiriWorld* w = stage->host.world;
    const float x = -0.2f + 0.07f * (float)k, y = 0.4f + (float)(k % 5) * 0.03f;
    const float from[3] = { x, y, -1.0f }, to[3] = { x, y + 0.02f, 1.0f };
    return k == 0           ? kiriBeginBlade(w, 0, &stage->blade)
           : k == CALLS - 2 ? kiriBlade_End(w, stage->blade)
           : k % 3 == 0     ? Host_Tick(&stage->host, 0.01f, 1)
           : k == CALLS - 1 ? Host_Tick(&stage->host, 0.01f, 1)
                            : kiriBlade_MoveEdge(w, stage->blade, from, to);
}

/* Rays that somebody casts in between make no difference, though they make boxes. */
TEST(RaysMakeNoDifference)
{
    uint64_t hashes[2];
    for (int asks = 0; asks < 2; ++asks) {
        SCOPED(Stage, stage, Stage_Stop);
        Stage_StartFlat(&stage, 16, 8);
        for (int k = 0; k < CALLS; ++k) {
            const float origin[3] = { 0.3f, 0.4f, 2.0f }, down[3] = { 0.0f, 0.0f, -1.0f };
            kiriHit hit;
            OK(Call(&stage, k));
            if (asks) {
                OK(kiriSheet_Raycast(stage.host.world, stage.sheet, origin, down, 9.0f, &hit));
            }
        }
        hashes[asks] = Host_Hash(&stage.host);
    }
    assert_true(hashes[0] == hashes[1]);
}

/* A ray goes straight through a sheet that falls: two pieces, and no crumb. */
TEST(FallingSheets)
{
    for (int32_t k = 0; k < 120; ++k) {
        SCOPED_WORLD(world) = NULL;
        kiriWorldDef worldDef = DefaultWorld();
        kiriSheetDef sheetDef = DefaultSheet();
        worldDef.gravity[1] = -1.0f - (float)(k % 10);
        sheetDef.frameCount = 1 + k % 7;
        OK(kiriCreateWorld(&worldDef, &world));
        kiriSheet sheet = World_AddRectangle(world, 1.0f, 0.5f, 8 << k % 3, 4 << k % 3, &sheetDef);
        kiriBlade blade = World_BeginBlade(world, sheet);
        const int32_t steps = 6 + k % 25;
        for (int32_t i = 0; i < steps; ++i) {
            const float along = (float)i / (float)(steps - 1), height = 0.12f + 0.0026f * (float)(k * 37 % 100);
            const float origin[3] = { 1.2f * along - 0.1f, height, 1.0f }, direction[3] = { 0.0f, 0.0f, -1.0f };
            OK(kiriBlade_MoveRay(world, blade, origin, direction, 2.0f));
            OK(kiriWorld_Tick(world, 1.0f / 60.0f, 1 + k % 2));
        }
        OK(kiriBlade_End(world, blade));
        OK(kiriWorld_Tick(world, 1.0f / 60.0f, 1));
        assert_int_equal(World_Counts(world, sheet).pieces, 2);
    }
}
