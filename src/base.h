/* Memory through the host's hooks. Every other file allocates through this one. */
#ifndef KIRI_BASE_H
#define KIRI_BASE_H

#include "kiri/kiri.h"

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

/* Null is allowed. */
void kiriMemory_Free(const kiriMemory* memory, void* pointer);

#ifdef __cplusplus
}
#endif

#endif
