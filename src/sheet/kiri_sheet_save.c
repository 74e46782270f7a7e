#include "kiri_sheet_save.h"

#include "../field/kiri_field_save.h"
#include "../mesh/kiri_mesh_check.h"
#include "../motion/kiri_motion_check.h"
#include "kiri_build.h"
#include "kiri_detach.h"
#include "kiri_seen.h"
#include "kiri_touch.h"
#include "kiri_update.h"

/* ---- Settings and layout ----------------------------------------------------------------------------------------- */

KIRI_TABLE(SettingsTable, kiriSettings, {
    KIRI_RUN(4, material),
    KIRI_PART(mechanics, kiriMechanicsTable),
    KIRI_REALS(snap, frameLength),
    KIRI_WITHIN(1, INT32_MAX, maxFrames),
    KIRI_WITHIN(1, 64, iterations),
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, skinning),
    KIRI_REALS(fadeTime, foldThickness),
    KIRI_RUN(4, groups),
    KIRI_BOOLS(touchesSheets, selfContact),
    KIRI_REALS(air),
    KIRI_RUN(4, tearing),
    KIRI_REALS(collisionPoints, integrationPoints),
    KIRI_WITHIN(1, 2, integrationOrder),
    KIRI_BOOLS(popping, eased),
    KIRI_UNHASHED,
    KIRI_RUN(4, given),
    KIRI_RUN(8, userData),
    KIRI_BOOLS(fromScratch),
})

KIRI_TABLE(RestTable, kiriRest, {
    KIRI_REALS(calm),
    KIRI_BOOLS(asleep),
    KIRI_UNHASHED,
    KIRI_BOOLS(isStirred, isFading),
})

KIRI_TABLE(PieceTable, kiriPiece, {
    KIRI_BOOLS(isGone),
    KIRI_PART(rest, RestTable),
    KIRI_UNHASHED,
    KIRI_REALS(area),
    KIRI_INDEX(KIRI_OF_FRAMES, frame),
    KIRI_RUN(4, origin),
    KIRI_BOOLS(cameOff),
    KIRI_BOOLS(isTouched),
    KIRI_RUN(4, awake),
})

KIRI_TABLE(SeveredLinkTable, kiriSeveredLink, {
    KIRI_INDEX(KIRI_OF_PINS, pin),
    KIRI_WITHIN(0, INT32_MAX, link),
    KIRI_REALS(part, held),
})

KIRI_TABLE(LinkPartTable, kiriLinkPart, {
    KIRI_REALS(part, free),
})

KIRI_TABLE(LineShareTable, kiriLineShare, {
    KIRI_INDEX(KIRI_OF_FRAMES, frame),
    KIRI_REALS(length, ends),
    KIRI_RUN(4, open),
})

KIRI_TABLE(PinShareTable, kiriPinShare, {
    KIRI_INDEX(KIRI_OF_PINS, pin),
    KIRI_PART(share, LineShareTable),
    KIRI_REALS(offset),
    KIRI_PART(plastic, kiriPlasticTable),
    KIRI_REALS(reactions, bore),
})

KIRI_TABLE(LayoutTable, kiriLayout, {
    KIRI_PARTS(pieces, PieceTable),
    KIRI_INDICES(KIRI_OF_PIECES, framePiece),
    KIRI_INDICES(KIRI_OF_FRAMES, pinFrame),
    KIRI_PARTS(severed, SeveredLinkTable),
    KIRI_PARTS(pinShares, PinShareTable),
    KIRI_PART(areaElements, kiriAreaElementsTable),
})

/* ---- Pins and contacts ------------------------------------------------------------------------------------------- */

KIRI_TABLE(PinAnchorTable, kiriPinAnchor, {
    KIRI_REALS(local),
    KIRI_UNHASHED,
    KIRI_RUN(4, obstacle),
    KIRI_REALS(give, softness),
})

KIRI_TABLE(PinDataTable, kiriPinData, {
    KIRI_WITHIN(KIRI_PIN_POINT, KIRI_PIN_CLAMP, type),
    KIRI_RUN(4, at, to),
    KIRI_REALS(target, breakForce),
    KIRI_PART(anchor, PinAnchorTable),
    KIRI_REALS(stiffness, bore),
    KIRI_UNHASHED,
    KIRI_RUN(4, id),
    KIRI_RUN(8, userData),
})

KIRI_TABLE(ContactTable, kiriContact, {
    KIRI_RUN(4, point),
    KIRI_FLOATS(normal, pushSpeed),
    KIRI_RUN(4, obstacle),
    KIRI_UNHASHED,
    KIRI_FLOATS(restPoint),
})

KIRI_TABLE(GivenContactTable, kiriGivenContact, {
    KIRI_PART(contact, ContactTable),
    KIRI_REALS(share),
    KIRI_UNHASHED,
    KIRI_RUN(4, vertex),
})

KIRI_TABLE(TouchTable, kiriTouch, {
    KIRI_RUN(8, key),
    KIRI_REALS(normal, pushSpeed),
    KIRI_UNHASHED,
    KIRI_RUN(4, point, vertex),
    KIRI_REALS(share, on),
    KIRI_RUN(4, yield),
    KIRI_REALS(felt),
    KIRI_RUN(4, row),
    KIRI_REALS(force),
})

KIRI_TABLE(TouchForceTable, kiriTouchForce, {
    KIRI_RUN(8, key),
    KIRI_REALS(force, normal),
})

KIRI_TABLE(TouchMemoryTable, kiriTouchMemory, {
    KIRI_PARTS(touches, TouchTable),
    KIRI_PARTS(forces, TouchForceTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, given),
})

KIRI_TABLE(ContactForceTable, kiriContactForce, {
    KIRI_RUN(8, impulse, depth),
    KIRI_RUN(4, point, obstacle),
})

/* Sums are a cache: a load computes them again. */
KIRI_TABLE(RestLoadsTable, kiriRestLoads, {
    KIRI_UNHASHED,
    KIRI_ROOM_OF(on),
    KIRI_DROPPED(dt, areSummed),
})

KIRI_TABLE(TouchesTable, kiriTouches, {
    KIRI_PART(last, TouchMemoryTable),
    KIRI_PART(slept, TouchMemoryTable),
    KIRI_UNHASHED,
    KIRI_SPACE_OF(found),
    KIRI_ROOMS(yields, rows, order),
    KIRI_PART(rests, RestLoadsTable),
    KIRI_BOOLS(isShort),
    KIRI_HANDED,
    KIRI_PARTS(told, ContactForceTable),
    KIRI_ROOM_OF(nextTold),
})

/* ---- Visible state ----------------------------------------------------------------------------------------------- */

KIRI_TABLE(BlocksTable, kiriBlocks, {
    KIRI_DERIVED,
    KIRI_ARRAYS(touched, movers, moved),
})

KIRI_TABLE(SeenTable, kiriSeen, {
    KIRI_PART(fades, kiriFadesTable),
    KIRI_PART(pointFades, kiriFadesTable),
    KIRI_PART(surface, kiriSurfaceTable),
    KIRI_UNHASHED,
    KIRI_KEPT(bounds),
    KIRI_RUN(4, pointCount),
    KIRI_ROOM_OF(pointsBefore),
    KIRI_BOOLS(isElsewhere),
    KIRI_WITHIN(0, INT32_MAX, vertexCount),
    KIRI_BOOLS(areFadesAsleep),
    KIRI_DERIVED,
    KIRI_PART(blocks, BlocksTable),
    KIRI_ARRAYS(exactPoints),
    KIRI_HANDED,
    KIRI_ARRAYS(pointPositions),
})

/* A load chooses the probes again; their velocities are saved. */
KIRI_TABLE(ProbesTable, kiriProbes, {
    KIRI_BOOLS(isFresh, folds),
    KIRI_RUN(4, block),
    KIRI_ITEMS(8, velocities),
    KIRI_ITEMS(8, speeds),
    KIRI_DROPPED(areGrouped),
    KIRI_DROPPED(sheet, list),
    KIRI_DROPPED(boxes, touch),
    KIRI_DROPPED(marks, rooms),
    KIRI_DROPPED(limits),
})

/* ---- Work on a cut ----------------------------------------------------------------------------------------------- */

KIRI_TABLE(PlacingWorkTable, kiriPlacingWork, {
    KIRI_DERIVED,
    KIRI_ARRAYS(sites, moves, marks, allowed, flags, own),
    KIRI_PART(placer, kiriPlacerTable),
})

KIRI_TABLE(SampleWorkTable, kiriSampleWork, {
    KIRI_DERIVED,
    KIRI_PART(refresh, kiriRefreshTable),
    KIRI_ARRAYS(newPoints, movedPoints),
})

KIRI_TABLE(UpdateTable, kiriUpdate, {
    KIRI_BOOLS(isUnsettled, isNew),
    KIRI_DERIVED,
    KIRI_PART(placing, PlacingWorkTable),
    KIRI_PART(samples, SampleWorkTable),
    KIRI_PART(refit, kiriRefitTable),
    KIRI_PART(next, LayoutTable),
    KIRI_ARRAYS(material, newFrames, parent),
    KIRI_DROPPED(integration),
})

KIRI_TABLE(BladeTipTable, kiriBladeTip, {
    KIRI_RUN(4, at),
    KIRI_INDEX_OR_NONE(KIRI_OF_VERTICES, vertex),
    KIRI_WITHIN(KIRI_BLADE_RESTS, KIRI_BLADE_RESTS, phase),
    KIRI_COUNTS(owed),
    KIRI_UNHASHED,
    KIRI_RUN(4, from, lip),
    KIRI_WITHIN(0, KIRI_MOST_FOLDS, fold),
    KIRI_WITHIN(0, 0, unused),
})

KIRI_TABLE(TipTable, kiriTip, {
    KIRI_REALS(last),
    KIRI_PART(blade, BladeTipTable),
})

KIRI_TABLE(CutDataTable, kiriCutData, {
    KIRI_PART(tip, TipTable),
    KIRI_REALS(tears, rests),
    KIRI_BOOLS(ended),
    KIRI_UNHASHED,
    KIRI_RUN(4, id),
    KIRI_DROPPED(sheet, index),
    KIRI_DROPPED(waiting),
})

KIRI_TABLE(QueuedPointTable, kiriQueuedPoint, {
    KIRI_REALS(to),
    KIRI_BOOLS(jump, ends),
    KIRI_UNHASHED,
    KIRI_COUNTS(stamp),
    KIRI_DROPPED(cut),
})

/* ---- The sheet --------------------------------------------------------------------------------------------------- */

KIRI_TABLE(SampleTable, kiriSample, {
    KIRI_RUN(4, at),
    KIRI_DERIVED,
})

KIRI_TABLE(SheetRestTable, kiriSheetRest, {
    KIRI_BOOLS(asleep),
    KIRI_UNHASHED,
    KIRI_BOOLS(isStirred, isIdle),
})

KIRI_TABLE(TurnsTable, kiriPieceTurns, {
    KIRI_WITHIN(0, INT32_MAX, next),
    KIRI_WITHIN(0, 0, waiting),
})

KIRI_TABLE(StrainWatchTable, kiriStrainWatch, {
    KIRI_REALS(done, strained),
    KIRI_WITHIN(0, 2, rounds),
})

static void CountItems(const kiriSheetData* sheet, int64_t count[KIRI_OF_COUNT])
{
    count[KIRI_OF_TRIANGLES] = sheet->mesh.triangles.count;
    count[KIRI_OF_HALF_EDGES] = 3 * count[KIRI_OF_TRIANGLES];
    count[KIRI_OF_VERTICES] = sheet->mesh.vertices.count;
    count[KIRI_OF_FRAMES] = sheet->frames.count;
    count[KIRI_OF_PIECES] = sheet->layout.pieces.count;
    count[KIRI_OF_PINS] = sheet->pins.count;
    count[KIRI_OF_POINTS] = sheet->points.count;
}

/* Counts come first: a load checks indices against them as it reads. Pins and points may be missing. */
static void MoveCounts(kiriArchive* archive, void* object)
{
    int64_t* count = archive->count;
    CountItems(object, count);
    KIRI_TIMES(k, KIRI_OF_COUNT) {
        if (k == KIRI_OF_HALF_EDGES) {
            count[k] = 3 * count[KIRI_OF_TRIANGLES];
        } else {
            count[k] = kiriArchive_Count(archive, count[k], k < KIRI_OF_PINS,
                                         k == KIRI_OF_TRIANGLES ? KIRI_MOST_TRIANGLES : INT32_MAX);
        }
    }
}

KIRI_TABLE(TearLineTable, kiriTearLine, {
    KIRI_REALS(from, factor),
})

static void HashTearLines(kiriArchive* archive, void* object)
{
    const kiriSheetData* sheet = object;
    if (archive->mode == KIRI_ARCHIVE_HASH) {
        kiriArchive_Objects(archive, TearLineTable, sheet->tearLines.data, sheet->tearLines.count);
    }
}

/* A load finds the tips again. */
KIRI_TABLE(TearsTable, kiriTears, {
    KIRI_DROPPED(areListed),
    KIRI_ROOMS(found, order, pulls, regions, before),
})

KIRI_TABLE(SheetTable, kiriSheetData, {
    KIRI_CUSTOM(id, MoveCounts),
    KIRI_PART(settings, SettingsTable),
    KIRI_PART(mesh, kiriMeshTable),
    KIRI_PART(shape, kiriShapeTable),
    KIRI_OWNED(update, UpdateTable),
    KIRI_PARTS(frames, kiriFrameTable),
    KIRI_PART(layout, LayoutTable),
    KIRI_PART(strainOffsets, kiriStrainOffsetsTable),
    KIRI_PART(plastics, kiriPlasticsTable),
    KIRI_PARTS(points, SampleTable),
    KIRI_PARTS(pins, PinDataTable),
    KIRI_PARTS(contacts, GivenContactTable),
    KIRI_ITEMS(4, leaving),
    KIRI_COUNTS(leavingPaid),
    KIRI_PARTS(linkParts, LinkPartTable),
    KIRI_PART(touches, TouchesTable),
    KIRI_PART(rest, SheetRestTable),
    KIRI_PART(turns, TurnsTable),
    KIRI_PART(seen, SeenTable),
    KIRI_CUSTOM(tearLines, HashTearLines),
    KIRI_UNHASHED,
    KIRI_PARTS(tearLines, TearLineTable),
    KIRI_PART(watch, StrainWatchTable),
    KIRI_RUN(4, id),
    KIRI_PART(regions, kiriRegionsTable),
    KIRI_PART(probes, ProbesTable),
    KIRI_ROOM_OF(sewn),
    KIRI_PART(tears, TearsTable),
    KIRI_ROOMS(pinRows, clampRows, drawnPins),
    KIRI_KEPT(memory, shown),
    KIRI_DROPPED(solver, cuts),
    KIRI_DROPPED(line, lineShares),
    KIRI_DROPPED(lists),
    KIRI_DROPPED(past, pastRoom),
    KIRI_DERIVED,
    KIRI_PART(grid, kiriGridTable),
    KIRI_PART(links, kiriLinksTable),
    KIRI_PART(vertexSkin, kiriSkinTable),
    KIRI_PART(pointSkin, kiriSkinTable),
    KIRI_PART(pointPlaces, kiriPlacesTable),
})

/* Moves the cuts and their pending points, which are blocks of the world's memory. */
static void MoveCuts(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory)
{
    int32_t cuts = kiriArchive_Count(archive, sheet->cuts.count, 0, INT32_MAX);
    KIRI_TIMES_WHILE(!kiriArchive_HasFailed(archive), i, cuts) {
        if (kiriArchive_Reads(archive)) {
            kiriCutData* cut = kiriMemory_AllocZeroed(memory, sizeof(kiriCutData));
            archive->isShort |= cut == NULL || !kiriArray_Push(memory, &sheet->cuts, cut);
        }
        KIRI_ASSERT(archive->isShort || (i < sheet->cuts.count && sheet->cuts.data[i] != NULL));
        if (!archive->isShort) {
            kiriArchive_Object(archive, CutDataTable, sheet->cuts.data[i]);
        }
        if (kiriArchive_Reads(archive) && !archive->isShort) {
            sheet->cuts.data[i]->sheet = sheet;
            sheet->cuts.data[i]->index = i;
        }
    }
    int32_t points = kiriArchive_Count(archive, sheet->queue.count, 0, INT32_MAX);
    KIRI_TIMES_WHILE(!kiriArchive_HasFailed(archive), i, points) {
        kiriQueuedPoint none = { 0 };
        if (kiriArchive_Reads(archive) && !kiriArray_Push(memory, &sheet->queue, none)) {
            archive->isShort = true;
            return;
        }
        kiriQueuedPoint* point = &sheet->queue.data[i];
        int32_t cut = kiriArchive_Count(archive, point->cut != NULL ? point->cut->index : 0, 0, sheet->cuts.count - 1);
        kiriArchive_Object(archive, QueuedPointTable, point);
        if (kiriArchive_Reads(archive) && !kiriArchive_HasFailed(archive)) {
            KIRI_ASSERT_HAS(sheet->cuts, cut);
            point->cut = sheet->cuts.data[cut];
            point->cut->waiting += 1;
        }
    }
}

/* Returns true if vertices and normals follow from patches, fades and triangles: weights have not changed since they
   were written. */
static bool AreWeightsSeen(const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    return !sheet->seen.isElsewhere && surface->isSteady &&
           surface->patches.count == sheet->frames.count &&
           surface->vertexCount == sheet->seen.vertexCount && surface->vertexCount == sheet->mesh.vertices.count;
}

/* Reserves for the vertices of a save, which come next. */
static void ReserveSeen(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    const kiriViewCounts counts = { sheet->mesh.vertices.count, sheet->mesh.triangles.count, sheet->frames.count,
                                    sheet->points.count };
    KIRI_ASSERT(kiriArchive_Reads(archive) && !archive->isWhole && !kiriArchive_HasFailed(archive));
    archive->isShort |= !kiriView_Reserve(sheet, counts);
    surface->vertexCount = counts.vertices;
    surface->triangleCount = counts.triangles;
    kiriArchive_Expect(archive,
                       surface->carriers.count >= counts.frames && surface->patches.count <= counts.frames &&
                           sheet->seen.pointCount >= 0 && sheet->seen.pointCount <= counts.points &&
                           (surface->before.count == 0 || surface->before.count == 3 * (int64_t)counts.vertices) &&
                           kiriSurface_AreChangesSound(surface));
    if (!kiriArchive_HasFailed(archive)) {
        kiriView_Resize(sheet, counts.frames);
    }
}

/* Moves the visible vertices and points, and whether bounds are in use. */
static void MoveSeen(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriBounds* bounds = sheet->seen.bounds;
    int32_t isThere = kiriArchive_Count(archive, bounds->levelCount > 0, 0, 1);
    kiriArchive_Int32(archive, &bounds->asked);
    kiriArchive_Int32(archive, &bounds->patience);
    kiriArchive_Expect(archive, bounds->patience >= 0 && bounds->patience <= KIRI_BOUNDS_PATIENCE);
    bounds->levelCount = kiriArchive_Reads(archive) ? isThere : bounds->levelCount;
    if (kiriArchive_Reads(archive) && !archive->isWhole && !kiriArchive_HasFailed(archive)) {
        ReserveSeen(archive, sheet);
    }
    if (archive->isWhole || kiriArchive_HasFailed(archive)) {
        return;
    }
    if (!AreWeightsSeen(sheet)) {
        kiriArchive_Numbers(archive, kiriSurface_Places(surface), 4, 3 * (int64_t)surface->vertexCount);
        kiriArchive_Numbers(archive, surface->normals.data, 4, surface->normals.count);
    }
    kiriArchive_Numbers(archive, sheet->seen.exactPoints.data, 8, 3 * (int64_t)sheet->seen.exactPoints.count);
    kiriArchive_Numbers(archive, sheet->seen.pointPositions.data, 4, sheet->seen.pointPositions.count);
}

void kiriSheet_Archive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory)
{
    bool isHash = archive->mode == KIRI_ARCHIVE_HASH;
    KIRI_ASSERT(memory != &sheet->own && sheet->memory == &sheet->own);
    archive->memory = &sheet->own;
    archive->shown = &sheet->shown;
    kiriArchive_Object(archive, SheetTable, sheet);
    int64_t count[KIRI_OF_COUNT];
    CountItems(sheet, count);
    kiriArchive_Expect(archive, memcmp(count, archive->count, sizeof(count)) == 0 &&
                                    sheet->layout.framePiece.count == sheet->frames.count &&
                                    sheet->layout.pinFrame.count == sheet->pins.count && sheet->update != NULL);
    if (isHash) {
        uint64_t pattern = kiriSolver_Hash(sheet->solver);
        kiriArchive_Numbers(archive, &pattern, 8, 1);
    } else {
        kiriSolver_Archive(archive, &sheet->solver, &sheet->settings.mechanics);
    }
    if (!kiriArchive_HasFailed(archive) && !isHash) {
        MoveSeen(archive, sheet);
    }
    if (!kiriArchive_HasFailed(archive)) {
        MoveCuts(archive, sheet, memory);
    }
    if (kiriArchive_Reads(archive) && !kiriArchive_HasFailed(archive)) {
        kiriPlacerWork* work = sheet->update->placing.placer.work;
        sheet->mesh.memory = &sheet->own;
        sheet->grid.mesh = &sheet->mesh;
        if (work != NULL && work->hasOld && work->old == NULL) {
            work->old = &sheet->regions.field;
        }
    }
    archive->memory = memory;
}

void kiriSheet_HashLayout(uint64_t* hash)
{
    kiriArchive_HashLayout(SheetTable, hash);
    kiriArchive_HashLayout(CutDataTable, hash);
    kiriArchive_HashLayout(QueuedPointTable, hash);
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

/* Returns true if blades can reach the point. */
static bool IsOnLattice(kiriLatticePoint at)
{
    enum { MOST = KIRI_LATTICE + KIRI_LATTICE / 2 + 2 };
    return at.x >= -MOST && at.x <= MOST && at.y >= -MOST && at.y <= MOST;
}

static bool AreCuts(const kiriSheetData* sheet)
{
    bool areFine = true;
    KIRI_EACH_INDEX_WHILE(areFine, c, sheet->cuts) {
        const kiriCutData* cut = sheet->cuts.data[c];
        KIRI_ASSERT(cut->sheet == sheet && cut->index == c);
        const kiriBladeTip* blade = &cut->tip.blade;
        double along = kiriVec2_Dot(cut->tears, cut->tears);
        areFine =
            (along == 0.0 || fabs(along - 1.0) < 1e-6) && IsOnLattice(blade->at) && IsOnLattice(blade->from) &&
            IsOnLattice(blade->to) && IsOnLattice(blade->goal) && IsOnLattice(blade->lip) && blade->owed == 0 &&
            blade->fold <= sheet->mesh.folds.count &&
            (blade->vertex == KIRI_NONE || kiriLattice_IsSame(kiriMesh_At(&sheet->mesh, blade->vertex), blade->at));
    }
    KIRI_EACH_WHILE(areFine, const kiriQueuedPoint, point, sheet->queue) {
        areFine = !point->ends || point->cut->ended;
    }
    KIRI_EACH(const kiriTearLine, line, sheet->tearLines) {
        areFine &= line->factor >= 0.0;
    }
    return areFine;
}

static bool AreSettings(const kiriSettings* settings)
{
    enum { MOST_POINTS = 1 << 20 };
    return settings->snap >= 0.0 && settings->contactThickness > 0.0 && settings->frameLength >= 0.0 &&
           settings->material.detail >= 0 && settings->material.detail <= KIRI_MOST_DETAIL &&
           settings->collisionPoints >= 0.0 && settings->collisionPoints <= MOST_POINTS &&
           settings->integrationPoints >= 0.0 && settings->integrationPoints <= MOST_POINTS;
}

/* Returns true if pieces are sorted by their lowest frame, none is deferred, and at least one is not destroyed. */
static bool ArePieces(const kiriLayout* layout)
{
    bool areFine = true, isLeft = false;
    int32_t pieces = 0;
    KIRI_EACH_INDEX_WHILE(areFine, f, layout->framePiece) {
        int32_t piece = layout->framePiece.data[f];
        areFine = piece <= pieces && (piece < pieces || layout->pieces.data[piece].frame == f);
        pieces += piece == pieces;
    }
    KIRI_EACH(const kiriPiece, each, layout->pieces) {
        areFine = areFine && !each->rest.waits;
        isLeft = isLeft || !each->isGone;
    }
    return areFine && isLeft && pieces == layout->pieces.count;
}

/* Returns true if area elements are valid and the frames of each are in one piece. */
static bool AreAreaElements(const kiriLayout* layout)
{
    const kiriAreaElements* areas = &layout->areaElements;
    bool areFine = kiriAreaElements_AreSound(areas);
    KIRI_EACH_WHILE(areFine, const kiriAreaElement, element, areas->elements) {
        const kiriFrameShare* shares = &areas->shares.data[element->first];
        KIRI_FROM_TO_WHILE(areFine, n, 1, element->count) {
            areFine = shares[n - 1].frame < shares[n].frame &&
                      layout->framePiece.data[shares[n].frame] == layout->framePiece.data[shares[0].frame];
        }
    }
    return areFine;
}

static bool ArePins(const kiriSheetData* sheet)
{
    const kiriPinShares* shares = &sheet->layout.pinShares;
    bool areFine = true;
    KIRI_EACH_WHILE(areFine, const kiriPinData, pin, sheet->pins) {
        bool isPoint = pin->type == KIRI_PIN_POINT;
        areFine = IsOnLattice(pin->at) && IsOnLattice(pin->to) &&
                  isPoint == (pin->at.x == pin->to.x && pin->at.y == pin->to.y) && isPoint == (pin->stiffness > 0.0);
    }
    KIRI_TIMES_WHILE(areFine, k, shares->count) {
        const kiriPinShare* share = &shares->data[k];
        areFine = sheet->pins.data[share->pin].type != KIRI_PIN_POINT &&
                  (k == 0 || shares->data[k - 1].pin <= share->pin) && share->share.length > 0.0 &&
                  share->share.load > 0.0;
    }
    return areFine;
}

static bool AreFramesAndPoints(const kiriSheetData* sheet)
{
    bool areFine = sheet->regions.dirty.count == sheet->frames.count;
    KIRI_EACH_WHILE(areFine, const kiriFrameData, frame, sheet->frames) {
        areFine = kiriFrame_IsSound(frame, &sheet->mesh);
    }
    KIRI_EACH_WHILE(areFine, const kiriSample, point, sheet->points) {
        kiriLatticePoint at = point->at;
        int32_t square =
            IsOnLattice(at) && at.x >= 0 && at.y >= 0 ? kiriSquares_At(&sheet->mesh.squares, at) : KIRI_NONE;
        areFine = square != KIRI_NONE && sheet->mesh.squares.head[square] != KIRI_NONE;
    }
    return areFine;
}

/* Returns true for a valid place: a collision point, or a blend of vertices, in which unused ones come last. */
static bool IsPlace(const kiriSheetData* sheet, int32_t point, const int32_t vertex[3])
{
    bool isFine = point >= KIRI_NONE && point < sheet->points.count && (point != KIRI_NONE || vertex[0] != KIRI_NONE);
    for (int k = 0; isFine && k < 3 && point == KIRI_NONE; ++k) {
        isFine = vertex[k] == KIRI_NONE ||
                 (vertex[k] >= 0 && vertex[k] < sheet->mesh.vertices.count && (k == 0 || vertex[k - 1] != KIRI_NONE));
    }
    return isFine;
}

static bool IsTouchMemory(const kiriSheetData* sheet, const kiriTouchMemory* memory)
{
    bool isFine = memory->given >= 0 && memory->given <= memory->touches.count;
    KIRI_EACH_WHILE(isFine, const kiriTouch, touch, memory->touches) {
        isFine = IsPlace(sheet, touch->point, touch->vertex);
    }
    return isFine;
}

static bool AreContacts(const kiriSheetData* sheet)
{
    const kiriTouches* touches = &sheet->touches;
    bool areFine = touches->nextTold.capacity >= sheet->contacts.count &&
                   touches->found.capacity >= sheet->contacts.count && IsTouchMemory(sheet, &touches->last) &&
                   IsTouchMemory(sheet, &touches->slept);
    KIRI_EACH_WHILE(areFine, const kiriGivenContact, given, sheet->contacts) {
        bool isPoint = given->contact.point != KIRI_NONE;
        areFine = IsPlace(sheet, given->contact.point, given->vertex) && (isPoint || given->vertex[2] != KIRI_NONE);
    }
    return areFine;
}

static bool AreFades(const kiriFades* fades, const kiriSettings* settings, int32_t samples)
{
    return fades->time == settings->fadeTime && fades->least == settings->leastFade &&
           kiriFades_AreSound(fades, samples);
}

/* Returns true if arrays with an item a link have that length, and rows of pins and clamps fit their capacity. */
static bool HaveArraysRoom(const kiriSheetData* sheet)
{
    int32_t links = sheet->links.links.count, offsets = sheet->strainOffsets.strainOffsets.count;
    int64_t shares = sheet->layout.pinShares.count, pins = sheet->pins.count + 2 * shares;
    bool isPlastic = sheet->plastics.isKept;
    bool isFine = ((offsets == 0 && !isPlastic) || (offsets == links && kiriSheet_KeepsStrains(sheet))) &&
                  (!kiriSettings_Yield(&sheet->settings) || isPlastic) &&
                  sheet->plastics.links.count == (isPlastic ? links : 0) &&
                  sheet->linkParts.count == (sheet->layout.severed.count > 0 ? links : 0) &&
                  sheet->pinRows.capacity >= pins && sheet->clampRows.capacity >= shares &&
                  sheet->drawnPins.capacity >= sheet->pins.count + shares;
    KIRI_EACH_WHILE(isFine, const kiriSeveredLink, link, sheet->layout.severed) {
        isFine = link->link < links;
    }
    return isFine;
}

/* Returns true if links join the sides of all creases to one piece. */
static bool AreCreasesJoined(const kiriSheetData* sheet)
{
    bool areJoined = true;
    KIRI_TIMES_WHILE(areJoined, h, 3 * sheet->mesh.triangles.count) {
        areJoined = !kiriMesh_IsCrease(&sheet->mesh, h) ||
                    kiriPiece_OfTriangle(sheet, h / 3) == kiriPiece_OfTriangle(sheet, kiriMesh_Twin(&sheet->mesh, h) / 3);
    }
    return areJoined;
}

/* ---- Derived data ------------------------------------------------------------------------------------------------ */

void kiriSheet_Derive(kiriSheetData* sheet, kiriArchive* archive)
{
    KIRI_ASSERT(kiriArchive_Reads(archive) && !archive->isWhole && sheet->mesh.memory == &sheet->own);
    kiriMesh_Derive(&sheet->mesh, archive);
    kiriArchive_Expect(archive, kiriArchive_HasFailed(archive) ||
                                    (AreSettings(&sheet->settings) &&
                                     sheet->seen.surface.detail.sweeps == kiriSettings_Detail(&sheet->settings) &&
                                     AreFramesAndPoints(sheet) && ArePieces(&sheet->layout) &&
                                     AreAreaElements(&sheet->layout) && ArePins(sheet) &&
                                     AreCuts(sheet) && AreContacts(sheet) &&
                                     AreFades(&sheet->seen.fades, &sheet->settings, sheet->mesh.vertices.count) &&
                                     AreFades(&sheet->seen.pointFades, &sheet->settings, sheet->points.count) &&
                                     sheet->watch.done >= 0.0 && sheet->watch.done < 1.0));
    if (kiriArchive_HasFailed(archive)) {
        return;
    }
    bool isBad = false, isMade = kiriRemake_Field(sheet, &isBad);
    kiriArchive_Expect(archive, !isBad && (!isMade || (HaveArraysRoom(sheet) && AreCreasesJoined(sheet))));
    archive->isShort |= !isMade && !archive->isBad;
    if (kiriArchive_HasFailed(archive)) {
        return;
    }
    KIRI_ASSERT(sheet->update->stage == KIRI_NONE && sheet->vertexSkin.spans.count == sheet->mesh.vertices.count);
    kiriSurface_Derive(&sheet->seen.surface, &sheet->mesh, 0, 0);
    kiriView_HideTriangles(sheet);
}

/* Copies the items of one array to another with the same count. */
static void TakeSpeeds(void* to, const void* from, size_t itemBytes)
{
    kiriArrayHeader old = kiriArray_GetHeader(from), fresh = kiriArray_GetHeader(to);
    if (old.count == fresh.count && old.count > 0) {
        memcpy(fresh.data, old.data, itemBytes * old.count);
    }
}

static bool RemakeProbes(kiriSheetData* sheet)
{
    kiriProbes read = sheet->probes;
    if (!read.isFresh) {
        return true;
    }
    KIRI_CLEAR(&sheet->probes);
    sheet->probes.block = read.block > 0 ? read.block : 1;
    sheet->probes.isFresh = true;
    sheet->probes.folds = read.folds;
    bool ok = kiriProbes_Remake(sheet);
    if (ok) {
        TakeSpeeds(&sheet->probes.velocities, &read.velocities, sizeof(kiriVec3));
        TakeSpeeds(&sheet->probes.speeds, &read.speeds, sizeof(double));
    }
    kiriArray_Release(sheet->memory, &read.velocities);
    kiriArray_Release(sheet->memory, &read.speeds);
    return ok;
}

/* Makes boxes, normals and probes again if they were there. */
bool kiriSheet_EndReading(kiriSheetData* sheet, bool isWhole)
{
    kiriSurface* surface = &sheet->seen.surface;
    bool hasNormals = surface->hasNormals, isKept = isWhole || !AreWeightsSeen(sheet),
         hasBounds = sheet->seen.bounds->levelCount > 0;
    if (!isKept) {
        kiriSurface_BlendRange(surface, &sheet->vertexSkin, 0, surface->vertexCount);
        kiriSurface_AddFades(surface, &sheet->seen.fades);
    }
    surface->hasNormals = false;
    kiriSurface_DrawRange(surface, 0, isWhole ? 0 : surface->vertexCount);
    kiriDetail_Measure(&surface->detail);
    if (!isWhole) {
        kiriSurface_WriteRange(surface, 0, surface->vertexCount);
    }
    if (hasNormals && !isKept) {
        kiriSurface_NeedNormals(surface);
    }
    surface->hasNormals = hasNormals;
    int32_t patience = sheet->seen.bounds->patience;
    sheet->seen.bounds->levelCount = 0;
    bool ok = !hasBounds || kiriBounds_Update(sheet->seen.bounds, sheet->memory, surface);
    sheet->seen.bounds->patience = patience;
    ok = ok && kiriStage_Solver(sheet, sheet->frames.count, &sheet->settings.material, false) &&
         kiriSolver_ReserveRows(sheet->solver, sheet->pins.count + 2 * (int64_t)sheet->layout.pinShares.count,
                                sheet->layout.pinShares.count, 0);
    kiriSolver_Commit(sheet->solver);
    return ok && RemakeProbes(sheet);
}
