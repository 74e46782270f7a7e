/* The world as bytes, and back: see core/kiri_archive.h. */
#ifndef KIRI_STATE_H
#define KIRI_STATE_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Hashes the state that the coming ticks depend on, field by field. Derived data follows from it. */
uint64_t kiriStateHash_Of(const kiriWorld* world);

KIRI_C_END

#endif
