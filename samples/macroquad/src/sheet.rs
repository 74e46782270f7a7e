//! A sheet as macroquad draws it.

use kiri::{Sheet, World};
use macroquad::models::Mesh;
use macroquad::prelude::*;

const SUN: Vec3 = Vec3::new(0.3, 0.5, 0.81);

pub struct Drawn {
    pub sheet: Sheet,
    mesh: Mesh,
    revision: u32,
    size: Vec2,
}

impl Drawn {
    pub fn new(sheet: Sheet, size: Vec2, print: &Texture2D) -> Self {
        let mesh = Mesh { vertices: Vec::new(), indices: Vec::new(), texture: Some(print.clone()) };
        Self { sheet, mesh, revision: 0, size }
    }

    /// Positions and shades in each frame; corners and the place in the print where a cut has changed them.
    pub fn update(&mut self, world: &World) -> kiri::Result<()> {
        let seen = self.sheet.mesh(world)?;
        if seen.revision != self.revision {
            self.revision = seen.revision;
            self.mesh.indices.clear();
            self.mesh.indices.extend(seen.indices.iter().flatten().map(|&corner| corner as u16));
            self.mesh.vertices.clear();
            self.mesh.vertices.extend(seen.rest_positions.iter().map(|rest| vertex(*rest, self.size)));
        }
        let normals = seen.normals.unwrap_or_default();
        for ((vertex, position), normal) in self.mesh.vertices.iter_mut().zip(seen.positions).zip(normals) {
            vertex.position = Vec3::from_array(*position);
            let light = 0.5 + 0.5 * Vec3::from_array(*normal).dot(SUN).abs();
            let shade = (255.0 * light) as u8;
            vertex.color = [shade, shade, shade, 255];
        }
        Ok(())
    }

    pub fn draw(&self) {
        draw_mesh(&self.mesh);
    }
}

fn vertex(rest: [f32; 2], size: Vec2) -> Vertex {
    let uv = Vec2::from_array(rest) / size;
    Vertex { position: Vec3::ZERO, uv: vec2(uv.x, 1.0 - uv.y), color: [255; 4], normal: Vec4::ZERO }
}
