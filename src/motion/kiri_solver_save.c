#include "kiri_motion_save.h"
#include "kiri_solver_work.h"

static const kiriMember AwakeMembers[] = {
    KIRI_ITEMS(1, kiriAwake, isAwake), KIRI_BOOLS(kiriAwake, isListed, isListed), KIRI_ITEMS(4, kiriAwake, pieces),
    KIRI_ITEMS(4, kiriAwake, frames),  KIRI_ITEMS(4, kiriAwake, elements),        KIRI_RUN(8, kiriAwake, lists, wakes),
};
static const kiriTable AwakeTable = KIRI_TABLE(kiriAwake, AwakeMembers);

/* Between ticks nothing is staged, and no step is at hand. */
static const kiriMember SolverMembers[] = {
    KIRI_DROPPED(kiriSolver, memory),
    KIRI_DROPPED(kiriSolver, mechanics),
    KIRI_RUN(8, kiriSolver, dt, damping),
    KIRI_BOOLS(kiriSolver, isAlong, isHeld),
    KIRI_RUN(4, kiriSolver, solved, solved),
    KIRI_DROPPED(kiriSolver, size),
    KIRI_DROPPED(kiriSolver, unknowns),
    KIRI_DROPPED(kiriSolver, matrix),
    KIRI_DROPPED(kiriSolver, nextMatrix),
    KIRI_ROOM_OF(kiriSolver, framePiece),
    KIRI_ROOM_OF(kiriSolver, nextFramePiece),
    KIRI_RUN(4, kiriSolver, pieceCount, pieceCount),
    KIRI_DROPPED(kiriSolver, nextPieceCount),
    KIRI_RUN(4, kiriSolver, frameCount, frameCount),
    KIRI_DROPPED(kiriSolver, nextFrameCount),
    KIRI_RUN(4, kiriSolver, elementCount, elementCount),
    KIRI_DROPPED(kiriSolver, nextElementCount),
    KIRI_PART(kiriSolver, awake, AwakeTable),
    KIRI_DROPPED(kiriSolver, isStaged),
    KIRI_DROPPED(kiriSolver, isNextMatrix),
    KIRI_DROPPED(kiriSolver, pairs),
    KIRI_ROOM_OF(kiriSolver, pieces),
    KIRI_ROOM_OF(kiriSolver, momenta),
    KIRI_ROOM_OF(kiriSolver, contacts),
    KIRI_ROOM_OF(kiriSolver, before),
    KIRI_ROOM_OF(kiriSolver, after),
    KIRI_ROOM_OF(kiriSolver, predictions),
    KIRI_ROOM_OF(kiriSolver, start),
    KIRI_ROOM_OF(kiriSolver, poses),
    KIRI_ROOM_OF(kiriSolver, trial),
    KIRI_ROOM_OF(kiriSolver, stiffness),
    KIRI_ROOM_OF(kiriSolver, loss),
    KIRI_ROOM_OF(kiriSolver, startStrain),
    KIRI_ROOM_OF(kiriSolver, nowStrain),
    KIRI_ROOM_OF(kiriSolver, tracedRows),
    KIRI_ROOM_OF(kiriSolver, force),
    KIRI_ROOM_OF(kiriSolver, move),
    KIRI_ROOM_OF(kiriSolver, stopping),
    KIRI_ROOM_OF(kiriSolver, members),
    KIRI_ROOM_OF(kiriSolver, rows),
    KIRI_ROOM_OF(kiriSolver, J),
};
static const kiriTable SolverTable = KIRI_TABLE(kiriSolver, SolverMembers);

/* Ascending: so there are no more than `count`. */
static bool AreBelow(const kiriIndices* indices, int32_t count)
{
    bool areBelow = true;
    for (int32_t k = 0; k < indices->count; ++k) {
        areBelow &= indices->data[k] > (k > 0 ? indices->data[k - 1] : KIRI_NONE) && indices->data[k] < count;
    }
    return areBelow;
}

/* Lists that were not made since others woke are of nothing. */
static bool AreLists(const kiriSolver* solver)
{
    const kiriAwake* awake = &solver->awake;
    return !awake->isListed ||
           (AreBelow(&awake->pieces, solver->pieceCount) && AreBelow(&awake->frames, solver->frameCount) &&
            AreBelow(&awake->elements, solver->elementCount));
}

/* They may grow for ever. */
static bool AreCountsOfAwake(const kiriAwake* awake)
{
    const int64_t most = INT64_C(1) << 56;
    return awake->lists >= 0 && awake->lists < most && awake->wakes >= 0 && awake->wakes < most;
}

enum { MOST_SOLVED = INT32_MAX / 2 }; /* in a tick */

static bool IsSolver(const kiriSolver* solver)
{
    bool isFine = solver->solved >= 0 && solver->solved <= MOST_SOLVED &&
                  solver->frameCount == kiriMatrix_FrameCount(solver->matrix) && solver->pieceCount >= 0 &&
                  solver->awake.isAwake.count == solver->pieceCount && AreLists(solver) &&
                  AreCountsOfAwake(&solver->awake);
    for (int32_t f = 0; isFine && f < solver->frameCount; ++f) {
        isFine = solver->framePiece.data[f] >= 0 && solver->framePiece.data[f] < solver->pieceCount;
    }
    return isFine;
}

void kiriSolver_Archive(kiriArchive* archive, kiriSolver** made, const kiriMechanics* mechanics)
{
    if (kiriArchive_Reads(archive)) {
        *made = kiriArchive_HasFailed(archive) ? NULL : kiriSolver_Create(archive->memory, mechanics);
        archive->isShort |= *made == NULL && !archive->isBad;
    }
    kiriSolver* solver = *made;
    if (solver == NULL) {
        return;
    }
    kiriArchive_Object(archive, &SolverTable, solver);
    kiriArchive_Expect(archive, solver->frameCount >= 0 && solver->frameCount <= solver->framePiece.capacity);
    if (kiriArchive_HasFailed(archive)) {
        return;
    }
    kiriArchive_Numbers(archive, solver->framePiece.data, 4, solver->frameCount);
    kiriMatrix_Archive(archive, solver->matrix);
    kiriArchive_Expect(archive, IsSolver(solver));
    if (kiriArchive_Reads(archive) && !kiriArchive_HasFailed(archive) && solver->awake.isListed) {
        kiriMatrix_Choose(solver->matrix, solver->awake.frames.data, solver->awake.frames.count);
    }
}
