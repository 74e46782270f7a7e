"""Kiri for Python: cuts thin sheets while they move.

    import kiri
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 16, 16, frameCount=9)
    sheet.cut([(-0.1, 0.5), (1.1, 0.5)])
    world.tick(1 / 60)
    sheet.mesh().positions

Methods are made from the header (_methods.py): a getter is named by what it gets, and what C writes behind pointers is
returned. Fields of structs have the names of the header, which says what they mean. What is other than in C is in this
file; _core.py has what all stands on. world.call("kiriSheet_Wake", sheet.id) is any function of C.

Arrays that come back are copies: they outlive ticks, pieces, sheets and the world. Without copies: see Loan. Threads may
share a world: a call that changes it waits until no other runs, calls that only read run side by side. The functions given
to World (alloc, free, log, clock, record) run inside of such a call, and what they call on their own world fails with
KIRI_ERROR_STATE. What they raise is raised by that call when it is done; until then it goes on as if they had returned None,
or 0. World(executor=ThreadPoolExecutor(4), workerCount=4) lends the threads of an executor to its ticks.

The library is the argument of World, $KIRI_LIBRARY, the one beside this file, or build/release/libkiri.so of a checkout.
"""

import types
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional, Tuple

from . import _core, _methods
from ._core import Handle, KiriError, Loan, ffi, load
from ._core import KIRI_VERSION, KIRI_VERSION_MAJOR, KIRI_VERSION_MINOR, KIRI_VERSION_PATCH
from ._enums import *  # EventType.PIECE_OFF, which is KIRI_EVENT_PIECE_OFF, and so on
from ._methods import *

if TYPE_CHECKING:
    from typing_extensions import Unpack
    from . import _fields

__version__ = _core.VERSION


def fill_rectangle(width: float, height: float, columns: int, rows: int) -> Tuple[Any, Any]:
    """Rest positions and triangles of a rectangle, as create_sheet takes them."""
    positions = ffi.new("float[]", max(2 * (columns + 1) * (rows + 1), 1))
    triangles = ffi.new("int32_t[]", max(6 * columns * rows, 1))
    _core.check("kiriFillRectangle", width, height, columns, rows, positions, triangles)
    return positions, triangles


def fit_budget(profile: types.SimpleNamespace, microseconds: float, **budget: int) -> Dict[str, int]:
    """The budget (a dict, for set_budget) whose work would have taken so many microseconds a tick at the pace of a
    profile. `budget`: what it is where the profile has none of an item."""
    known, fitted = ffi.new("kiriProfile*", vars(profile)), ffi.new("kiriBudget*", budget)
    _core.check("kiriFitBudget", known, microseconds, fitted)
    return vars(_core.record(fitted[0]))


class World(_core.World, _methods.World):
    """Fields of kiriWorldDef by name, and an executor. `log` gets a line as str: print will do. `record` gets bytes: a
    file's write will do."""

    def last_error(self) -> str:
        """The line of the last call that changed the world, or ''. Exceptions have it already."""
        self._turns.enter(False)
        try:
            return ffi.string(self.lib.kiriWorld_GetLastError(self._world)).decode()
        finally:
            self._turns.leave()

    def note(self, note: bytes) -> None:
        """Bytes for the recording, which replays find."""
        note = bytes(memoryview(note))
        self.call("kiriWorld_Note", note, len(note))

    def replay(self, recording: bytes) -> Iterator[Optional[bytes]]:
        """Makes the calls of a recording. Yields after each tick None, and each note as bytes. A call that goes otherwise
        than recorded, and a damaged recording, raise KiriError."""
        recording = bytes(memoryview(recording))
        at = ffi.new("kiriReplay*")
        while self.call("kiriWorld_Replay", ffi.from_buffer(recording), len(recording), at) == KIRI_PENDING:
            yield ffi.buffer(at.note, at.noteCount)[:] if at.note != ffi.NULL else None

    def _bytes(self, name):
        size = ffi.new("int64_t*")

        def take():
            data = bytearray(size[0])
            self._check(getattr(self.lib, name)(self._world, ffi.from_buffer(data), size[0], size))
            return bytes(data)
        return self.call(name, ffi.NULL, 0, size, take=take)

    def save(self) -> Optional[bytes]:
        """The world as bytes: see load. None while a cut is being worked on: see finish_cuts."""
        return self._bytes("kiriWorld_Save")

    def load(self, data: bytes) -> None:
        """The world becomes what was saved; objects go on naming what they named then. The bytes may come from anybody."""
        self.call("kiriWorld_Load", ffi.from_buffer(data), len(data))

    def snapshot(self) -> bytes:
        """All of the world, for rollback in this process: see restore."""
        return self._bytes("kiriWorld_Snapshot")

    def restore(self, data: bytes) -> None:
        """The world becomes what it was when the snapshot was made."""
        self.call("kiriWorld_Restore", ffi.from_buffer(data), len(data))

    def detach_pieces(self, frames: "List[Frame]") -> "List[Optional[Sheet]]":
        """The pieces of these frames as sheets, None for those that wait: see Frame.detach_piece. In one pass;
        frames of one piece have the same."""
        ids = [self.id_of(frame, "Frame") for frame in frames]
        made = ffi.new("kiriSheet[]", max(len(ids), 1))
        self.call("kiriWorld_DetachPieces", ffi.new("kiriFrame[]", ids), len(ids), made)
        return [Sheet(self, made[i]) if made[i] else None for i in range(len(ids))]

    def raycast(self, origin: _core.Numbers, direction: _core.Numbers, max_distance: float) -> "Optional[Tuple[Sheet, types.SimpleNamespace]]":
        """The first sheet that a ray meets, and a kiriHit; or None."""
        sheet, hit = ffi.new("kiriSheet*"), ffi.new("kiriHit*")
        self.call("kiriWorld_Raycast", _core.vector(origin, 3), _core.vector(direction, 3), max_distance, sheet, hit)
        return (Sheet(self, sheet[0]), _core.record(hit[0])) if sheet[0] else None

    def debug_draw(self, **fields: "Unpack[_fields.DebugDraw]") -> types.SimpleNamespace:
        """What kiriWorld_DebugDraw draws, with fields of kiriDebugDraw by name: points, lines and triangles, each as bytes of
        kiriDrawVertex: three floats and a colour. Functions of the caller's get batches of their own."""
        drawn = types.SimpleNamespace(points=bytearray(), lines=bytearray(), triangles=bytearray())

        def adder(to):
            return lambda user, vertices, count: to.extend(ffi.buffer(vertices, 16 * count))
        kept = []
        fields = {**{kind: adder(to) for kind, to in vars(drawn).items()}, **fields}
        self.call("kiriWorld_DebugDraw", _core.definition(self, "kiriDebugDraw", fields, kept))
        return drawn

    def create_sheet(self, positions: _core.Numbers, triangles: _core.Numbers, **fields: "Unpack[_fields.SheetDef]") -> "Sheet":
        """Rest positions and triangles, flat or in rows; other fields of kiriSheetDef by name, material and paper as
        dicts."""
        positions, vertex_count = _core.rows("float", positions, 2)
        triangles, triangle_count = _core.rows("int32_t", triangles, 3)
        return Sheet(self, self.create("Sheet", restPositions=positions, vertexCount=vertex_count, indices=triangles,
                                       triangleCount=triangle_count, **fields))

    def create_obstacle(self, type: int, **fields: "Unpack[_fields.ObstacleDef]") -> "Obstacle":
        """KIRI_OBSTACLE_..., and other fields of kiriObstacleDef by name."""
        if "outline" in fields:
            fields["outline"], fields["outlineCount"] = _core.rows("float", fields["outline"], 2)
        return Obstacle(self, self.create("Obstacle", type=type, **fields))


class Sheet(Handle, _methods.Sheet):
    def set_settings(self, **fields: "Unpack[_fields.SheetSettings]") -> None:
        """Fields of kiriSheetSettings by name, material as a dict; others stay."""
        settings, kept = ffi.new("kiriSheetSettings*"), []
        self.world.call("kiriSheet_GetSettings", self.id, settings)
        _core.fill(self.world, settings, fields, kept)
        self.world.call("kiriSheet_SetSettings", self.id, settings)

    def raycast(self, origin: _core.Numbers, direction: _core.Numbers, max_distance: float) -> "Optional[types.SimpleNamespace]":
        """A kiriHit, or None."""
        hit = self.world.get("kiriSheet_Raycast", "kiriHit", self.id, _core.vector(origin, 3), _core.vector(direction, 3),
                             max_distance)
        return _core.record(hit) if hit.triangle >= 0 else None

    def weights(self, rest_point: _core.Numbers) -> "Dict[Frame, float]":
        """The weight of each frame that counts at a rest point."""
        frames, weights = self.world.lists("kiriSheet_GetWeights", ("kiriFrame", "float"), self.id,
                                           _core.vector(rest_point, 2), null=(ffi.NULL,))
        return {Frame(self.world, frame): weight for frame, weight in zip(frames, weights)}

    def create_pin(self, restPoint: _core.Numbers, target: _core.Numbers, **fields: "Unpack[_fields.PinDef]") -> "Pin":
        """Holds a point of the material at a place of the world; other fields of kiriPinDef by name."""
        return Pin(self.world, self.world.create("Pin", self.id, restPoint=restPoint, target=target, **fields))

    def set_contacts(self, contacts):
        """Dicts with the fields of kiriContact."""
        self.world.call("kiriSheet_SetContacts", self.id, ffi.new("kiriContact[]", contacts), len(contacts))

    def copy_vertices(self, first, count, positions, position_stride=12, normals=None, normal_stride=12):
        """Positions, and unless None normals, of some vertices, 3 floats each, to buffers that may be written (bytearray,
        numpy, mapped memory), so many bytes apart."""
        buffers = [self._room(positions, count, position_stride), self._room(normals, count, normal_stride)]
        self.world.call("kiriSheet_CopyVertices", self.id, first, count, buffers[0], position_stride, buffers[1],
                        normal_stride)

    @staticmethod
    def _room(buffer, count, stride):
        if buffer is None:
            return ffi.NULL
        room = ffi.from_buffer(buffer, require_writable=True)
        if count > 0 and len(room) < (count - 1) * stride + 12:
            raise ValueError(f"{(count - 1) * stride + 12} bytes wanted, not {len(room)}")
        return room

    def copy_indices16(self, first_triangle, count):
        """The corners of some triangles as 16-bit numbers."""
        indices = ffi.new("uint16_t[]", max(3 * count, 1))
        self.world.call("kiriSheet_CopyIndices16", self.id, first_triangle, count, indices)
        return memoryview(ffi.buffer(indices, 6 * count)[:]).cast("H")

    def copy_sources(self, first_triangle, count):
        """The triangles of the def that some triangles are parts of."""
        sources = ffi.new("int32_t[]", max(count, 1))
        self.world.call("kiriSheet_CopySources", self.id, first_triangle, count, sources)
        return memoryview(ffi.buffer(sources, 4 * count)[:]).cast("i")

    def copy_source_weights(self, first_triangle, count):
        """9 floats a triangle: the barycentric coordinates of its corners in that triangle of the def."""
        weights = ffi.new("float[]", max(9 * count, 1))
        self.world.call("kiriSheet_CopySourceWeights", self.id, first_triangle, count, weights)
        return memoryview(ffi.buffer(weights, 36 * count)[:]).cast("f")

    def copy_previous(self, first, count):
        """The index that some vertices had when the last tick began, or -1, and the sheet that had them, which may be
        gone."""
        vertices, sheet = ffi.new("int32_t[]", max(count, 1)), ffi.new("kiriSheet*")
        self.world.call("kiriSheet_CopyPrevious", self.id, first, count, vertices, sheet)
        return memoryview(ffi.buffer(vertices, 4 * count)[:]).cast("i"), self.world.thing("Sheet", sheet[0])


class Cut(Handle, _methods.Cut):
    pass


class Frame(Handle, _methods.Frame):
    def hold(self, position: _core.Numbers, rotation: _core.Numbers) -> None:
        """Rotation: 9 numbers, column after column."""
        self.world.call("kiriFrame_Hold", self.id, _core.vector(position, 3), _core.vector(rotation, 9))

    def release(self) -> None:
        """Lets a held frame go."""
        self.world.call("kiriFrame_Hold", self.id, ffi.NULL, ffi.NULL)


class Pin(Handle, _methods.Pin):
    pass


class Obstacle(Handle, _methods.Obstacle):
    pass


class Blade(Handle, _methods.Blade):
    pass


class Seam(Handle, _methods.Seam):
    pass
