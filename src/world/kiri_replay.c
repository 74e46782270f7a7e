/* Makes the calls of a recording again. */
#include "kiri_call.h"
#include "kiri_state.h"

#include <stdio.h>
#include <string.h>

/* A call as a recording has it. */
typedef struct Recorded {
    const kiriRecordCall* shape;
    uint64_t number;
    const void* arguments[KIRI_RECORD_ARGUMENTS];
    const void* outcome[KIRI_RECORD_ARGUMENTS]; /* what the recorded call wrote */
    kiriRecordValue values[KIRI_RECORD_ARGUMENTS], outcomes[KIRI_RECORD_ARGUMENTS];
    const uint8_t* argumentsEnd;
    kiriResult result;
    bool hasResult; /* else the recording ends within the call */
} Recorded;

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static void ReadStart(kiriCoder* coder)
{
    bool isOurs = true;
    for (int i = 0; i < KIRI_RECORD_MAGIC_BYTES; ++i) {
        uint8_t byte = 0;
        kiriCoder_Byte(coder, &byte);
        isOurs = isOurs && byte == kiriRecordMagic[i];
    }
    uint64_t format = 0, library = 0;
    kiriCoder_Unsigned(coder, &format);
    kiriCoder_Unsigned(coder, &library);
    if (!isOurs || format != KIRI_RECORD_VERSION) {
        kiriCoder_Stop(coder, isOurs && format > KIRI_RECORD_VERSION ? KIRI_CODER_NEWER : KIRI_CODER_DAMAGED);
    }
}

/* Room for what the recorded call wrote: as for the one that is to be made. */
static void FindRoom(kiriCoder* coder, Recorded* recorded)
{
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS; ++i) {
        bool isArray = recorded->shape->arguments[i].kind == KIRI_ARGUMENT_NEW_IDS;
        int32_t count = isArray ? recorded->values[i - 1].number : 0;
        recorded->outcome[i] = recorded->arguments[i];
        if (count > 0 && recorded->arguments[i] != NULL) {
            recorded->outcome[i] = kiriMemory_AllocZeroed(coder->memory, 4 * (int64_t)count);
        } else if (recorded->shape->arguments[i].kind >= KIRI_ARGUMENT_NEW_ID && recorded->arguments[i] != NULL) {
            recorded->outcome[i] = &recorded->outcomes[i];
        }
        if (recorded->outcome[i] == NULL && recorded->arguments[i] != NULL) {
            kiriCoder_Stop(coder, KIRI_CODER_MEMORY);
        }
    }
}

static void ReadOutcome(kiriCoder* coder, Recorded* recorded)
{
    recorded->hasResult = coder->fault == KIRI_CODER_FINE && coder->at != coder->end;
    if (recorded->hasResult) {
        FindRoom(coder, recorded);
    }
    if (recorded->hasResult && coder->fault == KIRI_CODER_FINE) {
        kiriRecord_CodeOutcome(coder, recorded->shape, recorded->outcome, &recorded->result);
    }
}

/* A world is made first, and goes last. */
static bool IsInPlace(const kiriCoder* coder, uint64_t number, bool isFirst)
{
    bool isLast = coder->at == coder->end;
    return (number == KIRI_CALL_CREATE_WORLD) == isFirst && (number != KIRI_CALL_DESTROY_WORLD || isLast);
}

static void ReadCall(kiriCoder* coder, Recorded* recorded, bool isFirst)
{
    uint64_t nulls = 0;
    memset(recorded, 0, sizeof(*recorded));
    kiriCoder_Unsigned(coder, &recorded->number);
    if ((recorded->number & 1) != 0) {
        kiriCoder_Unsigned(coder, &nulls);
    }
    recorded->number >>= 1;
    recorded->shape = kiriRecord_Find(recorded->number);
    if (recorded->shape == NULL) {
        kiriCoder_Stop(coder, recorded->number >= KIRI_CALL_COUNT ? KIRI_CODER_NEWER : KIRI_CODER_DAMAGED);
        return;
    }
    kiriRecord_CodeArguments(coder, recorded->shape, recorded->arguments, recorded->values, nulls);
    recorded->argumentsEnd = coder->at;
    ReadOutcome(coder, recorded);
    if (!IsInPlace(coder, recorded->number, isFirst)) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
    }
}

/* ---- Comparing --------------------------------------------------------------------------------------------------- */

static bool AreSameIds(const Recorded* recorded, int i)
{
    const uint32_t *now = recorded->arguments[i], *then = recorded->outcome[i];
    int32_t count = recorded->shape->arguments[i].kind == KIRI_ARGUMENT_NEW_IDS ? recorded->values[i - 1].number : 1;
    for (int32_t k = 0; k < count; ++k) {
        if (now[k] != then[k]) {
            return false;
        }
    }
    return true;
}

static bool IsSameState(const kiriWorld* world, const Recorded* recorded)
{
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS; ++i) {
        const kiriRecordHash* then = recorded->outcome[i];
        if (recorded->shape->arguments[i].kind == KIRI_ARGUMENT_HASH && then->isThere != 0 &&
            then->hash != kiriStateHash_Of(world)) {
            return false;
        }
    }
    return true;
}

static bool IsSameOutcome(const Recorded* recorded)
{
    for (int i = 0; i < KIRI_RECORD_ARGUMENTS; ++i) {
        kiriArgumentKind kind = recorded->shape->arguments[i].kind;
        if (kind >= KIRI_ARGUMENT_NEW_ID && kind != KIRI_ARGUMENT_HASH && recorded->arguments[i] != NULL &&
            !AreSameIds(recorded, i)) {
            return false;
        }
    }
    return true;
}

static const char* Difference(const kiriWorld* world, const Recorded* recorded, kiriResult result)
{
    if (result != recorded->result) {
        return "gives another result than recorded";
    }
    if (result >= 0 && !IsSameOutcome(recorded)) {
        return "makes other ids than recorded";
    }
    return IsSameState(world, recorded) ? NULL : "leads to another state than recorded";
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

enum { REASON_BYTES = 160 };

static kiriResult FailToRead(kiriCoderFault fault, const kiriReplay* replay, char why[REASON_BYTES])
{
    const char* reason = fault == KIRI_CODER_SHORT   ? "the recording ends too early"
                         : fault == KIRI_CODER_NEWER ? "the recording is damaged, or of a later version"
                                                     : "the bytes are damaged, or no recording";
    if (fault == KIRI_CODER_MEMORY) {
        snprintf(why, REASON_BYTES, "out of memory; the call may be tried again");
        return KIRI_ERROR_MEMORY;
    }
    snprintf(why, REASON_BYTES, "after call %lld, from byte %lld on: %s", (long long)replay->calls,
             (long long)replay->offset, reason);
    return KIRI_ERROR_DATA;
}

static kiriResult FailInCall(const Recorded* recorded, const kiriReplay* replay, kiriResult result, const char* how,
                             char why[REASON_BYTES])
{
    snprintf(why, REASON_BYTES, "call %lld, %s in tick %lld, %s", (long long)replay->calls, recorded->shape->name,
             (long long)replay->ticks, how);
    return result;
}

/* True where a replay stops. */
static bool Pass(kiriReplay* replay, const Recorded* recorded, kiriResult result, int64_t bytes)
{
    bool isTick = recorded->number == KIRI_CALL_WORLD_TICK && (result >= 0 || result == KIRI_DIVERGED);
    bool isNote = recorded->number == KIRI_CALL_WORLD_NOTE && recorded->result == KIRI_OK && recorded->hasResult;
    replay->offset += bytes;
    ++replay->calls;
    replay->ticks += isTick;
    replay->noteCount = isNote ? recorded->values[1].number : 0;
    replay->note = isNote ? recorded->argumentsEnd - replay->noteCount : NULL;
    return isTick || isNote;
}

/* The call, unless it was refused memory. */
static kiriResult MakeRecorded(kiriWorld* world, const Recorded* recorded, kiriReplay* replay, int64_t bytes,
                               char why[REASON_BYTES])
{
    bool wasRefused = recorded->hasResult && recorded->result == KIRI_ERROR_MEMORY;
    world->isBusy = false;
    kiriResult result = wasRefused ? KIRI_ERROR_MEMORY : recorded->shape->make(world, recorded->arguments);
    world->isBusy = true;
    if (!wasRefused && result == KIRI_ERROR_MEMORY) {
        return FailToRead(KIRI_CODER_MEMORY, replay, why);
    }
    bool isStop = Pass(replay, recorded, result, bytes);
    if (!recorded->hasResult) {
        return FailInCall(recorded, replay, KIRI_ERROR_DATA, "is the last one: the recording ends within it", why);
    }
    const char* how = wasRefused ? NULL : Difference(world, recorded, result);
    if (how != NULL) {
        return FailInCall(recorded, replay, KIRI_ERROR_REPLAY, how, why);
    }
    return isStop ? KIRI_PENDING : KIRI_OK;
}

static kiriResult MakeNext(kiriWorld* world, kiriCoder* coder, kiriReplay* replay, char why[REASON_BYTES])
{
    Recorded recorded;
    const uint8_t* start = coder->at;
    ReadCall(coder, &recorded, replay->calls == 0);
    if (coder->fault != KIRI_CODER_FINE) {
        return FailToRead(coder->fault, replay, why);
    }
    return MakeRecorded(world, &recorded, replay, coder->at - start, why);
}

static kiriResult MakeUpToStop(kiriWorld* world, kiriCoder* coder, kiriReplay* replay, char why[REASON_BYTES])
{
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    const uint8_t* start = coder->at;
    coder->memory = &scratch;
    if (replay->offset == 0) {
        ReadStart(coder);
        if (coder->fault != KIRI_CODER_FINE) {
            return FailToRead(coder->fault, replay, why);
        }
        replay->offset = coder->at - start;
    }
    kiriResult result = KIRI_OK;
    while (result == KIRI_OK && coder->at != coder->end) {
        result = MakeNext(world, coder, replay, why);
        kiriMemory_FreeAll(&scratch);
    }
    return result;
}

static bool IsNew(const kiriWorld* world)
{
    return world->ticks == 0 && world->sheetIds.slots.count == 0 && world->obstacleIds.slots.count == 0 &&
           world->bladeIds.slots.count == 0;
}

kiriResult kiriWorld_Replay(kiriWorld* world, const void* recording, int64_t size, kiriReplay* replay)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(recording != NULL && size >= 0, "recording is null, or size below 0");
    KIRI_CHECK(replay != NULL && replay->offset >= 0 && replay->offset <= size,
               "replay is null, or its offset not within the recording");
    if (replay->offset == 0 && !IsNew(world)) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the world is not new");
    }
    const uint8_t* bytes = recording;
    kiriCoder coder = { NULL, bytes + replay->offset, bytes + size, NULL, KIRI_CODER_FINE };
    char why[REASON_BYTES];
    replay->note = NULL;
    replay->noteCount = 0;
    kiriResult result = MakeUpToStop(world, &coder, replay, why);
    line[0] = '\0';
    KIRI_RETURN_OR_SAY(result, why);
}
