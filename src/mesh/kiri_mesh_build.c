#include "kiri_mesh.h"

/* Allocates indices, all with the same value. */
static int32_t* MakeIndices(kiriMemory* memory, int64_t count, int32_t value)
{
    int32_t* indices = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    for (int64_t i = 0; indices != NULL && i < count; ++i) {
        indices[i] = value;
    }
    return indices;
}

/* ---- Welding ----------------------------------------------------------------------------------------------------- */

/* Lists kept vertices by the cells of a grid. Cells are at least as wide as the distance: so each holds a few at most, and
   all vertices near a point are in its cell or in the eight around it. The table uses open addressing, in the order of
   vertices. */
typedef struct WeldGrid {
    const kiriLatticePoint* at;
    int64_t side;       /* of a cell, lattice steps */
    int64_t mask;       /* number of slots, less 1 */
    int32_t* slots;     /* the last kept vertex of a cell, or KIRI_NONE */
    int32_t* previous;  /* of each kept vertex: the one before in its cell, or KIRI_NONE */
    double nearSquared; /* lattice steps, squared */
} WeldGrid;

/* Returns the slot of a cell, or the free slot where it belongs. */
static int64_t FindSlot(const WeldGrid* grid, int64_t column, int64_t row)
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

static int32_t FindNearestKept(const WeldGrid* grid, kiriLatticePoint at)
{
    /* Even points in different cells are at least 2 apart. */
    bool isInCell = grid->nearSquared <= 4.0;
    int32_t found = KIRI_NONE;
    int64_t nearest = 0;
    KIRI_FROM_TO(k, isInCell ? 4 : 0, isInCell ? 5 : 9) {
        int64_t slot = FindSlot(grid, at.x / grid->side + k % 3 - 1, at.y / grid->side + k / 3 - 1);
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

/* Writes for each vertex the vertex that it is welded to: itself, or a lower one that is welded to itself. Vertices are
   taken in ascending order. Each is welded to the nearest kept vertex nearer than `distance` (lattice steps), the lowest
   of several; it is kept if there is none. to[v] is KIRI_NONE on entry if vertex v is left out, and stays so.
   Coordinates are even, 0 to 2^30. O(count). Scratch comes from `memory`. Returns false on out of memory. */
static bool FindWelds(const kiriLatticePoint* at, int32_t count, double distance, int32_t* to, kiriMemory* memory)
{
    const double widest = 1 << 30;
    KIRI_ASSERT(distance > 0.0);
    int64_t size = 16, side = distance < 2.0 ? 2 : distance < widest ? (int64_t)distance + 1 : (int64_t)widest;
    while (size < 2 * (int64_t)count) {
        size *= 2;
    }
    WeldGrid grid = { at,
                      side,
                      size - 1,
                      MakeIndices(memory, size, KIRI_NONE),
                      MakeIndices(memory, count, KIRI_NONE),
                      distance * distance };
    bool ok = grid.slots != NULL && grid.previous != NULL;
    KIRI_TIMES_WHILE(ok, v, count) {
        if (to[v] == KIRI_NONE) {
            continue;
        }
        to[v] = FindNearestKept(&grid, at[v]);
        KIRI_ASSERT(to[v] < v);
        if (to[v] == KIRI_NONE) {
            int64_t slot = FindSlot(&grid, at[v].x / side, at[v].y / side);
            grid.previous[v] = grid.slots[slot];
            grid.slots[slot] = v;
            to[v] = v;
        }
    }
    kiriMemory_Free(memory, grid.slots);
    kiriMemory_Free(memory, grid.previous);
    return ok;
}

/* ---- Vertices and triangles of the caller ------------------------------------------------------------------------ */

/* The caller's vertices: an entry each. */
typedef struct WeldedVertices {
    kiriLatticePoint* at;
    int32_t* to;     /* the vertex that it is welded to; KIRI_NONE: no triangle has it */
    int32_t* number; /* its index in the mesh; KIRI_NONE: no triangle that is kept has it */
} WeldedVertices;

static kiriResult CheckInput(const kiriMeshInput* input, kiriFault* fault)
{
    KIRI_ASSERT(input->vertexCount >= 3 && input->triangleCount >= 1 && input->triangleCount <= KIRI_MOST_TRIANGLES);
    if (input->positions == NULL || input->indices == NULL) {
        KIRI_SAY(fault, "restPositions or indices is null");
        return KIRI_ERROR_ARGUMENT;
    }
    for (int64_t i = 0; i < 3 * (int64_t)input->triangleCount; ++i) {
        if (input->indices[i] < 0 || input->indices[i] >= input->vertexCount) {
            KIRI_SAY(fault, "triangle %lld has vertex %lld, which is not within 0 and %lld", (long long)(i / 3),
                     (long long)input->indices[i], (long long)input->vertexCount - 1);
            return KIRI_ERROR_ARGUMENT;
        }
    }
    return KIRI_OK;
}

/* Chooses the lattice for the vertices that triangles have, and puts them on it. *extent is its upper corner. */
static kiriResult PlaceVertices(kiriMeshData* mesh, const kiriMeshInput* input, const WeldedVertices* welded,
                                kiriLatticePoint* extent, kiriFault* fault)
{
    double low[2] = { DBL_MAX, DBL_MAX }, high[2] = { -DBL_MAX, -DBL_MAX };
    for (int64_t i = 0; i < 2 * (int64_t)input->vertexCount; ++i) {
        double x = input->positions[i];
        if (welded->to[i / 2] != KIRI_NONE) {
            low[i % 2] = kiriMin(x, low[i % 2]);
            high[i % 2] = kiriMax(x, high[i % 2]);
        }
    }
    double width = high[0] - low[0], height = high[1] - low[1];
    mesh->origin = kiriVec2_Make(low[0], low[1]);
    mesh->step = kiriMax(width, height) / KIRI_LATTICE;
    if (!(mesh->step > 0.0)) {
        KIRI_SAY(fault, "triangle 0 has no area: all rest positions are the same point");
        return KIRI_ERROR_MESH;
    }
    KIRI_TIMES(v, input->vertexCount) {
        if (welded->to[v] != KIRI_NONE) {
            kiriVec2 p = kiriVec2_Load(&input->positions[2 * (int64_t)v]);
            welded->at[v] = kiriMesh_Snap(mesh, kiriVec2_Sub(p, mesh->origin));
        }
    }
    *extent = kiriMesh_Snap(mesh, kiriVec2_Make(width, height));
    return KIRI_OK;
}

/* Writes the corners of a triangle after welding. Returns false if two are the same: the triangle is left out. */
static bool GetWeldedCorners(const kiriMeshInput* input, const WeldedVertices* welded, int32_t triangle,
                             int32_t corners[3])
{
    KIRI_EACH_CORNER(i) {
        corners[i] = welded->to[input->indices[3 * (int64_t)triangle + i]];
        KIRI_ASSERT(corners[i] >= 0 && corners[i] < input->vertexCount);
    }
    return !(input->weldDistance > 0.0) ||
           (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]);
}

/* Numbers the vertices that are kept, in the caller's order, and makes room for them and for the triangles. */
static kiriResult AddVertices(kiriMeshData* mesh, const kiriMeshInput* input, const WeldedVertices* welded,
                              kiriFault* fault)
{
    int32_t v[3], vertices = 0, triangles = 0;
    KIRI_TIMES(t, input->triangleCount) {
        if (GetWeldedCorners(input, welded, t, v)) {
            welded->number[v[0]] = welded->number[v[1]] = welded->number[v[2]] = 0;
            ++triangles;
        }
    }
    if (triangles == 0) {
        KIRI_SAY(fault, "triangle 0 and all others have two corners nearer than weldDistance");
        return KIRI_ERROR_MESH;
    }
    KIRI_TIMES(i, input->vertexCount) {
        welded->number[i] = welded->number[i] != KIRI_NONE ? vertices++ : KIRI_NONE;
    }
    int64_t blocks = ((int64_t)input->triangleCount + KIRI_SOURCES_A_BLOCK - 1) / KIRI_SOURCES_A_BLOCK;
    if (!kiriArray_Resize(mesh->memory, &mesh->vertices, vertices) ||
        !kiriArray_Reserve(mesh->memory, &mesh->triangles, triangles) ||
        !kiriArray_ResizeJust(mesh->memory, &mesh->sourceBlocks, blocks)) {
        return KIRI_ERROR_MEMORY;
    }
    kiriArray_Set(&mesh->sourceBlocks, KIRI_NONE);
    KIRI_TIMES(i, input->vertexCount) {
        if (welded->number[i] != KIRI_NONE) {
            mesh->vertices.data[welded->number[i]] = (kiriVertex){ welded->at[i], KIRI_NONE, 0, 0, 0 };
        }
    }
    KIRI_ASSERT(vertices >= 1 && vertices <= input->vertexCount); /* a triangle may name one vertex twice */
    mesh->originals = triangles;
    return KIRI_OK;
}

static kiriResult AddTriangles(kiriMeshData* mesh, const kiriMeshInput* input, const WeldedVertices* welded,
                               kiriFault* fault)
{
    for (int32_t t = 0, v[3]; t < input->triangleCount; ++t) {
        if (!GetWeldedCorners(input, welded, t, v)) {
            continue;
        }
        KIRI_ASSERT(welded->number[v[0]] >= 0 && welded->number[v[1]] >= 0 && welded->number[v[2]] >= 0);
        int64_t area = kiriOrient(welded->at[v[0]], welded->at[v[1]], welded->at[v[2]]);
        if (area <= 0) {
            KIRI_SAY(fault, "triangle %lld %s%s", (long long)t, area < 0 ? "is clockwise" : "has no area",
                     input->weldDistance > 0.0 ? ", when vertices nearer than weldDistance are one" : "");
            return KIRI_ERROR_MESH;
        }
        kiriMesh_AddTriangle(mesh, welded->number[v[0]], welded->number[v[1]], welded->number[v[2]], t, KIRI_NONE);
    }
    return KIRI_OK;
}

/* Takes over the caller's triangles. Leaves out vertices that no triangle has, and triangles that welding makes empty. */
static kiriResult TakeTriangles(kiriMeshData* mesh, const kiriMeshInput* input, kiriLatticePoint* extent,
                                kiriMemory* scratch, kiriFault* fault)
{
    WeldedVertices welded = { kiriMemory_Alloc(scratch, input->vertexCount * (int64_t)sizeof(kiriLatticePoint)),
                              MakeIndices(scratch, input->vertexCount, KIRI_NONE),
                              MakeIndices(scratch, input->vertexCount, KIRI_NONE) };
    if (welded.at == NULL || welded.to == NULL || welded.number == NULL) {
        return KIRI_ERROR_MEMORY;
    }
    for (int64_t i = 0; i < 3 * (int64_t)input->triangleCount; ++i) {
        welded.to[input->indices[i]] = input->indices[i];
    }
    kiriResult result = PlaceVertices(mesh, input, &welded, extent, fault);
    if (result == KIRI_OK && input->weldDistance > 0.0 &&
        !FindWelds(welded.at, input->vertexCount, input->weldDistance / mesh->step, welded.to, scratch)) {
        result = KIRI_ERROR_MEMORY;
    }
    result = result == KIRI_OK ? AddVertices(mesh, input, &welded, fault) : result;
    return result == KIRI_OK ? AddTriangles(mesh, input, &welded, fault) : result;
}

/* ---- Twins ------------------------------------------------------------------------------------------------------- */

/* Links the half-edges that run along the same edge. Ends are compared as lattice points: where they are different
   vertices, the edge is open. Each edge is listed at the end that has fewer half-edges: in a plane these lists are short,
   even around a hub (Chiba and Nishizeki 1985). */
static kiriResult LinkTwins(kiriMeshData* mesh, const kiriMeshInput* input, kiriMemory* scratch, kiriFault* fault)
{
    int32_t vertices = mesh->vertices.count, halves = 3 * mesh->triangles.count;
    kiriLatticePoint* at = kiriMemory_Alloc(scratch, vertices * (int64_t)sizeof(kiriLatticePoint));
    int32_t* point = MakeIndices(scratch, vertices, 0);  /* the lowest vertex at the same lattice point */
    int32_t* degree = MakeIndices(scratch, vertices, 0); /* of each point: half-edges that leave it */
    int32_t* first = MakeIndices(scratch, vertices, KIRI_NONE);
    int32_t* next = MakeIndices(scratch, halves, KIRI_NONE);
    int32_t* ends = MakeIndices(scratch, halves, KIRI_NONE); /* of a listed half-edge: its end that does not list it */
    if (at == NULL || point == NULL || degree == NULL || first == NULL || next == NULL || ends == NULL) {
        return KIRI_ERROR_MEMORY;
    }
    KIRI_TIMES(v, vertices) {
        at[v] = kiriMesh_At(mesh, v);
        point[v] = v;
    }
    if (!FindWelds(at, vertices, 1.0, point, scratch)) {
        return KIRI_ERROR_MEMORY;
    }
    KIRI_TIMES(h, halves) {
        ++degree[point[kiriMesh_Tail(mesh, h)]];
    }
    KIRI_TIMES(h, halves) {
        int32_t a = point[kiriMesh_Tail(mesh, h)], b = point[kiriMesh_Head(mesh, h)];
        bool isAtA = degree[a] < degree[b] || (degree[a] == degree[b] && a < b);
        int32_t *list = &first[isAtA ? a : b], end = isAtA ? b : a, g = *list;
        while (g != KIRI_NONE && ends[g] != end) {
            g = next[g];
        }
        if (g == KIRI_NONE) {
            ends[h] = end;
            next[h] = *list;
            *list = h;
            continue;
        }
        g = point[kiriMesh_Tail(mesh, g)] != a && kiriMesh_Twin(mesh, g) != KIRI_NONE ? kiriMesh_Twin(mesh, g) : g;
        if (point[kiriMesh_Tail(mesh, g)] == a) {
            int64_t source = mesh->triangles.data[g / 3].source;
            KIRI_SAY(
                fault, "triangles %lld and %lld use the edge from vertex %lld to vertex %lld in the same direction",
                (long long)source, (long long)mesh->triangles.data[h / 3].source,
                (long long)input->indices[3 * source + g % 3], (long long)input->indices[3 * source + (g + 1) % 3]);
            return KIRI_ERROR_MESH;
        }
        bool isOpen =
            kiriMesh_Tail(mesh, g) != kiriMesh_Head(mesh, h) || kiriMesh_Tail(mesh, h) != kiriMesh_Head(mesh, g);
        kiriMesh_Link(mesh, h, g);
        kiriMesh_SetMarks(mesh, h, isOpen ? KIRI_EDGE_OPEN : 0);
        kiriMesh_SetMarks(mesh, g, isOpen ? KIRI_EDGE_OPEN : 0);
    }
    return KIRI_OK;
}

/* ---- Overlaps ---------------------------------------------------------------------------------------------------- */

enum {
    OVERLAP_TOLERANCE = 64, /* lattice steps that triangles may intrude on each other: the input is float */
    LATTICE_ROUNDING = 2,   /* lattice steps that they may always intrude */
    MOST_IN_LEAF = 4
};

typedef struct OverlapBox {
    int32_t low[2], high[2];
} OverlapBox;

typedef struct OverlapItem {
    OverlapBox box;
    int32_t index; /* of a triangle, or of a half-edge of the outline */
} OverlapItem;

typedef struct OverlapNode {
    OverlapBox box;
    int32_t first, end; /* its items */
    int32_t child;      /* the first of two, or KIRI_NONE in a leaf */
} OverlapNode;

/* A tree of boxes. The items of a node are divided at the middle of the range of their centers, along its longer side.
   Coordinates have 30 bits, so no branch is longer than 60 nodes and a few. */
typedef struct OverlapTree {
    const kiriMeshData* mesh;
    bool hasEdges; /* items are edges of the outline */
    OverlapItem* items;
    OverlapNode* nodes;
    int32_t nodeCount;
    int32_t pair[2]; /* the first two items that overlap */
} OverlapTree;

/* Returns true if triangle b is on the outer side of an edge of triangle a, within the tolerance. That is at most half of
   the height of a and half of the width of b: else triangles as small as the tolerance could lie on each other. */
static bool EdgeSeparates(const kiriLatticePoint a[3], const kiriLatticePoint b[3])
{
    int64_t area = kiriOrient(a[0], a[1], a[2]);
    KIRI_EACH_CORNER(i) {
        kiriLatticePoint p = a[i], q = a[(i + 1) % 3];
        int64_t inner = kiriOrient(p, q, b[0]), outer = inner;
        KIRI_FROM_TO(k, 1, 3) {
            int64_t above = kiriOrient(p, q, b[k]);
            inner = kiriMax(above, inner);
            outer = kiriMin(above, outer);
        }
        int64_t x = (int64_t)q.x - p.x, y = (int64_t)q.y - p.y, length = kiriMax(x, -x) + kiriMax(y, -y);
        int64_t most = kiriMin(OVERLAP_TOLERANCE * length, area / 2);
        most = kiriMin(most, -outer);
        if (inner <= kiriMax(most, LATTICE_ROUNDING * length)) {
            return true;
        }
    }
    return false;
}

/* Returns true if two edges of the outline meet elsewhere than where one follows the other around a bend. */
static bool EdgesMeet(const kiriMeshData* mesh, int32_t g, int32_t h)
{
    kiriLatticePoint a = kiriMesh_TailAt(mesh, g), b = kiriMesh_HeadAt(mesh, g);
    kiriLatticePoint c = kiriMesh_TailAt(mesh, h), d = kiriMesh_HeadAt(mesh, h);
    if (kiriLattice_IsSame(b, c)) {
        return kiriOrient(a, b, d) == 0 && kiriLattice_Dot(b, a, d) >= 0;
    }
    if (kiriLattice_IsSame(d, a)) {
        return EdgesMeet(mesh, h, g);
    }
    int64_t ofC = kiriOrient(a, b, c), ofD = kiriOrient(a, b, d), ofA = kiriOrient(c, d, a), ofB = kiriOrient(c, d, b);
    return !((ofC > 0 && ofD > 0) || (ofC < 0 && ofD < 0)) && !((ofA > 0 && ofB > 0) || (ofA < 0 && ofB < 0));
}

static bool BoxesOverlap(const OverlapBox* a, const OverlapBox* b)
{
    return a->low[0] < b->high[0] && b->low[0] < a->high[0] && a->low[1] < b->high[1] && b->low[1] < a->high[1];
}

static bool ItemsOverlap(const OverlapTree* tree, const OverlapItem* a, const OverlapItem* b)
{
    kiriLatticePoint c[3], d[3];
    if (!BoxesOverlap(&a->box, &b->box) || tree->hasEdges) {
        return BoxesOverlap(&a->box, &b->box) && EdgesMeet(tree->mesh, a->index, b->index);
    }
    kiriMesh_Corners(tree->mesh, a->index, c);
    kiriMesh_Corners(tree->mesh, b->index, d);
    return !EdgeSeparates(c, d) && !EdgeSeparates(d, c);
}

/* Enlarges a box to hold another one. */
static void JoinBox(OverlapBox* box, const OverlapBox* other)
{
    KIRI_TIMES(axis, 2) {
        box->low[axis] = kiriMin(other->low[axis], box->low[axis]);
        box->high[axis] = kiriMax(other->high[axis], box->high[axis]);
    }
}

/* Makes the box of a node and, if it has many items, its children. */
static void MakeNode(OverlapTree* tree, int32_t first, int32_t end, int32_t index)
{
    const OverlapBox none = { { INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN } };
    OverlapBox box = none, centers = none; /* centers are doubled */
    KIRI_ASSERT(first < end);
    KIRI_FROM_TO(i, first, end) {
        const OverlapBox* item = &tree->items[i].box;
        int32_t x = item->low[0] + item->high[0], y = item->low[1] + item->high[1];
        JoinBox(&box, item);
        JoinBox(&centers, &(OverlapBox){ { x, y }, { x, y } });
    }
    tree->nodes[index] = (OverlapNode){ box, first, end, KIRI_NONE };
    int axis = centers.high[0] - centers.low[0] > centers.high[1] - centers.low[1] ? 0 : 1;
    if (end - first <= MOST_IN_LEAF || centers.high[axis] == centers.low[axis]) {
        return;
    }
    int32_t middle = centers.low[axis] + (centers.high[axis] - centers.low[axis]) / 2, split = first, upper = end;
    while (split < upper) {
        OverlapItem item = tree->items[split];
        if (item.box.low[axis] + item.box.high[axis] <= middle) {
            ++split;
        } else {
            tree->items[split] = tree->items[--upper];
            tree->items[upper] = item;
        }
    }
    KIRI_ASSERT(split > first && split < end);
    int32_t child = tree->nodes[index].child = tree->nodeCount;
    tree->nodeCount += 2;
    MakeNode(tree, first, split, child);
    MakeNode(tree, split, end, child + 1);
}

/* Returns true if items of two nodes overlap, or of a node with itself. Writes the pair. */
static bool NodesOverlap(OverlapTree* tree, const OverlapNode* a, const OverlapNode* b)
{
    if (a != b && !BoxesOverlap(&a->box, &b->box)) {
        return false;
    }
    if (a->child == KIRI_NONE && b->child == KIRI_NONE) {
        KIRI_FROM_TO(i, a->first, a->end) {
            KIRI_FROM_TO(j, a == b ? i + 1 : b->first, b->end) {
                if (ItemsOverlap(tree, &tree->items[i], &tree->items[j])) {
                    tree->pair[0] = tree->items[i].index;
                    tree->pair[1] = tree->items[j].index;
                    return true;
                }
            }
        }
        return false;
    }
    if (a == b) {
        const OverlapNode* child = &tree->nodes[a->child];
        return NodesOverlap(tree, child, child) || NodesOverlap(tree, child + 1, child + 1) ||
               NodesOverlap(tree, child, child + 1);
    }
    bool splitsA = b->child == KIRI_NONE || (a->child != KIRI_NONE && a->end - a->first > b->end - b->first);
    const OverlapNode *child = &tree->nodes[splitsA ? a->child : b->child], *other = splitsA ? b : a;
    return NodesOverlap(tree, child, other) || NodesOverlap(tree, child + 1, other);
}

static bool FindOverlap(OverlapTree* tree, int32_t count)
{
    tree->nodeCount = 1;
    MakeNode(tree, 0, count, 0);
    return NodesOverlap(tree, &tree->nodes[0], &tree->nodes[0]);
}

/* Makes an item of points. Boxes that touch do not overlap, so boxes of edges need a margin. */
static OverlapItem MakeOverlapItem(const kiriLatticePoint* points, int count, int32_t margin, int32_t index)
{
    OverlapItem item = { { { INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN } }, index };
    KIRI_TIMES(i, count) {
        kiriLatticePoint p = points[i];
        JoinBox(&item.box, &(OverlapBox){ { p.x - margin, p.y - margin }, { p.x + margin, p.y + margin } });
    }
    return item;
}

/* Lists the edges of the loop that half-edge `first` of the outline is in. Returns how many there are. */
static int32_t ListLoop(const kiriMeshData* mesh, int32_t first, OverlapItem* items)
{
    int32_t count = 0, h = first;
    KIRI_ASSERT(kiriMesh_Twin(mesh, first) == KIRI_NONE);
    do {
        const kiriLatticePoint ends[2] = { kiriMesh_TailAt(mesh, h), kiriMesh_HeadAt(mesh, h) };
        items[count++] = MakeOverlapItem(ends, 2, 1, h);
        h = kiriEdge_Next(h);
        while (kiriMesh_Twin(mesh, h) != KIRI_NONE) {
            h = kiriEdge_Next(kiriMesh_Twin(mesh, h));
        }
    } while (h != first);
    return count;
}

/* Refuses triangles that overlap by more than rounding of the input explains. If the outline is one loop that nowhere
   meets itself, the mesh covers its inside once, so only the outline is searched. O(n log n), unless most triangles are
   long and thin. */
static kiriResult CheckOverlaps(const kiriMeshData* mesh, kiriMemory* scratch, kiriFault* fault)
{
    int32_t edges = 0, first = KIRI_NONE;
    KIRI_TIMES(h, 3 * mesh->triangles.count) {
        if (kiriMesh_Twin(mesh, h) == KIRI_NONE) {
            first = h;
            ++edges;
        }
    }
    int64_t most = kiriMax(edges, mesh->triangles.count);
    OverlapTree tree = { mesh,
                         true,
                         kiriMemory_Alloc(scratch, most * (int64_t)sizeof(OverlapItem)),
                         kiriMemory_Alloc(scratch, 2 * most * (int64_t)sizeof(OverlapNode)),
                         0,
                         { KIRI_NONE, KIRI_NONE } };
    if (tree.items == NULL || tree.nodes == NULL) {
        return KIRI_ERROR_MEMORY;
    }
    if (first != KIRI_NONE && ListLoop(mesh, first, tree.items) == edges && !FindOverlap(&tree, edges)) {
        return KIRI_OK;
    }
    tree.hasEdges = false;
    KIRI_EACH_INDEX(t, mesh->triangles) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        tree.items[t] = MakeOverlapItem(c, 3, 0, t);
    }
    if (!FindOverlap(&tree, mesh->triangles.count)) {
        return KIRI_OK;
    }
    KIRI_SAY(fault, "triangles %lld and %lld overlap",
             (long long)mesh->triangles.data[kiriMin(tree.pair[0], tree.pair[1])].source,
             (long long)mesh->triangles.data[kiriMax(tree.pair[0], tree.pair[1])].source);
    return KIRI_ERROR_MESH;
}

/* ---- The whole mesh ---------------------------------------------------------------------------------------------- */

/* Gives each fan its own vertex. The first fan of a vertex keeps it, others get copies. The edge of a vertex is the lowest
   corner of its fan. */
static bool ClaimFans(kiriMeshData* mesh, kiriMemory* scratch)
{
    int32_t halves = 3 * mesh->triangles.count, *fan = kiriMemory_Alloc(scratch, halves * (int64_t)sizeof(int32_t));
    if (fan == NULL) {
        return false;
    }
    kiriUnion_Init(fan, halves);
    KIRI_TIMES(h, halves) {
        int32_t before = kiriMesh_Clockwise(mesh, h);
        if (before != KIRI_NONE) {
            kiriUnion_Join(fan, h, before);
        }
    }
    KIRI_TIMES(h, halves) {
        kiriTriangle* triangle = &mesh->triangles.data[h / 3];
        int32_t root = kiriUnion_Root(fan, h), vertex = kiriMesh_Tail(mesh, root);
        if (root == h) {
            kiriVertex own = { kiriMesh_At(mesh, vertex), h, KIRI_NONE, triangle->source, 0 };
            if (mesh->vertices.data[vertex].edge == KIRI_NONE) {
                mesh->vertices.data[vertex] = own;
            } else {
                vertex = mesh->vertices.count;
                if (!kiriArray_Push(mesh->memory, &mesh->vertices, own)) {
                    return false;
                }
            }
        }
        triangle->vertex[h % 3] = vertex;
    }
    return true;
}

kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshInput* input, kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(memory);
    kiriLatticePoint extent = { 0 };
    KIRI_CLEAR(mesh);
    mesh->memory = memory;
    fault->line[0] = '\0';
    kiriResult result = CheckInput(input, fault);
    result = result == KIRI_OK ? TakeTriangles(mesh, input, &extent, &scratch, fault) : result;
    kiriMemory_FreeAll(&scratch);
    result = result == KIRI_OK ? LinkTwins(mesh, input, &scratch, fault) : result;
    kiriMemory_FreeAll(&scratch);
    result = result == KIRI_OK ? CheckOverlaps(mesh, &scratch, fault) : result;
    kiriMemory_FreeAll(&scratch);
    if (result == KIRI_OK &&
        (!ClaimFans(mesh, &scratch) || !kiriSquares_Init(&mesh->squares, memory, extent, input->resolution) ||
         !kiriMesh_FillSquares(mesh, &mesh->squares, memory))) {
        result = KIRI_ERROR_MEMORY;
    }
    kiriMemory_FreeAll(&scratch);
    if (result != KIRI_OK) {
        return result;
    }
    KIRI_EACH_INDEX(v, mesh->vertices) {
        kiriMesh_ListVertex(mesh, v);
    }
    mesh->revision = 1;
    kiriMesh_Begin(mesh);
    return KIRI_OK;
}

/* ---- Corners of the caller's triangles --------------------------------------------------------------------------- */

/* Returns the triangle that the caller gave, or what splits have left in its place; KIRI_NONE if it is gone. It has its
   own index as long as no triangle before it has gone. */
static int32_t FindOriginal(const kiriMeshData* mesh, int32_t source)
{
    const kiriTriangle* triangles = mesh->triangles.data;
    int32_t count = mesh->originals, t = source;
    if (t < 0 || count == 0) {
        return KIRI_NONE;
    }
    if (t >= count || triangles[t].source != source) {
        KIRI_SEARCH(t, 0, count, triangles[middle].source < source);
    }
    return t < count && triangles[t].source == source ? t : KIRI_NONE;
}

/* Returns where the corners are stored, or KIRI_NONE. */
static int64_t FindStored(const kiriMeshData* mesh, int32_t source)
{
    int32_t k;
    if (mesh->sources.count > 0) {
        KIRI_SEARCH(k, 0, mesh->sources.count, mesh->sources.data[middle] < source);
        return k < mesh->sources.count && mesh->sources.data[k] == source ? 3 * (int64_t)k : KIRI_NONE;
    }
    k = source >= 0 ? source / KIRI_SOURCES_A_BLOCK : KIRI_NONE;
    int32_t block = k >= 0 && k < mesh->sourceBlocks.count ? mesh->sourceBlocks.data[k] : KIRI_NONE;
    return block == KIRI_NONE ? KIRI_NONE : 3 * ((int64_t)block * KIRI_SOURCES_A_BLOCK + source % KIRI_SOURCES_A_BLOCK);
}

/* Writes the corners of a source. In a block, triangles that were removed before it was made have equal corners. */
bool kiriMesh_SourceCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3])
{
    int64_t at = FindStored(mesh, source);
    if (at != KIRI_NONE) {
        KIRI_ASSERT(at >= 0 && at + 3 <= mesh->sourceCorners.count);
        memcpy(corners, &mesh->sourceCorners.data[at], 3 * sizeof(kiriLatticePoint));
        return !kiriLattice_IsSame(corners[0], corners[1]);
    }
    int32_t t = FindOriginal(mesh, source);
    if (t != KIRI_NONE) {
        kiriMesh_Corners(mesh, t, corners);
    }
    return t != KIRI_NONE;
}

bool kiriMesh_HasSource(const kiriMeshData* mesh, int32_t triangle)
{
    int32_t source = mesh->triangles.data[triangle].source;
    kiriLatticePoint corners[3];
    return kiriMesh_SourceCorners(mesh, source, corners) &&
           (FindStored(mesh, source) != KIRI_NONE || FindOriginal(mesh, source) == triangle);
}

void kiriMesh_KeepSource(kiriMeshData* mesh, int32_t triangle)
{
    enum { BLOCK_CORNERS = 3 * KIRI_SOURCES_A_BLOCK };
    int32_t k = mesh->triangles.data[triangle].source / KIRI_SOURCES_A_BLOCK, count = mesh->sourceCorners.count;
    if (mesh->sources.count > 0 || mesh->sourceBlocks.data[k] != KIRI_NONE) {
        return;
    }
    KIRI_ASSERT(k >= 0 && k < mesh->sourceBlocks.count && count % BLOCK_CORNERS == 0);
    KIRI_ASSERT(count + BLOCK_CORNERS <= mesh->sourceCorners.capacity);
    kiriLatticePoint* corners = &mesh->sourceCorners.data[count];
    memset(corners, 0, BLOCK_CORNERS * sizeof(*corners));
    KIRI_TIMES(i, KIRI_SOURCES_A_BLOCK) {
        (void)kiriMesh_SourceCorners(mesh, KIRI_SOURCES_A_BLOCK * k + i, corners + 3 * (ptrdiff_t)i);
    }
    mesh->sourceCorners.count += BLOCK_CORNERS;
    mesh->sourceBlocks.data[k] = count / BLOCK_CORNERS;
}

/* Writes the shares on the nearest edge, for a point that rounding has put beside the triangle. Areas do not tell which
   edge is the nearest if the triangle is a sliver. */
static void ShareNearestEdge(const kiriLatticePoint c[3], kiriLatticePoint at, double share[3])
{
    double nearest = 0.0;
    KIRI_EACH_CORNER(i) {
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

void kiriMesh_GetShare(const kiriMeshData* mesh, int32_t vertex, float to[3])
{
    kiriMesh_GetShareIn(mesh, vertex, mesh->vertices.data[vertex].source, to);
}

void kiriMesh_GetShareIn(const kiriMeshData* mesh, int32_t vertex, int32_t source, float to[3])
{
    kiriLatticePoint at = kiriMesh_At(mesh, vertex), c[3] = { 0 };
    bool isKnown = kiriMesh_SourceCorners(mesh, source, c), isInside = true;
    double share[3], sum = 0.0;
    KIRI_ASSERT(isKnown);
    (void)isKnown;
    KIRI_EACH_CORNER(i) {
        share[i] = (double)kiriOrient(c[(i + 1) % 3], c[(i + 2) % 3], at);
        isInside = isInside && share[i] >= 0.0;
        sum += share[i];
    }
    if (!isInside) {
        ShareNearestEdge(c, at, share);
        sum = 1.0;
    }
    KIRI_EACH_CORNER(i) {
        to[i] = (float)(share[i] / sum);
    }
}
