extends SceneTree

func _init() -> void:
	load("res://bench.gd").run(Kiri, KiriWorld.new(), Time)
	quit()
