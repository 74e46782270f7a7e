"""Kiri for Python: cuts thin sheets while they move.

A thin layer by cffi over the C library. The declarations come from kiri.h itself, so names of fields, units and ranges
are those of the header; this file only turns ids into objects, results into exceptions, and arrays into views.

    import kiri
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 16, 16, frameCount=9)
    cut = sheet.begin_cut((0.2, 0.5))
    cut.extend([(0.8, 0.5)])
    cut.end()
    world.tick(1 / 60)
    sheet.mesh().positions

The header is $KIRI_HEADER or include/kiri/kiri.h of this repository, the library is the argument of World,
$KIRI_LIBRARY, or build/release/libkiri.so.
"""

import os
import pathlib
import re
import types

import cffi

try:
    import numpy
except ImportError:
    numpy = None

_repository = pathlib.Path(__file__).resolve().parents[3]
_header = pathlib.Path(os.environ.get("KIRI_HEADER", _repository / "include/kiri/kiri.h")).read_text()


def _read_declarations(text):
    text = re.sub(r"^#ifdef __cplusplus$.*?^#endif$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^#.*$", "", text, flags=re.MULTILINE)
    return re.sub(r"\bKIRI_API\b", "", text)


ffi = cffi.FFI()
ffi.cdef(_read_declarations(_header))
for _tag in re.findall(r"^enum (\w+)", _header, re.MULTILINE):
    globals().update(ffi.typeof("enum " + _tag).relements)
KIRI_VERSION_MAJOR, KIRI_VERSION_MINOR, KIRI_VERSION_PATCH = (
    int(re.search(rf"#define KIRI_VERSION_{part} (\d+)", _header)[1]) for part in ("MAJOR", "MINOR", "PATCH"))
KIRI_VERSION = 10000 * KIRI_VERSION_MAJOR + 100 * KIRI_VERSION_MINOR + KIRI_VERSION_PATCH

_libraries = {}


def load(path=None):
    """The C functions, by their C names."""
    path = os.path.abspath(path or os.environ.get("KIRI_LIBRARY") or _repository / "build/release/libkiri.so")
    if path not in _libraries:
        library = ffi.dlopen(path)
        if library.kiriGetVersion() != KIRI_VERSION:
            raise ImportError(f"{path} has version {library.kiriGetVersion()}, the header {KIRI_VERSION}")
        _libraries[path] = library
    return _libraries[path]


class KiriError(Exception):
    """A call failed; `result` is its kiriResult."""

    def __init__(self, result, name, line):
        super().__init__(f"{name}: {line}" if line else name)
        self.result = result


# ---- From Python to C and back --------------------------------------------------------------------------------------


def _flatten(values):
    for value in values:
        if hasattr(value, "__len__"):
            yield from _flatten(value)
        else:
            yield value


def _array(item, values):
    """A C array of values, nested or flat: shared if it is a buffer of such items already, else copied."""
    if isinstance(values, ffi.CData):
        return values
    try:
        view = memoryview(values)
        if view.c_contiguous and view.format == {"float": "f", "int32_t": "i"}[item]:
            return ffi.from_buffer(item + "[]", values)
    except TypeError:
        pass
    return ffi.new(item + "[]", list(_flatten(values)))


def _vector(values, length):
    """C reads `length` floats whatever it is given, so a shorter vector must not reach it."""
    vector = _array("float", values)
    if len(vector) != length:
        raise ValueError(f"{length} numbers wanted, not {len(vector)}")
    return vector


def _fill(struct, values, kept):
    """Sets fields by name. What the struct only points to goes to `kept`."""
    kind = ffi.typeof(struct)
    fields = dict(kind.fields if kind.kind == "struct" else kind.item.fields)
    for name, value in values.items():
        if name not in fields:
            raise TypeError(f"{kind.cname} has no field {name}")
        field = fields[name].type
        if isinstance(value, dict):
            _fill(getattr(struct, name), value, kept)
            continue
        if field.kind in ("pointer", "function"):
            kept.append(ffi.callback(field, value) if field.kind == "function" else _array(field.item.cname, value))
            value = kept[-1]
        elif field.kind == "array":
            value = list(_vector(value, field.length))
        setattr(struct, name, value)


def _record(struct):
    """A copy of a C struct of numbers and arrays of numbers."""
    names = [name for name, _ in ffi.typeof(struct).fields]
    values = [getattr(struct, name) for name in names]
    return types.SimpleNamespace(
        **{name: tuple(value) if isinstance(value, ffi.CData) else value for name, value in zip(names, values)})


class World:
    """Fields of kiriWorldDef by name. Views of arrays are valid until the next tick, and keep the world alive."""

    def __init__(self, library=None, **fields):
        self.lib = load(library)
        self._kept = []
        definition = ffi.new("kiriWorldDef*")
        self.lib.kiriDefaultWorldDef(definition)
        _fill(definition, fields, self._kept)
        self._world = ffi.NULL
        world = ffi.new("kiriWorld**")
        self._check(self.lib.kiriCreateWorld(definition, world))
        self._world = ffi.gc(world[0], self.lib.kiriDestroyWorld)

    def close(self):
        """Frees the world and all that is in it, arrays that are still viewed too."""
        if self._world != ffi.NULL:
            ffi.release(self._world)
            self._world = ffi.NULL

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _check(self, result):
        if result < 0:
            name = ffi.string(self.lib.kiriGetResultName(result)).decode()
            line = self.lib.kiriWorld_GetLastError(self._world) if self._world != ffi.NULL else ffi.NULL
            raise KiriError(result, name, ffi.string(line).decode() if line != ffi.NULL else "")
        return result

    def call(self, name, *arguments):
        """Any C function that takes the world first and returns a kiriResult."""
        return self._check(getattr(self.lib, name)(self._world, *arguments))

    def get(self, name, kind, *arguments):
        """A C function whose last argument is where the answer goes."""
        answer = ffi.new(kind + "*")
        self.call(name, *arguments, answer)
        return answer[0]

    def create(self, kind, *before, **fields):
        """The id of a new thing, from its def with these fields."""
        definition, kept = ffi.new(f"kiri{kind}Def*"), []
        getattr(self.lib, f"kiriDefault{kind}Def")(definition)
        _fill(definition, fields, kept)
        return self.get(f"kiriCreate{kind}", "kiri" + kind, *before, definition)

    def view(self, pointer, item, count, width):
        """A read-only view of count rows of width numbers: a numpy array, or a memoryview where numpy is missing."""
        shape = (count, width) if width > 1 else (count,)
        if count == 0:
            return numpy.empty(shape, item) if numpy else memoryview(b"").cast(item)
        # A collector that does nothing but hold on to the world.
        pointer = ffi.gc(pointer, lambda _, world=self: None)
        memory = memoryview(ffi.buffer(pointer, 4 * count * width)).cast("B").cast(item, shape).toreadonly()
        return numpy.asarray(memory) if numpy else memory

    def tick(self, dt, substeps=1):
        return self.call("kiriWorld_Tick", dt, substeps)

    def set_gravity(self, gravity):
        self.call("kiriWorld_SetGravity", _vector(gravity, 3))

    def state_hash(self):
        return self.get("kiriWorld_GetStateHash", "uint64_t")

    def profile(self):
        return _record(self.get("kiriWorld_GetProfile", "kiriProfile"))

    def events(self):
        events, count = ffi.new("const kiriEvent**"), ffi.new("int32_t*")
        self.call("kiriWorld_GetEvents", events, count)
        return [_record(events[0][i]) for i in range(count[0])]

    def create_sheet(self, positions, triangles, **fields):
        """Rest positions and triangles, flat or in rows; other fields of kiriSheetDef by name, material as a dict."""
        positions, triangles = _array("float", positions), _array("int32_t", triangles)
        return Sheet(self, self.create("Sheet", restPositions=positions, vertexCount=len(positions) // 2,
                                       indices=triangles, triangleCount=len(triangles) // 3, **fields))

    def create_rectangle(self, width, height, columns, rows, **fields):
        positions = ffi.new("float[]", 2 * (columns + 1) * (rows + 1))
        triangles = ffi.new("int32_t[]", 6 * columns * rows)
        self._check(self.lib.kiriFillRectangle(width, height, columns, rows, positions, triangles))
        return self.create_sheet(positions, triangles, **fields)


class _Handle:
    """An id and its world."""

    def __init__(self, world, number):
        self.world = world
        self.id = number

    def __eq__(self, other):
        return type(self) is type(other) and self.world is other.world and self.id == other.id

    def __hash__(self):
        return hash(self.id)

    def __repr__(self):
        return f"{type(self).__name__}({self.id:#x})"


class Sheet(_Handle):
    def destroy(self):
        self.world.call("kiriDestroySheet", self.id)

    def mesh(self):
        """Views of the arrays of kiriMesh, with its counts and revision."""
        mesh = self.world.get("kiriSheet_GetMesh", "kiriMesh", self.id)
        vertices, view = mesh.vertexCount, self.world.view
        return types.SimpleNamespace(
            positions=view(mesh.positions, "f", vertices, 3),
            normals=view(mesh.normals, "f", vertices, 3),
            restPositions=view(mesh.restPositions, "f", vertices, 2),
            indices=view(mesh.indices, "i", mesh.triangleCount, 3),
            sourceTriangles=view(mesh.sourceTriangles, "i", vertices, 1),
            sourceWeights=view(mesh.sourceWeights, "f", vertices, 3),
            vertexCount=vertices, triangleCount=mesh.triangleCount, revision=mesh.revision)

    def collision_points(self):
        positions, count = ffi.new("const float**"), ffi.new("int32_t*")
        self.world.call("kiriSheet_GetCollisionPoints", self.id, positions, count)
        return self.world.view(positions[0], "f", count[0], 3)

    def counts(self):
        return _record(self.world.get("kiriSheet_GetCounts", "kiriCounts", self.id))

    def totals(self):
        return _record(self.world.get("kiriSheet_GetTotals", "kiriTotals", self.id))

    def raycast(self, origin, direction, max_distance):
        """A kiriHit, or None."""
        hit = self.world.get("kiriSheet_Raycast", "kiriHit", self.id, _vector(origin, 3), _vector(direction, 3),
                             max_distance)
        return _record(hit) if hit.triangle >= 0 else None

    def weights(self, rest_point):
        """The weight of each frame that counts at a rest point."""
        count, capacity = ffi.new("int32_t*"), self.counts().frames
        frames, weights = ffi.new("kiriFrame[]", capacity), ffi.new("float[]", capacity)
        self.world.call("kiriSheet_GetWeights", self.id, _vector(rest_point, 2), frames, weights, ffi.NULL,
                        capacity, count)
        return {Frame(self.world, frames[i]): weights[i] for i in range(count[0])}

    def frames(self):
        count, capacity = ffi.new("int32_t*"), self.counts().frames
        frames = ffi.new("kiriFrame[]", capacity)
        self.world.call("kiriSheet_GetFrames", self.id, frames, capacity, count)
        return [Frame(self.world, frame) for frame in frames]

    def piece(self, piece):
        """A kiriPieceState."""
        return _record(self.world.get("kiriSheet_GetPiece", "kiriPieceState", self.id, piece))

    def piece_mesh(self, piece):
        """Views of the arrays of kiriPieceMesh."""
        mesh = self.world.get("kiriSheet_GetPieceMesh", "kiriPieceMesh", self.id, piece)
        view = self.world.view
        return types.SimpleNamespace(
            vertices=view(mesh.vertices, "i", mesh.vertexCount, 1),
            triangles=view(mesh.triangles, "i", mesh.triangleCount, 1),
            indices=view(mesh.indices, "i", mesh.triangleCount, 3),
            collisionPoints=view(mesh.collisionPoints, "i", mesh.collisionPointCount, 1))

    def piece_frames(self, piece):
        frames, count = ffi.new("const kiriFrame**"), ffi.new("int32_t*")
        self.world.call("kiriSheet_GetPieceFrames", self.id, piece, frames, count)
        return [Frame(self.world, frames[0][i]) for i in range(count[0])]

    def drop_crumbs(self, area):
        """Destroys the pieces below an area; how many there were."""
        return self.world.get("kiriSheet_DropCrumbs", "int32_t", self.id, area)

    def begin_cut(self, rest_point):
        return Cut(self.world, self.world.get("kiriBeginCut", "kiriCut", self.id, _vector(rest_point, 2)))

    def slice(self, blade):
        """Four corners of the quadrilateral that a blade sweeps."""
        return Cut(self.world, self.world.get("kiriSheet_Slice", "kiriCut", self.id, _vector(blade, 12)))

    def create_pin(self, rest_point, target, **fields):
        return Pin(self.world, self.world.create("Pin", self.id, restPoint=rest_point, target=target, **fields))

    def set_contacts(self, contacts):
        """Dicts with the fields of kiriContact."""
        self.world.call("kiriSheet_SetContacts", self.id, ffi.new("kiriContact[]", contacts), len(contacts))


class Cut(_Handle):
    def extend(self, rest_points):
        points = _array("float", rest_points)
        self.world.call("kiriCut_Extend", self.id, points, len(points) // 2)

    def end(self):
        self.world.call("kiriCut_End", self.id)


class Frame(_Handle):
    def state(self):
        return _record(self.world.get("kiriFrame_GetState", "kiriFrameState", self.id))

    def piece(self):
        """The index that its piece has now."""
        return self.world.get("kiriFrame_GetPiece", "int32_t", self.id)

    def detach_piece(self):
        """Its piece as a sheet of its own."""
        return Sheet(self.world, self.world.get("kiriFrame_DetachPiece", "kiriSheet", self.id))

    def destroy_piece(self):
        self.world.call("kiriFrame_DestroyPiece", self.id)

    def hold(self, position, rotation):
        """Rotation: 9 numbers, column after column."""
        self.world.call("kiriFrame_Hold", self.id, _vector(position, 3), _vector(rotation, 9))

    def release(self):
        self.world.call("kiriFrame_Hold", self.id, ffi.NULL, ffi.NULL)

    def apply_force(self, force, torque=(0.0, 0.0, 0.0)):
        self.world.call("kiriFrame_ApplyForce", self.id, _vector(force, 3), _vector(torque, 3))


class Pin(_Handle):
    def set_target(self, target):
        self.world.call("kiriPin_SetTarget", self.id, _vector(target, 3))

    def destroy(self):
        self.world.call("kiriDestroyPin", self.id)
