/* Slit ends: where an open edge ends inside the material. The sheet bends and stretches around them, so borders between
   regions must be there. */
#ifndef KIRI_SLIT_H
#define KIRI_SLIT_H

#include "kiri_region.h"

KIRI_C_BEGIN

/* Adds a pair of sites at the slit ends in these cells, with a way of `spacing` from the one to the other over the end:
   so the line on which the slit would go on is a border between their regions. An end gets a closer pair where there is
   no room, but not closer than two squares, and none where other sites are too near. In the order of the cells, until
   there are `most` sites. Each is in a cell of its own. False for memory. */
bool kiriSlits_AddPairs(kiriSites* sites, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const int32_t* cells, int32_t cellCount, double spacing, int32_t most);

KIRI_C_END

#endif
