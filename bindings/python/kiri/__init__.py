"""Kiri for Python: cuts thin sheets while they move.

A thin layer by cffi over the C library. The declarations come from kiri.h itself, so names of fields, units and ranges
are those of the header; this file only turns ids into objects, results into exceptions, and copies arrays.

    import kiri
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 16, 16, frameCount=9)
    cut = sheet.begin_cut((0.2, 0.5))
    cut.extend([(0.8, 0.5)])
    cut.end()
    world.tick(1 / 60)
    sheet.mesh().positions

Arrays that come back are copies: they outlive ticks, pieces, sheets and the world. Threads may share a world: a call
that changes it waits until no other runs, calls that only read run side by side. The functions given to World (alloc,
free, log, clock, record) run inside of such a call, and what they call on their own world fails with KIRI_ERROR_STATE. What
they raise is raised by that call when it is done; until then it goes on as if they had returned None, or 0.
World(executor=ThreadPoolExecutor(4), workerCount=4) lends the threads of an executor to its ticks.

The header is $KIRI_HEADER or include/kiri/kiri.h of this repository, the library is the argument of World,
$KIRI_LIBRARY, or build/release/libkiri.so.
"""

import atexit
import concurrent.futures
import os
import pathlib
import re
import threading
import types
import weakref

try:
    import cffi
except ImportError:
    raise ImportError("kiri needs cffi: pip install cffi, or Debian's python3-cffi") from None

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

# Functions of a world, and those that only read it.
_functions = set(re.findall(r"kiriResult (\w+)\((?:const )?kiriWorld\* ?world", _header))
_reading = set(re.findall(r"(\w+)\(const kiriWorld\*", _header))

# How long the arrays are that a struct points to: a field that counts the rows, numbers in a row.
_arrays = {
    "kiriSheetDef": {"restPositions": ("vertexCount", 2), "indices": ("triangleCount", 3),
                     "framePoints": ("frameCount", 2)},
    "kiriMesh": {"positions": ("vertexCount", 3), "normals": ("vertexCount", 3), "restPositions": ("vertexCount", 2),
                 "indices": ("triangleCount", 3), "sourceTriangles": ("vertexCount", 1),
                 "sourceWeights": ("vertexCount", 3)},
    "kiriSolid": {"positions": ("vertexCount", 3), "normals": ("vertexCount", 3), "restPositions": ("vertexCount", 2),
                  "indices": ("triangleCount", 3), "sources": ("vertexCount", 1)},
    "kiriObstacleDef": {"outline": ("outlineCount", 2)},
    "kiriPieceMesh": {"vertices": ("vertexCount", 1), "triangles": ("triangleCount", 1),
                      "indices": ("triangleCount", 3), "collisionPoints": ("collisionPointCount", 1)},
}
_formats = {"float": "f", "int32_t": "i"}
_libraries = {}


def load(path=None):
    """The C functions, by their C names."""
    path = os.path.abspath(path or os.environ.get("KIRI_LIBRARY") or _repository / "build/release/libkiri.so")
    if path not in _libraries:
        try:
            library = ffi.dlopen(path)
        except OSError as error:
            why = str(error).split(".  Additionally")[0]
            raise ImportError(f"{why}; `make lib` builds it, KIRI_LIBRARY says where it is") from None
        if library.kiriGetVersion() != KIRI_VERSION:
            raise ImportError(f"{path} has version {library.kiriGetVersion()}, the header {KIRI_VERSION}")
        # The first use of a function takes a lock of cffi, which a thread may hold when it collects a world.
        for name in re.findall(r"KIRI_API [\w ]+\*? ?(kiri\w+)\(", _header):
            getattr(library, name)
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
    """A C array of values, nested or flat. A copy, which nobody changes while C reads it."""
    if isinstance(values, ffi.CData):
        return values
    try:
        view = memoryview(values)
    except TypeError:
        view = None
    if view is not None and view.c_contiguous and view.format == _formats.get(item):
        copy = ffi.new(item + "[]", view.nbytes // view.itemsize)
        ffi.memmove(copy, view, view.nbytes)
        return copy
    return ffi.new(item + "[]", list(_flatten(values)))


def _check_length(values, length):
    """C reads as far as it was told, so a shorter array must not reach it."""
    if len(values) != length:
        raise ValueError(f"{length} numbers wanted, not {len(values)}")
    return values


def _vector(values, length):
    return _check_length(_array("float", values), length)


def _rows(item, values, width):
    """An array and its number of rows."""
    array = _array(item, values)
    count = len(array) // width
    return _check_length(array, count * width), count


def _fill(world, struct, values, kept):
    """Sets fields by name. What the struct only points to goes to `kept`."""
    kind = ffi.typeof(struct)
    kind = kind if kind.kind == "struct" else kind.item
    fields, arrays = dict(kind.fields), _arrays.get(kind.cname, {})
    given = {}
    for name, value in values.items():
        if name not in fields:
            raise TypeError(f"{kind.cname} has no field {name}")
        field = fields[name].type
        if isinstance(value, dict) and field.kind == "struct":
            _fill(world, getattr(struct, name), value, kept)
            continue
        if isinstance(value, _Handle):
            value = world.id_of(value)
        if value is None:
            value = ffi.NULL
        elif field.kind == "array":
            value = list(_vector(value, field.length))
        elif field.kind in ("pointer", "function"):
            if field.kind == "function":
                value = value if isinstance(value, ffi.CData) else ffi.callback(field, value, onerror=world._note)
            else:
                value = _array(field.item.cname, value)
            kept.append(value)
            if name in arrays:
                given[name] = value
        setattr(struct, name, value)
    for name, array in given.items():
        count, width = arrays[name]
        _check_length(array, width * getattr(struct, count))


def _definition(world, kind, values, kept):
    """A def by its kiriDefault function, with these fields."""
    definition = ffi.new(kind + "*")
    getattr(world.lib, kind.replace("kiri", "kiriDefault", 1))(definition)
    _fill(world, definition, values, kept)
    return definition


def _value(value):
    if not isinstance(value, ffi.CData):
        return value
    return tuple(value) if ffi.typeof(value).kind == "array" else _record(value)


def _record(struct):
    """A copy of a C struct of numbers, arrays of numbers, and such structs."""
    return types.SimpleNamespace(**{name: _value(getattr(struct, name)) for name, _ in ffi.typeof(struct).fields})


def _copy(pointer, count, width):
    """Rows of numbers, read-only: a numpy array, or a memoryview where numpy is missing. None where there are none."""
    item, shape = _formats[ffi.typeof(pointer).item.cname], (count, width) if width > 1 else (count,)
    if count == 0:
        return numpy.empty(shape, item) if numpy else memoryview(b"").cast(item)
    if pointer == ffi.NULL:
        return None
    memory = memoryview(bytes(ffi.buffer(pointer, 4 * count * width))).cast(item, shape)
    return numpy.asarray(memory) if numpy else memory


def _copies(struct, names):
    """A record of a C struct with copies of the arrays that it points to: of those with these names, or of all."""
    kind = ffi.typeof(struct).item
    arrays = _arrays[kind.cname]
    record = {name: getattr(struct, name) for name, _ in kind.fields if name not in arrays}
    for name in names or arrays:
        if name not in arrays:
            raise TypeError(f"{kind.cname} has no array {name}")
        count, width = arrays[name]
        record[name] = _copy(getattr(struct, name), getattr(struct, count), width)
    return types.SimpleNamespace(**record)


class _Turns:
    """Who may call C: one thread that changes the world, or any number that read it."""

    def __init__(self):
        self._left = threading.Condition()
        self._changing = False
        self._waiting = 0  # threads that want to change it: they go before new ones that read
        self.inside = set()

    def enter(self, changes):
        thread = threading.get_ident()
        with self._left:
            if thread in self.inside:
                raise KiriError(KIRI_ERROR_STATE, "KIRI_ERROR_STATE", "a callback must not call the world it serves")
            self._waiting += changes
            try:
                while self.inside if changes else self._changing or self._waiting:
                    self._left.wait()
            finally:
                self._waiting -= changes
            self.inside.add(thread)
            self._changing = changes

    def leave(self):
        with self._left:
            self.inside.remove(threading.get_ident())
            self._changing = False
            self._left.notify_all()


_worlds = weakref.WeakSet()


@atexit.register
def _close_all():
    """While callbacks still work. A world that some daemon thread is busy with is left alone."""
    for world in list(_worlds):
        if not world._turns.inside:
            world.close()


class _Said(threading.local):
    line = ""  # the last that C has logged in this thread, until it is in an exception
    raised = None  # by a callback in this thread, until the call is done


class _Threads:
    """Shares the ranges of a task out among the threads of a concurrent.futures.Executor."""

    def __init__(self, executor, workers):
        self._executor = executor
        self._workers = max(workers, 1)

    def start(self, _, task, count, least, context):
        size = max(least, -(-count // self._workers))
        first, *others = [(at, min(at + size, count), context) for at in range(0, count, size)]
        others = [(self._submit(task, part), part) for part in others]
        task(*first)
        for future, part in others:
            if future is None or not self._is_done(future):
                task(*part)
        return ffi.NULL  # nothing is left for finishTask

    def _submit(self, task, part):
        """None where the executor takes no more."""
        try:
            return self._executor.submit(task, *part)
        except RuntimeError:
            return None

    @staticmethod
    def _is_done(future):
        """False where it was cancelled, or its executor cannot call C."""
        try:
            future.result()
            return True
        except Exception:
            return False


class World:
    """Fields of kiriWorldDef by name, and an executor. `record` gets bytes: a file's write will do."""

    _world = ffi.NULL

    def __init__(self, library=None, executor=None, **fields):
        if self._world != ffi.NULL:
            raise TypeError("the world is there already")
        self._turns = _Turns()
        self._said = _Said()
        self._kept = []
        self.lib = load(library)
        fields["log"] = self._make_log(self._said, fields.get("log"))
        self._lend(executor, fields)
        if fields.get("record") and not isinstance(fields["record"], ffi.CData):
            fields["record"] = self._make_record(fields["record"])
        world = ffi.new("kiriWorld**")
        result = self.lib.kiriCreateWorld(_definition(self, "kiriWorldDef", fields, self._kept), world)
        self._world = world[0]
        self._check(result)
        _worlds.add(self)

    @staticmethod
    def _lend(executor, fields):
        """A function in Python that raises amid a task would leave it undone, so tasks take an executor."""
        for name in ("startTask", "finishTask"):
            if not isinstance(fields.get(name) or ffi.NULL, ffi.CData):
                raise TypeError(f"{name} must be a function of C: in Python, give an executor")
        if executor:
            fields["startTask"] = _Threads(executor, fields.get("workerCount", 1)).start
            fields["finishTask"] = lambda user, handle: None

    def __reduce__(self):
        raise TypeError("a world cannot be copied")

    @staticmethod
    def _make_record(write):
        def record(user, pointer, count):
            write(ffi.buffer(pointer, count)[:])
        return record

    @staticmethod
    def _make_log(said, forward):
        def log(user, line):
            said.line = ffi.string(line).decode()
            if forward:
                forward(user, line)
        return log

    def close(self):
        """Frees the world and all that is in it."""
        self._turns.enter(True)
        try:
            world, self._world = self._world, ffi.NULL
            self.lib.kiriDestroyWorld(world)
            self._check(KIRI_OK)
        finally:
            self._turns.leave()

    def __del__(self):
        if self._world != ffi.NULL:
            self.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _note(self, _, raised, __):
        """What a callback raised."""
        self._said.raised = self._said.raised or raised

    def _check(self, result):
        raised, line = self._said.raised, self._said.line
        self._said.raised, self._said.line = None, ""
        if raised:
            raise raised
        if result < 0:
            raise KiriError(result, ffi.string(self.lib.kiriGetResultName(result)).decode(), line)
        return result

    def id_of(self, thing, kind=None):
        """Of a sheet, cut, frame and so on of this world: another world may have the same id."""
        if not isinstance(thing, kind or _Handle):
            raise TypeError(f"a {(kind or _Handle).__name__} is wanted, not {thing!r}")
        if thing.world is not self:
            raise ValueError(f"{thing!r} is of another world")
        return thing.id

    def call(self, name, *arguments, take=None):
        """Any C function that takes the world first and returns a kiriResult. What it hands out lives until the next
        tick, which may be another thread's: `take` runs before that, and its result is returned."""
        if name not in _functions:
            raise TypeError(f"{name} is no function of a world")
        self._turns.enter(name not in _reading)
        try:
            if self._world == ffi.NULL:
                raise KiriError(KIRI_ERROR_ARGUMENT, "KIRI_ERROR_ARGUMENT", "the world is closed")
            result = self._check(getattr(self.lib, name)(self._world, *arguments))
            return take() if take else result
        finally:
            self._turns.leave()

    def get(self, name, kind, *arguments):
        """A C function whose last argument is where the answer goes."""
        answer = ffi.new(kind + "*")
        self.call(name, *arguments, answer)
        return answer[0]

    def get_array(self, take, name, kind, *arguments):
        """take(array, count) of a C function whose last arguments are where an array and its length go."""
        array, count = ffi.new(f"const {kind}**"), ffi.new("int32_t*")
        return self.call(name, *arguments, array, count, take=lambda: take(array[0], count[0]))

    def get_copies(self, names, name, kind, *arguments):
        """The counts of a C struct with copies of the arrays that it points to: those with these names, or all."""
        struct = ffi.new(kind + "*")
        return self.call(name, *arguments, struct, take=lambda: _copies(struct, names))

    def reaction(self, name, number):
        force, torque = ffi.new("double[3]"), ffi.new("double[3]")
        self.call(name, number, force, torque)
        return ffi.unpack(force, 3), ffi.unpack(torque, 3)

    def create(self, kind, *before, **fields):
        """The id of a new thing, from its def with these fields."""
        kept = []  # until C has read it
        definition = _definition(self, f"kiri{kind}Def", fields, kept)
        return self.get(f"kiriCreate{kind}", "kiri" + kind, *before, definition)

    def tick(self, dt, substeps=1):
        return self.call("kiriWorld_Tick", dt, substeps)

    def set_gravity(self, gravity):
        self.call("kiriWorld_SetGravity", _vector(gravity, 3))

    def state_hash(self):
        return self.get("kiriWorld_GetStateHash", "uint64_t")

    def sheets(self):
        count = self.get("kiriWorld_GetSheets", "int32_t", ffi.NULL, 0)
        sheets = ffi.new("kiriSheet[]", max(count, 1))
        count = min(count, self.get("kiriWorld_GetSheets", "int32_t", sheets, count))
        return [Sheet(self, sheets[i]) for i in range(count)]

    def debug_draw(self, **fields):
        """What kiriWorld_DebugDraw draws, with fields of kiriDebugDraw by name: points, lines and triangles, each as bytes of
        kiriDrawVertex: three floats and a colour. Functions of the caller's get batches of their own."""
        drawn = types.SimpleNamespace(points=bytearray(), lines=bytearray(), triangles=bytearray())

        def adder(to):
            return lambda user, vertices, count: to.extend(ffi.buffer(vertices, 16 * count))
        kept = []
        fields = {**{kind: adder(to) for kind, to in vars(drawn).items()}, **fields}
        self.call("kiriWorld_DebugDraw", _definition(self, "kiriDebugDraw", fields, kept))
        return drawn

    def note(self, note):
        """Bytes for the recording, which replays find."""
        note = bytes(memoryview(note))
        self.call("kiriWorld_Note", note, len(note))

    def replay(self, recording):
        """Makes the calls of a recording. Yields after each tick None, and each note as bytes. A call that goes otherwise
        than recorded, and a damaged recording, raise KiriError."""
        recording = bytes(memoryview(recording))
        at = ffi.new("kiriReplay*")
        while self.call("kiriWorld_Replay", ffi.from_buffer(recording), len(recording), at) == KIRI_PENDING:
            yield ffi.buffer(at.note, at.noteCount)[:] if at.note != ffi.NULL else None

    def save(self, base=None):
        """All that the coming ticks depend on, as bytes: see load. With a base, which an earlier call has returned: what
        has changed since."""
        size = ffi.new("int64_t*")
        name, before = ("kiriWorld_Save", ()) if base is None else (
            "kiriWorld_SaveDifference", (ffi.from_buffer(base), len(base)))

        def take():
            data = bytearray(size[0])
            self._check(getattr(self.lib, name)(self._world, *before, ffi.from_buffer(data), size[0], size))
            return bytes(data)
        return self.call(name, *before, ffi.NULL, 0, size, take=take)

    def load(self, data, base=None):
        """The world becomes what was saved; objects go on naming what they named then. A base as that of save."""
        if base is None:
            self.call("kiriWorld_Load", ffi.from_buffer(data), len(data))
        else:
            self.call("kiriWorld_LoadDifference", ffi.from_buffer(base), len(base), ffi.from_buffer(data), len(data))

    def profile(self):
        return _record(self.get("kiriWorld_GetProfile", "kiriProfile"))

    def events(self):
        return self.get_array(lambda events, count: [_record(events[i]) for i in range(count)], "kiriWorld_GetEvents",
                              "kiriEvent")

    def detach_pieces(self, frames):
        """The pieces of these frames as sheets, None for those that wait: see Frame.detach_piece. In one pass;
        frames of one piece have the same."""
        ids = [self.id_of(frame, Frame) for frame in frames]
        made = ffi.new("kiriSheet[]", max(len(ids), 1))
        self.call("kiriWorld_DetachPieces", ffi.new("kiriFrame[]", ids), len(ids), made)
        return [Sheet(self, made[i]) if made[i] else None for i in range(len(ids))]

    def destroy_pieces(self, frames):
        ids = [self.id_of(frame, Frame) for frame in frames]
        self.call("kiriWorld_DestroyPieces", ffi.new("kiriFrame[]", ids), len(ids))

    def set_budget(self, **fields):
        """Fields of kiriBudget by name; none: no limit."""
        budget = ffi.new("kiriBudget*")
        _fill(self, budget, fields, [])
        self.call("kiriWorld_SetBudget", budget)

    def raycast(self, origin, direction, max_distance):
        """The first sheet that a ray meets, and a kiriHit; or None."""
        sheet, hit = ffi.new("kiriSheet*"), ffi.new("kiriHit*")
        self.call("kiriWorld_Raycast", _vector(origin, 3), _vector(direction, 3), max_distance, sheet, hit)
        return (Sheet(self, sheet[0]), _record(hit[0])) if sheet[0] else None

    def create_obstacle(self, type, **fields):
        """KIRI_OBSTACLE_..., and other fields of kiriObstacleDef by name."""
        if "outline" in fields:
            fields["outline"], fields["outlineCount"] = _rows("float", fields["outline"], 2)
        return Obstacle(self, self.create("Obstacle", type=type, **fields))

    def begin_blade(self, sheet=None):
        """A blade in world space, for one sheet or for all."""
        return Blade(self, self.get("kiriBeginBlade", "kiriBlade", self.id_of(sheet, Sheet) if sheet else 0))

    def create_sheet(self, positions, triangles, **fields):
        """Rest positions and triangles, flat or in rows; other fields of kiriSheetDef by name, material and paper as
        dicts."""
        positions, vertex_count = _rows("float", positions, 2)
        triangles, triangle_count = _rows("int32_t", triangles, 3)
        return Sheet(self, self.create("Sheet", restPositions=positions, vertexCount=vertex_count, indices=triangles,
                                       triangleCount=triangle_count, **fields))

    def create_rectangle(self, width, height, columns, rows, **fields):
        kept = []  # until C has read it
        definition = _definition(self, "kiriSheetDef", fields, kept)
        return Sheet(self, self.get("kiriCreateRectangle", "kiriSheet", width, height, columns, rows, definition))


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

    def mesh(self, *names):
        """Counts and revision of kiriMesh with copies of its arrays: of those named, or of all."""
        return self.world.get_copies(names, "kiriSheet_GetMesh", "kiriMesh", self.id)

    def solid(self, *names, thickness=0.0):
        """The sheet with a thickness: counts of kiriSolid with copies of its arrays, of those named, or of all."""
        return self.world.get_copies(names, "kiriSheet_GetSolid", "kiriSolid", self.id, thickness)

    def collision_points(self):
        return self.world.get_array(lambda positions, count: _copy(positions, count, 3), "kiriSheet_GetCollisionPoints",
                                    "float", self.id)

    def reach(self, dt):
        """The lower and the upper corner of the box that holds all that it may touch in a tick of dt."""
        lower, upper = ffi.new("float[3]"), ffi.new("float[3]")
        self.world.call("kiriSheet_GetReach", self.id, dt, lower, upper)
        return tuple(lower), tuple(upper)

    def counts(self):
        return _record(self.world.get("kiriSheet_GetCounts", "kiriCounts", self.id))

    def totals(self):
        return _record(self.world.get("kiriSheet_GetTotals", "kiriTotals", self.id))

    def estimate_error(self):
        """Of the shape: the relative error by the number of frames."""
        return self.world.get("kiriSheet_EstimateError", "double", self.id)

    def settings(self):
        """What of the def may be changed."""
        return _record(self.world.get("kiriSheet_GetSettings", "kiriSheetSettings", self.id))

    def set_settings(self, **fields):
        """Fields of kiriSheetSettings by name, material as a dict; others stay."""
        settings, kept = ffi.new("kiriSheetSettings*"), []
        self.world.call("kiriSheet_GetSettings", self.id, settings)
        _fill(self.world, settings, fields, kept)
        self.world.call("kiriSheet_SetSettings", self.id, settings)

    def user_data(self):
        return self.world.get("kiriSheet_GetUserData", "uint64_t", self.id)

    def set_user_data(self, data):
        self.world.call("kiriSheet_SetUserData", self.id, data)

    def is_awake(self):
        return self.world.get("kiriSheet_IsAwake", "int32_t", self.id) != 0

    def wake(self):
        self.world.call("kiriSheet_Wake", self.id)

    def transform(self, rotation, translation):
        """Rotation: 9 numbers, column after column."""
        self.world.call("kiriSheet_Transform", self.id, _vector(rotation, 9), _vector(translation, 3))

    def set_velocity(self, velocity, angular_velocity=(0.0, 0.0, 0.0)):
        self.world.call("kiriSheet_SetVelocity", self.id, _vector(velocity, 3), _vector(angular_velocity, 3))

    def point(self, rest_point):
        """A kiriPointState, with a Frame."""
        point = _record(self.world.get("kiriSheet_GetPoint", "kiriPointState", self.id, _vector(rest_point, 2)))
        point.frame = Frame(self.world, point.frame)
        return point

    def raycast(self, origin, direction, max_distance):
        """A kiriHit, or None."""
        hit = self.world.get("kiriSheet_Raycast", "kiriHit", self.id, _vector(origin, 3), _vector(direction, 3),
                             max_distance)
        return _record(hit) if hit.triangle >= 0 else None

    def _lists(self, name, kinds, *arguments, null=()):
        """What a C function writes to arrays of some capacity."""
        capacity, count = 16, ffi.new("int32_t*")
        while True:
            arrays = [ffi.new(kind + "[]", capacity) for kind in kinds]
            self.world.call(name, self.id, *arguments, *arrays, *null, capacity, count)
            if count[0] <= capacity:
                return [ffi.unpack(array, count[0]) for array in arrays]
            capacity = count[0]

    def weights(self, rest_point):
        """The weight of each frame that counts at a rest point."""
        frames, weights = self._lists("kiriSheet_GetWeights", ("kiriFrame", "float"), _vector(rest_point, 2),
                                      null=(ffi.NULL,))
        return {Frame(self.world, frame): weight for frame, weight in zip(frames, weights)}

    def frames(self):
        frames, = self._lists("kiriSheet_GetFrames", ("kiriFrame",))
        return [Frame(self.world, frame) for frame in frames]

    def piece(self, piece):
        """A kiriPieceState."""
        return _record(self.world.get("kiriSheet_GetPiece", "kiriPieceState", self.id, piece))

    def piece_mesh(self, piece, *names):
        """Counts of kiriPieceMesh with copies of its arrays: of those named, or of all."""
        return self.world.get_copies(names, "kiriSheet_GetPieceMesh", "kiriPieceMesh", self.id, piece)

    def piece_frames(self, piece):
        frames = self.world.get_array(ffi.unpack, "kiriSheet_GetPieceFrames", "kiriFrame", self.id, piece)
        return [Frame(self.world, frame) for frame in frames]

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

    def clamp_line(self, start, end):
        """Holds place and direction of the material along a line of the rest plane, where it is now."""
        return Pin(self.world, self.world.get("kiriSheet_ClampLine", "kiriPin", self.id, _vector(start, 2),
                                              _vector(end, 2)))

    def hinge_line(self, start, end):
        """The same, but free to turn about the line."""
        return Pin(self.world, self.world.get("kiriSheet_HingeLine", "kiriPin", self.id, _vector(start, 2),
                                              _vector(end, 2)))

    def pins(self):
        pins, = self._lists("kiriSheet_GetPins", ("kiriPin",))
        return [Pin(self.world, pin) for pin in pins]

    def apply_force(self, rest_point, force, torque=(0.0, 0.0, 0.0)):
        self.world.call("kiriSheet_ApplyForce", self.id, _vector(rest_point, 2), _vector(force, 3), _vector(torque, 3))

    def apply_line_load(self, start, end, force_per_length):
        self.world.call("kiriSheet_ApplyLineLoad", self.id, _vector(start, 2), _vector(end, 2),
                        _vector(force_per_length, 3))

    def apply_pressure(self, pressure):
        self.world.call("kiriSheet_ApplyPressure", self.id, pressure)

    def apply_impulse(self, rest_point, impulse):
        self.world.call("kiriSheet_ApplyImpulse", self.id, _vector(rest_point, 2), _vector(impulse, 3))

    def set_wind(self, **fields):
        """Fields of kiriWind by name; none: no wind."""
        wind = ffi.new("kiriWind*")
        _fill(self.world, wind, fields, [])
        self.world.call("kiriSheet_SetWind", self.id, wind)

    def set_contacts(self, contacts):
        """Dicts with the fields of kiriContact."""
        self.world.call("kiriSheet_SetContacts", self.id, ffi.new("kiriContact[]", contacts), len(contacts))

    def contact_forces(self):
        """What the contacts did that were set before the last tick, in their order."""
        return self.world.get_array(lambda forces, count: [_record(forces[i]) for i in range(count)],
                                    "kiriSheet_GetContactForces", "kiriContactForce", self.id)


class Cut(_Handle):
    def extend(self, rest_points):
        self.world.call("kiriCut_Extend", self.id, *_rows("float", rest_points, 2))

    def end(self):
        self.world.call("kiriCut_End", self.id)


class Frame(_Handle):
    def state(self):
        return _record(self.world.get("kiriFrame_GetState", "kiriFrameState", self.id))

    def piece(self):
        """The index that its piece has now."""
        return self.world.get("kiriFrame_GetPiece", "int32_t", self.id)

    def detach_piece(self):
        """Its piece as a sheet of its own; None while work on a cut is at hand: an event names it when that is done."""
        made = self.world.get("kiriFrame_DetachPiece", "kiriSheet", self.id)
        return Sheet(self.world, made) if made else None

    def destroy_piece(self):
        self.world.call("kiriFrame_DestroyPiece", self.id)

    def piece_user_data(self):
        return self.world.get("kiriFrame_GetPieceUserData", "uint64_t", self.id)

    def set_piece_user_data(self, data):
        self.world.call("kiriFrame_SetPieceUserData", self.id, data)

    def set_piece_velocity(self, velocity, angular_velocity=(0.0, 0.0, 0.0)):
        self.world.call("kiriFrame_SetPieceVelocity", self.id, _vector(velocity, 3), _vector(angular_velocity, 3))

    def hold(self, position, rotation):
        """Rotation: 9 numbers, column after column."""
        self.world.call("kiriFrame_Hold", self.id, _vector(position, 3), _vector(rotation, 9))

    def release(self):
        self.world.call("kiriFrame_Hold", self.id, ffi.NULL, ffi.NULL)

    def apply_force(self, force, torque=(0.0, 0.0, 0.0)):
        self.world.call("kiriFrame_ApplyForce", self.id, _vector(force, 3), _vector(torque, 3))

    def reaction(self):
        """Force and torque of its hold in the last tick."""
        return self.world.reaction("kiriFrame_GetReaction", self.id)


class Pin(_Handle):
    def state(self):
        return _record(self.world.get("kiriPin_GetState", "kiriPinState", self.id))

    def set_target(self, target):
        self.world.call("kiriPin_SetTarget", self.id, _vector(target, 3))

    def set_pose(self, target, rotation):
        """Of a line. Rotation: 9 numbers, column after column."""
        self.world.call("kiriPin_SetPose", self.id, _vector(target, 3), _vector(rotation, 9))

    def reaction(self):
        """Force and torque of the last tick."""
        return self.world.reaction("kiriPin_GetReaction", self.id)

    def set_break_force(self, force):
        """N; 0: it never breaks."""
        self.world.call("kiriPin_SetBreakForce", self.id, force)

    def user_data(self):
        return self.world.get("kiriPin_GetUserData", "uint64_t", self.id)

    def set_user_data(self, data):
        self.world.call("kiriPin_SetUserData", self.id, data)

    def destroy(self):
        self.world.call("kiriDestroyPin", self.id)


class Obstacle(_Handle):
    def state(self):
        return _record(self.world.get("kiriObstacle_GetState", "kiriObstacleState", self.id))

    def set_pose(self, position, rotation=(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)):
        """Rotation: 9 numbers, column after column."""
        self.world.call("kiriObstacle_SetPose", self.id, _vector(position, 3), _vector(rotation, 9))

    def set_velocity(self, velocity, angular_velocity=(0.0, 0.0, 0.0)):
        self.world.call("kiriObstacle_SetVelocity", self.id, _vector(velocity, 3), _vector(angular_velocity, 3))

    def set_surface_velocity(self, velocity):
        self.world.call("kiriObstacle_SetSurfaceVelocity", self.id, _vector(velocity, 3))

    def set_mass(self, mass, inertia=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), center_of_mass=(0.0, 0.0, 0.0)):
        self.world.call("kiriObstacle_SetMass", self.id, mass, _vector(inertia, 6), _vector(center_of_mass, 3))

    def destroy(self):
        self.world.call("kiriDestroyObstacle", self.id)


class Blade(_Handle):
    def move_edge(self, start, end):
        """It is now the straight edge between two points of the world."""
        self.world.call("kiriBlade_MoveEdge", self.id, _vector(start, 3), _vector(end, 3))

    def move_ray(self, origin, direction, length):
        self.world.call("kiriBlade_MoveRay", self.id, _vector(origin, 3), _vector(direction, 3), length)

    def end(self):
        self.world.call("kiriBlade_End", self.id)
