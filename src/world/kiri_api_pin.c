#include "kiri_call.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "kiri_pin_step.h"

#include <string.h>

void kiriDefaultPinDef(kiriPinDef* def)
{
    if (def != NULL) {
        memset(def, 0, sizeof(*def));
        def->cookie = KIRI_COOKIE(kiriPinDef);
    }
}

static kiriPinData MakePin(int32_t type)
{
    kiriPinData pin;
    memset(&pin, 0, sizeof(pin));
    pin.type = type;
    pin.rotation.u.x = pin.rotation.v.y = pin.rotation.d.z = 1.0;
    pin.lastRotation = pin.rotation;
    return pin;
}

static kiriResult AddNewPin(kiriWorld* world, kiriSheetData* data, const kiriPinData* made, int32_t frame, kiriPin* pin)
{
    kiriResult result = kiriWorld_ReserveIds(world, &world->pinIds, 1);
    if (result == KIRI_OK && !kiriPins_Add(data, made, frame)) {
        result = KIRI_ERROR_MEMORY;
    }
    if (result == KIRI_OK) {
        *pin = kiriPool_Add(&world->pinIds, &world->memory, data, data->pins.count - 1);
        data->pins.data[data->pins.count - 1].id = *pin;
        kiriPins_ForgetHistory(data, data->pins.count - 1);
        kiriMotion_WakePin(data, data->pins.count - 1);
    }
    return result;
}

kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin)
{
    KIRI_CHANGES(world, KIRI_CALL_CREATE_PIN, &sheet, def, pin);
    KIRI_CHECK(def != NULL && pin != NULL, "def or pin is null");
    *pin = 0;
    if (def->cookie != KIRI_COOKIE(kiriPinDef)) {
        return KIRI_FAIL(KIRI_ERROR_DEF, "the def was not filled by kiriDefaultPinDef");
    }
    KIRI_CHECK(kiriCall_AreFinite(def->restPoint, 2) && kiriCall_AreFinite(def->target, 3) &&
                   kiriCall_IsAtLeast(def->stiffness, 0.0f) && kiriCall_IsAtLeast(def->breakForce, 0.0f),
               "restPoint, target, stiffness or breakForce is not finite, or one of the latter below 0");
    KIRI_FIND_SHEET(data, sheet);
    if (def->obstacle != 0 && kiriCall_Owner(&world->obstacleIds, def->obstacle) == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no obstacle with this id");
    }
    kiriPinData made = MakePin(KIRI_PIN_POINT);
    bool inRange = kiriSheet_ToLattice(data, def->restPoint, &made.at);
    int32_t frame = inRange ? kiriOwner_At(data, made.at) : KIRI_NONE;
    KIRI_CHECK(frame != KIRI_NONE, "restPoint lies outside the material");
    made.to = made.at;
    made.target = made.lastTarget = kiriVec3_Load(def->target);
    made.anchor.obstacle = def->obstacle;
    kiriPinStep_Fasten(world, &made);
    made.breakForce = def->breakForce;
    made.stiffness = def->stiffness > 0.0f
                         ? def->stiffness
                         : 10.0 * data->settings.material.youngsModulus * data->settings.material.thickness;
    kiriResult result = AddNewPin(world, data, &made, frame, pin);
    KIRI_RETURN(result);
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

static kiriPinData MakeLine(kiriSheetData* data, int32_t type, const kiriLatticePoint ends[2])
{
    kiriPinData made = MakePin(type);
    made.at = ends[0];
    made.to = ends[1];
    kiriPin_TakePose(data, &made);
    made.lastTarget = made.target;
    made.lastRotation = made.rotation;
    return made;
}

/* *why says what is wrong, or is null where the result says it all. */
static kiriResult HoldLine(kiriWorld* world, kiriSheetData* data, int32_t type, const float from[2], const float to[2],
                           kiriPin* pin, const char** why)
{
    kiriLatticePoint ends[2];
    *why = kiriCall_FaultOfLine(data, from, to, ends);
    if (*why == NULL && !kiriOwner_FindShares(data, ends[0], ends[1], false)) {
        return KIRI_ERROR_MEMORY;
    }
    *why = *why == NULL && data->lineShares.count == 0 ? "the line meets no material" : *why;
    if (*why != NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    kiriPinData made = MakeLine(data, type, ends);
    return AddNewPin(world, data, &made, KIRI_NONE, pin);
}

kiriResult kiriSheet_ClampLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                               kiriPin* clamp)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_CLAMP_LINE, &sheet, from, to, clamp);
    KIRI_CHECK(clamp != NULL, "clamp is null");
    *clamp = 0;
    KIRI_FIND_SHEET(data, sheet);
    const char* why;
    kiriResult result = HoldLine(world, data, KIRI_PIN_CLAMP, from, to, clamp, &why);
    KIRI_RETURN_OR_SAY(result, why);
}

kiriResult kiriSheet_HingeLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                               kiriPin* hinge)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_HINGE_LINE, &sheet, from, to, hinge);
    KIRI_CHECK(hinge != NULL, "hinge is null");
    *hinge = 0;
    KIRI_FIND_SHEET(data, sheet);
    const char* why;
    kiriResult result = HoldLine(world, data, KIRI_PIN_HINGE, from, to, hinge, &why);
    KIRI_RETURN_OR_SAY(result, why);
}

/* ---- All pins ---------------------------------------------------------------------------------------------------- */

kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3])
{
    KIRI_CHANGES(world, KIRI_CALL_PIN_SET_TARGET, &pin, target);
    KIRI_CHECK(target != NULL && kiriCall_AreFinite(target, 3), "target is null or not finite");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    if (!kiriVec3_Shows(data->target, target)) {
        data->target = kiriVec3_Load(target);
        kiriPinStep_Fasten(world, data);
        kiriPins_ForgetHistory(sheet, (int32_t)(data - sheet->pins.data));
        kiriMotion_WakePin(sheet, (int32_t)(data - sheet->pins.data));
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriPin_SetPose(kiriWorld* world, kiriPin pin, const float target[3], const float rotation[9])
{
    KIRI_CHANGES(world, KIRI_CALL_PIN_SET_POSE, &pin, target, rotation);
    KIRI_CHECK(target != NULL && kiriCall_AreFinite(target, 3), "target is null or not finite");
    KIRI_CHECK(rotation != NULL && kiriCall_AreFinite(rotation, 9), "rotation is null or not finite");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    KIRI_CHECK(data->type != KIRI_PIN_POINT, "the pin holds a point, which has no rotation");
    const char* why = kiriCall_FaultOfRotation(sheet, rotation);
    KIRI_CHECK(why == NULL, why);
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    m = kiriMat3_Rotation(m);
    if (!kiriVec3_Shows(data->target, target) || !kiriMat3_Shows(&data->rotation, &m, rotation)) {
        data->target = kiriVec3_Load(target);
        data->rotation = m;
        kiriPins_ForgetHistory(sheet, (int32_t)(data - sheet->pins.data));
        kiriMotion_WakePin(sheet, (int32_t)(data - sheet->pins.data));
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriPin_SetBreakForce(kiriWorld* world, kiriPin pin, float breakForce)
{
    KIRI_CHANGES(world, KIRI_CALL_PIN_SET_BREAK_FORCE, &pin, &breakForce);
    KIRI_CHECK(kiriCall_IsAtLeast(breakForce, 0.0f), "breakForce is not finite, or below 0");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    if (data->breakForce != (double)breakForce) {
        data->breakForce = breakForce;
        kiriMotion_WakePin(sheet, (int32_t)(data - sheet->pins.data));
    }
    KIRI_RETURN(KIRI_OK);
}

static void StoreRest(const kiriSheetData* sheet, kiriLatticePoint at, float rest[2])
{
    kiriVec2 point = kiriVec2_Add(sheet->mesh.origin, kiriMesh_Local(&sheet->mesh, at));
    rest[0] = (float)point.x;
    rest[1] = (float)point.y;
}

kiriResult kiriPin_GetState(const kiriWorld* world, kiriPin pin, kiriPinState* state)
{
    KIRI_READS(world);
    KIRI_CHECK(state != NULL, "state is null");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    const kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    state->type = data->type;
    state->sheet = sheet->id;
    StoreRest(sheet, data->at, state->from);
    StoreRest(sheet, data->to, state->to);
    state->breakForce = (float)data->breakForce;
    state->obstacle = kiriPinStep_Obstacle(world, data) != NULL ? data->anchor.obstacle : 0;
    kiriVec3_Store(state->target, data->target);
    kiriVec3_Store(&state->rotation[0], data->rotation.u);
    kiriVec3_Store(&state->rotation[3], data->rotation.v);
    kiriVec3_Store(&state->rotation[6], data->rotation.d);
    return KIRI_OK;
}

kiriResult kiriPin_GetReaction(const kiriWorld* world, kiriPin pin, double force[3], double torque[3])
{
    KIRI_READS(world);
    KIRI_CHECK(force != NULL && torque != NULL, "force or torque is null");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    const kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    kiriVec3_StoreDoubles(force, data->bore.force);
    kiriVec3_StoreDoubles(torque, data->bore.moment);
    return KIRI_OK;
}

kiriResult kiriSheet_GetPins(const kiriWorld* world, kiriSheet sheet, kiriPin* pins, int32_t capacity, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(count != NULL && (capacity == 0 || (capacity > 0 && pins != NULL)), "count is null, or pins is");
    KIRI_FIND_SHEET(data, sheet);
    for (int32_t i = 0; i < data->pins.count && i < capacity; ++i) {
        pins[i] = data->pins.data[i].id;
    }
    *count = data->pins.count;
    return KIRI_OK;
}

kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin)
{
    KIRI_CHANGES(world, KIRI_CALL_DESTROY_PIN, &pin);
    KIRI_FIND_PIN_SHEET(sheet, pin);
    kiriWorld_RemovePin(world, sheet, kiriPool_Find(&world->pinIds, pin)->index);
    KIRI_RETURN(KIRI_OK);
}
