/* Meshes for a sheet, good ones and bad ones; what is taken is cut, and moved for a while. */
#include "fuzz_world.h"

#include "core/kiri_vec.h"
#include "world/kiri_world.h"

enum { MOST_VERTICES = 100, MOST_TRIANGLES = 140, COLUMNS = 8 };

typedef struct FuzzMesh {
    FuzzBytes bytes;
    float positions[2 * MOST_VERTICES];
    int32_t indices[3 * MOST_TRIANGLES];
    int32_t vertexCount, triangleCount;
    kiriSheetDef def;
} FuzzMesh;

/* ---- Meshes ---- */

static void AddTriangle(FuzzMesh* m, int32_t a, int32_t b, int32_t c)
{
    if (m->triangleCount < MOST_TRIANGLES) {
        int32_t* corners = &m->indices[3 * m->triangleCount++];
        corners[0] = a;
        corners[1] = b;
        corners[2] = c;
    }
}

static int32_t AddVertex(FuzzMesh* m, float u, float v)
{
    if (m->vertexCount < MOST_VERTICES) {
        m->positions[2 * m->vertexCount] = u;
        m->positions[2 * m->vertexCount + 1] = v;
        m->vertexCount += 1;
    }
    return m->vertexCount - 1;
}

static void MakeAnything(FuzzMesh* m)
{
    int32_t vertices = FuzzBytes_Below(&m->bytes, 20), triangles = FuzzBytes_Below(&m->bytes, 20);
    for (int32_t i = 0; i < vertices; ++i) {
        float u = FuzzBytes_Float(&m->bytes, 0.0f, 1.0f);
        AddVertex(m, u, FuzzBytes_Float(&m->bytes, 0.0f, 1.0f));
    }
    for (int32_t t = 0; t < triangles; ++t) {
        int32_t a = FuzzBytes_Int(&m->bytes, 0, 19), b = FuzzBytes_Int(&m->bytes, 0, 19);
        AddTriangle(m, a, b, FuzzBytes_Int(&m->bytes, 0, 19));
    }
}

static void MakeRectangle(FuzzMesh* m, int32_t columns, int32_t rows)
{
    OK(kiriFillRectangle(1.0f, (float)rows / (float)columns, columns, rows, m->positions, m->indices));
    m->vertexCount = (columns + 1) * (rows + 1);
    m->triangleCount = 2 * columns * rows;
}

/* Around a hub, at distances that differ; a gap, or a turn too much. */
static void MakeFan(FuzzMesh* m)
{
    static const float round[16] = { 1.0f,  0.0f, 0.7f,  0.7f,  0.0f, 1.0f,  -0.7f, 0.7f,
                                     -1.0f, 0.0f, -0.7f, -0.7f, 0.0f, -1.0f, 0.7f,  -0.7f };
    int32_t spokes = 3 + FuzzBytes_Below(&m->bytes, 8), hub = AddVertex(m, 0.0f, 0.0f), last = KIRI_NONE;
    for (int32_t i = 0; i < spokes; ++i) {
        float far = FuzzBytes_Float(&m->bytes, 1e-6f, 1.0f);
        int32_t spoke = AddVertex(m, far * round[2 * (i % 8)], far * round[2 * (i % 8) + 1]);
        if (last != KIRI_NONE) {
            AddTriangle(m, hub, last, spoke);
        }
        last = spoke;
    }
    if (spokes >= 8 && FuzzBytes_Below(&m->bytes, 2) == 0) {
        AddTriangle(m, hub, last, hub + 1);
    }
}

/* Each triangle with vertices of its own: all edges are lips. */
static void MakeSoup(FuzzMesh* m)
{
    FuzzMesh whole;
    int32_t columns = 1 + FuzzBytes_Below(&m->bytes, 4);
    memset(&whole, 0, sizeof(whole));
    MakeRectangle(&whole, columns, 1 + FuzzBytes_Below(&m->bytes, 3));
    for (int32_t h = 0; h < 3 * whole.triangleCount; ++h) {
        int32_t v = whole.indices[h];
        m->indices[h] = AddVertex(m, whole.positions[2 * v], whole.positions[2 * v + 1]);
    }
    m->triangleCount = whole.triangleCount;
}

/* ---- Changes to them ---- */

static void MoveVertex(FuzzMesh* m)
{
    float* at = &m->positions[2 * FuzzBytes_Below(&m->bytes, m->vertexCount)];
    int32_t axis = FuzzBytes_Below(&m->bytes, 2), other = FuzzBytes_Below(&m->bytes, m->vertexCount);
    if (FuzzBytes_Below(&m->bytes, 4) == 0) { /* onto another, or nearly so */
        memcpy(at, &m->positions[2 * other], 2 * sizeof(float));
    }
    m->bytes.last = at[axis];
    at[axis] = FuzzBytes_Float(&m->bytes, at[axis] - 0.1f, at[axis] + 0.1f);
}

static void ChangeTriangle(FuzzMesh* m)
{
    int32_t* corners = &m->indices[3 * FuzzBytes_Below(&m->bytes, m->triangleCount)];
    const int32_t* last = &m->indices[3 * (m->triangleCount - 1)];
    int32_t k = FuzzBytes_Below(&m->bytes, 3), corner = corners[k];
    switch (FuzzBytes_Below(&m->bytes, 5)) {
    case 0: /* gone */
        memmove(corners, last, 3 * sizeof(int32_t));
        m->triangleCount -= m->triangleCount > 1;
        break;
    case 1: /* turned around */
        corners[k] = corners[(k + 1) % 3];
        corners[(k + 1) % 3] = corner;
        break;
    case 2: /* twice */
        AddTriangle(m, corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
        break;
    case 3: /* torn */
        corners[k] = AddVertex(m, m->positions[2 * corner], m->positions[2 * corner + 1]);
        break;
    default:
        corners[k] = FuzzBytes_Int(&m->bytes, 0, m->vertexCount - 1);
        break;
    }
}

/* All of it: tiny, large, far from the origin, thin. */
static void ScaleAll(FuzzMesh* m)
{
    static const float scales[8] = { 1e-3f, 1e3f, 1e-20f, 1e19f, 1e38f, 1e-38f, 3e-6f, 1e6f };
    int32_t kind = FuzzBytes_Below(&m->bytes, 4);
    float by = scales[FuzzBytes_Below(&m->bytes, 8)];
    for (int32_t i = 0; i < 2 * m->vertexCount; ++i) {
        if (kind < 3) {
            m->positions[i] *= kind == 0 || i % 2 == kind - 1 ? by : 1.0f;
        } else {
            m->positions[i] += by;
        }
    }
}

static void Change(FuzzMesh* m)
{
    int32_t kind = FuzzBytes_Below(&m->bytes, 12);
    if (m->vertexCount == 0 || m->triangleCount == 0) {
        return;
    }
    if (kind < 7) {
        MoveVertex(m);
    } else if (kind < 11) {
        bool fits = true;
        for (int32_t h = 0; h < 3 * m->triangleCount; ++h) {
            fits = fits && m->indices[h] >= 0 && m->indices[h] < m->vertexCount;
        }
        if (fits) {
            ChangeTriangle(m);
        }
    } else {
        ScaleAll(m);
    }
}

static void Describe(FuzzMesh* m)
{
    kiriSheetDef* def = &m->def;
    kiriDefaultSheetDef(def);
    uint32_t kind = FuzzBytes_Get(&m->bytes);
    def->restPositions = kind == 255 ? NULL : m->positions;
    def->indices = kind == 254 ? NULL : m->indices;
    def->vertexCount = kind == 253 ? FuzzBytes_Int(&m->bytes, -1, 2) : m->vertexCount;
    def->triangleCount = kind == 252 ? FuzzBytes_Int(&m->bytes, -1, 2) : m->triangleCount;
    def->vertexCount = def->vertexCount > MOST_VERTICES ? MOST_VERTICES : def->vertexCount;
    def->triangleCount = def->triangleCount > MOST_TRIANGLES ? MOST_TRIANGLES : def->triangleCount;
    def->gridResolution = 1 + (int32_t)kind % 24;
    def->frameCount = FuzzBytes_Below(&m->bytes, 6);
    def->maxFrames = 24;
    def->accuracy = 0.1f;
    def->collisionPoints = FuzzBytes_Below(&m->bytes, 12);
    def->model = FuzzBytes_Below(&m->bytes, 3);
    def->skinning = (int32_t)(kind >> 5) & 1;
    def->snapDistance = (kind & 64) != 0 ? FuzzBytes_Float(&m->bytes, 0.0f, 0.05f) : 0.0f;
}

static void ReadMesh(FuzzMesh* m, const uint8_t* data, size_t size)
{
    memset(m, 0, sizeof(*m));
    m->bytes.data = data;
    m->bytes.size = size;
    int32_t kind = FuzzBytes_Below(&m->bytes, 8);
    if (kind == 0) {
        MakeAnything(m);
    } else if (kind == 1) {
        MakeFan(m);
    } else if (kind == 2) {
        MakeSoup(m);
    } else {
        int32_t columns = 1 + FuzzBytes_Below(&m->bytes, COLUMNS);
        MakeRectangle(m, columns, 1 + FuzzBytes_Below(&m->bytes, COLUMNS));
    }
    for (int32_t i = FuzzBytes_Below(&m->bytes, 24); i > 0; --i) {
        Change(m);
    }
    Describe(m);
}

/* ---- What must hold ---- */

/* Two triangles apart have an edge with all of the other on its outer side, or on its line: but for steps of the
   lattice, for the input is in floats. */
static bool AreApart(const kiriLatticePoint a[3], const kiriLatticePoint b[3])
{
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint p = a[i], q = a[(i + 1) % 3];
        double length = fabs((double)q.x - p.x) + fabs((double)q.y - p.y);
        bool isOuter = true;
        for (int k = 0; k < 3; ++k) {
            isOuter = isOuter && (double)kiriOrient(p, q, b[k]) <= 65.0 * length;
        }
        if (isOuter) {
            return true;
        }
    }
    return false;
}

static void CheckOverlaps(const kiriMeshData* mesh)
{
    for (int32_t s = 0; s < mesh->triangles.count; ++s) {
        for (int32_t t = 0; t < s; ++t) {
            kiriLatticePoint a[3], b[3];
            kiriMesh_Corners(mesh, s, a);
            kiriMesh_Corners(mesh, t, b);
            FUZZ_CHECK(AreApart(a, b) || AreApart(b, a), "triangles %d and %d overlap", (int)t, (int)s);
        }
    }
}

static double AreaOfInput(const FuzzMesh* m)
{
    double sum = 0.0;
    for (int32_t t = 0; t < m->def.triangleCount; ++t) {
        const float* at[3];
        for (int k = 0; k < 3; ++k) {
            at[k] = &m->positions[2 * m->indices[3 * t + k]];
        }
        sum += 0.5 * (((double)at[1][0] - at[0][0]) * ((double)at[2][1] - at[0][1]) -
                      ((double)at[1][1] - at[0][1]) * ((double)at[2][0] - at[0][0]));
    }
    return sum;
}

/* Longer side of the box. */
static double ExtentOf(const FuzzMesh* m)
{
    double low[2] = { 1e300, 1e300 }, high[2] = { -1e300, -1e300 };
    for (int32_t i = 0; i < 2 * m->def.vertexCount; ++i) {
        low[i % 2] = fmin(low[i % 2], m->positions[i]);
        high[i % 2] = fmax(high[i % 2], m->positions[i]);
    }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

/* All places are rounded to the lattice once. */
static void CheckArea(const FuzzMesh* m, double area, double steps)
{
    double extent = ExtentOf(m), expected = AreaOfInput(m);
    FUZZ_CHECK(fabs(area - expected) <= steps * extent * extent, "an area of %.12g, not %.12g", area, expected);
}

static void CheckSeen(Host* host, kiriSheet sheet)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    FUZZ_CHECK(AllFinite(mesh.positions, 3 * mesh.vertexCount) && AllFinite(mesh.normals, 3 * mesh.vertexCount) &&
                   AllFinite(mesh.restPositions, 2 * mesh.vertexCount),
               "what is seen is not finite");
    Host_Validate(host);
}

/* ---- A run ---- */

static float PlaceIn(FuzzMesh* m, int axis)
{
    float low = m->positions[axis], high = low;
    for (int32_t i = 1; i < m->def.vertexCount; ++i) {
        low = fminf(low, m->positions[2 * i + axis]);
        high = fmaxf(high, m->positions[2 * i + axis]);
    }
    if (FuzzBytes_Below(&m->bytes, 4) == 0) {
        return m->positions[2 * FuzzBytes_Below(&m->bytes, m->def.vertexCount) + axis];
    }
    return FuzzBytes_Float(&m->bytes, low, high);
}

static void CutIt(FuzzMesh* m, Host* host, kiriSheet sheet)
{
    for (int32_t i = FuzzBytes_Below(&m->bytes, 5); i >= 0; --i) {
        kiriCut cut;
        float at[8];
        for (int k = 0; k < 8; ++k) {
            at[k] = PlaceIn(m, k % 2);
        }
        if (kiriBeginCut(host->world, sheet, at, &cut) == KIRI_OK) {
            (void)kiriCut_Extend(host->world, cut, at + 2, 1 + FuzzBytes_Below(&m->bytes, 3));
            OK(kiriCut_End(host->world, cut));
        }
    }
    kiriResult result = kiriWorld_Tick(host->world, 1.0f / 60.0f, 1);
    FUZZ_CHECK(result == KIRI_OK || result == KIRI_DIVERGED, "a tick gives %s", kiriGetResultName(result));
}

/* The same mesh, with vertices welded that are a part of its size apart: it is refused, or sound. */
static void WeldIt(FuzzMesh* m, Host* host, size_t size)
{
    static const float parts[] = { 1e-9f, 1e-4f, 0.02f, 0.3f };
    kiriSheet sheet;
    if (m->def.restPositions == NULL || m->def.vertexCount < 3) {
        return;
    }
    m->def.weldDistance = parts[size % 4] * (float)ExtentOf(m);
    if (kiriCreateSheet(host->world, &m->def, &sheet) == KIRI_OK) {
        CheckSeen(host, sheet);
        CheckOverlaps(&host->world->sheets.data[host->world->sheets.count - 1]->mesh);
        CutIt(m, host, sheet);
        CheckSeen(host, sheet);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    FuzzMesh m;
    kiriSheet sheet = 1;
    ReadMesh(&m, data, size);
    START_HOST(host);
    uint64_t hash = Host_Hash(&host);
    kiriResult result = kiriCreateSheet(host.world, &m.def, &sheet);
    if (result < 0) {
        FUZZ_CHECK(sheet == 0 && Host_Hash(&host) == hash, "a sheet is refused, and there");
        FUZZ_CHECK(kiriWorld_GetLastError(host.world)[0] != '\0', "a sheet is refused without a word");
    } else {
        CheckSeen(&host, sheet);
        CheckOverlaps(&host.world->sheets.data[0]->mesh);
        CheckArea(&m, Host_Totals(&host, sheet).area, 1e-8 * (double)m.def.triangleCount);
        for (int round = 0; round < 3; ++round) {
            CutIt(&m, &host, sheet);
            CheckSeen(&host, sheet);
            CheckArea(&m, Host_Totals(&host, sheet).area, 1e-6);
        }
    }
    WeldIt(&m, &host, size);
    Host_Destroy(&host);
    return 0;
}
