#include "kiri_detach.h"
#include "kiri_touch.h"
#include "kiri_piece.h"
#include "../core/kiri_array.h"
#include "kiri_update.h"
#include "kiri_sheet.h"
#include "kiri_motion.h"
#include "kiri_pin.h"
#include "kiri_seen.h"

#include <string.h>

bool kiriKept_Init(kiriKept* kept, const kiriSheetData* from)
{
    memset(kept, 0, sizeof(*kept));
    kept->from = from;
    kept->memory = kiriMemory_Like(from->memory);
    if (!kiriArray_Resize(&kept->memory, &kept->pieces, from->layout.pieces.count)) {
        return false;
    }
    memset(kept->pieces.data, 0, (size_t)kept->pieces.count);
    return true;
}

static bool IsFrameKept(const kiriKept* kept, int32_t frame)
{
    return kept->pieces.data[kept->from->layout.framePiece.data[frame]] != 0;
}

int32_t kiriKept_FrameOfPin(const kiriKept* kept, int32_t pin)
{
    const kiriLayout* layout = &kept->from->layout;
    const kiriLineShare* longest = NULL;
    if (IsFrameKept(kept, layout->pinFrame.data[pin])) {
        return layout->pinFrame.data[pin];
    }
    for (int32_t k = 0; k < layout->pinShares.count; ++k) {
        const kiriPinShare* pinned = &layout->pinShares.data[k];
        if (pinned->pin == pin && IsFrameKept(kept, pinned->share.frame) &&
            (longest == NULL || pinned->share.length > longest->length)) {
            longest = &pinned->share;
        }
    }
    return longest != NULL ? longest->frame : KIRI_NONE;
}

static bool MapMesh(kiriKept* kept)
{
    const kiriMeshData* mesh = &kept->from->mesh;
    if (!kiriKeep_Init(&kept->triangles, &kept->memory, mesh->triangles.count) ||
        !kiriKeep_Init(&kept->vertices, &kept->memory, mesh->vertices.count)) {
        return false;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t piece = kiriPiece_OfVertex(kept->from, v);
        kiriKeep_Add(&kept->vertices, piece != KIRI_NONE && kept->pieces.data[piece] != 0);
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriKeep_Add(&kept->triangles, kiriKeep_Has(&kept->vertices, mesh->triangles.data[t].vertex[0]));
    }
    return true;
}

static bool ReserveRest(kiriKept* kept)
{
    const kiriSheetData* from = kept->from;
    return kiriKeep_Init(&kept->frames, &kept->memory, from->frames.count) &&
           kiriKeep_Init(&kept->points, &kept->memory, from->points.count) &&
           kiriKeep_Init(&kept->pins, &kept->memory, from->pins.count) &&
           kiriKeep_Init(&kept->links, &kept->memory, from->links.links.count);
}

/* There is room. */
static void MapRest(kiriKept* kept)
{
    const kiriSheetData* from = kept->from;
    for (int32_t i = 0; i < from->frames.count; ++i) {
        kiriKeep_Add(&kept->frames, IsFrameKept(kept, i));
    }
    for (int32_t i = 0; i < from->points.count; ++i) {
        kiriKeep_Add(&kept->points, IsFrameKept(kept, from->points.data[i].frame));
    }
    for (int32_t i = 0; i < from->pins.count; ++i) {
        kiriKeep_Add(&kept->pins, kiriKept_FrameOfPin(kept, i) != KIRI_NONE);
    }
    for (int32_t k = 0; k < from->links.links.count; ++k) {
        kiriKeep_Add(&kept->links, IsFrameKept(kept, from->links.links.data[k].i));
    }
}

bool kiriKept_LeaveHoles(kiriKept* kept)
{
    kept->vertices = kiriKeep_LeaveHoles(&kept->from->taking.vertices);
    kept->triangles = kiriKeep_LeaveHoles(&kept->from->taking.triangles);
    if (!ReserveRest(kept)) {
        return false;
    }
    MapRest(kept);
    return true;
}

bool kiriKept_Map(kiriKept* kept)
{
    if (!MapMesh(kept) || !ReserveRest(kept)) {
        return false;
    }
    MapRest(kept);
    return true;
}

/* ---- One piece after the other ---- */

bool kiriKept_InitParts(kiriKept* kept, const kiriSheetData* from)
{
    return kiriKept_Init(kept, from) && ReserveRest(kept);
}

void kiriKept_TakePart(kiriKept* kept, int32_t piece, const kiriIndices* vertices, const kiriIndices* triangles)
{
    kept->vertices = kept->from->taking.vertices;
    kept->triangles = kept->from->taking.triangles;
    kept->pieces.data[piece] = 1;
    kiriKeep_Take(&kept->vertices, vertices->data, vertices->count);
    kiriKeep_Take(&kept->triangles, triangles->data, triangles->count);
    MapRest(kept);
}

void kiriKept_DropPart(kiriKept* kept, int32_t piece, const kiriIndices* vertices, const kiriIndices* triangles)
{
    kept->pieces.data[piece] = 0;
    kiriKeep_Drop(&kept->vertices, vertices->data, vertices->count);
    kiriKeep_Drop(&kept->triangles, triangles->data, triangles->count);
    kiriKeep_Restart(&kept->frames);
    kiriKeep_Restart(&kept->points);
    kiriKeep_Restart(&kept->pins);
    kiriKeep_Restart(&kept->links);
}

/* ---- What follows ---- */

bool kiriKept_FollowContact(const kiriKept* kept, kiriGivenContact* given)
{
    if (given->contact.point >= 0) {
        given->contact.point = kiriKeep_To(&kept->points, given->contact.point);
        return given->contact.point != KIRI_NONE;
    }
    bool isKept = true;
    for (int n = 0; n < 3 && given->vertex[n] != KIRI_NONE; ++n) {
        given->vertex[n] = kiriKeep_To(&kept->vertices, given->vertex[n]);
        isKept = isKept && given->vertex[n] != KIRI_NONE;
    }
    return isKept;
}

bool kiriKept_FollowTouch(const kiriKept* kept, kiriTouch* touch)
{
    bool isKept = true;
    if (touch->key >> 60 != KIRI_TOUCH_OBSTACLE) {
        return kiriTouch_Follow(touch, &kept->points, &kept->vertices);
    }
    for (int n = 0; n < 3 && touch->vertex[n] != KIRI_NONE; ++n) {
        touch->vertex[n] = kiriKeep_To(&kept->vertices, touch->vertex[n]);
        isKept = isKept && touch->vertex[n] != KIRI_NONE;
    }
    return isKept && kiriObstacle_FollowKey(&touch->key, &kept->vertices, &kept->triangles);
}

double kiriKept_Share(const kiriKept* kept)
{
    const kiriLayout* layout = &kept->from->layout;
    double share = 0.0, whole = 0.0;
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        whole += layout->pieces.data[p].area;
        share += kept->pieces.data[p] ? layout->pieces.data[p].area : 0.0;
    }
    return share / whole;
}

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

/* What is spread over the sheet falls to its parts by area. */
static void CopySettings(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    double share = kiriKept_Share(kept);
    to->settings = from->settings;
    to->settings.collisionPoints = share * from->settings.collisionPoints;
    to->settings.integrationPoints = share * from->settings.integrationPoints;
    kiriSettings_Apply(to);
}

/* The cell of the part with the material of one of the sheet. */
static int32_t CellInPart(const kiriKept* kept, const kiriSheetData* to, int32_t cell)
{
    const kiriCell* was = &kept->from->grid.cells.data[cell];
    int32_t found =
        to->grid.squareCell.data[kiriSquares_InPart(&to->mesh.squares, &kept->from->mesh.squares, was->square)];
    while (to->grid.cells.data[found].triangle != kiriKeep_To(&kept->triangles, was->triangle)) {
        found = to->grid.cells.data[found].next;
    }
    return found;
}

static bool CopySites(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            kiriSite site = from->frames.data[i].site;
            site.cell = CellInPart(kept, to, site.cell);
            ok = kiriArray_Push(to->memory, &to->update->placing.sites, site);
        }
    }
    return ok;
}

static bool CopyPoints(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->points.count; ++i) {
        if (kiriKeep_To(&kept->points, i) != KIRI_NONE) {
            kiriSample point = { from->points.data[i].at, KIRI_NONE, KIRI_NONE };
            kiriSpan none = { 0, 0 };
            ok = kiriArray_Push(to->memory, &to->points, point) &&
                 kiriArray_Push(to->memory, &to->pointSkin.spans, none) &&
                 kiriPlaces_Add(&to->pointPlaces, to->memory, &to->mesh, point.at);
        }
    }
    return ok;
}

static bool CopyPins(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->pins.count; ++i) {
        if (kiriKeep_To(&kept->pins, i) != KIRI_NONE) {
            ok = kiriPins_Add(to, &from->pins.data[i], kiriKeep_To(&kept->frames, kiriKept_FrameOfPin(kept, i)));
        }
    }
    return ok;
}

/* What pushed when the piece was moved last, with the force. */
static void CopyTouches(const kiriKept* kept, const kiriTouchMemory* from, kiriTouchMemory* to, kiriIndices* order)
{
    int32_t before = to->touches.count;
    for (int32_t i = 0; i < from->touches.count; ++i) {
        kiriTouch touch = from->touches.data[i];
        if (kiriKept_FollowTouch(kept, &touch)) {
            kiriTouchMemory_Add(to, &touch, kiriTouches_ForceOf(kept->from, from->touches.data[i].key));
        }
    }
    kiriTouchMemory_SortForces(to, before, order);
}

/* Room for contacts is what SetContacts reserves, so that none is needed later. */
static bool CopyContacts(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    const kiriTouches* touches = &from->touches;
    int32_t remembered = touches->last.touches.count + touches->slept.touches.count;
    int32_t most = kiriMax(from->contacts.count, remembered);
    if (!kiriArray_Reserve(to->memory, &to->contacts, most) ||
        !kiriArray_Reserve(&to->shown, &to->touches.nextTold, most) || !kiriTouches_Room(to, most)) {
        return false;
    }
    for (int32_t i = 0; i < from->contacts.count; ++i) {
        kiriGivenContact given = from->contacts.data[i];
        if (kiriKept_FollowContact(kept, &given)) {
            to->contacts.data[to->contacts.count++] = given;
        }
    }
    CopyTouches(kept, &touches->last, &to->touches.last, &to->touches.order);
    CopyTouches(kept, &touches->slept, &to->touches.slept, &to->touches.order);
    return true;
}

/* Frames as they are to the last bit, whatever a commit does to new ones. */
static void CopyFrames(const kiriKept* kept, kiriSheetData* to)
{
    to->frames.count = to->update->placing.sites.count;
    for (int32_t i = 0; i < kept->from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            kiriFrameData* frame = &to->frames.data[kiriKeep_To(&kept->frames, i)];
            *frame = kept->from->frames.data[i];
            frame->site = to->update->placing.sites.data[kiriKeep_To(&kept->frames, i)];
        }
    }
}

/* Where a frame has a mass that the next commit is to take from its region again: other material gives it one, see
   kiri_sheet.c. */
static void CopyDirty(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    for (int32_t i = 0; i < from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            to->regions.dirty.data[kiriKeep_To(&kept->frames, i)] = from->regions.dirty.data[i];
        }
    }
}

/* What is still seen elsewhere goes on to fade. Samples keep their order. */
static bool CopyFades(kiriFades* to, kiriMemory* memory, const kiriFades* from, const kiriKeep* samples)
{
    if (from->fading.count == 0) {
        return true;
    }
    if (!kiriFades_Reserve(to, memory, samples->count)) {
        return false;
    }
    for (int32_t k = 0; k < from->fading.count; ++k) {
        kiriFading fading = from->fading.data[k];
        fading.sample = kiriKeep_To(samples, fading.sample);
        if (fading.sample != KIRI_NONE) {
            to->fading.data[to->fading.count++] = fading;
        }
    }
    return true;
}

static bool CopyAllFades(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    return CopyFades(&to->seen.fades, to->memory, &from->seen.fades, &kept->vertices) &&
           CopyFades(&to->seen.pointFades, to->memory, &from->seen.pointFades, &kept->points);
}

/* Links come in the order that they had. */
static void CopyStrainOffsets(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    int32_t count = 0;
    for (int32_t k = 0; k < from->strainOffsets.strainOffsets.count && count < to->strainOffsets.strainOffsets.count;
         ++k) {
        if (kiriKeep_To(&kept->frames, from->links.links.data[k].i) != KIRI_NONE) {
            to->strainOffsets.strainOffsets.data[count++] = from->strainOffsets.strainOffsets.data[k];
        }
    }
}

/* Shares come in the order that they had. */
static void CopyPinHistory(const kiriKept* kept, kiriSheetData* to)
{
    const kiriPinShares* shares = &kept->from->layout.pinShares;
    int32_t count = 0;
    for (int32_t k = 0; k < shares->count && count < to->layout.pinShares.count; ++k) {
        if (kiriKeep_To(&kept->frames, shares->data[k].share.frame) != KIRI_NONE) {
            kiriPinShare* share = &to->layout.pinShares.data[count++];
            memcpy(share->offset, shares->data[k].offset, sizeof(share->offset));
            memcpy(share->reactions, shares->data[k].reactions, sizeof(share->reactions));
            share->bore = shares->data[k].bore;
            share->off = shares->data[k].off;
        }
    }
}

/* Of the one piece that it is. */
static void CopyRest(const kiriKept* kept, kiriSheetData* to)
{
    for (int32_t i = 0; i < kept->from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            to->layout.pieces.data[0].rest = kiriSheet_PieceOf(kept->from, i)->rest;
        }
    }
    kiriMotion_SumRest(to);
}

/* What may change until the piece leaves: all but the fields. */
static bool CopyMotion(const kiriKept* kept, kiriSheetData* to)
{
    to->solver = kiriSolver_Create(to->memory, &to->settings.mechanics);
    if (to->solver == NULL || !CopyPins(kept, to) || !CopyContacts(kept, to) || !kiriPipeline_Make(to, KIRI_READY) ||
        !CopyAllFades(kept, to)) {
        return false;
    }
    CopyFrames(kept, to);
    if (!kiriBuild_Commit(to)) {
        return false;
    }
    CopyFrames(kept, to);
    CopyDirty(kept, to);
    CopyStrainOffsets(kept, to);
    CopyPinHistory(kept, to);
    kiriPins_SumShares(to);
    CopyRest(kept, to);
    kiriView_WritePositions(to);
    return true;
}

/* ---- One piece after the other ---- */

bool kiriExtraction_Init(kiriExtraction* extraction, const kiriGathered* gathered)
{
    memset(extraction, 0, sizeof(*extraction));
    extraction->gathered = gathered;
    return kiriKept_InitParts(&extraction->kept, gathered->sheet);
}

static kiriIndices ItemsOfSpan(const kiriIndices* items, kiriSpan span)
{
    return (kiriIndices){ items->data + span.first, span.count, span.count };
}

double kiriExtraction_Samples(const kiriSheetData* sheet, double share)
{
    const double vertexSamples = 3.0, cellSamples = 1.4;
    double vertices = (double)sheet->mesh.vertices.count - sheet->mesh.vertexHoles;
    return share * (vertexSamples * vertices + cellSamples * sheet->grid.cellCount);
}

/* Measured over meshes of 16 to 200 squares, grids of 16 to 128 and 3 to 80 frames, with a tenth on top. Shape
   functions cost more for each cell where the piece has more frames. */
double kiriExtraction_SamplesAhead(const kiriSheetData* sheet, double share, int32_t frames)
{
    const double vertexSamples = 3.5, cellSamples = 2.2, frameSamples = 100.0, most = 6.8, lost = 12.5;
    double vertices = (double)sheet->mesh.vertices.count - sheet->mesh.vertexHoles, shape = most - lost / frames;
    return share * (vertexSamples * vertices + (cellSamples + kiriMax(shape, 0.5)) * sheet->grid.cellCount) +
           frameSamples * frames;
}

/* The part at hand: its vertices and triangles. */
typedef struct PartMembers {
    kiriMeshPart vertices, triangles;
} PartMembers;

static PartMembers TakeItemsOf(kiriExtraction* extraction, int32_t piece)
{
    kiriKept* kept = &extraction->kept;
    const kiriGatheredPiece* found = kiriGather_Find(extraction->gathered, piece);
    PartMembers items = { { ItemsOfSpan(&extraction->gathered->vertices, found->vertices), &kept->vertices },
                          { ItemsOfSpan(&extraction->gathered->triangles, found->triangles), &kept->triangles } };
    kiriKept_TakePart(kept, piece, &items.vertices.items, &items.triangles.items);
    return items;
}

static void DropPiece(kiriExtraction* extraction, int32_t piece, const PartMembers* items)
{
    kiriKept_DropPart(&extraction->kept, piece, &items->vertices.items, &items->triangles.items);
}

static kiriProgress MakeMeshOfPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuota* quota)
{
    if (to->mesh.isOpen) {
        return KIRI_DONE;
    }
    PartMembers items = TakeItemsOf(extraction, piece);
    kiriProgress progress = kiriMesh_MakePart(&to->mesh, to->memory, &extraction->kept.from->mesh, &items.triangles,
                                              &items.vertices, quota);
    if (progress == KIRI_DONE) {
        CopySettings(&extraction->kept, to);
    }
    DropPiece(extraction, piece, &items);
    return progress;
}

/* When its cells are there. */
static bool FillCellsOfPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to)
{
    PartMembers items = TakeItemsOf(extraction, piece);
    bool ok = CopySites(&extraction->kept, to) && CopyPoints(&extraction->kept, to);
    DropPiece(extraction, piece, &items);
    return ok;
}

static kiriProgress MakeFieldsOfPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuotas* quotas)
{
    to->settings.maxFrames = 0; /* whoever wants another frame has asked before, or asks with the next cut */
    kiriProgress progress = kiriPipeline_MakeSome(to, KIRI_STAGE_REGIONS, quotas);
    if (progress == KIRI_DONE && to->update->placing.sites.count == 0 && !FillCellsOfPart(extraction, piece, to)) {
        return KIRI_FAILED;
    }
    return progress == KIRI_DONE ? kiriPipeline_MakeSome(to, KIRI_STAGE_CONSTANTS, quotas) : progress;
}

enum { VERTICES_AN_ITEM = 8 }; /* of samples: of what passes over all of them, but writes no weights */

/* A step that takes so long with all vertices is paid as a whole. */
static bool PayPass(const kiriSheetData* to, kiriQuotas* quotas)
{
    return kiriQuota_Take(&quotas->of[KIRI_QUOTA_SAMPLES], 1 + to->mesh.vertices.count / VERTICES_AN_ITEM);
}

/* Weights where they are read fastest, before the commit: nothing changes them any more. */
static kiriProgress SortWeightsOfPart(kiriSheetData* to, kiriQuotas* quotas)
{
    kiriSkin* skin = &to->vertexSkin;
    if (skin->staged.count > 0) {
        kiriSkin_Commit(skin);
    }
    if (skin->settling.count > 0) {
        if (!PayPass(to, quotas)) {
            return KIRI_MORE;
        }
        return kiriSkin_Sort(skin, to->memory) ? KIRI_DONE : KIRI_FAILED;
    }
    return KIRI_DONE;
}

enum { SHOWN_ROOMS = 9 };

static void ListShownRooms(kiriSheetData* to, kiriRoom rooms[SHOWN_ROOMS])
{
    kiriMemory* shown = &to->shown;
    kiriSurface* s = &to->seen.surface;
    int64_t vertices = to->mesh.vertices.count, triangles = to->mesh.triangles.count;
    const kiriRoom all[SHOWN_ROOMS] = { KIRI_ROOM(shown, &s->positions, 3 * vertices + 1),
                                        KIRI_ROOM(shown, &s->normals, 3 * vertices),
                                        KIRI_ROOM(shown, &s->slopes, 4 * vertices),
                                        KIRI_ROOM(shown, &s->restPositions, 2 * vertices),
                                        KIRI_ROOM(shown, &s->rest, vertices),
                                        KIRI_ROOM(shown, &s->sourceWeights, 3 * vertices),
                                        KIRI_ROOM(shown, &s->sourceTriangles, vertices),
                                        KIRI_ROOM(shown, &s->indices, 3 * triangles),
                                        KIRI_ROOM(shown, &s->turns, (triangles + 1) / 2) };
    memcpy(rooms, all, sizeof(all));
}

/* The system gives fresh memory when it is written first: so that is done now, and not all at once in the tick in which
   the piece leaves. */
static kiriProgress TouchShownRooms(kiriSheetData* to, kiriQuotas* quotas)
{
    enum { TOUCHED_BYTES = 1024 }; /* for an item */
    kiriRoom rooms[SHOWN_ROOMS];
    kiriQuota* samples = &quotas->of[KIRI_QUOTA_SAMPLES];
    kiriProgress progress = KIRI_DONE;
    ListShownRooms(to, rooms);
    for (int i = 0; progress == KIRI_DONE && i < SHOWN_ROOMS && samples->left < INT64_MAX / 2; ++i) {
        progress = kiriArray_Fill(&rooms[i], samples, TOUCHED_BYTES);
    }
    return progress;
}

/* All that is seen of it but where. */
static kiriProgress WriteTopologyOfPart(kiriSheetData* to, kiriQuotas* quotas)
{
    if (to->seen.surface.vertexCount > 0) {
        return KIRI_DONE;
    }
    kiriProgress progress = TouchShownRooms(to, quotas);
    if (progress != KIRI_DONE) {
        return progress;
    }
    if (!PayPass(to, quotas)) {
        return KIRI_MORE;
    }
    if (!kiriView_Resize(to, to->update->placing.sites.count, to->points.count)) {
        return KIRI_FAILED;
    }
    kiriSurface_WriteTopology(&to->seen.surface, &to->mesh);
    return KIRI_DONE;
}

kiriProgress kiriExtraction_GoOn(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuotas* quotas)
{
    kiriProgress progress = MakeMeshOfPart(extraction, piece, to, &quotas->of[KIRI_QUOTA_CELLS]);
    progress = progress == KIRI_DONE ? MakeFieldsOfPart(extraction, piece, to, quotas) : progress;
    progress = progress == KIRI_DONE ? SortWeightsOfPart(to, quotas) : progress;
    progress = progress == KIRI_DONE ? kiriStage_Owners(to, &quotas->of[KIRI_QUOTA_SAMPLES]) : progress;
    return progress == KIRI_DONE ? WriteTopologyOfPart(to, quotas) : progress;
}

static bool EndPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to)
{
    const kiriSheetData* from = extraction->kept.from;
    PartMembers items = TakeItemsOf(extraction, piece);
    CopySettings(&extraction->kept, to); /* as they are now */
    to->settings.maxFrames = 0;
    to->seen.bounds->patience = from->seen.bounds->patience;
    bool ok = CopyMotion(&extraction->kept, to);
    to->settings.maxFrames = from->settings.maxFrames;
    DropPiece(extraction, piece, &items);
    return ok;
}

bool kiriExtraction_Build(kiriExtraction* extraction, int32_t piece, kiriSheetData* to)
{
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    return kiriExtraction_GoOn(extraction, piece, to, &unlimited) == KIRI_DONE && EndPart(extraction, piece, to);
}

void kiriExtraction_Drop(kiriExtraction* extraction)
{
    if (extraction->kept.from != NULL) {
        kiriMemory_FreeAll(&extraction->kept.memory);
    }
}

/* Did the stages end where sites are found again, though all that this takes memory for is there? Then two sites are in
   one cell. */
static bool IsCrowded(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    return u->stage == KIRI_STAGE_REGIONS && u->step == 0 && u->placing.flags.count >= sheet->grid.cells.count &&
           u->placing.moves.capacity >= sheet->frames.count;
}

/* Are there as many frames as were read, in the same pieces? */
static bool IsLayoutThat(const kiriSheetData* sheet)
{
    const kiriLayout *made = &sheet->update->next, *read = &sheet->layout;
    int32_t frames = sheet->frames.count;
    return sheet->update->placing.sites.count == frames && made->pieces.count == read->pieces.count &&
           memcmp(made->framePiece.data, read->framePiece.data, sizeof(int32_t) * (size_t)frames) == 0;
}

/* Samples without weights, in their squares. */
static bool StartSamples(kiriSheetData* sheet)
{
    kiriSkin *vertices = &sheet->vertexSkin, *points = &sheet->pointSkin;
    bool ok = kiriArray_ResizeJust(sheet->memory, &vertices->spans, sheet->mesh.vertices.count) &&
              kiriArray_ResizeJust(sheet->memory, &points->spans, sheet->points.count) &&
              kiriPlaces_Reserve(&sheet->pointPlaces, sheet->memory, &sheet->mesh, sheet->points.count);
    for (int32_t i = 0; ok && i < vertices->spans.count; ++i) {
        vertices->spans.data[i] = (kiriSpan){ 0, 0 };
    }
    for (int32_t i = 0; ok && i < points->spans.count; ++i) {
        points->spans.data[i] = (kiriSpan){ 0, 0 };
        kiriPlaces_Add(&sheet->pointPlaces, sheet->memory, &sheet->mesh, sheet->points.data[i].at); /* has room */
    }
    return ok;
}

/* The stages from the grid to the owners of material, from scratch, as for a sheet that is made. No frame is added but
   where a piece has none. */
static bool RunStages(kiriSheetData* sheet, bool* isBad)
{
    kiriUpdate* u = sheet->update;
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    int32_t maxFrames = sheet->settings.maxFrames;
    if (!StartSamples(sheet) || !kiriArray_Resize(sheet->memory, &u->placing.sites, sheet->frames.count)) {
        return false;
    }
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        u->placing.sites.data[f] = (kiriSite){ sheet->frames.data[f].site.at, 0 };
    }
    sheet->settings.maxFrames = 0;
    u->isScratch = true;
    u->stage = KIRI_STAGE_GRID;
    bool ok = kiriPipeline_Make(sheet, KIRI_STAGE_CONSTANTS);
    *isBad = (!ok && IsCrowded(sheet)) || (ok && !IsLayoutThat(sheet));
    ok = ok && !*isBad && kiriStage_Owners(sheet, &unlimited.of[KIRI_QUOTA_SAMPLES]) == KIRI_DONE;
    sheet->settings.maxFrames = maxFrames;
    return ok;
}

/* Commits the remade data, like the commit of an update. Saved arrays stay. */
static bool Commit(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriLinks_Commit(&sheet->links);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriOwnership_Commit(&u->refit.ownership, &sheet->mesh);
    kiriShape_ClearChanges(&sheet->shape);
    kiriRefresh_Drop(&u->samples.refresh);
    kiriRefit_Drop(&u->refit);
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        sheet->frames.data[f].site = u->placing.sites.data[f];
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriSample* point = &sheet->points.data[i];
        point->cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, point->at);
        point->frame = sheet->regions.field.owner.data[point->cell];
    }
    u->samples.oldVertices = sheet->mesh.vertices.count;
    u->samples.movedPoints.count = 0;
    u->isScratch = false;
    u->stage = KIRI_NONE;
    u->step = 0;
    u->spent = 0;
    return kiriSkin_Sort(&sheet->vertexSkin, sheet->memory) && kiriSkin_Sort(&sheet->pointSkin, sheet->memory);
}

bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad)
{
    kiriArrayHeader dirty = kiriArray_GetHeader(&sheet->regions.dirty);
    memset(&sheet->regions.dirty, 0, sizeof(sheet->regions.dirty));
    *isBad = false;
    bool ok = RunStages(sheet, isBad) && Commit(sheet) &&
              kiriSurface_RemakeRest(&sheet->seen.surface, &sheet->shown, &sheet->mesh);
    if (ok) {
        memcpy(sheet->regions.dirty.data, dirty.data, (size_t)sheet->frames.count);
    }
    kiriMemory_Free(sheet->memory, dirty.data);
    return ok;
}

bool kiriRemoval_Init(kiriRemoval* removal, kiriSheetData* sheet)
{
    memset(removal, 0, sizeof(*removal));
    removal->sheet = sheet;
    return kiriKept_Init(&removal->kept, sheet);
}

/* ---- Ready ---- */

/* Cells that go, in the order of squares. */
static bool ListCells(kiriRemoval* removal)
{
    const kiriSheetData* sheet = removal->sheet;
    kiriMemory* memory = &removal->kept.memory;
    bool ok = true;
    for (int32_t s = 0; ok && s < sheet->grid.squareCell.count; ++s) {
        bool isListed = false;
        for (int32_t c = sheet->grid.squareCell.data[s]; ok && c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            if (!kiriKeep_Has(&removal->kept.frames, sheet->regions.field.owner.data[c])) {
                ok = kiriArray_Push(memory, &removal->cells, c) &&
                     (isListed || kiriArray_Push(memory, &removal->squares, s));
                isListed = true;
            }
        }
    }
    return ok;
}

static bool ListGathered(kiriRemoval* removal)
{
    kiriGather_Mark(&removal->gathered);
    removal->cells = removal->gathered.cells;
    removal->squares = removal->gathered.squares;
    return kiriKept_LeaveHoles(&removal->kept);
}

static bool StagePieces(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriMemory* scratch = &removal->kept.memory;
    const kiriLayout* layout = &sheet->layout;
    kiriLayout* next = &sheet->update->next;
    kiriKeep pieces;
    next->pieces.count = next->framePiece.count = 0;
    bool ok = kiriKeep_Init(&pieces, scratch, layout->pieces.count) &&
              kiriArray_Reserve(sheet->memory, &next->pieces, layout->pieces.count) &&
              kiriArray_Reserve(sheet->memory, &next->framePiece, layout->framePiece.count);
    for (int32_t p = 0; ok && p < layout->pieces.count; ++p) {
        const kiriPiece* was = &layout->pieces.data[p];
        kiriPiece piece = { .area = was->area,
                            .frame = kiriKeep_To(&removal->kept.frames, was->frame),
                            .origin = KIRI_NONE,
                            .rest = was->rest };
        kiriKeep_Add(&pieces, removal->kept.pieces.data[p] != 0);
        if (removal->kept.pieces.data[p]) {
            next->pieces.data[next->pieces.count++] = piece;
        }
    }
    for (int32_t f = 0; ok && f < layout->framePiece.count; ++f) {
        if (kiriKeep_Has(&removal->kept.frames, f)) {
            next->framePiece.data[next->framePiece.count++] = kiriKeep_To(&pieces, layout->framePiece.data[f]);
        }
    }
    return ok;
}

static bool StagePins(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    const kiriLayout* layout = &sheet->layout;
    kiriLayout* next = &sheet->update->next;
    bool ok = true;
    next->pinFrame.count = next->pinShares.count = next->severed.count = 0;
    for (int32_t i = 0; ok && i < sheet->pins.count; ++i) {
        int32_t frame = kiriKept_FrameOfPin(kept, i);
        ok = frame == KIRI_NONE || kiriArray_Push(sheet->memory, &next->pinFrame, kiriKeep_To(&kept->frames, frame));
    }
    for (int32_t k = 0; ok && k < layout->pinShares.count; ++k) {
        kiriPinShare pinned = layout->pinShares.data[k];
        pinned.pin = kiriKeep_To(&kept->pins, pinned.pin);
        pinned.share.frame = kiriKeep_To(&kept->frames, pinned.share.frame);
        ok = pinned.share.frame == KIRI_NONE || kiriArray_Push(sheet->memory, &next->pinShares, pinned);
    }
    for (int32_t k = 0; ok && k < layout->severed.count; ++k) {
        kiriSeveredLink severed = layout->severed.data[k];
        severed.pin = kiriKeep_To(&kept->pins, severed.pin);
        severed.link = kiriKeep_To(&kept->links, severed.link);
        ok = severed.link == KIRI_NONE || kiriArray_Push(sheet->memory, &next->severed, severed);
    }
    return ok;
}

/* What each touch that is remembered pushed with: of the last tick, and then of pieces that sleep. */
static bool ListForces(kiriRemoval* removal)
{
    const kiriTouches* touches = &removal->sheet->touches;
    int32_t last = touches->last.touches.count, slept = touches->slept.touches.count;
    if (!kiriArray_Resize(&removal->kept.memory, &removal->forces, (int64_t)last + slept)) {
        return false;
    }
    for (int32_t i = 0; i < last + slept; ++i) {
        const kiriTouch* touch = i < last ? &touches->last.touches.data[i] : &touches->slept.touches.data[i - last];
        removal->forces.data[i] = kiriTouches_ForceOf(removal->sheet, touch->key);
    }
    return true;
}

static bool StageLayout(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriAreaElements* elements = &sheet->update->next.areaElements;
    elements->elements.count = elements->shares.count = 0;
    return StagePieces(removal) && StagePins(removal) &&
           kiriAreaElements_Keep(elements, sheet->memory, &sheet->layout.areaElements, &removal->kept.frames) &&
           kiriLinks_Keep(&sheet->links, sheet->memory, &removal->kept.links, &removal->kept.frames);
}

bool kiriRemoval_Gather(kiriRemoval* removal)
{
    const kiriGathered* known = kiriAhead_Gathered(removal->sheet, removal->kept.pieces.data);
    if (known != NULL) {
        removal->gathered = *known;
    }
    return known != NULL ||
           kiriGather_Make(&removal->gathered, removal->sheet, &removal->kept.memory, removal->kept.pieces.data);
}

enum { SMALL_SHEET = 4096 }; /* vertices: a pass over them takes no longer than a tick */

bool kiriRemoval_IsWorthAPass(const kiriSheetData* sheet, double share)
{
    int32_t vertices = sheet->mesh.vertices.count, holes = sheet->mesh.vertexHoles;
    return vertices <= SMALL_SHEET || 2.0 * (holes + share * (vertices - holes)) > vertices;
}

double kiriRemoval_Samples(const kiriSheetData* sheet, double share)
{
    enum {
        RENUMBERED_VERTICES = 80,
        PASSED_VERTICES = 12
    }; /* for one: owners get other indices, and what a host holds is copied; all moves together */
    const kiriMeshData* mesh = &sheet->mesh;
    double vertices = (double)mesh->vertices.count - mesh->vertexHoles;
    double pass = kiriRemoval_IsWorthAPass(sheet, share) ? vertices / PASSED_VERTICES : 0.0;
    return 1.0 + vertices / RENUMBERED_VERTICES + pass;
}

static bool StageLabels(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriLabels* labels = &sheet->shape.labels;
    if (removal->leavesHoles) {
        return kiriLabels_Reserve(labels, sheet->memory, sheet->frames.count);
    }
    bool ok = kiriKeep_Init(&removal->labels, &removal->kept.memory, kiriLabels_Count(labels, sheet->frames.count));
    if (ok) {
        kiriLabels_Map(labels, &removal->kept.frames, &removal->labels);
    }
    return ok;
}

static bool StageItems(kiriRemoval* removal)
{
    const kiriKept* kept = &removal->kept;
    return removal->leavesHoles
               ? ListGathered(removal)
               : kiriKept_Map(&removal->kept) && ListCells(removal) &&
                     kiriShown_Reserve(&removal->shown, &removal->sheet->shown, &kept->triangles, &kept->vertices);
}

bool kiriRemoval_Stage(kiriRemoval* removal, bool leavesHoles)
{
    kiriSheetData* sheet = removal->sheet;
    KIRI_ASSERT(kiriUpdate_IsFieldCurrent(sheet->update));
    kiriGather_Pause(sheet);
    removal->leavesHoles = leavesHoles;
    return StageItems(removal) && StageLabels(removal) && ListForces(removal) && StageLayout(removal) &&
           kiriArray_Reserve(&sheet->shown, &removal->points, 3 * (int64_t)removal->kept.points.count) &&
           kiriStage_Solver(sheet, removal->kept.frames.count);
}

/* ---- Gone ---- */

/* What labels become, where all is passed over in any case. */
static const kiriKeep* LabelsOf(const kiriRemoval* removal)
{
    return removal->leavesHoles ? NULL : &removal->labels;
}

static void KeepMesh(kiriRemoval* removal)
{
    kiriMeshData* mesh = &removal->sheet->mesh;
    const kiriKept* kept = &removal->kept;
    const kiriGathered* gone = &removal->gathered;
    if (removal->leavesHoles) {
        const kiriMeshLoss loss = { &gone->triangles, &gone->vertices, &gone->squares, kept->triangles,
                                    kept->vertices };
        kiriMesh_LeaveHoles(mesh, &loss);
    } else {
        kiriMesh_Keep(mesh, &kept->triangles, &kept->vertices, removal->squares.data, removal->squares.count);
    }
}

static void KeepFields(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    const int32_t *cells = removal->cells.data, *squares = removal->squares.data;
    int32_t cellCount = removal->cells.count, squareCount = removal->squares.count;
    KeepMesh(removal);
    kiriGrid_Keep(&sheet->grid, sheet->memory, &kept->triangles, &kept->vertices, cells, cellCount);
    kiriRegions_Keep(&sheet->regions, &kept->frames, cells, cellCount);
    kiriShape_Keep(&sheet->shape, sheet->memory, &kept->frames, LabelsOf(removal), cells, cellCount);
    kiriOwnership_Keep(&sheet->update->refit.ownership, &sheet->grid, &sheet->mesh, &sheet->regions, &kept->triangles,
                       &kept->frames, squares, squareCount);
}

static void KeepPoints(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriKeep_Compact(&removal->kept.points, &sheet->points, 1, sizeof(kiriSample));
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        sheet->points.data[i].frame = kiriKeep_To(&removal->kept.frames, sheet->points.data[i].frame);
    }
    kiriPlaces_Keep(&sheet->pointPlaces, &removal->kept.points);
    kiriSkin_Keep(&sheet->pointSkin, &removal->kept.points, LabelsOf(removal));
    if (removal->leavesHoles) {
        kiriSkin_LeaveHoles(&sheet->vertexSkin, &removal->gathered.vertices);
    } else {
        kiriSkin_Keep(&sheet->vertexSkin, &removal->kept.vertices, LabelsOf(removal));
    }
}

static void KeepContacts(const kiriKept* kept, kiriSheetData* sheet)
{
    int32_t left = 0;
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        kiriGivenContact given = sheet->contacts.data[i];
        if (kiriKept_FollowContact(kept, &given)) {
            sheet->contacts.data[left++] = given;
        }
    }
    sheet->contacts.count = left;
}

/* Forces go by keys, and keys by indices: they are remembered anew. */
static void KeepTouches(kiriRemoval* removal, kiriTouchMemory* memory, const kiriVec3* forces)
{
    int32_t count = memory->touches.count;
    memory->touches.count = memory->forces.count = memory->given = 0;
    for (int32_t i = 0; i < count; ++i) {
        kiriTouch touch = memory->touches.data[i];
        if (kiriKept_FollowTouch(&removal->kept, &touch)) {
            kiriTouchMemory_Add(memory, &touch, forces[i]);
        }
    }
    kiriTouchMemory_SortForces(memory, 0, &removal->sheet->touches.order);
}

/* What the sheet keeps of its pieces from tick to tick, beside fields and what is staged: state that is new belongs
   here, and into kiri_detach.c. */
static void KeepState(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriUpdate* u = sheet->update;
    const kiriKept* kept = &removal->kept;
    kiriKeep_Compact(&kept->frames, &sheet->frames, 1, sizeof(kiriFrameData));
    kiriKeep_Compact(&kept->frames, &u->material, 1, sizeof(kiriMoments));
    kiriKeep_Compact(&kept->frames, &u->placing.sites, 1, sizeof(kiriSite));
    kiriKeep_Compact(&kept->pins, &sheet->pins, 1, sizeof(kiriPinData));
    kiriKeep_Compact(&kept->links, &sheet->strainOffsets.strainOffsets, 1, sizeof(kiriStrainOffset));
    KeepContacts(kept, sheet);
    int32_t last = sheet->touches.last.touches.count;
    KeepTouches(removal, &sheet->touches.last, removal->forces.data);
    KeepTouches(removal, &sheet->touches.slept, removal->forces.data + last);
    sheet->touches.rests.areSummed = false;
    kiriFades_Keep(&sheet->seen.fades, &kept->vertices);
    kiriFades_Keep(&sheet->seen.pointFades, &kept->points);
    u->samples.oldVertices = sheet->mesh.vertices.count;
}

static void KeepSettings(kiriRemoval* removal)
{
    kiriSettings* settings = &removal->sheet->settings;
    double share = kiriKept_Share(&removal->kept);
    settings->collisionPoints *= share;
    settings->integrationPoints *= share;
}

static void MoveBlade(const kiriRemoval* removal, kiriBladeTip* blade)
{
    blade->vertex = kiriKeep_To(&removal->kept.vertices, blade->vertex);
}

static void MoveBlades(const kiriRemoval* removal)
{
    for (int32_t i = 0; i < removal->sheet->cuts.count; ++i) {
        kiriCutData* cut = removal->sheet->cuts.data[i];
        MoveBlade(removal, &cut->tip.blade);
        MoveBlade(removal, &cut->committed.blade);
    }
}

/* What is staged comes in force, as in kiriStage_Commit. */
static void CommitStaged(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriLayout layout = sheet->layout;
    kiriLinks_Commit(&sheet->links);
    kiriSolver_Commit(sheet->solver);
    sheet->layout = sheet->update->next;
    sheet->update->next = layout;
    kiriPins_WriteLinkParts(sheet);
    kiriPins_SumShares(sheet);
    kiriMotion_SumRest(sheet);
}

static void ReplaceFloats(void* array, void* fresh, kiriMemory* retired)
{
    kiriArrayHeader was = kiriArray_GetHeader(array);
    kiriArray_SetHeader(array, kiriArray_GetHeader(fresh));
    kiriMemory_Adopt(retired, was.data);
}

static void KeepSurface(kiriRemoval* removal, kiriMemory* retired)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    if (removal->leavesHoles) {
        kiriSurface_LeaveHoles(&sheet->seen.surface, &removal->gathered.triangles, &sheet->mesh, kept->frames.count);
        kiriBlocks_LeaveHoles(&sheet->seen.blocks, &removal->gathered.vertices, &kept->frames);
    } else {
        kiriBlocks_Forget(&sheet->seen.blocks);
        kiriSurface_Keep(&sheet->seen.surface, &removal->shown, &kept->triangles, &kept->vertices, &sheet->mesh,
                         kept->frames.count, retired);
        kiriBounds_Forget(sheet->seen.bounds);
        sheet->seen.vertexCount = kept->vertices.count;
    }
}

static void KeepSeen(kiriRemoval* removal, kiriMemory* retired)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    KeepSurface(removal, retired);
    kiriBlocks_Truncate(&sheet->seen.blocks, sheet->seen.surface.vertexCount, sheet->frames.count);
    kiriKeep_Compact(&kept->points, &sheet->seen.exactPoints, 1, sizeof(kiriVec3));
    if (sheet->seen.pointPositions.count > 0) {
        kiriKeep_Copy(&kept->points, removal->points.data, sheet->seen.pointPositions.data, 3 * sizeof(float));
        removal->points.count = 3 * kept->points.count;
    }
    ReplaceFloats(&sheet->seen.pointPositions, &removal->points, retired);
    sheet->seen.pointCount = kept->points.count;
}

static void KeepLists(kiriRemoval* removal, kiriMemory* retired)
{
    kiriPieceLists* lists = &removal->sheet->lists;
    if (removal->leavesHoles) {
        kiriPieceLists_LeaveHoles(lists, removal->kept.pieces.data, retired);
    } else {
        kiriPieceLists_Retire(lists, retired);
    }
}

void kiriRemoval_Commit(kiriRemoval* removal, kiriMemory* retired)
{
    KeepSettings(removal); /* by the layout as it is */
    KeepFields(removal);
    KeepPoints(removal);
    KeepState(removal);
    CommitStaged(removal);
    MoveBlades(removal);
    KeepSeen(removal, retired);
    KeepLists(removal, retired);
    removal->sheet->probes.isFresh = false;
    memset(&removal->shown, 0, sizeof(removal->shown));
    memset(&removal->points, 0, sizeof(removal->points));
}

void kiriRemoval_Drop(kiriRemoval* removal)
{
    if (removal->sheet != NULL) {
        kiriGather_Unmark(&removal->gathered);
        kiriShown_Release(&removal->shown, &removal->sheet->shown);
        kiriArray_Release(&removal->sheet->shown, &removal->points);
        kiriMemory_FreeAll(&removal->kept.memory);
    }
}
