"""Tests of the Python binding. Needs a C compiler: $CC, or cc."""

import array
import copy
import gc
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import threading
import typing

repository = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(repository / "bindings/python"))
sys.dont_write_bytecode = True

import kiri  # noqa: E402

library = os.path.abspath(os.environ.get("KIRI_LIBRARY", repository / "build/release/libkiri.so"))


def raises(error, function, *arguments, **fields):
    try:
        function(*arguments, **fields)
    except error as caught:
        return caught
    raise AssertionError(f"{function.__name__} did not raise {error.__name__}")


class Blocks:
    """An allocator; `left` has the blocks that were not freed."""

    def __init__(self):
        self.left = {}

    def alloc(self, _, size):
        block = kiri.ffi.new("char[]", size + 16)
        address = int(kiri.ffi.cast("uintptr_t", block)) + 15 & ~15
        self.left[address] = block
        return kiri.ffi.cast("void*", address)

    def free(self, _, pointer):
        del self.left[int(kiri.ffi.cast("uintptr_t", pointer))]


def run_python(*arguments):
    """In a process of its own, for what might kill it."""
    folders = (repository / "tests", repository / "bindings/python")
    environment = dict(os.environ, KIRI_LIBRARY=library, PYTHONDONTWRITEBYTECODE="1",
                       PYTHONPATH=os.pathsep.join(map(str, folders)))
    done = subprocess.run([sys.executable, *arguments], env=environment, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, f"exit code {done.returncode}\n{done.stderr}"
    return done


def run_script(text):
    return run_python("-c", "from test_python import *\n" + text)


def in_thread(function, *arguments):
    """The thread; its `outcome` is what the function returned, or the error that it raised."""
    def run():
        try:
            thread.outcome = function(*arguments)
        except Exception as error:
            thread.outcome = error
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread


def outcomes(threads):
    for thread in threads:
        thread.join(60)
    return [thread.outcome for thread in threads]


def make_scene(**fields):
    """A cut on its way."""
    world = kiri.World(**{"gravity": (1.0, 0.0, -9.81), **fields})
    sheet = world.create_rectangle(1.0, 0.75, 16, 12, position=(0, 0, 1), material={"youngsModulus": 1e7}, frameCount=6)
    sheet.create_pin((0.0, 0.0), (0.0, 0.0, 1.0))
    sheet.create_pin((1.0, 0.0), (1.0, 0.0, 1.0))
    cut = sheet.begin_cut((0.3, -0.1))
    cut.extend([(0.3, 0.4), (0.7, 0.45), (0.65, 0.85)])
    cut.end()
    return world, sheet, cut


def run_scene():
    world, sheet, cut = make_scene()
    for _ in range(30):
        world.tick(1 / 60, 2)
    return world, sheet, cut


def run_as_twin():
    """The same as in tests/twin.c."""
    world = kiri.World(gravity=(1.0, 0.0, -9.81))
    sheet = world.create_rectangle(1.0, 0.75, 16, 12, position=(0, 0, 1), material={"youngsModulus": 1e7}, frameCount=6)
    for u in (0.0, 1.0):
        sheet.create_pin((u, 0.0), (u, 0.0, 1.0))
    world.create_obstacle(kiri.KIRI_OBSTACLE_SPHERE, radius=0.25, position=(0.5, 0.5, 0.5))
    cut = sheet.begin_cut((0.3, -0.1))
    cut.extend([(0.3, 0.4), (0.7, 0.45), (0.65, 0.85)])
    cut.end()
    blade = world.begin_blade()
    for tick in range(120):
        if 40 <= tick < 60:
            x = 0.0625 * (tick - 44)
            blade.move_edge((x, 0.125, -1.0), (x, 0.125, 2.0))
        elif tick == 60:
            blade.end()
        world.tick(1 / 60, 2)
        for event in world.events():
            if event.type == kiri.KIRI_EVENT_PIECE_OFF:
                event.frame.detach_piece()
    return world


def run_twin():
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "twin")
        subprocess.run([os.environ.get("CC", "cc"), "-std=c99", f"-I{repository}/include",
                        f"{repository}/tests/twin.c", library, f"-Wl,-rpath,{os.path.dirname(library)}",
                        "-o", program], check=True)
        lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
    return dict(line.split() for line in lines)


def test_same_hash_and_sizes_as_c():
    twin = run_twin()
    world = run_as_twin()
    assert f"{world.state_hash():016x}" == twin.pop("hash")
    assert len(world.sheets()) == int(twin.pop("sheets"))
    assert len(twin) == 24
    for name, size in twin.items():
        assert kiri.ffi.sizeof(name) == int(size), name


def test_all_functions_are_there():
    from kiri._declarations import METHODS
    described = json.loads((repository / "bindings/kiri.json").read_text())["functions"]
    assert {function["name"] for function in described} == set(METHODS) and len(METHODS) > 100
    for function, (of, method) in METHODS.items():
        assert callable(getattr(getattr(kiri, of) if of else kiri, method)), function


def test_first_cut():
    path = repository / "bindings/python/first_cut.py"
    assert run_python(str(path)).stdout == "2 pieces\n"
    assert len(path.read_text().splitlines()) - 1 <= 10


def test_views_end_with_their_statement():
    world, sheet, _ = make_scene()
    copied = sheet.mesh()
    with sheet.mesh_view() as mesh:
        assert mesh.vertexCount == copied.vertexCount
        assert mesh.positions.tolist() == copied.positions.tolist()
        assert mesh.indices.tolist() == copied.indices.tolist()
        assert "loan" in str(raises(kiri.KiriError, world.tick, 1 / 60))
        waits = in_thread(world.tick, 1 / 60)
        waits.join(0.05)
        assert waits.is_alive()
    assert outcomes([waits]) == [0]
    assert not hasattr(mesh, "positions")
    with sheet.solid_view(thickness=0.01) as solid:
        assert len(solid.indices) == solid.triangleCount > solid.rimTriangle > 0
    world.close()
    raises(kiri.KiriError, sheet.mesh_view().__enter__)


def test_views_that_are_kept():
    for numpy in {kiri._core.numpy, None}:
        before, kiri._core.numpy = kiri._core.numpy, numpy
        try:
            world, sheet, _ = make_scene()
            if numpy:
                def keep():
                    with sheet.mesh_view() as mesh:
                        kept.append(mesh.positions)
                kept = []
                raises(BufferError, keep)
            else:
                with sheet.mesh_view() as mesh:
                    positions = mesh.positions
                    raises(TypeError, positions.__setitem__, (0, 0), 1.0)
                raises(ValueError, positions.tolist)
            assert world.tick(1 / 60) == 0
        finally:
            kiri._core.numpy = before


def test_vertices_in_buffers():
    world, sheet, _ = make_scene()
    world.tick(1 / 60)
    mesh = sheet.mesh()
    buffer = bytearray(20 * mesh.vertexCount)
    sheet.copy_vertices(0, mesh.vertexCount, buffer, 20)
    assert memoryview(buffer).cast("f").tolist()[5:8] == mesh.positions.tolist()[1]
    raises(ValueError, sheet.copy_vertices, 0, mesh.vertexCount, bytearray(20 * mesh.vertexCount - 9), 20)
    raises(ValueError, sheet.copy_vertices, 0, 2, bytearray(24), 12, bytearray(23))
    raises((TypeError, BufferError), sheet.copy_vertices, 0, 1, bytes(12))
    assert sheet.copy_indices16(1, 2).tolist() == sum(mesh.indices.tolist()[1:3], [])
    raises(kiri.KiriError, sheet.copy_indices16, 0, mesh.triangleCount + 1)
    assert sheet.copy_sources(1, 2).tolist() == [1, 2]
    assert sheet.copy_source_weights(1, 2).tolist() == 2 * [1, 0, 0, 0, 1, 0, 0, 0, 1]
    vertices, before = sheet.copy_previous(2, 3)
    assert vertices.tolist() == [2, 3, 4] and before.id == sheet.id
    raises(kiri.KiriError, sheet.copy_previous, 0, mesh.vertexCount + 1)


def test_functions_of_no_world():
    assert kiri.version() == kiri.KIRI_VERSION and kiri.result_name(kiri.KIRI_PENDING) == "KIRI_PENDING"
    assert "kiriDefaultWorldDef" in kiri.result_text(kiri.KIRI_ERROR_DEF)
    assert kiri.stage_name(kiri.KIRI_STAGE_SOLVE) and kiri.material(kiri.KIRI_MATERIAL_PAPER).thickness > 1e-4
    assert kiri.quality(kiri.KIRI_QUALITY_FAST).substeps >= 1
    raises(kiri.KiriError, kiri.material, 99)
    assert kiri.default_sheet_def().frameCount == 24 and not hasattr(kiri.default_sheet_def(), "restPositions")
    setup = kiri.setup(kiri.SetupPreset.PAPER, 0.3, 0.3)
    counts = kiri.World().create_rectangle(0.3, 0.3, **vars(setup)).counts()
    assert (counts.frames, counts.triangles) == (25, 7200)
    positions, triangles = kiri.fill_rectangle(1, 1, 2, 2)
    assert kiri.World().create_sheet(positions, triangles).counts().triangles == 8
    raises(kiri.KiriError, kiri.fill_rectangle, 1, 1, 0, 2)
    world, _, _ = make_scene(clock=lambda user, time=iter(range(10 ** 6)): 1e-5 * next(time))
    world.tick(1 / 60)
    budget = kiri.fit_budget(world.profile(), 50.0, triangles=77)
    world.set_budget(**budget)
    assert budget["samples"] > 0
    assert world.last_error() == ""


def test_two_runs_agree_and_another_gravity_does_not():
    assert run_scene()[0].state_hash() == run_scene()[0].state_hash()
    world, _, _ = make_scene()
    world.set_gravity((0.0, 0.0, -1.0))
    for _ in range(30):
        world.tick(1 / 60, 2)
    assert world.state_hash() != run_scene()[0].state_hash()


def test_a_world_is_collected_while_cffi_parses():
    code = ("import gc, kiri; gc.disable(); world = kiri.World(); world.itself = world; del world\n"
            "with kiri.ffi._lock: gc.collect()")
    environment = {**os.environ, "KIRI_LIBRARY": library, "PYTHONPATH": os.path.join(repository, "bindings/python")}
    subprocess.run([sys.executable, "-c", code], env=environment, check=True, timeout=60)


def test_save_and_load():
    world, sheet, cut = make_scene()
    world.tick(1 / 60)
    saved, other, before_all = world.save(), kiri.World(), world.state_hash()
    snapshot = world.snapshot()
    other.load(saved)
    assert other.state_hash() == world.state_hash()
    for each in (world, other):
        each.tick(1 / 60)
    assert other.state_hash() == world.state_hash()
    before = other.state_hash()
    for wrong in (b"", saved[:-1], saved[:9] + b"x" + saved[10:]):
        raises(kiri.KiriError, other.load, wrong)
    assert other.state_hash() == before
    other.restore(snapshot)
    other.finish_cuts()
    assert other.state_hash() == before_all
    world.load(saved)
    assert sheet.counts().vertices == len(sheet.mesh().positions)


def test_cut():
    world, sheet, cut = make_scene()
    before = sheet.counts()
    world.tick(1 / 60)
    finished, = (event for event in world.events() if event.type == kiri.KIRI_EVENT_CUT_FINISHED)
    assert finished.cut == cut and finished.sheet == sheet
    assert any(event.type == kiri.KIRI_EVENT_PIECE_OFF for event in world.events())
    assert sheet.counts().vertices > before.vertices and sheet.counts().pieces == before.pieces + 1
    assert abs(sheet.totals().area - 0.75) < 1e-6
    assert 0 <= sheet.estimate_error() <= 1
    assert world.profile().trianglesSplit > 0
    assert raises(kiri.KiriError, cut.end).result == kiri.KIRI_ERROR_ID


def test_slice():
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 8, 8)
    sheet.slice([(0.5, -1, -1), (0.5, -1, 1), (0.5, 2, 1), (0.5, 2, -1)])
    world.tick(1 / 60)
    assert sheet.counts().pieces == 2


def flat(values):
    return memoryview(values).tobytes()


def test_arrays():
    world, sheet, _ = run_scene()
    mesh = sheet.mesh()
    assert mesh.positions.shape == (mesh.vertexCount, 3) and mesh.indices.shape == (mesh.triangleCount, 3)
    assert mesh.sourceTriangles.shape == (mesh.vertexCount,)
    pointer = world.get("kiriSheet_GetMesh", "kiriMesh", sheet.id).positions
    for values in (mesh.positions, mesh.normals, mesh.indices):
        raises((TypeError, ValueError), values.__setitem__, (0, 0), 1)
    assert [mesh.positions[7, i] for i in range(3)] == [pointer[21 + i] for i in range(3)]
    for i in range(mesh.vertexCount):
        assert abs(sum(mesh.normals[i, k] ** 2 for k in range(3)) - 1.0) < 1e-5
        assert abs(sum(mesh.sourceWeights[i, k] for k in range(3)) - 1.0) < 1e-5
    some = sheet.mesh("normals", "indices")
    assert flat(some.normals) == flat(mesh.normals) and some.vertexCount == mesh.vertexCount
    assert not hasattr(some, "positions")
    raises(TypeError, sheet.mesh, "vertexCount")
    sheet.set_settings(normals=0)
    assert sheet.mesh("normals").normals is None and sheet.settings().normals == 0
    assert len(sheet.collision_points()) == 0


def test_arrays_stay_as_they_are():
    world, sheet, _ = make_scene(gravity=(0.0, 3.0, 1.0))
    mesh = sheet.mesh()
    names = ("positions", "normals", "restPositions", "indices", "sourceTriangles", "sourceWeights")
    before = [flat(getattr(mesh, name)) for name in names]
    for _ in range(5):
        world.tick(1 / 60)
    assert [flat(getattr(mesh, name)) for name in names] == before
    assert flat(sheet.mesh().positions) != before[0] and sheet.mesh().vertexCount > mesh.vertexCount
    piece, piece_before = sheet.piece_mesh(1), flat(sheet.piece_mesh(1).indices)
    world.close()
    assert [flat(getattr(mesh, name)) for name in names] == before and flat(piece.indices) == piece_before


def test_arrays_of_c_live_until_the_tick():
    def bytes_of(world, sheet):
        mesh = world.get("kiriSheet_GetMesh", "kiriMesh", sheet.id)
        part = world.get("kiriSheet_GetPieceMesh", "kiriPieceMesh", sheet.id, 1)
        buffers = [kiri.ffi.buffer(mesh.positions, 12 * mesh.vertexCount),
                   kiri.ffi.buffer(mesh.indices, 12 * mesh.triangleCount),
                   kiri.ffi.buffer(part.indices, 12 * part.triangleCount)]
        return buffers, [bytes(buffer) for buffer in buffers]

    def detach(sheet):
        sheet.piece_frames(1)[0].detach_piece()

    def destroy(sheet):
        sheet.piece_frames(1)[0].destroy_piece()

    def load(sheet):
        sheet.world.load(sheet.world.save())

    for change in (detach, destroy, kiri.Sheet.destroy, lambda sheet: sheet.drop_crumbs(10.0), load):
        world, sheet, _ = run_scene()
        buffers, before = bytes_of(world, sheet)
        change(sheet)
        assert [bytes(buffer) for buffer in buffers] == before


def test_arrays_without_numpy():
    numpy, kiri._core.numpy = kiri._core.numpy, None
    try:
        assert isinstance(run_scene()[1].mesh().positions, memoryview)
        test_arrays()
        test_arrays_stay_as_they_are()
    finally:
        kiri._core.numpy = numpy


def test_buffers_are_taken():
    positions = array.array("f", [0, 0, 1, 0, 1, 1, 0, 1])
    triangles = array.array("i", [0, 1, 2, 0, 2, 3])
    world = kiri.World()
    nested = world.create_sheet([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
    shared = world.create_sheet(positions, triangles)
    assert nested.counts() == shared.counts() and shared.counts().triangles == 2
    if kiri._core.numpy:
        doubles = world.create_sheet(kiri._core.numpy.array(positions, dtype=float).reshape(-1, 2), [0, 1, 2, 0, 2, 3])
        assert doubles.counts() == shared.counts()


def test_frames_and_weights():
    world, sheet, _ = make_scene()
    frames = sheet.frames()
    assert len(frames) == sheet.counts().frames and len(set(frames)) == len(frames)
    weights = sheet.weights((0.4, 0.3))
    assert set(weights) <= set(frames) and abs(sum(weights.values()) - 1.0) < 1e-6
    frames[0].hold((0.0, 0.0, 2.0), (1, 0, 0, 0, 1, 0, 0, 0, 1))
    world.tick(1 / 60)
    assert frames[0].state().held == 1 and abs(frames[0].state().position[2] - 2.0) < 1e-6
    frames[0].release()
    world.tick(1 / 60)
    assert frames[0].state().held == 0


def test_debug_draw():
    world, sheet, _ = make_scene()
    world.tick(1 / 60)
    counts = sheet.counts()
    drawn = world.debug_draw(flags=kiri.KIRI_DRAW_FRAMES | kiri.KIRI_DRAW_LINKS | kiri.KIRI_DRAW_TRIANGLES)
    assert len(drawn.points) == 16 * counts.frames
    assert len(drawn.lines) == 2 * 16 * (3 * counts.frames + 2 * counts.links)
    assert len(drawn.triangles) == 3 * 16 * counts.triangles
    x, y, z, color = struct.unpack("fffI", drawn.points[:16])
    assert (x, y, z) == sheet.frames()[0].state().position and color >> 24 == 255
    raises(ZeroDivisionError, world.debug_draw, lines=lambda user, vertices, count: 1 // 0)
    raises(kiri.KiriError, world.debug_draw, size=0.0)


def test_force_and_contacts():
    world = kiri.World(gravity=(0, 0, 0))
    sheet = world.create_rectangle(1.0, 1.0, 8, 8, frameCount=1, rigidArea=1.0, collisionPoints=9,
                                   material={"airDamping": 0.0})
    frame, = sheet.frames()
    frame.apply_force((0.0, 0.0, 3.0))
    world.tick(0.01)
    assert abs(sheet.totals().momentum[2] - 0.03) < 1e-6
    points = sheet.collision_points()
    height = sheet.totals().center[2]
    contact = {"normal": (0, 0, 1), "offset": 1.0}
    before = sheet.totals().momentum[2]
    sheet.set_contacts([{"point": i, **contact} for i in range(len(points))])
    world.tick(0.01)
    momentum = sheet.totals().momentum[2]
    assert momentum > 0.04 and sheet.totals().center[2] > height
    forces = sheet.contact_forces()
    assert len(forces) == len(points) and abs(sum(f.impulse[2] for f in forces) - momentum + before) < 1e-9


def test_pieces():
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 8, 8, collisionPoints=9)
    for height in (0.2, 0.5):
        cut = sheet.begin_cut((-0.1, height))
        cut.extend([(1.1, height)])
        cut.end()
    world.tick(1 / 60)
    off = [event for event in world.events() if event.type == kiri.KIRI_EVENT_PIECE_OFF]
    assert len(off) == 2 and not hasattr(off[0], "piece")
    numbers = [event.frame.piece() for event in off]
    assert [round(sheet.piece(i).area, 6) for i in numbers] == [round(event.area, 6) for event in off]
    pieces = [sheet.piece(i) for i in range(sheet.counts().pieces)]
    assert sorted(round(piece.area, 5) for piece in pieces) == [0.2, 0.3, 0.5]
    for i, piece in enumerate(pieces):
        mesh = sheet.piece_mesh(i)
        assert (len(mesh.vertices), len(mesh.triangles)) == (piece.vertices, piece.triangles)
        assert len(mesh.collisionPoints) == piece.collisionPoints > 0
        assert [mesh.indices[0, k] for k in range(3)] == [sheet.mesh().indices[mesh.triangles[0], k] for k in range(3)]
        assert [frame.piece() for frame in sheet.piece_frames(i)] == [i] * piece.frames
    middle, = (i for i, piece in enumerate(pieces) if abs(piece.area - 0.3) < 1e-5)
    frames = sheet.piece_frames(middle)
    strip = frames[-1].detach_piece()
    assert strip.frames() == frames and abs(strip.totals().area - 0.3) < 1e-5
    assert raises(kiri.KiriError, frames[0].destroy_piece).result == kiri.KIRI_ERROR_STATE
    assert sheet.drop_crumbs(0.25) == 1 and sheet.counts().pieces == 1
    world.tick(1 / 60)
    half = strip.begin_cut((0.5, 0.1))
    half.extend([(0.5, 0.6)])
    half.end()
    world.tick(1 / 60)
    strip.piece_frames(0)[0].destroy_piece()
    assert strip.counts().pieces == 1 and abs(strip.totals().area - 0.15) < 1e-5
    world.tick(1 / 60)


def test_raycast():
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 8, 8)
    hit = sheet.raycast((0.25, 0.4, 1.0), (0.0, 0.0, -1.0), 5.0)
    assert abs(hit.distance - 1.0) < 1e-6 and abs(hit.restPoint[0] - 0.25) < 1e-6
    assert sheet.raycast((2.0, 0.4, 1.0), (0.0, 0.0, -1.0), 5.0) is None


def test_errors():
    world, sheet, _ = make_scene()
    error = raises(kiri.KiriError, world.tick, -1.0)
    assert error.result == kiri.KIRI_ERROR_ARGUMENT and "KIRI_ERROR_ARGUMENT" in str(error)
    raises(TypeError, world.create_rectangle, 1, 1, 2, 2, noSuchField=1)
    raises(ValueError, sheet.begin_cut, (0.5,))
    sheet.destroy()
    assert raises(kiri.KiriError, sheet.mesh).result == kiri.KIRI_ERROR_ID
    world.close()
    assert raises(kiri.KiriError, world.tick, 1 / 60).result == kiri.KIRI_ERROR_ARGUMENT
    world.close()


def test_log():
    lines = []
    world, _, _ = make_scene(log=lines.append)
    raises(kiri.KiriError, world.tick, float("nan"))
    assert len(lines) == 1 and lines[0]


def test_error_has_the_line_of_its_call():
    world, sheet, cut = make_scene()
    tick = str(raises(kiri.KiriError, world.tick, -1.0))
    assert tick == "World.tick: dt is -1, not within 1e-6 and 10 (KIRI_ERROR_ARGUMENT)"
    assert str(raises(kiri.KiriError, sheet.raycast, (0, 0, 0), (0, 0, 0), 1.0)).startswith("Sheet.raycast: ")
    assert str(raises(kiri.KiriError, cut.end)).startswith("Cut.end: ")
    made = str(raises(kiri.KiriError, world.create_rectangle, 1.0, 1.0, 1, 1, frameCount=-3))
    assert made == "World.create_rectangle: frameCount is -3, not within 0 and 65536 (KIRI_ERROR_ARGUMENT)"
    assert str(raises(kiri.KiriError, kiri.World, gravity=(0, 0, float("nan")))).startswith("World: gravity[2] is NaN")
    assert str(raises(kiri.KiriError, kiri.fill_rectangle, 0, 1, 1, 1)).startswith("fill_rectangle: ")
    closed = str(raises(kiri.KiriError, (world.close(), world.tick)[1], 1 / 60))
    assert closed == "World.tick: the world is closed (KIRI_ERROR_ARGUMENT)"


def test_error_has_the_line_of_its_thread():
    others = []

    def log(line):
        if "Raycast" in line:
            others.extend(outcomes([in_thread(kiri.Frame(world, 1).state)]))

    world, sheet, _ = make_scene(log=log)
    assert "Sheet.raycast" in str(raises(kiri.KiriError, sheet.raycast, (0, 0, 0), (0, 0, 0), 1.0))
    assert str(others[0]).startswith("Frame.state: ")


def test_lengths_are_checked():
    world, sheet, cut = make_scene()
    square, triangles = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)]
    world.create_sheet(square, triangles, frameCount=2, framePoints=[(0.2, 0.5), (0.8, 0.5)])
    for points in ([], [(0.2, 0.5)], [0.2, 0.5, 0.8], [(0.2, 0.5)] * 3):
        raises(ValueError, world.create_sheet, square, triangles, frameCount=2, framePoints=points)
    raises(ValueError, world.create_sheet, [0, 0, 1, 0, 1, 1, 0], triangles)
    raises(ValueError, world.create_sheet, square, [0, 1, 2, 0])
    raises(ValueError, world.create, "Sheet", restPositions=square, vertexCount=5, indices=triangles, triangleCount=2)
    raises(ValueError, world.create, "Sheet", restPositions=square, vertexCount=4, indices=triangles, triangleCount=3)
    edge, fields = [(0, 0), (0.1, 0)], {"sheetA": sheet, "sheetB": sheet}
    assert world.create_seam(lineA=edge, lineB=edge, **fields).count() > 1  # counts come from the arrays
    caught = raises(ValueError, world.create_seam, lineA=edge, lineB=[0.0, 0.1, 0.2], **fields)
    assert str(caught) == "kiriSeamDef.lineB: 2 numbers wanted, not 3"
    raises(TypeError, world.create_sheet, kiri.ffi.cast("float*", kiri.ffi.new("float[8]")), triangles)
    raises(ValueError, cut.extend, [0.1, 0.2, 0.3])
    raises(ValueError, world.set_gravity, (0, 1))
    raises(ValueError, sheet.frames()[0].hold, (0, 0, 0), (1, 0, 0, 0, 1, 0, 0, 0))
    raises(ValueError, sheet.slice, [(0, 0, 0)] * 3)
    raises(ValueError, sheet.create_pin, (0, 0), (1, 2))


def test_python_finds_mistakes():
    """Texts are no numbers, names of fields are suggested, records go where dicts do, and enums have names."""
    world = kiri.World()
    sheet = world.create_rectangle(1, 1, 8, 8, material=kiri.material(kiri.MaterialPreset.FOIL), model=kiri.Model.AFFINE)
    for wrong in ("ab", [("a", 0.5)], [b"ab"], ["0.1", "0.2"]):
        raises(TypeError, sheet.begin_cut, wrong)
    assert "did you mean frameCount?" in str(raises(TypeError, world.create_rectangle, 1, 1, 8, 8, framecount=9))
    assert "material()" in str(raises(TypeError, world.create_rectangle, 1, 1, 8, 8, material=kiri.MaterialPreset.PAPER))
    assert abs(sheet.settings().material.thickness - 16e-6) < 1e-9
    cut = sheet.begin_cut((-0.1, 0.5))
    cut.extend([(1.1, 0.5)])
    cut.end()
    world.tick(1 / 60)
    types = {event.type for event in world.events()}
    assert kiri.EventType.PIECE_OFF in types and all(isinstance(one, kiri.EventType) for one in types)
    assert kiri.KIRI_EVENT_PIECE_OFF is kiri.EventType.PIECE_OFF == 2
    assert kiri.DrawFlag.EDGES | kiri.DrawFlag.BORDERS == kiri.KIRI_DRAW_EDGES + kiri.KIRI_DRAW_BORDERS


def test_annotations():
    """Each public function has a docstring without pointers; generated ones have types that can be read."""
    from kiri import _fields
    for of in (kiri.World, kiri.Sheet, kiri.Cut, kiri.Frame, kiri.Pin, kiri.Obstacle, kiri.Blade, kiri.Seam):
        for name, function in vars(of).items():
            if name[0] != "_" and callable(function):
                assert function.__doc__, f"{of.__name__}.{name} has no docstring"
        for name, function in vars(of.__mro__[-2] if of is kiri.World else of.__mro__[2]).items():
            if name[0] != "_" and callable(function) and function.__module__ == "kiri._methods":
                hints = typing.get_type_hints(function, {**vars(kiri._methods), **vars(_fields), "kiri": kiri, "Unpack": typing.Type})
                assert "return" in hints and len(hints) > function.__code__.co_argcount - 1, f"{of.__name__}.{name}"
                assert not re.search(r"[*]\w|->|[Nn]ull\b", function.__doc__), f"{of.__name__}.{name}: {function.__doc__}"
    for kind in (_fields.SheetDef, _fields.PinDef, _fields.ObstacleDef, _fields.WorldDef, _fields.SheetSettings, _fields.Wind):
        fields = dict(kiri.ffi.typeof(f"kiri{kind.__name__}").fields)
        assert set(kind.__annotations__) == set(fields) - {"cookie", "type", "restPoint", "target"}  # these are arguments
    assert "Unpack[SheetDef]" in str(kiri.World.create_rectangle.__annotations__["fields"])
    assert (pathlib.Path(kiri.__file__).parent / "py.typed").exists()
    assert not {"Record", "Numbers", "enum", "annotations"} & set(vars(kiri))


def test_lines_and_loads():
    world = kiri.World(gravity=(0, 0, 0))
    sheet = world.create_rectangle(1.0, 1.0, 8, 8, frameCount=4, iterations=8, material={"youngsModulus": 1e8})
    clamp, hinge = sheet.clamp_line((0, 0), (0, 1)), sheet.hinge_line((1, 0), (1, 1))
    assert sheet.pins() == [clamp, hinge]
    assert clamp.state().type == kiri.KIRI_PIN_CLAMP and hinge.state().type == kiri.KIRI_PIN_HINGE
    assert list(clamp.state().target) == [0.0, 0.5, 0.0]
    for _ in range(200):
        sheet.apply_force((0.5, 0.5), (0, 1, 0))
        sheet.apply_line_load((0.5, 0), (0.5, 1), (0, 0, 1e-3))
        sheet.apply_pressure(-1e-3)
        world.tick(1 / 30)
    forces = [pin.reaction()[0] for pin in sheet.pins()]
    assert all(abs(sum(force[axis] for force in forces) - (0, -1, 0)[axis]) < 1e-3 for axis in range(3))
    clamp.set_pose((0.1, 0.5, 0.0), (1, 0, 0, 0, 1, 0, 0, 0, 1))
    assert abs(clamp.state().target[0] - 0.1) < 1e-7
    frame = sheet.frames()[0]
    frame.hold(frame.state().position, (1, 0, 0, 0, 1, 0, 0, 0, 1))
    world.tick(1 / 30)
    assert any(frame.reaction()[0])
    assert raises(kiri.KiriError, sheet.clamp_line, (2, 0), (2, 1)).result == kiri.KIRI_ERROR_ARGUMENT
    clamp.destroy()
    assert sheet.pins() == [hinge]


def test_paper():
    world = kiri.World()
    world.create_rectangle(1.0, 1.0, 8, 8, paper={"fromScratch": 1}, model=kiri.KIRI_MODEL_POINTS)
    world.tick(1 / 60)
    error = raises(kiri.KiriError, world.create_rectangle, 1, 1, 2, 2, paper={"integrationOrder": 3})
    assert error.result == kiri.KIRI_ERROR_ARGUMENT and "integrationOrder" in str(error)


def test_version():
    assert kiri.KIRI_VERSION == kiri.load().kiriGetVersion() == run_scene()[0].lib.kiriGetVersion()
    script = "import kiri; kiri._core.KIRI_VERSION += 77; kiri.World()"
    assert "version" in str(raises(AssertionError, run_python, "-c", script))


def test_binary_interface():
    import abi
    old = abi.interface(library)
    assert old["field kiriMesh.positions"].endswith("float *") and old["constant KIRI_PENDING"] == "1"
    assert abi.read("".join(f"{name} = {value}\n" for name, value in old.items())) == old
    assert not abi.breaks(old, dict(old, **{"function kiriNew": "int32_t(*)(void)"}))
    for change in ({"constant KIRI_PENDING": "2"}, {"struct kiriMesh": "1 bytes"}):
        assert abi.breaks(old, dict(old, **change))
        assert abi.breaks(dict(old, version="0.5.0"), dict(old, version="0.5.9", **change))
        assert not abi.breaks(dict(old, version="0.5.9"), dict(old, version="0.6.0", **change))
        assert abi.breaks(dict(old, version="1.2.0"), dict(old, version="1.3.0", **change))
    assert abi.breaks(old, {name: value for name, value in old.items() if name != "function kiriWorld_Tick"})


def test_example():
    for block in ((), ("-c", "import sys, runpy; sys.modules['numpy'] = None; sys.argv.pop(0);"
                       "runpy.run_path(sys.argv[0], run_name='__main__')")):
        lines = run_python(*block, str(repository / "bindings/python/example.py")).stdout.splitlines()
        assert "came off" in lines[0] and "state hash" in lines[-1]


def test_notebook():
    if subprocess.run([sys.executable, "-c", "import numpy, matplotlib"], capture_output=True).returncode:
        print("no numpy or no matplotlib: pieces.ipynb not tested")
        return
    cells = json.loads((repository / "bindings/python/pieces.ipynb").read_text())["cells"]
    code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "pieces.png"
        ending = f"\nfigure.savefig({str(picture)!r})\nprint(len(space.collections), flat.get_legend() is not None)"
        lines = run_python("-c", f"import matplotlib\nmatplotlib.use('Agg')\n{code}{ending}").stdout.splitlines()
        assert lines == ["3 pieces", "3 True"] and picture.read_bytes().startswith(b"\x89PNG")


def test_example_says_what_is_missing():
    for word, setting in (("needs cffi", "sys.modules['cffi'] = None"),
                          ("make lib", "os.environ['KIRI_LIBRARY'] = '/nowhere/libkiri.so'")):
        script = f"import os, runpy, sys; {setting}; runpy.run_path(sys.argv[1], run_name='__main__')"
        done = subprocess.run([sys.executable, "-c", script, str(repository / "bindings/python/example.py")],
                              env=dict(os.environ, PYTHONPATH=str(repository / "bindings/python"),
                                       PYTHONDONTWRITEBYTECODE="1"), capture_output=True, text=True, timeout=100)
        assert done.returncode == 1 and word in done.stderr and done.stderr.count("\n") == 1, done.stderr


def test_world_with_callbacks_is_collected():
    run_script("""
blocks = Blocks()
world, sheet, cut = make_scene(alloc=blocks.alloc, free=blocks.free, clock=lambda _: 0.0)
world.tick(1 / 60)
assert blocks.left
del world, sheet, cut
gc.collect()
assert not blocks.left
""")


def test_world_in_a_cycle_is_collected():
    run_script("""
blocks = Blocks()
def in_cycle():
    lines = []
    lines.append(make_scene(alloc=blocks.alloc, free=lambda _, pointer, kept=lines: blocks.free(_, pointer)))
    lines[0][0].tick(1 / 60)
for _ in range(3):
    in_cycle()
gc.collect()
assert not blocks.left
""")


def test_world_with_callbacks_at_exit():
    assert run_python("-c", """
import atexit
atexit.register(lambda: print("left", len(blocks.left)))
from test_python import *
blocks = Blocks()
world, sheet, cut = make_scene(alloc=blocks.alloc, free=blocks.free, log=lambda line: None)
world.tick(1 / 60)
""").stdout == "left 0\n"


def test_threads_take_turns():
    run_script("""
world, alone = make_scene()[0], make_scene()[0]
for _ in range(60):
    alone.tick(1 / 60)
def tick():
    for _ in range(20):
        world.tick(1 / 60)
assert outcomes([in_thread(tick) for _ in range(3)]) == [None] * 3
assert world.state_hash() == alone.state_hash()
""")


def test_threads_read_while_others_change():
    run_script("""
world, sheet, _ = make_scene()
at_once = []
def read():
    for _ in range(100):
        mesh, frames = sheet.mesh(), sheet.frames()
        assert len(mesh.positions) == mesh.vertexCount and len(frames) == len(set(frames))
        assert all(abs(mesh.normals[i, 0]) <= 1.001 for i in range(0, mesh.vertexCount, 7))
        assert abs(sum(sheet.weights((0.4, 0.3)).values()) - 1) < 1e-6
        world.events(), sheet.collision_points(), sheet.piece_mesh(0), sheet.piece_frames(0)
def tick():
    for i in range(100):
        cut = sheet.begin_cut((0.01 * i, -0.1))
        cut.extend([(0.01 * i, 0.05)])
        cut.end()
        world.tick(1 / 60)
    world.close()
threads = [in_thread(tick)] + [in_thread(read) for _ in range(2)]
first, *others = outcomes(threads)
assert first is None, first
assert all(other is None or getattr(other, "result", 0) == kiri.KIRI_ERROR_ARGUMENT for other in others), others
""")


def test_threads_read_side_by_side():
    blocks, both = Blocks(), None

    def alloc(user, size):
        if both:
            both.wait(20)  # goes on when two threads are here
        return blocks.alloc(user, size)

    world, sheet, _ = make_scene(alloc=alloc, free=blocks.free)
    alone = sheet.weights((0.4, 0.3))
    both = threading.Barrier(2)
    assert outcomes([in_thread(sheet.weights, (0.4, 0.3)) for _ in range(2)]) == [alone] * 2
    both = None


def test_a_change_is_alone():
    """While a callback waits inside of one call, the other call must not go on."""
    def tick(world, _):
        world.tick(1 / 60)

    def read(_, sheet):
        sheet.weights((0.4, 0.3))

    def wait_for_other(*_):
        if other and not threads:
            threads.append(in_thread(other, world, sheet))
            threads[0].join(0.2)
            waited.append(not hasattr(threads[0], "outcome"))

    def alloc(user, size):
        wait_for_other()
        return blocks.alloc(user, size)

    for call, next_call in ((tick, tick), (tick, read), (read, tick), (tick, lambda world, _: world.close())):
        blocks, threads, waited, other = Blocks(), [], [], None
        world, sheet, _ = make_scene(alloc=alloc, free=blocks.free)
        other = next_call
        call(world, sheet)
        assert waited == [True] and outcomes(threads) == [None]


def test_callback_calls_its_world():
    assert not run_script("""
blocks, errors, world = Blocks(), [], None
def calls(function):
    def callback(*arguments):
        for call in (lambda: world.close(), lambda: world.tick(1 / 60), lambda: sheet.counts(), lambda: sheet.mesh(),
                     lambda: world.set_gravity((0, 0, 0)), lambda: world.__del__()):
            if world:
                try:
                    call()
                except kiri.KiriError as error:
                    errors.append(error.result)
        return function(*arguments)
    return callback
made = make_scene(alloc=calls(blocks.alloc), free=calls(blocks.free), log=calls(lambda line: None),
                  clock=calls(lambda user: 0.0))
world, sheet, cut = made
world.tick(1 / 60)
raises(kiri.KiriError, world.tick, -1.0)
raises(kiri.KiriError, sheet.raycast, (0, 0, 0), (0, 0, 0), 1.0)
assert sheet.counts().pieces == 2
world.close()
assert set(errors) == {kiri.KIRI_ERROR_STATE} and not blocks.left
world = kiri.World(log=lambda line: world.close())
assert raises(kiri.KiriError, world.tick, -1.0).result == kiri.KIRI_ERROR_STATE
world.tick(1 / 60)
""").stderr


def test_what_callbacks_raise():
    assert not run_script("""
class Oops(Exception):
    pass
def raising(function):
    def callback(*arguments):
        if armed:
            raise Oops
        return function(*arguments)
    return callback
for name in ("alloc", "free", "log", "clock"):
    armed, blocks = [], Blocks()
    functions = {"alloc": blocks.alloc, "free": blocks.free, "log": lambda user, line: None, "clock": lambda user: 0.0}
    functions[name] = raising(functions[name])
    world, sheet, _ = make_scene(**functions)
    world.tick(1 / 60)
    before = world.state_hash()
    armed.append(1)
    raises(Oops, *{"alloc": (world.create_rectangle, 1, 1, 2, 2), "free": (sheet.destroy,), "log": (world.tick, -1.0),
                   "clock": (world.tick, 1 / 60)}[name])
    armed.clear()
    assert world.state_hash() == before or name in ("clock", "free")
    world.tick(1 / 60)
    armed.append(1)
    raises(Oops, world.close) if name == "free" else world.close()
    world.close()
    assert not blocks.left or name == "free"
armed = [1]
raises(Oops, kiri.World, alloc=raising(Blocks().alloc), free=lambda _, pointer: None)
""").stderr


def test_executor():
    import concurrent.futures

    class Counting(concurrent.futures.ThreadPoolExecutor):
        submitted = 0

        def submit(self, *arguments):
            self.submitted += 1
            return super().submit(*arguments)

    class Cancelling(Counting):
        def submit(self, *arguments):
            self.submitted += 1
            future = concurrent.futures.Future()
            future.cancel()
            return future

    def run(**fields):
        world = kiri.World(**fields)
        for i in range(4):
            world.create_rectangle(1, 1, 40, 40, position=(0, 0, i), frameCount=9)
        for _ in range(5):
            world.tick(1 / 60)
        return world.state_hash()

    alone = run()
    shut = Counting(2)
    shut.shutdown()
    for executor in (Counting(3), shut, Cancelling(2)):
        assert run(executor=executor, workerCount=3) == alone and executor.submitted > 5
        executor.shutdown()
    for name in ("startTask", "finishTask"):
        raises(TypeError, kiri.World, **{name: lambda *_: None})


def test_things_of_another_world():
    world, sheet, _ = make_scene()
    other, _, _ = make_scene()
    box = other.create_obstacle(kiri.KIRI_OBSTACLE_SPHERE, radius=1)
    frame = other.create_rectangle(1, 1, 2, 2).frames()[0]
    before = world.state_hash()
    raises(ValueError, sheet.create_pin, (0.5, 0.5), (0, 0, 0), obstacle=box)
    raises(ValueError, world.detach_pieces, [frame])
    raises(ValueError, world.destroy_pieces, [frame])
    raises(ValueError, world.begin_blade, frame.world.create_rectangle(1, 1, 2, 2))
    raises(TypeError, world.begin_blade, frame)
    raises(TypeError, world.detach_pieces, [sheet])
    raises(TypeError, world.call, "kiriDestroyWorld")
    raises(TypeError, copy.copy, world)
    raises(TypeError, copy.deepcopy, sheet)
    raises(TypeError, world.__init__)
    assert world.state_hash() == before


def test_pieces_that_wait():
    world, sheet, _ = run_scene()
    world.set_budget(cells=1)
    line = sheet.begin_cut((-0.1, 0.6))
    line.extend([(0.2, 0.6)])
    world.tick(1 / 60)
    assert world.detach_pieces(sheet.piece_frames(1)[:1]) == [None]


def test_nonsense():
    """Every method of everything, with arguments that make no sense: an exception or a result, and C goes on."""
    assert not run_script("""
import inspect, random
chance = random.Random(1)
nan = float("nan")
nonsense = [None, 0, -1, 7, 2 ** 70, nan, 1e300, "text", b"bytes", (), [[]], (nan,) * 3, (1e30,) * 2, (0,) * 9,
            [1, "a"], {}, {"a": 1}, object(), kiri, lambda: 1, kiri.ffi.NULL, kiri.ffi.new("float[3]"), kiri.ffi.new("double[9]"),
            kiri.ffi.cast("float*", kiri.ffi.new("float[2]")), array.array("d", [1.0, 2.0]), [(1, 2), (3,)], True]
def things():
    world, sheet, cut = make_scene()
    world.tick(1 / 60)
    blade = world.begin_blade()
    return [world, sheet, cut, blade, sheet.frames()[0], sheet.pins()[0],
            world.create_obstacle(kiri.KIRI_OBSTACLE_SPHERE, radius=0.1)]
gone = things()
gone[0].close()
calls = raised = 0
for _ in range(4):
    made = things()
    nonsense[:0] = made[1:] + gone[1:]
    for thing in made + gone:
        for name, method in inspect.getmembers(thing, callable):
            if name.startswith("_") or name in ("call", "get", "get_array", "get_copies", "close"):
                continue
            for _ in range(12):
                count = chance.randrange(5)
                fields = chance.sample(["frameCount", "material", "obstacle", "outline", "no"], chance.randrange(2))
                calls += 1
                try:
                    method(*chance.choices(nonsense, k=count), **{field: chance.choice(nonsense) for field in fields})
                except Exception as error:
                    raised += 1
                    assert getattr(error, "result", 0) != kiri.KIRI_ERROR_MEMORY, (name, error)
    made[0].tick(1 / 60)
    made[0].state_hash()
    del nonsense[:2 * len(made) - 2]
assert calls > 4000 and 0 < raised < calls, (calls, raised)
""").stderr


def record_scene():
    recording = bytearray()
    world, sheet, _ = make_scene(record=recording.extend, recordHashTicks=1)
    world.note(b"here")
    raises(kiri.KiriError, world.tick, -1.0)
    for _ in range(5):
        world.tick(1 / 60)
    hash = world.state_hash()
    world.close()
    return recording, sheet.id, hash


def test_recording():
    recording, sheet, hash = record_scene()
    world = kiri.World()
    assert list(world.replay(recording)) == [b"here", None, None, None, None, None]
    assert world.state_hash() == hash and [found.id for found in world.sheets()] == [sheet]
    assert world.sheets()[0].counts().pieces == 2
    assert raises(kiri.KiriError, list, world.replay(recording)).result == kiri.KIRI_ERROR_STATE
    careful = kiri.World()
    assert len(list(careful.replay(recording))) == 6 and careful.state_hash() == hash
    assert raises(kiri.KiriError, world.note, b"").result == kiri.KIRI_ERROR_ARGUMENT
    for broken in (b"", b"something else", recording[:-7], recording[:500]):
        error = raises(kiri.KiriError, list, kiri.World().replay(broken))
        assert error.result == kiri.KIRI_ERROR_DATA and "World.replay" in str(error)
    recording[22] ^= 1  # of gravity
    error = raises(kiri.KiriError, list, kiri.World().replay(recording))
    assert error.result == kiri.KIRI_ERROR_REPLAY and "World.tick in tick 1" in str(error)
    assert kiri.World().sheets() == []
    raises(TypeError, world.note, 5)
    raises(TypeError, list, world.replay("text"))


def test_record_that_raises():
    writes = []

    def record(recorded):
        writes.append(recorded)
        if len(writes) == 1:
            raise OSError("no room")
    assert str(raises(OSError, kiri.World, record=record)) == "no room"


def test_settings():
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 8, 8, friction=0.25)
    settings = sheet.settings()
    assert settings.friction == 0.25 and settings.material.thickness > 0
    sheet.set_settings(iterations=5, material={"density": 2 * settings.material.density})
    after = sheet.settings()
    assert after.iterations == 5 and after.friction == 0.25
    assert after.material.density == 2 * settings.material.density
    assert after.material.thickness == settings.material.thickness
    assert raises(kiri.KiriError, sheet.set_settings, iterations=0).result == kiri.KIRI_ERROR_ARGUMENT
    raises(TypeError, sheet.set_settings, colour=1)


def test_points_impulses_and_wind():
    world = kiri.World(gravity=(0, 0, 0))
    sheet = world.create_rectangle(1.0, 1.0, 8, 8, frameCount=5, material={"airDamping": 0})
    point = sheet.point((0.25, 0.5))
    assert max(abs(a - b) for a, b in zip(point.position, (0.25, 0.5, 0))) < 1e-6
    assert abs(point.normal[2] - 1) < 1e-6 and point.frame in sheet.frames()
    sheet.apply_impulse((0.25, 0.5), (0, 0, 0.1))
    assert abs(sheet.totals().momentum[2] - 0.1) < 1e-6
    sheet.set_velocity((0, 0, 1), (0, 0, 2))
    assert abs(sheet.point((0.5, 0.5)).velocity[2] - 1) < 1e-5
    sheet.set_wind(velocity=(0, 0, 5), density=1.2, drag=1.2)
    for _ in range(120):
        world.tick(1 / 60)
    assert 4 < sheet.totals().momentum[2] / sheet.totals().mass < 5
    sheet.set_wind()
    sheet.transform((0, 1, 0, -1, 0, 0, 0, 0, 1), (10, 0, 0))
    assert 9 < sheet.point((0.5, 0.5)).position[0] < 11
    assert raises(kiri.KiriError, sheet.point, (2, 2)).result == kiri.KIRI_ERROR_ARGUMENT
    assert sheet.is_awake()
    sheet.wake()


def test_pins_break():
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 8, 8)
    pin = sheet.create_pin((0, 0), (0, 0, 0), breakForce=1e-3)
    assert pin.state().breakForce > 0
    pin.set_break_force(0)
    world.tick(1 / 60)
    pin.set_break_force(1e-3)
    for _ in range(5):
        world.tick(1 / 60)
        if broken := [event.pin for event in world.events() if event.type == kiri.KIRI_EVENT_PIN_BROKE]:
            break
    assert broken == [pin] and sheet.pins() == []


def test_obstacles():
    world = kiri.World()
    sheet = world.create_rectangle(0.5, 0.5, 8, 8, position=(-0.25, -0.25, 0.1))
    floor = world.create_obstacle(kiri.KIRI_OBSTACLE_PLANE, friction=0.3)
    box = world.create_obstacle(kiri.KIRI_OBSTACLE_BOX, size=(0.2, 0.2, 0.1), mass=1)
    world.create_obstacle(kiri.KIRI_OBSTACLE_PRISM, outline=[(1, 0), (2, 0), (2, 1)], height=1)
    lower, upper = sheet.reach(1 / 60)
    assert lower[0] < -0.25 and upper[2] > 0.1
    for _ in range(60):
        world.tick(1 / 60, 2)
    assert box.state().contacts > 0 and box.state().impulse[2] < 0
    assert sheet.totals().center[2] > 0 and floor.state().impulse[0] == floor.state().impulse[0]
    pin = sheet.create_pin((0, 0), sheet.point((0, 0)).position, obstacle=box)
    assert pin.state().obstacle == box
    box.set_velocity((0, 0, 1))
    box.set_surface_velocity((0, 1, 0))
    box.set_mass(2, (1, 1, 1, 0, 0, 0))
    before = pin.state().target[2]
    world.tick(1 / 60)
    assert abs(pin.state().target[2] - before - 1 / 60) < 1e-5
    box.set_pose((0, 0, 5))
    assert box.state().position == (0, 0, 5)
    assert world.raycast((0, 0, 9), (0, 0, -1), 20)[0] == sheet
    assert world.raycast((9, 0, 9), (0, 0, -1), 20) is None
    box.destroy()
    assert raises(kiri.KiriError, box.state).result == kiri.KIRI_ERROR_ID


def test_blade_and_pieces():
    world = kiri.World(gravity=(0, 0, 0))
    sheet = world.create_rectangle(1.0, 1.0, 8, 8)
    blade = world.begin_blade(sheet)
    for step in range(12):
        y = -0.1 + 0.11 * step
        blade.move_ray((0.5, y, 1), (0, 0, -1), 2) if step % 2 else blade.move_edge((0.5, y, 1), (0.5, y, -1))
        world.tick(1 / 60)
    blade.end()
    world.tick(1 / 60)
    assert sheet.counts().pieces == 2
    frames = [sheet.piece_frames(piece)[0] for piece in range(2)]
    part, = world.detach_pieces(frames[1:])
    assert abs(part.totals().area - 0.5) < 0.01 and sheet.counts().pieces == 1
    line = sheet.begin_cut((-0.1, 0.5))
    line.extend([(0.6, 0.5)])
    world.set_budget(cells=100000)
    world.tick(1 / 60)
    assert sheet.counts().pieces == 2
    world.destroy_pieces(sheet.piece_frames(1)[:1])
    assert sheet.counts().pieces == 1 and abs(sheet.totals().area - 0.25) < 0.01


def test_user_data():
    world, sheet, _ = make_scene()
    sheet.set_user_data(2 ** 64 - 1)
    pin = sheet.pins()[0]
    pin.set_user_data(7)
    sheet.frames()[0].set_piece_user_data(9)
    world.tick(1 / 60)
    part = sheet.piece_frames(1)[0].detach_piece()
    assert part.user_data() == sheet.user_data() == 2 ** 64 - 1 and pin.user_data() == 7
    assert part.frames()[0].piece_user_data() == 9
    part.frames()[0].set_piece_velocity((1, 0, 0))
    assert abs(part.totals().momentum[0] / part.totals().mass - 1) < 1e-6


def test_solid():
    _, sheet, _ = make_scene()
    solid = sheet.solid(thickness=0.01)
    assert solid.triangleCount == len(solid.indices) > solid.rimTriangle == 2 * sheet.counts().triangles
    assert len(solid.positions) == len(solid.sources) == solid.vertexCount
    assert max(row[2] for row in solid.positions.tolist()) - 1 > 0.0049


def main():
    failed = 0
    tests = [test for name, test in globals().items() if name.startswith("test_")]
    for test in tests:
        try:
            test()
        except Exception as error:
            failed += 1
            print(f"{test.__name__}: {type(error).__name__}: {error}")
    print(f"{len(tests) - failed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
