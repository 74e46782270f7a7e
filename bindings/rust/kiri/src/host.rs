//! The host's functions: what of a world def is no number.

use crate::{sys, Budget};
use std::cell::RefCell;
use std::ffi::{c_char, c_void, CStr};
use std::marker::PhantomData;
use std::mem::MaybeUninit;
use std::sync::atomic::{AtomicI32, Ordering};

thread_local! {
    /// The last line of the log of this thread: what a call that only reads says of its error.
    static LINE: RefCell<String> = const { RefCell::new(String::new()) };
}

pub(crate) fn take_line() -> String {
    LINE.with(|line| std::mem::take(&mut *line.borrow_mut()))
}

/// Where the memory of a world comes from.
///
/// # Safety
/// `alloc` gives that many bytes, aligned to 16, or null; they stay until `free`.
pub unsafe trait Allocator: Send + Sync {
    /// Gives memory, or null.
    fn alloc(&self, bytes: usize) -> *mut u8;
    /// Takes memory back.
    ///
    /// # Safety
    /// The pointer came from `alloc`.
    unsafe fn free(&self, pointer: *mut u8);
}

type Log = Box<dyn Fn(&str) + Send + Sync>;
type Clock = Box<dyn Fn() -> f64 + Send + Sync>;
type Record = Box<dyn FnMut(&[u8]) + Send>;
type Tasks = Box<dyn for<'t> Fn(Task<'t>) + Send + Sync>;

/// Of a world: gravity, budget, and the host's functions. None of these may panic, or use the world.
pub struct WorldDef {
    /// m/s^2; default (0, 0, -9.81)
    pub gravity: [f32; 3],
    /// Default: no limit.
    pub budget: Budget,
    /// Gets one line for each error.
    pub log: Option<Log>,
    /// Seconds; read for the profile only.
    pub clock: Option<Clock>,
    /// Gets the recording of the world, bytes after bytes, see [`crate::Replay`].
    pub record: Option<Record>,
    /// The recording has the state hash after so many ticks, and at the end; 0: never. Default 60.
    pub record_hash_ticks: i32,
    /// Runs the parts of a task, on threads of its own.
    pub tasks: Option<Tasks>,
    /// Threads that may work on a task, the caller of the tick with them, 0 to 1024; up to 1: no task is started.
    pub worker_count: i32,
    /// Default: malloc and free.
    pub allocator: Option<Box<dyn Allocator>>,
}

impl Default for WorldDef {
    fn default() -> Self {
        let raw = default_raw();
        Self {
            gravity: raw.gravity,
            budget: Budget::from_raw(&raw.budget),
            log: None,
            clock: None,
            record: None,
            record_hash_ticks: raw.recordHashTicks,
            tasks: None,
            worker_count: raw.workerCount,
            allocator: None,
        }
    }
}

fn default_raw() -> sys::kiriWorldDef {
    let mut raw = MaybeUninit::uninit();
    // SAFETY: it fills all of the struct.
    unsafe {
        sys::kiriDefaultWorldDef(raw.as_mut_ptr());
        raw.assume_init()
    }
}

impl WorldDef {
    /// As C has it, and what its `user` points to.
    pub(crate) fn into_raw(self) -> (sys::kiriWorldDef, Box<Hooks>) {
        let hooks = Box::new(Hooks {
            log: self.log,
            clock: self.clock,
            record: RefCell::new(self.record),
            tasks: self.tasks,
            allocator: self.allocator,
        });
        let mut raw = default_raw();
        raw.gravity = self.gravity;
        raw.budget = self.budget.raw();
        raw.user = std::ptr::from_ref(&*hooks).cast_mut().cast();
        raw.log = Some(log);
        raw.clock = hooks.clock.as_ref().map(|_| clock as _);
        raw.recordHashTicks = self.record_hash_ticks;
        raw.record = hooks.record.borrow().as_ref().map(|_| record as _);
        raw.workerCount = self.worker_count;
        if hooks.tasks.is_some() {
            raw.startTask = Some(start_task);
            raw.finishTask = Some(finish_task);
        }
        if hooks.allocator.is_some() {
            raw.alloc = Some(alloc);
            raw.free = Some(free);
        }
        (raw, hooks)
    }
}

pub(crate) struct Hooks {
    log: Option<Log>,
    clock: Option<Clock>,
    record: RefCell<Option<Record>>, // called by one thread at a time, by functions that change the world
    tasks: Option<Tasks>,
    allocator: Option<Box<dyn Allocator>>,
}

// SAFETY of these: `user` is the box of hooks, which lives as long as the world.

unsafe fn hooks<'a>(user: *mut c_void) -> &'a Hooks {
    &*user.cast()
}

unsafe extern "C" fn log(user: *mut c_void, line: *const c_char) {
    let line = CStr::from_ptr(line).to_string_lossy();
    LINE.with(|last| line.as_ref().clone_into(&mut last.borrow_mut()));
    if let Some(log) = &hooks(user).log {
        log(&line);
    }
}

unsafe extern "C" fn clock(user: *mut c_void) -> f64 {
    hooks(user).clock.as_ref().map_or(0.0, |clock| clock())
}

unsafe extern "C" fn record(user: *mut c_void, bytes: *const c_void, count: i32) {
    if let Some(record) = hooks(user).record.borrow_mut().as_mut() {
        record(crate::view(bytes, count));
    }
}

unsafe extern "C" fn alloc(user: *mut c_void, bytes: i64) -> *mut c_void {
    hooks(user).allocator.as_ref().map_or(std::ptr::null_mut(), |from| from.alloc(bytes as usize).cast())
}

unsafe extern "C" fn free(user: *mut c_void, pointer: *mut c_void) {
    if let Some(from) = &hooks(user).allocator {
        from.free(pointer.cast());
    }
}

// ---- Tasks

/// Work on items, of which each is to be done once, on any threads, before the host's function returns. What is left then
/// is done by the caller.
pub struct Task<'t> {
    work: &'t Work,
    item_count: i32,
    min_range: i32,
}

struct Work {
    run: unsafe extern "C" fn(i32, i32, *mut c_void),
    context: *mut c_void,
    done: AtomicI32,
}

// SAFETY: the library wants to be called from any threads.
unsafe impl Sync for Work {}

impl<'t> Task<'t> {
    /// At most so many parts, which together are all of it.
    pub fn parts(self, count: usize) -> Parts<'t> {
        let count = i32::try_from(count).unwrap_or(i32::MAX).clamp(1, self.item_count.max(1));
        let size = (self.item_count + count - 1) / count;
        Parts { work: self.work, start: 0, end: self.item_count, size: size.max(self.min_range).max(1) }
    }
}

/// Parts of a task, for the threads of a host.
pub struct Parts<'t> {
    work: &'t Work,
    start: i32,
    end: i32,
    size: i32,
}

impl<'t> Iterator for Parts<'t> {
    type Item = Part<'t>;

    fn next(&mut self) -> Option<Part<'t>> {
        let start = self.start;
        self.start = self.end.min(start.saturating_add(self.size));
        (start < self.start).then_some(Part { work: self.work, start, end: self.start, _send: PhantomData })
    }
}

/// Items that no other part has.
#[must_use = "it is done by run"]
pub struct Part<'t> {
    work: &'t Work,
    start: i32,
    end: i32,
    _send: PhantomData<&'t ()>,
}

impl Part<'_> {
    /// Does the work on its items.
    pub fn run(self) {
        // SAFETY: no other part has these items, and the task still goes on.
        unsafe { (self.work.run)(self.start, self.end, self.work.context) };
        self.work.done.fetch_add(self.end - self.start, Ordering::Release);
    }
}

/// The host's function returns when all is done, so there is no handle.
unsafe extern "C" fn start_task(
    user: *mut c_void,
    task: sys::kiriTaskFn,
    item_count: i32,
    min_range: i32,
    context: *mut c_void,
) -> *mut c_void {
    if let (Some(run), Some(tasks)) = (task, &hooks(user).tasks) {
        let work = Work { run, context, done: AtomicI32::new(0) };
        tasks(Task { work: &work, item_count, min_range });
        assert_eq!(work.done.load(Ordering::Acquire), item_count, "the host has run all parts of a task");
    }
    std::ptr::null_mut()
}

unsafe extern "C" fn finish_task(_user: *mut c_void, _handle: *mut c_void) {}
