#include "kiri_nearest.h"

#include <string.h>

#define STEEP 0.5           /* beside a border: what is off along the surface, by what is off across it */
#define FLAT_TRIANGLE 0.25  /* of the distance that they keep: lower than that, and */
#define INSIDE_TRIANGLE 0.5 /* the same: no farther inside of the border than that, lips lie beside each other */

/* Where on a triangle a place is: inside (KIRI_NONE), on edge 0 to 2, or at corner 0 to 2. */
typedef struct Place {
    double share[3];
    int edge, corner;
} Place;

static Place AtCorner(int corner)
{
    Place place = { { 0.0, 0.0, 0.0 }, KIRI_NONE, corner };
    place.share[corner] = 1.0;
    return place;
}

static Place OnEdge(int edge, double t)
{
    Place place = { { 0.0, 0.0, 0.0 }, edge, KIRI_NONE };
    place.share[edge] = 1.0 - t;
    place.share[(edge + 1) % 3] = t;
    return place;
}

/* Ericson, Real-Time Collision Detection, 5.1.5: by the Voronoi regions of corners, edges and the inside. */
static Place NearestOnTriangle(kiriVec3 p, kiriVec3 a, kiriVec3 b, kiriVec3 c)
{
    kiriVec3 ab = kiriVec3_Sub(b, a), ac = kiriVec3_Sub(c, a);
    kiriVec3 ap = kiriVec3_Sub(p, a), bp = kiriVec3_Sub(p, b), cp = kiriVec3_Sub(p, c);
    double d1 = kiriVec3_Dot(ab, ap), d2 = kiriVec3_Dot(ac, ap);
    double d3 = kiriVec3_Dot(ab, bp), d4 = kiriVec3_Dot(ac, bp);
    double d5 = kiriVec3_Dot(ab, cp), d6 = kiriVec3_Dot(ac, cp);
    double onA = d3 * d6 - d5 * d4, onB = d5 * d2 - d1 * d6, onC = d1 * d4 - d3 * d2;
    if (d1 <= 0.0 && d2 <= 0.0) {
        return AtCorner(0);
    }
    if (d3 >= 0.0 && d4 <= d3) {
        return AtCorner(1);
    }
    if (d6 >= 0.0 && d5 <= d6) {
        return AtCorner(2);
    }
    if (onC <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        return OnEdge(0, d1 / (d1 - d3));
    }
    if (onB <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        return OnEdge(2, 1.0 - d2 / (d2 - d6));
    }
    if (onA <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return OnEdge(1, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    double sum = onA + onB + onC;
    Place inside = { { onA / sum, onB / sum, onC / sum }, KIRI_NONE, KIRI_NONE };
    return inside;
}

/* m: how far inside of the border the place is, by the edges of its triangle and by corners at which others have border
   edges; far, where there are none. */
static double WayToBorder(const kiriSheetData* sheet, const kiriNear* near)
{
    const kiriTriangle* t = &sheet->mesh.triangles.data[near->triangle];
    const kiriSurface* surface = &sheet->seen.surface;
    double least = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        kiriVec3 from = kiriSurface_At(surface, t->vertex[k]), to = kiriSurface_At(surface, t->vertex[(k + 1) % 3]);
        kiriVec3 apex = kiriSurface_At(surface, t->vertex[(k + 2) % 3]), edge = kiriVec3_Sub(to, from);
        double area = kiriVec3_Length(kiriVec3_Cross(edge, kiriVec3_Sub(apex, from)));
        double way = near->share[(k + 2) % 3] * area / kiriVec3_Length(edge);
        bool isBorder = t->twin[k] == KIRI_NONE || (t->marks >> k & 1) != 0;
        least = isBorder && way < least ? way : least;
        kiriVec3 in = kiriVec3_AddScaled(kiriVec3_Scale(near->share[(k + 1) % 3], edge), near->share[(k + 2) % 3],
                                         kiriVec3_Sub(apex, from));
        double off = kiriVec3_Length(in);
        least = sheet->probes.isBorder.data[t->vertex[k]] && off < least ? off : least;
    }
    return least;
}

/* The place on one triangle; its distance, squared. */
static double Measure(kiriNear* near, const kiriBody* bodies, int32_t triangle)
{
    const kiriSheetData* sheet = bodies[near->other].sheet;
    const kiriSurface* surface = &sheet->seen.surface;
    const int32_t* corners = &surface->indices.data[3 * (size_t)triangle];
    kiriVec3 a = kiriSurface_At(surface, corners[0]), b = kiriSurface_At(surface, corners[1]);
    kiriVec3 c = kiriSurface_At(surface, corners[2]);
    kiriVec3 p = kiriSurface_At(&bodies[near->body].sheet->seen.surface, near->vertex);
    Place place = NearestOnTriangle(p, a, b, c);
    kiriVec3 q = kiriVec3_Scale(place.share[0], a);
    q = kiriVec3_AddScaled(kiriVec3_AddScaled(q, place.share[1], b), place.share[2], c);
    kiriVec3 off = kiriVec3_Sub(p, q);
    near->triangle = triangle;
    memcpy(near->share, place.share, sizeof(near->share));
    near->normal = kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(c, a)));
    near->height = kiriVec3_Dot(near->normal, off);
    return kiriVec3_Dot(off, off);
}

/* Lips of a fresh cut lie in one plane, and may overlap a little when they move: they are beside each other, and not
   one on the other. */
static bool IsBeside(const kiriNear* near, const kiriBody* bodies, double distance, double squared)
{
    const kiriSheetData* sheet = bodies[near->other].sheet;
    double across = near->height * near->height, way = WayToBorder(sheet, near);
    bool isLip = bodies[near->body].sheet->probes.isBorder.data[near->vertex];
    return (way <= 0.0 && squared - across >= STEEP * STEEP * across) ||
           (isLip && way < INSIDE_TRIANGLE * distance && fabs(near->height) < FLAT_TRIANGLE * distance);
}

typedef struct Looking {
    kiriNear* near;
    const kiriBody* bodies;
    double least; /* m^2 */
    bool found;
} Looking;

static double LookAtTriangle(void* context, int32_t triangle)
{
    Looking* looking = context;
    kiriNear one = *looking->near;
    double squared = Measure(&one, looking->bodies, triangle);
    bool isLower = looking->found && squared == looking->least && triangle < looking->near->triangle;
    if (squared < looking->least || isLower) {
        looking->least = squared;
        *looking->near = one;
        looking->found = true;
    }
    return looking->least;
}

bool kiriNearest_Find(kiriNear* near, const kiriBody* bodies, double reach, double distance)
{
    Looking looking = { near, bodies, reach * reach, false };
    const kiriSheetData* other = bodies[near->other].sheet;
    kiriVec3 from = kiriSurface_At(&bodies[near->body].sheet->seen.surface, near->vertex);
    kiriGroup piece = { other->probes.vertexPiece.data, bodies[near->other].piece };
    kiriBounds_Nearest(other->seen.bounds, &other->seen.surface, piece, from, looking.least, LookAtTriangle, &looking);
    return looking.found && !IsBeside(near, bodies, distance, looking.least);
}
