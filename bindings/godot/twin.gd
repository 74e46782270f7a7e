# The scene of tests/twin.c, for Godot 3 and 4: gives the state hash and the number of sheets.

static func run(kiri, world):
	var sheet = world.create_rectangle(1, 0.75, 16, 12, {"position": Vector3(0, 0, 1), "frame_count": 6,
			"material": {"youngs_modulus": 1e7}})
	for u in [0.0, 1.0]:
		sheet.create_pin({"rest_point": Vector2(u, 0), "target": Vector3(u, 0, 1)})
	world.create_obstacle({"type": kiri.OBSTACLE_SPHERE, "radius": 0.25, "position": Vector3(0.5, 0.5, 0.5)})
	var cut = sheet.begin_cut(Vector2(0.3, -0.1))
	cut.extend([Vector2(0.3, 0.4), Vector2(0.7, 0.45), Vector2(0.65, 0.85)])
	cut.end()
	var blade = world.begin_blade()
	for tick in 120:
		if tick >= 40 and tick < 60:
			var x = 0.0625 * (tick - 44)
			blade.move_edge(Vector3(x, 0.125, -1), Vector3(x, 0.125, 2))
		elif tick == 60:
			blade.end()
		world.tick(1.0 / 60.0, 2)
		for event in world.get_events():
			if event.type == kiri.EVENT_PIECE_OFF:
				event.frame.detach_piece()
	var state = world.get_state_hash()
	return "hash %08x%08x\nsheets %d" % [(state >> 32) & 0xffffffff, state & 0xffffffff, world.get_sheets().size()]
