#include "kiri_refit.h"

/* ---- Dirty squares ----------------------------------------------------------------------------------------------- */

static bool NoteSquare(kiriOwnership* ownership, kiriMemory* memory, int32_t square)
{
    KIRI_ASSERT_HAS(ownership->isDirty, square);
    if (!ownership->isDirty.data[square] && !kiriArray_Push(memory, &ownership->dirty, square)) {
        return false;
    }
    ownership->isDirty.data[square] = 1;
    return true;
}

static bool ReserveOwners(kiriOwnership* ownership, const kiriMeshData* mesh)
{
    int32_t count = mesh->squares.columns * mesh->squares.rows;
    if (!kiriArray_ReserveJust(mesh->memory, &ownership->squares, count) ||
        !kiriArray_ReserveJust(mesh->memory, &ownership->isDirty, count)) {
        return false;
    }
    while (ownership->squares.count < count) {
        KIRI_NEXT(ownership->squares) = (kiriSquareOwners){ KIRI_NONE, { 0, 0 } };
        KIRI_NEXT(ownership->isDirty) = 0;
    }
    return true;
}

bool kiriOwnership_NoteDirty(kiriOwnership* ownership, const kiriMeshData* mesh)
{
    bool ok = ReserveOwners(ownership, mesh);
    KIRI_EACH_WHILE(ok, const int32_t, square, mesh->squares.dirty) {
        ok = NoteSquare(ownership, mesh->memory, *square);
    }
    return ok;
}

bool kiriOwnership_NoteChanges(kiriOwnership* ownership, const kiriGrid* grid, const kiriRegions* regions)
{
    bool ok = ReserveOwners(ownership, grid->mesh);
    KIRI_EACH_WHILE(ok, const kiriSeed, change, regions->changes) {
        int32_t cell = change->cell;
        ok = !kiriGrid_IsCell(grid, cell) || NoteSquare(ownership, grid->mesh->memory, grid->cells.data[cell].square);
    }
    return ok;
}

/* ---- Staging -----------------------------------------------------------------------------------------------------

   A triangle is convex, so its material in a square lies in one cell; and cells only ever fall apart, so the parts that
   the triangle has there later were in that cell. */

/* Returns the owner before the update. A part that rounding brought into a square where its triangle was not goes to
   the lowest owner there. */
static int32_t OwnerBefore(const kiriOwnership* ownership, const kiriMeshData* mesh, int32_t square, int32_t triangle)
{
    KIRI_ASSERT(square >= 0 && square < ownership->squares.count && triangle >= 0);
    const kiriSquareOwners* owners = &ownership->squares.data[square];
    int32_t lowest = INT32_MAX;
    if (owners->parts.count == 0) {
        return owners->owner;
    }
    while (triangle >= ownership->triangleCount) {
        triangle = mesh->triangles.data[triangle].parent;
    }
    KIRI_FROM_TO(k, owners->parts.first, owners->parts.first + owners->parts.count) {
        const kiriTriangleOwner* owned = &ownership->triangleOwners.data[k];
        if (owned->triangle == triangle) {
            return owned->owner;
        }
        lowest = kiriMin(owned->owner, lowest);
    }
    return lowest;
}

/* Returns the transfer between two frames, a new one where there was none; null when out of memory. */
static kiriTransfer* FindTransfer(kiriOwnership* ownership, kiriMemory* memory, int32_t to, int32_t from)
{
    KIRI_ASSERT(to >= 0 && to < ownership->first.count && from >= 0 && from < ownership->first.count);
    int32_t before = KIRI_NONE, at = ownership->first.data[to], index = ownership->transfers.count;
    while (at != KIRI_NONE && ownership->transfers.data[at].from < from) {
        before = at;
        at = ownership->transfers.data[at].next;
    }
    if (at != KIRI_NONE && ownership->transfers.data[at].from == from) {
        return &ownership->transfers.data[at];
    }
    kiriTransfer transfer = { .from = from, .next = at };
    if (!kiriArray_Push(memory, &ownership->transfers, transfer)) {
        return NULL;
    }
    *(before == KIRI_NONE ? &ownership->first.data[to] : &ownership->transfers.data[before].next) = index;
    return &ownership->transfers.data[index];
}

/* Finds the material of a square that changes owner, and stages its owners. A square without cells has none. */
static bool StageSquare(kiriOwnership* ownership, const kiriGrid* grid, const int32_t* owner, int32_t square)
{
    const kiriMeshData* mesh = grid->mesh;
    int32_t cell = grid->squareCell.data[square];
    KIRI_EACH_CELL(c, grid, square) {
        int32_t from = OwnerBefore(ownership, mesh, square, grid->cells.data[c].triangle);
        if (from != KIRI_NONE && from != owner[c]) {
            kiriTransfer* transfer = FindTransfer(ownership, mesh->memory, owner[c], from);
            kiriMoments material = kiriGrid_Material(grid, c);
            if (transfer == NULL) {
                return false;
            }
            kiriTally_Add(&transfer->material, &material, 1, KIRI_LATTICE * mesh->step);
        }
    }
    if (cell == KIRI_NONE) {
        return true;
    }
    kiriStagedOwners staged = { square, { owner[cell], { 0, 0 } } };
    bool isDivided = grid->cells.data[cell].next != KIRI_NONE;
    int32_t count = isDivided ? kiriSquares_CountNodes(&mesh->squares, square) : 0;
    if (!kiriArray_ReserveMore(mesh->memory, &ownership->staged, 1) ||
        !kiriSpan_Resize(&staged.owners.parts, &ownership->spans, mesh->memory, &ownership->triangleOwners,
                         sizeof(kiriTriangleOwner), count)) {
        return false;
    }
    int32_t n = mesh->squares.head[square];
    for (int32_t k = 0; k < count; ++k, n = mesh->squares.nodes.data[n].next) {
        ownership->triangleOwners.data[staged.owners.parts.first + k] =
            (kiriTriangleOwner){ mesh->squares.nodes.data[n].triangle, owner[grid->nodeCell.data[n]] };
    }
    KIRI_NEXT(ownership->staged) = staged;
    return true;
}

static void FreeParts(kiriOwnership* ownership, kiriSpan* parts)
{
    /* To give back never fails. */
    kiriSpan_Resize(parts, &ownership->spans, NULL, &ownership->triangleOwners, sizeof(kiriTriangleOwner), 0);
}

static void DropStagedOwners(kiriOwnership* ownership)
{
    KIRI_EACH(kiriStagedOwners, staged, ownership->staged) {
        FreeParts(ownership, &staged->owners.parts);
    }
    ownership->staged.count = ownership->transfers.count = ownership->next = 0;
    ownership->due = 0;
}

kiriProgress kiriRefit_Stage(kiriRefit* refit, const kiriGrid* grid, const kiriRegions* regions, bool isScratch,
                             kiriQuota* quota)
{
    enum { WHOLE_AN_ITEM = 8, NODES_AN_ITEM = 8 };
    kiriOwnership* ownership = &refit->ownership;
    kiriMemory* memory = grid->mesh->memory;
    int32_t frameCount = regions->material.count;
    if (ownership->next == 0) {
        DropStagedOwners(ownership);
        bool ok = ReserveOwners(ownership, grid->mesh) && kiriArray_Resize(memory, &ownership->first, frameCount);
        kiriArray_Set(&ownership->first, KIRI_NONE);
        KIRI_EACH_INDEX_WHILE(ok && isScratch, s, ownership->isDirty) {
            ok = NoteSquare(ownership, memory, s);
        }
        if (!ok) {
            return KIRI_FAILED;
        }
    }
    KIRI_ASSERT(ownership->first.count == frameCount);
    while (!kiriMemory_MustPause(memory) && kiriQuota_Pay(quota, &ownership->due) &&
           ownership->next < ownership->dirty.count) {
        int32_t square = ownership->dirty.data[ownership->next++], cell = grid->squareCell.data[square];
        bool isDivided = cell != KIRI_NONE && grid->cells.data[cell].next != KIRI_NONE;
        if (!StageSquare(ownership, grid, regions->field.owner.data, square)) {
            ownership->next = 0;
            return KIRI_FAILED;
        }
        ownership->due = isDivided ? 1 + kiriSquares_CountNodes(&grid->mesh->squares, square) / NODES_AN_ITEM
                                   : ownership->next % WHOLE_AN_ITEM == 0;
    }
    if (ownership->due > 0 || ownership->next < ownership->dirty.count) {
        return KIRI_MORE;
    }
    refit->most = 0;
    KIRI_TIMES(f, frameCount) {
        refit->most += ownership->first.data[f] != KIRI_NONE;
    }
    bool hasRoom =
        kiriArray_Reserve(memory, &refit->fits, refit->most) && kiriArray_Reserve(memory, &refit->bodies, frameCount);
    return hasRoom ? KIRI_DONE : KIRI_FAILED;
}

void kiriRefit_Drop(kiriRefit* refit)
{
    kiriOwnership* ownership = &refit->ownership;
    DropStagedOwners(ownership);
    KIRI_EACH(const int32_t, square, ownership->dirty) {
        ownership->isDirty.data[*square] = 0;
    }
    ownership->dirty.count = 0;
    refit->fits.count = 0;
}

void kiriRefit_Commit(kiriRefit* refit, const kiriMeshData* mesh)
{
    kiriOwnership* ownership = &refit->ownership;
    KIRI_EACH(const kiriStagedOwners, staged, ownership->staged) {
        kiriSquareOwners* owners = &ownership->squares.data[staged->square];
        FreeParts(ownership, &owners->parts);
        *owners = staged->owners;
    }
    ownership->staged.count = 0; /* their parts are in place */
    ownership->triangleCount = mesh->triangles.count;
    kiriRefit_Drop(refit);
}

void kiriOwnership_Keep(kiriOwnership* ownership, const kiriGrid* grid, const kiriRegions* regions,
                        const kiriKeep* triangles, const kiriKeep* frames, const int32_t* of, int32_t count)
{
    KIRI_ASSERT(ownership->dirty.count == 0 && ownership->staged.count == 0);
    kiriTriangleOwner* owned = ownership->triangleOwners.data;
    KIRI_TIMES(k, count) {
        kiriSpan* parts = &ownership->squares.data[of[k]].parts;
        int32_t cell = grid->squareCell.data[of[k]], kept = 0;
        bool isDivided = cell != KIRI_NONE && grid->cells.data[cell].next != KIRI_NONE;
        KIRI_FROM_TO_WHILE(isDivided, p, parts->first, parts->first + parts->count) {
            if (kiriKeep_Has(triangles, owned[p].triangle)) {
                owned[parts->first + kept++] = owned[p];
            }
        }
        /* To shrink never fails. */
        kiriSpan_Resize(parts, &ownership->spans, NULL, &ownership->triangleOwners, sizeof(kiriTriangleOwner), kept);
    }
    bool moves = kiriKeep_Moves(triangles) || kiriKeep_Moves(frames);
    KIRI_EACH_WHILE(moves, kiriSquareOwners, owners, ownership->squares) {
        owners->owner = kiriKeep_To(frames, owners->owner);
        KIRI_FROM_TO(p, owners->parts.first, owners->parts.first + owners->parts.count) {
            owned[p].triangle = kiriKeep_To(triangles, owned[p].triangle);
            owned[p].owner = kiriKeep_To(frames, owned[p].owner);
        }
    }
    KIRI_TIMES(k, count) {
        int32_t cell = grid->squareCell.data[of[k]];
        ownership->squares.data[of[k]].owner = cell == KIRI_NONE ? KIRI_NONE : regions->field.owner.data[cell];
    }
    ownership->triangleCount = grid->mesh->triangles.count;
}

/* ---- Fits --------------------------------------------------------------------------------------------------------

   The part of a new region that comes from one frame moved, before the commit, as a frame would that has the mass and
   centre of that part. So the functions for frames serve for parts. */

typedef struct MotionFit {
    const kiriOwnership* ownership;
    const kiriFrameData* frames;
    int32_t frameCount;
    const kiriMaterial* material;
    double extent, densityPerArea;
    bool isRigid;

    kiriFrameData* state; /* result; its centre, x and velocity are final before the second pass */
    double mass;          /* sum over the parts */
    kiriMat3 A, rate;     /* their means */
    kiriMat3 stretch;     /* of A without its rotation, the mean */
    kiriMat3 positions;   /* integral of density times position times the rest way from the centre, */
    kiriMat3 velocities;  /* and of density times velocity times that way */
    kiriVec3 angular;     /* momentum about the centre */
    double energy;        /* kinetic */
} MotionFit;

/* Subtracts exactly, so that an empty sum is zero. */
static void SubtractTally(kiriTally* sum, const kiriTally* part)
{
    KIRI_TIMES(k, 6) {
        kiriExact* to = &sum->of[k];
        to->high -= part->of[k].high;
        to->low -= part->of[k].low;
        if (to->low < 0) {
            to->low += (int64_t)1 << 62;
            to->high -= 1;
        }
    }
}

/* Visits the part with the material of a tally, as it moved before. */
static void VisitPart(MotionFit* fit, int32_t from, const kiriTally* tally,
                      void visit(MotionFit* fit, const kiriFrameData* part))
{
    kiriMoments material = kiriTally_Moments(tally, fit->extent);
    if (material.area > 0.0 && from < fit->frameCount) {
        kiriFrameData part = fit->frames[from];
        kiriFrame_Recenter(&part, &material, fit->densityPerArea);
        visit(fit, &part);
    }
}

/* Visits the part that stayed with the frame, then the parts that came to it. */
static void VisitParts(MotionFit* fit, int32_t frame, const kiriTally* region,
                       void visit(MotionFit* fit, const kiriFrameData* part))
{
    KIRI_ASSERT_HAS(fit->ownership->first, frame);
    const kiriTransfer* transfers = fit->ownership->transfers.data;
    kiriTally kept = *region;
    for (int32_t k = fit->ownership->first.data[frame]; k != KIRI_NONE; k = transfers[k].next) {
        SubtractTally(&kept, &transfers[k].material);
    }
    VisitPart(fit, frame, &kept, visit);
    for (int32_t k = fit->ownership->first.data[frame]; k != KIRI_NONE; k = transfers[k].next) {
        VisitPart(fit, transfers[k].from, &transfers[k].material, visit);
    }
}

static void SumMeans(MotionFit* fit, const kiriFrameData* part)
{
    kiriFrameData* sum = fit->state;
    kiriMat3 rate = kiriFrame_Rate(part);
    fit->mass += part->mass;
    sum->x = kiriVec3_AddScaled(sum->x, part->mass, part->x);
    sum->velocity = kiriVec3_AddScaled(sum->velocity, part->mass, part->velocity);
    sum->spin = kiriVec3_AddScaled(sum->spin, part->mass, part->spin);
    fit->A = kiriMat3_AddScaled(&fit->A, part->mass, &part->A);
    kiriMat3 turn = kiriMat3_Rotation(part->A);
    kiriMat3 stretch = { kiriMat3_MulTransposed(&turn, part->A.u), kiriMat3_MulTransposed(&turn, part->A.v),
                         kiriMat3_MulTransposed(&turn, part->A.d) };
    fit->stretch = kiriMat3_AddScaled(&fit->stretch, part->mass, &stretch);
    fit->rate = kiriMat3_AddScaled(&fit->rate, part->mass, &rate);
}

/* Adds the integral of density times position times the way from the centre at rest over a part: its centre is at
   `off`, and its slope is `slope`. The same for velocity. */
static void AddPartIntegral(const MotionFit* fit, kiriMat3* sum, const kiriFrameData* part, kiriVec3 off,
                            const kiriMat3* slope)
{
    kiriMassMoments m = kiriFrame_MassMoments(part, fit->material);
    kiriVec2 way = kiriVec2_Sub(part->center, fit->state->center);
    kiriMat3 integral = { kiriVec3_AddScaled(kiriVec3_Scale(m.uu, slope->u), m.uv, slope->v),
                          kiriVec3_AddScaled(kiriVec3_Scale(m.vv, slope->v), m.uv, slope->u),
                          kiriVec3_Scale(m.dd, slope->d) };
    integral.u = kiriVec3_AddScaled(integral.u, part->mass * way.x, off);
    integral.v = kiriVec3_AddScaled(integral.v, part->mass * way.y, off);
    *sum = kiriMat3_AddScaled(sum, 1.0, &integral);
}

static void SumIntegrals(MotionFit* fit, const kiriFrameData* part)
{
    kiriVec3 off = kiriVec3_Sub(part->x, fit->state->x);
    kiriVec3 velocity = kiriVec3_Sub(part->velocity, fit->state->velocity);
    kiriMat3 rate = kiriFrame_Rate(part);
    AddPartIntegral(fit, &fit->positions, part, off, &part->A);
    AddPartIntegral(fit, &fit->velocities, part, velocity, &rate);
    fit->angular = kiriVec3_Add(fit->angular, kiriFrame_AngularMomentum(part, fit->material));
    fit->angular = kiriVec3_AddScaled(fit->angular, part->mass, kiriVec3_Cross(off, velocity));
    fit->energy += kiriFrame_KineticEnergy(part, fit->material);
}

/* Returns the slope whose integral comes nearest to `integral`. It starts from the mean slope, which stays across a
   region that is a thread. */
static kiriMat3 NearestSlope(const MotionFit* fit, const kiriMat3* mean, const kiriMat3* integral)
{
    kiriMassMoments m = kiriFrame_MassMoments(fit->state, fit->material);
    kiriVec3 u = kiriVec3_AddScaled(kiriVec3_AddScaled(integral->u, -m.uu, mean->u), -m.uv, mean->v);
    kiriVec3 v = kiriVec3_AddScaled(kiriVec3_AddScaled(integral->v, -m.uv, mean->u), -m.vv, mean->v);
    double least = 1e-12 * (m.uu + m.vv), uu = m.uu + least, vv = m.vv + least, det = uu * vv - m.uv * m.uv;
    kiriMat3 slope = *mean;
    slope.u = kiriVec3_AddScaled(kiriVec3_AddScaled(slope.u, vv / det, u), -m.uv / det, v);
    slope.v = kiriVec3_AddScaled(kiriVec3_AddScaled(slope.v, uu / det, v), -m.uv / det, u);
    return slope;
}

static void FitState(MotionFit* fit)
{
    kiriFrameData* state = fit->state;
    if (fit->isRigid) {
        state->A = kiriMat3_RotationFrom(kiriMat3_Rotation(fit->A), fit->positions);
        state->rate = (kiriMat3){ 0 };
    } else {
        kiriMat3 rate = NearestSlope(fit, &fit->rate, &fit->velocities);
        kiriMat3 slope = NearestSlope(fit, &fit->A, &fit->positions); /* parts that turn apart would shrink it */
        state->A = kiriMat3_MulMat(kiriMat3_Rotation(slope), fit->stretch);
        state->spin = kiriMat3_Spin(&state->A, &rate);
        state->rate = kiriMat3_Beside(&state->A, &rate, state->spin);
    }
    /* The spin makes up for the angular momentum that the slope alone would lose. */
    kiriVec3 missing = kiriVec3_Sub(fit->angular, kiriFrame_AngularMomentum(state, fit->material));
    kiriMat3 inertia = kiriFrame_Inertia(state, fit->material);
    state->spin = kiriVec3_Add(state->spin, kiriMat3_Solve(&inertia, missing));
}

/* Fits a frame; false where all its material is new. */
static bool FitFrame(MotionFit* fit, int32_t frame, const kiriTally* region, const kiriMoments* material)
{
    kiriVec3 zero = { 0 };
    kiriFrameData* state = fit->state;
    kiriFrame_Recenter(state, material, fit->densityPerArea);
    state->x = state->velocity = state->spin = fit->angular = zero;
    fit->A = fit->stretch = fit->rate = fit->positions = fit->velocities = (kiriMat3){ 0 };
    fit->mass = fit->energy = 0.0;
    VisitParts(fit, frame, region, SumMeans);
    if (!(fit->mass > 0.0)) {
        return false;
    }
    double share = 1.0 / fit->mass;
    state->x = kiriVec3_Scale(share, state->x);
    state->velocity = kiriVec3_Scale(share, state->velocity);
    state->spin = kiriVec3_Scale(share, state->spin);
    fit->A = kiriMat3_Scale(share, &fit->A);
    fit->stretch = kiriMat3_Scale(share, &fit->stretch);
    fit->rate = kiriMat3_Scale(share, &fit->rate);
    VisitParts(fit, frame, region, SumIntegrals);
    FitState(fit);
    return true;
}

void kiriRefit_Solve(kiriRefit* refit, const kiriFrameData* frames, int32_t frameCount, const kiriMeshData* mesh,
                     const kiriRegions* regions, const kiriMoments* regionMoments, const kiriMaterial* material,
                     bool isRigid)
{
    MotionFit fit = { .ownership = &refit->ownership,
                      .frames = frames,
                      .frameCount = frameCount,
                      .material = material,
                      .extent = KIRI_LATTICE * mesh->step,
                      .densityPerArea = (double)material->density * material->thickness,
                      .isRigid = isRigid };
    refit->fits.count = 0;
    KIRI_EACH_INDEX(f, refit->ownership.first) {
        if (refit->ownership.first.data[f] == KIRI_NONE || frames[f].held) {
            continue;
        }
        KIRI_ASSERT(refit->fits.count < refit->fits.capacity); /* Stage has made room */
        kiriFit* next = &refit->fits.data[refit->fits.count];
        next->state = frames[f];
        fit.state = &next->state;
        if (FitFrame(&fit, f, &regions->material.data[f], &regionMoments[f])) {
            next->frame = f;
            next->gained = kiriFrame_KineticEnergy(&next->state, material) - fit.energy;
            refit->fits.count += 1;
        }
    }
}

/* ---- Limit of energy ---------------------------------------------------------------------------------------------

   A region that is flatter than the parts it came from has less inertia, and turns faster with the same angular
   momentum: its kinetic energy grows. As a rule other fits of the piece have lost more. If not, the energy is taken out
   of the motion that the piece has beside moving and turning as one body, which leaves its momentum as it is. Only a
   piece that has no such motion turns slower. */

/* Returns sqrt(part / whole), at most 1; 0 if `part` is not positive. */
static double RootOfShare(double part, double whole)
{
    return part > 0.0 && whole > part ? sqrt(part / whole) : part > 0.0 ? 1.0 : 0.0;
}

/* Sums the momenta of the pieces. */
static void GatherBodies(kiriFitBody* bodies, int32_t pieceCount, const kiriFrameData* frames, int32_t frameCount,
                         const int32_t* framePiece, const kiriMaterial* material)
{
    KIRI_TIMES(f, frameCount) {
        kiriFitBody* body = &bodies[framePiece[f]];
        body->mass += frames[f].mass;
        body->energy += kiriFrame_KineticEnergy(&frames[f], material);
        body->x = kiriVec3_AddScaled(body->x, frames[f].mass, frames[f].x);
        body->velocity = kiriVec3_AddScaled(body->velocity, frames[f].mass, frames[f].velocity);
    }
    KIRI_TIMES(p, pieceCount) {
        KIRI_ASSERT(bodies[p].mass > 0.0);
        bodies[p].x = kiriVec3_Scale(1.0 / bodies[p].mass, bodies[p].x);
        bodies[p].velocity = kiriVec3_Scale(1.0 / bodies[p].mass, bodies[p].velocity);
    }
    KIRI_TIMES(f, frameCount) {
        kiriFitBody* body = &bodies[framePiece[f]];
        kiriVec3 arm = kiriVec3_Sub(frames[f].x, body->x);
        kiriVec3 velocity = kiriVec3_Sub(frames[f].velocity, body->velocity);
        kiriMat3 own = kiriFrame_Inertia(&frames[f], material);
        kiriMat3 point = kiriMat3_PointInertia(frames[f].mass, arm);
        body->inertia = kiriMat3_AddScaled(&body->inertia, 1.0, &own);
        body->inertia = kiriMat3_AddScaled(&body->inertia, 1.0, &point);
        body->angular = kiriVec3_Add(body->angular, kiriFrame_AngularMomentum(&frames[f], material));
        body->angular = kiriVec3_AddScaled(body->angular, frames[f].mass, kiriVec3_Cross(arm, velocity));
    }
}

void kiriRefit_LimitEnergy(kiriRefit* refit, kiriFrameData* frames, int32_t frameCount, const int32_t* framePiece,
                           int32_t pieceCount, const kiriMaterial* material)
{
    kiriFitBody* bodies = refit->bodies.data;
    double gained = 0.0, rounding = 0.0;
    KIRI_ASSERT(pieceCount <= refit->bodies.capacity && pieceCount <= frameCount);
    KIRI_EACH(const kiriFit, fit, refit->fits) {
        gained += fit->gained;
        rounding += 1e-13 * kiriFrame_KineticEnergy(&fit->state, material);
    }
    if (!(gained > rounding)) {
        return;
    }
    memset(bodies, 0, sizeof(*bodies) * (size_t)pieceCount);
    KIRI_EACH(const kiriFit, fit, refit->fits) {
        bodies[framePiece[fit->frame]].gained += fit->gained;
    }
    GatherBodies(bodies, pieceCount, frames, frameCount, framePiece, material);
    KIRI_TIMES(p, pieceCount) {
        kiriFitBody* body = &bodies[p];
        body->spin = kiriMat3_Solve(&body->inertia, body->angular);
        double moving = 0.5 * body->mass * kiriVec3_Dot(body->velocity, body->velocity);
        double turning = 0.5 * kiriVec3_Dot(body->spin, body->angular), due = body->energy - body->gained;
        body->beside = RootOfShare(due - moving - turning, body->energy - moving - turning);
        body->turning = body->beside > 0.0 ? 1.0 : RootOfShare(due - moving, turning);
    }
    KIRI_TIMES(f, frameCount) {
        const kiriFitBody* body = &bodies[framePiece[f]];
        if (body->gained > 0.0 && !frames[f].held) {
            kiriVec3 round = kiriVec3_Cross(body->spin, kiriVec3_Sub(frames[f].x, body->x));
            kiriVec3 rest = kiriVec3_Sub(kiriVec3_Sub(frames[f].velocity, body->velocity), round);
            kiriVec3 spin = kiriVec3_Sub(frames[f].spin, body->spin);
            frames[f].velocity =
                kiriVec3_AddScaled(kiriVec3_AddScaled(body->velocity, body->turning, round), body->beside, rest);
            frames[f].spin = kiriVec3_AddScaled(kiriVec3_Scale(body->turning, body->spin), body->beside, spin);
            frames[f].rate = kiriMat3_Scale(body->beside, &frames[f].rate);
        }
    }
}
