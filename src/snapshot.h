/* The state hash. */
#ifndef KIRI_SNAPSHOT_H
#define KIRI_SNAPSHOT_H

#include "world.h"

/* 64-bit FNV-1a over everything that the coming ticks depend on, derived data included. Field by field, so that padding
   never counts. */
uint64_t kiriSnapshot_Hash(const kiriWorld* world);

#endif
