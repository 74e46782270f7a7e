#include "kiri_motion_check.h"
#include "kiri_solver.h"
#include "../field/kiri_field_save.h"

#include <math.h>

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust HistoryMust[] = {
    KIRI_REALS(kiriHistory, dt, dt),
    KIRI_WITHIN(0, 1, kiriHistory, isHalf, isHeld),
    KIRI_REALS(kiriHistory, gain, turnPull),
};

static const kiriMust FrameMust[] = {
    KIRI_REALS(kiriFrameData, site.at, site.at),
    KIRI_REALS(kiriFrameData, center, support),
    KIRI_PART_MUST(kiriFrameData, history, kiriHistory, HistoryMust),
    KIRI_WITHIN(0, 1, kiriFrameData, held, held),
    KIRI_REALS(kiriFrameData, reaction, bore),
};

static const kiriMust FrameShareMust[] = {
    KIRI_INDEX(KIRI_OF_FRAMES, kiriFrameShare, frame, frame),
};

static const kiriMust AreaElementMust[] = {
    KIRI_REALS(kiriAreaElement, area, lean),
    KIRI_WITHIN(0, KIRI_AREA_STRAINS, kiriAreaElement, firstRow, lastRow),
};

static const kiriMust AreaElementsMust[] = {
    KIRI_ITEMS_MUST(kiriAreaElements, elements, AreaElementMust),
    KIRI_ITEMS_MUST(kiriAreaElements, shares, FrameShareMust),
};

static const kiriMust MechanicsMust[] = {
    KIRI_WITHIN(KIRI_MODEL_LINKS, KIRI_MODEL_POINTS, kiriMechanics, model, model),
    KIRI_REALS(kiriMechanics, axes, axes),
    KIRI_WITHIN(KIRI_TIME_STEPPING_SECOND_ORDER, KIRI_TIME_STEPPING_EULER, kiriMechanics, timeStepping, timeStepping),
};

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

bool kiriMechanics_Check(const kiriMechanics* mechanics, kiriCheck* check)
{
    return kiriCheck_Object(check, MechanicsMust, mechanics);
}

/* But for rounding. */
static bool IsSiteIn(const kiriFrameData* frame, const kiriMeshData* mesh, int32_t square)
{
    double half = 0.5 * mesh->squares.side, most = 1.02 * half * mesh->step;
    kiriLatticePoint corner = kiriSquares_Corner(&mesh->squares, square);
    kiriVec2 middle = kiriVec2_Make(mesh->step * (corner.x + half), mesh->step * (corner.y + half));
    return fabs(frame->site.at.x - middle.x) <= most && fabs(frame->site.at.y - middle.y) <= most;
}

/* The anchor is where there is material, and the site is in its square. */
bool kiriFrame_Check(const kiriFrameData* frame, kiriCheck* check, const kiriMeshData* mesh)
{
    int32_t square =
        frame->anchor.x < 0 || frame->anchor.y < 0 ? KIRI_NONE : kiriSquares_At(&mesh->squares, frame->anchor);
    return kiriCheck_Object(check, FrameMust, frame) &&
           kiriCheck_That(check, square != KIRI_NONE && mesh->squares.head[square] != KIRI_NONE &&
                                     ((frame->anchor.x | frame->anchor.y) & 1) == 0 && frame->mass > 0.0 &&
                                     frame->area > 0.0 && kiriFrame_FitsFloats(frame) && IsSiteIn(frame, mesh, square));
}

bool kiriAreaElements_Check(const kiriAreaElements* elements, kiriCheck* check)
{
    int64_t next = 0;
    bool areFine = kiriCheck_Object(check, AreaElementsMust, elements);
    for (int32_t k = 0; areFine && k < elements->elements.count; ++k) {
        const kiriAreaElement* element = &elements->elements.data[k];
        areFine = element->first == next && element->count > 0 && element->firstRow < element->lastRow;
        next += element->count;
        areFine = areFine && next <= elements->shares.count;
    }
    return kiriCheck_That(check, areFine && next == elements->shares.count);
}

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

static const kiriMember HistoryMembers[] = {
    KIRI_RUN(8, kiriHistory, dt, dt),
    KIRI_RUN(4, kiriHistory, isHalf, isHeld),
    KIRI_RUN(8, kiriHistory, gain, turnPull),
};
static const kiriTable HistoryTable = KIRI_TABLE(kiriHistory, HistoryMembers);

static const kiriMember FrameDataMembers[] = {
    KIRI_RUN(4, kiriFrameData, id, id),
    KIRI_RUN(8, kiriFrameData, pieceData, pieceData),
    KIRI_PART(kiriFrameData, site, kiriSiteTable),
    KIRI_RUN(4, kiriFrameData, anchor, anchor),
    KIRI_RUN(8, kiriFrameData, center, support),
    KIRI_DROPPED(kiriFrameData, gained),
    KIRI_DROPPED(kiriFrameData, passed),
    KIRI_DROPPED(kiriFrameData, received),
    KIRI_PART(kiriFrameData, history, HistoryTable),
    KIRI_RUN(4, kiriFrameData, held, held),
    KIRI_RUN(8, kiriFrameData, heldPosition, heldOff),
    KIRI_BOOLS(kiriFrameData, isOffKnown, isOffKnown),
    KIRI_RUN(8, kiriFrameData, reaction, bore),
};
const kiriTable kiriFrameTable = KIRI_TABLE(kiriFrameData, FrameDataMembers);

static const kiriMember AreaElementMembers[] = {
    KIRI_RUN(8, kiriAreaElement, area, lean),
    KIRI_RUN(4, kiriAreaElement, first, lastRow),
};
static const kiriTable AreaElementTable = KIRI_TABLE(kiriAreaElement, AreaElementMembers);

static const kiriMember FrameShareMembers[] = {
    KIRI_RUN(4, kiriFrameShare, frame, frame),
    KIRI_RUN(8, kiriFrameShare, move, slope),
};
static const kiriTable FrameShareTable = KIRI_TABLE(kiriFrameShare, FrameShareMembers);

static const kiriMember AreaElementsMembers[] = {
    KIRI_PARTS(kiriAreaElements, elements, AreaElementTable),
    KIRI_PARTS(kiriAreaElements, shares, FrameShareTable),
};
const kiriTable kiriAreaElementsTable = KIRI_TABLE(kiriAreaElements, AreaElementsMembers);

static const kiriMember StrainOffsetsMembers[] = {
    KIRI_ITEMS(8, kiriStrainOffsets, strainOffsets), KIRI_ROOM_OF(kiriStrainOffsets, older),
    KIRI_ROOM_OF(kiriStrainOffsets, from),           KIRI_ROOM_OF(kiriStrainOffsets, frames),
    KIRI_ROOM_OF(kiriStrainOffsets, mayMove),
};
const kiriTable kiriStrainOffsetsTable = KIRI_TABLE(kiriStrainOffsets, StrainOffsetsMembers);

static const kiriMember TransferMembers[] = {
    KIRI_RUN(4, kiriTransfer, from, next),
    KIRI_RUN(8, kiriTransfer, material, material),
};
static const kiriTable TransferTable = KIRI_TABLE(kiriTransfer, TransferMembers);

static const kiriMember OwnershipMembers[] = {
    KIRI_ITEMS(4, kiriOwnership, squares),
    KIRI_ITEMS(4, kiriOwnership, triangleOwners),
    KIRI_RUN(4, kiriOwnership, spans, triangleCount),
    KIRI_ITEMS(4, kiriOwnership, dirty),
    KIRI_ITEMS(1, kiriOwnership, isDirty),
    KIRI_RUN(4, kiriOwnership, next, next),
    KIRI_RUN(8, kiriOwnership, due, due),
    KIRI_ITEMS(4, kiriOwnership, staged),
    KIRI_PARTS(kiriOwnership, transfers, TransferTable),
    KIRI_ITEMS(4, kiriOwnership, first),
};
static const kiriTable OwnershipTable = KIRI_TABLE(kiriOwnership, OwnershipMembers);

static const kiriMember RefitMembers[] = {
    KIRI_PART(kiriRefit, ownership, OwnershipTable),
    KIRI_ROOM_OF(kiriRefit, fits),
    KIRI_RUN(4, kiriRefit, most, most),
    KIRI_ROOM_OF(kiriRefit, bodies),
};
const kiriTable kiriRefitTable = KIRI_TABLE(kiriRefit, RefitMembers);

static const kiriMember MechanicsMembers[] = {
    KIRI_RUN(4, kiriMechanics, model, model),
    KIRI_BOOLS(kiriMechanics, planar, planar),
    KIRI_RUN(8, kiriMechanics, axes, axes),
    KIRI_RUN(4, kiriMechanics, timeStepping, timeStepping),
};
const kiriTable kiriMechanicsTable = KIRI_TABLE(kiriMechanics, MechanicsMembers);
