#include "kiri_normal.h"

#include "../core/kiri_lanes.h"

#include <string.h>

/* ---- Two triangles ----------------------------------------------------------------------------------------------- */

/* Which of their six corners come in which order: as they are; turned by their edges j and k, which they share, from
   1 + 3 j + k on; one alone, followed by one without area. */
enum { PAIR_AS_IS, PAIR_TURNED, PAIR_ALONE = PAIR_TURNED + 9, PAIR_TURNS };
static const uint8_t pairOrders[PAIR_TURNS][6] = {
    { 0, 1, 2, 3, 4, 5 }, { 1, 2, 0, 3, 4, 5 }, { 1, 2, 0, 4, 5, 3 }, { 1, 2, 0, 5, 3, 4 },
    { 2, 0, 1, 3, 4, 5 }, { 2, 0, 1, 4, 5, 3 }, { 2, 0, 1, 5, 3, 4 }, { 0, 1, 2, 3, 4, 5 },
    { 0, 1, 2, 4, 5, 3 }, { 0, 1, 2, 5, 3, 4 }, { 0, 1, 2, 0, 0, 0 },
};

uint8_t kiriNormals_TurnOf(const int32_t* indices, bool isAlone)
{
    const int32_t *a = indices, *b = indices + 3;
    int turn = isAlone ? PAIR_ALONE : PAIR_AS_IS;
    for (int i = 0; turn == PAIR_AS_IS && i < 9; ++i) {
        int j = i / 3, k = i % 3;
        bool isShared = a[j] == b[(k + 1) % 3] && a[(j + 1) % 3] == b[k];
        turn = isShared ? PAIR_TURNED + i : turn;
    }
    return (uint8_t)turn;
}

static void GetPair(const kiriCorners* corners, int32_t pair, int32_t v[6])
{
    const int32_t* indices = corners->indices + 6 * (ptrdiff_t)pair;
    const uint8_t* order = pairOrders[corners->turns[pair]];
    for (int i = 0; i < 6; ++i) {
        v[i] = indices[order[i]];
    }
}

/* ---- Sums -------------------------------------------------------------------------------------------------------- */

static kiriLanes EdgeAlong(const float* x, int32_t from, int32_t to)
{
    return kiriLanes_Sub(kiriLanes_Load(x + 3 * (ptrdiff_t)to), kiriLanes_Load(x + 3 * (ptrdiff_t)from));
}

static void AddSlope(float* slopes, int32_t vertex, kiriLanes slope)
{
    float* sum = slopes + 4 * (ptrdiff_t)vertex;
    kiriLanes_Store(sum, kiriLanes_Add(kiriLanes_Load(sum), slope));
}

/* The cross product of two sides is twice the area times the normal: sums are area-weighted. Where two triangles share
   an edge, their corners on it get one sum from both. */
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners)
{
    memset(slopes, 0, 4 * sizeof(float) * (size_t)vertexCount);
    for (int32_t t = 0; t < corners->triangleCount; t += 2) {
        int32_t v[6];
        GetPair(corners, t / 2, v);
        kiriLanes ac = EdgeAlong(positions, v[0], v[2]), first = kiriLanes_Cross(EdgeAlong(positions, v[0], v[1]), ac);
        AddSlope(slopes, v[1], first);
        if (v[0] == v[3] && v[2] == v[4]) {
            kiriLanes second = kiriLanes_Cross(ac, EdgeAlong(positions, v[0], v[5])),
                      both = kiriLanes_Add(first, second);
            AddSlope(slopes, v[5], second);
            AddSlope(slopes, v[0], both);
            AddSlope(slopes, v[2], both);
        } else {
            kiriLanes second = kiriLanes_Cross(EdgeAlong(positions, v[3], v[4]), EdgeAlong(positions, v[3], v[5]));
            AddSlope(slopes, v[0], first);
            AddSlope(slopes, v[2], first);
            AddSlope(slopes, v[3], second);
            AddSlope(slopes, v[4], second);
            AddSlope(slopes, v[5], second);
        }
    }
}

/* The same for one vertex of a pair, in the same order. */
static kiriLanes AddPairTo(kiriLanes sum, int32_t vertex, const float* positions, const int32_t* v)
{
    kiriLanes ac = EdgeAlong(positions, v[0], v[2]), first = kiriLanes_Cross(EdgeAlong(positions, v[0], v[1]), ac);
    if (v[0] == v[3] && v[2] == v[4]) {
        kiriLanes second = kiriLanes_Cross(ac, EdgeAlong(positions, v[0], v[5])), both = kiriLanes_Add(first, second);
        const kiriLanes by[4] = { first, second, both, both };
        const int32_t of[4] = { v[1], v[5], v[0], v[2] };
        for (int k = 0; k < 4; ++k) {
            sum = of[k] == vertex ? kiriLanes_Add(sum, by[k]) : sum;
        }
        return sum;
    }
    kiriLanes second = kiriLanes_Cross(EdgeAlong(positions, v[3], v[4]), EdgeAlong(positions, v[3], v[5]));
    for (int k = 0; k < 6; ++k) {
        sum = v[k] == vertex ? kiriLanes_Add(sum, k < 3 ? first : second) : sum;
    }
    return sum;
}

enum { MOST_PAIRS = 64 }; /* around a vertex */

/* Into a row of pairs that ascends, once; false where there is no room. */
static bool InsertPair(int32_t* pairs, int32_t* count, int32_t pair)
{
    int32_t at = *count;
    while (at > 0 && pairs[at - 1] > pair) {
        --at;
    }
    if (at > 0 && pairs[at - 1] == pair) {
        return true;
    }
    if (*count == MOST_PAIRS) {
        return false;
    }
    memmove(pairs + at + 1, pairs + at, sizeof(*pairs) * (size_t)(*count - at));
    pairs[at] = pair;
    *count += 1;
    return true;
}

/* The pairs of the fan of a vertex: counter-clockwise all around or to its end, else clockwise from where it began. */
static bool ListPairs(const kiriMeshData* mesh, int32_t vertex, int32_t* pairs, int32_t* count)
{
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
    int32_t start = mesh->vertices.data[vertex].edge, h = start;
    bool ok = true;
    *count = 0;
    while (ok && h != KIRI_NONE) {
        ok = InsertPair(pairs, count, h / 6);
        h = kiriMesh_CounterClockwise(mesh, h);
        if (h == start) {
            return ok;
        }
    }
    h = start == KIRI_NONE ? KIRI_NONE : kiriMesh_Clockwise(mesh, start);
    while (ok && h != KIRI_NONE) {
        ok = InsertPair(pairs, count, h / 6);
        h = kiriMesh_Clockwise(mesh, h);
    }
    return ok;
}

bool kiriNormals_SumOne(float* slopes, int32_t vertex, const float* positions, const kiriCorners* corners,
                        const kiriMeshData* mesh)
{
    int32_t pairs[MOST_PAIRS], count;
    kiriLanes sum = kiriLanes_Splat(0.0f);
    if (!ListPairs(mesh, vertex, pairs, &count)) {
        return false;
    }
    for (int32_t k = 0; k < count; ++k) {
        int32_t v[6];
        GetPair(corners, pairs[k], v);
        sum = AddPairTo(sum, vertex, positions, v);
    }
    kiriLanes_Store(slopes + 4 * (ptrdiff_t)vertex, sum);
    return true;
}

/* A length that fits a float may have a square that does not. */
static void WriteNormal(float* normal, const float* slope)
{
    kiriVec3 unit = kiriVec3_Normalize(kiriVec3_Load(slope));
    bool known = kiriVec3_Dot(unit, unit) > 0.0;
    kiriVec3_Store(normal, known ? unit : kiriVec3_Make(0.0, 0.0, 1.0));
}

/* Four squared lengths: x, y and z of each are brought together first. */
static kiriLanes SquaresOf(const float* slopes)
{
    kiriLanes a = kiriLanes_Load(slopes), b = kiriLanes_Load(slopes + 4);
    kiriLanes c = kiriLanes_Load(slopes + 8), d = kiriLanes_Load(slopes + 12);
    kiriLanes abxy = kiriLanes_Join(a, 0, 1, b, 0, 1), cdxy = kiriLanes_Join(c, 0, 1, d, 0, 1);
    kiriLanes x = kiriLanes_Join(abxy, 0, 2, cdxy, 0, 2), y = kiriLanes_Join(abxy, 1, 3, cdxy, 1, 3);
    kiriLanes z = kiriLanes_Join(kiriLanes_Join(a, 2, 2, b, 2, 2), 0, 2, kiriLanes_Join(c, 2, 2, d, 2, 2), 0, 2);
    kiriLanes xy = kiriLanes_Add(kiriLanes_Mul(x, x), kiriLanes_Mul(y, y));
    return kiriLanes_Add(xy, kiriLanes_Mul(z, z));
}

static void WriteFourNormals(float* normals, const float* slopes)
{
    float square[4], scale[4];
    kiriLanes squares = SquaresOf(slopes);
    kiriLanes_Store(square, squares);
    kiriLanes_Store(scale, kiriLanes_Div(kiriLanes_Splat(1.0f), kiriLanes_Sqrt(squares)));
    for (int k = 0; k < 4; ++k) {
        if (square[k] > 1e-30f && square[k] < 1e30f) {
            kiriLanes unit = kiriLanes_Mul(kiriLanes_Splat(scale[k]), kiriLanes_Load(slopes + 4 * k));
            kiriLanes_StoreThree(normals + 3 * k, unit);
        } else {
            WriteNormal(normals + 3 * k, slopes + 4 * k);
        }
    }
}

/* The last ones are written by fours too, so that ranges do not change any. */
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end)
{
    int32_t v = begin;
    for (; v + 4 <= end; v += 4) {
        WriteFourNormals(normals + 3 * (ptrdiff_t)v, slopes + 4 * (ptrdiff_t)v);
    }
    float last[16] = { 0.0f }, written[12];
    if (v < end) {
        memcpy(last, slopes + 4 * (ptrdiff_t)v, 4 * sizeof(float) * (size_t)(end - v));
        WriteFourNormals(written, last);
        memcpy(normals + 3 * (ptrdiff_t)v, written, 3 * sizeof(float) * (size_t)(end - v));
    }
}
