# A sheet as Godot draws it: both sides, with lines as on paper for school.
extends MeshInstance

func _init():
	mesh = ArrayMesh.new()
	material_override = SpatialMaterial.new()
	material_override.albedo_texture = paper()
	material_override.params_cull_mode = SpatialMaterial.CULL_DISABLED

func update(sheet):
	if mesh.get_surface_count() > 0:
		mesh.surface_remove(0)
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, sheet.get_surface_arrays())

static func paper():
	var image = Image.new()
	image.create(256, 256, false, Image.FORMAT_RGB8)
	image.fill(Color(0.99, 0.98, 0.95))
	image.lock()
	for y in range(8, 256, 16):
		for x in 256:
			image.set_pixel(x, y, Color(0.55, 0.67, 0.84))
	for y in 256:
		image.set_pixel(34, y, Color(0.84, 0.31, 0.31))
		image.set_pixel(35, y, Color(0.84, 0.31, 0.31))
	image.unlock()
	var texture = ImageTexture.new()
	texture.create_from_image(image)
	return texture
