/* Sequences of public calls, with whatever arguments. */
#include "fuzz_world.h"

#define IDS(Name, member)                                                                                              \
    static FuzzIds* Name(Fuzz* fuzz)                                                                                   \
    {                                                                                                                  \
        return &fuzz->member;                                                                                          \
    }
IDS(Sheets, sheets)
IDS(Pins, pins)
IDS(Cuts, cuts)
IDS(Obstacles, obstacles)
IDS(Blades, blades)
IDS(Seams, seams)

/* The pointer, or null where the bit says so. */
#define OR_NULL(bit, pointer) ((act->nulls >> (bit)&1u) != 0 ? NULL : (pointer))

static void Say(FuzzAct* act, const void* data, size_t bytes)
{
    act->said.hash = Look_Bytes(act->said.hash, data, bytes);
}

/* A call that fills a struct: what is in it counts where the call went well. */
#define SAY(result, state)                                                                                             \
    do {                                                                                                               \
        if ((result) >= 0) {                                                                                           \
            Say(act, &(state), sizeof(state));                                                                         \
        }                                                                                                              \
    } while (0)

#define CALL(name) static kiriResult Call##name(kiriWorld* world, FuzzAct* act)

/* A call of which nothing is said but its result. */
#define RETURN(name, result)                                                                                           \
    CALL(name)                                                                                                         \
    {                                                                                                                  \
        return result;                                                                                                 \
    }

/* ---- World ---- */

CALL(Tick)
{
    static const float steps[] = { 1.0f / 60.0f, 0.01f, 1e-6f, 10.0f, 0.1f, 1.0f / 240.0f, 1.0f, 0.0f };
    return kiriWorld_Tick(world, (uint32_t)act->numbers[0] < 8 ? steps[act->numbers[0]] : act->scalar, act->numbers[1]);
}

RETURN(PlainTick, kiriWorld_Tick(world, 1.0f / 60.0f, 1))
RETURN(SetGravity, kiriWorld_SetGravity(world, OR_NULL(0, act->vectors[0])))
RETURN(SetBudget, kiriWorld_SetBudget(world, OR_NULL(0, &act->def.budget)))

CALL(GetEvents)
{
    const kiriEvent* events;
    kiriResult result = kiriWorld_GetEvents(world, OR_NULL(0, &events), OR_NULL(1, &act->said.count));
    if (result == KIRI_OK) {
        Say(act, events, sizeof(kiriEvent) * (size_t)act->said.count);
    }
    return result;
}

/* ---- Sheets ---- */

RETURN(CreateSheet, kiriCreateSheet(world, OR_NULL(0, &act->def.sheet), OR_NULL(1, &act->said.id)))
RETURN(DestroySheet, kiriDestroySheet(world, act->sheet))
RETURN(SetSettings, kiriSheet_SetSettings(world, act->sheet, OR_NULL(0, &act->def.settings)))

CALL(GetDirty)
{
    kiriDirty dirty = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, 0 };
    kiriResult result = kiriSheet_GetDirty(world, act->sheet, (uint32_t)act->numbers[0], OR_NULL(0, &dirty));
    SAY(result, dirty);
    return result;
}

CALL(CopyVertices)
{
    float room[3 * 64] = { 0.0f }, normals[3 * 64] = { 0.0f };
    int32_t count = act->numbers[1] < 48 ? act->numbers[1] : 48, stride = act->numbers[2] < 16 ? act->numbers[2] : 16;
    kiriResult result = kiriSheet_CopyVertices(world, act->sheet, act->numbers[0], count, OR_NULL(0, room), stride,
                                               OR_NULL(1, normals), 12);
    SAY(result, room);
    SAY(result, normals);
    return result;
}

CALL(CopyIndices16)
{
    uint16_t room[3 * 64] = { 0 };
    int32_t count = act->numbers[1] < 64 ? act->numbers[1] : 64;
    kiriResult result = kiriSheet_CopyIndices16(world, act->sheet, act->numbers[0], count, OR_NULL(0, room));
    SAY(result, room);
    return result;
}

CALL(GetSolid)
{
    kiriSolid solid;
    kiriResult result = kiriSheet_GetSolid(world, act->sheet, act->scalar, OR_NULL(0, &solid));
    if (result == KIRI_OK) {
        Say(act, solid.positions, 12 * (size_t)solid.vertexCount);
        Say(act, solid.normals, 12 * (size_t)solid.vertexCount);
        Say(act, solid.indices, 12 * (size_t)solid.triangleCount);
        Say(act, solid.sources, 4 * (size_t)solid.vertexCount);
    }
    return result;
}

CALL(EstimateError)
{
    double error = 0.0;
    kiriResult result = kiriSheet_EstimateError(world, act->sheet, OR_NULL(0, &error));
    SAY(result, error);
    FUZZ_CHECK(result < 0 || (error >= 0.0 && error <= 1.0), "an estimate of %g", error);
    return result;
}

RETURN(Wake, kiriSheet_Wake(world, act->sheet))
RETURN(Transform, kiriSheet_Transform(world, act->sheet, OR_NULL(0, act->rotation), OR_NULL(1, act->vectors[0])))
RETURN(SetVelocity, kiriSheet_SetVelocity(world, act->sheet, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1])))
RETURN(SetPieceVelocity,
       kiriFrame_SetPieceVelocity(world, act->frame, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1])))

CALL(UserData)
{
    uint64_t data = 0;
    kiriResult result = kiriSheet_SetUserData(world, act->sheet, 7);
    result = result < 0 ? result : kiriFrame_SetPieceUserData(world, act->frame, 8);
    result = result < 0 ? result : kiriPin_SetUserData(world, act->pin, 9);
    result = result < 0 ? result : kiriFrame_GetPieceUserData(world, act->frame, OR_NULL(0, &data));
    SAY(result, data);
    return result;
}

CALL(Raycast)
{
    kiriHit hit = { .triangle = -2 };
    kiriResult result = kiriSheet_Raycast(world, act->sheet, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1]),
                                          act->scalar, OR_NULL(2, &hit));
    SAY(result, hit);
    FUZZ_CHECK(result < 0 || hit.triangle >= -1, "a ray says triangle %d", (int)hit.triangle);
    return result;
}

CALL(RaycastAll)
{
    kiriHit hit = { .triangle = -2 };
    return kiriWorld_Raycast(world, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1]), act->scalar,
                             OR_NULL(2, &act->said.ids[0]), OR_NULL(3, &hit));
}

CALL(GetPoint)
{
    kiriPointState state = { .frame = 0 };
    kiriResult result = kiriSheet_GetPoint(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, &state));
    SAY(result, state);
    FUZZ_CHECK(AllFinite(state.position, 3) && AllFinite(state.normal, 3) && AllFinite(state.velocity, 3),
               "a point is not finite");
    return result;
}

CALL(GetWeights)
{
    enum { MOST = 512 };
    static kiriFrame frames[MOST];
    static float weights[MOST], gradients[2 * MOST];
    double sum = 0.0;
    int32_t capacity = act->numbers[0] == 0 ? MOST : act->numbers[0] < MOST ? act->numbers[0] : MOST;
    kiriResult result =
        kiriSheet_GetWeights(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, frames), OR_NULL(2, weights),
                             OR_NULL(3, gradients), capacity, OR_NULL(4, &act->said.count));
    if (result == KIRI_OK && capacity >= act->said.count) {
        for (int32_t i = 0; i < act->said.count; ++i) {
            FUZZ_CHECK(weights[i] >= 0.0f, "weight %d is %g", (int)i, weights[i]);
            sum += weights[i];
        }
        FUZZ_CHECK(fabs(sum - 1.0) < 1e-6, "weights sum to %.9g", sum);
        Say(act, weights, sizeof(float) * (size_t)act->said.count);
        if ((act->nulls & 8u) == 0) {
            FUZZ_CHECK(AllFinite(gradients, 2 * act->said.count), "a gradient is not finite");
            Say(act, gradients, 2 * sizeof(float) * (size_t)act->said.count);
        }
    }
    return result;
}

CALL(GetReach)
{
    float box[2][3] = { { 0.0f } };
    kiriResult result = kiriSheet_GetReach(world, act->sheet, act->scalar, OR_NULL(0, box[0]), OR_NULL(1, box[1]));
    SAY(result, box);
    return result;
}

/* ---- Pieces ---- */

CALL(GetPiece)
{
    kiriPieceState state;
    kiriPieceMesh mesh;
    const kiriFrame* frames;
    memset(&state, 0, sizeof(state));
    kiriResult result = kiriSheet_GetPiece(world, act->sheet, act->numbers[0], OR_NULL(0, &state));
    SAY(result, state);
    result = result < 0 ? result : kiriSheet_GetPieceMesh(world, act->sheet, act->numbers[0], OR_NULL(1, &mesh));
    if (result == KIRI_OK) {
        FUZZ_CHECK(mesh.triangleCount == state.triangles && mesh.vertexCount == state.vertices,
                   "a piece has %d and %d triangles", (int)mesh.triangleCount, (int)state.triangles);
        Say(act, mesh.indices, 12 * (size_t)mesh.triangleCount);
    }
    return result < 0 ? result
                      : kiriSheet_GetPieceFrames(world, act->sheet, act->numbers[0], OR_NULL(2, &frames),
                                                 OR_NULL(3, &act->said.count));
}

RETURN(DetachPiece, kiriFrame_DetachPiece(world, act->frame, OR_NULL(0, &act->said.id)))
RETURN(DestroyPiece, kiriFrame_DestroyPiece(world, act->frame))
RETURN(DetachPieces, kiriWorld_DetachPieces(world, OR_NULL(0, act->frames), act->frameCount, OR_NULL(1, act->said.ids)))
RETURN(DestroyPieces, kiriWorld_DestroyPieces(world, OR_NULL(0, act->frames), act->frameCount))
RETURN(DropCrumbs, kiriSheet_DropCrumbs(world, act->sheet, act->scalar, OR_NULL(0, &act->said.count)))

/* ---- Cuts ---- */

RETURN(BeginCut, kiriBeginCut(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, &act->said.id)))
RETURN(Extend, kiriCut_Extend(world, act->cut, OR_NULL(0, act->points), act->pointCount))
RETURN(EndCut, kiriCut_End(world, act->cut))

CALL(WholeCut)
{
    kiriResult result = kiriBeginCut(world, act->sheet, act->rests[0], &act->said.id);
    kiriCut cut = act->said.id;
    result = result < 0 || act->pointCount < 1 ? result : kiriCut_Extend(world, cut, act->points, act->pointCount);
    return result == KIRI_ERROR_MEMORY || cut == 0 ? result : kiriCut_End(world, cut);
}

RETURN(Cut, kiriSheet_Cut(world, act->sheet, OR_NULL(0, act->points), act->pointCount, OR_NULL(1, &act->said.id)))

CALL(Slice)
{
    float blade[12];
    memcpy(blade, act->vectors, sizeof(blade));
    return kiriSheet_Slice(world, act->sheet, OR_NULL(0, blade), OR_NULL(1, &act->said.id));
}

RETURN(BeginBlade, kiriBeginBlade(world, act->sheet, OR_NULL(0, &act->said.id)))
RETURN(MoveEdge, kiriBlade_MoveEdge(world, act->blade, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1])))
RETURN(MoveRay,
       kiriBlade_MoveRay(world, act->blade, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1]), act->scalar))
RETURN(EndBlade, kiriBlade_End(world, act->blade))

/* ---- Frames and loads ---- */

RETURN(Hold, kiriFrame_Hold(world, act->frame, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->rotation)))
RETURN(Release, kiriFrame_Hold(world, act->frame, NULL, NULL))
RETURN(ApplyToFrame, kiriFrame_ApplyForce(world, act->frame, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1])))
RETURN(ApplyToSheet, kiriSheet_ApplyForce(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, act->vectors[0]),
                                          OR_NULL(2, act->vectors[1])))
RETURN(ApplyLineLoad, kiriSheet_ApplyLineLoad(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, act->rests[1]),
                                              OR_NULL(2, act->vectors[0])))
RETURN(ApplyPressure, kiriSheet_ApplyPressure(world, act->sheet, act->scalar))
RETURN(ApplyImpulse, kiriSheet_ApplyImpulse(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, act->vectors[0])))
RETURN(SetWind, kiriSheet_SetWind(world, act->sheet, OR_NULL(0, &act->def.wind)))
RETURN(SetTearLine, kiriSheet_SetTearLine(world, act->sheet, OR_NULL(0, act->points), act->pointCount, act->scalar))
RETURN(SetTearing, kiriSheet_SetTearing(world, act->sheet, OR_NULL(0, &act->def.tearing)))

/* ---- Pins and contacts ---- */

RETURN(CreatePin, kiriCreatePin(world, act->sheet, OR_NULL(0, &act->def.pin), OR_NULL(1, &act->said.id)))
RETURN(ClampLine, kiriSheet_ClampLine(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, act->rests[1]),
                                      OR_NULL(2, &act->said.id)))
RETURN(HingeLine, kiriSheet_HingeLine(world, act->sheet, OR_NULL(0, act->rests[0]), OR_NULL(1, act->rests[1]),
                                      OR_NULL(2, &act->said.id)))
RETURN(SetTarget, kiriPin_SetTarget(world, act->pin, OR_NULL(0, act->vectors[0])))
RETURN(SetPose, kiriPin_SetPose(world, act->pin, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->rotation)))
RETURN(SetBreakForce, kiriPin_SetBreakForce(world, act->pin, act->scalar))
RETURN(DestroyPin, kiriDestroyPin(world, act->pin))
RETURN(SetContacts, kiriSheet_SetContacts(world, act->sheet, OR_NULL(0, act->def.contacts), act->numbers[0]))

CALL(GetContactForces)
{
    const kiriContactForce* forces;
    kiriResult result =
        kiriSheet_GetContactForces(world, act->sheet, OR_NULL(0, &forces), OR_NULL(1, &act->said.count));
    if (result == KIRI_OK) {
        Say(act, forces, sizeof(kiriContactForce) * (size_t)act->said.count);
    }
    return result;
}

/* ---- Obstacles ---- */

RETURN(CreateObstacle, kiriCreateObstacle(world, OR_NULL(0, &act->def.obstacle), OR_NULL(1, &act->said.id)))
RETURN(DestroyObstacle, kiriDestroyObstacle(world, act->obstacle))
RETURN(SetObstaclePose,
       kiriObstacle_SetPose(world, act->obstacle, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->rotation)))
RETURN(SetObstacleVelocity,
       kiriObstacle_SetVelocity(world, act->obstacle, OR_NULL(0, act->vectors[0]), OR_NULL(1, act->vectors[1])))
RETURN(SetSurfaceVelocity, kiriObstacle_SetSurfaceVelocity(world, act->obstacle, OR_NULL(0, act->vectors[0])))

CALL(SetMass)
{
    float inertia[6] = { act->vectors[0][0], act->vectors[0][1], act->vectors[0][2], 0.0f, 0.0f, act->vectors[1][0] };
    return kiriObstacle_SetMass(world, act->obstacle, act->scalar, OR_NULL(0, inertia), OR_NULL(1, act->vectors[2]));
}

CALL(GetObstacle)
{
    kiriObstacleState state;
    memset(&state, 0, sizeof(state));
    kiriResult result = kiriObstacle_GetState(world, act->obstacle, OR_NULL(0, &state));
    SAY(result, state);
    return result;
}

/* ---- Folds and seams ---- */

RETURN(CreateFoldedSheet, kiriCreateFoldedSheet(world, OR_NULL(0, &act->def.sheet), OR_NULL(1, act->folds),
                                                act->foldCount, OR_NULL(2, &act->said.id)))
RETURN(AddFold, kiriSheet_AddFold(world, act->sheet, OR_NULL(0, &act->folds[0]), OR_NULL(1, &act->said.count)))
RETURN(SetFold, kiriSheet_SetFold(world, act->sheet, act->numbers[0], act->scalar, act->vectors[0][0]))

CALL(GetFold)
{
    kiriFoldState state;
    memset(&state, 0, sizeof(state));
    kiriResult result = kiriSheet_GetFold(world, act->sheet, act->numbers[0], OR_NULL(0, &state));
    SAY(result, state);
    FUZZ_CHECK(result < 0 || (isfinite(state.angle) && state.length >= 0.0), "a fold has %g rad", state.angle);
    return result;
}

RETURN(CreateSeam, kiriCreateSeam(world, OR_NULL(0, &act->def.seam), OR_NULL(1, &act->said.id)))
RETURN(DestroySeam, kiriDestroySeam(world, act->seam))
RETURN(SetHinge, kiriSeam_SetHinge(world, act->seam, act->scalar, act->vectors[0][0]))

CALL(GetStitch)
{
    kiriStitch stitch;
    memset(&stitch, 0, sizeof(stitch));
    kiriResult result = kiriSeam_GetStitch(world, act->seam, act->numbers[0], OR_NULL(0, &stitch));
    SAY(result, stitch);
    FUZZ_CHECK(result < 0 || (AllFinite(stitch.position, 3) && AllFinite(stitch.force, 3) && stitch.gap >= 0.0f),
               "a stitch is %g apart", stitch.gap);
    return result;
}

enum { ADDS = FUZZ_ADDS, READS = FUZZ_READS, DESTROYS = FUZZ_DESTROYS, TICKS = FUZZ_TICKS, STIRS = FUZZ_STIRS };

const FuzzCall fuzzCalls[] = {
    { "Tick", CallPlainTick, "", TICKS, NULL },
    { "Tick", CallTick, "nnx", TICKS, NULL },
    { "Tick", CallPlainTick, "", TICKS, NULL },
    { "Tick", CallPlainTick, "", TICKS, NULL },
    { "SetGravity", CallSetGravity, "V", 0, NULL },
    { "SetBudget", CallSetBudget, "B", 0, NULL },
    { "GetEvents", CallGetEvents, "", READS, NULL },
    { "CreateSheet", CallCreateSheet, "S", FUZZ_MAKES_SHEET | ADDS, Sheets },
    { "DestroySheet", CallDestroySheet, "s", DESTROYS, NULL },
    { "SetSettings", CallSetSettings, "sT", STIRS, NULL },
    { "GetDirty", CallGetDirty, "sn", READS, NULL },
    { "CopyVertices", CallCopyVertices, "snnn", READS, NULL },
    { "CopyIndices16", CallCopyIndices16, "snn", READS, NULL },
    { "GetSolid", CallGetSolid, "sx", 0, NULL },
    { "EstimateError", CallEstimateError, "s", READS, NULL },
    { "Wake", CallWake, "s", 0, NULL },
    { "Transform", CallTransform, "sRV", STIRS, NULL },
    { "SetVelocity", CallSetVelocity, "sVV", 0, NULL },
    { "SetPieceVelocity", CallSetPieceVelocity, "fVV", 0, NULL },
    { "UserData", CallUserData, "sfp", READS, NULL },
    { "Raycast", CallRaycast, "svVx", READS, NULL },
    { "Raycast", CallRaycastAll, "vVx", READS, NULL },
    { "GetPoint", CallGetPoint, "sr", READS, NULL },
    { "GetWeights", CallGetWeights, "srn", READS, NULL },
    { "GetReach", CallGetReach, "sx", READS, NULL },
    { "GetPiece", CallGetPiece, "sn", 0, NULL },
    { "DetachPiece", CallDetachPiece, "f", FUZZ_MAKES_SHEET, Sheets },
    { "DestroyPiece", CallDestroyPiece, "f", DESTROYS, NULL },
    { "DetachPieces", CallDetachPieces, "F", FUZZ_MAKES_SHEET, NULL },
    { "DestroyPieces", CallDestroyPieces, "F", DESTROYS, NULL },
    { "DropCrumbs", CallDropCrumbs, "sx", DESTROYS, NULL },
    { "BeginCut", CallBeginCut, "sr", 0, Cuts },
    { "Extend", CallExtend, "cP", 0, NULL },
    { "Extend", CallExtend, "cP", 0, NULL },
    { "EndCut", CallEndCut, "c", 0, NULL },
    { "WholeCut", CallWholeCut, "srP", FUZZ_SEVERAL, Cuts },
    { "WholeCut", CallWholeCut, "srP", FUZZ_SEVERAL, Cuts },
    { "WholeCut", CallWholeCut, "srP", FUZZ_SEVERAL, Cuts },
    { "Cut", CallCut, "sP", 0, Cuts },
    { "Slice", CallSlice, "svvvv", 0, Cuts },
    { "BeginBlade", CallBeginBlade, "s", ADDS, Blades },
    { "MoveEdge", CallMoveEdge, "bvv", 0, NULL },
    { "MoveEdge", CallMoveEdge, "bvv", 0, NULL },
    { "MoveRay", CallMoveRay, "bvVx", 0, NULL },
    { "EndBlade", CallEndBlade, "b", 0, NULL },
    { "Hold", CallHold, "fvR", STIRS, NULL },
    { "Hold", CallRelease, "f", 0, NULL },
    { "ApplyForce", CallApplyToFrame, "fVV", STIRS, NULL },
    { "ApplyForce", CallApplyToSheet, "srVV", STIRS, NULL },
    { "ApplyLineLoad", CallApplyLineLoad, "srrV", STIRS, NULL },
    { "ApplyPressure", CallApplyPressure, "sx", STIRS, NULL },
    { "ApplyImpulse", CallApplyImpulse, "srV", 0, NULL },
    { "SetWind", CallSetWind, "sW", STIRS, NULL },
    { "SetTearing", CallSetTearing, "sA", STIRS, NULL },
    { "SetTearLine", CallSetTearLine, "sPx", STIRS, NULL },
    { "CreatePin", CallCreatePin, "sI", ADDS | STIRS, Pins },
    { "ClampLine", CallClampLine, "srr", ADDS, Pins },
    { "HingeLine", CallHingeLine, "srr", ADDS, Pins },
    { "SetTarget", CallSetTarget, "pv", STIRS, NULL },
    { "SetPose", CallSetPose, "pvR", STIRS, NULL },
    { "SetBreakForce", CallSetBreakForce, "px", 0, NULL },
    { "DestroyPin", CallDestroyPin, "p", 0, NULL },
    { "SetContacts", CallSetContacts, "snC", STIRS, NULL },
    { "GetContactForces", CallGetContactForces, "s", READS, NULL },
    { "CreateObstacle", CallCreateObstacle, "O", ADDS | STIRS, Obstacles },
    { "DestroyObstacle", CallDestroyObstacle, "o", 0, NULL },
    { "SetPose", CallSetObstaclePose, "ovR", 0, NULL },
    { "SetVelocity", CallSetObstacleVelocity, "oVV", 0, NULL },
    { "SetSurfaceVelocity", CallSetSurfaceVelocity, "oV", 0, NULL },
    { "SetMass", CallSetMass, "oVVVx", 0, NULL },
    { "GetState", CallGetObstacle, "o", READS, NULL },
    { "CreateSheet", CallCreateFoldedSheet, "SL", FUZZ_MAKES_SHEET | ADDS | STIRS, Sheets },
    { "AddFold", CallAddFold, "sL", STIRS, NULL },
    { "AddFold", CallAddFold, "sL", STIRS, NULL },
    { "SetFold", CallSetFold, "snVx", STIRS, NULL },
    { "GetFold", CallGetFold, "sn", READS, NULL },
    { "CreateSeam", CallCreateSeam, "sE", ADDS | STIRS, Seams },
    { "CreateSeam", CallCreateSeam, "sE", ADDS | STIRS, Seams },
    { "DestroySeam", CallDestroySeam, "m", 0, NULL },
    { "SetHinge", CallSetHinge, "mVx", STIRS, NULL },
    { "GetStitch", CallGetStitch, "mn", READS, NULL },
};

const int32_t fuzzCallCount = sizeof(fuzzCalls) / sizeof(fuzzCalls[0]);

/* Bounds what a run takes. */
enum { MOST_CALLS = 120, MOST_TICKS = 40, MOST_TRIANGLES = 2500 };

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    Fuzz fuzz;
    Fuzz_Start(&fuzz, data, size);
    for (int32_t i = 0; i < MOST_CALLS && fuzz.ticks < MOST_TICKS && !fuzz.isOver && !FuzzBytes_AtEnd(&fuzz.bytes);
         ++i) {
        const FuzzCall* call = &fuzzCalls[FuzzBytes_Below(&fuzz.bytes, fuzzCallCount)];
        FuzzAct act;
        FuzzAct_Read(&act, &fuzz, call->needs);
        Fuzz_Make(&fuzz, call, &act);
        fuzz.isOver = Fuzz_CountTriangles(&fuzz) > MOST_TRIANGLES;
    }
    Fuzz_Stop(&fuzz);
    return 0;
}
