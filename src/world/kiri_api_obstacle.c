#include "kiri_call.h"
#include "kiri_obstacle_step.h"

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
