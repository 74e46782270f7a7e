/* The integration points of section 5 and 6 of the paper: material that linear-blend skinning deforms. */
#ifndef KIRI_POINT_H
#define KIRI_POINT_H

#include "patch.h"
#include "sample.h"

/* `count` points, relaxed on the grid, at least one in every piece. Each stands for its region of the grid. With order 1
   the strain at the point holds for all of it; with order 2 the strain is linear in it (after the elastons of Martin et
   al. 2010): it is taken at four places that have the region's second moments, which costs four times as much. */
bool kiriPoints_Build(kiriPatches* patches, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      kiriField* field, const kiriShape* shape, const kiriRegions* regions, int32_t count,
                      int32_t order, bool planar);

#endif
