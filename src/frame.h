/* Control frames: their state, and where they are placed (section 5 of the paper). */
#ifndef KIRI_FRAME_H
#define KIRI_FRAME_H

#include "shape.h"

/* A frame carries the rest point p to x + A (p - center). The center is the centroid of its region, so x is its
   centre of mass. */
typedef struct kiriFrameData {
    kiriFrame id;
    kiriSite site;
    kiriPoint anchor;       /* a point of the material in the site's cell: finds the cell again after a cut */
    kiriVec2 center;        /* local m */
    double area;            /* m^2 */
    double mass;            /* kg */
    double inertia[3];      /* integrals of density uu, uv, vv about the center, kg m^2 */
    kiriVec3 x;             /* m */
    kiriMat3 A;             /* rotation, but for affine frames */
    kiriVec3 velocity;      /* of x */
    kiriVec3 spin;          /* angular velocity, world */
    kiriMat3 rate;          /* how A changes beside spin x A, 1/s: not at all, but for affine frames */
    kiriVec3 force, torque; /* from the host, for one tick */
    int32_t held;           /* the host moves it: */
    kiriVec3 heldPosition;  /* of the site, */
    kiriMat3 heldRotation;
} kiriFrameData;

static inline kiriVec3 kiriFrame_Carry(const kiriFrameData* frame, kiriVec2 p)
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(frame->x, p.x - frame->center.x, frame->A.u), p.y - frame->center.y,
                              frame->A.v);
}

/* How A changes, 1/s. */
static inline kiriMat3 kiriFrame_Rate(const kiriFrameData* frame)
{
    kiriMat3 r = { kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.u), frame->rate.u),
                   kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.v), frame->rate.v),
                   kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.d), frame->rate.d) };
    return r;
}

/* The velocity of the rest point p. */
static inline kiriVec3 kiriFrame_VelocityAt(const kiriFrameData* frame, kiriVec2 p)
{
    kiriVec3 arm = kiriVec3_Sub(kiriFrame_Carry(frame, p), frame->x);
    kiriVec3 velocity = kiriVec3_Add(frame->velocity, kiriVec3_Cross(frame->spin, arm));
    velocity = kiriVec3_AddScaled(velocity, p.x - frame->center.x, frame->rate.u);
    return kiriVec3_AddScaled(velocity, p.y - frame->center.y, frame->rate.v);
}

/* ---- Placing (section 5 of the paper) ---- */

typedef struct kiriPlacerWork kiriPlacerWork; /* private to frame.c */

/* Puts sites evenly into a part of the sheet: farthest-point sampling, then Lloyd relaxation of the new ones only. A
   job that a budget may interrupt. */
typedef struct kiriPlacer {
    kiriSites sites;           /* those that were there, then the new ones; right when Run is done */
    int32_t oldCount;          /* sites before it stay where they are */
    KIRI_ARRAY(int32_t) cells; /* the part: cells that hang together, in their order (or all cells, of many pieces) */
    /* Distances to the sites that are there, as kiriRegions has them, where the caller knows them; they must stay
       until the job is done. Null: they are flooded. Start takes it, and makes it null. */
    const kiriField* known;
    kiriPlacerWork* work;
} kiriPlacer;

/* The cells that hang together with this one over faces, in the order of cells, into placer->cells. False for
   memory. */
bool kiriPlacer_TakePiece(kiriPlacer* placer, const kiriMemory* memory, const kiriGrid* grid, int32_t cell);

/* For the part in placer->cells and the sites in placer->sites, which lie in it: `count` more. Sampling takes only
   cells that `allowed` marks (one byte a cell of the grid; null: all); it is read now and not kept. Fewer when there
   are fewer free cells. One site in a part without sites goes to the cell nearest to its centroid, without
   relaxation: confetti comes in thousands. False for memory. */
bool kiriPlacer_Start(kiriPlacer* placer, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      const uint8_t* allowed, int32_t count);

/* An item of the quota is a cell looked at or settled. After KIRI_FAILED, start again. */
kiriProgress kiriPlacer_Run(kiriPlacer* placer, const kiriMemory* memory, const kiriGrid* grid,
                            const kiriMeshData* mesh, kiriQuota* quota);
void kiriPlacer_Release(kiriPlacer* placer, const kiriMemory* memory);

/* The site that a frame takes in a cell. */
kiriSite kiriFrames_SiteIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

/* Gives the frame the mass and centre of its region; the motion of the material does not change. */
void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea);

#endif
