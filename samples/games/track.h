/* What is drawn lies between the last two ticks: where things were before the last tick is kept here. */
#ifndef TRACK_H
#define TRACK_H

#include "../canvas.h"
#include "../edges.h"

#include "kiri/kiri.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Track {
    kiriSheet sheet;
    float *before, *restBefore; /* of the vertices, before the last tick */
    int32_t beforeCount, beforeCapacity;
    float* between; /* where they are drawn */
    int32_t betweenCapacity;
    EdgeLines edges; /* of the mesh with `revision` */
    uint32_t revision;
} Track;

void Track_Init(Track* track, kiriSheet sheet);
void Track_Free(Track* track);

/* To be called before each tick. False without memory. */
bool Track_BeforeTick(Track* track, const kiriWorld* world);

/* Fills the geometry of a sheet to draw; vertices that the last tick made or renumbered are drawn where they are now.
   False without memory. */
bool Track_Get(Track* track, const kiriWorld* world, float alpha, CanvasSheet* sheet);

/* The same for a body. */
typedef struct Pose {
    float position[3], rotation[9]; /* columns */
} Pose;

void Pose_Mix(const Pose* before, const Pose* after, float alpha, Pose* between);

#ifdef __cplusplus
}
#endif

#endif
