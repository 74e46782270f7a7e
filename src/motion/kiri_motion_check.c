#include "kiri_motion_check.h"
#include "../field/kiri_field_save.h"
#include "kiri_solver.h"

#include <math.h>

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

KIRI_SHARED_TABLE(kiriMechanicsTable, kiriMechanics, {
    KIRI_WITHIN(KIRI_MODEL_LINKS, KIRI_MODEL_POINTS, model),
    KIRI_BOOLS(planar),
    KIRI_REALS(axes),
    KIRI_WITHIN(KIRI_TIME_STEPPING_SECOND_ORDER, KIRI_TIME_STEPPING_EULER, timeStepping),
})

KIRI_TABLE(HistoryTable, kiriHistory, {
    KIRI_REALS(dt, credit),
    KIRI_WITHIN(0, 1, isHalf, isHeld),
    KIRI_REALS(gain, turnPull),
})

KIRI_SHARED_TABLE(kiriFrameTable, kiriFrameData, {
    KIRI_PART(site, kiriSiteTable),
    KIRI_RUN(4, anchor),
    KIRI_REALS(center, torque),
    KIRI_PART(history, HistoryTable),
    KIRI_WITHIN(0, 1, held),
    KIRI_REALS(heldPosition, bore),
    KIRI_UNHASHED,
    KIRI_RUN(4, id),
    KIRI_RUN(8, pieceData),
})

KIRI_TABLE(AreaElementTable, kiriAreaElement, {
    KIRI_REALS(area, lean),
    KIRI_RUN(4, first, count),
    KIRI_WITHIN(0, KIRI_AREA_STRAINS, firstRow, lastRow),
})

KIRI_TABLE(FrameShareTable, kiriFrameShare, {
    KIRI_INDEX(KIRI_OF_FRAMES, frame),
    KIRI_RUN(8, move, slope),
})

KIRI_SHARED_TABLE(kiriAreaElementsTable, kiriAreaElements, {
    KIRI_PARTS(elements, AreaElementTable),
    KIRI_PARTS(shares, FrameShareTable),
})

KIRI_TABLE(StrainOffsetTable, kiriStrainOffset, {
    KIRI_REALS(strain)
})

KIRI_SHARED_TABLE(kiriStrainOffsetsTable, kiriStrainOffsets, {
    KIRI_PARTS(strainOffsets, StrainOffsetTable),
    KIRI_ROOMS(older, from, frames, mayMove),
})

KIRI_SHARED_TABLE(kiriPlasticTable, kiriPlastic, {
    KIRI_REALS(part, reach),
})

KIRI_SHARED_TABLE(kiriPlasticsTable, kiriPlastics, {
    KIRI_BOOLS(isKept),
    KIRI_PARTS(links, kiriPlasticTable),
    KIRI_ROOMS(next, regions),
})

KIRI_TABLE(OwnershipTable, kiriOwnership, {
    KIRI_DERIVED,
    KIRI_ARRAYS(squares, triangleOwners, dirty, isDirty, staged, transfers, first),
})

KIRI_SHARED_TABLE(kiriRefitTable, kiriRefit, {
    KIRI_DERIVED,
    KIRI_PART(ownership, OwnershipTable),
    KIRI_ROOMS(fits, bodies),
})

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

bool kiriFrame_IsSound(const kiriFrameData* frame, const kiriMeshData* mesh)
{
    bool isOnLattice = frame->anchor.x >= 0 && frame->anchor.y >= 0 && ((frame->anchor.x | frame->anchor.y) & 1) == 0;
    int32_t square = isOnLattice ? kiriSquares_At(&mesh->squares, frame->anchor) : KIRI_NONE;
    if (square == KIRI_NONE || mesh->squares.head[square] == KIRI_NONE || !(frame->mass > 0.0 && frame->area > 0.0)) {
        return false;
    }
    double half = 0.5 * mesh->squares.side, most = 1.02 * half * mesh->step; /* the site is rounded */
    kiriLatticePoint corner = kiriSquares_Corner(&mesh->squares, square);
    return kiriFrame_FitsFloats(frame) && fabs(frame->site.at.x - mesh->step * (corner.x + half)) <= most &&
           fabs(frame->site.at.y - mesh->step * (corner.y + half)) <= most;
}

bool kiriAreaElements_AreSound(const kiriAreaElements* elements)
{
    int64_t next = 0;
    bool areFine = true;
    KIRI_EACH_WHILE(areFine, const kiriAreaElement, element, elements->elements) {
        areFine = element->first == next && element->count > 0 && element->firstRow < element->lastRow;
        next += element->count;
        areFine = areFine && next <= elements->shares.count;
    }
    return areFine && next == elements->shares.count;
}

/* ---- The solver -------------------------------------------------------------------------------------------------- */

/* Reads the bodies that frames are of, and makes them without elements. Bodies are numbered by their lowest frame. */
static void ReadBodies(kiriArchive* archive, kiriSolver* solver, int32_t frameCount, int32_t bodyCount)
{
    kiriIndices bodyOf = { 0 };
    if (!kiriArray_Resize(solver->memory, &bodyOf, frameCount)) {
        archive->isShort = true;
        return;
    }
    int32_t bodies = 0;
    kiriArchive_Numbers(archive, bodyOf.data, 4, frameCount);
    KIRI_TIMES_WHILE(!kiriArchive_HasFailed(archive), f, frameCount) {
        kiriArchive_Expect(archive, bodyOf.data[f] >= 0 && bodyOf.data[f] <= bodies);
        bodies += bodyOf.data[f] == bodies;
    }
    kiriArchive_Expect(archive, bodies == bodyCount);
    if (!kiriArchive_HasFailed(archive)) {
        archive->isShort |= !kiriSolver_MakeBodies(solver, bodyOf.data, frameCount, bodyCount);
    }
    kiriArray_Release(solver->memory, &bodyOf);
}

enum { BYTES_A_BODY = 1024 }; /* of memory, with its matrix */

/* Stores the patterns of bodies and the version of the lists. kiriStage_Solver derives the rest. */
void kiriSolver_Archive(kiriArchive* archive, kiriSolver** made, const kiriMechanics* mechanics)
{
    bool reads = kiriArchive_Reads(archive);
    if (reads) {
        *made = kiriArchive_HasFailed(archive) ? NULL : kiriSolver_Create(archive->memory, mechanics);
        archive->isShort |= *made == NULL && !archive->isBad;
    }
    kiriSolver* solver = *made;
    if (solver == NULL) {
        return;
    }
    const int64_t mostVersions = INT64_C(1) << 56; /* it may grow for ever */
    kiriArchive_Numbers(archive, &solver->moved.version, 8, 1);
    kiriArchive_Expect(archive, solver->moved.version >= 0 && solver->moved.version < mostVersions);
    int64_t most = reads ? archive->room / 256 : INT32_MAX;
    int32_t frames = kiriArchive_Count(archive, solver->bodies.bodyOf.count, 1, most);
    int32_t bodies = kiriArchive_Count(archive, solver->bodies.bodies.count, 1, frames);
    archive->room -= reads ? BYTES_A_BODY * bodies : 0;
    kiriArchive_Expect(archive, archive->room >= 0);
    if (reads && !kiriArchive_HasFailed(archive)) {
        ReadBodies(archive, solver, frames, bodies);
    } else if (!reads) {
        kiriArchive_Numbers(archive, solver->bodies.bodyOf.data, 4, frames);
    }
    KIRI_TIMES_WHILE(!kiriArchive_HasFailed(archive), b, bodies) {
        kiriSolverBody* body = &solver->bodies.bodies.data[b];
        kiriMatrix_Archive(archive, body->matrix);
        kiriArchive_Expect(archive, body->matrix->count == body->frames.count);
    }
}
