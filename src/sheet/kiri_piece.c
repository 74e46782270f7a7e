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
