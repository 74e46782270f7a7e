#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double HALF_PI = 1.57079632679489661923;

/* ---- Elastica --------------------------------------------------------------------------------------------------- */

/* At t from the free end: angle from the vertical, its derivative, and the integrals of its sine and cosine. */
typedef struct State {
    double psi, bend, out, down;
} State;

static State Derivative(double gamma, double t, State a)
{
    State d = { a.bend, gamma * t * sin(a.psi), sin(a.psi), cos(a.psi) };
    return d;
}

static State Moved(State a, double dt, State d)
{
    State b = { a.psi + dt * d.psi, a.bend + dt * d.bend, a.out + dt * d.out, a.down + dt * d.down };
    return b;
}

static State RungeKutta(double gamma, double t, double dt, State a)
{
    State k1 = Derivative(gamma, t, a), k2 = Derivative(gamma, t + 0.5 * dt, Moved(a, 0.5 * dt, k1));
    State k3 = Derivative(gamma, t + 0.5 * dt, Moved(a, 0.5 * dt, k2));
    State k4 = Derivative(gamma, t + dt, Moved(a, dt, k3));
    State d = { k1.psi + 2.0 * (k2.psi + k3.psi) + k4.psi, k1.bend + 2.0 * (k2.bend + k3.bend) + k4.bend,
                k1.out + 2.0 * (k2.out + k3.out) + k4.out, k1.down + 2.0 * (k2.down + k3.down) + k4.down };
    return Moved(a, dt / 6.0, d);
}

/* From the free end, which hangs at angle psi, to the clamp. True where it gets past the level before. */
static bool Shoot(Elastica* elastica, double gamma, double psi)
{
    State a = { psi, 0.0, 0.0, 0.0 };
    double dt = 1.0 / ELASTICA_STEPS;
    elastica->x[ELASTICA_STEPS] = elastica->drop[ELASTICA_STEPS] = 0.0;
    for (int k = 0; k < ELASTICA_STEPS; ++k) {
        a = RungeKutta(gamma, k * dt, dt, a);
        elastica->x[ELASTICA_STEPS - 1 - k] = a.out;
        elastica->drop[ELASTICA_STEPS - 1 - k] = a.down;
        if (a.psi > HALF_PI) {
            return true;
        }
    }
    return false;
}

/* Bisects the logarithm of the angle at the free end: a limp strip hangs straight to within 1e-30. */
void Elastica_Solve(Elastica* elastica, double gamma)
{
    double low = -250.0, high = log(HALF_PI);
    for (int k = 0; k < 60; ++k) {
        double middle = 0.5 * (low + high);
        *(Shoot(elastica, gamma, exp(middle)) ? &high : &low) = middle;
    }
    Shoot(elastica, gamma, exp(low));
    double x = elastica->x[0], drop = elastica->drop[0];
    for (int k = 0; k <= ELASTICA_STEPS; ++k) {
        elastica->x[k] = x - elastica->x[k];
        elastica->drop[k] = drop - elastica->drop[k];
    }
}

void Elastica_At(const Elastica* elastica, double s, double* x, double* drop)
{
    double place = s * ELASTICA_STEPS;
    int k = place < 0.0 ? 0 : place >= ELASTICA_STEPS ? ELASTICA_STEPS - 1 : (int)place;
    double share = place - k;
    *x = elastica->x[k] + share * (elastica->x[k + 1] - elastica->x[k]);
    *drop = elastica->drop[k] + share * (elastica->drop[k + 1] - elastica->drop[k]);
}

/* ---- Shell ------------------------------------------------------------------------------------------------------ */

static const double REACH = 0.012; /* m, of the fit: more than two elements */

enum { TERMS = 6 }; /* of a quadratic in the plane */

bool Shell_Read(Shell* shell, const char* path, const float* slit, int slitPoints)
{
    char line[256];
    FILE* file = fopen(path, "r");
    shell->count = 0;
    shell->slit = slit;
    shell->slitPoints = slitPoints;
    while (file != NULL && shell->count < SHELL_NODES && fgets(line, sizeof line, file) != NULL) {
        ShellNode* n = &shell->nodes[shell->count];
        double* p = n->position;
        int read = sscanf(line, "%*d,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &n->rest[0], &n->rest[1], &p[0], &p[1], &p[2],
                          &n->side[0], &n->side[1]);
        shell->count += read == 7 ? 1 : 0;
    }
    if (file != NULL) {
        fclose(file);
    }
    return shell->count > 0;
}

static double Turn(const double* a, const double* b, const double* c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool SlitBetween(const Shell* shell, const double* a, const double* b)
{
    for (int k = 0; k + 1 < shell->slitPoints; ++k) {
        const float* s = &shell->slit[2 * k];
        double p[2] = { (double)s[0], (double)s[1] }, q[2] = { (double)s[2], (double)s[3] };
        if (Turn(a, b, p) * Turn(a, b, q) < 0.0 && Turn(p, q, a) * Turn(p, q, b) < 0.0) {
            return true;
        }
    }
    return false;
}

/* Gauss without pivots: the matrix is symmetric and positive definite. */
static void SolveSymmetric(double m[TERMS][TERMS + 3])
{
    for (int k = 0; k < TERMS; ++k) {
        for (int row = 0; row < TERMS; ++row) {
            double share = m[row][k] / m[k][k];
            for (int column = k; row != k && column < TERMS + 3; ++column) {
                m[row][column] -= share * m[k][column];
            }
        }
    }
}

void Shell_At(const Shell* shell, const double rest[2], const double side[2], double position[3])
{
    double m[TERMS][TERMS + 3];
    memset(m, 0, sizeof m);
    for (int i = 0; i < shell->count; ++i) {
        const ShellNode* node = &shell->nodes[i];
        double u = (node->rest[0] - rest[0]) / REACH, v = (node->rest[1] - rest[1]) / REACH;
        double weight = 1.0 - sqrt(u * u + v * v);
        if (weight > 0.0 && !SlitBetween(shell, side, node->side)) {
            double terms[TERMS + 3] = { 1.0, u, v, u * u, u * v, v * v };
            for (int k = 0; k < 3; ++k) {
                terms[TERMS + k] = node->position[k];
            }
            for (int k = 0; k < TERMS * (TERMS + 3); ++k) {
                int row = k / (TERMS + 3), column = k % (TERMS + 3);
                m[row][column] += weight * weight * terms[row] * terms[column];
            }
        }
    }
    SolveSymmetric(m);
    for (int k = 0; k < 3; ++k) {
        position[k] = m[0][TERMS + k] / m[0][0];
    }
}
