/* Area elements: parts of the mid-surface that several affine frames deform together. An element has the strains at one
   point. kiri_strain.h and kiri_solver.h make elements, each with its own deformation gradient. */
#ifndef KIRI_ELEMENT_H
#define KIRI_ELEMENT_H

#include "kiri_frame.h"
#include "../field/kiri_link.h"
#include "../field/kiri_site.h"
#include "../field/kiri_stencil.h"

KIRI_C_BEGIN

/* F = [F_u F_v] is the deformation gradient of the mid-surface, D the director, D_u and D_v its slopes. Green strains,
   plane stress. Every energy is 1/2 stiffness strain^2; G = E / (2 (1 + nu)), K = E / (2 (1 - nu)), a the area. If an
   element's `lean` is above zero, the products of F_u and F_v in the first three strains weight the parts along D by
   1 + lean.

   strain     value                                  stiffness
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

/* Contribution of one frame to the deformation gradient of an element. */
typedef struct kiriFrameShare {
    int32_t frame;
    kiriVec2 move, u, v; /* F = sum of x (x) move + A_u (x) u + A_v (x) v */
    double weight;       /* D = sum of weight d */
    kiriVec2 slope;      /* gradient of the weight */
} kiriFrameShare;

typedef struct kiriAreaElement {
    double area; /* m^2 */
    double lean;
    int32_t first, count;      /* its shares, sorted by frame */
    int32_t firstRow, lastRow; /* range of its strains; lastRow is exclusive */
} kiriAreaElement;

typedef struct kiriAreaElements {
    KIRI_ARRAY(kiriAreaElement) elements;
    KIRI_ARRAY(kiriFrameShare) shares;
} kiriAreaElements;

/* Derivative of a strain by the columns of a frame: x, A_u, A_v, d. */
typedef struct kiriFrameRow {
    kiriVec3 by[4];
} kiriFrameRow;

/* Measures the element's strains and, unless `rows` is null, their derivatives: `count` rows a strain. poses[] has all
   frames; null: the current poses of the frames. */
void kiriAreaElement_Measure(const kiriAreaElement* element, const kiriFrameShare* shares, const kiriFrameData* frames,
                             const kiriPose* poses, double* strain, kiriFrameRow* rows);

/* Adds the elements of `from` whose frames are kept. Either all frames of an element are kept or none. Fails on out of
   memory. */
bool kiriAreaElements_Keep(kiriAreaElements* elements, kiriMemory* memory, const kiriAreaElements* from,
                           const kiriKeep* frames);
void kiriAreaElement_Stiffness(const kiriAreaElement* element, const kiriMaterial* material, double* stiffness);

/* Integration points (sections 5 and 6 of the paper): points at which the strain of the material is measured. The
   material deforms by linear-blend skinning. */

/* Scratch. Updates reuse its capacity. Zero-initialised: empty. */
typedef struct kiriIntegrationWork {
    kiriPlacer placer; /* of the current piece */
    kiriField field;   /* distances from its points */
    kiriSeeds seeds;
    kiriFlags seen;                   /* per cell: 1 if the points of its piece exist */
    KIRI_ARRAY(kiriMoments) material; /* per point of the current piece: its region */
    kiriPointWeights weights;         /* of the current point */
} kiriIntegrationWork;

/* Makes about `count` integration points (not necessarily an integer), relaxed on the grid, at least one in every
   piece. Each represents its region of the grid. Order 1: the strain at the point applies to the whole region. Order 2:
   the strain is linear in the region (after the elastons of Martin et al. 2010). It is measured at four places that
   have the region's second moments, at four times the cost. `material`: one entry for each frame's region. Fails on out
   of memory. */
bool kiriIntegration_Build(kiriAreaElements* elements, kiriIntegrationWork* work, const kiriGrid* grid,
                           const kiriShape* shape, const kiriMoments* material, double count, int32_t order,
                           bool planar);

KIRI_C_END

#endif
