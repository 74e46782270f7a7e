/* Recordings: the calls that change a world, and what they returned, as bytes; and replays, which make the calls again. */
#include "kiri_call.h"
#include "kiri_state.h"

#include <stdio.h>
#include <string.h>

static const uint8_t magic[KIRI_RECORD_MAGIC_BYTES] = { 'K', 'i', 'r', 'i', 'R', 'e', 'c', '\n' };

/* ---- Coding ------------------------------------------------------------------------------------------------------ */

/* A coder either writes or reads, see kiri_archive.h. Values that are written have been checked, but for those of
   KIRI_ARGUMENT_SAVE; values that are read have not. */

static void CodeStruct(kiriCoder* coder, const kiriStruct* of, char* at);

static void CodeFloats(kiriCoder* coder, float* values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        kiriCoder_Float(coder, &values[i]);
    }
}

static void CodeValue(kiriCoder* coder, const kiriValue* value, void* at)
{
    switch (value->form) {
    case KIRI_FORM_INTS: /* unsigned ones too: all bits set is -1, one byte */
        for (int32_t i = 0; i < value->count; ++i) {
            kiriCoder_Int(coder, (int32_t*)at + i);
        }
        break;
    case KIRI_FORM_FLOATS:
        CodeFloats(coder, at, value->count);
        break;
    case KIRI_FORM_BYTE:
        kiriCoder_Byte(coder, at);
        break;
    case KIRI_FORM_DATA:
        kiriCoder_Unsigned(coder, at);
        break;
    case KIRI_FORM_ID:
        kiriCoder_Id(coder, at);
        break;
    case KIRI_FORM_STRUCT:
        CodeStruct(coder, value->of, at);
        break;
    default: /* counts are coded with their arrays, results with the result */
        break;
    }
}

/* Codes whether something is there. */
static bool CodePresence(kiriCoder* coder, bool isThere)
{
    uint8_t byte = isThere;
    kiriCoder_Byte(coder, &byte);
    if (byte > 1) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
    }
    return byte == 1;
}

static void CodeArrayOf(kiriCoder* coder, const kiriValue* member, char* def)
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
    if (kiriCoder_Reads(coder)) {
        array = count > 0 ? kiriCoder_Alloc(coder, numbers, 4, isFloats ? 4 : 1) : NULL;
        memcpy(def + member->offset, &array, sizeof(array));
    }
    if (array != NULL && isFloats) {
        CodeFloats(coder, array, numbers);
    } else if (array != NULL) {
        kiriCoder_Indices(coder, array, numbers);
    }
}

static void CodeStruct(kiriCoder* coder, const kiriStruct* of, char* at)
{
    if (kiriCoder_Reads(coder) && of->cookie != 0) {
        memcpy(at, &of->cookie, sizeof(of->cookie));
    }
    for (int32_t i = 0; i < of->count; ++i) {
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
        return value->of->bytes;
    case KIRI_FORM_BYTE:
        return 1;
    case KIRI_FORM_DATA:
        return sizeof(uint64_t);
    default:
        return (int32_t)sizeof(uint32_t) * kiriMax(value->count, 1);
    }
}

/* Codes the count, which is the next argument, and then the items. */
static void CodeArray(kiriCoder* coder, const kiriValue* value, const void** at)
{
    int32_t count = kiriCoder_Reads(coder) ? 0 : *(const int32_t*)at[1];
    kiriCoder_Int(coder, &count);
    bool isInRange = value->low > value->high || (count >= value->low && count <= value->high);
    if (kiriCoder_Reads(coder)) {
        int32_t* own = kiriMemory_AllocZeroed(coder->memory, sizeof(count));
        at[0] = isInRange && count > 0 ? kiriCoder_Alloc(coder, count, BytesOf(value->item), 1) : NULL;
        at[1] = own;
        if (own == NULL || !isInRange) {
            kiriCoder_Stop(coder, own == NULL ? KIRI_CODER_MEMORY : KIRI_CODER_DAMAGED);
            return;
        }
        *own = count;
    }
    for (int32_t i = 0; at[0] != NULL && i < count; ++i) {
        CodeValue(coder, value->item, (char*)at[0] + (int64_t)i * BytesOf(value->item));
    }
}

/* Codes the arguments of a call. If the coder reads they lie in its memory. */
static void CodeArguments(kiriCoder* coder, const kiriCallRow* row, const void* at[])
{
    for (int i = 0; i < KIRI_CALL_ARGUMENTS && coder->fault == KIRI_CODER_FINE; ++i) {
        const kiriValue* value = &kiriArguments[row->kinds[i]];
        if (row->kinds[i] == KIRI_ARGUMENT_NONE || value->form == KIRI_FORM_COUNT) {
            continue;
        }
        if (value->form == KIRI_FORM_ARRAY) {
            CodeArray(coder, value, &at[i]);
            continue;
        }
        if (value->isOptional && value->form == KIRI_FORM_FLOATS && !CodePresence(coder, at[i] != NULL)) {
            continue;
        }
        if (kiriCoder_Reads(coder)) {
            int64_t items = value->form == KIRI_FORM_NEWS ? *(const int32_t*)at[i - 1] : 1;
            at[i] = kiriMemory_AllocZeroed(coder->memory, BytesOf(value) * kiriMax(items, 1));
            if (at[i] == NULL) {
                kiriCoder_Stop(coder, KIRI_CODER_MEMORY);
                return;
            }
        }
        CodeValue(coder, value, (void*)at[i]);
    }
}

/* Returns the ids, or the number, that the call writes, and their count. */
static uint32_t* FindNew(const kiriCallRow* row, const void* const at[], int32_t* count)
{
    for (int i = 0; i < KIRI_CALL_ARGUMENTS; ++i) {
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

static void CodeOutcome(kiriCoder* coder, int32_t number, Outcome* outcome)
{
    kiriCoder_Int(coder, &outcome->result);
    for (int32_t i = 0; outcome->result >= 0 && i < outcome->madeCount; ++i) {
        kiriCoder_Id(coder, &outcome->made[i]);
    }
    if (number == KIRI_CALL_World_Tick || number == KIRI_CALL_DestroyWorld) {
        outcome->hasHash = CodePresence(coder, outcome->hasHash);
    }
    if (outcome->hasHash) {
        kiriCoder_Hash(coder, &outcome->hash);
    }
}

/* ---- Recording --------------------------------------------------------------------------------------------------- */

static kiriCoder WriterOf(kiriWorld* world)
{
    kiriCoder coder = { &world->recorder.sink, NULL, NULL, NULL, KIRI_CODER_FINE };
    return coder;
}

void kiriRecord_Begin(const kiriCall* call)
{
    kiriCoder coder = WriterOf(call->world);
    const kiriCallRow* row = &kiriCallRows[call->number];
    const void* at[KIRI_CALL_ARGUMENTS] = { NULL };
    uint64_t number = (uint64_t)call->number;
    KIRI_ASSERT(!call->world->recorder.isOpen);
    call->world->recorder.isOpen = true;
    for (int i = 0; i < KIRI_CALL_ARGUMENTS && row->kinds[i] != KIRI_ARGUMENT_NONE; ++i) {
        at[i] = call->arguments[i];
    }
    kiriCoder_Unsigned(&coder, &number);
    CodeArguments(&coder, row, at);
    kiriSink_Flush(coder.sink);
}

void kiriRecord_End(const kiriCall* call, kiriResult result)
{
    kiriRecorder* recorder = &call->world->recorder;
    kiriCoder coder = WriterOf(call->world);
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
    kiriSink_Flush(coder.sink);
}

static void RecordWhole(kiriWorld* world, int32_t number, const void* const arguments[])
{
    const kiriCall call = { .world = world, .number = number, .arguments = arguments };
    kiriRecord_Begin(&call);
    kiriRecord_End(&call, KIRI_OK);
}

/* Codes what a recording begins with: magic, format and version of the library. */
static void CodeStart(kiriCoder* coder)
{
    uint64_t format = KIRI_RECORD_VERSION, library = KIRI_VERSION;
    for (int i = 0; i < KIRI_RECORD_MAGIC_BYTES; ++i) {
        uint8_t byte = magic[i];
        kiriCoder_Byte(coder, &byte);
        if (byte != magic[i]) {
            kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
        }
    }
    kiriCoder_Unsigned(coder, &format);
    kiriCoder_Unsigned(coder, &library);
    if (format != KIRI_RECORD_VERSION || library / 100 != KIRI_VERSION / 100) {
        kiriCoder_Stop(coder, KIRI_CODER_NEWER);
    }
}

void kiriRecord_Start(kiriWorld* world, const kiriWorldDef* def)
{
    kiriRecorder* recorder = &world->recorder;
    if (def->record != NULL) {
        recorder->sink.write = def->record;
        recorder->sink.user = def->user;
        recorder->hashTicks = def->recordHashTicks;
        kiriCoder coder = WriterOf(world);
        const void* const arguments[] = { def->gravity, &def->budget };
        CodeStart(&coder);
        RecordWhole(world, KIRI_CALL_CreateWorld, arguments);
    }
}

void kiriRecord_Stop(kiriWorld* world)
{
    if (world->recorder.sink.write != NULL) {
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
    bool hasOutcome; /* else the recording ends within the call */
} Recorded;

static void ReadOutcome(kiriCoder* coder, Recorded* recorded)
{
    Outcome* outcome = &recorded->outcome;
    recorded->hasOutcome = coder->fault == KIRI_CODER_FINE && coder->at != coder->end;
    if (!recorded->hasOutcome) {
        return;
    }
    FindNew(recorded->row, recorded->arguments, &outcome->madeCount);
    if (outcome->madeCount > 0) {
        outcome->made = kiriMemory_AllocZeroed(coder->memory, (int64_t)sizeof(uint32_t) * outcome->madeCount);
        if (outcome->made == NULL) {
            kiriCoder_Stop(coder, KIRI_CODER_MEMORY);
            return;
        }
    }
    CodeOutcome(coder, (int32_t)recorded->number, outcome);
}

static void ReadCall(kiriCoder* coder, Recorded* recorded, bool isFirst)
{
    memset(recorded, 0, sizeof(*recorded));
    kiriCoder_Unsigned(coder, &recorded->number);
    if (recorded->number >= KIRI_CALL_COUNT) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
        return;
    }
    recorded->row = &kiriCallRows[recorded->number];
    CodeArguments(coder, recorded->row, recorded->arguments);
    recorded->argumentsEnd = coder->at;
    ReadOutcome(coder, recorded);
    /* A world is made first, and goes last. */
    bool isLast = coder->at == coder->end;
    if ((recorded->number == KIRI_CALL_CreateWorld) != isFirst ||
        (recorded->number == KIRI_CALL_DestroyWorld && !isLast)) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
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
    for (int32_t i = 0; result >= 0 && i < count; ++i) {
        if (made[i] != then->made[i]) {
            return "makes other ids than recorded";
        }
    }
    bool isSame = !then->hasHash || then->hash == kiriStateHash_Of(world);
    return isSame ? NULL : "leads to another state than recorded";
}

static kiriResult FailToRead(kiriCoderFault at, const kiriReplay* replay, kiriFault* fault)
{
    if (at == KIRI_CODER_MEMORY) {
        KIRI_SAY(fault, "out of memory; the call may be tried again");
        return KIRI_ERROR_MEMORY;
    }
    KIRI_SAY(fault, "after call %lld, from byte %lld on: %s", (long long)replay->calls, (long long)replay->offset,
             at == KIRI_CODER_SHORT   ? "the recording ends too early"
             : at == KIRI_CODER_NEWER ? "the recording is of another version"
                                      : "the bytes are damaged, or no recording");
    return KIRI_ERROR_DATA;
}

/* Counts a call that was made. Returns whether the replay stops there. */
static bool Pass(kiriReplay* replay, const Recorded* recorded, kiriResult result, int64_t bytes)
{
    bool isTick = recorded->number == KIRI_CALL_World_Tick && (result >= 0 || result == KIRI_DIVERGED);
    bool isNote =
        recorded->number == KIRI_CALL_World_Note && recorded->outcome.result == KIRI_OK && recorded->hasOutcome;
    replay->offset += bytes;
    ++replay->calls;
    replay->ticks += isTick;
    replay->noteCount = isNote ? *(const int32_t*)recorded->arguments[1] : 0;
    replay->note = isNote ? recorded->argumentsEnd - replay->noteCount : NULL;
    return isTick || isNote;
}

/* Makes the next call, unless it was refused memory when it was recorded. */
static kiriResult MakeNext(kiriWorld* world, kiriCoder* coder, kiriReplay* replay, kiriFault* fault)
{
    Recorded recorded;
    const uint8_t* start = coder->at;
    ReadCall(coder, &recorded, replay->calls == 0);
    if (coder->fault != KIRI_CODER_FINE) {
        return FailToRead(coder->fault, replay, fault);
    }
    bool wasRefused = recorded.hasOutcome && recorded.outcome.result == KIRI_ERROR_MEMORY;
    world->isBusy = false;
    kiriResult result = wasRefused ? KIRI_ERROR_MEMORY : recorded.row->make(world, recorded.arguments);
    world->isBusy = true;
    if (!wasRefused && result == KIRI_ERROR_MEMORY) {
        return FailToRead(KIRI_CODER_MEMORY, replay, fault);
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

static kiriResult MakeUpToStop(kiriWorld* world, kiriCoder* coder, kiriReplay* replay, kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    const uint8_t* start = coder->at;
    coder->memory = &scratch;
    if (replay->offset == 0) {
        CodeStart(coder);
        if (coder->fault != KIRI_CODER_FINE) {
            return FailToRead(coder->fault, replay, fault);
        }
        replay->offset = coder->at - start;
    }
    kiriResult result = KIRI_OK;
    while (result == KIRI_OK && coder->at != coder->end) {
        result = MakeNext(world, coder, replay, fault);
        kiriMemory_FreeAll(&scratch);
    }
    return result;
}

kiriResult kiriWorld_Replay(kiriWorld* world, const void* recording, int64_t size, kiriReplay* replay)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(recording != NULL && size >= 0, "recording is null, or size below 0");
    KIRI_CHECK(replay != NULL && replay->offset >= 0 && replay->offset <= size,
               "replay is null, or its offset not within the recording");
    bool isNew = world->ticks == 0 && world->sheetIds.slots.count == 0 && world->obstacleIds.slots.count == 0 &&
                 world->bladeIds.slots.count == 0;
    if (replay->offset == 0 && !isNew) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the world is not new");
    }
    const uint8_t* bytes = recording;
    kiriCoder coder = { NULL, bytes + replay->offset, bytes + size, NULL, KIRI_CODER_FINE };
    kiriFault fault = { "" };
    replay->note = NULL;
    replay->noteCount = 0;
    kiriResult result = MakeUpToStop(world, &coder, replay, &fault);
    world->errorLine[0] = '\0';
    return KIRI_FAIL(result, fault.line);
}
