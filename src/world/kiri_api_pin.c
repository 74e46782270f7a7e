#include "kiri_call.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"

#include <math.h>
#include <string.h>

void kiriDefaultPinDef(kiriPinDef* def)
{
    if (def != NULL) {
        memset(def, 0, sizeof(*def));
        def->cookie = KIRI_COOKIE(kiriPinDef);
    }
}

kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(def != NULL && pin != NULL, "def or pin is null");
    *pin = 0;
    if (def->cookie != KIRI_COOKIE(kiriPinDef)) {
        return KIRI_FAIL(KIRI_ERROR_DEF, "the def was not filled by kiriDefaultPinDef");
    }
    KIRI_CHECK(kiriCall_AreFinite(def->restPoint, 2) && kiriCall_AreFinite(def->target, 3) &&
                   kiriCall_IsAtLeast(def->stiffness, 0.0f),
               "restPoint, target or stiffness is not finite, or stiffness below 0");
    KIRI_FIND_SHEET(data, sheet);
    kiriPinData made;
    memset(&made, 0, sizeof(made));
    bool inRange = kiriSheet_ToLattice(data, def->restPoint, &made.at);
    int32_t frame = inRange ? kiriPins_FrameAt(data, made.at) : KIRI_NONE;
    KIRI_CHECK(frame != KIRI_NONE, "restPoint lies outside the material");
    made.target = kiriVec3_Load(def->target);
    made.stiffness = def->stiffness > 0.0f
                         ? def->stiffness
                         : 10.0 * data->settings.material.youngsModulus * data->settings.material.thickness;
    kiriResult result = kiriWorld_ReserveIds(world, &world->pinIds, 1);
    if (result == KIRI_OK && !kiriPins_Add(data, &made, frame)) {
        result = KIRI_ERROR_MEMORY;
    }
    if (result != KIRI_OK) {
        return KIRI_FAIL(result, NULL);
    }
    *pin = kiriPool_Add(&world->pinIds, &world->memory, data, data->pins.count - 1);
    data->pins.data[data->pins.count - 1].id = *pin;
    kiriMotion_ForgetHistory(data, frame);
    kiriMotion_Wake(data);
    return KIRI_OK;
}

kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3])
{
    KIRI_CHANGES(world);
    KIRI_CHECK(target != NULL && kiriCall_AreFinite(target, 3), "target is null or not finite");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    if (!kiriVec3_Equal(data->target, kiriVec3_Load(target))) {
        data->target = kiriVec3_Load(target);
        kiriMotion_ForgetHistory(sheet, sheet->layout.pinFrame.data[data - sheet->pins.data]);
        kiriMotion_Wake(sheet);
    }
    return KIRI_OK;
}

kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin)
{
    KIRI_CHANGES(world);
    KIRI_FIND_PIN_SHEET(sheet, pin);
    int32_t index = kiriPool_Find(&world->pinIds, pin)->index;
    kiriMotion_ForgetHistory(sheet, sheet->layout.pinFrame.data[index]);
    kiriPins_Remove(sheet, index);
    kiriMotion_Wake(sheet);
    if (index < sheet->pins.count) {
        kiriPool_Find(&world->pinIds, sheet->pins.data[index].id)->index = index;
    }
    kiriPool_Remove(&world->pinIds, pin);
    return KIRI_OK;
}

static const char* FaultOfContact(const kiriContact* contact, int32_t points)
{
    if (!kiriCall_IsWithin(contact->point, 0, points - 1)) {
        return "a contact names no collision point";
    }
    if (!kiriCall_AreFinite(contact->normal, 3) || fabs(kiriVec3_Length(kiriVec3_Load(contact->normal)) - 1.0) > 1e-3) {
        return "the normal of a contact is not a unit vector";
    }
    return isfinite(contact->offset) && kiriCall_IsAtLeast(contact->friction, 0.0f) &&
                   kiriCall_IsAbove(contact->stiffness, 0.0f)
               ? NULL
               : "offset, friction or stiffness of a contact is out of range";
}

kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts, int32_t count)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(count == 0 || (count > 0 && contacts != NULL), "contacts is null, or count below 0");
    KIRI_FIND_SHEET(data, sheet);
    for (int32_t i = 0; i < count; ++i) {
        const char* why = FaultOfContact(&contacts[i], data->points.count);
        KIRI_CHECK(why == NULL, why);
    }
    /* Room for a contact of each point at once, so that later calls need no memory. */
    int32_t room = count > data->points.count ? count : data->points.count;
    if (count > 0 && (!kiriArray_Reserve(data->memory, &data->contacts, room) ||
                      !kiriArray_Reserve(data->memory, &data->rest.contacts, room) ||
                      !kiriArray_Reserve(data->memory, &data->contactRows, room))) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    if (count > 0) {
        memcpy(data->contacts.data, contacts, sizeof(*contacts) * (size_t)count);
    }
    data->contacts.count = count;
    return KIRI_OK;
}
