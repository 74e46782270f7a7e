#include "kiri_slit.h"

/* ---- Slit ends ---- */

/* The next corner of the fan clockwise, or KIRI_NONE where the fan begins. */
static int32_t ClockwiseOf(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_IsOpen(mesh, h) ? KIRI_NONE : kiriMesh_Twin(mesh, h);
    return twin == KIRI_NONE ? KIRI_NONE : kiriEdge_Next(twin);
}

/* The open half-edge that leaves the vertex, where its fan goes all around from the one lip of that edge to the other;
   else KIRI_NONE. */
static int32_t LipAt(const kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
    int32_t start = mesh->vertices.data[vertex].edge, first = start, last = start;
    for (int32_t h = ClockwiseOf(mesh, first); h != KIRI_NONE; h = ClockwiseOf(mesh, h)) {
        if (h == start) {
            return KIRI_NONE; /* no edge is open */
        }
        first = h;
    }
    for (int32_t h = start; h != KIRI_NONE; h = kiriMesh_CounterClockwise(mesh, h)) {
        last = h;
    }
    bool isEnd = kiriMesh_IsOpen(mesh, first) && kiriMesh_Twin(mesh, kiriEdge_Previous(last)) == first;
    return isEnd ? first : KIRI_NONE;
}

/* Adds the vertices it looks at. */
static bool SearchCell(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell, kiriSlitEnd* end, int32_t* looks)
{
    int32_t square = grid->cells.data[cell].square;
    int32_t v = grid->whole.data[square] ? KIRI_NONE : mesh->squares.vertexHead[square];
    for (; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
        int32_t lip = kiriGrid_CellOfVertex(grid, mesh, v) == cell ? LipAt(mesh, v) : KIRI_NONE;
        *looks += 1;
        if (lip != KIRI_NONE) {
            int32_t before = kiriMesh_Tail(mesh, kiriEdge_Next(lip));
            end->at = kiriMesh_Local(mesh, mesh->vertices.data[v].at);
            kiriVec2 way = kiriVec2_Sub(end->at, kiriMesh_Local(mesh, mesh->vertices.data[before].at));
            end->along = kiriVec2_Scale(1.0 / kiriVec2_Length(way), way);
            end->cell = cell;
            return true;
        }
    }
    return false;
}

bool kiriSlits_FindEndIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell, kiriSlitEnd* end)
{
    int32_t looks = 0;
    return SearchCell(grid, mesh, cell, end, &looks);
}

enum { SEARCHED_CELLS_AN_ITEM = 16, SEARCHED_VERTICES_AN_ITEM = 3 };

kiriProgress kiriSlits_FindEnds(kiriSlitEnds* ends, kiriSlitSearch* search, kiriMemory* memory, const kiriGrid* grid,
                                const kiriMeshData* mesh, const int32_t* cells, int32_t cellCount, kiriQuota* quota)
{
    ends->count = search->seen == 0 ? 0 : ends->count;
    while (kiriQuota_Pay(quota, &search->owed)) {
        kiriSlitEnd end;
        int32_t looks = 0;
        if (search->seen == cellCount) {
            return KIRI_DONE;
        }
        if (SearchCell(grid, mesh, cells[search->seen], &end, &looks) && !kiriArray_Push(memory, ends, end)) {
            return KIRI_FAILED;
        }
        search->owed = (search->seen % SEARCHED_CELLS_AN_ITEM == 0) + looks / SEARCHED_VERTICES_AN_ITEM;
        search->seen += 1;
    }
    return KIRI_MORE;
}

/* ---- Pairs ---- */

/* The cell to which the straight way through the material leads, or KIRI_NONE where a cut or the outline is in it. */
static int32_t CellAlong(const kiriGrid* grid, const kiriMeshData* mesh, const kiriSlitEnd* end, kiriVec2 way)
{
    int32_t cell = end->cell, parts = (int32_t)(2.0 * kiriVec2_Length(way) / grid->side) + 1;
    for (int32_t k = 1; k <= parts && cell != KIRI_NONE; ++k) {
        kiriVec2 at = kiriVec2_Add(end->at, kiriVec2_Scale((double)k / parts, way));
        int32_t next = kiriGrid_CellAt(grid, mesh, kiriMesh_Snap(mesh, at));
        cell = next != KIRI_NONE && kiriGrid_AreNear(grid, cell, next) ? next : KIRI_NONE;
    }
    return cell;
}

static bool HasRoom(const kiriSites* sites, const kiriSite* site, double distance)
{
    for (int32_t i = 0; i < sites->count; ++i) {
        kiriVec2 off = kiriVec2_Sub(site->at, sites->data[i].at);
        if (sites->data[i].cell == site->cell || kiriVec2_Dot(off, off) < distance * distance) {
            return false;
        }
    }
    return true;
}

/* So far to both sides; false where there is no room. The sites have room for two more. */
static bool TryPair(kiriSites* sites, const kiriGrid* grid, const kiriMeshData* mesh, const kiriSlitEnd* end,
                    double reach)
{
    kiriVec2 left = kiriVec2_Make(-reach * end->along.y, reach * end->along.x);
    kiriVec2 right = kiriVec2_Scale(-1.0, left);
    kiriSite a = { kiriVec2_Add(end->at, left), CellAlong(grid, mesh, end, left) };
    kiriSite b = { kiriVec2_Add(end->at, right), CellAlong(grid, mesh, end, right) };
    if (a.cell == KIRI_NONE || b.cell == KIRI_NONE || a.cell == b.cell || !HasRoom(sites, &a, reach) ||
        !HasRoom(sites, &b, reach)) {
        return false;
    }
    sites->data[sites->count++] = a;
    sites->data[sites->count++] = b;
    return true;
}

/* Half the spacing to both sides, or less, but no less than a square. */
static void AddPair(kiriSites* sites, const kiriGrid* grid, const kiriMeshData* mesh, const kiriSlitEnd* end,
                    double spacing)
{
    double reach = kiriMax(0.5 * spacing, grid->side);
    while (!TryPair(sites, grid, mesh, end, reach) && reach > grid->side) {
        reach = kiriMax(0.5 * reach, grid->side);
    }
}

bool kiriSlits_AddPairs(kiriSites* sites, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriSlitEnds* ends, double spacing, int32_t most)
{
    if (!kiriArray_Reserve(memory, sites, most)) {
        return false;
    }
    for (int32_t i = 0; i < ends->count && sites->count + 2 <= most; ++i) {
        AddPair(sites, grid, mesh, &ends->data[i], spacing);
    }
    return true;
}
