/* What each number of a save is: the block of memory that it is written from, and its width. */
#ifndef KIRI_TEST_FUZZ_TRACED_H
#define KIRI_TEST_FUZZ_TRACED_H

#include "fuzz_saved.h"

enum { TRACED_BLOCKS = 4096 };

/* Numbers of one width that follow each other. */
typedef struct TracedPart {
    int32_t block, width;
    int64_t at, bytes; /* in the save */
} TracedPart;

typedef struct Traced {
    Save save;
    TracedPart* parts; /* by blocks */
    int32_t count, capacity, blocks;
    int32_t first[TRACED_BLOCKS + 2]; /* part of a block */
    int64_t words[TRACED_BLOCKS + 2]; /* of 4 bytes, of a block */
} Traced;

/* Of the later save of one of SAVED_WORLDS. */
const Traced* Traced_Get(int32_t index);

/* Which part of a block has a word, which becomes one of that part. */
const TracedPart* Traced_Find(const Traced* of, int32_t block, int64_t* word);

#endif
