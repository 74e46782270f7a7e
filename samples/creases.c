#include "creases.h"

int32_t Creases_Make(const Import* drawing, float unit, float stiffness, kiriFold* folds, float* ways,
                     int32_t capacity)
{
    int32_t count = 0;
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        const ImportLine* line = &drawing->lines[i];
        bool isFold = line->use == IMPORT_MOUNTAIN || line->use == IMPORT_VALLEY || line->use == IMPORT_SCORE;
        for (int32_t k = 0; isFold && k + 1 < line->count; k++, count++) {
            const double* at = &drawing->points[2 * (line->first + k)];
            if (count < capacity) {
                folds[count] = (kiriFold){ { unit * (float)at[0], unit * (float)at[1] },
                                           { unit * (float)at[2], unit * (float)at[3] },
                                           stiffness,
                                           0.0f,
                                           0.0f };
                ways[count] = line->use == IMPORT_MOUNTAIN ? -1.0f : line->use == IMPORT_VALLEY ? 1.0f : 0.0f;
            }
        }
    }
    return count;
}
