/* Hashes of 64 bits. A hash begins as KIRI_HASH_START, and each call adds to it. Numbers are added by value, so the
   hash is the same on machines of either byte order. */
#ifndef KIRI_HASH_H
#define KIRI_HASH_H

#include "kiri_base.h"

#include <string.h>

KIRI_C_BEGIN

#define KIRI_HASH_START UINT64_C(14695981039346656037)

/* Adds a whole number as one byte of FNV-1a (Fowler, Noll, Vo), for lists of indices. */
static inline void kiriHash_Word(uint64_t* hash, uint64_t value)
{
    *hash = (*hash ^ value) * UINT64_C(1099511628211);
}

/* The same for numbers whose highest bits matter: they are brought down, for a product carries bits up alone. */
static inline void kiriHash_Int64(uint64_t* hash, int64_t value)
{
    uint64_t mixed = (*hash ^ (uint64_t)value) * UINT64_C(0x9E3779B97F4A7C15);
    *hash = mixed ^ mixed >> 32;
}

static inline void kiriHash_Int32(uint64_t* hash, int32_t value)
{
    kiriHash_Int64(hash, value);
}

/* Two at the price of one. */
static inline void kiriHash_Pair(uint64_t* hash, int32_t first, int32_t second)
{
    kiriHash_Int64(hash, (int64_t)((uint64_t)(uint32_t)first << 32 | (uint32_t)second));
}

/* Its bits: 0.0 and -0.0 differ. */
static inline void kiriHash_Double(uint64_t* hash, double value)
{
    int64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    kiriHash_Int64(hash, bits);
}

KIRI_C_END

#endif
