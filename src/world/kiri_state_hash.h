/* The state hash. */
#ifndef KIRI_STATE_HASH_H
#define KIRI_STATE_HASH_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* A hash of everything that the coming ticks depend on, derived data included. Field by field, so that padding
   never counts. */
uint64_t kiriStateHash_Of(const kiriWorld* world);

/* Its part for what is in force in a sheet but for its motion: mesh, links, weights of samples, pieces. */
void kiriStateHash_AddLayout(uint64_t* hash, const kiriSheetData* sheet);

KIRI_C_END

#endif
