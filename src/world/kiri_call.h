/* How public functions begin and end. A table lists each function that changes the world, with the kinds of its
   arguments. kiriCall_Begin checks and records the arguments by this table; kiriWorld_Replay reads them and calls the
   function. Functions that only read check their few arguments inline, which is cheaper than a walk over the table. */
#ifndef KIRI_CALL_H
#define KIRI_CALL_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* ---- The table ---- */

/* X2(Name, A, B): kiriName(world, a, b) with arguments of kinds A and B. Recordings store the index of the row. */
#define KIRI_CALLS(X0, X1, X2, X3, X4)                                                                                 \
    X2(World_Tick, FLOAT, INT)                                                                                         \
    X1(World_SetGravity, VECTOR)                                                                                       \
    X1(World_ShiftOrigin, VECTOR)                                                                                      \
    X1(World_SetBudget, BUDGET)                                                                                        \
    X2(World_Note, NOTE, COUNT)                                                                                        \
    X2(World_Load, SAVE, COUNT)                                                                                        \
    X0(World_FinishCuts)                                                                                               \
    X2(CreateSheet, SHEET_DEF, NEW_ID)                                                                                 \
    X1(DestroySheet, SHEET)                                                                                            \
    X2(Sheet_SetSettings, SHEET, SETTINGS)                                                                             \
    X1(Sheet_Wake, SHEET)                                                                                              \
    X3(Sheet_Transform, SHEET, ROTATION, VECTOR)                                                                       \
    X3(Sheet_SetVelocity, SHEET, VECTOR, VECTOR)                                                                       \
    X3(Frame_SetPieceVelocity, FRAME, VECTOR, VECTOR)                                                                  \
    X2(Sheet_SetUserData, SHEET, DATA)                                                                                 \
    X2(Pin_SetUserData, PIN, DATA)                                                                                     \
    X2(Frame_SetPieceUserData, FRAME, DATA)                                                                            \
    X2(Frame_DetachPiece, FRAME, NEW_ID)                                                                               \
    X1(Frame_DestroyPiece, FRAME)                                                                                      \
    X3(World_DetachPieces, FRAMES, COUNT, NEW_IDS)                                                                     \
    X2(World_DestroyPieces, FRAMES, COUNT)                                                                             \
    X3(Sheet_DropCrumbs, SHEET, SIZE, NEW_COUNT)                                                                       \
    X3(BeginCut, SHEET, POINT, NEW_ID)                                                                                 \
    X3(Cut_Extend, CUT, POINTS, COUNT)                                                                                 \
    X1(Cut_End, CUT)                                                                                                   \
    X3(Sheet_Slice, SHEET, QUAD, NEW_ID)                                                                               \
    X2(BeginBlade, ANY_SHEET, NEW_ID)                                                                                  \
    X3(Blade_MoveEdge, BLADE, VECTOR, VECTOR)                                                                          \
    X4(Blade_MoveRay, BLADE, VECTOR, DIRECTION, LENGTH)                                                                \
    X1(Blade_End, BLADE)                                                                                               \
    X3(Frame_Hold, FRAME, VECTOR_OR_NULL, ROTATION_OR_NULL)                                                            \
    X3(Frame_ApplyForce, FRAME, VECTOR, VECTOR)                                                                        \
    X4(Sheet_ApplyForce, SHEET, POINT, VECTOR, VECTOR)                                                                 \
    X4(Sheet_ApplyLineLoad, SHEET, POINT, POINT, VECTOR)                                                               \
    X2(Sheet_ApplyPressure, SHEET, FINITE)                                                                             \
    X3(Sheet_ApplyImpulse, SHEET, POINT, VECTOR)                                                                       \
    X2(Sheet_SetWind, SHEET, WIND)                                                                                     \
    X3(CreatePin, SHEET, PIN_DEF, NEW_ID)                                                                              \
    X4(Sheet_ClampLine, SHEET, POINT, POINT, NEW_ID)                                                                   \
    X4(Sheet_HingeLine, SHEET, POINT, POINT, NEW_ID)                                                                   \
    X2(Pin_SetTarget, PIN, VECTOR)                                                                                     \
    X3(Pin_SetPose, PIN, VECTOR, ROTATION)                                                                             \
    X2(Pin_SetBreakForce, PIN, SIZE)                                                                                   \
    X1(DestroyPin, PIN)                                                                                                \
    X3(Sheet_SetContacts, SHEET, CONTACTS, COUNT)                                                                      \
    X2(CreateObstacle, OBSTACLE_DEF, NEW_ID)                                                                           \
    X1(DestroyObstacle, OBSTACLE)                                                                                      \
    X3(Obstacle_SetPose, OBSTACLE, PLACE, ROTATION)                                                                    \
    X3(Obstacle_SetVelocity, OBSTACLE, PLACE, PLACE)                                                                   \
    X2(Obstacle_SetSurfaceVelocity, OBSTACLE, PLACE)                                                                   \
    X4(Obstacle_SetMass, OBSTACLE, SIZE, INERTIA, VECTOR)                                                              \
    X2(CreateSeam, SEAM_DEF, NEW_ID)                                                                                   \
    X1(DestroySeam, SEAM)                                                                                              \
    X4(CreateFoldedSheet, SHEET_DEF, FOLDS, COUNT, NEW_ID)                                                             \
    X4(Sheet_SetFold, SHEET, INT, SIZE, FOLD_ANGLE)                                                                    \
    X3(Seam_SetHinge, SEAM, SIZE, FOLD_ANGLE)                                                                          \
    X3(Sheet_AddFold, SHEET, FOLD, NEW_COUNT)                                                                          \
    X2(Sheet_SetTearing, SHEET, TEARING)                                                                               \
    X4(Sheet_SetTearLine, SHEET, POINTS, COUNT, SIZE)                                                                  \
    X4(Sheet_Cut, SHEET, POINTS, COUNT, NEW_ID)

#define KIRI_NUMBER(Name, ...) KIRI_CALL_##Name,
#define KIRI_NUMBER0(Name) KIRI_CALL_##Name,
enum kiriCallNumber {
    KIRI_CALL_CreateWorld,
    KIRI_CALL_DestroyWorld,
    KIRI_CALLS(KIRI_NUMBER0, KIRI_NUMBER, KIRI_NUMBER, KIRI_NUMBER, KIRI_NUMBER) KIRI_CALL_COUNT
};

enum { KIRI_CALL_ARGUMENTS = 4 }; /* maximum, without the world */

/* Kinds of arguments: V for a value with a type, P for a pointer, N for a pointer to results (one a call). kiri_call.c
   says what each may be. */
#define KIRI_ARGUMENTS(V, P, N)                                                                                        \
    V(SHEET, uint32_t, ID_OF(sheet, false))                                                                            \
    V(ANY_SHEET, uint32_t, ID_OF(sheet, true)) /* or 0 */                                                              \
    V(FRAME, uint32_t, ID_OF(frame, false))                                                                            \
    V(PIN, uint32_t, ID_OF(pin, false))                                                                                \
    V(OBSTACLE, uint32_t, ID_OF(obstacle, false))                                                                      \
    V(CUT, uint32_t, ID_OF(cut, false))                                                                                \
    V(BLADE, uint32_t, ID_OF(blade, false))                                                                            \
    V(SEAM, uint32_t, ID_OF(seam, false))                                                                              \
    V(INT, int32_t, FORM(KIRI_FORM_INTS, .count = 1, ANY_NUMBER)) /* unchecked */                                      \
    V(COUNT, int32_t, FORM(KIRI_FORM_COUNT))                      /* of the array just before it */                    \
    V(FLOAT, float, FLOATS_OF(1, ANY_NUMBER))                     /* unchecked */                                      \
    V(FINITE, float, FLOATS_OF(1, ANY_FINITE))                    /* float */                                          \
    V(SIZE, float, FLOATS_OF(1, FROM_0))                          /* float, 0 or more */                               \
    V(LENGTH, float, FLOATS_OF(1, ABOVE_0))                       /* float, above 0 */                                 \
    V(FOLD_ANGLE, float, FLOATS_OF(1, WITHIN(-KIRI_MOST_FOLD, KIRI_MOST_FOLD)))                                        \
    V(DATA, uint64_t, FORM(KIRI_FORM_DATA))                       /* 64 bits */                                        \
    P(POINT, FLOATS_OF(2, ANY_FINITE))                            /* 2 floats */                                       \
    P(VECTOR, FLOATS_OF(3, ANY_FINITE))                           /* 3 floats */                                       \
    P(VECTOR_OR_NULL, FLOATS_OF(3, ANY_FINITE, .isOptional = true))                                                    \
    P(PLACE, FLOATS_OF(3, FITTING)) /* 3 floats that kiriVec3_FitsFloats accepts */                                    \
    P(DIRECTION, FLOATS_OF(3, ANY_FINITE, .fault = FaultOfDirection))                                                  \
    P(ROTATION, FLOATS_OF(9, ANY_FINITE, .fault = FaultOfRotation))                                                    \
    P(ROTATION_OR_NULL, FLOATS_OF(9, ANY_FINITE, .fault = FaultOfRotation, .isOptional = true))                        \
    P(INERTIA, FLOATS_OF(6, ANY_FINITE, .fault = FaultOfInertia))                                                      \
    P(QUAD, FLOATS_OF(12, ANY_FINITE))                                                                                 \
    P(BUDGET, STRUCT_ARGUMENT(BudgetStruct, .count = 1)) /* structs */                                                 \
    P(WIND, STRUCT_ARGUMENT(WindStruct, .count = 1))                                                                   \
    P(TEARING, STRUCT_ARGUMENT(TearingStruct, .count = 1))                                                             \
    P(SETTINGS, STRUCT_ARGUMENT(kiriSettingsStruct, .count = 1))                                                       \
    P(PIN_DEF, STRUCT_ARGUMENT(PinDefStruct, .count = 1))                                                              \
    P(SEAM_DEF, STRUCT_ARGUMENT(SeamDefStruct, .fault = FaultOfSeamDef))                                               \
    P(FOLD, STRUCT_ARGUMENT(FoldStruct, .count = 1))                                                                   \
    P(SHEET_DEF, STRUCT_ARGUMENT(SheetDefStruct, .fault = FaultOfSheetDef))                                            \
    P(OBSTACLE_DEF, STRUCT_ARGUMENT(ObstacleDefStruct, .fault = FaultOfObstacleDef))                                   \
    P(NOTE, ARRAY_ARGUMENT(byteItem, WITHIN(1, KIRI_MOST_NOTE_BYTES))) /* arrays, each with a COUNT behind it */       \
    P(SAVE, ARRAY_ARGUMENT(byteItem, ANY_NUMBER))                                                                      \
    P(POINTS, ARRAY_ARGUMENT(kiriArguments[KIRI_ARGUMENT_POINT], WITHIN(1, 1 << 24)))                                  \
    P(FRAMES, ARRAY_ARGUMENT(kiriArguments[KIRI_ARGUMENT_FRAME], COUNTING))                                            \
    P(CONTACTS, ARRAY_ARGUMENT(contactItem, COUNTING))                                                                 \
    P(FOLDS, ARRAY_ARGUMENT(foldItem, WITHIN(1, KIRI_MOST_FOLDS)))                                                     \
    N(NEW_ID, FORM(KIRI_FORM_NEW)) /* results, at most one a call */                                                   \
    N(NEW_COUNT, FORM(KIRI_FORM_NEW))                                                                                  \
    N(NEW_IDS, FORM(KIRI_FORM_NEWS)) /* as many as the COUNT just before it */

#define KIRI_KIND(Name, ...) KIRI_ARGUMENT_##Name,
typedef enum kiriArgument {
    KIRI_ARGUMENT_NONE,
    KIRI_ARGUMENTS(KIRI_KIND, KIRI_KIND, KIRI_KIND) KIRI_ARGUMENT_KINDS
} kiriArgument;

/* `arguments`: pointers to arguments that go by value, and arguments that are pointers. */
typedef kiriResult kiriMakeCallFn(kiriWorld* world, const void* const* arguments);

typedef struct kiriCallRow {
    const char* name;
    kiriMakeCallFn* make; /* calls the function */
    uint8_t kinds[KIRI_CALL_ARGUMENTS];
} kiriCallRow;

extern const kiriCallRow kiriCallRows[KIRI_CALL_COUNT];

/* ---- Values ---- */

typedef enum kiriForm {
    KIRI_FORM_INTS,
    KIRI_FORM_FLOATS,
    KIRI_FORM_BYTE,
    KIRI_FORM_DATA,
    KIRI_FORM_ID,
    KIRI_FORM_STRUCT,
    KIRI_FORM_COUNT,   /* belongs to the array before it */
    KIRI_FORM_ARRAY,   /* of items `of`; its count is the next argument */
    KIRI_FORM_NEW,     /* an id or a count that the call writes, */
    KIRI_FORM_NEWS,    /* or several ids */
    KIRI_FORM_FLOATS_AT, /* members of a struct: a pointer to numbers, or null */
    KIRI_FORM_INDICES_AT
} kiriForm;

typedef const struct kiriStruct* kiriStructFn(void);

/* What an argument may be, or a member of a struct. */
typedef struct kiriValue {
    const char *name, *kind; /* name of the member; noun for an id in the error line */
    kiriForm form;
    int32_t count;    /* numbers; for arrays in structs: numbers an item */
    int32_t offset;   /* in the struct */
    int32_t refers;   /* ids: offset of the pool in kiriWorld; arrays in structs: offset of the count */
    double low, high; /* inclusive range of the numbers, or of the count of an array; low > high: unchecked */
    bool isOptional;  /* may be null, or the id 0 */
    int32_t types;    /* of obstacles: bits of those that use the member; 0: all */
    kiriStructFn* of;
    const struct kiriValue* item;
    const char* (*fault)(const void* value); /* returns null, or a fault as in "is not orthonormal"; null: no check */
} kiriValue;

typedef struct kiriStruct {
    int32_t bytes;
    uint32_t cookie;      /* its first member, or 0: it has none */
    const char* filledBy; /* the function that sets the cookie */
    int32_t count;
    const kiriValue* members;
} kiriStruct;

extern const kiriValue kiriArguments[KIRI_ARGUMENT_KINDS];
kiriStructFn kiriSettingsStruct, kiriWorldDefStruct;

/* Cookie of a def: the size of its struct. It detects defs of another version and uninitialised defs. */
#define KIRI_COOKIE(Type) (0x4b000000u | (uint32_t)sizeof(Type))

/* Checks the members of a struct, but not its cookie. The fault names the first bad one, as in "name.friction is -1".
   `world` is used for ids alone, and may be null for a struct without ids. */
kiriResult kiriStruct_Check(const kiriStruct* of, const char* name, const kiriWorld* world, const void* at,
                            kiriFault* fault);

/* ---- Calls ---- */

/* A call of a function that takes the world without const. */
typedef struct kiriCall {
    kiriWorld* world;
    int32_t number;       /* KIRI_NONE: the function is not in the table */
    const char* function; /* for the error line */
    const char* names;    /* of the arguments, as in "&sheet, velocity" */
    const void* const* arguments;
    int32_t index;        /* index in `sheet` of the frame or pin that the first argument names */
    void* owner;          /* object that the first argument names; for a frame or pin: its sheet */
    kiriSheetData* sheet; /* `owner`, if it is a sheet */
    kiriResult result;    /* set if Begin fails */
} kiriCall;

/* Refuses calls from callbacks, checks the arguments, resolves ids, sets new ids to 0, and records the call. If it
   fails it has also ended the call. */
bool kiriCall_Begin(kiriCall* call);

/* Ends the call, or for null a function that only reads: `result`, with a line in the log if it is an error. `why` null
   or empty: the line has the text of the result. */
kiriResult kiriCall_End(const kiriWorld* world, kiriCall* call, const char* function, kiriResult result,
                        const char* why);

#define KIRI_ABOVE_0 1e-45 /* no positive float is less */

/* Ends the call for a number that is not within low and high. */
kiriResult kiriCall_RefuseNumber(const kiriWorld* world, kiriCall* call, const char* function, const char* name,
                                 double number, double low, double high);

/* The same for an id that is not one of this kind, and for a rest point outside the material. */
kiriResult kiriCall_RefuseId(const kiriWorld* world, kiriCall* call, const char* function, const char* kind,
                             uint32_t id);
kiriResult kiriCall_RefusePoint(const kiriWorld* world, kiriCall* call, const char* function, const float restPoint[2]);

/* The host's log gets the line. */
void kiriWorld_Log(const kiriWorld* world, const char* line);

/* Refuses a call that a callback made on its own world: KIRI_ERROR_STATE. Keeps the error line of the running call. */
kiriResult kiriCall_Refuse(const kiriWorld* world, const char* function);

#define KIRI_BEGIN(number, function, names, arguments)                                                                 \
    kiriCall thisCall = { world, number, function, names, arguments, 0, NULL, NULL, KIRI_OK };                         \
    kiriCall* const call = &thisCall;                                                                                  \
    if (!kiriCall_Begin(call)) {                                                                                       \
        return call->result;                                                                                           \
    }

/* Begins a function that changes the world. Arguments by value are passed by their address. */
#define KIRI_CHANGES(Name, ...)                                                                                        \
    const void* const callArguments[] = { __VA_ARGS__ };                                                               \
    KIRI_BEGIN(KIRI_CALL_##Name, __func__, #__VA_ARGS__, callArguments)

/* Begins a function that takes the world without const, but changes nothing on which a tick depends. */
#define KIRI_PREPARES(world) KIRI_BEGIN(KIRI_NONE, __func__, "", NULL)

/* Begins a function that only reads. Several threads may read, so its error line goes to the log alone. */
#define KIRI_READS(world)                                                                                              \
    kiriCall* const call = NULL;                                                                                       \
    if ((world) == NULL) {                                                                                             \
        return KIRI_ERROR_ARGUMENT;                                                                                    \
    }                                                                                                                  \
    if ((world)->isBusy) {                                                                                             \
        return kiriCall_Refuse(world, __func__);                                                                       \
    }

/* Every function ends through these, but functions that only read may return KIRI_OK directly. */
#define KIRI_FAIL(result, why) kiriCall_End(world, call, __func__, result, why)
#define KIRI_RETURN(result) return KIRI_FAIL(result, NULL)

#define KIRI_REQUIRE(condition, result, why)                                                                           \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            return KIRI_FAIL(result, why);                                                                             \
        }                                                                                                              \
    } while (0)
#define KIRI_CHECK(condition, why) KIRI_REQUIRE(condition, KIRI_ERROR_ARGUMENT, why)

/* Checks a number of any type; the line has its name, the number and the range (high FLT_MAX: no limit). */
#define KIRI_CHECK_NUMBER(number, low, high)                                                                           \
    do {                                                                                                               \
        if (!((number) >= (low) && (number) <= (high))) {                                                              \
            return kiriCall_RefuseNumber(world, call, __func__, #number, number, low, high);                           \
        }                                                                                                              \
    } while (0)

#define KIRI_CHECK_OUT(pointer) KIRI_CHECK((pointer) != NULL, #pointer " is null")
#define KIRI_CHECK_LIST(items)                                                                                         \
    KIRI_CHECK(count != NULL && (capacity == 0 || (capacity > 0 && (items) != NULL)), "count or " #items " is null")
#define KIRI_CHECK_INSIDE(condition, restPoint)                                                                        \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            return kiriCall_RefusePoint(world, call, __func__, restPoint);                                             \
        }                                                                                                              \
    } while (0)
#define KIRI_CHECK_FLOATS(values, count)                                                                               \
    KIRI_CHECK((values) != NULL && kiriCall_AreFinite(values, count), #values " is null or not finite")

/* Declares `slot` of an id; and `found`: the sheet, or the sheet of the frame or pin. */
#define KIRI_FIND_SLOT(kind)                                                                                           \
    const kiriSlot* slot = kiriPool_Find(&world->kind##Ids, kind);                                                     \
    do {                                                                                                               \
        if (slot == NULL) {                                                                                            \
            return kiriCall_RefuseId(world, call, __func__, #kind, kind);                                              \
        }                                                                                                              \
    } while (0)
#define KIRI_FIND(kind)                                                                                                \
    KIRI_FIND_SLOT(kind);                                                                                              \
    KIRI_ASSERT(slot->owner != NULL && slot->index >= 0);                                                              \
    kiriSheetData* found = slot->owner

/* Begins a function that only reads, with an id and a pointer to its result. */
#define KIRI_READS_OF(kind, out)                                                                                       \
    KIRI_READS(world);                                                                                                 \
    KIRI_CHECK_OUT(out);                                                                                               \
    KIRI_FIND(kind)

/* Writes the ids of the items of an array, as far as they fit, and their number; and ends the function. `item` is where
   item i is. */
#define KIRI_RETURN_IDS(ids, array, item)                                                                              \
    KIRI_EACH_INDEX_WHILE(i < capacity, i, array) {                                                                    \
        (ids)[i] = (item)->id;                                                                                         \
    }                                                                                                                  \
    *count = (array).count;                                                                                            \
    return KIRI_OK

/* Tests whether a callback of a function that only reads is running. */
static inline bool kiriCall_IsRead(const kiriWorld* world)
{
    return kiriWord_Read(&world->readers) != 0 || kiriWord_Read(&world->logs) != 0;
}

/* Functions that only read put these two around calls of the host's functions, except the log. */
static inline void kiriCall_BeginCallbacks(const kiriWorld* world)
{
    kiriWord_Add(&world->readers, 1);
}
static inline void kiriCall_EndCallbacks(const kiriWorld* world)
{
    kiriWord_Add(&world->readers, -1);
}

bool kiriCall_AreFinite(const float* values, int64_t count);

/* Tests whether a planar sheet stays in its plane if its normal is turned to d. */
bool kiriCall_KeepsPlane(const kiriSheetData* sheet, kiriVec3 d);

/* Snaps the ends of a line in the rest plane, and finds the frames along it (kiriOwner_FindShares). On failure *why is
   the reason, or null. */
kiriResult kiriCall_FindLine(kiriSheetData* sheet, const float from[2], const float to[2], kiriLatticePoint ends[2],
                             const char** why);

/* ---- Recording ---- */

enum { KIRI_RECORD_VERSION = 2, KIRI_RECORD_MAGIC_BYTES = 8 };

/* A recording is a list of calls: number, arguments, result, new ids. Begin passes the arguments to the host before the
   call does anything, so the host has them even if the call never returns. */
void kiriRecord_Start(kiriWorld* world, const kiriWorldDef* def);
void kiriRecord_Begin(const kiriCall* call);
void kiriRecord_End(const kiriCall* call, kiriResult result);

/* Records the end of the world. */
void kiriRecord_Stop(kiriWorld* world);

KIRI_C_END

#endif
