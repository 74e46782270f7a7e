/* What fuzzers share. A fuzzer is one file, fuzz_X.c, with a function that takes any bytes: `make fuzz` has clang's
   libFuzzer look for bytes that break something, `make test` runs those that are kept in data/fuzz/X. */
#ifndef KIRI_TEST_FUZZ_H
#define KIRI_TEST_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* libFuzzer's name for it. It returns 0; what is wrong ends the program. */
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

/* Ends the program with a line of printf's form. */
void Fuzz_Fail(const char* format, ...);

#define FUZZ_CHECK(condition, ...)                                                                                     \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            Fuzz_Fail(__VA_ARGS__);                                                                                    \
        }                                                                                                              \
    } while (0)

/* ---- Numbers out of bytes ---- */

typedef struct FuzzBytes {
    const uint8_t* data;
    size_t size, at;
    float last; /* float that was read: others come near it */
} FuzzBytes;

bool FuzzBytes_AtEnd(const FuzzBytes* bytes);

/* Zero beyond the end. */
uint32_t FuzzBytes_Get(FuzzBytes* bytes);
uint32_t FuzzBytes_GetSome(FuzzBytes* bytes, int count);

/* From 0 up to, without, `end`, which is 256 at most. */
int32_t FuzzBytes_Below(FuzzBytes* bytes, int32_t end);

/* Most of the time an even number within low and high; now and then one beside the last, or any float there is. */
float FuzzBytes_Float(FuzzBytes* bytes, float low, float high);

/* Most of the time within low and high; now and then beside these, or any number. */
int32_t FuzzBytes_Int(FuzzBytes* bytes, int32_t low, int32_t high);

#endif
