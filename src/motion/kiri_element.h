/* Area elements: pieces of the mid-surface that several affine frames deform together. Their strains are those at a
   point; kiri_strain.h and kiri_solver.h make them, each with its own deformation gradient. */
#ifndef KIRI_ELEMENT_H
#define KIRI_ELEMENT_H

#include "kiri_frame.h"
#include "../field/kiri_link.h"
#include "../field/kiri_site.h"
#include "../field/kiri_stencil.h"

KIRI_C_BEGIN

/* With F = [F_u F_v] the deformation gradient of the mid-surface, D the director, D_u and D_v its slopes; Green
   strains, plane stress. Every energy is 1/2 stiffness strain^2; G = E / (2 (1 + nu)), K = E / (2 (1 - nu)), a the
   area. With a element's `lean` above zero the products of F_u and F_v in the first three count their parts along D 1 +
   lean times.

   strain     what                                   stiffness
   area       (F_u . F_u + F_v . F_v) / 2 - 1        K h a
   stretch    (F_u . F_u - F_v . F_v) / 2            G h a
   shear      F_u . F_v                              G h a
   dome       F_u . D_u + F_v . D_v                  K h^3 a / 12
   saddle     F_u . D_u - F_v . D_v                  G h^3 a / 12
   twist      F_u . D_v + F_v . D_u                  G h^3 a / 12
   lean u, v  F_u . D, F_v . D                       G h a
   thickness  (D . D - 1) / 2                        E h a */
enum {
    KIRI_AREA_DILATION,
    KIRI_AREA_STRETCH,
    KIRI_AREA_SHEAR,
    KIRI_AREA_DOME,
    KIRI_AREA_SADDLE,
    KIRI_AREA_TWIST,
    KIRI_AREA_LEAN_U,
    KIRI_AREA_LEAN_V,
    KIRI_AREA_THICKNESS,
    KIRI_AREA_STRAINS
};

/* What one frame adds to the deformation gradient of an element. */
typedef struct kiriFrameShare {
    int32_t frame;
    kiriVec2 move, u, v; /* F = sum of x (x) move + A_u (x) u + A_v (x) v */
    double weight;       /* D = sum of weight d */
    kiriVec2 slope;      /* its gradient */
} kiriFrameShare;

typedef struct kiriAreaElement {
    double area; /* m^2 */
    double lean;
    int32_t first, count;      /* shares, by frame */
    int32_t firstRow, lastRow; /* the strains that count */
} kiriAreaElement;

typedef struct kiriAreaElements {
    KIRI_ARRAY(kiriAreaElement) elements;
    KIRI_ARRAY(kiriFrameShare) shares;
} kiriAreaElements;

/* How a strain changes with the columns of a frame: x, A_u, A_v, d. */
typedef struct kiriFrameRow {
    kiriVec3 by[4];
} kiriFrameRow;

/* The strains of an element from firstRow to lastRow and, unless `rows` is null, their derivatives: `count` a strain.
   Poses are those of all frames; null: as the frames are. */
void kiriAreaElement_Measure(const kiriAreaElement* element, const kiriFrameShare* shares, const kiriFrameData* frames,
                             const kiriPose* poses, double* strain, kiriFrameRow* rows);

/* Adds those of `from` whose frames are kept, which are all or none of an element's. False for memory. */
bool kiriAreaElements_Keep(kiriAreaElements* elements, kiriMemory* memory, const kiriAreaElements* from,
                           const kiriKeep* frames);
void kiriAreaElement_Stiffness(const kiriAreaElement* element, const kiriMaterial* material, double* stiffness);

/* The integration points of sections 5 and 6 of the paper: places where the strain is taken, of material that
   linear-blend skinning deforms. */

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
