/* Recording: what functions that change the world were given, and what came of it, as bytes for the host. A table
   (kiri_call.c) says for each of them what its arguments are; one function (kiriRecord_CodeArguments) writes
   them by it, and reads them for kiriWorld_Replay. */
#ifndef KIRI_CALL_H
#define KIRI_CALL_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* The numbers of calls in recordings. A number never gets another meaning, nor is used again. */
enum kiriCallNumber {
    KIRI_CALL_CREATE_WORLD = 1,
    KIRI_CALL_DESTROY_WORLD = 2,
    KIRI_CALL_WORLD_TICK = 3,
    KIRI_CALL_WORLD_SET_GRAVITY = 4,
    KIRI_CALL_WORLD_SET_BUDGET = 5,
    KIRI_CALL_WORLD_NOTE = 6,
    KIRI_CALL_CREATE_SHEET = 7,
    KIRI_CALL_DESTROY_SHEET = 8,
    KIRI_CALL_SHEET_SET_SETTINGS = 9,
    KIRI_CALL_SHEET_WAKE = 10,
    KIRI_CALL_SHEET_TRANSFORM = 11,
    KIRI_CALL_SHEET_SET_VELOCITY = 12,
    KIRI_CALL_FRAME_SET_PIECE_VELOCITY = 13,
    KIRI_CALL_SHEET_SET_USER_DATA = 14,
    KIRI_CALL_PIN_SET_USER_DATA = 15,
    KIRI_CALL_FRAME_SET_PIECE_USER_DATA = 16,
    KIRI_CALL_FRAME_DETACH_PIECE = 17,
    KIRI_CALL_FRAME_DESTROY_PIECE = 18,
    KIRI_CALL_WORLD_DETACH_PIECES = 19,
    KIRI_CALL_WORLD_DESTROY_PIECES = 20,
    KIRI_CALL_SHEET_DROP_CRUMBS = 21,
    KIRI_CALL_BEGIN_CUT = 22,
    KIRI_CALL_CUT_EXTEND = 23,
    KIRI_CALL_CUT_END = 24,
    KIRI_CALL_SHEET_SLICE = 25,
    KIRI_CALL_BEGIN_BLADE = 26,
    KIRI_CALL_BLADE_MOVE_EDGE = 27,
    KIRI_CALL_BLADE_MOVE_RAY = 28,
    KIRI_CALL_BLADE_END = 29,
    KIRI_CALL_FRAME_HOLD = 30,
    KIRI_CALL_FRAME_APPLY_FORCE = 31,
    KIRI_CALL_SHEET_APPLY_FORCE = 32,
    KIRI_CALL_SHEET_APPLY_LINE_LOAD = 33,
    KIRI_CALL_SHEET_APPLY_PRESSURE = 34,
    KIRI_CALL_SHEET_APPLY_IMPULSE = 35,
    KIRI_CALL_SHEET_SET_WIND = 36,
    KIRI_CALL_CREATE_PIN = 37,
    KIRI_CALL_SHEET_CLAMP_LINE = 38,
    KIRI_CALL_SHEET_HINGE_LINE = 39,
    KIRI_CALL_PIN_SET_TARGET = 40,
    KIRI_CALL_PIN_SET_POSE = 41,
    KIRI_CALL_PIN_SET_BREAK_FORCE = 42,
    KIRI_CALL_DESTROY_PIN = 43,
    KIRI_CALL_SHEET_SET_CONTACTS = 44,
    KIRI_CALL_CREATE_OBSTACLE = 45,
    KIRI_CALL_DESTROY_OBSTACLE = 46,
    KIRI_CALL_OBSTACLE_SET_POSE = 47,
    KIRI_CALL_OBSTACLE_SET_VELOCITY = 48,
    KIRI_CALL_OBSTACLE_SET_SURFACE_VELOCITY = 49,
    KIRI_CALL_OBSTACLE_SET_MASS = 50,
    KIRI_CALL_WORLD_LOAD = 51,
    KIRI_CALL_WORLD_SHIFT_ORIGIN = 54,
    KIRI_CALL_WORLD_FINISH_CUTS = 55,
    KIRI_CALL_COUNT
};

enum {
    KIRI_RECORD_VERSION = 1,
    KIRI_RECORD_MAGIC_BYTES = 8,
    KIRI_RECORD_ARGUMENTS = 5, /* that a call has at most, without its world */
    KIRI_RECORD_FLOATS = 12    /* that an argument has at most, but for arrays with a count */
};

extern const uint8_t kiriRecordMagic[KIRI_RECORD_MAGIC_BYTES];

/* ---- The table ---- */

typedef enum kiriFieldKind {
    KIRI_FIELD_FLOATS, /* so many */
    KIRI_FIELD_INTS,   /* so many */
    KIRI_FIELD_ID,
    KIRI_FIELD_FLOATS_AT, /* a pointer to so many for each that `counted` counts */
    KIRI_FIELD_INDICES_AT
} kiriFieldKind;

typedef struct kiriRecordField {
    kiriFieldKind kind;
    int32_t count, offset;
    int32_t counted;                 /* the offset of an int32_t, which comes before */
    bool (*isRead)(const void* def); /* whether its call reads the array: else nobody knows that it is one */
} kiriRecordField;

/* New fields come last: recordings of older versions have fewer. */
typedef struct kiriRecordStruct {
    int32_t bytes;
    uint32_t cookie; /* its first field, or 0: it has none */
    int32_t fieldCount;
    const kiriRecordField* fields;
    void (*fill)(void* def); /* with what fields have that a recording has not; null: zeros */
} kiriRecordStruct;

typedef enum kiriArgumentKind {
    KIRI_ARGUMENT_NONE, /* there are no more */

    /* By value. */
    KIRI_ARGUMENT_ID,
    KIRI_ARGUMENT_INT,
    KIRI_ARGUMENT_FLOAT,
    KIRI_ARGUMENT_DATA,  /* 64 bits */
    KIRI_ARGUMENT_COUNT, /* of the array just before */

    /* Pointers to what the call reads; arrays have `most` items at most, or the call reads none of them. */
    KIRI_ARGUMENT_FLOATS,
    KIRI_ARGUMENT_STRUCT,
    KIRI_ARGUMENT_POINTS, /* arrays: of 2 floats, */
    KIRI_ARGUMENT_IDS,
    KIRI_ARGUMENT_STRUCTS,
    KIRI_ARGUMENT_BYTES,

    /* Pointers to where the call writes. */
    KIRI_ARGUMENT_NEW_ID,
    KIRI_ARGUMENT_NEW_IDS, /* as many as the count just before */
    KIRI_ARGUMENT_NEW_INT,
    KIRI_ARGUMENT_HASH /* no argument: the state hash afterwards, see kiriRecordHash */
} kiriArgumentKind;

typedef struct kiriRecordArgument {
    kiriArgumentKind kind;
    int32_t count, most;
    const kiriRecordStruct* of;
} kiriRecordArgument;

typedef struct kiriRecordHash {
    int32_t isThere;
    uint64_t hash;
} kiriRecordHash;

/* `arguments`: pointers to those that go by value, and the others themselves. */
typedef kiriResult kiriMakeCallFn(kiriWorld* world, const void* const* arguments);

typedef struct kiriRecordCall {
    const char* name;
    kiriRecordArgument arguments[KIRI_RECORD_ARGUMENTS];
    kiriMakeCallFn* make;
} kiriRecordCall;

/* Null for a number that no call has. */
const kiriRecordCall* kiriRecord_Find(uint64_t number);

/* ---- Coding ---- */

/* Room for what an argument points to. */
typedef union kiriRecordValue {
    uint32_t id;
    int32_t number;
    float real, reals[KIRI_RECORD_FLOATS];
    uint64_t data;
    kiriRecordHash hash;
} kiriRecordValue;

/* A coder that reads makes the arguments: they are, or have room, in values, which is zeroed, or in its memory. */
void kiriRecord_CodeArguments(kiriCoder* coder, const kiriRecordCall* call, const void* arguments[],
                              kiriRecordValue values[], uint64_t nulls);

/* One bit for each argument that is null. */
uint64_t kiriRecord_FindNulls(const kiriRecordCall* call, const void* const arguments[]);

/* The result, and what the call wrote to its arguments. */
void kiriRecord_CodeOutcome(kiriCoder* coder, const kiriRecordCall* call, const void* const arguments[],
                            kiriResult* result);

/* ---- Recording ---- */

/* A call that is being recorded. */
typedef struct kiriCall {
    kiriWorld* world;
    int32_t number;
    const void* const* arguments;
} kiriCall;

void kiriRecord_Start(kiriWorld* world, const kiriWorldDef* def);

/* Hands over the arguments before the call does anything: so they are there even if it never returns. Null: nothing is
   recorded. */
const kiriCall* kiriRecord_Begin(const kiriCall* call);
void kiriRecord_End(const kiriCall* call, kiriResult result);

/* Before a world goes. */
void kiriRecord_Stop(kiriWorld* world);

/* What every public function does first: it looks at its arguments, turns ids into pointers, and says in one line what
   is wrong. */

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
