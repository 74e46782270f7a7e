#include "kiri_task.h"

#define RANGES_A_WORKER 8 /* so that they end at about the same time, though some items take longer than others */

void kiriTasks_Run(const kiriTasks* tasks, kiriTaskFn* task, int32_t count, int32_t least, void* context)
{
    KIRI_ASSERT(count >= 0 && least >= 1);
    if (!kiriTasks_AreGiven(tasks) || count <= least) {
        task(0, count, context);
        return;
    }
    int32_t even = count / tasks->workers / RANGES_A_WORKER;
    void* handle = tasks->start(tasks->user, task, count, kiriMax(even, least), context);
    if (handle != NULL) {
        tasks->finish(tasks->user, handle);
    }
}
