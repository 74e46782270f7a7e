#include "kiri_solver_work.h"

#define LONGEST_ITERATION_TURN 1.0 /* of a frame in one Gauss-Newton step: a Cayley vector */
#define HALVINGS 12                /* of a step that does not lower the objective */
#define SECOND_CHANCES 4           /* more iterations where energy is gained or the last step was cut short, */
#define FRESH_STARTS 2             /* and iterations from the start of the step should they fail */
#define FREE_SYSTEMS 2             /* of a piece that contacts touch: after them it stores no more than it has */
#define WORTHWHILE 1e-6            /* of the objective, where a longer step would lower it by more */
#define MOST_RISE 100.0            /* of the objective in the first step of a piece */
#define MOST_TAKEN 0.5             /* of the kinetic energy, where a piece need not start anew */
#define TOLERABLE_GAIN 1e-2        /* in a step of second order: of the energy that the limit could take, */
#define NEGLIGIBLE_GAIN 1e-9       /* and of all */

/* ---- One Gauss-Newton step ---- */

/* The line search begins with the whole of the Gauss-Newton step, or as much of it as turns no frame too far. */
static void StartSearch(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->now = piece->isSearching ? piece->sum : piece->now;
        piece->enough = piece->now.objective * (1.0 + KIRI_ROUNDING) + piece->noise;
        piece->scale = LONGEST_ITERATION_TURN;
        piece->promise = 0.0;
    }
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        for (int32_t n = solver->size * f; n < solver->size * (f + 1); ++n) {
            piece->promise += 0.5 * solver->force.data[n] * solver->move.data[n];
        }
        if (!kiriMechanics_IsAffine(&system->mechanics)) {
            kiriFrameRow change = kiriSolver_Expand(solver, 1.0, &solver->move.data[solver->size * f]);
            double turn = kiriVec3_Length(change.by[1]);
            piece->scale = kiriMax(turn, piece->scale);
        }
    }
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].scale = LONGEST_ITERATION_TURN / solver->pieces.data[i].scale;
    }
    kiriSolver_LimitByFriction(solver, system);
}

static void TryStep(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        const kiriPose* pose = &solver->poses.data[f];
        if (!piece->isSearching) {
            continue;
        }
        kiriFrameRow change = kiriSolver_Expand(solver, piece->scale, &solver->move.data[solver->size * f]);
        kiriMat3 columns = { change.by[1], change.by[2], change.by[3] };
        solver->trial.data[f].x = kiriVec3_Add(pose->x, change.by[0]);
        solver->trial.data[f].A = kiriMechanics_IsAffine(&system->mechanics)
                                      ? kiriMat3_Advance(&pose->A, &columns)
                                      : kiriMat3_MulMat(kiriMat3_Cayley(change.by[1]), pose->A);
    }
    solver->isAlong = true;
    kiriObjective_Evaluate(solver, system, solver->trial.data);
    solver->isAlong = false;
}

/* Contact that a step runs into has far more energy than the piece, and a line search by that alone would let links
   stretch by as much. The first systems may do so, as they turn frames; later ones only store what the piece has. */
static bool IsAffordable(const kiriPieceStep* piece)
{
    double most = piece->start.potential + piece->means;
    most = kiriMax(most, piece->now.potential);
    return !piece->isNear || piece->solved < FREE_SYSTEMS || piece->sum.potential <= most;
}

static bool IsGood(const kiriPieceStep* piece)
{
    return piece->isSearching && piece->sum.objective <= piece->enough && IsAffordable(piece);
}

/* Pieces whose step is good enough take it. Returns whether there are others. */
static bool TakeTrial(kiriSolver* solver)
{
    bool isLeft = false;
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (IsGood(piece)) {
            solver->poses.data[f] = solver->trial.data[f];
        }
    }
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        if (IsGood(piece)) {
            piece->now = piece->sum;
            piece->isSearching = false;
        }
        isLeft |= piece->isSearching;
    }
    return isLeft;
}

/* Pieces in their first step that still search may end where the objective is that of the free prediction, or some
   times as large as where they start. */
static void AllowPrediction(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        solver->trial.data[f] = solver->predictions.data[f].pose;
    }
    kiriObjective_Evaluate(solver, system, solver->trial.data);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double rise = MOST_RISE * piece->now.objective, predicted = piece->sum.objective;
        double allowed = kiriMax(predicted, rise) * (1.0 + KIRI_ROUNDING) + piece->noise;
        bool isAllowed = piece->isSearching && piece->isFirst;
        piece->enough = isAllowed && allowed > piece->enough ? allowed : piece->enough;
    }
}

/* One Gauss-Newton step, halved until the objective falls; the first one may also raise it to that of the free
   prediction. False when the matrix has no factor. */
static bool IterateOnce(kiriSolver* solver, const kiriSystem* system)
{
    bool isFirst = false;
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isSearching = solver->pieces.data[i].isIterated;
        isFirst |= solver->pieces.data[i].isIterated && solver->pieces.data[i].isFirst;
    }
    kiriSolver_Assemble(solver, system);
    if (!kiriMatrix_Factor(solver->matrix)) {
        return false;
    }
    kiriMatrix_Solve(solver->matrix, solver->force.data, solver->move.data);
    kiriSolver_MoveContacts(solver, system);
    StartSearch(solver, system);
    TryStep(solver, system);
    bool isLeft = TakeTrial(solver);
    if (isLeft && isFirst) {
        AllowPrediction(solver, system);
        TryStep(solver, system);
        isLeft = TakeTrial(solver);
    }
    for (int halving = 0; isLeft && halving < HALVINGS; ++halving) {
        KIRI_EACH(i, solver->awake.pieces) {
            solver->pieces.data[i].scale *= 0.5;
        }
        TryStep(solver, system);
        isLeft = TakeTrial(solver);
    }
    kiriSolver_ReviewContacts(solver, system);
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isFirst &= !solver->pieces.data[i].isIterated;
    }
    return true;
}

/* ---- The iteration as a whole ---- */

/* A step of second order gains a little energy as often as not, which the limit of energy takes out. Where it is more
   than that the iteration goes on, and if that does not help, the piece takes the step anew by backward Euler. Nothing
   else may decide that: where a piece rests, rounding would. */
static bool IsSuspect(const kiriPieceStep* piece)
{
    double brakeable = kiriPieceStep_MostTaken(piece);
    double all = piece->kinetic + piece->moving + piece->start.potential + piece->now.potential;
    return !piece->stepping.isEuler && !(piece->gain <= TOLERABLE_GAIN * brakeable + NEGLIGIBLE_GAIN * all);
}

/* Pieces go on that gained energy, or whose steps were cut short. Returns whether there are any. */
static bool ChooseUnfinished(kiriSolver* solver, int32_t done)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        bool isShort = piece->scale < KIRI_SHORT_STEP && piece->promise > WORTHWHILE * piece->now.objective;
        bool hasGained = piece->stepping.isEuler && !(piece->gain <= 0.0);
        bool isSuspect = piece->isIterated && IsSuspect(piece);
        piece->isNew = isSuspect && piece->suspect > 1;
        piece->suspect = isSuspect ? piece->suspect + 1 : 0;
        piece->isIterated =
            piece->isIterated && (done < piece->wanted || hasGained || isSuspect || isShort || piece->isUnsettled);
        any |= piece->isIterated;
    }
    return any;
}

/* The pieces that are new, at these poses. */
static void EvaluateStart(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isSearching = solver->pieces.data[i].isNew;
    }
    kiriSolver_GuessContacts(solver, system);
    kiriObjective_Evaluate(solver, system, solver->start.data);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->start = piece->isNew ? piece->sum : piece->start;
        piece->isFirst |= piece->isNew;
        piece->solved = piece->isNew ? 0 : piece->solved;
        piece->isIterated |= piece->isNew;
        piece->isNew = false;
    }
}

/* Pieces whose step was no good begin it again. */
static void TakeAnew(kiriSolver* solver, const kiriSystem* system, int32_t wanted)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->wanted = piece->isNew ? wanted : piece->wanted;
        any |= piece->isNew;
    }
    if (any) {
        kiriSolver_BecomeEuler(solver, system);
        EvaluateStart(solver, system);
    }
}

/* Of the pieces that are left, those go on from which the energy limit would take too much of their motion: by backward
   Euler, and from where they stood before the step. Returns whether there are any. */
static bool RestartPieces(kiriSolver* solver, const kiriSystem* system)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        bool isOver = !(piece->now.objective <= piece->start.objective * (1.0 + KIRI_ROUNDING) + piece->noise);
        double most = (isOver ? MOST_TAKEN : 1.0) * kiriPieceStep_MostTaken(piece);
        piece->isIterated = piece->isNew = piece->isIterated && !(piece->gain <= most);
        any |= piece->isIterated;
    }
    if (any) {
        kiriSolver_BecomeEuler(solver, system);
        EvaluateStart(solver, system);
    }
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->now = piece->isIterated ? piece->start : piece->now;
        piece->solved = piece->isIterated ? FREE_SYSTEMS : piece->solved;
        piece->isFirst = false;
    }
    KIRI_EACH(f, solver->awake.frames) {
        if (kiriSolver_PieceOf(solver, f)->isIterated) {
            solver->poses.data[f] = solver->start.data[f];
        }
    }
    return any;
}

/* The iteration starts from free motion, without forces or with those of the last step: a strip that swings is then
   nearly at the minimum, and one at rest is there. The first Gauss-Newton step may raise the objective: it has to turn
   stiff frames, which stretches links until the next step relaxes them, and a line search would not let it turn them.

   Pieces that have gained energy, or took only a part of their last step, are iterated on. What a piece has gained even
   then is taken out of its velocities. Where that would all but stop it, it starts anew from its pose before the step,
   and its objective only falls from there. Then, with v the velocities before and w those after the step,

   potential after + 1/2 m (w - v)^2  <=  potential before + 1/2 m v^2 + work,

   which bounds w by 2 v. At the minimum it holds with w^2 in place of (w - v)^2, but for parts of the energy that are
   not convex. So velocities stay bounded however long the step. */
int32_t kiriSolver_Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most)
{
    int32_t done = 0, last = iterations + SECOND_CHANCES;
    bool isLeft = true, isFresh = false;
    EvaluateStart(solver, system); /* all pieces are new */
    while (isLeft && done < most && done < last) {
        if (!IterateOnce(solver, system)) {
            return -1;
        }
        ++done;
        solver->solved += 1;
        if (done >= iterations) {
            kiriSolver_FindGains(solver, system);
            isLeft = ChooseUnfinished(solver, done);
        }
        if (isLeft && !isFresh && (done == last || done == most)) {
            isLeft = RestartPieces(solver, system);
            kiriSolver_FindGains(solver, system);
            isFresh = true;
            last += FRESH_STARTS;
        } else if (isLeft && done < most && done < last) {
            TakeAnew(solver, system, done + iterations);
        }
    }
    KIRI_ASSERT(done <= iterations + KIRI_EXTRA_SYSTEMS);
    kiriSolver_HoldContacts(solver, system);
    return done;
}
