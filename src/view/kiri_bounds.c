#include "kiri_bounds.h"
#include "../core/kiri_array.h"

#include <string.h>

enum { KIRI_BOUNDS_LEAF = 8, KIRI_BOUNDS_FAN = 4 }; /* triangles of a leaf, children of a node */

/* Its corners are one, see kiriSurface_HideTriangle. */
static bool kiriBounds_IsHidden(const kiriSurface* surface, int32_t triangle)
{
    const int32_t* corner = &surface->indices.data[3 * (size_t)triangle];
    return corner[0] == corner[1];
}

/* The children of a node, or the triangles of a leaf: the items from *first up to the end that it returns. */
static int32_t kiriBounds_ItemsOf(const kiriBounds* bounds, int32_t level, int32_t node, int32_t* first)
{
    int32_t fan = level == 0 ? KIRI_BOUNDS_LEAF : KIRI_BOUNDS_FAN, start = level == 0 ? 0 : bounds->firsts[level - 1];
    int32_t end = level == 0 ? bounds->order.count : bounds->firsts[level];
    *first = start + fan * (node - bounds->firsts[level]);
    return end - *first < fan ? end : *first + fan;
}

/* ---- Boxes ---- */

static kiriVec3 Least(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(kiriMin(a.x, b.x), kiriMin(a.y, b.y), kiriMin(a.z, b.z));
}

static kiriVec3 Most(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(kiriMax(a.x, b.x), kiriMax(a.y, b.y), kiriMax(a.z, b.z));
}

static inline void AddTriangle(kiriBox* box, const kiriSurface* surface, const int32_t* corner)
{
    for (int k = 0; k < 3; ++k) {
        kiriVec3 at = kiriSurface_At(surface, corner[k]);
        box->lower = Least(at, box->lower);
        box->upper = Most(at, box->upper);
    }
}

void kiriBox_Add(kiriBox* box, kiriVec3 at)
{
    box->lower = Least(at, box->lower);
    box->upper = Most(at, box->upper);
}

kiriBox kiriBox_OfTriangle(const kiriSurface* surface, int32_t triangle)
{
    const int32_t* corner = &surface->indices.data[3 * (size_t)triangle];
    kiriBox box = { kiriSurface_At(surface, corner[0]), kiriSurface_At(surface, corner[0]) };
    AddTriangle(&box, surface, corner);
    return box;
}

/* ---- The shape of the tree ---- */

/* Every second bit of the result. */
static uint32_t Spread(uint32_t bits)
{
    bits = (bits | (bits << 8)) & 0x00ff00ffu;
    bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
    bits = (bits | (bits << 2)) & 0x33333333u;
    return (bits | (bits << 1)) & 0x55555555u;
}

/* Where the middle of a triangle lies on a Z curve through the rest plane (Morton 1966), 2^16 places by 2^16. */
static uint32_t CodeOf(const kiriSurface* surface, int32_t triangle, kiriVec2 lower, double scale)
{
    const int32_t* v = &surface->indices.data[3 * (size_t)triangle];
    const kiriVec2* rest = surface->rest.data;
    kiriVec2 sum = kiriVec2_Add(kiriVec2_Add(rest[v[0]], rest[v[1]]), rest[v[2]]);
    uint32_t x = (uint32_t)(scale * (sum.x / 3.0 - lower.x)), y = (uint32_t)(scale * (sum.y / 3.0 - lower.y));
    return Spread(x) | (Spread(y) << 1);
}

static void WriteCodes(kiriBounds* bounds, const kiriSurface* surface)
{
    kiriVec2 lower = surface->rest.data[0], upper = lower;
    for (int32_t v = 0; v < surface->vertexCount; ++v) {
        kiriVec2 p = surface->rest.data[v];
        lower = kiriVec2_Make(kiriMin(p.x, lower.x), kiriMin(p.y, lower.y));
        upper = kiriVec2_Make(kiriMax(p.x, upper.x), kiriMax(p.y, upper.y));
    }
    double width = upper.x - lower.x, height = upper.y - lower.y;
    double scale = 65535.0 / kiriMax(width, height);
    for (int32_t t = 0; t < surface->triangleCount; ++t) {
        bounds->codes.data[t] = CodeOf(surface, t, lower, scale);
        bounds->order.data[t] = t;
    }
}

/* One pass of a radix sort: by the bits from `shift` on, else as they were. */
static void SortByBits(const uint32_t* codes, int shift, const int32_t* from, int32_t* to, int32_t count)
{
    enum { BITS = 11 };
    int32_t starts[1 << BITS];
    uint32_t mask = (1u << BITS) - 1u;
    memset(starts, 0, sizeof(starts));
    for (int32_t i = 0; i < count; ++i) {
        ++starts[(codes[from[i]] >> shift) & mask];
    }
    int32_t first = 0;
    for (int32_t k = 0; k < 1 << BITS; ++k) {
        int32_t items = starts[k];
        starts[k] = first;
        first += items;
    }
    for (int32_t i = 0; i < count; ++i) {
        to[starts[(codes[from[i]] >> shift) & mask]++] = from[i];
    }
}

static void kiriBounds_SortByCodes(kiriBounds* bounds, int32_t count)
{
    const uint32_t* codes = bounds->codes.data;
    int32_t *a = bounds->order.data, *b = bounds->other.data;
    SortByBits(codes, 0, a, b, count);
    SortByBits(codes, 11, b, a, count);
    SortByBits(codes, 22, a, b, count);
    memcpy(a, b, sizeof(int32_t) * (size_t)count);
}

static void SortTriangles(kiriBounds* bounds, const kiriSurface* surface)
{
    WriteCodes(bounds, surface);
    kiriBounds_SortByCodes(bounds, surface->triangleCount);
    bounds->sorted = surface->triangleCount;
}

/* Where levels begin, and how many nodes there are in all. */
static int32_t LayLevels(int32_t triangleCount, int32_t firsts[KIRI_BOUNDS_LEVELS], int32_t* levelCount)
{
    int32_t nodes = 0, wide = triangleCount / KIRI_BOUNDS_LEAF + (triangleCount % KIRI_BOUNDS_LEAF != 0);
    *levelCount = 0;
    for (;;) {
        KIRI_ASSERT(*levelCount < KIRI_BOUNDS_LEVELS);
        firsts[(*levelCount)++] = nodes;
        nodes += wide;
        if (wide <= 1) {
            return nodes;
        }
        wide = wide / KIRI_BOUNDS_FAN + (wide % KIRI_BOUNDS_FAN != 0);
    }
}

static bool NeedsSorting(const kiriBounds* bounds, int32_t triangleCount)
{
    return bounds->levelCount == 0 || triangleCount / 2 > bounds->sorted || triangleCount < bounds->sorted;
}

static bool ReserveAll(kiriBounds* bounds, kiriMemory* memory, int32_t triangleCount)
{
    int32_t firsts[KIRI_BOUNDS_LEVELS], levelCount, nodes = LayLevels(triangleCount, firsts, &levelCount);
    bool sorts = NeedsSorting(bounds, triangleCount);
    return kiriArray_Reserve(memory, &bounds->order, triangleCount) &&
           kiriArray_Reserve(memory, &bounds->nodes, nodes) && kiriArray_Reserve(memory, &bounds->moves, nodes) &&
           (!sorts || (kiriArray_Reserve(memory, &bounds->codes, triangleCount) &&
                       kiriArray_Reserve(memory, &bounds->other, triangleCount)));
}

/* ---- Fitting ---- */

/* The first triangle from place i on, before `end`, that is not hidden; KIRI_NONE where all are. */
static int32_t FirstSeen(const kiriSurface* surface, const int32_t* order, int32_t i, int32_t end)
{
    while (i < end && kiriBounds_IsHidden(surface, order[i])) {
        ++i;
    }
    return i < end ? order[i] : KIRI_NONE;
}

static int32_t EndOfLeaf(const kiriSurface* surface, int32_t leaf)
{
    return surface->triangleCount - leaf * KIRI_BOUNDS_LEAF < KIRI_BOUNDS_LEAF ? surface->triangleCount
                                                                               : (leaf + 1) * KIRI_BOUNDS_LEAF;
}

/* All triangles of the leaf are hidden: it has a point of the leaf before, which makes no other box larger. */
static kiriVec3 PointOfHidden(const kiriBounds* bounds, const kiriSurface* surface, int32_t leaf)
{
    const int32_t* order = bounds->order.data;
    if (leaf > 0) {
        return bounds->nodes.data[leaf - 1].lower;
    }
    int32_t seen = FirstSeen(surface, order, 0, surface->triangleCount);
    return kiriSurface_At(surface, surface->indices.data[3 * (size_t)(seen != KIRI_NONE ? seen : order[0])]);
}

static void FitLeaf(kiriBounds* bounds, const kiriSurface* surface, int32_t leaf)
{
    const int32_t *indices = surface->indices.data, *order = bounds->order.data;
    int32_t seen = FirstSeen(surface, order, leaf * KIRI_BOUNDS_LEAF, EndOfLeaf(surface, leaf));
    kiriVec3 first =
        seen != KIRI_NONE ? kiriSurface_At(surface, indices[3 * (size_t)seen]) : PointOfHidden(bounds, surface, leaf);
    kiriBox box = { first, first };
    for (int32_t i = leaf * KIRI_BOUNDS_LEAF; i < EndOfLeaf(surface, leaf); ++i) {
        if (!kiriBounds_IsHidden(surface, order[i])) {
            AddTriangle(&box, surface, &indices[3 * (size_t)order[i]]);
        }
    }
    bounds->nodes.data[leaf] = box;
}

static void FitLeaves(kiriBounds* bounds, const kiriSurface* surface)
{
    for (int32_t leaf = 0; leaf * KIRI_BOUNDS_LEAF < surface->triangleCount; ++leaf) {
        FitLeaf(bounds, surface, leaf);
    }
}

static void FitNodes(kiriBounds* bounds)
{
    kiriBox* nodes = bounds->nodes.data;
    for (int32_t level = 1; level < bounds->levelCount; ++level) {
        int32_t child = bounds->firsts[level - 1], end = bounds->firsts[level];
        for (int32_t node = end; child < end; ++node) {
            kiriBox box = nodes[child];
            for (int k = 0; k < KIRI_BOUNDS_FAN && child < end; ++k, ++child) {
                box.lower = Least(nodes[child].lower, box.lower);
                box.upper = Most(nodes[child].upper, box.upper);
            }
            nodes[node] = box;
        }
    }
}

static void kiriBounds_Fit(kiriBounds* bounds, const kiriSurface* surface)
{
    FitLeaves(bounds, surface);
    FitNodes(bounds);
    bounds->pose = surface->pose;
    bounds->moves.count = 0;
}

static void FitBox(kiriBounds* bounds, const kiriSurface* surface)
{
    int32_t count = surface->triangleCount, known = bounds->order.count;
    bool sorts = NeedsSorting(bounds, count);
    bounds->nodes.count = LayLevels(count, bounds->firsts, &bounds->levelCount);
    KIRI_ASSERT(bounds->order.capacity >= count && bounds->nodes.capacity >= bounds->nodes.count);
    for (int32_t t = known; !sorts && t < count; ++t) {
        bounds->order.data[t] = t;
    }
    bounds->order.count = count;
    if (sorts) {
        bounds->groups.count = 0;
        SortTriangles(bounds, surface);
    }
    kiriBounds_Fit(bounds, surface);
}

/* ---- What moves ---- */

static bool MovesLeaf(const kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers, int32_t leaf)
{
    bool any = false;
    for (int32_t i = leaf * KIRI_BOUNDS_LEAF; !any && i < EndOfLeaf(surface, leaf); ++i) {
        int32_t vertex = surface->indices.data[3 * (size_t)bounds->order.data[i]];
        any = movers->data[vertex / movers->block] != KIRI_NONE;
    }
    return any;
}

/* Of leaves, then of the nodes above them. */
static void MarkMoving(kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers)
{
    uint8_t* moves = bounds->moves.data;
    int32_t child = 0, leaves = bounds->levelCount > 1 ? bounds->firsts[1] : bounds->nodes.count;
    for (int32_t leaf = 0; leaf < leaves; ++leaf) {
        moves[leaf] = MovesLeaf(bounds, surface, movers, leaf);
    }
    for (int32_t level = 1; level < bounds->levelCount; ++level) {
        int32_t end = bounds->firsts[level];
        for (int32_t node = end; child < end; ++node) {
            moves[node] = 0;
            for (int k = 0; k < KIRI_BOUNDS_FAN && child < end; ++k, ++child) {
                moves[node] |= moves[child];
            }
        }
    }
    bounds->moves.count = bounds->nodes.count;
    bounds->version = movers->version;
}

/* The children of a node: from *first up to the end that it returns. */
static int32_t ChildrenOf(const kiriBounds* bounds, int32_t level, int32_t node, int32_t* first)
{
    int32_t start = bounds->firsts[level - 1], end = bounds->firsts[level];
    *first = start + KIRI_BOUNDS_FAN * (node - end);
    return end - *first < KIRI_BOUNDS_FAN ? end : *first + KIRI_BOUNDS_FAN;
}

static void FitMoving(kiriBounds* bounds, const kiriSurface* surface, int32_t level, int32_t node)
{
    if (level == 0) {
        FitLeaf(bounds, surface, node);
        return;
    }
    kiriBox* nodes = bounds->nodes.data;
    int32_t first, end = ChildrenOf(bounds, level, node, &first);
    for (int32_t child = first; child < end; ++child) {
        if (bounds->moves.data[child]) {
            FitMoving(bounds, surface, level - 1, child);
        }
    }
    kiriBox box = nodes[first];
    for (int32_t child = first; child < end; ++child) {
        box.lower = Least(nodes[child].lower, box.lower);
        box.upper = Most(nodes[child].upper, box.upper);
    }
    nodes[node] = box;
}

/* Does the rest fit since the last tick? */
static bool FitsButForMovers(const kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers)
{
    return movers->data != NULL && surface->isPartly && bounds->pose + 1 == surface->pose && bounds->levelCount > 0 &&
           bounds->order.count == surface->triangleCount && !NeedsSorting(bounds, surface->triangleCount) &&
           bounds->moves.capacity >= bounds->nodes.count;
}

void kiriBounds_Forget(kiriBounds* bounds)
{
    bounds->levelCount = 0;
}

bool kiriBounds_IsFresh(const kiriBounds* bounds, const kiriSurface* surface)
{
    return bounds->levelCount > 0 && bounds->pose == surface->pose;
}

bool kiriBounds_Update(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface)
{
    bounds->patience = KIRI_BOUNDS_PATIENCE;
    if (kiriBounds_IsFresh(bounds, surface)) {
        return true;
    }
    if (!ReserveAll(bounds, memory, surface->triangleCount)) {
        return false;
    }
    FitBox(bounds, surface);
    return true;
}

/* ---- For who reads ---- */

void kiriBounds_Ask(const kiriBounds* bounds)
{
    kiriWord_Leave(&bounds->asked, 1);
}

/* Room for sorting is given back here alone: an update may run in a task, where nothing is allocated or freed. */
bool kiriBounds_Reserve(kiriBounds* bounds, kiriMemory* memory, int32_t triangleCount)
{
    if (!NeedsSorting(bounds, triangleCount)) {
        kiriArray_Release(memory, &bounds->codes);
        kiriArray_Release(memory, &bounds->other);
    }
    if (bounds->asked) {
        bounds->patience = KIRI_BOUNDS_PATIENCE;
        bounds->asked = 0;
    }
    if (bounds->patience > 0) {
        return ReserveAll(bounds, memory, triangleCount);
    }
    kiriArray_Release(memory, &bounds->order);
    kiriArray_Release(memory, &bounds->nodes);
    kiriArray_Release(memory, &bounds->groups);
    kiriArray_Release(memory, &bounds->moves);
    bounds->levelCount = 0;
    return true;
}

void kiriBounds_Keep(kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers)
{
    bounds->patience -= bounds->patience > 0;
    if (bounds->patience == 0 || kiriBounds_IsFresh(bounds, surface)) {
        return;
    }
    if (!FitsButForMovers(bounds, surface, movers)) {
        FitBox(bounds, surface);
        return;
    }
    if (bounds->moves.count == 0 || bounds->version != movers->version) {
        MarkMoving(bounds, surface, movers);
    }
    int32_t root = bounds->nodes.count - 1;
    if (bounds->moves.data[root]) {
        FitMoving(bounds, surface, bounds->levelCount - 1, root);
    }
    bounds->pose = surface->pose;
}

/* ---- Queries ---- */

kiriBox kiriBounds_All(const kiriBounds* bounds)
{
    return bounds->nodes.data[bounds->nodes.count - 1];
}

typedef struct Finder {
    const kiriBounds* bounds;
    const kiriSurface* surface;
    kiriMeetsFn* meets;
    const void* context;
    kiriMemory* memory;
    kiriIndices* found;
    bool wholeLeaves;
    const uint8_t* moves; /* of each node: is it looked at? Null: all are */
} Finder;

static bool FindIn(const Finder* finder, int32_t level, int32_t node)
{
    int32_t first, end = kiriBounds_ItemsOf(finder->bounds, level, node, &first);
    bool ok = true;
    for (int32_t i = first; ok && i < end; ++i) {
        if (level > 0) {
            bool isLeftOut = finder->moves != NULL && !finder->moves[i];
            ok = isLeftOut || !finder->meets(finder->context, &finder->bounds->nodes.data[i]) ||
                 FindIn(finder, level - 1, i);
            continue;
        }
        int32_t triangle = finder->bounds->order.data[i];
        if (kiriBounds_IsHidden(finder->surface, triangle)) {
            continue;
        }
        bool isFound = finder->wholeLeaves;
        if (!isFound) {
            kiriBox box = kiriBox_OfTriangle(finder->surface, triangle);
            isFound = finder->meets(finder->context, &box);
        }
        ok = !isFound || kiriArray_Push(finder->memory, finder->found, triangle);
    }
    return ok;
}

static bool FindFromRoot(const Finder* finder)
{
    const kiriBounds* bounds = finder->bounds;
    int32_t root = bounds->nodes.count - 1;
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, finder->surface));
    return root < 0 || !finder->meets(finder->context, &bounds->nodes.data[root]) ||
           FindIn(finder, bounds->levelCount - 1, root);
}

bool kiriBounds_Find(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets, const void* context,
                     kiriMemory* memory, kiriIndices* found)
{
    const Finder finder = { bounds, surface, meets, context, memory, found, false, NULL };
    int32_t before = found->count;
    if (!FindFromRoot(&finder)) {
        return false;
    }
    if (found->count > before) {
        kiriSort(found->data + before, found->count - before, NULL, NULL);
    }
    return true;
}

bool kiriBounds_FindLeaves(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets,
                           const void* context, int64_t version, kiriMemory* memory, kiriIndices* found)
{
    bool isMarked = bounds->moves.count > 0 && bounds->version == version;
    const Finder finder = {
        bounds, surface, meets, context, memory, found, true, isMarked ? bounds->moves.data : NULL
    };
    return FindFromRoot(&finder);
}

/* ---- Boxes that meet a box ---- */

static bool MeetsBox(const void* context, const kiriBox* box)
{
    return kiriBox_Meet(context, box);
}

bool kiriBounds_Box(const kiriBounds* bounds, const kiriSurface* surface, const kiriBox* box, kiriMemory* memory,
                    kiriIndices* found)
{
    return kiriBounds_Find(bounds, surface, MeetsBox, box, memory, found);
}

/* ---- Rays ---- */

typedef struct RayWalk {
    const kiriBounds* bounds;
    double origin[3], direction[3], slack;
    double distance;
    kiriVisitFn* visit;
    void* context;
} RayWalk;

/* Cuts the stretch of the ray down to what is between two planes; false where nothing is left. */
static bool Clip(double origin, double direction, double low, double high, double* from, double* to)
{
    if (direction == 0.0) {
        return origin >= low && origin <= high;
    }
    double a = (low - origin) / direction, b = (high - origin) / direction;
    double enter = kiriMin(a, b), leave = kiriMax(b, a);
    *from = kiriMax(enter, *from);
    *to = kiriMin(leave, *to);
    return *from <= *to;
}

/* Boxes a little larger, for what meets a triangle is rounded, too. */
static bool MeetsRay(const RayWalk* walk, const kiriBox* box)
{
    double from = -walk->slack, to = walk->distance + walk->slack, s = walk->slack;
    return Clip(walk->origin[0], walk->direction[0], box->lower.x - s, box->upper.x + s, &from, &to) &&
           Clip(walk->origin[1], walk->direction[1], box->lower.y - s, box->upper.y + s, &from, &to) &&
           Clip(walk->origin[2], walk->direction[2], box->lower.z - s, box->upper.z + s, &from, &to);
}

static void WalkRay(RayWalk* walk, int32_t level, int32_t node)
{
    int32_t first, end = kiriBounds_ItemsOf(walk->bounds, level, node, &first);
    if (level == 0) {
        walk->visit(walk->context, &walk->bounds->order.data[first], end - first, &walk->distance);
        return;
    }
    for (int32_t i = first; i < end; ++i) {
        if (MeetsRay(walk, &walk->bounds->nodes.data[i])) {
            WalkRay(walk, level - 1, i);
        }
    }
}

/* Of all coordinates that the ray and the surface have the largest. */
static double LargestOf(const kiriBox* box, kiriVec3 origin)
{
    kiriVec3 o = kiriVec3_Make(0.0, 0.0, 0.0);
    kiriVec3 low = Least(Least(box->lower, origin), o), high = Most(Most(box->upper, origin), o);
    kiriVec3 most = Most(high, kiriVec3_Scale(-1.0, low));
    return most.x > most.y ? kiriMax(most.x, most.z) : kiriMax(most.y, most.z);
}

void kiriBounds_Ray(const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction, double distance, kiriVisitFn* visit,
                    void* context)
{
    int32_t root = bounds->nodes.count - 1;
    if (root < 0) {
        return;
    }
    RayWalk walk = {
        bounds, { origin.x, origin.y, origin.z }, { direction.x, direction.y, direction.z }, 0.0, distance, visit,
        context
    };
    walk.slack = 1e-9 * LargestOf(&bounds->nodes.data[root], origin);
    if (MeetsRay(&walk, &bounds->nodes.data[root])) {
        WalkRay(&walk, bounds->levelCount - 1, root);
    }
}

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
        bool hasGroup = (search->bounds->groups.data[i] & SetOf(search->group.group)) != 0;
        squares[i - first] = hasGroup ? SquareToBox(&search->bounds->nodes.data[i], search->from) : -1.0;
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

/* ---- Rays ---- */

typedef struct Barycentric {
    double distance, b, c; /* along the ray; shares of the second and third corner */
} Barycentric;

/* Where a ray meets a triangle (Moeller and Trumbore 1997), or the rim around it: shares down to -rim count, too. */
static bool MeetTriangle(const kiriVec3 corner[3], kiriVec3 origin, kiriVec3 direction, double rim, Barycentric* at)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec3 p = kiriVec3_Cross(direction, ac);
    double determinant = kiriVec3_Dot(ab, p);
    if (determinant == 0.0) {
        return false;
    }
    kiriVec3 s = kiriVec3_Sub(origin, corner[0]), q = kiriVec3_Cross(s, ab);
    at->b = kiriVec3_Dot(s, p) / determinant;
    at->c = kiriVec3_Dot(direction, q) / determinant;
    at->distance = kiriVec3_Dot(ac, q) / determinant;
    return at->b >= -rim && at->c >= -rim && at->b + at->c <= 1.0 + rim;
}

static void WorldCorners(const kiriSurface* surface, int32_t triangle, kiriVec3 corner[3])
{
    for (int k = 0; k < 3; ++k) {
        corner[k] = kiriSurface_At(surface, surface->indices.data[3 * (size_t)triangle + (size_t)k]);
    }
}

static kiriVec2 RestPoint(const kiriSurface* surface, int32_t triangle, double b, double c)
{
    const int32_t* vertex = &surface->indices.data[3 * (size_t)triangle];
    kiriVec2 p = kiriVec2_Scale(1.0 - b - c, surface->rest.data[vertex[0]]);
    p = kiriVec2_Add(p, kiriVec2_Scale(b, surface->rest.data[vertex[1]]));
    return kiriVec2_Add(p, kiriVec2_Scale(c, surface->rest.data[vertex[2]]));
}

static void WriteHit(const kiriSurface* surface, int32_t triangle, const kiriVec3 corner[3], Barycentric at,
                     kiriHit* hit)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec2 rest = kiriVec2_Add(surface->origin, RestPoint(surface, triangle, at.b, at.c));
    hit->restPoint[0] = (float)rest.x;
    hit->restPoint[1] = (float)rest.y;
    kiriVec3_Store(hit->position, kiriVec3_AddScaled(kiriVec3_AddScaled(corner[0], at.b, ab), at.c, ac));
    kiriVec3_Store(hit->normal, kiriVec3_Normalize(kiriVec3_Cross(ab, ac)));
    hit->distance = (float)at.distance;
    hit->triangle = triangle;
}

typedef struct RaySearch {
    const kiriSurface* surface;
    kiriVec3 origin, direction;
    int32_t triangle; /* the first so far, or KIRI_NONE */
    Barycentric at;
} RaySearch;

/* The order in which triangles are tried makes no difference. */
static void TryTriangle(RaySearch* search, int32_t triangle, double* distance)
{
    kiriVec3 corner[3];
    Barycentric at;
    WorldCorners(search->surface, triangle, corner);
    if (MeetTriangle(corner, search->origin, search->direction, 0.0, &at) && at.distance >= 0.0 &&
        (at.distance < *distance || (at.distance == *distance && triangle > search->triangle))) {
        *distance = at.distance;
        search->triangle = triangle;
        search->at = at;
    }
}

static void TryTriangles(void* context, const int32_t* triangles, int32_t count, double* distance)
{
    for (int32_t i = 0; i < count; ++i) {
        TryTriangle(context, triangles[i], distance);
    }
}

void kiriSurface_Raycast(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction,
                         double maxDistance, kiriHit* hit)
{
    RaySearch search = { surface, origin, direction, KIRI_NONE, { 0.0, 0.0, 0.0 } };
    memset(hit, 0, sizeof(*hit));
    hit->triangle = KIRI_NONE;
    if (bounds != NULL && kiriBounds_IsFresh(bounds, surface)) {
        kiriBounds_Ray(bounds, origin, direction, maxDistance, TryTriangles, &search);
    } else {
        for (int32_t t = 0; t < surface->triangleCount; ++t) {
            TryTriangle(&search, t, &maxDistance);
        }
    }
    if (search.triangle != KIRI_NONE) {
        kiriVec3 corner[3];
        WorldCorners(surface, search.triangle, corner);
        WriteHit(surface, search.triangle, corner, search.at, hit);
    }
}

/* ---- Edges ---- */

typedef struct EdgeSearch {
    const kiriSurface* surface;
    kiriVec3 from, way;
    kiriMemory* memory;
    kiriCrossings* crossings;
    int32_t first; /* of those that were found for this edge */
    bool failed;
} EdgeSearch;

/* In the order of triangles, for that in which they are tried depends on how the bounds came about. */
static void AddCrossing(EdgeSearch* search, const kiriCrossing* crossing)
{
    kiriCrossings* all = search->crossings;
    if (!kiriArray_Push(search->memory, all, *crossing)) {
        search->failed = true;
        return;
    }
    int32_t i = all->count - 1;
    for (; i > search->first && all->data[i - 1].triangle > crossing->triangle; --i) {
        all->data[i] = all->data[i - 1];
    }
    all->data[i] = *crossing;
}

/* With a rim, or an edge may slip through between two triangles, by rounding. */
static void CrossTriangles(void* context, const int32_t* triangles, int32_t count, double* distance)
{
    EdgeSearch* search = context;
    (void)distance;
    for (int32_t i = 0; i < count; ++i) {
        kiriVec3 corner[3];
        Barycentric at;
        WorldCorners(search->surface, triangles[i], corner);
        if (MeetTriangle(corner, search->from, search->way, 1e-9, &at) && at.distance >= 0.0 && at.distance <= 1.0) {
            const kiriCrossing crossing = { RestPoint(search->surface, triangles[i], at.b, at.c),
                                            kiriVec3_AddScaled(search->from, at.distance, search->way), at.distance,
                                            triangles[i] };
            AddCrossing(search, &crossing);
        }
    }
}

static bool IsKnown(const EdgeSearch* search, int32_t count, kiriVec2 rest, double apart)
{
    bool isKnown = false;
    for (int32_t i = search->first; !isKnown && i < count; ++i) {
        isKnown = kiriVec2_Length(kiriVec2_Sub(search->crossings->data[i].rest, rest)) < apart;
    }
    return isKnown;
}

bool kiriSurface_Cross(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 from, kiriVec3 to, double apart,
                       kiriMemory* memory, kiriCrossings* crossings)
{
    EdgeSearch search = { surface, from, kiriVec3_Sub(to, from), memory, crossings, crossings->count, false };
    int32_t kept = crossings->count;
    kiriBounds_Ray(bounds, from, search.way, 1.0, CrossTriangles, &search);
    for (int32_t i = search.first; i < crossings->count; ++i) {
        if (!IsKnown(&search, kept, crossings->data[i].rest, apart)) {
            crossings->data[kept++] = crossings->data[i];
        }
    }
    crossings->count = kept;
    return !search.failed;
}
