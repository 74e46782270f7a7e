/* Bad input: every function refuses it with the right code and one line, and the world stays as it was. */
#include "host.h"

#include <fenv.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

static const float badFloats[3] = { NAN, INFINITY, -INFINITY };

typedef struct Before {
    uint64_t hash;
    int32_t lines;
    int64_t live;
    char error[512];
} Before;

static Before Look(const Host* host)
{
    Before before = { Host_Hash(host), host->lines, host->live, "" };
    strcpy(before.error, kiriWorld_GetLastError(host->world));
    return before;
}

/* `call` is the source text: its function must be named by the line. */
static void CheckRefused(Host* host, Before before, kiriResult result, kiriResult expected, const char* call, int line)
{
    const char *error = host->line, *kept = kiriWorld_GetLastError(host->world);
    size_t name = strcspn(call, "(");
    if (result != expected || strncmp(error, call, name) != 0 || error[name] != ':' || strchr(error, '\n') != NULL) {
        fail_msg("line %d: %s gave %d, not %d, and says '%s'", line, call, (int)result, (int)expected, error);
    }
    /* A function that only reads leaves the world's line as it was. */
    if (host->lines != before.lines + 1 || (strcmp(kept, error) != 0 && strcmp(kept, before.error) != 0)) {
        fail_msg("line %d: %s logged %d lines, and the world keeps '%s'", line, call, (int)(host->lines - before.lines),
                 kept);
    }
    if (Host_Hash(host) != before.hash || host->live != before.live) {
        fail_msg("line %d: %s left a trace", line, call);
    }
}

#define REFUSED(expected, call)                                                                                        \
    do {                                                                                                               \
        Before before = Look(host);                                                                                    \
        kiriResult result = call;                                                                                      \
        CheckRefused(host, before, result, expected, #call, __LINE__);                                                 \
    } while (0)

/* With every entry of `values` once NaN, once infinite, once minus infinite. */
#define REFUSED_FLOATS(values, count, call)                                                                            \
    do {                                                                                                               \
        for (int entry = 0; entry < 3 * (count); ++entry) {                                                            \
            float kept = (values)[entry / 3];                                                                          \
            (values)[entry / 3] = badFloats[entry % 3];                                                                \
            REFUSED(KIRI_ERROR_ARGUMENT, call);                                                                        \
            (values)[entry / 3] = kept;                                                                                \
        }                                                                                                              \
    } while (0)

/* A world with something of everything in it. */
typedef struct Fixture {
    Host host;
    kiriSheet sheet;
    kiriCut cut;
    kiriFrame frame;
    kiriPin pin;
} Fixture;

static Host* Setup(Fixture* f)
{
    Host* host = &f->host;
    kiriSheetDef def = Host_SmallDef();
    float start[2] = { -1.0f, 0.5f };
    int32_t frames;
    Host_Start(host);
    f->sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    f->pin = Host_Pin(host, f->sheet, 0.3f, 0.9f, 0.0f, 0.0f, 0.0f);
    OK(kiriBeginCut(host->world, f->sheet, start, &f->cut));
    OK(kiriSheet_GetFrames(host->world, f->sheet, &f->frame, 1, &frames));
    OK(Host_Tick(host, 0.01f, 1));
    return host;
}

TEST(NullWorld)
{
    float v[12] = { 0.0f };
    kiriSheetDef sheetDef = Host_SmallDef();
    kiriPinDef pinDef;
    kiriWorldDef worldDef;
    kiriWorld* world;
    uint64_t hash;
    const kiriEvent* events;
    const float* positions;
    int32_t count;
    uint32_t id;
    kiriProfile profile;
    kiriMesh mesh;
    kiriDirty dirty;
    uint16_t indices[3];
    kiriBudget budget = { 0, 0, 0, 0 };
    kiriPinState pinState;
    double d[3];
    kiriCounts counts;
    kiriTotals totals;
    kiriHit hit;
    kiriFrameState frame;
    kiriContact contact = { .point = 0, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.0f, .friction = 0.0f };
    kiriDefaultPinDef(&pinDef);
    kiriDefaultWorldDef(&worldDef);
    kiriDefaultWorldDef(NULL);
    kiriDefaultSheetDef(NULL);
    kiriDefaultPinDef(NULL);
    kiriDestroyWorld(NULL);
    const kiriResult results[] = {
        kiriCreateWorld(NULL, &world),
        kiriCreateWorld(&worldDef, NULL),
        kiriWorld_Tick(NULL, 0.01f, 1),
        kiriWorld_SetGravity(NULL, v),
        kiriWorld_GetStateHash(NULL, &hash),
        kiriWorld_GetEvents(NULL, &events, &count),
        kiriWorld_GetProfile(NULL, &profile),
        kiriCreateSheet(NULL, &sheetDef, &id),
        kiriDestroySheet(NULL, 1),
        kiriWorld_SetBudget(NULL, &budget),
        kiriSheet_GetMesh(NULL, 1, &mesh),
        kiriSheet_GetDirty(NULL, 1, 0, &dirty),
        kiriSheet_CopyVertices(NULL, 1, 0, 1, v, 12, NULL, 0),
        kiriSheet_CopyIndices16(NULL, 1, 0, 1, indices),
        kiriSheet_GetCollisionPoints(NULL, 1, &positions, &count),
        kiriSheet_GetCounts(NULL, 1, &counts),
        kiriSheet_GetTotals(NULL, 1, &totals),
        kiriSheet_EstimateError(NULL, 1, &totals.mass),
        kiriSheet_Raycast(NULL, 1, v, v, 1.0f, &hit),
        kiriWorld_Raycast(NULL, v, v, 1.0f, &id, &hit),
        kiriSheet_GetWeights(NULL, 1, v, &id, v, NULL, 1, &count),
        kiriBeginCut(NULL, 1, v, &id),
        kiriCut_Extend(NULL, 1, v, 1),
        kiriCut_End(NULL, 1),
        kiriSheet_Slice(NULL, 1, v, &id),
        kiriBeginBlade(NULL, 0, &id),
        kiriBlade_MoveEdge(NULL, 1, v, v),
        kiriBlade_MoveRay(NULL, 1, v, v, 1.0f),
        kiriBlade_End(NULL, 1),
        kiriSheet_GetFrames(NULL, 1, &id, 1, &count),
        kiriFrame_GetState(NULL, 1, &frame),
        kiriFrame_Hold(NULL, 1, NULL, NULL),
        kiriFrame_GetReaction(NULL, 1, d, d),
        kiriFrame_ApplyForce(NULL, 1, v, v),
        kiriSheet_ApplyForce(NULL, 1, v, v, v),
        kiriSheet_ApplyLineLoad(NULL, 1, v, v + 1, v),
        kiriSheet_ApplyPressure(NULL, 1, 1.0f),
        kiriSheet_ClampLine(NULL, 1, v, v + 1, &id),
        kiriSheet_HingeLine(NULL, 1, v, v + 1, &id),
        kiriPin_SetPose(NULL, 1, v, v),
        kiriPin_GetState(NULL, 1, &pinState),
        kiriPin_GetReaction(NULL, 1, d, d),
        kiriSheet_GetPins(NULL, 1, &id, 1, &count),
        kiriCreatePin(NULL, 1, &pinDef, &id),
        kiriPin_SetTarget(NULL, 1, v),
        kiriDestroyPin(NULL, 1),
        kiriCreateSeam(NULL, NULL, &id),
        kiriDestroySeam(NULL, 1),
        kiriSeam_SetHinge(NULL, 1, 0.0f, 0.0f),
        kiriSeam_GetStitch(NULL, 1, 0, NULL),
        kiriSeam_GetCount(NULL, 1, &count),
        kiriWorld_GetSeams(NULL, &id, 1, &count),
        kiriSheet_SetContacts(NULL, 1, &contact, 1),
    };
    for (size_t i = 0; i < sizeof(results) / sizeof(results[0]); ++i) {
        assert_int_equal(results[i], KIRI_ERROR_ARGUMENT);
    }
    assert_string_equal(kiriWorld_GetLastError(NULL), "");
}

TEST(Names)
{
    static const char* const results[] = { "KIRI_ERROR_REPLAY", "KIRI_ERROR_DATA",     "KIRI_ERROR_BUILD",
                                           "KIRI_ERROR_LIMIT",  "KIRI_DIVERGED",       "KIRI_ERROR_MEMORY",
                                           "KIRI_ERROR_STATE",  "KIRI_ERROR_MESH",     "KIRI_ERROR_ID",
                                           "KIRI_ERROR_DEF",    "KIRI_ERROR_ARGUMENT", "KIRI_OK",
                                           "KIRI_PENDING" };
    for (int32_t r = KIRI_ERROR_REPLAY; r <= KIRI_PENDING; ++r) {
        assert_string_equal(kiriGetResultName(r), results[r - KIRI_ERROR_REPLAY]);
    }
    assert_string_equal(kiriGetResultName(2), "unknown");
    assert_string_equal(kiriGetResultName(-12), "unknown");
    for (int32_t r = KIRI_ERROR_REPLAY - 1; r <= KIRI_PENDING + 1; ++r) { /* a line each, and no two are the same */
        assert_true(strlen(kiriGetResultText(r)) >= 4 && strchr(kiriGetResultText(r), '\n') == NULL);
        for (int32_t other = KIRI_ERROR_REPLAY; other < r && r <= KIRI_PENDING; ++other) {
            assert_string_not_equal(kiriGetResultText(r), kiriGetResultText(other));
        }
    }
    assert_string_equal(kiriGetResultText(2), kiriGetResultText(-12));
    for (int32_t s = 0; s < KIRI_STAGE_COUNT; ++s) {
        assert_true(kiriGetStageName(s)[0] != '\0');
        for (int32_t other = 0; other < s; ++other) {
            assert_string_not_equal(kiriGetStageName(s), kiriGetStageName(other));
        }
    }
    assert_string_equal(kiriGetStageName(-1), "");
    assert_string_equal(kiriGetStageName(KIRI_STAGE_COUNT), "");
    assert_int_equal(kiriGetVersion(), KIRI_VERSION);
}

/* No world was created, the line says why, and nothing was allocated. */
static void AssertModeRefused(kiriResult result, const Host* host)
{
    assert_int_equal(result, KIRI_ERROR_BUILD);
    assert_null(host->world);
    assert_int_equal(host->calls, 0);
    assert_int_equal(host->lines, 1);
    assert_non_null(strstr(host->line, "FTZ"));
}

/* In each mode of the processor that gives other bits; and a world is made again afterwards. */
TEST(ModesOfFloats)
{
    static const int roundings[] = { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO };
    for (int i = 0; i < 3; ++i) {
        Host host = { .failAt = -1 };
        kiriWorldDef def = Host_Def(&host);
        assert_int_equal(fesetround(roundings[i]), 0);
        kiriResult result = kiriCreateWorld(&def, &host.world);
        fesetround(FE_TONEAREST);
        AssertModeRefused(result, &host);
    }
#if defined(__SSE2__)
    static const unsigned int flushes[] = { 0x8000, 0x0040 }; /* of results; of what is read */
    for (int i = 0; i < 2; ++i) {
        Host host = { .failAt = -1 };
        kiriWorldDef def = Host_Def(&host);
        unsigned int mode = _mm_getcsr();
        _mm_setcsr(mode | flushes[i]);
        kiriResult result = kiriCreateWorld(&def, &host.world);
        _mm_setcsr(mode);
        AssertModeRefused(result, &host);
    }
#endif
    START_HOST(host);
}

/* Every preset makes a sheet; other numbers make none. */
TEST(Materials)
{
    START_HOST(host);
    for (int32_t preset = 0; preset < KIRI_MATERIAL_COUNT; ++preset) {
        kiriSheetDef def = Host_SmallDef();
        assert_int_equal(kiriGetMaterial(preset, &def.material), KIRI_OK);
        Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    }
    kiriMaterial material;
    assert_int_equal(kiriGetMaterial(-1, &material), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriGetMaterial(KIRI_MATERIAL_COUNT, &material), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriGetMaterial(0, NULL), KIRI_ERROR_ARGUMENT);
}

/* Every preset moves a sheet, the next one with more work; other numbers write none. What they are worth:
   test_quality.c. */
TEST(Qualities)
{
    kiriQuality quality = { 0, 0, 0, 0 }, refused = { 7, 7, 7, 7 };
    START_HOST(host);
    for (int32_t preset = 0; preset < KIRI_QUALITY_COUNT; ++preset) {
        kiriQuality less = quality;
        kiriSheetDef def = DefaultSheet();
        OK(kiriGetQuality(preset, &quality));
        assert_true(quality.framesAlong > less.framesAlong && quality.gridResolution > less.gridResolution);
        assert_true(quality.iterations >= less.iterations && quality.substeps > less.substeps);
        def.frameCount = quality.framesAlong;
        def.gridResolution = quality.gridResolution;
        def.iterations = quality.iterations;
        Host_AddRectangle(&host, &def, 1.0f, 0.25f, 8, 2);
        OK(Host_Tick(&host, 1.0f / 60.0f, quality.substeps));
    }
    assert_int_equal(kiriGetQuality(-1, &refused), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriGetQuality(KIRI_QUALITY_COUNT, &refused), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriGetQuality(KIRI_QUALITY_FAST, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(refused.framesAlong, 7);
}

TEST(WorldDefs)
{
    Host plain;
    memset(&plain, 0, sizeof(plain));
    plain.failAt = -1;
    kiriWorld* const mark = (kiriWorld*)&plain;
    for (int bad = 0; bad < 14; ++bad) {
        kiriWorldDef def = Host_Def(&plain);
        kiriWorld* world = mark;
        if (bad < 9) {
            def.gravity[bad / 3] = badFloats[bad % 3];
        } else if (bad == 9) {
            def.alloc = NULL;
        } else if (bad == 10) {
            def.free = NULL;
        } else if (bad == 11) {
            def.budget.cells = -1;
        } else if (bad == 12) {
            def.cookie ^= 1;
        } else {
            memset(&def, 0, sizeof(def));
        }
        assert_int_equal(kiriCreateWorld(&def, &world), bad < 12 ? KIRI_ERROR_ARGUMENT : KIRI_ERROR_DEF);
        assert_null(world);
        assert_int_equal(plain.live, 0);
    }
}

TEST(WorldArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    static const float badSteps[] = { NAN, INFINITY, -INFINITY, 0.0f, -0.01f, 0.9e-6f, 10.001f, 1e30f };
    static const int32_t badSubsteps[] = { 0, -1, 65, INT32_MAX, INT32_MIN };
    float v[3] = { 1.0f, 2.0f, 3.0f };
    const kiriEvent* events;
    int32_t count;
    for (size_t i = 0; i < sizeof(badSteps) / sizeof(float); ++i) {
        REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Tick(w, badSteps[i], 1));
    }
    for (size_t i = 0; i < sizeof(badSubsteps) / sizeof(int32_t); ++i) {
        REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Tick(w, 0.01f, badSubsteps[i]));
    }
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_SetGravity(w, NULL));
    REFUSED_FLOATS(v, 3, kiriWorld_SetGravity(w, v));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_GetStateHash(w, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_GetEvents(w, NULL, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_GetEvents(w, &events, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_GetProfile(w, NULL));
    Host_Stop(host);
}

/* A def is refused, *sheet is 0, and nothing is left behind. */
#define REFUSED_DEF(expected)                                                                                          \
    do {                                                                                                               \
        kiriSheet made = 77;                                                                                           \
        REFUSED(expected, kiriCreateSheet(host->world, &def, &made));                                                  \
        assert_int_equal(made, 0);                                                                                     \
    } while (0)

TEST(SheetDefFloats)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriSheetDef def = Host_SmallDef();
    float points[8];
    memcpy(points, def.framePoints, sizeof(points));
    def.framePoints = points;
    SCOPED_AS(Rectangle, r, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 2, 2);
    kiriMaterial* m = &def.material;
    const struct {
        float* first;
        int count;
    } fields[] = { { def.position, 3 },      { def.axisU, 3 },         { def.axisV, 3 },      { def.velocity, 3 },
                   { &m->youngsModulus, 1 }, { &m->poissonsRatio, 1 }, { &m->thickness, 1 },  { &m->density, 1 },
                   { &m->airDamping, 1 },    { &m->flexDamping, 1 },   { &m->yieldStress, 1 },
                   { &m->hardening, 1 },     { &m->slack, 1 },         { points, 8 },        { &def.snapDistance, 1 },
                   { &def.weldDistance, 1 }, { &def.rigidWeight, 1 },  { &def.rigidArea, 1 }, { r.positions, 18 } };
    for (size_t i = 0; i < sizeof(fields) / sizeof(fields[0]); ++i) {
        kiriSheet made = 0;
        REFUSED_FLOATS(fields[i].first, fields[i].count, kiriCreateSheet(host->world, &def, &made));
    }
    const struct {
        float* field;
        float value;
    } ranges[] = { { &m->youngsModulus, 0.0f },  { &m->youngsModulus, -1.0f }, { &m->poissonsRatio, -0.1f },
                   { &m->poissonsRatio, 0.5f },  { &m->thickness, 0.0f },      { &m->thickness, -1.0f },
                   { &m->density, 0.0f },        { &m->density, -1.0f },       { &m->airDamping, -0.1f },
                   { &m->flexDamping, -0.1f },   { &m->yieldStress, -1.0f },   { &m->hardening, 1.0f },
                   { &m->slack, 1.0f },          { &m->slack, -0.1f },
                   { &def.snapDistance, -0.1f }, { &def.rigidWeight, 0.0f },
                   { &def.weldDistance, -0.1f }, { &def.rigidArea, -1.0f },    { &def.axisU[0], 0.0f },
                   { &def.axisU[0], 1.1f },      { &def.axisU[1], 0.1f },      { &def.axisV[1], -2.0f },
                   { &def.axisV[0], 1e30f },     { &points[0], -0.1f },        { &points[1], 1.1f },
                   { &points[2], 1e30f },        { &points[3], -1e30f },       { &points[4], 16.1875f },
                   { &points[5], -7.1875f } };
    for (size_t i = 0; i < sizeof(ranges) / sizeof(ranges[0]); ++i) {
        float kept = *ranges[i].field;
        *ranges[i].field = ranges[i].value;
        REFUSED_DEF(KIRI_ERROR_ARGUMENT);
        *ranges[i].field = kept;
    }
    points[0] = points[2] + 0.01f; /* two frames in one cell */
    points[1] = points[3];
    REFUSED_DEF(KIRI_ERROR_ARGUMENT);
    Host_Stop(host);
}

TEST(SheetDefInts)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriSheetDef def = Host_SmallDef();
    SCOPED_AS(Rectangle, r, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 2, 2);
    const struct {
        int32_t* field;
        int32_t values[4];
    } ints[] = { { &def.vertexCount, { 0, -1, INT32_MIN, 2 } },
                 { &def.triangleCount, { 0, -1, INT32_MIN, INT32_MAX } },
                 { &def.gridResolution, { 0, -1, 4097, INT32_MAX } },
                 { &def.frameCount, { 0, -1, INT32_MIN, INT32_MAX } },
                 { &def.maxFrames, { 0, -1, INT32_MIN, -7 } },
                 { &def.collisionPoints, { -1, INT32_MIN, INT32_MAX, (1 << 20) + 1 } },
                 { &def.iterations, { 0, -1, 65, INT32_MAX } },
                 { &r.indices[4], { -1, INT32_MIN, 9, INT32_MAX } } };
    for (size_t i = 0; i < sizeof(ints) / sizeof(ints[0]); ++i) {
        int32_t kept = *ints[i].field;
        for (int k = 0; k < 4; ++k) {
            *ints[i].field = ints[i].values[k];
            REFUSED_DEF(KIRI_ERROR_ARGUMENT);
        }
        *ints[i].field = kept;
    }
    kiriSheet none;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateSheet(host->world, NULL, &none));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateSheet(host->world, &def, NULL));
    def.restPositions = NULL;
    REFUSED_DEF(KIRI_ERROR_ARGUMENT);
    def.restPositions = r.positions;
    def.indices = NULL;
    REFUSED_DEF(KIRI_ERROR_ARGUMENT);
    def.indices = r.indices;
    def.cookie += 1;
    REFUSED_DEF(KIRI_ERROR_DEF);
    memset(&def, 0, sizeof(def));
    REFUSED_DEF(KIRI_ERROR_DEF);
    Host_Stop(host);
}

/* A program that forgets a kiriDefault function gets a code and a line that names the function. */
TEST(ZeroedDefs)
{
    Fixture f;
    Host* host = Setup(&f);
    static const union {
        kiriWorldDef world;
        kiriSheetDef sheet;
        kiriPinDef pin;
        kiriObstacleDef obstacle;
        kiriSheetSettings settings;
        kiriDebugDraw draw;
    } zeroed;
    kiriWorld* world = host->world;
    uint32_t id;
    assert_int_equal(kiriCreateWorld(&zeroed.world, &world), KIRI_ERROR_DEF);
    assert_null(world);
    assert_non_null(strstr(kiriGetResultText(KIRI_ERROR_DEF), "kiriDefaultWorldDef"));
    world = host->world;
    REFUSED(KIRI_ERROR_DEF, kiriCreateSheet(world, &zeroed.sheet, &id));
    assert_non_null(strstr(host->line, "kiriCreateSheet: def was not filled by kiriDefaultSheetDef"));
    REFUSED(KIRI_ERROR_DEF, kiriCreateRectangle(world, 1.0f, 1.0f, 1, 1, &zeroed.sheet, &id));
    assert_non_null(strstr(host->line, "kiriCreateRectangle: def was not filled by kiriDefaultSheetDef"));
    REFUSED(KIRI_ERROR_DEF, kiriCreatePin(world, f.sheet, &zeroed.pin, &id));
    assert_non_null(strstr(host->line, "kiriCreatePin: def was not filled by kiriDefaultPinDef"));
    REFUSED(KIRI_ERROR_DEF, kiriCreateObstacle(world, &zeroed.obstacle, &id));
    assert_non_null(strstr(host->line, "kiriCreateObstacle: def was not filled by kiriDefaultObstacleDef"));
    REFUSED(KIRI_ERROR_DEF, kiriSheet_SetSettings(world, f.sheet, &zeroed.settings));
    assert_non_null(strstr(host->line, "kiriSheet_SetSettings: settings was not filled by kiriSheet_GetSettings"));
    assert_int_equal(kiriWorld_DebugDraw(world, &zeroed.draw), KIRI_ERROR_DEF);
    assert_non_null(strstr(host->line, "kiriWorld_DebugDraw: "));
    assert_non_null(strstr(host->line, "kiriDefaultDebugDraw"));
    Host_Stop(host);
}

TEST(Meshes)
{
    Fixture f;
    Host* host = Setup(&f);
    static const float square[14] = { 0.0f, 0.0f, 1.0f, 0.0f,  1.0f,  1.0f,  0.0f,
                                      1.0f, 0.5f, 0.5f, 0.25f, 0.25f, 0.75f, 0.6f };
    static const struct {
        int32_t vertices, triangles;
        int32_t indices[9];
    } meshes[] = {
        { 3, 1, { 0, 2, 1 } },                   /* clockwise */
        { 4, 2, { 0, 1, 2, 0, 3, 2 } },          /* the second is */
        { 3, 1, { 0, 1, 1 } },                   /* a vertex twice */
        { 3, 1, { 2, 2, 2 } },                   /* three times */
        { 4, 2, { 0, 1, 2, 0, 1, 2 } },          /* twice the same */
        { 4, 2, { 0, 1, 2, 1, 2, 0 } },          /* and turned */
        { 4, 2, { 0, 1, 2, 0, 1, 3 } },          /* overlap, sharing an edge in the same direction */
        { 4, 2, { 0, 1, 3, 1, 2, 0 } },          /* overlap, crossing diagonals */
        { 7, 3, { 0, 1, 2, 0, 2, 3, 5, 6, 4 } }, /* one inside another */
    };
    for (size_t i = 0; i < sizeof(meshes) / sizeof(meshes[0]); ++i) {
        kiriSheetDef def = DefaultSheet();
        def.restPositions = square;
        def.vertexCount = meshes[i].vertices;
        def.indices = meshes[i].indices;
        def.triangleCount = meshes[i].triangles;
        def.gridResolution = 8;
        REFUSED_DEF(KIRI_ERROR_MESH);
    }
    static const float flat[] = { 0.0f, 0.0f, 0.5f, 0.5f, 1.0f, 1.0f },
                       point[6] = { 2.0f, 2.0f, 2.0f, 2.0f, 2.0f, 2.0f };
    static const float* const degenerate[] = { flat, point };
    for (int i = 0; i < 2; ++i) {
        kiriSheetDef def = DefaultSheet();
        static const int32_t indices[3] = { 0, 1, 2 };
        def.restPositions = degenerate[i];
        def.vertexCount = 3;
        def.indices = indices;
        def.triangleCount = 1;
        REFUSED_DEF(KIRI_ERROR_MESH);
    }
    Host_Stop(host);
}

TEST(FillRectangle)
{
    float positions[18];
    int32_t indices[24];
    static const float badSizes[] = { NAN, INFINITY, -INFINITY, 0.0f, -1.0f };
    static const int32_t badCounts[] = { 0, -1, 4097, INT32_MIN, INT32_MAX };
    for (int i = 0; i < 5; ++i) {
        assert_int_equal(kiriFillRectangle(badSizes[i], 1.0f, 2, 2, positions, indices), KIRI_ERROR_ARGUMENT);
        assert_int_equal(kiriFillRectangle(1.0f, badSizes[i], 2, 2, positions, indices), KIRI_ERROR_ARGUMENT);
        assert_int_equal(kiriFillRectangle(1.0f, 1.0f, badCounts[i], 2, positions, indices), KIRI_ERROR_ARGUMENT);
        assert_int_equal(kiriFillRectangle(1.0f, 1.0f, 2, badCounts[i], positions, indices), KIRI_ERROR_ARGUMENT);
    }
    assert_int_equal(kiriFillRectangle(1.0f, 1.0f, 2, 2, NULL, indices), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriFillRectangle(1.0f, 1.0f, 2, 2, positions, NULL), KIRI_ERROR_ARGUMENT);
    OK(kiriFillRectangle(3e38f, 3e38f, 2, 2, positions, indices));
    assert_true(AllFinite(positions, 18));
}

/* It is the sheet that kiriFillRectangle and kiriCreateSheet make, or none, and leaves no memory behind. */
TEST(CreateRectangle)
{
    Host hosts[2];
    kiriSheet sheets[2];
    uint64_t hashes[2];
    for (int i = 0; i < 2; ++i) {
        Host_Start(&hosts[i]);
        kiriSheetDef def = Host_SmallDef();
        if (i == 0) {
            sheets[i] = Host_AddRectangle(&hosts[i], &def, 1.0f, 1.0f, 4, 4);
        } else {
            OK(kiriCreateRectangle(hosts[i].world, 1.0f, 1.0f, 4, 4, &def, &sheets[i]));
        }
        OK(kiriWorld_GetStateHash(hosts[i].world, &hashes[i]));
    }
    assert_int_equal(hashes[0], hashes[1]);
    kiriWorld* world = hosts[1].world;
    kiriSheet sheet = 7;
    OK(kiriCreateRectangle(world, 1.0f, 1.0f, 2, 2, NULL, &sheet));
    assert_int_not_equal(sheet, 0);
    OK(kiriDestroySheet(world, sheet));
    assert_int_equal(kiriCreateRectangle(world, NAN, 1.0f, 2, 2, NULL, &sheet), KIRI_ERROR_ARGUMENT);
    assert_int_equal(sheet, 0);
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 2, 4097, NULL, &sheet), KIRI_ERROR_ARGUMENT);
    assert_string_not_equal(kiriWorld_GetLastError(world), "");
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 2, 2, NULL, NULL), KIRI_ERROR_ARGUMENT);
    kiriSheetDef unstamped = Host_SmallDef();
    unstamped.cookie = 0;
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 2, 2, &unstamped, &sheet), KIRI_ERROR_DEF);
    for (int i = 0; i < 2; ++i) {
        Host_Stop(&hosts[i]);
    }
}

/* What names nothing of a kind: nothing, garbage, neighbours of a living id, ids of other kinds, and the dead. */
static int32_t WrongIds(const Fixture* f, uint32_t living, uint32_t dead, uint32_t* ids)
{
    const uint32_t all[] = { 0,
                             dead,
                             0x12345678u,
                             0xffffffffu,
                             living + 1,
                             living ^ (1u << 18),
                             living | 0xffffu,
                             living ^ 0x80000000u,
                             f->sheet,
                             f->cut,
                             f->frame,
                             f->pin };
    int32_t count = 0;
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); ++i) {
        if (all[i] != living) {
            ids[count++] = all[i];
        }
    }
    return count;
}

typedef struct Dead {
    uint32_t sheet, cut, frame, pin;
} Dead;

/* A second sheet with a frame and a cut of its own, destroyed; and a cut that is finished, and a pin destroyed. */
static Dead MakeDead(Fixture* f)
{
    Host* host = &f->host;
    Dead dead;
    kiriSheetDef def = Host_SmallDef();
    int32_t frames;
    static const float line[4] = { 0.2f, -0.1f, 0.2f, 1.1f };
    dead.sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 2, 2);
    OK(kiriSheet_GetFrames(host->world, dead.sheet, &dead.frame, 1, &frames));
    OK(kiriDestroySheet(host->world, dead.sheet));
    dead.cut = Host_Cut(host, f->sheet, line, 2);
    OK(Host_Tick(host, 0.01f, 1));
    dead.pin = Host_Pin(host, f->sheet, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f);
    OK(kiriDestroyPin(host->world, dead.pin));
    return dead;
}

TEST(Ids)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    Dead dead = MakeDead(&f);
    uint32_t ids[16], made;
    int32_t count;
    float v[12] = { 0.5f, 0.5f, 0.5f };
    const float* positions;
    kiriMesh mesh;
    kiriCounts counts;
    kiriTotals totals;
    kiriHit hit;
    kiriFrameState frame;
    kiriPinDef pinDef;
    kiriPinState pinState;
    double d[3];
    static const float eye[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    kiriContact contact = { .point = 0, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.0f, .friction = 0.0f };
    kiriDefaultPinDef(&pinDef);
    for (int32_t i = WrongIds(&f, f.sheet, dead.sheet, ids); i-- > 0;) {
        REFUSED(KIRI_ERROR_ID, kiriDestroySheet(w, ids[i]));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetMesh(w, ids[i], &mesh));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetCollisionPoints(w, ids[i], &positions, &count));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetCounts(w, ids[i], &counts));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetTotals(w, ids[i], &totals));
        REFUSED(KIRI_ERROR_ID, kiriSheet_EstimateError(w, ids[i], &totals.mass));
        REFUSED(KIRI_ERROR_ID, kiriSheet_Raycast(w, ids[i], v, v, 1.0f, &hit));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetWeights(w, ids[i], v, &made, v, NULL, 1, &count));
        REFUSED(KIRI_ERROR_ID, kiriBeginCut(w, ids[i], v, &made));
        REFUSED(KIRI_ERROR_ID, kiriSheet_Slice(w, ids[i], v, &made));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetFrames(w, ids[i], &made, 1, &count));
        REFUSED(KIRI_ERROR_ID, kiriCreatePin(w, ids[i], &pinDef, &made));
        REFUSED(KIRI_ERROR_ID, kiriSheet_ClampLine(w, ids[i], v, v + 1, &made));
        REFUSED(KIRI_ERROR_ID, kiriSheet_HingeLine(w, ids[i], v, v + 1, &made));
        REFUSED(KIRI_ERROR_ID, kiriSheet_GetPins(w, ids[i], &made, 1, &count));
        REFUSED(KIRI_ERROR_ID, kiriSheet_ApplyForce(w, ids[i], v, v, v));
        REFUSED(KIRI_ERROR_ID, kiriSheet_ApplyLineLoad(w, ids[i], v, v + 1, v));
        REFUSED(KIRI_ERROR_ID, kiriSheet_ApplyPressure(w, ids[i], 1.0f));
        REFUSED(KIRI_ERROR_ID, kiriSheet_SetContacts(w, ids[i], &contact, 1));
    }
    for (int32_t i = WrongIds(&f, f.cut, dead.cut, ids); i-- > 0;) {
        REFUSED(KIRI_ERROR_ID, kiriCut_Extend(w, ids[i], v, 1));
        REFUSED(KIRI_ERROR_ID, kiriCut_End(w, ids[i]));
    }
    for (int32_t i = WrongIds(&f, f.pin, dead.pin, ids); i-- > 0;) {
        REFUSED(KIRI_ERROR_ID, kiriPin_SetTarget(w, ids[i], v));
        REFUSED(KIRI_ERROR_ID, kiriPin_SetPose(w, ids[i], v, eye));
        REFUSED(KIRI_ERROR_ID, kiriPin_GetState(w, ids[i], &pinState));
        REFUSED(KIRI_ERROR_ID, kiriPin_GetReaction(w, ids[i], d, d));
        REFUSED(KIRI_ERROR_ID, kiriDestroyPin(w, ids[i]));
    }
    /* The sheet's other frames are right. */
    for (int32_t i = WrongIds(&f, f.frame, dead.frame, ids); i-- > 0;) {
        if (ids[i] != f.frame + 1) {
            REFUSED(KIRI_ERROR_ID, kiriFrame_GetState(w, ids[i], &frame));
            REFUSED(KIRI_ERROR_ID, kiriFrame_Hold(w, ids[i], v, eye));
            REFUSED(KIRI_ERROR_ID, kiriFrame_Hold(w, ids[i], NULL, NULL));
            REFUSED(KIRI_ERROR_ID, kiriFrame_ApplyForce(w, ids[i], v, v));
            REFUSED(KIRI_ERROR_ID, kiriFrame_GetReaction(w, ids[i], d, d));
        }
    }
    OK(kiriDestroySheet(w, f.sheet)); /* takes what is on it along */
    f.sheet = 0;
    REFUSED(KIRI_ERROR_ID, kiriCut_End(w, f.cut));
    REFUSED(KIRI_ERROR_ID, kiriDestroyPin(w, f.pin));
    REFUSED(KIRI_ERROR_ID, kiriFrame_GetState(w, f.frame, &frame));
    Host_Stop(host);
}

TEST(SheetArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    kiriSheet s = f.sheet;
    float a[3] = { 0.5f, 0.5f, 1.0f }, b[3] = { 0.0f, 0.0f, -1.0f }, far = 1.0f;
    float out[8][2] = { { -0.01f, 0.5f }, { 1.01f, 0.5f },  { 0.5f, -0.01f }, { 0.5f, 1.01f },
                        { 1e30f, 0.5f },  { 0.5f, -1e30f }, { 16.5f, 0.5f },  { 3.4e38f, 3.4e38f } };
    const float* positions;
    int32_t count;
    kiriFrame frame;
    kiriSheet id;
    kiriHit hit;
    float weight;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetMesh(w, s, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetDirty(w, s, 0, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetCollisionPoints(w, s, NULL, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetCollisionPoints(w, s, &positions, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetCounts(w, s, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetTotals(w, s, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_EstimateError(w, s, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetFrames(w, s, &frame, 1, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetFrames(w, s, NULL, 1, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetFrames(w, s, &frame, -1, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Raycast(w, NULL, b, 1.0f, &id, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Raycast(w, a, NULL, 1.0f, &id, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Raycast(w, a, b, 1.0f, NULL, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Raycast(w, a, b, 1.0f, &id, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriWorld_Raycast(w, a, b, -0.1f, &id, &hit));
    REFUSED_FLOATS(a, 3, kiriWorld_Raycast(w, a, b, 1.0f, &id, &hit));
    REFUSED_FLOATS(b, 3, kiriWorld_Raycast(w, a, b, 1.0f, &id, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Raycast(w, s, NULL, b, 1.0f, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Raycast(w, s, a, NULL, 1.0f, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Raycast(w, s, a, b, 1.0f, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Raycast(w, s, a, b, -0.1f, &hit));
    REFUSED_FLOATS(a, 3, kiriSheet_Raycast(w, s, a, b, 1.0f, &hit));
    REFUSED_FLOATS(b, 3, kiriSheet_Raycast(w, s, a, b, 1.0f, &hit));
    REFUSED_FLOATS(&far, 1, kiriSheet_Raycast(w, s, a, b, far, &hit));
    b[2] = 0.0f;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Raycast(w, s, a, b, 1.0f, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetWeights(w, s, NULL, &frame, &weight, NULL, 1, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetWeights(w, s, a, NULL, &weight, NULL, 1, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetWeights(w, s, a, &frame, NULL, NULL, 1, &count));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetWeights(w, s, a, &frame, &weight, NULL, 1, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetWeights(w, s, a, &frame, &weight, NULL, -1, &count));
    REFUSED_FLOATS(a, 2, kiriSheet_GetWeights(w, s, a, &frame, &weight, NULL, 1, &count));
    for (int i = 0; i < 8; ++i) {
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetWeights(w, s, out[i], &frame, &weight, NULL, 1, &count));
    }
    Host_Stop(host);
}

TEST(CutArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    float v[12] = { 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1.0f, 1.1f, 1.2f };
    kiriCut cut;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriBeginCut(w, f.sheet, NULL, &cut));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriBeginCut(w, f.sheet, v, NULL));
    REFUSED_FLOATS(v, 2, kiriBeginCut(w, f.sheet, v, &cut));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCut_Extend(w, f.cut, NULL, 1));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCut_Extend(w, f.cut, v, 0));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCut_Extend(w, f.cut, v, -1));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCut_Extend(w, f.cut, v, INT32_MAX));
    REFUSED_FLOATS(v, 12, kiriCut_Extend(w, f.cut, v, 6));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Slice(w, f.sheet, NULL, &cut));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Slice(w, f.sheet, v, NULL));
    REFUSED_FLOATS(v, 12, kiriSheet_Slice(w, f.sheet, v, &cut));
    OK(kiriCut_Extend(w, f.cut, v, 6));
    OK(kiriCut_End(w, f.cut));
    REFUSED(KIRI_ERROR_STATE, kiriCut_End(w, f.cut));
    REFUSED(KIRI_ERROR_STATE, kiriCut_Extend(w, f.cut, v, 1));
    OK(kiriSheet_Slice(w, f.sheet, v, &cut));
    REFUSED(KIRI_ERROR_STATE, kiriCut_End(w, cut)); /* a slice is ended already */
    REFUSED(KIRI_ERROR_STATE, kiriCut_Extend(w, cut, v, 1));
    Host_Stop(host);
}

TEST(FrameArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    float v[3] = { 1.0f, 2.0f, 3.0f }, r[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_GetState(w, f.frame, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_Hold(w, f.frame, NULL, r));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_Hold(w, f.frame, v, NULL));
    REFUSED_FLOATS(v, 3, kiriFrame_Hold(w, f.frame, v, r));
    REFUSED_FLOATS(r, 9, kiriFrame_Hold(w, f.frame, v, r));
    for (int i = 0; i < 9; ++i) {
        static const float wrong[3] = { 0.7f, -0.7f, 1e30f };
        for (int k = 0; k < 3; ++k) {
            float kept = r[i];
            r[i] = wrong[k];
            REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_Hold(w, f.frame, v, r));
            r[i] = kept;
        }
    }
    r[8] = -1.0f; /* a mirror */
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_Hold(w, f.frame, v, r));
    memset(r, 0, sizeof(r));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_Hold(w, f.frame, v, r));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_ApplyForce(w, f.frame, NULL, v));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_ApplyForce(w, f.frame, v, NULL));
    float u[3] = { 0.0f, 0.0f, 0.0f };
    REFUSED_FLOATS(u, 3, kiriFrame_ApplyForce(w, f.frame, u, v));
    REFUSED_FLOATS(v, 3, kiriFrame_ApplyForce(w, f.frame, u, v));
    Host_Stop(host);
}

TEST(PinArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    kiriPinDef def;
    kiriPin pin;
    float target[3] = { 1.0f, 2.0f, 3.0f };
    kiriDefaultPinDef(&def);
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCreatePin(w, f.sheet, NULL, &pin));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCreatePin(w, f.sheet, &def, NULL));
    REFUSED_FLOATS(def.restPoint, 2, kiriCreatePin(w, f.sheet, &def, &pin));
    REFUSED_FLOATS(def.target, 3, kiriCreatePin(w, f.sheet, &def, &pin));
    REFUSED_FLOATS(&def.stiffness, 1, kiriCreatePin(w, f.sheet, &def, &pin));
    def.stiffness = -1.0f;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCreatePin(w, f.sheet, &def, &pin));
    def.stiffness = 0.0f;
    static const float out[] = { -0.01f, 1.01f, 1e30f, -1e30f, 16.5f };
    for (int i = 0; i < 10; ++i) {
        def.restPoint[i % 2] = out[i / 2];
        REFUSED(KIRI_ERROR_ARGUMENT, kiriCreatePin(w, f.sheet, &def, &pin));
        def.restPoint[i % 2] = 0.5f;
    }
    def.cookie = 0;
    REFUSED(KIRI_ERROR_DEF, kiriCreatePin(w, f.sheet, &def, &pin));
    memset(&def, 0, sizeof(def));
    REFUSED(KIRI_ERROR_DEF, kiriCreatePin(w, f.sheet, &def, &pin));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetTarget(w, f.pin, NULL));
    REFUSED_FLOATS(target, 3, kiriPin_SetTarget(w, f.pin, target));
    double d[3];
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_GetState(w, f.pin, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_GetReaction(w, f.pin, NULL, d));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_GetReaction(w, f.pin, d, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_GetReaction(w, f.frame, NULL, d));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_GetReaction(w, f.frame, d, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetPins(w, f.sheet, &pin, 1, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetPins(w, f.sheet, &pin, -1, &(int32_t){ 0 }));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_GetPins(w, f.sheet, NULL, 1, &(int32_t){ 0 }));
    Host_Stop(host);
}

/* Lines that are none, or meet nothing, whoever asks for them. */
TEST(LineArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    kiriPin pin;
    float a[2] = { 0.2f, 0.3f }, b[2] = { 0.7f, 0.9f }, q[3] = { 1.0f, 2.0f, 3.0f };
    static const float beside[3][4] = { { -0.1f, 0.0f, -0.1f, 1.0f },
                                        { 1.2f, 0.1f, 1.3f, 0.5f },
                                        { -0.2f, 0.1f, 0.1f, -0.2f } };
    static const float far[2] = { 1e30f, 0.0f };
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ClampLine(w, f.sheet, a, b, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_HingeLine(w, f.sheet, a, b, NULL));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyLineLoad(w, f.sheet, a, b, NULL));
    REFUSED_FLOATS(q, 3, kiriSheet_ApplyLineLoad(w, f.sheet, a, b, q));
#define REFUSED_LINE(from, to)                                                                                         \
    do {                                                                                                               \
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ClampLine(w, f.sheet, from, to, &pin));                                 \
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_HingeLine(w, f.sheet, from, to, &pin));                                 \
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyLineLoad(w, f.sheet, from, to, q));                                \
    } while (0)
    REFUSED_LINE(NULL, b);
    REFUSED_LINE(a, NULL);
    REFUSED_LINE(a, a);
    REFUSED_LINE(far, b);
    REFUSED_LINE(a, far);
    for (int i = 0; i < 3; ++i) {
        REFUSED_LINE(beside[i], beside[i] + 2);
    }
    REFUSED_FLOATS(a, 2, kiriSheet_ClampLine(w, f.sheet, a, b, &pin));
    REFUSED_FLOATS(b, 2, kiriSheet_HingeLine(w, f.sheet, a, b, &pin));
    REFUSED_FLOATS(b, 2, kiriSheet_ApplyLineLoad(w, f.sheet, a, b, q));
    Host_Stop(host);
}

TEST(PoseArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    float x[3] = { 0.0f, 0.0f, 0.0f }, r[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    static const float a[2] = { 0.0f, 0.0f }, b[2] = { 0.0f, 1.0f };
    kiriPin pin = World_Clamp(w, f.sheet, a, b);
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, f.pin, x, r)); /* it holds a point */
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, pin, NULL, r));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, pin, x, NULL));
    REFUSED_FLOATS(x, 3, kiriPin_SetPose(w, pin, x, r));
    REFUSED_FLOATS(r, 9, kiriPin_SetPose(w, pin, x, r));
    r[8] = -1.0f; /* a mirror */
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, pin, x, r));
    r[4] = -1.0f;
    OK(kiriPin_SetPose(w, pin, x, r));
    r[1] = 0.1f;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, pin, x, r));
    Host_Stop(host);
}

TEST(LoadArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    float at[2] = { 0.4f, 0.6f }, v[3] = { 1.0f, 2.0f, 3.0f }, u[3] = { 0.0f, 0.0f, 0.0f }, p = 1.0f;
    static const float out[5] = { -0.01f, 1.01f, 1e30f, -1e30f, 16.5f };
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyForce(w, f.sheet, NULL, v, v));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyForce(w, f.sheet, at, NULL, v));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyForce(w, f.sheet, at, v, NULL));
    REFUSED_FLOATS(at, 2, kiriSheet_ApplyForce(w, f.sheet, at, u, v));
    REFUSED_FLOATS(u, 3, kiriSheet_ApplyForce(w, f.sheet, at, u, v));
    REFUSED_FLOATS(v, 3, kiriSheet_ApplyForce(w, f.sheet, at, u, v));
    for (int i = 0; i < 10; ++i) {
        at[i % 2] = out[i / 2];
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyForce(w, f.sheet, at, u, v));
        at[i % 2] = 0.5f;
    }
    REFUSED_FLOATS(&p, 1, kiriSheet_ApplyPressure(w, f.sheet, p));
    Host_Stop(host);
}

TEST(ShortIndicesNeedFewVertices)
{
    enum { SIDE = 256 };
    uint16_t indices[3];
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet many = Host_AddRectangle(&host, &def, 1.0f, 1.0f, SIDE, SIDE - 1);
    assert_int_equal(kiriSheet_CopyIndices16(host.world, many, 0, 1, indices), KIRI_ERROR_STATE);
    kiriSheet few = Host_AddRectangle(&host, &def, 1.0f, 1.0f, SIDE - 2, SIDE - 1);
    OK(kiriSheet_CopyIndices16(host.world, few, 0, 1, indices));
}

TEST(ContactArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    int32_t points = Host_Counts(host, f.sheet).collisionPoints;
    kiriContact c[2] = { { .point = 0, .normal = { 0.0f, 0.6f, 0.8f }, .friction = 0.5f },
                         { .point = 1, .normal = { 1.0f, 0.0f, 0.0f }, .inverseMass = 2.0f, .pushSpeed = 0.5f } };
    const struct {
        float* field;
        int count;
    } floats[] = { { c[1].normal, 3 },    { &c[1].offset, 1 },      { c[1].velocity, 3 },
                   { &c[1].friction, 1 }, { &c[1].inverseMass, 1 }, { &c[1].pushSpeed, 1 } };
    for (int i = 0; i < 6; ++i) {
        REFUSED_FLOATS(floats[i].field, floats[i].count, kiriSheet_SetContacts(w, f.sheet, c, 2));
    }
    const int32_t wrongPoints[] = { -2, points, INT32_MIN, INT32_MAX };
    for (int i = 0; i < 4; ++i) {
        c[1].point = wrongPoints[i];
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetContacts(w, f.sheet, c, 2));
        c[1].point = 1;
    }
    const struct {
        float* field;
        float value;
    } ranges[] = { { &c[1].normal[0], 0.0f },  { &c[1].normal[0], 1.1f }, { &c[1].normal[1], 0.5f },
                   { &c[1].normal[2], 1e30f }, { &c[1].friction, -0.1f }, { &c[1].inverseMass, -1.0f },
                   { &c[1].pushSpeed, -1.0f } };
    for (int i = 0; i < 7; ++i) {
        float kept = *ranges[i].field;
        *ranges[i].field = ranges[i].value;
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetContacts(w, f.sheet, c, 2));
        *ranges[i].field = kept;
    }
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetContacts(w, f.sheet, NULL, 1));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetContacts(w, f.sheet, c, -1));
    OK(kiriSheet_SetContacts(w, f.sheet, c, 2));
    OK(kiriSheet_SetContacts(w, f.sheet, NULL, 0));
    Host_Stop(host);
}

/* Finite is finite: nothing crashes, and what comes out is finite, or the sheet is said to have diverged. */
TEST(HugeValues)
{
    for (int what = 0; what < 8; ++what) {
        Fixture f;
        Setup(&f);
        Host* host = &f.host;
        kiriWorld* w = host->world;
        static const float huge[3] = { 1e30f, -1e30f, 1e30f };
        static const float eye[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
        static const float blade[12] = { -1e30f, -1e30f, 0.0f, 1e30f,  -1e30f, 0.0f,
                                         1e30f,  1e30f,  0.0f, -1e30f, 1e30f,  1e30f };
        float inside[2] = { 0.5f, 0.5f };
        kiriContact contact = { .point = 0, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 1e30f, .friction = 1e30f };
        kiriPinDef pin;
        kiriPin made;
        kiriCut cut;
        kiriHit hit;
        kiriDefaultPinDef(&pin);
        memcpy(pin.target, huge, sizeof(huge));
        pin.stiffness = 1e30f;
        switch (what) {
        case 0:
            OK(kiriWorld_SetGravity(w, huge));
            break;
        case 1:
            OK(kiriPin_SetTarget(w, f.pin, huge));
            break;
        case 2:
            OK(kiriCreatePin(w, f.sheet, &pin, &made));
            break;
        case 3:
            OK(kiriFrame_ApplyForce(w, f.frame, huge, huge));
            break;
        case 4:
            OK(kiriFrame_Hold(w, f.frame, huge, eye));
            break;
        case 5:
            OK(kiriSheet_SetContacts(w, f.sheet, &contact, 1));
            break;
        case 6:
            OK(kiriSheet_Slice(w, f.sheet, blade, &cut));
            break;
        default:
            OK(kiriCut_Extend(w, f.cut, huge, 1));
            OK(kiriCut_Extend(w, f.cut, inside, 1));
            OK(kiriSheet_Raycast(w, f.sheet, huge, huge, 1e30f, &hit));
            assert_int_equal(hit.triangle, -1);
        }
        for (int tick = 0; tick < 3; ++tick) {
            kiriResult result = Host_Tick(host, 0.01f, 2);
            assert_true(result == KIRI_OK || result == KIRI_DIVERGED);
            kiriMesh mesh = Host_Mesh(host, f.sheet);
            if (!AllFinite(mesh.positions, 3 * mesh.vertexCount) || !AllFinite(mesh.normals, 3 * mesh.vertexCount)) {
                fail_msg("huge value %d, tick %d: not finite", what, tick);
            }
        }
        Host_Stop(host);
    }
}

/* What a host with a copy of the mesh needs, and no less: after every tick its copy is the mesh. */
static void CutOn(Host* host, kiriCut cut, uint32_t* seed)
{
    float point[2];
    point[0] = (float)RandomBetween(seed, 0.0, 1.0);
    point[1] = (float)RandomBetween(seed, 0.0, 1.0);
    OK(kiriCut_Extend(host->world, cut, point, 1));
    OK(Host_Tick(host, 0.01f, 1));
}

/* A host that asks for changes only in every Nth tick keeps a copy of the mesh. */
static void CopyEvery(int32_t every)
{
    Host h, *host = &h;
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 6, 6);
    enum { MOST = 16384 };
    static float places[8 * MOST], rest[2 * MOST];
    static uint16_t indices[3 * MOST];
    uint32_t revision = 0, seed = 5;
    kiriCut cut = World_BeginCut(host->world, sheet, (float[]){ 0.1f, 0.5f });
    for (int tick = 0; tick < 50; ++tick) {
        kiriDirty dirty;
        if (tick % every != 0) {
            CutOn(host, cut, &seed);
            continue;
        }
        OK(kiriSheet_GetDirty(host->world, sheet, revision, &dirty));
        kiriMesh mesh = Host_Mesh(host, sheet);
        assert_true(mesh.vertexCount <= MOST && mesh.triangleCount <= MOST);
        assert_true(tick == 0 || dirty.newTriangles.first > 0);
        revision = dirty.revision;
        const kiriRange vertices[2] = { dirty.newVertices, dirty.oldVertices };
        const kiriRange triangles[2] = { dirty.newTriangles, dirty.oldTriangles };
        for (int k = 0; k < 2; ++k) {
            memcpy(&rest[2 * vertices[k].first], &mesh.restPositions[2 * vertices[k].first],
                   2 * sizeof(float) * (size_t)vertices[k].count);
            OK(kiriSheet_CopyIndices16(host->world, sheet, triangles[k].first, triangles[k].count,
                                       &indices[3 * triangles[k].first]));
        }
        OK(kiriSheet_CopyVertices(host->world, sheet, 0, mesh.vertexCount, places, 32, places + 3, 32));
        assert_memory_equal(rest, mesh.restPositions, 2 * sizeof(float) * (size_t)mesh.vertexCount);
        for (int32_t i = 0; i < 3 * mesh.triangleCount; ++i) {
            assert_int_equal(indices[i], mesh.indices[i]);
        }
        for (int32_t v = 0; v < mesh.vertexCount; ++v) {
            assert_memory_equal(&places[8 * v], &mesh.positions[3 * v], 3 * sizeof(float));
            assert_memory_equal(&places[8 * v + 3], &mesh.normals[3 * v], 3 * sizeof(float));
        }
        REFUSED(KIRI_ERROR_ARGUMENT,
                kiriSheet_CopyVertices(host->world, sheet, 1, mesh.vertexCount, places, 12, NULL, 0));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_CopyVertices(host->world, sheet, 0, 1, places, 8, NULL, 0));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_CopyIndices16(host->world, sheet, 0, mesh.triangleCount + 1, indices));
        CutOn(host, cut, &seed);
    }
    Host_Stop(host);
}

TEST(Copies)
{
    CopyEvery(1);
    CopyEvery(7);
    CopyEvery(20);
}

/* A line names the function, the argument, the member or index, the value, and what it should be. */
TEST(LinesNameArguments)
{
    Fixture f;
    Host* host = Setup(&f);
    kiriWorld* w = host->world;
    const float bad[4] = { 0.0f, 0.0f, 0.0f, NAN };
    const kiriBudget budget = { 0, -7, 0, 0 };
    kiriSheetDef def = Host_SmallDef();
    uint32_t id;
    kiriObstacleDef sphere = DefaultObstacle();
    sphere.type = KIRI_OBSTACLE_SPHERE;
#define SAYS(call, text)                                                                                               \
    do {                                                                                                               \
        assert_true((call) < 0);                                                                                       \
        assert_string_equal(host->line, text);                                                                         \
    } while (0)
    SAYS(kiriWorld_SetGravity(w, &bad[1]), "kiriWorld_SetGravity: gravity[2] is NaN, not finite (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriWorld_SetGravity(w, NULL), "kiriWorld_SetGravity: gravity is null (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriWorld_SetBudget(w, &budget),
         "kiriWorld_SetBudget: budget.cells is -7, not within 0 and 2147483647 (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriSheet_Wake(w, 77), "kiriSheet_Wake: sheet is 77: there is no sheet with this id (KIRI_ERROR_ID)");
    SAYS(kiriCut_Extend(w, f.cut, bad, 2), "kiriCut_Extend: restPoints[3] is NaN, not finite (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriCut_Extend(w, f.cut, bad, 0),
         "kiriCut_Extend: restPoints: count is 0, not within 1 and 16777216 (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriPin_SetBreakForce(w, f.pin, -0.125f),
         "kiriPin_SetBreakForce: breakForce is -0.125, not 0 or more (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriCreateObstacle(w, &sphere, &id),
         "kiriCreateObstacle: def has a radius that is not above 0 and up to 1e6 (KIRI_ERROR_ARGUMENT)");
    sphere.position[1] = -2e38f;
    SAYS(kiriCreateObstacle(w, &sphere, &id), "kiriCreateObstacle: def.position[1] is -2e38, not within -4.2535e37 and "
                                              "4.2535e37 (KIRI_ERROR_ARGUMENT)");
    def.material.density = -INFINITY;
    SAYS(kiriCreateRectangle(w, 1.0f, 1.0f, 1, 1, &def, &id),
         "kiriCreateRectangle: def.material.density is -infinity, not above 0 (KIRI_ERROR_ARGUMENT)");
    def.material.density = 1.0f;
    def.accuracy = 2.5e-5f;
    SAYS(kiriCreateRectangle(w, 1.0f, 1.0f, 1, 1, &def, &id),
         "kiriCreateRectangle: def.accuracy is 2.5e-5, not within 1e-4 and 1 (KIRI_ERROR_ARGUMENT)");
    Host_Stop(host);
}
