# Runs the checks of tests/test_godot.gd and the twin, and says what methods there are.
extends SceneTree

const Kiri = preload("res://addons/kiri/kiri.gd")

func _init():
	print_methods("Kiri", Kiri.Native.new())
	var world = Kiri.World.new()
	var sheet = world.create_rectangle(1.0, 1.0, 4, 4)
	print_methods("KiriWorld", world)
	print_methods("KiriSheet", sheet)
	print_methods("KiriCut", sheet.begin_cut(Vector2(-0.1, 0.5)))
	print_methods("KiriFrame", sheet.get_frames()[0])
	print_methods("KiriPin", sheet.create_pin({}))
	print_methods("KiriObstacle", world.create_obstacle({}))
	print_methods("KiriBlade", world.begin_blade())
	var other = world.create_rectangle(1.0, 1.0, 1, 1, {})
	var line = [Vector2(0, 0), Vector2(0, 1)]
	print_methods("KiriSeam", world.create_seam({"sheet_a": sheet, "sheet_b": other, "line_a": line, "line_b": line}))
	var failures = load("res://test_godot.gd").new().run(Kiri, Kiri.World)
	print(load("res://twin.gd").run(Kiri, Kiri.create_world({"gravity": Vector3(1, 0, -9.81)})))
	OS.exit_code = 1 if failures > 0 else 0
	quit(OS.exit_code)

func print_methods(name, object):
	for method in object.get_method_list():
		print("method ", name, ".", method.name)
