/* Pieces: what is in them, and sheets of their own. Where the header can tell, only it is asked. */
#include "host.h"

#include "sheet/kiri_piece.h"
#include "world/kiri_world.h"

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
        assert_true(Host_Tick(host, 1.0f / 60.0f, 2) >= 0);
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
    while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
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
    kiriPieceState off = StateOf(&host, sheet, piece);
    assert_float_equal(off.area, 0.22 * 0.22, 1e-6);
    assert_float_equal(off.area, event.area, 1e-7);
    assert_float_equal(off.mass, off.area * def.material.density * def.material.thickness, 1e-9);
    assert_float_equal(off.center[0], 0.51, 1e-4);
    assert_true(off.lower[0] > 0.39f && off.upper[1] < 0.63f);
    Host_Stop(&host);
}

/* ---- Sheets of their own ---- */

static kiriSheetData* DataOf(const Host* host, kiriSheet sheet)
{
    for (int32_t i = 0; i < host->world->sheets.count; ++i) {
        if (host->world->sheets.data[i]->id == sheet) {
            return host->world->sheets.data[i];
        }
    }
    return NULL;
}

/* What a sheet was, by value, and where each vertex, triangle, frame and point of a part comes from. */
typedef struct Before {
    kiriSheetData data; /* its arrays are copies */
    kiriTotals totals;
} Before;

#define COPY(array)                                                                                                    \
    do {                                                                                                               \
        void* copy = malloc(sizeof(*(array).data) * (size_t)((array).count + 1));                                      \
        if ((array).count > 0) {                                                                                       \
            memcpy(copy, (array).data, sizeof(*(array).data) * (size_t)(array).count);                                 \
        }                                                                                                              \
        (array).data = copy;                                                                                           \
    } while (0)

static Before Remember(Host* host, kiriSheet sheet)
{
    Before before = { *DataOf(host, sheet), Host_Totals(host, sheet) };
    kiriSheetData* data = &before.data;
    assert_true(kiriPieces_ListFrames(DataOf(host, sheet)) && kiriPieces_ListMesh(DataOf(host, sheet)));
    data->lists = DataOf(host, sheet)->lists;
    COPY(data->mesh.triangles);
    COPY(data->mesh.vertices);
    COPY(data->vertexSkin.spans);
    COPY(data->vertexSkin.weights);
    COPY(data->pointSkin.spans);
    COPY(data->pointSkin.weights);
    COPY(data->frames);
    COPY(data->points);
    COPY(data->pins);
    COPY(data->links.links);
    COPY(data->grid.cells);
    COPY(data->grid.squareCell);
    COPY(data->regions.field.owner);
    COPY(data->regions.field.distance);
    COPY(data->regions.onBorder);
    COPY(data->shape.spans);
    COPY(data->shape.weights);
    COPY(data->layout.areaElements.elements);
    COPY(data->layout.areaElements.shares);
    COPY(data->layout.pinFrame);
    COPY(data->layout.framePiece);
    COPY(data->seen.surface.positions);
    COPY(data->seen.surface.places);
    return before;
}

static void Forget(Before* before)
{
    kiriSheetData* data = &before->data;
    void* copies[] = { data->mesh.triangles.data,
                       data->mesh.vertices.data,
                       data->vertexSkin.spans.data,
                       data->vertexSkin.weights.data,
                       data->pointSkin.spans.data,
                       data->pointSkin.weights.data,
                       data->frames.data,
                       data->points.data,
                       data->pins.data,
                       data->links.links.data,
                       data->grid.cells.data,
                       data->grid.squareCell.data,
                       data->regions.field.owner.data,
                       data->regions.field.distance.data,
                       data->regions.onBorder.data,
                       data->shape.spans.data,
                       data->shape.weights.data,
                       data->layout.areaElements.elements.data,
                       data->layout.areaElements.shares.data,
                       data->layout.pinFrame.data,
                       data->layout.framePiece.data,
                       data->seen.surface.positions.data,
                       data->seen.surface.places.data };
    for (size_t i = 0; i < sizeof(copies) / sizeof(copies[0]); ++i) {
        free(copies[i]);
    }
}

/* The maps of a part, made here from the pieces that it holds. */
typedef struct Maps {
    int32_t *vertex, *triangle, *frame, *point; /* of the part: index in the sheet */
    int32_t *vertexTo, *triangleTo, *frameTo;   /* and back, or KIRI_NONE */
} Maps;

static int32_t* Back(const int32_t* from, int32_t count, int32_t whole)
{
    int32_t* back = malloc(sizeof(int32_t) * (size_t)(whole + 1));
    for (int32_t i = 0; i < whole; ++i) {
        back[i] = KIRI_NONE;
    }
    for (int32_t i = 0; i < count; ++i) {
        back[from[i]] = i;
    }
    return back;
}

static bool IsIn(const kiriSheetData* was, int32_t frame, int32_t piece, bool isRest)
{
    return (was->layout.framePiece.data[frame] == piece) != isRest;
}

static int32_t FrameOfVertex(const kiriSheetData* was, int32_t vertex)
{
    return was->vertexSkin.weights.data[was->vertexSkin.spans.data[vertex].first].frame;
}

static Maps Map(const kiriSheetData* was, const kiriSheetData* part, int32_t piece, bool isRest)
{
    Maps maps;
    int32_t n = 0;
    maps.vertex = malloc(sizeof(int32_t) * (size_t)was->mesh.vertices.count);
    maps.triangle = malloc(sizeof(int32_t) * (size_t)was->mesh.triangles.count);
    maps.frame = malloc(sizeof(int32_t) * (size_t)was->frames.count);
    maps.point = malloc(sizeof(int32_t) * (size_t)(was->points.count + 1));
    for (int32_t v = 0; v < was->mesh.vertices.count; ++v) {
        maps.vertex[n] = v;
        n += IsIn(was, FrameOfVertex(was, v), piece, isRest);
    }
    assert_int_equal(n, part->mesh.vertices.count);
    n = 0;
    for (int32_t t = 0; t < was->mesh.triangles.count; ++t) {
        maps.triangle[n] = t;
        n += IsIn(was, FrameOfVertex(was, was->mesh.triangles.data[t].vertex[0]), piece, isRest);
    }
    assert_int_equal(n, part->mesh.triangles.count);
    n = 0;
    for (int32_t f = 0; f < was->frames.count; ++f) {
        maps.frame[n] = f;
        n += IsIn(was, f, piece, isRest);
    }
    assert_int_equal(n, part->frames.count);
    n = 0;
    for (int32_t i = 0; i < was->points.count; ++i) {
        maps.point[n] = i;
        n += IsIn(was, was->points.data[i].frame, piece, isRest);
    }
    assert_int_equal(n, part->points.count);
    maps.vertexTo = Back(maps.vertex, part->mesh.vertices.count, was->mesh.vertices.count);
    maps.triangleTo = Back(maps.triangle, part->mesh.triangles.count, was->mesh.triangles.count);
    maps.frameTo = Back(maps.frame, part->frames.count, was->frames.count);
    return maps;
}

static void Maps_Free(Maps* maps)
{
    free(maps->vertex);
    free(maps->triangle);
    free(maps->frame);
    free(maps->point);
    free(maps->vertexTo);
    free(maps->triangleTo);
    free(maps->frameTo);
}

static void CheckSkin(const kiriSkin* was, const kiriSkin* is, const int32_t* sample, int32_t count, const Maps* maps)
{
    assert_int_equal(is->spans.count, count);
    for (int32_t i = 0; i < count; ++i) {
        kiriSpan a = was->spans.data[sample[i]], b = is->spans.data[i];
        assert_int_equal(a.count, b.count);
        for (int32_t k = 0; k < a.count; ++k) {
            kiriSampleWeight x = was->weights.data[a.first + k], y = is->weights.data[b.first + k];
            assert_int_equal(maps->frameTo[x.frame], y.frame);
            assert_memory_equal(&x.value, &y.value, sizeof(x.value));
        }
    }
}

static void CheckMesh(const kiriSheetData* was, const kiriSheetData* is, const Maps* maps)
{
    for (int32_t t = 0; t < is->mesh.triangles.count; ++t) {
        kiriTriangle a = was->mesh.triangles.data[maps->triangle[t]], b = is->mesh.triangles.data[t];
        assert_int_equal(a.source, b.source);
        for (int k = 0; k < 3; ++k) {
            int32_t twin = a.twin[k] == KIRI_NONE ? KIRI_NONE : maps->triangleTo[a.twin[k] / 3];
            assert_int_equal(maps->vertexTo[a.vertex[k]], b.vertex[k]);
            assert_int_equal(b.twin[k], twin == KIRI_NONE ? KIRI_NONE : 3 * twin + a.twin[k] % 3);
            assert_int_equal(b.marks >> k & 1, twin == KIRI_NONE ? 0 : a.marks >> k & 1);
        }
    }
    for (int32_t v = 0; v < is->mesh.vertices.count; ++v) {
        const kiriVertex *a = &was->mesh.vertices.data[maps->vertex[v]], *b = &is->mesh.vertices.data[v];
        assert_memory_equal(&a->at, &b->at, sizeof(a->at));
        assert_int_equal(a->source, b->source);
        float shares[2][3];
        kiriMesh_GetShare(&was->mesh, maps->vertex[v], shares[0]);
        kiriMesh_GetShare(&is->mesh, v, shares[1]);
        assert_memory_equal(shares[0], shares[1], sizeof(shares[0]));
        assert_int_equal(is->mesh.triangles.data[b->edge / 3].vertex[b->edge % 3], v);
        kiriVec3 off =
            kiriVec3_Sub(kiriSurface_At(&was->seen.surface, maps->vertex[v]), kiriSurface_At(&is->seen.surface, v));
        assert_true(kiriVec3_Length(off) <= 1e-6);
    }
}

/* The square of the sheet that is one of the part. */
static int32_t SquareIn(const kiriSquares* whole, const kiriSquares* part, int32_t square)
{
    int32_t column = square % part->columns + part->firstColumn - whole->firstColumn;
    return (square / part->columns + part->firstRow - whole->firstRow) * whole->columns + column;
}

/* Regions and weights, cell by cell. */
static void CheckCells(const kiriSheetData* was, const kiriSheetData* is, const Maps* maps)
{
    int32_t seen = 0;
    for (int32_t s = 0; s < is->grid.squareCell.count; ++s) {
        int32_t a = was->grid.squareCell.data[SquareIn(&was->mesh.squares, &is->mesh.squares, s)];
        for (int32_t b = is->grid.squareCell.data[s]; b != KIRI_NONE; b = is->grid.cells.data[b].next, ++seen) {
            while (maps->triangleTo[was->grid.cells.data[a].triangle] != is->grid.cells.data[b].triangle) {
                a = was->grid.cells.data[a].next;
            }
            kiriMoments material[2] = { kiriGrid_Material(&was->grid, &was->mesh, a),
                                        kiriGrid_Material(&is->grid, &is->mesh, b) };
            assert_memory_equal(&material[0], &material[1], sizeof(kiriMoments));
            assert_int_equal(maps->frameTo[was->regions.field.owner.data[a]], is->regions.field.owner.data[b]);
            assert_int_equal(was->regions.field.distance.data[a], is->regions.field.distance.data[b]);
            assert_int_equal(was->regions.onBorder.data[a], is->regions.onBorder.data[b]);
            kiriSpan x = was->shape.spans.data[a], y = is->shape.spans.data[b];
            assert_int_equal(x.count, y.count);
            for (int32_t k = 0; k < x.count; ++k) {
                const kiriCellWeight *p = &was->shape.weights.data[x.first + k],
                                     *q = &is->shape.weights.data[y.first + k];
                assert_int_equal(maps->frameTo[p->frame], q->frame);
                assert_true(p->low == q->low && p->high == q->high);
            }
        }
    }
    assert_int_equal(seen, is->grid.cellCount);
}

static void CheckLinks(const kiriSheetData* was, const kiriSheetData* is, const Maps* maps)
{
    int32_t n = 0;
    for (int32_t k = 0; k < was->links.links.count; ++k) {
        kiriLink link = was->links.links.data[k];
        link.i = maps->frameTo[link.i];
        link.j = maps->frameTo[link.j];
        if (link.i != KIRI_NONE) {
            assert_memory_equal(&link, &is->links.links.data[n++], sizeof(link));
        }
    }
    assert_int_equal(n, is->links.links.count);
    n = 0;
    for (int32_t k = 0; k < was->layout.areaElements.elements.count; ++k) {
        const kiriAreaElement* patch = &was->layout.areaElements.elements.data[k];
        const kiriFrameShare* share = &was->layout.areaElements.shares.data[patch->first];
        if (maps->frameTo[share->frame] == KIRI_NONE) {
            continue;
        }
        const kiriAreaElement* other = &is->layout.areaElements.elements.data[n++];
        assert_true(patch->area == other->area && patch->lean == other->lean);
        assert_int_equal(patch->count, other->count);
        for (int32_t m = 0; m < patch->count; ++m) {
            kiriFrameShare x = share[m], y = is->layout.areaElements.shares.data[other->first + m];
            assert_int_equal(maps->frameTo[x.frame], y.frame);
            assert_true(x.weight == y.weight && x.slope.x == y.slope.x && x.move.y == y.move.y && x.u.x == y.u.x);
        }
    }
    assert_int_equal(n, is->layout.areaElements.elements.count);
}

static void CheckFrames(Host* host, kiriSheet sheet, const kiriSheetData* was, const kiriSheetData* is,
                        const Maps* maps)
{
    for (int32_t f = 0; f < is->frames.count; ++f) {
        kiriFrameData a = was->frames.data[maps->frame[f]], b = is->frames.data[f];
        assert_memory_equal(&a.site.at, &b.site.at, sizeof(a.site.at));
        memcpy(&a.site, &b.site, sizeof(a.site));
        assert_memory_equal(&a, &b, sizeof(a));
        const kiriSlot* slot = kiriPool_Find(&host->world->frameIds, b.id);
        assert_true(slot->owner == is && slot->index == f);
        assert_int_equal(is->id, sheet);
    }
    for (int32_t i = 0; i < is->points.count; ++i) {
        const kiriSample *a = &was->points.data[maps->point[i]], *b = &is->points.data[i];
        assert_memory_equal(&a->at, &b->at, sizeof(a->at));
        assert_int_equal(maps->frameTo[a->frame], b->frame);
    }
    for (int32_t i = 0, n = 0; i < was->pins.count; ++i) {
        if (maps->frameTo[was->layout.pinFrame.data[i]] != KIRI_NONE) {
            const kiriSlot* slot = kiriPool_Find(&host->world->pinIds, was->pins.data[i].id);
            assert_memory_equal(&was->pins.data[i], &is->pins.data[n], sizeof(kiriPinData));
            assert_int_equal(maps->frameTo[was->layout.pinFrame.data[i]], is->layout.pinFrame.data[n]);
            assert_true(slot->owner == is && slot->index == n++);
        }
    }
}

static void CheckPart(Host* host, kiriSheet sheet, const Before* before, int32_t piece, bool isRest)
{
    const kiriSheetData *was = &before->data, *is = DataOf(host, sheet);
    Maps maps = Map(was, is, piece, isRest);
    CheckMesh(was, is, &maps);
    CheckCells(was, is, &maps);
    CheckLinks(was, is, &maps);
    CheckSkin(&was->vertexSkin, &is->vertexSkin, maps.vertex, is->mesh.vertices.count, &maps);
    CheckSkin(&was->pointSkin, &is->pointSkin, maps.point, is->points.count, &maps);
    CheckFrames(host, sheet, was, is, &maps);
    Maps_Free(&maps);
    CheckPieces(host, sheet);
}

/* Area, mass, energy and momentum of both are those of the one before. */
static void CheckSum(Host* host, const Before* before, kiriSheet a, kiriSheet b)
{
    kiriTotals x = Host_Totals(host, a), y = Host_Totals(host, b), was = before->totals;
    double speed = sqrt(2.0 * was.kineticEnergy * was.mass) + 1e-300;
    assert_true(IsNear(x.area + y.area, was.area, 0.0) && IsNear(x.mass + y.mass, was.mass, 0.0));
    assert_true(IsNear(x.kineticEnergy + y.kineticEnergy, was.kineticEnergy, 0.0));
    assert_true(IsNear(x.elasticEnergy + y.elasticEnergy, was.elasticEnergy, 0.0));
    for (int k = 0; k < 3; ++k) {
        assert_true(IsNear(x.momentum[k] + y.momentum[k], was.momentum[k], speed));
        assert_true(IsNear(x.angularMomentum[k] + y.angularMomentum[k], was.angularMomentum[k], speed));
    }
}

/* Pins in two corners, held frames and contacts: all that a sheet can have. */
static kiriSheet Furnish(Host* host, kiriSheetDef* def, int32_t lines, uint32_t* seed)
{
    kiriSheet sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, 10, 10);
    for (int i = 0; i < 4; ++i) {
        kiriPinDef pin;
        kiriPin id;
        kiriDefaultPinDef(&pin);
        pin.restPoint[0] = pin.target[0] = i % 2 == 0 ? 0.0f : 0.97f;
        pin.restPoint[1] = pin.target[1] = i / 2 == 0 ? 0.01f : 1.0f;
        OK(kiriCreatePin(host->world, sheet, &pin, &id));
    }
    Shred(host, sheet, lines, seed);
    Tick(host, 5);
    return sheet;
}

static void TestPartsAreWhatTheyWere(void** state)
{
    (void)state;
    for (uint32_t run = 1; run <= 12; ++run) {
        uint32_t seed = 191u * run;
        Host host;
        Host_Start(&host);
        kiriSheetDef def = AnyDef(&seed);
        def.skinning = (int32_t)(run % 2);
        kiriSheet sheet = Furnish(&host, &def, 4, &seed);
        for (int pass = 0; pass < 4; ++pass) {
            Tick(&host, 1);
            int32_t pieces = Host_Counts(&host, sheet).pieces;
            int32_t piece = (int32_t)(Random(&seed) % (uint32_t)pieces);
            Before before = Remember(&host, sheet);
            kiriMesh old = Host_Mesh(&host, sheet);
            kiriSheet detached;
            OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, piece), &detached));
            assert_true(Host_Mesh(&host, sheet).revision > old.revision);
            kiriDirty dirty;
            kiriSurface_GetDirty(&DataOf(&host, sheet)->seen.surface, old.revision, &dirty);
            assert_int_equal(dirty.newVertices.first, 0);
            assert_int_equal(dirty.newTriangles.count, Host_Counts(&host, sheet).triangles);
            assert_int_equal(Host_Counts(&host, detached).pieces, 1);
            assert_int_equal(Host_Counts(&host, sheet).pieces, pieces - 1);
            CheckPart(&host, detached, &before, piece, false);
            CheckPart(&host, sheet, &before, piece, true);
            CheckSum(&host, &before, sheet, detached);
            Forget(&before);
        }
        Shred(&host, sheet, 2, &seed); /* cutting goes on */
        Tick(&host, 3);
        CheckPieces(&host, sheet);
        Host_Stop(&host);
    }
}

/* What still fades when a piece is detached goes on to fade, in both parts. */
static void TestPartsGoOnFading(void** state)
{
    (void)state;
    static const float cuts[2][10] = { { 0.35f, 0.3f, 0.65f, 0.3f, 0.65f, 0.6f, 0.35f, 0.6f, 0.35f, 0.3f },
                                       { 0.1f, 0.1f, 0.2f, 0.8f, 0.5f, 0.75f, 0.8f, 0.8f, 0.9f, 0.2f } };
    uint32_t seed = 5;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Furnish(&host, &def, 0, &seed), detached;
    Tick(&host, 15);
    Host_Cut(&host, sheet, cuts[0], 5);
    Host_Cut(&host, sheet, cuts[1], 5);
    Tick(&host, 1);
    assert_true(Host_Counts(&host, sheet).pieces > 1);
    int32_t fading = DataOf(&host, sheet)->seen.fades.fading.count;
    assert_true(fading > 0);
    Before before = Remember(&host, sheet);
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 1), &detached));
    assert_int_equal(DataOf(&host, sheet)->seen.fades.fading.count + DataOf(&host, detached)->seen.fades.fading.count,
                     fading);
    CheckPart(&host, detached, &before, 1, false);
    CheckPart(&host, sheet, &before, 1, true);
    Forget(&before);
    Tick(&host, 30);
    assert_int_equal(DataOf(&host, sheet)->seen.fades.fading.count, 0);
    Host_Stop(&host);
}

/* The farthest that a vertex of the part is from where it is in the sheet that was not taken apart. */
static double Gap(const kiriSheetData* whole, const kiriSheetData* part, const int32_t* vertex)
{
    double most = 0.0;
    for (int32_t v = 0; v < part->mesh.vertices.count; ++v) {
        double gap = kiriVec3_Length(
            kiriVec3_Sub(kiriSurface_At(&whole->seen.surface, vertex[v]), kiriSurface_At(&part->seen.surface, v)));
        most = gap > most ? gap : most;
    }
    return most;
}

static int32_t TickBoth(Host hosts[2])
{
    int32_t ticks = 0;
    for (; ticks < 60; ++ticks) {
        Tick(&hosts[0], 1);
        Tick(&hosts[1], 1);
    }
    return ticks;
}

/* The same scene twice, with pieces detached in one of them. Returns the ticks for which both go on; *gap is how far
   vertices are then from each other. */
static int32_t RunTwice(const kiriSheetDef* def, uint32_t seed, int32_t detach, double* gap)
{
    static const float gentle[3] = { 0.2f, 0.0f, -1.0f }; /* in 16 iterations each step converges */
    Host hosts[2];
    kiriSheet sheets[2], part = 0;
    for (int h = 0; h < 2; ++h) {
        uint32_t own = seed;
        kiriSheetDef copy = *def;
        Host_Start(&hosts[h]);
        OK(kiriWorld_SetGravity(hosts[h].world, gentle));
        sheets[h] = Furnish(&hosts[h], &copy, 3, &own);
    }
    Before before = Remember(&hosts[0], sheets[0]);
    int32_t pieces = Host_Counts(&hosts[0], sheets[0]).pieces;
    Maps maps[8];
    const kiriSheetData* parts[8];
    assert_true(detach < pieces && detach < 8);
    for (int32_t k = 0; k < detach; ++k) {
        OK(kiriFrame_DetachPiece(hosts[1].world, Host_FrameOf(&hosts[1], sheets[1], pieces - 1 - k), &part));
        parts[k] = DataOf(&hosts[1], part);
        maps[k] = Map(&before.data, parts[k], pieces - 1 - k, false);
    }
    int32_t ticks = TickBoth(hosts);
    *gap = 0.0;
    for (int32_t k = 0; k < detach; ++k) {
        if (ticks == 60) {
            *gap = fmax(*gap, Gap(DataOf(&hosts[0], sheets[0]), parts[k], maps[k].vertex));
        }
        Maps_Free(&maps[k]);
    }
    if (detach == 1 && ticks == 60) {
        Maps rest = Map(&before.data, DataOf(&hosts[1], sheets[1]), pieces - 1, true);
        *gap = fmax(*gap, Gap(DataOf(&hosts[0], sheets[0]), DataOf(&hosts[1], sheets[1]), rest.vertex));
        Maps_Free(&rest);
    }
    Forget(&before);
    Host_Stop(&hosts[0]);
    Host_Stop(&hosts[1]);
    return ticks;
}

static void TestMotionGoesOn(void** state)
{
    (void)state;
    for (uint32_t run = 1; run <= 18; ++run) {
        uint32_t seed = 401u * run;
        kiriSheetDef def = AnyDef(&seed);
        def.velocity[0] = 0.3f;
        def.material.youngsModulus = 1e6f;
        def.iterations = 16;
        def.model = (int32_t)(run % 3);
        double gap;
        assert_int_equal(RunTwice(&def, seed, run % 2 == 0 ? 1 : 4, &gap), 60);
        assert_true(gap < 1e-6);
    }
}

/* ---- What else can happen to parts ---- */

/* A sheet in four strips: 0 is the lowest frame's, and so on. */
static kiriSheet Strips(Host* host, int32_t count)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.gridResolution = 16;
    def.frameCount = 6;
    def.collisionPoints = 12;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 8, 8);
    for (int32_t i = 1; i < count; ++i) {
        float v = (float)i / (float)count + 0.013f, way[4] = { -0.1f, v, 1.1f, v };
        Host_Cut(host, sheet, way, 2);
    }
    Tick(host, 1);
    assert_int_equal(Host_Counts(host, sheet).pieces, count);
    return sheet;
}

static int32_t PieceAt(Host* host, kiriSheet sheet, double v)
{
    int32_t found = KIRI_NONE;
    for (int32_t p = 0; p < Host_Counts(host, sheet).pieces; ++p) {
        kiriPieceMesh mesh = MeshOf(host, sheet, p);
        double low = 2.0, high = -1.0;
        for (int32_t i = 0; i < mesh.vertexCount; ++i) {
            double at = Host_Mesh(host, sheet).restPositions[2 * mesh.vertices[i] + 1];
            low = fmin(low, at);
            high = fmax(high, at);
        }
        found = v > low && v < high ? p : found;
    }
    return found;
}

/* A blade that stands in a piece which goes cuts nothing there, but cuts the rest when it gets there. */
static void TestCutsStayWithTheRest(void** state)
{
    (void)state;
    for (int kept = 0; kept < 2; ++kept) {
        Host host;
        Host_Start(&host);
        kiriSheet sheet = Strips(&host, 3), detached = 0;
        float start[2] = { 0.5f, 0.1f }, inside[2] = { 0.5f, 0.2f }, on[4] = { 0.53f, 0.3f, 0.5f, 1.1f };
        kiriCut cut;
        OK(kiriBeginCut(host.world, sheet, start, &cut));
        OK(kiriCut_Extend(host.world, cut, inside, 1));
        Tick(&host, 1);
        assert_int_equal(Host_Counts(&host, sheet).pieces, 3);
        int32_t piece = PieceAt(&host, sheet, 0.15);
        OK(kept ? kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, piece), &detached)
                : kiriFrame_DestroyPiece(host.world, Host_FrameOf(&host, sheet, piece)));
        OK(kiriCut_Extend(host.world, cut, on, 2));
        OK(kiriCut_End(host.world, cut));
        kiriCounts before = { 0 };
        if (kept) {
            before = Host_Counts(&host, detached);
        }
        Tick(&host, 1);
        assert_int_equal(Host_Events(&host, KIRI_EVENT_CUT_FINISHED, NULL), 1);
        assert_int_equal(Host_Counts(&host, sheet).pieces, 4); /* two strips in two */
        if (kept) {
            kiriCounts after = Host_Counts(&host, detached);
            assert_memory_equal(&before, &after, sizeof(before));
        }
        CheckPieces(&host, sheet);
        Host_Stop(&host);
    }
}

/* The blade stands in the rest, on a vertex that gets another number. */
static void TestBladeOfTheRestGoesOn(void** state)
{
    (void)state;
    uint64_t areas = 0;
    double most[2] = { 0.0, 0.0 };
    for (int detach = 0; detach < 2; ++detach) {
        Host host;
        Host_Start(&host);
        kiriSheet sheet = Strips(&host, 3), detached = 0;
        float start[2] = { 0.31f, 0.8f }, inside[2] = { 0.42f, 0.85f }, on[4] = { 0.6f, 0.9f, 0.55f, 1.1f };
        kiriCut cut;
        OK(kiriBeginCut(host.world, sheet, start, &cut));
        OK(kiriCut_Extend(host.world, cut, inside, 1));
        Tick(&host, 1);
        if (detach) {
            OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, PieceAt(&host, sheet, 0.1)), &detached));
        }
        OK(kiriCut_Extend(host.world, cut, on, 2));
        OK(kiriCut_End(host.world, cut));
        Tick(&host, 1);
        kiriPieceMesh mesh = MeshOf(&host, sheet, PieceAt(&host, sheet, 0.8));
        most[detach] = mesh.triangleCount;
        areas += (uint64_t)mesh.vertexCount;
        Host_Stop(&host);
    }
    assert_true(most[0] == most[1] && areas % 2 == 0);
}

static void TestIdsMoveAlong(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    kiriSheet sheet = Strips(&host, 3), detached;
    kiriPin pins[3];
    for (int i = 0; i < 3; ++i) {
        kiriPinDef def;
        kiriDefaultPinDef(&def);
        def.restPoint[0] = def.target[0] = 0.5f;
        def.restPoint[1] = def.target[1] = 0.2f + 0.3f * (float)i;
        OK(kiriCreatePin(host.world, sheet, &def, &pins[i]));
    }
    kiriFrame frames[3];
    for (int i = 0; i < 3; ++i) {
        const kiriFrame* list;
        int32_t count;
        OK(kiriSheet_GetPieceFrames(host.world, sheet, PieceAt(&host, sheet, 0.2 + 0.3 * i), &list, &count));
        frames[i] = list[0];
    }
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, PieceAt(&host, sheet, 0.2)), &detached));
    OK(kiriFrame_DestroyPiece(host.world, Host_FrameOf(&host, sheet, PieceAt(&host, sheet, 0.5))));
    static const float target[3] = { 0.5f, 0.2f, 0.3f };
    kiriFrameState frame;
    OK(kiriPin_SetTarget(host.world, pins[0], target));
    assert_int_equal(kiriPin_SetTarget(host.world, pins[1], target), KIRI_ERROR_ID);
    OK(kiriPin_SetTarget(host.world, pins[2], target));
    OK(kiriFrame_GetState(host.world, frames[0], &frame));
    assert_int_equal(kiriFrame_GetState(host.world, frames[1], &frame), KIRI_ERROR_ID);
    OK(kiriFrame_GetState(host.world, frames[2], &frame));
    Tick(&host, 2);
    OK(kiriDestroyPin(host.world, pins[0]));
    OK(kiriDestroyPin(host.world, pins[2]));
    OK(kiriDestroySheet(host.world, sheet));
    OK(kiriFrame_GetState(host.world, frames[0], &frame));
    assert_int_equal(kiriFrame_GetState(host.world, frames[2], &frame), KIRI_ERROR_ID);
    OK(kiriDestroySheet(host.world, detached));
    Host_Stop(&host);
}

/* Contacts that wait push the part that has the point. */
static void TestContactsMoveAlong(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    static const float none[3] = { 0.0f, 0.0f, 0.0f };
    OK(kiriWorld_SetGravity(host.world, none));
    kiriSheet sheet = Strips(&host, 2), detached;
    int32_t piece = PieceAt(&host, sheet, 0.8);
    kiriContact contact = { .point = MeshOf(&host, sheet, piece).collisionPoints[0],
                            .normal = { 0.0f, 0.0f, 1.0f },
                            .offset = 0.1f };
    OK(kiriSheet_SetContacts(host.world, sheet, &contact, 1));
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, piece), &detached));
    Tick(&host, 1);
    assert_true(Host_Totals(&host, detached).momentum[2] > 1e-3);
    assert_true(fabs(Host_Totals(&host, sheet).momentum[2]) < 1e-12);

    /* Those of the last tick are what sleep is compared with. */
    contact.point = MeshOf(&host, sheet, 0).collisionPoints[0];
    OK(kiriSheet_SetContacts(host.world, sheet, &contact, 1));
    static const float line[4] = { 0.5f, -0.1f, 0.5f, 1.1f };
    Host_Cut(&host, sheet, line, 2);
    Tick(&host, 1);
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 1), &detached));
    assert_int_equal(
        DataOf(&host, sheet)->touches.last.touches.count + DataOf(&host, detached)->touches.last.touches.count, 1);
    Host_Stop(&host);
}

static void TestPartsAreRefused(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    kiriSheet sheet = Strips(&host, 2), detached = 1;
    int32_t count;
    assert_int_equal(kiriFrame_DetachPiece(host.world, 0, &detached), KIRI_ERROR_ID);
    assert_int_equal(detached, 0);
    assert_int_equal(kiriFrame_DetachPiece(host.world, sheet, &detached), KIRI_ERROR_ID);
    assert_int_equal(kiriFrame_DestroyPiece(host.world, sheet), KIRI_ERROR_ID);
    assert_int_equal(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 0), NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_DropCrumbs(host.world, sheet, -1.0f, &count), KIRI_ERROR_ARGUMENT);
    static const float way[4] = { 0.3f, -0.1f, 0.3f, 1.1f };
    Host_Cut(&host, sheet, way, 2);
    Tick(&host, 1);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 4);
    OK(kiriSheet_DropCrumbs(host.world, sheet, 10.0f, &count));
    assert_int_equal(count, 3);
    assert_int_equal(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 0), &detached), KIRI_ERROR_STATE);
    assert_int_equal(kiriFrame_DestroyPiece(host.world, Host_FrameOf(&host, sheet, 0)), KIRI_ERROR_STATE);
    assert_float_equal(Host_Totals(&host, sheet).area, 0.7 * 0.513, 1e-4);
    CheckPieces(&host, sheet);
    Host_Stop(&host);
}

/* Whatever allocation fails, all is as before, and the same call does it afterwards. */
static void TestPartsWithoutMemory(void** state)
{
    (void)state;
    for (int what = 0; what < 3; ++what) {
        Host host;
        Host_Start(&host);
        kiriSheet sheet = Strips(&host, 3), detached;
        int32_t failures = 0, dropped;
        uint64_t before = Host_Hash(&host);
        kiriMesh mesh = Host_Mesh(&host, sheet);
        kiriFrame frame = Host_FrameOf(&host, sheet, 1);
        kiriResult result;
        do {
            int64_t live = host.live;
            host.failAt = host.calls + failures;
            host.failOnce = failures % 2 == 0;
            result = what == 0   ? kiriFrame_DetachPiece(host.world, frame, &detached)
                     : what == 1 ? kiriFrame_DestroyPiece(host.world, frame)
                                 : kiriSheet_DropCrumbs(host.world, sheet, 0.33f, &dropped);
            host.failAt = -1;
            if (result != KIRI_OK) {
                assert_int_equal(result, KIRI_ERROR_MEMORY);
                assert_int_equal(Host_Hash(&host), before);
                assert_ptr_equal(Host_Mesh(&host, sheet).positions, mesh.positions);
                assert_true(host.live <= live + 64); /* room in the world's lists, and for staged bodies */
                ++failures;
            }
        } while (result != KIRI_OK);
        assert_true(failures > (what == 0 ? 100 : 15));
        Tick(&host, 2);
        CheckPieces(&host, sheet);
        Host_Stop(&host);
    }
}

/* ---- Crumbs ---- */

static void TestDropCrumbs(void** state)
{
    (void)state;
    for (uint32_t run = 1; run <= 6; ++run) {
        uint32_t seed = 1009u * run;
        Host host;
        Host_Start(&host);
        kiriSheetDef def = AnyDef(&seed);
        kiriSheet sheet = Furnish(&host, &def, 8, &seed);
        double kept = 0.0, largest = 0.0;
        int32_t below = 0, count, pieces = Host_Counts(&host, sheet).pieces;
        float limit = (float)RandomBetween(&seed, 0.01, run == 1 ? 1.0 : 0.05);
        for (int32_t p = 0; p < pieces; ++p) {
            double area = StateOf(&host, sheet, p).area;
            below += area < limit;
            kept += area < limit ? 0.0 : area;
            largest = fmax(largest, area);
        }
        kept = largest < limit ? largest : kept;
        OK(kiriSheet_DropCrumbs(host.world, sheet, limit, &count));
        assert_int_equal(count, below - (largest < limit));
        assert_int_equal(Host_Counts(&host, sheet).pieces, pieces - count);
        assert_float_equal(Host_Totals(&host, sheet).area, kept, 1e-12);
        CheckPieces(&host, sheet);
        uint64_t hash = Host_Hash(&host);
        OK(kiriSheet_DropCrumbs(host.world, sheet, limit, &count));
        assert_int_equal(count, 0);
        assert_int_equal(Host_Hash(&host), hash);
        Tick(&host, 2);
        Host_Stop(&host);
    }
}

/* Strips of several areas come off: those that are crumbs keep to one frame. */
static void TestCrumbsAreNotSampled(void** state)
{
    (void)state;
    int32_t frames[2] = { 0, 0 }, crumbs[2] = { 0, 0 };
    for (int with = 0; with < 2; ++with) {
        Host host;
        Host_Start(&host);
        kiriSheetDef def;
        kiriDefaultSheetDef(&def);
        def.frameCount = 4;
        def.maxFrames = 4096;
        def.rigidArea = 0.004f;
        def.collisionPoints = 10;
        def.crumbArea = with ? 0.05f : 0.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 12, 12);
        for (int32_t i = 0; i < 5; ++i) {
            float v = 0.03f + 0.04f * (float)i, way[4] = { -0.1f, v, 1.1f, v };
            float u = 0.13f + 0.2f * (float)i, up[4] = { u, -0.1f, u, 0.21f };
            Host_Cut(&host, sheet, way, 2);
            Host_Cut(&host, sheet, up, 2);
            OK(Host_Tick(&host, 1.0f / 60.0f, 1));
            const kiriEvent* events;
            int32_t count;
            OK(kiriWorld_GetEvents(host.world, &events, &count));
            for (int32_t k = 0; k < count; ++k) {
                if (events[k].type == KIRI_EVENT_PIECE_OFF) {
                    assert_int_equal(events[k].crumb, with && events[k].area < 0.05f);
                }
            }
        }
        for (int32_t p = 0; p < Host_Counts(&host, sheet).pieces; ++p) {
            kiriPieceState piece = StateOf(&host, sheet, p);
            assert_int_equal(piece.crumb, with && piece.area < 0.05);
            crumbs[with] += piece.area < 0.05;
            frames[with] += piece.area < 0.05 ? piece.frames : 0;
        }
        CheckPieces(&host, sheet);
        Host_Stop(&host);
    }
    assert_true(crumbs[0] == crumbs[1] && crumbs[0] > 20);
    assert_true(frames[0] > crumbs[0] + 5 && frames[1] < frames[0]);
}

/* All parts of a def that are crumbs have one frame from the start. */
static void TestCrumbsOfDef(void** state)
{
    (void)state;
    static const float positions[16] = { 0, 0, 0.2f, 0, 0.2f, 0.2f, 0, 0.2f, 0.5f, 0, 1.5f, 0, 1.5f, 1, 0.5f, 1 };
    static const int32_t indices[12] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    Host host;
    Host_Start(&host);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = 8;
    def.triangleCount = 4;
    def.frameCount = 100;
    for (int with = 0; with < 2; ++with) {
        def.crumbArea = with ? 0.1f : 0.0f;
        kiriSheet sheet;
        OK(kiriCreateSheet(host.world, &def, &sheet));
        int32_t small = StateOf(&host, sheet, 0).area < 0.1 ? 0 : 1;
        assert_true(with ? StateOf(&host, sheet, small).frames == 1 : StateOf(&host, sheet, small).frames > 1);
    }
    Host_Stop(&host);
}

/* Each piece of confetti has a frame, a collision point, and an integration point: the last are patches. */
static void TestConfettiHasAll(void** state)
{
    (void)state;
    for (uint32_t run = 1; run <= 6; ++run) {
        uint32_t seed = 313u * run;
        Host host;
        Host_Start(&host);
        kiriSheetDef def = AnyDef(&seed);
        def.model = KIRI_MODEL_POINTS;
        def.collisionPoints = 3;
        def.crumbArea = run % 2 == 0 ? 0.01f : 0.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 10, 10);
        for (int pass = 0; pass < 2; ++pass) {
            Shred(&host, sheet, 12, &seed);
            Tick(&host, 1);
            CheckPieces(&host, sheet); /* frames and collision points */
            const kiriLayout* layout = &DataOf(&host, sheet)->layout;
            uint8_t* has = calloc((size_t)layout->pieces.count, 1);
            for (int32_t k = 0; k < layout->areaElements.elements.count; ++k) {
                int32_t frame = layout->areaElements.shares.data[layout->areaElements.elements.data[k].first].frame;
                has[layout->framePiece.data[frame]] = 1;
            }
            for (int32_t p = 0; p < layout->pieces.count; ++p) {
                assert_true(has[p]);
            }
            free(has);
        }
        assert_true(Host_Counts(&host, sheet).pieces > 60);
        Host_Stop(&host);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestListsOfConfetti),     cmocka_unit_test(TestListsWhileWorkWaits),
        cmocka_unit_test(TestListsAreLazy),        cmocka_unit_test(TestPieceErrors),
        cmocka_unit_test(TestEventNamesFrame),     cmocka_unit_test(TestPartsAreWhatTheyWere),
        cmocka_unit_test(TestPartsGoOnFading),     cmocka_unit_test(TestMotionGoesOn),
        cmocka_unit_test(TestCutsStayWithTheRest), cmocka_unit_test(TestBladeOfTheRestGoesOn),
        cmocka_unit_test(TestIdsMoveAlong),        cmocka_unit_test(TestContactsMoveAlong),
        cmocka_unit_test(TestPartsAreRefused),     cmocka_unit_test(TestPartsWithoutMemory),
        cmocka_unit_test(TestDropCrumbs),          cmocka_unit_test(TestCrumbsAreNotSampled),
        cmocka_unit_test(TestCrumbsOfDef),         cmocka_unit_test(TestConfettiHasAll),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
