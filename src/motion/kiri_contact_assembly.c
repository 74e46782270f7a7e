/* What contacts put into the linear system. */
#include "kiri_solver_work.h"

/* The derivatives of a move of the point along an axis by the unknowns of a member, at whose `arm` it is. */
static void DerivePoint(const kiriSolver* solver, const kiriSystem* system, kiriWeight member, kiriVec2 local,
                        kiriVec3 arm, kiriVec3 axis, double* J)
{
    kiriVec3 along = kiriVec3_Scale(member.value, axis);
    kiriFrameRow row = { { along, kiriVec3_Scale(local.x, along), kiriVec3_Scale(local.y, along), { 0.0, 0.0, 0.0 } } };
    if (!kiriMechanics_IsAffine(&system->mechanics)) {
        row.by[1] = kiriVec3_Cross(arm, along);
    }
    if (system->frames[member.frame].held) {
        memset(J, 0, sizeof(double) * (size_t)solver->size);
    } else {
        kiriSolver_Reduce(solver, &row, J);
    }
}

/* Two axes of the plane; the first along the slide where it slips. */
static void FindAxes(const kiriContactStep* step, kiriVec3 normal, kiriVec3 axes[2])
{
    kiriVec3 other = fabs(normal.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
    bool slips = !step->sticks && kiriVec3_Length(step->direction) > 0.5;
    axes[1] = kiriVec3_Normalize(kiriVec3_Cross(normal, slips ? step->direction : other));
    axes[0] = kiriVec3_Cross(axes[1], normal);
}

enum { CONTACT_ROWS = 3 };

/* Springs on the point along three axes, and with what each pulls. */
typedef struct PointSprings {
    kiriVec3 axis[CONTACT_ROWS];
    double spring[CONTACT_ROWS], pull[CONTACT_ROWS];
} PointSprings;

static PointSprings SpringsOf(const kiriContactStep* step, kiriVec3 normal)
{
    kiriVec3 drag = kiriContactStep_Drag(step, 0.0);
    PointSprings at = { { normal }, { step->stiffness, 0.0, 0.0 }, { step->stiffness * step->depth, 0.0, 0.0 } };
    FindAxes(step, normal, &at.axis[1]);
    at.spring[1] = step->sticks ? step->grip : 0.0;
    at.spring[2] = step->sticks ? step->grip : kiriContactStep_TurnSpring(step);
    at.pull[1] = kiriVec3_Dot(drag, at.axis[1]);
    at.pull[2] = kiriVec3_Dot(drag, at.axis[2]);
    return at;
}

static void AssembleRows(kiriSolver* solver, const kiriSystem* system, int32_t k, const PointSprings* at)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    double J[CONTACT_ROWS * KIRI_CONTACT_MEMBERS * KIRI_MOST_UNKNOWNS];
    int32_t frames[KIRI_CONTACT_MEMBERS];
    for (int32_t m = 0; m < step->memberCount; ++m) {
        kiriWeight member = step->members[m];
        kiriVec2 local = kiriVec2_Sub(system->contacts[k].at, system->frames[member.frame].center);
        kiriVec3 arm = kiriPose_Along(&solver->poses.data[member.frame], local);
        frames[m] = member.frame;
        for (int e = 0; e < CONTACT_ROWS; ++e) {
            DerivePoint(solver, system, member, local, arm, at->axis[e],
                        &J[solver->size * (step->memberCount * e + m)]);
        }
    }
    kiriSolver_AddSquares(solver, frames, step->memberCount, J, at->spring, at->pull, CONTACT_ROWS);
}

/* ---- The same of rigid frames in space: all is made of one 3 x 3 matrix ---- */

/* How a member carries the point: its weight and arm r; and r x G, by columns of the springs G. */
typedef struct Carrier {
    int32_t frame;
    double weight;
    kiriVec3 arm, moment[3];
} Carrier;

/* Columns of the sum of springs along axes. */
static void SumSprings(const PointSprings* at, kiriVec3 columns[3])
{
    memset(columns, 0, 3 * sizeof(kiriVec3));
    for (int e = 0; e < CONTACT_ROWS; ++e) {
        kiriVec3 axis = at->axis[e], scaled = kiriVec3_Scale(at->spring[e], axis);
        columns[0] = kiriVec3_AddScaled(columns[0], axis.x, scaled);
        columns[1] = kiriVec3_AddScaled(columns[1], axis.y, scaled);
        columns[2] = kiriVec3_AddScaled(columns[2], axis.z, scaled);
    }
}

static void StoreScaled(double scale, kiriVec3 a, double* out)
{
    out[0] = scale * a.x;
    out[1] = scale * a.y;
    out[2] = scale * a.z;
}

/* The block of two members, the first one's unknowns down:  | G        (r2 x G)^T      |
                                                             | r1 x G   r1 x (r2 x G)^T |  times both weights. */
static void WriteBlock(const kiriVec3 springs[3], const Carrier* down, const Carrier* across, double block[36])
{
    double weight = down->weight * across->weight;
    const kiriVec3* m = across->moment;
    const kiriVec3 turned[3] = { { m[0].x, m[1].x, m[2].x }, { m[0].y, m[1].y, m[2].y }, { m[0].z, m[1].z, m[2].z } };
    for (int c = 0; c < 3; ++c) {
        StoreScaled(weight, springs[c], &block[6 * c]);
        StoreScaled(weight, down->moment[c], &block[6 * c + 3]);
        StoreScaled(weight, turned[c], &block[6 * c + 18]);
        StoreScaled(weight, kiriVec3_Cross(down->arm, turned[c]), &block[6 * c + 21]);
    }
}

static void AddCarried(kiriSolver* solver, const Carrier* carrier, kiriVec3 pull)
{
    double* force = &solver->force.data[6 * carrier->frame];
    kiriVec3 along = kiriVec3_Scale(carrier->weight, pull), moment = kiriVec3_Cross(carrier->arm, along);
    const double add[6] = { along.x, along.y, along.z, moment.x, moment.y, moment.z };
    for (int n = 0; n < 6; ++n) {
        force[n] += add[n];
    }
}

static void AssembleRigid(kiriSolver* solver, const kiriSystem* system, int32_t k, const PointSprings* at)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    Carrier carriers[KIRI_CONTACT_MEMBERS];
    kiriVec3 springs[3], pull = { 0.0, 0.0, 0.0 };
    int32_t count = 0;
    SumSprings(at, springs);
    for (int e = 0; e < CONTACT_ROWS; ++e) {
        pull = kiriVec3_AddScaled(pull, at->pull[e], at->axis[e]);
    }
    for (int32_t m = 0; m < step->memberCount; ++m) {
        Carrier* carrier = &carriers[count];
        carrier->frame = step->members[m].frame;
        carrier->weight = step->members[m].value;
        carrier->arm =
            kiriSystem_Arm(system, carrier->frame, system->contacts[k].at, &solver->poses.data[carrier->frame]);
        for (int c = 0; c < 3; ++c) {
            carrier->moment[c] = kiriVec3_Cross(carrier->arm, springs[c]);
        }
        count += !system->frames[carrier->frame].held;
    }
    for (int32_t a = 0; a < count; ++a) {
        AddCarried(solver, &carriers[a], pull);
        for (int32_t b = 0; b <= a; ++b) {
            double block[36];
            WriteBlock(springs, &carriers[a], &carriers[b], block);
            kiriMatrix_AddBlock(solver->matrix, carriers[a].frame, carriers[b].frame, block);
        }
    }
}

void kiriContact_Assemble(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    if (step->isActive) {
        PointSprings at = SpringsOf(step, system->contacts[k].normal);
        bool isRigid = !kiriMechanics_IsAffine(&system->mechanics) && !system->mechanics.planar;
        (isRigid ? AssembleRigid : AssembleRows)(solver, system, k, &at);
    }
}
