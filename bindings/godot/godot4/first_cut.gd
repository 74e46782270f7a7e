# A sheet, and a cut from side to side: in Godot 4 `godot --headless -s first_cut.gd`.
extends SceneTree

func _init() -> void:
	var world := KiriWorld.new()
	var sheet := world.create_rectangle(1.0, 1.0, 16, 16)
	sheet.cut([Vector2(-0.1, 0.4), Vector2(1.1, 0.6)])
	world.tick(1.0 / 60.0, 1)
	print(sheet.get_counts().pieces, " pieces")
	quit()
