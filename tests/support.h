/* What the tests share: a seeded generator, and rectangles. */
#ifndef KIRI_TEST_SUPPORT_H
#define KIRI_TEST_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* xorshift32; any seed but 0. */
static inline uint32_t Random(uint32_t* seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

/* From low to high. */
static inline double RandomBetween(uint32_t* seed, double low, double high)
{
    return low + (high - low) * ((double)Random(seed) / 4294967296.0);
}

#endif
