"""Made from kiri.h by `make bindings`: the enums of C, whose values are ints, too."""

import enum as _enum


class ResultCode(_enum.IntEnum):
    OK = 0
    PENDING = 1
    ERROR_ARGUMENT = -1
    ERROR_DEF = -2
    ERROR_ID = -3
    ERROR_MESH = -4
    ERROR_STATE = -5
    ERROR_MEMORY = -6
    DIVERGED = -7
    ERROR_LIMIT = -8
    ERROR_BUILD = -9
    ERROR_DATA = -10
    ERROR_REPLAY = -11


class BudgetLimit(_enum.IntEnum):
    """Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one
    allowance: using 30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget
    decides when a cut takes effect; the mesh, grid, regions, weights and sites of frames after all work is done
    do not depend on it (manual, budget)."""
    TRIANGLES = 16


class NoteLimit(_enum.IntEnum):
    BYTES = 1048576


class EventType(_enum.IntEnum):
    """Events since the start of the last tick that was not refused."""
    CUT_FINISHED = 1
    PIECE_OFF = 2
    FRAME_ADDED = 3
    DIVERGED = 4
    DEFERRED = 5
    PIN_BROKE = 6
    PIECE_DETACHED = 7
    SEAM_BROKE = 8
    TEAR_BEGAN = 9
    TEAR_ENDED = 10
    STRAINED = 11


class Stage(_enum.IntEnum):
    """The stages of a tick in their order."""
    CUT = 0
    GRID = 1
    REGIONS = 2
    SHAPE = 3
    SAMPLES = 4
    CONSTANTS = 5
    CONTACT = 6
    SOLVE = 7
    SKIN = 8
    COUNT = 9


class MaterialPreset(_enum.IntEnum):
    """Materials to start from; src/world/kiri_api_world.c has the sources. From SILK on: measured cloths
    (manual, sheets)"""
    PAPER = 0
    COTTON = 1
    RUBBER = 2
    FOIL = 3
    CARD = 4
    SILK = 5
    SHIRTING = 6
    WOOL = 7
    DENIM = 8
    JERSEY = 9
    COUNT = 10


class QualityPreset(_enum.IntEnum):
    """Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual,
    accuracy)."""
    FAST = 0
    BALANCED = 1
    ACCURATE = 2
    COUNT = 3


class SetupPreset(_enum.IntEnum):
    """Kinds of sheets to begin with. They want a tick of 1/60 s with 4 substeps; curtain and card do with 2."""
    CURTAIN = 0
    PAPER = 1
    FLAG = 2
    RIBBON = 3
    RUBBER = 4
    CARD = 5
    FOIL = 6
    COUNT = 7


class Model(_enum.IntEnum):
    """How a sheet deforms (manual, sheets). Rigid frames have 6 unknowns, affine ones 12."""
    LINKS = 0
    AFFINE = 1
    POINTS = 2


class Skinning(_enum.IntEnum):
    """The surface between the frames, which blades and contacts meet (manual, sheets)."""
    LINEAR = 0
    SMOOTH = 1


class TimeStepping(_enum.IntEnum):
    """Integration in time, with one linear system an iteration. Steps with contacts or new pins take backward
    Euler."""
    SECOND_ORDER = 0
    EULER = 1


class PinType(_enum.IntEnum):
    """The types of pins."""
    POINT = 0
    HINGE = 1
    CLAMP = 2


class ObstacleType(_enum.IntEnum):
    """A body that sheets touch: a floor, a ball, a crate of another engine. It moves on with its velocities
    alone: set pose and velocity before a tick, and apply the impulse of its state after it (manual, contact).
    Lengths: up to 1e6 m."""
    PLANE = 0
    SPHERE = 1
    CAPSULE = 2
    BOX = 3
    CYLINDER = 4
    PRISM = 5


class DrawFlag(_enum.IntFlag):
    """The things to draw."""
    TRIANGLES = 1
    EDGES = 2
    BORDERS = 4
    FRAMES = 8
    LINKS = 16
    PINS = 32
    CONTACTS = 64
    BLADES = 128
    BOXES = 256
    OBSTACLES = 512
    POINTS = 1024
    ALL = 2047


KIRI_OK = ResultCode.OK
KIRI_PENDING = ResultCode.PENDING
KIRI_ERROR_ARGUMENT = ResultCode.ERROR_ARGUMENT
KIRI_ERROR_DEF = ResultCode.ERROR_DEF
KIRI_ERROR_ID = ResultCode.ERROR_ID
KIRI_ERROR_MESH = ResultCode.ERROR_MESH
KIRI_ERROR_STATE = ResultCode.ERROR_STATE
KIRI_ERROR_MEMORY = ResultCode.ERROR_MEMORY
KIRI_DIVERGED = ResultCode.DIVERGED
KIRI_ERROR_LIMIT = ResultCode.ERROR_LIMIT
KIRI_ERROR_BUILD = ResultCode.ERROR_BUILD
KIRI_ERROR_DATA = ResultCode.ERROR_DATA
KIRI_ERROR_REPLAY = ResultCode.ERROR_REPLAY
KIRI_LEAST_TRIANGLES = BudgetLimit.TRIANGLES
KIRI_MOST_NOTE_BYTES = NoteLimit.BYTES
KIRI_EVENT_CUT_FINISHED = EventType.CUT_FINISHED
KIRI_EVENT_PIECE_OFF = EventType.PIECE_OFF
KIRI_EVENT_FRAME_ADDED = EventType.FRAME_ADDED
KIRI_EVENT_DIVERGED = EventType.DIVERGED
KIRI_EVENT_DEFERRED = EventType.DEFERRED
KIRI_EVENT_PIN_BROKE = EventType.PIN_BROKE
KIRI_EVENT_PIECE_DETACHED = EventType.PIECE_DETACHED
KIRI_EVENT_SEAM_BROKE = EventType.SEAM_BROKE
KIRI_EVENT_TEAR_BEGAN = EventType.TEAR_BEGAN
KIRI_EVENT_TEAR_ENDED = EventType.TEAR_ENDED
KIRI_EVENT_STRAINED = EventType.STRAINED
KIRI_STAGE_CUT = Stage.CUT
KIRI_STAGE_GRID = Stage.GRID
KIRI_STAGE_REGIONS = Stage.REGIONS
KIRI_STAGE_SHAPE = Stage.SHAPE
KIRI_STAGE_SAMPLES = Stage.SAMPLES
KIRI_STAGE_CONSTANTS = Stage.CONSTANTS
KIRI_STAGE_CONTACT = Stage.CONTACT
KIRI_STAGE_SOLVE = Stage.SOLVE
KIRI_STAGE_SKIN = Stage.SKIN
KIRI_STAGE_COUNT = Stage.COUNT
KIRI_MATERIAL_PAPER = MaterialPreset.PAPER
KIRI_MATERIAL_COTTON = MaterialPreset.COTTON
KIRI_MATERIAL_RUBBER = MaterialPreset.RUBBER
KIRI_MATERIAL_FOIL = MaterialPreset.FOIL
KIRI_MATERIAL_CARD = MaterialPreset.CARD
KIRI_MATERIAL_SILK = MaterialPreset.SILK
KIRI_MATERIAL_SHIRTING = MaterialPreset.SHIRTING
KIRI_MATERIAL_WOOL = MaterialPreset.WOOL
KIRI_MATERIAL_DENIM = MaterialPreset.DENIM
KIRI_MATERIAL_JERSEY = MaterialPreset.JERSEY
KIRI_MATERIAL_COUNT = MaterialPreset.COUNT
KIRI_QUALITY_FAST = QualityPreset.FAST
KIRI_QUALITY_BALANCED = QualityPreset.BALANCED
KIRI_QUALITY_ACCURATE = QualityPreset.ACCURATE
KIRI_QUALITY_COUNT = QualityPreset.COUNT
KIRI_SETUP_CURTAIN = SetupPreset.CURTAIN
KIRI_SETUP_PAPER = SetupPreset.PAPER
KIRI_SETUP_FLAG = SetupPreset.FLAG
KIRI_SETUP_RIBBON = SetupPreset.RIBBON
KIRI_SETUP_RUBBER = SetupPreset.RUBBER
KIRI_SETUP_CARD = SetupPreset.CARD
KIRI_SETUP_FOIL = SetupPreset.FOIL
KIRI_SETUP_COUNT = SetupPreset.COUNT
KIRI_MODEL_LINKS = Model.LINKS
KIRI_MODEL_AFFINE = Model.AFFINE
KIRI_MODEL_POINTS = Model.POINTS
KIRI_SKINNING_LINEAR = Skinning.LINEAR
KIRI_SKINNING_SMOOTH = Skinning.SMOOTH
KIRI_TIME_STEPPING_SECOND_ORDER = TimeStepping.SECOND_ORDER
KIRI_TIME_STEPPING_EULER = TimeStepping.EULER
KIRI_PIN_POINT = PinType.POINT
KIRI_PIN_HINGE = PinType.HINGE
KIRI_PIN_CLAMP = PinType.CLAMP
KIRI_OBSTACLE_PLANE = ObstacleType.PLANE
KIRI_OBSTACLE_SPHERE = ObstacleType.SPHERE
KIRI_OBSTACLE_CAPSULE = ObstacleType.CAPSULE
KIRI_OBSTACLE_BOX = ObstacleType.BOX
KIRI_OBSTACLE_CYLINDER = ObstacleType.CYLINDER
KIRI_OBSTACLE_PRISM = ObstacleType.PRISM
KIRI_DRAW_TRIANGLES = DrawFlag.TRIANGLES
KIRI_DRAW_EDGES = DrawFlag.EDGES
KIRI_DRAW_BORDERS = DrawFlag.BORDERS
KIRI_DRAW_FRAMES = DrawFlag.FRAMES
KIRI_DRAW_LINKS = DrawFlag.LINKS
KIRI_DRAW_PINS = DrawFlag.PINS
KIRI_DRAW_CONTACTS = DrawFlag.CONTACTS
KIRI_DRAW_BLADES = DrawFlag.BLADES
KIRI_DRAW_BOXES = DrawFlag.BOXES
KIRI_DRAW_OBSTACLES = DrawFlag.OBSTACLES
KIRI_DRAW_POINTS = DrawFlag.POINTS
KIRI_DRAW_ALL = DrawFlag.ALL
