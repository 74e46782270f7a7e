#include "kiri_overlap.h"

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
