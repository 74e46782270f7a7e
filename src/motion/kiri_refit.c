#include "kiri_refit.h"

#include <string.h>

/* ---- Owners in force ----

   A triangle is convex, so what it has in a square lies in one cell; and cells only ever fall apart, so what the parts
   of the triangle have there later has lain in that cell. */

static bool NoteSquare(kiriOwnership* ownership, kiriMemory* memory, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < ownership->isDirty.count);
    if (!ownership->isDirty.data[square] && !kiriArray_Push(memory, &ownership->dirty, square)) {
        return false;
    }
    ownership->isDirty.data[square] = 1;
    return true;
}

static bool ReserveOwners(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh)
{
    int32_t count = mesh->squares.columns * mesh->squares.rows;
    const kiriSquareOwners none = { KIRI_NONE, { 0, 0 } };
    if (!kiriArray_ReserveJust(memory, &ownership->squares, count) ||
        !kiriArray_ReserveJust(memory, &ownership->isDirty, count)) {
        return false;
    }
    while (ownership->squares.count < count) {
        ownership->squares.data[ownership->squares.count++] = none;
        ownership->isDirty.data[ownership->isDirty.count++] = 0;
    }
    return true;
}

bool kiriOwnership_NoteDirty(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh)
{
    bool ok = ReserveOwners(ownership, memory, mesh);
    for (int32_t k = 0; ok && k < mesh->squares.dirty.count; ++k) {
        ok = NoteSquare(ownership, memory, mesh->squares.dirty.data[k]);
    }
    return ok;
}

bool kiriOwnership_NoteChanges(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                               const kiriMeshData* mesh, const kiriRegions* regions)
{
    bool ok = ReserveOwners(ownership, memory, mesh);
    for (int32_t k = 0; ok && k < regions->changes.count; ++k) {
        int32_t cell = regions->changes.data[k].cell;
        ok = !kiriGrid_IsCell(grid, cell) || NoteSquare(ownership, memory, grid->cells.data[cell].square);
    }
    return ok;
}

/* A part that rounding brought into a square where its triangle was not goes to the lowest owner there. */
static int32_t OwnerBefore(const kiriOwnership* ownership, const kiriMeshData* mesh, int32_t square, int32_t triangle)
{
    const kiriSquareOwners* owners = &ownership->squares.data[square];
    if (owners->parts.count == 0) {
        return owners->owner;
    }
    while (triangle >= ownership->triangleCount) {
        triangle = mesh->triangles.data[triangle].parent;
    }
    const kiriTriangleOwner* owned = &ownership->triangleOwners.data[owners->parts.first];
    int32_t lowest = owned[0].owner;
    for (int32_t k = 0; k < owners->parts.count; ++k) {
        if (owned[k].triangle == triangle) {
            return owned[k].owner;
        }
        lowest = kiriMin(owned[k].owner, lowest);
    }
    return lowest;
}

/* ---- Staging ---- */

/* The transfer between two frames, an empty one where there was none. */
static kiriTransfer* FindTransfer(kiriOwnership* ownership, kiriMemory* memory, int32_t to, int32_t from)
{
    KIRI_ASSERT(to >= 0 && to < ownership->first.count && from >= 0 && from < ownership->first.count);
    int32_t before = KIRI_NONE, at = ownership->first.data[to];
    while (at != KIRI_NONE && ownership->transfers.data[at].from < from) {
        before = at;
        at = ownership->transfers.data[at].next;
    }
    if (at != KIRI_NONE && ownership->transfers.data[at].from == from) {
        return &ownership->transfers.data[at];
    }
    kiriTransfer transfer = { from, at, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } } };
    if (!kiriArray_Push(memory, &ownership->transfers, transfer)) {
        return NULL;
    }
    int32_t index = ownership->transfers.count - 1;
    *(before == KIRI_NONE ? &ownership->first.data[to] : &ownership->transfers.data[before].next) = index;
    return &ownership->transfers.data[index];
}

static bool StageTransfers(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                           const kiriRegions* regions, int32_t square)
{
    double extent = kiriOwnership_Extent(mesh);
    for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
        int32_t to = regions->field.owner.data[c];
        int32_t from = OwnerBefore(ownership, mesh, square, grid->cells.data[c].triangle);
        if (from != KIRI_NONE && from != to) {
            kiriTransfer* transfer = FindTransfer(ownership, memory, to, from);
            if (transfer == NULL) {
                return false;
            }
            kiriMoments material = kiriGrid_Material(grid, mesh, c);
            kiriTally_Add(&transfer->material, &material, 1, extent);
        }
    }
    return true;
}

/* A square without material has no cells to own. */
static bool StageOwners(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, int32_t square)
{
    int32_t cell = grid->squareCell.data[square];
    if (cell == KIRI_NONE) {
        return true;
    }
    kiriStagedOwners staged = { square, { regions->field.owner.data[cell], { 0, 0 } } };
    bool isDivided = grid->cells.data[cell].next != KIRI_NONE;
    int32_t count = isDivided ? kiriSquares_CountNodes(&mesh->squares, square) : 0;
    if (!kiriArray_Reserve(memory, &ownership->staged, (int64_t)ownership->staged.count + 1) ||
        !kiriSpan_Resize(&staged.owners.parts, &ownership->spans, memory, &ownership->triangleOwners,
                         sizeof(kiriTriangleOwner), count)) {
        return false;
    }
    int32_t n = mesh->squares.head[square];
    for (int32_t k = 0; k < count; ++k, n = mesh->squares.nodes.data[n].next) {
        kiriTriangleOwner owned = { mesh->squares.nodes.data[n].triangle,
                                    regions->field.owner.data[grid->nodeCell.data[n]] };
        ownership->triangleOwners.data[staged.owners.parts.first + k] = owned;
    }
    ownership->staged.data[ownership->staged.count++] = staged;
    return true;
}

static void FreeParts(kiriOwnership* ownership, kiriSpan* parts)
{
    /* To give back never fails. */
    kiriSpan_Resize(parts, &ownership->spans, NULL, &ownership->triangleOwners, sizeof(kiriTriangleOwner), 0);
}

static void DropStagedOwners(kiriOwnership* ownership)
{
    for (int32_t k = 0; k < ownership->staged.count; ++k) {
        FreeParts(ownership, &ownership->staged.data[k].owners.parts);
    }
    ownership->staged.count = ownership->transfers.count = ownership->next = 0;
    ownership->due = 0;
}

static bool ClearTransfers(kiriOwnership* ownership, kiriMemory* memory, int32_t frameCount)
{
    DropStagedOwners(ownership);
    if (!kiriArray_Resize(memory, &ownership->first, frameCount)) {
        return false;
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        ownership->first.data[f] = KIRI_NONE;
    }
    return true;
}

static bool StartStaging(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh, int32_t frameCount,
                         bool isScratch)
{
    bool ok = ReserveOwners(ownership, memory, mesh) && ClearTransfers(ownership, memory, frameCount);
    for (int32_t s = 0; ok && isScratch && s < ownership->isDirty.count; ++s) {
        ok = NoteSquare(ownership, memory, s);
    }
    return ok;
}

/* Of the k-th dirty square. One that is not divided has one owner, which takes little. */
static int64_t ItemsOfSquare(const kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int32_t k)
{
    enum { WHOLE_AN_ITEM = 8, NODES_AN_ITEM = 8 };
    int32_t cell = grid->squareCell.data[square];
    bool isDivided = cell != KIRI_NONE && grid->cells.data[cell].next != KIRI_NONE;
    return isDivided ? 1 + kiriSquares_CountNodes(&mesh->squares, square) / NODES_AN_ITEM : k % WHOLE_AN_ITEM == 0;
}

kiriProgress kiriOwnership_Stage(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                                 const kiriMeshData* mesh, const kiriRegions* regions, bool isScratch, kiriQuota* quota)
{
    if (ownership->next == 0 && !StartStaging(ownership, memory, mesh, regions->material.count, isScratch)) {
        return KIRI_FAILED;
    }
    while (kiriQuota_Pay(quota, &ownership->due)) {
        if (ownership->next == ownership->dirty.count) {
            return KIRI_DONE;
        }
        int32_t square = ownership->dirty.data[ownership->next++];
        if (!StageTransfers(ownership, memory, grid, mesh, regions, square) ||
            !StageOwners(ownership, memory, grid, mesh, regions, square)) {
            return KIRI_FAILED;
        }
        ownership->due = ItemsOfSquare(grid, mesh, square, ownership->next);
    }
    return KIRI_MORE;
}

static void ClearDirtySquares(kiriOwnership* ownership)
{
    for (int32_t k = 0; k < ownership->dirty.count; ++k) {
        ownership->isDirty.data[ownership->dirty.data[k]] = 0;
    }
    ownership->dirty.count = 0;
}

void kiriOwnership_Drop(kiriOwnership* ownership)
{
    DropStagedOwners(ownership);
    ClearDirtySquares(ownership);
}

void kiriOwnership_Commit(kiriOwnership* ownership, const kiriMeshData* mesh)
{
    for (int32_t k = 0; k < ownership->staged.count; ++k) {
        kiriSquareOwners* owners = &ownership->squares.data[ownership->staged.data[k].square];
        FreeParts(ownership, &owners->parts);
        *owners = ownership->staged.data[k].owners;
    }
    ownership->staged.count = ownership->transfers.count = ownership->next = 0;
    ownership->triangleCount = mesh->triangles.count;
    ClearDirtySquares(ownership);
}

/* ---- What is left ---- */

/* Triangles of what is gone leave the parts of the square. */
static void DropParts(kiriOwnership* ownership, const kiriKeep* triangles, kiriSpan* parts)
{
    kiriTriangleOwner* owned = ownership->triangleOwners.data + parts->first;
    int32_t kept = 0;
    for (int32_t k = 0; k < parts->count; ++k) {
        if (kiriKeep_Has(triangles, owned[k].triangle)) {
            owned[kept++] = owned[k];
        }
    }
    /* To shrink never fails. */
    kiriSpan_Resize(parts, &ownership->spans, NULL, &ownership->triangleOwners, sizeof(kiriTriangleOwner), kept);
}

static void RenumberOwners(kiriOwnership* ownership, const kiriKeep* triangles, const kiriKeep* frames)
{
    for (int32_t s = 0; s < ownership->squares.count; ++s) {
        kiriSquareOwners* owners = &ownership->squares.data[s];
        if (owners->owner >= frames->first) {
            owners->owner = frames->to.data[owners->owner];
        }
        for (int32_t k = owners->parts.first; k < owners->parts.first + owners->parts.count; ++k) {
            kiriTriangleOwner* owned = &ownership->triangleOwners.data[k];
            owned->triangle = kiriKeep_To(triangles, owned->triangle);
            owned->owner = kiriKeep_To(frames, owned->owner);
        }
    }
}

void kiriOwnership_Keep(kiriOwnership* ownership, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, const kiriKeep* triangles, const kiriKeep* frames,
                        const int32_t* of, int32_t count)
{
    KIRI_ASSERT(ownership->dirty.count == 0 && ownership->staged.count == 0);
    for (int32_t k = 0; k < count; ++k) {
        kiriSquareOwners* owners = &ownership->squares.data[of[k]];
        int32_t cell = grid->squareCell.data[of[k]];
        bool isDivided = cell != KIRI_NONE && grid->cells.data[cell].next != KIRI_NONE;
        isDivided ? DropParts(ownership, triangles, &owners->parts) : FreeParts(ownership, &owners->parts);
    }
    if (kiriKeep_Moves(triangles) || kiriKeep_Moves(frames)) {
        RenumberOwners(ownership, triangles, frames);
    }
    for (int32_t k = 0; k < count; ++k) {
        int32_t cell = grid->squareCell.data[of[k]];
        ownership->squares.data[of[k]].owner = cell == KIRI_NONE ? KIRI_NONE : regions->field.owner.data[cell];
    }
    ownership->triangleCount = mesh->triangles.count;
}

kiriProgress kiriRefit_Stage(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                             const kiriRegions* regions, bool isScratch, kiriQuota* quota)
{
    kiriProgress progress = kiriOwnership_Stage(&refit->ownership, memory, grid, mesh, regions, isScratch, quota);
    refit->most = 0;
    for (int32_t f = 0; progress == KIRI_DONE && f < refit->ownership.first.count; ++f) {
        refit->most += refit->ownership.first.data[f] != KIRI_NONE;
    }
    int32_t frameCount = refit->ownership.first.count;
    bool hasRoom =
        kiriArray_Reserve(memory, &refit->fits, refit->most) && kiriArray_Reserve(memory, &refit->gained, frameCount) &&
        kiriArray_Reserve(memory, &refit->firstOf, frameCount) && kiriArray_Reserve(memory, &refit->nextOf, frameCount);
    return hasRoom ? progress : KIRI_FAILED;
}

void kiriRefit_Drop(kiriRefit* refit)
{
    kiriOwnership_Drop(&refit->ownership);
    refit->fits.count = 0;
}

void kiriRefit_Commit(kiriRefit* refit, const kiriMeshData* mesh)
{
    kiriOwnership_Commit(&refit->ownership, mesh);
    refit->fits.count = 0;
}

/* ---- Parts ----

   The part of a new region that comes from one frame moved, before the commit, as a frame would that has the mass and
   centre of that part. So the functions for frames serve for parts. */

typedef struct MotionFit {
    const kiriOwnership* ownership;
    const kiriFrameData* frames;
    int32_t frameCount;
    const kiriMaterial* material;
    double extent, densityPerArea;
    bool isRigid;

    kiriFrameData* state; /* that is sought; its centre, x and velocity are final before the second pass */
    double mass;          /* of the parts */
    kiriMat3 A, rate;     /* their means */
    kiriMat3 positions;   /* integral of density times position times the rest way from the centre, */
    kiriMat3 velocities;  /* and of density times velocity times that way */
    kiriVec3 angular;     /* momentum about the centre */
    double energy;        /* kinetic */
} MotionFit;

static void SubtractExact(kiriExact* sum, kiriExact part)
{
    sum->high -= part.high;
    sum->low -= part.low;
    if (sum->low < 0) {
        sum->low += (int64_t)1 << 62;
        sum->high -= 1;
    }
}

/* Exact, so that nothing is left where nothing stayed. */
static void SubtractTally(kiriTally* sum, const kiriTally* part)
{
    SubtractExact(&sum->area, part->area);
    SubtractExact(&sum->u, part->u);
    SubtractExact(&sum->v, part->v);
    SubtractExact(&sum->uu, part->uu);
    SubtractExact(&sum->uv, part->uv);
    SubtractExact(&sum->vv, part->vv);
}

/* The part with the material of a tally, as it moved before. */
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

/* What stayed with the frame, then what came to it. */
static void VisitParts(MotionFit* fit, int32_t frame, const kiriTally* region,
                       void visit(MotionFit* fit, const kiriFrameData* part))
{
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
    fit->rate = kiriMat3_AddScaled(&fit->rate, part->mass, &rate);
}

static void DivideMeans(MotionFit* fit)
{
    double share = 1.0 / fit->mass;
    fit->state->x = kiriVec3_Scale(share, fit->state->x);
    fit->state->velocity = kiriVec3_Scale(share, fit->state->velocity);
    fit->state->spin = kiriVec3_Scale(share, fit->state->spin);
    fit->A = kiriMat3_Scale(share, &fit->A);
    fit->rate = kiriMat3_Scale(share, &fit->rate);
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

/* The slope whose integral comes nearest to `integral`. It starts from the mean slope, which stays across a region that
   is a thread. */
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

/* The spin makes up for the angular momentum that the slope alone would lose. */
static void TakeMissingTurn(MotionFit* fit)
{
    kiriFrameData* state = fit->state;
    kiriVec3 missing = kiriVec3_Sub(fit->angular, kiriFrame_AngularMomentum(state, fit->material));
    kiriMat3 inertia = kiriFrame_Inertia(state, fit->material);
    state->spin = kiriVec3_Add(state->spin, kiriMat3_Solve(&inertia, missing));
}

static void FitState(MotionFit* fit)
{
    kiriFrameData* state = fit->state;
    if (fit->isRigid) {
        state->A = kiriMat3_RotationFrom(kiriMat3_Rotation(fit->A), fit->positions);
        state->rate = (kiriMat3){ 0 };
    } else {
        kiriMat3 rate = NearestSlope(fit, &fit->rate, &fit->velocities);
        state->A = NearestSlope(fit, &fit->A, &fit->positions);
        state->spin = kiriMat3_Spin(&state->A, &rate);
        state->rate = kiriMat3_Beside(&state->A, &rate, state->spin);
    }
    TakeMissingTurn(fit);
}

/* False where all the material is new. */
static bool FitFrame(MotionFit* fit, int32_t frame, const kiriTally* region, const kiriMoments* material)
{
    kiriVec3 zero = { 0.0, 0.0, 0.0 };
    kiriFrameData* state = fit->state;
    kiriFrame_Recenter(state, material, fit->densityPerArea);
    state->x = state->velocity = state->spin = fit->angular = zero;
    fit->A = fit->rate = fit->positions = fit->velocities = (kiriMat3){ 0 };
    fit->mass = fit->energy = 0.0;
    VisitParts(fit, frame, region, SumMeans);
    if (!(fit->mass > 0.0)) {
        return false;
    }
    DivideMeans(fit);
    VisitParts(fit, frame, region, SumIntegrals);
    FitState(fit);
    return true;
}

void kiriRefit_Solve(kiriRefit* refit, const kiriFrameData* frames, int32_t frameCount, const kiriMeshData* mesh,
                     const kiriRegions* regions, const kiriMoments* regionMoments, const kiriMaterial* material,
                     bool isRigid)
{
    MotionFit fit;
    memset(&fit, 0, sizeof(fit));
    fit.ownership = &refit->ownership;
    fit.frames = frames;
    fit.frameCount = frameCount;
    fit.material = material;
    fit.extent = kiriOwnership_Extent(mesh);
    fit.densityPerArea = (double)material->density * material->thickness;
    fit.isRigid = isRigid;
    refit->fits.count = 0;
    for (int32_t f = 0; f < refit->ownership.first.count; ++f) {
        if (refit->ownership.first.data[f] == KIRI_NONE || frames[f].held) {
            continue;
        }
        kiriFit* next = &refit->fits.data[refit->fits.count]; /* Stage has made room */
        next->state = frames[f];
        fit.state = &next->state;
        if (FitFrame(&fit, f, &regions->material.data[f], &regionMoments[f])) {
            next->frame = f;
            next->gained = kiriFrame_KineticEnergy(&next->state, material) - fit.energy;
            refit->fits.count += 1;
        }
    }
}

/* ---- Limit of energy ----

   A region that is flatter than the parts it came from has less inertia, and turns faster with the same angular
   momentum: its kinetic energy grows. As a rule other fits of the piece have lost more. If not, the energy is taken out
   of the motion that the piece has beside moving and turning as one body, which leaves its momentum as it is. Only a
   piece that has no such motion turns slower. */

/* A piece as one rigid body, with the motion that has its momenta. */
typedef struct RigidBody {
    int32_t piece;
    double energy, mass;
    kiriVec3 x, velocity, angular, spin;
    kiriMat3 inertia;
} RigidBody;

static void AddLinear(RigidBody* body, const kiriFrameData* frame, const kiriMaterial* material)
{
    body->mass += frame->mass;
    body->energy += kiriFrame_KineticEnergy(frame, material);
    body->x = kiriVec3_AddScaled(body->x, frame->mass, frame->x);
    body->velocity = kiriVec3_AddScaled(body->velocity, frame->mass, frame->velocity);
}

static void AddTurning(RigidBody* body, const kiriFrameData* frame, const kiriMaterial* material)
{
    kiriVec3 arm = kiriVec3_Sub(frame->x, body->x), velocity = kiriVec3_Sub(frame->velocity, body->velocity);
    kiriMat3 own = kiriFrame_Inertia(frame, material), point = kiriMat3_PointInertia(frame->mass, arm);
    body->inertia = kiriMat3_AddScaled(&body->inertia, 1.0, &own);
    body->inertia = kiriMat3_AddScaled(&body->inertia, 1.0, &point);
    body->angular = kiriVec3_Add(body->angular, kiriFrame_AngularMomentum(frame, material));
    body->angular = kiriVec3_AddScaled(body->angular, frame->mass, kiriVec3_Cross(arm, velocity));
}

static void GatherBody(RigidBody* body, const kiriRefit* refit, const kiriFrameData* frames,
                       const kiriMaterial* material)
{
    int32_t first = refit->firstOf.data[body->piece];
    for (int32_t f = first; f != KIRI_NONE; f = refit->nextOf.data[f]) {
        AddLinear(body, &frames[f], material);
    }
    body->x = kiriVec3_Scale(1.0 / body->mass, body->x);
    body->velocity = kiriVec3_Scale(1.0 / body->mass, body->velocity);
    for (int32_t f = first; f != KIRI_NONE; f = refit->nextOf.data[f]) {
        AddTurning(body, &frames[f], material);
    }
    body->spin = kiriMat3_Solve(&body->inertia, body->angular);
}

/* Keeps the velocity as one body, `turning` of the turning as one body, and `rest` of all else. */
static void ScaleMotion(const RigidBody* body, kiriFrameData* frame, double turning, double rest)
{
    kiriVec3 round = kiriVec3_Cross(body->spin, kiriVec3_Sub(frame->x, body->x));
    kiriVec3 beside = kiriVec3_Sub(kiriVec3_Sub(frame->velocity, body->velocity), round);
    kiriVec3 spin = kiriVec3_Sub(frame->spin, body->spin);
    frame->velocity = kiriVec3_AddScaled(kiriVec3_AddScaled(body->velocity, turning, round), rest, beside);
    frame->spin = kiriVec3_AddScaled(kiriVec3_Scale(turning, body->spin), rest, spin);
    frame->rate = kiriMat3_Scale(rest, &frame->rate);
}

/* sqrt(part / whole), at most 1; 0 where `part` is not above 0. */
static double RootOfShare(double part, double whole)
{
    return part > 0.0 && whole > part ? sqrt(part / whole) : part > 0.0 ? 1.0 : 0.0;
}

static void LimitPieceEnergy(const kiriRefit* refit, int32_t piece, kiriFrameData* frames, const kiriMaterial* material)
{
    RigidBody body;
    memset(&body, 0, sizeof(body));
    body.piece = piece;
    GatherBody(&body, refit, frames, material);
    double moving = 0.5 * body.mass * kiriVec3_Dot(body.velocity, body.velocity);
    double turning = 0.5 * kiriVec3_Dot(body.spin, body.angular), due = body.energy - refit->gained.data[piece];
    double ofRest = RootOfShare(due - moving - turning, body.energy - moving - turning);
    double ofTurning = ofRest > 0.0 ? 1.0 : RootOfShare(due - moving, turning);
    for (int32_t f = refit->firstOf.data[piece]; f != KIRI_NONE; f = refit->nextOf.data[f]) {
        if (!frames[f].held) {
            ScaleMotion(&body, &frames[f], ofTurning, ofRest);
        }
    }
}

/* The frames of each piece, in their order, and what its fits have gained. Stage has made room. */
static void ListByPiece(kiriRefit* refit, int32_t frameCount, const int32_t* framePiece, int32_t pieceCount)
{
    KIRI_ASSERT(pieceCount <= refit->firstOf.capacity && frameCount <= refit->nextOf.capacity);
    for (int32_t p = 0; p < pieceCount; ++p) {
        refit->firstOf.data[p] = KIRI_NONE;
        refit->gained.data[p] = 0.0;
    }
    for (int32_t f = frameCount - 1; f >= 0; --f) {
        refit->nextOf.data[f] = refit->firstOf.data[framePiece[f]];
        refit->firstOf.data[framePiece[f]] = f;
    }
    for (int32_t k = 0; k < refit->fits.count; ++k) {
        refit->gained.data[framePiece[refit->fits.data[k].frame]] += refit->fits.data[k].gained;
    }
}

void kiriRefit_LimitEnergy(kiriRefit* refit, kiriFrameData* frames, int32_t frameCount, const int32_t* framePiece,
                           int32_t pieceCount, const kiriMaterial* material)
{
    double gained = 0.0, rounding = 0.0;
    for (int32_t k = 0; k < refit->fits.count; ++k) {
        gained += refit->fits.data[k].gained;
        rounding += 1e-13 * kiriFrame_KineticEnergy(&refit->fits.data[k].state, material);
    }
    if (!(gained > rounding)) {
        return;
    }
    ListByPiece(refit, frameCount, framePiece, pieceCount);
    for (int32_t p = 0; p < pieceCount; ++p) {
        if (refit->gained.data[p] > 0.0) {
            LimitPieceEnergy(refit, p, frames, material);
        }
    }
}
