#include "kiri_call.h"
#include "kiri_move.h"
#include "../sheet/kiri_meeting.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "kiri_seam.h"

void kiriDefaultObstacleDef(kiriObstacleDef* def)
{
    if (def == NULL) {
        return;
    }
    KIRI_CLEAR(def);
    def->cookie = KIRI_COOKIE(kiriObstacleDef);
    def->rotation[0] = def->rotation[4] = def->rotation[8] = 1.0f;
    def->friction = 0.5f;
    def->pushSpeed = 1.0f;
    def->groups = UINT32_MAX;
}

/* ---- Obstacles --------------------------------------------------------------------------------------------------- */

static void FillOutline(kiriObstacleShape* shape, const kiriObstacleDef* def)
{
    double x = 0.5 * def->size[0], y = 0.5 * def->size[1];
    const kiriVec2 box[4] = { { -x, -y }, { x, -y }, { x, y }, { -x, y } };
    KIRI_EACH_INDEX(i, *shape) {
        bool isBox = def->type == KIRI_OBSTACLE_BOX;
        shape->outline[i] = isBox ? box[i] : kiriVec2_Load(&def->outline[2 * i]);
    }
    KIRI_EACH_INDEX(i, *shape) {
        kiriVec2 along = kiriVec2_Sub(shape->outline[(i + 1) % shape->count], shape->outline[i]);
        KIRI_ASSERT(kiriVec2_Length(along) > 0.0);
        shape->normals[i] = kiriVec2_Scale(1.0 / kiriVec2_Length(along), kiriVec2_Make(along.y, -along.x));
    }
}

static void FillShape(kiriObstacleShape* shape, const kiriObstacleDef* def)
{
    bool isBox = def->type == KIRI_OBSTACLE_BOX, isPrism = def->type == KIRI_OBSTACLE_PRISM;
    bool isRound =
        def->type == KIRI_OBSTACLE_SPHERE || def->type == KIRI_OBSTACLE_CAPSULE || def->type == KIRI_OBSTACLE_CYLINDER;
    shape->type = isBox ? KIRI_OBSTACLE_PRISM : def->type;
    shape->radius = isRound ? def->radius : 0.0;
    shape->rounding = isBox || isPrism ? def->rounding : 0.0;
    shape->half = 0.5 * (isBox ? def->size[2] : def->height);
    if (isPrism && def->height == 0.0f) {
        shape->half = KIRI_ENDLESS;
    } else if (def->type == KIRI_OBSTACLE_SPHERE || def->type == KIRI_OBSTACLE_PLANE) {
        shape->half = 0.0;
    }
    FillOutline(shape, def);
    double farthest = shape->type == KIRI_OBSTACLE_PLANE ? KIRI_ENDLESS : shape->radius;
    KIRI_EACH_INDEX(i, *shape) {
        double length = kiriVec2_Length(shape->outline[i]);
        farthest = kiriMax(length, farthest);
    }
    shape->flat = farthest + shape->rounding;
}

static void SetMass(kiriObstacleData* obstacle, float mass, const float inertia[6], const float center[3])
{
    kiriMat3 inverse;
    obstacle->mass = mass;
    obstacle->center = kiriVec3_Load(center);
    if (kiriObstacle_InvertInertia(inertia, &inverse)) { /* world axes; stored in the obstacle's axes */
        const kiriMat3 turned = { kiriObstacle_ToLocal(obstacle, inverse.u), kiriObstacle_ToLocal(obstacle, inverse.v),
                                  kiriObstacle_ToLocal(obstacle, inverse.d) };
        obstacle->inverseInertia = kiriMat3_MulMat(turned, obstacle->rotation);
    }
}

static void Fill(kiriObstacleData* obstacle, const kiriObstacleDef* def)
{
    FillShape(&obstacle->shape, def);
    obstacle->position = kiriVec3_Load(def->position);
    obstacle->rotation = kiriMat3_Rotation(kiriMat3_Load(def->rotation));
    obstacle->velocity = kiriVec3_Load(def->velocity);
    obstacle->spin = kiriVec3_Load(def->angularVelocity);
    obstacle->surface = kiriVec3_Load(def->surfaceVelocity);
    obstacle->friction = def->friction;
    obstacle->body = def->body;
    obstacle->pushSpeed = def->pushSpeed;
    obstacle->groups = def->groups;
    obstacle->drift = KIRI_ENDLESS;
    SetMass(obstacle, def->mass, def->inertia, def->centerOfMass);
}

kiriResult kiriCreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle)
{
    kiriObstacleDef withoutOutline;
    if (def != NULL && def->cookie == KIRI_COOKIE(kiriObstacleDef) && def->type != KIRI_OBSTACLE_PRISM) {
        withoutOutline = *def; /* other shapes may come with any pointer as outline */
        withoutOutline.outline = NULL;
        withoutOutline.outlineCount = 0;
        def = &withoutOutline;
    }
    KIRI_CHANGES(CreateObstacle, def, obstacle);
    kiriResult result = kiriObstacles_Reserve(world);
    KIRI_REQUIRE(result == KIRI_OK, result, NULL);
    kiriObstacleData* made =
        kiriObstacle_Alloc(&world->memory, def->type == KIRI_OBSTACLE_BOX ? 4 : def->outlineCount);
    KIRI_REQUIRE(made != NULL, KIRI_ERROR_MEMORY, NULL);
    KIRI_ASSERT(made->shape.count == 0 || made->shape.outline != NULL);
    Fill(made, def);
    kiriObstacles_Add(world, made);
    *obstacle = made->id;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriDestroyObstacle(kiriWorld* world, kiriObstacle obstacle)
{
    KIRI_CHANGES(DestroyObstacle, &obstacle);
    kiriObstacles_Remove(world, call->owner);
    KIRI_RETURN(KIRI_OK);
}

/* ---- Changes ----------------------------------------------------------------------------------------------------- */

kiriResult kiriObstacle_SetPose(kiriWorld* world, kiriObstacle obstacle, const float position[3],
                                const float rotation[9])
{
    KIRI_CHANGES(Obstacle_SetPose, &obstacle, position, rotation);
    kiriObstacles_Put(world, call->owner, kiriVec3_Load(position), kiriMat3_Rotation(kiriMat3_Load(rotation)));
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriObstacle_SetVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3],
                                    const float angularVelocity[3])
{
    KIRI_CHANGES(Obstacle_SetVelocity, &obstacle, velocity, angularVelocity);
    kiriObstacleData* data = call->owner;
    data->velocity = kiriVec3_Load(velocity);
    data->spin = kiriVec3_Load(angularVelocity);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriObstacle_SetSurfaceVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3])
{
    KIRI_CHANGES(Obstacle_SetSurfaceVelocity, &obstacle, velocity);
    kiriObstacleData* data = call->owner;
    kiriVec3 surface = kiriVec3_Load(velocity);
    data->drift = kiriVec3_Equal(data->surface, surface) ? data->drift : KIRI_ENDLESS;
    data->surface = surface;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriObstacle_SetMass(kiriWorld* world, kiriObstacle obstacle, float mass, const float inertia[6],
                                const float centerOfMass[3])
{
    KIRI_CHANGES(Obstacle_SetMass, &obstacle, &mass, inertia, centerOfMass);
    SetMass(call->owner, mass, inertia, centerOfMass);
    KIRI_RETURN(KIRI_OK);
}

/* ---- State ------------------------------------------------------------------------------------------------------- */

kiriResult kiriObstacle_GetState(const kiriWorld* world, kiriObstacle obstacle, kiriObstacleState* state)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(state);
    KIRI_FIND_SLOT(obstacle);
    const kiriObstacleData* data = slot->owner;
    kiriVec3_Store(state->position, data->position);
    kiriMat3_Store(state->rotation, data->rotation);
    kiriVec3_Store(state->velocity, data->velocity);
    kiriVec3_Store(state->angularVelocity, data->spin);
    kiriWrench_Store(&data->impulse, state->impulse, state->angularImpulse);
    state->contacts = data->contacts;
    return KIRI_OK;
}

/* ---- Reach ------------------------------------------------------------------------------------------------------- */

kiriResult kiriSheet_GetReach(const kiriWorld* world, kiriSheet sheet, float dt, float lower[3], float upper[3])
{
    KIRI_READS_OF(sheet, lower);
    KIRI_CHECK_OUT(upper);
    KIRI_CHECK_NUMBER(dt, 1e-6f, 10.0f);
    kiriBox box = kiriSheet_Box(found);
    double speed = kiriSheet_SpeedLimit(found, &box);
    double reach = kiriReach_Of(speed, world->gravity, dt) + found->settings.contactThickness;
    kiriVec3 margin = kiriVec3_Make(reach, reach, reach);
    kiriBounds_Ask(found->seen.bounds);
    kiriVec3_Store(lower, kiriVec3_Sub(box.lower, margin));
    kiriVec3_Store(upper, kiriVec3_Add(box.upper, margin));
    return KIRI_OK;
}

/* Finds the triangle at the rest point of a contact without a collision point. Fails if the contact has no place. */
static bool PlaceContact(const kiriSheetData* sheet, kiriGivenContact* given)
{
    kiriLatticePoint at;
    kiriPointPlace place;
    given->vertex[0] = given->vertex[1] = given->vertex[2] = KIRI_NONE;
    if (given->contact.point >= 0) {
        return given->contact.point < sheet->points.count;
    }
    bool isFound = kiriCall_AreFinite(given->contact.restPoint, 2) &&
                   kiriSheet_ToLattice(sheet, given->contact.restPoint, &at) && kiriPoint_Find(sheet, at, &place);
    if (isFound) {
        memcpy(given->vertex, sheet->mesh.triangles.data[place.triangle].vertex, sizeof(given->vertex));
        memcpy(given->share, place.shares, sizeof(given->share));
    }
    return isFound;
}

kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts, int32_t count)
{
    KIRI_CHANGES(Sheet_SetContacts, &sheet, contacts, &count);
    kiriSheetData* data = call->sheet;
    KIRI_TIMES(i, count) {
        kiriGivenContact given = { .contact = contacts[i] };
        if (!PlaceContact(data, &given)) {
            kiriFault fault;
            KIRI_SAY(&fault, "contacts[%lld] names no collision point, or a restPoint outside the material", (long long)i);
            return KIRI_FAIL(KIRI_ERROR_ARGUMENT, fault.line);
        }
    }
    /* Reserves a contact of each point at once, so that later calls, and ticks, allocate nothing. */
    int32_t room = kiriMax(count, data->points.count);
    KIRI_REQUIRE(count == 0 || (kiriArray_Reserve(data->memory, &data->contacts, room) &&
                                kiriArray_Reserve(&data->shown, &data->touches.nextTold, room) &&
                                kiriTouches_Room(data, room)),
                 KIRI_ERROR_MEMORY, NULL);
    KIRI_ASSERT(data->contacts.capacity >= count);
    KIRI_TIMES(i, count) {
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
    KIRI_READS_OF(sheet, forces);
    KIRI_CHECK_OUT(count);
    *forces = found->touches.told.data;
    *count = found->touches.told.count;
    return KIRI_OK;
}

void kiriDefaultPinDef(kiriPinDef* def)
{
    if (def != NULL) {
        KIRI_CLEAR(def);
        def->cookie = KIRI_COOKIE(kiriPinDef);
    }
}

static kiriResult AddNewPin(kiriWorld* world, kiriSheetData* data, const kiriPinData* made, int32_t frame, kiriPin* pin)
{
    kiriResult result = kiriWorld_ReserveIds(world, &world->pinIds, 1);
    if (result == KIRI_OK && (!kiriSurface_ReserveHeld(&data->seen.surface, &data->shown) ||
                              !kiriPins_Add(data, made, frame))) {
        result = KIRI_ERROR_MEMORY;
    }
    if (result == KIRI_OK) {
        KIRI_ASSERT(data->pins.count > 0 && data->pins.data[data->pins.count - 1].type == made->type);
        *pin = kiriPool_Add(&world->pinIds, data, data->pins.count - 1);
        data->pins.data[data->pins.count - 1].id = *pin;
        kiriPins_ForgetHistory(data, data->pins.count - 1);
        kiriSurface_SetDetail(&data->seen.surface, data->seen.surface.detail.sweeps, true);
        kiriSheet_WakePin(data, data->pins.count - 1);
    }
    return result;
}

kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin)
{
    KIRI_CHANGES(CreatePin, &sheet, def, pin);
    kiriSheetData* data = call->sheet;
    kiriPinData made = { .type = KIRI_PIN_POINT, .rotation = KIRI_AXES, .lastRotation = KIRI_AXES };
    bool inRange = kiriSheet_ToLattice(data, def->restPoint, &made.at);
    int32_t frame = inRange ? kiriOwner_At(data, made.at) : KIRI_NONE;
    KIRI_CHECK_INSIDE(frame != KIRI_NONE, def->restPoint);
    made.to = made.at;
    made.target = made.lastTarget = kiriVec3_Load(def->target);
    made.anchor.obstacle = def->obstacle;
    kiriPinStep_Fasten(world, &made);
    made.breakForce = def->breakForce;
    made.stiffness = def->stiffness > 0.0f ? def->stiffness : kiriPins_Stiffness(data);
    KIRI_RETURN(AddNewPin(world, data, &made, frame, pin));
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

kiriResult kiriCall_FindLine(kiriSheetData* sheet, const float from[2], const float to[2], kiriLatticePoint ends[2],
                             const char** why)
{
    *why = NULL;
    if (!kiriSheet_ToLattice(sheet, from, &ends[0]) || !kiriSheet_ToLattice(sheet, to, &ends[1])) {
        *why = "from or to lies too far outside the sheet";
    } else if (ends[0].x == ends[1].x && ends[0].y == ends[1].y) {
        *why = "from and to are the same point";
    } else if (!kiriOwner_FindShares(sheet, ends[0], ends[1], false)) {
        return KIRI_ERROR_MEMORY;
    } else if (sheet->lineShares.count == 0) {
        *why = "the line meets no material";
    }
    return *why == NULL ? KIRI_OK : KIRI_ERROR_ARGUMENT;
}

/* Adds a clamp or a hinge. */
static kiriResult HoldLine(kiriCall* call, int32_t type, const float from[2], const float to[2], kiriPin* pin)
{
    const char* why;
    KIRI_ASSERT(type == KIRI_PIN_CLAMP || type == KIRI_PIN_HINGE);
    kiriPinData made = { .type = type, .rotation = KIRI_AXES };
    kiriLatticePoint ends[2];
    kiriResult result = kiriCall_FindLine(call->sheet, from, to, ends, &why);
    if (result == KIRI_OK) {
        made.at = ends[0];
        made.to = ends[1];
        kiriPin_TakePose(call->sheet, &made);
        made.lastTarget = made.target;
        made.lastRotation = made.rotation;
        result = AddNewPin(call->world, call->sheet, &made, KIRI_NONE, pin);
    }
    return kiriCall_End(call->world, call, call->function, result, why);
}

kiriResult kiriSheet_ClampLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                               kiriPin* clamp)
{
    KIRI_CHANGES(Sheet_ClampLine, &sheet, from, to, clamp);
    return HoldLine(call, KIRI_PIN_CLAMP, from, to, clamp);
}

kiriResult kiriSheet_HingeLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                               kiriPin* hinge)
{
    KIRI_CHANGES(Sheet_HingeLine, &sheet, from, to, hinge);
    return HoldLine(call, KIRI_PIN_HINGE, from, to, hinge);
}

/* ---- All pins ---------------------------------------------------------------------------------------------------- */

/* Moves a pin to a target, and turns it unless `rotation` is null. */
static void MovePin(kiriCall* call, const float target[3], const float* rotation, const kiriMat3* to)
{
    kiriPinData* pin = &call->sheet->pins.data[call->index];
    if (!kiriVec3_Shows(pin->target, target) || (to != NULL && !kiriMat3_Shows(&pin->rotation, to, rotation))) {
        pin->target = kiriVec3_Load(target);
        pin->rotation = to != NULL ? *to : pin->rotation;
        kiriPinStep_Fasten(call->world, pin);
        kiriPins_ForgetHistory(call->sheet, call->index);
        kiriSheet_WakePin(call->sheet, call->index);
    }
}

kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3])
{
    KIRI_CHANGES(Pin_SetTarget, &pin, target);
    KIRI_ASSERT(call->index < call->sheet->pins.count && call->sheet->pins.data[call->index].id == pin);
    MovePin(call, target, NULL, NULL);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriPin_SetPose(kiriWorld* world, kiriPin pin, const float target[3], const float rotation[9])
{
    KIRI_CHANGES(Pin_SetPose, &pin, target, rotation);
    KIRI_ASSERT(call->index < call->sheet->pins.count && call->sheet->pins.data[call->index].id == pin);
    KIRI_CHECK(call->sheet->pins.data[call->index].type != KIRI_PIN_POINT,
               "the pin holds a point, which has no rotation");
    kiriMat3 to = kiriMat3_Rotation(kiriMat3_Load(rotation));
    KIRI_CHECK(kiriCall_KeepsPlane(call->sheet, to.d), "rotation turns a planar sheet out of its plane");
    MovePin(call, target, rotation, &to);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriPin_SetBreakForce(kiriWorld* world, kiriPin pin, float breakForce)
{
    KIRI_CHANGES(Pin_SetBreakForce, &pin, &breakForce);
    kiriPinData* data = &call->sheet->pins.data[call->index];
    if (data->breakForce != (double)breakForce) {
        data->breakForce = breakForce;
        kiriSheet_WakePin(call->sheet, call->index);
    }
    KIRI_RETURN(KIRI_OK);
}

static void StoreRest(const kiriSheetData* sheet, kiriLatticePoint at, float rest[2])
{
    kiriVec2_Store(rest, kiriVec2_Add(sheet->mesh.origin, kiriMesh_Local(&sheet->mesh, at)));
}

kiriResult kiriPin_GetState(const kiriWorld* world, kiriPin pin, kiriPinState* state)
{
    KIRI_READS_OF(pin, state);
    KIRI_ASSERT(slot->index < found->pins.count && found->pins.data[slot->index].id == pin);
    const kiriPinData* data = &found->pins.data[slot->index];
    state->type = data->type;
    state->sheet = found->id;
    StoreRest(found, data->at, state->from);
    StoreRest(found, data->to, state->to);
    state->breakForce = (float)data->breakForce;
    state->obstacle = kiriPinStep_Obstacle(world, data) != NULL ? data->anchor.obstacle : 0;
    kiriVec3_Store(state->target, data->target);
    kiriMat3_Store(state->rotation, data->rotation);
    return KIRI_OK;
}

kiriResult kiriPin_GetReaction(const kiriWorld* world, kiriPin pin, double force[3], double torque[3])
{
    KIRI_READS_OF(pin, force);
    KIRI_CHECK_OUT(torque);
    kiriWrench_Store(&found->pins.data[slot->index].bore, force, torque);
    return KIRI_OK;
}

kiriResult kiriSheet_GetPins(const kiriWorld* world, kiriSheet sheet, kiriPin* pins, int32_t capacity, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK_LIST(pins);
    KIRI_FIND(sheet);
    KIRI_RETURN_IDS(pins, found->pins, &found->pins.data[i]);
}

kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin)
{
    KIRI_CHANGES(DestroyPin, &pin);
    kiriWorld_RemovePin(world, call->sheet, call->index);
    KIRI_RETURN(KIRI_OK);
}

/* ---- Seams ------------------------------------------------------------------------------------------------------- */

kiriResult kiriSeam_GetStitch(const kiriWorld* world, kiriSeam seam, int32_t index, kiriStitch* stitch)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(stitch);
    KIRI_FIND_SLOT(seam);
    const kiriSeamData* data = slot->owner;
    KIRI_CHECK_NUMBER(index, 0, data->stitches.count - 1);
    const kiriStitchData* from = &data->stitches.data[index];
    const kiriSheetData *a = kiriStitch_Sheet(world, from, 0), *b = kiriStitch_Sheet(world, from, 1);
    kiriVec3 x = kiriStitch_Point(world, data, index, 0), y = kiriStitch_Point(world, data, index, 1);
    stitch->sheetA = a->id;
    stitch->sheetB = b->id;
    StoreRest(a, from->at[0], stitch->restA);
    StoreRest(b, from->at[1], stitch->restB);
    kiriVec3 drawn = { 0.0, 0.0, 0.0 };
    KIRI_TIMES(end, 2) {
        kiriPointPlace place;
        const kiriSheetData* sheet = end == 0 ? a : b;
        if (kiriPoint_Find(sheet, from->at[end], &place)) {
            drawn = kiriVec3_AddScaled(drawn, 0.5, kiriPoint_Drawn(sheet, &place));
        }
    }
    kiriVec3_Store(stitch->position, drawn);
    stitch->gap = (float)kiriVec3_Distance(x, y);
    kiriVec3_Store(stitch->force, from->force);
    stitch->angle = (float)kiriStitch_Angle(world, data, index);
    return KIRI_OK;
}

kiriResult kiriSeam_GetCount(const kiriWorld* world, kiriSeam seam, int32_t* stitches)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(stitches);
    KIRI_FIND_SLOT(seam);
    *stitches = ((const kiriSeamData*)slot->owner)->stitches.count;
    return KIRI_OK;
}

kiriResult kiriWorld_GetSeams(const kiriWorld* world, kiriSeam* seams, int32_t capacity, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK_LIST(seams);
    KIRI_RETURN_IDS(seams, world->seams, world->seams.data[i]);
}
