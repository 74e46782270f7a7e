/* Triangles of sheets that cross triangles of other pieces: what is seen to stick through. */
#ifndef KIRI_TEST_CROSSING_H
#define KIRI_TEST_CROSSING_H

#include "kiri/kiri.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct CrossingTriangle {
    double corner[3][3];
    double low[3], high[3];
    int32_t piece, vertex[3];
    bool crosses;
} CrossingTriangle;

typedef struct Crossing {
    int32_t triangles; /* in all */
    int32_t crossing;  /* of them cross one of another piece */
    double area;       /* m^2, of these */
} Crossing;

static inline int32_t Crossing_Root(int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        i = parent[i] = parent[parent[i]];
    }
    return i;
}

/* Triangles that share vertices are of one piece: cuts tear vertices apart. */
static inline int32_t Crossing_Gather(const kiriMesh* mesh, int32_t firstPiece, CrossingTriangle* out)
{
    int32_t* parent = malloc(sizeof(int32_t) * (size_t)mesh->vertexCount);
    for (int32_t v = 0; v < mesh->vertexCount; ++v) {
        parent[v] = v;
    }
    for (int32_t i = 0; i < 3 * mesh->triangleCount; ++i) {
        int32_t a = Crossing_Root(parent, mesh->indices[i]);
        int32_t b = Crossing_Root(parent, mesh->indices[i % 3 == 2 ? i - 2 : i + 1]);
        parent[a < b ? b : a] = a < b ? a : b;
    }
    for (int32_t t = 0; t < mesh->triangleCount; ++t) {
        CrossingTriangle* triangle = &out[t];
        triangle->piece = firstPiece + Crossing_Root(parent, mesh->indices[3 * t]);
        triangle->crosses = false;
        for (int k = 0; k < 3; ++k) {
            triangle->vertex[k] = mesh->indices[3 * t + k];
            for (int d = 0; d < 3; ++d) {
                double x = (double)mesh->positions[3 * mesh->indices[3 * t + k] + d];
                triangle->corner[k][d] = x;
                triangle->low[d] = k == 0 || x < triangle->low[d] ? x : triangle->low[d];
                triangle->high[d] = k == 0 || x > triangle->high[d] ? x : triangle->high[d];
            }
        }
    }
    free(parent);
    return mesh->triangleCount;
}

/* Six times the volume of a, b, c, d. */
static inline double Crossing_Volume(const double* a, const double* b, const double* c, const double* d)
{
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
        w[k] = d[k] - a[k];
    }
    return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/* Does the segment p q go through the inside of the triangle? */
static inline bool Crossing_GoesThrough(const double* p, const double* q, const CrossingTriangle* t)
{
    const double *a = t->corner[0], *b = t->corner[1], *c = t->corner[2];
    double above = Crossing_Volume(a, b, c, p), below = Crossing_Volume(a, b, c, q);
    if (!((above > 0.0 && below < 0.0) || (above < 0.0 && below > 0.0))) {
        return false;
    }
    double x = Crossing_Volume(p, q, a, b), y = Crossing_Volume(p, q, b, c), z = Crossing_Volume(p, q, c, a);
    return (x > 0.0 && y > 0.0 && z > 0.0) || (x < 0.0 && y < 0.0 && z < 0.0);
}

static inline bool Crossing_Cross(const CrossingTriangle* s, const CrossingTriangle* t)
{
    for (int d = 0; d < 3; ++d) {
        if (s->low[d] > t->high[d] || t->low[d] > s->high[d]) {
            return false;
        }
    }
    for (int k = 0; k < 3; ++k) {
        if (Crossing_GoesThrough(s->corner[k], s->corner[(k + 1) % 3], t) ||
            Crossing_GoesThrough(t->corner[k], t->corner[(k + 1) % 3], s)) {
            return true;
        }
    }
    return false;
}

static inline bool Crossing_AreNeighbors(const CrossingTriangle* s, const CrossingTriangle* t)
{
    bool any = false;
    for (int k = 0; k < 9; ++k) {
        any |= s->vertex[k / 3] == t->vertex[k % 3];
    }
    return any;
}

static inline int Crossing_ByLow(const void* a, const void* b)
{
    double x = ((const CrossingTriangle*)a)->low[0], y = ((const CrossingTriangle*)b)->low[0];
    return (x > y) - (x < y);
}

static inline double Crossing_AreaOf(const CrossingTriangle* t)
{
    double u[3], v[3], sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        u[d] = t->corner[1][d] - t->corner[0][d];
        v[d] = t->corner[2][d] - t->corner[0][d];
    }
    for (int d = 0; d < 3; ++d) {
        double n = u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
        sum += n * n;
    }
    double root = sum > 0.0 ? sum : 1.0; /* Newton's iteration from above: no libm needed */
    for (int i = 0; i < 100; ++i) {
        root = 0.5 * (root + sum / root);
    }
    return 0.5 * root;
}

/* Marks the triangles that cross: of different pieces, or of one piece if they have no vertex in common. */
static inline void Crossing_Mark(CrossingTriangle* all, int32_t count, bool ofOnePiece, Crossing* result)
{
    qsort(all, (size_t)count, sizeof(*all), Crossing_ByLow);
    for (int32_t i = 0; i < count; ++i) {
        for (int32_t k = i + 1; k < count && all[k].low[0] <= all[i].high[0]; ++k) {
            bool isMeant = ofOnePiece ? !Crossing_AreNeighbors(&all[i], &all[k]) : all[i].piece != all[k].piece;
            if (isMeant && Crossing_Cross(&all[i], &all[k])) {
                all[i].crosses = all[k].crosses = true;
            }
        }
    }
    result->triangles = count;
    for (int32_t i = 0; i < count; ++i) {
        result->crossing += all[i].crosses;
        result->area += all[i].crosses ? Crossing_AreaOf(&all[i]) : 0.0;
    }
}

static inline Crossing Crossing_Measure(const kiriWorld* world, const kiriSheet* sheets, int32_t count)
{
    Crossing result = { 0, 0, 0.0 };
    CrossingTriangle* all = NULL;
    int32_t pieces = 0, triangles = 0;
    for (int32_t i = 0; i < count; ++i) {
        kiriMesh mesh;
        if (kiriSheet_GetMesh(world, sheets[i], &mesh) == KIRI_OK) {
            all = realloc(all, sizeof(*all) * (size_t)(triangles + mesh.triangleCount));
            triangles += Crossing_Gather(&mesh, pieces, all + triangles);
            pieces += mesh.vertexCount;
        }
    }
    Crossing_Mark(all, triangles, false, &result);
    free(all);
    return result;
}

/* Triangles of a sheet that cross others of it. */
static inline Crossing Crossing_MeasureSelf(const kiriWorld* world, kiriSheet sheet)
{
    Crossing result = { 0, 0, 0.0 };
    kiriMesh mesh;
    if (kiriSheet_GetMesh(world, sheet, &mesh) == KIRI_OK) {
        CrossingTriangle* all = malloc(sizeof(*all) * (size_t)mesh.triangleCount);
        Crossing_Mark(all, Crossing_Gather(&mesh, 0, all), true, &result);
        free(all);
    }
    return result;
}

#endif
