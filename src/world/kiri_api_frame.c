#include "kiri_call.h"
#include "../sheet/kiri_motion.h"

static kiriFrameData* FindFrame(const kiriWorld* world, kiriFrame frame)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
    return slot != NULL ? &((kiriSheetData*)slot->owner)->frames.data[slot->index] : NULL;
}

kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity,
                               int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(count != NULL && (capacity == 0 || (capacity > 0 && frames != NULL)), "count is null, or frames is");
    KIRI_FIND_SHEET(data, sheet);
    *count = 0;
    for (int32_t i = 0; i < data->frames.count; ++i) {
        bool isGone = kiriSheet_IsGone(data, i);
        if (!isGone && *count < capacity) {
            frames[*count] = data->frames.data[i].id;
        }
        *count += !isGone;
    }
    return KIRI_OK;
}

kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state)
{
    KIRI_READS(world);
    KIRI_CHECK(state != NULL, "state is null");
    const kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with this id");
    }
    const kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frame)->owner;
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, data->site.at);
    kiriVec3 x = kiriFrame_Carry(data, data->site.at);
    state->restPoint[0] = (float)rest.x;
    state->restPoint[1] = (float)rest.y;
    kiriVec3_Store(state->position, x);
    kiriVec3_Store(&state->rotation[0], data->A.u);
    kiriVec3_Store(&state->rotation[3], data->A.v);
    kiriVec3_Store(&state->rotation[6], data->A.d);
    kiriVec3_Store(state->velocity, kiriFrame_VelocityAt(data, data->site.at));
    kiriVec3_Store(state->angularVelocity, data->spin);
    state->area = (float)data->area;
    state->mass = (float)data->mass;
    state->held = data->held;
    return KIRI_OK;
}

kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9])
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_HOLD, &frame, position, rotation);
    KIRI_CHECK((position == NULL) == (rotation == NULL), "only one of position and rotation is null");
    kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with this id");
    }
    kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frame)->owner;
    if (position == NULL) {
        if (data->held) {
            kiriMotion_WakeFrame(sheet, kiriPool_Find(&world->frameIds, frame)->index);
        }
        data->held = 0;
        KIRI_RETURN(KIRI_OK);
    }
    KIRI_CHECK(kiriCall_AreFinite(position, 3), "position is not finite");
    const char* why = kiriCall_FaultOfRotation(sheet, rotation);
    KIRI_CHECK(why == NULL, why);
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    m = kiriMat3_Rotation(m);
    if (data->held && kiriVec3_Shows(data->goalPosition, position) &&
        kiriMat3_Shows(&data->goalRotation, &m, rotation)) {
        KIRI_RETURN(KIRI_OK);
    }
    data->goalPosition = kiriVec3_Load(position);
    data->goalRotation = m;
    if (!data->held) {
        data->held = 1;
        data->heldPosition = kiriFrame_Carry(data, data->site.at);
        data->heldRotation = kiriMat3_Rotation(data->A);
        data->isOffKnown = false;
    }
    kiriMotion_WakeFrame(sheet, kiriPool_Find(&world->frameIds, frame)->index);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_GetReaction(const kiriWorld* world, kiriFrame frame, double force[3], double torque[3])
{
    KIRI_READS(world);
    KIRI_CHECK(force != NULL && torque != NULL, "force or torque is null");
    const kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with this id");
    }
    kiriVec3_StoreDoubles(force, data->bore.force);
    kiriVec3_StoreDoubles(torque, data->bore.moment);
    return KIRI_OK;
}
