/* Where frames go: at slit ends, and not closer than the grid tells apart. */
#include "host.h"
#include "scene.h"

#include "field/kiri_site.h"
#include "sheet/kiri_sheet_site.h"
#include "world/kiri_world.h"

/* ---- Pairs at slit ends ---- */

/* With so many items at a time; how many times it took. */
static int32_t FindEnds(Scene* scene, const kiriPlacer* placer, kiriSlitEnds* ends, int64_t items)
{
    kiriSlitSearch search = { 0 };
    int32_t times = 0;
    kiriProgress progress = KIRI_MORE;
    for (; progress == KIRI_MORE; ++times) {
        kiriQuota quota = { items, 0, 0, false };
        progress = kiriSlits_FindEnds(ends, &search, &scene->grid, placer->cells.data, placer->cells.count, &quota);
        assert_true(progress != KIRI_MORE || quota.used == items);
    }
    assert_int_equal(progress, KIRI_DONE);
    return times;
}

static void AddPairs(Scene* scene, kiriSites* sites, double spacing, int32_t most)
{
    kiriPlacer placer = { 0 };
    Scene_BuildGrid(scene);
    assert_true(kiriPlacer_TakePiece(&placer, &scene->grid, Scene_Cell(scene, 0.01, 0.01)));
    kiriSlitEnds ends = { 0 };
    FindEnds(scene, &placer, &ends, INT64_MAX);
    assert_true(kiriSlits_AddPairs(sites, &scene->grid, &ends, spacing, most));
}

static void AssertSite(const kiriSites* sites, int32_t index, double u, double v)
{
    assert_in_range(index, 0, sites->count - 1);
    AssertNear(sites->data[index].at.x, u, 1e-6);
    AssertNear(sites->data[index].at.y, v, 1e-6);
}

/* A slit from the outline has one end, one inside the sheet two; their sites mirror each other. */
TEST(BothSidesOfEachEnd)
{
    SCOPED(Scene, scene, Scene_Release);
    kiriSites sites = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 20, 20, 40);
    Scene_Slit(&scene, 0.3, 0.0, 0.3, 0.4);
    Scene_Slit(&scene, 0.6, 0.7, 0.8, 0.7);
    AddPairs(&scene, &sites, 0.1, 100);
    assert_int_equal(sites.count, 6);
    AssertSite(&sites, 0, 0.25, 0.4);
    AssertSite(&sites, 1, 0.35, 0.4);
    AssertSite(&sites, 2, 0.6, 0.65);
    AssertSite(&sites, 3, 0.6, 0.75);
    AssertSite(&sites, 4, 0.8, 0.75);
    AssertSite(&sites, 5, 0.8, 0.65);
    for (int32_t i = 0; i < sites.count; ++i) {
        assert_int_equal(sites.data[i].cell, Scene_Cell(&scene, sites.data[i].at.x, sites.data[i].at.y));
    }
}

/* Where another slit is in the way the pair is closer; in a neck of the width of two squares there is none. */
TEST(AsCloseAsThereIsRoom)
{
    SCOPED(Scene, scene, Scene_Release);
    kiriSites sites = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 20, 20, 40);
    Scene_Slit(&scene, 0.3, 0.0, 0.3, 0.4);
    Scene_Slit(&scene, 0.4, 0.0, 0.4, 1.0);
    AddPairs(&scene, &sites, 0.3, 100);
    assert_int_equal(sites.count, 2);
    AssertSite(&sites, 0, 0.225, 0.4);
    AssertSite(&sites, 1, 0.375, 0.4);
    Scene_Release(&scene);

    memset(&sites, 0, sizeof(sites));
    Scene_Init(&scene, 1.0, 1.0, 20, 20, 10);
    Scene_Slit(&scene, 0.3, 0.0, 0.3, 0.4);
    Scene_Slit(&scene, 0.4, 0.0, 0.4, 1.0);
    AddPairs(&scene, &sites, 0.3, 100);
    assert_int_equal(sites.count, 0);
}

/* Corners of cuts, crossings, ends on the outline and on another cut are no slit ends. */
TEST(OnlyEnds)
{
    SCOPED(Scene, scene, Scene_Release);
    kiriSites sites = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 20, 20, 40);
    Scene_Slit(&scene, 0.3, 0.0, 0.3, 1.0);
    Scene_Slit(&scene, 0.0, 0.5, 0.3, 0.5);
    Scene_Slit(&scene, 0.1, 0.6, 0.2, 0.6);
    Scene_Slit(&scene, 0.2, 0.6, 0.2, 0.8);
    Scene_Slit(&scene, 0.2, 0.8, 0.1, 0.8);
    Scene_Slit(&scene, 0.1, 0.8, 0.1, 0.6);
    AddPairs(&scene, &sites, 0.1, 100);
    assert_int_equal(sites.count, 0);
}

/* The border between a pair goes from the slit's end to the outline, wherever in their squares slit and end lie: on a
   grid line, or across the middle. */
TEST(BordersBeginAtSlitEnds)
{
    for (int32_t resolution = 30; resolution < 70; ++resolution) {
        for (int k = 0; k < 6; ++k) {
            const float end = 0.35f + 0.05f * (float)(k % 3), tilt = k < 3 ? 0.0f : 0.01f;
            const float slit[4] = { 0.5f, -0.1f, 0.5f, end };
            const float points[4] = { 0.42f, end + tilt, 0.58f, end - tilt };
            START_HOST(host);
            kiriSheetDef def = DefaultSheet();
            def.gridResolution = resolution;
            def.frameCount = def.maxFrames = 2;
            def.framePoints = points;
            kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 20, 20);
            Host_Cut(&host, sheet, slit, 2);
            OK(Host_Tick(&host, 0.001f, 1));
            const kiriLinks* links = &host.world->sheets.data[0]->links;
            assert_int_equal(links->links.count, 1);
            double tangent = fabs(links->links.data[0].tangent.y), width = links->links.data[0].width;
            AssertNear(width * tangent, 1.0 - (double)end, 0.02 / resolution);
        }
    }
}

/* Sites around a slit's end, in squares from it, as a pair there and the placer leave them. */
static const float aroundEnd[8][2] = { { 1.0f, 0.0f },  { -1.0f, 0.0f }, { 0.5f, 2.5f },   { -0.5f, 3.5f },
                                       { 0.5f, -2.5f }, { -2.5f, 2.5f }, { -3.5f, -0.5f }, { 3.5f, -0.5f } };

/* A region beside a slit has no border with one on the other side, be it ever so near. The slit is on a grid line: so
   slivers of cells lie along it. */
TEST(BordersStayBesideSlits)
{
    const float slit[4] = { 0.5f, 1.1f, 0.5f, 0.3f };
    for (int32_t resolution = 20; resolution <= 80; resolution += 10) {
        float points[8][2];
        for (int k = 0; k < 8; ++k) {
            points[k][0] = slit[2] + aroundEnd[k][0] / (float)resolution;
            points[k][1] = slit[3] + aroundEnd[k][1] / (float)resolution;
        }
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.gridResolution = resolution;
        def.frameCount = def.maxFrames = 8;
        def.framePoints = points[0];
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 20, 20);
        Host_Cut(&host, sheet, slit, 2);
        OK(Host_Tick(&host, 0.001f, 1));
        const kiriLinks* links = &host.world->sheets.data[0]->links;
        assert_true(links->links.count > 8);
        for (int32_t k = 0; k < links->links.count; ++k) {
            const float *a = points[links->links.data[k].i], *b = points[links->links.data[k].j];
            double at = a[1] + (0.5 - a[0]) / (b[0] - a[0]) * (b[1] - a[1]); /* where the line meets the slit's */
            bool isAcross = (a[0] - 0.5f) * (b[0] - 0.5f) < 0.0f && at > 0.3 + 0.1 / resolution;
            assert_true(!isAcross || links->links.data[k].length > 1.001 * hypot(b[0] - a[0], b[1] - a[1]));
        }
    }
}

/* An end gets a pair also where that is two squares apart, as close as pairs are, and where sites shall be closer. */
TEST(PairsTwoSquaresApart)
{
    for (int32_t resolution = 20; resolution < 60; ++resolution) {
        for (int k = 1; k <= 2; ++k) {
            SCOPED(Scene, scene, Scene_Release);
            kiriSites sites = { 0 };
            Scene_Init(&scene, 1.0, 1.0, 20, 20, resolution);
            Scene_Slit(&scene, 0.3, 0.0, 0.3, 0.4);
            Scene_BuildGrid(&scene);
            double side = scene.grid.side;
            AddPairs(&scene, &sites, k * side, 100);
            assert_int_equal(sites.count, 2);
            AssertSite(&sites, 0, 0.3 - side, 0.4);
            AssertSite(&sites, 1, 0.3 + side, 0.4);
        }
    }
}

/* ---- What the grid carries ---- */

/* With a line that says what to do. */
static void AssertRefused(Host* host, kiriSheetDef* def, const char* part)
{
    kiriSheet sheet = 0;
    assert_int_equal(Host_TryRectangle(host, def, 1.0f, 0.5f, 8, 4, &sheet), KIRI_ERROR_ARGUMENT);
    assert_non_null(strstr(kiriWorld_GetLastError(host->world), part));
}

TEST(CloseFramePointsAreRefused)
{
    for (int32_t k = 1; k < 20; ++k) {
        float points[4] = { 0.51f, 0.26f, 0.51f + 0.01f * (float)k, 0.26f };
        START_HOST(host);
        kiriSheetDef def = SheetOf(10, 2);
        def.framePoints = points;
        if (k < 10) {
            AssertRefused(&host, &def, "gridResolution");
        } else {
            Host_AddRectangle(&host, &def, 1.0f, 0.5f, 8, 4);
        }
    }
}

TEST(NoMoreThanTheGridCarries)
{
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 10;
    def.maxFrames = 1;
    def.frameCount = 26;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.5f, 8, 4);
    assert_int_equal(Host_Counts(&host, sheet).frames, 25);
}

/* Re-sampling stops there, after cuts too. */
TEST(ResamplingStops)
{
    static const float across[4] = { 0.31f, -0.1f, 0.31f, 0.6f }, along[4] = { 0.5f, 0.26f, 1.1f, 0.26f };
    START_HOST(host);
    kiriSheetDef def = SheetOf(10, 2);
    def.rigidArea = 1e-9f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.5f, 8, 4);
    assert_int_equal(Host_Counts(&host, sheet).frames, 2);
    Host_Cut(&host, sheet, across, 2);
    Host_Cut(&host, sheet, along, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    kiriCounts counts = Host_Counts(&host, sheet);
    assert_int_equal(counts.pieces, 2);
    assert_in_range(counts.frames, 3, counts.cells / 2);
}

/* ---- How many ---- */

enum { MASK = 5, SHAPE_SQUARES = 4 * MASK };

/* A rectangle without some of its parts: with bays, holes, and often in several pieces. Vertices that nothing needs are
   left out. */
static Rectangle MakeShape(kiriSheetDef* def, uint32_t* seed)
{
    bool isThere[MASK * MASK];
    int32_t to[(SHAPE_SQUARES + 1) * (SHAPE_SQUARES + 1)], vertices = 0, triangles = 0;
    uint32_t share = Random(seed) % 5;
    Rectangle r = Rectangle_Make(def, 1.0f, (float)RandomBetween(seed, 0.1, 1.0), SHAPE_SQUARES, SHAPE_SQUARES);
    for (int32_t i = 0; i < MASK * MASK; ++i) {
        isThere[i] = Random(seed) % 8 >= share || i == MASK * MASK / 2;
    }
    memset(to, -1, sizeof(to));
    for (int32_t t = 0; t < def->triangleCount; ++t) {
        int32_t column = t / 2 % SHAPE_SQUARES / 4, row = t / 2 / SHAPE_SQUARES / 4;
        for (int32_t i = 0; i < 3 && isThere[MASK * row + column]; ++i) {
            int32_t old = r.indices[3 * t + i];
            if (to[old] < 0) {
                to[old] = vertices++;
            }
            r.indices[3 * triangles + i] = to[old];
        }
        triangles += isThere[MASK * row + column];
    }
    float* positions = malloc(2 * sizeof(float) * (size_t)vertices);
    for (int32_t v = 0; v < def->vertexCount; ++v) {
        if (to[v] >= 0) {
            memcpy(&positions[2 * to[v]], &r.positions[2 * v], 2 * sizeof(float));
        }
    }
    memcpy(r.positions, positions, 2 * sizeof(float) * (size_t)vertices);
    free(positions);
    def->vertexCount = vertices;
    def->triangleCount = triangles;
    return r;
}

/* A new sheet has no more frames than the host asked for, or than it has pieces: whatever its shape and its grid, and
   however rigid frames are. After cuts there may be more. */
TEST(NoMoreThanTheHostGave)
{
    uint32_t seed = 5;
    int32_t made = 0, parts = 0, more = 0;
    for (int32_t run = 0; run < 200; ++run) {
        static const float slash[4] = { -0.1f, 0.05f, 0.45f, 0.06f };
        kiriSheet sheet;
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        SCOPED_AS(Rectangle, shape, Rectangle_Free) = MakeShape(&def, &seed);
        def.gridResolution = 4 + (int32_t)(Random(&seed) % 60);
        def.frameCount = 1 + (int32_t)(Random(&seed) % (run % 3 == 0 ? 4 : 90));
        def.rigidArea = run % 4 == 0 ? (float)RandomBetween(&seed, 1e-4, 0.1) : 0.0f;
        def.rigidWeight = run % 5 == 0 ? 0.7f : def.rigidWeight;
        if (kiriCreateSheet(host.world, &def, &sheet) == KIRI_OK) {
            kiriCounts counts = Host_Counts(&host, sheet);
            int32_t most = def.frameCount < counts.cells / 2 ? def.frameCount : counts.cells / 2;
            assert_true(counts.pieces > 1 || counts.frames == most);
            assert_true(counts.frames <= (def.frameCount > counts.pieces ? def.frameCount : counts.pieces));
            Host_Cut(&host, sheet, slash, 2);
            OK(Host_Tick(&host, 0.01f, 1));
            made += 1;
            parts += counts.pieces > 1;
            more += Host_Counts(&host, sheet).frames > counts.frames;
        }
    }
    assert_true(made > 120 && parts > 20 && more > 10);
}

/* A cut brings frames where it makes some more rigid, and not those that a new sheet might have done with, too. */
TEST(FramesWhereCutIs)
{
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 64; /* where some of 100 frames hold more than their share */
    def.frameCount = 100;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 64, 64);
    Host_Cut(&host, sheet, (const float[]){ 0.41f, 0.5f, 0.46f, 0.52f }, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    assert_int_equal(Host_Counts(&host, sheet).frames, 100);
}

/* Rows of a stiff rectangle run along its longer side; their counts differ by one at most. */
TEST(StraightRowsInStiffRectangles)
{
    for (int32_t run = 0; run < 60; ++run) {
        float length = 0.3f, width = length * (1.0f - 0.0131f * (float)run);
        int32_t row = 0, least = INT32_MAX, most = 0;
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        OK(kiriGetMaterial(KIRI_MATERIAL_CARD, &def.material));
        def.gridResolution = 64;
        def.frameCount = 2 + run;
        Host_AddRectangle(&host, &def, run % 2 ? length : width, run % 2 ? width : length, 20, 20);
        const kiriSheetData* sheet = host.world->sheets.data[0];
        assert_int_equal(sheet->frames.count, def.frameCount);
        for (int32_t i = 0; i < sheet->frames.count; ++i) {
            kiriVec2 at = sheet->frames.data[i].site.at, next = sheet->frames.data[i + 1 < def.frameCount ? i + 1 : 0].site.at;
            ++row;
            if (fabs(run % 2 || width == length ? at.y - next.y : at.x - next.x) > 1e-6 || i + 1 == def.frameCount) {
                least = row < least ? row : least;
                most = row > most ? row : most;
                row = 0;
            }
        }
        assert_in_range(most, least, least + 1);
        assert_true(most * most * (double)width < 2.1 * def.frameCount * (double)length); /* nearly square regions */
    }
}
