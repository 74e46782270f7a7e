/* How the free edges of a strip stiffen as it bends. Bent to the curvature k, a strip curls across to -nu k and has the
   bending stiffness D (1 - nu^2) W. But the curl moves the edges away from the axis of bending, which stretches them.
   So a wide thin strip curls at its edges only, and between them bends as a cylinder, with D W (Lamb, Proc. London
   Math. Soc. 21, 1891; Ashwell, J. Roy. Aero. Soc. 54, 1950). The section is a beam on an elastic foundation,
   D w'''' + E h k^2 w = 0 with w'' = -nu k and w''' = 0 at both edges. With its solution the energy of a length is

       1/2 D W (1 - nu^2 F) k^2,   F = (2 / theta) (cosh theta - cos theta) / (sinh theta + sin theta),
       theta^4 = 3 (1 - nu^2) W^4 k^2 / h^2.

   Twisted by tau at the same time, its fibres stretch by k w + tau^2 y^2 / 2 beyond the mean. With
   w + tau^2 y^2 / (2 k) for w the equation is the same, and the energy is

       1/2 D W ((1 - nu^2) k^2 + 2 (1 - nu) tau^2 + (tau^2 - nu k^2)^2 (1 - F) / k^2),

   where (1 - F) / k^2 stays finite for small k: E h W^5 tau^4 / 1440 is what the edges of a helix stretch. A ribbon
   that bends is easier to twist, for the two can make a surface that does not stretch.

   Regions are straight across. So that is the stiffness of a link where W is the width of a strip one region wide;
   where a border is open at one end only, the outer width is half of such a strip. Further in, regions curl by turning
   against each other, and their bending in the plane holds the curl back. */
#ifndef KIRI_CURL_H
#define KIRI_CURL_H

#include "../field/kiri_link.h"

KIRI_C_BEGIN

/* Of a link: its stiffness against bending by the angle b is that at b = 0 times 1 + gain (1 - F), theta^4 = perSquare
   b^2. */
typedef struct kiriCurl {
    double gain, perSquare;
} kiriCurl;

/* The part of a link's width that is open at both of its ends, m. */
static inline double kiriLink_LoneWidth(const kiriLink* link)
{
    double lone = 2.0 * link->outer - link->width;
    return kiriMax(lone, 0.0);
}

/* Where `curling` of the outer width stiffens. */
kiriCurl kiriCurl_Of(const kiriLink* link, const kiriMaterial* material, double curling);

/* By how much an angle counts more than at small angles: the square root of that factor; *slope is its derivative by
   the square of the angle. */
double kiriCurl_Factor(const kiriCurl* curl, double squaredAngle, double* slope);

/* (1 - F) / theta^4, which is 1 / 180 where theta is small; *slope is its derivative by theta^4. */
double kiriCurl_Held(double q, double* slope);

KIRI_C_END

#endif
