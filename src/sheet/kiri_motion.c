#include "kiri_motion.h"

#include "../motion/kiri_prediction.h"
#include "kiri_pin.h"

#include <string.h>

/* A contact acts on the frame whose region holds the point. The host has measured where the point is seen, between
   frames; the plane moves by as much as the frame's own point is off. */
static void WriteContactRows(kiriSheetData* sheet)
{
    sheet->contactRows.count = sheet->contacts.count;
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        const kiriContact* contact = &sheet->contacts.data[i];
        const kiriSample* point = &sheet->points.data[contact->point];
        int32_t frame = point->frame;
        kiriVec2 at = kiriMesh_Local(&sheet->mesh, point->at);
        kiriVec3 normal = kiriVec3_Load(contact->normal);
        kiriVec3 seen = sheet->seen.exactPoints.data[contact->point];
        kiriVec3 off = kiriVec3_Sub(kiriFrame_Carry(&sheet->frames.data[frame], at), seen);
        kiriContactRow row = {
            frame, at, normal, contact->offset + kiriVec3_Dot(normal, off), contact->friction, contact->stiffness
        };
        sheet->contactRows.data[i] = row;
    }
}

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
    system.contacts = sheet->contactRows.data;
    system.contactCount = sheet->contactRows.count;
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

#define CALM_SECONDS 0.5
#define CALM_SLOPE 1e-3 /* by how much the normal of a contact may change meanwhile */

void kiriMotion_Wake(kiriSheetData* sheet)
{
    sheet->rest.asleep = false;
    sheet->rest.calm = 0.0;
}

/* Hosts find contacts anew each tick, where a sheet that hardly moves is seen: a plane that passes the point as near as
   the sheet may have gone meanwhile is the same. */
static bool IsSameContact(const kiriSheetData* sheet, const kiriContact* a, const kiriContact* b)
{
    kiriVec3 seen = kiriVec3_Load(&sheet->seen.pointPositions.data[3 * a->point]);
    kiriVec3 tilt = kiriVec3_Sub(kiriVec3_Load(b->normal), kiriVec3_Load(a->normal));
    double rise = (double)b->offset - (double)a->offset - kiriVec3_Dot(tilt, seen);
    return a->point == b->point && a->friction == b->friction && a->stiffness == b->stiffness &&
           kiriVec3_Length(tilt) <= CALM_SLOPE && fabs(rise) <= CALM_SECONDS * sheet->settings.sleepSpeed;
}

static bool AreContactsNew(const kiriSheetData* sheet)
{
    bool same = sheet->contacts.count == sheet->rest.contacts.count;
    for (int32_t i = 0; same && i < sheet->contacts.count; ++i) {
        same = IsSameContact(sheet, &sheet->rest.contacts.data[i], &sheet->contacts.data[i]);
    }
    return !same;
}

static bool IsFading(const kiriSheetData* sheet)
{
    return sheet->seen.fades.fading.count > 0 || sheet->seen.pointFades.fading.count > 0;
}

/* Falls asleep before a tick, not after one, so that what is seen is where it came to rest. */
static bool Sleeps(kiriSheetData* sheet)
{
    if (sheet->rest.calm >= CALM_SECONDS && AreContactsNew(sheet)) {
        kiriMotion_Wake(sheet);
    }
    if (sheet->rest.calm >= CALM_SECONDS && !IsFading(sheet) && !sheet->rest.asleep) {
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

/* Contacts are gone after the tick; those that moved the sheet last are what its sleep is compared with. */
static void EndContacts(kiriSheetData* sheet)
{
    kiriContact* data = sheet->contacts.data;
    int32_t capacity = sheet->contacts.capacity;
    sheet->contacts.data = sheet->rest.contacts.data;
    sheet->contacts.capacity = sheet->rest.contacts.capacity;
    sheet->rest.contacts.data = data;
    sheet->rest.contacts.capacity = capacity;
    sheet->rest.contacts.count = sheet->contacts.count;
    sheet->contacts.count = 0;
}

/* Fewer and longer substeps where the quota asks for it, and one system at least for each. */
static kiriProgress TakeSubsteps(kiriSheetData* sheet, const kiriSystem* system, double dt, int32_t substeps,
                                 kiriQuota* systems)
{
    substeps = systems->left < substeps ? (int32_t)systems->left : substeps;
    for (int32_t i = 0; i < substeps; ++i) {
        int64_t most = systems->left - (substeps - 1 - i);
        int32_t solved = kiriSolver_Step(sheet->solver, system, dt / substeps, sheet->settings.iterations,
                                         most < INT32_MAX ? (int32_t)most : INT32_MAX);
        if (solved < 0) {
            return KIRI_FAILED;
        }
        kiriQuota_Take(systems, solved);
    }
    return substeps > 0 ? KIRI_DONE : KIRI_MORE;
}

static kiriProgress MoveFrames(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    kiriPins_WriteRows(sheet);
    WriteContactRows(sheet);
    kiriSystem system = MakeSystem(sheet, gravity);
    kiriProgress progress = TakeSubsteps(sheet, &system, dt, substeps, systems);
    if (progress == KIRI_FAILED) {
        PutToRest(sheet);
        kiriMotion_Wake(sheet);
        kiriPins_ClearReactions(sheet);
    } else if (progress == KIRI_DONE) {
        kiriPins_TakeReactions(sheet, dt);
        kiriStrainOffsets_Advance(&sheet->strainOffsets, dt, sheet->seen.fades.time);
        kiriPins_FadeOffsets(sheet, dt, sheet->seen.fades.time);
        sheet->rest.calm = IsCalm(sheet) ? sheet->rest.calm + dt : 0.0;
    }
    return progress;
}

kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    if (Sleeps(sheet)) {
        sheet->contacts.count = 0;
        return KIRI_DONE;
    }
    kiriProgress progress = MoveFrames(sheet, gravity, dt, substeps, systems);
    EndContacts(sheet);
    ClearForces(sheet);
    return progress;
}

kiriTotals kiriMotion_Sum(const kiriSheetData* sheet, const int32_t* indices, int32_t count)
{
    kiriTotals totals;
    memset(&totals, 0, sizeof(totals));
    kiriVec3 center = { 0.0, 0.0, 0.0 }, momentum = center, angular = center;
    for (int32_t i = 0; i < count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[indices != NULL ? indices[i] : i];
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
