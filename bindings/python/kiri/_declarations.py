"""Made from kiri.h by `make bindings`."""

VERSION = "0.34.0"

ARRAYS = {'kiriReplay': {'note': ('noteCount', 1)},
 'kiriSheetDef': {'restPositions': ('vertexCount', 2),
                  'indices': ('triangleCount', 3),
                  'framePoints': ('frameCount', 2)},
 'kiriMesh': {'positions': ('vertexCount', 3),
              'normals': ('vertexCount', 3),
              'restPositions': ('vertexCount', 2),
              'indices': ('triangleCount', 3),
              'sourceTriangles': ('vertexCount', 1),
              'sourceWeights': ('vertexCount', 3)},
 'kiriSolid': {'positions': ('vertexCount', 3),
               'normals': ('vertexCount', 3),
               'restPositions': ('vertexCount', 2),
               'indices': ('triangleCount', 3),
               'sources': ('vertexCount', 1)},
 'kiriPieceMesh': {'vertices': ('vertexCount', 1),
                   'triangles': ('triangleCount', 1),
                   'indices': ('triangleCount', 3),
                   'collisionPoints': ('collisionPointCount', 1)},
 'kiriSeamDef': {'lineA': ('countA', 2), 'lineB': ('countB', 2)},
 'kiriObstacleDef': {'outline': ('outlineCount', 2)}}

IDS = {'kiriEvent': {'sheet': 'Sheet', 'cut': 'Cut', 'frame': 'Frame', 'pin': 'Pin', 'seam': 'Seam'},
 'kiriPointState': {'frame': 'Frame'},
 'kiriPinDef': {'obstacle': 'Obstacle'},
 'kiriPinState': {'sheet': 'Sheet', 'obstacle': 'Obstacle'},
 'kiriSeamDef': {'sheetA': 'Sheet', 'sheetB': 'Sheet'},
 'kiriStitch': {'sheetA': 'Sheet', 'sheetB': 'Sheet'},
 'kiriDebugDraw': {'sheet': 'Sheet'}}

ENUMS = {'kiriEvent': {'type': 'EventType', 'stage': 'Stage'},
 'kiriSheetDef': {'model': 'Model', 'skinning': 'Skinning', 'timeStepping': 'TimeStepping'},
 'kiriSheetSettings': {'skinning': 'Skinning', 'timeStepping': 'TimeStepping'},
 'kiriPinState': {'type': 'PinType'},
 'kiriObstacleDef': {'type': 'ObstacleType'},
 'kiriDebugDraw': {'flags': 'DrawFlag'}}

CHANGES = {'kiriWorld_Tick': True,
 'kiriWorld_ShiftOrigin': True,
 'kiriWorld_SetGravity': True,
 'kiriWorld_SetBudget': True,
 'kiriWorld_GetStateHash': False,
 'kiriWorld_GetSheets': False,
 'kiriWorld_Note': True,
 'kiriWorld_Replay': True,
 'kiriWorld_Save': False,
 'kiriWorld_FinishCuts': True,
 'kiriWorld_Load': True,
 'kiriWorld_Snapshot': False,
 'kiriWorld_Restore': True,
 'kiriWorld_GetEvents': False,
 'kiriWorld_GetProfile': False,
 'kiriCreateSheet': True,
 'kiriDestroySheet': True,
 'kiriCreateRectangle': True,
 'kiriSheet_GetSettings': False,
 'kiriSheet_SetSettings': True,
 'kiriCreateFoldedSheet': True,
 'kiriSheet_AddFold': True,
 'kiriSheet_GetFold': False,
 'kiriSheet_SetFold': True,
 'kiriSheet_GetMesh': False,
 'kiriSheet_GetDirty': False,
 'kiriSheet_CopyVertices': False,
 'kiriSheet_CopyPrevious': False,
 'kiriSheet_CopyIndices16': False,
 'kiriSheet_CopySources': False,
 'kiriSheet_CopySourceWeights': False,
 'kiriSheet_GetSolid': True,
 'kiriSheet_GetCollisionPoints': False,
 'kiriSheet_GetCounts': False,
 'kiriSheet_GetTotals': False,
 'kiriSheet_EstimateError': False,
 'kiriSheet_IsAwake': False,
 'kiriSheet_Wake': True,
 'kiriSheet_Transform': True,
 'kiriSheet_SetVelocity': True,
 'kiriFrame_SetPieceVelocity': True,
 'kiriSheet_SetUserData': True,
 'kiriSheet_GetUserData': False,
 'kiriPin_SetUserData': True,
 'kiriPin_GetUserData': False,
 'kiriFrame_SetPieceUserData': True,
 'kiriFrame_GetPieceUserData': False,
 'kiriSheet_Raycast': False,
 'kiriWorld_Raycast': False,
 'kiriSheet_GetPoint': False,
 'kiriSheet_GetWeights': False,
 'kiriSheet_GetPiece': True,
 'kiriSheet_GetPieceMesh': True,
 'kiriSheet_GetPieceFrames': True,
 'kiriFrame_GetPiece': False,
 'kiriFrame_DetachPiece': True,
 'kiriFrame_DestroyPiece': True,
 'kiriWorld_DetachPieces': True,
 'kiriWorld_DestroyPieces': True,
 'kiriSheet_DropCrumbs': True,
 'kiriBeginCut': True,
 'kiriCut_Extend': True,
 'kiriCut_End': True,
 'kiriSheet_Cut': True,
 'kiriSheet_Slice': True,
 'kiriSheet_SetTearing': True,
 'kiriSheet_GetTearing': False,
 'kiriSheet_SetTearLine': True,
 'kiriBeginBlade': True,
 'kiriBlade_MoveEdge': True,
 'kiriBlade_MoveRay': True,
 'kiriBlade_End': True,
 'kiriSheet_GetFrames': False,
 'kiriFrame_Hold': True,
 'kiriFrame_GetState': False,
 'kiriFrame_GetReaction': False,
 'kiriFrame_ApplyForce': True,
 'kiriSheet_ApplyForce': True,
 'kiriSheet_ApplyLineLoad': True,
 'kiriSheet_ApplyPressure': True,
 'kiriSheet_ApplyImpulse': True,
 'kiriSheet_SetWind': True,
 'kiriCreatePin': True,
 'kiriDestroyPin': True,
 'kiriSheet_ClampLine': True,
 'kiriSheet_HingeLine': True,
 'kiriPin_SetTarget': True,
 'kiriPin_SetPose': True,
 'kiriPin_SetBreakForce': True,
 'kiriPin_GetState': False,
 'kiriPin_GetReaction': False,
 'kiriSheet_GetPins': False,
 'kiriCreateSeam': True,
 'kiriDestroySeam': True,
 'kiriSeam_SetHinge': True,
 'kiriSeam_GetStitch': False,
 'kiriSeam_GetCount': False,
 'kiriWorld_GetSeams': False,
 'kiriSheet_SetContacts': True,
 'kiriSheet_GetContactForces': False,
 'kiriCreateObstacle': True,
 'kiriDestroyObstacle': True,
 'kiriObstacle_SetPose': True,
 'kiriObstacle_SetVelocity': True,
 'kiriObstacle_SetSurfaceVelocity': True,
 'kiriObstacle_SetMass': True,
 'kiriObstacle_GetState': False,
 'kiriSheet_GetReach': False,
 'kiriWorld_DebugDraw': False}

METHODS = {'kiriGetVersion': (None, 'version'),
 'kiriGetResultName': (None, 'result_name'),
 'kiriGetResultText': (None, 'result_text'),
 'kiriDefaultWorldDef': (None, 'default_world_def'),
 'kiriCreateWorld': (None, 'World'),
 'kiriDestroyWorld': ('World', 'close'),
 'kiriWorld_Tick': ('World', 'tick'),
 'kiriWorld_GetLastError': ('World', 'last_error'),
 'kiriWorld_ShiftOrigin': ('World', 'shift_origin'),
 'kiriWorld_SetGravity': ('World', 'set_gravity'),
 'kiriWorld_SetBudget': ('World', 'set_budget'),
 'kiriWorld_GetStateHash': ('World', 'state_hash'),
 'kiriWorld_GetSheets': ('World', 'sheets'),
 'kiriWorld_Note': ('World', 'note'),
 'kiriWorld_Replay': ('World', 'replay'),
 'kiriWorld_Save': ('World', 'save'),
 'kiriWorld_FinishCuts': ('World', 'finish_cuts'),
 'kiriWorld_Load': ('World', 'load'),
 'kiriWorld_Snapshot': ('World', 'snapshot'),
 'kiriWorld_Restore': ('World', 'restore'),
 'kiriWorld_GetEvents': ('World', 'events'),
 'kiriWorld_GetProfile': ('World', 'profile'),
 'kiriFitBudget': (None, 'fit_budget'),
 'kiriGetStageName': (None, 'stage_name'),
 'kiriGetMaterial': (None, 'material'),
 'kiriGetQuality': (None, 'quality'),
 'kiriDefaultSheetDef': (None, 'default_sheet_def'),
 'kiriCreateSheet': ('World', 'create_sheet'),
 'kiriDestroySheet': ('Sheet', 'destroy'),
 'kiriGetSetup': (None, 'setup'),
 'kiriCreateRectangle': ('World', 'create_rectangle'),
 'kiriSheet_GetSettings': ('Sheet', 'settings'),
 'kiriSheet_SetSettings': ('Sheet', 'set_settings'),
 'kiriCreateFoldedSheet': ('World', 'create_folded_sheet'),
 'kiriSheet_AddFold': ('Sheet', 'add_fold'),
 'kiriSheet_GetFold': ('Sheet', 'fold'),
 'kiriSheet_SetFold': ('Sheet', 'set_fold'),
 'kiriFillRectangle': (None, 'fill_rectangle'),
 'kiriSheet_GetMesh': ('Sheet', 'mesh'),
 'kiriSheet_GetDirty': ('Sheet', 'dirty'),
 'kiriSheet_CopyVertices': ('Sheet', 'copy_vertices'),
 'kiriSheet_CopyPrevious': ('Sheet', 'copy_previous'),
 'kiriSheet_CopyIndices16': ('Sheet', 'copy_indices16'),
 'kiriSheet_CopySources': ('Sheet', 'copy_sources'),
 'kiriSheet_CopySourceWeights': ('Sheet', 'copy_source_weights'),
 'kiriSheet_GetSolid': ('Sheet', 'solid'),
 'kiriSheet_GetCollisionPoints': ('Sheet', 'collision_points'),
 'kiriSheet_GetCounts': ('Sheet', 'counts'),
 'kiriSheet_GetTotals': ('Sheet', 'totals'),
 'kiriSheet_EstimateError': ('Sheet', 'estimate_error'),
 'kiriSheet_IsAwake': ('Sheet', 'is_awake'),
 'kiriSheet_Wake': ('Sheet', 'wake'),
 'kiriSheet_Transform': ('Sheet', 'transform'),
 'kiriSheet_SetVelocity': ('Sheet', 'set_velocity'),
 'kiriFrame_SetPieceVelocity': ('Frame', 'set_piece_velocity'),
 'kiriSheet_SetUserData': ('Sheet', 'set_user_data'),
 'kiriSheet_GetUserData': ('Sheet', 'user_data'),
 'kiriPin_SetUserData': ('Pin', 'set_user_data'),
 'kiriPin_GetUserData': ('Pin', 'user_data'),
 'kiriFrame_SetPieceUserData': ('Frame', 'set_piece_user_data'),
 'kiriFrame_GetPieceUserData': ('Frame', 'piece_user_data'),
 'kiriSheet_Raycast': ('Sheet', 'raycast'),
 'kiriWorld_Raycast': ('World', 'raycast'),
 'kiriSheet_GetPoint': ('Sheet', 'point'),
 'kiriSheet_GetWeights': ('Sheet', 'weights'),
 'kiriSheet_GetPiece': ('Sheet', 'piece'),
 'kiriSheet_GetPieceMesh': ('Sheet', 'piece_mesh'),
 'kiriSheet_GetPieceFrames': ('Sheet', 'piece_frames'),
 'kiriFrame_GetPiece': ('Frame', 'piece'),
 'kiriFrame_DetachPiece': ('Frame', 'detach_piece'),
 'kiriFrame_DestroyPiece': ('Frame', 'destroy_piece'),
 'kiriWorld_DetachPieces': ('World', 'detach_pieces'),
 'kiriWorld_DestroyPieces': ('World', 'destroy_pieces'),
 'kiriSheet_DropCrumbs': ('Sheet', 'drop_crumbs'),
 'kiriBeginCut': ('Sheet', 'begin_cut'),
 'kiriCut_Extend': ('Cut', 'extend'),
 'kiriCut_End': ('Cut', 'end'),
 'kiriSheet_Cut': ('Sheet', 'cut'),
 'kiriSheet_Slice': ('Sheet', 'slice'),
 'kiriGetTearing': (None, 'tearing'),
 'kiriSheet_SetTearing': ('Sheet', 'set_tearing'),
 'kiriSheet_GetTearing': ('Sheet', 'tearing'),
 'kiriSheet_SetTearLine': ('Sheet', 'set_tear_line'),
 'kiriBeginBlade': ('World', 'begin_blade'),
 'kiriBlade_MoveEdge': ('Blade', 'move_edge'),
 'kiriBlade_MoveRay': ('Blade', 'move_ray'),
 'kiriBlade_End': ('Blade', 'end'),
 'kiriSheet_GetFrames': ('Sheet', 'frames'),
 'kiriFrame_Hold': ('Frame', 'hold'),
 'kiriFrame_GetState': ('Frame', 'state'),
 'kiriFrame_GetReaction': ('Frame', 'reaction'),
 'kiriFrame_ApplyForce': ('Frame', 'apply_force'),
 'kiriSheet_ApplyForce': ('Sheet', 'apply_force'),
 'kiriSheet_ApplyLineLoad': ('Sheet', 'apply_line_load'),
 'kiriSheet_ApplyPressure': ('Sheet', 'apply_pressure'),
 'kiriSheet_ApplyImpulse': ('Sheet', 'apply_impulse'),
 'kiriSheet_SetWind': ('Sheet', 'set_wind'),
 'kiriDefaultPinDef': (None, 'default_pin_def'),
 'kiriCreatePin': ('Sheet', 'create_pin'),
 'kiriDestroyPin': ('Pin', 'destroy'),
 'kiriSheet_ClampLine': ('Sheet', 'clamp_line'),
 'kiriSheet_HingeLine': ('Sheet', 'hinge_line'),
 'kiriPin_SetTarget': ('Pin', 'set_target'),
 'kiriPin_SetPose': ('Pin', 'set_pose'),
 'kiriPin_SetBreakForce': ('Pin', 'set_break_force'),
 'kiriPin_GetState': ('Pin', 'state'),
 'kiriPin_GetReaction': ('Pin', 'reaction'),
 'kiriSheet_GetPins': ('Sheet', 'pins'),
 'kiriDefaultSeamDef': (None, 'default_seam_def'),
 'kiriCreateSeam': ('World', 'create_seam'),
 'kiriDestroySeam': ('Seam', 'destroy'),
 'kiriSeam_SetHinge': ('Seam', 'set_hinge'),
 'kiriSeam_GetStitch': ('Seam', 'stitch'),
 'kiriSeam_GetCount': ('Seam', 'count'),
 'kiriWorld_GetSeams': ('World', 'seams'),
 'kiriSheet_SetContacts': ('Sheet', 'set_contacts'),
 'kiriSheet_GetContactForces': ('Sheet', 'contact_forces'),
 'kiriDefaultObstacleDef': (None, 'default_obstacle_def'),
 'kiriCreateObstacle': ('World', 'create_obstacle'),
 'kiriDestroyObstacle': ('Obstacle', 'destroy'),
 'kiriObstacle_SetPose': ('Obstacle', 'set_pose'),
 'kiriObstacle_SetVelocity': ('Obstacle', 'set_velocity'),
 'kiriObstacle_SetSurfaceVelocity': ('Obstacle', 'set_surface_velocity'),
 'kiriObstacle_SetMass': ('Obstacle', 'set_mass'),
 'kiriObstacle_GetState': ('Obstacle', 'state'),
 'kiriSheet_GetReach': ('Sheet', 'reach'),
 'kiriDefaultDebugDraw': (None, 'default_debug_draw'),
 'kiriWorld_DebugDraw': ('World', 'debug_draw')}

CONSTANTS = {'KIRI_OK': 0,
 'KIRI_PENDING': 1,
 'KIRI_ERROR_ARGUMENT': -1,
 'KIRI_ERROR_DEF': -2,
 'KIRI_ERROR_ID': -3,
 'KIRI_ERROR_MESH': -4,
 'KIRI_ERROR_STATE': -5,
 'KIRI_ERROR_MEMORY': -6,
 'KIRI_DIVERGED': -7,
 'KIRI_ERROR_LIMIT': -8,
 'KIRI_ERROR_BUILD': -9,
 'KIRI_ERROR_DATA': -10,
 'KIRI_ERROR_REPLAY': -11,
 'KIRI_LEAST_TRIANGLES': 16,
 'KIRI_MOST_NOTE_BYTES': 1048576,
 'KIRI_EVENT_CUT_FINISHED': 1,
 'KIRI_EVENT_PIECE_OFF': 2,
 'KIRI_EVENT_FRAME_ADDED': 3,
 'KIRI_EVENT_DIVERGED': 4,
 'KIRI_EVENT_DEFERRED': 5,
 'KIRI_EVENT_PIN_BROKE': 6,
 'KIRI_EVENT_PIECE_DETACHED': 7,
 'KIRI_EVENT_SEAM_BROKE': 8,
 'KIRI_EVENT_TEAR_BEGAN': 9,
 'KIRI_EVENT_TEAR_ENDED': 10,
 'KIRI_EVENT_STRAINED': 11,
 'KIRI_STAGE_CUT': 0,
 'KIRI_STAGE_GRID': 1,
 'KIRI_STAGE_REGIONS': 2,
 'KIRI_STAGE_SHAPE': 3,
 'KIRI_STAGE_SAMPLES': 4,
 'KIRI_STAGE_CONSTANTS': 5,
 'KIRI_STAGE_CONTACT': 6,
 'KIRI_STAGE_SOLVE': 7,
 'KIRI_STAGE_SKIN': 8,
 'KIRI_STAGE_COUNT': 9,
 'KIRI_MATERIAL_PAPER': 0,
 'KIRI_MATERIAL_COTTON': 1,
 'KIRI_MATERIAL_RUBBER': 2,
 'KIRI_MATERIAL_FOIL': 3,
 'KIRI_MATERIAL_CARD': 4,
 'KIRI_MATERIAL_SILK': 5,
 'KIRI_MATERIAL_SHIRTING': 6,
 'KIRI_MATERIAL_WOOL': 7,
 'KIRI_MATERIAL_DENIM': 8,
 'KIRI_MATERIAL_JERSEY': 9,
 'KIRI_MATERIAL_COUNT': 10,
 'KIRI_QUALITY_FAST': 0,
 'KIRI_QUALITY_BALANCED': 1,
 'KIRI_QUALITY_ACCURATE': 2,
 'KIRI_QUALITY_COUNT': 3,
 'KIRI_SETUP_CURTAIN': 0,
 'KIRI_SETUP_PAPER': 1,
 'KIRI_SETUP_FLAG': 2,
 'KIRI_SETUP_RIBBON': 3,
 'KIRI_SETUP_RUBBER': 4,
 'KIRI_SETUP_CARD': 5,
 'KIRI_SETUP_FOIL': 6,
 'KIRI_SETUP_COUNT': 7,
 'KIRI_MODEL_LINKS': 0,
 'KIRI_MODEL_AFFINE': 1,
 'KIRI_MODEL_POINTS': 2,
 'KIRI_SKINNING_LINEAR': 0,
 'KIRI_SKINNING_SMOOTH': 1,
 'KIRI_TIME_STEPPING_SECOND_ORDER': 0,
 'KIRI_TIME_STEPPING_EULER': 1,
 'KIRI_PIN_POINT': 0,
 'KIRI_PIN_HINGE': 1,
 'KIRI_PIN_CLAMP': 2,
 'KIRI_OBSTACLE_PLANE': 0,
 'KIRI_OBSTACLE_SPHERE': 1,
 'KIRI_OBSTACLE_CAPSULE': 2,
 'KIRI_OBSTACLE_BOX': 3,
 'KIRI_OBSTACLE_CYLINDER': 4,
 'KIRI_OBSTACLE_PRISM': 5,
 'KIRI_DRAW_TRIANGLES': 1,
 'KIRI_DRAW_EDGES': 2,
 'KIRI_DRAW_BORDERS': 4,
 'KIRI_DRAW_FRAMES': 8,
 'KIRI_DRAW_LINKS': 16,
 'KIRI_DRAW_PINS': 32,
 'KIRI_DRAW_CONTACTS': 64,
 'KIRI_DRAW_BLADES': 128,
 'KIRI_DRAW_BOXES': 256,
 'KIRI_DRAW_OBSTACLES': 512,
 'KIRI_DRAW_POINTS': 1024,
 'KIRI_DRAW_ALL': 2047}

CDEF = """
typedef struct kiriWorld kiriWorld;
typedef uint32_t kiriSheet;
typedef uint32_t kiriCut;
typedef uint32_t kiriFrame;
typedef uint32_t kiriPin;
typedef uint32_t kiriObstacle;
typedef uint32_t kiriBlade;
typedef uint32_t kiriSeam;
typedef int32_t kiriResult;
enum kiriResultCode { KIRI_OK = 0, KIRI_PENDING = 1, KIRI_ERROR_ARGUMENT = -1, KIRI_ERROR_DEF = -2, KIRI_ERROR_ID = -3, KIRI_ERROR_MESH = -4, KIRI_ERROR_STATE = -5, KIRI_ERROR_MEMORY = -6, KIRI_DIVERGED = -7, KIRI_ERROR_LIMIT = -8, KIRI_ERROR_BUILD = -9, KIRI_ERROR_DATA = -10, KIRI_ERROR_REPLAY = -11 };
enum kiriBudgetLimit { KIRI_LEAST_TRIANGLES = 16 };
enum kiriNoteLimit { KIRI_MOST_NOTE_BYTES = 1048576 };
enum kiriEventType { KIRI_EVENT_CUT_FINISHED = 1, KIRI_EVENT_PIECE_OFF = 2, KIRI_EVENT_FRAME_ADDED = 3, KIRI_EVENT_DIVERGED = 4, KIRI_EVENT_DEFERRED = 5, KIRI_EVENT_PIN_BROKE = 6, KIRI_EVENT_PIECE_DETACHED = 7, KIRI_EVENT_SEAM_BROKE = 8, KIRI_EVENT_TEAR_BEGAN = 9, KIRI_EVENT_TEAR_ENDED = 10, KIRI_EVENT_STRAINED = 11 };
enum kiriStage { KIRI_STAGE_CUT = 0, KIRI_STAGE_GRID = 1, KIRI_STAGE_REGIONS = 2, KIRI_STAGE_SHAPE = 3, KIRI_STAGE_SAMPLES = 4, KIRI_STAGE_CONSTANTS = 5, KIRI_STAGE_CONTACT = 6, KIRI_STAGE_SOLVE = 7, KIRI_STAGE_SKIN = 8, KIRI_STAGE_COUNT = 9 };
enum kiriMaterialPreset { KIRI_MATERIAL_PAPER = 0, KIRI_MATERIAL_COTTON = 1, KIRI_MATERIAL_RUBBER = 2, KIRI_MATERIAL_FOIL = 3, KIRI_MATERIAL_CARD = 4, KIRI_MATERIAL_SILK = 5, KIRI_MATERIAL_SHIRTING = 6, KIRI_MATERIAL_WOOL = 7, KIRI_MATERIAL_DENIM = 8, KIRI_MATERIAL_JERSEY = 9, KIRI_MATERIAL_COUNT = 10 };
enum kiriQualityPreset { KIRI_QUALITY_FAST = 0, KIRI_QUALITY_BALANCED = 1, KIRI_QUALITY_ACCURATE = 2, KIRI_QUALITY_COUNT = 3 };
enum kiriSetupPreset { KIRI_SETUP_CURTAIN = 0, KIRI_SETUP_PAPER = 1, KIRI_SETUP_FLAG = 2, KIRI_SETUP_RIBBON = 3, KIRI_SETUP_RUBBER = 4, KIRI_SETUP_CARD = 5, KIRI_SETUP_FOIL = 6, KIRI_SETUP_COUNT = 7 };
enum kiriModel { KIRI_MODEL_LINKS = 0, KIRI_MODEL_AFFINE = 1, KIRI_MODEL_POINTS = 2 };
enum kiriSkinning { KIRI_SKINNING_LINEAR = 0, KIRI_SKINNING_SMOOTH = 1 };
enum kiriTimeStepping { KIRI_TIME_STEPPING_SECOND_ORDER = 0, KIRI_TIME_STEPPING_EULER = 1 };
enum kiriPinType { KIRI_PIN_POINT = 0, KIRI_PIN_HINGE = 1, KIRI_PIN_CLAMP = 2 };
enum kiriObstacleType { KIRI_OBSTACLE_PLANE = 0, KIRI_OBSTACLE_SPHERE = 1, KIRI_OBSTACLE_CAPSULE = 2, KIRI_OBSTACLE_BOX = 3, KIRI_OBSTACLE_CYLINDER = 4, KIRI_OBSTACLE_PRISM = 5 };
enum kiriDrawFlag { KIRI_DRAW_TRIANGLES = 1, KIRI_DRAW_EDGES = 2, KIRI_DRAW_BORDERS = 4, KIRI_DRAW_FRAMES = 8, KIRI_DRAW_LINKS = 16, KIRI_DRAW_PINS = 32, KIRI_DRAW_CONTACTS = 64, KIRI_DRAW_BLADES = 128, KIRI_DRAW_BOXES = 256, KIRI_DRAW_OBSTACLES = 512, KIRI_DRAW_POINTS = 1024, KIRI_DRAW_ALL = 2047 };
typedef struct kiriBudget kiriBudget;
typedef struct kiriWorldDef kiriWorldDef;
typedef struct kiriReplay kiriReplay;
typedef struct kiriEvent kiriEvent;
typedef struct kiriProfile kiriProfile;
typedef struct kiriMaterial kiriMaterial;
typedef struct kiriQuality kiriQuality;
typedef struct kiriPaperOptions kiriPaperOptions;
typedef struct kiriSheetDef kiriSheetDef;
typedef struct kiriSheetSettings kiriSheetSettings;
typedef struct kiriFold kiriFold;
typedef struct kiriFoldState kiriFoldState;
typedef struct kiriMesh kiriMesh;
typedef struct kiriRange kiriRange;
typedef struct kiriDirty kiriDirty;
typedef struct kiriSolid kiriSolid;
typedef struct kiriCounts kiriCounts;
typedef struct kiriTotals kiriTotals;
typedef struct kiriHit kiriHit;
typedef struct kiriPointState kiriPointState;
typedef struct kiriPieceState kiriPieceState;
typedef struct kiriPieceMesh kiriPieceMesh;
typedef struct kiriTearing kiriTearing;
typedef struct kiriFrameState kiriFrameState;
typedef struct kiriWind kiriWind;
typedef struct kiriPinDef kiriPinDef;
typedef struct kiriPinState kiriPinState;
typedef struct kiriSeamDef kiriSeamDef;
typedef struct kiriStitch kiriStitch;
typedef struct kiriContact kiriContact;
typedef struct kiriContactForce kiriContactForce;
typedef struct kiriObstacleDef kiriObstacleDef;
typedef struct kiriObstacleState kiriObstacleState;
typedef struct kiriDrawVertex kiriDrawVertex;
typedef struct kiriDebugDraw kiriDebugDraw;
typedef void* kiriAllocFn(void* user, int64_t bytes);
typedef void kiriFreeFn(void* user, void* pointer);
typedef void kiriLogFn(void* user, const char* line);
typedef double kiriClockFn(void* user);
typedef void kiriRecordFn(void* user, const void* bytes, int32_t count);
typedef void kiriTaskFn(int32_t start, int32_t end, void* taskContext);
typedef void* kiriStartTaskFn(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* taskContext);
typedef void kiriFinishTaskFn(void* user, void* handle);
typedef void kiriDrawFn(void* user, const kiriDrawVertex* vertices, int32_t count);
struct kiriBudget { int32_t triangles; int32_t cells; int32_t samples; int32_t iterations; };
struct kiriWorldDef { uint32_t cookie; float gravity[3]; kiriBudget budget; kiriAllocFn* alloc; kiriFreeFn* free; kiriLogFn* log; kiriClockFn* clock; kiriStartTaskFn* startTask; kiriFinishTaskFn* finishTask; int32_t workerCount; void* user; kiriRecordFn* record; int32_t recordHashTicks; };
struct kiriReplay { int64_t offset; int64_t calls; int64_t ticks; const void* note; int32_t noteCount; };
struct kiriEvent { int32_t type; kiriSheet sheet; kiriCut cut; kiriFrame frame; kiriPin pin; int32_t crumb; float area; int32_t stage; int32_t waiting; kiriSeam seam; int32_t stitches; };
struct kiriProfile { double seconds[9]; int32_t cutSegments; int32_t trianglesSplit; int32_t cellsSettled; int32_t samplesRefreshed; int32_t solverIterations; int32_t cellsChanged; int32_t weightsChanged; int32_t verticesChanged; int32_t pointsChanged; int32_t linksChanged; int32_t commits; int32_t systemsSolved; int32_t contacts; int32_t sheetPairs; double largestJump; double largestFade; };
struct kiriMaterial { float youngsModulus; float poissonsRatio; float thickness; float density; float airDamping; float flexDamping; float yieldStress; float hardening; float slack; int32_t detail; float restCurvature[3]; };
struct kiriQuality { int32_t framesAlong; int32_t gridResolution; int32_t iterations; int32_t substeps; };
struct kiriPaperOptions { int32_t fromScratch; int32_t popping; int32_t linearWeights; int32_t integrationPoints; int32_t integrationOrder; };
struct kiriSheetDef { uint32_t cookie; const float* restPositions; int32_t vertexCount; const int32_t* indices; int32_t triangleCount; float position[3]; float axisU[3]; float axisV[3]; float velocity[3]; kiriMaterial material; int32_t gridResolution; float snapDistance; float weldDistance; int32_t frameCount; float frameLength; float accuracy; const float* framePoints; int32_t maxFrames; float rigidWeight; float rigidArea; float crumbArea; float friction; float contactThickness; uint32_t groups; int32_t touchesSheets; int32_t selfContact; int32_t collisionPoints; int32_t iterations; float sleepSpeed; int32_t model; int32_t skinning; int32_t planar; int32_t timeStepping; float fadeTime; int32_t normals; kiriPaperOptions paper; };
struct kiriSheetSettings { uint32_t cookie; kiriMaterial material; int32_t maxFrames; float crumbArea; float friction; float contactThickness; uint32_t groups; int32_t touchesSheets; int32_t selfContact; int32_t iterations; float sleepSpeed; int32_t skinning; int32_t timeStepping; float fadeTime; int32_t normals; };
struct kiriFold { float from[2]; float to[2]; float stiffness; float restAngle; float yieldMoment; };
struct kiriFoldState { kiriFold fold; double angle; double length; };
struct kiriMesh { const float* positions; const float* normals; const float* restPositions; const int32_t* indices; const int32_t* sourceTriangles; const float* sourceWeights; int32_t vertexCount; int32_t triangleCount; uint32_t revision; };
struct kiriRange { int32_t first; int32_t count; };
struct kiriDirty { kiriRange newVertices; kiriRange newTriangles; kiriRange oldVertices; kiriRange oldTriangles; uint32_t revision; };
struct kiriSolid { const float* positions; const float* normals; const float* restPositions; const int32_t* indices; const int32_t* sources; int32_t vertexCount; int32_t triangleCount; int32_t rimTriangle; };
struct kiriCounts { int32_t vertices; int32_t triangles; int32_t cells; int32_t frames; int32_t links; int32_t pieces; int32_t collisionPoints; };
struct kiriTotals { double area; double mass; double kineticEnergy; double elasticEnergy; double center[3]; double momentum[3]; double angularMomentum[3]; };
struct kiriHit { float restPoint[2]; float position[3]; float normal[3]; float distance; int32_t triangle; };
struct kiriPointState { float position[3]; float normal[3]; float velocity[3]; kiriFrame frame; };
struct kiriPieceState { double area; double mass; double center[3]; double momentum[3]; double angularMomentum[3]; float lower[3]; float upper[3]; int32_t frames; int32_t vertices; int32_t triangles; int32_t collisionPoints; int32_t crumb; int32_t asleep; };
struct kiriPieceMesh { const int32_t* vertices; const int32_t* triangles; const int32_t* indices; const int32_t* collisionPoints; int32_t vertexCount; int32_t triangleCount; int32_t collisionPointCount; };
struct kiriTearing { float toughness; float strength; float grain[2]; float grainRatio; float maxSpeed; int32_t maxTips; };
struct kiriFrameState { float restPoint[2]; float position[3]; float rotation[9]; float velocity[3]; float angularVelocity[3]; float area; float mass; int32_t held; };
struct kiriWind { float velocity[3]; float density; float drag; float lift; };
struct kiriPinDef { uint32_t cookie; float restPoint[2]; float target[3]; float stiffness; float breakForce; kiriObstacle obstacle; };
struct kiriPinState { int32_t type; kiriSheet sheet; float from[2]; float to[2]; float target[3]; float rotation[9]; float breakForce; kiriObstacle obstacle; };
struct kiriSeamDef { uint32_t cookie; kiriSheet sheetA; kiriSheet sheetB; const float* lineA; const float* lineB; int32_t countA; int32_t countB; int32_t stitches; float stiffness; float restAngle; float breakForce; };
struct kiriStitch { kiriSheet sheetA; kiriSheet sheetB; float restA[2]; float restB[2]; float position[3]; float gap; float force[3]; float angle; };
struct kiriContact { int32_t point; float restPoint[2]; float normal[3]; float offset; float velocity[3]; float friction; float inverseMass; float pushSpeed; int32_t obstacle; };
struct kiriContactForce { double impulse[3]; double position[3]; double depth; int32_t point; int32_t obstacle; };
struct kiriObstacleDef { uint32_t cookie; int32_t type; float size[3]; float radius; float height; const float* outline; int32_t outlineCount; float rounding; float position[3]; float rotation[9]; float velocity[3]; float angularVelocity[3]; float surfaceVelocity[3]; float friction; float mass; float inertia[6]; float centerOfMass[3]; uint32_t body; float pushSpeed; uint32_t groups; };
struct kiriObstacleState { float position[3]; float rotation[9]; float velocity[3]; float angularVelocity[3]; double impulse[3]; double angularImpulse[3]; int32_t contacts; };
struct kiriDrawVertex { float position[3]; uint32_t color; };
struct kiriDebugDraw { uint32_t cookie; uint32_t flags; kiriSheet sheet; float size; kiriDrawFn* points; kiriDrawFn* lines; kiriDrawFn* triangles; void* user; };
int32_t kiriGetVersion(void);
const char* kiriGetResultName(kiriResult result);
const char* kiriGetResultText(kiriResult result);
void kiriDefaultWorldDef(kiriWorldDef* def);
kiriResult kiriCreateWorld(const kiriWorldDef* def, kiriWorld** world);
void kiriDestroyWorld(kiriWorld* world);
kiriResult kiriWorld_Tick(kiriWorld* world, float dt, int32_t substeps);
const char* kiriWorld_GetLastError(const kiriWorld* world);
kiriResult kiriWorld_ShiftOrigin(kiriWorld* world, const float origin[3]);
kiriResult kiriWorld_SetGravity(kiriWorld* world, const float gravity[3]);
kiriResult kiriWorld_SetBudget(kiriWorld* world, const kiriBudget* budget);
kiriResult kiriWorld_GetStateHash(const kiriWorld* world, uint64_t* hash);
kiriResult kiriWorld_GetSheets(const kiriWorld* world, kiriSheet* sheets, int32_t capacity, int32_t* count);
kiriResult kiriWorld_Note(kiriWorld* world, const void* bytes, int32_t count);
kiriResult kiriWorld_Replay(kiriWorld* world, const void* recording, int64_t size, kiriReplay* replay);
kiriResult kiriWorld_Save(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);
kiriResult kiriWorld_FinishCuts(kiriWorld* world);
kiriResult kiriWorld_Load(kiriWorld* world, const void* bytes, int64_t size);
kiriResult kiriWorld_Snapshot(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);
kiriResult kiriWorld_Restore(kiriWorld* world, const void* bytes, int64_t size);
kiriResult kiriWorld_GetEvents(const kiriWorld* world, const kiriEvent** events, int32_t* count);
kiriResult kiriWorld_GetProfile(const kiriWorld* world, kiriProfile* profile);
kiriResult kiriFitBudget(const kiriProfile* profile, float microseconds, kiriBudget* budget);
const char* kiriGetStageName(int32_t stage);
kiriResult kiriGetMaterial(int32_t preset, kiriMaterial* material);
kiriResult kiriGetQuality(int32_t preset, kiriQuality* quality);
void kiriDefaultSheetDef(kiriSheetDef* def);
kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet);
kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet);
kiriResult kiriGetSetup(int32_t preset, float width, float height, kiriSheetDef* def);
kiriResult kiriCreateRectangle(kiriWorld* world, float width, float height, int32_t columns, int32_t rows, const kiriSheetDef* def, kiriSheet* sheet);
kiriResult kiriSheet_GetSettings(const kiriWorld* world, kiriSheet sheet, kiriSheetSettings* settings);
kiriResult kiriSheet_SetSettings(kiriWorld* world, kiriSheet sheet, const kiriSheetSettings* settings);
kiriResult kiriCreateFoldedSheet(kiriWorld* world, const kiriSheetDef* def, const kiriFold* folds, int32_t count, kiriSheet* sheet);
kiriResult kiriSheet_AddFold(kiriWorld* world, kiriSheet sheet, const kiriFold* fold, int32_t* index);
kiriResult kiriSheet_GetFold(const kiriWorld* world, kiriSheet sheet, int32_t index, kiriFoldState* state);
kiriResult kiriSheet_SetFold(kiriWorld* world, kiriSheet sheet, int32_t index, float stiffness, float restAngle);
kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions, int32_t* indices);
kiriResult kiriSheet_GetMesh(const kiriWorld* world, kiriSheet sheet, kiriMesh* mesh);
kiriResult kiriSheet_GetDirty(const kiriWorld* world, kiriSheet sheet, uint32_t sinceRevision, kiriDirty* dirty);
kiriResult kiriSheet_CopyVertices(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count, void* positions, int32_t positionStride, void* normals, int32_t normalStride);
kiriResult kiriSheet_CopyPrevious(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count, int32_t* vertices, kiriSheet* from);
kiriResult kiriSheet_CopyIndices16(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count, uint16_t* indices);
kiriResult kiriSheet_CopySources(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count, int32_t* sources);
kiriResult kiriSheet_CopySourceWeights(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count, float* weights);
kiriResult kiriSheet_GetSolid(kiriWorld* world, kiriSheet sheet, float thickness, kiriSolid* solid);
kiriResult kiriSheet_GetCollisionPoints(const kiriWorld* world, kiriSheet sheet, const float** positions, int32_t* count);
kiriResult kiriSheet_GetCounts(const kiriWorld* world, kiriSheet sheet, kiriCounts* counts);
kiriResult kiriSheet_GetTotals(const kiriWorld* world, kiriSheet sheet, kiriTotals* totals);
kiriResult kiriSheet_EstimateError(const kiriWorld* world, kiriSheet sheet, double* relative);
kiriResult kiriSheet_IsAwake(const kiriWorld* world, kiriSheet sheet, int32_t* awake);
kiriResult kiriSheet_Wake(kiriWorld* world, kiriSheet sheet);
kiriResult kiriSheet_Transform(kiriWorld* world, kiriSheet sheet, const float rotation[9], const float translation[3]);
kiriResult kiriSheet_SetVelocity(kiriWorld* world, kiriSheet sheet, const float velocity[3], const float angularVelocity[3]);
kiriResult kiriFrame_SetPieceVelocity(kiriWorld* world, kiriFrame frame, const float velocity[3], const float angularVelocity[3]);
kiriResult kiriSheet_SetUserData(kiriWorld* world, kiriSheet sheet, uint64_t data);
kiriResult kiriSheet_GetUserData(const kiriWorld* world, kiriSheet sheet, uint64_t* data);
kiriResult kiriPin_SetUserData(kiriWorld* world, kiriPin pin, uint64_t data);
kiriResult kiriPin_GetUserData(const kiriWorld* world, kiriPin pin, uint64_t* data);
kiriResult kiriFrame_SetPieceUserData(kiriWorld* world, kiriFrame frame, uint64_t data);
kiriResult kiriFrame_GetPieceUserData(const kiriWorld* world, kiriFrame frame, uint64_t* data);
kiriResult kiriSheet_Raycast(const kiriWorld* world, kiriSheet sheet, const float origin[3], const float direction[3], float maxDistance, kiriHit* hit);
kiriResult kiriWorld_Raycast(const kiriWorld* world, const float origin[3], const float direction[3], float maxDistance, kiriSheet* sheet, kiriHit* hit);
kiriResult kiriSheet_GetPoint(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriPointState* state);
kiriResult kiriSheet_GetWeights(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriFrame* frames, float* weights, float* gradients, int32_t capacity, int32_t* count);
kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state);
kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh);
kiriResult kiriSheet_GetPieceFrames(kiriWorld* world, kiriSheet sheet, int32_t piece, const kiriFrame** frames, int32_t* count);
kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece);
kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached);
kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame);
kiriResult kiriWorld_DetachPieces(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* detached);
kiriResult kiriWorld_DestroyPieces(kiriWorld* world, const kiriFrame* frames, int32_t count);
kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count);
kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut);
kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count);
kiriResult kiriCut_End(kiriWorld* world, kiriCut cut);
kiriResult kiriSheet_Cut(kiriWorld* world, kiriSheet sheet, const float* restPoints, int32_t count, kiriCut* cut);
kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut);
kiriResult kiriGetTearing(int32_t preset, kiriTearing* tearing);
kiriResult kiriSheet_SetTearing(kiriWorld* world, kiriSheet sheet, const kiriTearing* tearing);
kiriResult kiriSheet_GetTearing(const kiriWorld* world, kiriSheet sheet, kiriTearing* tearing);
kiriResult kiriSheet_SetTearLine(kiriWorld* world, kiriSheet sheet, const float* restPoints, int32_t count, float factor);
kiriResult kiriBeginBlade(kiriWorld* world, kiriSheet sheet, kiriBlade* blade);
kiriResult kiriBlade_MoveEdge(kiriWorld* world, kiriBlade blade, const float from[3], const float to[3]);
kiriResult kiriBlade_MoveRay(kiriWorld* world, kiriBlade blade, const float origin[3], const float direction[3], float length);
kiriResult kiriBlade_End(kiriWorld* world, kiriBlade blade);
kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity, int32_t* count);
kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9]);
kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state);
kiriResult kiriFrame_GetReaction(const kiriWorld* world, kiriFrame frame, double force[3], double torque[3]);
kiriResult kiriFrame_ApplyForce(kiriWorld* world, kiriFrame frame, const float force[3], const float torque[3]);
kiriResult kiriSheet_ApplyForce(kiriWorld* world, kiriSheet sheet, const float restPoint[2], const float force[3], const float torque[3]);
kiriResult kiriSheet_ApplyLineLoad(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2], const float forcePerLength[3]);
kiriResult kiriSheet_ApplyPressure(kiriWorld* world, kiriSheet sheet, float pressure);
kiriResult kiriSheet_ApplyImpulse(kiriWorld* world, kiriSheet sheet, const float restPoint[2], const float impulse[3]);
kiriResult kiriSheet_SetWind(kiriWorld* world, kiriSheet sheet, const kiriWind* wind);
void kiriDefaultPinDef(kiriPinDef* def);
kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin);
kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin);
kiriResult kiriSheet_ClampLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2], kiriPin* clamp);
kiriResult kiriSheet_HingeLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2], kiriPin* hinge);
kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3]);
kiriResult kiriPin_SetPose(kiriWorld* world, kiriPin pin, const float target[3], const float rotation[9]);
kiriResult kiriPin_SetBreakForce(kiriWorld* world, kiriPin pin, float breakForce);
kiriResult kiriPin_GetState(const kiriWorld* world, kiriPin pin, kiriPinState* state);
kiriResult kiriPin_GetReaction(const kiriWorld* world, kiriPin pin, double force[3], double torque[3]);
kiriResult kiriSheet_GetPins(const kiriWorld* world, kiriSheet sheet, kiriPin* pins, int32_t capacity, int32_t* count);
void kiriDefaultSeamDef(kiriSeamDef* def);
kiriResult kiriCreateSeam(kiriWorld* world, const kiriSeamDef* def, kiriSeam* seam);
kiriResult kiriDestroySeam(kiriWorld* world, kiriSeam seam);
kiriResult kiriSeam_SetHinge(kiriWorld* world, kiriSeam seam, float stiffness, float restAngle);
kiriResult kiriSeam_GetStitch(const kiriWorld* world, kiriSeam seam, int32_t index, kiriStitch* stitch);
kiriResult kiriSeam_GetCount(const kiriWorld* world, kiriSeam seam, int32_t* stitches);
kiriResult kiriWorld_GetSeams(const kiriWorld* world, kiriSeam* seams, int32_t capacity, int32_t* count);
kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts, int32_t count);
kiriResult kiriSheet_GetContactForces(const kiriWorld* world, kiriSheet sheet, const kiriContactForce** forces, int32_t* count);
void kiriDefaultObstacleDef(kiriObstacleDef* def);
kiriResult kiriCreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle);
kiriResult kiriDestroyObstacle(kiriWorld* world, kiriObstacle obstacle);
kiriResult kiriObstacle_SetPose(kiriWorld* world, kiriObstacle obstacle, const float position[3], const float rotation[9]);
kiriResult kiriObstacle_SetVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3], const float angularVelocity[3]);
kiriResult kiriObstacle_SetSurfaceVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3]);
kiriResult kiriObstacle_SetMass(kiriWorld* world, kiriObstacle obstacle, float mass, const float inertia[6], const float centerOfMass[3]);
kiriResult kiriObstacle_GetState(const kiriWorld* world, kiriObstacle obstacle, kiriObstacleState* state);
kiriResult kiriSheet_GetReach(const kiriWorld* world, kiriSheet sheet, float dt, float lower[3], float upper[3]);
void kiriDefaultDebugDraw(kiriDebugDraw* draw);
kiriResult kiriWorld_DebugDraw(const kiriWorld* world, const kiriDebugDraw* draw);
"""
