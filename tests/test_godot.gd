# The classes of Kiri in Godot, for scripts of 3 and 4 alike: what run() gives is how many checks failed.

var kiri
var world_class
var failures = 0
var checks = 0
var at = ""

func run(kiri_class, class_of_worlds):
	kiri = kiri_class
	world_class = class_of_worlds
	for name in ["constants", "defaults", "worlds", "sheets", "meshes", "cuts", "blades", "events", "frames", "pieces", "pins", "folds", "seams", "tears",
			"loads", "obstacles", "contacts", "rays", "saves", "recordings", "drawing", "settings", "handles", "errors", "threads"]:
		at = name
		call("test_" + name)
	print("%d checks, %d failed" % [checks, failures])
	return failures

func check(is_true, what):
	checks += 1
	if not is_true:
		failures += 1
		print("FAILED: ", at, ": ", what)

func equal(is_value, as_value, what = ""):
	var same = str(is_value) == str(as_value) if typeof(is_value) == TYPE_DICTIONARY else is_value == as_value
	check(typeof(is_value) == typeof(as_value) and same, "%s: %s is not %s" % [what, is_value, as_value])

func near(a, b, what = ""):
	check(abs(a - b) < 1e-4, "%s: %s is not near %s" % [what, a, b])

# An error of Godot is pushed; what failed is the last result of the world.
func fails(world, code, what):
	check(world.get_last_result() == code, "%s: %s, not %s" % [what, kiri.get_result_name(world.get_last_result()), kiri.get_result_name(code)])

func a_world():
	return world_class.new()

func a_sheet(world, def = {}):
	var filled = {"frame_count": 6}
	for key in def:
		filled[key] = def[key]
	return world.create_rectangle(1.0, 0.5, 8, 4, filled)

func tick(world, count = 1):
	for i in count:
		world.tick(1.0 / 60.0, 1)

# From side to side.
func halve(world, sheet):
	var cut = sheet.begin_cut(Vector2(-0.1, 0.2))
	cut.extend([Vector2(1.1, 0.3)])
	cut.end()
	tick(world)

func pieces_off(world):
	var off = []
	for event in world.get_events():
		if event.type == kiri.EVENT_PIECE_OFF:
			off.append(event.frame)
	return off

func test_constants():
	equal(kiri.PENDING, 1)
	equal(kiri.ERROR_REPLAY, -11)
	equal(kiri.DRAW_ALL, 2047)
	equal(kiri.get_result_name(kiri.ERROR_MESH), "KIRI_ERROR_MESH")
	check(kiri.get_result_text(kiri.ERROR_MESH).length() > 20, "a text")
	equal(kiri.get_stage_name(kiri.STAGE_SOLVE), "solve")
	check(kiri.get_version() >= 800, "version")

func test_defaults():
	equal(kiri.default_world_def().gravity, Vector3(0, kiri.default_world_def().gravity.y, 0), "y is up")
	check(kiri.default_world_def().gravity.y < -9.8, "y is up")
	var def = kiri.default_sheet_def()
	equal(def.grid_resolution, 32)
	equal(def.normals, true)
	check(not def.has("cookie") and not def.has("vertex_count"), "keys that are none of the script's")
	equal(kiri.default_pin_def().obstacle, null)
	equal(kiri.default_obstacle_def().rotation, Basis())
	check(kiri.default_debug_draw().size > 0.0, "debug draw")
	check(kiri.get_material(kiri.MATERIAL_PAPER).youngs_modulus > 1e8, "paper")
	check(kiri.get_quality(kiri.QUALITY_FAST).substeps >= 1, "quality")
	var setup = a_world().create_rectangle(0.3, 0.3, 0, 0, kiri.get_setup(kiri.SETUP_PAPER, 0.3, 0.3)).get_counts()
	equal([setup.frames, setup.triangles], [25, 7200])
	var made = kiri.fill_rectangle(1.0, 0.5, 4, 2)
	equal(made.rest_positions.size(), 15)
	equal(made.indices.size(), 48)
	equal(made.rest_positions[14], Vector2(1, 0.5))
	equal(kiri.fill_rectangle(1.0, 0.5, -4, 2), {})

# A def as the defaults are is a def.
func test_sheets():
	var world = a_world()
	var def = kiri.default_sheet_def()
	var made = kiri.fill_rectangle(1.0, 0.5, 4, 2)
	def.rest_positions = made.rest_positions
	def.indices = made.indices
	def.frame_points = [Vector2(0.25, 0.25), Vector2(0.75, 0.25)]
	def.max_frames = 2
	var sheet = world.create_sheet(def)
	equal(sheet.get_frames()[1].get_state().rest_point, Vector2(0.75, 0.25), "frames are where they are told to be")
	equal(world.get_sheets(), [sheet])
	near(sheet.get_totals().area, 0.5, "area")
	equal(sheet.is_awake(), true)
	sheet.set_velocity(Vector3(1, 0, 0), Vector3(0, 0, 0))
	near(sheet.get_totals().momentum.x, sheet.get_totals().mass, "momentum")
	sheet.transform(Basis(Vector3(0, 0, 1), PI / 2), Vector3(0, 0, 3))
	near(sheet.get_mesh().positions[4].y, 1.0, "a rotation is that of the basis")
	near(sheet.get_mesh().positions[4].z, 3.0, "translation")
	sheet.set_user_data(77)
	equal(sheet.get_user_data(), 77)
	check(sheet.estimate_error() > 0.0, "estimate")
	equal(sheet.wake(), kiri.OK)
	var reach = sheet.get_reach(1.0 / 60.0)
	check(reach.lower.x < reach.upper.x, "reach")
	equal(sheet.destroy(), kiri.OK)
	equal(world.get_sheets(), [])

func test_meshes():
	var world = a_world()
	var sheet = a_sheet(world)
	var mesh = sheet.get_mesh()
	equal(mesh.positions.size(), 45)
	equal(mesh.normals[0], Vector3(0, 0, 1))
	equal(mesh.rest_positions[44], Vector2(1, 0.5))
	equal(mesh.indices.size(), 3 * 64)
	equal(mesh.source_weights.size(), 45)
	equal(sheet.get_revision(), mesh.revision)
	var arrays = sheet.get_surface_arrays()
	check(arrays.size() == 9 or arrays.size() == 13, "as many as the engine has")
	equal(arrays[0], mesh.positions)
	equal(arrays[4], mesh.rest_positions)
	var turned = arrays[arrays.size() - 1]
	equal([turned[0], turned[1], turned[2]], [mesh.indices[0], mesh.indices[2], mesh.indices[1]], "clockwise")
	equal(sheet.get_vertex_buffer().size(), 45 * 16)
	var copied = sheet.copy_vertices(40, 5)
	equal(copied.positions[4], mesh.positions[44])
	equal(copied.normals.size(), 5)
	equal(sheet.copy_sources(0, 2).size(), 2)
	equal(sheet.copy_source_weights(0, 2).size(), 18)
	equal(sheet.copy_previous(0, 5).vertices.size(), 5)
	equal(world.shift_origin(Vector3(0, 0, 0)), kiri.OK)
	equal(sheet.copy_indices16(63, 1)[0], mesh.indices[189])
	equal(sheet.get_solid(0.01).positions.size() >= 90, true)
	equal(sheet.get_solid_arrays(0.01)[0], sheet.get_solid(0.01).positions)
	equal(sheet.get_solid_arrays("thick"), [])
	equal(sheet.get_dirty(0).new_vertices.count, 45)
	var bare = a_sheet(world, {"normals": false, "collision_points": 7})
	equal(bare.get_vertex_buffer().size(), 45 * 12, "without normals")
	equal(bare.copy_vertices(0, 45).normals.size(), 0)
	equal(bare.get_collision_points().size(), bare.get_counts().collision_points)
	# Arrays are copies: what comes later does not change them, nor does their world end them.
	tick(world, 10)
	check(sheet.get_mesh().positions[0] != mesh.positions[0], "it fell")
	world.destroy()
	equal(mesh.rest_positions[44], Vector2(1, 0.5))

func test_cuts():
	var world = a_world()
	var sheet = a_sheet(world)
	halve(world, sheet)
	equal(sheet.get_counts().pieces, 2)
	var slice = sheet.slice([Vector3(0.5, -1, -1), Vector3(0.5, -1, 1), Vector3(0.5, 1, 1), Vector3(0.5, 1, -1)])
	check(slice != null, "a slice is a cut")
	equal(sheet.drop_crumbs(0.0) >= 0, true)

func test_blades():
	var world = a_world()
	var sheet = a_sheet(world)
	var blade = world.begin_blade(sheet)
	for i in 14:
		blade.move_ray(Vector3(0.1 * i - 0.1, 0.25, 1), Vector3(0, 0, -1), 2.0)
		tick(world)
	equal(blade.end(), kiri.OK)
	tick(world)
	equal(sheet.get_counts().pieces, 2, "a ray")
	blade = world.begin_blade()
	for x in [0.3, 0.5]:
		blade.move_edge(Vector3(x, -9, -9), Vector3(x, 9, 9))
	blade.end()

func test_events():
	var world = a_world()
	var sheet = a_sheet(world, {"crumb_area": 0.1})
	halve(world, sheet)
	var seen = {}
	for event in world.get_events():
		seen[event.type] = event
	var off = seen[kiri.EVENT_PIECE_OFF]
	equal(off.sheet, sheet)
	near(off.area, 0.25)
	equal(off.crumb, false)
	check(not off.has("pin") and not off.has("waiting"), "only what such an event has")
	check(seen[kiri.EVENT_CUT_FINISHED].has("cut"), "its cut")

func test_frames():
	var world = a_world()
	var sheet = a_sheet(world)
	var frames = sheet.get_frames()
	equal(frames.size(), sheet.get_counts().frames)
	var frame = frames[0]
	var state = frame.get_state()
	equal(state.rotation, Basis())
	equal(state.held, false)
	equal(frame.hold(state.position + Vector3(0, 0, 1), Basis()), kiri.OK)
	equal(frame.get_state().held, true)
	tick(world, 3)
	near(frame.get_state().position.z, 1.0, "held")
	check(frame.get_reaction().force != Vector3(0, 0, 0), "what holds it")
	frame.hold(Vector3(0, 0, 1), Basis(Vector3(0, 0, 1), 0.5))
	tick(world)
	near(frame.get_state().rotation.x.y, sin(0.5), "a basis")
	equal(frame.hold(), kiri.OK, "without a place it is let go")
	equal(frame.get_state().held, false)
	equal(frame.apply_force(Vector3(0, 1, 0), Vector3(0, 0, 0)), kiri.OK)
	equal(frame.get_piece(), 0)
	equal(frame.set_piece_velocity(Vector3(0, 1, 0), Vector3(0, 0, 0)), kiri.OK)
	equal(frame.set_piece_user_data(5), kiri.OK)
	equal(frame.get_piece_user_data(), 5)
	var weights = sheet.get_weights(Vector2(0.5, 0.25))
	var sum = 0.0
	for weight in weights.weights:
		sum += weight
	near(sum, 1.0, "weights")
	equal(weights.gradients.size(), weights.frames.size())
	check(frames.has(weights.frames[0]), "frames of weights are those of the sheet")

func test_pieces():
	var world = a_world()
	var sheet = a_sheet(world)
	halve(world, sheet)
	equal(sheet.get_piece(1).asleep, false)
	near(sheet.get_piece(0).area + sheet.get_piece(1).area, 0.5)
	check(sheet.get_piece_mesh(0).indices.size() > 0, "mesh of a piece")
	check(sheet.get_piece_frames(1).size() > 0, "frames of a piece")
	var off = pieces_off(world)
	var detached = off[0].detach_piece()
	equal(world.get_sheets().size(), 2)
	near(detached.get_totals().area, 0.25)
	halve(world, sheet)
	var other = a_sheet(world)
	var cut = other.begin_cut(Vector2(0.5, -0.1))
	cut.extend([Vector2(0.5, 0.6)])
	cut.end()
	tick(world)
	off = pieces_off(world)
	equal(world.detach_pieces(off).size(), off.size(), "many at once")
	equal(world.destroy_pieces([]), kiri.OK)
	var last = a_sheet(world)
	halve(world, last)
	equal(pieces_off(world)[0].destroy_piece(), kiri.OK)
	equal(last.get_counts().pieces, 1)

func test_pins():
	var world = a_world()
	var sheet = a_sheet(world)
	var pin = sheet.create_pin({"rest_point": Vector2(0, 0.5), "target": Vector3(0, 0.5, 0)})
	var clamp_pin = sheet.clamp_line(Vector2(0, 0.4), Vector2(1, 0.4))
	var hinge = sheet.hinge_line(Vector2(0, 0.1), Vector2(1, 0.1))
	equal(sheet.get_pins(), [pin, clamp_pin, hinge])
	equal(clamp_pin.get_state().type, kiri.PIN_CLAMP)
	equal(pin.get_state().sheet, sheet)
	equal(pin.set_target(Vector3(0, 0.6, 0)), kiri.OK)
	equal(clamp_pin.set_pose(Vector3(0.5, 0.4, 0.1), Basis()), kiri.OK)
	equal(pin.set_break_force(1e9), kiri.OK)
	equal(pin.set_user_data(-1), kiri.OK)
	equal(pin.get_user_data(), -1, "all 64 bits")
	tick(world)
	check(pin.get_reaction().has("torque"), "reaction")
	equal(hinge.destroy(), kiri.OK)
	equal(sheet.get_pins(), [pin, clamp_pin])

func test_folds():
	var world = a_world()
	var fold = {"from": Vector2(0.5, 0), "to": Vector2(0.5, 0.5), "stiffness": 0.01, "rest_angle": 0.0}
	var sheet = world.create_folded_sheet(a_def(), [fold])
	near(sheet.get_fold(0).angle, 0.0)
	near(sheet.get_fold(0).fold.stiffness, 0.01)
	equal(sheet.set_fold(0, 0.02, 0.5), kiri.OK)
	equal(sheet.set_fold(1, 0.02, 0.5), kiri.ERROR_ARGUMENT)
	equal(sheet.add_fold({"from": Vector2(0.25, 0), "to": Vector2(0.25, 0.5)}), 1)
	tick(world, 20)
	near(sheet.get_fold(1).length, 0.5)
	check(sheet.get_fold(0).angle > 0.01, "it is driven")

func a_def():
	var made = kiri.fill_rectangle(1.0, 0.5, 8, 4)
	return {"rest_positions": made.rest_positions, "indices": made.indices, "frame_count": 6}

func test_tears():
	var world = a_world()
	var sheet = a_sheet(world)
	equal(sheet.set_tearing({"toughness": 1e4, "grain": Vector2(1, 0), "grain_ratio": 2.0}), kiri.OK)
	near(sheet.get_tearing().toughness, 1e4)
	equal(sheet.set_tearing({"toughness": -1.0}), kiri.ERROR_ARGUMENT)
	equal(sheet.set_tear_line([Vector2(0.5, -0.1), Vector2(0.5, 0.6)], 0.2), kiri.OK)

func test_seams():
	var world = a_world()
	var a = a_sheet(world)
	var b = a_sheet(world, {"position": Vector3(1, 0, 0)})
	var def = kiri.default_seam_def()
	def.sheet_a = a
	def.sheet_b = b
	def.line_a = [Vector2(1, 0), Vector2(1, 0.5)]
	def.line_b = [Vector2(0, 0), Vector2(0, 0.5)]
	var seam = world.create_seam(def)
	equal(world.get_seams(), [seam])
	check(seam.get_count() > 1, "stitches")
	equal(seam.set_hinge(0.01, 0.1), kiri.OK)
	tick(world, 10)
	equal(seam.get_stitch(0).sheet_a, a)
	check(seam.get_stitch(0).gap < 1e-3, "it holds")
	equal(seam.destroy(), kiri.OK)
	equal(world.get_seams(), [])

func test_loads():
	var world = a_world()
	var sheet = a_sheet(world)
	equal(world.set_gravity(Vector3(0, 0, 0)), kiri.OK)
	equal(world.set_budget({"cells": 100000}), kiri.OK)
	equal(sheet.set_wind({"velocity": Vector3(0, 0, 1), "density": 1.2, "drag": 1.0}), kiri.OK)
	equal(sheet.apply_force(Vector2(0.5, 0.25), Vector3(0, 0, 0.1), Vector3(0, 0, 0)), kiri.OK)
	equal(sheet.apply_line_load(Vector2(0, 0.25), Vector2(1, 0.25), Vector3(0, 0, 0.1)), kiri.OK)
	equal(sheet.apply_pressure(1.0), kiri.OK)
	equal(sheet.apply_impulse(Vector2(0.5, 0.25), Vector3(0, 0, 0.01)), kiri.OK)
	tick(world)
	check(sheet.get_totals().momentum.z > 0.0, "it is pushed")
	check(sheet.get_point(Vector2(0.5, 0.25)).velocity.z > 0.0, "it moves")

func test_obstacles():
	var world = a_world()
	var sheet = a_sheet(world, {"position": Vector3(0, 1, 0)})
	var prism = world.create_obstacle({"type": kiri.OBSTACLE_PRISM, "outline": [Vector2(-1, -1), Vector2(1, -1), Vector2(0, 1)],
			"height": 1.0, "mass": 2.0, "inertia": [1, 1, 1, 0, 0, 0]})
	equal(prism.set_pose(Vector3(0.5, 0.2, 0), Basis()), kiri.OK)
	equal(prism.set_velocity(Vector3(0, 1, 0), Vector3(0, 0, 0)), kiri.OK)
	equal(prism.set_surface_velocity(Vector3(0, 0, 0)), kiri.OK)
	equal(prism.set_mass(1.0, [1, 1, 1, 0, 0, 0], Vector3(0, 0, 0)), kiri.OK)
	equal(prism.get_state().velocity, Vector3(0, 1, 0))
	var pin = sheet.create_pin({"target": Vector3(0, 1, 0), "obstacle": prism})
	equal(pin.get_state().obstacle, prism)
	pin.destroy()
	equal(prism.destroy(), kiri.OK)

func test_contacts():
	var world = a_world()
	var sheet = a_sheet(world)
	equal(sheet.set_contacts([{"point": -1, "rest_point": Vector2(0.5, 0.25), "normal": Vector3(0, 1, 0), "offset": 0.25, "obstacle": 3}]), kiri.OK)
	tick(world)
	var forces = sheet.get_contact_forces()
	equal(forces.size(), 1)
	equal(forces[0].obstacle, 3)
	check(forces[0].impulse.y > 0.0, "it pushes up")

func test_rays():
	var world = a_world()
	var sheet = a_sheet(world)
	var hit = sheet.raycast(Vector3(0.5, 0.25, 1), Vector3(0, 0, -1), 2.0)
	near(hit.distance, 1.0)
	near(hit.rest_point.x, 0.5)
	equal(sheet.raycast(Vector3(5, 5, 1), Vector3(0, 0, -1), 2.0), {}, "none is met")
	equal(world.raycast(Vector3(0.5, 0.25, 1), Vector3(0, 0, -1), 2.0).sheet, sheet)
	equal(world.raycast(Vector3(5, 5, 1), Vector3(0, 0, -1), 2.0).sheet, null)

func test_saves():
	var world = a_world()
	var sheet = a_sheet(world)
	halve(world, sheet)
	var base = world.save()
	check(base.size() > 1000, "bytes")
	var other = a_world()
	equal(other.load(base), kiri.OK)
	equal(other.get_state_hash(), world.get_state_hash())
	equal(other.restore(world.snapshot()), kiri.OK)
	equal(other.finish_cuts(), kiri.OK)
	equal(other.get_state_hash(), world.get_state_hash())
	check(other.get_sheets()[0] != sheet, "a sheet of another world is another object")
	equal(world.get_profile().seconds.size(), 9)
	var budget = {"cells": 5000}
	equal(kiri.fit_budget(world.get_profile(), 1000.0, budget), kiri.OK)
	check(budget.has("samples"), "what was given is changed")

func test_recordings():
	var world = kiri.create_world({"record": true, "clock": true, "record_hash_ticks": 1})
	var sheet = a_sheet(world)
	equal(world.note([1, 2, 3]), kiri.OK)
	halve(world, sheet)
	check(world.get_profile().seconds[kiri.STAGE_SOLVE] > 0.0, "a clock")
	var hashed = world.get_state_hash()
	var bytes = world.take_recording()
	world.destroy()
	bytes.append_array(world.take_recording())
	var other = a_world()
	var state = {}
	var notes = []
	while other.replay(bytes, state) == kiri.PENDING:
		notes.append(state.note.size())
	fails(other, kiri.OK, "replay")
	equal(notes[0], 3, "the note")
	equal(state.ticks, 1)
	equal(other.get_state_hash(), hashed)

func test_drawing():
	var world = a_world()
	var sheet = a_sheet(world)
	var drawn = world.debug_draw({"flags": kiri.DRAW_EDGES | kiri.DRAW_FRAMES | kiri.DRAW_TRIANGLES})
	equal(drawn.triangles.positions.size(), 3 * 64)
	equal(drawn.points.positions.size(), sheet.get_counts().frames)
	equal(drawn.lines.colors.size(), drawn.lines.positions.size())
	near(drawn.points.colors[0].a, 1.0)
	check(world.debug_draw().lines.positions.size() > 0, "as by default")

func test_settings():
	var world = a_world()
	var sheet = a_sheet(world)
	var before = sheet.get_settings()
	equal(sheet.set_settings({"friction": 0.125}), kiri.OK)
	equal(sheet.get_settings().friction, 0.125)
	equal(sheet.get_settings().material, before.material, "the others stay")

func test_handles():
	var world = a_world()
	var sheets = []
	for i in 100:
		sheets.append(a_sheet(world, {"position": Vector3(0, 0, i), "frame_count": 1, "max_frames": 1}))
	equal(world.get_sheets(), sheets, "one id is one object")
	for i in 50:
		sheets.pop_back()
	equal(world.get_sheets().size(), 100, "objects that nobody has are made again")
	equal(world.get_sheets().slice(0, 1)[0], sheets[0])
	var kept = sheets[7]
	sheets = []
	equal(world.get_sheets()[7], kept)
	some_handles_go()
	var other = a_world()
	for i in 8:
		a_sheet(other)
	equal(other.begin_blade(kept), null, "a sheet of another world, with an id that is there too")
	# A sheet keeps its world.
	world = null
	equal(kept.get_counts().frames, 1)

# Frames come where sheets have their places, and are found when these have gone.
func some_handles_go():
	var world = a_world()
	var sheet = a_sheet(world, {"frame_count": 12})
	for i in 30:
		a_sheet(world, {"frame_count": 1, "max_frames": 1})
	var sheets = world.get_sheets()
	var frames = sheet.get_frames()
	equal(sheets.size(), 31)
	sheets = null
	equal(sheet.get_frames(), frames, "objects that stay")

func test_errors():
	var world = a_world()
	equal(world.create_rectangle(1.0, 1.0, -1, 4), null)
	fails(world, kiri.ERROR_ARGUMENT, "no columns")
	var sheet = a_sheet(world)
	equal(sheet.create_pin({"rest_point": Vector2(5, 5)}), null)
	fails(world, kiri.ERROR_ARGUMENT, "outside")
	equal(sheet.create_pin({"rest_pont": Vector2(0, 0)}), null, "a key that is none")
	equal(sheet.create_pin({"rest_point": Vector3(0, 0, 0)}), null, "a vector of 3")
	equal(sheet.create_pin(5), null, "no dictionary")
	equal(sheet.set_velocity("fast", Vector3(0, 0, 0)), kiri.ERROR_ARGUMENT, "a text")
	equal(world.call("tick", 1.0 / 60.0), kiri.ERROR_ARGUMENT, "too few")
	equal(world.load([1, 2, 300]), kiri.ERROR_ARGUMENT, "no byte")
	equal(world.tick(-1.0, 1), kiri.ERROR_ARGUMENT)
	check(world.get_last_error() != "", "a line")
	sheet.destroy()
	equal(sheet.get_counts(), {})
	fails(world, kiri.ERROR_ID, "a stale id")
	sheet = a_sheet(world)
	world.destroy()
	equal(sheet.get_counts(), {}, "its world is gone")
	equal(sheet.begin_cut(Vector2(0, 0)), null)
	equal(world.tick(1.0 / 60.0, 1), kiri.ERROR_ARGUMENT)

# Threads change no bit.
func test_threads():
	var hashes = []
	for count in [1, 4]:
		var world = kiri.create_world({"worker_count": count})
		var sheet = world.create_rectangle(1.0, 1.0, 64, 64, {"grid_resolution": 64, "frame_count": 60, "iterations": 4})
		var cut = sheet.begin_cut(Vector2(-0.1, 0.4))
		cut.extend([Vector2(1.1, 0.6)])
		tick(world, 5)
		hashes.append(world.get_state_hash())
	equal(hashes[0], hashes[1])

func test_worlds():
	var world = kiri.create_world({"gravity": Vector3(0, 0, 0), "budget": {"iterations": 1000}})
	var sheet = a_sheet(world)
	tick(world, 3)
	near(sheet.get_totals().center.y, 0.25, "no gravity")
	equal(kiri.create_world({"gravity": 5}), null)
	check(world.get_state_hash() != 0, "hash")
	world.destroy()
