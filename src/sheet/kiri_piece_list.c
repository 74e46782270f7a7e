#include "kiri_piece_list.h"

#include "kiri_motion.h"

#include <string.h>

/* ---- Rows ---- */

/* Spans for so many pieces, all empty. False for memory. */
static bool StartSpans(kiriPieceItems* list, kiriMemory* memory, int32_t pieceCount)
{
    if (!kiriArray_Resize(memory, &list->spans, pieceCount)) {
        return false;
    }
    for (int32_t p = 0; p < pieceCount; ++p) {
        list->spans.data[p] = (kiriSpan){ 0, 0 };
    }
    return true;
}

static void CountOfPiece(kiriPieceItems* list, int32_t piece, int32_t count)
{
    if (piece != KIRI_NONE) {
        list->spans.data[piece].count += count;
    }
}

/* Items that follow each other are of one piece mostly: so they are counted and listed by runs. */
static int32_t EndOfEqualPieces(const int32_t* pieces, int32_t first, int32_t count)
{
    int32_t end = first + 1;
    while (end < count && pieces[end] == pieces[first]) {
        ++end;
    }
    return end;
}

static void CountAll(kiriPieceItems* list, const int32_t* pieces, int32_t count)
{
    for (int32_t first = 0, end; first < count; first = end) {
        end = EndOfEqualPieces(pieces, first, count);
        CountOfPiece(list, pieces[first], end - first);
    }
}

/* All are counted: spans lie one after the other. Returns how many items there are. */
static int32_t PlaceSpans(kiriPieceItems* list)
{
    int32_t count = 0;
    for (int32_t p = 0; p < list->spans.count; ++p) {
        list->spans.data[p].first = count;
        count += list->spans.data[p].count;
    }
    return count;
}

/* Room for the items, and where those of each piece begin, which the caller moves on from item to item; null for
   memory. */
static int32_t* StartItems(kiriPieceItems* list, kiriMemory* memory, int32_t count)
{
    if (!kiriArray_Resize(memory, &list->items, count)) {
        return NULL;
    }
    int32_t* next = kiriMemory_Alloc(memory, (int64_t)sizeof(int32_t) * list->spans.count);
    for (int32_t p = 0; next != NULL && p < list->spans.count; ++p) {
        next[p] = list->spans.data[p].first;
    }
    return next;
}

static int32_t ListRun(int32_t* items, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; ++i) {
        items[i - first] = i;
    }
    return end - first;
}

/* Items in their order. `pieces` has that of each, KIRI_NONE where it is in none. The spans count them. False for
   memory. */
static bool FillItems(kiriPieceItems* list, kiriMemory* memory, const int32_t* pieces, int32_t count)
{
    int32_t* next = StartItems(list, memory, PlaceSpans(list));
    for (int32_t first = 0, end; next != NULL && first < count; first = end) {
        end = EndOfEqualPieces(pieces, first, count);
        if (pieces[first] != KIRI_NONE) {
            next[pieces[first]] += ListRun(list->items.data + next[pieces[first]], first, end);
        }
    }
    kiriMemory_Free(memory, next);
    return next != NULL;
}

/* ---- Frames and collision points ---- */

/* The piece of an item. */
typedef int32_t PieceOfItemFn(const kiriSheetData* sheet, int32_t item);

static int32_t PieceOfListedFrame(const kiriSheetData* sheet, int32_t frame)
{
    return sheet->layout.framePiece.data[frame];
}

static int32_t PieceOfListedPoint(const kiriSheetData* sheet, int32_t point)
{
    return sheet->layout.framePiece.data[sheet->points.data[point].frame];
}

static bool ListFew(kiriSheetData* sheet, kiriPieceItems* list, int32_t count, PieceOfItemFn* pieceOf)
{
    kiriMemory* memory = &sheet->shown;
    int32_t* pieces = kiriMemory_Alloc(memory, (int64_t)sizeof(int32_t) * count);
    bool ok = pieces != NULL && StartSpans(list, memory, sheet->layout.pieces.count);
    for (int32_t i = 0; ok && i < count; ++i) {
        pieces[i] = pieceOf(sheet, i);
    }
    if (ok) {
        CountAll(list, pieces, count);
    }
    ok = ok && FillItems(list, memory, pieces, count);
    kiriMemory_Free(memory, pieces);
    return ok;
}

static bool NameFrames(kiriSheetData* sheet)
{
    kiriPieceLists* lists = &sheet->lists;
    if (!kiriArray_Resize(&sheet->shown, &lists->ids, lists->frames.items.count)) {
        return false;
    }
    for (int32_t i = 0; i < lists->ids.count; ++i) {
        lists->ids.data[i] = sheet->frames.data[lists->frames.items.data[i]].id;
    }
    return true;
}

bool kiriPieces_ListFrames(kiriSheetData* sheet)
{
    kiriPieceLists* lists = &sheet->lists;
    lists->hasFrames = lists->hasFrames ||
                       (ListFew(sheet, &lists->frames, sheet->frames.count, PieceOfListedFrame) &&
                        ListFew(sheet, &lists->points, sheet->points.count, PieceOfListedPoint) && NameFrames(sheet));
    return lists->hasFrames;
}

/* ---- Vertices and triangles ---- */

/* By its corners as they are seen: those of a hole, and of what is hidden, are one vertex. */
static int32_t PieceOfCorners(const int32_t* corners, const int32_t* vertexPieces)
{
    return corners[0] != corners[1] ? vertexPieces[corners[0]] : KIRI_NONE;
}

enum { UNSEEN_PIECE = -2 };

/* Corners are of one piece. Most triangles have a corner that an earlier one has: so its piece is known, and weights
   are looked at for a few only. */
static int32_t SpreadPiece(const kiriSheetData* sheet, const int32_t* corners, int32_t* pieces)
{
    int32_t piece = pieces[corners[0]];
    if (piece == pieces[corners[1]] && piece == pieces[corners[2]] && piece != UNSEEN_PIECE) {
        return piece;
    }
    for (int k = 1; k < 3 && piece == UNSEEN_PIECE; ++k) {
        piece = pieces[corners[k]];
    }
    piece = piece == UNSEEN_PIECE ? kiriPiece_OfVertex(sheet, corners[0]) : piece;
    pieces[corners[0]] = pieces[corners[1]] = pieces[corners[2]] = piece;
    return piece;
}

/* Counts triangles, and gives their pieces to their corners. */
static void CountTriangles(kiriSheetData* sheet, int32_t* pieces)
{
    const int32_t* corners = sheet->seen.surface.indices.data;
    int32_t last = KIRI_NONE, run = 0;
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t, corners += 3) {
        int32_t piece = corners[0] != corners[1] ? SpreadPiece(sheet, corners, pieces) : KIRI_NONE;
        if (piece != last) {
            CountOfPiece(&sheet->lists.triangles, last, run);
            last = piece;
            run = 0;
        }
        run += 1;
    }
    CountOfPiece(&sheet->lists.triangles, last, run);
    PlaceSpans(&sheet->lists.triangles);
}

/* The piece of each vertex, by the triangles; of those that are seen in none by its weights. */
static void FindVertexPieces(kiriSheetData* sheet, int32_t* pieces, int32_t count)
{
    for (int32_t v = 0; v < count; ++v) {
        pieces[v] = UNSEEN_PIECE;
    }
    CountTriangles(sheet, pieces);
    for (int32_t v = 0; v < count; ++v) {
        if (pieces[v] == UNSEEN_PIECE) {
            pieces[v] = kiriPiece_OfVertex(sheet, v);
        }
    }
}

static bool ListAllVertices(kiriSheetData* sheet)
{
    kiriPieceLists* lists = &sheet->lists;
    kiriMemory* memory = &sheet->shown;
    int32_t count = sheet->mesh.vertices.count, pieceCount = sheet->layout.pieces.count;
    int32_t* pieces = kiriMemory_Alloc(memory, (int64_t)sizeof(int32_t) * count);
    bool ok = pieces != NULL && StartSpans(&lists->vertices, memory, pieceCount) &&
              StartSpans(&lists->triangles, memory, pieceCount);
    if (ok) {
        FindVertexPieces(sheet, pieces, count);
        CountAll(&lists->vertices, pieces, count);
    }
    ok = ok && FillItems(&lists->vertices, memory, pieces, count);
    kiriMemory_Free(memory, pieces);
    return ok;
}

bool kiriPieces_ListVertices(kiriSheetData* sheet)
{
    sheet->lists.hasVertices = sheet->lists.hasVertices || ListAllVertices(sheet);
    return sheet->lists.hasVertices;
}

/* By the lists of vertices. */
static void WriteVertexPieces(const kiriPieceItems* vertices, int32_t* pieces)
{
    for (int32_t p = 0; p < vertices->spans.count; ++p) {
        kiriSpan span = vertices->spans.data[p];
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            pieces[vertices->items.data[i]] = p;
        }
    }
}

/* Where the items of all pieces end. */
static int32_t EndOfSpans(const kiriPieceItems* list)
{
    int32_t end = 0;
    for (int32_t p = 0; p < list->spans.count; ++p) {
        kiriSpan span = list->spans.data[p];
        end = kiriMax(span.first + span.count, end);
    }
    return end;
}

static void FillTriangles(kiriSheetData* sheet, int32_t* next, const int32_t* vertexPieces)
{
    kiriPieceLists* lists = &sheet->lists;
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        const int32_t* corners = sheet->seen.surface.indices.data + 3 * (size_t)t;
        int32_t piece = PieceOfCorners(corners, vertexPieces);
        if (piece != KIRI_NONE) {
            int32_t at = next[piece]++;
            lists->triangles.items.data[at] = t;
            memcpy(&lists->corners.data[3 * (size_t)at], corners, 3 * sizeof(int32_t));
        }
    }
}

static bool ListAllTriangles(kiriSheetData* sheet)
{
    kiriPieceLists* lists = &sheet->lists;
    kiriMemory* memory = &sheet->shown;
    int32_t count = EndOfSpans(&lists->triangles);
    int32_t* pieces = kiriMemory_Alloc(memory, (int64_t)sizeof(int32_t) * sheet->mesh.vertices.count);
    int32_t* next = pieces != NULL && kiriArray_Resize(memory, &lists->corners, 3 * (int64_t)count)
                        ? StartItems(&lists->triangles, memory, count)
                        : NULL;
    if (next != NULL) {
        WriteVertexPieces(&lists->vertices, pieces);
        FillTriangles(sheet, next, pieces);
    }
    kiriMemory_Free(memory, next);
    kiriMemory_Free(memory, pieces);
    return next != NULL;
}

bool kiriPieces_ListTriangles(kiriSheetData* sheet)
{
    sheet->lists.hasTriangles =
        sheet->lists.hasTriangles || (kiriPieces_ListVertices(sheet) && ListAllTriangles(sheet));
    return sheet->lists.hasTriangles;
}

kiriSpan kiriPieceItems_Of(const kiriPieceItems* list, int32_t piece)
{
    return list->spans.data[piece];
}

/* ---- Pieces that go ---- */

static void KeepSpans(kiriPieceItems* list, const uint8_t* stays)
{
    int32_t count = 0;
    for (int32_t p = 0; p < list->spans.count; ++p) {
        if (stays[p]) {
            list->spans.data[count++] = list->spans.data[p];
        }
    }
    list->spans.count = count;
}

/* The host may hold the items. */
static void RetireItems(kiriPieceItems* list, kiriMemory* retired)
{
    kiriMemory_Adopt(retired, list->spans.data);
    kiriMemory_Adopt(retired, list->items.data);
    memset(list, 0, sizeof(*list));
}

void kiriPieceLists_LeaveHoles(kiriPieceLists* lists, const uint8_t* stays, kiriMemory* retired)
{
    RetireItems(&lists->frames, retired);
    RetireItems(&lists->points, retired);
    kiriMemory_Adopt(retired, lists->ids.data);
    memset(&lists->ids, 0, sizeof(lists->ids));
    lists->hasFrames = false;
    if (lists->hasVertices) {
        KeepSpans(&lists->vertices, stays);
        KeepSpans(&lists->triangles, stays);
    }
}

void kiriPieceLists_Retire(kiriPieceLists* lists, kiriMemory* retired)
{
    kiriPieceItems* all[] = { &lists->frames, &lists->vertices, &lists->triangles, &lists->points };
    for (int i = 0; i < 4; ++i) {
        RetireItems(all[i], retired);
    }
    kiriMemory_Adopt(retired, lists->ids.data);
    kiriMemory_Adopt(retired, lists->corners.data);
    memset(lists, 0, sizeof(*lists));
}

/* ---- State ---- */

/* The least box around the vertices as they are seen. */
static void Bound(const kiriSheetData* sheet, kiriSpan span, float lower[3], float upper[3])
{
    const int32_t* vertices = sheet->lists.vertices.items.data + span.first;
    const float* positions = sheet->seen.surface.positions.data;
    if (span.count == 0) {
        return;
    }
    float least[3], most[3];
    memcpy(least, positions + 3 * (size_t)vertices[0], sizeof(least));
    memcpy(most, least, sizeof(most));
    for (int32_t i = 1; i < span.count; ++i) {
        const float* x = positions + 3 * (size_t)vertices[i];
        for (int k = 0; k < 3; ++k) {
            least[k] = kiriMin(x[k], least[k]);
            most[k] = kiriMax(x[k], most[k]);
        }
    }
    memcpy(lower, least, sizeof(least));
    memcpy(upper, most, sizeof(most));
}

kiriPieceState kiriPiece_State(const kiriSheetData* sheet, int32_t piece)
{
    const kiriPieceLists* lists = &sheet->lists;
    kiriSpan frames = kiriPieceItems_Of(&lists->frames, piece), vertices = kiriPieceItems_Of(&lists->vertices, piece);
    if (sheet->layout.pieces.data[piece].isGone) {
        return (kiriPieceState){ 0 };
    }
    kiriTotals totals = kiriMotion_Sum(sheet, lists->frames.items.data + frames.first, frames.count);
    kiriPieceState state;
    memset(&state, 0, sizeof(state));
    state.area = totals.area;
    state.mass = totals.mass;
    memcpy(state.center, totals.center, sizeof(state.center));
    memcpy(state.momentum, totals.momentum, sizeof(state.momentum));
    memcpy(state.angularMomentum, totals.angularMomentum, sizeof(state.angularMomentum));
    Bound(sheet, vertices, state.lower, state.upper);
    state.frames = frames.count;
    state.vertices = vertices.count;
    state.triangles = kiriPieceItems_Of(&lists->triangles, piece).count;
    state.crumb = sheet->layout.pieces.data[piece].area < sheet->settings.crumbArea;
    state.asleep = sheet->layout.pieces.data[piece].rest.asleep;
    state.collisionPoints = kiriPieceItems_Of(&lists->points, piece).count;
    return state;
}
