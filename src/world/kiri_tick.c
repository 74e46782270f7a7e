#include "kiri_tick.h"

#include "kiri_part.h"
#include "../core/kiri_array.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_update.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_touch.h"
#include "kiri_blade.h"
#include "kiri_call.h"
#include "kiri_island.h"
#include "kiri_move.h"
#include "kiri_pair.h"
#include "kiri_seam.h"

static void EnterStage(void* context, int32_t stage)
{
    kiriWorld* world = context;
    double now = world->clock != NULL ? world->clock(world->user) : 0.0;
    if (world->stage != KIRI_NONE) {
        world->profile.seconds[world->stage] += now - world->stageStart;
    }
    world->stage = stage;
    world->stageStart = now;
}

static bool IsReady(const kiriSheetData* sheet)
{
    return sheet->update->stage == KIRI_READY;
}

/* ---- Which sheets ---- */

/* Returns true if the sheet needs no work until it wakes, or gets a cut or contacts. */
static bool IsIdle(const kiriSheetData* sheet)
{
    const kiriTouches* touches = &sheet->touches;
    const kiriFades* fades = &sheet->seen.fades;
    bool isCarried = false; /* a pin is on an obstacle, which may move */
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        isCarried |= pin->anchor.obstacle != 0;
    }
    return sheet->rest.asleep && sheet->cuts.count == 0 && sheet->queue.count == 0 && sheet->contacts.count == 0 &&
           touches->last.touches.count == 0 && touches->slept.touches.count == 0 && touches->found.count == 0 &&
           touches->told.count == 0 && !isCarried && sheet->leaving.count == 0 &&
           !kiriPieces_AnyGone(sheet) && !sheet->seen.isElsewhere && fades->jump == 0.0 && fades->move == 0.0;
}

static void ListActive(kiriWorld* world)
{
    world->active.count = 0;
    KIRI_EACH_INDEX(i, world->sheets) {
        kiriSheetRest* rest = &world->sheets.data[i]->rest;
        rest->isIdle = !rest->isStirred && (rest->isIdle || IsIdle(world->sheets.data[i]));
        if (!rest->isIdle) {
            KIRI_NEXT(world->active) = i;
        }
    }
}

/* ---- Pieces that leave ---- */

/* Takes out the pieces that waited for a cut or for samples. The first refusal is returned; those pieces wait. */
static kiriResult PartAll(kiriWorld* world)
{
    kiriResult result = KIRI_OK;
    for (int32_t k = 0, count = world->active.count; k < count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        if (kiriParts_AreDue(sheet)) {
            EnterStage(world, KIRI_STAGE_CONSTANTS);
        }
        kiriResult left = kiriParts_Leave(world, sheet);
        result = result == KIRI_OK ? left : result;
    }
    ListActive(world); /* with the new sheets */
    return result;
}

/* ---- Updates ---- */

/* Orders the sheets that share the budget. In every other tick, the sheet whose points came first is first, so that
   each finishes. In the other ticks, the sheet whose update has had the least work is first, so a short cut does not
   wait for a long one. */
static bool IsServedFirst(const void* context, int32_t a, int32_t b)
{
    const kiriWorld* world = context;
    const kiriUpdate *one = world->sheets.data[a]->update, *other = world->sheets.data[b]->update;
    if (world->ticks % 2 == 0 && one->spent != other->spent) {
        return one->spent < other->spent;
    }
    return one->cut.stamp < other->cut.stamp || (one->cut.stamp == other->cut.stamp && a < b);
}

/* Starts work, except in sheets with pieces that are about to leave. `finishes`: work in progress
   continues even there. */
static void StartAll(kiriWorld* world, bool finishes)
{
    world->atWork.count = 0;
    KIRI_EACH_INDEX(k, world->active) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        if (kiriParts_AreDue(sheet) && !(finishes && sheet->update->stage != KIRI_NONE)) {
            continue;
        }
        kiriPipeline_Start(sheet, world->ticks);
        if (sheet->update->stage != KIRI_NONE) {
            KIRI_NEXT(world->atWork) = world->active.data[k];
        }
    }
    kiriSort(world->atWork.data, world->atWork.count, IsServedFirst, world);
}

/* Works on updates. KIRI_ERROR_MEMORY: the work of some sheets continues in the next tick, as with a spent budget. */
static kiriResult UpdateAll(kiriWorld* world, kiriQuotas* quotas)
{
    const kiriWatch watch = { EnterStage, world };
    kiriResult result = KIRI_OK;
    KIRI_EACH_LISTED(i, world->atWork) {
        kiriSheetData* sheet = world->sheets.data[i];
        if (kiriPipeline_CanRun(sheet, quotas) && kiriPipeline_Run(sheet, quotas, &watch) == KIRI_FAILED) {
            result = KIRI_ERROR_MEMORY;
        }
    }
    return result;
}

/* ---- Contact ---- */

/* Stirs pieces that a cut changes in this tick. */
static void StirTouched(kiriSheetData* sheet)
{
    if (IsReady(sheet) && sheet->update->cut.meshChanged) {
        kiriPieces_FindTouched(sheet);
    }
}

/* Finds touches on the visible surfaces, before anything is committed. Sleeping pieces get only the host's contacts.
   Fails on out of memory. */
static bool FindTouches(kiriWorld* world, double dt)
{
    bool ok = true;
    EnterStage(world, KIRI_STAGE_CONTACT);
    bool isPairStirred = kiriPairs_Stir(world);
    if (kiriSeams_Stir(world) || isPairStirred) {
        ListActive(world);
    }
    KIRI_EACH_INDEX_WHILE(ok, k, world->active) {
        ok = kiriTouches_Begin(kiriWorld_Active(world, k));
        StirTouched(kiriWorld_Active(world, k));
    }
    ok = ok && kiriObstacles_FindTouches(world, dt);
    if (world->obstacles.count > 0) {
        ListActive(world); /* one may have come near a sheet that sleeps */
    }
    ok = ok && kiriPairs_AddTouches(world);
    KIRI_EACH_ACTIVE(sheet, world) {
        ok = ok && kiriTouches_Reserve(sheet) && kiriObstacles_ReserveRests(world, sheet);
        world->profile.contacts += sheet->touches.found.count;
    }
    return ok;
}

/* ---- Commits ---- */

/* Reserves room for the ids and events of the tick. Sheets that wake in it may also lose pins. */
static kiriResult ReserveRoom(kiriWorld* world)
{
    int64_t frames = 0, events = world->events.count + 3 * (int64_t)world->sheets.count + world->cutIds.slots.count +
                                 world->pinIds.slots.count + world->seams.count;
    KIRI_EACH_ACTIVE(sheet, world) {
        if (IsReady(sheet) && sheet->update->cut.meshChanged) {
            frames += sheet->update->placing.sites.count - sheet->frames.count;
            events += sheet->update->next.pieces.count;
        }
        if (!kiriBounds_Reserve(sheet->seen.bounds, sheet->memory, sheet->mesh.triangles.count)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    return kiriArray_Reserve(&world->memory, &world->events, events + frames)
               ? kiriWorld_ReserveIds(world, &world->frameIds, frames)
               : KIRI_ERROR_MEMORY;
}

static void CommitUpdate(kiriWorld* world, kiriSheetData* sheet)
{
    const kiriCommitCounts* counts = &sheet->update->counts;
    kiriProfile* profile = &world->profile;
    int32_t oldFrames = sheet->frames.count;
    kiriStage_Commit(sheet);
    profile->cellsChanged += counts->cells;
    profile->weightsChanged += counts->weights;
    profile->verticesChanged += counts->vertices;
    profile->pointsChanged += counts->points;
    profile->linksChanged += counts->links;
    profile->commits += 1;
    KIRI_FROM_TO(i, oldFrames, sheet->frames.count) {
        bool isGone = kiriSheet_IsGone(sheet, i);
        sheet->frames.data[i].id = isGone ? 0 : kiriPool_Add(&world->frameIds, sheet, i);
    }
    KIRI_EACH(const kiriPiece, each, sheet->layout.pieces) {
        if (each->cameOff && !each->isGone) {
            kiriEvent* event = kiriWorld_AddEvent(world, KIRI_EVENT_PIECE_OFF, sheet);
            event->frame = sheet->frames.data[each->frame].id;
            event->crumb = each->area < sheet->settings.crumbArea;
            event->area = (float)each->area;
        }
    }
    KIRI_FROM_TO(i, oldFrames, sheet->frames.count) {
        if (!kiriSheet_IsGone(sheet, i)) {
            kiriWorld_AddEvent(world, KIRI_EVENT_FRAME_ADDED, sheet)->frame = sheet->frames.data[i].id;
        }
    }
}

static void FinishCuts(kiriWorld* world, kiriSheetData* sheet)
{
    int32_t kept = 0;
    KIRI_EACH_OF(kiriCutData, cut, sheet->cuts) {
        if (cut->ended && cut->waiting == 0) {
            int32_t type = kiriCut_IsTear(cut) ? KIRI_EVENT_TEAR_ENDED : KIRI_EVENT_CUT_FINISHED;
            kiriWorld_AddEvent(world, type, sheet)->cut = cut->id;
            kiriWorld_RemoveCut(world, cut);
        } else {
            cut->index = kept;
            sheet->cuts.data[kept++] = cut;
        }
    }
    sheet->cuts.count = kept;
    if (kept == 0 && sheet->update->stage == KIRI_NONE) {
        kiriMemory_DropSpare(sheet->memory);
    }
}

/* Commits the changes of this tick to meshes. */
static void CommitMeshes(kiriWorld* world)
{
    KIRI_EACH_LISTED(i, world->atWork) {
        kiriSheetData* sheet = world->sheets.data[i];
        int32_t known = sheet->seen.surface.vertexCount;
        if (sheet->mesh.vertices.count > known) {
            kiriPast_Grow(&sheet->past, world->begun, &sheet->pastRoom, &sheet->mesh, known);
        }
        if (sheet->mesh.isOpen) {
            kiriStage_CommitMesh(sheet);
        }
    }
}

static void TakeJumps(int32_t start, int32_t end, void* context)
{
    const kiriWorld* world = context;
    KIRI_FROM_TO(i, start, end) {
        if (world->blades.count > 0) {
            kiriSurface_Remember(&kiriWorld_Active(world, i)->seen.surface);
        }
        kiriView_TakeJump(kiriWorld_Active(world, i));
    }
}

static void CommitAll(kiriWorld* world)
{
    EnterStage(world, KIRI_STAGE_CONSTANTS); /* its items have paid for it */
    CommitMeshes(world);
    bool isCommitted = false;
    KIRI_EACH_ACTIVE(sheet, world) {
        isCommitted |= IsReady(sheet);
        if (IsReady(sheet)) {
            KIRI_EACH_INDEX(i, sheet->update->cut) {
                world->profile.cutSegments += !sheet->queue.data[i].jump;
            }
            if (sheet->update->cut.meshChanged) {
                CommitUpdate(world, sheet);
            }
            kiriPipeline_Finish(sheet);
        }
        FinishCuts(world, sheet);
    }
    if (isCommitted) {
        kiriSeams_Follow(world);
    }
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        sheet->seen.surface.before.count = 0;
    }
    EnterStage(world, KIRI_STAGE_SKIN);
    kiriTasks_Run(&world->tasks, TakeJumps, world->active.count, 1, world);
}

/* Wakes stirred sheets, all of which are active. */
static void WakeStirred(kiriWorld* world)
{
    KIRI_EACH_ACTIVE(sheet, world) {
        if (sheet->rest.isStirred) {
            kiriSheet_WakeStirred(sheet);
        }
    }
}

/* Reports the sheets with pending work, and its progress. */
static bool ReportDeferred(kiriWorld* world)
{
    bool any = false;
    KIRI_EACH_ACTIVE(sheet, world) {
        if (sheet->queue.count > 0) {
            kiriEvent* event = kiriWorld_AddEvent(world, KIRI_EVENT_DEFERRED, sheet);
            event->stage = sheet->update->stage == KIRI_NONE ? KIRI_STAGE_CUT : sheet->update->stage;
            event->waiting = sheet->queue.count;
            any = true;
        }
    }
    return any;
}

/* Reports the progress of moved sheets, in their order of motion. The next tick starts with the first sheet that was
   not moved; if all were moved, with the first that has a pending piece. */
static kiriResult ReportMoves(kiriWorld* world, kiriResult result)
{
    bool isLate = false, isPartlyLate = false;
    int32_t turn = world->turn;
    world->turn = 0;
    KIRI_EACH_INDEX(k, world->active) {
        int32_t i = kiriMoves_SheetAt(world, turn, k);
        kiriProgress progress = world->moves.of.data[i].progress;
        if (progress == KIRI_FAILED) {
            kiriWorld_AddEvent(world, KIRI_EVENT_DIVERGED, world->sheets.data[i]);
            result = KIRI_DIVERGED;
        } else if (progress == KIRI_MORE || world->sheets.data[i]->turns.waiting > 0) {
            bool isWhole = progress == KIRI_MORE;
            world->turn = isLate || (isPartlyLate && !isWhole) ? world->turn : i;
            result = result == KIRI_OK ? KIRI_PENDING : result;
            isLate = isLate || isWhole;
            isPartlyLate = true;
        }
    }
    return result;
}

static kiriResult SolveAll(kiriWorld* world, double dt, int32_t substeps, kiriQuota* iterations)
{
    kiriResult result = ReportDeferred(world) ? KIRI_PENDING : KIRI_OK;
    EnterStage(world, KIRI_STAGE_SOLVE);
    kiriMoves_BeginClusters(world, dt);
    bool hasRoom = kiriIslands_Prepare(world, dt);
    kiriMoves_Run(world, dt, substeps, iterations);
    result = ReportMoves(world, result);
    kiriPairs_JoinCalm(world);
    world->pairs.touches.count = 0; /* they hold pointers to sheets */
    return hasRoom ? result : KIRI_ERROR_MEMORY;
}

static bool IsOverloaded(const kiriPinData* pin)
{
    return pin->breakForce > 0.0 && kiriVec3_Length(pin->bore.force) > pin->breakForce;
}

/* Removes broken pins from the last on, because the last pin takes the index of a removed one. */
static void BreakPins(kiriWorld* world, kiriSheetData* sheet)
{
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        if (IsOverloaded(pin)) {
            kiriWorld_AddEvent(world, KIRI_EVENT_PIN_BROKE, sheet)->pin = pin->id;
        }
    }
    KIRI_EACH_INDEX_BACK(i, sheet->pins) {
        if (IsOverloaded(&sheet->pins.data[i])) {
            kiriWorld_RemovePin(world, sheet, i);
        }
    }
}

static void SkinAll(kiriWorld* world, double dt)
{
    EnterStage(world, KIRI_STAGE_SKIN);
    kiriSkinStep_Run(world, dt);
    KIRI_EACH_ACTIVE(sheet, world) {
        kiriMotion_EndTurns(sheet);
        const kiriFades* fades = &sheet->seen.fades;
        world->profile.largestJump = kiriMax(fades->jump, world->profile.largestJump);
        world->profile.largestFade = kiriMax(fades->move, world->profile.largestFade);
        double strained = kiriView_Watch(sheet, dt);
        if (strained > 0.0) {
            kiriFault advice;
            kiriWorld_AddEvent(world, KIRI_EVENT_STRAINED, sheet)->area = (float)strained;
            KIRI_SAY(&advice,
                     "kiriWorld_Tick: a tenth of sheet %lld or more is strained by over %s: more frames, smooth "
                     "skinning or detail may help (KIRI_EVENT_STRAINED)",
                     (long long)sheet->id, "15 %");
            kiriWorld_Log(world, advice.line);
        }
    }
}

/* Sets half of all samples aside for pending pieces in every other tick, so that a world that is always cut does not
   starve them. The ticks in between have room for steps that need a whole limit. */
static kiriQuota SetAside(const kiriWorld* world, kiriQuotas* quotas)
{
    bool anyDue = false;
    KIRI_EACH_INDEX_WHILE(world->ticks % 2 == 0, k, world->active) {
        anyDue = anyDue || kiriParts_AreDue(kiriWorld_Active(world, k));
    }
    kiriQuota aside = { 0, 0, 0, false };
    for (int kind = 0; anyDue && kind <= KIRI_QUOTA_SAMPLES; ++kind) {
        kiriQuota* quota = &quotas->of[kind];
        int64_t stays = quotas->limits[kind] < INT64_MAX ? quota->left / 2 : quota->left;
        aside.left = quota->left - stays;
        quota->left = stays;
        quota->isShared = true;
    }
    return aside;
}

/* Ends a tick in which nothing moves. Progress on cuts is kept and continues in the next tick. */
static void EndUnmoved(kiriWorld* world)
{
    world->pairs.touches.count = 0; /* they hold pointers to sheets */
    CommitMeshes(world);
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        kiriView_ShowNewborn(sheet);
        kiriPipeline_Wait(sheet);
        kiriSheet_LetRest(sheet);
    }
    world->stage = KIRI_NONE;
}

/* Commits completed work, and moves everything. Cannot fail on out of memory. */
static kiriResult MoveAll(kiriWorld* world, double dt, int32_t substeps, kiriQuotas* quotas, int64_t aside)
{
    kiriQuota* samples = &quotas->of[KIRI_QUOTA_SAMPLES];
    kiriPairs_Commit(world);
    CommitAll(world);
    kiriObstacles_Begin(world);
    WakeStirred(world);
    int32_t withRoom = world->active.count;
    ListActive(world);                            /* some sheets have become idle */
    KIRI_ASSERT(world->active.count <= withRoom); /* sheets that woke were stirred before room was made */
    (void)withRoom;
    kiriResult result = SolveAll(world, dt, substeps, &quotas->of[KIRI_QUOTA_ITERATIONS]);
    kiriObstacles_End(world, dt);
    KIRI_EACH_ACTIVE(sheet, world) {
        BreakPins(world, sheet);
    }
    kiriSeams_End(world, dt);
    SkinAll(world, dt);
    samples->left += aside;
    KIRI_EACH_ACTIVE(sheet, world) { /* pieces that wait to be detached */
        kiriParts_Pay(world, sheet, samples);
        result = result == KIRI_OK && kiriParts_AreDue(sheet) ? KIRI_PENDING : result;
    }
    world->profile.trianglesSplit = (int32_t)quotas->of[KIRI_QUOTA_TRIANGLES].used;
    world->profile.cellsSettled = (int32_t)quotas->of[KIRI_QUOTA_CELLS].used;
    world->profile.samplesRefreshed = (int32_t)samples->used;
    world->profile.solverIterations = (int32_t)quotas->of[KIRI_QUOTA_ITERATIONS].used;
    world->profile.sheetPairs = kiriPairs_CountAwake(world);
    EnterStage(world, KIRI_NONE);
    kiriTears_EndResting(world, dt);
    kiriWorld_AdvanceBlades(world);
    world->ticks += 1;
    return result;
}

/* Algorithm 1 of the paper: work on cuts (see kiri_update.c for its stages), commit, motion of frames, and the visible
   surface. Out of memory acts like a spent budget: a cut or a detached piece continues in the next tick. Only if memory
   for the motion itself is missing, nothing moves. */
kiriResult kiriWorld_Advance(kiriWorld* world, double dt, int32_t substeps)
{
    kiriQuotas quotas = kiriQuotas_Of(&world->budget);
    kiriProfile last = world->profile;
    int64_t samplesDue = world->samplesDue; /* calls since the last tick were on account */
    (void)kiriQuota_Pay(&quotas.of[KIRI_QUOTA_SAMPLES], &samplesDue);
    kiriQuotas_Share(&quotas, KIRI_QUOTA_SAMPLES);
    kiriMemory_FreeAll(&world->retired);
    KIRI_CLEAR(&world->profile);
    world->atWork.count = 0;
    ListActive(world);
    kiriResult torn = kiriTears_Grow(world, dt, &quotas.of[KIRI_QUOTA_ITERATIONS]);
    kiriResult parted = PartAll(world);
    StartAll(world, false);
    kiriQuota aside = SetAside(world, &quotas);
    EnterStage(world, KIRI_STAGE_CONTACT);
    bool hasRoom = kiriSeams_ListLines(world) && kiriPairs_Find(world, dt); /* while the mesh equals the visible one */
    kiriResult updated = hasRoom ? UpdateAll(world, &quotas) : KIRI_ERROR_MEMORY;
    hasRoom = hasRoom && FindTouches(world, dt) && kiriMoves_Prepare(world) && kiriSkinStep_Prepare(world);
    kiriResult result = hasRoom ? ReserveRoom(world) : KIRI_ERROR_MEMORY;
    if (result != KIRI_OK) {
        EndUnmoved(world);
        world->profile = last;
        return result;
    }
    /* Drops the events of the last tick. Keeps those that refused ticks have added since. */
    if (world->newEvents > 0) {
        memmove(world->events.data, world->events.data + world->events.count - world->newEvents,
                sizeof(kiriEvent) * world->newEvents);
    }
    world->events.count = world->newEvents;
    world->newEvents = 0;
    world->samplesDue = samplesDue;
    result = MoveAll(world, dt, substeps, &quotas, aside.left);
    result = parted != KIRI_OK ? parted : torn != KIRI_OK ? torn : result;
    return updated != KIRI_OK ? updated : result;
}

/* Runs a tick without motion. The next tick reports its events, too. */
kiriResult kiriWorld_FinishUpdates(kiriWorld* world)
{
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    const kiriProfile profile = world->profile;
    int32_t events = world->events.count;
    ListActive(world);
    StartAll(world, true);
    kiriResult updated = UpdateAll(world, &unlimited);
    bool hasRoom = kiriMoves_Prepare(world) && kiriSkinStep_Prepare(world) && kiriSeams_ListLines(world);
    kiriResult result = hasRoom ? ReserveRoom(world) : KIRI_ERROR_MEMORY;
    if (result != KIRI_OK) {
        EndUnmoved(world);
        world->profile = profile;
        return result;
    }
    KIRI_EACH_ACTIVE(sheet, world) {
        StirTouched(sheet);
    }
    CommitAll(world);
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        sheet->seen.surface.before.count = 0; /* no tick leads here from these places */
    }
    WakeStirred(world);
    KIRI_EACH_LISTED(i, world->active) {
        world->moves.of.data[i].progress = KIRI_DONE;
    }
    SkinAll(world, 0.0);
    EnterStage(world, KIRI_NONE);
    world->newEvents += world->events.count - events;
    world->profile = profile;
    return updated;
}
