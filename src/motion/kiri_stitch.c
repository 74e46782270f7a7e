#include "kiri_solver.h"

static int32_t CountOf(const kiriStitchRow* row)
{
    KIRI_ASSERT(row->counts[0] >= 0 && row->counts[1] >= 0 && row->counts[0] + row->counts[1] <= KIRI_STITCH_MEMBERS);
    return row->counts[0] + row->counts[1];
}

kiriVec3 kiriStitch_Force(const kiriSystem* system, const kiriStitchRow* row, const kiriPose* poses)
{
    kiriVec3 apart = kiriVec3_Sub(kiriSystem_Blend(system, row->members, CountOf(row), poses), row->off);
    return kiriVec3_Scale(-row->stiffness, apart);
}

double kiriStitches_Energy(const kiriSystem* system, const kiriPose* poses)
{
    double sum = 0.0;
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 force = kiriStitch_Force(system, row, poses);
        sum += 0.5 * kiriVec3_Dot(force, force) / row->stiffness;
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
        sum += row->stiffness * kiriVec3_Dot(x, x);
    }
    return sum;
}

void kiriStitches_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 force = kiriStitch_Force(system, row, solver->poses.data);
        double k = row->stiffness;
        kiriPointSprings at = { { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } },
                                { k, k, k },
                                { force.x, force.y, force.z } };
        kiriSolver_AddPointSprings(solver, system, row->members, CountOf(row), &at);
    }
}
