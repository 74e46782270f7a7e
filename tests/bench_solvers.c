/* What linear solvers take on the systems of hanging sheets: ours, and those that Eigen has. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

#include "eigen_solvers.h"
#include "motion/kiri_solver.h"
#include "world/kiri_world.h"

enum { SQUARES = 64, TICKS = 6, MOST_ROUNDS = 1000, DENSE_FRAMES = 300, SLOW_FRAMES = 2000, RUNS = 5 };

static const char* const names[SOLVER_COUNT] = { "SimplicialLDLT",   "SimplicialLLT",    "SparseLU",  "CG, diagonal",
                                                 "CG, incomplete L", "BiCGSTAB, diagon", "dense LDLT" };

/* ---- Systems ----------------------------------------------------------------------------------------------------- */

/* A sheet that hangs by two corners, and swings. */
static bool MakeSheet(kiriWorld** world, int32_t frames, int32_t model)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    kiriSheet sheet;
    kiriSheetDef def = DefaultSheet();
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    def.gridResolution = 64;
    def.model = model;
    while ((double)def.gridResolution * def.gridResolution < 16.0 * frames) {
        def.gridResolution *= 2;
    }
    def.frameCount = def.maxFrames = frames;
    bool fine = kiriCreateWorld(&worldDef, world) == KIRI_OK && Bench_AddSheet(*world, &def, SQUARES, &sheet) &&
                Bench_PinCorners(*world, sheet, 1.0f, 1.0f);
    for (int tick = 0; fine && tick < TICKS; ++tick) {
        fine = kiriWorld_Tick(*world, 1.0f / 60.0f, 1) == KIRI_OK;
    }
    return fine;
}

/* Entries of a block of two frames, in the lower triangle. */
static void AddEntries(SparseSystem* system, const double* block, int32_t size, int32_t down, int32_t across)
{
    for (int32_t c = 0; c < size; ++c) {
        for (int32_t r = down == across ? c : 0; r < size; ++r) {
            int32_t row = size * down + r, column = size * across + c;
            ((int32_t*)system->row)[system->entries] = row > column ? row : column;
            ((int32_t*)system->column)[system->entries] = row > column ? column : row;
            ((double*)system->value)[system->entries++] = block[size * c + r];
        }
    }
}

/* The last system that the solver had. */
static SparseSystem ReadSystem(kiriSolver* solver)
{
    const kiriMatrix* matrix = solver->bodies.bodies.data[0].matrix;
    int32_t size = solver->size, frames = matrix->count;
    size_t most = (size_t)matrix->values.count;
    SparseSystem system = { size * frames,
                            0,
                            malloc(sizeof(int32_t) * most),
                            malloc(sizeof(int32_t) * most),
                            malloc(sizeof(double) * most),
                            solver->force.data };
    FREED(int32_t, frameOf) = malloc(sizeof(int32_t) * (size_t)frames);
    for (int32_t f = 0; f < frames; ++f) {
        frameOf[matrix->order.data[f]] = f;
    }
    for (int32_t c = 0, b = 0; c < frames; ++c) {
        for (; b < matrix->pattern.start.data[c + 1]; ++b) {
            AddEntries(&system, matrix->values.data + (ptrdiff_t)size * size * b, size,
                       frameOf[matrix->pattern.row.data[b]], frameOf[c]);
        }
    }
    return system;
}

/* ---- Times ------------------------------------------------------------------------------------------------------- */

static void TakeLeast(SolverTimes* least, const SolverTimes* times, int run)
{
    least->analyse = run == 0 || times->analyse < least->analyse ? times->analyse : least->analyse;
    least->factor = run == 0 || times->factor < least->factor ? times->factor : least->factor;
    least->solve = run == 0 || times->solve < least->solve ? times->solve : least->solve;
    least->rounds = times->rounds;
}

static bool TimeOurs(kiriSolver* solver, double* solution, SolverTimes* times)
{
    kiriMatrix* own = solver->bodies.bodies.data[0].matrix;
    int32_t pairs = kiriMatrix_PairCount(own);
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriMatrix* matrix = kiriMatrix_Create(&memory, solver->size);
    FREED(kiriPair, pair) = malloc(sizeof(kiriPair) * (size_t)pairs);
    double start = Bench_Clock(NULL);
    kiriMatrix_GetPairs(own, pair);
    bool fine = kiriMatrix_Shape(matrix, own->count, pair, pairs);
    double analysed = Bench_Clock(NULL);
    fine = fine && kiriMatrix_Factor(own);
    double factored = Bench_Clock(NULL);
    kiriMatrix_Solve(own, solver->force.data, solution);
    *times = (SolverTimes){ analysed - start, factored - analysed, Bench_Clock(NULL) - factored, 0 };
    kiriMemory_FreeAll(&memory);
    return fine;
}

/* The ratio compares with the times of `ours`. */
static void PrintSolver(Table* table, const kiriSolver* solver, const char* name, const SolverTimes* times,
                        const SolverTimes* ours, double error)
{
    TABLE_NUMBERS(table, solver->bodies.bodies.data[0].matrix->count, solver->size);
    Table_Text(table, name);
    TABLE_NUMBERS(table, 1e3 * times->analyse, 1e3 * times->factor, 1e3 * times->solve,
                  1e6 * (times->factor + times->solve) / solver->bodies.bodies.data[0].matrix->count,
                  (times->factor + times->solve) / (ours->factor + ours->solve),
                  times->rounds > 0 ? times->rounds : (double)NAN, log10(error));
}

static bool BenchSolvers(Table* table, kiriSolver* solver)
{
    int32_t frames = solver->bodies.bodies.data[0].matrix->count;
    SparseSystem system = ReadSystem(solver);
    FREED(double, reference) = malloc(sizeof(double) * (size_t)system.unknowns);
    FREED(double, solution) = malloc(sizeof(double) * (size_t)system.unknowns);
    int runs = frames > SLOW_FRAMES ? 1 : RUNS;
    SolverTimes least, times, ours;
    EigenSolvers_Reference(&system, reference);
    bool fine = true;
    for (int run = 0; fine && run < RUNS; ++run) {
        fine = TimeOurs(solver, solution, &times);
        TakeLeast(&least, &times, run);
    }
    ours = least;
    PrintSolver(table, solver, "ours", &least, &ours, EigenSolvers_Distance(&system, solution, reference));
    for (int32_t which = 0; fine && which < SOLVER_COUNT; ++which) {
        bool hasFactor = which != SOLVER_DENSE || frames <= DENSE_FRAMES;
        for (int run = 0; hasFactor && run < runs; ++run) {
            hasFactor = EigenSolvers_Solve(which, &system, MOST_ROUNDS, Bench_Clock, solution, &times) != 0;
            TakeLeast(&least, &times, run);
        }
        if (hasFactor) {
            double error = EigenSolvers_Distance(&system, solution, reference);
            PrintSolver(table, solver, names[which], &least, &ours, error);
        }
    }
    free((void*)system.row);
    free((void*)system.column);
    free((void*)system.value);
    return fine;
}

int main(void)
{
    static const char* const columns[] = { "frames",   "unknowns", "solver          ", "analyse", "factor", "solve",
                                           "us/frame", "to ours",  "rounds",           "error",   NULL };
    static const int32_t counts[] = { 24, 47, 100, 289, 1000, 5000, 100 };
    Table table;
    Bench_WeighClock();
    bool fine = Table_Start(
        &table, "solvers",
        "The linear system of a square that hangs by two corners: ms for a new "
        "pattern, a factorisation and a\nsolution, us a frame of the last two, and their ratio to ours; the error's "
        "decimal logarithm, by the energy of the difference from a refined solution.\nIterations "
        "end at a residual of 1e-9, or after 1000 rounds. SparseLU counts what it does in `factor`.",
        columns);
    for (size_t i = 0; fine && i < sizeof counts / sizeof counts[0]; ++i) {
        SCOPED_WORLD(world) = NULL;
        bool isLast = i + 1 == sizeof counts / sizeof counts[0]; /* 12 unknowns a frame */
        fine = MakeSheet(&world, counts[i], isLast ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS) &&
               BenchSolvers(&table, world->sheets.data[0]->solver);
    }
    fine = Table_Stop(&table) && fine;
    return Bench_End(fine, "bench_solvers: something failed");
}
