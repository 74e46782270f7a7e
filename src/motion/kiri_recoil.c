#include "kiri_solver.h"

/* Returns how far the obstacle's material at the contact moves by these unknowns, m. */
static kiriVec3 WayBy(const kiriContactStep* step, const double* z)
{
    const kiriYieldRow* body = step->body;
    kiriVec3 turn = kiriMat3_Mul(body->turning, kiriVec3_Make(z[3], z[4], z[5]));
    return kiriVec3_AddScaled(kiriVec3_Cross(turn, step->arm), body->moving, kiriVec3_Make(z[0], z[1], z[2]));
}

kiriVec3 kiriRecoil_Way(const kiriContactStep* step)
{
    return step->body != NULL ? WayBy(step, step->body->at) : kiriVec3_Make(0.0, 0.0, 0.0);
}

kiriVec3 kiriRecoil_Move(const kiriContactStep* step)
{
    return WayBy(step, step->body->move);
}

/* chosen: the heaviest so far, heaviest first. */
void kiriRecoil_Choose(kiriYieldRow* row, kiriYieldRow** chosen, int32_t* count)
{
    bool isNew = true;
    KIRI_TIMES_WHILE(isNew, n, *count) {
        isNew = chosen[n] != row;
    }
    int32_t at = *count;
    while (isNew && at > 0 && chosen[at - 1]->inverseMass > row->inverseMass) {
        --at;
    }
    if (isNew && at < KIRI_MOST_RECOILING) {
        *count = kiriMin(*count + 1, KIRI_MOST_RECOILING);
        memmove(&chosen[at + 1], &chosen[at], sizeof(*chosen) * (size_t)(*count - 1 - at));
        chosen[at] = row;
    }
}

/* Lists the obstacle if it is new, with the scales of its unknowns: their inertia is 1/2 |z|^2 / h'^2. */
void kiriRecoil_Join(kiriSolver* solver, kiriContactStep* step)
{
    kiriYieldRow* body = step->yield;
    bool isNew = true;
    KIRI_ASSERT(step->row->reach > 0.0 && body->inverseMass > 0.0);
    KIRI_EACH_WHILE(isNew, kiriYieldRow* const, other, solver->recoil.bodies) {
        isNew = *other != body;
    }
    step->body = body;
    if (isNew) {
        KIRI_ASSERT(solver->recoil.bodies.count < solver->recoil.bodies.capacity);
        body->place = KIRI_RECOILS * solver->recoil.bodies.count;
        body->moving = kiriRoot(body->inverseMass);
        /* The lower triangular L with L L^T = A. Axes about which it does not turn have columns of zeros. */
        kiriMat3 *L = &body->turning, *A = &body->inverseInertia;
        KIRI_CLEAR(L);
        L->u.x = kiriRoot(kiriMax(A->u.x, 0.0));
        L->u.y = L->u.x > 0.0 ? A->u.y / L->u.x : 0.0;
        L->u.z = L->u.x > 0.0 ? A->u.z / L->u.x : 0.0;
        L->v.y = kiriRoot(kiriMax(A->v.y - L->u.y * L->u.y, 0.0));
        L->v.z = L->v.y > 0.0 ? (A->v.z - L->u.y * L->u.z) / L->v.y : 0.0;
        L->d.z = kiriRoot(kiriMax(A->d.z - L->u.z * L->u.z - L->v.z * L->v.z, 0.0));
        KIRI_NEXT(solver->recoil.bodies) = body;
    }
}

static double PerTime(const kiriSolver* solver)
{
    return 1.0 / (solver->stepping.part * solver->stepping.part);
}

#define EACH_BODY(body, solver) KIRI_EACH(kiriYieldRow* const, body, (solver)->recoil.bodies)

void kiriRecoil_Begin(const kiriSolver* solver)
{
    EACH_BODY(body, solver) {
        KIRI_CLEAR(&(*body)->from);
        KIRI_CLEAR(&(*body)->at);
        KIRI_CLEAR(&(*body)->move);
    }
}

double kiriRecoil_Energy(const kiriSolver* solver)
{
    double sum = 0.0;
    EACH_BODY(body, solver) {
        KIRI_TIMES(n, KIRI_RECOILS) {
            sum += 0.5 * PerTime(solver) * (*body)->at[n] * (*body)->at[n];
        }
    }
    return sum;
}

void kiriRecoil_Clear(kiriSolver* solver, int32_t frameCount)
{
    kiriRecoil* recoil = &solver->recoil;
    int32_t count = KIRI_RECOILS * recoil->bodies.count;
    int64_t all = (int64_t)solver->size * frameCount;
    if (count == 0) {
        return;
    }
    KIRI_ASSERT(all * count <= recoil->border.capacity && count <= recoil->pull.capacity);
    memset(recoil->border.data, 0, sizeof(double) * (size_t)(all * count));
    memset(recoil->corner.data, 0, sizeof(double) * (size_t)(count * count));
    EACH_BODY(body, solver) {
        KIRI_TIMES(n, KIRI_RECOILS) {
            int32_t at = (*body)->place + n;
            recoil->corner.data[count * at + at] = PerTime(solver);
            recoil->pull.data[at] = -PerTime(solver) * (*body)->from[n];
        }
        KIRI_CLEAR(&(*body)->move);
    }
}

void kiriRecoil_AddSprings(kiriSolver* solver, const kiriSystem* system, const int32_t* frames, int32_t frameCount,
                           const double* J, const kiriPointSprings* at)
{
    const kiriContactStep* step = at->contact;
    kiriRecoil* recoil = &solver->recoil;
    int32_t size = solver->size, count = KIRI_RECOILS * recoil->bodies.count, place = step->body->place;
    int64_t all = (int64_t)size * system->frameCount;
    KIRI_ASSERT(place >= 0 && place + KIRI_RECOILS <= count && at->share > 0.0);
    KIRI_TIMES(e, KIRI_POINT_ROWS) {
        kiriVec3 axis = at->axis[e], round = kiriVec3_Cross(step->arm, axis);
        const kiriMat3* turning = &step->body->turning;
        const double own[KIRI_RECOILS] = { step->body->moving * axis.x, step->body->moving * axis.y,
                                           step->body->moving * axis.z, kiriVec3_Dot(turning->u, round),
                                           kiriVec3_Dot(turning->v, round), kiriVec3_Dot(turning->d, round) };
        KIRI_TIMES(n, KIRI_RECOILS) {
            double along = -at->share * own[n], spring = at->spring[e] / at->share * along;
            recoil->pull.data[place + n] += at->pull[e] * along;
            KIRI_TIMES(k, KIRI_RECOILS) {
                recoil->corner.data[count * (place + n) + place + k] -= spring * at->share * own[k];
            }
            KIRI_TIMES(m, frameCount) {
                double* column = &recoil->border.data[all * (place + n) + (int64_t)size * frames[m]];
                const double* row = &J[size * (frameCount * e + m)];
                KIRI_TIMES(k, size) {
                    column[k] += spring * row[k];
                }
            }
        }
    }
}

/* Solves the small symmetric system S z = pull in place, by L L^T. Returns false if it has no factor. */
static bool SolveCorner(kiriRecoil* recoil, int32_t count)
{
    double *S = recoil->corner.data, *z = recoil->pull.data;
    KIRI_TIMES(i, count) {
        KIRI_TIMES(j, i + 1) {
            double sum = S[count * i + j];
            KIRI_TIMES(k, j) {
                sum -= S[count * i + k] * S[count * j + k];
            }
            if (i == j && !(sum > 0.0)) {
                return false;
            }
            S[count * i + j] = i == j ? kiriRoot(sum) : sum / S[count * j + j];
        }
        KIRI_TIMES(k, i) {
            z[i] -= S[count * i + k] * z[k];
        }
        z[i] /= S[count * i + i];
    }
    for (int32_t i = count - 1; i >= 0; --i) {
        KIRI_FROM_TO(k, i + 1, count) {
            z[i] -= S[count * k + i] * z[k];
        }
        z[i] /= S[count * i + i];
    }
    return true;
}

static double Dot(const double* a, const double* b, int64_t count)
{
    double sum = 0.0;
    KIRI_TIMES(n, count) {
        sum += a[n] * b[n];
    }
    return sum;
}

/* With A, B, C the blocks of the frames, of the border and of the obstacles: S = C - B^T A^-1 B. */
bool kiriRecoil_Solve(kiriSolver* solver, int32_t frameCount)
{
    kiriRecoil* recoil = &solver->recoil;
    int32_t count = KIRI_RECOILS * recoil->bodies.count;
    int64_t all = (int64_t)solver->size * frameCount;
    double *right = recoil->right.data, *pulls = right + all;
    kiriMatrix_Solve(solver->matrix, solver->force.data, solver->move.data);
    recoil->promise = 0.0;
    if (count == 0) {
        return true;
    }
    KIRI_ASSERT(all + count <= recoil->right.capacity);
    memcpy(pulls, recoil->pull.data, sizeof(double) * (size_t)count);
    KIRI_TIMES(i, count) {
        recoil->pull.data[i] -= Dot(&recoil->border.data[all * i], solver->move.data, all);
    }
    KIRI_TIMES(j, count) {
        if (recoil->corner.data[(count + 1) * j] == PerTime(solver)) {
            continue; /* nothing touches it along this unknown */
        }
        kiriMatrix_Solve(solver->matrix, &recoil->border.data[all * j], solver->move.data);
        KIRI_FROM_TO(i, j, count) {
            recoil->corner.data[count * i + j] -= Dot(&recoil->border.data[all * i], solver->move.data, all);
        }
    }
    if (!SolveCorner(recoil, count)) {
        return false;
    }
    memcpy(right, solver->force.data, sizeof(double) * (size_t)all);
    KIRI_TIMES(j, count) {
        KIRI_TIMES(n, all) {
            right[n] -= recoil->pull.data[j] * recoil->border.data[all * j + n];
        }
    }
    kiriMatrix_Solve(solver->matrix, right, solver->move.data);
    recoil->promise = 0.5 * Dot(pulls, recoil->pull.data, count);
    EACH_BODY(body, solver) {
        memcpy((*body)->move, &recoil->pull.data[(*body)->place], sizeof((*body)->move));
    }
    return true;
}

void kiriRecoil_Try(const kiriSolver* solver, double part)
{
    EACH_BODY(body, solver) {
        KIRI_TIMES(n, KIRI_RECOILS) {
            (*body)->at[n] = (*body)->from[n] + part * (*body)->move[n];
        }
    }
}

void kiriRecoil_Take(const kiriSolver* solver)
{
    EACH_BODY(body, solver) {
        memcpy((*body)->from, (*body)->at, sizeof((*body)->from));
    }
}
