use kiri::{
    Allocator, Contact, Event, Frame, ObstacleDef, Replay, ResultCode, Sheet, SheetDef, Status, World, WorldDef,
};
use std::alloc::Layout;
use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

#[path = "../examples/twin.rs"]
mod twin;

const DT: f32 = 1.0 / 60.0;

fn twin_def() -> WorldDef {
    WorldDef { gravity: [1.0, 0.0, -9.81], ..WorldDef::default() }
}

fn small() -> (World, Sheet) {
    let mut world = World::new(WorldDef::default()).unwrap();
    let sheet = world.create_rectangle(1.0, 1.0, 8, 8, None).unwrap();
    (world, sheet)
}

fn ticks(world: &mut World, count: i32) {
    for _ in 0..count {
        let _ = world.tick(DT, 1).unwrap();
    }
}

#[test]
fn each_function_is_called() {
    let described = include_str!("../../../kiri.json");
    let (_, functions) = described.split_once("\n \"functions\": [").unwrap();
    let sources = [
        include_str!("../src/generated.rs"),
        include_str!("../src/lib.rs"),
        include_str!("../src/host.rs"),
        include_str!("../src/debug_draw.rs"),
    ];
    let mut count = 0;
    for line in functions.lines().filter_map(|line| line.strip_prefix("   \"name\": \"")) {
        let name = line.trim_end_matches("\",");
        assert!(sources.iter().any(|source| source.contains(&format!("sys::{name}("))), "{name} is not called");
        count += 1;
    }
    assert!(count >= 102);
}

#[test]
fn errors_have_a_code_and_a_line() {
    let (mut world, sheet) = small();
    let refused =
        sheet.create_pin(&mut world, &kiri::PinDef { rest_point: [7.0, 7.0], ..Default::default() }).unwrap_err();
    assert_eq!(refused.code, ResultCode::ErrorArgument);
    assert!(!refused.line.is_empty() && world.last_error().starts_with("kiriCreatePin: "));
    let def = kiri::PinDef { break_force: f32::NAN, ..Default::default() };
    let refused = sheet.create_pin(&mut world, &def).unwrap_err().to_string();
    assert_eq!(refused, "Sheet::create_pin: def.break_force is NaN, not 0 or more (ErrorArgument)");
    let refused = sheet.point(&world, [7.0, 7.0]).unwrap_err();
    assert!(
        refused.code == ResultCode::ErrorArgument && refused.call == "Sheet::point" && !refused.line.contains("KIRI")
    );
    let refused = kiri::fill_rectangle(0.0, 1.0, 1, 1).unwrap_err();
    assert!(refused.to_string().starts_with("fill_rectangle: ") && !refused.line.is_empty());
    sheet.destroy(&mut world).unwrap();
    assert_eq!(sheet.counts(&world).unwrap_err().code, ResultCode::ErrorId);
}

#[test]
fn a_setup_is_a_def() {
    let mut world = World::new(WorldDef::default()).unwrap();
    let def = kiri::setup(kiri::SetupPreset::Paper, 0.3, 0.3).unwrap();
    let sheet = world.create_rectangle(0.3, 0.3, 0, 0, Some(&def)).unwrap();
    let counts = sheet.counts(&world).unwrap();
    assert_eq!((counts.frames, counts.triangles), (25, 7200));
}

#[test]
fn the_log_gets_the_lines() {
    let lines = Arc::new(Mutex::new(Vec::new()));
    let kept = lines.clone();
    let log = move |line: &str| kept.lock().unwrap().push(line.to_owned());
    let mut world = World::new(WorldDef { log: Some(Box::new(log)), ..Default::default() }).unwrap();
    let refused = world.create_rectangle(-1.0, 1.0, 4, 4, None).unwrap_err();
    assert!(lines.lock().unwrap()[0].contains(&refused.line));
}

#[test]
fn views_are_where_the_library_has_them() {
    let (mut world, sheet) = small();
    ticks(&mut world, 2);
    let (mesh, again) = (sheet.mesh(&world).unwrap(), sheet.mesh(&world).unwrap());
    assert_eq!(mesh.positions.as_ptr(), again.positions.as_ptr());
    assert_eq!((mesh.positions.len(), mesh.indices.len()), (81, 128));
    assert_eq!(mesh.normals.unwrap().len(), 81);
    let (mut vertices, mut corners) = (vec![[9.0f32; 8]; 80], vec![[0u16; 3]; 128]);
    sheet.copy_vertices(&world, 1, &mut vertices).unwrap();
    assert_eq!(vertices[3][..3], mesh.positions[4]);
    assert_eq!(vertices[3][3..6], mesh.normals.unwrap()[4]);
    assert_eq!(vertices[3][6..], [9.0; 2]);
    sheet.copy_indices16(&world, 0, &mut corners).unwrap();
    assert!(mesh.indices.iter().flatten().eq(corners
        .as_flattened()
        .iter()
        .map(|i| i32::from(*i))
        .collect::<Vec<_>>()
        .iter()));
    assert!(sheet.copy_vertices(&world, 80, &mut vertices).is_err());
    let (mut sources, mut weights, mut before) = (vec![0; 2], vec![[9.0f32; 9]; 2], vec![0; 3]);
    sheet.copy_sources(&world, 1, &mut sources).unwrap();
    sheet.copy_source_weights(&world, 1, &mut weights).unwrap();
    assert_eq!(sheet.copy_previous(&world, 2, &mut before).unwrap(), sheet);
    assert_eq!((sources, before), (vec![1, 2], vec![2, 3, 4]));
    assert_eq!(weights[1], [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn sheets_have_a_mesh_of_the_host_and_no_normals_where_none_are_made() {
    let mut world = World::new(WorldDef::default()).unwrap();
    let (rest_positions, indices) = kiri::fill_rectangle(2.0, 1.0, 4, 2).unwrap();
    let points = [[0.5, 0.5], [1.5, 0.5]];
    let def = SheetDef {
        rest_positions: &rest_positions,
        indices: &indices,
        frame_points: Some(&points),
        max_frames: 2,
        normals: false,
        ..Default::default()
    };
    let sheet = world.create_sheet(&def).unwrap();
    assert!(sheet.mesh(&world).unwrap().normals.is_none());
    assert_eq!(sheet.frames(&world).unwrap().len(), 2);
    let (frames, weights, gradients) = sheet.weights(&world, [0.9, 0.5]).unwrap();
    assert_eq!((frames.len(), weights.len(), gradients.len()), (2, 2, 2));
    assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
    let mut settings = sheet.settings(&world).unwrap();
    settings.normals = true;
    sheet.set_settings(&mut world, &settings).unwrap();
    ticks(&mut world, 1);
    assert!(sheet.mesh(&world).unwrap().normals.is_some());
}

#[test]
fn events_have_the_fields_of_their_type() {
    let (mut world, sheet) = small();
    let cut = sheet.cut(&mut world, &[[0.5, -0.1], [0.5, 1.1]]).unwrap();
    ticks(&mut world, 1);
    let events: Vec<Event> = world.events().unwrap().collect();
    assert!(events.contains(&Event::CutFinished { sheet, cut }));
    let frames: Vec<Frame> = events
        .iter()
        .filter_map(|event| match event {
            Event::PieceOff { frame, crumb: false, area, .. } if (area - 0.5).abs() < 1e-3 => Some(*frame),
            _ => None,
        })
        .collect();
    let detached = world.detach_pieces(&frames).unwrap();
    assert_eq!(detached.len(), frames.len());
    assert_eq!(world.sheets().unwrap(), [sheet, detached[0].unwrap()]);
    assert!(sheet.piece(&mut world, 0).unwrap().area > 0.49);
    assert_eq!(sheet.piece_frames(&mut world, 0).unwrap().len(), sheet.frames(&world).unwrap().len());
}

#[test]
fn rays_that_meet_nothing_give_none() {
    let (world, sheet) = small();
    let (met, hit) = world.raycast([0.5, 0.25, 1.0], [0.0, 0.0, -1.0], 9.0).unwrap().unwrap();
    assert!(met == sheet && (hit.distance - 1.0).abs() < 1e-5 && (hit.rest_point[1] - 0.25).abs() < 1e-5);
    assert!(world.raycast([5.0, 0.25, 1.0], [0.0, 0.0, -1.0], 9.0).unwrap().is_none());
    assert!(sheet.raycast(&world, [5.0, 0.25, 1.0], [0.0, 0.0, -1.0], 9.0).unwrap().is_none());
}

#[test]
fn contacts_of_the_host_push() {
    let (mut world, sheet) = small();
    let contacts: Vec<Contact> = [0.0, 1.0]
        .map(|u| Contact { point: -1, rest_point: [u, 0.5], normal: [0.0, 0.0, 1.0], ..Default::default() })
        .into();
    sheet.set_contacts(&mut world, &contacts).unwrap();
    ticks(&mut world, 1);
    let forces = sheet.contact_forces(&world).unwrap();
    assert!(forces.len() == 2 && forces.iter().all(|force| force.impulse[2] > 0.0));
    let floor = world.create_obstacle(&ObstacleDef { position: [0.0, 0.0, -1.0], ..Default::default() }).unwrap();
    assert_eq!(floor.state(&world).unwrap().position, [0.0, 0.0, -1.0]);
    assert_eq!(floor.state(&world).unwrap().rotation[0], 1.0);
}

#[test]
fn saves_go_on_as_the_world_does() {
    let mut world = World::new(twin_def()).unwrap();
    let hash = twin::run(&mut world).unwrap();
    let saved = world.save().unwrap();
    let snapshot = world.snapshot().unwrap();
    let mut other = World::new(WorldDef::default()).unwrap();
    other.load(&saved).unwrap();
    assert_eq!(other.state_hash().unwrap(), hash);
    other.restore(&snapshot).unwrap();
    other.finish_cuts().unwrap();
    assert_eq!(other.state_hash().unwrap(), hash);
    ticks(&mut world, 5);
    ticks(&mut other, 5);
    assert_eq!(other.state_hash().unwrap(), world.state_hash().unwrap());
    assert_eq!(other.load(&saved[..40]).unwrap_err().code, ResultCode::ErrorData);
}

#[test]
fn recordings_replay() {
    let recording = Arc::new(Mutex::new(Vec::new()));
    let kept = recording.clone();
    let record = move |bytes: &[u8]| kept.lock().unwrap().extend_from_slice(bytes);
    let mut world = World::new(WorldDef { record: Some(Box::new(record)), ..twin_def() }).unwrap();
    world.note(b"begin").unwrap();
    let hash = twin::run(&mut world).unwrap();
    drop(world);
    let recording = recording.lock().unwrap();
    let (mut replay, mut world, mut notes) =
        (Replay::new(&recording), World::new(Default::default()).unwrap(), Vec::new());
    let mut last = 0;
    while replay.step(&mut world).unwrap() == Status::Pending {
        notes.extend(replay.note());
        last = world.state_hash().unwrap();
    }
    assert_eq!((replay.ticks(), notes, last), (120, vec![&b"begin"[..]], hash));
}

#[test]
fn tasks_on_threads_give_the_same_bits() {
    let hash = twin::run(&mut World::new(twin_def()).unwrap()).unwrap();
    let run = Arc::new(AtomicUsize::new(0));
    let count = run.clone();
    let mut def = WorldDef { worker_count: 4, ..twin_def() };
    def.tasks = Some(Box::new(move |task| {
        std::thread::scope(|scope| {
            for part in task.parts(3) {
                count.fetch_add(1, Ordering::Relaxed);
                scope.spawn(|| part.run());
            }
        });
    }));
    let mut world = World::new(def).unwrap();
    assert_eq!(twin::run(&mut world).unwrap(), hash);
    let large = world.create_rectangle(1.0, 1.0, 128, 128, None).unwrap();
    ticks(&mut world, 2);
    assert!(large.is_awake(&world).unwrap() && run.load(Ordering::Relaxed) > 0);
}

#[test]
fn worlds_go_from_thread_to_thread_and_are_read_by_many() {
    let (mut world, sheet) = small();
    let world = std::thread::spawn(move || {
        ticks(&mut world, 3);
        world
    })
    .join()
    .unwrap();
    let read = || sheet.totals(&world).unwrap().mass;
    std::thread::scope(|scope| {
        let (one, two) = (scope.spawn(read), scope.spawn(read));
        assert_eq!(one.join().unwrap(), two.join().unwrap());
    });
}

#[derive(Clone, Default)]
struct Counted(Arc<AtomicI64>);

// SAFETY: the size is kept before what is given; both are aligned to 16.
unsafe impl Allocator for Counted {
    fn alloc(&self, bytes: usize) -> *mut u8 {
        self.0.fetch_add(1, Ordering::Relaxed);
        unsafe {
            let block = std::alloc::alloc(Layout::from_size_align(bytes + 16, 16).unwrap());
            block.cast::<usize>().write(bytes + 16);
            block.add(16)
        }
    }

    unsafe fn free(&self, pointer: *mut u8) {
        if pointer.is_null() {
            return;
        }
        self.0.fetch_sub(1, Ordering::Relaxed);
        let block = pointer.sub(16);
        std::alloc::dealloc(block, Layout::from_size_align(block.cast::<usize>().read(), 16).unwrap());
    }
}

#[test]
fn memory_may_come_from_the_host() {
    let from = Counted::default();
    let mut world = World::new(WorldDef { allocator: Some(Box::new(from.clone())), ..twin_def() }).unwrap();
    twin::run(&mut world).unwrap();
    let count = from.0.load(Ordering::Relaxed);
    ticks(&mut world, 1);
    assert!(count > 0);
    drop(world);
    assert_eq!(from.0.load(Ordering::Relaxed), 0);
}

#[test]
fn debug_draw_goes_to_a_closure() {
    let (world, sheet) = small();
    let mut counts = [0; 3];
    let what =
        kiri::DebugDraw { flags: kiri::DRAW_TRIANGLES | kiri::DRAW_EDGES, sheet: Some(sheet), ..Default::default() };
    world.debug_draw(&what, |shape, vertices| counts[shape as usize] += vertices.len()).unwrap();
    assert!(counts[kiri::Shape::Triangles as usize] == 3 * 128 && counts[kiri::Shape::Lines as usize] > 0);
    assert!(world.debug_draw(&kiri::DebugDraw { size: -1.0, ..what }, |_, _| ()).is_err());
}

#[test]
fn vectors_of_glam_and_mint_are_taken() {
    let (mut world, sheet) = small();
    world.set_gravity(glam::Vec3::ZERO).unwrap();
    let frame = sheet.frames(&world).unwrap()[0];
    frame.apply_force(&mut world, mint::Vector3 { x: 0.0, y: 0.0, z: 1.0 }, glam::Vec3::ZERO).unwrap();
    let _ = world.tick(1.0 / 60.0, 1).unwrap();
    let mesh = sheet.mesh(&world).unwrap();
    let positions: &[glam::Vec3] = bytemuck::cast_slice(mesh.positions);
    assert!(positions.len() == mesh.positions.len() && positions.iter().any(|position| position.z > 1e-6));
    let ball = kiri::ObstacleDef { position: glam::vec3(0.0, 0.0, 9.0).into(), ..Default::default() };
    let ball = world.create_obstacle(&ball).unwrap();
    let turned = mint::ColumnMatrix3::from([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    ball.set_pose(&mut world, glam::Vec3::X, turned).unwrap();
    let state = ball.state(&world).unwrap();
    assert!(glam::Vec3::from(state.position) == glam::Vec3::X && state.rotation == <[f32; 9]>::from(turned));
}

#[test]
fn pieces_and_triangles_are_iterated() {
    let (mut world, sheet) = small();
    sheet.cut(&mut world, &[[-0.1, 0.4], [1.1, 0.6]]).unwrap();
    while world.tick(1.0 / 60.0, 2).unwrap() == kiri::Status::Pending {}
    assert_eq!(sheet.pieces(&mut world).unwrap().len(), 2);
    let areas = sheet.pieces(&mut world).unwrap().map(|piece| piece.unwrap().area);
    assert!((areas.sum::<f64>() - 1.0).abs() < 1e-4);
    let mesh = sheet.mesh(&world).unwrap();
    assert_eq!(mesh.triangles().len(), mesh.indices.len());
    let last = mesh.triangles().last().unwrap()[2];
    assert_eq!(last, mesh.positions[mesh.indices.last().unwrap()[2] as usize]);
}
