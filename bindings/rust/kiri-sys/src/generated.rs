// Made from kiri.h by `make bindings`.

use core::ffi::{c_char, c_void};
use core::mem::{align_of, offset_of, size_of};

pub type kiriSheet = u32;
pub type kiriCut = u32;
pub type kiriFrame = u32;
pub type kiriPin = u32;
pub type kiriObstacle = u32;
pub type kiriBlade = u32;
pub type kiriSeam = u32;
pub type kiriResult = i32;

#[repr(C)]
pub struct kiriWorld {
    _private: [u8; 0],
}

/// Of the header.
pub const KIRI_VERSION: i32 = 3400;

pub const KIRI_OK: i32 = 0;
/// success; work is left for later ticks
pub const KIRI_PENDING: i32 = 1;
/// null, NaN, infinite, outside the documented range, or beyond 4e37 m, m/s or 1/s
pub const KIRI_ERROR_ARGUMENT: i32 = -1;
/// the def was not filled by its kiriDefault function: call that first
pub const KIRI_ERROR_DEF: i32 = -2;
/// unknown or stale id, or the id of another kind
pub const KIRI_ERROR_ID: i32 = -3;
/// the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping
pub const KIRI_ERROR_MESH: i32 = -4;
/// the call comes in the wrong order, or from a callback that may not make it
pub const KIRI_ERROR_STATE: i32 = -5;
/// the allocator returned null
pub const KIRI_ERROR_MEMORY: i32 = -6;
/// the motion of a sheet could not be continued; the sheet was stopped where it was
pub const KIRI_DIVERGED: i32 = -7;
/// all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world
pub const KIRI_ERROR_LIMIT: i32 = -8;
/// floats are not computed as on other machines, see kiriCreateWorld
pub const KIRI_ERROR_BUILD: i32 = -9;
/// the bytes are damaged, cut short, of another kind, or of a later version
pub const KIRI_ERROR_DATA: i32 = -10;
/// a repeated call gave another result than its recording has
pub const KIRI_ERROR_REPLAY: i32 = -11;

pub const KIRI_LEAST_TRIANGLES: i32 = 16;

pub const KIRI_MOST_NOTE_BYTES: i32 = 1048576;

/// cut: all of it is in the mesh; the id is stale from now on
pub const KIRI_EVENT_CUT_FINISHED: i32 = 1;
/// frame (its first, which names it), crumb, area: a part came off, never the largest
pub const KIRI_EVENT_PIECE_OFF: i32 = 2;
/// frame
pub const KIRI_EVENT_FRAME_ADDED: i32 = 3;
/// the sheet was stopped
pub const KIRI_EVENT_DIVERGED: i32 = 4;
/// stage, waiting: the budget ended in this stage of the sheet's work
pub const KIRI_EVENT_DEFERRED: i32 = 5;
/// pin: its force exceeded breakForce; the id is stale from now on
pub const KIRI_EVENT_PIN_BROKE: i32 = 6;
/// sheet (the new one), frame, area: a pending kiriFrame_DetachPiece is done
pub const KIRI_EVENT_PIECE_DETACHED: i32 = 7;
/// seam, stitches: some stitches broke; with none left the id is stale from now on
pub const KIRI_EVENT_SEAM_BROKE: i32 = 8;
/// cut: the library began it, see kiriTearing
pub const KIRI_EVENT_TEAR_BEGAN: i32 = 9;
/// cut: the tear has rested for half a second; the id is stale from now on
pub const KIRI_EVENT_TEAR_ENDED: i32 = 10;
/// area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s
pub const KIRI_EVENT_STRAINED: i32 = 11;

/// splits the mesh along the blade
pub const KIRI_STAGE_CUT: i32 = 0;
/// cells and their connections
pub const KIRI_STAGE_GRID: i32 = 1;
/// geodesic distances, regions, links; places frames
pub const KIRI_STAGE_REGIONS: i32 = 2;
/// shape functions
pub const KIRI_STAGE_SHAPE: i32 = 3;
/// weights of vertices and collision points
pub const KIRI_STAGE_SAMPLES: i32 = 4;
/// mass, the pattern of the solver's matrix, and the commit
pub const KIRI_STAGE_CONSTANTS: i32 = 5;
/// contacts with obstacles, other sheets and other pieces
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
/// paperboard, 0.4 mm
pub const KIRI_MATERIAL_CARD: i32 = 4;
pub const KIRI_MATERIAL_SILK: i32 = 5;
pub const KIRI_MATERIAL_SHIRTING: i32 = 6;
pub const KIRI_MATERIAL_WOOL: i32 = 7;
pub const KIRI_MATERIAL_DENIM: i32 = 8;
pub const KIRI_MATERIAL_JERSEY: i32 = 9;
pub const KIRI_MATERIAL_COUNT: i32 = 10;

pub const KIRI_QUALITY_FAST: i32 = 0;
pub const KIRI_QUALITY_BALANCED: i32 = 1;
pub const KIRI_QUALITY_ACCURATE: i32 = 2;
pub const KIRI_QUALITY_COUNT: i32 = 3;

pub const KIRI_SETUP_CURTAIN: i32 = 0;
pub const KIRI_SETUP_PAPER: i32 = 1;
pub const KIRI_SETUP_FLAG: i32 = 2;
pub const KIRI_SETUP_RIBBON: i32 = 3;
pub const KIRI_SETUP_RUBBER: i32 = 4;
pub const KIRI_SETUP_CARD: i32 = 5;
pub const KIRI_SETUP_FOIL: i32 = 6;
pub const KIRI_SETUP_COUNT: i32 = 7;

/// rigid frames joined by links: paper, foil, stiff cloth
pub const KIRI_MODEL_LINKS: i32 = 0;
/// affine frames joined by links: cloth and rubber that stretch inside a region
pub const KIRI_MODEL_AFFINE: i32 = 1;
/// affine frames, strains at integration points, as in the paper. Thin sheets hardly bend
pub const KIRI_MODEL_POINTS: i32 = 2;

/// each frame carries a flat patch; the weights blend them (equation 1 of the paper)
pub const KIRI_SKINNING_LINEAR: i32 = 0;
/// patches bend and stretch as their neighbours lie: no bumps at the frames
pub const KIRI_SKINNING_SMOOTH: i32 = 1;

/// TR-BDF2, of second order: keeps the energy of motion
pub const KIRI_TIME_STEPPING_SECOND_ORDER: i32 = 0;
/// backward Euler, of first order: takes energy out of a swing, more in longer steps
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
/// outline: convex, in the plane of the first two columns; height along the third, 0: endless
pub const KIRI_OBSTACLE_PRISM: i32 = 5;

/// a triangle for each triangle of the mesh, in a colour of its piece; sleeping: pale
pub const KIRI_DRAW_TRIANGLES: i32 = 1;
/// a line for each edge between two triangles
pub const KIRI_DRAW_EDGES: i32 = 2;
/// a line for each edge of the outline, of lips and of folds
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

/// Functions of the host. They may call other worlds; of the same world kiriWorld_GetLastError
/// alone, or in a function that takes a const kiriWorld also functions that do so. Other calls give
/// KIRI_ERROR_STATE (manual, budget). at least 16-byte aligned, or null
pub type kiriAllocFn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: i64) -> *mut c_void>;

/// Functions of the host. They may call other worlds; of the same world kiriWorld_GetLastError
/// alone, or in a function that takes a const kiriWorld also functions that do so. Other calls give
/// KIRI_ERROR_STATE (manual, budget).
pub type kiriFreeFn = Option<unsafe extern "C" fn(user: *mut c_void, pointer: *mut c_void)>;

/// Functions of the host. They may call other worlds; of the same world kiriWorld_GetLastError
/// alone, or in a function that takes a const kiriWorld also functions that do so. Other calls give
/// KIRI_ERROR_STATE (manual, budget).
pub type kiriLogFn = Option<unsafe extern "C" fn(user: *mut c_void, line: *const c_char)>;

/// Functions of the host. They may call other worlds; of the same world kiriWorld_GetLastError
/// alone, or in a function that takes a const kiriWorld also functions that do so. Other calls give
/// KIRI_ERROR_STATE (manual, budget). seconds; read for the profile only, never by the simulation
pub type kiriClockFn = Option<unsafe extern "C" fn(user: *mut c_void) -> f64>;

/// Functions of the host. They may call other worlds; of the same world kiriWorld_GetLastError
/// alone, or in a function that takes a const kiriWorld also functions that do so. Other calls give
/// KIRI_ERROR_STATE (manual, budget). the next bytes of the recording
pub type kiriRecordFn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: *const c_void, count: i32)>;

/// For hosts that lend threads to a tick. \`start\` calls the task for ranges of minRange items or
/// more that cover the items 0 to itemCount, each once, and returns a handle; \`finish\` returns
/// after these calls (manual, budget). the items from start up to, without, end
pub type kiriTaskFn = Option<unsafe extern "C" fn(start: i32, end: i32, taskContext: *mut c_void)>;

/// For hosts that lend threads to a tick. \`start\` calls the task for ranges of minRange items or
/// more that cover the items 0 to itemCount, each once, and returns a handle; \`finish\` returns
/// after these calls (manual, budget).
pub type kiriStartTaskFn = Option<unsafe extern "C" fn(user: *mut c_void, task: kiriTaskFn, itemCount: i32, minRange: i32, taskContext: *mut c_void) -> *mut c_void>;

/// For hosts that lend threads to a tick. \`start\` calls the task for ranges of minRange items or
/// more that cover the items 0 to itemCount, each once, and returns a handle; \`finish\` returns
/// after these calls (manual, budget).
pub type kiriFinishTaskFn = Option<unsafe extern "C" fn(user: *mut c_void, handle: *mut c_void)>;

/// Receives up to 240 vertices, valid during the call: one for a point, two for a line, three for a
/// triangle.
pub type kiriDrawFn = Option<unsafe extern "C" fn(user: *mut c_void, vertices: *const kiriDrawVertex, count: i32)>;

/// Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share
/// one allowance: using 30 % of one leaves 70 % of the others. Other work goes on in the next tick.
/// The budget decides when a cut takes effect; the mesh, grid, regions, weights and sites of frames
/// after all work is done do not depend on it (manual, budget).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriBudget {
    /// split by blades; 0, or KIRI_LEAST_TRIANGLES and more
    pub triangles: i32,
    /// visited, or with a new distance: grid, regions, shape functions. A link counts as a cell
    pub cells: i32,
    /// vertices and collision points with new weights, and the cost of the commit, paid before it
    pub samples: i32,
    /// linear systems, 30 to 60 us each; a large one counts as several (manual, budget)
    pub iterations: i32,
}

/// Settings of a world: gravity, budget, and functions of the host.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriWorldDef {
    pub cookie: u32,
    /// m/s^2; default (0, 0, -9.81)
    pub gravity: [f32; 3],
    /// default: no limit
    pub budget: kiriBudget,
    /// null: malloc and free. Set both or none.
    pub alloc: kiriAllocFn,
    pub free: kiriFreeFn,
    /// one line for each error and KIRI_EVENT_STRAINED; null: silent
    pub log: kiriLogFn,
    /// null: the profile has counts, and no times
    pub clock: kiriClockFn,
    /// null: a tick runs in the calling thread alone. Set both or none.
    pub startTask: kiriStartTaskFn,
    pub finishTask: kiriFinishTaskFn,
    /// threads for a task, the caller included, 0 to 1024; above 1 with startTask. Default 0
    pub workerCount: i32,
    /// passed to the functions above
    pub user: *mut c_void,
    /// receives the recording of the world, see kiriWorld_Replay; null: no recording
    pub record: kiriRecordFn,
    /// ticks between state hashes in the recording; one is at its end. 0: none. Default 60
    pub recordHashTicks: i32,
}

/// Progress of a replay. Set all fields to zero before the first call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriReplay {
    /// bytes of the recording that were read; calls and ticks made, without refused ticks
    pub offset: i64,
    /// bytes of the recording that were read; calls and ticks made, without refused ticks
    pub calls: i64,
    /// bytes of the recording that were read; calls and ticks made, without refused ticks
    pub ticks: i64,
    /// bytes of the note where the replay stopped, in the recording; else null
    pub note: *const c_void,
    pub noteCount: i32,
}

/// An event. It fills the fields that its type names, and \`sheet\`. Other fields are 0, and
/// \`stage\` is -1.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriEvent {
    /// KIRI_EVENT_...
    pub type_: i32,
    pub sheet: kiriSheet,
    /// 0: none
    pub cut: kiriCut,
    /// 0: none
    pub frame: kiriFrame,
    /// 0: none
    pub pin: kiriPin,
    /// 1: the piece is a crumb, see kiriSheetDef
    pub crumb: i32,
    /// m^2, or 0
    pub area: f32,
    /// KIRI_STAGE_..., or -1
    pub stage: i32,
    /// points and ends of cuts that are pending or in work; or 0
    pub waiting: i32,
    /// 0: none
    pub seam: kiriSeam,
    /// that the seam has left, or 0
    pub stitches: i32,
}

/// Work and time of the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriProfile {
    /// of the last tick; zero without a clock
    pub seconds: [f64; 9],
    /// blade segments that took effect
    pub cutSegments: i32,
    /// Items in the units of kiriBudget. An item that takes more work counts more than once.
    pub trianglesSplit: i32,
    /// Items in the units of kiriBudget. An item that takes more work counts more than once.
    pub cellsSettled: i32,
    /// Items in the units of kiriBudget. An item that takes more work counts more than once.
    pub samplesRefreshed: i32,
    /// Items in the units of kiriBudget. An item that takes more work counts more than once.
    pub solverIterations: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: kiriCounts).
    pub cellsChanged: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: kiriCounts).
    pub weightsChanged: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: kiriCounts).
    pub verticesChanged: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: kiriCounts).
    pub pointsChanged: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: kiriCounts).
    pub linksChanged: i32,
    /// sheets in which a cut took effect; linear systems, large and small
    pub commits: i32,
    /// sheets in which a cut took effect; linear systems, large and small
    pub systemsSolved: i32,
    /// planes given to the solver: by the host, by obstacles, and between sheets
    pub contacts: i32,
    /// pairs of sheets or pieces that are near each other and not both asleep
    pub sheetPairs: i32,
    /// The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest
    /// way by a fade; m.
    pub largestJump: f64,
    /// The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest
    /// way by a fade; m.
    pub largestFade: f64,
}

/// The material of a sheet: homogeneous, isotropic.
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
    /// 1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets)
    pub airDamping: f32,
    /// s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
    pub flexDamping: f32,
    /// Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not
    /// planar
    pub yieldStress: f32,
    /// modulus beyond the yield stress, relative to youngsModulus; 0 to below 1
    pub hardening: f32,
    /// 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets)
    pub slack: f32,
    /// sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0
    pub detail: i32,
    /// 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0
    pub restCurvature: [f32; 3],
}

/// Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 %
/// (manual, accuracy).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriQuality {
    /// control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9
    pub framesAlong: i32,
    /// for the sheet def
    pub gridResolution: i32,
    /// for the sheet def
    pub iterations: i32,
    /// for kiriWorld_Tick
    pub substeps: i32,
}

/// Options of the paper, for comparison; part of the sheet def. Default 0, but for
/// integrationOrder.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPaperOptions {
    /// 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits
    pub fromScratch: i32,
    /// 1: only new frames take their motion from the surface: it jumps, momentum is not kept
    pub popping: i32,
    /// 1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS
    pub linearWeights: i32,
    /// KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four
    /// for each of frameCount. Strain around a point: of order 1, constant (default), or 2, linear:
    /// four times the work.
    pub integrationPoints: i32,
    /// KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four
    /// for each of frameCount. Strain around a point: of order 1, constant (default), or 2, linear:
    /// four times the work.
    pub integrationOrder: i32,
}

/// A sheet: its rest shape, start, material, and computation.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriSheetDef {
    pub cookie: u32,
    /// The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge;
    /// holes and several parts are allowed. Two edges in the same place with different vertices are
    /// the lips of a cut (manual, meshes). 2 floats (u, v) a vertex
    pub restPositions: *const f32,
    pub vertexCount: i32,
    /// 3 a triangle
    pub indices: *const i32,
    pub triangleCount: i32,
    /// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity,
    /// m/s.
    pub position: [f32; 3],
    /// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity,
    /// m/s.
    pub axisU: [f32; 3],
    /// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity,
    /// m/s.
    pub axisV: [f32; 3],
    /// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity,
    /// m/s.
    pub velocity: [f32; 3],
    pub material: kiriMaterial,
    /// grid squares along the longer side, 1 to 4096; default 32
    pub gridResolution: i32,
    /// m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side
    pub snapDistance: f32,
    /// m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none
    pub weldDistance: f32,
    /// Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at
    /// least; null: frameCount frames are spread evenly, in straight rows over stiff rectangles, or
    /// fewer: one for two squares of the grid. frameCount 0: regions are split, after cuts too, to
    /// frameLength; 0: it follows from \`accuracy\`, the relative error (manual, accuracy). 0, or 1
    /// and more; default 24
    pub frameCount: i32,
    /// m; used where frameCount is 0; default 0
    pub frameLength: f32,
    /// 1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default
    /// 0.02
    pub accuracy: f32,
    /// 2 floats a frame, or null
    pub framePoints: *const f32,
    /// re-sampling stops here; default 256
    pub maxFrames: i32,
    /// Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea
    /// (m^2) gets new frames beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter
    /// of a frame's area (manual, accuracy). default 0.95, 0
    pub rigidWeight: f32,
    /// Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea
    /// (m^2) gets new frames beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter
    /// of a frame's area (manual, accuracy). default 0.95, 0
    pub rigidArea: f32,
    /// m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
    pub crumbArea: f32,
    /// of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
    pub friction: f32,
    /// m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
    pub contactThickness: f32,
    /// obstacles and sheets touch if they share a set bit. Default: all
    pub groups: u32,
    /// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have
    /// it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual:
    /// contact. Default 0.
    pub touchesSheets: i32,
    /// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have
    /// it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual:
    /// contact. Default 0.
    pub selfContact: i32,
    /// for kiriSheet_SetContacts: spread evenly, at least one in every piece; default 0: none
    pub collisionPoints: i32,
    /// Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
    pub iterations: i32,
    /// m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
    pub sleepSpeed: f32,
    /// KIRI_MODEL_..., default KIRI_MODEL_LINKS
    pub model: i32,
    /// KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH
    pub skinning: i32,
    /// 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0
    pub planar: i32,
    /// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
    pub timeStepping: i32,
    /// s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2
    pub fadeTime: f32,
    /// 1: every tick computes normals (default). 0: kiriMesh has none, which saves time
    pub normals: i32,
    /// default: all off
    pub paper: kiriPaperOptions,
}

/// Sheet settings that can change after creation. Fields mean the same as in kiriSheetDef.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriSheetSettings {
    pub cookie: u32,
    pub material: kiriMaterial,
    /// re-sampling stops here; default 256
    pub maxFrames: i32,
    /// m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
    pub crumbArea: f32,
    /// of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
    pub friction: f32,
    /// m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
    pub contactThickness: f32,
    /// obstacles and sheets touch if they share a set bit. Default: all
    pub groups: u32,
    /// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have
    /// it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual:
    /// contact. Default 0.
    pub touchesSheets: i32,
    /// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have
    /// it set. selfContact 1: layers of a piece that folds stay apart. Ignored if planar. Manual:
    /// contact. Default 0.
    pub selfContact: i32,
    /// Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
    pub iterations: i32,
    /// m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
    pub sleepSpeed: f32,
    /// KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH
    pub skinning: i32,
    /// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
    pub timeStepping: i32,
    /// stays 0 with paper.popping
    pub fadeTime: f32,
    /// 1: every tick computes normals (default). 0: kiriMesh has none, which saves time
    pub normals: i32,
}

/// A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and
/// each side has its own frames. Lines may end in the material, meet and cross; cuts go through or
/// along them (manual, folding).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriFold {
    /// m
    pub from: [f32; 2],
    /// m
    pub to: [f32; 2],
    /// N m/rad per metre of the line, 0 or more; 0: a free hinge
    pub stiffness: f32,
    /// rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it
    pub restAngle: f32,
    /// N m per metre: it bends for good beyond, with a yieldStress. 0: no limit
    pub yieldMoment: f32,
}

/// A fold, its mean angle (rad, as restAngle) and the length (m) along which it joins two sides:
/// not cut, nor rigid.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriFoldState {
    pub fold: kiriFold,
    pub angle: f64,
    pub length: f64,
}

/// The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision
/// grows when indices or vertices are added or changed. Sources have the precision of the library,
/// 2^-29 of the sheet.
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
    /// 1 a vertex: the triangle of the def that contains it,
    pub sourceTriangles: *const i32,
    /// 3 a vertex: and its barycentric coordinates there
    pub sourceWeights: *const f32,
    pub vertexCount: i32,
    pub triangleCount: i32,
    pub revision: u32,
}

/// \`count\` items from \`first\` on.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriRange {
    pub first: i32,
    pub count: i32,
}

/// Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change
/// in every tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriDirty {
    /// up to the last one of the mesh
    pub newVertices: kiriRange,
    /// up to the last one of the mesh
    pub newTriangles: kiriRange,
    /// the smallest ranges that hold all older ones with other data
    pub oldVertices: kiriRange,
    /// the smallest ranges that hold all older ones with other data
    pub oldTriangles: kiriRange,
    /// for the next call
    pub revision: u32,
}

/// The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips.
/// First the vertices of kiriMesh on the side of the normal, then the same on the other side, then
/// four for each border edge.
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
    /// 1 a vertex: its vertex in kiriMesh
    pub sources: *const i32,
    pub vertexCount: i32,
    pub triangleCount: i32,
    /// rims begin at this triangle
    pub rimTriangle: i32,
}

/// Numbers of items in a sheet.
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

/// m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s
/// and kg m^2/s.
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

/// The first point where a ray meets a sheet.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriHit {
    /// m: where to cut
    pub restPoint: [f32; 2],
    /// m, world
    pub position: [f32; 3],
    /// unit
    pub normal: [f32; 3],
    /// m along the direction, which need not be a unit vector
    pub distance: f32,
    /// -1: none
    pub triangle: i32,
}

/// A point of the material on the visible surface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPointState {
    /// m, world; unit
    pub position: [f32; 3],
    /// m, world; unit
    pub normal: [f32; 3],
    /// m/s, by the weights of the point
    pub velocity: [f32; 3],
    /// the frame of its region; it also names the piece
    pub frame: kiriFrame,
}

/// A connected part of a sheet. Any of its frames names it. Indices go from 0 to kiriCounts.pieces,
/// and change when a piece comes off or goes (kiriFrame_GetPiece). Cuts with pending work have
/// separated nothing yet.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPieceState {
    /// m^2, kg
    pub area: f64,
    /// m^2, kg
    pub mass: f64,
    /// of mass, m; kg m/s, kg m^2/s about the origin
    pub center: [f64; 3],
    /// of mass, m; kg m/s, kg m^2/s about the origin
    pub momentum: [f64; 3],
    /// of mass, m; kg m/s, kg m^2/s about the origin
    pub angularMomentum: [f64; 3],
    /// m, world: the smallest box around its vertices
    pub lower: [f32; 3],
    /// m, world: the smallest box around its vertices
    pub upper: [f32; 3],
    /// counts
    pub frames: i32,
    /// counts
    pub vertices: i32,
    /// counts
    pub triangles: i32,
    /// counts
    pub collisionPoints: i32,
    /// 1: see kiriSheetDef
    pub crumb: i32,
    /// 1: see sleepSpeed
    pub asleep: i32,
}

/// The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all
/// pieces, piece by piece.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPieceMesh {
    /// 1 a vertex: its index in kiriMesh
    pub vertices: *const i32,
    /// 1 a triangle: its index in kiriMesh
    pub triangles: *const i32,
    /// 3 a triangle, as in kiriMesh: draw them
    pub indices: *const i32,
    /// 1 a point, see kiriSheet_GetCollisionPoints
    pub collisionPoints: *const i32,
    pub vertexCount: i32,
    pub triangleCount: i32,
    pub collisionPointCount: i32,
}

/// How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or
/// a sharp notch, goes on across the tension where the sheet would set more energy free than the
/// tear takes. Two frames go with its tip. Where a mean tension over a distance of frames exceeds
/// the strength, a tear begins at the nearest border, one at a time.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriTearing {
    /// J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear
    pub toughness: f32,
    /// Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored
    pub strength: f32,
    /// direction in the rest plane along which it tears; 0, 0: none
    pub grain: [f32; 2],
    /// toughness across the grain, relative to along it; below 1: 1
    pub grainRatio: f32,
    /// m/s in the rest plane, 0 or more; 0: no limit but the distance above
    pub maxSpeed: f32,
    /// tips that tear in a tick, 0 or more; 0: 8. Others wait
    pub maxTips: i32,
}

/// Pose, motion and region of a frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriFrameState {
    /// m
    pub restPoint: [f32; 2],
    /// m, world: of the rest point
    pub position: [f32; 3],
    /// columns: direction of u, of v, normal; an affine frame: columns of A, which stretch
    pub rotation: [f32; 9],
    /// m/s, rad/s
    pub velocity: [f32; 3],
    /// m/s, rad/s
    pub angularVelocity: [f32; 3],
    /// m^2 of its region; kg
    pub area: f32,
    /// m^2 of its region; kg
    pub mass: f32,
    /// 1: moved by the host, see kiriFrame_Hold
    pub held: i32,
}

/// Air past the sheet. v is the velocity of the air less the material's, n the normal: each square
/// metre gets density / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)); airDamping acts in any
/// density. A sheet can sleep in wind.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriWind {
    /// m/s
    pub velocity: [f32; 3],
    /// kg/m^3, 0 or more; air: 1.2
    pub density: f32,
    /// 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
    pub drag: f32,
    /// 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
    pub lift: f32,
}

/// A pin holds a point of the material at its target by a spring.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPinDef {
    pub cookie: u32,
    /// m, in the material
    pub restPoint: [f32; 2],
    /// m, world
    pub target: [f32; 3],
    /// N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target
    /// (manual)
    pub stiffness: f32,
    /// N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never
    pub breakForce: f32,
    /// 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there
    pub obstacle: kiriObstacle,
}

/// Type and target of a pin.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriPinState {
    /// KIRI_PIN_...
    pub type_: i32,
    pub sheet: kiriSheet,
    /// m, rest plane: the ends of the line, or the point twice
    pub from: [f32; 2],
    /// m, rest plane: the ends of the line, or the point twice
    pub to: [f32; 2],
    /// m, world
    pub target: [f32; 3],
    /// of a line; of a point the identity
    pub rotation: [f32; 9],
    /// N, or 0
    pub breakForce: f32,
    /// that the target moves with; 0: none
    pub obstacle: kiriObstacle,
}

/// A seam joins two lines in the material, of two sheets or of one: stitches join points at the
/// same parts of both. Cuts go through a seam, and pieces keep their stitches. A stitch ends with
/// the piece of a point (manual, sewing).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriSeamDef {
    pub cookie: u32,
    /// of the same model, and not planar
    pub sheetA: kiriSheet,
    /// of the same model, and not planar
    pub sheetB: kiriSheet,
    /// 2 floats a point, m, in the material, such as its edge; copied
    pub lineA: *const f32,
    /// 2 floats a point
    pub lineB: *const f32,
    /// points: 2 to 65536
    pub countA: i32,
    /// points: 2 to 65536
    pub countB: i32,
    /// 2 to 4096; 0 (default): three for two distances of frames
    pub stitches: i32,
    /// N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free
    pub stiffness: f32,
    /// rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal
    pub restAngle: f32,
    /// N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never
    pub breakForce: f32,
}

/// A stitch, as after the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriStitch {
    pub sheetA: kiriSheet,
    pub sheetB: kiriSheet,
    /// m, in the material
    pub restA: [f32; 2],
    /// m, in the material
    pub restB: [f32; 2],
    /// m, world: where both drawn lips meet; their middle while they are apart
    pub position: [f32; 3],
    /// m: distance of the two points; a stitch yields by micrometres under the sheet's weight
    pub gap: f32,
    /// N, on sheet A: mean over the last tick that moved it
    pub force: [f32; 3],
    /// rad, as restAngle
    pub angle: f32,
}

/// A contact of a point of the material: the plane dot(normal, x) = offset keeps the point on its
/// upper side, with Coulomb friction. The host computes planes from the visible surface for each
/// tick. Planes out of reach do nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriContact {
    /// index of the collision point; -1: restPoint names the point
    pub point: i32,
    /// m, in the material; read only where point is -1
    pub restPoint: [f32; 2],
    /// unit, out of the obstacle
    pub normal: [f32; 3],
    /// m: of the obstacle's surface at the start of the tick
    pub offset: f32,
    /// m/s: of the obstacle at the contact. The plane moves with it within the tick
    pub velocity: [f32; 3],
    /// 0 or more: of both sides together
    pub friction: f32,
    /// 1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid
    pub inverseMass: f32,
    /// m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s
    pub pushSpeed: f32,
    /// a number of the host. Contacts with one number press on one obstacle, and share its mass
    pub obstacle: i32,
}

/// The result of a contact in the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriContactForce {
    /// N s, on the sheet: the sum over the tick. The obstacle gets the opposite
    pub impulse: [f64; 3],
    /// m, world: the point of the sheet at the end of the tick
    pub position: [f64; 3],
    /// m: of the point below the plane at the end of the tick; below 0: above it
    pub depth: f64,
    /// as in the contact
    pub point: i32,
    /// as in the contact
    pub obstacle: i32,
}

/// An obstacle: its shape, pose, motion, and mass.
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
    /// 2 floats a corner, m, counter-clockwise; copied. Null: no prism
    pub outline: *const f32,
    /// 3 to 64
    pub outlineCount: i32,
    /// m, 0 or more: prisms and boxes grow by this, with round edges. Default 0
    pub rounding: f32,
    /// m, world
    pub position: [f32; 3],
    /// columns; default: the axes of the world
    pub rotation: [f32; 9],
    /// m/s, of its position
    pub velocity: [f32; 3],
    /// rad/s
    pub angularVelocity: [f32; 3],
    /// m/s, world: of its surface, added to its motion, as of a conveyor
    pub surfaceVelocity: [f32; 3],
    /// 0 or more; default 0.5
    pub friction: f32,
    /// kg; 0 (default): nothing moves it
    pub mass: f32,
    /// kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz.
    /// Positive definite, but for axes whose numbers are all 0: it does not turn about these
    pub inertia: [f32; 6],
    /// m, from its position in its own axes
    pub centerOfMass: [f32; 3],
    /// obstacles with the same number, except 0, are parts of one body; each has its whole mass
    pub body: u32,
    /// m/s, above 0: maximum speed at which points inside are pushed out. Default 1
    pub pushSpeed: f32,
    /// see the sheet def. Default: all
    pub groups: u32,
}

/// Pose, motion, and reaction of an obstacle.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriObstacleState {
    pub position: [f32; 3],
    pub rotation: [f32; 9],
    pub velocity: [f32; 3],
    pub angularVelocity: [f32; 3],
    /// N s, N m s about its centre of mass: of sheets and pins in the last tick
    pub impulse: [f64; 3],
    /// N s, N m s about its centre of mass: of sheets and pins in the last tick
    pub angularImpulse: [f64; 3],
    /// that pushed in the last tick
    pub contacts: i32,
}

/// A corner to draw, in a layout for a GPU.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriDrawVertex {
    /// m, world
    pub position: [f32; 3],
    /// red in its lowest byte, then green, blue, and opacity, which is 255
    pub color: u32,
}

/// Flags, filter and functions of debug draw.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct kiriDebugDraw {
    pub cookie: u32,
    /// KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES
    pub flags: u32,
    /// draws only this one, without obstacles and blades; 0 (default): all
    pub sheet: kiriSheet,
    /// m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05
    pub size: f32,
    /// null: these are not drawn
    pub points: kiriDrawFn,
    /// the same
    pub lines: kiriDrawFn,
    /// the same
    pub triangles: kiriDrawFn,
    /// passed to these functions
    pub user: *mut c_void,
}

unsafe extern "C" {
    /// Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a
    /// line with its meaning.
    pub fn kiriGetVersion() -> i32;
    /// Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a
    /// line with its meaning.
    pub fn kiriGetResultName(result: kiriResult) -> *const c_char;
    /// Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a
    /// line with its meaning.
    pub fn kiriGetResultText(result: kiriResult) -> *const c_char;
    /// Fill the def; create an empty world (def null: the defaults; on failure \*world is null, and
    /// the log gets the line); free it (null: nothing). KIRI_ERROR_BUILD: the compiler, or a mode
    /// of this thread, changes float operations (manual, budget).
    pub fn kiriDefaultWorldDef(def: *mut kiriWorldDef);
    /// Fill the def; create an empty world (def null: the defaults; on failure \*world is null, and
    /// the log gets the line); free it (null: nothing). KIRI_ERROR_BUILD: the compiler, or a mode
    /// of this thread, changes float operations (manual, budget).
    pub fn kiriCreateWorld(def: *const kiriWorldDef, world: *mut *mut kiriWorld) -> kiriResult;
    /// Fill the def; create an empty world (def null: the defaults; on failure \*world is null, and
    /// the log gets the line); free it (null: nothing). KIRI_ERROR_BUILD: the compiler, or a mode
    /// of this thread, changes float operations (manual, budget).
    pub fn kiriDestroyWorld(world: *mut kiriWorld);
    /// Advances by one fixed step of dt seconds (1e-6 to 10), in \`substeps\` equal parts (1 to
    /// 64): takes the pending cut points, then moves every sheet. KIRI_PENDING: the budget is
    /// spent; events name the cuts that still have work. KIRI_ERROR_MEMORY: cuts and pieces that
    /// leave go on in the next tick (manual, budget). KIRI_ERROR_LIMIT: no ids are left for new
    /// frames; nothing moves until some are destroyed. KIRI_DIVERGED: events name sheets that were
    /// stopped.
    pub fn kiriWorld_Tick(world: *mut kiriWorld, dt: f32, substeps: i32) -> kiriResult;
    /// Returns the line of the last function that changes the world, if it failed; else "". Valid
    /// until the next one.
    pub fn kiriWorld_GetLastError(world: *const kiriWorld) -> *const c_char;
    /// Moves the origin of the world to a point (m), as large worlds need: subtracts it from all
    /// positions. Nothing wakes. Returned arrays keep the old positions until the next tick.
    /// KIRI_ERROR_ARGUMENT: a position would not fit a float.
    pub fn kiriWorld_ShiftOrigin(world: *mut kiriWorld, origin: *const f32) -> kiriResult;
    /// Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
    pub fn kiriWorld_SetGravity(world: *mut kiriWorld, gravity: *const f32) -> kiriResult;
    /// Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
    pub fn kiriWorld_SetBudget(world: *mut kiriWorld, budget: *const kiriBudget) -> kiriResult;
    /// Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike
    /// (manual, budget).
    pub fn kiriWorld_GetStateHash(world: *const kiriWorld, hash: *mut u64) -> kiriResult;
    /// Writes up to \`capacity\` ids of the world's sheets, in the order of their making; \*count
    /// is how many there are.
    pub fn kiriWorld_GetSheets(world: *const kiriWorld, sheets: *mut kiriSheet, capacity: i32, count: *mut i32) -> kiriResult;
    /// Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A
    /// replay stops there.
    pub fn kiriWorld_Note(world: *mut kiriWorld, bytes: *const c_void, count: i32) -> kiriResult;
    /// Makes the calls of a recording up to the next tick or note, included. The world must be new;
    /// hooks stay the host's. KIRI_PENDING: more calls follow. KIRI_OK: the recording ended.
    /// KIRI_ERROR_REPLAY: a call gave another result, other ids or another state; the line names
    /// it, and the next call goes on behind it. KIRI_ERROR_DATA: not a recording, damaged, cut
    /// short, or of another version. KIRI_ERROR_STATE: the world is not new. KIRI_ERROR_MEMORY:
    /// start again.
    pub fn kiriWorld_Replay(world: *mut kiriWorld, recording: *const c_void, size: i64, replay: *mut kiriReplay) -> kiriResult;
    /// Writes the world to memory with room for \`capacity\`; bytes null: only counts them. \*size:
    /// bytes of the save. KIRI_ERROR_ARGUMENT: \`capacity\` is less. KIRI_PENDING: a cut is pending
    /// (kiriWorld_FinishCuts); \*size is 0.
    pub fn kiriWorld_Save(world: *const kiriWorld, bytes: *mut c_void, capacity: i64, size: *mut i64) -> kiriResult;
    /// Finishes the work on cuts at once, whatever the budget is, without moving anything. The next
    /// tick reports the events. Arrays that the world handed out end as with a tick.
    /// KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in kiriWorld_Tick.
    pub fn kiriWorld_FinishCuts(world: *mut kiriWorld) -> kiriResult;
    /// Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a
    /// malicious save cannot crash the program, and takes memory in proportion to its size, which
    /// is below 2^31. Old arrays live until the next tick. On failure nothing has changed:
    /// KIRI_ERROR_DATA: not a save, damaged, or of another version. KIRI_ERROR_MEMORY.
    pub fn kiriWorld_Load(world: *mut kiriWorld, bytes: *const c_void, size: i64) -> kiriResult;
    /// For rollback: copies all of the world, also work in progress, into memory of the host; much
    /// faster than a save, and exact to the bit. For this process only: never store or send the
    /// bytes. bytes null: as of kiriWorld_Save.
    pub fn kiriWorld_Snapshot(world: *const kiriWorld, bytes: *mut c_void, capacity: i64, size: *mut i64) -> kiriResult;
    /// Replaces the world by the world of the snapshot, as kiriWorld_Load does. The bytes are
    /// trusted. On failure nothing has changed: KIRI_ERROR_DATA: no snapshot of this build.
    /// KIRI_ERROR_STATE: it is recorded. KIRI_ERROR_MEMORY.
    pub fn kiriWorld_Restore(world: *mut kiriWorld, bytes: *const c_void, size: i64) -> kiriResult;
    /// Gets the events: \*events points to \*count of them.
    pub fn kiriWorld_GetEvents(world: *const kiriWorld, events: *mut *const kiriEvent, count: *mut i32) -> kiriResult;
    /// Gets the profile of the last tick that was not refused.
    pub fn kiriWorld_GetProfile(world: *const kiriWorld, profile: *mut kiriProfile) -> kiriResult;
    /// Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum
    /// of several: half for cuts, half for motion; all if it has one alone. Limits without recorded
    /// work stay. A replay must set the same budgets.
    pub fn kiriFitBudget(profile: *const kiriProfile, microseconds: f32, budget: *mut kiriBudget) -> kiriResult;
    /// Returns the name of a stage; "" for another number.
    pub fn kiriGetStageName(stage: i32) -> *const c_char;
    /// Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
    pub fn kiriGetMaterial(preset: i32, material: *mut kiriMaterial) -> kiriResult;
    /// Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
    pub fn kiriGetQuality(preset: i32, quality: *mut kiriQuality) -> kiriResult;
    /// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts,
    /// frames and pins. On failure \*sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the
    /// line names them by index in the def.
    pub fn kiriDefaultSheetDef(def: *mut kiriSheetDef);
    /// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts,
    /// frames and pins. On failure \*sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the
    /// line names them by index in the def.
    pub fn kiriCreateSheet(world: *mut kiriWorld, def: *const kiriSheetDef, sheet: *mut kiriSheet) -> kiriResult;
    /// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts,
    /// frames and pins. On failure \*sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the
    /// line names them by index in the def.
    pub fn kiriDestroySheet(world: *mut kiriWorld, sheet: kiriSheet) -> kiriResult;
    /// Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations
    /// for a kind of sheet and its sides (m, 1 : 256 at most). Other fields are as
    /// kiriDefaultSheetDef has them (manual, accuracy).
    pub fn kiriGetSetup(preset: i32, width: f32, height: f32, def: *mut kiriSheetDef) -> kiriResult;
    /// Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 \* columns \* rows
    /// triangles; columns or rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096.
    /// The mesh of def is not read; def null: the defaults.
    pub fn kiriCreateRectangle(world: *mut kiriWorld, width: f32, height: f32, columns: i32, rows: i32, def: *const kiriSheetDef, sheet: *mut kiriSheet) -> kiriResult;
    /// Get the current settings, and set all or none, with the checks of kiriCreateSheet.
    /// KIRI_ERROR_DEF: they do not come from kiriSheet_GetSettings. It wakes if one differs.
    /// Motion, stiffness of pins and frames stay.
    pub fn kiriSheet_GetSettings(world: *const kiriWorld, sheet: kiriSheet, settings: *mut kiriSheetSettings) -> kiriResult;
    /// Get the current settings, and set all or none, with the checks of kiriCreateSheet.
    /// KIRI_ERROR_DEF: they do not come from kiriSheet_GetSettings. It wakes if one differs.
    /// Motion, stiffness of pins and frames stay.
    pub fn kiriSheet_SetSettings(world: *mut kiriWorld, sheet: kiriSheet, settings: *const kiriSheetSettings) -> kiriResult;
    /// Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not
    /// KIRI_MODEL_LINKS, or no material at one.
    pub fn kiriCreateFoldedSheet(world: *mut kiriWorld, def: *const kiriSheetDef, folds: *const kiriFold, count: i32, sheet: *mut kiriSheet) -> kiriResult;
    /// Adds a fold; its index is the count of folds before. The next ticks make it, on the budget
    /// of cuts, until a KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors
    /// as of kiriCreateFoldedSheet.
    pub fn kiriSheet_AddFold(world: *mut kiriWorld, sheet: kiriSheet, fold: *const kiriFold, index: *mut i32) -> kiriResult;
    /// A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps.
    /// Changes wake the sheet.
    pub fn kiriSheet_GetFold(world: *const kiriWorld, sheet: kiriSheet, index: i32, state: *mut kiriFoldState) -> kiriResult;
    /// A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps.
    /// Changes wake the sheet.
    pub fn kiriSheet_SetFold(world: *mut kiriWorld, sheet: kiriSheet, index: i32, stiffness: f32, restAngle: f32) -> kiriResult;
    /// Fills in the mesh of kiriCreateRectangle: 2 (columns + 1) (rows + 1) floats and 6 columns
    /// rows indices.
    pub fn kiriFillRectangle(width: f32, height: f32, columns: i32, rows: i32, restPositions: *mut f32, indices: *mut i32) -> kiriResult;
    /// Gets the arrays, without a copy.
    pub fn kiriSheet_GetMesh(world: *const kiriWorld, sheet: kiriSheet, mesh: *mut kiriMesh) -> kiriResult;
    /// Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load
    /// or restore.
    pub fn kiriSheet_GetDirty(world: *const kiriWorld, sheet: kiriSheet, sinceRevision: u32, dirty: *mut kiriDirty) -> kiriResult;
    /// Copies 3 floats each; positions or normals null: none. Strides: 12 bytes or more.
    /// KIRI_ERROR_STATE: no normals.
    pub fn kiriSheet_CopyVertices(world: *const kiriWorld, sheet: kiriSheet, first: i32, count: i32, positions: *mut c_void, positionStride: i32, normals: *mut c_void, normalStride: i32) -> kiriResult;
    /// Copies the index that each vertex had when the last tick began, to draw between two ticks;
    /// -1: it did not exist. \*from: the sheet that had them then. A vertex that a cut separated
    /// has the other's index (manual, drawing).
    pub fn kiriSheet_CopyPrevious(world: *const kiriWorld, sheet: kiriSheet, first: i32, count: i32, vertices: *mut i32, from: *mut kiriSheet) -> kiriResult;
    /// Copies indices of some triangles as 16-bit numbers, 3 each. KIRI_ERROR_STATE: there are more
    /// than 65535 vertices.
    pub fn kiriSheet_CopyIndices16(world: *const kiriWorld, sheet: kiriSheet, firstTriangle: i32, count: i32, indices: *mut u16) -> kiriResult;
    /// Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was
    /// removed. Weights: 9 floats each, the barycentric coordinates of its three corners there,
    /// also beside a welded seam (manual, meshes).
    pub fn kiriSheet_CopySources(world: *const kiriWorld, sheet: kiriSheet, firstTriangle: i32, count: i32, sources: *mut i32) -> kiriResult;
    /// Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was
    /// removed. Weights: 9 floats each, the barycentric coordinates of its three corners there,
    /// also beside a welded seam (manual, meshes).
    pub fn kiriSheet_CopySourceWeights(world: *const kiriWorld, sheet: kiriSheet, firstTriangle: i32, count: i32, weights: *mut f32) -> kiriResult;
    /// Makes the solid surface, with a thickness in m; thickness 0: the material's.
    pub fn kiriSheet_GetSolid(world: *mut kiriWorld, sheet: kiriSheet, thickness: f32, solid: *mut kiriSolid) -> kiriResult;
    /// Gets the collision points: 3 floats of position (m, world) a point.
    pub fn kiriSheet_GetCollisionPoints(world: *const kiriWorld, sheet: kiriSheet, positions: *mut *const f32, count: *mut i32) -> kiriResult;
    /// Get the counts, at no cost; sum the totals over the frames.
    pub fn kiriSheet_GetCounts(world: *const kiriWorld, sheet: kiriSheet, counts: *mut kiriCounts) -> kiriResult;
    /// Get the counts, at no cost; sum the totals over the frames.
    pub fn kiriSheet_GetTotals(world: *const kiriWorld, sheet: kiriSheet, totals: *mut kiriTotals) -> kiriResult;
    /// Estimates the error of a sheet that rests; 1: too few frames. It allocates.
    /// KIRI_ERROR_STATE: not KIRI_MODEL_LINKS.
    pub fn kiriSheet_EstimateError(world: *const kiriWorld, sheet: kiriSheet, relative: *mut f64) -> kiriResult;
    /// Read and end sleep: \*awake is 0 where all pieces sleep (kiriPieceState tells which);
    /// kiriSheet_Wake wakes all.
    pub fn kiriSheet_IsAwake(world: *const kiriWorld, sheet: kiriSheet, awake: *mut i32) -> kiriResult;
    /// Read and end sleep: \*awake is 0 where all pieces sleep (kiriPieceState tells which);
    /// kiriSheet_Wake wakes all.
    pub fn kiriSheet_Wake(world: *mut kiriWorld, sheet: kiriSheet) -> kiriResult;
    /// Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it
    /// wakes. A planar sheet turns about its normal only. Targets of pins and holds move along, but
    /// for pins on obstacles (manual, sheets).
    pub fn kiriSheet_Transform(world: *mut kiriWorld, sheet: kiriSheet, rotation: *const f32, translation: *const f32) -> kiriResult;
    /// Set rigid motion of a sheet, or of the piece with a frame, until forces change it:
    /// \`velocity\` (m/s) of its centre of mass, and \`angularVelocity\` (rad/s) about it. Planar
    /// sheets drop motion across their plane; held frames stay held.
    pub fn kiriSheet_SetVelocity(world: *mut kiriWorld, sheet: kiriSheet, velocity: *const f32, angularVelocity: *const f32) -> kiriResult;
    /// Set rigid motion of a sheet, or of the piece with a frame, until forces change it:
    /// \`velocity\` (m/s) of its centre of mass, and \`angularVelocity\` (rad/s) about it. Planar
    /// sheets drop motion across their plane; held frames stay held.
    pub fn kiriFrame_SetPieceVelocity(world: *mut kiriWorld, frame: kiriFrame, velocity: *const f32, angularVelocity: *const f32) -> kiriResult;
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn kiriSheet_SetUserData(world: *mut kiriWorld, sheet: kiriSheet, data: u64) -> kiriResult;
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn kiriSheet_GetUserData(world: *const kiriWorld, sheet: kiriSheet, data: *mut u64) -> kiriResult;
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn kiriPin_SetUserData(world: *mut kiriWorld, pin: kiriPin, data: u64) -> kiriResult;
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn kiriPin_GetUserData(world: *const kiriWorld, pin: kiriPin, data: *mut u64) -> kiriResult;
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn kiriFrame_SetPieceUserData(world: *mut kiriWorld, frame: kiriFrame, data: u64) -> kiriResult;
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn kiriFrame_GetPieceUserData(world: *const kiriWorld, frame: kiriFrame, data: *mut u64) -> kiriResult;
    /// Find where a ray first meets the sheet, or any (\*sheet 0: none), up to maxDistance;
    /// hit-\>triangle -1: it does not.
    pub fn kiriSheet_Raycast(world: *const kiriWorld, sheet: kiriSheet, origin: *const f32, direction: *const f32, maxDistance: f32, hit: *mut kiriHit) -> kiriResult;
    /// Find where a ray first meets the sheet, or any (\*sheet 0: none), up to maxDistance;
    /// hit-\>triangle -1: it does not.
    pub fn kiriWorld_Raycast(world: *const kiriWorld, origin: *const f32, direction: *const f32, maxDistance: f32, sheet: *mut kiriSheet, hit: *mut kiriHit) -> kiriResult;
    /// Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip
    /// that has the point.
    pub fn kiriSheet_GetPoint(world: *const kiriWorld, sheet: kiriSheet, restPoint: *const f32, state: *mut kiriPointState) -> kiriResult;
    /// Gets the shape functions at a rest point: up to \`capacity\` frames with weights, sum 1, and
    /// gradients (2 floats, 1/m; gradients null: none). \*count: all. KIRI_ERROR_ARGUMENT: outside
    /// the sheet. KIRI_ERROR_STATE: a cut is pending.
    pub fn kiriSheet_GetWeights(world: *const kiriWorld, sheet: kiriSheet, restPoint: *const f32, frames: *mut kiriFrame, weights: *mut f32, gradients: *mut f32, capacity: i32, count: *mut i32) -> kiriResult;
    /// Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no
    /// piece has the index.
    pub fn kiriSheet_GetPiece(world: *mut kiriWorld, sheet: kiriSheet, piece: i32, state: *mut kiriPieceState) -> kiriResult;
    /// Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no
    /// piece has the index.
    pub fn kiriSheet_GetPieceMesh(world: *mut kiriWorld, sheet: kiriSheet, piece: i32, mesh: *mut kiriPieceMesh) -> kiriResult;
    /// Get the frames of a piece (\*frames points to \*count ids), and the current index of the
    /// piece with a frame.
    pub fn kiriSheet_GetPieceFrames(world: *mut kiriWorld, sheet: kiriSheet, piece: i32, frames: *mut *const kiriFrame, count: *mut i32) -> kiriResult;
    /// Get the frames of a piece (\*frames points to \*count ids), and the current index of the
    /// piece with a frame.
    pub fn kiriFrame_GetPiece(world: *const kiriWorld, frame: kiriFrame, piece: *mut i32) -> kiriResult;
    /// Makes a sheet of the piece with this frame. All of the piece moves along, with ids and
    /// states; cuts stay with the old sheet. A clamp or hinge that holds both gets a copy with a
    /// new id. KIRI_PENDING: work on a cut is pending, or the budget lacks samples for the piece;
    /// \*detached is 0, further cuts of the sheet wait, and KIRI_EVENT_PIECE_DETACHED names the
    /// sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the sheet (manual,
    /// cutting).
    pub fn kiriFrame_DetachPiece(world: *mut kiriWorld, frame: kiriFrame, detached: *mut kiriSheet) -> kiriResult;
    /// Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is
    /// pending its triangles stay with three equal corners, and kiriCounts counts it, with a state
    /// of zeros. KIRI_ERROR_STATE: it is all of its sheet.
    pub fn kiriFrame_DestroyPiece(world: *mut kiriWorld, frame: kiriFrame) -> kiriResult;
    /// Detach or remove the pieces of \`count\` frames, of any sheets, in one pass for each sheet:
    /// all or none. KIRI_PENDING: some are pending, all in a sheet together. detached\[i\]: the
    /// sheet made of piece of frames\[i\], 0: pending.
    pub fn kiriWorld_DetachPieces(world: *mut kiriWorld, frames: *const kiriFrame, count: i32, detached: *mut kiriSheet) -> kiriResult;
    /// Detach or remove the pieces of \`count\` frames, of any sheets, in one pass for each sheet:
    /// all or none. KIRI_PENDING: some are pending, all in a sheet together. detached\[i\]: the
    /// sheet made of piece of frames\[i\], 0: pending.
    pub fn kiriWorld_DestroyPieces(world: *mut kiriWorld, frames: *const kiriFrame, count: i32) -> kiriResult;
    /// Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one.
    /// \*count: their number.
    pub fn kiriSheet_DropCrumbs(world: *mut kiriWorld, sheet: kiriSheet, area: f32, count: *mut i32) -> kiriResult;
    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point (KIRI_EVENT_CUT_FINISHED).
    pub fn kiriBeginCut(world: *mut kiriWorld, sheet: kiriSheet, restPoint: *const f32, cut: *mut kiriCut) -> kiriResult;
    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point (KIRI_EVENT_CUT_FINISHED).
    pub fn kiriCut_Extend(world: *mut kiriWorld, cut: kiriCut, restPoints: *const f32, count: i32) -> kiriResult;
    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point (KIRI_EVENT_CUT_FINISHED).
    pub fn kiriCut_End(world: *mut kiriWorld, cut: kiriCut) -> kiriResult;
    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point (KIRI_EVENT_CUT_FINISHED).
    pub fn kiriSheet_Cut(world: *mut kiriWorld, sheet: kiriSheet, restPoints: *const f32, count: i32, cut: *mut kiriCut) -> kiriResult;
    /// Cuts where the quadrilateral swept by an edge in world space, from blade\[0\]-blade\[1\] to
    /// blade\[3\]-blade\[2\], meets the current sheet; past borders, so that it separates the parts
    /// that it crosses. The cut is already ended.
    pub fn kiriSheet_Slice(world: *mut kiriWorld, sheet: kiriSheet, blade: *const f32, cut: *mut kiriCut) -> kiriResult;
    /// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set
    /// them: parts of the sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model
    /// other than KIRI_MODEL_LINKS, another preset.
    pub fn kiriGetTearing(preset: i32, tearing: *mut kiriTearing) -> kiriResult;
    /// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set
    /// them: parts of the sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model
    /// other than KIRI_MODEL_LINKS, another preset.
    pub fn kiriSheet_SetTearing(world: *mut kiriWorld, sheet: kiriSheet, tearing: *const kiriTearing) -> kiriResult;
    /// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set
    /// them: parts of the sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model
    /// other than KIRI_MODEL_LINKS, another preset.
    pub fn kiriSheet_GetTearing(world: *const kiriWorld, sheet: kiriSheet, tearing: *mut kiriTearing) -> kiriResult;
    /// Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point:
    /// there) by a factor, 0 or more: below 1 tears follow it, above 1 they stop there. The same
    /// points replace it. KIRI_ERROR_ARGUMENT: no material.
    pub fn kiriSheet_SetTearLine(world: *mut kiriWorld, sheet: kiriSheet, restPoints: *const f32, count: i32, factor: f32) -> kiriResult;
    /// A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material
    /// of each layer, and cuts on from there. Move it once a tick while it is in a sheet. Each
    /// layer has a cut (manual, cutting). \`sheet\` 0: all.
    pub fn kiriBeginBlade(world: *mut kiriWorld, sheet: kiriSheet, blade: *mut kiriBlade) -> kiriResult;
    /// Move the blade to the straight edge between two points (m, world), or \`length\` m along a
    /// ray that a camera casts; each end goes straight. The first call only places it. An end
    /// inside cuts along its own way. End it: cuts stay.
    pub fn kiriBlade_MoveEdge(world: *mut kiriWorld, blade: kiriBlade, from: *const f32, to: *const f32) -> kiriResult;
    /// Move the blade to the straight edge between two points (m, world), or \`length\` m along a
    /// ray that a camera casts; each end goes straight. The first call only places it. An end
    /// inside cuts along its own way. End it: cuts stay.
    pub fn kiriBlade_MoveRay(world: *mut kiriWorld, blade: kiriBlade, origin: *const f32, direction: *const f32, length: f32) -> kiriResult;
    /// Move the blade to the straight edge between two points (m, world), or \`length\` m along a
    /// ray that a camera casts; each end goes straight. The first call only places it. An end
    /// inside cuts along its own way. End it: cuts stay.
    pub fn kiriBlade_End(world: *mut kiriWorld, blade: kiriBlade) -> kiriResult;
    /// Writes up to \`capacity\` ids of the sheet's frames; \*count is how many there are.
    pub fn kiriSheet_GetFrames(world: *const kiriWorld, sheet: kiriSheet, frames: *mut kiriFrame, capacity: i32, count: *mut i32) -> kiriResult;
    /// Holds the frame: its rest point moves evenly to \`position\` (m, world) with \`rotation\`
    /// (columns as above) in the next tick; position and rotation null: frees it. Material that
    /// held frames mostly carry moves through obstacles.
    pub fn kiriFrame_Hold(world: *mut kiriWorld, frame: kiriFrame, position: *const f32, rotation: *const f32) -> kiriResult;
    /// Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied
    /// to the sheet: means over the last tick that moved the piece, with the frame's own weight and
    /// change of momentum. Zero for a free frame.
    pub fn kiriFrame_GetState(world: *const kiriWorld, frame: kiriFrame, state: *mut kiriFrameState) -> kiriResult;
    /// Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied
    /// to the sheet: means over the last tick that moved the piece, with the frame's own weight and
    /// change of momentum. Zero for a free frame.
    pub fn kiriFrame_GetReaction(world: *const kiriWorld, frame: kiriFrame, force: *mut f64, torque: *mut f64) -> kiriResult;
    /// Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a
    /// torque (N m).
    pub fn kiriFrame_ApplyForce(world: *mut kiriWorld, frame: kiriFrame, force: *const f32, torque: *const f32) -> kiriResult;
    /// Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a
    /// torque (N m).
    pub fn kiriSheet_ApplyForce(world: *mut kiriWorld, sheet: kiriSheet, restPoint: *const f32, force: *const f32, torque: *const f32) -> kiriResult;
    /// Applies a force (N/m, world) along a straight line of the rest plane where it lies in the
    /// material, edges included. Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of
    /// kiriSheet_ClampLine.
    pub fn kiriSheet_ApplyLineLoad(world: *mut kiriWorld, sheet: kiriSheet, from: *const f32, to: *const f32, forcePerLength: *const f32) -> kiriResult;
    /// Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it.
    pub fn kiriSheet_ApplyPressure(world: *mut kiriWorld, sheet: kiriSheet, pressure: f32) -> kiriResult;
    /// Applies an impulse (N s, world) at a point of the material on the visible surface, at once,
    /// by the mass of the frames that carry the point; a held frame's share is lost.
    /// KIRI_ERROR_ARGUMENT: the point is outside the sheet.
    pub fn kiriSheet_ApplyImpulse(world: *mut kiriWorld, sheet: kiriSheet, restPoint: *const f32, impulse: *const f32) -> kiriResult;
    /// Copies the wind; it blows until the next call.
    pub fn kiriSheet_SetWind(world: *mut kiriWorld, sheet: kiriSheet, wind: *const kiriWind) -> kiriResult;
    /// Fill the def with its defaults; pin a point; destroy any pin. On failure \*pin is 0.
    /// KIRI_ERROR_ARGUMENT: outside.
    pub fn kiriDefaultPinDef(def: *mut kiriPinDef);
    /// Fill the def with its defaults; pin a point; destroy any pin. On failure \*pin is 0.
    /// KIRI_ERROR_ARGUMENT: outside.
    pub fn kiriCreatePin(world: *mut kiriWorld, sheet: kiriSheet, def: *const kiriPinDef, pin: *mut kiriPin) -> kiriResult;
    /// Fill the def with its defaults; pin a point; destroy any pin. On failure \*pin is 0.
    /// KIRI_ERROR_ARGUMENT: outside.
    pub fn kiriDestroyPin(world: *mut kiriWorld, pin: kiriPin) -> kiriResult;
    /// Hold a straight line of the rest plane, at its rest length. A clamp holds the place and
    /// direction of its material, as a vice does; a hinge only the place (manual, sheets).
    /// KIRI_ERROR_ARGUMENT: no material; ends equal, or far outside.
    pub fn kiriSheet_ClampLine(world: *mut kiriWorld, sheet: kiriSheet, from: *const f32, to: *const f32, clamp: *mut kiriPin) -> kiriResult;
    /// Hold a straight line of the rest plane, at its rest length. A clamp holds the place and
    /// direction of its material, as a vice does; a hinge only the place (manual, sheets).
    /// KIRI_ERROR_ARGUMENT: no material; ends equal, or far outside.
    pub fn kiriSheet_HingeLine(world: *mut kiriWorld, sheet: kiriSheet, from: *const f32, to: *const f32, hinge: *mut kiriPin) -> kiriResult;
    /// Set the target of the pin's point, or of the middle of its line (m, world), and the rotation
    /// of a line's material (columns: directions of u, v, normal; planar: about the normal), for
    /// the end of the next tick and later. The pin moves there evenly. It is drawn at its pin
    /// (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
    pub fn kiriPin_SetTarget(world: *mut kiriWorld, pin: kiriPin, target: *const f32) -> kiriResult;
    /// Set the target of the pin's point, or of the middle of its line (m, world), and the rotation
    /// of a line's material (columns: directions of u, v, normal; planar: about the normal), for
    /// the end of the next tick and later. The pin moves there evenly. It is drawn at its pin
    /// (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
    pub fn kiriPin_SetPose(world: *mut kiriWorld, pin: kiriPin, target: *const f32, rotation: *const f32) -> kiriResult;
    /// Sets the force (N) that breaks a pin of any type; 0: it never breaks.
    pub fn kiriPin_SetBreakForce(world: *mut kiriWorld, pin: kiriPin, breakForce: f32) -> kiriResult;
    /// Get the state; force (N) and torque (N m, about the target) on the sheet: means over the
    /// last tick that moved it.
    pub fn kiriPin_GetState(world: *const kiriWorld, pin: kiriPin, state: *mut kiriPinState) -> kiriResult;
    /// Get the state; force (N) and torque (N m, about the target) on the sheet: means over the
    /// last tick that moved it.
    pub fn kiriPin_GetReaction(world: *const kiriWorld, pin: kiriPin, force: *mut f64, torque: *mut f64) -> kiriResult;
    /// Writes up to \`capacity\` ids of the sheet's pins, of all types; \*count is how many there
    /// are.
    pub fn kiriSheet_GetPins(world: *const kiriWorld, sheet: kiriSheet, pins: *mut kiriPin, capacity: i32, count: *mut i32) -> kiriResult;
    /// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On
    /// failure \*seam is 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is
    /// planar; models differ (manual, sewing).
    pub fn kiriDefaultSeamDef(def: *mut kiriSeamDef);
    /// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On
    /// failure \*seam is 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is
    /// planar; models differ (manual, sewing).
    pub fn kiriCreateSeam(world: *mut kiriWorld, def: *const kiriSeamDef, seam: *mut kiriSeam) -> kiriResult;
    /// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On
    /// failure \*seam is 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is
    /// planar; models differ (manual, sewing).
    pub fn kiriDestroySeam(world: *mut kiriWorld, seam: kiriSeam) -> kiriResult;
    /// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On
    /// failure \*seam is 0. KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is
    /// planar; models differ (manual, sewing).
    pub fn kiriSeam_SetHinge(world: *mut kiriWorld, seam: kiriSeam, stiffness: f32, restAngle: f32) -> kiriResult;
    /// Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT:
    /// no such index.
    pub fn kiriSeam_GetStitch(world: *const kiriWorld, seam: kiriSeam, index: i32, stitch: *mut kiriStitch) -> kiriResult;
    /// Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT:
    /// no such index.
    pub fn kiriSeam_GetCount(world: *const kiriWorld, seam: kiriSeam, stitches: *mut i32) -> kiriResult;
    /// Writes up to \`capacity\` ids of the world's seams; \*count is how many there are.
    pub fn kiriWorld_GetSeams(world: *const kiriWorld, seams: *mut kiriSeam, capacity: i32, count: *mut i32) -> kiriResult;
    /// Sets the contacts of the next tick alone. One with point and obstacle of an earlier one
    /// starts with its impulse.
    pub fn kiriSheet_SetContacts(world: *mut kiriWorld, sheet: kiriSheet, contacts: *const kiriContact, count: i32) -> kiriResult;
    /// Gets one result for each contact that was set before the last tick, in that order. A
    /// sleeping piece presses on.
    pub fn kiriSheet_GetContactForces(world: *const kiriWorld, sheet: kiriSheet, forces: *mut *const kiriContactForce, count: *mut i32) -> kiriResult;
    /// Fill the def with its defaults; add and destroy an obstacle. On failure \*obstacle is 0.
    /// Pieces on it wake.
    pub fn kiriDefaultObstacleDef(def: *mut kiriObstacleDef);
    /// Fill the def with its defaults; add and destroy an obstacle. On failure \*obstacle is 0.
    /// Pieces on it wake.
    pub fn kiriCreateObstacle(world: *mut kiriWorld, def: *const kiriObstacleDef, obstacle: *mut kiriObstacle) -> kiriResult;
    /// Fill the def with its defaults; add and destroy an obstacle. On failure \*obstacle is 0.
    /// Pieces on it wake.
    pub fn kiriDestroyObstacle(world: *mut kiriWorld, obstacle: kiriObstacle) -> kiriResult;
    /// Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity),
    /// not to the jump.
    pub fn kiriObstacle_SetPose(world: *mut kiriWorld, obstacle: kiriObstacle, position: *const f32, rotation: *const f32) -> kiriResult;
    /// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg),
    /// inertia and centre of mass.
    pub fn kiriObstacle_SetVelocity(world: *mut kiriWorld, obstacle: kiriObstacle, velocity: *const f32, angularVelocity: *const f32) -> kiriResult;
    /// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg),
    /// inertia and centre of mass.
    pub fn kiriObstacle_SetSurfaceVelocity(world: *mut kiriWorld, obstacle: kiriObstacle, velocity: *const f32) -> kiriResult;
    /// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg),
    /// inertia and centre of mass.
    pub fn kiriObstacle_SetMass(world: *mut kiriWorld, obstacle: kiriObstacle, mass: f32, inertia: *const f32, centerOfMass: *const f32) -> kiriResult;
    /// Gets the current state.
    pub fn kiriObstacle_GetState(world: *const kiriWorld, obstacle: kiriObstacle, state: *mut kiriObstacleState) -> kiriResult;
    /// Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving
    /// obstacles add their way.
    pub fn kiriSheet_GetReach(world: *const kiriWorld, sheet: kiriSheet, dt: f32, lower: *mut f32, upper: *mut f32) -> kiriResult;
    /// Fill the struct with its defaults; draw the world as after the last tick. This only reads,
    /// and takes no memory.
    pub fn kiriDefaultDebugDraw(draw: *mut kiriDebugDraw);
    /// Fill the struct with its defaults; draw the world as after the last tick. This only reads,
    /// and takes no memory.
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
    assert!(size_of::<kiriEvent>() == 44);
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
    assert!(offset_of!(kiriEvent, seam) == 36);
    assert!(offset_of!(kiriEvent, stitches) == 40);
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
    assert!(size_of::<kiriMaterial>() == 52);
    assert!(align_of::<kiriMaterial>() == 4);
    assert!(offset_of!(kiriMaterial, youngsModulus) == 0);
    assert!(offset_of!(kiriMaterial, poissonsRatio) == 4);
    assert!(offset_of!(kiriMaterial, thickness) == 8);
    assert!(offset_of!(kiriMaterial, density) == 12);
    assert!(offset_of!(kiriMaterial, airDamping) == 16);
    assert!(offset_of!(kiriMaterial, flexDamping) == 20);
    assert!(offset_of!(kiriMaterial, yieldStress) == 24);
    assert!(offset_of!(kiriMaterial, hardening) == 28);
    assert!(offset_of!(kiriMaterial, slack) == 32);
    assert!(offset_of!(kiriMaterial, detail) == 36);
    assert!(offset_of!(kiriMaterial, restCurvature) == 40);
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
    assert!(size_of::<kiriSheetDef>() == 264);
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
    assert!(offset_of!(kiriSheetDef, gridResolution) == 136);
    assert!(offset_of!(kiriSheetDef, snapDistance) == 140);
    assert!(offset_of!(kiriSheetDef, weldDistance) == 144);
    assert!(offset_of!(kiriSheetDef, frameCount) == 148);
    assert!(offset_of!(kiriSheetDef, frameLength) == 152);
    assert!(offset_of!(kiriSheetDef, accuracy) == 156);
    assert!(offset_of!(kiriSheetDef, framePoints) == 160);
    assert!(offset_of!(kiriSheetDef, maxFrames) == 168);
    assert!(offset_of!(kiriSheetDef, rigidWeight) == 172);
    assert!(offset_of!(kiriSheetDef, rigidArea) == 176);
    assert!(offset_of!(kiriSheetDef, crumbArea) == 180);
    assert!(offset_of!(kiriSheetDef, friction) == 184);
    assert!(offset_of!(kiriSheetDef, contactThickness) == 188);
    assert!(offset_of!(kiriSheetDef, groups) == 192);
    assert!(offset_of!(kiriSheetDef, touchesSheets) == 196);
    assert!(offset_of!(kiriSheetDef, selfContact) == 200);
    assert!(offset_of!(kiriSheetDef, collisionPoints) == 204);
    assert!(offset_of!(kiriSheetDef, iterations) == 208);
    assert!(offset_of!(kiriSheetDef, sleepSpeed) == 212);
    assert!(offset_of!(kiriSheetDef, model) == 216);
    assert!(offset_of!(kiriSheetDef, skinning) == 220);
    assert!(offset_of!(kiriSheetDef, planar) == 224);
    assert!(offset_of!(kiriSheetDef, timeStepping) == 228);
    assert!(offset_of!(kiriSheetDef, fadeTime) == 232);
    assert!(offset_of!(kiriSheetDef, normals) == 236);
    assert!(offset_of!(kiriSheetDef, paper) == 240);
    assert!(size_of::<kiriSheetSettings>() == 108);
    assert!(align_of::<kiriSheetSettings>() == 4);
    assert!(offset_of!(kiriSheetSettings, cookie) == 0);
    assert!(offset_of!(kiriSheetSettings, material) == 4);
    assert!(offset_of!(kiriSheetSettings, maxFrames) == 56);
    assert!(offset_of!(kiriSheetSettings, crumbArea) == 60);
    assert!(offset_of!(kiriSheetSettings, friction) == 64);
    assert!(offset_of!(kiriSheetSettings, contactThickness) == 68);
    assert!(offset_of!(kiriSheetSettings, groups) == 72);
    assert!(offset_of!(kiriSheetSettings, touchesSheets) == 76);
    assert!(offset_of!(kiriSheetSettings, selfContact) == 80);
    assert!(offset_of!(kiriSheetSettings, iterations) == 84);
    assert!(offset_of!(kiriSheetSettings, sleepSpeed) == 88);
    assert!(offset_of!(kiriSheetSettings, skinning) == 92);
    assert!(offset_of!(kiriSheetSettings, timeStepping) == 96);
    assert!(offset_of!(kiriSheetSettings, fadeTime) == 100);
    assert!(offset_of!(kiriSheetSettings, normals) == 104);
    assert!(size_of::<kiriFold>() == 28);
    assert!(align_of::<kiriFold>() == 4);
    assert!(offset_of!(kiriFold, from) == 0);
    assert!(offset_of!(kiriFold, to) == 8);
    assert!(offset_of!(kiriFold, stiffness) == 16);
    assert!(offset_of!(kiriFold, restAngle) == 20);
    assert!(offset_of!(kiriFold, yieldMoment) == 24);
    assert!(size_of::<kiriFoldState>() == 48);
    assert!(align_of::<kiriFoldState>() == 8);
    assert!(offset_of!(kiriFoldState, fold) == 0);
    assert!(offset_of!(kiriFoldState, angle) == 32);
    assert!(offset_of!(kiriFoldState, length) == 40);
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
    assert!(size_of::<kiriTearing>() == 28);
    assert!(align_of::<kiriTearing>() == 4);
    assert!(offset_of!(kiriTearing, toughness) == 0);
    assert!(offset_of!(kiriTearing, strength) == 4);
    assert!(offset_of!(kiriTearing, grain) == 8);
    assert!(offset_of!(kiriTearing, grainRatio) == 16);
    assert!(offset_of!(kiriTearing, maxSpeed) == 20);
    assert!(offset_of!(kiriTearing, maxTips) == 24);
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
    assert!(size_of::<kiriSeamDef>() == 56);
    assert!(align_of::<kiriSeamDef>() == 8);
    assert!(offset_of!(kiriSeamDef, cookie) == 0);
    assert!(offset_of!(kiriSeamDef, sheetA) == 4);
    assert!(offset_of!(kiriSeamDef, sheetB) == 8);
    assert!(offset_of!(kiriSeamDef, lineA) == 16);
    assert!(offset_of!(kiriSeamDef, lineB) == 24);
    assert!(offset_of!(kiriSeamDef, countA) == 32);
    assert!(offset_of!(kiriSeamDef, countB) == 36);
    assert!(offset_of!(kiriSeamDef, stitches) == 40);
    assert!(offset_of!(kiriSeamDef, stiffness) == 44);
    assert!(offset_of!(kiriSeamDef, restAngle) == 48);
    assert!(offset_of!(kiriSeamDef, breakForce) == 52);
    assert!(size_of::<kiriStitch>() == 56);
    assert!(align_of::<kiriStitch>() == 4);
    assert!(offset_of!(kiriStitch, sheetA) == 0);
    assert!(offset_of!(kiriStitch, sheetB) == 4);
    assert!(offset_of!(kiriStitch, restA) == 8);
    assert!(offset_of!(kiriStitch, restB) == 16);
    assert!(offset_of!(kiriStitch, position) == 24);
    assert!(offset_of!(kiriStitch, gap) == 36);
    assert!(offset_of!(kiriStitch, force) == 40);
    assert!(offset_of!(kiriStitch, angle) == 52);
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
    assert!(size_of::<kiriEvent>() == 44);
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
    assert!(offset_of!(kiriEvent, seam) == 36);
    assert!(offset_of!(kiriEvent, stitches) == 40);
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
    assert!(size_of::<kiriMaterial>() == 52);
    assert!(align_of::<kiriMaterial>() == 4);
    assert!(offset_of!(kiriMaterial, youngsModulus) == 0);
    assert!(offset_of!(kiriMaterial, poissonsRatio) == 4);
    assert!(offset_of!(kiriMaterial, thickness) == 8);
    assert!(offset_of!(kiriMaterial, density) == 12);
    assert!(offset_of!(kiriMaterial, airDamping) == 16);
    assert!(offset_of!(kiriMaterial, flexDamping) == 20);
    assert!(offset_of!(kiriMaterial, yieldStress) == 24);
    assert!(offset_of!(kiriMaterial, hardening) == 28);
    assert!(offset_of!(kiriMaterial, slack) == 32);
    assert!(offset_of!(kiriMaterial, detail) == 36);
    assert!(offset_of!(kiriMaterial, restCurvature) == 40);
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
    assert!(size_of::<kiriSheetDef>() == 240);
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
    assert!(offset_of!(kiriSheetDef, gridResolution) == 120);
    assert!(offset_of!(kiriSheetDef, snapDistance) == 124);
    assert!(offset_of!(kiriSheetDef, weldDistance) == 128);
    assert!(offset_of!(kiriSheetDef, frameCount) == 132);
    assert!(offset_of!(kiriSheetDef, frameLength) == 136);
    assert!(offset_of!(kiriSheetDef, accuracy) == 140);
    assert!(offset_of!(kiriSheetDef, framePoints) == 144);
    assert!(offset_of!(kiriSheetDef, maxFrames) == 148);
    assert!(offset_of!(kiriSheetDef, rigidWeight) == 152);
    assert!(offset_of!(kiriSheetDef, rigidArea) == 156);
    assert!(offset_of!(kiriSheetDef, crumbArea) == 160);
    assert!(offset_of!(kiriSheetDef, friction) == 164);
    assert!(offset_of!(kiriSheetDef, contactThickness) == 168);
    assert!(offset_of!(kiriSheetDef, groups) == 172);
    assert!(offset_of!(kiriSheetDef, touchesSheets) == 176);
    assert!(offset_of!(kiriSheetDef, selfContact) == 180);
    assert!(offset_of!(kiriSheetDef, collisionPoints) == 184);
    assert!(offset_of!(kiriSheetDef, iterations) == 188);
    assert!(offset_of!(kiriSheetDef, sleepSpeed) == 192);
    assert!(offset_of!(kiriSheetDef, model) == 196);
    assert!(offset_of!(kiriSheetDef, skinning) == 200);
    assert!(offset_of!(kiriSheetDef, planar) == 204);
    assert!(offset_of!(kiriSheetDef, timeStepping) == 208);
    assert!(offset_of!(kiriSheetDef, fadeTime) == 212);
    assert!(offset_of!(kiriSheetDef, normals) == 216);
    assert!(offset_of!(kiriSheetDef, paper) == 220);
    assert!(size_of::<kiriSheetSettings>() == 108);
    assert!(align_of::<kiriSheetSettings>() == 4);
    assert!(offset_of!(kiriSheetSettings, cookie) == 0);
    assert!(offset_of!(kiriSheetSettings, material) == 4);
    assert!(offset_of!(kiriSheetSettings, maxFrames) == 56);
    assert!(offset_of!(kiriSheetSettings, crumbArea) == 60);
    assert!(offset_of!(kiriSheetSettings, friction) == 64);
    assert!(offset_of!(kiriSheetSettings, contactThickness) == 68);
    assert!(offset_of!(kiriSheetSettings, groups) == 72);
    assert!(offset_of!(kiriSheetSettings, touchesSheets) == 76);
    assert!(offset_of!(kiriSheetSettings, selfContact) == 80);
    assert!(offset_of!(kiriSheetSettings, iterations) == 84);
    assert!(offset_of!(kiriSheetSettings, sleepSpeed) == 88);
    assert!(offset_of!(kiriSheetSettings, skinning) == 92);
    assert!(offset_of!(kiriSheetSettings, timeStepping) == 96);
    assert!(offset_of!(kiriSheetSettings, fadeTime) == 100);
    assert!(offset_of!(kiriSheetSettings, normals) == 104);
    assert!(size_of::<kiriFold>() == 28);
    assert!(align_of::<kiriFold>() == 4);
    assert!(offset_of!(kiriFold, from) == 0);
    assert!(offset_of!(kiriFold, to) == 8);
    assert!(offset_of!(kiriFold, stiffness) == 16);
    assert!(offset_of!(kiriFold, restAngle) == 20);
    assert!(offset_of!(kiriFold, yieldMoment) == 24);
    assert!(size_of::<kiriFoldState>() == 48);
    assert!(align_of::<kiriFoldState>() == 8);
    assert!(offset_of!(kiriFoldState, fold) == 0);
    assert!(offset_of!(kiriFoldState, angle) == 32);
    assert!(offset_of!(kiriFoldState, length) == 40);
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
    assert!(size_of::<kiriTearing>() == 28);
    assert!(align_of::<kiriTearing>() == 4);
    assert!(offset_of!(kiriTearing, toughness) == 0);
    assert!(offset_of!(kiriTearing, strength) == 4);
    assert!(offset_of!(kiriTearing, grain) == 8);
    assert!(offset_of!(kiriTearing, grainRatio) == 16);
    assert!(offset_of!(kiriTearing, maxSpeed) == 20);
    assert!(offset_of!(kiriTearing, maxTips) == 24);
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
    assert!(size_of::<kiriSeamDef>() == 44);
    assert!(align_of::<kiriSeamDef>() == 4);
    assert!(offset_of!(kiriSeamDef, cookie) == 0);
    assert!(offset_of!(kiriSeamDef, sheetA) == 4);
    assert!(offset_of!(kiriSeamDef, sheetB) == 8);
    assert!(offset_of!(kiriSeamDef, lineA) == 12);
    assert!(offset_of!(kiriSeamDef, lineB) == 16);
    assert!(offset_of!(kiriSeamDef, countA) == 20);
    assert!(offset_of!(kiriSeamDef, countB) == 24);
    assert!(offset_of!(kiriSeamDef, stitches) == 28);
    assert!(offset_of!(kiriSeamDef, stiffness) == 32);
    assert!(offset_of!(kiriSeamDef, restAngle) == 36);
    assert!(offset_of!(kiriSeamDef, breakForce) == 40);
    assert!(size_of::<kiriStitch>() == 56);
    assert!(align_of::<kiriStitch>() == 4);
    assert!(offset_of!(kiriStitch, sheetA) == 0);
    assert!(offset_of!(kiriStitch, sheetB) == 4);
    assert!(offset_of!(kiriStitch, restA) == 8);
    assert!(offset_of!(kiriStitch, restB) == 16);
    assert!(offset_of!(kiriStitch, position) == 24);
    assert!(offset_of!(kiriStitch, gap) == 36);
    assert!(offset_of!(kiriStitch, force) == 40);
    assert!(offset_of!(kiriStitch, angle) == 52);
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
