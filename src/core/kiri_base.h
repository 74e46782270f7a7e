/* Memory through the host's hooks, assertions, and quotas of budgets. All allocations go through this file. */
#ifndef KIRI_BASE_H
#define KIRI_BASE_H

#include "kiri_float.h"
#include "../../include/kiri/kiri.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#if defined(_MSC_VER)
#include <intrin.h>
#endif

/* Around the declarations of a header, so that C++ may include it. */
#ifdef __cplusplus
#define KIRI_C_BEGIN extern "C" {
#define KIRI_C_END }
#else
#define KIRI_C_BEGIN
#define KIRI_C_END
#endif

KIRI_C_BEGIN

enum { KIRI_NONE = -1 };

/* ---- Numbers ---- */

/* Numbers of any type. The first argument is returned if it is less (greater), else the second one, also for NaN.
   Arguments are evaluated twice. */
#define kiriMin(a, b) ((a) < (b) ? (a) : (b))
#define kiriMax(a, b) ((a) > (b) ? (a) : (b))
#define kiriClamp(x, low, high) ((x) < (low) ? (low) : (x) > (high) ? (high) : (x))

/* Loops: `i` goes from 0, or from `first`, up to and without `end`. */
#define KIRI_TIMES(i, end) KIRI_FROM_TO(i, 0, end)
#define KIRI_TIMES_WHILE(condition, i, end) KIRI_FROM_TO_WHILE(condition, i, 0, end)
#define KIRI_FROM_TO(i, first, end) for (int32_t i = (first); i < (end); ++i)
#define KIRI_FROM_TO_WHILE(condition, i, first, end) for (int32_t i = (first); (condition) && i < (end); ++i)

/* Fills the object of a pointer with zero bytes. */
#define KIRI_CLEAR(pointer) memset(pointer, 0, sizeof(*(pointer)))

/* Binary search: sets `at` to the first index from `first` to `end` for which isBelow is false, or to `end`. isBelow is
   an expression of the index `middle`; it is true for the items up to some index, and false from there on. */
#define KIRI_SEARCH(at, first, end, isBelow)                                                                           \
    do {                                                                                                               \
        int32_t stop = (end);                                                                                          \
        (at) = (first);                                                                                                \
        while ((at) < stop) {                                                                                          \
            int32_t middle = (at) + (stop - (at)) / 2;                                                                 \
            if (isBelow) {                                                                                             \
                (at) = middle + 1;                                                                                     \
            } else {                                                                                                   \
                stop = middle;                                                                                         \
            }                                                                                                          \
        }                                                                                                              \
    } while (0)

/* ---- Assertions ---- */

/* Checked where KIRI_ASSERTS is defined, as `make config=debug` and `config=sanitize` do; elsewhere they cost nothing.
   A host may define KIRI_ASSERT_HANDLER as the name of its handler; the default stops the program. */
#if !defined(KIRI_ASSERTS)
#define KIRI_ASSERT(condition) ((void)sizeof((condition) ? 1 : 0))
#else
#if defined(KIRI_ASSERT_HANDLER)
void KIRI_ASSERT_HANDLER(const char* condition, const char* file, int line);
#else
#define KIRI_ASSERT_HANDLER kiriAssertFailed
void kiriAssertFailed(const char* condition, const char* file, int line);
#endif
#define KIRI_ASSERT(condition) ((condition) ? (void)0 : KIRI_ASSERT_HANDLER(#condition, __FILE__, __LINE__))
#endif

/* ---- Memory ---- */

/* Header of each block. */
typedef struct kiriBlock {
    struct kiriBlock* next;
    struct kiriBlock** link; /* the pointer to this block: `next` of the previous block, or the head */
} kiriBlock;

/* The host's hooks, and the list of all blocks of this owner. They are freed together, so structs made of blocks need
   no release function. The owner must not move while it has blocks. */
typedef struct kiriMemory {
    kiriAllocFn* alloc;
    kiriFreeFn* free;
    void* user;
    kiriBlock* blocks;

    /* For work that cannot stop within an item: a reserve block, which the next refused request gets. So the work
       finishes the item and pauses after it. */
    void* spare;
    int64_t spareBytes;
    int64_t largest; /* bytes of the largest block so far */
    bool isSparing;  /* such work is running */
    bool wasRefused; /* the host refused a request since it started */
} kiriMemory;

/* Makes an owner without blocks. Null hooks: malloc and free. */
kiriMemory kiriMemory_Make(kiriAllocFn* alloc, kiriFreeFn* free, void* user);

/* Makes an owner with the same hooks, without blocks. */
kiriMemory kiriMemory_Like(const kiriMemory* memory);

/* Makes an owner whose requests all fail: for tasks, which must not allocate. */
kiriMemory kiriMemory_None(void);

/* Allocates a block, not zeroed. Returns null on out of memory. */
void* kiriMemory_Alloc(kiriMemory* memory, int64_t bytes);

/* Allocates a zeroed block. Returns null on out of memory. */
void* kiriMemory_AllocZeroed(kiriMemory* memory, int64_t bytes);

/* Enclose work that pauses after a refusal. Begin allocates the reserve block, as large as the largest array may grow
   to, if the host grants it. The block stays for later work until DropSpare. */
void kiriMemory_BeginSparing(kiriMemory* memory);
void kiriMemory_EndSparing(kiriMemory* memory);
void kiriMemory_DropSpare(kiriMemory* memory);

/* Returns true if the work must pause before its next item. */
static inline bool kiriMemory_MustPause(const kiriMemory* memory)
{
    return memory->isSparing && memory->wasRefused;
}

/* Frees a block of any owner with these hooks. Null is allowed. */
void kiriMemory_Free(kiriMemory* memory, void* pointer);
void kiriMemory_FreeAll(kiriMemory* memory);

/* Moves a block to this owner, which has the same hooks. Null is allowed. Cannot fail. */
void kiriMemory_Adopt(kiriMemory* memory, void* pointer);

/* Moves all blocks of another owner to this one. */
void kiriMemory_AdoptAll(kiriMemory* memory, kiriMemory* from);

/* ---- Budget ---- */

/* Progress of work that a budget may interrupt. */
typedef enum kiriProgress {
    KIRI_DONE,
    KIRI_MORE,   /* the quota is spent, or memory was refused: call again */
    KIRI_FAILED, /* out of memory; the work documents where it resumes */
} kiriProgress;

/* Returns the index of the lowest bit that is set. */
static inline int32_t kiriLowestBit(uint32_t bits)
{
    KIRI_ASSERT(bits != 0);
#if defined(__GNUC__)
    return __builtin_ctz(bits);
#else
    int32_t k = 0;
    while ((bits >> k & 1) == 0) {
        ++k;
    }
    return k;
#endif
}

/* Relaxed atomic addition to a counter that several readers share. */
static inline void kiriWord_Add(const int32_t* word, int32_t value)
{
    int32_t* at = (int32_t*)word;
#if defined(__GNUC__)
    __atomic_fetch_add(at, value, __ATOMIC_RELAXED);
#elif defined(_MSC_VER)
    _InterlockedExchangeAdd((long volatile*)at, value);
#else
    *(volatile int32_t*)at += value;
#endif
}

static inline int32_t kiriWord_Read(const int32_t* word)
{
#if defined(__GNUC__)
    return __atomic_load_n(word, __ATOMIC_RELAXED);
#else
    return *(const volatile int32_t*)word;
#endif
}

/* Items that may be worked on before the next pause. */
typedef struct kiriQuota {
    int64_t left; /* never below zero */
    int64_t used;
    int64_t beyond; /* items done beyond the limit: a step larger than the whole quota is charged as the quota */
    bool isShared; /* another kind of items used a part of it */
} kiriQuota;

/* Returns true if items were taken, here or for another kind of work. */
static inline bool kiriQuota_IsBegun(const kiriQuota* quota)
{
    return quota->used > 0 || quota->isShared;
}

/* Takes items from the quota. Returns false, and takes none, if fewer are left. A step larger than the whole quota gets
   all of a fresh one, so everything is done in the end. */
static inline bool kiriQuota_Take(kiriQuota* quota, int64_t items)
{
    KIRI_ASSERT(items >= 0 && quota->left >= 0);
    if (items > quota->left && kiriQuota_IsBegun(quota)) {
        return false;
    }
    quota->left -= kiriMin(items, quota->left);
    quota->used += items;
    return true;
}

/* Returns true if not even a step larger than the whole quota can be taken. */
static inline bool kiriQuota_IsSpent(const kiriQuota* quota)
{
    return quota->left == 0 && kiriQuota_IsBegun(quota);
}

/* Pays a debt as far as the quota goes. Returns false if some is still owed. Progress depends only on the sum of the
   quotas, not on how it is split over ticks. Never exceeds a limit, unlike kiriQuota_Take. */
static inline bool kiriQuota_Pay(kiriQuota* quota, int64_t* owed)
{
    int64_t items = kiriMin(*owed, quota->left);
    quota->left -= items;
    quota->used += items;
    *owed -= items;
    return *owed == 0;
}

KIRI_C_END

/* Reason of a refusal: one line that names the item by its number. */

KIRI_C_BEGIN

typedef struct kiriFault {
    char line[208]; /* "": the result code is enough */
} kiriFault;

/* Writes the line. Numbers are long long: snprintf of the web build reads %s and %lld only. */
#define KIRI_SAY(fault, ...) ((void)snprintf((fault)->line, sizeof((fault)->line), __VA_ARGS__))

KIRI_C_END

/* Tasks: work that the host may run on its threads. */

KIRI_C_BEGIN

/* The host's hooks. Null: tasks run in the caller. */
typedef struct kiriTasks {
    kiriStartTaskFn* start;
    kiriFinishTaskFn* finish;
    void* user;
    int32_t workers;
} kiriTasks;

static inline bool kiriTasks_AreGiven(const kiriTasks* tasks)
{
    return tasks->start != NULL && tasks->workers > 1;
}

/* Runs a task over items [0, count), in ranges of at least `least`, and returns when all are done. Ranges run in
   parallel, in any order. A range must not read the output of another, allocate, free, log or read the clock. */
void kiriTasks_Run(const kiriTasks* tasks, kiriTaskFn* task, int32_t count, int32_t least, void* context);

KIRI_C_END

#endif
