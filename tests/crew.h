/* Threads of a host that run tasks of the library. */
#ifndef KIRI_TEST_CREW_H
#define KIRI_TEST_CREW_H

#include "kiri/kiri.h"

#include <pthread.h>
#include <stdbool.h>
#include <string.h>

enum { CREW_MOST = 16 };

typedef struct Crew {
    pthread_t threads[CREW_MOST];
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int32_t workers; /* with the caller */
    bool isOver;     /* threads end */
    bool isBusy;     /* a task runs */
    kiriTaskFn* task;
    void* context;
    int32_t next, left; /* item to begin with; items that are not done */
    int32_t items, range;
} Crew;

/* With the lock: takes a range and does it without. Returns false where none is left. */
static inline bool Crew_WorkOnce(Crew* crew)
{
    int32_t start = crew->next, end = start + crew->range < crew->items ? start + crew->range : crew->items;
    if (!crew->isBusy || start >= crew->items) {
        return false;
    }
    crew->next = end;
    pthread_mutex_unlock(&crew->lock);
    crew->task(start, end, crew->context);
    pthread_mutex_lock(&crew->lock);
    crew->left -= end - start;
    if (crew->left == 0) {
        pthread_cond_broadcast(&crew->changed);
    }
    return true;
}

static inline void* Crew_Serve(void* user)
{
    Crew* crew = user;
    pthread_mutex_lock(&crew->lock);
    while (!crew->isOver) {
        if (!Crew_WorkOnce(crew)) {
            pthread_cond_wait(&crew->changed, &crew->lock);
        }
    }
    pthread_mutex_unlock(&crew->lock);
    return NULL;
}

static inline void Crew_Begin(Crew* crew, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* context)
{
    pthread_mutex_lock(&crew->lock);
    crew->isBusy = true;
    crew->task = task;
    crew->context = context;
    crew->items = crew->left = itemCount;
    crew->range = minRange;
    crew->next = 0;
    pthread_cond_broadcast(&crew->changed);
    pthread_mutex_unlock(&crew->lock);
}

static inline void Crew_Finish(Crew* crew)
{
    pthread_mutex_lock(&crew->lock);
    while (Crew_WorkOnce(crew)) {
    }
    while (crew->left > 0) {
        pthread_cond_wait(&crew->changed, &crew->lock);
    }
    crew->isBusy = false;
    pthread_mutex_unlock(&crew->lock);
}

/* Starts a thread for each worker but the caller. */
static inline bool Crew_Start(Crew* crew, int32_t workers)
{
    memset(crew, 0, sizeof(*crew));
    crew->workers = workers;
    pthread_mutex_init(&crew->lock, NULL);
    pthread_cond_init(&crew->changed, NULL);
    bool fine = true;
    for (int32_t i = 1; fine && i < workers; ++i) {
        fine = pthread_create(&crew->threads[i], NULL, Crew_Serve, crew) == 0;
    }
    return fine;
}

static inline void Crew_Stop(Crew* crew)
{
    pthread_mutex_lock(&crew->lock);
    crew->isOver = true;
    pthread_cond_broadcast(&crew->changed);
    pthread_mutex_unlock(&crew->lock);
    for (int32_t i = 1; i < crew->workers; ++i) {
        pthread_join(crew->threads[i], NULL);
    }
    pthread_cond_destroy(&crew->changed);
    pthread_mutex_destroy(&crew->lock);
}

#endif
