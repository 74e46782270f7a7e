#include "outline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool Outline_Add(Outline* outline, float u, float v)
{
    if (outline->count == outline->capacity) {
        int32_t capacity = outline->capacity > 0 ? 2 * outline->capacity : 256;
        float* points = realloc(outline->points, 2 * sizeof(float) * (size_t)capacity);
        if (points == NULL) {
            return false;
        }
        outline->points = points;
        outline->capacity = capacity;
    }
    outline->points[2 * outline->count] = u;
    outline->points[2 * outline->count + 1] = v;
    outline->count++;
    return true;
}

bool Outline_Read(const char* path, Outline* outline)
{
    *outline = (Outline){ .points = NULL };
    FILE* file = fopen(path, "r");
    if (file == NULL) {
        fprintf(stderr, "cannot open %s\n", path);
        return false;
    }
    char line[256];
    bool fine = fgets(line, sizeof line, file) != NULL;
    while (fine && fgets(line, sizeof line, file) != NULL) {
        float u, v;
        fine = sscanf(line, "%f,%f", &u, &v) == 2 && Outline_Add(outline, u, v);
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
    *outline = (Outline){ .points = NULL };
}

/* Cosine and sine by their series: those of libm differ from machine to machine, and so would the scenes. */
static void GetDirection(double turn, double direction[2])
{
    double angle = 6.283185307179586477 * (turn - (double)(int32_t)(turn < 0.0 ? turn - 0.5 : turn + 0.5));
    double term = 1.0;
    direction[0] = 1.0;
    direction[1] = 0.0;
    for (int k = 1; k < 28; k++) {
        term *= angle / k;
        direction[k % 2] += k % 4 < 2 ? term : -term;
    }
}

bool Outline_AddSpiral(Outline* outline, const Spiral* spiral)
{
    double length = 6.283185307179586477 * fabs(spiral->turns) * 0.5 * (spiral->fromRadius + spiral->toRadius);
    int32_t steps = 1 + (int32_t)(length / spiral->step);
    double a = spiral->fromRadius, b = spiral->toRadius;
    bool fine = true;
    for (int32_t i = 0; fine && i <= steps; i++) {
        /* Equal steps along the way, as a hand moves: the angle's share x has a x + (b - a) x^2 / 2 behind it. */
        double share = (double)i / steps, radius = sqrt(a * a + share * (b * b - a * a)), direction[2];
        double x = fabs(b - a) > 1e-9 ? (radius - a) / (b - a) : share;
        GetDirection(spiral->fromTurn + x * spiral->turns, direction);
        fine = Outline_Add(outline, (float)(spiral->center[0] + radius * direction[0]),
                           (float)(spiral->center[1] + radius * direction[1]));
    }
    return fine;
}

double Outline_GetLength(const Outline* outline)
{
    double length = 0.0;
    for (int32_t i = 1; i < outline->count; i++) {
        double u = (double)outline->points[2 * i] - outline->points[2 * i - 2];
        double v = (double)outline->points[2 * i + 1] - outline->points[2 * i - 1];
        length += sqrt(u * u + v * v);
    }
    return length;
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
