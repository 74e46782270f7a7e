/* How a world behaves, seen through the public header alone. */
#include "defaults.h"
#include "look.h"

static const float eye[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };

static void Tick(Host* host, float dt, int32_t substeps)
{
    OK(Host_Tick(host, dt, substeps));
}

static void AssertNear(double a, double b, double tolerance, const char* what)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%s: %.17g is not %.17g, off by %g", what, a, b, fabs(a - b));
    }
}

static double Distance(const double* a, const double* b)
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* ---- Memory ---- */

TEST(MemoryForWorld)
{
    for (int n = 0;; ++n) {
        Host host;
        memset(&host, 0, sizeof(host));
        host.failAt = n;
        kiriWorldDef def = Host_Def(&host);
        host.world = (kiriWorld*)&host;
        kiriResult result = kiriCreateWorld(&def, &host.world);
        if (result == KIRI_OK) {
            assert_true(n > 0);
            host.failAt = -1;
            Host_Stop(&host);
            return;
        }
        assert_int_equal(result, KIRI_ERROR_MEMORY);
        assert_null(host.world);
        assert_int_equal(host.live, 0);
    }
}

/* ---- Worlds and sheets beside each other ---- */

static uint64_t LookAt(const Host* host, kiriSheet sheet)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    return Look_Mesh(0, &mesh);
}

TEST(SheetsAreApart)
{
    static const float line[4] = { 0.5f, -0.1f, 0.52f, 1.1f };
    for (int order = 0; order < 6; ++order) {
        static const int orders[6][3] = {
            { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 }
        };
        Host host, single;
        kiriSheet sheets[3], lonely;
        kiriSheetDef def = Host_SmallDef();
        Host_Start(&host);
        Host_Start(&single);
        for (int i = 0; i < 3; ++i) {
            sheets[i] = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
        }
        lonely = Host_AddRectangle(&single, &def, 1.0f, 1.0f, 3, 3);
        Host_Pin(&host, sheets[1], 0.1f, 0.1f, 0.1f, 0.1f, 0.2f);
        Host_Pin(&single, lonely, 0.1f, 0.1f, 0.1f, 0.1f, 0.2f);
        Host_Cut(&host, sheets[0], line, 2);
        for (int i = 0; i < 5; ++i) {
            Tick(&host, 0.01f, 1);
            Tick(&single, 0.01f, 1);
        }
        assert_true(LookAt(&host, sheets[1]) == LookAt(&single, lonely));
        assert_true(LookAt(&host, sheets[0]) != LookAt(&host, sheets[2]));
        assert_true(Host_Counts(&host, sheets[0]).pieces == 2 && Host_Counts(&host, sheets[2]).pieces == 1);
        for (int i = 0; i < 3; ++i) {
            float point[2] = { 0.5f, 0.5f };
            World_BeginCut(host.world, sheets[orders[order][i]], point);
            OK(kiriDestroySheet(host.world, sheets[orders[order][i]]));
            Tick(&host, 0.01f, 1);
        }
        Host_Stop(&host);
        Host_Stop(&single);
    }
}

/* The hash tells apart what the coming ticks tell apart. */
TEST(HashSeesAll)
{
    uint64_t hashes[9];
    int same = 0;
    for (int what = 0; what < 9; ++what) {
        kiriSheetDef def = Host_SmallDef();
        float v[3] = { 0.0f, 0.0f, 1.0f }, up[3] = { 0.0f, 0.0f, 2.0f };
        float turned[9] = { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f };
        kiriFrame frame;
        START_HOST(host);
        def.material.youngsModulus *= what == 3 ? 2.0f : 1.0f;
        def.material.airDamping += what == 4 ? 1.0f : 0.0f;
        def.iterations += what == 5;
        def.snapDistance = what == 6 ? 0.01f : 0.0f;
        def.maxFrames -= what == 7;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
        World_GetFrames(host.world, sheet, &frame, 1);
        OK(kiriFrame_Hold(host.world, frame, what == 1 ? up : v, what == 2 ? turned : eye));
        if (what == 8) {
            OK(kiriFrame_Hold(host.world, frame, NULL, NULL));
        }
        hashes[what] = Host_Hash(&host);
        for (int other = 0; other < what; ++other) {
            if (hashes[other] == hashes[what]) {
                print_message("states %d and %d have the same hash\n", other, what);
                ++same;
            }
        }
    }
    assert_int_equal(same, 0);
}

/* ---- Motion ---- */

TEST(FreeFall)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    const float gravity[3] = { 0.5f, -0.25f, -9.81f }, dt = 0.0123f;
    def.material.airDamping = 0.0f;
    def.position[2] = 3.0f;
    def.velocity[0] = 1.5f;
    def.velocity[2] = 2.0f;
    OK(kiriWorld_SetGravity(host.world, gravity));
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    kiriTotals totals = Host_Totals(&host, sheet);
    double x[3] = { 0.5, 0.5, 3.0 }, v[3] = { 1.5, 0.0, 2.0 },
           mass = (double)def.material.density * def.material.thickness;
    AssertNear(Distance(totals.center, x), 0.0, 1e-9, "start");
    AssertNear(totals.mass, mass, 1e-9 * mass, "mass");
    for (int tick = 0; tick < 40; ++tick) {
        int32_t substeps = 1 + tick % 3;
        Tick(&host, dt, substeps);
        for (int32_t k = 0; k < substeps; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                double h = (double)dt / substeps, before = v[axis];
                v[axis] += (double)gravity[axis] * h;
                x[axis] += 0.5 * (before + v[axis]) * h;
            }
        }
        totals = Host_Totals(&host, sheet);
        for (int axis = 0; axis < 3; ++axis) {
            AssertNear(totals.center[axis], x[axis], 1e-9 * (1.0 + fabs(x[axis])), "center");
            AssertNear(totals.momentum[axis], mass * v[axis], 1e-9 * mass * (1.0 + fabs(v[axis])), "momentum");
        }
        AssertNear(totals.elasticEnergy, 0.0, 1e-12, "elastic energy");
        double kinetic = 0.5 * mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        AssertNear(totals.kineticEnergy, kinetic, 1e-8 * kinetic, "kinetic energy");
    }
}

TEST(AirDampingFades)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.material.airDamping = 2.0f;
    def.velocity[1] = 1.0f;
    World_StopGravity(host.world);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    double start = Host_Totals(&host, sheet).momentum[1];
    Host_Ticks(&host, 500, 0.001f, 1);
    AssertNear(Host_Totals(&host, sheet).momentum[1] / start, 0.36788, 2e-3, "exp(-1)"); /* first order in the step */
}

TEST(FramesAreHeld)
{
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 4);
    kiriFrame frames[4];
    kiriFrameState held;
    int32_t count = World_GetFrames(host.world, sheet, frames, 4);
    assert_int_equal(count, 4);
    float turned[9] = { 0.8f, 0.6f, 0.0f, -0.6f, 0.8f, 0.0f, 0.0f, 0.0f, 1.0f };
    for (int tick = 0; tick < 60; ++tick) {
        float at[3] = { 0.2f + 0.002f * (float)tick, 0.3f, 0.001f * (float)tick };
        bool moves = tick < 30;
        if (moves) {
            OK(kiriFrame_Hold(host.world, frames[0], at, turned));
        } else {
            at[0] = 0.2f + 0.002f * 29.0f;
            at[2] = 0.001f * 29.0f;
        }
        Tick(&host, 0.01f, 1 + tick % 3);
        OK(kiriFrame_GetState(host.world, frames[0], &held));
        assert_int_equal(held.held, 1);
        for (int k = 0; k < 3; ++k) {
            AssertNear(held.position[k], at[k], 1e-6, "held position");
        }
        for (int k = 0; k < 9; ++k) {
            AssertNear(held.rotation[k], turned[k], 1e-6, "held rotation");
        }
    }
    AssertNear(held.restPoint[0], 0.1875, 1e-6, "rest point");
    OK(kiriFrame_Hold(host.world, frames[0], NULL, NULL));
    Host_Ticks(&host, 20, 0.01f, 1);
    OK(kiriFrame_GetState(host.world, frames[0], &held));
    assert_true(held.held == 0 && held.position[2] < 0.0f);
}

TEST(ContactsCarry)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.position[2] = 0.3f;
    def.collisionPoints = 25;
    def.material.airDamping = 1.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    kiriContact contacts[64];
    const float* points;
    int32_t count;
    double lowest = 1.0;
    for (int tick = 0; tick < 240; ++tick) {
        OK(kiriSheet_GetCollisionPoints(host.world, sheet, &points, &count));
        assert_true(count >= 20 && count <= 64);
        for (int32_t i = 0; i < count; ++i) {
            kiriContact contact = { .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.0f, .friction = 0.5f };
            contacts[i] = contact;
            lowest = points[3 * i + 2] < lowest ? points[3 * i + 2] : lowest;
        }
        OK(kiriSheet_SetContacts(host.world, sheet, contacts, count));
        Tick(&host, 1.0f / 60.0f, 2);
    }
    kiriTotals totals = Host_Totals(&host, sheet);
    assert_true(lowest > -0.05 && totals.center[2] < 0.05 && totals.center[2] > -0.02);
    assert_true(totals.kineticEnergy < 1e-5);
    Host_Ticks(&host, 60, 1.0f / 60.0f, 1); /* contacts are gone after their tick */
    assert_true(Host_Totals(&host, sheet).center[2] < -1.0);
}

/* ---- Cuts ---- */

/* The largest piece goes on, wherever the frames are. */
TEST(SmallPieceComesOff)
{
    START_HOST(host);
    static const float corner[2] = { 0.0625f, 0.0625f }, line[4] = { 0.2f, -0.01f, -0.01f, 0.2f };
    kiriSheetDef def = Host_SmallDef();
    def.framePoints = corner;
    def.frameCount = 1;
    def.maxFrames = 1;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(&host, sheet, line, 2);
    Tick(&host, 0.01f, 1);
    kiriEvent event = { 0 };
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIECE_OFF, &event), 1);
    AssertNear(event.area, 0.5 * 0.19 * 0.19, 1e-4, "the corner");
}

static void SetAxes(kiriSheetDef* def)
{
    /* Turned about two axes, and away from the origin. */
    const float u[3] = { 0.8f, 0.36f, 0.48f }, v[3] = { -0.6f, 0.48f, 0.64f }, position[3] = { 3.0f, -2.0f, 5.0f };
    memcpy(def->axisU, u, sizeof(u));
    memcpy(def->axisV, v, sizeof(v));
    memcpy(def->position, position, sizeof(position));
}

/* The world point at height h over rest point (u, v). */
static void Above(const kiriSheetDef* def, float u, float v, float h, float* x)
{
    const float *a = def->axisU, *b = def->axisV;
    for (int k = 0; k < 3; ++k) {
        int m = (k + 1) % 3, n = (k + 2) % 3;
        x[k] = def->position[k] + u * a[k] + v * b[k] + h * (a[m] * b[n] - a[n] * b[m]);
    }
}

TEST(Slices)
{
    static const float ways[4][4] = { { 0.37f, -0.3f, 0.37f, 1.3f },
                                      { -0.3f, 0.61f, 1.3f, 0.58f },
                                      { 0.5f, -0.3f, 0.5f, 1.3f }, /* along mesh edges */
                                      { -0.2f, -0.2f, 1.2f, 1.2f } };
    for (int i = 0; i < 4; ++i) {
        START_HOST(host);
        kiriSheetDef def = Host_SmallDef();
        SetAxes(&def);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        float blade[12], miss[12];
        kiriCut cut;
        kiriEvent event = { 0 };
        for (int k = 0; k < 4; ++k) {
            int end = k < 2 ? 0 : 2;
            float height = k == 0 || k == 3 ? 0.4f : -0.3f;
            Above(&def, ways[i][end], ways[i][end + 1], height, &blade[3 * k]);
            Above(&def, ways[i][end], ways[i][end + 1], height + 1.0f, &miss[3 * k]);
        }
        OK(kiriSheet_Slice(host.world, sheet, miss, &cut));
        Tick(&host, 1e-6f, 1);
        assert_true(Host_Events(&host, KIRI_EVENT_CUT_FINISHED, &event) == 1 && event.cut == cut);
        assert_int_equal(Host_Counts(&host, sheet).pieces, 1);
        OK(kiriSheet_Slice(host.world, sheet, blade, &cut));
        Tick(&host, 1e-6f, 1);
        assert_true(Host_Events(&host, KIRI_EVENT_CUT_FINISHED, &event) == 1 && event.cut == cut);
        if (Host_Counts(&host, sheet).pieces != 2) {
            fail_msg("slice %d: %d pieces", i, (int)Host_Counts(&host, sheet).pieces);
        }
    }
}

/* ---- Shapes of sheets ---- */

/* The triangles of a rectangle that `keep` says; vertices that none of them uses are left out. */
static kiriSheet AddParts(Host* host, kiriSheetDef* def, bool (*keep)(double u, double v), double* area)
{
    SCOPED_AS(Rectangle, r, Rectangle_Free) = Rectangle_Make(def, 1.0f, 1.0f, 8, 8);
    int32_t map[81], vertices = 0, triangles = 0;
    kiriSheet sheet = 0;
    memset(map, -1, sizeof(map));
    for (int32_t t = 0; t < def->triangleCount; ++t) {
        const int32_t* v = &r.indices[3 * t];
        double u = (r.positions[2 * v[0]] + r.positions[2 * v[1]] + r.positions[2 * v[2]]) / 3.0;
        double w = (r.positions[2 * v[0] + 1] + r.positions[2 * v[1] + 1] + r.positions[2 * v[2] + 1]) / 3.0;
        if (keep(u, w)) {
            memmove(&r.indices[3 * triangles++], v, 3 * sizeof(int32_t));
        }
    }
    for (int32_t i = 0; i < 3 * triangles; ++i) {
        map[r.indices[i]] = 0;
    }
    for (int32_t v = 0; v < 81; ++v) {
        if (map[v] == 0) {
            memmove(&r.positions[2 * vertices], &r.positions[2 * v], 2 * sizeof(float));
            map[v] = vertices++;
        }
    }
    for (int32_t i = 0; i < 3 * triangles; ++i) {
        r.indices[i] = map[r.indices[i]];
    }
    def->vertexCount = vertices;
    def->triangleCount = triangles;
    *area = triangles / 128.0;
    OK(kiriCreateSheet(host->world, def, &sheet));
    return sheet;
}

static bool HasHole(double u, double v)
{
    return u < 0.25 || u > 0.75 || v < 0.25 || v > 0.75;
}
static bool InTwoParts(double u, double v)
{
    return (u < 0.25 || u > 0.5) && v >= 0.0;
}

TEST(Holes)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    double area;
    kiriHit hit;
    static const float origin[3] = { 0.45f, 0.55f, 1.0f }, down[3] = { 0.0f, 0.0f, -1.0f }, in[2] = { 0.45f, 0.55f };
    static const float left[4] = { -0.1f, 0.51f, 0.3f, 0.51f }, right[4] = { 0.6f, 0.49f, 1.1f, 0.49f };
    kiriFrame frame;
    float weight;
    int32_t count;
    kiriSheet sheet = AddParts(&host, &def, HasHole, &area);
    AssertNear(Host_Totals(&host, sheet).area, area, 1e-9, "area");
    OK(kiriSheet_Raycast(host.world, sheet, origin, down, 10.0f, &hit));
    assert_int_equal(hit.triangle, -1);
    assert_int_equal(kiriSheet_GetWeights(host.world, sheet, in, &frame, &weight, NULL, 1, &count),
                     KIRI_ERROR_ARGUMENT);
    Host_Cut(&host, sheet, left, 2);
    Tick(&host, 0.01f, 1);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 1);
    Host_Cut(&host, sheet, right, 2);
    Tick(&host, 0.01f, 1);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    AssertNear(Host_Totals(&host, sheet).area, area, 1e-12, "area");
}

TEST(TwoParts)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    double area, left = 0.0, sum = 0.0;
    def.framePoints = NULL;
    def.frameCount = 1;
    def.maxFrames = 1;
    def.collisionPoints = 1;
    kiriSheet sheet = AddParts(&host, &def, InTwoParts, &area);
    kiriCounts counts = Host_Counts(&host, sheet);
    kiriFrame frames[2];
    assert_true(counts.pieces == 2 && counts.frames == 2 && counts.collisionPoints == 2 && counts.links == 0);
    World_GetFrames(host.world, sheet, frames, 2);
    for (int i = 0; i < 2; ++i) {
        kiriFrameState frame = World_FrameState(host.world, frames[i]);
        left += frame.restPoint[0] < 0.4f ? frame.area : 0.0;
        sum += frame.area;
    }
    AssertNear(left, 0.25, 1e-6, "left part");
    AssertNear(sum, area, 1e-6, "both parts");
    Host_Pin(&host, sheet, 0.1f, 0.5f, 0.1f, 0.5f, 0.0f);
    Host_Ticks(&host, 100, 0.01f, 1);
    kiriFrameState hanging = World_FrameState(host.world, frames[0]);
    kiriFrameState falling = World_FrameState(host.world, frames[1]);
    assert_true(fabsf(hanging.position[2] - falling.position[2]) > 2.0f);
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIECE_OFF, NULL), 0);
}

/* ---- Profile ---- */

static double CountingClock(void* user)
{
    Host* host = user;
    return 0.5 * (double)host->calls++;
}

TEST(Profile)
{
    static const float line[8] = { 0.1f, 0.33f, 0.4f, 0.35f, 0.6f, 0.62f, 0.9f, 0.63f };
    for (int timed = 0; timed < 2; ++timed) {
        HOST(host);
        memset(&host, 0, sizeof(host));
        host.failAt = -1;
        kiriWorldDef worldDef = Host_Def(&host);
        worldDef.clock = timed ? CountingClock : NULL;
        OK(kiriCreateWorld(&worldDef, &host.world));
        kiriSheetDef def = Host_SmallDef();
        def.iterations = 3;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        Tick(&host, 0.01f, 2);
        kiriProfile profile = World_Profile(host.world);
        assert_true(profile.cutSegments == 0 && profile.trianglesSplit == 0 && profile.cellsSettled == 0 &&
                    profile.samplesRefreshed == 0 && profile.solverIterations >= 2);
        for (int i = 0; i < KIRI_STAGE_COUNT; ++i) {
            assert_true(timed && i >= KIRI_STAGE_CONSTANTS ? profile.seconds[i] > 0.0 : profile.seconds[i] == 0.0);
        }
        int32_t triangles = Host_Counts(&host, sheet).triangles;
        Host_Cut(&host, sheet, line, 4);
        Tick(&host, 0.01f, 1);
        OK(kiriWorld_GetProfile(host.world, &profile));
        kiriCounts counts = Host_Counts(&host, sheet);
        assert_int_equal(profile.cutSegments, 3);
        assert_true(profile.trianglesSplit >= counts.triangles - triangles);
        assert_int_equal(profile.commits, 1);
        assert_true(profile.cellsSettled > 0 && profile.linksChanged > 0);
        assert_true(profile.cellsChanged > 0 && profile.cellsChanged <= counts.cells);
        assert_true(profile.weightsChanged > 0 && profile.weightsChanged <= counts.cells);
        int32_t changed = profile.verticesChanged + profile.pointsChanged;
        assert_true(changed > 0 && changed <= counts.vertices + counts.collisionPoints);
        assert_true(profile.samplesRefreshed >= changed);
        for (int i = 0; i < KIRI_STAGE_COUNT; ++i) {
            assert_true(timed ? profile.seconds[i] > 0.0 : profile.seconds[i] == 0.0);
        }
    }
}

/* The largest region of a sheet, by its radius of gyration, as kiri.h says. */
static double LargestRegion(const Host* host, kiriSheet sheet, int32_t* frames)
{
    kiriFrame ids[512];
    double largest = 0.0;
    OK(kiriSheet_GetFrames(host->world, sheet, ids, 512, frames));
    for (int32_t i = 0; i < *frames; ++i) {
        kiriFrameState state = World_FrameState(host->world, ids[i]);
        largest = (double)state.area > largest ? (double)state.area : largest;
    }
    return sqrt(largest);
}

/* Frames in number as the material asks for them, and more where a cut leaves long arms; never more than the cap. */
TEST(FramesByThemselves)
{
    int32_t before, after;
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 0;
    def.accuracy = 0.25f; /* the bending length is then how far frames are apart */
    def.gridResolution = 50;
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    kiriSheet sheet = Host_AddRectangle(&host, &def, 0.3f, 0.3f, 12, 12);
    const kiriMaterial* m = &def.material;
    double h = (double)m->thickness, nu = (double)m->poissonsRatio;
    double length = cbrt((double)m->youngsModulus * h * h / (12.0 * (1.0 - nu * nu) * (double)m->density * 9.81));
    assert_true(length > 0.03 && length < 0.1);
    assert_true(LargestRegion(&host, sheet, &before) < 1.3 * length);
    assert_in_range(before, (int32_t)(0.6 * 0.09 / (length * length)), (int32_t)(1.6 * 0.09 / (length * length)) + 1);
    float points[2 * 120];
    for (int i = 0; i < 120; ++i) {
        float t = 0.2f * (float)i, r = 0.005f + 0.0011f * (float)i;
        points[2 * i] = 0.15f + r * cosf(t);
        points[2 * i + 1] = 0.15f + r * sinf(t);
    }
    Host_Cut(&host, sheet, points, 120);
    Tick(&host, 0.01f, 1);
    assert_true(LargestRegion(&host, sheet, &after) < 1.3 * length);
    assert_true(after > before);
    def.maxFrames = 9;
    sheet = Host_AddRectangle(&host, &def, 0.3f, 0.3f, 12, 12);
    assert_int_equal(Host_Counts(&host, sheet).frames, 9);
    def.maxFrames = 256;
    def.frameLength = 0.15f;
    sheet = Host_AddRectangle(&host, &def, 0.3f, 0.3f, 12, 12);
    assert_in_range(Host_Counts(&host, sheet).frames, 4, 7);
}
