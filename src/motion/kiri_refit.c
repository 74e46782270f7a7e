#include "kiri_refit.h"

#include <string.h>

/* ---- Who owned what ---------------------------------------------------------------------------------------------

   Cells have no lasting name: an update from scratch makes all of them anew. But cells only ever fall apart, and a
   triangle is convex, so what it has in a square lies in one cell, and so does what its parts have there later. So a
   square that is one cell keeps its owner, and a divided one the owner by triangle. */

static bool Note(kiriRefit* refit, kiriMemory* memory, int32_t square)
{
    if (refit->marks.data[square]) {
        return true;
    }
    refit->marks.data[square] = 1;
    return kiriArray_Push(memory, &refit->squares, square);
}

static bool MakeRoom(kiriRefit* refit, kiriMemory* memory, const kiriMeshData* mesh)
{
    int32_t count = mesh->squares.columns * mesh->squares.rows;
    const kiriTenure none = { KIRI_NONE, { 0, 0 } };
    if (!kiriArray_Reserve(memory, &refit->tenures, count) || !kiriArray_Reserve(memory, &refit->marks, count)) {
        return false;
    }
    while (refit->tenures.count < count) {
        refit->tenures.data[refit->tenures.count++] = none;
        refit->marks.data[refit->marks.count++] = 0;
    }
    return true;
}

bool kiriRefit_NoteDirty(kiriRefit* refit, kiriMemory* memory, const kiriMeshData* mesh)
{
    bool ok = MakeRoom(refit, memory, mesh);
    for (int32_t k = 0; ok && k < mesh->squares.dirty.count; ++k) {
        ok = Note(refit, memory, mesh->squares.dirty.data[k]);
    }
    return ok;
}

bool kiriRefit_NoteChanges(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                           const kiriRegions* regions)
{
    bool ok = MakeRoom(refit, memory, mesh);
    for (int32_t k = 0; ok && k < regions->changes.count; ++k) {
        int32_t cell = regions->changes.data[k].cell;
        ok = !kiriGrid_IsCell(grid, cell) || Note(refit, memory, grid->cells.data[cell].square);
    }
    return ok;
}

/* A part that rounding brought into a square where its triangle was not goes to the lowest owner there. */
static int32_t OwnerBefore(const kiriRefit* refit, const kiriMeshData* mesh, int32_t square, int32_t triangle)
{
    const kiriTenure* tenure = &refit->tenures.data[square];
    if (tenure->parts.count == 0) {
        return tenure->owner;
    }
    while (triangle >= refit->triangleCount) {
        triangle = mesh->triangles.data[triangle].parent;
    }
    const kiriOwned* owned = refit->owned.data + tenure->parts.first;
    int32_t lowest = owned[0].owner;
    for (int32_t k = 0; k < tenure->parts.count; ++k) {
        if (owned[k].triangle == triangle) {
            return owned[k].owner;
        }
        lowest = owned[k].owner < lowest ? owned[k].owner : lowest;
    }
    return lowest;
}

/* ---- Staging ---- */

/* As the regions' tallies have it. */
static double Extent(const kiriMeshData* mesh)
{
    return 536870912.0 * mesh->step;
}

/* The transfer between the two, an empty one where it is the first. */
static kiriTransfer* TransferOf(kiriRefit* refit, kiriMemory* memory, int32_t to, int32_t from)
{
    int32_t before = KIRI_NONE, at = refit->first.data[to];
    while (at != KIRI_NONE && refit->transfers.data[at].from < from) {
        before = at;
        at = refit->transfers.data[at].next;
    }
    if (at != KIRI_NONE && refit->transfers.data[at].from == from) {
        return &refit->transfers.data[at];
    }
    kiriTransfer transfer = { from, at, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } } };
    if (!kiriArray_Push(memory, &refit->transfers, transfer)) {
        return NULL;
    }
    int32_t index = refit->transfers.count - 1;
    *(before == KIRI_NONE ? &refit->first.data[to] : &refit->transfers.data[before].next) = index;
    return &refit->transfers.data[index];
}

static bool StageTransfers(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                           const kiriRegions* regions, int32_t square)
{
    double extent = Extent(mesh);
    for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
        int32_t to = regions->field.owner.data[c];
        int32_t from = OwnerBefore(refit, mesh, square, grid->cells.data[c].triangle);
        if (from != KIRI_NONE && from != to) {
            kiriTransfer* transfer = TransferOf(refit, memory, to, from);
            if (transfer == NULL) {
                return false;
            }
            kiriTally_Add(&transfer->material, &grid->cells.data[c].material, 1, extent);
        }
    }
    return true;
}

static int32_t CountNodes(const kiriMeshData* mesh, int32_t square)
{
    int32_t count = 0;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        ++count;
    }
    return count;
}

/* A square without material has no cells to own. */
static bool StageTenure(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, int32_t square)
{
    int32_t cell = grid->squareCell.data[square];
    if (cell == KIRI_NONE) {
        return true;
    }
    kiriStagedTenure staged = { square, { regions->field.owner.data[cell], { 0, 0 } } };
    bool isDivided = grid->cells.data[cell].next != KIRI_NONE;
    int32_t count = isDivided ? CountNodes(mesh, square) : 0;
    if (!kiriArray_Reserve(memory, &refit->staged, (int64_t)refit->staged.count + 1) ||
        !kiriSpan_Resize(&staged.tenure.parts, &refit->room, memory, &refit->owned, sizeof(kiriOwned), count)) {
        return false;
    }
    kiriOwned* owned = refit->owned.data + staged.tenure.parts.first;
    for (int32_t n = isDivided ? mesh->squares.head[square] : KIRI_NONE; n != KIRI_NONE;) {
        kiriSquareNode node = mesh->squares.nodes.data[n];
        *owned++ = (kiriOwned){ node.triangle, regions->field.owner.data[grid->nodeCell.data[n]] };
        n = node.next;
    }
    refit->staged.data[refit->staged.count++] = staged;
    return true;
}

static void DropParts(kiriRefit* refit, kiriSpan* parts)
{
    kiriSpan_Resize(parts, &refit->room, NULL, &refit->owned, sizeof(kiriOwned), 0); /* to give back never fails */
}

static void DropStaged(kiriRefit* refit)
{
    for (int32_t k = 0; k < refit->staged.count; ++k) {
        DropParts(refit, &refit->staged.data[k].tenure.parts);
    }
    refit->staged.count = refit->transfers.count = 0;
}

static bool ClearTransfers(kiriRefit* refit, kiriMemory* memory, int32_t frameCount)
{
    DropStaged(refit);
    if (!kiriArray_Resize(memory, &refit->first, frameCount)) {
        return false;
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        refit->first.data[f] = KIRI_NONE;
    }
    return true;
}

bool kiriRefit_Stage(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                     const kiriRegions* regions, bool isScratch)
{
    bool ok = MakeRoom(refit, memory, mesh) && ClearTransfers(refit, memory, regions->material.count);
    for (int32_t s = 0; ok && isScratch && s < refit->marks.count; ++s) {
        ok = Note(refit, memory, s);
    }
    for (int32_t k = 0; ok && k < refit->squares.count; ++k) {
        int32_t square = refit->squares.data[k];
        ok = StageTransfers(refit, memory, grid, mesh, regions, square) &&
             StageTenure(refit, memory, grid, mesh, regions, square);
    }
    int32_t fits = 0;
    for (int32_t f = 0; ok && f < refit->first.count; ++f) {
        fits += refit->first.data[f] != KIRI_NONE;
    }
    return ok && kiriArray_Reserve(memory, &refit->fits, fits);
}

static void ForgetSquares(kiriRefit* refit)
{
    for (int32_t k = 0; k < refit->squares.count; ++k) {
        refit->marks.data[refit->squares.data[k]] = 0;
    }
    refit->squares.count = 0;
}

void kiriRefit_Drop(kiriRefit* refit)
{
    DropStaged(refit);
    ForgetSquares(refit);
    refit->fits.count = 0;
}

void kiriRefit_Commit(kiriRefit* refit, const kiriMeshData* mesh)
{
    for (int32_t k = 0; k < refit->staged.count; ++k) {
        kiriTenure* tenure = &refit->tenures.data[refit->staged.data[k].square];
        DropParts(refit, &tenure->parts);
        *tenure = refit->staged.data[k].tenure;
    }
    refit->staged.count = refit->transfers.count = refit->fits.count = 0;
    refit->triangleCount = mesh->triangles.count;
    ForgetSquares(refit);
}

/* ---- The fit ----------------------------------------------------------------------------------------------------

   A part of the new region moves, before the commit, as a frame with the part's own mass and centre would. So all that
   is known of frames holds for parts. */

typedef struct Fit {
    const kiriRefit* refit;
    const kiriFrameData* frames;
    int32_t frameCount;
    const kiriMaterial* material;
    double extent, densityPerArea;
    bool isRigid;

    kiriFrameData* state; /* that is sought; its centre, x and velocity are those of all parts before the second pass */
    double mass;          /* of the parts */
    kiriMat3 A, rate;     /* their means */
    kiriMat3 lean, growth; /* integrals of density times position, and velocity, times the way from the centre */
    kiriVec3 angular;      /* momentum about the centre */
    double energy;         /* kinetic */
} Fit;

static const kiriMat3 None = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };

static void AddScaled(kiriMat3* sum, double s, const kiriMat3* m)
{
    sum->u = kiriVec3_AddScaled(sum->u, s, m->u);
    sum->v = kiriVec3_AddScaled(sum->v, s, m->v);
    sum->d = kiriVec3_AddScaled(sum->d, s, m->d);
}

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
static void Subtract(kiriTally* sum, const kiriTally* part)
{
    SubtractExact(&sum->area, part->area);
    SubtractExact(&sum->u, part->u);
    SubtractExact(&sum->v, part->v);
    SubtractExact(&sum->uu, part->uu);
    SubtractExact(&sum->uv, part->uv);
    SubtractExact(&sum->vv, part->vv);
}

/* The part that a tally tells of, as it moved before. */
static void VisitPart(Fit* fit, int32_t from, const kiriTally* tally, void visit(Fit* fit, const kiriFrameData* part))
{
    kiriMoments material = kiriTally_Moments(tally, fit->extent);
    if (material.area > 0.0 && from < fit->frameCount) {
        kiriFrameData part = fit->frames[from];
        kiriFrame_Recenter(&part, &material, fit->densityPerArea);
        visit(fit, &part);
    }
}

/* What stayed with the frame, then what came to it. */
static void VisitParts(Fit* fit, int32_t frame, const kiriTally* region,
                       void visit(Fit* fit, const kiriFrameData* part))
{
    const kiriTransfer* transfers = fit->refit->transfers.data;
    kiriTally kept = *region;
    for (int32_t k = fit->refit->first.data[frame]; k != KIRI_NONE; k = transfers[k].next) {
        Subtract(&kept, &transfers[k].material);
    }
    VisitPart(fit, frame, &kept, visit);
    for (int32_t k = fit->refit->first.data[frame]; k != KIRI_NONE; k = transfers[k].next) {
        VisitPart(fit, transfers[k].from, &transfers[k].material, visit);
    }
}

static void SumMeans(Fit* fit, const kiriFrameData* part)
{
    kiriFrameData* sum = fit->state;
    kiriMat3 rate = kiriFrame_Rate(part);
    fit->mass += part->mass;
    sum->x = kiriVec3_AddScaled(sum->x, part->mass, part->x);
    sum->velocity = kiriVec3_AddScaled(sum->velocity, part->mass, part->velocity);
    sum->spin = kiriVec3_AddScaled(sum->spin, part->mass, part->spin);
    AddScaled(&fit->A, part->mass, &part->A);
    AddScaled(&fit->rate, part->mass, &rate);
}

static kiriMat3 Scaled(double s, const kiriMat3* m)
{
    kiriMat3 r = None;
    AddScaled(&r, s, m);
    return r;
}

static void DivideMeans(Fit* fit)
{
    double share = 1.0 / fit->mass;
    fit->state->x = kiriVec3_Scale(share, fit->state->x);
    fit->state->velocity = kiriVec3_Scale(share, fit->state->velocity);
    fit->state->spin = kiriVec3_Scale(share, fit->state->spin);
    fit->A = Scaled(share, &fit->A);
    fit->rate = Scaled(share, &fit->rate);
}

/* As prediction.c has them. */
static kiriMassMoments MomentsOf(const Fit* fit, const kiriFrameData* frame)
{
    double h = (double)fit->material->thickness, least = frame->mass * h * h / 12.0;
    kiriMassMoments m = { frame->inertia[0] + least, frame->inertia[1], frame->inertia[2] + least, least };
    return m;
}

/* Adds a part's integral: it is at `off`, `way` from the centre at rest, and its slope is `slope`. */
static void AddLean(const Fit* fit, kiriMat3* sum, const kiriFrameData* part, kiriVec3 off, const kiriMat3* slope)
{
    kiriMassMoments m = MomentsOf(fit, part);
    kiriVec2 way = kiriVec2_Sub(part->center, fit->state->center);
    kiriMat3 lean = { kiriVec3_AddScaled(kiriVec3_Scale(m.uu, slope->u), m.uv, slope->v),
                      kiriVec3_AddScaled(kiriVec3_Scale(m.vv, slope->v), m.uv, slope->u),
                      kiriVec3_Scale(m.dd, slope->d) };
    lean.u = kiriVec3_AddScaled(lean.u, part->mass * way.x, off);
    lean.v = kiriVec3_AddScaled(lean.v, part->mass * way.y, off);
    AddScaled(sum, 1.0, &lean);
}

static void SumLeans(Fit* fit, const kiriFrameData* part)
{
    kiriVec3 off = kiriVec3_Sub(part->x, fit->state->x);
    kiriVec3 velocity = kiriVec3_Sub(part->velocity, fit->state->velocity);
    kiriMat3 rate = kiriFrame_Rate(part);
    AddLean(fit, &fit->lean, part, off, &part->A);
    AddLean(fit, &fit->growth, part, velocity, &rate);
    fit->angular = kiriVec3_Add(fit->angular, kiriFrame_AngularMomentum(part, fit->material));
    fit->angular = kiriVec3_AddScaled(fit->angular, part->mass, kiriVec3_Cross(off, velocity));
    fit->energy += kiriFrame_KineticEnergy(part, fit->material);
}

/* The slope whose integral comes nearest to `lean`, from the mean: where the region is a thread, that stays across it.
   */
static kiriMat3 SlopeOf(const Fit* fit, const kiriMat3* mean, const kiriMat3* lean)
{
    kiriMassMoments m = MomentsOf(fit, fit->state);
    kiriVec3 u = kiriVec3_AddScaled(kiriVec3_AddScaled(lean->u, -m.uu, mean->u), -m.uv, mean->v);
    kiriVec3 v = kiriVec3_AddScaled(kiriVec3_AddScaled(lean->v, -m.uv, mean->u), -m.vv, mean->v);
    double least = 1e-12 * (m.uu + m.vv), uu = m.uu + least, vv = m.vv + least, det = uu * vv - m.uv * m.uv;
    kiriMat3 slope = *mean;
    slope.u = kiriVec3_AddScaled(kiriVec3_AddScaled(slope.u, vv / det, u), -m.uv / det, v);
    slope.v = kiriVec3_AddScaled(kiriVec3_AddScaled(slope.v, uu / det, v), -m.uv / det, u);
    return slope;
}

/* Turning makes up for the angular momentum that the fit loses. */
static void Turn(Fit* fit)
{
    kiriFrameData* state = fit->state;
    kiriVec3 missing = kiriVec3_Sub(fit->angular, kiriFrame_AngularMomentum(state, fit->material));
    kiriMat3 inertia = kiriFrame_Inertia(state, fit->material);
    state->spin = kiriVec3_Add(state->spin, kiriMat3_Solve(&inertia, missing));
}

static void FitState(Fit* fit)
{
    kiriFrameData* state = fit->state;
    if (fit->isRigid) {
        state->A = kiriMat3_RotationFrom(kiriMat3_Rotation(fit->A), fit->lean);
        state->rate = None;
    } else {
        kiriMat3 rate = SlopeOf(fit, &fit->rate, &fit->growth);
        state->A = SlopeOf(fit, &fit->A, &fit->lean);
        state->spin = kiriMat3_Spin(&state->A, &rate);
        state->rate = kiriMat3_Beside(&state->A, &rate, state->spin);
    }
    Turn(fit);
}

/* False where all the material is new. */
static bool FitFrame(Fit* fit, int32_t frame, const kiriTally* region, const kiriMoments* material)
{
    kiriVec3 zero = { 0.0, 0.0, 0.0 };
    kiriFrameData* state = fit->state;
    kiriFrame_Recenter(state, material, fit->densityPerArea);
    state->x = state->velocity = state->spin = fit->angular = zero;
    fit->A = fit->rate = fit->lean = fit->growth = None;
    fit->mass = fit->energy = 0.0;
    VisitParts(fit, frame, region, SumMeans);
    if (!(fit->mass > 0.0)) {
        return false;
    }
    DivideMeans(fit);
    VisitParts(fit, frame, region, SumLeans);
    FitState(fit);
    return true;
}

void kiriRefit_Solve(kiriRefit* refit, const kiriFrameData* frames, int32_t frameCount, const kiriMeshData* mesh,
                     const kiriRegions* regions, const kiriMoments* regionMoments, const kiriMaterial* material,
                     bool isRigid)
{
    Fit fit;
    memset(&fit, 0, sizeof(fit));
    fit.refit = refit;
    fit.frames = frames;
    fit.frameCount = frameCount;
    fit.material = material;
    fit.extent = Extent(mesh);
    fit.densityPerArea = (double)material->density * material->thickness;
    fit.isRigid = isRigid;
    refit->fits.count = 0;
    for (int32_t f = 0; f < refit->first.count; ++f) {
        if (refit->first.data[f] == KIRI_NONE || frames[f].held) {
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

/* ---- Energy ----

   A sheet that flattens while it turns has less inertia, and turns faster with the momentum that it has. Other frames
   have lost more energy than that, as a rule. If not, the piece pays by what it moves beside its turning as one body,
   which costs no momentum. Only a piece that does nothing but turn is braked. */

/* The frames of a piece as one body. */
typedef struct Body {
    int32_t piece;
    double gained, energy, mass;
    kiriVec3 x, velocity, angular, spin;
    kiriMat3 inertia;
} Body;

static void AddMass(Body* body, const kiriFrameData* frame, const kiriMaterial* material)
{
    body->mass += frame->mass;
    body->energy += kiriFrame_KineticEnergy(frame, material);
    body->x = kiriVec3_AddScaled(body->x, frame->mass, frame->x);
    body->velocity = kiriVec3_AddScaled(body->velocity, frame->mass, frame->velocity);
}

static void AddTurning(Body* body, const kiriFrameData* frame, const kiriMaterial* material)
{
    kiriVec3 arm = kiriVec3_Sub(frame->x, body->x), velocity = kiriVec3_Sub(frame->velocity, body->velocity);
    double square = frame->mass * kiriVec3_Dot(arm, arm);
    kiriMat3 own = kiriFrame_Inertia(frame, material);
    kiriMat3 orbit = { kiriVec3_AddScaled(kiriVec3_Make(square, 0.0, 0.0), -frame->mass * arm.x, arm),
                       kiriVec3_AddScaled(kiriVec3_Make(0.0, square, 0.0), -frame->mass * arm.y, arm),
                       kiriVec3_AddScaled(kiriVec3_Make(0.0, 0.0, square), -frame->mass * arm.z, arm) };
    AddScaled(&body->inertia, 1.0, &own);
    AddScaled(&body->inertia, 1.0, &orbit);
    body->angular = kiriVec3_Add(body->angular, kiriFrame_AngularMomentum(frame, material));
    body->angular = kiriVec3_AddScaled(body->angular, frame->mass, kiriVec3_Cross(arm, velocity));
}

static void GatherBody(Body* body, const kiriFrameData* frames, int32_t frameCount, const int32_t* piece,
                       const kiriMaterial* material)
{
    for (int32_t f = 0; f < frameCount; ++f) {
        if (piece[f] == body->piece) {
            AddMass(body, &frames[f], material);
        }
    }
    body->x = kiriVec3_Scale(1.0 / body->mass, body->x);
    body->velocity = kiriVec3_Scale(1.0 / body->mass, body->velocity);
    for (int32_t f = 0; f < frameCount; ++f) {
        if (piece[f] == body->piece) {
            AddTurning(body, &frames[f], material);
        }
    }
    body->spin = kiriMat3_Solve(&body->inertia, body->angular);
}

/* Leaves `turning` of the turning as one body, and `rest` of all else but the prediction. */
static void Slow(const Body* body, kiriFrameData* frame, double turning, double rest)
{
    kiriVec3 round = kiriVec3_Cross(body->spin, kiriVec3_Sub(frame->x, body->x));
    kiriVec3 beside = kiriVec3_Sub(kiriVec3_Sub(frame->velocity, body->velocity), round);
    kiriVec3 spin = kiriVec3_Sub(frame->spin, body->spin);
    frame->velocity = kiriVec3_AddScaled(kiriVec3_AddScaled(body->velocity, turning, round), rest, beside);
    frame->spin = kiriVec3_AddScaled(kiriVec3_Scale(turning, body->spin), rest, spin);
    frame->rate = Scaled(rest, &frame->rate);
}

/* The root of a share, which is none where there is nothing to share. */
static double RootOfShare(double part, double whole)
{
    return part > 0.0 && whole > part ? sqrt(part / whole) : part > 0.0 ? 1.0 : 0.0;
}

static void BrakePiece(Body* body, kiriFrameData* frames, int32_t frameCount, const int32_t* piece,
                       const kiriMaterial* material)
{
    GatherBody(body, frames, frameCount, piece, material);
    double prediction = 0.5 * body->mass * kiriVec3_Dot(body->velocity, body->velocity);
    double turning = 0.5 * kiriVec3_Dot(body->spin, body->angular), due = body->energy - body->gained;
    double ofRest = RootOfShare(due - prediction - turning, body->energy - prediction - turning);
    double ofTurning = ofRest > 0.0 ? 1.0 : RootOfShare(due - prediction, turning);
    for (int32_t f = 0; f < frameCount; ++f) {
        if (piece[f] == body->piece && !frames[f].held) {
            Slow(body, &frames[f], ofTurning, ofRest);
        }
    }
}

void kiriRefit_Brake(const kiriRefit* refit, kiriFrameData* frames, int32_t frameCount, const int32_t* piece,
                     int32_t pieceCount, const kiriMaterial* material)
{
    double gained = 0.0, rounding = 0.0;
    for (int32_t k = 0; k < refit->fits.count; ++k) {
        gained += refit->fits.data[k].gained;
        rounding += 1e-13 * kiriFrame_KineticEnergy(&refit->fits.data[k].state, material);
    }
    for (int32_t p = 0; gained > rounding && p < pieceCount; ++p) {
        Body body;
        memset(&body, 0, sizeof(body));
        body.piece = p;
        for (int32_t k = 0; k < refit->fits.count; ++k) {
            body.gained += piece[refit->fits.data[k].frame] == p ? refit->fits.data[k].gained : 0.0;
        }
        if (body.gained > 0.0) {
            BrakePiece(&body, frames, frameCount, piece, material);
        }
    }
}
