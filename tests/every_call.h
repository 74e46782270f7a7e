/* Every function of the header that takes a world and returns a result: a table for all tests that try each call. A new
   function is a row; test_callbacks.c compares the table with the header. */
#ifndef KIRI_EVERY_CALL_H
#define KIRI_EVERY_CALL_H

#include "tape.h"

/* Valid arguments of any call, for the world of a Stand. */
typedef struct Given {
    kiriSheet sheet, folded;
    kiriFrame frame; /* of the smaller piece */
    kiriPin pin, clamp;
    kiriCut cut; /* not ended */
    kiriBlade blade;
    kiriObstacle obstacle;
    kiriSeam seam;
    const float *point, *end, *points, *vector, *spin, *rotation, *inertia, *quad;
    float dt, size;
    int32_t index, one;
    const kiriSheetDef* def;
    const kiriPinDef* pinDef;
    const kiriObstacleDef* obstacleDef;
    const kiriSeamDef* seamDef;
    const kiriSheetSettings* settings;
    const kiriDebugDraw* draw;
    const kiriBudget* budget;
    const kiriWind* wind;
    const kiriTearing* tearing;
    const kiriFold* fold;
    const kiriContact* contacts;
    const kiriFrame* frames;     /* `frame` alone */
    const void *save, *snapshot; /* of the world before its cuts */
    int64_t saveBytes, snapshotBytes;
    kiriReplay* replay; /* at its end */
    uint32_t *id, *ids;
    int32_t* count;
    void *out, *more; /* room for any result */
    void* spare;      /* the same, and may be null */
} Given;

/* CHANGES(function, arguments...) takes the world without const, READS with it. */
#define EVERY_CALL(CHANGES, READS)                                                                                     \
    CHANGES(kiriWorld_Tick, world, g->dt, 2)                                                                           \
    CHANGES(kiriWorld_FinishCuts, world)                                                                               \
    CHANGES(kiriWorld_SetGravity, world, g->vector)                                                                    \
    CHANGES(kiriWorld_ShiftOrigin, world, g->vector)                                                                   \
    CHANGES(kiriWorld_SetBudget, world, g->budget)                                                                     \
    CHANGES(kiriWorld_Note, world, g->save, 4)                                                                         \
    CHANGES(kiriWorld_Replay, world, g->save, 4, g->replay)                                                            \
    CHANGES(kiriWorld_Load, world, g->save, g->saveBytes)                                                              \
    CHANGES(kiriWorld_Restore, world, g->snapshot, g->snapshotBytes)                                                   \
    READS(kiriWorld_Save, world, NULL, 0, g->out)                                                                      \
    READS(kiriWorld_Snapshot, world, NULL, 0, g->out)                                                                  \
    READS(kiriWorld_GetStateHash, world, g->out)                                                                       \
    READS(kiriWorld_GetSheets, world, g->ids, g->one, g->count)                                                        \
    READS(kiriWorld_GetEvents, world, g->out, g->count)                                                                \
    READS(kiriWorld_GetProfile, world, g->out)                                                                         \
    CHANGES(kiriCreateSheet, world, g->def, g->id)                                                                     \
    CHANGES(kiriCreateRectangle, world, 1.0f, 1.0f, 4, 4, NULL, g->id)                                                 \
    CHANGES(kiriCreateFoldedSheet, world, g->def, g->fold, 1, g->id)                                                   \
    CHANGES(kiriSheet_AddFold, world, g->folded, g->fold, g->count)                                                    \
    READS(kiriSheet_GetFold, world, g->folded, g->index, g->out)                                                       \
    CHANGES(kiriSheet_SetFold, world, g->folded, g->index, g->size, g->dt)                                             \
    READS(kiriSheet_GetSettings, world, g->sheet, g->out)                                                              \
    CHANGES(kiriSheet_SetSettings, world, g->sheet, g->settings)                                                       \
    READS(kiriSheet_GetMesh, world, g->sheet, g->out)                                                                  \
    READS(kiriSheet_GetDirty, world, g->sheet, 0, g->out)                                                              \
    READS(kiriSheet_CopyVertices, world, g->sheet, g->index, g->one, g->spare, 12, NULL, 0)                            \
    READS(kiriSheet_CopyPrevious, world, g->sheet, g->index, g->one, g->out, g->id)                                    \
    READS(kiriSheet_CopyIndices16, world, g->sheet, g->index, g->one, g->out)                                          \
    READS(kiriSheet_CopySources, world, g->sheet, g->index, g->one, g->out)                                            \
    READS(kiriSheet_CopySourceWeights, world, g->sheet, g->index, g->one, g->out)                                      \
    CHANGES(kiriSheet_GetSolid, world, g->sheet, g->size, g->out)                                                      \
    READS(kiriSheet_GetCollisionPoints, world, g->sheet, g->out, g->count)                                             \
    READS(kiriSheet_GetCounts, world, g->sheet, g->out)                                                                \
    READS(kiriSheet_GetTotals, world, g->sheet, g->out)                                                                \
    READS(kiriSheet_EstimateError, world, g->sheet, g->out)                                                            \
    READS(kiriSheet_IsAwake, world, g->sheet, g->out)                                                                  \
    CHANGES(kiriSheet_Wake, world, g->sheet)                                                                           \
    CHANGES(kiriSheet_Transform, world, g->sheet, g->rotation, g->vector)                                              \
    CHANGES(kiriSheet_SetVelocity, world, g->sheet, g->vector, g->spin)                                                \
    CHANGES(kiriFrame_SetPieceVelocity, world, g->frame, g->vector, g->spin)                                           \
    CHANGES(kiriSheet_SetUserData, world, g->sheet, UINT64_MAX)                                                        \
    READS(kiriSheet_GetUserData, world, g->sheet, g->out)                                                              \
    CHANGES(kiriPin_SetUserData, world, g->pin, UINT64_MAX)                                                            \
    READS(kiriPin_GetUserData, world, g->pin, g->out)                                                                  \
    CHANGES(kiriFrame_SetPieceUserData, world, g->frame, UINT64_MAX)                                                   \
    READS(kiriFrame_GetPieceUserData, world, g->frame, g->out)                                                         \
    READS(kiriSheet_Raycast, world, g->sheet, g->vector, g->spin, g->size, g->out)                                     \
    READS(kiriWorld_Raycast, world, g->vector, g->spin, g->size, g->id, g->out)                                        \
    READS(kiriSheet_GetPoint, world, g->sheet, g->point, g->out)                                                       \
    READS(kiriSheet_GetWeights, world, g->sheet, g->point, g->ids, g->out, NULL, g->one, g->count)                     \
    CHANGES(kiriSheet_GetPiece, world, g->sheet, g->index, g->out)                                                     \
    CHANGES(kiriSheet_GetPieceMesh, world, g->sheet, g->index, g->out)                                                 \
    CHANGES(kiriSheet_GetPieceFrames, world, g->sheet, g->index, g->out, g->count)                                     \
    READS(kiriFrame_GetPiece, world, g->frame, g->count)                                                               \
    CHANGES(kiriFrame_DetachPiece, world, g->frame, g->id)                                                             \
    CHANGES(kiriFrame_DestroyPiece, world, g->frame)                                                                   \
    CHANGES(kiriWorld_DetachPieces, world, g->frames, 1, g->ids)                                                       \
    CHANGES(kiriWorld_DestroyPieces, world, g->frames, 1)                                                              \
    CHANGES(kiriSheet_DropCrumbs, world, g->sheet, g->size, g->count)                                                  \
    CHANGES(kiriBeginCut, world, g->sheet, g->point, g->id)                                                            \
    CHANGES(kiriCut_Extend, world, g->cut, g->points, 200)                                                             \
    CHANGES(kiriCut_End, world, g->cut)                                                                                \
    CHANGES(kiriSheet_Cut, world, g->sheet, g->points, 200, g->id)                                                     \
    CHANGES(kiriSheet_Slice, world, g->sheet, g->quad, g->id)                                                          \
    CHANGES(kiriSheet_SetTearing, world, g->sheet, g->tearing)                                                         \
    CHANGES(kiriSheet_SetTearLine, world, g->sheet, g->points, 200, g->size)                                           \
    READS(kiriSheet_GetTearing, world, g->sheet, g->out)                                                               \
    CHANGES(kiriBeginBlade, world, g->sheet, g->id)                                                                    \
    CHANGES(kiriBlade_MoveEdge, world, g->blade, g->vector, g->spin)                                                   \
    CHANGES(kiriBlade_MoveRay, world, g->blade, g->vector, g->spin, g->size)                                           \
    CHANGES(kiriBlade_End, world, g->blade)                                                                            \
    READS(kiriSheet_GetFrames, world, g->sheet, g->ids, g->one, g->count)                                              \
    READS(kiriFrame_GetState, world, g->frame, g->out)                                                                 \
    CHANGES(kiriFrame_Hold, world, g->frame, g->vector, g->rotation)                                                   \
    READS(kiriFrame_GetReaction, world, g->frame, g->out, g->more)                                                     \
    CHANGES(kiriFrame_ApplyForce, world, g->frame, g->vector, g->spin)                                                 \
    CHANGES(kiriSheet_ApplyForce, world, g->sheet, g->point, g->vector, g->spin)                                       \
    CHANGES(kiriSheet_ApplyLineLoad, world, g->sheet, g->point, g->end, g->vector)                                     \
    CHANGES(kiriSheet_ApplyPressure, world, g->sheet, g->size)                                                         \
    CHANGES(kiriSheet_ApplyImpulse, world, g->sheet, g->point, g->vector)                                              \
    CHANGES(kiriSheet_SetWind, world, g->sheet, g->wind)                                                               \
    CHANGES(kiriCreatePin, world, g->sheet, g->pinDef, g->id)                                                          \
    CHANGES(kiriSheet_ClampLine, world, g->sheet, g->point, g->end, g->id)                                             \
    CHANGES(kiriSheet_HingeLine, world, g->sheet, g->point, g->end, g->id)                                             \
    CHANGES(kiriPin_SetTarget, world, g->pin, g->vector)                                                               \
    CHANGES(kiriPin_SetPose, world, g->clamp, g->vector, g->rotation)                                                  \
    CHANGES(kiriPin_SetBreakForce, world, g->pin, g->size)                                                             \
    READS(kiriPin_GetState, world, g->pin, g->out)                                                                     \
    READS(kiriPin_GetReaction, world, g->pin, g->out, g->more)                                                         \
    READS(kiriSheet_GetPins, world, g->sheet, g->ids, g->one, g->count)                                                \
    CHANGES(kiriDestroyPin, world, g->pin)                                                                             \
    CHANGES(kiriCreateSeam, world, g->seamDef, g->id)                                                                  \
    CHANGES(kiriSeam_SetHinge, world, g->seam, g->size, g->dt)                                                         \
    READS(kiriSeam_GetCount, world, g->seam, g->count)                                                                 \
    READS(kiriSeam_GetStitch, world, g->seam, g->index, g->out)                                                        \
    READS(kiriWorld_GetSeams, world, g->ids, g->one, g->count)                                                         \
    CHANGES(kiriDestroySeam, world, g->seam)                                                                           \
    CHANGES(kiriSheet_SetContacts, world, g->sheet, g->contacts, 12)                                                   \
    READS(kiriSheet_GetContactForces, world, g->sheet, g->out, g->count)                                               \
    CHANGES(kiriCreateObstacle, world, g->obstacleDef, g->id)                                                          \
    CHANGES(kiriObstacle_SetPose, world, g->obstacle, g->vector, g->rotation)                                          \
    CHANGES(kiriObstacle_SetVelocity, world, g->obstacle, g->vector, g->spin)                                          \
    CHANGES(kiriObstacle_SetSurfaceVelocity, world, g->obstacle, g->vector)                                            \
    CHANGES(kiriObstacle_SetMass, world, g->obstacle, g->size, g->inertia, g->vector)                                  \
    READS(kiriObstacle_GetState, world, g->obstacle, g->out)                                                           \
    CHANGES(kiriDestroyObstacle, world, g->obstacle)                                                                   \
    READS(kiriSheet_GetReach, world, g->sheet, g->dt, g->out, g->more)                                                 \
    READS(kiriWorld_DebugDraw, world, g->draw)                                                                         \
    CHANGES(kiriDestroySheet, world, g->sheet)

typedef struct EveryCall {
    const char* name;
    const char* arguments; /* as in the table, "world, g->sheet, g->vector" */
    kiriResult (*make)(kiriWorld* world, const Given* g);
    bool changes;
} EveryCall;

/* All rows, in the order of the table. */
extern const EveryCall everyCall[];
extern const int32_t everyCallCount;

/* The row of a function. */
const EveryCall* EveryCall_Find(const char* function);

/* A world with something of everything: a sheet of two pieces that hangs from eight pins, with a cut that goes on, and
   sewn to it a sheet with a fold. */
typedef struct Stand {
    Tape tape; /* first: it is the user of the hooks */
    Given given;
    kiriSheetDef def;
    kiriSheetSettings settings;
    kiriSeamDef seamDef;
    kiriReplay replay;
    uint32_t ids[16];
    int32_t count;
    double out[64];
} Stand;

/* record: null, or the hook that gets all calls. */
void Stand_Start(Stand* stand, kiriRecordFn* record);

/* Starts a stand of zeros with a def by Tape_Def. */
void Stand_StartBy(Stand* stand, const kiriWorldDef* def);
void Stand_Stop(Stand* stand);

#define START_STAND(name)                                                                                              \
    SCOPED(Stand, name, Stand_Stop);                                                                                   \
    Stand_Start(&name, NULL)

static inline kiriResult Stand_Make(Stand* stand, const EveryCall* call)
{
    return call->make(stand->tape.host.world, &stand->given);
}

#endif
