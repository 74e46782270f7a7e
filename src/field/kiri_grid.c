#include "kiri_grid.h"
#include "../core/kiri_archive.h"
#include "../core/kiri_array.h"

#include <string.h>

/* ---- Quota ------------------------------------------------------------------------------------------------------- */

bool kiriGridWork_Pay(kiriGridWork* work, kiriQuota* quota)
{
    int64_t owed = work->due / KIRI_GRID_ITEM, rest = work->due % KIRI_GRID_ITEM;
    bool isPaid = kiriQuota_Pay(quota, &owed);
    work->due = KIRI_GRID_ITEM * owed + rest;
    return isPaid;
}

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

bool kiriGridWork_Flag(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag)
{
    KIRI_ASSERT(square >= 0 && square < work->squareFlags.count);
    uint8_t* flags = &work->squareFlags.data[square];
    bool ok = *flags != 0 || kiriArray_Push(memory, &work->flagged, square);
    *flags |= (uint8_t)flag;
    return ok;
}

/* Puts the square in the list of a flag, once an update. */
static bool kiriGridWork_AddOnce(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag, kiriIndices* list)
{
    return kiriGridWork_IsFlagged(work, square, flag) ||
           (kiriGridWork_Flag(work, memory, square, flag) && kiriArray_Push(memory, list, square));
}

bool kiriGrid_RecordSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    KIRI_ASSERT(grid->work->running && kiriGrid_IsCell(grid, cell));
    uint8_t* flags = &grid->work->cellFlags.data[cell];
    bool isRecorded = (*flags & KIRI_CELL_STEPS) != 0;
    *flags |= KIRI_CELL_STEPS;
    return isRecorded || kiriArray_Push(memory, &grid->changes.steps, cell);
}

/* The face between two cells comes or goes. */
static bool kiriGrid_RecordLink(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b)
{
    KIRI_ASSERT(a >= 0 && a < grid->cells.count);
    kiriGridWork* work = grid->work;
    return work->fromScratch ||
           (kiriGrid_RecordSteps(grid, memory, a) && kiriGrid_RecordSteps(grid, memory, b) &&
            kiriGridWork_AddOnce(work, memory, grid->cells.data[a].square, KIRI_SQUARE_LINKS_DIRTY,
                                 &work->linksDirty) &&
            kiriGridWork_AddOnce(work, memory, grid->cells.data[b].square, KIRI_SQUARE_LINKS_DIRTY, &work->linksDirty));
}

/* ---- Triangles of a square --------------------------------------------------------------------------------------- */

/* By triangle: the order of a square's list does not matter. */
static bool IsNodeBefore(const void* nodes, int32_t a, int32_t b)
{
    return ((const kiriSquareNode*)nodes)[a].triangle < ((const kiriSquareNode*)nodes)[b].triangle;
}

static void TurnAround(int32_t* items, int32_t count)
{
    for (int32_t i = 0, j = count - 1; i < j; ++i, --j) {
        int32_t item = items[i];
        items[i] = items[j];
        items[j] = item;
    }
}

/* A list has the latest triangles first: turned around it is nearly in order. */
static kiriProgress CollectList(kiriGridWork* work, const kiriMeshData* mesh, kiriQuota* quota, int32_t first)
{
    while (work->node != KIRI_NONE) {
        if (!kiriArray_Push(mesh->memory, &work->parent, work->node) ||
            !kiriArray_Push(mesh->memory, &work->entries, work->node)) {
            return KIRI_FAILED;
        }
        work->node = mesh->squares.nodes.data[work->node].next;
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    TurnAround(work->entries.data + first, work->entries.count - first);
    for (int32_t i = first; i < work->entries.count; ++i) {
        work->parent.data[i] = i;
    }
    return KIRI_DONE;
}

static kiriProgress SortEntries(kiriGridWork* work, const kiriMeshData* mesh, kiriQuota* quota, int32_t first)
{
    enum { FEW = 64, MOVES = 512 };
    int32_t *entries = work->entries.data + first, count = work->entries.count - first;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    if (count <= FEW) {
        kiriSort(entries, count, IsNodeBefore, nodes);
        work->due += KIRI_GRID_NODE * count;
        return KIRI_DONE;
    }
    if (!kiriArray_Resize(mesh->memory, &work->sortRoom, count)) {
        return KIRI_FAILED;
    }
    while (!kiriSorting_GoOn(&work->sorting, entries, work->sortRoom.data, count, IsNodeBefore, nodes, MOVES)) {
        if (!kiriGridWork_Spend(work, quota, MOVES * KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return KIRI_DONE;
}

/* Gets a square's triangles, sorted, into `entries`: where they must be known one by one. */
static kiriProgress kiriGridWork_Collect(kiriGridWork* work, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    KIRI_ASSERT(square >= 0 && square < work->ranges.count);
    kiriNodeRange* range = &work->ranges.data[square];
    if (kiriGridWork_IsFlagged(work, square, KIRI_SQUARE_COLLECTED)) {
        return KIRI_DONE;
    }
    if (!work->isCollecting) {
        work->isCollecting = true;
        work->isSorting = false;
        work->node = mesh->squares.head[square];
        work->sorting = (kiriSorting){ 0, 0, 0, 0, 0 };
        range->first = work->entries.count;
    }
    kiriProgress progress = work->isSorting ? KIRI_DONE : CollectList(work, mesh, quota, range->first);
    work->isSorting = progress == KIRI_DONE;
    progress = progress == KIRI_DONE ? SortEntries(work, mesh, quota, range->first) : progress;
    if (progress != KIRI_DONE) {
        return progress;
    }
    work->isCollecting = false;
    range->end = work->entries.count;
    return kiriGridWork_Flag(work, mesh->memory, square, KIRI_SQUARE_COLLECTED) ? KIRI_DONE : KIRI_FAILED;
}

/* What cells and faces cover. In a whole square that follows from where it is; others have it stored. */

/* ---- Of whole squares -------------------------------------------------------------------------------------------- */

/* The area that the cell of a whole square covers. */
static kiriMoments kiriGrid_MaterialOfWhole(const kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    double x = grid->side, area = x * x;
    kiriMoments about = {
        area, x / 2.0 * area, x / 2.0 * area, area * area / 3.0, area * area / 4.0, area * area / 3.0
    };
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    return kiriMoments_About(&about, kiriVec2_Scale(-1.0, corner));
}

static kiriStretch StretchOfWhole(const kiriMeshData* mesh, int32_t square, int32_t axis)
{
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    double side = mesh->squares.side, width = mesh->step * side, along = 0.5 * mesh->step * side;
    kiriVec2 middle = axis == 0 ? kiriVec2_Make(corner.x, corner.y + along) : kiriVec2_Make(corner.x + along, corner.y);
    return (kiriStretch){ width, middle, width * width * width / 12.0 };
}

/* ---- What they have ---------------------------------------------------------------------------------------------- */

kiriMoments kiriGrid_Material(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    const kiriCell* at = &grid->cells.data[cell];
    return at->material == KIRI_NONE ? kiriGrid_MaterialOfWhole(grid, mesh, at->square)
                                     : grid->materials.data[at->material];
}

/* Of a whole square term by term as kiriGrid_MaterialOfWhole has them. */
kiriFirstMoments kiriGrid_FirstMoments(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    const kiriCell* at = &grid->cells.data[cell];
    if (at->material != KIRI_NONE) {
        const kiriMoments* own = &grid->materials.data[at->material];
        return (kiriFirstMoments){ own->area, own->u, own->v };
    }
    double x = grid->side, area = x * x, about = x / 2.0 * area;
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, at->square));
    return (kiriFirstMoments){ area, about + corner.x * area, about + corner.y * area };
}

static int32_t StretchIndexOf(const kiriFace* face)
{
    return (face->kind >> 1) - 1;
}

kiriStretch kiriGrid_Stretch(const kiriGrid* grid, const kiriMeshData* mesh, int32_t face)
{
    KIRI_ASSERT(face >= 0 && face < grid->faces.count);
    const kiriFace* at = &grid->faces.data[face];
    int32_t index = StretchIndexOf(at);
    return index == KIRI_NONE ? StretchOfWhole(mesh, grid->cells.data[at->cell[1]].square, kiriFace_Axis(at))
                              : grid->stretches.data[index];
}

/* ---- Their own --------------------------------------------------------------------------------------------------- */

/* Room for one more item, or an unused one. The list of unused ones always has room for all. */
static bool MakeRoomForOwn(kiriMemory* memory, void* array, size_t itemBytes, kiriIndices* unused)
{
    int64_t need = (int64_t)kiriArray_GetHeader(array).count + 1;
    return unused->count > 0 ||
           (kiriArray_Grow(memory, array, need, itemBytes) && kiriArray_Reserve(memory, unused, need));
}

/* There is one, or room. */
static int32_t TakeOwn(void* array, kiriIndices* unused)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (unused->count > 0) {
        return unused->data[--unused->count];
    }
    header.count += 1;
    kiriArray_SetHeader(array, header);
    return header.count - 1;
}

kiriMoments* kiriGrid_OwnMaterial(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    int32_t* own = &grid->cells.data[cell].material;
    if (*own == KIRI_NONE) {
        if (!MakeRoomForOwn(memory, &grid->materials, sizeof(kiriMoments), &grid->unusedMaterials)) {
            return NULL;
        }
        *own = TakeOwn(&grid->materials, &grid->unusedMaterials);
    }
    return &grid->materials.data[*own];
}

kiriStretch* kiriGrid_OwnStretch(kiriGrid* grid, kiriMemory* memory, int32_t face)
{
    KIRI_ASSERT(face >= 0 && face < grid->faces.count);
    kiriFace* at = &grid->faces.data[face];
    if (StretchIndexOf(at) == KIRI_NONE) {
        if (!MakeRoomForOwn(memory, &grid->stretches, sizeof(kiriStretch), &grid->unusedStretches)) {
            return NULL;
        }
        at->kind = 2 * (TakeOwn(&grid->stretches, &grid->unusedStretches) + 1) + kiriFace_Axis(at);
    }
    return &grid->stretches.data[StretchIndexOf(at)];
}

static void GiveBack(kiriIndices* unused, int32_t index)
{
    if (index != KIRI_NONE) {
        KIRI_ASSERT(unused->count < unused->capacity);
        unused->data[unused->count++] = index;
    }
}

/* And gives it back: then it has that of a whole square, or side. */
static void kiriGrid_DropMaterial(kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    GiveBack(&grid->unusedMaterials, grid->cells.data[cell].material);
    grid->cells.data[cell].material = KIRI_NONE;
}

static void kiriGrid_DropStretch(kiriGrid* grid, int32_t face)
{
    KIRI_ASSERT(face >= 0 && face < grid->faces.count);
    kiriFace* at = &grid->faces.data[face];
    GiveBack(&grid->unusedStretches, StretchIndexOf(at));
    at->kind = kiriFace_Axis(at);
}

/* The index of a face of the whole side, or KIRI_NONE for memory. */
/* ---- Faces ------------------------------------------------------------------------------------------------------- */

static int32_t AddFace(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    KIRI_ASSERT(a != b && kiriGrid_IsCell(grid, a) && kiriGrid_IsCell(grid, b));
    kiriCell *cellA = &grid->cells.data[a], *cellB = &grid->cells.data[b];
    const kiriFace face = { { a, b }, { cellA->firstFace, cellB->firstFace }, axis };
    int32_t f = grid->freeFace;
    if (f != KIRI_NONE) {
        grid->freeFace = grid->faces.data[f].next[0];
        grid->faces.data[f] = face;
    } else if (kiriArray_Push(memory, &grid->faces, face)) {
        f = grid->faces.count - 1;
    }
    if (f == KIRI_NONE || !kiriGrid_RecordLink(grid, memory, a, b)) {
        return KIRI_NONE;
    }
    cellA->firstFace = cellB->firstFace = f;
    return f;
}

static void UnlinkFace(kiriGrid* grid, int32_t f, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    int32_t* link = &grid->cells.data[cell].firstFace;
    while (*link != f) {
        KIRI_ASSERT(*link != KIRI_NONE);
        kiriFace* face = &grid->faces.data[*link];
        link = &face->next[face->cell[1] == cell];
    }
    *link = kiriFace_Next(&grid->faces.data[f], cell);
}

static void kiriGrid_FreeFace(kiriGrid* grid, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < grid->faces.count && grid->faces.data[f].cell[0] != KIRI_NONE);
    kiriFace* face = &grid->faces.data[f];
    UnlinkFace(grid, f, face->cell[0]);
    UnlinkFace(grid, f, face->cell[1]);
    kiriGrid_DropStretch(grid, f);
    face->cell[0] = KIRI_NONE;
    face->next[0] = grid->freeFace;
    grid->freeFace = f;
}

static bool kiriGrid_RemoveFace(kiriGrid* grid, kiriMemory* memory, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < grid->faces.count);
    bool ok = kiriGrid_RecordLink(grid, memory, grid->faces.data[f].cell[0], grid->faces.data[f].cell[1]);
    kiriGrid_FreeFace(grid, f);
    return ok;
}

/* The face between two cells, new if there is none yet; KIRI_NONE for memory. Looks from both ends at once, since a
   cell with many faces, a comb, most often touches cells with few. */
static int32_t FaceBetween(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    KIRI_ASSERT(a >= 0 && a < grid->cells.count);
    KIRI_ASSERT(b >= 0 && b < grid->cells.count);
    int32_t f = grid->cells.data[a].firstFace, g = grid->cells.data[b].firstFace;
    while (f != KIRI_NONE && g != KIRI_NONE) {
        const kiriFace *ofA = &grid->faces.data[f], *ofB = &grid->faces.data[g];
        if (kiriFace_Other(ofA, a) == b) {
            return f;
        }
        if (kiriFace_Other(ofB, b) == a) {
            return g;
        }
        f = kiriFace_Next(ofA, a);
        g = kiriFace_Next(ofB, b);
    }
    return AddFace(grid, memory, a, b, axis);
}

/* The part of a side that a triangle covers: its ends, in lattice steps from the lower end of the side. */
typedef struct CoveredEnds {
    double from, to;
} CoveredEnds;

/* The stretch that a triangle covers of the lower side of a square along the axis. Two of the triangle's edges meet the
   grid line, and no corner lies on it. */
static CoveredEnds FindCoveredEnds(const kiriMeshData* mesh, int32_t triangle, int32_t square, int axis)
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    double side = mesh->squares.side;
    CoveredEnds ends = { side, 0.0 };
    kiriMesh_Corners(mesh, triangle, corners);
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint p = corners[i], q = corners[(i + 1) % 3];
        /* Across the side and along it, from the side's lower end; 64 bits hold the products below. */
        int64_t pa = axis == 0 ? p.x - low.x : p.y - low.y, ps = axis == 0 ? p.y - low.y : p.x - low.x;
        int64_t qa = axis == 0 ? q.x - low.x : q.y - low.y, qs = axis == 0 ? q.y - low.y : q.x - low.x;
        if ((pa < 0) != (qa < 0)) {
            double at = (double)(ps * qa - qs * pa) / (double)(qa - pa);
            ends.from = kiriMin(at, ends.from);
            ends.to = kiriMax(at, ends.to);
        }
    }
    ends.from = kiriMax(ends.from, 0.0);
    ends.to = kiriMin(ends.to, side);
    return ends;
}

/* Adds by the parallel axis rule: each term is positive, so a narrow face has a sound moment too. */
static void AddCovered(kiriStretch* sum, const kiriMeshData* mesh, kiriLatticePoint low, int axis, CoveredEnds ends)
{
    double width = mesh->step * (ends.to - ends.from), least = kiriLeastShare * mesh->step * mesh->squares.side;
    width = kiriMax(width, least);
    kiriVec2 corner = kiriMesh_Local(mesh, low);
    double along = 0.5 * mesh->step * (ends.from + ends.to);
    kiriVec2 middle = axis == 0 ? kiriVec2_Make(corner.x, corner.y + along) : kiriVec2_Make(corner.x + along, corner.y);
    if (sum->width == 0.0) {
        *sum = (kiriStretch){ width, middle, width * width * width / 12.0 };
        return;
    }
    kiriVec2 apart = kiriVec2_Sub(middle, sum->middle);
    double both = sum->width + width;
    sum->moment += width * width * width / 12.0 + kiriVec2_Dot(apart, apart) * sum->width * width / both;
    sum->middle = kiriVec2_Add(sum->middle, kiriVec2_Scale(width / both, apart));
    sum->width = both;
}

/* Nothing is covered yet. False for memory. */
static bool EmptyFace(kiriGrid* grid, kiriMemory* memory, int32_t f)
{
    kiriStretch* own = kiriGrid_OwnStretch(grid, memory, f);
    if (own != NULL) {
        own->width = own->moment = 0.0;
    }
    return own != NULL;
}

/* Whole squares share their whole side. */
static bool AddWholeFace(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis)
{
    KIRI_ASSERT(before >= 0 && before < grid->squareCell.count);
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    int32_t f = FaceBetween(grid, mesh->memory, grid->squareCell.data[before], grid->squareCell.data[square], axis);
    if (f != KIRI_NONE) {
        kiriGrid_DropStretch(grid, f);
    }
    return f != KIRI_NONE;
}

/* Empties the faces on the lower side of a square along the axis, and keeps what they were. */
static bool EmptyFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int axis)
{
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    kiriGridWork* work = grid->work;
    work->oldFaces.count = 0;
    for (int32_t c = work->fromScratch ? KIRI_NONE : grid->squareCell.data[square]; c != KIRI_NONE;
         c = grid->cells.data[c].next) {
        for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&grid->faces.data[f], c)) {
            const kiriFace* face = &grid->faces.data[f];
            if (face->cell[1] == c && kiriFace_Axis(face) == axis) {
                kiriOldFace old = { f, kiriGrid_Stretch(grid, mesh, f) };
                if (!kiriArray_Push(mesh->memory, &work->oldFaces, old) || !EmptyFace(grid, mesh->memory, f)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* Finds out what became of the faces that were emptied. */
static bool CompareFaces(kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriMemory* memory = mesh->memory;
    for (int32_t i = 0; i < grid->work->oldFaces.count; ++i) {
        const kiriOldFace* old = &grid->work->oldFaces.data[i];
        const kiriStretch was = old->was, is = kiriGrid_Stretch(grid, mesh, old->face);
        if (is.width == 0.0) {
            if (!kiriGrid_RemoveFace(grid, memory, old->face)) {
                return false;
            }
        } else if (is.width != was.width || is.moment != was.moment || is.middle.x != was.middle.x ||
                   is.middle.y != was.middle.y) {
            const int32_t* cell = grid->faces.data[old->face].cell;
            if (!kiriGrid_RecordSteps(grid, memory, cell[0]) || !kiriGrid_RecordSteps(grid, memory, cell[1])) {
                return false;
            }
        }
    }
    return true;
}

/* That of the face between two cells, of a side that was emptied; null for memory. */
static kiriStretch* StretchBetween(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    int32_t f = FaceBetween(grid, memory, a, b, axis);
    bool isNew = f != KIRI_NONE && !kiriFace_HasOwnStretch(&grid->faces.data[f]);
    return f == KIRI_NONE || (isNew && !EmptyFace(grid, memory, f)) ? NULL : kiriGrid_OwnStretch(grid, memory, f);
}

/* Links the cells of a square to those of the one before it along the axis. A triangle with material in both covers a
   stretch of the side between them, for both together are convex. */
static kiriProgress AddFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis,
                             kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square);
    kiriNodeRange a = work->ranges.data[before], b = work->ranges.data[square];
    while (a.first + work->at < a.end && b.first + work->other < b.end) {
        int32_t i = a.first + work->at, j = b.first + work->other;
        int32_t t = kiriGridWork_TriangleAt(work, mesh, i), u = kiriGridWork_TriangleAt(work, mesh, j);
        if (t == u) {
            kiriStretch* sum = StretchBetween(grid, mesh->memory, grid->nodeCell.data[work->entries.data[i]],
                                              grid->nodeCell.data[work->entries.data[j]], axis);
            if (sum == NULL) {
                return KIRI_FAILED;
            }
            AddCovered(sum, mesh, low, axis, FindCoveredEnds(mesh, t, square, axis));
        }
        work->at += t <= u;
        work->other += u <= t;
        if (!kiriGridWork_Spend(work, quota, t == u ? KIRI_GRID_STRETCH : KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return KIRI_DONE;
}

static kiriProgress MakeDividedSide(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis,
                                    kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    kiriProgress progress = kiriGridWork_Collect(work, mesh, before, quota);
    progress = progress == KIRI_DONE ? kiriGridWork_Collect(work, mesh, square, quota) : progress;
    if (progress != KIRI_DONE) {
        return progress;
    }
    if (!work->isMerging) {
        if (!EmptyFaces(grid, mesh, square, axis)) {
            return KIRI_FAILED;
        }
        work->due += KIRI_GRID_SIDE;
        work->at = work->other = 0;
        work->isMerging = true;
    }
    progress = AddFaces(grid, mesh, before, square, axis, quota);
    work->isMerging = progress == KIRI_MORE;
    return progress != KIRI_DONE || CompareFaces(grid, mesh) ? progress : KIRI_FAILED;
}

static kiriProgress MakeSide(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis,
                             kiriQuota* quota)
{
    KIRI_ASSERT(before >= 0 && before < grid->squareCell.count);
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    if (grid->squareCell.data[before] == KIRI_NONE || grid->squareCell.data[square] == KIRI_NONE) {
        return KIRI_DONE;
    }
    if (!grid->whole.data[before] || !grid->whole.data[square]) {
        return MakeDividedSide(grid, mesh, before, square, axis, quota);
    }
    grid->work->due += KIRI_GRID_SIDE;
    return EmptyFaces(grid, mesh, square, axis) && AddWholeFace(grid, mesh, before, square, axis) &&
                   CompareFaces(grid, mesh)
               ? KIRI_DONE
               : KIRI_FAILED;
}

/* The side after a square along the axis, where the square there does not make it. */
static kiriProgress MakeSideBeyond(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int axis, kiriQuota* quota)
{
    int32_t columns = mesh->squares.columns, beyond = square + (axis == 0 ? 1 : columns);
    bool isInside = axis == 0 ? square % columns + 1 < columns : beyond < grid->work->squareFlags.count;
    return isInside && !kiriGridWork_IsFlagged(grid->work, beyond, KIRI_SQUARE_FACES_DIRTY)
               ? MakeSide(grid, mesh, square, beyond, axis, quota)
               : KIRI_DONE;
}

static kiriProgress MakeSideBefore(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int axis, kiriQuota* quota)
{
    int32_t columns = mesh->squares.columns;
    bool isInside = axis == 0 ? square % columns > 0 : square >= columns;
    return isInside ? MakeSide(grid, mesh, square - (axis == 0 ? 1 : columns), square, axis, quota) : KIRI_DONE;
}

/* Between two squares that both have new cells, the one with the higher coordinate does it. */
static kiriProgress kiriGrid_MakeFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    enum { SIDES = 4 };
    kiriGridWork* work = grid->work;
    int32_t square = work->facesDirty.data[item];
    for (; work->part < SIDES; ++work->part) {
        int axis = work->part % 2;
        kiriProgress progress = work->part < 2 ? MakeSideBefore(grid, mesh, square, axis, quota)
                                               : MakeSideBeyond(grid, mesh, square, axis, quota);
        if (progress != KIRI_DONE) {
            return progress;
        }
    }
    work->part = 0;
    return KIRI_DONE;
}

/* SetMaterial compares bytes. */
typedef char MomentsHaveNoPadding[sizeof(kiriMoments) == 6 * sizeof(double) ? 1 : -1];

/* ---- Whole squares ----------------------------------------------------------------------------------------------- */

/* Does the outline or an open edge of the triangle run through the square? */
static bool RunsThroughSquare(const kiriMeshData* mesh, const kiriTriangle* t, int32_t square)
{
    for (int i = 0; i < 3; ++i) {
        if ((t->twin[i] == KIRI_NONE || (t->marks >> i & 1) != 0) &&
            kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[t->vertex[i]].at,
                                    mesh->vertices.data[t->vertex[(i + 1) % 3]].at)) {
            return true;
        }
    }
    return false;
}

/* A square is whole where there is material and neither the outline nor an open edge runs through it. Then it is wholly
   covered, its triangles all hang together in it, and it has one cell: no need to join or to clip. Most squares are. */
static kiriProgress LookWhetherWhole(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    KIRI_ASSERT(square >= 0 && square < grid->whole.count);
    kiriGridWork* work = grid->work;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    bool wasWhole = grid->whole.data[square], isWhole = mesh->squares.head[square] != KIRI_NONE;
    while (isWhole && work->node != KIRI_NONE) {
        const kiriTriangle* t = &mesh->triangles.data[nodes[work->node].triangle];
        bool isInner = (t->marks & KIRI_TRIANGLE_OPEN) == 0 &&
                       (t->twin[0] | t->twin[1] | t->twin[2]) >= 0; /* KIRI_NONE has the sign bit */
        isWhole = isInner || !RunsThroughSquare(mesh, t, square);
        work->node = nodes[work->node].next;
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE) && isWhole) {
            return KIRI_MORE;
        }
    }
    grid->whole.data[square] = isWhole;
    work->isSame = wasWhole && isWhole;
    work->newCells.count = 0;
    work->due += KIRI_GRID_SQUARE;
    return work->isSame || kiriGridWork_AddOnce(work, mesh->memory, square, KIRI_SQUARE_FACES_DIRTY, &work->facesDirty)
               ? KIRI_DONE
               : KIRI_FAILED;
}

/* ---- Triangles of a square --------------------------------------------------------------------------------------- */

/* The entry of a triangle among sorted ones, or KIRI_NONE. */
static int32_t FindTriangleEntry(const kiriGridWork* work, const kiriMeshData* mesh, int32_t from, int32_t end,
                                 int32_t triangle)
{
    int32_t at;
    KIRI_SEARCH(at, from, end, kiriGridWork_TriangleAt(work, mesh, middle) < triangle);
    return at < end && kiriGridWork_TriangleAt(work, mesh, at) == triangle ? at : KIRI_NONE;
}

/* Joins an entry of a square to those after it that a closed edge through the square leads to. */
static void JoinEntry(kiriGridWork* work, const kiriMeshData* mesh, int32_t square, int32_t i)
{
    KIRI_ASSERT(square >= 0 && square < work->ranges.count);
    int32_t triangle = kiriGridWork_TriangleAt(work, mesh, i), end = work->ranges.data[square].end;
    for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin < h || kiriMesh_IsOpen(mesh, h)) {
            continue;
        }
        int32_t j = FindTriangleEntry(work, mesh, i + 1, end, twin / 3);
        if (j != KIRI_NONE &&
            kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                                    mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at)) {
            kiriUnion_Join(work->parent.data, i, j);
        }
    }
}

/* Joins the triangles of a square (algorithm 3). */
static kiriProgress JoinTriangles(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    KIRI_ASSERT(square >= 0 && square < grid->whole.count);
    kiriGridWork* work = grid->work;
    if (grid->whole.data[square]) {
        return KIRI_DONE;
    }
    kiriProgress progress = kiriGridWork_Collect(work, mesh, square, quota);
    kiriNodeRange range = work->ranges.data[square];
    while (progress == KIRI_DONE && work->at < range.end - range.first) {
        JoinEntry(work, mesh, square, range.first + work->at++);
        progress = kiriGridWork_Spend(work, quota, KIRI_GRID_JOIN) ? KIRI_DONE : KIRI_MORE;
    }
    return progress;
}

/* ---- Material ---------------------------------------------------------------------------------------------------- */

/* Room for what clipping may make of a triangle even where rounding spoils its convexity: at most twice as many corners
   a time, and 3, 4, 6, 9, 13 when counted closely. */
enum { MOST_CORNERS = 13 };
typedef struct ClippedPolygon {
    kiriVec2 at[MOST_CORNERS];
    int32_t count;
} ClippedPolygon;

/* How far beyond the square's lower (or upper) side along an axis. */
static double DepthInside(kiriVec2 p, int axis, bool upper, double side)
{
    double x = axis == 0 ? p.x : p.y;
    return upper ? side - x : x;
}

/* Cuts off the part outside one side of the square (Sutherland and Hodgman 1974). An edge is followed from its inner end
   whichever way the triangle runs, so neighbours at this edge get the very same point. */
static void ClipAtSide(ClippedPolygon* polygon, int axis, bool upper, double side)
{
    double depth[MOST_CORNERS], least = side;
    for (int32_t i = 0; i < polygon->count; ++i) {
        depth[i] = DepthInside(polygon->at[i], axis, upper, side);
        least = kiriMin(depth[i], least);
    }
    if (least > 0.0) {
        return;
    }
    ClippedPolygon was = *polygon;
    polygon->count = 0;
    for (int32_t i = 0; i < was.count; ++i) {
        int32_t j = i + 1 < was.count ? i + 1 : 0;
        if (depth[i] > 0.0) {
            polygon->at[polygon->count++] = was.at[i];
        }
        if ((depth[i] > 0.0) != (depth[j] > 0.0)) {
            int32_t in = depth[i] > 0.0 ? i : j, out = i + j - in;
            kiriVec2 way = kiriVec2_Sub(was.at[out], was.at[in]);
            kiriVec2 at = kiriVec2_Add(was.at[in], kiriVec2_Scale(depth[in] / (depth[in] - depth[out]), way));
            *(axis == 0 ? &at.x : &at.y) = upper ? side : 0.0;
            polygon->at[polygon->count++] = at;
        }
    }
}

/* Most triangles reach over few sides of a square, if any: whole numbers tell faster. */
static void ClipToSquare(ClippedPolygon* part, const kiriLatticePoint c[3], kiriLatticePoint low, int32_t side)
{
    kiriLatticePoint high = { low.x + side, low.y + side };
    if (c[0].x < low.x || c[1].x < low.x || c[2].x < low.x) {
        ClipAtSide(part, 0, false, side);
    }
    if (c[0].x > high.x || c[1].x > high.x || c[2].x > high.x) {
        ClipAtSide(part, 0, true, side);
    }
    if (c[0].y < low.y || c[1].y < low.y || c[2].y < low.y) {
        ClipAtSide(part, 1, false, side);
    }
    if (c[0].y > high.y || c[1].y > high.y || c[2].y > high.y) {
        ClipAtSide(part, 1, true, side);
    }
}

/* The part of a triangle in a square, about the square's lower corner, so that nothing cancels in a small one. */
static kiriMoments MaterialInSquare(const kiriMeshData* mesh, int32_t triangle, int32_t square)
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    ClippedPolygon part;
    part.count = 3;
    for (int i = 0; i < 3; ++i) {
        part.at[i] = kiriVec2_Make((double)corners[i].x - low.x, (double)corners[i].y - low.y);
    }
    ClipToSquare(&part, corners, low, mesh->squares.side);
    kiriMoments sum = { 0 };
    for (int32_t i = 0; i < part.count; ++i) {
        part.at[i] = kiriVec2_Scale(mesh->step, part.at[i]);
        if (i >= 2) {
            kiriMoments fan = kiriMoments_Triangle(part.at[0], part.at[i - 1], part.at[i]);
            kiriMoments_Add(&sum, &fan);
        }
    }
    return sum;
}

/* A speck of material at the middle of the square. */
static kiriMoments Speck(double side)
{
    double area = kiriLeastShare * side * side, half = 0.5 * side;
    kiriMoments m = { area, half * area, half * area, half * half * area, half * half * area, half * half * area };
    return m;
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

/* The index of a new cell, or KIRI_NONE for memory. */
static int32_t AddCell(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    const kiriCell cell = { square, KIRI_NONE, KIRI_NONE, KIRI_NONE, KIRI_NONE };
    const kiriStepRun run = { 0, { 0, 0, 0 } };
    kiriGridWork* work = grid->work;
    int32_t c = grid->freeCell;
    if (c != KIRI_NONE) {
        grid->freeCell = grid->cells.data[c].next;
        grid->cells.data[c] = cell;
    } else if (kiriArray_Push(memory, &grid->cells, cell) && kiriArray_Push(memory, &grid->runs, run) &&
               kiriArray_Push(memory, &work->cellFlags, 0) && kiriArray_Push(memory, &work->mark, 0)) {
        c = grid->cells.count - 1;
    } else {
        return KIRI_NONE;
    }
    ++grid->cellCount;
    work->cellFlags.data[c] = KIRI_CELL_MADE | KIRI_CELL_STEPS;
    bool ok = kiriArray_Push(memory, &grid->changes.made, c) && kiriArray_Push(memory, &grid->changes.steps, c) &&
              (!work->fromScratch || kiriArray_Push(memory, &work->stepsDirty, c));
    return ok ? c : KIRI_NONE;
}

static bool StoreMaterial(kiriGrid* grid, kiriMemory* memory, int32_t c, const kiriMoments* material)
{
    kiriMoments* own = kiriGrid_OwnMaterial(grid, memory, c);
    if (own != NULL) {
        *own = *material;
    }
    return own != NULL;
}

static bool SetMaterial(kiriGrid* grid, const kiriMeshData* mesh, int32_t c, const kiriMoments* material)
{
    KIRI_ASSERT(c >= 0 && c < grid->work->cellFlags.count);
    kiriMaterialChange change = { c, kiriGrid_Material(grid, mesh, c) };
    uint8_t* flags = &grid->work->cellFlags.data[c];
    if (memcmp(&change.was, material, sizeof(*material)) == 0) {
        return true;
    }
    if (grid->whole.data[grid->cells.data[c].square]) {
        kiriGrid_DropMaterial(grid, c);
    } else if (!StoreMaterial(grid, mesh->memory, c, material)) {
        return false;
    }
    if ((*flags & (KIRI_CELL_MADE | KIRI_CELL_MATERIAL)) != 0) {
        return true;
    }
    *flags |= KIRI_CELL_MATERIAL;
    return kiriArray_Push(mesh->memory, &grid->changes.material, change);
}

/* What it covered is kept: without a square it does not follow any more. */
static bool RemoveCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t c)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, c));
    kiriMemory* memory = mesh->memory;
    kiriCell* cell = &grid->cells.data[c];
    kiriMoments material = kiriGrid_Material(grid, mesh, c);
    if (!StoreMaterial(grid, memory, c, &material)) {
        return false;
    }
    while (cell->firstFace != KIRI_NONE) {
        if (!kiriGrid_RemoveFace(grid, memory, cell->firstFace)) {
            return false;
        }
    }
    kiriGrid_RemoveSteps(grid, memory, c);
    cell->square = cell->next = KIRI_NONE;
    --grid->cellCount;
    grid->work->removed = true;
    return (grid->work->cellFlags.data[c] & KIRI_CELL_MADE) != 0 || kiriArray_Push(memory, &grid->changes.gone, c);
}

static bool FindWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    kiriNewCell whole = { KIRI_NONE, KIRI_NONE, kiriGrid_MaterialOfWhole(grid, mesh, square) };
    return kiriArray_Push(mesh->memory, &grid->work->newCells, whole);
}

/* Adds the material of a triangle to its cell. Cells come by lowest triangle; so far nodes know them by their rank. */
static bool MeasureEntry(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int32_t i)
{
    kiriGridWork* work = grid->work;
    int32_t root = kiriUnion_Root(work->parent.data, i), triangle = kiriGridWork_TriangleAt(work, mesh, i);
    const kiriNewCell none = { triangle, KIRI_NONE, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 } };
    if (root == i && !kiriArray_Push(mesh->memory, &work->newCells, none)) {
        return false;
    }
    int32_t rank = root == i ? work->newCells.count - 1 : grid->nodeCell.data[work->entries.data[root]];
    kiriMoments part = MaterialInSquare(mesh, triangle, square);
    kiriMoments_Add(&work->newCells.data[rank].material, &part);
    grid->nodeCell.data[work->entries.data[i]] = rank;
    return true;
}

static void FinishMaterial(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    for (int32_t rank = 0; rank < grid->work->newCells.count; ++rank) {
        kiriMoments* material = &grid->work->newCells.data[rank].material;
        if (!(material->area > kiriLeastShare * grid->side * grid->side)) {
            *material = Speck(grid->side);
        }
        *material = kiriMoments_About(material, kiriVec2_Scale(-1.0, corner));
    }
}

/* The cells that the square should have, in `newCells`. */
static kiriProgress FindCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    KIRI_ASSERT(square >= 0 && square < grid->whole.count);
    kiriGridWork* work = grid->work;
    if (grid->whole.data[square]) {
        return work->isSame || FindWholeCell(grid, mesh, square) ? KIRI_DONE : KIRI_FAILED;
    }
    kiriNodeRange range = work->ranges.data[square];
    while (work->at < range.end - range.first) {
        if (!MeasureEntry(grid, mesh, square, range.first + work->at++)) {
            return KIRI_FAILED;
        }
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_MEASURE)) {
            return KIRI_MORE;
        }
    }
    FinishMaterial(grid, mesh, square);
    return KIRI_DONE;
}

/* The old cells of the square become the new ones in their order. Where there are more new ones than old, cells are
   added, and where there are fewer, removed. */
static bool TakeNewCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    int32_t old = grid->squareCell.data[square], last = KIRI_NONE;
    grid->squareCell.data[square] = KIRI_NONE;
    for (int32_t i = 0; i < grid->work->newCells.count; ++i) {
        kiriNewCell* made = &grid->work->newCells.data[i];
        made->cell = old != KIRI_NONE ? old : AddCell(grid, mesh->memory, square);
        if (made->cell == KIRI_NONE || !SetMaterial(grid, mesh, made->cell, &made->material)) {
            return false;
        }
        kiriCell* cell = &grid->cells.data[made->cell];
        old = cell->next;
        cell->triangle = made->triangle;
        cell->next = KIRI_NONE;
        *(last == KIRI_NONE ? &grid->squareCell.data[square] : &grid->cells.data[last].next) = made->cell;
        last = made->cell;
    }
    while (old != KIRI_NONE) {
        int32_t gone = old;
        old = grid->cells.data[gone].next;
        if (!RemoveCell(grid, mesh, gone)) {
            return false;
        }
    }
    return true;
}

static kiriProgress ReplaceCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    (void)quota;
    grid->work->due += KIRI_GRID_CELL * grid->work->newCells.count;
    return grid->work->isSame || TakeNewCells(grid, mesh, square) ? KIRI_DONE : KIRI_FAILED;
}

/* The one cell of a whole square holds all its triangles. Where the square was whole before, nothing else changes. */
static kiriProgress FillWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    kiriGridWork* work = grid->work;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    int32_t c = grid->squareCell.data[square], *lowest = &grid->cells.data[c].triangle;
    *lowest = work->node == mesh->squares.head[square] ? INT32_MAX : *lowest;
    while (work->node != KIRI_NONE) {
        int32_t triangle = nodes[work->node].triangle;
        *lowest = kiriMin(triangle, *lowest);
        grid->nodeCell.data[work->node] = c;
        work->node = nodes[work->node].next;
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return KIRI_DONE;
}

/* An edge in the square may have changed that changes neither material nor faces: a slit that ends there, by its
   tip. */
static bool RecordEdges(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    bool ok = true;
    for (int32_t c = grid->squareCell.data[square]; ok && c != KIRI_NONE; c = grid->cells.data[c].next) {
        uint8_t* flags = &grid->work->cellFlags.data[c];
        ok = (*flags & KIRI_CELL_EDGES) != 0 || kiriArray_Push(memory, &grid->changes.edges, c);
        *flags |= KIRI_CELL_EDGES;
    }
    return ok;
}

/* The vertices of the square that find their fan by this triangle. */
static void FillVertices(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int32_t triangle, int32_t cell)
{
    KIRI_ASSERT(triangle >= 0 && triangle < mesh->triangles.count);
    const int32_t* corners = mesh->triangles.data[triangle].vertex;
    for (int i = 0; i < 3; ++i) {
        const kiriVertex* v = &mesh->vertices.data[corners[i]];
        if (v->edge / 3 == triangle && kiriSquares_At(&mesh->squares, v->at) == square) {
            grid->vertexCell.data[corners[i]] = cell;
        }
    }
}

/* Gives the square's triangles their cells: so far they have the ranks of FindCells. */
static kiriProgress FillCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    KIRI_ASSERT(square >= 0 && square < grid->whole.count);
    kiriGridWork* work = grid->work;
    if (grid->whole.data[square]) {
        return FillWholeCell(grid, mesh, square, quota);
    }
    kiriNodeRange range = work->ranges.data[square];
    while (work->at < range.end - range.first) {
        int32_t i = range.first + work->at++, *cell = &grid->nodeCell.data[work->entries.data[i]];
        *cell = work->newCells.data[*cell].cell;
        if (work->newCells.count > 1) {
            FillVertices(grid, mesh, square, kiriGridWork_TriangleAt(work, mesh, i), *cell);
        }
        if (!kiriGridWork_Spend(work, quota, 2 * KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return RecordEdges(grid, mesh->memory, square) ? KIRI_DONE : KIRI_FAILED;
}

static kiriProgress kiriGrid_MakeCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    enum { PARTS = 5 };
    static kiriGridStageFn* const parts[PARTS] = { LookWhetherWhole, JoinTriangles, FindCells, ReplaceCells,
                                                   FillCells };
    kiriGridWork* work = grid->work;
    int32_t square = work->fromScratch ? item : mesh->squares.dirty.data[item];
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    for (; work->part < PARTS; ++work->part) {
        if (!work->isAmidPart) {
            work->node = mesh->squares.head[square];
            work->at = 0;
        }
        kiriProgress progress = parts[work->part](grid, mesh, square, quota);
        work->isAmidPart = progress == KIRI_MORE;
        if (progress != KIRI_DONE) {
            return progress;
        }
    }
    work->part = 0;
    return KIRI_DONE;
}

kiriLatticePoint kiriGrid_Anchor(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    kiriMoments largest = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    int32_t square = grid->cells.data[cell].square, lowest = INT32_MAX;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        if (grid->nodeCell.data[n] == cell) {
            int32_t triangle = mesh->squares.nodes.data[n].triangle;
            kiriMoments material = MaterialInSquare(mesh, triangle, square);
            if (material.area > largest.area || (material.area == largest.area && triangle < lowest)) {
                largest = material;
                lowest = triangle;
            }
        }
    }
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    return kiriMesh_Snap(mesh, largest.area > 0.0 ? kiriVec2_Add(corner, kiriMoments_Center(&largest))
                                                  : kiriGrid_Middle(grid, mesh, cell));
}

/* ---- What an update changes -------------------------------------------------------------------------------------- */

static void FreeCell(kiriGrid* grid, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->cells.count);
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

bool kiriBorderCells_Resize(kiriBorderCells* lists, kiriMemory* memory, int32_t cellCount, int32_t regionCount)
{
    const kiriBorderCell none = { KIRI_NONE, KIRI_NONE, KIRI_NONE };
    if (!kiriArray_Reserve(memory, &lists->cells, cellCount) ||
        !kiriArray_Reserve(memory, &lists->first, regionCount)) {
        return false;
    }
    while (lists->cells.count < cellCount) {
        lists->cells.data[lists->cells.count++] = none;
    }
    while (lists->first.count < regionCount) {
        lists->first.data[lists->first.count++] = KIRI_NONE;
    }
    return true;
}

static void TakeFromBorder(kiriBorderCells* lists, const kiriBorderCell* at)
{
    *(at->before == KIRI_NONE ? &lists->first.data[at->region] : &lists->cells.data[at->before].next) = at->next;
    if (at->next != KIRI_NONE) {
        lists->cells.data[at->next].before = at->before;
    }
}

void kiriBorderCells_Put(kiriBorderCells* lists, int32_t cell, int32_t region)
{
    KIRI_ASSERT(cell >= 0 && cell < lists->cells.count);
    kiriBorderCell* at = &lists->cells.data[cell];
    if (at->region == region) {
        return;
    }
    if (at->region != KIRI_NONE) {
        TakeFromBorder(lists, at);
    }
    *at = (kiriBorderCell){ region, KIRI_NONE, KIRI_NONE };
    if (region != KIRI_NONE) {
        at->next = lists->first.data[region];
        lists->first.data[region] = cell;
        if (at->next != KIRI_NONE) {
            lists->cells.data[at->next].before = cell;
        }
    }
}

void kiriBorderCells_Keep(kiriBorderCells* lists, const kiriKeep* regions)
{
    const int32_t *to = regions->to.data, first = regions->first;
    for (int32_t c = 0; c < lists->cells.count && kiriKeep_Moves(regions); ++c) {
        kiriBorderCell* cell = &lists->cells.data[c];
        if (cell->region >= first) {
            cell->region = to[cell->region];
        }
    }
    kiriKeep_Compact(regions, &lists->first, 1, sizeof(int32_t));
}

void kiriBorderCells_Reset(kiriBorderCells* lists)
{
    lists->first.count = lists->cells.count = 0;
}

/* SetSteps compares bytes. */
typedef char StepHasNoPadding[sizeof(kiriStep) == 8 ? 1 : -1];

/* Steps touch the squares up to two rows away, in row v so many on each side of the column. */
enum { STEP_ROWS = 2 };

static int32_t StepColumns(int32_t v)
{
    return v == -STEP_ROWS || v == STEP_ROWS ? 1 : STEP_ROWS;
}

/* Is the square whole, and all those around that a step may touch? */
static bool IsWholeAround(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    int32_t column = square % squares->columns, row = square / squares->columns;
    if (column < STEP_ROWS || column >= squares->columns - STEP_ROWS || row < STEP_ROWS ||
        row >= squares->rows - STEP_ROWS) {
        return false;
    }
    for (int32_t v = -STEP_ROWS; v <= STEP_ROWS; ++v) {
        const uint8_t* whole = &grid->whole.data[square + v * squares->columns];
        for (int32_t u = -StepColumns(v); u <= StepColumns(v); ++u) {
            if (!whole[u]) {
                return false;
            }
        }
    }
    return true;
}

/* ---- Room for steps ---------------------------------------------------------------------------------------------- */

/* At least for as many as most cells have, so that most runs never move. */
static int32_t RoomFor(int32_t count)
{
    return count == 0 ? 0 : kiriMax(count, KIRI_OPEN_STEPS);
}

/* Room for so many steps; false for memory. */
static bool SetStepCount(kiriGrid* grid, kiriMemory* memory, int32_t c, int32_t count)
{
    KIRI_ASSERT(c >= 0 && c < grid->runs.count);
    kiriStepRun* run = &grid->runs.data[c];
    bool isOpen = kiriStepRun_IsOpen(run);
    kiriSpan span = { isOpen ? 0 : run->first, RoomFor(isOpen ? 0 : run->end[KIRI_STEP_LENGTHS - 1] - run->first) };
    bool ok = kiriSpan_Resize(&span, &grid->stepRoom, memory, &grid->steps, sizeof(kiriStep), RoomFor(count));
    run->first = span.first;
    run->end[0] = run->end[1] = run->end[2] = span.first + count;
    return ok;
}

void kiriGrid_RemoveSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    bool ok = SetStepCount(grid, memory, cell, 0);
    KIRI_ASSERT(ok); /* it shrinks */
    (void)ok;
}

/* Are these the steps that the cell has? */
static bool HasSteps(const kiriGrid* grid, int32_t c, int32_t straight, int32_t near)
{
    const kiriGridWork* work = grid->work;
    kiriSteps has;
    kiriGrid_GetSteps(grid, c, &has);
    return has.end[0] == straight && has.end[1] == near && has.end[2] == work->steps.count &&
           (has.end[2] == 0 || memcmp(has.data, work->steps.data, sizeof(kiriStep) * (size_t)work->steps.count) == 0);
}

/* The cell's steps become those in `work`: so many straight ones, and so many straight and diagonal ones. */
static bool SetSteps(kiriGrid* grid, kiriMemory* memory, int32_t c, int32_t straight, int32_t near)
{
    const kiriGridWork* work = grid->work;
    kiriStepRun* run = &grid->runs.data[c];
    KIRI_ASSERT(kiriGrid_IsCell(grid, c) && 0 <= straight && straight <= near && near <= work->steps.count);
    size_t bytes = sizeof(kiriStep) * (size_t)work->steps.count;
    if (HasSteps(grid, c, straight, near)) {
        return true;
    }
    if (!SetStepCount(grid, memory, c, work->steps.count)) {
        return false;
    }
    if (bytes > 0) {
        memcpy(&grid->steps.data[run->first], work->steps.data, bytes);
    }
    run->end[0] = run->first + straight;
    run->end[1] = run->first + near;
    return kiriGrid_RecordSteps(grid, memory, c);
}

/* ---- Steps ------------------------------------------------------------------------------------------------------- */

static bool MarkStepsDirty(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    if (kiriGridWork_IsFlagged(grid->work, square, KIRI_SQUARE_STEPS_DIRTY)) {
        return true;
    }
    for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
        if (!kiriArray_Push(memory, &grid->work->stepsDirty, c)) {
            return false;
        }
    }
    return kiriGridWork_Flag(grid->work, memory, square, KIRI_SQUARE_STEPS_DIRTY);
}

kiriProgress kiriGrid_SpreadDirty(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    (void)quota;
    const kiriSquares* squares = &mesh->squares;
    int32_t square = work->linksDirty.data[item], column = square % squares->columns, row = square / squares->columns;
    for (int32_t v = kiriMax(-STEP_ROWS, -row); v <= STEP_ROWS && row + v < squares->rows; ++v) {
        int32_t reach = StepColumns(v);
        for (int32_t u = kiriMax(-reach, -column); u <= reach && column + u < squares->columns; ++u) {
            if (!MarkStepsDirty(grid, mesh->memory, square + v * squares->columns + u)) {
                return KIRI_FAILED;
            }
        }
    }
    work->due += KIRI_GRID_STEPS;
    return KIRI_DONE;
}

const kiriStep kiriOpenSteps[KIRI_OPEN_STEPS] = {
    { 0, KIRI_UNIT, 0, -1 },          { 0, KIRI_UNIT, -1, 0 },           { 0, KIRI_UNIT, 1, 0 },
    { 0, KIRI_UNIT, 0, 1 },           { 0, KIRI_UNIT_DIAGONAL, -1, -1 }, { 0, KIRI_UNIT_DIAGONAL, 1, -1 },
    { 0, KIRI_UNIT_DIAGONAL, -1, 1 }, { 0, KIRI_UNIT_DIAGONAL, 1, 1 },   { 0, KIRI_UNIT_KNIGHT, -1, -2 },
    { 0, KIRI_UNIT_KNIGHT, 1, -2 },   { 0, KIRI_UNIT_KNIGHT, -2, -1 },   { 0, KIRI_UNIT_KNIGHT, 2, -1 },
    { 0, KIRI_UNIT_KNIGHT, -2, 1 },   { 0, KIRI_UNIT_KNIGHT, 2, 1 },     { 0, KIRI_UNIT_KNIGHT, -1, 2 },
    { 0, KIRI_UNIT_KNIGHT, 1, 2 },
};

static bool AddStep(kiriGrid* grid, kiriMemory* memory, kiriStep step)
{
    return kiriArray_Push(memory, &grid->work->steps, step);
}

/* Adds steps that the cell has, from one length up to another. */
static bool AddSteps(kiriGrid* grid, kiriMemory* memory, const kiriSteps* steps, int32_t from, int32_t end)
{
    kiriGridWork* work = grid->work;
    int32_t count = work->steps.count;
    if (!kiriArray_Resize(memory, &work->steps, (int64_t)count + end - from)) {
        return false;
    }
    if (from < end) {
        memcpy(&work->steps.data[count], &steps->data[from], sizeof(kiriStep) * (size_t)(end - from));
    }
    return true;
}

void kiriGrid_StartSteps(kiriGrid* grid, const kiriMeshData* mesh)
{
    for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
        grid->openTo[k] = kiriOpenSteps[k].v * mesh->squares.columns + kiriOpenSteps[k].u;
    }
}

/* Puts the steps of an open cell into `work`. */
static bool ListOpenSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->cells.count);
    int32_t square = grid->cells.data[c].square;
    grid->work->steps.count = 0;
    for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
        kiriStep step = kiriOpenSteps[k];
        step.cell = grid->squareCell.data[square + grid->openTo[k]];
        KIRI_ASSERT(kiriGrid_IsCell(grid, step.cell));
        if (!AddStep(grid, memory, step)) {
            return false;
        }
    }
    return true;
}

/* A cell amid whole squares, which is open. If it was, its steps are the same: a square that stays whole keeps its
   cell. */
static bool MakeOpenSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->runs.count);
    if (kiriStepRun_IsOpen(&grid->runs.data[c])) {
        return true;
    }
    if (!ListOpenSteps(grid, memory, c)) {
        return false;
    }
    bool same = HasSteps(grid, c, 4, 8);
    kiriGrid_RemoveSteps(grid, memory, c);
    grid->runs.data[c].first = ~grid->cells.data[c].square;
    return same || kiriGrid_RecordSteps(grid, memory, c);
}

/* Does step a come before b? Both from the same cell: the way tells the order of squares. */
static bool ComesBefore(const kiriGrid* grid, kiriStep a, kiriStep b)
{
    if (a.length != b.length) {
        return a.length < b.length;
    }
    if (a.v != b.v) {
        return a.v < b.v;
    }
    return a.u != b.u ? a.u < b.u : grid->cells.data[a.cell].triangle < grid->cells.data[b.cell].triangle;
}

static void SortSteps(kiriGrid* grid, int32_t from)
{
    kiriStep* steps = grid->work->steps.data;
    for (int32_t i = from + 1; i < grid->work->steps.count; ++i) {
        kiriStep step = steps[i];
        int32_t j = i;
        for (; j > from && ComesBefore(grid, step, steps[j - 1]); --j) {
            steps[j] = steps[j - 1];
        }
        steps[j] = step;
    }
}

static kiriStep Straight(const kiriFace* face, int32_t from)
{
    int8_t way = face->cell[0] == from ? 1 : -1;
    int32_t axis = kiriFace_Axis(face);
    return (kiriStep){ kiriFace_Other(face, from), KIRI_UNIT, axis == 0 ? way : 0, axis == 1 ? way : 0 };
}

/* One step after another. */
static kiriStep Joined(kiriStep a, kiriStep b, int16_t length)
{
    return (kiriStep){ b.cell, length, (int8_t)(a.u + b.u), (int8_t)(a.v + b.v) };
}

/* A step counts where two ways lead to its cell, and counts once: the first way marks the cell with the number that
   this returns, the second way finds it and makes it one more. */
static int32_t NewMark(kiriGridWork* work)
{
    if (work->lastMark > INT32_MAX - 4) { /* after as many as cells in a thousand large cuts: begins anew */
        memset(work->mark.data, 0, sizeof(*work->mark.data) * (size_t)work->mark.count);
        work->lastMark = 0;
    }
    work->lastMark += 2;
    return work->lastMark;
}

static bool AddStraightSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->cells.count);
    for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&grid->faces.data[f], c)) {
        if (!AddStep(grid, memory, Straight(&grid->faces.data[f], c))) {
            return false;
        }
    }
    return true;
}

/* To cells reached along u, then v, and also along v, then u: both ways around the corner. */
static bool AddDiagonalSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    const kiriFace* faces = grid->faces.data;
    const kiriCell* cells = grid->cells.data;
    int32_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    for (int axis = 0; axis < 2; ++axis) {
        for (int32_t f = cells[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&faces[f], c)) {
            int32_t between = kiriFace_Other(&faces[f], c);
            int32_t g = kiriFace_Axis(&faces[f]) == axis ? cells[between].firstFace : KIRI_NONE;
            for (; g != KIRI_NONE; g = kiriFace_Next(&faces[g], between)) {
                grid->work->due += KIRI_GRID_WAY;
                if (kiriFace_Axis(&faces[g]) == axis) {
                    continue;
                }
                kiriStep step = Joined(Straight(&faces[f], c), Straight(&faces[g], between), KIRI_UNIT_DIAGONAL);
                if (axis == 0) {
                    mark[step.cell] = first;
                } else if (mark[step.cell] == first) {
                    mark[step.cell] = first + 1;
                    if (!AddStep(grid, memory, step)) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

/* The knights stay what they are until all diagonal steps are made. */
kiriProgress kiriGrid_MakeNearSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    (void)quota;
    kiriMemory* memory = mesh->memory;
    int32_t c = work->stepsDirty.data[item];
    kiriSteps has;
    work->steps.count = 0;
    work->due += KIRI_GRID_STEPS;
    if (IsWholeAround(grid, &mesh->squares, grid->cells.data[c].square)) {
        return MakeOpenSteps(grid, memory, c) ? KIRI_DONE : KIRI_FAILED;
    }
    if (!AddStraightSteps(grid, memory, c)) {
        return KIRI_FAILED;
    }
    int32_t straight = work->steps.count;
    if (!AddDiagonalSteps(grid, memory, c)) {
        return KIRI_FAILED;
    }
    int32_t near = work->steps.count;
    SortSteps(grid, 0);
    kiriGrid_GetSteps(grid, c, &has);
    return AddSteps(grid, memory, &has, has.end[1], has.end[2]) && SetSteps(grid, memory, c, straight, near) &&
                   kiriArray_Push(memory, &work->knightsDirty, c)
               ? KIRI_DONE
               : KIRI_FAILED;
}

/* Marks the cells reached straight, then diagonally. */
static void MarkKnightSteps(kiriGrid* grid, const kiriSteps* steps, int32_t mark)
{
    for (int32_t i = 0; i < steps->end[0]; ++i) {
        kiriSteps on;
        kiriGrid_GetStepsTo(grid, steps->data[i].cell, 2, &on);
        grid->work->due += on.end[1] - on.end[0];
        for (int32_t j = on.end[0]; j < on.end[1]; ++j) {
            if (steps->data[i].u == on.data[j].u || steps->data[i].v == on.data[j].v) {
                grid->work->mark.data[on.data[j].cell] = mark;
            }
        }
    }
}

/* To cells reached straight, then diagonally, and also diagonally, then straight: a slit is never jumped. */
static bool AddKnightSteps(kiriGrid* grid, kiriMemory* memory, const kiriSteps* steps)
{
    int32_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    MarkKnightSteps(grid, steps, first);
    for (int32_t i = steps->end[0]; i < steps->end[1]; ++i) {
        kiriSteps on;
        kiriGrid_GetStepsTo(grid, steps->data[i].cell, 2, &on);
        for (int32_t j = 0; j < on.end[0]; ++j) {
            if (mark[on.data[j].cell] == first) {
                mark[on.data[j].cell] = first + 1;
                if (!AddStep(grid, memory, Joined(steps->data[i], on.data[j], KIRI_UNIT_KNIGHT))) {
                    return false;
                }
            }
        }
    }
    return true;
}

kiriProgress kiriGrid_MakeKnightSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    KIRI_ASSERT(item >= 0 && item < grid->work->knightsDirty.count);
    (void)quota;
    kiriMemory* memory = mesh->memory;
    int32_t c = grid->work->knightsDirty.data[item];
    kiriSteps has;
    kiriGrid_GetSteps(grid, c, &has);
    grid->work->due += KIRI_GRID_STEPS;
    grid->work->steps.count = 0;
    if (!AddSteps(grid, memory, &has, 0, has.end[1]) || !AddKnightSteps(grid, memory, &has)) {
        return KIRI_FAILED;
    }
    SortSteps(grid, has.end[1]);
    return SetSteps(grid, memory, c, has.end[0], has.end[1]) ? KIRI_DONE : KIRI_FAILED;
}
