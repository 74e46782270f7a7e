/* Rays that meet the surface in world space. */
#ifndef KIRI_RAY_H
#define KIRI_RAY_H

#include "kiri_bounds.h"

KIRI_C_BEGIN

/* The first triangle that the ray meets, up to maxDistance (m) along its direction, a unit vector; of two at the same
   distance the one with the higher index. hit->triangle is -1 when there is none. Where the bounds do not fit the
   surface, or are null, it looks at every triangle, and finds the same. */
void kiriSurface_Raycast(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction,
                         double maxDistance, kiriHit* hit);

/* Where an edge meets the surface. */
typedef struct kiriCrossing {
    kiriVec2 rest; /* local */
    kiriVec3 at;
    double share; /* along the edge, 0 to 1 */
    int32_t triangle;
} kiriCrossing;

typedef KIRI_ARRAY(kiriCrossing) kiriCrossings;

/* Appends all crossings of the edge with the surface, which its bounds must fit; of those that are nearer than `apart`
   in the rest plane (an edge of the mesh has two) one. False for memory. */
bool kiriSurface_Cross(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 from, kiriVec3 to, double apart,
                       kiriMemory* memory, kiriCrossings* crossings);

KIRI_C_END

#endif
