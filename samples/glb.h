/* The sheets of a world as an animated binary glTF 2.0: a mesh for each moment, for cuts change meshes. */
#ifndef GLB_H
#define GLB_H

#include "kiri/kiri.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct Glb {
    struct GlbAccessor* accessors;
    struct GlbPart* parts; /* sheets of moments, moment by moment */
    float* times;          /* s, a moment */
    uint8_t* bytes;
    int64_t byteCount, byteRoom;
    int32_t accessorCount, accessorRoom, partCount, partRoom, timeCount, timeRoom;
} Glb;

/* Appends all sheets as they are now. Seconds are above the seconds of the moment before, and 0 or more. False without memory. */
bool Glb_Add(Glb* glb, const kiriWorld* world, float seconds);

/* Writes the file once, with y up. The colour is sRGB, 0 to 1. False: the file took not all of it, or would be 4 GB and more. */
bool Glb_Write(Glb* glb, const float color[3], FILE* file);

/* Zeros are an empty one. */
void Glb_Free(Glb* glb);

#endif
