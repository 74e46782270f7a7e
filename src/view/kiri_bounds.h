/* Boxes over the triangles of a surface, in a tree, to find those near a point, a ray or a plane.

   The shape of the tree follows the rest plane: triangles that lie near each other there share a leaf, and neighbouring
   leaves a node. So it is made once and holds however the sheet moves; only boxes are fitted anew, all of them, in one
   pass over the triangles. Where pieces ask for what is near, each has leaves of its own. Triangles that a cut makes
   come in leaves of their own at the end, in the order in which the blade made them; the tree is made anew when their
   number has doubled. What a query finds does not depend on any of this: it is in the order of triangles. So bounds are
   no part of the state.

   Who pays: a surface nobody asks about has no tree. Whoever may change the world calls kiriBounds_Update when he needs
   it. Whoever only reads cannot make one: he leaves word (kiriBounds_Ask), looks at all triangles this once, and from
   the end of the next tick on (kiriBounds_Reserve, kiriBounds_Keep) there are boxes, until KIRI_BOUNDS_PATIENCE ticks
   have passed in which nobody asked. */
#ifndef KIRI_BOUNDS_H
#define KIRI_BOUNDS_H

#include "kiri_surface.h"

KIRI_C_BEGIN

typedef struct kiriBox {
    kiriVec3 lower, upper;
} kiriBox;

enum { KIRI_BOUNDS_PATIENCE = 120, KIRI_BOUNDS_LEVELS = 20 };

typedef struct kiriBounds {
    int32_t asked;    /* by readers, from any thread: written without tearing, and read by the tick alone */
    int32_t patience; /* ticks for which boxes are still kept */

    KIRI_ARRAY(int32_t) order;          /* of triangles, leaf by leaf */
    KIRI_ARRAY(kiriBox) nodes;          /* leaves first, then each level above them; the last is the root */
    KIRI_ARRAY(uint32_t) codes;         /* room to sort */
    KIRI_ARRAY(int32_t) other;          /* the same */
    int32_t firsts[KIRI_BOUNDS_LEVELS]; /* of each level: its first node; */
    int32_t levelCount;                 /* so many levels, 0: there is no tree */
    int32_t sorted;                     /* triangles there were when the tree was made */
    int64_t pose;                       /* surface->pose that the boxes fit */
    KIRI_ARRAY(uint8_t) moves;          /* of each node: is any of it awake? Empty: not known */
    int64_t version;                    /* of the movers that say so */
    KIRI_ARRAY(uint64_t) groups; /* of each node, see kiriBounds_Group: those of its triangles, a bit each modulo 64 */
} kiriBounds;

/* Which vertices are awake, by blocks of so many: KIRI_NONE where none is. The version is another whenever that
   changes. */
typedef struct kiriMovers {
    const int32_t* data; /* or null: not known */
    int32_t block;
    int64_t version; /* 1 or more */
} kiriMovers;

static inline bool kiriBox_Meet(const kiriBox* a, const kiriBox* b)
{
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y &&
           b->lower.y <= a->upper.y && a->lower.z <= b->upper.z && b->lower.z <= a->upper.z;
}

/* The same for boxes that are so far apart at most, along each axis. */
static inline bool kiriBox_MeetWithin(const kiriBox* a, const kiriBox* b, double distance)
{
    const kiriVec3 d = { distance, distance, distance };
    const kiriBox wider = { kiriVec3_Sub(a->lower, d), kiriVec3_Add(a->upper, d) };
    return kiriBox_Meet(&wider, b);
}

/* The box grows to hold a point. */
void kiriBox_Add(kiriBox* box, kiriVec3 at);

/* The least box around a triangle as it is seen. */
kiriBox kiriBox_OfTriangle(const kiriSurface* surface, int32_t triangle);

/* Triangles were taken away: the next tree is made anew. */
void kiriBounds_Forget(kiriBounds* bounds);

/* Do the boxes fit what is seen? All queries below ask for that. */
bool kiriBounds_IsFresh(const kiriBounds* bounds, const kiriSurface* surface);

/* Boxes that fit, and that are kept for the coming ticks. Costs nothing where they fit already. False for memory. */
bool kiriBounds_Update(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface);

/* Word from somebody who reads. Any number of threads may call it at the same time. */
void kiriBounds_Ask(const kiriBounds* bounds);

/* For the tick. Room for so many triangles, where boxes are wanted; then, when positions are written, the boxes: of
   what moves alone, where the surface was written so. */
bool kiriBounds_Reserve(kiriBounds* bounds, kiriMemory* memory, int32_t triangleCount);
void kiriBounds_Keep(kiriBounds* bounds, const kiriSurface* surface, const kiriMovers* movers);

/* The box of the whole surface; the surface must have a triangle. */
kiriBox kiriBounds_All(const kiriBounds* bounds);

/* Does a box meet what is looked for? It may say so of a box that does not, never the other way round, and must say so
   of a box that holds one it says so of. */
typedef bool kiriMeetsFn(const void* context, const kiriBox* box);

/* Looks at a triangle; returns the square of the distance, m^2, beyond which no other is asked for. */
typedef double kiriNearFn(void* context, int32_t triangle);

/* Triangles of one group; all corners of a triangle are in one. */
typedef struct kiriGroup {
    const int32_t* ofVertex;
    int32_t group; /* 0 or more */
} kiriGroup;

/* Finds out which groups boxes have triangles of, so that kiriBounds_Nearest leaves out boxes of others, and where too
   many leaves have several, makes the tree anew, group by group. To be called after kiriBounds_Update, again where
   groups have changed. False for memory. */
bool kiriBounds_Group(kiriBounds* bounds, kiriMemory* memory, const kiriSurface* surface, const int32_t* ofVertex,
                      int32_t groupCount);

/* Has the triangles of a group looked at that may be that near, the nearer boxes first. `most` is what holds at the
   start. */
void kiriBounds_Nearest(const kiriBounds* bounds, const kiriSurface* surface, kiriGroup group, kiriVec3 from,
                        double most, kiriNearFn* look, void* context);

/* Appends the triangles whose own box meets it, by index. False for memory. */
bool kiriBounds_Find(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets, const void* context,
                     kiriMemory* memory, kiriIndices* found);

/* All triangles of the leaves whose box meets it: some more than those, in no order. Where each is looked at anyway
   that is cheaper. Leaves out what sleeps, where `version` is that of the movers by which boxes were kept last; 0:
   nothing. */
bool kiriBounds_FindLeaves(const kiriBounds* bounds, const kiriSurface* surface, kiriMeetsFn* meets,
                           const void* context, int64_t version, kiriMemory* memory, kiriIndices* found);

/* The same for those whose box meets a box. */
bool kiriBounds_Box(const kiriBounds* bounds, const kiriSurface* surface, const kiriBox* box, kiriMemory* memory,
                    kiriIndices* found);

/* Calls `visit` for the triangles of each leaf that the ray meets before *distance (in units of its direction), which
   `visit` may shorten. Leaves come in a fixed order, which is not that of the ray. */
typedef void kiriVisitFn(void* context, const int32_t* triangles, int32_t count, double* distance);
void kiriBounds_Ray(const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction, double distance, kiriVisitFn* visit,
                    void* context);

/* Rays that meet the surface in world space. */

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
