#include "kiri_motion.h"

#include "../motion/kiri_frame.h"
#include "kiri_pin.h"
#include "kiri_tear.h"
#include "kiri_touch.h"
#include "kiri_piece.h"

static kiriSystem MakeSystem(kiriSheetData* sheet, kiriVec3 gravity)
{
    kiriSystem system = { 0 };
    system.frames = sheet->frames.data;
    system.frameCount = sheet->frames.count;
    system.links = sheet->links.links.data;
    system.linkCount = sheet->links.links.count;
    system.corners = sheet->links.corners.data;
    system.cornerCount = sheet->links.corners.count;
    system.strainOffsets =
        sheet->strainOffsets.strainOffsets.count > 0 ? sheet->strainOffsets.strainOffsets.data : NULL;
    if (system.linkCount > 0 && kiriSettings_Yield(&sheet->settings)) {
        KIRI_ASSERT(sheet->plastics.links.count == system.linkCount &&
                    system.linkCount == sheet->strainOffsets.strainOffsets.count);
        system.plastics = sheet->plastics.links.data;
        system.strainOffsets = sheet->strainOffsets.strainOffsets.data;
    }
    system.pins = sheet->pinRows.data;
    system.pinCount = sheet->pinRows.count;
    system.linkParts = sheet->linkParts.count > 0 ? sheet->linkParts.data : NULL;
    system.clamps = sheet->clampRows.data;
    system.clampCount = sheet->clampRows.count;
    system.contacts = sheet->touches.rows.data;
    system.contactCount = sheet->touches.rows.count;
    system.yields = sheet->touches.yields.data;
    system.yieldCount = sheet->touches.yields.count;
    system.mechanics = sheet->settings.mechanics;
    system.areaElements = &sheet->layout.areaElements;
    system.material = sheet->settings.material;
    system.gravity = gravity;
    system.air = &sheet->settings.air;
    system.maySettle = kiriTears_AreGrowing(sheet);
    return system;
}

static void ClearForces(kiriSheetData* sheet)
{
    KIRI_EACH_LISTED(frame, sheet->solver->moved.frames) {
        kiriFrame_DropForces(&sheet->frames.data[frame]);
    }
}

/* ---- Sleep ---- */

/* Marks the pieces with fades: their visible surface still moves, so they must not fall asleep. */
static void MarkFading(kiriSheetData* sheet)
{
    const kiriFades *fades = &sheet->seen.fades, *pointFades = &sheet->seen.pointFades;
    KIRI_EACH(kiriPiece, each, sheet->layout.pieces) {
        each->rest.isFading = false;
    }
    KIRI_EACH(const kiriFading, at, fades->fading) {
        int32_t piece = kiriPiece_OfVertex(sheet, at->sample);
        sheet->layout.pieces.data[piece].rest.isFading = true;
    }
    KIRI_EACH(const kiriFading, at, pointFades->fading) {
        int32_t frame = sheet->points.data[at->sample].frame;
        kiriSheet_PieceOf(sheet, frame)->rest.isFading = true;
    }
}

/* Puts calm pieces to sleep. Runs before a tick, not after it, so that the surface shows their rest position. */
static void FallAsleep(kiriSheetData* sheet)
{
    MarkFading(sheet);
    sheet->seen.areFadesAsleep = false;
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        kiriRest* rest = &sheet->layout.pieces.data[p].rest;
        bool isStill = rest->asleep || sheet->layout.pieces.data[p].isGone;
        sheet->seen.areFadesAsleep |= isStill && rest->isFading;
        if (!rest->asleep && rest->calm >= KIRI_CALM_SECONDS && !rest->isFading) {
            kiriIndexSpan frames = kiriSolver_FramesOf(sheet->solver, p);
            rest->asleep = true;
            KIRI_EACH_LISTED(frame, frames) {
                kiriFrame_PutToRest(&sheet->frames.data[frame]);
            }
        }
    }
}

/* ---- Turns ---- */

int64_t kiriMotion_WorkOf(const kiriSheetData* sheet, int32_t body)
{
    KIRI_ASSERT_HAS(sheet->solver->bodies.bodies, body);
    return kiriSolver_WorkOf(sheet->solver, body, sheet->solver->bodies.bodies.data[body].contactCount);
}

/* Returns the items of one linear system of each moved body. */
static int64_t ItemsOfMoved(const kiriSheetData* sheet)
{
    int64_t work = 0;
    KIRI_EACH_LISTED(body, sheet->solver->moved.bodies) {
        work += kiriMotion_WorkOf(sheet, body);
    }
    return kiriSolver_ItemsOf(work);
}

/* Defers a body to a later tick: drops its forces; its fades continue. */
static void Defer(kiriSheetData* sheet, int32_t body)
{
    KIRI_ASSERT(body >= 0 && body < sheet->layout.pieces.count && !sheet->layout.pieces.data[body].rest.waits);
    kiriRest* rest = &sheet->layout.pieces.data[body].rest;
    kiriIndexSpan frames = kiriSolver_FramesOf(sheet->solver, body);
    KIRI_EACH_LISTED(frame, frames) {
        kiriFrame_DropForces(&sheet->frames.data[frame]);
    }
    rest->waits = true;
    sheet->turns.waiting += 1;
    sheet->seen.areFadesAsleep |= rest->isFading;
}

/* Defers the bodies that the quota has no linear system for. Bodies are taken in turn, at least one. Returns a frame of
   the first deferred body, or 0. */
static int32_t DeferBodies(kiriSheetData* sheet, const kiriQuota* systems)
{
    const kiriIndices* moved = &sheet->solver->moved.bodies;
    int32_t count = moved->count, first = 0, next = 0;
    int64_t taken = 0;
    KIRI_EACH_LISTED(body, *moved) {
        sheet->solver->bodies.bodies.data[body].contactCount = 0;
    }
    KIRI_EACH(const kiriTouch, touch, sheet->touches.found) { /* contact rows are not written yet */
        sheet->solver->bodies.bodies.data[kiriTouch_Piece(sheet, touch)].contactCount += 1;
    }
    if (count < 2 || systems->left <= 0 || ItemsOfMoved(sheet) <= systems->left) {
        return 0;
    }
    int32_t turn = sheet->turns.next < sheet->frames.count ? sheet->layout.framePiece.data[sheet->turns.next] : 0;
    KIRI_SEARCH(first, 0, count, moved->data[middle] < turn);
    KIRI_TIMES(n, count) {
        int32_t body = moved->data[(first + n) % count];
        int64_t work = kiriMotion_WorkOf(sheet, body);
        if (sheet->turns.waiting > 0 || (taken > 0 && kiriSolver_ItemsOf(taken + work) > systems->left)) {
            next = sheet->turns.waiting > 0 ? next : sheet->layout.pieces.data[body].frame;
            Defer(sheet, body);
        } else {
            taken += work;
        }
    }
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        kiriSolver_SetMoved(sheet->solver, p, kiriPiece_IsMoved(&sheet->layout.pieces.data[p]));
    }
    kiriSolver_ListMoved(sheet->solver);
    return next;
}

void kiriMotion_EndTurns(kiriSheetData* sheet)
{
    KIRI_EACH_WHILE(sheet->turns.waiting > 0, kiriPiece, piece, sheet->layout.pieces) {
        piece->rest.waits = false;
    }
    sheet->turns.waiting = 0;
}

/* Lists the pieces that are awake as those to move. Returns true if they are others than before. */
static bool ListAwakePieces(kiriSheetData* sheet)
{
    KIRI_ASSERT(sheet->solver->bodies.bodies.count == sheet->layout.pieces.count);
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        kiriSolver_SetMoved(sheet->solver, p, kiriPiece_IsAwake(&sheet->layout.pieces.data[p]));
    }
    return kiriSolver_ListMoved(sheet->solver);
}

static void SortMoved(kiriSheetData* sheet)
{
    kiriTouches_Sort(sheet);
    kiriSheet_SumRest(sheet);
}

/* Chooses the pieces that the tick moves. Host contacts of a sleeping piece are compared here; obstacles and other
   sheets wake it when they move. Returns a frame of the first deferred piece, or 0. */
static int32_t ChooseMoved(kiriSheetData* sheet, const kiriQuota* systems)
{
    int32_t at = 0, piece;
    KIRI_ASSERT(sheet->turns.waiting == 0);
    while (kiriTouches_NextNew(sheet, &at, &piece)) {
        kiriSheet_WakePiece(sheet, piece);
    }
    if (sheet->rest.asleep) {
        return 0;
    }
    FallAsleep(sheet);
    bool areOther = ListAwakePieces(sheet);
    int32_t next = systems != NULL ? DeferBodies(sheet, systems) : 0;
    if (areOther || sheet->turns.waiting > 0) {
        SortMoved(sheet);
    }
    return next;
}

/* Updates the calm time of moved pieces, from the mean over the material of the fourth power of its way in the tick. So a
   flap counts by more than its share. Ways count, not velocities: a step that is not solved to the end leaves velocities
   where nothing moves, and the limit of energy takes velocities of what moved. */
static void CountCalm(kiriSheetData* sheet, double dt)
{
    double limit = dt * dt * sheet->settings.sleepSpeed * sheet->settings.sleepSpeed; /* m^2 */
    KIRI_EACH_LISTED(body, sheet->solver->moved.bodies) {
        kiriRest* rest = &sheet->layout.pieces.data[body].rest;
        kiriIndexSpan frames = kiriSolver_FramesOf(sheet->solver, body);
        double spare = 0.0;
        KIRI_EACH_LISTED(at, frames) {
            kiriFrameData* frame = &sheet->frames.data[at];
            kiriMassMoments moments = kiriFrame_MassMoments(frame, &sheet->settings.material);
            kiriVec3 way = kiriVec3_Sub(frame->x, frame->last.x);
            double square = kiriVec3_Dot(way, way) + kiriMat3_TurnSquared(&moments, &frame->last.A, &frame->A) / frame->mass;
            spare += frame->mass * (limit * limit - square * square);
            frame->last = kiriPose_Of(frame);
        }
        rest->calm = spare > 0.0 ? rest->calm + dt : 0.0;
    }
}

/* Puts moved frames to rest after the solver failed. */
static void Stop(kiriSheetData* sheet)
{
    const kiriMoved* moved = &sheet->solver->moved;
    KIRI_EACH_LISTED(frame, moved->frames) {
        kiriFrame_PutToRest(&sheet->frames.data[frame]);
    }
    KIRI_EACH_LISTED(body, moved->bodies) {
        kiriSheet_WakePiece(sheet, body);
    }
    kiriPins_BeginReactions(sheet);
    kiriPins_TakeReactions(sheet, 1.0);
    kiriTouches_Clear(sheet);
}

/* ---- Tick ---- */

int64_t kiriMotion_SystemsLeft(const kiriQuota* quota, int64_t items)
{
    int64_t fit = quota->left / items;
    return fit > 0 || kiriQuota_IsBegun(quota) ? fit : 1;
}

/* Returns true if pins or contacts read the motion. */
static bool IsRead(const kiriSheetData* sheet)
{
    return sheet->touches.found.count > 0 || sheet->pins.count > 0;
}

int32_t kiriMotion_Iterations(const kiriSheetData* sheet)
{
    return kiriMax(sheet->settings.iterations, kiriTears_AreGrowing(sheet) ? KIRI_TEAR_ITERATIONS : 0);
}

bool kiriMotion_Foresee(kiriSheetData* sheet, kiriVec3 gravity, double dt, kiriQuota* systems)
{
    kiriTears* tears = &sheet->tears;
    bool isFree = systems != NULL && sheet->touches.last.touches.count == 0 && !kiriSettings_Yield(&sheet->settings);
    KIRI_ASSERT(tears->before.count == 0);
    if (sheet->rest.asleep || tears->found.count == 0) {
        return true;
    }
    if (ListAwakePieces(sheet)) {
        SortMoved(sheet);
    }
    kiriPins_WriteRows(sheet, 0.0, 1.0);
    if (!isFree) {
        return true;
    }
    if (!kiriArray_Reserve(sheet->memory, &tears->before, sheet->frames.count)) {
        return false;
    }
    int32_t iterations = sheet->settings.iterations, solved = 0;
    int64_t items = ItemsOfMoved(sheet), most = kiriMin(systems->left / (2 * items), KIRI_MOST_ROUNDS);
    if (most < iterations) {
        return true; /* the tick needs them more */
    }
    tears->before.count = sheet->frames.count;
    memcpy(tears->before.data, sheet->frames.data, sizeof(kiriFrameData) * sheet->frames.count);
    KIRI_EACH(kiriPinRow, pin, sheet->pinRows) {
        pin->reaction = NULL;
    }
    KIRI_EACH(kiriClampRow, clamp, sheet->clampRows) {
        clamp->reaction = NULL;
    }
    kiriSystem system = MakeSystem(sheet, gravity);
    system.contactCount = 0;
    kiriSolver_ShareRows(sheet->solver, &system);
    KIRI_EACH_LISTED(body, sheet->solver->moved.bodies) {
        solved = kiriMax(kiriSolver_Step(sheet->solver, &system, body, dt, iterations, (int32_t)most), solved);
    }
    return kiriQuota_Take(systems, solved * items);
}

void kiriMotion_Return(kiriSheetData* sheet)
{
    if (sheet->tears.before.count > 0) {
        KIRI_ASSERT(sheet->tears.before.count == sheet->frames.count);
        memcpy(sheet->frames.data, sheet->tears.before.data, sizeof(kiriFrameData) * sheet->frames.count);
        sheet->tears.before.count = 0;
    }
}

int32_t kiriMotion_Begin(kiriSheetData* sheet, kiriVec3 gravity, double dt, const kiriQuota* systems,
                         kiriSystem* system)
{
    int32_t next = ChooseMoved(sheet, systems);
    bool isLate = systems != NULL && !sheet->rest.asleep && !IsRead(sheet) &&
                  kiriMotion_SystemsLeft(systems, ItemsOfMoved(sheet)) == 0;
    if (sheet->rest.asleep || isLate) {
        sheet->touches.rows.count = 0;
        return next;
    }
    /* Strains fade first, so that the substeps relax stiff links. */
    double time = sheet->seen.fades.time, fade = kiriTears_AreGrowing(sheet) ? kiriMin(time, KIRI_TEAR_FADE) : time;
    if (sheet->strainOffsets.strainOffsets.count > 0) {
        kiriSystem fading = MakeSystem(sheet, gravity);
        bool mayTouch = systems == NULL || sheet->touches.found.count > 0;
        const kiriPlastic* plastics = sheet->plastics.links.count > 0 ? sheet->plastics.links.data : NULL;
        kiriSolver_FadeOffsets(&fading, sheet->strainOffsets.strainOffsets.data, plastics, &sheet->solver->moved.links,
                               fade / (fade + dt), mayTouch);
    }
    kiriPins_FadeOffsets(sheet, dt, time);
    kiriPins_WriteRows(sheet, 0.0, 1.0);
    kiriPins_BeginReactions(sheet);
    kiriTouches_WriteRows(sheet);
    *system = MakeSystem(sheet, gravity);
    kiriSolver_ShareRows(sheet->solver, system);
    return next;
}

void kiriMotion_End(kiriSheetData* sheet, kiriProgress progress, bool isMoved, double dt)
{
    if (progress == KIRI_FAILED) {
        Stop(sheet);
    } else if (isMoved && progress == KIRI_DONE) {
        kiriPins_TakeReactions(sheet, dt);
        kiriTouches_End(sheet);
        CountCalm(sheet, dt);
    }
    kiriTouches_Tell(sheet, dt);
    if (isMoved) {
        ClearForces(sheet);
    }
}

bool kiriMotion_Wait(kiriSheetData* sheet, double dt)
{
    if (sheet->rest.asleep || IsRead(sheet) || !sheet->solver->moved.isListed) {
        return false;
    }
    kiriTouches_Tell(sheet, dt);
    ClearForces(sheet);
    return true;
}

int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps)
{
    int64_t items = kiriSolver_ItemsOf(sheet->solver->allWork + sheet->touches.found.count);
    return substeps * (kiriMotion_Iterations(sheet) + KIRI_EXTRA_SYSTEMS) * items;
}

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet)
{
    kiriTotals totals = kiriSheet_SumFrames(sheet, NULL, sheet->frames.count);
    kiriSystem system = MakeSystem((kiriSheetData*)sheet, kiriVec3_Make(0.0, 0.0, 0.0));
    system.clampCount = 0; /* rows are of the last tick */
    totals.elasticEnergy = kiriSolver_ElasticEnergy(&system) + kiriPins_ElasticEnergy(sheet, system);
    return totals;
}
