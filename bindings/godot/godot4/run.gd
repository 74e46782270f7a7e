# Runs the checks of tests/test_godot.gd and the twin, and says what methods there are.
extends SceneTree

func _init() -> void:
	var classes := {"Kiri": Kiri, "KiriWorld": KiriWorld, "KiriSheet": KiriSheet, "KiriCut": KiriCut, "KiriFrame": KiriFrame,
			"KiriPin": KiriPin, "KiriObstacle": KiriObstacle, "KiriBlade": KiriBlade, "KiriSeam": KiriSeam}
	for name in classes:
		for method in ClassDB.class_get_method_list(name, true):
			print("method ", name, ".", method.name)
	print("typed calls ", "good" if typed() and not leaks() else "FAILED")
	var failures = load("res://test_godot.gd").new().run(Kiri, KiriWorld)
	print(load("res://twin.gd").run(Kiri, Kiri.create_world({"gravity": Vector3(1, 0, -9.81)})))
	quit(1 if failures > 0 else 0)

# Typed code calls by pointers instead of variants.
func typed() -> bool:
	var world: KiriWorld = KiriWorld.new()
	var sheet: KiriSheet = world.create_rectangle(1.0, 1.0, 4, 4, {"collision_points": 5})
	var same: KiriSheet = world.get_sheets()[0]
	var hit: Dictionary = sheet.raycast(Vector3(0.5, 0.5, 1), Vector3(0, 0, -1), 2.0)
	var frames: Array = sheet.get_frames()
	var frame: KiriFrame = frames[0]
	var held: int = frame.hold(Vector3(0, 0, 1), Basis())
	var bytes: PackedByteArray = world.save()
	var awake: bool = sheet.is_awake()
	var error: float = sheet.estimate_error()
	var name: String = Kiri.get_result_name(Kiri.OK)
	var points: PackedVector3Array = sheet.get_collision_points()
	var blade: KiriBlade = world.begin_blade(null)
	var moved: int = blade.move_edge(Vector3(0, 0, 1), Vector3(0, 0, 2))
	return same == sheet and is_equal_approx(hit.distance, 1.0) and held == Kiri.OK and bytes.size() > 0 and awake \
			and error >= 0.0 and name == "KIRI_OK" and points.size() > 0 and moved == Kiri.OK

# Whether calls leave something behind, values or objects.
func leaks() -> bool:
	typed()
	var objects := Performance.get_monitor(Performance.OBJECT_COUNT)
	var memory := OS.get_static_memory_usage()
	for i in 100:
		typed()
	return Performance.get_monitor(Performance.OBJECT_COUNT) != objects or OS.get_static_memory_usage() > memory + 1000
