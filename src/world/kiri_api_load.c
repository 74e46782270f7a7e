#include "kiri_call.h"
#include "../sheet/kiri_load.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_piece.h"

/* A load of nothing wakes nobody. */
static bool IsLoad(const float load[3])
{
    return load[0] != 0.0f || load[1] != 0.0f || load[2] != 0.0f;
}

static void WakeFor(kiriSheetData* sheet, int32_t frame, const float force[3], const float torque[3])
{
    if (IsLoad(force) || IsLoad(torque)) {
        kiriMotion_WakeFrame(sheet, frame);
    }
}

kiriResult kiriFrame_ApplyForce(kiriWorld* world, kiriFrame frame, const float force[3], const float torque[3])
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_APPLY_FORCE, &frame, force, torque);
    KIRI_CHECK(force != NULL && torque != NULL && kiriCall_AreFinite(force, 3) && kiriCall_AreFinite(torque, 3),
               "force or torque is null or not finite");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    int32_t index = kiriPool_Find(&world->frameIds, frame)->index;
    kiriFrameData* data = &sheet->frames.data[index];
    data->force = kiriVec3_Add(data->force, kiriVec3_Load(force));
    data->torque = kiriVec3_Add(data->torque, kiriVec3_Load(torque));
    WakeFor(sheet, index, force, torque);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_ApplyForce(kiriWorld* world, kiriSheet sheet, const float restPoint[2], const float force[3],
                                const float torque[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_APPLY_FORCE, &sheet, restPoint, force, torque);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2), "restPoint is null or not finite");
    KIRI_CHECK(force != NULL && torque != NULL && kiriCall_AreFinite(force, 3) && kiriCall_AreFinite(torque, 3),
               "force or torque is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    kiriLatticePoint at;
    int32_t frame = kiriSheet_ToLattice(data, restPoint, &at) ? kiriOwner_At(data, at) : KIRI_NONE;
    KIRI_CHECK(frame != KIRI_NONE, "restPoint lies outside the material");
    kiriLoad_AtPoint(data, frame, kiriMesh_Local(&data->mesh, at), kiriVec3_Load(force), kiriVec3_Load(torque));
    WakeFor(data, frame, force, torque);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_ApplyLineLoad(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                   const float forcePerLength[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_APPLY_LINE_LOAD, &sheet, from, to, forcePerLength);
    KIRI_CHECK(forcePerLength != NULL && kiriCall_AreFinite(forcePerLength, 3), "forcePerLength is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    kiriLatticePoint ends[2];
    const char* why = kiriCall_FaultOfLine(data, from, to, ends);
    KIRI_CHECK(why == NULL, why);
    if (!kiriOwner_FindShares(data, ends[0], ends[1], false)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    KIRI_CHECK(data->lineShares.count > 0, "the line meets no material");
    kiriLoad_AlongLine(data, ends[0], ends[1], kiriVec3_Load(forcePerLength));
    for (int32_t k = 0; k < data->lineShares.count; ++k) {
        WakeFor(data, data->lineShares.data[k].frame, forcePerLength, forcePerLength);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_ApplyPressure(kiriWorld* world, kiriSheet sheet, float pressure)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_APPLY_PRESSURE, &sheet, &pressure);
    KIRI_CHECK(kiriCall_AreFinite(&pressure, 1), "pressure is not finite");
    KIRI_FIND_SHEET(data, sheet);
    kiriLoad_OnSurface(data, pressure);
    if (pressure != 0.0f) {
        kiriMotion_Wake(data);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_ApplyImpulse(kiriWorld* world, kiriSheet sheet, const float restPoint[2], const float impulse[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_APPLY_IMPULSE, &sheet, restPoint, impulse);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2), "restPoint is null or not finite");
    KIRI_CHECK(impulse != NULL && kiriCall_AreFinite(impulse, 3), "impulse is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    kiriLatticePoint at;
    kiriPointPlace place;
    KIRI_CHECK(kiriSheet_ToLattice(data, restPoint, &at) && kiriPoint_Find(data, at, &place),
               "restPoint lies outside the material");
    KIRI_CHECK(kiriLoad_Impulse(data, &place, kiriVec3_Load(impulse)), "floats cannot hold what comes of it");
    if (IsLoad(impulse)) {
        int32_t vertex = data->mesh.triangles.data[place.triangle].vertex[0];
        kiriMotion_WakePiece(data, kiriPiece_OfVertex(data, vertex));
    }
    KIRI_RETURN(KIRI_OK);
}

static const char* FaultOfWind(const kiriWind* wind)
{
    if (!kiriCall_AreFinite(wind->velocity, 3)) {
        return "velocity is not finite";
    }
    return kiriCall_IsAtLeast(wind->density, 0.0f) && kiriCall_IsAtLeast(wind->drag, 0.0f) &&
                   kiriCall_IsAtLeast(wind->lift, 0.0f)
               ? NULL
               : "density, drag or lift is below 0";
}

kiriResult kiriSheet_SetWind(kiriWorld* world, kiriSheet sheet, const kiriWind* wind)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SET_WIND, &sheet, wind);
    KIRI_CHECK(wind != NULL, "wind is null");
    const char* why = FaultOfWind(wind);
    KIRI_CHECK(why == NULL, why);
    KIRI_FIND_SHEET(data, sheet);
    const kiriAir air = { kiriVec3_Load(wind->velocity), wind->density, wind->drag, wind->lift };
    const kiriAir* was = &data->settings.air;
    if (!kiriVec3_Equal(air.velocity, was->velocity) || air.density != was->density || air.drag != was->drag ||
        air.lift != was->lift) {
        data->settings.air = air;
        kiriMotion_Wake(data);
    }
    KIRI_RETURN(KIRI_OK);
}
