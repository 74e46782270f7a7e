#include "kiri_piece.h"
#include "../core/kiri_array.h"
#include "kiri_motion.h"
#include "kiri_touch.h"
#include "kiri_detach.h"

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
            kiriPiece piece = { .frame = i, .origin = OriginOf(sheet, i) };
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

/* ---- Which a cut touches ---- */

static kiriPiece* NextOfFrame(const kiriSheetData* sheet, int32_t frame)
{
    const kiriLayout* next = &sheet->update->next;
    return &next->pieces.data[next->framePiece.data[frame]];
}

/* Is its region the same, and its site? Regions are dirty beside a cut, too. */
static bool IsSameFrame(const kiriSheetData* sheet, int32_t i)
{
    const kiriUpdate* u = sheet->update;
    const kiriFrameData* frame = &sheet->frames.data[i];
    const kiriSite* site = &u->placing.sites.data[i];
    kiriVec2 center = kiriMoments_Center(&u->material.data[i]);
    kiriMoments about = kiriMoments_About(&u->material.data[i], center);
    double density = (double)sheet->settings.material.density * sheet->settings.material.thickness;
    return site->at.x == frame->site.at.x && site->at.y == frame->site.at.y && frame->center.x == center.x &&
           frame->center.y == center.y && frame->area == u->material.data[i].area &&
           frame->inertia[0] == density * about.uu && frame->inertia[1] == density * about.uv &&
           frame->inertia[2] == density * about.vv;
}

static void TouchByFrames(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->update->placing.sites.count; ++i) {
        bool isNew = i >= sheet->frames.count;
        if (isNew || (sheet->regions.dirty.data[i] && !IsSameFrame(sheet, i))) {
            NextOfFrame(sheet, i)->isTouched = true;
        }
    }
}

static bool IsEarlierLink(const kiriLink* a, const kiriLink* b)
{
    return a->i != b->i ? a->i < b->i : a->j < b->j;
}

/* Links come in one order. */
static void TouchByLinks(kiriSheetData* sheet)
{
    int32_t o = 0, n = 0, oldCount = sheet->links.links.count, nextCount = sheet->links.next.count;
    while (o < oldCount || n < nextCount) {
        const kiriLink *old = &sheet->links.links.data[o], *next = &sheet->links.next.data[n];
        bool isGone = n == nextCount || (o < oldCount && IsEarlierLink(old, next));
        bool isNew = !isGone && (o == oldCount || IsEarlierLink(next, old));
        if (isGone || isNew || memcmp(old, next, sizeof(*old)) != 0) {
            NextOfFrame(sheet, isGone ? old->i : next->i)->isTouched = true;
            NextOfFrame(sheet, isGone ? old->j : next->j)->isTouched = true;
        }
        o += !isNew;
        n += !isGone;
    }
}

/* Samples beside a cut are weighed anew, too, and most come out as they were. */
static void TouchBySamples(kiriSheetData* sheet, const kiriSkin* skin, int32_t oldCount)
{
    for (int32_t k = 0; k < skin->staged.count; ++k) {
        const kiriReweighed* staged = &skin->staged.data[k];
        const kiriSampleWeight* weights = &skin->weights.data[staged->span.first];
        kiriPiece* piece = NextOfFrame(sheet, kiriSheet_FrameOf(sheet, weights->label));
        bool isNew = staged->sample >= oldCount;
        const kiriSpan* was = isNew ? NULL : &skin->spans.data[staged->sample];
        piece->isTouched = piece->isTouched || isNew || was->count != staged->span.count ||
                           memcmp(&skin->weights.data[was->first], weights, sizeof(*weights) * (size_t)was->count) != 0;
    }
}

/* A piece is touched where a part of it is; and so are all of its parts. */
static void TouchByOrigin(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        const kiriPiece* piece = &next->pieces.data[p];
        if (piece->isTouched && piece->origin != KIRI_NONE) {
            sheet->layout.pieces.data[piece->origin].rest.isStirred = true;
        }
    }
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        kiriPiece* piece = &next->pieces.data[p];
        bool isOfTouched = piece->origin != KIRI_NONE && sheet->layout.pieces.data[piece->origin].rest.isStirred;
        piece->isTouched = piece->isTouched || isOfTouched;
    }
}

static bool AreAllTouched(const kiriLayout* layout)
{
    bool are = true;
    for (int32_t p = 0; are && p < layout->pieces.count; ++p) {
        are = layout->pieces.data[p].isTouched;
    }
    return are;
}

void kiriPieces_FindTouched(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        next->pieces.data[p].isTouched = next->pieces.data[p].cameOff;
    }
    TouchByFrames(sheet);
    TouchByLinks(sheet);
    if (!AreAllTouched(next)) { /* there may be many samples */
        TouchBySamples(sheet, &sheet->vertexSkin, sheet->update->samples.oldVertices);
        TouchBySamples(sheet, &sheet->pointSkin, sheet->points.count);
    }
    TouchByOrigin(sheet);
}

/* ---- Rest ---- */

void kiriPieces_KeepRest(kiriSheetData* sheet, const kiriLayout* old)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriPiece* piece = &sheet->layout.pieces.data[p];
        if (piece->origin != KIRI_NONE && !piece->isTouched) {
            piece->rest = old->pieces.data[piece->origin].rest;
        }
    }
    kiriMotion_SumRest(sheet);
}

int32_t kiriPiece_OfTriangle(const kiriSheetData* sheet, int32_t triangle)
{
    int32_t vertex = sheet->mesh.triangles.data[triangle].vertex[0];
    return vertex != KIRI_NONE ? kiriPiece_OfVertex(sheet, vertex) : KIRI_NONE;
}

/* While an update is at hand regions may be half done: then the frame that weighs most at the corners. */
static int32_t HeaviestAt(const kiriSheetData* sheet, int32_t triangle)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriSampleWeight heaviest = { KIRI_NONE, 0.0f };
    for (int corner = 0; corner < 3; ++corner) {
        kiriSpan span = skin->spans.data[sheet->mesh.triangles.data[triangle].vertex[corner]];
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            if (skin->weights.data[k].value > heaviest.value) {
                heaviest = skin->weights.data[k];
            }
        }
    }
    return heaviest.label != KIRI_NONE ? kiriSheet_FrameOf(sheet, heaviest.label) : KIRI_NONE;
}

static int32_t FrameAt(const kiriSheetData* sheet, int32_t triangle, kiriLatticePoint at)
{
    if (!kiriUpdate_IsFieldCurrent(sheet->update)) {
        return HeaviestAt(sheet, triangle);
    }
    int32_t cell = kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
    return cell == KIRI_NONE ? HeaviestAt(sheet, triangle) : sheet->regions.field.owner.data[cell];
}

int32_t kiriOwner_At(const kiriSheetData* sheet, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    int32_t frame = triangle != KIRI_NONE ? FrameAt(sheet, triangle, at) : KIRI_NONE;
    return frame != KIRI_NONE && !kiriSheet_IsGone(sheet, frame) ? frame : KIRI_NONE;
}

int32_t kiriOwner_OfNode(const kiriSheetData* sheet, int32_t node, bool isStaged)
{
    if (node == KIRI_NONE) {
        return KIRI_NONE;
    }
    int32_t frame = isStaged || kiriUpdate_IsFieldCurrent(sheet->update)
                        ? sheet->regions.field.owner.data[sheet->grid.nodeCell.data[node]]
                        : HeaviestAt(sheet, sheet->mesh.squares.nodes.data[node].triangle);
    return isStaged || !kiriSheet_IsGone(sheet, frame) ? frame : KIRI_NONE;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

typedef struct LineWork {
    kiriSheetData* sheet;
    bool isStaged;
} LineWork;

static bool AreLinked(const LineWork* work, int32_t a, int32_t b)
{
    const kiriLinks* links = &work->sheet->links;
    const kiriLink* list = work->isStaged ? links->next.data : links->links.data;
    int32_t count = work->isStaged ? links->next.count : links->links.count, i = kiriMin(a, b), j = kiriMax(b, a);
    for (int32_t k = 0; k < count; ++k) {
        if (list[k].i == i && list[k].j == j) {
            return true;
        }
    }
    return false;
}

/* At a point of the line where `frame` begins: those that end there and are linked to it have a neighbour beyond their
   end. Returns whether there are any: then it has one as well. */
static bool CloseEnds(const LineWork* work, int32_t frame, double at)
{
    bool any = false;
    for (int32_t k = 0; k < work->sheet->lineShares.count; ++k) {
        kiriLineShare* share = &work->sheet->lineShares.data[k];
        if (share->ends[1] == at && share->frame != frame && AreLinked(work, share->frame, frame)) {
            share->open[1] = false;
            any = true;
        }
    }
    return any;
}

static kiriLineShare* FindShare(const LineWork* work, int32_t frame)
{
    for (int32_t k = 0; k < work->sheet->lineShares.count; ++k) {
        if (work->sheet->lineShares.data[k].frame == frame) {
            return &work->sheet->lineShares.data[k];
        }
    }
    return NULL;
}

/* `other` is the frame on the other side, which takes half of a load, or KIRI_NONE, or the same. */
static bool AddPart(const LineWork* work, int32_t frame, int32_t other, const kiriLinePart* part)
{
    double a = part->from, b = part->to, length = b - a;
    bool isShared = other != KIRI_NONE && other != frame, isAlone = !isShared || !AreLinked(work, frame, other);
    double loaded = isShared ? 0.5 : 1.0;
    kiriLineShare* share = FindShare(work, frame);
    if (share == NULL || share->ends[1] != a) {
        bool isOpen = !CloseEnds(work, frame, a);
        kiriLineShare none = { frame, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, { a, b }, { isOpen, true } };
        if (share == NULL && !kiriArray_Push(work->sheet->memory, &work->sheet->lineShares, none)) {
            return false;
        }
        share = FindShare(work, frame);
    }
    share->length += length;
    share->first += 0.5 * length * (a + b);
    share->second += length * (a * a + a * b + b * b) / 3.0;
    share->alone += isAlone ? length : 0.0;
    share->load += loaded * length;
    share->firstLoad += loaded * 0.5 * length * (a + b);
    share->ends[1] = b;
    share->open[1] = true;
    return true;
}

bool kiriOwner_FindShares(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, bool isStaged)
{
    const LineWork work = { sheet, isStaged };
    sheet->lineShares.count = 0;
    bool ok = kiriLine_Trace(&sheet->line, sheet->memory, &sheet->mesh, from, to);
    for (int32_t k = 0; ok && k < sheet->line.parts.count; ++k) {
        const kiriLinePart* part = &sheet->line.parts.data[k];
        int32_t left = kiriOwner_OfNode(sheet, part->node[0], isStaged);
        int32_t right = kiriOwner_OfNode(sheet, part->node[1], isStaged);
        if (left != KIRI_NONE) {
            ok = AddPart(&work, left, right, part);
        }
        if (ok && right != KIRI_NONE && right != left) {
            ok = AddPart(&work, right, left, part);
        }
    }
    return ok;
}

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

enum { WORK_OF_FRAME = 4 }; /* in contacts, as kiriSolver_SystemItems counts them */

/* Of all pieces that are listed awake; returns their sum. */
static int64_t FindWork(kiriSheetData* sheet)
{
    kiriPiece* pieces = sheet->layout.pieces.data;
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    int64_t sum = 0;
    KIRI_EACH(p, awake->pieces) {
        pieces[p].work = 0;
    }
    KIRI_EACH(f, awake->frames) {
        kiriSheet_PieceOf(sheet, f)->work += WORK_OF_FRAME;
        sum += WORK_OF_FRAME;
    }
    for (int32_t i = 0; i < sheet->touches.found.count; ++i) {
        int32_t piece = kiriTouch_Piece(sheet, &sheet->touches.found.data[i]);
        if (awake->isAwake.data[piece]) {
            pieces[piece].work += 1;
            sum += 1;
        }
    }
    return sum;
}

static int32_t FirstPiece(const kiriSheetData* sheet)
{
    return sheet->turns.next < sheet->frames.count ? sheet->layout.framePiece.data[sheet->turns.next] : 0;
}

/* Those whose turn it is, one at least, as long as they have no more than `most` work together; the others wait.
   Returns their work. */
static int64_t ChooseTurns(kiriSheetData* sheet, int64_t most)
{
    int32_t count = sheet->layout.pieces.count, first = FirstPiece(sheet);
    int64_t sum = 0;
    bool isFull = false;
    sheet->turns.waiting = 0;
    for (int32_t k = 0; k < count; ++k) {
        kiriPiece* piece = &sheet->layout.pieces.data[(first + k) % count];
        if (kiriPiece_IsAwake(piece)) {
            isFull = isFull || (sum > 0 && sum + piece->work > most);
            sum += isFull ? 0 : piece->work;
            piece->rest.waits = isFull;
            sheet->turns.waiting += isFull;
        }
    }
    return sum;
}

static int64_t ContactsOf(const kiriSheetData* sheet, int64_t work)
{
    return work - (int64_t)WORK_OF_FRAME * kiriSolver_Awake(sheet->solver)->frames.count;
}

static void ListMoved(kiriSheetData* sheet, const kiriSystem* system)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriSolver_SetAwake(sheet->solver, p, kiriPiece_IsMoved(&sheet->layout.pieces.data[p]));
    }
    kiriSolver_ListAwake(sheet->solver, system);
}

/* Those of pieces that are moved are used up when they have been. */
static void DropWaitingForces(kiriSheetData* sheet)
{
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        if (kiriSheet_PieceOf(sheet, f)->rest.waits) {
            kiriFrame_DropForces(&sheet->frames.data[f]);
        }
    }
}

/* What fades goes on to do so where it waits. */
static void NoteFading(kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        const kiriRest* rest = &sheet->layout.pieces.data[p].rest;
        sheet->seen.areFadesAsleep = sheet->seen.areFadesAsleep || (rest->waits && rest->isFading);
    }
}

/* Pieces are chosen by frames and contacts; what their factorisation takes is known when they are listed. */
bool kiriPieceTurns_Begin(kiriSheetData* sheet, const kiriSystem* system, const kiriQuota* systems)
{
    int64_t items = kiriSolver_SystemItems(sheet->solver, sheet->touches.found.count), left = systems->left;
    KIRI_ASSERT(sheet->turns.waiting == 0);
    if (items <= left || left <= 0 || kiriSolver_Awake(sheet->solver)->pieces.count < 2) {
        return false;
    }
    int64_t most = (int64_t)((double)FindWork(sheet) * (double)left / (double)items), work;
    do {
        work = ChooseTurns(sheet, most);
        ListMoved(sheet, system);
        items = kiriSolver_SystemItems(sheet->solver, (int32_t)ContactsOf(sheet, work));
        most = work / 2;
    } while (items > left && kiriSolver_Awake(sheet->solver)->pieces.count > 1);
    DropWaitingForces(sheet);
    NoteFading(sheet);
    return true;
}

void kiriPieceTurns_Take(kiriSheetData* sheet)
{
    int32_t count = sheet->layout.pieces.count, first = FirstPiece(sheet), k = 0;
    while (k < count && !sheet->layout.pieces.data[(first + k) % count].rest.waits) {
        ++k;
    }
    sheet->turns.next = k < count ? sheet->layout.pieces.data[(first + k) % count].frame : 0;
}

void kiriPieceTurns_End(kiriSheetData* sheet)
{
    for (int32_t p = 0; sheet->turns.waiting > 0 && p < sheet->layout.pieces.count; ++p) {
        sheet->layout.pieces.data[p].rest.waits = false;
    }
    sheet->turns.waiting = 0;
}

void kiriAhead_Drop(kiriSheetData* sheet, kiriMemory* memory)
{
    kiriGather_Pause(sheet);
    kiriSheet_Delete(sheet->ahead.part, memory);
    kiriMemory_FreeAll(&sheet->ahead.memory);
    memset(&sheet->ahead, 0, sizeof(sheet->ahead));
}

/* Pieces are numbered anew only where the mesh changes. */
static bool IsMadeOf(const kiriSheetData* sheet, kiriFrame frame)
{
    return sheet->ahead.frame == frame && sheet->ahead.revision == sheet->mesh.revision;
}

static int32_t IndexOf(const kiriSheetData* sheet, kiriFrame frame)
{
    int32_t i = 0;
    while (sheet->frames.data[i].id != frame) {
        ++i;
    }
    return i;
}

/* Maps of all items, which the first piece that leaves needs, take ticks of their own. */
static bool StartAhead(kiriSheetData* sheet, kiriQuotas* quotas)
{
    kiriAhead* ahead = &sheet->ahead;
    if (!kiriGather_IsReserved(sheet)) {
        return kiriGather_Reserve(sheet, &quotas->of[KIRI_QUOTA_CELLS]) != KIRI_FAILED;
    }
    ahead->gathered = kiriMemory_AllocZeroed(&ahead->memory, sizeof(*ahead->gathered));
    return ahead->gathered != NULL &&
           kiriGather_Start(ahead->gathered, sheet, &ahead->memory, IndexOf(sheet, ahead->frame));
}

static bool MakeSome(kiriSheetData* sheet, kiriMemory* memory, kiriQuotas* quotas)
{
    kiriAhead* ahead = &sheet->ahead;
    if (!ahead->gathered->isDone) {
        return kiriGather_GoOn(ahead->gathered, &quotas->of[KIRI_QUOTA_CELLS]) != KIRI_FAILED;
    }
    kiriExtraction extraction;
    bool ok = kiriExtraction_Init(&extraction, ahead->gathered);
    ahead->part = ahead->part == NULL ? kiriSheet_New(memory) : ahead->part;
    kiriProgress progress =
        ok && ahead->part != NULL ? kiriExtraction_GoOn(&extraction, ahead->piece, ahead->part, quotas) : KIRI_FAILED;
    kiriExtraction_Drop(&extraction);
    ahead->isMade = progress == KIRI_DONE;
    return progress != KIRI_FAILED;
}

bool kiriAhead_GoOn(kiriSheetData* sheet, kiriFrame frame, kiriMemory* memory, int64_t paid)
{
    enum { CELLS_FOR_A_SAMPLE = 5, SAMPLES_FOR_A_SAMPLE = 1 };
    kiriAhead* ahead = &sheet->ahead;
    if (!IsMadeOf(sheet, frame)) {
        kiriAhead_Drop(sheet, memory);
        ahead->frame = frame;
        ahead->piece = sheet->layout.framePiece.data[IndexOf(sheet, frame)];
        ahead->revision = sheet->mesh.revision;
        ahead->memory = kiriMemory_Like(memory);
    }
    int64_t more = paid - ahead->spent;
    if (ahead->isMade || more <= 0) {
        return true;
    }
    kiriQuotas quotas = kiriQuotas_Unlimited();
    quotas.of[KIRI_QUOTA_CELLS].left = CELLS_FOR_A_SAMPLE * more;
    quotas.of[KIRI_QUOTA_SAMPLES].left = SAMPLES_FOR_A_SAMPLE * more;
    ahead->spent = paid;
    bool ok = ahead->gathered == NULL ? StartAhead(sheet, &quotas) : MakeSome(sheet, memory, &quotas);
    if (!ok) {
        kiriAhead_Drop(sheet, memory);
    }
    return ok;
}

kiriSheetData* kiriAhead_Take(kiriSheetData* sheet, kiriFrame frame)
{
    kiriSheetData* part = IsMadeOf(sheet, frame) ? sheet->ahead.part : NULL;
    sheet->ahead.part = part != NULL ? NULL : sheet->ahead.part;
    return part;
}

const kiriGathered* kiriAhead_Gathered(const kiriSheetData* sheet, const uint8_t* stays)
{
    const kiriAhead* ahead = &sheet->ahead;
    bool isSame = ahead->gathered != NULL && ahead->gathered->isDone && IsMadeOf(sheet, ahead->frame);
    for (int32_t p = 0; isSame && p < sheet->layout.pieces.count; ++p) {
        isSame = (stays[p] == 0) == (p == ahead->piece);
    }
    return isSame ? ahead->gathered : NULL;
}
