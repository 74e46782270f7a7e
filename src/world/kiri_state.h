/* The world as bytes, and back: see core/kiri_archive.h. */
#ifndef KIRI_STATE_H
#define KIRI_STATE_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Writes a save. *size: set to the number of bytes. `bytes` null: only sets *size. KIRI_ERROR_ARGUMENT: the save does
   not fit. KIRI_PENDING, with *size 0: a cut is in progress. */
kiriResult kiriSave_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Replaces the world by the saved one; hooks stay. The bytes are untrusted: fields are checked, and all derived data is
   made again. KIRI_ERROR_DATA, with a reason in *why, or KIRI_ERROR_MEMORY: nothing has changed. */
kiriResult kiriSave_Read(kiriWorld* world, const void* bytes, int64_t size, const char** why);

/* The same with all data as it lies in memory, and without checks: for the same process. KIRI_ERROR_DATA: not a
   snapshot of this build. */
kiriResult kiriSnapshot_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);
kiriResult kiriSnapshot_Read(kiriWorld* world, const void* bytes, int64_t size);

/* The state hash. */

/* Hashes the state that the coming ticks depend on, field by field. Derived data follows from it. */
uint64_t kiriStateHash_Of(const kiriWorld* world);

KIRI_C_END

#endif
