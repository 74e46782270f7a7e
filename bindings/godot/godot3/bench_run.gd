extends SceneTree

const Kiri = preload("res://addons/kiri/kiri.gd")

func _init():
	load("res://bench.gd").run(Kiri, Kiri.World.new(), OS)
	quit()
