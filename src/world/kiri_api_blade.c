#include "kiri_blade.h"
#include "kiri_call.h"

kiriResult kiriBeginBlade(kiriWorld* world, kiriSheet sheet, kiriBlade* blade)
{
    KIRI_CHANGES(world, KIRI_CALL_BEGIN_BLADE, &sheet, blade);
    KIRI_CHECK(blade != NULL, "blade is null");
    *blade = 0;
    if (sheet != 0 && kiriCall_Owner(&world->sheetIds, sheet) == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no sheet with this id");
    }
    kiriBladeData* made;
    kiriResult result = kiriWorld_AddBlade(world, sheet, &made);
    if (result == KIRI_OK) {
        *blade = made->id;
    }
    KIRI_RETURN(result);
}

kiriResult kiriBlade_MoveEdge(kiriWorld* world, kiriBlade blade, const float from[3], const float to[3])
{
    KIRI_CHANGES(world, KIRI_CALL_BLADE_MOVE_EDGE, &blade, from, to);
    KIRI_CHECK(from != NULL && to != NULL && kiriCall_AreFinite(from, 3) && kiriCall_AreFinite(to, 3),
               "from or to is null, or not finite");
    KIRI_FIND_BLADE(data, blade);
    KIRI_RETURN(kiriWorld_MoveBlade(world, data, kiriVec3_Load(from), kiriVec3_Load(to)));
}

kiriResult kiriBlade_MoveRay(kiriWorld* world, kiriBlade blade, const float origin[3], const float direction[3],
                             float length)
{
    KIRI_CHANGES(world, KIRI_CALL_BLADE_MOVE_RAY, &blade, origin, direction, &length);
    KIRI_CHECK(origin != NULL && direction != NULL && kiriCall_AreFinite(origin, 3) && kiriCall_AreFinite(direction, 3),
               "origin or direction is null, or not finite");
    KIRI_CHECK(direction[0] != 0.0f || direction[1] != 0.0f || direction[2] != 0.0f, "direction is zero");
    KIRI_CHECK(kiriCall_IsAbove(length, 0.0f), "length is not finite, or not above 0");
    KIRI_FIND_BLADE(data, blade);
    kiriVec3 from = kiriVec3_Load(origin), unit = kiriVec3_Normalize(kiriVec3_Load(direction));
    KIRI_RETURN(kiriWorld_MoveBlade(world, data, from, kiriVec3_AddScaled(from, length, unit)));
}

kiriResult kiriBlade_End(kiriWorld* world, kiriBlade blade)
{
    KIRI_CHANGES(world, KIRI_CALL_BLADE_END, &blade);
    KIRI_FIND_BLADE(data, blade);
    KIRI_RETURN(kiriWorld_RemoveBlade(world, data));
}
