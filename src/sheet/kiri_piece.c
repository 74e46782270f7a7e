#include "kiri_piece.h"

#include "../core/kiri_union_find.h"
#include "kiri_motion.h"

#include <string.h>

/* ---- Coming off ---- */

/* Regions that links join are one piece, and others are not. */
static bool JoinFrames(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (!kiriArray_Resize(sheet->memory, &u->parent, u->placing.sites.count)) {
        return false;
    }
    kiriUnion_Init(u->parent.data, u->placing.sites.count);
    for (int32_t k = 0; k < sheet->links.next.count; ++k) {
        kiriUnion_Join(u->parent.data, sheet->links.next.data[k].i, sheet->links.next.data[k].j);
    }
    return true;
}

int32_t kiriPiece_OfVertex(const kiriSheetData* sheet, int32_t vertex)
{
    int32_t first = sheet->vertexSkin.spans.data[vertex].first;
    return sheet->layout.framePiece.data[sheet->vertexSkin.weights.data[first].frame];
}

/* The old piece that the material of a frame was in: of a new one, that of a frame which moves it on the old
   surface. */
static int32_t OriginOf(const kiriSheetData* sheet, int32_t frame)
{
    if (frame < sheet->frames.count) {
        return sheet->layout.framePiece.data[frame];
    }
    if (sheet->frames.count == 0) {
        return KIRI_NONE;
    }
    int32_t triangle = sheet->grid.cells.data[sheet->update->placing.sites.data[frame].cell].triangle;
    return kiriPiece_OfVertex(sheet, sheet->mesh.triangles.data[triangle].vertex[0]);
}

/* Of the parts of one old piece the largest goes on, and the others came off. */
static void MarkCameOff(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    int32_t* largest = sheet->update->parent.data; /* of each origin; there are no more of them than frames */
    for (int32_t o = 0; o < sheet->layout.pieces.count; ++o) {
        largest[o] = KIRI_NONE;
    }
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        int32_t o = next->pieces.data[p].origin;
        if (o != KIRI_NONE &&
            (largest[o] == KIRI_NONE || next->pieces.data[p].area > next->pieces.data[largest[o]].area)) {
            largest[o] = p;
        }
    }
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        kiriPiece* piece = &next->pieces.data[p];
        piece->cameOff = piece->origin != KIRI_NONE && largest[piece->origin] != p;
    }
}

bool kiriPieces_Stage(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriLayout* next = &u->next;
    next->pieces.count = 0;
    if (!JoinFrames(sheet) || !kiriArray_Resize(sheet->memory, &next->framePiece, u->placing.sites.count)) {
        return false;
    }
    for (int32_t i = 0; i < u->placing.sites.count; ++i) {
        int32_t root = kiriUnion_Root(u->parent.data, i);
        if (root == i) {
            kiriPiece piece = { 0.0, i, OriginOf(sheet, i), false, false };
            next->framePiece.data[i] = next->pieces.count;
            if (!kiriArray_Push(sheet->memory, &next->pieces, piece)) {
                return false;
            }
        }
        next->framePiece.data[i] = next->framePiece.data[root];
        next->pieces.data[next->framePiece.data[i]].area += u->material.data[i].area;
    }
    MarkCameOff(sheet);
    return true;
}

bool kiriPieces_AnyGone(const kiriSheetData* sheet)
{
    bool any = false;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        any = any || sheet->layout.pieces.data[p].isGone;
    }
    return any;
}

void kiriPieces_KeepGone(kiriSheetData* sheet, const kiriLayout* old)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriPiece* piece = &sheet->layout.pieces.data[p];
        piece->isGone = piece->origin != KIRI_NONE && old->pieces.data[piece->origin].isGone;
    }
}

/* ---- Lists ---- */

/* Sorts 0 to count - 1 by their pieces; what is of one piece stays in its order. */
static bool SortByPiece(kiriSheetData* sheet, kiriPieceList* list, const int32_t* pieceOf, int32_t count)
{
    int32_t pieces = sheet->layout.pieces.count;
    if (!kiriArray_Resize(&sheet->shown, &list->first, pieces + 2) ||
        !kiriArray_Resize(&sheet->shown, &list->items, count)) {
        return false;
    }
    int32_t* first = list->first.data;
    memset(first, 0, sizeof(int32_t) * (size_t)(pieces + 2));
    for (int32_t i = 0; i < count; ++i) {
        first[pieceOf[i] + 2] += 1;
    }
    for (int32_t p = 0; p < pieces; ++p) {
        first[p + 2] += first[p + 1];
    }
    for (int32_t i = 0; i < count; ++i) {
        list->items.data[first[pieceOf[i] + 1]++] = i;
    }
    return true;
}

/* `vertexPiece` has room for a number a vertex, `other` for one a triangle or collision point. */
static bool SortAll(kiriSheetData* sheet, int32_t* vertexPiece, int32_t* other)
{
    kiriPieceLists* lists = &sheet->lists;
    const int32_t* framePiece = sheet->layout.framePiece.data;
    const kiriMeshData* mesh = &sheet->mesh;
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        vertexPiece[v] = kiriPiece_OfVertex(sheet, v);
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        other[t] = vertexPiece[mesh->triangles.data[t].vertex[0]];
    }
    if (!SortByPiece(sheet, &lists->triangles, other, mesh->triangles.count)) {
        return false;
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        other[i] = framePiece[sheet->points.data[i].frame];
    }
    return SortByPiece(sheet, &lists->points, other, sheet->points.count) &&
           SortByPiece(sheet, &lists->vertices, vertexPiece, mesh->vertices.count) &&
           SortByPiece(sheet, &lists->frames, framePiece, sheet->frames.count);
}

/* What the host reads beside: the ids of frames, and the corners of triangles. */
static bool FillHostArrays(kiriSheetData* sheet)
{
    kiriPieceLists* lists = &sheet->lists;
    int32_t frames = lists->frames.items.count, triangles = lists->triangles.items.count;
    if (!kiriArray_Resize(&sheet->shown, &lists->ids, frames) ||
        !kiriArray_Resize(&sheet->shown, &lists->corners, 3 * (int64_t)triangles)) {
        return false;
    }
    for (int32_t i = 0; i < frames; ++i) {
        lists->ids.data[i] = sheet->frames.data[lists->frames.items.data[i]].id;
    }
    for (int32_t i = 0; i < triangles; ++i) {
        const kiriTriangle* t = &sheet->mesh.triangles.data[lists->triangles.items.data[i]];
        memcpy(&lists->corners.data[3 * (size_t)i], t->vertex, sizeof(t->vertex));
    }
    return true;
}

bool kiriPieces_List(kiriSheetData* sheet)
{
    int64_t vertices = sheet->mesh.vertices.count, triangles = sheet->mesh.triangles.count;
    int64_t others = triangles > sheet->points.count ? triangles : sheet->points.count;
    if (!sheet->lists.isFresh) {
        int32_t* scratch = kiriMemory_Alloc(sheet->memory, (vertices + others) * (int64_t)sizeof(int32_t));
        sheet->lists.isFresh = scratch != NULL && SortAll(sheet, scratch, scratch + vertices) && FillHostArrays(sheet);
        kiriMemory_Free(sheet->memory, scratch);
    }
    return sheet->lists.isFresh;
}

kiriSpan kiriPiece_Span(const kiriPieceList* list, int32_t piece)
{
    int32_t first = list->first.data[piece];
    return (kiriSpan){ first, list->first.data[piece + 1] - first };
}

/* ---- State ---- */

/* The least box around the vertices as they are seen. */
static void Bound(const kiriSheetData* sheet, kiriSpan span, float lower[3], float upper[3])
{
    for (int32_t i = span.first; i < span.first + span.count; ++i) {
        const float* x = &sheet->seen.surface.positions.data[3 * (size_t)sheet->lists.vertices.items.data[i]];
        for (int k = 0; k < 3; ++k) {
            lower[k] = i == span.first || x[k] < lower[k] ? x[k] : lower[k];
            upper[k] = i == span.first || x[k] > upper[k] ? x[k] : upper[k];
        }
    }
}

kiriPieceState kiriPiece_State(const kiriSheetData* sheet, int32_t piece)
{
    const kiriPieceLists* lists = &sheet->lists;
    kiriSpan frames = kiriPiece_Span(&lists->frames, piece), vertices = kiriPiece_Span(&lists->vertices, piece);
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
    state.triangles = kiriPiece_Span(&lists->triangles, piece).count;
    state.crumb = sheet->layout.pieces.data[piece].area < sheet->settings.crumbArea;
    state.collisionPoints = kiriPiece_Span(&lists->points, piece).count;
    return state;
}
