/* The state hash. */
#ifndef KIRI_SNAPSHOT_H
#define KIRI_SNAPSHOT_H

#include "world.h"

/* 64-bit FNV-1a over everything that the coming ticks depend on, derived data included. Field by field, so that padding
   never counts. */
uint64_t kiriSnapshot_Hash(const kiriWorld* world);

/* A hash of grid, regions and shape functions that does not depend on the order in which cuts were made. Meant for tests: all of
   it follows from mesh and sites, so the state hash needs none of it. No update may be at hand. */
uint64_t kiriSnapshot_HashLayout(const kiriSheetData* sheet);

#endif
