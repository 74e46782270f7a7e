/* Patches of material that several affine frames deform together: the strains at a point of the mid-surface, to which
   the models of affine.h and point.h bring their own deformation gradients. */
#ifndef KIRI_PATCH_H
#define KIRI_PATCH_H

#include "kiri_prediction.h"
#include "../field/kiri_link.h"

/* With F = [F_u F_v] the deformation gradient of the mid-surface, D the director, D_u and D_v its slopes; Green
   strains, plane stress. Every energy is 1/2 stiffness strain^2; G = E / (2 (1 + nu)), K = E / (2 (1 - nu)), a the area. With a
   patch's `lean` above zero the products of F_u and F_v in the first three count their parts along D 1 + lean times.

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
    KIRI_PATCH_AREA,
    KIRI_PATCH_STRETCH,
    KIRI_PATCH_SHEAR,
    KIRI_PATCH_DOME,
    KIRI_PATCH_SADDLE,
    KIRI_PATCH_TWIST,
    KIRI_PATCH_LEAN_U,
    KIRI_PATCH_LEAN_V,
    KIRI_PATCH_THICKNESS,
    KIRI_PATCH_STRAINS
};

/* What one frame brings to a patch. */
typedef struct kiriShare {
    int32_t frame;
    kiriVec2 move, u, v; /* F = sum of x (x) move + A_u (x) u + A_v (x) v */
    double weight;       /* D = sum of weight d */
    kiriVec2 slope;      /* its gradient */
} kiriShare;

typedef struct kiriPatch {
    double area; /* m^2 */
    double lean;
    int32_t first, count;      /* shares, by frame */
    int32_t firstRow, lastRow; /* the strains that count */
} kiriPatch;

typedef struct kiriPatches {
    KIRI_ARRAY(kiriPatch) patches;
    KIRI_ARRAY(kiriShare) shares;
} kiriPatches;

/* How a strain changes with the columns of a frame: x, A_u, A_v, d. */
typedef struct kiriAffineRow {
    kiriVec3 by[4];
} kiriAffineRow;

/* The patch's strains from firstRow to lastRow and, unless `rows` is null, their derivatives: `count` a strain. Poses
   are those of all frames; null: as the frames are. */
void kiriPatch_Measure(const kiriPatch* patch, const kiriShare* shares, const kiriFrameData* frames,
                       const kiriPose* poses, double* strain, kiriAffineRow* rows);
void kiriPatch_Stiffness(const kiriPatch* patch, const kiriMaterial* material, double* stiffness);

#endif
