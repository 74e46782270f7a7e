//! tests/twin.c: it prints the same hash.

use kiri::{Event, ObstacleDef, ObstacleType, PinDef, Sheet, SheetDef, World, WorldDef};

fn make_sheet(world: &mut World) -> kiri::Result<Sheet> {
    let mut def = SheetDef { position: [0.0, 0.0, 1.0], frame_count: 6, ..SheetDef::default() };
    def.material.youngs_modulus = 1e7;
    world.create_rectangle(1.0, 0.75, 16, 12, Some(&def))
}

fn pin(world: &mut World, sheet: Sheet, u: f32, v: f32) -> kiri::Result<()> {
    sheet.create_pin(world, &PinDef { rest_point: [u, v], target: [u, v, 1.0], ..PinDef::default() })?;
    Ok(())
}

fn add_ball(world: &mut World) -> kiri::Result<()> {
    world.create_obstacle(&ObstacleDef {
        kind: ObstacleType::Sphere,
        radius: 0.25,
        position: [0.5; 3],
        ..ObstacleDef::default()
    })?;
    Ok(())
}

/// Each piece that came off in the last tick gets a sheet of its own.
fn detach_pieces(world: &mut World) -> kiri::Result<()> {
    let events: Vec<Event> = world.events()?.collect();
    for event in events {
        if let Event::PieceOff { frame, .. } = event {
            frame.detach_piece(world)?;
        }
    }
    Ok(())
}

pub fn run(world: &mut World) -> kiri::Result<u64> {
    let sheet = make_sheet(world)?;
    pin(world, sheet, 0.0, 0.0)?;
    pin(world, sheet, 1.0, 0.0)?;
    add_ball(world)?;
    sheet.cut(world, &[[0.3, -0.1], [0.3, 0.4], [0.7, 0.45], [0.65, 0.85]])?;
    let blade = world.begin_blade(None)?;
    for tick in 0..120 {
        if (40..60).contains(&tick) {
            let x = 0.0625 * (tick - 44) as f32;
            blade.move_edge(world, [x, 0.125, -1.0], [x, 0.125, 2.0])?;
        } else if tick == 60 {
            blade.end(world)?;
        }
        let _ = world.tick(1.0 / 60.0, 2)?;
        detach_pieces(world)?;
    }
    world.state_hash()
}

#[allow(dead_code)]
fn main() -> kiri::Result<()> {
    let mut world = World::new(WorldDef { gravity: [1.0, 0.0, -9.81], ..WorldDef::default() })?;
    println!("hash {:016x}", run(&mut world)?);
    println!("sheets {}", world.sheets()?.len());
    Ok(())
}
