#include "kiri_solver.h"

#include <string.h>

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

/* Has the pattern the pairs of an element already? A corner of three regions has only the pairs of its links. */
static bool IsInForce(const kiriSystem* system, int32_t k)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    return k < kiriElement_LinkCount(system) ? system->linkWas[k] != KIRI_NONE : corner != NULL && corner->count == 3;
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

static const kiriAreaElement* AreaElementOf(const kiriSystem* system, int32_t k)
{
    return &system->areaElements->elements.data[k - kiriElement_LinkCount(system) - kiriElement_CornerCount(system)];
}

int kiriElement_StrainCount(const kiriSystem* system, int32_t k)
{
    bool planar = system->mechanics.planar;
    if (kiriElement_Corner(system, k) != NULL) {
        return planar || kiriMechanics_IsAffine(&system->mechanics) ? 1 : KIRI_TRACES;
    }
    if (kiriElement_Link(system, k) == NULL) {
        return AreaElementOf(system, k)->lastRow - AreaElementOf(system, k)->firstRow;
    }
    return kiriMechanics_IsAffine(&system->mechanics) ? (planar ? KIRI_AFFINE_BENDING : KIRI_AFFINE_STRAINS)
                                                      : (planar ? KIRI_PLANE_BENDING + 1 : KIRI_STRAINS);
}

int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (link != NULL) {
        KIRI_ASSERT(link->i >= 0 && link->i < link->j && link->j < system->frameCount);
        members[0] = link->i;
        members[1] = link->j;
        return 2;
    }
    if (kiriElement_Corner(system, k) != NULL) {
        int32_t ends[4][2];
        kiriTrace_Members(kiriElement_Corner(system, k), system->links, members, ends);
        return kiriElement_Corner(system, k)->count;
    }
    const kiriAreaElement* element = AreaElementOf(system, k);
    for (int32_t m = 0; m < element->count; ++m) {
        members[m] = system->areaElements->shares.data[element->first + m].frame;
        KIRI_ASSERT(members[m] >= 0 && members[m] < system->frameCount);
        KIRI_ASSERT(m == 0 || members[m - 1] < members[m]);
    }
    return element->count;
}

int32_t kiriElement_FirstMember(const kiriSystem* system, int32_t k)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Corner(system, k) != NULL) {
        link = &system->links[kiriElement_Corner(system, k)->link[0]];
    }
    return link != NULL ? link->i : system->areaElements->shares.data[AreaElementOf(system, k)->first].frame;
}

int32_t kiriElement_MostMembers(const kiriSystem* system)
{
    int32_t most = kiriElement_CornerCount(system) > 0 ? 4 : 2;
    for (int32_t k = kiriElement_LinkCount(system) + kiriElement_CornerCount(system); k < kiriElement_Count(system);
         ++k) {
        int32_t count = AreaElementOf(system, k)->count;
        most = kiriMax(count, most);
    }
    return most;
}

/* What counts of an element: of a corner as much as of the link that counts least. */
static double CountedPart(const kiriSystem* system, int32_t k)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    double part = kiriElement_Link(system, k) != NULL ? system->linkParts[k] : 1.0;
    for (int32_t n = 0; corner != NULL && n < corner->count; ++n) {
        double other = system->linkParts[corner->link[n]];
        part = kiriMin(other, part);
    }
    return part;
}

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Corner(system, k) != NULL) {
        double all[KIRI_TRACES];
        kiriTrace_Stiffness(kiriElement_Corner(system, k), &system->material, all);
        bool isAffine = kiriMechanics_IsAffine(&system->mechanics);
        stiffness[0] = all[isAffine ? KIRI_TRACE_CURVATURE : KIRI_TRACE_STRETCH];
        stiffness[1] = all[KIRI_TRACE_CURVATURE]; /* counts where it has two strains */
    } else if (link == NULL) {
        kiriAreaElement_Stiffness(AreaElementOf(system, k), &system->material, stiffness);
    } else if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriAffine_Stiffness(link, &system->material, stiffness);
    } else {
        kiriStrain_Stiffness(link, &system->material, stiffness);
    }
    double part = system->linkParts != NULL ? CountedPart(system, k) : 1.0;
    for (int e = 0; part < 1.0 && e < kiriElement_StrainCount(system, k); ++e) {
        stiffness[e] *= part;
    }
}

/* The frames of a link, and their poses: those given, or as the frames are. */
typedef struct LinkEnds {
    const kiriFrameData* frames[2];
    kiriPose poses[2];
} LinkEnds;

static LinkEnds LinkEndsOf(const kiriSystem* system, const kiriLink* link, const kiriPose* poses)
{
    LinkEnds ends;
    ends.frames[0] = &system->frames[link->i];
    ends.frames[1] = &system->frames[link->j];
    ends.poses[0] = poses != NULL ? poses[link->i] : kiriPose_Of(ends.frames[0]);
    ends.poses[1] = poses != NULL ? poses[link->j] : kiriPose_Of(ends.frames[1]);
    return ends;
}

static void MeasureRigidLink(const kiriSystem* system, const kiriLink* link, const kiriPose* poses, double* strain,
                             kiriStrainRow* rows)
{
    LinkEnds ends = LinkEndsOf(system, link, poses);
    const kiriPose* const endPoses[2] = { &ends.poses[0], &ends.poses[1] };
    kiriStrain_Measure(link, &system->material, ends.frames, endPoses, strain, rows);
}

static void MeasureRigidRows(const kiriSystem* system, const kiriLink* link, const kiriPose* poses, double* strain,
                             kiriFrameRow* rows)
{
    kiriStrainRow found[KIRI_STRAINS];
    MeasureRigidLink(system, link, poses, strain, rows != NULL ? found : NULL);
    for (int e = 0; rows != NULL && e < KIRI_STRAINS; ++e) {
        for (int end = 0; end < 2; ++end) {
            rows[2 * e + end].by[0] = found[e].end[end].move;
            rows[2 * e + end].by[1] = found[e].end[end].turn;
        }
    }
}

static void AddFrameRow(kiriFrameRow* row, double a, kiriVec3 move, kiriVec3 turn)
{
    row->by[0] = kiriVec3_AddScaled(row->by[0], a, move);
    row->by[1] = kiriVec3_AddScaled(row->by[1], a, turn);
}

static void MeasureCorner(const kiriSystem* system, const kiriCorner* corner, const kiriPose* poses, double* strain,
                          kiriFrameRow* rows)
{
    int32_t count = corner->count, traces = system->mechanics.planar ? KIRI_TRACE_STRETCH + 1 : KIRI_TRACES;
    double strains[4][KIRI_STRAINS];
    kiriStrainRow found[4][KIRI_STRAINS];
    const double* const all[4] = { strains[0], strains[1], strains[2], strains[3] };
    for (int32_t k = 0; k < count; ++k) {
        MeasureRigidLink(system, &system->links[corner->link[k]], poses, strains[k], rows != NULL ? found[k] : NULL);
    }
    kiriTrace trace = kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
    memcpy(strain, trace.strain, sizeof(double) * (size_t)traces);
    if (rows == NULL) {
        return;
    }
    int32_t members[4], ends[4][2];
    kiriTrace_Members(corner, system->links, members, ends);
    memset(rows, 0, sizeof(*rows) * (size_t)(traces * count));
    for (int32_t k = 0; k < count; ++k) {
        for (int s = 0; s < 2 * traces; ++s) {
            const kiriStrainRow* row = &found[k][kiriTrace_Source(s)];
            for (int end = 0; end < 2; ++end) {
                AddFrameRow(&rows[count * (s / 2) + ends[k][end]], trace.by[k][s], row->end[end].move,
                            row->end[end].turn);
            }
        }
    }
}

static void MeasureAffineCorner(const kiriSystem* system, const kiriCorner* corner, const kiriPose* poses,
                                double* strain, kiriFrameRow* rows)
{
    int32_t members[4], ends[4][2];
    kiriTrace_Members(corner, system->links, members, ends);
    *strain = 0.0;
    if (rows != NULL) {
        memset(rows, 0, sizeof(*rows) * (size_t)corner->count);
    }
    for (int32_t k = 0; k < corner->count; ++k) {
        LinkEnds link = LinkEndsOf(system, &system->links[corner->link[k]], poses);
        const kiriPose* const endPoses[2] = { &link.poses[0], &link.poses[1] };
        kiriFrameRow* own[2] = { NULL, NULL };
        for (int end = 0; rows != NULL && end < 2; ++end) {
            own[end] = &rows[ends[k][end]];
        }
        kiriAffine_AddTrace(corner->weight[k], endPoses, strain, rows != NULL ? own : NULL);
    }
}

void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain, kiriFrameRow* rows)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Corner(system, k) != NULL && kiriMechanics_IsAffine(&system->mechanics)) {
        MeasureAffineCorner(system, kiriElement_Corner(system, k), poses, strain, rows);
    } else if (kiriElement_Corner(system, k) != NULL) {
        MeasureCorner(system, kiriElement_Corner(system, k), poses, strain, rows);
    } else if (link == NULL) {
        kiriAreaElement_Measure(AreaElementOf(system, k), system->areaElements->shares.data, system->frames, poses,
                                strain, rows);
    } else if (kiriMechanics_IsAffine(&system->mechanics)) {
        LinkEnds ends = LinkEndsOf(system, link, poses);
        const kiriPose* const endPoses[2] = { &ends.poses[0], &ends.poses[1] };
        kiriAffine_Measure(link, &system->material, ends.frames, endPoses, strain, (kiriFrameRow(*)[2])rows);
    } else {
        MeasureRigidRows(system, link, poses, strain, rows);
    }
}

kiriTrace kiriElement_Trace(const kiriSystem* system, int32_t k, const double* strains)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    const double* all[4] = { NULL, NULL, NULL, NULL };
    for (int32_t n = 0; n < corner->count; ++n) {
        all[n] = &strains[KIRI_MOST_STRAINS * (size_t)corner->link[n]];
    }
    return kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
}

/* Offsets stay what they are in folds, where they fade as all do. */
static void TakeCornerOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    const double* all[4] = { NULL, NULL, NULL, NULL };
    for (int32_t n = 0; n < corner->count; ++n) {
        all[n] = system->strainOffsets[corner->link[n]].strain;
    }
    kiriTrace offset = kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
    for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
        pulling[e] = strain[e] - offset.strain[e];
    }
}

void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling)
{
    int count = kiriElement_StrainCount(system, k);
    if (system->strainOffsets != NULL && kiriElement_IsRigidCorner(system, k)) {
        TakeCornerOffsets(system, k, strain, pulling);
        return;
    }
    if (system->strainOffsets == NULL || !kiriElement_IsRigidLink(system, k)) {
        memcpy(pulling, strain, sizeof(double) * (size_t)count);
        return;
    }
    const double* offset = system->strainOffsets[k].strain;
    for (int e = 0; e < count; ++e) {
        pulling[e] = strain[e] - offset[e];
    }
    if (count > KIRI_NORMAL_STOP) { /* the stop only pushes */
        double over = fabs(strain[KIRI_NORMAL_STOP]) - fabs(offset[KIRI_NORMAL_STOP]);
        pulling[KIRI_NORMAL_STOP] = over <= 0.0 ? 0.0 : strain[KIRI_NORMAL_STOP] > 0.0 ? over : -over;
    }
}

double kiriSolver_ElasticEnergy(const kiriSystem* system)
{
    double sum = 0.0;
    for (int32_t k = 0; k < kiriElement_Count(system); ++k) {
        double strain[KIRI_MOST_STRAINS], stiffness[KIRI_MOST_STRAINS], pulling[KIRI_MOST_STRAINS];
        kiriElement_Measure(system, k, NULL, strain, NULL);
        kiriElement_Stiffness(system, k, stiffness);
        kiriElement_TakeOffsets(system, k, strain, pulling);
        for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
            sum += 0.5 * stiffness[e] * pulling[e] * pulling[e];
        }
    }
    return sum;
}
