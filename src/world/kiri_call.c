#include "kiri_call.h"
#include "kiri_state.h"
#include "../mesh/kiri_mesh.h"

#include <string.h>
#include <math.h>
#include <stdio.h>

const uint8_t kiriRecordMagic[KIRI_RECORD_MAGIC_BYTES] = { 'K', 'i', 'r', 'i', 'R', 'e', 'c', '\n' };

/* ---- Structs ----------------------------------------------------------------------------------------------------- */

static void CodeNumbers(kiriCoder* coder, const kiriRecordField* field, char* at)
{
    for (int32_t i = 0; i < field->count; ++i) {
        if (field->kind == KIRI_FIELD_FLOATS) {
            kiriCoder_Float(coder, (float*)(void*)at + i);
        } else if (field->kind == KIRI_FIELD_INTS) {
            kiriCoder_Int(coder, (int32_t*)(void*)at + i);
        } else {
            kiriCoder_Id(coder, (uint32_t*)(void*)at + i);
        }
    }
}

static void CodeFloats(kiriCoder* coder, float* values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        kiriCoder_Float(coder, &values[i]);
    }
}

/* Floats take 4 bytes, indices at least one. */
static void CodeArray(kiriCoder* coder, const kiriRecordField* field, char* def, void** array)
{
    int32_t counted;
    memcpy(&counted, def + field->counted, sizeof(counted));
    int64_t count = (int64_t)field->count * counted;
    bool isFloats = field->kind == KIRI_FIELD_FLOATS_AT;
    if (kiriCoder_Reads(coder)) {
        *array = kiriCoder_Alloc(coder, count, 4, isFloats ? 4 : 1);
    }
    if (*array != NULL && isFloats) {
        CodeFloats(coder, *array, count);
    } else if (*array != NULL) {
        kiriCoder_Indices(coder, *array, count);
    }
}

/* 0: null. 1: it follows. 2: its call refuses the def without a look at it. */
static void CodePointer(kiriCoder* coder, const kiriRecordField* field, char* def)
{
    void* array;
    memcpy(&array, def + field->offset, sizeof(array));
    bool isRead = field->isRead(def);
    uint8_t how = array == NULL ? 0 : isRead ? 1 : 2;
    kiriCoder_Byte(coder, &how);
    if (how > 2 || (how > 0 && isRead != (how == 1))) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
        how = 0;
    }
    if (kiriCoder_Reads(coder)) {
        array = how == 2 ? def : NULL;
    }
    if (how == 1) {
        CodeArray(coder, field, def, &array);
    }
    if (kiriCoder_Reads(coder)) {
        memcpy(def + field->offset, &array, sizeof(array));
    }
}

/* How many fields there are; 0: its cookie is not that of the struct, so nobody knows what it is. */
static void CodeStruct(kiriCoder* coder, const kiriRecordStruct* of, void* def)
{
    uint32_t cookie = of->cookie;
    if (!kiriCoder_Reads(coder) && cookie != 0) {
        memcpy(&cookie, def, sizeof(cookie));
    }
    uint64_t count = cookie == of->cookie ? (uint64_t)of->fieldCount : 0;
    kiriCoder_Unsigned(coder, &count);
    if (count > (uint64_t)of->fieldCount) {
        kiriCoder_Stop(coder, KIRI_CODER_NEWER);
        count = 0;
    }
    if (kiriCoder_Reads(coder) && count > 0 && of->fill != NULL) {
        of->fill(def);
    }
    for (uint64_t i = 0; i < count; ++i) {
        const kiriRecordField* field = &of->fields[i];
        if (field->kind >= KIRI_FIELD_FLOATS_AT) {
            CodePointer(coder, field, def);
        } else {
            CodeNumbers(coder, field, (char*)def + field->offset);
        }
    }
}

/* ---- Arguments --------------------------------------------------------------------------------------------------- */

static bool IsPointer(kiriArgumentKind kind)
{
    return kind >= KIRI_ARGUMENT_FLOATS && kind != KIRI_ARGUMENT_HASH;
}

static bool IsArray(kiriArgumentKind kind)
{
    return kind >= KIRI_ARGUMENT_POINTS && kind <= KIRI_ARGUMENT_BYTES;
}

uint64_t kiriRecord_FindNulls(const kiriRecordCall* call, const void* const arguments[])
{
    uint64_t nulls = 0;
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS && call->arguments[i].kind != KIRI_ARGUMENT_NONE; ++i) {
        nulls |= (uint64_t)(IsPointer(call->arguments[i].kind) && arguments[i] == NULL) << i;
    }
    return nulls;
}

static void CodeItems(kiriCoder* coder, const kiriRecordArgument* argument, void* items, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        switch (argument->kind) {
        case KIRI_ARGUMENT_POINTS:
            CodeFloats(coder, (float*)items + 2 * (int64_t)i, 2);
            break;
        case KIRI_ARGUMENT_IDS:
            kiriCoder_Id(coder, (uint32_t*)items + i);
            break;
        case KIRI_ARGUMENT_STRUCTS:
            CodeStruct(coder, argument->of, (char*)items + (int64_t)i * argument->of->bytes);
            break;
        default:
            kiriCoder_Byte(coder, (uint8_t*)items + i);
            break;
        }
    }
}

static int64_t BytesOfItem(const kiriRecordArgument* argument)
{
    switch (argument->kind) {
    case KIRI_ARGUMENT_POINTS:
        return 2 * sizeof(float);
    case KIRI_ARGUMENT_STRUCTS:
        return argument->of->bytes;
    default:
        return argument->kind == KIRI_ARGUMENT_BYTES ? 1 : sizeof(uint32_t);
    }
}

/* Its count, and then the items, where the call reads them: else its pointer may point to anything. */
static const void* CodeCounted(kiriCoder* coder, const kiriRecordArgument* argument, const void* items, int32_t* count,
                               bool isNull)
{
    kiriCoder_Int(coder, count);
    if (isNull || *count < 1 || *count > argument->most) {
        return isNull ? NULL : count;
    }
    void* there = kiriCoder_Reads(coder) ? kiriCoder_Alloc(coder, *count, BytesOfItem(argument), 1) : (void*)items;
    if (there != NULL) {
        CodeItems(coder, argument, there, *count);
    }
    return there;
}

/* As many ids as the array before its count has; without one the call refuses either null. */
static void* RoomForIds(kiriCoder* coder, const void* array, kiriRecordValue* value)
{
    int32_t count = value[-1].number;
    return count < 1 ? value : array == NULL ? NULL : kiriMemory_AllocZeroed(coder->memory, 4 * (int64_t)count);
}

/* An argument of a coder that reads points to its value, or to memory. */
static const void* RoomForArgument(kiriCoder* coder, const kiriRecordArgument* argument, kiriRecordValue* value)
{
    void* place =
        argument->kind == KIRI_ARGUMENT_STRUCT ? kiriMemory_AllocZeroed(coder->memory, argument->of->bytes) : value;
    if (place == NULL) {
        kiriCoder_Stop(coder, KIRI_CODER_MEMORY);
    }
    return place;
}

static void CodeSingle(kiriCoder* coder, const kiriRecordArgument* argument, void* at)
{
    switch (argument->kind) {
    case KIRI_ARGUMENT_ID:
        kiriCoder_Id(coder, at);
        break;
    case KIRI_ARGUMENT_INT:
        kiriCoder_Int(coder, at);
        break;
    case KIRI_ARGUMENT_FLOAT:
        kiriCoder_Float(coder, at);
        break;
    case KIRI_ARGUMENT_DATA:
        kiriCoder_Unsigned(coder, at);
        break;
    case KIRI_ARGUMENT_FLOATS:
        CodeFloats(coder, at, argument->count);
        break;
    case KIRI_ARGUMENT_STRUCT:
        CodeStruct(coder, argument->of, at);
        break;
    default: /* counts are written with their arrays, what the call writes with its result */
        break;
    }
}

void kiriRecord_CodeArguments(kiriCoder* coder, const kiriRecordCall* call, const void* arguments[],
                              kiriRecordValue values[], uint64_t nulls)
{
    bool reads = kiriCoder_Reads(coder);
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS && call->arguments[i].kind != KIRI_ARGUMENT_NONE; ++i) {
        const kiriRecordArgument* argument = &call->arguments[i];
        bool isNull = (nulls >> i & 1) != 0 && IsPointer(argument->kind);
        if (IsArray(argument->kind)) {
            int32_t* count = reads ? &values[i + 1].number : (int32_t*)arguments[i + 1];
            arguments[i] = CodeCounted(coder, argument, arguments[i], count, isNull);
            continue;
        }
        if (reads && argument->kind == KIRI_ARGUMENT_NEW_IDS) {
            arguments[i] = isNull ? NULL : RoomForIds(coder, arguments[i - 2], &values[i]);
        } else if (reads) {
            arguments[i] = isNull ? NULL : RoomForArgument(coder, argument, &values[i]);
        }
        if (arguments[i] != NULL) {
            CodeSingle(coder, argument, (void*)arguments[i]);
        }
    }
}

/* ---- Outcome ----------------------------------------------------------------------------------------------------- */

static void CodeHash(kiriCoder* coder, kiriRecordHash* hash)
{
    kiriCoder_Int(coder, &hash->isThere);
    if (hash->isThere != 0) {
        kiriCoder_Hash(coder, &hash->hash);
    }
}

static void CodeNew(kiriCoder* coder, const kiriRecordArgument* argument, const void* const arguments[], int i)
{
    void* at = (void*)arguments[i];
    if (argument->kind == KIRI_ARGUMENT_NEW_ID) {
        kiriCoder_Id(coder, at);
    } else if (argument->kind == KIRI_ARGUMENT_NEW_INT) {
        kiriCoder_Int(coder, at);
    } else if (argument->kind == KIRI_ARGUMENT_NEW_IDS) {
        for (int32_t k = 0; k < *(const int32_t*)arguments[i - 1]; ++k) {
            kiriCoder_Id(coder, (uint32_t*)at + k);
        }
    }
}

void kiriRecord_CodeOutcome(kiriCoder* coder, const kiriRecordCall* call, const void* const arguments[],
                            kiriResult* result)
{
    kiriCoder_Int(coder, result);
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS && call->arguments[i].kind != KIRI_ARGUMENT_NONE; ++i) {
        if (call->arguments[i].kind == KIRI_ARGUMENT_HASH) {
            CodeHash(coder, (kiriRecordHash*)arguments[i]);
        } else if (*result >= 0 && arguments[i] != NULL) {
            CodeNew(coder, &call->arguments[i], arguments, i);
        }
    }
}

/* ---- Recording --------------------------------------------------------------------------------------------------- */

static kiriCoder CoderOf(kiriWorld* world)
{
    kiriCoder coder = { &world->recorder.sink, NULL, NULL, NULL, KIRI_CODER_FINE };
    return coder;
}

const kiriCall* kiriRecord_Begin(const kiriCall* call)
{
    kiriCoder coder = CoderOf(call->world);
    KIRI_ASSERT(!call->world->recorder.isOpen);
    call->world->recorder.isOpen = true;
    const kiriRecordCall* shape = kiriRecord_Find((uint64_t)call->number);
    const void* arguments[KIRI_RECORD_ARGUMENTS] = { NULL };
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS && shape->arguments[i].kind != KIRI_ARGUMENT_NONE; ++i) {
        arguments[i] = call->arguments[i];
    }
    uint64_t nulls = kiriRecord_FindNulls(shape, arguments);
    uint64_t number = (uint64_t)call->number << 1 | (nulls != 0);
    kiriCoder_Unsigned(&coder, &number);
    if (nulls != 0) {
        kiriCoder_Unsigned(&coder, &nulls);
    }
    kiriRecord_CodeArguments(&coder, shape, arguments, NULL, nulls);
    kiriSink_Flush(coder.sink);
    return call;
}

/* The hash is dear beside a tick, so it is not taken after each. */
static kiriRecordHash TakeHash(const kiriCall* call, kiriResult result)
{
    kiriRecorder* recorder = &call->world->recorder;
    kiriRecordHash taken = { 0, 0 };
    if (call->number == KIRI_CALL_WORLD_TICK && (result >= 0 || result == KIRI_DIVERGED)) {
        taken.isThere = recorder->hashTicks > 0 && ++recorder->ticks % recorder->hashTicks == 0;
    } else if (call->number == KIRI_CALL_DESTROY_WORLD) {
        taken.isThere = recorder->hashTicks > 0;
    }
    taken.hash = taken.isThere ? kiriStateHash_Of(call->world) : 0;
    return taken;
}

void kiriRecord_End(const kiriCall* call, kiriResult result)
{
    kiriCoder coder = CoderOf(call->world);
    const kiriRecordCall* shape = kiriRecord_Find((uint64_t)call->number);
    const void* arguments[KIRI_RECORD_ARGUMENTS] = { NULL };
    kiriRecordHash hash = { 0, 0 };
    KIRI_ASSERT(call->world->recorder.isOpen);
    call->world->recorder.isOpen = false;
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS && shape->arguments[i].kind != KIRI_ARGUMENT_NONE; ++i) {
        bool isHash = shape->arguments[i].kind == KIRI_ARGUMENT_HASH;
        hash = isHash ? TakeHash(call, result) : hash;
        arguments[i] = isHash ? &hash : call->arguments[i];
    }
    kiriRecord_CodeOutcome(&coder, shape, arguments, &result);
    kiriSink_Flush(coder.sink);
}

void kiriRecord_Start(kiriWorld* world, const kiriWorldDef* def)
{
    kiriRecorder* recorder = &world->recorder;
    if (def->record == NULL) {
        return;
    }
    recorder->sink.write = def->record;
    recorder->sink.user = def->user;
    recorder->hashTicks = def->recordHashTicks;
    kiriCoder coder = CoderOf(world);
    uint64_t versions[2] = { KIRI_RECORD_VERSION, KIRI_VERSION };
    for (int i = 0; i < KIRI_RECORD_MAGIC_BYTES; ++i) {
        uint8_t byte = kiriRecordMagic[i];
        kiriCoder_Byte(&coder, &byte);
    }
    kiriCoder_Unsigned(&coder, &versions[0]);
    kiriCoder_Unsigned(&coder, &versions[1]);
    const void* arguments[] = { def->gravity, &def->budget };
    const kiriCall call = { world, KIRI_CALL_CREATE_WORLD, arguments };
    kiriRecord_End(kiriRecord_Begin(&call), KIRI_OK);
}

void kiriRecord_Stop(kiriWorld* world)
{
    const void* arguments[] = { NULL };
    const kiriCall call = { world, KIRI_CALL_DESTROY_WORLD, arguments };
    if (world->recorder.sink.write != NULL) {
        kiriRecord_End(kiriRecord_Begin(&call), KIRI_OK);
    }
}

/* What the arguments of each recorded call are. */

/* ---- Structs ----------------------------------------------------------------------------------------------------- */

#define FLOATS_FIELD(Type, field, count)                                                                               \
    {                                                                                                                  \
        KIRI_FIELD_FLOATS, count, offsetof(Type, field), 0, NULL                                                       \
    }
#define INTS_FIELD(Type, field, count)                                                                                 \
    {                                                                                                                  \
        KIRI_FIELD_INTS, count, offsetof(Type, field), 0, NULL                                                         \
    }
#define ID_FIELD(Type, field)                                                                                          \
    {                                                                                                                  \
        KIRI_FIELD_ID, 1, offsetof(Type, field), 0, NULL                                                               \
    }
#define ARRAY_FIELD(kind, Type, field, count, counted, isRead)                                                         \
    {                                                                                                                  \
        kind, count, offsetof(Type, field), offsetof(Type, counted), isRead                                            \
    }
#define COUNT_OF(array) ((int32_t)(sizeof(array) / sizeof((array)[0])))
#define STRUCT_OF(Type, cookie, fields, fill)                                                                          \
    {                                                                                                                  \
        sizeof(Type), cookie, COUNT_OF(fields), fields, fill                                                           \
    }

/* Integers without a sign, such as groups, are recorded as if they had one: all bits set is -1, one byte. */

static const kiriRecordField budgetFields[] = { INTS_FIELD(kiriBudget, triangles, 4) };
static const kiriRecordStruct budgetStruct = STRUCT_OF(kiriBudget, 0, budgetFields, NULL);

static const kiriRecordField windFields[] = { FLOATS_FIELD(kiriWind, velocity, 6) };
static const kiriRecordStruct windStruct = STRUCT_OF(kiriWind, 0, windFields, NULL);

static const kiriRecordField contactFields[] = { INTS_FIELD(kiriContact, point, 1),
                                                 FLOATS_FIELD(kiriContact, restPoint, 12),
                                                 INTS_FIELD(kiriContact, obstacle, 1) };
static const kiriRecordStruct contactStruct = STRUCT_OF(kiriContact, 0, contactFields, NULL);

static void FillPinDef(void* def)
{
    kiriDefaultPinDef(def);
}

static const kiriRecordField pinFields[] = { FLOATS_FIELD(kiriPinDef, restPoint, 7), ID_FIELD(kiriPinDef, obstacle) };
static const kiriRecordStruct pinStruct = STRUCT_OF(kiriPinDef, KIRI_COOKIE(kiriPinDef), pinFields, FillPinDef);

static void FillSettings(void* settings)
{
    ((kiriSheetSettings*)settings)->cookie = KIRI_COOKIE(kiriSheetSettings);
}

static const kiriRecordField settingsFields[] = {
    FLOATS_FIELD(kiriSheetSettings, material, 6),   INTS_FIELD(kiriSheetSettings, maxFrames, 1),
    FLOATS_FIELD(kiriSheetSettings, crumbArea, 3),  INTS_FIELD(kiriSheetSettings, groups, 3),
    FLOATS_FIELD(kiriSheetSettings, sleepSpeed, 1), INTS_FIELD(kiriSheetSettings, skinning, 2),
    FLOATS_FIELD(kiriSheetSettings, fadeTime, 1),   INTS_FIELD(kiriSheetSettings, normals, 1),
};
static const kiriRecordStruct settingsStruct =
    STRUCT_OF(kiriSheetSettings, KIRI_COOKIE(kiriSheetSettings), settingsFields, FillSettings);

static bool ReadsOutline(const void* def)
{
    const kiriObstacleDef* of = def;
    return of->type == KIRI_OBSTACLE_PRISM && kiriCall_IsWithin(of->outlineCount, 3, 64);
}

static void FillObstacleDef(void* def)
{
    kiriDefaultObstacleDef(def);
}

static const kiriRecordField obstacleFields[] = {
    INTS_FIELD(kiriObstacleDef, type, 1),
    FLOATS_FIELD(kiriObstacleDef, size, 5),
    INTS_FIELD(kiriObstacleDef, outlineCount, 1),
    ARRAY_FIELD(KIRI_FIELD_FLOATS_AT, kiriObstacleDef, outline, 2, outlineCount, ReadsOutline),
    FLOATS_FIELD(kiriObstacleDef, rounding, 22),
    FLOATS_FIELD(kiriObstacleDef, friction, 11),
    INTS_FIELD(kiriObstacleDef, body, 1),
    FLOATS_FIELD(kiriObstacleDef, pushSpeed, 1),
    INTS_FIELD(kiriObstacleDef, groups, 1),
};
static const kiriRecordStruct obstacleStruct =
    STRUCT_OF(kiriObstacleDef, KIRI_COOKIE(kiriObstacleDef), obstacleFields, FillObstacleDef);

static bool ReadsMesh(const void* def)
{
    const kiriSheetDef* of = def;
    return of->vertexCount >= 3 && kiriCall_IsWithin(of->triangleCount, 1, KIRI_MOST_TRIANGLES);
}

static bool ReadsFramePoints(const void* def)
{
    return kiriCall_IsWithin(((const kiriSheetDef*)def)->frameCount, 1, 65536);
}

static void FillSheetDef(void* def)
{
    kiriDefaultSheetDef(def);
}

static const kiriRecordField sheetFields[] = {
    INTS_FIELD(kiriSheetDef, vertexCount, 1),
    INTS_FIELD(kiriSheetDef, triangleCount, 1),
    ARRAY_FIELD(KIRI_FIELD_FLOATS_AT, kiriSheetDef, restPositions, 2, vertexCount, ReadsMesh),
    ARRAY_FIELD(KIRI_FIELD_INDICES_AT, kiriSheetDef, indices, 3, triangleCount, ReadsMesh),
    FLOATS_FIELD(kiriSheetDef, position, 12),
    FLOATS_FIELD(kiriSheetDef, material, 6),
    INTS_FIELD(kiriSheetDef, gridResolution, 1),
    FLOATS_FIELD(kiriSheetDef, snapDistance, 1),
    INTS_FIELD(kiriSheetDef, frameCount, 1),
    FLOATS_FIELD(kiriSheetDef, frameLength, 2),
    ARRAY_FIELD(KIRI_FIELD_FLOATS_AT, kiriSheetDef, framePoints, 2, frameCount, ReadsFramePoints),
    INTS_FIELD(kiriSheetDef, maxFrames, 1),
    FLOATS_FIELD(kiriSheetDef, rigidWeight, 5),
    INTS_FIELD(kiriSheetDef, groups, 4),
    FLOATS_FIELD(kiriSheetDef, sleepSpeed, 1),
    INTS_FIELD(kiriSheetDef, model, 4),
    FLOATS_FIELD(kiriSheetDef, fadeTime, 1),
    INTS_FIELD(kiriSheetDef, normals, 6),
    FLOATS_FIELD(kiriSheetDef, weldDistance, 1),
};
static const kiriRecordStruct sheetStruct =
    STRUCT_OF(kiriSheetDef, KIRI_COOKIE(kiriSheetDef), sheetFields, FillSheetDef);

/* ---- Calls ------------------------------------------------------------------------------------------------------- */

#define OF_ID                                                                                                          \
    {                                                                                                                  \
        KIRI_ARGUMENT_ID, 0, 0, NULL                                                                                   \
    }
#define OF_INT                                                                                                         \
    {                                                                                                                  \
        KIRI_ARGUMENT_INT, 0, 0, NULL                                                                                  \
    }
#define OF_FLOAT                                                                                                       \
    {                                                                                                                  \
        KIRI_ARGUMENT_FLOAT, 0, 0, NULL                                                                                \
    }
#define OF_DATA                                                                                                        \
    {                                                                                                                  \
        KIRI_ARGUMENT_DATA, 0, 0, NULL                                                                                 \
    }
#define OF_FLOATS(count)                                                                                               \
    {                                                                                                                  \
        KIRI_ARGUMENT_FLOATS, count, 0, NULL                                                                           \
    }
#define OF_STRUCT(of)                                                                                                  \
    {                                                                                                                  \
        KIRI_ARGUMENT_STRUCT, 0, 0, &(of)                                                                              \
    }
#define OF_ARRAY(kind, most, of)                                                                                       \
    { kind, 0, most, of },                                                                                             \
    {                                                                                                                  \
        KIRI_ARGUMENT_COUNT, 0, 0, NULL                                                                                \
    }
#define OF_NEW_ID                                                                                                      \
    {                                                                                                                  \
        KIRI_ARGUMENT_NEW_ID, 0, 0, NULL                                                                               \
    }
#define OF_NEW_IDS                                                                                                     \
    {                                                                                                                  \
        KIRI_ARGUMENT_NEW_IDS, 0, 0, NULL                                                                              \
    }
#define OF_NEW_INT                                                                                                     \
    {                                                                                                                  \
        KIRI_ARGUMENT_NEW_INT, 0, 0, NULL                                                                              \
    }
#define OF_HASH                                                                                                        \
    {                                                                                                                  \
        KIRI_ARGUMENT_HASH, 0, 0, NULL                                                                                 \
    }

/* Arguments that go by value, and those that are written. */
#define GIVEN_ID(i) (*(const uint32_t*)given[i])
#define GIVEN_INT(i) (*(const int32_t*)given[i])
#define GIVEN_FLOAT(i) (*(const float*)given[i])
#define GIVEN_DATA(i) (*(const uint64_t*)given[i])
#define GIVEN_NEW(i) ((uint32_t*)(void*)given[i])

#define MAKER(Name, ...)                                                                                               \
    static kiriResult Make##Name(kiriWorld* world, const void* const* given)                                           \
    {                                                                                                                  \
        return kiri##Name(world, __VA_ARGS__);                                                                         \
    }

MAKER(World_Tick, GIVEN_FLOAT(0), GIVEN_INT(1))
MAKER(World_SetGravity, given[0])
MAKER(World_ShiftOrigin, given[0])
MAKER(World_SetBudget, given[0])
MAKER(World_Note, given[0], GIVEN_INT(1))
MAKER(World_Load, given[0], GIVEN_INT(1))
MAKER(CreateSheet, given[0], GIVEN_NEW(1))
MAKER(DestroySheet, GIVEN_ID(0))
MAKER(Sheet_SetSettings, GIVEN_ID(0), given[1])
MAKER(Sheet_Wake, GIVEN_ID(0))
MAKER(Sheet_Transform, GIVEN_ID(0), given[1], given[2])
MAKER(Sheet_SetVelocity, GIVEN_ID(0), given[1], given[2])
MAKER(Frame_SetPieceVelocity, GIVEN_ID(0), given[1], given[2])
MAKER(Sheet_SetUserData, GIVEN_ID(0), GIVEN_DATA(1))
MAKER(Pin_SetUserData, GIVEN_ID(0), GIVEN_DATA(1))
MAKER(Frame_SetPieceUserData, GIVEN_ID(0), GIVEN_DATA(1))
MAKER(Frame_DetachPiece, GIVEN_ID(0), GIVEN_NEW(1))
MAKER(Frame_DestroyPiece, GIVEN_ID(0))
MAKER(World_DetachPieces, given[0], GIVEN_INT(1), GIVEN_NEW(2))
MAKER(World_DestroyPieces, given[0], GIVEN_INT(1))
MAKER(Sheet_DropCrumbs, GIVEN_ID(0), GIVEN_FLOAT(1), (int32_t*)(void*)given[2])
MAKER(BeginCut, GIVEN_ID(0), given[1], GIVEN_NEW(2))
MAKER(Cut_Extend, GIVEN_ID(0), given[1], GIVEN_INT(2))
MAKER(Cut_End, GIVEN_ID(0))
MAKER(Sheet_Slice, GIVEN_ID(0), given[1], GIVEN_NEW(2))
MAKER(BeginBlade, GIVEN_ID(0), GIVEN_NEW(1))
MAKER(Blade_MoveEdge, GIVEN_ID(0), given[1], given[2])
MAKER(Blade_MoveRay, GIVEN_ID(0), given[1], given[2], GIVEN_FLOAT(3))
MAKER(Blade_End, GIVEN_ID(0))
MAKER(Frame_Hold, GIVEN_ID(0), given[1], given[2])
MAKER(Frame_ApplyForce, GIVEN_ID(0), given[1], given[2])
MAKER(Sheet_ApplyForce, GIVEN_ID(0), given[1], given[2], given[3])
MAKER(Sheet_ApplyLineLoad, GIVEN_ID(0), given[1], given[2], given[3])
MAKER(Sheet_ApplyPressure, GIVEN_ID(0), GIVEN_FLOAT(1))
MAKER(Sheet_ApplyImpulse, GIVEN_ID(0), given[1], given[2])
MAKER(Sheet_SetWind, GIVEN_ID(0), given[1])
MAKER(CreatePin, GIVEN_ID(0), given[1], GIVEN_NEW(2))
MAKER(Sheet_ClampLine, GIVEN_ID(0), given[1], given[2], GIVEN_NEW(3))
MAKER(Sheet_HingeLine, GIVEN_ID(0), given[1], given[2], GIVEN_NEW(3))
MAKER(Pin_SetTarget, GIVEN_ID(0), given[1])
MAKER(Pin_SetPose, GIVEN_ID(0), given[1], given[2])
MAKER(Pin_SetBreakForce, GIVEN_ID(0), GIVEN_FLOAT(1))
MAKER(DestroyPin, GIVEN_ID(0))
MAKER(Sheet_SetContacts, GIVEN_ID(0), given[1], GIVEN_INT(2))
MAKER(CreateObstacle, given[0], GIVEN_NEW(1))
MAKER(DestroyObstacle, GIVEN_ID(0))
MAKER(Obstacle_SetPose, GIVEN_ID(0), given[1], given[2])
MAKER(Obstacle_SetVelocity, GIVEN_ID(0), given[1], given[2])
MAKER(Obstacle_SetSurfaceVelocity, GIVEN_ID(0), given[1])
MAKER(Obstacle_SetMass, GIVEN_ID(0), GIVEN_FLOAT(1), given[2], given[3])

/* The world is there already: it gets what the def of the recorded one said. */
static kiriResult MakeWorld(kiriWorld* world, const void* const* given)
{
    float gravity[3];
    const float* wanted = given[0];
    const kiriBudget *budget = given[1], *was = &world->budget;
    if (wanted == NULL || budget == NULL) { /* no call writes that */
        return KIRI_ERROR_ARGUMENT;
    }
    kiriResult result = KIRI_OK;
    kiriVec3_Store(gravity, world->gravity);
    for (int i = 0; i < 3 && result == KIRI_OK; ++i) {
        result = wanted[i] == gravity[i] ? KIRI_OK : kiriWorld_SetGravity(world, wanted);
        kiriVec3_Store(gravity, world->gravity);
    }
    bool isSame = budget->triangles == was->triangles && budget->cells == was->cells &&
                  budget->samples == was->samples && budget->iterations == was->iterations;
    return result != KIRI_OK || isSame ? result : kiriWorld_SetBudget(world, budget);
}

/* It stays for the host to look at. */
static kiriResult MakeEnd(kiriWorld* world, const void* const* given)
{
    (void)world;
    (void)given;
    return KIRI_OK;
}

static kiriResult MakeFinishCuts(kiriWorld* world, const void* const* given)
{
    (void)given;
    return kiriWorld_FinishCuts(world);
}

#define ENTRY(Name, ...)                                                                                               \
    {                                                                                                                  \
        "kiri" #Name, { __VA_ARGS__ }, Make##Name                                                                      \
    }

static const kiriRecordCall recordCalls[KIRI_CALL_COUNT] = {
    [KIRI_CALL_CREATE_WORLD] = { "kiriCreateWorld", { OF_FLOATS(3), OF_STRUCT(budgetStruct) }, MakeWorld },
    [KIRI_CALL_DESTROY_WORLD] = { "kiriDestroyWorld", { OF_HASH }, MakeEnd },
    [KIRI_CALL_WORLD_TICK] = ENTRY(World_Tick, OF_FLOAT, OF_INT, OF_HASH),
    [KIRI_CALL_WORLD_SET_GRAVITY] = ENTRY(World_SetGravity, OF_FLOATS(3)),
    [KIRI_CALL_WORLD_SHIFT_ORIGIN] = ENTRY(World_ShiftOrigin, OF_FLOATS(3)),
    [KIRI_CALL_WORLD_SET_BUDGET] = ENTRY(World_SetBudget, OF_STRUCT(budgetStruct)),
    [KIRI_CALL_WORLD_NOTE] = ENTRY(World_Note, OF_ARRAY(KIRI_ARGUMENT_BYTES, KIRI_MOST_NOTE_BYTES, NULL)),
    [KIRI_CALL_WORLD_LOAD] = ENTRY(World_Load, OF_ARRAY(KIRI_ARGUMENT_BYTES, INT32_MAX, NULL)),
    [KIRI_CALL_WORLD_FINISH_CUTS] = { "kiriWorld_FinishCuts", { { 0 } }, MakeFinishCuts },
    [KIRI_CALL_CREATE_SHEET] = ENTRY(CreateSheet, OF_STRUCT(sheetStruct), OF_NEW_ID),
    [KIRI_CALL_DESTROY_SHEET] = ENTRY(DestroySheet, OF_ID),
    [KIRI_CALL_SHEET_SET_SETTINGS] = ENTRY(Sheet_SetSettings, OF_ID, OF_STRUCT(settingsStruct)),
    [KIRI_CALL_SHEET_WAKE] = ENTRY(Sheet_Wake, OF_ID),
    [KIRI_CALL_SHEET_TRANSFORM] = ENTRY(Sheet_Transform, OF_ID, OF_FLOATS(9), OF_FLOATS(3)),
    [KIRI_CALL_SHEET_SET_VELOCITY] = ENTRY(Sheet_SetVelocity, OF_ID, OF_FLOATS(3), OF_FLOATS(3)),
    [KIRI_CALL_FRAME_SET_PIECE_VELOCITY] = ENTRY(Frame_SetPieceVelocity, OF_ID, OF_FLOATS(3), OF_FLOATS(3)),
    [KIRI_CALL_SHEET_SET_USER_DATA] = ENTRY(Sheet_SetUserData, OF_ID, OF_DATA),
    [KIRI_CALL_PIN_SET_USER_DATA] = ENTRY(Pin_SetUserData, OF_ID, OF_DATA),
    [KIRI_CALL_FRAME_SET_PIECE_USER_DATA] = ENTRY(Frame_SetPieceUserData, OF_ID, OF_DATA),
    [KIRI_CALL_FRAME_DETACH_PIECE] = ENTRY(Frame_DetachPiece, OF_ID, OF_NEW_ID),
    [KIRI_CALL_FRAME_DESTROY_PIECE] = ENTRY(Frame_DestroyPiece, OF_ID),
    [KIRI_CALL_WORLD_DETACH_PIECES] =
        ENTRY(World_DetachPieces, OF_ARRAY(KIRI_ARGUMENT_IDS, INT32_MAX, NULL), OF_NEW_IDS),
    [KIRI_CALL_WORLD_DESTROY_PIECES] = ENTRY(World_DestroyPieces, OF_ARRAY(KIRI_ARGUMENT_IDS, INT32_MAX, NULL)),
    [KIRI_CALL_SHEET_DROP_CRUMBS] = ENTRY(Sheet_DropCrumbs, OF_ID, OF_FLOAT, OF_NEW_INT),
    [KIRI_CALL_BEGIN_CUT] = ENTRY(BeginCut, OF_ID, OF_FLOATS(2), OF_NEW_ID),
    [KIRI_CALL_CUT_EXTEND] = ENTRY(Cut_Extend, OF_ID, OF_ARRAY(KIRI_ARGUMENT_POINTS, 1 << 24, NULL)),
    [KIRI_CALL_CUT_END] = ENTRY(Cut_End, OF_ID),
    [KIRI_CALL_SHEET_SLICE] = ENTRY(Sheet_Slice, OF_ID, OF_FLOATS(12), OF_NEW_ID),
    [KIRI_CALL_BEGIN_BLADE] = ENTRY(BeginBlade, OF_ID, OF_NEW_ID),
    [KIRI_CALL_BLADE_MOVE_EDGE] = ENTRY(Blade_MoveEdge, OF_ID, OF_FLOATS(3), OF_FLOATS(3)),
    [KIRI_CALL_BLADE_MOVE_RAY] = ENTRY(Blade_MoveRay, OF_ID, OF_FLOATS(3), OF_FLOATS(3), OF_FLOAT),
    [KIRI_CALL_BLADE_END] = ENTRY(Blade_End, OF_ID),
    [KIRI_CALL_FRAME_HOLD] = ENTRY(Frame_Hold, OF_ID, OF_FLOATS(3), OF_FLOATS(9)),
    [KIRI_CALL_FRAME_APPLY_FORCE] = ENTRY(Frame_ApplyForce, OF_ID, OF_FLOATS(3), OF_FLOATS(3)),
    [KIRI_CALL_SHEET_APPLY_FORCE] = ENTRY(Sheet_ApplyForce, OF_ID, OF_FLOATS(2), OF_FLOATS(3), OF_FLOATS(3)),
    [KIRI_CALL_SHEET_APPLY_LINE_LOAD] = ENTRY(Sheet_ApplyLineLoad, OF_ID, OF_FLOATS(2), OF_FLOATS(2), OF_FLOATS(3)),
    [KIRI_CALL_SHEET_APPLY_PRESSURE] = ENTRY(Sheet_ApplyPressure, OF_ID, OF_FLOAT),
    [KIRI_CALL_SHEET_APPLY_IMPULSE] = ENTRY(Sheet_ApplyImpulse, OF_ID, OF_FLOATS(2), OF_FLOATS(3)),
    [KIRI_CALL_SHEET_SET_WIND] = ENTRY(Sheet_SetWind, OF_ID, OF_STRUCT(windStruct)),
    [KIRI_CALL_CREATE_PIN] = ENTRY(CreatePin, OF_ID, OF_STRUCT(pinStruct), OF_NEW_ID),
    [KIRI_CALL_SHEET_CLAMP_LINE] = ENTRY(Sheet_ClampLine, OF_ID, OF_FLOATS(2), OF_FLOATS(2), OF_NEW_ID),
    [KIRI_CALL_SHEET_HINGE_LINE] = ENTRY(Sheet_HingeLine, OF_ID, OF_FLOATS(2), OF_FLOATS(2), OF_NEW_ID),
    [KIRI_CALL_PIN_SET_TARGET] = ENTRY(Pin_SetTarget, OF_ID, OF_FLOATS(3)),
    [KIRI_CALL_PIN_SET_POSE] = ENTRY(Pin_SetPose, OF_ID, OF_FLOATS(3), OF_FLOATS(9)),
    [KIRI_CALL_PIN_SET_BREAK_FORCE] = ENTRY(Pin_SetBreakForce, OF_ID, OF_FLOAT),
    [KIRI_CALL_DESTROY_PIN] = ENTRY(DestroyPin, OF_ID),
    [KIRI_CALL_SHEET_SET_CONTACTS] =
        ENTRY(Sheet_SetContacts, OF_ID, OF_ARRAY(KIRI_ARGUMENT_STRUCTS, INT32_MAX, &contactStruct)),
    [KIRI_CALL_CREATE_OBSTACLE] = ENTRY(CreateObstacle, OF_STRUCT(obstacleStruct), OF_NEW_ID),
    [KIRI_CALL_DESTROY_OBSTACLE] = ENTRY(DestroyObstacle, OF_ID),
    [KIRI_CALL_OBSTACLE_SET_POSE] = ENTRY(Obstacle_SetPose, OF_ID, OF_FLOATS(3), OF_FLOATS(9)),
    [KIRI_CALL_OBSTACLE_SET_VELOCITY] = ENTRY(Obstacle_SetVelocity, OF_ID, OF_FLOATS(3), OF_FLOATS(3)),
    [KIRI_CALL_OBSTACLE_SET_SURFACE_VELOCITY] = ENTRY(Obstacle_SetSurfaceVelocity, OF_ID, OF_FLOATS(3)),
    [KIRI_CALL_OBSTACLE_SET_MASS] = ENTRY(Obstacle_SetMass, OF_ID, OF_FLOAT, OF_FLOATS(6), OF_FLOATS(3)),
};

const kiriRecordCall* kiriRecord_Find(uint64_t number)
{
    return number < KIRI_CALL_COUNT && recordCalls[number].name != NULL ? &recordCalls[number] : NULL;
}

kiriResult kiriCall_Fail(const kiriWorld* world, char* line, kiriResult result, const char* function, const char* why)
{
    snprintf(line, KIRI_LINE_BYTES, "%s: %s (%s)", function, why != NULL ? why : kiriGetResultText(result),
             kiriGetResultName(result));
    if (world->log != NULL) {
        kiriWord_Add(&world->logs, 1);
        world->log(world->user, line);
        kiriWord_Add(&world->logs, -1);
    }
    return result;
}

/* A log that calls gets no line for it: that would be another call of it. */
kiriResult kiriCall_Refuse(const kiriWorld* world, const char* function)
{
    char line[KIRI_LINE_BYTES];
    if (kiriWord_Read(&world->logs) != 0) {
        return KIRI_ERROR_STATE;
    }
    return kiriCall_Fail(world, line, KIRI_ERROR_STATE, function, "called by a callback of this world");
}

void* kiriCall_Owner(const kiriPool* pool, uint32_t id)
{
    const kiriSlot* slot = kiriPool_Find(pool, id);
    return slot != NULL ? slot->owner : NULL;
}

bool kiriCall_AreFinite(const float* values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

bool kiriCall_IsAbove(float value, float low)
{
    return isfinite(value) && value > low;
}

bool kiriCall_IsAtLeast(float value, float low)
{
    return isfinite(value) && value >= low;
}

bool kiriCall_IsWithin(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

bool kiriCall_AreOrthonormal(const float a[3], const float b[3])
{
    if (!kiriCall_AreFinite(a, 3) || !kiriCall_AreFinite(b, 3)) {
        return false;
    }
    kiriVec3 u = kiriVec3_Load(a), v = kiriVec3_Load(b);
    return fabs(kiriVec3_Dot(u, u) - 1.0) < 1e-3 && fabs(kiriVec3_Dot(v, v) - 1.0) < 1e-3 &&
           fabs(kiriVec3_Dot(u, v)) < 1e-3;
}

const char* kiriCall_FaultOfRotation(const kiriSheetData* sheet, const float rotation[9])
{
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    bool isPlanar = sheet->settings.mechanics.planar;
    if (!kiriCall_AreOrthonormal(&rotation[0], &rotation[3]) || !kiriCall_AreOrthonormal(&rotation[3], &rotation[6]) ||
        !kiriCall_AreOrthonormal(&rotation[6], &rotation[0])) {
        return "rotation is not orthonormal";
    }
    if (!(kiriVec3_Dot(kiriVec3_Cross(m.u, m.v), m.d) > 0.0)) {
        return "rotation mirrors";
    }
    return isPlanar && !(kiriVec3_Dot(m.d, sheet->settings.mechanics.axes.d) > 0.999999)
               ? "rotation turns a planar sheet out of its plane"
               : NULL;
}

const char* kiriCall_FaultOfLine(const kiriSheetData* sheet, const float from[2], const float to[2],
                                 kiriLatticePoint ends[2])
{
    if (from == NULL || to == NULL || !kiriCall_AreFinite(from, 2) || !kiriCall_AreFinite(to, 2)) {
        return "from or to is null or not finite";
    }
    if (!kiriSheet_ToLattice(sheet, from, &ends[0]) || !kiriSheet_ToLattice(sheet, to, &ends[1])) {
        return "from or to lies too far outside the sheet";
    }
    return ends[0].x == ends[1].x && ends[0].y == ends[1].y ? "from and to are the same point" : NULL;
}
