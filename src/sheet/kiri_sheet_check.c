#include "kiri_sheet_check.h"
#include "../mesh/kiri_mesh_check.h"
#include "../motion/kiri_motion_check.h"
#include "../view/kiri_view_check.h"
#include "kiri_seen.h"
#include "kiri_piece.h"
#include "kiri_pin.h"
#include "kiri_update.h"

static const kiriMust TipMust[] = {
    KIRI_REALS(kiriTip, last, last),
    KIRI_INDEX_OR_NONE(KIRI_OF_VERTICES, kiriTip, blade.vertex, blade.vertex),
    KIRI_WITHIN(0, 0, kiriTip, blade.owed, blade.owed),
    KIRI_WITHIN(KIRI_BLADE_RESTS, KIRI_BLADE_RESTS, kiriTip, blade.phase, blade.phase),
};

static bool IsTip(kiriCheck* check, const kiriSheetData* sheet, const kiriTip* tip)
{
    const kiriBladeTip* blade = &tip->blade;
    bool isFine = kiriCheck_Object(check, TipMust, tip) &&
                  kiriCheck_That(check, kiriLattice_Has(blade->at) && kiriLattice_Has(blade->from) &&
                                            kiriLattice_Has(blade->to) && kiriLattice_Has(blade->goal) &&
                                            kiriLattice_Has(blade->lip));
    if (isFine && blade->vertex != KIRI_NONE) {
        kiriLatticePoint at = sheet->mesh.vertices.data[blade->vertex].at;
        isFine = at.x == blade->at.x && at.y == blade->at.y;
    }
    return kiriCheck_That(check, isFine);
}

/* As many points of each cut wait as it says. */
static bool ArePointsCounted(kiriCheck* check, const kiriSheetData* sheet)
{
    int32_t* waiting = (int32_t*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(int32_t) *
                                                                   (sheet->cuts.count > 0 ? sheet->cuts.count : 1));
    bool areFine = waiting != NULL;
    for (int32_t k = 0; areFine && k < sheet->queue.count; ++k) {
        waiting[sheet->queue.data[k].cut->index] += 1;
    }
    for (int32_t c = 0; areFine && c < sheet->cuts.count; ++c) {
        areFine = waiting[c] == sheet->cuts.data[c]->waiting;
    }
    kiriMemory_Free(&check->memory, waiting);
    return kiriCheck_That(check, areFine);
}

static bool AreCuts(kiriCheck* check, const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t c = 0; areFine && c < sheet->cuts.count; ++c) {
        areFine =
            IsTip(check, sheet, &sheet->cuts.data[c]->tip) && IsTip(check, sheet, &sheet->cuts.data[c]->committed);
    }
    return areFine && ArePointsCounted(check, sheet);
}

static const kiriMust PointMust[] = {
    KIRI_REALS(kiriQueuedPoint, to, to),
    KIRI_COUNTS(kiriQueuedPoint, stamp, stamp),
};

static bool IsQueue(kiriCheck* check, const kiriSheetData* sheet)
{
    bool isFine = true;
    for (int32_t k = 0; isFine && k < sheet->queue.count; ++k) {
        const kiriQueuedPoint* point = &sheet->queue.data[k];
        isFine = kiriCheck_Object(check, PointMust, point) && kiriCheck_That(check, !point->ends || point->cut->ended);
    }
    return isFine;
}

bool kiriCuts_Check(const kiriSheetData* sheet, kiriCheck* check)
{
    return AreCuts(check, sheet) && IsQueue(check, sheet);
}

/* ---- Layout ------------------------------------------------------------------------------------------------------ */

static const kiriMust IsPieceIndex[] = { KIRI_INDEX(KIRI_OF_PIECES, kiriSpan, first, first) };
static const kiriMust IsFrameIndex[] = { KIRI_INDEX(KIRI_OF_FRAMES, kiriSpan, first, first) };

static const kiriMust PieceMust[] = {
    KIRI_REALS(kiriPiece, area, area),
    KIRI_INDEX(KIRI_OF_FRAMES, kiriPiece, frame, frame),
    KIRI_REALS(kiriPiece, rest.calm, rest.calm),
};

static const kiriMust LineShareMust[] = {
    KIRI_INDEX(KIRI_OF_FRAMES, kiriLineShare, frame, frame),
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
    KIRI_LENGTH(KIRI_OF_FRAMES, kiriLayout, framePiece),
};

static const kiriMust LayoutMust[] = {
    KIRI_ITEMS_MUST(kiriLayout, pinFrame, IsFrameIndex),
    KIRI_LENGTH(KIRI_OF_PINS, kiriLayout, pinFrame),
    KIRI_ITEMS_MUST(kiriLayout, severed, SeveredMust),
    KIRI_ITEMS_MUST(kiriLayout, pinShares, PinShareMust),
};

/* A sheet goes with its last piece. */
static bool IsAnyLeft(const kiriLayout* layout)
{
    bool isLeft = false;
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        isLeft = isLeft || !layout->pieces.data[p].isGone;
    }
    return isLeft;
}

/* Pieces are numbered by their lowest frame. */
static bool ArePieces(kiriCheck* check, const kiriLayout* layout)
{
    int64_t frames = check->count[KIRI_OF_FRAMES];
    check->count[KIRI_OF_PIECES] = layout->pieces.count;
    bool areFine = kiriCheck_Object(check, PiecesMust, layout);
    int32_t pieces = 0;
    for (int32_t f = 0; areFine && f < frames; ++f) {
        int32_t piece = layout->framePiece.data[f];
        areFine = kiriCheck_That(check, piece <= pieces && (piece < pieces || layout->pieces.data[piece].frame == f));
        pieces += piece == pieces;
    }
    return areFine && kiriCheck_That(check, pieces == layout->pieces.count && IsAnyLeft(layout));
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
    KIRI_REALS(kiriSheetData, shape.rigidWeight, shape.rigidWeight),
    KIRI_ITEMS_MUST(kiriSheetData, linkParts, kiriMustBeReal),
    KIRI_ITEMS_MUST(kiriSheetData, strainOffsets.strainOffsets, OffsetsMust),
};

/* In force, but for what names links. */
static bool IsLayout(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriLayout* layout = &sheet->layout;
    check->count[KIRI_OF_PINS] = sheet->pins.count;
    check->count[KIRI_OF_LINKS] = INT32_MAX;
    return ArePieces(check, layout) && kiriCheck_Object(check, LayoutMust, layout) &&
           kiriAreaElements_Check(&layout->areaElements, check) && kiriCheck_Object(check, RowsMust, sheet) &&
           kiriCheck_That(check, AreShares(&layout->pinShares, sheet));
}

/* Arrays with an item a link. Links are derived after the other checks. */
static bool IsOfLinks(kiriCheck* check, const kiriSheetData* sheet)
{
    int32_t links = sheet->links.links.count, offsets = sheet->strainOffsets.strainOffsets.count;
    bool isFine = (offsets == 0 || (offsets == links && kiriSheet_KeepsStrains(sheet))) &&
                  sheet->linkParts.count == (sheet->layout.severed.count > 0 ? links : 0);
    for (int32_t k = 0; isFine && k < sheet->layout.severed.count; ++k) {
        isFine = sheet->layout.severed.data[k].link < links;
    }
    return kiriCheck_That(check, isFine);
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

/* ---- Pins, points and contacts ----------------------------------------------------------------------------------- */

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
                 (vertex[k] >= 0 && vertex[k] < sheet->mesh.vertices.count && (k == 0 || vertex[k - 1] != KIRI_NONE));
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
    return areFine;
}

/* ---- What is seen ------------------------------------------------------------------------------------------------ */

/* There may be more than the vertices of today need. */
static bool AreBlocks(const kiriBlocks* blocks, const kiriSheetData* sheet)
{
    int32_t count = blocks->movers.count;
    bool areFine = count > sheet->mesh.vertices.count / KIRI_BLOCK && blocks->touched.count == count &&
                   blocks->stale.count == count && blocks->frames.count == count &&
                   blocks->moved.count >= sheet->frames.count;
    for (int32_t k = 0; areFine && k < count; ++k) {
        int32_t mover = blocks->movers.data[k];
        areFine = mover == KIRI_UNKNOWN || mover == KIRI_NONE ||
                  kiriLabels_Has(&sheet->shape.labels, mover, sheet->frames.count);
    }
    return areFine;
}

static bool AreFadesSet(const kiriFades* fades, const kiriSettings* settings)
{
    return fades->time == settings->fadeTime && fades->least == settings->leastFade;
}

static bool IsSeen(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriSeen* seen = &sheet->seen;
    return kiriSurface_Check(&seen->surface, &sheet->shape.labels, &sheet->mesh, check) &&
           kiriFades_Check(&seen->fades, check, sheet->mesh.vertices.count) &&
           kiriFades_Check(&seen->pointFades, check, sheet->points.count) &&
           kiriCheck_That(check, AreFadesSet(&seen->fades, &sheet->settings) &&
                                     AreFadesSet(&seen->pointFades, &sheet->settings) &&
                                     AreBlocks(&seen->blocks, sheet) && seen->vertexCount >= 0);
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

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
    bool areFine = kiriCheck_That(check, sheet->frames.count > 0 && sheet->regions.dirty.count == sheet->frames.count &&
                                             kiriLabels_AreSound(&sheet->shape.labels, sheet->frames.count));
    for (int32_t f = 0; areFine && f < sheet->frames.count; ++f) {
        areFine = kiriFrame_Check(&sheet->frames.data[f], check, &sheet->mesh);
    }
    return areFine;
}

/* Rows of pins, of clamps and of what they react with have room. */
static bool HasRoomForRows(kiriCheck* check, const kiriSheetData* sheet)
{
    int64_t pins = sheet->pins.count + 2 * (int64_t)sheet->layout.pinShares.count,
            shares = sheet->layout.pinShares.count;
    bool hasRoom = sheet->pinRows.capacity >= pins && sheet->clampRows.capacity >= shares &&
                   sheet->pinReactions.capacity >= pins && sheet->clampReactions.capacity >= shares &&
                   sheet->frameReactions.capacity >= sheet->frames.count;
    return kiriCheck_That(check, hasRoom);
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

bool kiriSheet_Check(kiriSheetData* sheet, kiriCheck* check)
{
    kiriMesh_Count(&sheet->mesh, check);
    check->count[KIRI_OF_FRAMES] = sheet->frames.count;
    bool isMesh =
        kiriMesh_Check(&sheet->mesh, check) && AreSettings(check, &sheet->settings) && AreFramesSound(check, sheet);
    return isMesh && IsLayout(check, sheet) && AreTurns(check, sheet) && ArePins(check, sheet) &&
           kiriCheck_That(check, AreElementsOfPieces(&sheet->layout)) && ArePoints(check, sheet) &&
           kiriCuts_Check(sheet, check) && IsSeen(check, sheet) && AreContacts(check, sheet);
}

bool kiriSheet_CheckMade(const kiriSheetData* sheet, kiriCheck* check)
{
    return IsOfLinks(check, sheet) && HasRoomForRows(check, sheet);
}
