# What calls cost, in Godot 3 and 4; `clock` has a function that gives microseconds.

static func per(clock, name, count, start):
	print("%-44s %9.3f us" % [name, (clock.get_ticks_usec() - start) / float(count)])

static func run(kiri, world, clock):
	var sheet = world.create_rectangle(1, 1, 99, 99, {"grid_resolution": 32})
	var count = 100000
	var start = clock.get_ticks_usec()
	for i in count:
		pass
	per(clock, "an empty loop", count, start)
	start = clock.get_ticks_usec()
	for i in count:
		sheet.get_revision()
	per(clock, "a getter: get_revision", count, start)
	start = clock.get_ticks_usec()
	for i in count:
		sheet.is_awake()
	per(clock, "a getter by tables: is_awake", count, start)
	start = clock.get_ticks_usec()
	for i in 10000:
		sheet.get_counts()
	per(clock, "a dictionary of 7 keys: get_counts", 10000, start)
	start = clock.get_ticks_usec()
	for i in 1000:
		sheet.get_surface_arrays()
	per(clock, "10 000 vertices: get_surface_arrays", 1000, start)
	start = clock.get_ticks_usec()
	for i in 1000:
		sheet.get_vertex_buffer()
	per(clock, "10 000 vertices: get_vertex_buffer", 1000, start)
	start = clock.get_ticks_usec()
	for i in 1000:
		sheet.copy_vertices(0, 10000)
	per(clock, "10 000 vertices: copy_vertices", 1000, start)
