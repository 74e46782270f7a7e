# Made from kiri.h by `make bindings`. Constants, and what needs no world:
# const Kiri = preload("res://addons/kiri/kiri.gd")
extends Reference

const Native = preload("kiri.gdns")
const World = preload("kiri_world.gdns")

const OK = 0
const PENDING = 1
const ERROR_ARGUMENT = -1
const ERROR_DEF = -2
const ERROR_ID = -3
const ERROR_MESH = -4
const ERROR_STATE = -5
const ERROR_MEMORY = -6
const DIVERGED = -7
const ERROR_LIMIT = -8
const ERROR_BUILD = -9
const ERROR_DATA = -10
const ERROR_REPLAY = -11
const LEAST_TRIANGLES = 16
const MOST_NOTE_BYTES = 1048576
const EVENT_CUT_FINISHED = 1
const EVENT_PIECE_OFF = 2
const EVENT_FRAME_ADDED = 3
const EVENT_DIVERGED = 4
const EVENT_DEFERRED = 5
const EVENT_PIN_BROKE = 6
const EVENT_PIECE_DETACHED = 7
const EVENT_SEAM_BROKE = 8
const EVENT_TEAR_BEGAN = 9
const EVENT_TEAR_ENDED = 10
const EVENT_STRAINED = 11
const STAGE_CUT = 0
const STAGE_GRID = 1
const STAGE_REGIONS = 2
const STAGE_SHAPE = 3
const STAGE_SAMPLES = 4
const STAGE_CONSTANTS = 5
const STAGE_CONTACT = 6
const STAGE_SOLVE = 7
const STAGE_SKIN = 8
const STAGE_COUNT = 9
const MATERIAL_PAPER = 0
const MATERIAL_COTTON = 1
const MATERIAL_RUBBER = 2
const MATERIAL_FOIL = 3
const MATERIAL_CARD = 4
const MATERIAL_SILK = 5
const MATERIAL_SHIRTING = 6
const MATERIAL_WOOL = 7
const MATERIAL_DENIM = 8
const MATERIAL_JERSEY = 9
const MATERIAL_COUNT = 10
const QUALITY_FAST = 0
const QUALITY_BALANCED = 1
const QUALITY_ACCURATE = 2
const QUALITY_COUNT = 3
const SETUP_CURTAIN = 0
const SETUP_PAPER = 1
const SETUP_FLAG = 2
const SETUP_RIBBON = 3
const SETUP_RUBBER = 4
const SETUP_CARD = 5
const SETUP_FOIL = 6
const SETUP_COUNT = 7
const MODEL_LINKS = 0
const MODEL_AFFINE = 1
const MODEL_POINTS = 2
const SKINNING_LINEAR = 0
const SKINNING_SMOOTH = 1
const TIME_STEPPING_SECOND_ORDER = 0
const TIME_STEPPING_EULER = 1
const PIN_POINT = 0
const PIN_HINGE = 1
const PIN_CLAMP = 2
const OBSTACLE_PLANE = 0
const OBSTACLE_SPHERE = 1
const OBSTACLE_CAPSULE = 2
const OBSTACLE_BOX = 3
const OBSTACLE_CYLINDER = 4
const OBSTACLE_PRISM = 5
const DRAW_TRIANGLES = 1
const DRAW_EDGES = 2
const DRAW_BORDERS = 4
const DRAW_FRAMES = 8
const DRAW_LINKS = 16
const DRAW_PINS = 32
const DRAW_CONTACTS = 64
const DRAW_BLADES = 128
const DRAW_BOXES = 256
const DRAW_OBSTACLES = 512
const DRAW_POINTS = 1024
const DRAW_ALL = 2047

static func get_version():
	return Native.new().get_version()

static func get_result_name(result):
	return Native.new().get_result_name(result)

static func get_result_text(result):
	return Native.new().get_result_text(result)

static func default_world_def():
	return Native.new().default_world_def()

static func create_world(def = {}):
	return Native.new().create_world(def)

static func fit_budget(profile, microseconds, budget):
	return Native.new().fit_budget(profile, microseconds, budget)

static func get_stage_name(stage):
	return Native.new().get_stage_name(stage)

static func get_material(preset):
	return Native.new().get_material(preset)

static func get_quality(preset):
	return Native.new().get_quality(preset)

static func default_sheet_def():
	return Native.new().default_sheet_def()

static func get_setup(preset, width, height):
	return Native.new().get_setup(preset, width, height)

static func fill_rectangle(width, height, columns, rows):
	return Native.new().fill_rectangle(width, height, columns, rows)

static func get_tearing(preset):
	return Native.new().get_tearing(preset)

static func default_pin_def():
	return Native.new().default_pin_def()

static func default_seam_def():
	return Native.new().default_seam_def()

static func default_obstacle_def():
	return Native.new().default_obstacle_def()

static func default_debug_draw():
	return Native.new().default_debug_draw()
