"""Made from kiri.h by `make bindings`: the functions of C as methods of what they are about."""

from __future__ import annotations

from types import SimpleNamespace as Record
from typing import TYPE_CHECKING, Any, Iterable, List, Optional, Tuple

from . import _core as core
from ._core import Numbers

if TYPE_CHECKING:
    import kiri
    from typing_extensions import Unpack
    from ._fields import *

__all__ = ['version', 'result_name', 'result_text', 'default_world_def', 'stage_name', 'material', 'quality',
 'default_sheet_def', 'setup', 'tearing', 'default_pin_def', 'default_seam_def', 'default_obstacle_def',
 'default_debug_draw']


def version() -> int:
    """Returns the version of the library, as KIRI_VERSION."""
    return core.load().kiriGetVersion()


def result_name(result: int) -> str:
    """Returns the name of a result, such as 'KIRI_OK'."""
    return core.ffi.string(core.load().kiriGetResultName(result)).decode()


def result_text(result: int) -> str:
    """Returns a line with the meaning of a result."""
    return core.ffi.string(core.load().kiriGetResultText(result)).decode()


def default_world_def() -> Record:
    """Returns the defaults of kiriWorldDef."""
    structure = core.ffi.new('kiriWorldDef*')
    core.load().kiriDefaultWorldDef(structure)
    return core.record(structure[0])


def stage_name(stage: int) -> str:
    """Returns the name of a stage; '' for another number."""
    return core.ffi.string(core.load().kiriGetStageName(stage)).decode()


def material(preset: int) -> Record:
    """Returns the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_..."""
    structure = core.ffi.new('kiriMaterial*')
    core.check('kiriGetMaterial', preset, structure)
    return core.record(structure[0])


def quality(preset: int) -> Record:
    """Returns the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_..."""
    structure = core.ffi.new('kiriQuality*')
    core.check('kiriGetQuality', preset, structure)
    return core.record(structure[0])


def default_sheet_def() -> Record:
    """Returns the defaults of kiriSheetDef."""
    structure = core.ffi.new('kiriSheetDef*')
    core.load().kiriDefaultSheetDef(structure)
    return core.record(structure[0])


def setup(preset: int, width: float, height: float) -> Record:
    """Returns a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of
    sheet and its sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual,
    accuracy).
    """
    structure = core.ffi.new('kiriSheetDef*')
    core.check('kiriGetSetup', preset, width, height, structure)
    return core.record(structure[0])


def tearing(preset: int) -> Record:
    """Returns toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of
    the sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS,
    another preset.
    """
    structure = core.ffi.new('kiriTearing*')
    core.check('kiriGetTearing', preset, structure)
    return core.record(structure[0])


def default_pin_def() -> Record:
    """Returns the defaults of kiriPinDef."""
    structure = core.ffi.new('kiriPinDef*')
    core.load().kiriDefaultPinDef(structure)
    return core.record(structure[0])


def default_seam_def() -> Record:
    """Returns the defaults of kiriSeamDef."""
    structure = core.ffi.new('kiriSeamDef*')
    core.load().kiriDefaultSeamDef(structure)
    return core.record(structure[0])


def default_obstacle_def() -> Record:
    """Returns the defaults of kiriObstacleDef."""
    structure = core.ffi.new('kiriObstacleDef*')
    core.load().kiriDefaultObstacleDef(structure)
    return core.record(structure[0])


def default_debug_draw() -> Record:
    """Returns the defaults of kiriDebugDraw."""
    structure = core.ffi.new('kiriDebugDraw*')
    core.load().kiriDefaultDebugDraw(structure)
    return core.record(structure[0])


class World:
    def tick(self, dt: float, substeps: int = 1) -> int:
        """Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the
        pending cut points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that
        still have work. KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget).
        KIRI_ERROR_LIMIT: no ids are left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED:
        events name sheets that were stopped.
        """
        return self.call('kiriWorld_Tick', dt, substeps)

    def shift_origin(self, origin: Numbers) -> int:
        """Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing
        wakes. Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not
        fit a float.
        """
        return self.call('kiriWorld_ShiftOrigin', core.vector(origin, 3))

    def set_gravity(self, gravity: Numbers) -> int:
        """Sets gravity (m/s^2) from the next tick on. All pieces wake."""
        return self.call('kiriWorld_SetGravity', core.vector(gravity, 3))

    def set_budget(self, **fields: Unpack[Budget]) -> int:
        """Sets the budget from the next tick on: fields of kiriBudget by name."""
        kept = []  # until C has read it
        structure = core.structure(self, 'kiriBudget', fields, kept)
        return self.call('kiriWorld_SetBudget', structure)

    def state_hash(self) -> int:
        """Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual,
        budget).
        """
        return self.get('kiriWorld_GetStateHash', 'uint64_t')

    def sheets(self) -> List[kiri.Sheet]:
        """Returns the sheets of the world, in the order of their making."""
        things, = self.lists('kiriWorld_GetSheets', ('kiriSheet',))
        return [self.thing('Sheet', thing) for thing in things]

    def finish_cuts(self) -> int:
        """Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports
        the events. Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
        kiriWorld_Tick.
        """
        return self.call('kiriWorld_FinishCuts')

    def events(self) -> List[Record]:
        """Returns the events since the start of the last tick."""
        return self.get_array(
            lambda array, count: [core.record(array[i], self) for i in range(count)],
            'kiriWorld_GetEvents', 'kiriEvent')

    def profile(self) -> Record:
        """Returns the profile of the last tick that was not refused."""
        return core.record(self.get('kiriWorld_GetProfile', 'kiriProfile'), self)

    def create_rectangle(self, width: float, height: float, columns: int = 0, rows: int = 0, **fields: Unpack[SheetDef]) -> kiri.Sheet:
        """Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns
        or rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def
        None: the defaults.
        """
        kept = []  # until C has read it
        structure = core.structure(self, 'kiriSheetDef', fields, kept)
        return self.thing('Sheet', self.get('kiriCreateRectangle', 'kiriSheet', width, height, columns, rows, structure))

    def create_folded_sheet(self, folds: Numbers, **fields: Unpack[SheetDef]) -> kiri.Sheet:
        """Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no
        material at one.
        """
        kept = []  # until C has read it
        structure = core.structure(self, 'kiriSheetDef', fields, kept)
        return self.thing('Sheet', self.get('kiriCreateFoldedSheet', 'kiriSheet', structure, *core.rows('kiriFold', folds, 1)))

    def destroy_pieces(self, frames: Iterable[kiri.Frame]) -> int:
        """Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
        KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i],
        0: pending.
        """
        ids = [self.id_of(thing, 'Frame') for thing in frames]
        return self.call('kiriWorld_DestroyPieces', core.ffi.new('kiriFrame[]', ids), len(ids))

    def begin_blade(self, sheet: Optional[kiri.Sheet] = None) -> kiri.Blade:
        """A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer,
        and cuts on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting).
        `sheet` 0: all.
        """
        return self.thing('Blade', self.get('kiriBeginBlade', 'kiriBlade', self.id_of(sheet, 'Sheet') if sheet else 0))

    def create_seam(self, **fields: Unpack[SeamDef]) -> kiri.Seam:
        """Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. KIRI_ERROR_ARGUMENT:
        a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
        """
        kept = []  # until C has read it
        structure = core.structure(self, 'kiriSeamDef', fields, kept)
        return self.thing('Seam', self.get('kiriCreateSeam', 'kiriSeam', structure))

    def seams(self) -> List[kiri.Seam]:
        """Returns the seams of the world."""
        things, = self.lists('kiriWorld_GetSeams', ('kiriSeam',))
        return [self.thing('Seam', thing) for thing in things]


class Sheet:
    def destroy(self) -> int:
        """Destroys the sheet with its cuts, frames and pins."""
        return self.world.call('kiriDestroySheet', self.id)

    def settings(self) -> Record:
        """Returns the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they
        do not come from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
        """
        return core.record(self.world.get('kiriSheet_GetSettings', 'kiriSheetSettings', self.id), self.world)

    def add_fold(self, **fields: Any) -> int:
        """Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
        KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet.
        """
        kept = []  # until C has read it
        structure = core.structure(self.world, 'kiriFold', fields, kept)
        return self.world.get('kiriSheet_AddFold', 'int32_t', self.id, structure)

    def fold(self, index: int) -> Record:
        """A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the
        sheet.
        """
        return core.record(self.world.get('kiriSheet_GetFold', 'kiriFoldState', self.id, index), self.world)

    def set_fold(self, index: int, stiffness: float, rest_angle: float) -> int:
        """A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the
        sheet.
        """
        return self.world.call('kiriSheet_SetFold', self.id, index, stiffness, rest_angle)

    def mesh(self, *names: str) -> Record:
        """Returns the arrays, without a copy."""
        return self.world.get_copies(names, 'kiriSheet_GetMesh', 'kiriMesh', self.id)

    def mesh_view(self) -> core.Loan:
        """The same without copies, for a `with` statement, within which the world does not change: see Loan."""
        return core.Loan(self.world, 'kiriSheet_GetMesh', 'kiriMesh', self.id)

    def dirty(self, since_revision: int) -> Record:
        """Returns the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore."""
        return core.record(self.world.get('kiriSheet_GetDirty', 'kiriDirty', self.id, since_revision), self.world)

    def solid(self, *names: str, thickness: float = 0.0) -> Record:
        """Makes the solid surface, with a thickness in m; thickness 0: the material's."""
        return self.world.get_copies(names, 'kiriSheet_GetSolid', 'kiriSolid', self.id, thickness)

    def solid_view(self, thickness: float = 0.0) -> core.Loan:
        """The same without copies, for a `with` statement, within which the world does not change: see Loan."""
        return core.Loan(self.world, 'kiriSheet_GetSolid', 'kiriSolid', self.id, thickness)

    def collision_points(self) -> Any:
        """Returns the collision points: 3 floats of position (m, world) a point."""
        return self.world.get_array(
            lambda array, count: core.copy(array, count, 3),
            'kiriSheet_GetCollisionPoints', 'float', self.id)

    def counts(self) -> Record:
        """Returns the counts, at no cost; sum the totals over the frames."""
        return core.record(self.world.get('kiriSheet_GetCounts', 'kiriCounts', self.id), self.world)

    def totals(self) -> Record:
        """Returns the counts, at no cost; sum the totals over the frames."""
        return core.record(self.world.get('kiriSheet_GetTotals', 'kiriTotals', self.id), self.world)

    def estimate_error(self) -> float:
        """Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not
        KIRI_MODEL_LINKS.
        """
        return self.world.get('kiriSheet_EstimateError', 'double', self.id)

    def is_awake(self) -> bool:
        """Returns False where all pieces sleep; piece() tells which."""
        return self.world.get('kiriSheet_IsAwake', 'int32_t', self.id) != 0

    def wake(self) -> int:
        """Wakes all pieces."""
        return self.world.call('kiriSheet_Wake', self.id)

    def transform(self, rotation: Numbers, translation: Numbers) -> int:
        """Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar
        sheet turns about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual,
        sheets).
        """
        return self.world.call('kiriSheet_Transform', self.id, core.vector(rotation, 9), core.vector(translation, 3))

    def set_velocity(self, velocity: Numbers, angular_velocity: Numbers = (0.0, 0.0, 0.0)) -> int:
        """Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its
        centre of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held
        frames stay held.
        """
        return self.world.call('kiriSheet_SetVelocity', self.id, core.vector(velocity, 3), core.vector(angular_velocity, 3))

    def set_user_data(self, data: int) -> int:
        """Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        has both.
        """
        return self.world.call('kiriSheet_SetUserData', self.id, data)

    def user_data(self) -> int:
        """Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        has both.
        """
        return self.world.get('kiriSheet_GetUserData', 'uint64_t', self.id)

    def point(self, rest_point: Numbers) -> Record:
        """Returns the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the
        point.
        """
        return core.record(self.world.get('kiriSheet_GetPoint', 'kiriPointState', self.id, core.vector(rest_point, 2)), self.world)

    def piece(self, piece: int) -> Record:
        """Returns a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the
        index.
        """
        return core.record(self.world.get('kiriSheet_GetPiece', 'kiriPieceState', self.id, piece), self.world)

    def piece_mesh(self, piece: int, *names: str) -> Record:
        """Returns a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the
        index.
        """
        return self.world.get_copies(names, 'kiriSheet_GetPieceMesh', 'kiriPieceMesh', self.id, piece)

    def piece_mesh_view(self, piece: int) -> core.Loan:
        """The same without copies, for a `with` statement, within which the world does not change: see Loan."""
        return core.Loan(self.world, 'kiriSheet_GetPieceMesh', 'kiriPieceMesh', self.id, piece)

    def piece_frames(self, piece: int) -> List[kiri.Frame]:
        """Returns the frames of a piece."""
        return self.world.get_array(
            lambda array, count: [self.world.thing('Frame', array[i]) for i in range(count)],
            'kiriSheet_GetPieceFrames', 'kiriFrame', self.id, piece)

    def drop_crumbs(self, area: float) -> int:
        """Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. Result: their
        number.
        """
        return self.world.get('kiriSheet_DropCrumbs', 'int32_t', self.id, area)

    def begin_cut(self, rest_point: Numbers) -> kiri.Cut:
        """Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        point (KIRI_EVENT_CUT_FINISHED).
        """
        return self.world.thing('Cut', self.world.get('kiriBeginCut', 'kiriCut', self.id, core.vector(rest_point, 2)))

    def cut(self, rest_points: Numbers) -> kiri.Cut:
        """Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        point (KIRI_EVENT_CUT_FINISHED).
        """
        return self.world.thing('Cut', self.world.get('kiriSheet_Cut', 'kiriCut', self.id, *core.rows('float', rest_points, 2)))

    def slice(self, blade: Numbers) -> kiri.Cut:
        """Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2],
        meets the current sheet; past borders, so that it separates the parts that it crosses. The cut is already
        ended.
        """
        return self.world.thing('Cut', self.world.get('kiriSheet_Slice', 'kiriCut', self.id, core.vector(blade, 12)))

    def set_tearing(self, **fields: Unpack[Tearing]) -> int:
        """Returns toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of
        the sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS,
        another preset.
        """
        kept = []  # until C has read it
        structure = core.structure(self.world, 'kiriTearing', fields, kept)
        return self.world.call('kiriSheet_SetTearing', self.id, structure)

    def tearing(self) -> Record:
        """Returns toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of
        the sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS,
        another preset.
        """
        return core.record(self.world.get('kiriSheet_GetTearing', 'kiriTearing', self.id), self.world)

    def set_tear_line(self, rest_points: Numbers, factor: float) -> int:
        """Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a
        factor, 0 or more: below 1 tears follow it, above 1 they stop there. The same points replace it.
        KIRI_ERROR_ARGUMENT: no material.
        """
        return self.world.call('kiriSheet_SetTearLine', self.id, *core.rows('float', rest_points, 2), factor)

    def frames(self) -> List[kiri.Frame]:
        """Returns the frames of the sheet."""
        things, = self.world.lists('kiriSheet_GetFrames', ('kiriFrame',), self.id)
        return [self.world.thing('Frame', thing) for thing in things]

    def apply_force(self, rest_point: Numbers, force: Numbers, torque: Numbers = (0.0, 0.0, 0.0)) -> int:
        """Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m)."""
        return self.world.call('kiriSheet_ApplyForce', self.id, core.vector(rest_point, 2), core.vector(force, 3), core.vector(torque, 3))

    def apply_line_load(self, start: Numbers, end: Numbers, force_per_length: Numbers) -> int:
        """Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges
        included. Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of kiriSheet_ClampLine.
        """
        return self.world.call('kiriSheet_ApplyLineLoad', self.id, core.vector(start, 2), core.vector(end, 2), core.vector(force_per_length, 3))

    def apply_pressure(self, pressure: float) -> int:
        """Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it."""
        return self.world.call('kiriSheet_ApplyPressure', self.id, pressure)

    def apply_impulse(self, rest_point: Numbers, impulse: Numbers) -> int:
        """Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of
        the frames that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the
        sheet.
        """
        return self.world.call('kiriSheet_ApplyImpulse', self.id, core.vector(rest_point, 2), core.vector(impulse, 3))

    def set_wind(self, **fields: Unpack[Wind]) -> int:
        """Copies the wind; it blows until the next call."""
        kept = []  # until C has read it
        structure = core.structure(self.world, 'kiriWind', fields, kept)
        return self.world.call('kiriSheet_SetWind', self.id, structure)

    def clamp_line(self, start: Numbers, end: Numbers) -> kiri.Pin:
        """Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its
        material, as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends
        equal, or far outside.
        """
        return self.world.thing('Pin', self.world.get('kiriSheet_ClampLine', 'kiriPin', self.id, core.vector(start, 2), core.vector(end, 2)))

    def hinge_line(self, start: Numbers, end: Numbers) -> kiri.Pin:
        """Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its
        material, as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends
        equal, or far outside.
        """
        return self.world.thing('Pin', self.world.get('kiriSheet_HingeLine', 'kiriPin', self.id, core.vector(start, 2), core.vector(end, 2)))

    def pins(self) -> List[kiri.Pin]:
        """Returns the pins of the sheet, of all types."""
        things, = self.world.lists('kiriSheet_GetPins', ('kiriPin',), self.id)
        return [self.world.thing('Pin', thing) for thing in things]

    def contact_forces(self) -> List[Record]:
        """Returns one result for each contact that was set before the last tick, in that order. A sleeping piece
        presses on.
        """
        return self.world.get_array(
            lambda array, count: [core.record(array[i], self.world) for i in range(count)],
            'kiriSheet_GetContactForces', 'kiriContactForce', self.id)

    def reach(self, dt: float) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        """Returns a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add
        their way.
        """
        lower = core.ffi.new('float[3]')
        upper = core.ffi.new('float[3]')
        self.world.call('kiriSheet_GetReach', self.id, dt, lower, upper)
        return tuple(lower), tuple(upper)


class Cut:
    def extend(self, rest_points: Numbers) -> int:
        """Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        point (KIRI_EVENT_CUT_FINISHED).
        """
        return self.world.call('kiriCut_Extend', self.id, *core.rows('float', rest_points, 2))

    def end(self) -> int:
        """Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
        once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
        nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
        point (KIRI_EVENT_CUT_FINISHED).
        """
        return self.world.call('kiriCut_End', self.id)


class Frame:
    def set_piece_velocity(self, velocity: Numbers, angular_velocity: Numbers = (0.0, 0.0, 0.0)) -> int:
        """Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its
        centre of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held
        frames stay held.
        """
        return self.world.call('kiriFrame_SetPieceVelocity', self.id, core.vector(velocity, 3), core.vector(angular_velocity, 3))

    def set_piece_user_data(self, data: int) -> int:
        """Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        has both.
        """
        return self.world.call('kiriFrame_SetPieceUserData', self.id, data)

    def piece_user_data(self) -> int:
        """Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        has both.
        """
        return self.world.get('kiriFrame_GetPieceUserData', 'uint64_t', self.id)

    def piece(self) -> int:
        """Returns the current index of the piece with this frame."""
        return self.world.get('kiriFrame_GetPiece', 'int32_t', self.id)

    def detach_piece(self) -> Optional[kiri.Sheet]:
        """Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay
        with the old sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut
        is pending, or the budget lacks samples for the piece; the result is None, further cuts of the sheet wait,
        and KIRI_EVENT_PIECE_DETACHED names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of
        the sheet (manual, cutting).
        """
        return self.world.thing('Sheet', self.world.get('kiriFrame_DetachPiece', 'kiriSheet', self.id))

    def destroy_piece(self) -> int:
        """Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles
        stay with three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all
        of its sheet.
        """
        return self.world.call('kiriFrame_DestroyPiece', self.id)

    def state(self) -> Record:
        """Returns the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the
        sheet: means over the last tick that moved the piece, with the frame's own weight and change of momentum.
        Zero for a free frame.
        """
        return core.record(self.world.get('kiriFrame_GetState', 'kiriFrameState', self.id), self.world)

    def reaction(self) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        """Returns the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the
        sheet: means over the last tick that moved the piece, with the frame's own weight and change of momentum.
        Zero for a free frame.
        """
        force = core.ffi.new('double[3]')
        torque = core.ffi.new('double[3]')
        self.world.call('kiriFrame_GetReaction', self.id, force, torque)
        return tuple(force), tuple(torque)

    def apply_force(self, force: Numbers, torque: Numbers = (0.0, 0.0, 0.0)) -> int:
        """Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m)."""
        return self.world.call('kiriFrame_ApplyForce', self.id, core.vector(force, 3), core.vector(torque, 3))


class Pin:
    def set_user_data(self, data: int) -> int:
        """Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        has both.
        """
        return self.world.call('kiriPin_SetUserData', self.id, data)

    def user_data(self) -> int:
        """Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and
        a piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it
        has both.
        """
        return self.world.get('kiriPin_GetUserData', 'uint64_t', self.id)

    def destroy(self) -> int:
        """Destroys a pin of any type."""
        return self.world.call('kiriDestroyPin', self.id)

    def set_target(self, target: Numbers) -> int:
        """Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's
        material (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and
        later. The pin moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a
        point.
        """
        return self.world.call('kiriPin_SetTarget', self.id, core.vector(target, 3))

    def set_pose(self, target: Numbers, rotation: Numbers) -> int:
        """Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's
        material (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and
        later. The pin moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a
        point.
        """
        return self.world.call('kiriPin_SetPose', self.id, core.vector(target, 3), core.vector(rotation, 9))

    def set_break_force(self, break_force: float) -> int:
        """Sets the force (N) that breaks a pin of any type; 0: it never breaks."""
        return self.world.call('kiriPin_SetBreakForce', self.id, break_force)

    def state(self) -> Record:
        """Returns the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that
        moved it.
        """
        return core.record(self.world.get('kiriPin_GetState', 'kiriPinState', self.id), self.world)

    def reaction(self) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        """Returns the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that
        moved it.
        """
        force = core.ffi.new('double[3]')
        torque = core.ffi.new('double[3]')
        self.world.call('kiriPin_GetReaction', self.id, force, torque)
        return tuple(force), tuple(torque)


class Obstacle:
    def destroy(self) -> int:
        """Destroys the obstacle. Pieces that rested on it wake."""
        return self.world.call('kiriDestroyObstacle', self.id)

    def set_pose(self, position: Numbers, rotation: Numbers = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)) -> int:
        """Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity), not to the jump."""
        return self.world.call('kiriObstacle_SetPose', self.id, core.vector(position, 3), core.vector(rotation, 9))

    def set_velocity(self, velocity: Numbers, angular_velocity: Numbers = (0.0, 0.0, 0.0)) -> int:
        """Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
        mass.
        """
        return self.world.call('kiriObstacle_SetVelocity', self.id, core.vector(velocity, 3), core.vector(angular_velocity, 3))

    def set_surface_velocity(self, velocity: Numbers) -> int:
        """Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
        mass.
        """
        return self.world.call('kiriObstacle_SetSurfaceVelocity', self.id, core.vector(velocity, 3))

    def set_mass(self, mass: float, inertia: Numbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0), center_of_mass: Numbers = (0.0, 0.0, 0.0)) -> int:
        """Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
        mass.
        """
        return self.world.call('kiriObstacle_SetMass', self.id, mass, core.vector(inertia, 6), core.vector(center_of_mass, 3))

    def state(self) -> Record:
        """Returns the current state."""
        return core.record(self.world.get('kiriObstacle_GetState', 'kiriObstacleState', self.id), self.world)


class Blade:
    def move_edge(self, start: Numbers, end: Numbers) -> int:
        """Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
        casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it:
        cuts stay.
        """
        return self.world.call('kiriBlade_MoveEdge', self.id, core.vector(start, 3), core.vector(end, 3))

    def move_ray(self, origin: Numbers, direction: Numbers, length: float) -> int:
        """Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
        casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it:
        cuts stay.
        """
        return self.world.call('kiriBlade_MoveRay', self.id, core.vector(origin, 3), core.vector(direction, 3), length)

    def end(self) -> int:
        """Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
        casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it:
        cuts stay.
        """
        return self.world.call('kiriBlade_End', self.id)


class Seam:
    def destroy(self) -> int:
        """Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. KIRI_ERROR_ARGUMENT:
        a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
        """
        return self.world.call('kiriDestroySeam', self.id)

    def set_hinge(self, stiffness: float, rest_angle: float) -> int:
        """Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. KIRI_ERROR_ARGUMENT:
        a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
        """
        return self.world.call('kiriSeam_SetHinge', self.id, stiffness, rest_angle)

    def stitch(self, index: int) -> Record:
        """Returns a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such
        index.
        """
        return core.record(self.world.get('kiriSeam_GetStitch', 'kiriStitch', self.id, index), self.world)

    def count(self) -> int:
        """Returns a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such
        index.
        """
        return self.world.get('kiriSeam_GetCount', 'int32_t', self.id)
