#include "kiri_piece.h"
#include "../core/kiri_array.h"

/* ---- Pieces of the next layout ----------------------------------------------------------------------------------- */

/* Joins frames that links connect. */
static bool JoinFrames(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (!kiriArray_Resize(sheet->memory, &u->parent, u->placing.sites.count)) {
        return false;
    }
    kiriUnion_Init(u->parent.data, u->placing.sites.count);
    KIRI_EACH(const kiriLink, link, sheet->links.next) {
        KIRI_ASSERT(link->j < u->parent.count);
        kiriUnion_Join(u->parent.data, link->i, link->j);
    }
    return true;
}

/* Returns the current piece of a frame's material. A new frame has the piece of the vertices at its site. */
static int32_t OriginOf(const kiriSheetData* sheet, int32_t frame)
{
    if (frame < sheet->frames.count) {
        return sheet->layout.framePiece.data[frame];
    }
    if (sheet->frames.count == 0) {
        return KIRI_NONE;
    }
    int32_t cell = sheet->update->placing.sites.data[frame].cell;
    KIRI_ASSERT(kiriGrid_IsCell(&sheet->grid, cell));
    return kiriPiece_OfTriangle(sheet, sheet->grid.cells.data[cell].triangle);
}

/* Sets cameOff of all parts of a piece except the largest. */
static void MarkCameOff(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    int32_t* largest = sheet->update->parent.data; /* of each origin: there are no more origins than frames */
    KIRI_ASSERT(sheet->layout.pieces.count <= sheet->update->parent.count);
    KIRI_EACH_INDEX(o, sheet->layout.pieces) {
        largest[o] = KIRI_NONE;
    }
    KIRI_EACH_INDEX(p, next->pieces) {
        int32_t o = next->pieces.data[p].origin;
        if (o != KIRI_NONE &&
            (largest[o] == KIRI_NONE || next->pieces.data[p].area > next->pieces.data[largest[o]].area)) {
            largest[o] = p;
        }
    }
    KIRI_EACH_INDEX(p, next->pieces) {
        kiriPiece* piece = &next->pieces.data[p];
        piece->cameOff = piece->origin != KIRI_NONE && largest[piece->origin] != p;
    }
}

bool kiriPieces_Stage(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriLayout* next = &u->next;
    KIRI_ASSERT(u->material.count == u->placing.sites.count);
    next->pieces.count = 0;
    if (!JoinFrames(sheet) || !kiriArray_Resize(sheet->memory, &next->framePiece, u->placing.sites.count)) {
        return false;
    }
    KIRI_EACH_INDEX(i, u->placing.sites) {
        int32_t root = kiriUnion_Root(u->parent.data, i);
        KIRI_ASSERT(root <= i);
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
    KIRI_EACH(const kiriPiece, piece, sheet->layout.pieces) {
        any = any || piece->isGone;
    }
    return any;
}

/* ---- Pieces that a cut touches ----------------------------------------------------------------------------------- */

static kiriPiece* NextOfFrame(const kiriSheetData* sheet, int32_t frame)
{
    const kiriLayout* next = &sheet->update->next;
    KIRI_ASSERT_HAS(next->framePiece, frame);
    return &next->pieces.data[next->framePiece.data[frame]];
}

/* Returns true if site and region of a frame are unchanged. Regions beside a cut are dirty even if nothing changed. */
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

/* Links are sorted. */
static void TouchByLinks(kiriSheetData* sheet)
{
    int32_t o = 0, n = 0, oldCount = sheet->links.links.count, nextCount = sheet->links.next.count;
    while (o < oldCount || n < nextCount) {
        const kiriLink *old = &sheet->links.links.data[o], *next = &sheet->links.next.data[n];
        bool isGone = n == nextCount || (o < oldCount && kiriLink_IsBefore(old, next));
        bool isNew = !isGone && (o == oldCount || kiriLink_IsBefore(next, old));
        if (isGone || isNew || memcmp(old, next, sizeof(*old)) != 0) {
            NextOfFrame(sheet, isGone ? old->i : next->i)->isTouched = true;
            NextOfFrame(sheet, isGone ? old->j : next->j)->isTouched = true;
        }
        o += !isNew;
        n += !isGone;
    }
}

/* Samples beside a cut are weighed again, too; most weights stay the same. */
static void TouchBySamples(kiriSheetData* sheet, const kiriSkin* skin, int32_t oldCount)
{
    KIRI_EACH(const kiriReweighed, staged, skin->staged) {
        const kiriSampleWeight* weights = &skin->weights.data[staged->span.first];
        kiriPiece* piece = NextOfFrame(sheet, weights->frame);
        bool isNew = staged->sample >= oldCount;
        const kiriSpan* was = isNew ? NULL : &skin->spans.data[staged->sample];
        piece->isTouched = piece->isTouched || isNew || was->count != staged->span.count ||
                           memcmp(&skin->weights.data[was->first], weights, sizeof(*weights) * was->count) != 0;
    }
}

/* If a part of a piece is touched, all parts of the piece are. */
static void TouchByOrigin(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    KIRI_EACH(const kiriPiece, piece, next->pieces) {
        if (piece->isTouched && piece->origin != KIRI_NONE) {
            sheet->layout.pieces.data[piece->origin].rest.isStirred = true;
        }
    }
    KIRI_EACH(kiriPiece, piece, next->pieces) {
        bool isOfTouched = piece->origin != KIRI_NONE && sheet->layout.pieces.data[piece->origin].rest.isStirred;
        piece->isTouched = piece->isTouched || isOfTouched;
    }
}

void kiriPieces_FindTouched(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
    KIRI_ASSERT(next->framePiece.count == sheet->update->placing.sites.count);
    KIRI_EACH(kiriPiece, piece, next->pieces) {
        piece->isTouched = piece->cameOff;
    }
    KIRI_EACH_INDEX(i, sheet->update->placing.sites) {
        bool isNew = i >= sheet->frames.count;
        if (isNew || (sheet->regions.dirty.data[i] && !IsSameFrame(sheet, i))) {
            NextOfFrame(sheet, i)->isTouched = true;
        }
    }
    TouchByLinks(sheet);
    bool areAllTouched = true;
    KIRI_EACH(const kiriPiece, piece, next->pieces) {
        areAllTouched = areAllTouched && piece->isTouched;
    }
    if (!areAllTouched) { /* there may be many samples */
        TouchBySamples(sheet, &sheet->vertexSkin, sheet->update->samples.oldVertices);
        TouchBySamples(sheet, &sheet->pointSkin, sheet->points.count);
    }
    TouchByOrigin(sheet);
}

void kiriPieces_Keep(kiriSheetData* sheet, const kiriLayout* old)
{
    KIRI_EACH(kiriPiece, piece, sheet->layout.pieces) {
        if (piece->origin != KIRI_NONE) {
            const kiriPiece* origin = &old->pieces.data[piece->origin];
            piece->isGone = origin->isGone;
            piece->rest = piece->isTouched ? piece->rest : origin->rest;
        }
    }
    kiriSheet_SumRest(sheet);
}

int32_t kiriPiece_OfTriangle(const kiriSheetData* sheet, int32_t triangle)
{
    return kiriPiece_OfVertex(sheet, sheet->mesh.triangles.data[triangle].vertex[0]);
}

bool kiriPiece_Folds(const kiriSheetData* sheet, int32_t piece)
{
    kiriIndexSpan frames = kiriSolver_FramesOf(sheet->solver, piece);
    kiriVec3 sum = { 0 };
    bool folds = false;
    KIRI_EACH_LISTED(frame, frames) {
        sum = kiriVec3_Add(sum, sheet->frames.data[frame].A.d);
    }
    KIRI_EACH_LISTED_WHILE(!folds, frame, frames) {
        folds = kiriVec3_Dot(sum, sheet->frames.data[frame].A.d) < 0.3 * kiriVec3_Length(sum);
    }
    return folds;
}

bool kiriPieces_AnyFolds(const kiriSheetData* sheet)
{
    bool any = false;
    KIRI_EACH_INDEX_WHILE(!any, p, sheet->layout.pieces) {
        any = kiriPiece_IsAwake(&sheet->layout.pieces.data[p]) && kiriPiece_Folds(sheet, p);
    }
    return any;
}

/* Returns the frame with the largest weight at the corners. During an update regions may be incomplete. */
static int32_t HeaviestAt(const kiriSheetData* sheet, int32_t triangle)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriSampleWeight heaviest = { KIRI_NONE, 0.0f };
    KIRI_EACH_CORNER(corner) {
        kiriSpan span = skin->spans.data[sheet->mesh.triangles.data[triangle].vertex[corner]];
        KIRI_EACH_IN(k, span) {
            if (skin->weights.data[k].value > heaviest.value) {
                heaviest = skin->weights.data[k];
            }
        }
    }
    return heaviest.frame;
}

int32_t kiriOwner_At(const kiriSheetData* sheet, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    if (triangle == KIRI_NONE) {
        return KIRI_NONE;
    }
    bool isCurrent = kiriUpdate_IsFieldCurrent(sheet->update);
    int32_t cell = isCurrent ? kiriGrid_CellOf(&sheet->grid, triangle, at) : KIRI_NONE;
    int32_t frame = cell != KIRI_NONE ? sheet->regions.field.owner.data[cell] : HeaviestAt(sheet, triangle);
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
    KIRI_TIMES(k, count) {
        if (list[k].i == i && list[k].j == j) {
            return true;
        }
    }
    return false;
}

kiriLineShare* kiriOwner_ShareOf(kiriSheetData* sheet, const kiriLineShare* none)
{
    KIRI_EACH(kiriLineShare, share, sheet->lineShares) {
        if (share->frame == none->frame) {
            return share;
        }
    }
    bool ok = kiriArray_Push(sheet->memory, &sheet->lineShares, *none);
    return ok ? &sheet->lineShares.data[sheet->lineShares.count - 1] : NULL;
}

/* Adds a part of the line to the share of `frame`. `other` is the frame on the other side, which takes half of a load;
   it may be KIRI_NONE or `frame`. */
static bool AddPart(const LineWork* work, int32_t frame, int32_t other, const kiriLinePart* part)
{
    double a = part->from, b = part->to, length = b - a;
    bool isShared = other != KIRI_NONE && other != frame, isAlone = !isShared || !AreLinked(work, frame, other);
    double loaded = isShared ? 0.5 : 1.0;
    const kiriLineShare none = { frame, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, { a, a }, { true, true } };
    kiriLineShare* share = kiriOwner_ShareOf(work->sheet, &none);
    if (share == NULL) {
        return false;
    }
    if (share->length == 0.0 || share->ends[1] != a) {
        KIRI_EACH(kiriLineShare, before, work->sheet->lineShares) { /* it begins where others end: both ends close */
            if (before->ends[1] == a && before->frame != frame && AreLinked(work, before->frame, frame)) {
                before->open[1] = false;
                share->open[0] = share->open[0] && share->length != 0.0;
            }
        }
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
    KIRI_EACH_WHILE(ok, const kiriLinePart, part, sheet->line.parts) {
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

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

bool kiriPieceItems_List(kiriPieceItems* list, kiriMemory* memory, int32_t pieceCount, const int32_t* pieces,
                         int32_t count)
{
    if (!kiriArray_Resize(memory, &list->spans, pieceCount) || !kiriArray_Reserve(memory, &list->items, count)) {
        return false;
    }
    list->items.count =
        kiriSpans_Group(pieces, count, list->spans.data, sizeof(kiriSpan), pieceCount, list->items.data);
    return true;
}

static bool ListPoints(kiriSheetData* sheet)
{
    kiriMemory* memory = &sheet->shown;
    int32_t* pieces = kiriMemory_Alloc(memory, (int64_t)sizeof(int32_t) * sheet->points.count);
    KIRI_EACH_INDEX_WHILE(pieces != NULL, i, sheet->points) {
        pieces[i] = sheet->layout.framePiece.data[sheet->points.data[i].frame];
    }
    bool ok = pieces != NULL && kiriPieceItems_List(&sheet->lists.points, memory, sheet->layout.pieces.count, pieces,
                                                    sheet->points.count);
    kiriMemory_Free(memory, pieces);
    return ok;
}

bool kiriPieces_ListFrames(kiriSheetData* sheet)
{
    kiriPieceLists* lists = &sheet->lists;
    if (lists->hasFrames) {
        return true;
    }
    if (!ListPoints(sheet) || !kiriArray_Resize(&sheet->shown, &lists->ids, sheet->frames.count)) {
        return false;
    }
    KIRI_EACH_INDEX(i, lists->ids) {
        lists->ids.data[i] = sheet->frames.data[sheet->solver->bodies.frames.data[i]].id;
    }
    lists->hasFrames = true;
    return true;
}

/* `pieces` is scratch: one entry a vertex, then one a triangle. */
static bool ListMesh(kiriSheetData* sheet, int32_t* pieces)
{
    kiriPieceLists* lists = &sheet->lists;
    kiriMemory* memory = &sheet->shown;
    const kiriLayout* layout = &sheet->layout;
    const int32_t* indices = sheet->seen.surface.indices.data;
    int32_t vertices = sheet->mesh.vertices.count, triangles = sheet->mesh.triangles.count;
    int32_t* trianglePieces = pieces + vertices;
    KIRI_TIMES(v, vertices) {
        pieces[v] = kiriPiece_OfVertex(sheet, v);
    }
    KIRI_TIMES(t, triangles) {
        int32_t piece = pieces[indices[3 * t]];
        trianglePieces[t] = layout->pieces.data[piece].isGone ? KIRI_NONE : piece;
    }
    if (!kiriPieceItems_List(&lists->vertices, memory, layout->pieces.count, pieces, vertices) ||
        !kiriPieceItems_List(&lists->triangles, memory, layout->pieces.count, trianglePieces, triangles) ||
        !kiriArray_Resize(memory, &lists->corners, 3 * (int64_t)lists->triangles.items.count)) {
        return false;
    }
    KIRI_EACH_INDEX(i, lists->triangles.items) {
        memcpy(&lists->corners.data[3 * i], &indices[3 * lists->triangles.items.data[i]],
               3 * sizeof(int32_t));
    }
    return true;
}

bool kiriPieces_ListMesh(kiriSheetData* sheet)
{
    if (!sheet->lists.hasMesh) {
        int64_t items = (int64_t)sheet->mesh.vertices.count + sheet->mesh.triangles.count;
        int32_t* pieces = kiriMemory_Alloc(&sheet->shown, (int64_t)sizeof(int32_t) * items);
        sheet->lists.hasMesh = pieces != NULL && ListMesh(sheet, pieces);
        kiriMemory_Free(&sheet->shown, pieces);
    }
    return sheet->lists.hasMesh;
}

kiriSpan kiriPieceItems_Of(const kiriPieceItems* list, int32_t piece)
{
    KIRI_ASSERT_HAS(list->spans, piece);
    return list->spans.data[piece];
}

void kiriPieceLists_Retire(kiriPieceLists* lists, kiriMemory* retired)
{
    kiriPieceItems* all[] = { &lists->vertices, &lists->triangles, &lists->points };
    KIRI_TIMES(i, 3) {
        kiriMemory_Adopt(retired, all[i]->spans.data);
        kiriMemory_Adopt(retired, all[i]->items.data);
    }
    kiriMemory_Adopt(retired, lists->ids.data);
    kiriMemory_Adopt(retired, lists->corners.data);
    KIRI_CLEAR(lists);
}

/* ---- State ------------------------------------------------------------------------------------------------------- */

/* Writes the box of the visible positions. */
static void Bound(const kiriSheetData* sheet, kiriSpan span, float lower[3], float upper[3])
{
    const int32_t* vertices = sheet->lists.vertices.items.data + span.first;
    const float* positions = sheet->seen.surface.positions.data;
    if (span.count == 0) {
        return;
    }
    float least[3], most[3];
    memcpy(least, positions + 3 * vertices[0], sizeof(least));
    memcpy(most, least, sizeof(most));
    KIRI_FROM_TO(i, 1, span.count) {
        const float* x = positions + 3 * vertices[i];
        KIRI_TIMES(k, 3) {
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
    KIRI_ASSERT(lists->hasFrames && lists->hasMesh);
    kiriIndexSpan frames = kiriSolver_FramesOf(sheet->solver, piece);
    kiriSpan vertices = kiriPieceItems_Of(&lists->vertices, piece);
    if (sheet->layout.pieces.data[piece].isGone) {
        return (kiriPieceState){ 0 };
    }
    kiriTotals totals = kiriSheet_SumFrames(sheet, frames.data, frames.count);
    kiriPieceState state = { .area = totals.area, .mass = totals.mass };
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
