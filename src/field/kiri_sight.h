/* Straight ways in the rest plane: where they meet the outline or a slit. */
#ifndef KIRI_SIGHT_H
#define KIRI_SIGHT_H

#include "kiri_grid.h"

KIRI_C_BEGIN

/* What may be looked at: squares that hold a cell of one of these regions. So what is seen depends on nothing that does
   not make one of them dirty. */
typedef struct kiriSight {
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const int32_t* owner; /* of each cell: its region */
    const int32_t* regions;
    int32_t regionCount;
} kiriSight;

typedef enum kiriSightEnd {
    KIRI_SIGHT_CLEAR,
    KIRI_SIGHT_EDGE, /* the outline, or an open edge */
    KIRI_SIGHT_LOST  /* a square that may not be looked at */
} kiriSightEnd;

/* What was met: */
typedef struct kiriSightHit {
    double share;     /* how far one sees, of the way */
    kiriVec2 edge[2]; /* EDGE: its ends, local m */
} kiriSightHit;

/* Looks from p to q, local m, both in the material or on its edges. What is within a millionth of a square's side of p,
   of q or of the way only touches it: both may lie on edges, and the way may run along one. */
kiriSightEnd kiriSight_Cast(const kiriSight* sight, kiriVec2 p, kiriVec2 q, kiriSightHit* hit);

/* The edges of the material: the outline, and both lips of slits. Each keeps the material to its left. */
static inline bool kiriSight_IsEdge(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_Twin(mesh, h) == KIRI_NONE || kiriMesh_IsOpen(mesh, h);
}
static inline bool kiriSight_HasEdge(const kiriMeshData* mesh, int32_t triangle)
{
    const kiriTriangle* t = &mesh->triangles.data[triangle];
    return t->open != 0 || (t->twin[0] | t->twin[1] | t->twin[2]) < 0; /* KIRI_NONE has the sign bit */
}
kiriLatticePoint kiriSight_HeadOf(const kiriMeshData* mesh, int32_t h);

/* The next edge of the material after one, around its head. */
int32_t kiriSight_EdgeAfter(const kiriMeshData* mesh, int32_t h);

/* Is a cell of one of the regions? Has a square such a cell? */
bool kiriSight_MayLookIn(const kiriSight* sight, int32_t cell);
bool kiriSight_MayLookAt(const kiriSight* sight, int32_t square);

static inline bool kiriSight_IsClear(const kiriSight* sight, kiriVec2 p, kiriVec2 q)
{
    kiriSightHit hit;
    return kiriSight_Cast(sight, p, q, &hit) == KIRI_SIGHT_CLEAR;
}

KIRI_C_END

#endif
