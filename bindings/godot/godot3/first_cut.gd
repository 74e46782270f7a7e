# A sheet, and a cut from side to side: in Godot 3 `godot3 -s first_cut.gd`.
extends SceneTree
const Kiri = preload("res://addons/kiri/kiri.gd")

func _init():
	var world = Kiri.World.new()
	var sheet = world.create_rectangle(1.0, 1.0, 16, 16)
	sheet.cut([Vector2(-0.1, 0.4), Vector2(1.1, 0.6)])
	world.tick(1.0 / 60.0, 1)
	print(sheet.get_counts().pieces, " pieces")
	quit()
