/* Steps of all bodies of a solver, as a tick takes them. */
#ifndef SOLVER_STEP_H
#define SOLVER_STEP_H

#include "../src/motion/kiri_solver.h"

/* Returns the most systems that a body took; -1 where a body cannot go on. */
static inline int32_t Solver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations,
                                  int32_t most)
{
    int32_t done = 0;
    kiriSolver_ListMoved(solver);
    if (!kiriSolver_ReserveRows(solver, system->pinCount, system->clampCount, system->contactCount)) {
        return -1;
    }
    kiriSolver_ShareRows(solver, system);
    for (int32_t n = 0; done >= 0 && n < solver->moved.bodies.count; ++n) {
        int32_t solved = kiriSolver_Step(solver, system, solver->moved.bodies.data[n], dt, iterations, most);
        done = solved < 0 || solved > done ? solved : done;
    }
    return done;
}

#endif
