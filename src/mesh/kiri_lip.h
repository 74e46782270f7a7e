/* Finds the lips that a blade joins, near a point or along a line. A lip is an edge that a cut has opened; here the outline
   of the sheet counts as a lip, too. A crease is a lip for folds alone: a cut goes through it, or along it. */
#ifndef KIRI_LIP_H
#define KIRI_LIP_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* A strip around a directed line. Distances are lattice steps. */
typedef struct kiriCorridor {
    const kiriMeshData* mesh;
    kiriLatticePoint from, to;
    double length;
    double on;      /* points this near are on the line */
    double reach;   /* half the width of the strip */
    bool isFold;    /* creases are lips */
    int64_t effort; /* about ns */
} kiriCorridor;

kiriCorridor kiriCorridor_Make(const kiriMeshData* mesh, kiriLatticePoint from, kiriLatticePoint to, double on,
                               double reach, bool isFold);

/* Returns the distance from the line, positive on its left. */
double kiriCorridor_Side(const kiriCorridor* corridor, kiriLatticePoint p);

/* Returns the way along the line, times the length of the line. Exact. */
int64_t kiriCorridor_Progress(const kiriCorridor* corridor, kiriLatticePoint p);

/* Return the half-edges that start at the point of a vertex, counter-clockwise, also across open edges: from the
   outline on, or all around. NextAround returns KIRI_NONE after the last. */
int32_t kiriMesh_FirstAround(const kiriMeshData* mesh, int32_t vertex);
int32_t kiriMesh_NextAround(const kiriMeshData* mesh, int32_t h, int32_t first);

/* Returns the newest vertex at a point, or KIRI_NONE. */
int32_t kiriMesh_VertexAt(const kiriMeshData* mesh, kiriLatticePoint at, int64_t* effort);

/* Rounds the point at this share of the way from a to b. */
kiriLatticePoint kiriLattice_Between(kiriLatticePoint a, kiriLatticePoint b, double share);

/* Rounds the point of the segment from a to b that is nearest to p. */
kiriLatticePoint kiriLattice_Nearest(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint p);

/* A point on a lip. */
typedef struct kiriLipPoint {
    int32_t edge; /* a half-edge of the lip, or KIRI_NONE */
    kiriLatticePoint at;
} kiriLipPoint;

/* Lips near the end of the corridor. */
typedef struct kiriLipsNear {
    kiriLipPoint own;   /* the nearest point of a lip that leads there from `vertex` without leaving the corridor */
    kiriLipPoint other; /* of another lip: where the line meets it, else its nearest point */
} kiriLipsNear;

/* Finds the lips near the end of the corridor. `vertex`: the vertex at the blade, or KIRI_NONE. */
kiriLipsNear kiriLip_FindNear(kiriCorridor* corridor, int32_t vertex);

/* Slope, one over this, at which the blade leaves the line along a lip, and comes back to it. */
enum { KIRI_SHALLOW = 3 };

/* Follows lips from a vertex within the corridor, to the first place where they come back on the line, at most as far as
   `limit`; else to the farthest place beside the line, if the lips lead there at a small angle. Returns false if there is
   none. */
bool kiriLip_Follow(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint limit, kiriLipPoint* place);

/* A vertex of a lip that a cut along the line joins. */
typedef struct kiriLipStop {
    kiriLatticePoint foot; /* where the cut leaves the line for it; `at` where it is on the line */
    kiriLatticePoint at;
} kiriLipStop;

/* Finds the first such vertex beyond `after`. One beside the line is joined if no lip leads from it to the line, or near the
   line to the vertex at the blade (or KIRI_NONE), and no vertex that lips lead to is nearer. Returns false if there is none. */
bool kiriLip_FindStop(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint after, kiriLipStop* stop);

KIRI_C_END

#endif
