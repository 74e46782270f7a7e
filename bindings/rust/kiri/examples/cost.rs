//! What calls cost: nanoseconds a call, microseconds for 10 000 vertices, memory of Rust that a tick takes.

use kiri::{World, WorldDef};
use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

struct Counted;

static REQUESTS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: it is that of the system.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        REQUESTS.fetch_add(1, Ordering::Relaxed);
        System.alloc(layout)
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        System.dealloc(pointer, layout)
    }
}

#[global_allocator]
static MEMORY: Counted = Counted;

/// The least of some runs, in nanoseconds.
fn least(runs: usize, mut work: impl FnMut()) -> f64 {
    let time = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..runs).map(|_| time(&mut work)).fold(f64::MAX, f64::min) * 1e9
}

fn main() -> kiri::Result<()> {
    let mut world = World::new(WorldDef::default())?;
    let sheet = world.create_rectangle(1.0, 1.0, 99, 99, None)?;
    let _ = world.tick(1.0 / 60.0, 2)?;

    const CALLS: usize = 100_000;
    let counts = least(9, || {
        for _ in 0..CALLS {
            black_box(black_box(sheet).counts(&world)).ok();
        }
    });
    let mesh = least(9, || {
        for _ in 0..CALLS {
            black_box(black_box(sheet).mesh(&world)).ok();
        }
    });
    println!("ns a call: counts {:.1}, mesh {:.1}", counts / CALLS as f64, mesh / CALLS as f64);

    let mut vertices = vec![[0.0f32; 8]; sheet.counts(&world)?.vertices as usize];
    let copy = least(99, || drop(black_box(sheet.copy_vertices(&world, 0, &mut vertices))));
    println!("us for {} vertices with normals, 32 bytes each: {:.1}", vertices.len(), copy / 1e3);

    let before = REQUESTS.load(Ordering::Relaxed);
    for _ in 0..60 {
        let _ = world.tick(1.0 / 60.0, 2)?;
        sheet.copy_vertices(&world, 0, &mut vertices)?;
        black_box(world.events()?.count() + sheet.mesh(&world)?.indices.len());
    }
    println!(
        "requests for memory by Rust in 60 ticks with events, mesh and copy: {}",
        REQUESTS.load(Ordering::Relaxed) - before
    );
    assert_eq!(REQUESTS.load(Ordering::Relaxed), before);
    Ok(())
}
