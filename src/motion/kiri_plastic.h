/* Plastic bending of links. A material with a yield stress keeps a part of its bending, so creases stay. A rest curvature
   is such a part from the start. */
#ifndef KIRI_PLASTIC_H
#define KIRI_PLASTIC_H

#include "kiri_refit.h"
#include "../field/kiri_link.h"

KIRI_C_BEGIN

/* The law is the law of a section whose material is linear up to the yield stress s, and then has the modulus H E,
   where H is kiriMaterial.hardening. kappa = 2 s / (E h) is the curvature at which the surface yields. With c = curvature
   / kappa and M = D kappa the moment is M g(c):

       g(c) = c                                       up to c = 1
       g(c) = (1 - H) (3/2 - 1 / (2 c^2)) + H c       beyond

   A link of length l yields at the angle L = kappa l. Bending, twist and fold are one vector. Its length r counts twist
   and fold by their stiffness over the stiffness of bending, so the flow has the direction of the moment. `reach` is the
   largest c so far. After it the plastic angle L (reach - g(reach)) has flowed. So a trial strain of length r has
   c = r / L + reach - g(reach), and flows if L g(c) < r. Then the elastic strain is the trial strain times L g(c) / r.

   A step contains the flow: its objective has the energy that the link stores, plus the energy that flow takes in the
   step. This sum is convex in the strain, and its derivative is the moment at the end of the step. */

/* The strains of a link that flow, rad. */
typedef struct kiriBentStrain {
    double bending, twist, fold;
} kiriBentStrain;

/* The plastic state of a link or of a clamp. Near half a turn strains move from bending and twist to the fold, and the
   plastic part does, too. */
typedef struct kiriPlastic {
    kiriBentStrain part; /* a part of the link's strain offset; it does not fade */
    double reach;  /* 0 or 1: it never yielded */
} kiriPlastic;

/* Returns the state of a link that never yielded, of a material with a rest curvature. */
kiriPlastic kiriPlastic_AtRest(const kiriMaterial* material, const kiriLink* link);

/* Changes a state to another rest curvature. */
void kiriPlastic_Rest(kiriPlastic* plastic, const kiriMaterial* before, const kiriMaterial* now, const kiriLink* link);

/* A link in one step. Zero: elastic. */
typedef struct kiriYield {
    double limit;                       /* rad, L above; 0: elastic */
    double hardening, reach, flowed;    /* `flowed` is reach - g(reach) */
    double stiffness, perTwist, perFold; /* N m; relative to the first */
    kiriBentStrain start, elastic;       /* strain offset, and strain without it, at the start of the step */
    /* For the last strains that were measured. */
    bool flows, turns; /* `turns`: flows without a fold, see kiriYield_TurnRows */
    double share, slope; /* elastic strain over trial strain; derivative of g */
    double c, lost;      /* J: energy that the flow takes */
    double along[2];     /* unit vector of the flow: bending, and twist times sqrt(perTwist) */
} kiriYield;

/* Prepares a link of that length for a step. stiffness: of bending, twist and fold; strain: at the start of the step. */
void kiriYield_Begin(kiriYield* yield, const kiriPlastic* plastic, const kiriMaterial* material, double length,
                     const kiriBentStrain* stiffness, const kiriBentStrain* offset, const kiriBentStrain* strain);

/* Finds the flow at a strain, and writes the offset that the strain has then. Nothing flows without `mayFlow`. */
void kiriYield_Flow(kiriYield* yield, const kiriBentStrain* strain, bool mayFlow, kiriBentStrain* offset);

/* Turns the derivatives of bending and twist of a link that flows, `width` numbers each, to the direction of the flow and
   the direction across it. Writes the derivatives of the elastic strains to `elastic`, unless they are null. In a fold
   rows stay. */
void kiriYield_TurnRows(const kiriYield* yield, int width, double* bending, double* twist, double* const elastic[2]);

/* Changes springs and pulls to fit the turned rows. loss: damping of bending; change: of the strains in the step. */
void kiriYield_TurnSprings(const kiriYield* yield, double loss, const kiriBentStrain* change, kiriBentStrain* springs,
                           kiriBentStrain* pulls);

/* Keeps the flow of a step that ended with this strain; `offset` as kiriYield_Flow wrote it. */
void kiriYield_End(const kiriYield* yield, const kiriBentStrain* strain, kiriPlastic* plastic, kiriBentStrain* offset);

/* A symmetric tensor of the rest plane. */
typedef struct kiriTensor {
    double uu, uv, vv;
} kiriTensor;

/* Returns the T that minimises the sum of w |T s - value|^2. m: sum of w s s^T, B: sum of w value s^T, in rows. The equations
   are T m + m T = B + B^T, divided by two:

       [ uu  uv  0       ]          [ B_uu        ]
       [ uv  uu + vv  uv ] (T)  =   [ B_uv + B_vu ]
       [ 0   uv  vv      ]          [ B_vv        ]

   If all s have one direction, a small addition to m makes the undetermined part of T zero. */
kiriTensor kiriTensor_Solve(kiriTensor m, const kiriVec2 B[2]);

/* The plastic curvature of a region beyond the rest curvature, fitted to its links. */
typedef struct kiriPlasticRegion {
    kiriTensor bent, matrix; /* 1/m; scratch */
    kiriVec2 by[2];          /* scratch */
    double reach, weight;
} kiriPlasticRegion;

/* Lowers the limits of links that see a part of the curvature. A link sees K n, so in a layout of squares that is bent along
   a diagonal each link sees 0.7 of the curvature. With T the mean of the elastic curvatures that fit its regions, the limit of
   a link is lower by |T n| / |T|, if it is bent less than that. regions: scratch, one a frame. */
void kiriYields_Share(kiriYield* yields, const kiriLink* links, int32_t linkCount, kiriPlasticRegion* regions,
                      int32_t frameCount);

/* Plastic states of the links of a sheet. */
typedef struct kiriPlastics {
    bool isKept; /* links have states: the material yields or has a rest curvature, or once did */
    KIRI_ARRAY(kiriPlastic) links, next;    /* one a link, if isKept; scratch */
    KIRI_ARRAY(kiriPlasticRegion) regions;  /* scratch: one a frame */
} kiriPlastics;

/* Reserves room. Fails on out of memory. */
bool kiriPlastics_Reserve(kiriPlastics* plastics, kiriMemory* memory, int32_t linkCount, int32_t frameCount);

/* Fits regions to the links before a commit. Frames from oldCount on are new: they get the mean of the regions from which
   their material comes. Cannot fail. */
void kiriPlastics_Remember(kiriPlastics* plastics, const kiriLink* links, int32_t linkCount, int32_t oldCount,
                           int32_t frameCount, const kiriOwnership* ownership, const kiriMaterial* material, double extent);

/* Takes the links after the commit. from[k]: the old link that link k goes on from, or KIRI_NONE. Others get the mean
   curvature of their regions. Cannot fail. */
void kiriPlastics_Take(kiriPlastics* plastics, const kiriLink* old, const kiriLink* links, int32_t linkCount,
                       const int32_t* from, const kiriMaterial* material);

/* Returns the state of a link that replaces one of another length. */
kiriPlastic kiriPlastic_Scaled(const kiriPlastic* plastic, double scale);

KIRI_C_END

#endif
