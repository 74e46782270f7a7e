/* Pieces: what is in them, and sheets of their own. Where the header can tell, only it is asked. */
#include "host.h"

enum { MOST_PIECES = 4096 };

/* ---- Scenes ---- */

/* Random chords across a unit square, and some loops inside. */
static void Shred(Host* host, kiriSheet sheet, int32_t lines, uint32_t* seed)
{
    for (int32_t i = 0; i < lines; ++i) {
        float at = (float)RandomBetween(seed, 0.02, 0.98), to = (float)RandomBetween(seed, 0.02, 0.98);
        float across[6] = { at, -0.1f, 0.5f * (at + to) + 0.03f, 0.5f, to, 1.1f };
        float along[6] = { -0.1f, at, 0.5f, 0.5f * (at + to) - 0.03f, 1.1f, to };
        Host_Cut(host, sheet, i % 2 == 0 ? across : along, 3);
    }
    float u = (float)RandomBetween(seed, 0.1, 0.7), v = (float)RandomBetween(seed, 0.1, 0.7);
    float loop[10] = { u, v, u + 0.2f, v, u + 0.2f, v + 0.15f, u, v + 0.15f, u, v };
    Host_Cut(host, sheet, loop, 5);
}

static kiriSheetDef AnyDef(uint32_t* seed)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.gridResolution = 12 + (int32_t)(Random(seed) % 12);
    def.frameCount = 3 + (int32_t)(Random(seed) % 5);
    def.maxFrames = 4096;
    def.collisionPoints = (int32_t)(Random(seed) % 3) * 20;
    def.sleepSpeed = 0.0f;
    def.iterations = 4;
    def.model = (int32_t)(Random(seed) % 3);
    return def;
}

static void Tick(Host* host, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        assert_true(kiriWorld_Tick(host->world, 1.0f / 60.0f, 2) >= 0);
    }
}

static kiriPieceState StateOf(Host* host, kiriSheet sheet, int32_t piece)
{
    kiriPieceState state;
    OK(kiriSheet_GetPiece(host->world, sheet, piece, &state));
    return state;
}

static kiriPieceMesh MeshOf(Host* host, kiriSheet sheet, int32_t piece)
{
    kiriPieceMesh mesh;
    OK(kiriSheet_GetPieceMesh(host->world, sheet, piece, &mesh));
    return mesh;
}

/* ---- Lists, against parts that hang together by vertices ---- */

static int32_t Root(int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        i = parent[i];
    }
    return i;
}

/* part[v] of each vertex: the lowest vertex that it hangs together with. */
static int32_t* PartsOf(const kiriMesh* mesh)
{
    int32_t* part = malloc(sizeof(int32_t) * (size_t)mesh->vertexCount);
    for (int32_t v = 0; v < mesh->vertexCount; ++v) {
        part[v] = v;
    }
    for (int32_t k = 0; k < 3 * mesh->triangleCount; ++k) {
        int32_t a = Root(part, mesh->indices[k]), b = Root(part, mesh->indices[k - k % 3]);
        part[a > b ? a : b] = a < b ? a : b;
    }
    for (int32_t v = 0; v < mesh->vertexCount; ++v) {
        part[v] = Root(part, v);
    }
    return part;
}

static double AreaOf(const kiriMesh* mesh, const int32_t* corners)
{
    const float *a = &mesh->restPositions[2 * corners[0]], *b = &mesh->restPositions[2 * corners[1]],
                *c = &mesh->restPositions[2 * corners[2]];
    return 0.5 * (((double)b[0] - a[0]) * ((double)c[1] - a[1]) - ((double)b[1] - a[1]) * ((double)c[0] - a[0]));
}

static void CheckTriangles(const kiriMesh* mesh, const kiriPieceMesh* piece, const int32_t* part, double area)
{
    double sum = 0.0;
    for (int32_t t = 0; t < piece->triangleCount; ++t) {
        const int32_t* corners = &mesh->indices[3 * piece->triangles[t]];
        assert_true(t == 0 || piece->triangles[t] > piece->triangles[t - 1]);
        assert_memory_equal(corners, &piece->indices[3 * t], 3 * sizeof(int32_t));
        assert_int_equal(part[corners[0]], part[piece->vertices[0]]);
        sum += AreaOf(mesh, corners);
    }
    assert_float_equal(sum, area, 1e-6);
}

static void CheckVertices(const kiriMesh* mesh, const kiriPieceMesh* piece, const int32_t* part,
                          const kiriPieceState* state)
{
    float lower[3] = { INFINITY, INFINITY, INFINITY }, upper[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (int32_t i = 0; i < piece->vertexCount; ++i) {
        int32_t v = piece->vertices[i];
        assert_true(i == 0 || v > piece->vertices[i - 1]);
        assert_int_equal(part[v], part[piece->vertices[0]]);
        for (int k = 0; k < 3; ++k) {
            lower[k] = fminf(lower[k], mesh->positions[3 * v + k]);
            upper[k] = fmaxf(upper[k], mesh->positions[3 * v + k]);
        }
    }
    assert_memory_equal(lower, state->lower, sizeof(lower));
    assert_memory_equal(upper, state->upper, sizeof(upper));
}

static void CheckPieceFrames(Host* host, kiriSheet sheet, int32_t piece, const kiriPieceState* state)
{
    const kiriFrame* frames;
    int32_t count, of;
    double mass = 0.0;
    OK(kiriSheet_GetPieceFrames(host->world, sheet, piece, &frames, &count));
    assert_int_equal(count, state->frames);
    assert_true(count > 0);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState frame;
        OK(kiriFrame_GetState(host->world, frames[i], &frame));
        OK(kiriFrame_GetPiece(host->world, frames[i], &of));
        assert_int_equal(of, piece);
        mass += frame.mass;
    }
    assert_float_equal(mass, state->mass, 1e-5 * state->mass);
}

static bool IsNear(double a, double b, double scale)
{
    return fabs(a - b) <= 1e-12 * (scale + fabs(a) + fabs(b));
}

/* All pieces together are the sheet. */
static void CheckPieces(Host* host, kiriSheet sheet)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    kiriCounts counts = Host_Counts(host, sheet);
    kiriTotals totals = Host_Totals(host, sheet);
    int32_t* part = PartsOf(&mesh);
    int32_t parts = 0, vertices = 0, triangles = 0, frames = 0, points = 0;
    double area = 0.0, mass = 0.0, momentum[3] = { 0 }, angular[3] = { 0 }, center[3] = { 0 };
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        parts += part[v] == v;
    }
    assert_int_equal(parts, counts.pieces);
    for (int32_t p = 0; p < counts.pieces; ++p) {
        kiriPieceState state = StateOf(host, sheet, p);
        kiriPieceMesh piece = MeshOf(host, sheet, p);
        assert_int_equal(piece.vertexCount, state.vertices);
        assert_int_equal(piece.triangleCount, state.triangles);
        assert_int_equal(piece.collisionPointCount, state.collisionPoints);
        assert_true(counts.collisionPoints == 0 || state.collisionPoints > 0);
        CheckTriangles(&mesh, &piece, part, state.area);
        CheckVertices(&mesh, &piece, part, &state);
        CheckPieceFrames(host, sheet, p, &state);
        vertices += state.vertices;
        triangles += state.triangles;
        frames += state.frames;
        points += state.collisionPoints;
        area += state.area;
        mass += state.mass;
        for (int k = 0; k < 3; ++k) {
            momentum[k] += state.momentum[k];
            angular[k] += state.angularMomentum[k];
            center[k] += state.mass * state.center[k];
        }
    }
    free(part);
    assert_int_equal(vertices, counts.vertices);
    assert_int_equal(triangles, counts.triangles);
    assert_int_equal(frames, counts.frames);
    assert_int_equal(points, counts.collisionPoints);
    assert_true(IsNear(area, totals.area, 0.0) && IsNear(mass, totals.mass, 0.0));
    for (int k = 0; k < 3; ++k) {
        assert_true(IsNear(momentum[k], totals.momentum[k], mass));
        assert_true(IsNear(angular[k], totals.angularMomentum[k], mass));
        assert_true(IsNear(center[k] / mass, totals.center[k], 1.0));
    }
}

static void TestListsOfConfetti(void** state)
{
    (void)state;
    int32_t most = 0;
    for (uint32_t run = 1; run <= 12; ++run) {
        uint32_t seed = 77u * run;
        Host host;
        Host_Start(&host);
        kiriSheetDef def = AnyDef(&seed);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 10, 10);
        CheckPieces(&host, sheet);
        for (int pass = 0; pass < 3; ++pass) {
            Shred(&host, sheet, 1 + (int32_t)(Random(&seed) % 6), &seed);
            Tick(&host, 2);
            CheckPieces(&host, sheet);
        }
        int32_t pieces = Host_Counts(&host, sheet).pieces;
        most = pieces > most ? pieces : most;
        Host_Stop(&host);
    }
    assert_true(most > 40);
}

/* While a budget holds the work up, pieces are those of the model: they hang together as before. */
static void TestListsWhileWorkWaits(void** state)
{
    (void)state;
    uint32_t seed = 5;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = AnyDef(&seed);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 10, 10);
    kiriBudget budget = { 0, 40, 0, 0 };
    OK(kiriWorld_SetBudget(host.world, &budget));
    Shred(&host, sheet, 4, &seed);
    int32_t waits = 0;
    while (kiriWorld_Tick(host.world, 1.0f / 60.0f, 1) == KIRI_PENDING) {
        kiriCounts counts = Host_Counts(&host, sheet);
        kiriPieceState whole = StateOf(&host, sheet, 0);
        assert_int_equal(counts.pieces, 1);
        assert_int_equal(whole.vertices, counts.vertices);
        assert_int_equal(whole.triangles, counts.triangles);
        ++waits;
    }
    assert_true(waits > 2);
    CheckPieces(&host, sheet);
    Host_Stop(&host);
}

/* Nothing is sorted again when nothing has changed; the arrays stay where they are. */
static void TestListsAreLazy(void** state)
{
    (void)state;
    uint32_t seed = 9;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = AnyDef(&seed);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 10, 10);
    Shred(&host, sheet, 4, &seed);
    Tick(&host, 1);
    kiriPieceMesh first = MeshOf(&host, sheet, 1);
    int64_t calls = host.calls;
    Tick(&host, 3);
    kiriPieceMesh again = MeshOf(&host, sheet, 1);
    assert_int_equal(host.calls, calls);
    assert_ptr_equal(first.vertices, again.vertices);
    assert_ptr_equal(first.indices, again.indices);
    Host_Stop(&host);
}

static void TestPieceErrors(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    kiriPieceState piece;
    kiriPieceMesh mesh;
    const kiriFrame* frames;
    int32_t count;
    assert_int_equal(kiriSheet_GetPiece(host.world, sheet, 1, &piece), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_GetPiece(host.world, sheet, -1, &piece), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_GetPiece(host.world, sheet, 0, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_GetPiece(host.world, sheet + 1, 0, &piece), KIRI_ERROR_ID);
    assert_int_equal(kiriSheet_GetPieceMesh(host.world, sheet, 0, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_GetPieceFrames(host.world, sheet, 0, NULL, &count), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriFrame_GetPiece(host.world, 0, &count), KIRI_ERROR_ID);
    int32_t failures = 0;
    host.failAt = host.calls;
    while (kiriSheet_GetPieceMesh(host.world, sheet, 0, &mesh) == KIRI_ERROR_MEMORY) {
        host.failOnce = true;
        host.failAt = host.calls + ++failures;
        assert_true(failures < 100);
    }
    assert_true(failures > 0);
    OK(kiriSheet_GetPieceFrames(host.world, sheet, 0, &frames, &count));
    assert_int_equal(count, 4);
    Host_Stop(&host);
}

/* The frame that the event names is in the piece, whatever the piece is numbered later. */
static void TestEventNamesFrame(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
    float loop[10] = { 0.4f, 0.4f, 0.62f, 0.4f, 0.62f, 0.62f, 0.4f, 0.62f, 0.4f, 0.4f };
    Host_Cut(&host, sheet, loop, 5);
    Tick(&host, 1);
    kiriEvent event = { 0 };
    int32_t piece = -1;
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIECE_OFF, &event), 1);
    OK(kiriFrame_GetPiece(host.world, event.frame, &piece));
    assert_int_equal(piece, event.piece);
    kiriPieceState off = StateOf(&host, sheet, piece);
    assert_float_equal(off.area, 0.22 * 0.22, 1e-6);
    assert_float_equal(off.area, event.area, 1e-7);
    assert_float_equal(off.mass, off.area * def.material.density * def.material.thickness, 1e-9);
    assert_float_equal(off.center[0], 0.51, 1e-4);
    assert_true(off.lower[0] > 0.39f && off.upper[1] < 0.63f);
    Host_Stop(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestListsOfConfetti), cmocka_unit_test(TestListsWhileWorkWaits),
        cmocka_unit_test(TestListsAreLazy),    cmocka_unit_test(TestPieceErrors),
        cmocka_unit_test(TestEventNamesFrame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
