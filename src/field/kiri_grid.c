#include "kiri_grid.h"

/* Costs of work, in parts of an item of the quota; a part is about 5 ns. */
enum {
    PARTS_AN_ITEM = 16,
    COST_OF_SQUARE = 6,   /* looking at a square */
    COST_OF_NODE = 2,     /* looking at a triangle of a square */
    COST_OF_JOIN = 12,    /* joining a triangle with its neighbours */
    COST_OF_MEASURE = 12, /* measuring the part of a triangle in a square */
    COST_OF_STRETCH = 18, /* measuring the part of a triangle on a side */
    COST_OF_CELL = 24,    /* making or changing a cell */
    COST_OF_SIDE = 20,    /* looking at the faces on a side of a square */
    COST_OF_STEPS = 24,   /* making the steps of a cell */
    COST_OF_WAY = 3       /* looking at a way over two faces */
};

/* The least share of a square's area, or of its side, that a cell or a face is given. Whether they exist is decided
   exactly; their size is not, and may round to nothing where others divide by it. */
static const double leastShare = 1e-14;

/* Flags of a square in the update in progress: it is in the list of this name. */
enum { SQUARE_COLLECTED = 1, SQUARE_FACES_DIRTY = 2, SQUARE_LINKS_DIRTY = 4, SQUARE_STEPS_DIRTY = 8 };

/* Flags of a cell: it is in this list of changes. */
enum { CELL_MADE = 1, CELL_MATERIAL = 2, CELL_STEPS = 4, CELL_EDGES = 8 };

/* ---- Lists of an update ------------------------------------------------------------------------------------------ */

/* Appends to a list. Without memory the update fails when the current item is done. */
static void AppendIndex(kiriGrid* grid, kiriIndices* list, int32_t index)
{
    bool ok = kiriArray_Push(grid->mesh->memory, list, index);
    grid->work->outOfMemory = grid->work->outOfMemory || !ok;
}

/* Sets a flag of a square until the end of the update; false if it was set. Appends the square to the flag's list, if
   the flag has one. */
static bool FlagSquare(kiriGrid* grid, int32_t square, uint8_t flag, kiriIndices* list)
{
    KIRI_ASSERT(grid->work->running && square >= 0 && square < grid->work->squareFlags.count);
    uint8_t* flags = &grid->work->squareFlags.data[square];
    if ((*flags & flag) != 0) {
        return false;
    }
    if (*flags == 0) {
        AppendIndex(grid, &grid->work->flagged, square);
    }
    *flags |= flag;
    if (list != NULL) {
        AppendIndex(grid, list, square);
    }
    return true;
}

/* Appends a cell to a list of changes, once. */
static void RecordCell(kiriGrid* grid, int32_t cell, uint8_t flag, kiriIndices* list)
{
    KIRI_ASSERT(grid->work->running && kiriGrid_IsCell(grid, cell));
    if ((grid->work->cellFlags.data[cell] & flag) == 0) {
        grid->work->cellFlags.data[cell] |= flag;
        AppendIndex(grid, list, cell);
    }
}

/* Records that a face came or goes: steps of its cells, and of cells around, may change. From scratch all are made. */
static void RecordLink(kiriGrid* grid, const kiriFace* face)
{
    KIRI_TIMES_WHILE(!grid->work->fromScratch, k, 2) {
        KIRI_ASSERT(kiriGrid_IsCell(grid, face->cell[k]));
        int32_t square = grid->cells.data[face->cell[k]].square;
        RecordCell(grid, face->cell[k], CELL_STEPS, &grid->changes.steps);
        FlagSquare(grid, square, SQUARE_LINKS_DIRTY, &grid->work->linksDirty);
    }
}

/* ---- What cells and faces cover ---------------------------------------------------------------------------------- */

static kiriMoments MaterialOfWhole(const kiriGrid* grid, int32_t square)
{
    KIRI_ASSERT_HAS(grid->squareCell, square);
    double x = grid->side, area = x * x;
    kiriMoments about = {
        area, x / 2.0 * area, x / 2.0 * area, area * area / 3.0, area * area / 4.0, area * area / 3.0
    };
    kiriVec2 corner = kiriMesh_Local(grid->mesh, kiriSquares_Corner(&grid->mesh->squares, square));
    return kiriMoments_About(&about, kiriVec2_Scale(-1.0, corner));
}

/* Returns the stretch between two points on the lower side of a square along the axis, in lattice steps from its lower
   end. */
static kiriStretch StretchOfSide(const kiriMeshData* mesh, int32_t square, int32_t axis, double from, double to)
{
    double width = mesh->step * (to - from), least = leastShare * mesh->step * mesh->squares.side;
    width = kiriMax(width, least);
    kiriVec2 middle = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    *(axis == 0 ? &middle.y : &middle.x) += 0.5 * mesh->step * (from + to);
    return (kiriStretch){ width, middle, width * width * width / 12.0 };
}

static int32_t StretchIndexOf(const kiriFace* face)
{
    return (face->kind >> 1) - 1;
}

kiriMoments kiriGrid_Material(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(grid->cells, cell);
    const kiriCell* at = &grid->cells.data[cell];
    return at->material == KIRI_NONE ? MaterialOfWhole(grid, at->square) : grid->materials.data[at->material];
}

kiriStretch kiriGrid_Stretch(const kiriGrid* grid, int32_t face)
{
    KIRI_ASSERT(face >= 0 && face < grid->faces.count && grid->faces.data[face].cell[0] != KIRI_NONE);
    const kiriFace* at = &grid->faces.data[face];
    return kiriFace_HasOwnStretch(at) ? grid->stretches.data[StretchIndexOf(at)]
                                      : StretchOfSide(grid->mesh, grid->cells.data[at->cell[1]].square,
                                                      kiriFace_Axis(at), 0.0, grid->mesh->squares.side);
}

/* Takes an unused item of an array, or adds one; KIRI_NONE for memory. The list of unused ones has room for all. */
static int32_t TakeUnusedItem(kiriMemory* memory, void* array, size_t itemBytes, kiriIndices* unused)
{
    if (unused->count > 0) {
        return unused->data[--unused->count];
    }
    int64_t need = (int64_t)kiriArray_GetHeader(array).count + 1;
    bool ok = kiriArray_Reserve(memory, unused, need) &&
              kiriArrays_SetCount(memory, need, (const kiriAnyArray[]){ { array, itemBytes }, { NULL, 0 } });
    return ok ? (int32_t)need - 1 : KIRI_NONE;
}

static void GiveItemBack(kiriIndices* unused, int32_t index)
{
    if (index != KIRI_NONE) {
        KIRI_NEXT(*unused) = index;
    }
}

kiriMoments* kiriGrid_OwnMaterial(kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(grid->cells, cell);
    int32_t* index = &grid->cells.data[cell].material;
    if (*index == KIRI_NONE) {
        *index = TakeUnusedItem(grid->mesh->memory, &grid->materials, sizeof(kiriMoments), &grid->unusedMaterials);
    }
    return *index == KIRI_NONE ? NULL : &grid->materials.data[*index];
}

static void DropMaterial(kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(grid->cells, cell);
    GiveItemBack(&grid->unusedMaterials, grid->cells.data[cell].material);
    grid->cells.data[cell].material = KIRI_NONE;
}

kiriStretch* kiriGrid_OwnStretch(kiriGrid* grid, int32_t face)
{
    KIRI_ASSERT_HAS(grid->faces, face);
    kiriFace* at = &grid->faces.data[face];
    if (!kiriFace_HasOwnStretch(at)) {
        int32_t index =
            TakeUnusedItem(grid->mesh->memory, &grid->stretches, sizeof(kiriStretch), &grid->unusedStretches);
        at->kind = 2 * (index + 1) + kiriFace_Axis(at);
    }
    return kiriFace_HasOwnStretch(at) ? &grid->stretches.data[StretchIndexOf(at)] : NULL;
}

static void DropStretch(kiriGrid* grid, int32_t face)
{
    KIRI_ASSERT_HAS(grid->faces, face);
    kiriFace* at = &grid->faces.data[face];
    GiveItemBack(&grid->unusedStretches, StretchIndexOf(at));
    at->kind = kiriFace_Axis(at);
}

/* ---- Lists of faces ---------------------------------------------------------------------------------------------- */

/* Adds a face of the whole side; KIRI_NONE for memory. */
static int32_t AddFace(kiriGrid* grid, int32_t a, int32_t b, int32_t axis)
{
    KIRI_ASSERT(a != b && kiriGrid_IsCell(grid, a) && kiriGrid_IsCell(grid, b));
    kiriCell *cellA = &grid->cells.data[a], *cellB = &grid->cells.data[b];
    const kiriFace face = { { a, b }, { cellA->firstFace, cellB->firstFace }, axis };
    int32_t f = grid->freeFace;
    if (f != KIRI_NONE) {
        grid->freeFace = grid->faces.data[f].next[0];
        grid->faces.data[f] = face;
    } else if (kiriArray_Push(grid->mesh->memory, &grid->faces, face)) {
        f = grid->faces.count - 1;
    } else {
        return KIRI_NONE;
    }
    cellA->firstFace = cellB->firstFace = f;
    RecordLink(grid, &face);
    return f;
}

static void RemoveFace(kiriGrid* grid, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < grid->faces.count && grid->faces.data[f].cell[0] != KIRI_NONE);
    kiriFace* face = &grid->faces.data[f];
    KIRI_TIMES(k, 2) {
        int32_t cell = face->cell[k], *link = &grid->cells.data[cell].firstFace;
        while (*link != f) {
            KIRI_ASSERT(*link != KIRI_NONE);
            kiriFace* before = &grid->faces.data[*link];
            link = &before->next[before->cell[1] == cell];
        }
        *link = face->next[k];
    }
    DropStretch(grid, f);
    face->cell[0] = KIRI_NONE;
    face->next[0] = grid->freeFace;
    grid->freeFace = f;
}

/* Finds or adds the face between two cells; KIRI_NONE for memory. Walks the lists of both at once, since a cell with
   many faces, a comb, most often touches cells with few. */
static int32_t FaceBetween(kiriGrid* grid, int32_t a, int32_t b, int32_t axis)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, a) && kiriGrid_IsCell(grid, b));
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
    return AddFace(grid, a, b, axis);
}

/* ---- Room for steps ---------------------------------------------------------------------------------------------- */

/* Gives a cell room for this number of steps, and at least for as many as most cells have: so most runs never move. */
static bool ResizeSteps(kiriGrid* grid, int32_t c, int32_t count)
{
    KIRI_ASSERT(c >= 0 && c < grid->runs.count && count >= 0);
    kiriStepRun* run = &grid->runs.data[c];
    int32_t had = kiriStepRun_IsOpen(run) ? 0 : run->end[KIRI_STEP_LENGTHS - 1] - run->first;
    kiriSpan span = { had == 0 ? 0 : run->first, had == 0 ? 0 : kiriMax(had, KIRI_OPEN_STEPS) };
    int32_t room = count == 0 ? 0 : kiriMax(count, KIRI_OPEN_STEPS);
    bool ok = kiriSpan_Resize(&span, &grid->stepRoom, grid->mesh->memory, &grid->steps, sizeof(kiriStep), room);
    KIRI_ASSERT(ok || count > 0);
    if (ok && kiriGrid_IsOpen(grid, c)) {
        grid->whole.data[c] = KIRI_SQUARE_WHOLE;
    }
    run->first = span.first;
    run->end[0] = run->end[1] = run->end[2] = span.first + (ok ? count : had);
    return ok;
}

/* ---- Triangles of a square --------------------------------------------------------------------------------------- */

static int32_t TriangleAt(const kiriGridWork* work, const kiriMeshData* mesh, int32_t entry)
{
    KIRI_ASSERT_HAS(work->entries, entry);
    return mesh->squares.nodes.data[work->entries.data[entry]].triangle;
}

static bool IsNodeBefore(const void* nodes, int32_t a, int32_t b)
{
    return ((const kiriSquareNode*)nodes)[a].triangle < ((const kiriSquareNode*)nodes)[b].triangle;
}

/* Puts the triangles of a square into `entries`, in ascending order: so results do not depend on the order of the
   square's list. Lists have the latest triangles first. Reversed they are nearly in order. */
static void CollectTriangles(kiriGrid* grid, int32_t square)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    if (!FlagSquare(grid, square, SQUARE_COLLECTED, NULL)) {
        return;
    }
    KIRI_ASSERT(square < work->ranges.count);
    kiriNodeRange* range = &work->ranges.data[square];
    range->first = work->entries.count;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = nodes[n].next) {
        AppendIndex(grid, &work->entries, n);
    }
    range->end = work->entries.count;
    int32_t *entries = work->entries.data + range->first, count = range->end - range->first;
    for (int32_t i = 0, j = count - 1; i < j; ++i, --j) {
        int32_t node = entries[i];
        entries[i] = entries[j];
        entries[j] = node;
    }
    kiriSort(entries, count, IsNodeBefore, nodes);
    work->debt += 2 * COST_OF_NODE * (int64_t)count;
}

/* Joins a triangle of a square with those after it across its closed edges that run through the square. */
static void JoinEntry(kiriGridWork* work, const kiriMeshData* mesh, int32_t square, int32_t i)
{
    kiriNodeRange range = work->ranges.data[square];
    int32_t triangle = TriangleAt(work, mesh, i);
    KIRI_ASSERT(i >= range.first && i < range.end);
    KIRI_FROM_TO(h, 3 * triangle, 3 * triangle + 3) {
        int32_t twin = kiriMesh_Twin(mesh, h), j;
        if (twin < h || kiriMesh_IsOpen(mesh, h)) {
            continue;
        }
        KIRI_SEARCH(j, i + 1, range.end, TriangleAt(work, mesh, middle) < twin / 3);
        if (j < range.end && TriangleAt(work, mesh, j) == twin / 3 &&
            kiriSquares_RunsThrough(&mesh->squares, square, kiriMesh_TailAt(mesh, h), kiriMesh_HeadAt(mesh, h))) {
            kiriUnion_Join(work->parent.data, i - range.first, j - range.first);
        }
    }
}

/* Joins the triangles of a square: each set is a cell (algorithm 3). False for memory. */
static bool JoinTriangles(kiriGrid* grid, int32_t square)
{
    kiriGridWork* work = grid->work;
    CollectTriangles(grid, square);
    kiriNodeRange range = work->ranges.data[square];
    if (work->outOfMemory || !kiriArray_Resize(grid->mesh->memory, &work->parent, range.end - range.first)) {
        return false;
    }
    kiriUnion_Init(work->parent.data, work->parent.count);
    KIRI_FROM_TO(i, range.first, range.end) {
        JoinEntry(work, grid->mesh, square, i);
    }
    work->debt += COST_OF_JOIN * (int64_t)work->parent.count;
    return true;
}

/* ---- Material ---------------------------------------------------------------------------------------------------- */

/* Room for the clipped triangle even where rounding spoils its convexity: 3, 4, 6, 9, 13 corners when counted
   closely. */
enum { MOST_CORNERS = 13 };
typedef struct ClippedPolygon {
    kiriVec2 at[MOST_CORNERS];
    int32_t count;
} ClippedPolygon;

/* Cuts off the part outside one side of the square (Sutherland and Hodgman 1974). An edge is followed from its inner
   end whichever way the triangle runs, so neighbours at this edge get the very same point. */
static void ClipAtSide(ClippedPolygon* polygon, int axis, bool upper, double side)
{
    double depth[MOST_CORNERS], least = side;
    KIRI_EACH_INDEX(i, *polygon) {
        double x = axis == 0 ? polygon->at[i].x : polygon->at[i].y;
        depth[i] = upper ? side - x : x;
        least = kiriMin(depth[i], least);
    }
    if (least > 0.0) {
        return;
    }
    ClippedPolygon was = *polygon;
    polygon->count = 0;
    KIRI_EACH_INDEX(i, was) {
        int32_t j = i + 1 < was.count ? i + 1 : 0;
        KIRI_ASSERT(polygon->count + 2 <= MOST_CORNERS);
        if (depth[i] > 0.0) {
            polygon->at[polygon->count++] = was.at[i];
        }
        if ((depth[i] > 0.0) != (depth[j] > 0.0)) {
            int32_t in = depth[i] > 0.0 ? i : j, out = i + j - in;
            kiriVec2 way = kiriVec2_Sub(was.at[out], was.at[in]);
            kiriVec2 at = kiriVec2_AddScaled(was.at[in], depth[in] / (depth[in] - depth[out]), way);
            *(axis == 0 ? &at.x : &at.y) = upper ? side : 0.0;
            polygon->at[polygon->count++] = at;
        }
    }
}

/* Measures the part of a triangle in a square, about the square's lower corner, so that nothing cancels in a small
   part. */
static kiriMoments MaterialInSquare(const kiriMeshData* mesh, int32_t triangle, int32_t square)
{
    KIRI_ASSERT_HAS(mesh->triangles, triangle);
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    ClippedPolygon part;
    kiriMoments sum = { 0 };
    kiriMesh_Corners(mesh, triangle, corners);
    part.count = 3;
    KIRI_EACH_CORNER(i) {
        part.at[i] = kiriVec2_Make((double)corners[i].x - low.x, (double)corners[i].y - low.y);
    }
    KIRI_TIMES(k, 4) {
        ClipAtSide(&part, k / 2, k % 2 == 1, mesh->squares.side);
    }
    KIRI_EACH_INDEX(i, part) {
        part.at[i] = kiriVec2_Scale(mesh->step, part.at[i]);
        if (i >= 2) {
            kiriMoments fan = kiriMoments_Triangle(part.at[0], part.at[i - 1], part.at[i]);
            kiriMoments_Add(&sum, &fan);
        }
    }
    return sum;
}

/* Finds the cells that a divided square should have, by lowest triangle, in `newCells`. Until they have indices
   `nodeCell` has their ranks in that list. False for memory. */
static bool FindNewCells(kiriGrid* grid, int32_t square)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    kiriNodeRange range = work->ranges.data[square];
    KIRI_ASSERT((work->squareFlags.data[square] & SQUARE_COLLECTED) != 0 && work->newCells.count == 0);
    KIRI_FROM_TO(i, range.first, range.end) {
        int32_t root = range.first + kiriUnion_Root(work->parent.data, i - range.first);
        int32_t triangle = TriangleAt(work, mesh, i), *rank = &grid->nodeCell.data[work->entries.data[i]];
        const kiriNewCell none = { triangle, KIRI_NONE, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 } };
        if (root == i && !kiriArray_Push(mesh->memory, &work->newCells, none)) {
            return false;
        }
        *rank = root == i ? work->newCells.count - 1 : grid->nodeCell.data[work->entries.data[root]];
        KIRI_ASSERT(root <= i && *rank >= 0 && *rank < work->newCells.count);
        kiriMoments part = MaterialInSquare(mesh, triangle, square);
        kiriMoments_Add(&work->newCells.data[*rank].material, &part);
    }
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    KIRI_EACH(kiriNewCell, fresh, work->newCells) {
        kiriMoments* material = &fresh->material;
        double area = leastShare * grid->side * grid->side, half = 0.5 * grid->side;
        if (!(material->area > area)) { /* a speck in the middle of the square */
            *material = (kiriMoments){ area,
                                       half * area,
                                       half * area,
                                       half * half * area,
                                       half * half * area,
                                       half * half * area };
        }
        *material = kiriMoments_About(material, kiriVec2_Scale(-1.0, corner));
    }
    work->debt += COST_OF_MEASURE * (int64_t)(range.end - range.first);
    return true;
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

/* Returns the index of a new cell, or KIRI_NONE for memory. From scratch the first cell of a square has its index. */
static int32_t AddCell(kiriGrid* grid, int32_t square)
{
    kiriGridWork* work = grid->work;
    bool isOwn = work->fromScratch && grid->cells.data[square].square == KIRI_NONE;
    int32_t c = isOwn ? square : grid->freeCell, count = grid->cells.count;
    if (c == KIRI_NONE) {
        if (!kiriArrays_Resize(grid->mesh->memory, (int64_t)count + 1, &grid->cells, &grid->runs, &work->cellFlags,
                               &work->mark)) {
            return KIRI_NONE;
        }
        c = count;
        grid->runs.data[c] = (kiriStepRun){ 0 };
        work->mark.data[c] = 0;
    } else if (!isOwn) {
        grid->freeCell = grid->cells.data[c].next;
    }
    grid->cells.data[c] = (kiriCell){ square, KIRI_NONE, KIRI_NONE, KIRI_NONE, KIRI_NONE };
    ++grid->cellCount;
    work->cellFlags.data[c] = 0;
    RecordCell(grid, c, CELL_MADE, &grid->changes.made);
    RecordCell(grid, c, CELL_STEPS, &grid->changes.steps);
    return c;
}

static bool StoreMaterial(kiriGrid* grid, int32_t c, const kiriMoments* material)
{
    kiriMoments* own = kiriGrid_OwnMaterial(grid, c);
    if (own != NULL) {
        *own = *material;
    }
    return own != NULL;
}

/* SetMaterial compares bytes. */
typedef char MomentsHaveNoPadding[sizeof(kiriMoments) == 6 * sizeof(double) ? 1 : -1];

static bool SetMaterial(kiriGrid* grid, int32_t c, const kiriMoments* material)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, c));
    kiriMaterialChange change = { c, kiriGrid_Material(grid, c) };
    uint8_t* flags = &grid->work->cellFlags.data[c];
    if (memcmp(&change.was, material, sizeof(*material)) == 0) {
        return true;
    }
    if (grid->whole.data[grid->cells.data[c].square]) {
        DropMaterial(grid, c);
    } else if (!StoreMaterial(grid, c, material)) {
        return false;
    }
    if ((*flags & (CELL_MADE | CELL_MATERIAL)) != 0) {
        return true;
    }
    *flags |= CELL_MATERIAL;
    return kiriArray_Push(grid->mesh->memory, &grid->changes.material, change);
}

/* Stores the material of a whole cell: without a square it no longer follows. */
static bool RemoveCell(kiriGrid* grid, int32_t c)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, c));
    kiriCell* cell = &grid->cells.data[c];
    kiriMoments material = kiriGrid_Material(grid, c);
    if (!StoreMaterial(grid, c, &material)) {
        return false;
    }
    while (cell->firstFace != KIRI_NONE) {
        RecordLink(grid, &grid->faces.data[cell->firstFace]);
        RemoveFace(grid, cell->firstFace);
    }
    ResizeSteps(grid, c, 0);
    cell->square = cell->next = KIRI_NONE;
    --grid->cellCount;
    grid->work->hasRemoved = true;
    if ((grid->work->cellFlags.data[c] & CELL_MADE) == 0) {
        AppendIndex(grid, &grid->changes.gone, c);
    }
    return true;
}

/* Replaces the old cells of the square by the new ones, in order. Adds or removes cells if their number changes. */
static bool ReplaceCells(kiriGrid* grid, int32_t square)
{
    KIRI_ASSERT_HAS(grid->squareCell, square);
    int32_t old = grid->squareCell.data[square], last = KIRI_NONE;
    grid->squareCell.data[square] = KIRI_NONE;
    KIRI_EACH(kiriNewCell, made, grid->work->newCells) {
        made->cell = old != KIRI_NONE ? old : AddCell(grid, square);
        if (made->cell == KIRI_NONE || !SetMaterial(grid, made->cell, &made->material)) {
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
        int32_t next = grid->cells.data[old].next;
        if (!RemoveCell(grid, old)) {
            return false;
        }
        old = next;
    }
    grid->work->debt += COST_OF_CELL * (int64_t)grid->work->newCells.count;
    return true;
}

/* True if the outline or an open edge of the triangle runs through the square. */
static bool RunsThroughSquare(const kiriMeshData* mesh, const kiriTriangle* t, int32_t square)
{
    KIRI_ASSERT(t->vertex[0] >= 0 && t->vertex[0] < mesh->vertices.count);
    KIRI_EACH_CORNER(i) {
        if ((t->twin[i] == KIRI_NONE || (t->marks >> i & 1) != 0) &&
            kiriSquares_RunsThrough(&mesh->squares, square, kiriMesh_At(mesh, t->vertex[i]),
                                    kiriMesh_At(mesh, t->vertex[(i + 1) % 3]))) {
            return true;
        }
    }
    return false;
}

/* Returns true if the square is whole: it has material, and neither the outline nor an open edge crosses it. Then it is
   fully covered, its triangles are connected in it, and it has one cell without joining or clipping. Most squares are
   whole. */
static bool IsSquareWhole(kiriGridWork* work, const kiriMeshData* mesh, int32_t square)
{
    int32_t n = mesh->squares.head[square];
    bool isWhole = n != KIRI_NONE;
    for (; isWhole && n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        const kiriTriangle* t = &mesh->triangles.data[mesh->squares.nodes.data[n].triangle];
        bool isInner = (t->marks & KIRI_TRIANGLE_OPEN) == 0 &&
                       (t->twin[0] | t->twin[1] | t->twin[2]) >= 0; /* KIRI_NONE has the sign bit */
        isWhole = isInner || !RunsThroughSquare(mesh, t, square);
        work->debt += COST_OF_NODE;
    }
    work->debt += COST_OF_SQUARE;
    return isWhole;
}

/* Gives all triangles of a whole square to its one cell. */
static void FillWholeSquare(kiriGrid* grid, int32_t square)
{
    int32_t c = grid->squareCell.data[square], lowest = INT32_MAX;
    KIRI_ASSERT(kiriGrid_IsCell(grid, c) && grid->cells.data[c].next == KIRI_NONE);
    KIRI_EACH_NODE(n, &grid->mesh->squares, square) {
        lowest = kiriMin(grid->mesh->squares.nodes.data[n].triangle, lowest);
        grid->nodeCell.data[n] = c;
        grid->work->debt += COST_OF_NODE;
    }
    grid->cells.data[c].triangle = lowest;
}

/* Gives the triangles of a divided square their cells, and the vertices in it, which find their fan by a triangle. An
   edge may have changed that changes neither material nor faces: a slit that ends in the square, by its tip. */
static void FillDividedSquare(kiriGrid* grid, int32_t square)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    kiriNodeRange range = work->ranges.data[square];
    KIRI_FROM_TO(i, range.first, range.end) {
        int32_t triangle = TriangleAt(work, mesh, i), *cell = &grid->nodeCell.data[work->entries.data[i]];
        KIRI_ASSERT(*cell >= 0 && *cell < work->newCells.count);
        *cell = work->newCells.data[*cell].cell;
        const int32_t* corners = mesh->triangles.data[triangle].vertex;
        KIRI_TIMES_WHILE(work->newCells.count > 1, k, 3) {
            const kiriVertex* v = &mesh->vertices.data[corners[k]];
            if (v->edge / 3 == triangle && kiriSquares_At(&mesh->squares, v->at) == square) {
                grid->vertexCell.data[corners[k]] = *cell;
            }
        }
    }
    KIRI_EACH_CELL(c, grid, square) {
        RecordCell(grid, c, CELL_EDGES, &grid->changes.edges);
    }
    work->debt += 2 * COST_OF_NODE * (int64_t)(range.end - range.first);
}

/* Makes the cells of a square. A square that stays whole keeps its cell, and nothing else changes. */
static void MakeCells(kiriGrid* grid, int32_t item)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    int32_t square = work->fromScratch ? item : mesh->squares.dirty.data[item];
    KIRI_ASSERT_HAS(grid->whole, square);
    bool wasWhole = grid->whole.data[square], isWhole = IsSquareWhole(work, mesh, square);
    grid->whole.data[square] = isWhole && wasWhole ? grid->whole.data[square] : isWhole;
    work->newCells.count = 0;
    if (isWhole && wasWhole) {
        FillWholeSquare(grid, square);
        return;
    }
    FlagSquare(grid, square, SQUARE_FACES_DIRTY, &work->facesDirty);
    const kiriNewCell whole = { KIRI_NONE, KIRI_NONE, MaterialOfWhole(grid, square) };
    bool ok = isWhole ? kiriArray_Push(mesh->memory, &work->newCells, whole)
                      : JoinTriangles(grid, square) && FindNewCells(grid, square);
    if (!ok || !ReplaceCells(grid, square)) {
        work->outOfMemory = true;
    } else if (isWhole) {
        FillWholeSquare(grid, square);
    } else {
        FillDividedSquare(grid, square);
    }
}

/* ---- Faces ------------------------------------------------------------------------------------------------------- */

/* Finds the stretch that a triangle covers of the lower side of a square along the axis. Two of the triangle's edges
   meet the grid line, and no corner lies on it. */
static kiriStretch StretchOfTriangle(const kiriMeshData* mesh, int32_t triangle, int32_t square, int32_t axis)
{
    KIRI_ASSERT(axis == 0 || axis == 1);
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    double from = mesh->squares.side, to = 0.0;
    kiriMesh_Corners(mesh, triangle, corners);
    KIRI_EACH_CORNER(i) {
        kiriLatticePoint p = corners[i], q = corners[(i + 1) % 3];
        /* Across the side and along it, from the side's lower end; 64 bits hold the products below. */
        int64_t pa = axis == 0 ? p.x - low.x : p.y - low.y, ps = axis == 0 ? p.y - low.y : p.x - low.x;
        int64_t qa = axis == 0 ? q.x - low.x : q.y - low.y, qs = axis == 0 ? q.y - low.y : q.x - low.x;
        if ((pa < 0) != (qa < 0)) {
            double at = (double)(ps * qa - qs * pa) / (double)(qa - pa);
            from = kiriMin(at, from);
            to = kiriMax(at, to);
        }
    }
    from = kiriMax(from, 0.0);
    to = kiriMin(to, (double)mesh->squares.side);
    KIRI_ASSERT(from <= to);
    return StretchOfSide(mesh, square, axis, from, to);
}

/* Adds by the parallel axis rule: each term is positive, so a narrow face has a sound moment too. */
static void AddStretch(kiriStretch* sum, kiriStretch part)
{
    KIRI_ASSERT(sum->width >= 0.0 && part.width > 0.0);
    if (sum->width == 0.0) {
        *sum = part;
        return;
    }
    kiriVec2 apart = kiriVec2_Sub(part.middle, sum->middle);
    double both = sum->width + part.width;
    sum->moment += part.moment + kiriVec2_Dot(apart, apart) * sum->width * part.width / both;
    sum->middle = kiriVec2_AddScaled(sum->middle, part.width / both, apart);
    sum->width = both;
}

/* Empties the faces on the lower side of a square along the axis, and keeps their stretches in `oldFaces`. */
static void EmptyFaces(kiriGrid* grid, int32_t square, int32_t axis)
{
    kiriGridWork* work = grid->work;
    work->oldFaces.count = 0;
    KIRI_EACH_CELL(c, grid, square) {
        KIRI_EACH_FACE(f, grid, c) {
            const kiriFace* face = &grid->faces.data[f];
            if (face->cell[1] == c && kiriFace_Axis(face) == axis) {
                kiriOldFace old = { f, kiriGrid_Stretch(grid, f) };
                kiriStretch* own = kiriGrid_OwnStretch(grid, f);
                if (own == NULL || !kiriArray_Push(grid->mesh->memory, &work->oldFaces, old)) {
                    work->outOfMemory = true;
                    return;
                }
                own->width = own->moment = 0.0;
            }
        }
    }
}

/* Adds to the face between two cells of a side whose faces were emptied. A null part: all of the side. */
static void CoverFace(kiriGrid* grid, int32_t a, int32_t b, int32_t axis, const kiriStretch* part)
{
    int32_t f = FaceBetween(grid, a, b, axis);
    if (f != KIRI_NONE && part == NULL) {
        DropStretch(grid, f);
        return;
    }
    bool isNew = f != KIRI_NONE && !kiriFace_HasOwnStretch(&grid->faces.data[f]);
    kiriStretch* sum = f != KIRI_NONE ? kiriGrid_OwnStretch(grid, f) : NULL;
    if (sum == NULL) {
        grid->work->outOfMemory = true;
        return;
    }
    if (isNew) {
        sum->width = sum->moment = 0.0;
    }
    AddStretch(sum, *part);
}

/* Links the cells of a square to the cells of the square before it along the axis. A triangle with material in both
   squares covers a stretch of the side between them, because both squares together are convex. */
static void CoverDividedSide(kiriGrid* grid, int32_t before, int32_t square, int32_t axis)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    kiriNodeRange a = work->ranges.data[before], b = work->ranges.data[square];
    KIRI_ASSERT(work->outOfMemory || (a.end <= work->entries.count && b.end <= work->entries.count));
    while (a.first < a.end && b.first < b.end && !work->outOfMemory) {
        int32_t i = a.first, j = b.first, t = TriangleAt(work, mesh, i), u = TriangleAt(work, mesh, j);
        if (t == u) {
            const kiriStretch part = StretchOfTriangle(mesh, t, square, axis);
            CoverFace(grid, grid->nodeCell.data[work->entries.data[i]], grid->nodeCell.data[work->entries.data[j]],
                      axis, &part);
        }
        a.first += t <= u;
        b.first += u <= t;
        work->debt += t == u ? COST_OF_STRETCH : COST_OF_NODE;
    }
}

/* Removes the emptied faces that no triangle covers any more, and records those that have changed. */
static void CompareFaces(kiriGrid* grid)
{
    KIRI_EACH(const kiriOldFace, old, grid->work->oldFaces) {
        const kiriFace* face = &grid->faces.data[old->face];
        KIRI_ASSERT(face->cell[0] != KIRI_NONE && old->was.width > 0.0);
        const kiriStretch was = old->was, is = kiriGrid_Stretch(grid, old->face);
        if (is.width == 0.0) {
            RecordLink(grid, face);
            RemoveFace(grid, old->face);
        } else if (is.width != was.width || is.moment != was.moment || is.middle.x != was.middle.x ||
                   is.middle.y != was.middle.y) {
            RecordCell(grid, face->cell[0], CELL_STEPS, &grid->changes.steps);
            RecordCell(grid, face->cell[1], CELL_STEPS, &grid->changes.steps);
        }
    }
}

static void MakeSide(kiriGrid* grid, int32_t before, int32_t square, int32_t axis)
{
    KIRI_ASSERT(before >= 0 && before < square && square < grid->squareCell.count);
    int32_t a = grid->squareCell.data[before], b = grid->squareCell.data[square];
    if (a == KIRI_NONE || b == KIRI_NONE) {
        return;
    }
    EmptyFaces(grid, square, axis);
    if (grid->work->outOfMemory) {
        return;
    }
    if (grid->whole.data[before] && grid->whole.data[square]) {
        CoverFace(grid, a, b, axis, NULL);
    } else {
        CollectTriangles(grid, before);
        CollectTriangles(grid, square);
        CoverDividedSide(grid, before, square, axis);
    }
    CompareFaces(grid);
    grid->work->debt += COST_OF_SIDE;
}

/* Makes the four sides of a square. Between two squares in the list the one with the higher coordinate does it. */
static void MakeFaces(kiriGrid* grid, int32_t item)
{
    const kiriSquares* squares = &grid->mesh->squares;
    KIRI_ASSERT_HAS(grid->work->facesDirty, item);
    int32_t square = grid->work->facesDirty.data[item];
    int32_t place[2] = { square % squares->columns, square / squares->columns };
    KIRI_TIMES(axis, 2) {
        if (place[axis] > 0) {
            MakeSide(grid, square - (axis == 0 ? 1 : squares->columns), square, axis);
        }
    }
    KIRI_TIMES(axis, 2) {
        int32_t beyond = square + (axis == 0 ? 1 : squares->columns);
        if (place[axis] + 1 < (axis == 0 ? squares->columns : squares->rows) &&
            (grid->work->squareFlags.data[beyond] & SQUARE_FACES_DIRTY) == 0) {
            MakeSide(grid, square, beyond, axis);
        }
    }
}

/* ---- Steps ------------------------------------------------------------------------------------------------------- */

static const kiriStep openSteps[KIRI_OPEN_STEPS] = {
    { 0, KIRI_UNIT, 0, -1 },          { 0, KIRI_UNIT, -1, 0 },           { 0, KIRI_UNIT, 1, 0 },
    { 0, KIRI_UNIT, 0, 1 },           { 0, KIRI_UNIT_DIAGONAL, -1, -1 }, { 0, KIRI_UNIT_DIAGONAL, 1, -1 },
    { 0, KIRI_UNIT_DIAGONAL, -1, 1 }, { 0, KIRI_UNIT_DIAGONAL, 1, 1 },   { 0, KIRI_UNIT_KNIGHT, -1, -2 },
    { 0, KIRI_UNIT_KNIGHT, 1, -2 },   { 0, KIRI_UNIT_KNIGHT, -2, -1 },   { 0, KIRI_UNIT_KNIGHT, 2, -1 },
    { 0, KIRI_UNIT_KNIGHT, -2, 1 },   { 0, KIRI_UNIT_KNIGHT, 2, 1 },     { 0, KIRI_UNIT_KNIGHT, -1, 2 },
    { 0, KIRI_UNIT_KNIGHT, 1, 2 },
};

/* Steps touch the squares up to two rows away, in the outer rows one on each side of the column, else two. */
enum { STEP_ROWS = 2 };

static int32_t StepColumns(int32_t v)
{
    return v == -STEP_ROWS || v == STEP_ROWS ? 1 : STEP_ROWS;
}

/* True if the square is whole, and all those around that a step may touch, and their cells have their indices. */
static bool IsWholeAround(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    int32_t column = square % squares->columns, row = square / squares->columns;
    if (column < STEP_ROWS || column >= squares->columns - STEP_ROWS || row < STEP_ROWS ||
        row >= squares->rows - STEP_ROWS) {
        return false;
    }
    for (int32_t v = -STEP_ROWS; v <= STEP_ROWS; ++v) {
        int32_t middle = square + v * squares->columns;
        for (int32_t s = middle - StepColumns(v); s <= middle + StepColumns(v); ++s) {
            if (!grid->whole.data[s] || grid->squareCell.data[s] != s) {
                return false;
            }
        }
    }
    return true;
}

/* Lists the cells from which a step may touch a square where a face came or went. */
static void SpreadDirty(kiriGrid* grid, int32_t item)
{
    const kiriMeshData* mesh = grid->mesh;
    const kiriSquares* squares = &mesh->squares;
    KIRI_ASSERT(item >= 0 && item < grid->work->linksDirty.count && !grid->work->fromScratch);
    int32_t center = grid->work->linksDirty.data[item];
    int32_t column = center % squares->columns, row = center / squares->columns;
    for (int32_t v = kiriMax(-STEP_ROWS, -row); v <= STEP_ROWS && row + v < squares->rows; ++v) {
        int32_t reach = StepColumns(v);
        for (int32_t u = kiriMax(-reach, -column); u <= reach && column + u < squares->columns; ++u) {
            int32_t square = center + v * squares->columns + u;
            bool isNew = FlagSquare(grid, square, SQUARE_STEPS_DIRTY, NULL);
            for (int32_t c = grid->squareCell.data[square]; isNew && c != KIRI_NONE; c = grid->cells.data[c].next) {
                AppendIndex(grid, &grid->work->stepsDirty, c);
            }
        }
    }
    grid->work->debt += COST_OF_STEPS;
}

static void AddStep(kiriGrid* grid, kiriStep step)
{
    bool ok = kiriArray_Push(grid->mesh->memory, &grid->work->steps, step);
    grid->work->outOfMemory = grid->work->outOfMemory || !ok;
}

static void AddSteps(kiriGrid* grid, const kiriSteps* steps, int32_t from, int32_t end)
{
    KIRI_ASSERT(0 <= from && from <= end && end <= steps->end[2]);
    KIRI_FROM_TO(s, from, end) {
        AddStep(grid, kiriSteps_At(steps, s));
    }
}

static bool AreStepsSame(const kiriSteps* a, const kiriSteps* b)
{
    bool same = a->end[0] == b->end[0] && a->end[1] == b->end[1] && a->end[2] == b->end[2];
    KIRI_TIMES_WHILE(same, s, a->end[2]) {
        same = kiriSteps_At(a, s).cell == kiriSteps_At(b, s).cell;
    }
    return same;
}

/* Replaces the steps of a cell by those in `work`: straight ones to `straight`, diagonal ones to `near`. */
static void SetSteps(kiriGrid* grid, int32_t c, int32_t straight, int32_t near)
{
    int32_t count = grid->work->steps.count;
    kiriSteps has = kiriGrid_GetSteps(grid, c), is = { grid->work->steps.data, 0, { straight, near, count } };
    KIRI_ASSERT(kiriGrid_IsCell(grid, c) && 0 <= straight && straight <= near && near <= count);
    if (AreStepsSame(&has, &is)) {
        return;
    }
    if (!ResizeSteps(grid, c, count)) {
        grid->work->outOfMemory = true;
        return;
    }
    kiriStepRun* run = &grid->runs.data[c];
    if (count > 0) {
        memcpy(&grid->steps.data[run->first], is.data, sizeof(kiriStep) * count);
    }
    run->end[0] = run->first + straight;
    run->end[1] = run->first + near;
    RecordCell(grid, c, CELL_STEPS, &grid->changes.steps);
}

/* Compares two steps from the same cell: the way tells the order of squares. */
static bool IsStepBefore(const kiriGrid* grid, kiriStep a, kiriStep b)
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
    KIRI_FROM_TO(i, from + 1, grid->work->steps.count) {
        kiriStep step = steps[i];
        int32_t j = i;
        for (; j > from && IsStepBefore(grid, step, steps[j - 1]); --j) {
            steps[j] = steps[j - 1];
        }
        steps[j] = step;
    }
}

static kiriStep StraightStep(const kiriFace* face, int32_t from)
{
    int8_t way = face->cell[0] == from ? 1 : -1;
    int32_t axis = kiriFace_Axis(face);
    return (kiriStep){ kiriFace_Other(face, from), KIRI_UNIT, axis == 0 ? way : 0, axis == 1 ? way : 0 };
}

static kiriStep JoinedStep(kiriStep a, kiriStep b, int16_t length)
{
    KIRI_ASSERT(length > a.length && length > b.length);
    return (kiriStep){ b.cell, length, (int8_t)(a.u + b.u), (int8_t)(a.v + b.v) };
}

/* A step counts where two ways lead to its cell, and counts once: the first way marks the cell with the number that
   this returns, the second way finds it and makes it one more. */
static int32_t NewMark(kiriGridWork* work)
{
    if (work->lastMark > INT32_MAX - 4) { /* rare: a thousand large cuts */
        kiriArray_Set(&work->mark, 0);
        work->lastMark = 0;
    }
    work->lastMark += 2;
    return work->lastMark;
}

/* Adds steps to cells reached along u, then v, and also along v, then u: both ways around the corner. */
static void AddDiagonalSteps(kiriGrid* grid, int32_t c)
{
    const kiriFace* faces = grid->faces.data;
    const kiriCell* cells = grid->cells.data;
    int32_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    KIRI_ASSERT(grid->work->mark.count == grid->cells.count);
    KIRI_TIMES(axis, 2) {
        for (int32_t f = cells[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&faces[f], c)) {
            int32_t between = kiriFace_Other(&faces[f], c);
            int32_t g = kiriFace_Axis(&faces[f]) == axis ? cells[between].firstFace : KIRI_NONE;
            for (; g != KIRI_NONE; g = kiriFace_Next(&faces[g], between)) {
                grid->work->debt += COST_OF_WAY;
                if (kiriFace_Axis(&faces[g]) == axis) {
                    continue;
                }
                kiriStep step =
                    JoinedStep(StraightStep(&faces[f], c), StraightStep(&faces[g], between), KIRI_UNIT_DIAGONAL);
                if (axis == 0) {
                    mark[step.cell] = first;
                } else if (mark[step.cell] == first) {
                    mark[step.cell] = first + 1;
                    AddStep(grid, step);
                }
            }
        }
    }
}

/* Makes a cell's straight and diagonal steps, or opens it amid whole squares. Its old knights stay until all diagonal
   steps are made. */
static void MakeNearSteps(kiriGrid* grid, int32_t item)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    int32_t c = work->fromScratch ? item : work->stepsDirty.data[item];
    KIRI_ASSERT(work->fromScratch || kiriGrid_IsCell(grid, c));
    if (!kiriGrid_IsCell(grid, c)) {
        return; /* a square without material */
    }
    work->debt += COST_OF_STEPS;
    if (IsWholeAround(grid, &mesh->squares, grid->cells.data[c].square)) {
        if (!kiriStepRun_IsOpen(&grid->runs.data[c])) {
            /* The cell becomes open. If it was, its steps are the same: a square that stays whole keeps its cell. */
            kiriSteps had = kiriGrid_GetSteps(grid, c), has = kiriGrid_OpenSteps(grid, c);
            KIRI_ASSERT(kiriGrid_IsCell(grid, c) && grid->whole.data[grid->cells.data[c].square]);
            if (!AreStepsSame(&had, &has)) {
                RecordCell(grid, c, CELL_STEPS, &grid->changes.steps);
            }
            ResizeSteps(grid, c, 0);
            grid->runs.data[c].first = KIRI_NONE;
            grid->whole.data[c] = KIRI_SQUARE_OPEN;
        }
        return;
    }
    work->steps.count = 0;
    KIRI_EACH_FACE(f, grid, c) {
        AddStep(grid, StraightStep(&grid->faces.data[f], c));
    }
    int32_t straight = work->steps.count;
    AddDiagonalSteps(grid, c);
    int32_t near = work->steps.count;
    SortSteps(grid, 0);
    kiriSteps has = kiriGrid_GetSteps(grid, c);
    AddSteps(grid, &has, has.end[1], has.end[2]);
    SetSteps(grid, c, straight, near);
    AppendIndex(grid, &work->knightsDirty, c);
}

/* Adds steps to cells reached straight, then diagonally, and also diagonally, then straight: a slit is never jumped. */
static void AddKnightSteps(kiriGrid* grid, const kiriSteps* steps)
{
    int32_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    KIRI_TIMES(i, steps->end[1]) {
        kiriStep to = kiriSteps_At(steps, i);
        bool isStraight = i < steps->end[0];
        kiriSteps on = kiriGrid_GetSteps(grid, to.cell);
        KIRI_FROM_TO(j, isStraight ? on.end[0] : 0, on.end[isStraight]) {
            kiriStep next = kiriSteps_At(&on, j);
            if (!isStraight && mark[next.cell] == first) {
                mark[next.cell] = first + 1;
                AddStep(grid, JoinedStep(to, next, KIRI_UNIT_KNIGHT));
            } else if (isStraight && (to.u == next.u || to.v == next.v)) {
                mark[next.cell] = first;
            }
        }
        grid->work->debt += isStraight ? on.end[1] - on.end[0] : 0;
    }
}

static void MakeKnightSteps(kiriGrid* grid, int32_t item)
{
    KIRI_ASSERT_HAS(grid->work->knightsDirty, item);
    int32_t c = grid->work->knightsDirty.data[item];
    kiriSteps has = kiriGrid_GetSteps(grid, c);
    grid->work->debt += COST_OF_STEPS;
    grid->work->steps.count = 0;
    AddSteps(grid, &has, 0, has.end[1]);
    AddKnightSteps(grid, &has);
    SortSteps(grid, has.end[1]);
    SetSteps(grid, c, has.end[0], has.end[1]);
}

/* ---- What an update changes -------------------------------------------------------------------------------------- */

static void FreeCell(kiriGrid* grid, int32_t c)
{
    KIRI_ASSERT(!kiriGrid_IsCell(grid, c));
    DropMaterial(grid, c);
    grid->cells.data[c].next = grid->freeCell;
    grid->freeCell = c;
}

static void KeepCellsInUse(kiriGrid* grid, kiriIndices* list)
{
    grid->work->debt += COST_OF_NODE * (int64_t)list->count;
    KIRI_KEEP_IF(const int32_t, cell, *list, kiriGrid_IsCell(grid, *cell));
}

/* Takes removed cells out of the other lists. Those that were made and removed since ClearChanges leave no trace. */
static void ForgetRemoved(kiriGrid* grid, int32_t item)
{
    kiriGridChanges* changes = &grid->changes;
    int32_t count = 0;
    (void)grid->mesh;
    (void)item;
    KIRI_EACH(const kiriMaterialChange, at, changes->material) {
        const kiriMaterialChange change = *at;
        if (kiriGrid_IsCell(grid, change.cell)) {
            changes->material.data[count++] = change;
        } else {
            KIRI_ASSERT(grid->cells.data[change.cell].material != KIRI_NONE);
            grid->materials.data[grid->cells.data[change.cell].material] = change.was;
        }
    }
    grid->work->debt += COST_OF_NODE * (int64_t)changes->material.count;
    changes->material.count = count;
    KIRI_EACH_LISTED(cell, changes->made) {
        if (!kiriGrid_IsCell(grid, cell)) {
            FreeCell(grid, cell);
        }
    }
    KeepCellsInUse(grid, &changes->made);
    KeepCellsInUse(grid, &changes->steps);
    KeepCellsInUse(grid, &changes->edges);
}

/* ---- The update -------------------------------------------------------------------------------------------------- */

/* Stages of algorithm 3, each over the items of a list. Faces need all cells, diagonal steps need all faces, and
   knight's moves need all diagonal steps. */
typedef void GridStageFn(kiriGrid* grid, int32_t item);
enum { GRID_STAGES = 6 };
static GridStageFn* const gridStages[GRID_STAGES] = {
    MakeCells,       /* of dirty squares */
    MakeFaces,       /* of squares with new cells */
    SpreadDirty,     /* from squares where a face came or went, to the cells whose steps may use it */
    MakeNearSteps,   /* of these cells, */
    MakeKnightSteps, /* and those that are not amid whole squares */
    ForgetRemoved,   /* in the lists of changes */
};

/* Makes a cell a square, not in use yet. Cells of squares without material are free for other squares. Reserving adds
   an eighth for what cuts make. */
static bool MakeUnusedCells(kiriGrid* grid)
{
    kiriGridWork* work = grid->work;
    kiriMemory* memory = grid->mesh->memory;
    int32_t squares = grid->squareCell.count;
    int64_t cells = squares + 64, made = 64;
    if (!kiriArrays_Reserve(memory, cells, &grid->cells, &grid->runs, &work->cellFlags, &work->mark)) {
        return false;
    }
    grid->cells.count = grid->runs.count = work->cellFlags.count = work->mark.count = squares;
    kiriArray_Set(&grid->runs, 0);
    kiriArray_Set(&work->mark, 0);
    for (int32_t s = squares - 1; s >= 0; --s) {
        bool isFree = grid->mesh->squares.head[s] == KIRI_NONE;
        grid->cells.data[s] = (kiriCell){ KIRI_NONE, grid->freeCell, KIRI_NONE, KIRI_NONE, KIRI_NONE };
        grid->freeCell = isFree ? s : grid->freeCell;
        made += !isFree;
    }
    return kiriArrays_Reserve(memory, made, &grid->changes.made, &grid->changes.steps) &&
           kiriArray_Reserve(memory, &grid->faces, 2 * made);
}

/* Starts the first update, or one after a reset: no square has a cell, and all squares are dirty. */
static bool StartFromScratch(kiriGrid* grid)
{
    const kiriMeshData* mesh = grid->mesh;
    kiriGridWork* work = grid->work;
    int32_t squareCount = mesh->squares.columns * mesh->squares.rows;
    if (!kiriArray_ResizeJust(mesh->memory, &grid->squareCell, squareCount) ||
        !kiriArray_ResizeJust(mesh->memory, &grid->whole, squareCount) ||
        !kiriArray_ResizeJust(mesh->memory, &work->squareFlags, squareCount) ||
        !kiriArray_ResizeJust(mesh->memory, &work->ranges, squareCount)) {
        return false;
    }
    kiriArray_Set(&grid->whole, 0);
    kiriArray_Set(&work->squareFlags, 0);
    kiriArray_Set(&grid->squareCell, KIRI_NONE);
    KIRI_TIMES(k, KIRI_OPEN_STEPS) {
        grid->openSteps[k] = openSteps[k];
        grid->openSteps[k].cell = openSteps[k].v * mesh->squares.columns + openSteps[k].u;
    }
    grid->side = mesh->step * mesh->squares.side;
    grid->freeCell = grid->freeFace = KIRI_NONE;
    return MakeUnusedCells(grid);
}

static bool StartGridUpdate(kiriGrid* grid)
{
    const kiriMeshData* mesh = grid->mesh;
    if (grid->work == NULL) {
        grid->work = kiriMemory_AllocZeroed(mesh->memory, sizeof(*grid->work));
    }
    if (grid->work == NULL) {
        return false;
    }
    grid->work->fromScratch = grid->squareCell.count == 0;
    grid->work->running = true;
    return (!grid->work->fromScratch || StartFromScratch(grid)) &&
           kiriArray_ReserveJust(mesh->memory, &grid->nodeCell, mesh->squares.nodes.capacity) &&
           kiriArray_Resize(mesh->memory, &grid->nodeCell, mesh->squares.nodes.count) &&
           kiriArray_ReserveJust(mesh->memory, &grid->vertexCell, mesh->vertices.capacity) &&
           kiriArray_Resize(mesh->memory, &grid->vertexCell, mesh->vertices.count);
}

/* Ends an update that is done, or given up. */
static void EndGridUpdate(kiriGridWork* work)
{
    KIRI_ASSERT(work->flagged.count <= work->squareFlags.count);
    KIRI_EACH_LISTED(square, work->flagged) {
        work->squareFlags.data[square] = 0;
    }
    work->flagged.count = work->facesDirty.count = work->linksDirty.count = work->stepsDirty.count = 0;
    work->knightsDirty.count = work->entries.count = 0;
    work->debt = work->stage = work->item = 0;
    work->running = work->hasRemoved = work->outOfMemory = false;
}

static bool PayForGrid(kiriGridWork* work, kiriQuota* quota)
{
    int64_t items = work->debt / PARTS_AN_ITEM, rest = work->debt % PARTS_AN_ITEM;
    KIRI_ASSERT(work->debt >= 0);
    bool isPaid = kiriQuota_Pay(quota, &items);
    work->debt = PARTS_AN_ITEM * items + rest;
    return isPaid;
}

kiriProgress kiriGrid_Update(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota)
{
    grid->mesh = mesh;
    if ((grid->work == NULL || !grid->work->running) && !StartGridUpdate(grid)) {
        return KIRI_FAILED;
    }
    kiriGridWork* work = grid->work;
    KIRI_ASSERT(grid->nodeCell.count == mesh->squares.nodes.count); /* else the mesh has changed during the update */
    for (; work->stage < GRID_STAGES; ++work->stage, work->item = 0) {
        const int32_t counts[GRID_STAGES] = { work->fromScratch ? grid->squareCell.count : mesh->squares.dirty.count,
                                              work->facesDirty.count,
                                              work->linksDirty.count,
                                              work->fromScratch ? grid->cells.count : work->stepsDirty.count,
                                              work->knightsDirty.count,
                                              work->hasRemoved };
        KIRI_ASSERT(work->item <= counts[work->stage]);
        for (; work->item < counts[work->stage]; ++work->item) {
            if (kiriMemory_MustPause(mesh->memory) || !PayForGrid(work, quota)) {
                return KIRI_MORE;
            }
            gridStages[work->stage](grid, work->item);
            if (work->outOfMemory) {
                return KIRI_FAILED;
            }
        }
    }
    if (!PayForGrid(work, quota)) {
        return KIRI_MORE;
    }
    EndGridUpdate(work);
    return KIRI_DONE;
}

void kiriGrid_ClearChanges(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    KIRI_ASSERT(grid->work == NULL || !grid->work->running);
    KIRI_EACH_LISTED(cell, changes->gone) {
        FreeCell(grid, cell);
    }
    KIRI_EACH_LISTED(cell, changes->steps) {
        grid->work->cellFlags.data[cell] = 0;
    }
    KIRI_EACH(const kiriMaterialChange, change, changes->material) {
        grid->work->cellFlags.data[change->cell] = 0;
    }
    KIRI_EACH_LISTED(cell, changes->edges) {
        grid->work->cellFlags.data[cell] = 0;
    }
    changes->made.count = changes->gone.count = changes->steps.count = changes->material.count = 0;
    changes->edges.count = 0;
}

void kiriGrid_HashProgress(const kiriGrid* grid, uint64_t* hash)
{
    const kiriGridWork* work = grid->work;
    if (work != NULL && work->running) {
        kiriHash_Int64(hash, work->debt);
        kiriHash_Pair(hash, work->stage, work->item);
    }
}

void kiriGrid_DropScratch(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    kiriGridWork* work = grid->work;
    KIRI_ASSERT(!work->running && changes->made.count == 0 && changes->edges.count == 0);
    kiriIndices* const lists[] = { &changes->made,    &changes->steps,     &changes->edges, &work->facesDirty,
                                   &work->linksDirty, &work->stepsDirty,   &work->flagged,  &work->entries,
                                   &work->parent,     &work->knightsDirty };
    for (size_t k = 0; k < sizeof(lists) / sizeof(lists[0]); ++k) {
        kiriArray_Release(grid->mesh->memory, lists[k]);
    }
    kiriArray_Shorten(grid->mesh->memory, &grid->steps, sizeof(*grid->steps.data));
}

void kiriGrid_Reset(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    grid->cells.count = grid->runs.count = grid->steps.count = grid->faces.count = grid->squareCell.count = 0;
    grid->nodeCell.count = grid->vertexCell.count = grid->whole.count = grid->cellCount = 0;
    grid->materials.count = grid->stretches.count = grid->unusedMaterials.count = grid->unusedStretches.count = 0;
    changes->made.count = changes->gone.count = changes->steps.count = changes->material.count = 0;
    changes->edges.count = 0;
    KIRI_CLEAR(&grid->stepRoom);
    if (grid->work != NULL) {
        grid->work->cellFlags.count = grid->work->mark.count = 0;
        EndGridUpdate(grid->work);
    }
}

void kiriGrid_Keep(kiriGrid* grid, const kiriKeep* triangles, const kiriKeep* vertices, const int32_t* gone,
                   int32_t goneCount)
{
    KIRI_ASSERT(!grid->work->running && grid->changes.steps.count == 0 && grid->changes.gone.count == 0);
    KIRI_TIMES(k, goneCount) {
        KIRI_ASSERT(kiriGrid_IsCell(grid, gone[k]));
        kiriCell* cell = &grid->cells.data[gone[k]];
        int32_t* link = &grid->squareCell.data[cell->square];
        while (*link != gone[k]) {
            KIRI_ASSERT(*link != KIRI_NONE);
            link = &grid->cells.data[*link].next;
        }
        *link = cell->next;
        while (cell->firstFace != KIRI_NONE) {
            RemoveFace(grid, cell->firstFace);
        }
        ResizeSteps(grid, gone[k], 0);
        grid->whole.data[cell->square] = 0; /* a square with another cell was not whole either */
        cell->square = KIRI_NONE;
        --grid->cellCount;
        FreeCell(grid, gone[k]);
    }
    kiriKeep_Compact(vertices, &grid->vertexCell, 1, sizeof(int32_t));
    KIRI_EACH_INDEX_WHILE(kiriKeep_Moves(triangles), c, grid->cells) {
        if (kiriGrid_IsCell(grid, c)) {
            grid->cells.data[c].triangle = kiriKeep_To(triangles, grid->cells.data[c].triangle);
        }
    }
}

/* ---- Queries ----------------------------------------------------------------------------------------------------- */

static bool IsCellBefore(const void* grid, int32_t a, int32_t b)
{
    return kiriGrid_IsBefore(grid, a, b);
}

void kiriGrid_SortCells(const kiriGrid* grid, int32_t* cells, int32_t count)
{
    kiriSort(cells, count, IsCellBefore, grid);
}

int32_t kiriGrid_CellOf(const kiriGrid* grid, int32_t triangle, kiriLatticePoint at)
{
    const kiriMeshData* mesh = grid->mesh;
    int32_t square = kiriSquares_At(&mesh->squares, at);
    int32_t node = square == KIRI_NONE ? KIRI_NONE : mesh->squares.head[square];
    while (node != KIRI_NONE && mesh->squares.nodes.data[node].triangle != triangle) {
        node = mesh->squares.nodes.data[node].next;
    }
    KIRI_ASSERT(node < grid->nodeCell.count);
    return node == KIRI_NONE ? KIRI_NONE : grid->nodeCell.data[node];
}

int32_t kiriGrid_CellOfVertex(const kiriGrid* grid, int32_t vertex)
{
    int32_t square = kiriSquares_At(&grid->mesh->squares, kiriMesh_At(grid->mesh, vertex)),
            first = grid->squareCell.data[square];
    KIRI_ASSERT(vertex < grid->vertexCell.count);
    return grid->cells.data[first].next == KIRI_NONE ? first : grid->vertexCell.data[vertex];
}

kiriVec2 kiriGrid_Middle(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    kiriVec2 corner =
        kiriMesh_Local(grid->mesh, kiriSquares_Corner(&grid->mesh->squares, grid->cells.data[cell].square));
    return kiriVec2_Add(corner, kiriVec2_Make(0.5 * grid->side, 0.5 * grid->side));
}

kiriLatticePoint kiriGrid_Anchor(const kiriGrid* grid, int32_t cell)
{
    const kiriMeshData* mesh = grid->mesh;
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    kiriMoments largest = { 0 };
    int32_t square = grid->cells.data[cell].square, lowest = INT32_MAX;
    KIRI_EACH_NODE(n, &mesh->squares, square) {
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
                                                  : kiriGrid_Middle(grid, cell));
}

int32_t kiriGrid_CellAt(const kiriGrid* grid, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(grid->mesh, at);
    return triangle == KIRI_NONE ? KIRI_NONE : kiriGrid_CellOf(grid, triangle, at);
}

int32_t kiriGrid_CellAround(const kiriGrid* grid, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&grid->mesh->squares, at);
    int32_t first = square == KIRI_NONE ? KIRI_NONE : grid->squareCell.data[square];
    if (first == KIRI_NONE || grid->cells.data[first].next == KIRI_NONE) {
        return first;
    }
    int32_t cell = kiriGrid_CellAt(grid, at);
    return cell == KIRI_NONE ? first : cell;
}

void kiriGrid_JoinCells(const kiriGrid* grid, int32_t* parent)
{
    KIRI_ASSERT(grid->runs.count == grid->cells.count);
    kiriUnion_Init(parent, grid->cells.count);
    KIRI_EACH_INDEX(c, grid->cells) {
        if (kiriGrid_IsCell(grid, c)) {
            KIRI_EACH_STEP(step, grid, c, KIRI_STRAIGHT) {
                kiriUnion_Join(parent, c, step.cell);
            }
        }
    }
}

/* ---- Cells on borders -------------------------------------------------------------------------------------------- */

bool kiriBorderCells_Resize(kiriBorderCells* lists, kiriMemory* memory, int32_t cellCount, int32_t regionCount)
{
    const kiriBorderCell none = { KIRI_NONE, KIRI_NONE, KIRI_NONE };
    if (!kiriArray_Reserve(memory, &lists->cells, cellCount) ||
        !kiriArray_Reserve(memory, &lists->first, regionCount)) {
        return false;
    }
    while (lists->cells.count < cellCount) {
        KIRI_NEXT(lists->cells) = none;
    }
    while (lists->first.count < regionCount) {
        KIRI_NEXT(lists->first) = KIRI_NONE;
    }
    return true;
}

void kiriBorderCells_Put(kiriBorderCells* lists, int32_t cell, int32_t region)
{
    KIRI_ASSERT(cell >= 0 && cell < lists->cells.count && region >= KIRI_NONE && region < lists->first.count);
    kiriBorderCell* at = &lists->cells.data[cell];
    if (at->region == region) {
        return;
    }
    if (at->region != KIRI_NONE) {
        KIRI_ASSERT(at->before != KIRI_NONE || lists->first.data[at->region] == cell);
        *(at->before == KIRI_NONE ? &lists->first.data[at->region] : &lists->cells.data[at->before].next) = at->next;
        if (at->next != KIRI_NONE) {
            lists->cells.data[at->next].before = at->before;
        }
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
    KIRI_EACH_WHILE(kiriKeep_Moves(regions), kiriBorderCell, cell, lists->cells) {
        if (cell->region >= first) {
            cell->region = to[cell->region];
            KIRI_ASSERT(cell->region != KIRI_NONE);
        }
    }
    kiriKeep_Compact(regions, &lists->first, 1, sizeof(int32_t));
}

void kiriBorderCells_Reset(kiriBorderCells* lists)
{
    lists->first.count = lists->cells.count = 0;
}
