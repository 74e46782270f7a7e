#include "kiri_bounds.h"

#include "../core/kiri_array.h"
#include "../core/kiri_lanes.h"

enum { LEAF_SIZE = 8, NODE_SIZE = 4 }; /* triangles of a leaf, children of a node */

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

double kiriBox_Farthest(const kiriBox* box, kiriVec3 from)
{
    kiriVec3 a = kiriVec3_Sub(box->lower, from), b = kiriVec3_Sub(box->upper, from);
    kiriVec3 least = kiriVec3_Least(a, b), most = kiriVec3_Most(a, b);
    return kiriVec3_Length(kiriVec3_Most(most, kiriVec3_Scale(-1.0, least)));
}

void kiriSurface_Corners(const kiriSurface* surface, int32_t triangle, kiriVec3 corner[3])
{
    KIRI_ASSERT(triangle >= 0 && triangle < surface->triangleCount);
    KIRI_EACH_CORNER(k) {
        corner[k] = kiriSurface_At(surface, kiriSurface_Triangle(surface, triangle)[k]);
    }
}

/* Returns true if the corners of a triangle are one, see kiriSurface_HideTriangle. */
static bool IsHidden(const kiriSurface* surface, int32_t triangle)
{
    const int32_t* corner = kiriSurface_Triangle(surface, triangle);
    return corner[0] == corner[1];
}

/* ---- The tree ---------------------------------------------------------------------------------------------------- */

/* Returns the end of the children of a node, or of the places in `order` of a leaf; *first is the first. */
static int32_t LeafItems(const kiriBounds* bounds, int32_t level, int32_t node, int32_t* first)
{
    int32_t fan = level == 0 ? LEAF_SIZE : NODE_SIZE, start = level == 0 ? 0 : bounds->firsts[level - 1];
    int32_t end = level == 0 ? bounds->order.count : bounds->firsts[level];
    KIRI_ASSERT(level >= 0 && level < bounds->levelCount && node >= bounds->firsts[level]);
    *first = start + fan * (node - bounds->firsts[level]);
    return end - *first < fan ? end : *first + fan;
}

static int32_t EndOfLevel(const kiriBounds* bounds, int32_t level)
{
    return level + 1 < bounds->levelCount ? bounds->firsts[level + 1] : bounds->nodes.count;
}

/* Writes the first node of each level. Returns the number of nodes. */
static int32_t LayLevels(int32_t triangleCount, int32_t firsts[KIRI_BOUNDS_LEVELS], int32_t* levelCount)
{
    int32_t nodes = 0, wide = triangleCount / LEAF_SIZE + (triangleCount % LEAF_SIZE != 0);
    *levelCount = 0;
    for (;;) {
        KIRI_ASSERT(*levelCount < KIRI_BOUNDS_LEVELS);
        firsts[(*levelCount)++] = nodes;
        nodes += wide;
        if (wide <= 1) {
            return nodes;
        }
        wide = wide / NODE_SIZE + (wide % NODE_SIZE != 0);
    }
}

static bool NeedsSorting(const kiriBounds* bounds, int32_t triangleCount)
{
    return bounds->levelCount == 0 || triangleCount / 2 > bounds->sorted || triangleCount < bounds->sorted;
}

static bool ReserveTree(kiriBounds* bounds, kiriMemory* memory, int32_t triangleCount)
{
    int32_t firsts[KIRI_BOUNDS_LEVELS], levelCount, nodes = LayLevels(triangleCount, firsts, &levelCount);
    int32_t sorted = NeedsSorting(bounds, triangleCount) ? triangleCount : 0;
    return kiriArray_Reserve(memory, &bounds->order, triangleCount) &&
           kiriArrays_Reserve(memory, nodes, &bounds->nodes, &bounds->moves) &&
           kiriArrays_Reserve(memory, sorted, &bounds->codes, &bounds->other);
}

/* Sorts the triangles in `order` by their codes: three stable passes over 11 bits each. */
static void SortByCodes(kiriBounds* bounds, int32_t count)
{
    enum { BITS = 11 };
    KIRI_ASSERT(bounds->codes.capacity >= count && bounds->other.capacity >= count);
    for (int shift = 0; shift < 32; shift += BITS) {
        const uint32_t mask = (1u << BITS) - 1u, *codes = bounds->codes.data;
        int32_t starts[1 << BITS], first = 0, *from = bounds->order.data;
        memset(starts, 0, sizeof(starts));
        KIRI_TIMES(i, count) {
            ++starts[(codes[from[i]] >> shift) & mask];
        }
        KIRI_TIMES(k, 1 << BITS) {
            int32_t items = starts[k];
            starts[k] = first;
            first += items;
        }
        KIRI_TIMES(i, count) {
            bounds->other.data[starts[(codes[from[i]] >> shift) & mask]++] = from[i];
        }
        memcpy(from, bounds->other.data, sizeof(int32_t) * count);
    }
}

/* Returns the bits of a number, with a zero before each. */
static uint32_t SpreadBits(uint32_t bits)
{
    bits = (bits | (bits << 8)) & 0x00ff00ffu;
    bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
    bits = (bits | (bits << 2)) & 0x33333333u;
    return (bits | (bits << 1)) & 0x55555555u;
}

/* Sorts the triangles along a Z curve through the rest plane (Morton 1966), 2^16 places by 2^16. */
static void SortTriangles(kiriBounds* bounds, const kiriSurface* surface)
{
    const kiriVec2* rest = surface->rest.data;
    kiriVec2 lower = rest[0], upper = lower;
    KIRI_TIMES(v, surface->vertexCount) {
        lower = kiriVec2_Make(kiriMin(rest[v].x, lower.x), kiriMin(rest[v].y, lower.y));
        upper = kiriVec2_Make(kiriMax(rest[v].x, upper.x), kiriMax(rest[v].y, upper.y));
    }
    double width = upper.x - lower.x, height = upper.y - lower.y, scale = 65535.0 / kiriMax(width, height);
    KIRI_TIMES(t, surface->triangleCount) {
        const int32_t* v = kiriSurface_Triangle(surface, t);
        kiriVec2 sum = kiriVec2_Add(kiriVec2_Add(rest[v[0]], rest[v[1]]), rest[v[2]]);
        uint32_t x = (uint32_t)(scale * (sum.x / 3.0 - lower.x)), y = (uint32_t)(scale * (sum.y / 3.0 - lower.y));
        bounds->codes.data[t] = SpreadBits(x) | (SpreadBits(y) << 1);
        bounds->order.data[t] = t;
    }
    SortByCodes(bounds, surface->triangleCount);
    bounds->groups.count = 0;
    bounds->sorted = surface->triangleCount;
}

/* Returns the least box around triangles in world space. Compares floats: sums with the middle keep their order. */
static kiriBox BoxOfLeaf(const kiriSurface* surface, const int32_t* triangles, int32_t count)
{
    const float* places = kiriSurface_Places(surface);
    float lower[3] = { FLT_MAX, FLT_MAX, FLT_MAX }, upper[3] = { -FLT_MAX, -FLT_MAX, -FLT_MAX };
    KIRI_TIMES(i, count) {
        const int32_t* corner = kiriSurface_Triangle(surface, triangles[i]);
        KIRI_TIMES_WHILE(corner[0] != corner[1], k, 3) {
            const float* at = places + 3 * corner[k];
            KIRI_TIMES(m, 3) {
                lower[m] = kiriMin(at[m], lower[m]);
                upper[m] = kiriMax(at[m], upper[m]);
            }
        }
    }
    return lower[0] > upper[0] ? KIRI_EMPTY_BOX
                               : (kiriBox){ kiriVec3_Add(surface->middle, kiriVec3_Load(lower)),
                                            kiriVec3_Add(surface->middle, kiriVec3_Load(upper)) };
}

/* Fits the boxes of all nodes, or of those that move. */
static void FitBoxes(kiriBounds* bounds, const kiriSurface* surface, const uint8_t* moves)
{
    kiriBox* nodes = bounds->nodes.data;
    KIRI_TIMES(level, bounds->levelCount) {
        KIRI_FROM_TO(node, bounds->firsts[level], EndOfLevel(bounds, level)) {
            if (moves != NULL && !moves[node]) {
                continue;
            }
            int32_t first, end = LeafItems(bounds, level, node, &first);
            kiriBox box = level == 0 ? BoxOfLeaf(surface, &bounds->order.data[first], end - first) : KIRI_EMPTY_BOX;
            KIRI_FROM_TO_WHILE(level > 0, i, first, end) {
                box.lower = kiriVec3_Least(nodes[i].lower, box.lower);
                box.upper = kiriVec3_Most(nodes[i].upper, box.upper);
            }
            nodes[node] = box;
        }
    }
    bounds->pose = surface->pose;
    bounds->sides.count = 0;
    bounds->moves.count = moves != NULL ? bounds->moves.count : 0;
}

/* Makes the tree, or adds the new triangles to it. Room is reserved. */
static void MakeTree(kiriBounds* bounds, const kiriSurface* surface)
{
    int32_t count = surface->triangleCount;
    bool sorts = NeedsSorting(bounds, count);
    bounds->nodes.count = LayLevels(count, bounds->firsts, &bounds->levelCount);
    KIRI_ASSERT(bounds->order.capacity >= count && bounds->nodes.capacity >= bounds->nodes.count);
    KIRI_FROM_TO_WHILE(!sorts, t, bounds->order.count, count) {
        bounds->order.data[t] = t;
    }
    bounds->order.count = count;
    if (sorts) {
        SortTriangles(bounds, surface);
    }
    FitBoxes(bounds, surface, NULL);
}

/* Marks the nodes that have a vertex that is awake. */
static void MarkMoving(kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers)
{
    uint8_t* moves = bounds->moves.data;
    KIRI_ASSERT(bounds->moves.capacity >= bounds->nodes.count);
    KIRI_TIMES(level, bounds->levelCount) {
        KIRI_FROM_TO(node, bounds->firsts[level], EndOfLevel(bounds, level)) {
            int32_t first, end = LeafItems(bounds, level, node, &first);
            moves[node] = 0;
            KIRI_FROM_TO_WHILE(!moves[node], i, first, end) {
                int32_t vertex = level > 0 ? 0 : surface->indices.data[3 * bounds->order.data[i]];
                moves[node] = level > 0 ? moves[i] : movers->data[vertex / movers->block] != KIRI_NONE;
            }
        }
    }
    bounds->moves.count = bounds->nodes.count;
    bounds->version = movers->version;
}

bool kiriBounds_IsFresh(const kiriBounds* bounds, const kiriSurface* surface)
{
    return bounds->levelCount > 0 && bounds->pose == surface->pose;
}

bool kiriBounds_Update(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface)
{
    bounds->patience = KIRI_BOUNDS_PATIENCE;
    bool isFresh = kiriBounds_IsFresh(bounds, surface), ok = isFresh || ReserveTree(bounds, memory, surface->triangleCount);
    if (ok && !isFresh) {
        MakeTree(bounds, surface);
    }
    return ok;
}

void kiriBounds_Ask(const kiriBounds* bounds)
{
    if (kiriWord_Read(&bounds->asked) == 0) {
        kiriWord_Add(&bounds->asked, 1);
    }
}

/* Scratch of sorting is freed only here: an update may run in a task, which must not free. */
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
        return ReserveTree(bounds, memory, triangleCount);
    }
    kiriArray_Release(memory, &bounds->order);
    kiriArray_Release(memory, &bounds->nodes);
    kiriArray_Release(memory, &bounds->groups);
    kiriArray_Release(memory, &bounds->sides);
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
    if (!surface->isPartly || bounds->pose + 1 != surface->pose || bounds->levelCount == 0) { /* others moved, too */
        MakeTree(bounds, surface);
        return;
    }
    KIRI_ASSERT(bounds->order.count == surface->triangleCount && !NeedsSorting(bounds, surface->triangleCount));
    if (bounds->moves.count == 0 || bounds->version != movers->version) {
        MarkMoving(bounds, surface, movers);
    }
    FitBoxes(bounds, surface, bounds->moves.data);
}

kiriBox kiriBounds_All(const kiriBounds* bounds)
{
    KIRI_ASSERT(bounds->levelCount > 0 && bounds->nodes.count > 0);
    return bounds->nodes.data[bounds->nodes.count - 1];
}

/* ---- Search in all boxes that meet something --------------------------------------------------------------------- */

typedef struct BoxWalk BoxWalk;

/* Visits the triangles of a leaf. Returns false on out of memory. */
typedef bool VisitFn(const BoxWalk* walk, const int32_t* triangles, int32_t count);

struct BoxWalk {
    const kiriBounds* bounds;
    const uint8_t* moves; /* of each node: 0 if it is left out. Null: none is */
    kiriMeetsFn* meets;
    const void* space;
    VisitFn* visit;
    void* context;
};

static bool WalkNode(const BoxWalk* walk, int32_t level, int32_t node)
{
    if ((walk->moves != NULL && !walk->moves[node]) || !walk->meets(walk->space, &walk->bounds->nodes.data[node])) {
        return true;
    }
    int32_t first, end = LeafItems(walk->bounds, level, node, &first);
    if (level == 0) {
        return walk->visit(walk, &walk->bounds->order.data[first], end - first);
    }
    bool ok = true;
    KIRI_FROM_TO_WHILE(ok, i, first, end) {
        ok = WalkNode(walk, level - 1, i);
    }
    return ok;
}

static bool WalkTree(const BoxWalk* walk)
{
    int32_t root = walk->bounds->nodes.count - 1;
    return root < 0 || WalkNode(walk, walk->bounds->levelCount - 1, root);
}

typedef struct TriangleSearch {
    const kiriSurface* surface;
    bool takesBoxes;
    kiriMemory* memory;
    kiriIndices* found;
} TriangleSearch;

static bool PushTriangles(const BoxWalk* walk, const int32_t* triangles, int32_t count)
{
    const TriangleSearch* search = walk->context;
    bool ok = true;
    KIRI_TIMES_WHILE(ok, i, count) {
        bool isFound = !IsHidden(search->surface, triangles[i]);
        if (isFound && !search->takesBoxes) {
            kiriBox box = BoxOfLeaf(search->surface, &triangles[i], 1);
            isFound = walk->meets(walk->space, &box);
        }
        ok = !isFound || kiriArray_Push(search->memory, search->found, triangles[i]);
    }
    return ok;
}

bool kiriBounds_Find(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets, const void* context,
                     kiriMemory* memory, kiriIndices* found)
{
    int32_t before = found->count;
    bool ok = kiriBounds_FindMoving(bounds, surface, meets, context, false, 0, memory, found);
    if (ok && found->count > before) {
        kiriSort(found->data + before, found->count - before, NULL, NULL);
    }
    return ok;
}

bool kiriBounds_FindMoving(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets,
                           const void* context, bool takesBoxes, int64_t version, kiriMemory* memory,
                           kiriIndices* found)
{
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface));
    TriangleSearch search = { surface, takesBoxes, memory, found };
    const uint8_t* moves = bounds->moves.count > 0 && bounds->version == version ? bounds->moves.data : NULL;
    return WalkTree(&(BoxWalk){ bounds, moves, meets, context, PushTriangles, &search });
}

/* ---- The nearest triangle ---------------------------------------------------------------------------------------- */

/* Returns the group of a triangle, or KIRI_NONE if it is hidden. */
static int32_t GroupOf(const kiriSurface* surface, const int32_t* ofVertex, int32_t triangle)
{
    return IsHidden(surface, triangle) ? KIRI_NONE : ofVertex[surface->indices.data[3 * triangle]];
}

/* Writes the groups in each box. Returns the number of leaves that have several groups. */
static int32_t WriteGroups(kiriBounds* bounds, const kiriSurface* surface, const int32_t* ofVertex)
{
    int32_t mixed = 0;
    KIRI_TIMES(level, bounds->levelCount) {
        KIRI_FROM_TO(node, bounds->firsts[level], EndOfLevel(bounds, level)) {
            int32_t first, end = LeafItems(bounds, level, node, &first);
            uint64_t groups = 0;
            KIRI_FROM_TO(i, first, end) {
                int32_t group = level > 0 ? KIRI_NONE : GroupOf(surface, ofVertex, bounds->order.data[i]);
                groups |= level > 0 ? bounds->groups.data[i] : group >= 0 ? UINT64_C(1) << (group & 63) : 0;
            }
            bounds->groups.data[node] = groups;
            mixed += level == 0 && (groups & (groups - 1)) != 0;
        }
    }
    return mixed;
}

bool kiriBounds_Group(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface, const int32_t* ofVertex,
                      int32_t groupCount)
{
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface));
    int32_t count = surface->triangleCount;
    if (!kiriArray_Resize(memory, &bounds->groups, bounds->nodes.count)) {
        return false;
    }
    /* After a sort by group there are no more mixed leaves than groups. New triangles add some. */
    if (WriteGroups(bounds, surface, ofVertex) <= groupCount + count / LEAF_SIZE / 16) {
        return true;
    }
    if (!kiriArrays_Reserve(memory, count, &bounds->codes, &bounds->other)) {
        return false;
    }
    KIRI_TIMES(t, count) {
        bounds->codes.data[t] = (uint32_t)(GroupOf(surface, ofVertex, t) + 1);
    }
    SortByCodes(bounds, count);
    FitBoxes(bounds, surface, NULL);
    WriteGroups(bounds, surface, ofVertex);
    return true;
}

bool kiriBounds_FitSides(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface)
{
    const float* places = kiriSurface_Places(surface);
    int64_t leaves = EndOfLevel(bounds, 0);
    if (bounds->sides.count == 6 * LEAF_SIZE * leaves) {
        return true;
    }
    if (!kiriArray_Resize(memory, &bounds->sides, 6 * LEAF_SIZE * leaves)) {
        return false;
    }
    KIRI_TIMES(i, LEAF_SIZE * (int32_t)leaves) {
        float* low = &bounds->sides.data[6 * LEAF_SIZE * (i / LEAF_SIZE) + i % LEAF_SIZE];
        bool isTriangle = i < bounds->order.count && !IsHidden(surface, bounds->order.data[i]);
        const int32_t* v = kiriSurface_Triangle(surface, bounds->order.data[isTriangle ? i : 0]);
        const float *x = places + 3 * v[0], *y = places + 3 * v[1], *z = places + 3 * v[2];
        KIRI_TIMES(m, 3) {
            float least = kiriMin(x[m], y[m]), most = kiriMax(x[m], y[m]);
            low[LEAF_SIZE * m] = isTriangle ? kiriMin(z[m], least) : FLT_MAX;
            low[LEAF_SIZE * (m + 3)] = isTriangle ? kiriMax(z[m], most) : -FLT_MAX;
        }
    }
    return true;
}

typedef struct NearSearch {
    const kiriBounds* bounds;
    const kiriSurface* surface;
    kiriGroup group;
    kiriVec3 from, size; /* the lower corner of the box, and its sides */
    float near[2][3];    /* its corners, from surface->middle */
    double most, slack; /* m^2; m: by which distances to triangles may round up */
    kiriNearFn* look;
    void* context;
} NearSearch;

/* Takes the triangles of a leaf whose boxes are near enough: distances may round up by `slack`. */
static void SearchLeaf(NearSearch* search, int32_t leaf)
{
    const float* sides = &search->bounds->sides.data[6 * LEAF_SIZE * leaf];
    float squares[LEAF_SIZE];
    int32_t first, end = LeafItems(search->bounds, 0, leaf, &first);
    for (int i = 0; i < LEAF_SIZE; i += 4) {
        kiriLanes sum = kiriLanes_Splat(0.0f);
        KIRI_TIMES(m, 3) {
            const float *low = sides + LEAF_SIZE * m + i, *high = low + 3 * LEAF_SIZE;
            kiriLanes off = kiriLanes_Splat(0.0f);
            off = kiriLanes_Max(off, kiriLanes_Sub(kiriLanes_Load(low), kiriLanes_Splat(search->near[1][m])));
            off = kiriLanes_Max(off, kiriLanes_Sub(kiriLanes_Splat(search->near[0][m]), kiriLanes_Load(high)));
            sum = kiriLanes_Add(sum, kiriLanes_Mul(off, off));
        }
        kiriLanes_Store(squares + i, sum);
    }
    double within = sqrt(search->most) + search->slack;
    KIRI_FROM_TO(i, first, end) {
        int32_t triangle = search->bounds->order.data[i];
        if ((double)squares[i - first] <= within * within &&
            GroupOf(search->surface, search->group.ofVertex, triangle) == search->group.group) {
            search->most = search->look(search->context, triangle);
            within = sqrt(search->most) + search->slack;
        }
    }
}

/* Searches the children of a node, the nearest first. */
static void SearchNode(NearSearch* search, int32_t level, int32_t node)
{
    const double rounding = 1.0 + 1e-9; /* a box may round to be farther than its triangles */
    const kiriBounds* bounds = search->bounds;
    double squares[NODE_SIZE];
    int32_t first, end = LeafItems(bounds, level, node, &first);
    if (level == 0) {
        SearchLeaf(search, node);
        return;
    }
    KIRI_FROM_TO(i, first, end) {
        const kiriBox* box = &bounds->nodes.data[i];
        bool has = (bounds->groups.data[i] >> (search->group.group & 63) & 1) != 0;
        kiriVec3 at = kiriVec3_Most(kiriVec3_Least(search->from, box->upper), kiriVec3_Sub(box->lower, search->size));
        kiriVec3 off = kiriVec3_Sub(search->from, at);
        squares[i - first] = has ? kiriVec3_Dot(off, off) : DBL_MAX;
    }
    for (;;) {
        int32_t best = 0;
        KIRI_FROM_TO(i, 1, end - first) {
            best = squares[i] < squares[best] ? i : best;
        }
        if (squares[best] == DBL_MAX || squares[best] > search->most * rounding) {
            return;
        }
        squares[best] = DBL_MAX;
        SearchNode(search, level - 1, first + best);
    }
}

void kiriBounds_Nearest(const kiriBounds* bounds, const kiriSurface* surface, kiriGroup group, const kiriBox* around,
                        double most, kiriNearFn* look, void* context)
{
    NearSearch search = { bounds, surface, group, around->lower, kiriVec3_Sub(around->upper, around->lower), { { 0.0f } },
                          most, 0.0, look, context };
    kiriVec3_Store(search.near[0], kiriVec3_Sub(around->lower, surface->middle));
    kiriVec3_Store(search.near[1], kiriVec3_Sub(around->upper, surface->middle));
    search.slack = 4.0 * FLT_EPSILON * (kiriBox_Farthest(around, surface->middle) + sqrt(most));
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface) && bounds->groups.count == bounds->nodes.count);
    KIRI_ASSERT(bounds->sides.count > 0 || bounds->nodes.count == 0);
    KIRI_ASSERT(group.group >= 0);
    if (bounds->nodes.count > 0) {
        SearchNode(&search, bounds->levelCount - 1, bounds->nodes.count - 1);
    }
}

/* ---- Rays -------------------------------------------------------------------------------------------------------- */

typedef struct Ray {
    kiriVec3 origin, direction;
    double distance; /* in units of the direction; a search may shorten it */
    double slack;    /* by which boxes are enlarged: a hit is rounded, and the detail layer is beside the skin */
} Ray;

bool kiriBox_Clip(const kiriBox* box, double by, kiriVec3 from, kiriVec3 along, double* low, double* high)
{
    const double at[3] = { from.x, from.y, from.z }, way[3] = { along.x, along.y, along.z };
    const double lower[3] = { box->lower.x, box->lower.y, box->lower.z };
    const double upper[3] = { box->upper.x, box->upper.y, box->upper.z };
    KIRI_TIMES(k, 3) {
        double below = lower[k] - by - at[k], above = upper[k] + by - at[k];
        if (way[k] == 0.0) {
            *high = below > 0.0 || above < 0.0 ? *low - 1.0 : *high;
            continue;
        }
        double enter = (way[k] > 0.0 ? below : above) / way[k], leave = (way[k] > 0.0 ? above : below) / way[k];
        *low = kiriMax(enter, *low);
        *high = kiriMin(leave, *high);
    }
    return *low <= *high;
}

static bool MeetsRay(const void* context, const kiriBox* box)
{
    const Ray* ray = context;
    double from = -ray->slack, to = ray->distance + ray->slack;
    return kiriBox_Clip(box, ray->slack, ray->origin, ray->direction, &from, &to);
}

void kiriTriangle_Nearest(const kiriVec3 corner[3], kiriVec3 p, double share[3])
{
    /* By the Voronoi regions of corners, sides and the inside (Ericson, Real-Time Collision Detection, 5.1.5). */
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    double d[3][2], on[3];
    KIRI_TIMES(k, 3) {
        kiriVec3 to = kiriVec3_Sub(p, corner[k]);
        d[k][0] = kiriVec3_Dot(ab, to);
        d[k][1] = kiriVec3_Dot(ac, to);
    }
    on[0] = d[1][0] * d[2][1] - d[2][0] * d[1][1];
    on[1] = d[2][0] * d[0][1] - d[0][0] * d[2][1];
    on[2] = d[0][0] * d[1][1] - d[1][0] * d[0][1];
    double ahead = d[1][1] - d[1][0], back = d[2][0] - d[2][1], sum = on[0] + on[1] + on[2];
    share[0] = share[1] = share[2] = 0.0;
    if (d[0][0] <= 0.0 && d[0][1] <= 0.0) {
        share[0] = 1.0;
    } else if (d[1][0] >= 0.0 && ahead <= 0.0) {
        share[1] = 1.0;
    } else if (d[2][1] >= 0.0 && back <= 0.0) {
        share[2] = 1.0;
    } else if (on[2] <= 0.0 && d[0][0] > 0.0 && d[1][0] <= 0.0) {
        share[1] = d[0][0] / (d[0][0] - d[1][0]);
        share[0] = 1.0 - share[1];
    } else if (on[1] <= 0.0 && d[0][1] >= 0.0 && d[2][1] <= 0.0) {
        share[2] = d[0][1] / (d[0][1] - d[2][1]);
        share[0] = 1.0 - share[2];
    } else if (on[0] <= 0.0 && ahead >= 0.0 && back >= 0.0) {
        share[2] = ahead / (ahead + back);
        share[1] = 1.0 - share[2];
    } else {
        KIRI_TIMES(k, 3) {
            share[k] = on[k] / sum;
        }
    }
}

bool kiriTriangle_Cross(const kiriVec3 corner[3], kiriVec3 from, kiriVec3 along, double* way, double share[3])
{
    /* Moeller and Trumbore 1997 */
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec3 to = kiriVec3_Sub(from, corner[0]), across = kiriVec3_Cross(along, ac), other = kiriVec3_Cross(to, ab);
    double determinant = kiriVec3_Dot(ab, across);
    if (!(fabs(determinant) > 0.0)) {
        return false;
    }
    share[1] = kiriVec3_Dot(to, across) / determinant;
    share[2] = kiriVec3_Dot(along, other) / determinant;
    share[0] = 1.0 - share[1] - share[2];
    *way = kiriVec3_Dot(ac, other) / determinant;
    return share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0;
}

typedef struct RaySearch {
    const kiriSurface* surface;
    Ray ray;
    int32_t triangle; /* the first hit so far, or KIRI_NONE */
    double share[3];
} RaySearch;

static void GetDrawnCorners(const kiriSurface* surface, int32_t triangle, kiriVec3 corner[3])
{
    KIRI_TIMES(k, 3) {
        corner[k] = kiriSurface_DrawnAt(surface, kiriSurface_Triangle(surface, triangle)[k]);
    }
}

/* The result does not depend on the order of triangles. */
static bool FindFirstHit(const BoxWalk* walk, const int32_t* triangles, int32_t count)
{
    RaySearch* search = walk->context;
    KIRI_TIMES(i, count) {
        kiriVec3 corner[3];
        double way, share[3];
        GetDrawnCorners(search->surface, triangles[i], corner);
        if (kiriTriangle_Cross(corner, search->ray.origin, search->ray.direction, &way, share) && way >= 0.0 &&
            (way < search->ray.distance || (way == search->ray.distance && triangles[i] > search->triangle))) {
            search->ray.distance = way;
            search->triangle = triangles[i];
            memcpy(search->share, share, sizeof(share));
        }
    }
    return true;
}

void kiriSurface_Raycast(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction,
                         double maxDistance, kiriHit* hit)
{
    RaySearch search = { surface, { origin, direction, maxDistance, 0.0 }, KIRI_NONE, { 0.0 } };
    const BoxWalk walk = { bounds, NULL, MeetsRay, &search.ray, FindFirstHit, &search };
    KIRI_CLEAR(hit);
    hit->triangle = KIRI_NONE;
    if (kiriBounds_IsFresh(bounds, surface)) {
        if (bounds->nodes.count > 0) {
            kiriBox all = kiriBounds_All(bounds);
            kiriBox_Add(&all, origin);
            search.ray.slack = 1e-9 * kiriBox_Farthest(&all, (kiriVec3){ 0 }) + surface->detail.longest;
        }
        (void)WalkTree(&walk);
    } else {
        KIRI_TIMES(t, surface->triangleCount) {
            FindFirstHit(&walk, &t, 1);
        }
    }
    if (search.triangle == KIRI_NONE) {
        return;
    }
    kiriVec3 corner[3];
    GetDrawnCorners(surface, search.triangle, corner);
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    const int32_t* v = kiriSurface_Triangle(surface, search.triangle);
    kiriVec2 rest = surface->origin;
    KIRI_TIMES(k, 3) {
        rest = kiriVec2_AddScaled(rest, search.share[k], surface->rest.data[v[k]]);
    }
    kiriVec2_Store(hit->restPoint, rest);
    kiriVec3_Store(hit->position,
                   kiriVec3_AddScaled(kiriVec3_AddScaled(corner[0], search.share[1], ab), search.share[2], ac));
    kiriVec3_Store(hit->normal, kiriVec3_Normalize(kiriVec3_Cross(ab, ac)));
    hit->distance = (float)search.ray.distance;
    hit->triangle = search.triangle;
}
