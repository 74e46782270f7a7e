/* Kiri: cuts thin sheets while they move, inside a game's fixed tick.

   The method is that of "Interactive Detailed Cutting of Thin Sheets" (Manteaux, Sun, Faure, Cani, O'Brien, Motion in
   Games 2015): a fine mesh follows every cut, a few control frames carry it, and shape functions of the geodesic
   distance inside the cut sheet tie the two together.

   Conventions, everywhere in this header:
   - SI units: metres, kilograms, seconds, newtons, pascals, radians.
   - World coordinates are right-handed. No axis is up: gravity says where down is. A host with y up gives gravity
     (0, -9.81, 0) to the world def and, for a sheet that hangs, axisU (1, 0, 0) and axisV (0, 1, 0) to the sheet def;
     all else is then in its own axes. A left-handed host negates one axis of all that goes in and comes out, and swaps
     two corners of each triangle when it draws.
   - The rest plane holds the flat, undeformed sheet. A rest position is (u, v) in metres.
   - A function that can fail returns a kiriResult: negative is failure, and then the world is as before the call.
     kiriWorld_GetLastError says in one line what went wrong.
   - Sheets, cuts, frames, pins, obstacles and blades are 32-bit ids; 0 is no id. An id of another kind, or of something
     that is gone, gives KIRI_ERROR_ID.
   - Arrays that a call hands out belong to the library, and stay as they are until the next kiriWorld_Tick or
     kiriDestroyWorld, whatever is called in between.
   - Threads: functions that take a const kiriWorld only read it. Any number of threads may call them at the same time,
     while no other function runs on that world. Two worlds share nothing. The library starts no thread; a tick may use
     those of the host (kiriWorldDef). */

#ifndef KIRI_H
#define KIRI_H

#include <stdint.h>

/* Of this header; kiriGetVersion has that of the library. */
#define KIRI_VERSION_MAJOR 0
#define KIRI_VERSION_MINOR 12
#define KIRI_VERSION_PATCH 0
#define KIRI_VERSION (10000 * KIRI_VERSION_MAJOR + 100 * KIRI_VERSION_MINOR + KIRI_VERSION_PATCH)

#if defined(KIRI_SHARED) && defined(_WIN32)
#ifdef KIRI_BUILD
#define KIRI_API __declspec(dllexport)
#else
#define KIRI_API __declspec(dllimport)
#endif
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

typedef int32_t kiriResult;
enum kiriResultCode {
    KIRI_OK = 0,
    KIRI_PENDING = 1,         /* done, and work is left for later ticks */
    KIRI_ERROR_ARGUMENT = -1, /* null pointer, NaN, infinite, or outside the documented range; or a sheet or obstacle
                                 would be where floats end, or move that fast: 4e37 m, m/s or 1/s */
    KIRI_ERROR_DEF = -2,      /* the def was not filled by its kiriDefault function, all zeros say: call that first */
    KIRI_ERROR_ID = -3,       /* unknown or stale id, or the id of another kind */
    KIRI_ERROR_MESH = -4,     /* the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping */
    KIRI_ERROR_STATE = -5,    /* the call comes in the wrong order, or from a callback that may not make it */
    KIRI_ERROR_MEMORY = -6,   /* the allocator returned null */
    KIRI_DIVERGED = -7,       /* the motion of a sheet could not be continued; it was put to rest where it was */
    KIRI_ERROR_LIMIT = -8,    /* all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world */
    KIRI_ERROR_BUILD = -9,    /* floats are not computed as on other machines, see kiriCreateWorld */
    KIRI_ERROR_DATA = -10,    /* bytes that are damaged, cut short, of something else, or of a later version */
    KIRI_ERROR_REPLAY = -11   /* a call that was made again gave something else than its recording has */
};

/* The library's version, as KIRI_VERSION. */
KIRI_API int32_t kiriGetVersion(void);

/* The name of a result, "KIRI_OK" and so on; "unknown" for another number. */
KIRI_API const char* kiriGetResultName(kiriResult result);

/* One line: the meaning of a result, and its cure. For calls without a world that keeps a line, such as kiriCreateWorld
   with a def of zeros (KIRI_ERROR_DEF). */
KIRI_API const char* kiriGetResultText(kiriResult result);

/* ---- World ------------------------------------------------------------------------------------------------------ */

/* The host's functions. They may call other worlds, and functions that take no world. Calls of their own world:
   - While a function that takes a world without const runs, its callbacks may call kiriWorld_GetLastError alone. All
     other functions give KIRI_ERROR_STATE and do nothing, kiriDestroyWorld too.
   - While a function that takes a const kiriWorld runs, its callbacks may call functions that take a const kiriWorld.
     All others give KIRI_ERROR_STATE and do nothing.
   A refused call has a line in the log, unless the log made the call. kiriWorld_GetLastError keeps the line of the
   function that runs, and no recording has the refused call. The functions of kiriDebugDraw follow these rules, too.
   A thread that reads may call `log`, and in kiriSheet_GetWeights and kiriSheet_EstimateError `alloc` and `free`.
   All memory of a world comes from `alloc`, but for what Eigen takes while it orders the unknowns, when a cut couples
   frames that were not coupled before. */
typedef void* kiriAllocFn(void* user, int64_t bytes); /* at least 16-byte aligned, or null */
typedef void kiriFreeFn(void* user, void* pointer);
typedef void kiriLogFn(void* user, const char* line);
typedef double kiriClockFn(void* user); /* seconds; read for the profile only, never by the simulation */
typedef void kiriRecordFn(void* user, const void* bytes, int32_t count); /* the next bytes of the recording */

/* For hosts that lend their threads to a tick. A task is work on the items 0 to itemCount: `start` has the function
   called, from whatever threads, for ranges of at least minRange items (the last one may be shorter) that together are
   all of them, each once, and returns something that names the task; `finish` returns when all these calls have.
   `start` may also make all calls itself, and return null: then there is no `finish`. What a thread wrote must be seen
   by those that go on after `finish`, as with any lock. A tick has one task at a time. Within one the library does not
   call the host, and how the items are shared out does not change one bit of what comes of them. */
typedef void kiriTaskFn(int32_t start, int32_t end, void* taskContext); /* the items from start up to, without, end */
typedef void* kiriStartTaskFn(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* taskContext);
typedef void kiriFinishTaskFn(void* user, void* handle);

/* The most work that one tick may do, over all sheets. 0: no limit. Triangles, cells and samples share one allowance:
   using 30 % of one leaves 70 % of the others. So the work on cuts takes no longer than the costliest of the three
   limits alone. A single step that exceeds the whole limit is not split. It runs alone in its tick.
   Work that does not fit goes on in the next tick. Until a cut takes effect its lips move together. All points of a
   sheet that are pending when work on them begins take effect together, whatever ticks they were given before. So the
   tick in which a cut takes effect depends on the budget, too. Its result does not: when all work is done, mesh, grid,
   regions, weights and sites of frames equal, bit for bit, a run of the same calls without a budget. Motion differs.
   Sheets take turns. In every other tick the sheet whose points came first is served first, in the ticks between the
   sheet whose work has used least. Pieces that wait to be detached get half of every other tick.
   An example at 60 Hz, with 2 ms of work on cuts a tick (about 32 000 cells and 4000 samples): a cut from side to side
   of 64 x 64 squares with 9 frames parts 17 to 100 ms after the blade has left, one of 127 x 127 squares with 24 frames
   67 to 200 ms. A slow blade parts sooner, for its work is done on the way. tests/bench_swipe.c prints the table. */
typedef struct kiriBudget {
    int32_t triangles; /* split by blades; 0, or KIRI_LEAST_TRIANGLES and more */
    int32_t cells;     /* looked at, or given another distance: grid, regions, shape functions; a link counts as many */
    int32_t samples;   /* vertices and collision points with new weights; and what it takes to put all that is new in
                           force at once, which is paid before */
    int32_t iterations; /* work on linear systems, of 30 to 60 us each. A system counts 1, and 1 more for each 16 frames
                       (5 of affine ones), for each 64 contacts, and for each 1280 products of blocks that its
                       factorisation takes: in a square of 24, 289, 1000, 5000 frames it is 2, 36, 184, 2411. A sheet
                       that gets fewer systems than its substeps takes longer ones. Where one system of all its pieces
                       is more than what is left, they take turns: some are moved, the others stay where they are in
                       this tick, with their velocity, and come first in the next; a sheet that gets none stands still,
                       too. A piece whose system is more than the whole limit is moved alone */
} kiriBudget;

enum kiriBudgetLimit { KIRI_LEAST_TRIANGLES = 16 };

/* Of a world: gravity, budget, and the host's functions. */
typedef struct kiriWorldDef {
    uint32_t cookie;
    float gravity[3];   /* m/s^2; default (0, 0, -9.81) */
    kiriBudget budget;  /* default: no limit */
    kiriAllocFn* alloc; /* null: malloc and free. Both or none. */
    kiriFreeFn* free;
    kiriLogFn* log;             /* one line for each error; null: silent */
    kiriClockFn* clock;         /* null: the profile counts, and shows no times */
    kiriStartTaskFn* startTask; /* null: a tick runs in its caller alone. Both or none. */
    kiriFinishTaskFn* finishTask;
    int32_t
        workerCount; /* threads that may work on a task, the caller of the tick with them, 0 to 1024: sizes ranges; up
                            to 1: no task is started. Default 0 */
    void* user;      /* handed to the functions above */
    kiriRecordFn* record;    /* gets the recording of the world, see kiriWorld_Replay; null: there is none */
    int32_t recordHashTicks; /* the recording has the state hash after so many ticks, and at the end; 0: never. Default
                            60 */
} kiriWorldDef;

/* Fills the def with its defaults, and stamps it. */
KIRI_API void kiriDefaultWorldDef(kiriWorldDef* def);

/* Makes an empty world. On failure *world is null, and the log of the def has the line; a def that was not filled has
   no log, see kiriGetResultText. KIRI_ERROR_BUILD: the compiler has contracted products and sums to fused multiply-adds
   (-ffp-contract=fast of clang), or has reordered them; or this thread flushes small floats to zero (FTZ, DAZ) or does
   not round to nearest. The threads of later calls, and those that the host runs tasks on, are not checked: in such a
   mode their bits are others. */
KIRI_API kiriResult kiriCreateWorld(const kiriWorldDef* def, kiriWorld** world);

/* Frees the world and all that is in it. Null is allowed. */
KIRI_API void kiriDestroyWorld(kiriWorld* world);

/* One fixed step of dt seconds (1e-6 to 10), solved in `substeps` equal parts (1 to 64). Takes the waiting cut points,
   then moves every sheet. KIRI_PENDING: the budget is spent and more work waits: the events say which cuts; a sheet, or
   some of its pieces, may also have stood still for want of iterations.
   KIRI_ERROR_MEMORY: nothing moved; cuts and pieces still wait, call again. Refused work is prepared again:
   until then kiriSheet_GetWeights gives KIRI_ERROR_STATE, and with a budget a cut may take effect some ticks later than
   it would have.
   KIRI_ERROR_LIMIT: the same, and it stays so until frames are destroyed.
   KIRI_DIVERGED: the sheets named by the events were put to rest, the others moved. Work may wait then, too, as
   KIRI_EVENT_DEFERRED says. */
KIRI_API kiriResult kiriWorld_Tick(kiriWorld* world, float dt, int32_t substeps);

/* What went wrong in the last function that changes the world, in one line; "" when nothing did. A function that only
   reads leaves it as it is, and gives its line to the log. Valid until the next function that changes the world. */
KIRI_API const char* kiriWorld_GetLastError(const kiriWorld* world);

/* m/s^2. All pieces wake. */
KIRI_API kiriResult kiriWorld_SetGravity(kiriWorld* world, const float gravity[3]);

/* Moves the origin of the world to a point (m): subtracts it from the positions of sheets, targets of pins and holds,
   obstacles, blades, and contacts that wait. The motion goes on as before, to rounding. Nothing wakes; (0, 0, 0)
   changes nothing. Use it in large worlds: far from the origin floats lose places. The host shifts its own data itself.
   Arrays that the library handed out keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would
   not fit a float. KIRI_ERROR_MEMORY: nothing has changed. */
KIRI_API kiriResult kiriWorld_ShiftOrigin(kiriWorld* world, const float origin[3]);

/* Takes effect with the next tick. */
KIRI_API kiriResult kiriWorld_SetBudget(kiriWorld* world, const kiriBudget* budget);

/* A hash of everything that the coming ticks depend on, work that waits for its budget included: two worlds that got
   the same calls have the same hash, and two with the same hash go on alike. After a refused allocation some items are
   made again: the hash tells that while work waits, or while the budget limits cells or samples. */
KIRI_API kiriResult kiriWorld_GetStateHash(const kiriWorld* world, uint64_t* hash);

/* Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are. */
KIRI_API kiriResult kiriWorld_GetSheets(const kiriWorld* world, kiriSheet* sheets, int32_t capacity, int32_t* count);

/* ---- Recording -------------------------------------------------------------------------------------------------- */

/* A recording has all that a world was given: each call of a function that changes it, with its arguments, its result
   and the ids that it made; calls that failed, too. For reports of errors, for tests, and to show a run elsewhere: the
   same bytes give the same run, bit for bit, on any machine, with the same version of the library. All bytes that
   `record` of the world def got are the recording, one after the other. It gets the arguments of a call before the call
   does anything, so a run that crashed is recorded up to the call that it crashed in; kiriDestroyWorld writes the end.
   Recording takes no memory, and a fraction of the time of the calls; a tick takes 8 bytes, a point of a cut 8, a mesh
   8 for each vertex and 3 to 6 for each triangle. */

enum kiriNoteLimit { KIRI_MOST_NOTE_BYTES = 1 << 20 };

/* Puts some bytes of the host's own (1 to KIRI_MOST_NOTE_BYTES) in the recording, where a replay finds them: what its
   camera saw, what a player pressed. The world does not change; without a recording nothing happens. */
KIRI_API kiriResult kiriWorld_Note(kiriWorld* world, const void* bytes, int32_t count);

/* How far a replay has come: all zero at its start. */
typedef struct kiriReplay {
    int64_t offset;   /* in the recording: where it goes on */
    int64_t calls;    /* made so far */
    int64_t ticks;    /* that were not refused */
    const void* note; /* where it stopped at a note: its bytes, in the recording; else null */
    int32_t noteCount;
} kiriReplay;

/* Makes the calls of a recording up to the next tick or note, and that one. The world is to be new, as
   kiriCreateWorld makes it; gravity and budget become those of the recording. What the host has of its own, such as
   memory, log and tasks, stays the host's. Ids are those of the recording: kiriWorld_GetSheets has those of sheets.
   KIRI_PENDING: more follows, call it again. KIRI_OK: that was the end.
   KIRI_ERROR_REPLAY: a call gave another result, other ids or another state than recorded; the line says which. The
   next call goes on behind it.
   KIRI_ERROR_DATA: the bytes are no recording, damaged, cut short, or of a later version; the line says where. Calls
   before that place have been made. So has the last one of a recording that ends within a call, as that of a run which
   crashed. KIRI_ERROR_STATE: the world is not new. KIRI_ERROR_MEMORY: the next call was refused memory, and may be
   tried again. Calls that were refused memory when they were recorded are left out: they changed nothing. Where that
   was a tick and a budget limits cells or samples, the next hashes may differ. */
KIRI_API kiriResult kiriWorld_Replay(kiriWorld* world, const void* recording, int64_t size, kiriReplay* replay);

/* ---- Save and load ---------------------------------------------------------------------------------------------- */

/* A save has what cannot be made again: mesh, frames, cuts that wait, pins, obstacles, blades, ids, events. A world that
   is loaded goes on as the saved one, bit for bit, and ids name the same things: on another machine, and in another
   build of the same version of the library. Only a budget tells them apart: a later cut may take effect in another
   tick. */

/* Writes the world, which only is read. *size: bytes of the save. `bytes` null: they are counted only, and capacity is
   not read; else it has room for `capacity`. KIRI_ERROR_ARGUMENT: that is less than *size; nothing is written.
   KIRI_PENDING: a cut is being worked on; *size is 0, and nothing is written. Save after a later tick, or after
   kiriWorld_FinishCuts. */
KIRI_API kiriResult kiriWorld_Save(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts that wait for a budget
   take effect. The next tick reports the events. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in kiriWorld_Tick.
   Arrays that the world handed out end as with a tick. */
KIRI_API kiriResult kiriWorld_FinishCuts(kiriWorld* world);

/* Replaces the world by a saved one. It may have any hooks; its own allocation, log, clock and tasks stay. The bytes may
   come from anybody: a malicious save may give a strange world but cannot crash the program, and takes memory in
   proportion to its size. Takes about as long as to create the sheets. The profile has no times until the next tick.
   Arrays that the old world handed out live until then. KIRI_ERROR_DATA: the bytes are not a save, damaged, or of another
   version. KIRI_ERROR_MEMORY. Then nothing has changed. A recording has the bytes, up to 2^31 of them. */
KIRI_API kiriResult kiriWorld_Load(kiriWorld* world, const void* bytes, int64_t size);

/* For rollback: copies all of the world, also work on cuts and pieces that wait, into memory of the host. Much faster
   than a save, and exact to the bit. The bytes are good for this process only: never store or send them. Arguments as of
   kiriWorld_Save. */
KIRI_API kiriResult kiriWorld_Snapshot(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

/* Replaces the world by the world of the snapshot; ids name the same things. The bytes are trusted: hand over only the
   output of kiriWorld_Snapshot. KIRI_ERROR_DATA: not a snapshot of this build of the library. KIRI_ERROR_MEMORY. KIRI_ERROR_STATE: the world is recorded. Then nothing has changed. Hooks and arrays as
   with kiriWorld_Load. */
KIRI_API kiriResult kiriWorld_Restore(kiriWorld* world, const void* bytes, int64_t size);

/* ---- Events ----------------------------------------------------------------------------------------------------- */

/* What happened since the start of the last tick that was not refused. */
enum kiriEventType {
    KIRI_EVENT_CUT_FINISHED = 1, /* cut: all of it is in the mesh; the id is stale from now on */
    KIRI_EVENT_PIECE_OFF = 2,    /* frame (its first, which names it), crumb, area: a connected part came off */
    KIRI_EVENT_FRAME_ADDED = 3,  /* frame */
    KIRI_EVENT_DIVERGED = 4,     /* the sheet was put to rest */
    KIRI_EVENT_DEFERRED = 5,     /* stage, waiting: the budget ended in this stage of the sheet's work */
    KIRI_EVENT_PIN_BROKE = 6,    /* pin: its force passed breakForce; the id is stale from now on */
    KIRI_EVENT_PIECE_DETACHED =
        7 /* sheet (the new one), frame, area: what kiriFrame_DetachPiece left waiting is done */
};

/* Of the fields after `sheet` an event has those that its type names; the others are 0, `stage` is -1. */
typedef struct kiriEvent {
    int32_t type; /* KIRI_EVENT_... */
    kiriSheet sheet;
    kiriCut cut;     /* or 0 */
    kiriFrame frame; /* or 0 */
    kiriPin pin;     /* or 0 */
    int32_t crumb;   /* 1: the piece is a crumb, see kiriSheetDef */
    float area;      /* m^2 of the piece, or 0 */
    int32_t stage;   /* KIRI_STAGE_..., or -1 */
    int32_t waiting; /* blade points and ends of cuts that are pending or being worked on; or 0 */
} kiriEvent;

/* *events points to *count events. */
KIRI_API kiriResult kiriWorld_GetEvents(const kiriWorld* world, const kiriEvent** events, int32_t* count);

/* The stages of a tick in their order. */
enum kiriStage {
    KIRI_STAGE_CUT,       /* split the mesh along the blade */
    KIRI_STAGE_GRID,      /* cells and what links them */
    KIRI_STAGE_REGIONS,   /* geodesic distances, regions, links; placing of frames */
    KIRI_STAGE_SHAPE,     /* shape functions */
    KIRI_STAGE_SAMPLES,   /* weights of vertices and collision points */
    KIRI_STAGE_CONSTANTS, /* mass, the pattern of the solver's matrix, and when all is put in force */
    KIRI_STAGE_CONTACT,   /* what touches obstacles, other sheets and other pieces */
    KIRI_STAGE_SOLVE,     /* the motion of the frames */
    KIRI_STAGE_SKIN,      /* positions and normals of the mesh */
    KIRI_STAGE_COUNT
};

/* What the last tick did, and what it took. */
typedef struct kiriProfile {
    double seconds[KIRI_STAGE_COUNT]; /* of the last tick; zero without a clock */
    int32_t cutSegments;              /* blade segments that took effect */

    /* Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    int32_t trianglesSplit, cellsSettled, samplesRefreshed, solverIterations;

    /* What commits changed: cells made or with other material, cells with other weights, vertices and collision points
       with other weights, links that are other than before. Of how many: kiriSheet_GetCounts. */
    int32_t cellsChanged, weightsChanged, verticesChanged, pointsChanged, linksChanged;
    int32_t commits; /* sheets in which a cut took effect */

    int32_t systemsSolved; /* linear systems, large and small */

    int32_t contacts;   /* planes given to the solver: the host's, those of obstacles, and those between sheets */
    int32_t sheetPairs; /* pairs of sheets or pieces, near each other and not both asleep */

    /* The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by a
       fade. */
    double largestJump, largestFade;
} kiriProfile;

/* Of the last tick that was not refused. */
KIRI_API kiriResult kiriWorld_GetProfile(const kiriWorld* world, kiriProfile* profile);

/* For hosts that would rather think in time than in items: the budget whose work would have taken so many microseconds
   a tick at the pace of the profile, which may be the sum of several. Work on cuts and linear systems share the time as
   they did in the profile, and each of triangles, cells and samples gets what the three took together, see kiriBudget.
   Each item that the profile has some of is set; others stay. The simulation never reads a clock: the choice is the
   host's, and a replay must hand in the same budgets. */
KIRI_API kiriResult kiriFitBudget(const kiriProfile* profile, float microseconds, kiriBudget* budget);

/* The name of a stage, for tables; "" for a number that is none. */
KIRI_API const char* kiriGetStageName(int32_t stage);

/* ---- Sheet ------------------------------------------------------------------------------------------------------ */

/* What a sheet is made of: homogeneous, isotropic. */
typedef struct kiriMaterial {
    float youngsModulus; /* Pa, above 0 */
    float poissonsRatio; /* 0 to below 0.5 */
    float thickness;     /* m, above 0 */
    float density;       /* kg/m^3, above 0 */
    float airDamping;    /* 1/s, 0 or more: velocities fade as exp(-airDamping t) */
    float flexDamping;   /* s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation */
} kiriMaterial;

/* Materials to start from; src/world/kiri_preset.c says where their numbers come from. */
enum kiriMaterialPreset {
    KIRI_MATERIAL_PAPER,  /* printing paper, 0.11 mm */
    KIRI_MATERIAL_COTTON, /* cloth, 0.5 mm; the default of a sheet def */
    KIRI_MATERIAL_RUBBER, /* natural rubber, 1 mm */
    KIRI_MATERIAL_FOIL,   /* aluminium, 16 um */
    KIRI_MATERIAL_COUNT
};

/* The numbers of a preset, KIRI_MATERIAL_... */
KIRI_API kiriResult kiriGetMaterial(int32_t preset, kiriMaterial* material);

/* How much work for how much accuracy. The presets are measured (`make accuracy`; tests/sweep.h has the scenes) on a
   strip of stiff paper, 0.2 m x 0.05 m, clamped at one end, with one row of frames, and on a square of 0.2 m that bends
   five times as easily, hangs by two corners, and has half as many rows and columns, rounded up. Let go, they swing for
   0.4 s at 60 ticks a second. Error: rms distance of the vertices from where a much finer run brings them, by the rms
   way that they go; at most, over grids from 4/5 to 5/4 as fine and with frames in regular rows or moved a little.
   FAST: 2 %. BALANCED: 0.8 %. ACCURATE: 0.4 %. What a cut leaves narrow wants more frames: see `accuracy` in the sheet
   def. */
typedef struct kiriQuality {
    int32_t framesAlong;    /* control frames in a row along a strip; a square does with half as many in either
                               direction, rounded up: 3 x 3, 5 x 5, 9 x 9 */
    int32_t gridResolution; /* for the sheet def */
    int32_t iterations;     /* for the sheet def */
    int32_t substeps;       /* for kiriWorld_Tick */
} kiriQuality;

enum kiriQualityPreset { KIRI_QUALITY_FAST, KIRI_QUALITY_BALANCED, KIRI_QUALITY_ACCURATE, KIRI_QUALITY_COUNT };

/* The numbers of a preset, KIRI_QUALITY_... */
KIRI_API kiriResult kiriGetQuality(int32_t preset, kiriQuality* quality);

/* How a sheet deforms. */
enum kiriModel {
    /* Rigid frames joined by links: paper, foil, stiff cloth. 6 unknowns a frame, which its neighbours couple. */
    KIRI_MODEL_LINKS = 0,

    /* Affine frames joined by links: cloth and rubber, whose stretch inside a region is seen. 12 unknowns a frame,
       which neighbours of neighbours couple: a tick takes five to seven times as long as with KIRI_MODEL_LINKS. From
       1e8 Pa or so on it needs more `iterations`, 8 say. */
    KIRI_MODEL_AFFINE = 1,

    /* Affine frames, strains at integration points: the scheme of the paper, to compare with. Weights that vary across
       a strip cannot bend it as a cylinder, however many points there are: a clamped strip on 9 frames goes 3, 20, 51
       and 70 % too short a way down where it is a 10th, 20th, 50th and 400th of its length thick. 12 unknowns a
       frame. */
    KIRI_MODEL_POINTS = 2
};

/* What is seen between the frames, and met by rays, blades, obstacles, other sheets, and contacts of rest points; pins,
   clamps and holds hold it. Where nothing touches or holds the sheet it does not change how that moves. Collision
   points stay on the linear surface. */
enum kiriSkinning {
    KIRI_SKINNING_LINEAR = 0, /* each frame carries a flat patch; the weights blend them (equation 1 of the paper) */
    KIRI_SKINNING_SMOOTH = 1  /* each carries a patch that bends towards its neighbours: no bumps at the frames */
};

/* How time is stepped. Both solve one linear system an iteration. */
enum kiriTimeStepping {
    /* TR-BDF2: trapezoid and BDF2 by turns, of second order. Motion lasts: of the energy of a swinging strip of 9
       frames 96 to 98 % is left after 10 s with 2 substeps a 60th of a second and 1 iteration, 99.7 % with 4. Backward
       Euler takes its place in the steps in which a contact touches a piece, a pin or hold is made, moved or removed,
       or a frame is new or turns by more than a radian. */
    KIRI_TIME_STEPPING_SECOND_ORDER = 0,

    /* Backward Euler, of first order: takes energy out of all that swings, the more the longer the step. Of that
       strip's 0.4 % is left. */
    KIRI_TIME_STEPPING_EULER = 1
};

/* The paper's own ways, to compare with; part of the sheet def. */
typedef struct kiriPaperOptions {
    /* 1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the same bit for bit.
       Default 0. */
    int32_t fromScratch;

    /* 1: when a cut takes effect, only new frames take their motion from the surface: what is seen jumps, and momentum
       is not kept. Default 0. */
    int32_t popping;

    /* 1: the weights of frames are linear on the way from frame to frame, so the surface that is seen has a kink at
       each frame. Always so with KIRI_MODEL_POINTS. Default 0: their slope is zero at the frames. */
    int32_t linearWeights;

    /* KIRI_MODEL_POINTS only. Work grows with the points: spread evenly over the sheet, at least one in every piece;
       default 0: four for each of frameCount. Order 1 (default) takes the strain at a point for all of the material
       around it, order 2 a strain linear in it, at four times the work a point. */
    int32_t integrationPoints; /* 0 to 1048576 */
    int32_t integrationOrder;  /* 1 or 2 */
} kiriPaperOptions;

/* Of a sheet: its rest shape, where it starts, its material, and how it is computed. */
typedef struct kiriSheetDef {
    uint32_t cookie;

    /* The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge. Holes and several parts
       are fine. Copied by kiriCreateSheet; vertices of no triangle are left out. Edges whose ends lie at the same
       places, but are different vertices, are the lips of a cut that is there already; weldDistance closes them. */
    const float* restPositions; /* 2 floats (u, v) a vertex */
    int32_t vertexCount;
    const int32_t* indices; /* 3 a triangle */
    int32_t triangleCount;

    /* Where it starts: x = position + u axisU + v axisV. The axes are orthonormal. */
    float position[3];
    float axisU[3];
    float axisV[3];
    float velocity[3]; /* m/s */

    kiriMaterial material;

    int32_t gridResolution; /* grid squares along the longer side, 1 to 4096; default 32 */
    float
        snapDistance; /* m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a cut
                           keeps within half of it of its line; 0: 1e-4 of the longer side */

    /* Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture coordinates, and triangles
       without shared vertices (STL). In the order of vertices, each becomes the nearest vertex that was kept before and
       is nearer than this; else it is kept. So none moves farther, and a chain of near vertices is not one point. A
       triangle with two corners at one vertex is left out. kiriSheet_CopySources leads to the vertices of the def.
       Default 0: vertices are as the indices say. */
    float weldDistance;

    /* Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
       frames are spread evenly, some of them in pairs at both sides of slit ends. The grid carries one frame for every
       two squares of material at most: more are refused (KIRI_ERROR_ARGUMENT), and re-sampling stops there. A new sheet
       has no more frames than frameCount, or than pieces where these are more.
       frameCount 0: as many as the sheet needs: a region is split while its size, 2.45 times its radius of gyration,
       exceeds 1.25 frameLength, after cuts too: so arms that a cut leaves get frames along them. frameLength 0: it
       follows from `accuracy`, the relative error of the shape under the sheet's own weight that is good enough, but is
       three squares of the grid at least. kiriSheet_EstimateError says what came of it. */
    int32_t frameCount; /* 0, or 1 and more; default 5 */
    float frameLength;  /* m; used where frameCount is 0; default 0 */
    float accuracy;     /* 1e-4 to 1; used where frameCount and frameLength are 0; default 0.02 */
    const float* framePoints;
    int32_t maxFrames; /* re-sampling stops here; default 256 */

    /* Re-sampling (section 5 of the paper): a frame whose weight exceeds rigidWeight over an area larger than rigidArea
       (m^2) gets others beside it. In a new sheet this is done only with frameCount 0. After cuts it is done where the
       area is also larger than in the new sheet: when a cut ends, or has met the border or another cut. A sheet that is
       to stay rigid sets frameCount and maxFrames to 1. rigidArea 0: a quarter of the area that a frame has at the
       start. */
    float rigidWeight; /* default 0.95 */
    float rigidArea;   /* default 0 */

    /* A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it. Default
       0. */
    float crumbArea;

    /* Contact, see below. */
    float friction; /* of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric mean.
                       Default 0.5 */
    float contactThickness; /* m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the
                               material's thickness, a 20th of a grid square at least. Default 0 */
    uint32_t groups;        /* obstacles and sheets touch where a bit is set in the groups of both. Default: all */

    /* 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
       two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other by
       planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
       feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays, and
       momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its
       vertices, about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps
       around the border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece
       do not touch each other. Pieces that touch wake and fall asleep together. Default 0. */
    int32_t touchesSheets;

    int32_t collisionPoints; /* spread evenly over the sheet, at least one in every piece; default 0: none */
    int32_t iterations; /* Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual */

    /* A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
       asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
       effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
       something that moves and comes near. Gravity, wind, settings and kiriSheet_Wake wake all pieces of the sheet. The
       ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps. */
    float sleepSpeed;

    int32_t model;    /* KIRI_MODEL_..., default KIRI_MODEL_LINKS */
    int32_t skinning; /* KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR */

    /* 1: the sheet stays in the plane where it starts, without bending; what velocities, forces and held positions
       have across the plane is dropped. 3 unknowns a rigid frame, 6 an affine one: two thirds of the solver's work, or
       about a third. Default 0. */
    int32_t planar;

    int32_t timeStepping; /* KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */

    /* When a cut takes effect, weights change, and what is seen between the frames would jump. The difference fades
       within this time (s). So does the difference of strain in links of KIRI_MODEL_LINKS whose borders have moved.
       Default 0.2; 0: at once. */
    float fadeTime;

    /* 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and kiriSheet_CopyVertices copies none; this
       saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
       other sheets touch it, the tick makes normals for itself. So does kiriSheet_GetSolid; and what kiriSheet_GetPoint
       says is the same to rounding. Default 1. */
    int32_t normals;

    kiriPaperOptions paper; /* default: none of the paper's own ways */
} kiriSheetDef;

/* Fills the def with its defaults, and stamps it. It has no mesh yet. */
KIRI_API void kiriDefaultSheetDef(kiriSheetDef* def);

/* Adds a sheet. On failure *sheet is 0. KIRI_ERROR_MESH: the triangles do not form a sheet. The line names a triangle,
   or the two triangles at an edge, by their numbers in the def, and says why. */
KIRI_API kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet);

/* The sheet is gone, with its cuts, frames and pins; their ids are stale. */
KIRI_API kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet);

/* A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles;
   columns and rows are 1 to 4096. def: all but the mesh, which is not read; null: the defaults. A recording has it as
   kiriCreateSheet. */
KIRI_API kiriResult kiriCreateRectangle(kiriWorld* world, float width, float height, int32_t columns, int32_t rows,
                                        const kiriSheetDef* def, kiriSheet* sheet);

/* What of the def may be changed while the sheet lives, as there. kiriSheet_GetSettings stamps it. */
typedef struct kiriSheetSettings {
    uint32_t cookie;
    kiriMaterial material;
    int32_t maxFrames;
    float crumbArea;
    float friction, contactThickness;
    uint32_t groups;
    int32_t touchesSheets;
    int32_t iterations;
    float sleepSpeed;
    int32_t skinning, timeStepping;
    float fadeTime; /* stays 0 with paper.popping */
    int32_t normals;
} kiriSheetSettings;

/* What they are now, stamped for kiriSheet_SetSettings. */
KIRI_API kiriResult kiriSheet_GetSettings(const kiriWorld* world, kiriSheet sheet, kiriSheetSettings* settings);

/* Checked as the def is: all or nothing. KIRI_ERROR_DEF: they did not come from GetSettings. The sheet wakes where one
   is other than before. Places and velocities stay: with another mass so momentum changes. Stiffnesses that pins have,
   and the lengths that frames were spread by, stay as they are. */
KIRI_API kiriResult kiriSheet_SetSettings(kiriWorld* world, kiriSheet sheet, const kiriSheetSettings* settings);

/* A rectangle from (0, 0) to (width, height) for a sheet def: writes 2 * (columns + 1) * (rows + 1) floats and
   6 * columns * rows indices. columns and rows are 1 to 4096. */
KIRI_API kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions,
                                      int32_t* indices);

/* The triangles that are seen, as after the last tick. revision grows whenever indices or vertices are added or
   changed. Rest positions are floats, 6e-8 of the distance from the origin of the rest plane apart: where triangles are
   not much larger than that, they look flat or inverted. The library computes with the positions of the def to 2^-29 of
   the sheet; sourceTriangles and sourceWeights are as exact as the sheet is large. */
typedef struct kiriMesh {
    const float* positions;         /* 3 a vertex, m, world */
    const float* normals;           /* 3 a vertex, unit; null where the sheet makes none */
    const float* restPositions;     /* 2 a vertex, m */
    const int32_t* indices;         /* 3 a triangle */
    const int32_t* sourceTriangles; /* 1 a vertex: the triangle of the def that it lies in, */
    const float* sourceWeights;     /* 3 a vertex: and its barycentric coordinates there */
    int32_t vertexCount;
    int32_t triangleCount;
    uint32_t revision;
} kiriMesh;

/* The arrays, without a copy. */
KIRI_API kiriResult kiriSheet_GetMesh(const kiriWorld* world, kiriSheet sheet, kiriMesh* mesh);

/* So many items from the first on. */
typedef struct kiriRange {
    int32_t first, count;
} kiriRange;

/* What has changed in the mesh, for hosts that keep a copy of it, on a GPU say. Positions and normals change with every
   tick; all else of a vertex, and the corners of a triangle, only in these ranges. */
typedef struct kiriDirty {
    kiriRange newVertices, newTriangles; /* up to the last one of the mesh */
    kiriRange oldVertices, oldTriangles; /* the least ranges that hold all older ones with other data */
    uint32_t revision;                   /* for the next call */
} kiriDirty;

/* What changed since the host saw that revision; all of the mesh where that is too long ago, or 0. */
KIRI_API kiriResult kiriSheet_GetDirty(const kiriWorld* world, kiriSheet sheet, uint32_t sinceRevision,
                                       kiriDirty* dirty);

/* Copies positions and normals of some vertices, 3 floats each, to where the host wants them; strides in bytes, 12 or
   more. Null: without these. KIRI_ERROR_STATE: normals of a sheet that makes none. */
KIRI_API kiriResult kiriSheet_CopyVertices(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                           void* positions, int32_t positionStride, void* normals,
                                           int32_t normalStride);

/* Copies the index that some vertices had when the last call of kiriWorld_Tick began, for hosts that draw between two
   ticks. *from: the sheet that had them then, which is another one if this sheet was a piece of it. A vertex that a cut
   tore off another one gets the index of the other. -1: the vertex did not exist; so all vertices of a sheet that was
   created or loaded since. The manual has the code (drawing). */
KIRI_API kiriResult kiriSheet_CopyPrevious(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                           int32_t* vertices, kiriSheet* from);

/* Copies the indices of some triangles, 3 each, as 16-bit numbers. KIRI_ERROR_STATE: there are more than 65535
   vertices. */
KIRI_API kiriResult kiriSheet_CopyIndices16(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle,
                                            int32_t count, uint16_t* indices);

/* Map triangles to the def, to draw with data that the host keeps by its own vertices. Sources: the triangle of the def
   that contains each; -1 for one that has left (its corners are equal). Weights: 9 floats each, the barycentric
   coordinates of its three corners in that triangle. They are right on both sides of a seam that weldDistance has
   closed; sourceTriangles name a triangle on one side. The manual has the code (meshes). */
KIRI_API kiriResult kiriSheet_CopySources(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                          int32_t* sources);
KIRI_API kiriResult kiriSheet_CopySourceWeights(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle,
                                                int32_t count, float* weights);

/* The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the lips of cuts. First
   come the vertices of kiriMesh on the side that the normal leaves, then the same on the other side, then four for each
   edge of the border, so that rims are flat and their edges sharp. */
typedef struct kiriSolid {
    const float* positions;     /* 3 a vertex, m, world */
    const float* normals;       /* 3 a vertex, unit, outwards */
    const float* restPositions; /* 2 a vertex, m */
    const int32_t* indices;     /* 3 a triangle, counter-clockwise from outside */
    const int32_t* sources;     /* 1 a vertex: that of kiriMesh which it stands on */
    int32_t vertexCount;
    int32_t triangleCount;
    int32_t rimTriangle; /* from this one on triangles are rims */
} kiriSolid;

/* thickness: m, 0: that of the material. Made when it is asked for. */
KIRI_API kiriResult kiriSheet_GetSolid(kiriWorld* world, kiriSheet sheet, float thickness, kiriSolid* solid);

/* Collision points: 3 floats of position (m, world) a point. */
KIRI_API kiriResult kiriSheet_GetCollisionPoints(const kiriWorld* world, kiriSheet sheet, const float** positions,
                                                 int32_t* count);

/* How many there are of each. */
typedef struct kiriCounts {
    int32_t vertices, triangles, cells, frames, links, pieces, collisionPoints;
} kiriCounts;

/* Costs nothing. */
KIRI_API kiriResult kiriSheet_GetCounts(const kiriWorld* world, kiriSheet sheet, kiriCounts* counts);

/* Area (m^2), mass (kg), kinetic energy and elastic energy (J), linear and angular momentum about the world's origin
   (kg m/s, kg m^2/s), centre of mass (m). */
typedef struct kiriTotals {
    double area, mass, kineticEnergy, elasticEnergy;
    double center[3], momentum[3], angularMomentum[3];
} kiriTotals;

/* Sums over the frames, made when they are asked for. */
KIRI_API kiriResult kiriSheet_GetTotals(const kiriWorld* world, kiriSheet sheet, kiriTotals* totals);

/* An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly: rms distance from where a
   sheet of very many frames would be under the same loads, over the rms way that it has gone from its flat shape; 0 to
   1, and 1 where there are too few frames to tell. It compares the strains of neighbouring links (KIRI_MODEL_LINKS
   only; else KIRI_ERROR_STATE). Measured on cantilevers and on a sheet with a slit, of 3 to 140 frames, it is not below
   a third of the error, and not above four times the error or, where that is below 0.5 %, 1.5 %. Where a sheet also
   turned as a whole, as by hanging from two corners, it says up to ten times too much. It knows nothing of errors of
   the grid, of time stepping, and of loads that are finer than frames. It takes memory and time for one pass over the
   links, when it is called. */
KIRI_API kiriResult kiriSheet_EstimateError(const kiriWorld* world, kiriSheet sheet, double* relative);

/* *awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do. kiriSheet_Wake wakes
   all of them. */
KIRI_API kiriResult kiriSheet_IsAwake(const kiriWorld* world, kiriSheet sheet, int32_t* awake);
KIRI_API kiriResult kiriSheet_Wake(kiriWorld* world, kiriSheet sheet);

/* Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities turn. The columns of
   `rotation` are where R takes the axes of the world; a planar sheet turns about its normal only. It wakes. Targets of
   its pins, hinges, clamps and holds go along, so nothing draws it back. To set a target to its current value changes
   nothing. A target that the host has set nearer to the new place of the pin than to the old one stays: so the host may
   set targets before or after. Pins on an obstacle stay on it: put the obstacle elsewhere by the same motion
   (kiriObstacle_SetPose), before or after. Loads and contacts that wait for the next tick stay. */
KIRI_API kiriResult kiriSheet_Transform(kiriWorld* world, kiriSheet sheet, const float rotation[9],
                                        const float translation[3]);

/* From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
   `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow their
   hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone. */
KIRI_API kiriResult kiriSheet_SetVelocity(kiriWorld* world, kiriSheet sheet, const float velocity[3],
                                          const float angularVelocity[3]);
KIRI_API kiriResult kiriFrame_SetPieceVelocity(kiriWorld* world, kiriFrame frame, const float velocity[3],
                                               const float angularVelocity[3]);

/* A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
   kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
   parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
KIRI_API kiriResult kiriSheet_SetUserData(kiriWorld* world, kiriSheet sheet, uint64_t data);
KIRI_API kiriResult kiriSheet_GetUserData(const kiriWorld* world, kiriSheet sheet, uint64_t* data);
KIRI_API kiriResult kiriPin_SetUserData(kiriWorld* world, kiriPin pin, uint64_t data);
KIRI_API kiriResult kiriPin_GetUserData(const kiriWorld* world, kiriPin pin, uint64_t* data);
KIRI_API kiriResult kiriFrame_SetPieceUserData(kiriWorld* world, kiriFrame frame, uint64_t data);
KIRI_API kiriResult kiriFrame_GetPieceUserData(const kiriWorld* world, kiriFrame frame, uint64_t* data);

/* What a ray meets. */
typedef struct kiriHit {
    float restPoint[2]; /* where to cut */
    float position[3];
    float normal[3];
    float distance; /* m along the direction, which need not be a unit vector */
    int32_t triangle;
} kiriHit;

/* Where a ray first meets the sheet, up to maxDistance. KIRI_OK with hit->triangle = -1: nowhere. The first ray looks
   at every triangle; the next tick makes boxes over them, and as long as somebody asks every now and then (in 120
   ticks) they follow the sheet: a ray takes some microseconds, and a tick of a large sheet a quarter more. */
KIRI_API kiriResult kiriSheet_Raycast(const kiriWorld* world, kiriSheet sheet, const float origin[3],
                                      const float direction[3], float maxDistance, kiriHit* hit);

/* The first sheet that a ray meets; *sheet is 0 where there is none. */
KIRI_API kiriResult kiriWorld_Raycast(const kiriWorld* world, const float origin[3], const float direction[3],
                                      float maxDistance, kiriSheet* sheet, kiriHit* hit);

/* A point of the material, as it is seen. */
typedef struct kiriPointState {
    float position[3], normal[3]; /* m, world; unit */
    float velocity[3];            /* m/s, by the weights of the point */
    kiriFrame frame;              /* in whose region it is; it names the piece, too */
} kiriPointState;

/* Outside the sheet: KIRI_ERROR_ARGUMENT. On a cut, the lip that holds the point; either where both do. */
KIRI_API kiriResult kiriSheet_GetPoint(const kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                       kiriPointState* state);

/* The shape functions at a rest point: up to `capacity` frames with their weights (sum 1) and, unless null, gradients
   (2 floats a frame, 1/m). *count is how many there are, however many fit. Outside the sheet: KIRI_ERROR_ARGUMENT;
   while work on a cut waits for its budget: KIRI_ERROR_STATE. */
KIRI_API kiriResult kiriSheet_GetWeights(const kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                         kiriFrame* frames, float* weights, float* gradients, int32_t capacity,
                                         int32_t* count);

/* ---- Piece ------------------------------------------------------------------------------------------------------ */

/* The connected parts of a sheet. A piece is named by any of its frames. To go through all of them there are indices
   too, from 0 on to kiriCounts.pieces, in the order of first frames: they change when a piece comes off or is taken
   away; kiriFrame_GetPiece has that of now. A cut whose work waits for its budget has not parted anything yet. Momentum
   is about the world's origin. */
typedef struct kiriPieceState {
    double area, mass;                                    /* m^2, kg */
    double center[3], momentum[3], angularMomentum[3];    /* of mass, m; kg m/s; kg m^2/s */
    float lower[3], upper[3];                             /* m, world: the least box around its vertices */
    int32_t frames, vertices, triangles, collisionPoints; /* how many */
    int32_t crumb;                                        /* 1: see kiriSheetDef */
    int32_t asleep;                                       /* 1: see sleepSpeed */
} kiriPieceState;

/* What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece after piece. */
typedef struct kiriPieceMesh {
    const int32_t* vertices;        /* of kiriMesh */
    const int32_t* triangles;       /* of kiriMesh */
    const int32_t* indices;         /* 3 a triangle, as in kiriMesh: draw them */
    const int32_t* collisionPoints; /* see kiriSheet_GetCollisionPoints */
    int32_t vertexCount, triangleCount, collisionPointCount;
} kiriPieceMesh;

/* The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An index that
   is no piece's: KIRI_ERROR_ARGUMENT. */
KIRI_API kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state);
KIRI_API kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh);

/* *frames points to *count ids. */
KIRI_API kiriResult kiriSheet_GetPieceFrames(kiriWorld* world, kiriSheet sheet, int32_t piece, const kiriFrame** frames,
                                             int32_t* count);

/* The index that the piece with this frame has now. */
KIRI_API kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece);

/* Makes a sheet of the piece with this frame. Its frames, pins and collision points move along, in their order; they
   keep their ids and states, and what waits for the next tick: the motion goes on as if nothing had happened, but for
   the solver's guard over energy and step length, which is one for each sheet. A clamp or hinge that holds both becomes
   two: the rest keeps the id, the new sheet's has one of its own (kiriSheet_GetPins). Both sheets have all settings (of
   collisionPoints and integrationPoints the share that falls to their area), maxFrames each for itself; a piece that
   sleeps goes on sleeping. Cuts stay with the rest: a blade in the piece cuts nothing until it is back. Indices of
   collision points of the rest change. Its triangles and vertices keep their indices where it has more than 4096
   vertices, and while no more than half of them are of pieces that went: these triangles have three equal corners,
   these vertices are of no triangle.
   Else all move together, and their indices change. In either case its revision grows, and kiriSheet_GetDirty says what
   changed. The new sheet has the squares of the grid around it, at about 40 bytes a square: crumbs are better dropped.
   Costs what the piece takes to make, and a look at the weights of what is left; where indices change more.
   KIRI_PENDING: work on a cut is at hand in the sheet, or it takes more samples than the budget leaves calls before the
   next tick; *detached is 0. When the work is done, what is the piece of this frame then becomes a sheet, and
   KIRI_EVENT_PIECE_DETACHED names it. Samples pay for it before, over several ticks if need be, of many pieces one
   after the other: of the first that waits 3 for each vertex, 2.5 to 9 for each cell (the more frames, the more) and
   100 for each frame, of others 3 for each vertex and 1.4 for each cell; and one for 80 vertices of the rest. Until
   then further cuts of the sheet wait. The first piece is made as it is paid, and leaves at the start of the tick after
   the last sample is paid. That tick does an eighth of the work; the first tick after a load makes the parts again that
   saves leave out. The coming ticks have fewer samples for the work of calls.
   KIRI_ERROR_STATE: nothing would be left of the sheet. */
KIRI_API kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached);

/* The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but for making a sheet: that
   is done at once, and the coming ticks have less. Where kiriSheet_GetMesh has been called since the last tick, all
   indices are copied.
   KIRI_PENDING: work on a cut is at hand. The piece is gone all the same: its triangles are in kiriMesh, with three
   equal corners; it touches nothing; no point of it is found. When the work is done its vertices go, too; until then
   kiriCounts still counts it, and its kiriPieceState is all zeros. */
KIRI_API kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame);

/* The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece count once.
   Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together. detached[i] is the sheet that
   the piece of frames[i] has become, 0 where it waits. */
KIRI_API kiriResult kiriWorld_DetachPieces(kiriWorld* world, const kiriFrame* frames, int32_t count,
                                           kiriSheet* detached);
KIRI_API kiriResult kiriWorld_DestroyPieces(kiriWorld* world, const kiriFrame* frames, int32_t count);

/* Destroys all pieces below an area (m^2) except the largest piece, at the cost of one. *count is how many. Where that
   one waits to become a sheet, the largest of the others stays, too. */
KIRI_API kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count);

/* ---- Cut -------------------------------------------------------------------------------------------------------- */

/* A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet cuts nothing. Points wait
   until the next tick. The end of a cut that lies inside the sheet stays closed until the blade moves on. */
KIRI_API kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut);

/* restPoints: 2 floats a point; count is 1 to 2^24. */
KIRI_API kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count);

/* No more points come. After the tick in which the last of them takes effect the id is stale, and
   KIRI_EVENT_CUT_FINISHED tells. Frames that the sheet needs after the cut are added then. */
KIRI_API kiriResult kiriCut_End(kiriWorld* world, kiriCut cut);

/* A blade (a straight edge) that moves in world space from blade[0]-blade[1] to blade[3]-blade[2] cuts where the swept
   quadrilateral meets the sheet as it is now, past borders, so that it parts what it crosses. The cut is ended already.
   Slices of a sheet that moves do not join from tick to tick: for that take a blade. */
KIRI_API kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut);

/* ---- Blade ------------------------------------------------------------------------------------------------------ */

/* A blade in world space that goes on from tick to tick: a knife, a mouse, a finger. It remembers, in the material of
   each layer that it is in, where it was, and cuts on from there: along the way of its edge relative to that material,
   whatever the sheet did in between. Where it passes a border of the material, the outline or a lip, the cut goes on
   past it, so that it parts. A cut that began amid the material, and comes by its beginning by 1.5 % of its length or
   nearer, is closed there when it has gone on by a tenth of its length or ends: so a disc comes out of a circle drawn
   by hand. A blade that is held still cuts nothing within 64 snap distances of the slit that it is in: cloth sways about
   it. Move it at least once a tick while it is in a sheet; as often as you like before a tick. What it
   has met is cut with the next tick or, by the budget, a later one. It has a cut for each layer, which begins and ends
   as the blade comes in and goes out; KIRI_EVENT_CUT_FINISHED tells of them, too. */

/* sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of their own. A blade for one
   sheet whose sheet is gone cuts nothing. */
KIRI_API kiriResult kiriBeginBlade(kiriWorld* world, kiriSheet sheet, kiriBlade* blade);

/* The blade is now the straight edge between two points (m, world). From where it was it got there straight, each end
   along a line. The first call only says where it begins. Where an end of the edge lies inside of what it sweeps of the
   sheet, it cuts only what it sweeps. An edge without length cuts nothing. */
KIRI_API kiriResult kiriBlade_MoveEdge(kiriWorld* world, kiriBlade blade, const float from[3], const float to[3]);

/* The same for a ray that a camera casts: an edge `length` m long. */
KIRI_API kiriResult kiriBlade_MoveRay(kiriWorld* world, kiriBlade blade, const float origin[3],
                                      const float direction[3], float length);

/* It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends. */
KIRI_API kiriResult kiriBlade_End(kiriWorld* world, kiriBlade blade);

/* ---- Frame ------------------------------------------------------------------------------------------------------ */

/* Pose, motion and region of a frame. */
typedef struct kiriFrameState {
    float restPoint[2];
    float position[3];        /* of the rest point */
    float rotation[9];        /* columns: direction of u, direction of v, normal; of an affine frame the columns of A,
                                 which stretch with the sheet */
    float velocity[3];        /* m/s */
    float angularVelocity[3]; /* rad/s */
    float area;               /* m^2 of its region */
    float mass;               /* kg */
    int32_t held;             /* 1: moved by the host, see kiriFrame_Hold */
} kiriFrameState;

/* Writes up to `capacity` ids of the sheet's frames; *count is how many there are. */
KIRI_API kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity,
                                        int32_t* count);

/* Pose, motion and region as they are now. */
KIRI_API kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state);

/* The host moves the frame: its rest point, as it is seen, goes to `position` with `rotation` (a rotation matrix,
   columns as above) in the next tick, evenly, and stays there until the next call. An affine frame is not stretched
   then. On a planar sheet the rotation is about its normal. Null, null: it is free again. Contacts do not push material
   that held frames carry for more than half: it goes where the host has it, through obstacles too. */
KIRI_API kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9]);

/* With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the frame's rest point; means
   over the last tick, impulses divided by its dt. They carry the frame's own weight and change its momentum, too. Zero
   for a frame that was free. A piece that sleeps keeps those that it fell asleep with. */
KIRI_API kiriResult kiriFrame_GetReaction(const kiriWorld* world, kiriFrame frame, double force[3], double torque[3]);

/* ---- Load ------------------------------------------------------------------------------------------------------- */

/* Forces, torques, line loads and pressures act throughout the next tick, all of its substeps, and are gone then. They
   add up. They act on the frames that hold the material when they are given, from where the sheet is then: turn and
   place of a load do not follow the sheet within the tick. A tick that is refused (KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT)
   uses none of them up. */

/* A force (N, world) on the frame's centre of mass and a torque (N m). */
KIRI_API kiriResult kiriFrame_ApplyForce(kiriWorld* world, kiriFrame frame, const float force[3],
                                         const float torque[3]);

/* A force (N, world) on a point of the material and a torque (N m). */
KIRI_API kiriResult kiriSheet_ApplyForce(kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                         const float force[3], const float torque[3]);

/* A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in the material, edges
   included. Where it runs along a cut, each lip gets half. The ends differ; a line that meets no material:
   KIRI_ERROR_ARGUMENT. */
KIRI_API kiriResult kiriSheet_ApplyLineLoad(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                            const float forcePerLength[3]);

/* A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0. */
KIRI_API kiriResult kiriSheet_ApplyPressure(kiriWorld* world, kiriSheet sheet, float pressure);

/* An impulse (N s, world) on a point of the material, where it is seen now. Velocities change at once, by as much as
   the frames that carry the point resist; a held frame's part is lost. Outside the sheet: KIRI_ERROR_ARGUMENT. */
KIRI_API kiriResult kiriSheet_ApplyImpulse(kiriWorld* world, kiriSheet sheet, const float restPoint[2],
                                           const float impulse[3]);

/* Air that moves past the sheet, in every tick until the next call. On each square metre act, with v the velocity of
   the air less that of the material, and n the normal: density / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)). Zero
   velocity with drag and lift above zero: still air, which resists. All zero: none. It acts at four points of the
   region of each frame, and follows its motion within the tick: sheets flutter, and no wind is too strong. Gusts are a
   call a tick. Wind that stays as it is lets a sheet sleep. */
typedef struct kiriWind {
    float velocity[3]; /* m/s */
    float density;     /* kg/m^3, 0 or more; 1.2 of air */
    float drag, lift; /* 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along
                          the sheet, 0.01 or so of a smooth one */
} kiriWind;

/* Copied; it blows until the next call. */
KIRI_API kiriResult kiriSheet_SetWind(kiriWorld* world, kiriSheet sheet, const kiriWind* wind);

/* ---- Pin -------------------------------------------------------------------------------------------------------- */

/* A pin holds a point of the material at its target, by a spring. */
typedef struct kiriPinDef {
    uint32_t cookie;
    float restPoint[2];    /* in the material */
    float target[3];       /* m, world: where it is held */
    float stiffness;       /* N/m; 0: ten times Young's modulus times thickness */
    float breakForce;      /* N: it breaks (KIRI_EVENT_PIN_BROKE) in a tick in which it held with more; 0: never */
    kiriObstacle obstacle; /* or 0. The target goes with this obstacle from where it is when the pin is made, or
                              kiriPin_SetTarget puts it, and the obstacle feels the pin (kiriObstacle_GetState); one
                              with mass yields to it within the tick. When it is destroyed the target stays where it
                              was */
} kiriPinDef;

/* Fills the def with its defaults, and stamps it. */
KIRI_API void kiriDefaultPinDef(kiriPinDef* def);

/* Pins a point of the sheet. On failure *pin is 0. A point outside the sheet: KIRI_ERROR_ARGUMENT. */
KIRI_API kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin);

/* Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and direction of
   the material there, as a vice does; a hinge its place only, so that the sheet may turn about the line. Both begin
   where the material is now; the line stays straight, and as long as it is at rest: so material that is bent there is
   pulled straight, and pieces that have come apart are pulled together, however fast that makes them.

   They hold what the line meets, edges included, with the stiffness that the material has between the line and the
   frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of frames, where
   kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two sides, so that neither
   bends the other. A line that runs along a cut holds both lips; one beside it, by a 512th of a square of the grid or
   more, holds one. The ends differ; a line that meets no material: KIRI_ERROR_ARGUMENT. */
KIRI_API kiriResult kiriSheet_ClampLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                        kiriPin* clamp);
KIRI_API kiriResult kiriSheet_HingeLine(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                        kiriPin* hinge);

/* Where the pin holds its point, or the middle of its line (m, world): at the end of the next tick, and until the next
   call. Within the tick it goes there evenly. The current target of kiriPin_GetState changes nothing. With
   KIRI_SKINNING_SMOOTH what pins and clamps hold is what is seen there; of a clamp the mean along its line, for each
   piece: single points of the line are seen a little off it. */
KIRI_API kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3]);

/* The same with the rotation of the line's material: columns are the directions of u and v and the normal. On a planar
   sheet it is about the sheet's normal. KIRI_ERROR_ARGUMENT for a pin that holds a point. */
KIRI_API kiriResult kiriPin_SetPose(kiriWorld* world, kiriPin pin, const float target[3], const float rotation[9]);

/* As in the def, for pins of all types; N, 0: it never breaks. */
KIRI_API kiriResult kiriPin_SetBreakForce(kiriWorld* world, kiriPin pin, float breakForce);

/* What a pin holds. */
enum kiriPinType { KIRI_PIN_POINT, KIRI_PIN_HINGE, KIRI_PIN_CLAMP };

/* What a pin is, and where it holds. */
typedef struct kiriPinState {
    int32_t type; /* KIRI_PIN_... */
    kiriSheet sheet;
    float from[2], to[2]; /* rest position: of a point, twice, or of the ends of the line */
    float target[3];
    float rotation[9];     /* of a line; of a point the identity */
    float breakForce;      /* N, or 0 */
    kiriObstacle obstacle; /* that it goes with, or 0 */
} kiriPinState;

/* What it is, and where it holds now. */
KIRI_API kiriResult kiriPin_GetState(const kiriWorld* world, kiriPin pin, kiriPinState* state);

/* With what the pin acted on the sheet: force (N, world) and torque (N m) about its target; means over the last tick,
   impulses divided by its dt. So the reactions of all pins and held frames are the weight of a sheet at rest, and in
   motion what changes its momentum (as far as `iterations` have the tick solved). Zero before the first tick. A piece
   that sleeps keeps those that it fell asleep with. */
KIRI_API kiriResult kiriPin_GetReaction(const kiriWorld* world, kiriPin pin, double force[3], double torque[3]);

/* Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are. */
KIRI_API kiriResult kiriSheet_GetPins(const kiriWorld* world, kiriSheet sheet, kiriPin* pins, int32_t capacity,
                                      int32_t* count);

/* It lets go; its id is stale. */
KIRI_API kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin);

/* A point of the material that touches something: the plane dot(normal, x) = offset keeps it on its upper side, with as
   much force as that takes, and Coulomb friction acts along the plane. The plane is that of an obstacle of the host,
   who finds it anew for each tick from where the sheet is seen. A contact may lie in the path of the point, above or
   below it: one that does not reach its plane in the tick costs little and does nothing. */
typedef struct kiriContact {
    int32_t point;      /* index of the collision point; -1: restPoint says which point of the material */
    float restPoint[2]; /* in the material; only read where point is -1 */
    float normal[3];    /* unit, out of the obstacle */
    float offset;       /* m: of the obstacle's surface at the start of the tick */
    float velocity[3]; /* m/s: of the obstacle there. The plane moves with it within the tick, and friction acts against
                           the sliding that is left */
    float friction;    /* 0 or more: of both sides together */
    float inverseMass; /* 1/kg, 0 or more: of the obstacle as felt along the normal there, 1/m + (r x n) . I^-1 (r x n);
                           0: it does not yield */
    float pushSpeed;   /* m/s, 0 or more: a point that starts below the plane is pushed out no faster. 0: 1 m/s */
    int32_t obstacle;  /* the host's number. Contacts of one number press on one obstacle, and share its mass */
} kiriContact;

/* The contacts of the next tick; they replace those of an earlier call, and are gone after the tick. A contact is known
   again by its point, or its rest point, and its obstacle: what it pushed with is where the next tick starts. */
KIRI_API kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts,
                                          int32_t count);

/* What a contact did in the last tick. */
typedef struct kiriContactForce {
    double impulse[3];       /* N s, on the sheet: the sum over the tick. The obstacle gets the opposite */
    double position[3];      /* m, world: where it acted, the point of the sheet at the end of the tick */
    double depth;            /* m: how deep the point is below the plane at the end of the tick; below 0: above it */
    int32_t point, obstacle; /* as in the contact */
} kiriContactForce;

/* One for each contact that was set before the last tick, in the order given. The sum of the impulses, with those of
   gravity, loads and obstacles, is the change of momentum of a piece that nothing holds. A piece that sleeps goes on to
   press with what it fell asleep with. */
KIRI_API kiriResult kiriSheet_GetContactForces(const kiriWorld* world, kiriSheet sheet, const kiriContactForce** forces,
                                               int32_t* count);

/* ---- Obstacle --------------------------------------------------------------------------------------------------- */

/* A body that sheets touch: a floor, a ball, a crate of another engine. Kiri moves no obstacle by forces. An obstacle
   goes on with its velocities; a host that moves bodies by an engine of its own sets pose and velocities before each
   tick, and gives the impulse that kiriObstacle_GetState tells to that engine after it. Contacts follow its motion
   within the tick, and push no harder than its mass resists. Sheets stay half their contactThickness away from it; that
   is what is seen of them, with smooth skinning too. A sheet that rests wakes where an obstacle near it comes, goes, or
   has moved by half a second of its sleepSpeed. Lengths of shapes are up to 1e6 m. */
enum kiriObstacleType {
    KIRI_OBSTACLE_PLANE,    /* all below the plane through its position; the third column of its rotation points out */
    KIRI_OBSTACLE_SPHERE,   /* radius */
    KIRI_OBSTACLE_CAPSULE,  /* radius, height: of its axis, the third column, between the middles of its round ends */
    KIRI_OBSTACLE_BOX,      /* size: lengths of its edges along the columns of its rotation */
    KIRI_OBSTACLE_CYLINDER, /* radius, height: along the third column */
    KIRI_OBSTACLE_PRISM     /* outline: a convex polygon in the plane of the first two columns; height: along the third,
                               0: without end */
};

/* Of an obstacle: its shape, where it is, its motion, and its mass. */
typedef struct kiriObstacleDef {
    uint32_t cookie;
    int32_t type;             /* KIRI_OBSTACLE_... */
    float size[3];            /* m */
    float radius, height;     /* m */
    const float* outline;     /* 2 floats a corner, m, counter-clockwise; copied */
    int32_t outlineCount;     /* 3 to 64 */
    float rounding;           /* m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0 */
    float position[3];        /* m, world */
    float rotation[9];        /* columns; default: the axes of the world */
    float velocity[3];        /* m/s, of its position */
    float angularVelocity[3]; /* rad/s */
    float surfaceVelocity[3]; /* m/s, world: of its surface beside that, as of a conveyor */
    float friction;           /* 0 or more; default 0.5 */
    float mass;               /* kg; 0 (default): nothing moves it */
    float inertia[6];      /* kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz.
                         Positive definite, but for axes whose numbers are all 0: it does not turn about these */
    float centerOfMass[3]; /* m, from its position in its own axes */
    uint32_t body;         /* obstacles of the same number, but 0, are parts of one body, whose mass each of them has */
    float pushSpeed;       /* m/s, above 0: what is inside is pushed out no faster. Default 1 */
    uint32_t groups;       /* see the sheet def. Default: all */
} kiriObstacleDef;

/* Fills the def with its defaults, and stamps it. */
KIRI_API void kiriDefaultObstacleDef(kiriObstacleDef* def);

/* Adds an obstacle. On failure *obstacle is 0. */
KIRI_API kiriResult kiriCreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle);

/* It is gone, its id stale. What rested on it wakes. */
KIRI_API kiriResult kiriDestroyObstacle(kiriWorld* world, kiriObstacle obstacle);

/* Where it is when the next tick starts. It did not move there: velocities alone say what sheets feel. rotation: a
   rotation matrix, columns as in the def. */
KIRI_API kiriResult kiriObstacle_SetPose(kiriWorld* world, kiriObstacle obstacle, const float position[3],
                                         const float rotation[9]);

/* With what it moves in the next tick and from then on. */
KIRI_API kiriResult kiriObstacle_SetVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3],
                                             const float angularVelocity[3]);
KIRI_API kiriResult kiriObstacle_SetSurfaceVelocity(kiriWorld* world, kiriObstacle obstacle, const float velocity[3]);

/* As in the def. */
KIRI_API kiriResult kiriObstacle_SetMass(kiriWorld* world, kiriObstacle obstacle, float mass, const float inertia[6],
                                         const float centerOfMass[3]);

/* Where it is now, with what it moves, and what it felt. */
typedef struct kiriObstacleState {
    float position[3], rotation[9], velocity[3], angularVelocity[3];
    double impulse[3], angularImpulse[3]; /* N s, N m s about its centre of mass: what sheets and pins gave it in the
                                             last tick */
    int32_t contacts;                     /* that pushed in the last tick */
} kiriObstacleState;

/* Pose and velocities as they are now. */
KIRI_API kiriResult kiriObstacle_GetState(const kiriWorld* world, kiriObstacle obstacle, kiriObstacleState* state);

/* The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no obstacles or contacts
   outside. It reaches as far around the sheet as its fastest point can go by its velocity and gravity, twice, and the
   contact thickness. Obstacles that move themselves come as much nearer. dt as in kiriWorld_Tick. */
KIRI_API kiriResult kiriSheet_GetReach(const kiriWorld* world, kiriSheet sheet, float dt, float lower[3],
                                       float upper[3]);

/* ---- Debug draw ------------------------------------------------------------------------------------------------- */

/* What is drawn. */
enum kiriDrawFlag {
    KIRI_DRAW_TRIANGLES = 1,   /* a triangle for each of the mesh, in a colour of its piece, pale where that sleeps */
    KIRI_DRAW_EDGES = 2,       /* a line for each edge between two triangles */
    KIRI_DRAW_BORDERS = 4,     /* a line for each edge of the outline and of lips */
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

/* A corner of what is drawn: as it is, it may go to a GPU. */
typedef struct kiriDrawVertex {
    float position[3]; /* m, world */
    uint32_t color;    /* red in its lowest byte, then green, blue, and opacity, which is 255 */
} kiriDrawVertex;

/* Gets the next vertices, up to 240 in a call: one for a point, two for a line, three for a triangle. They are the
   library's, and gone after the call. */
typedef void kiriDrawFn(void* user, const kiriDrawVertex* vertices, int32_t count);

/* What is drawn, and by whom. */
typedef struct kiriDebugDraw {
    uint32_t cookie;
    uint32_t flags;        /* KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES */
    kiriSheet sheet;       /* only this one is drawn, without obstacles and blades; 0 (default): all */
    float size;            /* m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05 */
    kiriDrawFn* points;    /* null: these are not drawn */
    kiriDrawFn* lines;     /* the same */
    kiriDrawFn* triangles; /* the same */
    void* user;            /* handed to these functions */
} kiriDebugDraw;

/* Fills it with its defaults, and stamps it. */
KIRI_API void kiriDefaultDebugDraw(kiriDebugDraw* draw);

/* Draws the world as after the last tick, by the host's functions. Only reads the world, and takes no memory. */
KIRI_API kiriResult kiriWorld_DebugDraw(const kiriWorld* world, const kiriDebugDraw* draw);

#ifdef __cplusplus
}
#endif

#endif
