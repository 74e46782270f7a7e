#include "kiri_call.h"
#include "../sheet/kiri_sheet.h"
#include "../view/kiri_section.h"
#include "kiri_part.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "kiri_blade.h"
#include "kiri_move.h"

#include <string.h>

void kiriDefaultSheetDef(kiriSheetDef* def)
{
    if (def == NULL) {
        return;
    }
    memset(def, 0, sizeof(*def));
    def->cookie = KIRI_COOKIE(kiriSheetDef);
    def->axisU[0] = 1.0f;
    def->axisV[1] = 1.0f;
    kiriGetMaterial(KIRI_MATERIAL_COTTON, &def->material);
    def->gridResolution = 32;
    def->frameCount = 5;
    def->accuracy = 0.02f;
    def->maxFrames = 256;
    def->rigidWeight = 0.95f;
    def->friction = 0.5f;
    def->groups = UINT32_MAX;
    def->iterations = 2;
    def->sleepSpeed = 0.001f;
    def->timeStepping = KIRI_TIME_STEPPING_SECOND_ORDER;
    def->fadeTime = 0.2f;
    def->normals = 1;
    def->paper.integrationOrder = 1;
}

static const char* FaultOfPlacement(const kiriSheetDef* def)
{
    if (!kiriCall_AreFinite(def->position, 3) || !kiriCall_AreFinite(def->velocity, 3)) {
        return "position or velocity is not finite";
    }
    return kiriCall_AreOrthonormal(def->axisU, def->axisV) ? NULL : "axisU and axisV are not orthonormal";
}

static const char* FaultOfFrames(const kiriSheetDef* def)
{
    if (!kiriCall_IsWithin(def->frameCount, 0, 65536)) {
        return "frameCount is not within 0 and 65536";
    }
    if (!kiriCall_IsAtLeast(def->frameLength, 0.0f) || (def->frameCount == 0 && def->framePoints != NULL)) {
        return "frameLength is below 0, or there are framePoints and no frameCount";
    }
    if (!kiriCall_IsAtLeast(def->accuracy, 1e-4f) || def->accuracy > 1.0f) {
        return "accuracy is not within 1e-4 and 1";
    }
    if (def->framePoints != NULL && !kiriCall_AreFinite(def->framePoints, 2 * def->frameCount)) {
        return "a frame point is not finite";
    }
    return kiriCall_IsAbove(def->rigidWeight, 0.0f) && kiriCall_IsAtLeast(def->rigidArea, 0.0f)
               ? NULL
               : "rigidWeight is not above 0, or rigidArea below 0";
}

static const char* FaultOfModel(const kiriSheetDef* def)
{
    if (!kiriCall_IsWithin(def->model, KIRI_MODEL_LINKS, KIRI_MODEL_POINTS)) {
        return "model is not one of KIRI_MODEL";
    }
    return kiriCall_IsWithin(def->planar, 0, 1) ? NULL : "planar is not 0 or 1";
}

static const char* FaultOfPaper(const kiriPaperOptions* paper)
{
    if (!kiriCall_IsWithin(paper->fromScratch, 0, 1) || !kiriCall_IsWithin(paper->popping, 0, 1) ||
        !kiriCall_IsWithin(paper->linearWeights, 0, 1)) {
        return "fromScratch, popping or linearWeights is not 0 or 1";
    }
    return kiriCall_IsWithin(paper->integrationPoints, 0, 1 << 20) && kiriCall_IsWithin(paper->integrationOrder, 1, 2)
               ? NULL
               : "integrationPoints is not within 0 and 1048576, or integrationOrder not 1 or 2";
}

static const char* FaultOfSheetValues(const kiriSheetDef* def)
{
    const kiriSheetSettings settings = kiriSettings_Of(def);
    const char* faults[] = { kiriCall_FaultOfSettings(&settings), FaultOfPlacement(def), FaultOfFrames(def),
                             FaultOfModel(def), FaultOfPaper(&def->paper) };
    for (int i = 0; i < 5; ++i) {
        if (faults[i] != NULL) {
            return faults[i];
        }
    }
    if (!kiriCall_IsWithin(def->gridResolution, 1, 4096)) {
        return "gridResolution is not within 1 and 4096";
    }
    if (!kiriCall_IsAtLeast(def->snapDistance, 0.0f) || !kiriCall_IsAtLeast(def->weldDistance, 0.0f)) {
        return "snapDistance or weldDistance is below 0";
    }
    return kiriCall_IsWithin(def->collisionPoints, 0, 1 << 20) ? NULL : "collisionPoints is not within 0 and 1048576";
}

static kiriResult CheckSheetDef(const kiriSheetDef* def, kiriSheet* sheet, kiriFault* fault)
{
    if (def == NULL || sheet == NULL) {
        KIRI_SAY(fault, "def or sheet is null");
        return KIRI_ERROR_ARGUMENT;
    }
    *sheet = 0;
    if (def->cookie != KIRI_COOKIE(kiriSheetDef)) {
        KIRI_SAY(fault, "the def was not filled by kiriDefaultSheetDef");
        return KIRI_ERROR_DEF;
    }
    const char* why = FaultOfSheetValues(def);
    if (why != NULL) {
        KIRI_SAY(fault, "%s", why);
        return KIRI_ERROR_ARGUMENT;
    }
    return KIRI_OK;
}

/* Adds a sheet and records that. `function` is the one that the host has called. */
static kiriResult AddSheet(kiriWorld* world, char* line, const char* function, const kiriSheetDef* def,
                           kiriSheet* sheet)
{
    const void* const arguments[] = { def, sheet };
    const kiriCall call = { world, KIRI_CALL_CREATE_SHEET, arguments };
    const kiriCall* record = world->recorder.sink.write != NULL ? kiriRecord_Begin(&call) : NULL;
    kiriFault fault = { "" };
    kiriResult result = CheckSheetDef(def, sheet, &fault);
    result = result == KIRI_OK ? kiriWorld_AddSheet(world, def, sheet, &fault) : result;
    const char* why = fault.line[0] != '\0' ? fault.line : NULL;
    return kiriCall_End(NULL, record, result < 0 ? kiriCall_Fail(world, line, result, function, why) : result);
}

kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet)
{
    KIRI_PREPARES(world);
    return kiriCall_End(entered, record, AddSheet(world, line, __func__, def, sheet));
}

kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet)
{
    KIRI_CHANGES(world, KIRI_CALL_DESTROY_SHEET, &sheet);
    KIRI_FIND_SHEET(data, sheet);
    kiriWorld_RemoveSheet(world, data);
    KIRI_RETURN(KIRI_OK);
}

static bool IsRectangle(float width, float height, int32_t columns, int32_t rows)
{
    return kiriCall_IsAbove(width, 0.0f) && kiriCall_IsAbove(height, 0.0f) && kiriCall_IsWithin(columns, 1, 4096) &&
           kiriCall_IsWithin(rows, 1, 4096);
}

kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions,
                             int32_t* indices)
{
    if (!IsRectangle(width, height, columns, rows) || restPositions == NULL || indices == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= columns; ++i) {
            *restPositions++ = (float)((double)width * i / columns);
            *restPositions++ = (float)((double)height * j / rows);
        }
    }
    for (int32_t j = 0; j < rows; ++j) {
        for (int32_t i = 0; i < columns; ++i) {
            /* Diagonals alternate, so that the mesh has no grain. */
            int32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 2, d = a + columns + 1;
            int32_t even[6] = { a, b, c, a, c, d }, odd[6] = { a, b, d, b, c, d };
            memcpy(indices, (i + j) % 2 == 0 ? even : odd, sizeof(even));
            indices += 6;
        }
    }
    return KIRI_OK;
}

kiriResult kiriCreateRectangle(kiriWorld* world, float width, float height, int32_t columns, int32_t rows,
                               const kiriSheetDef* def, kiriSheet* sheet)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(sheet != NULL, "sheet is null");
    *sheet = 0;
    KIRI_CHECK(IsRectangle(width, height, columns, rows), "a size is not above 0, or a count not within 1 and 4096");
    kiriSheetDef filled;
    kiriDefaultSheetDef(&filled);
    if (def != NULL) {
        filled = *def;
    }
    filled.vertexCount = (columns + 1) * (rows + 1);
    filled.triangleCount = 2 * columns * rows;
    float* positions = kiriMemory_Alloc(&world->memory, (int64_t)sizeof(float) * 2 * filled.vertexCount);
    int32_t* indices = kiriMemory_Alloc(&world->memory, (int64_t)sizeof(int32_t) * 3 * filled.triangleCount);
    kiriResult result = KIRI_ERROR_MEMORY;
    if (positions != NULL && indices != NULL) {
        kiriFillRectangle(width, height, columns, rows, positions, indices);
        filled.restPositions = positions;
        filled.indices = indices;
        result = AddSheet(world, line, __func__, &filled, sheet);
    }
    kiriMemory_Free(&world->memory, positions);
    kiriMemory_Free(&world->memory, indices);
    bool isSaid = line[0] != '\0' || result >= 0;
    return isSaid ? kiriCall_End(entered, record, result) : KIRI_FAIL(result, NULL);
}

kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut)
{
    KIRI_CHANGES(world, KIRI_CALL_BEGIN_CUT, &sheet, restPoint, cut);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2) && cut != NULL,
               "restPoint or cut is null, or not finite");
    *cut = 0;
    KIRI_FIND_SHEET(data, sheet);
    kiriCutData* made;
    kiriResult result = kiriWorld_AddCut(world, data, 1, &made);
    if (result != KIRI_OK) {
        return KIRI_FAIL(result, NULL);
    }
    kiriWorld_QueuePoint(world, made, kiriSheet_ToLocal(data, restPoint), true);
    *cut = made->id;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count)
{
    KIRI_CHANGES(world, KIRI_CALL_CUT_EXTEND, &cut, restPoints, &count);
    KIRI_CHECK(restPoints != NULL && kiriCall_IsWithin(count, 1, 1 << 24),
               "restPoints is null, or count not within 1 and 16777216");
    KIRI_CHECK(kiriCall_AreFinite(restPoints, 2 * count), "a point is not finite");
    KIRI_FIND_CUT(data, cut);
    kiriSheetData* sheet = data->sheet;
    if (data->ended) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    if (!kiriArray_Reserve(&world->memory, &sheet->queue, (int64_t)sheet->queue.count + count)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    for (int32_t i = 0; i < count; ++i) {
        kiriWorld_QueuePoint(world, data, kiriSheet_ToLocal(sheet, &restPoints[2 * i]), false);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriCut_End(kiriWorld* world, kiriCut cut)
{
    KIRI_CHANGES(world, KIRI_CALL_CUT_END, &cut);
    KIRI_FIND_CUT(data, cut);
    if (data->ended) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    if (!kiriArray_Reserve(&world->memory, &data->sheet->queue, (int64_t)data->sheet->queue.count + 1)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    kiriWorld_EndCut(world, data);
    KIRI_RETURN(KIRI_OK);
}

/* The ways of a cut along all lines of a section, and where each of them starts. */
static bool FindWays(const kiriSheetData* sheet, const kiriSection* section, kiriMemory* scratch, kiriRestPoints* ways,
                     kiriIndices* starts)
{
    double snap = sheet->settings.snap * sheet->mesh.step;
    bool ok = true;
    for (int32_t i = 0; ok && i < section->lines.count; ++i) {
        ok = kiriArray_Push(scratch, starts, ways->count) &&
             kiriSection_Path(section, &section->lines.data[i], false, 0.5 * snap, 0.25 * snap, scratch, ways);
    }
    return ok;
}

static kiriResult QueueSlice(kiriWorld* world, kiriSheetData* sheet, const kiriVec3 quad[4], kiriMemory* scratch,
                             kiriCut* cut)
{
    kiriSection section = { { NULL, 0, 0 }, { NULL, 0, 0 } };
    kiriRestPoints ways = { NULL, 0, 0 };
    kiriIndices starts = { NULL, 0, 0 };
    if (!kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) ||
        !kiriSection_Sweep(&section, scratch, &sheet->seen.surface, sheet->seen.bounds, quad) ||
        !FindWays(sheet, &section, scratch, &ways, &starts)) {
        return KIRI_ERROR_MEMORY;
    }
    kiriCutData* made;
    kiriResult result = kiriWorld_AddCut(world, sheet, ways.count, &made);
    if (result != KIRI_OK) {
        return result;
    }
    for (int32_t i = 0, k = 0; i < ways.count; ++i) {
        bool isStart = k < starts.count && starts.data[k] == i;
        kiriWorld_QueuePoint(world, made, ways.data[i], isStart);
        k += isStart;
    }
    kiriWorld_EndCut(world, made);
    *cut = made->id;
    return KIRI_OK;
}

kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SLICE, &sheet, blade, cut);
    KIRI_CHECK(blade != NULL && kiriCall_AreFinite(blade, 12) && cut != NULL, "blade or cut is null, or not finite");
    *cut = 0;
    KIRI_FIND_SHEET(data, sheet);
    const kiriVec3 quad[4] = { kiriVec3_Load(&blade[0]), kiriVec3_Load(&blade[3]), kiriVec3_Load(&blade[6]),
                               kiriVec3_Load(&blade[9]) };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriResult result = QueueSlice(world, data, quad, &scratch, cut);
    kiriMemory_FreeAll(&scratch);
    KIRI_RETURN(result);
}

#define CHECK_PIECE(data, piece)                                                                                       \
    KIRI_CHECK(kiriCall_IsWithin(piece, 0, (data)->layout.pieces.count - 1), "the sheet has no such piece")

/* Brings lists of pieces up to date. */
#define LIST_PIECES(isListed)                                                                                          \
    do {                                                                                                               \
        if (!(isListed)) {                                                                                             \
            return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);                                                                 \
        }                                                                                                              \
    } while (0)

kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(state != NULL, "state is null");
    KIRI_FIND_SHEET(data, sheet);
    CHECK_PIECE(data, piece);
    LIST_PIECES(kiriPieces_ListFrames(data) && kiriPieces_ListMesh(data));
    *state = kiriPiece_State(data, piece);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(mesh != NULL, "mesh is null");
    KIRI_FIND_SHEET(data, sheet);
    CHECK_PIECE(data, piece);
    LIST_PIECES(kiriPieces_ListFrames(data) && kiriPieces_ListMesh(data));
    const kiriPieceLists* lists = &data->lists;
    kiriSpan vertices = kiriPieceItems_Of(&lists->vertices, piece);
    kiriSpan triangles = kiriPieceItems_Of(&lists->triangles, piece);
    kiriSpan points = kiriPieceItems_Of(&lists->points, piece);
    if (data->layout.pieces.data[piece].isGone) {
        vertices.count = triangles.count = points.count = 0;
    }
    mesh->vertices = lists->vertices.items.data + vertices.first;
    mesh->triangles = lists->triangles.items.data + triangles.first;
    mesh->indices = lists->corners.data + 3 * (int64_t)triangles.first;
    mesh->collisionPoints = points.count > 0 ? lists->points.items.data + points.first : NULL;
    mesh->vertexCount = vertices.count;
    mesh->triangleCount = triangles.count;
    mesh->collisionPointCount = points.count;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetPieceFrames(kiriWorld* world, kiriSheet sheet, int32_t piece, const kiriFrame** frames,
                                    int32_t* count)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(frames != NULL && count != NULL, "frames or count is null");
    KIRI_FIND_SHEET(data, sheet);
    CHECK_PIECE(data, piece);
    LIST_PIECES(kiriPieces_ListFrames(data));
    kiriSpan span = kiriPieceItems_Of(&data->lists.frames, piece);
    *frames = data->lists.ids.data + span.first;
    *count = data->layout.pieces.data[piece].isGone ? 0 : span.count;
    KIRI_RETURN(KIRI_OK);
}

static int32_t PieceThatHas(const kiriWorld* world, const kiriSheetData* sheet, kiriFrame frame)
{
    return sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
}

kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece)
{
    KIRI_READS(world);
    KIRI_CHECK(piece != NULL, "piece is null");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    *piece = PieceThatHas(world, sheet, frame);
    return KIRI_OK;
}

/* The library's line for a result of taking apart. */
static const char* FaultOfParting(kiriResult result)
{
    return result == KIRI_ERROR_STATE ? "the piece is all that is left of its sheet" : NULL;
}

kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached)
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_DETACH_PIECE, &frame, detached);
    KIRI_CHECK(detached != NULL, "detached is null");
    *detached = 0;
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    (void)sheet;
    kiriResult result = kiriParts_Detach(world, &frame, 1, detached);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame)
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_DESTROY_PIECE, &frame);
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    (void)sheet;
    kiriResult result = kiriParts_Destroy(world, &frame, 1);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

static bool AreFrames(const kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    bool all = true;
    for (int32_t i = 0; i < count; ++i) {
        all = all && kiriPool_Find(&world->frameIds, frames[i]) != NULL;
    }
    return all;
}

#define CHECK_FRAMES(frames, count)                                                                                    \
    do {                                                                                                               \
        KIRI_CHECK((count) == 0 || ((count) > 0 && (frames) != NULL), "frames is null, or count below 0");             \
        if (!AreFrames(world, frames, count)) {                                                                        \
            return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with one of these ids");                                \
        }                                                                                                              \
    } while (0)

kiriResult kiriWorld_DetachPieces(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* detached)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_DETACH_PIECES, frames, &count, detached);
    KIRI_CHECK(count <= 0 || detached != NULL, "detached is null");
    for (int32_t i = 0; i < count; ++i) {
        detached[i] = 0;
    }
    CHECK_FRAMES(frames, count);
    kiriResult result = kiriParts_Detach(world, frames, count, detached);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

kiriResult kiriWorld_DestroyPieces(kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_DESTROY_PIECES, frames, &count);
    CHECK_FRAMES(frames, count);
    kiriResult result = kiriParts_Destroy(world, frames, count);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_DROP_CRUMBS, &sheet, &area, count);
    KIRI_CHECK(count != NULL && kiriCall_IsAtLeast(area, 0.0f), "count is null, or area not finite or below 0");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_RETURN(kiriParts_DropCrumbs(world, data, area, count));
}

static kiriFrameData* FindFrame(const kiriWorld* world, kiriFrame frame)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
    return slot != NULL ? &((kiriSheetData*)slot->owner)->frames.data[slot->index] : NULL;
}

kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity,
                               int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(count != NULL && (capacity == 0 || (capacity > 0 && frames != NULL)), "count is null, or frames is");
    KIRI_FIND_SHEET(data, sheet);
    *count = 0;
    for (int32_t i = 0; i < data->frames.count; ++i) {
        bool isGone = kiriSheet_IsGone(data, i);
        if (!isGone && *count < capacity) {
            frames[*count] = data->frames.data[i].id;
        }
        *count += !isGone;
    }
    return KIRI_OK;
}

kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state)
{
    KIRI_READS(world);
    KIRI_CHECK(state != NULL, "state is null");
    const kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with this id");
    }
    const kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frame)->owner;
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, data->site.at);
    kiriVec3 x = kiriFrame_Carry(data, data->site.at);
    state->restPoint[0] = (float)rest.x;
    state->restPoint[1] = (float)rest.y;
    kiriVec3_Store(state->position, x);
    kiriVec3_Store(&state->rotation[0], data->A.u);
    kiriVec3_Store(&state->rotation[3], data->A.v);
    kiriVec3_Store(&state->rotation[6], data->A.d);
    kiriVec3_Store(state->velocity, kiriFrame_VelocityAt(data, data->site.at));
    kiriVec3_Store(state->angularVelocity, data->spin);
    state->area = (float)data->area;
    state->mass = (float)data->mass;
    state->held = data->held;
    return KIRI_OK;
}

kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9])
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_HOLD, &frame, position, rotation);
    KIRI_CHECK((position == NULL) == (rotation == NULL), "only one of position and rotation is null");
    kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with this id");
    }
    kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frame)->owner;
    if (position == NULL) {
        if (data->held) {
            kiriMotion_WakeFrame(sheet, kiriPool_Find(&world->frameIds, frame)->index);
        }
        data->held = 0;
        KIRI_RETURN(KIRI_OK);
    }
    KIRI_CHECK(kiriCall_AreFinite(position, 3), "position is not finite");
    const char* why = kiriCall_FaultOfRotation(sheet, rotation);
    KIRI_CHECK(why == NULL, why);
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    m = kiriMat3_Rotation(m);
    if (data->held && kiriVec3_Shows(data->goalPosition, position) &&
        kiriMat3_Shows(&data->goalRotation, &m, rotation)) {
        KIRI_RETURN(KIRI_OK);
    }
    data->goalPosition = kiriVec3_Load(position);
    data->goalRotation = m;
    if (!data->held) {
        data->held = 1;
        data->heldPosition = kiriFrame_Carry(data, data->site.at);
        data->heldRotation = kiriMat3_Rotation(data->A);
        data->isOffKnown = false;
    }
    kiriMotion_WakeFrame(sheet, kiriPool_Find(&world->frameIds, frame)->index);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_GetReaction(const kiriWorld* world, kiriFrame frame, double force[3], double torque[3])
{
    KIRI_READS(world);
    KIRI_CHECK(force != NULL && torque != NULL, "force or torque is null");
    const kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with this id");
    }
    kiriVec3_StoreDoubles(force, data->bore.force);
    kiriVec3_StoreDoubles(torque, data->bore.moment);
    return KIRI_OK;
}

/* What is wrong with a rotation of the whole space, or null. */
static const char* FaultOfTurn(const kiriSheetData* sheet, const float rotation[9])
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 u = kiriVec3_Load(&rotation[0]), v = kiriVec3_Load(&rotation[3]), w = kiriVec3_Load(&rotation[6]);
    if (!kiriCall_AreOrthonormal(&rotation[0], &rotation[3]) || !kiriCall_AreOrthonormal(&rotation[3], &rotation[6]) ||
        !kiriCall_AreOrthonormal(&rotation[6], &rotation[0])) {
        return "rotation is not orthonormal";
    }
    if (!(kiriVec3_Dot(kiriVec3_Cross(u, v), w) > 0.0)) {
        return "rotation mirrors";
    }
    const kiriMat3 R = { u, v, w };
    kiriVec3 d = mechanics->axes.d;
    return mechanics->planar && !(kiriVec3_Dot(kiriMat3_Mul(R, d), d) > 0.999999)
               ? "rotation turns a planar sheet out of its plane"
               : NULL;
}

kiriResult kiriSheet_Transform(kiriWorld* world, kiriSheet sheet, const float rotation[9], const float translation[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_TRANSFORM, &sheet, rotation, translation);
    KIRI_CHECK(rotation != NULL && kiriCall_AreFinite(rotation, 9), "rotation is null or not finite");
    KIRI_CHECK(translation != NULL && kiriCall_AreFinite(translation, 3), "translation is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    const char* why = FaultOfTurn(data, rotation);
    KIRI_CHECK(why == NULL, why);
    kiriMat3 given = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    kiriMat3 R = kiriMat3_Rotation(given);
    KIRI_CHECK(kiriCarry_FitsSheet(data, &R, kiriVec3_Load(translation)), "floats cannot hold what comes of it");
    bool isDone = kiriCarry_Sheet(data, &R, kiriVec3_Load(translation), &world->retired);
    if (isDone) {
        kiriPinStep_Carry(world, data, &R, kiriVec3_Load(translation));
    }
    KIRI_RETURN(isDone ? KIRI_OK : KIRI_ERROR_MEMORY);
}

kiriResult kiriSheet_SetVelocity(kiriWorld* world, kiriSheet sheet, const float velocity[3],
                                 const float angularVelocity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SET_VELOCITY, &sheet, velocity, angularVelocity);
    KIRI_CHECK(velocity != NULL && kiriCall_AreFinite(velocity, 3), "velocity is null or not finite");
    KIRI_CHECK(angularVelocity != NULL && kiriCall_AreFinite(angularVelocity, 3),
               "angularVelocity is null or not finite");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(kiriCarry_SetVelocity(data, KIRI_NONE, kiriVec3_Load(velocity), kiriVec3_Load(angularVelocity)),
               "floats cannot hold what comes of it");
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_SetPieceVelocity(kiriWorld* world, kiriFrame frame, const float velocity[3],
                                      const float angularVelocity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_SET_PIECE_VELOCITY, &frame, velocity, angularVelocity);
    KIRI_CHECK(velocity != NULL && kiriCall_AreFinite(velocity, 3), "velocity is null or not finite");
    KIRI_CHECK(angularVelocity != NULL && kiriCall_AreFinite(angularVelocity, 3),
               "angularVelocity is null or not finite");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    int32_t piece = sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
    KIRI_CHECK(kiriCarry_SetVelocity(sheet, piece, kiriVec3_Load(velocity), kiriVec3_Load(angularVelocity)),
               "floats cannot hold what comes of it");
    KIRI_RETURN(KIRI_OK);
}

/* ---- Another origin ---------------------------------------------------------------------------------------------- */

static bool FitsShift(const kiriWorld* world, kiriVec3 origin)
{
    const kiriMat3 axes = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    bool fits = true;
    for (int32_t i = 0; fits && i < world->sheets.count; ++i) {
        fits = kiriCarry_FitsSheet(world->sheets.data[i], &axes, kiriVec3_Scale(-1.0, origin));
    }
    for (int32_t i = 0; fits && i < world->obstacles.count; ++i) {
        fits = kiriVec3_FitsFloats(kiriVec3_Sub(world->obstacles.data[i]->position, origin));
    }
    for (int32_t i = 0; fits && i < world->blades.count; ++i) {
        const kiriBladeData* blade = world->blades.data[i];
        fits = kiriVec3_FitsFloats(kiriVec3_Sub(blade->edge[0], origin)) &&
               kiriVec3_FitsFloats(kiriVec3_Sub(blade->edge[1], origin));
    }
    return fits;
}

/* Renews the arrays that the host may hold, of all sheets or of none. */
static bool RenewAll(kiriWorld* world)
{
    int32_t done = 0;
    while (done < world->sheets.count && kiriCarry_Renew(world->sheets.data[done], &world->retired)) {
        ++done;
    }
    const kiriVec3 none = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < done && done < world->sheets.count; ++i) {
        kiriCarry_Shift(world->sheets.data[i], none);
    }
    return done == world->sheets.count;
}

static void ShiftObstacles(kiriWorld* world, kiriVec3 origin)
{
    for (int32_t i = 0; i < world->obstacles.count; ++i) {
        kiriObstacleData* obstacle = world->obstacles.data[i];
        obstacle->position = kiriVec3_Sub(obstacle->position, origin);
        obstacle->lower = kiriVec3_Sub(obstacle->lower, origin);
        obstacle->upper = kiriVec3_Sub(obstacle->upper, origin);
    }
}

static void ShiftBlade(kiriBladeData* blade, kiriVec3 origin)
{
    for (int end = 0; end < 2 && blade->isPlaced; ++end) {
        blade->edge[end] = kiriVec3_Sub(blade->edge[end], origin);
    }
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        blade->layers.data[i].at = kiriVec3_Sub(blade->layers.data[i].at, origin);
    }
}

kiriResult kiriWorld_ShiftOrigin(kiriWorld* world, const float origin[3])
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_SHIFT_ORIGIN, origin);
    KIRI_CHECK(origin != NULL && kiriCall_AreFinite(origin, 3), "origin is null or not finite");
    kiriVec3 to = kiriVec3_Load(origin);
    if (to.x == 0.0 && to.y == 0.0 && to.z == 0.0) {
        KIRI_RETURN(KIRI_OK);
    }
    KIRI_CHECK(FitsShift(world, to), "floats cannot hold what comes of it");
    if (!RenewAll(world)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriCarry_Shift(world->sheets.data[i], to);
    }
    ShiftObstacles(world, to);
    for (int32_t i = 0; i < world->blades.count; ++i) {
        ShiftBlade(world->blades.data[i], to);
    }
    KIRI_RETURN(KIRI_OK);
}
