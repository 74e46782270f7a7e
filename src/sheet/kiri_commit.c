#include "kiri_stages.h"

#include "kiri_piece_list.h"
#include "kiri_pin.h"
#include "kiri_seen.h"

#include <string.h>

/* Before the commit all frames that carry a vertex are of one piece. A sheet that is being made has none yet. */
static uint64_t PieceDataAt(const kiriSheetData* sheet, int32_t triangle)
{
    kiriSpan span = sheet->vertexSkin.spans.data[sheet->mesh.triangles.data[triangle].vertex[0]];
    int32_t label = span.count > 0 ? sheet->vertexSkin.weights.data[span.first].label : KIRI_NONE;
    return label != KIRI_NONE ? sheet->frames.data[kiriSheet_FrameOf(sheet, label)].pieceData : 0;
}

/* One that appears, without its motion. */
static kiriFrameData MakeFrame(const kiriSheetData* sheet, const kiriNewFrame* from)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.anchor = from->anchor;
    frame.center = kiriMesh_Local(&sheet->mesh, frame.anchor);
    frame.pieceData = PieceDataAt(sheet, from->triangle);
    return frame;
}

/* From the surface: position, velocity, and the rotation nearest to its slope; for an affine frame the slope itself. */
static void TakeMotion(const kiriSheetData* sheet, kiriFrameData* frame, int32_t triangle)
{
    kiriMotion motion = kiriSkin_Motion(&sheet->vertexSkin, &sheet->shape.labels, sheet->frames.data, &sheet->mesh,
                                        triangle, frame->anchor);
    frame->x = motion.x;
    frame->velocity = motion.velocity;
    if (sheet->settings.mechanics.model == KIRI_MODEL_LINKS) {
        frame->A = kiriMat3_Rotation(motion.A);
        frame->spin = motion.spin;
    } else {
        frame->A = motion.A;
        frame->spin = kiriMat3_Spin(&motion.A, &motion.rate);
        frame->rate = kiriMat3_Beside(&motion.A, &motion.rate, frame->spin);
    }
}

/* What the frames with new material do, all from the motion before: see kiri_refit.h. */
static void FitFrames(kiriSheetData* sheet, int32_t oldCount)
{
    kiriUpdate* u = sheet->update;
    if (!sheet->settings.popping) {
        kiriRefit_Solve(&u->refit, sheet->frames.data, oldCount, &sheet->mesh, &sheet->regions, u->material.data,
                        &sheet->settings.material, sheet->settings.mechanics.model == KIRI_MODEL_LINKS);
    }
}

/* Of a piece that diverges and is torn so far apart that doubles do not tell how it turns. */
static void PutLostToRest(kiriSheetData* sheet)
{
    bool isFitted = sheet->update->refit.fits.count > 0; /* else velocities are those that the host gave */
    for (int32_t f = 0; isFitted && f < sheet->frames.count; ++f) {
        if (!kiriFrame_FitsFloats(&sheet->frames.data[f])) {
            kiriFrame_PutToRest(&sheet->frames.data[f]);
        }
    }
}

static void TakeFits(kiriSheetData* sheet)
{
    kiriRefit* refit = &sheet->update->refit;
    for (int32_t k = 0; k < refit->fits.count; ++k) {
        const kiriFrameData* state = &refit->fits.data[k].state;
        kiriFrameData* frame = &sheet->frames.data[refit->fits.data[k].frame];
        frame->x = state->x;
        frame->A = state->A;
        frame->velocity = state->velocity;
        frame->spin = state->spin;
        frame->rate = state->rate;
    }
    const kiriLayout* next = &sheet->update->next;
    kiriRefit_LimitEnergy(refit, sheet->frames.data, sheet->frames.count, next->framePiece.data, next->pieces.count,
                          &sheet->settings.material);
    PutLostToRest(sheet);
    kiriRefit_Commit(refit, &sheet->mesh);
}

/* Accelerations stay; torque and angular momentum of a rigid frame go with its mass. */
static void RecenterFrame(const kiriSheetData* sheet, kiriFrameData* frame, const kiriMoments* material,
                          double densityPerArea)
{
    double before = frame->mass;
    kiriFrame_Recenter(frame, material, densityPerArea);
    if (before > 0.0 && sheet->settings.mechanics.model == KIRI_MODEL_LINKS) {
        frame->history.turnGain = kiriMat3_Scale(frame->mass / before, &frame->history.turnGain);
        frame->history.turnPull = kiriMat3_Scale(frame->mass / before, &frame->history.turnPull);
    }
}

/* Frames that appear, and what those with new material do. What is fitted needs no motion from the surface. */
static void AddFrames(kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    const kiriRefit* refit = &u->refit;
    int32_t oldCount = sheet->frames.count, fit = 0;
    int32_t firstNew = u->placing.sites.count - u->newFrames.count; /* of a sheet that is being made they are there */
    for (int32_t i = oldCount; i < u->placing.sites.count; ++i) {
        sheet->frames.data[i] = MakeFrame(sheet, &u->newFrames.data[i - firstNew]);
    }
    FitFrames(sheet, oldCount);
    for (int32_t i = oldCount; i < u->placing.sites.count; ++i) {
        while (fit < refit->fits.count && refit->fits.data[fit].frame < i) {
            ++fit;
        }
        if (fit == refit->fits.count || refit->fits.data[fit].frame != i) {
            TakeMotion(sheet, &sheet->frames.data[i], u->newFrames.data[i - firstNew].triangle);
        }
    }
    sheet->frames.count = u->placing.sites.count;
}

static void CommitFrames(kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    double densityPerArea = (double)sheet->settings.material.density * sheet->settings.material.thickness;
    AddFrames(sheet);
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].site = u->placing.sites.data[i];
        if (sheet->regions.dirty.data[i]) {
            RecenterFrame(sheet, &sheet->frames.data[i], &u->material.data[i], densityPerArea);
            sheet->regions.dirty.data[i] = 0;
        }
    }
    TakeFits(sheet);
}

static void CommitPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    for (int32_t i = 0; i < u->samples.movedPoints.count; ++i) {
        sheet->points.data[u->samples.movedPoints.data[i].frame].cell = u->samples.movedPoints.data[i].cell;
    }
    for (int32_t i = 0; i < u->samples.newPoints.count; ++i) {
        sheet->points.data[sheet->points.count++] = u->samples.newPoints.data[i];
        kiriPlaces_Add(&sheet->pointPlaces, sheet->memory, &sheet->mesh, u->samples.newPoints.data[i].at);
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        sheet->points.data[i].frame = sheet->regions.field.owner.data[sheet->points.data[i].cell];
    }
    u->samples.newPoints.count = u->samples.movedPoints.count = 0;
}

void kiriStage_Commit(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    u->counts.weights = (int32_t)sheet->shape.recomputed;
    u->counts.vertices = sheet->vertexSkin.staged.count;
    u->counts.points = sheet->pointSkin.staged.count;
    u->counts.links = sheet->links.changed;
    kiriPieceLists_Forget(&sheet->lists);
    sheet->probes.isFresh = false;
    int32_t oldLinks = sheet->links.links.count;
    bool keepsStrains = kiriSheet_KeepsStrains(sheet);
    if (keepsStrains) {
        kiriStrainOffsets_Remember(&sheet->strainOffsets, sheet->frames.data, sheet->frames.count,
                                   sheet->regions.dirty.data);
    }
    CommitFrames(sheet);
    CommitPoints(sheet);
    kiriView_TouchStaged(sheet);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriLinks_Commit(&sheet->links);
    if (keepsStrains) {
        const int32_t* was = sheet->links.was.count > 0 ? sheet->links.was.data : NULL;
        kiriStrainOffsets_Take(&sheet->strainOffsets, sheet->links.next.data, oldLinks, sheet->links.links.data,
                               sheet->links.links.count, was, sheet->frames.data, &sheet->settings.material);
    }
    kiriSolver_Commit(sheet->solver);
    kiriLayout layout = sheet->layout;
    sheet->layout = u->next;
    u->next = layout;
    kiriPieces_KeepGone(sheet, &u->next);
    kiriPieces_KeepRest(sheet, &u->next);
    kiriPins_WriteLinkParts(sheet);
    kiriPins_KeepReactions(sheet, &u->next.pinShares);
    if (keepsStrains) {
        kiriPins_KeepStrains(sheet, &u->next.pinShares);
    }
    kiriShape_ClearChanges(&sheet->shape);
    u->isScratch = false;
    sheet->seen.isElsewhere = true;
    u->samples.oldVertices = sheet->mesh.vertices.count;
}

void kiriStage_Drop(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriSkin_Drop(&sheet->vertexSkin);
    kiriSkin_Drop(&sheet->pointSkin);
    u->samples.newPoints.count = u->samples.movedPoints.count = 0;
    u->placing.sites.count = sheet->frames.count;
    u->placing.moves.count = u->placing.movesSeen = 0;
    u->placing.isTaking = u->placing.isPlacing = false;
    kiriLinks_Drop(&sheet->links);
    kiriRefresh_Drop(&u->samples.refresh);
    kiriRefit_Drop(&u->refit);
}
