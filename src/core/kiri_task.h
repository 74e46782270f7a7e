/* Work that the host may spread over its threads. */
#ifndef KIRI_TASK_H
#define KIRI_TASK_H

#include "kiri_base.h"

KIRI_C_BEGIN

/* The host's hooks; null: all runs in the caller. */
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

/* Does the items 0 to `count`, in ranges of `least` and more, and returns when all are done. Ranges run side by side,
   in any order: none may read what another writes, nor allocate, free, log or read the clock. */
void kiriTasks_Run(const kiriTasks* tasks, kiriTaskFn* task, int32_t count, int32_t least, void* context);

KIRI_C_END

#endif
