/* The open edges of a sheet, which pictures show as lines. */
#ifndef EDGES_H
#define EDGES_H

#include "kiri/kiri.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Edge {
    int32_t a, b;
    const float* low; /* rest positions of its ends, in lexicographic order */
    const float* high;
    bool cut; /* a lip of a cut has its twin at the same place of the rest plane; an edge of the outline has none */
} Edge;

/* Writes those edges that one triangle has for itself and returns how many there are. There has to be room for three
   edges a triangle. */
int32_t Edges_FindOpen(Edge* edges, const kiriMesh* mesh);

/* Open edges to draw: two vertices each. */
typedef struct EdgeLines {
    int32_t *lips, *rims; /* of cuts, of the outline; in one block */
    int32_t lipCount, rimCount;
} EdgeLines;

/* Replaces the lines. False without memory. */
bool EdgeLines_Find(EdgeLines* lines, const kiriMesh* mesh);

void EdgeLines_Free(EdgeLines* lines);

#ifdef __cplusplus
}
#endif

#endif
