/* What the files of kiri_bounds share: the tree, and how it is fitted. */
#ifndef KIRI_BOUNDS_WORK_H
#define KIRI_BOUNDS_WORK_H

#include "kiri_bounds.h"

KIRI_C_BEGIN

enum { KIRI_BOUNDS_LEAF = 8, KIRI_BOUNDS_FAN = 4 }; /* triangles of a leaf, children of a node */

/* Its corners are one, see kiriSurface_HideTriangle. */
static inline bool kiriBounds_IsHidden(const kiriSurface* surface, int32_t triangle)
{
    const int32_t* corner = &surface->indices.data[3 * (size_t)triangle];
    return corner[0] == corner[1];
}

/* The children of a node, or the triangles of a leaf: the items from *first up to the end that it returns. */
static inline int32_t kiriBounds_ItemsOf(const kiriBounds* bounds, int32_t level, int32_t node, int32_t* first)
{
    int32_t fan = level == 0 ? KIRI_BOUNDS_LEAF : KIRI_BOUNDS_FAN, start = level == 0 ? 0 : bounds->firsts[level - 1];
    int32_t end = level == 0 ? bounds->order.count : bounds->firsts[level];
    *first = start + fan * (node - bounds->firsts[level]);
    return end - *first < fan ? end : *first + fan;
}

/* Puts the triangles in the order of `codes`; of equal ones as they were. Takes the room of `other`. */
void kiriBounds_SortByCodes(kiriBounds* bounds, int32_t count);

/* All boxes, by the order of the triangles. */
void kiriBounds_Fit(kiriBounds* bounds, const kiriSurface* surface);

KIRI_C_END

#endif
