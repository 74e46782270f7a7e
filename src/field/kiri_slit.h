/* Slit ends: where an open edge ends inside the material. The sheet bends and stretches around them, so borders between
   regions must be there. */
#ifndef KIRI_SLIT_H
#define KIRI_SLIT_H

#include "kiri_region.h"

KIRI_C_BEGIN

typedef struct kiriSlitEnd {
    kiriVec2 at;    /* local m */
    kiriVec2 along; /* unit: the way on from the slit */
    int32_t cell;   /* that holds it */
} kiriSlitEnd;

typedef KIRI_ARRAY(kiriSlitEnd) kiriSlitEnds;

/* The first slit end in a cell; false where there is none. */
bool kiriSlits_FindEndIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell, kiriSlitEnd* end);

/* How far a search has come that a budget may interrupt; zeros at its start. */
typedef struct kiriSlitSearch {
    int32_t seen; /* cells */
    int64_t owed; /* items, for the last of them */
} kiriSlitSearch;

/* The slit ends in these cells, one a cell at most, in the order of the cells. An item is some vertices looked at, or
   some cells without any. After KIRI_FAILED, start again. */
kiriProgress kiriSlits_FindEnds(kiriSlitEnds* ends, kiriSlitSearch* search, kiriMemory* memory, const kiriGrid* grid,
                                const kiriMeshData* mesh, const int32_t* cells, int32_t cellCount, kiriQuota* quota);

/* Adds a pair of sites at each slit end, with a way of `spacing` from the one to the other over the end: so the line on
   which the slit would go on is a border between their regions. An end gets a closer pair where there is no room, but
   not closer than two squares, and none where other sites are too near. In the order of the ends, until there are
   `most` sites. Each is in a cell of its own. False for memory. */
bool kiriSlits_AddPairs(kiriSites* sites, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriSlitEnds* ends, double spacing, int32_t most);

KIRI_C_END

#endif
