#include "kiri_blade.h"
#include "../mesh/kiri_lip.h"
#include "../sheet/kiri_seen.h"

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

/* What a blade cuts: points are added to the strokes of its tracks, and loops are closed. */

/* Shares of the length of a loop: as near as CLOSING it comes by its beginning; it is closed when it has gone on by
   OVERLAP. It has come ROUND times as far as it would go straight back: a way out and back encloses nothing. */
#define CLOSING 0.015
#define OVERLAP 0.1
#define ROUND 1.5

/* The stroke of a track, which begins where the track is when its cut is new. KIRI_NONE for memory. */
static int32_t StrokeOf(kiriBladeWork* work, kiriTrack* track)
{
    if (track->stroke == KIRI_NONE) {
        const kiriStroke stroke = { track->sheet, track->cut, false };
        const kiriStrokePoint start = { work->strokes.count, track->rest, true };
        if (!kiriArray_Push(&work->memory, &work->strokes, stroke) ||
            (track->cut == NULL && !kiriArray_Push(&work->memory, &work->points, start))) {
            return KIRI_NONE;
        }
        track->stroke = work->strokes.count - 1;
    }
    return track->stroke;
}

static bool AddCut(kiriBladeWork* work, int32_t stroke, kiriVec2 from, kiriVec2 to)
{
    const kiriStrokePoint point = { stroke, to, false };
    const kiriPendingLip lip = { work->sheet, from, to, stroke };
    return kiriArray_Push(&work->memory, &work->points, point) && kiriArray_Push(&work->memory, &work->pending, lip);
}

static bool AddStart(kiriBladeWork* work, int32_t stroke, kiriVec2 rest)
{
    const kiriStrokePoint point = { stroke, rest, true };
    return kiriArray_Push(&work->memory, &work->points, point);
}

static bool AddPoint(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    int32_t stroke = StrokeOf(work, track);
    kiriVec2 from = track->rest;
    track->loop.length += kiriRest_Distance(from, rest);
    track->rest = rest;
    return stroke != KIRI_NONE && AddCut(work, stroke, from, rest);
}

bool kiriLoop_IsNear(const kiriLoop* loop, kiriVec2 end)
{
    return loop->isOpen && kiriRest_Distance(loop->start, end) < CLOSING * loop->length;
}

/* On the way to a place: it is nearest here, no longer on the way there. */
static void NotePassing(kiriTrack* track, kiriVec2 to)
{
    kiriLoop* loop = &track->loop;
    kiriVec2 way = kiriVec2_Sub(to, track->rest), left = kiriVec2_Sub(loop->start, track->rest);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(left, way) / square : 0.0;
    kiriVec2 near = kiriVec2_Add(track->rest, kiriVec2_Scale(share > 0.0 ? share : 0.0, way));
    bool isRound = loop->length > ROUND * kiriRest_Distance(track->rest, near);
    if (!loop->isPassed && share <= 1.0 && isRound && kiriLoop_IsNear(loop, near)) {
        loop->isPassed = true;
        loop->near = near;
        loop->then = loop->length;
    }
}

/* From where it came by, and back to where it is. */
static bool CloseLoop(kiriBladeWork* work, kiriTrack* track)
{
    int32_t stroke = StrokeOf(work, track);
    bool ok = stroke != KIRI_NONE && AddStart(work, stroke, track->loop.near) &&
              AddCut(work, stroke, track->loop.near, track->loop.start) && AddStart(work, stroke, track->rest);
    track->loop.isOpen = track->loop.isPassed = false;
    return ok;
}

/* ---- An edge that is held ---- */

/* Snap distances: a way that stays nearer to lips than BESIDE_LIP is in a slit, and so is an edge that is held nearer to one
   than SLIT. Points nearer to a lip than ON_LIP are on it. */
#define BESIDE_LIP 1.5
#define ON_LIP 0.75
#define SLIT 64.0

kiriVec2 kiriRest_Foot(kiriVec2 a, kiriVec2 b, kiriVec2 p)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(kiriVec2_Sub(p, a), way) / square : 0.0;
    return kiriVec2_Add(a, kiriVec2_Scale(share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share, way));
}

static void FindLipInTriangle(const kiriMeshData* mesh, int32_t triangle, kiriVec2 rest, bool isOpen, double* distance,
                              kiriVec2* lip)
{
    for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        if (kiriMesh_Twin(mesh, h) == KIRI_NONE || (isOpen && kiriMesh_IsOpen(mesh, h))) {
            kiriVec2 foot = kiriRest_Foot(
                kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at),
                kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at), rest);
            double d = kiriRest_Distance(foot, rest);
            *lip = d < *distance ? foot : *lip;
            *distance = d < *distance ? d : *distance;
        }
    }
}

bool kiriBlade_FindLip(const kiriMeshData* mesh, kiriVec2 rest, double distance, bool isOpen, kiriVec2* lip)
{
    kiriLatticePoint at = kiriMesh_Snap(mesh, rest);
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, at, at, distance / mesh->step);
    double least = distance;
    while (kiriStrips_Next(&strips)) {
        for (int32_t i = 0; i < strips.count; ++i) {
            int32_t slot = mesh->squares.head[strips.square + i * strips.stride];
            for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
                FindLipInTriangle(mesh, mesh->squares.nodes.data[slot].triangle, rest, isOpen, &least, lip);
            }
        }
    }
    return least < distance;
}

bool kiriBlade_FindSlit(const kiriBladeWork* work, kiriVec2 rest, double distance, kiriVec2* slit)
{
    bool isFound = kiriBlade_FindLip(&work->sheet->mesh, rest, distance, true, slit);
    distance = isFound ? kiriRest_Distance(*slit, rest) : distance;
    for (int32_t i = 0; i < work->pending.count; ++i) {
        const kiriPendingLip* lip = &work->pending.data[i];
        kiriVec2 foot = kiriRest_Foot(lip->from, lip->to, rest);
        if (lip->sheet == work->sheet && kiriRest_Distance(foot, rest) < distance) {
            distance = kiriRest_Distance(foot, rest);
            *slit = foot;
            isFound = true;
        }
    }
    return isFound;
}

/* Shortens a loop to the straight way from its start. */
static void StraightenLoop(kiriTrack* track)
{
    track->loop.isPassed = false;
    track->loop.length = kiriRest_Distance(track->loop.start, track->rest);
}

/* Puts a track elsewhere in the slit. */
static bool Slide(kiriBladeWork* work, kiriTrack* track, kiriVec2 slit)
{
    track->rest = slit;
    StraightenLoop(track);
    if (track->cut == NULL && track->stroke == KIRI_NONE) {
        return true;
    }
    int32_t stroke = StrokeOf(work, track);
    return stroke != KIRI_NONE && AddStart(work, stroke, slit);
}

/* The edge slides in slits that are near instead of cutting beside them. Where it is nearer to the outline it cuts to
   it. */
static bool LeadHeld(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    enum { MOST = 64 };
    const kiriMeshData* mesh = &work->sheet->mesh;
    double near = SLIT * work->snap, length = kiriRest_Distance(track->rest, rest);
    int32_t count = length < 0.5 * MOST * near ? 1 + (int32_t)(length / (0.5 * near)) : 1;
    kiriVec2 from = track->rest;
    bool ok = true;
    for (int32_t i = 1; ok && i <= count; ++i) {
        kiriVec2 at = kiriVec2_Add(from, kiriVec2_Scale((double)i / count, kiriVec2_Sub(rest, from)));
        kiriVec2 slit, other, here;
        bool isNear = kiriBlade_FindSlit(work, at, near, &slit);
        if (!isNear && kiriBlade_FindSlit(work, at, 2.0 * near, &slit)) {
            ok = (kiriRest_Distance(slit, track->rest) < work->snap || Slide(work, track, slit)) &&
                 AddPoint(work, track, at);
        } else if (!isNear) {
            ok = AddPoint(work, track, at);
        } else if (kiriBlade_FindLip(mesh, at, near, false, &other) &&
                   !kiriBlade_FindLip(mesh, track->rest, work->snap, false, &here)) {
            ok = AddPoint(work, track, at) && AddPoint(work, track, other);
        } else if (!kiriBlade_FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(track->rest, slit)), 0.25 * near,
                                       &other)) {
            ok = AddPoint(work, track, at) && AddPoint(work, track, slit);
        } else if (kiriRest_Distance(slit, track->rest) > work->snap) {
            ok = Slide(work, track, slit);
        }
    }
    StraightenLoop(track);
    return ok;
}

/* ---- Ways ---- */

/* Follows a slit along a way that keeps to it. There is nothing to cut then, and the track goes on from the slit itself,
   not from beside it. The feet of points a snap apart must lead along lips: one that jumps to another slit would leave
   a bridge between the slits. A way to the outline is cut, so that it parts. */
static bool IsInSlit(const kiriBladeWork* work, kiriVec2 from, kiriVec2 to, kiriVec2* end)
{
    enum { MOST_PLACES = 4096 };
    double length = kiriRest_Distance(from, to) / work->snap;
    int32_t places = 1 + (int32_t)fmin(length, MOST_PLACES);
    kiriVec2 slit, last;
    bool isInSlit = places <= MOST_PLACES && kiriBlade_FindSlit(work, to, BESIDE_LIP * work->snap, end) &&
                    !kiriBlade_FindLip(&work->sheet->mesh, to, 2.0 * BESIDE_LIP * work->snap, false, &slit);
    last = *end;
    for (int32_t i = places - 1; isInSlit && i >= 0; --i) {
        kiriVec2 at = kiriVec2_Add(from, kiriVec2_Scale((double)i / places, kiriVec2_Sub(to, from)));
        isInSlit = kiriBlade_FindSlit(work, at, BESIDE_LIP * work->snap, &slit) &&
                   kiriBlade_FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(last, slit)), ON_LIP * work->snap, &last);
        last = slit;
    }
    return isInSlit;
}

bool kiriTrack_Lead(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    if (work->isHeld) {
        return LeadHeld(work, track, rest);
    }
    kiriVec2 slit;
    if (IsInSlit(work, track->rest, rest, &slit)) {
        return Slide(work, track, slit);
    }
    NotePassing(track, rest);
    bool ok = AddPoint(work, track, rest);
    bool hasGoneOn = track->loop.isPassed && track->loop.length > (1.0 + OVERLAP) * track->loop.then;
    return ok && (!hasGoneOn || CloseLoop(work, track));
}

bool kiriTrack_LeadAlong(kiriBladeWork* work, kiriTrack* track)
{
    bool ok = true;
    kiriVec2 start = track->rest;
    for (int32_t i = 0; ok && i < work->path.count; ++i) {
        bool isHere =
            i + 1 < work->path.count && kiriRest_Distance(work->path.data[i], start) < KIRI_BLADE_SAME * work->snap;
        start = isHere ? start : kiriVec2_Make(1e300, 1e300);
        ok = isHere || kiriTrack_Lead(work, track, work->path.data[i]);
    }
    return ok;
}

/* ---- The end ---- */

/* Is there material around the end of a track, though it went over a border? Then it has crossed a cut. */
static bool IsAtLip(const kiriTrack* track)
{
    const kiriMeshData* mesh = &track->sheet->mesh;
    return kiriMesh_Locate(mesh, kiriMesh_Snap(mesh, track->rest)) != KIRI_NONE;
}

bool kiriTrack_End(kiriBladeWork* work, kiriTrack* track)
{
    bool isIdle = track->cut == NULL && track->stroke == KIRI_NONE;
    bool ok = !track->loop.isPassed || IsAtLip(track) || CloseLoop(work, track);
    track->isDone = track->isOver = true;
    if (!isIdle) {
        int32_t stroke = StrokeOf(work, track);
        ok = ok && stroke != KIRI_NONE;
        if (ok) {
            work->strokes.data[stroke].isOver = true;
        }
    }
    return ok;
}

/* Measured in snap distances: nearer in the rest plane than STILL a layer is not led on; past a border a cut goes on by
   REACH, which is less than what a blade snaps to, so that it cuts no notch into what is beyond. */
#define STILL 2.0
#define REACH 0.5
#define STRAIGHT 0.25
#define DEGENERATE 0.25

static kiriVec3 EdgeAt(const kiriVec3* edge, double share)
{
    return kiriVec3_AddScaled(edge[0], share, kiriVec3_Sub(edge[1], edge[0]));
}

/* The foot of x on the line through the edge, as a share of it. */
static double ShareOf(const kiriVec3* edge, kiriVec3 x)
{
    kiriVec3 way = kiriVec3_Sub(edge[1], edge[0]);
    double square = kiriVec3_Dot(way, way);
    return square > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(x, edge[0]), way) / square : 0.0;
}

/* ---- Places in the material ---- */

/* Finds where a place in the material is seen. A lip has a place on each side; the one nearest to `by` is taken, because
   a piece that came off may have fallen far. False where the sheet has no material. */
static bool Seen(const kiriSheetData* sheet, kiriVec2 rest, kiriVec3 by, kiriVec3* at)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    kiriLatticePoint p = kiriMesh_Snap(&sheet->mesh, rest), c[3];
    int32_t square = kiriSquares_At(squares, p);
    double nearest = 1e300;
    bool isFound = false;
    for (int32_t n = square == KIRI_NONE ? KIRI_NONE : squares->head[square]; n != KIRI_NONE;
         n = squares->nodes.data[n].next) {
        int32_t triangle = squares->nodes.data[n].triangle;
        kiriMesh_Corners(&sheet->mesh, triangle, c);
        const int32_t* v = sheet->mesh.triangles.data[triangle].vertex;
        const int64_t part[3] = { kiriOrient(c[1], c[2], p), kiriOrient(c[2], c[0], p), kiriOrient(c[0], c[1], p) };
        if (part[0] < 0 || part[1] < 0 || part[2] < 0) {
            continue;
        }
        double whole = (double)kiriOrient(c[0], c[1], c[2]);
        kiriVec3 seen = kiriVec3_Make(0.0, 0.0, 0.0);
        for (int k = 0; k < 3; ++k) {
            seen = kiriVec3_AddScaled(seen, (double)part[k] / whole, kiriSurface_At(&sheet->seen.surface, v[k]));
        }
        double distance = kiriVec3_Length(kiriVec3_Sub(seen, by));
        if (!isFound || distance < nearest) {
            nearest = distance;
            *at = seen;
            isFound = true;
        }
    }
    return isFound;
}

/* How the frames move a vertex. */
static kiriVec3 VelocityOf(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < span.count; ++i) {
        kiriSampleWeight w = sheet->vertexSkin.weights.data[span.first + i];
        kiriVec2 rest = sheet->seen.surface.rest.data[vertex];
        sum = kiriVec3_AddScaled(sum, w.value,
                                 kiriFrame_VelocityAt(&sheet->frames.data[kiriSheet_FrameOf(sheet, w.label)], rest));
    }
    return sum;
}

/* How far the material of a triangle has gone since the edge was where it was. */
static kiriVec3 DriftOf(const kiriBladeWork* work, int32_t triangle)
{
    const int32_t* v = work->sheet->mesh.triangles.data[triangle].vertex;
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3; ++k) {
        sum = kiriVec3_AddScaled(sum, work->elapsed / 3.0, VelocityOf(work->sheet, v[k]));
    }
    return sum;
}

/* ---- Crossings ---- */

enum { TAKEN = -1 }; /* the triangle of a crossing that belongs to a track */

/* The nearest crossing that is free, up to a distance in the rest plane; null: there is none. */
static kiriCrossing* NearestCrossing(const kiriBladeWork* work, kiriVec2 rest, double distance)
{
    kiriCrossing* nearest = NULL;
    for (int32_t i = 0; i < work->crossings.count; ++i) {
        kiriCrossing* crossing = &work->crossings.data[i];
        double d = kiriRest_Distance(crossing->rest, rest);
        if (crossing->triangle != TAKEN && d <= distance) {
            distance = d;
            nearest = crossing;
        }
    }
    return nearest;
}

/* The track is in the layer at this crossing, and is led there, unless that is no way. */
static bool GoOn(kiriBladeWork* work, kiriTrack* track, kiriCrossing* crossing)
{
    bool isStill = kiriRest_Distance(track->rest, crossing->rest) < STILL * work->snap;
    bool ok = isStill || kiriTrack_Lead(work, track, crossing->rest);
    track->at = crossing->at;
    track->share = crossing->share;
    track->isDone = true;
    crossing->triangle = TAKEN;
    return ok;
}

/* ---- Lines of the section ---- */

/* The line with an end at a place, the longest where there are several; *fromLast says which end. Null: none. */
static const kiriSectionLine* LineFrom(const kiriBladeWork* work, kiriVec2 rest, bool* fromLast)
{
    const kiriSection* section = &work->section;
    const kiriSectionLine* found = NULL;
    double longest = -1.0;
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        const kiriSectionPoint* points = &section->points.data[line->first];
        double d[2] = { kiriRest_Distance(points[0].rest, rest),
                        kiriRest_Distance(points[line->count - 1].rest, rest) };
        int end = d[0] <= d[1] ? 0 : 1;
        if (d[end] < KIRI_BLADE_SAME * work->snap && d[1 - end] > longest) {
            longest = d[1 - end];
            found = line;
            *fromLast = end == 1;
        }
    }
    return found;
}

static const kiriSectionPoint* EndOfWay(const kiriBladeWork* work, const kiriSectionLine* line, bool last)
{
    return &work->section.points.data[line->first + (last ? line->count - 1 : 0)];
}

static bool FindPath(kiriBladeWork* work, const kiriSectionLine* line, bool fromLast)
{
    work->path.count = 0;
    return kiriSection_Path(&work->section, line, fromLast, REACH * work->snap, STRAIGHT * work->snap, &work->memory,
                            &work->path);
}

/* The section with what the edge sweeps in a plane. `from` and `to` are on its way. False for memory. */
static bool CutPlane(kiriBladeWork* work, const kiriVec3* was, const kiriVec3* is, kiriVec3 from, kiriVec3 to)
{
    const kiriVec3 corner[4] = { was[0], was[1], is[1], is[0] };
    const kiriSurface* surface = &work->sheet->seen.surface;
    kiriWindow window;
    work->section.points.count = work->section.lines.count = 0;
    return !kiriWindow_Make(&window, corner, from, to) ||
           kiriSection_Add(&work->section, &work->memory, surface, work->sheet->seen.bounds, &window);
}

/* The ends of an edge, brought into the plane through the other edge and x. False where x lies on the other edge: there
   is no way from one to the other. */
static bool Flatten(const kiriBladeWork* work, const kiriVec3* other, kiriVec3 x, const kiriVec3* edge, kiriVec3* flat)
{
    kiriVec3 along = kiriVec3_Normalize(kiriVec3_Sub(other[1], other[0]));
    kiriVec3 normal = kiriVec3_Cross(along, kiriVec3_Sub(x, other[0]));
    double distance = kiriVec3_Length(normal);
    if (!(distance > DEGENERATE * work->snap)) {
        return false;
    }
    normal = kiriVec3_Scale(1.0 / distance, normal);
    for (int k = 0; k < 2; ++k) {
        flat[k] = kiriVec3_AddScaled(edge[k], -kiriVec3_Dot(normal, kiriVec3_Sub(edge[k], other[0])), normal);
    }
    return true;
}

/* ---- Layers that the blade was in ---- */

/* The track at the other end of a line over a fold: the nearest one that is not seen to, or null. Its material has gone
   another way than that of this track, and where the edge only touches the fold that counts for much: so it need not be
   where the line ends, but nearer to it than this track. */
static kiriTrack* OtherTrack(kiriBladeWork* work, const kiriTrack* track, kiriVec2 rest)
{
    double nearest = kiriRest_Distance(track->rest, rest);
    kiriTrack* found = NULL;
    for (int32_t i = 0; i < work->oldCount; ++i) {
        kiriTrack* other = &work->tracks.data[i];
        double distance = kiriRest_Distance(other->rest, rest);
        if (other != track && other->sheet == work->sheet && !other->isDone && distance < nearest) {
            nearest = distance;
            found = other;
        }
    }
    return found;
}

/* Where the line that a track follows ends: at the edge as it is now, and the track goes on from there; beyond a
   border; where the blade ended; or, over a fold, at another layer that the blade was in. */
static bool FollowLine(kiriBladeWork* work, kiriTrack* track, const kiriSectionLine* line, bool fromLast)
{
    const kiriSectionPoint* end = EndOfWay(work, line, !fromLast);
    int32_t type = line->end[fromLast ? 0 : 1];
    kiriCrossing* crossing =
        type == KIRI_SIDE_TO ? NearestCrossing(work, end->rest, KIRI_BLADE_SAME * work->snap) : NULL;
    bool isStill = crossing != NULL && kiriRest_Distance(track->rest, crossing->rest) < STILL * work->snap;
    kiriTrack* other = type == KIRI_SIDE_FROM ? OtherTrack(work, track, end->rest) : NULL;
    bool ok = isStill || (FindPath(work, line, fromLast) && kiriTrack_LeadAlong(work, track));
    if (!ok || crossing != NULL) {
        return ok && GoOn(work, track, crossing);
    }
    if (other != NULL) {
        ok = kiriTrack_Lead(work, track, other->rest) && kiriTrack_End(work, other);
    }
    bool isLost = type == KIRI_SIDE_FROM && other == NULL;
    return ok && (isLost || kiriTrack_End(work, track));
}

/* Is the line more than what is around its beginning? */
static bool LeadsOn(const kiriBladeWork* work, const kiriSectionLine* line, bool fromLast)
{
    double length = kiriRest_Distance(EndOfWay(work, line, false)->rest, EndOfWay(work, line, true)->rest);
    return line->end[fromLast ? 0 : 1] == KIRI_SIDE_TO || length > KIRI_BLADE_SAME * work->snap;
}

/* To a border that is here, perhaps; but the way may go on elsewhere (PassAlong): the track counts as lost. */
static bool FollowShort(kiriBladeWork* work, kiriTrack* track, const kiriSectionLine* line, bool fromLast)
{
    kiriVec2 rest = track->rest;
    bool ok = line->end[fromLast ? 0 : 1] != KIRI_END_BORDER ||
              (FindPath(work, line, fromLast) && kiriTrack_LeadAlong(work, track));
    track->rest = rest;
    return ok;
}

/* From where the edge would be now, had it gone on with the material, to where it is. */
static bool FollowTrack(kiriBladeWork* work, kiriTrack* track)
{
    kiriVec3 x, to = EdgeAt(work->is, track->share);
    if (!Seen(work->sheet, track->rest, track->at, &x)) {
        return true;
    }
    work->drift = kiriVec3_Sub(x, track->at);
    const kiriVec3 was[2] = { kiriVec3_Add(work->was[0], work->drift), kiriVec3_Add(work->was[1], work->drift) };
    kiriVec3 flat[2];
    const kiriSectionLine* line = NULL;
    bool fromLast = false;
    if (Flatten(work, work->is, x, was, flat)) {
        if (!CutPlane(work, flat, work->is, x, to)) {
            return false;
        }
        line = LineFrom(work, track->rest, &fromLast);
        if (line != NULL && LeadsOn(work, line, fromLast)) {
            return FollowLine(work, track, line, fromLast);
        }
    }
    /* Hardly any way, or the tip of the cut stands out of the surface: then the layer is where the edge is nearest in
       the material. */
    double way = kiriVec3_Length(kiriVec3_Sub(to, x));
    kiriCrossing* crossing = NearestCrossing(work, track->rest, 2.0 * way + KIRI_BLADE_SAME * work->snap);
    return crossing != NULL ? GoOn(work, track, crossing) : line == NULL || FollowShort(work, track, line, fromLast);
}

/* ---- Layers that it has come into ---- */

/* A track that was not found again, in whatever sheet its material is now, near where a line begins. */
static const kiriTrack* LostTrack(const kiriBladeWork* work, kiriVec2 rest, double distance)
{
    const kiriTrack* nearest = NULL;
    for (int32_t i = 0; i < work->oldCount; ++i) {
        const kiriTrack* track = &work->tracks.data[i];
        double d = kiriRest_Distance(track->rest, rest);
        if (track->isLost && d <= distance) {
            distance = d;
            nearest = track;
        }
    }
    return nearest;
}

static kiriLoop LoopFrom(kiriVec2 rest, bool isOpen)
{
    const kiriLoop loop = { isOpen, false, rest, rest, 0.0, 0.0 };
    return loop;
}

static bool AddTrack(kiriBladeWork* work, const kiriCrossing* crossing, kiriVec2 rest, kiriLoop loop)
{
    const kiriTrack track = { work->sheet,     NULL, KIRI_NONE, rest,  crossing->at,
                              crossing->share, loop, true,      false, false };
    return kiriArray_Push(&work->memory, &work->tracks, track);
}

/* The crossing where a line over a fold begins. The line is in the plane of the crossing at its other end, and begins
   beside this one: it need only be nearer to it than to that one. */
static kiriCrossing* OtherCrossing(kiriBladeWork* work, kiriCrossing* crossing, kiriVec2 rest)
{
    int32_t triangle = crossing->triangle;
    crossing->triangle = TAKEN;
    kiriCrossing* other = NearestCrossing(work, rest, kiriRest_Distance(crossing->rest, rest));
    crossing->triangle = triangle;
    return other;
}

/* As far as a border or a lip that a blade went over unseen may be, as a share of the sheet's longer side. */
#define BORDER_DISTANCE 0.05

/* From the beginning of the line to the crossing at its other end. */
static bool EnterAlong(kiriBladeWork* work, kiriCrossing* crossing, const kiriSectionLine* line, bool fromLast,
                       double near)
{
    const kiriSectionPoint* start = EndOfWay(work, line, fromLast);
    int32_t type = line->end[fromLast ? 1 : 0];
    kiriCrossing* other = type == KIRI_SIDE_TO ? OtherCrossing(work, crossing, start->rest) : NULL;
    const kiriTrack* lost = type == KIRI_SIDE_FROM ? LostTrack(work, start->rest, near) : NULL;
    if (!FindPath(work, line, fromLast)) {
        return false;
    }
    kiriVec2 from = lost != NULL ? lost->rest : work->path.data[0];
    kiriLoop loop = lost != NULL ? lost->loop : LoopFrom(from, type != KIRI_END_BORDER);
    if (other != NULL) {
        other->triangle = TAKEN;
        if (!AddTrack(work, other, from, LoopFrom(from, true))) {
            return false;
        }
    }
    if (!AddTrack(work, crossing, from, loop)) {
        return false;
    }
    kiriTrack* track = &work->tracks.data[work->tracks.count - 1];
    return kiriTrack_LeadAlong(work, track) && GoOn(work, track, crossing);
}

/* The line that leads to the crossing from where the edge was. Where the material was then is known only nearly, and an
   edge that comes into a layer comes over a border, but for its ends: so from farther back where there is a border. */
static bool FindLineTo(kiriBladeWork* work, const kiriCrossing* crossing, const kiriVec3* was, const kiriVec3* flat,
                       const kiriSectionLine** line, bool* fromLast)
{
    static const double farther[] = { 0.5, 2.0, 8.0, 0.0 };
    kiriVec3 from = EdgeAt(was, crossing->share), back = kiriVec3_Sub(from, crossing->at);
    double length = kiriVec3_Length(back);
    for (int i = 0; i < 4; ++i) {
        kiriVec3 more = kiriVec3_Scale(farther[i] * (1.0 + 8.0 * work->snap / length), back);
        const kiriVec3 edge[2] = { kiriVec3_Add(was[0], more), kiriVec3_Add(was[1], more) };
        if (!CutPlane(work, edge, flat, kiriVec3_Add(from, more), crossing->at)) {
            return false;
        }
        *line = LineFrom(work, crossing->rest, fromLast);
        if (*line != NULL && (*line)->end[*fromLast ? 0 : 1] != KIRI_SIDE_FROM) {
            break;
        }
    }
    return true;
}

static bool EnterLayer(kiriBladeWork* work, kiriCrossing* crossing)
{
    kiriVec3 drift = DriftOf(work, crossing->triangle), flat[2];
    const kiriVec3 was[2] = { kiriVec3_Add(work->was[0], drift), kiriVec3_Add(work->was[1], drift) };
    const kiriSectionLine* line = NULL;
    bool fromLast = false;
    work->drift = drift;
    if (Flatten(work, was, crossing->at, work->is, flat) && !FindLineTo(work, crossing, was, flat, &line, &fromLast)) {
        return false;
    }
    if (line != NULL) {
        double near = kiriVec3_Length(kiriVec3_Sub(EdgeAt(was, crossing->share), crossing->at));
        return EnterAlong(work, crossing, line, !fromLast, 2.0 * near + KIRI_BLADE_SAME * work->snap);
    }
    bool ok = AddTrack(work, crossing, crossing->rest, LoopFrom(crossing->rest, true));
    crossing->triangle = TAKEN;
    return ok;
}

/* ---- Layers that it has passed through ---- */

static kiriSectionPoint MiddleOf(const kiriSection* section, const kiriSectionLine* line)
{
    const kiriSectionPoint* b = &section->points.data[line->first + line->count / 2];
    kiriSectionPoint middle = { kiriVec2_Scale(0.5, kiriVec2_Add(b[-1].rest, b->rest)),
                                kiriVec3_Scale(0.5, kiriVec3_Add(b[-1].at, b->at)) };
    return middle;
}

/* Has the step led a cut through the middle of the line already? */
static bool IsLed(const kiriBladeWork* work, const kiriSectionLine* line)
{
    kiriVec2 rest = MiddleOf(&work->section, line).rest;
    double near = 2.0 * KIRI_BLADE_SAME * work->snap + kiriVec3_Length(work->drift);
    bool isLed = false;
    for (int32_t i = work->firstPending; !isLed && i < work->pending.count; ++i) {
        const kiriPendingLip* lip = &work->pending.data[i];
        isLed = lip->sheet == work->sheet && kiriVec2_DistanceToWay(rest, lip->from, lip->to) < near;
    }
    return isLed;
}

/* Lines from a layer that the blade is in, or was in, are those of tracks; but for a track that was lost. */
static bool PassAlong(kiriBladeWork* work, const kiriSectionLine* line)
{
    double near = 2.0 * kiriVec3_Length(work->drift) + KIRI_BLADE_SAME * work->snap;
    int inner = line->end[0] == KIRI_SIDE_FROM ? 0 : line->end[1] == KIRI_SIDE_FROM ? 1 : KIRI_NONE;
    const kiriSectionPoint *first = EndOfWay(work, line, false), *last = EndOfWay(work, line, true);
    if (line->end[0] == KIRI_SIDE_TO || line->end[1] == KIRI_SIDE_TO || IsLed(work, line)) {
        return true;
    }
    const kiriTrack* lost = inner != KIRI_NONE ? LostTrack(work, inner == 0 ? first->rest : last->rest, near) : NULL;
    if (inner != KIRI_NONE && (lost == NULL || line->end[1 - inner] == KIRI_SIDE_FROM)) {
        return true;
    }
    if (!FindPath(work, line, inner == 1)) {
        return false;
    }
    kiriVec2 from = lost != NULL ? lost->rest : work->path.data[0];
    kiriTrack track = {
        work->sheet, NULL, KIRI_NONE, from, work->is[0], 0.0, LoopFrom(from, false), false, false, false
    };
    return kiriTrack_LeadAlong(work, &track) && kiriTrack_End(work, &track);
}

static const kiriSectionLine* LineNear(const kiriSection* section, kiriVec2 rest)
{
    const kiriSectionLine* nearest = NULL;
    double least = 1e300;
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        for (int32_t k = line->first; k + 1 < line->first + line->count; ++k) {
            const kiriSectionPoint* at = &section->points.data[k];
            double distance = kiriVec2_DistanceToWay(rest, at->rest, at[1].rest);
            nearest = distance < least ? line : nearest;
            least = distance < least ? distance : least;
        }
    }
    return nearest;
}

/* The sweep of an edge that turns, near a place on it: in the plane that touches it there. */
static bool PassNear(kiriBladeWork* work, const kiriVec3 was[2], const kiriSectionPoint* place)
{
    kiriVec3 edge[2], from = was[0], way = { 0.0, 0.0, 0.0 }, flat[4];
    double share = 0.5, time = 0.5;
    for (int k = 0; k < 3; ++k) {
        edge[0] = kiriVec3_AddScaled(was[0], time, kiriVec3_Sub(work->is[0], was[0]));
        edge[1] = kiriVec3_AddScaled(was[1], time, kiriVec3_Sub(work->is[1], was[1]));
        share = ShareOf(edge, place->at);
        from = EdgeAt(was, share);
        way = kiriVec3_Sub(EdgeAt(work->is, share), from);
        double square = kiriVec3_Dot(way, way);
        time = square > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(place->at, from), way) / square : 0.0;
    }
    kiriVec3 normal = kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(edge[1], edge[0]), way));
    const kiriVec3 corner[4] = { was[0], was[1], work->is[0], work->is[1] };
    for (int k = 0; k < 4; ++k) {
        flat[k] = kiriVec3_AddScaled(corner[k], -kiriVec3_Dot(normal, kiriVec3_Sub(corner[k], from)), normal);
    }
    if (!CutPlane(work, flat, flat + 2, from, kiriVec3_Add(from, way))) {
        return false;
    }
    const kiriSectionLine* line = LineNear(&work->section, place->rest);
    return line == NULL || PassAlong(work, line);
}

static bool IsFlat(const kiriBladeWork* work, const kiriVec3 corner[4])
{
    kiriVec3 normal =
        kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(corner[2], corner[0]), kiriVec3_Sub(corner[3], corner[1])));
    return fabs(kiriVec3_Dot(normal, kiriVec3_Sub(corner[1], corner[0]))) < DEGENERATE * work->snap;
}

/* Where the edge neither is nor was in a layer, nobody has said how far the material went: it may have come over the
   edge meanwhile, and then the sweep seems to begin inside it. */
static bool FindDrift(kiriBladeWork* work)
{
    const kiriSheetData* sheet = work->sheet;
    const kiriVec3 corner[4] = { work->was[0], work->was[1], work->is[1], work->is[0] };
    bool ok = kiriSection_Sweep(&work->section, &work->memory, &sheet->seen.surface, sheet->seen.bounds, corner);
    if (ok && work->section.lines.count > 0) {
        kiriVec2 rest = MiddleOf(&work->section, &work->section.lines.data[0]).rest;
        int32_t triangle = kiriMesh_Locate(&sheet->mesh, kiriMesh_Snap(&sheet->mesh, rest));
        work->drift = triangle != KIRI_NONE ? DriftOf(work, triangle) : work->drift;
    }
    return ok;
}

static bool PassThrough(kiriBladeWork* work)
{
    const kiriSheetData* sheet = work->sheet;
    bool isKnown = kiriVec3_Dot(work->drift, work->drift) > 0.0;
    if (!isKnown && !FindDrift(work)) {
        return false;
    }
    const kiriVec3 corner[4] = { kiriVec3_Add(work->was[0], work->drift), kiriVec3_Add(work->was[1], work->drift),
                                 work->is[1], work->is[0] };
    bool isFlat = IsFlat(work, corner);
    bool ok = kiriSection_Sweep(&work->section, &work->memory, &sheet->seen.surface, sheet->seen.bounds, corner);
    work->middles.count = 0;
    for (int32_t i = 0; ok && i < work->section.lines.count; ++i) {
        const kiriSectionLine* line = &work->section.lines.data[i];
        ok = isFlat ? PassAlong(work, line)
                    : kiriArray_Push(&work->memory, &work->middles, MiddleOf(&work->section, line));
    }
    for (int32_t i = 0; ok && i < work->middles.count; ++i) {
        ok = PassNear(work, corner, &work->middles.data[i]);
    }
    return ok;
}

/* ---- Layers that it was not found in ---- */

/* Finds the nearest point of what other tracks cut in this step, nearer than `distance`. */
static bool FindOtherWay(const kiriBladeWork* work, const kiriTrack* track, double distance, kiriVec2* place)
{
    bool isFound = false;
    for (int32_t i = work->firstPending; i < work->pending.count; ++i) {
        const kiriPendingLip* lip = &work->pending.data[i];
        kiriVec2 foot = kiriRest_Foot(lip->from, lip->to, track->rest);
        double d = kiriRest_Distance(foot, track->rest);
        if (lip->sheet == work->sheet && lip->stroke != track->stroke && d < distance) {
            distance = d;
            *place = foot;
            isFound = true;
        }
    }
    return isFound;
}

/* Ends a layer that the edge is in no longer. The edge went out over a border, or came in again on another way: where
   one of these is near, the cut goes on to it. */
static bool EndLost(kiriBladeWork* work, kiriTrack* track)
{
    kiriVec3 x;
    kiriVec2 place;
    bool ok = true;
    if (Seen(work->sheet, track->rest, track->at, &x)) {
        double near = 2.0 * kiriVec3_Length(kiriVec3_Sub(x, EdgeAt(work->is, track->share))) + 8.0 * work->snap;
        near = kiriMin(near, BORDER_DISTANCE * KIRI_LATTICE * work->sheet->mesh.step);
        bool isFound = kiriBlade_FindLip(&work->sheet->mesh, track->rest, near, false, &place);
        near = isFound ? kiriRest_Distance(track->rest, place) : near;
        isFound = FindOtherWay(work, track, near, &place) || isFound;
        ok = !isFound || kiriTrack_Lead(work, track, place);
    }
    return ok && kiriTrack_End(work, track);
}

/* ---- One step ---- */

bool kiriBlade_Step(kiriBladeWork* work)
{
    kiriSheetData* sheet = work->sheet;
    bool ok = true;
    work->snap = sheet->settings.snap * sheet->mesh.step;
    work->firstPending = work->pending.count;
    work->isHeld = kiriVec3_Length(kiriVec3_Sub(work->is[0], work->was[0])) < work->snap &&
                   kiriVec3_Length(kiriVec3_Sub(work->is[1], work->was[1])) < work->snap;
    work->crossings.count = 0;
    work->drift = kiriVec3_Make(0.0, 0.0, 0.0);
    ok = kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) &&
         kiriSurface_Cross(&sheet->seen.surface, sheet->seen.bounds, work->is[0], work->is[1], DEGENERATE * work->snap,
                           &work->memory, &work->crossings);
    for (int32_t i = 0; ok && i < work->oldCount; ++i) {
        kiriTrack* track = &work->tracks.data[i];
        if (track->sheet == sheet && !track->isDone) {
            ok = FollowTrack(work, track);
            track->isLost = !track->isDone;
        }
    }
    for (int32_t i = 0; ok && i < work->crossings.count; ++i) {
        if (work->crossings.data[i].triangle != TAKEN) {
            ok = EnterLayer(work, &work->crossings.data[i]);
        }
    }
    ok = ok && PassThrough(work);
    for (int32_t i = 0; ok && i < work->oldCount; ++i) {
        kiriTrack* track = &work->tracks.data[i];
        ok = track->sheet != sheet || !track->isLost || track->isOver || EndLost(work, track);
    }
    return ok;
}
