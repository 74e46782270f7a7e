#include "kiri_blade_work.h"

#include <string.h>

/* ---- Blades ---- */

kiriResult kiriWorld_AddBlade(kiriWorld* world, kiriSheet sheet, kiriBladeData** made)
{
    kiriResult result = kiriArray_Reserve(&world->memory, &world->blades, (int64_t)world->blades.count + 1)
                            ? kiriWorld_ReserveIds(world, &world->bladeIds, 1)
                            : KIRI_ERROR_MEMORY;
    kiriBladeData* blade = result == KIRI_OK ? kiriMemory_AllocZeroed(&world->memory, sizeof(*blade)) : NULL;
    if (blade == NULL) {
        return result != KIRI_OK ? result : KIRI_ERROR_MEMORY;
    }
    blade->sheet = sheet;
    blade->id = kiriPool_Add(&world->bladeIds, &world->memory, blade, 0);
    world->blades.data[world->blades.count++] = blade;
    *made = blade;
    return KIRI_OK;
}

static kiriCutData* CutOf(const kiriWorld* world, const kiriLayer* layer)
{
    const kiriSlot* slot = kiriPool_Find(&world->cutIds, layer->cut);
    return slot != NULL ? slot->owner : NULL;
}

/* Loops whose ends have nearly met are closed. */
static void EndCuts(kiriWorld* world, const kiriBladeData* blade)
{
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        const kiriLayer* layer = &blade->layers.data[i];
        kiriCutData* cut = CutOf(world, layer);
        if (cut != NULL && layer->loop.isPassed) {
            kiriWorld_QueuePoint(world, cut, layer->loop.near, true);
        }
        if (cut != NULL && (layer->loop.isPassed || kiriLoop_IsNear(&layer->loop, layer->rest))) {
            kiriWorld_QueuePoint(world, cut, layer->loop.start, false);
        }
        if (cut != NULL) {
            kiriWorld_EndCut(world, cut);
        }
    }
}

static bool ReserveEnds(kiriWorld* world, const kiriBladeData* blade)
{
    bool ok = true;
    for (int32_t i = 0; ok && i < blade->layers.count; ++i) {
        const kiriCutData* cut = CutOf(world, &blade->layers.data[i]);
        int64_t all = cut != NULL ? (int64_t)cut->sheet->queue.count + 3 * (int64_t)blade->layers.count : 0;
        ok = cut == NULL || kiriArray_Reserve(&world->memory, &cut->sheet->queue, all);
    }
    return ok;
}

kiriResult kiriWorld_RemoveBlade(kiriWorld* world, kiriBladeData* blade)
{
    int32_t kept = 0;
    if (!ReserveEnds(world, blade)) {
        return KIRI_ERROR_MEMORY;
    }
    EndCuts(world, blade);
    for (int32_t i = 0; i < world->blades.count; ++i) {
        if (world->blades.data[i] != blade) {
            world->blades.data[kept++] = world->blades.data[i];
        }
    }
    world->blades.count = kept;
    kiriPool_Remove(&world->bladeIds, blade->id);
    kiriArray_Release(&world->memory, &blade->layers);
    kiriMemory_Free(&world->memory, blade);
    return KIRI_OK;
}

void kiriWorld_AdvanceBlades(kiriWorld* world, double dt)
{
    for (int32_t i = 0; i < world->blades.count; ++i) {
        world->blades.data[i]->elapsed += dt;
    }
}

/* ---- From layers to tracks ---- */

/* A cut that has taken all its points is where its tip is, which may have snapped to a vertex. */
static kiriVec2 PlaceOfBlade(const kiriLayer* layer, const kiriSheetData* sheet, const kiriCutData* cut)
{
    bool isThere = cut != NULL && cut->waiting == 0 && cut->tip.blade.vertex != KIRI_NONE;
    return isThere ? kiriMesh_Local(&sheet->mesh, cut->tip.blade.at) : layer->rest;
}

/* A layer whose sheet is gone is gone. */
static bool StartTracks(kiriBladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        const kiriLayer* layer = &blade->layers.data[i];
        const kiriSlot* slot = kiriPool_Find(&world->sheetIds, layer->sheet);
        if (slot == NULL) {
            continue;
        }
        kiriCutData* cut = CutOf(world, layer);
        const kiriTrack track = { slot->owner, cut,          KIRI_NONE,   PlaceOfBlade(layer, slot->owner, cut),
                                  layer->at,   layer->share, layer->loop, false,
                                  false,       false };
        if (!kiriArray_Push(&work->memory, &work->tracks, track)) {
            return false;
        }
    }
    return true;
}

/* Lists the cuts that are in the queues. */
static bool ListPending(kiriBladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    KIRI_ARRAY(kiriVec2) ends = { NULL, 0, 0 };
    bool ok = true;
    for (int32_t i = 0; ok && i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        if (sheet->queue.count == 0 || (blade->sheet != 0 && blade->sheet != sheet->id)) {
            continue;
        }
        ends.count = 0;
        for (int32_t k = 0; ok && k < sheet->cuts.count; ++k) {
            ok = kiriArray_Push(&work->memory, &ends, sheet->cuts.data[k]->committed.last);
        }
        for (int32_t k = 0; ok && k < sheet->queue.count; ++k) {
            const kiriQueuedPoint* point = &sheet->queue.data[k];
            KIRI_ASSERT(point->cut->index >= 0 && point->cut->index < ends.count);
            kiriVec2* end = &ends.data[point->cut->index];
            const kiriPendingLip lip = { sheet, *end, point->to, KIRI_NONE };
            ok = point->jump || kiriArray_Push(&work->memory, &work->pending, lip);
            *end = point->to;
        }
    }
    return ok;
}

/* ---- Steps ---- */

/* A plane stands for what the edge sweeps: where its ways are askew it goes in steps. Not more than MOST_STEPS. */
static int32_t StepsFor(const kiriBladeData* blade, const kiriVec3 to[2])
{
    enum { MOST_STEPS = 8 };
    kiriVec3 a = kiriVec3_Normalize(kiriVec3_Sub(blade->edge[1], blade->edge[0]));
    kiriVec3 b = kiriVec3_Normalize(kiriVec3_Sub(to[1], to[0]));
    kiriVec3 way = kiriVec3_Add(kiriVec3_Sub(to[0], blade->edge[0]), kiriVec3_Sub(to[1], blade->edge[1]));
    double skew = fabs(kiriVec3_Dot(kiriVec3_Cross(a, b), kiriVec3_Normalize(way)));
    int32_t steps = 1 + (int32_t)(10.0 * skew);
    return steps < MOST_STEPS ? steps : MOST_STEPS;
}

static void NextStep(kiriBladeWork* work)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < work->tracks.count; ++i) {
        if (!work->tracks.data[i].isOver && !work->tracks.data[i].isLost) {
            work->tracks.data[kept] = work->tracks.data[i];
            work->tracks.data[kept++].isDone = false;
        }
    }
    work->tracks.count = work->oldCount = kept;
}

static bool StepThroughSheets(kiriBladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    bool ok = true;
    for (int32_t i = 0; ok && i < world->sheets.count; ++i) {
        work->sheet = world->sheets.data[i];
        if (blade->sheet == 0 || blade->sheet == work->sheet->id) {
            ok = kiriBlade_Step(work);
        }
    }
    return ok;
}

static kiriVec3 Towards(kiriVec3 a, kiriVec3 b, double share)
{
    return share < 1.0 ? kiriVec3_AddScaled(a, share, kiriVec3_Sub(b, a)) : b;
}

/* The first step begins where the edge was when the sheet was elsewhere; in the others the sheet stays. */
static bool TakeSteps(kiriBladeWork* work, const kiriWorld* world, const kiriBladeData* blade, const kiriVec3 to[2])
{
    int32_t steps = blade->isPlaced ? StepsFor(blade, to) : 1;
    bool ok = true;
    for (int32_t i = 0; ok && i < steps; ++i) {
        double begin = (double)i / steps, end = (double)(i + 1) / steps;
        for (int k = 0; k < 2; ++k) {
            work->was[k] = blade->isPlaced ? Towards(blade->edge[k], to[k], begin) : to[k];
            work->is[k] = blade->isPlaced ? Towards(blade->edge[k], to[k], end) : to[k];
        }
        work->elapsed = i == 0 && blade->isPlaced ? blade->elapsed : 0.0;
        NextStep(work);
        ok = StepThroughSheets(work, world, blade);
    }
    NextStep(work);
    return ok;
}

/* ---- Into the world ---- */

typedef KIRI_ARRAY(kiriCutData*) CutList;

/* Room in the queues and lists of cuts, and for ids. */
static kiriResult ReserveStrokes(kiriWorld* world, const kiriBladeWork* work)
{
    int64_t made = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        int64_t points = sheet->queue.count, cuts = sheet->cuts.count;
        for (int32_t k = 0; k < work->points.count; ++k) {
            points += work->strokes.data[work->points.data[k].stroke].sheet == sheet;
        }
        for (int32_t k = 0; k < work->strokes.count; ++k) {
            cuts += work->strokes.data[k].sheet == sheet && work->strokes.data[k].cut == NULL;
            points += work->strokes.data[k].sheet == sheet; /* to end with */
        }
        made += cuts - sheet->cuts.count;
        if (!kiriArray_Reserve(&world->memory, &sheet->queue, points) ||
            !kiriArray_Reserve(&world->memory, &sheet->cuts, cuts)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    return kiriWorld_ReserveIds(world, &world->cutIds, made);
}

/* Blocks for the new cuts; all or none. */
static bool MakeCuts(kiriWorld* world, kiriBladeWork* work, CutList* made)
{
    bool ok = true;
    for (int32_t i = 0; ok && i < work->strokes.count; ++i) {
        if (work->strokes.data[i].cut == NULL) {
            kiriCutData* cut = kiriMemory_AllocZeroed(&world->memory, sizeof(*cut));
            ok = cut != NULL && kiriArray_Push(&work->memory, made, cut);
            if (!ok) {
                kiriMemory_Free(&world->memory, cut);
            }
        }
    }
    for (int32_t i = 0; !ok && i < made->count; ++i) {
        kiriMemory_Free(&world->memory, made->data[i]);
    }
    return ok;
}

/* Never fails. */
static void QueueStrokes(kiriWorld* world, kiriBladeWork* work, const CutList* made)
{
    int32_t used = 0;
    for (int32_t i = 0; i < work->strokes.count; ++i) {
        kiriStroke* stroke = &work->strokes.data[i];
        if (stroke->cut == NULL) {
            stroke->cut = made->data[used++];
            kiriWorld_EnlistCut(world, stroke->sheet, stroke->cut);
        }
    }
    for (int32_t i = 0; i < work->points.count; ++i) {
        const kiriStrokePoint* point = &work->points.data[i];
        kiriWorld_QueuePoint(world, work->strokes.data[point->stroke].cut, point->rest, point->isStart);
    }
    for (int32_t i = 0; i < work->strokes.count; ++i) {
        if (work->strokes.data[i].isOver) {
            kiriWorld_EndCut(world, work->strokes.data[i].cut);
        }
    }
}

static void KeepLayers(kiriBladeData* blade, const kiriBladeWork* work)
{
    blade->layers.count = 0;
    for (int32_t i = 0; i < work->tracks.count; ++i) {
        const kiriTrack* track = &work->tracks.data[i];
        const kiriCutData* cut = track->stroke != KIRI_NONE ? work->strokes.data[track->stroke].cut : track->cut;
        const kiriLayer layer = { track->sheet->id, cut != NULL ? cut->id : 0, track->rest, track->at, track->share,
                                  track->loop };
        blade->layers.data[blade->layers.count++] = layer;
    }
}

static kiriResult Apply(kiriWorld* world, kiriBladeData* blade, kiriBladeWork* work)
{
    CutList made = { NULL, 0, 0 };
    kiriResult result = ReserveStrokes(world, work);
    if (result != KIRI_OK) {
        return result;
    }
    if (!kiriArray_Reserve(&world->memory, &blade->layers, work->tracks.count) || !MakeCuts(world, work, &made)) {
        return KIRI_ERROR_MEMORY;
    }
    QueueStrokes(world, work, &made);
    KeepLayers(blade, work);
    return KIRI_OK;
}

kiriResult kiriWorld_MoveBlade(kiriWorld* world, kiriBladeData* blade, kiriVec3 from, kiriVec3 to)
{
    const kiriVec3 edge[2] = { from, to };
    kiriBladeWork work;
    memset(&work, 0, sizeof(work));
    work.memory = kiriMemory_Like(&world->memory);
    kiriResult result = KIRI_ERROR_MEMORY;
    if (ListPending(&work, world, blade) && StartTracks(&work, world, blade) && TakeSteps(&work, world, blade, edge)) {
        result = Apply(world, blade, &work);
    }
    kiriMemory_FreeAll(&work.memory);
    if (result == KIRI_OK) {
        blade->edge[0] = from;
        blade->edge[1] = to;
        blade->isPlaced = true;
        blade->elapsed = 0.0;
    }
    return result;
}
