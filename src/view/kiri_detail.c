#include "kiri_detail.h"
#include "../core/kiri_lanes.h"

#include <math.h>

/* Share of the offsets that a tick takes away. Edges do not see a shift of the whole sheet, so without it the layer would
   drift to the end of its leash. */
#define PULL 0.002f

/* Part of the squared Laplacian of the offsets that a tick takes away. Stable up to 1/2. Twice as much leaves lips no
   evener, and cloth that lies in a heap more strained. */
#define SMOOTHING 0.1f

/* ---- Room -------------------------------------------------------------------------------------------------------- */

/* Two free items at the end stand for the ends of missing edges in a group. Euler's formula limits the edges: a hole has at
   least three vertices. */
bool kiriDetail_Reserve(kiriDetail* detail, kiriMemory* memory, int64_t vertices, int64_t triangles, int32_t frames)
{
    bool hasRoom = !kiriDetail_IsOn(detail) || (kiriArray_Reserve(memory, &detail->offsets, 3 * vertices) &&
                                                kiriArray_Reserve(memory, &detail->shifts, frames) &&
                                                kiriArray_Reserve(memory, &detail->drawn, 3 * vertices + 1));
    return hasRoom &&
           (detail->sweeps == 0 ||
            (kiriArray_Reserve(memory, &detail->moving, 4 * vertices + 8) &&
            kiriArray_Reserve(memory, &detail->vertices, vertices) &&
            kiriArray_Reserve(memory, &detail->edges, triangles + vertices + vertices / 3) &&
            kiriArray_Reserve(memory, &detail->awake, frames)));
}

void kiriDetail_Resize(kiriDetail* detail, int32_t vertices, int32_t frames)
{
    int32_t was = detail->offsets.count, is = kiriDetail_IsOn(detail) ? 3 * vertices : 0;
    KIRI_ASSERT(is <= detail->offsets.capacity && (detail->sweeps == 0 || frames <= detail->awake.capacity));
    if (is > was) {
        memset(detail->offsets.data + was, 0, sizeof(float) * (is - was));
    }
    detail->offsets.count = detail->drawn.count = is;
    detail->awake.count = detail->sweeps > 0 ? frames : 0;
    detail->shifts.count = kiriDetail_IsOn(detail) ? frames : 0;
    detail->isListed = false;
}

void kiriDetail_Bear(kiriDetail* detail, int32_t vertex, const kiriBirth* birth)
{
    float sum[3] = { 0 };
    KIRI_ASSERT(3 * vertex < detail->offsets.count);
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        KIRI_TIMES(i, 3) {
            sum[i] += (float)birth->share[k] * detail->offsets.data[3 * birth->parent[k] + i];
        }
    }
    memcpy(detail->offsets.data + 3 * vertex, sum, sizeof(sum));
}

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

#define BORDER 0x80000000u

void kiriDetail_ListEdges(kiriDetail* detail, const kiriMeshData* mesh, float* scratch)
{
    int32_t counts[KIRI_DETAIL_COLORS] = { 0 };
    /* Has the colors of the edges of each vertex, or all bits if it is not listed; then the color of each half-edge that
       stands for an edge of the list. Both lips of an open edge have one. */
    uint32_t* marks = (void*)scratch;
    uint8_t* colors = (uint8_t*)(marks + mesh->vertices.count);
    KIRI_ASSERT(mesh->triangles.count / 4 < mesh->vertices.count); /* the colors take 3 bytes a triangle */
    memset(marks, 0xFF, sizeof(*marks) * mesh->vertices.count);
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        KIRI_ASSERT_HAS(mesh->vertices, item->vertex);
        marks[item->vertex] = 0;
    }
    KIRI_EACH_INDEX(k, mesh->triangles) {
        const kiriTriangle* t = &mesh->triangles.data[k];
        KIRI_EACH_CORNER(i) {
            const int32_t h = 3 * k + i;
            uint32_t *a = &marks[t->vertex[i]], *b = &marks[t->vertex[(i + 1) % 3]];
            bool isBorder = kiriMesh_IsBorder(mesh, h);
            colors[h] = KIRI_DETAIL_COLORS;
            if (*a != UINT32_MAX && (isBorder || h < t->twin[i])) {
                KIRI_ASSERT(*b != UINT32_MAX);
                int32_t color = kiriLowestBit(~(*a | *b)); /* the bit of the last color stays free */
                uint32_t mark = (color < KIRI_DETAIL_COLORS - 1 ? 1u << color : 0) | (isBorder ? BORDER : 0);
                *a |= mark;
                *b |= mark;
                colors[h] = (uint8_t)color;
                counts[color] += 1;
            }
        }
    }
    detail->colorStart[0] = 0;
    KIRI_TIMES(color, KIRI_DETAIL_COLORS) {
        detail->colorStart[color + 1] = detail->colorStart[color] + counts[color];
        counts[color] = detail->colorStart[color];
    }
    detail->edges.count = detail->colorStart[KIRI_DETAIL_COLORS];
    KIRI_ASSERT(detail->edges.count <= detail->edges.capacity);
    KIRI_EACH_INDEX(k, mesh->triangles) {
        const int32_t* vertex = mesh->triangles.data[k].vertex;
        KIRI_EACH_CORNER(i) {
            int32_t color = colors[3 * k + i], a = vertex[i], b = vertex[(i + 1) % 3];
            if (color < KIRI_DETAIL_COLORS) {
                kiriVec2 from = kiriMesh_Local(mesh, kiriMesh_At(mesh, a)), to = kiriMesh_Local(mesh, kiriMesh_At(mesh, b));
                detail->edges.data[counts[color]++] = (kiriDetailEdge){ a, b, (float)kiriVec2_Distance(from, to) };
            }
        }
    }
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        marks[item->vertex] &= BORDER; /* and now the number of edges */
    }
    KIRI_EACH(const kiriDetailEdge, edge, detail->edges) {
        marks[edge->a] += 1;
        marks[edge->b] += 1;
    }
    KIRI_EACH(kiriDetailVertex, item, detail->vertices) {
        uint32_t mark = marks[item->vertex];
        KIRI_ASSERT((mark & ~BORDER) > 0);
        float share = 1.0f / (float)(mark & ~BORDER);
        item->share = (mark & BORDER) != 0 ? -share : share;
    }
    detail->isListed = true;
}

/* ---- A tick ------------------------------------------------------------------------------------------------------ */

/* What holds a vertex completes its offset each tick, so a part of the old one goes: else errors would add up. */
void kiriDetail_Begin(int32_t begin, int32_t end, void* context)
{
    const kiriDetailTask* task = context;
    kiriDetail* detail = task->detail;
    KIRI_ASSERT(detail->isListed && begin >= 0 && end <= detail->vertices.count);
    KIRI_FROM_TO(k, begin, end) {
        kiriDetailVertex item = detail->vertices.data[k];
        const float *from = task->skin + 3 * item.vertex, *by = detail->offsets.data + 3 * item.vertex;
        float *to = detail->moving.data + 4 * item.vertex, keep = item.leash > 0.0f ? 1.0f - PULL : 0.8f;
        KIRI_TIMES(i, 3) {
            to[i] = from[i] + keep * by[i];
        }
        to[3] = item.leash > 0.0f ? 1.0f : 0.0f;
    }
}

int32_t kiriDetail_GroupCount(const kiriDetail* detail, int32_t color)
{
    int32_t edges = detail->colorStart[color + 1] - detail->colorStart[color];
    return color < KIRI_DETAIL_COLORS - 1 ? (edges + 3) / 4 : edges;
}

#define DETAIL_END(k, end) (at + 4 * (ptrdiff_t)edges[k].end)
#define DETAIL_LANE(of, n)                                                                                             \
    kiriLanes_Join(kiriLanes_Join(of[0], n, n, of[1], n, n), 0, 2, kiriLanes_Join(of[2], n, n, of[3], n, n), 0, 2)

/* Moves the ends of four edges towards each other, by half of the error in all if both are free. */
static inline void RelaxFour(float* at, const kiriDetailEdge edges[4])
{
    const kiriLanes least = kiriLanes_Splat(1e-30f), none = kiriLanes_Splat(0.0f);
    kiriLanes p[4], q[4], by[4];
    KIRI_TIMES(k, 4) {
        p[k] = kiriLanes_Load(DETAIL_END(k, a));
        q[k] = kiriLanes_Load(DETAIL_END(k, b));
        by[k] = kiriLanes_Sub(q[k], p[k]);
    }
    kiriLanes xy0 = kiriLanes_Join(by[0], 0, 1, by[1], 0, 1), xy1 = kiriLanes_Join(by[2], 0, 1, by[3], 0, 1);
    kiriLanes x = kiriLanes_Join(xy0, 0, 2, xy1, 0, 2), y = kiriLanes_Join(xy0, 1, 3, xy1, 1, 3);
    kiriLanes z = DETAIL_LANE(by, 2), free0 = DETAIL_LANE(p, 3), free1 = DETAIL_LANE(q, 3);
    kiriLanes square = kiriLanes_Add(kiriLanes_Add(kiriLanes_Mul(x, x), kiriLanes_Mul(y, y)), kiriLanes_Mul(z, z));
    kiriLanes length = kiriLanes_Sqrt(kiriLanes_Add(square, least));
    kiriLanes shares = kiriLanes_Add(kiriLanes_Add(free0, free1), kiriLanes_Splat(1e-12f));
    kiriLanes rest = kiriLanes_Four(edges[0].rest, edges[1].rest, edges[2].rest, edges[3].rest);
    kiriLanes scale = kiriLanes_Div(kiriLanes_Sub(length, rest), kiriLanes_Mul(length, shares));
    kiriLanes cx = kiriLanes_Mul(scale, x), cy = kiriLanes_Mul(scale, y), cz = kiriLanes_Mul(scale, z);
    kiriLanes low = kiriLanes_Join(cx, 0, 1, cy, 0, 1), high = kiriLanes_Join(cx, 2, 3, cy, 2, 3);
    kiriLanes lowZ = kiriLanes_Join(cz, 0, 1, none, 0, 1), highZ = kiriLanes_Join(cz, 2, 3, none, 0, 1);
    by[0] = kiriLanes_Join(low, 0, 2, lowZ, 0, 2);
    by[1] = kiriLanes_Join(low, 1, 3, lowZ, 1, 3);
    by[2] = kiriLanes_Join(high, 0, 2, highZ, 0, 2);
    by[3] = kiriLanes_Join(high, 1, 3, highZ, 1, 3);
    KIRI_TIMES(k, 4) {
        kiriLanes_Store(DETAIL_END(k, a), kiriLanes_Add(p[k], kiriLanes_Mul(by[k], kiriLanes_Pick(p[k], 3, 3, 3, 3))));
        kiriLanes_Store(DETAIL_END(k, b), kiriLanes_Sub(q[k], kiriLanes_Mul(by[k], kiriLanes_Pick(q[k], 3, 3, 3, 3))));
    }
}

void kiriDetail_Sweep(int32_t begin, int32_t end, void* context)
{
    kiriDetail* detail = ((const kiriDetailTask*)context)->detail;
    const int32_t color = ((const kiriDetailTask*)context)->color;
    const int32_t each = color < KIRI_DETAIL_COLORS - 1 ? 4 : 1, vertices = detail->offsets.count / 3;
    const kiriDetailEdge* edges = detail->edges.data + detail->colorStart[color];
    const int32_t count = detail->colorStart[color + 1] - detail->colorStart[color];
    KIRI_ASSERT(detail->isListed && begin >= 0 && end <= kiriDetail_GroupCount(detail, color));
    KIRI_FROM_TO(group, begin, end) {
        const kiriDetailEdge *four = &edges[each * group], none = { vertices, vertices + 1, 0.0f };
        int32_t real = kiriMin(each, count - each * group);
        kiriDetailEdge padded[4] = { none, none, none, none };
        if (real < 4) {
            memset(detail->moving.data + 4 * vertices, 0, 8 * sizeof(float));
            memcpy(padded, four, sizeof(*four) * real);
            four = padded;
        }
        RelaxFour(detail->moving.data, four);
    }
}

void kiriDetail_Leash(int32_t begin, int32_t end, void* context)
{
    const kiriDetailTask* task = context;
    kiriDetail* detail = task->detail;
    KIRI_ASSERT(detail->isListed && begin >= 0 && end <= detail->vertices.count);
    KIRI_FROM_TO(k, begin, end) {
        kiriDetailVertex item = detail->vertices.data[k];
        const float* from = task->skin + 3 * item.vertex;
        float* at = detail->moving.data + 4 * item.vertex;
        float x = at[0] - from[0], y = at[1] - from[1], z = at[2] - from[2], square = x * x + y * y + z * z;
        float room = item.vertex < task->roomCount ? task->rooms[item.vertex] : item.leash;
        float leash = kiriMin(item.leash, room);
        if (item.leash > 0.0f && !(square <= leash * leash)) {
            float share = square < 1e30f ? leash / sqrtf(square) : 0.0f;
            at[0] = from[0] + share * x;
            at[1] = from[1] + share * y;
            at[2] = from[2] + share * z;
        }
    }
}

/* Takes a part of the squared Laplacian off the offsets: else compressed cloth crinkles from edge to edge of the mesh. On
   the outline the first Laplacian counts as 0, as on the free edge of a plate. */
void kiriDetail_Smooth(kiriDetail* detail, const float* skin, float* crease)
{
    float* offsets = detail->moving.data;
    KIRI_ASSERT(detail->isListed);
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        ptrdiff_t vertex = item->vertex;
        kiriLanes from = kiriLanes_Four(skin[3 * vertex], skin[3 * vertex + 1], skin[3 * vertex + 2], 0.0f);
        kiriLanes_Store(offsets + 4 * vertex, kiriLanes_Sub(kiriLanes_Load(offsets + 4 * vertex), from));
        kiriLanes_Store(crease + 4 * vertex, kiriLanes_Splat(0.0f));
    }
    KIRI_EACH(const kiriDetailEdge, edge, detail->edges) {
        float *a = crease + 4 * edge->a, *b = crease + 4 * edge->b;
        kiriLanes by = kiriLanes_Sub(kiriLanes_Load(offsets + (b - crease)), kiriLanes_Load(offsets + (a - crease)));
        kiriLanes_Store(a, kiriLanes_Add(kiriLanes_Load(a), by));
        kiriLanes_Store(b, kiriLanes_Sub(kiriLanes_Load(b), by));
    }
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        float* of = crease + 4 * item->vertex;
        kiriLanes_Store(of, kiriLanes_Mul(kiriLanes_Splat(kiriMax(item->share, 0.0f)), kiriLanes_Load(of)));
        of[3] = item->leash > 0.0f ? SMOOTHING * fabsf(item->share) : 0.0f;
    }
    KIRI_EACH(const kiriDetailEdge, edge, detail->edges) {
        float *a = offsets + 4 * edge->a, *b = offsets + 4 * edge->b;
        kiriLanes first = kiriLanes_Load(crease + (a - offsets)), second = kiriLanes_Load(crease + (b - offsets));
        kiriLanes by = kiriLanes_Sub(second, first);
        kiriLanes_Store(a, kiriLanes_Sub(kiriLanes_Load(a), kiriLanes_Mul(kiriLanes_Pick(first, 3, 3, 3, 3), by)));
        kiriLanes_Store(b, kiriLanes_Add(kiriLanes_Load(b), kiriLanes_Mul(kiriLanes_Pick(second, 3, 3, 3, 3), by)));
    }
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        ptrdiff_t vertex = item->vertex;
        kiriLanes from = kiriLanes_Four(skin[3 * vertex], skin[3 * vertex + 1], skin[3 * vertex + 2], 0.0f);
        kiriLanes_Store(offsets + 4 * vertex, kiriLanes_Add(kiriLanes_Load(offsets + 4 * vertex), from));
    }
}

void kiriDetail_End(kiriDetail* detail, const float* skin)
{
    KIRI_ASSERT(detail->isListed);
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        const float *at = detail->moving.data + 4 * item->vertex, *from = skin + 3 * item->vertex;
        float by[3] = { at[0] - from[0], at[1] - from[1], at[2] - from[2] }, *to = detail->offsets.data + (from - skin);
        float square = by[0] * by[0] + by[1] * by[1] + by[2] * by[2];
        bool isSound = square <= (item->leash > 0.0f ? 4.0f * item->leash * item->leash : 1e18f); /* false for NaN */
        KIRI_TIMES(i, 3) {
            to[i] = isSound ? by[i] : 0.0f;
        }
    }
}

void kiriDetail_Measure(kiriDetail* detail)
{
    detail->longest = 0.0f;
    KIRI_EACH(const float, offset, detail->offsets) {
        detail->longest = kiriMax(fabsf(*offset), detail->longest);
    }
}

void kiriDetail_Draw(kiriDetail* detail, const float* skin, int32_t begin, int32_t end)
{
    KIRI_ASSERT(3 * end <= detail->drawn.count && detail->drawn.count == detail->offsets.count);
    for (ptrdiff_t i = 3 * begin; i < 3 * end; ++i) {
        detail->drawn.data[i] = skin[i] + detail->offsets.data[i];
    }
}
