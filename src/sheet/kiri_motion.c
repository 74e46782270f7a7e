#include "kiri_motion.h"

#include "../motion/kiri_prediction.h"
#include "kiri_follow.h"
#include "kiri_touch.h"

#include <string.h>

static kiriSystem MakeSystem(kiriSheetData* sheet, kiriVec3 gravity)
{
    kiriSystem system;
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

static void PutToRest(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        memset(&sheet->frames.data[i].velocity, 0, sizeof(kiriVec3));
        memset(&sheet->frames.data[i].spin, 0, sizeof(kiriVec3));
        memset(&sheet->frames.data[i].rate, 0, sizeof(kiriMat3));
        memset(&sheet->frames.data[i].history, 0, sizeof(kiriHistory));
    }
}

static void ClearForces(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        memset(&sheet->frames.data[i].force, 0, sizeof(kiriVec3));
        memset(&sheet->frames.data[i].torque, 0, sizeof(kiriVec3));
    }
}

/* ---- Sleep ---- */

void kiriMotion_Wake(kiriSheetData* sheet)
{
    sheet->rest.asleep = sheet->rest.isIdle = false;
    sheet->rest.calm = 0.0;
}

static bool IsFading(const kiriSheetData* sheet)
{
    return sheet->seen.fades.fading.count > 0 || sheet->seen.pointFades.fading.count > 0;
}

/* Falls asleep before a tick, not after one, so that what is seen is where it came to rest. For a sheet that sleeps
   nobody finds touches but the host: who moves other things wakes it. */
static bool Sleeps(kiriSheetData* sheet)
{
    if (sheet->rest.calm >= KIRI_CALM_SECONDS && kiriTouches_AreNew(sheet, KIRI_TOUCH_HOST)) {
        kiriMotion_Wake(sheet);
    }
    if (sheet->rest.calm >= KIRI_CALM_SECONDS && !IsFading(sheet) && !sheet->rest.asleep) {
        PutToRest(sheet);
        sheet->rest.asleep = true;
    }
    return sheet->rest.asleep;
}

/* The fastest frame counts, by the root mean square over its material. */
static bool IsCalm(const kiriSheetData* sheet)
{
    double limit = 0.5 * sheet->settings.sleepSpeed * sheet->settings.sleepSpeed;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        if (!(kiriFrame_KineticEnergy(frame, &sheet->settings.material) < limit * frame->mass)) {
            return false;
        }
    }
    return true;
}

/* ---- Tick ---- */

/* How many linear systems the quota has left; one where it is less, but nothing of it is used yet. */
static int64_t SystemsLeft(const kiriQuota* quota, int64_t items)
{
    int64_t fit = quota->left / items;
    return fit > 0 || quota->used > 0 ? fit : 1;
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

static kiriProgress MoveFrames(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    kiriFollow_Begin(sheet, dt);
    kiriPins_WriteRows(sheet, 0.0, 1.0);
    kiriPins_BeginReactions(sheet);
    kiriTouches_WriteRows(sheet);
    kiriSystem system = MakeSystem(sheet, gravity);
    kiriProgress progress = TakeSubsteps(sheet, &system, dt, substeps, systems);
    if (progress == KIRI_FAILED) {
        PutToRest(sheet);
        kiriMotion_Wake(sheet);
        kiriPins_ClearReactions(sheet);
        kiriTouches_Clear(sheet);
    } else if (progress == KIRI_DONE) {
        kiriPins_TakeReactions(sheet, dt);
        kiriTouches_End(sheet);
        kiriStrainOffsets_Advance(&sheet->strainOffsets, dt, sheet->seen.fades.time);
        kiriPins_FadeOffsets(sheet, dt, sheet->seen.fades.time);
        sheet->rest.calm = IsCalm(sheet) ? sheet->rest.calm + dt : 0.0;
    }
    return progress;
}

kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    if (Sleeps(sheet)) {
        kiriTouches_Tell(sheet, dt);
        return KIRI_DONE;
    }
    kiriProgress progress = MoveFrames(sheet, gravity, dt, substeps, systems);
    kiriTouches_Tell(sheet, dt);
    ClearForces(sheet);
    return progress;
}

int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps)
{
    int64_t items = kiriSolver_SystemItems(sheet->solver, sheet->touches.found.count);
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
