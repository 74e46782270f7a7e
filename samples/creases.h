/* Folds of a sheet from a drawing (import.h). Copy both.

     kiriFold folds[256];
     float ways[256];
     int32_t count = Creases_Make(&drawing, 0.001f, 0.01f, folds, ways, 256);
     ... kiriCreateFoldedSheet; then, in each tick and for each fold ...
     kiriSheet_SetFold(world, sheet, i, 0.01f, ways[i] * angle); */
#ifndef CREASES_H
#define CREASES_H

#include "import.h"
#include "kiri/kiri.h"

/* Makes a fold of each straight part of mountains, valleys and scores, with a rest angle of 0. unit: m, of a millimetre
   of the drawing. ways: -1 for mountains, 1 for valleys, 0 for scores. Returns their count, also above `capacity`. */
int32_t Creases_Make(const Import* drawing, float unit, float stiffness, kiriFold* folds, float* ways,
                     int32_t capacity);

#endif
