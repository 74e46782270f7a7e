#include "kiri_solver.h"

static int32_t CountOf(const kiriStitchRow* row)
{
    KIRI_ASSERT(row->counts[0] >= 0 && row->counts[1] >= 0 && row->counts[0] + row->counts[1] <= KIRI_STITCH_MEMBERS);
    return row->counts[0] + row->counts[1];
}

/* Returns the force of the stitch on its first point at these poses, N. */
static kiriVec3 StitchForce(const kiriSystem* system, const kiriStitchRow* row, const kiriPose* poses)
{
    kiriVec3 apart = kiriVec3_Sub(kiriSystem_Blend(system, row->members, CountOf(row), poses), row->off);
    return kiriVec3_Scale(-row->stiffness, apart);
}

/* Returns the vector of a member's material as its frame carries it. */
static kiriVec3 MemberWay(const kiriStitchRow* row, int32_t member, const kiriPose* poses)
{
    return kiriMat3_Mul(poses[row->members[member].frame].A, row->ways[member >= row->counts[0]]);
}

/* Returns the pull of the hinge's spring on the blend of the vectors, N m. */
static kiriVec3 PullOf(const kiriStitchRow* row, const kiriPose* poses)
{
    kiriVec3 apart = { 0.0, 0.0, 0.0 };
    KIRI_TIMES(m, CountOf(row)) {
        apart = kiriVec3_AddScaled(apart, row->members[m].value, MemberWay(row, m, poses));
    }
    return kiriVec3_Scale(-row->bending, apart);
}

kiriVec3 kiriStitch_Moment(const kiriStitchRow* row, int32_t member, const kiriPose* poses)
{
    KIRI_ASSERT(member < CountOf(row));
    kiriVec3 pull = kiriVec3_Scale(row->members[member].value, PullOf(row, poses));
    return kiriVec3_Cross(MemberWay(row, member, poses), pull);
}

double kiriStitches_Energy(const kiriSystem* system, const kiriPose* poses)
{
    double sum = 0.0;
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 force = StitchForce(system, row, poses);
        sum += 0.5 * kiriVec3_Dot(force, force) / row->stiffness;
        if (row->bending > 0.0) {
            kiriVec3 pull = PullOf(row, poses);
            sum += 0.5 * kiriVec3_Dot(pull, pull) / row->bending;
        }
    }
    return sum;
}

/* Returns the energy if lengths are wrong by their last bits, relative to the square of this error. */
double kiriStitches_Noise(const kiriSolver* solver, const kiriSystem* system)
{
    double sum = 0.0;
    KIRI_EACH_STITCH(row, system) {
        KIRI_ASSERT(CountOf(row) > 0 && row->members[0].frame < system->frameCount);
        kiriVec3 x = solver->start.data[row->members[0].frame].x;
        sum += row->stiffness * kiriVec3_Dot(x, x) + row->bending;
    }
    return sum;
}

static void AddSprings(kiriSolver* solver, const kiriSystem* system, const kiriStitchRow* row, const kiriVec3* ways,
                       double k, kiriVec3 pull)
{
    kiriPointSprings at = { .axis = KIRI_AXES, .spring = { k, k, k }, .pull = { pull.x, pull.y, pull.z } };
    kiriSolver_AddPointSprings(solver, system, row->members, CountOf(row), ways, &at);
}

void kiriStitches_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 ways[KIRI_STITCH_MEMBERS];
        AddSprings(solver, system, row, NULL, row->stiffness, StitchForce(system, row, solver->poses.data));
        if (row->bending > 0.0) {
            KIRI_TIMES(m, CountOf(row)) {
                ways[m] = row->ways[m >= row->counts[0]];
            }
            AddSprings(solver, system, row, ways, row->bending, PullOf(row, solver->poses.data));
        }
    }
}

void kiriStitches_Solve(const kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 move = kiriSolver_MoveOf(solver, system, row->members, CountOf(row));
        row->solved = StitchForce(system, row, solver->poses.data);
        row->solved = kiriVec3_AddScaled(row->solved, -row->stiffness, move);
    }
}

void kiriStitches_TakeForces(const kiriSolver* solver, const kiriSystem* system)
{
    double part = solver->search.scale;
    KIRI_EACH_STITCH(row, system) {
        row->force = kiriVec3_AddScaled(kiriVec3_Scale(1.0 - part, row->force), part, row->solved);
    }
}
