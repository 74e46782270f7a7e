/* A thousand random cuts through one sheet. The world is validated after every third tick. */
#include "host.h"

enum { COLUMNS = 12, CUTS = RUNS(1000), CUTS_A_TICK = 10, FRAMES = 4 };

/* ---- What must hold ---- */

static void CheckFinite(const Host* host, kiriSheet sheet, const kiriMesh* mesh)
{
    const float* points;
    int32_t count;
    OK(kiriSheet_GetCollisionPoints(host->world, sheet, &points, &count));
    assert_true(AllFinite(points, 3 * count));
    assert_true(AllFinite(mesh->positions, 3 * mesh->vertexCount) && AllFinite(mesh->normals, 3 * mesh->vertexCount) &&
                AllFinite(mesh->sourceWeights, 3 * mesh->vertexCount));
}

static void CheckSheet(const Host* host, kiriSheet sheet, const kiriTotals* first)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    kiriTotals totals = Host_Totals(host, sheet);
    kiriCounts counts = Host_Counts(host, sheet);
    if (!(fabs(totals.area - first->area) <= 1e-12 * first->area &&
          fabs(totals.mass - first->mass) <= 1e-12 * first->mass)) {
        fail_msg("the area is off by %g of itself", totals.area / first->area - 1.0);
    }
    assert_true(counts.frames >= counts.pieces && counts.collisionPoints >= counts.pieces);
    CheckFinite(host, sheet, &mesh);
}

/* ---- Cuts of all kinds ---- */

static float Coordinate(uint32_t* seed)
{
    switch (Random(seed) % 4) {
    case 0:
        return (float)(Random(seed) % (COLUMNS + 1)) / COLUMNS; /* on a line of the mesh */
    case 1:
        return (float)(Random(seed) % 9) / 8.0f; /* on a line of the grid */
    default:
        return (float)RandomBetween(seed, -0.1, 1.1);
    }
}

static void RandomCut(Host* host, kiriSheet sheet, uint32_t* seed)
{
    float points[16];
    int32_t count = 2 + (int32_t)(Random(seed) % 3);
    double x = Coordinate(seed), y = Coordinate(seed), reach = Random(seed) % 100 == 0 ? 0.5 : 0.03;
    for (int32_t i = 0; i < count; ++i) {
        bool far = Random(seed) % 500 == 0;
        points[2 * i] = i == 0 ? (float)x : far ? Coordinate(seed) : (float)(x + RandomBetween(seed, -reach, reach));
        points[2 * i + 1] = i == 0 ? (float)y
                            : far  ? Coordinate(seed)
                                   : (float)(y + RandomBetween(seed, -reach, reach));
    }
    if (count > 2 && Random(seed) % 8 == 0) { /* closed */
        points[2 * count - 2] = points[0];
        points[2 * count - 1] = points[1];
    }
    Host_Cut(host, sheet, points, count);
}

static uint64_t Run(uint32_t seed, bool check)
{
    START_HOST(host);
    host.every = check ? 3 : CUTS; /* to save time */
    kiriSheetDef def = SheetOf(8, FRAMES);
    def.maxFrames = FRAMES;
    def.collisionPoints = 4;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, COLUMNS, COLUMNS);
    kiriTotals first = Host_Totals(&host, sheet);
    for (int32_t cut = 0; cut < CUTS;) {
        int32_t batch = 1 + (int32_t)(Random(&seed) % (2 * CUTS_A_TICK - 1)),
                end = cut + batch < CUTS ? cut + batch : CUTS;
        for (; cut < end; ++cut) {
            RandomCut(&host, sheet, &seed);
        }
        OK(Host_Tick(&host, 0.01f, 1));
        if (check) {
            CheckSheet(&host, sheet, &first);
        }
    }
    if (check) {
        kiriCounts counts = Host_Counts(&host, sheet);
        print_message("%d triangles, %d pieces, %d frames\n", (int)counts.triangles, (int)counts.pieces,
                      (int)counts.frames);
        assert_true(counts.pieces > 10); /* or the cuts were too tame to show anything */
    }
    return Host_Hash(&host);
}

TEST(RandomCuts)
{
    uint64_t hash = Run(2463534242u, true);
    assert_true(hash == Run(2463534242u, false));
    assert_true(hash != Run(88172645u, true));
}
