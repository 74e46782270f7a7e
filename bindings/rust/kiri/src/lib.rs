#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

use kiri_sys as sys;
use std::fmt;
use std::marker::PhantomData;
use std::ptr::NonNull;

#[allow(clippy::type_complexity)]
#[rustfmt::skip]
mod generated;
mod debug_draw;
mod host;

pub use debug_draw::{DebugDraw, Shape};
pub use generated::*;
pub use host::{Allocator, Part, Parts, Task, WorldDef};

/// What a call refuses: what it is, and a line that says why.
#[derive(Clone, Debug)]
pub struct Error {
    /// The result of C.
    pub code: ResultCode,
    /// The function, such as `Sheet::point`.
    pub call: &'static str,
    /// What was wrong.
    pub line: String,
}

/// What a call gives, or why it failed.
pub type Result<T> = std::result::Result<T, Error>;

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({:?})", self.call, self.line, self.code)
    }
}

impl std::error::Error for Error {}

/// Whether work is left for later ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "work may be left for later ticks"]
pub enum Status {
    /// Nothing is left.
    Done,
    /// Work is left for later ticks.
    Pending,
}

impl Status {
    fn of(result: i32) -> Self {
        if result == sys::KIRI_PENDING {
            Self::Pending
        } else {
            Self::Done
        }
    }
}

// ---- Results

/// A line of C begins with its name for the call, and ends with the code; fields are named as in C.
fn error(result: i32, call: &'static str, line: &str) -> Error {
    let code = ResultCode::known(result);
    let line = line.split_once(": ").map_or(result_text(code), |(_, why)| why);
    let line = line.strip_suffix(&format!(" ({})", result_name(code))).unwrap_or(line);
    let mut own = String::new();
    let mut starts_low = false; // the word
    for (before, c) in std::iter::once(' ').chain(line.chars()).zip(line.chars()) {
        starts_low = if before.is_alphanumeric() { starts_low } else { c.is_lowercase() };
        if starts_low && c.is_uppercase() {
            own.push('_');
            own.push(c.to_ascii_lowercase());
        } else {
            own.push(c);
        }
    }
    Error { code, call, line: own }
}

/// Of functions that change the world.
fn check(result: i32, world: &World, call: &'static str) -> Result<i32> {
    if result >= 0 {
        Ok(result)
    } else {
        Err(error(result, call, world.last_error()))
    }
}

/// Of functions that read it: these give their line to the log.
fn check_read(result: i32, call: &'static str) -> Result<i32> {
    if result >= 0 {
        Ok(result)
    } else {
        Err(error(result, call, &host::take_line()))
    }
}

/// Of functions without a world.
fn fail(result: i32, call: &'static str) -> Result<i32> {
    if result >= 0 {
        Ok(result)
    } else {
        Err(error(result, call, ""))
    }
}

// ---- What the library hands out

/// # Safety
/// Where it is not null it points to `count` rows that stay for as long.
unsafe fn view<'a, T, C>(rows: *const C, count: i32) -> &'a [T] {
    if rows.is_null() || count <= 0 {
        return &[];
    }
    std::slice::from_raw_parts(rows.cast(), count as usize)
}

/// # Safety
/// It is a text that ends with 0, and stays.
unsafe fn text<'a>(start: *const std::ffi::c_char) -> &'a str {
    std::ffi::CStr::from_ptr(start).to_str().unwrap_or("")
}

// ---- World

/// All sheets and what they touch. What it lends (a mesh, events) borrows it, so it cannot be kept over a tick:
///
/// ```compile_fail,E0502
/// # let mut world = kiri::World::new(Default::default()).unwrap();
/// # let sheet = world.create_rectangle(1.0, 1.0, 4, 4, None).unwrap();
/// let mesh = sheet.mesh(&world).unwrap();
/// let _ = world.tick(1.0 / 60.0, 1);
/// println!("{:?}", mesh.positions[0]); // the tick has moved it
/// ```
pub struct World {
    raw: NonNull<sys::kiriWorld>,
    _host: Box<host::Hooks>, // lives as long
}

// SAFETY: a world is used by one thread at a time where it changes; any number of them may read it.
unsafe impl Send for World {}
unsafe impl Sync for World {}

impl World {
    /// Makes an empty world.
    pub fn new(def: WorldDef) -> Result<Self> {
        assert_eq!(version(), sys::KIRI_VERSION, "the library is of another version than the crate");
        let (raw_def, host) = def.into_raw();
        let mut raw = std::ptr::null_mut();
        // SAFETY: the hooks stay where they are, in their box, until the world is gone.
        check_read(unsafe { sys::kiriCreateWorld(&raw_def, &mut raw) }, "World::new")?;
        Ok(Self { raw: NonNull::new(raw).expect("the library gives a world"), _host: host })
    }

    /// For functions of `kiri_sys`.
    pub fn raw(&self) -> *const sys::kiriWorld {
        self.raw.as_ptr()
    }

    /// For functions of `kiri_sys`. A tick ends what the world has lent.
    pub fn raw_mut(&mut self) -> *mut sys::kiriWorld {
        self.raw.as_ptr()
    }

    /// What went wrong in the last call that changes the world, in one line.
    pub fn last_error(&self) -> &str {
        // SAFETY: it stays until the world changes, which is borrowed until then.
        unsafe { text(sys::kiriWorld_GetLastError(self.raw())) }
    }

    /// What happened since the start of the last tick that was not refused.
    pub fn events(&self) -> Result<Events<'_>> {
        let (mut rows, mut count) = (std::ptr::null(), 0);
        // SAFETY: the rows stay until the next tick.
        check_read(unsafe { sys::kiriWorld_GetEvents(self.raw(), &mut rows, &mut count) }, "World::events")?;
        Ok(Events(unsafe { view(rows, count) }.iter()))
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: nobody has it any more.
        unsafe { sys::kiriDestroyWorld(self.raw.as_ptr()) }
    }
}

impl fmt::Debug for World {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "World({:?})", self.raw)
    }
}

/// The library's version: 10000 major + 100 minor + patch.
pub fn version() -> i32 {
    // SAFETY: it only returns a number.
    unsafe { sys::kiriGetVersion() }
}

/// Events of a tick, read where the library has them.
#[derive(Clone, Debug)]
pub struct Events<'w>(std::slice::Iter<'w, sys::kiriEvent>);

impl Iterator for Events<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        self.0.next().map(Event::from_raw)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.0.size_hint()
    }
}

impl ExactSizeIterator for Events<'_> {}

// ---- Vertices of a host

/// What a host has of a vertex.
///
/// # Safety
/// At these offsets, which are multiples of 4, it has 3 floats, or whatever may be any bits.
pub unsafe trait Vertex {
    /// Bytes from the start of a vertex to its position.
    const POSITION: usize;
    /// Bytes from the start of a vertex to its normal; `None`: it has none.
    const NORMAL: Option<usize>;
}

// SAFETY: all of it is floats.
unsafe impl Vertex for [f32; 3] {
    const POSITION: usize = 0;
    const NORMAL: Option<usize> = None;
}

/// Position, normal.
// SAFETY: all of it is floats.
unsafe impl Vertex for [f32; 6] {
    const POSITION: usize = 0;
    const NORMAL: Option<usize> = Some(12);
}

/// Position, normal, and two coordinates of a texture, which stay.
// SAFETY: all of it is floats.
unsafe impl Vertex for [f32; 8] {
    const POSITION: usize = 0;
    const NORMAL: Option<usize> = Some(12);
}

impl Sheet {
    /// Copies positions and normals of vertices, from the first on, to where the host wants them.
    pub fn copy_vertices<V: Vertex>(self, world: &World, first: i32, vertices: &mut [V]) -> Result<()> {
        let stride = size_of::<V>();
        assert!(V::POSITION.max(V::NORMAL.unwrap_or(0)) + 12 <= stride, "a vertex has its position and normal");
        let rows: *mut u8 = vertices.as_mut_ptr().cast();
        let stride = stride as i32;
        // SAFETY: each vertex has 12 bytes at these offsets, which may be any.
        let result = unsafe {
            let normals = V::NORMAL.map_or(std::ptr::null_mut(), |at| rows.wrapping_add(at));
            sys::kiriSheet_CopyVertices(
                world.raw(),
                self.raw(),
                first,
                vertices.len() as i32,
                rows.wrapping_add(V::POSITION).cast(),
                stride,
                normals.cast(),
                stride,
            )
        };
        check_read(result, "Sheet::copy_vertices")?;
        Ok(())
    }

    /// The pieces that hang together, in the order of their numbers.
    pub fn pieces(self, world: &mut World) -> Result<Pieces<'_>> {
        let pieces = 0..self.counts(world)?.pieces;
        Ok(Pieces { world, sheet: self, pieces })
    }
}

/// Pieces of a sheet, each found when it is asked for.
#[derive(Debug)]
pub struct Pieces<'w> {
    world: &'w mut World,
    sheet: Sheet,
    pieces: std::ops::Range<i32>,
}

impl Iterator for Pieces<'_> {
    type Item = Result<PieceState>;

    fn next(&mut self) -> Option<Result<PieceState>> {
        self.pieces.next().map(|piece| self.sheet.piece(self.world, piece))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.pieces.size_hint()
    }
}

impl ExactSizeIterator for Pieces<'_> {}

impl<'a> Mesh<'a> {
    /// Positions of the corners of each triangle, m.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [[f32; 3]; 3]> + 'a {
        let positions = self.positions;
        self.indices.iter().map(move |corners| corners.map(|i| positions[i as usize]))
    }
}

// ---- Replay

/// A recording, and how far it has come.
#[derive(Debug)]
pub struct Replay<'r> {
    raw: sys::kiriReplay,
    recording: &'r [u8],
    _note: PhantomData<&'r [u8]>,
}

impl<'r> Replay<'r> {
    /// Begins at the start of a recording.
    pub fn new(recording: &'r [u8]) -> Self {
        let raw = sys::kiriReplay { offset: 0, calls: 0, ticks: 0, note: std::ptr::null(), noteCount: 0 };
        Self { raw, recording, _note: PhantomData }
    }

    /// Makes the calls up to the next tick or note, and that one, in a world that was new at the start.
    pub fn step(&mut self, world: &mut World) -> Result<Status> {
        let size = self.recording.len() as i64;
        // SAFETY: the recording has so many bytes.
        let result =
            unsafe { sys::kiriWorld_Replay(world.raw_mut(), self.recording.as_ptr().cast(), size, &mut self.raw) };
        Ok(Status::of(check(result, world, "Replay::step")?))
    }

    /// Where it stopped at a note: its bytes.
    pub fn note(&self) -> Option<&'r [u8]> {
        // SAFETY: it is a part of the recording.
        (!self.raw.note.is_null()).then(|| unsafe { view(self.raw.note, self.raw.noteCount) })
    }

    /// In the recording: where it goes on.
    pub fn offset(&self) -> i64 {
        self.raw.offset
    }

    /// Made so far.
    pub fn calls(&self) -> i64 {
        self.raw.calls
    }

    /// That were not refused.
    pub fn ticks(&self) -> i64 {
        self.raw.ticks
    }
}
