#include "kiri_call.h"
#include "../sheet/kiri_sheet.h"
#include "../view/kiri_section.h"
#include "kiri_seam.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_seen.h"
#include "kiri_blade.h"
#include "../sheet/kiri_build.h"
#include "kiri_move.h"

#include <float.h>

void kiriDefaultSheetDef(kiriSheetDef* def)
{
    if (def == NULL) {
        return;
    }
    KIRI_CLEAR(def);
    def->cookie = KIRI_COOKIE(kiriSheetDef);
    def->axisU[0] = 1.0f;
    def->axisV[1] = 1.0f;
    kiriGetMaterial(KIRI_MATERIAL_COTTON, &def->material);
    def->gridResolution = 32;
    def->frameCount = 24;
    def->accuracy = 0.02f;
    def->maxFrames = 256;
    def->rigidWeight = 0.95f;
    def->friction = 0.5f;
    def->groups = UINT32_MAX;
    def->iterations = 2;
    def->sleepSpeed = 0.001f;
    def->skinning = KIRI_SKINNING_SMOOTH;
    def->timeStepping = KIRI_TIME_STEPPING_SECOND_ORDER;
    def->fadeTime = 0.2f;
    def->normals = 1;
    def->paper.integrationOrder = 1;
}

/* Adds a sheet. `function` is the public function, for the error line. */
static kiriResult AddSheet(kiriWorld* world, const char* function, const kiriSheetDef* def, kiriSheet* sheet)
{
    const void* const arguments[] = { def, sheet };
    KIRI_BEGIN(KIRI_CALL_CreateSheet, function, "def, sheet", arguments);
    kiriFault fault = { "" };
    return KIRI_FAIL(kiriWorld_AddSheet(world, def, NULL, 0, sheet, &fault), fault.line);
}

kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet)
{
    return AddSheet(world, __func__, def, sheet);
}

kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet)
{
    KIRI_CHANGES(DestroySheet, &sheet);
    kiriWorld_RemoveSheet(world, call->sheet);
    kiriSeams_DropStale(world);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions,
                             int32_t* indices)
{
    bool isRectangle = width > 0.0f && width <= FLT_MAX && height > 0.0f && height <= FLT_MAX && columns >= 1 &&
                       columns <= 4096 && rows >= 1 && rows <= 4096;
    if (!isRectangle || restPositions == NULL || indices == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= columns; ++i) {
            *restPositions++ = (float)((double)width * i / columns);
            *restPositions++ = (float)((double)height * j / rows);
        }
    }
    KIRI_TIMES(j, rows) {
        KIRI_TIMES(i, columns) {
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
    if (sheet != NULL) {
        *sheet = 0;
    }
    KIRI_PREPARES(world);
    KIRI_CHECK_OUT(sheet);
    kiriSheetDef filled;
    kiriDefaultSheetDef(&filled);
    if (def != NULL) {
        filled = *def;
    }
    KIRI_CHECK_NUMBER(width, KIRI_ABOVE_0, FLT_MAX);
    KIRI_CHECK_NUMBER(height, KIRI_ABOVE_0, FLT_MAX);
    KIRI_CHECK_NUMBER(columns, 0, 4096);
    KIRI_CHECK_NUMBER(rows, 0, 4096);
    bool isGrid = filled.gridResolution >= 1 && filled.gridResolution <= 4096;
    double squares = isGrid ? 1.5 * filled.gridResolution / kiriMax(width, height) : 0.0; /* a metre */
    columns = columns != 0 ? columns : kiriMax(1, kiriMin(4096, (int32_t)(squares * width + 0.5)));
    rows = rows != 0 ? rows : kiriMax(1, kiriMin(4096, (int32_t)(squares * height + 0.5)));
    filled.vertexCount = (columns + 1) * (rows + 1);
    filled.triangleCount = 2 * columns * rows;
    float* positions = kiriMemory_Alloc(&world->memory, (int64_t)sizeof(float) * 2 * filled.vertexCount);
    int32_t* indices = kiriMemory_Alloc(&world->memory, (int64_t)sizeof(int32_t) * 3 * filled.triangleCount);
    bool hasMemory = positions != NULL && indices != NULL;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (hasMemory) {
        kiriFillRectangle(width, height, columns, rows, positions, indices);
        filled.restPositions = positions;
        filled.indices = indices;
        world->isBusy = false;
        result = AddSheet(world, __func__, &filled, sheet);
        world->isBusy = true;
    }
    kiriMemory_Free(&world->memory, positions);
    kiriMemory_Free(&world->memory, indices);
    if (!hasMemory) {
        return KIRI_FAIL(result, NULL);
    }
    world->isBusy = false;
    return result; /* AddSheet has logged a failure */
}

kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut)
{
    KIRI_CHANGES(BeginCut, &sheet, restPoint, cut);
    kiriCutData* made;
    kiriResult result = kiriWorld_AddCut(world, call->sheet, 1, &made);
    KIRI_REQUIRE(result == KIRI_OK, result, NULL);
    kiriWorld_QueuePoint(world, made, kiriSheet_ToLocal(call->sheet, restPoint), true);
    *cut = made->id;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count)
{
    KIRI_CHANGES(Cut_Extend, &cut, restPoints, &count);
    kiriCutData* data = call->owner;
    kiriSheetData* sheet = data->sheet;
    KIRI_REQUIRE(!data->ended, KIRI_ERROR_STATE, "the cut has been ended");
    KIRI_REQUIRE(kiriArray_ReserveMore(&world->memory, &sheet->queue, count), KIRI_ERROR_MEMORY, NULL);
    KIRI_TIMES(i, count) {
        kiriWorld_QueuePoint(world, data, kiriSheet_ToLocal(sheet, &restPoints[2 * i]), false);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriCut_End(kiriWorld* world, kiriCut cut)
{
    KIRI_CHANGES(Cut_End, &cut);
    kiriCutData* data = call->owner;
    KIRI_REQUIRE(!data->ended, KIRI_ERROR_STATE, "the cut has been ended");
    KIRI_REQUIRE(kiriArray_ReserveMore(&world->memory, &data->sheet->queue, 1), KIRI_ERROR_MEMORY, NULL);
    kiriWorld_EndCut(world, data);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_Cut(kiriWorld* world, kiriSheet sheet, const float* restPoints, int32_t count, kiriCut* cut)
{
    KIRI_CHANGES(Sheet_Cut, &sheet, restPoints, &count, cut);
    kiriCutData* made;
    KIRI_REQUIRE(count > 1, KIRI_ERROR_ARGUMENT, "a cut in one call has two points or more");
    kiriResult result = kiriWorld_AddCut(world, call->sheet, count, &made);
    KIRI_REQUIRE(result == KIRI_OK, result, NULL);
    KIRI_TIMES(i, count) {
        kiriWorld_QueuePoint(world, made, kiriSheet_ToLocal(call->sheet, &restPoints[2 * i]), i == 0);
    }
    kiriWorld_EndCut(world, made);
    *cut = made->id;
    KIRI_RETURN(KIRI_OK);
}

/* Queues a cut along each line where the plane of the quad meets the sheet. */
static kiriResult QueueSlice(kiriWorld* world, kiriSheetData* sheet, const kiriVec3 quad[4], kiriMemory* scratch,
                             kiriCut* cut)
{
    kiriSection section = { 0 };
    kiriRestPoints ways = { 0 };
    kiriIndices starts = { 0 };
    const kiriSweep sweep = { { quad[0], quad[1] }, { quad[3], quad[2] }, NULL, NULL, 0.0 };
    if (!kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) ||
        !kiriSection_Sweep(&section, scratch, &sheet->seen.surface, sheet->seen.bounds, &sweep)) {
        return KIRI_ERROR_MEMORY;
    }
    double snap = sheet->settings.snap * sheet->mesh.step;
    KIRI_EACH(const kiriSectionLine, line, section.lines) {
        if (!kiriArray_Push(scratch, &starts, ways.count) ||
            !kiriSection_Path(&section, line, false, 0.25 * snap, scratch, &ways)) {
            return KIRI_ERROR_MEMORY;
        }
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
    KIRI_ASSERT(made->id != 0);
    kiriWorld_EndCut(world, made);
    *cut = made->id;
    return KIRI_OK;
}

kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut)
{
    KIRI_CHANGES(Sheet_Slice, &sheet, blade, cut);
    const kiriVec3 quad[4] = { kiriVec3_Load(&blade[0]), kiriVec3_Load(&blade[3]), kiriVec3_Load(&blade[6]),
                               kiriVec3_Load(&blade[9]) };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriResult result = QueueSlice(world, call->sheet, quad, &scratch, cut);
    kiriMemory_FreeAll(&scratch);
    KIRI_RETURN(result);
}

/* Begins a function that reads a piece: finds the sheet, and updates lists of pieces. */
#define PREPARES_PIECE(piece, out, isListed)                                                                           \
    KIRI_PREPARES(world);                                                                                              \
    KIRI_CHECK_OUT(out);                                                                                               \
    KIRI_FIND(sheet);                                                                                                  \
    KIRI_CHECK_NUMBER(piece, 0, found->layout.pieces.count - 1);                                                       \
    KIRI_REQUIRE(isListed, KIRI_ERROR_MEMORY, NULL)

kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state)
{
    PREPARES_PIECE(piece, state, kiriPieces_ListFrames(found) && kiriPieces_ListMesh(found));
    *state = kiriPiece_State(found, piece);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh)
{
    PREPARES_PIECE(piece, mesh, kiriPieces_ListFrames(found) && kiriPieces_ListMesh(found));
    const kiriPieceLists* lists = &found->lists;
    kiriSpan vertices = kiriPieceItems_Of(&lists->vertices, piece);
    kiriSpan triangles = kiriPieceItems_Of(&lists->triangles, piece);
    kiriSpan points = kiriPieceItems_Of(&lists->points, piece);
    if (found->layout.pieces.data[piece].isGone) {
        vertices.count = triangles.count = points.count = 0;
    }
    KIRI_ASSERT(vertices.first + vertices.count <= lists->vertices.items.count &&
                triangles.first + triangles.count <= lists->triangles.items.count);
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
    PREPARES_PIECE(piece, frames, kiriPieces_ListFrames(found));
    KIRI_CHECK_OUT(count);
    kiriSpan span = found->solver->bodies.bodies.data[piece].frames;
    *frames = found->lists.ids.data + span.first;
    *count = found->layout.pieces.data[piece].isGone ? 0 : span.count;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece)
{
    KIRI_READS_OF(frame, piece);
    *piece = found->layout.framePiece.data[slot->index];
    return KIRI_OK;
}

kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity,
                               int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK_LIST(frames);
    KIRI_FIND(sheet);
    *count = 0;
    KIRI_EACH_INDEX(i, found->frames) {
        bool isGone = kiriSheet_IsGone(found, i);
        if (!isGone && *count < capacity) {
            frames[*count] = found->frames.data[i].id;
        }
        *count += !isGone;
    }
    return KIRI_OK;
}

kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state)
{
    KIRI_READS_OF(frame, state);
    KIRI_ASSERT(slot->index < found->frames.count && found->frames.data[slot->index].id == frame);
    const kiriFrameData* data = &found->frames.data[slot->index];
    kiriVec3 x = kiriFrame_Carry(data, data->site.at);
    kiriVec2_Store(state->restPoint, kiriVec2_Add(found->mesh.origin, data->site.at));
    kiriVec3_Store(state->position, x);
    kiriMat3_Store(state->rotation, data->A);
    kiriVec3_Store(state->velocity, kiriFrame_VelocityAt(data, data->site.at));
    kiriVec3_Store(state->angularVelocity, data->spin);
    state->area = (float)data->area;
    state->mass = (float)data->mass;
    state->held = data->held;
    return KIRI_OK;
}

kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9])
{
    KIRI_CHANGES(Frame_Hold, &frame, position, rotation);
    KIRI_CHECK((position == NULL) == (rotation == NULL), "only one of position and rotation is null");
    KIRI_ASSERT(call->index < call->sheet->frames.count);
    kiriFrameData* data = &call->sheet->frames.data[call->index];
    if (position == NULL) {
        if (data->held) {
            kiriSheet_WakeFrame(call->sheet, call->index);
        }
        data->held = 0;
        KIRI_RETURN(KIRI_OK);
    }
    kiriMat3 m = kiriMat3_Rotation(kiriMat3_Load(rotation));
    KIRI_CHECK(kiriCall_KeepsPlane(call->sheet, m.d), "rotation turns a planar sheet out of its plane");
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
    }
    kiriSheet_WakeFrame(call->sheet, call->index);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_GetReaction(const kiriWorld* world, kiriFrame frame, double force[3], double torque[3])
{
    KIRI_READS_OF(frame, force);
    KIRI_CHECK_OUT(torque);
    kiriWrench_Store(&found->frames.data[slot->index].bore, force, torque);
    return KIRI_OK;
}

bool kiriCall_KeepsPlane(const kiriSheetData* sheet, kiriVec3 d)
{
    return !sheet->settings.mechanics.planar || kiriVec3_Dot(d, sheet->settings.mechanics.axes.d) > 0.999999;
}

/* ---- Place ------------------------------------------------------------------------------------------------------- */

static void TurnVector(const kiriMat3* R, kiriVec3* a)
{
    *a = kiriMat3_Mul(*R, *a);
}

static void TurnColumns(const kiriMat3* R, kiriMat3* A)
{
    *A = kiriMat3_MulMat(*R, *A);
}

static void CarryFrame(kiriFrameData* frame, const kiriMat3* R, kiriVec3 t, bool isRigid)
{
    frame->x = kiriVec3_Add(kiriMat3_Mul(*R, frame->x), t);
    TurnColumns(R, &frame->A);
    frame->A = isRigid ? kiriMat3_Rotation(frame->A) : frame->A;
    TurnVector(R, &frame->velocity);
    TurnVector(R, &frame->spin);
    TurnColumns(R, &frame->rate);
    TurnVector(R, &frame->history.gain);
    TurnVector(R, &frame->history.lag);
    TurnVector(R, &frame->history.pull);
    TurnColumns(R, &frame->history.turnGain);
    TurnColumns(R, &frame->history.turnLag);
    TurnColumns(R, &frame->history.turnPull);
}

/* ---- What holds it ---- */

static void TurnWrench(const kiriMat3* R, kiriWrench* wrench)
{
    TurnVector(R, &wrench->force);
    TurnVector(R, &wrench->moment);
}

static void TurnReaction(const kiriMat3* R, kiriReaction* reaction)
{
    TurnWrench(R, &reaction->gain);
    TurnWrench(R, &reaction->pull);
    TurnVector(R, &reaction->offset);
}

static double SquareApart(kiriVec3 a, kiriVec3 b)
{
    kiriVec3 d = kiriVec3_Sub(a, b);
    return kiriVec3_Dot(d, d);
}

/* Returns the squared distance of two poses of a body of this size (m). */
static double PosesApart(kiriVec3 a, const kiriMat3* A, kiriVec3 b, const kiriMat3* B, double size)
{
    double turned = SquareApart(A->u, B->u) + SquareApart(A->v, B->v);
    return SquareApart(a, b) + size * size * turned;
}

static void CarryPose(const kiriMat3* R, kiriVec3 t, kiriVec3* x, kiriMat3* A)
{
    *x = kiriVec3_Add(kiriMat3_Mul(*R, *x), t);
    TurnColumns(R, A);
    *A = kiriMat3_Rotation(*A);
}

/* Transforms a held pose and its goal for the next tick. A goal nearer to the new pose than to the old one stays: the
   host has moved it already. */
static void CarryHeld(const kiriMat3* R, kiriVec3 t, double size, kiriVec3* at, kiriMat3* axes, kiriVec3* goal,
                      kiriMat3* goalAxes)
{
    kiriVec3 was = *at;
    kiriMat3 wasAxes = *axes;
    CarryPose(R, t, at, axes);
    if (!(PosesApart(*goal, goalAxes, *at, axes, size) < PosesApart(*goal, goalAxes, was, &wasAxes, size))) {
        CarryPose(R, t, goal, goalAxes);
    }
}

static void TurnPins(kiriSheetData* sheet, const kiriMat3* R)
{
    KIRI_EACH(kiriPinData, pin, sheet->pins) {
        TurnReaction(R, &pin->reaction);
        TurnWrench(R, &pin->bore);
    }
    KIRI_EACH(kiriPinShare, share, sheet->layout.pinShares) {
        TurnReaction(R, &share->reactions[0]);
        TurnReaction(R, &share->reactions[1]);
        TurnWrench(R, &share->bore);
    }
}

/* Returns true if floats can hold the sheet after x -> R x + t, see kiriFrame_FitsFloats. */
static bool FitsCarried(const kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t)
{
    KIRI_EACH(const kiriFrameData, frame, sheet->frames) {
        kiriFrameData moved = *frame;
        CarryFrame(&moved, R, t, false);
        if (!kiriFrame_FitsFloats(&moved)) {
            return false;
        }
    }
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        if (!kiriVec3_FitsFloats(kiriVec3_Add(kiriMat3_Mul(*R, pin->target), t))) {
            return false;
        }
    }
    return true;
}

static void TurnFades(kiriFades* fades, const kiriMat3* R)
{
    KIRI_EACH(kiriFading, at, fades->fading) {
        TurnVector(R, &at->offset);
    }
}

/* Moves the arrays that the host may hold, so that positions can be written again. Fails on out of memory. */
static bool RenewArrays(kiriSheetData* sheet, kiriMemory* retired)
{
    kiriSeen* seen = &sheet->seen;
    return kiriArray_Renew(&sheet->shown, &seen->surface.positions, sizeof(float), retired) &&
           kiriArray_Renew(&sheet->shown, &seen->surface.normals, sizeof(float), retired) &&
           kiriArray_Renew(&sheet->shown, &seen->pointPositions, sizeof(float), retired);
}

kiriResult kiriSheet_Transform(kiriWorld* world, kiriSheet sheet, const float rotation[9], const float translation[3])
{
    KIRI_CHANGES(Sheet_Transform, &sheet, rotation, translation);
    kiriSheetData* data = call->sheet;
    kiriMat3 R = kiriMat3_Rotation(kiriMat3_Load(rotation));
    kiriVec3 t = kiriVec3_Load(translation);
    KIRI_CHECK(kiriCall_KeepsPlane(data, kiriMat3_Mul(R, data->settings.mechanics.axes.d)),
               "rotation turns a planar sheet out of its plane");
    KIRI_CHECK(FitsCarried(data, &R, t), "floats cannot hold what comes of it");
    KIRI_REQUIRE(RenewArrays(data, &world->retired), KIRI_ERROR_MEMORY, NULL);
    KIRI_EACH(kiriFrameData, frame, data->frames) {
        CarryFrame(frame, &R, t, data->settings.mechanics.model == KIRI_MODEL_LINKS);
        if (frame->held) {
            CarryHeld(&R, t, kiriRoot(frame->area), &frame->heldPosition, &frame->heldRotation, &frame->goalPosition,
                      &frame->goalRotation);
            TurnReaction(&R, &frame->reaction);
            TurnWrench(&R, &frame->bore);
        }
    }
    TurnPins(data, &R);
    TurnFades(&data->seen.fades, &R);
    TurnFades(&data->seen.pointFades, &R);
    data->seen.surface.before.count = 0;
    for (int32_t k = 0; k < data->seen.surface.detail.offsets.count; k += 3) {
        float* offset = data->seen.surface.detail.offsets.data + k;
        kiriVec3_Store(offset, kiriMat3_Mul(R, kiriVec3_Load(offset)));
    }
    kiriView_WritePositions(data);
    kiriSheet_WakeAll(data);
    KIRI_EACH(kiriPinData, pin, data->pins) {
        if (kiriPinStep_Obstacle(world, pin) == NULL) {
            double length =
                kiriVec2_Distance(kiriMesh_Local(&data->mesh, pin->to), kiriMesh_Local(&data->mesh, pin->at));
            CarryHeld(&R, t, 0.5 * length, &pin->lastTarget, &pin->lastRotation, &pin->target, &pin->rotation);
        }
    }
    KIRI_RETURN(KIRI_OK);
}

/* ---- Velocity ---------------------------------------------------------------------------------------------------- */

static bool IsOf(const kiriSheetData* sheet, int32_t frame, int32_t piece)
{
    return piece == KIRI_NONE || sheet->layout.framePiece.data[frame] == piece;
}

static kiriVec3 CenterOf(const kiriSheetData* sheet, int32_t piece)
{
    KIRI_ASSERT(piece >= KIRI_NONE && piece < sheet->layout.pieces.count);
    kiriVec3 sum = { 0 };
    double mass = 0.0;
    KIRI_EACH_INDEX(i, sheet->frames) {
        if (IsOf(sheet, i, piece)) {
            sum = kiriVec3_AddScaled(sum, sheet->frames.data[i].mass, sheet->frames.data[i].x);
            mass += sheet->frames.data[i].mass;
        }
    }
    return kiriVec3_Scale(1.0 / mass, sum);
}

static void GiveVelocity(kiriFrameData* frame, kiriVec3 center, kiriVec3 velocity, kiriVec3 spin)
{
    frame->velocity = kiriVec3_Add(velocity, kiriVec3_Cross(spin, kiriVec3_Sub(frame->x, center)));
    frame->spin = spin;
    KIRI_CLEAR(&frame->rate);
    KIRI_CLEAR(&frame->history);
}

/* Gives a piece, or all (KIRI_NONE), a rigid motion about its center of mass. In a planar sheet, only the components in its
   plane count. Returns false, and changes nothing, if frames would not fit floats. */
static bool SetRigidVelocity(kiriSheetData* sheet, int32_t piece, kiriVec3 velocity, kiriVec3 spin)
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 d = mechanics->axes.d, center = CenterOf(sheet, piece);
    if (mechanics->planar) {
        velocity = kiriVec3_Across(velocity, d);
        spin = kiriVec3_Scale(kiriVec3_Dot(spin, d), d);
    }
    KIRI_EACH_INDEX(i, sheet->frames) {
        kiriFrameData given = sheet->frames.data[i];
        GiveVelocity(&given, center, velocity, spin);
        if (IsOf(sheet, i, piece) && !kiriFrame_FitsFloats(&given)) {
            return false;
        }
    }
    KIRI_EACH_INDEX(i, sheet->frames) {
        if (IsOf(sheet, i, piece)) {
            GiveVelocity(&sheet->frames.data[i], center, velocity, spin);
            kiriSheet_WakeFrame(sheet, i);
        }
    }
    return true;
}

static kiriResult SetVelocity(kiriCall* call, int32_t piece, const float velocity[3], const float spin[3])
{
    bool fits = SetRigidVelocity(call->sheet, piece, kiriVec3_Load(velocity), kiriVec3_Load(spin));
    return kiriCall_End(call->world, call, call->function, fits ? KIRI_OK : KIRI_ERROR_ARGUMENT,
                        fits ? NULL : "floats cannot hold what comes of it");
}

kiriResult kiriSheet_SetVelocity(kiriWorld* world, kiriSheet sheet, const float velocity[3],
                                 const float angularVelocity[3])
{
    KIRI_CHANGES(Sheet_SetVelocity, &sheet, velocity, angularVelocity);
    return SetVelocity(call, KIRI_NONE, velocity, angularVelocity);
}

kiriResult kiriFrame_SetPieceVelocity(kiriWorld* world, kiriFrame frame, const float velocity[3],
                                      const float angularVelocity[3])
{
    KIRI_CHANGES(Frame_SetPieceVelocity, &frame, velocity, angularVelocity);
    KIRI_ASSERT(call->index < call->sheet->layout.framePiece.count);
    return SetVelocity(call, call->sheet->layout.framePiece.data[call->index], velocity, angularVelocity);
}

/* ---- Another origin ---------------------------------------------------------------------------------------------- */

static void Shift(kiriVec3* at, kiriVec3 origin)
{
    *at = kiriVec3_Sub(*at, origin);
}

static void ShiftTouches(kiriTouch* touches, int32_t count, kiriVec3 origin)
{
    KIRI_TIMES(i, count) {
        Shift(&touches[i].seen, origin);
        Shift(&touches[i].on, origin);
        touches[i].offset -= kiriVec3_Dot(touches[i].normal, origin);
    }
}

static void ShiftContacts(kiriSheetData* sheet, kiriVec3 origin)
{
    kiriTouches* touches = &sheet->touches;
    ShiftTouches(touches->found.data, touches->found.count, origin);
    ShiftTouches(touches->last.touches.data, touches->last.touches.count, origin);
    ShiftTouches(touches->slept.touches.data, touches->slept.touches.count, origin);
    touches->rests.areSummed = false; /* the sums are about centers of mass of obstacles, which shift */
    KIRI_EACH(kiriGivenContact, given, sheet->contacts) {
        kiriContact* contact = &given->contact;
        contact->offset = (float)(contact->offset - kiriVec3_Dot(kiriVec3_Load(contact->normal), origin));
    }
}

static void ShiftSheet(kiriSheetData* sheet, kiriVec3 origin)
{
    KIRI_EACH(kiriFrameData, frame, sheet->frames) {
        Shift(&frame->x, origin);
        Shift(&frame->last.x, origin);
        if (frame->held) {
            Shift(&frame->heldPosition, origin);
            Shift(&frame->goalPosition, origin);
        }
    }
    KIRI_EACH(kiriPinData, pin, sheet->pins) {
        Shift(&pin->target, origin);
        Shift(&pin->lastTarget, origin);
    }
    ShiftContacts(sheet, origin);
    sheet->seen.surface.before.count = 0;
    kiriView_WritePositions(sheet);
}

static bool FitsShift(const kiriWorld* world, kiriVec3 origin)
{
    const kiriMat3 axes = KIRI_AXES;
    bool fits = true;
    KIRI_EACH_OF_WHILE(fits, kiriSheetData, sheet, world->sheets) {
        fits = FitsCarried(sheet, &axes, kiriVec3_Scale(-1.0, origin));
    }
    KIRI_EACH_OF_WHILE(fits, kiriObstacleData, obstacle, world->obstacles) {
        fits = kiriVec3_FitsFloats(kiriVec3_Sub(obstacle->position, origin));
    }
    KIRI_EACH_OF_WHILE(fits, kiriBladeData, blade, world->blades) {
        fits = kiriVec3_FitsFloats(kiriVec3_Sub(blade->edge[0], origin)) &&
               kiriVec3_FitsFloats(kiriVec3_Sub(blade->edge[1], origin));
    }
    return fits;
}

kiriResult kiriWorld_ShiftOrigin(kiriWorld* world, const float origin[3])
{
    KIRI_CHANGES(World_ShiftOrigin, origin);
    kiriVec3 to = kiriVec3_Load(origin);
    if (to.x == 0.0 && to.y == 0.0 && to.z == 0.0) {
        KIRI_RETURN(KIRI_OK);
    }
    KIRI_CHECK(FitsShift(world, to), "floats cannot hold what comes of it");
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        KIRI_REQUIRE(RenewArrays(sheet, &world->retired), KIRI_ERROR_MEMORY, NULL);
    }
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        ShiftSheet(sheet, to);
    }
    KIRI_EACH_OF(kiriObstacleData, obstacle, world->obstacles) {
        obstacle->position = kiriVec3_Sub(obstacle->position, to);
        obstacle->lower = kiriVec3_Sub(obstacle->lower, to);
        obstacle->upper = kiriVec3_Sub(obstacle->upper, to);
    }
    KIRI_EACH_OF(kiriBladeData, blade, world->blades) {
        KIRI_TIMES_WHILE(blade->isPlaced, end, 2) {
            blade->edge[end] = kiriVec3_Sub(blade->edge[end], to);
        }
        KIRI_EACH(kiriLayer, layer, blade->layers) {
            layer->at = kiriVec3_Sub(layer->at, to);
        }
    }
    KIRI_RETURN(KIRI_OK);
}

/* ---- Folds ------------------------------------------------------------------------------------------------------- */

kiriResult kiriCreateFoldedSheet(kiriWorld* world, const kiriSheetDef* def, const kiriFold* folds, int32_t count,
                                 kiriSheet* sheet)
{
    KIRI_CHANGES(CreateFoldedSheet, def, folds, &count, sheet);
    kiriFault fault = { "" };
    KIRI_CHECK(def->model == KIRI_MODEL_LINKS, "only KIRI_MODEL_LINKS has folds");
    return KIRI_FAIL(kiriWorld_AddSheet(world, def, folds, count, sheet, &fault), fault.line);
}

kiriResult kiriSheet_AddFold(kiriWorld* world, kiriSheet sheet, const kiriFold* fold, int32_t* index)
{
    KIRI_CHANGES(Sheet_AddFold, &sheet, fold, index);
    kiriSheetData* data = call->sheet;
    kiriMeshData* mesh = &data->mesh;
    kiriFault fault = { "" };
    kiriCutData* made;
    KIRI_CHECK(data->settings.mechanics.model == KIRI_MODEL_LINKS, "only KIRI_MODEL_LINKS has folds");
    KIRI_CHECK(mesh->folds.count < KIRI_MOST_FOLDS, "the sheet has too many folds");
    kiriResult result = kiriFolds_Add(data, fold, &fault);
    KIRI_REQUIRE(result == KIRI_OK, result, fault.line);
    result = kiriWorld_AddCut(world, data, 2, &made);
    if (result != KIRI_OK) {
        mesh->folds.count -= 1;
        KIRI_RETURN(result);
    }
    const kiriFoldLine* line = &mesh->folds.data[mesh->folds.count - 1];
    made->tip.blade.fold = mesh->folds.count;
    kiriWorld_QueuePoint(world, made, kiriMesh_Local(mesh, line->from), true);
    kiriWorld_QueuePoint(world, made, kiriMesh_Local(mesh, line->to), false);
    kiriWorld_EndCut(world, made);
    *index = mesh->folds.count - 1;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetFold(const kiriWorld* world, kiriSheet sheet, int32_t index, kiriFoldState* state)
{
    KIRI_READS_OF(sheet, state);
    KIRI_CHECK_NUMBER(index, 0, found->mesh.folds.count - 1);
    const kiriFoldLine* line = &found->mesh.folds.data[index];
    kiriVec2 from = kiriVec2_Add(found->mesh.origin, kiriMesh_Local(&found->mesh, line->from));
    kiriVec2 to = kiriVec2_Add(found->mesh.origin, kiriMesh_Local(&found->mesh, line->to));
    kiriFold fold = { { (float)from.x, (float)from.y }, { (float)to.x, (float)to.y }, line->stiffness,
                      line->restAngle, line->yieldMoment };
    *state = (kiriFoldState){ fold, 0.0, 0.0 };
    KIRI_EACH_INDEX(k, found->links.links) {
        const kiriLink* link = &found->links.links.data[k];
        if (link->fold == index + 1 && !kiriSheet_IsGone(found, link->i)) {
            const kiriFrameData* const frames[2] = { &found->frames.data[link->i], &found->frames.data[link->j] };
            const kiriPose ends[2] = { kiriPose_Of(frames[0]), kiriPose_Of(frames[1]) };
            const kiriPose* const poses[2] = { &ends[0], &ends[1] };
            bool hasOffsets = found->strainOffsets.strainOffsets.count > 0;
            double offset = hasOffsets ? found->strainOffsets.strainOffsets.data[k].strain[KIRI_BENDING] : 0.0;
            double angle = kiriFold_Angle(link, &found->settings.material, frames, poses, offset);
            state->length += link->width;
            state->angle += link->width / state->length * (angle - state->angle);
        }
    }
    return KIRI_OK;
}

kiriResult kiriSheet_SetFold(kiriWorld* world, kiriSheet sheet, int32_t index, float stiffness, float restAngle)
{
    KIRI_CHANGES(Sheet_SetFold, &sheet, &index, &stiffness, &restAngle);
    kiriSheetData* data = call->sheet;
    KIRI_CHECK_NUMBER(index, 0, data->mesh.folds.count - 1);
    kiriFoldLine* line = &data->mesh.folds.data[index];
    if (line->stiffness != stiffness || line->restAngle != restAngle) {
        line->stiffness = stiffness;
        line->restAngle = restAngle;
        kiriLink_SetFolds(data->links.links.data, data->links.links.count, index, stiffness, restAngle);
        kiriLink_SetFolds(data->links.next.data, data->links.next.count, index, stiffness, restAngle);
        kiriSolver_SetFold(data->solver, index, stiffness, restAngle);
        kiriSheet_WakeAll(data);
    }
    KIRI_RETURN(KIRI_OK);
}

/* ---- Tearing ---- */

kiriResult kiriSheet_SetTearing(kiriWorld* world, kiriSheet sheet, const kiriTearing* tearing)
{
    KIRI_CHANGES(Sheet_SetTearing, &sheet, tearing);
    kiriSheetData* data = call->sheet;
    KIRI_CHECK(tearing->toughness == 0.0f || data->settings.mechanics.model == KIRI_MODEL_LINKS,
               "the model is not KIRI_MODEL_LINKS");
    if (memcmp(tearing, &data->settings.tearing, sizeof(*tearing)) != 0) {
        data->settings.tearing = *tearing;
        kiriSheet_WakeAll(data);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetTearing(const kiriWorld* world, kiriSheet sheet, kiriTearing* tearing)
{
    KIRI_READS_OF(sheet, tearing);
    *tearing = found->settings.tearing;
    return KIRI_OK;
}

/* Finds whether a line, or a point, meets material. Returns false on out of memory. */
static bool MeetsMaterial(kiriSheetData* sheet, const float a[2], const float b[2], bool* meets)
{
    kiriVec2 from = kiriSheet_ToLocal(sheet, a), to = kiriSheet_ToLocal(sheet, b);
    kiriPointPlace place;
    bool isInside = kiriCut_Clip(&sheet->mesh, &from, &to), ok = true;
    kiriLatticePoint start = kiriMesh_Snap(&sheet->mesh, from), end = kiriMesh_Snap(&sheet->mesh, to);
    if (isInside && kiriLattice_IsSame(start, end)) {
        *meets = kiriPoint_Find(sheet, start, &place);
    } else if (isInside) {
        ok = kiriLine_Trace(&sheet->line, sheet->memory, &sheet->mesh, start, end);
        *meets = ok && sheet->line.parts.count > 0;
    }
    return ok;
}

kiriResult kiriSheet_SetTearLine(kiriWorld* world, kiriSheet sheet, const float* restPoints, int32_t count,
                                 float factor)
{
    KIRI_CHANGES(Sheet_SetTearLine, &sheet, restPoints, &count, &factor);
    kiriSheetData* data = call->sheet;
    const int32_t known = data->tearLines.count;
    bool ok = true, meets = false;
    for (int32_t k = kiriMin(1, count - 1); ok && !meets && k < count; ++k) {
        ok = MeetsMaterial(data, &restPoints[2 * (int64_t)kiriMax(k - 1, 0)], &restPoints[2 * (int64_t)k], &meets);
    }
    KIRI_CHECK(meets || !ok, "the line meets no material");
    KIRI_REQUIRE(ok && kiriArray_ReserveMore(data->memory, &data->tearLines, count), KIRI_ERROR_MEMORY, NULL);
    KIRI_FROM_TO(k, kiriMin(1, count - 1), count) {
        const float* from = &restPoints[2 * (int64_t)kiriMax(k - 1, 0)];
        kiriVec2 to = kiriSheet_ToLocal(data, &restPoints[2 * (int64_t)k]);
        kiriTearLine line = { kiriSheet_ToLocal(data, from), to, factor };
        if (kiriCut_Clip(&data->mesh, &line.from, &line.to)) {
            int32_t at = 0;
            while (at < known && memcmp(&data->tearLines.data[at], &line, 2 * sizeof(kiriVec2)) != 0) {
                ++at;
            }
            *(at < known ? &data->tearLines.data[at] : &KIRI_NEXT(data->tearLines)) = line;
        }
    }
    data->tears.areListed = false;
    kiriSheet_WakeAll(data);
    KIRI_RETURN(KIRI_OK);
}
