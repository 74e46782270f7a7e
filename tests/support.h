/* Shared by the tests: the form of a test, and a seeded generator. */
#ifndef KIRI_TEST_SUPPORT_H
#define KIRI_TEST_SUPPORT_H

#include "scoped.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

/* Whether the program has the address or the thread sanitizer, and whether its malloc can be replaced. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IS_SANITIZED 1
#endif
#endif
#ifndef IS_SANITIZED
#define IS_SANITIZED 0
#endif
#if defined(__GLIBC__) && !IS_SANITIZED
#define REPLACES_MALLOC 1
#else
#define REPLACES_MALLOC 0
#endif

#ifdef __cplusplus
extern "C" {
#endif

#include <cmocka.h>

/* Adds a test. Tests run in the order of their lines (main.c). */
void Test_Add(const char* name, CMUnitTestFunction run, void* state, int line);

/* Sets the function that runs before all tests, with the arguments of main. */
void Test_SetUp(void (*setUp)(int count, char** words));

#ifdef __cplusplus
}
#endif

/* TEST(Name) { ... } defines a test and adds it before main starts. */
#define TEST(name)                                                                                                     \
    static void name##_Test(void);                                                                                     \
    static void name##_Run(void** state)                                                                               \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        name##_Test();                                                                                                 \
    }                                                                                                                  \
    __attribute__((constructor)) static void name##_Add(void)                                                          \
    {                                                                                                                  \
        Test_Add(#name, name##_Run, NULL, __LINE__);                                                                   \
    }                                                                                                                  \
    static void name##_Test(void)

/* FIGURE(Name) { ... }: a test of figures that plays long, and runs no line that the tests do not run; not with sanitizers. */
#if IS_SANITIZED
#define FIGURE(name) static __attribute__((unused)) void name##_Test(void)
#else
#define FIGURE(name) TEST(name)
#endif

/* A number of runs: seeds, worlds, rows. Sanitizers take many times as long, and get a third: faults of the code, not figures. */
#define RUNS(count) (IS_SANITIZED ? ((count) + 2) / 3 : (count))

/* SETUP { ... } runs before all tests, with the arguments of main: count and words. */
#define SETUP                                                                                                          \
    static void SetUp(int count, char** words);                                                                        \
    __attribute__((constructor)) static void AddSetUp(void)                                                            \
    {                                                                                                                  \
        Test_SetUp(SetUp);                                                                                             \
    }                                                                                                                  \
    static void SetUp(int count, char** words)

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
