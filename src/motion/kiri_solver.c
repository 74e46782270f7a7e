#include "kiri_solver_work.h"

/* ---- Unknowns --------------------------------------------------------------------------------------------------- */

static void ChooseUnknowns(kiriSolver* solver, const kiriMechanics* mechanics)
{
    const kiriVec3 space[3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    const kiriVec3 plane[3] = { mechanics->axes.u, mechanics->axes.v, mechanics->axes.d };
    bool affine = kiriMechanics_IsAffine(mechanics), planar = mechanics->planar;
    int vectors = !affine ? 2 : planar ? 3 : 4;
    solver->size = 0;
    for (int vector = 0; vector < vectors; ++vector) {
        for (int axis = 0; axis < 3; ++axis) {
            /* In the plane, a rigid frame turns about the normal; nothing else leaves along it. */
            bool turns = !affine && vector == 1;
            if (!planar || (axis == 2) == turns) {
                kiriUnknown unknown = { vector, axis, planar ? plane[axis] : space[axis] };
                solver->unknowns[solver->size++] = unknown;
            }
        }
    }
}

void kiriSolver_Reduce(const kiriSolver* solver, const kiriFrameRow* row, double* values)
{
    if (!solver->mechanics.planar) {
        memcpy(values, row->by, sizeof(double) * (size_t)solver->size); /* the axes of space */
        return;
    }
    for (int32_t n = 0; n < solver->size; ++n) {
        values[n] = kiriVec3_Dot(row->by[solver->unknowns[n].vector], solver->unknowns[n].axis);
    }
}

kiriFrameRow kiriSolver_Expand(const kiriSolver* solver, double scale, const double* values)
{
    kiriFrameRow vectors;
    memset(&vectors, 0, sizeof(vectors));
    if (!solver->mechanics.planar) {
        for (int32_t n = 0; n < solver->size; n += 3) {
            vectors.by[n / 3] = kiriVec3_Make(scale * values[n], scale * values[n + 1], scale * values[n + 2]);
        }
        return vectors;
    }
    for (int32_t n = 0; n < solver->size; ++n) {
        kiriVec3* by = &vectors.by[solver->unknowns[n].vector];
        *by = kiriVec3_AddScaled(*by, scale * values[n], solver->unknowns[n].axis);
    }
    return vectors;
}

/* ---- Creation ---------------------------------------------------------------------------------------------------- */

kiriSolver* kiriSolver_Create(kiriMemory* memory, const kiriMechanics* mechanics)
{
    kiriSolver* solver = kiriMemory_AllocZeroed(memory, sizeof(kiriSolver));
    if (solver == NULL) {
        return NULL;
    }
    solver->memory = memory;
    solver->mechanics = *mechanics;
    ChooseUnknowns(solver, mechanics);
    solver->matrix = kiriMatrix_Create(memory, solver->size);
    solver->nextMatrix = kiriMatrix_Create(memory, solver->size);
    return solver->matrix != NULL && solver->nextMatrix != NULL ? solver : NULL;
}

/* ---- Staging ---------------------------------------------------------------------------------------------------- */

enum { SOLVER_ROOMS = 24 };

/* Only scratch, so that nothing is lost by growing. Returns how many. */
static int32_t ListSolverRooms(kiriSolver* s, const kiriSystem* next, kiriRoom rooms[SOLVER_ROOMS])
{
    kiriMemory* memory = s->memory;
    int64_t frames = next->frameCount, elements = kiriElement_Count(next), most = kiriElement_MostMembers(next);
    bool hasTraces = kiriElement_CornerCount(next) > 0 && !kiriMechanics_IsAffine(&next->mechanics);
    int64_t traced = hasTraces ? kiriElement_LinkCount(next) : 0, strains = KIRI_MOST_STRAINS * elements;
    int64_t unknowns = s->size * frames, rows = KIRI_MOST_STRAINS * most;
    const kiriRoom all[] = { KIRI_ROOM(memory, &s->nextFramePiece, frames),
                             KIRI_ROOM(memory, &s->awake.isAwake, frames),
                             KIRI_ROOM(memory, &s->awake.pieces, frames),
                             KIRI_ROOM(memory, &s->awake.frames, frames),
                             KIRI_ROOM(memory, &s->awake.elements, elements),
                             KIRI_ROOM(memory, &s->pieces, frames),
                             KIRI_ROOM(memory, &s->momenta, frames),
                             KIRI_ROOM(memory, &s->before, frames),
                             KIRI_ROOM(memory, &s->after, frames),
                             KIRI_ROOM(memory, &s->predictions, frames),
                             KIRI_ROOM(memory, &s->start, frames),
                             KIRI_ROOM(memory, &s->poses, frames),
                             KIRI_ROOM(memory, &s->trial, frames),
                             KIRI_ROOM(memory, &s->stiffness, strains),
                             KIRI_ROOM(memory, &s->loss, strains),
                             KIRI_ROOM(memory, &s->startStrain, strains),
                             KIRI_ROOM(memory, &s->nowStrain, strains),
                             KIRI_ROOM(memory, &s->tracedRows, traced * KIRI_TRACED * 2 * s->size),
                             KIRI_ROOM(memory, &s->stopping, elements),
                             KIRI_ROOM(memory, &s->force, unknowns),
                             KIRI_ROOM(memory, &s->move, unknowns),
                             KIRI_ROOM(memory, &s->members, most),
                             KIRI_ROOM(memory, &s->rows, rows),
                             KIRI_ROOM(memory, &s->J, rows * s->size) };
    memcpy(rooms, all, sizeof(all));
    return (int32_t)(sizeof(all) / sizeof(all[0]));
}

kiriProgress kiriSolver_Reserve(kiriSolver* solver, const kiriSystem* next, kiriQuota* quota, int64_t bytesAnItem)
{
    kiriRoom rooms[SOLVER_ROOMS];
    int32_t count = ListSolverRooms(solver, next, rooms);
    return kiriRooms_MakeReady(rooms, count, quota, bytesAnItem);
}

/* Is the pair one of a corner that a link of it has already? */
static bool IsPairOfLink(const kiriSystem* system, int32_t k, kiriPair pair)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    bool found = false;
    for (int32_t n = 0; corner != NULL && n < corner->count; ++n) {
        const kiriLink* link = &system->links[corner->link[n]];
        found |= link->i == pair.a && link->j == pair.b;
    }
    return found;
}

/* Is the element one of those in force? */
static bool IsInForce(const kiriSystem* system, int32_t k)
{
    int32_t links = kiriElement_LinkCount(system), corner = k - links;
    return k < links                                  ? system->linkWas[k] != KIRI_NONE
           : corner < kiriElement_CornerCount(system) ? system->cornerWas[corner] != KIRI_NONE
                                                      : false;
}

/* Of frames that share an element: of all, or of those alone that are not in force. */
static bool CollectPairs(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece, bool all)
{
    solver->pairs.count = 0;
    for (int32_t k = 0; k < kiriElement_Count(next); ++k) {
        if (!all && IsInForce(next, k)) {
            continue;
        }
        int32_t* members = solver->members.data;
        int32_t count = kiriElement_Members(next, k, members);
        for (int32_t b = 1; b < count; ++b) {
            if (framePiece[members[b]] != framePiece[members[0]]) {
                return false; /* of bytes that were made up */
            }
            for (int32_t a = 0; a < b; ++a) {
                kiriPair pair = { members[a], members[b] };
                if (!IsPairOfLink(next, k, pair) && !kiriArray_Push(solver->memory, &solver->pairs, pair)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* Has the current pattern a block for every pair? */
static bool IsCovered(const kiriSolver* solver, int32_t frameCount)
{
    bool covered = kiriMatrix_FrameCount(solver->matrix) == frameCount;
    for (int32_t k = 0; covered && k < solver->pairs.count; ++k) {
        covered = kiriMatrix_Covers(solver->matrix, solver->pairs.data[k]);
    }
    return covered;
}

/* Regions that came apart may meet again when a cut moves sites: a new pattern keeps the pairs of the old one, unless
   they are too many. */
static bool KeepPairs(kiriSolver* solver, int32_t frameCount)
{
    int32_t own = solver->pairs.count, old = kiriMatrix_PairCount(solver->matrix);
    if (kiriMatrix_FrameCount(solver->matrix) != frameCount || old > 2 * own) {
        return true;
    }
    if (!kiriArray_Resize(solver->memory, &solver->pairs, (int64_t)own + old)) {
        return false;
    }
    if (old > 0) {
        kiriMatrix_GetPairs(solver->matrix, &solver->pairs.data[own]);
    }
    return true;
}

/* Gives the system a pattern. That in force covers what is in force: so most cuts ask for a few elements alone, and the
   others are looked at where it will not do. */
static bool StageMatrix(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece)
{
    bool isKnown = next->linkWas != NULL && kiriMatrix_FrameCount(solver->matrix) == next->frameCount;
    if (!CollectPairs(solver, next, framePiece, !isKnown)) {
        return false;
    }
    solver->isNextMatrix = !IsCovered(solver, next->frameCount);
    if (!solver->isNextMatrix) {
        return true;
    }
    return (!isKnown || CollectPairs(solver, next, framePiece, true)) && KeepPairs(solver, next->frameCount) &&
           kiriMatrix_Shape(solver->nextMatrix, next->frameCount, solver->pairs.data, solver->pairs.count);
}

bool kiriSolver_Stage(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece, int32_t pieceCount)
{
    int32_t frameCount = next->frameCount;
    KIRI_ASSERT(frameCount >= 0 && next->linkCount >= 0 && pieceCount >= 0 && pieceCount <= frameCount);
    KIRI_ASSERT(next->mechanics.model == solver->mechanics.model);
    solver->isStaged = false;
    solver->nextElementCount = kiriElement_Count(next);
    kiriQuota unlimited = { INT64_MAX, 0, 0, false };
    if (kiriSolver_Reserve(solver, next, &unlimited, 1) != KIRI_DONE || !StageMatrix(solver, next, framePiece)) {
        return false;
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        KIRI_ASSERT(framePiece[f] >= 0 && framePiece[f] < pieceCount);
        solver->nextFramePiece.data[f] = framePiece[f];
    }
    solver->nextFrameCount = frameCount;
    solver->nextPieceCount = pieceCount;
    solver->isStaged = true;
    return true;
}

/* What steps write into. */
static bool HasRoomForSteps(const kiriSolver* solver, const kiriSystem* system)
{
    int64_t frames = system->frameCount, elements = kiriElement_Count(system), most = kiriElement_MostMembers(system);
    bool hasTraces = kiriElement_CornerCount(system) > 0 && !kiriMechanics_IsAffine(&system->mechanics);
    int64_t traced = hasTraces ? kiriElement_LinkCount(system) : 0, strains = KIRI_MOST_STRAINS * elements;
    const kiriAwake* awake = &solver->awake;
    return awake->isAwake.capacity >= solver->pieceCount && awake->pieces.capacity >= frames &&
           awake->frames.capacity >= frames && awake->elements.capacity >= elements &&
           solver->pieces.capacity >= frames && solver->momenta.capacity >= frames &&
           solver->before.capacity >= frames && solver->after.capacity >= frames &&
           solver->predictions.capacity >= frames && solver->start.capacity >= frames &&
           solver->poses.capacity >= frames && solver->trial.capacity >= frames &&
           solver->stiffness.capacity >= strains && solver->loss.capacity >= strains &&
           solver->startStrain.capacity >= strains && solver->nowStrain.capacity >= strains &&
           solver->tracedRows.capacity >= traced * KIRI_TRACED * 2 * solver->size &&
           solver->stopping.capacity >= elements && solver->force.capacity >= solver->size * frames &&
           solver->move.capacity >= solver->size * frames && solver->members.capacity >= most &&
           solver->rows.capacity >= KIRI_MOST_STRAINS * most &&
           solver->J.capacity >= KIRI_MOST_STRAINS * most * solver->size;
}

/* As CollectPairs, but nothing is kept: of bytes that were made up there may be more pairs than memory has room for. */
static bool AreFramesCovered(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    int32_t *members = solver->members.data, count = kiriElement_Members(system, k, members);
    bool areCovered = true;
    for (int32_t b = 1; areCovered && b < count; ++b) {
        for (int32_t a = 0; areCovered && a < b; ++a) {
            kiriPair pair = { members[a], members[b] };
            areCovered = IsPairOfLink(system, k, pair) || kiriMatrix_Covers(solver->matrix, pair);
        }
    }
    return areCovered;
}

bool kiriSolver_Fits(const kiriSolver* solver, const kiriSystem* system, const int32_t* framePiece, int32_t pieceCount)
{
    bool fits = solver->frameCount == system->frameCount && solver->pieceCount == pieceCount &&
                solver->elementCount == kiriElement_Count(system) &&
                kiriMatrix_FrameCount(solver->matrix) == solver->frameCount;
    for (int32_t f = 0; fits && f < system->frameCount; ++f) {
        fits = solver->framePiece.data[f] == framePiece[f];
    }
    fits = fits && HasRoomForSteps(solver, system);
    for (int32_t k = 0; fits && k < solver->elementCount; ++k) {
        fits = AreFramesCovered(solver, system, k);
    }
    return fits;
}

void kiriSolver_Commit(kiriSolver* solver)
{
    if (!solver->isStaged) {
        return;
    }
    kiriIndices framePiece = solver->framePiece;
    solver->framePiece = solver->nextFramePiece;
    solver->nextFramePiece = framePiece;
    solver->frameCount = solver->nextFrameCount;
    solver->elementCount = solver->nextElementCount;
    solver->pieceCount = solver->nextPieceCount;
    if (solver->isNextMatrix) {
        kiriMatrix* matrix = solver->matrix;
        solver->matrix = solver->nextMatrix;
        solver->nextMatrix = matrix;
    }
    solver->isStaged = false;
    kiriAwake_Start(&solver->awake, solver->pieceCount);
    KIRI_ASSERT(kiriMatrix_FrameCount(solver->matrix) == solver->frameCount);
}

/* ---- What is awake ---- */

void kiriSolver_SetAwake(kiriSolver* solver, int32_t piece, bool isAwake)
{
    kiriAwake_Set(&solver->awake, piece, isAwake);
}

static void WriteLists(kiriSolver* solver, const kiriSystem* system)
{
    kiriAwake* awake = &solver->awake;
    const uint8_t* isAwake = awake->isAwake.data;
    const int32_t* framePiece = solver->framePiece.data;
    awake->pieces.count = awake->frames.count = awake->elements.count = 0;
    for (int32_t p = 0; p < solver->pieceCount; ++p) {
        awake->pieces.data[awake->pieces.count] = p;
        awake->pieces.count += isAwake[p];
    }
    for (int32_t f = 0; f < solver->frameCount; ++f) {
        awake->frames.data[awake->frames.count] = f;
        awake->frames.count += isAwake[framePiece[f]];
    }
    for (int32_t k = 0; k < solver->elementCount; ++k) {
        awake->elements.data[awake->elements.count] = k;
        awake->elements.count += isAwake[framePiece[kiriElement_FirstMember(system, k)]];
    }
}

bool kiriSolver_ListAwake(kiriSolver* solver, const kiriSystem* system)
{
    if (solver->awake.isListed) {
        return false;
    }
    WriteLists(solver, system);
    kiriMatrix_Choose(solver->matrix, solver->awake.frames.data, solver->awake.frames.count);
    solver->awake.isListed = true;
    solver->awake.lists += 1;
    return true;
}

const kiriAwake* kiriSolver_Awake(const kiriSolver* solver)
{
    return &solver->awake;
}

uint64_t kiriSolver_Hash(const kiriSolver* solver)
{
    return kiriMatrix_Hash(solver->matrix);
}

/* ---- End of a step ---- */

static bool IsReadable(const kiriSolver* solver)
{
    KIRI_EACH(f, solver->awake.frames) {
        if (!kiriFrame_FitsFloats(&solver->after.data[f])) {
            return false;
        }
    }
    return true;
}

static void WriteFrames(const kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        kiriFrameData* frame = &system->frames[f];
        const kiriFrameData* end = &solver->after.data[f];
        frame->x = end->x;
        frame->A = frame->held                                  ? frame->heldRotation
                   : kiriMechanics_IsAffine(&system->mechanics) ? end->A
                                                                : kiriMat3_Rotation(end->A);
        frame->velocity = end->velocity;
        frame->spin = end->spin;
        frame->rate = end->rate;
        frame->history = end->history;
    }
}

/* What a contact or a moving hold gave in this step says nothing of the next one. */
static void ForgetHistories(kiriSolver* solver, const kiriSystem* system)
{
    bool isEuler = system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER;
    kiriSolver_FindTouched(solver, system, solver->poses.data);
    KIRI_EACH(f, solver->awake.frames) {
        if (isEuler || kiriSolver_PieceOf(solver, f)->isTouched) {
            memset(&solver->after.data[f].history, 0, sizeof(kiriHistory));
        }
    }
}

/* An item is the time of 16 frames, about 30 us: the links of a frame take as long as 80 products of blocks or as 4
   contacts. */
static int64_t ItemsOfSystem(const kiriSolver* solver, int64_t frames, int64_t products, int32_t contactCount)
{
    return 1 + (4 * frames * (solver->size > 6 ? 3 : 1) + contactCount + products / 20) / 64;
}

int64_t kiriSolver_SystemItems(const kiriSolver* solver, int32_t contactCount)
{
    KIRI_ASSERT(solver->awake.isListed);
    return ItemsOfSystem(solver, solver->awake.frames.count, kiriMatrix_ProductCount(solver->matrix, true),
                         contactCount);
}

int64_t kiriSolver_MostItems(const kiriSolver* solver, int32_t contactCount)
{
    return ItemsOfSystem(solver, solver->frameCount, kiriMatrix_ProductCount(solver->matrix, false), contactCount);
}

int32_t kiriSolver_TakeSolved(kiriSolver* solver)
{
    int32_t solved = solver->solved;
    solver->solved = 0;
    return solved;
}

int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations, int32_t most)
{
    KIRI_ASSERT(most >= 1);
    kiriSolver_Begin(solver, system, dt);
    int32_t done = kiriSolver_Minimise(solver, system, kiriMin(iterations, most), most);
    if (done >= 0) {
        kiriSolver_LimitEnergy(solver, system);
        ForgetHistories(solver, system);
    }
    if (done < 0 || !IsReadable(solver)) {
        solver->awake.isListed = false; /* the matrix may have what is no number where it skips columns */
        return -1;
    }
    kiriSolver_AddReactions(solver, system);
    kiriSolver_AddGained(solver, system);
    kiriSolver_EndContacts(solver, system);
    WriteFrames(solver, system);
    for (int32_t k = 0; k < system->clampCount; ++k) {
        system->clamps[k].start = system->clamps[k].pose;
    }
    return done;
}
