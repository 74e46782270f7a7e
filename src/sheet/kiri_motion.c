#include "kiri_motion.h"

#include "../motion/kiri_frame.h"
#include "kiri_pin.h"
#include "kiri_touch.h"
#include "kiri_piece.h"

#include <string.h>

static kiriSystem MakeSystem(kiriSheetData* sheet, kiriVec3 gravity)
{
    kiriSystem system;
    memset(&system, 0, sizeof(system));
    system.frames = sheet->frames.data;
    system.frameCount = sheet->frames.count;
    system.links = sheet->links.links.data;
    system.linkCount = sheet->links.links.count;
    system.corners = sheet->links.corners.data;
    system.cornerCount = sheet->links.corners.count;
    system.strainOffsets =
        sheet->strainOffsets.strainOffsets.count > 0 ? sheet->strainOffsets.strainOffsets.data : NULL;
    system.pins = sheet->pinRows.data;
    system.pinCount = sheet->pinRows.count;
    system.linkParts = sheet->linkParts.count > 0 ? sheet->linkParts.data : NULL;
    system.clamps = sheet->clampRows.data;
    system.clampCount = sheet->clampRows.count;
    system.reactions.pins = sheet->pinReactions.data;
    system.reactions.clamps = sheet->clampReactions.data;
    system.reactions.frames = sheet->frameReactions.data;
    system.contacts = sheet->touches.rows.data;
    system.contactCount = sheet->touches.rows.count;
    system.yields = sheet->touches.yields.data;
    system.yieldCount = sheet->touches.yields.count;
    system.mechanics = sheet->settings.mechanics;
    system.areaElements = &sheet->layout.areaElements;
    system.material = sheet->settings.material;
    system.gravity = gravity;
    system.air = &sheet->settings.air;
    return system;
}

static void ClearForces(kiriSheetData* sheet)
{
    KIRI_EACH(i, kiriSolver_Awake(sheet->solver)->frames) {
        kiriFrame_DropForces(&sheet->frames.data[i]);
    }
}

/* ---- Sleep ---- */

void kiriMotion_WakePiece(kiriSheetData* sheet, int32_t piece)
{
    KIRI_ASSERT(piece >= 0 && piece < sheet->layout.pieces.count);
    kiriPiece* woken = &sheet->layout.pieces.data[piece];
    if (!woken->isGone) {
        woken->rest.asleep = sheet->rest.asleep = sheet->rest.isIdle = false;
        woken->rest.calm = 0.0;
    }
}

void kiriMotion_WakeFrame(kiriSheetData* sheet, int32_t frame)
{
    kiriMotion_WakePiece(sheet, sheet->layout.framePiece.data[frame]);
}

void kiriMotion_WakePin(kiriSheetData* sheet, int32_t pin)
{
    const kiriPinShares* shares = &sheet->layout.pinShares;
    kiriMotion_WakeFrame(sheet, sheet->layout.pinFrame.data[pin]);
    for (int32_t k = 0; k < shares->count; ++k) {
        if (shares->data[k].pin == pin) {
            kiriMotion_WakeFrame(sheet, shares->data[k].share.frame);
        }
    }
}

void kiriMotion_Wake(kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriMotion_WakePiece(sheet, p);
    }
}

void kiriMotion_WakeStirred(kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        if (sheet->layout.pieces.data[p].rest.isStirred) {
            kiriMotion_WakePiece(sheet, p);
        }
    }
    kiriMotion_LetRest(sheet);
}

void kiriMotion_LetRest(kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        sheet->layout.pieces.data[p].rest.isStirred = false;
    }
    sheet->rest.isStirred = false;
}

void kiriMotion_SumRest(kiriSheetData* sheet)
{
    bool any = false;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        any = any || kiriPiece_IsAwake(&sheet->layout.pieces.data[p]);
    }
    sheet->rest.asleep = !any;
    sheet->rest.isIdle = sheet->rest.isIdle && !any;
}

/* What is seen elsewhere than where it is moves on, and does not sleep. */
static void MarkFading(kiriSheetData* sheet)
{
    const kiriFades *fades = &sheet->seen.fades, *pointFades = &sheet->seen.pointFades;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        sheet->layout.pieces.data[p].rest.isFading = false;
    }
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        int32_t piece = kiriPiece_OfVertex(sheet, fades->fading.data[k].sample);
        sheet->layout.pieces.data[piece].rest.isFading = true;
    }
    for (int32_t k = 0; k < pointFades->fading.count; ++k) {
        int32_t frame = sheet->points.data[pointFades->fading.data[k].sample].frame;
        kiriSheet_PieceOf(sheet, frame)->rest.isFading = true;
    }
}

/* Before a tick, not after one, so that what is seen is where it came to rest. */
static void FallAsleep(kiriSheetData* sheet)
{
    bool any = false;
    MarkFading(sheet);
    sheet->seen.areFadesAsleep = false;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriRest* rest = &sheet->layout.pieces.data[p].rest;
        bool isStill = rest->asleep || sheet->layout.pieces.data[p].isGone;
        sheet->seen.areFadesAsleep |= isStill && rest->isFading;
        bool falls = !rest->asleep && rest->calm >= KIRI_CALM_SECONDS && !rest->isFading;
        rest->asleep = rest->asleep || falls;
        any = any || falls;
    }
    for (int32_t i = 0; any && i < sheet->frames.count; ++i) {
        if (kiriSheet_PieceOf(sheet, i)->rest.asleep) {
            kiriFrame_PutToRest(&sheet->frames.data[i]);
        }
    }
}

/* For a piece that sleeps nobody finds touches but the host: who moves other things wakes it. */
static void ChooseAwake(kiriSheetData* sheet, const kiriSystem* system, const kiriQuota* systems)
{
    int32_t at = 0, piece;
    while (kiriTouches_NextNew(sheet, &at, &piece)) {
        kiriMotion_WakePiece(sheet, piece);
    }
    if (sheet->rest.asleep) {
        return;
    }
    FallAsleep(sheet);
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriSolver_SetAwake(sheet->solver, p, kiriPiece_IsAwake(&sheet->layout.pieces.data[p]));
    }
    bool areOther = kiriSolver_ListAwake(sheet->solver, system);
    if (kiriPieceTurns_Begin(sheet, system, systems) || areOther) {
        kiriTouches_Sort(sheet);
        kiriMotion_SumRest(sheet);
    }
}

/* The fastest frame counts, by the root mean square over its material. */
static void CountCalm(kiriSheetData* sheet, double dt)
{
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    double limit = 0.5 * sheet->settings.sleepSpeed * sheet->settings.sleepSpeed;
    KIRI_EACH(p, awake->pieces) {
        sheet->layout.pieces.data[p].rest.isCalm = true;
    }
    KIRI_EACH(i, awake->frames) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        bool isSlow = kiriFrame_KineticEnergy(frame, &sheet->settings.material) < limit * frame->mass;
        kiriRest* rest = &kiriSheet_PieceOf(sheet, i)->rest;
        rest->isCalm = rest->isCalm && isSlow;
    }
    KIRI_EACH(p, awake->pieces) {
        kiriRest* rest = &sheet->layout.pieces.data[p].rest;
        rest->calm = rest->isCalm ? rest->calm + dt : 0.0;
    }
}

/* Where the motion could not be continued. */
static void Stop(kiriSheetData* sheet)
{
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    KIRI_EACH(i, awake->frames) {
        kiriFrame_PutToRest(&sheet->frames.data[i]);
    }
    KIRI_EACH(p, awake->pieces) {
        kiriMotion_WakePiece(sheet, p);
    }
    kiriPins_ClearReactions(sheet);
    kiriTouches_Clear(sheet);
}

/* ---- Tick ---- */

/* How many linear systems the quota has left; one where it is less, but nothing of it is used yet. */
static int64_t SystemsLeft(const kiriQuota* quota, int64_t items)
{
    int64_t fit = quota->left / items;
    return fit > 0 || kiriQuota_IsBegun(quota) ? fit : 1;
}

/* Fewer and longer substeps where the quota asks for it, and one system at least for each. */
static kiriProgress TakeSubsteps(kiriSheetData* sheet, const kiriSystem* system, double dt, int32_t substeps,
                                 kiriQuota* systems)
{
    int64_t items = kiriSolver_SystemItems(sheet->solver, system->contactCount), left = SystemsLeft(systems, items);
    substeps = left < substeps ? (int32_t)left : substeps;
    for (int32_t i = 0; i < substeps; ++i) {
        kiriFollow_Step(sheet, i, substeps, dt / substeps);
        int64_t most = SystemsLeft(systems, items) - (substeps - 1 - i);
        int32_t solved = kiriSolver_Step(sheet->solver, system, dt / substeps, sheet->settings.iterations,
                                         most < INT32_MAX ? (int32_t)most : INT32_MAX);
        if (solved < 0) {
            return KIRI_FAILED;
        }
        kiriQuota_Take(systems, solved * items);
    }
    return substeps > 0 ? KIRI_DONE : KIRI_MORE;
}

/* Does anybody read what the sheet would do? */
static bool IsRead(const kiriSheetData* sheet)
{
    return sheet->touches.found.count > 0 || sheet->pins.count > 0;
}

/* The quota has nothing left for the sheet. */
static bool MustWait(const kiriSheetData* sheet, const kiriQuota* systems)
{
    return !IsRead(sheet) && SystemsLeft(systems, kiriSolver_SystemItems(sheet->solver, 0)) == 0;
}

/* Pins and touches have rows by now: the system is made again. */
static kiriProgress MoveFrames(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    if (MustWait(sheet, systems)) {
        sheet->touches.rows.count = 0;
        return KIRI_MORE;
    }
    kiriFollow_Begin(sheet, dt);
    kiriPins_WriteRows(sheet, 0.0, 1.0);
    kiriPins_BeginReactions(sheet);
    kiriTouches_WriteRows(sheet);
    kiriSystem system = MakeSystem(sheet, gravity);
    kiriProgress progress = TakeSubsteps(sheet, &system, dt, substeps, systems);
    if (progress == KIRI_FAILED) {
        Stop(sheet);
    } else if (progress == KIRI_DONE) {
        kiriPins_TakeReactions(sheet, dt);
        kiriTouches_End(sheet);
        kiriStrainOffsets_Advance(&sheet->strainOffsets, &kiriSolver_Awake(sheet->solver)->elements, dt,
                                  sheet->seen.fades.time);
        kiriPins_FadeOffsets(sheet, dt, sheet->seen.fades.time);
        CountCalm(sheet, dt);
        kiriPieceTurns_Take(sheet);
    }
    return progress;
}

kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    kiriSystem system = MakeSystem(sheet, gravity);
    ChooseAwake(sheet, &system, systems);
    if (sheet->rest.asleep) {
        kiriTouches_Tell(sheet, dt);
        return KIRI_DONE;
    }
    kiriProgress progress = MoveFrames(sheet, gravity, dt, substeps, systems);
    kiriTouches_Tell(sheet, dt);
    ClearForces(sheet);
    return progress;
}

bool kiriMotion_Wait(kiriSheetData* sheet, double dt)
{
    if (sheet->rest.asleep || IsRead(sheet) || !kiriSolver_Awake(sheet->solver)->isListed) {
        return false;
    }
    kiriTouches_Tell(sheet, dt);
    ClearForces(sheet);
    return true;
}

int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps)
{
    int64_t items = kiriSolver_MostItems(sheet->solver, sheet->touches.found.count);
    return substeps * (sheet->settings.iterations + KIRI_EXTRA_SYSTEMS) * items;
}

kiriTotals kiriMotion_Sum(const kiriSheetData* sheet, const int32_t* indices, int32_t count)
{
    kiriTotals totals;
    memset(&totals, 0, sizeof(totals));
    kiriVec3 center = { 0.0, 0.0, 0.0 }, momentum = center, angular = center;
    for (int32_t i = 0; i < count; ++i) {
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

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet)
{
    kiriTotals totals = kiriMotion_Sum(sheet, NULL, sheet->frames.count);
    kiriSystem system = MakeSystem((kiriSheetData*)sheet, kiriVec3_Make(0.0, 0.0, 0.0));
    totals.elasticEnergy = kiriSolver_ElasticEnergy(&system) + kiriPins_ElasticEnergy(sheet);
    return totals;
}
