/* What numbers must be that were read from bytes, so that those who use them may trust them: rules about fields, in
   tables as those of kiri_archive.h. Bytes may be made by somebody who means harm. */
#ifndef KIRI_CHECK_H
#define KIRI_CHECK_H

#include "kiri_array.h"

KIRI_C_BEGIN

/* What an index is of, or a number counts. How many there are is known when all is read. */
enum kiriOf {
    KIRI_OF_TRIANGLES,
    KIRI_OF_HALF_EDGES,
    KIRI_OF_VERTICES,
    KIRI_OF_SQUARES,
    KIRI_OF_FRAMES,
    KIRI_OF_LINKS,
    KIRI_OF_PIECES,
    KIRI_OF_PINS,
    KIRI_OF_SAMPLES,
    KIRI_OF_COUNT
};

typedef struct kiriCheck {
    int64_t count[KIRI_OF_COUNT];
    kiriMemory memory; /* scratch */
    bool isBad;        /* something is not as it must be */
    bool isShort;      /* no memory to look */
} kiriCheck;

static inline bool kiriCheck_IsFine(const kiriCheck* check)
{
    return !check->isBad && !check->isShort;
}

/* Returns the same. Without memory to look nothing is known to be wrong. */
static inline bool kiriCheck_That(kiriCheck* check, bool isRight)
{
    check->isBad |= !isRight && !check->isShort;
    return isRight;
}

/* ---- Rules ---- */

enum kiriRuleKind {
    KIRI_RULE_BETWEEN, /* whole numbers of four bytes: from `low` up to `high`, and so many of `of` more */
    KIRI_RULE_REALS,   /* finite doubles, */
    KIRI_RULE_FLOATS,  /* and floats */
    KIRI_RULE_COUNTS,  /* whole numbers of eight bytes, 0 and more, and far from overflowing */
    KIRI_RULE_EACH,    /* the rules hold for each item of a KIRI_ARRAY, */
    KIRI_RULE_PART,    /* and for each struct of a field */
    KIRI_RULE_LENGTH   /* a KIRI_ARRAY has so many items as there are of `of` */
};

enum { KIRI_OF_NOTHING = -1 };

typedef struct kiriMust {
    int32_t kind, of;
    int32_t offset, size; /* bytes of the field or fields; or of an item, or of a struct */
    int32_t low, high;
    int32_t bytes; /* of all structs of the field */
    const struct kiriMust* rules;
    int32_t ruleCount;
} kiriMust;

#define KIRI_MUST_RUN(kind, of, low, high, Type, first, last)                                                          \
    {                                                                                                                  \
        kind, of, (int32_t)offsetof(Type, first),                                                                      \
            (int32_t)(offsetof(Type, last) + sizeof(((Type*)NULL)->last) - offsetof(Type, first)), low, high, 0, NULL, \
            0                                                                                                          \
    }

/* Indices; or KIRI_NONE. */
#define KIRI_INDEX(of, Type, first, last) KIRI_MUST_RUN(KIRI_RULE_BETWEEN, of, 0, -1, Type, first, last)
#define KIRI_INDEX_OR_NONE(of, Type, first, last) KIRI_MUST_RUN(KIRI_RULE_BETWEEN, of, KIRI_NONE, -1, Type, first, last)

/* From low to high. */
#define KIRI_WITHIN(low, high, Type, first, last)                                                                      \
    KIRI_MUST_RUN(KIRI_RULE_BETWEEN, KIRI_OF_NOTHING, low, high, Type, first, last)

#define KIRI_COUNTS(Type, first, last) KIRI_MUST_RUN(KIRI_RULE_COUNTS, KIRI_OF_NOTHING, 0, 0, Type, first, last)
#define KIRI_REALS(Type, first, last) KIRI_MUST_RUN(KIRI_RULE_REALS, KIRI_OF_NOTHING, 0, 0, Type, first, last)
#define KIRI_FLOATS(Type, first, last) KIRI_MUST_RUN(KIRI_RULE_FLOATS, KIRI_OF_NOTHING, 0, 0, Type, first, last)

#define KIRI_MUST_HOLD(kind, Type, field, itemBytes, bytes, rules)                                                     \
    {                                                                                                                  \
        kind, KIRI_OF_NOTHING, (int32_t)offsetof(Type, field), (int32_t)(itemBytes), 0, 0, (int32_t)(bytes), rules,    \
            (int32_t)(sizeof(rules) / sizeof(rules[0]))                                                                \
    }
#define KIRI_ITEMS_MUST(Type, field, rules)                                                                            \
    KIRI_MUST_HOLD(KIRI_RULE_EACH, Type, field, sizeof(*((Type*)NULL)->field.data), 0, rules)
#define KIRI_PART_MUST(Type, field, Part, rules)                                                                       \
    KIRI_MUST_HOLD(KIRI_RULE_PART, Type, field, sizeof(Part), sizeof(((Type*)NULL)->field), rules)

#define KIRI_LENGTH(of, Type, field)                                                                                   \
    {                                                                                                                  \
        KIRI_RULE_LENGTH, of, (int32_t)offsetof(Type, field), 0, 0, 0, 0, NULL, 0                                      \
    }

/* Rules for items that are numbers. */
extern const kiriMust kiriMustBeReal[1], kiriMustBeFloat[1];

/* Do all rules hold for an object? What does not is noted. */
bool kiriCheck_Rules(kiriCheck* check, const kiriMust* rules, int32_t count, const void* object);

#define kiriCheck_Object(check, rules, object)                                                                         \
    kiriCheck_Rules((check), (rules), (int32_t)(sizeof(rules) / sizeof(rules[0])), (object))

/* ---- What no rule about a field says ---- */

/* The items of a list of indices are below `end`, and each is there once. */
bool kiriCheck_Distinct(kiriCheck* check, const kiriIndices* indices, int64_t end);

/* Lists of items, linked from each to the next: each ends, and no item is in two, or in one twice. */
typedef struct kiriChains {
    uint8_t* seen;         /* of each item: it is in a list */
    const int32_t* next;   /* of item 0; */
    int64_t stride;        /* and so many bytes from one to the next */
    int32_t items, listed; /* how many there are, and are in lists */
} kiriChains;

/* `next`: of item 0. False for memory. */
bool kiriCheck_StartChains(kiriCheck* check, kiriChains* chains, const void* next, size_t stride, int32_t items);

static inline int32_t kiriChains_After(const kiriChains* chains, int32_t item)
{
    return *(const int32_t*)(const void*)((const char*)chains->next + item * chains->stride);
}

/* False where it is no item, or in a list already. */
static inline bool kiriChains_Take(kiriChains* chains, int32_t item)
{
    if (item < 0 || item >= chains->items || chains->seen[item]) {
        return false;
    }
    chains->seen[item] = 1;
    chains->listed += 1;
    return true;
}

/* The list that begins with an item, or with KIRI_NONE. */
bool kiriCheck_Chain(kiriCheck* check, kiriChains* chains, int32_t head);

/* So many bytes of 0; null where there is no memory, and where there was none before. */
uint8_t* kiriCheck_Bytes(kiriCheck* check, int64_t count);

KIRI_C_END

#endif
