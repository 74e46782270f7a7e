/* The world as bytes, and back: see core/kiri_archive.h. */
#ifndef KIRI_SAVE_H
#define KIRI_SAVE_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* *size: bytes of the save. `bytes` null: no more than that. KIRI_ERROR_ARGUMENT: they do not fit. KIRI_PENDING, and
   *size is 0: a cut is being worked on. */
kiriResult kiriSave_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Makes the world what it was; its hooks stay. Bytes may be made by somebody who means harm: what was read is checked,
   and grid, regions, shape functions and links are made anew. KIRI_ERROR_DATA, and *why says what is wrong with the
   bytes, or KIRI_ERROR_MEMORY: nothing has changed. */
kiriResult kiriSave_Read(kiriWorld* world, const void* bytes, int64_t size, const char** why);

/* The same with all that there is, as it lies in memory, and without checks: for the same process. KIRI_ERROR_DATA: the
   bytes are no snapshot of this build. */
kiriResult kiriSnapshot_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);
kiriResult kiriSnapshot_Read(kiriWorld* world, const void* bytes, int64_t size);

KIRI_C_END

#endif
