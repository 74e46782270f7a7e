"""What all of the binding stands on: the library, values on their way to C and back, worlds and their turns."""

import atexit
import difflib
import os
import pathlib
import re
import threading
import types
import typing
import weakref

try:
    import cffi
except ImportError:
    raise ImportError("kiri needs cffi: pip install cffi, or Debian's python3-cffi") from None

try:
    import numpy
except ImportError:
    numpy = None

from . import _enums
from ._declarations import ARRAYS, CDEF, CHANGES, CONSTANTS, ENUMS, IDS, METHODS, VERSION

if typing.TYPE_CHECKING:
    from typing_extensions import Unpack
    from . import _fields

Numbers = typing.Any  # numbers, flat or in rows: a list, a tuple, an array of numpy, any buffer

KIRI_VERSION_MAJOR, KIRI_VERSION_MINOR, KIRI_VERSION_PATCH = map(int, VERSION.split("."))
KIRI_VERSION = 10000 * KIRI_VERSION_MAJOR + 100 * KIRI_VERSION_MINOR + KIRI_VERSION_PATCH
KIRI_OK, KIRI_PENDING = CONSTANTS["KIRI_OK"], CONSTANTS["KIRI_PENDING"]
KIRI_ERROR_ARGUMENT, KIRI_ERROR_STATE = CONSTANTS["KIRI_ERROR_ARGUMENT"], CONSTANTS["KIRI_ERROR_STATE"]

ffi = cffi.FFI()
ffi.cdef(CDEF)

_formats = {"float": "f", "int32_t": "i", "uint16_t": "H"}
_libraries = {}
_here = pathlib.Path(__file__).resolve().parent


def _library():
    """Beside this file in a wheel, built in a checkout."""
    for name in ("libkiri.so", "libkiri.dylib", "kiri.dll"):
        if (_here / name).exists():
            return _here / name
    return _here.parents[2] / "build/release/libkiri.so"


def load(path=None):
    """The C functions, by their C names."""
    path = os.path.abspath(path or os.environ.get("KIRI_LIBRARY") or _library())
    if path not in _libraries:
        try:
            library = ffi.dlopen(path)
        except OSError as error:
            why = str(error).split(".  Additionally")[0]
            raise ImportError(f"{why}; `make lib` builds it, KIRI_LIBRARY says where it is") from None
        if library.kiriGetVersion() != KIRI_VERSION:
            raise ImportError(f"{path} has version {library.kiriGetVersion()}, this package {KIRI_VERSION}")
        # The first use of a function takes a lock of cffi, which a thread may hold when it collects a world.
        for name in METHODS:
            getattr(library, name)
        _libraries[path] = library
    return _libraries[path]


def _own(found):
    """The name that a function of C has here."""
    return ".".join(filter(None, METHODS.get(found[0], (found[0],))))


class KiriError(Exception):
    """A call failed; `result` is its ResultCode."""

    def __init__(self, result, line):
        self.result = _enums.ResultCode(result)
        code, line = f"KIRI_{self.result.name}", re.sub(r"\bkiri[A-Z]\w*", _own, line.replace(": def.", ": "))
        super().__init__(line if code in line else f"{line or 'a call failed'} ({code})")


# ---- From Python to C and back --------------------------------------------------------------------------------------


def _flatten(values):
    for value in values:
        if isinstance(value, (str, bytes)):
            raise TypeError(f"numbers are wanted, not {value!r}")
        if hasattr(value, "__len__"):
            yield from _flatten(value)
        else:
            yield value


def array(item, values):
    """A C array of values, nested or flat. A copy, which nobody changes while C reads it."""
    if isinstance(values, ffi.CData):
        return values
    if isinstance(values, str):
        raise TypeError(f"numbers are wanted, not {values!r}")
    try:
        view = memoryview(values)
    except TypeError:
        view = None
    if view is not None and view.c_contiguous and view.format == _formats.get(item):
        copy = ffi.new(item + "[]", view.nbytes // view.itemsize)
        ffi.memmove(copy, view, view.nbytes)
        return copy
    return ffi.new(item + "[]", list(_flatten(values)))


def _check_length(values, length, name=""):
    """C reads as far as it was told, so a shorter array must not reach it."""
    if len(values) != length:
        raise ValueError(f"{name}{length} numbers wanted, not {len(values)}")
    return values


def vector(values, length):
    return _check_length(array("float", values), length)


def rows(item, values, width):
    """An array and its number of rows."""
    numbers = array(item, values)
    count = len(numbers) // width
    return _check_length(numbers, count * width), count


def unknown(line, name, names):
    near = difflib.get_close_matches(name, names, 1, 0.5)
    return TypeError(f"{line} {name}" + (f": did you mean {near[0]}?" if near else ""))


def fill(world, struct, values, kept):
    """Sets fields by name. What the struct only points to goes to `kept`."""
    kind = ffi.typeof(struct)
    kind = kind if kind.kind == "struct" else kind.item
    fields, arrays = dict(kind.fields), ARRAYS.get(kind.cname, {})
    given = {}
    for name, value in values.items():
        if name not in fields:
            raise unknown(f"{kind.cname} has no field", name, fields)
        field = fields[name].type
        if isinstance(value, types.SimpleNamespace):  # a record, such as material() returns
            value = vars(value)
        if field.kind == "struct" and not isinstance(value, (dict, list, tuple, ffi.CData)):
            raise TypeError(f"{kind.cname}.{name} takes a dict or a record, as material() returns, not {value!r}")
        if isinstance(value, dict) and field.kind == "struct":
            fill(world, getattr(struct, name), value, kept)
            continue
        if isinstance(value, Handle):
            value = world.id_of(value)
        if value is None:
            value = ffi.NULL
        elif field.kind == "array":
            value = list(_check_length(array("float", value), field.length, f"{kind.cname}.{name}: "))
        elif field.kind in ("pointer", "function"):
            if field.kind == "function":
                value = value if isinstance(value, ffi.CData) else ffi.callback(field, value, onerror=world._note)
            else:
                value = array(field.item.cname, value)
            kept.append(value)
            if name in arrays:
                given[name] = value
        setattr(struct, name, value)
    for name, numbers in given.items():
        count, width = arrays[name]
        if count not in values:
            setattr(struct, count, len(numbers) // width)
        _check_length(numbers, width * getattr(struct, count), f"{kind.cname}.{name}: ")


def definition(world, kind, values, kept):
    """A def by its kiriDefault function, with these fields."""
    made = ffi.new(kind + "*")
    getattr(world.lib, kind.replace("kiri", "kiriDefault", 1))(made)
    fill(world, made, values, kept)
    return made


def structure(world, kind, values, kept):
    """A struct with these fields: a def with its other defaults, and else zeros."""
    if hasattr(world.lib, kind.replace("kiri", "kiriDefault", 1)):
        return definition(world, kind, values, kept)
    made = ffi.new(kind + "*")
    fill(world, made, values, kept)
    return made


def record(struct, world=None):
    """A copy of a C struct of numbers, arrays of numbers, and such structs. Ids become things of the world."""
    kind, values = ffi.typeof(struct), {}
    for name, field in kind.fields:
        value = getattr(struct, name)
        if field.type.kind == "struct":
            value = record(value, world)
        elif field.type.kind == "array":
            value = tuple(value)
        elif world and name in IDS.get(kind.cname, ()):
            value = world.thing(IDS[kind.cname][name], value)
        elif field.type.kind in ("pointer", "function"):
            continue
        elif name in ENUMS.get(kind.cname, ()):
            value = _enum_of(ENUMS[kind.cname][name], value)
        values[name] = value
    return types.SimpleNamespace(**values)


def _enum_of(name, value):
    """A member of an enum; a number where it has none, as an event of no stage has -1."""
    try:
        return getattr(_enums, name)(value)
    except ValueError:
        return value


def check(name, *arguments):
    """A function of no world."""
    result = getattr(load(), name)(*arguments)
    if result < 0:
        raise KiriError(result, f"{name}: {ffi.string(load().kiriGetResultText(result)).decode()}")


def copy(pointer, count, width):
    """Rows of numbers, read-only: a numpy array, or a memoryview where numpy is missing. None where there are none."""
    item, shape = _formats[ffi.typeof(pointer).item.cname], (count, width) if width > 1 else (count,)
    if count == 0:
        return numpy.empty(shape, item) if numpy else memoryview(b"").cast(item)
    if pointer == ffi.NULL:
        return None
    memory = memoryview(bytes(ffi.buffer(pointer, 4 * count * width))).cast(item, shape)
    return numpy.asarray(memory) if numpy else memory


def copies(struct, names):
    """A record of a C struct with copies of the arrays that it points to: of those with these names, or of all."""
    kind = ffi.typeof(struct).item
    arrays = ARRAYS[kind.cname]
    record = {name: getattr(struct, name) for name, _ in kind.fields if name not in arrays}
    for name in names or arrays:
        if name not in arrays:
            raise unknown(f"{kind.cname} has no array", name, arrays)
        count, width = arrays[name]
        record[name] = copy(getattr(struct, name), getattr(struct, count), width)
    return types.SimpleNamespace(**record)


class _Turns:
    """Who may call C: one thread that changes the world, or any number that read it."""

    def __init__(self):
        self._left = threading.Condition()
        self._changing = False
        self._waiting = 0  # threads that want to change it: they go before new ones that read
        self.inside = set()
        self.lent = 0

    def enter(self, changes):
        thread = threading.get_ident()
        with self._left:
            if thread in self.inside:
                why = "its arrays are on loan" if self.lent else "a callback must not call the world it serves"
                raise KiriError(KIRI_ERROR_STATE, why)
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
    """Fields of kiriWorldDef by name, and an executor. `log` gets a line as str: print will do. `record` gets bytes: a
    file's write will do."""

    _world = ffi.NULL

    def __init__(self, library=None, executor=None, **fields: "Unpack[_fields.WorldDef]"):
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
        result = self.lib.kiriCreateWorld(definition(self, "kiriWorldDef", fields, self._kept), world)
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
            if isinstance(forward, ffi.CData):
                forward(user, line)
            elif forward:
                forward(said.line)
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
            raise KiriError(result, line)
        return result

    def id_of(self, thing, kind=None):
        """Of a sheet, cut, frame and so on of this world: another world may have the same id."""
        kind = Handle.kinds[kind] if kind else Handle
        if not isinstance(thing, kind):
            raise TypeError(f"a {kind.__name__} is wanted, not {thing!r}")
        if thing.world is not self:
            raise ValueError(f"{thing!r} is of another world")
        return thing.id

    def call(self, name, *arguments, take=None):
        """Any C function that takes the world first and returns a kiriResult. What it hands out lives until the next
        tick, which may be another thread's: `take` runs before that, and its result is returned."""
        if name not in CHANGES:
            raise TypeError(f"{name} is no function of a world")
        self._turns.enter(CHANGES[name])
        try:
            if self._world == ffi.NULL:
                raise KiriError(KIRI_ERROR_ARGUMENT, f"{name}: the world is closed")
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
        return self.call(name, *arguments, struct, take=lambda: copies(struct, names))

    def create(self, kind, /, *before, **fields):
        """The id of a new thing, from its def with these fields."""
        kept = []  # until C has read it
        return self.get(f"kiriCreate{kind}", "kiri" + kind, *before, definition(self, f"kiri{kind}Def", fields, kept))

    def thing(self, kind, number):
        """The object for an id; None for 0."""
        return Handle.kinds[kind](self, number) if number else None

    def lists(self, name, kinds, *arguments, null=()):
        """What a C function writes to arrays of some capacity."""
        capacity, count = 16, ffi.new("int32_t*")
        while True:
            arrays = [ffi.new(kind + "[]", capacity) for kind in kinds]
            self.call(name, *arguments, *arrays, *null, capacity, count)
            if count[0] <= capacity:
                return [ffi.unpack(array, count[0]) for array in arrays]
            capacity = count[0]


class Loan:
    """The library's own arrays, without a copy, for a `with` statement:

        with sheet.mesh_view() as mesh:
            upload(mesh.positions)

    Read-only memoryviews, or numpy arrays. Until the end of the statement no thread changes the world, and this one calls
    nothing of it. After it a memoryview gives ValueError. A numpy array knows no end: where somebody still has one, or a
    part of it, the end of the statement is a BufferError; `del` what has a name."""

    def __init__(self, world, name, kind, *arguments):
        self._world, self._name, self._arguments = world, name, arguments
        self._struct = ffi.new(kind + "*")
        self._lent, self._arrays = [], []

    def __enter__(self):
        world = self._world
        world._turns.enter(CHANGES[self._name])
        try:
            if world._world == ffi.NULL:
                raise KiriError(KIRI_ERROR_ARGUMENT, f"{self._name}: the world is closed")
            world._check(getattr(world.lib, self._name)(world._world, *self._arguments, self._struct))
            self._record = types.SimpleNamespace(**dict(self._fields()))
            world._turns.lent += 1
        except BaseException:
            world._turns.leave()
            raise
        return self._record

    def _fields(self):
        kind = ffi.typeof(self._struct).item
        arrays = ARRAYS[kind.cname]
        for name, _ in kind.fields:
            value = getattr(self._struct, name)
            if name in arrays:
                count, width = arrays[name]
                value = self._lend(value, getattr(self._struct, count), width)
            yield name, value

    def _lend(self, pointer, count, width):
        if pointer == ffi.NULL or count == 0:
            return copy(pointer, count, width)
        item = _formats[ffi.typeof(pointer).item.cname]
        bare = memoryview(ffi.buffer(pointer, 4 * count * width)).toreadonly()
        view = bare.cast("B").cast(item, (count, width) if width > 1 else (count,))
        if not numpy:
            self._lent.append(view)
            return view
        array = numpy.asarray(view)
        self._arrays.append(weakref.ref(array))
        return array

    def __exit__(self, kind, *_):
        vars(self._record).clear()
        kept = any(array() is not None for array in self._arrays)
        for view in self._lent:
            try:
                view.release()
            except BufferError:
                kept = True
        self._world._turns.lent -= 1
        self._world._turns.leave()
        if kept and kind is None:
            raise BufferError("an array of a view is still in use, after its `with` statement")


class Handle:
    """An id and its world."""

    kinds = {}

    def __init_subclass__(cls):
        Handle.kinds[cls.__name__] = cls

    def __init__(self, world, number):
        self.world = world
        self.id = number

    def __eq__(self, other):
        return type(self) is type(other) and self.world is other.world and self.id == other.id

    def __hash__(self):
        return hash(self.id)

    def __repr__(self):
        return f"{type(self).__name__}({self.id:#x})"
