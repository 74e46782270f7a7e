/* Hashes of a sheet without its motion. Indices of cells do not enter: they follow the order in which cells were made. */
#ifndef KIRI_TEST_LAYOUT_HASH_H
#define KIRI_TEST_LAYOUT_HASH_H

#include "kiri/kiri.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Hashes mesh, grid, regions, shape functions, links and weights of samples. The sheet has no pending update. */
uint64_t Layout_Hash(const kiriWorld* world, kiriSheet sheet);

/* Adds the hashes of all sheets: their order does not enter. */
uint64_t Layout_HashAll(const kiriWorld* world);

/* Hashes mesh, links, weights of samples and pieces: the update may be pending. */
uint64_t Layout_HashInForce(const kiriWorld* world, kiriSheet sheet);

/* Returns the stage of the pending update, or -1 if there is none. */
int32_t Layout_Stage(const kiriWorld* world, kiriSheet sheet);

#ifdef __cplusplus
}
#endif

#endif
