/* The world as bytes, and back: see core/kiri_archive.h. */
#ifndef KIRI_SAVE_H
#define KIRI_SAVE_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* *size: how many bytes there are. `bytes` null: no more than that. KIRI_ERROR_ARGUMENT: they do not fit. */
kiriResult kiriSave_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Makes the world what it was; its hooks stay. KIRI_ERROR_DATA, and *why says what is wrong with the bytes, or
   KIRI_ERROR_MEMORY: nothing has changed. Of bytes that are not trusted nothing is read that follows from the mesh and
   the frames, and the work at hand begins again. */
kiriResult kiriSave_Read(kiriWorld* world, const void* bytes, int64_t size, bool isTrusted, const char** why);

KIRI_C_END

#endif
