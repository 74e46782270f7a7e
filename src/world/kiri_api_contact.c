#include "../sheet/kiri_touch.h"
#include "kiri_call.h"

#include <string.h>

static const char* FaultOfContact(const kiriContact* contact, int32_t points)
{
    if (!kiriCall_IsWithin(contact->point, -1, points - 1)) {
        return "a contact names no collision point";
    }
    if (!kiriCall_AreFinite(contact->normal, 3) || fabs(kiriVec3_Length(kiriVec3_Load(contact->normal)) - 1.0) > 1e-3) {
        return "the normal of a contact is not a unit vector";
    }
    if (!kiriCall_AreFinite(contact->velocity, 3) || !isfinite(contact->offset)) {
        return "offset or velocity of a contact is not finite";
    }
    return kiriCall_IsAtLeast(contact->friction, 0.0f) && kiriCall_IsAtLeast(contact->inverseMass, 0.0f) &&
                   kiriCall_IsAtLeast(contact->pushSpeed, 0.0f)
               ? NULL
               : "friction, inverseMass or pushSpeed of a contact is out of range";
}

/* Finds the triangle with the rest point of a contact that names no collision point. */
static bool PlaceContact(const kiriSheetData* sheet, kiriGivenContact* given)
{
    kiriLatticePoint at, corners[3];
    given->vertex[0] = given->vertex[1] = given->vertex[2] = KIRI_NONE;
    if (given->contact.point >= 0) {
        return true;
    }
    if (!kiriCall_AreFinite(given->contact.restPoint, 2) ||
        !kiriSheet_ToLattice(sheet, given->contact.restPoint, &at)) {
        return false;
    }
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    if (triangle == KIRI_NONE) {
        return false;
    }
    kiriMesh_Corners(&sheet->mesh, triangle, corners);
    double area = (double)kiriOrient(corners[0], corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) {
        given->vertex[k] = sheet->mesh.triangles.data[triangle].vertex[k];
        given->share[k] = (double)kiriOrient(corners[(k + 1) % 3], corners[(k + 2) % 3], at) / area;
    }
    return true;
}

static const char* FaultOfContacts(const kiriSheetData* sheet, const kiriContact* contacts, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        kiriGivenContact given = { .contact = contacts[i] };
        const char* why = FaultOfContact(&contacts[i], sheet->points.count);
        why = why == NULL && !PlaceContact(sheet, &given) ? "restPoint of a contact lies outside the material" : why;
        if (why != NULL) {
            return why;
        }
    }
    return NULL;
}

/* Room for a contact of each point at once, so that later calls, and ticks, need no memory. */
static bool ReserveContacts(kiriSheetData* data, int32_t count)
{
    int32_t room = kiriMax(count, data->points.count);
    return kiriArray_Reserve(data->memory, &data->contacts, room) &&
           kiriArray_Reserve(&data->shown, &data->touches.nextTold, room) && kiriTouches_Room(data, room);
}

kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts, int32_t count)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SET_CONTACTS, &sheet, contacts, &count);
    KIRI_CHECK(count == 0 || (count > 0 && contacts != NULL), "contacts is null, or count below 0");
    KIRI_FIND_SHEET(data, sheet);
    const char* why = FaultOfContacts(data, contacts, count);
    KIRI_CHECK(why == NULL, why);
    if (count > 0 && !ReserveContacts(data, count)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    for (int32_t i = 0; i < count; ++i) {
        kiriGivenContact given = { .contact = contacts[i] };
        PlaceContact(data, &given);
        data->contacts.data[i] = given;
    }
    data->contacts.count = count;
    data->rest.isIdle = data->rest.isIdle && count == 0;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetContactForces(const kiriWorld* world, kiriSheet sheet, const kiriContactForce** forces,
                                      int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(forces != NULL && count != NULL, "forces or count is null");
    KIRI_FIND_SHEET(data, sheet);
    *forces = data->touches.told.data;
    *count = data->touches.told.count;
    return KIRI_OK;
}
