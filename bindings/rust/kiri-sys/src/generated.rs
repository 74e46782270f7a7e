// Made from kiri.h by `make bindings`.

use core::ffi::{c_char, c_void};
use core::mem::{align_of, offset_of, size_of};

pub type kiriSheet = u32;
pub type kiriCut = u32;
pub type kiriFrame = u32;
pub type kiriPin = u32;
pub type kiriObstacle = u32;
pub type kiriBlade = u32;
pub type kiriResult = i32;

#[repr(C)]
pub struct kiriWorld {
    _private: [u8; 0],
}

/// Of the header.
pub const KIRI_VERSION: i32 = 1200;

pub const KIRI_OK: i32 = 0;
/// done, and work is left for later ticks
pub const KIRI_PENDING: i32 = 1;
/// null pointer, NaN, infinite, or outside the documented range; or a sheet or obstacle would be
/// where floats end, or move that fast: 4e37 m, m/s or 1/s
pub const KIRI_ERROR_ARGUMENT: i32 = -1;
/// the def was not filled by its kiriDefault function, all zeros say: call that first
pub const KIRI_ERROR_DEF: i32 = -2;
/// unknown or stale id, or the id of another kind
pub const KIRI_ERROR_ID: i32 = -3;
/// the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping
pub const KIRI_ERROR_MESH: i32 = -4;
/// the call comes in the wrong order, or from a callback that may not make it
pub const KIRI_ERROR_STATE: i32 = -5;
/// the allocator returned null
pub const KIRI_ERROR_MEMORY: i32 = -6;
/// the motion of a sheet could not be continued; it was put to rest where it was
pub const KIRI_DIVERGED: i32 = -7;
/// all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world
pub const KIRI_ERROR_LIMIT: i32 = -8;
/// floats are not computed as on other machines, see kiriCreateWorld
pub const KIRI_ERROR_BUILD: i32 = -9;
/// bytes that are damaged, cut short, of something else, or of a later version
pub const KIRI_ERROR_DATA: i32 = -10;
/// a call that was made again gave something else than its recording has
pub const KIRI_ERROR_REPLAY: i32 = -11;

pub const KIRI_LEAST_TRIANGLES: i32 = 16;

pub const KIRI_MOST_NOTE_BYTES: i32 = 1048576;

/// cut: all of it is in the mesh; the id is stale from now on
pub const KIRI_EVENT_CUT_FINISHED: i32 = 1;
/// frame (its first, which names it), crumb, area: a connected part came off
pub const KIRI_EVENT_PIECE_OFF: i32 = 2;
/// frame
pub const KIRI_EVENT_FRAME_ADDED: i32 = 3;
/// the sheet was put to rest
pub const KIRI_EVENT_DIVERGED: i32 = 4;
/// stage, waiting: the budget ended in this stage of the sheet's work
pub const KIRI_EVENT_DEFERRED: i32 = 5;
/// pin: its force passed breakForce; the id is stale from now on
pub const KIRI_EVENT_PIN_BROKE: i32 = 6;
/// sheet (the new one), frame, area: what kiriFrame_DetachPiece left waiting is done
pub const KIRI_EVENT_PIECE_DETACHED: i32 = 7;

/// split the mesh along the blade
pub const KIRI_STAGE_CUT: i32 = 0;
/// cells and what links them
pub const KIRI_STAGE_GRID: i32 = 1;
/// geodesic distances, regions, links; placing of frames
pub const KIRI_STAGE_REGIONS: i32 = 2;
/// shape functions
pub const KIRI_STAGE_SHAPE: i32 = 3;
/// weights of vertices and collision points
pub const KIRI_STAGE_SAMPLES: i32 = 4;
/// mass, the pattern of the solver's matrix, and when all is put in force
pub const KIRI_STAGE_CONSTANTS: i32 = 5;
/// what touches obstacles, other sheets and other pieces
pub const KIRI_STAGE_CONTACT: i32 = 6;
/// the motion of the frames
pub const KIRI_STAGE_SOLVE: i32 = 7;
/// positions and normals of the mesh
pub const KIRI_STAGE_SKIN: i32 = 8;
pub const KIRI_STAGE_COUNT: i32 = 9;

/// printing paper, 0.11 mm
pub const KIRI_MATERIAL_PAPER: i32 = 0;
/// cloth, 0.5 mm; the default of a sheet def
pub const KIRI_MATERIAL_COTTON: i32 = 1;
/// natural rubber, 1 mm
pub const KIRI_MATERIAL_RUBBER: i32 = 2;
/// aluminium, 16 um
pub const KIRI_MATERIAL_FOIL: i32 = 3;
pub const KIRI_MATERIAL_COUNT: i32 = 4;

pub const KIRI_QUALITY_FAST: i32 = 0;
pub const KIRI_QUALITY_BALANCED: i32 = 1;
pub const KIRI_QUALITY_ACCURATE: i32 = 2;
pub const KIRI_QUALITY_COUNT: i32 = 3;

/// Rigid frames joined by links: paper, foil, stiff cloth. 6 unknowns a frame, which its neighbours
/// couple.
pub const KIRI_MODEL_LINKS: i32 = 0;
/// Affine frames joined by links: cloth and rubber, whose stretch inside a region is seen. 12
/// unknowns a frame, which neighbours of neighbours couple: a tick takes five to seven times as
/// long as with KIRI_MODEL_LINKS. From 1e8 Pa or so on it needs more \`iterations\`, 8 say.
pub const KIRI_MODEL_AFFINE: i32 = 1;
/// Affine frames, strains at integration points: the scheme of the paper, to compare with. Weights
/// that vary across a strip cannot bend it as a cylinder, however many points there are: a clamped
/// strip on 9 frames goes 3, 20, 51 and 70 % too short a way down where it is a 10th, 20th, 50th
/// and 400th of its length thick. 12 unknowns a frame.
pub const KIRI_MODEL_POINTS: i32 = 2;

/// each frame carries a flat patch; the weights blend them (equation 1 of the paper)
pub const KIRI_SKINNING_LINEAR: i32 = 0;
/// each carries a patch that bends towards its neighbours: no bumps at the frames
pub const KIRI_SKINNING_SMOOTH: i32 = 1;

/// TR-BDF2: trapezoid and BDF2 by turns, of second order. Motion lasts: of the energy of a swinging
/// strip of 9 frames 96 to 98 % is left after 10 s with 2 substeps a 60th of a second and 1
/// iteration, 99.7 % with 4. Backward Euler takes its place in the steps in which a contact touches
/// a piece, a pin or hold is made, moved or removed, or a frame is new or turns by more than a
/// radian.
pub const KIRI_TIME_STEPPING_SECOND_ORDER: i32 = 0;
/// Backward Euler, of first order: takes energy out of all that swings, the more the longer the
/// step. Of that strip's 0.4 % is left.
pub const KIRI_TIME_STEPPING_EULER: i32 = 1;

pub const KIRI_PIN_POINT: i32 = 0;
pub const KIRI_PIN_HINGE: i32 = 1;
pub const KIRI_PIN_CLAMP: i32 = 2;

/// all below the plane through its position; the third column of its rotation points out
pub const KIRI_OBSTACLE_PLANE: i32 = 0;
/// radius
pub const KIRI_OBSTACLE_SPHERE: i32 = 1;
/// radius, height: of its axis, the third column, between the middles of its round ends
pub const KIRI_OBSTACLE_CAPSULE: i32 = 2;
/// size: lengths of its edges along the columns of its rotation
pub const KIRI_OBSTACLE_BOX: i32 = 3;
/// radius, height: along the third column
pub const KIRI_OBSTACLE_CYLINDER: i32 = 4;
/// outline: a convex polygon in the plane of the first two columns; height: along the third, 0:
/// without end
pub const KIRI_OBSTACLE_PRISM: i32 = 5;

/// a triangle for each of the mesh, in a colour of its piece, pale where that sleeps
pub const KIRI_DRAW_TRIANGLES: i32 = 1;
/// a line for each edge between two triangles
pub const KIRI_DRAW_EDGES: i32 = 2;
/// a line for each edge of the outline and of lips
pub const KIRI_DRAW_BORDERS: i32 = 4;
/// a point and three axes each: u red, v green, normal blue; held ones red
pub const KIRI_DRAW_FRAMES: i32 = 8;
/// two lines each: from frame to frame by the middle of their border
pub const KIRI_DRAW_LINKS: i32 = 16;
/// a point at the target; a line to the point of the material, or along the line
pub const KIRI_DRAW_PINS: i32 = 32;
/// a point and its normal for each that pushed as the last tick ended
pub const KIRI_DRAW_CONTACTS: i32 = 64;
/// a line along the edge, and a point in each layer that it is in
pub const KIRI_DRAW_BLADES: i32 = 128;
/// twelve lines around each piece
pub const KIRI_DRAW_BOXES: i32 = 256;
/// lines along edges and rims, without the rounding; a plane is a square
pub const KIRI_DRAW_OBSTACLES: i32 = 512;
/// a point for each collision point
pub const KIRI_DRAW_POINTS: i32 = 1024;
pub const KIRI_DRAW_ALL: i32 = 2047;

/// The host's functions. They may call other worlds, and functions that take no world. Calls of
/// their own world:
/// - While a function that takes a world without const runs, its callbacks may call
///   kiriWorld_GetLastError alone. All other functions give KIRI_ERROR_STATE and do nothing,
///   kiriDestroyWorld too.
/// - While a function that takes a const kiriWorld runs, its callbacks may call functions that take
///   a const kiriWorld. All others give KIRI_ERROR_STATE and do nothing. A refused call has a line
///   in the log, unless the log made the call. kiriWorld_GetLastError keeps the line of the
///   function that runs, and no recording has the refused call. The functions of kiriDebugDraw
///   follow these rules, too. A thread that reads may call \`log\`, and in kiriSheet_GetWeights and
///   kiriSheet_EstimateError \`alloc\` and \`free\`. All memory of a world comes from \`alloc\`,
///   but for what Eigen takes while it orders the unknowns, when a cut couples frames that were not
///   coupled before. at least 16-byte aligned, or null
pub type kiriAllocFn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: i64) -> *mut c_void>;

/// The host's functions. They may call other worlds, and functions that take no world. Calls of
/// their own world:
/// - While a function that takes a world without const runs, its callbacks may call
///   kiriWorld_GetLastError alone. All other functions give KIRI_ERROR_STATE and do nothing,
///   kiriDestroyWorld too.
/// - While a function that takes a const kiriWorld runs, its callbacks may call functions that take
///   a const kiriWorld. All others give KIRI_ERROR_STATE and do nothing. A refused call has a line
///   in the log, unless the log made the call. kiriWorld_GetLastError keeps the line of the
///   function that runs, and no recording has the refused call. The functions of kiriDebugDraw
///   follow these rules, too. A thread that reads may call \`log\`, and in kiriSheet_GetWeights and
///   kiriSheet_EstimateError \`alloc\` and \`free\`. All memory of a world comes from \`alloc\`,
///   but for what Eigen takes while it orders the unknowns, when a cut couples frames that were not
///   coupled before.
pub type kiriFreeFn = Option<unsafe extern "C" fn(user: *mut c_void, pointer: *mut c_void)>;

/// The host's functions. They may call other worlds, and functions that take no world. Calls of
/// their own world:
/// - While a function that takes a world without const runs, its callbacks may call
///   kiriWorld_GetLastError alone. All other functions give KIRI_ERROR_STATE and do nothing,
///   kiriDestroyWorld too.
/// - While a function that takes a const kiriWorld runs, its callbacks may call functions that take
///   a const kiriWorld. All others give KIRI_ERROR_STATE and do nothing. A refused call has a line
///   in the log, unless the log made the call. kiriWorld_GetLastError keeps the line of the
///   function that runs, and no recording has the refused call. The functions of kiriDebugDraw
///   follow these rules, too. A thread that reads may call \`log\`, and in kiriSheet_GetWeights and
///   kiriSheet_EstimateError \`alloc\` and \`free\`. All memory of a world comes from \`alloc\`,
///   but for what Eigen takes while it orders the unknowns, when a cut couples frames that were not
///   coupled before.
pub type kiriLogFn = Option<unsafe extern "C" fn(user: *mut c_void, line: *const c_char)>;

/// The host's functions. They may call other worlds, and functions that take no world. Calls of
/// their own world:
/// - While a function that takes a world without const runs, its callbacks may call
///   kiriWorld_GetLastError alone. All other functions give KIRI_ERROR_STATE and do nothing,
///   kiriDestroyWorld too.
/// - While a function that takes a const kiriWorld runs, its callbacks may call functions that take
///   a const kiriWorld. All others give KIRI_ERROR_STATE and do nothing. A refused call has a line
///   in the log, unless the log made the call. kiriWorld_GetLastError keeps the line of the
///   function that runs, and no recording has the refused call. The functions of kiriDebugDraw
///   follow these rules, too. A thread that reads may call \`log\`, and in kiriSheet_GetWeights and
///   kiriSheet_EstimateError \`alloc\` and \`free\`. All memory of a world comes from \`alloc\`,
///   but for what Eigen takes while it orders the unknowns, when a cut couples frames that were not
///   coupled before. seconds; read for the profile only, never by the simulation
pub type kiriClockFn = Option<unsafe extern "C" fn(user: *mut c_void) -> f64>;

/// The host's functions. They may call other worlds, and functions that take no world. Calls of
/// their own world:
/// - While a function that takes a world without const runs, its callbacks may call
///   kiriWorld_GetLastError alone. All other functions give KIRI_ERROR_STATE and do nothing,
///   kiriDestroyWorld too.
/// - While a function that takes a const kiriWorld runs, its callbacks may call functions that take
///   a const kiriWorld. All others give KIRI_ERROR_STATE and do nothing. A refused call has a line
///   in the log, unless the log made the call. kiriWorld_GetLastError keeps the line of the
///   function that runs, and no recording has the refused call. The functions of kiriDebugDraw
///   follow these rules, too. A thread that reads may call \`log\`, and in kiriSheet_GetWeights and
///   kiriSheet_EstimateError \`alloc\` and \`free\`. All memory of a world comes from \`alloc\`,
///   but for what Eigen takes while it orders the unknowns, when a cut couples frames that were not
///   coupled before. the next bytes of the recording
pub type kiriRecordFn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: *const c_void, count: i32)>;

/// For hosts that lend their threads to a tick. A task is work on the items 0 to itemCount:
/// \`start\` has the function called, from whatever threads, for ranges of at least minRange items
/// (the last one may be shorter) that together are all of them, each once, and returns something
/// that names the task; \`finish\` returns when all these calls have. \`start\` may also make all
/// calls itself, and return null: then there is no \`finish\`. What a thread wrote must be seen by
/// those that go on after \`finish\`, as with any lock. A tick has one task at a time. Within one
/// the library does not call the host, and how the items are shared out does not change one bit of
/// what comes of them. the items from start up to, without, end
pub type kiriTaskFn = Option<unsafe extern "C" fn(start: i32, end: i32, taskContext: *mut c_void)>;

/// For hosts that lend their threads to a tick. A task is work on the items 0 to itemCount:
/// \`start\` has the function called, from whatever threads, for ranges of at least minRange items
/// (the last one may be shorter) that together are all of them, each once, and returns something
/// that names the task; \`finish\` returns when all these calls have. \`start\` may also make all
/// calls itself, and return null: then there is no \`finish\`. What a thread wrote must be seen by
/// those that go on after \`finish\`, as with any lock. A tick has one task at a time. Within one
/// the library does not call the host, and how the items are shared out does not change one bit of
/// what comes of them.
pub type kiriStartTaskFn = Option<unsafe extern "C" fn(user: *mut c_void, task: kiriTaskFn, itemCount: i32, minRange: i32, taskContext: *mut c_void) -> *mut c_void>;

/// For hosts that lend their threads to a tick. A task is work on the items 0 to itemCount:
/// \`start\` has the function called, from whatever threads, for ranges of at least minRange items
/// (the last one may be shorter) that together are all of them, each once, and returns something
/// that names the task; \`finish\` returns when all these calls have. \`start\` may also make all
/// calls itself, and return null: then there is no \`finish\`. What a thread wrote must be seen by
/// those that go on after \`finish\`, as with any lock. A tick has one task at a time. Within one
/// the library does not call the host, and how the items are shared out does not change one bit of
/// what comes of them.
pub type kiriFinishTaskFn = Option<unsafe extern "C" fn(user: *mut c_void, handle: *mut c_void)>;

/// Gets the next vertices, up to 240 in a call: one for a point, two for a line, three for a
/// triangle. They are the library's, and gone after the call.
pub type kiriDrawFn = Option<unsafe extern "C" fn(user: *mut c_void, vertices: *const kiriDrawVertex, count: i32)>;

/// The most work that one tick may do, over all sheets. 0: no limit. Triangles, cells and samples
/// share one allowance: using 30 % of one leaves 70 % of the others. So the work on cuts takes no
/// longer than the costliest of the three limits alone. A single step that exceeds the whole limit
/// is not split. It runs alone in its tick. Work that does not fit goes on in the next tick. Until
/// a cut takes effect its lips move together. All points of a sheet that are pending when work on
/// them begins take effect together, whatever ticks they were given before. So the tick in which a
/// cut takes effect depends on the budget, too. Its result does not: when all work is done, mesh,
/// grid, regions, weights and sites of frames equal, bit for bit, a run of the same calls without a
/// budget. Motion differs. Sheets take turns. In every other tick the sheet whose points came first
/// is served first, in the ticks between the sheet whose work has used least. Pieces that wait to
/// be detached get half of every other tick. An example at 60 Hz, with 2 ms of work on cuts a tick
/// (about 32 000 cells and 4000 samples): a cut from side to side of 64 x 64 squares with 9 frames
/// parts 17 to 100 ms after the blade has left, one of 127 x 127 squares with 24 frames 67 to 200
/// ms. A slow blade parts sooner, for its work is done on the way. tests/bench_swipe.c prints the
/// table.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriBudget {
    /// split by blades; 0, or KIRI_LEAST_TRIANGLES and more
    pub triangles: i32,
    /// looked at, or given another distance: grid, regions, shape functions; a link counts as many
    pub cells: i32,
    /// vertices and collision points with new weights; and what it takes to put all that is new in
    /// force at once, which is paid before
    pub samples: i32,
    /// work on linear systems, of 30 to 60 us each. A system counts 1, and 1 more for each 16
    /// frames (5 of affine ones), for each 64 contacts, and for each 1280 products of blocks that
    /// its factorisation takes: in a square of 24, 289, 1000, 5000 frames it is 2, 36, 184, 2411. A
    /// sheet that gets fewer systems than its substeps takes longer ones. Where one system of all
    /// its pieces is more than what is left, they take turns: some are moved, the others stay where
    /// they are in this tick, with their velocity, and come first in the next; a sheet that gets
    /// none stands still, too. A piece whose system is more than the whole limit is moved alone
    pub iterations: i32,
}

/// Of a world: gravity, budget, and the host's functions.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriWorldDef {
    pub cookie: u32,
    /// m/s^2; default (0, 0, -9.81)
    pub gravity: [f32; 3],
    /// default: no limit
    pub budget: kiriBudget,
    /// null: malloc and free. Both or none.
    pub alloc: kiriAllocFn,
    pub free: kiriFreeFn,
    /// one line for each error; null: silent
    pub log: kiriLogFn,
    /// null: the profile counts, and shows no times
    pub clock: kiriClockFn,
    /// null: a tick runs in its caller alone. Both or none.
    pub startTask: kiriStartTaskFn,
    pub finishTask: kiriFinishTaskFn,
    /// threads that may work on a task, the caller of the tick with them, 0 to 1024: sizes ranges;
    /// up to 1: no task is started. Default 0
    pub workerCount: i32,
    /// handed to the functions above
    pub user: *mut c_void,
    /// gets the recording of the world, see kiriWorld_Replay; null: there is none
    pub record: kiriRecordFn,
    /// the recording has the state hash after so many ticks, and at the end; 0: never. Default 60
    pub recordHashTicks: i32,
}

/// How far a replay has come: all zero at its start.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriReplay {
    /// in the recording: where it goes on
    pub offset: i64,
    /// made so far
    pub calls: i64,
    /// that were not refused
    pub ticks: i64,
    /// where it stopped at a note: its bytes, in the recording; else null
    pub note: *const c_void,
    pub noteCount: i32,
}

/// Of the fields after \`sheet\` an event has those that its type names; the others are 0,
/// \`stage\` is -1.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriEvent {
    /// KIRI_EVENT_...
    pub type_: i32,
    pub sheet: kiriSheet,
    /// or 0
    pub cut: kiriCut,
    /// or 0
    pub frame: kiriFrame,
    /// or 0
    pub pin: kiriPin,
    /// 1: the piece is a crumb, see kiriSheetDef
    pub crumb: i32,
    /// m^2 of the piece, or 0
    pub area: f32,
    /// KIRI_STAGE_..., or -1
    pub stage: i32,
    /// blade points and ends of cuts that are pending or being worked on; or 0
    pub waiting: i32,
}

/// What the last tick did, and what it took.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriProfile {
    /// of the last tick; zero without a clock
    pub seconds: [f64; 9],
    /// blade segments that took effect
    pub cutSegments: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub trianglesSplit: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub cellsSettled: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub samplesRefreshed: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub solverIterations: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// kiriSheet_GetCounts.
    pub cellsChanged: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// kiriSheet_GetCounts.
    pub weightsChanged: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// kiriSheet_GetCounts.
    pub verticesChanged: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// kiriSheet_GetCounts.
    pub pointsChanged: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// kiriSheet_GetCounts.
    pub linksChanged: i32,
    /// sheets in which a cut took effect
    pub commits: i32,
    /// linear systems, large and small
    pub systemsSolved: i32,
    /// planes given to the solver: the host's, those of obstacles, and those between sheets
    pub contacts: i32,
    /// pairs of sheets or pieces, near each other and not both asleep
    pub sheetPairs: i32,
    /// The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime;
    /// and that one went by a fade.
    pub largestJump: f64,
    /// The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime;
    /// and that one went by a fade.
    pub largestFade: f64,
}

/// What a sheet is made of: homogeneous, isotropic.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriMaterial {
    /// Pa, above 0
    pub youngsModulus: f32,
    /// 0 to below 0.5
    pub poissonsRatio: f32,
    /// m, above 0
    pub thickness: f32,
    /// kg/m^3, above 0
    pub density: f32,
    /// 1/s, 0 or more: velocities fade as exp(-airDamping t)
    pub airDamping: f32,
    /// s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
    pub flexDamping: f32,
}

/// How much work for how much accuracy. The presets are measured (\`make accuracy\`; tests/sweep.h
/// has the scenes) on a strip of stiff paper, 0.2 m x 0.05 m, clamped at one end, with one row of
/// frames, and on a square of 0.2 m that bends five times as easily, hangs by two corners, and has
/// half as many rows and columns, rounded up. Let go, they swing for 0.4 s at 60 ticks a second.
/// Error: rms distance of the vertices from where a much finer run brings them, by the rms way that
/// they go; at most, over grids from 4/5 to 5/4 as fine and with frames in regular rows or moved a
/// little. FAST: 2 %. BALANCED: 0.8 %. ACCURATE: 0.4 %. What a cut leaves narrow wants more frames:
/// see \`accuracy\` in the sheet def.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriQuality {
    /// control frames in a row along a strip; a square does with half as many in either direction,
    /// rounded up: 3 x 3, 5 x 5, 9 x 9
    pub framesAlong: i32,
    /// for the sheet def
    pub gridResolution: i32,
    /// for the sheet def
    pub iterations: i32,
    /// for kiriWorld_Tick
    pub substeps: i32,
}

/// The paper's own ways, to compare with; part of the sheet def.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPaperOptions {
    /// 1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the
    /// same bit for bit. Default 0.
    pub fromScratch: i32,
    /// 1: when a cut takes effect, only new frames take their motion from the surface: what is seen
    /// jumps, and momentum is not kept. Default 0.
    pub popping: i32,
    /// 1: the weights of frames are linear on the way from frame to frame, so the surface that is
    /// seen has a kink at each frame. Always so with KIRI_MODEL_POINTS. Default 0: their slope is
    /// zero at the frames.
    pub linearWeights: i32,
    /// KIRI_MODEL_POINTS only. Work grows with the points: spread evenly over the sheet, at least
    /// one in every piece; default 0: four for each of frameCount. Order 1 (default) takes the
    /// strain at a point for all of the material around it, order 2 a strain linear in it, at four
    /// times the work a point. 0 to 1048576
    pub integrationPoints: i32,
    /// 1 or 2
    pub integrationOrder: i32,
}

/// Of a sheet: its rest shape, where it starts, its material, and how it is computed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriSheetDef {
    pub cookie: u32,
    /// The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge.
    /// Holes and several parts are fine. Copied by kiriCreateSheet; vertices of no triangle are
    /// left out. Edges whose ends lie at the same places, but are different vertices, are the lips
    /// of a cut that is there already; weldDistance closes them. 2 floats (u, v) a vertex
    pub restPositions: *const f32,
    pub vertexCount: i32,
    /// 3 a triangle
    pub indices: *const i32,
    pub triangleCount: i32,
    /// Where it starts: x = position + u axisU + v axisV. The axes are orthonormal.
    pub position: [f32; 3],
    pub axisU: [f32; 3],
    pub axisV: [f32; 3],
    /// m/s
    pub velocity: [f32; 3],
    pub material: kiriMaterial,
    /// grid squares along the longer side, 1 to 4096; default 32
    pub gridResolution: i32,
    /// m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a
    /// cut keeps within half of it of its line; 0: 1e-4 of the longer side
    pub snapDistance: f32,
    /// Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture
    /// coordinates, and triangles without shared vertices (STL). In the order of vertices, each
    /// becomes the nearest vertex that was kept before and is nearer than this; else it is kept. So
    /// none moves farther, and a chain of near vertices is not one point. A triangle with two
    /// corners at one vertex is left out. kiriSheet_CopySources leads to the vertices of the def.
    /// Default 0: vertices are as the indices say.
    pub weldDistance: f32,
    /// Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at
    /// least; null: frameCount frames are spread evenly, some of them in pairs at both sides of
    /// slit ends. The grid carries one frame for every two squares of material at most: more are
    /// refused (KIRI_ERROR_ARGUMENT), and re-sampling stops there. A new sheet has no more frames
    /// than frameCount, or than pieces where these are more. frameCount 0: as many as the sheet
    /// needs: a region is split while its size, 2.45 times its radius of gyration, exceeds 1.25
    /// frameLength, after cuts too: so arms that a cut leaves get frames along them. frameLength 0:
    /// it follows from \`accuracy\`, the relative error of the shape under the sheet's own weight
    /// that is good enough, but is three squares of the grid at least. kiriSheet_EstimateError says
    /// what came of it. 0, or 1 and more; default 5
    pub frameCount: i32,
    /// m; used where frameCount is 0; default 0
    pub frameLength: f32,
    /// 1e-4 to 1; used where frameCount and frameLength are 0; default 0.02
    pub accuracy: f32,
    pub framePoints: *const f32,
    /// re-sampling stops here; default 256
    pub maxFrames: i32,
    /// Re-sampling (section 5 of the paper): a frame whose weight exceeds rigidWeight over an area
    /// larger than rigidArea (m^2) gets others beside it. In a new sheet this is done only with
    /// frameCount 0. After cuts it is done where the area is also larger than in the new sheet:
    /// when a cut ends, or has met the border or another cut. A sheet that is to stay rigid sets
    /// frameCount and maxFrames to 1. rigidArea 0: a quarter of the area that a frame has at the
    /// start. default 0.95
    pub rigidWeight: f32,
    /// default 0
    pub rigidArea: f32,
    /// A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are
    /// added to it. Default 0.
    pub crumbArea: f32,
    /// Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet
    /// counts the geometric mean. Default 0.5
    pub friction: f32,
    /// m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the
    /// material's thickness, a 20th of a grid square at least. Default 0
    pub contactThickness: f32,
    /// obstacles and sheets touch where a bit is set in the groups of both. Default: all
    pub groups: u32,
    /// 1: its pieces touch each other, and other sheets that have it set; not where one of the two
    /// sheets is planar. Of two pieces that are near each other the one that lies above, against
    /// gravity, is kept on its side of the other by planes; side by side the one that nothing
    /// holds, or the lighter one. So piles keep their order. The lower one feels what presses on it
    /// within 0.3 s: weight acts in full, an impact does so only while the upper one stays, and
    /// momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels
    /// others by its vertices, about one a grid square and more along borders: two edges that cross
    /// are not seen. A piece that wraps around the border of another, so that it lies on both sides
    /// of it, has one side all the same. Folds of one piece do not touch each other. Pieces that
    /// touch wake and fall asleep together. Default 0.
    pub touchesSheets: i32,
    /// spread evenly over the sheet, at least one in every piece; default 0: none
    pub collisionPoints: i32,
    /// Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual
    pub iterations: i32,
    /// A piece all of whose frames move slower than this (m/s, rms over the material of each) for
    /// half a second falls asleep: it rests, and costs next to nothing. What is new to it wakes it:
    /// a cut that changes it, when that takes effect; a pin that holds it, or the pin's pose; a
    /// hold, a load, contacts other than those it fell asleep with; something that moves and comes
    /// near. Gravity, wind, settings and kiriSheet_Wake wake all pieces of the sheet. The ticks of
    /// a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.
    pub sleepSpeed: f32,
    /// KIRI_MODEL_..., default KIRI_MODEL_LINKS
    pub model: i32,
    /// KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR
    pub skinning: i32,
    /// 1: the sheet stays in the plane where it starts, without bending; what velocities, forces
    /// and held positions have across the plane is dropped. 3 unknowns a rigid frame, 6 an affine
    /// one: two thirds of the solver's work, or about a third. Default 0.
    pub planar: i32,
    /// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
    pub timeStepping: i32,
    /// When a cut takes effect, weights change, and what is seen between the frames would jump. The
    /// difference fades within this time (s). So does the difference of strain in links of
    /// KIRI_MODEL_LINKS whose borders have moved. Default 0.2; 0: at once.
    pub fadeTime: f32,
    /// 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and
    /// kiriSheet_CopyVertices copies none; this saves half of the time of linear skinning. The
    /// sheet moves the same, bit for bit: where edges of obstacles or other sheets touch it, the
    /// tick makes normals for itself. So does kiriSheet_GetSolid; and what kiriSheet_GetPoint says
    /// is the same to rounding. Default 1.
    pub normals: i32,
    /// default: none of the paper's own ways
    pub paper: kiriPaperOptions,
}

/// What of the def may be changed while the sheet lives, as there. kiriSheet_GetSettings stamps it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriSheetSettings {
    pub cookie: u32,
    pub material: kiriMaterial,
    /// re-sampling stops here; default 256
    pub maxFrames: i32,
    /// A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are
    /// added to it. Default 0.
    pub crumbArea: f32,
    /// Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet
    /// counts the geometric mean. Default 0.5
    pub friction: f32,
    /// m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the
    /// material's thickness, a 20th of a grid square at least. Default 0
    pub contactThickness: f32,
    /// obstacles and sheets touch where a bit is set in the groups of both. Default: all
    pub groups: u32,
    /// 1: its pieces touch each other, and other sheets that have it set; not where one of the two
    /// sheets is planar. Of two pieces that are near each other the one that lies above, against
    /// gravity, is kept on its side of the other by planes; side by side the one that nothing
    /// holds, or the lighter one. So piles keep their order. The lower one feels what presses on it
    /// within 0.3 s: weight acts in full, an impact does so only while the upper one stays, and
    /// momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels
    /// others by its vertices, about one a grid square and more along borders: two edges that cross
    /// are not seen. A piece that wraps around the border of another, so that it lies on both sides
    /// of it, has one side all the same. Folds of one piece do not touch each other. Pieces that
    /// touch wake and fall asleep together. Default 0.
    pub touchesSheets: i32,
    /// Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual
    pub iterations: i32,
    /// A piece all of whose frames move slower than this (m/s, rms over the material of each) for
    /// half a second falls asleep: it rests, and costs next to nothing. What is new to it wakes it:
    /// a cut that changes it, when that takes effect; a pin that holds it, or the pin's pose; a
    /// hold, a load, contacts other than those it fell asleep with; something that moves and comes
    /// near. Gravity, wind, settings and kiriSheet_Wake wake all pieces of the sheet. The ticks of
    /// a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.
    pub sleepSpeed: f32,
    /// KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR
    pub skinning: i32,
    /// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
    pub timeStepping: i32,
    /// stays 0 with paper.popping
    pub fadeTime: f32,
    /// 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and
    /// kiriSheet_CopyVertices copies none; this saves half of the time of linear skinning. The
    /// sheet moves the same, bit for bit: where edges of obstacles or other sheets touch it, the
    /// tick makes normals for itself. So does kiriSheet_GetSolid; and what kiriSheet_GetPoint says
    /// is the same to rounding. Default 1.
    pub normals: i32,
}

/// The triangles that are seen, as after the last tick. revision grows whenever indices or vertices
/// are added or changed. Rest positions are floats, 6e-8 of the distance from the origin of the
/// rest plane apart: where triangles are not much larger than that, they look flat or inverted. The
/// library computes with the positions of the def to 2^-29 of the sheet; sourceTriangles and
/// sourceWeights are as exact as the sheet is large.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriMesh {
    /// 3 a vertex, m, world
    pub positions: *const f32,
    /// 3 a vertex, unit; null where the sheet makes none
    pub normals: *const f32,
    /// 2 a vertex, m
    pub restPositions: *const f32,
    /// 3 a triangle
    pub indices: *const i32,
    /// 1 a vertex: the triangle of the def that it lies in,
    pub sourceTriangles: *const i32,
    /// 3 a vertex: and its barycentric coordinates there
    pub sourceWeights: *const f32,
    pub vertexCount: i32,
    pub triangleCount: i32,
    pub revision: u32,
}

/// So many items from the first on.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriRange {
    pub first: i32,
    pub count: i32,
}

/// What has changed in the mesh, for hosts that keep a copy of it, on a GPU say. Positions and
/// normals change with every tick; all else of a vertex, and the corners of a triangle, only in
/// these ranges.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriDirty {
    /// up to the last one of the mesh
    pub newVertices: kiriRange,
    /// up to the last one of the mesh
    pub newTriangles: kiriRange,
    /// the least ranges that hold all older ones with other data
    pub oldVertices: kiriRange,
    /// the least ranges that hold all older ones with other data
    pub oldTriangles: kiriRange,
    /// for the next call
    pub revision: u32,
}

/// The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the
/// lips of cuts. First come the vertices of kiriMesh on the side that the normal leaves, then the
/// same on the other side, then four for each edge of the border, so that rims are flat and their
/// edges sharp.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriSolid {
    /// 3 a vertex, m, world
    pub positions: *const f32,
    /// 3 a vertex, unit, outwards
    pub normals: *const f32,
    /// 2 a vertex, m
    pub restPositions: *const f32,
    /// 3 a triangle, counter-clockwise from outside
    pub indices: *const i32,
    /// 1 a vertex: that of kiriMesh which it stands on
    pub sources: *const i32,
    pub vertexCount: i32,
    pub triangleCount: i32,
    /// from this one on triangles are rims
    pub rimTriangle: i32,
}

/// How many there are of each.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriCounts {
    pub vertices: i32,
    pub triangles: i32,
    pub cells: i32,
    pub frames: i32,
    pub links: i32,
    pub pieces: i32,
    pub collisionPoints: i32,
}

/// Area (m^2), mass (kg), kinetic energy and elastic energy (J), linear and angular momentum about
/// the world's origin (kg m/s, kg m^2/s), centre of mass (m).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriTotals {
    pub area: f64,
    pub mass: f64,
    pub kineticEnergy: f64,
    pub elasticEnergy: f64,
    pub center: [f64; 3],
    pub momentum: [f64; 3],
    pub angularMomentum: [f64; 3],
}

/// What a ray meets.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriHit {
    /// where to cut
    pub restPoint: [f32; 2],
    pub position: [f32; 3],
    pub normal: [f32; 3],
    /// m along the direction, which need not be a unit vector
    pub distance: f32,
    pub triangle: i32,
}

/// A point of the material, as it is seen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPointState {
    /// m, world; unit
    pub position: [f32; 3],
    /// m, world; unit
    pub normal: [f32; 3],
    /// m/s, by the weights of the point
    pub velocity: [f32; 3],
    /// in whose region it is; it names the piece, too
    pub frame: kiriFrame,
}

/// The connected parts of a sheet. A piece is named by any of its frames. To go through all of them
/// there are indices too, from 0 on to kiriCounts.pieces, in the order of first frames: they change
/// when a piece comes off or is taken away; kiriFrame_GetPiece has that of now. A cut whose work
/// waits for its budget has not parted anything yet. Momentum is about the world's origin.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPieceState {
    /// m^2, kg
    pub area: f64,
    /// m^2, kg
    pub mass: f64,
    /// of mass, m; kg m/s; kg m^2/s
    pub center: [f64; 3],
    /// of mass, m; kg m/s; kg m^2/s
    pub momentum: [f64; 3],
    /// of mass, m; kg m/s; kg m^2/s
    pub angularMomentum: [f64; 3],
    /// m, world: the least box around its vertices
    pub lower: [f32; 3],
    /// m, world: the least box around its vertices
    pub upper: [f32; 3],
    /// how many
    pub frames: i32,
    /// how many
    pub vertices: i32,
    /// how many
    pub triangles: i32,
    /// how many
    pub collisionPoints: i32,
    /// 1: see kiriSheetDef
    pub crumb: i32,
    /// 1: see sleepSpeed
    pub asleep: i32,
}

/// What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece
/// after piece.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPieceMesh {
    /// of kiriMesh
    pub vertices: *const i32,
    /// of kiriMesh
    pub triangles: *const i32,
    /// 3 a triangle, as in kiriMesh: draw them
    pub indices: *const i32,
    /// see kiriSheet_GetCollisionPoints
    pub collisionPoints: *const i32,
    pub vertexCount: i32,
    pub triangleCount: i32,
    pub collisionPointCount: i32,
}

/// Pose, motion and region of a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriFrameState {
    pub restPoint: [f32; 2],
    /// of the rest point
    pub position: [f32; 3],
    /// columns: direction of u, direction of v, normal; of an affine frame the columns of A, which
    /// stretch with the sheet
    pub rotation: [f32; 9],
    /// m/s
    pub velocity: [f32; 3],
    /// rad/s
    pub angularVelocity: [f32; 3],
    /// m^2 of its region
    pub area: f32,
    /// kg
    pub mass: f32,
    /// 1: moved by the host, see kiriFrame_Hold
    pub held: i32,
}

/// Air that moves past the sheet, in every tick until the next call. On each square metre act, with
/// v the velocity of the air less that of the material, and n the normal: density / 2 times |v|
/// (drag (v.n) n + lift (v - (v.n) n)). Zero velocity with drag and lift above zero: still air,
/// which resists. All zero: none. It acts at four points of the region of each frame, and follows
/// its motion within the tick: sheets flutter, and no wind is too strong. Gusts are a call a tick.
/// Wind that stays as it is lets a sheet sleep.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriWind {
    /// m/s
    pub velocity: [f32; 3],
    /// kg/m^3, 0 or more; 1.2 of air
    pub density: f32,
    /// 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force
    /// along the sheet, 0.01 or so of a smooth one
    pub drag: f32,
    /// 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force
    /// along the sheet, 0.01 or so of a smooth one
    pub lift: f32,
}

/// A pin holds a point of the material at its target, by a spring.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPinDef {
    pub cookie: u32,
    /// in the material
    pub restPoint: [f32; 2],
    /// m, world: where it is held
    pub target: [f32; 3],
    /// N/m; 0: ten times Young's modulus times thickness
    pub stiffness: f32,
    /// N: it breaks (KIRI_EVENT_PIN_BROKE) in a tick in which it held with more; 0: never
    pub breakForce: f32,
    /// or 0. The target goes with this obstacle from where it is when the pin is made, or
    /// kiriPin_SetTarget puts it, and the obstacle feels the pin (kiriObstacle_GetState); one with
    /// mass yields to it within the tick. When it is destroyed the target stays where it was
    pub obstacle: kiriObstacle,
}

/// What a pin is, and where it holds.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPinState {
    /// KIRI_PIN_...
    pub type_: i32,
    pub sheet: kiriSheet,
    /// rest position: of a point, twice, or of the ends of the line
    pub from: [f32; 2],
    /// rest position: of a point, twice, or of the ends of the line
    pub to: [f32; 2],
    pub target: [f32; 3],
    /// of a line; of a point the identity
    pub rotation: [f32; 9],
    /// N, or 0
    pub breakForce: f32,
    /// that it goes with, or 0
    pub obstacle: kiriObstacle,
}

/// A point of the material that touches something: the plane dot(normal, x) = offset keeps it on
/// its upper side, with as much force as that takes, and Coulomb friction acts along the plane. The
/// plane is that of an obstacle of the host, who finds it anew for each tick from where the sheet
/// is seen. A contact may lie in the path of the point, above or below it: one that does not reach
/// its plane in the tick costs little and does nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriContact {
    /// index of the collision point; -1: restPoint says which point of the material
    pub point: i32,
    /// in the material; only read where point is -1
    pub restPoint: [f32; 2],
    /// unit, out of the obstacle
    pub normal: [f32; 3],
    /// m: of the obstacle's surface at the start of the tick
    pub offset: f32,
    /// m/s: of the obstacle there. The plane moves with it within the tick, and friction acts
    /// against the sliding that is left
    pub velocity: [f32; 3],
    /// 0 or more: of both sides together
    pub friction: f32,
    /// 1/kg, 0 or more: of the obstacle as felt along the normal there, 1/m + (r x n) . I^-1 (r x
    /// n); 0: it does not yield
    pub inverseMass: f32,
    /// m/s, 0 or more: a point that starts below the plane is pushed out no faster. 0: 1 m/s
    pub pushSpeed: f32,
    /// the host's number. Contacts of one number press on one obstacle, and share its mass
    pub obstacle: i32,
}

/// What a contact did in the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriContactForce {
    /// N s, on the sheet: the sum over the tick. The obstacle gets the opposite
    pub impulse: [f64; 3],
    /// m, world: where it acted, the point of the sheet at the end of the tick
    pub position: [f64; 3],
    /// m: how deep the point is below the plane at the end of the tick; below 0: above it
    pub depth: f64,
    /// as in the contact
    pub point: i32,
    /// as in the contact
    pub obstacle: i32,
}

/// Of an obstacle: its shape, where it is, its motion, and its mass.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriObstacleDef {
    pub cookie: u32,
    /// KIRI_OBSTACLE_...
    pub type_: i32,
    /// m
    pub size: [f32; 3],
    /// m
    pub radius: f32,
    /// m
    pub height: f32,
    /// 2 floats a corner, m, counter-clockwise; copied
    pub outline: *const f32,
    /// 3 to 64
    pub outlineCount: i32,
    /// m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0
    pub rounding: f32,
    /// m, world
    pub position: [f32; 3],
    /// columns; default: the axes of the world
    pub rotation: [f32; 9],
    /// m/s, of its position
    pub velocity: [f32; 3],
    /// rad/s
    pub angularVelocity: [f32; 3],
    /// m/s, world: of its surface beside that, as of a conveyor
    pub surfaceVelocity: [f32; 3],
    /// 0 or more; default 0.5
    pub friction: f32,
    /// kg; 0 (default): nothing moves it
    pub mass: f32,
    /// kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz.
    /// Positive definite, but for axes whose numbers are all 0: it does not turn about these
    pub inertia: [f32; 6],
    /// m, from its position in its own axes
    pub centerOfMass: [f32; 3],
    /// obstacles of the same number, but 0, are parts of one body, whose mass each of them has
    pub body: u32,
    /// m/s, above 0: what is inside is pushed out no faster. Default 1
    pub pushSpeed: f32,
    /// see the sheet def. Default: all
    pub groups: u32,
}

/// Where it is now, with what it moves, and what it felt.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriObstacleState {
    pub position: [f32; 3],
    pub rotation: [f32; 9],
    pub velocity: [f32; 3],
    pub angularVelocity: [f32; 3],
    /// N s, N m s about its centre of mass: what sheets and pins gave it in the last tick
    pub impulse: [f64; 3],
    /// N s, N m s about its centre of mass: what sheets and pins gave it in the last tick
    pub angularImpulse: [f64; 3],
    /// that pushed in the last tick
    pub contacts: i32,
}

/// A corner of what is drawn: as it is, it may go to a GPU.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriDrawVertex {
    /// m, world
    pub position: [f32; 3],
    /// red in its lowest byte, then green, blue, and opacity, which is 255
    pub color: u32,
}

/// What is drawn, and by whom.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriDebugDraw {
    pub cookie: u32,
    /// KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES
    pub flags: u32,
    /// only this one is drawn, without obstacles and blades; 0 (default): all
    pub sheet: kiriSheet,
    /// m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05
    pub size: f32,
    /// null: these are not drawn
    pub points: kiriDrawFn,
    /// the same
    pub lines: kiriDrawFn,
    /// the same
    pub triangles: kiriDrawFn,
    /// handed to these functions
    pub user: *mut c_void,
}

unsafe extern "C" {
    /// The library's version, as KIRI_VERSION.
    pub fn kiriGetVersion() -> i32;
    /// The name of a result, "KIRI_OK" and so on; "unknown" for another number.
    pub fn kiriGetResultName(result: kiriResult) -> *const c_char;
    /// One line: the meaning of a result, and its cure. For calls without a world that keeps a
    /// line, such as kiriCreateWorld with a def of zeros (KIRI_ERROR_DEF).
    pub fn kiriGetResultText(result: kiriResult) -> *const c_char;
    /// Fills the def with its defaults, and stamps it.
    pub fn kiriDefaultWorldDef(def: *mut kiriWorldDef);
    /// Makes an empty world. On failure \*world is null, and the log of the def has the line; a def
    /// that was not filled has no log, see kiriGetResultText. KIRI_ERROR_BUILD: the compiler has
    /// contracted products and sums to fused multiply-adds (-ffp-contract=fast of clang), or has
    /// reordered them; or this thread flushes small floats to zero (FTZ, DAZ) or does not round to
    /// nearest. The threads of later calls, and those that the host runs tasks on, are not checked:
    /// in such a mode their bits are others.
    pub fn kiriCreateWorld(def: *const kiriWorldDef, world: *mut *mut kiriWorld) -> kiriResult;
    /// Frees the world and all that is in it. Null is allowed.
    pub fn kiriDestroyWorld(world: *mut kiriWorld);
    /// One fixed step of dt seconds (1e-6 to 10), solved in \`substeps\` equal parts (1 to 64).
    /// Takes the waiting cut points, then moves every sheet. KIRI_PENDING: the budget is spent and
    /// more work waits: the events say which cuts; a sheet, or some of its pieces, may also have
    /// stood still for want of iterations. KIRI_ERROR_MEMORY: nothing moved; cuts and pieces still
    /// wait, call again. Refused work is prepared again: until then kiriSheet_GetWeights gives
    /// KIRI_ERROR_STATE, and with a budget a cut may take effect some ticks later than it would
    /// have. KIRI_ERROR_LIMIT: the same, and it stays so until frames are destroyed. KIRI_DIVERGED:
    /// the sheets named by the events were put to rest, the others moved. Work may wait then, too,
    /// as KIRI_EVENT_DEFERRED says.
    pub fn kiriWorld_Tick(world: *mut kiriWorld, dt: f32, substeps: i32) -> kiriResult;
    /// What went wrong in the last function that changes the world, in one line; "" when nothing
    /// did. A function that only reads leaves it as it is, and gives its line to the log. Valid
    /// until the next function that changes the world.
    pub fn kiriWorld_GetLastError(world: *const kiriWorld) -> *const c_char;
    /// m/s^2. All pieces wake.
    pub fn kiriWorld_SetGravity(world: *mut kiriWorld, gravity: *const f32) -> kiriResult;
    /// Moves the origin of the world to a point (m): subtracts it from the positions of sheets,
    /// targets of pins and holds, obstacles, blades, and contacts that wait. The motion goes on as
    /// before, to rounding. Nothing wakes; (0, 0, 0) changes nothing. Use it in large worlds: far
    /// from the origin floats lose places. The host shifts its own data itself. Arrays that the
    /// library handed out keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a
    /// position would not fit a float. KIRI_ERROR_MEMORY: nothing has changed.
    pub fn kiriWorld_ShiftOrigin(world: *mut kiriWorld, origin: *const f32) -> kiriResult;
    /// Takes effect with the next tick.
    pub fn kiriWorld_SetBudget(world: *mut kiriWorld, budget: *const kiriBudget) -> kiriResult;
    /// A hash of everything that the coming ticks depend on, work that waits for its budget
    /// included: two worlds that got the same calls have the same hash, and two with the same hash
    /// go on alike. After a refused allocation some items are made again: the hash tells that while
    /// work waits, or while the budget limits cells or samples.
    pub fn kiriWorld_GetStateHash(world: *const kiriWorld, hash: *mut u64) -> kiriResult;
    /// Writes up to \`capacity\` ids of the world's sheets, in the order of their making; \*count
    /// is how many there are.
    pub fn kiriWorld_GetSheets(world: *const kiriWorld, sheets: *mut kiriSheet, capacity: i32, count: *mut i32) -> kiriResult;
    /// Puts some bytes of the host's own (1 to KIRI_MOST_NOTE_BYTES) in the recording, where a
    /// replay finds them: what its camera saw, what a player pressed. The world does not change;
    /// without a recording nothing happens.
    pub fn kiriWorld_Note(world: *mut kiriWorld, bytes: *const c_void, count: i32) -> kiriResult;
    /// Makes the calls of a recording up to the next tick or note, and that one. The world is to be
    /// new, as kiriCreateWorld makes it; gravity and budget become those of the recording. What the
    /// host has of its own, such as memory, log and tasks, stays the host's. Ids are those of the
    /// recording: kiriWorld_GetSheets has those of sheets. KIRI_PENDING: more follows, call it
    /// again. KIRI_OK: that was the end. KIRI_ERROR_REPLAY: a call gave another result, other ids
    /// or another state than recorded; the line says which. The next call goes on behind it.
    /// KIRI_ERROR_DATA: the bytes are no recording, damaged, cut short, or of a later version; the
    /// line says where. Calls before that place have been made. So has the last one of a recording
    /// that ends within a call, as that of a run which crashed. KIRI_ERROR_STATE: the world is not
    /// new. KIRI_ERROR_MEMORY: the next call was refused memory, and may be tried again. Calls that
    /// were refused memory when they were recorded are left out: they changed nothing. Where that
    /// was a tick and a budget limits cells or samples, the next hashes may differ.
    pub fn kiriWorld_Replay(world: *mut kiriWorld, recording: *const c_void, size: i64, replay: *mut kiriReplay) -> kiriResult;
    /// Writes the world, which only is read. \*size: bytes of the save. \`bytes\` null: they are
    /// counted only, and capacity is not read; else it has room for \`capacity\`.
    /// KIRI_ERROR_ARGUMENT: that is less than \*size; nothing is written. KIRI_PENDING: a cut is
    /// being worked on; \*size is 0, and nothing is written. Save after a later tick, or after
    /// kiriWorld_FinishCuts.
    pub fn kiriWorld_Save(world: *const kiriWorld, bytes: *mut c_void, capacity: i64, size: *mut i64) -> kiriResult;
    /// Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts
    /// that wait for a budget take effect. The next tick reports the events. KIRI_ERROR_MEMORY,
    /// KIRI_ERROR_LIMIT: as in kiriWorld_Tick. Arrays that the world handed out end as with a tick.
    pub fn kiriWorld_FinishCuts(world: *mut kiriWorld) -> kiriResult;
    /// Replaces the world by a saved one. It may have any hooks; its own allocation, log, clock and
    /// tasks stay. The bytes may come from anybody: a malicious save may give a strange world but
    /// cannot crash the program, and takes memory in proportion to its size. Takes about as long as
    /// to create the sheets. The profile has no times until the next tick. Arrays that the old
    /// world handed out live until then. KIRI_ERROR_DATA: the bytes are not a save, damaged, or of
    /// another version. KIRI_ERROR_MEMORY. Then nothing has changed. A recording has the bytes, up
    /// to 2^31 of them.
    pub fn kiriWorld_Load(world: *mut kiriWorld, bytes: *const c_void, size: i64) -> kiriResult;
    /// For rollback: copies all of the world, also work on cuts and pieces that wait, into memory
    /// of the host. Much faster than a save, and exact to the bit. The bytes are good for this
    /// process only: never store or send them. Arguments as of kiriWorld_Save.
    pub fn kiriWorld_Snapshot(world: *const kiriWorld, bytes: *mut c_void, capacity: i64, size: *mut i64) -> kiriResult;
    /// Replaces the world by the world of the snapshot; ids name the same things. The bytes are
    /// trusted: hand over only the output of kiriWorld_Snapshot. KIRI_ERROR_DATA: not a snapshot of
    /// this build of the library. KIRI_ERROR_MEMORY. KIRI_ERROR_STATE: the world is recorded. Then
    /// nothing has changed. Hooks and arrays as with kiriWorld_Load.
    pub fn kiriWorld_Restore(world: *mut kiriWorld, bytes: *const c_void, size: i64) -> kiriResult;
    /// \*events points to \*count events.
    pub fn kiriWorld_GetEvents(world: *const kiriWorld, events: *mut *const kiriEvent, count: *mut i32) -> kiriResult;
    /// Of the last tick that was not refused.
    pub fn kiriWorld_GetProfile(world: *const kiriWorld, profile: *mut kiriProfile) -> kiriResult;
    /// For hosts that would rather think in time than in items: the budget whose work would have
    /// taken so many microseconds a tick at the pace of the profile, which may be the sum of
    /// several. Work on cuts and linear systems share the time as they did in the profile, and each
    /// of triangles, cells and samples gets what the three took together, see kiriBudget. Each item
    /// that the profile has some of is set; others stay. The simulation never reads a clock: the
    /// choice is the host's, and a replay must hand in the same budgets.
    pub fn kiriFitBudget(profile: *const kiriProfile, microseconds: f32, budget: *mut kiriBudget) -> kiriResult;
    /// The name of a stage, for tables; "" for a number that is none.
    pub fn kiriGetStageName(stage: i32) -> *const c_char;
    /// The numbers of a preset, KIRI_MATERIAL_...
    pub fn kiriGetMaterial(preset: i32, material: *mut kiriMaterial) -> kiriResult;
    /// The numbers of a preset, KIRI_QUALITY_...
    pub fn kiriGetQuality(preset: i32, quality: *mut kiriQuality) -> kiriResult;
    /// Fills the def with its defaults, and stamps it. It has no mesh yet.
    pub fn kiriDefaultSheetDef(def: *mut kiriSheetDef);
    /// Adds a sheet. On failure \*sheet is 0. KIRI_ERROR_MESH: the triangles do not form a sheet.
    /// The line names a triangle, or the two triangles at an edge, by their numbers in the def, and
    /// says why.
    pub fn kiriCreateSheet(world: *mut kiriWorld, def: *const kiriSheetDef, sheet: *mut kiriSheet) -> kiriResult;
    /// The sheet is gone, with its cuts, frames and pins; their ids are stale.
    pub fn kiriDestroySheet(world: *mut kiriWorld, sheet: kiriSheet) -> kiriResult;
    /// A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 \*
    /// columns \* rows triangles; columns and rows are 1 to 4096. def: all but the mesh, which is
    /// not read; null: the defaults. A recording has it as kiriCreateSheet.
    pub fn kiriCreateRectangle(world: *mut kiriWorld, width: f32, height: f32, columns: i32, rows: i32, def: *const kiriSheetDef, sheet: *mut kiriSheet) -> kiriResult;
    /// What they are now, stamped for kiriSheet_SetSettings.
    pub fn kiriSheet_GetSettings(world: *const kiriWorld, sheet: kiriSheet, settings: *mut kiriSheetSettings) -> kiriResult;
    /// Checked as the def is: all or nothing. KIRI_ERROR_DEF: they did not come from GetSettings.
    /// The sheet wakes where one is other than before. Places and velocities stay: with another
    /// mass so momentum changes. Stiffnesses that pins have, and the lengths that frames were
    /// spread by, stay as they are.
    pub fn kiriSheet_SetSettings(world: *mut kiriWorld, sheet: kiriSheet, settings: *const kiriSheetSettings) -> kiriResult;
    /// A rectangle from (0, 0) to (width, height) for a sheet def: writes 2 \* (columns + 1) \*
    /// (rows + 1) floats and 6 \* columns \* rows indices. columns and rows are 1 to 4096.
    pub fn kiriFillRectangle(width: f32, height: f32, columns: i32, rows: i32, restPositions: *mut f32, indices: *mut i32) -> kiriResult;
    /// The arrays, without a copy.
    pub fn kiriSheet_GetMesh(world: *const kiriWorld, sheet: kiriSheet, mesh: *mut kiriMesh) -> kiriResult;
    /// What changed since the host saw that revision; all of the mesh where that is too long ago,
    /// or 0.
    pub fn kiriSheet_GetDirty(world: *const kiriWorld, sheet: kiriSheet, sinceRevision: u32, dirty: *mut kiriDirty) -> kiriResult;
    /// Copies positions and normals of some vertices, 3 floats each, to where the host wants them;
    /// strides in bytes, 12 or more. Null: without these. KIRI_ERROR_STATE: normals of a sheet that
    /// makes none.
    pub fn kiriSheet_CopyVertices(world: *const kiriWorld, sheet: kiriSheet, first: i32, count: i32, positions: *mut c_void, positionStride: i32, normals: *mut c_void, normalStride: i32) -> kiriResult;
    /// Copies the index that some vertices had when the last call of kiriWorld_Tick began, for
    /// hosts that draw between two ticks. \*from: the sheet that had them then, which is another
    /// one if this sheet was a piece of it. A vertex that a cut tore off another one gets the index
    /// of the other. -1: the vertex did not exist; so all vertices of a sheet that was created or
    /// loaded since. The manual has the code (drawing).
    pub fn kiriSheet_CopyPrevious(world: *const kiriWorld, sheet: kiriSheet, first: i32, count: i32, vertices: *mut i32, from: *mut kiriSheet) -> kiriResult;
    /// Copies the indices of some triangles, 3 each, as 16-bit numbers. KIRI_ERROR_STATE: there are
    /// more than 65535 vertices.
    pub fn kiriSheet_CopyIndices16(world: *const kiriWorld, sheet: kiriSheet, firstTriangle: i32, count: i32, indices: *mut u16) -> kiriResult;
    /// Map triangles to the def, to draw with data that the host keeps by its own vertices.
    /// Sources: the triangle of the def that contains each; -1 for one that has left (its corners
    /// are equal). Weights: 9 floats each, the barycentric coordinates of its three corners in that
    /// triangle. They are right on both sides of a seam that weldDistance has closed;
    /// sourceTriangles name a triangle on one side. The manual has the code (meshes).
    pub fn kiriSheet_CopySources(world: *const kiriWorld, sheet: kiriSheet, firstTriangle: i32, count: i32, sources: *mut i32) -> kiriResult;
    /// Map triangles to the def, to draw with data that the host keeps by its own vertices.
    /// Sources: the triangle of the def that contains each; -1 for one that has left (its corners
    /// are equal). Weights: 9 floats each, the barycentric coordinates of its three corners in that
    /// triangle. They are right on both sides of a seam that weldDistance has closed;
    /// sourceTriangles name a triangle on one side. The manual has the code (meshes).
    pub fn kiriSheet_CopySourceWeights(world: *const kiriWorld, sheet: kiriSheet, firstTriangle: i32, count: i32, weights: *mut f32) -> kiriResult;
    /// thickness: m, 0: that of the material. Made when it is asked for.
    pub fn kiriSheet_GetSolid(world: *mut kiriWorld, sheet: kiriSheet, thickness: f32, solid: *mut kiriSolid) -> kiriResult;
    /// Collision points: 3 floats of position (m, world) a point.
    pub fn kiriSheet_GetCollisionPoints(world: *const kiriWorld, sheet: kiriSheet, positions: *mut *const f32, count: *mut i32) -> kiriResult;
    /// Costs nothing.
    pub fn kiriSheet_GetCounts(world: *const kiriWorld, sheet: kiriSheet, counts: *mut kiriCounts) -> kiriResult;
    /// Sums over the frames, made when they are asked for.
    pub fn kiriSheet_GetTotals(world: *const kiriWorld, sheet: kiriSheet, totals: *mut kiriTotals) -> kiriResult;
    /// An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly:
    /// rms distance from where a sheet of very many frames would be under the same loads, over the
    /// rms way that it has gone from its flat shape; 0 to 1, and 1 where there are too few frames
    /// to tell. It compares the strains of neighbouring links (KIRI_MODEL_LINKS only; else
    /// KIRI_ERROR_STATE). Measured on cantilevers and on a sheet with a slit, of 3 to 140 frames,
    /// it is not below a third of the error, and not above four times the error or, where that is
    /// below 0.5 %, 1.5 %. Where a sheet also turned as a whole, as by hanging from two corners, it
    /// says up to ten times too much. It knows nothing of errors of the grid, of time stepping, and
    /// of loads that are finer than frames. It takes memory and time for one pass over the links,
    /// when it is called.
    pub fn kiriSheet_EstimateError(world: *const kiriWorld, sheet: kiriSheet, relative: *mut f64) -> kiriResult;
    /// \*awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which
    /// do. kiriSheet_Wake wakes all of them.
    pub fn kiriSheet_IsAwake(world: *const kiriWorld, sheet: kiriSheet, awake: *mut i32) -> kiriResult;
    /// \*awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which
    /// do. kiriSheet_Wake wakes all of them.
    pub fn kiriSheet_Wake(world: *mut kiriWorld, sheet: kiriSheet) -> kiriResult;
    /// Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities
    /// turn. The columns of \`rotation\` are where R takes the axes of the world; a planar sheet
    /// turns about its normal only. It wakes. Targets of its pins, hinges, clamps and holds go
    /// along, so nothing draws it back. To set a target to its current value changes nothing. A
    /// target that the host has set nearer to the new place of the pin than to the old one stays:
    /// so the host may set targets before or after. Pins on an obstacle stay on it: put the
    /// obstacle elsewhere by the same motion (kiriObstacle_SetPose), before or after. Loads and
    /// contacts that wait for the next tick stay.
    pub fn kiriSheet_Transform(world: *mut kiriWorld, sheet: kiriSheet, rotation: *const f32, translation: *const f32) -> kiriResult;
    /// From now on it moves as a rigid body, until forces change that: \`velocity\` (m/s) of its
    /// centre of mass, and \`angularVelocity\` (rad/s) about it. What a planar sheet has across its
    /// plane is dropped; held frames follow their hold. kiriFrame_SetPieceVelocity: of the piece
    /// with that frame alone.
    pub fn kiriSheet_SetVelocity(world: *mut kiriWorld, sheet: kiriSheet, velocity: *const f32, angularVelocity: *const f32) -> kiriResult;
    /// From now on it moves as a rigid body, until forces change that: \`velocity\` (m/s) of its
    /// centre of mass, and \`angularVelocity\` (rad/s) about it. What a planar sheet has across its
    /// plane is dropped; held frames follow their hold. kiriFrame_SetPieceVelocity: of the piece
    /// with that frame alone.
    pub fn kiriFrame_SetPieceVelocity(world: *mut kiriWorld, frame: kiriFrame, velocity: *const f32, angularVelocity: *const f32) -> kiriResult;
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one,
    /// named by any of its frames: the parts of a piece that is cut have that of the piece, as does
    /// a sheet that is made of it.
    pub fn kiriSheet_SetUserData(world: *mut kiriWorld, sheet: kiriSheet, data: u64) -> kiriResult;
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one,
    /// named by any of its frames: the parts of a piece that is cut have that of the piece, as does
    /// a sheet that is made of it.
    pub fn kiriSheet_GetUserData(world: *const kiriWorld, sheet: kiriSheet, data: *mut u64) -> kiriResult;
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one,
    /// named by any of its frames: the parts of a piece that is cut have that of the piece, as does
    /// a sheet that is made of it.
    pub fn kiriPin_SetUserData(world: *mut kiriWorld, pin: kiriPin, data: u64) -> kiriResult;
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one,
    /// named by any of its frames: the parts of a piece that is cut have that of the piece, as does
    /// a sheet that is made of it.
    pub fn kiriPin_GetUserData(world: *const kiriWorld, pin: kiriPin, data: *mut u64) -> kiriResult;
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one,
    /// named by any of its frames: the parts of a piece that is cut have that of the piece, as does
    /// a sheet that is made of it.
    pub fn kiriFrame_SetPieceUserData(world: *mut kiriWorld, frame: kiriFrame, data: u64) -> kiriResult;
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one,
    /// named by any of its frames: the parts of a piece that is cut have that of the piece, as does
    /// a sheet that is made of it.
    pub fn kiriFrame_GetPieceUserData(world: *const kiriWorld, frame: kiriFrame, data: *mut u64) -> kiriResult;
    /// Where a ray first meets the sheet, up to maxDistance. KIRI_OK with hit-\>triangle = -1:
    /// nowhere. The first ray looks at every triangle; the next tick makes boxes over them, and as
    /// long as somebody asks every now and then (in 120 ticks) they follow the sheet: a ray takes
    /// some microseconds, and a tick of a large sheet a quarter more.
    pub fn kiriSheet_Raycast(world: *const kiriWorld, sheet: kiriSheet, origin: *const f32, direction: *const f32, maxDistance: f32, hit: *mut kiriHit) -> kiriResult;
    /// The first sheet that a ray meets; \*sheet is 0 where there is none.
    pub fn kiriWorld_Raycast(world: *const kiriWorld, origin: *const f32, direction: *const f32, maxDistance: f32, sheet: *mut kiriSheet, hit: *mut kiriHit) -> kiriResult;
    /// Outside the sheet: KIRI_ERROR_ARGUMENT. On a cut, the lip that holds the point; either where
    /// both do.
    pub fn kiriSheet_GetPoint(world: *const kiriWorld, sheet: kiriSheet, restPoint: *const f32, state: *mut kiriPointState) -> kiriResult;
    /// The shape functions at a rest point: up to \`capacity\` frames with their weights (sum 1)
    /// and, unless null, gradients (2 floats a frame, 1/m). \*count is how many there are, however
    /// many fit. Outside the sheet: KIRI_ERROR_ARGUMENT; while work on a cut waits for its budget:
    /// KIRI_ERROR_STATE.
    pub fn kiriSheet_GetWeights(world: *const kiriWorld, sheet: kiriSheet, restPoint: *const f32, frames: *mut kiriFrame, weights: *mut f32, gradients: *mut f32, capacity: i32, count: *mut i32) -> kiriResult;
    /// The first of these calls after a cut sorts the sheet by pieces, which may fail with
    /// KIRI_ERROR_MEMORY. An index that is no piece's: KIRI_ERROR_ARGUMENT.
    pub fn kiriSheet_GetPiece(world: *mut kiriWorld, sheet: kiriSheet, piece: i32, state: *mut kiriPieceState) -> kiriResult;
    /// The first of these calls after a cut sorts the sheet by pieces, which may fail with
    /// KIRI_ERROR_MEMORY. An index that is no piece's: KIRI_ERROR_ARGUMENT.
    pub fn kiriSheet_GetPieceMesh(world: *mut kiriWorld, sheet: kiriSheet, piece: i32, mesh: *mut kiriPieceMesh) -> kiriResult;
    /// \*frames points to \*count ids.
    pub fn kiriSheet_GetPieceFrames(world: *mut kiriWorld, sheet: kiriSheet, piece: i32, frames: *mut *const kiriFrame, count: *mut i32) -> kiriResult;
    /// The index that the piece with this frame has now.
    pub fn kiriFrame_GetPiece(world: *const kiriWorld, frame: kiriFrame, piece: *mut i32) -> kiriResult;
    /// Makes a sheet of the piece with this frame. Its frames, pins and collision points move
    /// along, in their order; they keep their ids and states, and what waits for the next tick: the
    /// motion goes on as if nothing had happened, but for the solver's guard over energy and step
    /// length, which is one for each sheet. A clamp or hinge that holds both becomes two: the rest
    /// keeps the id, the new sheet's has one of its own (kiriSheet_GetPins). Both sheets have all
    /// settings (of collisionPoints and integrationPoints the share that falls to their area),
    /// maxFrames each for itself; a piece that sleeps goes on sleeping. Cuts stay with the rest: a
    /// blade in the piece cuts nothing until it is back. Indices of collision points of the rest
    /// change. Its triangles and vertices keep their indices where it has more than 4096 vertices,
    /// and while no more than half of them are of pieces that went: these triangles have three
    /// equal corners, these vertices are of no triangle. Else all move together, and their indices
    /// change. In either case its revision grows, and kiriSheet_GetDirty says what changed. The new
    /// sheet has the squares of the grid around it, at about 40 bytes a square: crumbs are better
    /// dropped. Costs what the piece takes to make, and a look at the weights of what is left;
    /// where indices change more. KIRI_PENDING: work on a cut is at hand in the sheet, or it takes
    /// more samples than the budget leaves calls before the next tick; \*detached is 0. When the
    /// work is done, what is the piece of this frame then becomes a sheet, and
    /// KIRI_EVENT_PIECE_DETACHED names it. Samples pay for it before, over several ticks if need
    /// be, of many pieces one after the other: of the first that waits 3 for each vertex, 2.5 to 9
    /// for each cell (the more frames, the more) and 100 for each frame, of others 3 for each
    /// vertex and 1.4 for each cell; and one for 80 vertices of the rest. Until then further cuts
    /// of the sheet wait. The first piece is made as it is paid, and leaves at the start of the
    /// tick after the last sample is paid. That tick does an eighth of the work; the first tick
    /// after a load makes the parts again that saves leave out. The coming ticks have fewer samples
    /// for the work of calls. KIRI_ERROR_STATE: nothing would be left of the sheet.
    pub fn kiriFrame_DetachPiece(world: *mut kiriWorld, frame: kiriFrame, detached: *mut kiriSheet) -> kiriResult;
    /// The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but
    /// for making a sheet: that is done at once, and the coming ticks have less. Where
    /// kiriSheet_GetMesh has been called since the last tick, all indices are copied. KIRI_PENDING:
    /// work on a cut is at hand. The piece is gone all the same: its triangles are in kiriMesh,
    /// with three equal corners; it touches nothing; no point of it is found. When the work is done
    /// its vertices go, too; until then kiriCounts still counts it, and its kiriPieceState is all
    /// zeros.
    pub fn kiriFrame_DestroyPiece(world: *mut kiriWorld, frame: kiriFrame) -> kiriResult;
    /// The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames
    /// of one piece count once. Where one is refused, none goes. KIRI_PENDING: some wait, those of
    /// one sheet together. detached\[i\] is the sheet that the piece of frames\[i\] has become, 0
    /// where it waits.
    pub fn kiriWorld_DetachPieces(world: *mut kiriWorld, frames: *const kiriFrame, count: i32, detached: *mut kiriSheet) -> kiriResult;
    /// The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames
    /// of one piece count once. Where one is refused, none goes. KIRI_PENDING: some wait, those of
    /// one sheet together. detached\[i\] is the sheet that the piece of frames\[i\] has become, 0
    /// where it waits.
    pub fn kiriWorld_DestroyPieces(world: *mut kiriWorld, frames: *const kiriFrame, count: i32) -> kiriResult;
    /// Destroys all pieces below an area (m^2) except the largest piece, at the cost of one.
    /// \*count is how many. Where that one waits to become a sheet, the largest of the others
    /// stays, too.
    pub fn kiriSheet_DropCrumbs(world: *mut kiriWorld, sheet: kiriSheet, area: f32, count: *mut i32) -> kiriResult;
    /// A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet
    /// cuts nothing. Points wait until the next tick. The end of a cut that lies inside the sheet
    /// stays closed until the blade moves on.
    pub fn kiriBeginCut(world: *mut kiriWorld, sheet: kiriSheet, restPoint: *const f32, cut: *mut kiriCut) -> kiriResult;
    /// restPoints: 2 floats a point; count is 1 to 2^24.
    pub fn kiriCut_Extend(world: *mut kiriWorld, cut: kiriCut, restPoints: *const f32, count: i32) -> kiriResult;
    /// No more points come. After the tick in which the last of them takes effect the id is stale,
    /// and KIRI_EVENT_CUT_FINISHED tells. Frames that the sheet needs after the cut are added then.
    pub fn kiriCut_End(world: *mut kiriWorld, cut: kiriCut) -> kiriResult;
    /// A blade (a straight edge) that moves in world space from blade\[0\]-blade\[1\] to
    /// blade\[3\]-blade\[2\] cuts where the swept quadrilateral meets the sheet as it is now, past
    /// borders, so that it parts what it crosses. The cut is ended already. Slices of a sheet that
    /// moves do not join from tick to tick: for that take a blade.
    pub fn kiriSheet_Slice(world: *mut kiriWorld, sheet: kiriSheet, blade: *const f32, cut: *mut kiriCut) -> kiriResult;
    /// sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of
    /// their own. A blade for one sheet whose sheet is gone cuts nothing.
    pub fn kiriBeginBlade(world: *mut kiriWorld, sheet: kiriSheet, blade: *mut kiriBlade) -> kiriResult;
    /// The blade is now the straight edge between two points (m, world). From where it was it got
    /// there straight, each end along a line. The first call only says where it begins. Where an
    /// end of the edge lies inside of what it sweeps of the sheet, it cuts only what it sweeps. An
    /// edge without length cuts nothing.
    pub fn kiriBlade_MoveEdge(world: *mut kiriWorld, blade: kiriBlade, from: *const f32, to: *const f32) -> kiriResult;
    /// The same for a ray that a camera casts: an edge \`length\` m long.
    pub fn kiriBlade_MoveRay(world: *mut kiriWorld, blade: kiriBlade, origin: *const f32, direction: *const f32, length: f32) -> kiriResult;
    /// It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends.
    pub fn kiriBlade_End(world: *mut kiriWorld, blade: kiriBlade) -> kiriResult;
    /// Writes up to \`capacity\` ids of the sheet's frames; \*count is how many there are.
    pub fn kiriSheet_GetFrames(world: *const kiriWorld, sheet: kiriSheet, frames: *mut kiriFrame, capacity: i32, count: *mut i32) -> kiriResult;
    /// Pose, motion and region as they are now.
    pub fn kiriFrame_GetState(world: *const kiriWorld, frame: kiriFrame, state: *mut kiriFrameState) -> kiriResult;
    /// The host moves the frame: its rest point, as it is seen, goes to \`position\` with
    /// \`rotation\` (a rotation matrix, columns as above) in the next tick, evenly, and stays there
    /// until the next call. An affine frame is not stretched then. On a planar sheet the rotation
    /// is about its normal. Null, null: it is free again. Contacts do not push material that held
    /// frames carry for more than half: it goes where the host has it, through obstacles too.
    pub fn kiriFrame_Hold(world: *mut kiriWorld, frame: kiriFrame, position: *const f32, rotation: *const f32) -> kiriResult;
    /// With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the
    /// frame's rest point; means over the last tick, impulses divided by its dt. They carry the
    /// frame's own weight and change its momentum, too. Zero for a frame that was free. A piece
    /// that sleeps keeps those that it fell asleep with.
    pub fn kiriFrame_GetReaction(world: *const kiriWorld, frame: kiriFrame, force: *mut f64, torque: *mut f64) -> kiriResult;
    /// A force (N, world) on the frame's centre of mass and a torque (N m).
    pub fn kiriFrame_ApplyForce(world: *mut kiriWorld, frame: kiriFrame, force: *const f32, torque: *const f32) -> kiriResult;
    /// A force (N, world) on a point of the material and a torque (N m).
    pub fn kiriSheet_ApplyForce(world: *mut kiriWorld, sheet: kiriSheet, restPoint: *const f32, force: *const f32, torque: *const f32) -> kiriResult;
    /// A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in
    /// the material, edges included. Where it runs along a cut, each lip gets half. The ends
    /// differ; a line that meets no material: KIRI_ERROR_ARGUMENT.
    pub fn kiriSheet_ApplyLineLoad(world: *mut kiriWorld, sheet: kiriSheet, from: *const f32, to: *const f32, forcePerLength: *const f32) -> kiriResult;
    /// A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0.
    pub fn kiriSheet_ApplyPressure(world: *mut kiriWorld, sheet: kiriSheet, pressure: f32) -> kiriResult;
    /// An impulse (N s, world) on a point of the material, where it is seen now. Velocities change
    /// at once, by as much as the frames that carry the point resist; a held frame's part is lost.
    /// Outside the sheet: KIRI_ERROR_ARGUMENT.
    pub fn kiriSheet_ApplyImpulse(world: *mut kiriWorld, sheet: kiriSheet, restPoint: *const f32, impulse: *const f32) -> kiriResult;
    /// Copied; it blows until the next call.
    pub fn kiriSheet_SetWind(world: *mut kiriWorld, sheet: kiriSheet, wind: *const kiriWind) -> kiriResult;
    /// Fills the def with its defaults, and stamps it.
    pub fn kiriDefaultPinDef(def: *mut kiriPinDef);
    /// Pins a point of the sheet. On failure \*pin is 0. A point outside the sheet:
    /// KIRI_ERROR_ARGUMENT.
    pub fn kiriCreatePin(world: *mut kiriWorld, sheet: kiriSheet, def: *const kiriPinDef, pin: *mut kiriPin) -> kiriResult;
    /// Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp
    /// holds place and direction of the material there, as a vice does; a hinge its place only, so
    /// that the sheet may turn about the line. Both begin where the material is now; the line stays
    /// straight, and as long as it is at rest: so material that is bent there is pulled straight,
    /// and pieces that have come apart are pulled together, however fast that makes them.
    ///
    /// They hold what the line meets, edges included, with the stiffness that the material has
    /// between the line and the frames that it meets. So a clamp along an edge is where the drawing
    /// has it, whatever the number of frames, where kiriFrame_Hold clamps at a frame's site. A
    /// clamp through the sheet parts what is on its two sides, so that neither bends the other. A
    /// line that runs along a cut holds both lips; one beside it, by a 512th of a square of the
    /// grid or more, holds one. The ends differ; a line that meets no material:
    /// KIRI_ERROR_ARGUMENT.
    pub fn kiriSheet_ClampLine(world: *mut kiriWorld, sheet: kiriSheet, from: *const f32, to: *const f32, clamp: *mut kiriPin) -> kiriResult;
    /// Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp
    /// holds place and direction of the material there, as a vice does; a hinge its place only, so
    /// that the sheet may turn about the line. Both begin where the material is now; the line stays
    /// straight, and as long as it is at rest: so material that is bent there is pulled straight,
    /// and pieces that have come apart are pulled together, however fast that makes them.
    ///
    /// They hold what the line meets, edges included, with the stiffness that the material has
    /// between the line and the frames that it meets. So a clamp along an edge is where the drawing
    /// has it, whatever the number of frames, where kiriFrame_Hold clamps at a frame's site. A
    /// clamp through the sheet parts what is on its two sides, so that neither bends the other. A
    /// line that runs along a cut holds both lips; one beside it, by a 512th of a square of the
    /// grid or more, holds one. The ends differ; a line that meets no material:
    /// KIRI_ERROR_ARGUMENT.
    pub fn kiriSheet_HingeLine(world: *mut kiriWorld, sheet: kiriSheet, from: *const f32, to: *const f32, hinge: *mut kiriPin) -> kiriResult;
    /// Where the pin holds its point, or the middle of its line (m, world): at the end of the next
    /// tick, and until the next call. Within the tick it goes there evenly. The current target of
    /// kiriPin_GetState changes nothing. With KIRI_SKINNING_SMOOTH what pins and clamps hold is
    /// what is seen there; of a clamp the mean along its line, for each piece: single points of the
    /// line are seen a little off it.
    pub fn kiriPin_SetTarget(world: *mut kiriWorld, pin: kiriPin, target: *const f32) -> kiriResult;
    /// The same with the rotation of the line's material: columns are the directions of u and v and
    /// the normal. On a planar sheet it is about the sheet's normal. KIRI_ERROR_ARGUMENT for a pin
    /// that holds a point.
    pub fn kiriPin_SetPose(world: *mut kiriWorld, pin: kiriPin, target: *const f32, rotation: *const f32) -> kiriResult;
    /// As in the def, for pins of all types; N, 0: it never breaks.
    pub fn kiriPin_SetBreakForce(world: *mut kiriWorld, pin: kiriPin, breakForce: f32) -> kiriResult;
    /// What it is, and where it holds now.
    pub fn kiriPin_GetState(world: *const kiriWorld, pin: kiriPin, state: *mut kiriPinState) -> kiriResult;
    /// With what the pin acted on the sheet: force (N, world) and torque (N m) about its target;
    /// means over the last tick, impulses divided by its dt. So the reactions of all pins and held
    /// frames are the weight of a sheet at rest, and in motion what changes its momentum (as far as
    /// \`iterations\` have the tick solved). Zero before the first tick. A piece that sleeps keeps
    /// those that it fell asleep with.
    pub fn kiriPin_GetReaction(world: *const kiriWorld, pin: kiriPin, force: *mut f64, torque: *mut f64) -> kiriResult;
    /// Writes up to \`capacity\` ids of the sheet's pins, of all types; \*count is how many there
    /// are.
    pub fn kiriSheet_GetPins(world: *const kiriWorld, sheet: kiriSheet, pins: *mut kiriPin, capacity: i32, count: *mut i32) -> kiriResult;
    /// It lets go; its id is stale.
    pub fn kiriDestroyPin(world: *mut kiriWorld, pin: kiriPin) -> kiriResult;
    /// The contacts of the next tick; they replace those of an earlier call, and are gone after the
    /// tick. A contact is known again by its point, or its rest point, and its obstacle: what it
    /// pushed with is where the next tick starts.
    pub fn kiriSheet_SetContacts(world: *mut kiriWorld, sheet: kiriSheet, contacts: *const kiriContact, count: i32) -> kiriResult;
    /// One for each contact that was set before the last tick, in the order given. The sum of the
    /// impulses, with those of gravity, loads and obstacles, is the change of momentum of a piece
    /// that nothing holds. A piece that sleeps goes on to press with what it fell asleep with.
    pub fn kiriSheet_GetContactForces(world: *const kiriWorld, sheet: kiriSheet, forces: *mut *const kiriContactForce, count: *mut i32) -> kiriResult;
    /// Fills the def with its defaults, and stamps it.
    pub fn kiriDefaultObstacleDef(def: *mut kiriObstacleDef);
    /// Adds an obstacle. On failure \*obstacle is 0.
    pub fn kiriCreateObstacle(world: *mut kiriWorld, def: *const kiriObstacleDef, obstacle: *mut kiriObstacle) -> kiriResult;
    /// It is gone, its id stale. What rested on it wakes.
    pub fn kiriDestroyObstacle(world: *mut kiriWorld, obstacle: kiriObstacle) -> kiriResult;
    /// Where it is when the next tick starts. It did not move there: velocities alone say what
    /// sheets feel. rotation: a rotation matrix, columns as in the def.
    pub fn kiriObstacle_SetPose(world: *mut kiriWorld, obstacle: kiriObstacle, position: *const f32, rotation: *const f32) -> kiriResult;
    /// With what it moves in the next tick and from then on.
    pub fn kiriObstacle_SetVelocity(world: *mut kiriWorld, obstacle: kiriObstacle, velocity: *const f32, angularVelocity: *const f32) -> kiriResult;
    /// With what it moves in the next tick and from then on.
    pub fn kiriObstacle_SetSurfaceVelocity(world: *mut kiriWorld, obstacle: kiriObstacle, velocity: *const f32) -> kiriResult;
    /// As in the def.
    pub fn kiriObstacle_SetMass(world: *mut kiriWorld, obstacle: kiriObstacle, mass: f32, inertia: *const f32, centerOfMass: *const f32) -> kiriResult;
    /// Pose and velocities as they are now.
    pub fn kiriObstacle_GetState(world: *const kiriWorld, obstacle: kiriObstacle, state: *mut kiriObstacleState) -> kiriResult;
    /// The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no
    /// obstacles or contacts outside. It reaches as far around the sheet as its fastest point can
    /// go by its velocity and gravity, twice, and the contact thickness. Obstacles that move
    /// themselves come as much nearer. dt as in kiriWorld_Tick.
    pub fn kiriSheet_GetReach(world: *const kiriWorld, sheet: kiriSheet, dt: f32, lower: *mut f32, upper: *mut f32) -> kiriResult;
    /// Fills it with its defaults, and stamps it.
    pub fn kiriDefaultDebugDraw(draw: *mut kiriDebugDraw);
    /// Draws the world as after the last tick, by the host's functions. Only reads the world, and
    /// takes no memory.
    pub fn kiriWorld_DebugDraw(world: *const kiriWorld, draw: *const kiriDebugDraw) -> kiriResult;
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<kiriBudget>() == 16);
    assert!(align_of::<kiriBudget>() == 4);
    assert!(offset_of!(kiriBudget, triangles) == 0);
    assert!(offset_of!(kiriBudget, cells) == 4);
    assert!(offset_of!(kiriBudget, samples) == 8);
    assert!(offset_of!(kiriBudget, iterations) == 12);
    assert!(size_of::<kiriWorldDef>() == 112);
    assert!(align_of::<kiriWorldDef>() == 8);
    assert!(offset_of!(kiriWorldDef, cookie) == 0);
    assert!(offset_of!(kiriWorldDef, gravity) == 4);
    assert!(offset_of!(kiriWorldDef, budget) == 16);
    assert!(offset_of!(kiriWorldDef, alloc) == 32);
    assert!(offset_of!(kiriWorldDef, free) == 40);
    assert!(offset_of!(kiriWorldDef, log) == 48);
    assert!(offset_of!(kiriWorldDef, clock) == 56);
    assert!(offset_of!(kiriWorldDef, startTask) == 64);
    assert!(offset_of!(kiriWorldDef, finishTask) == 72);
    assert!(offset_of!(kiriWorldDef, workerCount) == 80);
    assert!(offset_of!(kiriWorldDef, user) == 88);
    assert!(offset_of!(kiriWorldDef, record) == 96);
    assert!(offset_of!(kiriWorldDef, recordHashTicks) == 104);
    assert!(size_of::<kiriReplay>() == 40);
    assert!(align_of::<kiriReplay>() == 8);
    assert!(offset_of!(kiriReplay, offset) == 0);
    assert!(offset_of!(kiriReplay, calls) == 8);
    assert!(offset_of!(kiriReplay, ticks) == 16);
    assert!(offset_of!(kiriReplay, note) == 24);
    assert!(offset_of!(kiriReplay, noteCount) == 32);
    assert!(size_of::<kiriEvent>() == 36);
    assert!(align_of::<kiriEvent>() == 4);
    assert!(offset_of!(kiriEvent, type_) == 0);
    assert!(offset_of!(kiriEvent, sheet) == 4);
    assert!(offset_of!(kiriEvent, cut) == 8);
    assert!(offset_of!(kiriEvent, frame) == 12);
    assert!(offset_of!(kiriEvent, pin) == 16);
    assert!(offset_of!(kiriEvent, crumb) == 20);
    assert!(offset_of!(kiriEvent, area) == 24);
    assert!(offset_of!(kiriEvent, stage) == 28);
    assert!(offset_of!(kiriEvent, waiting) == 32);
    assert!(size_of::<kiriProfile>() == 144);
    assert!(align_of::<kiriProfile>() == 8);
    assert!(offset_of!(kiriProfile, seconds) == 0);
    assert!(offset_of!(kiriProfile, cutSegments) == 72);
    assert!(offset_of!(kiriProfile, trianglesSplit) == 76);
    assert!(offset_of!(kiriProfile, cellsSettled) == 80);
    assert!(offset_of!(kiriProfile, samplesRefreshed) == 84);
    assert!(offset_of!(kiriProfile, solverIterations) == 88);
    assert!(offset_of!(kiriProfile, cellsChanged) == 92);
    assert!(offset_of!(kiriProfile, weightsChanged) == 96);
    assert!(offset_of!(kiriProfile, verticesChanged) == 100);
    assert!(offset_of!(kiriProfile, pointsChanged) == 104);
    assert!(offset_of!(kiriProfile, linksChanged) == 108);
    assert!(offset_of!(kiriProfile, commits) == 112);
    assert!(offset_of!(kiriProfile, systemsSolved) == 116);
    assert!(offset_of!(kiriProfile, contacts) == 120);
    assert!(offset_of!(kiriProfile, sheetPairs) == 124);
    assert!(offset_of!(kiriProfile, largestJump) == 128);
    assert!(offset_of!(kiriProfile, largestFade) == 136);
    assert!(size_of::<kiriMaterial>() == 24);
    assert!(align_of::<kiriMaterial>() == 4);
    assert!(offset_of!(kiriMaterial, youngsModulus) == 0);
    assert!(offset_of!(kiriMaterial, poissonsRatio) == 4);
    assert!(offset_of!(kiriMaterial, thickness) == 8);
    assert!(offset_of!(kiriMaterial, density) == 12);
    assert!(offset_of!(kiriMaterial, airDamping) == 16);
    assert!(offset_of!(kiriMaterial, flexDamping) == 20);
    assert!(size_of::<kiriQuality>() == 16);
    assert!(align_of::<kiriQuality>() == 4);
    assert!(offset_of!(kiriQuality, framesAlong) == 0);
    assert!(offset_of!(kiriQuality, gridResolution) == 4);
    assert!(offset_of!(kiriQuality, iterations) == 8);
    assert!(offset_of!(kiriQuality, substeps) == 12);
    assert!(size_of::<kiriPaperOptions>() == 20);
    assert!(align_of::<kiriPaperOptions>() == 4);
    assert!(offset_of!(kiriPaperOptions, fromScratch) == 0);
    assert!(offset_of!(kiriPaperOptions, popping) == 4);
    assert!(offset_of!(kiriPaperOptions, linearWeights) == 8);
    assert!(offset_of!(kiriPaperOptions, integrationPoints) == 12);
    assert!(offset_of!(kiriPaperOptions, integrationOrder) == 16);
    assert!(size_of::<kiriSheetDef>() == 232);
    assert!(align_of::<kiriSheetDef>() == 8);
    assert!(offset_of!(kiriSheetDef, cookie) == 0);
    assert!(offset_of!(kiriSheetDef, restPositions) == 8);
    assert!(offset_of!(kiriSheetDef, vertexCount) == 16);
    assert!(offset_of!(kiriSheetDef, indices) == 24);
    assert!(offset_of!(kiriSheetDef, triangleCount) == 32);
    assert!(offset_of!(kiriSheetDef, position) == 36);
    assert!(offset_of!(kiriSheetDef, axisU) == 48);
    assert!(offset_of!(kiriSheetDef, axisV) == 60);
    assert!(offset_of!(kiriSheetDef, velocity) == 72);
    assert!(offset_of!(kiriSheetDef, material) == 84);
    assert!(offset_of!(kiriSheetDef, gridResolution) == 108);
    assert!(offset_of!(kiriSheetDef, snapDistance) == 112);
    assert!(offset_of!(kiriSheetDef, weldDistance) == 116);
    assert!(offset_of!(kiriSheetDef, frameCount) == 120);
    assert!(offset_of!(kiriSheetDef, frameLength) == 124);
    assert!(offset_of!(kiriSheetDef, accuracy) == 128);
    assert!(offset_of!(kiriSheetDef, framePoints) == 136);
    assert!(offset_of!(kiriSheetDef, maxFrames) == 144);
    assert!(offset_of!(kiriSheetDef, rigidWeight) == 148);
    assert!(offset_of!(kiriSheetDef, rigidArea) == 152);
    assert!(offset_of!(kiriSheetDef, crumbArea) == 156);
    assert!(offset_of!(kiriSheetDef, friction) == 160);
    assert!(offset_of!(kiriSheetDef, contactThickness) == 164);
    assert!(offset_of!(kiriSheetDef, groups) == 168);
    assert!(offset_of!(kiriSheetDef, touchesSheets) == 172);
    assert!(offset_of!(kiriSheetDef, collisionPoints) == 176);
    assert!(offset_of!(kiriSheetDef, iterations) == 180);
    assert!(offset_of!(kiriSheetDef, sleepSpeed) == 184);
    assert!(offset_of!(kiriSheetDef, model) == 188);
    assert!(offset_of!(kiriSheetDef, skinning) == 192);
    assert!(offset_of!(kiriSheetDef, planar) == 196);
    assert!(offset_of!(kiriSheetDef, timeStepping) == 200);
    assert!(offset_of!(kiriSheetDef, fadeTime) == 204);
    assert!(offset_of!(kiriSheetDef, normals) == 208);
    assert!(offset_of!(kiriSheetDef, paper) == 212);
    assert!(size_of::<kiriSheetSettings>() == 76);
    assert!(align_of::<kiriSheetSettings>() == 4);
    assert!(offset_of!(kiriSheetSettings, cookie) == 0);
    assert!(offset_of!(kiriSheetSettings, material) == 4);
    assert!(offset_of!(kiriSheetSettings, maxFrames) == 28);
    assert!(offset_of!(kiriSheetSettings, crumbArea) == 32);
    assert!(offset_of!(kiriSheetSettings, friction) == 36);
    assert!(offset_of!(kiriSheetSettings, contactThickness) == 40);
    assert!(offset_of!(kiriSheetSettings, groups) == 44);
    assert!(offset_of!(kiriSheetSettings, touchesSheets) == 48);
    assert!(offset_of!(kiriSheetSettings, iterations) == 52);
    assert!(offset_of!(kiriSheetSettings, sleepSpeed) == 56);
    assert!(offset_of!(kiriSheetSettings, skinning) == 60);
    assert!(offset_of!(kiriSheetSettings, timeStepping) == 64);
    assert!(offset_of!(kiriSheetSettings, fadeTime) == 68);
    assert!(offset_of!(kiriSheetSettings, normals) == 72);
    assert!(size_of::<kiriMesh>() == 64);
    assert!(align_of::<kiriMesh>() == 8);
    assert!(offset_of!(kiriMesh, positions) == 0);
    assert!(offset_of!(kiriMesh, normals) == 8);
    assert!(offset_of!(kiriMesh, restPositions) == 16);
    assert!(offset_of!(kiriMesh, indices) == 24);
    assert!(offset_of!(kiriMesh, sourceTriangles) == 32);
    assert!(offset_of!(kiriMesh, sourceWeights) == 40);
    assert!(offset_of!(kiriMesh, vertexCount) == 48);
    assert!(offset_of!(kiriMesh, triangleCount) == 52);
    assert!(offset_of!(kiriMesh, revision) == 56);
    assert!(size_of::<kiriRange>() == 8);
    assert!(align_of::<kiriRange>() == 4);
    assert!(offset_of!(kiriRange, first) == 0);
    assert!(offset_of!(kiriRange, count) == 4);
    assert!(size_of::<kiriDirty>() == 36);
    assert!(align_of::<kiriDirty>() == 4);
    assert!(offset_of!(kiriDirty, newVertices) == 0);
    assert!(offset_of!(kiriDirty, newTriangles) == 8);
    assert!(offset_of!(kiriDirty, oldVertices) == 16);
    assert!(offset_of!(kiriDirty, oldTriangles) == 24);
    assert!(offset_of!(kiriDirty, revision) == 32);
    assert!(size_of::<kiriSolid>() == 56);
    assert!(align_of::<kiriSolid>() == 8);
    assert!(offset_of!(kiriSolid, positions) == 0);
    assert!(offset_of!(kiriSolid, normals) == 8);
    assert!(offset_of!(kiriSolid, restPositions) == 16);
    assert!(offset_of!(kiriSolid, indices) == 24);
    assert!(offset_of!(kiriSolid, sources) == 32);
    assert!(offset_of!(kiriSolid, vertexCount) == 40);
    assert!(offset_of!(kiriSolid, triangleCount) == 44);
    assert!(offset_of!(kiriSolid, rimTriangle) == 48);
    assert!(size_of::<kiriCounts>() == 28);
    assert!(align_of::<kiriCounts>() == 4);
    assert!(offset_of!(kiriCounts, vertices) == 0);
    assert!(offset_of!(kiriCounts, triangles) == 4);
    assert!(offset_of!(kiriCounts, cells) == 8);
    assert!(offset_of!(kiriCounts, frames) == 12);
    assert!(offset_of!(kiriCounts, links) == 16);
    assert!(offset_of!(kiriCounts, pieces) == 20);
    assert!(offset_of!(kiriCounts, collisionPoints) == 24);
    assert!(size_of::<kiriTotals>() == 104);
    assert!(align_of::<kiriTotals>() == 8);
    assert!(offset_of!(kiriTotals, area) == 0);
    assert!(offset_of!(kiriTotals, mass) == 8);
    assert!(offset_of!(kiriTotals, kineticEnergy) == 16);
    assert!(offset_of!(kiriTotals, elasticEnergy) == 24);
    assert!(offset_of!(kiriTotals, center) == 32);
    assert!(offset_of!(kiriTotals, momentum) == 56);
    assert!(offset_of!(kiriTotals, angularMomentum) == 80);
    assert!(size_of::<kiriHit>() == 40);
    assert!(align_of::<kiriHit>() == 4);
    assert!(offset_of!(kiriHit, restPoint) == 0);
    assert!(offset_of!(kiriHit, position) == 8);
    assert!(offset_of!(kiriHit, normal) == 20);
    assert!(offset_of!(kiriHit, distance) == 32);
    assert!(offset_of!(kiriHit, triangle) == 36);
    assert!(size_of::<kiriPointState>() == 40);
    assert!(align_of::<kiriPointState>() == 4);
    assert!(offset_of!(kiriPointState, position) == 0);
    assert!(offset_of!(kiriPointState, normal) == 12);
    assert!(offset_of!(kiriPointState, velocity) == 24);
    assert!(offset_of!(kiriPointState, frame) == 36);
    assert!(size_of::<kiriPieceState>() == 136);
    assert!(align_of::<kiriPieceState>() == 8);
    assert!(offset_of!(kiriPieceState, area) == 0);
    assert!(offset_of!(kiriPieceState, mass) == 8);
    assert!(offset_of!(kiriPieceState, center) == 16);
    assert!(offset_of!(kiriPieceState, momentum) == 40);
    assert!(offset_of!(kiriPieceState, angularMomentum) == 64);
    assert!(offset_of!(kiriPieceState, lower) == 88);
    assert!(offset_of!(kiriPieceState, upper) == 100);
    assert!(offset_of!(kiriPieceState, frames) == 112);
    assert!(offset_of!(kiriPieceState, vertices) == 116);
    assert!(offset_of!(kiriPieceState, triangles) == 120);
    assert!(offset_of!(kiriPieceState, collisionPoints) == 124);
    assert!(offset_of!(kiriPieceState, crumb) == 128);
    assert!(offset_of!(kiriPieceState, asleep) == 132);
    assert!(size_of::<kiriPieceMesh>() == 48);
    assert!(align_of::<kiriPieceMesh>() == 8);
    assert!(offset_of!(kiriPieceMesh, vertices) == 0);
    assert!(offset_of!(kiriPieceMesh, triangles) == 8);
    assert!(offset_of!(kiriPieceMesh, indices) == 16);
    assert!(offset_of!(kiriPieceMesh, collisionPoints) == 24);
    assert!(offset_of!(kiriPieceMesh, vertexCount) == 32);
    assert!(offset_of!(kiriPieceMesh, triangleCount) == 36);
    assert!(offset_of!(kiriPieceMesh, collisionPointCount) == 40);
    assert!(size_of::<kiriFrameState>() == 92);
    assert!(align_of::<kiriFrameState>() == 4);
    assert!(offset_of!(kiriFrameState, restPoint) == 0);
    assert!(offset_of!(kiriFrameState, position) == 8);
    assert!(offset_of!(kiriFrameState, rotation) == 20);
    assert!(offset_of!(kiriFrameState, velocity) == 56);
    assert!(offset_of!(kiriFrameState, angularVelocity) == 68);
    assert!(offset_of!(kiriFrameState, area) == 80);
    assert!(offset_of!(kiriFrameState, mass) == 84);
    assert!(offset_of!(kiriFrameState, held) == 88);
    assert!(size_of::<kiriWind>() == 24);
    assert!(align_of::<kiriWind>() == 4);
    assert!(offset_of!(kiriWind, velocity) == 0);
    assert!(offset_of!(kiriWind, density) == 12);
    assert!(offset_of!(kiriWind, drag) == 16);
    assert!(offset_of!(kiriWind, lift) == 20);
    assert!(size_of::<kiriPinDef>() == 36);
    assert!(align_of::<kiriPinDef>() == 4);
    assert!(offset_of!(kiriPinDef, cookie) == 0);
    assert!(offset_of!(kiriPinDef, restPoint) == 4);
    assert!(offset_of!(kiriPinDef, target) == 12);
    assert!(offset_of!(kiriPinDef, stiffness) == 24);
    assert!(offset_of!(kiriPinDef, breakForce) == 28);
    assert!(offset_of!(kiriPinDef, obstacle) == 32);
    assert!(size_of::<kiriPinState>() == 80);
    assert!(align_of::<kiriPinState>() == 4);
    assert!(offset_of!(kiriPinState, type_) == 0);
    assert!(offset_of!(kiriPinState, sheet) == 4);
    assert!(offset_of!(kiriPinState, from) == 8);
    assert!(offset_of!(kiriPinState, to) == 16);
    assert!(offset_of!(kiriPinState, target) == 24);
    assert!(offset_of!(kiriPinState, rotation) == 36);
    assert!(offset_of!(kiriPinState, breakForce) == 72);
    assert!(offset_of!(kiriPinState, obstacle) == 76);
    assert!(size_of::<kiriContact>() == 56);
    assert!(align_of::<kiriContact>() == 4);
    assert!(offset_of!(kiriContact, point) == 0);
    assert!(offset_of!(kiriContact, restPoint) == 4);
    assert!(offset_of!(kiriContact, normal) == 12);
    assert!(offset_of!(kiriContact, offset) == 24);
    assert!(offset_of!(kiriContact, velocity) == 28);
    assert!(offset_of!(kiriContact, friction) == 40);
    assert!(offset_of!(kiriContact, inverseMass) == 44);
    assert!(offset_of!(kiriContact, pushSpeed) == 48);
    assert!(offset_of!(kiriContact, obstacle) == 52);
    assert!(size_of::<kiriContactForce>() == 64);
    assert!(align_of::<kiriContactForce>() == 8);
    assert!(offset_of!(kiriContactForce, impulse) == 0);
    assert!(offset_of!(kiriContactForce, position) == 24);
    assert!(offset_of!(kiriContactForce, depth) == 48);
    assert!(offset_of!(kiriContactForce, point) == 56);
    assert!(offset_of!(kiriContactForce, obstacle) == 60);
    assert!(size_of::<kiriObstacleDef>() == 192);
    assert!(align_of::<kiriObstacleDef>() == 8);
    assert!(offset_of!(kiriObstacleDef, cookie) == 0);
    assert!(offset_of!(kiriObstacleDef, type_) == 4);
    assert!(offset_of!(kiriObstacleDef, size) == 8);
    assert!(offset_of!(kiriObstacleDef, radius) == 20);
    assert!(offset_of!(kiriObstacleDef, height) == 24);
    assert!(offset_of!(kiriObstacleDef, outline) == 32);
    assert!(offset_of!(kiriObstacleDef, outlineCount) == 40);
    assert!(offset_of!(kiriObstacleDef, rounding) == 44);
    assert!(offset_of!(kiriObstacleDef, position) == 48);
    assert!(offset_of!(kiriObstacleDef, rotation) == 60);
    assert!(offset_of!(kiriObstacleDef, velocity) == 96);
    assert!(offset_of!(kiriObstacleDef, angularVelocity) == 108);
    assert!(offset_of!(kiriObstacleDef, surfaceVelocity) == 120);
    assert!(offset_of!(kiriObstacleDef, friction) == 132);
    assert!(offset_of!(kiriObstacleDef, mass) == 136);
    assert!(offset_of!(kiriObstacleDef, inertia) == 140);
    assert!(offset_of!(kiriObstacleDef, centerOfMass) == 164);
    assert!(offset_of!(kiriObstacleDef, body) == 176);
    assert!(offset_of!(kiriObstacleDef, pushSpeed) == 180);
    assert!(offset_of!(kiriObstacleDef, groups) == 184);
    assert!(size_of::<kiriObstacleState>() == 128);
    assert!(align_of::<kiriObstacleState>() == 8);
    assert!(offset_of!(kiriObstacleState, position) == 0);
    assert!(offset_of!(kiriObstacleState, rotation) == 12);
    assert!(offset_of!(kiriObstacleState, velocity) == 48);
    assert!(offset_of!(kiriObstacleState, angularVelocity) == 60);
    assert!(offset_of!(kiriObstacleState, impulse) == 72);
    assert!(offset_of!(kiriObstacleState, angularImpulse) == 96);
    assert!(offset_of!(kiriObstacleState, contacts) == 120);
    assert!(size_of::<kiriDrawVertex>() == 16);
    assert!(align_of::<kiriDrawVertex>() == 4);
    assert!(offset_of!(kiriDrawVertex, position) == 0);
    assert!(offset_of!(kiriDrawVertex, color) == 12);
    assert!(size_of::<kiriDebugDraw>() == 48);
    assert!(align_of::<kiriDebugDraw>() == 8);
    assert!(offset_of!(kiriDebugDraw, cookie) == 0);
    assert!(offset_of!(kiriDebugDraw, flags) == 4);
    assert!(offset_of!(kiriDebugDraw, sheet) == 8);
    assert!(offset_of!(kiriDebugDraw, size) == 12);
    assert!(offset_of!(kiriDebugDraw, points) == 16);
    assert!(offset_of!(kiriDebugDraw, lines) == 24);
    assert!(offset_of!(kiriDebugDraw, triangles) == 32);
    assert!(offset_of!(kiriDebugDraw, user) == 40);
};

#[cfg(target_arch = "wasm32")]
const _: () = {
    assert!(size_of::<kiriBudget>() == 16);
    assert!(align_of::<kiriBudget>() == 4);
    assert!(offset_of!(kiriBudget, triangles) == 0);
    assert!(offset_of!(kiriBudget, cells) == 4);
    assert!(offset_of!(kiriBudget, samples) == 8);
    assert!(offset_of!(kiriBudget, iterations) == 12);
    assert!(size_of::<kiriWorldDef>() == 72);
    assert!(align_of::<kiriWorldDef>() == 4);
    assert!(offset_of!(kiriWorldDef, cookie) == 0);
    assert!(offset_of!(kiriWorldDef, gravity) == 4);
    assert!(offset_of!(kiriWorldDef, budget) == 16);
    assert!(offset_of!(kiriWorldDef, alloc) == 32);
    assert!(offset_of!(kiriWorldDef, free) == 36);
    assert!(offset_of!(kiriWorldDef, log) == 40);
    assert!(offset_of!(kiriWorldDef, clock) == 44);
    assert!(offset_of!(kiriWorldDef, startTask) == 48);
    assert!(offset_of!(kiriWorldDef, finishTask) == 52);
    assert!(offset_of!(kiriWorldDef, workerCount) == 56);
    assert!(offset_of!(kiriWorldDef, user) == 60);
    assert!(offset_of!(kiriWorldDef, record) == 64);
    assert!(offset_of!(kiriWorldDef, recordHashTicks) == 68);
    assert!(size_of::<kiriReplay>() == 32);
    assert!(align_of::<kiriReplay>() == 8);
    assert!(offset_of!(kiriReplay, offset) == 0);
    assert!(offset_of!(kiriReplay, calls) == 8);
    assert!(offset_of!(kiriReplay, ticks) == 16);
    assert!(offset_of!(kiriReplay, note) == 24);
    assert!(offset_of!(kiriReplay, noteCount) == 28);
    assert!(size_of::<kiriEvent>() == 36);
    assert!(align_of::<kiriEvent>() == 4);
    assert!(offset_of!(kiriEvent, type_) == 0);
    assert!(offset_of!(kiriEvent, sheet) == 4);
    assert!(offset_of!(kiriEvent, cut) == 8);
    assert!(offset_of!(kiriEvent, frame) == 12);
    assert!(offset_of!(kiriEvent, pin) == 16);
    assert!(offset_of!(kiriEvent, crumb) == 20);
    assert!(offset_of!(kiriEvent, area) == 24);
    assert!(offset_of!(kiriEvent, stage) == 28);
    assert!(offset_of!(kiriEvent, waiting) == 32);
    assert!(size_of::<kiriProfile>() == 144);
    assert!(align_of::<kiriProfile>() == 8);
    assert!(offset_of!(kiriProfile, seconds) == 0);
    assert!(offset_of!(kiriProfile, cutSegments) == 72);
    assert!(offset_of!(kiriProfile, trianglesSplit) == 76);
    assert!(offset_of!(kiriProfile, cellsSettled) == 80);
    assert!(offset_of!(kiriProfile, samplesRefreshed) == 84);
    assert!(offset_of!(kiriProfile, solverIterations) == 88);
    assert!(offset_of!(kiriProfile, cellsChanged) == 92);
    assert!(offset_of!(kiriProfile, weightsChanged) == 96);
    assert!(offset_of!(kiriProfile, verticesChanged) == 100);
    assert!(offset_of!(kiriProfile, pointsChanged) == 104);
    assert!(offset_of!(kiriProfile, linksChanged) == 108);
    assert!(offset_of!(kiriProfile, commits) == 112);
    assert!(offset_of!(kiriProfile, systemsSolved) == 116);
    assert!(offset_of!(kiriProfile, contacts) == 120);
    assert!(offset_of!(kiriProfile, sheetPairs) == 124);
    assert!(offset_of!(kiriProfile, largestJump) == 128);
    assert!(offset_of!(kiriProfile, largestFade) == 136);
    assert!(size_of::<kiriMaterial>() == 24);
    assert!(align_of::<kiriMaterial>() == 4);
    assert!(offset_of!(kiriMaterial, youngsModulus) == 0);
    assert!(offset_of!(kiriMaterial, poissonsRatio) == 4);
    assert!(offset_of!(kiriMaterial, thickness) == 8);
    assert!(offset_of!(kiriMaterial, density) == 12);
    assert!(offset_of!(kiriMaterial, airDamping) == 16);
    assert!(offset_of!(kiriMaterial, flexDamping) == 20);
    assert!(size_of::<kiriQuality>() == 16);
    assert!(align_of::<kiriQuality>() == 4);
    assert!(offset_of!(kiriQuality, framesAlong) == 0);
    assert!(offset_of!(kiriQuality, gridResolution) == 4);
    assert!(offset_of!(kiriQuality, iterations) == 8);
    assert!(offset_of!(kiriQuality, substeps) == 12);
    assert!(size_of::<kiriPaperOptions>() == 20);
    assert!(align_of::<kiriPaperOptions>() == 4);
    assert!(offset_of!(kiriPaperOptions, fromScratch) == 0);
    assert!(offset_of!(kiriPaperOptions, popping) == 4);
    assert!(offset_of!(kiriPaperOptions, linearWeights) == 8);
    assert!(offset_of!(kiriPaperOptions, integrationPoints) == 12);
    assert!(offset_of!(kiriPaperOptions, integrationOrder) == 16);
    assert!(size_of::<kiriSheetDef>() == 208);
    assert!(align_of::<kiriSheetDef>() == 4);
    assert!(offset_of!(kiriSheetDef, cookie) == 0);
    assert!(offset_of!(kiriSheetDef, restPositions) == 4);
    assert!(offset_of!(kiriSheetDef, vertexCount) == 8);
    assert!(offset_of!(kiriSheetDef, indices) == 12);
    assert!(offset_of!(kiriSheetDef, triangleCount) == 16);
    assert!(offset_of!(kiriSheetDef, position) == 20);
    assert!(offset_of!(kiriSheetDef, axisU) == 32);
    assert!(offset_of!(kiriSheetDef, axisV) == 44);
    assert!(offset_of!(kiriSheetDef, velocity) == 56);
    assert!(offset_of!(kiriSheetDef, material) == 68);
    assert!(offset_of!(kiriSheetDef, gridResolution) == 92);
    assert!(offset_of!(kiriSheetDef, snapDistance) == 96);
    assert!(offset_of!(kiriSheetDef, weldDistance) == 100);
    assert!(offset_of!(kiriSheetDef, frameCount) == 104);
    assert!(offset_of!(kiriSheetDef, frameLength) == 108);
    assert!(offset_of!(kiriSheetDef, accuracy) == 112);
    assert!(offset_of!(kiriSheetDef, framePoints) == 116);
    assert!(offset_of!(kiriSheetDef, maxFrames) == 120);
    assert!(offset_of!(kiriSheetDef, rigidWeight) == 124);
    assert!(offset_of!(kiriSheetDef, rigidArea) == 128);
    assert!(offset_of!(kiriSheetDef, crumbArea) == 132);
    assert!(offset_of!(kiriSheetDef, friction) == 136);
    assert!(offset_of!(kiriSheetDef, contactThickness) == 140);
    assert!(offset_of!(kiriSheetDef, groups) == 144);
    assert!(offset_of!(kiriSheetDef, touchesSheets) == 148);
    assert!(offset_of!(kiriSheetDef, collisionPoints) == 152);
    assert!(offset_of!(kiriSheetDef, iterations) == 156);
    assert!(offset_of!(kiriSheetDef, sleepSpeed) == 160);
    assert!(offset_of!(kiriSheetDef, model) == 164);
    assert!(offset_of!(kiriSheetDef, skinning) == 168);
    assert!(offset_of!(kiriSheetDef, planar) == 172);
    assert!(offset_of!(kiriSheetDef, timeStepping) == 176);
    assert!(offset_of!(kiriSheetDef, fadeTime) == 180);
    assert!(offset_of!(kiriSheetDef, normals) == 184);
    assert!(offset_of!(kiriSheetDef, paper) == 188);
    assert!(size_of::<kiriSheetSettings>() == 76);
    assert!(align_of::<kiriSheetSettings>() == 4);
    assert!(offset_of!(kiriSheetSettings, cookie) == 0);
    assert!(offset_of!(kiriSheetSettings, material) == 4);
    assert!(offset_of!(kiriSheetSettings, maxFrames) == 28);
    assert!(offset_of!(kiriSheetSettings, crumbArea) == 32);
    assert!(offset_of!(kiriSheetSettings, friction) == 36);
    assert!(offset_of!(kiriSheetSettings, contactThickness) == 40);
    assert!(offset_of!(kiriSheetSettings, groups) == 44);
    assert!(offset_of!(kiriSheetSettings, touchesSheets) == 48);
    assert!(offset_of!(kiriSheetSettings, iterations) == 52);
    assert!(offset_of!(kiriSheetSettings, sleepSpeed) == 56);
    assert!(offset_of!(kiriSheetSettings, skinning) == 60);
    assert!(offset_of!(kiriSheetSettings, timeStepping) == 64);
    assert!(offset_of!(kiriSheetSettings, fadeTime) == 68);
    assert!(offset_of!(kiriSheetSettings, normals) == 72);
    assert!(size_of::<kiriMesh>() == 36);
    assert!(align_of::<kiriMesh>() == 4);
    assert!(offset_of!(kiriMesh, positions) == 0);
    assert!(offset_of!(kiriMesh, normals) == 4);
    assert!(offset_of!(kiriMesh, restPositions) == 8);
    assert!(offset_of!(kiriMesh, indices) == 12);
    assert!(offset_of!(kiriMesh, sourceTriangles) == 16);
    assert!(offset_of!(kiriMesh, sourceWeights) == 20);
    assert!(offset_of!(kiriMesh, vertexCount) == 24);
    assert!(offset_of!(kiriMesh, triangleCount) == 28);
    assert!(offset_of!(kiriMesh, revision) == 32);
    assert!(size_of::<kiriRange>() == 8);
    assert!(align_of::<kiriRange>() == 4);
    assert!(offset_of!(kiriRange, first) == 0);
    assert!(offset_of!(kiriRange, count) == 4);
    assert!(size_of::<kiriDirty>() == 36);
    assert!(align_of::<kiriDirty>() == 4);
    assert!(offset_of!(kiriDirty, newVertices) == 0);
    assert!(offset_of!(kiriDirty, newTriangles) == 8);
    assert!(offset_of!(kiriDirty, oldVertices) == 16);
    assert!(offset_of!(kiriDirty, oldTriangles) == 24);
    assert!(offset_of!(kiriDirty, revision) == 32);
    assert!(size_of::<kiriSolid>() == 32);
    assert!(align_of::<kiriSolid>() == 4);
    assert!(offset_of!(kiriSolid, positions) == 0);
    assert!(offset_of!(kiriSolid, normals) == 4);
    assert!(offset_of!(kiriSolid, restPositions) == 8);
    assert!(offset_of!(kiriSolid, indices) == 12);
    assert!(offset_of!(kiriSolid, sources) == 16);
    assert!(offset_of!(kiriSolid, vertexCount) == 20);
    assert!(offset_of!(kiriSolid, triangleCount) == 24);
    assert!(offset_of!(kiriSolid, rimTriangle) == 28);
    assert!(size_of::<kiriCounts>() == 28);
    assert!(align_of::<kiriCounts>() == 4);
    assert!(offset_of!(kiriCounts, vertices) == 0);
    assert!(offset_of!(kiriCounts, triangles) == 4);
    assert!(offset_of!(kiriCounts, cells) == 8);
    assert!(offset_of!(kiriCounts, frames) == 12);
    assert!(offset_of!(kiriCounts, links) == 16);
    assert!(offset_of!(kiriCounts, pieces) == 20);
    assert!(offset_of!(kiriCounts, collisionPoints) == 24);
    assert!(size_of::<kiriTotals>() == 104);
    assert!(align_of::<kiriTotals>() == 8);
    assert!(offset_of!(kiriTotals, area) == 0);
    assert!(offset_of!(kiriTotals, mass) == 8);
    assert!(offset_of!(kiriTotals, kineticEnergy) == 16);
    assert!(offset_of!(kiriTotals, elasticEnergy) == 24);
    assert!(offset_of!(kiriTotals, center) == 32);
    assert!(offset_of!(kiriTotals, momentum) == 56);
    assert!(offset_of!(kiriTotals, angularMomentum) == 80);
    assert!(size_of::<kiriHit>() == 40);
    assert!(align_of::<kiriHit>() == 4);
    assert!(offset_of!(kiriHit, restPoint) == 0);
    assert!(offset_of!(kiriHit, position) == 8);
    assert!(offset_of!(kiriHit, normal) == 20);
    assert!(offset_of!(kiriHit, distance) == 32);
    assert!(offset_of!(kiriHit, triangle) == 36);
    assert!(size_of::<kiriPointState>() == 40);
    assert!(align_of::<kiriPointState>() == 4);
    assert!(offset_of!(kiriPointState, position) == 0);
    assert!(offset_of!(kiriPointState, normal) == 12);
    assert!(offset_of!(kiriPointState, velocity) == 24);
    assert!(offset_of!(kiriPointState, frame) == 36);
    assert!(size_of::<kiriPieceState>() == 136);
    assert!(align_of::<kiriPieceState>() == 8);
    assert!(offset_of!(kiriPieceState, area) == 0);
    assert!(offset_of!(kiriPieceState, mass) == 8);
    assert!(offset_of!(kiriPieceState, center) == 16);
    assert!(offset_of!(kiriPieceState, momentum) == 40);
    assert!(offset_of!(kiriPieceState, angularMomentum) == 64);
    assert!(offset_of!(kiriPieceState, lower) == 88);
    assert!(offset_of!(kiriPieceState, upper) == 100);
    assert!(offset_of!(kiriPieceState, frames) == 112);
    assert!(offset_of!(kiriPieceState, vertices) == 116);
    assert!(offset_of!(kiriPieceState, triangles) == 120);
    assert!(offset_of!(kiriPieceState, collisionPoints) == 124);
    assert!(offset_of!(kiriPieceState, crumb) == 128);
    assert!(offset_of!(kiriPieceState, asleep) == 132);
    assert!(size_of::<kiriPieceMesh>() == 28);
    assert!(align_of::<kiriPieceMesh>() == 4);
    assert!(offset_of!(kiriPieceMesh, vertices) == 0);
    assert!(offset_of!(kiriPieceMesh, triangles) == 4);
    assert!(offset_of!(kiriPieceMesh, indices) == 8);
    assert!(offset_of!(kiriPieceMesh, collisionPoints) == 12);
    assert!(offset_of!(kiriPieceMesh, vertexCount) == 16);
    assert!(offset_of!(kiriPieceMesh, triangleCount) == 20);
    assert!(offset_of!(kiriPieceMesh, collisionPointCount) == 24);
    assert!(size_of::<kiriFrameState>() == 92);
    assert!(align_of::<kiriFrameState>() == 4);
    assert!(offset_of!(kiriFrameState, restPoint) == 0);
    assert!(offset_of!(kiriFrameState, position) == 8);
    assert!(offset_of!(kiriFrameState, rotation) == 20);
    assert!(offset_of!(kiriFrameState, velocity) == 56);
    assert!(offset_of!(kiriFrameState, angularVelocity) == 68);
    assert!(offset_of!(kiriFrameState, area) == 80);
    assert!(offset_of!(kiriFrameState, mass) == 84);
    assert!(offset_of!(kiriFrameState, held) == 88);
    assert!(size_of::<kiriWind>() == 24);
    assert!(align_of::<kiriWind>() == 4);
    assert!(offset_of!(kiriWind, velocity) == 0);
    assert!(offset_of!(kiriWind, density) == 12);
    assert!(offset_of!(kiriWind, drag) == 16);
    assert!(offset_of!(kiriWind, lift) == 20);
    assert!(size_of::<kiriPinDef>() == 36);
    assert!(align_of::<kiriPinDef>() == 4);
    assert!(offset_of!(kiriPinDef, cookie) == 0);
    assert!(offset_of!(kiriPinDef, restPoint) == 4);
    assert!(offset_of!(kiriPinDef, target) == 12);
    assert!(offset_of!(kiriPinDef, stiffness) == 24);
    assert!(offset_of!(kiriPinDef, breakForce) == 28);
    assert!(offset_of!(kiriPinDef, obstacle) == 32);
    assert!(size_of::<kiriPinState>() == 80);
    assert!(align_of::<kiriPinState>() == 4);
    assert!(offset_of!(kiriPinState, type_) == 0);
    assert!(offset_of!(kiriPinState, sheet) == 4);
    assert!(offset_of!(kiriPinState, from) == 8);
    assert!(offset_of!(kiriPinState, to) == 16);
    assert!(offset_of!(kiriPinState, target) == 24);
    assert!(offset_of!(kiriPinState, rotation) == 36);
    assert!(offset_of!(kiriPinState, breakForce) == 72);
    assert!(offset_of!(kiriPinState, obstacle) == 76);
    assert!(size_of::<kiriContact>() == 56);
    assert!(align_of::<kiriContact>() == 4);
    assert!(offset_of!(kiriContact, point) == 0);
    assert!(offset_of!(kiriContact, restPoint) == 4);
    assert!(offset_of!(kiriContact, normal) == 12);
    assert!(offset_of!(kiriContact, offset) == 24);
    assert!(offset_of!(kiriContact, velocity) == 28);
    assert!(offset_of!(kiriContact, friction) == 40);
    assert!(offset_of!(kiriContact, inverseMass) == 44);
    assert!(offset_of!(kiriContact, pushSpeed) == 48);
    assert!(offset_of!(kiriContact, obstacle) == 52);
    assert!(size_of::<kiriContactForce>() == 64);
    assert!(align_of::<kiriContactForce>() == 8);
    assert!(offset_of!(kiriContactForce, impulse) == 0);
    assert!(offset_of!(kiriContactForce, position) == 24);
    assert!(offset_of!(kiriContactForce, depth) == 48);
    assert!(offset_of!(kiriContactForce, point) == 56);
    assert!(offset_of!(kiriContactForce, obstacle) == 60);
    assert!(size_of::<kiriObstacleDef>() == 180);
    assert!(align_of::<kiriObstacleDef>() == 4);
    assert!(offset_of!(kiriObstacleDef, cookie) == 0);
    assert!(offset_of!(kiriObstacleDef, type_) == 4);
    assert!(offset_of!(kiriObstacleDef, size) == 8);
    assert!(offset_of!(kiriObstacleDef, radius) == 20);
    assert!(offset_of!(kiriObstacleDef, height) == 24);
    assert!(offset_of!(kiriObstacleDef, outline) == 28);
    assert!(offset_of!(kiriObstacleDef, outlineCount) == 32);
    assert!(offset_of!(kiriObstacleDef, rounding) == 36);
    assert!(offset_of!(kiriObstacleDef, position) == 40);
    assert!(offset_of!(kiriObstacleDef, rotation) == 52);
    assert!(offset_of!(kiriObstacleDef, velocity) == 88);
    assert!(offset_of!(kiriObstacleDef, angularVelocity) == 100);
    assert!(offset_of!(kiriObstacleDef, surfaceVelocity) == 112);
    assert!(offset_of!(kiriObstacleDef, friction) == 124);
    assert!(offset_of!(kiriObstacleDef, mass) == 128);
    assert!(offset_of!(kiriObstacleDef, inertia) == 132);
    assert!(offset_of!(kiriObstacleDef, centerOfMass) == 156);
    assert!(offset_of!(kiriObstacleDef, body) == 168);
    assert!(offset_of!(kiriObstacleDef, pushSpeed) == 172);
    assert!(offset_of!(kiriObstacleDef, groups) == 176);
    assert!(size_of::<kiriObstacleState>() == 128);
    assert!(align_of::<kiriObstacleState>() == 8);
    assert!(offset_of!(kiriObstacleState, position) == 0);
    assert!(offset_of!(kiriObstacleState, rotation) == 12);
    assert!(offset_of!(kiriObstacleState, velocity) == 48);
    assert!(offset_of!(kiriObstacleState, angularVelocity) == 60);
    assert!(offset_of!(kiriObstacleState, impulse) == 72);
    assert!(offset_of!(kiriObstacleState, angularImpulse) == 96);
    assert!(offset_of!(kiriObstacleState, contacts) == 120);
    assert!(size_of::<kiriDrawVertex>() == 16);
    assert!(align_of::<kiriDrawVertex>() == 4);
    assert!(offset_of!(kiriDrawVertex, position) == 0);
    assert!(offset_of!(kiriDrawVertex, color) == 12);
    assert!(size_of::<kiriDebugDraw>() == 32);
    assert!(align_of::<kiriDebugDraw>() == 4);
    assert!(offset_of!(kiriDebugDraw, cookie) == 0);
    assert!(offset_of!(kiriDebugDraw, flags) == 4);
    assert!(offset_of!(kiriDebugDraw, sheet) == 8);
    assert!(offset_of!(kiriDebugDraw, size) == 12);
    assert!(offset_of!(kiriDebugDraw, points) == 16);
    assert!(offset_of!(kiriDebugDraw, lines) == 20);
    assert!(offset_of!(kiriDebugDraw, triangles) == 24);
    assert!(offset_of!(kiriDebugDraw, user) == 28);
};
