/* Is the update of the grid at hand, and what updates have changed, such that the work may go on with it? */
#include "kiri_field_check.h"
#include "kiri_grid_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust IsWorkSquare[] = { KIRI_INDEX(KIRI_OF_SQUARES, kiriSpan, first, first) };
static const kiriMust IsWorkCell[] = { KIRI_INDEX(KIRI_OF_CELLS, kiriSpan, first, first) };

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

static const kiriMust GridWorkMust[] = {
    KIRI_COUNTS(kiriGridWork, due, due),
    KIRI_WITHIN(0, LAST_STAGE, kiriGridWork, stage, stage),
    KIRI_WITHIN(0, INT32_MAX, kiriGridWork, item, item),
    KIRI_WITHIN(0, LAST_PART, kiriGridWork, part, part),
    KIRI_ITEMS_MUST(kiriGridWork, facesDirty, IsWorkSquare),
    KIRI_ITEMS_MUST(kiriGridWork, linksDirty, IsWorkSquare),
    KIRI_ITEMS_MUST(kiriGridWork, stepsDirty, IsWorkCell),
    KIRI_ITEMS_MUST(kiriGridWork, knightsDirty, IsWorkCell),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGridWork, squareFlags),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGridWork, ranges),
    KIRI_ITEMS_MUST(kiriGridWork, flagged, IsWorkSquare),
    KIRI_LENGTH(KIRI_OF_CELLS, kiriGridWork, cellFlags),
    KIRI_LENGTH(KIRI_OF_CELLS, kiriGridWork, mark),
    KIRI_WITHIN(0, INT32_MAX - 1, kiriGridWork, lastMark, lastMark),
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

/* ---- What has changed ---- */

typedef struct ChangedCells {
    const void* list;
    size_t bytes; /* of a change, which begins with its cell */
    uint8_t flag;
} ChangedCells;

/* In the order in which the last stage of an update takes cells that are gone out of them. */
static ChangedCells ChangedCellsOf(const kiriGridChanges* changes, int32_t list)
{
    const ChangedCells all[KIRI_CHANGES_LISTS] = {
        { &changes->steps, sizeof(int32_t), KIRI_CELL_STEPS },
        { &changes->edges, sizeof(int32_t), KIRI_CELL_EDGES },
        { &changes->material, sizeof(kiriMaterialChange), KIRI_CELL_MATERIAL },
        { &changes->made, sizeof(int32_t), KIRI_CELL_MADE },
    };
    return all[list];
}

enum { LAST_LISTS = LAST_STAGE - 1 }; /* the stage that takes cells out of lists */

bool kiriGrid_IsForgotten(const kiriGrid* grid, int32_t list, int32_t k)
{
    const kiriGridWork* work = grid->work;
    return work->running && work->stage == LAST_LISTS && work->item == list && k >= work->other && k < work->at;
}

/* In lists that are not seen to yet, and where it is known that some are gone. */
static bool MayBeGone(const kiriGridWork* work, int32_t list, int32_t k)
{
    return work->running && work->removed &&
           (work->stage < LAST_LISTS ||
            (work->stage == LAST_LISTS && (list > work->item || (list == work->item && k >= work->at))));
}

/* The cells of a list are flagged as being there, once. */
static bool AreChanged(const kiriGrid* grid, int32_t list, uint8_t* flags)
{
    ChangedCells changed = ChangedCellsOf(&grid->changes, list);
    kiriArrayHeader changes = kiriArray_GetHeader(changed.list);
    bool areFine = true;
    for (int32_t k = 0; areFine && k < changes.count; ++k) {
        int32_t cell = *(const int32_t*)(const void*)((const char*)changes.data + changed.bytes * (size_t)k);
        if (kiriGrid_IsForgotten(grid, list, k)) {
            continue;
        }
        if (!kiriGrid_IsCell(grid, cell)) {
            areFine = MayBeGone(grid->work, list, k);
        } else {
            areFine = (flags[cell] & changed.flag) == 0;
            flags[cell] |= changed.flag;
        }
    }
    return areFine;
}

/* Flags say in which lists cells are that live. */
static bool AreChangesFlagged(kiriCheck* check, const kiriGrid* grid)
{
    uint8_t* flags = kiriCheck_Bytes(check, grid->cells.count);
    bool areFine = flags != NULL;
    for (int32_t list = 0; areFine && list < KIRI_CHANGES_LISTS; ++list) {
        areFine = AreChanged(grid, list, flags);
    }
    for (int32_t c = 0; areFine && c < grid->cells.count; ++c) {
        areFine = !kiriGrid_IsCell(grid, c) || flags[c] == grid->work->cellFlags.data[c];
    }
    kiriMemory_Free(&check->memory, flags);
    return kiriCheck_That(check, areFine);
}

/* Cells are marked with numbers that were used. */
static bool AreMarksOfGrid(const kiriGridWork* work)
{
    bool areFine = true;
    for (int32_t c = 0; areFine && c < work->mark.count; ++c) {
        areFine = work->mark.data[c] >= 0 && work->mark.data[c] <= work->lastMark + 1;
    }
    return areFine;
}

/* ---- The update at hand ------------------------------------------------------------------------------------------ */

/* While it is being summed. */
static bool IsPartOfMaterial(const kiriMoments* m, double side, double farthest)
{
    double most = 1.01 * side * side, mostOfSquares = most * farthest * farthest;
    return fabs(m->area) <= most && fabs(m->u) <= most * farthest && fabs(m->v) <= most * farthest &&
           fabs(m->uu) <= mostOfSquares && fabs(m->uv) <= mostOfSquares && fabs(m->vv) <= mostOfSquares;
}

static bool AreNewMaterials(const kiriGrid* grid, const kiriMeshData* mesh)
{
    double farthest = 2.0 * KIRI_LATTICE * mesh->step;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < grid->work->newCells.count; ++k) {
        areFine = IsPartOfMaterial(&grid->work->newCells.data[k].material, grid->side, farthest);
    }
    return areFine;
}

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

/* Entries are those of squares that are collected, up to `end`. */
static bool AreRanges(kiriCheck* check, const kiriGridWork* work, const kiriSquares* squares, int32_t end)
{
    uint8_t* isOfSquare = kiriCheck_Bytes(check, squares->nodes.count);
    bool areFine = isOfSquare != NULL;
    int64_t entries = 0;
    for (int32_t s = 0; areFine && s < work->ranges.count; ++s) {
        if (IsCollected(work, s)) {
            areFine = IsRangeOfSquare(work, squares, s, isOfSquare) && work->ranges.data[s].end <= end;
            entries += work->ranges.data[s].end - (int64_t)work->ranges.data[s].first;
        }
    }
    kiriMemory_Free(&check->memory, isOfSquare);
    return kiriCheck_That(check, areFine && entries == end);
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

static bool IsCellOfSquare(const kiriGrid* grid, int32_t cell, int32_t square)
{
    return cell >= 0 && cell < grid->cells.count && grid->cells.data[cell].square == square;
}

/* Triangles that have got their cell, and the vertices that find their fan by them. */
static bool AreFilled(const kiriGrid* grid, const kiriMeshData* mesh, kiriNodeRange range, int32_t square)
{
    const kiriGridWork* work = grid->work;
    bool areFine = true;
    for (int32_t k = range.first; areFine && k < range.first + work->at; ++k) {
        int32_t triangle = kiriGridWork_TriangleAt(work, mesh, k);
        const int32_t* corners = mesh->triangles.data[triangle].vertex;
        areFine = IsCellOfSquare(grid, grid->nodeCell.data[work->entries.data[k]], square);
        for (int i = 0; areFine && i < 3 && work->newCells.count > 1; ++i) {
            const kiriVertex* v = &mesh->vertices.data[corners[i]];
            areFine = v->edge / 3 != triangle || kiriSquares_At(&mesh->squares, v->at) != square ||
                      IsCellOfSquare(grid, grid->vertexCell.data[corners[i]], square);
        }
    }
    return areFine;
}

/* The same in a whole square, up to the node where the walk goes on. */
static bool IsWholeFilled(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    int32_t n = squares->head[square];
    while (n != KIRI_NONE && n != grid->work->node && grid->nodeCell.data[n] == grid->squareCell.data[square]) {
        n = squares->nodes.data[n].next;
    }
    return grid->squareCell.data[square] >= 0 && n == grid->work->node;
}

enum { LOOK, JOIN, FIND, REPLACE, FILL };

/* Between two calls of the part at hand. */
static bool IsAmidCells(const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriGridWork* work = grid->work;
    int32_t square = SquareAtHand(work, &mesh->squares);
    kiriNodeRange range = work->ranges.data[square];
    if (work->part == LOOK || grid->whole.data[square]) {
        return work->part != JOIN && work->part != FIND &&
               (work->part != FILL || IsWholeFilled(grid, &mesh->squares, square));
    }
    if (work->part == JOIN) {
        return work->isCollecting || IsCollected(work, square);
    }
    bool isFine = IsCollected(work, square);
    return isFine && (work->part == FIND ? AreRanks(grid, range, true)
                                         : work->part == FILL && AreMadeCells(grid) && AreRanks(grid, range, false) &&
                                               AreFilled(grid, mesh, range, square));
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

/* An entry of the square that is being collected. While two runs are merged, some of the left one are in the room of
   the sorting, and their places have others. */
static int32_t EntryAt(const kiriGridWork* work, int32_t first, int32_t k)
{
    const kiriSorting* s = &work->sorting;
    bool isMoved = work->isSorting && s->width > 0 && s->to >= s->block && k >= s->to && k < s->right;
    return isMoved ? work->sortRoom.data[s->left + k - s->to] : work->entries.data[first + k];
}

/* The nodes of the square so far, or all, each once. */
static bool AreCollected(kiriCheck* check, const kiriGridWork* work, const kiriSquares* squares, int32_t square,
                         int32_t first)
{
    uint8_t* isOfSquare = kiriCheck_Bytes(check, squares->nodes.count);
    int32_t left = work->entries.count - first, count = left, end = work->isSorting ? KIRI_NONE : work->node;
    bool areFine = isOfSquare != NULL;
    int32_t n = squares->head[square];
    for (; areFine && n != end && n != KIRI_NONE; n = squares->nodes.data[n].next) {
        isOfSquare[n] = 1;
        --left;
    }
    areFine = areFine && n == end && left == 0;
    for (int32_t k = 0; areFine && k < count; ++k) {
        int32_t node = EntryAt(work, first, k);
        areFine = node >= 0 && node < squares->nodes.count && isOfSquare[node];
        isOfSquare[areFine ? node : 0] = 0;
    }
    kiriMemory_Free(&check->memory, isOfSquare);
    return areFine;
}

static bool IsCollectingRight(kiriCheck* check, const kiriGridWork* work, const kiriSquares* squares, int32_t square)
{
    int32_t first = work->ranges.data[square].first;
    return first >= 0 && first <= work->entries.count && IsNode(work, squares) && !IsCollected(work, square) &&
           (work->stage > 0 || (work->part == JOIN && work->isAmidPart)) &&
           (!work->isSorting || IsSorting(&work->sorting, work->entries.count - first, work->sortRoom.count)) &&
           AreCollected(check, work, squares, square, first);
}

/* Which of two squares of a side is being collected. */
static int32_t SquareToCollect(const kiriGridWork* work, const kiriSquares* squares, int32_t square)
{
    int32_t beside = SquareBeside(work, squares, square), before = square < beside ? square : beside;
    int32_t after = square < beside ? beside : square;
    return work->stage == 0 ? square : IsCollected(work, before) ? after : before;
}

/* Where a stage that goes over two rows, or over a list, is in them. */
static bool IsAtRows(const kiriGrid* grid, bool isAtSquare)
{
    const kiriGridWork* work = grid->work;
    if (work->stage == LAST_LISTS && work->item < KIRI_CHANGES_LISTS) {
        ChangedCells changed = ChangedCellsOf(&grid->changes, work->item);
        return work->other <= work->at && work->at <= kiriArray_GetHeader(changed.list).count;
    }
    return isAtSquare || (work->at == 0 && work->other == 0);
}

/* The faces of the side at hand that are being added up are those that were emptied. */
static bool AreOldFaces(kiriCheck* check, const kiriGrid* grid, int32_t square, int32_t beside)
{
    const kiriGridWork* work = grid->work;
    uint8_t* isOld = kiriCheck_Bytes(check, grid->faces.count);
    int32_t low = square < beside ? square : beside, high = square < beside ? beside : square;
    bool areFine = isOld != NULL;
    for (int32_t k = 0; areFine && k < work->oldFaces.count; ++k) {
        int32_t f = work->oldFaces.data[k].face;
        const int32_t* cell = grid->faces.data[f].cell;
        areFine = !isOld[f] && cell[0] != KIRI_NONE && grid->cells.data[cell[0]].square == low &&
                  grid->cells.data[cell[1]].square == high;
        isOld[f] = 1;
    }
    for (int32_t f = 0; areFine && f < grid->faces.count; ++f) {
        const kiriFace* face = &grid->faces.data[f];
        areFine = isOld[f] || face->cell[0] == KIRI_NONE || !kiriFace_HasOwnStretch(face) ||
                  grid->stretches.data[face->kind / 2 - 1].width > 0.0;
    }
    kiriMemory_Free(&check->memory, isOld);
    return areFine;
}

/* The square at hand in the first two stages. */
static bool IsAtSquare(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    const kiriGridWork* work = grid->work;
    int32_t square = SquareAtHand(work, squares);
    if (work->stage == 0) {
        return work->part == LOOK || (work->isAmidPart && (!work->isSame || grid->whole.data[square]) &&
                                      IsAmidCells(grid, mesh));
    }
    if (!work->isMerging) {
        return work->part < 4;
    }
    int32_t beside = work->part < 4 ? SquareBeside(work, squares, square) : KIRI_NONE;
    return IsCollected(work, square) && IsCollected(work, beside) && AreOldFaces(check, grid, square, beside);
}

static bool IsUpdate(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    const kiriGridWork* work = grid->work;
    int64_t items = CountItemsOf(work, squares);
    bool isAtSquare = work->stage < 2 && work->item < items;
    if (work->item > items || (!isAtSquare && (work->isMerging || work->part != 0 || work->isAmidPart)) ||
        (work->isMerging && work->stage != 1)) {
        return false;
    }
    int32_t collected = isAtSquare && work->isCollecting ? SquareToCollect(work, squares, SquareAtHand(work, squares))
                                                         : KIRI_NONE;
    bool isCollecting = collected >= 0 && collected < work->ranges.count;
    if (isCollecting != work->isCollecting ||
        (isCollecting && !IsCollectingRight(check, work, squares, collected))) {
        return false;
    }
    int32_t collectedEnd = isCollecting ? work->ranges.data[collected].first : work->entries.count;
    return AreRanges(check, work, squares, collectedEnd) &&
           AreEntries(work, squares, isCollecting && !work->isSorting ? collectedEnd : work->entries.count) &&
           (work->stage > 0 || IsNode(work, squares)) && IsAtRows(grid, isAtSquare) &&
           (!isAtSquare || IsAtSquare(check, grid, mesh));
}

/* ---- Lists of squares and cells ---- */

/* Cells whose steps are made again: those of squares that are flagged, or all that are new. */
static bool AreStepsDirty(kiriCheck* check, const kiriGrid* grid, uint8_t* flags)
{
    const kiriGridWork* work = grid->work;
    bool areFine = kiriCheck_Distinct(check, &work->stepsDirty, grid->cells.count) &&
                   kiriCheck_Distinct(check, &work->knightsDirty, grid->cells.count);
    for (int32_t k = 0; areFine && k < work->stepsDirty.count; ++k) {
        areFine = kiriGrid_IsCell(grid, work->stepsDirty.data[k]);
    }
    for (int32_t k = 0; areFine && k < work->knightsDirty.count; ++k) {
        areFine = kiriGrid_IsCell(grid, work->knightsDirty.data[k]);
    }
    int64_t cells = 0;
    for (int32_t s = 0; areFine && !work->fromScratch && s < work->squareFlags.count; ++s) {
        bool isDirty = (work->squareFlags.data[s] & KIRI_SQUARE_STEPS_DIRTY) != 0;
        for (int32_t c = grid->squareCell.data[s]; isDirty && c != KIRI_NONE; c = grid->cells.data[c].next) {
            ++cells;
        }
        flags[s] |= isDirty ? KIRI_SQUARE_STEPS_DIRTY : 0;
    }
    for (int32_t k = 0; areFine && !work->fromScratch && k < work->stepsDirty.count; ++k) {
        areFine = (flags[grid->cells.data[work->stepsDirty.data[k]].square] & KIRI_SQUARE_STEPS_DIRTY) != 0;
    }
    return areFine && (work->fromScratch || cells == work->stepsDirty.count);
}

static bool AddFlags(const kiriIndices* squares, uint8_t* flags, uint8_t flag)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < squares->count; ++k) {
        areFine = (flags[squares->data[k]] & flag) == 0;
        flags[squares->data[k]] |= flag;
    }
    return areFine;
}

/* Flags of squares say in which lists these are, or their cells, and which are collected. */
static bool AreSquaresFlagged(kiriCheck* check, const kiriGrid* grid)
{
    const kiriGridWork* work = grid->work;
    uint8_t* flags = kiriCheck_Bytes(check, work->squareFlags.count);
    bool areFine = flags != NULL && AddFlags(&work->facesDirty, flags, KIRI_SQUARE_FACES_DIRTY) &&
                   AddFlags(&work->linksDirty, flags, KIRI_SQUARE_LINKS_DIRTY) && AreStepsDirty(check, grid, flags);
    for (int32_t s = 0; areFine && s < work->squareFlags.count; ++s) {
        areFine = (work->squareFlags.data[s] & ~KIRI_SQUARE_COLLECTED) == flags[s];
    }
    kiriMemory_Free(&check->memory, flags);
    return kiriCheck_That(check, areFine) &&
           kiriCheck_AllMarked(check, &work->flagged, work->squareFlags.count, work->squareFlags.data, UINT8_MAX);
}

/* Between updates nothing is left of the last one: the next begins with what is there. */
static bool IsAtRest(const kiriGridWork* work)
{
    return work->due == 0 && work->stage == 0 && work->item == 0 && work->part == 0 && work->at == 0 &&
           work->other == 0 && !work->removed && !work->isAmidPart && !work->isCollecting && !work->isMerging &&
           work->flagged.count == 0 && work->facesDirty.count == 0 && work->linksDirty.count == 0 &&
           work->stepsDirty.count == 0 && work->knightsDirty.count == 0 && work->entries.count == 0 &&
           work->parent.count == 0;
}

/* From scratch: all cells are new, and squares that are still to come have none. */
static bool IsFromScratch(const kiriGrid* grid)
{
    const kiriGridWork* work = grid->work;
    bool isFine = grid->changes.made.count == grid->cellCount && grid->changes.gone.count == 0 &&
                  work->stepsDirty.count == grid->cellCount && work->linksDirty.count == 0;
    int32_t first = work->part < FILL ? work->item : work->item + 1;
    for (int32_t s = first; isFine && work->stage == 0 && s < grid->squareCell.count; ++s) {
        isFine = grid->squareCell.data[s] == KIRI_NONE;
    }
    return isFine && (work->stage > 0 || grid->faces.count == 0);
}

/* Rows are as long as the mesh is large. */
static bool IsRunning(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriGridWork* work = grid->work;
    return kiriCheck_Object(check, RunningMust, work) &&
           (work->stage > 0 || work->part == 0 || kiriCheck_Object(check, AmidCellsMust, work)) &&
           (!work->isMerging || kiriCheck_Object(check, AmidFacesMust, work)) &&
           kiriCheck_That(check, grid->nodeCell.count == mesh->squares.nodes.count &&
                                     grid->vertexCell.count == mesh->vertices.count && AreNewMaterials(grid, mesh) &&
                                     (!work->fromScratch || IsFromScratch(grid))) &&
           kiriCheck_That(check, IsUpdate(check, grid, mesh));
}

bool kiriGrid_CheckWork(const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check)
{
    return kiriCheck_Object(check, GridWorkMust, grid->work) &&
           kiriCheck_That(check, AreMarksOfGrid(grid->work)) && AreChangesFlagged(check, grid) &&
           AreSquaresFlagged(check, grid) &&
           (grid->work->running ? IsRunning(check, grid, mesh) : kiriCheck_That(check, IsAtRest(grid->work)));
}
