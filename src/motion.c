#include "motion.h"

#include "flight.h"

#include <string.h>

static void WritePinRows(kiriSheetData* sheet)
{
    sheet->pinRows.count = sheet->pins.count;
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        const kiriPinData* pin = &sheet->pins.data[i];
        kiriPinRow row = { sheet->model.pinFrame.data[i], kiriMesh_Local(&sheet->mesh, pin->at), pin->target,
                           pin->stiffness };
        sheet->pinRows.data[i] = row;
    }
}

/* A contact acts on the frame whose region holds the point. The host has measured where the point is seen, between frames;
   the plane moves by as much as the frame's own point is off. */
static void WriteContactRows(kiriSheetData* sheet)
{
    sheet->contactRows.count = sheet->contacts.count;
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        const kiriContact* contact = &sheet->contacts.data[i];
        const kiriSample* point = &sheet->points.data[contact->point];
        int32_t frame = point->frame;
        kiriVec2 at = kiriMesh_Local(&sheet->mesh, point->at);
        kiriVec3 normal = kiriVec3_Load(contact->normal);
        kiriVec3 seen = kiriSkin_Position(&sheet->pointSkin, contact->point, sheet->frames.data, at);
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
    system.pins = sheet->pinRows.data;
    system.pinCount = sheet->pinRows.count;
    system.contacts = sheet->contactRows.data;
    system.contactCount = sheet->contactRows.count;
    system.mechanics = sheet->mechanics;
    system.patches = &sheet->model.patches;
    system.material = sheet->material;
    system.gravity = gravity;
    return system;
}

static void PutToRest(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        memset(&sheet->frames.data[i].velocity, 0, sizeof(kiriVec3));
        memset(&sheet->frames.data[i].spin, 0, sizeof(kiriVec3));
        memset(&sheet->frames.data[i].rate, 0, sizeof(kiriMat3));
    }
}

static void ClearForces(kiriSheetData* sheet)
{
    sheet->contacts.count = 0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        memset(&sheet->frames.data[i].force, 0, sizeof(kiriVec3));
        memset(&sheet->frames.data[i].torque, 0, sizeof(kiriVec3));
    }
}

/* Fewer and longer substeps where the quota asks for it, and one system at least for each. */
static kiriProgress Move(kiriSheetData* sheet, const kiriSystem* system, double dt, int32_t substeps, kiriQuota* quota)
{
    substeps = quota->left < substeps ? (int32_t)quota->left : substeps;
    for (int32_t i = 0; i < substeps; ++i) {
        int64_t most = quota->left - (substeps - 1 - i);
        int32_t solved = kiriSolver_Step(sheet->solver, system, dt / substeps, sheet->iterations,
                                         most < INT32_MAX ? (int32_t)most : INT32_MAX);
        if (solved < 0) {
            PutToRest(sheet);
            return KIRI_FAILED;
        }
        kiriQuota_Take(quota, solved);
    }
    return substeps > 0 ? KIRI_DONE : KIRI_MORE;
}

kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems)
{
    WritePinRows(sheet);
    WriteContactRows(sheet);
    kiriSystem system = MakeSystem(sheet, gravity);
    kiriProgress progress = Move(sheet, &system, dt, substeps, systems);
    ClearForces(sheet);
    return progress;
}

static void StoreDoubles(double* to, kiriVec3 a)
{
    to[0] = a.x;
    to[1] = a.y;
    to[2] = a.z;
}

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet)
{
    kiriTotals totals;
    memset(&totals, 0, sizeof(totals));
    kiriVec3 center = { 0.0, 0.0, 0.0 }, momentum = center, angular = center;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        kiriVec3 p = kiriVec3_Scale(frame->mass, frame->velocity);
        totals.area += frame->area;
        totals.mass += frame->mass;
        totals.kineticEnergy += kiriFrame_KineticEnergy(frame, &sheet->material);
        center = kiriVec3_AddScaled(center, frame->mass, frame->x);
        momentum = kiriVec3_Add(momentum, p);
        angular = kiriVec3_Add(angular, kiriFrame_AngularMomentum(frame, &sheet->material));
        angular = kiriVec3_Add(angular, kiriVec3_Cross(frame->x, p));
    }
    kiriSystem system = MakeSystem((kiriSheetData*)sheet, kiriVec3_Make(0.0, 0.0, 0.0));
    totals.elasticEnergy = kiriSolver_ElasticEnergy(&system);
    StoreDoubles(totals.center, kiriVec3_Scale(1.0 / totals.mass, center));
    StoreDoubles(totals.momentum, momentum);
    StoreDoubles(totals.angularMomentum, angular);
    return totals;
}
