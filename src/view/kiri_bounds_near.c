#include "kiri_bounds_work.h"

/* ---- Groups ---- */

/* KIRI_NONE for a triangle that is not seen. */
static int32_t GroupOf(const kiriSurface* surface, const int32_t* ofVertex, int32_t triangle)
{
    return kiriBounds_IsHidden(surface, triangle) ? KIRI_NONE : ofVertex[surface->indices.data[3 * (size_t)triangle]];
}

/* As a set: groups of the same number modulo 64 look the same, so boxes of pieces that lie on each other are told apart
   also near the root. */
static uint64_t SetOf(int32_t group)
{
    return group == KIRI_NONE ? 0 : UINT64_C(1) << (group & 63);
}

/* Those that the items of a node are of. */
static uint64_t GroupsOfNode(const kiriBounds* bounds, const kiriSurface* surface, const int32_t* ofVertex,
                             int32_t level, int32_t node)
{
    int32_t first, end = kiriBounds_ItemsOf(bounds, level, node, &first);
    uint64_t groups = 0;
    for (int32_t i = first; i < end; ++i) {
        groups |= level > 0 ? bounds->groups.data[i] : SetOf(GroupOf(surface, ofVertex, bounds->order.data[i]));
    }
    return groups;
}

/* Returns how many leaves have triangles of several groups. */
static int32_t WriteGroups(kiriBounds* bounds, const kiriSurface* surface, const int32_t* ofVertex)
{
    int32_t mixed = 0;
    for (int32_t level = 0; level < bounds->levelCount; ++level) {
        int32_t end = level + 1 < bounds->levelCount ? bounds->firsts[level + 1] : bounds->nodes.count;
        for (int32_t node = bounds->firsts[level]; node < end; ++node) {
            uint64_t groups = GroupsOfNode(bounds, surface, ofVertex, level, node);
            bounds->groups.data[node] = groups;
            mixed += level == 0 && (groups & (groups - 1)) != 0;
        }
    }
    return mixed;
}

/* Group by group, and in the order of before within each: groups that part have large boxes together. */
static void SortByGroup(kiriBounds* bounds, const kiriSurface* surface, const int32_t* ofVertex)
{
    for (int32_t t = 0; t < surface->triangleCount; ++t) {
        bounds->codes.data[t] = (uint32_t)(GroupOf(surface, ofVertex, t) + 1);
    }
    kiriBounds_SortByCodes(bounds, surface->triangleCount);
    kiriBounds_Fit(bounds, surface);
}

bool kiriBounds_Group(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface, const int32_t* ofVertex,
                      int32_t groupCount)
{
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface));
    int32_t count = surface->triangleCount, leaves = count / KIRI_BOUNDS_LEAF;
    if (!kiriArray_Resize(memory, &bounds->groups, bounds->nodes.count)) {
        return false;
    }
    /* Sorted by group no more leaves are mixed than there are groups; between sorts, some of new triangles. */
    if (WriteGroups(bounds, surface, ofVertex) <= groupCount + leaves / 16) {
        return true;
    }
    if (!kiriArray_Reserve(memory, &bounds->codes, count) || !kiriArray_Reserve(memory, &bounds->other, count)) {
        return false;
    }
    SortByGroup(bounds, surface, ofVertex);
    WriteGroups(bounds, surface, ofVertex);
    return true;
}

/* ---- The nearest ---- */

#define ROUNDING_OF_BOXES (1.0 + 1e-9) /* of squares of distances: a box is never farther than what is in it */

typedef struct NearSearch {
    const kiriBounds* bounds;
    const kiriSurface* surface;
    kiriGroup group;
    kiriVec3 from;
    double most;
    kiriNearFn* look;
    void* context;
} NearSearch;

static double OffSide(double x, double lower, double upper)
{
    return x < lower ? lower - x : x > upper ? x - upper : 0.0;
}

static double SquareToBox(const kiriBox* box, kiriVec3 x)
{
    kiriVec3 off = kiriVec3_Make(OffSide(x.x, box->lower.x, box->upper.x), OffSide(x.y, box->lower.y, box->upper.y),
                                 OffSide(x.z, box->lower.z, box->upper.z));
    return kiriVec3_Dot(off, off);
}

static bool HasGroup(const NearSearch* search, int32_t node)
{
    return (search->bounds->groups.data[node] & SetOf(search->group.group)) != 0;
}

/* The child that is the nearest of those not visited yet, or `end`. */
static int32_t NextChild(const double* squares, int32_t first, int32_t end)
{
    int32_t best = end;
    for (int32_t i = first; i < end; ++i) {
        bool isLeft = squares[i - first] >= 0.0;
        best = isLeft && (best == end || squares[i - first] < squares[best - first]) ? i : best;
    }
    return best;
}

static bool IsNearEnough(const NearSearch* search, double square)
{
    return square <= search->most * ROUNDING_OF_BOXES;
}

static void LookInLeaf(NearSearch* search, int32_t leaf)
{
    int32_t first, end = kiriBounds_ItemsOf(search->bounds, 0, leaf, &first);
    for (int32_t i = first; i < end; ++i) {
        int32_t triangle = search->bounds->order.data[i];
        if (GroupOf(search->surface, search->group.ofVertex, triangle) != search->group.group) {
            continue;
        }
        kiriBox box = kiriBox_OfTriangle(search->surface, triangle);
        if (IsNearEnough(search, SquareToBox(&box, search->from))) {
            search->most = search->look(search->context, triangle);
        }
    }
}

static void LookInNode(NearSearch* search, int32_t level, int32_t node)
{
    double squares[KIRI_BOUNDS_FAN];
    int32_t first, end = kiriBounds_ItemsOf(search->bounds, level, node, &first);
    for (int32_t i = first; i < end; ++i) {
        squares[i - first] = HasGroup(search, i) ? SquareToBox(&search->bounds->nodes.data[i], search->from) : -1.0;
    }
    for (int32_t i; (i = NextChild(squares, first, end)) < end && IsNearEnough(search, squares[i - first]);) {
        squares[i - first] = -1.0;
        if (level > 1) {
            LookInNode(search, level - 1, i);
        } else {
            LookInLeaf(search, i);
        }
    }
}

void kiriBounds_Nearest(const kiriBounds* bounds, const kiriSurface* surface, kiriGroup group, kiriVec3 from,
                        double most, kiriNearFn* look, void* context)
{
    NearSearch search = { bounds, surface, group, from, most, look, context };
    int32_t root = bounds->nodes.count - 1;
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface) && bounds->groups.count == bounds->nodes.count);
    if (root >= 0 && IsNearEnough(&search, SquareToBox(&bounds->nodes.data[root], from))) {
        if (bounds->levelCount > 1) {
            LookInNode(&search, bounds->levelCount - 1, root);
        } else {
            LookInLeaf(&search, root);
        }
    }
}
