# A sheet of paper: drag with the mouse to cut it. With --picture=PICTURE.png it plays a cut by itself.
extends Spatial

const Kiri = preload("res://addons/kiri/kiri.gd")
const SheetMesh = preload("sheet_mesh.gd")
const BALL = Vector3(0.5, -0.55, 0.05)
const FLOOR = -0.8
const SCRIPT_TICKS = 124

var world = Kiri.World.new()
var meshes = {}
var blade = null
var tick = 0
var picture = ""
var camera = Camera.new()

func _ready():
	for argument in OS.get_cmdline_args():
		if argument.begins_with("--picture="):
			picture = argument.substr(10)
	make_stage()
	world.set_budget({"cells": 32000, "samples": 4000}) # of work on cuts in a tick: about 2 ms
	hang_paper()
	world.create_obstacle({"type": Kiri.OBSTACLE_SPHERE, "position": BALL, "radius": 0.25})
	# The third column of its rotation points out of a plane.
	world.create_obstacle({"position": Vector3(0, FLOOR, 0), "rotation": Basis(Vector3.RIGHT, -PI / 2)})

func hang_paper():
	var material = Kiri.get_material(Kiri.MATERIAL_PAPER)
	material.youngs_modulus = 2e8
	var sheet = world.create_rectangle(1.0, 1.0, 32, 32, {"material": material, "frame_count": 9,
			"touches_sheets": true, "contact_thickness": 0.01})
	for u in [0.0, 1.0]:
		sheet.create_pin({"rest_point": Vector2(u, 1.0), "target": Vector3(u, 1.0, 0.0)})

func make_stage():
	camera.look_at_from_position(Vector3(1.5, 0.75, 2.4), Vector3(0.5, 0.15, 0.0), Vector3.UP)
	camera.fov = 45
	add_child(camera)
	var sun = DirectionalLight.new()
	sun.look_at_from_position(Vector3(0.6, 1.0, 1.6), Vector3(), Vector3.UP)
	sun.light_energy = 0.6
	add_child(sun)
	var sky = WorldEnvironment.new()
	sky.environment = Environment.new()
	sky.environment.background_mode = Environment.BG_CLEAR_COLOR
	sky.environment.ambient_light_color = Color(1, 1, 1)
	sky.environment.ambient_light_energy = 0.5
	add_child(sky)
	var ball = SphereMesh.new()
	ball.radius = 0.244
	ball.height = 0.488
	add_shape(ball, BALL, Color(0.23, 0.43, 0.65))
	var ground = PlaneMesh.new()
	ground.size = Vector2(8, 8)
	add_shape(ground, Vector3(0.5, FLOOR, 0), Color(0.81, 0.78, 0.72))

func add_shape(mesh, position, color):
	var shape = MeshInstance.new()
	shape.mesh = mesh
	shape.translation = position
	shape.material_override = SpatialMaterial.new()
	shape.material_override.albedo_color = color
	add_child(shape)

func _physics_process(_delta):
	if picture != "" and tick >= SCRIPT_TICKS:
		return # a slow machine shows the same tick
	if picture != "":
		cut_by_script()
	elif Input.is_mouse_button_pressed(BUTTON_LEFT):
		var mouse = get_viewport().get_mouse_position()
		cut_along(camera.project_ray_origin(mouse), camera.project_ray_normal(mouse))
	else:
		end_cut()
	world.tick(1.0 / 60.0, 2)
	for event in world.get_events():
		if event.type == Kiri.EVENT_PIECE_OFF:
			event.frame.detach_piece()
	tick += 1

func cut_along(origin, direction):
	if blade == null:
		blade = world.begin_blade()
	blade.move_ray(origin, direction, 10.0)

func end_cut():
	if blade != null:
		blade.end()
	blade = null

# A wave from side to side.
func cut_by_script():
	if tick < 20 or tick >= 80:
		end_cut()
		return
	var way = (tick - 20) / 58.0
	var at = Vector3(-0.1 + 1.2 * way, 0.5 + 0.08 * sin(12.0 * way), 0.0)
	cut_along(camera.translation, (at - camera.translation).normalized())

func _process(_delta):
	for sheet in world.get_sheets():
		if not meshes.has(sheet):
			meshes[sheet] = SheetMesh.new()
			add_child(meshes[sheet])
		meshes[sheet].update(sheet)
	if picture != "" and tick >= SCRIPT_TICKS:
		finish()

func finish():
	set_process(false)
	set_physics_process(false)
	yield(VisualServer, "frame_post_draw")
	var image = get_viewport().get_texture().get_data()
	image.flip_y()
	image.convert(Image.FORMAT_RGBA8)
	image.save_png(picture)
	print("%d sheets, hash %x" % [meshes.size(), world.get_state_hash() & 0xffffffff])
	get_tree().quit()
