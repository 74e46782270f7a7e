#include "kiri_grid_work.h"

/* The index of a face of the whole side, or KIRI_NONE for memory. */
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
    kiriGrid_DropStretch(grid, f);
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

/* The face between two cells, new if there is none yet; KIRI_NONE for memory. Looks from both ends at once, since a
   cell with many faces, a comb, most often touches cells with few. */
static int32_t FaceBetween(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
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

/* What a triangle covers of a side: its ends, in lattice steps from the lower end of the side. */
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
    int32_t f = FaceBetween(grid, mesh->memory, grid->squareCell.data[before], grid->squareCell.data[square], axis);
    if (f != KIRI_NONE) {
        kiriGrid_DropStretch(grid, f);
    }
    return f != KIRI_NONE;
}

/* Empties the faces on the lower side of a square along the axis, and keeps what they were. */
static bool EmptyFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int axis)
{
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
