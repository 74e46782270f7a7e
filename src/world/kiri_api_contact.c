#include "kiri_call.h"
#include "kiri_move.h"
#include "../sheet/kiri_touch.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "kiri_blade.h"

#include <math.h>
#include <string.h>

void kiriDefaultObstacleDef(kiriObstacleDef* def)
{
    if (def == NULL) {
        return;
    }
    memset(def, 0, sizeof(*def));
    def->cookie = KIRI_COOKIE(kiriObstacleDef);
    def->rotation[0] = def->rotation[4] = def->rotation[8] = 1.0f;
    def->friction = 0.5f;
    def->pushSpeed = 1.0f;
    def->groups = UINT32_MAX;
}

/* ---- Faults ------------------------------------------------------------------------------------------------------ */

#define LONGEST 1e6f /* m */

static bool IsLength(float value)
{
    return kiriCall_IsAbove(value, 0.0f) && value <= LONGEST;
}

static kiriVec2 CornerOf(const kiriObstacleDef* def, int32_t i)
{
    i %= def->outlineCount;
    return kiriVec2_Make(def->outline[2 * i], def->outline[2 * i + 1]);
}

static double CrossOf(kiriVec2 a, kiriVec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* Every corner lies to the left of every edge, but for what floats lose; and no edge is a point. */
static bool IsConvex(const kiriObstacleDef* def)
{
    for (int32_t i = 0; i < def->outlineCount; ++i) {
        kiriVec2 a = CornerOf(def, i), along = kiriVec2_Sub(CornerOf(def, i + 1), a);
        double length = kiriVec2_Length(along), farthest = 0.0;
        for (int32_t k = 0; k < def->outlineCount; ++k) {
            kiriVec2 way = kiriVec2_Sub(CornerOf(def, k), a);
            double left = CrossOf(along, way);
            if (left < -1e-5 * length * kiriVec2_Length(way)) {
                return false;
            }
            farthest = kiriMax(left, farthest);
        }
        if (!(length > 0.0 && farthest > 0.0)) {
            return false;
        }
    }
    return true;
}

static const char* FaultOfPrism(const kiriObstacleDef* def)
{
    if (def->outline == NULL || !kiriCall_IsWithin(def->outlineCount, 3, 64) ||
        !kiriCall_AreFinite(def->outline, 2 * (int64_t)def->outlineCount)) {
        return "outline is null or not finite, or outlineCount not within 3 and 64";
    }
    for (int32_t i = 0; i < 2 * def->outlineCount; ++i) {
        if (fabsf(def->outline[i]) > LONGEST) {
            return "a corner of the outline is more than 1e6 m out";
        }
    }
    if (!kiriCall_IsAtLeast(def->height, 0.0f) || def->height > LONGEST) {
        return "height is not within 0 and 1e6";
    }
    return IsConvex(def) ? NULL : "outline is not a convex polygon, counter-clockwise";
}

static const char* FaultOfShape(const kiriObstacleDef* def)
{
    bool isRound =
        def->type == KIRI_OBSTACLE_SPHERE || def->type == KIRI_OBSTACLE_CAPSULE || def->type == KIRI_OBSTACLE_CYLINDER;
    if (!kiriCall_IsWithin(def->type, KIRI_OBSTACLE_PLANE, KIRI_OBSTACLE_PRISM)) {
        return "type is not one of KIRI_OBSTACLE";
    }
    if (isRound && !IsLength(def->radius)) {
        return "radius is not above 0 and up to 1e6";
    }
    if (def->type == KIRI_OBSTACLE_CAPSULE && (!kiriCall_IsAtLeast(def->height, 0.0f) || def->height > LONGEST)) {
        return "height is not within 0 and 1e6";
    }
    if (def->type == KIRI_OBSTACLE_CYLINDER && !IsLength(def->height)) {
        return "height is not above 0 and up to 1e6";
    }
    if (def->type == KIRI_OBSTACLE_BOX &&
        !(IsLength(def->size[0]) && IsLength(def->size[1]) && IsLength(def->size[2]))) {
        return "a size is not above 0 and up to 1e6";
    }
    if (!kiriCall_IsAtLeast(def->rounding, 0.0f) || def->rounding > LONGEST) {
        return "rounding is not within 0 and 1e6";
    }
    return def->type == KIRI_OBSTACLE_PRISM ? FaultOfPrism(def) : NULL;
}

static bool IsWithinFloats(const float value[3])
{
    return kiriCall_AreFinite(value, 3) && kiriVec3_FitsFloats(kiriVec3_Load(value));
}

static const char* FaultOfPose(const float position[3], const float rotation[9])
{
    if (position == NULL || rotation == NULL || !IsWithinFloats(position)) {
        return "position or rotation is null, or position not finite or where floats end";
    }
    if (!kiriCall_AreOrthonormal(&rotation[0], &rotation[3]) || !kiriCall_AreOrthonormal(&rotation[3], &rotation[6]) ||
        !kiriCall_AreOrthonormal(&rotation[6], &rotation[0])) {
        return "rotation is not orthonormal";
    }
    kiriVec3 u = kiriVec3_Load(&rotation[0]), v = kiriVec3_Load(&rotation[3]), d = kiriVec3_Load(&rotation[6]);
    return kiriVec3_Dot(kiriVec3_Cross(u, v), d) > 0.0 ? NULL : "rotation mirrors";
}

static const char* FaultOfMass(float mass, const float inertia[6], const float center[3])
{
    kiriMat3 inverse;
    if (inertia == NULL || center == NULL || !kiriCall_IsAtLeast(mass, 0.0f) || !kiriCall_AreFinite(inertia, 6) ||
        !kiriCall_AreFinite(center, 3)) {
        return "mass, inertia or centerOfMass is null or not finite, or mass below 0";
    }
    return kiriObstacle_InvertInertia(inertia, &inverse)
               ? NULL
               : "inertia is not positive definite, but for axes that are all zero";
}

static const char* FaultOfObstacle(const kiriObstacleDef* def)
{
    const char* faults[] = { FaultOfShape(def), FaultOfPose(def->position, def->rotation),
                             FaultOfMass(def->mass, def->inertia, def->centerOfMass) };
    for (int i = 0; i < 3; ++i) {
        if (faults[i] != NULL) {
            return faults[i];
        }
    }
    if (!IsWithinFloats(def->velocity) || !IsWithinFloats(def->angularVelocity) ||
        !IsWithinFloats(def->surfaceVelocity)) {
        return "a velocity is not finite, or where floats end";
    }
    return kiriCall_IsAtLeast(def->friction, 0.0f) && kiriCall_IsAbove(def->pushSpeed, 0.0f)
               ? NULL
               : "friction is below 0, or pushSpeed not above 0";
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

/* From axes of the world to its own. */
static kiriMat3 TensorToLocal(const kiriObstacleData* obstacle, const kiriMat3* tensor)
{
    kiriMat3 turned = { kiriObstacle_ToLocal(obstacle, tensor->u), kiriObstacle_ToLocal(obstacle, tensor->v),
                        kiriObstacle_ToLocal(obstacle, tensor->d) };
    return kiriMat3_MulMat(turned, obstacle->rotation);
}

static kiriMat3 LoadRotation(const float rotation[9])
{
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    return kiriMat3_Rotation(m);
}

static void FillOutline(kiriObstacleShape* shape, const kiriObstacleDef* def)
{
    double x = 0.5 * def->size[0], y = 0.5 * def->size[1];
    const kiriVec2 box[4] = { { -x, -y }, { x, -y }, { x, y }, { -x, y } };
    for (int32_t i = 0; i < shape->count; ++i) {
        shape->outline[i] = def->type == KIRI_OBSTACLE_BOX ? box[i] : CornerOf(def, i);
    }
    for (int32_t i = 0; i < shape->count; ++i) {
        kiriVec2 along = kiriVec2_Sub(shape->outline[(i + 1) % shape->count], shape->outline[i]);
        shape->normals[i] = kiriVec2_Scale(1.0 / kiriVec2_Length(along), kiriVec2_Make(along.y, -along.x));
    }
}

static double FarthestFromAxis(const kiriObstacleShape* shape)
{
    double farthest = shape->type == KIRI_OBSTACLE_PLANE ? KIRI_ENDLESS : shape->radius;
    for (int32_t i = 0; i < shape->count; ++i) {
        double length = kiriVec2_Length(shape->outline[i]);
        farthest = kiriMax(length, farthest);
    }
    return farthest + shape->rounding;
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
    shape->flat = FarthestFromAxis(shape);
}

static void SetMass(kiriObstacleData* obstacle, float mass, const float inertia[6], const float center[3])
{
    kiriMat3 inverse;
    obstacle->mass = mass;
    obstacle->center = kiriVec3_Load(center);
    if (kiriObstacle_InvertInertia(inertia, &inverse)) {
        obstacle->inverseInertia = TensorToLocal(obstacle, &inverse);
    }
}

static void Fill(kiriObstacleData* obstacle, const kiriObstacleDef* def)
{
    FillShape(&obstacle->shape, def);
    obstacle->position = kiriVec3_Load(def->position);
    obstacle->rotation = LoadRotation(def->rotation);
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

/* With its outline behind it, in one block. */
static kiriObstacleData* Make(kiriMemory* memory, const kiriObstacleDef* def)
{
    int32_t corners = def->type == KIRI_OBSTACLE_BOX ? 4 : def->type == KIRI_OBSTACLE_PRISM ? def->outlineCount : 0;
    kiriObstacleData* obstacle = kiriObstacle_Alloc(memory, corners);
    if (obstacle != NULL) {
        Fill(obstacle, def);
    }
    return obstacle;
}

kiriResult kiriCreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle)
{
    KIRI_CHANGES(world, KIRI_CALL_CREATE_OBSTACLE, def, obstacle);
    KIRI_CHECK(def != NULL && obstacle != NULL, "def or obstacle is null");
    *obstacle = 0;
    if (def->cookie != KIRI_COOKIE(kiriObstacleDef)) {
        return KIRI_FAIL(KIRI_ERROR_DEF, "the def was not filled by kiriDefaultObstacleDef");
    }
    const char* why = FaultOfObstacle(def);
    KIRI_CHECK(why == NULL, why);
    kiriResult result = kiriObstacles_Reserve(world);
    kiriObstacleData* made = result == KIRI_OK ? Make(&world->memory, def) : NULL;
    if (made == NULL) {
        return KIRI_FAIL(result == KIRI_OK ? KIRI_ERROR_MEMORY : result, NULL);
    }
    kiriObstacles_Add(world, made);
    *obstacle = made->id;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriDestroyObstacle(kiriWorld* world, kiriObstacle obstacle)
{
    KIRI_CHANGES(world, KIRI_CALL_DESTROY_OBSTACLE, &obstacle);
    KIRI_FIND_OBSTACLE(data, obstacle);
    kiriObstacles_Remove(world, data);
    KIRI_RETURN(KIRI_OK);
}

/* ---- Changes ----------------------------------------------------------------------------------------------------- */

kiriResult kiriObstacle_SetPose(kiriWorld* world, kiriObstacle obstacle, const float position[3],
                                const float rotation[9])
{
    KIRI_CHANGES(world, KIRI_CALL_OBSTACLE_SET_POSE, &obstacle, position, rotation);
    const char* why = FaultOfPose(position, rotation);
    KIRI_CHECK(why == NULL, why);
    KIRI_FIND_OBSTACLE(data, obstacle);
    kiriObstacles_Put(world, data, kiriVec3_Load(position), LoadRotation(rotation));
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriObstacle_SetVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3],
                                    const float angularVelocity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_OBSTACLE_SET_VELOCITY, &obstacle, velocity, angularVelocity);
    KIRI_CHECK(velocity != NULL && angularVelocity != NULL && IsWithinFloats(velocity) &&
                   IsWithinFloats(angularVelocity),
               "velocity or angularVelocity is null, not finite, or where floats end");
    KIRI_FIND_OBSTACLE(data, obstacle);
    data->velocity = kiriVec3_Load(velocity);
    data->spin = kiriVec3_Load(angularVelocity);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriObstacle_SetSurfaceVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_OBSTACLE_SET_SURFACE_VELOCITY, &obstacle, velocity);
    KIRI_CHECK(velocity != NULL && IsWithinFloats(velocity), "velocity is null, not finite, or where floats end");
    KIRI_FIND_OBSTACLE(data, obstacle);
    kiriVec3 surface = kiriVec3_Load(velocity);
    data->drift = kiriVec3_Equal(data->surface, surface) ? data->drift : KIRI_ENDLESS;
    data->surface = surface;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriObstacle_SetMass(kiriWorld* world, kiriObstacle obstacle, float mass, const float inertia[6],
                                const float centerOfMass[3])
{
    KIRI_CHANGES(world, KIRI_CALL_OBSTACLE_SET_MASS, &obstacle, &mass, inertia, centerOfMass);
    const char* why = FaultOfMass(mass, inertia, centerOfMass);
    KIRI_CHECK(why == NULL, why);
    KIRI_FIND_OBSTACLE(data, obstacle);
    SetMass(data, mass, inertia, centerOfMass);
    KIRI_RETURN(KIRI_OK);
}

/* ---- State ------------------------------------------------------------------------------------------------------- */

kiriResult kiriObstacle_GetState(const kiriWorld* world, kiriObstacle obstacle, kiriObstacleState* state)
{
    KIRI_READS(world);
    KIRI_CHECK(state != NULL, "state is null");
    KIRI_FIND_OBSTACLE(data, obstacle);
    kiriVec3_Store(state->position, data->position);
    kiriVec3_Store(&state->rotation[0], data->rotation.u);
    kiriVec3_Store(&state->rotation[3], data->rotation.v);
    kiriVec3_Store(&state->rotation[6], data->rotation.d);
    kiriVec3_Store(state->velocity, data->velocity);
    kiriVec3_Store(state->angularVelocity, data->spin);
    kiriVec3_StoreDoubles(state->impulse, data->impulse.force);
    kiriVec3_StoreDoubles(state->angularImpulse, data->impulse.moment);
    state->contacts = data->contacts;
    return KIRI_OK;
}

/* ---- Reach ------------------------------------------------------------------------------------------------------- */

kiriResult kiriSheet_GetReach(const kiriWorld* world, kiriSheet sheet, float dt, float lower[3], float upper[3])
{
    KIRI_READS(world);
    KIRI_CHECK(lower != NULL && upper != NULL, "lower or upper is null");
    KIRI_CHECK(kiriCall_IsAtLeast(dt, 1e-6f) && dt <= 10.0f, "dt is not within 1e-6 and 10 s");
    KIRI_FIND_SHEET(data, sheet);
    kiriBox box = kiriSheet_Box(data);
    double speed = kiriSheet_SpeedLimit(data, &box);
    double reach = kiriReach_Of(speed, world->gravity, dt) + data->settings.contactThickness;
    kiriVec3 margin = kiriVec3_Make(reach, reach, reach);
    kiriBounds_Ask(data->seen.bounds);
    kiriVec3_Store(lower, kiriVec3_Sub(box.lower, margin));
    kiriVec3_Store(upper, kiriVec3_Add(box.upper, margin));
    return KIRI_OK;
}

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
