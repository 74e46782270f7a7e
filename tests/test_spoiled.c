/* Saves whose sum is right, but which say what no world can be: kiriWorld_LoadUntrusted refuses them with one line, and
   changes nothing; or what is wrong follows from mesh and frames, and is not read. A world is made wrong in memory in
   one way at a time, and saved as it is. */
#include "host.h"

#include "field/kiri_grid_work.h"
#include "field/kiri_link_work.h"
#include "field/kiri_place_work.h"
#include "field/kiri_shape_work.h"
#include "sheet/kiri_piece.h"
#include "sheet/kiri_update.h"
#include "world/kiri_world.h"

typedef void SpoilFn(kiriSheetData* sheet);

typedef struct Spoiler {
    const char* name;
    SpoilFn* spoil;
} Spoiler;

/* ---- Saves ---- */

typedef struct SavedBytes {
    uint8_t* data;
    int64_t size;
} SavedBytes;

static SavedBytes Save(const Host* host)
{
    SavedBytes bytes = { NULL, 0 };
    OK(kiriWorld_Save(host->world, NULL, 0, &bytes.size));
    bytes.data = malloc((size_t)bytes.size);
    OK(kiriWorld_Save(host->world, bytes.data, bytes.size, &bytes.size));
    return bytes;
}

/* A sheet with a slit. */
static void StartCut(Host* host)
{
    const float slit[4] = { 0.1f, 0.3f, 0.8f, 0.36f };
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(host, sheet, slit, 2);
    OK(Host_Tick(host, 0.01f, 1));
}

/* And the work on another cut, which is at this stage and step of it. */
static void StartAtWork(Host* host, int32_t stage, int32_t step)
{
    const float around[12] = { 0.2f, 0.5f, 0.8f, 0.5f, 0.8f, 0.9f, 0.4f, 0.9f, 0.4f, 0.2f, 0.9f, 0.2f };
    const kiriBudget budget = { 64, 5, 3, 0 };
    StartCut(host);
    const kiriSheetData* sheet = host->world->sheets.data[0];
    Host_Cut(host, sheet->id, around, 6);
    OK(kiriWorld_SetBudget(host->world, &budget));
    for (int tick = 0; tick < 2000 && (sheet->update->stage != stage || sheet->update->step != step); ++tick) {
        assert_true(kiriWorld_Tick(host->world, 0.01f, 1) >= 0);
    }
    assert_int_equal(sheet->update->stage, stage);
    assert_int_equal(sheet->update->step, step);
}

/* The world of the host is spoiled, and then what it was again. */
static void CheckRefused(Host* host, const Spoiler* spoiler)
{
    Host other;
    Host_Start(&other);
    SavedBytes good = Save(host);
    spoiler->spoil(host->world->sheets.data[0]);
    SavedBytes bad = Save(host);
    uint64_t before = Host_Hash(&other);
    if (kiriWorld_LoadUntrusted(other.world, bad.data, bad.size) != KIRI_ERROR_DATA || Host_Hash(&other) != before) {
        fail_msg("%s: the save is not refused", spoiler->name);
    }
    assert_non_null(strstr(kiriWorld_GetLastError(other.world), "a right sum"));
    OK(kiriWorld_Load(host->world, good.data, good.size));
    OK(kiriWorld_LoadUntrusted(other.world, good.data, good.size));
    free(bad.data);
    free(good.data);
    Host_Stop(&other);
}

/* The load makes what it makes of the good save. */
static void CheckNotRead(Host* host, const Spoiler* spoiler)
{
    Host other;
    Host_Start(&other);
    SavedBytes good = Save(host);
    OK(kiriWorld_LoadUntrusted(other.world, good.data, good.size));
    uint64_t hash = Host_Hash(&other);
    spoiler->spoil(host->world->sheets.data[0]);
    SavedBytes bad = Save(host);
    if (kiriWorld_LoadUntrusted(other.world, bad.data, bad.size) != KIRI_OK || Host_Hash(&other) != hash) {
        fail_msg("%s: is read", spoiler->name);
    }
    Host_Validate(&other);
    OK(kiriWorld_Load(host->world, good.data, good.size));
    free(bad.data);
    free(good.data);
    Host_Stop(&other);
}

typedef void CheckFn(Host* host, const Spoiler* spoiler);

static void CheckAll(Host* host, CheckFn* check, const Spoiler* spoilers, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        check(host, &spoilers[k]);
    }
    Host_Stop(host);
}

#define CHECK_ALL(check, host, spoilers) CheckAll(host, check, spoilers, sizeof(spoilers) / sizeof((spoilers)[0]))
#define CHECK_ALL_REFUSED(host, spoilers) CHECK_ALL(CheckRefused, host, spoilers)
#define CHECK_NONE_READ(host, spoilers) CHECK_ALL(CheckNotRead, host, spoilers)

/* ---- The mesh ---- */

static void HeadIsNoVertex(kiriSheetData* sheet)
{
    sheet->mesh.squares.vertexHead[0] = 1 << 28;
}

static void VertexFollowsItself(kiriSheetData* sheet)
{
    int32_t head = sheet->mesh.squares.vertexHead[0];
    sheet->mesh.vertices.data[head].next = head;
}

static void TwinIsAnother(kiriSheetData* sheet)
{
    sheet->mesh.triangles.data[0].twin[1] = 3 * sheet->mesh.triangles.count - 1;
}

static void SourceIsFar(kiriSheetData* sheet)
{
    sheet->mesh.triangles.data[0].source = 1 << 28;
}

static void SourceIsBelow(kiriSheetData* sheet)
{
    sheet->mesh.triangles.data[0].source = -80;
}

static void SourcesAreTheSame(kiriSheetData* sheet)
{
    sheet->mesh.triangles.data[1].source = sheet->mesh.triangles.data[0].source;
}

static void OriginalsAreMore(kiriSheetData* sheet)
{
    sheet->mesh.originals = sheet->mesh.triangles.count + 1;
}

static void BlockIsFar(kiriSheetData* sheet)
{
    sheet->mesh.sourceBlocks.data[0] = sheet->mesh.sourceCorners.count / (3 * KIRI_SOURCES_A_BLOCK);
}

static void BlockHasNoCorners(kiriSheetData* sheet)
{
    memset(sheet->mesh.sourceCorners.data, 0, sizeof(kiriLatticePoint) * (size_t)sheet->mesh.sourceCorners.count);
}

static void TestMesh(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "HeadIsNoVertex", HeadIsNoVertex },       { "VertexFollowsItself", VertexFollowsItself },
        { "TwinIsAnother", TwinIsAnother },         { "SourceIsFar", SourceIsFar },
        { "SourceIsBelow", SourceIsBelow },         { "SourcesAreTheSame", SourcesAreTheSame },
        { "OriginalsAreMore", OriginalsAreMore },   { "BlockIsFar", BlockIsFar },
        { "BlockHasNoCorners", BlockHasNoCorners },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

static void TriangleIsListedTwice(kiriSheetData* sheet)
{
    kiriSquares* squares = &sheet->mesh.squares;
    int32_t square = 0;
    while (squares->nodes.data[squares->head[square]].next == KIRI_NONE) {
        ++square;
    }
    kiriSquareNode* node = &squares->nodes.data[squares->head[square]];
    node->triangle = squares->nodes.data[node->next].triangle;
}

static void TriangleIsElsewhere(kiriSheetData* sheet)
{
    kiriSquares* squares = &sheet->mesh.squares;
    int32_t last = squares->columns * squares->rows - 1;
    squares->nodes.data[squares->head[last]].triangle = squares->nodes.data[squares->head[0]].triangle;
}

static void CornerIsNone(kiriSheetData* sheet)
{
    sheet->mesh.triangles.data[0].vertex[1] = KIRI_NONE;
}

/* Triangles whose boxes have few squares are looked at in another way than large ones. */
static void TestLists(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "TriangleIsListedTwice", TriangleIsListedTwice },
        { "TriangleIsElsewhere", TriangleIsElsewhere },
        { "CornerIsNone", CornerIsNone },
    };
    for (int32_t grid = 8; grid <= 40; grid += 32) {
        Host host;
        Host_Start(&host);
        kiriSheetDef def = Host_SmallDef();
        def.gridResolution = grid;
        Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        CHECK_ALL_REFUSED(&host, spoilers);
    }
}

/* ---- The layout ---- */

static void FrameIsOfNoPiece(kiriSheetData* sheet)
{
    sheet->layout.framePiece.data[0] = 1 << 28;
}

static void FrameHasNoPiece(kiriSheetData* sheet)
{
    sheet->layout.framePiece.count -= 1;
}

static void TestLayout(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "FrameIsOfNoPiece", FrameIsOfNoPiece },
        { "FrameHasNoPiece", FrameHasNoPiece },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- The grid ---- */

static void CellIsOfAnotherSquare(kiriSheetData* sheet)
{
    sheet->grid.cells.data[sheet->grid.squareCell.data[0]].square = 1;
}

static void CellFollowsItself(kiriSheetData* sheet)
{
    int32_t cell = sheet->grid.squareCell.data[0];
    sheet->grid.cells.data[cell].next = cell;
}

static void FreeCellIsFar(kiriSheetData* sheet)
{
    sheet->grid.freeCell = 1 << 30;
}

/* Of a cell at the outline. */
static int32_t* OwnMaterial(kiriSheetData* sheet)
{
    kiriCell* cell = sheet->grid.cells.data;
    while (cell->material == KIRI_NONE) {
        ++cell;
    }
    return &cell->material;
}

static void FaceHasNoWidth(kiriSheetData* sheet)
{
    const kiriFace* face = sheet->grid.faces.data;
    while (!kiriFace_HasOwnStretch(face)) {
        ++face;
    }
    sheet->grid.stretches.data[face->kind / 2 - 1].width = 0.0;
}

static void MaterialIsFar(kiriSheetData* sheet)
{
    *OwnMaterial(sheet) = 1 << 30;
}

static void MaterialIsShared(kiriSheetData* sheet)
{
    int32_t* own = OwnMaterial(sheet);
    *own = *own == 0 ? 1 : 0;
}

static void UnusedHasNoRoom(kiriSheetData* sheet)
{
    kiriArray_Release(sheet->memory, &sheet->grid.unusedStretches);
}

static void FaceFollowsItself(kiriSheetData* sheet)
{
    sheet->grid.faces.data[0].next[0] = 0;
}

/* A run that is stored, and has steps. */
static kiriStepRun* StoredRun(kiriSheetData* sheet)
{
    kiriStepRun* run = sheet->grid.runs.data;
    while (kiriStepRun_IsOpen(run) || run->end[0] == run->first) {
        ++run;
    }
    return run;
}

static void StepLeadsFar(kiriSheetData* sheet)
{
    sheet->grid.steps.data[StoredRun(sheet)->first].cell = sheet->grid.squareCell.data[60];
}

static void StepsEndBeyond(kiriSheetData* sheet)
{
    StoredRun(sheet)->end[2] = sheet->grid.steps.count + 1;
}

static void BorderIsOpen(kiriSheetData* sheet)
{
    sheet->grid.runs.data[sheet->grid.squareCell.data[0]].first = ~0;
}

static void TriangleIsInNoCell(kiriSheetData* sheet)
{
    sheet->grid.nodeCell.data[sheet->mesh.squares.head[0]] = KIRI_NONE;
}

static void MaterialIsNegative(kiriSheetData* sheet)
{
    sheet->grid.materials.data[*OwnMaterial(sheet)].area = -1.0;
}

static void PointIsOfNoCell(kiriSheetData* sheet)
{
    sheet->points.data[0].cell = 1 << 28;
}

static void TestGrid(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "CellIsOfAnotherSquare", CellIsOfAnotherSquare },
        { "CellFollowsItself", CellFollowsItself },
        { "FreeCellIsFar", FreeCellIsFar },
        { "FaceHasNoWidth", FaceHasNoWidth },
        { "MaterialIsFar", MaterialIsFar },
        { "MaterialIsShared", MaterialIsShared },
        { "UnusedHasNoRoom", UnusedHasNoRoom },
        { "FaceFollowsItself", FaceFollowsItself },
        { "StepLeadsFar", StepLeadsFar },
        { "StepsEndBeyond", StepsEndBeyond },
        { "BorderIsOpen", BorderIsOpen },
        { "TriangleIsInNoCell", TriangleIsInNoCell },
        { "MaterialIsNegative", MaterialIsNegative },
        { "PointIsOfNoCell", PointIsOfNoCell },
    };
    Host host;
    StartCut(&host);
    CHECK_NONE_READ(&host, spoilers);
}

static void ItemIsBeyond(kiriSheetData* sheet)
{
    sheet->grid.work->item = 1 << 24;
}

static void RangeIsBeyond(kiriSheetData* sheet)
{
    kiriGridWork* work = sheet->grid.work;
    int32_t square = work->flagged.data[0];
    work->squareFlags.data[square] |= KIRI_SQUARE_COLLECTED;
    work->ranges.data[square].first = 0;
    work->ranges.data[square].end = 1 << 24;
}

static void StageIsNone(kiriSheetData* sheet)
{
    sheet->grid.work->stage = 99;
}

static void LivingCellIsGone(kiriSheetData* sheet)
{
    assert_true(kiriArray_Push(sheet->memory, &sheet->grid.changes.gone, sheet->grid.squareCell.data[0]));
}

/* Of a square that the slit parts: it is in no list of cells any more, but faces lead to it. */
static void CellWithFacesIsGone(kiriSheetData* sheet)
{
    kiriGrid* grid = &sheet->grid;
    kiriCell* first = grid->cells.data;
    while (first->next == KIRI_NONE) {
        ++first;
    }
    int32_t gone = first->next;
    first->next = grid->cells.data[gone].next;
    grid->cells.data[gone].square = grid->cells.data[gone].next = KIRI_NONE;
    grid->cellCount -= 1;
    assert_true(kiriArray_Push(sheet->memory, &grid->changes.made, gone));
}

static void TestGridAtWork(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "ItemIsBeyond", ItemIsBeyond },
        { "RangeIsBeyond", RangeIsBeyond },
        { "StageIsNone", StageIsNone },
    };
    Host host;
    StartAtWork(&host, KIRI_STAGE_GRID, 0);
    const kiriGridWork* work = host.world->sheets.data[0]->grid.work;
    for (int tick = 0; tick < 100 && work->flagged.count == 0; ++tick) {
        assert_true(kiriWorld_Tick(host.world, 0.01f, 1) >= 0);
    }
    assert_true(work->running && work->flagged.count > 0);
    CHECK_NONE_READ(&host, spoilers);
    static const Spoiler done[] = {
        { "LivingCellIsGone", LivingCellIsGone },
        { "CellWithFacesIsGone", CellWithFacesIsGone },
    };
    StartAtWork(&host, KIRI_STAGE_SHAPE, 0);
    CHECK_NONE_READ(&host, done);
}

/* ---- Regions and shape functions ---- */

static void OwnerIsNoRegion(kiriSheetData* sheet)
{
    sheet->regions.field.owner.data[sheet->grid.squareCell.data[0]] = sheet->frames.count;
}

static void CellIsNobodys(kiriSheetData* sheet)
{
    sheet->regions.field.owner.data[sheet->grid.squareCell.data[0]] = KIRI_NONE;
    sheet->regions.field.distance.data[sheet->grid.squareCell.data[0]] = KIRI_FAR;
}

static void BorderCellFollowsItself(kiriSheetData* sheet)
{
    int32_t cell = sheet->regions.border.first.data[0];
    sheet->regions.border.cells.data[cell].next = cell;
}

static void SiteIsInTwoCells(kiriSheetData* sheet)
{
    int32_t cell = sheet->update->placing.sites.data[0].cell;
    sheet->regions.siteAt.data[cell == 0 ? 1 : 0] = sheet->regions.siteAt.data[cell];
}

static void SiteIsOfNoRegion(kiriSheetData* sheet)
{
    sheet->regions.siteAt.data[0] = sheet->regions.material.count;
}

static void FlagIsUp(kiriSheetData* sheet)
{
    sheet->update->placing.flags.data[0] = 1;
}

/* What goes on from tick to tick, where nothing is at hand. */
static void RegionsAreAtWork(kiriSheetData* sheet)
{
    sheet->regions.running = true;
}

static void LinksAreAtWork(kiriSheetData* sheet)
{
    sheet->links.work->running = true;
}

static void PlacerLeavesAMark(kiriSheetData* sheet)
{
    sheet->update->placing.placer.work->marks.data[0] = 1;
}

static void PlacerIsLeftAmidWork(kiriSheetData* sheet)
{
    sheet->update->placing.isPlacing = true;
}

static void SumOverflows(kiriSheetData* sheet)
{
    sheet->regions.material.data[0].area.low = INT64_MIN;
}

static void TestRegions(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "OwnerIsNoRegion", OwnerIsNoRegion },
        { "CellIsNobodys", CellIsNobodys },
        { "BorderCellFollowsItself", BorderCellFollowsItself },
        { "SiteIsInTwoCells", SiteIsInTwoCells },
        { "SiteIsOfNoRegion", SiteIsOfNoRegion },
        { "FlagIsUp", FlagIsUp },
        { "RegionsAreAtWork", RegionsAreAtWork },
        { "LinksAreAtWork", LinksAreAtWork },
        { "PlacerLeavesAMark", PlacerLeavesAMark },
        { "PlacerIsLeftAmidWork", PlacerIsLeftAmidWork },
        { "SumOverflows", SumOverflows },
    };
    Host host;
    StartCut(&host);
    CHECK_NONE_READ(&host, spoilers);
}

static void WeightIsOfNoFrame(kiriSheetData* sheet)
{
    sheet->shape.weights.data[sheet->shape.spans.data[0].first].label = 1 << 20;
}

static void LabelIsOfAnotherFrame(kiriSheetData* sheet)
{
    kiriLabels* labels = &sheet->shape.labels;
    assert_true(kiriArray_Push(sheet->memory, &labels->itemOf, 1) &&
                kiriArray_Push(sheet->memory, &labels->labelOf, 0));
}

/* Labels are sound, but one that weights have is said to be no longer used. */
static void LabelIsOfNoFrame(kiriSheetData* sheet)
{
    kiriLabels* labels = &sheet->shape.labels;
    assert_true(kiriArray_Push(sheet->memory, &labels->itemOf, KIRI_NONE));
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        assert_true(kiriArray_Push(sheet->memory, &labels->itemOf, f) &&
                    kiriArray_Push(sheet->memory, &labels->labelOf, f + 1));
    }
    assert_true(kiriLabels_AreSound(labels, sheet->frames.count));
    assert_true(kiriReaches_Resize(&sheet->shape.reaches, sheet->memory, 0, sheet->frames.count + 1));
}

static void WeightIsNotFinite(kiriSheetData* sheet)
{
    sheet->shape.rigidWeight = HUGE_VAL;
}

static void WeightIsZero(kiriSheetData* sheet)
{
    kiriCellWeight* weight = &sheet->shape.weights.data[sheet->shape.spans.data[0].first];
    *weight = kiriCellWeight_Make(weight->label, 0.0);
}

static void SpansOverlap(kiriSheetData* sheet)
{
    sheet->shape.spans.data[0] = sheet->shape.spans.data[1];
}

static void DistanceIsNegative(kiriSheetData* sheet)
{
    sheet->shape.reaches.blocks.data[sheet->shape.reaches.ofCells.data[0]].fromSite[0] = INT32_MIN;
}

static void CellBeyondTheGridIsNear(kiriSheetData* sheet)
{
    int32_t last = sheet->shape.reaches.ofCells.count - 1, block = sheet->shape.reaches.ofCells.data[last];
    assert_true(sheet->grid.cells.count % KIRI_BLOCK_CELLS > 0);
    sheet->shape.reaches.blocks.data[block].fromSite[KIRI_BLOCK_CELLS - 1] = 0;
}

static void BlockFollowsItself(kiriSheetData* sheet)
{
    int32_t block = sheet->shape.reaches.ofLabel.data[0];
    sheet->shape.reaches.blocks.data[block].nextOfFrame = block;
}

static void FrameIsTouchedAtRest(kiriSheetData* sheet)
{
    sheet->shape.work->frames.data[0].firstTouch = 0;
}

static void TestShape(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "WeightIsOfNoFrame", WeightIsOfNoFrame },
        { "WeightIsZero", WeightIsZero },
        { "SpansOverlap", SpansOverlap },
        { "DistanceIsNegative", DistanceIsNegative },
        { "CellBeyondTheGridIsNear", CellBeyondTheGridIsNear },
        { "BlockFollowsItself", BlockFollowsItself },
        { "FrameIsTouchedAtRest", FrameIsTouchedAtRest },
    };
    Host host;
    StartCut(&host);
    CHECK_NONE_READ(&host, spoilers);
}

static void DirtyFrameIsNone(kiriSheetData* sheet)
{
    sheet->shape.work->dirtyFrames.data[0] = 1 << 20;
}

static void CellIsDirtyTwice(kiriSheetData* sheet)
{
    kiriField* field = &sheet->regions.field;
    field->settled.data[0] = field->settled.data[1] = 0;
    field->settled.count = 2;
}

static void TestShapeAtWork(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "DirtyFrameIsNone", DirtyFrameIsNone },
        { "CellIsDirtyTwice", CellIsDirtyTwice },
    };
    Host host;
    StartAtWork(&host, KIRI_STAGE_SHAPE, 0);
    CHECK_NONE_READ(&host, spoilers);
}

/* ---- What is seen ---- */

static void VertexHasNoWeight(kiriSheetData* sheet)
{
    sheet->vertexSkin.weights.data[sheet->vertexSkin.spans.data[0].first].value = 0.0f;
}

static void RestPlaceIsFar(kiriSheetData* sheet)
{
    sheet->seen.surface.rest.data[0].x = 1e300;
}

static void ChangeIsBeyond(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    assert_true(surface->changeCount > 0);
    surface->changes[surface->lastChange].vertices = (kiriRange){ 0, 1 << 20 };
}

static void PatienceIsNegative(kiriSheetData* sheet)
{
    sheet->seen.bounds->patience = -1;
}

static void TestSeen(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "VertexHasNoWeight", VertexHasNoWeight },
        { "RestPlaceIsFar", RestPlaceIsFar },
        { "ChangeIsBeyond", ChangeIsBeyond },
        { "PatienceIsNegative", PatienceIsNegative },
    };
    Host host;
    StartCut(&host);
    host.world->sheets.data[0]->seen.bounds->patience = 1; /* somebody has asked */
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- Links at work, and what is placed ---- */

static void FaceIsNoBorder(kiriSheetData* sheet)
{
    const int32_t* owner = sheet->regions.field.owner.data;
    const kiriFace* face = sheet->grid.faces.data;
    while (face->cell[0] == KIRI_NONE || owner[face->cell[0]] != owner[face->cell[1]]) {
        ++face;
    }
    sheet->links.work->faces.data[0] = (int32_t)(face - sheet->grid.faces.data);
}

static void SearchBeginsEarly(kiriSheetData* sheet)
{
    sheet->links.work->at = -2 * sheet->links.work->stale.count - 2;
}

static void SightIsUnlisted(kiriSheetData* sheet)
{
    sheet->links.work->edges.squares.count = sheet->links.work->edges.spans.count = 0;
    sheet->links.work->edges.listed.data[0] = 0;
}

/* A square that nobody has looked at. */
static void SightIsFar(kiriSheetData* sheet)
{
    kiriSightEdges* edges = &sheet->links.work->edges;
    int32_t square = 0;
    while (edges->listed.data[square] != KIRI_NONE) {
        ++square;
    }
    edges->listed.data[square] = edges->spans.count;
}

static void TestLinksAtWork(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "FaceIsNoBorder", FaceIsNoBorder },
        { "SearchBeginsEarly", SearchBeginsEarly },
        { "SightIsUnlisted", SightIsUnlisted },
        { "SightIsFar", SightIsFar },
    };
    Host host;
    StartAtWork(&host, KIRI_STAGE_SHAPE, 3);
    const kiriLinkWork* work = host.world->sheets.data[0]->links.work;
    int32_t before = 0;
    for (int tick = 0; tick < 100 && (work->at < 0 || work->faces.count == 0); ++tick) {
        before += work->at < 0;
        assert_true(kiriWorld_Tick(host.world, 0.01f, 1) >= 0);
    }
    assert_true(before > 2); /* faces are found in several ticks */
    assert_true(work->running && work->faces.count > 0);
    CHECK_NONE_READ(&host, spoilers);
}

/* Three links of four still ascend, but they are no ring of three frames. */
static void CornerIsNoRing(kiriSheetData* sheet)
{
    kiriCorner* corner = sheet->links.corners.data;
    assert_true(sheet->links.corners.count > 0);
    corner->count = 7 - corner->count;
    corner->link[3] = sheet->links.links.count - 1;
}

static void SiteIsFarFromItsAnchor(kiriSheetData* sheet)
{
    sheet->frames.data[0].site.at.x += 0.5;
}

/* The second point is put where the first one is, but behind it: later ones come first. */
static void PointsAreTurned(kiriSheetData* sheet)
{
    kiriPlaces* places = &sheet->pointPlaces;
    int32_t* link = &places->head.data[kiriSquares_At(&sheet->mesh.squares, sheet->points.data[1].at)];
    while (*link != 1) {
        link = &places->next.data[*link];
    }
    *link = places->next.data[1];
    sheet->points.data[1].at = sheet->points.data[0].at;
    places->next.data[1] = places->next.data[0];
    places->next.data[0] = 1;
}

static void TestPoints(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "PointsAreTurned", PointsAreTurned },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

static void TestCorners(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "CornerIsNoRing", CornerIsNoRing },
        { "SiteIsFarFromItsAnchor", SiteIsFarFromItsAnchor },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- The work as a whole ---- */

static void StageIsTooHigh(kiriSheetData* sheet)
{
    sheet->update->stage = KIRI_READY + 1;
}

static void StepIsTooHigh(kiriSheetData* sheet)
{
    sheet->update->step = 7;
}

static void SiteIsInNoCell(kiriSheetData* sheet)
{
    sheet->update->placing.sites.data[0].cell = 1 << 24;
}

static void SitesShareACell(kiriSheetData* sheet)
{
    kiriSite* sites = sheet->update->placing.sites.data;
    sites[0].cell = sites[1].cell;
}

static void MoreIsTakenThanWaits(kiriSheetData* sheet)
{
    sheet->update->cut.taken = sheet->update->cut.count + 1;
}

static void PointEndsACutThatGoesOn(kiriSheetData* sheet)
{
    sheet->queue.data[0].ends = true;
    sheet->queue.data[0].cut->ended = false;
}

static void OwnerOfMaterialIsNone(kiriSheetData* sheet)
{
    sheet->update->refit.ownership.squares.data[0].owner = 1 << 20;
}

static void SampleIsNone(kiriSheetData* sheet)
{
    sheet->update->samples.refresh.sample = 1 << 20;
}

static void SampleIsInAnotherSquare(kiriSheetData* sheet)
{
    kiriRefresh* refresh = &sheet->update->samples.refresh;
    refresh->square = 0;
    refresh->sample = sheet->mesh.squares.vertexHead[0];
    refresh->squares.data[0] = sheet->mesh.squares.columns * sheet->mesh.squares.rows - 1;
}

static void PieceIsNone(kiriSheetData* sheet)
{
    sheet->update->next.framePiece.data[0] = 1 << 20;
}

static void TestWork(void** state)
{
    (void)state;
    static const Spoiler notRead[] = {
        { "StageIsTooHigh", StageIsTooHigh }, { "StepIsTooHigh", StepIsTooHigh },
        { "SiteIsInNoCell", SiteIsInNoCell }, { "SitesShareACell", SitesShareACell },
        { "SampleIsNone", SampleIsNone },     { "SampleIsInAnotherSquare", SampleIsInAnotherSquare },
        { "PieceIsNone", PieceIsNone },
    };
    static const Spoiler refused[] = {
        { "MoreIsTakenThanWaits", MoreIsTakenThanWaits },
        { "PointEndsACutThatGoesOn", PointEndsACutThatGoesOn },
        { "OwnerOfMaterialIsNone", OwnerOfMaterialIsNone },
    };
    Host host;
    StartAtWork(&host, KIRI_STAGE_SAMPLES, 4);
    CHECK_NONE_READ(&host, notRead);
    StartAtWork(&host, KIRI_STAGE_SAMPLES, 4);
    CHECK_ALL_REFUSED(&host, refused);
}

static void PointsAreLeft(kiriSheetData* sheet)
{
    sheet->update->cut.taken -= 1;
}

/* Weights of vertices name frames by labels, which are read. */
static void TestLabels(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "LabelIsOfAnotherFrame", LabelIsOfAnotherFrame },
        { "LabelIsOfNoFrame", LabelIsOfNoFrame },
        { "WeightIsNotFinite", WeightIsNotFinite },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

static void TestCut(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "PointsAreLeft", PointsAreLeft },
    };
    Host host;
    StartAtWork(&host, KIRI_STAGE_GRID, 0);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- Pieces ---- */

/* Sheet with two pieces that hang together with nothing. */
static void StartPieces(Host* host)
{
    const float through[4] = { -0.2f, 0.45f, 1.2f, 0.55f };
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(host, sheet, through, 2);
    OK(Host_Tick(host, 0.01f, 1));
    assert_int_equal(host->world->sheets.data[0]->layout.pieces.count, 2);
}

static int32_t FrameOfPiece(const kiriSheetData* sheet, int32_t piece)
{
    int32_t frame = sheet->frames.count - 1;
    while (sheet->layout.framePiece.data[frame] != piece) {
        --frame;
    }
    return frame;
}

/* Nobody follows the links of holes, but they are made anew with all others. */
static void HoleIsBeforeALaterVertex(kiriSheetData* sheet)
{
    int32_t hole = 0;
    while (kiriMesh_IsVertex(&sheet->mesh, hole)) {
        ++hole;
    }
    sheet->mesh.vertices.data[hole].next = sheet->mesh.vertices.count - 1;
}

static void TestHoles(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "HoleIsBeforeALaterVertex", HoleIsBeforeALaterVertex },
    };
    const float way[4] = { -0.1f, 0.1f, 1.1f, 0.13f };
    Host host;
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 66, 66);
    Host_Cut(&host, sheet, way, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    const kiriSheetData* data = host.world->sheets.data[0];
    int32_t strip = data->layout.pieces.data[0].area < data->layout.pieces.data[1].area ? 0 : 1;
    OK(kiriFrame_DestroyPiece(host.world, Host_FrameOf(&host, sheet, strip)));
    assert_true(data->mesh.vertexHoles > 0);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* Each is right where it is, but in the midst of the other piece. */
static void FramesChangePlaces(kiriSheetData* sheet)
{
    kiriFrameData *a = &sheet->frames.data[FrameOfPiece(sheet, 0)], *b = &sheet->frames.data[FrameOfPiece(sheet, 1)];
    kiriLatticePoint anchor = a->anchor;
    kiriSite site = a->site;
    a->anchor = b->anchor;
    a->site = b->site;
    b->anchor = anchor;
    b->site = site;
}

/* No grid is fine enough to tell them apart. */
static void FramesShareASite(kiriSheetData* sheet)
{
    kiriFrameData* frames = sheet->frames.data;
    assert_int_equal(sheet->layout.framePiece.data[0], sheet->layout.framePiece.data[1]);
    frames[1].anchor = frames[0].anchor;
    frames[1].site = frames[0].site;
}

/* All vertices of one piece follow a frame of the other, and the other way round. */
static void VerticesFollowTheOtherPiece(kiriSheetData* sheet)
{
    int32_t other[2] = { FrameOfPiece(sheet, 1), FrameOfPiece(sheet, 0) };
    for (int32_t v = 0; v < sheet->mesh.vertices.count; ++v) {
        kiriSpan* span = &sheet->vertexSkin.spans.data[v];
        kiriSampleWeight weight = { other[kiriPiece_OfVertex(sheet, v)], 1.0f };
        sheet->vertexSkin.weights.data[span->first] = weight;
        span->count = 1;
    }
}

/* What is made anew shows that what is not was made up: that is no lack of memory. */
static void TestPiecesElsewhere(void** state)
{
    (void)state;
    SpoilFn* spoil[] = { VerticesFollowTheOtherPiece, FramesChangePlaces, FramesShareASite };
    for (size_t k = 0; k < sizeof(spoil) / sizeof(spoil[0]); ++k) {
        Host host, other;
        StartPieces(&host);
        Host_Start(&other);
        SavedBytes good = Save(&host);
        uint64_t before = Host_Hash(&other);
        spoil[k](host.world->sheets.data[0]);
        SavedBytes bad = Save(&host);
        assert_int_equal(kiriWorld_LoadUntrusted(other.world, bad.data, bad.size), KIRI_ERROR_DATA);
        assert_non_null(strstr(kiriWorld_GetLastError(other.world), "a right sum"));
        assert_true(Host_Hash(&other) == before);
        OK(kiriWorld_LoadUntrusted(other.world, good.data, good.size));
        Host_Validate(&other);
        OK(kiriWorld_Load(host.world, good.data, good.size));
        free(bad.data);
        free(good.data);
        Host_Stop(&host);
        Host_Stop(&other);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestMesh),        cmocka_unit_test(TestLayout),          cmocka_unit_test(TestGrid),
        cmocka_unit_test(TestGridAtWork),  cmocka_unit_test(TestRegions),         cmocka_unit_test(TestShape),
        cmocka_unit_test(TestShapeAtWork), cmocka_unit_test(TestLinksAtWork),     cmocka_unit_test(TestWork),
        cmocka_unit_test(TestCorners),     cmocka_unit_test(TestLabels),          cmocka_unit_test(TestCut),
        cmocka_unit_test(TestSeen),        cmocka_unit_test(TestPiecesElsewhere), cmocka_unit_test(TestLists),
        cmocka_unit_test(TestPoints),      cmocka_unit_test(TestHoles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
