#include "outline.h"

#include <stdio.h>
#include <stdlib.h>

static bool Push(Outline* outline, int32_t* capacity, float u, float v)
{
    if (outline->count == *capacity) {
        *capacity = *capacity > 0 ? 2 * *capacity : 256;
        float* points = realloc(outline->points, 2 * sizeof(float) * (size_t)*capacity);
        if (points == NULL) {
            return false;
        }
        outline->points = points;
    }
    outline->points[2 * outline->count] = u;
    outline->points[2 * outline->count + 1] = v;
    outline->count++;
    return true;
}

bool Outline_Read(const char* path, Outline* outline)
{
    *outline = (Outline){ NULL, 0 };
    FILE* file = fopen(path, "r");
    if (file == NULL) {
        fprintf(stderr, "cannot open %s\n", path);
        return false;
    }
    char line[256];
    int32_t capacity = 0;
    bool fine = fgets(line, sizeof line, file) != NULL;
    while (fine && fgets(line, sizeof line, file) != NULL) {
        float u, v;
        fine = sscanf(line, "%f,%f", &u, &v) == 2 && Push(outline, &capacity, u, v);
    }
    fclose(file);
    if (!fine || outline->count < 3) {
        fprintf(stderr, "%s is not an outline\n", path);
        Outline_Free(outline);
        return false;
    }
    return true;
}

void Outline_Free(Outline* outline)
{
    free(outline->points);
    *outline = (Outline){ NULL, 0 };
}

bool Outline_Holds(const float* points, int32_t count, const float point[2])
{
    bool holds = false;
    for (int32_t i = 0, last = count - 1; i < count; last = i++) {
        const float* a = points + 2 * last;
        const float* b = points + 2 * i;
        if ((a[1] > point[1]) != (b[1] > point[1]) &&
            point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1])) {
            holds = !holds;
        }
    }
    return holds;
}
