#include "kiri_grid_work.h"

#include "../core/kiri_hash.h"
#include "../core/kiri_sort.h"
#include "../core/kiri_union_find.h"

#include <string.h>

/* ---- What an update changes -------------------------------------------------------------------------------------- */

static void FreeCell(kiriGrid* grid, int32_t c)
{
    kiriGrid_DropMaterial(grid, c);
    grid->cells.data[c].next = grid->freeCell;
    grid->freeCell = c;
}

enum { GRID_LISTS = 4 }; /* of changes, without that of what is gone */

/* A cell that is gone leaves a list of changes. Those that came and went since ClearChanges leave no trace. */
static void ForgetChange(kiriGrid* grid, const void* list, const void* change)
{
    int32_t cell;
    memcpy(&cell, change, sizeof(cell));
    if (list == &grid->changes.made) {
        FreeCell(grid, cell);
    } else if (list == &grid->changes.material) {
        grid->materials.data[grid->cells.data[cell].material] = ((const kiriMaterialChange*)change)->was;
    }
}

/* Takes cells that are gone out of one of the other lists; a change begins with its cell. */
static kiriProgress ForgetGone(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    kiriGridChanges* changes = &grid->changes;
    kiriGridWork* work = grid->work;
    void* const lists[GRID_LISTS] = { &changes->steps, &changes->edges, &changes->material, &changes->made };
    size_t bytes = lists[item] == &changes->material ? sizeof(kiriMaterialChange) : sizeof(int32_t);
    kiriArrayHeader list = kiriArray_GetHeader(lists[item]);
    (void)mesh;
    while (work->at < list.count) {
        const char* change = (const char*)list.data + bytes * (size_t)work->at++;
        int32_t cell;
        memcpy(&cell, change, sizeof(cell));
        if (kiriGrid_IsCell(grid, cell)) {
            memmove((char*)list.data + bytes * (size_t)work->other++, change, bytes);
        } else {
            ForgetChange(grid, lists[item], change);
        }
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    list.count = work->other;
    kiriArray_SetHeader(lists[item], list);
    return KIRI_DONE;
}

/* ---- The update -------------------------------------------------------------------------------------------------- */

/* Algorithm 3, each stage over the items of a list. All faces need all cells, diagonal steps all faces, and knights all
   diagonal steps. */
enum { GRID_STAGES = 6 };
static kiriGridStageFn* const gridStages[GRID_STAGES] = {
    kiriGrid_MakeCells,       /* of all squares, or the dirty ones */
    kiriGrid_MakeFaces,       /* of squares with new cells */
    kiriGrid_SpreadDirty,     /* from squares where a face came or went, to the cells whose steps may use it */
    kiriGrid_MakeNearSteps,   /* of these cells, */
    kiriGrid_MakeKnightSteps, /* and those that are not amid whole squares */
    ForgetGone,               /* in the lists of changes */
};

static int32_t CountStageItems(const kiriGridWork* work, const kiriMeshData* mesh)
{
    int32_t squares = work->fromScratch ? mesh->squares.columns * mesh->squares.rows : mesh->squares.dirty.count;
    const int32_t counts[GRID_STAGES] = { squares,
                                          work->facesDirty.count,
                                          work->linksDirty.count,
                                          work->stepsDirty.count,
                                          work->knightsDirty.count,
                                          work->removed ? GRID_LISTS : 0 };
    return counts[work->stage];
}

/* Room for a cell a square; growing adds an eighth for what cuts make, so that the first one need not move
   everything. */
static bool ReserveCells(kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriGridWork* work = grid->work;
    kiriMemory* memory = mesh->memory;
    int64_t squares = 0;
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        squares += mesh->squares.head[s] != KIRI_NONE;
    }
    int64_t cells = squares + 64;
    return kiriArray_Reserve(memory, &grid->cells, cells) && kiriArray_Reserve(memory, &grid->runs, cells) &&
           kiriArray_Reserve(memory, &work->cellFlags, cells) && kiriArray_Reserve(memory, &work->mark, cells) &&
           kiriArray_Reserve(memory, &grid->changes.made, cells) &&
           kiriArray_Reserve(memory, &grid->changes.steps, cells) &&
           kiriArray_Reserve(memory, &work->stepsDirty, cells) && kiriArray_Reserve(memory, &grid->faces, 2 * cells);
}

/* Before the first update ever, or after a reset. */
static bool StartGridFromScratch(kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriGridWork* work = grid->work;
    int32_t squareCount = mesh->squares.columns * mesh->squares.rows;
    if (!kiriArray_ResizeJust(mesh->memory, &grid->squareCell, squareCount) ||
        !kiriArray_ResizeJust(mesh->memory, &grid->whole, squareCount) ||
        !kiriArray_ResizeJust(mesh->memory, &work->squareFlags, squareCount) ||
        !kiriArray_ResizeJust(mesh->memory, &work->ranges, squareCount)) {
        return false;
    }
    memset(grid->whole.data, 0, (size_t)squareCount);
    memset(work->squareFlags.data, 0, (size_t)squareCount);
    for (int32_t s = 0; s < squareCount; ++s) {
        grid->squareCell.data[s] = KIRI_NONE;
    }
    grid->side = mesh->step * mesh->squares.side;
    grid->freeCell = grid->freeFace = KIRI_NONE;
    kiriGrid_StartSteps(grid, mesh);
    return ReserveCells(grid, mesh);
}

enum { GRID_ROOMS = 12 };

/* Room for a cell more in half of the squares that changed, and for steps around them. */
static void ListGridRooms(kiriGrid* grid, const kiriMeshData* mesh, kiriRoom rooms[GRID_ROOMS])
{
    kiriGridWork* work = grid->work;
    int64_t more = mesh->squares.dirty.count / 2 + 64, cells = grid->cells.count + more;
    int64_t notOpen = 5 * (int64_t)mesh->squares.dirty.count + 64; /* a cut, and two rows of squares on each side */
    int64_t materials = grid->materials.count + mesh->squares.dirty.count + more,
            stretches = grid->stretches.count + 2 * (mesh->squares.dirty.count + more);
    kiriMemory* memory = mesh->memory;
    const kiriRoom all[GRID_ROOMS] = { KIRI_ROOM(memory, &grid->cells, cells),
                                       KIRI_ROOM(memory, &grid->runs, cells),
                                       KIRI_ROOM(memory, &work->cellFlags, cells),
                                       KIRI_ROOM(memory, &work->mark, cells),
                                       KIRI_ROOM(memory, &grid->faces, grid->faces.count + 2 * more),
                                       KIRI_ROOM(memory, &grid->materials, materials),
                                       KIRI_ROOM(memory, &grid->unusedMaterials, materials),
                                       KIRI_ROOM(memory, &grid->stretches, stretches),
                                       KIRI_ROOM(memory, &grid->unusedStretches, stretches),
                                       KIRI_ROOM(memory, &grid->steps, grid->steps.count + KIRI_OPEN_STEPS * notOpen),
                                       KIRI_ROOM(memory, &grid->nodeCell, mesh->squares.nodes.capacity),
                                       KIRI_ROOM(memory, &grid->vertexCell, mesh->vertices.capacity) };
    memcpy(rooms, all, sizeof(all));
}

/* So that no tick moves all arrays. */
static kiriProgress MakeRoomForCells(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota)
{
    enum { CELL_BYTES = 512 }; /* that an item moves */
    kiriRoom rooms[GRID_ROOMS];
    if (grid->work == NULL || grid->squareCell.count == 0) {
        return KIRI_DONE;
    }
    ListGridRooms(grid, mesh, rooms);
    return kiriGrowing_GoOn(&grid->work->growing, rooms, GRID_ROOMS, quota, CELL_BYTES);
}

void kiriGrid_ArchiveGrowing(kiriArchive* archive, kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriRoom rooms[GRID_ROOMS];
    if (grid->work != NULL) {
        ListGridRooms(grid, mesh, rooms);
        kiriArchive_Growing(archive, &grid->work->growing, rooms, GRID_ROOMS);
    }
}

static bool StartGridUpdate(kiriGrid* grid, const kiriMeshData* mesh)
{
    if (grid->work == NULL) {
        grid->work = kiriMemory_AllocZeroed(mesh->memory, sizeof(*grid->work));
    }
    if (grid->work == NULL) {
        return false;
    }
    grid->work->fromScratch = grid->squareCell.count == 0;
    grid->work->running = true;
    return (!grid->work->fromScratch || StartGridFromScratch(grid, mesh)) &&
           kiriArray_ReserveJust(mesh->memory, &grid->nodeCell, mesh->squares.nodes.capacity) &&
           kiriArray_Resize(mesh->memory, &grid->nodeCell, mesh->squares.nodes.count) &&
           kiriArray_ReserveJust(mesh->memory, &grid->vertexCell, mesh->vertices.capacity) &&
           kiriArray_Resize(mesh->memory, &grid->vertexCell, mesh->vertices.count);
}

/* Done, or given up. */
static void EndGridUpdate(kiriGridWork* work)
{
    for (int32_t i = 0; i < work->flagged.count; ++i) {
        work->squareFlags.data[work->flagged.data[i]] = 0;
    }
    work->flagged.count = work->facesDirty.count = work->linksDirty.count = work->stepsDirty.count =
        work->knightsDirty.count = 0;
    work->entries.count = work->parent.count = 0;
    work->due = work->stage = work->item = work->part = work->at = work->other = 0;
    work->running = work->removed = work->isAmidPart = work->isCollecting = work->isMerging = false;
}

static kiriProgress RunGridStages(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    for (; work->stage < GRID_STAGES; ++work->stage, work->item = 0) {
        for (; work->item < CountStageItems(work, mesh); ++work->item) {
            kiriProgress progress =
                kiriGridWork_Pay(work, quota) ? gridStages[work->stage](grid, mesh, work->item, quota) : KIRI_MORE;
            if (progress != KIRI_DONE) {
                return progress;
            }
            work->at = work->other = 0;
        }
    }
    return KIRI_DONE;
}

kiriProgress kiriGrid_Update(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota)
{
    if (grid->work == NULL || !grid->work->running) {
        kiriProgress room = MakeRoomForCells(grid, mesh, quota);
        if (room != KIRI_DONE) {
            return room;
        }
        if (!StartGridUpdate(grid, mesh)) {
            return KIRI_FAILED;
        }
    }
    KIRI_ASSERT(grid->nodeCell.count == mesh->squares.nodes.count); /* else the mesh has changed during the update */
    kiriProgress progress = RunGridStages(grid, mesh, quota);
    if (progress == KIRI_DONE && !kiriGridWork_Pay(grid->work, quota)) {
        progress = KIRI_MORE;
    }
    if (progress == KIRI_DONE) {
        EndGridUpdate(grid->work);
    }
    return progress;
}

void kiriGrid_ClearChanges(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    KIRI_ASSERT(grid->work == NULL || !grid->work->running);
    for (int32_t i = 0; i < changes->gone.count; ++i) {
        FreeCell(grid, changes->gone.data[i]);
    }
    for (int32_t i = 0; i < changes->steps.count; ++i) {
        grid->work->cellFlags.data[changes->steps.data[i]] = 0;
    }
    for (int32_t i = 0; i < changes->material.count; ++i) {
        grid->work->cellFlags.data[changes->material.data[i].cell] = 0;
    }
    for (int32_t i = 0; i < changes->edges.count; ++i) {
        grid->work->cellFlags.data[changes->edges.data[i]] = 0;
    }
    changes->made.count = changes->gone.count = changes->steps.count = changes->material.count = 0;
    changes->edges.count = 0;
}

void kiriGrid_HashProgress(const kiriGrid* grid, uint64_t* hash)
{
    const kiriGridWork* work = grid->work;
    if (work != NULL && work->running) {
        kiriHash_Int64(hash, work->due);
        kiriHash_Pair(hash, work->stage, work->item);
        kiriHash_Pair(hash, work->at, work->other);
        if (work->isAmidPart) {
            kiriHash_Pair(hash, work->part, work->node);
        }
    }
}

void kiriGrid_DropScratch(kiriGrid* grid, kiriMemory* memory)
{
    kiriGridChanges* changes = &grid->changes;
    kiriGridWork* work = grid->work;
    KIRI_ASSERT(!work->running && changes->made.count == 0 && changes->edges.count == 0);
    kiriArray_Release(memory, &changes->made);
    kiriArray_Release(memory, &changes->steps);
    kiriArray_Release(memory, &changes->edges);
    kiriArray_Release(memory, &work->facesDirty);
    kiriArray_Release(memory, &work->linksDirty);
    kiriArray_Release(memory, &work->stepsDirty);
    kiriArray_Release(memory, &work->knightsDirty);
    kiriArray_Release(memory, &work->flagged);
    kiriArray_Release(memory, &work->entries);
    kiriArray_Release(memory, &work->parent);
    kiriArray_Shorten(memory, &grid->steps, sizeof(*grid->steps.data));
}

void kiriGrid_Reset(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    grid->cells.count = grid->runs.count = grid->steps.count = grid->faces.count = grid->squareCell.count = 0;
    grid->nodeCell.count = grid->vertexCell.count = grid->whole.count = grid->cellCount = 0;
    grid->materials.count = grid->stretches.count = grid->unusedMaterials.count = grid->unusedStretches.count = 0;
    changes->made.count = changes->gone.count = changes->steps.count = changes->material.count = 0;
    changes->edges.count = 0;
    memset(&grid->stepRoom, 0, sizeof(grid->stepRoom));
    if (grid->work != NULL) {
        kiriGrowing_Drop(&grid->work->growing);
        grid->work->cellFlags.count = grid->work->mark.count = 0;
        EndGridUpdate(grid->work);
    }
}

/* ---- What is left ------------------------------------------------------------------------------------------------ */

static void TakeCellAway(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, c));
    kiriCell* cell = &grid->cells.data[c];
    int32_t* link = &grid->squareCell.data[cell->square];
    while (*link != c) {
        link = &grid->cells.data[*link].next;
    }
    *link = cell->next;
    while (cell->firstFace != KIRI_NONE) {
        kiriGrid_FreeFace(grid, cell->firstFace);
    }
    kiriGrid_RemoveSteps(grid, memory, c);
    grid->whole.data[cell->square] = 0; /* a square with another cell was not whole either */
    cell->square = KIRI_NONE;
    --grid->cellCount;
    FreeCell(grid, c);
}

void kiriGrid_Keep(kiriGrid* grid, kiriMemory* memory, const kiriKeep* triangles, const kiriKeep* vertices,
                   const int32_t* gone, int32_t goneCount)
{
    KIRI_ASSERT(!grid->work->running && grid->changes.steps.count == 0 && grid->changes.gone.count == 0);
    kiriGrowing_Drop(&grid->work->growing); /* what has been moved is no more what is there */
    for (int32_t k = 0; k < goneCount; ++k) {
        TakeCellAway(grid, memory, gone[k]);
    }
    kiriKeep_Compact(vertices, &grid->vertexCell, 1, sizeof(int32_t));
    for (int32_t c = 0; c < grid->cells.count && kiriKeep_Moves(triangles); ++c) {
        if (kiriGrid_IsCell(grid, c)) {
            grid->cells.data[c].triangle = kiriKeep_To(triangles, grid->cells.data[c].triangle);
        }
    }
}

/* ---- Questions --------------------------------------------------------------------------------------------------- */

static bool IsCellBefore(const void* grid, int32_t a, int32_t b)
{
    return kiriGrid_IsBefore(grid, a, b);
}

void kiriGrid_SortCells(const kiriGrid* grid, int32_t* cells, int32_t count)
{
    kiriSort(cells, count, IsCellBefore, grid);
}

int32_t kiriGrid_CellOf(const kiriGrid* grid, const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&mesh->squares, at);
    int32_t node = square == KIRI_NONE ? KIRI_NONE : mesh->squares.head[square];
    while (node != KIRI_NONE && mesh->squares.nodes.data[node].triangle != triangle) {
        node = mesh->squares.nodes.data[node].next;
    }
    KIRI_ASSERT(node < grid->nodeCell.count);
    return node == KIRI_NONE ? KIRI_NONE : grid->nodeCell.data[node];
}

int32_t kiriGrid_CellOfVertex(const kiriGrid* grid, const kiriMeshData* mesh, int32_t vertex)
{
    int32_t square = kiriSquares_At(&mesh->squares, mesh->vertices.data[vertex].at),
            first = grid->squareCell.data[square];
    KIRI_ASSERT(vertex < grid->vertexCell.count);
    return grid->cells.data[first].next == KIRI_NONE ? first : grid->vertexCell.data[vertex];
}

kiriVec2 kiriGrid_Middle(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, grid->cells.data[cell].square));
    return kiriVec2_Add(corner, kiriVec2_Make(0.5 * grid->side, 0.5 * grid->side));
}

int32_t kiriGrid_CellAt(const kiriGrid* grid, const kiriMeshData* mesh, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(mesh, at);
    return triangle == KIRI_NONE ? KIRI_NONE : kiriGrid_CellOf(grid, mesh, triangle, at);
}

int32_t kiriGrid_CellAround(const kiriGrid* grid, const kiriMeshData* mesh, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&mesh->squares, at);
    int32_t first = square == KIRI_NONE ? KIRI_NONE : grid->squareCell.data[square];
    if (first == KIRI_NONE || grid->cells.data[first].next == KIRI_NONE) {
        return first; /* there is no choice */
    }
    int32_t cell = kiriGrid_CellAt(grid, mesh, at);
    return cell == KIRI_NONE ? first : cell;
}

void kiriGrid_JoinCells(const kiriGrid* grid, int32_t* parent)
{
    kiriUnion_Init(parent, grid->cells.count);
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        kiriSteps steps;
        if (kiriGrid_IsCell(grid, c)) {
            kiriGrid_GetStepsTo(grid, c, 1, &steps);
            for (int32_t s = 0; s < steps.end[0]; ++s) {
                kiriUnion_Join(parent, c, steps.data[s].cell);
            }
        }
    }
}
