--- Kiri 0.34.0 for LuaJIT: cuts thin sheets while they move. This one file and the shared library are all of it.
---
---     local kiri = require "kiri"
---     local world = kiri.World()
---     local sheet = world:createRectangle(1, 1, 16, 16, {frameCount = 9})
---     local cut = sheet:beginCut {-0.1, 0.5}
---     cut:extend {1.1, 0.5}
---     cut:finish()
---     world:tick(1 / 60, 1)
---     print(sheet:getCounts().pieces)
---
--- Names are those of kiri.h, without kiri and KIRI_: kiriSheet_GetMesh is sheet:getMesh, KIRI_EVENT_PIECE_OFF is
--- kiri.EVENT_PIECE_OFF. What C writes behind pointers is returned; what has nothing to return says whether work is
--- left (KIRI_PENDING). A def is a table of what is other than its default. Vectors and points are tables of numbers,
--- or arrays of C. A failure is an error with fields result, name and line.
---
--- Arrays are those of the library, without a copy: a[0] to a[#a - 1]. They end with the next tick: then they raise an
--- error. a:pointer() is what C has, and is not guarded. Structs can be given to be filled again: sheet:getMesh(mesh)
--- makes no garbage. kiri.C has the functions of C.
---
--- The library is looked for in $KIRI_LIBRARY, on package.cpath, beside this file, and where the system looks.

local ffi = require "ffi"
local jit = require "jit"

ffi.cdef [[
typedef struct kiriWorld kiriWorld;
typedef uint32_t kiriSheet;
typedef uint32_t kiriCut;
typedef uint32_t kiriFrame;
typedef uint32_t kiriPin;
typedef uint32_t kiriObstacle;
typedef uint32_t kiriBlade;
typedef uint32_t kiriSeam;
typedef int32_t kiriResult;
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
]]

local kiri = {VERSION = "0.34.0"}

kiri.OK = 0
kiri.PENDING = 1
kiri.ERROR_ARGUMENT = -1
kiri.ERROR_DEF = -2
kiri.ERROR_ID = -3
kiri.ERROR_MESH = -4
kiri.ERROR_STATE = -5
kiri.ERROR_MEMORY = -6
kiri.DIVERGED = -7
kiri.ERROR_LIMIT = -8
kiri.ERROR_BUILD = -9
kiri.ERROR_DATA = -10
kiri.ERROR_REPLAY = -11
kiri.ResultCode = {[0] = "OK", [1] = "PENDING", [-1] = "ERROR_ARGUMENT", [-2] = "ERROR_DEF", [-3] = "ERROR_ID", [-4] = "ERROR_MESH", [-5] = "ERROR_STATE", [-6] = "ERROR_MEMORY", [-7] = "DIVERGED", [-8] = "ERROR_LIMIT", [-9] = "ERROR_BUILD", [-10] = "ERROR_DATA", [-11] = "ERROR_REPLAY"}
kiri.LEAST_TRIANGLES = 16
kiri.MOST_NOTE_BYTES = 1048576
kiri.EVENT_CUT_FINISHED = 1
kiri.EVENT_PIECE_OFF = 2
kiri.EVENT_FRAME_ADDED = 3
kiri.EVENT_DIVERGED = 4
kiri.EVENT_DEFERRED = 5
kiri.EVENT_PIN_BROKE = 6
kiri.EVENT_PIECE_DETACHED = 7
kiri.EVENT_SEAM_BROKE = 8
kiri.EVENT_TEAR_BEGAN = 9
kiri.EVENT_TEAR_ENDED = 10
kiri.EVENT_STRAINED = 11
kiri.EventType = {[1] = "CUT_FINISHED", [2] = "PIECE_OFF", [3] = "FRAME_ADDED", [4] = "DIVERGED", [5] = "DEFERRED", [6] = "PIN_BROKE", [7] = "PIECE_DETACHED", [8] = "SEAM_BROKE", [9] = "TEAR_BEGAN", [10] = "TEAR_ENDED", [11] = "STRAINED"}
kiri.STAGE_CUT = 0
kiri.STAGE_GRID = 1
kiri.STAGE_REGIONS = 2
kiri.STAGE_SHAPE = 3
kiri.STAGE_SAMPLES = 4
kiri.STAGE_CONSTANTS = 5
kiri.STAGE_CONTACT = 6
kiri.STAGE_SOLVE = 7
kiri.STAGE_SKIN = 8
kiri.STAGE_COUNT = 9
kiri.Stage = {[0] = "CUT", [1] = "GRID", [2] = "REGIONS", [3] = "SHAPE", [4] = "SAMPLES", [5] = "CONSTANTS", [6] = "CONTACT", [7] = "SOLVE", [8] = "SKIN", [9] = "COUNT"}
kiri.MATERIAL_PAPER = 0
kiri.MATERIAL_COTTON = 1
kiri.MATERIAL_RUBBER = 2
kiri.MATERIAL_FOIL = 3
kiri.MATERIAL_CARD = 4
kiri.MATERIAL_SILK = 5
kiri.MATERIAL_SHIRTING = 6
kiri.MATERIAL_WOOL = 7
kiri.MATERIAL_DENIM = 8
kiri.MATERIAL_JERSEY = 9
kiri.MATERIAL_COUNT = 10
kiri.MaterialPreset = {[0] = "PAPER", [1] = "COTTON", [2] = "RUBBER", [3] = "FOIL", [4] = "CARD", [5] = "SILK", [6] = "SHIRTING", [7] = "WOOL", [8] = "DENIM", [9] = "JERSEY", [10] = "COUNT"}
kiri.QUALITY_FAST = 0
kiri.QUALITY_BALANCED = 1
kiri.QUALITY_ACCURATE = 2
kiri.QUALITY_COUNT = 3
kiri.QualityPreset = {[0] = "FAST", [1] = "BALANCED", [2] = "ACCURATE", [3] = "COUNT"}
kiri.SETUP_CURTAIN = 0
kiri.SETUP_PAPER = 1
kiri.SETUP_FLAG = 2
kiri.SETUP_RIBBON = 3
kiri.SETUP_RUBBER = 4
kiri.SETUP_CARD = 5
kiri.SETUP_FOIL = 6
kiri.SETUP_COUNT = 7
kiri.SetupPreset = {[0] = "CURTAIN", [1] = "PAPER", [2] = "FLAG", [3] = "RIBBON", [4] = "RUBBER", [5] = "CARD", [6] = "FOIL", [7] = "COUNT"}
kiri.MODEL_LINKS = 0
kiri.MODEL_AFFINE = 1
kiri.MODEL_POINTS = 2
kiri.Model = {[0] = "LINKS", [1] = "AFFINE", [2] = "POINTS"}
kiri.SKINNING_LINEAR = 0
kiri.SKINNING_SMOOTH = 1
kiri.Skinning = {[0] = "LINEAR", [1] = "SMOOTH"}
kiri.TIME_STEPPING_SECOND_ORDER = 0
kiri.TIME_STEPPING_EULER = 1
kiri.TimeStepping = {[0] = "SECOND_ORDER", [1] = "EULER"}
kiri.PIN_POINT = 0
kiri.PIN_HINGE = 1
kiri.PIN_CLAMP = 2
kiri.PinType = {[0] = "POINT", [1] = "HINGE", [2] = "CLAMP"}
kiri.OBSTACLE_PLANE = 0
kiri.OBSTACLE_SPHERE = 1
kiri.OBSTACLE_CAPSULE = 2
kiri.OBSTACLE_BOX = 3
kiri.OBSTACLE_CYLINDER = 4
kiri.OBSTACLE_PRISM = 5
kiri.ObstacleType = {[0] = "PLANE", [1] = "SPHERE", [2] = "CAPSULE", [3] = "BOX", [4] = "CYLINDER", [5] = "PRISM"}
kiri.DRAW_TRIANGLES = 1
kiri.DRAW_EDGES = 2
kiri.DRAW_BORDERS = 4
kiri.DRAW_FRAMES = 8
kiri.DRAW_LINKS = 16
kiri.DRAW_PINS = 32
kiri.DRAW_CONTACTS = 64
kiri.DRAW_BLADES = 128
kiri.DRAW_BOXES = 256
kiri.DRAW_OBSTACLES = 512
kiri.DRAW_POINTS = 1024
kiri.DRAW_ALL = 2047
kiri.DrawFlag = {[1] = "TRIANGLES", [2] = "EDGES", [4] = "BORDERS", [8] = "FRAMES", [16] = "LINKS", [32] = "PINS", [64] = "CONTACTS", [128] = "BLADES", [256] = "BOXES", [512] = "OBSTACLES", [1024] = "POINTS", [2047] = "ALL"}

-- ---- The library --------------------------------------------------------------------------------------------------

local file = ({Windows = "kiri.dll", OSX = "libkiri.dylib"})[ffi.os] or "libkiri.so"

local function load()
    local places, tried = {}, {}
    places[1] = os.getenv "KIRI_LIBRARY"
    places[#places + 1] = package.searchpath and package.searchpath("libkiri", package.cpath)
    local here = debug.getinfo(1, "S").source:match "^@(.*[/\\])" or "./"
    places[#places + 1] = here .. file
    local love = rawget(_G, "love")
    if love and love.filesystem then
        places[#places + 1] = love.filesystem.getSource() .. "/" .. file
        places[#places + 1] = love.filesystem.getSourceBaseDirectory() .. "/" .. file
    end
    places[#places + 1] = "kiri"
    for i = 1, #places do
        local found, library = pcall(ffi.load, places[i])
        if found then return library end
        tried[i] = library
    end
    error("kiri: the library is not found. `make lib` builds it, KIRI_LIBRARY says where it is\n" ..
          table.concat(tried, "\n"))
end

local C = load()
kiri.C = C
do
    local major, minor, patch = kiri.VERSION:match "(%d+)%.(%d+)%.(%d+)"
    if C.kiriGetVersion() ~= 10000 * major + 100 * minor + patch then
        error(("kiri: the library has version %d, this file %s"):format(C.kiriGetVersion(), kiri.VERSION))
    end
end

-- ---- What is shared by all worlds ---------------------------------------------------------------------------------

-- A world has a cell: how often its arrays have ended. It only grows. Cells of worlds that are gone are used again when
-- all have been used.
local CELLS = 65536
local now = ffi.new("uint32_t[?]", CELLS)
local worlds = setmetatable({}, {__mode = "v"}) -- by cell
local free_cells, next_cell = {}, 0

local new, out, room, structs = {}, {}, {}, {}

local function passed(world)
    if world.c then now[world.cell] = now[world.cell] + 1 end
end

-- An error with its place in the program: the first one that is not in this file.
local Error = {}
Error.__index = Error

function Error:__tostring()
    return self.message
end

local this_file = debug.getinfo(1, "S").source

-- A line of C begins with its name for the call, and ends with the code.
local function fail(world, call, result, changes)
    local line = world and not world.c and "the world is gone" or ""
    if world and world.c then
        line = changes and ffi.string(C.kiriWorld_GetLastError(world.c)) or world.said.line or ""
        world.said.line = nil
    end
    line = line:gsub("^kiri[%w_]+: ", ""):gsub(" %(KIRI_[%u_]+%)$", "")
    local level, place = 2, ""
    for i = 2, 8 do
        local info = debug.getinfo(i, "Sl")
        if info and info.source ~= this_file then
            place = info.currentline > 0 and ("%s:%d: "):format(info.short_src, info.currentline) or ""
            break
        end
    end
    local named = ffi.string(C.kiriGetResultName(result)):gsub("^KIRI_", "")
    error(setmetatable({result = result, name = named, line = line, call = call, message =
        ("%s%s: %s (%s)"):format(place, call, line ~= "" and line or ffi.string(C.kiriGetResultText(result)), named)},
        Error), level)
end

local function stale()
    error("this array has ended: its world has made another tick, or is gone", 3)
end

-- ---- From Lua to C ------------------------------------------------------------------------------------------------

local vectors = {}
for i = 1, 4 do vectors[i] = ffi.new("float[16]") end

local function vector(place, values, count)
    if type(values) == "cdata" then
        return values
    end
    local to = vectors[place]
    if type(values) ~= "table" or values[count + 1] ~= nil then
        error(("%d numbers are wanted"):format(count), 3)
    end
    for i = 1, count do
        local value = values[i]
        if type(value) ~= "number" then error(("%d numbers are wanted"):format(count), 3) end
        to[i - 1] = value
    end
    return to
end

local function id_of(world, thing, kind)
    if thing == nil then return 0 end
    if type(thing) ~= "table" or thing.kind ~= kind then error("a " .. kind .. " is wanted", 3) end
    if thing.world ~= world then error("this " .. kind .. " is of another world", 3) end
    return thing.id
end

local function flat(values, into)
    for i = 1, #values do
        if type(values[i]) == "table" then
            flat(values[i], into)
        else
            into[#into + 1] = values[i]
        end
    end
    return into
end

-- Arrays that grow, for what is given as a table. C has copied it when a call is done.
local grown = {}

local function array_for(item, count)
    local array = grown[item]
    if not array or array.size < count then
        array = {size = 2 * count, data = ffi.new(item .. "[?]", 2 * count)}
        grown[item] = array
    end
    return array.data
end

local fill

local function rows_of(values, count, item, width)
    if type(values) == "cdata" then
        return values, count or error("an array of C needs a count", 3)
    end
    if structs[item] then
        local array = array_for(item, #values)
        for i = 1, #values do
            ffi.fill(array[i - 1], ffi.sizeof(item))
            fill(array[i - 1], item, values[i])
        end
        return array, #values
    end
    local numbers = type(values[1]) == "table" and flat(values, {}) or values
    if #numbers % width ~= 0 then error(("%d numbers a row are wanted"):format(width), 3) end
    local array = array_for(item, #numbers)
    for i = 1, #numbers do array[i - 1] = numbers[i] end
    return array, #numbers / width
end

local function ids_of(world, things, count, item)
    if type(things) == "cdata" then
        return things, count or error("an array of C needs a count", 3)
    end
    local array = array_for(item, #things)
    for i = 1, #things do array[i - 1] = id_of(world, things[i], item:sub(5)) end
    return array, #things
end

local kept = {} -- until C has read it

-- Sets fields of a struct by name.
function fill(struct, name, values, world)
    local fields = structs[name].fields
    for key, value in pairs(values) do
        local kind = fields[key]
        if not kind then error(("%s has no field %s"):format(name, tostring(key)), 0) end
        if type(value) == "boolean" then
            struct[key] = value and 1 or 0
        elseif kind == "id" then
            struct[key] = type(value) == "table" and id_of(world, value, value.kind) or value
        elseif type(kind) == "number" and type(value) == "table" then
            if #value ~= kind then error(("%s.%s: %d numbers are wanted"):format(name, key, kind), 0) end
            for i = 1, kind do struct[key][i - 1] = value[i] end
        elseif type(kind) == "table" and type(value) == "table" then
            local numbers = flat(value, {})
            if #numbers % kind.width ~= 0 then error(("%s.%s: %d numbers a row are wanted"):format(name, key, kind.width), 0) end
            local array = ffi.new(kind.item .. "[?]", math.max(#numbers, 1), numbers)
            kept[#kept + 1] = array
            struct[key] = array
            if values[kind.count] == nil then
                struct[kind.count] = #numbers / kind.width
            elseif values[kind.count] ~= #numbers / kind.width then
                error(("%s.%s: %d rows are wanted"):format(name, key, values[kind.count]), 0)
            end
        elseif type(value) == "function" then
            error(("%s.%s: a function of C is wanted"):format(name, key), 0)
        elseif type(value) == "table" and structs[kind] then
            fill(struct[key], kind, value, world)
        else
            struct[key] = value
        end
    end
    return struct
end

local scratch = {}

-- A struct from a table of what is other than its default.
local function struct_of(world, values, name)
    if type(values) == "cdata" or values == nil and not structs[name].default then
        return values
    end
    for i = #kept, 1, -1 do kept[i] = nil end
    local struct = scratch[name] or ffi.new(name)
    scratch[name] = struct
    if structs[name].default then
        C[structs[name].default](struct)
    else
        ffi.fill(struct, ffi.sizeof(name))
    end
    return fill(struct, name, values or {}, world)
end

-- ---- From C to Lua ------------------------------------------------------------------------------------------------

-- The same thing is the same table, as long as somebody has it.
local function handle(world, id, kind)
    if id == 0 then return nil end
    local thing = world.things[id]
    if not thing then
        thing = setmetatable({world = world, id = id, kind = kind}, world.classes[kind])
        world.things[id] = thing
    end
    return thing
end

local function list_of(world, array, count, kind, none)
    local list = {}
    for i = 1, count do
        local value = array[i - 1]
        if kind then value = handle(world, value, kind) end
        if value == nil then value = none end
        list[i] = value
    end
    return list
end

local function make_room(size)
    room.size = size
    for _, item in ipairs {"kiriSheet", "kiriFrame", "kiriPin", "float"} do
        room[item] = ffi.new(item .. "[?]", size)
    end
    room.float2 = ffi.new("float[?]", 2 * size)
end
make_room(64)

-- Arrays of the library. `named`: they have ids of this kind; `fields`: they have structs, with ids in some fields.
local function array_type(item, named, fields)
    local name = item .. "Array"
    ffi.cdef(("typedef struct { const %s* data; int32_t count, width; uint32_t world, epoch; } %s;"):format(item, name))
    local row
    if fields then
        ffi.cdef(("typedef struct { const %s* data; uint32_t world, epoch; } %sRow;"):format(item, item))
        row = ffi.metatype(item .. "Row", {__index = function(self, key)
            if now[self.world] ~= self.epoch then stale() end
            local kind = fields[key]
            if kind then return handle(worlds[self.world], self.data[key], kind) end
            return self.data[key]
        end})
    end
    local Array = {}
    function Array:pointer()
        if now[self.world] ~= self.epoch then stale() end
        return self.data
    end
    function Array:copy(destination)
        ffi.copy(destination, self:pointer(), self.count * self.width * ffi.sizeof(item))
    end
    function Array:totable()
        local values = {}
        for i = 0, #self - 1 do values[i + 1] = self[i] end
        return values
    end
    local function each(array, i)
        i = i + 1
        if i < #array then return i, array[i] end
    end
    function Array:each()
        return each, self, -1
    end
    new[name] = ffi.metatype(name, {
        __len = function(self) return self.count * self.width end,
        __index = function(self, key)
            if type(key) ~= "number" then return Array[key] end
            if now[self.world] ~= self.epoch then stale() end
            if key < 0 or key >= self.count * self.width then error("index out of the array", 2) end
            if row then return row(self.data + key, self.world, self.epoch) end
            if named then return handle(worlds[self.world], self.data[key], named) end
            return self.data[key]
        end,
    })
    out[item .. "Rows"] = ffi.new("const " .. item .. "*[1]")
end

-- Structs that have such arrays, or ids.
local function view_type(name, fields)
    ffi.cdef(("typedef struct { %s c; uint32_t world, epoch; } %sView;"):format(name, name))
    new[name .. "View"] = ffi.metatype(name .. "View", {__index = function(self, key)
        local field = fields[key]
        if not field then return self.c[key] end
        if not field[2] then return handle(worlds[self.world], self.c[key], field[1]) end
        if now[self.world] ~= self.epoch then stale() end
        if self.c[key] == nil and self.c[field[2]] > 0 then return nil end
        return new[field[1] .. "Array"](self.c[key], self.c[field[2]], field[3], self.world, self.epoch)
    end})
end

structs.kiriBudget = {fields = {triangles = "number", cells = "number", samples = "number", iterations = "number"}}
structs.kiriWorldDef = {fields = {cookie = "number", gravity = 3, budget = "kiriBudget", alloc = "callback", free = "callback", log = "callback", clock = "callback", startTask = "callback", finishTask = "callback", workerCount = "number", user = "pointer", record = "callback", recordHashTicks = "number"}, default = "kiriDefaultWorldDef"}
structs.kiriReplay = {fields = {offset = "number", calls = "number", ticks = "number", note = {item = "void", count = "noteCount", width = 1}, noteCount = "number"}}
structs.kiriEvent = {fields = {type = "number", sheet = "id", cut = "id", frame = "id", pin = "id", crumb = "number", area = "number", stage = "number", waiting = "number", seam = "id", stitches = "number"}}
structs.kiriProfile = {fields = {seconds = 9, cutSegments = "number", trianglesSplit = "number", cellsSettled = "number", samplesRefreshed = "number", solverIterations = "number", cellsChanged = "number", weightsChanged = "number", verticesChanged = "number", pointsChanged = "number", linksChanged = "number", commits = "number", systemsSolved = "number", contacts = "number", sheetPairs = "number", largestJump = "number", largestFade = "number"}}
structs.kiriMaterial = {fields = {youngsModulus = "number", poissonsRatio = "number", thickness = "number", density = "number", airDamping = "number", flexDamping = "number", yieldStress = "number", hardening = "number", slack = "number", detail = "number", restCurvature = 3}}
structs.kiriQuality = {fields = {framesAlong = "number", gridResolution = "number", iterations = "number", substeps = "number"}}
structs.kiriPaperOptions = {fields = {fromScratch = "number", popping = "number", linearWeights = "number", integrationPoints = "number", integrationOrder = "number"}}
structs.kiriSheetDef = {fields = {cookie = "number", restPositions = {item = "float", count = "vertexCount", width = 2}, vertexCount = "number", indices = {item = "int32_t", count = "triangleCount", width = 3}, triangleCount = "number", position = 3, axisU = 3, axisV = 3, velocity = 3, material = "kiriMaterial", gridResolution = "number", snapDistance = "number", weldDistance = "number", frameCount = "number", frameLength = "number", accuracy = "number", framePoints = {item = "float", count = "frameCount", width = 2}, maxFrames = "number", rigidWeight = "number", rigidArea = "number", crumbArea = "number", friction = "number", contactThickness = "number", groups = "number", touchesSheets = "number", selfContact = "number", collisionPoints = "number", iterations = "number", sleepSpeed = "number", model = "number", skinning = "number", planar = "number", timeStepping = "number", fadeTime = "number", normals = "number", paper = "kiriPaperOptions"}, default = "kiriDefaultSheetDef"}
structs.kiriSheetSettings = {fields = {cookie = "number", material = "kiriMaterial", maxFrames = "number", crumbArea = "number", friction = "number", contactThickness = "number", groups = "number", touchesSheets = "number", selfContact = "number", iterations = "number", sleepSpeed = "number", skinning = "number", timeStepping = "number", fadeTime = "number", normals = "number"}}
structs.kiriFold = {fields = {from = 2, to = 2, stiffness = "number", restAngle = "number", yieldMoment = "number"}}
structs.kiriFoldState = {fields = {fold = "kiriFold", angle = "number", length = "number"}}
structs.kiriMesh = {fields = {positions = {item = "float", count = "vertexCount", width = 3}, normals = {item = "float", count = "vertexCount", width = 3}, restPositions = {item = "float", count = "vertexCount", width = 2}, indices = {item = "int32_t", count = "triangleCount", width = 3}, sourceTriangles = {item = "int32_t", count = "vertexCount", width = 1}, sourceWeights = {item = "float", count = "vertexCount", width = 3}, vertexCount = "number", triangleCount = "number", revision = "number"}}
structs.kiriRange = {fields = {first = "number", count = "number"}}
structs.kiriDirty = {fields = {newVertices = "kiriRange", newTriangles = "kiriRange", oldVertices = "kiriRange", oldTriangles = "kiriRange", revision = "number"}}
structs.kiriSolid = {fields = {positions = {item = "float", count = "vertexCount", width = 3}, normals = {item = "float", count = "vertexCount", width = 3}, restPositions = {item = "float", count = "vertexCount", width = 2}, indices = {item = "int32_t", count = "triangleCount", width = 3}, sources = {item = "int32_t", count = "vertexCount", width = 1}, vertexCount = "number", triangleCount = "number", rimTriangle = "number"}}
structs.kiriCounts = {fields = {vertices = "number", triangles = "number", cells = "number", frames = "number", links = "number", pieces = "number", collisionPoints = "number"}}
structs.kiriTotals = {fields = {area = "number", mass = "number", kineticEnergy = "number", elasticEnergy = "number", center = 3, momentum = 3, angularMomentum = 3}}
structs.kiriHit = {fields = {restPoint = 2, position = 3, normal = 3, distance = "number", triangle = "number"}}
structs.kiriPointState = {fields = {position = 3, normal = 3, velocity = 3, frame = "id"}}
structs.kiriPieceState = {fields = {area = "number", mass = "number", center = 3, momentum = 3, angularMomentum = 3, lower = 3, upper = 3, frames = "number", vertices = "number", triangles = "number", collisionPoints = "number", crumb = "number", asleep = "number"}}
structs.kiriPieceMesh = {fields = {vertices = {item = "int32_t", count = "vertexCount", width = 1}, triangles = {item = "int32_t", count = "triangleCount", width = 1}, indices = {item = "int32_t", count = "triangleCount", width = 3}, collisionPoints = {item = "int32_t", count = "collisionPointCount", width = 1}, vertexCount = "number", triangleCount = "number", collisionPointCount = "number"}}
structs.kiriTearing = {fields = {toughness = "number", strength = "number", grain = 2, grainRatio = "number", maxSpeed = "number", maxTips = "number"}}
structs.kiriFrameState = {fields = {restPoint = 2, position = 3, rotation = 9, velocity = 3, angularVelocity = 3, area = "number", mass = "number", held = "number"}}
structs.kiriWind = {fields = {velocity = 3, density = "number", drag = "number", lift = "number"}}
structs.kiriPinDef = {fields = {cookie = "number", restPoint = 2, target = 3, stiffness = "number", breakForce = "number", obstacle = "id"}, default = "kiriDefaultPinDef"}
structs.kiriPinState = {fields = {type = "number", sheet = "id", from = 2, to = 2, target = 3, rotation = 9, breakForce = "number", obstacle = "id"}}
structs.kiriSeamDef = {fields = {cookie = "number", sheetA = "id", sheetB = "id", lineA = {item = "float", count = "countA", width = 2}, lineB = {item = "float", count = "countB", width = 2}, countA = "number", countB = "number", stitches = "number", stiffness = "number", restAngle = "number", breakForce = "number"}, default = "kiriDefaultSeamDef"}
structs.kiriStitch = {fields = {sheetA = "id", sheetB = "id", restA = 2, restB = 2, position = 3, gap = "number", force = 3, angle = "number"}}
structs.kiriContact = {fields = {point = "number", restPoint = 2, normal = 3, offset = "number", velocity = 3, friction = "number", inverseMass = "number", pushSpeed = "number", obstacle = "number"}}
structs.kiriContactForce = {fields = {impulse = 3, position = 3, depth = "number", point = "number", obstacle = "number"}}
structs.kiriObstacleDef = {fields = {cookie = "number", type = "number", size = 3, radius = "number", height = "number", outline = {item = "float", count = "outlineCount", width = 2}, outlineCount = "number", rounding = "number", position = 3, rotation = 9, velocity = 3, angularVelocity = 3, surfaceVelocity = 3, friction = "number", mass = "number", inertia = 6, centerOfMass = 3, body = "number", pushSpeed = "number", groups = "number"}, default = "kiriDefaultObstacleDef"}
structs.kiriObstacleState = {fields = {position = 3, rotation = 9, velocity = 3, angularVelocity = 3, impulse = 3, angularImpulse = 3, contacts = "number"}}
structs.kiriDrawVertex = {fields = {position = 3, color = "number"}}
structs.kiriDebugDraw = {fields = {cookie = "number", flags = "number", sheet = "id", size = "number", points = "callback", lines = "callback", triangles = "callback", user = "pointer"}, default = "kiriDefaultDebugDraw"}

array_type("kiriFrame", "Frame", nil)
array_type("kiriEvent", nil, {sheet = "Sheet", cut = "Cut", frame = "Frame", pin = "Pin", seam = "Seam"})
array_type("kiriContactForce", nil, {})
array_type("int32_t", nil, nil)
array_type("float", nil, nil)
view_type("kiriMesh", {positions = {"float", "vertexCount", 3}, normals = {"float", "vertexCount", 3}, restPositions = {"float", "vertexCount", 2}, indices = {"int32_t", "triangleCount", 3}, sourceTriangles = {"int32_t", "vertexCount", 1}, sourceWeights = {"float", "vertexCount", 3}})
view_type("kiriSolid", {positions = {"float", "vertexCount", 3}, normals = {"float", "vertexCount", 3}, restPositions = {"float", "vertexCount", 2}, indices = {"int32_t", "triangleCount", 3}, sources = {"int32_t", "vertexCount", 1}})
view_type("kiriPointState", {frame = {"Frame"}})
view_type("kiriPieceMesh", {vertices = {"int32_t", "vertexCount", 1}, triangles = {"int32_t", "triangleCount", 1}, indices = {"int32_t", "triangleCount", 3}, collisionPoints = {"int32_t", "collisionPointCount", 1}})
view_type("kiriPinState", {sheet = {"Sheet"}, obstacle = {"Obstacle"}})
view_type("kiriStitch", {sheetA = {"Sheet"}, sheetB = {"Sheet"}})

for name in pairs(structs) do
    new[name] = new[name] or ffi.typeof(name)
    kiri[name:sub(5)] = new[name]
end
for _, item in ipairs {"int32_t", "int64_t", "uint64_t", "double"} do
    out[item] = ffi.new(item .. "[1]")
end
local KINDS = {"World", "Sheet", "Cut", "Frame", "Pin", "Obstacle", "Blade", "Seam"}
for i = 2, #KINDS do
    out[KINDS[i]] = ffi.new("kiri" .. KINDS[i] .. "[1]")
end

-- ---- Classes ------------------------------------------------------------------------------------------------------

local core = {C = C, ffi = ffi, now = now, new = new, out = out, room = room, fail = fail, passed = passed,
              vector = vector, id_of = id_of, ids_of = ids_of, rows_of = rows_of, struct_of = struct_of,
              handle = handle, list_of = list_of, make_room = make_room}

-- It has no locals of this file, so that there can be two of it: see hooked.
local function define(core, kiri, World, Sheet, Cut, Frame, Pin, Obstacle, Blade, Seam)
local C, ffi, now, new, out, room, fail, passed = core.C, core.ffi, core.now, core.new, core.out, core.room, core.fail,
    core.passed
local vector, id_of, ids_of, rows_of, struct_of, handle, list_of, make_room = core.vector, core.id_of, core.ids_of,
    core.rows_of, core.struct_of, core.handle, core.list_of, core.make_room

--- Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
function kiri.getVersion()
    return C.kiriGetVersion()
end

--- Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
function kiri.getResultName(result)
    return ffi.string(C.kiriGetResultName(result))
end

--- Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
function kiri.getResultText(result)
    return ffi.string(C.kiriGetResultText(result))
end

--- Fill the def; create an empty world (def null: the defaults; on failure *world is null, and the log gets the
--- line); free it (null: nothing). KIRI_ERROR_BUILD: the compiler, or a mode of this thread, changes float operations
--- (manual, budget).
function kiri.defaultWorldDef(def)
    def = def or new.kiriWorldDef()
    C.kiriDefaultWorldDef(def)
    return def
end

--- Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the pending cut
--- points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that still have work.
--- KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget). KIRI_ERROR_LIMIT: no ids
--- are left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED: events name sheets that were
--- stopped.
function World:tick(dt, substeps)
    local world = self
    local result = C.kiriWorld_Tick(world.c, dt, substeps)
    passed(world)
    if result < 0 then fail(world, "World:tick", result, true) end
    return result == 1
end

--- Returns the line of the last function that changes the world, if it failed; else "". Valid until the next one.
function World:getLastError()
    local world = self
    return ffi.string(C.kiriWorld_GetLastError(world.c))
end

--- Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing
--- wakes. Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not fit a
--- float.
function World:shiftOrigin(origin)
    local world = self
    local result = C.kiriWorld_ShiftOrigin(world.c, vector(1, origin, 3))
    if result < 0 then fail(world, "World:shiftOrigin", result, true) end
    return result == 1
end

--- Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
function World:setGravity(gravity)
    local world = self
    local result = C.kiriWorld_SetGravity(world.c, vector(1, gravity, 3))
    if result < 0 then fail(world, "World:setGravity", result, true) end
    return result == 1
end

--- Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
function World:setBudget(budget)
    local world = self
    local result = C.kiriWorld_SetBudget(world.c, struct_of(world, budget, "kiriBudget"))
    if result < 0 then fail(world, "World:setBudget", result, true) end
    return result == 1
end

--- Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual, budget).
function World:getStateHash()
    local world = self
    local result = C.kiriWorld_GetStateHash(world.c, out.uint64_t)
    if result < 0 then fail(world, "World:getStateHash", result, false) end
    local hash = out.uint64_t[0]
    return hash
end

--- Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are.
function World:getSheets()
    local world = self
    local result = C.kiriWorld_GetSheets(world.c, room.kiriSheet, room.size, out.int32_t)
    if result < 0 then fail(world, "World:getSheets", result, false) end
    if out.int32_t[0] > room.size then make_room(out.int32_t[0]) return World.getSheets(self) end
    return list_of(world, room.kiriSheet, out.int32_t[0], "Sheet")
end

--- Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A replay stops there.
function World:note(bytes, count)
    local world = self
    count = count or #bytes
    local result = C.kiriWorld_Note(world.c, bytes, count)
    if result < 0 then fail(world, "World:note", result, true) end
    return result == 1
end

--- Makes the calls of a recording up to the next tick or note, included. The world must be new; hooks stay the
--- host's. KIRI_PENDING: more calls follow. KIRI_OK: the recording ended. KIRI_ERROR_REPLAY: a call gave another
--- result, other ids or another state; the line names it, and the next call goes on behind it. KIRI_ERROR_DATA: not a
--- recording, damaged, cut short, or of another version. KIRI_ERROR_STATE: the world is not new. KIRI_ERROR_MEMORY:
--- start again.
function World:replay(recording, replay, size)
    local world = self
    size = size or #recording
    local result = C.kiriWorld_Replay(world.c, recording, size, replay)
    passed(world)
    if result < 0 then fail(world, "World:replay", result, true) end
    return result == 1
end

--- Writes the world to memory with room for `capacity`; bytes null: only counts them. *size: bytes of the save.
--- KIRI_ERROR_ARGUMENT: `capacity` is less. KIRI_PENDING: a cut is pending (kiriWorld_FinishCuts); *size is 0.
function World:save(bytes, capacity)
    local world = self
    local result = C.kiriWorld_Save(world.c, bytes, capacity or 0, out.int64_t)
    if result < 0 then fail(world, "World:save", result, false) end
    if bytes then return tonumber(out.int64_t[0]) end
    bytes = ffi.new("uint8_t[?]", out.int64_t[0])
    local size = self:save(bytes, out.int64_t[0])
    return ffi.string(bytes, size)
end

--- Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports the
--- events. Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
--- kiriWorld_Tick.
function World:finishCuts()
    local world = self
    local result = C.kiriWorld_FinishCuts(world.c)
    if result < 0 then fail(world, "World:finishCuts", result, true) end
    return result == 1
end

--- Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a malicious save cannot
--- crash the program, and takes memory in proportion to its size, which is below 2^31. Old arrays live until the next
--- tick. On failure nothing has changed: KIRI_ERROR_DATA: not a save, damaged, or of another version.
--- KIRI_ERROR_MEMORY.
function World:load(bytes, size)
    local world = self
    size = size or #bytes
    local result = C.kiriWorld_Load(world.c, bytes, size)
    if result < 0 then fail(world, "World:load", result, true) end
    return result == 1
end

--- For rollback: copies all of the world, also work in progress, into memory of the host; much faster than a save,
--- and exact to the bit. For this process only: never store or send the bytes. bytes null: as of kiriWorld_Save.
function World:snapshot(bytes, capacity)
    local world = self
    local result = C.kiriWorld_Snapshot(world.c, bytes, capacity or 0, out.int64_t)
    if result < 0 then fail(world, "World:snapshot", result, false) end
    if bytes then return tonumber(out.int64_t[0]) end
    bytes = ffi.new("uint8_t[?]", out.int64_t[0])
    local size = self:snapshot(bytes, out.int64_t[0])
    return ffi.string(bytes, size)
end

--- Replaces the world by the world of the snapshot, as kiriWorld_Load does. The bytes are trusted. On failure nothing
--- has changed: KIRI_ERROR_DATA: no snapshot of this build. KIRI_ERROR_STATE: it is recorded. KIRI_ERROR_MEMORY.
function World:restore(bytes, size)
    local world = self
    size = size or #bytes
    local result = C.kiriWorld_Restore(world.c, bytes, size)
    if result < 0 then fail(world, "World:restore", result, true) end
    return result == 1
end

--- Gets the events: *events points to *count of them.
function World:getEvents()
    local world = self
    local result = C.kiriWorld_GetEvents(world.c, out.kiriEventRows, out.int32_t)
    if result < 0 then fail(world, "World:getEvents", result, false) end
    return new.kiriEventArray(out.kiriEventRows[0], out.int32_t[0], 1, world.cell, now[world.cell])
end

--- Gets the profile of the last tick that was not refused.
function World:getProfile(profile)
    local world = self
    profile = profile or new.kiriProfile()
    local result = C.kiriWorld_GetProfile(world.c, profile)
    if result < 0 then fail(world, "World:getProfile", result, false) end
    return profile
end

--- Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum of several: half for
--- cuts, half for motion; all if it has one alone. Limits without recorded work stay. A replay must set the same
--- budgets.
function kiri.fitBudget(profile, microseconds, budget)
    local result = C.kiriFitBudget(struct_of(nil, profile, "kiriProfile"), microseconds, budget)
    if result < 0 then fail(nil, "fitBudget", result, false) end
    return result == 1
end

--- Returns the name of a stage; "" for another number.
function kiri.getStageName(stage)
    return ffi.string(C.kiriGetStageName(stage))
end

--- Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
function kiri.getMaterial(preset, material)
    material = material or new.kiriMaterial()
    local result = C.kiriGetMaterial(preset, material)
    if result < 0 then fail(nil, "getMaterial", result, false) end
    return material
end

--- Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
function kiri.getQuality(preset, quality)
    quality = quality or new.kiriQuality()
    local result = C.kiriGetQuality(preset, quality)
    if result < 0 then fail(nil, "getQuality", result, false) end
    return quality
end

--- Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
--- failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
function kiri.defaultSheetDef(def)
    def = def or new.kiriSheetDef()
    C.kiriDefaultSheetDef(def)
    return def
end

--- Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
--- failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
function World:createSheet(def)
    local world = self
    local result = C.kiriCreateSheet(world.c, struct_of(world, def, "kiriSheetDef"), out.Sheet)
    if result < 0 then fail(world, "World:createSheet", result, true) end
    return handle(world, out.Sheet[0], "Sheet")
end

--- Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
--- failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
function Sheet:destroy()
    local world = self.world
    local result = C.kiriDestroySheet(world.c, self.id)
    if result < 0 then fail(world, "Sheet:destroy", result, true) end
    return result == 1
end

--- Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of sheet and
--- its sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual, accuracy).
function kiri.getSetup(preset, width, height, def)
    def = def or new.kiriSheetDef()
    local result = C.kiriGetSetup(preset, width, height, def)
    if result < 0 then fail(nil, "getSetup", result, false) end
    return def
end

--- Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns or
--- rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def null: the
--- defaults.
function World:createRectangle(width, height, columns, rows, def)
    local world = self
    local result = C.kiriCreateRectangle(world.c, width, height, columns, rows, struct_of(world, def, "kiriSheetDef"), out.Sheet)
    if result < 0 then fail(world, "World:createRectangle", result, true) end
    return handle(world, out.Sheet[0], "Sheet")
end

--- Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not
--- come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
function Sheet:getSettings(settings)
    local world = self.world
    settings = settings or new.kiriSheetSettings()
    local result = C.kiriSheet_GetSettings(world.c, self.id, settings)
    if result < 0 then fail(world, "Sheet:getSettings", result, false) end
    return settings
end

--- Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not
--- come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
function Sheet:setSettings(settings)
    local world = self.world
    local result = C.kiriSheet_SetSettings(world.c, self.id, struct_of(world, settings, "kiriSheetSettings"))
    if result < 0 then fail(world, "Sheet:setSettings", result, true) end
    return result == 1
end

--- Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no material at
--- one.
function World:createFoldedSheet(def, folds, count)
    local world = self
    folds, count = rows_of(folds, count, "kiriFold", 1)
    local result = C.kiriCreateFoldedSheet(world.c, struct_of(world, def, "kiriSheetDef"), folds, count, out.Sheet)
    if result < 0 then fail(world, "World:createFoldedSheet", result, true) end
    return handle(world, out.Sheet[0], "Sheet")
end

--- Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
--- KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet.
function Sheet:addFold(fold)
    local world = self.world
    local result = C.kiriSheet_AddFold(world.c, self.id, struct_of(world, fold, "kiriFold"), out.int32_t)
    if result < 0 then fail(world, "Sheet:addFold", result, true) end
    local index = out.int32_t[0]
    return index
end

--- A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet.
function Sheet:getFold(index, state)
    local world = self.world
    state = state or new.kiriFoldState()
    local result = C.kiriSheet_GetFold(world.c, self.id, index, state)
    if result < 0 then fail(world, "Sheet:getFold", result, false) end
    return state
end

--- A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet.
function Sheet:setFold(index, stiffness, restAngle)
    local world = self.world
    local result = C.kiriSheet_SetFold(world.c, self.id, index, stiffness, restAngle)
    if result < 0 then fail(world, "Sheet:setFold", result, true) end
    return result == 1
end

--- Fills in the mesh of kiriCreateRectangle: 2 (columns + 1) (rows + 1) floats and 6 columns rows indices.
function kiri.fillRectangle(width, height, columns, rows, restPositions, indices)
    restPositions = restPositions or ffi.new("float[?]", 2 * (columns + 1) * (rows + 1))
    indices = indices or ffi.new("int32_t[?]", 6 * columns * rows)
    local result = C.kiriFillRectangle(width, height, columns, rows, restPositions, indices)
    if result < 0 then fail(nil, "fillRectangle", result, false) end
    return restPositions, indices
end

--- Gets the arrays, without a copy.
function Sheet:getMesh(mesh)
    local world = self.world
    mesh = mesh or new.kiriMeshView()
    local result = C.kiriSheet_GetMesh(world.c, self.id, mesh.c)
    if result < 0 then fail(world, "Sheet:getMesh", result, false) end
    mesh.world, mesh.epoch = world.cell, now[world.cell]
    return mesh
end

--- Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore.
function Sheet:getDirty(sinceRevision, dirty)
    local world = self.world
    dirty = dirty or new.kiriDirty()
    local result = C.kiriSheet_GetDirty(world.c, self.id, sinceRevision, dirty)
    if result < 0 then fail(world, "Sheet:getDirty", result, false) end
    return dirty
end

--- Copies 3 floats each; positions or normals null: none. Strides: 12 bytes or more. KIRI_ERROR_STATE: no normals.
function Sheet:copyVertices(first, count, positions, positionStride, normals, normalStride)
    local world = self.world
    local result = C.kiriSheet_CopyVertices(world.c, self.id, first, count, positions, positionStride, normals, normalStride)
    if result < 0 then fail(world, "Sheet:copyVertices", result, false) end
    return result == 1
end

--- Copies the index that each vertex had when the last tick began, to draw between two ticks; -1: it did not exist.
--- *from: the sheet that had them then. A vertex that a cut separated has the other's index (manual, drawing).
function Sheet:copyPrevious(first, count, vertices)
    local world = self.world
    vertices = vertices or ffi.new("int32_t[?]", count)
    local result = C.kiriSheet_CopyPrevious(world.c, self.id, first, count, vertices, out.Sheet)
    if result < 0 then fail(world, "Sheet:copyPrevious", result, false) end
    return vertices, handle(world, out.Sheet[0], "Sheet")
end

--- Copies indices of some triangles as 16-bit numbers, 3 each. KIRI_ERROR_STATE: there are more than 65535 vertices.
function Sheet:copyIndices16(firstTriangle, count, indices)
    local world = self.world
    indices = indices or ffi.new("uint16_t[?]", 3 * count)
    local result = C.kiriSheet_CopyIndices16(world.c, self.id, firstTriangle, count, indices)
    if result < 0 then fail(world, "Sheet:copyIndices16", result, false) end
    return indices
end

--- Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9
--- floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes).
function Sheet:copySources(firstTriangle, count, sources)
    local world = self.world
    sources = sources or ffi.new("int32_t[?]", count)
    local result = C.kiriSheet_CopySources(world.c, self.id, firstTriangle, count, sources)
    if result < 0 then fail(world, "Sheet:copySources", result, false) end
    return sources
end

--- Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9
--- floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes).
function Sheet:copySourceWeights(firstTriangle, count, weights)
    local world = self.world
    weights = weights or ffi.new("float[?]", 9 * count)
    local result = C.kiriSheet_CopySourceWeights(world.c, self.id, firstTriangle, count, weights)
    if result < 0 then fail(world, "Sheet:copySourceWeights", result, false) end
    return weights
end

--- Makes the solid surface, with a thickness in m; thickness 0: the material's.
function Sheet:getSolid(thickness, solid)
    local world = self.world
    solid = solid or new.kiriSolidView()
    local result = C.kiriSheet_GetSolid(world.c, self.id, thickness, solid.c)
    if result < 0 then fail(world, "Sheet:getSolid", result, true) end
    solid.world, solid.epoch = world.cell, now[world.cell]
    return solid
end

--- Gets the collision points: 3 floats of position (m, world) a point.
function Sheet:getCollisionPoints()
    local world = self.world
    local result = C.kiriSheet_GetCollisionPoints(world.c, self.id, out.floatRows, out.int32_t)
    if result < 0 then fail(world, "Sheet:getCollisionPoints", result, false) end
    return new.floatArray(out.floatRows[0], out.int32_t[0], 3, world.cell, now[world.cell])
end

--- Get the counts, at no cost; sum the totals over the frames.
function Sheet:getCounts(counts)
    local world = self.world
    counts = counts or new.kiriCounts()
    local result = C.kiriSheet_GetCounts(world.c, self.id, counts)
    if result < 0 then fail(world, "Sheet:getCounts", result, false) end
    return counts
end

--- Get the counts, at no cost; sum the totals over the frames.
function Sheet:getTotals(totals)
    local world = self.world
    totals = totals or new.kiriTotals()
    local result = C.kiriSheet_GetTotals(world.c, self.id, totals)
    if result < 0 then fail(world, "Sheet:getTotals", result, false) end
    return totals
end

--- Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not
--- KIRI_MODEL_LINKS.
function Sheet:estimateError()
    local world = self.world
    local result = C.kiriSheet_EstimateError(world.c, self.id, out.double)
    if result < 0 then fail(world, "Sheet:estimateError", result, false) end
    local relative = out.double[0]
    return relative
end

--- Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all.
function Sheet:isAwake()
    local world = self.world
    local result = C.kiriSheet_IsAwake(world.c, self.id, out.int32_t)
    if result < 0 then fail(world, "Sheet:isAwake", result, false) end
    local awake = out.int32_t[0] ~= 0
    return awake
end

--- Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all.
function Sheet:wake()
    local world = self.world
    local result = C.kiriSheet_Wake(world.c, self.id)
    if result < 0 then fail(world, "Sheet:wake", result, true) end
    return result == 1
end

--- Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar sheet
--- turns about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual, sheets).
function Sheet:transform(rotation, translation)
    local world = self.world
    local result = C.kiriSheet_Transform(world.c, self.id, vector(1, rotation, 9), vector(2, translation, 3))
    if result < 0 then fail(world, "Sheet:transform", result, true) end
    return result == 1
end

--- Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre
--- of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay
--- held.
function Sheet:setVelocity(velocity, angularVelocity)
    local world = self.world
    local result = C.kiriSheet_SetVelocity(world.c, self.id, vector(1, velocity, 3), vector(2, angularVelocity, 3))
    if result < 0 then fail(world, "Sheet:setVelocity", result, true) end
    return result == 1
end

--- Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre
--- of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay
--- held.
function Frame:setPieceVelocity(velocity, angularVelocity)
    local world = self.world
    local result = C.kiriFrame_SetPieceVelocity(world.c, self.id, vector(1, velocity, 3), vector(2, angularVelocity, 3))
    if result < 0 then fail(world, "Frame:setPieceVelocity", result, true) end
    return result == 1
end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
function Sheet:setUserData(data)
    local world = self.world
    local result = C.kiriSheet_SetUserData(world.c, self.id, data)
    if result < 0 then fail(world, "Sheet:setUserData", result, true) end
    return result == 1
end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
function Sheet:getUserData()
    local world = self.world
    local result = C.kiriSheet_GetUserData(world.c, self.id, out.uint64_t)
    if result < 0 then fail(world, "Sheet:getUserData", result, false) end
    local data = out.uint64_t[0]
    return data
end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
function Pin:setUserData(data)
    local world = self.world
    local result = C.kiriPin_SetUserData(world.c, self.id, data)
    if result < 0 then fail(world, "Pin:setUserData", result, true) end
    return result == 1
end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
function Pin:getUserData()
    local world = self.world
    local result = C.kiriPin_GetUserData(world.c, self.id, out.uint64_t)
    if result < 0 then fail(world, "Pin:getUserData", result, false) end
    local data = out.uint64_t[0]
    return data
end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
function Frame:setPieceUserData(data)
    local world = self.world
    local result = C.kiriFrame_SetPieceUserData(world.c, self.id, data)
    if result < 0 then fail(world, "Frame:setPieceUserData", result, true) end
    return result == 1
end

--- Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
--- piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
--- both.
function Frame:getPieceUserData()
    local world = self.world
    local result = C.kiriFrame_GetPieceUserData(world.c, self.id, out.uint64_t)
    if result < 0 then fail(world, "Frame:getPieceUserData", result, false) end
    local data = out.uint64_t[0]
    return data
end

--- Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not.
function Sheet:raycast(origin, direction, maxDistance, hit)
    local world = self.world
    hit = hit or new.kiriHit()
    local result = C.kiriSheet_Raycast(world.c, self.id, vector(1, origin, 3), vector(2, direction, 3), maxDistance, hit)
    if result < 0 then fail(world, "Sheet:raycast", result, false) end
    return hit
end

--- Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not.
function World:raycast(origin, direction, maxDistance, hit)
    local world = self
    hit = hit or new.kiriHit()
    local result = C.kiriWorld_Raycast(world.c, vector(1, origin, 3), vector(2, direction, 3), maxDistance, out.Sheet, hit)
    if result < 0 then fail(world, "World:raycast", result, false) end
    return handle(world, out.Sheet[0], "Sheet"), hit
end

--- Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the point.
function Sheet:getPoint(restPoint, state)
    local world = self.world
    state = state or new.kiriPointStateView()
    local result = C.kiriSheet_GetPoint(world.c, self.id, vector(1, restPoint, 2), state.c)
    if result < 0 then fail(world, "Sheet:getPoint", result, false) end
    state.world, state.epoch = world.cell, now[world.cell]
    return state
end

--- Gets the shape functions at a rest point: up to `capacity` frames with weights, sum 1, and gradients (2 floats,
--- 1/m; gradients null: none). *count: all. KIRI_ERROR_ARGUMENT: outside the sheet. KIRI_ERROR_STATE: a cut is
--- pending.
function Sheet:getWeights(restPoint)
    local world = self.world
    local result = C.kiriSheet_GetWeights(world.c, self.id, vector(1, restPoint, 2), room.kiriFrame, room.float, room.float2, room.size, out.int32_t)
    if result < 0 then fail(world, "Sheet:getWeights", result, false) end
    if out.int32_t[0] > room.size then make_room(out.int32_t[0]) return Sheet.getWeights(self, restPoint) end
    return list_of(world, room.kiriFrame, out.int32_t[0], "Frame"), list_of(world, room.float, out.int32_t[0], nil), list_of(world, room.float2, out.int32_t[0] * 2, nil)
end

--- Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index.
function Sheet:getPiece(piece, state)
    local world = self.world
    state = state or new.kiriPieceState()
    local result = C.kiriSheet_GetPiece(world.c, self.id, piece, state)
    if result < 0 then fail(world, "Sheet:getPiece", result, true) end
    return state
end

--- Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index.
function Sheet:getPieceMesh(piece, mesh)
    local world = self.world
    mesh = mesh or new.kiriPieceMeshView()
    local result = C.kiriSheet_GetPieceMesh(world.c, self.id, piece, mesh.c)
    if result < 0 then fail(world, "Sheet:getPieceMesh", result, true) end
    mesh.world, mesh.epoch = world.cell, now[world.cell]
    return mesh
end

--- Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.
function Sheet:getPieceFrames(piece)
    local world = self.world
    local result = C.kiriSheet_GetPieceFrames(world.c, self.id, piece, out.kiriFrameRows, out.int32_t)
    if result < 0 then fail(world, "Sheet:getPieceFrames", result, true) end
    return new.kiriFrameArray(out.kiriFrameRows[0], out.int32_t[0], 1, world.cell, now[world.cell])
end

--- Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.
function Frame:getPiece()
    local world = self.world
    local result = C.kiriFrame_GetPiece(world.c, self.id, out.int32_t)
    if result < 0 then fail(world, "Frame:getPiece", result, false) end
    local piece = out.int32_t[0]
    return piece
end

--- Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay with the
--- old sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut is pending, or
--- the budget lacks samples for the piece; *detached is 0, further cuts of the sheet wait, and
--- KIRI_EVENT_PIECE_DETACHED names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the sheet
--- (manual, cutting).
function Frame:detachPiece()
    local world = self.world
    local result = C.kiriFrame_DetachPiece(world.c, self.id, out.Sheet)
    if result < 0 then fail(world, "Frame:detachPiece", result, true) end
    return handle(world, out.Sheet[0], "Sheet")
end

--- Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles stay
--- with three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all of its
--- sheet.
function Frame:destroyPiece()
    local world = self.world
    local result = C.kiriFrame_DestroyPiece(world.c, self.id)
    if result < 0 then fail(world, "Frame:destroyPiece", result, true) end
    return result == 1
end

--- Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
--- KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
--- pending.
function World:detachPieces(frames, count)
    local world = self
    frames, count = ids_of(world, frames, count, "kiriFrame")
    local detached = ffi.new("kiriSheet[?]", count)
    local result = C.kiriWorld_DetachPieces(world.c, frames, count, detached)
    if result < 0 then fail(world, "World:detachPieces", result, true) end
    return list_of(world, detached, count, "Sheet", false)
end

--- Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
--- KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
--- pending.
function World:destroyPieces(frames, count)
    local world = self
    frames, count = ids_of(world, frames, count, "kiriFrame")
    local result = C.kiriWorld_DestroyPieces(world.c, frames, count)
    if result < 0 then fail(world, "World:destroyPieces", result, true) end
    return result == 1
end

--- Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. *count: their number.
function Sheet:dropCrumbs(area)
    local world = self.world
    local result = C.kiriSheet_DropCrumbs(world.c, self.id, area, out.int32_t)
    if result < 0 then fail(world, "Sheet:dropCrumbs", result, true) end
    local count = out.int32_t[0]
    return count
end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
function Sheet:beginCut(restPoint)
    local world = self.world
    local result = C.kiriBeginCut(world.c, self.id, vector(1, restPoint, 2), out.Cut)
    if result < 0 then fail(world, "Sheet:beginCut", result, true) end
    return handle(world, out.Cut[0], "Cut")
end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
function Cut:extend(restPoints, count)
    local world = self.world
    restPoints, count = rows_of(restPoints, count, "float", 2)
    local result = C.kiriCut_Extend(world.c, self.id, restPoints, count)
    if result < 0 then fail(world, "Cut:extend", result, true) end
    return result == 1
end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
function Cut:finish()
    local world = self.world
    local result = C.kiriCut_End(world.c, self.id)
    if result < 0 then fail(world, "Cut:finish", result, true) end
    return result == 1
end

--- Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
--- from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
--- cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
--- (KIRI_EVENT_CUT_FINISHED).
function Sheet:cut(restPoints, count)
    local world = self.world
    restPoints, count = rows_of(restPoints, count, "float", 2)
    local result = C.kiriSheet_Cut(world.c, self.id, restPoints, count, out.Cut)
    if result < 0 then fail(world, "Sheet:cut", result, true) end
    return handle(world, out.Cut[0], "Cut")
end

--- Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2], meets
--- the current sheet; past borders, so that it separates the parts that it crosses. The cut is already ended.
function Sheet:slice(blade)
    local world = self.world
    local result = C.kiriSheet_Slice(world.c, self.id, vector(1, blade, 12), out.Cut)
    if result < 0 then fail(world, "Sheet:slice", result, true) end
    return handle(world, out.Cut[0], "Cut")
end

--- Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
--- inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
function kiri.getTearing(preset, tearing)
    tearing = tearing or new.kiriTearing()
    local result = C.kiriGetTearing(preset, tearing)
    if result < 0 then fail(nil, "getTearing", result, false) end
    return tearing
end

--- Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
--- inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
function Sheet:setTearing(tearing)
    local world = self.world
    local result = C.kiriSheet_SetTearing(world.c, self.id, struct_of(world, tearing, "kiriTearing"))
    if result < 0 then fail(world, "Sheet:setTearing", result, true) end
    return result == 1
end

--- Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
--- inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
function Sheet:getTearing(tearing)
    local world = self.world
    tearing = tearing or new.kiriTearing()
    local result = C.kiriSheet_GetTearing(world.c, self.id, tearing)
    if result < 0 then fail(world, "Sheet:getTearing", result, false) end
    return tearing
end

--- Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a factor, 0 or
--- more: below 1 tears follow it, above 1 they stop there. The same points replace it. KIRI_ERROR_ARGUMENT: no
--- material.
function Sheet:setTearLine(restPoints, factor, count)
    local world = self.world
    restPoints, count = rows_of(restPoints, count, "float", 2)
    local result = C.kiriSheet_SetTearLine(world.c, self.id, restPoints, count, factor)
    if result < 0 then fail(world, "Sheet:setTearLine", result, true) end
    return result == 1
end

--- A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer, and
--- cuts on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting). `sheet` 0:
--- all.
function World:beginBlade(sheet)
    local world = self
    local result = C.kiriBeginBlade(world.c, id_of(world, sheet, "Sheet"), out.Blade)
    if result < 0 then fail(world, "World:beginBlade", result, true) end
    return handle(world, out.Blade[0], "Blade")
end

--- Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
--- each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
function Blade:moveEdge(from, to)
    local world = self.world
    local result = C.kiriBlade_MoveEdge(world.c, self.id, vector(1, from, 3), vector(2, to, 3))
    if result < 0 then fail(world, "Blade:moveEdge", result, true) end
    return result == 1
end

--- Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
--- each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
function Blade:moveRay(origin, direction, length)
    local world = self.world
    local result = C.kiriBlade_MoveRay(world.c, self.id, vector(1, origin, 3), vector(2, direction, 3), length)
    if result < 0 then fail(world, "Blade:moveRay", result, true) end
    return result == 1
end

--- Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
--- each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
function Blade:finish()
    local world = self.world
    local result = C.kiriBlade_End(world.c, self.id)
    if result < 0 then fail(world, "Blade:finish", result, true) end
    return result == 1
end

--- Writes up to `capacity` ids of the sheet's frames; *count is how many there are.
function Sheet:getFrames()
    local world = self.world
    local result = C.kiriSheet_GetFrames(world.c, self.id, room.kiriFrame, room.size, out.int32_t)
    if result < 0 then fail(world, "Sheet:getFrames", result, false) end
    if out.int32_t[0] > room.size then make_room(out.int32_t[0]) return Sheet.getFrames(self) end
    return list_of(world, room.kiriFrame, out.int32_t[0], "Frame")
end

--- Holds the frame: its rest point moves evenly to `position` (m, world) with `rotation` (columns as above) in the
--- next tick; position and rotation null: frees it. Material that held frames mostly carry moves through obstacles.
function Frame:hold(position, rotation)
    local world = self.world
    local result = C.kiriFrame_Hold(world.c, self.id, position and vector(1, position, 3), rotation and vector(2, rotation, 9))
    if result < 0 then fail(world, "Frame:hold", result, true) end
    return result == 1
end

--- Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
--- over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free
--- frame.
function Frame:getState(state)
    local world = self.world
    state = state or new.kiriFrameState()
    local result = C.kiriFrame_GetState(world.c, self.id, state)
    if result < 0 then fail(world, "Frame:getState", result, false) end
    return state
end

--- Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
--- over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free
--- frame.
function Frame:getReaction(force, torque)
    local world = self.world
    force = force or ffi.new("double[?]", 3)
    torque = torque or ffi.new("double[?]", 3)
    local result = C.kiriFrame_GetReaction(world.c, self.id, force, torque)
    if result < 0 then fail(world, "Frame:getReaction", result, false) end
    return force, torque
end

--- Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).
function Frame:applyForce(force, torque)
    local world = self.world
    local result = C.kiriFrame_ApplyForce(world.c, self.id, vector(1, force, 3), vector(2, torque, 3))
    if result < 0 then fail(world, "Frame:applyForce", result, true) end
    return result == 1
end

--- Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).
function Sheet:applyForce(restPoint, force, torque)
    local world = self.world
    local result = C.kiriSheet_ApplyForce(world.c, self.id, vector(1, restPoint, 2), vector(2, force, 3), vector(3, torque, 3))
    if result < 0 then fail(world, "Sheet:applyForce", result, true) end
    return result == 1
end

--- Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges
--- included. Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of kiriSheet_ClampLine.
function Sheet:applyLineLoad(from, to, forcePerLength)
    local world = self.world
    local result = C.kiriSheet_ApplyLineLoad(world.c, self.id, vector(1, from, 2), vector(2, to, 2), vector(3, forcePerLength, 3))
    if result < 0 then fail(world, "Sheet:applyLineLoad", result, true) end
    return result == 1
end

--- Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it.
function Sheet:applyPressure(pressure)
    local world = self.world
    local result = C.kiriSheet_ApplyPressure(world.c, self.id, pressure)
    if result < 0 then fail(world, "Sheet:applyPressure", result, true) end
    return result == 1
end

--- Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of the
--- frames that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the sheet.
function Sheet:applyImpulse(restPoint, impulse)
    local world = self.world
    local result = C.kiriSheet_ApplyImpulse(world.c, self.id, vector(1, restPoint, 2), vector(2, impulse, 3))
    if result < 0 then fail(world, "Sheet:applyImpulse", result, true) end
    return result == 1
end

--- Copies the wind; it blows until the next call.
function Sheet:setWind(wind)
    local world = self.world
    local result = C.kiriSheet_SetWind(world.c, self.id, struct_of(world, wind, "kiriWind"))
    if result < 0 then fail(world, "Sheet:setWind", result, true) end
    return result == 1
end

--- Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
function kiri.defaultPinDef(def)
    def = def or new.kiriPinDef()
    C.kiriDefaultPinDef(def)
    return def
end

--- Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
function Sheet:createPin(def)
    local world = self.world
    local result = C.kiriCreatePin(world.c, self.id, struct_of(world, def, "kiriPinDef"), out.Pin)
    if result < 0 then fail(world, "Sheet:createPin", result, true) end
    return handle(world, out.Pin[0], "Pin")
end

--- Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
function Pin:destroy()
    local world = self.world
    local result = C.kiriDestroyPin(world.c, self.id)
    if result < 0 then fail(world, "Pin:destroy", result, true) end
    return result == 1
end

--- Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material,
--- as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far
--- outside.
function Sheet:clampLine(from, to)
    local world = self.world
    local result = C.kiriSheet_ClampLine(world.c, self.id, vector(1, from, 2), vector(2, to, 2), out.Pin)
    if result < 0 then fail(world, "Sheet:clampLine", result, true) end
    return handle(world, out.Pin[0], "Pin")
end

--- Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material,
--- as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far
--- outside.
function Sheet:hingeLine(from, to)
    local world = self.world
    local result = C.kiriSheet_HingeLine(world.c, self.id, vector(1, from, 2), vector(2, to, 2), out.Pin)
    if result < 0 then fail(world, "Sheet:hingeLine", result, true) end
    return handle(world, out.Pin[0], "Pin")
end

--- Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
--- (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
--- moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
function Pin:setTarget(target)
    local world = self.world
    local result = C.kiriPin_SetTarget(world.c, self.id, vector(1, target, 3))
    if result < 0 then fail(world, "Pin:setTarget", result, true) end
    return result == 1
end

--- Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
--- (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
--- moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
function Pin:setPose(target, rotation)
    local world = self.world
    local result = C.kiriPin_SetPose(world.c, self.id, vector(1, target, 3), vector(2, rotation, 9))
    if result < 0 then fail(world, "Pin:setPose", result, true) end
    return result == 1
end

--- Sets the force (N) that breaks a pin of any type; 0: it never breaks.
function Pin:setBreakForce(breakForce)
    local world = self.world
    local result = C.kiriPin_SetBreakForce(world.c, self.id, breakForce)
    if result < 0 then fail(world, "Pin:setBreakForce", result, true) end
    return result == 1
end

--- Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it.
function Pin:getState(state)
    local world = self.world
    state = state or new.kiriPinStateView()
    local result = C.kiriPin_GetState(world.c, self.id, state.c)
    if result < 0 then fail(world, "Pin:getState", result, false) end
    state.world, state.epoch = world.cell, now[world.cell]
    return state
end

--- Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it.
function Pin:getReaction(force, torque)
    local world = self.world
    force = force or ffi.new("double[?]", 3)
    torque = torque or ffi.new("double[?]", 3)
    local result = C.kiriPin_GetReaction(world.c, self.id, force, torque)
    if result < 0 then fail(world, "Pin:getReaction", result, false) end
    return force, torque
end

--- Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are.
function Sheet:getPins()
    local world = self.world
    local result = C.kiriSheet_GetPins(world.c, self.id, room.kiriPin, room.size, out.int32_t)
    if result < 0 then fail(world, "Sheet:getPins", result, false) end
    if out.int32_t[0] > room.size then make_room(out.int32_t[0]) return Sheet.getPins(self) end
    return list_of(world, room.kiriPin, out.int32_t[0], "Pin")
end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
function kiri.defaultSeamDef(def)
    def = def or new.kiriSeamDef()
    C.kiriDefaultSeamDef(def)
    return def
end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
function World:createSeam(def)
    local world = self
    local result = C.kiriCreateSeam(world.c, struct_of(world, def, "kiriSeamDef"), out.Seam)
    if result < 0 then fail(world, "World:createSeam", result, true) end
    return handle(world, out.Seam[0], "Seam")
end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
function Seam:destroy()
    local world = self.world
    local result = C.kiriDestroySeam(world.c, self.id)
    if result < 0 then fail(world, "Seam:destroy", result, true) end
    return result == 1
end

--- Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
--- KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
function Seam:setHinge(stiffness, restAngle)
    local world = self.world
    local result = C.kiriSeam_SetHinge(world.c, self.id, stiffness, restAngle)
    if result < 0 then fail(world, "Seam:setHinge", result, true) end
    return result == 1
end

--- Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.
function Seam:getStitch(index, stitch)
    local world = self.world
    stitch = stitch or new.kiriStitchView()
    local result = C.kiriSeam_GetStitch(world.c, self.id, index, stitch.c)
    if result < 0 then fail(world, "Seam:getStitch", result, false) end
    stitch.world, stitch.epoch = world.cell, now[world.cell]
    return stitch
end

--- Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.
function Seam:getCount()
    local world = self.world
    local result = C.kiriSeam_GetCount(world.c, self.id, out.int32_t)
    if result < 0 then fail(world, "Seam:getCount", result, false) end
    local stitches = out.int32_t[0]
    return stitches
end

--- Writes up to `capacity` ids of the world's seams; *count is how many there are.
function World:getSeams()
    local world = self
    local result = C.kiriWorld_GetSeams(world.c, room.kiriSeam, room.size, out.int32_t)
    if result < 0 then fail(world, "World:getSeams", result, false) end
    if out.int32_t[0] > room.size then make_room(out.int32_t[0]) return World.getSeams(self) end
    return list_of(world, room.kiriSeam, out.int32_t[0], "Seam")
end

--- Sets the contacts of the next tick alone. One with point and obstacle of an earlier one starts with its impulse.
function Sheet:setContacts(contacts, count)
    local world = self.world
    contacts, count = rows_of(contacts, count, "kiriContact", 1)
    local result = C.kiriSheet_SetContacts(world.c, self.id, contacts, count)
    if result < 0 then fail(world, "Sheet:setContacts", result, true) end
    return result == 1
end

--- Gets one result for each contact that was set before the last tick, in that order. A sleeping piece presses on.
function Sheet:getContactForces()
    local world = self.world
    local result = C.kiriSheet_GetContactForces(world.c, self.id, out.kiriContactForceRows, out.int32_t)
    if result < 0 then fail(world, "Sheet:getContactForces", result, false) end
    return new.kiriContactForceArray(out.kiriContactForceRows[0], out.int32_t[0], 1, world.cell, now[world.cell])
end

--- Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
function kiri.defaultObstacleDef(def)
    def = def or new.kiriObstacleDef()
    C.kiriDefaultObstacleDef(def)
    return def
end

--- Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
function World:createObstacle(def)
    local world = self
    local result = C.kiriCreateObstacle(world.c, struct_of(world, def, "kiriObstacleDef"), out.Obstacle)
    if result < 0 then fail(world, "World:createObstacle", result, true) end
    return handle(world, out.Obstacle[0], "Obstacle")
end

--- Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
function Obstacle:destroy()
    local world = self.world
    local result = C.kiriDestroyObstacle(world.c, self.id)
    if result < 0 then fail(world, "Obstacle:destroy", result, true) end
    return result == 1
end

--- Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity), not to the jump.
function Obstacle:setPose(position, rotation)
    local world = self.world
    local result = C.kiriObstacle_SetPose(world.c, self.id, vector(1, position, 3), vector(2, rotation, 9))
    if result < 0 then fail(world, "Obstacle:setPose", result, true) end
    return result == 1
end

--- Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
function Obstacle:setVelocity(velocity, angularVelocity)
    local world = self.world
    local result = C.kiriObstacle_SetVelocity(world.c, self.id, vector(1, velocity, 3), vector(2, angularVelocity, 3))
    if result < 0 then fail(world, "Obstacle:setVelocity", result, true) end
    return result == 1
end

--- Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
function Obstacle:setSurfaceVelocity(velocity)
    local world = self.world
    local result = C.kiriObstacle_SetSurfaceVelocity(world.c, self.id, vector(1, velocity, 3))
    if result < 0 then fail(world, "Obstacle:setSurfaceVelocity", result, true) end
    return result == 1
end

--- Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
function Obstacle:setMass(mass, inertia, centerOfMass)
    local world = self.world
    local result = C.kiriObstacle_SetMass(world.c, self.id, mass, vector(1, inertia, 6), vector(2, centerOfMass, 3))
    if result < 0 then fail(world, "Obstacle:setMass", result, true) end
    return result == 1
end

--- Gets the current state.
function Obstacle:getState(state)
    local world = self.world
    state = state or new.kiriObstacleState()
    local result = C.kiriObstacle_GetState(world.c, self.id, state)
    if result < 0 then fail(world, "Obstacle:getState", result, false) end
    return state
end

--- Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add their way.
function Sheet:getReach(dt, lower, upper)
    local world = self.world
    lower = lower or ffi.new("float[?]", 3)
    upper = upper or ffi.new("float[?]", 3)
    local result = C.kiriSheet_GetReach(world.c, self.id, dt, lower, upper)
    if result < 0 then fail(world, "Sheet:getReach", result, false) end
    return lower, upper
end

--- Fill the struct with its defaults; draw the world as after the last tick. This only reads, and takes no memory.
function kiri.defaultDebugDraw(draw)
    draw = draw or new.kiriDebugDraw()
    C.kiriDefaultDebugDraw(draw)
    return draw
end

end

--- Frees the world and all that is in it.
local function destroy(world)
    local c = world.c
    if c then
        world.c = nil
        world.free(ffi.gc(c, nil))
    end
end
jit.off(destroy)

-- What functions of Lua raise while C calls them is raised when C is done.
local raised

local function guarded(call)
    return function(...)
        local done, why = pcall(call, ...)
        raised = raised or not done and why or nil
    end
end

local function raise()
    local why = raised
    raised = nil
    if why then error(why, 0) end
end

local drawn, drawers = {}, {}

--- Draws the world as after the last tick: fields of kiriDebugDraw by name. `points`, `lines` and `triangles` are functions
--- that get (vertices, count), an array of C with fields position and color; it is gone after the call.
local function debug_draw(world, draw)
    local given = {}
    for name, value in pairs(draw) do
        if type(value) == "function" then
            drawers[name] = drawers[name] or ffi.cast("kiriDrawFn*", guarded(function(_, vertices, count)
                return drawn[name](vertices, count)
            end))
            drawn[name], value = value, drawers[name]
        end
        given[name] = value
    end
    local result = C.kiriWorld_DebugDraw(world.c, struct_of(world, given, "kiriDebugDraw"))
    raise()
    if result < 0 then fail(world, "World:debugDraw", result, false) end
end
jit.off(debug_draw)

local function classes_by(defined, functions)
    local classes = {}
    for i, kind in ipairs(KINDS) do
        local class = {}
        class.__index = class
        class.__tostring = function(self) return ("kiri.%s(0x%x)"):format(kind, self.id or 0) end
        classes[i], classes[kind] = class, class
    end
    defined(core, functions, unpack(classes))
    classes.World.destroy, classes.World.debugDraw = destroy, debug_draw
    -- A sheet, frame and so on by the id that C has for it.
    for i = 2, #KINDS do
        classes.World[KINDS[i]:lower()] = function(world, id) return handle(world, id, KINDS[i]) end
    end
    return classes
end

local plain = classes_by(define, kiri)
for _, kind in ipairs(KINDS) do kiri[kind] = plain[kind] end

local function raise_before(...)
    raise()
    return ...
end

local function raising(method)
    local function call(...)
        raised = nil
        return raise_before(method(...))
    end
    jit.off(call)
    return call
end

-- Compiled code cannot call C that calls Lua again. So worlds that have functions of Lua get classes of their own, which
-- are not compiled.
local function hooked()
    if not core.hooked then
        core.hooked = classes_by(loadstring(string.dump(define)), {})
        for _, kind in ipairs(KINDS) do
            local class = core.hooked[kind]
            for name, method in pairs(class) do
                if type(method) == "function" then
                    class[name] = jit.off(method) or raising(method)
                end
            end
        end
    end
    return core.hooked
end

local HOOKS = {alloc = "kiriAllocFn*", free = "kiriFreeFn*", log = "kiriLogFn*", clock = "kiriClockFn*",
               record = "kiriRecordFn*"}

-- The functions of a def as C calls them. `log` gets a line, `record` bytes as a string.
local function hook(said, def, callbacks)
    for name, value in pairs(def) do
        if type(value) == "function" then
            if not HOOKS[name] then error(name .. " must be a function of C: other threads call it", 0) end
            local call = value
            if name == "log" then
                call = function(_, line)
                    said.line = ffi.string(line)
                    value(said.line)
                end
            elseif name == "record" then
                call = function(_, bytes, count) value(ffi.string(bytes, count)) end
            end
            callbacks[name] = ffi.cast(HOOKS[name], (name == "log" or name == "record") and guarded(call) or call)
        end
    end
    return callbacks
end

local function create_world(_, def)
    def = def or {}
    local cell = next_cell
    if cell < CELLS then
        next_cell = next_cell + 1
    else
        cell = table.remove(free_cells) or error "too many worlds"
    end
    local world = {cell = cell, things = setmetatable({}, {__mode = "v"}), said = {}}
    local callbacks = hook(world.said, def, {})
    world.classes = next(callbacks) and hooked() or plain
    local given = {}
    for name, value in pairs(def) do given[name] = callbacks[name] or value end
    local made = ffi.new("kiriWorld*[1]")
    local result = C.kiriCreateWorld(struct_of(nil, given, "kiriWorldDef"), made)
    if result < 0 then
        free_cells[#free_cells + 1] = cell
        fail(nil, "World", result, false)
    end
    world.free = function(c)
        C.kiriDestroyWorld(c)
        now[cell] = now[cell] + 1
        free_cells[#free_cells + 1] = cell
        for _, callback in pairs(callbacks) do callback:free() end
    end
    jit.off(world.free)
    world.c = ffi.gc(made[0], world.free)
    worlds[cell] = world
    raise()
    return setmetatable(world, world.classes.World)
end
jit.off(create_world)

setmetatable(kiri.World, {__call = create_world})

return kiri
