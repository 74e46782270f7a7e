#include "kiri_call.h"
#include "../mesh/kiri_mesh.h"
#include "../sheet/kiri_obstacle.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

/* ---- Faults ------------------------------------------------------------------------------------------------------ */

bool kiriCall_AreFinite(const float* values, int64_t count)
{
    bool areFinite = true;
    for (int64_t i = 0; i < count; ++i) {
        areFinite = areFinite && isfinite(values[i]);
    }
    return areFinite;
}

static const char* FaultOfTriangles(const void* value)
{
    int32_t triangles = *(const int32_t*)value;
    return triangles == 0 || triangles >= KIRI_LEAST_TRIANGLES ? NULL : "is below KIRI_LEAST_TRIANGLES, and not 0";
}

static const char* FaultOfDirection(const void* value)
{
    const float* direction = value;
    return direction[0] != 0.0f || direction[1] != 0.0f || direction[2] != 0.0f ? NULL : "is zero";
}

static const char* FaultOfNormal(const void* value)
{
    return fabs(kiriVec3_Length(kiriVec3_Load(value)) - 1.0) <= 1e-3 ? NULL : "is not a unit vector";
}

static bool AreOrthonormal(kiriVec3 u, kiriVec3 v)
{
    return fabs(kiriVec3_Dot(u, u) - 1.0) < 1e-3 && fabs(kiriVec3_Dot(v, v) - 1.0) < 1e-3 &&
           fabs(kiriVec3_Dot(u, v)) < 1e-3;
}

static const char* FaultOfRotation(const void* value)
{
    const float* columns = value;
    kiriVec3 u = kiriVec3_Load(&columns[0]), v = kiriVec3_Load(&columns[3]), d = kiriVec3_Load(&columns[6]);
    if (!AreOrthonormal(u, v) || !AreOrthonormal(v, d) || !AreOrthonormal(d, u)) {
        return "is not orthonormal";
    }
    return kiriVec3_Dot(kiriVec3_Cross(u, v), d) > 0.0 ? NULL : "mirrors";
}

static const char* FaultOfInertia(const void* value)
{
    kiriMat3 inverse;
    return kiriObstacle_InvertInertia(value, &inverse) ? NULL
                                                       : "is not positive definite, but for axes that are all zero";
}

static const char* FaultOfSheetDef(const void* value)
{
    const kiriSheetDef* def = value;
    if (!AreOrthonormal(kiriVec3_Load(def->axisU), kiriVec3_Load(def->axisV))) {
        return "has an axisU and an axisV that are not orthonormal";
    }
    return def->frameCount == 0 && def->framePoints != NULL ? "has framePoints, and no frameCount" : NULL;
}

static kiriVec2 OutlineCorner(const kiriObstacleDef* def, int32_t i)
{
    KIRI_ASSERT(def->outline != NULL && def->outlineCount >= 3);
    i %= def->outlineCount;
    return kiriVec2_Load(&def->outline[2 * i]);
}

/* Tests that every corner lies to the left of every edge, but for rounding of floats, and that no edge is a point. */
static bool IsConvex(const kiriObstacleDef* def)
{
    KIRI_TIMES(i, def->outlineCount) {
        kiriVec2 a = OutlineCorner(def, i), along = kiriVec2_Sub(OutlineCorner(def, i + 1), a);
        double length = kiriVec2_Length(along), farthest = 0.0;
        KIRI_TIMES(k, def->outlineCount) {
            kiriVec2 way = kiriVec2_Sub(OutlineCorner(def, k), a);
            double left = kiriVec2_Cross(along, way);
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

#define LONGEST 1e6 /* m */

static const char* FaultOfObstacleDef(const void* value)
{
    const kiriObstacleDef* def = value;
    bool isPrism = def->type == KIRI_OBSTACLE_PRISM;
    if (def->type == KIRI_OBSTACLE_CYLINDER && def->height == 0.0f) {
        return "has a height of 0";
    }
    if (isPrism && (def->outline == NULL || def->outlineCount < 3)) {
        return "has no outline of 3 corners or more";
    }
    return isPrism && !IsConvex(def) ? "has an outline that is not a convex polygon, counter-clockwise" : NULL;
}

static const char* FaultOfSeamDef(const void* value)
{
    const kiriSeamDef* def = value;
    return def->lineA != NULL && def->lineB != NULL ? NULL : "has no lineA or no lineB";
}

static const char* FaultOfStitches(const void* value)
{
    return *(const int32_t*)value != 1 ? NULL : "is 1: a seam has two ends";
}

/* ---- Structs ----------------------------------------------------------------------------------------------------- */

/* Tables of members. All are listed but the cookie and functions of the host. */
#define MEMBER(member) .name = #member, .offset = (int32_t)offsetof(OF, member)
#define NUMBERS_IN(member) MEMBER(member), .count = (int32_t)sizeof(((OF*)NULL)->member) / 4
#define INTS_IN(member, ...)                                                                                           \
    {                                                                                                                  \
        .form = KIRI_FORM_INTS, NUMBERS_IN(member), __VA_ARGS__                                                        \
    }
#define FLOATS_IN(member, ...)                                                                                         \
    {                                                                                                                  \
        .form = KIRI_FORM_FLOATS, NUMBERS_IN(member), __VA_ARGS__                                                      \
    }
#define ARRAY_IN(form_, member, items, counted, ...)                                                                   \
    {                                                                                                                  \
        .form = form_, MEMBER(member), .count = items, .refers = (int32_t)offsetof(OF, counted), __VA_ARGS__           \
    }
#define STRUCT_IN(member, struct_)                                                                                     \
    {                                                                                                                  \
        .form = KIRI_FORM_STRUCT, MEMBER(member), .of = struct_                                                        \
    }
/* A table of the members of a struct, OF in them. */
#define STRUCT(Name, Type, cookie, filledBy, ...)                                                                      \
    const kiriStruct* Name(void)                                                                                       \
    {                                                                                                                  \
        typedef Type OF;                                                                                               \
        static const kiriValue members[] = __VA_ARGS__;                                                                \
        static const kiriStruct table = { (int32_t)sizeof(OF), cookie, filledBy,                                       \
                                          (int32_t)(sizeof(members) / sizeof(*members)), members };                    \
        return &table;                                                                                                 \
    }

#define WITHIN(low_, high_) .low = (low_), .high = (high_)
#define ANY_NUMBER WITHIN(1.0, 0.0)
#define ANY_FINITE WITHIN(-FLT_MAX, FLT_MAX)
#define FROM_0 WITHIN(0.0, FLT_MAX)
#define ABOVE_0 WITHIN(KIRI_ABOVE_0, FLT_MAX)
#define LENGTHS WITHIN(KIRI_ABOVE_0, LONGEST)
#define FITTING WITHIN(-0.125 * FLT_MAX, 0.125 * FLT_MAX)
#define COUNTING WITHIN(0, INT32_MAX)
#define YES_OR_NO WITHIN(0, 1)

static STRUCT(BudgetStruct, kiriBudget, 0, NULL, {
    INTS_IN(triangles, COUNTING, .fault = FaultOfTriangles),
    INTS_IN(cells, COUNTING),
    INTS_IN(samples, COUNTING),
    INTS_IN(iterations, COUNTING),
})

STRUCT(kiriWorldDefStruct, kiriWorldDef, KIRI_COOKIE(kiriWorldDef), "kiriDefaultWorldDef", {
    FLOATS_IN(gravity, ANY_FINITE),
    STRUCT_IN(budget, BudgetStruct),
    INTS_IN(workerCount, WITHIN(0, 1024)),
    INTS_IN(recordHashTicks, COUNTING),
})

static STRUCT(WindStruct, kiriWind, 0, NULL, {
    FLOATS_IN(velocity, ANY_FINITE),
    FLOATS_IN(density, FROM_0),
    FLOATS_IN(drag, FROM_0),
    FLOATS_IN(lift, FROM_0),
})

static STRUCT(TearingStruct, kiriTearing, 0, NULL, {
    FLOATS_IN(toughness, FROM_0),
    FLOATS_IN(strength, FROM_0),
    FLOATS_IN(grain, ANY_FINITE),
    FLOATS_IN(grainRatio, FROM_0),
    FLOATS_IN(maxSpeed, FROM_0),
    INTS_IN(maxTips, COUNTING),
})

static STRUCT(ContactStruct, kiriContact, 0, NULL, {
    INTS_IN(point, WITHIN(-1, INT32_MAX)),
    FLOATS_IN(restPoint, ANY_NUMBER), /* used if point is -1; kiriSheet_SetContacts checks it */
    FLOATS_IN(normal, ANY_FINITE, .fault = FaultOfNormal),
    FLOATS_IN(offset, ANY_FINITE),
    FLOATS_IN(velocity, ANY_FINITE),
    FLOATS_IN(friction, FROM_0),
    FLOATS_IN(inverseMass, FROM_0),
    FLOATS_IN(pushSpeed, FROM_0),
    INTS_IN(obstacle, ANY_NUMBER),
})

#define ID_KIND(kind_) .kind = #kind_, .refers = (int32_t)offsetof(kiriWorld, kind_##Ids)
#define ID_IN(member, kind_, ...)                                                                                      \
    {                                                                                                                  \
        .form = KIRI_FORM_ID, NUMBERS_IN(member), ID_KIND(kind_), __VA_ARGS__                                          \
    }
static STRUCT(PinDefStruct, kiriPinDef, KIRI_COOKIE(kiriPinDef), "kiriDefaultPinDef", {
    FLOATS_IN(restPoint, ANY_FINITE),
    FLOATS_IN(target, ANY_FINITE),
    FLOATS_IN(stiffness, FROM_0),
    FLOATS_IN(breakForce, FROM_0),
    ID_IN(obstacle, obstacle, .isOptional = true),
})

static STRUCT(SeamDefStruct, kiriSeamDef, KIRI_COOKIE(kiriSeamDef), "kiriDefaultSeamDef", {
    ID_IN(sheetA, sheet, .isOptional = false),
    ID_IN(sheetB, sheet, .isOptional = false),
    INTS_IN(countA, WITHIN(2, 65536)),
    INTS_IN(countB, WITHIN(2, 65536)),
    ARRAY_IN(KIRI_FORM_FLOATS_AT, lineA, 2, countA, ANY_FINITE),
    ARRAY_IN(KIRI_FORM_FLOATS_AT, lineB, 2, countB, ANY_FINITE),
    INTS_IN(stitches, WITHIN(0, 4096), .fault = FaultOfStitches),
    FLOATS_IN(stiffness, FROM_0),
    FLOATS_IN(restAngle, WITHIN(-KIRI_MOST_FOLD, KIRI_MOST_FOLD)),
    FLOATS_IN(breakForce, FROM_0),
})

static STRUCT(FoldStruct, kiriFold, 0, NULL, {
    FLOATS_IN(from, ANY_FINITE),
    FLOATS_IN(to, ANY_FINITE),
    FLOATS_IN(stiffness, FROM_0),
    FLOATS_IN(restAngle, WITHIN(-KIRI_MOST_FOLD, KIRI_MOST_FOLD)),
    FLOATS_IN(yieldMoment, FROM_0),
})

static STRUCT(MaterialStruct, kiriMaterial, 0, NULL, {
    FLOATS_IN(youngsModulus, ABOVE_0),
    FLOATS_IN(poissonsRatio, WITHIN(0.0, 0.49999997)), /* the last float below 0.5 */
    FLOATS_IN(thickness, ABOVE_0),
    FLOATS_IN(density, ABOVE_0),
    FLOATS_IN(airDamping, FROM_0),
    FLOATS_IN(flexDamping, FROM_0),
    FLOATS_IN(yieldStress, FROM_0),
    FLOATS_IN(hardening, WITHIN(0.0, 0.99999994)), /* the last float below 1 */
    FLOATS_IN(slack, WITHIN(0.0, 0.99999994)),
    INTS_IN(detail, WITHIN(0, KIRI_MOST_DETAIL)),
    FLOATS_IN(restCurvature, WITHIN(-1e6, 1e6)),
})

/* Members of both kiriSheetSettings and kiriSheetDef. */
#define SETTINGS_MEMBERS                                                                                               \
    STRUCT_IN(material, MaterialStruct), INTS_IN(maxFrames, WITHIN(1, INT32_MAX)), FLOATS_IN(crumbArea, FROM_0),       \
        FLOATS_IN(friction, FROM_0), FLOATS_IN(contactThickness, FROM_0), INTS_IN(groups, ANY_NUMBER),                 \
        INTS_IN(touchesSheets, YES_OR_NO), INTS_IN(selfContact, YES_OR_NO), INTS_IN(iterations, WITHIN(1, 64)),        \
        FLOATS_IN(sleepSpeed, FROM_0),                                                                                 \
        INTS_IN(skinning, WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH)),                                         \
        INTS_IN(timeStepping, WITHIN(KIRI_TIME_STEPPING_SECOND_ORDER, KIRI_TIME_STEPPING_EULER)),                      \
        FLOATS_IN(fadeTime, FROM_0), INTS_IN(normals, YES_OR_NO)

STRUCT(kiriSettingsStruct, kiriSheetSettings, KIRI_COOKIE(kiriSheetSettings), "kiriSheet_GetSettings", {
    SETTINGS_MEMBERS,
})

static STRUCT(PaperStruct, kiriPaperOptions, 0, NULL, {
    INTS_IN(fromScratch, YES_OR_NO),
    INTS_IN(popping, YES_OR_NO),
    INTS_IN(linearWeights, YES_OR_NO),
    INTS_IN(integrationPoints, WITHIN(0, 1 << 20)),
    INTS_IN(integrationOrder, WITHIN(1, 2)),
})

static STRUCT(SheetDefStruct, kiriSheetDef, KIRI_COOKIE(kiriSheetDef), "kiriDefaultSheetDef", {
    INTS_IN(vertexCount, WITHIN(3, INT32_MAX)), /* counts before arrays */
    INTS_IN(triangleCount, WITHIN(1, KIRI_MOST_TRIANGLES)),
    INTS_IN(frameCount, WITHIN(0, 65536)),
    ARRAY_IN(KIRI_FORM_FLOATS_AT, restPositions, 2, vertexCount, ANY_FINITE),
    ARRAY_IN(KIRI_FORM_INDICES_AT, indices, 3, triangleCount, ANY_NUMBER),
    ARRAY_IN(KIRI_FORM_FLOATS_AT, framePoints, 2, frameCount, ANY_FINITE),
    FLOATS_IN(position, ANY_FINITE),
    FLOATS_IN(axisU, ANY_FINITE),
    FLOATS_IN(axisV, ANY_FINITE),
    FLOATS_IN(velocity, ANY_FINITE),
    INTS_IN(gridResolution, WITHIN(1, 4096)),
    FLOATS_IN(snapDistance, FROM_0),
    FLOATS_IN(weldDistance, FROM_0),
    FLOATS_IN(frameLength, FROM_0),
    FLOATS_IN(accuracy, WITHIN(1e-4f, 1.0)),
    FLOATS_IN(rigidWeight, ABOVE_0),
    FLOATS_IN(rigidArea, FROM_0),
    INTS_IN(collisionPoints, WITHIN(0, 1 << 20)),
    INTS_IN(model, WITHIN(KIRI_MODEL_LINKS, KIRI_MODEL_POINTS)),
    INTS_IN(planar, YES_OR_NO),
    STRUCT_IN(paper, PaperStruct),
    SETTINGS_MEMBERS,
})

static STRUCT(ObstacleDefStruct, kiriObstacleDef, KIRI_COOKIE(kiriObstacleDef), "kiriDefaultObstacleDef", {
    INTS_IN(type, WITHIN(KIRI_OBSTACLE_PLANE, KIRI_OBSTACLE_PRISM)),
    FLOATS_IN(size, LENGTHS, .types = 1 << KIRI_OBSTACLE_BOX),
    FLOATS_IN(radius, LENGTHS,
              .types = 1 << KIRI_OBSTACLE_SPHERE | 1 << KIRI_OBSTACLE_CAPSULE | 1 << KIRI_OBSTACLE_CYLINDER),
    FLOATS_IN(height, WITHIN(0.0, LONGEST),
              .types = 1 << KIRI_OBSTACLE_CAPSULE | 1 << KIRI_OBSTACLE_CYLINDER | 1 << KIRI_OBSTACLE_PRISM),
    INTS_IN(outlineCount, WITHIN(0, 64)),
    ARRAY_IN(KIRI_FORM_FLOATS_AT, outline, 2, outlineCount, WITHIN(-LONGEST, LONGEST)),
    FLOATS_IN(rounding, WITHIN(0.0, LONGEST)),
    FLOATS_IN(position, FITTING),
    FLOATS_IN(rotation, ANY_FINITE, .fault = FaultOfRotation),
    FLOATS_IN(velocity, FITTING),
    FLOATS_IN(angularVelocity, FITTING),
    FLOATS_IN(surfaceVelocity, FITTING),
    FLOATS_IN(friction, FROM_0),
    FLOATS_IN(mass, FROM_0),
    FLOATS_IN(inertia, ANY_FINITE, .fault = FaultOfInertia),
    FLOATS_IN(centerOfMass, ANY_FINITE),
    INTS_IN(body, ANY_NUMBER),
    FLOATS_IN(pushSpeed, ABOVE_0),
    INTS_IN(groups, ANY_NUMBER),
})

/* ---- Arguments --------------------------------------------------------------------------------------------------- */

#define ID_OF(kind, optional)                                                                                          \
    {                                                                                                                  \
        .form = KIRI_FORM_ID, ID_KIND(kind), .isOptional = optional                                                    \
    }
#define FLOATS_OF(count_, ...)                                                                                         \
    {                                                                                                                  \
        .form = KIRI_FORM_FLOATS, .count = count_, __VA_ARGS__                                                         \
    }
#define STRUCT_ARGUMENT(struct_, ...)                                                                                  \
    {                                                                                                                  \
        .form = KIRI_FORM_STRUCT, .of = struct_, __VA_ARGS__                                                           \
    }
#define ARRAY_ARGUMENT(item_, ...)                                                                                     \
    {                                                                                                                  \
        .form = KIRI_FORM_ARRAY, .item = &item_, __VA_ARGS__                                                           \
    }

static const kiriValue byteItem = { .form = KIRI_FORM_BYTE }, contactItem = STRUCT_ARGUMENT(ContactStruct, .count = 1),
                       foldItem = STRUCT_ARGUMENT(FoldStruct, .count = 1);

#define FORM(...)                                                                                                      \
    {                                                                                                                  \
        .form = __VA_ARGS__                                                                                            \
    }
#define VALUE_OF(Name, Type, ...) [KIRI_ARGUMENT_##Name] = __VA_ARGS__,
#define POINTER_OF(Name, ...) VALUE_OF(Name, , __VA_ARGS__)
const kiriValue kiriArguments[KIRI_ARGUMENT_KINDS] = { KIRI_ARGUMENTS(VALUE_OF, POINTER_OF, POINTER_OF) };

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* How MAKE passes an argument to the function. */
#define PASS_VALUE(Name, Type, ...)                                                                                    \
    static inline Type Pass_##Name(const void* at)                                                                     \
    {                                                                                                                  \
        return *(const Type*)at;                                                                                       \
    }
#define PASS_POINTER(Name, ...)                                                                                        \
    static inline const void* Pass_##Name(const void* at)                                                              \
    {                                                                                                                  \
        return at;                                                                                                     \
    }
#define PASS_RESULT(Name, ...)                                                                                         \
    static inline void* Pass_##Name(const void* at)                                                                    \
    {                                                                                                                  \
        return (void*)at;                                                                                              \
    }
KIRI_ARGUMENTS(PASS_VALUE, PASS_POINTER, PASS_RESULT)

#define MAKE(Name, ...)                                                                                                \
    static kiriResult Make##Name(kiriWorld* world, const void* const* at)                                              \
    {                                                                                                                  \
        (void)at;                                                                                                      \
        return kiri##Name(world __VA_ARGS__);                                                                          \
    }
#define MAKE0(Name) MAKE(Name, )
#define MAKE1(Name, A) MAKE(Name, , Pass_##A(at[0]))
#define MAKE2(Name, A, B) MAKE(Name, , Pass_##A(at[0]), Pass_##B(at[1]))
#define MAKE3(Name, A, B, C) MAKE(Name, , Pass_##A(at[0]), Pass_##B(at[1]), Pass_##C(at[2]))
#define MAKE4(Name, A, B, C, D) MAKE(Name, , Pass_##A(at[0]), Pass_##B(at[1]), Pass_##C(at[2]), Pass_##D(at[3]))
KIRI_CALLS(MAKE0, MAKE1, MAKE2, MAKE3, MAKE4)

/* Sets gravity and budget of the world of a replay, which exists already. */
static kiriResult MakeCreateWorld(kiriWorld* world, const void* const* at)
{
    float gravity[3];
    kiriVec3_Store(gravity, world->gravity);
    kiriResult result = memcmp(gravity, at[0], sizeof(gravity)) != 0 ? kiriWorld_SetGravity(world, at[0]) : KIRI_OK;
    bool isSame = memcmp(&world->budget, at[1], sizeof(kiriBudget)) == 0;
    return result != KIRI_OK || isSame ? result : kiriWorld_SetBudget(world, at[1]);
}

/* The world stays for the host to look at. */
static kiriResult MakeDestroyWorld(kiriWorld* world, const void* const* at)
{
    (void)world;
    (void)at;
    return KIRI_OK;
}

#define ROW(Name, ...) [KIRI_CALL_##Name] = { "kiri" #Name, Make##Name, { __VA_ARGS__ } },
#define ROW0(Name) ROW(Name, KIRI_ARGUMENT_NONE)
#define ROW1(Name, A) ROW(Name, KIRI_ARGUMENT_##A)
#define ROW2(Name, A, B) ROW(Name, KIRI_ARGUMENT_##A, KIRI_ARGUMENT_##B)
#define ROW3(Name, A, B, C) ROW(Name, KIRI_ARGUMENT_##A, KIRI_ARGUMENT_##B, KIRI_ARGUMENT_##C)
#define ROW4(Name, A, B, C, D) ROW(Name, KIRI_ARGUMENT_##A, KIRI_ARGUMENT_##B, KIRI_ARGUMENT_##C, KIRI_ARGUMENT_##D)

const kiriCallRow kiriCallRows[KIRI_CALL_COUNT] = {
    ROW2(CreateWorld, VECTOR, BUDGET) ROW0(DestroyWorld) KIRI_CALLS(ROW0, ROW1, ROW2, ROW3, ROW4)
};

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

enum { NUMBER_BYTES = 48 };

/* Writes a number with up to four decimals. snprintf of the web build has no %g. */
static const char* WriteNumber(char text[NUMBER_BYTES], double number)
{
    double size = fabs(number);
    const char* sign = number < 0.0 ? "-" : "";
    char decimals[8] = "", power[24] = "";
    int32_t exponent = 0;
    if (!(size <= DBL_MAX)) {
        snprintf(text, NUMBER_BYTES, "%s%s", sign, isnan(number) ? "NaN" : "infinity");
        return text;
    }
    bool isLarge = size >= 1e10, isSmall = size > 0.0 && size < 1e-4;
    for (; isLarge && size >= 10.0; ++exponent) {
        size /= 10.0;
    }
    for (; isSmall && size < 0.9999; --exponent) {
        size *= 10.0;
    }
    if (exponent != 0) {
        snprintf(power, sizeof(power), "e%lld", (long long)exponent);
    }
    long long parts = (long long)(size * 1e4 + 0.5), rest = parts % 10000;
    for (int i = 0; rest > 0; ++i, rest = rest % 1000 * 10) {
        decimals[0] = '.';
        decimals[i + 1] = (char)('0' + rest / 1000);
    }
    snprintf(text, NUMBER_BYTES, "%s%lld%s%s", sign, parts / 10000, decimals, power);
    return text;
}

static void Prepend(kiriFault* fault, const char* text, size_t length)
{
    size_t last = sizeof(fault->line) - 1;
    KIRI_ASSERT(strlen(fault->line) <= last);
    length = kiriMin(length, last);
    memmove(fault->line + length, fault->line, last - length);
    memcpy(fault->line, text, length);
    fault->line[last] = '\0';
}

/* The checks write lines that go on behind the name of the value: " is null", "[2] is NaN, not finite", or for a member
   of a struct ".friction is -1, not 0 or more". */

static void SayOutside(kiriFault* fault, const char* name, double number, double low, double high)
{
    char is[NUMBER_BYTES], least[NUMBER_BYTES], most[NUMBER_BYTES];
    bool isAbove0 = low == KIRI_ABOVE_0;
    WriteNumber(is, number);
    WriteNumber(least, low);
    WriteNumber(most, high);
    if (high < low) {
        KIRI_SAY(fault, "%s is %s, and there is none", name, is);
    } else if (high >= (double)FLT_MAX) {
        KIRI_SAY(fault, "%s is %s, not %s%s", name, is, low < 0.0 ? "finite" : isAbove0 ? "above 0" : least,
                 low < 0.0 || isAbove0 ? "" : " or more");
    } else {
        KIRI_SAY(fault, "%s is %s, not %s%s and %s%s", name, is, isAbove0 ? "above 0" : "within ",
                 isAbove0 ? "" : least, isAbove0 ? "up to " : "", most);
    }
}

kiriResult kiriCall_RefuseNumber(const kiriWorld* world, kiriCall* call, const char* function, const char* name,
                                 double number, double low, double high)
{
    kiriFault fault;
    SayOutside(&fault, name, number, low, high);
    return kiriCall_End(world, call, function, KIRI_ERROR_ARGUMENT, fault.line);
}

kiriResult kiriCall_RefuseId(const kiriWorld* world, kiriCall* call, const char* function, const char* kind,
                             uint32_t id)
{
    kiriFault fault;
    KIRI_SAY(&fault, "%s is %lld: there is no %s with this id", kind, (long long)id, kind);
    return kiriCall_End(world, call, function, KIRI_ERROR_ID, fault.line);
}

kiriResult kiriCall_RefusePoint(const kiriWorld* world, kiriCall* call, const char* function, const float restPoint[2])
{
    kiriFault fault;
    char x[NUMBER_BYTES], y[NUMBER_BYTES];
    KIRI_SAY(&fault, "restPoint (%s, %s) lies outside the material", WriteNumber(x, restPoint[0]),
             WriteNumber(y, restPoint[1]));
    return kiriCall_End(world, call, function, KIRI_ERROR_ARGUMENT, fault.line);
}

static kiriResult CheckNumbers(const kiriValue* value, const void* at, int64_t count, kiriFault* fault)
{
    bool areFloats = value->form == KIRI_FORM_FLOATS || value->form == KIRI_FORM_FLOATS_AT;
    double number = 0.0;
    int64_t i = 0;
    KIRI_ASSERT(at != NULL || count == 0);
    for (bool isFine = value->low <= value->high; isFine && i < count; i += isFine) {
        number = areFloats ? (double)((const float*)at)[i] : (double)((const int32_t*)at)[i];
        isFine = number >= value->low && number <= value->high;
    }
    if (value->low > value->high || i == count) {
        return KIRI_OK;
    }
    char index[NUMBER_BYTES] = "";
    if (count > 1) {
        snprintf(index, sizeof(index), "[%lld]", (long long)i);
    }
    SayOutside(fault, index, number, value->low, value->high);
    return KIRI_ERROR_ARGUMENT;
}

static const kiriSlot* FindById(const kiriValue* value, const kiriWorld* world, const void* id)
{
    KIRI_ASSERT(value->form == KIRI_FORM_ID && world != NULL);
    return kiriPool_Find((const kiriPool*)(const void*)((const char*)world + value->refers), *(const uint32_t*)id);
}

static kiriResult CheckValue(const kiriValue* value, const kiriWorld* world, const void* at, kiriFault* fault)
{
    kiriResult result = KIRI_OK;
    if (at == NULL) {
        KIRI_SAY(fault, " is null");
        return value->isOptional ? KIRI_OK : KIRI_ERROR_ARGUMENT;
    }
    if (value->form == KIRI_FORM_INTS || value->form == KIRI_FORM_FLOATS) {
        result = CheckNumbers(value, at, value->count, fault);
    } else if (value->form == KIRI_FORM_STRUCT && value->of()->cookie != 0 &&
               *(const uint32_t*)at != value->of()->cookie) {
        KIRI_SAY(fault, " was not filled by %s", value->of()->filledBy);
        result = KIRI_ERROR_DEF;
    } else if (value->form == KIRI_FORM_STRUCT) {
        result = kiriStruct_Check(value->of(), "", world, at, fault);
    } else if (value->form == KIRI_FORM_ID && !(value->isOptional && *(const uint32_t*)at == 0) &&
               FindById(value, world, at) == NULL) {
        KIRI_SAY(fault, " is %lld: there is no %s with this id", (long long)*(const uint32_t*)at, value->kind);
        result = KIRI_ERROR_ID;
    }
    const char* why = result == KIRI_OK && value->fault != NULL ? value->fault(at) : NULL;
    if (why != NULL) {
        KIRI_SAY(fault, " %s", why);
        result = KIRI_ERROR_ARGUMENT;
    }
    return result;
}

kiriResult kiriStruct_Check(const kiriStruct* of, const char* name, const kiriWorld* world, const void* at,
                            kiriFault* fault)
{
    KIRI_EACH_INDEX(i, *of) {
        const kiriValue* member = &of->members[i];
        const char* place = (const char*)at + member->offset;
        kiriResult result = KIRI_OK;
        KIRI_ASSERT(member->offset >= 0 && member->offset < of->bytes);
        if (member->types != 0 && (member->types >> ((const kiriObstacleDef*)at)->type & 1) == 0) {
            continue;
        }
        if (member->form >= KIRI_FORM_FLOATS_AT) {
            const void* array;
            int32_t count;
            memcpy(&array, place, sizeof(array));
            memcpy(&count, (const char*)at + member->refers, sizeof(count));
            result = array != NULL ? CheckNumbers(member, array, (int64_t)member->count * count, fault) : KIRI_OK;
        } else {
            result = CheckValue(member, world, place, fault);
        }
        if (result != KIRI_OK) {
            Prepend(fault, member->name, strlen(member->name));
            Prepend(fault, ".", 1);
            Prepend(fault, name, strlen(name));
            return result;
        }
    }
    return KIRI_OK;
}

/* ---- Calls ------------------------------------------------------------------------------------------------------- */

/* Checks the items of an array, and before them the count, which is the next argument. */
static kiriResult CheckArray(const kiriValue* value, const kiriWorld* world, const void* const at[2], kiriFault* fault)
{
    const kiriValue* item = value->item;
    int32_t count = *(const int32_t*)at[1];
    KIRI_ASSERT(value->form == KIRI_FORM_ARRAY && item != NULL);
    kiriResult result = CheckNumbers(value, &count, 1, fault);
    if (result != KIRI_OK) {
        Prepend(fault, ": count", strlen(": count"));
    } else if (count != 0 && (at[0] == NULL || item->form == KIRI_FORM_BYTE)) {
        result = CheckValue(item, world, at[0], fault);
    } else if (item->form == KIRI_FORM_FLOATS) {
        result = CheckNumbers(item, at[0], (int64_t)item->count * count, fault);
    } else {
        int32_t bytes = item->of != NULL ? item->of()->bytes : (int32_t)sizeof(uint32_t);
        for (int64_t k = 0; result == KIRI_OK && k < count; ++k) {
            result = CheckValue(item, world, (const char*)at[0] + k * bytes, fault);
            if (result != KIRI_OK) {
                char index[NUMBER_BYTES];
                Prepend(fault, index, (size_t)snprintf(index, sizeof(index), "[%lld]", (long long)k));
            }
        }
    }
    return result;
}

/* Checks argument i; a fault names it as the call lists it, as in "&sheet, velocity". */
static kiriResult CheckArgument(const kiriCall* call, int i, kiriFault* fault)
{
    const kiriValue* value = &kiriArguments[kiriCallRows[call->number].kinds[i]];
    const void* const* at = &call->arguments[i];
    kiriResult result = KIRI_OK;
    KIRI_ASSERT(i < KIRI_CALL_ARGUMENTS && kiriCallRows[call->number].kinds[i] < KIRI_ARGUMENT_KINDS);
    if (value->form == KIRI_FORM_ARRAY) {
        result = CheckArray(value, call->world, at, fault);
    } else if (value->form != KIRI_FORM_NEWS || *(const int32_t*)at[-1] > 0) {
        result = CheckValue(value, call->world, at[0], fault);
    }
    if (result != KIRI_OK) {
        const char* from = call->names;
        for (; i > 0; ++from) {
            i -= *from == ',';
        }
        from += strspn(from, " &");
        Prepend(fault, from, strcspn(from, ","));
    }
    return result;
}

bool kiriCall_Begin(kiriCall* call)
{
    static const uint8_t none[KIRI_CALL_ARGUMENTS] = { KIRI_ARGUMENT_NONE };
    kiriWorld* world = call->world;
    kiriFault fault;
    const uint8_t* kinds = call->number == KIRI_NONE ? none : kiriCallRows[call->number].kinds;
    KIRI_ASSERT(call->number >= KIRI_NONE && call->number < KIRI_CALL_COUNT);
    for (int i = 0; i < KIRI_CALL_ARGUMENTS && kinds[i] != KIRI_ARGUMENT_NONE; ++i) { /* failed calls return ids of 0 */
        kiriForm form = kiriArguments[kinds[i]].form;
        const void* const* at = &call->arguments[i];
        int32_t count = form == KIRI_FORM_NEW ? 1 : form == KIRI_FORM_NEWS ? *(const int32_t*)at[-1] : 0;
        if (count > 0 && at[0] != NULL) {
            memset((void*)at[0], 0, (size_t)count * sizeof(uint32_t));
        }
    }
    if (world == NULL || world->isBusy || kiriCall_IsRead(world)) {
        call->result = world == NULL ? KIRI_ERROR_ARGUMENT : kiriCall_Refuse(world, call->function);
        return false;
    }
    world->isBusy = true;
    world->errorLine[0] = '\0';
    if (call->number == KIRI_NONE) {
        return true;
    }
    KIRI_ASSERT(!world->recorder.isOpen);
    for (int i = 0; i < KIRI_CALL_ARGUMENTS && kinds[i] != KIRI_ARGUMENT_NONE && call->result == KIRI_OK; ++i) {
        call->result = CheckArgument(call, i, &fault);
    }
    if (call->result == KIRI_OK && kiriArguments[kinds[0]].form == KIRI_FORM_ID) {
        const kiriSlot* slot = FindById(&kiriArguments[kinds[0]], world, call->arguments[0]);
        bool isSheet =
            kinds[0] == KIRI_ARGUMENT_SHEET || kinds[0] == KIRI_ARGUMENT_FRAME || kinds[0] == KIRI_ARGUMENT_PIN;
        call->owner = slot != NULL ? slot->owner : NULL;
        call->index = slot != NULL ? slot->index : KIRI_NONE;
        call->sheet = isSheet ? call->owner : NULL;
        KIRI_ASSERT(call->owner != NULL || kinds[0] == KIRI_ARGUMENT_ANY_SHEET);
    }
    if (call->result != KIRI_OK) {
        kiriCall_End(world, call, call->function, call->result, fault.line);
        return false;
    }
    if (world->recorder.write != NULL) {
        kiriRecord_Begin(call);
    }
    return true;
}

void kiriWorld_Log(const kiriWorld* world, const char* line)
{
    if (world->log != NULL) {
        kiriWord_Add(&world->logs, 1);
        world->log(world->user, line);
        kiriWord_Add(&world->logs, -1);
    }
}

static void Log(const kiriWorld* world, char* line, kiriResult result, const char* function, const char* why)
{
    bool hasReason = why != NULL && why[0] != '\0';
    snprintf(line, sizeof(world->errorLine), "%s: %s (%s)", function, hasReason ? why : kiriGetResultText(result),
             kiriGetResultName(result));
    kiriWorld_Log(world, line);
}

kiriResult kiriCall_End(const kiriWorld* world, kiriCall* call, const char* function, kiriResult result,
                        const char* why)
{
    char line[sizeof(world->errorLine)];
    KIRI_ASSERT(result >= KIRI_ERROR_REPLAY && result <= KIRI_PENDING);
    KIRI_ASSERT(call == NULL || (call->world == world && call->world->isBusy));
    if (result < 0) {
        Log(world, call != NULL ? call->world->errorLine : line, result, call != NULL ? call->function : function, why);
    }
    if (call != NULL && world->recorder.isOpen) {
        kiriRecord_End(call, result);
    }
    if (call != NULL) {
        call->world->isBusy = false;
    }
    return result;
}

/* A log that calls gets no line for it: that would be another call of the log. */
kiriResult kiriCall_Refuse(const kiriWorld* world, const char* function)
{
    char line[sizeof(world->errorLine)];
    if (kiriWord_Read(&world->logs) == 0) {
        Log(world, line, KIRI_ERROR_STATE, function, "called by a callback of this world");
    }
    return KIRI_ERROR_STATE;
}
