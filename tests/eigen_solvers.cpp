#include "eigen_solvers.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cmath>
#include <vector>

namespace
{

typedef Eigen::SparseMatrix<double> Sparse;
typedef Eigen::Map<const Eigen::VectorXd> Known;
typedef double Clock(void* user);

Sparse MakeMatrix(const SparseSystem* system)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (int64_t n = 0; n < system->entries; ++n) {
        int32_t row = system->row[n], column = system->column[n];
        entries.push_back(Eigen::Triplet<double>(row, column, system->value[n]));
        if (row != column) {
            entries.push_back(Eigen::Triplet<double>(column, row, system->value[n]));
        }
    }
    Sparse matrix(system->unknowns, system->unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

template <typename Solver>
bool Run(Solver& solver, const Sparse& matrix, const Known& right, Clock* clock, Eigen::VectorXd& x, SolverTimes* times)
{
    double start = clock(nullptr);
    solver.analyzePattern(matrix);
    double analysed = clock(nullptr);
    solver.factorize(matrix);
    double factored = clock(nullptr);
    if (solver.info() != Eigen::Success) {
        return false;
    }
    x = solver.solve(right);
    *times = { analysed - start, factored - analysed, clock(nullptr) - factored, 0 };
    return true;
}

template <typename Solver>
bool Iterate(const Sparse& matrix, const Known& right, int32_t most, Clock* clock, Eigen::VectorXd& x,
             SolverTimes* times)
{
    Solver solver;
    solver.setTolerance(1e-9);
    solver.setMaxIterations(most);
    bool fine = Run(solver, matrix, right, clock, x, times);
    times->rounds = (int32_t)solver.iterations();
    return fine;
}

bool SolveDense(const Sparse& matrix, const Known& right, Clock* clock, Eigen::VectorXd& x, SolverTimes* times)
{
    Eigen::MatrixXd full(matrix);
    double start = clock(nullptr);
    Eigen::LDLT<Eigen::MatrixXd> solver(full);
    double factored = clock(nullptr);
    x = solver.solve(right);
    *times = { 0.0, factored - start, clock(nullptr) - factored, 0 };
    return solver.info() == Eigen::Success;
}

bool Solve(int32_t which, const Sparse& matrix, const Known& right, int32_t most, Clock* clock, Eigen::VectorXd& x,
           SolverTimes* times)
{
    const int both = Eigen::Lower | Eigen::Upper;
    typedef Eigen::ConjugateGradient<Sparse, both> Gradient;
    typedef Eigen::ConjugateGradient<Sparse, Eigen::Lower, Eigen::IncompleteCholesky<double>> Incomplete;
    Eigen::SimplicialLDLT<Sparse> ldlt;
    Eigen::SimplicialLLT<Sparse> llt;
    Eigen::SparseLU<Sparse> lu;
    switch (which) {
    case SOLVER_LDLT:
        return Run(ldlt, matrix, right, clock, x, times);
    case SOLVER_LLT:
        return Run(llt, matrix, right, clock, x, times);
    case SOLVER_LU:
        return Run(lu, matrix, right, clock, x, times);
    case SOLVER_CG_DIAGONAL:
        return Iterate<Gradient>(matrix, right, most, clock, x, times);
    case SOLVER_CG_INCOMPLETE:
        return Iterate<Incomplete>(matrix, right, most, clock, x, times);
    case SOLVER_BICGSTAB:
        return Iterate<Eigen::BiCGSTAB<Sparse>>(matrix, right, most, clock, x, times);
    default:
        return SolveDense(matrix, right, clock, x, times);
    }
}

} // namespace

int32_t EigenSolvers_Solve(int32_t solver, const SparseSystem* system, int32_t most, double (*clock)(void* user),
                           double* solution, SolverTimes* times)
{
    Sparse matrix = MakeMatrix(system);
    Eigen::VectorXd x;
    bool fine = Solve(solver, matrix, Known(system->right, system->unknowns), most, clock, x, times);
    if (fine) {
        Eigen::Map<Eigen::VectorXd>(solution, system->unknowns) = x;
    }
    return fine;
}

void EigenSolvers_Reference(const SparseSystem* system, double* solution)
{
    Sparse matrix = MakeMatrix(system);
    Known right(system->right, system->unknowns);
    Eigen::SimplicialLDLT<Sparse> solver(matrix);
    Eigen::VectorXd x = solver.solve(right);
    for (int again = 0; again < 2; ++again) {
        x += solver.solve(right - matrix * x);
    }
    Eigen::Map<Eigen::VectorXd>(solution, system->unknowns) = x;
}

double EigenSolvers_Distance(const SparseSystem* system, const double* solution, const double* reference)
{
    Sparse matrix = MakeMatrix(system);
    Known x(solution, system->unknowns), exact(reference, system->unknowns);
    Eigen::VectorXd off = x - exact;
    return std::sqrt(std::fabs(off.dot(matrix * off)) / exact.dot(matrix * exact));
}
