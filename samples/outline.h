/* Polygons from text files. */
#ifndef OUTLINE_H
#define OUTLINE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct Outline {
    float* points; /* 2 a corner, closed: the last is joined to the first */
    int32_t count;
} Outline;

/* A line of text before the corners, then "u,v" a corner. Says on stderr what is wrong with the file. */
bool Outline_Read(const char* path, Outline* outline);
void Outline_Free(Outline* outline);

bool Outline_Holds(const float* points, int32_t count, const float point[2]);

#endif
