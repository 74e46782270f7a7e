/* What every public function does first: it looks at its arguments, turns ids into pointers, and says in one line what
   is wrong. */
#ifndef KIRI_CALL_H
#define KIRI_CALL_H

#include "kiri_record.h"

KIRI_C_BEGIN

enum { KIRI_LINE_BYTES = sizeof(((kiriWorld*)NULL)->errorLine) };

/* The defs are stamped with their size, so that a def of another version, or a forgotten default, is found out. */
#define KIRI_COOKIE(Type) (0x4b000000u | (uint32_t)sizeof(Type))

/* How a public function begins: one that changes the world, with its number and its arguments for the recording, those
   that go by value by their address; one that only makes what somebody looks at, so that no tick depends on it; one
   that only reads. The first two keep their line in the world, the last one gives it to the log alone, so that several
   threads may read. Without a world there is only the code. */
#define KIRI_CHANGES(world, number, ...)                                                                               \
    KIRI_PREPARES_ANY(world);                                                                                          \
    const void* const callArguments[] = { __VA_ARGS__ };                                                               \
    const kiriCall thisCall = { (world), (number), callArguments };                                                    \
    const kiriCall* record = (world)->recorder.sink.write != NULL ? kiriRecord_Begin(&thisCall) : NULL

#define KIRI_PREPARES(world)                                                                                           \
    KIRI_PREPARES_ANY(world);                                                                                          \
    const kiriCall* record = NULL

/* Refuses calls from callbacks that run now, of a function that changes the world or of one that only reads. */
#define KIRI_PREPARES_ANY(world)                                                                                       \
    if ((world) == NULL) {                                                                                             \
        return KIRI_ERROR_ARGUMENT;                                                                                    \
    }                                                                                                                  \
    if ((world)->isBusy || kiriCall_IsRead(world)) {                                                                   \
        return kiriCall_Refuse(world, __func__);                                                                       \
    }                                                                                                                  \
    kiriWorld* const entered = (world);                                                                                \
    entered->isBusy = true;                                                                                            \
    char* line = (world)->errorLine;                                                                                   \
    line[0] = '\0'

#define KIRI_READS(world)                                                                                              \
    if ((world) == NULL) {                                                                                             \
        return KIRI_ERROR_ARGUMENT;                                                                                    \
    }                                                                                                                  \
    if ((world)->isBusy) {                                                                                             \
        return kiriCall_Refuse(world, __func__);                                                                       \
    }                                                                                                                  \
    kiriWorld* const entered = NULL;                                                                                   \
    char line[KIRI_LINE_BYTES];                                                                                        \
    const kiriCall* record = NULL

/* Every function that takes the world without const returns through these. Functions that only read may return results
   that are not errors directly. `why` null: the result says it all. */
#define KIRI_FAIL(result, why) kiriCall_End(entered, record, kiriCall_Fail(world, line, result, __func__, why))
#define KIRI_RETURN_OR_SAY(result, why)                                                                                \
    do {                                                                                                               \
        kiriResult outcome = (result);                                                                                 \
        return outcome < 0 ? KIRI_FAIL(outcome, why) : kiriCall_End(entered, record, outcome);                         \
    } while (0)
#define KIRI_RETURN(result) KIRI_RETURN_OR_SAY(result, NULL)

#define KIRI_CHECK(condition, why)                                                                                     \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            return KIRI_FAIL(KIRI_ERROR_ARGUMENT, why);                                                                \
        }                                                                                                              \
    } while (0)

/* Declares `pointer`, what owns the id. */
#define KIRI_FIND(Type, pointer, pool, id, kind)                                                                       \
    Type* pointer = (Type*)kiriCall_Owner(&world->pool, id);                                                           \
    do {                                                                                                               \
        if (pointer == NULL) {                                                                                         \
            return KIRI_FAIL(KIRI_ERROR_ID, "there is no " kind " with this id");                                      \
        }                                                                                                              \
    } while (0)

#define KIRI_FIND_SHEET(pointer, id) KIRI_FIND(kiriSheetData, pointer, sheetIds, id, "sheet")
#define KIRI_FIND_FRAME_SHEET(pointer, id) KIRI_FIND(kiriSheetData, pointer, frameIds, id, "frame")
#define KIRI_FIND_PIN_SHEET(pointer, id) KIRI_FIND(kiriSheetData, pointer, pinIds, id, "pin")
#define KIRI_FIND_OBSTACLE(pointer, id) KIRI_FIND(kiriObstacleData, pointer, obstacleIds, id, "obstacle")
#define KIRI_FIND_CUT(pointer, id) KIRI_FIND(kiriCutData, pointer, cutIds, id, "cut")
#define KIRI_FIND_BLADE(pointer, id) KIRI_FIND(kiriBladeData, pointer, bladeIds, id, "blade")

kiriResult kiriCall_Fail(const kiriWorld* world, char* line, kiriResult result, const char* function, const char* why);

static inline kiriResult kiriCall_End(kiriWorld* entered, const kiriCall* record, kiriResult result)
{
    if (record != NULL) {
        kiriRecord_End(record, result);
    }
    if (entered != NULL) {
        entered->isBusy = false;
    }
    return result;
}

/* Does a callback run of a function that only reads the world? */
static inline bool kiriCall_IsRead(const kiriWorld* world)
{
    return kiriWord_Read(&world->readers) != 0 || kiriWord_Read(&world->logs) != 0;
}

/* Refuses a call that a callback made on its own world: KIRI_ERROR_STATE. Keeps the error line of the running call. */
kiriResult kiriCall_Refuse(const kiriWorld* world, const char* function);

/* A function that only reads puts these two around its calls of the host's functions, except the log. */
static inline void kiriCall_BeginCallbacks(const kiriWorld* world)
{
    kiriWord_Add(&world->readers, 1);
}
static inline void kiriCall_EndCallbacks(const kiriWorld* world)
{
    kiriWord_Add(&world->readers, -1);
}

/* Null for an id that names nothing in the pool. */
void* kiriCall_Owner(const kiriPool* pool, uint32_t id);

bool kiriCall_AreFinite(const float* values, int64_t count);
bool kiriCall_IsAbove(float value, float low);
bool kiriCall_IsAtLeast(float value, float low);
bool kiriCall_IsWithin(int32_t value, int32_t low, int32_t high);
bool kiriCall_AreOrthonormal(const float a[3], const float b[3]);

/* What is wrong with the settings of a sheet, or null. Their cookie is not looked at. */
const char* kiriCall_FaultOfSettings(const kiriSheetSettings* settings);

/* What is wrong with the rotation of a part of the sheet, or null. */
const char* kiriCall_FaultOfRotation(const kiriSheetData* sheet, const float rotation[9]);

/* What is wrong with a line of the rest plane, or null and its ends. */
const char* kiriCall_FaultOfLine(const kiriSheetData* sheet, const float from[2], const float to[2],
                                 kiriLatticePoint ends[2]);

KIRI_C_END

#endif
