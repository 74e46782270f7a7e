/* Wind as part of the objective. The force on a small area is D (u - v), with u the velocity of the air, v that of the
   material, and D = density / 2 |u - v| area (drag n n^T + lift (1 - n n^T)) as it is at the start of the step. At the
   end of the step v is linear in the point's place x there (kiri_stepping.h): v = v* + (x - x*) / h'. So the force is
   that of a spring of stiffness D / h' whose target is x* + h' (u - v*): implicit, and it never turns u - v round. */
#include "kiri_solver_work.h"

/* Four points of a region, each with a quarter of its area, have its area, its centroid and its second moments. */
enum { SAMPLES = 4 };

typedef struct WindSpring {
    kiriVec2 at;
    kiriVec3 normal, target;
    double across, along; /* N/m: along the normal, and in the plane */
} WindSpring;

/* The columns of the root (Cholesky's) of the second moments of a unit area, both ways. */
static kiriVec2 SamplePoint(const kiriFrameData* frame, int k)
{
    double uu = frame->inertia[0] / frame->mass, uv = frame->inertia[1] / frame->mass;
    double vv = frame->inertia[2] / frame->mass, first = kiriRoot(uu);
    double side = first > 0.0 ? uv / first : 0.0, rest = kiriRoot(vv - side * side);
    kiriVec2 root = k < 2 ? kiriVec2_Make(first, side) : kiriVec2_Make(0.0, rest);
    return kiriVec2_Add(frame->center, kiriVec2_Scale(k % 2 == 0 ? sqrt(2.0) : -sqrt(2.0), root));
}

static kiriVec3 PredictedVelocity(const kiriSystem* system, const kiriPrediction* prediction, kiriVec2 from)
{
    if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriVec3 turning = kiriVec3_AddScaled(kiriVec3_Scale(from.x, prediction->rate.u), from.y, prediction->rate.v);
        return kiriVec3_Add(prediction->velocity, turning);
    }
    kiriVec3 arm = kiriPose_Along(&prediction->pose, from);
    return kiriVec3_Add(prediction->velocity, kiriVec3_Cross(prediction->spin, arm));
}

static WindSpring SpringAt(const kiriSolver* solver, const kiriSystem* system, int32_t f, int k)
{
    const kiriFrameData* frame = &solver->before.data[f];
    const kiriPrediction* prediction = &solver->predictions.data[f];
    double part = kiriSolver_PieceOf(solver, f)->stepping.part;
    WindSpring spring;
    spring.at = SamplePoint(frame, k);
    kiriVec3 wide = kiriVec3_Cross(frame->A.u, frame->A.v); /* an affine frame stretches its area */
    kiriVec3 past = kiriVec3_Sub(system->air->velocity, kiriFrame_VelocityAt(frame, spring.at));
    double c = 0.5 * system->air->density * kiriVec3_Length(past) * kiriVec3_Length(wide) * frame->area / SAMPLES;
    kiriVec3 velocity = PredictedVelocity(system, prediction, kiriVec2_Sub(spring.at, frame->center));
    kiriVec3 ahead = kiriVec3_Sub(system->air->velocity, velocity);
    spring.normal = kiriVec3_Normalize(wide);
    kiriVec3 predicted = kiriVec3_Add(prediction->pose.x, kiriSystem_Arm(system, f, spring.at, &prediction->pose));
    spring.target = kiriVec3_AddScaled(predicted, part, ahead);
    spring.across = c * system->air->drag / part;
    spring.along = c * system->air->lift / part;
    return spring;
}

static kiriVec3 ForceOf(const WindSpring* spring, kiriVec3 point)
{
    kiriVec3 off = kiriVec3_Sub(spring->target, point);
    double across = kiriVec3_Dot(off, spring->normal);
    return kiriVec3_AddScaled(kiriVec3_Scale(spring->along, off), (spring->across - spring->along) * across,
                              spring->normal);
}

bool kiriSystem_HasWind(const kiriSystem* system)
{
    return system->air != NULL && system->air->density > 0.0 && (system->air->drag > 0.0 || system->air->lift > 0.0);
}

void kiriWind_AddEnergy(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        for (int k = 0; piece->isSearching && !system->frames[f].held && k < SAMPLES; ++k) {
            WindSpring spring = SpringAt(solver, system, f, k);
            kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, f, spring.at, poses), spring.target);
            double across = kiriVec3_Dot(off, spring.normal);
            piece->sum.objective +=
                0.5 * spring.along * kiriVec3_Dot(off, off) + 0.5 * (spring.across - spring.along) * across * across;
        }
    }
}

void kiriWind_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        bool isStill = system->frames[f].held || !kiriSolver_PieceOf(solver, f)->isSearching;
        for (int k = 0; !isStill && k < SAMPLES; ++k) {
            WindSpring spring = SpringAt(solver, system, f, k);
            kiriVec3 n = spring.normal, x = kiriSystem_Point(system, f, spring.at, solver->poses.data);
            kiriVec3 off = kiriVec3_Sub(x, spring.target);
            kiriVec3 axis = fabs(n.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
            kiriVec3 side = kiriVec3_Normalize(kiriVec3_Cross(n, axis)), ahead = kiriVec3_Cross(side, n);
            kiriSolver_AddSpring(solver, system, f, spring.at, n, kiriVec3_Dot(off, n), spring.across);
            if (spring.along > 0.0) {
                kiriSolver_AddSpring(solver, system, f, spring.at, side, kiriVec3_Dot(off, side), spring.along);
                kiriSolver_AddSpring(solver, system, f, spring.at, ahead, kiriVec3_Dot(off, ahead), spring.along);
            }
        }
    }
}

/* The scheme takes a part of it by the force at the start of the step: the larger of the two counts, for this only
   guards against energy from nowhere. */
double kiriWind_Work(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriFrameData *start = &solver->before.data[f], *end = &solver->after.data[f];
    double part = kiriSolver_PieceOf(solver, f)->stepping.part, first = 0.0, last = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        WindSpring spring = SpringAt(solver, system, f, k);
        kiriVec3 from = kiriFrame_Carry(start, spring.at), to = kiriFrame_Carry(end, spring.at);
        kiriVec3 way = kiriVec3_Sub(to, from);
        kiriVec3 past = kiriVec3_Sub(system->air->velocity, kiriFrame_VelocityAt(start, spring.at));
        WindSpring before = spring;
        before.target = kiriVec3_AddScaled(from, part, past);
        first += kiriVec3_Dot(way, ForceOf(&before, from));
        last += kiriVec3_Dot(way, ForceOf(&spring, to));
    }
    return kiriMax(first, last);
}

kiriWrench kiriWind_OnFrame(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    kiriWrench sum = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
    for (int k = 0; k < SAMPLES; ++k) {
        WindSpring spring = SpringAt(solver, system, f, k);
        kiriVec3 point = kiriSystem_Point(system, f, spring.at, solver->poses.data);
        kiriVec3 force = ForceOf(&spring, point);
        kiriWrench wrench = { force, kiriVec3_Cross(kiriVec3_Sub(point, solver->poses.data[f].x), force) };
        kiriWrench_Add(&sum, 1.0, &wrench);
    }
    return sum;
}
