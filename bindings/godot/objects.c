/* Objects of the classes, and the table of handles. */
#define _POSIX_C_SOURCE 199309L

#include "objects.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- Handles ---- */

static int PlaceOf(const Handles* handles, uint32_t id)
{
    uint32_t at = id * 2654435761u;
    while (handles->slots[at & (uint32_t)(handles->capacity - 1)] != NULL &&
           handles->slots[at & (uint32_t)(handles->capacity - 1)]->id != id) {
        ++at;
    }
    return (int)(at & (uint32_t)(handles->capacity - 1));
}

/* Room for one more, so that a third is free. */
static int Reserve(Handles* handles)
{
    Handles grown = { NULL, handles->count, handles->capacity > 0 ? 2 * handles->capacity : 64 };
    if (3 * (handles->count + 1) <= 2 * handles->capacity) {
        return 1;
    }
    grown.slots = calloc((size_t)grown.capacity, sizeof *grown.slots);
    if (grown.slots == NULL) {
        return 0;
    }
    for (int i = 0; i < handles->capacity; ++i) {
        if (handles->slots[i] != NULL) {
            grown.slots[PlaceOf(&grown, handles->slots[i]->id)] = handles->slots[i];
        }
    }
    free(handles->slots);
    *handles = grown;
    return 1;
}

/* Those behind it move up, where they would not be found any more. */
static void Forget(Handles* handles, uint32_t id)
{
    int hole = handles->capacity > 0 ? PlaceOf(handles, id) : 0;
    if (handles->capacity == 0 || handles->slots[hole] == NULL) {
        return;
    }
    handles->slots[hole] = NULL;
    --handles->count;
    for (int i = (hole + 1) & (handles->capacity - 1); handles->slots[i] != NULL;
         i = (i + 1) & (handles->capacity - 1)) {
        Self* moved = handles->slots[i];
        handles->slots[i] = NULL;
        handles->slots[PlaceOf(handles, moved->id)] = moved;
    }
}

Variant HandleOf(Self* world, Class class, uint32_t id)
{
    Self* made = NULL;
    if (id == 0 || !Reserve(&world->handles)) {
        return OfNil();
    }
    Self** slot = &world->handles.slots[PlaceOf(&world->handles, id)];
    if (*slot != NULL) {
        return OfObject(*slot);
    }
    Variant handle = MakeObject(class, &made);
    if (made != NULL) {
        made->id = id;
        made->owner = world;
        made->kept = OfObject(world);
        *slot = made;
        ++world->handles.count;
    }
    return handle;
}

/* ---- Worlds ---- */

static void TakeLine(void* user, const char* line)
{
    Self* self = user;
    strncpy(self->line, line, MOST_TEXT - 1);
}

static void TakeBytes(void* user, const void* bytes, int32_t count)
{
    Self* self = user;
    Bytes* recording = &self->recording;
    if (recording->count + count > recording->capacity) {
        int64_t capacity = 2 * (recording->count + count) + 4096;
        uint8_t* grown = realloc(recording->items, (size_t)capacity);
        if (grown == NULL) {
            self->recordingFailed = 1;
            return;
        }
        recording->items = grown;
        recording->capacity = capacity;
    }
    memcpy(recording->items + recording->count, bytes, (size_t)count);
    recording->count += count;
}

static double Seconds(void* user)
{
    struct timespec now;
    (void)user;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void CallRange(void* user, uint32_t i)
{
    const Task* task = &((Self*)user)->task;
    int32_t start = (int32_t)i * task->range, left = task->itemCount - start;
    task->call(start, start + (left < task->range ? left : task->range), task->context);
}

/* Some ranges for each thread, so that one that begins late does not keep the others waiting. */
static void* StartTask(void* user, kiriTaskFn* call, int32_t itemCount, int32_t minRange, void* context)
{
    enum { RANGES = 4 };
    Self* self = user;
    int32_t share = itemCount / (RANGES * self->workerCount) + 1;
    self->task = (Task){ call, context, itemCount, share > minRange ? share : minRange };
    int32_t count = (itemCount + self->task.range - 1) / self->task.range;
    if (count > 1) {
        return BeginTask(CallRange, self, count);
    }
    call(0, itemCount, context);
    return NULL;
}

static void FinishTask(void* user, void* task)
{
    (void)user;
    EndTask(task);
}

kiriResult BeginWorld(Self* self, const HostDef* def)
{
    kiriWorldDef own = def->def;
    kiriDestroyWorld(self->world);
    self->recording.count = 0;
    own.user = self;
    own.log = TakeLine;
    own.clock = def->clock ? Seconds : NULL;
    own.record = def->record ? TakeBytes : NULL;
    own.startTask = own.workerCount > 1 ? StartTask : NULL;
    own.finishTask = own.workerCount > 1 ? FinishTask : NULL;
    self->workerCount = own.workerCount;
    return kiriCreateWorld(&own, &self->world);
}

Self* WorldOf(Self* self)
{
    return self->class == CLASS_WORLD ? self : self->owner;
}

/* ---- Objects ---- */

Self* NewSelf(Class class, void* object)
{
    Self* self = calloc(1, sizeof *self);
    if (self == NULL) {
        return NULL;
    }
    self->class = class;
    self->object = object;
    self->kept = OfNil();
    if (class == CLASS_WORLD) {
        HostDef def;
        FillWorldDef(&def);
        self->last = BeginWorld(self, &def);
    }
    return self;
}

void FreeSelf(Self* self)
{
    if (self == NULL) {
        return;
    }
    if (self->owner != NULL) {
        Forget(&self->owner->handles, self->id);
    }
    kiriDestroyWorld(self->world); /* a recording gets its end */
    free(self->handles.slots);
    free(self->recording.items);
    DropValue(&self->kept); /* the last: the world may go with it */
    free(self);
}
