/* Polygons and other ways in the plane, from text files or drawn. */
#ifndef OUTLINE_H
#define OUTLINE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct Outline {
    float* points; /* 2 a corner */
    int32_t count, capacity;
} Outline;

/* A line of text before the corners, then "u,v" a corner. Says on stderr what is wrong with the file. */
bool Outline_Read(const char* path, Outline* outline);
void Outline_Free(Outline* outline);

/* One more corner; false without memory. */
bool Outline_Add(Outline* outline, float u, float v);

/* An arc whose radius is linear in the angle. Angles in turns, counter-clockwise; a corner each `step` or so. */
typedef struct Spiral {
    double center[2], fromRadius, toRadius, fromTurn, turns, step;
} Spiral;

bool Outline_AddSpiral(Outline* outline, const Spiral* spiral);

double Outline_GetLength(const Outline* outline);

/* Whether the polygon holds the point; its last corner is joined to the first. */
bool Outline_Holds(const float* points, int32_t count, const float point[2]);

#endif
