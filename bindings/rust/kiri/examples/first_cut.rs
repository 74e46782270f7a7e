use kiri::{World, WorldDef};

fn main() -> kiri::Result<()> {
    let mut world = World::new(WorldDef::default())?;
    let sheet = world.create_rectangle(1.0, 1.0, 32, 32, None)?;
    sheet.cut(&mut world, &[[-0.1, 0.4], [0.5, 0.6], [1.1, 0.4]])?;
    while world.tick(1.0 / 60.0, 2)? == kiri::Status::Pending {}
    println!("{} pieces", sheet.counts(&world)?.pieces);
    Ok(())
}
