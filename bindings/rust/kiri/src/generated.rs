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

/// An id. It is of one world, and may be of something that is gone: then calls give
/// [`ResultCode::ErrorId`].
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Seam(NonZeroU32);

impl Seam {
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

/// Result code.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ResultCode {
    /// Ok.
    Ok = 0,
    /// success; work is left for later ticks
    Pending = 1,
    /// null, NaN, infinite, outside the documented range, or beyond 4e37 m, m/s or 1/s
    ErrorArgument = -1,
    /// the def was not filled by its kiriDefault function: call that first
    ErrorDef = -2,
    /// unknown or stale id, or the id of another kind
    ErrorId = -3,
    /// the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping
    ErrorMesh = -4,
    /// the call comes in the wrong order, or from a callback that may not make it
    ErrorState = -5,
    /// the allocator returned null
    ErrorMemory = -6,
    /// the motion of a sheet could not be continued; the sheet was stopped where it was
    Diverged = -7,
    /// all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world
    ErrorLimit = -8,
    /// floats are not computed as on other machines, see [`World::new`]
    ErrorBuild = -9,
    /// the bytes are damaged, cut short, of another kind, or of a later version
    ErrorData = -10,
    /// a repeated call gave another result than its recording has
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

/// Least triangles.
pub const LEAST_TRIANGLES: i32 = 16;

/// Most note bytes.
pub const MOST_NOTE_BYTES: i32 = 1048576;

/// Events since the start of the last tick that was not refused.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EventType {
    /// cut: all of it is in the mesh; the id is stale from now on
    CutFinished = 1,
    /// frame (its first, which names it), crumb, area: a part came off, never the largest
    PieceOff = 2,
    /// frame
    FrameAdded = 3,
    /// the sheet was stopped
    Diverged = 4,
    /// stage, waiting: the budget ended in this stage of the sheet's work
    Deferred = 5,
    /// pin: its force exceeded `break_force`; the id is stale from now on
    PinBroke = 6,
    /// sheet (the new one), frame, area: a pending [`Frame::detach_piece`] is done
    PieceDetached = 7,
    /// seam, stitches: some stitches broke; with none left the id is stale from now on
    SeamBroke = 8,
    /// cut: the library began it, see [`Tearing`]
    TearBegan = 9,
    /// cut: the tear has rested for half a second; the id is stale from now on
    TearEnded = 10,
    /// area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s
    Strained = 11,
}

impl EventType {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::CutFinished,
        Self::PieceOff,
        Self::FrameAdded,
        Self::Diverged,
        Self::Deferred,
        Self::PinBroke,
        Self::PieceDetached,
        Self::SeamBroke,
        Self::TearBegan,
        Self::TearEnded,
        Self::Strained,
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
    /// splits the mesh along the blade
    Cut = 0,
    /// cells and their connections
    Grid = 1,
    /// geodesic distances, regions, links; places frames
    Regions = 2,
    /// shape functions
    Shape = 3,
    /// weights of vertices and collision points
    Samples = 4,
    /// mass, the pattern of the solver's matrix, and the commit
    Constants = 5,
    /// contacts with obstacles, other sheets and other pieces
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

/// Materials to start from; src/world/kiri_api_world.c has the sources. From SILK on: measured
/// cloths (manual, sheets)
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
    /// paperboard, 0.4 mm
    Card = 4,
    /// Silk.
    Silk = 5,
    /// Shirting.
    Shirting = 6,
    /// Wool.
    Wool = 7,
    /// Denim.
    Denim = 8,
    /// Jersey.
    Jersey = 9,
}

impl MaterialPreset {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Paper,
        Self::Cotton,
        Self::Rubber,
        Self::Foil,
        Self::Card,
        Self::Silk,
        Self::Shirting,
        Self::Wool,
        Self::Denim,
        Self::Jersey,
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

/// Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 %
/// (manual, accuracy).
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QualityPreset {
    /// Fast.
    Fast = 0,
    /// Balanced.
    Balanced = 1,
    /// Accurate.
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

/// Kinds of sheets to begin with. They want a tick of 1/60 s with 4 substeps; curtain and card do
/// with 2.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SetupPreset {
    /// Curtain.
    Curtain = 0,
    /// Paper.
    Paper = 1,
    /// Flag.
    Flag = 2,
    /// Ribbon.
    Ribbon = 3,
    /// Rubber.
    Rubber = 4,
    /// Card.
    Card = 5,
    /// Foil.
    Foil = 6,
}

impl SetupPreset {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Curtain,
        Self::Paper,
        Self::Flag,
        Self::Ribbon,
        Self::Rubber,
        Self::Card,
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

/// How a sheet deforms (manual, sheets). Rigid frames have 6 unknowns, affine ones 12.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Model {
    /// rigid frames joined by links: paper, foil, stiff cloth
    Links = 0,
    /// affine frames joined by links: cloth and rubber that stretch inside a region
    Affine = 1,
    /// affine frames, strains at integration points, as in the paper. Thin sheets hardly bend
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

/// The surface between the frames, which blades and contacts meet (manual, sheets).
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Skinning {
    /// each frame carries a flat patch; the weights blend them (equation 1 of the paper)
    Linear = 0,
    /// patches bend and stretch as their neighbours lie: no bumps at the frames
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

/// Integration in time, with one linear system an iteration. Steps with contacts or new pins take
/// backward Euler.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TimeStepping {
    /// TR-BDF2, of second order: keeps the energy of motion
    SecondOrder = 0,
    /// backward Euler, of first order: takes energy out of a swing, more in longer steps
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

/// The types of pins.
#[non_exhaustive]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinType {
    /// Point.
    Point = 0,
    /// Hinge.
    Hinge = 1,
    /// Clamp.
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

/// A body that sheets touch: a floor, a ball, a crate of another engine. It moves on with its
/// velocities alone: set pose and velocity before a tick, and apply the impulse of its state after
/// it (manual, contact). Lengths: up to 1e6 m.
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
    /// outline: convex, in the plane of the first two columns; height along the third, 0: endless
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

// The things to draw.
/// a triangle for each triangle of the mesh, in a colour of its piece; sleeping: pale
pub const DRAW_TRIANGLES: u32 = 1;
/// a line for each edge between two triangles
pub const DRAW_EDGES: u32 = 2;
/// a line for each edge of the outline, of lips and of folds
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
/// Draw all.
pub const DRAW_ALL: u32 = 2047;

/// Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share
/// one allowance: using 30 % of one leaves 70 % of the others. Other work goes on in the next tick.
/// The budget decides when a cut takes effect; the mesh, grid, regions, weights and sites of frames
/// after all work is done do not depend on it (manual, budget).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Budget {
    /// split by blades; 0, or KIRI_LEAST_TRIANGLES and more
    pub triangles: i32,
    /// visited, or with a new distance: grid, regions, shape functions. A link counts as a cell
    pub cells: i32,
    /// vertices and collision points with new weights, and the cost of the commit, paid before it
    pub samples: i32,
    /// linear systems, 30 to 60 us each; a large one counts as several (manual, budget)
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

/// Work and time of the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Profile {
    /// of the last tick; zero without a clock
    pub seconds: [f64; 9],
    /// blade segments that took effect
    pub cut_segments: i32,
    /// Items in the units of [`Budget`]. An item that takes more work counts more than once.
    pub triangles_split: i32,
    /// Items in the units of [`Budget`]. An item that takes more work counts more than once.
    pub cells_settled: i32,
    /// Items in the units of [`Budget`]. An item that takes more work counts more than once.
    pub samples_refreshed: i32,
    /// Items in the units of [`Budget`]. An item that takes more work counts more than once.
    pub solver_iterations: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: [`Counts`]).
    pub cells_changed: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: [`Counts`]).
    pub weights_changed: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: [`Counts`]).
    pub vertices_changed: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: [`Counts`]).
    pub points_changed: i32,
    /// Changes by commits: cells, weights of cells, of vertices and of collision points, links
    /// (totals: [`Counts`]).
    pub links_changed: i32,
    /// sheets in which a cut took effect; linear systems, large and small
    pub commits: i32,
    /// sheets in which a cut took effect; linear systems, large and small
    pub systems_solved: i32,
    /// planes given to the solver: by the host, by obstacles, and between sheets
    pub contacts: i32,
    /// pairs of sheets or pieces that are near each other and not both asleep
    pub sheet_pairs: i32,
    /// The longest jump of a vertex when a cut took effect, as without `fade_time`, and the longest
    /// way by a fade; m.
    pub largest_jump: f64,
    /// The longest jump of a vertex when a cut took effect, as without `fade_time`, and the longest
    /// way by a fade; m.
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

/// The material of a sheet: homogeneous, isotropic.
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
    /// 1/s, 0 or more: velocities fade to the air's, as exp(-`air_damping` t) (manual, sheets)
    pub air_damping: f32,
    /// s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
    pub flex_damping: f32,
    /// Pa, 0 or more: bends beyond it stay, but sharp dents need a [`Fold`]. [`Model::Links`], not
    /// planar
    pub yield_stress: f32,
    /// modulus beyond the yield stress, relative to `youngs_modulus`; 0 to below 1
    pub hardening: f32,
    /// 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets)
    pub slack: f32,
    /// sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0
    pub detail: i32,
    /// 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As `yield_stress`. Presets: 0
    pub rest_curvature: [f32; 3],
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
    assert!(offset_of!(Material, yield_stress) == offset_of!(sys::kiriMaterial, yieldStress));
    assert!(offset_of!(Material, hardening) == offset_of!(sys::kiriMaterial, hardening));
    assert!(offset_of!(Material, slack) == offset_of!(sys::kiriMaterial, slack));
    assert!(offset_of!(Material, detail) == offset_of!(sys::kiriMaterial, detail));
    assert!(offset_of!(Material, rest_curvature) == offset_of!(sys::kiriMaterial, restCurvature));
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

/// Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 %
/// (manual, accuracy).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Quality {
    /// control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9
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

/// Options of the paper, for comparison; part of the sheet def. Default 0, but for
/// `integration_order`.
#[derive(Clone, Copy, Debug)]
pub struct PaperOptions {
    /// 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits
    pub from_scratch: bool,
    /// 1: only new frames take their motion from the surface: it jumps, momentum is not kept
    pub popping: bool,
    /// 1: weights are linear between frames: a kink at each; always so with [`Model::Points`]
    pub linear_weights: bool,
    /// [`Model::Points`]: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four
    /// for each of `frame_count`. Strain around a point: of order 1, constant (default), or 2,
    /// linear: four times the work.
    pub integration_points: i32,
    /// [`Model::Points`]: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four
    /// for each of `frame_count`. Strain around a point: of order 1, constant (default), or 2,
    /// linear: four times the work.
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

/// A sheet: its rest shape, start, material, and computation.
#[derive(Clone, Copy, Debug)]
pub struct SheetDef<'a> {
    /// The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge;
    /// holes and several parts are allowed. Two edges in the same place with different vertices are
    /// the lips of a cut (manual, meshes). 2 floats (u, v) a vertex
    pub rest_positions: &'a [[f32; 2]],
    /// 3 a triangle
    pub indices: &'a [[i32; 3]],
    /// Start: x = position + u `axis_u` + v `axis_v` (m, world), with orthonormal axes; and
    /// velocity, m/s.
    pub position: [f32; 3],
    /// Start: x = position + u `axis_u` + v `axis_v` (m, world), with orthonormal axes; and
    /// velocity, m/s.
    pub axis_u: [f32; 3],
    /// Start: x = position + u `axis_u` + v `axis_v` (m, world), with orthonormal axes; and
    /// velocity, m/s.
    pub axis_v: [f32; 3],
    /// Start: x = position + u `axis_u` + v `axis_v` (m, world), with orthonormal axes; and
    /// velocity, m/s.
    pub velocity: [f32; 3],
    /// Material.
    pub material: Material,
    /// grid squares along the longer side, 1 to 4096; default 32
    pub grid_resolution: i32,
    /// m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side
    pub snap_distance: f32,
    /// m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none
    pub weld_distance: f32,
    /// Control frames. `frame_points`: 2 floats a frame, in the material, a grid square apart at
    /// least; null: `frame_count` frames are spread evenly, in straight rows over stiff rectangles,
    /// or fewer: one for two squares of the grid. `frame_count` 0: regions are split, after cuts
    /// too, to `frame_length`; 0: it follows from accuracy, the relative error (manual, accuracy).
    /// 0, or 1 and more; default 24
    pub frame_count: i32,
    /// m; used where `frame_count` is 0; default 0
    pub frame_length: f32,
    /// 1e-4 to 1; used where `frame_count` and `frame_length` are 0; heeds pins of a new sheet;
    /// default 0.02
    pub accuracy: f32,
    /// 2 floats a frame, or null
    pub frame_points: Option<&'a [[f32; 2]]>,
    /// re-sampling stops here; default 256
    pub max_frames: i32,
    /// Re-sampling: a frame whose weight exceeds `rigid_weight` over an area larger than
    /// `rigid_area` (m^2) gets new frames beside it; a new sheet only with `frame_count` 0.
    /// `rigid_area` 0: a quarter of a frame's area (manual, accuracy). default 0.95, 0
    pub rigid_weight: f32,
    /// Re-sampling: a frame whose weight exceeds `rigid_weight` over an area larger than
    /// `rigid_area` (m^2) gets new frames beside it; a new sheet only with `frame_count` 0.
    /// `rigid_area` 0: a quarter of a frame's area (manual, accuracy). default 0.95, 0
    pub rigid_area: f32,
    /// m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
    pub crumb_area: f32,
    /// of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
    pub friction: f32,
    /// m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
    pub contact_thickness: f32,
    /// obstacles and sheets touch if they share a set bit. Default: all
    pub groups: u32,
    /// `touches_sheets` 1: its pieces touch each other, and other sheets of the same model that
    /// have it set. `self_contact` 1: layers of a piece that folds stay apart. Ignored if planar.
    /// Manual: contact. Default 0.
    pub touches_sheets: bool,
    /// `touches_sheets` 1: its pieces touch each other, and other sheets of the same model that
    /// have it set. `self_contact` 1: layers of a piece that folds stay apart. Ignored if planar.
    /// Manual: contact. Default 0.
    pub self_contact: bool,
    /// for [`Sheet::set_contacts`]: spread evenly, at least one in every piece; default 0: none
    pub collision_points: i32,
    /// Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
    pub iterations: i32,
    /// m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
    pub sleep_speed: f32,
    /// KIRI_MODEL_..., default [`Model::Links`]
    pub model: Model,
    /// KIRI_SKINNING_..., default [`Skinning::Smooth`]
    pub skinning: Skinning,
    /// 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0
    pub planar: bool,
    /// KIRI_TIME_STEPPING_..., default [`TimeStepping::SecondOrder`]
    pub time_stepping: TimeStepping,
    /// s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2
    pub fade_time: f32,
    /// 1: every tick computes normals (default). 0: [`Mesh`] has none, which saves time
    pub normals: bool,
    /// default: all off
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
            self_contact: raw.selfContact != 0,
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
        raw.selfContact = i32::from(self.self_contact);
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

/// Sheet settings that can change after creation. Fields mean the same as in [`SheetDef`].
#[derive(Clone, Copy, Debug)]
pub struct SheetSettings {
    /// Cookie.
    cookie: u32,
    /// Material.
    pub material: Material,
    /// re-sampling stops here; default 256
    pub max_frames: i32,
    /// m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
    pub crumb_area: f32,
    /// of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
    pub friction: f32,
    /// m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
    pub contact_thickness: f32,
    /// obstacles and sheets touch if they share a set bit. Default: all
    pub groups: u32,
    /// `touches_sheets` 1: its pieces touch each other, and other sheets of the same model that
    /// have it set. `self_contact` 1: layers of a piece that folds stay apart. Ignored if planar.
    /// Manual: contact. Default 0.
    pub touches_sheets: bool,
    /// `touches_sheets` 1: its pieces touch each other, and other sheets of the same model that
    /// have it set. `self_contact` 1: layers of a piece that folds stay apart. Ignored if planar.
    /// Manual: contact. Default 0.
    pub self_contact: bool,
    /// Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
    pub iterations: i32,
    /// m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
    pub sleep_speed: f32,
    /// KIRI_SKINNING_..., default [`Skinning::Smooth`]
    pub skinning: Skinning,
    /// KIRI_TIME_STEPPING_..., default [`TimeStepping::SecondOrder`]
    pub time_stepping: TimeStepping,
    /// stays 0 with paper.popping
    pub fade_time: f32,
    /// 1: every tick computes normals (default). 0: [`Mesh`] has none, which saves time
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
            self_contact: raw.selfContact != 0,
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
            selfContact: i32::from(self.self_contact),
            iterations: self.iterations,
            sleepSpeed: self.sleep_speed,
            skinning: self.skinning as i32,
            timeStepping: self.time_stepping as i32,
            fadeTime: self.fade_time,
            normals: i32::from(self.normals),
        }
    }
}

/// A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and
/// each side has its own frames. Lines may end in the material, meet and cross; cuts go through or
/// along them (manual, folding).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Fold {
    /// m
    pub from: [f32; 2],
    /// m
    pub to: [f32; 2],
    /// N m/rad per metre of the line, 0 or more; 0: a free hinge
    pub stiffness: f32,
    /// rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it
    pub rest_angle: f32,
    /// N m per metre: it bends for good beyond, with a `yield_stress`. 0: no limit
    pub yield_moment: f32,
}

const _: () = {
    assert!(size_of::<Fold>() == size_of::<sys::kiriFold>());
    assert!(align_of::<Fold>() == align_of::<sys::kiriFold>());
    assert!(offset_of!(Fold, from) == offset_of!(sys::kiriFold, from));
    assert!(offset_of!(Fold, to) == offset_of!(sys::kiriFold, to));
    assert!(offset_of!(Fold, stiffness) == offset_of!(sys::kiriFold, stiffness));
    assert!(offset_of!(Fold, rest_angle) == offset_of!(sys::kiriFold, restAngle));
    assert!(offset_of!(Fold, yield_moment) == offset_of!(sys::kiriFold, yieldMoment));
};

impl Fold {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriFold) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriFold {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// A fold, its mean angle (rad, as `rest_angle`) and the length (m) along which it joins two sides:
/// not cut, nor rigid.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct FoldState {
    /// Fold.
    pub fold: Fold,
    /// Angle.
    pub angle: f64,
    /// Length.
    pub length: f64,
}

const _: () = {
    assert!(size_of::<FoldState>() == size_of::<sys::kiriFoldState>());
    assert!(align_of::<FoldState>() == align_of::<sys::kiriFoldState>());
    assert!(offset_of!(FoldState, fold) == offset_of!(sys::kiriFoldState, fold));
    assert!(offset_of!(FoldState, angle) == offset_of!(sys::kiriFoldState, angle));
    assert!(offset_of!(FoldState, length) == offset_of!(sys::kiriFoldState, length));
};

impl FoldState {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriFoldState) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriFoldState {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision
/// grows when indices or vertices are added or changed. Sources have the precision of the library,
/// 2^-29 of the sheet.
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
    /// 1 a vertex: the triangle of the def that contains it,
    pub source_triangles: &'a [i32],
    /// 3 a vertex: and its barycentric coordinates there
    pub source_weights: &'a [[f32; 3]],
    /// Vertex count.
    pub vertex_count: i32,
    /// Triangle count.
    pub triangle_count: i32,
    /// Revision.
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

/// count items from first on.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Range {
    /// First.
    pub first: i32,
    /// Count.
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

/// Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change
/// in every tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Dirty {
    /// up to the last one of the mesh
    pub new_vertices: Range,
    /// up to the last one of the mesh
    pub new_triangles: Range,
    /// the smallest ranges that hold all older ones with other data
    pub old_vertices: Range,
    /// the smallest ranges that hold all older ones with other data
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

/// The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips.
/// First the vertices of [`Mesh`] on the side of the normal, then the same on the other side, then
/// four for each border edge.
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
    /// 1 a vertex: its vertex in [`Mesh`]
    pub sources: &'a [i32],
    /// Vertex count.
    pub vertex_count: i32,
    /// Triangle count.
    pub triangle_count: i32,
    /// rims begin at this triangle
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

/// Numbers of items in a sheet.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Counts {
    /// Vertices.
    pub vertices: i32,
    /// Triangles.
    pub triangles: i32,
    /// Cells.
    pub cells: i32,
    /// Frames.
    pub frames: i32,
    /// Links.
    pub links: i32,
    /// Pieces.
    pub pieces: i32,
    /// Collision points.
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

/// m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s
/// and kg m^2/s.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Totals {
    /// Area.
    pub area: f64,
    /// Mass.
    pub mass: f64,
    /// Kinetic energy.
    pub kinetic_energy: f64,
    /// Elastic energy.
    pub elastic_energy: f64,
    /// Center.
    pub center: [f64; 3],
    /// Momentum.
    pub momentum: [f64; 3],
    /// Angular momentum.
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

/// The first point where a ray meets a sheet.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hit {
    /// m: where to cut
    pub rest_point: [f32; 2],
    /// m, world
    pub position: [f32; 3],
    /// unit
    pub normal: [f32; 3],
    /// m along the direction, which need not be a unit vector
    pub distance: f32,
    /// -1: none
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

/// A point of the material on the visible surface.
#[derive(Clone, Copy, Debug)]
pub struct PointState {
    /// m, world; unit
    pub position: [f32; 3],
    /// m, world; unit
    pub normal: [f32; 3],
    /// m/s, by the weights of the point
    pub velocity: [f32; 3],
    /// the frame of its region; it also names the piece
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

/// A connected part of a sheet. Any of its frames names it. Indices go from 0 to [`Counts`].pieces,
/// and change when a piece comes off or goes ([`Frame::piece`]). Cuts with pending work have
/// separated nothing yet.
#[derive(Clone, Copy, Debug)]
pub struct PieceState {
    /// m^2, kg
    pub area: f64,
    /// m^2, kg
    pub mass: f64,
    /// of mass, m; kg m/s, kg m^2/s about the origin
    pub center: [f64; 3],
    /// of mass, m; kg m/s, kg m^2/s about the origin
    pub momentum: [f64; 3],
    /// of mass, m; kg m/s, kg m^2/s about the origin
    pub angular_momentum: [f64; 3],
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

/// The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all
/// pieces, piece by piece.
#[derive(Clone, Copy, Debug)]
pub struct PieceMesh<'a> {
    /// 1 a vertex: its index in [`Mesh`]
    pub vertices: &'a [i32],
    /// 1 a triangle: its index in [`Mesh`]
    pub triangles: &'a [i32],
    /// 3 a triangle, as in [`Mesh`]: draw them
    pub indices: &'a [[i32; 3]],
    /// 1 a point, see [`Sheet::collision_points`]
    pub collision_points: &'a [i32],
    /// Vertex count.
    pub vertex_count: i32,
    /// Triangle count.
    pub triangle_count: i32,
    /// Collision point count.
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

/// How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or
/// a sharp notch, goes on across the tension where the sheet would set more energy free than the
/// tear takes. Two frames go with its tip. Where a mean tension over a distance of frames exceeds
/// the strength, a tear begins at the nearest border, one at a time.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Tearing {
    /// J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear
    pub toughness: f32,
    /// Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored
    pub strength: f32,
    /// direction in the rest plane along which it tears; 0, 0: none
    pub grain: [f32; 2],
    /// toughness across the grain, relative to along it; below 1: 1
    pub grain_ratio: f32,
    /// m/s in the rest plane, 0 or more; 0: no limit but the distance above
    pub max_speed: f32,
    /// tips that tear in a tick, 0 or more; 0: 8. Others wait
    pub max_tips: i32,
}

const _: () = {
    assert!(size_of::<Tearing>() == size_of::<sys::kiriTearing>());
    assert!(align_of::<Tearing>() == align_of::<sys::kiriTearing>());
    assert!(offset_of!(Tearing, toughness) == offset_of!(sys::kiriTearing, toughness));
    assert!(offset_of!(Tearing, strength) == offset_of!(sys::kiriTearing, strength));
    assert!(offset_of!(Tearing, grain) == offset_of!(sys::kiriTearing, grain));
    assert!(offset_of!(Tearing, grain_ratio) == offset_of!(sys::kiriTearing, grainRatio));
    assert!(offset_of!(Tearing, max_speed) == offset_of!(sys::kiriTearing, maxSpeed));
    assert!(offset_of!(Tearing, max_tips) == offset_of!(sys::kiriTearing, maxTips));
};

impl Tearing {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriTearing) -> Self {
        // SAFETY: the layout is the same, and any bits are a value of each field.
        unsafe { *std::ptr::from_ref(raw).cast() }
    }

    #[allow(dead_code)]
    pub(crate) fn raw(&self) -> sys::kiriTearing {
        // SAFETY: as above.
        unsafe { *std::ptr::from_ref(self).cast() }
    }
}

/// Pose, motion and region of a frame.
#[derive(Clone, Copy, Debug)]
pub struct FrameState {
    /// m
    pub rest_point: [f32; 2],
    /// m, world: of the rest point
    pub position: [f32; 3],
    /// columns: direction of u, of v, normal; an affine frame: columns of A, which stretch
    pub rotation: [f32; 9],
    /// m/s, rad/s
    pub velocity: [f32; 3],
    /// m/s, rad/s
    pub angular_velocity: [f32; 3],
    /// m^2 of its region; kg
    pub area: f32,
    /// m^2 of its region; kg
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

/// Air past the sheet. v is the velocity of the air less the material's, n the normal: each square
/// metre gets density / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)); `air_damping` acts in any
/// density. A sheet can sleep in wind.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Wind {
    /// m/s
    pub velocity: [f32; 3],
    /// kg/m^3, 0 or more; air: 1.2
    pub density: f32,
    /// 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
    pub drag: f32,
    /// 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
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

/// A pin holds a point of the material at its target by a spring.
#[derive(Clone, Copy, Debug)]
pub struct PinDef {
    /// m, in the material
    pub rest_point: [f32; 2],
    /// m, world
    pub target: [f32; 3],
    /// N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target
    /// (manual)
    pub stiffness: f32,
    /// N: it breaks in a tick with a larger force ([`EventType::PinBroke`]); 0: never
    pub break_force: f32,
    /// 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there
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

/// Type and target of a pin.
#[derive(Clone, Copy, Debug)]
pub struct PinState {
    /// KIRI_PIN_...
    pub kind: PinType,
    /// Sheet.
    pub sheet: Sheet,
    /// m, rest plane: the ends of the line, or the point twice
    pub from: [f32; 2],
    /// m, rest plane: the ends of the line, or the point twice
    pub to: [f32; 2],
    /// m, world
    pub target: [f32; 3],
    /// of a line; of a point the identity
    pub rotation: [f32; 9],
    /// N, or 0
    pub break_force: f32,
    /// that the target moves with; 0: none
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

/// A seam joins two lines in the material, of two sheets or of one: stitches join points at the
/// same parts of both. Cuts go through a seam, and pieces keep their stitches. A stitch ends with
/// the piece of a point (manual, sewing).
#[derive(Clone, Copy, Debug)]
pub struct SeamDef<'a> {
    /// of the same model, and not planar
    pub sheet_a: Sheet,
    /// of the same model, and not planar
    pub sheet_b: Sheet,
    /// 2 floats a point, m, in the material, such as its edge; copied
    pub line_a: &'a [[f32; 2]],
    /// 2 floats a point
    pub line_b: &'a [[f32; 2]],
    /// 2 to 4096; 0 (default): three for two distances of frames
    pub stitches: i32,
    /// N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free
    pub stiffness: f32,
    /// rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal
    pub rest_angle: f32,
    /// N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never
    pub break_force: f32,
}

impl Default for SeamDef<'_> {
    fn default() -> Self {
        Self::from_raw(&Self::default_raw())
    }
}

impl<'a> SeamDef<'a> {
    fn default_raw() -> sys::kiriSeamDef {
        let mut raw = MaybeUninit::<sys::kiriSeamDef>::uninit();
        // SAFETY: it fills all of the struct.
        unsafe {
            sys::kiriDefaultSeamDef(raw.as_mut_ptr());
            raw.assume_init()
        }
    }

    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriSeamDef) -> Self {
        Self {
            sheet_a: Sheet::known(raw.sheetA),
            sheet_b: Sheet::known(raw.sheetB),
            line_a: unsafe { view(raw.lineA, raw.countA) },
            line_b: unsafe { view(raw.lineB, raw.countB) },
            stitches: raw.stitches,
            stiffness: raw.stiffness,
            rest_angle: raw.restAngle,
            break_force: raw.breakForce,
        }
    }

    pub(crate) fn raw(&self) -> sys::kiriSeamDef {
        let mut raw = Self::default_raw();
        raw.sheetA = self.sheet_a.raw();
        raw.sheetB = self.sheet_b.raw();
        raw.lineA = self.line_a.as_ptr().cast();
        raw.countA = self.line_a.len() as i32;
        raw.lineB = self.line_b.as_ptr().cast();
        raw.countB = self.line_b.len() as i32;
        raw.stitches = self.stitches;
        raw.stiffness = self.stiffness;
        raw.restAngle = self.rest_angle;
        raw.breakForce = self.break_force;
        raw
    }
}

/// A stitch, as after the last tick.
#[derive(Clone, Copy, Debug)]
pub struct Stitch {
    /// Sheet a.
    pub sheet_a: Sheet,
    /// Sheet b.
    pub sheet_b: Sheet,
    /// m, in the material
    pub rest_a: [f32; 2],
    /// m, in the material
    pub rest_b: [f32; 2],
    /// m, world: where both drawn lips meet; their middle while they are apart
    pub position: [f32; 3],
    /// m: distance of the two points; a stitch yields by micrometres under the sheet's weight
    pub gap: f32,
    /// N, on sheet A: mean over the last tick that moved it
    pub force: [f32; 3],
    /// rad, as `rest_angle`
    pub angle: f32,
}

impl Stitch {
    #[allow(dead_code)]
    pub(crate) fn from_raw(raw: &sys::kiriStitch) -> Self {
        Self {
            sheet_a: Sheet::known(raw.sheetA),
            sheet_b: Sheet::known(raw.sheetB),
            rest_a: raw.restA,
            rest_b: raw.restB,
            position: raw.position,
            gap: raw.gap,
            force: raw.force,
            angle: raw.angle,
        }
    }
}

/// A contact of a point of the material: the plane dot(normal, x) = offset keeps the point on its
/// upper side, with Coulomb friction. The host computes planes from the visible surface for each
/// tick. Planes out of reach do nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Contact {
    /// index of the collision point; -1: `rest_point` names the point
    pub point: i32,
    /// m, in the material; read only where point is -1
    pub rest_point: [f32; 2],
    /// unit, out of the obstacle
    pub normal: [f32; 3],
    /// m: of the obstacle's surface at the start of the tick
    pub offset: f32,
    /// m/s: of the obstacle at the contact. The plane moves with it within the tick
    pub velocity: [f32; 3],
    /// 0 or more: of both sides together
    pub friction: f32,
    /// 1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid
    pub inverse_mass: f32,
    /// m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s
    pub push_speed: f32,
    /// a number of the host. Contacts with one number press on one obstacle, and share its mass
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

/// The result of a contact in the last tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ContactForce {
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

/// An obstacle: its shape, pose, motion, and mass.
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
    /// 2 floats a corner, m, counter-clockwise; copied. Null: no prism
    pub outline: &'a [[f32; 2]],
    /// m, 0 or more: prisms and boxes grow by this, with round edges. Default 0
    pub rounding: f32,
    /// m, world
    pub position: [f32; 3],
    /// columns; default: the axes of the world
    pub rotation: [f32; 9],
    /// m/s, of its position
    pub velocity: [f32; 3],
    /// rad/s
    pub angular_velocity: [f32; 3],
    /// m/s, world: of its surface, added to its motion, as of a conveyor
    pub surface_velocity: [f32; 3],
    /// 0 or more; default 0.5
    pub friction: f32,
    /// kg; 0 (default): nothing moves it
    pub mass: f32,
    /// kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz.
    /// Positive definite, but for axes whose numbers are all 0: it does not turn about these
    pub inertia: [f32; 6],
    /// m, from its position in its own axes
    pub center_of_mass: [f32; 3],
    /// obstacles with the same number, except 0, are parts of one body; each has its whole mass
    pub body: u32,
    /// m/s, above 0: maximum speed at which points inside are pushed out. Default 1
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

/// Pose, motion, and reaction of an obstacle.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ObstacleState {
    /// Position.
    pub position: [f32; 3],
    /// Rotation.
    pub rotation: [f32; 9],
    /// Velocity.
    pub velocity: [f32; 3],
    /// Angular velocity.
    pub angular_velocity: [f32; 3],
    /// N s, N m s about its centre of mass: of sheets and pins in the last tick
    pub impulse: [f64; 3],
    /// N s, N m s about its centre of mass: of sheets and pins in the last tick
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

/// A corner to draw, in a layout for a GPU.
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

/// Events since the start of the last tick that was not refused.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// cut: all of it is in the mesh; the id is stale from now on
    CutFinished {
        /// Sheet.
        sheet: Sheet,
        /// Cut.
        cut: Cut,
    },
    /// frame (its first, which names it), crumb, area: a part came off, never the largest
    PieceOff {
        /// Sheet.
        sheet: Sheet,
        /// Frame.
        frame: Frame,
        /// 1: the piece is a crumb, see [`SheetDef`]
        crumb: bool,
        /// m^2, or 0
        area: f32,
    },
    /// frame
    FrameAdded {
        /// Sheet.
        sheet: Sheet,
        /// Frame.
        frame: Frame,
    },
    /// the sheet was stopped
    Diverged {
        /// Sheet.
        sheet: Sheet,
    },
    /// stage, waiting: the budget ended in this stage of the sheet's work
    Deferred {
        /// Sheet.
        sheet: Sheet,
        /// KIRI_STAGE_..., or -1
        stage: Stage,
        /// points and ends of cuts that are pending or in work; or 0
        waiting: i32,
    },
    /// pin: its force exceeded `break_force`; the id is stale from now on
    PinBroke {
        /// Sheet.
        sheet: Sheet,
        /// Pin.
        pin: Pin,
    },
    /// sheet (the new one), frame, area: a pending [`Frame::detach_piece`] is done
    PieceDetached {
        /// Sheet.
        sheet: Sheet,
        /// Frame.
        frame: Frame,
        /// m^2, or 0
        area: f32,
    },
    /// seam, stitches: some stitches broke; with none left the id is stale from now on
    SeamBroke {
        /// Sheet.
        sheet: Sheet,
        /// Seam.
        seam: Seam,
        /// that the seam has left, or 0
        stitches: i32,
    },
    /// cut: the library began it, see [`Tearing`]
    TearBegan {
        /// Sheet.
        sheet: Sheet,
        /// Cut.
        cut: Cut,
    },
    /// cut: the tear has rested for half a second; the id is stale from now on
    TearEnded {
        /// Sheet.
        sheet: Sheet,
        /// Cut.
        cut: Cut,
    },
    /// area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s
    Strained {
        /// Sheet.
        sheet: Sheet,
        /// m^2, or 0
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
            EventType::SeamBroke => Self::SeamBroke { sheet: Sheet::known(raw.sheet), seam: Seam::known(raw.seam), stitches: raw.stitches },
            EventType::TearBegan => Self::TearBegan { sheet: Sheet::known(raw.sheet), cut: Cut::known(raw.cut) },
            EventType::TearEnded => Self::TearEnded { sheet: Sheet::known(raw.sheet), cut: Cut::known(raw.cut) },
            EventType::Strained => Self::Strained { sheet: Sheet::known(raw.sheet), area: raw.area },
        }
    }
}

/// Return the version of the library, as KIRI_VERSION; the name of a result, as
/// "[`ResultCode::Ok`]"; a line with its meaning.
#[must_use]
pub fn result_name(result: ResultCode) -> &'static str {
    // SAFETY: texts of the library stay.
    unsafe { text(sys::kiriGetResultName(result as i32)) }
}

/// Return the version of the library, as KIRI_VERSION; the name of a result, as
/// "[`ResultCode::Ok`]"; a line with its meaning.
#[must_use]
pub fn result_text(result: ResultCode) -> &'static str {
    // SAFETY: texts of the library stay.
    unsafe { text(sys::kiriGetResultText(result as i32)) }
}

/// Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum of
/// several: half for cuts, half for motion; all if it has one alone. Limits without recorded work
/// stay. A replay must set the same budgets.
pub fn fit_budget(profile: &Profile, microseconds: f32, budget: &mut Budget) -> Result<()> {
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriFitBudget(&profile.raw(), microseconds, std::ptr::from_mut(budget).cast()) }, "fit_budget")?;
    Ok(())
}

/// Returns the name of a stage; "" for another number.
#[must_use]
pub fn stage_name(stage: Stage) -> &'static str {
    // SAFETY: texts of the library stay.
    unsafe { text(sys::kiriGetStageName(stage as i32)) }
}

/// Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
pub fn material(preset: MaterialPreset) -> Result<Material> {
    let mut material = MaybeUninit::<sys::kiriMaterial>::uninit();
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriGetMaterial(preset as i32, material.as_mut_ptr()) }, "material")?;
    // SAFETY: it filled the struct.
    let material = unsafe { material.assume_init() };
    Ok(Material::from_raw(&material))
}

/// Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
pub fn quality(preset: QualityPreset) -> Result<Quality> {
    let mut quality = MaybeUninit::<sys::kiriQuality>::uninit();
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriGetQuality(preset as i32, quality.as_mut_ptr()) }, "quality")?;
    // SAFETY: it filled the struct.
    let quality = unsafe { quality.assume_init() };
    Ok(Quality::from_raw(&quality))
}

/// Gets a def for [`World::create_rectangle`]: material, model, skinning, grid, frames and
/// iterations for a kind of sheet and its sides (m, 1 : 256 at most). Other fields are as
/// kiriDefaultSheetDef has them (manual, accuracy).
pub fn setup(preset: SetupPreset, width: f32, height: f32) -> Result<SheetDef<'static>> {
    let mut def = MaybeUninit::<sys::kiriSheetDef>::uninit();
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriGetSetup(preset as i32, width, height, def.as_mut_ptr()) }, "setup")?;
    // SAFETY: it filled the struct.
    let def = unsafe { def.assume_init() };
    Ok(SheetDef::from_raw(&def))
}

/// Fills in the mesh of [`World::create_rectangle`]: 2 (columns + 1) (rows + 1) floats and 6
/// columns rows indices.
pub fn fill_rectangle(width: f32, height: f32, columns: i32, rows: i32) -> Result<(Vec<[f32; 2]>, Vec<[i32; 3]>)> {
    let mut rest_positions = vec![[f32::default(); 2]; (2 * (columns.clamp(0, 4096) as usize + 1) * (rows.clamp(0, 4096) as usize + 1)) / 2];
    let mut indices = vec![[i32::default(); 3]; (6 * columns.clamp(0, 4096) as usize * rows.clamp(0, 4096) as usize) / 3];
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriFillRectangle(width, height, columns, rows, rest_positions.as_mut_ptr().cast(), indices.as_mut_ptr().cast()) }, "fill_rectangle")?;
    Ok((rest_positions, indices))
}

/// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them:
/// parts of the sheet inherit them. [`ResultCode::ErrorArgument`]: a toughness above 0 with a model
/// other than [`Model::Links`], another preset.
pub fn tearing(preset: MaterialPreset) -> Result<Tearing> {
    let mut tearing = MaybeUninit::<sys::kiriTearing>::uninit();
    // SAFETY: pointers are to what is named, and lengths are theirs.
    fail(unsafe { sys::kiriGetTearing(preset as i32, tearing.as_mut_ptr()) }, "tearing")?;
    // SAFETY: it filled the struct.
    let tearing = unsafe { tearing.assume_init() };
    Ok(Tearing::from_raw(&tearing))
}

impl World {
    /// Advances by one fixed step of dt seconds (1e-6 to 10), in substeps equal parts (1 to 64):
    /// takes the pending cut points, then moves every sheet. [`ResultCode::Pending`]: the budget is
    /// spent; events name the cuts that still have work. [`ResultCode::ErrorMemory`]: cuts and
    /// pieces that leave go on in the next tick (manual, budget). [`ResultCode::ErrorLimit`]: no
    /// ids are left for new frames; nothing moves until some are destroyed.
    /// [`ResultCode::Diverged`]: events name sheets that were stopped.
    pub fn tick(&mut self, dt: f32, substeps: i32) -> Result<Status> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        let result = check(unsafe { sys::kiriWorld_Tick(self.raw_mut(), dt, substeps) }, self, "World::tick")?;
        Ok(Status::of(result))
    }

    /// Moves the origin of the world to a point (m), as large worlds need: subtracts it from all
    /// positions. Nothing wakes. Returned arrays keep the old positions until the next tick.
    /// [`ResultCode::ErrorArgument`]: a position would not fit a float.
    pub fn shift_origin(&mut self, origin: impl Into<[f32; 3]>) -> Result<()> {
        let origin: [f32; 3] = origin.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_ShiftOrigin(self.raw_mut(), origin.as_ptr()) }, self, "World::shift_origin")?;
        Ok(())
    }

    /// Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
    pub fn set_gravity(&mut self, gravity: impl Into<[f32; 3]>) -> Result<()> {
        let gravity: [f32; 3] = gravity.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_SetGravity(self.raw_mut(), gravity.as_ptr()) }, self, "World::set_gravity")?;
        Ok(())
    }

    /// Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
    pub fn set_budget(&mut self, budget: &Budget) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_SetBudget(self.raw_mut(), &budget.raw()) }, self, "World::set_budget")?;
        Ok(())
    }

    /// Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike
    /// (manual, budget).
    pub fn state_hash(&self) -> Result<u64> {
        let mut hash: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriWorld_GetStateHash(self.raw(), &mut hash) }, "World::state_hash")?;
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
            check_read(unsafe { sys::kiriWorld_GetSheets(self.raw(), sheets.as_mut_ptr().cast(), capacity as i32, &mut count) }, "World::sheets")?;
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

    /// Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A
    /// replay stops there.
    pub fn note(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_Note(self.raw_mut(), bytes.as_ptr().cast(), bytes.len() as i32) }, self, "World::note")?;
        Ok(())
    }

    /// Writes the world to memory with room for capacity; bytes null: only counts them. \*size:
    /// bytes of the save. [`ResultCode::ErrorArgument`]: capacity is less. [`ResultCode::Pending`]:
    /// a cut is pending ([`World::finish_cuts`]); \*size is 0.
    pub fn save(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::<u8>::new();
        let mut size = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriWorld_Save(self.raw(), if capacity == 0 { std::ptr::null_mut() } else { bytes.as_mut_ptr().cast() }, capacity as i64, &mut size) }, "World::save")?;
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

    /// Finishes the work on cuts at once, whatever the budget is, without moving anything. The next
    /// tick reports the events. Arrays that the world handed out end as with a tick.
    /// [`ResultCode::ErrorMemory`], [`ResultCode::ErrorLimit`]: as in [`World::tick`].
    pub fn finish_cuts(&mut self) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_FinishCuts(self.raw_mut()) }, self, "World::finish_cuts")?;
        Ok(())
    }

    /// Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a
    /// malicious save cannot crash the program, and takes memory in proportion to its size, which
    /// is below 2^31. Old arrays live until the next tick. On failure nothing has changed:
    /// [`ResultCode::ErrorData`]: not a save, damaged, or of another version.
    /// [`ResultCode::ErrorMemory`].
    pub fn load(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_Load(self.raw_mut(), bytes.as_ptr().cast(), bytes.len() as i64) }, self, "World::load")?;
        Ok(())
    }

    /// For rollback: copies all of the world, also work in progress, into memory of the host; much
    /// faster than a save, and exact to the bit. For this process only: never store or send the
    /// bytes. bytes null: as of [`World::save`].
    pub fn snapshot(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::<u8>::new();
        let mut size = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriWorld_Snapshot(self.raw(), if capacity == 0 { std::ptr::null_mut() } else { bytes.as_mut_ptr().cast() }, capacity as i64, &mut size) }, "World::snapshot")?;
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

    /// Replaces the world by the world of the snapshot, as [`World::load`] does. The bytes are
    /// trusted. On failure nothing has changed: [`ResultCode::ErrorData`]: no snapshot of this
    /// build. [`ResultCode::ErrorState`]: it is recorded. [`ResultCode::ErrorMemory`].
    pub fn restore(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_Restore(self.raw_mut(), bytes.as_ptr().cast(), bytes.len() as i64) }, self, "World::restore")?;
        Ok(())
    }

    /// Gets the profile of the last tick that was not refused.
    pub fn profile(&self) -> Result<Profile> {
        let mut profile = MaybeUninit::<sys::kiriProfile>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriWorld_GetProfile(self.raw(), profile.as_mut_ptr()) }, "World::profile")?;
        // SAFETY: it filled the struct.
        let profile = unsafe { profile.assume_init() };
        Ok(Profile::from_raw(&profile))
    }

    /// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts,
    /// frames and pins. On failure \*sheet is 0. [`ResultCode::ErrorMesh`]: the triangles form no
    /// sheet; the line names them by index in the def.
    pub fn create_sheet(&mut self, def: &SheetDef<'_>) -> Result<Sheet> {
        let mut sheet = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateSheet(self.raw_mut(), &def.raw(), &mut sheet) }, self, "World::create_sheet")?;
        Ok(Sheet::known(sheet))
    }

    /// Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 \* columns \* rows
    /// triangles; columns or rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096.
    /// The mesh of def is not read; def null: the defaults.
    pub fn create_rectangle(&mut self, width: f32, height: f32, columns: i32, rows: i32, def: Option<&SheetDef<'_>>) -> Result<Sheet> {
        let def = def.map(|def| def.raw());
        let mut sheet = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateRectangle(self.raw_mut(), width, height, columns, rows, def.as_ref().map_or(std::ptr::null(), |def| def), &mut sheet) }, self, "World::create_rectangle")?;
        Ok(Sheet::known(sheet))
    }

    /// Adds a sheet with 1 to 65536 folds, copied in order. [`ResultCode::ErrorArgument`]: not
    /// [`Model::Links`], or no material at one.
    pub fn create_folded_sheet(&mut self, def: &SheetDef<'_>, folds: &[Fold]) -> Result<Sheet> {
        let mut sheet = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateFoldedSheet(self.raw_mut(), &def.raw(), folds.as_ptr().cast(), folds.len() as i32, &mut sheet) }, self, "World::create_folded_sheet")?;
        Ok(Sheet::known(sheet))
    }

    /// Find where a ray first meets the sheet, or any (\*sheet 0: none), up to `max_distance`;
    /// hit-\>triangle -1: it does not.
    pub fn raycast(&self, origin: impl Into<[f32; 3]>, direction: impl Into<[f32; 3]>, max_distance: f32) -> Result<Option<(Sheet, Hit)>> {
        let origin: [f32; 3] = origin.into();
        let direction: [f32; 3] = direction.into();
        let mut sheet = 0;
        let mut hit = MaybeUninit::<sys::kiriHit>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriWorld_Raycast(self.raw(), origin.as_ptr(), direction.as_ptr(), max_distance, &mut sheet, hit.as_mut_ptr()) }, "World::raycast")?;
        // SAFETY: it filled the struct.
        let hit = unsafe { hit.assume_init() };
        Ok((hit.triangle >= 0).then(|| (Sheet::known(sheet), Hit::from_raw(&hit))))
    }

    /// Detach or remove the pieces of count frames, of any sheets, in one pass for each sheet: all
    /// or none. [`ResultCode::Pending`]: some are pending, all in a sheet together. detached\[i\]:
    /// the sheet made of piece of frames\[i\], 0: pending.
    pub fn detach_pieces(&mut self, frames: &[Frame]) -> Result<Vec<Option<Sheet>>> {
        let mut detached = vec![None::<Sheet>; frames.len()];
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriWorld_DetachPieces(self.raw_mut(), frames.as_ptr().cast(), frames.len() as i32, detached.as_mut_ptr().cast()) }, self, "World::detach_pieces")?;
        Ok(detached)
    }

    /// Detach or remove the pieces of count frames, of any sheets, in one pass for each sheet: all
    /// or none. [`ResultCode::Pending`]: some are pending, all in a sheet together. detached\[i\]:
    /// the sheet made of piece of frames\[i\], 0: pending.
    pub fn destroy_pieces(&mut self, frames: &[Frame]) -> Result<Status> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        let result = check(unsafe { sys::kiriWorld_DestroyPieces(self.raw_mut(), frames.as_ptr().cast(), frames.len() as i32) }, self, "World::destroy_pieces")?;
        Ok(Status::of(result))
    }

    /// A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material
    /// of each layer, and cuts on from there. Move it once a tick while it is in a sheet. Each
    /// layer has a cut (manual, cutting). sheet 0: all.
    pub fn begin_blade(&mut self, sheet: Option<Sheet>) -> Result<Blade> {
        let mut blade = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBeginBlade(self.raw_mut(), sheet.map_or(0, |id| id.raw()), &mut blade) }, self, "World::begin_blade")?;
        Ok(Blade::known(blade))
    }

    /// Fill the def with its defaults; create and destroy a seam; set stiffness and `rest_angle`.
    /// On failure \*seam is 0. [`ResultCode::ErrorArgument`]: a line is empty or leaves the
    /// material; a sheet is planar; models differ (manual, sewing).
    pub fn create_seam(&mut self, def: &SeamDef<'_>) -> Result<Seam> {
        let mut seam = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateSeam(self.raw_mut(), &def.raw(), &mut seam) }, self, "World::create_seam")?;
        Ok(Seam::known(seam))
    }

    /// Writes up to capacity ids of the world's seams; \*count is how many there are.
    pub fn seams(&self) -> Result<Vec<Seam>> {
        let mut seams = Vec::<Seam>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriWorld_GetSeams(self.raw(), seams.as_mut_ptr().cast(), capacity as i32, &mut count) }, "World::seams")?;
            let needed = count as usize;
            if needed <= capacity {
                unsafe { seams.set_len(needed) };
                break;
            }
            capacity = needed;
            seams.reserve_exact(capacity);
        }
        Ok(seams)
    }

    /// Fill the def with its defaults; add and destroy an obstacle. On failure \*obstacle is 0.
    /// Pieces on it wake.
    pub fn create_obstacle(&mut self, def: &ObstacleDef<'_>) -> Result<Obstacle> {
        let mut obstacle = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreateObstacle(self.raw_mut(), &def.raw(), &mut obstacle) }, self, "World::create_obstacle")?;
        Ok(Obstacle::known(obstacle))
    }
}

impl Sheet {
    /// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts,
    /// frames and pins. On failure \*sheet is 0. [`ResultCode::ErrorMesh`]: the triangles form no
    /// sheet; the line names them by index in the def.
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroySheet(world.raw_mut(), self.raw()) }, world, "Sheet::destroy")?;
        Ok(())
    }

    /// Get the current settings, and set all or none, with the checks of [`World::create_sheet`].
    /// [`ResultCode::ErrorDef`]: they do not come from [`Sheet::settings`]. It wakes if one
    /// differs. Motion, stiffness of pins and frames stay.
    pub fn settings(self, world: &World) -> Result<SheetSettings> {
        let mut settings = MaybeUninit::<sys::kiriSheetSettings>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetSettings(world.raw(), self.raw(), settings.as_mut_ptr()) }, "Sheet::settings")?;
        // SAFETY: it filled the struct.
        let settings = unsafe { settings.assume_init() };
        Ok(SheetSettings::from_raw(&settings))
    }

    /// Get the current settings, and set all or none, with the checks of [`World::create_sheet`].
    /// [`ResultCode::ErrorDef`]: they do not come from [`Sheet::settings`]. It wakes if one
    /// differs. Motion, stiffness of pins and frames stay.
    pub fn set_settings(self, world: &mut World, settings: &SheetSettings) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetSettings(world.raw_mut(), self.raw(), &settings.raw()) }, world, "Sheet::set_settings")?;
        Ok(())
    }

    /// Adds a fold; its index is the count of folds before. The next ticks make it, on the budget
    /// of cuts, until a [`EventType::CutFinished`]. It moves to its rest angle within `fade_time`.
    /// Errors as of [`World::create_folded_sheet`].
    pub fn add_fold(self, world: &mut World, fold: &Fold) -> Result<i32> {
        let mut index: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_AddFold(world.raw_mut(), self.raw(), &fold.raw(), &mut index) }, world, "Sheet::add_fold")?;
        Ok(index)
    }

    /// A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps.
    /// Changes wake the sheet.
    pub fn fold(self, world: &World, index: i32) -> Result<FoldState> {
        let mut state = MaybeUninit::<sys::kiriFoldState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetFold(world.raw(), self.raw(), index, state.as_mut_ptr()) }, "Sheet::fold")?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(FoldState::from_raw(&state))
    }

    /// A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps.
    /// Changes wake the sheet.
    pub fn set_fold(self, world: &mut World, index: i32, stiffness: f32, rest_angle: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetFold(world.raw_mut(), self.raw(), index, stiffness, rest_angle) }, world, "Sheet::set_fold")?;
        Ok(())
    }

    /// Gets the arrays, without a copy.
    pub fn mesh(self, world: &World) -> Result<Mesh<'_>> {
        let mut mesh = MaybeUninit::<sys::kiriMesh>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetMesh(world.raw(), self.raw(), mesh.as_mut_ptr()) }, "Sheet::mesh")?;
        // SAFETY: it filled the struct.
        let mesh = unsafe { mesh.assume_init() };
        Ok(Mesh::from_raw(&mesh))
    }

    /// Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load
    /// or restore.
    pub fn dirty(self, world: &World, since_revision: u32) -> Result<Dirty> {
        let mut dirty = MaybeUninit::<sys::kiriDirty>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetDirty(world.raw(), self.raw(), since_revision, dirty.as_mut_ptr()) }, "Sheet::dirty")?;
        // SAFETY: it filled the struct.
        let dirty = unsafe { dirty.assume_init() };
        Ok(Dirty::from_raw(&dirty))
    }

    /// Copies the index that each vertex had when the last tick began, to draw between two ticks;
    /// -1: it did not exist. \*from: the sheet that had them then. A vertex that a cut separated
    /// has the other's index (manual, drawing).
    pub fn copy_previous(self, world: &World, first: i32, vertices: &mut [i32]) -> Result<Sheet> {
        let mut from = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopyPrevious(world.raw(), self.raw(), first, vertices.len() as i32, vertices.as_mut_ptr().cast(), &mut from) }, "Sheet::copy_previous")?;
        Ok(Sheet::known(from))
    }

    /// Copies indices of some triangles as 16-bit numbers, 3 each. [`ResultCode::ErrorState`]:
    /// there are more than 65535 vertices.
    pub fn copy_indices16(self, world: &World, first_triangle: i32, indices: &mut [[u16; 3]]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopyIndices16(world.raw(), self.raw(), first_triangle, indices.len() as i32, indices.as_mut_ptr().cast()) }, "Sheet::copy_indices16")?;
        Ok(())
    }

    /// Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was
    /// removed. Weights: 9 floats each, the barycentric coordinates of its three corners there,
    /// also beside a welded seam (manual, meshes).
    pub fn copy_sources(self, world: &World, first_triangle: i32, sources: &mut [i32]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopySources(world.raw(), self.raw(), first_triangle, sources.len() as i32, sources.as_mut_ptr().cast()) }, "Sheet::copy_sources")?;
        Ok(())
    }

    /// Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was
    /// removed. Weights: 9 floats each, the barycentric coordinates of its three corners there,
    /// also beside a welded seam (manual, meshes).
    pub fn copy_source_weights(self, world: &World, first_triangle: i32, weights: &mut [[f32; 9]]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_CopySourceWeights(world.raw(), self.raw(), first_triangle, weights.len() as i32, weights.as_mut_ptr().cast()) }, "Sheet::copy_source_weights")?;
        Ok(())
    }

    /// Makes the solid surface, with a thickness in m; thickness 0: the material's.
    pub fn solid(self, world: &mut World, thickness: f32) -> Result<Solid<'_>> {
        let mut solid = MaybeUninit::<sys::kiriSolid>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetSolid(world.raw_mut(), self.raw(), thickness, solid.as_mut_ptr()) }, world, "Sheet::solid")?;
        // SAFETY: it filled the struct.
        let solid = unsafe { solid.assume_init() };
        Ok(Solid::from_raw(&solid))
    }

    /// Gets the collision points: 3 floats of position (m, world) a point.
    pub fn collision_points(self, world: &World) -> Result<&[[f32; 3]]> {
        let mut positions = std::ptr::null();
        let mut count = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetCollisionPoints(world.raw(), self.raw(), &mut positions, &mut count) }, "Sheet::collision_points")?;
        Ok(unsafe { view(positions, count) })
    }

    /// Get the counts, at no cost; sum the totals over the frames.
    pub fn counts(self, world: &World) -> Result<Counts> {
        let mut counts = MaybeUninit::<sys::kiriCounts>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetCounts(world.raw(), self.raw(), counts.as_mut_ptr()) }, "Sheet::counts")?;
        // SAFETY: it filled the struct.
        let counts = unsafe { counts.assume_init() };
        Ok(Counts::from_raw(&counts))
    }

    /// Get the counts, at no cost; sum the totals over the frames.
    pub fn totals(self, world: &World) -> Result<Totals> {
        let mut totals = MaybeUninit::<sys::kiriTotals>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetTotals(world.raw(), self.raw(), totals.as_mut_ptr()) }, "Sheet::totals")?;
        // SAFETY: it filled the struct.
        let totals = unsafe { totals.assume_init() };
        Ok(Totals::from_raw(&totals))
    }

    /// Estimates the error of a sheet that rests; 1: too few frames. It allocates.
    /// [`ResultCode::ErrorState`]: not [`Model::Links`].
    pub fn estimate_error(self, world: &World) -> Result<f64> {
        let mut relative: f64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_EstimateError(world.raw(), self.raw(), &mut relative) }, "Sheet::estimate_error")?;
        Ok(relative)
    }

    /// Read and end sleep: \*awake is 0 where all pieces sleep ([`PieceState`] tells which);
    /// [`Sheet::wake`] wakes all.
    pub fn is_awake(self, world: &World) -> Result<bool> {
        let mut awake: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_IsAwake(world.raw(), self.raw(), &mut awake) }, "Sheet::is_awake")?;
        Ok(awake != 0)
    }

    /// Read and end sleep: \*awake is 0 where all pieces sleep ([`PieceState`] tells which);
    /// [`Sheet::wake`] wakes all.
    pub fn wake(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Wake(world.raw_mut(), self.raw()) }, world, "Sheet::wake")?;
        Ok(())
    }

    /// Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it
    /// wakes. A planar sheet turns about its normal only. Targets of pins and holds move along, but
    /// for pins on obstacles (manual, sheets).
    pub fn transform(self, world: &mut World, rotation: impl Into<[f32; 9]>, translation: impl Into<[f32; 3]>) -> Result<()> {
        let rotation: [f32; 9] = rotation.into();
        let translation: [f32; 3] = translation.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Transform(world.raw_mut(), self.raw(), rotation.as_ptr(), translation.as_ptr()) }, world, "Sheet::transform")?;
        Ok(())
    }

    /// Set rigid motion of a sheet, or of the piece with a frame, until forces change it: velocity
    /// (m/s) of its centre of mass, and `angular_velocity` (rad/s) about it. Planar sheets drop
    /// motion across their plane; held frames stay held.
    pub fn set_velocity(self, world: &mut World, velocity: impl Into<[f32; 3]>, angular_velocity: impl Into<[f32; 3]>) -> Result<()> {
        let velocity: [f32; 3] = velocity.into();
        let angular_velocity: [f32; 3] = angular_velocity.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetVelocity(world.raw_mut(), self.raw(), velocity.as_ptr(), angular_velocity.as_ptr()) }, world, "Sheet::set_velocity")?;
        Ok(())
    }

    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn set_user_data(self, world: &mut World, data: u64) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetUserData(world.raw_mut(), self.raw(), data) }, world, "Sheet::set_user_data")?;
        Ok(())
    }

    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn user_data(self, world: &World) -> Result<u64> {
        let mut data: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetUserData(world.raw(), self.raw(), &mut data) }, "Sheet::user_data")?;
        Ok(data)
    }

    /// Find where a ray first meets the sheet, or any (\*sheet 0: none), up to `max_distance`;
    /// hit-\>triangle -1: it does not.
    pub fn raycast(self, world: &World, origin: impl Into<[f32; 3]>, direction: impl Into<[f32; 3]>, max_distance: f32) -> Result<Option<Hit>> {
        let origin: [f32; 3] = origin.into();
        let direction: [f32; 3] = direction.into();
        let mut hit = MaybeUninit::<sys::kiriHit>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_Raycast(world.raw(), self.raw(), origin.as_ptr(), direction.as_ptr(), max_distance, hit.as_mut_ptr()) }, "Sheet::raycast")?;
        // SAFETY: it filled the struct.
        let hit = unsafe { hit.assume_init() };
        Ok((hit.triangle >= 0).then(|| Hit::from_raw(&hit)))
    }

    /// Gets the state of a point. [`ResultCode::ErrorArgument`]: it is outside the sheet. On a cut:
    /// on a lip that has the point.
    pub fn point(self, world: &World, rest_point: impl Into<[f32; 2]>) -> Result<PointState> {
        let rest_point: [f32; 2] = rest_point.into();
        let mut state = MaybeUninit::<sys::kiriPointState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetPoint(world.raw(), self.raw(), rest_point.as_ptr(), state.as_mut_ptr()) }, "Sheet::point")?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(PointState::from_raw(&state))
    }

    /// Gets the shape functions at a rest point: up to capacity frames with weights, sum 1, and
    /// gradients (2 floats, 1/m; gradients null: none). \*count: all.
    /// [`ResultCode::ErrorArgument`]: outside the sheet. [`ResultCode::ErrorState`]: a cut is
    /// pending.
    pub fn weights(self, world: &World, rest_point: impl Into<[f32; 2]>) -> Result<(Vec<Frame>, Vec<f32>, Vec<[f32; 2]>)> {
        let rest_point: [f32; 2] = rest_point.into();
        let mut frames = Vec::<Frame>::new();
        let mut weights = Vec::<f32>::new();
        let mut gradients = Vec::<[f32; 2]>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriSheet_GetWeights(world.raw(), self.raw(), rest_point.as_ptr(), frames.as_mut_ptr().cast(), weights.as_mut_ptr().cast(), gradients.as_mut_ptr().cast(), capacity as i32, &mut count) }, "Sheet::weights")?;
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

    /// Get a piece. The first call after a cut sorts the sheet by pieces.
    /// [`ResultCode::ErrorArgument`]: no piece has the index.
    pub fn piece(self, world: &mut World, piece: i32) -> Result<PieceState> {
        let mut state = MaybeUninit::<sys::kiriPieceState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetPiece(world.raw_mut(), self.raw(), piece, state.as_mut_ptr()) }, world, "Sheet::piece")?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(PieceState::from_raw(&state))
    }

    /// Get a piece. The first call after a cut sorts the sheet by pieces.
    /// [`ResultCode::ErrorArgument`]: no piece has the index.
    pub fn piece_mesh(self, world: &mut World, piece: i32) -> Result<PieceMesh<'_>> {
        let mut mesh = MaybeUninit::<sys::kiriPieceMesh>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetPieceMesh(world.raw_mut(), self.raw(), piece, mesh.as_mut_ptr()) }, world, "Sheet::piece_mesh")?;
        // SAFETY: it filled the struct.
        let mesh = unsafe { mesh.assume_init() };
        Ok(PieceMesh::from_raw(&mesh))
    }

    /// Get the frames of a piece (\*frames points to \*count ids), and the current index of the
    /// piece with a frame.
    pub fn piece_frames(self, world: &mut World, piece: i32) -> Result<&[Frame]> {
        let mut frames = std::ptr::null();
        let mut count = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_GetPieceFrames(world.raw_mut(), self.raw(), piece, &mut frames, &mut count) }, world, "Sheet::piece_frames")?;
        Ok(unsafe { view(frames, count) })
    }

    /// Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one.
    /// \*count: their number.
    pub fn drop_crumbs(self, world: &mut World, area: f32) -> Result<i32> {
        let mut count: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_DropCrumbs(world.raw_mut(), self.raw(), area, &mut count) }, world, "Sheet::drop_crumbs")?;
        Ok(count)
    }

    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point ([`EventType::CutFinished`]).
    pub fn begin_cut(self, world: &mut World, rest_point: impl Into<[f32; 2]>) -> Result<Cut> {
        let rest_point: [f32; 2] = rest_point.into();
        let mut cut = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBeginCut(world.raw_mut(), self.raw(), rest_point.as_ptr(), &mut cut) }, world, "Sheet::begin_cut")?;
        Ok(Cut::known(cut))
    }

    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point ([`EventType::CutFinished`]).
    pub fn cut(self, world: &mut World, rest_points: &[[f32; 2]]) -> Result<Cut> {
        let mut cut = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Cut(world.raw_mut(), self.raw(), rest_points.as_ptr().cast(), rest_points.len() as i32, &mut cut) }, world, "Sheet::cut")?;
        Ok(Cut::known(cut))
    }

    /// Cuts where the quadrilateral swept by an edge in world space, from blade\[0\]-blade\[1\] to
    /// blade\[3\]-blade\[2\], meets the current sheet; past borders, so that it separates the parts
    /// that it crosses. The cut is already ended.
    pub fn slice(self, world: &mut World, blade: [f32; 12]) -> Result<Cut> {
        let mut cut = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_Slice(world.raw_mut(), self.raw(), blade.as_ptr(), &mut cut) }, world, "Sheet::slice")?;
        Ok(Cut::known(cut))
    }

    /// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set
    /// them: parts of the sheet inherit them. [`ResultCode::ErrorArgument`]: a toughness above 0
    /// with a model other than [`Model::Links`], another preset.
    pub fn set_tearing(self, world: &mut World, tearing: &Tearing) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetTearing(world.raw_mut(), self.raw(), &tearing.raw()) }, world, "Sheet::set_tearing")?;
        Ok(())
    }

    /// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set
    /// them: parts of the sheet inherit them. [`ResultCode::ErrorArgument`]: a toughness above 0
    /// with a model other than [`Model::Links`], another preset.
    pub fn tearing(self, world: &World) -> Result<Tearing> {
        let mut tearing = MaybeUninit::<sys::kiriTearing>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetTearing(world.raw(), self.raw(), tearing.as_mut_ptr()) }, "Sheet::tearing")?;
        // SAFETY: it filled the struct.
        let tearing = unsafe { tearing.assume_init() };
        Ok(Tearing::from_raw(&tearing))
    }

    /// Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point:
    /// there) by a factor, 0 or more: below 1 tears follow it, above 1 they stop there. The same
    /// points replace it. [`ResultCode::ErrorArgument`]: no material.
    pub fn set_tear_line(self, world: &mut World, rest_points: &[[f32; 2]], factor: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetTearLine(world.raw_mut(), self.raw(), rest_points.as_ptr().cast(), rest_points.len() as i32, factor) }, world, "Sheet::set_tear_line")?;
        Ok(())
    }

    /// Writes up to capacity ids of the sheet's frames; \*count is how many there are.
    pub fn frames(self, world: &World) -> Result<Vec<Frame>> {
        let mut frames = Vec::<Frame>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriSheet_GetFrames(world.raw(), self.raw(), frames.as_mut_ptr().cast(), capacity as i32, &mut count) }, "Sheet::frames")?;
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

    /// Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a
    /// torque (N m).
    pub fn apply_force(self, world: &mut World, rest_point: impl Into<[f32; 2]>, force: impl Into<[f32; 3]>, torque: impl Into<[f32; 3]>) -> Result<()> {
        let rest_point: [f32; 2] = rest_point.into();
        let force: [f32; 3] = force.into();
        let torque: [f32; 3] = torque.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyForce(world.raw_mut(), self.raw(), rest_point.as_ptr(), force.as_ptr(), torque.as_ptr()) }, world, "Sheet::apply_force")?;
        Ok(())
    }

    /// Applies a force (N/m, world) along a straight line of the rest plane where it lies in the
    /// material, edges included. Along a cut each lip gets half. [`ResultCode::ErrorArgument`]: as
    /// of [`Sheet::clamp_line`].
    pub fn apply_line_load(self, world: &mut World, from: impl Into<[f32; 2]>, to: impl Into<[f32; 2]>, force_per_length: impl Into<[f32; 3]>) -> Result<()> {
        let from: [f32; 2] = from.into();
        let to: [f32; 2] = to.into();
        let force_per_length: [f32; 3] = force_per_length.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyLineLoad(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr(), force_per_length.as_ptr()) }, world, "Sheet::apply_line_load")?;
        Ok(())
    }

    /// Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it.
    pub fn apply_pressure(self, world: &mut World, pressure: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyPressure(world.raw_mut(), self.raw(), pressure) }, world, "Sheet::apply_pressure")?;
        Ok(())
    }

    /// Applies an impulse (N s, world) at a point of the material on the visible surface, at once,
    /// by the mass of the frames that carry the point; a held frame's share is lost.
    /// [`ResultCode::ErrorArgument`]: the point is outside the sheet.
    pub fn apply_impulse(self, world: &mut World, rest_point: impl Into<[f32; 2]>, impulse: impl Into<[f32; 3]>) -> Result<()> {
        let rest_point: [f32; 2] = rest_point.into();
        let impulse: [f32; 3] = impulse.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ApplyImpulse(world.raw_mut(), self.raw(), rest_point.as_ptr(), impulse.as_ptr()) }, world, "Sheet::apply_impulse")?;
        Ok(())
    }

    /// Copies the wind; it blows until the next call.
    pub fn set_wind(self, world: &mut World, wind: &Wind) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetWind(world.raw_mut(), self.raw(), &wind.raw()) }, world, "Sheet::set_wind")?;
        Ok(())
    }

    /// Fill the def with its defaults; pin a point; destroy any pin. On failure \*pin is 0.
    /// [`ResultCode::ErrorArgument`]: outside.
    pub fn create_pin(self, world: &mut World, def: &PinDef) -> Result<Pin> {
        let mut pin = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCreatePin(world.raw_mut(), self.raw(), &def.raw(), &mut pin) }, world, "Sheet::create_pin")?;
        Ok(Pin::known(pin))
    }

    /// Hold a straight line of the rest plane, at its rest length. A clamp holds the place and
    /// direction of its material, as a vice does; a hinge only the place (manual, sheets).
    /// [`ResultCode::ErrorArgument`]: no material; ends equal, or far outside.
    pub fn clamp_line(self, world: &mut World, from: impl Into<[f32; 2]>, to: impl Into<[f32; 2]>) -> Result<Pin> {
        let from: [f32; 2] = from.into();
        let to: [f32; 2] = to.into();
        let mut clamp = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_ClampLine(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr(), &mut clamp) }, world, "Sheet::clamp_line")?;
        Ok(Pin::known(clamp))
    }

    /// Hold a straight line of the rest plane, at its rest length. A clamp holds the place and
    /// direction of its material, as a vice does; a hinge only the place (manual, sheets).
    /// [`ResultCode::ErrorArgument`]: no material; ends equal, or far outside.
    pub fn hinge_line(self, world: &mut World, from: impl Into<[f32; 2]>, to: impl Into<[f32; 2]>) -> Result<Pin> {
        let from: [f32; 2] = from.into();
        let to: [f32; 2] = to.into();
        let mut hinge = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_HingeLine(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr(), &mut hinge) }, world, "Sheet::hinge_line")?;
        Ok(Pin::known(hinge))
    }

    /// Writes up to capacity ids of the sheet's pins, of all types; \*count is how many there are.
    pub fn pins(self, world: &World) -> Result<Vec<Pin>> {
        let mut pins = Vec::<Pin>::new();
        let mut count = 0;
        let mut capacity = 0;
        loop {
            // SAFETY: the arrays have room for so many.
            check_read(unsafe { sys::kiriSheet_GetPins(world.raw(), self.raw(), pins.as_mut_ptr().cast(), capacity as i32, &mut count) }, "Sheet::pins")?;
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

    /// Sets the contacts of the next tick alone. One with point and obstacle of an earlier one
    /// starts with its impulse.
    pub fn set_contacts(self, world: &mut World, contacts: &[Contact]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSheet_SetContacts(world.raw_mut(), self.raw(), contacts.as_ptr().cast(), contacts.len() as i32) }, world, "Sheet::set_contacts")?;
        Ok(())
    }

    /// Gets one result for each contact that was set before the last tick, in that order. A
    /// sleeping piece presses on.
    pub fn contact_forces(self, world: &World) -> Result<&[ContactForce]> {
        let mut forces = std::ptr::null();
        let mut count = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetContactForces(world.raw(), self.raw(), &mut forces, &mut count) }, "Sheet::contact_forces")?;
        Ok(unsafe { view(forces, count) })
    }

    /// Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving
    /// obstacles add their way.
    pub fn reach(self, world: &World, dt: f32) -> Result<([f32; 3], [f32; 3])> {
        let mut lower: [f32; 3] = Default::default();
        let mut upper: [f32; 3] = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSheet_GetReach(world.raw(), self.raw(), dt, lower.as_mut_ptr(), upper.as_mut_ptr()) }, "Sheet::reach")?;
        Ok((lower, upper))
    }
}

impl Frame {
    /// Set rigid motion of a sheet, or of the piece with a frame, until forces change it: velocity
    /// (m/s) of its centre of mass, and `angular_velocity` (rad/s) about it. Planar sheets drop
    /// motion across their plane; held frames stay held.
    pub fn set_piece_velocity(self, world: &mut World, velocity: impl Into<[f32; 3]>, angular_velocity: impl Into<[f32; 3]>) -> Result<()> {
        let velocity: [f32; 3] = velocity.into();
        let angular_velocity: [f32; 3] = angular_velocity.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_SetPieceVelocity(world.raw_mut(), self.raw(), velocity.as_ptr(), angular_velocity.as_ptr()) }, world, "Frame::set_piece_velocity")?;
        Ok(())
    }

    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn set_piece_user_data(self, world: &mut World, data: u64) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_SetPieceUserData(world.raw_mut(), self.raw(), data) }, world, "Frame::set_piece_user_data")?;
        Ok(())
    }

    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn piece_user_data(self, world: &World) -> Result<u64> {
        let mut data: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetPieceUserData(world.raw(), self.raw(), &mut data) }, "Frame::piece_user_data")?;
        Ok(data)
    }

    /// Get the frames of a piece (\*frames points to \*count ids), and the current index of the
    /// piece with a frame.
    pub fn piece(self, world: &World) -> Result<i32> {
        let mut piece: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetPiece(world.raw(), self.raw(), &mut piece) }, "Frame::piece")?;
        Ok(piece)
    }

    /// Makes a sheet of the piece with this frame. All of the piece moves along, with ids and
    /// states; cuts stay with the old sheet. A clamp or hinge that holds both gets a copy with a
    /// new id. [`ResultCode::Pending`]: work on a cut is pending, or the budget lacks samples for
    /// the piece; \*detached is 0, further cuts of the sheet wait, and [`EventType::PieceDetached`]
    /// names the sheet in a later tick. [`ResultCode::ErrorState`]: nothing would be left of the
    /// sheet (manual, cutting).
    pub fn detach_piece(self, world: &mut World) -> Result<Option<Sheet>> {
        let mut detached = 0;
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_DetachPiece(world.raw_mut(), self.raw(), &mut detached) }, world, "Frame::detach_piece")?;
        Ok(Sheet::from_raw(detached))
    }

    /// Removes the piece with this frame at once, with its pins. [`ResultCode::Pending`]: while a
    /// cut is pending its triangles stay with three equal corners, and [`Counts`] counts it, with a
    /// state of zeros. [`ResultCode::ErrorState`]: it is all of its sheet.
    pub fn destroy_piece(self, world: &mut World) -> Result<Status> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        let result = check(unsafe { sys::kiriFrame_DestroyPiece(world.raw_mut(), self.raw()) }, world, "Frame::destroy_piece")?;
        Ok(Status::of(result))
    }

    /// Holds the frame: its rest point moves evenly to position (m, world) with rotation (columns
    /// as above) in the next tick; position and rotation null: frees it. Material that held frames
    /// mostly carry moves through obstacles.
    pub fn hold(self, world: &mut World, position: Option<[f32; 3]>, rotation: Option<[f32; 9]>) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_Hold(world.raw_mut(), self.raw(), position.as_ref().map_or(std::ptr::null(), |rows| rows.as_ptr()), rotation.as_ref().map_or(std::ptr::null(), |rows| rows.as_ptr())) }, world, "Frame::hold")?;
        Ok(())
    }

    /// Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied
    /// to the sheet: means over the last tick that moved the piece, with the frame's own weight and
    /// change of momentum. Zero for a free frame.
    pub fn state(self, world: &World) -> Result<FrameState> {
        let mut state = MaybeUninit::<sys::kiriFrameState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetState(world.raw(), self.raw(), state.as_mut_ptr()) }, "Frame::state")?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(FrameState::from_raw(&state))
    }

    /// Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied
    /// to the sheet: means over the last tick that moved the piece, with the frame's own weight and
    /// change of momentum. Zero for a free frame.
    pub fn reaction(self, world: &World) -> Result<([f64; 3], [f64; 3])> {
        let mut force: [f64; 3] = Default::default();
        let mut torque: [f64; 3] = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriFrame_GetReaction(world.raw(), self.raw(), force.as_mut_ptr(), torque.as_mut_ptr()) }, "Frame::reaction")?;
        Ok((force, torque))
    }

    /// Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a
    /// torque (N m).
    pub fn apply_force(self, world: &mut World, force: impl Into<[f32; 3]>, torque: impl Into<[f32; 3]>) -> Result<()> {
        let force: [f32; 3] = force.into();
        let torque: [f32; 3] = torque.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriFrame_ApplyForce(world.raw_mut(), self.raw(), force.as_ptr(), torque.as_ptr()) }, world, "Frame::apply_force")?;
        Ok(())
    }
}

impl Pin {
    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn set_user_data(self, world: &mut World, data: u64) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetUserData(world.raw_mut(), self.raw(), data) }, world, "Pin::set_user_data")?;
        Ok(())
    }

    /// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has
    /// one, a pin, and a piece, named by any of its frames: parts of a piece that is cut inherit
    /// it, and a sheet that is made of it has both.
    pub fn user_data(self, world: &World) -> Result<u64> {
        let mut data: u64 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriPin_GetUserData(world.raw(), self.raw(), &mut data) }, "Pin::user_data")?;
        Ok(data)
    }

    /// Fill the def with its defaults; pin a point; destroy any pin. On failure \*pin is 0.
    /// [`ResultCode::ErrorArgument`]: outside.
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroyPin(world.raw_mut(), self.raw()) }, world, "Pin::destroy")?;
        Ok(())
    }

    /// Set the target of the pin's point, or of the middle of its line (m, world), and the rotation
    /// of a line's material (columns: directions of u, v, normal; planar: about the normal), for
    /// the end of the next tick and later. The pin moves there evenly. It is drawn at its pin
    /// (manual, sheets). SetPose, [`ResultCode::ErrorArgument`]: a point.
    pub fn set_target(self, world: &mut World, target: impl Into<[f32; 3]>) -> Result<()> {
        let target: [f32; 3] = target.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetTarget(world.raw_mut(), self.raw(), target.as_ptr()) }, world, "Pin::set_target")?;
        Ok(())
    }

    /// Set the target of the pin's point, or of the middle of its line (m, world), and the rotation
    /// of a line's material (columns: directions of u, v, normal; planar: about the normal), for
    /// the end of the next tick and later. The pin moves there evenly. It is drawn at its pin
    /// (manual, sheets). SetPose, [`ResultCode::ErrorArgument`]: a point.
    pub fn set_pose(self, world: &mut World, target: impl Into<[f32; 3]>, rotation: impl Into<[f32; 9]>) -> Result<()> {
        let target: [f32; 3] = target.into();
        let rotation: [f32; 9] = rotation.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetPose(world.raw_mut(), self.raw(), target.as_ptr(), rotation.as_ptr()) }, world, "Pin::set_pose")?;
        Ok(())
    }

    /// Sets the force (N) that breaks a pin of any type; 0: it never breaks.
    pub fn set_break_force(self, world: &mut World, break_force: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriPin_SetBreakForce(world.raw_mut(), self.raw(), break_force) }, world, "Pin::set_break_force")?;
        Ok(())
    }

    /// Get the state; force (N) and torque (N m, about the target) on the sheet: means over the
    /// last tick that moved it.
    pub fn state(self, world: &World) -> Result<PinState> {
        let mut state = MaybeUninit::<sys::kiriPinState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriPin_GetState(world.raw(), self.raw(), state.as_mut_ptr()) }, "Pin::state")?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(PinState::from_raw(&state))
    }

    /// Get the state; force (N) and torque (N m, about the target) on the sheet: means over the
    /// last tick that moved it.
    pub fn reaction(self, world: &World) -> Result<([f64; 3], [f64; 3])> {
        let mut force: [f64; 3] = Default::default();
        let mut torque: [f64; 3] = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriPin_GetReaction(world.raw(), self.raw(), force.as_mut_ptr(), torque.as_mut_ptr()) }, "Pin::reaction")?;
        Ok((force, torque))
    }
}

impl Cut {
    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point ([`EventType::CutFinished`]).
    pub fn extend(self, world: &mut World, rest_points: &[[f32; 2]]) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCut_Extend(world.raw_mut(), self.raw(), rest_points.as_ptr().cast(), rest_points.len() as i32) }, world, "Cut::extend")?;
        Ok(())
    }

    /// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24);
    /// end it; or all at once, from 2 points. Points take effect with the next tick or, by the
    /// budget, a later one. Outside the sheet nothing is cut; an end inside stays closed until the
    /// next point. The id is stale after the tick of the last point ([`EventType::CutFinished`]).
    pub fn end(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriCut_End(world.raw_mut(), self.raw()) }, world, "Cut::end")?;
        Ok(())
    }
}

impl Blade {
    /// Move the blade to the straight edge between two points (m, world), or length m along a ray
    /// that a camera casts; each end goes straight. The first call only places it. An end inside
    /// cuts along its own way. End it: cuts stay.
    pub fn move_edge(self, world: &mut World, from: impl Into<[f32; 3]>, to: impl Into<[f32; 3]>) -> Result<()> {
        let from: [f32; 3] = from.into();
        let to: [f32; 3] = to.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBlade_MoveEdge(world.raw_mut(), self.raw(), from.as_ptr(), to.as_ptr()) }, world, "Blade::move_edge")?;
        Ok(())
    }

    /// Move the blade to the straight edge between two points (m, world), or length m along a ray
    /// that a camera casts; each end goes straight. The first call only places it. An end inside
    /// cuts along its own way. End it: cuts stay.
    pub fn move_ray(self, world: &mut World, origin: impl Into<[f32; 3]>, direction: impl Into<[f32; 3]>, length: f32) -> Result<()> {
        let origin: [f32; 3] = origin.into();
        let direction: [f32; 3] = direction.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBlade_MoveRay(world.raw_mut(), self.raw(), origin.as_ptr(), direction.as_ptr(), length) }, world, "Blade::move_ray")?;
        Ok(())
    }

    /// Move the blade to the straight edge between two points (m, world), or length m along a ray
    /// that a camera casts; each end goes straight. The first call only places it. An end inside
    /// cuts along its own way. End it: cuts stay.
    pub fn end(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriBlade_End(world.raw_mut(), self.raw()) }, world, "Blade::end")?;
        Ok(())
    }
}

impl Seam {
    /// Fill the def with its defaults; create and destroy a seam; set stiffness and `rest_angle`.
    /// On failure \*seam is 0. [`ResultCode::ErrorArgument`]: a line is empty or leaves the
    /// material; a sheet is planar; models differ (manual, sewing).
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroySeam(world.raw_mut(), self.raw()) }, world, "Seam::destroy")?;
        Ok(())
    }

    /// Fill the def with its defaults; create and destroy a seam; set stiffness and `rest_angle`.
    /// On failure \*seam is 0. [`ResultCode::ErrorArgument`]: a line is empty or leaves the
    /// material; a sheet is planar; models differ (manual, sewing).
    pub fn set_hinge(self, world: &mut World, stiffness: f32, rest_angle: f32) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriSeam_SetHinge(world.raw_mut(), self.raw(), stiffness, rest_angle) }, world, "Seam::set_hinge")?;
        Ok(())
    }

    /// Get a stitch that is left, in the order of the lines, and their number.
    /// [`ResultCode::ErrorArgument`]: no such index.
    pub fn stitch(self, world: &World, index: i32) -> Result<Stitch> {
        let mut stitch = MaybeUninit::<sys::kiriStitch>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSeam_GetStitch(world.raw(), self.raw(), index, stitch.as_mut_ptr()) }, "Seam::stitch")?;
        // SAFETY: it filled the struct.
        let stitch = unsafe { stitch.assume_init() };
        Ok(Stitch::from_raw(&stitch))
    }

    /// Get a stitch that is left, in the order of the lines, and their number.
    /// [`ResultCode::ErrorArgument`]: no such index.
    pub fn count(self, world: &World) -> Result<i32> {
        let mut stitches: i32 = Default::default();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriSeam_GetCount(world.raw(), self.raw(), &mut stitches) }, "Seam::count")?;
        Ok(stitches)
    }
}

impl Obstacle {
    /// Fill the def with its defaults; add and destroy an obstacle. On failure \*obstacle is 0.
    /// Pieces on it wake.
    pub fn destroy(self, world: &mut World) -> Result<()> {
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriDestroyObstacle(world.raw_mut(), self.raw()) }, world, "Obstacle::destroy")?;
        Ok(())
    }

    /// Teleports the obstacle (m, world). Sheets react to its velocity
    /// ([`Obstacle::set_velocity`]), not to the jump.
    pub fn set_pose(self, world: &mut World, position: impl Into<[f32; 3]>, rotation: impl Into<[f32; 9]>) -> Result<()> {
        let position: [f32; 3] = position.into();
        let rotation: [f32; 9] = rotation.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetPose(world.raw_mut(), self.raw(), position.as_ptr(), rotation.as_ptr()) }, world, "Obstacle::set_pose")?;
        Ok(())
    }

    /// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg),
    /// inertia and centre of mass.
    pub fn set_velocity(self, world: &mut World, velocity: impl Into<[f32; 3]>, angular_velocity: impl Into<[f32; 3]>) -> Result<()> {
        let velocity: [f32; 3] = velocity.into();
        let angular_velocity: [f32; 3] = angular_velocity.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetVelocity(world.raw_mut(), self.raw(), velocity.as_ptr(), angular_velocity.as_ptr()) }, world, "Obstacle::set_velocity")?;
        Ok(())
    }

    /// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg),
    /// inertia and centre of mass.
    pub fn set_surface_velocity(self, world: &mut World, velocity: impl Into<[f32; 3]>) -> Result<()> {
        let velocity: [f32; 3] = velocity.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetSurfaceVelocity(world.raw_mut(), self.raw(), velocity.as_ptr()) }, world, "Obstacle::set_surface_velocity")?;
        Ok(())
    }

    /// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg),
    /// inertia and centre of mass.
    pub fn set_mass(self, world: &mut World, mass: f32, inertia: [f32; 6], center_of_mass: impl Into<[f32; 3]>) -> Result<()> {
        let center_of_mass: [f32; 3] = center_of_mass.into();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check(unsafe { sys::kiriObstacle_SetMass(world.raw_mut(), self.raw(), mass, inertia.as_ptr(), center_of_mass.as_ptr()) }, world, "Obstacle::set_mass")?;
        Ok(())
    }

    /// Gets the current state.
    pub fn state(self, world: &World) -> Result<ObstacleState> {
        let mut state = MaybeUninit::<sys::kiriObstacleState>::uninit();
        // SAFETY: pointers are to what is named, and lengths are theirs.
        check_read(unsafe { sys::kiriObstacle_GetState(world.raw(), self.raw(), state.as_mut_ptr()) }, "Obstacle::state")?;
        // SAFETY: it filled the struct.
        let state = unsafe { state.assume_init() };
        Ok(ObstacleState::from_raw(&state))
    }
}
