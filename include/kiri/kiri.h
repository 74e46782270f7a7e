/* Kiri: cuts thin sheets while they move, inside a game's fixed tick. samples/manual has the manual. Conventions:

   - Units are SI: metres, kilograms, seconds, newtons, pascals, radians.
   - World coordinates are right-handed, and no axis is up: gravity points down (manual, drawing).
   - The rest plane holds the flat, undeformed sheet. A rest position is (u, v) in metres. A rotation is 9 floats: columns.
   - Frames are the few rigid bodies that carry a sheet. A kiriDefault function fills a def, with its cookie: call it first.
   - A negative kiriResult is a failure: the world is as before the call, and a line of the world def's `log` says why.
   - Sheets, cuts, frames, pins, obstacles, blades and seams are 32-bit ids. 0 is never a valid id. A stale id, or the id of
     another kind, gives KIRI_ERROR_ID.
   - Arrays that the library returns stay unchanged until the next kiriWorld_Tick or kiriDestroyWorld.
   - Threads: functions that take a const kiriWorld only read it. Any number of threads may call them at the same time,
     while no other function runs on that world. Two worlds share nothing. The library starts no thread. */

#ifndef KIRI_H
#define KIRI_H

#include <stdint.h>

/* Version of this header. kiriGetVersion() returns the version of the linked library. */
#define KIRI_VERSION_MAJOR 0
#define KIRI_VERSION_MINOR 34
#define KIRI_VERSION_PATCH 0
#define KIRI_VERSION (10000 * KIRI_VERSION_MAJOR + 100 * KIRI_VERSION_MINOR + KIRI_VERSION_PATCH)

#if defined(KIRI_SHARED) && defined(_WIN32) && defined(KIRI_BUILD)
#define KIRI_API __declspec(dllexport)
#elif defined(KIRI_SHARED) && defined(_WIN32)
#define KIRI_API __declspec(dllimport)
#elif defined(__GNUC__)
#define KIRI_API __attribute__((visibility("default")))
#else
#define KIRI_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct kiriWorld kiriWorld;
typedef uint32_t kiriSheet;
typedef uint32_t kiriCut;
typedef uint32_t kiriFrame;
typedef uint32_t kiriPin;
typedef uint32_t kiriObstacle;
typedef uint32_t kiriBlade;
typedef uint32_t kiriSeam;

typedef int32_t kiriResult;
enum kiriResultCode {
    KIRI_OK = 0,
    KIRI_PENDING = 1,         /* success; work is left for later ticks */
    KIRI_ERROR_ARGUMENT = -1, /* null, NaN, infinite, outside the documented range, or beyond 4e37 m, m/s or 1/s */
    KIRI_ERROR_DEF = -2,      /* the def was not filled by its kiriDefault function: call that first */
    KIRI_ERROR_ID = -3,       /* unknown or stale id, or the id of another kind */
    KIRI_ERROR_MESH = -4,     /* the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping */
    KIRI_ERROR_STATE = -5,    /* the call comes in the wrong order, or from a callback that may not make it */
    KIRI_ERROR_MEMORY = -6,   /* the allocator returned null */
    KIRI_DIVERGED = -7,       /* the motion of a sheet could not be continued; the sheet was stopped where it was */
    KIRI_ERROR_LIMIT = -8,    /* all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world */
    KIRI_ERROR_BUILD = -9,    /* floats are not computed as on other machines, see kiriCreateWorld */
    KIRI_ERROR_DATA = -10,    /* the bytes are damaged, cut short, of another kind, or of a later version */
    KIRI_ERROR_REPLAY = -11   /* a repeated call gave another result than its recording has */
};

/* Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning. */
KIRI_API int32_t kiriGetVersion(void);
KIRI_API const char* kiriGetResultName(kiriResult result);
KIRI_API const char* kiriGetResultText(kiriResult result);

/* ---- World ------------------------------------------------------------------------------------------------------ */

/* Functions of the host. They may call other worlds; of the same world kiriWorld_GetLastError alone, or in a function
   that takes a const kiriWorld also functions that do so. Other calls give KIRI_ERROR_STATE (manual, budget). */
typedef void* kiriAllocFn(void* user, int64_t bytes); /* at least 16-byte aligned, or null */
typedef void kiriFreeFn(void* user, void* pointer);
typedef void kiriLogFn(void* user, const char* line);
typedef double kiriClockFn(void* user); /* seconds; read for the profile only, never by the simulation */
typedef void kiriRecordFn(void* user, const void* bytes, int32_t count); /* the next bytes of the recording */

/* For hosts that lend threads to a tick. `start` calls the task for ranges of minRange items or more that cover the
   items 0 to itemCount, each once, and returns a handle; `finish` returns after these calls (manual, budget). */
typedef void kiriTaskFn(int32_t start, int32_t end, void* taskContext); /* the items from start up to, without, end */
typedef void* kiriStartTaskFn(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* taskContext);
typedef void kiriFinishTaskFn(void* user, void* handle);

/* Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance: using 30
   % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut takes effect;
   the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it (manual, budget). */
typedef struct kiriBudget {
    int32_t triangles;  /* split by blades; 0, or KIRI_LEAST_TRIANGLES and more */
    int32_t cells;      /* visited, or with a new distance: grid, regions, shape functions. A link counts as a cell */
    int32_t samples;    /* vertices and collision points with new weights, and the cost of the commit, paid before it */
    int32_t iterations; /* linear systems, 30 to 60 us each; a large one counts as several (manual, budget) */
} kiriBudget;
enum kiriBudgetLimit { KIRI_LEAST_TRIANGLES = 16 };

/* Settings of a world: gravity, budget, and functions of the host. */
typedef struct kiriWorldDef {
    uint32_t cookie;
    float gravity[3];   /* m/s^2; default (0, 0, -9.81) */
    kiriBudget budget;  /* default: no limit */
    kiriAllocFn* alloc; /* null: malloc and free. Set both or none. */
    kiriFreeFn* free;
    kiriLogFn* log;             /* one line for each error and KIRI_EVENT_STRAINED; null: silent */
    kiriClockFn* clock;         /* null: the profile has counts, and no times */
    kiriStartTaskFn* startTask; /* null: a tick runs in the calling thread alone. Set both or none. */
    kiriFinishTaskFn* finishTask;
    int32_t workerCount;  /* threads for a task, the caller included, 0 to 1024; above 1 with startTask. Default 0 */
    void* user;           /* passed to the functions above */
    kiriRecordFn* record; /* receives the recording of the world, see kiriWorld_Replay; null: no recording */
    int32_t recordHashTicks; /* ticks between state hashes in the recording; one is at its end. 0: none. Default 60 */
} kiriWorldDef;

/* Fill the def; create an empty world (def null: the defaults; on failure *world is null, and the log gets the line); free
   it (null: nothing). KIRI_ERROR_BUILD: the compiler, or a mode of this thread, changes float operations (manual, budget). */
KIRI_API void kiriDefaultWorldDef(kiriWorldDef* def);
KIRI_API kiriResult kiriCreateWorld(const kiriWorldDef* def, kiriWorld** world);
KIRI_API void kiriDestroyWorld(kiriWorld* world);

/* Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the pending cut
   points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that still have work.
   KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget). KIRI_ERROR_LIMIT: no ids are
   left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED: events name sheets that were stopped. */
KIRI_API kiriResult kiriWorld_Tick(kiriWorld* world, float dt, int32_t substeps);

/* Returns the line of the last function that changes the world, if it failed; else "". Valid until the next one. */
KIRI_API const char* kiriWorld_GetLastError(const kiriWorld* world);

/* Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing wakes.
   Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not fit a float. */
KIRI_API kiriResult kiriWorld_ShiftOrigin(kiriWorld* world, const float origin[3]);

/* Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on. */
KIRI_API kiriResult kiriWorld_SetGravity(kiriWorld* world, const float gravity[3]);
KIRI_API kiriResult kiriWorld_SetBudget(kiriWorld* world, const kiriBudget* budget);

/* Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual, budget). */
KIRI_API kiriResult kiriWorld_GetStateHash(const kiriWorld* world, uint64_t* hash);

/* Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are. */
KIRI_API kiriResult kiriWorld_GetSheets(const kiriWorld* world, kiriSheet* sheets, int32_t capacity, int32_t* count);

/* ---- Recording -------------------------------------------------------------------------------------------------- */

/* A recording stores each call that changes a world, with its result. The same bytes give the same run, bit for bit, on
   any machine with the same version of the library. It is all bytes that `record` received, in order. */

enum kiriNoteLimit { KIRI_MOST_NOTE_BYTES = 1 << 20 };

/* Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A replay stops there. */
KIRI_API kiriResult kiriWorld_Note(kiriWorld* world, const void* bytes, int32_t count);

/* Progress of a replay. Set all fields to zero before the first call. */
typedef struct kiriReplay {
    int64_t offset, calls, ticks; /* bytes of the recording that were read; calls and ticks made, without refused ticks */
    const void* note; /* bytes of the note where the replay stopped, in the recording; else null */
    int32_t noteCount;
} kiriReplay;

/* Makes the calls of a recording up to the next tick or note, included. The world must be new; hooks stay the host's.
   KIRI_PENDING: more calls follow. KIRI_OK: the recording ended. KIRI_ERROR_REPLAY: a call gave another result, other
   ids or another state; the line names it, and the next call goes on behind it. KIRI_ERROR_DATA: not a recording,
   damaged, cut short, or of another version. KIRI_ERROR_STATE: the world is not new. KIRI_ERROR_MEMORY: start again. */
KIRI_API kiriResult kiriWorld_Replay(kiriWorld* world, const void* recording, int64_t size, kiriReplay* replay);

/* ---- Save and load ---------------------------------------------------------------------------------------------- */

/* A save has all that cannot be made again. A loaded world goes on as the saved one, bit for bit, with the same ids, on
   any machine with the same version. Only with a budget a later cut may take effect in another tick. */

/* Writes the world to memory with room for `capacity`; bytes null: only counts them. *size: bytes of the save.
   KIRI_ERROR_ARGUMENT: `capacity` is less. KIRI_PENDING: a cut is pending (kiriWorld_FinishCuts); *size is 0. */
KIRI_API kiriResult kiriWorld_Save(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports the events.
   Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in kiriWorld_Tick. */
KIRI_API kiriResult kiriWorld_FinishCuts(kiriWorld* world);

/* Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a malicious save cannot crash
   the program, and takes memory in proportion to its size, which is below 2^31. Old arrays live until the next tick. On
   failure nothing has changed: KIRI_ERROR_DATA: not a save, damaged, or of another version. KIRI_ERROR_MEMORY. */
KIRI_API kiriResult kiriWorld_Load(kiriWorld* world, const void* bytes, int64_t size);

/* For rollback: copies all of the world, also work in progress, into memory of the host; much faster than a save, and
   exact to the bit. For this process only: never store or send the bytes. bytes null: as of kiriWorld_Save. */
KIRI_API kiriResult kiriWorld_Snapshot(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Replaces the world by the world of the snapshot, as kiriWorld_Load does. The bytes are trusted. On failure nothing
   has changed: KIRI_ERROR_DATA: no snapshot of this build. KIRI_ERROR_STATE: it is recorded. KIRI_ERROR_MEMORY. */
KIRI_API kiriResult kiriWorld_Restore(kiriWorld* world, const void* bytes, int64_t size);

/* ---- Events ----------------------------------------------------------------------------------------------------- */

/* Events since the start of the last tick that was not refused. */
enum kiriEventType {
    KIRI_EVENT_CUT_FINISHED = 1,   /* cut: all of it is in the mesh; the id is stale from now on */
    KIRI_EVENT_PIECE_OFF = 2,      /* frame (its first, which names it), crumb, area: a part came off, never the largest */
    KIRI_EVENT_FRAME_ADDED = 3,    /* frame */
    KIRI_EVENT_DIVERGED = 4,       /* the sheet was stopped */
    KIRI_EVENT_DEFERRED = 5,       /* stage, waiting: the budget ended in this stage of the sheet's work */
    KIRI_EVENT_PIN_BROKE = 6,      /* pin: its force exceeded breakForce; the id is stale from now on */
    KIRI_EVENT_PIECE_DETACHED = 7, /* sheet (the new one), frame, area: a pending kiriFrame_DetachPiece is done */
    KIRI_EVENT_SEAM_BROKE = 8,     /* seam, stitches: some stitches broke; with none left the id is stale from now on */
    KIRI_EVENT_TEAR_BEGAN = 9,     /* cut: the library began it, see kiriTearing */
    KIRI_EVENT_TEAR_ENDED = 10,    /* cut: the tear has rested for half a second; the id is stale from now on */
    KIRI_EVENT_STRAINED = 11       /* area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s */
};

/* An event. It fills the fields that its type names, and `sheet`. Other fields are 0, and `stage` is -1. */
typedef struct kiriEvent {
    int32_t type; /* KIRI_EVENT_... */
    kiriSheet sheet;
    kiriCut cut;      /* 0: none */
    kiriFrame frame;  /* 0: none */
    kiriPin pin;      /* 0: none */
    int32_t crumb;    /* 1: the piece is a crumb, see kiriSheetDef */
    float area;       /* m^2, or 0 */
    int32_t stage;    /* KIRI_STAGE_..., or -1 */
    int32_t waiting;  /* points and ends of cuts that are pending or in work; or 0 */
    kiriSeam seam;    /* 0: none */
    int32_t stitches; /* that the seam has left, or 0 */
} kiriEvent;

/* Gets the events: *events points to *count of them. */
KIRI_API kiriResult kiriWorld_GetEvents(const kiriWorld* world, const kiriEvent** events, int32_t* count);

/* The stages of a tick in their order. */
enum kiriStage {
    KIRI_STAGE_CUT,       /* splits the mesh along the blade */
    KIRI_STAGE_GRID,      /* cells and their connections */
    KIRI_STAGE_REGIONS,   /* geodesic distances, regions, links; places frames */
    KIRI_STAGE_SHAPE,     /* shape functions */
    KIRI_STAGE_SAMPLES,   /* weights of vertices and collision points */
    KIRI_STAGE_CONSTANTS, /* mass, the pattern of the solver's matrix, and the commit */
    KIRI_STAGE_CONTACT,   /* contacts with obstacles, other sheets and other pieces */
    KIRI_STAGE_SOLVE,     /* the motion of the frames */
    KIRI_STAGE_SKIN,      /* positions and normals of the mesh */
    KIRI_STAGE_COUNT
};

/* Work and time of the last tick. */
typedef struct kiriProfile {
    double seconds[KIRI_STAGE_COUNT]; /* of the last tick; zero without a clock */
    int32_t cutSegments;              /* blade segments that took effect */
    /* Items in the units of kiriBudget. An item that takes more work counts more than once. */
    int32_t trianglesSplit, cellsSettled, samplesRefreshed, solverIterations;
    /* Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    int32_t cellsChanged, weightsChanged, verticesChanged, pointsChanged, linksChanged;
    int32_t commits, systemsSolved; /* sheets in which a cut took effect; linear systems, large and small */
    int32_t contacts;      /* planes given to the solver: by the host, by obstacles, and between sheets */
    int32_t sheetPairs;    /* pairs of sheets or pieces that are near each other and not both asleep */
    /* The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m. */
    double largestJump, largestFade;
} kiriProfile;

/* Gets the profile of the last tick that was not refused. */
KIRI_API kiriResult kiriWorld_GetProfile(const kiriWorld* world, kiriProfile* profile);

/* Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum of several: half for cuts,
   half for motion; all if it has one alone. Limits without recorded work stay. A replay must set the same budgets. */
KIRI_API kiriResult kiriFitBudget(const kiriProfile* profile, float microseconds, kiriBudget* budget);

/* Returns the name of a stage; "" for another number. */
KIRI_API const char* kiriGetStageName(int32_t stage);

/* ---- Sheet ------------------------------------------------------------------------------------------------------ */

/* The material of a sheet: homogeneous, isotropic. */
typedef struct kiriMaterial {
    float youngsModulus; /* Pa, above 0 */
    float poissonsRatio; /* 0 to below 0.5 */
    float thickness;     /* m, above 0 */
    float density;       /* kg/m^3, above 0 */
    float airDamping;    /* 1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets) */
    float flexDamping;   /* s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation */
    float yieldStress; /* Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not planar */
    float hardening;   /* modulus beyond the yield stress, relative to youngsModulus; 0 to below 1 */
    float slack;    /* 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets) */
    int32_t detail; /* sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0 */
    float restCurvature[3]; /* 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0 */
} kiriMaterial;

/* Materials to start from; src/world/kiri_api_world.c has the sources. From SILK on: measured cloths (manual, sheets) */
enum kiriMaterialPreset {
    KIRI_MATERIAL_PAPER,  /* printing paper, 0.11 mm */
    KIRI_MATERIAL_COTTON, /* cloth, 0.5 mm; the default of a sheet def */
    KIRI_MATERIAL_RUBBER, /* natural rubber, 1 mm */
    KIRI_MATERIAL_FOIL,   /* aluminium, 16 um */
    KIRI_MATERIAL_CARD,   /* paperboard, 0.4 mm */
    KIRI_MATERIAL_SILK, KIRI_MATERIAL_SHIRTING, KIRI_MATERIAL_WOOL, KIRI_MATERIAL_DENIM, KIRI_MATERIAL_JERSEY,
    KIRI_MATERIAL_COUNT
};

/* Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual, accuracy). */
typedef struct kiriQuality {
    int32_t framesAlong;    /* control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9 */
    int32_t gridResolution, iterations; /* for the sheet def */
    int32_t substeps;       /* for kiriWorld_Tick */
} kiriQuality;
enum kiriQualityPreset { KIRI_QUALITY_FAST, KIRI_QUALITY_BALANCED, KIRI_QUALITY_ACCURATE, KIRI_QUALITY_COUNT };

/* Kinds of sheets to begin with. They want a tick of 1/60 s with 4 substeps; curtain and card do with 2. */
enum kiriSetupPreset { KIRI_SETUP_CURTAIN, KIRI_SETUP_PAPER, KIRI_SETUP_FLAG, KIRI_SETUP_RIBBON, KIRI_SETUP_RUBBER,
                       KIRI_SETUP_CARD, KIRI_SETUP_FOIL, KIRI_SETUP_COUNT };

/* Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_... */
KIRI_API kiriResult kiriGetMaterial(int32_t preset, kiriMaterial* material);
KIRI_API kiriResult kiriGetQuality(int32_t preset, kiriQuality* quality);

/* How a sheet deforms (manual, sheets). Rigid frames have 6 unknowns, affine ones 12. */
enum kiriModel {
    KIRI_MODEL_LINKS = 0,  /* rigid frames joined by links: paper, foil, stiff cloth */
    KIRI_MODEL_AFFINE = 1, /* affine frames joined by links: cloth and rubber that stretch inside a region */
    KIRI_MODEL_POINTS = 2  /* affine frames, strains at integration points, as in the paper. Thin sheets hardly bend */
};

/* The surface between the frames, which blades and contacts meet (manual, sheets). */
enum kiriSkinning {
    KIRI_SKINNING_LINEAR = 0, /* each frame carries a flat patch; the weights blend them (equation 1 of the paper) */
    KIRI_SKINNING_SMOOTH = 1  /* patches bend and stretch as their neighbours lie: no bumps at the frames */
};

/* Integration in time, with one linear system an iteration. Steps with contacts or new pins take backward Euler. */
enum kiriTimeStepping {
    KIRI_TIME_STEPPING_SECOND_ORDER = 0, /* TR-BDF2, of second order: keeps the energy of motion */
    KIRI_TIME_STEPPING_EULER = 1 /* backward Euler, of first order: takes energy out of a swing, more in longer steps */
};

/* Options of the paper, for comparison; part of the sheet def. Default 0, but for integrationOrder. */
typedef struct kiriPaperOptions {
    int32_t fromScratch;   /* 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits */
    int32_t popping;       /* 1: only new frames take their motion from the surface: it jumps, momentum is not kept */
    int32_t linearWeights; /* 1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS */
    /* KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
       frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work. */
    int32_t integrationPoints, integrationOrder;
} kiriPaperOptions;

/* A sheet: its rest shape, start, material, and computation. */
typedef struct kiriSheetDef {
    uint32_t cookie;
    /* The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge; holes and several parts
       are allowed. Two edges in the same place with different vertices are the lips of a cut (manual, meshes). */
    const float* restPositions; /* 2 floats (u, v) a vertex */
    int32_t vertexCount;
    const int32_t* indices; /* 3 a triangle */
    int32_t triangleCount;
    /* Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    float position[3], axisU[3], axisV[3], velocity[3];
    kiriMaterial material;
    int32_t gridResolution; /* grid squares along the longer side, 1 to 4096; default 32 */
    float snapDistance;     /* m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side */
    float weldDistance;     /* m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none */
    /* Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount frames
       are spread evenly, in straight rows over stiff rectangles, or fewer: one for two squares of the grid. frameCount 0:
       regions are split, after cuts too, to frameLength; 0: it follows from `accuracy`, the relative error (manual, accuracy). */
    int32_t frameCount; /* 0, or 1 and more; default 24 */
    float frameLength;  /* m; used where frameCount is 0; default 0 */
    float accuracy; /* 1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default 0.02 */
    const float* framePoints; /* 2 floats a frame, or null */
    int32_t maxFrames; /* re-sampling stops here; default 256 */
    /* Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
       beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy). */
    float rigidWeight, rigidArea; /* default 0.95, 0 */
    float crumbArea;   /* m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0 */
    float friction; /* of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5 */
    float contactThickness; /* m between sheets, half to obstacles. 0: the material's, at least a 20th of a square */
    uint32_t groups;        /* obstacles and sheets touch if they share a set bit. Default: all */
    /* touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1:
       layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    int32_t touchesSheets, selfContact;
    int32_t collisionPoints; /* for kiriSheet_SetContacts: spread evenly, at least one in every piece; default 0: none */
    int32_t iterations; /* Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual */
    float sleepSpeed;   /* m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never */
    int32_t model;      /* KIRI_MODEL_..., default KIRI_MODEL_LINKS */
    int32_t skinning;   /* KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH */
    int32_t planar;     /* 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0 */
    int32_t timeStepping; /* KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    float fadeTime;  /* s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2 */
    int32_t normals; /* 1: every tick computes normals (default). 0: kiriMesh has none, which saves time */
    kiriPaperOptions paper; /* default: all off */
} kiriSheetDef;

/* Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
   failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def. */
KIRI_API void kiriDefaultSheetDef(kiriSheetDef* def);
KIRI_API kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet);
KIRI_API kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet);

/* Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of sheet and its
   sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual, accuracy). */
KIRI_API kiriResult kiriGetSetup(int32_t preset, float width, float height, kiriSheetDef* def);

/* Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns or rows 0: as
   many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def null: the defaults. */
KIRI_API kiriResult kiriCreateRectangle(kiriWorld* world, float width, float height, int32_t columns, int32_t rows,
                                        const kiriSheetDef* def, kiriSheet* sheet);

/* Sheet settings that can change after creation. Fields mean the same as in kiriSheetDef. */
typedef struct kiriSheetSettings {
    uint32_t cookie;
    kiriMaterial material;
    int32_t maxFrames;
    float crumbArea, friction, contactThickness;
    uint32_t groups;
    int32_t touchesSheets, selfContact, iterations;
    float sleepSpeed;
    int32_t skinning, timeStepping;
    float fadeTime; /* stays 0 with paper.popping */
    int32_t normals;
} kiriSheetSettings;

/* Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not come
   from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay. */
KIRI_API kiriResult kiriSheet_GetSettings(const kiriWorld* world, kiriSheet sheet, kiriSheetSettings* settings);
KIRI_API kiriResult kiriSheet_SetSettings(kiriWorld* world, kiriSheet sheet, const kiriSheetSettings* settings);

/* A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and each side has its own
   frames. Lines may end in the material, meet and cross; cuts go through or along them (manual, folding). */
typedef struct kiriFold {
    float from[2], to[2]; /* m */
    float stiffness;      /* N m/rad per metre of the line, 0 or more; 0: a free hinge */
    float restAngle;      /* rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it */
    float yieldMoment;    /* N m per metre: it bends for good beyond, with a yieldStress. 0: no limit */
} kiriFold;

/* Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no material at one. */
KIRI_API kiriResult kiriCreateFoldedSheet(kiriWorld* world, const kiriSheetDef* def, const kiriFold* folds,
                                          int32_t count, kiriSheet* sheet);

/* Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
   KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet. */
KIRI_API kiriResult kiriSheet_AddFold(kiriWorld* world, kiriSheet sheet, const kiriFold* fold, int32_t* index);

/* A fold, its mean angle (rad, as restAngle) and the length (m) along which it joins two sides: not cut, nor rigid. */
typedef struct kiriFoldState {
    kiriFold fold;
    double angle, length;
} kiriFoldState;

/* A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet. */
KIRI_API kiriResult kiriSheet_GetFold(const kiriWorld* world, kiriSheet sheet, int32_t index, kiriFoldState* state);
KIRI_API kiriResult kiriSheet_SetFold(kiriWorld* world, kiriSheet sheet, int32_t index, float stiffness,
                                      float restAngle);

/* Fills in the mesh of kiriCreateRectangle: 2 (columns + 1) (rows + 1) floats and 6 columns rows indices. */
KIRI_API kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions,
                                      int32_t* indices);

/* The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision grows when indices or
   vertices are added or changed. Sources have the precision of the library, 2^-29 of the sheet. */
typedef struct kiriMesh {
    const float* positions;         /* 3 a vertex, m, world */
    const float* normals;           /* 3 a vertex, unit; null where the sheet makes none */
    const float* restPositions;     /* 2 a vertex, m */
    const int32_t* indices;         /* 3 a triangle */
    const int32_t* sourceTriangles; /* 1 a vertex: the triangle of the def that contains it, */
    const float* sourceWeights;     /* 3 a vertex: and its barycentric coordinates there */
    int32_t vertexCount, triangleCount;
    uint32_t revision;
} kiriMesh;

/* Gets the arrays, without a copy. */
KIRI_API kiriResult kiriSheet_GetMesh(const kiriWorld* world, kiriSheet sheet, kiriMesh* mesh);

/* `count` items from `first` on. */
typedef struct kiriRange {
    int32_t first, count;
} kiriRange;

/* Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change in every tick. */
typedef struct kiriDirty {
    kiriRange newVertices, newTriangles; /* up to the last one of the mesh */
    kiriRange oldVertices, oldTriangles; /* the smallest ranges that hold all older ones with other data */
    uint32_t revision;                   /* for the next call */
} kiriDirty;

/* Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore. */
KIRI_API kiriResult kiriSheet_GetDirty(const kiriWorld* world, kiriSheet sheet, uint32_t sinceRevision,
                                       kiriDirty* dirty);

/* Copies 3 floats each; positions or normals null: none. Strides: 12 bytes or more. KIRI_ERROR_STATE: no normals. */
KIRI_API kiriResult kiriSheet_CopyVertices(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                           void* positions, int32_t positionStride, void* normals,
                                           int32_t normalStride);

/* Copies the index that each vertex had when the last tick began, to draw between two ticks; -1: it did not exist.
   *from: the sheet that had them then. A vertex that a cut separated has the other's index (manual, drawing). */
KIRI_API kiriResult kiriSheet_CopyPrevious(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                           int32_t* vertices, kiriSheet* from);

/* Copies indices of some triangles as 16-bit numbers, 3 each. KIRI_ERROR_STATE: there are more than 65535 vertices. */
KIRI_API kiriResult kiriSheet_CopyIndices16(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle,
                                            int32_t count, uint16_t* indices);

/* Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9 floats
   each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes). */
KIRI_API kiriResult kiriSheet_CopySources(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                          int32_t* sources);
KIRI_API kiriResult kiriSheet_CopySourceWeights(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle,
                                                int32_t count, float* weights);

/* The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips. First the vertices of
   kiriMesh on the side of the normal, then the same on the other side, then four for each border edge. */
typedef struct kiriSolid {
    const float* positions;     /* 3 a vertex, m, world */
    const float* normals;       /* 3 a vertex, unit, outwards */
    const float* restPositions; /* 2 a vertex, m */
    const int32_t* indices;     /* 3 a triangle, counter-clockwise from outside */
    const int32_t* sources;     /* 1 a vertex: its vertex in kiriMesh */
    int32_t vertexCount, triangleCount;
    int32_t rimTriangle; /* rims begin at this triangle */
} kiriSolid;

/* Makes the solid surface, with a thickness in m; thickness 0: the material's. */
KIRI_API kiriResult kiriSheet_GetSolid(kiriWorld* world, kiriSheet sheet, float thickness, kiriSolid* solid);

/* Gets the collision points: 3 floats of position (m, world) a point. */
KIRI_API kiriResult kiriSheet_GetCollisionPoints(const kiriWorld* world, kiriSheet sheet, const float** positions,
                                                 int32_t* count);

/* Numbers of items in a sheet. */
typedef struct kiriCounts {
    int32_t vertices, triangles, cells, frames, links, pieces, collisionPoints;
} kiriCounts;

/* m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s and kg m^2/s. */
typedef struct kiriTotals {
    double area, mass, kineticEnergy, elasticEnergy;
    double center[3], momentum[3], angularMomentum[3];
} kiriTotals;

/* Get the counts, at no cost; sum the totals over the frames. */
KIRI_API kiriResult kiriSheet_GetCounts(const kiriWorld* world, kiriSheet sheet, kiriCounts* counts);
KIRI_API kiriResult kiriSheet_GetTotals(const kiriWorld* world, kiriSheet sheet, kiriTotals* totals);

/* Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not KIRI_MODEL_LINKS. */
KIRI_API kiriResult kiriSheet_EstimateError(const kiriWorld* world, kiriSheet sheet, double* relative);

/* Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all. */
KIRI_API kiriResult kiriSheet_IsAwake(const kiriWorld* world, kiriSheet sheet, int32_t* awake);
KIRI_API kiriResult kiriSheet_Wake(kiriWorld* world, kiriSheet sheet);

/* Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar sheet turns
   about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual, sheets). */
KIRI_API kiriResult kiriSheet_Transform(kiriWorld* world, kiriSheet sheet, const float rotation[9],
                                        const float translation[3]);

/* Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre of
   mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay held. */
KIRI_API kiriResult kiriSheet_SetVelocity(kiriWorld* world, kiriSheet sheet, const float velocity[3],
                                          const float angularVelocity[3]);
KIRI_API kiriResult kiriFrame_SetPieceVelocity(kiriWorld* world, kiriFrame frame, const float velocity[3],
                                               const float angularVelocity[3]);

/* Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a piece,
   named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has both. */
KIRI_API kiriResult kiriSheet_SetUserData(kiriWorld* world, kiriSheet sheet, uint64_t data);
KIRI_API kiriResult kiriSheet_GetUserData(const kiriWorld* world, kiriSheet sheet, uint64_t* data);
KIRI_API kiriResult kiriPin_SetUserData(kiriWorld* world, kiriPin pin, uint64_t data);
KIRI_API kiriResult kiriPin_GetUserData(const kiriWorld* world, kiriPin pin, uint64_t* data);
KIRI_API kiriResult kiriFrame_SetPieceUserData(kiriWorld* world, kiriFrame frame, uint64_t data);
KIRI_API kiriResult kiriFrame_GetPieceUserData(const kiriWorld* world, kiriFrame frame, uint64_t* data);

/* The first point where a ray meets a sheet. */
typedef struct kiriHit {
    float restPoint[2]; /* m: where to cut */
    float position[3];  /* m, world */
    float normal[3];    /* unit */
    float distance;     /* m along the direction, which need not be a unit vector */
    int32_t triangle;   /* -1: none */
} kiriHit;

/* Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not. */
KIRI_API kiriResult kiriSheet_Raycast(const kiriWorld* world, kiriSheet sheet, const float origin[3],
                                      const float direction[3], float maxDistance, kiriHit* hit);
KIRI_API kiriResult kiriWorld_Raycast(const kiriWorld* world, const float origin[3], const float direction[3],
                                      float maxDistance, kiriSheet* sheet, kiriHit* hit);

/* A point of the material on the visible surface. */
typedef struct kiriPointState {
    float position[3], normal[3]; /* m, world; unit */
    float velocity[3];            /* m/s, by the weights of the point */
    kiriFrame frame;              /* the frame of its region; it also names the piece */
} kiriPointState;

/* Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the point. */
KIRI_API kiriResult kiriSheet_GetPoint(const kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                       kiriPointState* state);

/* Gets the shape functions at a rest point: up to `capacity` frames with weights, sum 1, and gradients (2 floats,
   1/m; gradients null: none). *count: all. KIRI_ERROR_ARGUMENT: outside the sheet. KIRI_ERROR_STATE: a cut is pending. */
KIRI_API kiriResult kiriSheet_GetWeights(const kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                         kiriFrame* frames, float* weights, float* gradients, int32_t capacity,
                                         int32_t* count);

/* ---- Piece ------------------------------------------------------------------------------------------------------ */

/* A connected part of a sheet. Any of its frames names it. Indices go from 0 to kiriCounts.pieces, and change when a
   piece comes off or goes (kiriFrame_GetPiece). Cuts with pending work have separated nothing yet. */
typedef struct kiriPieceState {
    double area, mass;                                    /* m^2, kg */
    double center[3], momentum[3], angularMomentum[3];    /* of mass, m; kg m/s, kg m^2/s about the origin */
    float lower[3], upper[3];                             /* m, world: the smallest box around its vertices */
    int32_t frames, vertices, triangles, collisionPoints; /* counts */
    int32_t crumb;                                        /* 1: see kiriSheetDef */
    int32_t asleep;                                       /* 1: see sleepSpeed */
} kiriPieceState;

/* The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all pieces, piece by piece. */
typedef struct kiriPieceMesh {
    const int32_t* vertices;        /* 1 a vertex: its index in kiriMesh */
    const int32_t* triangles;       /* 1 a triangle: its index in kiriMesh */
    const int32_t* indices;         /* 3 a triangle, as in kiriMesh: draw them */
    const int32_t* collisionPoints; /* 1 a point, see kiriSheet_GetCollisionPoints */
    int32_t vertexCount, triangleCount, collisionPointCount;
} kiriPieceMesh;

/* Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index. */
KIRI_API kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state);
KIRI_API kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh);

/* Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame. */
KIRI_API kiriResult kiriSheet_GetPieceFrames(kiriWorld* world, kiriSheet sheet, int32_t piece, const kiriFrame** frames,
                                             int32_t* count);
KIRI_API kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece);

/* Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay with the old
   sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut is pending, or the
   budget lacks samples for the piece; *detached is 0, further cuts of the sheet wait, and KIRI_EVENT_PIECE_DETACHED
   names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the sheet (manual, cutting). */
KIRI_API kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached);

/* Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles stay with
   three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all of its sheet. */
KIRI_API kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame);

/* Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none. KIRI_PENDING:
   some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0: pending. */
KIRI_API kiriResult kiriWorld_DetachPieces(kiriWorld* world, const kiriFrame* frames, int32_t count,
                                           kiriSheet* detached);
KIRI_API kiriResult kiriWorld_DestroyPieces(kiriWorld* world, const kiriFrame* frames, int32_t count);

/* Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. *count: their number. */
KIRI_API kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count);

/* ---- Cut -------------------------------------------------------------------------------------------------------- */

/* Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once, from
   2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is cut; an end
   inside stays closed until the next point. The id is stale after the tick of the last point (KIRI_EVENT_CUT_FINISHED). */
KIRI_API kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut);
KIRI_API kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count);
KIRI_API kiriResult kiriCut_End(kiriWorld* world, kiriCut cut);
KIRI_API kiriResult kiriSheet_Cut(kiriWorld* world, kiriSheet sheet, const float* restPoints, int32_t count, kiriCut* cut);

/* Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2], meets the
   current sheet; past borders, so that it separates the parts that it crosses. The cut is already ended. */
KIRI_API kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut);

/* ---- Tear ------------------------------------------------------------------------------------------------------- */

/* How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or a sharp notch, goes on
   across the tension where the sheet would set more energy free than the tear takes. Two frames go with its tip. Where a
   mean tension over a distance of frames exceeds the strength, a tear begins at the nearest border, one at a time. */
typedef struct kiriTearing {
    float toughness;  /* J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear */
    float strength;   /* Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored */
    float grain[2];   /* direction in the rest plane along which it tears; 0, 0: none */
    float grainRatio; /* toughness across the grain, relative to along it; below 1: 1 */
    float maxSpeed;   /* m/s in the rest plane, 0 or more; 0: no limit but the distance above */
    int32_t maxTips;  /* tips that tear in a tick, 0 or more; 0: 8. Others wait */
} kiriTearing;

/* Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet inherit
   them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset. */
KIRI_API kiriResult kiriGetTearing(int32_t preset, kiriTearing* tearing);
KIRI_API kiriResult kiriSheet_SetTearing(kiriWorld* world, kiriSheet sheet, const kiriTearing* tearing);
KIRI_API kiriResult kiriSheet_GetTearing(const kiriWorld* world, kiriSheet sheet, kiriTearing* tearing);

/* Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a factor, 0 or more:
   below 1 tears follow it, above 1 they stop there. The same points replace it. KIRI_ERROR_ARGUMENT: no material. */
KIRI_API kiriResult kiriSheet_SetTearLine(kiriWorld* world, kiriSheet sheet, const float* restPoints, int32_t count,
                                          float factor);

/* ---- Blade ------------------------------------------------------------------------------------------------------ */

/* A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer, and cuts
   on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting). `sheet` 0: all. */
KIRI_API kiriResult kiriBeginBlade(kiriWorld* world, kiriSheet sheet, kiriBlade* blade);

/* Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
   each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay. */
KIRI_API kiriResult kiriBlade_MoveEdge(kiriWorld* world, kiriBlade blade, const float from[3], const float to[3]);
KIRI_API kiriResult kiriBlade_MoveRay(kiriWorld* world, kiriBlade blade, const float origin[3],
                                      const float direction[3], float length);
KIRI_API kiriResult kiriBlade_End(kiriWorld* world, kiriBlade blade);

/* ---- Frame ------------------------------------------------------------------------------------------------------ */

/* Pose, motion and region of a frame. */
typedef struct kiriFrameState {
    float restPoint[2];       /* m */
    float position[3];        /* m, world: of the rest point */
    float rotation[9];        /* columns: direction of u, of v, normal; an affine frame: columns of A, which stretch */
    float velocity[3], angularVelocity[3]; /* m/s, rad/s */
    float area, mass;         /* m^2 of its region; kg */
    int32_t held;             /* 1: moved by the host, see kiriFrame_Hold */
} kiriFrameState;

/* Writes up to `capacity` ids of the sheet's frames; *count is how many there are. */
KIRI_API kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity,
                                        int32_t* count);

/* Holds the frame: its rest point moves evenly to `position` (m, world) with `rotation` (columns as above) in the
   next tick; position and rotation null: frees it. Material that held frames mostly carry moves through obstacles. */
KIRI_API kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9]);

/* Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means over
   the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free frame. */
KIRI_API kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state);
KIRI_API kiriResult kiriFrame_GetReaction(const kiriWorld* world, kiriFrame frame, double force[3], double torque[3]);

/* ---- Load ------------------------------------------------------------------------------------------------------- */

/* Forces, torques, line loads and pressures add up, act throughout the next tick that moves, and then end. They act on
   the frames that hold the material at the time of the call: a load does not follow the sheet within the tick. */

/* Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m). */
KIRI_API kiriResult kiriFrame_ApplyForce(kiriWorld* world, kiriFrame frame, const float force[3],
                                         const float torque[3]);
KIRI_API kiriResult kiriSheet_ApplyForce(kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                         const float force[3], const float torque[3]);

/* Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges included.
   Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of kiriSheet_ClampLine. */
KIRI_API kiriResult kiriSheet_ApplyLineLoad(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                            const float forcePerLength[3]);

/* Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it. */
KIRI_API kiriResult kiriSheet_ApplyPressure(kiriWorld* world, kiriSheet sheet, float pressure);

/* Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of the frames
   that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the sheet. */
KIRI_API kiriResult kiriSheet_ApplyImpulse(kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                           const float impulse[3]);

/* Air past the sheet. v is the velocity of the air less the material's, n the normal: each square metre gets density /
   2 times |v| (drag (v.n) n + lift (v - (v.n) n)); airDamping acts in any density. A sheet can sleep in wind. */
typedef struct kiriWind {
    float velocity[3]; /* m/s */
    float density;     /* kg/m^3, 0 or more; air: 1.2 */
    float drag, lift;  /* 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01) */
} kiriWind;

/* Copies the wind; it blows until the next call. */
KIRI_API kiriResult kiriSheet_SetWind(kiriWorld* world, kiriSheet sheet, const kiriWind* wind);

/* ---- Pin -------------------------------------------------------------------------------------------------------- */

/* A pin holds a point of the material at its target by a spring. */
typedef struct kiriPinDef {
    uint32_t cookie;
    float restPoint[2]; /* m, in the material */
    float target[3];    /* m, world */
    float stiffness;    /* N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target (manual) */
    float breakForce;   /* N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never */
    kiriObstacle obstacle; /* 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there */
} kiriPinDef;

/* Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside. */
KIRI_API void kiriDefaultPinDef(kiriPinDef* def);
KIRI_API kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin);
KIRI_API kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin);

/* Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material, as
   a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far outside. */
KIRI_API kiriResult kiriSheet_ClampLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                        kiriPin* clamp);
KIRI_API kiriResult kiriSheet_HingeLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                        kiriPin* hinge);

/* Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
   (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
   moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point. */
KIRI_API kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3]);
KIRI_API kiriResult kiriPin_SetPose(kiriWorld* world, kiriPin pin, const float target[3], const float rotation[9]);

/* Sets the force (N) that breaks a pin of any type; 0: it never breaks. */
KIRI_API kiriResult kiriPin_SetBreakForce(kiriWorld* world, kiriPin pin, float breakForce);

/* The types of pins. */
enum kiriPinType { KIRI_PIN_POINT, KIRI_PIN_HINGE, KIRI_PIN_CLAMP };

/* Type and target of a pin. */
typedef struct kiriPinState {
    int32_t type; /* KIRI_PIN_... */
    kiriSheet sheet;
    float from[2], to[2];  /* m, rest plane: the ends of the line, or the point twice */
    float target[3];       /* m, world */
    float rotation[9];     /* of a line; of a point the identity */
    float breakForce;      /* N, or 0 */
    kiriObstacle obstacle; /* that the target moves with; 0: none */
} kiriPinState;

/* Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it. */
KIRI_API kiriResult kiriPin_GetState(const kiriWorld* world, kiriPin pin, kiriPinState* state);
KIRI_API kiriResult kiriPin_GetReaction(const kiriWorld* world, kiriPin pin, double force[3], double torque[3]);

/* Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are. */
KIRI_API kiriResult kiriSheet_GetPins(const kiriWorld* world, kiriSheet sheet, kiriPin* pins, int32_t capacity,
                                      int32_t* count);

/* ---- Seam ------------------------------------------------------------------------------------------------------- */

/* A seam joins two lines in the material, of two sheets or of one: stitches join points at the same parts of both. Cuts
   go through a seam, and pieces keep their stitches. A stitch ends with the piece of a point (manual, sewing). */
typedef struct kiriSeamDef {
    uint32_t cookie;
    kiriSheet sheetA, sheetB; /* of the same model, and not planar */
    const float* lineA;       /* 2 floats a point, m, in the material, such as its edge; copied */
    const float* lineB;       /* 2 floats a point */
    int32_t countA, countB; /* points: 2 to 65536 */
    int32_t stitches;       /* 2 to 4096; 0 (default): three for two distances of frames */
    float stiffness;  /* N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free */
    float restAngle;  /* rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal */
    float breakForce; /* N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never */
} kiriSeamDef;

/* Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
   KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing). */
KIRI_API void kiriDefaultSeamDef(kiriSeamDef* def);
KIRI_API kiriResult kiriCreateSeam(kiriWorld* world, const kiriSeamDef* def, kiriSeam* seam);
KIRI_API kiriResult kiriDestroySeam(kiriWorld* world, kiriSeam seam);
KIRI_API kiriResult kiriSeam_SetHinge(kiriWorld* world, kiriSeam seam, float stiffness, float restAngle);

/* A stitch, as after the last tick. */
typedef struct kiriStitch {
    kiriSheet sheetA, sheetB;
    float restA[2], restB[2]; /* m, in the material */
    float position[3];        /* m, world: where both drawn lips meet; their middle while they are apart */
    float gap;      /* m: distance of the two points; a stitch yields by micrometres under the sheet's weight */
    float force[3]; /* N, on sheet A: mean over the last tick that moved it */
    float angle;    /* rad, as restAngle */
} kiriStitch;

/* Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index. */
KIRI_API kiriResult kiriSeam_GetStitch(const kiriWorld* world, kiriSeam seam, int32_t index, kiriStitch* stitch);
KIRI_API kiriResult kiriSeam_GetCount(const kiriWorld* world, kiriSeam seam, int32_t* stitches);

/* Writes up to `capacity` ids of the world's seams; *count is how many there are. */
KIRI_API kiriResult kiriWorld_GetSeams(const kiriWorld* world, kiriSeam* seams, int32_t capacity, int32_t* count);

/* ---- Contact ---------------------------------------------------------------------------------------------------- */

/* A contact of a point of the material: the plane dot(normal, x) = offset keeps the point on its upper side, with
   Coulomb friction. The host computes planes from the visible surface for each tick. Planes out of reach do nothing. */
typedef struct kiriContact {
    int32_t point;      /* index of the collision point; -1: restPoint names the point */
    float restPoint[2]; /* m, in the material; read only where point is -1 */
    float normal[3];    /* unit, out of the obstacle */
    float offset;       /* m: of the obstacle's surface at the start of the tick */
    float velocity[3];  /* m/s: of the obstacle at the contact. The plane moves with it within the tick */
    float friction;     /* 0 or more: of both sides together */
    float inverseMass;  /* 1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid */
    float pushSpeed;    /* m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s */
    int32_t obstacle;   /* a number of the host. Contacts with one number press on one obstacle, and share its mass */
} kiriContact;

/* Sets the contacts of the next tick alone. One with point and obstacle of an earlier one starts with its impulse. */
KIRI_API kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts,
                                          int32_t count);

/* The result of a contact in the last tick. */
typedef struct kiriContactForce {
    double impulse[3];       /* N s, on the sheet: the sum over the tick. The obstacle gets the opposite */
    double position[3];      /* m, world: the point of the sheet at the end of the tick */
    double depth;            /* m: of the point below the plane at the end of the tick; below 0: above it */
    int32_t point, obstacle; /* as in the contact */
} kiriContactForce;

/* Gets one result for each contact that was set before the last tick, in that order. A sleeping piece presses on. */
KIRI_API kiriResult kiriSheet_GetContactForces(const kiriWorld* world, kiriSheet sheet, const kiriContactForce** forces,
                                               int32_t* count);

/* ---- Obstacle --------------------------------------------------------------------------------------------------- */

/* A body that sheets touch: a floor, a ball, a crate of another engine. It moves on with its velocities alone: set pose
   and velocity before a tick, and apply the impulse of its state after it (manual, contact). Lengths: up to 1e6 m. */
enum kiriObstacleType {
    KIRI_OBSTACLE_PLANE,    /* all below the plane through its position; the third column of its rotation points out */
    KIRI_OBSTACLE_SPHERE,   /* radius */
    KIRI_OBSTACLE_CAPSULE,  /* radius, height: of its axis, the third column, between the middles of its round ends */
    KIRI_OBSTACLE_BOX,      /* size: lengths of its edges along the columns of its rotation */
    KIRI_OBSTACLE_CYLINDER, /* radius, height: along the third column */
    KIRI_OBSTACLE_PRISM /* outline: convex, in the plane of the first two columns; height along the third, 0: endless */
};

/* An obstacle: its shape, pose, motion, and mass. */
typedef struct kiriObstacleDef {
    uint32_t cookie;
    int32_t type;             /* KIRI_OBSTACLE_... */
    float size[3];            /* m */
    float radius, height;     /* m */
    const float* outline;     /* 2 floats a corner, m, counter-clockwise; copied. Null: no prism */
    int32_t outlineCount;     /* 3 to 64 */
    float rounding;           /* m, 0 or more: prisms and boxes grow by this, with round edges. Default 0 */
    float position[3];        /* m, world */
    float rotation[9];        /* columns; default: the axes of the world */
    float velocity[3];        /* m/s, of its position */
    float angularVelocity[3]; /* rad/s */
    float surfaceVelocity[3]; /* m/s, world: of its surface, added to its motion, as of a conveyor */
    float friction;           /* 0 or more; default 0.5 */
    float mass;               /* kg; 0 (default): nothing moves it */
    float inertia[6]; /* kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz.
                         Positive definite, but for axes whose numbers are all 0: it does not turn about these */
    float centerOfMass[3]; /* m, from its position in its own axes */
    uint32_t body;   /* obstacles with the same number, except 0, are parts of one body; each has its whole mass */
    float pushSpeed; /* m/s, above 0: maximum speed at which points inside are pushed out. Default 1 */
    uint32_t groups; /* see the sheet def. Default: all */
} kiriObstacleDef;

/* Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake. */
KIRI_API void kiriDefaultObstacleDef(kiriObstacleDef* def);
KIRI_API kiriResult kiriCreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle);
KIRI_API kiriResult kiriDestroyObstacle(kiriWorld* world, kiriObstacle obstacle);

/* Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity), not to the jump. */
KIRI_API kiriResult kiriObstacle_SetPose(kiriWorld* world, kiriObstacle obstacle, const float position[3],
                                         const float rotation[9]);

/* Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass. */
KIRI_API kiriResult kiriObstacle_SetVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3],
                                             const float angularVelocity[3]);
KIRI_API kiriResult kiriObstacle_SetSurfaceVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3]);
KIRI_API kiriResult kiriObstacle_SetMass(kiriWorld* world, kiriObstacle obstacle, float mass, const float inertia[6],
                                         const float centerOfMass[3]);

/* Pose, motion, and reaction of an obstacle. */
typedef struct kiriObstacleState {
    float position[3], rotation[9], velocity[3], angularVelocity[3];
    double impulse[3], angularImpulse[3]; /* N s, N m s about its centre of mass: of sheets and pins in the last tick */
    int32_t contacts;                     /* that pushed in the last tick */
} kiriObstacleState;

/* Gets the current state. */
KIRI_API kiriResult kiriObstacle_GetState(const kiriWorld* world, kiriObstacle obstacle, kiriObstacleState* state);

/* Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add their way. */
KIRI_API kiriResult kiriSheet_GetReach(const kiriWorld* world, kiriSheet sheet, float dt, float lower[3],
                                       float upper[3]);

/* ---- Debug draw ------------------------------------------------------------------------------------------------- */

/* The things to draw. */
enum kiriDrawFlag {
    KIRI_DRAW_TRIANGLES = 1,   /* a triangle for each triangle of the mesh, in a colour of its piece; sleeping: pale */
    KIRI_DRAW_EDGES = 2,       /* a line for each edge between two triangles */
    KIRI_DRAW_BORDERS = 4,     /* a line for each edge of the outline, of lips and of folds */
    KIRI_DRAW_FRAMES = 8,      /* a point and three axes each: u red, v green, normal blue; held ones red */
    KIRI_DRAW_LINKS = 16,      /* two lines each: from frame to frame by the middle of their border */
    KIRI_DRAW_PINS = 32,       /* a point at the target; a line to the point of the material, or along the line */
    KIRI_DRAW_CONTACTS = 64,   /* a point and its normal for each that pushed as the last tick ended */
    KIRI_DRAW_BLADES = 128,    /* a line along the edge, and a point in each layer that it is in */
    KIRI_DRAW_BOXES = 256,     /* twelve lines around each piece */
    KIRI_DRAW_OBSTACLES = 512, /* lines along edges and rims, without the rounding; a plane is a square */
    KIRI_DRAW_POINTS = 1024,   /* a point for each collision point */
    KIRI_DRAW_ALL = 2047
};

/* A corner to draw, in a layout for a GPU. */
typedef struct kiriDrawVertex {
    float position[3]; /* m, world */
    uint32_t color;    /* red in its lowest byte, then green, blue, and opacity, which is 255 */
} kiriDrawVertex;

/* Receives up to 240 vertices, valid during the call: one for a point, two for a line, three for a triangle. */
typedef void kiriDrawFn(void* user, const kiriDrawVertex* vertices, int32_t count);

/* Flags, filter and functions of debug draw. */
typedef struct kiriDebugDraw {
    uint32_t cookie;
    uint32_t flags;        /* KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES */
    kiriSheet sheet;       /* draws only this one, without obstacles and blades; 0 (default): all */
    float size;            /* m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05 */
    kiriDrawFn* points;    /* null: these are not drawn */
    kiriDrawFn* lines;     /* the same */
    kiriDrawFn* triangles; /* the same */
    void* user;            /* passed to these functions */
} kiriDebugDraw;

/* Fill the struct with its defaults; draw the world as after the last tick. This only reads, and takes no memory. */
KIRI_API void kiriDefaultDebugDraw(kiriDebugDraw* draw);
KIRI_API kiriResult kiriWorld_DebugDraw(const kiriWorld* world, const kiriDebugDraw* draw);

#ifdef __cplusplus
}
#endif

#endif
