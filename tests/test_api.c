/* Bad input: every function refuses it with the right code and one line, and the world stays as it was. */
#include "every_call.h"

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
    kiriTearing tearing;
    for (int32_t preset = -1; preset <= KIRI_MATERIAL_COUNT; ++preset) {
        kiriResult result = kiriGetTearing(preset, &tearing);
        assert_true(result == (preset < 0 || preset == KIRI_MATERIAL_COUNT ? KIRI_ERROR_ARGUMENT : KIRI_OK));
        assert_true(result != KIRI_OK || (tearing.toughness >= 1e4f && tearing.strength >= 1e7f));
    }
    assert_true(kiriGetTearing(0, NULL) == KIRI_ERROR_ARGUMENT && tearing.maxTips == 0);
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

/* Rectangles of all setups move, as slender as they may be; other numbers write nothing. */
TEST(Setups)
{
    static const float sizes[][2] = { { 0.3f, 0.3f }, { 1.5f, 1.0f }, { 0.03f, 0.6f }, { 5.12f, 0.02f } };
    static const float bad[][2] = { { 0.0f, 1.0f },  { 1.0f, -1.0f },        { NAN, 1.0f },     { 1.0f, NAN },
                                    { 2.6f, 0.01f }, { INFINITY, INFINITY }, { 1.0f, INFINITY } };
    static const int32_t triangles[] = { 2 * 60 * 60, 2 * 60 * 40, 2 * 6 * 120, 2 * 1536 * 6 };
    kiriSheetDef def, refused = { .maxFrames = 7 };
    for (int32_t k = 0; k < KIRI_SETUP_COUNT * 4; ++k) {
        const float* size = sizes[k % 4];
        START_HOST(host);
        kiriSheet sheet;
        kiriMesh mesh;
        OK(kiriGetSetup(k / 4, size[0], size[1], &def));
        OK(kiriCreateRectangle(host.world, size[0], size[1], 0, 0, &def, &sheet));
        OK(kiriSheet_GetMesh(host.world, sheet, &mesh));
        assert_int_equal(mesh.triangleCount, triangles[k % 4]); /* three squares for two of the grid */
        OK(Host_Tick(&host, 1.0f / 60.0f, 4));
    }
    for (int k = 0; k < 7; ++k) {
        assert_int_equal(kiriGetSetup(KIRI_SETUP_CARD, bad[k][0], bad[k][1], &refused), KIRI_ERROR_ARGUMENT);
    }
    assert_int_equal(kiriGetSetup(-1, 1.0f, 1.0f, &refused), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriGetSetup(KIRI_SETUP_COUNT, 1.0f, 1.0f, &refused), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriGetSetup(KIRI_SETUP_CARD, 1.0f, 1.0f, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(refused.maxFrames, 7);
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
    START_STAND(s);
    Host* host = &s.tape.host;
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
}

/* A def is refused, *sheet is 0, and nothing is left behind. */
#define REFUSED_DEF(expected)                                                                                          \
    do {                                                                                                               \
        kiriSheet made = 77;                                                                                           \
        REFUSED(expected, kiriCreateSheet(host->world, &def, &made));                                                  \
        assert_int_equal(made, 0);                                                                                     \
    } while (0)

/* Arrays of a def, and their counts. test_ranges.c has the numbers. */
TEST(SheetDefArrays)
{
    START_STAND(s);
    Host* host = &s.tape.host;
    kiriSheetDef def = Host_SmallDef();
    float points[8];
    memcpy(points, def.framePoints, sizeof(points));
    def.framePoints = points;
    SCOPED_AS(Rectangle, r, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 2, 2);
    kiriSheet sheet;
    REFUSED_FLOATS(points, 8, kiriCreateSheet(host->world, &def, &sheet));
    REFUSED_FLOATS(r.positions, 18, kiriCreateSheet(host->world, &def, &sheet));
    static const float beside[6] = { -0.1f, 1.1f, 1e30f, -1e30f, 16.1875f, -7.1875f };
    for (int i = 0; i < 6; ++i) {
        float kept = points[i];
        points[i] = beside[i];
        REFUSED_DEF(KIRI_ERROR_ARGUMENT);
        points[i] = kept;
    }
    const struct {
        int32_t* field;
        int32_t values[4];
    } ints[] = { { &def.vertexCount, { 0, -1, INT32_MIN, 2 } },
                 { &def.triangleCount, { 0, -1, INT32_MIN, INT32_MAX } },
                 { &r.indices[4], { -1, INT32_MIN, 9, INT32_MAX } } };
    for (int i = 0; i < 12; ++i) {
        int32_t kept = *ints[i / 4].field;
        *ints[i / 4].field = ints[i / 4].values[i % 4];
        REFUSED_DEF(KIRI_ERROR_ARGUMENT);
        *ints[i / 4].field = kept;
    }
    points[0] = points[2] + 0.01f; /* two frames in one cell */
    points[1] = points[3];
    REFUSED_DEF(KIRI_ERROR_ARGUMENT);
    points[0] = points[1] = 0.1875f;
    def.restPositions = NULL;
    REFUSED_DEF(KIRI_ERROR_ARGUMENT);
    def.restPositions = r.positions;
    def.indices = NULL;
    REFUSED_DEF(KIRI_ERROR_ARGUMENT);
    def.indices = r.indices;
    def.cookie += 1;
    REFUSED_DEF(KIRI_ERROR_DEF);
}

TEST(Meshes)
{
    START_STAND(s);
    Host* host = &s.tape.host;
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
    static const float degenerate[3][6] = { { 0.0f, 0.0f, 0.5f, 0.5f, 1.0f, 1.0f },
                                            { 2.0f, 2.0f, 2.0f, 2.0f, 2.0f, 2.0f },
                                            { 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1e-12f } }; /* too thin for the lattice */
    for (int i = 0; i < 3; ++i) {
        kiriSheetDef def = DefaultSheet();
        static const int32_t indices[3] = { 0, 1, 2 };
        def.restPositions = degenerate[i];
        def.vertexCount = 3;
        def.indices = indices;
        def.triangleCount = 1;
        REFUSED_DEF(KIRI_ERROR_MESH);
    }
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
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, -1, 0, NULL, &sheet), KIRI_ERROR_ARGUMENT);
    kiriSheetDef noGrid = SheetOf(INT32_MIN, 5);
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 0, 0, &noGrid, &sheet), KIRI_ERROR_ARGUMENT);
    assert_string_not_equal(kiriWorld_GetLastError(world), "");
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 2, 2, NULL, NULL), KIRI_ERROR_ARGUMENT);
    kiriSheetDef unstamped = Host_SmallDef();
    unstamped.cookie = 0;
    assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 2, 2, &unstamped, &sheet), KIRI_ERROR_DEF);
    for (int i = 0; i < 2; ++i) {
        Host_Stop(&hosts[i]);
    }
}

/* ---- Arguments of every call ---- */

typedef enum SlotKind { ID, FLOATS, NUMBER, INDEX, DEF, POINTER } SlotKind;

/* A member of Given: an argument that is made wrong. */
typedef struct Slot {
    const char* name;
    size_t offset;
    SlotKind kind;
    int32_t count; /* of floats */
} Slot;

#define SLOT(member, kind)                                                                                             \
    {                                                                                                                  \
        "g->" #member, offsetof(Given, member), kind, 0                                                                \
    }
#define FLOATS_SLOT(member, count)                                                                                     \
    {                                                                                                                  \
        "g->" #member, offsetof(Given, member), FLOATS, count                                                          \
    }
static const Slot slots[] = {
    SLOT(sheet, ID),         SLOT(folded, ID),       SLOT(frame, ID),         SLOT(pin, ID),
    SLOT(clamp, ID),         SLOT(cut, ID),          SLOT(blade, ID),         SLOT(obstacle, ID),
    SLOT(seam, ID),          FLOATS_SLOT(point, 2),  FLOATS_SLOT(end, 2),     FLOATS_SLOT(points, 400),
    FLOATS_SLOT(vector, 3),  FLOATS_SLOT(spin, 3),   FLOATS_SLOT(quad, 12),   FLOATS_SLOT(rotation, 9),
    FLOATS_SLOT(inertia, 6), SLOT(dt, NUMBER),       SLOT(size, NUMBER),      SLOT(index, INDEX),
    SLOT(one, INDEX),        SLOT(def, DEF),         SLOT(pinDef, DEF),       SLOT(obstacleDef, DEF),
    SLOT(seamDef, DEF),      SLOT(settings, DEF),    SLOT(draw, DEF),         SLOT(budget, POINTER),
    SLOT(wind, POINTER),     SLOT(tearing, POINTER), SLOT(fold, POINTER),     SLOT(contacts, POINTER),
    SLOT(frames, POINTER),   SLOT(save, POINTER),    SLOT(snapshot, POINTER), SLOT(replay, POINTER),
    SLOT(id, POINTER),       SLOT(ids, POINTER),     SLOT(count, POINTER),    SLOT(out, POINTER),
    SLOT(more, POINTER),
};

static bool Takes(const EveryCall* call, const Slot* slot)
{
    size_t length = strlen(slot->name);
    const char* at = strstr(call->arguments, slot->name);
    while (at != NULL && at[length] != ',' && at[length] != '\0') {
        at = strstr(at + 1, slot->name);
    }
    return at != NULL;
}

/* Makes the call with `value` in the slot, which must be refused: the id of a new thing is 0. */
static void Spoil(Stand* s, const EveryCall* call, const Slot* slot, const void* value, size_t bytes,
                  kiriResult expected)
{
    Host* host = &s->tape.host;
    Given given = s->given;
    memcpy((char*)&given + slot->offset, value, bytes);
    *s->given.id = 77;
    Before before = Look(host);
    CheckRefused(host, before, call->make(host->world, &given), expected, call->name, __LINE__);
    bool makes = call->changes && given.id != NULL && strstr(call->arguments, "g->id") != NULL &&
                 strstr(call->arguments, "g->ids") == NULL;
    assert_int_equal(*s->given.id, makes ? 0 : 77);
}

/* Nothing, garbage, neighbours of a living id, and ids of other kinds. */
static void SpoilId(Stand* s, const EveryCall* call, const Slot* slot)
{
    const Given* g = &s->given;
    uint32_t living;
    memcpy(&living, (const char*)g + slot->offset, sizeof(living));
    const uint32_t ids[] = {
        0,      0x12345678u, UINT32_MAX, living ^ (1u << 18), living | 0xffffu, living ^ (1u << 31), g->sheet, g->frame,
        g->pin, g->cut,      g->blade,   g->obstacle,         g->seam
    };
    for (size_t i = 0; i < sizeof(ids) / sizeof(ids[0]); ++i) {
        bool isKind =
            ids[i] == living || (living == g->folded && ids[i] == g->sheet) || (living == g->clamp && ids[i] == g->pin);
        if (!isKind && (ids[i] != 0 || strcmp(call->name, "kiriBeginBlade") != 0)) {
            Spoil(s, call, slot, &ids[i], sizeof(ids[i]), KIRI_ERROR_ID);
        }
    }
}

/* Each of the first floats NaN and infinite. */
static void SpoilFloats(Stand* s, const EveryCall* call, const Slot* slot)
{
    const float *floats, *spoiled;
    float copy[400];
    memcpy(&floats, (const char*)&s->given + slot->offset, sizeof(floats));
    for (int32_t i = 0; i < slot->count && i < 12; ++i) {
        memcpy(copy, floats, sizeof(float) * (size_t)slot->count);
        spoiled = copy;
        for (int k = 0; k < 3; ++k) {
            copy[i] = badFloats[k];
            Spoil(s, call, slot, &spoiled, sizeof(spoiled), KIRI_ERROR_ARGUMENT);
        }
    }
}

static void SpoilSlot(Stand* s, const EveryCall* call, const Slot* slot)
{
    static const int32_t badIndices[3] = { -1, INT32_MIN, INT32_MAX };
    static const char zeros[sizeof(kiriSheetDef)];
    const void *none = NULL, *zeroed = zeros;
    if (slot->kind == ID) {
        SpoilId(s, call, slot);
        return;
    }
    if (slot->kind == NUMBER) {
        for (int k = 0; k < 3; ++k) {
            Spoil(s, call, slot, &badFloats[k], sizeof(float), KIRI_ERROR_ARGUMENT);
        }
        return;
    }
    if (slot->kind == INDEX) {
        for (int k = 0; k < (slot->offset == offsetof(Given, one) ? 2 : 3); ++k) { /* a count may be any room */
            Spoil(s, call, slot, &badIndices[k], sizeof(int32_t), KIRI_ERROR_ARGUMENT);
        }
        return;
    }
    Spoil(s, call, slot, &none, sizeof(none), KIRI_ERROR_ARGUMENT);
    if (slot->kind == FLOATS) {
        SpoilFloats(s, call, slot);
    } else if (slot->kind == DEF) { /* a program forgot to fill it: the line names the function that does */
        Spoil(s, call, slot, &zeroed, sizeof(zeroed), KIRI_ERROR_DEF);
        assert_non_null(strstr(s->tape.host.line,
                               slot->offset == offsetof(Given, settings) ? "kiriSheet_GetSettings" : "kiriDefault"));
    }
}

/* Each argument of each call wrong by itself, and the world null. */
TEST(EachArgument)
{
    START_STAND(s);
    World_PieceMesh(s.tape.host.world, s.given.sheet, 0); /* makes the lists of pieces, which stay */
    for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
        assert_int_equal(call->make(NULL, &s.given), KIRI_ERROR_ARGUMENT);
        for (size_t i = 0; i < sizeof(slots) / sizeof(slots[0]); ++i) {
            if (Takes(call, &slots[i])) {
                SpoilSlot(&s, call, &slots[i]);
            }
        }
    }
    kiriSheet sheet = s.given.sheet;
    assert_int_equal(kiriCreateRectangle(NULL, 1.0f, 1.0f, 4, 4, NULL, &sheet), KIRI_ERROR_ARGUMENT);
    assert_true(sheet == 0 && kiriWorld_GetLastError(NULL)[0] == '\0');
}

/* The arguments are valid: EachArgument is refused for the one that it makes wrong. */
TEST(EachCallGoesWell)
{
    for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
        START_STAND(s);
        if (Stand_Make(&s, call) < 0) {
            fail_msg("%s", s.tape.host.line);
        }
    }
}

/* A number of a struct, and two values below or above its range. Floats may not be NaN or infinite either. */
typedef struct Member {
    const char* call;
    size_t slot, bytes, offset;
    bool isWhole;
    double bad[2];
} Member;

#define MEMBER(call, slot, Type, member) #call, offsetof(Given, slot), sizeof(Type), offsetof(Type, member)
#define REAL(call, slot, Type, member, low, high)                                                                      \
    {                                                                                                                  \
        MEMBER(call, slot, Type, member), false,                                                                       \
        {                                                                                                              \
            low, high                                                                                                  \
        }                                                                                                              \
    }
#define WHOLE(call, slot, Type, member, low, high)                                                                     \
    {                                                                                                                  \
        MEMBER(call, slot, Type, member), true,                                                                        \
        {                                                                                                              \
            low, high                                                                                                  \
        }                                                                                                              \
    }
/* Of the second of the contacts. */
#define CONTACT(member, isWhole, low, high)                                                                            \
    {                                                                                                                  \
        "kiriSheet_SetContacts", offsetof(Given, contacts), 12 * sizeof(kiriContact),                                  \
            sizeof(kiriContact) + offsetof(kiriContact, member), isWhole,                                              \
        {                                                                                                              \
            low, high                                                                                                  \
        }                                                                                                              \
    }
static const Member members[] = {
    CONTACT(point, true, -2, INT32_MAX),
    CONTACT(normal[0], false, 1.1, 1e30),
    CONTACT(normal[2], false, 0.0, 0.5),
    CONTACT(offset, false, NAN, NAN),
    CONTACT(velocity[1], false, NAN, NAN),
    CONTACT(friction, false, -0.1, NAN),
    CONTACT(inverseMass, false, -1.0, NAN),
    CONTACT(pushSpeed, false, -1.0, NAN),
    REAL(kiriSheet_SetWind, wind, kiriWind, velocity[0], NAN, NAN),
    REAL(kiriSheet_SetWind, wind, kiriWind, density, -1.0, NAN),
    REAL(kiriSheet_SetWind, wind, kiriWind, drag, -1.0, NAN),
    REAL(kiriSheet_SetWind, wind, kiriWind, lift, -1.0, NAN),
    REAL(kiriSheet_SetTearing, tearing, kiriTearing, toughness, -1.0, NAN),
    REAL(kiriSheet_SetTearing, tearing, kiriTearing, grain[0], NAN, NAN),
    REAL(kiriSheet_SetTearing, tearing, kiriTearing, grainRatio, -1.0, NAN),
    REAL(kiriSheet_SetTearing, tearing, kiriTearing, maxSpeed, -1.0, NAN),
    WHOLE(kiriSheet_SetTearing, tearing, kiriTearing, maxTips, -1, INT32_MIN),
    REAL(kiriSheet_SetSettings, settings, kiriSheetSettings, material.poissonsRatio, -0.1, 0.5),
    WHOLE(kiriSheet_SetSettings, settings, kiriSheetSettings, maxFrames, 0, -1),
    WHOLE(kiriSheet_SetSettings, settings, kiriSheetSettings, skinning, -1, 2),
    REAL(kiriSheet_AddFold, fold, kiriFold, from[0], NAN, NAN),
    REAL(kiriSheet_AddFold, fold, kiriFold, to[1], NAN, NAN),
    REAL(kiriSheet_AddFold, fold, kiriFold, stiffness, -1.0, NAN),
    REAL(kiriSheet_AddFold, fold, kiriFold, restAngle, -3.2, 3.2),
    REAL(kiriSheet_AddFold, fold, kiriFold, yieldMoment, -1.0, NAN),
    REAL(kiriCreateSeam, seamDef, kiriSeamDef, stiffness, -1.0, NAN),
    REAL(kiriCreateSeam, seamDef, kiriSeamDef, restAngle, -3.2, 3.2),
    REAL(kiriCreateSeam, seamDef, kiriSeamDef, breakForce, -1.0, NAN),
    WHOLE(kiriCreateSeam, seamDef, kiriSeamDef, stitches, 1, -1),
    WHOLE(kiriCreateSeam, seamDef, kiriSeamDef, countA, 1, 65537),
    WHOLE(kiriCreateSeam, seamDef, kiriSeamDef, countB, 0, -1),
    WHOLE(kiriWorld_SetBudget, budget, kiriBudget, triangles, -1, 15),
    WHOLE(kiriWorld_SetBudget, budget, kiriBudget, cells, -1, INT32_MIN),
    WHOLE(kiriWorld_SetBudget, budget, kiriBudget, samples, -1, INT32_MIN),
    WHOLE(kiriWorld_SetBudget, budget, kiriBudget, iterations, -1, INT32_MIN),
    REAL(kiriCreatePin, pinDef, kiriPinDef, target[1], NAN, NAN),
    REAL(kiriCreatePin, pinDef, kiriPinDef, stiffness, -1.0, NAN),
    REAL(kiriCreatePin, pinDef, kiriPinDef, breakForce, -1.0, NAN),
    REAL(kiriWorld_DebugDraw, draw, kiriDebugDraw, size, 0.0, -1.0),
    WHOLE(kiriWorld_DebugDraw, draw, kiriDebugDraw, flags, KIRI_DRAW_ALL + 1, INT32_MIN),
};

TEST(EachMember)
{
    START_STAND(s);
    for (size_t i = 0; i < sizeof(members) / sizeof(members[0]); ++i) {
        const Member* member = &members[i];
        const double values[5] = { member->bad[0], member->bad[1], NAN, INFINITY, -INFINITY };
        for (int k = 0; k < (member->isWhole ? 2 : 5); ++k) {
            char spoiled[1024];
            const void *good, *bad = spoiled;
            int32_t whole = member->isWhole ? (int32_t)values[k] : 0;
            float real = (float)values[k];
            memcpy(&good, (const char*)&s.given + member->slot, sizeof(good));
            assert_true(member->bytes <= sizeof(spoiled));
            memcpy(spoiled, good, member->bytes);
            memcpy(spoiled + member->offset, member->isWhole ? (const void*)&whole : (const void*)&real, 4);
            const Slot slot = { .offset = member->slot };
            Spoil(&s, EveryCall_Find(member->call), &slot, &bad, sizeof(bad), KIRI_ERROR_ARGUMENT);
        }
    }
}

/* Numbers that are arguments themselves. */
TEST(EachNumber)
{
    static const struct {
        const char* call;
        size_t slot;
        float bad[2];
    } numbers[] = {
        { "kiriWorld_Tick", offsetof(Given, dt), { 0.9e-6f, 10.001f } },
        { "kiriSheet_SetFold", offsetof(Given, dt), { -3.2f, 3.2f } },
        { "kiriSheet_SetFold", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriSheet_SetTearLine", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriSheet_GetSolid", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriSheet_Raycast", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriWorld_Raycast", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriSheet_DropCrumbs", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriBlade_MoveRay", offsetof(Given, size), { 0.0f, -1.0f } },
        { "kiriPin_SetBreakForce", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriSeam_SetHinge", offsetof(Given, size), { -0.1f, -1e30f } },
        { "kiriSeam_SetHinge", offsetof(Given, dt), { -3.2f, 3.2f } },
        { "kiriObstacle_SetMass", offsetof(Given, size), { -0.1f, -1e30f } },
    };
    START_STAND(s);
    for (size_t i = 0; i < 2 * sizeof(numbers) / sizeof(numbers[0]); ++i) {
        const Slot slot = { .offset = numbers[i / 2].slot };
        Spoil(&s, EveryCall_Find(numbers[i / 2].call), &slot, &numbers[i / 2].bad[i % 2], sizeof(float),
              KIRI_ERROR_ARGUMENT);
    }
}

/* What ends a thing, and the argument that then names nothing. */
TEST(DeadIds)
{
    static const struct {
        const char *ends, *slot;
    } deaths[] = { { "kiriDestroySheet", "g->sheet" },       { "kiriDestroySheet", "g->frame" },
                   { "kiriDestroySheet", "g->pin" },         { "kiriDestroySheet", "g->cut" },
                   { "kiriDestroySheet", "g->seam" },        { "kiriDestroyPin", "g->pin" },
                   { "kiriBlade_End", "g->blade" },          { "kiriDestroySeam", "g->seam" },
                   { "kiriDestroyObstacle", "g->obstacle" }, { "kiriFrame_DestroyPiece", "g->frame" } };
    for (size_t i = 0; i < sizeof(deaths) / sizeof(deaths[0]); ++i) {
        START_STAND(s);
        Host* host = &s.tape.host;
        assert_true(Stand_Make(&s, EveryCall_Find(deaths[i].ends)) >= 0);
        OK(Host_Tick(host, 0.01f, 1));
        for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
            const Slot slot = { .name = deaths[i].slot };
            if (Takes(call, &slot)) {
                Before before = Look(host);
                CheckRefused(host, before, Stand_Make(&s, call), KIRI_ERROR_ID, call->name, __LINE__);
            }
        }
    }
}

/* ---- Values that are out of range ---- */

TEST(Nulls)
{
    kiriWorldDef def = DefaultWorld();
    kiriDefaultWorldDef(NULL);
    kiriDefaultSheetDef(NULL);
    kiriDefaultPinDef(NULL);
    kiriDefaultDebugDraw(NULL);
    kiriDestroyWorld(NULL);
    assert_int_equal(kiriCreateWorld(&def, NULL), KIRI_ERROR_ARGUMENT);
    assert_non_null(strstr(kiriGetResultText(KIRI_ERROR_DEF), "kiriDefaultWorldDef"));
}

static const float outside[8][2] = { { -0.01f, 0.5f }, { 1.01f, 0.5f },  { 0.5f, -0.01f }, { 0.5f, 1.01f },
                                     { 1e30f, 0.5f },  { 0.5f, -1e30f }, { 16.5f, 0.5f },  { 3.4e38f, 3.4e38f } };

TEST(PointsOutside)
{
    START_STAND(s);
    Host* host = &s.tape.host;
    kiriWorld* w = host->world;
    static const float v[3] = { 1.0f, 2.0f, 3.0f };
    kiriFrame frame;
    float weight;
    int32_t count;
    kiriPin pin;
    for (int i = 0; i < 8; ++i) {
        kiriPinDef def = Host_PinDef(outside[i][0], outside[i][1], 0.0f, 0.0f, 0.0f);
        REFUSED(KIRI_ERROR_ARGUMENT,
                kiriSheet_GetWeights(w, s.given.sheet, outside[i], &frame, &weight, NULL, 1, &count));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriCreatePin(w, s.given.sheet, &def, &pin));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyForce(w, s.given.sheet, outside[i], v, v));
    }
}

/* Lines that are none, or meet nothing, whoever asks for them. */
TEST(LinesBeside)
{
    START_STAND(s);
    Host* host = &s.tape.host;
    kiriWorld* w = host->world;
    kiriPin pin;
    static const float q[3] = { 1.0f, 2.0f, 3.0f };
    static const float lines[6][4] = { { 0.2f, 0.3f, 0.2f, 0.3f },  { 1e30f, 0.0f, 0.7f, 0.9f },
                                       { 0.2f, 0.3f, 1e30f, 0.0f }, { -0.1f, 0.0f, -0.1f, 1.0f },
                                       { 1.2f, 0.1f, 1.3f, 0.5f },  { -0.2f, 0.1f, 0.1f, -0.2f } };
    for (int i = 0; i < 6; ++i) {
        const float *from = lines[i], *to = lines[i] + 2;
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ClampLine(w, s.given.sheet, from, to, &pin));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_HingeLine(w, s.given.sheet, from, to, &pin));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_ApplyLineLoad(w, s.given.sheet, from, to, q));
        const kiriFold fold = { { from[0], from[1] }, { to[0], to[1] }, 1.0f, 0.0f, 0.0f };
        if (i >= 3) { /* lines that end far outside cross it, and one point is a place of a tear */
            REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateFoldedSheet(w, s.given.def, &fold, 1, &pin));
            REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_AddFold(w, s.given.folded, &fold, s.given.count));
            REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetTearLine(w, s.given.sheet, from, 2, 0.5f));
            REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetTearLine(w, s.given.sheet, from, 1, 0.5f));
        }
    }
}

TEST(RotationsThatAreNone)
{
    START_STAND(s);
    Host* host = &s.tape.host;
    kiriWorld* w = host->world;
    static const float v[3] = { 1.0f, 2.0f, 3.0f }, wrong[3] = { 0.7f, -0.7f, 1e30f };
    float r[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    kiriPin pin = World_Clamp(w, s.given.sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 0.0f, 1.0f });
#define REFUSED_ROTATION                                                                                               \
    REFUSED(KIRI_ERROR_ARGUMENT, kiriFrame_Hold(w, s.given.frame, v, r));                                              \
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, pin, v, r))
    for (int i = 0; i < 27; ++i) {
        float kept = r[i / 3];
        r[i / 3] = wrong[i % 3];
        REFUSED_ROTATION;
        r[i / 3] = kept;
    }
    r[8] = -1.0f; /* a mirror */
    REFUSED_ROTATION;
    r[4] = -1.0f;
    OK(kiriPin_SetPose(w, pin, v, r));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriPin_SetPose(w, s.given.pin, v, r)); /* it holds a point */
    memset(r, 0, sizeof(r));
    REFUSED_ROTATION;
}

TEST(OtherRanges)
{
    START_STAND(s);
    Host* host = &s.tape.host;
    kiriWorld* w = host->world;
    static const float v[12] = { 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1.0f, 1.1f, 1.2f };
    kiriHit hit;
    kiriCut cut;
    kiriDebugDraw draw = *s.given.draw;
    draw.sheet = 12345;
    REFUSED(KIRI_ERROR_ID, kiriWorld_DebugDraw(w, &draw));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_Raycast(w, s.given.sheet, v, noVector, 1.0f, &hit));
    REFUSED(KIRI_ERROR_ARGUMENT, kiriBlade_MoveRay(w, s.given.blade, v, noVector, 1.0f));
    static const int32_t counts[3] = { 0, -1, INT32_MAX };
    for (int i = 0; i < 3; ++i) {
        REFUSED(KIRI_ERROR_ARGUMENT, kiriCut_Extend(w, s.given.cut, v, counts[i]));
    }
    OK(kiriCut_Extend(w, s.given.cut, v, 6));
    OK(kiriCut_End(w, s.given.cut));
    REFUSED(KIRI_ERROR_STATE, kiriCut_End(w, s.given.cut));
    REFUSED(KIRI_ERROR_STATE, kiriCut_Extend(w, s.given.cut, v, 1));
    OK(kiriSheet_Slice(w, s.given.sheet, v, &cut));
    REFUSED(KIRI_ERROR_STATE, kiriCut_End(w, cut)); /* a slice is ended already */
    REFUSED(KIRI_ERROR_STATE, kiriCut_Extend(w, cut, v, 1));
    kiriContact beyond = s.given.contacts[0];
    beyond.point = Host_Counts(host, s.given.sheet).collisionPoints;
    REFUSED(KIRI_ERROR_ARGUMENT, kiriSheet_SetContacts(w, s.given.sheet, &beyond, 1));
    OK(kiriSheet_SetContacts(w, s.given.sheet, NULL, 0));
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

/* Finite is finite: no call with huge numbers crashes, and the mesh stays finite, or the sheet is said to have diverged. */
TEST(HugeValues)
{
    static const float huge[3] = { 1e30f, -1e30f, 1e30f };
    static const float quad[12] = {
        -1e30f, -1e30f, 0.0f, 1e30f, -1e30f, 0.0f, 1e30f, 1e30f, 0.0f, -1e30f, 1e30f, 1e30f
    };
    for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
        START_STAND(s);
        Host* host = &s.tape.host;
        kiriPinDef pin = Host_PinDef(0.9f, 0.1f, 1e30f, -1e30f, 1e30f);
        kiriContact contacts[12] = { { .point = 0, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 1e30f } };
        float points[400];
        for (int i = 0; i < 400; ++i) {
            points[i] = i % 3 == 0 ? 0.5f : huge[i % 2];
        }
        for (int i = 1; i < 12; ++i) {
            contacts[i] = contacts[0];
        }
        pin.stiffness = contacts[0].friction = 1e30f;
        s.given.vector = s.given.spin = huge;
        s.given.quad = quad;
        s.given.points = points;
        s.given.pinDef = &pin;
        s.given.contacts = contacts;
        kiriResult result = Stand_Make(&s, call);
        assert_true(result >= 0 || result == KIRI_ERROR_ARGUMENT || result == KIRI_DIVERGED);
        for (int tick = 0; tick < 3 && strcmp(call->name, "kiriDestroySheet") != 0; ++tick) {
            result = Host_Tick(host, 0.01f, 2);
            assert_true(result >= 0 || result == KIRI_DIVERGED);
            kiriMesh mesh = Host_Mesh(host, s.given.sheet);
            if (!AllFinite(mesh.positions, 3 * mesh.vertexCount) || !AllFinite(mesh.normals, 3 * mesh.vertexCount)) {
                fail_msg("%s with huge values, tick %d: not finite", call->name, tick);
            }
        }
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

/* A host that asks for changes only in every Nth tick keeps a copy of the mesh, also where it goes back to cut otherwise. */
static void CopyEvery(int32_t every)
{
    START_HOST(own);
    Host* host = &own;
    kiriSheet sheet = Host_AddSmall(host, 6);
    enum { MOST = 16384 };
    static float places[8 * MOST], rest[2 * MOST];
    static uint16_t indices[3 * MOST];
    uint32_t revision = 0, seed = 5;
    kiriCut cut = World_BeginCut(host->world, sheet, (float[]){ 0.1f, 0.5f });
    Bytes past = World_Write(host->world, kiriWorld_Snapshot);
    bool isWhole = true;
    for (int tick = 0; tick < 50; ++tick) {
        kiriDirty dirty;
        if (tick % 7 == 3) {
            OK(kiriWorld_Restore(host->world, past.data, past.size));
            isWhole = true;
        }
        if (tick % every != 0) {
            CutOn(host, cut, &seed);
            continue;
        }
        OK(kiriSheet_GetDirty(host->world, sheet, revision, &dirty));
        kiriMesh mesh = Host_Mesh(host, sheet);
        assert_true(mesh.vertexCount <= MOST && mesh.triangleCount <= MOST);
        assert_true((dirty.newTriangles.first == 0) == isWhole);
        isWhole = false;
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
    Bytes_Free(&past);
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
    START_STAND(s);
    Host* host = &s.tape.host;
    kiriWorld* w = host->world;
    const float bad[4] = { 0.0f, 0.0f, 0.0f, NAN };
    const kiriBudget budget = { 0, -7, 0, 0 };
    kiriSheetDef def = Host_SmallDef();
    uint32_t id;
    kiriObstacleDef sphere = ObstacleOf(KIRI_OBSTACLE_SPHERE);
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
    SAYS(kiriCut_Extend(w, s.given.cut, bad, 2),
         "kiriCut_Extend: restPoints[3] is NaN, not finite (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriCut_Extend(w, s.given.cut, bad, 0),
         "kiriCut_Extend: restPoints: count is 0, not within 1 and 16777216 (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriSheet_ApplyForce(w, s.given.sheet, (float[]){ 5.0f, -0.125f }, bad, bad),
         "kiriSheet_ApplyForce: restPoint (5, -0.125) lies outside the material (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriCreateObstacle(w, &sphere, &id),
         "kiriCreateObstacle: def.radius is 0, not above 0 and up to 1000000 (KIRI_ERROR_ARGUMENT)");
    sphere.radius = 1.0f;
    sphere.position[1] = -2e38f;
    SAYS(kiriCreateObstacle(w, &sphere, &id), "kiriCreateObstacle: def.position[1] is -2e38, not within -4.2535e37 and "
                                              "4.2535e37 (KIRI_ERROR_ARGUMENT)");
    const kiriFrame frames[2] = { s.given.frame, 77 };
    SAYS(kiriWorld_DestroyPieces(w, frames, 2),
         "kiriWorld_DestroyPieces: frames[1] is 77: there is no frame with this id (KIRI_ERROR_ID)");
    kiriFoldState fold;
    int64_t size;
    SAYS(kiriWorld_Tick(w, 20.0f, 1), "kiriWorld_Tick: dt is 20, not within 1e-6 and 10 (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriCreateRectangle(w, 1.0f, -2.0f, 1, 1, &def, &id),
         "kiriCreateRectangle: height is -2, not above 0 (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriSheet_GetFold(w, s.given.sheet, 0, &fold),
         "kiriSheet_GetFold: index is 0, and there is none (KIRI_ERROR_ARGUMENT)");
    SAYS(kiriSheet_GetFold(w, 77, 0, &fold),
         "kiriSheet_GetFold: sheet is 77: there is no sheet with this id (KIRI_ERROR_ID)");
    SAYS(kiriWorld_Save(w, NULL, -3, &size), "kiriWorld_Save: capacity is -3, not 0 or more (KIRI_ERROR_ARGUMENT)");
    def.material.density = -INFINITY;
    SAYS(kiriCreateRectangle(w, 1.0f, 1.0f, 1, 1, &def, &id),
         "kiriCreateRectangle: def.material.density is -infinity, not above 0 (KIRI_ERROR_ARGUMENT)");
    def.accuracy = 2.5e-5f;
    SAYS(kiriCreateRectangle(w, 1.0f, 1.0f, 1, 1, &def, &id),
         "kiriCreateRectangle: def.accuracy is 2.5e-5, not within 1e-4 and 1 (KIRI_ERROR_ARGUMENT)");
}
