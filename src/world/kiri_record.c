/* Recordings of calls as bytes, and replays of recordings. */
#include "kiri_call.h"
#include "kiri_state.h"

#include <stdio.h>

static const uint8_t magic[KIRI_RECORD_MAGIC_BYTES] = { 'K', 'i', 'r', 'i', 'R', 'e', 'c', '\n' };

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* Why a coder stopped. From then on it reads zeros. */
typedef enum ReadFault {
    READ_FINE,
    READ_SHORT, /* the bytes end too early */
    READ_DAMAGED,
    READ_OTHER_VERSION,
    READ_NO_MEMORY
} ReadFault;

/* A coder either writes or reads, so one description of data serves both ways. Values that are written have been
   checked; values that are read have not. Integers take 7 bits a byte, the lowest first; the top bit marks that more
   bytes follow. */
typedef struct Coder {
    kiriRecorder* recorder;  /* null: the coder reads */
    const uint8_t *at, *end; /* bytes to read */
    kiriMemory* memory;      /* owner of arrays and arguments that are read */
    ReadFault fault;
} Coder;

static bool IsReading(const Coder* coder)
{
    return coder->recorder == NULL;
}

/* Keeps the first fault. */
static void StopReading(Coder* coder, ReadFault fault)
{
    KIRI_ASSERT(IsReading(coder) && fault != READ_FINE);
    coder->fault = coder->fault == READ_FINE ? fault : coder->fault;
    coder->at = coder->end;
}

static void FlushRecorder(kiriRecorder* recorder)
{
    if (recorder->byteCount > 0) {
        recorder->write(recorder->user, recorder->bytes, recorder->byteCount);
        recorder->byteCount = 0;
    }
}

static void CodeByte(Coder* coder, uint8_t* value)
{
    kiriRecorder* recorder = coder->recorder;
    if (recorder != NULL) {
        if (recorder->byteCount == KIRI_RECORDER_BYTES) {
            FlushRecorder(recorder);
        }
        KIRI_ASSERT(recorder->byteCount >= 0 && recorder->byteCount < KIRI_RECORDER_BYTES);
        recorder->bytes[recorder->byteCount++] = *value;
    } else if (coder->at == coder->end) {
        StopReading(coder, READ_SHORT);
        *value = 0;
    } else {
        KIRI_ASSERT(coder->at < coder->end);
        *value = *coder->at++;
    }
}

static void CodeUnsigned(Coder* coder, uint64_t* value)
{
    uint64_t rest = *value, sum = 0;
    uint8_t byte = 0x80;
    for (int shift = 0; byte >= 0x80 && shift < 64; shift += 7) {
        byte = (uint8_t)((rest & 0x7f) | (rest > 0x7f ? 0x80 : 0));
        CodeByte(coder, &byte);
        sum |= (uint64_t)(byte & 0x7f) << shift;
        rest >>= 7;
    }
    if (IsReading(coder)) {
        *value = sum;
    }
}

/* Codes an integer. 0, -1, 1, -2 and so on become 0, 1, 2, 3. */
static void CodeInt(Coder* coder, int32_t* value)
{
    uint64_t folded = (uint32_t)*value << 1 ^ (*value < 0 ? UINT32_MAX : 0);
    CodeUnsigned(coder, &folded);
    if (IsReading(coder)) {
        *value = (int32_t)((uint32_t)folded >> 1 ^ ((folded & 1) != 0 ? UINT32_MAX : 0));
    }
}

/* Codes an id, slot first: so ids are short while there are few items, see kiri_array.h. */
static void CodeId(Coder* coder, uint32_t* value)
{
    uint64_t turned = (uint32_t)(*value << 10 | *value >> 22);
    CodeUnsigned(coder, &turned);
    if (IsReading(coder)) {
        *value = (uint32_t)turned >> 10 | (uint32_t)turned << 22;
    }
}

static void CodeBits(Coder* coder, uint64_t* bits, int count)
{
    KIRI_ASSERT(count % 8 == 0 && count <= 64);
    uint64_t sum = 0;
    for (int shift = 0; shift < count; shift += 8) {
        uint8_t byte = (uint8_t)(*bits >> shift);
        CodeByte(coder, &byte);
        sum |= (uint64_t)byte << shift;
    }
    *bits = sum;
}

static void CodeFloats(Coder* coder, float* values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        uint32_t word;
        memcpy(&word, &values[i], sizeof(word));
        uint64_t bits = word;
        CodeBits(coder, &bits, 32);
        word = (uint32_t)bits;
        if (IsReading(coder)) {
            memcpy(&values[i], &word, sizeof(word));
        }
    }
}

/* Codes differences: neighbours in a mesh are near each other. */
static void CodeIndices(Coder* coder, int32_t* values, int64_t count)
{
    uint32_t last = 0;
    for (int64_t i = 0; i < count; ++i) {
        int32_t step = (int32_t)((uint32_t)values[i] - last);
        CodeInt(coder, &step);
        last += (uint32_t)step;
        if (IsReading(coder)) {
            values[i] = (int32_t)last;
        }
    }
}

/* Allocates zeroed items of which each takes at least `least` bytes of the recording. Null if there are not as many. */
static void* AllocateRead(Coder* coder, int64_t count, int64_t itemBytes, int64_t least)
{
    KIRI_ASSERT(IsReading(coder) && count > 0);
    if (count * least > coder->end - coder->at) {
        StopReading(coder, READ_SHORT);
        return NULL;
    }
    void* items = kiriMemory_AllocZeroed(coder->memory, count * itemBytes);
    if (items == NULL) {
        StopReading(coder, READ_NO_MEMORY);
    }
    return items;
}

/* ---- Arguments --------------------------------------------------------------------------------------------------- */

static void CodeStruct(Coder* coder, const kiriStruct* of, char* at);

static void CodeValue(Coder* coder, const kiriValue* value, void* at)
{
    switch (value->form) {
    case KIRI_FORM_INTS: /* unsigned ones too: UINT32_MAX is -1, which takes one byte */
        KIRI_EACH_INDEX(i, *value) {
            CodeInt(coder, (int32_t*)at + i);
        }
        break;
    case KIRI_FORM_FLOATS:
        CodeFloats(coder, at, value->count);
        break;
    case KIRI_FORM_BYTE:
        CodeByte(coder, at);
        break;
    case KIRI_FORM_DATA:
        CodeUnsigned(coder, at);
        break;
    case KIRI_FORM_ID:
        CodeId(coder, at);
        break;
    case KIRI_FORM_STRUCT:
        CodeStruct(coder, value->of(), at);
        break;
    default: /* counts are coded with their arrays, new ids with the outcome */
        break;
    }
}

/* Codes whether something is there. */
static bool CodePresence(Coder* coder, bool isThere)
{
    uint64_t number = isThere;
    CodeUnsigned(coder, &number);
    if (number > 1) {
        StopReading(coder, READ_DAMAGED);
    }
    return number == 1;
}

static void CodeArrayOf(Coder* coder, const kiriValue* member, char* def)
{
    void* array;
    int32_t count;
    bool isFloats = member->form == KIRI_FORM_FLOATS_AT;
    memcpy(&array, def + member->offset, sizeof(array));
    memcpy(&count, def + member->refers, sizeof(count));
    if (!CodePresence(coder, array != NULL && count > 0)) {
        return;
    }
    int64_t numbers = (int64_t)member->count * count;
    KIRI_ASSERT(IsReading(coder) || numbers > 0);
    if (IsReading(coder)) {
        array = count > 0 ? AllocateRead(coder, numbers, 4, isFloats ? 4 : 1) : NULL;
        memcpy(def + member->offset, &array, sizeof(array));
    }
    if (array != NULL && isFloats) {
        CodeFloats(coder, array, numbers);
    } else if (array != NULL) {
        CodeIndices(coder, array, numbers);
    }
}

static void CodeStruct(Coder* coder, const kiriStruct* of, char* at)
{
    if (IsReading(coder) && of->cookie != 0) {
        memcpy(at, &of->cookie, sizeof(of->cookie));
    }
    KIRI_ASSERT(at != NULL);
    KIRI_EACH_INDEX(i, *of) {
        if (of->members[i].form >= KIRI_FORM_FLOATS_AT) {
            CodeArrayOf(coder, &of->members[i], at);
        } else {
            CodeValue(coder, &of->members[i], at + of->members[i].offset);
        }
    }
}

static int32_t BytesOf(const kiriValue* value)
{
    switch (value->form) {
    case KIRI_FORM_STRUCT:
        return value->of()->bytes;
    case KIRI_FORM_BYTE:
        return 1;
    case KIRI_FORM_DATA:
        return sizeof(uint64_t);
    default:
        return (int32_t)sizeof(uint32_t) * kiriMax(value->count, 1);
    }
}

/* Codes the count, which is the next argument, and then the items. */
static void CodeArray(Coder* coder, const kiriValue* value, const void** at)
{
    if (IsReading(coder)) {
        at[1] = AllocateRead(coder, 1, sizeof(int32_t), 0);
    }
    if (at[1] == NULL) {
        return;
    }
    int32_t* count = (int32_t*)at[1];
    CodeInt(coder, count);
    if (IsReading(coder)) {
        bool isInRange = value->low > value->high || (*count >= value->low && *count <= value->high);
        at[0] = isInRange && *count > 0 ? AllocateRead(coder, *count, BytesOf(value->item), 1) : NULL;
        if (!isInRange) {
            StopReading(coder, READ_DAMAGED);
        }
    }
    KIRI_TIMES_WHILE(at[0] != NULL, i, *count) {
        CodeValue(coder, value->item, (char*)at[0] + (int64_t)i * BytesOf(value->item));
    }
}

/* Codes the arguments of a call. If the coder reads they lie in its memory. */
static void CodeArguments(Coder* coder, const kiriCallRow* row, const void* at[])
{
    for (int i = 0; i < KIRI_CALL_ARGUMENTS && row->kinds[i] != KIRI_ARGUMENT_NONE && coder->fault == READ_FINE; ++i) {
        const kiriValue* value = &kiriArguments[row->kinds[i]];
        bool isThere = value->form != KIRI_FORM_COUNT; /* it comes with its array */
        if (value->form == KIRI_FORM_ARRAY) {
            CodeArray(coder, value, &at[i]);
            continue;
        }
        if (value->isOptional && value->form == KIRI_FORM_FLOATS) {
            isThere = CodePresence(coder, at[i] != NULL);
        }
        if (isThere && IsReading(coder)) {
            int64_t items = value->form == KIRI_FORM_NEWS ? *(const int32_t*)at[i - 1] : 1;
            at[i] = AllocateRead(coder, kiriMax(items, 1), BytesOf(value), 0);
        }
        if (isThere && at[i] != NULL) {
            CodeValue(coder, value, (void*)at[i]);
        }
    }
}

/* Returns the ids, or the number, that the call writes, and their count. */
static uint32_t* FindNew(const kiriCallRow* row, const void* const at[], int32_t* count)
{
    KIRI_TIMES(i, KIRI_CALL_ARGUMENTS) {
        kiriForm form = kiriArguments[row->kinds[i]].form;
        if (form == KIRI_FORM_NEW || form == KIRI_FORM_NEWS) {
            *count = form == KIRI_FORM_NEW ? 1 : *(const int32_t*)at[i - 1];
            return (uint32_t*)at[i];
        }
    }
    *count = 0;
    return NULL;
}

typedef struct Outcome {
    kiriResult result;
    uint32_t* made; /* ids, or one number */
    int32_t madeCount;
    bool hasHash;
    uint64_t hash;
} Outcome;

static void CodeOutcome(Coder* coder, int32_t number, Outcome* outcome)
{
    KIRI_ASSERT(outcome->madeCount <= 0 || outcome->made != NULL);
    CodeInt(coder, &outcome->result);
    KIRI_TIMES_WHILE(outcome->result >= 0, i, outcome->madeCount) {
        CodeId(coder, &outcome->made[i]);
    }
    if (number == KIRI_CALL_World_Tick || number == KIRI_CALL_DestroyWorld) {
        outcome->hasHash = CodePresence(coder, outcome->hasHash);
    }
    if (outcome->hasHash) {
        CodeBits(coder, &outcome->hash, 64);
    }
}

/* ---- Recording --------------------------------------------------------------------------------------------------- */

static Coder WriterOf(kiriWorld* world)
{
    Coder coder = { &world->recorder, NULL, NULL, NULL, READ_FINE };
    return coder;
}

void kiriRecord_Begin(const kiriCall* call)
{
    Coder coder = WriterOf(call->world);
    KIRI_ASSERT(call->number >= 0 && call->number < KIRI_CALL_COUNT);
    uint64_t number = (uint64_t)call->number;
    KIRI_ASSERT(!call->world->recorder.isOpen);
    call->world->recorder.isOpen = true;
    CodeUnsigned(&coder, &number);
    CodeArguments(&coder, &kiriCallRows[call->number], (const void**)call->arguments);
    FlushRecorder(coder.recorder);
}

void kiriRecord_End(const kiriCall* call, kiriResult result)
{
    kiriRecorder* recorder = &call->world->recorder;
    Coder coder = WriterOf(call->world);
    Outcome outcome = { .result = result };
    outcome.made = FindNew(&kiriCallRows[call->number], call->arguments, &outcome.madeCount);
    KIRI_ASSERT(recorder->isOpen);
    recorder->isOpen = false;
    /* A hash takes about as long as a tick, so few calls have one. */
    if (call->number == KIRI_CALL_World_Tick && (result >= 0 || result == KIRI_DIVERGED)) {
        outcome.hasHash = recorder->hashTicks > 0 && ++recorder->ticks % recorder->hashTicks == 0;
    } else if (call->number == KIRI_CALL_DestroyWorld) {
        outcome.hasHash = recorder->hashTicks > 0;
    }
    outcome.hash = outcome.hasHash ? kiriStateHash_Of(call->world) : 0;
    CodeOutcome(&coder, call->number, &outcome);
    FlushRecorder(coder.recorder);
}

static void RecordWhole(kiriWorld* world, int32_t number, const void* const arguments[])
{
    const kiriCall call = { .world = world, .number = number, .arguments = arguments };
    kiriRecord_Begin(&call);
    kiriRecord_End(&call, KIRI_OK);
}

/* Codes the head of a recording: magic, format and version of the library. */
static void CodeStart(Coder* coder)
{
    uint64_t format = KIRI_RECORD_VERSION, library = KIRI_VERSION;
    KIRI_TIMES(i, KIRI_RECORD_MAGIC_BYTES) {
        uint8_t byte = magic[i];
        CodeByte(coder, &byte);
        if (byte != magic[i]) {
            StopReading(coder, READ_DAMAGED);
        }
    }
    CodeUnsigned(coder, &format);
    CodeUnsigned(coder, &library);
    if (format != KIRI_RECORD_VERSION || library / 100 != KIRI_VERSION / 100) {
        StopReading(coder, READ_OTHER_VERSION);
    }
}

void kiriRecord_Start(kiriWorld* world, const kiriWorldDef* def)
{
    kiriRecorder* recorder = &world->recorder;
    if (def->record != NULL) {
        recorder->write = def->record;
        recorder->user = def->user;
        recorder->hashTicks = def->recordHashTicks;
        Coder coder = WriterOf(world);
        const void* const arguments[] = { def->gravity, &def->budget };
        CodeStart(&coder);
        RecordWhole(world, KIRI_CALL_CreateWorld, arguments);
    }
}

void kiriRecord_Stop(kiriWorld* world)
{
    if (world->recorder.write != NULL) {
        RecordWhole(world, KIRI_CALL_DestroyWorld, NULL);
    }
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* A call that was read. */
typedef struct Recorded {
    const kiriCallRow* row;
    uint64_t number;
    const void* arguments[KIRI_CALL_ARGUMENTS];
    const uint8_t* argumentsEnd;
    Outcome outcome;
    bool hasOutcome; /* false: the recording ends within the call */
} Recorded;

static void ReadCall(Coder* coder, Recorded* recorded, bool isFirst)
{
    KIRI_CLEAR(recorded);
    CodeUnsigned(coder, &recorded->number);
    if (recorded->number >= KIRI_CALL_COUNT) {
        StopReading(coder, READ_DAMAGED);
        return;
    }
    recorded->row = &kiriCallRows[recorded->number];
    CodeArguments(coder, recorded->row, recorded->arguments);
    recorded->argumentsEnd = coder->at;
    recorded->hasOutcome = coder->at != coder->end;
    Outcome* outcome = &recorded->outcome;
    if (recorded->hasOutcome) {
        FindNew(recorded->row, recorded->arguments, &outcome->madeCount);
    }
    if (outcome->madeCount > 0) {
        outcome->made = AllocateRead(coder, outcome->madeCount, sizeof(uint32_t), 0);
    }
    if (recorded->hasOutcome && coder->fault == READ_FINE) {
        CodeOutcome(coder, (int32_t)recorded->number, outcome);
    }
    /* The first call makes the world, and the last one destroys it. */
    bool isLast = coder->at == coder->end;
    if ((recorded->number == KIRI_CALL_CreateWorld) != isFirst ||
        (recorded->number == KIRI_CALL_DestroyWorld && !isLast)) {
        StopReading(coder, READ_DAMAGED);
    }
}

/* ---- Replaying --------------------------------------------------------------------------------------------------- */

static const char* FindDifference(const kiriWorld* world, const Recorded* recorded, kiriResult result)
{
    const Outcome* then = &recorded->outcome;
    if (result != then->result) {
        return "gives another result than recorded";
    }
    int32_t count;
    const uint32_t* made = FindNew(recorded->row, recorded->arguments, &count);
    KIRI_TIMES_WHILE(result >= 0, i, count) {
        if (made[i] != then->made[i]) {
            return "makes other ids than recorded";
        }
    }
    bool isSame = !then->hasHash || then->hash == kiriStateHash_Of(world);
    return isSame ? NULL : "leads to another state than recorded";
}

static kiriResult FailToRead(ReadFault at, const kiriReplay* replay, kiriFault* fault)
{
    if (at == READ_NO_MEMORY) {
        KIRI_SAY(fault, "out of memory; the call may be tried again");
        return KIRI_ERROR_MEMORY;
    }
    KIRI_SAY(fault, "after call %lld, from byte %lld on: %s", (long long)replay->calls, (long long)replay->offset,
             at == READ_SHORT   ? "the recording ends too early"
             : at == READ_OTHER_VERSION ? "the recording is of another version"
                                      : "the bytes are damaged, or no recording");
    return KIRI_ERROR_DATA;
}

/* Counts a call that was made. Returns true if the replay stops there. */
static bool Pass(kiriReplay* replay, const Recorded* recorded, kiriResult result, int64_t bytes)
{
    bool isTick = recorded->number == KIRI_CALL_World_Tick && (result >= 0 || result == KIRI_DIVERGED);
    bool isNote =
        recorded->number == KIRI_CALL_World_Note && recorded->outcome.result == KIRI_OK && recorded->hasOutcome;
    replay->offset += bytes;
    ++replay->calls;
    replay->ticks += isTick;
    replay->noteCount = isNote ? *(const int32_t*)recorded->arguments[1] : 0;
    KIRI_ASSERT(bytes > 0 && replay->noteCount >= 0);
    replay->note = isNote ? recorded->argumentsEnd - replay->noteCount : NULL;
    return isTick || isNote;
}

/* Makes the next call, unless it was refused memory when it was recorded. */
static kiriResult MakeNext(kiriWorld* world, Coder* coder, kiriReplay* replay, kiriFault* fault)
{
    Recorded recorded;
    const uint8_t* start = coder->at;
    ReadCall(coder, &recorded, replay->calls == 0);
    if (coder->fault != READ_FINE) {
        return FailToRead(coder->fault, replay, fault);
    }
    KIRI_ASSERT(world->isBusy && recorded.row->make != NULL);
    bool wasRefused = recorded.hasOutcome && recorded.outcome.result == KIRI_ERROR_MEMORY;
    world->isBusy = false;
    kiriResult result = wasRefused ? KIRI_ERROR_MEMORY : recorded.row->make(world, recorded.arguments);
    world->isBusy = true;
    if (!wasRefused && result == KIRI_ERROR_MEMORY) {
        return FailToRead(READ_NO_MEMORY, replay, fault);
    }
    bool isStop = Pass(replay, &recorded, result, coder->at - start);
    const char* how = !recorded.hasOutcome ? "is the last one: the recording ends within it"
                      : wasRefused         ? NULL
                                           : FindDifference(world, &recorded, result);
    if (how != NULL) {
        KIRI_SAY(fault, "call %lld, %s in tick %lld, %s", (long long)replay->calls, recorded.row->name,
                 (long long)replay->ticks, how);
        return recorded.hasOutcome ? KIRI_ERROR_REPLAY : KIRI_ERROR_DATA;
    }
    return isStop ? KIRI_PENDING : KIRI_OK;
}

static kiriResult MakeUpToStop(kiriWorld* world, Coder* coder, kiriReplay* replay, kiriFault* fault)
{
    const uint8_t* start = coder->at;
    if (replay->offset == 0) {
        CodeStart(coder);
        if (coder->fault != READ_FINE) {
            return FailToRead(coder->fault, replay, fault);
        }
        replay->offset = coder->at - start;
    }
    kiriResult result = KIRI_OK;
    while (result == KIRI_OK && coder->at != coder->end) {
        result = MakeNext(world, coder, replay, fault);
        kiriMemory_FreeAll(coder->memory);
    }
    return result;
}

kiriResult kiriWorld_Replay(kiriWorld* world, const void* recording, int64_t size, kiriReplay* replay)
{
    KIRI_PREPARES(world);
    KIRI_CHECK_OUT(recording);
    KIRI_CHECK_OUT(replay);
    KIRI_CHECK_NUMBER(size, 0, FLT_MAX);
    KIRI_CHECK_NUMBER(replay->offset, 0, size);
    bool isNew = world->ticks == 0 && world->sheetIds.slots.count == 0 && world->obstacleIds.slots.count == 0 &&
                 world->bladeIds.slots.count == 0;
    if (replay->offset == 0 && !isNew) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the world is not new");
    }
    const uint8_t* bytes = recording;
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    Coder coder = { NULL, bytes + replay->offset, bytes + size, &scratch, READ_FINE };
    kiriFault fault = { "" };
    replay->note = NULL;
    replay->noteCount = 0;
    kiriResult result = MakeUpToStop(world, &coder, replay, &fault);
    world->errorLine[0] = '\0';
    return KIRI_FAIL(result, fault.line);
}
