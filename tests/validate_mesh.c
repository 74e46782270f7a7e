#include "validate_check.h"

#include <stdlib.h>
#include <string.h>

/* ---- Triangles and edges ---- */

static bool Check_Triangles(Check* check, const kiriMeshData* mesh)
{
    int32_t corners = mesh->sourceCorners.count;
    REQUIRE(mesh->sources.count > 0 ? 3 * mesh->sources.count == corners : corners % (3 * KIRI_SOURCES_A_BLOCK) == 0,
            "%d sources have %d corners", mesh->sources.count, corners);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        for (int i = 0; i < 3; ++i) {
            REQUIRE(IsIndex(triangle->vertex[i], mesh->vertices.count), "triangle %d has vertex %d", t,
                    triangle->vertex[i]);
            REQUIRE(triangle->twin[i] == KIRI_NONE || IsIndex(triangle->twin[i], 3 * mesh->triangles.count),
                    "half-edge %d has twin %d", 3 * t + i, triangle->twin[i]);
        }
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        REQUIRE(kiriOrient(c[0], c[1], c[2]) > 0, "triangle %d is turned over or has no area", t);
        REQUIRE(((c[0].x | c[0].y) & 1) == 0, "triangle %d has a corner with an odd coordinate", t);
        REQUIRE(kiriMesh_SourceCorners(mesh, triangle->source, c), "triangle %d is of source %d", t, triangle->source);
        REQUIRE((triangle->marks >> 4 & ~triangle->marks) == 0 &&
                    (triangle->marks & ~(KIRI_TRIANGLE_OPEN | KIRI_TRIANGLE_CREASE | (mesh->isOpen ? KIRI_TRIANGLE_CHANGED : 0))) == 0,
                "triangle %d has marks %d", t, triangle->marks);
    }
    return true;
}

static kiriLatticePoint Validate_TailAt(const kiriMeshData* mesh, int32_t h)
{
    return mesh->vertices.data[kiriMesh_Tail(mesh, h)].at;
}

static bool IsSamePoint(kiriLatticePoint a, kiriLatticePoint b)
{
    return a.x == b.x && a.y == b.y;
}

static bool Check_Twins(Check* check, const kiriMeshData* mesh)
{
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin == KIRI_NONE) {
            REQUIRE(!kiriMesh_IsOpen(mesh, h), "half-edge %d of the outline is marked open", h);
            continue;
        }
        REQUIRE(twin / 3 != h / 3 && kiriMesh_Twin(mesh, twin) == h, "half-edge %d has twin %d, which has %d", h, twin,
                kiriMesh_Twin(mesh, twin));
        REQUIRE(kiriMesh_IsOpen(mesh, h) == kiriMesh_IsOpen(mesh, twin), "only one of twins %d and %d is open", h,
                twin);
        REQUIRE(IsSamePoint(Validate_TailAt(mesh, h), Validate_TailAt(mesh, kiriEdge_Next(twin))),
                "half-edge %d does not begin where its twin %d ends", h, twin);
    }
    return true;
}

/* A table of half-edges by the places of their ends. */
typedef struct EdgeTable {
    const kiriMeshData* mesh;
    int32_t* slot;
    uint32_t mask;
} EdgeTable;

static uint32_t EdgeTable_Slot(const EdgeTable* table, kiriLatticePoint from, kiriLatticePoint to)
{
    uint64_t key = (uint64_t)(uint32_t)from.x * 0x9e3779b97f4a7c15u + (uint64_t)(uint32_t)from.y;
    key = (key ^ key >> 29) * 0xbf58476d1ce4e5b9u + (uint64_t)(uint32_t)to.x;
    key = (key ^ key >> 32) * 0x94d049bb133111ebu + (uint64_t)(uint32_t)to.y;
    uint32_t slot = (uint32_t)((key * 0x9e3779b97f4a7c15u) >> 32) & table->mask;
    while (table->slot[slot] != KIRI_NONE &&
           !(IsSamePoint(Validate_TailAt(table->mesh, table->slot[slot]), from) &&
             IsSamePoint(Validate_TailAt(table->mesh, kiriEdge_Next(table->slot[slot])), to))) {
        slot = (slot + 1) & table->mask;
    }
    return slot;
}

/* No two half-edges run from the same place to the same place; where the mesh conforms, those that run to and fro
   between two places are twins. */
static bool Check_Places(Check* check, const kiriMeshData* mesh, bool isConforming)
{
    int32_t count = 3 * mesh->triangles.count;
    EdgeTable table = { mesh, NULL, 7 };
    while ((int64_t)table.mask < 2 * (int64_t)count) {
        table.mask = 2 * table.mask + 1;
    }
    table.slot = Check_Ints(check, (int64_t)table.mask + 1, KIRI_NONE);
    for (int32_t h = 0; h < count; ++h) {
        uint32_t slot = EdgeTable_Slot(&table, Validate_TailAt(mesh, h), Validate_TailAt(mesh, kiriEdge_Next(h)));
        REQUIRE(table.slot[slot] == KIRI_NONE, "half-edges %d and %d lie on each other", table.slot[slot], h);
        table.slot[slot] = h;
    }
    for (int32_t h = 0; isConforming && h < count; ++h) {
        if (kiriMesh_Twin(mesh, h) == KIRI_NONE) {
            uint32_t slot = EdgeTable_Slot(&table, Validate_TailAt(mesh, kiriEdge_Next(h)), Validate_TailAt(mesh, h));
            REQUIRE(table.slot[slot] == KIRI_NONE, "half-edges %d and %d are not twins", h, table.slot[slot]);
        }
    }
    return true;
}

/* Corners joined over closed edges are a fan: each has exactly one vertex, and each vertex exactly one fan. */
static bool Check_Fans(Check* check, const kiriMeshData* mesh)
{
    int32_t count = 3 * mesh->triangles.count, fans = count;
    int32_t* fan = Check_Unions(check, count);
    int32_t* rootOf = Check_Ints(check, mesh->vertices.count, KIRI_NONE);
    for (int32_t h = 0; h < count; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin != KIRI_NONE && !kiriMesh_IsOpen(mesh, h)) {
            fans = Union_Join(fan, h, kiriEdge_Next(twin), fans);
        }
    }
    for (int32_t h = 0; h < count; ++h) {
        int32_t vertex = kiriMesh_Tail(mesh, h), root = Union_Root(fan, h);
        rootOf[vertex] = rootOf[vertex] == KIRI_NONE ? root : rootOf[vertex];
        REQUIRE(rootOf[vertex] == root, "vertex %d is in two fans, of half-edges %d and %d", vertex, rootOf[vertex],
                root);
    }
    REQUIRE(fans == mesh->vertices.count, "%d fans, %d vertices", fans, mesh->vertices.count);
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t edge = mesh->vertices.data[v].edge;
        REQUIRE(IsIndex(edge, count), "vertex %d has half-edge %d", v, edge);
        REQUIRE(edge == KIRI_NONE || kiriMesh_Tail(mesh, edge) == v, "vertex %d has half-edge %d", v, edge);
    }
    return true;
}

/* ---- Squares ---- */

/* Do the interiors of the square and the triangle overlap? By separating axes: the sides of both. */
static bool IsOver(const kiriSquares* squares, int32_t square, const kiriLatticePoint c[3])
{
    kiriLatticePoint low = kiriSquares_Corner(squares, square), high = { low.x + squares->side, low.y + squares->side };
    const kiriLatticePoint corners[4] = { low, { high.x, low.y }, high, { low.x, high.y } };
    bool isApart = (c[0].x <= low.x && c[1].x <= low.x && c[2].x <= low.x) ||
                   (c[0].x >= high.x && c[1].x >= high.x && c[2].x >= high.x) ||
                   (c[0].y <= low.y && c[1].y <= low.y && c[2].y <= low.y) ||
                   (c[0].y >= high.y && c[1].y >= high.y && c[2].y >= high.y);
    for (int i = 0; i < 3 && !isApart; ++i) {
        isApart = true;
        for (int k = 0; k < 4; ++k) {
            isApart = isApart && kiriOrient(c[i], c[(i + 1) % 3], corners[k]) <= 0;
        }
    }
    return !isApart;
}

/* In how many squares the triangle lies. */
static int32_t CountOverlaps(const kiriSquares* squares, const kiriLatticePoint c[3])
{
    int32_t low[2] = { INT32_MAX, INT32_MAX }, high[2] = { INT32_MIN, INT32_MIN }, count = 0;
    for (int i = 0; i < 3; ++i) {
        int32_t xy[2] = { (c[i].x + 1) / squares->side - squares->firstColumn,
                          (c[i].y + 1) / squares->side - squares->firstRow };
        for (int axis = 0; axis < 2; ++axis) {
            low[axis] = xy[axis] < low[axis] ? xy[axis] : low[axis];
            high[axis] = xy[axis] > high[axis] ? xy[axis] : high[axis];
        }
    }
    for (int32_t row = low[1]; row <= high[1]; ++row) {
        for (int32_t column = low[0]; column <= high[0]; ++column) {
            count += IsOver(squares, row * squares->columns + column, c) ? 1 : 0;
        }
    }
    return count;
}

/* Each square lists exactly the triangles that overlap it; the other nodes are free. */
static bool Check_Squares(Check* check, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t listed = 0, expected = 0, freeNodes = 0;
    int32_t* seen = Check_Ints(check, mesh->triangles.count, KIRI_NONE);
    for (int32_t s = 0; s < squares->columns * squares->rows; ++s) {
        for (int32_t i = squares->head[s]; i != KIRI_NONE; i = squares->nodes.data[i].next) {
            REQUIRE(IsIndex(i, squares->nodes.count), "square %d has node %d", s, i);
            int32_t t = squares->nodes.data[i].triangle;
            kiriLatticePoint corners[3];
            REQUIRE(IsIndex(t, mesh->triangles.count), "square %d lists triangle %d", s, t);
            kiriMesh_Corners(mesh, t, corners);
            REQUIRE(seen[t] != s, "square %d lists triangle %d twice", s, t);
            REQUIRE(IsOver(squares, s, corners), "square %d lists triangle %d, which is elsewhere", s, t);
            seen[t] = s;
            ++listed;
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        expected += CountOverlaps(squares, c);
    }
    REQUIRE(listed == expected, "squares list %d triangles of %d", listed, expected);
    for (int32_t i = squares->freeNode; i != KIRI_NONE; i = squares->nodes.data[i].next) {
        REQUIRE(IsIndex(i, squares->nodes.count) && freeNodes < squares->nodes.count, "free node %d", i);
        REQUIRE(squares->nodes.data[i].triangle == KIRI_NONE, "free node %d has a triangle", i);
        ++freeNodes;
    }
    REQUIRE(listed + freeNodes == squares->nodes.count, "%d nodes are used and %d free, of %d", listed, freeNodes,
            squares->nodes.count);
    return true;
}

/* Each vertex is in the list of its square, later ones first. */
static bool Check_VertexLists(Check* check, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t listed = 0;
    for (int32_t s = 0; s < squares->columns * squares->rows; ++s) {
        int32_t last = INT32_MAX;
        for (int32_t v = squares->vertexHead[s]; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
            REQUIRE(IsIndex(v, mesh->vertices.count) && v < last, "square %d lists vertex %d after %d", s, v, last);
            REQUIRE(kiriSquares_At(squares, mesh->vertices.data[v].at) == s, "square %d lists vertex %d", s, v);
            last = v;
            ++listed;
        }
    }
    REQUIRE(listed == mesh->vertices.count, "squares list %d vertices of %d", listed,
            mesh->vertices.count);
    return true;
}

/* Dirty squares are marked, each once. */
static bool Check_DirtySquares(Check* check, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t count = squares->columns * squares->rows, marked = 0;
    for (int32_t s = 0; s < count; ++s) {
        marked += squares->isDirty[s] != 0;
    }
    for (int32_t i = 0; i < squares->dirty.count; ++i) {
        REQUIRE(IsIndex(squares->dirty.data[i], count), "square %d is dirty", squares->dirty.data[i]);
        REQUIRE(squares->isDirty[squares->dirty.data[i]], "dirty square %d is not marked", squares->dirty.data[i]);
    }
    REQUIRE(marked == squares->dirty.count, "%d squares are marked, %d listed", marked, squares->dirty.count);
    return true;
}

/* ---- Provenance ---- */

/* Source and share give the vertex's place back, but for rounding and for the splits of edges that gave way beside thin
   triangles; and the fan of a vertex has a part of its source triangle: a torn
   vertex takes nothing from the other lip. */
static bool Check_Provenance(Check* check, const kiriMeshData* mesh)
{
    uint8_t* found = Check_Bytes(check, mesh->vertices.count);
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t v = kiriMesh_Tail(mesh, h);
        found[v] |= mesh->vertices.data[v].source == mesh->triangles.data[h / 3].source;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        double x = 0.0, y = 0.0, sum = 0.0, near = 1.5e-7 * 536870912.0;
        REQUIRE(found[v], "vertex %d takes its source %d from elsewhere", v, vertex->source);
        float share[3];
        kiriLatticePoint corners[3];
        kiriMesh_GetShare(mesh, v, share);
        REQUIRE(kiriMesh_SourceCorners(mesh, vertex->source, corners), "vertex %d is of source %d", v, vertex->source);
        for (int i = 0; i < 3; ++i) {
            kiriLatticePoint c = corners[i];
            REQUIRE(share[i] >= 0.0f, "vertex %d has share %g", v, (double)share[i]);
            x += (double)share[i] * c.x;
            y += (double)share[i] * c.y;
            sum += (double)share[i];
        }
        REQUIRE(IsNear(sum, 1.0, 2e-7), "shares of vertex %d sum to %.9g", v, sum);
        REQUIRE(IsNear(x, vertex->at.x, near) && IsNear(y, vertex->at.y, near), "shares of vertex %d are of elsewhere",
                v);
    }
    return true;
}

/* What vertices born since kiriMesh_Begin say about their parents. Beside thin triangles a split is up to 16 steps off. */
static bool Check_Births(Check* check, const kiriMeshData* mesh)
{
    REQUIRE(mesh->births.count == mesh->vertices.count - mesh->oldVertexCount, "%d births, %d vertices before, %d now",
            mesh->births.count, mesh->oldVertexCount, mesh->vertices.count);
    for (int32_t i = 0; i < mesh->births.count; ++i) {
        const kiriBirth* birth = &mesh->births.data[i];
        int32_t vertex = mesh->oldVertexCount + i;
        kiriLatticePoint at = mesh->vertices.data[vertex].at;
        double x = 0.0, y = 0.0;
        for (int k = 0; k < 3; ++k) {
            REQUIRE(birth->parent[k] < vertex, "vertex %d is born of %d", vertex, birth->parent[k]);
            if (birth->parent[k] != KIRI_NONE) {
                x += birth->share[k] * mesh->vertices.data[birth->parent[k]].at.x;
                y += birth->share[k] * mesh->vertices.data[birth->parent[k]].at.y;
            }
        }
        REQUIRE(IsNear(x, at.x, 24.0) && IsNear(y, at.y, 24.0), "vertex %d is not where its parents have it", vertex);
    }
    return true;
}

bool Check_Mesh(Check* check, const kiriMeshData* mesh, bool isConforming)
{
    check->part = "mesh";
    return Check_Triangles(check, mesh) && Check_Twins(check, mesh) &&
           Check_Places(check, mesh, isConforming) && Check_Fans(check, mesh) && Check_Squares(check, mesh) &&
           Check_VertexLists(check, mesh) && Check_DirtySquares(check, mesh) && Check_Provenance(check, mesh) &&
           Check_Births(check, mesh);
}
