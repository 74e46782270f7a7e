# What Kiri has of a world: frames, links, pins and so on, over all that is drawn.
extends MeshInstance3D

var plain := make_material(false)
var dots := make_material(true) # Godot draws only points with it

func _init() -> void:
	mesh = ArrayMesh.new()

static func make_material(is_dots: bool) -> StandardMaterial3D:
	var material := StandardMaterial3D.new()
	material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	material.vertex_color_use_as_albedo = true
	material.no_depth_test = true
	material.use_point_size = is_dots
	material.point_size = 5.0
	return material

func update(world: KiriWorld) -> void:
	var drawn := world.debug_draw()
	mesh.clear_surfaces()
	add(Mesh.PRIMITIVE_TRIANGLES, drawn.triangles, plain)
	add(Mesh.PRIMITIVE_LINES, drawn.lines, plain)
	add(Mesh.PRIMITIVE_POINTS, drawn.points, dots)

func add(primitive: Mesh.PrimitiveType, part: Dictionary, material: Material) -> void:
	if part.positions.is_empty():
		return
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = part.positions
	arrays[Mesh.ARRAY_COLOR] = part.colors
	mesh.add_surface_from_arrays(primitive, arrays)
	mesh.surface_set_material(mesh.get_surface_count() - 1, material)
