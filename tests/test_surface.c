/* The surface: skinning against sums of its own, what commits write, what hosts are told and copy, and bent patches. */
#include "view/kiri_surface.h"

#include "mesh/kiri_mesh.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Cloth {
    kiriMemory memory, room; /* room: of the surface */
    kiriMeshData mesh;
    kiriSkin skin;
    kiriSurface surface;
    KIRI_ARRAY(kiriFrameData) frames;
    KIRI_ARRAY(kiriLink) links;
} Cloth;

enum { SIDE = 12 };

/* SIDE squares of 1 / SIDE m along u. */
static void Cloth_Init(Cloth* cloth, int32_t rows)
{
    float positions[2 * (SIDE + 1) * (SIDE + 1)];
    int32_t indices[6 * SIDE * SIDE], count = 0;
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= SIDE; ++i) {
            positions[2 * (j * (SIDE + 1) + i)] = (float)i / SIDE;
            positions[2 * (j * (SIDE + 1) + i) + 1] = (float)j / SIDE;
        }
    }
    for (int32_t j = 0; j < rows; ++j) {
        for (int32_t i = 0; i < SIDE; ++i) {
            int32_t a = j * (SIDE + 1) + i, b = a + SIDE + 1;
            const int32_t corners[6] = { a, a + 1, b + 1, b, a, b + 1 };
            memcpy(indices + count, corners, sizeof(corners));
            count += 6;
        }
    }
    /* One triangle less, so that the last one has no partner. */
    memset(cloth, 0, sizeof(*cloth));
    cloth->memory = cloth->room = kiriMemory_Make(NULL, NULL, NULL);
    kiriFault why;
    if (kiriMesh_Init(&cloth->mesh, &cloth->memory,
                      &(kiriMeshInput){ positions, (SIDE + 1) * (rows + 1), indices, count / 3 - 1, 8, 0.0 },
                      &why) != KIRI_OK) {
        fail_msg("%s", why.line);
    }
}

static void Cloth_Release(Cloth* cloth)
{
    kiriMemory_FreeAll(&cloth->room);
    kiriArray_Release(&cloth->memory, &cloth->skin.spans);
    kiriArray_Release(&cloth->memory, &cloth->skin.weights);
    kiriArray_Release(&cloth->memory, &cloth->frames);
    kiriArray_Release(&cloth->memory, &cloth->links);
    kiriMemory_FreeAll(cloth->mesh.memory);
}

static kiriVec2 RestOf(const Cloth* cloth, int32_t v)
{
    return kiriMesh_Local(&cloth->mesh, cloth->mesh.vertices.data[v].at);
}

/* Adds a frame that lies flat. */
static kiriFrameData* AddFrame(Cloth* cloth, double u, double v)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.center = frame.site.at = kiriVec2_Make(u, v);
    frame.x = kiriVec3_Make(u, v, 0.0);
    frame.A.u.x = frame.A.v.y = frame.A.d.z = 1.0;
    assert_true(kiriArray_Push(&cloth->memory, &cloth->frames, frame));
    return &cloth->frames.data[cloth->frames.count - 1];
}

static void AddLink(Cloth* cloth, int32_t i, int32_t j, double width)
{
    kiriLink link;
    memset(&link, 0, sizeof(link));
    link.i = i;
    link.j = j;
    link.width = width;
    link.span = kiriVec2_Sub(cloth->frames.data[j].site.at, cloth->frames.data[i].site.at);
    assert_true(kiriArray_Push(&cloth->memory, &cloth->links, link));
}

/* The weights of one more vertex: eighth powers of inverse distances, so that near frames count. */
static void AddWeights(Cloth* cloth, kiriVec2 at)
{
    kiriSpan span = { 0, 0 };
    int32_t count = cloth->frames.count;
    assert_true(kiriSpan_Resize(&span, &cloth->skin.room, &cloth->memory, &cloth->skin.weights,
                                sizeof(kiriSampleWeight), count));
    double sum = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        kiriVec2 way = kiriVec2_Sub(at, cloth->frames.data[i].center);
        double square = kiriVec2_Dot(way, way) + 1e-6, weight = 1.0 / (square * square * square * square);
        cloth->skin.weights.data[span.first + i] = (kiriSampleWeight){ i, (float)weight };
        sum += weight;
    }
    double rest = 1.0; /* multiples of 2^-24 that add up to 1, as the library has them */
    for (int32_t i = count - 1; i >= 0; --i) {
        float* value = &cloth->skin.weights.data[span.first + i].value;
        *value = i > 0 ? (float)(floor(*value / sum * 16777216.0) / 16777216.0) : (float)rest;
        rest -= *value;
    }
    assert_true(kiriArray_Push(&cloth->memory, &cloth->skin.spans, span));
}

static void Write(Cloth* cloth)
{
    cloth->surface.wantsNormals = true;
    assert_true(kiriSurface_Reserve(&cloth->surface, &cloth->room, cloth->mesh.vertices.count,
                                    cloth->mesh.triangles.count, cloth->frames.count));
    kiriSurface_Resize(&cloth->surface, cloth->mesh.vertices.count, cloth->mesh.triangles.count, cloth->frames.count);
    kiriSurface_WriteTopology(&cloth->surface, &cloth->mesh);
    kiriMesh_Commit(&cloth->mesh);
    for (int32_t v = cloth->skin.spans.count; v < cloth->mesh.vertices.count; ++v) {
        AddWeights(cloth, RestOf(cloth, v));
    }
}

static void Pose(Cloth* cloth)
{
    kiriSurface_TakeFrames(&cloth->surface, cloth->frames.data, cloth->frames.count, cloth->links.data,
                           cloth->links.count, NULL, NULL);
    cloth->surface.isWritten = false;
    kiriSurface_BlendRange(&cloth->surface, &cloth->skin, 0, cloth->surface.vertexCount);
    kiriSurface_SumNormals(&cloth->surface);
    kiriSurface_WriteRange(&cloth->surface, 0, cloth->surface.vertexCount);
}

static void TurnAtRandom(kiriFrameData* frame, double away, uint32_t* seed)
{
    kiriVec3 turn, x;
    turn.x = RandomBetween(seed, -2.0, 2.0);
    turn.y = RandomBetween(seed, -2.0, 2.0);
    turn.z = RandomBetween(seed, -2.0, 2.0);
    x.x = away + RandomBetween(seed, -1.0, 1.0);
    x.y = RandomBetween(seed, -1.0, 1.0);
    x.z = -away + RandomBetween(seed, -1.0, 1.0);
    frame->A = kiriMat3_Cayley(turn);
    frame->x = x;
}

static void AssertNear(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
    }
}

static void AssertClose(kiriVec3 a, kiriVec3 b, double tolerance)
{
    AssertNear(a.x, b.x, tolerance);
    AssertNear(a.y, b.y, tolerance);
    AssertNear(a.z, b.z, tolerance);
}

/* Opens edges at random and splits triangles and edges, as cuts do. */
static void Cut(Cloth* cloth, int32_t count, uint32_t* seed)
{
    kiriMeshData* mesh = &cloth->mesh;
    for (int32_t k = 0; k < count; ++k) {
        int32_t h = (int32_t)(Random(seed) % (uint32_t)(3 * mesh->triangles.count));
        kiriLatticePoint c[3], middle = { 0, 0 };
        kiriMesh_Corners(mesh, h / 3, c);
        middle.x = (c[0].x / 6 + c[1].x / 6 + c[2].x / 6) * 2;
        middle.y = (c[0].y / 6 + c[1].y / 6 + c[2].y / 6) * 2;
        if (k % 3 == 0 && kiriMesh_CanSplitTriangle(mesh, h / 3, middle)) {
            assert_int_not_equal(kiriMesh_SplitTriangle(mesh, h / 3, middle), KIRI_NONE);
        }
        kiriLatticePoint half = { (c[h % 3].x / 4 + c[(h + 1) % 3].x / 4) * 2,
                                  (c[h % 3].y / 4 + c[(h + 1) % 3].y / 4) * 2 };
        if (k % 3 == 1 && kiriMesh_CanSplitEdge(mesh, h, half)) {
            assert_int_not_equal(kiriMesh_SplitEdge(mesh, h, half), KIRI_NONE);
        }
        assert_true(kiriMesh_Open(mesh, h));
    }
}

/* ---- Skinning ---- */

/* Equation 1 of the paper, written out. */
static void CheckPositions(const Cloth* cloth, double away)
{
    for (int32_t v = 0; v < cloth->mesh.vertices.count; ++v) {
        kiriVec3 sum = { 0.0, 0.0, 0.0 };
        for (int32_t i = 0; i < cloth->skin.spans.data[v].count; ++i) {
            kiriSampleWeight w = cloth->skin.weights.data[cloth->skin.spans.data[v].first + i];
            kiriVec3 carried = kiriFrame_Carry(&cloth->frames.data[w.frame], RestOf(cloth, v));
            sum = kiriVec3_AddScaled(sum, w.value, carried);
        }
        AssertClose(kiriSurface_At(&cloth->surface, v), sum, 2e-6);
        AssertClose(kiriVec3_Load(&cloth->surface.positions.data[3 * v]), sum, 1.2e-7 * (3.0 + away));
    }
}

/* From the mesh's own triangles, each vertex for itself. */
static void CheckNormals(const Cloth* cloth)
{
    for (int32_t v = 0; v < cloth->mesh.vertices.count; ++v) {
        kiriVec3 sum = { 0.0, 0.0, 0.0 };
        for (int32_t h = 0; h < 3 * cloth->mesh.triangles.count; ++h) {
            if (kiriMesh_Tail(&cloth->mesh, h) == v) {
                kiriVec3 a = kiriSurface_At(&cloth->surface, v);
                kiriVec3 b = kiriSurface_At(&cloth->surface, kiriMesh_Tail(&cloth->mesh, kiriEdge_Next(h)));
                kiriVec3 c = kiriSurface_At(&cloth->surface, kiriMesh_Tail(&cloth->mesh, kiriEdge_Previous(h)));
                sum = kiriVec3_Add(sum, kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(c, a)));
            }
        }
        AssertClose(kiriVec3_Load(&cloth->surface.normals.data[3 * v]), kiriVec3_Normalize(sum), 1e-4); /* slivers */
    }
}

static void SurfaceIsTheBlend(void** state)
{
    (void)state;
    static const double far[] = { 0.0, 1e5 };
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        uint32_t random = seed;
        Cloth cloth;
        Cloth_Init(&cloth, SIDE);
        for (int32_t i = 0; i < 5; ++i) {
            TurnAtRandom(AddFrame(&cloth, 0.2 * i, 0.1 * i), far[seed % 2], &random);
        }
        Write(&cloth);
        kiriMesh_Begin(&cloth.mesh);
        Cut(&cloth, 40, &random);
        Write(&cloth);
        Pose(&cloth);
        CheckPositions(&cloth, far[seed % 2]);
        CheckNormals(&cloth);
        Cloth_Release(&cloth);
    }
}

/* Sizes whose squares of areas no float holds, and a sheet without any area. */
static void NormalsKnowNoSize(void** state)
{
    (void)state;
    static const double sizes[] = { 1e-12, 1e-9, 1e-5, 1.0, 1e5, 1e9, 1e12 };
    for (size_t k = 0; k < sizeof(sizes) / sizeof(sizes[0]); ++k) {
        Cloth cloth;
        Cloth_Init(&cloth, SIDE);
        uint32_t seed = 7;
        kiriFrameData* frame = AddFrame(&cloth, 0.5, 0.5);
        TurnAtRandom(frame, 0.0, &seed);
        kiriVec3 normal = frame->A.d;
        frame->A.u = kiriVec3_Scale(sizes[k], frame->A.u);
        frame->A.v = kiriVec3_Scale(sizes[k], frame->A.v);
        frame->x = kiriVec3_Scale(sizes[k], frame->x);
        Write(&cloth);
        Pose(&cloth);
        for (int32_t v = 0; v < cloth.mesh.vertices.count; ++v) {
            AssertClose(kiriVec3_Load(&cloth.surface.normals.data[3 * v]), normal, 1e-5);
        }
        cloth.frames.data[0].A.u = cloth.frames.data[0].A.v = kiriVec3_Make(0.0, 0.0, 0.0);
        Pose(&cloth);
        AssertClose(kiriVec3_Load(cloth.surface.normals.data), kiriVec3_Make(0.0, 0.0, 1.0), 0.0);
        Cloth_Release(&cloth);
    }
}

/* ---- What a commit writes ---- */

/* A host's copy of the mesh. */
typedef struct Copy {
    int32_t* indices;
    int32_t* sources;
    float *rest, *shares;
    uint32_t revision;
} Copy;

static void Fetch(Copy* copy, const kiriSurface* s, kiriRange vertices, kiriRange triangles)
{
    if (vertices.count > 0) {
        size_t first = (size_t)vertices.first, count = (size_t)vertices.count;
        memcpy(copy->sources + first, s->sourceTriangles.data + first, sizeof(int32_t) * count);
        memcpy(copy->rest + 2 * first, s->restPositions.data + 2 * first, 2 * sizeof(float) * count);
        memcpy(copy->shares + 3 * first, s->sourceWeights.data + 3 * first, 3 * sizeof(float) * count);
    }
    if (triangles.count > 0) {
        size_t first = 3 * (size_t)triangles.first, count = 3 * (size_t)triangles.count;
        memcpy(copy->indices + first, s->indices.data + first, sizeof(int32_t) * count);
    }
}

static void Update(Copy* copy, const kiriSurface* s)
{
    kiriDirty dirty;
    kiriSurface_GetDirty(s, copy->revision, &dirty);
    assert_int_equal(dirty.newVertices.first + dirty.newVertices.count, s->vertexCount);
    assert_int_equal(dirty.newTriangles.first + dirty.newTriangles.count, s->triangleCount);
    assert_true(dirty.oldVertices.first + dirty.oldVertices.count <= dirty.newVertices.first);
    assert_true(dirty.oldTriangles.first + dirty.oldTriangles.count <= dirty.newTriangles.first);
    Fetch(copy, s, dirty.newVertices, dirty.newTriangles);
    Fetch(copy, s, dirty.oldVertices, dirty.oldTriangles);
    copy->revision = dirty.revision;
}

static void CheckCopy(const Copy* copy, const kiriMeshData* mesh)
{
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriVec2 rest = kiriVec2_Add(mesh->origin, kiriMesh_Local(mesh, mesh->vertices.data[v].at));
        assert_true(copy->rest[2 * v] == (float)rest.x && copy->rest[2 * v + 1] == (float)rest.y);
        assert_int_equal(copy->sources[v], mesh->vertices.data[v].source);
        float share[3];
        kiriMesh_GetShare(mesh, v, share);
        assert_memory_equal(&copy->shares[3 * v], share, sizeof(share));
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        assert_memory_equal(&copy->indices[3 * t], mesh->triangles.data[t].vertex, 3 * sizeof(int32_t));
    }
}

/* Each two triangles are turned as their corners are now. */
static void CheckTurns(const kiriSurface* s)
{
    assert_int_equal(s->turns.count, (s->triangleCount + 1) / 2);
    for (int32_t pair = 0; pair < s->turns.count; ++pair) {
        bool isAlone = 2 * pair + 1 == s->triangleCount;
        assert_int_equal(s->turns.data[pair], kiriNormals_TurnOf(&s->indices.data[6 * pair], isAlone));
    }
}

static void FillCopy(Copy* copy)
{
    enum { MOST = 8192 };
    copy->indices = calloc(3 * MOST, sizeof(int32_t));
    copy->sources = calloc(MOST, sizeof(int32_t));
    copy->rest = calloc(2 * MOST, sizeof(float));
    copy->shares = calloc(3 * MOST, sizeof(float));
    copy->revision = UINT32_MAX;
}

static void FreeCopy(Copy* copy)
{
    free(copy->indices);
    free(copy->sources);
    free(copy->rest);
    free(copy->shares);
}

typedef struct Purse {
    int32_t budget, out;
} Purse;

static void* PurseAlloc(void* user, int64_t bytes)
{
    Purse* purse = user;
    if (purse->budget == 0) {
        return NULL;
    }
    --purse->budget;
    ++purse->out;
    return malloc((size_t)bytes);
}

static void PurseFree(void* user, void* pointer)
{
    --((Purse*)user)->out;
    free(pointer);
}

/* Room that is refused leaves the surface as it was seen, and is there when it is asked for again. */
static void RoomMayBeRefused(void** state)
{
    (void)state;
    uint32_t seed = 3;
    Cloth cloth;
    Copy copy;
    Purse purse = { -1, 0 };
    Cloth_Init(&cloth, SIDE);
    cloth.room = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    FillCopy(&copy);
    AddFrame(&cloth, 0.5, 0.5);
    Write(&cloth);
    Pose(&cloth);
    Update(&copy, &cloth.surface);
    kiriMesh_Begin(&cloth.mesh);
    Cut(&cloth, 300, &seed);
    int32_t refused = 0;
    for (purse.budget = 0; !kiriSurface_Reserve(&cloth.surface, &cloth.room, cloth.mesh.vertices.count,
                                                cloth.mesh.triangles.count, 40);
         purse.budget = ++refused) {
        kiriRange vertices = { 0, cloth.surface.vertexCount }, triangles = { 0, cloth.surface.triangleCount };
        assert_int_equal(vertices.count, cloth.mesh.oldVertexCount);
        Fetch(&copy, &cloth.surface, vertices, triangles);
        Pose(&cloth);
    }
    assert_true(refused >= 3);
    purse.budget = -1;
    Write(&cloth);
    Pose(&cloth);
    Update(&copy, &cloth.surface);
    CheckCopy(&copy, &cloth.mesh);
    CheckNormals(&cloth);
    FreeCopy(&copy);
    Cloth_Release(&cloth);
    assert_int_equal(purse.out, 0);
}

/* Three hosts: one looks after each commit, one now and then, one so rarely that it is told to take all. */
static void HostsKeepUp(void** state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 5; ++seed) {
        static const int32_t every[3] = { 1, 7, 50 };
        uint32_t random = seed;
        Cloth cloth;
        Copy copies[3];
        Cloth_Init(&cloth, SIDE);
        AddFrame(&cloth, 0.5, 0.5);
        Write(&cloth);
        for (int k = 0; k < 3; ++k) {
            FillCopy(&copies[k]);
            Update(&copies[k], &cloth.surface);
            CheckCopy(&copies[k], &cloth.mesh);
        }
        for (int32_t commit = 1; commit <= 100; ++commit) {
            kiriMesh_Begin(&cloth.mesh);
            Cut(&cloth, commit % 4, &random);
            Write(&cloth);
            for (int k = 0; k < 3; ++k) {
                if (commit % every[k] == 0) {
                    Update(&copies[k], &cloth.surface);
                    CheckCopy(&copies[k], &cloth.mesh);
                }
            }
            CheckTurns(&cloth.surface);
        }
        for (int k = 0; k < 3; ++k) {
            FreeCopy(&copies[k]);
        }
        Cloth_Release(&cloth);
    }
}

/* A small cut is told in small ranges, none in none, and what is too long ago in all. */
static void RangesAreSmall(void** state)
{
    (void)state;
    Cloth cloth;
    kiriDirty dirty;
    Cloth_Init(&cloth, SIDE);
    AddFrame(&cloth, 0.5, 0.5);
    Write(&cloth);
    uint32_t first = cloth.surface.revision;
    int32_t vertices = cloth.mesh.vertices.count, triangles = cloth.mesh.triangles.count;
    kiriSurface_GetDirty(&cloth.surface, first, &dirty);
    assert_int_equal(dirty.newVertices.count + dirty.oldVertices.count + dirty.newTriangles.count, 0);
    assert_int_equal(dirty.oldTriangles.count, 0);
    for (int32_t k = 0; k <= KIRI_CHANGES; ++k) {
        kiriLatticePoint c[3], middle;
        kiriMesh_Begin(&cloth.mesh);
        kiriMesh_Corners(&cloth.mesh, 100 + k, c);
        middle.x = (c[0].x / 6 + c[1].x / 6 + c[2].x / 6) * 2;
        middle.y = (c[0].y / 6 + c[1].y / 6 + c[2].y / 6) * 2;
        assert_int_not_equal(kiriMesh_SplitTriangle(&cloth.mesh, 100 + k, middle), KIRI_NONE);
        Write(&cloth);
        kiriSurface_GetDirty(&cloth.surface, first, &dirty);
        bool told = k < KIRI_CHANGES;
        assert_int_equal(dirty.newVertices.first, told ? vertices : 0);
        assert_int_equal(dirty.newTriangles.first, told ? triangles : 0);
        assert_int_equal(dirty.oldTriangles.count, told ? k + 1 : 0);
        assert_int_equal(dirty.oldVertices.count, 0);
    }
    assert_int_equal(dirty.newVertices.count, cloth.mesh.vertices.count);
    Cloth_Release(&cloth);
}

static void CopiesAreTheSame(void** state)
{
    (void)state;
    Cloth cloth;
    uint32_t seed = 5;
    Cloth_Init(&cloth, SIDE);
    TurnAtRandom(AddFrame(&cloth, 0.5, 0.5), 0.0, &seed);
    Write(&cloth);
    Pose(&cloth);
    enum { STRIDE = 9, FIRST = 3, COUNT = 20 };
    float vertices[STRIDE * COUNT];
    uint16_t indices[3 * COUNT];
    for (int i = 0; i < STRIDE * COUNT; ++i) {
        vertices[i] = -7.0f;
    }
    kiriSurface_CopyVertices(&cloth.surface, FIRST, COUNT, vertices + 1, STRIDE * sizeof(float), vertices + 5,
                             STRIDE * sizeof(float));
    for (int i = 0; i < COUNT; ++i) {
        const float* vertex = vertices + STRIDE * i;
        assert_memory_equal(vertex + 1, &cloth.surface.positions.data[3 * (FIRST + i)], 3 * sizeof(float));
        assert_memory_equal(vertex + 5, &cloth.surface.normals.data[3 * (FIRST + i)], 3 * sizeof(float));
        assert_true(vertex[0] == -7.0f && vertex[4] == -7.0f && vertex[8] == -7.0f);
    }
    kiriSurface_CopyVertices(&cloth.surface, 0, COUNT, NULL, 0, NULL, 0);
    assert_true(kiriSurface_CopyIndices16(&cloth.surface, FIRST, COUNT, indices));
    for (int i = 0; i < 3 * COUNT; ++i) {
        assert_int_equal(indices[i], cloth.surface.indices.data[3 * FIRST + i]);
    }
    cloth.surface.vertexCount = 65536;
    assert_false(kiriSurface_CopyIndices16(&cloth.surface, 0, 0, indices));
    Cloth_Release(&cloth);
}

/* ---- Bent patches ---- */

/* The sheet rolled around a cylinder, its axis turned from v, and stretched. */
typedef struct Roll {
    double radius, stretch, away;
} Roll;

static const double COSINE = 0.8, SINE = 0.6;

static void RollTo(const Roll* roll, kiriVec2 p, kiriVec3* x, kiriMat3* A)
{
    double along = COSINE * p.x + SINE * p.y, across = COSINE * p.y - SINE * p.x, s = roll->stretch;
    double angle = along / roll->radius, c = cos(angle), n = sin(angle);
    kiriVec3 t = kiriVec3_Make(s * c, 0.0, s * n);
    *x = kiriVec3_Make(roll->away + s * roll->radius * n, s * across, s * roll->radius * (1.0 - c));
    A->u = kiriVec3_Make(COSINE * t.x, -SINE * s, COSINE * t.z);
    A->v = kiriVec3_Make(SINE * t.x, COSINE * s, SINE * t.z);
    A->d = kiriVec3_Make(-n, 0.0, c);
}

/* A 4 x 4 grid of frames, a little off their places. */
static void InitRolled(Cloth* cloth, const Roll* roll, uint32_t seed)
{
    Cloth_Init(cloth, SIDE);
    for (int32_t i = 0; i < 16; ++i) {
        double u = (i % 4 + 0.5) / 4.0 + RandomBetween(&seed, -0.05, 0.05);
        double v = (i / 4 + 0.5) / 4.0 + RandomBetween(&seed, -0.05, 0.05);
        kiriFrameData* frame = AddFrame(cloth, u, v);
        frame->site.at.x += 0.01;
        RollTo(roll, frame->center, &frame->x, &frame->A);
    }
    for (int32_t i = 0; i < 16; ++i) {
        if (i % 4 < 3) {
            AddLink(cloth, i, i + 1, 0.25);
        }
        if (i < 12) {
            AddLink(cloth, i, i + 4, 0.3);
        }
    }
    Write(cloth);
}

/* The largest distance from the cylinder over its radius, and the largest angle between normals (as a sine),
   where triangles are all around. */
static void Measure(Cloth* cloth, const Roll* roll, int32_t skinning, double* away, double* leaning)
{
    cloth->surface.skinning = skinning;
    Pose(cloth);
    *away = *leaning = 0.0;
    for (int32_t v = 0; v < cloth->mesh.vertices.count; ++v) {
        kiriVec3 x, n = kiriVec3_Load(&cloth->surface.normals.data[3 * v]);
        kiriMat3 A;
        RollTo(roll, RestOf(cloth, v), &x, &A);
        double d =
            kiriVec3_Length(kiriVec3_Sub(kiriSurface_At(&cloth->surface, v), x)) / (roll->stretch * roll->radius);
        double lean = kiriVec3_Length(kiriVec3_Cross(n, A.d));
        *away = d > *away ? d : *away;
        bool isInner = fabs(RestOf(cloth, v).x - 0.5) < 0.45 && fabs(RestOf(cloth, v).y - 0.5) < 0.45;
        *leaning = isInner && lean > *leaning ? lean : *leaning;
    }
}

/* Frames every 5 to 30 degrees: a smooth surface is the cylinder, a linear one is not. */
static void ArcsAreRound(void** state)
{
    (void)state;
    static const Roll rolls[] = {
        { 3.0, 1.0, 0.0 }, { 1.0, 1.0, 0.0 }, { 0.5, 1.0, 1e4 }, { 0.5, 1.3, 0.0 }, { 0.5, 0.7, 0.0 }
    };
    for (size_t k = 0; k < sizeof(rolls) / sizeof(rolls[0]); ++k) {
        Cloth cloth;
        double flat, flatLean, round, roundLean;
        InitRolled(&cloth, &rolls[k], (uint32_t)k + 1);
        Measure(&cloth, &rolls[k], KIRI_SKINNING_LINEAR, &flat, &flatLean);
        Measure(&cloth, &rolls[k], KIRI_SKINNING_SMOOTH, &round, &roundLean);
        double angle = 0.5 / rolls[k].radius;
        if (!(round < 2e-3 * angle * angle && flat > 20.0 * round && flatLean > 4.0 * roundLean)) {
            fail_msg("radius %g stretch %g: %g %g away, %g %g leaning", rolls[k].radius, rolls[k].stretch, flat, round,
                     flatLean, roundLean);
        }
        Cloth_Release(&cloth);
    }
}

/* The rms of the angle by which a patch turns over a square region of that side. */
static double TurnOf(const kiriCarrier* c, double side)
{
    double square = c->uu * c->uu + 2.0 * c->uv * c->uv + c->vv * c->vv;
    return sqrt(square * side * side / 12.0 * 6.0 / c->six);
}

/* Frames every 14 degrees: patches bend as they tell. Every 72 or 140: no more than 0.2 rad. */
static void StrongBendsAreLimited(void** state)
{
    (void)state;
    static const double radii[] = { 1.0, 0.2, 0.1 };
    for (int k = 0; k < 6; ++k) {
        Roll roll = { radii[k / 2], k % 2 == 0 ? 1.0 : 1.3, 0.0 };
        Cloth cloth;
        InitRolled(&cloth, &roll, 3);
        for (int32_t i = 0; i < cloth.frames.count; ++i) {
            cloth.frames.data[i].mass = 1.0;
            cloth.frames.data[i].inertia[0] = cloth.frames.data[i].inertia[2] = 0.0625 / 12.0;
        }
        cloth.surface.skinning = KIRI_SKINNING_SMOOTH;
        Pose(&cloth);
        for (int32_t i = 0; i < cloth.frames.count; ++i) {
            double turn = TurnOf(&cloth.surface.carriers.data[i], 0.25);
            AssertNear(turn, k < 2 ? 0.25 / sqrt(12.0) : 0.2, k < 2 ? 1e-3 : 1e-12);
        }
        Cloth_Release(&cloth);
    }
}

/* Flat, in whatever place and stretched however, smooth is linear. */
static void FlatStaysFlat(void** state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 10; ++seed) {
        uint32_t random = seed;
        Roll roll = { 1.0, 1.0, 0.0 };
        Cloth cloth;
        kiriFrameData pose;
        InitRolled(&cloth, &roll, seed);
        memset(&pose, 0, sizeof(pose));
        TurnAtRandom(&pose, 0.0, &random);
        pose.A.u = kiriVec3_AddScaled(kiriVec3_Scale(1.4, pose.A.u), 0.3, pose.A.v);
        for (int32_t i = 0; i < cloth.frames.count; ++i) {
            cloth.frames.data[i].x = kiriFrame_Carry(&pose, cloth.frames.data[i].center);
            cloth.frames.data[i].A = pose.A;
        }
        cloth.surface.skinning = KIRI_SKINNING_SMOOTH;
        Pose(&cloth);
        for (int32_t v = 0; v < cloth.mesh.vertices.count; ++v) {
            AssertClose(kiriSurface_At(&cloth.surface, v), kiriFrame_Carry(&pose, RestOf(&cloth, v)), 1e-6);
        }
        CheckNormals(&cloth);
        Cloth_Release(&cloth);
    }
}

/* One row of frames tells nothing of bending across it: none is made up from frames that are a
   little off the row. */
static void RowsBendAlong(void** state)
{
    (void)state;
    Cloth cloth;
    Cloth_Init(&cloth, 2);
    for (int32_t i = 0; i < 5; ++i) {
        kiriFrameData* frame = AddFrame(&cloth, 0.1 + 0.2 * i, 1.0 / SIDE + (i % 2 ? 1e-4 : 0.0));
        double angle = frame->center.x / 0.6, tilt = i % 2 ? 1e-3 : 0.0;
        kiriVec3 d = kiriVec3_Make(-sin(angle), 0.0, cos(angle)), v = frame->A.v;
        frame->A.u = kiriVec3_Make(cos(angle), 0.0, sin(angle));
        frame->A.v = kiriVec3_AddScaled(kiriVec3_Scale(cos(tilt), v), -sin(tilt), d);
        frame->A.d = kiriVec3_AddScaled(kiriVec3_Scale(cos(tilt), d), sin(tilt), v);
        if (i > 0) {
            AddLink(&cloth, i - 1, i, 2.0 / SIDE);
        }
    }
    Write(&cloth);
    cloth.surface.skinning = KIRI_SKINNING_SMOOTH;
    Pose(&cloth);
    for (int32_t i = 0; i < 5; ++i) {
        const kiriCarrier* c = &cloth.surface.carriers.data[i];
        AssertNear(c->uu, 1.0 / 0.6, 0.02);
        AssertNear(c->uv, 0.0, 0.01);
        AssertNear(c->vv, 0.0, 0.01);
    }
    Cloth_Release(&cloth);
}

/* Frames at random, crushed, back to back: the surface stays finite and within reach of the patches, and vertices with
   the same weights at the same place stay together. */
static void WildFramesStayBounded(void** state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 40; ++seed) {
        uint32_t random = seed;
        Roll roll = { 1.0, 1.0, 0.0 };
        Cloth cloth;
        InitRolled(&cloth, &roll, seed);
        for (int32_t i = 0; i < cloth.frames.count; ++i) {
            kiriFrameData* frame = &cloth.frames.data[i];
            double crush = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 1e-6 : 1.0;
            TurnAtRandom(frame, 0.0, &random);
            frame->A.v = kiriVec3_Scale(crush, frame->A.v);
        }
        kiriMesh_Begin(&cloth.mesh);
        int32_t old = cloth.mesh.vertices.count;
        for (int32_t h = 0; h < 200; ++h) {
            assert_true(kiriMesh_Open(&cloth.mesh, h));
        }
        assert_true(cloth.mesh.vertices.count > old);
        cloth.surface.skinning = KIRI_SKINNING_SMOOTH;
        Write(&cloth);
        Pose(&cloth);
        for (int32_t v = 0; v < cloth.mesh.vertices.count; ++v) {
            kiriVec3 x = kiriSurface_At(&cloth.surface, v);
            assert_true(kiriVec3_Length(x) < 1.8 + 3.0 * 1.5);
            if (v >= old) {
                int32_t parent = cloth.mesh.births.data[v - old].parent[0];
                AssertClose(x, kiriSurface_At(&cloth.surface, parent), 0.0);
            }
        }
        Cloth_Release(&cloth);
    }
}

/* Frame 0 carries the vertices of the first row, and frame 1 all others. */
static void OnlyWhatChangedPatchesCarryMayMove(void** state)
{
    (void)state;
    Cloth cloth;
    Cloth_Init(&cloth, 2);
    AddFrame(&cloth, 0.5, 0.0);
    AddFrame(&cloth, 0.5, 0.1);
    Write(&cloth);
    int32_t row = SIDE + 1, count = cloth.mesh.vertices.count;
    for (int32_t v = 0; v < count; ++v) {
        kiriSpan* span = &cloth.skin.spans.data[v];
        *span = (kiriSpan){ span->first + (v < row ? 0 : 1), 1 };
        cloth.skin.weights.data[span->first].value = 1.0f;
    }
    const kiriPatches* patches = &cloth.surface.patches;
    Pose(&cloth);
    assert_true(kiriPatches_MayMove(patches, &cloth.skin, 0, row)); /* for the first time */
    Pose(&cloth);
    assert_false(kiriPatches_MayMove(patches, &cloth.skin, 0, count));
    cloth.frames.data[1].x.z += 0.01;
    Pose(&cloth);
    assert_false(kiriPatches_MayMove(patches, &cloth.skin, 0, row));
    assert_true(kiriPatches_MayMove(patches, &cloth.skin, 0, row + 1));
    assert_true(kiriPatches_MayMove(patches, &cloth.skin, count - 1, count));
    Pose(&cloth);
    cloth.frames.data[1].x.x += 1e4; /* places are measured from elsewhere */
    Pose(&cloth);
    assert_true(kiriPatches_MayMove(patches, &cloth.skin, 0, row));
    Cloth_Release(&cloth);
}

/* A frame that gets another center carries the same patch: sums of doubles are other in the last bits, which floats
   near 0 show. */
static void RoundedPatchesAreKnown(void** state)
{
    (void)state;
    Cloth cloth;
    Cloth_Init(&cloth, 2);
    AddFrame(&cloth, 0.5, 0.0);
    AddFrame(&cloth, 0.5, 0.1);
    Write(&cloth);
    const uint8_t* isOther = cloth.surface.patches.isOther.data;
    Pose(&cloth);
    assert_int_equal(isOther[1], KIRI_PATCH_OTHER); /* for the first time */
    cloth.frames.data[1].x.z = 0.0;
    Pose(&cloth);
    cloth.frames.data[1].x.z = 1e-17;
    Pose(&cloth);
    assert_int_equal(isOther[0], KIRI_PATCH_SAME);
    assert_int_equal(isOther[1], KIRI_PATCH_ROUNDED);
    cloth.frames.data[1].x.z = 1e-9;
    Pose(&cloth);
    assert_int_equal(isOther[1], KIRI_PATCH_OTHER);
    Pose(&cloth);
    assert_int_equal(isOther[1], KIRI_PATCH_SAME);
    Cloth_Release(&cloth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(RoundedPatchesAreKnown), cmocka_unit_test(SurfaceIsTheBlend),
        cmocka_unit_test(NormalsKnowNoSize),      cmocka_unit_test(HostsKeepUp),
        cmocka_unit_test(RangesAreSmall),         cmocka_unit_test(RoomMayBeRefused),
        cmocka_unit_test(CopiesAreTheSame),       cmocka_unit_test(ArcsAreRound),
        cmocka_unit_test(StrongBendsAreLimited),  cmocka_unit_test(OnlyWhatChangedPatchesCarryMayMove),
        cmocka_unit_test(FlatStaysFlat),          cmocka_unit_test(RowsBendAlong),
        cmocka_unit_test(WildFramesStayBounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
