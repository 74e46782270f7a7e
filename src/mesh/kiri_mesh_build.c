#include "kiri_mesh_build.h"
#include "kiri_mesh.h"

#include <string.h>

/* Those that stay are listed by the cells of a grid, which are as wide as the distance: so each cell has a few at most,
   and all that are near a vertex are in its cell and the eight around it. Open addressing, in the order of vertices: the
   same on every machine. */
typedef struct WeldGrid {
    const kiriLatticePoint* at;
    int64_t side;       /* lattice steps of a cell */
    double nearSquared; /* lattice steps, squared */
    int64_t mask;       /* slots less 1 */
    int32_t* slots;     /* the last vertex of a cell that stays, or KIRI_NONE */
    int32_t* previous;  /* of each vertex that stays: the one before in its cell, or KIRI_NONE */
} WeldGrid;

static int64_t SlotOf(const WeldGrid* grid, int64_t column, int64_t row)
{
    uint64_t hash = ((uint64_t)column << 32 ^ (uint64_t)row) * 0x9E3779B97F4A7C15u;
    int64_t i = (int64_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32) & grid->mask;
    for (int32_t v = grid->slots[i]; v != KIRI_NONE; v = grid->slots[i]) {
        if (grid->at[v].x / grid->side == column && grid->at[v].y / grid->side == row) {
            break;
        }
        i = (i + 1) & grid->mask;
    }
    return i;
}

/* The nearest that stays, or KIRI_NONE. */
static int32_t FindNearKept(const WeldGrid* grid, int32_t vertex)
{
    kiriLatticePoint at = grid->at[vertex];
    int32_t found = KIRI_NONE;
    int64_t nearest = 0;
    for (int k = 0; k < 9; ++k) {
        int64_t slot = SlotOf(grid, at.x / grid->side + k % 3 - 1, at.y / grid->side + k / 3 - 1);
        for (int32_t v = grid->slots[slot]; v != KIRI_NONE; v = grid->previous[v]) {
            int64_t distance = kiriDistanceSquared(grid->at[v], at);
            bool isNearer = found == KIRI_NONE || distance < nearest || (distance == nearest && v < found);
            if ((double)distance < grid->nearSquared && isNearer) {
                found = v;
                nearest = distance;
            }
        }
    }
    return found;
}

static bool MakeGrid(WeldGrid* grid, const kiriLatticePoint* at, int32_t count, double distance, kiriMemory* memory)
{
    const double widest = 1 << 30;
    int64_t size = 16;
    while (size < 2 * (int64_t)count) {
        size *= 2;
    }
    grid->at = at;
    grid->side = distance < 2.0 ? 2 : distance < widest ? (int64_t)distance + 1 : (int64_t)widest;
    grid->nearSquared = distance * distance;
    grid->mask = size - 1;
    grid->slots = kiriMemory_Alloc(memory, size * (int64_t)sizeof(int32_t));
    grid->previous = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    for (int64_t i = 0; grid->slots != NULL && i < size; ++i) {
        grid->slots[i] = KIRI_NONE;
    }
    return grid->slots != NULL && grid->previous != NULL;
}

bool kiriWeld_Find(const kiriLatticePoint* at, int32_t count, double distance, int32_t* to, kiriMemory* memory)
{
    WeldGrid grid = { NULL, 0, 0.0, 0, NULL, NULL };
    bool ok = MakeGrid(&grid, at, count, distance, memory);
    for (int32_t v = 0; ok && v < count; ++v) {
        int32_t near = to[v] != KIRI_NONE ? FindNearKept(&grid, v) : KIRI_NONE;
        if (to[v] != KIRI_NONE && near == KIRI_NONE) {
            int64_t slot = SlotOf(&grid, at[v].x / grid.side, at[v].y / grid.side);
            grid.previous[v] = grid.slots[slot];
            grid.slots[slot] = v;
            near = v;
        }
        to[v] = near;
    }
    kiriMemory_Free(memory, grid.slots);
    kiriMemory_Free(memory, grid.previous);
    return ok;
}

/* Where the mesh has one outline that nowhere meets itself, it covers what that surrounds, once: all edges but those of
   the outline have a triangle on either side. So most often the outline alone is looked at, else all triangles.

   A tree of boxes. The triangles, or edges, of a node are halved in the middle of where the centres of their boxes are,
   across its longer side: so a crowd in a corner is parted as well as one that fills the sheet. Coordinates have 30
   bits, so no branch is longer than 60 nodes and a few. */

enum {
    OVERLAP_TOLERANCE = 64, /* lattice steps that triangles may intrude on each other: the input is float */
    LATTICE_ROUNDING = 2,   /* lattice steps: by as much they always may */
    MOST_IN_LEAF = 4
};

typedef struct OverlapBox {
    kiriLatticePoint low, high;
} OverlapBox;

typedef struct OverlapItem {
    OverlapBox box;
    int32_t index; /* of a triangle or half-edge */
} OverlapItem;

typedef struct OverlapNode {
    OverlapBox box;
    int32_t first, end; /* its items */
    int32_t child;      /* the first of two, or KIRI_NONE in a leaf */
} OverlapNode;

typedef struct OverlapTree {
    const kiriMeshData* mesh;
    bool ofEdges;
    OverlapItem* items;
    OverlapNode* nodes;
    int32_t nodeCount;
    int32_t pair[2]; /* the first two items that were found to overlap */
} OverlapTree;

/* ---- Two triangles ---- */

/* The most that b may intrude on a over its edge from p to q: what the tolerance says, but no more than half of the
   height of a and half of the width of b. Else triangles that are as small as the tolerance might lie on each other. */
static int64_t MostIntrusion(kiriLatticePoint p, kiriLatticePoint q, int64_t area, int64_t outer)
{
    int64_t length =
        (q.x > p.x ? (int64_t)q.x - p.x : (int64_t)p.x - q.x) + (q.y > p.y ? (int64_t)q.y - p.y : (int64_t)p.y - q.y);
    int64_t most = OVERLAP_TOLERANCE * length, least = LATTICE_ROUNDING * length;
    most = kiriMin(most, area / 2);
    most = kiriMin(most, -outer);
    return kiriMax(most, least);
}

/* Is triangle b on the outer side of an edge of triangle a, but for the tolerance? */
static bool EdgeSeparates(const kiriLatticePoint a[3], const kiriLatticePoint b[3])
{
    int64_t area = kiriOrient(a[0], a[1], a[2]);
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint p = a[i], q = a[(i + 1) % 3];
        int64_t inner = kiriOrient(p, q, b[0]), outer = inner;
        for (int k = 1; k < 3; ++k) {
            int64_t above = kiriOrient(p, q, b[k]);
            inner = kiriMax(above, inner);
            outer = kiriMin(above, outer);
        }
        if (inner <= MostIntrusion(p, q, area, outer)) {
            return true;
        }
    }
    return false;
}

/* Boxes that only touch hold no triangles that overlap. */
static bool BoxesOverlap(const OverlapBox* a, const OverlapBox* b)
{
    return a->low.x < b->high.x && b->low.x < a->high.x && a->low.y < b->high.y && b->low.y < a->high.y;
}

static bool TrianglesOverlap(const kiriMeshData* mesh, int32_t a, int32_t b)
{
    kiriLatticePoint c[3], d[3];
    kiriMesh_Corners(mesh, a, c);
    kiriMesh_Corners(mesh, b, d);
    return !EdgeSeparates(c, d) && !EdgeSeparates(d, c);
}

/* ---- Two edges of an outline ---- */

static kiriLatticePoint TailOf(const kiriMeshData* mesh, int32_t h)
{
    return mesh->vertices.data[kiriMesh_Tail(mesh, h)].at;
}

static bool AreAtOnePoint(kiriLatticePoint a, kiriLatticePoint b)
{
    return a.x == b.x && a.y == b.y;
}

/* Of three points on a line: is the second between the others? */
static bool IsBetween(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint c)
{
    return ((int64_t)b.x - a.x) * ((int64_t)c.x - b.x) + ((int64_t)b.y - a.y) * ((int64_t)c.y - b.y) > 0;
}

/* Are both ends of b strictly on one side of the line through a? */
static bool LineSeparates(const kiriLatticePoint a[2], const kiriLatticePoint b[2])
{
    int64_t from = kiriOrient(a[0], a[1], b[0]), to = kiriOrient(a[0], a[1], b[1]);
    return (from > 0 && to > 0) || (from < 0 && to < 0);
}

/* Do they meet elsewhere than where one follows the other around a bend? Where in doubt, they do. */
static bool EdgesMeet(const kiriMeshData* mesh, int32_t g, int32_t h)
{
    kiriLatticePoint a[2] = { TailOf(mesh, g), TailOf(mesh, kiriEdge_Next(g)) };
    kiriLatticePoint b[2] = { TailOf(mesh, h), TailOf(mesh, kiriEdge_Next(h)) };
    if (AreAtOnePoint(a[1], b[0])) {
        return kiriOrient(a[0], a[1], b[1]) == 0 && !IsBetween(a[0], a[1], b[1]);
    }
    if (AreAtOnePoint(b[1], a[0])) {
        return kiriOrient(b[0], b[1], a[1]) == 0 && !IsBetween(b[0], b[1], a[1]);
    }
    return !LineSeparates(a, b) && !LineSeparates(b, a);
}

/* ---- The tree ---- */

static bool ItemsOverlap(const OverlapTree* tree, const OverlapItem* a, const OverlapItem* b)
{
    return BoxesOverlap(&a->box, &b->box) &&
           (tree->ofEdges ? EdgesMeet : TrianglesOverlap)(tree->mesh, a->index, b->index);
}

static kiriLatticePoint LowerCorner(kiriLatticePoint a, kiriLatticePoint b)
{
    return (kiriLatticePoint){ kiriMin(a.x, b.x), kiriMin(a.y, b.y) };
}

static kiriLatticePoint UpperCorner(kiriLatticePoint a, kiriLatticePoint b)
{
    return (kiriLatticePoint){ kiriMax(a.x, b.x), kiriMax(a.y, b.y) };
}

static OverlapItem ItemOfTriangle(const kiriMeshData* mesh, int32_t triangle)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, triangle, c);
    OverlapItem item = { { LowerCorner(c[0], LowerCorner(c[1], c[2])), UpperCorner(c[0], UpperCorner(c[1], c[2])) },
                         triangle };
    return item;
}

/* With a margin: boxes of edges that touch overlap. */
static OverlapItem ItemOfEdge(const kiriMeshData* mesh, int32_t h)
{
    kiriLatticePoint a = TailOf(mesh, h), b = TailOf(mesh, kiriEdge_Next(h)), low = LowerCorner(a, b),
                     high = UpperCorner(a, b);
    OverlapItem item = { { { low.x - 1, low.y - 1 }, { high.x + 1, high.y + 1 } }, h };
    return item;
}

/* Twice where its middle is. Coordinates of the caller's triangles are not negative, and below 2^30. */
static int32_t DoubledMiddle(const OverlapItem* item, bool alongX)
{
    return alongX ? item->box.low.x + item->box.high.x : item->box.low.y + item->box.high.y;
}

/* The box of the items of a node, and that of the middles of theirs, doubled. */
static OverlapBox BoxItems(const OverlapTree* tree, OverlapNode* node)
{
    node->box = tree->items[node->first].box;
    kiriLatticePoint middle = { DoubledMiddle(&tree->items[node->first], true),
                                DoubledMiddle(&tree->items[node->first], false) };
    OverlapBox middles = { middle, middle };
    for (int32_t i = node->first + 1; i < node->end; ++i) {
        const OverlapItem* item = &tree->items[i];
        middle = (kiriLatticePoint){ DoubledMiddle(item, true), DoubledMiddle(item, false) };
        middles = (OverlapBox){ LowerCorner(middles.low, middle), UpperCorner(middles.high, middle) };
        node->box =
            (OverlapBox){ LowerCorner(node->box.low, item->box.low), UpperCorner(node->box.high, item->box.high) };
    }
    return middles;
}

/* Puts the items whose middle is not above `most` before the others; the first of the others. */
static int32_t PartItems(const OverlapTree* tree, const OverlapNode* node, bool alongX, int32_t most)
{
    int32_t low = node->first, high = node->end;
    while (low < high) {
        OverlapItem item = tree->items[low];
        if (DoubledMiddle(&item, alongX) <= most) {
            ++low;
        } else {
            tree->items[low] = tree->items[--high];
            tree->items[high] = item;
        }
    }
    return low;
}

/* A leaf where all middles are the same point. */
static void MakeNode(OverlapTree* tree, int32_t index)
{
    OverlapNode* node = &tree->nodes[index];
    OverlapBox middles = BoxItems(tree, node);
    int32_t width = middles.high.x - middles.low.x, height = middles.high.y - middles.low.y;
    bool alongX = width > height;
    node->child = KIRI_NONE;
    if (node->end - node->first > MOST_IN_LEAF && (width > 0 || height > 0)) {
        int32_t most = alongX ? middles.low.x + width / 2 : middles.low.y + height / 2;
        int32_t split = PartItems(tree, node, alongX, most);
        node->child = tree->nodeCount;
        tree->nodeCount += 2;
        tree->nodes[node->child] = (OverlapNode){ node->box, node->first, split, KIRI_NONE };
        tree->nodes[node->child + 1] = (OverlapNode){ node->box, split, node->end, KIRI_NONE };
        MakeNode(tree, node->child);
        MakeNode(tree, node->child + 1);
    }
}

/* ---- Pairs ---- */

/* Of two leaves, or of one with itself. */
static bool LeavesOverlap(OverlapTree* tree, const OverlapNode* a, const OverlapNode* b)
{
    for (int32_t i = a->first; i < a->end; ++i) {
        for (int32_t j = a == b ? i + 1 : b->first; j < b->end; ++j) {
            if (ItemsOverlap(tree, &tree->items[i], &tree->items[j])) {
                tree->pair[0] = tree->items[i].index;
                tree->pair[1] = tree->items[j].index;
                return true;
            }
        }
    }
    return false;
}

static bool NodesOverlap(OverlapTree* tree, const OverlapNode* a, const OverlapNode* b)
{
    if (a != b && !BoxesOverlap(&a->box, &b->box)) {
        return false;
    }
    if (a->child == KIRI_NONE && b->child == KIRI_NONE) {
        return LeavesOverlap(tree, a, b);
    }
    if (a == b) {
        const OverlapNode* child = &tree->nodes[a->child];
        return NodesOverlap(tree, child, child) || NodesOverlap(tree, child + 1, child + 1) ||
               NodesOverlap(tree, child, child + 1);
    }
    bool splitsA = b->child == KIRI_NONE || (a->child != KIRI_NONE && a->end - a->first > b->end - b->first);
    const OverlapNode* child = &tree->nodes[splitsA ? a->child : b->child];
    const OverlapNode* other = splitsA ? b : a;
    return NodesOverlap(tree, child, other) || NodesOverlap(tree, child + 1, other);
}

/* Of items that are listed. */
static bool AnyOverlap(OverlapTree* tree, int32_t count)
{
    tree->nodes[0] = (OverlapNode){ { { 0, 0 }, { 0, 0 } }, 0, count, KIRI_NONE };
    tree->nodeCount = 1;
    MakeNode(tree, 0);
    return NodesOverlap(tree, &tree->nodes[0], &tree->nodes[0]);
}

static bool MakeTree(OverlapTree* tree, kiriMemory* memory, int64_t count)
{
    tree->items = kiriMemory_Alloc(memory, count * (int64_t)sizeof(OverlapItem));
    tree->nodes = kiriMemory_Alloc(memory, 2 * count * (int64_t)sizeof(OverlapNode));
    return tree->items != NULL && tree->nodes != NULL;
}

static void FreeTree(OverlapTree* tree, kiriMemory* memory)
{
    kiriMemory_Free(memory, tree->items);
    kiriMemory_Free(memory, tree->nodes);
}

/* The next edge around the outline. */
static int32_t NextOfOutline(const kiriMeshData* mesh, int32_t h)
{
    h = kiriEdge_Next(h);
    for (int32_t twin = kiriMesh_Twin(mesh, h); twin != KIRI_NONE; twin = kiriMesh_Twin(mesh, h)) {
        h = kiriEdge_Next(twin);
    }
    return h;
}

/* The edges of the outline. Are they one loop? */
static bool IsOneLoop(const kiriMeshData* mesh, int32_t* first, int32_t* count)
{
    int32_t edges = 0;
    *first = KIRI_NONE;
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        bool isOutline = kiriMesh_Twin(mesh, h) == KIRI_NONE;
        edges += isOutline;
        *first = isOutline ? h : *first;
    }
    *count = *first != KIRI_NONE;
    for (int32_t h = *first; h != KIRI_NONE && (h = NextOfOutline(mesh, h)) != *first;) {
        *count += 1;
    }
    return edges > 0 && *count == edges;
}

/* One outline that nowhere meets itself? False for memory. */
static bool LookAtOutline(const kiriMeshData* mesh, kiriMemory* memory, bool* isSimple)
{
    OverlapTree tree = { mesh, true, NULL, NULL, 0, { KIRI_NONE, KIRI_NONE } };
    int32_t first, count;
    *isSimple = false;
    if (!IsOneLoop(mesh, &first, &count)) {
        return true;
    }
    bool fine = MakeTree(&tree, memory, count);
    if (fine) {
        for (int32_t k = 0, h = first; k < count; ++k, h = NextOfOutline(mesh, h)) {
            tree.items[k] = ItemOfEdge(mesh, h);
        }
        *isSimple = !AnyOverlap(&tree, count);
    }
    FreeTree(&tree, memory);
    return fine;
}

static bool LookAtTriangles(const kiriMeshData* mesh, kiriMemory* memory, int32_t pair[2])
{
    OverlapTree tree = { mesh, false, NULL, NULL, 0, { KIRI_NONE, KIRI_NONE } };
    int32_t count = mesh->triangles.count;
    bool fine = MakeTree(&tree, memory, count);
    if (fine) {
        for (int32_t t = 0; t < count; ++t) {
            tree.items[t] = ItemOfTriangle(mesh, t);
        }
        (void)AnyOverlap(&tree, count);
        bool isAscending = tree.pair[0] < tree.pair[1];
        pair[0] = tree.pair[isAscending ? 0 : 1];
        pair[1] = tree.pair[isAscending ? 1 : 0];
    }
    FreeTree(&tree, memory);
    return fine;
}

bool kiriOverlap_Find(const kiriMeshData* mesh, kiriMemory* memory, int32_t pair[2])
{
    bool isSimple;
    pair[0] = pair[1] = KIRI_NONE;
    return LookAtOutline(mesh, memory, &isSimple) && (isSimple || LookAtTriangles(mesh, memory, pair));
}

/* The caller's triangles, of which all others are parts: where their corners are. */

/* ---- Corners ----------------------------------------------------------------------------------------------------- */

/* In a list of ascending numbers, `stride` bytes apart: the first that is not below `number`. */
static int32_t FirstFrom(const int32_t* numbers, size_t stride, int32_t count, int32_t number)
{
    int32_t low;
    KIRI_SEARCH(low, 0, count, *(const int32_t*)(const void*)((const char*)numbers + stride * (size_t)middle) < number);
    return low;
}

/* The triangle that the caller gave, or what splits have left in its place; KIRI_NONE where it is gone. It has its
   number as long as none before it has gone. */
static int32_t FindOriginal(const kiriMeshData* mesh, int32_t source)
{
    const kiriTriangle* triangles = mesh->triangles.data;
    int32_t count = mesh->originals, t = source;
    if (t < 0 || count == 0) {
        return KIRI_NONE;
    }
    if (t >= count || triangles[t].source != source) {
        t = FirstFrom(&triangles->source, sizeof(kiriTriangle), count, source);
    }
    return t < count && triangles[t].source == source && kiriMesh_IsTriangle(mesh, t) ? t : KIRI_NONE;
}

/* Those of a triangle that is there, unless it has been split. */
static bool FindCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3])
{
    int32_t t = FindOriginal(mesh, source);
    if (t != KIRI_NONE) {
        kiriMesh_Corners(mesh, t, corners);
    }
    return t != KIRI_NONE;
}

/* Where the corners are stored, or KIRI_NONE. */
static int64_t StoredAt(const kiriMeshData* mesh, int32_t source)
{
    if (mesh->sources.count > 0) {
        int32_t k = FirstFrom(mesh->sources.data, sizeof(int32_t), mesh->sources.count, source);
        return k < mesh->sources.count && mesh->sources.data[k] == source ? 3 * (int64_t)k : KIRI_NONE;
    }
    int32_t k = source >= 0 ? source / KIRI_SOURCES_A_BLOCK : KIRI_NONE;
    int32_t block = k >= 0 && k < mesh->sourceBlocks.count ? mesh->sourceBlocks.data[k] : KIRI_NONE;
    return block == KIRI_NONE ? KIRI_NONE : 3 * ((int64_t)block * KIRI_SOURCES_A_BLOCK + source % KIRI_SOURCES_A_BLOCK);
}

/* In a block, those that were gone when it was made are one point. */
bool kiriMesh_SourceCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3])
{
    int64_t at = StoredAt(mesh, source);
    if (at == KIRI_NONE) {
        return FindCorners(mesh, source, corners);
    }
    memcpy(corners, &mesh->sourceCorners.data[at], 3 * sizeof(kiriLatticePoint));
    return corners[0].x != corners[1].x || corners[0].y != corners[1].y;
}

bool kiriMesh_HasSource(const kiriMeshData* mesh, int32_t triangle)
{
    int32_t source = mesh->triangles.data[triangle].source;
    kiriLatticePoint corners[3];
    return kiriMesh_SourceCorners(mesh, source, corners) &&
           (StoredAt(mesh, source) != KIRI_NONE || FindOriginal(mesh, source) == triangle);
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

bool kiriMesh_KeepSource(kiriMeshData* mesh, int32_t triangle)
{
    enum { BLOCK_CORNERS = 3 * KIRI_SOURCES_A_BLOCK };
    int32_t k = mesh->triangles.data[triangle].source / KIRI_SOURCES_A_BLOCK, count = mesh->sourceCorners.count;
    if (mesh->sources.count > 0 || mesh->sourceBlocks.data[k] != KIRI_NONE) {
        return true;
    }
    if (!kiriArray_Resize(mesh->memory, &mesh->sourceCorners, (int64_t)count + BLOCK_CORNERS)) {
        return false;
    }
    kiriLatticePoint* corners = &mesh->sourceCorners.data[count];
    memset(corners, 0, BLOCK_CORNERS * sizeof(*corners));
    for (int32_t i = 0; i < KIRI_SOURCES_A_BLOCK; ++i) {
        FindCorners(mesh, KIRI_SOURCES_A_BLOCK * k + i, corners + 3 * (ptrdiff_t)i);
    }
    mesh->sourceBlocks.data[k] = count / BLOCK_CORNERS;
    return true;
}

void kiriMesh_RollbackSources(kiriMeshData* mesh)
{
    for (int32_t i = 0; i < mesh->savedTriangles.count && mesh->sources.count == 0; ++i) {
        int32_t* block = &mesh->sourceBlocks.data[mesh->savedTriangles.data[i].was.source / KIRI_SOURCES_A_BLOCK];
        *block = 3 * KIRI_SOURCES_A_BLOCK * (int64_t)*block < mesh->oldSourceCorners ? *block : KIRI_NONE;
    }
    mesh->sourceCorners.count = mesh->oldSourceCorners;
}

/* ---- Shares ------------------------------------------------------------------------------------------------------ */

/* Shares on the nearest edge, for a point that rounding has put beside the triangle. Areas do not tell it where the
   triangle is a sliver. */
static void ShareNearestEdge(const kiriLatticePoint c[3], kiriLatticePoint at, double share[3])
{
    double nearest = 0.0;
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint a = c[i], b = c[(i + 1) % 3];
        double x = (double)b.x - a.x, y = (double)b.y - a.y, u = (double)at.x - a.x, v = (double)at.y - a.y;
        double along = (u * x + v * y) / (x * x + y * y);
        along = kiriClamp(along, 0.0, 1.0);
        double du = u - along * x, dv = v - along * y, distance = du * du + dv * dv;
        if (i == 0 || distance < nearest) {
            nearest = distance;
            share[i] = 1.0 - along;
            share[(i + 1) % 3] = along;
            share[(i + 2) % 3] = 0.0;
        }
    }
}

void kiriMesh_SetSource(kiriMeshData* mesh, int32_t vertex, int32_t source)
{
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
    mesh->vertices.data[vertex].source = source;
}

void kiriMesh_GetShare(const kiriMeshData* mesh, int32_t vertex, float to[3])
{
    kiriMesh_GetShareIn(mesh, vertex, mesh->vertices.data[vertex].source, to);
}

void kiriMesh_GetShareIn(const kiriMeshData* mesh, int32_t vertex, int32_t source, float to[3])
{
    const kiriVertex* v = &mesh->vertices.data[vertex];
    kiriLatticePoint c[3];
    bool isThere = kiriMesh_SourceCorners(mesh, source, c);
    KIRI_ASSERT(isThere);
    (void)isThere;
    double share[3], sum = 0.0;
    bool isInside = true;
    for (int i = 0; i < 3; ++i) {
        share[i] = (double)kiriOrient(c[(i + 1) % 3], c[(i + 2) % 3], v->at);
        isInside = isInside && share[i] >= 0.0;
        sum += share[i];
    }
    if (!isInside) {
        ShareNearestEdge(c, v->at, share);
        sum = 1.0;
    }
    for (int i = 0; i < 3; ++i) {
        to[i] = (float)(share[i] / sum);
    }
}

static kiriResult CheckInput(const kiriMeshInput* input, kiriFault* fault)
{
    if (input->positions == NULL || input->indices == NULL) {
        KIRI_SAY(fault, "restPositions or indices is null");
    } else if (input->vertexCount < 3 || input->triangleCount < 1 || input->triangleCount > KIRI_MOST_TRIANGLES) {
        KIRI_SAY(fault, "vertexCount or triangleCount is out of range");
    } else if (input->resolution < 1 || input->resolution > 4096) {
        KIRI_SAY(fault, "gridResolution is not 1 to 4096");
    }
    for (int64_t i = 0; fault->line[0] == '\0' && i < 2 * (int64_t)input->vertexCount; ++i) {
        if (!(input->positions[i] - input->positions[i] == 0.0f)) {
            KIRI_SAY(fault, "the rest position of vertex %lld is not finite", (long long)(i / 2));
        }
    }
    for (int64_t i = 0; fault->line[0] == '\0' && i < 3 * (int64_t)input->triangleCount; ++i) {
        if (input->indices[i] < 0 || input->indices[i] >= input->vertexCount) {
            KIRI_SAY(fault, "triangle %lld has vertex %lld, which is not within 0 and %lld", (long long)(i / 3),
                     (long long)input->indices[i], (long long)input->vertexCount - 1);
        }
    }
    return fault->line[0] == '\0' ? KIRI_OK : KIRI_ERROR_ARGUMENT;
}

/* ---- Vertices ---- */

/* The caller's vertices: one entry each. */
typedef struct Welded {
    kiriLatticePoint* at;
    int32_t* to;     /* the one that it becomes; KIRI_NONE: no triangle has it */
    int32_t* number; /* its index in the mesh; KIRI_NONE: no triangle that is left has it */
} Welded;

static bool MakeWelded(Welded* welded, const kiriMeshInput* input, kiriMemory* scratch)
{
    int64_t count = input->vertexCount;
    welded->at = kiriMemory_Alloc(scratch, count * (int64_t)sizeof(kiriLatticePoint));
    welded->to = kiriMemory_Alloc(scratch, count * (int64_t)sizeof(int32_t));
    welded->number = kiriMemory_Alloc(scratch, count * (int64_t)sizeof(int32_t));
    if (welded->at == NULL || welded->to == NULL || welded->number == NULL) {
        return false;
    }
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        welded->to[v] = welded->number[v] = KIRI_NONE;
    }
    for (int64_t i = 0; i < 3 * (int64_t)input->triangleCount; ++i) {
        welded->to[input->indices[i]] = input->indices[i];
    }
    return true;
}

/* Of the vertices that a triangle has. *extent is the upper corner. */
static kiriResult PlaceVertices(kiriMeshData* mesh, const kiriMeshInput* input, const Welded* welded,
                                kiriLatticePoint* extent, kiriFault* fault)
{
    double low[2], high[2];
    int32_t first = 0;
    while (welded->to[first] == KIRI_NONE) {
        ++first;
    }
    for (int axis = 0; axis < 2; ++axis) {
        low[axis] = high[axis] = input->positions[2 * (int64_t)first + axis];
        for (int32_t v = first + 1; v < input->vertexCount; ++v) {
            double x = input->positions[2 * (int64_t)v + axis];
            low[axis] = welded->to[v] != KIRI_NONE && x < low[axis] ? x : low[axis];
            high[axis] = welded->to[v] != KIRI_NONE && x > high[axis] ? x : high[axis];
        }
    }
    double width = high[0] - low[0], height = high[1] - low[1];
    mesh->origin = kiriVec2_Make(low[0], low[1]);
    mesh->step = kiriMax(width, height) / KIRI_LATTICE;
    if (!(mesh->step > 0.0)) {
        KIRI_SAY(fault, "triangle 0 has no area: all rest positions are the same point");
        return KIRI_ERROR_MESH;
    }
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        const float* p = &input->positions[2 * (int64_t)v];
        if (welded->to[v] != KIRI_NONE) {
            welded->at[v] = kiriMesh_Snap(mesh, kiriVec2_Sub(kiriVec2_Make(p[0], p[1]), mesh->origin));
        }
    }
    *extent = kiriMesh_Snap(mesh, kiriVec2_Make(width, height));
    return KIRI_OK;
}

/* The vertices that a triangle becomes, of the caller's. False where two of them have become one: nothing is left of
   it. */
static bool CornersLeft(const kiriMeshInput* input, const Welded* welded, int32_t triangle, int32_t corners[3])
{
    for (int i = 0; i < 3; ++i) {
        corners[i] = welded->to[input->indices[3 * (int64_t)triangle + i]];
    }
    return !(input->weldDistance > 0.0) ||
           (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]);
}

/* Vertices of the mesh have the order of the caller's. Returns how many triangles are left. */
static int32_t NumberVertices(const kiriMeshInput* input, Welded* welded, int32_t* vertexCount)
{
    int32_t triangles = 0, corners[3];
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        if (CornersLeft(input, welded, t, corners)) {
            welded->number[corners[0]] = welded->number[corners[1]] = welded->number[corners[2]] = 0;
            ++triangles;
        }
    }
    *vertexCount = 0;
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        welded->number[v] = welded->number[v] != KIRI_NONE ? (*vertexCount)++ : KIRI_NONE;
    }
    return triangles;
}

static void AddVertices(kiriMeshData* mesh, const kiriMeshInput* input, const Welded* welded)
{
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        if (welded->number[v] != KIRI_NONE) {
            kiriVertex* vertex = &mesh->vertices.data[welded->number[v]];
            memset(vertex, 0, sizeof(*vertex));
            vertex->at = welded->at[v];
            vertex->edge = KIRI_NONE;
        }
    }
}

/* ---- Triangles ---- */

/* Of the caller's triangles each block of sources may be split some day. */
static bool MakeTrianglesRoom(kiriMeshData* mesh, int32_t count, int32_t sources)
{
    int64_t blocks = ((int64_t)sources + KIRI_SOURCES_A_BLOCK - 1) / KIRI_SOURCES_A_BLOCK;
    if (!kiriArray_Reserve(mesh->memory, &mesh->triangles, count) ||
        !kiriArray_ResizeJust(mesh->memory, &mesh->sourceBlocks, blocks)) {
        return false;
    }
    for (int32_t k = 0; k < blocks; ++k) {
        mesh->sourceBlocks.data[k] = KIRI_NONE;
    }
    mesh->originals = count;
    return true;
}

static kiriResult RefuseShape(kiriFault* fault, int32_t triangle, int64_t area, bool isWelded)
{
    KIRI_SAY(fault, "triangle %lld %s%s", (long long)triangle, area < 0 ? "is clockwise" : "has no area",
             isWelded ? ", when vertices nearer than weldDistance are one" : "");
    return KIRI_ERROR_MESH;
}

static kiriResult AddTriangles(kiriMeshData* mesh, const kiriMeshInput* input, const Welded* welded, kiriFault* fault)
{
    int32_t v[3];
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        if (!CornersLeft(input, welded, t, v)) {
            continue;
        }
        int64_t area = kiriOrient(welded->at[v[0]], welded->at[v[1]], welded->at[v[2]]);
        if (area <= 0) {
            return RefuseShape(fault, t, area, input->weldDistance > 0.0);
        }
        int32_t added =
            kiriMesh_AddTriangle(mesh, welded->number[v[0]], welded->number[v[1]], welded->number[v[2]], t, KIRI_NONE);
        for (int i = 0; i < 3; ++i) {
            kiriVertex* vertex = &mesh->vertices.data[welded->number[v[i]]];
            if (vertex->edge == KIRI_NONE) {
                vertex->edge = 3 * added + i;
                kiriMesh_SetSource(mesh, welded->number[v[i]], t);
            }
        }
    }
    return KIRI_OK;
}

static kiriResult TakeWelded(kiriMeshData* mesh, const kiriMeshInput* input, Welded* welded, kiriLatticePoint* extent,
                             kiriMemory* scratch, kiriFault* fault)
{
    int32_t vertices;
    kiriResult result = PlaceVertices(mesh, input, welded, extent, fault);
    if (result != KIRI_OK) {
        return result;
    }
    if (input->weldDistance > 0.0 &&
        !kiriWeld_Find(welded->at, input->vertexCount, input->weldDistance / mesh->step, welded->to, scratch)) {
        return KIRI_ERROR_MEMORY;
    }
    int32_t triangles = NumberVertices(input, welded, &vertices);
    if (triangles == 0) {
        KIRI_SAY(fault, "triangle 0 and all others have two corners nearer than weldDistance");
        return KIRI_ERROR_MESH;
    }
    if (!kiriArray_Resize(mesh->memory, &mesh->vertices, vertices) ||
        !MakeTrianglesRoom(mesh, triangles, input->triangleCount)) {
        return KIRI_ERROR_MEMORY;
    }
    AddVertices(mesh, input, welded);
    return AddTriangles(mesh, input, welded, fault);
}

/* Vertices that no triangle has are left out, and triangles of which two corners become one vertex. */
static kiriResult TakeTriangles(kiriMeshData* mesh, const kiriMeshInput* input, kiriLatticePoint* extent,
                                kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    Welded welded;
    kiriResult result = MakeWelded(&welded, input, &scratch) ? TakeWelded(mesh, input, &welded, extent, &scratch, fault)
                                                             : KIRI_ERROR_MEMORY;
    kiriMemory_FreeAll(&scratch);
    return result;
}

/* ---- Twins ---- */

/* Twins are found by lattice points: an edge whose ends are other vertices on its other side is open. Each edge is
   listed at the one of its ends that has fewer: in a plane these lists are short, even around a hub (Chiba and
   Nishizeki 1985). */
typedef struct TwinEntry {
    int32_t half;  /* the half-edge, or its complement where it leads to the point of the list */
    int32_t other; /* the point at its other end */
} TwinEntry;

typedef struct TwinWork {
    int32_t* point;     /* of each vertex: the first vertex at its lattice point */
    bool hasDoubles;    /* there is another one somewhere */
    int32_t* degree;    /* of each point: how many half-edges leave it */
    int32_t* end;       /* of each point: where its list ends */
    TwinEntry* entries; /* list by list */
} TwinWork;

static uint32_t HashPlace(kiriLatticePoint at)
{
    uint64_t hash = ((uint64_t)(uint32_t)at.x << 32 | (uint32_t)at.y) * 0x9E3779B97F4A7C15u;
    return (uint32_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32);
}

/* Open addressing, in the order of vertices: the same on every machine. */
static bool FindPoints(const kiriMeshData* mesh, kiriMemory* memory, TwinWork* work)
{
    int64_t size = 16;
    while (size < 2 * (int64_t)mesh->vertices.count) {
        size *= 2;
    }
    int32_t* slots = kiriMemory_Alloc(memory, size * (int64_t)sizeof(int32_t));
    for (int64_t i = 0; slots != NULL && i < size; ++i) {
        slots[i] = KIRI_NONE;
    }
    for (int32_t v = 0; slots != NULL && v < mesh->vertices.count; ++v) {
        const kiriVertex* vertices = mesh->vertices.data;
        kiriLatticePoint at = vertices[v].at;
        uint32_t i = HashPlace(at) & (uint32_t)(size - 1);
        while (slots[i] != KIRI_NONE && (vertices[slots[i]].at.x != at.x || vertices[slots[i]].at.y != at.y)) {
            i = (i + 1) & (uint32_t)(size - 1);
        }
        slots[i] = slots[i] == KIRI_NONE ? v : slots[i];
        work->point[v] = slots[i];
        work->hasDoubles |= slots[i] != v;
    }
    return slots != NULL;
}

/* The points of a triangle where its half-edges are listed, and their entries there. */
static void EntriesOf(const kiriMeshData* mesh, const TwinWork* work, int32_t t, int32_t at[3], TwinEntry entries[3])
{
    const int32_t* v = mesh->triangles.data[t].vertex;
    const int32_t points[4] = { work->point[v[0]], work->point[v[1]], work->point[v[2]], work->point[v[0]] };
    for (int i = 0; i < 3; ++i) {
        int32_t a = points[i], b = points[i + 1], more = work->degree[a] - work->degree[b], h = 3 * t + i;
        bool atHead = more > 0 || (more == 0 && b < a);
        entries[i] = atHead ? (TwinEntry){ ~h, a } : (TwinEntry){ h, b };
        at[i] = atHead ? b : a;
    }
}

/* First `end` counts, then it is where lists begin, and at last where they end. */
static void ListEdges(const kiriMeshData* mesh, TwinWork* work)
{
    int32_t sum = 0, at[3];
    TwinEntry entries[3];
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        for (int i = 0; i < 3; ++i) {
            ++work->degree[work->point[mesh->triangles.data[t].vertex[i]]];
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        EntriesOf(mesh, work, t, at, entries);
        for (int i = 0; i < 3; ++i) {
            ++work->end[at[i]];
        }
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t count = work->end[v];
        work->end[v] = sum;
        sum += count;
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        EntriesOf(mesh, work, t, at, entries);
        for (int i = 0; i < 3; ++i) {
            work->entries[work->end[at[i]]++] = entries[i];
        }
    }
}

/* The half-edges run along the same edge. False where they do so in the same direction. */
static bool LinkEntries(kiriMeshData* mesh, TwinEntry a, TwinEntry b, bool hasDoubles)
{
    if ((a.half < 0) == (b.half < 0)) {
        return false;
    }
    int32_t h = a.half < 0 ? ~a.half : a.half, g = b.half < 0 ? ~b.half : b.half;
    kiriMesh_Link(mesh, h, g);
    if (hasDoubles) {
        bool open = kiriMesh_Tail(mesh, g) != kiriMesh_Tail(mesh, kiriEdge_Next(h)) ||
                    kiriMesh_Tail(mesh, h) != kiriMesh_Tail(mesh, kiriEdge_Next(g));
        kiriMesh_SetOpen(mesh, h, open);
        kiriMesh_SetOpen(mesh, g, open);
    }
    return true;
}

/* Names are the caller's. */
static kiriResult RefuseEdge(const kiriMeshData* mesh, const kiriMeshInput* input, TwinEntry a, TwinEntry b,
                             kiriFault* fault)
{
    int32_t h = a.half < 0 ? ~a.half : a.half, g = b.half < 0 ? ~b.half : b.half;
    int64_t first = mesh->triangles.data[h / 3].source, second = mesh->triangles.data[g / 3].source;
    KIRI_SAY(fault, "triangles %lld and %lld use the edge from vertex %lld to vertex %lld in the same direction",
             (long long)first, (long long)second, (long long)input->indices[3 * first + h % 3],
             (long long)input->indices[3 * first + (h + 1) % 3]);
    return KIRI_ERROR_MESH;
}

static kiriResult LinkTwins(kiriMeshData* mesh, const kiriMeshInput* input, const TwinWork* work, kiriFault* fault)
{
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t first = v > 0 ? work->end[v - 1] : 0;
        for (int32_t i = first; i < work->end[v]; ++i) {
            for (int32_t j = i + 1; j < work->end[v]; ++j) {
                if (work->entries[i].other == work->entries[j].other &&
                    !LinkEntries(mesh, work->entries[i], work->entries[j], work->hasDoubles)) {
                    return RefuseEdge(mesh, input, work->entries[i], work->entries[j], fault);
                }
            }
        }
    }
    return KIRI_OK;
}

static kiriResult FindTwins(kiriMeshData* mesh, const kiriMeshInput* input, kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    int64_t bytes = mesh->vertices.count * (int64_t)sizeof(int32_t);
    TwinWork work = { kiriMemory_Alloc(&scratch, bytes), false, kiriMemory_AllocZeroed(&scratch, bytes),
                      kiriMemory_AllocZeroed(&scratch, bytes),
                      kiriMemory_Alloc(&scratch, 3 * mesh->triangles.count * (int64_t)sizeof(TwinEntry)) };
    kiriResult result = KIRI_OK;
    if (work.point == NULL || work.degree == NULL || work.end == NULL || work.entries == NULL ||
        !FindPoints(mesh, &scratch, &work)) {
        result = KIRI_ERROR_MEMORY;
    } else {
        ListEdges(mesh, &work);
        result = LinkTwins(mesh, input, &work, fault);
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

/* In the marks of a triangle, of corner 0; those of the others follow. */
enum { FAN_DONE = 16 };

static void ClaimCorner(kiriMeshData* mesh, int32_t c, int32_t vertex)
{
    kiriTriangle* triangle = &mesh->triangles.data[c / 3];
    triangle->vertex[c % 3] = vertex;
    triangle->marks |= FAN_DONE << (c % 3);
}

/* Gives h's fan a vertex of its own when another fan has taken its vertex before. While this runs, the stamps mark the
   vertices that are taken. */
static bool ClaimFan(kiriMeshData* mesh, int32_t h)
{
    int32_t vertex = kiriMesh_Tail(mesh, h), c = h;
    if (mesh->vertices.data[vertex].stamp != 0) {
        kiriVertex copy = mesh->vertices.data[vertex];
        vertex = mesh->vertices.count;
        if (!kiriArray_Push(mesh->memory, &mesh->vertices, copy)) {
            return false;
        }
        kiriMesh_SetSource(mesh, vertex, mesh->triangles.data[h / 3].source);
    }
    mesh->vertices.data[vertex].stamp = 1;
    mesh->vertices.data[vertex].edge = h;
    do {
        ClaimCorner(mesh, c, vertex);
        c = kiriMesh_Clockwise(mesh, c);
    } while (c != KIRI_NONE && c != h);
    for (c = c == h ? KIRI_NONE : kiriMesh_CounterClockwise(mesh, h); c != KIRI_NONE;) {
        ClaimCorner(mesh, c, vertex);
        c = kiriMesh_CounterClockwise(mesh, c);
    }
    return true;
}

static bool ClaimFans(kiriMeshData* mesh)
{
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        for (int i = 0; i < 3; ++i) {
            if ((mesh->triangles.data[t].marks & FAN_DONE << i) == 0 && !ClaimFan(mesh, 3 * t + i)) {
                return false;
            }
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        mesh->triangles.data[t].marks &= KIRI_TRIANGLE_OPEN;
    }
    for (int32_t i = 0; i < mesh->vertices.count; ++i) {
        mesh->vertices.data[i].stamp = 0;
    }
    return true;
}

static kiriResult CheckOverlaps(const kiriMeshData* mesh, kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    kiriResult result = KIRI_OK;
    int32_t pair[2];
    if (!kiriOverlap_Find(mesh, &scratch, pair)) {
        result = KIRI_ERROR_MEMORY;
    } else if (pair[0] != KIRI_NONE) {
        KIRI_SAY(fault, "triangles %lld and %lld overlap", (long long)mesh->triangles.data[pair[0]].source,
                 (long long)mesh->triangles.data[pair[1]].source);
        result = KIRI_ERROR_MESH;
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

static kiriResult BuildMesh(kiriMeshData* mesh, const kiriMeshInput* input, kiriFault* fault)
{
    kiriLatticePoint extent = { 0, 0 };
    kiriResult result = CheckInput(input, fault);
    result = result == KIRI_OK ? TakeTriangles(mesh, input, &extent, fault) : result;
    result = result == KIRI_OK ? FindTwins(mesh, input, fault) : result;
    result = result == KIRI_OK ? CheckOverlaps(mesh, fault) : result;
    if (result != KIRI_OK) {
        return result;
    }
    if (!ClaimFans(mesh) || !kiriSquares_Init(&mesh->squares, mesh->memory, extent, input->resolution) ||
        !kiriMesh_FillSquares(mesh, &mesh->squares, mesh->memory)) {
        return KIRI_ERROR_MEMORY;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriMesh_ListVertex(mesh, v);
    }
    return KIRI_OK;
}

kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshInput* input, kiriFault* fault)
{
    memset(mesh, 0, sizeof(*mesh));
    mesh->memory = memory;
    fault->line[0] = '\0';
    kiriResult result = BuildMesh(mesh, input, fault);
    if (result != KIRI_OK) {
        return result;
    }
    mesh->revision = 1;
    kiriMesh_Begin(mesh);
    return KIRI_OK;
}
