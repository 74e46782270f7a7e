/* The state hash. */
#ifndef KIRI_STATE_HASH_H
#define KIRI_STATE_HASH_H

#include "kiri_world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* 64-bit FNV-1a over everything that the coming ticks depend on, derived data included. Field by field, so that padding
   never counts. */
uint64_t kiriStateHash_Of(const kiriWorld* world);

/* A hash of all that a sheet is but for its motion: mesh, grid, regions, shape functions, links, weights of samples. It
   does not depend on the indices of cells, which tell in what order they were made. Meant for tests. No update may be
   at hand. */
uint64_t kiriStateHash_OfLayout(const kiriSheetData* sheet);

#ifdef __cplusplus
}
#endif

#endif
