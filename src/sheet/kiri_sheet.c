#include "kiri_sheet.h"
#include "../core/kiri_array.h"

kiriSheetData* kiriSheet_New(kiriMemory* memory)
{
    kiriSheetData* sheet = kiriMemory_AllocZeroed(memory, sizeof(*sheet));
    if (sheet != NULL) {
        sheet->own = kiriMemory_Like(memory);
        sheet->shown = kiriMemory_Like(memory);
        sheet->memory = &sheet->own;
        sheet->seen.bounds = kiriMemory_AllocZeroed(sheet->memory, sizeof(kiriBounds));
    }
    if (sheet != NULL && sheet->seen.bounds == NULL) {
        kiriSheet_Delete(sheet, memory);
        sheet = NULL;
    }
    return sheet;
}

void kiriSheet_Delete(kiriSheetData* sheet, kiriMemory* memory)
{
    if (sheet != NULL) {
        kiriMemory_FreeAll(&sheet->shown);
        kiriMemory_FreeAll(&sheet->own);
        kiriArray_Release(memory, &sheet->queue);
        kiriArray_Release(memory, &sheet->cuts);
        kiriMemory_Free(memory, sheet);
    }
}

double kiriSheet_Spacing(const kiriSheetData* sheet)
{
    double area = 0.0;
    KIRI_EACH(const kiriFrameData, frame, sheet->frames) {
        area += frame->area;
    }
    KIRI_ASSERT(sheet->frames.count > 0 && area > 0.0);
    return kiriRoot(area / sheet->frames.count);
}

bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriLatticePoint* at)
{
    kiriVec2 local = kiriSheet_ToLocal(sheet, rest), end = local;
    bool inRange = kiriCut_Clip(&sheet->mesh, &local, &end);
    if (inRange) {
        *at = kiriMesh_Snap(&sheet->mesh, local);
    }
    return inRange;
}

/* ---- Sleep ---- */

void kiriSheet_WakePiece(kiriSheetData* sheet, int32_t piece)
{
    KIRI_ASSERT_HAS(sheet->layout.pieces, piece);
    kiriPiece* woken = &sheet->layout.pieces.data[piece];
    if (!woken->isGone) {
        woken->rest.asleep = sheet->rest.asleep = sheet->rest.isIdle = false;
        woken->rest.calm = 0.0;
    }
}

void kiriSheet_WakeFrame(kiriSheetData* sheet, int32_t frame)
{
    KIRI_ASSERT_HAS(sheet->frames, frame);
    kiriSheet_WakePiece(sheet, sheet->layout.framePiece.data[frame]);
}

void kiriSheet_WakePin(kiriSheetData* sheet, int32_t pin)
{
    KIRI_ASSERT_HAS(sheet->pins, pin);
    const kiriPinShares* shares = &sheet->layout.pinShares;
    kiriSheet_WakeFrame(sheet, sheet->layout.pinFrame.data[pin]);
    KIRI_EACH(const kiriPinShare, share, *shares) {
        if (share->pin == pin) {
            kiriSheet_WakeFrame(sheet, share->share.frame);
        }
    }
}

void kiriSheet_WakeAll(kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        kiriSheet_WakePiece(sheet, p);
    }
}

void kiriSheet_WakeStirred(kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        if (sheet->layout.pieces.data[p].rest.isStirred) {
            kiriSheet_WakePiece(sheet, p);
        }
    }
    kiriSheet_LetRest(sheet);
}

void kiriSheet_LetRest(kiriSheetData* sheet)
{
    KIRI_EACH(kiriPiece, piece, sheet->layout.pieces) {
        piece->rest.isStirred = false;
    }
    sheet->rest.isStirred = false;
}

void kiriSheet_SumRest(kiriSheetData* sheet)
{
    bool any = false;
    KIRI_EACH(const kiriPiece, piece, sheet->layout.pieces) {
        any = any || kiriPiece_IsAwake(piece);
    }
    sheet->rest.asleep = !any;
    sheet->rest.isIdle = sheet->rest.isIdle && !any;
}

kiriTotals kiriSheet_SumFrames(const kiriSheetData* sheet, const int32_t* indices, int32_t count)
{
    kiriTotals totals = { 0 };
    kiriVec3 center = { 0 }, momentum = center, angular = center;
    KIRI_TIMES(i, count) {
        const kiriFrameData* frame = &sheet->frames.data[indices != NULL ? indices[i] : i];
        if (kiriSheet_IsGone(sheet, indices != NULL ? indices[i] : i)) {
            continue;
        }
        kiriVec3 p = kiriVec3_Scale(frame->mass, frame->velocity);
        totals.area += frame->area;
        totals.mass += frame->mass;
        totals.kineticEnergy += kiriFrame_KineticEnergy(frame, &sheet->settings.material);
        center = kiriVec3_AddScaled(center, frame->mass, frame->x);
        momentum = kiriVec3_Add(momentum, p);
        angular = kiriVec3_Add(angular, kiriFrame_AngularMomentum(frame, &sheet->settings.material));
        angular = kiriVec3_Add(angular, kiriVec3_Cross(frame->x, p));
    }
    kiriVec3_StoreDoubles(totals.center, kiriVec3_Scale(1.0 / totals.mass, center));
    kiriVec3_StoreDoubles(totals.momentum, momentum);
    kiriVec3_StoreDoubles(totals.angularMomentum, angular);
    return totals;
}

/* ---- Past ---- */

bool kiriPast_Reserve(const kiriPast* past, kiriIndices* room, kiriMemory* memory, int32_t first, int32_t vertices)
{
    return kiriArray_Reserve(memory, room, vertices - kiriMin(past->same, first));
}

void kiriPast_Grow(kiriPast* past, int64_t tick, kiriIndices* room, const kiriMeshData* mesh, int32_t first)
{
    const kiriPast was = kiriPast_At(past, tick); /* pieces may have left at the start of the tick */
    KIRI_ASSERT(first >= mesh->oldVertexCount && (was.count == 0 || was.others != room->data));
    int32_t same = kiriMin(was.same, first), count = mesh->vertices.count - same;
    KIRI_ASSERT(count <= room->capacity);
    room->count = count;
    *past = (kiriPast){ tick, was.sheet, same, room->data, count };
    KIRI_FROM_TO(v, same, first) {
        room->data[v - same] = kiriPast_IndexOf(&was, v);
    }
    KIRI_FROM_TO(v, first, mesh->vertices.count) {
        const kiriBirth* birth = &mesh->births.data[v - mesh->oldVertexCount];
        bool isTorn = birth->parent[1] == KIRI_NONE;
        KIRI_ASSERT(birth->parent[0] < v);
        room->data[v - same] = isTorn ? kiriPast_IndexOf(past, birth->parent[0]) : KIRI_NONE;
    }
}

bool kiriPast_Keep(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriKeep* vertices)
{
    int32_t same = kiriMin(past->same, vertices->first), count = vertices->count - same;
    int32_t* others = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    KIRI_FROM_TO_WHILE(others != NULL, v, same, vertices->to.count) {
        int32_t kept = kiriKeep_To(vertices, v);
        if (kept != KIRI_NONE) {
            others[kept - same] = kiriPast_IndexOf(past, v);
        }
    }
    *to = (kiriPast){ past->tick, past->sheet, same, others, count };
    return others != NULL;
}

bool kiriPast_Part(kiriPast* to, const kiriPast* past, kiriMemory* memory, kiriSheet sheet, const int32_t* vertices,
                   int32_t count)
{
    KIRI_ASSERT(past->sheet == 0); /* a part is one piece until the next tick: nothing leaves it before */
    int32_t* others = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    KIRI_TIMES_WHILE(others != NULL, k, count) {
        others[k] = kiriPast_IndexOf(past, vertices[k]);
    }
    *to = (kiriPast){ past->tick, sheet, 0, others, count };
    return others != NULL;
}
