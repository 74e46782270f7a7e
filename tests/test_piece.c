/* Pieces: lists, and detached sheets. */
#include "defaults.h"
#include "look.h"

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
    kiriSheetDef def = SheetOf(12 + (int32_t)(Random(seed) % 12), 3 + (int32_t)(Random(seed) % 5));
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
        kiriFrameState frame = World_FrameState(host->world, frames[i]);
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
        kiriPieceState state = World_PieceState(host->world, sheet, p);
        kiriPieceMesh piece = World_PieceMesh(host->world, sheet, p);
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

TEST(ListsOfConfetti)
{
    int32_t most = 0;
    for (uint32_t run = 1; run <= 12; ++run) {
        uint32_t seed = 77u * run;
        START_HOST(host);
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
    }
    assert_true(most > 40);
}

/* While a budget holds the work up, pieces are those of the model: they hang together as before. */
TEST(ListsWhileWorkWaits)
{
    uint32_t seed = 5;
    START_HOST(host);
    kiriSheetDef def = AnyDef(&seed);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 10, 10);
    kiriBudget budget = { 0, 40, 0, 0 };
    OK(kiriWorld_SetBudget(host.world, &budget));
    Shred(&host, sheet, 4, &seed);
    int32_t waits = 0;
    while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
        kiriCounts counts = Host_Counts(&host, sheet);
        kiriPieceState whole = World_PieceState(host.world, sheet, 0);
        assert_int_equal(counts.pieces, 1);
        assert_int_equal(whole.vertices, counts.vertices);
        assert_int_equal(whole.triangles, counts.triangles);
        ++waits;
    }
    assert_true(waits > 2);
    CheckPieces(&host, sheet);
}

/* Nothing is sorted again when nothing has changed; the arrays stay where they are. */
TEST(ListsAreLazy)
{
    uint32_t seed = 9;
    START_HOST(host);
    kiriSheetDef def = AnyDef(&seed);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 10, 10);
    Shred(&host, sheet, 4, &seed);
    Tick(&host, 1);
    kiriPieceMesh first = World_PieceMesh(host.world, sheet, 1);
    int64_t calls = host.calls;
    Tick(&host, 3);
    kiriPieceMesh again = World_PieceMesh(host.world, sheet, 1);
    assert_int_equal(host.calls, calls);
    assert_ptr_equal(first.vertices, again.vertices);
    assert_ptr_equal(first.indices, again.indices);
}

TEST(PieceErrors)
{
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 4);
    kiriPieceState piece;
    kiriPieceMesh mesh;
    const kiriFrame* frames;
    int32_t count;
    assert_int_equal(kiriSheet_GetPiece(host.world, sheet, 1, &piece), KIRI_ERROR_ARGUMENT);
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
}

/* The frame that the event names is in the piece, whatever the piece is numbered later. */
TEST(EventNamesFrame)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
    float loop[10] = { 0.4f, 0.4f, 0.62f, 0.4f, 0.62f, 0.62f, 0.4f, 0.62f, 0.4f, 0.4f };
    Host_Cut(&host, sheet, loop, 5);
    Tick(&host, 1);
    kiriEvent event = { 0 };
    int32_t piece = -1;
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIECE_OFF, &event), 1);
    OK(kiriFrame_GetPiece(host.world, event.frame, &piece));
    kiriPieceState off = World_PieceState(host.world, sheet, piece);
    assert_float_equal(off.area, 0.22 * 0.22, 1e-6);
    assert_float_equal(off.area, event.area, 1e-7);
    assert_float_equal(off.mass, off.area * def.material.density * def.material.thickness, 1e-9);
    assert_float_equal(off.center[0], 0.51, 1e-4);
    assert_true(off.lower[0] > 0.39f && off.upper[1] < 0.63f);
}

/* ---- Sheets of their own ---- */

enum { MOST_VERTICES = 8192, MOST_FRAMES = 512, EACH = 31 /* triangles: the middle of one has its weights compared */ };

/* A part of a sheet: one piece, or all others. In the order of the sheet, as the part will have it. */
typedef struct Part {
    int32_t vertexCount, triangleCount, frameCount, vertex[MOST_VERTICES]; /* of each: its index in the sheet */
    float rest[2 * MOST_VERTICES], x[3 * MOST_VERTICES], shares[3 * MOST_VERTICES];
    int32_t source[MOST_VERTICES], indices[6 * MOST_VERTICES];
    kiriFrame frames[MOST_FRAMES];
    kiriFrameState states[MOST_FRAMES];
    uint64_t weights; /* hash */
} Part;

static uint64_t HashWeights(const Host* host, kiriSheet sheet, const float* rest, const int32_t* indices, int32_t count)
{
    uint64_t hash = 0;
    for (int32_t t = 0; t < count; t += EACH) {
        kiriFrame frames[64];
        float weights[64], gradients[128], middle[2] = { 0.0f, 0.0f };
        int32_t n;
        for (int k = 0; k < 6; ++k) {
            middle[k % 2] += rest[2 * indices[3 * t + k / 2] + k % 2] / 3.0f;
        }
        OK(kiriSheet_GetWeights(host->world, sheet, middle, frames, weights, gradients, 64, &n));
        assert_in_range(n, 1, 64);
        hash = Look_Bytes(hash, frames, sizeof(kiriFrame) * (size_t)n);
        hash = Look_Bytes(hash, weights, sizeof(float) * (size_t)n);
        hash = Look_Bytes(hash, gradients, 2 * sizeof(float) * (size_t)n);
    }
    return hash;
}

static void Part_Take(Part* part, Host* host, kiriSheet sheet, int32_t piece, bool isRest)
{
    static int32_t to[MOST_VERTICES];
    kiriMesh mesh = Host_Mesh(host, sheet);
    kiriPieceMesh its = World_PieceMesh(host->world, sheet, piece);
    kiriFrame frames[MOST_FRAMES];
    int32_t of;
    assert_true(mesh.vertexCount <= MOST_VERTICES && mesh.triangleCount <= 2 * MOST_VERTICES);
    part->vertexCount = part->triangleCount = part->frameCount = 0;
    for (int32_t v = 0, k = 0; v < mesh.vertexCount; ++v) {
        bool isIts = k < its.vertexCount && its.vertices[k] == v;
        int32_t n = part->vertexCount;
        k += isIts;
        to[v] = isIts != isRest ? n : -1;
        if (to[v] >= 0) {
            part->vertex[n] = v;
            memcpy(&part->rest[2 * n], &mesh.restPositions[2 * v], 2 * sizeof(float));
            memcpy(&part->x[3 * n], &mesh.positions[3 * v], 3 * sizeof(float));
            memcpy(&part->shares[3 * n], &mesh.sourceWeights[3 * v], 3 * sizeof(float));
            part->source[n] = mesh.sourceTriangles[v];
            part->vertexCount = n + 1;
        }
    }
    for (int32_t k = 0; k < 3 * mesh.triangleCount; ++k) {
        if (to[mesh.indices[k]] >= 0) {
            part->indices[3 * part->triangleCount + k % 3] = to[mesh.indices[k]];
            part->triangleCount += k % 3 == 2;
        }
    }
    int32_t count = World_GetFrames(host->world, sheet, frames, MOST_FRAMES);
    assert_in_range(count, 1, MOST_FRAMES);
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_GetPiece(host->world, frames[i], &of));
        if ((of == piece) != isRest) {
            part->frames[part->frameCount] = frames[i];
            OK(kiriFrame_GetState(host->world, frames[i], &part->states[part->frameCount++]));
        }
    }
    part->weights = HashWeights(host, sheet, part->rest, part->indices, part->triangleCount);
}

/* The sheet has the vertices, triangles, frames and weights of the part. It is seen where it was to rounding. */
static void Part_Check(const Part* part, Host* host, kiriSheet sheet)
{
    size_t vertices = (size_t)part->vertexCount;
    kiriMesh mesh = Host_Mesh(host, sheet);
    kiriFrame frames[MOST_FRAMES];
    assert_int_equal(mesh.vertexCount, part->vertexCount);
    assert_int_equal(mesh.triangleCount, part->triangleCount);
    assert_memory_equal(mesh.restPositions, part->rest, 2 * sizeof(float) * vertices);
    assert_memory_equal(mesh.sourceWeights, part->shares, 3 * sizeof(float) * vertices);
    assert_memory_equal(mesh.sourceTriangles, part->source, sizeof(int32_t) * vertices);
    assert_memory_equal(mesh.indices, part->indices, 3 * sizeof(int32_t) * (size_t)part->triangleCount);
    for (int32_t k = 0; k < 3 * part->vertexCount; ++k) {
        assert_float_equal(mesh.positions[k], part->x[k], 1e-6);
    }
    int32_t count = World_GetFrames(host->world, sheet, frames, MOST_FRAMES);
    assert_int_equal(count, part->frameCount);
    assert_memory_equal(frames, part->frames, sizeof(kiriFrame) * (size_t)count);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState is = World_FrameState(host->world, frames[i]);
        assert_memory_equal(&is, &part->states[i], sizeof(is));
    }
    assert_true(HashWeights(host, sheet, mesh.restPositions, mesh.indices, mesh.triangleCount) == part->weights);
    CheckPieces(host, sheet);
}

/* Area, mass, energy and momentum of both are those of the one before. */
static void CheckSum(Host* host, const kiriTotals* was, kiriSheet a, kiriSheet b)
{
    kiriTotals x = Host_Totals(host, a), y = Host_Totals(host, b);
    double speed = sqrt(2.0 * was->kineticEnergy * was->mass) + 1e-300;
    assert_true(IsNear(x.area + y.area, was->area, 0.0) && IsNear(x.mass + y.mass, was->mass, 0.0));
    assert_true(IsNear(x.kineticEnergy + y.kineticEnergy, was->kineticEnergy, 0.0));
    assert_true(IsNear(x.elasticEnergy + y.elasticEnergy, was->elasticEnergy, 0.0));
    for (int k = 0; k < 3; ++k) {
        assert_true(IsNear(x.momentum[k] + y.momentum[k], was->momentum[k], speed));
        assert_true(IsNear(x.angularMomentum[k] + y.angularMomentum[k], was->angularMomentum[k], speed));
    }
}

/* Pins in two corners, held frames and contacts: all that a sheet can have. */
static kiriSheet Furnish(Host* host, kiriSheetDef* def, int32_t lines, uint32_t* seed)
{
    kiriSheet sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, 10, 10);
    for (int i = 0; i < 4; ++i) {
        float u = i % 2 == 0 ? 0.0f : 0.97f, v = i / 2 == 0 ? 0.01f : 1.0f;
        Host_Pin(host, sheet, u, v, u, v, 0.0f);
    }
    Shred(host, sheet, lines, seed);
    Tick(host, 5);
    return sheet;
}

TEST(PartsAreWhatTheyWere)
{
    static Part own, rest;
    for (uint32_t run = 1; run <= 12; ++run) {
        uint32_t seed = 191u * run;
        START_HOST(host);
        kiriSheetDef def = AnyDef(&seed);
        def.skinning = (int32_t)(run % 2);
        kiriSheet sheet = Furnish(&host, &def, 4, &seed);
        for (int pass = 0; pass < 4; ++pass) {
            Tick(&host, 1);
            int32_t pieces = Host_Counts(&host, sheet).pieces;
            int32_t piece = (int32_t)(Random(&seed) % (uint32_t)pieces);
            uint32_t revision = Host_Mesh(&host, sheet).revision;
            kiriTotals totals = Host_Totals(&host, sheet);
            kiriDirty dirty;
            Part_Take(&own, &host, sheet, piece, false);
            Part_Take(&rest, &host, sheet, piece, true);
            kiriSheet detached = World_Detach(host.world, Host_FrameOf(&host, sheet, piece));
            assert_true(Host_Mesh(&host, sheet).revision > revision);
            OK(kiriSheet_GetDirty(host.world, sheet, revision, &dirty));
            assert_int_equal(dirty.newVertices.first, 0);
            assert_int_equal(dirty.newTriangles.count, Host_Counts(&host, sheet).triangles);
            assert_int_equal(Host_Counts(&host, detached).pieces, 1);
            assert_int_equal(Host_Counts(&host, sheet).pieces, pieces - 1);
            Part_Check(&own, &host, detached);
            Part_Check(&rest, &host, sheet);
            CheckSum(&host, &totals, sheet, detached);
        }
        Shred(&host, sheet, 2, &seed); /* cutting goes on */
        Tick(&host, 3);
        CheckPieces(&host, sheet);
    }
}

/* The farthest that a vertex of the part is from where it is in the sheet that was not taken apart. */
static double Gap(const Host hosts[2], kiriSheet whole, kiriSheet sheet, const Part* part)
{
    kiriMesh a = Host_Mesh(&hosts[0], whole), b = Host_Mesh(&hosts[1], sheet);
    double most = 0.0;
    for (int32_t k = 0; k < 3 * part->vertexCount; ++k) {
        most = fmax(most, fabs((double)a.positions[3 * part->vertex[k / 3] + k % 3] - b.positions[k]));
    }
    return most;
}

/* The same scene twice, with pieces detached in one of them, in the middle of a fade. Returns how far vertices are from
   each other a second later. */
static double RunTwice(const kiriSheetDef* def, uint32_t seed, int32_t detach)
{
    static const float gentle[3] = { 0.2f, 0.0f, -1.0f }; /* in 16 iterations each step converges */
    static Part taken[8], rest;
    HOST_PAIR(hosts);
    kiriSheet sheets[2], parts[8];
    for (int h = 0; h < 2; ++h) {
        uint32_t own = seed;
        kiriSheetDef copy = *def;
        Host_Start(&hosts[h]);
        OK(kiriWorld_SetGravity(hosts[h].world, gentle));
        sheets[h] = Furnish(&hosts[h], &copy, 3, &own);
        Tick(&hosts[h], 15);
        Shred(&hosts[h], sheets[h], 0, &own);
        Tick(&hosts[h], 1);
    }
    int32_t pieces = Host_Counts(&hosts[0], sheets[0]).pieces;
    double gap = 0.0;
    assert_true(detach < pieces && detach < 8);
    for (int32_t k = 0; k < detach; ++k) {
        int32_t piece = pieces - 1 - k;
        Part_Take(&taken[k], &hosts[0], sheets[0], piece, false);
        Part_Take(&rest, &hosts[0], sheets[0], piece, true);
        OK(kiriFrame_DetachPiece(hosts[1].world, Host_FrameOf(&hosts[1], sheets[1], piece), &parts[k]));
    }
    for (int32_t tick = 0; tick < 60; ++tick) {
        Tick(&hosts[0], 1);
        Tick(&hosts[1], 1);
    }
    for (int32_t k = 0; k < detach; ++k) {
        gap = fmax(gap, Gap(hosts, sheets[0], parts[k], &taken[k]));
    }
    gap = detach == 1 ? fmax(gap, Gap(hosts, sheets[0], sheets[1], &rest)) : gap;
    return gap;
}

TEST(MotionGoesOn)
{
    for (uint32_t run = 1; run <= RUNS(12); ++run) {
        uint32_t seed = 401u * run;
        kiriSheetDef def = AnyDef(&seed);
        def.velocity[0] = 0.3f;
        def.material.youngsModulus = 1e6f;
        def.material.detail = 0; /* the order of its sweeps follows the indices of triangles */
        def.iterations = 16;
        def.model = (int32_t)(run % 3);
        assert_true(RunTwice(&def, seed, run % 2 == 0 ? 1 : 4) < 1e-6);
    }
}

/* ---- What else can happen to parts ---- */

/* A sheet in four strips: 0 is the lowest frame's, and so on. */
static kiriSheet Strips(Host* host, int32_t count)
{
    kiriSheetDef def = SheetOf(16, 6);
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
    int32_t found = -1;
    for (int32_t p = 0; p < Host_Counts(host, sheet).pieces; ++p) {
        kiriPieceMesh mesh = World_PieceMesh(host->world, sheet, p);
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
TEST(CutsStayWithTheRest)
{
    for (int kept = 0; kept < 2; ++kept) {
        START_HOST(host);
        kiriSheet sheet = Strips(&host, 3), detached = 0;
        float start[2] = { 0.5f, 0.1f }, inside[2] = { 0.5f, 0.2f }, on[4] = { 0.53f, 0.3f, 0.5f, 1.1f };
        kiriCut cut = World_BeginCut(host.world, sheet, start);
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
    }
}

/* The blade stands in the rest, on a vertex that gets another number. */
TEST(BladeOfTheRestGoesOn)
{
    uint64_t areas = 0;
    double most[2] = { 0.0, 0.0 };
    for (int detach = 0; detach < 2; ++detach) {
        START_HOST(host);
        kiriSheet sheet = Strips(&host, 3), detached = 0;
        float start[2] = { 0.31f, 0.8f }, inside[2] = { 0.42f, 0.85f }, on[4] = { 0.6f, 0.9f, 0.55f, 1.1f };
        kiriCut cut = World_BeginCut(host.world, sheet, start);
        OK(kiriCut_Extend(host.world, cut, inside, 1));
        Tick(&host, 1);
        if (detach) {
            OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, PieceAt(&host, sheet, 0.1)), &detached));
        }
        OK(kiriCut_Extend(host.world, cut, on, 2));
        OK(kiriCut_End(host.world, cut));
        Tick(&host, 1);
        kiriPieceMesh mesh = World_PieceMesh(host.world, sheet, PieceAt(&host, sheet, 0.8));
        most[detach] = mesh.triangleCount;
        areas += (uint64_t)mesh.vertexCount;
    }
    assert_true(most[0] == most[1] && areas % 2 == 0);
}

TEST(IdsMoveAlong)
{
    START_HOST(host);
    kiriSheet sheet = Strips(&host, 3), detached;
    kiriPin pins[3];
    for (int i = 0; i < 3; ++i) {
        float v = 0.2f + 0.3f * (float)i;
        pins[i] = Host_Pin(&host, sheet, 0.5f, v, 0.5f, v, 0.0f);
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
    OK(kiriPin_SetTarget(host.world, pins[0], target));
    assert_int_equal(kiriPin_SetTarget(host.world, pins[1], target), KIRI_ERROR_ID);
    OK(kiriPin_SetTarget(host.world, pins[2], target));
    kiriFrameState frame = World_FrameState(host.world, frames[0]);
    assert_int_equal(kiriFrame_GetState(host.world, frames[1], &frame), KIRI_ERROR_ID);
    OK(kiriFrame_GetState(host.world, frames[2], &frame));
    Tick(&host, 2);
    OK(kiriDestroyPin(host.world, pins[0]));
    OK(kiriDestroyPin(host.world, pins[2]));
    OK(kiriDestroySheet(host.world, sheet));
    OK(kiriFrame_GetState(host.world, frames[0], &frame));
    assert_int_equal(kiriFrame_GetState(host.world, frames[2], &frame), KIRI_ERROR_ID);
    OK(kiriDestroySheet(host.world, detached));
}

/* Contacts that wait push the part that has the point. */
TEST(ContactsMoveAlong)
{
    START_HOST(host);
    World_StopGravity(host.world);
    kiriSheet sheet = Strips(&host, 2), detached;
    int32_t piece = PieceAt(&host, sheet, 0.8);
    kiriContact contact = { .point = World_PieceMesh(host.world, sheet, piece).collisionPoints[0],
                            .normal = { 0.0f, 0.0f, 1.0f },
                            .offset = 0.1f };
    OK(kiriSheet_SetContacts(host.world, sheet, &contact, 1));
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, piece), &detached));
    Tick(&host, 1);
    assert_true(Host_Totals(&host, detached).momentum[2] > 1e-3);
    assert_true(fabs(Host_Totals(&host, sheet).momentum[2]) < 1e-12);
}

TEST(PartsAreRefused)
{
    START_HOST(host);
    kiriSheet sheet = Strips(&host, 2), detached = 1;
    int32_t count;
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
}

/* ---- Crumbs ---- */

TEST(DropCrumbs)
{
    for (uint32_t run = 1; run <= 6; ++run) {
        uint32_t seed = 1009u * run;
        START_HOST(host);
        kiriSheetDef def = AnyDef(&seed);
        kiriSheet sheet = Furnish(&host, &def, 8, &seed);
        double kept = 0.0, largest = 0.0;
        int32_t below = 0, count, pieces = Host_Counts(&host, sheet).pieces;
        float limit = (float)RandomBetween(&seed, 0.01, run == 1 ? 1.0 : 0.05);
        for (int32_t p = 0; p < pieces; ++p) {
            double area = World_PieceState(host.world, sheet, p).area;
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
    }
}

/* Strips of several areas come off: those that are crumbs keep to one frame. */
TEST(CrumbsAreNotSampled)
{
    int32_t frames[2] = { 0, 0 }, crumbs[2] = { 0, 0 };
    for (int with = 0; with < 2; ++with) {
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
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
            kiriPieceState piece = World_PieceState(host.world, sheet, p);
            assert_int_equal(piece.crumb, with && piece.area < 0.05);
            crumbs[with] += piece.area < 0.05;
            frames[with] += piece.area < 0.05 ? piece.frames : 0;
        }
        CheckPieces(&host, sheet);
    }
    assert_true(crumbs[0] == crumbs[1] && crumbs[0] > 20);
    assert_true(frames[0] > crumbs[0] + 5 && frames[1] < frames[0]);
}

/* All parts of a def that are crumbs have one frame from the start. */
TEST(CrumbsOfDef)
{
    static const float positions[16] = { 0, 0, 0.2f, 0, 0.2f, 0.2f, 0, 0.2f, 0.5f, 0, 1.5f, 0, 1.5f, 1, 0.5f, 1 };
    static const int32_t indices[12] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = 8;
    def.triangleCount = 4;
    def.frameCount = 100;
    for (int with = 0; with < 2; ++with) {
        def.crumbArea = with ? 0.1f : 0.0f;
        kiriSheet sheet = World_AddSheet(host.world, &def);
        int32_t small = World_PieceState(host.world, sheet, 0).area < 0.1 ? 0 : 1;
        assert_true(with ? World_PieceState(host.world, sheet, small).frames == 1
                         : World_PieceState(host.world, sheet, small).frames > 1);
    }
}
