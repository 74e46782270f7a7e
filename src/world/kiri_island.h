/* Islands: bodies, of one sheet or of several, that mutual contacts join. A step solves them as one system, so pushes and
   their reactions are of the same step, and momentum is kept. Clusters: sheets whose bodies share islands. They take
   their substeps together. */
#ifndef KIRI_ISLAND_H
#define KIRI_ISLAND_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Joins the sheets of mutual contacts to clusters. Call it after touches are found. Fails on out of memory. */
bool kiriIslands_FindClusters(kiriWorld* world);

/* Begins the motion of all sheets in clusters, whose pins have begun (kiriMoves_BeginClusters), joins their bodies to
   islands, and shapes the matrices of islands. Call it after the commit. On out of memory returns false: then contacts
   between surfaces are left out in this tick. */
bool kiriIslands_Prepare(kiriWorld* world, double dt);

/* Returns the cluster of a sheet: the index of its first sheet; KIRI_NONE: no mutual contact. */
int32_t kiriIslands_ClusterOf(kiriIslands* islands, int32_t sheet);

/* Loops over the sheets of a cluster from one of them on; a sheet alone is its own. */
#define KIRI_EACH_OF_CLUSTER(i, islands, first)                                                                        \
    for (int32_t i = (first); i != KIRI_NONE; i = (islands)->next.data[i])

/* Returns an upper bound of the items that a tick of a cluster takes. */
int64_t kiriIslands_MostItems(const kiriWorld* world, int32_t cluster, int32_t substeps);

/* Moves the sheets of a cluster, or one sheet alone, whose motion has begun. Writes their progress. */
void kiriIslands_Move(kiriWorld* world, int32_t cluster, double dt, int32_t substeps, kiriQuota* systems);

KIRI_C_END

#endif
