#include "kiri_field_check.h"
#include "kiri_grid_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust IsCellIndex[] = { KIRI_INDEX(KIRI_OF_CELLS, kiriSpan, first, first) };
static const kiriMust IsSquareIndex[] = { KIRI_INDEX(KIRI_OF_SQUARES, kiriSpan, first, first) };
static const kiriMust IsCellOrNone[] = { KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriSpan, first, first) };

static const kiriMust CellMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_SQUARES, kiriCell, square, square),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriCell, next, next),
    KIRI_INDEX_OR_NONE(KIRI_OF_FACES, kiriCell, firstFace, firstFace),
};

static const kiriMust FaceMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriFace, cell, cell),
    KIRI_INDEX_OR_NONE(KIRI_OF_FACES, kiriFace, next, next),
};

static const kiriMust MaterialChangeMust[] = {
    KIRI_INDEX(KIRI_OF_CELLS, kiriMaterialChange, cell, cell),
    KIRI_REALS(kiriMaterialChange, was, was),
};

static const kiriMust NewCellMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_TRIANGLES, kiriNewCell, triangle, triangle),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriNewCell, cell, cell),
    KIRI_REALS(kiriNewCell, material, material),
};

static const kiriMust OldFaceMust[] = {
    KIRI_INDEX(KIRI_OF_FACES, kiriOldFace, face, face),
    KIRI_REALS(kiriOldFace, was, was),
};

enum { LAST_STAGE = 6, LAST_PART = 4 };

static const kiriMust WorkMust[] = {
    KIRI_COUNTS(kiriGridWork, due, due),
    KIRI_WITHIN(0, LAST_STAGE, kiriGridWork, stage, stage),
    KIRI_WITHIN(0, INT32_MAX, kiriGridWork, item, item),
    KIRI_WITHIN(0, LAST_PART, kiriGridWork, part, part),
    KIRI_ITEMS_MUST(kiriGridWork, facesDirty, IsSquareIndex),
    KIRI_ITEMS_MUST(kiriGridWork, linksDirty, IsSquareIndex),
    KIRI_ITEMS_MUST(kiriGridWork, stepsDirty, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGridWork, knightsDirty, IsCellIndex),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGridWork, squareFlags),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGridWork, ranges),
    KIRI_ITEMS_MUST(kiriGridWork, flagged, IsSquareIndex),
    KIRI_LENGTH(KIRI_OF_CELLS, kiriGridWork, cellFlags),
    KIRI_LENGTH(KIRI_OF_CELLS, kiriGridWork, mark),
    KIRI_WITHIN(0, INT32_MAX, kiriGridWork, lastMark, lastMark),
};

/* While an update is at hand: what rests has whatever the last one left there. */
static const kiriMust RunningMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_NODES, kiriGridWork, node, node),
    KIRI_WITHIN(0, INT32_MAX / 2, kiriGridWork, at, other),
};

static const kiriMust AmidCellsMust[] = {
    KIRI_ITEMS_MUST(kiriGridWork, newCells, NewCellMust),
};

static const kiriMust AmidFacesMust[] = {
    KIRI_ITEMS_MUST(kiriGridWork, oldFaces, OldFaceMust),
};

static const kiriMust GridMust[] = {
    KIRI_REALS(kiriGrid, side, side),
    KIRI_ITEMS_MUST(kiriGrid, cells, CellMust),
    KIRI_LENGTH(KIRI_OF_CELLS, kiriGrid, runs),
    KIRI_ITEMS_MUST(kiriGrid, faces, FaceMust),
    KIRI_ITEMS_MUST(kiriGrid, squareCell, IsCellOrNone),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGrid, squareCell),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGrid, whole),
    KIRI_ITEMS_MUST(kiriGrid, changes.made, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGrid, changes.gone, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGrid, changes.steps, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGrid, changes.material, MaterialChangeMust),
    KIRI_ITEMS_MUST(kiriGrid, changes.edges, IsCellIndex),
    KIRI_OWNED_MUST(kiriGrid, work, WorkMust),
};

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

/* Of a part of a square: sums of it hold. */
static bool IsMaterial(const kiriMoments* m, double side, double farthest)
{
    double area = m->area, most = area * farthest, mostOfSquares = most * farthest;
    return area >= 0.0 && area <= 1.01 * side * side && fabs(m->u) <= most && fabs(m->v) <= most &&
           fabs(m->uu) <= mostOfSquares && fabs(m->uv) <= mostOfSquares && fabs(m->vv) <= mostOfSquares;
}

/* While it is being summed. */
static bool IsPartOfMaterial(const kiriMoments* m, double side, double farthest)
{
    double most = 1.01 * side * side, mostOfSquares = most * farthest * farthest;
    return fabs(m->area) <= most && fabs(m->u) <= most * farthest && fabs(m->v) <= most * farthest &&
           fabs(m->uu) <= mostOfSquares && fabs(m->uv) <= mostOfSquares && fabs(m->vv) <= mostOfSquares;
}

static bool AreMaterials(const kiriGrid* grid, const kiriMeshData* mesh)
{
    double farthest = 2.0 * KIRI_LATTICE * mesh->step;
    bool areFine = grid->side == mesh->step * mesh->squares.side;
    for (int32_t c = 0; areFine && c < grid->cells.count; ++c) {
        int32_t own = grid->cells.data[c].material;
        areFine = own == KIRI_NONE || (IsMaterial(&grid->materials.data[own], grid->side, farthest) &&
                                       (grid->materials.data[own].area > 0.0 || !kiriGrid_IsCell(grid, c)));
    }
    for (int32_t k = 0; areFine && kiriGrid_IsAtWork(grid) && k < grid->work->newCells.count; ++k) {
        areFine = IsPartOfMaterial(&grid->work->newCells.data[k].material, grid->side, farthest);
    }
    for (int32_t k = 0; areFine && k < grid->changes.material.count; ++k) {
        areFine = IsMaterial(&grid->changes.material.data[k].was, grid->side, farthest);
    }
    return areFine;
}

/* Cells that are gone are in no list yet: nobody may get their index. */
static bool TakeGone(kiriCheck* check, const kiriGrid* grid, kiriChains* chains, int32_t cell)
{
    bool isFine = kiriCheck_That(check, !kiriGrid_IsCell(grid, cell) && !chains->seen[cell]);
    chains->seen[cell] = 1;
    chains->listed += 1;
    return isFine;
}

/* The last stage of an update takes cells that are gone out of the list of those that were made: some of it is old. */
static bool IsOldChange(const kiriGrid* grid, int32_t k)
{
    const kiriGridWork* work = grid->work;
    return work != NULL && work->running && work->stage == LAST_STAGE - 1 && work->item == 3 && k >= work->other &&
           k < work->at;
}

static bool AreGone(kiriCheck* check, const kiriGrid* grid, kiriChains* chains)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < grid->changes.gone.count; ++k) {
        areFine = TakeGone(check, grid, chains, grid->changes.gone.data[k]);
    }
    for (int32_t k = 0; areFine && k < grid->changes.made.count; ++k) {
        int32_t cell = grid->changes.made.data[k];
        areFine = kiriGrid_IsCell(grid, cell) || IsOldChange(grid, k) || TakeGone(check, grid, chains, cell);
    }
    return areFine;
}

/* The cells of a square; a whole one has one. */
static bool AreCellsOf(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh, kiriChains* chains,
                       int32_t square)
{
    int32_t first = grid->squareCell.data[square];
    bool areFine = kiriCheck_Chain(check, chains, first);
    for (int32_t c = first; areFine && c != KIRI_NONE; c = grid->cells.data[c].next) {
        int32_t triangle = grid->cells.data[c].triangle;
        areFine = kiriCheck_That(check, grid->cells.data[c].square == square && triangle >= 0 &&
                                            triangle < mesh->triangles.count && kiriMesh_IsTriangle(mesh, triangle));
    }
    return areFine && kiriCheck_That(check, !grid->whole.data[square] ||
                                                (first != KIRI_NONE && grid->cells.data[first].next == KIRI_NONE));
}

/* Each cell is of its square, or free, or gone. */
static bool AreCellsSound(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriChains chains;
    bool areFine = kiriCheck_StartChains(check, &chains, &grid->cells.data->next, sizeof(kiriCell), grid->cells.count);
    for (int32_t s = 0; areFine && s < grid->squareCell.count; ++s) {
        areFine = AreCellsOf(check, grid, mesh, &chains, s);
    }
    areFine = areFine && kiriCheck_That(check, chains.listed == grid->cellCount && grid->freeCell >= KIRI_NONE &&
                                                   grid->freeCell < grid->cells.count);
    for (int32_t c = grid->freeCell; areFine && c != KIRI_NONE; c = grid->cells.data[c].next) {
        areFine = TakeGone(check, grid, &chains, c);
    }
    areFine = areFine && AreGone(check, grid, &chains) && kiriCheck_That(check, chains.listed == grid->cells.count);
    kiriMemory_Free(&check->memory, chains.seen);
    return areFine;
}

/* ---- Faces ------------------------------------------------------------------------------------------------------- */

/* Of two cells that live, in squares beside each other. Those of the side at hand are empty until they are added up. */
static bool IsFace(const kiriGrid* grid, const kiriSquareRows* rows, const kiriFace* face)
{
    bool mayBeEmpty = grid->work->running && grid->work->isMerging;
    double width = kiriFace_HasOwnStretch(face) ? grid->stretches.data[face->kind / 2 - 1].width : 1.0;
    if (face->cell[1] == KIRI_NONE || !(width > 0.0 || (mayBeEmpty && width == 0.0))) {
        return false;
    }
    int32_t a = grid->cells.data[face->cell[0]].square, b = grid->cells.data[face->cell[1]].square;
    int32_t axis = kiriFace_Axis(face), apart = axis == 0 ? 1 : rows->columns;
    return a != KIRI_NONE && b == a + apart && (axis == 1 || kiriSquareRows_At(rows, a) == kiriSquareRows_At(rows, b));
}

static int32_t CountFaces(const kiriGrid* grid, const kiriSquares* squares, bool* areFine)
{
    kiriSquareRows rows = kiriSquareRows_Of(squares);
    int32_t live = 0;
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        if (grid->faces.data[f].cell[0] != KIRI_NONE) {
            *areFine = *areFine && IsFace(grid, &rows, &grid->faces.data[f]);
            ++live;
        }
    }
    return live;
}

/* Faces are in the lists of both their cells, once; or free. A list that does not end has too many. */
static bool AreFaces(const kiriGrid* grid, const kiriSquares* squares)
{
    bool areFine = true;
    int64_t live = CountFaces(grid, squares, &areFine), listed = 0, unused = 0;
    for (int32_t c = 0; areFine && c < grid->cells.count; ++c) {
        int32_t f = grid->cells.data[c].square != KIRI_NONE ? grid->cells.data[c].firstFace : KIRI_NONE;
        while (areFine && f != KIRI_NONE) {
            const kiriFace* face = &grid->faces.data[f];
            areFine = face->cell[0] != KIRI_NONE && (face->cell[0] == c || face->cell[1] == c) && listed < 2 * live;
            f = face->next[face->cell[1] == c];
            ++listed;
        }
    }
    areFine = areFine && listed == 2 * live && grid->freeFace >= KIRI_NONE && grid->freeFace < grid->faces.count;
    for (int32_t f = grid->freeFace; areFine && f != KIRI_NONE; f = grid->faces.data[f].next[0]) {
        areFine = grid->faces.data[f].cell[0] == KIRI_NONE && unused < grid->faces.count;
        ++unused;
    }
    return areFine && live + unused == grid->faces.count;
}

/* ---- What the mesh has in cells ---------------------------------------------------------------------------------- */

/* Which squares the grid has not seen since they changed: those from some dirty one on. */
static int32_t FirstUnseen(const kiriGrid* grid, const kiriSquares* squares)
{
    const kiriGridWork* work = grid->work;
    return !work->running || work->fromScratch ? 0 : work->stage > 0 ? squares->dirty.count : work->item;
}

static bool AreNodesIn(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    const uint32_t count = (uint32_t)grid->cells.count;
    int32_t last = KIRI_NONE;
    for (int32_t n = squares->head[square]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
        int32_t cell = n < grid->nodeCell.count ? grid->nodeCell.data[n] : KIRI_NONE;
        if (cell == last && cell != KIRI_NONE) {
            continue;
        }
        if ((uint32_t)cell >= count || grid->cells.data[cell].square != square) {
            return false;
        }
        last = cell;
    }
    return true;
}

/* In a square with several cells. */
static bool AreVerticesIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    int32_t first = grid->squareCell.data[square];
    bool areFine = true, areSeveral = first != KIRI_NONE && grid->cells.data[first].next != KIRI_NONE;
    for (int32_t v = areSeveral ? mesh->squares.vertexHead[square] : KIRI_NONE; areFine && v != KIRI_NONE;
         v = mesh->vertices.data[v].next) {
        int32_t cell = v < grid->vertexCell.count ? grid->vertexCell.data[v] : KIRI_NONE;
        areFine = cell >= 0 && cell < grid->cells.count && grid->cells.data[cell].square == square;
    }
    return areFine;
}

/* Cells of triangles and of vertices, in all squares that the grid has seen. */
static bool AreMembers(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    const kiriGridWork* work = grid->work;
    uint8_t* isUnseen = kiriCheck_Bytes(check, grid->squareCell.count);
    bool areFine = isUnseen != NULL;
    for (int32_t k = FirstUnseen(grid, squares); areFine && k < squares->dirty.count; ++k) {
        isUnseen[squares->dirty.data[k]] = 1;
    }
    bool isScratch = work->running && work->fromScratch && work->stage == 0;
    for (int32_t s = 0; areFine && s < grid->squareCell.count; ++s) {
        bool isSeen = isScratch ? s < work->item : !isUnseen[s];
        areFine = !isSeen || (AreNodesIn(grid, squares, s) && AreVerticesIn(grid, mesh, s));
    }
    kiriMemory_Free(&check->memory, isUnseen);
    return kiriCheck_That(check, areFine);
}

/* ---- The update at hand ------------------------------------------------------------------------------------------ */

/* Where the sorting of so many items is. */
static bool IsSorting(const kiriSorting* s, int64_t count, int64_t room)
{
    int64_t middle = (int64_t)s->block + s->width;
    bool isFine = s->width >= 0 && s->block >= 0 && s->width <= count && s->block <= count;
    if (!isFine || s->width == 0 || middle >= count || s->to < s->block) {
        return isFine && s->to <= s->block;
    }
    return room >= count && s->left >= 0 && s->left <= s->width && s->right >= middle &&
           s->right <= (count - middle > s->width ? middle + s->width : count) &&
           s->to == (int64_t)s->block + s->left + (s->right - middle);
}

static bool IsCollected(const kiriGridWork* work, int32_t square)
{
    return square >= 0 && square < work->squareFlags.count &&
           (work->squareFlags.data[square] & KIRI_SQUARE_COLLECTED) != 0;
}

/* Triangles of squares, and sets of them; of the square that is being collected there are none yet. */
static bool AreEntries(const kiriGridWork* work, const kiriSquares* squares, int32_t firstOfOpen)
{
    bool areFine = work->parent.count == work->entries.count;
    for (int32_t k = 0; areFine && k < work->entries.count; ++k) {
        int32_t node = work->entries.data[k];
        areFine = node >= 0 && node < squares->nodes.count && squares->nodes.data[node].triangle != KIRI_NONE &&
                  (k >= firstOfOpen || (work->parent.data[k] >= 0 && work->parent.data[k] <= k));
    }
    return areFine;
}

/* The nodes of a square that is collected are its entries, in the order of their triangles. */
static bool IsRangeOfSquare(const kiriGridWork* work, const kiriSquares* squares, int32_t square, uint8_t* isOfSquare)
{
    kiriNodeRange range = work->ranges.data[square];
    bool isFine = range.first >= 0 && range.first <= range.end && range.end <= work->entries.count;
    int32_t left = isFine ? range.end - range.first : 0, last = KIRI_NONE;
    for (int32_t n = squares->head[square]; isFine && n != KIRI_NONE; n = squares->nodes.data[n].next) {
        isOfSquare[n] = 1;
        --left;
    }
    for (int32_t k = range.first; isFine && k < range.end; ++k) {
        int32_t node = work->entries.data[k];
        isFine =
            node >= 0 && node < squares->nodes.count && isOfSquare[node] && squares->nodes.data[node].triangle > last;
        last = isFine ? squares->nodes.data[node].triangle : last;
    }
    for (int32_t n = squares->head[square]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
        isOfSquare[n] = 0;
    }
    return isFine && left == 0;
}

static bool AreRanges(kiriCheck* check, const kiriGridWork* work, const kiriSquares* squares)
{
    uint8_t* isOfSquare = kiriCheck_Bytes(check, squares->nodes.count);
    bool areFine = isOfSquare != NULL;
    for (int32_t s = 0; areFine && s < work->ranges.count; ++s) {
        areFine = !IsCollected(work, s) || IsRangeOfSquare(work, squares, s, isOfSquare);
    }
    kiriMemory_Free(&check->memory, isOfSquare);
    return kiriCheck_That(check, areFine);
}

/* The square of the update's item in its first two stages. */
static int32_t SquareAtHand(const kiriGridWork* work, const kiriSquares* squares)
{
    if (work->stage == 0) {
        return work->fromScratch ? work->item : squares->dirty.data[work->item];
    }
    return work->facesDirty.data[work->item];
}

/* The other square of the side at hand. */
static int32_t SquareBeside(const kiriGridWork* work, const kiriSquares* squares, int32_t square)
{
    int32_t apart = work->part % 2 == 0 ? 1 : squares->columns;
    return work->part < 2 ? square - apart : square + apart;
}

/* Triangles of the square at hand have the rank of their new cell: those up to `at`, or those from there on. */
static bool AreRanks(const kiriGrid* grid, kiriNodeRange range, bool upToAt)
{
    const kiriGridWork* work = grid->work;
    int32_t from = upToAt ? range.first : range.first + work->at, end = upToAt ? range.first + work->at : range.end;
    bool areFine = work->at <= range.end - range.first;
    for (int32_t k = from; areFine && k < end; ++k) {
        int32_t rank = grid->nodeCell.data[work->entries.data[k]];
        areFine = rank >= 0 && rank < work->newCells.count;
    }
    for (int32_t k = range.first; areFine && upToAt && k < range.end; ++k) {
        areFine = work->parent.data[k] >= range.first;
    }
    return areFine;
}

static bool AreMadeCells(const kiriGrid* grid)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < grid->work->newCells.count; ++k) {
        int32_t cell = grid->work->newCells.data[k].cell;
        areFine = cell != KIRI_NONE && grid->cells.data[cell].square != KIRI_NONE;
    }
    return areFine;
}

enum { LOOK, JOIN, FIND, REPLACE, FILL };

/* Between two calls of the part at hand. */
static bool IsAmidCells(const kiriGrid* grid, const kiriSquares* squares)
{
    const kiriGridWork* work = grid->work;
    int32_t square = SquareAtHand(work, squares);
    kiriNodeRange range = work->ranges.data[square];
    if (work->part == LOOK || grid->whole.data[square]) {
        return work->part != JOIN && work->part != FIND && (work->part != FILL || grid->squareCell.data[square] >= 0);
    }
    if (work->part == JOIN) {
        return work->isCollecting || IsCollected(work, square);
    }
    bool isFine = IsCollected(work, square);
    return isFine && (work->part == FIND ? AreRanks(grid, range, true)
                                         : work->part == FILL && AreMadeCells(grid) && AreRanks(grid, range, false));
}

/* Where a walk over nodes goes on. */
static bool IsNode(const kiriGridWork* work, const kiriSquares* squares)
{
    return work->node == KIRI_NONE || squares->nodes.data[work->node].triangle != KIRI_NONE;
}

static int64_t CountItemsOf(const kiriGridWork* work, const kiriSquares* squares)
{
    const int64_t counts[LAST_STAGE + 1] = { work->fromScratch ? work->squareFlags.count : squares->dirty.count,
                                             work->facesDirty.count,
                                             work->linksDirty.count,
                                             work->stepsDirty.count,
                                             work->knightsDirty.count,
                                             4,
                                             0 };
    return counts[work->stage];
}

static bool IsCollectingRight(const kiriGridWork* work, const kiriSquares* squares, int32_t square)
{
    kiriNodeRange range = work->ranges.data[square];
    bool isFine = range.first >= 0 && range.first <= work->entries.count && IsNode(work, squares);
    return isFine &&
           (!work->isSorting || IsSorting(&work->sorting, work->entries.count - range.first, work->sortRoom.count));
}

/* Which of two squares of a side is being collected. */
static int32_t SquareToCollect(const kiriGridWork* work, const kiriSquares* squares, int32_t square)
{
    int32_t beside = SquareBeside(work, squares, square), before = square < beside ? square : beside;
    int32_t after = square < beside ? beside : square;
    return work->stage == 0 ? square : IsCollected(work, before) ? after : before;
}

static bool IsUpdate(kiriCheck* check, const kiriGrid* grid, const kiriSquares* squares)
{
    const kiriGridWork* work = grid->work;
    bool isAtSquare = work->stage < 2 && work->item < CountItemsOf(work, squares),
         isFine = AreRanges(check, work, squares);
    if (!isFine || work->item > CountItemsOf(work, squares)) {
        return false;
    }
    int32_t square = isAtSquare ? SquareAtHand(work, squares) : KIRI_NONE, open = work->entries.count;
    if (work->isCollecting) {
        int32_t collected = isAtSquare ? SquareToCollect(work, squares, square) : KIRI_NONE;
        isFine = collected >= 0 && collected < work->ranges.count && IsCollectingRight(work, squares, collected);
        open = isFine && !work->isSorting ? work->ranges.data[collected].first : open;
    }
    isFine = isFine && AreEntries(work, squares, open) && (work->stage > 0 || IsNode(work, squares));
    if (isFine && work->stage == 0 && isAtSquare && work->part > LOOK) {
        isFine = work->isAmidPart && IsAmidCells(grid, squares);
    }
    if (isFine && work->isMerging) {
        isFine = work->stage == 1 && isAtSquare && work->part < 4 && IsCollected(work, square) &&
                 IsCollected(work, SquareBeside(work, squares, square));
    }
    return isFine;
}

/* Flags say which squares are in lists already, and which have entries. */
static bool AreFlagged(kiriCheck* check, const kiriGridWork* work)
{
    uint8_t* isFlagged = kiriCheck_Bytes(check, work->squareFlags.count);
    bool areFine = isFlagged != NULL;
    for (int32_t k = 0; areFine && k < work->flagged.count; ++k) {
        isFlagged[work->flagged.data[k]] = 1;
    }
    for (int32_t s = 0; areFine && s < work->squareFlags.count; ++s) {
        areFine = work->squareFlags.data[s] == 0 || isFlagged[s];
    }
    kiriMemory_Free(&check->memory, isFlagged);
    return kiriCheck_That(check, areFine);
}

/* Rows are as long as the mesh is large. */
static bool IsRunning(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriGridWork* work = grid->work;
    return kiriCheck_Object(check, RunningMust, work) &&
           (work->stage > 0 || work->part == 0 || kiriCheck_Object(check, AmidCellsMust, work)) &&
           (!work->isMerging || kiriCheck_Object(check, AmidFacesMust, work)) &&
           kiriCheck_That(check, grid->nodeCell.count == mesh->squares.nodes.count &&
                                     grid->vertexCell.count == mesh->vertices.count) &&
           kiriCheck_That(check, IsUpdate(check, grid, &mesh->squares));
}

bool kiriGrid_Check(const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check)
{
    const kiriSquares* squares = &mesh->squares;
    check->count[KIRI_OF_CELLS] = grid->cells.count;
    check->count[KIRI_OF_FACES] = grid->faces.count;
    return kiriCheck_That(check, grid->work != NULL && grid->cells.count > 0) &&
           kiriCheck_Object(check, GridMust, grid) && kiriGrid_CheckOwn(grid, check) &&
           kiriCheck_That(check, AreMaterials(grid, mesh) && grid->nodeCell.count <= squares->nodes.count &&
                                     grid->vertexCell.count <= mesh->vertices.count) &&
           AreCellsSound(check, grid, mesh) && kiriCheck_That(check, AreFaces(grid, squares)) &&
           kiriGrid_CheckSteps(grid, squares, check) && AreFlagged(check, grid->work) &&
           AreMembers(check, grid, mesh) && (!grid->work->running || IsRunning(check, grid, mesh));
}

bool kiriGrid_CheckLeft(const kiriGrid* grid, kiriCheck* check)
{
    return grid->work == NULL || kiriCheck_Indices(check, &grid->work->flagged, grid->work->squareFlags.count);
}

bool kiriGrid_IsAtWork(const kiriGrid* grid)
{
    return grid->work != NULL && grid->work->running;
}
