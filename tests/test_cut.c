/* Cutting: hand-made cases with their counts, and random cuts that a lip must follow. The world is validated after each
   tick: the mesh conforms, twins agree, no triangle is turned over. */
#include "host.h"

enum { MOST_LINES = 4, MOST_POINTS = 8 };

/* Squares of 1 m, '.' for none, from the top row down. Diagonals in turn: from lower left to upper right where column +
   row is even. */
static kiriResult AddShape(Host* host, kiriSheetDef* def, int32_t columns, int32_t rows, const char* shape,
                           kiriSheet* sheet)
{
    FREED(float, positions) = malloc(2 * sizeof(float) * (size_t)((columns + 1) * (rows + 1)));
    int32_t *indices = malloc(6 * sizeof(int32_t) * (size_t)(columns * rows)), count = 0;
    for (int32_t v = 0; v < (columns + 1) * (rows + 1); ++v) {
        positions[2 * v] = (float)(v % (columns + 1));
        positions[2 * v + 1] = (float)(v / (columns + 1));
    }
    for (int32_t i = 0; i < columns * rows; ++i) {
        static const int order[6] = { 0, 1, 2, 0, 2, 3 };
        int32_t column = i % columns, row = i / columns, a = row * (columns + 1) + column;
        const int32_t corners[4] = { a, a + 1, a + columns + 2, a + columns + 1 };
        for (int k = 0; k < 6 && (shape == NULL || shape[(rows - 1 - row) * columns + column] != '.'); ++k) {
            indices[count++] = corners[(order[k] + (column + row) % 2) % 4];
        }
    }
    def->restPositions = positions;
    def->vertexCount = (columns + 1) * (rows + 1);
    def->indices = indices;
    def->triangleCount = count / 3;
    kiriResult result = kiriCreateSheet(host->world, def, sheet);
    free(indices);
    return result;
}

static kiriSheetDef DefOf(int32_t resolution, double snap)
{
    kiriSheetDef def = SheetOf(resolution, 2);
    def.maxFrames = 512;
    def.snapDistance = (float)snap;
    return def;
}

static void CutLine(Host* host, kiriSheet sheet, const float* points, int32_t count)
{
    Host_Cut(host, sheet, points, count);
    OK(Host_Tick(host, 1e-3f, 1));
}

/* ---- Hand-made cases ---- */

static int32_t VerticesAt(const kiriMesh* mesh, const float at[2])
{
    int32_t count = 0;
    for (int32_t v = 0; v < mesh->vertexCount; ++v) {
        const float* rest = &mesh->restPositions[2 * v];
        count += fabsf(rest[0] - at[0]) + fabsf(rest[1] - at[1]) < 1e-6f;
    }
    return count;
}

/* m^2 of the piece at a place. */
static double AreaAt(const Host* host, kiriSheet sheet, const float at[2])
{
    int32_t piece = World_PieceOf(host->world, World_PointState(host->world, sheet, at).frame);
    return World_PieceState(host->world, sheet, piece).area;
}

typedef struct Line {
    int32_t count;
    float points[2 * MOST_POINTS];
} Line;

/* A case without a shape has 4 x 4 squares. Counts of 0 and areas of 0 are not checked. */
typedef struct Case {
    const char *name, *shape;
    int32_t columns, rows;
    float snap; /* 0: the default */
    Line lines[MOST_LINES];
    int32_t pieces, vertices, triangles;
    float place[2]; /* with atPlace vertices */
    int32_t atPlace;
    struct {
        float at[2], area;
    } areas[2];
} Case;

#define SHEET NULL, 4, 4, 0.0f
#define LINE(ax, ay, bx, by) { 2, { ax, ay, bx, by } }
#define GAP "#.####", 3, 2, 0.0f
#define HOLE "####.####", 3, 3, 0.0f
#define PINCH ".##.", 2, 2, 0.0f

static const Case cases[] = {
    /* 5 lines and 4 diagonals are crossed: 9 places, two vertices each; 7 edges inside, 2 on the outline */
    { "through", SHEET, { LINE(1.3f, -1, 1.3f, 5) }, 2, 25 + 18, 32 + 14 + 2, { 0 }, 0,
      { { { 0.5f, 0.5f }, 5.2f }, { { 2.5f, 0.5f }, 10.8f } } },
    { "both ends in a triangle", SHEET, { LINE(1.25f, 1.125f, 1.75f, 1.125f) }, 1, 27, 36, { 1.25f, 1.125f }, 1, { { { 0 }, 0 } } },
    { "a bend in a triangle", SHEET, { { 3, { 1.25f, 1.125f, 1.75f, 1.125f, 1.75f, 1.25f } } }, 1, 29, 38,
      { 1.75f, 1.125f }, 2, { { { 0 }, 0 } } },
    { "along edges", SHEET, { LINE(1, -1, 1, 5) }, 2, 30, 32, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "along diagonals", SHEET, { LINE(4, 4, 0, 0) }, 2, 30, 32, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "along edges, between vertices", SHEET, { LINE(1, 0.5f, 1, 2.75f) }, 1, 25 + 2 + 2, 32 + 4, { 0 }, 0, { { { 0 }, 0 } } },
    /* new places: 2 on the outline, 3 inside */
    { "through vertices", SHEET, { LINE(0, -1, 3, 5) }, 2, 25 + 10 + 2, 32 + 2 + 6, { 2, 3 }, 2, { { { 0 }, 0 } } },
    { "beside vertices", SHEET, { LINE(1.00005f, -1, 0.99995f, 5) }, 2, 30, 32, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "beside an edge", SHEET, { LINE(1.00005f, 0.5f, 1.00005f, 1.5f) }, 1, 27 + 1, 36, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "too far to snap", NULL, 4, 4, 4e-6f, { LINE(1.00005f, 0.5f, 1.00005f, 1.5f) }, 1, 0, 0, { 1.00005f, 1 }, 2, { { { 0 }, 0 } } },
    { "crossings", SHEET,
      { LINE(1.25f, -1, 1.25f, 5), LINE(-1, 2.125f, 5, 2.125f), LINE(0.75f, 1.375f, 1.75f, 2.875f) }, 4, 0, 0,
      { 1.25f, 2.125f }, 6, { { { 0.1f, 0.1f }, 1.25f * 2.125f }, { { 3.9f, 3.9f }, 2.75f * 1.875f } } },
    { "along an older cut", SHEET, { LINE(1, -1, 1, 5), LINE(1, -1, 1, 5), LINE(1, 5, 1, -1) }, 2, 30, 32, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "across itself", SHEET, { { 4, { 0.5f, 0.5f, 3.5f, 0.625f, 2, 3, 1.75f, -1 } } }, 2, 0, 0, { 2, 3 }, 2, { { { 0 }, 0 } } },
    { "an open loop", SHEET, { { 4, { 1.2f, 1.2f, 2.8f, 1.2f, 2.8f, 2.8f, 1.2f, 2.8f } } }, 1, 0, 0, { 0 }, 0, { { { 0 }, 0 } } },
    { "a loop", SHEET, { { 5, { 1.2f, 1.2f, 2.8f, 1.2f, 2.8f, 2.8f, 1.2f, 2.8f, 1.2f, 1.2f } } }, 2, 0, 0, { 1.2f, 1.2f }, 2,
      { { { 2, 2 }, 2.56f } } },
    { "around a corner", SHEET, { { 3, { 0.5f, -0.5f, 0.5f, 0.5f, -0.5f, 0.5f } } }, 2, 0, 0, { 0 }, 0, { { { 0.1f, 0.1f }, 0.25f } } },
    { "out and in again", SHEET, { { 6, { 0.5f, -0.5f, 0.5f, 0.75f, -0.5f, 0.75f, -0.5f, 3.3f, 1.5f, 3.3f, 1.5f, 5 } } }, 3, 0, 0,
      { 0 }, 0, { { { 0.1f, 0.1f }, 0.375f }, { { 0.1f, 3.9f }, 1.05f } } },
    { "along the outline", SHEET, { LINE(-1, 0, 5, 0), LINE(4, 4, 4, 1), LINE(-1, 1, 1, -1), LINE(-1, 9, 5, 9) }, 1, 25, 32, { 0 }, 0,
      { { { 0 }, 0 } } },
    { "from outline to outline", SHEET, { LINE(0, 1.5f, 1.5f, 0) }, 2, 0, 0, { 0 }, 0, { { { 0.1f, 0.1f }, 1.125f } } },
    { "from vertex to vertex", SHEET, { LINE(0, 3, 3, 4) }, 2, 0, 0, { 0 }, 0, { { { 0.1f, 3.9f }, 1.5f } } },
    { "from end to end of the range", SHEET, { LINE(-9e9f, -9e9f, 9e9f, 9e9f) }, 2, 30, 32, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "over a gap", GAP, { LINE(-1, 1.4f, 4, 1.4f) }, 3, 0, 0, { 0 }, 0, { { { 0.5f, 1.9f }, 0.6f }, { { 2.5f, 1.9f }, 0.6f } } },
    { "over a gap, from inside to inside", GAP, { LINE(0.5f, 1.4f, 2.5f, 1.4f) }, 1, 0, 0, { 0 }, 0, { { { 0 }, 0 } } },
    { "along the bottom of a gap", GAP, { LINE(0, 1, 3, 1) }, 3, 0, 10, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "and back", GAP, { LINE(3, 1, 0, 1) }, 3, 0, 10, { 1, 1 }, 2, { { { 0 }, 0 } } },
    { "to a hole", HOLE, { LINE(-1, 1.5f, 1.5f, 1.5f) }, 1, 0, 0, { 0 }, 0, { { { 0 }, 0 } } },
    { "to a hole and on", HOLE, { LINE(-1, 1.5f, 1.5f, 1.5f), LINE(1.5f, 1.4f, 4, 1.25f) }, 2, 0, 0, { 0 }, 0, { { { 0 }, 0 } } },
    { "across a hole", HOLE, { LINE(-1, -1, 4, 4) }, 2, 0, 0, { 0 }, 0, { { { 2, 0.5f }, 4 } } },
    { "through a pinch", PINCH, { LINE(-1, -1, 3, 3) }, 4, 0, 0, { 1, 1 }, 4, { { { 0 }, 0 } } },
    { "through a pinch, slanted", PINCH, { LINE(0, -1, 2, 3) }, 4, 0, 0, { 0 }, 0,
      { { { 0.1f, 0.5f }, 0.75f }, { { 1.9f, 1.5f }, 0.75f } } },
    { "from a pinch", PINCH, { LINE(1, 1, 0.4f, -1), LINE(1, 1, 1.6f, 3) }, 4, 0, 0, { 0 }, 0, { { { 0 }, 0 } } },
};

static void CheckCase(const Case* c, bool isParted)
{
    kiriSheet sheet;
    kiriSheetDef def = DefOf(8, c->snap);
    START_HOST(host);
    OK(AddShape(&host, &def, c->columns, c->rows, c->shape, &sheet));
    double area = Host_Totals(&host, sheet).area;
    for (int i = 0; i < MOST_LINES && c->lines[i].count > 0; ++i) {
        const Line* line = &c->lines[i];
        kiriCut cut = World_BeginCut(host.world, sheet, line->points);
        for (int k = 1; k < line->count; ++k) { /* the blade goes on where it was, also over several ticks */
            OK(kiriCut_Extend(host.world, cut, &line->points[2 * k], 1));
            OK(isParted ? Host_Tick(&host, 1e-3f, 1) : KIRI_OK);
        }
        OK(kiriCut_End(host.world, cut));
        OK(Host_Tick(&host, 1e-3f, 1));
    }
    kiriCounts counts = Host_Counts(&host, sheet);
    kiriMesh mesh = Host_Mesh(&host, sheet);
    bool isRight = counts.pieces == c->pieces && (c->vertices == 0 || counts.vertices == c->vertices) &&
                   (c->triangles == 0 || counts.triangles == c->triangles) &&
                   (c->atPlace == 0 || VerticesAt(&mesh, c->place) == c->atPlace) &&
                   fabs(Host_Totals(&host, sheet).area - area) < 1e-12 * area;
    for (int i = 0; i < 2; ++i) {
        float due = c->areas[i].area;
        isRight = isRight && (due == 0.0f || fabs(AreaAt(&host, sheet, c->areas[i].at) - (double)due) < 1e-5);
    }
    if (!isRight) {
        fail_msg("%s: %d pieces, %d vertices, %d triangles, %d of them at the place", c->name, (int)counts.pieces,
                 (int)counts.vertices, (int)counts.triangles, (int)VerticesAt(&mesh, c->place));
    }
}

TEST(HandMadeCases)
{
    for (size_t k = 0; k < sizeof(cases) / sizeof(cases[0]); ++k) {
        CheckCase(&cases[k], false);
        CheckCase(&cases[k], true);
    }
}

/* ---- Odd meshes ---- */

static kiriResult AddLoose(Host* host, const float* corners, int32_t triangles, double snap, kiriSheet* sheet)
{
    static const int32_t indices[12] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
    kiriSheetDef def = DefOf(8, snap);
    def.restPositions = corners;
    def.vertexCount = 3 * triangles;
    def.indices = indices;
    def.triangleCount = triangles;
    return kiriCreateSheet(host->world, &def, sheet);
}

/* The blade only touches the sharp corner; it must not be led along a side. */
TEST(TouchesSharpCorners)
{
    static const float triangles[2][6] = { { 0, 0, 4, -1, 4, 0 }, { 0, 0, 4, 0, 4, 1 } };
    for (int up = 0; up < 2; ++up) {
        float side = up ? 1.0f : -1.0f, line[4] = { -1.5f, -side, 3.0f, 2.0f * side };
        kiriSheet sheet;
        START_HOST(host);
        OK(AddLoose(&host, triangles[up], 1, 0.0, &sheet));
        CutLine(&host, sheet, line, 2);
        assert_int_equal(Host_Counts(&host, sheet).triangles, 1);
    }
}

/* A corner in the middle of another part's side: the blade goes on from part to part. */
TEST(CutsThroughSplitSides)
{
    static const float positions[] = { 0, 0, 1, 0, 1, 2, 0, 2, 1, 0, 2, 0, 2, 1, 1, 1, 2, 2, 1, 2 };
    static const int32_t indices[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 7, 6, 8, 7, 8, 9 };
    for (int way = 0; way < 2; ++way) {
        float line[4] = { way ? 3.0f : -1.0f, 1, way ? -1.0f : 3.0f, 1 };
        kiriSheetDef def = DefOf(8, 0.0);
        START_HOST(host);
        def.restPositions = positions;
        def.vertexCount = 10;
        def.indices = indices;
        def.triangleCount = 6;
        kiriSheet sheet = World_AddSheet(host.world, &def);
        assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
        CutLine(&host, sheet, line, 2);
        kiriMesh mesh = Host_Mesh(&host, sheet);
        assert_int_equal(VerticesAt(&mesh, (float[]){ 1, 1 }), 4);
        assert_int_equal(Host_Counts(&host, sheet).pieces, 4);
    }
}

/* Two squares of few lattice steps, each of two triangles, and one that goes far up. Three corners are moved by up to
   four eighths of a square, so triangles lie on each other by as much as floats are given for rounding. Blades that go
   along their edges make none twice. */
TEST(MakesNoEdgeTwice)
{
    static const float eighths[] = { 0, 0, 8, 0, 8, 8, 0, 0, 8, 8, 0, 8, 8, 0, 16, 0, 8, 8, 16, 0, 16, 8, 8, 8 };
    uint32_t seed = 77;
    int32_t made = 0;
    for (int round = 0; round < 600; ++round) {
        float corners[24];
        int32_t unit = 2 << Random(&seed) % 8;
        kiriSheet sheet;
        START_HOST(host);
        for (int i = 0; i < 24; ++i) {
            corners[i] = (float)unit * eighths[i];
        }
        for (int i = 0; i < 3; ++i) {
            float far = (float)(unit < 16 || Random(&seed) % 2 == 0 ? unit : 16);
            corners[Random(&seed) % 24] += far * ((float)(Random(&seed) % 5) - 2.0f);
        }
        corners[15] = 536870912.0f; /* lattice steps are 1 */
        if (AddLoose(&host, corners, 4, 0.0, &sheet) == KIRI_OK) {
            for (int i = 0; i < 6; ++i) {
                float xy[8];
                for (int k = 0; k < 8; ++k) {
                    xy[k] = (float)unit * ((float)(Random(&seed) % 21) - 2.0f) + 2.0f * (float)(Random(&seed) % 2);
                }
                Host_Cut(&host, sheet, xy, 4);
                kiriResult result = Host_Tick(&host, 1e-3f, 1);
                assert_true(result == KIRI_OK || result == KIRI_DIVERGED); /* sheets 5e8 m long, and some steps wide */
            }
            ++made;
        }
    }
    assert_in_range(made, 50, 600);
}

/* Blades at a slanted side, with a snap distance of one lattice step, do not pull the side along: the validator finds
   vertices that are not in their source triangles. */
TEST(PullsNoOutlineAlong)
{
    static const float corners[24] = { 0,    0, 2048, 0,          2048, 2048, 0,    0, 2048, 2048, 0,    1792,
                                       2048, 0, 4096, 536870912,  2048, 2048, 4096, 0, 4096, 2048, 2048, 2048 };
    static const float lines[6][8] = {
        { -256, 4610, 4096, 1794, 3328, 2818, 0, -512 },   { 768, 2818, 1026, 4610, 4608, 3584, 2304, 2050 },
        { 256, 2, 3842, 1536, -510, 512, 4608, 514 },      { 768, 3586, 4354, 2816, 0, 2048, 3584, 768 },
        { 3586, 1792, 1536, 1536, 2050, 2818, 3842, 2048 }, { 2304, 3072, 3330, -510, 3074, 2818, 1024, 3840 }
    };
    kiriSheet sheet;
    START_HOST(host);
    OK(AddLoose(&host, corners, 4, 1.0, &sheet));
    for (int i = 0; i < 6; ++i) {
        Host_Cut(&host, sheet, lines[i], 4);
        kiriResult result = Host_Tick(&host, 1e-3f, 1);
        assert_true(result == KIRI_OK || result == KIRI_DIVERGED);
    }
}

/* ---- Random cuts ---- */

typedef struct Edge {
    int32_t low, high;
} Edge;

static int CompareEdges(const void* a, const void* b)
{
    const Edge *x = a, *y = b;
    return x->low != y->low ? (x->low > y->low) - (x->low < y->low) : (x->high > y->high) - (x->high < y->high);
}

/* The edges that one triangle has: lips and outline. They come first. */
static int32_t FindLips(const kiriMesh* mesh, Edge* edges)
{
    int32_t count = 3 * mesh->triangleCount, lips = 0;
    for (int32_t h = 0; h < count; ++h) {
        int32_t a = mesh->indices[h], b = mesh->indices[h % 3 == 2 ? h - 2 : h + 1];
        edges[h] = a < b ? (Edge){ a, b } : (Edge){ b, a };
    }
    qsort(edges, (size_t)count, sizeof(Edge), CompareEdges);
    for (int32_t i = 0; i < count; ++i) {
        if (i + 1 < count && CompareEdges(&edges[i], &edges[i + 1]) == 0) {
            ++i;
        } else {
            edges[lips++] = edges[i];
        }
    }
    return lips;
}

static double DistanceToLips(const kiriMesh* mesh, const Edge* lips, int32_t count, double u, double v)
{
    double least = 1e30;
    for (int32_t i = 0; i < count; ++i) {
        const float *a = &mesh->restPositions[2 * lips[i].low], *b = &mesh->restPositions[2 * lips[i].high];
        double x = (double)b[0] - a[0], y = (double)b[1] - a[1], s = ((u - a[0]) * x + (v - a[1]) * y) / (x * x + y * y);
        s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
        least = fmin(least, hypot(u - a[0] - s * x, v - a[1] - s * y));
    }
    return least;
}

/* Every place of the polyline that is in the sheet is on a lip, or beside the lips that the blade has joined instead. */
static void CheckFollowed(const Host* host, kiriSheet sheet, const float* points, int32_t count, double size, double snap)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    FREED(Edge, edges) = malloc(3 * sizeof(Edge) * (size_t)mesh.triangleCount);
    int32_t lips = FindLips(&mesh, edges);
    for (int32_t i = 0; i < 16 * (count - 1); ++i) {
        const float *a = &points[2 * (i / 16)], *b = a + 2;
        double s = (i % 16) / 16.0, u = a[0] + s * ((double)b[0] - a[0]), v = a[1] + s * ((double)b[1] - a[1]);
        if (u > 0.0 && v > 0.0 && u < size && v < size) {
            assert_true(DistanceToLips(&mesh, edges, lips, u, v) <= 5.0 * snap + 1e-6 * size);
        }
    }
}

/* A lip, or an edge of the outline. */
typedef struct Lip {
    float at[4];
    bool hasPartner;
} Lip;

static int CompareLips(const void* a, const void* b)
{
    return memcmp(a, b, sizeof(float[4]));
}

/* Lips share points: each has a partner at the same place. Edges of the outline have none. */
static void CheckLipsMeet(const Host* host, kiriSheet sheet, float size)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    FREED(Edge, edges) = malloc(3 * sizeof(Edge) * (size_t)mesh.triangleCount);
    int32_t count = FindLips(&mesh, edges);
    Lip* lips = calloc((size_t)count, sizeof(Lip));
    for (int32_t i = 0; i < count; ++i) {
        const float *a = &mesh.restPositions[2 * edges[i].low], *b = &mesh.restPositions[2 * edges[i].high];
        bool isFirst = a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
        memcpy(lips[i].at, isFirst ? a : b, sizeof(float[2]));
        memcpy(lips[i].at + 2, isFirst ? b : a, sizeof(float[2]));
    }
    qsort(lips, (size_t)count, sizeof(Lip), CompareLips);
    for (int32_t i = 1; i < count; ++i) {
        bool isSame = CompareLips(&lips[i - 1], &lips[i]) == 0;
        assert_false(isSame && lips[i - 1].hasPartner);
        lips[i - 1].hasPartner |= isSame;
        lips[i].hasPartner = isSame;
    }
    for (int32_t i = 0; i < count; ++i) {
        const float* p = lips[i].at;
        bool isOutline = (p[0] == p[2] && (p[0] == 0.0f || p[0] == size)) || (p[1] == p[3] && (p[1] == 0.0f || p[1] == size));
        assert_true(isOutline != lips[i].hasPartner);
    }
    free(lips);
}

/* A coordinate near the last one; at times on a line of the mesh. */
static float Near(uint32_t* seed, float last, double reach)
{
    double x = last + RandomBetween(seed, -reach, reach);
    x = Random(seed) % 5 == 0 ? floor(x + 0.5) : x;
    return (float)(x < -3.0 ? -3.0 : x > 19.0 ? 19.0 : x);
}

TEST(LipsFollowTheBlade)
{
    static const double snaps[] = { 1.6e-5, 1.6e-3, 0.16 };
    for (uint32_t round = 0; round < 12; ++round) {
        uint32_t seed = 2015 + round;
        double snap = snaps[round % 3], reach = round % 2 == 0 ? 9.0 : 1.5;
        float again[2] = { 8, 8 };
        kiriSheetDef def = DefOf(4 + 3 * (int32_t)round, snap);
        kiriSheet sheet;
        START_HOST(host);
        OK(AddShape(&host, &def, 16, 16, NULL, &sheet));
        for (int i = 0; i < 16; ++i) {
            float points[2 * MOST_POINTS];
            int32_t count = 2 + (int32_t)(Random(&seed) % (MOST_POINTS - 1));
            points[0] = Near(&seed, 8.0f, 11.0);
            points[1] = Near(&seed, 8.0f, 11.0);
            for (int32_t k = 2; k < 2 * count; ++k) {
                points[k] = Near(&seed, points[k - 2], reach);
            }
            if (Random(&seed) % 3 == 0) { /* an earlier place, or a closed cut */
                memcpy(&points[2 * count - 2], count > 2 && i % 2 == 0 ? points : again, sizeof(again));
            }
            memcpy(again, &points[2], sizeof(again));
            CutLine(&host, sheet, points, count);
            CheckFollowed(&host, sheet, points, count, 16.0, snap);
            CheckLipsMeet(&host, sheet, 16.0f);
        }
        assert_true(fabs(Host_Totals(&host, sheet).area - 256.0) < 1e-9);
    }
}

/* A row of vertices at a small angle must not lead the blade away. */
TEST(DoesNotDrift)
{
    static const float line[4] = { 0.0f, 1.0f, 256.0f, 1.6f };
    kiriSheet sheet;
    kiriSheetDef def = DefOf(64, 0.01);
    START_HOST(host);
    OK(AddShape(&host, &def, 256, 2, NULL, &sheet));
    CutLine(&host, sheet, line, 2);
    kiriMesh mesh = Host_Mesh(&host, sheet);
    FREED(Edge, edges) = malloc(3 * sizeof(Edge) * (size_t)mesh.triangleCount);
    int32_t lips = FindLips(&mesh, edges), inside = 0;
    for (int32_t i = 0; i < lips; ++i) {
        const float* p = &mesh.restPositions[2 * edges[i].low];
        bool isInside = p[0] > 0.0f && p[0] < 256.0f && p[1] > 0.0f && p[1] < 2.0f;
        assert_true(!isInside || fabs((double)p[1] - (1.0 + p[0] * 0.6 / 256.0)) < 0.02001);
        inside += isInside;
    }
    assert_true(inside > 500);
}

/* Writes a spiral, or a line that strays, within `radius` of a place. */
static void DrawKnot(uint32_t* seed, bool isSpiral, int32_t count, float* points)
{
    double x = RandomBetween(seed, 0.3, 0.7), y = RandomBetween(seed, 0.3, 0.7), radius = RandomBetween(seed, 0.02, 0.06);
    double turn = 6.283185307179586 / RandomBetween(seed, 50.0, 400.0), u = 0.0, v = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        double share = 1.0 - (double)i / count;
        u = isSpiral ? radius * share * cos(turn * i) : u + 0.1 * radius * RandomBetween(seed, -1.0, 1.0);
        v = isSpiral ? radius * share * sin(turn * i) : v + 0.1 * radius * RandomBetween(seed, -1.0, 1.0);
        double length = sqrt(u * u + v * v) / radius;
        u = length > 1.0 ? u / length : u;
        v = length > 1.0 ? v / length : v;
        points[2 * i] = (float)(x + u);
        points[2 * i + 1] = (float)(y + v);
    }
}

/* Lines beside each other do not make more vertices each time: the cost of a knot is proportional to its points. */
TEST(KnotsEnd)
{
    enum { MOST = 4000, ITEMS = 10000 };
    static float points[2 * MOST];
    const kiriBudget budget = { ITEMS, 0, 0, 0 };
    uint32_t seed = 4711;
    for (int32_t i = 0; i < 8; ++i) {
        bool isSpiral = i < 6;
        int32_t count = isSpiral ? MOST >> i % 3 : MOST >> 2, most = (isSpiral ? 60 : 200) * count, items = 0;
        kiriSheetDef def = DefOf(64, 0.0);
        START_HOST(host);
        host.every = 1000;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 32, 32);
        OK(kiriWorld_SetBudget(host.world, &budget));
        DrawKnot(&seed, isSpiral, count, points);
        Host_Cut(&host, sheet, points, count);
        while (Host_Tick(&host, 1e-3f, 1) == KIRI_PENDING && items <= most) {
            items += World_Profile(host.world).trianglesSplit;
        }
        assert_true(items <= most);
        assert_true(Host_Counts(&host, sheet).vertices <= 2000 + (isSpiral ? 6 : 20) * count);
    }
}

/* Cuts from one point at small angles, straight or bent, close no loop: they cut nothing off. */
TEST(StarsStayWhole)
{
    uint32_t seed = 271828;
    for (int32_t i = 0; i < 40; ++i) {
        const double x = RandomBetween(&seed, 0.4, 0.6), y = RandomBetween(&seed, 0.4, 0.6), bend = i % 3 * 0.1;
        const double angle = RandomBetween(&seed, 0.01, 0.2), first = RandomBetween(&seed, 0.0, 6.0);
        kiriSheetDef def = DefOf(16 << i % 3, i % 5 == 0 ? 1e-3 : 0.0);
        START_HOST(host);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
        for (int32_t n = 0; n < 20; ++n) {
            float points[8] = { (float)x, (float)y };
            for (int k = 1; k < 4; ++k) {
                points[2 * k] = (float)(x + 0.12 * k * cos(first + n * angle + bend * k));
                points[2 * k + 1] = (float)(y + 0.12 * k * sin(first + n * angle + bend * k));
            }
            Host_Cut(&host, sheet, points, 4);
            if (i % 2 == 0) {
                OK(Host_Tick(&host, 1e-3f, 1));
            }
        }
        OK(Host_Tick(&host, 1e-3f, 1));
        assert_int_equal(Host_Counts(&host, sheet).pieces, 1);
    }
}
