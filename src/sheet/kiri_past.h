/* The indices that the vertices of a sheet had when the last tick began, in its mesh or the mesh of another sheet: for
   hosts that draw between two ticks. No tick depends on it. It costs nothing where no vertex gets another index. */
#ifndef KIRI_PAST_H
#define KIRI_PAST_H

#include "../mesh/kiri_mesh.h"

KIRI_C_BEGIN

typedef struct kiriPast {
    int64_t tick;    /* the number of that tick: else it is out of date, and no vertex has got another index since */
    kiriSheet sheet; /* that had the vertices; 0: this one */
    int32_t same;    /* vertices before this one have the index that they had */
    const int32_t* others; /* of the vertices from there on */
    int32_t count;         /* of these; vertices beyond were not there */
} kiriPast;

/* No vertex was there. */
static inline kiriPast kiriPast_None(int64_t tick)
{
    return (kiriPast){ tick, 0, 0, NULL, 0 };
}

/* Returns the past as of a tick: without changes if the stored one is older. */
static inline kiriPast kiriPast_At(const kiriPast* past, int64_t tick)
{
    return past->tick == tick ? *past : (kiriPast){ tick, 0, INT32_MAX, NULL, 0 };
}

/* The index that a vertex had, or KIRI_NONE. */
static inline int32_t kiriPast_IndexOf(const kiriPast* past, int32_t vertex)
{
    if (vertex < past->same) {
        return vertex;
    }
    return vertex - past->same < past->count ? past->others[vertex - past->same] : KIRI_NONE;
}

/* These make the past of a mesh that changes. False for memory. */

/* A tick adds vertices, from `first` on. One that is torn off another gets the index of that one. `room` holds the
   indices until the next tick; its memory is used again. */
bool kiriPast_Grow(kiriPast* past, int64_t tick, kiriIndices* room, kiriMemory* memory, const kiriMeshData* mesh,
                   int32_t first);

/* Some vertices are kept, of a mesh whose past is up to date. The indices are a block of `memory`. */
bool kiriPast_Keep(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriKeep* vertices);

/* These vertices become a part of the sheet. */
bool kiriPast_Part(kiriPast* to, const kiriPast* past, kiriMemory* memory, kiriSheet sheet, const int32_t* vertices,
                   int32_t count);

KIRI_C_END

#endif
