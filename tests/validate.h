/* Checks of a whole world against itself, for tests and fuzzers. What is derived is compared with what it was derived
   from: the library's invariants, each by a plain walk that shares as little as possible with the code that keeps
   them. */
#ifndef KIRI_TEST_VALIDATE_H
#define KIRI_TEST_VALIDATE_H

#include "kiri/kiri.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct kiriMeshData;

/* Null when all is right; else a line that says what is wrong and where, good until the next call. Call it between any
   two calls of the API, also after one that failed. While an update is at hand, grid, regions and shape functions are
   half done and not looked at; everything that is in force is. Costs about as much as a small cut. */
const char* Validate_World(const kiriWorld* world);

/* The same of a mesh alone. Where it conforms, edges that lie on each other are twins, too. */
const char* Validate_Mesh(const struct kiriMeshData* mesh, bool isConforming);

#ifdef __cplusplus
}
#endif

#endif
