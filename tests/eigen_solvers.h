/* Solvers of Eigen on the linear systems of sheets. */
#ifndef KIRI_EIGEN_SOLVERS_H
#define KIRI_EIGEN_SOLVERS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The lower triangle, entry by entry, and the right side. */
typedef struct SparseSystem {
    int32_t unknowns;
    int64_t entries;
    const int32_t *row, *column;
    const double *value, *right;
} SparseSystem;

/* Seconds. What factors a matrix anew begins from `factor`; `analyse` is for a new pattern. */
typedef struct SolverTimes {
    double analyse, factor, solve;
    int32_t rounds; /* of an iteration; 0 of others */
} SolverTimes;

enum {
    SOLVER_LDLT,
    SOLVER_LLT,
    SOLVER_LU,
    SOLVER_CG_DIAGONAL,
    SOLVER_CG_INCOMPLETE,
    SOLVER_BICGSTAB,
    SOLVER_DENSE,
    SOLVER_COUNT
};

/* Iterations end at a residual of 1e-9 of the right side, or after `most` rounds. 0 where there is no factor. */
int32_t EigenSolvers_Solve(int32_t solver, const SparseSystem* system, int32_t most, double (*clock)(void* user),
                           double* solution, SolverTimes* times);

/* Solves twice more for what is left: what others are compared with. */
void EigenSolvers_Reference(const SparseSystem* system, double* solution);

/* How far a solution is from another one, by the energy of the difference, relative. */
double EigenSolvers_Distance(const SparseSystem* system, const double* solution, const double* reference);

#ifdef __cplusplus
}
#endif

#endif
