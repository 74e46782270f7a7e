//! A sheet of paper: drag with the mouse to cut it, R for a new one, Esc to leave.
//!
//!   kiri-macroquad [--script PICTURE.png]   plays a cut by itself, writes a picture, and says the state hash

mod scene;
mod sheet;

use macroquad::prelude::*;
use scene::Scene;

/// Ticks of the script; the cut is made in those from 20 to 80.
const SCRIPT: i32 = 150;

fn conf() -> macroquad::conf::Conf {
    macroquad::conf::Conf {
        miniquad_conf: Conf {
            window_title: "Kiri: drag to cut".into(),
            window_width: 800,
            window_height: 600,
            sample_count: 4,
            ..Default::default()
        },
        draw_call_vertex_capacity: 65536,
        draw_call_index_capacity: 3 * 65536,
        ..Default::default()
    }
}

fn camera() -> Camera3D {
    Camera3D { position: vec3(1.5, 0.75, 2.4), target: vec3(0.5, 0.15, 0.0), up: Vec3::Y, ..Default::default() }
}

/// Through the mouse, from the camera on.
fn ray(camera: &Camera3D, mouse: Vec2) -> (Vec3, Vec3) {
    let inverse = camera.matrix().inverse();
    let (x, y) = (2.0 * mouse.x / screen_width() - 1.0, 1.0 - 2.0 * mouse.y / screen_height());
    let far = inverse.project_point3(vec3(x, y, 0.9));
    (camera.position, (far - camera.position).normalize())
}

/// A wave from side to side.
fn script_ray(camera: &Camera3D, tick: i32) -> Option<(Vec3, Vec3)> {
    let way = (20..80).contains(&tick).then(|| (tick - 20) as f32 / 58.0)?;
    let at = vec3(-0.1 + 1.2 * way, 0.5 + 0.08 * (12.0 * way).sin(), 0.0);
    Some((camera.position, (at - camera.position).normalize()))
}

#[macroquad::main(conf)]
async fn main() {
    if let Err(error) = run().await {
        eprintln!("{error}");
        std::process::exit(1);
    }
}

async fn run() -> kiri::Result<()> {
    let mut arguments = std::env::args().skip_while(|argument| argument != "--script");
    let picture = arguments.next().and_then(|_| arguments.next());
    let (mut scene, camera) = (Scene::new()?, camera());
    let (mut tick, mut late) = (0, 0.0);
    while !is_key_down(KeyCode::Escape) {
        if is_key_pressed(KeyCode::R) {
            scene = Scene::new()?;
        }
        late = if picture.is_some() { 1.0 / 60.0 } else { f32::min(late + get_frame_time(), 0.1) };
        let mouse = is_mouse_button_down(MouseButton::Left).then(|| ray(&camera, mouse_position().into()));
        while late >= 1.0 / 60.0 {
            scene.cut_along(if picture.is_some() { script_ray(&camera, tick) } else { mouse })?;
            scene.tick()?;
            (tick, late) = (tick + 1, late - 1.0 / 60.0);
        }
        clear_background(Color::from_rgba(226, 232, 238, 255));
        set_camera(&camera);
        scene.draw();
        set_default_camera();
        if let Some(path) = picture.as_ref().filter(|_| tick == SCRIPT) {
            get_screen_data().export_png(path);
            println!("{}", scene.says()?);
            return Ok(());
        }
        next_frame().await;
    }
    Ok(())
}
