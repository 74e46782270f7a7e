/* All sheets of a world as one mesh, to draw. */
#ifndef SHEETS_H
#define SHEETS_H

#include "kiri/kiri.h"

#include <stdbool.h>

typedef struct Sheets {
    float *positions, *normals, *restPositions;
    int32_t* indices;
    int32_t vertexCapacity, triangleCapacity;
    kiriMesh mesh; /* of the arrays above */
} Sheets;

/* Takes the sheets but `except` (0: all) as they are now; a sheet without normals gets (0, 0, 1). False without memory. */
bool Sheets_Take(Sheets* sheets, const kiriWorld* world, kiriSheet except);

/* Zeros are empty ones. */
void Sheets_Free(Sheets* sheets);

#endif
