/* Every function of the header that takes a world and returns a result, with no arguments to speak of: a list for
   tests. CHANGES takes the world without const, READS with it. test_callbacks.c compares the list with the header. */
#ifndef KIRI_EVERY_CALL_H
#define KIRI_EVERY_CALL_H

#define EVERY_CALL(CHANGES, READS)                                                                                     \
    CHANGES(kiriWorld_Tick, world, 0, 0)                                                                               \
    CHANGES(kiriWorld_SetGravity, world, NULL)                                                                         \
    CHANGES(kiriWorld_ShiftOrigin, world, NULL)                                                                        \
    CHANGES(kiriWorld_SetBudget, world, NULL)                                                                          \
    READS(kiriWorld_GetStateHash, world, NULL)                                                                         \
    READS(kiriWorld_GetSheets, world, NULL, 0, NULL)                                                                   \
    CHANGES(kiriWorld_Note, world, NULL, 0)                                                                            \
    CHANGES(kiriWorld_Replay, world, NULL, 0, NULL)                                                                    \
    READS(kiriWorld_Save, world, NULL, 0, NULL)                                                                        \
    CHANGES(kiriWorld_Load, world, NULL, 0)                                                                            \
    CHANGES(kiriWorld_FinishCuts, world)                                                                               \
    READS(kiriWorld_Snapshot, world, NULL, 0, NULL)                                                                    \
    CHANGES(kiriWorld_Restore, world, NULL, 0)                                                                         \
    READS(kiriWorld_GetEvents, world, NULL, NULL)                                                                      \
    READS(kiriWorld_GetProfile, world, NULL)                                                                           \
    CHANGES(kiriCreateSheet, world, NULL, NULL)                                                                        \
    CHANGES(kiriDestroySheet, world, 0)                                                                                \
    CHANGES(kiriCreateFoldedSheet, world, NULL, NULL, 0, NULL)                                                         \
    CHANGES(kiriSheet_AddFold, world, 0, NULL, NULL)                                                                   \
    READS(kiriSheet_GetFold, world, 0, 0, NULL)                                                                        \
    CHANGES(kiriSheet_SetFold, world, 0, 0, 0, 0)                                                                      \
    CHANGES(kiriCreateRectangle, world, 0, 0, 0, 0, NULL, NULL)                                                        \
    READS(kiriSheet_GetSettings, world, 0, NULL)                                                                       \
    CHANGES(kiriSheet_SetSettings, world, 0, NULL)                                                                     \
    READS(kiriSheet_GetMesh, world, 0, NULL)                                                                           \
    READS(kiriSheet_GetDirty, world, 0, 0, NULL)                                                                       \
    READS(kiriSheet_CopyVertices, world, 0, 0, 0, NULL, 0, NULL, 0)                                                    \
    READS(kiriSheet_CopyPrevious, world, 0, 0, 0, NULL, NULL)                                                          \
    READS(kiriSheet_CopyIndices16, world, 0, 0, 0, NULL)                                                               \
    READS(kiriSheet_CopySources, world, 0, 0, 0, NULL)                                                                 \
    READS(kiriSheet_CopySourceWeights, world, 0, 0, 0, NULL)                                                           \
    CHANGES(kiriSheet_GetSolid, world, 0, 0, NULL)                                                                     \
    READS(kiriSheet_GetCollisionPoints, world, 0, NULL, NULL)                                                          \
    READS(kiriSheet_GetCounts, world, 0, NULL)                                                                         \
    READS(kiriSheet_GetTotals, world, 0, NULL)                                                                         \
    READS(kiriSheet_EstimateError, world, 0, NULL)                                                                     \
    READS(kiriSheet_IsAwake, world, 0, NULL)                                                                           \
    CHANGES(kiriSheet_Wake, world, 0)                                                                                  \
    CHANGES(kiriSheet_Transform, world, 0, NULL, NULL)                                                                 \
    CHANGES(kiriSheet_SetVelocity, world, 0, NULL, NULL)                                                               \
    CHANGES(kiriFrame_SetPieceVelocity, world, 0, NULL, NULL)                                                          \
    CHANGES(kiriSheet_SetUserData, world, 0, 0)                                                                        \
    READS(kiriSheet_GetUserData, world, 0, NULL)                                                                       \
    CHANGES(kiriPin_SetUserData, world, 0, 0)                                                                          \
    READS(kiriPin_GetUserData, world, 0, NULL)                                                                         \
    CHANGES(kiriFrame_SetPieceUserData, world, 0, 0)                                                                   \
    READS(kiriFrame_GetPieceUserData, world, 0, NULL)                                                                  \
    READS(kiriSheet_Raycast, world, 0, NULL, NULL, 0, NULL)                                                            \
    READS(kiriWorld_Raycast, world, NULL, NULL, 0, NULL, NULL)                                                         \
    READS(kiriSheet_GetPoint, world, 0, NULL, NULL)                                                                    \
    READS(kiriSheet_GetWeights, world, 0, NULL, NULL, NULL, NULL, 0, NULL)                                             \
    CHANGES(kiriSheet_GetPiece, world, 0, 0, NULL)                                                                     \
    CHANGES(kiriSheet_GetPieceMesh, world, 0, 0, NULL)                                                                 \
    CHANGES(kiriSheet_GetPieceFrames, world, 0, 0, NULL, NULL)                                                         \
    READS(kiriFrame_GetPiece, world, 0, NULL)                                                                          \
    CHANGES(kiriFrame_DetachPiece, world, 0, NULL)                                                                     \
    CHANGES(kiriFrame_DestroyPiece, world, 0)                                                                          \
    CHANGES(kiriWorld_DetachPieces, world, NULL, 0, NULL)                                                              \
    CHANGES(kiriWorld_DestroyPieces, world, NULL, 0)                                                                   \
    CHANGES(kiriSheet_DropCrumbs, world, 0, 0, NULL)                                                                   \
    CHANGES(kiriBeginCut, world, 0, NULL, NULL)                                                                        \
    CHANGES(kiriCut_Extend, world, 0, NULL, 0)                                                                         \
    CHANGES(kiriCut_End, world, 0)                                                                                     \
    CHANGES(kiriSheet_Slice, world, 0, NULL, NULL)                                                                     \
    CHANGES(kiriSheet_SetTearing, world, 0, NULL)                                                                      \
    READS(kiriSheet_GetTearing, world, 0, NULL)                                                                        \
    CHANGES(kiriBeginBlade, world, 0, NULL)                                                                            \
    CHANGES(kiriBlade_MoveEdge, world, 0, NULL, NULL)                                                                  \
    CHANGES(kiriBlade_MoveRay, world, 0, NULL, NULL, 0)                                                                \
    CHANGES(kiriBlade_End, world, 0)                                                                                   \
    READS(kiriSheet_GetFrames, world, 0, NULL, 0, NULL)                                                                \
    READS(kiriFrame_GetState, world, 0, NULL)                                                                          \
    CHANGES(kiriFrame_Hold, world, 0, NULL, NULL)                                                                      \
    READS(kiriFrame_GetReaction, world, 0, NULL, NULL)                                                                 \
    CHANGES(kiriFrame_ApplyForce, world, 0, NULL, NULL)                                                                \
    CHANGES(kiriSheet_ApplyForce, world, 0, NULL, NULL, NULL)                                                          \
    CHANGES(kiriSheet_ApplyLineLoad, world, 0, NULL, NULL, NULL)                                                       \
    CHANGES(kiriSheet_ApplyPressure, world, 0, 0)                                                                      \
    CHANGES(kiriSheet_ApplyImpulse, world, 0, NULL, NULL)                                                              \
    CHANGES(kiriSheet_SetWind, world, 0, NULL)                                                                         \
    CHANGES(kiriCreatePin, world, 0, NULL, NULL)                                                                       \
    CHANGES(kiriSheet_ClampLine, world, 0, NULL, NULL, NULL)                                                           \
    CHANGES(kiriSheet_HingeLine, world, 0, NULL, NULL, NULL)                                                           \
    CHANGES(kiriPin_SetTarget, world, 0, NULL)                                                                         \
    CHANGES(kiriPin_SetPose, world, 0, NULL, NULL)                                                                     \
    CHANGES(kiriPin_SetBreakForce, world, 0, 0)                                                                        \
    READS(kiriPin_GetState, world, 0, NULL)                                                                            \
    READS(kiriPin_GetReaction, world, 0, NULL, NULL)                                                                   \
    READS(kiriSheet_GetPins, world, 0, NULL, 0, NULL)                                                                  \
    CHANGES(kiriDestroyPin, world, 0)                                                                                  \
    READS(kiriSeam_GetCount, world, 0, NULL)                                                                           \
    CHANGES(kiriSeam_SetHinge, world, 0, 0, 0)                                                                         \
    READS(kiriWorld_GetSeams, world, NULL, 0, NULL)                                                                    \
    READS(kiriSeam_GetStitch, world, 0, 0, NULL)                                                                       \
    CHANGES(kiriDestroySeam, world, 0)                                                                                 \
    CHANGES(kiriCreateSeam, world, NULL, NULL)                                                                         \
    CHANGES(kiriSheet_SetContacts, world, 0, NULL, 0)                                                                  \
    READS(kiriSheet_GetContactForces, world, 0, NULL, NULL)                                                            \
    CHANGES(kiriCreateObstacle, world, NULL, NULL)                                                                     \
    CHANGES(kiriDestroyObstacle, world, 0)                                                                             \
    CHANGES(kiriObstacle_SetPose, world, 0, NULL, NULL)                                                                \
    CHANGES(kiriObstacle_SetVelocity, world, 0, NULL, NULL)                                                            \
    CHANGES(kiriObstacle_SetSurfaceVelocity, world, 0, NULL)                                                           \
    CHANGES(kiriObstacle_SetMass, world, 0, 0, NULL, NULL)                                                             \
    READS(kiriObstacle_GetState, world, 0, NULL)                                                                       \
    READS(kiriSheet_GetReach, world, 0, 0, NULL, NULL)                                                                 \
    READS(kiriWorld_DebugDraw, world, NULL)

#endif
