#include "kiri_solver.h"
#include "../core/kiri_archive.h"

/* ---- Unknowns --------------------------------------------------------------------------------------------------- */

static void ChooseUnknowns(kiriSolver* solver, const kiriMechanics* mechanics)
{
    const kiriVec3 space[3] = KIRI_AXES;
    const kiriVec3 plane[3] = { mechanics->axes.u, mechanics->axes.v, mechanics->axes.d };
    bool affine = kiriMechanics_IsAffine(mechanics), planar = mechanics->planar;
    int vectors = !affine ? 2 : planar ? 3 : 4;
    solver->size = 0;
    KIRI_TIMES(vector, vectors) {
        KIRI_TIMES(axis, 3) {
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
        for (int32_t n = 0; n < solver->size; n += 3) { /* the axes of space; a call of memcpy takes longer */
            kiriVec3_StoreDoubles(values + n, row->by[n / 3]);
        }
        return;
    }
    KIRI_TIMES(n, solver->size) {
        values[n] = kiriVec3_Dot(row->by[solver->unknowns[n].vector], solver->unknowns[n].axis);
    }
}

kiriFrameRow kiriSolver_Expand(const kiriSolver* solver, double scale, const double* values)
{
    kiriFrameRow vectors = { 0 };
    if (!solver->mechanics.planar) {
        for (int32_t n = 0; n < solver->size; n += 3) {
            vectors.by[n / 3] = kiriVec3_Make(scale * values[n], scale * values[n + 1], scale * values[n + 2]);
        }
        return vectors;
    }
    KIRI_TIMES(n, solver->size) {
        kiriVec3* by = &vectors.by[solver->unknowns[n].vector];
        *by = kiriVec3_AddScaled(*by, scale * values[n], solver->unknowns[n].axis);
    }
    return vectors;
}

kiriSolver* kiriSolver_Create(kiriMemory* memory, const kiriMechanics* mechanics)
{
    kiriSolver* solver = kiriMemory_AllocZeroed(memory, sizeof(kiriSolver));
    if (solver != NULL) {
        solver->memory = memory;
        solver->mechanics = *mechanics;
        ChooseUnknowns(solver, mechanics);
    }
    return solver;
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

/* Returns the system of a body, without frames. */
static kiriSystem SystemOf(const kiriSolverBodies* bodies, const kiriSolverBody* body, const kiriSystem* sheet,
                           kiriAreaElements* elements)
{
    kiriSystem system = *sheet;
    KIRI_CLEAR(elements);
    elements->elements.data = bodies->areaElements.elements.data + body->elements.first;
    elements->elements.count = body->elements.count;
    elements->shares.data = bodies->areaElements.shares.data;
    elements->shares.count = bodies->areaElements.shares.count;
    system.areaElements = elements;
    system.frames = NULL;
    system.frameCount = body->frames.count;
    system.links = bodies->ownLinks.data + body->links.first;
    system.linkCount = body->links.count;
    system.corners = bodies->corners.data + body->corners.first;
    system.cornerCount = body->corners.count;
    system.linkParts = NULL;
    system.strainOffsets = NULL;
    system.plastics = NULL;
    return system;
}

void kiriSolver_SetFold(kiriSolver* solver, int32_t fold, double hinge, double rest)
{
    kiriLink_SetFolds(solver->bodies.ownLinks.data, solver->bodies.ownLinks.count, fold, hinge, rest);
}

/* Fails on out of memory. */
static bool ReserveBodies(kiriSolver* s, const kiriSystem* next)
{
    kiriMemory* memory = s->memory;
    kiriSolverBodies* bodies = &s->next;
    int64_t frames = next->frameCount, links = next->linkCount;
    int64_t areas = next->areaElements != NULL ? next->areaElements->elements.count : 0;
    int64_t shares = next->areaElements != NULL ? next->areaElements->shares.count : 0;
    return kiriArrays_Resize(memory, frames, &bodies->bodyOf, &bodies->place, &bodies->frames) &&
           kiriArrays_Resize(memory, links, &bodies->links, &bodies->ownLinks, &s->linkPlace) &&
           kiriArray_Resize(memory, &bodies->corners, next->cornerCount) &&
           kiriArray_Resize(memory, &bodies->areaElements.elements, areas) &&
           kiriArray_Resize(memory, &bodies->areaElements.shares, shares) &&
           kiriArrays_Resize(memory, kiriMax(kiriMax(links, (int64_t)next->cornerCount), areas), &s->order, &s->itemBody) &&
           kiriArrays_Reserve(memory, frames, &s->moved.bodies, &s->moved.frames) &&
           kiriArray_Reserve(memory, &s->moved.links, links);
}

/* Reserves for elements of the largest body, and for clamps. Fails on out of memory. */
static bool ReserveElements(kiriSolver* s)
{
    int64_t elements = s->mostElements + s->clamps.capacity, strains = KIRI_MOST_STRAINS * elements;
    return kiriArrays_Reserve(s->memory, strains, &s->stiffness, &s->loss, &s->startStrain, &s->nowStrain) &&
           kiriArray_Reserve(s->memory, &s->stopping, elements);
}

/* Reserves room for steps of a body. Fails on out of memory. */
static bool ReserveSteps(kiriSolver* s, const kiriSystem* body)
{
    kiriMemory* memory = s->memory;
    int64_t frames = body->frameCount, links = body->linkCount;
    bool hasTraces = kiriElement_CornerCount(body) > 0 && !kiriMechanics_IsAffine(&body->mechanics);
    int64_t traced = hasTraces ? KIRI_TRACED * 2 * s->size * links : 0, most = kiriElement_MostMembers(body);
    int64_t rows = KIRI_MOST_STRAINS * most;
    bool isPlastic = body->material.yieldStress > 0.0f;
    int64_t yields = isPlastic ? links : 0;
    s->mostElements = kiriMax((int64_t)kiriElement_Count(body), s->mostElements);
    return kiriArrays_Reserve(memory, yields, &s->plastics, &s->flows) &&
           kiriArray_Reserve(memory, &s->regions, isPlastic ? frames : 0) &&
           kiriArrays_Reserve(memory, links, &s->linkParts, &s->strainOffsets) &&
           kiriArrays_Reserve(memory, frames, &s->before, &s->after, &s->predictions, &s->start, &s->poses, &s->trial,
                              &s->sources, &s->materials) &&
           ReserveElements(s) && kiriArray_Reserve(memory, &s->tracedRows, traced) &&
           kiriArrays_Reserve(memory, s->size * frames, &s->force, &s->move) &&
           kiriArray_Reserve(memory, &s->members, most) && kiriArray_Reserve(memory, &s->rows, rows) &&
           kiriArray_Reserve(memory, &s->J, rows * s->size) && kiriArrays_Reserve(memory, frames, &s->airs, &s->turns);
}

/* Sorts items by body, and sets the spans at this offset of kiriSolverBody. Items of a body keep their order. */
static void ShareOut(kiriSolverBodies* bodies, size_t span, const int32_t* bodyOf, int32_t count, int32_t* order)
{
    kiriSpans_Group(bodyOf, count, (kiriSpan*)((char*)bodies->bodies.data + span), sizeof(kiriSolverBody),
                    bodies->bodies.count, order);
}

static void TakeLinks(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolverBodies* bodies = &solver->next;
    int32_t count = kiriElement_LinkCount(system);
    KIRI_TIMES(k, count) {
        solver->itemBody.data[k] = bodies->bodyOf.data[system->links[k].i];
    }
    ShareOut(bodies, offsetof(kiriSolverBody, links), solver->itemBody.data, count, bodies->links.data);
    KIRI_TIMES(n, count) {
        int32_t k = bodies->links.data[n], body = bodies->bodyOf.data[system->links[k].i];
        KIRI_ASSERT(bodies->bodyOf.data[system->links[k].j] == body);
        kiriLink* link = &bodies->ownLinks.data[n];
        *link = system->links[k];
        link->i = bodies->place.data[link->i];
        link->j = bodies->place.data[link->j];
        solver->linkPlace.data[k] = n - bodies->bodies.data[body].links.first;
    }
}

static void TakeCorners(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolverBodies* bodies = &solver->next;
    int32_t count = kiriElement_CornerCount(system);
    KIRI_TIMES(k, count) {
        solver->itemBody.data[k] = bodies->bodyOf.data[system->links[system->corners[k].link[0]].i];
    }
    ShareOut(bodies, offsetof(kiriSolverBody, corners), solver->itemBody.data, count, solver->order.data);
    KIRI_TIMES(n, count) {
        kiriCorner* corner = &bodies->corners.data[n];
        *corner = system->corners[solver->order.data[n]];
        KIRI_EACH_INDEX(k, *corner) {
            corner->link[k] = solver->linkPlace.data[corner->link[k]];
        }
    }
}

static void TakeAreas(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolverBodies* bodies = &solver->next;
    const kiriAreaElements* areas = system->areaElements;
    int32_t count = bodies->areaElements.elements.count;
    KIRI_TIMES(k, count) {
        solver->itemBody.data[k] = bodies->bodyOf.data[areas->shares.data[areas->elements.data[k].first].frame];
    }
    ShareOut(bodies, offsetof(kiriSolverBody, elements), solver->itemBody.data, count, solver->order.data);
    KIRI_TIMES(n, count) {
        bodies->areaElements.elements.data[n] = areas->elements.data[solver->order.data[n]];
    }
    KIRI_EACH_INDEX(n, bodies->areaElements.shares) {
        kiriFrameShare* share = &bodies->areaElements.shares.data[n];
        *share = areas->shares.data[n];
        share->frame = bodies->place.data[share->frame];
    }
}

static void ShareOutAll(kiriSolver* solver, const kiriSystem* system, const int32_t* framePiece)
{
    kiriSolverBodies* bodies = &solver->next;
    kiriArray_Set(&bodies->bodies, 0);
    KIRI_TIMES(f, system->frameCount) {
        KIRI_ASSERT(framePiece[f] >= 0 && framePiece[f] < bodies->bodies.count);
        bodies->bodyOf.data[f] = framePiece[f];
    }
    ShareOut(bodies, offsetof(kiriSolverBody, frames), framePiece, system->frameCount, bodies->frames.data);
    KIRI_EACH(const kiriSolverBody, body, bodies->bodies) {
        const kiriSpan* frames = &body->frames;
        KIRI_ASSERT(frames->count > 0);
        KIRI_EACH_INDEX(n, *frames) {
            bodies->place.data[bodies->frames.data[frames->first + n]] = n;
        }
    }
    TakeLinks(solver, system);
    TakeCorners(solver, system);
    TakeAreas(solver, system);
}

/* ---- Patterns ---------------------------------------------------------------------------------------------------- */

/* Returns true if the pair is one of a corner that a link of it has already. */
static bool IsPairOfLink(const kiriSystem* system, int32_t k, kiriPair pair)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    bool found = false;
    KIRI_TIMES_WHILE(corner != NULL, n, corner->count) {
        const kiriLink* link = &system->links[corner->link[n]];
        found |= link->i == pair.a && link->j == pair.b;
    }
    return found;
}

/* Collects the pairs of frames that share an element. Fails on out of memory. */
static bool CollectPairs(kiriSolver* solver, const kiriSystem* body)
{
    solver->pairs.count = 0;
    KIRI_TIMES(k, kiriElement_Count(body)) {
        int32_t *members = solver->members.data, count = kiriElement_Members(body, k, members);
        KIRI_FROM_TO(b, 1, count) {
            KIRI_TIMES(a, b) {
                kiriPair pair = { members[a], members[b] };
                if (!IsPairOfLink(body, k, pair) && !kiriArray_Push(solver->memory, &solver->pairs, pair)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* Returns the committed body with the same frames, or null. */
static const kiriSolverBody* FindSame(const kiriSolver* solver, const kiriSolverBody* next)
{
    const kiriSolverBodies *now = &solver->bodies, *then = &solver->next;
    const int32_t* frames = &then->frames.data[next->frames.first];
    if (frames[0] >= now->bodyOf.count) {
        return NULL;
    }
    const kiriSolverBody* body = &now->bodies.data[now->bodyOf.data[frames[0]]];
    bool isSame = body->frames.count == next->frames.count &&
                  memcmp(&now->frames.data[body->frames.first], frames, sizeof(int32_t) * (size_t)body->frames.count) == 0;
    return isSame ? body : NULL;
}

/* Gives a body its matrix. Regions that came apart may meet again when a cut moves sites: a new pattern keeps the pairs
   of the old one, unless they are too many. Fails on out of memory. */
static bool StageMatrix(kiriSolver* solver, kiriSolverBody* next, const kiriSystem* body)
{
    const kiriSolverBody* same = FindSame(solver, next);
    bool isCovered = same != NULL;
    if (!CollectPairs(solver, body)) {
        return false;
    }
    KIRI_EACH_WHILE(isCovered, const kiriPair, pair, solver->pairs) {
        isCovered = kiriMatrix_Covers(same->matrix, *pair);
    }
    if (isCovered) {
        next->matrix = same->matrix;
        return true;
    }
    int32_t own = solver->pairs.count, old = same != NULL ? kiriMatrix_PairCount(same->matrix) : 0;
    if (old > 0 && old <= 2 * own) {
        if (!kiriArray_Resize(solver->memory, &solver->pairs, (int64_t)own + old)) {
            return false;
        }
        kiriMatrix_GetPairs(same->matrix, &solver->pairs.data[own]);
    }
    next->matrix = kiriMatrix_Create(solver->memory, solver->size);
    next->ownsMatrix = true;
    return next->matrix != NULL &&
           kiriMatrix_Shape(next->matrix, body->frameCount, solver->pairs.data, solver->pairs.count);
}

static void DropStagedBodies(kiriSolver* solver)
{
    KIRI_EACH(const kiriSolverBody, body, solver->next.bodies) {
        if (body->ownsMatrix) {
            kiriMatrix_Destroy(body->matrix);
        }
    }
    solver->next.bodies.count = 0;
    solver->isStaged = false;
}

bool kiriSolver_Stage(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece, int32_t pieceCount)
{
    KIRI_ASSERT(next->frameCount >= 0 && next->linkCount >= 0 && pieceCount >= 0 && pieceCount <= next->frameCount);
    KIRI_ASSERT(next->mechanics.model == solver->mechanics.model);
    DropStagedBodies(solver);
    if (!ReserveBodies(solver, next) || !kiriArray_Resize(solver->memory, &solver->next.bodies, pieceCount)) {
        return false;
    }
    ShareOutAll(solver, next, framePiece);
    solver->isStaged = true;
    KIRI_TIMES_WHILE(solver->isStaged, b, pieceCount) {
        kiriSolverBody* body = &solver->next.bodies.data[b];
        kiriAreaElements elements;
        kiriSystem system = SystemOf(&solver->next, body, next, &elements);
        solver->isStaged = ReserveSteps(solver, &system) && StageMatrix(solver, body, &system);
    }
    if (!solver->isStaged) {
        DropStagedBodies(solver);
    }
    return solver->isStaged;
}

void kiriSolver_Commit(kiriSolver* solver)
{
    if (!solver->isStaged) {
        return;
    }
    solver->allWork = 0;
    KIRI_EACH(kiriSolverBody, body, solver->next.bodies) {
        kiriSolverBody *next = body, *now;
        const kiriSolverBody* same = next->ownsMatrix ? NULL : FindSame(solver, next);
        if (same != NULL) {
            now = &solver->bodies.bodies.data[same - solver->bodies.bodies.data];
            now->matrix = NULL;
        }
    }
    KIRI_EACH(const kiriSolverBody, body, solver->bodies.bodies) {
        kiriMatrix_Destroy(body->matrix);
    }
    kiriSolverBodies now = solver->bodies;
    solver->bodies = solver->next;
    solver->next = now;
    solver->next.bodies.count = 0;
    solver->isStaged = false;
    KIRI_EACH_INDEX(b, solver->bodies.bodies) {
        solver->bodies.bodies.data[b].ownsMatrix = false;
        solver->bodies.bodies.data[b].isMoved = true;
        solver->allWork += kiriSolver_WorkOf(solver, b, 0);
    }
    solver->moved.isListed = false;
}

bool kiriSolver_MakeBodies(kiriSolver* solver, const int32_t* framePiece, int32_t frameCount, int32_t pieceCount)
{
    kiriSystem system = { .mechanics = solver->mechanics, .frameCount = frameCount };
    if (!ReserveBodies(solver, &system) || !kiriArray_Resize(solver->memory, &solver->next.bodies, pieceCount)) {
        return false;
    }
    ShareOutAll(solver, &system, framePiece);
    KIRI_TIMES(b, pieceCount) {
        solver->next.bodies.data[b].matrix = kiriMatrix_Create(solver->memory, solver->size);
        if (solver->next.bodies.data[b].matrix == NULL) {
            return false;
        }
    }
    kiriSolverBodies none = solver->bodies;
    solver->bodies = solver->next;
    solver->next = none;
    return true;
}

/* Reserves for the rows of an island. */
static bool ReserveTaken(kiriSolver* solver, int64_t pins, int64_t clamps, int64_t contacts)
{
    kiriMemory* memory = solver->memory;
    return kiriArray_Reserve(memory, &solver->pins, pins) &&
           kiriArrays_Reserve(memory, clamps, &solver->clamps, &solver->clampRows) && ReserveElements(solver) &&
           kiriArray_Reserve(memory, &solver->contacts, contacts);
}

bool kiriSolver_ReserveBodies(kiriSolver* solver, int64_t bodies, int64_t frames)
{
    kiriMemory* memory = solver->memory;
    bodies = kiriMin(bodies, KIRI_MOST_RECOILING);
    int64_t count = KIRI_RECOILS * bodies, all = frames * solver->size;
    return bodies == 0 || (kiriArray_Reserve(memory, &solver->recoil.bodies, bodies) &&
                           kiriArray_Reserve(memory, &solver->recoil.border, count * all) &&
                           kiriArray_Reserve(memory, &solver->recoil.corner, count * count) &&
                           kiriArray_Reserve(memory, &solver->recoil.pull, count) &&
                           kiriArray_Reserve(memory, &solver->recoil.right, all + count));
}

bool kiriSolver_ReserveRows(kiriSolver* solver, int64_t pins, int64_t clamps, int64_t contacts)
{
    return ReserveTaken(solver, pins, clamps, contacts) &&
           kiriArray_Reserve(solver->memory, &solver->nextPin, pins) &&
           kiriArray_Reserve(solver->memory, &solver->nextClamp, clamps);
}

/* ---- Moved bodies ----------------------------------------------------------------------------------------------- */

void kiriSolver_SetMoved(kiriSolver* solver, int32_t body, bool isMoved)
{
    KIRI_ASSERT_HAS(solver->bodies.bodies, body);
    solver->moved.isListed = solver->moved.isListed && solver->bodies.bodies.data[body].isMoved == isMoved;
    solver->bodies.bodies.data[body].isMoved = isMoved;
}

bool kiriSolver_ListMoved(kiriSolver* solver)
{
    const kiriSolverBodies* bodies = &solver->bodies;
    kiriMoved* moved = &solver->moved;
    if (moved->isListed) {
        return false;
    }
    moved->bodies.count = moved->frames.count = moved->links.count = 0;
    KIRI_EACH_INDEX(b, bodies->bodies) {
        const kiriSolverBody* body = &bodies->bodies.data[b];
        if (body->isMoved) {
            KIRI_NEXT(moved->bodies) = b;
            KIRI_EACH_INDEX(n, body->frames) {
                KIRI_NEXT(moved->frames) = bodies->frames.data[body->frames.first + n];
            }
            KIRI_EACH_INDEX(n, body->links) {
                KIRI_NEXT(moved->links) = bodies->links.data[body->links.first + n];
            }
        }
    }
    moved->isListed = true;
    moved->version += 1;
    return true;
}

kiriIndexSpan kiriSolver_FramesOf(const kiriSolver* solver, int32_t body)
{
    KIRI_ASSERT_HAS(solver->bodies.bodies, body);
    kiriSpan frames = solver->bodies.bodies.data[body].frames;
    return (kiriIndexSpan){ &solver->bodies.frames.data[frames.first], frames.count };
}

/* The hash of a sheet with one piece is the hash of its pattern. */
uint64_t kiriSolver_Hash(const kiriSolver* solver)
{
    uint64_t hash = kiriMatrix_Hash(solver->bodies.bodies.data[0].matrix);
    KIRI_FROM_TO(b, 1, solver->bodies.bodies.count) {
        kiriHash_Word(&hash, kiriMatrix_Hash(solver->bodies.bodies.data[b].matrix));
    }
    return hash;
}

/* ---- Budget ------------------------------------------------------------------------------------------------------ */

/* The links of a frame cost as much as 80 products of blocks, or as 4 contacts. */
static int64_t WorkOf(const kiriMatrix* matrix, int32_t size, int64_t frames, int64_t contacts)
{
    return 4 * frames * (size > 6 ? 3 : 1) + contacts + matrix->products / 20;
}

int64_t kiriSolver_WorkOf(const kiriSolver* solver, int32_t body, int32_t contactCount)
{
    KIRI_ASSERT(body >= 0 && body < solver->bodies.bodies.count && contactCount >= 0);
    const kiriSolverBody* of = &solver->bodies.bodies.data[body];
    return WorkOf(of->matrix, solver->size, of->frames.count, contactCount);
}

int64_t kiriSolver_WorkOfIsland(const kiriMatrix* matrix, const kiriIslandBody* bodies, int32_t count)
{
    int64_t frames = 0, contacts = 0;
    KIRI_TIMES(n, count) {
        const kiriSolverBody* body = &bodies[n].solver->bodies.bodies.data[bodies[n].body];
        frames += body->frames.count;
        contacts += body->contactCount;
    }
    return WorkOf(matrix, bodies[0].solver->size, frames, contacts);
}

int32_t kiriSolver_TakeSolved(kiriSolver* solver)
{
    int32_t solved = solver->solved;
    solver->solved = 0;
    return solved;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static kiriSolverBody* BodyOf(kiriSolver* solver, int32_t frame)
{
    KIRI_ASSERT_HAS(solver->bodies.bodyOf, frame);
    kiriSolverBody* body = &solver->bodies.bodies.data[solver->bodies.bodyOf.data[frame]];
    KIRI_ASSERT(body->isMoved);
    return body;
}

/* Links are made from the last row on, so that each list ascends. */
void kiriSolver_ShareRows(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_ASSERT(solver->moved.isListed);
    KIRI_ASSERT(system->pinCount <= solver->nextPin.capacity && system->clampCount <= solver->nextClamp.capacity);
    KIRI_EACH(const int32_t, moved, solver->moved.bodies) {
        kiriSolverBody* body = &solver->bodies.bodies.data[*moved];
        body->pin = body->clamp = body->contact = KIRI_NONE;
        body->contactCount = 0;
    }
    for (int32_t k = system->pinCount - 1; k >= 0; --k) {
        kiriSolverBody* body = BodyOf(solver, system->pins[k].frame);
        solver->nextPin.data[k] = body->pin;
        body->pin = k;
    }
    for (int32_t k = system->clampCount - 1; k >= 0; --k) {
        kiriSolverBody* body = BodyOf(solver, system->clamps[k].frame);
        solver->nextClamp.data[k] = body->clamp;
        body->clamp = k;
    }
    for (int32_t k = system->contactCount - 1; k >= 0; --k) {
        kiriSolverBody* body = BodyOf(solver, system->contacts[k].weights[0].frame);
        system->contacts[k].next = body->contact;
        body->contact = k;
        body->contactCount += 1;
    }
}

/* ---- Islands ----------------------------------------------------------------------------------------------------- */

static kiriSolverBody* BodyOfMember(const kiriIslandBody* member)
{
    KIRI_ASSERT(member->body >= 0 && member->body < member->solver->bodies.bodies.count);
    return &member->solver->bodies.bodies.data[member->body];
}

static void TakeFrames(kiriSolver* solver, const kiriIslandBody* member)
{
    kiriSolverBody* body = BodyOfMember(member);
    const kiriSystem* sheet = member->sheet;
    const int32_t* frames = &member->solver->bodies.frames.data[body->frames.first];
    KIRI_ASSERT(solver->sources.count + body->frames.count <= solver->sources.capacity);
    body->island = solver->sources.count;
    KIRI_EACH_INDEX(n, body->frames) {
        int32_t f = solver->sources.count++;
        solver->sources.data[f] = &sheet->frames[frames[n]];
        solver->materials.data[f] = &sheet->material;
        solver->airs.data[f] = sheet->air;
    }
}

/* Returns the index in the island of a frame of a sheet. */
static int32_t IslandFrame(const kiriSolver* solver, int32_t frame)
{
    const kiriSolverBodies* bodies = &solver->bodies;
    return bodies->bodies.data[bodies->bodyOf.data[frame]].island + bodies->place.data[frame];
}

static void TakePins(kiriSolver* solver, const kiriIslandBody* member)
{
    const kiriSystem* sheet = member->sheet;
    for (int32_t k = BodyOfMember(member)->pin; k != KIRI_NONE; k = member->solver->nextPin.data[k]) {
        KIRI_ASSERT(sheet->pins[k].frame >= 0 && sheet->pins[k].frame < sheet->frameCount);
        kiriPinRow* pin = &KIRI_NEXT(solver->pins);
        *pin = sheet->pins[k];
        pin->frame = IslandFrame(member->solver, pin->frame);
    }
}

static void TakeClamps(kiriSolver* solver, const kiriIslandBody* member)
{
    const kiriSystem* sheet = member->sheet;
    for (int32_t k = BodyOfMember(member)->clamp; k != KIRI_NONE; k = member->solver->nextClamp.data[k]) {
        int32_t n = solver->clamps.count++;
        KIRI_ASSERT(n < solver->clamps.capacity && n < solver->clampRows.capacity);
        KIRI_ASSERT(sheet->clamps[k].frame >= 0 && sheet->clamps[k].frame < sheet->frameCount);
        solver->clampRows.data[n] = &sheet->clamps[k];
        solver->clamps.data[n] = sheet->clamps[k];
        solver->clamps.data[n].frame = IslandFrame(member->solver, sheet->clamps[k].frame);
    }
}

/* Copies the state of links that changes from tick to tick. `first`: of the body's links in the island. */
static void TakeLinkState(kiriSolver* solver, const kiriIslandBody* member, int32_t first, bool hasParts,
                          bool hasOffsets, bool hasYields)
{
    const kiriSystem* sheet = member->sheet;
    kiriSpan links = BodyOfMember(member)->links;
    KIRI_EACH_INDEX(k, links) {
        int32_t link = member->solver->bodies.links.data[links.first + k];
        if (hasYields) {
            const kiriPlastic none = { { 0.0, 0.0, 0.0 }, 0.0 };
            solver->plastics.data[first + k] = sheet->plastics != NULL ? sheet->plastics[link] : none;
        }
        if (hasParts) {
            const kiriLinkPart all = { 1.0, 1.0 };
            solver->linkParts.data[first + k] = sheet->linkParts != NULL ? sheet->linkParts[link] : all;
        }
        if (hasOffsets) {
            const kiriStrainOffset none = { 0 };
            solver->strainOffsets.data[first + k] = sheet->strainOffsets != NULL ? sheet->strainOffsets[link] : none;
        }
    }
}

/* Appends copies of a body's elements to the island. */
static void TakeElements(kiriSolver* solver, const kiriIslandBody* member)
{
    const kiriSolverBodies* bodies = &member->solver->bodies;
    const kiriSolverBody* body = BodyOfMember(member);
    kiriAreaElements* areas = &solver->islandElements;
    int32_t firstLink = solver->islandLinks.count;
    KIRI_EACH_INDEX(k, body->links) {
        kiriLink* link = &KIRI_NEXT(solver->islandLinks);
        *link = bodies->ownLinks.data[body->links.first + k];
        link->i += body->island;
        link->j += body->island;
    }
    KIRI_EACH_INDEX(k, body->corners) {
        kiriCorner* corner = &KIRI_NEXT(solver->islandCorners);
        *corner = bodies->corners.data[body->corners.first + k];
        KIRI_EACH_INDEX(n, *corner) {
            corner->link[n] += firstLink;
        }
    }
    KIRI_EACH_INDEX(k, body->elements) {
        kiriAreaElement* element = &KIRI_NEXT(areas->elements);
        *element = bodies->areaElements.elements.data[body->elements.first + k];
        const kiriFrameShare* shares = &bodies->areaElements.shares.data[element->first];
        element->first = areas->shares.count;
        KIRI_EACH_INDEX(n, *element) {
            kiriFrameShare share = shares[n];
            share.frame += body->island;
            KIRI_NEXT(areas->shares) = share;
        }
    }
}

/* Sums counts of several bodies in the fields of a system. Its material and its scheme are those that need most. */
static kiriSystem SumSystems(const kiriSolver* solver, const kiriIslandBody* bodies, int32_t count)
{
    kiriSystem system = *bodies[0].sheet;
    system.frameCount = system.linkCount = system.cornerCount = system.clampCount = 0;
    KIRI_TIMES(n, count) {
        const kiriSolverBody* body = BodyOfMember(&bodies[n]);
        const kiriSystem* sheet = bodies[n].sheet;
        KIRI_ASSERT(sheet->mechanics.model == system.mechanics.model && !sheet->mechanics.planar);
        system.frameCount += body->frames.count;
        system.linkCount += body->links.count;
        system.cornerCount += body->corners.count;
        if (sheet->material.poissonsRatio > system.material.poissonsRatio) {
            system.material.poissonsRatio = sheet->material.poissonsRatio; /* it says whether there are corners */
        }
        system.material.yieldStress = kiriMax(sheet->material.yieldStress, system.material.yieldStress);
        if (sheet->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER) {
            system.mechanics.timeStepping = KIRI_TIME_STEPPING_EULER;
        }
    }
    system.links = solver->islandLinks.data;
    system.corners = solver->islandCorners.data;
    system.areaElements = &solver->islandElements;
    return system;
}

kiriSystem kiriSolver_Open(kiriSolver* solver, const kiriIslandBody* bodies, int32_t count, kiriMatrix* matrix)
{
    bool hasParts = false, hasOffsets = false, hasYields = false;
    kiriSystem system;
    solver->matrix = matrix;
    solver->islandBodies = bodies;
    solver->islandCount = count;
    solver->sources.count = solver->pins.count = solver->clamps.count = 0;
    solver->islandLinks.count = solver->islandCorners.count = 0;
    solver->islandElements.elements.count = solver->islandElements.shares.count = 0;
    KIRI_TIMES(n, count) {
        KIRI_ASSERT(BodyOfMember(&bodies[n])->isMoved);
        KIRI_ASSERT(bodies[n].sheet->frameCount == bodies[n].solver->bodies.bodyOf.count);
        TakeFrames(solver, &bodies[n]);
        TakePins(solver, &bodies[n]);
        TakeClamps(solver, &bodies[n]);
        hasParts |= bodies[n].sheet->linkParts != NULL;
        hasOffsets |= bodies[n].sheet->strainOffsets != NULL;
        hasYields |= bodies[n].sheet->plastics != NULL;
    }
    for (int32_t n = 0, first = 0; n < count; ++n) {
        TakeLinkState(solver, &bodies[n], first, hasParts, hasOffsets, hasYields);
        first += BodyOfMember(&bodies[n])->links.count;
        if (count > 1) {
            TakeElements(solver, &bodies[n]);
        }
    }
    system = count > 1 ? SumSystems(solver, bodies, count)
                       : SystemOf(&bodies->solver->bodies, BodyOfMember(bodies), bodies->sheet, &solver->areaElements);
    system.frames = solver->before.data;
    system.materials = solver->materials.data;
    system.airs = solver->airs.data;
    system.pins = solver->pins.data;
    system.pinCount = solver->pins.count;
    system.clamps = solver->clamps.data;
    system.clampCount = solver->clamps.count;
    system.linkParts = hasParts ? solver->linkParts.data : NULL;
    system.strainOffsets = hasOffsets ? solver->strainOffsets.data : NULL;
    system.plastics = hasYields ? solver->plastics.data : NULL;
    system.flows = hasYields ? solver->flows.data : NULL;
    KIRI_ASSERT(hasOffsets || !hasYields);
    return system;
}

static bool AddPair(kiriMemory* memory, kiriIslandMatrix* island, int32_t a, int32_t b)
{
    kiriPair pair = { kiriMin(a, b), kiriMax(a, b) };
    return a == b || kiriArray_Push(memory, &island->next, pair);
}

/* Collects the pairs of all frames of each mutual contact of a body. */
static bool AddContactPairs(kiriMemory* memory, kiriIslandMatrix* island, const kiriIslandBody* member)
{
    bool ok = true;
    for (int32_t k = BodyOfMember(member)->contact; ok && k != KIRI_NONE; k = member->sheet->contacts[k].next) {
        const kiriContactRow* row = &member->sheet->contacts[k];
        int32_t frames[2 * KIRI_CONTACT_SIDE], count = row->other != NULL ? row->weightCount + row->otherCount : 0;
        KIRI_TIMES(a, count) {
            int32_t b = a - row->weightCount;
            frames[a] = b < 0 ? IslandFrame(member->solver, row->weights[a].frame) : IslandFrame(row->other, row->otherWeights[b].frame);
            KIRI_TIMES_WHILE(ok, n, a) {
                ok = AddPair(memory, island, frames[a], frames[n]);
            }
        }
    }
    return ok;
}

/* Collects the pairs of all frames of each stitch. */
static bool AddStitchPairs(kiriMemory* memory, kiriIslandMatrix* island, kiriStitchRow* stitches)
{
    bool ok = true;
    for (kiriStitchRow* row = stitches; ok && row != NULL; row = row->next) {
        KIRI_TIMES(a, row->counts[0] + row->counts[1]) {
            KIRI_ASSERT(row->solvers[a >= row->counts[0]] != NULL);
            row->members[a].frame = IslandFrame(row->solvers[a >= row->counts[0]], row->members[a].frame);
            KIRI_TIMES_WHILE(ok, b, a) {
                ok = AddPair(memory, island, row->members[a].frame, row->members[b].frame);
            }
        }
    }
    return ok;
}

static bool AddBodyPairs(kiriMemory* memory, kiriIslandMatrix* island, const kiriIslandBody* member)
{
    const kiriSolverBody* body = BodyOfMember(member);
    int32_t first = island->next.count, pairs = kiriMatrix_PairCount(body->matrix);
    if (!kiriArray_Resize(memory, &island->next, (int64_t)first + pairs)) {
        return false;
    }
    kiriMatrix_GetPairs(body->matrix, &island->next.data[first]);
    KIRI_FROM_TO(k, first, island->next.count) {
        island->next.data[k].a += body->island;
        island->next.data[k].b += body->island;
    }
    return true;
}

static bool ReserveIsland(kiriSolver* solver, const kiriIslandBody* bodies, int32_t count)
{
    kiriMemory* memory = solver->memory;
    int64_t links = 0, corners = 0, areas = 0, shares = 0, pins = 0, clamps = 0, contacts = 0;
    int64_t yields = 0, frames = 0;
    KIRI_TIMES(n, count) {
        const kiriSolverBody* body = BodyOfMember(&bodies[n]);
        links += body->links.count;
        corners += body->corners.count;
        areas += body->elements.count;
        shares += bodies[n].solver->bodies.areaElements.shares.count;
        pins += bodies[n].sheet->pinCount;
        clamps += bodies[n].sheet->clampCount;
        contacts += bodies[n].sheet->contactCount;
        yields += bodies[n].sheet->yieldCount;
        frames += body->frames.count;
    }
    bool ok = kiriSolver_ReserveBodies(solver, yields, frames) && kiriArray_Reserve(memory, &solver->islandLinks, links) &&
              kiriArray_Reserve(memory, &solver->islandCorners, corners) &&
              kiriArray_Reserve(memory, &solver->islandElements.elements, areas) &&
              kiriArray_Reserve(memory, &solver->islandElements.shares, shares) &&
              ReserveTaken(solver, pins, clamps, contacts);
    kiriSystem system = SumSystems(solver, bodies, count);
    kiriAreaElements* elements = &solver->islandElements;
    elements->elements.count = elements->shares.count = 0;
    solver->islandLinks.count = solver->islandCorners.count = 0;
    KIRI_TIMES_WHILE(ok, n, count) {
        TakeElements(solver, &bodies[n]);
    }
    system.links = solver->islandLinks.data;
    system.corners = solver->islandCorners.data;
    return ok && ReserveSteps(solver, &system);
}

bool kiriSolver_PrepareIsland(kiriSolver* solver, kiriMemory* memory, kiriIslandMatrix* island,
                              const kiriIslandBody* bodies, int32_t count, kiriStitchRow* stitches)
{
    int32_t frames = 0;
    bool ok = true;
    KIRI_TIMES(n, count) {
        BodyOfMember(&bodies[n])->island = frames;
        frames += BodyOfMember(&bodies[n])->frames.count;
    }
    island->next.count = 0;
    KIRI_TIMES_WHILE(ok, n, count) {
        ok = AddBodyPairs(memory, island, &bodies[n]) && AddContactPairs(memory, island, &bodies[n]);
    }
    if (!ok || !AddStitchPairs(memory, island, stitches) || !ReserveIsland(solver, bodies, count)) {
        return false;
    }
    if (island->matrix != NULL && island->matrix->size == solver->size && island->matrix->count == frames &&
        island->pairs.count == island->next.count &&
        (island->next.count == 0 || /* one frame */
         memcmp(island->pairs.data, island->next.data, sizeof(kiriPair) * (size_t)island->next.count) == 0)) {
        return true;
    }
    kiriMatrix_Destroy(island->matrix);
    island->matrix = kiriMatrix_Create(memory, solver->size);
    if (island->matrix == NULL || !kiriMatrix_Shape(island->matrix, frames, island->next.data, island->next.count)) {
        kiriMatrix_Destroy(island->matrix);
        island->matrix = NULL;
        return false;
    }
    kiriArray_Swap(&island->pairs, &island->next);
    return true;
}

/* ---- A step ------------------------------------------------------------------------------------------------------ */

static bool IsReadable(const kiriSolver* solver, int32_t frameCount)
{
    KIRI_TIMES(f, frameCount) {
        if (!kiriFrame_FitsFloats(&solver->after.data[f])) {
            return false;
        }
    }
    return true;
}

static void WriteFrames(const kiriSolver* solver, const kiriSystem* system)
{
    KIRI_TIMES(f, system->frameCount) {
        kiriFrameData* frame = solver->sources.data[f];
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

/* Clears histories after contacts or moving holds: their forces do not predict the next step. */
static void ForgetHistories(kiriSolver* solver, const kiriSystem* system)
{
    bool isEuler = system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER;
    if (isEuler || solver->isTouched || kiriSolver_AreTouching(solver, system, solver->poses.data)) {
        KIRI_TIMES(f, system->frameCount) {
            KIRI_CLEAR(&solver->after.data[f].history);
        }
    }
}

/* Keeps the flow of the step: in the sheets, and in clamps. */
static void KeepFlow(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t n = 0, first = 0; system->flows != NULL && n < solver->islandCount; ++n) {
        const kiriIslandBody* member = &solver->islandBodies[n];
        const kiriSystem* sheet = member->sheet;
        kiriSpan links = BodyOfMember(member)->links;
        for (int32_t k = first; sheet->plastics != NULL && k < first + links.count; ++k) {
            int32_t link = member->solver->bodies.links.data[links.first + k - first];
            if (solver->search.now.flow > 0.0 || sheet->plastics[link].reach > 0.0) {
                double strain[KIRI_MOST_STRAINS];
                kiriElement_Measure(system, k, solver->poses.data, strain, NULL);
                kiriStrain_EndFlow(&system->flows[k], strain, &sheet->plastics[link], sheet->strainOffsets[link].strain);
            }
        }
        first += links.count;
    }
    KIRI_TIMES(k, system->clampCount) {
        kiriClampRow* row = &system->clamps[k];
        if (row->keptPlastic != NULL) {
            double strain[KIRI_CLAMP_STRAINS];
            kiriClamp_Measure(row, &system->frames[row->frame], &row->pose, &solver->poses.data[row->frame], strain, NULL);
            kiriStrain_EndFlow(&row->yield, strain, row->keptPlastic, row->keptOffset);
        }
    }
}

int32_t kiriSolver_StepIsland(kiriSolver* solver, kiriMatrix* matrix, const kiriIslandBody* bodies, int32_t count,
                              kiriStitchRow* stitches, double dt, int32_t iterations, int32_t most)
{
    KIRI_ASSERT(most >= 1 && iterations >= 1 && dt > 0.0);
    kiriSystem system = kiriSolver_Open(solver, bodies, count, matrix);
    system.stitches = stitches;
    kiriSolver_Begin(solver, &system, dt);
    int32_t done = kiriSolver_Minimise(solver, &system, kiriMin(iterations, most), most);
    if (done >= 0) {
        kiriSolver_LimitEnergy(solver, &system);
        ForgetHistories(solver, &system);
    }
    if (done < 0 || !IsReadable(solver, system.frameCount)) {
        return -1;
    }
    kiriSolver_EndContacts(solver, &system);
    kiriSolver_EndReactions(solver, &system);
    KeepFlow(solver, &system);
    WriteFrames(solver, &system);
    KIRI_TIMES(k, system.clampCount) {
        solver->clampRows.data[k]->start = solver->clampRows.data[k]->pose;
    }
    return done;
}

int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* sheet, int32_t body, double dt, int32_t iterations,
                        int32_t most)
{
    const kiriIslandBody alone = { solver, sheet, body };
    KIRI_ASSERT_HAS(solver->bodies.bodies, body);
    return kiriSolver_StepIsland(solver, solver->bodies.bodies.data[body].matrix, &alone, 1, NULL, dt, iterations, most);
}

/* ---- Elements ---------------------------------------------------------------------------------------------------- */

static const kiriAreaElement* AreaElementOf(const kiriSystem* system, int32_t k)
{
    return &system->areaElements->elements.data[k - kiriElement_LinkCount(system) - kiriElement_CornerCount(system)];
}

int kiriElement_StrainCount(const kiriSystem* system, int32_t k)
{
    bool planar = system->mechanics.planar, isAffine = kiriMechanics_IsAffine(&system->mechanics);
    if (kiriElement_Corner(system, k) != NULL) {
        return planar || isAffine ? 1 : KIRI_TRACES;
    }
    if (kiriElement_Link(system, k) == NULL) {
        return AreaElementOf(system, k)->lastRow - AreaElementOf(system, k)->firstRow;
    }
    return isAffine ? (planar ? (int)KIRI_AFFINE_BENDING : (int)KIRI_AFFINE_STRAINS)
                    : (planar ? (int)KIRI_PLANE_BENDING + 1 : (int)KIRI_STRAINS);
}

int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Clamp(system, k) != NULL) {
        members[0] = kiriElement_Clamp(system, k)->frame;
        return 1;
    }
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
    KIRI_EACH_INDEX(m, *element) {
        members[m] = system->areaElements->shares.data[element->first + m].frame;
        KIRI_ASSERT(members[m] >= 0 && members[m] < system->frameCount);
        KIRI_ASSERT(m == 0 || members[m - 1] < members[m]);
    }
    return element->count;
}

int32_t kiriElement_MostMembers(const kiriSystem* system)
{
    int32_t most = kiriElement_CornerCount(system) > 0 ? 4 : 2;
    KIRI_TIMES_WHILE(system->areaElements != NULL, k, system->areaElements->elements.count) {
        most = kiriMax(system->areaElements->elements.data[k].count, most);
    }
    return most;
}

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness)
{
    const kiriLink* link = kiriElement_Link(system, k);
    const kiriCorner* corner = kiriElement_Corner(system, k);
    if (corner != NULL) {
        double all[KIRI_TRACES];
        kiriTrace_Stiffness(corner, kiriSystem_MaterialOf(system, system->links[corner->link[0]].i), all);
        bool isAffine = kiriMechanics_IsAffine(&system->mechanics);
        stiffness[0] = all[isAffine ? KIRI_TRACE_CURVATURE : KIRI_TRACE_STRETCH];
        stiffness[1] = all[KIRI_TRACE_CURVATURE]; /* counts where it has two strains */
    } else if (link == NULL) {
        const kiriAreaElement* element = AreaElementOf(system, k);
        int32_t first = system->areaElements->shares.data[element->first].frame;
        kiriAreaElement_Stiffness(element, kiriSystem_MaterialOf(system, first), stiffness);
    } else if (kiriElement_Clamp(system, k) != NULL) {
        kiriClamp_Stiffness(kiriElement_Clamp(system, k), stiffness);
        return;
    } else {
        kiriLink seen = *link;
        double free = system->linkParts != NULL ? system->linkParts[k].free : 1.0;
        seen.outer *= free;
        seen.beyond *= free;
        if (kiriMechanics_IsAffine(&system->mechanics)) {
            kiriAffine_Stiffness(&seen, kiriSystem_MaterialOf(system, link->i), stiffness);
        } else {
            kiriStrain_Stiffness(&seen, kiriSystem_MaterialOf(system, link->i), stiffness);
        }
    }
    /* A corner counts as much as the link that counts least. */
    double part = system->linkParts != NULL && link != NULL ? system->linkParts[k].part : 1.0;
    KIRI_TIMES_WHILE(system->linkParts != NULL && corner != NULL, n, corner->count) {
        part = kiriMin(system->linkParts[corner->link[n]].part, part);
    }
    KIRI_TIMES_WHILE(part < 1.0, e, kiriElement_StrainCount(system, k)) {
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
    kiriStrain_Measure(link, kiriSystem_MaterialOf(system, link->i), ends.frames, endPoses,
                       kiriSystem_Turned(system, link), strain, rows);
}

static void MeasureRigidRows(const kiriSystem* system, const kiriLink* link, const kiriPose* poses, double* strain,
                             kiriFrameRow* rows)
{
    kiriStrainRow found[KIRI_STRAINS];
    MeasureRigidLink(system, link, poses, strain, rows != NULL ? found : NULL);
    KIRI_TIMES_WHILE(rows != NULL, e, KIRI_STRAINS) {
        KIRI_TIMES(end, 2) {
            rows[2 * e + end].by[0] = found[e].end[end].move;
            rows[2 * e + end].by[1] = found[e].end[end].turn;
        }
    }
}

static void MeasureCorner(const kiriSystem* system, const kiriCorner* corner, const kiriPose* poses, double* strain,
                          kiriFrameRow* rows)
{
    int32_t count = corner->count, traces = system->mechanics.planar ? KIRI_TRACE_STRETCH + 1 : KIRI_TRACES;
    double strains[4][KIRI_STRAINS];
    kiriStrainRow found[4][KIRI_STRAINS];
    const double* const all[4] = { strains[0], strains[1], strains[2], strains[3] };
    KIRI_TIMES(k, count) {
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
    KIRI_TIMES(k, count) {
        KIRI_TIMES(s, 2 * traces) {
            const kiriStrainRow* row = &found[k][kiriTrace_Source(s)];
            KIRI_TIMES(end, 2) {
                kiriVec3* by = rows[count * (s / 2) + ends[k][end]].by;
                by[0] = kiriVec3_AddScaled(by[0], trace.by[k][s], row->end[end].move);
                by[1] = kiriVec3_AddScaled(by[1], trace.by[k][s], row->end[end].turn);
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
    KIRI_EACH_INDEX(k, *corner) {
        LinkEnds link = LinkEndsOf(system, &system->links[corner->link[k]], poses);
        const kiriPose* const endPoses[2] = { &link.poses[0], &link.poses[1] };
        kiriFrameRow* own[2] = { 0 };
        KIRI_TIMES_WHILE(rows != NULL, end, 2) {
            own[end] = &rows[ends[k][end]];
        }
        kiriAffine_AddTrace(corner->weight[k], endPoses, strain, rows != NULL ? own : NULL);
    }
}

void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain, kiriFrameRow* rows)
{
    const kiriLink* link = kiriElement_Link(system, k);
    const kiriClampRow* clamp = kiriElement_Clamp(system, k);
    if (clamp != NULL) {
        const kiriFrameData* frame = &system->frames[clamp->frame];
        kiriPose pose = poses != NULL ? poses[clamp->frame] : kiriPose_Of(frame);
        kiriClamp_Measure(clamp, frame, &clamp->pose, &pose, strain, rows);
    } else if (kiriElement_Corner(system, k) != NULL && kiriMechanics_IsAffine(&system->mechanics)) {
        MeasureAffineCorner(system, kiriElement_Corner(system, k), poses, strain, rows);
    } else if (kiriElement_Corner(system, k) != NULL) {
        MeasureCorner(system, kiriElement_Corner(system, k), poses, strain, rows);
    } else if (link == NULL) {
        kiriAreaElement_Measure(AreaElementOf(system, k), system->areaElements->shares.data, system->frames, poses,
                                strain, rows);
    } else if (kiriMechanics_IsAffine(&system->mechanics)) {
        LinkEnds ends = LinkEndsOf(system, link, poses);
        const kiriPose* const endPoses[2] = { &ends.poses[0], &ends.poses[1] };
        kiriAffine_Measure(link, kiriSystem_MaterialOf(system, link->i), ends.frames, endPoses, strain,
                           (kiriFrameRow(*)[2])rows);
    } else {
        MeasureRigidRows(system, link, poses, strain, rows);
    }
}

kiriTrace kiriElement_Trace(const kiriSystem* system, int32_t k, const double* strains, size_t each)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    const double* all[4] = { 0 };
    KIRI_ASSERT(corner != NULL && corner->count <= 4);
    KIRI_EACH_INDEX(n, *corner) {
        all[n] = &strains[each * (size_t)corner->link[n]];
    }
    return kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
}

/* Offsets of a corner are the traces of its links' offsets: they do not change in folds. */
void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling)
{
    int count = kiriElement_StrainCount(system, k);
    const double* own = kiriElement_Offset(system, k);
    if (own != NULL) {
        kiriStrain_TakeOffsets(strain, own, count, kiriMechanics_IsAffine(&system->mechanics), pulling);
        return;
    }
    memcpy(pulling, strain, sizeof(double) * (size_t)count);
    if (system->strainOffsets != NULL && kiriElement_IsRigidCorner(system, k)) {
        kiriTrace offset = kiriElement_Trace(system, k, system->strainOffsets->strain, KIRI_STRAINS);
        KIRI_TIMES(e, count) {
            pulling[e] = strain[e] - offset.strain[e];
        }
    }
}

double kiriElement_Energy(const kiriSystem* system, int32_t k)
{
    double strain[KIRI_MOST_STRAINS], stiffness[KIRI_MOST_STRAINS], pulling[KIRI_MOST_STRAINS], sum = 0.0;
    kiriElement_Measure(system, k, NULL, strain, NULL);
    kiriElement_Stiffness(system, k, stiffness);
    kiriElement_TakeOffsets(system, k, strain, pulling);
    KIRI_TIMES(e, kiriElement_StrainCount(system, k)) {
        sum += 0.5 * stiffness[e] * pulling[e] * pulling[e];
    }
    return sum;
}

double kiriSolver_ElasticEnergy(const kiriSystem* system)
{
    double sum = 0.0;
    KIRI_TIMES(k, kiriElement_Count(system)) {
        sum += kiriElement_Energy(system, k);
    }
    return sum;
}

#define FADE_GAIN 0.05 /* most that a fade adds to a link: of its energy, or of its weight times its length */
#define FADE_TRIALS 4  /* the last one fades an eighth as much; then the fade waits */

void kiriSolver_FadeOffsets(const kiriSystem* system, kiriStrainOffset* offsets, const kiriPlastic* plastics,
                            const kiriIndices* links, double keep, bool mayTouch)
{
    const kiriStrainOffset none = { { 0.0 } };
    double g = mayTouch ? kiriVec3_Length(kiriSystem_Gravity(system)) : 0.0;
    KIRI_EACH(const int32_t, at, *links) {
        int32_t k = *at;
        KIRI_ASSERT(k >= 0 && k < system->linkCount);
        const kiriLink* link = &system->links[k];
        kiriStrainOffset was = offsets[k];
        bool isLimited = g > 0.0 && memcmp(&was, &none, sizeof(none)) != 0;
        double before = isLimited ? kiriElement_Energy(system, k) : 0.0, part = keep;
        double most = before + FADE_GAIN * kiriMax(before, system->frames[link->i].mass * g * link->length);
        KIRI_TIMES_WHILE(trial == 0 || (isLimited && kiriElement_Energy(system, k) > most), trial, FADE_TRIALS + 1) {
            offsets[k] = was;
            kiriStrainOffset_Fade(offsets[k].strain, plastics != NULL ? &plastics[k] : NULL, KIRI_STRAINS, part);
            part = trial + 1 < FADE_TRIALS ? 0.5 * (1.0 + part) : 1.0;
        }
    }
}
