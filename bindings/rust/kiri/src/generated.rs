// Made from kiri.h by `make bindings`.

use crate::{check, check_read, fail, text, view, Result, Status, World};
use kiri_sys as sys;
use std::mem::{align_of, offset_of, size_of, MaybeUninit};
use std::num::NonZeroU32;

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Sheet(NonZeroU32);

impl Sheet {
    /// Of a number that is an id of C; `None` for 0.
    pub fn from_raw(id: u32) -> Option<Self> {
        NonZeroU32::new(id).map(Self)
    }

    pub(crate) fn known(id: u32) -> Self {
        Self::from_raw(id).expect("the library gives an id")
    }

    /// As C has it.
    pub fn raw(self) -> u32 {
        self.0.get()
    }
}

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Cut(NonZeroU32);

impl Cut {
    /// Of a number that is an id of C; `None` for 0.
    pub fn from_raw(id: u32) -> Option<Self> {
        NonZeroU32::new(id).map(Self)
    }

    pub(crate) fn known(id: u32) -> Self {
        Self::from_raw(id).expect("the library gives an id")
    }

    /// As C has it.
    pub fn raw(self) -> u32 {
        self.0.get()
    }
}

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Frame(NonZeroU32);

impl Frame {
    /// Of a number that is an id of C; `None` for 0.
    pub fn from_raw(id: u32) -> Option<Self> {
        NonZeroU32::new(id).map(Self)
    }

    pub(crate) fn known(id: u32) -> Self {
        Self::from_raw(id).expect("the library gives an id")
    }

    /// As C has it.
    pub fn raw(self) -> u32 {
        self.0.get()
    }
}

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Pin(NonZeroU32);

impl Pin {
    /// Of a number that is an id of C; `None` for 0.
    pub fn from_raw(id: u32) -> Option<Self> {
        NonZeroU32::new(id).map(Self)
    }

    pub(crate) fn known(id: u32) -> Self {
        Self::from_raw(id).expect("the library gives an id")
    }

    /// As C has it.
    pub fn raw(self) -> u32 {
        self.0.get()
    }
}

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Obstacle(NonZeroU32);

impl Obstacle {
    /// Of a number that is an id of C; `None` for 0.
    pub fn from_raw(id: u32) -> Option<Self> {
        NonZeroU32::new(id).map(Self)
    }

    pub(crate) fn known(id: u32) -> Self {
        Self::from_raw(id).expect("the library gives an id")
    }

    /// As C has it.
    pub fn raw(self) -> u32 {
        self.0.get()
    }
}

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Blade(NonZeroU32);

impl Blade {
    /// Of a number that is an id of C; `None` for 0.
    pub fn from_raw(id: u32) -> Option<Self> {
        NonZeroU32::new(id).map(Self)
    }

    pub(crate) fn known(id: u32) -> Self {
        Self::from_raw(id).expect("the library gives an id")
    }

    /// As C has it.
    pub fn raw(self) -> u32 {
        self.0.get()
    }
}

#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ResultCode {
    Ok = 0,
    /// done, and work is left for later ticks
    Pending = 1,
    /// null pointer, NaN, infinite, or outside the documented range; or a sheet or obstacle would
    /// be where floats end, or move that fast: 4e37 m, m/s or 1/s
    ErrorArgument = -1,
    /// the def was not filled by its kiriDefault function, all zeros say: call that first
    ErrorDef = -2,
    /// unknown or stale id, or the id of another kind
    ErrorId = -3,
    /// the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping
    ErrorMesh = -4,
    /// the call comes in the wrong order, or from a callback that may not make it
    ErrorState = -5,
    /// the allocator returned null
    ErrorMemory = -6,
    /// the motion of a sheet could not be continued; it was put to rest where it was
    Diverged = -7,
    /// all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world
    ErrorLimit = -8,
    /// floats are not computed as on other machines, see [`World::new`]
    ErrorBuild = -9,
    /// bytes that are damaged, cut short, of something else, or of a later version
    ErrorData = -10,
    /// a call that was made again gave something else than its recording has
    ErrorReplay = -11,
}

impl ResultCode {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::Ok,
        Self::Pending,
        Self::ErrorArgument,
        Self::ErrorDef,
        Self::ErrorId,
        Self::ErrorMesh,
        Self::ErrorState,
        Self::ErrorMemory,
        Self::Diverged,
        Self::ErrorLimit,
        Self::ErrorBuild,
        Self::ErrorData,
        Self::ErrorReplay,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

pub const LEAST_TRIANGLES: i32 = 16;

pub const MOST_NOTE_BYTES: i32 = 1048576;

/// What happened since the start of the last tick that was not refused.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EventType {
    /// cut: all of it is in the mesh; the id is stale from now on
    CutFinished = 1,
    /// frame (its first, which names it), crumb, area: a connected part came off
    PieceOff = 2,
    /// frame
    FrameAdded = 3,
    /// the sheet was put to rest
    Diverged = 4,
    /// stage, waiting: the budget ended in this stage of the sheet's work
    Deferred = 5,
    /// pin: its force passed `break_force`; the id is stale from now on
    PinBroke = 6,
    /// sheet (the new one), frame, area: what [`Frame::detach_piece`] left waiting is done
    PieceDetached = 7,
}

impl EventType {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::CutFinished,
        Self::PieceOff,
        Self::FrameAdded,
        Self::Diverged,
        Self::Deferred,
        Self::PinBroke,
        Self::PieceDetached,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// The stages of a tick in their order.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// split the mesh along the blade
    Cut = 0,
    /// cells and what links them
    Grid = 1,
    /// geodesic distances, regions, links; placing of frames
    Regions = 2,
    /// shape functions
    Shape = 3,
    /// weights of vertices and collision points
    Samples = 4,
    /// mass, the pattern of the solver's matrix, and when all is put in force
    Constants = 5,
    /// what touches obstacles, other sheets and other pieces
    Contact = 6,
    /// the motion of the frames
    Solve = 7,
    /// positions and normals of the mesh
    Skin = 8,
}

impl Stage {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Cut,
        Self::Grid,
        Self::Regions,
        Self::Shape,
        Self::Samples,
        Self::Constants,
        Self::Contact,
        Self::Solve,
        Self::Skin,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// Materials to start from; src/world/kiri_preset.c says where their numbers come from.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MaterialPreset {
    /// printing paper, 0.11 mm
    Paper = 0,
    /// cloth, 0.5 mm; the default of a sheet def
    Cotton = 1,
    /// natural rubber, 1 mm
    Rubber = 2,
    /// aluminium, 16 um
    Foil = 3,
}

impl MaterialPreset {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Paper,
        Self::Cotton,
        Self::Rubber,
        Self::Foil,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QualityPreset {
    Fast = 0,
    Balanced = 1,
    Accurate = 2,
}

impl QualityPreset {
    /// All of them.
    pub const ALL: [Self; 3] = [
        Self::Fast,
        Self::Balanced,
        Self::Accurate,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// How a sheet deforms.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Model {
    /// Rigid frames joined by links: paper, foil, stiff cloth. 6 unknowns a frame, which its
    /// neighbours couple.
    Links = 0,
    /// Affine frames joined by links: cloth and rubber, whose stretch inside a region is seen. 12
    /// unknowns a frame, which neighbours of neighbours couple: a tick takes five to seven times as
    /// long as with [`Model::Links`]. From 1e8 Pa or so on it needs more iterations, 8 say.
    Affine = 1,
    /// Affine frames, strains at integration points: the scheme of the paper, to compare with.
    /// Weights that vary across a strip cannot bend it as a cylinder, however many points there
    /// are: a clamped strip on 9 frames goes 3, 20, 51 and 70 % too short a way down where it is a
    /// 10th, 20th, 50th and 400th of its length thick. 12 unknowns a frame.
    Points = 2,
}

impl Model {
    /// All of them.
    pub const ALL: [Self; 3] = [
        Self::Links,
        Self::Affine,
        Self::Points,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// What is seen between the frames, and met by rays, blades, obstacles, other sheets, and contacts
/// of rest points; pins, clamps and holds hold it. Where nothing touches or holds the sheet it does
/// not change how that moves. Collision points stay on the linear surface.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Skinning {
    /// each frame carries a flat patch; the weights blend them (equation 1 of the paper)
    Linear = 0,
    /// each carries a patch that bends towards its neighbours: no bumps at the frames
    Smooth = 1,
}

impl Skinning {
    /// All of them.
    pub const ALL: [Self; 2] = [
        Self::Linear,
        Self::Smooth,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// How time is stepped. Both solve one linear system an iteration.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TimeStepping {
    /// TR-BDF2: trapezoid and BDF2 by turns, of second order. Motion lasts: of the energy of a
    /// swinging strip of 9 frames 96 to 98 % is left after 10 s with 2 substeps a 60th of a second
    /// and 1 iteration, 99.7 % with 4. Backward Euler takes its place in the steps in which a
    /// contact touches a piece, a pin or hold is made, moved or removed, or a frame is new or turns
    /// by more than a radian.
    SecondOrder = 0,
    /// Backward Euler, of first order: takes energy out of all that swings, the more the longer the
    /// step. Of that strip's 0.4 % is left.
    Euler = 1,
}

impl TimeStepping {
    /// All of them.
    pub const ALL: [Self; 2] = [
        Self::SecondOrder,
        Self::Euler,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// What a pin holds.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinType {
    Point = 0,
    Hinge = 1,
    Clamp = 2,
}

impl PinType {
    /// All of them.
    pub const ALL: [Self; 3] = [
        Self::Point,
        Self::Hinge,
        Self::Clamp,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

/// A body that sheets touch: a floor, a ball, a crate of another engine. Kiri moves no obstacle by
/// forces. An obstacle goes on with its velocities; a host that moves bodies by an engine of its
/// own sets pose and velocities before each tick, and gives the impulse that [`Obstacle::state`]
/// tells to that engine after it. Contacts follow its motion within the tick, and push no harder
/// than its mass resists. Sheets stay half their `contact_thickness` away from it; that is what is
/// seen of them, with smooth skinning too. A sheet that rests wakes where an obstacle near it
/// comes, goes, or has moved by half a second of its `sleep_speed`. Lengths of shapes are up to 1e6
/// m.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ObstacleType {
    /// all below the plane through its position; the third column of its rotation points out
    Plane = 0,
    /// radius
    Sphere = 1,
    /// radius, height: of its axis, the third column, between the middles of its round ends
    Capsule = 2,
    /// size: lengths of its edges along the columns of its rotation
    Box = 3,
    /// radius, height: along the third column
    Cylinder = 4,
    /// outline: a convex polygon in the plane of the first two columns; height: along the third, 0:
    /// without end
    Prism = 5,
}

impl ObstacleType {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Plane,
        Self::Sphere,
        Self::Capsule,
        Self::Box,
        Self::Cylinder,
        Self::Prism,
    ];

    /// Of a number of C.
    pub fn from_raw(value: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| *known as i32 == value)
    }

    #[allow(dead_code)]
    pub(crate) fn known(value: i32) -> Self {
        Self::from_raw(value).expect("the library gives what its header has")
    }
}

// What is drawn.
/// a triangle for each of the mesh, in a colour of its piece, pale where that sleeps
pub const DRAW_TRIANGLES: u32 = 1;
/// a line for each edge between two triangles
pub const DRAW_EDGES: u32 = 2;
/// a line for each edge of the outline and of lips
pub const DRAW_BORDERS: u32 = 4;
/// a point and three axes each: u red, v green, normal blue; held ones red
pub const DRAW_FRAMES: u32 = 8;
/// two lines each: from frame to frame by the middle of their border
pub const DRAW_LINKS: u32 = 16;
/// a point at the target; a line to the point of the material, or along the line
pub const DRAW_PINS: u32 = 32;
/// a point and its normal for each that pushed as the last tick ended
pub const DRAW_CONTACTS: u32 = 64;
/// a line along the edge, and a point in each layer that it is in
pub const DRAW_BLADES: u32 = 128;
/// twelve lines around each piece
pub const DRAW_BOXES: u32 = 256;
/// lines along edges and rims, without the rounding; a plane is a square
pub const DRAW_OBSTACLES: u32 = 512;
/// a point for each collision point
pub const DRAW_POINTS: u32 = 1024;
pub const DRAW_ALL: u32 = 2047;

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
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Budget {
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

const _: () = {
    assert!(size_of::<Budget>() == size_of::<sys::kiriBudget>());
    assert!(align_of::<Budget>() == align_of::<sys::kiriBudget>());
    assert!(offset_of!(Budget, triangles) == offset_of!(sys::kiriBudget, triangles));
    assert!(offset_of!(Budget, cells) == offset_of!(sys::kiriBudget, cells));
    assert!(offset_of!(Budget, samples) == offset_of!(sys::kiriBudget, samples));
    assert!(offset_of!(Budget, iterations) == offset_of!(sys::kiriBudget, iterations));
};

impl Budget {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriBudget) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriBudget {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// What the last tick did, and what it took.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Profile {
    /// of the last tick; zero without a clock
    pub seconds: [f64; 9],
    /// blade segments that took effect
    pub cut_segments: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub triangles_split: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub cells_settled: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub samples_refreshed: i32,
    /// Items, as the budget counts them: more than what is split or weighed, where one takes more
    /// work.
    pub solver_iterations: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// [`Sheet::counts`].
    pub cells_changed: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// [`Sheet::counts`].
    pub weights_changed: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// [`Sheet::counts`].
    pub vertices_changed: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// [`Sheet::counts`].
    pub points_changed: i32,
    /// What commits changed: cells made or with other material, cells with other weights, vertices
    /// and collision points with other weights, links that are other than before. Of how many:
    /// [`Sheet::counts`].
    pub links_changed: i32,
    /// sheets in which a cut took effect
    pub commits: i32,
    /// linear systems, large and small
    pub systems_solved: i32,
    /// planes given to the solver: the host's, those of obstacles, and those between sheets
    pub contacts: i32,
    /// pairs of sheets or pieces, near each other and not both asleep
    pub sheet_pairs: i32,
    /// The farthest that a vertex would have jumped, m, when a cut took effect, without
    /// `fade_time`; and that one went by a fade.
    pub largest_jump: f64,
    /// The farthest that a vertex would have jumped, m, when a cut took effect, without
    /// `fade_time`; and that one went by a fade.
    pub largest_fade: f64,
}

const _: () = {
    assert!(size_of::<Profile>() == size_of::<sys::kiriProfile>());
    assert!(align_of::<Profile>() == align_of::<sys::kiriProfile>());
    assert!(offset_of!(Profile, seconds) == offset_of!(sys::kiriProfile, seconds));
    assert!(offset_of!(Profile, cut_segments) == offset_of!(sys::kiriProfile, cutSegments));
    assert!(offset_of!(Profile, triangles_split) == offset_of!(sys::kiriProfile, trianglesSplit));
    assert!(offset_of!(Profile, cells_settled) == offset_of!(sys::kiriProfile, cellsSettled));
    assert!(offset_of!(Profile, samples_refreshed) == offset_of!(sys::kiriProfile, samplesRefreshed));
    assert!(offset_of!(Profile, solver_iterations) == offset_of!(sys::kiriProfile, solverIterations));
    assert!(offset_of!(Profile, cells_changed) == offset_of!(sys::kiriProfile, cellsChanged));
    assert!(offset_of!(Profile, weights_changed) == offset_of!(sys::kiriProfile, weightsChanged));
    assert!(offset_of!(Profile, vertices_changed) == offset_of!(sys::kiriProfile, verticesChanged));
    assert!(offset_of!(Profile, points_changed) == offset_of!(sys::kiriProfile, pointsChanged));
    assert!(offset_of!(Profile, links_changed) == offset_of!(sys::kiriProfile, linksChanged));
    assert!(offset_of!(Profile, commits) == offset_of!(sys::kiriProfile, commits));
    assert!(offset_of!(Profile, systems_solved) == offset_of!(sys::kiriProfile, systemsSolved));
    assert!(offset_of!(Profile, contacts) == offset_of!(sys::kiriProfile, contacts));
    assert!(offset_of!(Profile, sheet_pairs) == offset_of!(sys::kiriProfile, sheetPairs));
    assert!(offset_of!(Profile, largest_jump) == offset_of!(sys::kiriProfile, largestJump));
    assert!(offset_of!(Profile, largest_fade) == offset_of!(sys::kiriProfile, largestFade));
};

impl Profile {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriProfile) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriProfile {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// What a sheet is made of: homogeneous, isotropic.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Material {
    /// Pa, above 0
    pub youngs_modulus: f32,
    /// 0 to below 0.5
    pub poissons_ratio: f32,
    /// m, above 0
    pub thickness: f32,
    /// kg/m^3, above 0
    pub density: f32,
    /// 1/s, 0 or more: velocities fade as exp(-`air_damping` t)
    pub air_damping: f32,
    /// s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
    pub flex_damping: f32,
}

const _: () = {
    assert!(size_of::<Material>() == size_of::<sys::kiriMaterial>());
    assert!(align_of::<Material>() == align_of::<sys::kiriMaterial>());
    assert!(offset_of!(Material, youngs_modulus) == offset_of!(sys::kiriMaterial, youngsModulus));
    assert!(offset_of!(Material, poissons_ratio) == offset_of!(sys::kiriMaterial, poissonsRatio));
    assert!(offset_of!(Material, thickness) == offset_of!(sys::kiriMaterial, thickness));
    assert!(offset_of!(Material, density) == offset_of!(sys::kiriMaterial, density));
    assert!(offset_of!(Material, air_damping) == offset_of!(sys::kiriMaterial, airDamping));
    assert!(offset_of!(Material, flex_damping) == offset_of!(sys::kiriMaterial, flexDamping));
};

impl Material {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriMaterial) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriMaterial {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// How much work for how much accuracy. The presets are measured (`make accuracy`; tests/sweep.h
/// has the scenes) on a strip of stiff paper, 0.2 m x 0.05 m, clamped at one end, with one row of
/// frames, and on a square of 0.2 m that bends five times as easily, hangs by two corners, and has
/// half as many rows and columns, rounded up. Let go, they swing for 0.4 s at 60 ticks a second.
/// Error: rms distance of the vertices from where a much finer run brings them, by the rms way that
/// they go; at most, over grids from 4/5 to 5/4 as fine and with frames in regular rows or moved a
/// little. FAST: 2 %. BALANCED: 0.8 %. ACCURATE: 0.4 %. What a cut leaves narrow wants more frames:
/// see accuracy in the sheet def.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Quality {
    /// control frames in a row along a strip; a square does with half as many in either direction,
    /// rounded up: 3 x 3, 5 x 5, 9 x 9
    pub frames_along: i32,
    /// for the sheet def
    pub grid_resolution: i32,
    /// for the sheet def
    pub iterations: i32,
    /// for [`World::tick`]
    pub substeps: i32,
}

const _: () = {
    assert!(size_of::<Quality>() == size_of::<sys::kiriQuality>());
    assert!(align_of::<Quality>() == align_of::<sys::kiriQuality>());
    assert!(offset_of!(Quality, frames_along) == offset_of!(sys::kiriQuality, framesAlong));
    assert!(offset_of!(Quality, grid_resolution) == offset_of!(sys::kiriQuality, gridResolution));
    assert!(offset_of!(Quality, iterations) == offset_of!(sys::kiriQuality, iterations));
    assert!(offset_of!(Quality, substeps) == offset_of!(sys::kiriQuality, substeps));
};

impl Quality {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriQuality) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriQuality {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// The paper's own ways, to compare with; part of the sheet def.
#[derive(Clone, Copy, Debug)]
pub struct PaperOptions {
    /// 1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the
    /// same bit for bit. Default 0.
    pub from_scratch: bool,
    /// 1: when a cut takes effect, only new frames take their motion from the surface: what is seen
    /// jumps, and momentum is not kept. Default 0.
    pub popping: bool,
    /// 1: the weights of frames are linear on the way from frame to frame, so the surface that is
    /// seen has a kink at each frame. Always so with [`Model::Points`]. Default 0: their slope is
    /// zero at the frames.
    pub linear_weights: bool,
    /// [`Model::Points`] only. Work grows with the points: spread evenly over the sheet, at least
    /// one in every piece; default 0: four for each of `frame_count`. Order 1 (default) takes the
    /// strain at a point for all of the material around it, order 2 a strain linear in it, at four
    /// times the work a point. 0 to 1048576
    pub integration_points: i32,
    /// 1 or 2
    pub integration_order: i32,
}

impl PaperOptions {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriPaperOptions) -> Self {
        Self {
            from_scratch: raw.fromScratch != 0,
            popping: raw.popping != 0,
            linear_weights: raw.linearWeights != 0,
            integration_points: raw.integrationPoints,
            integration_order: raw.integrationOrder,
        }
    }

    pub(crate) fn raw(&self) -> sys::kiriPaperOptions {
        sys::kiriPaperOptions {
            fromScratch: i32::from(self.from_scratch),
            popping: i32::from(self.popping),
            linearWeights: i32::from(self.linear_weights),
            integrationPoints: self.integration_points,
            integrationOrder: self.integration_order,
        }
    }
}

/// Of a sheet: its rest shape, where it starts, its material, and how it is computed.
#[derive(Clone, Copy, Debug)]
pub struct SheetDef<'a> {
    /// The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge.
    /// Holes and several parts are fine. Copied by [`World::create_sheet`]; vertices of no triangle
    /// are left out. Edges whose ends lie at the same places, but are different vertices, are the
    /// lips of a cut that is there already; `weld_distance` closes them. 2 floats (u, v) a vertex
    pub rest_positions: &'a [[f32; 2]],
    /// 3 a triangle
    pub indices: &'a [[i32; 3]],
    /// Where it starts: x = position + u `axis_u` + v `axis_v`. The axes are orthonormal.
    pub position: [f32; 3],
    pub axis_u: [f32; 3],
    pub axis_v: [f32; 3],
    /// m/s
    pub velocity: [f32; 3],
    pub material: Material,
    /// grid squares along the longer side, 1 to 4096; default 32
    pub grid_resolution: i32,
    /// m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a
    /// cut keeps within half of it of its line; 0: 1e-4 of the longer side
    pub snap_distance: f32,
    /// Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture
    /// coordinates, and triangles without shared vertices (STL). In the order of vertices, each
    /// becomes the nearest vertex that was kept before and is nearer than this; else it is kept. So
    /// none moves farther, and a chain of near vertices is not one point. A triangle with two
    /// corners at one vertex is left out. [`Sheet::copy_sources`] leads to the vertices of the def.
    /// Default 0: vertices are as the indices say.
    pub weld_distance: f32,
    /// Control frames. `frame_points`: 2 floats a frame, in the material, a grid square apart at
    /// least; null: `frame_count` frames are spread evenly, some of them in pairs at both sides of
    /// slit ends. The grid carries one frame for every two squares of material at most: more are
    /// refused ([`ResultCode::ErrorArgument`]), and re-sampling stops there. A new sheet has no
    /// more frames than `frame_count`, or than pieces where these are more. `frame_count` 0: as
    /// many as the sheet needs: a region is split while its size, 2.45 times its radius of
    /// gyration, exceeds 1.25 `frame_length`, after cuts too: so arms that a cut leaves get frames
    /// along them. `frame_length` 0: it follows from accuracy, the relative error of the shape
    /// under the sheet's own weight that is good enough, but is three squares of the grid at least.
    /// [`Sheet::estimate_error`] says what came of it. 0, or 1 and more; default 5
    pub frame_count: i32,
    /// m; used where `frame_count` is 0; default 0
    pub frame_length: f32,
    /// 1e-4 to 1; used where `frame_count` and `frame_length` are 0; default 0.02
    pub accuracy: f32,
    pub frame_points: Option<&'a [[f32; 2]]>,
    /// re-sampling stops here; default 256
    pub max_frames: i32,
    /// Re-sampling (section 5 of the paper): a frame whose weight exceeds `rigid_weight` over an
    /// area larger than `rigid_area` (m^2) gets others beside it. In a new sheet this is done only
    /// with `frame_count` 0. After cuts it is done where the area is also larger than in the new
    /// sheet: when a cut ends, or has met the border or another cut. A sheet that is to stay rigid
    /// sets `frame_count` and `max_frames` to 1. `rigid_area` 0: a quarter of the area that a frame
    /// has at the start. default 0.95
    pub rigid_weight: f32,
    /// default 0
    pub rigid_area: f32,
    /// A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are
    /// added to it. Default 0.
    pub crumb_area: f32,
    /// Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet
    /// counts the geometric mean. Default 0.5
    pub friction: f32,
    /// m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the
    /// material's thickness, a 20th of a grid square at least. Default 0
    pub contact_thickness: f32,
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
    pub touches_sheets: bool,
    /// spread evenly over the sheet, at least one in every piece; default 0: none
    pub collision_points: i32,
    /// Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual
    pub iterations: i32,
    /// A piece all of whose frames move slower than this (m/s, rms over the material of each) for
    /// half a second falls asleep: it rests, and costs next to nothing. What is new to it wakes it:
    /// a cut that changes it, when that takes effect; a pin that holds it, or the pin's pose; a
    /// hold, a load, contacts other than those it fell asleep with; something that moves and comes
    /// near. Gravity, wind, settings and [`Sheet::wake`] wake all pieces of the sheet. The ticks of
    /// a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.
    pub sleep_speed: f32,
    /// KIRI_MODEL_..., default [`Model::Links`]
    pub model: Model,
    /// KIRI_SKINNING_..., default [`Skinning::Linear`]
    pub skinning: Skinning,
    /// 1: the sheet stays in the plane where it starts, without bending; what velocities, forces
    /// and held positions have across the plane is dropped. 3 unknowns a rigid frame, 6 an affine
    /// one: two thirds of the solver's work, or about a third. Default 0.
    pub planar: bool,
    /// KIRI_TIME_STEPPING_..., default [`TimeStepping::SecondOrder`]
    pub time_stepping: TimeStepping,
    /// When a cut takes effect, weights change, and what is seen between the frames would jump. The
    /// difference fades within this time (s). So does the difference of strain in links of
    /// [`Model::Links`] whose borders have moved. Default 0.2; 0: at once.
    pub fade_time: f32,
    /// 1: normals of the mesh are made in every tick. 0: [`Mesh`] has none, and
    /// [`Sheet::copy_vertices`] copies none; this saves half of the time of linear skinning. The
    /// sheet moves the same, bit for bit: where edges of obstacles or other sheets touch it, the
    /// tick makes normals for itself. So does [`Sheet::solid`]; and what [`Sheet::point`] says is
    /// the same to rounding. Default 1.
    pub normals: bool,
    /// default: none of the paper's own ways
    pub paper: PaperOptions,
}

impl Default for SheetDef<'_> {
    fn default() -> Self {
        Self::from_raw(&Self::default_raw())
    }
}

impl<'a> SheetDef<'a> {
    fn default_raw() -> sys::kiriSheetDef {
        let mut raw = MaybeUninit::<sys::kiriSheetDef>::uninit();
        // SAFETY: it fills all of the struct.
        unsafe {
            sys::kiriDefaultSheetDef(raw.as_mut_ptr());
            raw.assume_init()
        }
    }

    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriSheetDef) -> Self {
        Self {
            rest_positions: unsafe { view(raw.restPositions, raw.vertexCount) },
            indices: unsafe { view(raw.indices, raw.triangleCount) },
            position: raw.position,
            axis_u: raw.axisU,
            axis_v: raw.axisV,
            velocity: raw.velocity,
            material: Material::from_raw(&raw.material),
            grid_resolution: raw.gridResolution,
            snap_distance: raw.snapDistance,
            weld_distance: raw.weldDistance,
            frame_count: raw.frameCount,
            frame_length: raw.frameLength,
            accuracy: raw.accuracy,
            frame_points: (!raw.framePoints.is_null()).then(|| unsafe { view(raw.framePoints, raw.frameCount) }),
            max_frames: raw.maxFrames,
            rigid_weight: raw.rigidWeight,
            rigid_area: raw.rigidArea,
            crumb_area: raw.crumbArea,
            friction: raw.friction,
            contact_thickness: raw.contactThickness,
            groups: raw.groups,
            touches_sheets: raw.touchesSheets != 0,
            collision_points: raw.collisionPoints,
            iterations: raw.iterations,
            sleep_speed: raw.sleepSpeed,
            model: Model::known(raw.model),
            skinning: Skinning::known(raw.skinning),
            planar: raw.planar != 0,
            time_stepping: TimeStepping::known(raw.timeStepping),
            fade_time: raw.fadeTime,
            normals: raw.normals != 0,
            paper: PaperOptions::from_raw(&raw.paper),
        }
    }

    pub(crate) fn raw(&self) -> sys::kiriSheetDef {
        let mut raw = Self::default_raw();
        raw.restPositions = self.rest_positions.as_ptr().cast();
        raw.vertexCount = self.rest_positions.len() as i32;
        raw.indices = self.indices.as_ptr().cast();
        raw.triangleCount = self.indices.len() as i32;
        raw.position = self.position;
        raw.axisU = self.axis_u;
        raw.axisV = self.axis_v;
        raw.velocity = self.velocity;
        raw.material = self.material.raw();
        raw.gridResolution = self.grid_resolution;
        raw.snapDistance = self.snap_distance;
        raw.weldDistance = self.weld_distance;
        raw.frameCount = self.frame_count;
        raw.frameLength = self.frame_length;
        raw.accuracy = self.accuracy;
        if let Some(rows) = self.frame_points {
            raw.framePoints = rows.as_ptr().cast();
            raw.frameCount = rows.len() as i32;
        }
        raw.maxFrames = self.max_frames;
        raw.rigidWeight = self.rigid_weight;
        raw.rigidArea = self.rigid_area;
        raw.crumbArea = self.crumb_area;
        raw.friction = self.friction;
        raw.contactThickness = self.contact_thickness;
        raw.groups = self.groups;
        raw.touchesSheets = i32::from(self.touches_sheets);
        raw.collisionPoints = self.collision_points;
        raw.iterations = self.iterations;
        raw.sleepSpeed = self.sleep_speed;
        raw.model = self.model as i32;
        raw.skinning = self.skinning as i32;
        raw.planar = i32::from(self.planar);
        raw.timeStepping = self.time_stepping as i32;
        raw.fadeTime = self.fade_time;
        raw.normals = i32::from(self.normals);
        raw.paper = self.paper.raw();
        raw
    }
}

/// What of the def may be changed while the sheet lives, as there. [`Sheet::settings`] stamps it.
#[derive(Clone, Copy, Debug)]
pub struct SheetSettings {
    cookie: u32,
    pub material: Material,
    /// re-sampling stops here; default 256
    pub max_frames: i32,
    /// A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are
    /// added to it. Default 0.
    pub crumb_area: f32,
    /// Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet
    /// counts the geometric mean. Default 0.5
    pub friction: f32,
    /// m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the
    /// material's thickness, a 20th of a grid square at least. Default 0
    pub contact_thickness: f32,
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
    pub touches_sheets: bool,
    /// Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual
    pub iterations: i32,
    /// A piece all of whose frames move slower than this (m/s, rms over the material of each) for
    /// half a second falls asleep: it rests, and costs next to nothing. What is new to it wakes it:
    /// a cut that changes it, when that takes effect; a pin that holds it, or the pin's pose; a
    /// hold, a load, contacts other than those it fell asleep with; something that moves and comes
    /// near. Gravity, wind, settings and [`Sheet::wake`] wake all pieces of the sheet. The ticks of
    /// a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.
    pub sleep_speed: f32,
    /// KIRI_SKINNING_..., default [`Skinning::Linear`]
    pub skinning: Skinning,
    /// KIRI_TIME_STEPPING_..., default [`TimeStepping::SecondOrder`]
    pub time_stepping: TimeStepping,
    /// stays 0 with paper.popping
    pub fade_time: f32,
    /// 1: normals of the mesh are made in every tick. 0: [`Mesh`] has none, and
    /// [`Sheet::copy_vertices`] copies none; this saves half of the time of linear skinning. The
    /// sheet moves the same, bit for bit: where edges of obstacles or other sheets touch it, the
    /// tick makes normals for itself. So does [`Sheet::solid`]; and what [`Sheet::point`] says is
    /// the same to rounding. Default 1.
    pub normals: bool,
}

impl SheetSettings {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriSheetSettings) -> Self {
        Self {
            cookie: raw.cookie,
            material: Material::from_raw(&raw.material),
            max_frames: raw.maxFrames,
            crumb_area: raw.crumbArea,
            friction: raw.friction,
            contact_thickness: raw.contactThickness,
            groups: raw.groups,
            touches_sheets: raw.touchesSheets != 0,
            iterations: raw.iterations,
            sleep_speed: raw.sleepSpeed,
            skinning: Skinning::known(raw.skinning),
            time_stepping: TimeStepping::known(raw.timeStepping),
            fade_time: raw.fadeTime,
            normals: raw.normals != 0,
        }
    }

    pub(crate) fn raw(&self) -> sys::kiriSheetSettings {
        sys::kiriSheetSettings {
            cookie: self.cookie,
            material: self.material.raw(),
            maxFrames: self.max_frames,
            crumbArea: self.crumb_area,
            friction: self.friction,
            contactThickness: self.contact_thickness,
            groups: self.groups,
            touchesSheets: i32::from(self.touches_sheets),
            iterations: self.iterations,
            sleepSpeed: self.sleep_speed,
            skinning: self.skinning as i32,
            timeStepping: self.time_stepping as i32,
            fadeTime: self.fade_time,
            normals: i32::from(self.normals),
        }
    }
}

/// The triangles that are seen, as after the last tick. revision grows whenever indices or vertices
/// are added or changed. Rest positions are floats, 6e-8 of the distance from the origin of the
/// rest plane apart: where triangles are not much larger than that, they look flat or inverted. The
/// library computes with the positions of the def to 2^-29 of the sheet; `source_triangles` and
/// `source_weights` are as exact as the sheet is large.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// 3 a vertex, m, world
    pub positions: &'a [[f32; 3]],
    /// 3 a vertex, unit; null where the sheet makes none
    pub normals: Option<&'a [[f32; 3]]>,
    /// 2 a vertex, m
    pub rest_positions: &'a [[f32; 2]],
    /// 3 a triangle
    pub indices: &'a [[i32; 3]],
    /// 1 a vertex: the triangle of the def that it lies in,
    pub source_triangles: &'a [i32],
    /// 3 a vertex: and its barycentric coordinates there
    pub source_weights: &'a [[f32; 3]],
    pub vertex_count: i32,
    pub triangle_count: i32,
    pub revision: u32,
}

impl<'a> Mesh<'a> {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriMesh) -> Self {
        Self {
            positions: unsafe { view(raw.positions, raw.vertexCount) },
            normals: (!raw.normals.is_null()).then(|| unsafe { view(raw.normals, raw.vertexCount) }),
            rest_positions: unsafe { view(raw.restPositions, raw.vertexCount) },
            indices: unsafe { view(raw.indices, raw.triangleCount) },
            source_triangles: unsafe { view(raw.sourceTriangles, raw.vertexCount) },
            source_weights: unsafe { view(raw.sourceWeights, raw.vertexCount) },
            vertex_count: raw.vertexCount,
            triangle_count: raw.triangleCount,
            revision: raw.revision,
        }
    }
}

/// So many items from the first on.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Range {
    pub first: i32,
    pub count: i32,
}

const _: () = {
    assert!(size_of::<Range>() == size_of::<sys::kiriRange>());
    assert!(align_of::<Range>() == align_of::<sys::kiriRange>());
    assert!(offset_of!(Range, first) == offset_of!(sys::kiriRange, first));
    assert!(offset_of!(Range, count) == offset_of!(sys::kiriRange, count));
};

impl Range {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriRange) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriRange {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// What has changed in the mesh, for hosts that keep a copy of it, on a GPU say. Positions and
/// normals change with every tick; all else of a vertex, and the corners of a triangle, only in
/// these ranges.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Dirty {
    /// up to the last one of the mesh
    pub new_vertices: Range,
    /// up to the last one of the mesh
    pub new_triangles: Range,
    /// the least ranges that hold all older ones with other data
    pub old_vertices: Range,
    /// the least ranges that hold all older ones with other data
    pub old_triangles: Range,
    /// for the next call
    pub revision: u32,
}

const _: () = {
    assert!(size_of::<Dirty>() == size_of::<sys::kiriDirty>());
    assert!(align_of::<Dirty>() == align_of::<sys::kiriDirty>());
    assert!(offset_of!(Dirty, new_vertices) == offset_of!(sys::kiriDirty, newVertices));
    assert!(offset_of!(Dirty, new_triangles) == offset_of!(sys::kiriDirty, newTriangles));
    assert!(offset_of!(Dirty, old_vertices) == offset_of!(sys::kiriDirty, oldVertices));
    assert!(offset_of!(Dirty, old_triangles) == offset_of!(sys::kiriDirty, oldTriangles));
    assert!(offset_of!(Dirty, revision) == offset_of!(sys::kiriDirty, revision));
};

impl Dirty {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriDirty) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriDirty {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the
/// lips of cuts. First come the vertices of [`Mesh`] on the side that the normal leaves, then the
/// same on the other side, then four for each edge of the border, so that rims are flat and their
/// edges sharp.
#[derive(Clone, Copy, Debug)]
pub struct Solid<'a> {
    /// 3 a vertex, m, world
    pub positions: &'a [[f32; 3]],
    /// 3 a vertex, unit, outwards
    pub normals: &'a [[f32; 3]],
    /// 2 a vertex, m
    pub rest_positions: &'a [[f32; 2]],
    /// 3 a triangle, counter-clockwise from outside
    pub indices: &'a [[i32; 3]],
    /// 1 a vertex: that of [`Mesh`] which it stands on
    pub sources: &'a [i32],
    pub vertex_count: i32,
    pub triangle_count: i32,
    /// from this one on triangles are rims
    pub rim_triangle: i32,
}

impl<'a> Solid<'a> {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriSolid) -> Self {
        Self {
            positions: unsafe { view(raw.positions, raw.vertexCount) },
            normals: unsafe { view(raw.normals, raw.vertexCount) },
            rest_positions: unsafe { view(raw.restPositions, raw.vertexCount) },
            indices: unsafe { view(raw.indices, raw.triangleCount) },
            sources: unsafe { view(raw.sources, raw.vertexCount) },
            vertex_count: raw.vertexCount,
            triangle_count: raw.triangleCount,
            rim_triangle: raw.rimTriangle,
        }
    }
}

/// How many there are of each.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Counts {
    pub vertices: i32,
    pub triangles: i32,
    pub cells: i32,
    pub frames: i32,
    pub links: i32,
    pub pieces: i32,
    pub collision_points: i32,
}

const _: () = {
    assert!(size_of::<Counts>() == size_of::<sys::kiriCounts>());
    assert!(align_of::<Counts>() == align_of::<sys::kiriCounts>());
    assert!(offset_of!(Counts, vertices) == offset_of!(sys::kiriCounts, vertices));
    assert!(offset_of!(Counts, triangles) == offset_of!(sys::kiriCounts, triangles));
    assert!(offset_of!(Counts, cells) == offset_of!(sys::kiriCounts, cells));
    assert!(offset_of!(Counts, frames) == offset_of!(sys::kiriCounts, frames));
    assert!(offset_of!(Counts, links) == offset_of!(sys::kiriCounts, links));
    assert!(offset_of!(Counts, pieces) == offset_of!(sys::kiriCounts, pieces));
    assert!(offset_of!(Counts, collision_points) == offset_of!(sys::kiriCounts, collisionPoints));
};

impl Counts {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriCounts) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriCounts {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// Area (m^2), mass (kg), kinetic energy and elastic energy (J), linear and angular momentum about
/// the world's origin (kg m/s, kg m^2/s), centre of mass (m).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Totals {
    pub area: f64,
    pub mass: f64,
    pub kinetic_energy: f64,
    pub elastic_energy: f64,
    pub center: [f64; 3],
    pub momentum: [f64; 3],
    pub angular_momentum: [f64; 3],
}

const _: () = {
    assert!(size_of::<Totals>() == size_of::<sys::kiriTotals>());
    assert!(align_of::<Totals>() == align_of::<sys::kiriTotals>());
    assert!(offset_of!(Totals, area) == offset_of!(sys::kiriTotals, area));
    assert!(offset_of!(Totals, mass) == offset_of!(sys::kiriTotals, mass));
    assert!(offset_of!(Totals, kinetic_energy) == offset_of!(sys::kiriTotals, kineticEnergy));
    assert!(offset_of!(Totals, elastic_energy) == offset_of!(sys::kiriTotals, elasticEnergy));
    assert!(offset_of!(Totals, center) == offset_of!(sys::kiriTotals, center));
    assert!(offset_of!(Totals, momentum) == offset_of!(sys::kiriTotals, momentum));
    assert!(offset_of!(Totals, angular_momentum) == offset_of!(sys::kiriTotals, angularMomentum));
};

impl Totals {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriTotals) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriTotals {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// What a ray meets.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hit {
    /// where to cut
    pub rest_point: [f32; 2],
    pub position: [f32; 3],
    pub normal: [f32; 3],
    /// m along the direction, which need not be a unit vector
    pub distance: f32,
    pub triangle: i32,
}

const _: () = {
    assert!(size_of::<Hit>() == size_of::<sys::kiriHit>());
    assert!(align_of::<Hit>() == align_of::<sys::kiriHit>());
    assert!(offset_of!(Hit, rest_point) == offset_of!(sys::kiriHit, restPoint));
    assert!(offset_of!(Hit, position) == offset_of!(sys::kiriHit, position));
    assert!(offset_of!(Hit, normal) == offset_of!(sys::kiriHit, normal));
    assert!(offset_of!(Hit, distance) == offset_of!(sys::kiriHit, distance));
    assert!(offset_of!(Hit, triangle) == offset_of!(sys::kiriHit, triangle));
};

impl Hit {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriHit) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriHit {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// A point of the material, as it is seen.
#[derive(Clone, Copy, Debug)]
pub struct PointState {
    /// m, world; unit
    pub position: [f32; 3],
    /// m, world; unit
    pub normal: [f32; 3],
    /// m/s, by the weights of the point
    pub velocity: [f32; 3],
    /// in whose region it is; it names the piece, too
    pub frame: Frame,
}

impl PointState {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriPointState) -> Self {
        Self {
            position: raw.position,
            normal: raw.normal,
            velocity: raw.velocity,
            frame: Frame::known(raw.frame),
        }
    }
}

/// The connected parts of a sheet. A piece is named by any of its frames. To go through all of them
/// there are indices too, from 0 on to [`Counts`].pieces, in the order of first frames: they change
/// when a piece comes off or is taken away; [`Frame::piece`] has that of now. A cut whose work
/// waits for its budget has not parted anything yet. Momentum is about the world's origin.
#[derive(Clone, Copy, Debug)]
pub struct PieceState {
    /// m^2, kg
    pub area: f64,
    /// m^2, kg
    pub mass: f64,
    /// of mass, m; kg m/s; kg m^2/s
    pub center: [f64; 3],
    /// of mass, m; kg m/s; kg m^2/s
    pub momentum: [f64; 3],
    /// of mass, m; kg m/s; kg m^2/s
    pub angular_momentum: [f64; 3],
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
    pub collision_points: i32,
    /// 1: see [`SheetDef`]
    pub crumb: bool,
    /// 1: see `sleep_speed`
    pub asleep: bool,
}

impl PieceState {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriPieceState) -> Self {
        Self {
            area: raw.area,
            mass: raw.mass,
            center: raw.center,
            momentum: raw.momentum,
            angular_momentum: raw.angularMomentum,
            lower: raw.lower,
            upper: raw.upper,
            frames: raw.frames,
            vertices: raw.vertices,
            triangles: raw.triangles,
            collision_points: raw.collisionPoints,
            crumb: raw.crumb != 0,
            asleep: raw.asleep != 0,
        }
    }
}

/// What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece
/// after piece.
#[derive(Clone, Copy, Debug)]
pub struct PieceMesh<'a> {
    /// of [`Mesh`]
    pub vertices: &'a [i32],
    /// of [`Mesh`]
    pub triangles: &'a [i32],
    /// 3 a triangle, as in [`Mesh`]: draw them
    pub indices: &'a [[i32; 3]],
    /// see [`Sheet::collision_points`]
    pub collision_points: &'a [i32],
    pub vertex_count: i32,
    pub triangle_count: i32,
    pub collision_point_count: i32,
}

impl<'a> PieceMesh<'a> {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriPieceMesh) -> Self {
        Self {
            vertices: unsafe { view(raw.vertices, raw.vertexCount) },
            triangles: unsafe { view(raw.triangles, raw.triangleCount) },
            indices: unsafe { view(raw.indices, raw.triangleCount) },
            collision_points: unsafe { view(raw.collisionPoints, raw.collisionPointCount) },
            vertex_count: raw.vertexCount,
            triangle_count: raw.triangleCount,
            collision_point_count: raw.collisionPointCount,
        }
    }
}

/// Pose, motion and region of a frame.
#[derive(Clone, Copy, Debug)]
pub struct FrameState {
    pub rest_point: [f32; 2],
    /// of the rest point
    pub position: [f32; 3],
    /// columns: direction of u, direction of v, normal; of an affine frame the columns of A, which
    /// stretch with the sheet
    pub rotation: [f32; 9],
    /// m/s
    pub velocity: [f32; 3],
    /// rad/s
    pub angular_velocity: [f32; 3],
    /// m^2 of its region
    pub area: f32,
    /// kg
    pub mass: f32,
    /// 1: moved by the host, see [`Frame::hold`]
    pub held: bool,
}

impl FrameState {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriFrameState) -> Self {
        Self {
            rest_point: raw.restPoint,
            position: raw.position,
            rotation: raw.rotation,
            velocity: raw.velocity,
            angular_velocity: raw.angularVelocity,
            area: raw.area,
            mass: raw.mass,
            held: raw.held != 0,
        }
    }
}

/// Air that moves past the sheet, in every tick until the next call. On each square metre act, with
/// v the velocity of the air less that of the material, and n the normal: density / 2 times |v|
/// (drag (v.n) n + lift (v - (v.n) n)). Zero velocity with drag and lift above zero: still air,
/// which resists. All zero: none. It acts at four points of the region of each frame, and follows
/// its motion within the tick: sheets flutter, and no wind is too strong. Gusts are a call a tick.
/// Wind that stays as it is lets a sheet sleep.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Wind {
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

const _: () = {
    assert!(size_of::<Wind>() == size_of::<sys::kiriWind>());
    assert!(align_of::<Wind>() == align_of::<sys::kiriWind>());
    assert!(offset_of!(Wind, velocity) == offset_of!(sys::kiriWind, velocity));
    assert!(offset_of!(Wind, density) == offset_of!(sys::kiriWind, density));
    assert!(offset_of!(Wind, drag) == offset_of!(sys::kiriWind, drag));
    assert!(offset_of!(Wind, lift) == offset_of!(sys::kiriWind, lift));
};

impl Wind {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriWind) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriWind {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// A pin holds a point of the material at its target, by a spring.
#[derive(Clone, Copy, Debug)]
pub struct PinDef {
    /// in the material
    pub rest_point: [f32; 2],
    /// m, world: where it is held
    pub target: [f32; 3],
    /// N/m; 0: ten times Young's modulus times thickness
    pub stiffness: f32,
    /// N: it breaks ([`EventType::PinBroke`]) in a tick in which it held with more; 0: never
    pub break_force: f32,
    /// or 0. The target goes with this obstacle from where it is when the pin is made, or
    /// [`Pin::set_target`] puts it, and the obstacle feels the pin ([`Obstacle::state`]); one with
    /// mass yields to it within the tick. When it is destroyed the target stays where it was
    pub obstacle: Option<Obstacle>,
}

impl Default for PinDef {
    fn default() -> Self {
        Self::from_raw(&Self::default_raw())
    }
}

impl PinDef {
    fn default_raw() -> sys::kiriPinDef {
        let mut raw = MaybeUninit::<sys::kiriPinDef>::uninit();
        // SAFETY: it fills all of the struct.
        unsafe {
            sys::kiriDefaultPinDef(raw.as_mut_ptr());
            raw.assume_init()
        }
    }

    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriPinDef) -> Self {
        Self {
            rest_point: raw.restPoint,
            target: raw.target,
            stiffness: raw.stiffness,
            break_force: raw.breakForce,
            obstacle: Obstacle::from_raw(raw.obstacle),
        }
    }

    pub(crate) fn raw(&self) -> sys::kiriPinDef {
        let mut raw = Self::default_raw();
        raw.restPoint = self.rest_point;
        raw.target = self.target;
        raw.stiffness = self.stiffness;
        raw.breakForce = self.break_force;
        raw.obstacle = self.obstacle.map_or(0, |id| id.raw());
        raw
    }
}

/// What a pin is, and where it holds.
#[derive(Clone, Copy, Debug)]
pub struct PinState {
    /// KIRI_PIN_...
    pub kind: PinType,
    pub sheet: Sheet,
    /// rest position: of a point, twice, or of the ends of the line
    pub from: [f32; 2],
    /// rest position: of a point, twice, or of the ends of the line
    pub to: [f32; 2],
    pub target: [f32; 3],
    /// of a line; of a point the identity
    pub rotation: [f32; 9],
    /// N, or 0
    pub break_force: f32,
    /// that it goes with, or 0
    pub obstacle: Option<Obstacle>,
}

impl PinState {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriPinState) -> Self {
        Self {
            kind: PinType::known(raw.type_),
            sheet: Sheet::known(raw.sheet),
            from: raw.from,
            to: raw.to,
            target: raw.target,
            rotation: raw.rotation,
            break_force: raw.breakForce,
            obstacle: Obstacle::from_raw(raw.obstacle),
        }
    }
}

/// A point of the material that touches something: the plane dot(normal, x) = offset keeps it on
/// its upper side, with as much force as that takes, and Coulomb friction acts along the plane. The
/// plane is that of an obstacle of the host, who finds it anew for each tick from where the sheet
/// is seen. A contact may lie in the path of the point, above or below it: one that does not reach
/// its plane in the tick costs little and does nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Contact {
    /// index of the collision point; -1: `rest_point` says which point of the material
    pub point: i32,
    /// in the material; only read where point is -1
    pub rest_point: [f32; 2],
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
    pub inverse_mass: f32,
    /// m/s, 0 or more: a point that starts below the plane is pushed out no faster. 0: 1 m/s
    pub push_speed: f32,
    /// the host's number. Contacts of one number press on one obstacle, and share its mass
    pub obstacle: i32,
}

const _: () = {
    assert!(size_of::<Contact>() == size_of::<sys::kiriContact>());
    assert!(align_of::<Contact>() == align_of::<sys::kiriContact>());
    assert!(offset_of!(Contact, point) == offset_of!(sys::kiriContact, point));
    assert!(offset_of!(Contact, rest_point) == offset_of!(sys::kiriContact, restPoint));
    assert!(offset_of!(Contact, normal) == offset_of!(sys::kiriContact, normal));
    assert!(offset_of!(Contact, offset) == offset_of!(sys::kiriContact, offset));
    assert!(offset_of!(Contact, velocity) == offset_of!(sys::kiriContact, velocity));
    assert!(offset_of!(Contact, friction) == offset_of!(sys::kiriContact, friction));
    assert!(offset_of!(Contact, inverse_mass) == offset_of!(sys::kiriContact, inverseMass));
    assert!(offset_of!(Contact, push_speed) == offset_of!(sys::kiriContact, pushSpeed));
    assert!(offset_of!(Contact, obstacle) == offset_of!(sys::kiriContact, obstacle));
};

impl Contact {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriContact) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriContact {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// What a contact did in the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ContactForce {
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

const _: () = {
    assert!(size_of::<ContactForce>() == size_of::<sys::kiriContactForce>());
    assert!(align_of::<ContactForce>() == align_of::<sys::kiriContactForce>());
    assert!(offset_of!(ContactForce, impulse) == offset_of!(sys::kiriContactForce, impulse));
    assert!(offset_of!(ContactForce, position) == offset_of!(sys::kiriContactForce, position));
    assert!(offset_of!(ContactForce, depth) == offset_of!(sys::kiriContactForce, depth));
    assert!(offset_of!(ContactForce, point) == offset_of!(sys::kiriContactForce, point));
    assert!(offset_of!(ContactForce, obstacle) == offset_of!(sys::kiriContactForce, obstacle));
};

impl ContactForce {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriContactForce) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriContactForce {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// Of an obstacle: its shape, where it is, its motion, and its mass.
#[derive(Clone, Copy, Debug)]
pub struct ObstacleDef<'a> {
    /// KIRI_OBSTACLE_...
    pub kind: ObstacleType,
    /// m
    pub size: [f32; 3],
    /// m
    pub radius: f32,
    /// m
    pub height: f32,
    /// 2 floats a corner, m, counter-clockwise; copied
    pub outline: &'a [[f32; 2]],
    /// m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0
    pub rounding: f32,
    /// m, world
    pub position: [f32; 3],
    /// columns; default: the axes of the world
    pub rotation: [f32; 9],
    /// m/s, of its position
    pub velocity: [f32; 3],
    /// rad/s
    pub angular_velocity: [f32; 3],
    /// m/s, world: of its surface beside that, as of a conveyor
    pub surface_velocity: [f32; 3],
    /// 0 or more; default 0.5
    pub friction: f32,
    /// kg; 0 (default): nothing moves it
    pub mass: f32,
    /// kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz.
    /// Positive definite, but for axes whose numbers are all 0: it does not turn about these
    pub inertia: [f32; 6],
    /// m, from its position in its own axes
    pub center_of_mass: [f32; 3],
    /// obstacles of the same number, but 0, are parts of one body, whose mass each of them has
    pub body: u32,
    /// m/s, above 0: what is inside is pushed out no faster. Default 1
    pub push_speed: f32,
    /// see the sheet def. Default: all
    pub groups: u32,
}

impl Default for ObstacleDef<'_> {
    fn default() -> Self {
        Self::from_raw(&Self::default_raw())
    }
}

impl<'a> ObstacleDef<'a> {
    fn default_raw() -> sys::kiriObstacleDef {
        let mut raw = MaybeUninit::<sys::kiriObstacleDef>::uninit();
        // SAFETY: it fills all of the struct.
        unsafe {
            sys::kiriDefaultObstacleDef(raw.as_mut_ptr());
            raw.assume_init()
        }
    }

    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriObstacleDef) -> Self {
        Self {
            kind: ObstacleType::known(raw.type_),
            size: raw.size,
            radius: raw.radius,
            height: raw.height,
            outline: unsafe { view(raw.outline, raw.outlineCount) },
            rounding: raw.rounding,
            position: raw.position,
            rotation: raw.rotation,
            velocity: raw.velocity,
            angular_velocity: raw.angularVelocity,
            surface_velocity: raw.surfaceVelocity,
            friction: raw.friction,
            mass: raw.mass,
            inertia: raw.inertia,
            center_of_mass: raw.centerOfMass,
            body: raw.body,
            push_speed: raw.pushSpeed,
            groups: raw.groups,
        }
    }

    pub(crate) fn raw(&self) -> sys::kiriObstacleDef {
        let mut raw = Self::default_raw();
        raw.type_ = self.kind as i32;
        raw.size = self.size;
        raw.radius = self.radius;
        raw.height = self.height;
        raw.outline = if self.outline.is_empty() { std::ptr::null() } else { self.outline.as_ptr().cast() };
        raw.outlineCount = self.outline.len() as i32;
        raw.rounding = self.rounding;
        raw.position = self.position;
        raw.rotation = self.rotation;
        raw.velocity = self.velocity;
        raw.angularVelocity = self.angular_velocity;
        raw.surfaceVelocity = self.surface_velocity;
        raw.friction = self.friction;
        raw.mass = self.mass;
        raw.inertia = self.inertia;
        raw.centerOfMass = self.center_of_mass;
        raw.body = self.body;
        raw.pushSpeed = self.push_speed;
        raw.groups = self.groups;
        raw
    }
}

/// Where it is now, with what it moves, and what it felt.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ObstacleState {
    pub position: [f32; 3],
    pub rotation: [f32; 9],
    pub velocity: [f32; 3],
    pub angular_velocity: [f32; 3],
    /// N s, N m s about its centre of mass: what sheets and pins gave it in the last tick
    pub impulse: [f64; 3],
    /// N s, N m s about its centre of mass: what sheets and pins gave it in the last tick
    pub angular_impulse: [f64; 3],
    /// that pushed in the last tick
    pub contacts: i32,
}

const _: () = {
    assert!(size_of::<ObstacleState>() == size_of::<sys::kiriObstacleState>());
    assert!(align_of::<ObstacleState>() == align_of::<sys::kiriObstacleState>());
    assert!(offset_of!(ObstacleState, position) == offset_of!(sys::kiriObstacleState, position));
    assert!(offset_of!(ObstacleState, rotation) == offset_of!(sys::kiriObstacleState, rotation));
    assert!(offset_of!(ObstacleState, velocity) == offset_of!(sys::kiriObstacleState, velocity));
    assert!(offset_of!(ObstacleState, angular_velocity) == offset_of!(sys::kiriObstacleState, angularVelocity));
    assert!(offset_of!(ObstacleState, impulse) == offset_of!(sys::kiriObstacleState, impulse));
    assert!(offset_of!(ObstacleState, angular_impulse) == offset_of!(sys::kiriObstacleState, angularImpulse));
    assert!(offset_of!(ObstacleState, contacts) == offset_of!(sys::kiriObstacleState, contacts));
};

impl ObstacleState {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriObstacleState) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriObstacleState {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// A corner of what is drawn: as it is, it may go to a GPU.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct DrawVertex {
    /// m, world
    pub position: [f32; 3],
    /// red in its lowest byte, then green, blue, and opacity, which is 255
    pub color: u32,
}

const _: () = {
    assert!(size_of::<DrawVertex>() == size_of::<sys::kiriDrawVertex>());
    assert!(align_of::<DrawVertex>() == align_of::<sys::kiriDrawVertex>());
    assert!(offset_of!(DrawVertex, position) == offset_of!(sys::kiriDrawVertex, position));
    assert!(offset_of!(DrawVertex, color) == offset_of!(sys::kiriDrawVertex, color));
};

impl DrawVertex {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriDrawVertex) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriDrawVertex {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// What happened since the start of the last tick that was not refused.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// cut: all of it is in the mesh; the id is stale from now on
    CutFinished {
        sheet: Sheet,
        cut: Cut,
    },
    /// frame (its first, which names it), crumb, area: a connected part came off
    PieceOff {
        sheet: Sheet,
        frame: Frame,
        crumb: bool,
        area: f32,
    },
    /// frame
    FrameAdded {
        sheet: Sheet,
        frame: Frame,
    },
    /// the sheet was put to rest
    Diverged {
        sheet: Sheet,
    },
    /// stage, waiting: the budget ended in this stage of the sheet's work
    Deferred {
        sheet: Sheet,
        stage: Stage,
        waiting: i32,
    },
    /// pin: its force passed `break_force`; the id is stale from now on
    PinBroke {
        sheet: Sheet,
        pin: Pin,
    },
    /// sheet (the new one), frame, area: what [`Frame::detach_piece`] left waiting is done
    PieceDetached {
        sheet: Sheet,
        frame: Frame,
        area: f32,
    },
}

impl Event {
    pub(crate) fn from_raw(raw: &sys::kiriEvent) -> Self {
        match EventType::known(raw.type_) {
            EventType::CutFinished => Self::CutFinished { sheet: Sheet::known(raw.sheet), cut: Cut::known(raw.cut) },
            EventType::PieceOff => Self::PieceOff { sheet: Sheet::known(raw.sheet), frame: Frame::known(raw.frame), crumb: raw.crumb != 0, area: raw.area },
            EventType::FrameAdded => Self::FrameAdded { sheet: Sheet::known(raw.sheet), frame: Frame::known(raw.frame) },
            EventType::Diverged => Self::Diverged { sheet: Sheet::known(raw.sheet) },
            EventType::Deferred => Self::Deferred { sheet: Sheet::known(raw.sheet), stage: Stage::known(raw.stage), waiting: raw.waiting },
            EventType::PinBroke => Self::PinBroke { sheet: Sheet::known(raw.sheet), pin: Pin::known(raw.pin) },
            EventType::PieceDetached => Self::PieceDetached { sheet: Sheet::known(raw.sheet), frame: Frame::known(raw.frame), area: raw.area },
        }
    }
}

/// The name of a result, "[`ResultCode::Ok`]" and so on; "unknown" for another number.
#[must_use]
pub fn result_name(result: ResultCode) -> &'static str {
    // SAFETY: texts of the library stay.
    unsafe { text(sys::kiriGetResultName(result as i32)) }
}

/// One line: the meaning of a result, and its cure. For calls without a world that keeps a line,
/// such as [`World::new`] with a def of zeros ([`ResultCode::ErrorDef`]).
#[must_use]
pub fn result_text(result: ResultCode) -> &'static str {
    // SAFETY: texts of the library stay.
    unsafe { text(sys::kiriGetResultText(result as i32)) }
}

/// For hosts that would rather think in time than in items: the budget whose work would have taken
/// so many microseconds a tick at the pace of the profile, which may be the sum of several. Work on
/// cuts and linear systems share the time as they did in the profile, and each of triangles, cells
/// and samples gets what the three took together, see [`Budget`]. Each item that the profile has
/// some of is set; others stay. The simulation never reads a clock: the choice is the host's, and a
/// replay must hand in the same budgets.
pub fn fit_budget(profile: &Profile, microseconds: f32, budget: &mut Budget) -> Result<()> {
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriFitBudget(&profile.raw(), microseconds, std::ptr::from_mut(budget).cast()) })?;
    Ok(())
}

/// The name of a stage, for tables; "" for a number that is none.
#[must_use]
pub fn stage_name(stage: Stage) -> &'static str {
    // SAFETY: texts of the library stay.
    unsafe { text(sys::kiriGetStageName(stage as i32)) }
}

/// The numbers of a preset, KIRI_MATERIAL_...
pub fn material(preset: MaterialPreset) -> Result<Material> {
    let mut material = MaybeUninit::<sys::kiriMaterial>::uninit();
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriGetMaterial(preset as i32, material.as_mut_ptr()) })?;
    // SAFETY: it filled the struct.
    let material = unsafe { material.assume_init() };
    Ok(Material::from_raw(&material))
}

/// The numbers of a preset, KIRI_QUALITY_...
pub fn quality(preset: QualityPreset) -> Result<Quality> {
    let mut quality = MaybeUninit::<sys::kiriQuality>::uninit();
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriGetQuality(preset as i32, quality.as_mut_ptr()) })?;
    // SAFETY: it filled the struct.
    let quality = unsafe { quality.assume_init() };
    Ok(Quality::from_raw(&quality))
}

/// A rectangle from (0, 0) to (width, height) for a sheet def: writes 2 \* (columns + 1) \* (rows +
/// 1) floats and 6 \* columns \* rows indices. columns and rows are 1 to 4096.
pub fn fill_rectangle(width: f32, height: f32, columns: i32, rows: i32) -> Result<(Vec<[f32; 2]>, Vec<[i32; 3]>)> {
    let mut rest_positions = vec![[f32::default(); 2]; (2 * (columns.clamp(0, 4096) as usize + 1) * (rows.clamp(0, 4096) as usize + 1)) / 2];
    let mut indices = vec![[i32::default(); 3]; (6 * columns.clamp(0, 4096) as usize * rows.clamp(0, 4096) as usize) / 3];
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriFillRectangle(width, height, columns, rows, rest_positions.as_mut_ptr().cast(), indices.as_mut_ptr().cast()) })?;
    Ok((rest_positions, indices))
}

impl World {
    /// One fixed step of dt seconds (1e-6 to 10), solved in substeps equal parts (1 to 64). Takes
    /// the waiting cut points, then moves every sheet. [`ResultCode::Pending`]: the budget is spent
    /// and more work waits: the events say which cuts; a sheet, or some of its pieces, may also
    /// have stood still for want of iterations. [`ResultCode::ErrorMemory`]: nothing moved; cuts
    /// and pieces still wait, call again. Refused work is prepared again: until then
    /// [`Sheet::weights`] gives [`ResultCode::ErrorState`], and with a budget a cut may take effect
    /// some ticks later than it would have. [`ResultCode::ErrorLimit`]: the same, and it stays so
    /// until frames are destroyed. [`ResultCode::Diverged`]: the sheets named by the events were
    /// put to rest, the others moved. Work may wait then, too, as [`EventType::Deferred`] says.
    pub fn tick(&mut self, dt: f32, substeps: i32) -> Result<Status> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        let result = check(unsafe { sys::kiriWorld_Tick(self.raw_mut(), dt, substeps) }, self)?;
        Ok(Status::of(result))
    }

    /// m/s^2. All pieces wake.
    pub fn set_gravity(&mut self, gravity: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_SetGravity(self.raw_mut(), gravity.as_ptr()) }, self)?;
        Ok(())
    }

    /// Moves the origin of the world to a point (m): subtracts it from the positions of sheets,
    /// targets of pins and holds, obstacles, blades, and contacts that wait. The motion goes on as
    /// before, to rounding. Nothing wakes; (0, 0, 0) changes nothing. Use it in large worlds: far
    /// from the origin floats lose places. The host shifts its own data itself. Arrays that the
    /// library handed out keep the old positions until the next tick.
    /// [`ResultCode::ErrorArgument`]: a position would not fit a float.
    /// [`ResultCode::ErrorMemory`]: nothing has changed.
    pub fn shift_origin(&mut self, origin: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_ShiftOrigin(self.raw_mut(), origin.as_ptr()) }, self)?;
        Ok(())
    }

    /// Takes effect with the next tick.
    pub fn set_budget(&mut self, budget: &Budget) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_SetBudget(self.raw_mut(), &budget.raw()) }, self)?;
        Ok(())
    }

    /// A hash of everything that the coming ticks depend on, work that waits for its budget
    /// included: two worlds that got the same calls have the same hash, and two with the same hash
    /// go on alike. After a refused allocation some items are made again: the hash tells that while
    /// work waits, or while the budget limits cells or samples.
    pub fn state_hash(&self) -> Result<u64> {
        let mut hash: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriWorld_GetStateHash(self.raw(), &mut hash) })?;
        Ok(hash)
    }

    /// Writes up to capacity ids of the world's sheets, in the order of their making; \*count is
    /// how many there are.
    pub fn sheets(&self) -> Result<Vec<Sheet>> {
        let mut sheets = Vec::<Sheet>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriWorld_GetSheets(self.raw(), sheets.as_mut_ptr().cast(), capacity as i32, &mut count) })?;
            let needed = count as usize;
            if needed <= capacity {
                unsafe { sheets.set_len(needed) };
                break;
            }
            capacity = needed;
            sheets.reserve_exact(capacity);
        }
        Ok(sheets)
    }

    /// Puts some bytes of the host's own (1 to KIRI_MOST_NOTE_BYTES) in the recording, where a
    /// replay finds them: what its camera saw, what a player pressed. The world does not change;
    /// without a recording nothing happens.
    pub fn note(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_Note(self.raw_mut(), bytes.as_ptr().cast(), bytes.len() as i32) }, self)?;
        Ok(())
    }

    /// Writes the world, which only is read. \*size: bytes of the save. bytes null: they are
    /// counted only, and capacity is not read; else it has room for capacity.
    /// [`ResultCode::ErrorArgument`]: that is less than \*size; nothing is written.
    /// [`ResultCode::Pending`]: a cut is being worked on; \*size is 0, and nothing is written. Save
    /// after a later tick, or after [`World::finish_cuts`].
    pub fn save(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::<u8>::new();
        let mut size = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriWorld_Save(self.raw(), if capacity == 0 { std::ptr::null_mut() } else { bytes.as_mut_ptr().cast() }, capacity as i64, &mut size) })?;
            let needed = size as usize;
            if needed <= capacity {
                unsafe { bytes.set_len(needed) };
                break;
            }
            capacity = needed;
            bytes.reserve_exact(capacity);
        }
        Ok(bytes)
    }

    /// Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts
    /// that wait for a budget take effect. The next tick reports the events.
    /// [`ResultCode::ErrorMemory`], [`ResultCode::ErrorLimit`]: as in [`World::tick`]. Arrays that
    /// the world handed out end as with a tick.
    pub fn finish_cuts(&mut self) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_FinishCuts(self.raw_mut()) }, self)?;
        Ok(())
    }

    /// Replaces the world by a saved one. It may have any hooks; its own allocation, log, clock and
    /// tasks stay. The bytes may come from anybody: a malicious save may give a strange world but
    /// cannot crash the program, and takes memory in proportion to its size. Takes about as long as
    /// to create the sheets. The profile has no times until the next tick. Arrays that the old
    /// world handed out live until then. [`ResultCode::ErrorData`]: the bytes are not a save,
    /// damaged, or of another version. [`ResultCode::ErrorMemory`]. Then nothing has changed. A
    /// recording has the bytes, up to 2^31 of them.
    pub fn load(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_Load(self.raw_mut(), bytes.as_ptr().cast(), bytes.len() as i64) }, self)?;
        Ok(())
    }

    /// For rollback: copies all of the world, also work on cuts and pieces that wait, into memory
    /// of the host. Much faster than a save, and exact to the bit. The bytes are good for this
    /// process only: never store or send them. Arguments as of [`World::save`].
    pub fn snapshot(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::<u8>::new();
        let mut size = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriWorld_Snapshot(self.raw(), if capacity == 0 { std::ptr::null_mut() } else { bytes.as_mut_ptr().cast() }, capacity as i64, &mut size) })?;
            let needed = size as usize;
            if needed <= capacity {
                unsafe { bytes.set_len(needed) };
                break;
            }
            capacity = needed;
            bytes.reserve_exact(capacity);
        }
        Ok(bytes)
    }

    /// Replaces the world by the world of the snapshot; ids name the same things. The bytes are
    /// trusted: hand over only the output of [`World::snapshot`]. [`ResultCode::ErrorData`]: not a
    /// snapshot of this build of the library. [`ResultCode::ErrorMemory`].
    /// [`ResultCode::ErrorState`]: the world is recorded. Then nothing has changed. Hooks and
    /// arrays as with [`World::load`].
    pub fn restore(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_Restore(self.raw_mut(), bytes.as_ptr().cast(), bytes.len() as i64) }, self)?;
        Ok(())
    }

    /// Of the last tick that was not refused.
    pub fn profile(&self) -> Result<Profile> {
        let mut profile = MaybeUninit::<sys::kiriProfile>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriWorld_GetProfile(self.raw(), profile.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let profile = unsafe { profile.assume_init() };
        Ok(Profile::from_raw(&profile))
    }

    /// Adds a sheet. On failure \*sheet is 0. [`ResultCode::ErrorMesh`]: the triangles do not form
    /// a sheet. The line names a triangle, or the two triangles at an edge, by their numbers in the
    /// def, and says why.
    pub fn create_sheet(&mut self, def: &SheetDef<'_>) -> Result<Sheet> {
        let mut sheet = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateSheet(self.raw_mut(), &def.raw(), &mut sheet) }, self)?;
        Ok(Sheet::known(sheet))
    }

    /// A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 \*
    /// columns \* rows triangles; columns and rows are 1 to 4096. def: all but the mesh, which is
    /// not read; null: the defaults. A recording has it as [`World::create_sheet`].
    pub fn create_rectangle(&mut self, width: f32, height: f32, columns: i32, rows: i32, def: Option<&SheetDef<'_>>) -> Result<Sheet> {
        let def = def.map(|def| def.raw());
        let mut sheet = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateRectangle(self.raw_mut(), width, height, columns, rows, def.as_ref().map_or(std::ptr::null(), |def| def), &mut sheet) }, self)?;
        Ok(Sheet::known(sheet))
    }

    /// The first sheet that a ray meets; \*sheet is 0 where there is none.
    pub fn raycast(&self, origin: [f32; 3], direction: [f32; 3], max_distance: f32) -> Result<Option<(Sheet, Hit)>> {
        let mut sheet = 0;
        let mut hit = MaybeUninit::<sys::kiriHit>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriWorld_Raycast(self.raw(), origin.as_ptr(), direction.as_ptr(), max_distance, &mut sheet, hit.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let hit = unsafe { hit.assume_init() };
        Ok((hit.triangle >= 0).then(|| (Sheet::known(sheet), Hit::from_raw(&hit))))
    }

    /// The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames
    /// of one piece count once. Where one is refused, none goes. [`ResultCode::Pending`]: some
    /// wait, those of one sheet together. detached\[i\] is the sheet that the piece of frames\[i\]
    /// has become, 0 where it waits.
    pub fn detach_pieces(&mut self, frames: &[Frame]) -> Result<Vec<Option<Sheet>>> {
        let mut detached = vec![None::<Sheet>; frames.len()];
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_DetachPieces(self.raw_mut(), frames.as_ptr().cast(), frames.len() as i32, detached.as_mut_ptr().cast()) }, self)?;
        Ok(detached)
    }

    /// The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames
    /// of one piece count once. Where one is refused, none goes. [`ResultCode::Pending`]: some
    /// wait, those of one sheet together. detached\[i\] is the sheet that the piece of frames\[i\]
    /// has become, 0 where it waits.
    pub fn destroy_pieces(&mut self, frames: &[Frame]) -> Result<Status> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        let result = check(unsafe { sys::kiriWorld_DestroyPieces(self.raw_mut(), frames.as_ptr().cast(), frames.len() as i32) }, self)?;
        Ok(Status::of(result))
    }

    /// sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of
    /// their own. A blade for one sheet whose sheet is gone cuts nothing.
    pub fn begin_blade(&mut self, sheet: Option<Sheet>) -> Result<Blade> {
        let mut blade = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBeginBlade(self.raw_mut(), sheet.map_or(0, |id| id.raw()), &mut blade) }, self)?;
        Ok(Blade::known(blade))
    }

    /// Adds an obstacle. On failure \*obstacle is 0.
    pub fn create_obstacle(&mut self, def: &ObstacleDef<'_>) -> Result<Obstacle> {
        let mut obstacle = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateObstacle(self.raw_mut(), &def.raw(), &mut obstacle) }, self)?;
        Ok(Obstacle::known(obstacle))
    }
}

impl Sheet {
    /// The sheet is gone, with its cuts, frames and pins; their ids are stale.
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroySheet(world.raw_mut(), self.raw()) }, world)?;
        Ok(())
    }

    /// What they are now, stamped for [`Sheet::set_settings`].
    pub fn settings(self, world: &World) -> Result<SheetSettings> {
        let mut settings = MaybeUninit::<sys::kiriSheetSettings>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetSettings(world.raw(), self.raw(), settings.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let settings = unsafe { settings.assume_init() };
        Ok(SheetSettings::from_raw(&settings))
    }

    /// Checked as the def is: all or nothing. [`ResultCode::ErrorDef`]: they did not come from
    /// GetSettings. The sheet wakes where one is other than before. Places and velocities stay:
    /// with another mass so momentum changes. Stiffnesses that pins have, and the lengths that
    /// frames were spread by, stay as they are.
    pub fn set_settings(self, world: &mut World, settings: &SheetSettings) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetSettings(world.raw_mut(), self.raw(), &settings.raw()) }, world)?;
        Ok(())
    }

    /// The arrays, without a copy.
    pub fn mesh(self, world: &World) -> Result<Mesh<'_>> {
        let mut mesh = MaybeUninit::<sys::kiriMesh>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetMesh(world.raw(), self.raw(), mesh.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let mesh = unsafe { mesh.assume_init() };
        Ok(Mesh::from_raw(&mesh))
    }

    /// What changed since the host saw that revision; all of the mesh where that is too long ago,
    /// or 0.
    pub fn dirty(self, world: &World, since_revision: u32) -> Result<Dirty> {
        let mut dirty = MaybeUninit::<sys::kiriDirty>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetDirty(world.raw(), self.raw(), since_revision, dirty.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let dirty = unsafe { dirty.assume_init() };
        Ok(Dirty::from_raw(&dirty))
    }

    /// Copies the index that some vertices had when the last call of [`World::tick`] began, for
    /// hosts that draw between two ticks. \*from: the sheet that had them then, which is another
    /// one if this sheet was a piece of it. A vertex that a cut tore off another one gets the index
    /// of the other. -1: the vertex did not exist; so all vertices of a sheet that was created or
    /// loaded since. The manual has the code (drawing).
    pub fn copy_previous(self, world: &World, first: i32, vertices: &mut [i32]) -> Result<Sheet> {
        let mut from = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopyPrevious(world.raw(), self.raw(), first, vertices.len() as i32, vertices.as_mut_ptr().cast(), &mut from) })?;
        Ok(Sheet::known(from))
    }

    /// Copies the indices of some triangles, 3 each, as 16-bit numbers. [`ResultCode::ErrorState`]:
    /// there are more than 65535 vertices.
    pub fn copy_indices16(self, world: &World, first_triangle: i32, indices: &mut [[u16; 3]]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopyIndices16(world.raw(), self.raw(), first_triangle, indices.len() as i32, indices.as_mut_ptr().cast()) })?;
        Ok(())
    }

    /// Map triangles to the def, to draw with data that the host keeps by its own vertices.
    /// Sources: the triangle of the def that contains each; -1 for one that has left (its corners
    /// are equal). Weights: 9 floats each, the barycentric coordinates of its three corners in that
    /// triangle. They are right on both sides of a seam that `weld_distance` has closed;
    /// `source_triangles` name a triangle on one side. The manual has the code (meshes).
    pub fn copy_sources(self, world: &World, first_triangle: i32, sources: &mut [i32]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopySources(world.raw(), self.raw(), first_triangle, sources.len() as i32, sources.as_mut_ptr().cast()) })?;
        Ok(())
    }

    /// Map triangles to the def, to draw with data that the host keeps by its own vertices.
    /// Sources: the triangle of the def that contains each; -1 for one that has left (its corners
    /// are equal). Weights: 9 floats each, the barycentric coordinates of its three corners in that
    /// triangle. They are right on both sides of a seam that `weld_distance` has closed;
    /// `source_triangles` name a triangle on one side. The manual has the code (meshes).
    pub fn copy_source_weights(self, world: &World, first_triangle: i32, weights: &mut [[f32; 9]]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopySourceWeights(world.raw(), self.raw(), first_triangle, weights.len() as i32, weights.as_mut_ptr().cast()) })?;
        Ok(())
    }

    /// thickness: m, 0: that of the material. Made when it is asked for.
    pub fn solid(self, world: &mut World, thickness: f32) -> Result<Solid<'_>> {
        let mut solid = MaybeUninit::<sys::kiriSolid>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetSolid(world.raw_mut(), self.raw(), thickness, solid.as_mut_ptr()) }, world)?;
        // SAFETY: it filled the struct.
        let solid = unsafe { solid.assume_init() };
        Ok(Solid::from_raw(&solid))
    }

    /// Collision points: 3 floats of position (m, world) a point.
    pub fn collision_points(self, world: &World) -> Result<&[[f32; 3]]> {
        let mut positions = std::ptr::null();
        let mut count = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetCollisionPoints(world.raw(), self.raw(), &mut positions, &mut count) })?;
        Ok(unsafe { view(positions, count) })
    }

    /// Costs nothing.
    pub fn counts(self, world: &World) -> Result<Counts> {
        let mut counts = MaybeUninit::<sys::kiriCounts>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetCounts(world.raw(), self.raw(), counts.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let counts = unsafe { counts.assume_init() };
        Ok(Counts::from_raw(&counts))
    }

    /// Sums over the frames, made when they are asked for.
    pub fn totals(self, world: &World) -> Result<Totals> {
        let mut totals = MaybeUninit::<sys::kiriTotals>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetTotals(world.raw(), self.raw(), totals.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let totals = unsafe { totals.assume_init() };
        Ok(Totals::from_raw(&totals))
    }

    /// An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly:
    /// rms distance from where a sheet of very many frames would be under the same loads, over the
    /// rms way that it has gone from its flat shape; 0 to 1, and 1 where there are too few frames
    /// to tell. It compares the strains of neighbouring links ([`Model::Links`] only; else
    /// [`ResultCode::ErrorState`]). Measured on cantilevers and on a sheet with a slit, of 3 to 140
    /// frames, it is not below a third of the error, and not above four times the error or, where
    /// that is below 0.5 %, 1.5 %. Where a sheet also turned as a whole, as by hanging from two
    /// corners, it says up to ten times too much. It knows nothing of errors of the grid, of time
    /// stepping, and of loads that are finer than frames. It takes memory and time for one pass
    /// over the links, when it is called.
    pub fn estimate_error(self, world: &World) -> Result<f64> {
        let mut relative: f64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_EstimateError(world.raw(), self.raw(), &mut relative) })?;
        Ok(relative)
    }

    /// \*awake is 0 where all pieces of the sheet sleep, see `sleep_speed`; [`PieceState`] says
    /// which do. [`Sheet::wake`] wakes all of them.
    pub fn is_awake(self, world: &World) -> Result<bool> {
        let mut awake: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_IsAwake(world.raw(), self.raw(), &mut awake) })?;
        Ok(awake != 0)
    }

    /// \*awake is 0 where all pieces of the sheet sleep, see `sleep_speed`; [`PieceState`] says
    /// which do. [`Sheet::wake`] wakes all of them.
    pub fn wake(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Wake(world.raw_mut(), self.raw()) }, world)?;
        Ok(())
    }

    /// Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities
    /// turn. The columns of rotation are where R takes the axes of the world; a planar sheet turns
    /// about its normal only. It wakes. Targets of its pins, hinges, clamps and holds go along, so
    /// nothing draws it back. To set a target to its current value changes nothing. A target that
    /// the host has set nearer to the new place of the pin than to the old one stays: so the host
    /// may set targets before or after. Pins on an obstacle stay on it: put the obstacle elsewhere
    /// by the same motion ([`Obstacle::set_pose`]), before or after. Loads and contacts that wait
    /// for the next tick stay.
    pub fn transform(self, world: &mut World, rotation: [f32; 9], translation: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Transform(world.raw_mut(), self.raw(), rotation.as_ptr(), translation.as_ptr()) }, world)?;
        Ok(())
    }

    /// From now on it moves as a rigid body, until forces change that: velocity (m/s) of its centre
    /// of mass, and `angular_velocity` (rad/s) about it. What a planar sheet has across its plane
    /// is dropped; held frames follow their hold. [`Frame::set_piece_velocity`]: of the piece with
    /// that frame alone.
    pub fn set_velocity(self, world: &mut World, velocity: [f32; 3], angular_velocity: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetVelocity(world.raw_mut(), self.raw(), velocity.as_ptr(), angular_velocity.as_ptr()) }, world)?;
        Ok(())
    }

    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that [`Frame::detach_piece`] makes has that of the sheet it came from. A piece has
    /// one, named by any of its frames: the parts of a piece that is cut have that of the piece, as
    /// does a sheet that is made of it.
    pub fn set_user_data(self, world: &mut World, data: u64) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetUserData(world.raw_mut(), self.raw(), data) }, world)?;
        Ok(())
    }

    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that [`Frame::detach_piece`] makes has that of the sheet it came from. A piece has
    /// one, named by any of its frames: the parts of a piece that is cut have that of the piece, as
    /// does a sheet that is made of it.
    pub fn user_data(self, world: &World) -> Result<u64> {
        let mut data: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetUserData(world.raw(), self.raw(), &mut data) })?;
        Ok(data)
    }

    /// Where a ray first meets the sheet, up to `max_distance`. [`ResultCode::Ok`] with
    /// hit-\>triangle = -1: nowhere. The first ray looks at every triangle; the next tick makes
    /// boxes over them, and as long as somebody asks every now and then (in 120 ticks) they follow
    /// the sheet: a ray takes some microseconds, and a tick of a large sheet a quarter more.
    pub fn raycast(self, world: &World, origin: [f32; 3], direction: [f32; 3], max_distance: f32) -> Result<Option<Hit>> {
        let mut hit = MaybeUninit::<sys::kiriHit>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_Raycast(world.raw(), self.raw(), origin.as_ptr(), direction.as_ptr(), max_distance, hit.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let hit = unsafe { hit.assume_init() };
        Ok((hit.triangle >= 0).then(|| Hit::from_raw(&hit)))
    }

    /// Outside the sheet: [`ResultCode::ErrorArgument`]. On a cut, the lip that holds the point;
    /// either where both do.
    pub fn point(self, world: &World, rest_point: [f32; 2]) -> Result<PointState> {
        let mut state = MaybeUninit::<sys::kiriPointState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetPoint(world.raw(), self.raw(), rest_point.as_ptr(), state.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(PointState::from_raw(&state))
    }

    /// The shape functions at a rest point: up to capacity frames with their weights (sum 1) and,
    /// unless null, gradients (2 floats a frame, 1/m). \*count is how many there are, however many
    /// fit. Outside the sheet: [`ResultCode::ErrorArgument`]; while work on a cut waits for its
    /// budget: [`ResultCode::ErrorState`].
    pub fn weights(self, world: &World, rest_point: [f32; 2]) -> Result<(Vec<Frame>, Vec<f32>, Vec<[f32; 2]>)> {
        let mut frames = Vec::<Frame>::new();
        let mut weights = Vec::<f32>::new();
        let mut gradients = Vec::<[f32; 2]>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriSheet_GetWeights(world.raw(), self.raw(), rest_point.as_ptr(), frames.as_mut_ptr().cast(), weights.as_mut_ptr().cast(), gradients.as_mut_ptr().cast(), capacity as i32, &mut count) })?;
            let needed = count as usize;
            if needed <= capacity {
                unsafe { frames.set_len(needed) };
                unsafe { weights.set_len(needed) };
                unsafe { gradients.set_len(needed) };
                break;
            }
            capacity = needed;
            frames.reserve_exact(capacity);
            weights.reserve_exact(capacity);
            gradients.reserve_exact(capacity);
        }
        Ok((frames, weights, gradients))
    }

    /// The first of these calls after a cut sorts the sheet by pieces, which may fail with
    /// [`ResultCode::ErrorMemory`]. An index that is no piece's: [`ResultCode::ErrorArgument`].
    pub fn piece(self, world: &mut World, piece: i32) -> Result<PieceState> {
        let mut state = MaybeUninit::<sys::kiriPieceState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetPiece(world.raw_mut(), self.raw(), piece, state.as_mut_ptr()) }, world)?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(PieceState::from_raw(&state))
    }

    /// The first of these calls after a cut sorts the sheet by pieces, which may fail with
    /// [`ResultCode::ErrorMemory`]. An index that is no piece's: [`ResultCode::ErrorArgument`].
    pub fn piece_mesh(self, world: &mut World, piece: i32) -> Result<PieceMesh<'_>> {
        let mut mesh = MaybeUninit::<sys::kiriPieceMesh>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetPieceMesh(world.raw_mut(), self.raw(), piece, mesh.as_mut_ptr()) }, world)?;
        // SAFETY: it filled the struct.
        let mesh = unsafe { mesh.assume_init() };
        Ok(PieceMesh::from_raw(&mesh))
    }

    /// \*frames points to \*count ids.
    pub fn piece_frames(self, world: &mut World, piece: i32) -> Result<&[Frame]> {
        let mut frames = std::ptr::null();
        let mut count = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetPieceFrames(world.raw_mut(), self.raw(), piece, &mut frames, &mut count) }, world)?;
        Ok(unsafe { view(frames, count) })
    }

    /// Destroys all pieces below an area (m^2) except the largest piece, at the cost of one.
    /// \*count is how many. Where that one waits to become a sheet, the largest of the others
    /// stays, too.
    pub fn drop_crumbs(self, world: &mut World, area: f32) -> Result<i32> {
        let mut count: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_DropCrumbs(world.raw_mut(), self.raw(), area, &mut count) }, world)?;
        Ok(count)
    }

    /// A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet
    /// cuts nothing. Points wait until the next tick. The end of a cut that lies inside the sheet
    /// stays closed until the blade moves on.
    pub fn begin_cut(self, world: &mut World, rest_point: [f32; 2]) -> Result<Cut> {
        let mut cut = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBeginCut(world.raw_mut(), self.raw(), rest_point.as_ptr(), &mut cut) }, world)?;
        Ok(Cut::known(cut))
    }

    /// A blade (a straight edge) that moves in world space from blade\[0\]-blade\[1\] to
    /// blade\[3\]-blade\[2\] cuts where the swept quadrilateral meets the sheet as it is now, past
    /// borders, so that it parts what it crosses. The cut is ended already. Slices of a sheet that
    /// moves do not join from tick to tick: for that take a blade.
    pub fn slice(self, world: &mut World, blade: [f32; 12]) -> Result<Cut> {
        let mut cut = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Slice(world.raw_mut(), self.raw(), blade.as_ptr(), &mut cut) }, world)?;
        Ok(Cut::known(cut))
    }

    /// Writes up to capacity ids of the sheet's frames; \*count is how many there are.
    pub fn frames(self, world: &World) -> Result<Vec<Frame>> {
        let mut frames = Vec::<Frame>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriSheet_GetFrames(world.raw(), self.raw(), frames.as_mut_ptr().cast(), capacity as i32, &mut count) })?;
            let needed = count as usize;
            if needed <= capacity {
                unsafe { frames.set_len(needed) };
                break;
            }
            capacity = needed;
            frames.reserve_exact(capacity);
        }
        Ok(frames)
    }

    /// A force (N, world) on a point of the material and a torque (N m).
    pub fn apply_force(self, world: &mut World, rest_point: [f32; 2], force: [f32; 3], torque: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyForce(world.raw_mut(), self.raw(), rest_point.as_ptr(), force.as_ptr(), torque.as_ptr()) }, world)?;
        Ok(())
    }

    /// A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in
    /// the material, edges included. Where it runs along a cut, each lip gets half. The ends
    /// differ; a line that meets no material: [`ResultCode::ErrorArgument`].
    pub fn apply_line_load(self, world: &mut World, from: [f32; 2], to: [f32; 2], force_per_length: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyLineLoad(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr(), force_per_length.as_ptr()) }, world)?;
        Ok(())
    }

    /// A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0.
    pub fn apply_pressure(self, world: &mut World, pressure: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyPressure(world.raw_mut(), self.raw(), pressure) }, world)?;
        Ok(())
    }

    /// An impulse (N s, world) on a point of the material, where it is seen now. Velocities change
    /// at once, by as much as the frames that carry the point resist; a held frame's part is lost.
    /// Outside the sheet: [`ResultCode::ErrorArgument`].
    pub fn apply_impulse(self, world: &mut World, rest_point: [f32; 2], impulse: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyImpulse(world.raw_mut(), self.raw(), rest_point.as_ptr(), impulse.as_ptr()) }, world)?;
        Ok(())
    }

    /// Copied; it blows until the next call.
    pub fn set_wind(self, world: &mut World, wind: &Wind) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetWind(world.raw_mut(), self.raw(), &wind.raw()) }, world)?;
        Ok(())
    }

    /// Pins a point of the sheet. On failure \*pin is 0. A point outside the sheet:
    /// [`ResultCode::ErrorArgument`].
    pub fn create_pin(self, world: &mut World, def: &PinDef) -> Result<Pin> {
        let mut pin = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreatePin(world.raw_mut(), self.raw(), &def.raw(), &mut pin) }, world)?;
        Ok(Pin::known(pin))
    }

    /// Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp
    /// holds place and direction of the material there, as a vice does; a hinge its place only, so
    /// that the sheet may turn about the line. Both begin where the material is now; the line stays
    /// straight, and as long as it is at rest: so material that is bent there is pulled straight,
    /// and pieces that have come apart are pulled together, however fast that makes them.
    ///
    /// They hold what the line meets, edges included, with the stiffness that the material has
    /// between the line and the frames that it meets. So a clamp along an edge is where the drawing
    /// has it, whatever the number of frames, where [`Frame::hold`] clamps at a frame's site. A
    /// clamp through the sheet parts what is on its two sides, so that neither bends the other. A
    /// line that runs along a cut holds both lips; one beside it, by a 512th of a square of the
    /// grid or more, holds one. The ends differ; a line that meets no material:
    /// [`ResultCode::ErrorArgument`].
    pub fn clamp_line(self, world: &mut World, from: [f32; 2], to: [f32; 2]) -> Result<Pin> {
        let mut clamp = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ClampLine(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr(), &mut clamp) }, world)?;
        Ok(Pin::known(clamp))
    }

    /// Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp
    /// holds place and direction of the material there, as a vice does; a hinge its place only, so
    /// that the sheet may turn about the line. Both begin where the material is now; the line stays
    /// straight, and as long as it is at rest: so material that is bent there is pulled straight,
    /// and pieces that have come apart are pulled together, however fast that makes them.
    ///
    /// They hold what the line meets, edges included, with the stiffness that the material has
    /// between the line and the frames that it meets. So a clamp along an edge is where the drawing
    /// has it, whatever the number of frames, where [`Frame::hold`] clamps at a frame's site. A
    /// clamp through the sheet parts what is on its two sides, so that neither bends the other. A
    /// line that runs along a cut holds both lips; one beside it, by a 512th of a square of the
    /// grid or more, holds one. The ends differ; a line that meets no material:
    /// [`ResultCode::ErrorArgument`].
    pub fn hinge_line(self, world: &mut World, from: [f32; 2], to: [f32; 2]) -> Result<Pin> {
        let mut hinge = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_HingeLine(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr(), &mut hinge) }, world)?;
        Ok(Pin::known(hinge))
    }

    /// Writes up to capacity ids of the sheet's pins, of all types; \*count is how many there are.
    pub fn pins(self, world: &World) -> Result<Vec<Pin>> {
        let mut pins = Vec::<Pin>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriSheet_GetPins(world.raw(), self.raw(), pins.as_mut_ptr().cast(), capacity as i32, &mut count) })?;
            let needed = count as usize;
            if needed <= capacity {
                unsafe { pins.set_len(needed) };
                break;
            }
            capacity = needed;
            pins.reserve_exact(capacity);
        }
        Ok(pins)
    }

    /// The contacts of the next tick; they replace those of an earlier call, and are gone after the
    /// tick. A contact is known again by its point, or its rest point, and its obstacle: what it
    /// pushed with is where the next tick starts.
    pub fn set_contacts(self, world: &mut World, contacts: &[Contact]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetContacts(world.raw_mut(), self.raw(), contacts.as_ptr().cast(), contacts.len() as i32) }, world)?;
        Ok(())
    }

    /// One for each contact that was set before the last tick, in the order given. The sum of the
    /// impulses, with those of gravity, loads and obstacles, is the change of momentum of a piece
    /// that nothing holds. A piece that sleeps goes on to press with what it fell asleep with.
    pub fn contact_forces(self, world: &World) -> Result<&[ContactForce]> {
        let mut forces = std::ptr::null();
        let mut count = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetContactForces(world.raw(), self.raw(), &mut forces, &mut count) })?;
        Ok(unsafe { view(forces, count) })
    }

    /// The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no
    /// obstacles or contacts outside. It reaches as far around the sheet as its fastest point can
    /// go by its velocity and gravity, twice, and the contact thickness. Obstacles that move
    /// themselves come as much nearer. dt as in [`World::tick`].
    pub fn reach(self, world: &World, dt: f32) -> Result<([f32; 3], [f32; 3])> {
        let mut lower: [f32; 3] = Default::default();
        let mut upper: [f32; 3] = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetReach(world.raw(), self.raw(), dt, lower.as_mut_ptr(), upper.as_mut_ptr()) })?;
        Ok((lower, upper))
    }
}

impl Frame {
    /// From now on it moves as a rigid body, until forces change that: velocity (m/s) of its centre
    /// of mass, and `angular_velocity` (rad/s) about it. What a planar sheet has across its plane
    /// is dropped; held frames follow their hold. [`Frame::set_piece_velocity`]: of the piece with
    /// that frame alone.
    pub fn set_piece_velocity(self, world: &mut World, velocity: [f32; 3], angular_velocity: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_SetPieceVelocity(world.raw_mut(), self.raw(), velocity.as_ptr(), angular_velocity.as_ptr()) }, world)?;
        Ok(())
    }

    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that [`Frame::detach_piece`] makes has that of the sheet it came from. A piece has
    /// one, named by any of its frames: the parts of a piece that is cut have that of the piece, as
    /// does a sheet that is made of it.
    pub fn set_piece_user_data(self, world: &mut World, data: u64) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_SetPieceUserData(world.raw_mut(), self.raw(), data) }, world)?;
        Ok(())
    }

    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that [`Frame::detach_piece`] makes has that of the sheet it came from. A piece has
    /// one, named by any of its frames: the parts of a piece that is cut have that of the piece, as
    /// does a sheet that is made of it.
    pub fn piece_user_data(self, world: &World) -> Result<u64> {
        let mut data: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetPieceUserData(world.raw(), self.raw(), &mut data) })?;
        Ok(data)
    }

    /// The index that the piece with this frame has now.
    pub fn piece(self, world: &World) -> Result<i32> {
        let mut piece: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetPiece(world.raw(), self.raw(), &mut piece) })?;
        Ok(piece)
    }

    /// Makes a sheet of the piece with this frame. Its frames, pins and collision points move
    /// along, in their order; they keep their ids and states, and what waits for the next tick: the
    /// motion goes on as if nothing had happened, but for the solver's guard over energy and step
    /// length, which is one for each sheet. A clamp or hinge that holds both becomes two: the rest
    /// keeps the id, the new sheet's has one of its own ([`Sheet::pins`]). Both sheets have all
    /// settings (of `collision_points` and `integration_points` the share that falls to their
    /// area), `max_frames` each for itself; a piece that sleeps goes on sleeping. Cuts stay with
    /// the rest: a blade in the piece cuts nothing until it is back. Indices of collision points of
    /// the rest change. Its triangles and vertices keep their indices where it has more than 4096
    /// vertices, and while no more than half of them are of pieces that went: these triangles have
    /// three equal corners, these vertices are of no triangle. Else all move together, and their
    /// indices change. In either case its revision grows, and [`Sheet::dirty`] says what changed.
    /// The new sheet has the squares of the grid around it, at about 40 bytes a square: crumbs are
    /// better dropped. Costs what the piece takes to make, and a look at the weights of what is
    /// left; where indices change more. [`ResultCode::Pending`]: work on a cut is at hand in the
    /// sheet, or it takes more samples than the budget leaves calls before the next tick;
    /// \*detached is 0. When the work is done, what is the piece of this frame then becomes a
    /// sheet, and [`EventType::PieceDetached`] names it. Samples pay for it before, over several
    /// ticks if need be, of many pieces one after the other: of the first that waits 3 for each
    /// vertex, 2.5 to 9 for each cell (the more frames, the more) and 100 for each frame, of others
    /// 3 for each vertex and 1.4 for each cell; and one for 80 vertices of the rest. Until then
    /// further cuts of the sheet wait. The first piece is made as it is paid, and leaves at the
    /// start of the tick after the last sample is paid. That tick does an eighth of the work; the
    /// first tick after a load makes the parts again that saves leave out. The coming ticks have
    /// fewer samples for the work of calls. [`ResultCode::ErrorState`]: nothing would be left of
    /// the sheet.
    pub fn detach_piece(self, world: &mut World) -> Result<Option<Sheet>> {
        let mut detached = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_DetachPiece(world.raw_mut(), self.raw(), &mut detached) }, world)?;
        Ok(Sheet::from_raw(detached))
    }

    /// The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but
    /// for making a sheet: that is done at once, and the coming ticks have less. Where
    /// [`Sheet::mesh`] has been called since the last tick, all indices are copied.
    /// [`ResultCode::Pending`]: work on a cut is at hand. The piece is gone all the same: its
    /// triangles are in [`Mesh`], with three equal corners; it touches nothing; no point of it is
    /// found. When the work is done its vertices go, too; until then [`Counts`] still counts it,
    /// and its [`PieceState`] is all zeros.
    pub fn destroy_piece(self, world: &mut World) -> Result<Status> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        let result = check(unsafe { sys::kiriFrame_DestroyPiece(world.raw_mut(), self.raw()) }, world)?;
        Ok(Status::of(result))
    }

    /// Pose, motion and region as they are now.
    pub fn state(self, world: &World) -> Result<FrameState> {
        let mut state = MaybeUninit::<sys::kiriFrameState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetState(world.raw(), self.raw(), state.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(FrameState::from_raw(&state))
    }

    /// The host moves the frame: its rest point, as it is seen, goes to position with rotation (a
    /// rotation matrix, columns as above) in the next tick, evenly, and stays there until the next
    /// call. An affine frame is not stretched then. On a planar sheet the rotation is about its
    /// normal. Null, null: it is free again. Contacts do not push material that held frames carry
    /// for more than half: it goes where the host has it, through obstacles too.
    pub fn hold(self, world: &mut World, position: Option<[f32; 3]>, rotation: Option<[f32; 9]>) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_Hold(world.raw_mut(), self.raw(), position.as_ref().map_or(std::ptr::null(), |rows| rows.as_ptr()), rotation.as_ref().map_or(std::ptr::null(), |rows| rows.as_ptr())) }, world)?;
        Ok(())
    }

    /// With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the
    /// frame's rest point; means over the last tick, impulses divided by its dt. They carry the
    /// frame's own weight and change its momentum, too. Zero for a frame that was free. A piece
    /// that sleeps keeps those that it fell asleep with.
    pub fn reaction(self, world: &World) -> Result<([f64; 3], [f64; 3])> {
        let mut force: [f64; 3] = Default::default();
        let mut torque: [f64; 3] = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetReaction(world.raw(), self.raw(), force.as_mut_ptr(), torque.as_mut_ptr()) })?;
        Ok((force, torque))
    }

    /// A force (N, world) on the frame's centre of mass and a torque (N m).
    pub fn apply_force(self, world: &mut World, force: [f32; 3], torque: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_ApplyForce(world.raw_mut(), self.raw(), force.as_ptr(), torque.as_ptr()) }, world)?;
        Ok(())
    }
}

impl Pin {
    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that [`Frame::detach_piece`] makes has that of the sheet it came from. A piece has
    /// one, named by any of its frames: the parts of a piece that is cut have that of the piece, as
    /// does a sheet that is made of it.
    pub fn set_user_data(self, world: &mut World, data: u64) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetUserData(world.raw_mut(), self.raw(), data) }, world)?;
        Ok(())
    }

    /// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A
    /// sheet that [`Frame::detach_piece`] makes has that of the sheet it came from. A piece has
    /// one, named by any of its frames: the parts of a piece that is cut have that of the piece, as
    /// does a sheet that is made of it.
    pub fn user_data(self, world: &World) -> Result<u64> {
        let mut data: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriPin_GetUserData(world.raw(), self.raw(), &mut data) })?;
        Ok(data)
    }

    /// Where the pin holds its point, or the middle of its line (m, world): at the end of the next
    /// tick, and until the next call. Within the tick it goes there evenly. The current target of
    /// [`Pin::state`] changes nothing. With [`Skinning::Smooth`] what pins and clamps hold is what
    /// is seen there; of a clamp the mean along its line, for each piece: single points of the line
    /// are seen a little off it.
    pub fn set_target(self, world: &mut World, target: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetTarget(world.raw_mut(), self.raw(), target.as_ptr()) }, world)?;
        Ok(())
    }

    /// The same with the rotation of the line's material: columns are the directions of u and v and
    /// the normal. On a planar sheet it is about the sheet's normal. [`ResultCode::ErrorArgument`]
    /// for a pin that holds a point.
    pub fn set_pose(self, world: &mut World, target: [f32; 3], rotation: [f32; 9]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetPose(world.raw_mut(), self.raw(), target.as_ptr(), rotation.as_ptr()) }, world)?;
        Ok(())
    }

    /// As in the def, for pins of all types; N, 0: it never breaks.
    pub fn set_break_force(self, world: &mut World, break_force: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetBreakForce(world.raw_mut(), self.raw(), break_force) }, world)?;
        Ok(())
    }

    /// What it is, and where it holds now.
    pub fn state(self, world: &World) -> Result<PinState> {
        let mut state = MaybeUninit::<sys::kiriPinState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriPin_GetState(world.raw(), self.raw(), state.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(PinState::from_raw(&state))
    }

    /// With what the pin acted on the sheet: force (N, world) and torque (N m) about its target;
    /// means over the last tick, impulses divided by its dt. So the reactions of all pins and held
    /// frames are the weight of a sheet at rest, and in motion what changes its momentum (as far as
    /// iterations have the tick solved). Zero before the first tick. A piece that sleeps keeps
    /// those that it fell asleep with.
    pub fn reaction(self, world: &World) -> Result<([f64; 3], [f64; 3])> {
        let mut force: [f64; 3] = Default::default();
        let mut torque: [f64; 3] = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriPin_GetReaction(world.raw(), self.raw(), force.as_mut_ptr(), torque.as_mut_ptr()) })?;
        Ok((force, torque))
    }

    /// It lets go; its id is stale.
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroyPin(world.raw_mut(), self.raw()) }, world)?;
        Ok(())
    }
}

impl Cut {
    /// `rest_points`: 2 floats a point; count is 1 to 2^24.
    pub fn extend(self, world: &mut World, rest_points: &[[f32; 2]]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCut_Extend(world.raw_mut(), self.raw(), rest_points.as_ptr().cast(), rest_points.len() as i32) }, world)?;
        Ok(())
    }

    /// No more points come. After the tick in which the last of them takes effect the id is stale,
    /// and [`EventType::CutFinished`] tells. Frames that the sheet needs after the cut are added
    /// then.
    pub fn end(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCut_End(world.raw_mut(), self.raw()) }, world)?;
        Ok(())
    }
}

impl Blade {
    /// The blade is now the straight edge between two points (m, world). From where it was it got
    /// there straight, each end along a line. The first call only says where it begins. Where an
    /// end of the edge lies inside of what it sweeps of the sheet, it cuts only what it sweeps. An
    /// edge without length cuts nothing.
    pub fn move_edge(self, world: &mut World, from: [f32; 3], to: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBlade_MoveEdge(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr()) }, world)?;
        Ok(())
    }

    /// The same for a ray that a camera casts: an edge length m long.
    pub fn move_ray(self, world: &mut World, origin: [f32; 3], direction: [f32; 3], length: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBlade_MoveRay(world.raw_mut(), self.raw(), origin.as_ptr(), direction.as_ptr(), length) }, world)?;
        Ok(())
    }

    /// It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends.
    pub fn end(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBlade_End(world.raw_mut(), self.raw()) }, world)?;
        Ok(())
    }
}

impl Obstacle {
    /// It is gone, its id stale. What rested on it wakes.
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroyObstacle(world.raw_mut(), self.raw()) }, world)?;
        Ok(())
    }

    /// Where it is when the next tick starts. It did not move there: velocities alone say what
    /// sheets feel. rotation: a rotation matrix, columns as in the def.
    pub fn set_pose(self, world: &mut World, position: [f32; 3], rotation: [f32; 9]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetPose(world.raw_mut(), self.raw(), position.as_ptr(), rotation.as_ptr()) }, world)?;
        Ok(())
    }

    /// With what it moves in the next tick and from then on.
    pub fn set_velocity(self, world: &mut World, velocity: [f32; 3], angular_velocity: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetVelocity(world.raw_mut(), self.raw(), velocity.as_ptr(), angular_velocity.as_ptr()) }, world)?;
        Ok(())
    }

    /// With what it moves in the next tick and from then on.
    pub fn set_surface_velocity(self, world: &mut World, velocity: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetSurfaceVelocity(world.raw_mut(), self.raw(), velocity.as_ptr()) }, world)?;
        Ok(())
    }

    /// As in the def.
    pub fn set_mass(self, world: &mut World, mass: f32, inertia: [f32; 6], center_of_mass: [f32; 3]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetMass(world.raw_mut(), self.raw(), mass, inertia.as_ptr(), center_of_mass.as_ptr()) }, world)?;
        Ok(())
    }

    /// Pose and velocities as they are now.
    pub fn state(self, world: &World) -> Result<ObstacleState> {
        let mut state = MaybeUninit::<sys::kiriObstacleState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriObstacle_GetState(world.raw(), self.raw(), state.as_mut_ptr()) })?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(ObstacleState::from_raw(&state))
    }
}
