/* Union-find over indices: which items hang together. The caller has the array `parent`, with an entry for each item;
   the root of a set is its lowest item, whatever the order of joining. */
#ifndef KIRI_UNION_FIND_H
#define KIRI_UNION_FIND_H

#include "kiri_base.h"

KIRI_C_BEGIN

/* Each item a set of its own. */
static inline void kiriUnion_Init(int32_t* parent, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        parent[i] = i;
    }
}

/* Halves the path on its way. */
static inline int32_t kiriUnion_Root(int32_t* parent, int32_t i)
{
    KIRI_ASSERT(i >= 0);
    while (parent[i] != i) {
        KIRI_ASSERT(parent[i] >= 0 && parent[i] < i);
        i = parent[i] = parent[parent[i]];
    }
    return i;
}

static inline void kiriUnion_Join(int32_t* parent, int32_t i, int32_t j)
{
    int32_t a = kiriUnion_Root(parent, i), b = kiriUnion_Root(parent, j);
    parent[kiriMax(b, a)] = kiriMin(a, b);
}

KIRI_C_END

#endif
