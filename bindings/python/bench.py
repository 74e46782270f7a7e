"""What calls cost: PYTHONPATH=bindings/python python3 bindings/python/bench.py."""

import time

import kiri

world = kiri.World()
sheet = world.create_rectangle(1.0, 1.0, 99, 99, frameCount=9)
world.tick(1 / 60)
counts, mesh = kiri.ffi.new("kiriCounts*"), kiri.ffi.new("kiriMesh*")
buffer = bytearray(20 * 10000)


def measure(name, count, call):
    """The least of several runs, in us a call."""
    least = float("inf")
    for _ in range(5):
        start = time.perf_counter()
        for _ in range(count):
            call()
        least = min(least, (time.perf_counter() - start) / count)
    print(f"{name:52} {1e6 * least:8.2f} us")


def view():
    with sheet.mesh_view():
        pass


measure("lib.kiriSheet_GetCounts", 20000, lambda: world.lib.kiriSheet_GetCounts(world._world, sheet.id, counts))
measure("sheet.counts()", 5000, sheet.counts)
measure("10000 vertices: sheet.copy_vertices, stride 20", 2000, lambda: sheet.copy_vertices(0, 10000, buffer, 20))
measure("10000 vertices: sheet.mesh('positions'), a copy", 2000, lambda: sheet.mesh("positions"))
measure("all arrays: with sheet.mesh_view(), no copy", 2000, view)
