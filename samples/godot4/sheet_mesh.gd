# A sheet as Godot draws it: both sides, with lines as on paper for school.
extends MeshInstance3D

var revision := -1

func _init() -> void:
	mesh = ArrayMesh.new()
	custom_aabb = AABB(Vector3(-10, -10, -10), Vector3(20, 20, 20))
	var material := StandardMaterial3D.new()
	material.albedo_texture = paper()
	material.cull_mode = BaseMaterial3D.CULL_DISABLED
	material_override = material

# A new surface where a cut has changed the triangles, else positions and normals straight into the buffer of the GPU. With
# a thickness a new one in each frame.
func update(sheet: KiriSheet, thickness: float) -> void:
	if thickness > 0.0 or sheet.get_revision() != revision:
		revision = sheet.get_revision() if thickness == 0.0 else -1
		mesh.clear_surfaces()
		mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES,
				sheet.get_solid_arrays(thickness) if thickness > 0.0 else sheet.get_surface_arrays(), [], {},
				Mesh.ARRAY_FLAG_USE_DYNAMIC_UPDATE)
	else:
		RenderingServer.mesh_surface_update_vertex_region(mesh.get_rid(), 0, 0, sheet.get_vertex_buffer())

static func paper() -> ImageTexture:
	var image := Image.create(256, 256, false, Image.FORMAT_RGB8)
	image.fill(Color(0.99, 0.98, 0.95))
	for y in range(8, 256, 16):
		for x in 256:
			image.set_pixel(x, y, Color(0.55, 0.67, 0.84))
	for y in 256:
		image.set_pixel(34, y, Color(0.84, 0.31, 0.31))
		image.set_pixel(35, y, Color(0.84, 0.31, 0.31))
	return ImageTexture.create_from_image(image)
