/* Memory through the host's hooks. Every other file allocates through this one. */
#ifndef KIRI_BASE_H
#define KIRI_BASE_H

#include "../../include/kiri/kiri.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { KIRI_NONE = -1 };

typedef struct kiriMemory {
    kiriAllocFn* alloc;
    kiriFreeFn* free;
    void* user;
} kiriMemory;

/* malloc and free where the hooks are null. */
kiriMemory kiriMemory_Make(kiriAllocFn* alloc, kiriFreeFn* free, void* user);

/* Null when there is no memory. Not zeroed. */
void* kiriMemory_Alloc(const kiriMemory* memory, int64_t bytes);

/* How far a piece of work has come that a budget may interrupt. */
typedef enum kiriProgress {
    KIRI_DONE,
    KIRI_MORE,   /* the quota is spent: call again with a new one */
    KIRI_FAILED, /* no memory */
} kiriProgress;

/* Items that may be worked on before the next pause. */
typedef struct kiriQuota {
    int64_t left; /* never below zero */
    int64_t used;
} kiriQuota;

/* Null is allowed. */
void kiriMemory_Free(const kiriMemory* memory, void* pointer);

/* Takes items from the quota; false, and takes none, where fewer are left. */
static inline bool kiriQuota_Take(kiriQuota* quota, int64_t items)
{
    if (items > quota->left) {
        return false;
    }
    quota->left -= items;
    quota->used += items;
    return true;
}

#ifdef __cplusplus
}
#endif

#endif
