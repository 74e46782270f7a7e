#include "kiri_grid_work.h"

/* Null for memory. */
static kiriFace* AddFace(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    KIRI_ASSERT(a != b && kiriGrid_IsCell(grid, a) && kiriGrid_IsCell(grid, b));
    kiriCell *cellA = &grid->cells.data[a], *cellB = &grid->cells.data[b];
    const kiriFace face = { { a, b }, { cellA->firstFace, cellB->firstFace }, axis, 0.0, { 0.0, 0.0 }, 0.0 };
    int32_t f = grid->freeFace;
    if (f != KIRI_NONE) {
        grid->freeFace = grid->faces.data[f].next[0];
        grid->faces.data[f] = face;
    } else if (kiriArray_Push(memory, &grid->faces, face)) {
        f = grid->faces.count - 1;
    }
    if (f == KIRI_NONE || !kiriGrid_RecordLink(grid, memory, a, b)) {
        return NULL;
    }
    cellA->firstFace = cellB->firstFace = f;
    return &grid->faces.data[f];
}

static void UnlinkFace(kiriGrid* grid, int32_t f, int32_t cell)
{
    int32_t* link = &grid->cells.data[cell].firstFace;
    while (*link != f) {
        KIRI_ASSERT(*link != KIRI_NONE);
        kiriFace* face = &grid->faces.data[*link];
        link = &face->next[face->cell[1] == cell];
    }
    *link = kiriFace_Next(&grid->faces.data[f], cell);
}

void kiriGrid_FreeFace(kiriGrid* grid, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < grid->faces.count && grid->faces.data[f].cell[0] != KIRI_NONE);
    kiriFace* face = &grid->faces.data[f];
    UnlinkFace(grid, f, face->cell[0]);
    UnlinkFace(grid, f, face->cell[1]);
    face->cell[0] = KIRI_NONE;
    face->next[0] = grid->freeFace;
    grid->freeFace = f;
}

bool kiriGrid_RemoveFace(kiriGrid* grid, kiriMemory* memory, int32_t f)
{
    bool ok = kiriGrid_RecordLink(grid, memory, grid->faces.data[f].cell[0], grid->faces.data[f].cell[1]);
    kiriGrid_FreeFace(grid, f);
    return ok;
}

/* The face between two cells, new if there is none yet; null for memory. Looks from both ends at once, since a cell
   with many faces, a comb, most often touches cells with few. */
static kiriFace* FaceBetween(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    int32_t f = grid->cells.data[a].firstFace, g = grid->cells.data[b].firstFace;
    while (f != KIRI_NONE && g != KIRI_NONE) {
        kiriFace *ofA = &grid->faces.data[f], *ofB = &grid->faces.data[g];
        if (kiriFace_Other(ofA, a) == b) {
            return ofA;
        }
        if (kiriFace_Other(ofB, b) == a) {
            return ofB;
        }
        f = kiriFace_Next(ofA, a);
        g = kiriFace_Next(ofB, b);
    }
    return AddFace(grid, memory, a, b, axis);
}

/* A stretch of a side: its ends, in lattice steps from the lower end of the side. */
typedef struct Stretch {
    double from, to;
} Stretch;

/* The stretch that a triangle covers of the lower side of a square along the axis. Two of the triangle's edges meet the
   grid line, and no corner lies on it. */
static Stretch CoveredStretch(const kiriMeshData* mesh, int32_t triangle, int32_t square, int axis)
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    double side = mesh->squares.side;
    Stretch stretch = { side, 0.0 };
    kiriMesh_Corners(mesh, triangle, corners);
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint p = corners[i], q = corners[(i + 1) % 3];
        /* Across the side and along it, from the side's lower end; 64 bits hold the products below. */
        int64_t pa = axis == 0 ? p.x - low.x : p.y - low.y, ps = axis == 0 ? p.y - low.y : p.x - low.x;
        int64_t qa = axis == 0 ? q.x - low.x : q.y - low.y, qs = axis == 0 ? q.y - low.y : q.x - low.x;
        if ((pa < 0) != (qa < 0)) {
            double at = (double)(ps * qa - qs * pa) / (double)(qa - pa);
            stretch.from = at < stretch.from ? at : stretch.from;
            stretch.to = at > stretch.to ? at : stretch.to;
        }
    }
    stretch.from = stretch.from > 0.0 ? stretch.from : 0.0;
    stretch.to = stretch.to < side ? stretch.to : side;
    return stretch;
}

/* Adds a stretch by the parallel axis rule: each term is positive, so a narrow face has a sound moment too. */
static void AddStretch(kiriFace* face, const kiriMeshData* mesh, kiriLatticePoint low, Stretch stretch)
{
    double width = mesh->step * (stretch.to - stretch.from), least = kiriLeastShare * mesh->step * mesh->squares.side;
    width = width > least ? width : least;
    kiriVec2 corner = kiriMesh_Local(mesh, low);
    double along = 0.5 * mesh->step * (stretch.from + stretch.to);
    kiriVec2 middle =
        face->axis == 0 ? kiriVec2_Make(corner.x, corner.y + along) : kiriVec2_Make(corner.x + along, corner.y);
    if (face->width == 0.0) {
        face->width = width;
        face->middle = middle;
        face->moment = width * width * width / 12.0;
        return;
    }
    kiriVec2 apart = kiriVec2_Sub(middle, face->middle);
    double sum = face->width + width;
    face->moment += width * width * width / 12.0 + kiriVec2_Dot(apart, apart) * face->width * width / sum;
    face->middle = kiriVec2_Add(face->middle, kiriVec2_Scale(width / sum, apart));
    face->width = sum;
}

/* Whole squares share their whole side. */
static bool AddWholeFace(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis)
{
    Stretch side = { 0.0, mesh->squares.side };
    kiriFace* face =
        FaceBetween(grid, mesh->memory, grid->squareCell.data[before], grid->squareCell.data[square], axis);
    if (face != NULL) {
        AddStretch(face, mesh, kiriSquares_Corner(&mesh->squares, square), side);
    }
    return face != NULL;
}

/* Empties the faces on the lower side of a square along the axis, and keeps what they were. */
static bool EmptyFaces(kiriGrid* grid, kiriMemory* memory, int32_t square, int axis)
{
    kiriGridWork* work = grid->work;
    work->oldFaces.count = 0;
    for (int32_t c = work->fromScratch ? KIRI_NONE : grid->squareCell.data[square]; c != KIRI_NONE;
         c = grid->cells.data[c].next) {
        for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&grid->faces.data[f], c)) {
            kiriFace* face = &grid->faces.data[f];
            if (face->cell[1] == c && face->axis == axis) {
                kiriOldFace old = { f, *face };
                if (!kiriArray_Push(memory, &work->oldFaces, old)) {
                    return false;
                }
                face->width = face->moment = 0.0;
            }
        }
    }
    return true;
}

/* Finds out what became of the faces that were emptied. */
static bool CompareFaces(kiriGrid* grid, kiriMemory* memory)
{
    for (int32_t i = 0; i < grid->work->oldFaces.count; ++i) {
        const kiriOldFace* old = &grid->work->oldFaces.data[i];
        const kiriFace *was = &old->was, *is = &grid->faces.data[old->face];
        if (is->width == 0.0) {
            if (!kiriGrid_RemoveFace(grid, memory, old->face)) {
                return false;
            }
        } else if (is->width != was->width || is->moment != was->moment || is->middle.x != was->middle.x ||
                   is->middle.y != was->middle.y) {
            if (!kiriGrid_RecordSteps(grid, memory, is->cell[0]) || !kiriGrid_RecordSteps(grid, memory, is->cell[1])) {
                return false;
            }
        }
    }
    return true;
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
            kiriFace* face = FaceBetween(grid, mesh->memory, grid->nodeCell.data[work->entries.data[i]],
                                         grid->nodeCell.data[work->entries.data[j]], axis);
            if (face == NULL) {
                return KIRI_FAILED;
            }
            AddStretch(face, mesh, low, CoveredStretch(mesh, t, square, axis));
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
        if (!EmptyFaces(grid, mesh->memory, square, axis)) {
            return KIRI_FAILED;
        }
        work->due += KIRI_GRID_SIDE;
        work->at = work->other = 0;
        work->isMerging = true;
    }
    progress = AddFaces(grid, mesh, before, square, axis, quota);
    work->isMerging = progress == KIRI_MORE;
    return progress != KIRI_DONE || CompareFaces(grid, mesh->memory) ? progress : KIRI_FAILED;
}

static kiriProgress MakeSide(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis,
                             kiriQuota* quota)
{
    if (grid->squareCell.data[before] == KIRI_NONE || grid->squareCell.data[square] == KIRI_NONE) {
        return KIRI_DONE;
    }
    if (!grid->whole.data[before] || !grid->whole.data[square]) {
        return MakeDividedSide(grid, mesh, before, square, axis, quota);
    }
    grid->work->due += KIRI_GRID_SIDE;
    return EmptyFaces(grid, mesh->memory, square, axis) && AddWholeFace(grid, mesh, before, square, axis) &&
                   CompareFaces(grid, mesh->memory)
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
kiriProgress kiriGrid_MakeFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
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
