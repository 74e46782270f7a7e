//! A sheet of paper that hangs over a ball, and a blade. Pieces that come off get a sheet of their own.

use crate::sheet::Drawn;
use kiri::{Blade, Budget, Event, MaterialPreset, ObstacleDef, ObstacleType, PinDef, SheetDef, World, WorldDef};
use macroquad::prelude::*;

pub const SIZE: Vec2 = vec2(1.0, 1.0);
pub const BALL: (Vec3, f32) = (vec3(0.5, -0.55, 0.05), 0.25);
const FLOOR: f32 = -0.8;
const TICK: f32 = 1.0 / 60.0;
// Of work on cuts in a tick: about 2 ms.
const BUDGET: Budget = Budget { triangles: 0, cells: 32000, samples: 4000, iterations: 0 };

pub struct Scene {
    world: World,
    sheets: Vec<Drawn>,
    blade: Option<Blade>,
    print: Texture2D,
}

impl Scene {
    pub fn new() -> kiri::Result<Self> {
        let mut world = World::new(WorldDef { gravity: [0.0, -9.81, 0.0], budget: BUDGET, ..Default::default() })?;
        let mut def = SheetDef {
            material: kiri::material(MaterialPreset::Paper)?,
            axis_u: [1.0, 0.0, 0.0],
            axis_v: [0.0, 1.0, 0.0],
            frame_count: 9,
            touches_sheets: true,
            contact_thickness: 0.01,
            ..Default::default()
        };
        def.material.youngs_modulus = 2e8;
        let sheet = world.create_rectangle(SIZE.x, SIZE.y, 32, 32, Some(&def))?;
        for u in [0.0, SIZE.x] {
            let pin = PinDef { rest_point: [u, SIZE.y], target: [u, SIZE.y, 0.0], ..Default::default() };
            sheet.create_pin(&mut world, &pin)?;
        }
        // A plane's third column points out.
        let rotation = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0];
        world.create_obstacle(&ObstacleDef { position: [0.0, FLOOR, 0.0], rotation, ..Default::default() })?;
        world.create_obstacle(&ObstacleDef {
            kind: ObstacleType::Sphere,
            radius: BALL.1,
            position: BALL.0.to_array(),
            ..Default::default()
        })?;
        let print = print();
        Ok(Self { world, sheets: vec![Drawn::new(sheet, SIZE, &print)], blade: None, print })
    }

    /// The blade is a ray of the camera, as long as the button is down.
    pub fn cut_along(&mut self, ray: Option<(Vec3, Vec3)>) -> kiri::Result<()> {
        match (ray, self.blade) {
            (Some((origin, direction)), blade) => {
                let blade = blade.map_or_else(|| self.world.begin_blade(None), Ok)?;
                self.blade = Some(blade);
                blade.move_ray(&mut self.world, origin.to_array(), direction.to_array(), 10.0)
            }
            (None, Some(blade)) => {
                self.blade = None;
                blade.end(&mut self.world)
            }
            (None, None) => Ok(()),
        }
    }

    pub fn tick(&mut self) -> kiri::Result<()> {
        let _ = self.world.tick(TICK, 2)?;
        let off = self.world.events()?.filter_map(|event| match event {
            Event::PieceOff { frame, .. } => Some(frame),
            _ => None,
        });
        for frame in off.collect::<Vec<_>>() {
            if let Some(sheet) = frame.detach_piece(&mut self.world)? {
                self.sheets.push(Drawn::new(sheet, SIZE, &self.print));
            }
        }
        self.sheets.iter_mut().try_for_each(|sheet| sheet.update(&self.world))
    }

    pub fn draw(&self) {
        draw_plane(vec3(0.5, FLOOR, 0.0), vec2(4.0, 4.0), None, Color::from_rgba(206, 198, 184, 255));
        draw_sphere(BALL.0, BALL.1 - 0.006, None, Color::from_rgba(58, 110, 165, 255));
        self.sheets.iter().for_each(Drawn::draw);
    }

    pub fn says(&self) -> kiri::Result<String> {
        Ok(format!("{} sheets, hash {:016x}", self.sheets.len(), self.world.state_hash()?))
    }
}

/// Lines and a margin, as on paper for school.
fn print() -> Texture2D {
    let mut image = Image::gen_image_color(256, 256, Color::from_rgba(252, 250, 242, 255));
    for y in 0..256 {
        for x in 0..256 {
            let color = match (x, y) {
                (34..36, _) => Color::from_rgba(214, 80, 80, 255),
                (_, y) if y % 16 == 8 => Color::from_rgba(140, 170, 214, 255),
                _ => continue,
            };
            image.set_pixel(x, y, color);
        }
    }
    Texture2D::from_image(&image)
}
