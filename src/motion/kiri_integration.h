/* The integration points of sections 5 and 6 of the paper: places where the strain is taken, of material that
   linear-blend skinning deforms. */
#ifndef KIRI_INTEGRATION_H
#define KIRI_INTEGRATION_H

#include "kiri_area_element.h"
#include "../field/kiri_place.h"
#include "../field/kiri_stencil.h"

KIRI_C_BEGIN

/* Scratch, kept from one update to the next for the room that it has. A zeroed one is empty. */
typedef struct kiriIntegrationWork {
    kiriPlacer placer; /* for the piece at hand */
    kiriField field;   /* from its points */
    kiriSeeds seeds;
    KIRI_ARRAY(uint8_t) seen;         /* of each cell: its piece has its points */
    KIRI_ARRAY(kiriMoments) material; /* of the region of each point of the piece at hand */
    kiriPointWeights weights;         /* at the point at hand */
} kiriIntegrationWork;

/* `count` points, which need not be whole, relaxed on the grid, at least one in every piece. Each stands for its region
   of the grid. With order 1 the strain at the point holds for all of it; with order 2 the strain is linear in it (after
   the elastons of Martin et al. 2010): it is taken at four places that have the region's second moments, which costs
   four times as much. `material` is that of each frame's region. */
bool kiriIntegration_Build(kiriAreaElements* elements, kiriIntegrationWork* work, kiriMemory* memory,
                           const kiriGrid* grid, const kiriMeshData* mesh, const kiriShape* shape,
                           const kiriMoments* material, double count, int32_t order, bool planar);

KIRI_C_END

#endif
