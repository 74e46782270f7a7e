#include "kiri_gather.h"

#include "../core/kiri_sort.h"
#include "kiri_update.h"

#include <string.h>

/* ---- Room ---- */

enum { ROOM_AN_ITEM = 64 }; /* entries of maps that are written */

/* A map of all items, which keeps none. It keeps none at rest, too: so what is new is all there is to write. */
static kiriProgress ReserveMap(kiriKeep* map, kiriMemory* memory, int32_t items, kiriQuota* quota)
{
    if (!kiriArray_Reserve(memory, &map->to, items)) {
        return KIRI_FAILED;
    }
    map->to.count = kiriMin(map->to.count, items);
    while (map->to.count < items) {
        int32_t end = items - map->to.count < ROOM_AN_ITEM ? items : map->to.count + ROOM_AN_ITEM;
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        while (map->to.count < end) {
            map->to.data[map->to.count++] = KIRI_NONE;
        }
    }
    return KIRI_DONE;
}

static kiriProgress ReserveCellMaps(kiriTaking* taking, kiriMemory* memory, int32_t cells, kiriQuota* quota)
{
    int32_t known = taking->cells.count;
    if (!kiriArray_Reserve(memory, &taking->cells, cells)) {
        return KIRI_FAILED;
    }
    if (known < cells && !kiriQuota_Take(quota, (cells - known) / ROOM_AN_ITEM)) {
        return KIRI_MORE;
    }
    for (int32_t c = known; c < cells; ++c) {
        taking->cells.data[c] = 0;
    }
    taking->cells.count = cells;
    return KIRI_DONE;
}

bool kiriGather_IsReserved(const kiriSheetData* sheet)
{
    const kiriTaking* taking = &sheet->taking;
    return taking->vertices.to.count == sheet->mesh.vertices.count &&
           taking->triangles.to.count == sheet->mesh.triangles.count && taking->cells.count == sheet->grid.cells.count;
}

kiriProgress kiriGather_Reserve(kiriSheetData* sheet, kiriQuota* quota)
{
    kiriTaking* taking = &sheet->taking;
    KIRI_ASSERT(taking->vertices.count == 0 && taking->triangles.count == 0);
    kiriProgress progress = ReserveMap(&taking->vertices, sheet->memory, sheet->mesh.vertices.count, quota);
    progress = progress == KIRI_DONE ? ReserveMap(&taking->triangles, sheet->memory, sheet->mesh.triangles.count, quota)
                                     : progress;
    return progress == KIRI_DONE ? ReserveCellMaps(taking, sheet->memory, sheet->grid.cells.count, quota) : progress;
}

/* ---- Cells ---- */

static bool TakeGatheredCell(kiriGathered* gathered, int32_t cell)
{
    uint8_t* mark = &gathered->sheet->taking.cells.data[cell];
    if (!*mark && !kiriArray_Push(gathered->memory, &gathered->cells, cell)) {
        return false;
    }
    *mark = 1;
    return true;
}

/* ---- Triangles and vertices ---- */

static bool TakeItem(kiriMemory* memory, kiriKeep* map, kiriIndices* items, int32_t item)
{
    if (map->to.data[item] == KIRI_NONE && !kiriArray_Push(memory, items, item)) {
        return false;
    }
    map->to.data[item] = 0;
    return true;
}

/* With its vertices. */
static bool TakeTriangle(kiriGathered* gathered, int32_t triangle)
{
    kiriTaking* taking = &gathered->sheet->taking;
    const int32_t* vertex = gathered->sheet->mesh.triangles.data[triangle].vertex;
    bool ok = TakeItem(gathered->memory, &taking->triangles, &gathered->triangles, triangle);
    for (int k = 0; ok && k < 3; ++k) {
        ok = TakeItem(gathered->memory, &taking->vertices, &gathered->vertices, vertex[k]);
    }
    return ok;
}

static bool TakeTrianglesOf(kiriGathered* gathered, int32_t cell)
{
    const kiriSheetData* sheet = gathered->sheet;
    const kiriSquareNode* nodes = sheet->mesh.squares.nodes.data;
    bool ok = true;
    for (int32_t n = sheet->mesh.squares.head[sheet->grid.cells.data[cell].square]; ok && n != KIRI_NONE;
         n = nodes[n].next) {
        bool isIn = sheet->grid.nodeCell.data[n] == cell;
        gathered->left -= isIn;
        ok = !isIn || TakeTriangle(gathered, nodes[n].triangle);
    }
    return ok;
}

/* Goes on from a cell that was taken: straight steps lead to all material of a piece, and to no other. */
static bool TakeAround(kiriGathered* gathered, int32_t cell)
{
    kiriSteps steps;
    bool ok = TakeTrianglesOf(gathered, cell);
    kiriGrid_GetStepsTo(&gathered->sheet->grid, cell, 1, &steps);
    for (int32_t s = 0; ok && s < steps.end[0]; ++s) {
        ok = TakeGatheredCell(gathered, steps.data[s].cell);
    }
    return ok;
}

/* In their order they are near each other in memory. */
static bool SortSpan(kiriGathered* gathered, kiriIndices* items, kiriSpan span)
{
    bool ok = kiriArray_Reserve(gathered->memory, &gathered->room, span.count);
    if (ok && span.count > 0) {
        kiriSort_Numbers(items->data + span.first, gathered->room.data, span.count);
    }
    return ok;
}

static void ClearMap(kiriKeep* map, const int32_t* items, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) {
        map->to.data[items[k]] = KIRI_NONE;
    }
}

/* ---- What bytes may have that somebody made up ---- */

static int64_t CountSquaresOf(const kiriMeshData* mesh, int32_t triangle)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, triangle, c);
    return kiriSquares_CountOverlaps(&mesh->squares, c);
}

static bool AreNeighboursTaken(const kiriSheetData* sheet, int32_t triangle)
{
    bool areTaken = true;
    for (int32_t h = 3 * triangle; areTaken && h < 3 * triangle + 3; ++h) {
        int32_t twin = kiriMesh_Twin(&sheet->mesh, h);
        areTaken = twin == KIRI_NONE || kiriMesh_IsOpen(&sheet->mesh, h) ||
                   sheet->taking.triangles.to.data[twin / 3] != KIRI_NONE;
    }
    return areTaken;
}

/* Does the piece hang together with nothing else? All that its triangles have in squares is in its cells, which has
   been counted, and what they share an edge with is of it. An item of the quota is a triangle. */
static kiriProgress LookWhether(kiriGathered* gathered, kiriQuota* quota)
{
    const kiriSheetData* sheet = gathered->sheet;
    bool isWhole = true;
    for (; isWhole && gathered->checked < gathered->triangles.count; ++gathered->checked) {
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        gathered->left += CountSquaresOf(&sheet->mesh, gathered->triangles.data[gathered->checked]);
        isWhole = AreNeighboursTaken(sheet, gathered->triangles.data[gathered->checked]);
    }
    return isWhole && gathered->left == 0 ? KIRI_DONE : KIRI_FAILED;
}

/* ---- Marks ---- */

static void MarkItems(kiriKeep* map, const kiriIndices* items)
{
    for (int32_t k = 0; k < items->count; ++k) {
        map->to.data[items->data[k]] = 0;
    }
    map->count = items->count;
}

/* ---- Pieces ---- */

/* All of the piece that the last cell is of. Its marks go again, so that those of each piece are alone. */
static bool TakeWholePiece(kiriGathered* gathered, int32_t piece)
{
    kiriTaking* taking = &gathered->sheet->taking;
    kiriIndices *triangles = &gathered->triangles, *vertices = &gathered->vertices;
    kiriGatheredPiece taken = { piece, { triangles->count, 0 }, { vertices->count, 0 } };
    kiriQuota unlimited = { INT64_MAX, 0, 0, false };
    bool ok = true;
    for (int32_t k = gathered->cells.count - 1; ok && k < gathered->cells.count; ++k) {
        ok = TakeAround(gathered, gathered->cells.data[k]);
    }
    ok = ok && LookWhether(gathered, &unlimited) == KIRI_DONE;
    taken.triangles.count = triangles->count - taken.triangles.first;
    taken.vertices.count = vertices->count - taken.vertices.first;
    ClearMap(&taking->triangles, triangles->data + taken.triangles.first, taken.triangles.count);
    ClearMap(&taking->vertices, vertices->data + taken.vertices.first, taken.vertices.count);
    return ok && kiriArray_Push(gathered->memory, &gathered->pieces, taken);
}

static int32_t CountLeaving(const kiriSheetData* sheet, const uint8_t* stays)
{
    int32_t count = 0;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        count += !stays[p];
    }
    return count;
}

/* Frames of a piece that is gathered have their cell marked. */
static bool TakePieces(kiriGathered* gathered, const uint8_t* stays)
{
    const kiriSheetData* sheet = gathered->sheet;
    bool ok = true;
    int32_t last = KIRI_NONE;
    for (int32_t f = 0; ok && f < sheet->frames.count; ++f) {
        int32_t piece = sheet->layout.framePiece.data[f], cell = sheet->frames.data[f].site.cell;
        if (!stays[piece] && !sheet->taking.cells.data[cell]) {
            ok = piece > last && TakeGatheredCell(gathered, cell) && TakeWholePiece(gathered, piece);
            last = piece;
        }
    }
    return ok && gathered->pieces.count == CountLeaving(sheet, stays);
}

static void ClearCells(kiriGathered* gathered)
{
    for (int32_t k = 0; k < gathered->cells.count; ++k) {
        gathered->sheet->taking.cells.data[gathered->cells.data[k]] = 0;
    }
}

static bool ListSquares(kiriGathered* gathered)
{
    kiriIndices* squares = &gathered->squares;
    if (!kiriArray_Resize(gathered->memory, squares, gathered->cells.count) ||
        !kiriArray_Reserve(gathered->memory, &gathered->room, gathered->cells.count)) {
        return false;
    }
    for (int32_t k = 0; k < gathered->cells.count; ++k) {
        squares->data[k] = gathered->sheet->grid.cells.data[gathered->cells.data[k]].square;
    }
    kiriSort_Numbers(squares->data, gathered->room.data, squares->count);
    int32_t count = 0;
    for (int32_t k = 0; k < squares->count; ++k) {
        if (count == 0 || squares->data[k] != squares->data[count - 1]) {
            squares->data[count++] = squares->data[k];
        }
    }
    squares->count = count;
    return true;
}

static bool StartGathering(kiriGathered* gathered, kiriSheetData* sheet, kiriMemory* memory)
{
    kiriQuota unlimited = { INT64_MAX, 0, 0, false };
    KIRI_ASSERT(kiriUpdate_IsFieldCurrent(sheet->update));
    kiriGather_Pause(sheet);
    memset(gathered, 0, sizeof(*gathered));
    gathered->sheet = sheet;
    gathered->memory = memory;
    return kiriGather_Reserve(sheet, &unlimited) == KIRI_DONE;
}

static bool SortGathered(kiriGathered* gathered)
{
    bool ok = SortSpan(gathered, &gathered->cells, (kiriSpan){ 0, gathered->cells.count });
    for (int32_t p = 0; ok && p < gathered->pieces.count; ++p) {
        ok = SortSpan(gathered, &gathered->triangles, gathered->pieces.data[p].triangles) &&
             SortSpan(gathered, &gathered->vertices, gathered->pieces.data[p].vertices);
    }
    gathered->isDone = ok && ListSquares(gathered);
    return gathered->isDone;
}

bool kiriGather_Make(kiriGathered* gathered, kiriSheetData* sheet, kiriMemory* memory, const uint8_t* stays)
{
    if (!StartGathering(gathered, sheet, memory)) {
        return false;
    }
    bool ok = TakePieces(gathered, stays);
    ClearCells(gathered);
    return ok && SortGathered(gathered);
}

/* ---- Little by little ---- */

bool kiriGather_Start(kiriGathered* gathered, kiriSheetData* sheet, kiriMemory* memory, int32_t frame)
{
    const kiriGatheredPiece none = { sheet->layout.framePiece.data[frame], { 0, 0 }, { 0, 0 } };
    return StartGathering(gathered, sheet, memory) && kiriArray_Push(memory, &gathered->pieces, none) &&
           kiriArray_Push(memory, &gathered->cells, sheet->frames.data[frame].site.cell);
}

/* Marks stay from call to call: so a call costs what it takes, and not what has been taken before. */
static void MarkTaken(kiriGathered* gathered)
{
    kiriTaking* taking = &gathered->sheet->taking;
    for (int32_t k = 0; k < gathered->cells.count && !gathered->isUnderWay; ++k) {
        taking->cells.data[gathered->cells.data[k]] = 1;
    }
    if (!gathered->isUnderWay) {
        MarkItems(&taking->triangles, &gathered->triangles);
        MarkItems(&taking->vertices, &gathered->vertices);
    }
    gathered->isUnderWay = true;
}

void kiriGather_Pause(kiriSheetData* sheet)
{
    kiriGathered* gathered = sheet->ahead.gathered;
    if (gathered != NULL && gathered->isUnderWay) {
        ClearCells(gathered);
        ClearMap(&sheet->taking.triangles, gathered->triangles.data, gathered->triangles.count);
        ClearMap(&sheet->taking.vertices, gathered->vertices.data, gathered->vertices.count);
        sheet->taking.triangles.count = sheet->taking.vertices.count = 0;
        gathered->isUnderWay = false;
    }
}

/* What the cell is worth, in items. */
static int64_t EffortOf(const kiriGathered* gathered, int32_t cell)
{
    const kiriSheetData* sheet = gathered->sheet;
    return 1 + kiriSquares_CountNodes(&sheet->mesh.squares, sheet->grid.cells.data[cell].square) / 2;
}

static bool TakeSome(kiriGathered* gathered, kiriQuota* quota)
{
    bool ok = true;
    MarkTaken(gathered);
    while (ok && gathered->looked < gathered->cells.count && kiriQuota_Pay(quota, &gathered->due)) {
        int32_t cell = gathered->cells.data[gathered->looked++];
        gathered->due = EffortOf(gathered, cell);
        ok = TakeAround(gathered, cell);
    }
    return ok;
}

static kiriProgress LookWhetherAll(kiriGathered* gathered, kiriQuota* quota)
{
    if (gathered->checked == gathered->triangles.count) {
        return KIRI_DONE;
    }
    MarkTaken(gathered);
    return LookWhether(gathered, quota);
}

kiriProgress kiriGather_GoOn(kiriGathered* gathered, kiriQuota* quota)
{
    KIRI_ASSERT(!gathered->isDone && kiriGather_IsReserved(gathered->sheet));
    if (gathered->looked < gathered->cells.count && !TakeSome(gathered, quota)) {
        return KIRI_FAILED;
    }
    kiriProgress progress = gathered->looked == gathered->cells.count ? LookWhetherAll(gathered, quota) : KIRI_MORE;
    if (progress == KIRI_DONE && !kiriQuota_Take(quota, 1 + gathered->triangles.count / 4)) {
        progress = KIRI_MORE;
    }
    if (progress != KIRI_DONE) {
        return progress;
    }
    kiriGather_Pause(gathered->sheet);
    gathered->pieces.data[0].triangles.count = gathered->triangles.count;
    gathered->pieces.data[0].vertices.count = gathered->vertices.count;
    return SortGathered(gathered) ? KIRI_DONE : KIRI_FAILED;
}

const kiriGatheredPiece* kiriGather_Find(const kiriGathered* gathered, int32_t piece)
{
    int32_t low;
    KIRI_SEARCH(low, 0, gathered->pieces.count - 1, gathered->pieces.data[middle].piece < piece);
    KIRI_ASSERT(gathered->pieces.data[low].piece == piece);
    return &gathered->pieces.data[low];
}

/* ---- All of them ---- */

void kiriGather_Mark(kiriGathered* gathered)
{
    KIRI_ASSERT(!gathered->isMarked);
    MarkItems(&gathered->sheet->taking.triangles, &gathered->triangles);
    MarkItems(&gathered->sheet->taking.vertices, &gathered->vertices);
    gathered->isMarked = true;
}

void kiriGather_Unmark(kiriGathered* gathered)
{
    if (gathered->isMarked) {
        kiriTaking* taking = &gathered->sheet->taking;
        ClearMap(&taking->triangles, gathered->triangles.data, gathered->triangles.count);
        ClearMap(&taking->vertices, gathered->vertices.data, gathered->vertices.count);
        taking->triangles.count = taking->vertices.count = 0;
        gathered->isMarked = false;
    }
}
