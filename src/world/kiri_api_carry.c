#include "kiri_call.h"
#include "../sheet/kiri_carry.h"
#include "kiri_blade.h"
#include "kiri_pin_step.h"

/* What is wrong with a rotation of the whole space, or null. */
static const char* FaultOfTurn(const kiriSheetData* sheet, const float rotation[9])
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 u = kiriVec3_Load(&rotation[0]), v = kiriVec3_Load(&rotation[3]), w = kiriVec3_Load(&rotation[6]);
    if (!kiriCall_AreOrthonormal(&rotation[0], &rotation[3]) || !kiriCall_AreOrthonormal(&rotation[3], &rotation[6]) ||
        !kiriCall_AreOrthonormal(&rotation[6], &rotation[0])) {
        return "rotation is not orthonormal";
    }
    if (!(kiriVec3_Dot(kiriVec3_Cross(u, v), w) > 0.0)) {
        return "rotation mirrors";
    }
    const kiriMat3 R = { u, v, w };
    kiriVec3 d = mechanics->axes.d;
    return mechanics->planar && !(kiriVec3_Dot(kiriMat3_Mul(R, d), d) > 0.999999)
               ? "rotation turns a planar sheet out of its plane"
               : NULL;
}

kiriResult kiriSheet_Transform(kiriWorld* world, kiriSheet sheet, const float rotation[9], const float translation[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_TRANSFORM, &sheet, rotation, translation);
    KIRI_CHECK(rotation != NULL && kiriCall_AreFinite(rotation, 9), "rotation is null or not finite");
    KIRI_CHECK(translation != NULL && kiriCall_AreFinite(translation, 3), "translation is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    const char* why = FaultOfTurn(data, rotation);
    KIRI_CHECK(why == NULL, why);
    kiriMat3 given = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    kiriMat3 R = kiriMat3_Rotation(given);
    KIRI_CHECK(kiriCarry_FitsSheet(data, &R, kiriVec3_Load(translation)), "floats cannot hold what comes of it");
    bool isDone = kiriCarry_Sheet(data, &R, kiriVec3_Load(translation), &world->retired);
    if (isDone) {
        kiriPinStep_Carry(world, data, &R, kiriVec3_Load(translation));
    }
    KIRI_RETURN(isDone ? KIRI_OK : KIRI_ERROR_MEMORY);
}

kiriResult kiriSheet_SetVelocity(kiriWorld* world, kiriSheet sheet, const float velocity[3],
                                 const float angularVelocity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SET_VELOCITY, &sheet, velocity, angularVelocity);
    KIRI_CHECK(velocity != NULL && kiriCall_AreFinite(velocity, 3), "velocity is null or not finite");
    KIRI_CHECK(angularVelocity != NULL && kiriCall_AreFinite(angularVelocity, 3),
               "angularVelocity is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(kiriCarry_SetVelocity(data, KIRI_NONE, kiriVec3_Load(velocity), kiriVec3_Load(angularVelocity)),
               "floats cannot hold what comes of it");
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_SetPieceVelocity(kiriWorld* world, kiriFrame frame, const float velocity[3],
                                      const float angularVelocity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_SET_PIECE_VELOCITY, &frame, velocity, angularVelocity);
    KIRI_CHECK(velocity != NULL && kiriCall_AreFinite(velocity, 3), "velocity is null or not finite");
    KIRI_CHECK(angularVelocity != NULL && kiriCall_AreFinite(angularVelocity, 3),
               "angularVelocity is null or not finite");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    int32_t piece = sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
    KIRI_CHECK(kiriCarry_SetVelocity(sheet, piece, kiriVec3_Load(velocity), kiriVec3_Load(angularVelocity)),
               "floats cannot hold what comes of it");
    KIRI_RETURN(KIRI_OK);
}

/* ---- Another origin ---------------------------------------------------------------------------------------------- */

static bool FitsShift(const kiriWorld* world, kiriVec3 origin)
{
    const kiriMat3 axes = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    bool fits = true;
    for (int32_t i = 0; fits && i < world->sheets.count; ++i) {
        fits = kiriCarry_FitsSheet(world->sheets.data[i], &axes, kiriVec3_Scale(-1.0, origin));
    }
    for (int32_t i = 0; fits && i < world->obstacles.count; ++i) {
        fits = kiriVec3_FitsFloats(kiriVec3_Sub(world->obstacles.data[i]->position, origin));
    }
    for (int32_t i = 0; fits && i < world->blades.count; ++i) {
        const kiriBladeData* blade = world->blades.data[i];
        fits = kiriVec3_FitsFloats(kiriVec3_Sub(blade->edge[0], origin)) &&
               kiriVec3_FitsFloats(kiriVec3_Sub(blade->edge[1], origin));
    }
    return fits;
}

/* Renews the arrays that the host may hold, of all sheets or of none. */
static bool RenewAll(kiriWorld* world)
{
    int32_t done = 0;
    while (done < world->sheets.count && kiriCarry_Renew(world->sheets.data[done], &world->retired)) {
        ++done;
    }
    const kiriVec3 none = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < done && done < world->sheets.count; ++i) {
        kiriCarry_Shift(world->sheets.data[i], none);
    }
    return done == world->sheets.count;
}

static void ShiftObstacles(kiriWorld* world, kiriVec3 origin)
{
    for (int32_t i = 0; i < world->obstacles.count; ++i) {
        kiriObstacleData* obstacle = world->obstacles.data[i];
        obstacle->position = kiriVec3_Sub(obstacle->position, origin);
        obstacle->lower = kiriVec3_Sub(obstacle->lower, origin);
        obstacle->upper = kiriVec3_Sub(obstacle->upper, origin);
    }
}

static void ShiftBlade(kiriBladeData* blade, kiriVec3 origin)
{
    for (int end = 0; end < 2 && blade->isPlaced; ++end) {
        blade->edge[end] = kiriVec3_Sub(blade->edge[end], origin);
    }
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        blade->layers.data[i].at = kiriVec3_Sub(blade->layers.data[i].at, origin);
    }
}

kiriResult kiriWorld_ShiftOrigin(kiriWorld* world, const float origin[3])
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_SHIFT_ORIGIN, origin);
    KIRI_CHECK(origin != NULL && kiriCall_AreFinite(origin, 3), "origin is null or not finite");
    kiriVec3 to = kiriVec3_Load(origin);
    if (to.x == 0.0 && to.y == 0.0 && to.z == 0.0) {
        KIRI_RETURN(KIRI_OK);
    }
    KIRI_CHECK(FitsShift(world, to), "floats cannot hold what comes of it");
    if (!RenewAll(world)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriCarry_Shift(world->sheets.data[i], to);
    }
    ShiftObstacles(world, to);
    for (int32_t i = 0; i < world->blades.count; ++i) {
        ShiftBlade(world->blades.data[i], to);
    }
    KIRI_RETURN(KIRI_OK);
}
