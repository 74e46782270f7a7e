//! Debug draw by a function of the host.

use crate::{check_read, view, DrawVertex, Result, Sheet, World};
use kiri_sys as sys;
use std::ffi::c_void;
use std::mem::MaybeUninit;

/// What vertices are drawn as: one for a point, two for a line, three for a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// One vertex each.
    Points,
    /// Two vertices each.
    Lines,
    /// Three vertices each.
    Triangles,
}

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct DebugDraw {
    /// `DRAW_...`, added up; default: all but [`crate::DRAW_TRIANGLES`] and [`crate::DRAW_EDGES`]
    pub flags: u32,
    /// Only this one is drawn, without obstacles and blades.
    pub sheet: Option<Sheet>,
    /// m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05
    pub size: f32,
}

fn default_raw() -> sys::kiriDebugDraw {
    let mut raw = MaybeUninit::uninit();
    // SAFETY: it fills all of the struct.
    unsafe {
        sys::kiriDefaultDebugDraw(raw.as_mut_ptr());
        raw.assume_init()
    }
}

impl Default for DebugDraw {
    fn default() -> Self {
        let raw = default_raw();
        Self { flags: raw.flags, sheet: Sheet::from_raw(raw.sheet), size: raw.size }
    }
}

/// SAFETY: `user` is what `debug_draw` calls with, and goes on during the call.
unsafe extern "C" fn draw<F: FnMut(Shape, &[DrawVertex]), const SHAPE: u8>(
    user: *mut c_void,
    vertices: *const sys::kiriDrawVertex,
    count: i32,
) {
    let shape = [Shape::Points, Shape::Lines, Shape::Triangles][SHAPE as usize];
    (*user.cast::<F>())(shape, view(vertices, count));
}

impl World {
    /// Draws the world as after the last tick: `function` gets the next vertices, up to 240 in a call. It may not panic.
    pub fn debug_draw<F: FnMut(Shape, &[DrawVertex])>(&self, what: &DebugDraw, mut function: F) -> Result<()> {
        let mut raw = default_raw();
        raw.flags = what.flags;
        raw.sheet = what.sheet.map_or(0, |sheet| sheet.raw());
        raw.size = what.size;
        raw.points = Some(draw::<F, 0>);
        raw.lines = Some(draw::<F, 1>);
        raw.triangles = Some(draw::<F, 2>);
        raw.user = std::ptr::from_mut(&mut function).cast();
        // SAFETY: the functions are called within.
        check_read(unsafe { sys::kiriWorld_DebugDraw(self.raw(), &raw) }, "World::debug_draw")?;
        Ok(())
    }
}
