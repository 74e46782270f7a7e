/* Hashes of numbers that tests print or compare. */
#ifndef KIRI_TEST_HASH_H
#define KIRI_TEST_HASH_H

#include "core/kiri_archive.h"

#include <string.h>

/* Adds the bits of a double: 0.0 and -0.0 differ. */
static inline void kiriHash_Double(uint64_t* hash, double value)
{
    int64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    kiriHash_Int64(hash, bits);
}

#endif
