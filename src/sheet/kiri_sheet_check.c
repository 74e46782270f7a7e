#include "kiri_sheet_check.h"

#include "../field/kiri_field_check.h"
#include "../mesh/kiri_mesh_check.h"
#include "../motion/kiri_motion_check.h"
#include "../view/kiri_view_check.h"
#include "kiri_blocks.h"
#include "kiri_piece.h"
#include "kiri_pin.h"
#include "kiri_seen.h"
#include "kiri_update.h"

/* ---- Layout ------------------------------------------------------------------------------------------------------- */

static const kiriMust IsPieceIndex[] = { KIRI_INDEX(KIRI_OF_PIECES, kiriSpan, first, first) };
static const kiriMust IsFrameIndex[] = { KIRI_INDEX(KIRI_OF_REGIONS, kiriSpan, first, first) };

static const kiriMust PieceMust[] = {
    KIRI_REALS(kiriPiece, area, area),
    KIRI_INDEX(KIRI_OF_REGIONS, kiriPiece, frame, frame),
    KIRI_REALS(kiriPiece, rest.calm, rest.calm),
};

static const kiriMust LineShareMust[] = {
    KIRI_INDEX(KIRI_OF_REGIONS, kiriLineShare, frame, frame),
    KIRI_REALS(kiriLineShare, length, ends),
};

static const kiriMust PinShareMust[] = {
    KIRI_INDEX(KIRI_OF_PINS, kiriPinShare, pin, pin),
    KIRI_PART_MUST(kiriPinShare, share, kiriLineShare, LineShareMust),
    KIRI_REALS(kiriPinShare, offset, bore),
};

static const kiriMust SeveredMust[] = {
    KIRI_INDEX(KIRI_OF_PINS, kiriSeveredLink, pin, pin),
    KIRI_INDEX(KIRI_OF_LINKS, kiriSeveredLink, link, link),
    KIRI_REALS(kiriSeveredLink, part, part),
};

static const kiriMust PiecesMust[] = {
    KIRI_ITEMS_MUST(kiriLayout, pieces, PieceMust),
    KIRI_ITEMS_MUST(kiriLayout, framePiece, IsPieceIndex),
    KIRI_LENGTH(KIRI_OF_REGIONS, kiriLayout, framePiece),
};

static const kiriMust LayoutMust[] = {
    KIRI_ITEMS_MUST(kiriLayout, pinFrame, IsFrameIndex),
    KIRI_LENGTH(KIRI_OF_PINS, kiriLayout, pinFrame),
    KIRI_ITEMS_MUST(kiriLayout, severed, SeveredMust),
    KIRI_ITEMS_MUST(kiriLayout, pinShares, PinShareMust),
};

/* Pieces are numbered by their lowest frame. */
static bool ArePieces(kiriCheck* check, const kiriLayout* layout, int64_t frames)
{
    check->count[KIRI_OF_REGIONS] = frames;
    check->count[KIRI_OF_PIECES] = layout->pieces.count;
    bool areFine = kiriCheck_Object(check, PiecesMust, layout);
    int32_t pieces = 0;
    for (int32_t f = 0; areFine && f < frames; ++f) {
        int32_t piece = layout->framePiece.data[f];
        areFine = kiriCheck_That(check, piece <= pieces && (piece < pieces || layout->pieces.data[piece].frame == f));
        pieces += piece == pieces;
    }
    return areFine && kiriCheck_That(check, pieces == layout->pieces.count);
}

static bool AreLinksOfPieces(const kiriLayout* layout, const kiriLink* links, int32_t count)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < count; ++k) {
        areFine = layout->framePiece.data[links[k].i] == layout->framePiece.data[links[k].j];
    }
    return areFine;
}

static bool AreShares(const kiriPinShares* shares, const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < shares->count; ++k) {
        int32_t pin = shares->data[k].pin;
        areFine = sheet->pins.data[pin].type != KIRI_PIN_POINT && (k == 0 || shares->data[k - 1].pin <= pin) &&
                  shares->data[k].share.length > 0.0 && shares->data[k].share.load > 0.0;
    }
    return areFine;
}

static const kiriMust OffsetsMust[] = {
    KIRI_REALS(kiriStrainOffset, strain, strain),
};

static const kiriMust RowsMust[] = {
    KIRI_ITEMS_MUST(kiriSheetData, linkParts, kiriMustBeReal),
    KIRI_ITEMS_MUST(kiriSheetData, strainOffsets.strainOffsets, OffsetsMust),
};

/* In force. */
static bool IsLayout(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriLayout* layout = &sheet->layout;
    int32_t links = sheet->links.links.count, offsets = sheet->strainOffsets.strainOffsets.count;
    check->count[KIRI_OF_PINS] = sheet->pins.count;
    check->count[KIRI_OF_LINKS] = links;
    return ArePieces(check, layout, sheet->frames.count) && kiriCheck_Object(check, LayoutMust, layout) &&
           kiriAreaElements_Check(&layout->areaElements, check) && kiriCheck_Object(check, RowsMust, sheet) &&
           kiriCheck_That(check, AreLinksOfPieces(layout, sheet->links.links.data, links) &&
                                     AreShares(&layout->pinShares, sheet) &&
                                     (offsets == 0 || (offsets == links && kiriSheet_KeepsStrains(sheet))) &&
                                     sheet->linkParts.count == (layout->severed.count > 0 ? links : 0));
}

/* Frames of an area element are of one piece. */
static bool AreElementsOfPieces(const kiriLayout* layout)
{
    const kiriAreaElements* areas = &layout->areaElements;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < areas->elements.count; ++k) {
        const kiriFrameShare* shares = &areas->shares.data[areas->elements.data[k].first];
        for (int32_t n = 1; areFine && n < areas->elements.data[k].count; ++n) {
            areFine = shares[n - 1].frame < shares[n].frame &&
                      layout->framePiece.data[shares[n].frame] == layout->framePiece.data[shares[0].frame];
        }
    }
    return areFine;
}

/* Weights of a sample are of frames of one piece. */
static bool AreSamplesOfPieces(const kiriLayout* layout, const kiriSkin* skin)
{
    bool areFine = true;
    for (int32_t i = 0; areFine && i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        for (int32_t k = span.first + 1; areFine && k < span.first + span.count; ++k) {
            areFine = layout->framePiece.data[skin->weights.data[k].frame] ==
                          layout->framePiece.data[skin->weights.data[k - 1].frame] &&
                      skin->weights.data[k - 1].frame < skin->weights.data[k].frame;
        }
    }
    return areFine;
}

/* And so are the corners of triangles that are joined. */
static bool AreTrianglesOfPieces(const kiriSheetData* sheet)
{
    const kiriMeshData* mesh = &sheet->mesh;
    bool areFine = true;
    for (int32_t t = 0; areFine && t < mesh->triangles.count; ++t) {
        const int32_t* corners = mesh->triangles.data[t].vertex;
        areFine = !kiriMesh_IsTriangle(mesh, t) ||
                  (kiriPiece_OfVertex(sheet, corners[0]) == kiriPiece_OfVertex(sheet, corners[1]) &&
                   kiriPiece_OfVertex(sheet, corners[0]) == kiriPiece_OfVertex(sheet, corners[2]));
    }
    return areFine;
}

/* ---- Pins, points and contacts ------------------------------------------------------------------------------------ */

static const kiriMust PinMust[] = {
    KIRI_WITHIN(KIRI_PIN_POINT, KIRI_PIN_CLAMP, kiriPinData, type, type),
    KIRI_REALS(kiriPinData, target, breakForce),
    KIRI_REALS(kiriPinData, anchor.local, anchor.softness),
    KIRI_REALS(kiriPinData, off, off),
    KIRI_REALS(kiriPinData, stiffness, bore),
};

static const kiriMust GivenMust[] = {
    KIRI_FLOATS(kiriGivenContact, contact.restPoint, contact.pushSpeed),
    KIRI_REALS(kiriGivenContact, share, share),
};

static const kiriMust TouchMust[] = {
    KIRI_REALS(kiriTouch, share, pushSpeed),
    KIRI_REALS(kiriTouch, felt, cushion),
    KIRI_REALS(kiriTouch, force, force),
};

static const kiriMust TouchForceMust[] = {
    KIRI_REALS(kiriTouchForce, force, force),
};

static const kiriMust TouchMemoryMust[] = {
    KIRI_ITEMS_MUST(kiriTouchMemory, touches, TouchMust),
    KIRI_ITEMS_MUST(kiriTouchMemory, forces, TouchForceMust),
};

static bool IsInSquare(const kiriSheetData* sheet, kiriLatticePoint at)
{
    int32_t square =
        kiriLattice_Has(at) && at.x >= 0 && at.y >= 0 ? kiriSquares_At(&sheet->mesh.squares, at) : KIRI_NONE;
    return square != KIRI_NONE && sheet->mesh.squares.head[square] != KIRI_NONE;
}

static bool ArePins(kiriCheck* check, const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t i = 0; areFine && i < sheet->pins.count; ++i) {
        const kiriPinData* pin = &sheet->pins.data[i];
        bool isPoint = pin->type == KIRI_PIN_POINT;
        areFine = kiriCheck_Object(check, PinMust, pin) &&
                  kiriCheck_That(check, kiriLattice_Has(pin->at) && kiriLattice_Has(pin->to) &&
                                            isPoint == (pin->at.x == pin->to.x && pin->at.y == pin->to.y) &&
                                            isPoint == (pin->stiffness > 0.0));
    }
    return areFine;
}

/* A place is a collision point, or a blend of vertices: those that are not there come last. */
static bool IsPlace(const kiriSheetData* sheet, int32_t point, const int32_t vertex[3])
{
    bool isFine = point >= KIRI_NONE && point < sheet->points.count && (point != KIRI_NONE || vertex[0] != KIRI_NONE);
    for (int k = 0; isFine && k < 3 && point == KIRI_NONE; ++k) {
        isFine = vertex[k] == KIRI_NONE ||
                 (vertex[k] >= 0 && vertex[k] < sheet->mesh.vertices.count &&
                  kiriMesh_IsVertex(&sheet->mesh, vertex[k]) && (k == 0 || vertex[k - 1] != KIRI_NONE));
    }
    return isFine;
}

static bool IsTouchMemory(kiriCheck* check, const kiriSheetData* sheet, const kiriTouchMemory* memory)
{
    bool isFine = kiriCheck_Object(check, TouchMemoryMust, memory) &&
                  kiriCheck_That(check, memory->given >= 0 && memory->given <= memory->touches.count);
    for (int32_t k = 0; isFine && k < memory->touches.count; ++k) {
        const kiriTouch* touch = &memory->touches.data[k];
        isFine = kiriCheck_That(check, IsPlace(sheet, touch->point, touch->vertex));
    }
    return isFine;
}

static bool AreContacts(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriTouches* touches = &sheet->touches;
    bool areFine = kiriCheck_That(check, touches->nextTold.capacity >= sheet->contacts.count &&
                                             touches->found.capacity >= sheet->contacts.count);
    for (int32_t k = 0; areFine && k < sheet->contacts.count; ++k) {
        const kiriGivenContact* given = &sheet->contacts.data[k];
        areFine = kiriCheck_Object(check, GivenMust, given) &&
                  kiriCheck_That(check, IsPlace(sheet, given->contact.point, given->vertex));
        for (int n = 0; areFine && n < 3 && given->contact.point == KIRI_NONE; ++n) {
            areFine = kiriCheck_That(check, given->vertex[n] != KIRI_NONE);
        }
    }
    return areFine && IsTouchMemory(check, sheet, &touches->last) && IsTouchMemory(check, sheet, &touches->slept);
}

static bool ArePoints(kiriCheck* check, const kiriSheetData* sheet)
{
    bool areFine = kiriCheck_That(check, sheet->seen.pointCount >= 0 && sheet->seen.pointCount <= sheet->points.count &&
                                             sheet->seen.exactPoints.count == sheet->points.count &&
                                             sheet->seen.pointPositions.count == 3 * (int64_t)sheet->points.count);
    for (int32_t i = 0; areFine && i < sheet->points.count; ++i) {
        const kiriSample* point = &sheet->points.data[i];
        areFine = kiriCheck_That(check, IsInSquare(sheet, point->at) && point->frame >= 0 &&
                                            point->frame < sheet->frames.count && point->cell >= 0);
    }
    return areFine && kiriPlaces_Check(&sheet->pointPlaces, check, sheet->points.count);
}

/* ---- The work at hand --------------------------------------------------------------------------------------------- */

static const kiriMust MoveMust[] = {
    KIRI_INDEX(KIRI_OF_SITES, kiriSiteMove, frame, frame),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriSiteMove, was, was),
};

static const kiriMust MomentsMust[] = {
    KIRI_REALS(kiriMoments, area, vv),
};

static const kiriMust OwnMust[] = { KIRI_INDEX(KIRI_OF_SITES, kiriSpan, first, first) };

static const kiriMust PlacingMust[] = {
    KIRI_ITEMS_MUST(kiriUpdate, placing.own, OwnMust),
};

enum { MOST_STEPS = 16 };

static const kiriMust UpdateMust[] = {
    KIRI_WITHIN(KIRI_NONE, KIRI_READY, kiriUpdate, stage, stage),
    KIRI_WITHIN(0, MOST_STEPS, kiriUpdate, step, step),
    KIRI_COUNTS(kiriUpdate, spent, spent),
    KIRI_COUNTS(kiriUpdate, cut.stamp, cut.stamp),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, cut.count, cut.taken),
    KIRI_ITEMS_MUST(kiriUpdate, placing.moves, MoveMust),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, placing.movesSeen, placing.spread),
    KIRI_COUNTS(kiriUpdate, placing.search.owed, placing.search.owed),
    KIRI_REALS(kiriUpdate, placing.whole, placing.whole),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, placing.search.seen, placing.search.seen),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, placing.at, placing.at),
    KIRI_ITEMS_MUST(kiriUpdate, material, MomentsMust),
    KIRI_UP_TO(KIRI_OF_VERTICES, kiriUpdate, samples.oldVertices, samples.oldVertices),
    KIRI_WITHIN(0, INT32_MAX / 8, kiriUpdate, refit.most, refit.most),
    KIRI_COUNTS(kiriUpdate, due, due),
};

/* New samples are in cells; samples that move are points. */
static bool AreNewSamples(const kiriSheetData* sheet)
{
    const kiriSampleWork* work = &sheet->update->samples;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < work->newPoints.count; ++k) {
        areFine = IsInSquare(sheet, work->newPoints.data[k].at) && work->newPoints.data[k].cell >= 0 &&
                  work->newPoints.data[k].cell < sheet->grid.cells.count &&
                  kiriGrid_IsCell(&sheet->grid, work->newPoints.data[k].cell);
    }
    for (int32_t k = 0; areFine && k < work->movedPoints.count; ++k) {
        areFine = work->movedPoints.data[k].cell >= 0 && work->movedPoints.data[k].cell < sheet->grid.cells.count &&
                  work->movedPoints.data[k].frame >= 0 && work->movedPoints.data[k].frame < sheet->points.count;
    }
    return areFine;
}

/* Steps of kiri_stages.c and of those that it names: the last of each stage, and some after which more is there. */
enum { STEP_ORPHANS = 2, STEP_SITES = 1, STEP_LINKS = 3, STEP_SAMPLES = 2, STEP_POINTS = 6, STEP_PREPARE = 2 };

static bool IsStepOfStage(const kiriUpdate* u)
{
    static const int32_t last[KIRI_READY + 1] = { 1, 0, STEP_ORPHANS, STEP_LINKS, STEP_POINTS, STEP_PREPARE, 0 };
    return u->stage == KIRI_NONE || u->step <= last[u->stage];
}

/* Marks are of cells, of frames or of pieces, as the step at hand has them. */
static bool AreMarks(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    int64_t marks = u->placing.marks.count;
    if (u->stage == KIRI_STAGE_REGIONS && u->step == STEP_ORPHANS) {
        return marks == sheet->grid.cells.count;
    }
    if (u->stage == KIRI_STAGE_SHAPE && u->step == STEP_SITES) {
        return marks <= u->placing.sites.count && marks >= sheet->frames.count;
    }
    return u->stage != KIRI_STAGE_SAMPLES || u->step < STEP_POINTS || marks == u->next.pieces.count;
}

/* What is staged for the commit: pieces that links join. */
static bool IsStaged(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isLate = u->stage > KIRI_STAGE_SAMPLES || (u->stage == KIRI_STAGE_SAMPLES && u->step >= STEP_SAMPLES);
    if (u->stage == KIRI_READY || !isLate) {
        return kiriCheck_That(check, u->stage != KIRI_READY);
    }
    bool isFine = ArePieces(check, &u->next, u->placing.sites.count) &&
                  kiriCheck_That(check, AreLinksOfPieces(&u->next, sheet->links.next.data, sheet->links.next.count));
    for (int32_t p = 0; isFine && p < u->next.pieces.count; ++p) {
        int32_t origin = u->next.pieces.data[p].origin;
        isFine = origin >= KIRI_NONE && origin < sheet->layout.pieces.count;
    }
    return kiriCheck_That(check, isFine && u->material.count == u->placing.sites.count);
}

/* Sites are in cells that live, once they were found again in the new grid, and no two in one. */
static bool AreSitesIn(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool areFound =
        u->stage < KIRI_STAGE_GRID || u->stage > KIRI_STAGE_REGIONS || (u->stage == KIRI_STAGE_REGIONS && u->step > 0);
    uint8_t* isHeld = kiriCheck_Bytes(check, sheet->grid.cells.count);
    bool areFine = isHeld != NULL;
    for (int32_t i = 0; areFine && (areFound || !u->isScratch) && i < u->placing.sites.count; ++i) {
        const kiriSite* site = &u->placing.sites.data[i];
        areFine =
            kiriCheck_Object(check, kiriSiteMust, site) &&
            kiriCheck_That(check, !areFound || (kiriGrid_IsCell(&sheet->grid, site->cell) && !isHeld[site->cell]));
        isHeld[areFine ? site->cell : 0] = 1;
    }
    kiriMemory_Free(&check->memory, isHeld);
    return areFine;
}

/* Frames that appear take their motion from where there is a triangle. */
static bool AreNewFrames(const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < sheet->update->newFrames.count; ++k) {
        int32_t triangle = sheet->update->newFrames.data[k].triangle;
        areFine =
            triangle >= 0 && triangle < sheet->mesh.triangles.count && kiriMesh_IsTriangle(&sheet->mesh, triangle);
    }
    return areFine;
}

/* What rests has whatever the last work left there. */
static bool ArePartsOfWork(const kiriUpdate* u, const kiriSheetData* sheet)
{
    int64_t sites = u->placing.sites.count, fresh = sites - sheet->frames.count;
    bool isPlaced = u->stage == KIRI_STAGE_CONSTANTS && u->step > 0;
    if (u->stage == KIRI_NONE) {
        return fresh == 0;
    }
    return u->cut.taken <= u->cut.count && u->cut.count <= sheet->queue.count &&
           u->placing.movesSeen <= u->placing.moves.count && IsStepOfStage(u) &&
           (!isPlaced || u->newFrames.count <= fresh) &&
           (u->step < STEP_PREPARE || !isPlaced || u->newFrames.count == fresh) &&
           ((!u->placing.isTaking && !u->placing.isPlacing) || u->placing.placer.work != NULL);
}

/* The placer is amid a piece: which step it is of is known by the stage. */
static bool IsPlacing(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isAmid = u->placing.isTaking || u->placing.isPlacing;
    bool may =
        (u->stage == KIRI_STAGE_REGIONS && u->step == STEP_ORPHANS && u->placing.at < sheet->regions.orphans.count) ||
        (u->stage == KIRI_STAGE_SHAPE && u->step == STEP_SITES && u->placing.at < u->placing.marks.count) ||
        (u->stage == KIRI_STAGE_SAMPLES && u->step == STEP_POINTS);
    return !isAmid || may;
}

/* Grid, regions, shape functions, and what was done with them. */
static bool IsFollowed(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool areOwned = u->stage <= KIRI_STAGE_CUT || u->stage > KIRI_STAGE_REGIONS;
    bool isDividing = u->stage == KIRI_STAGE_SHAPE && u->step == STEP_LINKS - 1;
    return kiriGrid_Check(&sheet->grid, &sheet->mesh, check) && AreSitesIn(check, sheet) &&
           kiriRegions_Check(&sheet->regions, &sheet->grid, check, areOwned && !isDividing) &&
           kiriShape_Check(&sheet->shape, &sheet->grid, check) &&
           kiriPlacer_Check(&u->placing.placer, &sheet->grid, check, u->placing.isTaking, u->placing.isPlacing) &&
           kiriOwnership_Check(&u->refit.ownership, check, &sheet->mesh) &&
           kiriCheck_That(check, AreNewSamples(sheet) && AreMarks(sheet) && IsPlacing(sheet));
}

static bool IsWork(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    check->count[KIRI_OF_SAMPLES] =
        u->stage == KIRI_STAGE_SAMPLES && u->step == STEP_POINTS - 1 ? sheet->points.count : sheet->mesh.vertices.count;
    bool isPlaced = u->stage == KIRI_STAGE_CONSTANTS && u->step > 0;
    return kiriCheck_Object(check, UpdateMust, u) &&
           (!isPlaced || kiriCheck_That(check, AreNewFrames(sheet) && kiriRefit_HasRoom(&u->refit))) &&
           (!u->placing.isPlacing || u->stage != KIRI_STAGE_SHAPE || kiriCheck_Object(check, PlacingMust, u)) &&
           kiriCheck_That(check, ArePartsOfWork(u, sheet)) && kiriRefresh_Check(&u->samples.refresh, check) &&
           IsStaged(check, sheet);
}

/* ---- What is seen ------------------------------------------------------------------------------------------------- */

/* There may be more than the vertices of today need. */
static bool AreBlocks(const kiriBlocks* blocks, const kiriSheetData* sheet)
{
    int32_t count = blocks->movers.count;
    bool areFine = count > sheet->mesh.vertices.count / KIRI_BLOCK && blocks->touched.count == count &&
                   blocks->stale.count == count && blocks->frames.count == count &&
                   blocks->moved.count >= sheet->frames.count;
    for (int32_t k = 0; areFine && k < count; ++k) {
        areFine = blocks->movers.data[k] >= KIRI_UNKNOWN && blocks->movers.data[k] < sheet->frames.count;
    }
    return areFine;
}

static bool IsSeen(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriSeen* seen = &sheet->seen;
    return kiriSurface_Check(&seen->surface, &sheet->mesh, check) &&
           kiriFades_Check(&seen->fades, check, sheet->mesh.vertices.count) &&
           kiriFades_Check(&seen->pointFades, check, sheet->points.count) &&
           kiriCheck_That(check, AreBlocks(&seen->blocks, sheet) && seen->vertexCount >= 0);
}

/* ---- All of it ---------------------------------------------------------------------------------------------------- */

static const kiriMust SettingsMust[] = {
    KIRI_REALS(kiriSettings, snap, frameLength),
    KIRI_WITHIN(1, INT32_MAX, kiriSettings, maxFrames, maxFrames),
    KIRI_WITHIN(1, 64, kiriSettings, iterations, iterations),
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, kiriSettings, skinning, skinning),
    KIRI_REALS(kiriSettings, fadeTime, contactThickness),
    KIRI_REALS(kiriSettings, air, air),
    KIRI_REALS(kiriSettings, collisionPoints, integrationPoints),
    KIRI_WITHIN(1, 2, kiriSettings, integrationOrder, integrationOrder),
};

static bool AreSettings(kiriCheck* check, const kiriSettings* settings)
{
    return kiriMechanics_Check(&settings->mechanics, check) && kiriCheck_Object(check, SettingsMust, settings) &&
           kiriCheck_That(check, settings->snap >= 0.0 && settings->contactThickness > 0.0 &&
                                     settings->frameLength >= 0.0 && settings->collisionPoints >= 0.0 &&
                                     settings->collisionPoints <= 1 << 20 && settings->integrationPoints >= 0.0 &&
                                     settings->integrationPoints <= 1 << 20);
}

static bool AreFramesSound(kiriCheck* check, const kiriSheetData* sheet)
{
    bool areFine =
        kiriCheck_That(check, sheet->frames.count > 0 && sheet->regions.dirty.capacity >= sheet->frames.count);
    for (int32_t f = 0; areFine && f < sheet->frames.count; ++f) {
        areFine = kiriFrame_Check(&sheet->frames.data[f], check, &sheet->mesh);
    }
    return areFine;
}

/* Rows of pins, of clamps and of what they react with have room, and the solver is one of this sheet. */
static bool HasRoomForRows(kiriCheck* check, const kiriSheetData* sheet)
{
    int64_t pins = sheet->pins.count + 2 * (int64_t)sheet->layout.pinShares.count,
            shares = sheet->layout.pinShares.count;
    bool hasRoom = sheet->pinRows.capacity >= pins && sheet->clampRows.capacity >= shares &&
                   sheet->pinReactions.capacity >= pins && sheet->clampReactions.capacity >= shares &&
                   sheet->frameReactions.capacity >= sheet->frames.count;
    kiriSystem system = { .mechanics = sheet->settings.mechanics,
                          .frames = sheet->frames.data,
                          .frameCount = sheet->frames.count,
                          .links = sheet->links.links.data,
                          .linkCount = sheet->links.links.count,
                          .corners = sheet->links.corners.data,
                          .cornerCount = sheet->links.corners.count,
                          .areaElements = &sheet->layout.areaElements,
                          .material = sheet->settings.material };
    bool isShort = false;
    hasRoom = hasRoom && kiriSolver_Fits(sheet->solver, &system, sheet->layout.framePiece.data,
                                         sheet->layout.pieces.count, &isShort);
    check->isShort |= isShort;
    return kiriCheck_That(check, hasRoom || isShort);
}

/* Between two ticks nobody waits. */
static bool AreTurns(kiriCheck* check, const kiriSheetData* sheet)
{
    bool waits = sheet->turns.waiting != 0;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        waits = waits || sheet->layout.pieces.data[p].rest.waits;
    }
    return kiriCheck_That(check, !waits && sheet->turns.next >= 0);
}

/* Grid, regions and shape functions that an update left behind are made anew before anybody asks them. */
static bool AreLeft(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    check->count[KIRI_OF_CELLS] = INT32_MAX;
    check->count[KIRI_OF_FACES] = INT32_MAX;
    return kiriCheck_That(check, sheet->update->stage == KIRI_STAGE_GRID || sheet->update->stage <= KIRI_STAGE_CUT) &&
           kiriGrid_CheckLeft(grid, check);
}

bool kiriSheet_Check(kiriSheetData* sheet, kiriCheck* check)
{
    const kiriUpdate* u = sheet->update;
    kiriMesh_Count(&sheet->mesh, check);
    check->count[KIRI_OF_FRAMES] = sheet->frames.count;
    check->count[KIRI_OF_SITES] = u->placing.sites.count;
    bool isMesh = kiriMesh_Check(&sheet->mesh, check) && AreSettings(check, &sheet->settings) &&
                  AreFramesSound(check, sheet) && kiriCheck_That(check, u->placing.sites.count >= sheet->frames.count);
    return isMesh && (u->needsRebuild ? AreLeft(check, sheet) : IsFollowed(check, sheet)) &&
           kiriLinks_Check(&sheet->links, &sheet->grid, &sheet->mesh, &sheet->regions, check) &&
           IsLayout(check, sheet) && AreTurns(check, sheet) && ArePins(check, sheet) &&
           kiriSkin_Check(&sheet->vertexSkin, check, sheet->mesh.vertices.count, &sheet->mesh) &&
           kiriSkin_Check(&sheet->pointSkin, check, sheet->points.count, NULL) &&
           kiriCheck_That(
               check, AreElementsOfPieces(&sheet->layout) && AreSamplesOfPieces(&sheet->layout, &sheet->vertexSkin) &&
                          AreSamplesOfPieces(&sheet->layout, &sheet->pointSkin) && AreTrianglesOfPieces(sheet)) &&
           IsWork(check, sheet) && ArePoints(check, sheet) && kiriCuts_Check(sheet, check) && IsSeen(check, sheet) &&
           AreContacts(check, sheet) && HasRoomForRows(check, sheet);
}
