/* Backward Euler as a minimisation over the poses of the frames at the end of the step. The objective is

       1/2 sum over mass points of m |x - x*|^2 / dt^2,  x* where the free flight ends
     + energies of links (strain.h), pins and contacts
     + flex damping: 1/2 k (flexDamping / dt) (strain - strain at the start of the step)^2 for each strain.

   All are squares, so a Gauss-Newton step solves with J^T k J + mass: positive definite by itself, of 6 x 6 blocks,
   with a pattern that only the links decide. The order of summation is fixed. A step allocates nothing, for the matrix,
   its factor and all vectors keep their storage. */

/* Before our own header, which includes C's headers as C. */
#include <Eigen/Sparse>
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <new>
#include <vector>

#include "momentum.h"
#include "solver.h"
#include "strain.h"

namespace
{

const double LONGEST_TURN = 1.0; /* of a frame in one Gauss-Newton step: a Cayley vector */
const int HALVINGS = 12;         /* of a step that does not lower the objective */
const int SECOND_CHANCES = 4;    /* more iterations where the objective ends above that of the start of the step, */
const int FRESH_STARTS = 2;      /* and iterations from there should they fail */
const double ROUNDING = 1e-12;   /* of an objective, relative */
const double LAST_BITS = 8.0 * DBL_EPSILON; /* of a length: what a few operations round off */
const double SLIDE_FLOOR = 1e-9;            /* m: a shorter way is no slide */

typedef kiriVec3 Vec;
typedef Eigen::SparseMatrix<double> Matrix;

inline Vec operator+(Vec a, Vec b)
{
    return kiriVec3_Add(a, b);
}
inline Vec operator-(Vec a, Vec b)
{
    return kiriVec3_Sub(a, b);
}
inline Vec operator*(double s, Vec a)
{
    return kiriVec3_Scale(s, a);
}
inline double Dot(Vec a, Vec b)
{
    return kiriVec3_Dot(a, b);
}
inline double Length(Vec a)
{
    return kiriVec3_Length(a);
}
/* The host reads floats. An eighth leaves room for the sums and blends that they are made of. NaN does not fit. */
inline bool Fits(Vec a)
{
    const double most = 0.125 * (double)FLT_MAX;
    return std::fabs(a.x) <= most && std::fabs(a.y) <= most && std::fabs(a.z) <= most;
}

/* Eigen's factorisation of the upper triangle, in our own order of unknowns: so it takes the matrix as it is, without a
   copy, and allocates nothing once it is analysed. */
class Factor : public Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>>
{
  public:
    void Analyze(const Matrix& matrix)
    {
        this->analyzePattern_preordered(matrix, true);
    }
    bool Factorize(const Matrix& matrix)
    {
        this->template factorize_preordered<true>(matrix);
        return info() == Eigen::Success && this->m_diag.size() > 0 && this->m_diag.minCoeff() > 0.0;
    }
};

/* What the solver knows of a link. Its block in the matrix couples the frame that comes second in the order of unknowns
   (column) with the one that comes first (row). */
struct Slot {
    int first;      /* 0: frame i comes first; 1: frame j */
    int32_t column; /* block column: place of the second frame */
    int32_t block;  /* number of the block in its column */
    double stiffness[KIRI_STRAINS];
    double start[KIRI_STRAINS]; /* strains at the start of the step */
};

} // namespace

struct kiriSolver {
    kiriMemory memory;
    double dt, damping;         /* of this step; flexDamping / dt */
    double noise;               /* J: what rounding leaves unknown of the objective */
    std::vector<int32_t> place; /* a frame's place in the order of unknowns */
    std::vector<int32_t> piece; /* a frame's piece: what links hold together */
    std::vector<kiriPieceMomentum> pieces;
    std::vector<int32_t> blocks;               /* of a block column, above the diagonal */
    std::vector<Slot> slots;                   /* one a link */
    std::vector<kiriFlight> flights;           /* one a frame, as are the poses */
    std::vector<kiriPose> start, poses, trial; /* at the start of the step, now, and where a step would lead */
    std::vector<double> brakes;                /* spring against sliding, one a contact, N/m */
    Matrix matrix;
    Factor factor;
    Eigen::VectorXd force, move; /* the right side: minus the gradient; and the solution */

    /* Rows of a frame's own block, and of a link's, in one of their six columns. */
    double* Diagonal(int32_t frame, int column)
    {
        int32_t c = place[frame];
        return matrix.valuePtr() + matrix.outerIndexPtr()[6 * c + column] + 6 * blocks[c];
    }
    double* Block(const Slot& slot, int column)
    {
        return matrix.valuePtr() + matrix.outerIndexPtr()[6 * slot.column + column] + 6 * slot.block;
    }
};

namespace
{

/* ---- Pattern ----------------------------------------------------------------------------------------------------- */

typedef std::vector<Eigen::Triplet<double>> Entries;
typedef std::vector<std::vector<int32_t>> BlockRows; /* of each block column, above the diagonal, ascending */

/* An order of the frames that keeps the factor sparse. */
void PlaceFrames(kiriSolver* solver, const kiriLink* links)
{
    int32_t count = (int32_t)solver->place.size();
    Entries entries;
    for (int32_t f = 0; f < count; ++f) {
        entries.push_back(Eigen::Triplet<double>(f, f, 1.0));
    }
    for (size_t k = 0; k < solver->slots.size(); ++k) {
        entries.push_back(Eigen::Triplet<double>(links[k].i, links[k].j, 1.0));
        entries.push_back(Eigen::Triplet<double>(links[k].j, links[k].i, 1.0));
    }
    Matrix graph(count, count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
    for (int32_t place = 0; place < count; ++place) {
        solver->place[order.indices()[place]] = place;
    }
}

BlockRows PlaceBlocks(kiriSolver* solver, const kiriLink* links)
{
    BlockRows rows(solver->place.size());
    for (size_t k = 0; k < solver->slots.size(); ++k) {
        int32_t a = solver->place[links[k].i], b = solver->place[links[k].j];
        solver->slots[k].first = a < b ? 0 : 1;
        solver->slots[k].column = std::max(a, b);
        rows[std::max(a, b)].push_back(std::min(a, b));
    }
    for (size_t c = 0; c < rows.size(); ++c) {
        std::sort(rows[c].begin(), rows[c].end());
        rows[c].erase(std::unique(rows[c].begin(), rows[c].end()), rows[c].end());
        solver->blocks[c] = (int32_t)rows[c].size();
    }
    for (size_t k = 0; k < solver->slots.size(); ++k) {
        const std::vector<int32_t>& column = rows[solver->slots[k].column];
        int32_t row = std::min(solver->place[links[k].i], solver->place[links[k].j]);
        solver->slots[k].block = (int32_t)(std::lower_bound(column.begin(), column.end(), row) - column.begin());
    }
    return rows;
}

/* In each column the blocks above the diagonal, then the upper triangle of the diagonal block. */
void MakePattern(kiriSolver* solver, const BlockRows& rows)
{
    int32_t count = (int32_t)rows.size();
    Entries entries;
    for (int32_t c = 0; c < 6 * count; ++c) {
        for (int32_t row : rows[c / 6]) {
            for (int32_t r = 6 * row; r < 6 * row + 6; ++r) {
                entries.push_back(Eigen::Triplet<double>(r, c, 0.0));
            }
        }
        for (int32_t r = c - c % 6; r <= c; ++r) {
            entries.push_back(Eigen::Triplet<double>(r, c, r == c ? 1.0 : 0.0));
        }
    }
    solver->matrix.resize(6 * count, 6 * count);
    solver->matrix.setFromTriplets(entries.begin(), entries.end());
    solver->factor.Analyze(solver->matrix);
}

/* Numbers the pieces by their lowest frame. */
void FindPieces(kiriSolver* solver, const kiriLink* links, int32_t linkCount)
{
    std::vector<int32_t>& piece = solver->piece;
    for (size_t f = 0; f < piece.size(); ++f) {
        piece[f] = (int32_t)f; /* first: a lower frame of the same piece, or itself */
    }
    for (int32_t k = 0; k < linkCount; ++k) {
        int32_t a = links[k].i, b = links[k].j;
        while (piece[a] != a) {
            a = piece[a] = piece[piece[a]];
        }
        while (piece[b] != b) {
            b = piece[b] = piece[piece[b]];
        }
        piece[std::max(a, b)] = std::min(a, b);
    }
    int32_t count = 0;
    for (size_t f = 0; f < piece.size(); ++f) {
        piece[f] = piece[f] == (int32_t)f ? count++ : piece[piece[f]];
    }
    solver->pieces.resize(count);
}

void Prepare(kiriSolver* solver, int32_t frameCount, const kiriLink* links, int32_t linkCount)
{
    solver->place.resize(frameCount);
    solver->blocks.resize(frameCount);
    solver->piece.resize(frameCount);
    solver->slots.resize(linkCount);
    solver->flights.resize(frameCount);
    solver->start.resize(frameCount);
    solver->poses.resize(frameCount);
    solver->trial.resize(frameCount);
    solver->force.setZero(6 * frameCount);
    solver->move.setZero(6 * frameCount);
    PlaceFrames(solver, links);
    MakePattern(solver, PlaceBlocks(solver, links));
    FindPieces(solver, links, linkCount);
}

/* ---- Objective --------------------------------------------------------------------------------------------------- */

typedef std::vector<kiriPose> Poses;

void Measure(const kiriSystem* system, const kiriLink& link, const Poses& poses, double* strain, kiriStrainRow* rows)
{
    const kiriFrameData* const frames[2] = { &system->frames[link.i], &system->frames[link.j] };
    const kiriPose* const ends[2] = { &poses[link.i], &poses[link.j] };
    kiriStrain_Measure(&link, frames, ends, strain, rows);
}

/* A material point as seen from its frame's x. */
Vec ArmOf(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose& pose)
{
    return kiriPose_Along(&pose, kiriVec2_Sub(at, system->frames[frame].center));
}

/* How far the point of a contact has slid since the start of the step. */
Vec SlideOf(const kiriSystem* system, const kiriContactRow& contact, Vec point)
{
    Vec way = point - kiriFrame_Carry(&system->frames[contact.frame], contact.at);
    return way - Dot(way, contact.normal) * contact.normal;
}

/* The objective, and what of it is energy that the sheet has: the rest is lost, or the inertia's. */
struct Energy {
    double objective, potential;

    void Add(double stored, double lost)
    {
        potential += stored;
        objective += stored + lost;
    }
};

void AddPinEnergy(const kiriSystem* system, const kiriPinRow& pin, const Poses& poses, Energy* sum)
{
    Vec off = poses[pin.frame].x + ArmOf(system, pin.frame, pin.at, poses[pin.frame]) - pin.target;
    sum->Add(0.5 * pin.stiffness * Dot(off, off), 0.0);
}

void AddContactEnergy(const kiriSystem* system, const kiriContactRow& contact, double brake, const Poses& poses,
                      Energy* sum)
{
    Vec point = poses[contact.frame].x + ArmOf(system, contact.frame, contact.at, poses[contact.frame]);
    double depth = std::max(contact.offset - Dot(contact.normal, point), 0.0);
    Vec slide = SlideOf(system, contact, point);
    sum->Add(0.5 * contact.stiffness * depth * depth, 0.5 * brake * Dot(slide, slide));
}

void AddLinkEnergy(const kiriSolver* solver, const kiriSystem* system, int32_t k, const Poses& poses, Energy* sum)
{
    const Slot& slot = solver->slots[k];
    double strain[KIRI_STRAINS];
    Measure(system, system->links[k], poses, strain, NULL);
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        double change = strain[e] - slot.start[e];
        sum->Add(0.5 * slot.stiffness[e] * strain[e] * strain[e],
                 0.5 * slot.stiffness[e] * solver->damping * change * change);
    }
}

Energy Evaluate(const kiriSolver* solver, const kiriSystem* system, const Poses& poses)
{
    Energy sum = { 0.0, 0.0 };
    double moved = 0.0;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        Vec off = poses[f].x - solver->flights[f].pose.x;
        moved += system->frames[f].mass * Dot(off, off) + kiriFlight_TurnSquared(&solver->flights[f], &poses[f].A);
    }
    sum.Add(0.0, 0.5 * moved / (solver->dt * solver->dt));
    for (int32_t k = 0; k < system->linkCount; ++k) {
        AddLinkEnergy(solver, system, k, poses, &sum);
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        AddPinEnergy(system, system->pins[k], poses, &sum);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        AddContactEnergy(system, system->contacts[k], solver->brakes[k], poses, &sum);
    }
    return sum;
}

/* The energy of every spring and of the inertia when lengths are off by their last bits. A sheet at rest has no
   more. */
double Noise(const kiriSolver* solver, const kiriSystem* system)
{
    double sum = 0.0;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        Vec x = solver->start[f].x;
        sum += system->frames[f].mass * Dot(x, x) / (solver->dt * solver->dt);
    }
    for (int32_t k = 0; k < system->linkCount; ++k) {
        const double* stiffness = solver->slots[k].stiffness;
        double reach = Length(solver->start[system->links[k].i].x) + system->links[k].length;
        sum += reach * reach * (stiffness[KIRI_STRETCH] + stiffness[KIRI_SHEAR] + stiffness[KIRI_NORMAL_GAP]);
        sum += stiffness[KIRI_PLANE_BENDING] + stiffness[KIRI_BENDING] + stiffness[KIRI_TWIST];
    }
    return LAST_BITS * LAST_BITS * (1.0 + solver->damping) * sum;
}

/* ---- Matrix and forces ------------------------------------------------------------------------------------------- */

void Store(double* six, Vec move, Vec turn)
{
    const double values[6] = { move.x, move.y, move.z, turn.x, turn.y, turn.z };
    std::copy(values, values + 6, six);
}

/* A held frame has the identity and no force: it stays where it was put. */
void AddHeld(kiriSolver* solver, int32_t f)
{
    for (int column = 0; column < 6; ++column) {
        solver->Diagonal(f, column)[column] = 1.0;
    }
}

void AddMass(kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriFlight& flight = solver->flights[f];
    const kiriPose& pose = solver->poses[f];
    double perTime = 1.0 / (solver->dt * solver->dt), mass = perTime * system->frames[f].mass;
    kiriMat3 inertia = kiriFlight_Inertia(&flight, &pose.A);
    const Vec columns[3] = { perTime * inertia.u, perTime * inertia.v, perTime * inertia.d };
    for (int column = 0; column < 3; ++column) {
        const double rows[3] = { columns[column].x, columns[column].y, columns[column].z };
        solver->Diagonal(f, column)[column] = mass;
        std::copy(rows, rows + column + 1, solver->Diagonal(f, 3 + column) + 3);
    }
    Store(solver->force.data() + 6 * solver->place[f], -mass * (pose.x - flight.pose.x),
          -perTime * kiriFlight_TurnGradient(&flight, &pose.A));
}

/* The strains' derivatives by the twelve unknowns, those of the frame that comes first in front; those of a held frame
   are zero. Returns in `springs` and `forces` what multiplies them. */
void DifferentiateLink(const kiriSolver* solver, const kiriSystem* system, int32_t k, double J[KIRI_STRAINS][12],
                       double springs[KIRI_STRAINS], double forces[KIRI_STRAINS])
{
    const Slot& slot = solver->slots[k];
    const int32_t ends[2] = { system->links[k].i, system->links[k].j };
    double strain[KIRI_STRAINS];
    kiriStrainRow rows[KIRI_STRAINS];
    Measure(system, system->links[k], solver->poses, strain, rows);
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        springs[e] = slot.stiffness[e] * (1.0 + solver->damping);
        forces[e] = -slot.stiffness[e] * (strain[e] + solver->damping * (strain[e] - slot.start[e]));
        for (int half = 0; half < 2; ++half) {
            int end = half ^ slot.first;
            std::fill(J[e] + 6 * half, J[e] + 6 * half + 6, 0.0);
            if (!system->frames[ends[end]].held) {
                Store(J[e] + 6 * half, rows[e].move[end], rows[e].turn[end]);
            }
        }
    }
}

void AddLink(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const Slot& slot = solver->slots[k];
    const kiriLink& link = system->links[k];
    const int32_t ends[2] = { slot.first == 0 ? link.i : link.j, slot.first == 0 ? link.j : link.i };
    double J[KIRI_STRAINS][12], springs[KIRI_STRAINS], forces[KIRI_STRAINS];
    DifferentiateLink(solver, system, k, J, springs, forces);
    for (int column = 0; column < 12; ++column) {
        int half = column / 6;
        double* out[2] = { half == 0 ? solver->Diagonal(ends[0], column) : solver->Block(slot, column - 6),
                           half == 0 ? NULL : solver->Diagonal(ends[1], column - 6) };
        double force = 0.0;
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            force += forces[e] * J[e][column];
        }
        solver->force[6 * solver->place[ends[half]] + column - 6 * half] += force;
        for (int row = 0; row <= column; ++row) {
            double sum = 0.0;
            for (int e = 0; e < KIRI_STRAINS; ++e) {
                sum += springs[e] * J[e][column] * J[e][row];
            }
            out[row / 6][row % 6] += sum;
        }
    }
}

/* A spring on a point of a frame, stretched by `length` along the unit vector `axis`. */
void AddSpring(kiriSolver* solver, int32_t f, Vec arm, Vec axis, double length, double stiffness)
{
    double J[6];
    Store(J, axis, kiriVec3_Cross(arm, axis));
    for (int column = 0; column < 6; ++column) {
        solver->force[6 * solver->place[f] + column] -= stiffness * length * J[column];
        for (int row = 0; row <= column; ++row) {
            solver->Diagonal(f, column)[row] += stiffness * J[column] * J[row];
        }
    }
}

void AddPin(kiriSolver* solver, const kiriSystem* system, const kiriPinRow& pin)
{
    const kiriPose& pose = solver->poses[pin.frame];
    Vec arm = ArmOf(system, pin.frame, pin.at, pose), off = pose.x + arm - pin.target;
    AddSpring(solver, pin.frame, arm, kiriVec3_Make(1.0, 0.0, 0.0), off.x, pin.stiffness);
    AddSpring(solver, pin.frame, arm, kiriVec3_Make(0.0, 1.0, 0.0), off.y, pin.stiffness);
    AddSpring(solver, pin.frame, arm, kiriVec3_Make(0.0, 0.0, 1.0), off.z, pin.stiffness);
}

void AddContact(kiriSolver* solver, const kiriSystem* system, const kiriContactRow& contact, double brake)
{
    const kiriPose& pose = solver->poses[contact.frame];
    Vec arm = ArmOf(system, contact.frame, contact.at, pose), n = contact.normal;
    double height = Dot(n, pose.x + arm) - contact.offset;
    if (height < 0.0) {
        AddSpring(solver, contact.frame, arm, n, height, contact.stiffness);
    }
    if (brake > 0.0) {
        Vec axis = std::fabs(n.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
        Vec side = kiriVec3_Normalize(kiriVec3_Cross(n, axis)), ahead = kiriVec3_Cross(side, n);
        Vec slide = SlideOf(system, contact, pose.x + arm);
        AddSpring(solver, contact.frame, arm, side, Dot(slide, side), brake);
        AddSpring(solver, contact.frame, arm, ahead, Dot(slide, ahead), brake);
    }
}

/* Friction is at most `friction` times the push. Both are those of the iteration before: a spring that is chosen here
   and kept through the next step leaves the objective a sum of squares. */
void SetBrakes(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriContactRow& contact = system->contacts[k];
        const kiriPose& pose = solver->poses[contact.frame];
        Vec point = pose.x + ArmOf(system, contact.frame, contact.at, pose);
        double push = contact.stiffness * std::max(contact.offset - Dot(contact.normal, point), 0.0);
        double slide = std::max(Length(SlideOf(system, contact, point)), SLIDE_FLOOR);
        solver->brakes[k] = std::min(contact.stiffness, contact.friction * push / slide);
    }
}

void Assemble(kiriSolver* solver, const kiriSystem* system)
{
    std::fill(solver->matrix.valuePtr(), solver->matrix.valuePtr() + solver->matrix.nonZeros(), 0.0);
    solver->force.setZero();
    for (int32_t f = 0; f < system->frameCount; ++f) {
        system->frames[f].held ? AddHeld(solver, f) : AddMass(solver, system, f);
    }
    for (int32_t k = 0; k < system->linkCount; ++k) {
        AddLink(solver, system, k);
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        if (!system->frames[system->pins[k].frame].held) {
            AddPin(solver, system, system->pins[k]);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (!system->frames[system->contacts[k].frame].held) {
            AddContact(solver, system, system->contacts[k], solver->brakes[k]);
        }
    }
}

/* ---- Iteration --------------------------------------------------------------------------------------------------- */

void Begin(kiriSolver* solver, const kiriSystem* system, double dt)
{
    solver->dt = dt;
    solver->damping = (double)system->material.flexDamping / dt;
    solver->brakes.assign(system->contactCount, 0.0);
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriFrameData* frame = &system->frames[f];
        solver->start[f] = kiriPose_Of(frame);
        solver->flights[f] = frame->held ? kiriFlight_Held(frame, &system->material, dt)
                                         : kiriFlight_Free(frame, &system->material, system->gravity, dt);
        solver->poses[f] = solver->flights[f].coast;
        solver->trial[f] = solver->flights[f].pose;
    }
    for (int32_t k = 0; k < system->linkCount; ++k) {
        kiriStrain_Stiffness(&system->links[k], &system->material, solver->slots[k].stiffness);
        Measure(system, system->links[k], solver->start, solver->slots[k].start, NULL);
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (system->frames[f].held) {
            solver->start[f] = solver->flights[f].pose;
        }
    }
    solver->noise = Noise(solver, system);
}

/* How much of the Gauss-Newton step turns no frame too far. */
double LongestStep(const kiriSolver* solver)
{
    double longest = LONGEST_TURN;
    for (size_t f = 0; f < solver->poses.size(); ++f) {
        const double* m = solver->move.data() + 6 * f;
        longest = std::max(longest, Length(kiriVec3_Make(m[3], m[4], m[5])));
    }
    return LONGEST_TURN / longest;
}

void Try(kiriSolver* solver, double scale)
{
    for (size_t f = 0; f < solver->poses.size(); ++f) {
        const kiriPose& pose = solver->poses[f];
        const double* m = solver->move.data() + 6 * solver->place[f];
        solver->trial[f].x = pose.x + scale * kiriVec3_Make(m[0], m[1], m[2]);
        solver->trial[f].A = kiriMat3_MulMat(kiriMat3_Cayley(scale * kiriVec3_Make(m[3], m[4], m[5])), pose.A);
    }
}

/* Where springs are stiffer than inertia by more than doubles tell apart, elimination cancels what the inertia put on
   the diagonal, and rounding decides the sign. An addition of the size of what is rounded off makes the matrix
   positive; so light a sheet then falls too slowly. */
bool Factorize(kiriSolver* solver)
{
    if (solver->factor.Factorize(solver->matrix)) {
        return true;
    }
    for (Eigen::Index c = 0; c < solver->matrix.cols(); ++c) {
        solver->matrix.valuePtr()[solver->matrix.outerIndexPtr()[c + 1] - 1] *= 1.0 + LAST_BITS;
    }
    return solver->factor.Factorize(solver->matrix);
}

/* One Gauss-Newton step, halved until the objective falls, or is at most `allowed`. False when the matrix has no
   factor. */
bool Iterate(kiriSolver* solver, const kiriSystem* system, double allowed, Energy* energy)
{
    Assemble(solver, system);
    if (!Factorize(solver)) {
        return false;
    }
    solver->move = solver->factor.solve(solver->force);
    *energy = Evaluate(solver, system, solver->poses);
    double enough = std::max(allowed, energy->objective) * (1.0 + ROUNDING) + solver->noise;
    double scale = LongestStep(solver), taken = 0.0;
    for (int halving = 0; halving <= HALVINGS && taken == 0.0; ++halving, scale *= 0.5) {
        Try(solver, scale);
        Energy value = Evaluate(solver, system, solver->trial);
        if (value.objective <= enough) {
            *energy = value;
            taken = scale;
        }
    }
    Try(solver, taken);
    solver->poses.swap(solver->trial);
    return true;
}

/* ---- Energy ------------------------------------------------------------------------------------------------------ */

/* Velocities at the end of the step. */
Vec VelocityOf(const kiriSolver* solver, int32_t f)
{
    const kiriFlight& flight = solver->flights[f];
    return flight.velocity + (1.0 / solver->dt) * (solver->poses[f].x - flight.pose.x);
}

Vec SpinOf(const kiriSolver* solver, int32_t f)
{
    const kiriFlight& flight = solver->flights[f];
    kiriMat3 inertia = kiriFlight_Inertia(&flight, &solver->poses[f].A);
    Vec turn = kiriMat3_Solve(&inertia, kiriFlight_TurnGradient(&flight, &solver->poses[f].A));
    return flight.spin + (1.0 / solver->dt) * turn;
}

double KineticEnergy(const kiriSolver* solver, const kiriSystem* system, int32_t f, const kiriMat3& A, Vec velocity,
                     Vec spin)
{
    kiriMat3 inertia = kiriFlight_Inertia(&solver->flights[f], &A);
    return 0.5 * system->frames[f].mass * Dot(velocity, velocity) + 0.5 * Dot(spin, kiriMat3_Mul(inertia, spin));
}

/* By how much kinetic and potential energy grow in the step beyond the work of gravity and of the host's forces; what
   rounding explains is no gain. A held frame counts as moved before the step. */
double Gain(const kiriSolver* solver, const kiriSystem* system, double potentialBefore, double potentialAfter)
{
    double before = potentialBefore, after = potentialAfter, work = 0.0;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriFrameData& frame = system->frames[f];
        if (!frame.held) {
            Vec velocity = VelocityOf(solver, f), spin = SpinOf(solver, f);
            before += KineticEnergy(solver, system, f, frame.A, frame.velocity, frame.spin);
            after += KineticEnergy(solver, system, f, solver->poses[f].A, velocity, spin);
            work += frame.mass * Dot(system->gravity, solver->poses[f].x - frame.x) +
                    Dot(frame.force, solver->poses[f].x - frame.x) + solver->dt * Dot(frame.torque, spin);
        }
    }
    return after - before - work - ROUNDING * (before + after + std::fabs(work)) - solver->noise;
}

/* The factor that takes an energy out of velocities that have `kinetic`; what they do not have is left in `energy`. */
double Keep(double kinetic, double* energy)
{
    double taken = std::min(kinetic, *energy);
    *energy -= taken;
    return taken < kinetic ? std::sqrt(1.0 - taken / kinetic) : 0.0;
}

/* Takes an energy out of the velocities: as they differ from the mean first, for so momentum stays. Only where pins or
   contacts change momentum can there be more to take. */
void Brake(kiriSolver* solver, const kiriSystem* system, double energy)
{
    double mass = 0.0, kinetic = 0.0;
    Vec momentum = kiriVec3_Make(0.0, 0.0, 0.0);
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (!system->frames[f].held) {
            mass += system->frames[f].mass;
            momentum = momentum + system->frames[f].mass * solver->flights[f].velocity;
        }
    }
    Vec mean = (1.0 / std::max(mass, DBL_MIN)) * momentum;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (!system->frames[f].held) {
            const kiriFlight& flight = solver->flights[f];
            kinetic += KineticEnergy(solver, system, f, solver->poses[f].A, flight.velocity - mean, flight.spin);
        }
    }
    double keep = Keep(kinetic, &energy), keepMean = Keep(0.5 * mass * Dot(mean, mean), &energy);
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (!system->frames[f].held) {
            kiriFlight& flight = solver->flights[f];
            flight.velocity = keepMean * mean + keep * (flight.velocity - mean);
            flight.spin = keep * flight.spin;
        }
    }
}

/* ---- Step -------------------------------------------------------------------------------------------------------- */

/* The iteration starts where the frames coast by their velocities: a strip that swings is then nearly there, and one at
   rest is there. The first step may raise the objective up to that of the free flight: it has to turn stiff frames,
   which stretches links before the next step lets them go, and halving it there would freeze the turning.

   The objective must not end above that of not moving at all. Should it end above all the same, the iteration starts
   anew from not moving, from where it only falls. Then, with v the velocities before and w those after the step,

       potential after + 1/2 m (w - v)^2  <=  potential before + 1/2 m v^2 + work,

   which bounds w by 2 v and no better. At the minimum w^2 stands for (w - v)^2, but for parts of the energy that are
   not convex; so while energy is gained, iterations are added, and what is gained even then is taken out of the
   velocities. Nothing is ever flung away, however long the step. */
int32_t Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, double* gain)
{
    double allowed = Evaluate(solver, system, solver->trial).objective;
    Energy start = Evaluate(solver, system, solver->start), energy = { HUGE_VAL, HUGE_VAL };
    double limit = start.objective * (1.0 + ROUNDING) + solver->noise;
    int32_t done = 0, chances = iterations + SECOND_CHANCES;
    *gain = HUGE_VAL;
    while (done < iterations || (*gain > 0.0 && done < chances) ||
           (done < chances + FRESH_STARTS && !(energy.objective <= limit))) {
        if (done == chances) {
            solver->poses = solver->start;
        }
        /* Before the first step the push is that of the free flight, far too strong at an impact. */
        if (done > 0 || iterations == 1) {
            SetBrakes(solver, system);
        }
        if (!Iterate(solver, system, done == 0 ? allowed : 0.0, &energy)) {
            return -1;
        }
        ++done;
        *gain = done < iterations ? HUGE_VAL : Gain(solver, system, start.potential, energy.potential);
    }
    return done;
}

void MarkHeld(kiriSolver* solver, const kiriSystem* system)
{
    for (size_t i = 0; i < solver->pieces.size(); ++i) {
        solver->pieces[i].isHeld = 0;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        solver->pieces[solver->piece[f]].isHeld |= system->frames[f].held;
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        solver->pieces[solver->piece[system->pins[k].frame]].isHeld = 1;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        solver->pieces[solver->piece[system->contacts[k].frame]].isHeld = 1;
    }
}

/* Velocities at the end of the step. */
void Land(kiriSolver* solver, const kiriSystem* system, double gain)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        Vec velocity = VelocityOf(solver, f), spin = SpinOf(solver, f);
        solver->flights[f].velocity = velocity;
        solver->flights[f].spin = spin;
    }
    if (gain > 0.0) {
        Brake(solver, system, gain);
    } else {
        MarkHeld(solver, system);
        kiriMomentum_Restore(system->frames, system->frameCount, solver->poses.data(), solver->flights.data(),
                             solver->piece.data(), solver->pieces.data(), (int32_t)solver->pieces.size(),
                             &system->material, solver->dt, -gain);
    }
}

bool CanBeRead(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriPose& pose = solver->poses[f];
        const kiriFlight& flight = solver->flights[f];
        Vec arm = ArmOf(system, f, system->frames[f].site.at, pose);
        if (!Fits(pose.x) || !Fits(pose.A.u + pose.A.v + pose.A.d) || !Fits(flight.velocity) || !Fits(flight.spin) ||
            !Fits(kiriVec3_Cross(flight.spin, arm))) {
            return false;
        }
    }
    return true;
}

void Finish(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriFrameData* frame = &system->frames[f];
        frame->x = solver->poses[f].x;
        frame->A = frame->held ? frame->heldRotation : kiriMat3_Rotation(solver->poses[f].A);
        frame->velocity = solver->flights[f].velocity;
        frame->spin = solver->flights[f].spin;
    }
}

} // namespace

extern "C" kiriSolver* kiriSolver_Create(const kiriMemory* memory, int32_t frameCount, const kiriLink* links,
                                         int32_t linkCount)
{
    void* room = kiriMemory_Alloc(memory, (int64_t)sizeof(kiriSolver));
    if (room == NULL) {
        return NULL;
    }
    kiriSolver* solver = NULL;
    try {
        solver = new (room) kiriSolver();
        solver->memory = *memory;
        Prepare(solver, frameCount, links, linkCount);
        return solver;
    } catch (...) {
        if (solver != NULL) {
            solver->~kiriSolver();
        }
        kiriMemory_Free(memory, room);
        return NULL;
    }
}

extern "C" void kiriSolver_Destroy(kiriSolver* solver)
{
    if (solver != NULL) {
        kiriMemory memory = solver->memory;
        solver->~kiriSolver();
        kiriMemory_Free(&memory, solver);
    }
}

extern "C" int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations)
{
    try {
        Begin(solver, system, dt);
        double gain;
        int32_t done = Minimise(solver, system, iterations, &gain);
        if (done < 0) {
            return -1;
        }
        Land(solver, system, gain);
        if (!CanBeRead(solver, system)) {
            return -1;
        }
        Finish(solver, system);
        return done;
    } catch (...) {
        return -1;
    }
}

extern "C" double kiriSolver_ElasticEnergy(const kiriSystem* system)
{
    double sum = 0.0;
    for (int32_t k = 0; k < system->linkCount; ++k) {
        const kiriLink& link = system->links[k];
        const kiriFrameData* const frames[2] = { &system->frames[link.i], &system->frames[link.j] };
        const kiriPose poses[2] = { kiriPose_Of(frames[0]), kiriPose_Of(frames[1]) };
        const kiriPose* const ends[2] = { &poses[0], &poses[1] };
        double strain[KIRI_STRAINS], stiffness[KIRI_STRAINS];
        kiriStrain_Measure(&link, frames, ends, strain, NULL);
        kiriStrain_Stiffness(&link, &system->material, stiffness);
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            sum += 0.5 * stiffness[e] * strain[e] * strain[e];
        }
    }
    return sum;
}
