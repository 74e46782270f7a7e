#include "springs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double GRAVITY = 9.81;

/* ---- Squares ---------------------------------------------------------------------------------------------------- */

static int Find(int* parents, int i)
{
    while (parents[i] != i) {
        i = parents[i] = parents[parents[i]];
    }
    return i;
}

/* Whether the slit runs along the edge whose middle is (u, v). */
static bool IsSlit(const LatticeDef* def, double u, double v)
{
    for (int k = 0; k + 1 < def->slitPoints; ++k) {
        const double *a = def->slit[k], *b = def->slit[k + 1];
        if (u > fmin(a[0], b[0]) - 1e-9 && u < fmax(a[0], b[0]) + 1e-9 && v > fmin(a[1], b[1]) - 1e-9 &&
            v < fmax(a[1], b[1]) + 1e-9) {
            return true;
        }
    }
    return false;
}

static bool IsInside(const LatticeDef* def, double u, double v)
{
    double away = hypot(u - def->length / 2.0, v - def->width / 2.0);
    return def->disc == 0.0 || (away < def->disc && away >= def->hole);
}

/* Gives corners that squares share one number, in `corners`. */
static void JoinSquares(Lattice* l, const LatticeDef* def, int* parents)
{
    for (int s = 0; s < l->columns * l->rows; ++s) {
        int i = s % l->columns, j = s / l->columns;
        double u = l->origin + (i + 0.5) * l->side, v = (j + 0.5) * l->side;
        for (int k = 0; k < 4; ++k) {
            l->corners[4 * s + k] = IsInside(def, u, v) ? 4 * s + k : -1;
        }
        int left = 4 * (s - 1), below = 4 * (s - l->columns);
        if (l->corners[4 * s] >= 0 && i > 0 && l->corners[left] >= 0 && !IsSlit(def, u - l->side / 2.0, v)) {
            parents[Find(parents, 4 * s)] = Find(parents, left + 1);
            parents[Find(parents, 4 * s + 3)] = Find(parents, left + 2);
        }
        if (l->corners[4 * s] >= 0 && j > 0 && l->corners[below] >= 0 && !IsSlit(def, u, v - l->side / 2.0)) {
            parents[Find(parents, 4 * s)] = Find(parents, below + 3);
            parents[Find(parents, 4 * s + 1)] = Find(parents, below + 2);
        }
    }
}

static void NumberVertices(Lattice* l, int* parents, int* numbers)
{
    for (int k = 0; k < 4 * l->columns * l->rows; ++k) {
        int s = k / 4, corner = k % 4;
        if (l->corners[k] >= 0) {
            int root = Find(parents, k);
            if (numbers[root] < 0) {
                int i = s % l->columns + (corner == 1 || corner == 2), j = s / l->columns + (corner >= 2);
                numbers[root] = l->vertexCount++;
                l->rest[2 * numbers[root]] = (float)(l->origin + i * l->side);
                l->rest[2 * numbers[root] + 1] = (float)(j * l->side);
            }
            l->corners[k] = numbers[root];
        }
    }
    for (int s = 0; s < l->columns * l->rows; ++s) {
        const int* c = l->corners + 4 * s;
        if (c[0] >= 0) {
            int32_t two[6] = { c[0], c[1], c[2], c[0], c[2], c[3] };
            memcpy(l->triangles + 3 * l->triangleCount, two, sizeof two);
            l->triangleCount += 2;
        }
    }
}

bool Lattice_Make(Lattice* l, const LatticeDef* def)
{
    memset(l, 0, sizeof *l);
    l->side = def->side;
    l->origin = -def->ghosts * def->side;
    l->columns = (int)(def->length / def->side + 0.5) + def->ghosts;
    l->rows = (int)(def->width / def->side + 0.5);
    size_t squares = (size_t)(l->columns * l->rows);
    FREED(int, scratch) = malloc(8 * squares * sizeof(int));
    l->corners = malloc(4 * squares * sizeof(int));
    l->rest = malloc(8 * squares * sizeof(float));
    l->triangles = malloc(6 * squares * sizeof(int32_t));
    bool ok = scratch != NULL && l->corners != NULL && l->rest != NULL && l->triangles != NULL;
    for (int k = 0; ok && k < 4 * (int)squares; ++k) {
        scratch[k] = k;
        scratch[4 * (int)squares + k] = -1;
    }
    if (ok) {
        JoinSquares(l, def, scratch);
        NumberVertices(l, scratch, scratch + 4 * squares);
    }
    return ok;
}

void Lattice_Free(Lattice* l)
{
    free(l->corners);
    free(l->rest);
    free(l->triangles);
}

/* ---- Springs ---------------------------------------------------------------------------------------------------- */

/* A sum of up to four positions times factors. The spring works against the change of its length from rest. */
typedef struct Spring {
    int count; /* 2: along an edge or a diagonal; 3, 4: bending */
    int vertices[4];
    double factors[4];
    double rest, stiffness, norm; /* norm: sum of inverse masses times squares of factors */
} Spring;

struct Springs {
    int vertexCount, springCount;
    double damping, compression;
    double *positions, *previous, *velocities, *inverse; /* inverse: 1/kg */
    Spring* springs;
};

/* Adds a spring, or its stiffness to the one with the same vertices among the last ones. */
static void AddSpring(Springs* s, const Spring* added, int window)
{
    for (int k = s->springCount - 1; k >= 0 && k >= s->springCount - window; --k) {
        if (s->springs[k].count == added->count &&
            memcmp(s->springs[k].vertices, added->vertices, sizeof added->vertices) == 0) {
            s->springs[k].stiffness += added->stiffness;
            return;
        }
    }
    s->springs[s->springCount++] = *added;
}

/* Adds the springs of a plate with Poisson's ratio 1/3, half of an edge for each square beside it. */
static void AddEdges(Springs* s, const Lattice* l, double stretch, int window)
{
    static const int pairs[6][2] = { { 0, 1 }, { 3, 2 }, { 0, 3 }, { 1, 2 }, { 0, 2 }, { 1, 3 } };
    for (int q = 0; q < l->columns * l->rows; ++q) {
        for (int k = 0; k < 6 && l->corners[4 * q] >= 0; ++k) {
            int a = l->corners[4 * q + pairs[k][0]], b = l->corners[4 * q + pairs[k][1]];
            Spring spring = { 2, { a, b }, { 1.0, -1.0 }, l->side * (k < 4 ? 1.0 : sqrt(2.0)), 0.375 * stretch, 0.0 };
            AddSpring(s, &spring, window);
        }
    }
}

/* Curvature along both axes in the middle of three vertices in a row, half for each pair of squares beside it, and the
   twist of squares: the energy of a plate with Poisson's ratio 0. At a clamp the sheet is its own mirror image: half as
   much of it has twice the curvature. */
static void AddBending(Springs* s, const Lattice* l, double bending, int window)
{
    static const int rows[2][2][3] = { { { 0, 1, 1 }, { 3, 2, 2 } }, { { 0, 3, 3 }, { 1, 2, 2 } } };
    double k = bending / (l->side * l->side);
    for (int q = 0; q < l->columns * l->rows; ++q) {
        const int* c = l->corners + 4 * q;
        if (c[0] < 0) {
            continue;
        }
        Spring twist = { 4, { c[0], c[1], c[2], c[3] }, { 1.0, -1.0, 1.0, -1.0 }, 0.0, 2.0 * k, 0.0 };
        AddSpring(s, &twist, 0);
        for (int axis = 0; axis < 2; ++axis) {
            int next = axis == 0 ? q + 1 : q + l->columns;
            bool isLast = axis == 0 ? q % l->columns + 1 == l->columns : next >= l->columns * l->rows;
            const int* n = l->corners + 4 * (isLast ? q : next);
            bool joined = !isLast && n[0] >= 0 && c[rows[axis][0][1]] == n[rows[axis][0][0]] &&
                          c[rows[axis][1][1]] == n[rows[axis][1][0]];
            double share = l->origin < 0.0 && axis == 0 && q % l->columns == 0 ? 1.0 : 0.5;
            for (int side = 0; side < 2 && joined; ++side) {
                const int* r = rows[axis][side];
                Spring row = { 3, { c[r[0]], c[r[1]], n[r[2]] }, { 1.0, -2.0, 1.0 }, 0.0, share * k, 0.0 };
                AddSpring(s, &row, window);
            }
        }
    }
}

Springs* Springs_Create(const Lattice* l, const SpringMaterial* material, const bool* fixed)
{
    Springs* s = calloc(1, sizeof *s);
    size_t vertices = (size_t)l->vertexCount, squares = (size_t)(l->columns * l->rows);
    if (s == NULL) {
        return NULL;
    }
    s->positions = calloc(10 * vertices, sizeof(double));
    s->springs = malloc(11 * squares * sizeof(Spring));
    if (s->positions == NULL || s->springs == NULL) {
        Springs_Destroy(s);
        return NULL;
    }
    s->vertexCount = l->vertexCount;
    s->damping = material->damping;
    s->compression = material->compression;
    s->previous = s->positions + 3 * vertices;
    s->velocities = s->previous + 3 * vertices;
    s->inverse = s->velocities + 3 * vertices;
    for (size_t k = 0; k < 4 * squares; ++k) {
        if (l->corners[k] >= 0) {
            s->inverse[l->corners[k]] += 0.25 * material->mass * l->side * l->side; /* kg, for now */
        }
    }
    for (size_t i = 0; i < vertices; ++i) {
        s->inverse[i] = fixed[i] ? 0.0 : 1.0 / s->inverse[i];
        s->positions[3 * i] = (double)l->rest[2 * i];
        s->positions[3 * i + 1] = (double)l->rest[2 * i + 1];
    }
    int window = 12 * (l->columns + 2);
    AddEdges(s, l, material->stretch, window);
    AddBending(s, l, material->bending, window);
    for (int k = 0; k < s->springCount; ++k) {
        for (int i = 0; i < s->springs[k].count; ++i) {
            double factor = s->springs[k].factors[i];
            s->springs[k].norm += factor * factor * s->inverse[s->springs[k].vertices[i]];
        }
    }
    return s;
}

void Springs_Destroy(Springs* s)
{
    if (s != NULL) {
        free(s->positions);
        free(s->springs);
        free(s);
    }
}

static void SolveEdge(Springs* s, const Spring* p, double perStep)
{
    double *a = s->positions + 3 * p->vertices[0], *b = s->positions + 3 * p->vertices[1];
    double d[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double k = length < p->rest ? p->stiffness * s->compression : p->stiffness;
    double push = (p->rest - length) / (length * (p->norm + perStep / k));
    double atA = push * s->inverse[p->vertices[0]], atB = push * s->inverse[p->vertices[1]];
    for (int c = 0; c < 3; ++c) {
        a[c] += atA * d[c];
        b[c] -= atB * d[c];
    }
}

static void SolveBend(Springs* s, const Spring* p, double perStep)
{
    double sum[3] = { 0.0, 0.0, 0.0 }, share = -1.0 / (p->norm + perStep / p->stiffness);
    for (int i = 0; i < p->count; ++i) {
        const double* x = s->positions + 3 * p->vertices[i];
        for (int c = 0; c < 3; ++c) {
            sum[c] += p->factors[i] * x[c];
        }
    }
    for (int i = 0; i < p->count; ++i) {
        double* x = s->positions + 3 * p->vertices[i];
        double along = share * p->factors[i] * s->inverse[p->vertices[i]];
        for (int c = 0; c < 3; ++c) {
            x[c] += along * sum[c];
        }
    }
}

void Springs_Tick(Springs* s, double seconds, int substeps)
{
    double h = seconds / substeps, fade = exp(-s->damping * h), perStep = 1.0 / (h * h);
    for (int step = 0; step < substeps; ++step) {
        for (int i = 0; i < 3 * s->vertexCount; ++i) {
            s->previous[i] = s->positions[i];
            if (s->inverse[i / 3] > 0.0) {
                s->velocities[i] = fade * s->velocities[i] - (i % 3 == 2 ? GRAVITY * h : 0.0);
                s->positions[i] += h * s->velocities[i];
            }
        }
        for (int k = 0; k < s->springCount; ++k) {
            if (s->springs[k].norm > 0.0) {
                (s->springs[k].count == 2 ? SolveEdge : SolveBend)(s, &s->springs[k], perStep);
            }
        }
        for (int i = 0; i < 3 * s->vertexCount; ++i) {
            s->velocities[i] = (s->positions[i] - s->previous[i]) / h;
        }
    }
}

double* Springs_GetPositions(Springs* s)
{
    return s->positions;
}

double Springs_GetSpeed(const Springs* s)
{
    double sum = 0.0;
    for (int i = 0; i < 3 * s->vertexCount; ++i) {
        sum += s->velocities[i] * s->velocities[i];
    }
    return sqrt(sum / s->vertexCount);
}
