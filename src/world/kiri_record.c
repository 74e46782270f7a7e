#include "kiri_record.h"
#include "kiri_state_hash.h"

#include <string.h>

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
