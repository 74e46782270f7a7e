/* Meshes as other tools write them: seams of texture coordinates, triangles without shared vertices, unused vertices.
   And the lines about meshes that are refused. */
#include "defaults.h"
#include "look.h"

#include <stdio.h>

enum { MOST_TRIANGLES = 4096, MOST_VERTICES = 3 * MOST_TRIANGLES };

/* A caller's mesh. */
typedef struct Import {
    float rest[2 * MOST_VERTICES], uv[2 * MOST_VERTICES];
    int32_t indices[3 * MOST_TRIANGLES];
    int32_t island[MOST_TRIANGLES]; /* of each triangle, see UvAt */
    int32_t vertices, triangles;
} Import;

static Import A, B;

static kiriSheetDef DefOf(const Import* mesh, float weldDistance)
{
    kiriSheetDef def = DefaultSheet();
    def.restPositions = mesh->rest;
    def.vertexCount = mesh->vertices;
    def.indices = mesh->indices;
    def.triangleCount = mesh->triangles;
    def.gridResolution = 16;
    def.frameCount = 4;
    def.weldDistance = weldDistance;
    return def;
}

static kiriSheet Add(Host* host, const Import* mesh, float weldDistance)
{
    kiriSheetDef def = DefOf(mesh, weldDistance);
    kiriSheet sheet = 0;
    kiriResult result = kiriCreateSheet(host->world, &def, &sheet);
    if (result != KIRI_OK) {
        fail_msg("%s", host->line);
    }
    Host_Validate(host);
    return sheet;
}

/* Texture coordinates in an island: each island is turned, scaled and moved. */
static void UvAt(int32_t island, double u, double v, double uv[2])
{
    double turn = 0.7 * island, scale = 0.3 + 0.2 * island;
    uv[0] = 3.0 * island + scale * (cos(turn) * u - sin(turn) * v);
    uv[1] = -2.0 * island + scale * (sin(turn) * u + cos(turn) * v);
}

static int32_t AddVertex(Import* mesh, double u, double v, int32_t island)
{
    double uv[2];
    int32_t index = mesh->vertices++;
    assert_true(mesh->vertices <= MOST_VERTICES);
    UvAt(island, u, v, uv);
    mesh->rest[2 * index] = (float)u;
    mesh->rest[2 * index + 1] = (float)v;
    mesh->uv[2 * index] = (float)uv[0];
    mesh->uv[2 * index + 1] = (float)uv[1];
    return index;
}

static void AddTriangle(Import* mesh, int32_t a, int32_t b, int32_t c, int32_t island)
{
    assert_true(mesh->triangles < MOST_TRIANGLES);
    mesh->indices[3 * mesh->triangles] = a;
    mesh->indices[3 * mesh->triangles + 1] = b;
    mesh->indices[3 * mesh->triangles + 2] = c;
    mesh->island[mesh->triangles++] = island;
}

/* Adds a block of squares; it shares no vertices with others. */
static void AddBlock(Import* mesh, double u, double v, double square, int32_t columns, int32_t rows, int32_t island)
{
    int32_t first = mesh->vertices;
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= columns; ++i) {
            AddVertex(mesh, u + square * i, v + square * j, island);
        }
    }
    for (int32_t j = 0; j < rows; ++j) {
        for (int32_t i = 0; i < columns; ++i) {
            int32_t a = first + j * (columns + 1) + i, d = a + columns + 1;
            AddTriangle(mesh, a, a + 1, d + 1, island);
            AddTriangle(mesh, a, d + 1, d, island);
        }
    }
}

static void Shake(Import* mesh, double by, uint32_t* seed)
{
    for (int32_t i = 0; i < 2 * mesh->vertices; ++i) {
        mesh->rest[i] += (float)RandomBetween(seed, -by, by);
    }
}

/* No two triangles share a vertex. */
static void MakeSoup(const Import* mesh, Import* soup)
{
    soup->vertices = soup->triangles = 0;
    for (int32_t t = 0; t < mesh->triangles; ++t) {
        for (int k = 0; k < 3; ++k) {
            const float* at = &mesh->rest[2 * mesh->indices[3 * t + k]];
            AddVertex(soup, at[0], at[1], mesh->island[t]);
        }
        AddTriangle(soup, 3 * t, 3 * t + 1, 3 * t + 2, mesh->island[t]);
    }
}

/* Vertices in the order in which triangles have them first: that in which a soup is welded. */
static void SortByUse(Import* mesh)
{
    static Import sorted;
    static int32_t to[MOST_VERTICES];
    sorted.vertices = sorted.triangles = 0;
    for (int32_t v = 0; v < mesh->vertices; ++v) {
        to[v] = -1;
    }
    for (int32_t i = 0; i < 3 * mesh->triangles; ++i) {
        int32_t v = mesh->indices[i];
        to[v] = to[v] >= 0 ? to[v] : AddVertex(&sorted, mesh->rest[2 * v], mesh->rest[2 * v + 1], 0);
    }
    for (int32_t t = 0; t < mesh->triangles; ++t) {
        const int32_t* c = &mesh->indices[3 * t];
        AddTriangle(&sorted, to[c[0]], to[c[1]], to[c[2]], mesh->island[t]);
    }
    *mesh = sorted;
}

/* ---- Checks ---- */

/* At each corner of each triangle the host draws the texture coordinates of the island of the triangle. */
static void CheckUvs(const Host* host, kiriSheet sheet, const Import* mesh, double tolerance)
{
    static int32_t sources[4 * MOST_TRIANGLES];
    static float weights[36 * MOST_TRIANGLES];
    kiriMesh now = Host_Mesh(host, sheet);
    assert_true(now.triangleCount <= 4 * MOST_TRIANGLES);
    OK(kiriSheet_CopySources(host->world, sheet, 0, now.triangleCount, sources));
    OK(kiriSheet_CopySourceWeights(host->world, sheet, 0, now.triangleCount, weights));
    for (int32_t i = 0; i < 3 * now.triangleCount; ++i) {
        int32_t source = sources[i / 3], vertex = now.indices[i];
        double is[2] = { 0.0, 0.0 }, wanted[2];
        if (source < 0) { /* it has left */
            assert_int_equal(now.indices[i - i % 3], vertex);
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const float* uv = &mesh->uv[2 * mesh->indices[3 * source + k]];
            assert_true(weights[3 * i + k] >= 0.0f);
            is[0] += (double)weights[3 * i + k] * uv[0];
            is[1] += (double)weights[3 * i + k] * uv[1];
        }
        UvAt(mesh->island[source], now.restPositions[2 * vertex], now.restPositions[2 * vertex + 1], wanted);
        if (!(fabs(is[0] - wanted[0]) <= tolerance && fabs(is[1] - wanted[1]) <= tolerance)) {
            fail_msg("corner %d, in triangle %d: %g %g and not %g %g", i, source, is[0], is[1], wanted[0], wanted[1]);
        }
    }
}

static void CheckCounts(const Host* host, kiriSheet sheet, int32_t vertices, int32_t triangles)
{
    kiriCounts counts = Host_Counts(host, sheet);
    assert_int_equal(counts.pieces, 1);
    assert_int_equal(counts.vertices, vertices);
    assert_int_equal(counts.triangles, triangles);
}

/* Cuts along the seam, across it, and a disc out of both sides. */
static void CutAndCheckUvs(Host* host, kiriSheet sheet, const Import* mesh, double tolerance)
{
    static const float along[] = { 0.5f, 0.1f, 0.5f, 0.35f }, across[] = { 0.2f, 0.41f, 0.83f, 0.47f };
    static const float disc[] = { 0.4f, 0.6f, 0.6f, 0.58f, 0.63f, 0.8f, 0.42f, 0.83f, 0.4f, 0.6f };
    Host_Cut(host, sheet, along, 2);
    Host_Cut(host, sheet, across, 2);
    Host_Cut(host, sheet, disc, 5);
    for (int i = 0; i < 3; ++i) {
        OK(Host_Tick(host, 0.01f, 1));
        CheckUvs(host, sheet, mesh, tolerance);
    }
    assert_int_equal(Host_Counts(host, sheet).pieces, 2);
    kiriSheet part = World_Detach(host->world, Host_FrameOf(host, sheet, 1));
    CheckUvs(host, sheet, mesh, tolerance);
    CheckUvs(host, part, mesh, tolerance);
}

/* Two islands of texture coordinates side by side, as tools unwrap them: the vertices between are there twice. */
TEST(ClosesSeams)
{
    for (int i = 0; i < 2; ++i) {
        uint32_t seed = 5;
        double shake = i == 0 ? 0.0 : 1e-4;
        START_HOST(host);
        memset(&A, 0, sizeof(A));
        AddBlock(&A, 0.0, 0.0, 1.0 / 12, 6, 12, 0);
        AddBlock(&A, 0.5, 0.0, 1.0 / 12, 6, 12, 1);
        Shake(&A, shake, &seed);
        if (i == 0) { /* else they overlap */
            assert_int_equal(Host_Counts(&host, Add(&host, &A, 0.0f)).pieces, 2);
        }
        kiriSheet sheet = Add(&host, &A, 3e-4f);
        CheckCounts(&host, sheet, 13 * 13, 288);
        CheckUvs(&host, sheet, &A, 2e-6 + 2.0 * shake);
        CutAndCheckUvs(&host, sheet, &A, 2e-6 + 2.0 * shake);
    }
}

/* A side of a tube, unwrapped around an axis: a ring whose ends meet, of triangles of an island each. */
TEST(ClosesRings)
{
    enum { SECTORS = 24, RINGS = 4 };
    START_HOST(host);
    memset(&A, 0, sizeof(A));
    for (int j = 0; j <= RINGS; ++j) {
        for (int i = 0; i <= SECTORS; ++i) { /* the last column lies where the first does */
            double turn = 2.0 * 3.14159265358979 * i / SECTORS, radius = 0.2 + 0.075 * j;
            AddVertex(&A, 0.5 + radius * cos(turn), 0.5 + radius * sin(turn), 0);
        }
    }
    for (int j = 0; j < RINGS; ++j) {
        for (int i = 0; i < SECTORS; ++i) {
            int32_t a = j * (SECTORS + 1) + i, d = a + SECTORS + 1;
            AddTriangle(&A, a, d, d + 1, i % 5);
            AddTriangle(&A, a, d + 1, a + 1, i % 5);
        }
    }
    MakeSoup(&A, &B);
    kiriSheet sheet = Add(&host, &B, 1e-5f);
    CheckCounts(&host, sheet, SECTORS * (RINGS + 1), 2 * SECTORS * RINGS);
    CheckUvs(&host, sheet, &B, 3e-6);
    static const float slit[] = { 0.5f, 0.5f, 1.1f, 0.53f };
    Host_Cut(&host, sheet, slit, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    CheckUvs(&host, sheet, &B, 3e-6);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 1);
}

/* ---- Any mesh ---- */

static void MixTriangles(Import* mesh, uint32_t* seed)
{
    for (int32_t t = mesh->triangles - 1; t > 0; --t) {
        int32_t other = (int32_t)(Random(seed) % (uint32_t)(t + 1));
        for (int k = 0; k < 3; ++k) {
            int32_t index = mesh->indices[3 * t + k];
            mesh->indices[3 * t + k] = mesh->indices[3 * other + k];
            mesh->indices[3 * other + k] = index;
        }
    }
}

/* Squares that lie a little beside where they would be, without some of their triangles: so with holes, parts, and
   corners that touch. */
static void MakeAny(Import* mesh, uint32_t* seed)
{
    int32_t columns = 1 + (int32_t)(Random(seed) % 12), rows = 1 + (int32_t)(Random(seed) % 12);
    double keep = RandomBetween(seed, 0.5, 1.2);
    memset(mesh, 0, sizeof(*mesh));
    AddBlock(mesh, RandomBetween(seed, -3.0, 3.0), RandomBetween(seed, -3.0, 3.0), 0.1, columns, rows, 0);
    Shake(mesh, 0.02, seed);
    int32_t kept = 0;
    for (int32_t t = 0; t < mesh->triangles; ++t) {
        if (RandomBetween(seed, 0.0, 1.0) < keep || (t + 1 == mesh->triangles && kept == 0)) {
            memmove(&mesh->indices[3 * kept++], &mesh->indices[3 * t], 3 * sizeof(int32_t));
        }
    }
    mesh->triangles = kept;
    MixTriangles(mesh, seed);
    SortByUse(mesh);
}

static uint64_t LookAt(Host* host, kiriSheet sheet)
{
    return Look_Sheet(14695981039346656037u, host->world, sheet);
}

/* Both worlds got the same: so they are the same to the last bit. */
static void CheckSame(Host* a, Host* b)
{
    assert_true(LookAt(a, Host_SheetAt(a, 0)) == LookAt(b, Host_SheetAt(b, 0)));
    assert_true(Host_Hash(a) == Host_Hash(b));
}

static void CutBoth(Host* a, Host* b, uint32_t* seed)
{
    for (int i = 0; i < 3; ++i) {
        float line[6];
        for (int k = 0; k < 6; ++k) {
            const float* at = &A.rest[2 * (Random(seed) % (uint32_t)A.vertices)];
            line[k] = at[k % 2] + (float)RandomBetween(seed, -0.2, 0.2);
        }
        Host_Cut(a, Host_SheetAt(a, 0), line, 3);
        Host_Cut(b, Host_SheetAt(b, 0), line, 3);
        assert_int_equal(Host_Tick(a, 0.01f, 1), Host_Tick(b, 0.01f, 1));
        CheckSame(a, b);
    }
}

/* A soup and the mesh with shared vertices give the same sheet, bit for bit, also after cuts. */
TEST(WeldsSoupsOfAnyMesh)
{
    uint32_t seed = 41;
    for (int i = 0; i < 60; ++i) {
        HOST_PAIR(hosts);
        MakeAny(&A, &seed);
        MakeSoup(&A, &B);
        Host_Start(&hosts[0]);
        Host_Start(&hosts[1]);
        Add(&hosts[0], &A, 0.0f);
        Add(&hosts[1], &B, (float)RandomBetween(&seed, 1e-6, 1e-2));
        CheckSame(&hosts[0], &hosts[1]);
        CutBoth(&hosts[0], &hosts[1], &seed);
    }
}

/* The same where the copies of a vertex lie beside each other. */
TEST(WeldsShakenSoups)
{
    uint32_t seed = 42;
    for (int i = 0; i < 60; ++i) {
        float weld = (float)RandomBetween(&seed, 1e-5, 1e-2);
        MakeAny(&A, &seed);
        MakeSoup(&A, &B);
        Shake(&B, 0.3 * weld, &seed);
        START_HOST(host);
        kiriCounts counts = Host_Counts(&host, Add(&host, &A, 0.0f)), welded = Host_Counts(&host, Add(&host, &B, weld));
        assert_int_equal(counts.vertices, welded.vertices);
        assert_int_equal(counts.triangles, welded.triangles);
        assert_int_equal(counts.pieces, welded.pieces);
    }
}

/* The world is saved, and loaded. */
static void GoOnElsewhere(Host* host)
{
    static uint8_t save[1 << 20];
    int64_t size;
    OK(kiriWorld_Save(host->world, save, sizeof(save), &size));
    uint64_t hash = Host_Hash(host);
    OK(kiriWorld_Load(host->world, save, size));
    assert_true(Host_Hash(host) == hash);
}

/* Squares in a row, with gaps: those narrower than the distance close. */
TEST(WeldsWhatIsNear)
{
    static const struct {
        float gaps[2];
        int32_t pieces;
    } rows[] = { { { 0.0099f, 0.5f }, 2 }, { { 0.0101f, 0.5f }, 3 }, { { 0.0099f, 0.0099f }, 1 }, { { 0.002f, 0.0101f }, 2 } };
    for (size_t k = 0; k < sizeof(rows) / sizeof(rows[0]); ++k) {
        float u = 0.0f;
        START_HOST(host);
        memset(&A, 0, sizeof(A));
        for (int i = 0; i < 3; ++i) {
            const float square[8] = { u, 0, u + 1, 0, u + 1, 1, u, 1 };
            const int32_t first = 4 * i, corners[6] = { first, first + 1, first + 2, first, first + 2, first + 3 };
            memcpy(&A.rest[8 * i], square, sizeof(square));
            memcpy(&A.indices[6 * i], corners, sizeof(corners));
            u += 1.0f + rows[k].gaps[i % 2];
        }
        A.vertices = 12;
        A.triangles = 6;
        kiriCounts counts = Host_Counts(&host, Add(&host, &A, 0.01f));
        assert_int_equal(counts.pieces, rows[k].pieces);
        assert_int_equal(counts.vertices, 6 + 2 * rows[k].pieces);
    }
}

/* Where two corners of a triangle are one, nothing is left of it, and its neighbours meet. */
TEST(LeavesOutSlivers)
{
    static const float rest[] = { 0, 0, 1, 0, 1, 0.5f, 1, 0.5001f, 1, 1, 0, 1 };
    static const int32_t indices[] = { 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5 };
    START_HOST(host);
    memset(&A, 0, sizeof(A));
    memcpy(A.rest, rest, sizeof(rest));
    memcpy(A.indices, indices, sizeof(indices));
    A.vertices = 6;
    A.triangles = 4;
    for (int v = 0; v < 6; ++v) {
        double uv[2];
        UvAt(0, rest[2 * v], rest[2 * v + 1], uv);
        A.uv[2 * v] = (float)uv[0];
        A.uv[2 * v + 1] = (float)uv[1];
    }
    CheckCounts(&host, Add(&host, &A, 0.0f), 6, 4);
    kiriSheet sheet = Add(&host, &A, 1e-3f);
    int32_t sources[3];
    CheckCounts(&host, sheet, 5, 3);
    OK(kiriSheet_CopySources(host.world, sheet, 0, 3, sources));
    assert_int_equal(sources[0], 0);
    assert_int_equal(sources[1], 2);
    assert_int_equal(sources[2], 3);
    assert_true(Host_Totals(&host, sheet).area == 1.0);
    static const float cut[] = { 0.5f, -0.1f, 0.52f, 1.1f };
    Host_Cut(&host, sheet, cut, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    GoOnElsewhere(&host); /* sources keep their numbers in saves, and in parts */
    CheckUvs(&host, sheet, &A, 1e-3);
    kiriSheet part = World_Detach(host.world, Host_FrameOf(&host, sheet, 1));
    CheckUvs(&host, sheet, &A, 1e-3);
    CheckUvs(&host, part, &A, 1e-3);
}

/* They change nothing, wherever they lie. */
TEST(LeavesOutUnusedVertices)
{
    uint32_t seed = 44;
    for (int i = 0; i < 40; ++i) {
        int32_t to[MOST_VERTICES];
        HOST_PAIR(hosts);
        MakeAny(&A, &seed);
        memset(&B, 0, sizeof(B));
        for (int32_t v = 0; v < A.vertices; ++v) {
            while (Random(&seed) % 3 == 0) {
                AddVertex(&B, RandomBetween(&seed, -1e4, 1e4), RandomBetween(&seed, -1e4, 1e4), 0);
            }
            to[v] = AddVertex(&B, A.rest[2 * v], A.rest[2 * v + 1], 0);
        }
        for (int32_t t = 0; t < A.triangles; ++t) {
            const int32_t* c = &A.indices[3 * t];
            AddTriangle(&B, to[c[0]], to[c[1]], to[c[2]], 0);
        }
        Host_Start(&hosts[0]);
        Host_Start(&hosts[1]);
        Add(&hosts[0], &A, 0.0f);
        Add(&hosts[1], &B, i % 2 == 0 ? 0.0f : 1e-6f);
        CheckSame(&hosts[0], &hosts[1]);
        CutBoth(&hosts[0], &hosts[1], &seed);
    }
}

/* ---- Refusals ---- */

/* The line says this, of this call. */
static void CheckLine(const Host* host, const char* call, const char* says)
{
    const char* line = kiriWorld_GetLastError(host->world);
    if (strncmp(line, call, strlen(call)) != 0 || line[strlen(call)] != ':' || strstr(line, says) == NULL) {
        fail_msg("\"%s\" does not say \"%s\" of %s", line, says, call);
    }
}

static void Refuse(Host* host, const Import* mesh, float weld, kiriResult expected, const char* says)
{
    kiriSheetDef def = DefOf(mesh, weld);
    kiriSheet sheet = 77;
    assert_int_equal(kiriCreateSheet(host->world, &def, &sheet), expected);
    assert_int_equal(sheet, 0);
    CheckLine(host, "kiriCreateSheet", says);
}

/* One triangle of many is bad: the line has its number, wherever it is. */
TEST(NamesTheTriangle)
{
    uint32_t seed = 46;
    START_HOST(host);
    for (int i = 0; i < 60; ++i) {
        char says[120];
        float weld = i % 2 == 0 ? 0.0f : 1e-6f;
        memset(&A, 0, sizeof(A));
        AddBlock(&A, 0.0, 0.0, 0.125, 8, 8, 0);
        MixTriangles(&A, &seed);
        int32_t bad = (int32_t)(Random(&seed) % 128), *c = &A.indices[3 * bad], index = c[0];
        c[0] = c[1];
        c[1] = index;
        snprintf(says, sizeof(says), "triangle %d is clockwise", bad);
        Refuse(&host, &A, weld, KIRI_ERROR_MESH, says);

        c[0] = c[1];
        snprintf(says, sizeof(says), "triangle %d has no area", bad);
        Refuse(&host, &A, 0.0f, KIRI_ERROR_MESH, says);
        c[1] = c[2];
        Refuse(&host, &A, 0.0f, KIRI_ERROR_MESH, says);

        int32_t other = (bad + 1 + (int32_t)(Random(&seed) % 127)) % 128; /* the same once more */
        memcpy(c, &A.indices[3 * other], 3 * sizeof(int32_t));
        snprintf(says, sizeof(says), "triangles %d and %d use the edge from vertex ", bad < other ? bad : other,
                 bad < other ? other : bad);
        Refuse(&host, &A, weld, KIRI_ERROR_MESH, says);

        MakeAny(&B, &seed); /* any mesh, and a shifted copy of one triangle */
        other = (int32_t)(Random(&seed) % (uint32_t)B.triangles);
        for (int k = 0; k < 3; ++k) {
            const float* at = &B.rest[2 * B.indices[3 * other + k]];
            AddVertex(&B, at[0] + 0.004f, at[1] + 0.003f, 0);
        }
        AddTriangle(&B, B.vertices - 3, B.vertices - 2, B.vertices - 1, 0);
        Refuse(&host, &B, 0.0f, KIRI_ERROR_MESH, "triangles ");
        int first, second;
        assert_int_equal(sscanf(host.line, "kiriCreateSheet: triangles %d and %d overlap", &first, &second), 2);
        assert_true(first < second && second == B.triangles - 1);
    }
}

TEST(NamesWhatWeldingDoes)
{
    static const float flat[] = { 2, 2, 2, 2, 2, 2 }, small[] = { 0, 0, 1, 0, 0, 1 };
    static const float flips[] = { 0, 0, 1, 0, 0.5f, 0.01f, 0.505f, -0.03f, 0.52f, -1 };
    static const int32_t two[] = { 0, 1, 2, 0, 3, 1 }, one[] = { 0, 1, 2 };
    START_HOST(host);
    memset(&A, 0, sizeof(A));
    A.vertices = 3;
    A.triangles = 1;
    memcpy(A.indices, one, sizeof(one));
    memcpy(A.rest, flat, sizeof(flat));
    Refuse(&host, &A, 0.0f, KIRI_ERROR_MESH, "triangle 0 has no area: all rest positions are the same point");
    Refuse(&host, &A, 1.0f, KIRI_ERROR_MESH, "triangle 0 has no area: all rest positions are the same point");
    memcpy(A.rest, small, sizeof(small));
    Refuse(&host, &A, 2.0f, KIRI_ERROR_MESH, "triangle 0 and all others have two corners nearer than weldDistance");
    Refuse(&host, &A, -1.0f, KIRI_ERROR_ARGUMENT, "weldDistance");
    Refuse(&host, &A, NAN, KIRI_ERROR_ARGUMENT, "weldDistance");
    Refuse(&host, &A, INFINITY, KIRI_ERROR_ARGUMENT, "weldDistance");
    memcpy(A.rest, flips, sizeof(flips));
    memcpy(A.indices, two, sizeof(two));
    A.vertices = 5;
    A.triangles = 2;
    Add(&host, &A, 0.0f);
    Refuse(&host, &A, 0.05f, KIRI_ERROR_MESH,
           "triangle 1 is clockwise, when vertices nearer than weldDistance are one");
    A.indices[4] = 7;
    Refuse(&host, &A, 0.0f, KIRI_ERROR_ARGUMENT, "triangle 1 has vertex 7, which is not within 0 and 4");
    A.indices[4] = -1;
    Refuse(&host, &A, 0.0f, KIRI_ERROR_ARGUMENT, "triangle 1 has vertex -1, which is not within 0 and 4");
    A.indices[4] = 3;
    A.rest[8] = NAN;
    Refuse(&host, &A, 0.0f, KIRI_ERROR_ARGUMENT, "restPositions[8] is NaN, not finite");
}

/* A line names the call that the host made. */
TEST(RectanglesSpeakForThemselves)
{
    static const float far[] = { 0.5f, 0.5f, 3.0f, 3.0f };
    kiriSheet sheet;
    kiriSheetDef def, zeroed;
    START_HOST(host);
    memset(&zeroed, 0, sizeof(zeroed));
    assert_int_equal(kiriCreateRectangle(host.world, 1, 1, 2, 2, &zeroed, &sheet), KIRI_ERROR_DEF);
    CheckLine(&host, "kiriCreateRectangle", "kiriDefaultSheetDef");
    kiriDefaultSheetDef(&def);
    def.gridResolution = 0;
    assert_int_equal(kiriCreateRectangle(host.world, 1, 1, 2, 2, &def, &sheet), KIRI_ERROR_ARGUMENT);
    CheckLine(&host, "kiriCreateRectangle", "gridResolution");
    kiriDefaultSheetDef(&def);
    def.framePoints = far;
    def.frameCount = 2;
    assert_int_equal(kiriCreateRectangle(host.world, 1, 1, 2, 2, &def, &sheet), KIRI_ERROR_ARGUMENT);
    CheckLine(&host, "kiriCreateRectangle", "frame point 1 lies outside the material");
    kiriDefaultSheetDef(&def);
    def.weldDistance = 10.0f;
    assert_int_equal(kiriCreateRectangle(host.world, 1, 1, 2, 2, &def, &sheet), KIRI_ERROR_MESH);
    CheckLine(&host, "kiriCreateRectangle", "triangle 0");
    assert_int_equal(kiriCreateRectangle(host.world, 1, 1, 2, 2, NULL, NULL), KIRI_ERROR_ARGUMENT);
    CheckLine(&host, "kiriCreateRectangle", "sheet is null");
    for (int64_t at = 0; at < 12; ++at) {
        host.failAt = host.calls + at;
        assert_int_equal(kiriCreateRectangle(host.world, 1, 1, 2, 2, NULL, &sheet), KIRI_ERROR_MEMORY);
        CheckLine(&host, "kiriCreateRectangle", "memory");
    }
    host.failAt = -1;
}
