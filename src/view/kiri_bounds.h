/* A tree of boxes over the triangles of a surface, to find those near a point, a ray or a plane.

   The tree follows the rest plane: triangles that are near each other there share a leaf, and neighboring leaves a node.
   So motion changes only the boxes, which are fitted in one pass. New triangles get leaves at the end. The tree is rebuilt
   when the number of triangles has doubled. Results come in the order of triangles and do not depend on the tree, so bounds
   are not part of the state.

   Code that may change the world calls kiriBounds_Update. Readers cannot make a tree: they call kiriBounds_Ask, and search
   all triangles this once. From the end of the next tick on there are boxes, until no reader asked for
   KIRI_BOUNDS_PATIENCE ticks. */
#ifndef KIRI_BOUNDS_H
#define KIRI_BOUNDS_H

#include "kiri_surface.h"

KIRI_C_BEGIN

typedef struct kiriBox {
    kiriVec3 lower, upper;
} kiriBox;

enum { KIRI_BOUNDS_PATIENCE = 120, KIRI_BOUNDS_LEVELS = 20 };

typedef struct kiriBounds {
    int32_t asked;    /* above 0: by readers, from any thread; read by the tick alone */
    int32_t patience; /* ticks for which boxes are still kept */

    kiriIndices order;                  /* of triangles, leaf by leaf */
    KIRI_ARRAY(kiriBox) nodes;          /* leaves first, then each level above them; the last is the root */
    kiriFloats sides;                   /* of the triangles of each leaf, from surface->middle: lowest x of all, y, z, highest;
                                           empty: not known */
    KIRI_ARRAY(uint32_t) codes;         /* scratch of sorting */
    kiriIndices other;                  /* the same */
    int32_t firsts[KIRI_BOUNDS_LEVELS]; /* of each level: its first node */
    int32_t levelCount;                 /* 0: no tree */
    int32_t sorted;                     /* number of triangles when the tree was made */
    int64_t pose;                       /* surface->pose that the boxes fit */
    kiriFlags moves;                    /* of each node: 1 if a vertex of it is awake. Empty: not known */
    int64_t version;                    /* of the movers from which `moves` was made */
    KIRI_ARRAY(uint64_t) groups;        /* of each node: the groups of its triangles, bit g & 63 for group g */
} kiriBounds;

/* Vertices that are awake. */
typedef struct kiriMovers {
    const int32_t* data; /* of each block of vertices: KIRI_NONE if all sleep. Unused if the surface is not partly written */
    int32_t block;       /* vertices in a block */
    int64_t version;     /* 1 or more; changes whenever the data changes */
} kiriMovers;

static inline bool kiriBox_Meet(const kiriBox* a, const kiriBox* b)
{
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y &&
           b->lower.y <= a->upper.y && a->lower.z <= b->upper.z && b->lower.z <= a->upper.z;
}

#define KIRI_EMPTY_BOX ((kiriBox){ { DBL_MAX, DBL_MAX, DBL_MAX }, { -DBL_MAX, -DBL_MAX, -DBL_MAX } })

/* Enlarges the box to hold a point. */
static inline void kiriBox_Add(kiriBox* box, kiriVec3 at)
{
    box->lower = kiriVec3_Least(at, box->lower);
    box->upper = kiriVec3_Most(at, box->upper);
}

/* Returns the distance from a point to the farthest corner of the box. */
double kiriBox_Farthest(const kiriBox* box, kiriVec3 from);

/* Cuts the stretch [*low, *high] of a line to the box, enlarged by `by` (m). Returns false if nothing is left. */
bool kiriBox_Clip(const kiriBox* box, double by, kiriVec3 from, kiriVec3 along, double* low, double* high);

/* Gets the corners of a triangle in world space. */
void kiriSurface_Corners(const kiriSurface* surface, int32_t triangle, kiriVec3 corner[3]);

/* Computes the barycentric coordinates of the point of a triangle that is nearest to p. */
void kiriTriangle_Nearest(const kiriVec3 corner[3], kiriVec3 p, double share[3]);

/* Intersects a line with a triangle: the way along the line, and barycentric coordinates. Returns false if it misses. */
bool kiriTriangle_Cross(const kiriVec3 corner[3], kiriVec3 from, kiriVec3 along, double* way, double share[3]);

/* Returns true if the boxes fit the surface. All searches below need that. */
bool kiriBounds_IsFresh(const kiriBounds* bounds, const kiriSurface* surface);

/* Fits the boxes, and keeps them for the coming ticks. A no-op if they fit already. Returns false on out of memory. */
bool kiriBounds_Update(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface);

/* Asks for boxes in later ticks. Safe to call from several threads. */
void kiriBounds_Ask(const kiriBounds* bounds);

/* Update boxes in a tick. Reserve makes room for boxes of this many triangles, if boxes are used; Keep fits them after
   positions are written: only those that moved, if the others still fit. */
bool kiriBounds_Reserve(kiriBounds* bounds, kiriMemory* memory, int32_t triangleCount);
void kiriBounds_Keep(kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers);

/* Returns the box of the whole surface, which has a visible triangle. */
kiriBox kiriBounds_All(const kiriBounds* bounds);

/* Returns true if a box meets the searched space. Must be true for a box that holds another one for which it is true. */
typedef bool kiriMeetsFn(const void* context, const kiriBox* box);

/* Looks at a triangle. Returns the square of the distance, m^2, beyond which no other triangle matters. The result may not
   depend on the order of calls. */
typedef double kiriNearFn(void* context, int32_t triangle);

/* Triangles of one group. All corners of a triangle are in one group. */
typedef struct kiriGroup {
    const int32_t* ofVertex;
    int32_t group; /* 0 or more */
} kiriGroup;

/* Notes which groups are in each box, for kiriBounds_Nearest. If too many leaves have several groups, sorts the tree by
   group. Call it after kiriBounds_Update, and again when groups have changed. Returns false on out of memory. */
bool kiriBounds_Group(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface, const int32_t* ofVertex,
                      int32_t groupCount);

/* Notes the sides of all triangles, likewise, unless the boxes have not changed since. Returns false on out of memory. */
bool kiriBounds_FitSides(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface);

/* Calls `look` for triangles of a group whose boxes may be near enough to a box, nearer ones first. `most`: square of the
   distance at the start, m^2. */
void kiriBounds_Nearest(const kiriBounds* bounds, const kiriSurface* surface, kiriGroup group, const kiriBox* around,
                        double most, kiriNearFn* look, void* context);

/* Appends the triangles whose own box meets the searched space, in ascending order. Returns false on out of memory. */
bool kiriBounds_Find(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets, const void* context,
                     kiriMemory* memory, kiriIndices* found);

/* Appends the same triangles in no order; with takesBoxes also others of boxes that meet the space. Leaves out sleeping
   ones if `version` is the version of the movers in the last kiriBounds_Keep; 0: leaves out none. */
bool kiriBounds_FindMoving(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets,
                           const void* context, bool takesBoxes, int64_t version, kiriMemory* memory,
                           kiriIndices* found);

/* Finds the first triangle that the ray meets, up to maxDistance (m) along its direction, a unit vector; of two at the
   same distance the higher index. hit->triangle is KIRI_NONE if there is none. Tests all triangles if the bounds do not
   fit the surface, with the same result. */
void kiriSurface_Raycast(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction,
                         double maxDistance, kiriHit* hit);

KIRI_C_END

#endif
