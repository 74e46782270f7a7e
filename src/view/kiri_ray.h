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

KIRI_C_END

#endif
