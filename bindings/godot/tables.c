/* Made from kiri.h by `make bindings`. */
#include "objects.h"

#include <stddef.h>

/* clang-format off */
const char* const CLASS_NAMES[CLASS_COUNT] = { "", "Kiri", "KiriWorld", "KiriSheet", "KiriCut", "KiriFrame", "KiriPin", "KiriObstacle", "KiriBlade", "KiriSeam" };

/* ---- Structs ---- */

static const Field BUDGET_FIELDS[] = {
    { "triangles", TYPE_INT32, KIND_INT, (int)offsetof(kiriBudget, triangles), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "cells", TYPE_INT32, KIND_INT, (int)offsetof(kiriBudget, cells), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "samples", TYPE_INT32, KIND_INT, (int)offsetof(kiriBudget, samples), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "iterations", TYPE_INT32, KIND_INT, (int)offsetof(kiriBudget, iterations), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct BUDGET = { "Budget", SIZE_OF(kiriBudget), 4, BUDGET_FIELDS, NULL, NULL };

static const Field WORLD_DEF_FIELDS[] = {
    { "gravity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriWorldDef, gravity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "budget", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriWorldDef, budget), 1, 0, 0, 0, CLASS_NONE, &BUDGET },
    { "worker_count", TYPE_INT32, KIND_INT, (int)offsetof(kiriWorldDef, workerCount), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "record_hash_ticks", TYPE_INT32, KIND_INT, (int)offsetof(kiriWorldDef, recordHashTicks), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "record", TYPE_FLAG, KIND_BOOL, (int)offsetof(HostDef, record), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "clock", TYPE_FLAG, KIND_BOOL, (int)offsetof(HostDef, clock), 1, 0, 0, 0, CLASS_NONE, NULL },
};

const Struct WORLD_DEF = { "WorldDef", SIZE_OF(HostDef), 6, WORLD_DEF_FIELDS, FillWorldDef, NULL };

static const Field REPLAY_FIELDS[] = {
    { "offset", TYPE_INT64, KIND_INT, (int)offsetof(kiriReplay, offset), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "calls", TYPE_INT64, KIND_INT, (int)offsetof(kiriReplay, calls), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "ticks", TYPE_INT64, KIND_INT, (int)offsetof(kiriReplay, ticks), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "note", TYPE_BYTE, KIND_BYTES, (int)offsetof(kiriReplay, note), 1, (int)offsetof(kiriReplay, noteCount), 1, 1, CLASS_NONE, NULL },
};

static const Struct REPLAY = { "Replay", SIZE_OF(kiriReplay), 4, REPLAY_FIELDS, NULL, NULL };

/* Fields of events, by type. */
static const uint32_t EVENT_MASKS[] = { 0x1, 0x7, 0x6b, 0xb, 0x3, 0x183, 0x13, 0x4b, 0x603, 0x7, 0x7, 0x43 };

static const Field EVENT_FIELDS[] = {
    { "type", TYPE_INT32, KIND_INT, (int)offsetof(kiriEvent, type), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "sheet", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriEvent, sheet), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "cut", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriEvent, cut), 1, 0, 0, 0, CLASS_CUT, NULL },
    { "frame", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriEvent, frame), 1, 0, 0, 0, CLASS_FRAME, NULL },
    { "pin", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriEvent, pin), 1, 0, 0, 0, CLASS_PIN, NULL },
    { "crumb", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriEvent, crumb), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "area", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriEvent, area), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "stage", TYPE_INT32, KIND_INT, (int)offsetof(kiriEvent, stage), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "waiting", TYPE_INT32, KIND_INT, (int)offsetof(kiriEvent, waiting), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "seam", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriEvent, seam), 1, 0, 0, 0, CLASS_SEAM, NULL },
    { "stitches", TYPE_INT32, KIND_INT, (int)offsetof(kiriEvent, stitches), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct EVENT = { "Event", SIZE_OF(kiriEvent), 11, EVENT_FIELDS, NULL, EVENT_MASKS };

static const Field PROFILE_FIELDS[] = {
    { "seconds", TYPE_DOUBLE, KIND_FLOATS, (int)offsetof(kiriProfile, seconds), 9, 0, 0, 0, CLASS_NONE, NULL },
    { "cut_segments", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, cutSegments), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "triangles_split", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, trianglesSplit), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "cells_settled", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, cellsSettled), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "samples_refreshed", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, samplesRefreshed), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "solver_iterations", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, solverIterations), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "cells_changed", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, cellsChanged), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "weights_changed", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, weightsChanged), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "vertices_changed", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, verticesChanged), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "points_changed", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, pointsChanged), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "links_changed", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, linksChanged), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "commits", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, commits), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "systems_solved", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, systemsSolved), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "contacts", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, contacts), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "sheet_pairs", TYPE_INT32, KIND_INT, (int)offsetof(kiriProfile, sheetPairs), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "largest_jump", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriProfile, largestJump), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "largest_fade", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriProfile, largestFade), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct PROFILE = { "Profile", SIZE_OF(kiriProfile), 17, PROFILE_FIELDS, NULL, NULL };

static const Field MATERIAL_FIELDS[] = {
    { "youngs_modulus", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, youngsModulus), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "poissons_ratio", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, poissonsRatio), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "thickness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, thickness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "density", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, density), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "air_damping", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, airDamping), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "flex_damping", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, flexDamping), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "yield_stress", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, yieldStress), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "hardening", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, hardening), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "slack", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriMaterial, slack), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "detail", TYPE_INT32, KIND_INT, (int)offsetof(kiriMaterial, detail), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "rest_curvature", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriMaterial, restCurvature), 3, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct MATERIAL = { "Material", SIZE_OF(kiriMaterial), 11, MATERIAL_FIELDS, NULL, NULL };

static const Field QUALITY_FIELDS[] = {
    { "frames_along", TYPE_INT32, KIND_INT, (int)offsetof(kiriQuality, framesAlong), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "grid_resolution", TYPE_INT32, KIND_INT, (int)offsetof(kiriQuality, gridResolution), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "iterations", TYPE_INT32, KIND_INT, (int)offsetof(kiriQuality, iterations), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "substeps", TYPE_INT32, KIND_INT, (int)offsetof(kiriQuality, substeps), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct QUALITY = { "Quality", SIZE_OF(kiriQuality), 4, QUALITY_FIELDS, NULL, NULL };

static const Field PAPER_OPTIONS_FIELDS[] = {
    { "from_scratch", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriPaperOptions, fromScratch), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "popping", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriPaperOptions, popping), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "linear_weights", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriPaperOptions, linearWeights), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "integration_points", TYPE_INT32, KIND_INT, (int)offsetof(kiriPaperOptions, integrationPoints), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "integration_order", TYPE_INT32, KIND_INT, (int)offsetof(kiriPaperOptions, integrationOrder), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct PAPER_OPTIONS = { "PaperOptions", SIZE_OF(kiriPaperOptions), 5, PAPER_OPTIONS_FIELDS, NULL, NULL };

static void FillSheetDef(void* filled)
{
    kiriDefaultSheetDef(filled);
}

static const Field SHEET_DEF_FIELDS[] = {
    { "rest_positions", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriSheetDef, restPositions), 1, (int)offsetof(kiriSheetDef, vertexCount), 2, 0, CLASS_NONE, NULL },
    { "indices", TYPE_INT32, KIND_INTS, (int)offsetof(kiriSheetDef, indices), 1, (int)offsetof(kiriSheetDef, triangleCount), 3, 0, CLASS_NONE, NULL },
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriSheetDef, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "axis_u", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriSheetDef, axisU), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "axis_v", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriSheetDef, axisV), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriSheetDef, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "material", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriSheetDef, material), 1, 0, 0, 0, CLASS_NONE, &MATERIAL },
    { "grid_resolution", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, gridResolution), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "snap_distance", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, snapDistance), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "weld_distance", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, weldDistance), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "frame_count", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, frameCount), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "frame_length", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, frameLength), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "accuracy", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, accuracy), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "frame_points", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriSheetDef, framePoints), 1, (int)offsetof(kiriSheetDef, frameCount), 2, 1, CLASS_NONE, NULL },
    { "max_frames", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, maxFrames), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "rigid_weight", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, rigidWeight), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "rigid_area", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, rigidArea), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "crumb_area", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, crumbArea), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "friction", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, friction), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "contact_thickness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, contactThickness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "groups", TYPE_UINT32, KIND_INT, (int)offsetof(kiriSheetDef, groups), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "touches_sheets", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetDef, touchesSheets), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "self_contact", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetDef, selfContact), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "collision_points", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, collisionPoints), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "iterations", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, iterations), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "sleep_speed", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, sleepSpeed), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "model", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, model), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "skinning", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, skinning), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "planar", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetDef, planar), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "time_stepping", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetDef, timeStepping), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "fade_time", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetDef, fadeTime), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "normals", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetDef, normals), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "paper", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriSheetDef, paper), 1, 0, 0, 0, CLASS_NONE, &PAPER_OPTIONS },
};

static const Struct SHEET_DEF = { "SheetDef", SIZE_OF(kiriSheetDef), 33, SHEET_DEF_FIELDS, FillSheetDef, NULL };

static const Field SHEET_SETTINGS_FIELDS[] = {
    { "material", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriSheetSettings, material), 1, 0, 0, 0, CLASS_NONE, &MATERIAL },
    { "max_frames", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetSettings, maxFrames), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "crumb_area", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetSettings, crumbArea), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "friction", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetSettings, friction), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "contact_thickness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetSettings, contactThickness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "groups", TYPE_UINT32, KIND_INT, (int)offsetof(kiriSheetSettings, groups), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "touches_sheets", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetSettings, touchesSheets), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "self_contact", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetSettings, selfContact), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "iterations", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetSettings, iterations), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "sleep_speed", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetSettings, sleepSpeed), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "skinning", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetSettings, skinning), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "time_stepping", TYPE_INT32, KIND_INT, (int)offsetof(kiriSheetSettings, timeStepping), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "fade_time", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSheetSettings, fadeTime), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "normals", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriSheetSettings, normals), 1, 0, 0, 0, CLASS_NONE, NULL },
};

const Struct SHEET_SETTINGS = { "SheetSettings", SIZE_OF(kiriSheetSettings), 14, SHEET_SETTINGS_FIELDS, NULL, NULL };

static const Field FOLD_FIELDS[] = {
    { "from", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriFold, from), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "to", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriFold, to), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "stiffness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriFold, stiffness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "rest_angle", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriFold, restAngle), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "yield_moment", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriFold, yieldMoment), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct FOLD = { "Fold", SIZE_OF(kiriFold), 5, FOLD_FIELDS, NULL, NULL };

static const Field FOLD_STATE_FIELDS[] = {
    { "fold", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriFoldState, fold), 1, 0, 0, 0, CLASS_NONE, &FOLD },
    { "angle", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriFoldState, angle), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "length", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriFoldState, length), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct FOLD_STATE = { "FoldState", SIZE_OF(kiriFoldState), 3, FOLD_STATE_FIELDS, NULL, NULL };

static const Field MESH_FIELDS[] = {
    { "positions", TYPE_FLOAT, KIND_VECTORS3, (int)offsetof(kiriMesh, positions), 1, (int)offsetof(kiriMesh, vertexCount), 3, 0, CLASS_NONE, NULL },
    { "normals", TYPE_FLOAT, KIND_VECTORS3, (int)offsetof(kiriMesh, normals), 1, (int)offsetof(kiriMesh, vertexCount), 3, 1, CLASS_NONE, NULL },
    { "rest_positions", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriMesh, restPositions), 1, (int)offsetof(kiriMesh, vertexCount), 2, 0, CLASS_NONE, NULL },
    { "indices", TYPE_INT32, KIND_INTS, (int)offsetof(kiriMesh, indices), 1, (int)offsetof(kiriMesh, triangleCount), 3, 0, CLASS_NONE, NULL },
    { "source_triangles", TYPE_INT32, KIND_INTS, (int)offsetof(kiriMesh, sourceTriangles), 1, (int)offsetof(kiriMesh, vertexCount), 1, 0, CLASS_NONE, NULL },
    { "source_weights", TYPE_FLOAT, KIND_VECTORS3, (int)offsetof(kiriMesh, sourceWeights), 1, (int)offsetof(kiriMesh, vertexCount), 3, 0, CLASS_NONE, NULL },
    { "revision", TYPE_UINT32, KIND_INT, (int)offsetof(kiriMesh, revision), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct MESH = { "Mesh", SIZE_OF(kiriMesh), 7, MESH_FIELDS, NULL, NULL };

static const Field RANGE_FIELDS[] = {
    { "first", TYPE_INT32, KIND_INT, (int)offsetof(kiriRange, first), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "count", TYPE_INT32, KIND_INT, (int)offsetof(kiriRange, count), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct RANGE = { "Range", SIZE_OF(kiriRange), 2, RANGE_FIELDS, NULL, NULL };

static const Field DIRTY_FIELDS[] = {
    { "new_vertices", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriDirty, newVertices), 1, 0, 0, 0, CLASS_NONE, &RANGE },
    { "new_triangles", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriDirty, newTriangles), 1, 0, 0, 0, CLASS_NONE, &RANGE },
    { "old_vertices", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriDirty, oldVertices), 1, 0, 0, 0, CLASS_NONE, &RANGE },
    { "old_triangles", TYPE_STRUCT, KIND_DICTIONARY, (int)offsetof(kiriDirty, oldTriangles), 1, 0, 0, 0, CLASS_NONE, &RANGE },
    { "revision", TYPE_UINT32, KIND_INT, (int)offsetof(kiriDirty, revision), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct DIRTY = { "Dirty", SIZE_OF(kiriDirty), 5, DIRTY_FIELDS, NULL, NULL };

static const Field SOLID_FIELDS[] = {
    { "positions", TYPE_FLOAT, KIND_VECTORS3, (int)offsetof(kiriSolid, positions), 1, (int)offsetof(kiriSolid, vertexCount), 3, 0, CLASS_NONE, NULL },
    { "normals", TYPE_FLOAT, KIND_VECTORS3, (int)offsetof(kiriSolid, normals), 1, (int)offsetof(kiriSolid, vertexCount), 3, 0, CLASS_NONE, NULL },
    { "rest_positions", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriSolid, restPositions), 1, (int)offsetof(kiriSolid, vertexCount), 2, 0, CLASS_NONE, NULL },
    { "indices", TYPE_INT32, KIND_INTS, (int)offsetof(kiriSolid, indices), 1, (int)offsetof(kiriSolid, triangleCount), 3, 0, CLASS_NONE, NULL },
    { "sources", TYPE_INT32, KIND_INTS, (int)offsetof(kiriSolid, sources), 1, (int)offsetof(kiriSolid, vertexCount), 1, 0, CLASS_NONE, NULL },
    { "rim_triangle", TYPE_INT32, KIND_INT, (int)offsetof(kiriSolid, rimTriangle), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct SOLID = { "Solid", SIZE_OF(kiriSolid), 6, SOLID_FIELDS, NULL, NULL };

static const Field COUNTS_FIELDS[] = {
    { "vertices", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, vertices), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "triangles", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, triangles), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "cells", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, cells), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "frames", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, frames), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "links", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, links), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "pieces", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, pieces), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "collision_points", TYPE_INT32, KIND_INT, (int)offsetof(kiriCounts, collisionPoints), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct COUNTS = { "Counts", SIZE_OF(kiriCounts), 7, COUNTS_FIELDS, NULL, NULL };

static const Field TOTALS_FIELDS[] = {
    { "area", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriTotals, area), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "mass", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriTotals, mass), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "kinetic_energy", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriTotals, kineticEnergy), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "elastic_energy", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriTotals, elasticEnergy), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "center", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriTotals, center), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "momentum", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriTotals, momentum), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angular_momentum", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriTotals, angularMomentum), 3, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct TOTALS = { "Totals", SIZE_OF(kiriTotals), 7, TOTALS_FIELDS, NULL, NULL };

static const Field HIT_FIELDS[] = {
    { "rest_point", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriHit, restPoint), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriHit, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "normal", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriHit, normal), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "distance", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriHit, distance), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "triangle", TYPE_INT32, KIND_INT, (int)offsetof(kiriHit, triangle), 1, 0, 0, 0, CLASS_NONE, NULL },
};

const Struct HIT = { "Hit", SIZE_OF(kiriHit), 5, HIT_FIELDS, NULL, NULL };

static const Field POINT_STATE_FIELDS[] = {
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPointState, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "normal", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPointState, normal), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPointState, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "frame", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriPointState, frame), 1, 0, 0, 0, CLASS_FRAME, NULL },
};

static const Struct POINT_STATE = { "PointState", SIZE_OF(kiriPointState), 4, POINT_STATE_FIELDS, NULL, NULL };

static const Field PIECE_STATE_FIELDS[] = {
    { "area", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriPieceState, area), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "mass", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriPieceState, mass), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "center", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriPieceState, center), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "momentum", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriPieceState, momentum), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angular_momentum", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriPieceState, angularMomentum), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "lower", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPieceState, lower), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "upper", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPieceState, upper), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "frames", TYPE_INT32, KIND_INT, (int)offsetof(kiriPieceState, frames), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "vertices", TYPE_INT32, KIND_INT, (int)offsetof(kiriPieceState, vertices), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "triangles", TYPE_INT32, KIND_INT, (int)offsetof(kiriPieceState, triangles), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "collision_points", TYPE_INT32, KIND_INT, (int)offsetof(kiriPieceState, collisionPoints), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "crumb", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriPieceState, crumb), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "asleep", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriPieceState, asleep), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct PIECE_STATE = { "PieceState", SIZE_OF(kiriPieceState), 13, PIECE_STATE_FIELDS, NULL, NULL };

static const Field PIECE_MESH_FIELDS[] = {
    { "vertices", TYPE_INT32, KIND_INTS, (int)offsetof(kiriPieceMesh, vertices), 1, (int)offsetof(kiriPieceMesh, vertexCount), 1, 0, CLASS_NONE, NULL },
    { "triangles", TYPE_INT32, KIND_INTS, (int)offsetof(kiriPieceMesh, triangles), 1, (int)offsetof(kiriPieceMesh, triangleCount), 1, 0, CLASS_NONE, NULL },
    { "indices", TYPE_INT32, KIND_INTS, (int)offsetof(kiriPieceMesh, indices), 1, (int)offsetof(kiriPieceMesh, triangleCount), 3, 0, CLASS_NONE, NULL },
    { "collision_points", TYPE_INT32, KIND_INTS, (int)offsetof(kiriPieceMesh, collisionPoints), 1, (int)offsetof(kiriPieceMesh, collisionPointCount), 1, 0, CLASS_NONE, NULL },
};

static const Struct PIECE_MESH = { "PieceMesh", SIZE_OF(kiriPieceMesh), 4, PIECE_MESH_FIELDS, NULL, NULL };

static const Field TEARING_FIELDS[] = {
    { "toughness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriTearing, toughness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "strength", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriTearing, strength), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "grain", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriTearing, grain), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "grain_ratio", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriTearing, grainRatio), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "max_speed", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriTearing, maxSpeed), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "max_tips", TYPE_INT32, KIND_INT, (int)offsetof(kiriTearing, maxTips), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct TEARING = { "Tearing", SIZE_OF(kiriTearing), 6, TEARING_FIELDS, NULL, NULL };

static const Field FRAME_STATE_FIELDS[] = {
    { "rest_point", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriFrameState, restPoint), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriFrameState, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "rotation", TYPE_FLOAT, KIND_BASIS, (int)offsetof(kiriFrameState, rotation), 9, 0, 0, 0, CLASS_NONE, NULL },
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriFrameState, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angular_velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriFrameState, angularVelocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "area", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriFrameState, area), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "mass", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriFrameState, mass), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "held", TYPE_FLAG, KIND_BOOL, (int)offsetof(kiriFrameState, held), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct FRAME_STATE = { "FrameState", SIZE_OF(kiriFrameState), 8, FRAME_STATE_FIELDS, NULL, NULL };

static const Field WIND_FIELDS[] = {
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriWind, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "density", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriWind, density), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "drag", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriWind, drag), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "lift", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriWind, lift), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct WIND = { "Wind", SIZE_OF(kiriWind), 4, WIND_FIELDS, NULL, NULL };

static void FillPinDef(void* filled)
{
    kiriDefaultPinDef(filled);
}

static const Field PIN_DEF_FIELDS[] = {
    { "rest_point", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriPinDef, restPoint), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "target", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPinDef, target), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "stiffness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriPinDef, stiffness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "break_force", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriPinDef, breakForce), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "obstacle", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriPinDef, obstacle), 1, 0, 0, 0, CLASS_OBSTACLE, NULL },
};

static const Struct PIN_DEF = { "PinDef", SIZE_OF(kiriPinDef), 5, PIN_DEF_FIELDS, FillPinDef, NULL };

static const Field PIN_STATE_FIELDS[] = {
    { "type", TYPE_INT32, KIND_INT, (int)offsetof(kiriPinState, type), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "sheet", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriPinState, sheet), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "from", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriPinState, from), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "to", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriPinState, to), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "target", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriPinState, target), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "rotation", TYPE_FLOAT, KIND_BASIS, (int)offsetof(kiriPinState, rotation), 9, 0, 0, 0, CLASS_NONE, NULL },
    { "break_force", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriPinState, breakForce), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "obstacle", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriPinState, obstacle), 1, 0, 0, 0, CLASS_OBSTACLE, NULL },
};

static const Struct PIN_STATE = { "PinState", SIZE_OF(kiriPinState), 8, PIN_STATE_FIELDS, NULL, NULL };

static void FillSeamDef(void* filled)
{
    kiriDefaultSeamDef(filled);
}

static const Field SEAM_DEF_FIELDS[] = {
    { "sheet_a", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriSeamDef, sheetA), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "sheet_b", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriSeamDef, sheetB), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "line_a", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriSeamDef, lineA), 1, (int)offsetof(kiriSeamDef, countA), 2, 0, CLASS_NONE, NULL },
    { "line_b", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriSeamDef, lineB), 1, (int)offsetof(kiriSeamDef, countB), 2, 0, CLASS_NONE, NULL },
    { "stitches", TYPE_INT32, KIND_INT, (int)offsetof(kiriSeamDef, stitches), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "stiffness", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSeamDef, stiffness), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "rest_angle", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSeamDef, restAngle), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "break_force", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriSeamDef, breakForce), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct SEAM_DEF = { "SeamDef", SIZE_OF(kiriSeamDef), 8, SEAM_DEF_FIELDS, FillSeamDef, NULL };

static const Field STITCH_FIELDS[] = {
    { "sheet_a", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriStitch, sheetA), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "sheet_b", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriStitch, sheetB), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "rest_a", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriStitch, restA), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "rest_b", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriStitch, restB), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriStitch, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "gap", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriStitch, gap), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "force", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriStitch, force), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angle", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriStitch, angle), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct STITCH = { "Stitch", SIZE_OF(kiriStitch), 8, STITCH_FIELDS, NULL, NULL };

static const Field CONTACT_FIELDS[] = {
    { "point", TYPE_INT32, KIND_INT, (int)offsetof(kiriContact, point), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "rest_point", TYPE_FLOAT, KIND_VECTOR2, (int)offsetof(kiriContact, restPoint), 2, 0, 0, 0, CLASS_NONE, NULL },
    { "normal", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriContact, normal), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "offset", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriContact, offset), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriContact, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "friction", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriContact, friction), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "inverse_mass", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriContact, inverseMass), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "push_speed", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriContact, pushSpeed), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "obstacle", TYPE_INT32, KIND_INT, (int)offsetof(kiriContact, obstacle), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct CONTACT = { "Contact", SIZE_OF(kiriContact), 9, CONTACT_FIELDS, NULL, NULL };

static const Field CONTACT_FORCE_FIELDS[] = {
    { "impulse", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriContactForce, impulse), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "position", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriContactForce, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "depth", TYPE_DOUBLE, KIND_REAL, (int)offsetof(kiriContactForce, depth), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "point", TYPE_INT32, KIND_INT, (int)offsetof(kiriContactForce, point), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "obstacle", TYPE_INT32, KIND_INT, (int)offsetof(kiriContactForce, obstacle), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct CONTACT_FORCE = { "ContactForce", SIZE_OF(kiriContactForce), 5, CONTACT_FORCE_FIELDS, NULL, NULL };

static void FillObstacleDef(void* filled)
{
    kiriDefaultObstacleDef(filled);
}

static const Field OBSTACLE_DEF_FIELDS[] = {
    { "type", TYPE_INT32, KIND_INT, (int)offsetof(kiriObstacleDef, type), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "size", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleDef, size), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "radius", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriObstacleDef, radius), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "height", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriObstacleDef, height), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "outline", TYPE_FLOAT, KIND_VECTORS2, (int)offsetof(kiriObstacleDef, outline), 1, (int)offsetof(kiriObstacleDef, outlineCount), 2, 1, CLASS_NONE, NULL },
    { "rounding", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriObstacleDef, rounding), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleDef, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "rotation", TYPE_FLOAT, KIND_BASIS, (int)offsetof(kiriObstacleDef, rotation), 9, 0, 0, 0, CLASS_NONE, NULL },
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleDef, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angular_velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleDef, angularVelocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "surface_velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleDef, surfaceVelocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "friction", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriObstacleDef, friction), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "mass", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriObstacleDef, mass), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "inertia", TYPE_FLOAT, KIND_FLOATS, (int)offsetof(kiriObstacleDef, inertia), 6, 0, 0, 0, CLASS_NONE, NULL },
    { "center_of_mass", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleDef, centerOfMass), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "body", TYPE_UINT32, KIND_INT, (int)offsetof(kiriObstacleDef, body), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "push_speed", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriObstacleDef, pushSpeed), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "groups", TYPE_UINT32, KIND_INT, (int)offsetof(kiriObstacleDef, groups), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct OBSTACLE_DEF = { "ObstacleDef", SIZE_OF(kiriObstacleDef), 18, OBSTACLE_DEF_FIELDS, FillObstacleDef, NULL };

static const Field OBSTACLE_STATE_FIELDS[] = {
    { "position", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleState, position), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "rotation", TYPE_FLOAT, KIND_BASIS, (int)offsetof(kiriObstacleState, rotation), 9, 0, 0, 0, CLASS_NONE, NULL },
    { "velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleState, velocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angular_velocity", TYPE_FLOAT, KIND_VECTOR3, (int)offsetof(kiriObstacleState, angularVelocity), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "impulse", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriObstacleState, impulse), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "angular_impulse", TYPE_DOUBLE, KIND_VECTOR3, (int)offsetof(kiriObstacleState, angularImpulse), 3, 0, 0, 0, CLASS_NONE, NULL },
    { "contacts", TYPE_INT32, KIND_INT, (int)offsetof(kiriObstacleState, contacts), 1, 0, 0, 0, CLASS_NONE, NULL },
};

static const Struct OBSTACLE_STATE = { "ObstacleState", SIZE_OF(kiriObstacleState), 7, OBSTACLE_STATE_FIELDS, NULL, NULL };

static void FillDebugDraw(void* filled)
{
    kiriDefaultDebugDraw(filled);
}

static const Field DEBUG_DRAW_FIELDS[] = {
    { "flags", TYPE_UINT32, KIND_INT, (int)offsetof(kiriDebugDraw, flags), 1, 0, 0, 0, CLASS_NONE, NULL },
    { "sheet", TYPE_ID, KIND_OBJECT, (int)offsetof(kiriDebugDraw, sheet), 1, 0, 0, 0, CLASS_SHEET, NULL },
    { "size", TYPE_FLOAT, KIND_REAL, (int)offsetof(kiriDebugDraw, size), 1, 0, 0, 0, CLASS_NONE, NULL },
};

const Struct DEBUG_DRAW = { "DebugDraw", SIZE_OF(kiriDebugDraw), 3, DEBUG_DRAW_FIELDS, FillDebugDraw, NULL };

/* ---- Methods ---- */

static int64_t Call_kiriGetVersion(void* const* a)
{
    (void)a;
    return kiriGetVersion();
}

static const Argument KIRI_GET_RESULT_NAME_ARGUMENTS[] = {
    { "result", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriGetResultName(void* const* a)
{
    *(const char**)a[1] = kiriGetResultName(*(kiriResult*)a[0]);
    return 0;
}

static const Parameter KIRI_GET_RESULT_NAME_PARAMETERS[] = {
    { "result", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument KIRI_GET_RESULT_TEXT_ARGUMENTS[] = {
    { "result", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriGetResultText(void* const* a)
{
    *(const char**)a[1] = kiriGetResultText(*(kiriResult*)a[0]);
    return 0;
}

static const Parameter KIRI_GET_RESULT_TEXT_PARAMETERS[] = {
    { "result", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriDefaultWorldDef(void* const* a)
{
    FillWorldDef(a[0]);
    return 0;
}

static const Parameter KIRI_DEFAULT_WORLD_DEF_PARAMETERS[] = {
    { "def", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 1, CLASS_NONE, &WORLD_DEF, NULL },
};

static const Argument KIRI_CREATE_WORLD_ARGUMENTS[] = {
    { "def", KIND_DICTIONARY, CLASS_NONE },
};

static const Argument WORLD_TICK_ARGUMENTS[] = {
    { "dt", KIND_REAL, CLASS_NONE },
    { "substeps", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriWorld_Tick(void* const* a)
{
    return kiriWorld_Tick(a[0], *(float*)a[1], *(int32_t*)a[2]);
}

static const Parameter WORLD_TICK_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "dt", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "substeps", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_GetLastError(void* const* a)
{
    *(const char**)a[1] = kiriWorld_GetLastError(a[0]);
    return 0;
}

static const Parameter WORLD_GET_LAST_ERROR_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_SHIFT_ORIGIN_ARGUMENTS[] = {
    { "origin", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriWorld_ShiftOrigin(void* const* a)
{
    return kiriWorld_ShiftOrigin(a[0], a[1]);
}

static const Parameter WORLD_SHIFT_ORIGIN_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "origin", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_SET_GRAVITY_ARGUMENTS[] = {
    { "gravity", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriWorld_SetGravity(void* const* a)
{
    return kiriWorld_SetGravity(a[0], a[1]);
}

static const Parameter WORLD_SET_GRAVITY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "gravity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_SET_BUDGET_ARGUMENTS[] = {
    { "budget", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriWorld_SetBudget(void* const* a)
{
    return kiriWorld_SetBudget(a[0], a[1]);
}

static const Parameter WORLD_SET_BUDGET_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "budget", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &BUDGET, NULL },
};

static int64_t Call_kiriWorld_GetStateHash(void* const* a)
{
    return kiriWorld_GetStateHash(a[0], a[1]);
}

static const Parameter WORLD_GET_STATE_HASH_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "hash", FORM_OUT, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_GetSheets(void* const* a)
{
    return kiriWorld_GetSheets(a[0], a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter WORLD_GET_SHEETS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheets", FORM_OUT_LIST, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_SHEET, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_NOTE_ARGUMENTS[] = {
    { "bytes", KIND_BYTES, CLASS_NONE },
};

static int64_t Call_kiriWorld_Note(void* const* a)
{
    return kiriWorld_Note(a[0], a[1], *(int32_t*)a[2]);
}

static const Parameter WORLD_NOTE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "bytes", FORM_IN_ROWS, TYPE_BYTE, KIND_BYTES, 1, 2, 1, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_REPLAY_ARGUMENTS[] = {
    { "recording", KIND_BYTES, CLASS_NONE },
    { "replay", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriWorld_Replay(void* const* a)
{
    return kiriWorld_Replay(a[0], a[1], *(int64_t*)a[2], a[3]);
}

static const Parameter WORLD_REPLAY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "recording", FORM_IN_ROWS, TYPE_BYTE, KIND_BYTES, 1, 2, 1, 0, CLASS_NONE, NULL, NULL },
    { "size", FORM_IN_COUNT, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "replay", FORM_INOUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &REPLAY, NULL },
};

static int64_t Call_kiriWorld_Save(void* const* a)
{
    return kiriWorld_Save(a[0], a[1], *(int64_t*)a[2], a[3]);
}

static const Parameter WORLD_SAVE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "bytes", FORM_OUT_LIST, TYPE_BYTE, KIND_BYTES, 1, 0, 1, 1, CLASS_NONE, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "size", FORM_OUT_COUNT, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_FinishCuts(void* const* a)
{
    return kiriWorld_FinishCuts(a[0]);
}

static const Parameter WORLD_FINISH_CUTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_LOAD_ARGUMENTS[] = {
    { "bytes", KIND_BYTES, CLASS_NONE },
};

static int64_t Call_kiriWorld_Load(void* const* a)
{
    return kiriWorld_Load(a[0], a[1], *(int64_t*)a[2]);
}

static const Parameter WORLD_LOAD_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "bytes", FORM_IN_ROWS, TYPE_BYTE, KIND_BYTES, 1, 2, 1, 0, CLASS_NONE, NULL, NULL },
    { "size", FORM_IN_COUNT, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_Snapshot(void* const* a)
{
    return kiriWorld_Snapshot(a[0], a[1], *(int64_t*)a[2], a[3]);
}

static const Parameter WORLD_SNAPSHOT_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "bytes", FORM_OUT_LIST, TYPE_BYTE, KIND_BYTES, 1, 0, 1, 1, CLASS_NONE, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "size", FORM_OUT_COUNT, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_RESTORE_ARGUMENTS[] = {
    { "bytes", KIND_BYTES, CLASS_NONE },
};

static int64_t Call_kiriWorld_Restore(void* const* a)
{
    return kiriWorld_Restore(a[0], a[1], *(int64_t*)a[2]);
}

static const Parameter WORLD_RESTORE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "bytes", FORM_IN_ROWS, TYPE_BYTE, KIND_BYTES, 1, 2, 1, 0, CLASS_NONE, NULL, NULL },
    { "size", FORM_IN_COUNT, TYPE_INT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_GetEvents(void* const* a)
{
    return kiriWorld_GetEvents(a[0], a[1], a[2]);
}

static const Parameter WORLD_GET_EVENTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "events", FORM_OUT_VIEW, TYPE_STRUCT, KIND_ARRAY, 1, 0, 1, 0, CLASS_NONE, &EVENT, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_GetProfile(void* const* a)
{
    return kiriWorld_GetProfile(a[0], a[1]);
}

static const Parameter WORLD_GET_PROFILE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "profile", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PROFILE, NULL },
};

static const Argument KIRI_FIT_BUDGET_ARGUMENTS[] = {
    { "profile", KIND_DICTIONARY, CLASS_NONE },
    { "microseconds", KIND_REAL, CLASS_NONE },
    { "budget", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriFitBudget(void* const* a)
{
    return kiriFitBudget(a[0], *(float*)a[1], a[2]);
}

static const Parameter KIRI_FIT_BUDGET_PARAMETERS[] = {
    { "profile", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PROFILE, NULL },
    { "microseconds", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "budget", FORM_INOUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &BUDGET, NULL },
};

static const Argument KIRI_GET_STAGE_NAME_ARGUMENTS[] = {
    { "stage", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriGetStageName(void* const* a)
{
    *(const char**)a[1] = kiriGetStageName(*(int32_t*)a[0]);
    return 0;
}

static const Parameter KIRI_GET_STAGE_NAME_PARAMETERS[] = {
    { "stage", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument KIRI_GET_MATERIAL_ARGUMENTS[] = {
    { "preset", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriGetMaterial(void* const* a)
{
    return kiriGetMaterial(*(int32_t*)a[0], a[1]);
}

static const Parameter KIRI_GET_MATERIAL_PARAMETERS[] = {
    { "preset", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "material", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &MATERIAL, NULL },
};

static const Argument KIRI_GET_QUALITY_ARGUMENTS[] = {
    { "preset", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriGetQuality(void* const* a)
{
    return kiriGetQuality(*(int32_t*)a[0], a[1]);
}

static const Parameter KIRI_GET_QUALITY_PARAMETERS[] = {
    { "preset", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "quality", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &QUALITY, NULL },
};

static int64_t Call_kiriDefaultSheetDef(void* const* a)
{
    kiriDefaultSheetDef(a[0]);
    return 0;
}

static const Parameter KIRI_DEFAULT_SHEET_DEF_PARAMETERS[] = {
    { "def", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SHEET_DEF, NULL },
};

static const Argument WORLD_CREATE_SHEET_ARGUMENTS[] = {
    { "def", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriCreateSheet(void* const* a)
{
    return kiriCreateSheet(a[0], a[1], a[2]);
}

static const Parameter WORLD_CREATE_SHEET_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "def", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SHEET_DEF, NULL },
    { "sheet", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static int64_t Call_kiriDestroySheet(void* const* a)
{
    return kiriDestroySheet(a[0], *(kiriSheet*)a[1]);
}

static const Parameter SHEET_DESTROY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static const Argument KIRI_GET_SETUP_ARGUMENTS[] = {
    { "preset", KIND_INT, CLASS_NONE },
    { "width", KIND_REAL, CLASS_NONE },
    { "height", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriGetSetup(void* const* a)
{
    return kiriGetSetup(*(int32_t*)a[0], *(float*)a[1], *(float*)a[2], a[3]);
}

static const Parameter KIRI_GET_SETUP_PARAMETERS[] = {
    { "preset", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "width", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "height", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "def", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SHEET_DEF, NULL },
};

static const Argument WORLD_CREATE_RECTANGLE_ARGUMENTS[] = {
    { "width", KIND_REAL, CLASS_NONE },
    { "height", KIND_REAL, CLASS_NONE },
    { "columns", KIND_INT, CLASS_NONE },
    { "rows", KIND_INT, CLASS_NONE },
    { "def", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriCreateRectangle(void* const* a)
{
    return kiriCreateRectangle(a[0], *(float*)a[1], *(float*)a[2], *(int32_t*)a[3], *(int32_t*)a[4], a[5], a[6]);
}

static const Parameter WORLD_CREATE_RECTANGLE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "width", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "height", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "columns", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rows", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "def", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 1, CLASS_NONE, &SHEET_DEF, NULL },
    { "sheet", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static int64_t Call_kiriSheet_GetSettings(void* const* a)
{
    return kiriSheet_GetSettings(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_GET_SETTINGS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "settings", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SHEET_SETTINGS, NULL },
};

static const Argument SHEET_SET_SETTINGS_ARGUMENTS[] = {
    { "settings", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetSettings(void* const* a)
{
    return kiriSheet_SetSettings(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_SET_SETTINGS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "settings", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SHEET_SETTINGS, NULL },
};

static const Argument WORLD_CREATE_FOLDED_SHEET_ARGUMENTS[] = {
    { "def", KIND_DICTIONARY, CLASS_NONE },
    { "folds", KIND_ARRAY, CLASS_NONE },
};

static int64_t Call_kiriCreateFoldedSheet(void* const* a)
{
    return kiriCreateFoldedSheet(a[0], a[1], a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter WORLD_CREATE_FOLDED_SHEET_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "def", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SHEET_DEF, NULL },
    { "folds", FORM_IN_ROWS, TYPE_STRUCT, KIND_ARRAY, 1, 3, 1, 0, CLASS_NONE, &FOLD, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static const Argument SHEET_ADD_FOLD_ARGUMENTS[] = {
    { "fold", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriSheet_AddFold(void* const* a)
{
    return kiriSheet_AddFold(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_ADD_FOLD_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "fold", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &FOLD, NULL },
    { "index", FORM_OUT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_GET_FOLD_ARGUMENTS[] = {
    { "index", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetFold(void* const* a)
{
    return kiriSheet_GetFold(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter SHEET_GET_FOLD_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "index", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "state", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &FOLD_STATE, NULL },
};

static const Argument SHEET_SET_FOLD_ARGUMENTS[] = {
    { "index", KIND_INT, CLASS_NONE },
    { "stiffness", KIND_REAL, CLASS_NONE },
    { "rest_angle", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetFold(void* const* a)
{
    return kiriSheet_SetFold(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], *(float*)a[3], *(float*)a[4]);
}

static const Parameter SHEET_SET_FOLD_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "index", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "stiffness", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rest_angle", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument KIRI_FILL_RECTANGLE_ARGUMENTS[] = {
    { "width", KIND_REAL, CLASS_NONE },
    { "height", KIND_REAL, CLASS_NONE },
    { "columns", KIND_INT, CLASS_NONE },
    { "rows", KIND_INT, CLASS_NONE },
};

static int64_t RowsOf_kiriFillRectangle_restPositions(void* const* a)
{
    return ((int64_t)*(int32_t*)a[2] + 1) * ((int64_t)*(int32_t*)a[3] + 1);
}

static int64_t RowsOf_kiriFillRectangle_indices(void* const* a)
{
    return 6 * (int64_t)*(int32_t*)a[2] * (int64_t)*(int32_t*)a[3];
}

static int64_t Call_kiriFillRectangle(void* const* a)
{
    return kiriFillRectangle(*(float*)a[0], *(float*)a[1], *(int32_t*)a[2], *(int32_t*)a[3], a[4], a[5]);
}

static const Parameter KIRI_FILL_RECTANGLE_PARAMETERS[] = {
    { "width", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "height", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "columns", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rows", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rest_positions", FORM_OUT_ROWS, TYPE_FLOAT, KIND_VECTORS2, 1, 0, 2, 0, CLASS_NONE, NULL, RowsOf_kiriFillRectangle_restPositions },
    { "indices", FORM_OUT_ROWS, TYPE_INT32, KIND_INTS, 1, 0, 1, 0, CLASS_NONE, NULL, RowsOf_kiriFillRectangle_indices },
};

static int64_t Call_kiriSheet_GetMesh(void* const* a)
{
    return kiriSheet_GetMesh(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_GET_MESH_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "mesh", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &MESH, NULL },
};

static const Argument SHEET_GET_DIRTY_ARGUMENTS[] = {
    { "since_revision", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetDirty(void* const* a)
{
    return kiriSheet_GetDirty(a[0], *(kiriSheet*)a[1], *(uint32_t*)a[2], a[3]);
}

static const Parameter SHEET_GET_DIRTY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "since_revision", FORM_IN, TYPE_UINT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "dirty", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &DIRTY, NULL },
};

static const Argument SHEET_COPY_VERTICES_ARGUMENTS[] = {
    { "first", KIND_INT, CLASS_NONE },
    { "count", KIND_INT, CLASS_NONE },
};

static const Argument SHEET_COPY_PREVIOUS_ARGUMENTS[] = {
    { "first", KIND_INT, CLASS_NONE },
    { "count", KIND_INT, CLASS_NONE },
};

static int64_t RowsOf_kiriSheet_CopyPrevious_vertices(void* const* a)
{
    return (int64_t)*(int32_t*)a[3];
}

static int64_t Call_kiriSheet_CopyPrevious(void* const* a)
{
    return kiriSheet_CopyPrevious(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], *(int32_t*)a[3], a[4], a[5]);
}

static const Parameter SHEET_COPY_PREVIOUS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "first", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "vertices", FORM_OUT_ROWS, TYPE_INT32, KIND_INTS, 1, 0, 1, 0, CLASS_NONE, NULL, RowsOf_kiriSheet_CopyPrevious_vertices },
    { "from", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static const Argument SHEET_COPY_INDICES16_ARGUMENTS[] = {
    { "first_triangle", KIND_INT, CLASS_NONE },
    { "count", KIND_INT, CLASS_NONE },
};

static int64_t RowsOf_kiriSheet_CopyIndices16_indices(void* const* a)
{
    return (int64_t)*(int32_t*)a[3];
}

static int64_t Call_kiriSheet_CopyIndices16(void* const* a)
{
    return kiriSheet_CopyIndices16(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter SHEET_COPY_INDICES16_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "first_triangle", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "indices", FORM_OUT_ROWS, TYPE_UINT16, KIND_BYTES, 1, 0, 3, 0, CLASS_NONE, NULL, RowsOf_kiriSheet_CopyIndices16_indices },
};

static const Argument SHEET_COPY_SOURCES_ARGUMENTS[] = {
    { "first_triangle", KIND_INT, CLASS_NONE },
    { "count", KIND_INT, CLASS_NONE },
};

static int64_t RowsOf_kiriSheet_CopySources_sources(void* const* a)
{
    return (int64_t)*(int32_t*)a[3];
}

static int64_t Call_kiriSheet_CopySources(void* const* a)
{
    return kiriSheet_CopySources(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter SHEET_COPY_SOURCES_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "first_triangle", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sources", FORM_OUT_ROWS, TYPE_INT32, KIND_INTS, 1, 0, 1, 0, CLASS_NONE, NULL, RowsOf_kiriSheet_CopySources_sources },
};

static const Argument SHEET_COPY_SOURCE_WEIGHTS_ARGUMENTS[] = {
    { "first_triangle", KIND_INT, CLASS_NONE },
    { "count", KIND_INT, CLASS_NONE },
};

static int64_t RowsOf_kiriSheet_CopySourceWeights_weights(void* const* a)
{
    return (int64_t)*(int32_t*)a[3];
}

static int64_t Call_kiriSheet_CopySourceWeights(void* const* a)
{
    return kiriSheet_CopySourceWeights(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter SHEET_COPY_SOURCE_WEIGHTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "first_triangle", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "weights", FORM_OUT_ROWS, TYPE_FLOAT, KIND_FLOATS, 1, 0, 9, 0, CLASS_NONE, NULL, RowsOf_kiriSheet_CopySourceWeights_weights },
};

static const Argument SHEET_GET_SOLID_ARGUMENTS[] = {
    { "thickness", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetSolid(void* const* a)
{
    return kiriSheet_GetSolid(a[0], *(kiriSheet*)a[1], *(float*)a[2], a[3]);
}

static const Parameter SHEET_GET_SOLID_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "thickness", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "solid", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SOLID, NULL },
};

static int64_t Call_kiriSheet_GetCollisionPoints(void* const* a)
{
    return kiriSheet_GetCollisionPoints(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_GET_COLLISION_POINTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "positions", FORM_OUT_VIEW, TYPE_FLOAT, KIND_VECTORS3, 1, 0, 3, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriSheet_GetCounts(void* const* a)
{
    return kiriSheet_GetCounts(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_GET_COUNTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "counts", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &COUNTS, NULL },
};

static int64_t Call_kiriSheet_GetTotals(void* const* a)
{
    return kiriSheet_GetTotals(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_GET_TOTALS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "totals", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &TOTALS, NULL },
};

static int64_t Call_kiriSheet_EstimateError(void* const* a)
{
    return kiriSheet_EstimateError(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_ESTIMATE_ERROR_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "relative", FORM_OUT, TYPE_DOUBLE, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriSheet_IsAwake(void* const* a)
{
    return kiriSheet_IsAwake(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_IS_AWAKE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "awake", FORM_OUT, TYPE_FLAG, KIND_BOOL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriSheet_Wake(void* const* a)
{
    return kiriSheet_Wake(a[0], *(kiriSheet*)a[1]);
}

static const Parameter SHEET_WAKE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static const Argument SHEET_TRANSFORM_ARGUMENTS[] = {
    { "rotation", KIND_BASIS, CLASS_NONE },
    { "translation", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriSheet_Transform(void* const* a)
{
    return kiriSheet_Transform(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_TRANSFORM_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rotation", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_BASIS, 9, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "translation", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_SET_VELOCITY_ARGUMENTS[] = {
    { "velocity", KIND_VECTOR3, CLASS_NONE },
    { "angular_velocity", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetVelocity(void* const* a)
{
    return kiriSheet_SetVelocity(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_SET_VELOCITY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "angular_velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument FRAME_SET_PIECE_VELOCITY_ARGUMENTS[] = {
    { "velocity", KIND_VECTOR3, CLASS_NONE },
    { "angular_velocity", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriFrame_SetPieceVelocity(void* const* a)
{
    return kiriFrame_SetPieceVelocity(a[0], *(kiriFrame*)a[1], a[2], a[3]);
}

static const Parameter FRAME_SET_PIECE_VELOCITY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "angular_velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_SET_USER_DATA_ARGUMENTS[] = {
    { "data", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetUserData(void* const* a)
{
    return kiriSheet_SetUserData(a[0], *(kiriSheet*)a[1], *(uint64_t*)a[2]);
}

static const Parameter SHEET_SET_USER_DATA_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "data", FORM_IN, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriSheet_GetUserData(void* const* a)
{
    return kiriSheet_GetUserData(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_GET_USER_DATA_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "data", FORM_OUT, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument PIN_SET_USER_DATA_ARGUMENTS[] = {
    { "data", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriPin_SetUserData(void* const* a)
{
    return kiriPin_SetUserData(a[0], *(kiriPin*)a[1], *(uint64_t*)a[2]);
}

static const Parameter PIN_SET_USER_DATA_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "data", FORM_IN, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriPin_GetUserData(void* const* a)
{
    return kiriPin_GetUserData(a[0], *(kiriPin*)a[1], a[2]);
}

static const Parameter PIN_GET_USER_DATA_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "data", FORM_OUT, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument FRAME_SET_PIECE_USER_DATA_ARGUMENTS[] = {
    { "data", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriFrame_SetPieceUserData(void* const* a)
{
    return kiriFrame_SetPieceUserData(a[0], *(kiriFrame*)a[1], *(uint64_t*)a[2]);
}

static const Parameter FRAME_SET_PIECE_USER_DATA_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "data", FORM_IN, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriFrame_GetPieceUserData(void* const* a)
{
    return kiriFrame_GetPieceUserData(a[0], *(kiriFrame*)a[1], a[2]);
}

static const Parameter FRAME_GET_PIECE_USER_DATA_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "data", FORM_OUT, TYPE_UINT64, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_RAYCAST_ARGUMENTS[] = {
    { "origin", KIND_VECTOR3, CLASS_NONE },
    { "direction", KIND_VECTOR3, CLASS_NONE },
    { "max_distance", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_Raycast(void* const* a)
{
    return kiriSheet_Raycast(a[0], *(kiriSheet*)a[1], a[2], a[3], *(float*)a[4], a[5]);
}

static const Parameter SHEET_RAYCAST_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "origin", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "direction", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "max_distance", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "hit", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &HIT, NULL },
};

static const Argument WORLD_RAYCAST_ARGUMENTS[] = {
    { "origin", KIND_VECTOR3, CLASS_NONE },
    { "direction", KIND_VECTOR3, CLASS_NONE },
    { "max_distance", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriWorld_Raycast(void* const* a)
{
    return kiriWorld_Raycast(a[0], a[1], a[2], *(float*)a[3], a[4], a[5]);
}

static const Parameter WORLD_RAYCAST_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "origin", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "direction", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "max_distance", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "hit", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &HIT, NULL },
};

static const Argument SHEET_GET_POINT_ARGUMENTS[] = {
    { "rest_point", KIND_VECTOR2, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetPoint(void* const* a)
{
    return kiriSheet_GetPoint(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_GET_POINT_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_point", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "state", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &POINT_STATE, NULL },
};

static const Argument SHEET_GET_WEIGHTS_ARGUMENTS[] = {
    { "rest_point", KIND_VECTOR2, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetWeights(void* const* a)
{
    return kiriSheet_GetWeights(a[0], *(kiriSheet*)a[1], a[2], a[3], a[4], a[5], *(int32_t*)a[6], a[7]);
}

static const Parameter SHEET_GET_WEIGHTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_point", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frames", FORM_OUT_LIST, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_FRAME, NULL, NULL },
    { "weights", FORM_OUT_LIST, TYPE_FLOAT, KIND_FLOATS, 1, 0, 1, 0, CLASS_NONE, NULL, NULL },
    { "gradients", FORM_OUT_LIST, TYPE_FLOAT, KIND_VECTORS2, 1, 0, 2, 1, CLASS_NONE, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_GET_PIECE_ARGUMENTS[] = {
    { "piece", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetPiece(void* const* a)
{
    return kiriSheet_GetPiece(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter SHEET_GET_PIECE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "piece", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "state", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PIECE_STATE, NULL },
};

static const Argument SHEET_GET_PIECE_MESH_ARGUMENTS[] = {
    { "piece", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetPieceMesh(void* const* a)
{
    return kiriSheet_GetPieceMesh(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter SHEET_GET_PIECE_MESH_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "piece", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "mesh", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PIECE_MESH, NULL },
};

static const Argument SHEET_GET_PIECE_FRAMES_ARGUMENTS[] = {
    { "piece", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetPieceFrames(void* const* a)
{
    return kiriSheet_GetPieceFrames(a[0], *(kiriSheet*)a[1], *(int32_t*)a[2], a[3], a[4]);
}

static const Parameter SHEET_GET_PIECE_FRAMES_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "piece", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frames", FORM_OUT_VIEW, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_FRAME, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriFrame_GetPiece(void* const* a)
{
    return kiriFrame_GetPiece(a[0], *(kiriFrame*)a[1], a[2]);
}

static const Parameter FRAME_GET_PIECE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "piece", FORM_OUT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriFrame_DetachPiece(void* const* a)
{
    return kiriFrame_DetachPiece(a[0], *(kiriFrame*)a[1], a[2]);
}

static const Parameter FRAME_DETACH_PIECE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "detached", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
};

static int64_t Call_kiriFrame_DestroyPiece(void* const* a)
{
    return kiriFrame_DestroyPiece(a[0], *(kiriFrame*)a[1]);
}

static const Parameter FRAME_DESTROY_PIECE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
};

static const Argument WORLD_DETACH_PIECES_ARGUMENTS[] = {
    { "frames", KIND_ARRAY, CLASS_FRAME },
};

static int64_t RowsOf_kiriWorld_DetachPieces_detached(void* const* a)
{
    return (int64_t)*(int32_t*)a[2];
}

static int64_t Call_kiriWorld_DetachPieces(void* const* a)
{
    return kiriWorld_DetachPieces(a[0], a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter WORLD_DETACH_PIECES_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frames", FORM_IN_ROWS, TYPE_ID, KIND_ARRAY, 1, 2, 1, 0, CLASS_FRAME, NULL, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "detached", FORM_OUT_ROWS, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_SHEET, NULL, RowsOf_kiriWorld_DetachPieces_detached },
};

static const Argument WORLD_DESTROY_PIECES_ARGUMENTS[] = {
    { "frames", KIND_ARRAY, CLASS_FRAME },
};

static int64_t Call_kiriWorld_DestroyPieces(void* const* a)
{
    return kiriWorld_DestroyPieces(a[0], a[1], *(int32_t*)a[2]);
}

static const Parameter WORLD_DESTROY_PIECES_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frames", FORM_IN_ROWS, TYPE_ID, KIND_ARRAY, 1, 2, 1, 0, CLASS_FRAME, NULL, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_DROP_CRUMBS_ARGUMENTS[] = {
    { "area", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_DropCrumbs(void* const* a)
{
    return kiriSheet_DropCrumbs(a[0], *(kiriSheet*)a[1], *(float*)a[2], a[3]);
}

static const Parameter SHEET_DROP_CRUMBS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "area", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_BEGIN_CUT_ARGUMENTS[] = {
    { "rest_point", KIND_VECTOR2, CLASS_NONE },
};

static int64_t Call_kiriBeginCut(void* const* a)
{
    return kiriBeginCut(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_BEGIN_CUT_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_point", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "cut", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_CUT, NULL, NULL },
};

static const Argument CUT_EXTEND_ARGUMENTS[] = {
    { "rest_points", KIND_VECTORS2, CLASS_NONE },
};

static int64_t Call_kiriCut_Extend(void* const* a)
{
    return kiriCut_Extend(a[0], *(kiriCut*)a[1], a[2], *(int32_t*)a[3]);
}

static const Parameter CUT_EXTEND_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "cut", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_CUT, NULL, NULL },
    { "rest_points", FORM_IN_ROWS, TYPE_FLOAT, KIND_VECTORS2, 1, 3, 2, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriCut_End(void* const* a)
{
    return kiriCut_End(a[0], *(kiriCut*)a[1]);
}

static const Parameter CUT_END_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "cut", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_CUT, NULL, NULL },
};

static const Argument SHEET_CUT_ARGUMENTS[] = {
    { "rest_points", KIND_VECTORS2, CLASS_NONE },
};

static int64_t Call_kiriSheet_Cut(void* const* a)
{
    return kiriSheet_Cut(a[0], *(kiriSheet*)a[1], a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter SHEET_CUT_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_points", FORM_IN_ROWS, TYPE_FLOAT, KIND_VECTORS2, 1, 3, 2, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "cut", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_CUT, NULL, NULL },
};

static const Argument SHEET_SLICE_ARGUMENTS[] = {
    { "blade", KIND_VECTORS3, CLASS_NONE },
};

static int64_t Call_kiriSheet_Slice(void* const* a)
{
    return kiriSheet_Slice(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_SLICE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "blade", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTORS3, 12, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "cut", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_CUT, NULL, NULL },
};

static const Argument KIRI_GET_TEARING_ARGUMENTS[] = {
    { "preset", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriGetTearing(void* const* a)
{
    return kiriGetTearing(*(int32_t*)a[0], a[1]);
}

static const Parameter KIRI_GET_TEARING_PARAMETERS[] = {
    { "preset", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "tearing", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &TEARING, NULL },
};

static const Argument SHEET_SET_TEARING_ARGUMENTS[] = {
    { "tearing", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetTearing(void* const* a)
{
    return kiriSheet_SetTearing(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_SET_TEARING_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "tearing", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &TEARING, NULL },
};

static int64_t Call_kiriSheet_GetTearing(void* const* a)
{
    return kiriSheet_GetTearing(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_GET_TEARING_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "tearing", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &TEARING, NULL },
};

static const Argument SHEET_SET_TEAR_LINE_ARGUMENTS[] = {
    { "rest_points", KIND_VECTORS2, CLASS_NONE },
    { "factor", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetTearLine(void* const* a)
{
    return kiriSheet_SetTearLine(a[0], *(kiriSheet*)a[1], a[2], *(int32_t*)a[3], *(float*)a[4]);
}

static const Parameter SHEET_SET_TEAR_LINE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_points", FORM_IN_ROWS, TYPE_FLOAT, KIND_VECTORS2, 1, 3, 2, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "factor", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument WORLD_BEGIN_BLADE_ARGUMENTS[] = {
    { "sheet", KIND_OBJECT, CLASS_SHEET },
};

static int64_t Call_kiriBeginBlade(void* const* a)
{
    return kiriBeginBlade(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter WORLD_BEGIN_BLADE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_IN, TYPE_ID, KIND_OBJECT, 1, 0, 0, 1, CLASS_SHEET, NULL, NULL },
    { "blade", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_BLADE, NULL, NULL },
};

static const Argument BLADE_MOVE_EDGE_ARGUMENTS[] = {
    { "from", KIND_VECTOR3, CLASS_NONE },
    { "to", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriBlade_MoveEdge(void* const* a)
{
    return kiriBlade_MoveEdge(a[0], *(kiriBlade*)a[1], a[2], a[3]);
}

static const Parameter BLADE_MOVE_EDGE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "blade", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_BLADE, NULL, NULL },
    { "from", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "to", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument BLADE_MOVE_RAY_ARGUMENTS[] = {
    { "origin", KIND_VECTOR3, CLASS_NONE },
    { "direction", KIND_VECTOR3, CLASS_NONE },
    { "length", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriBlade_MoveRay(void* const* a)
{
    return kiriBlade_MoveRay(a[0], *(kiriBlade*)a[1], a[2], a[3], *(float*)a[4]);
}

static const Parameter BLADE_MOVE_RAY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "blade", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_BLADE, NULL, NULL },
    { "origin", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "direction", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "length", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriBlade_End(void* const* a)
{
    return kiriBlade_End(a[0], *(kiriBlade*)a[1]);
}

static const Parameter BLADE_END_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "blade", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_BLADE, NULL, NULL },
};

static int64_t Call_kiriSheet_GetFrames(void* const* a)
{
    return kiriSheet_GetFrames(a[0], *(kiriSheet*)a[1], a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter SHEET_GET_FRAMES_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "frames", FORM_OUT_LIST, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_FRAME, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument FRAME_HOLD_ARGUMENTS[] = {
    { "position", KIND_NIL, CLASS_NONE },
    { "rotation", KIND_NIL, CLASS_NONE },
};

static int64_t Call_kiriFrame_Hold(void* const* a)
{
    return kiriFrame_Hold(a[0], *(kiriFrame*)a[1], a[2], a[3]);
}

static const Parameter FRAME_HOLD_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "position", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 1, CLASS_NONE, NULL, NULL },
    { "rotation", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_BASIS, 9, 0, 0, 1, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriFrame_GetState(void* const* a)
{
    return kiriFrame_GetState(a[0], *(kiriFrame*)a[1], a[2]);
}

static const Parameter FRAME_GET_STATE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "state", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &FRAME_STATE, NULL },
};

static int64_t Call_kiriFrame_GetReaction(void* const* a)
{
    return kiriFrame_GetReaction(a[0], *(kiriFrame*)a[1], a[2], a[3]);
}

static const Parameter FRAME_GET_REACTION_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "force", FORM_OUT_NUMBERS, TYPE_DOUBLE, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "torque", FORM_OUT_NUMBERS, TYPE_DOUBLE, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument FRAME_APPLY_FORCE_ARGUMENTS[] = {
    { "force", KIND_VECTOR3, CLASS_NONE },
    { "torque", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriFrame_ApplyForce(void* const* a)
{
    return kiriFrame_ApplyForce(a[0], *(kiriFrame*)a[1], a[2], a[3]);
}

static const Parameter FRAME_APPLY_FORCE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "frame", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_FRAME, NULL, NULL },
    { "force", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "torque", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_APPLY_FORCE_ARGUMENTS[] = {
    { "rest_point", KIND_VECTOR2, CLASS_NONE },
    { "force", KIND_VECTOR3, CLASS_NONE },
    { "torque", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriSheet_ApplyForce(void* const* a)
{
    return kiriSheet_ApplyForce(a[0], *(kiriSheet*)a[1], a[2], a[3], a[4]);
}

static const Parameter SHEET_APPLY_FORCE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_point", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "force", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "torque", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_APPLY_LINE_LOAD_ARGUMENTS[] = {
    { "from", KIND_VECTOR2, CLASS_NONE },
    { "to", KIND_VECTOR2, CLASS_NONE },
    { "force_per_length", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriSheet_ApplyLineLoad(void* const* a)
{
    return kiriSheet_ApplyLineLoad(a[0], *(kiriSheet*)a[1], a[2], a[3], a[4]);
}

static const Parameter SHEET_APPLY_LINE_LOAD_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "from", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "to", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "force_per_length", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_APPLY_PRESSURE_ARGUMENTS[] = {
    { "pressure", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_ApplyPressure(void* const* a)
{
    return kiriSheet_ApplyPressure(a[0], *(kiriSheet*)a[1], *(float*)a[2]);
}

static const Parameter SHEET_APPLY_PRESSURE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "pressure", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_APPLY_IMPULSE_ARGUMENTS[] = {
    { "rest_point", KIND_VECTOR2, CLASS_NONE },
    { "impulse", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriSheet_ApplyImpulse(void* const* a)
{
    return kiriSheet_ApplyImpulse(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_APPLY_IMPULSE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "rest_point", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "impulse", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_SET_WIND_ARGUMENTS[] = {
    { "wind", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetWind(void* const* a)
{
    return kiriSheet_SetWind(a[0], *(kiriSheet*)a[1], a[2]);
}

static const Parameter SHEET_SET_WIND_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "wind", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &WIND, NULL },
};

static int64_t Call_kiriDefaultPinDef(void* const* a)
{
    kiriDefaultPinDef(a[0]);
    return 0;
}

static const Parameter KIRI_DEFAULT_PIN_DEF_PARAMETERS[] = {
    { "def", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PIN_DEF, NULL },
};

static const Argument SHEET_CREATE_PIN_ARGUMENTS[] = {
    { "def", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriCreatePin(void* const* a)
{
    return kiriCreatePin(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_CREATE_PIN_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "def", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PIN_DEF, NULL },
    { "pin", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
};

static int64_t Call_kiriDestroyPin(void* const* a)
{
    return kiriDestroyPin(a[0], *(kiriPin*)a[1]);
}

static const Parameter PIN_DESTROY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
};

static const Argument SHEET_CLAMP_LINE_ARGUMENTS[] = {
    { "from", KIND_VECTOR2, CLASS_NONE },
    { "to", KIND_VECTOR2, CLASS_NONE },
};

static int64_t Call_kiriSheet_ClampLine(void* const* a)
{
    return kiriSheet_ClampLine(a[0], *(kiriSheet*)a[1], a[2], a[3], a[4]);
}

static const Parameter SHEET_CLAMP_LINE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "from", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "to", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "clamp", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
};

static const Argument SHEET_HINGE_LINE_ARGUMENTS[] = {
    { "from", KIND_VECTOR2, CLASS_NONE },
    { "to", KIND_VECTOR2, CLASS_NONE },
};

static int64_t Call_kiriSheet_HingeLine(void* const* a)
{
    return kiriSheet_HingeLine(a[0], *(kiriSheet*)a[1], a[2], a[3], a[4]);
}

static const Parameter SHEET_HINGE_LINE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "from", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "to", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR2, 2, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "hinge", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
};

static const Argument PIN_SET_TARGET_ARGUMENTS[] = {
    { "target", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriPin_SetTarget(void* const* a)
{
    return kiriPin_SetTarget(a[0], *(kiriPin*)a[1], a[2]);
}

static const Parameter PIN_SET_TARGET_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "target", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument PIN_SET_POSE_ARGUMENTS[] = {
    { "target", KIND_VECTOR3, CLASS_NONE },
    { "rotation", KIND_BASIS, CLASS_NONE },
};

static int64_t Call_kiriPin_SetPose(void* const* a)
{
    return kiriPin_SetPose(a[0], *(kiriPin*)a[1], a[2], a[3]);
}

static const Parameter PIN_SET_POSE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "target", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rotation", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_BASIS, 9, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument PIN_SET_BREAK_FORCE_ARGUMENTS[] = {
    { "break_force", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriPin_SetBreakForce(void* const* a)
{
    return kiriPin_SetBreakForce(a[0], *(kiriPin*)a[1], *(float*)a[2]);
}

static const Parameter PIN_SET_BREAK_FORCE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "break_force", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriPin_GetState(void* const* a)
{
    return kiriPin_GetState(a[0], *(kiriPin*)a[1], a[2]);
}

static const Parameter PIN_GET_STATE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "state", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &PIN_STATE, NULL },
};

static int64_t Call_kiriPin_GetReaction(void* const* a)
{
    return kiriPin_GetReaction(a[0], *(kiriPin*)a[1], a[2], a[3]);
}

static const Parameter PIN_GET_REACTION_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "pin", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_PIN, NULL, NULL },
    { "force", FORM_OUT_NUMBERS, TYPE_DOUBLE, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "torque", FORM_OUT_NUMBERS, TYPE_DOUBLE, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriSheet_GetPins(void* const* a)
{
    return kiriSheet_GetPins(a[0], *(kiriSheet*)a[1], a[2], *(int32_t*)a[3], a[4]);
}

static const Parameter SHEET_GET_PINS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "pins", FORM_OUT_LIST, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_PIN, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriDefaultSeamDef(void* const* a)
{
    kiriDefaultSeamDef(a[0]);
    return 0;
}

static const Parameter KIRI_DEFAULT_SEAM_DEF_PARAMETERS[] = {
    { "def", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SEAM_DEF, NULL },
};

static const Argument WORLD_CREATE_SEAM_ARGUMENTS[] = {
    { "def", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriCreateSeam(void* const* a)
{
    return kiriCreateSeam(a[0], a[1], a[2]);
}

static const Parameter WORLD_CREATE_SEAM_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "def", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &SEAM_DEF, NULL },
    { "seam", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SEAM, NULL, NULL },
};

static int64_t Call_kiriDestroySeam(void* const* a)
{
    return kiriDestroySeam(a[0], *(kiriSeam*)a[1]);
}

static const Parameter SEAM_DESTROY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "seam", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SEAM, NULL, NULL },
};

static const Argument SEAM_SET_HINGE_ARGUMENTS[] = {
    { "stiffness", KIND_REAL, CLASS_NONE },
    { "rest_angle", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSeam_SetHinge(void* const* a)
{
    return kiriSeam_SetHinge(a[0], *(kiriSeam*)a[1], *(float*)a[2], *(float*)a[3]);
}

static const Parameter SEAM_SET_HINGE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "seam", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SEAM, NULL, NULL },
    { "stiffness", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rest_angle", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SEAM_GET_STITCH_ARGUMENTS[] = {
    { "index", KIND_INT, CLASS_NONE },
};

static int64_t Call_kiriSeam_GetStitch(void* const* a)
{
    return kiriSeam_GetStitch(a[0], *(kiriSeam*)a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter SEAM_GET_STITCH_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "seam", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SEAM, NULL, NULL },
    { "index", FORM_IN, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "stitch", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &STITCH, NULL },
};

static int64_t Call_kiriSeam_GetCount(void* const* a)
{
    return kiriSeam_GetCount(a[0], *(kiriSeam*)a[1], a[2]);
}

static const Parameter SEAM_GET_COUNT_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "seam", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SEAM, NULL, NULL },
    { "stitches", FORM_OUT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriWorld_GetSeams(void* const* a)
{
    return kiriWorld_GetSeams(a[0], a[1], *(int32_t*)a[2], a[3]);
}

static const Parameter WORLD_GET_SEAMS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "seams", FORM_OUT_LIST, TYPE_ID, KIND_ARRAY, 1, 0, 1, 0, CLASS_SEAM, NULL, NULL },
    { "capacity", FORM_CAPACITY, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument SHEET_SET_CONTACTS_ARGUMENTS[] = {
    { "contacts", KIND_ARRAY, CLASS_NONE },
};

static int64_t Call_kiriSheet_SetContacts(void* const* a)
{
    return kiriSheet_SetContacts(a[0], *(kiriSheet*)a[1], a[2], *(int32_t*)a[3]);
}

static const Parameter SHEET_SET_CONTACTS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "contacts", FORM_IN_ROWS, TYPE_STRUCT, KIND_ARRAY, 1, 3, 1, 0, CLASS_NONE, &CONTACT, NULL },
    { "count", FORM_IN_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriSheet_GetContactForces(void* const* a)
{
    return kiriSheet_GetContactForces(a[0], *(kiriSheet*)a[1], a[2], a[3]);
}

static const Parameter SHEET_GET_CONTACT_FORCES_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "forces", FORM_OUT_VIEW, TYPE_STRUCT, KIND_ARRAY, 1, 0, 1, 0, CLASS_NONE, &CONTACT_FORCE, NULL },
    { "count", FORM_OUT_COUNT, TYPE_INT32, KIND_INT, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriDefaultObstacleDef(void* const* a)
{
    kiriDefaultObstacleDef(a[0]);
    return 0;
}

static const Parameter KIRI_DEFAULT_OBSTACLE_DEF_PARAMETERS[] = {
    { "def", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &OBSTACLE_DEF, NULL },
};

static const Argument WORLD_CREATE_OBSTACLE_ARGUMENTS[] = {
    { "def", KIND_DICTIONARY, CLASS_NONE },
};

static int64_t Call_kiriCreateObstacle(void* const* a)
{
    return kiriCreateObstacle(a[0], a[1], a[2]);
}

static const Parameter WORLD_CREATE_OBSTACLE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "def", FORM_IN_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &OBSTACLE_DEF, NULL },
    { "obstacle", FORM_OUT, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
};

static int64_t Call_kiriDestroyObstacle(void* const* a)
{
    return kiriDestroyObstacle(a[0], *(kiriObstacle*)a[1]);
}

static const Parameter OBSTACLE_DESTROY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "obstacle", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
};

static const Argument OBSTACLE_SET_POSE_ARGUMENTS[] = {
    { "position", KIND_VECTOR3, CLASS_NONE },
    { "rotation", KIND_BASIS, CLASS_NONE },
};

static int64_t Call_kiriObstacle_SetPose(void* const* a)
{
    return kiriObstacle_SetPose(a[0], *(kiriObstacle*)a[1], a[2], a[3]);
}

static const Parameter OBSTACLE_SET_POSE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "obstacle", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
    { "position", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "rotation", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_BASIS, 9, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument OBSTACLE_SET_VELOCITY_ARGUMENTS[] = {
    { "velocity", KIND_VECTOR3, CLASS_NONE },
    { "angular_velocity", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriObstacle_SetVelocity(void* const* a)
{
    return kiriObstacle_SetVelocity(a[0], *(kiriObstacle*)a[1], a[2], a[3]);
}

static const Parameter OBSTACLE_SET_VELOCITY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "obstacle", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
    { "velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "angular_velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument OBSTACLE_SET_SURFACE_VELOCITY_ARGUMENTS[] = {
    { "velocity", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriObstacle_SetSurfaceVelocity(void* const* a)
{
    return kiriObstacle_SetSurfaceVelocity(a[0], *(kiriObstacle*)a[1], a[2]);
}

static const Parameter OBSTACLE_SET_SURFACE_VELOCITY_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "obstacle", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
    { "velocity", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static const Argument OBSTACLE_SET_MASS_ARGUMENTS[] = {
    { "mass", KIND_REAL, CLASS_NONE },
    { "inertia", KIND_FLOATS, CLASS_NONE },
    { "center_of_mass", KIND_VECTOR3, CLASS_NONE },
};

static int64_t Call_kiriObstacle_SetMass(void* const* a)
{
    return kiriObstacle_SetMass(a[0], *(kiriObstacle*)a[1], *(float*)a[2], a[3], a[4]);
}

static const Parameter OBSTACLE_SET_MASS_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "obstacle", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
    { "mass", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "inertia", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_FLOATS, 6, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "center_of_mass", FORM_IN_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriObstacle_GetState(void* const* a)
{
    return kiriObstacle_GetState(a[0], *(kiriObstacle*)a[1], a[2]);
}

static const Parameter OBSTACLE_GET_STATE_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "obstacle", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_OBSTACLE, NULL, NULL },
    { "state", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &OBSTACLE_STATE, NULL },
};

static const Argument SHEET_GET_REACH_ARGUMENTS[] = {
    { "dt", KIND_REAL, CLASS_NONE },
};

static int64_t Call_kiriSheet_GetReach(void* const* a)
{
    return kiriSheet_GetReach(a[0], *(kiriSheet*)a[1], *(float*)a[2], a[3], a[4]);
}

static const Parameter SHEET_GET_REACH_PARAMETERS[] = {
    { "world", FORM_WORLD, TYPE_NONE, KIND_NIL, 0, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "sheet", FORM_SELF, TYPE_ID, KIND_OBJECT, 1, 0, 0, 0, CLASS_SHEET, NULL, NULL },
    { "dt", FORM_IN, TYPE_FLOAT, KIND_REAL, 1, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "lower", FORM_OUT_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
    { "upper", FORM_OUT_NUMBERS, TYPE_FLOAT, KIND_VECTOR3, 3, 0, 0, 0, CLASS_NONE, NULL, NULL },
};

static int64_t Call_kiriDefaultDebugDraw(void* const* a)
{
    kiriDefaultDebugDraw(a[0]);
    return 0;
}

static const Parameter KIRI_DEFAULT_DEBUG_DRAW_PARAMETERS[] = {
    { "draw", FORM_OUT_STRUCT, TYPE_STRUCT, KIND_DICTIONARY, 1, 0, 0, 0, CLASS_NONE, &DEBUG_DRAW, NULL },
};

static const Argument WORLD_DEBUG_DRAW_ARGUMENTS[] = {
    { "draw", KIND_DICTIONARY, CLASS_NONE },
};

static const Argument SHEET_GET_SOLID_ARRAYS_ARGUMENTS[] = {
    { "thickness", KIND_REAL, CLASS_NONE },
};

const Method METHODS[] = {
    { CLASS_KIRI, "get_version", "kiriGetVersion", RETURNS_INT, KIND_INT, CLASS_NONE, 0, 0, NULL, 0, NULL, Call_kiriGetVersion, NULL },
    { CLASS_KIRI, "get_result_name", "kiriGetResultName", RETURNS_TEXT, KIND_STRING, CLASS_NONE, 1, 1, KIRI_GET_RESULT_NAME_ARGUMENTS, 1, KIRI_GET_RESULT_NAME_PARAMETERS, Call_kiriGetResultName, NULL },
    { CLASS_KIRI, "get_result_text", "kiriGetResultText", RETURNS_TEXT, KIND_STRING, CLASS_NONE, 1, 1, KIRI_GET_RESULT_TEXT_ARGUMENTS, 1, KIRI_GET_RESULT_TEXT_PARAMETERS, Call_kiriGetResultText, NULL },
    { CLASS_KIRI, "default_world_def", "kiriDefaultWorldDef", RETURNS_NOTHING, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 1, KIRI_DEFAULT_WORLD_DEF_PARAMETERS, Call_kiriDefaultWorldDef, NULL },
    { CLASS_KIRI, "create_world", "kiriCreateWorld", RETURNS_RESULT, KIND_OBJECT, CLASS_WORLD, 1, 0, KIRI_CREATE_WORLD_ARGUMENTS, 0, NULL, NULL, CreateWorld },
    { CLASS_WORLD, "destroy", "kiriDestroyWorld", RETURNS_NOTHING, KIND_NIL, CLASS_NONE, 0, 0, NULL, 0, NULL, NULL, DestroyWorld },
    { CLASS_WORLD, "tick", "kiriWorld_Tick", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, WORLD_TICK_ARGUMENTS, 3, WORLD_TICK_PARAMETERS, Call_kiriWorld_Tick, NULL },
    { CLASS_WORLD, "get_last_error", "kiriWorld_GetLastError", RETURNS_TEXT, KIND_STRING, CLASS_NONE, 0, 0, NULL, 1, WORLD_GET_LAST_ERROR_PARAMETERS, Call_kiriWorld_GetLastError, NULL },
    { CLASS_WORLD, "shift_origin", "kiriWorld_ShiftOrigin", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_SHIFT_ORIGIN_ARGUMENTS, 2, WORLD_SHIFT_ORIGIN_PARAMETERS, Call_kiriWorld_ShiftOrigin, NULL },
    { CLASS_WORLD, "set_gravity", "kiriWorld_SetGravity", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_SET_GRAVITY_ARGUMENTS, 2, WORLD_SET_GRAVITY_PARAMETERS, Call_kiriWorld_SetGravity, NULL },
    { CLASS_WORLD, "set_budget", "kiriWorld_SetBudget", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_SET_BUDGET_ARGUMENTS, 2, WORLD_SET_BUDGET_PARAMETERS, Call_kiriWorld_SetBudget, NULL },
    { CLASS_WORLD, "get_state_hash", "kiriWorld_GetStateHash", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, WORLD_GET_STATE_HASH_PARAMETERS, Call_kiriWorld_GetStateHash, NULL },
    { CLASS_WORLD, "get_sheets", "kiriWorld_GetSheets", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 4, WORLD_GET_SHEETS_PARAMETERS, Call_kiriWorld_GetSheets, NULL },
    { CLASS_WORLD, "note", "kiriWorld_Note", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_NOTE_ARGUMENTS, 3, WORLD_NOTE_PARAMETERS, Call_kiriWorld_Note, NULL },
    { CLASS_WORLD, "replay", "kiriWorld_Replay", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, WORLD_REPLAY_ARGUMENTS, 4, WORLD_REPLAY_PARAMETERS, Call_kiriWorld_Replay, NULL },
    { CLASS_WORLD, "save", "kiriWorld_Save", RETURNS_RESULT, KIND_BYTES, CLASS_NONE, 0, 0, NULL, 4, WORLD_SAVE_PARAMETERS, Call_kiriWorld_Save, NULL },
    { CLASS_WORLD, "finish_cuts", "kiriWorld_FinishCuts", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 1, WORLD_FINISH_CUTS_PARAMETERS, Call_kiriWorld_FinishCuts, NULL },
    { CLASS_WORLD, "load", "kiriWorld_Load", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_LOAD_ARGUMENTS, 3, WORLD_LOAD_PARAMETERS, Call_kiriWorld_Load, NULL },
    { CLASS_WORLD, "snapshot", "kiriWorld_Snapshot", RETURNS_RESULT, KIND_BYTES, CLASS_NONE, 0, 0, NULL, 4, WORLD_SNAPSHOT_PARAMETERS, Call_kiriWorld_Snapshot, NULL },
    { CLASS_WORLD, "restore", "kiriWorld_Restore", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_RESTORE_ARGUMENTS, 3, WORLD_RESTORE_PARAMETERS, Call_kiriWorld_Restore, NULL },
    { CLASS_WORLD, "get_events", "kiriWorld_GetEvents", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 3, WORLD_GET_EVENTS_PARAMETERS, Call_kiriWorld_GetEvents, NULL },
    { CLASS_WORLD, "get_profile", "kiriWorld_GetProfile", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 2, WORLD_GET_PROFILE_PARAMETERS, Call_kiriWorld_GetProfile, NULL },
    { CLASS_KIRI, "fit_budget", "kiriFitBudget", RETURNS_RESULT, KIND_INT, CLASS_NONE, 3, 3, KIRI_FIT_BUDGET_ARGUMENTS, 3, KIRI_FIT_BUDGET_PARAMETERS, Call_kiriFitBudget, NULL },
    { CLASS_KIRI, "get_stage_name", "kiriGetStageName", RETURNS_TEXT, KIND_STRING, CLASS_NONE, 1, 1, KIRI_GET_STAGE_NAME_ARGUMENTS, 1, KIRI_GET_STAGE_NAME_PARAMETERS, Call_kiriGetStageName, NULL },
    { CLASS_KIRI, "get_material", "kiriGetMaterial", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, KIRI_GET_MATERIAL_ARGUMENTS, 2, KIRI_GET_MATERIAL_PARAMETERS, Call_kiriGetMaterial, NULL },
    { CLASS_KIRI, "get_quality", "kiriGetQuality", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, KIRI_GET_QUALITY_ARGUMENTS, 2, KIRI_GET_QUALITY_PARAMETERS, Call_kiriGetQuality, NULL },
    { CLASS_KIRI, "default_sheet_def", "kiriDefaultSheetDef", RETURNS_NOTHING, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 1, KIRI_DEFAULT_SHEET_DEF_PARAMETERS, Call_kiriDefaultSheetDef, NULL },
    { CLASS_WORLD, "create_sheet", "kiriCreateSheet", RETURNS_RESULT, KIND_OBJECT, CLASS_SHEET, 1, 1, WORLD_CREATE_SHEET_ARGUMENTS, 3, WORLD_CREATE_SHEET_PARAMETERS, Call_kiriCreateSheet, NULL },
    { CLASS_SHEET, "destroy", "kiriDestroySheet", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, SHEET_DESTROY_PARAMETERS, Call_kiriDestroySheet, NULL },
    { CLASS_KIRI, "get_setup", "kiriGetSetup", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 3, 3, KIRI_GET_SETUP_ARGUMENTS, 4, KIRI_GET_SETUP_PARAMETERS, Call_kiriGetSetup, NULL },
    { CLASS_WORLD, "create_rectangle", "kiriCreateRectangle", RETURNS_RESULT, KIND_OBJECT, CLASS_SHEET, 5, 4, WORLD_CREATE_RECTANGLE_ARGUMENTS, 7, WORLD_CREATE_RECTANGLE_PARAMETERS, Call_kiriCreateRectangle, NULL },
    { CLASS_SHEET, "get_settings", "kiriSheet_GetSettings", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, SHEET_GET_SETTINGS_PARAMETERS, Call_kiriSheet_GetSettings, NULL },
    { CLASS_SHEET, "set_settings", "kiriSheet_SetSettings", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_SET_SETTINGS_ARGUMENTS, 3, SHEET_SET_SETTINGS_PARAMETERS, Call_kiriSheet_SetSettings, NULL },
    { CLASS_WORLD, "create_folded_sheet", "kiriCreateFoldedSheet", RETURNS_RESULT, KIND_OBJECT, CLASS_SHEET, 2, 2, WORLD_CREATE_FOLDED_SHEET_ARGUMENTS, 5, WORLD_CREATE_FOLDED_SHEET_PARAMETERS, Call_kiriCreateFoldedSheet, NULL },
    { CLASS_SHEET, "add_fold", "kiriSheet_AddFold", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_ADD_FOLD_ARGUMENTS, 4, SHEET_ADD_FOLD_PARAMETERS, Call_kiriSheet_AddFold, NULL },
    { CLASS_SHEET, "get_fold", "kiriSheet_GetFold", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_FOLD_ARGUMENTS, 4, SHEET_GET_FOLD_PARAMETERS, Call_kiriSheet_GetFold, NULL },
    { CLASS_SHEET, "set_fold", "kiriSheet_SetFold", RETURNS_RESULT, KIND_INT, CLASS_NONE, 3, 3, SHEET_SET_FOLD_ARGUMENTS, 5, SHEET_SET_FOLD_PARAMETERS, Call_kiriSheet_SetFold, NULL },
    { CLASS_KIRI, "fill_rectangle", "kiriFillRectangle", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 4, 4, KIRI_FILL_RECTANGLE_ARGUMENTS, 6, KIRI_FILL_RECTANGLE_PARAMETERS, Call_kiriFillRectangle, NULL },
    { CLASS_SHEET, "get_mesh", "kiriSheet_GetMesh", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, SHEET_GET_MESH_PARAMETERS, Call_kiriSheet_GetMesh, NULL },
    { CLASS_SHEET, "get_dirty", "kiriSheet_GetDirty", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_DIRTY_ARGUMENTS, 4, SHEET_GET_DIRTY_PARAMETERS, Call_kiriSheet_GetDirty, NULL },
    { CLASS_SHEET, "copy_vertices", "kiriSheet_CopyVertices", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 2, 2, SHEET_COPY_VERTICES_ARGUMENTS, 0, NULL, NULL, CopyVertices },
    { CLASS_SHEET, "copy_previous", "kiriSheet_CopyPrevious", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 2, 2, SHEET_COPY_PREVIOUS_ARGUMENTS, 6, SHEET_COPY_PREVIOUS_PARAMETERS, Call_kiriSheet_CopyPrevious, NULL },
    { CLASS_SHEET, "copy_indices16", "kiriSheet_CopyIndices16", RETURNS_RESULT, KIND_BYTES, CLASS_NONE, 2, 2, SHEET_COPY_INDICES16_ARGUMENTS, 5, SHEET_COPY_INDICES16_PARAMETERS, Call_kiriSheet_CopyIndices16, NULL },
    { CLASS_SHEET, "copy_sources", "kiriSheet_CopySources", RETURNS_RESULT, KIND_INTS, CLASS_NONE, 2, 2, SHEET_COPY_SOURCES_ARGUMENTS, 5, SHEET_COPY_SOURCES_PARAMETERS, Call_kiriSheet_CopySources, NULL },
    { CLASS_SHEET, "copy_source_weights", "kiriSheet_CopySourceWeights", RETURNS_RESULT, KIND_FLOATS, CLASS_NONE, 2, 2, SHEET_COPY_SOURCE_WEIGHTS_ARGUMENTS, 5, SHEET_COPY_SOURCE_WEIGHTS_PARAMETERS, Call_kiriSheet_CopySourceWeights, NULL },
    { CLASS_SHEET, "get_solid", "kiriSheet_GetSolid", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_SOLID_ARGUMENTS, 4, SHEET_GET_SOLID_PARAMETERS, Call_kiriSheet_GetSolid, NULL },
    { CLASS_SHEET, "get_collision_points", "kiriSheet_GetCollisionPoints", RETURNS_RESULT, KIND_VECTORS3, CLASS_NONE, 0, 0, NULL, 4, SHEET_GET_COLLISION_POINTS_PARAMETERS, Call_kiriSheet_GetCollisionPoints, NULL },
    { CLASS_SHEET, "get_counts", "kiriSheet_GetCounts", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, SHEET_GET_COUNTS_PARAMETERS, Call_kiriSheet_GetCounts, NULL },
    { CLASS_SHEET, "get_totals", "kiriSheet_GetTotals", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, SHEET_GET_TOTALS_PARAMETERS, Call_kiriSheet_GetTotals, NULL },
    { CLASS_SHEET, "estimate_error", "kiriSheet_EstimateError", RETURNS_RESULT, KIND_REAL, CLASS_NONE, 0, 0, NULL, 3, SHEET_ESTIMATE_ERROR_PARAMETERS, Call_kiriSheet_EstimateError, NULL },
    { CLASS_SHEET, "is_awake", "kiriSheet_IsAwake", RETURNS_RESULT, KIND_BOOL, CLASS_NONE, 0, 0, NULL, 3, SHEET_IS_AWAKE_PARAMETERS, Call_kiriSheet_IsAwake, NULL },
    { CLASS_SHEET, "wake", "kiriSheet_Wake", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, SHEET_WAKE_PARAMETERS, Call_kiriSheet_Wake, NULL },
    { CLASS_SHEET, "transform", "kiriSheet_Transform", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, SHEET_TRANSFORM_ARGUMENTS, 4, SHEET_TRANSFORM_PARAMETERS, Call_kiriSheet_Transform, NULL },
    { CLASS_SHEET, "set_velocity", "kiriSheet_SetVelocity", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, SHEET_SET_VELOCITY_ARGUMENTS, 4, SHEET_SET_VELOCITY_PARAMETERS, Call_kiriSheet_SetVelocity, NULL },
    { CLASS_FRAME, "set_piece_velocity", "kiriFrame_SetPieceVelocity", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, FRAME_SET_PIECE_VELOCITY_ARGUMENTS, 4, FRAME_SET_PIECE_VELOCITY_PARAMETERS, Call_kiriFrame_SetPieceVelocity, NULL },
    { CLASS_SHEET, "set_user_data", "kiriSheet_SetUserData", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_SET_USER_DATA_ARGUMENTS, 3, SHEET_SET_USER_DATA_PARAMETERS, Call_kiriSheet_SetUserData, NULL },
    { CLASS_SHEET, "get_user_data", "kiriSheet_GetUserData", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 3, SHEET_GET_USER_DATA_PARAMETERS, Call_kiriSheet_GetUserData, NULL },
    { CLASS_PIN, "set_user_data", "kiriPin_SetUserData", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, PIN_SET_USER_DATA_ARGUMENTS, 3, PIN_SET_USER_DATA_PARAMETERS, Call_kiriPin_SetUserData, NULL },
    { CLASS_PIN, "get_user_data", "kiriPin_GetUserData", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 3, PIN_GET_USER_DATA_PARAMETERS, Call_kiriPin_GetUserData, NULL },
    { CLASS_FRAME, "set_piece_user_data", "kiriFrame_SetPieceUserData", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, FRAME_SET_PIECE_USER_DATA_ARGUMENTS, 3, FRAME_SET_PIECE_USER_DATA_PARAMETERS, Call_kiriFrame_SetPieceUserData, NULL },
    { CLASS_FRAME, "get_piece_user_data", "kiriFrame_GetPieceUserData", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 3, FRAME_GET_PIECE_USER_DATA_PARAMETERS, Call_kiriFrame_GetPieceUserData, NULL },
    { CLASS_SHEET, "raycast", "kiriSheet_Raycast", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 3, 3, SHEET_RAYCAST_ARGUMENTS, 6, SHEET_RAYCAST_PARAMETERS, Call_kiriSheet_Raycast, NULL },
    { CLASS_WORLD, "raycast", "kiriWorld_Raycast", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 3, 3, WORLD_RAYCAST_ARGUMENTS, 6, WORLD_RAYCAST_PARAMETERS, Call_kiriWorld_Raycast, NULL },
    { CLASS_SHEET, "get_point", "kiriSheet_GetPoint", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_POINT_ARGUMENTS, 4, SHEET_GET_POINT_PARAMETERS, Call_kiriSheet_GetPoint, NULL },
    { CLASS_SHEET, "get_weights", "kiriSheet_GetWeights", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_WEIGHTS_ARGUMENTS, 8, SHEET_GET_WEIGHTS_PARAMETERS, Call_kiriSheet_GetWeights, NULL },
    { CLASS_SHEET, "get_piece", "kiriSheet_GetPiece", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_PIECE_ARGUMENTS, 4, SHEET_GET_PIECE_PARAMETERS, Call_kiriSheet_GetPiece, NULL },
    { CLASS_SHEET, "get_piece_mesh", "kiriSheet_GetPieceMesh", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_PIECE_MESH_ARGUMENTS, 4, SHEET_GET_PIECE_MESH_PARAMETERS, Call_kiriSheet_GetPieceMesh, NULL },
    { CLASS_SHEET, "get_piece_frames", "kiriSheet_GetPieceFrames", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 1, 1, SHEET_GET_PIECE_FRAMES_ARGUMENTS, 5, SHEET_GET_PIECE_FRAMES_PARAMETERS, Call_kiriSheet_GetPieceFrames, NULL },
    { CLASS_FRAME, "get_piece", "kiriFrame_GetPiece", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 3, FRAME_GET_PIECE_PARAMETERS, Call_kiriFrame_GetPiece, NULL },
    { CLASS_FRAME, "detach_piece", "kiriFrame_DetachPiece", RETURNS_RESULT, KIND_OBJECT, CLASS_SHEET, 0, 0, NULL, 3, FRAME_DETACH_PIECE_PARAMETERS, Call_kiriFrame_DetachPiece, NULL },
    { CLASS_FRAME, "destroy_piece", "kiriFrame_DestroyPiece", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, FRAME_DESTROY_PIECE_PARAMETERS, Call_kiriFrame_DestroyPiece, NULL },
    { CLASS_WORLD, "detach_pieces", "kiriWorld_DetachPieces", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 1, 1, WORLD_DETACH_PIECES_ARGUMENTS, 4, WORLD_DETACH_PIECES_PARAMETERS, Call_kiriWorld_DetachPieces, NULL },
    { CLASS_WORLD, "destroy_pieces", "kiriWorld_DestroyPieces", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, WORLD_DESTROY_PIECES_ARGUMENTS, 3, WORLD_DESTROY_PIECES_PARAMETERS, Call_kiriWorld_DestroyPieces, NULL },
    { CLASS_SHEET, "drop_crumbs", "kiriSheet_DropCrumbs", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_DROP_CRUMBS_ARGUMENTS, 4, SHEET_DROP_CRUMBS_PARAMETERS, Call_kiriSheet_DropCrumbs, NULL },
    { CLASS_SHEET, "begin_cut", "kiriBeginCut", RETURNS_RESULT, KIND_OBJECT, CLASS_CUT, 1, 1, SHEET_BEGIN_CUT_ARGUMENTS, 4, SHEET_BEGIN_CUT_PARAMETERS, Call_kiriBeginCut, NULL },
    { CLASS_CUT, "extend", "kiriCut_Extend", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, CUT_EXTEND_ARGUMENTS, 4, CUT_EXTEND_PARAMETERS, Call_kiriCut_Extend, NULL },
    { CLASS_CUT, "end", "kiriCut_End", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, CUT_END_PARAMETERS, Call_kiriCut_End, NULL },
    { CLASS_SHEET, "cut", "kiriSheet_Cut", RETURNS_RESULT, KIND_OBJECT, CLASS_CUT, 1, 1, SHEET_CUT_ARGUMENTS, 5, SHEET_CUT_PARAMETERS, Call_kiriSheet_Cut, NULL },
    { CLASS_SHEET, "slice", "kiriSheet_Slice", RETURNS_RESULT, KIND_OBJECT, CLASS_CUT, 1, 1, SHEET_SLICE_ARGUMENTS, 4, SHEET_SLICE_PARAMETERS, Call_kiriSheet_Slice, NULL },
    { CLASS_KIRI, "get_tearing", "kiriGetTearing", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, KIRI_GET_TEARING_ARGUMENTS, 2, KIRI_GET_TEARING_PARAMETERS, Call_kiriGetTearing, NULL },
    { CLASS_SHEET, "set_tearing", "kiriSheet_SetTearing", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_SET_TEARING_ARGUMENTS, 3, SHEET_SET_TEARING_PARAMETERS, Call_kiriSheet_SetTearing, NULL },
    { CLASS_SHEET, "get_tearing", "kiriSheet_GetTearing", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, SHEET_GET_TEARING_PARAMETERS, Call_kiriSheet_GetTearing, NULL },
    { CLASS_SHEET, "set_tear_line", "kiriSheet_SetTearLine", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, SHEET_SET_TEAR_LINE_ARGUMENTS, 5, SHEET_SET_TEAR_LINE_PARAMETERS, Call_kiriSheet_SetTearLine, NULL },
    { CLASS_WORLD, "begin_blade", "kiriBeginBlade", RETURNS_RESULT, KIND_OBJECT, CLASS_BLADE, 1, 0, WORLD_BEGIN_BLADE_ARGUMENTS, 3, WORLD_BEGIN_BLADE_PARAMETERS, Call_kiriBeginBlade, NULL },
    { CLASS_BLADE, "move_edge", "kiriBlade_MoveEdge", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, BLADE_MOVE_EDGE_ARGUMENTS, 4, BLADE_MOVE_EDGE_PARAMETERS, Call_kiriBlade_MoveEdge, NULL },
    { CLASS_BLADE, "move_ray", "kiriBlade_MoveRay", RETURNS_RESULT, KIND_INT, CLASS_NONE, 3, 3, BLADE_MOVE_RAY_ARGUMENTS, 5, BLADE_MOVE_RAY_PARAMETERS, Call_kiriBlade_MoveRay, NULL },
    { CLASS_BLADE, "end", "kiriBlade_End", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, BLADE_END_PARAMETERS, Call_kiriBlade_End, NULL },
    { CLASS_SHEET, "get_frames", "kiriSheet_GetFrames", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 5, SHEET_GET_FRAMES_PARAMETERS, Call_kiriSheet_GetFrames, NULL },
    { CLASS_FRAME, "hold", "kiriFrame_Hold", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 0, FRAME_HOLD_ARGUMENTS, 4, FRAME_HOLD_PARAMETERS, Call_kiriFrame_Hold, NULL },
    { CLASS_FRAME, "get_state", "kiriFrame_GetState", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, FRAME_GET_STATE_PARAMETERS, Call_kiriFrame_GetState, NULL },
    { CLASS_FRAME, "get_reaction", "kiriFrame_GetReaction", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 4, FRAME_GET_REACTION_PARAMETERS, Call_kiriFrame_GetReaction, NULL },
    { CLASS_FRAME, "apply_force", "kiriFrame_ApplyForce", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, FRAME_APPLY_FORCE_ARGUMENTS, 4, FRAME_APPLY_FORCE_PARAMETERS, Call_kiriFrame_ApplyForce, NULL },
    { CLASS_SHEET, "apply_force", "kiriSheet_ApplyForce", RETURNS_RESULT, KIND_INT, CLASS_NONE, 3, 3, SHEET_APPLY_FORCE_ARGUMENTS, 5, SHEET_APPLY_FORCE_PARAMETERS, Call_kiriSheet_ApplyForce, NULL },
    { CLASS_SHEET, "apply_line_load", "kiriSheet_ApplyLineLoad", RETURNS_RESULT, KIND_INT, CLASS_NONE, 3, 3, SHEET_APPLY_LINE_LOAD_ARGUMENTS, 5, SHEET_APPLY_LINE_LOAD_PARAMETERS, Call_kiriSheet_ApplyLineLoad, NULL },
    { CLASS_SHEET, "apply_pressure", "kiriSheet_ApplyPressure", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_APPLY_PRESSURE_ARGUMENTS, 3, SHEET_APPLY_PRESSURE_PARAMETERS, Call_kiriSheet_ApplyPressure, NULL },
    { CLASS_SHEET, "apply_impulse", "kiriSheet_ApplyImpulse", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, SHEET_APPLY_IMPULSE_ARGUMENTS, 4, SHEET_APPLY_IMPULSE_PARAMETERS, Call_kiriSheet_ApplyImpulse, NULL },
    { CLASS_SHEET, "set_wind", "kiriSheet_SetWind", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_SET_WIND_ARGUMENTS, 3, SHEET_SET_WIND_PARAMETERS, Call_kiriSheet_SetWind, NULL },
    { CLASS_KIRI, "default_pin_def", "kiriDefaultPinDef", RETURNS_NOTHING, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 1, KIRI_DEFAULT_PIN_DEF_PARAMETERS, Call_kiriDefaultPinDef, NULL },
    { CLASS_SHEET, "create_pin", "kiriCreatePin", RETURNS_RESULT, KIND_OBJECT, CLASS_PIN, 1, 1, SHEET_CREATE_PIN_ARGUMENTS, 4, SHEET_CREATE_PIN_PARAMETERS, Call_kiriCreatePin, NULL },
    { CLASS_PIN, "destroy", "kiriDestroyPin", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, PIN_DESTROY_PARAMETERS, Call_kiriDestroyPin, NULL },
    { CLASS_SHEET, "clamp_line", "kiriSheet_ClampLine", RETURNS_RESULT, KIND_OBJECT, CLASS_PIN, 2, 2, SHEET_CLAMP_LINE_ARGUMENTS, 5, SHEET_CLAMP_LINE_PARAMETERS, Call_kiriSheet_ClampLine, NULL },
    { CLASS_SHEET, "hinge_line", "kiriSheet_HingeLine", RETURNS_RESULT, KIND_OBJECT, CLASS_PIN, 2, 2, SHEET_HINGE_LINE_ARGUMENTS, 5, SHEET_HINGE_LINE_PARAMETERS, Call_kiriSheet_HingeLine, NULL },
    { CLASS_PIN, "set_target", "kiriPin_SetTarget", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, PIN_SET_TARGET_ARGUMENTS, 3, PIN_SET_TARGET_PARAMETERS, Call_kiriPin_SetTarget, NULL },
    { CLASS_PIN, "set_pose", "kiriPin_SetPose", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, PIN_SET_POSE_ARGUMENTS, 4, PIN_SET_POSE_PARAMETERS, Call_kiriPin_SetPose, NULL },
    { CLASS_PIN, "set_break_force", "kiriPin_SetBreakForce", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, PIN_SET_BREAK_FORCE_ARGUMENTS, 3, PIN_SET_BREAK_FORCE_PARAMETERS, Call_kiriPin_SetBreakForce, NULL },
    { CLASS_PIN, "get_state", "kiriPin_GetState", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, PIN_GET_STATE_PARAMETERS, Call_kiriPin_GetState, NULL },
    { CLASS_PIN, "get_reaction", "kiriPin_GetReaction", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 4, PIN_GET_REACTION_PARAMETERS, Call_kiriPin_GetReaction, NULL },
    { CLASS_SHEET, "get_pins", "kiriSheet_GetPins", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 5, SHEET_GET_PINS_PARAMETERS, Call_kiriSheet_GetPins, NULL },
    { CLASS_KIRI, "default_seam_def", "kiriDefaultSeamDef", RETURNS_NOTHING, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 1, KIRI_DEFAULT_SEAM_DEF_PARAMETERS, Call_kiriDefaultSeamDef, NULL },
    { CLASS_WORLD, "create_seam", "kiriCreateSeam", RETURNS_RESULT, KIND_OBJECT, CLASS_SEAM, 1, 1, WORLD_CREATE_SEAM_ARGUMENTS, 3, WORLD_CREATE_SEAM_PARAMETERS, Call_kiriCreateSeam, NULL },
    { CLASS_SEAM, "destroy", "kiriDestroySeam", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, SEAM_DESTROY_PARAMETERS, Call_kiriDestroySeam, NULL },
    { CLASS_SEAM, "set_hinge", "kiriSeam_SetHinge", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, SEAM_SET_HINGE_ARGUMENTS, 4, SEAM_SET_HINGE_PARAMETERS, Call_kiriSeam_SetHinge, NULL },
    { CLASS_SEAM, "get_stitch", "kiriSeam_GetStitch", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SEAM_GET_STITCH_ARGUMENTS, 4, SEAM_GET_STITCH_PARAMETERS, Call_kiriSeam_GetStitch, NULL },
    { CLASS_SEAM, "get_count", "kiriSeam_GetCount", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 3, SEAM_GET_COUNT_PARAMETERS, Call_kiriSeam_GetCount, NULL },
    { CLASS_WORLD, "get_seams", "kiriWorld_GetSeams", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 4, WORLD_GET_SEAMS_PARAMETERS, Call_kiriWorld_GetSeams, NULL },
    { CLASS_SHEET, "set_contacts", "kiriSheet_SetContacts", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, SHEET_SET_CONTACTS_ARGUMENTS, 4, SHEET_SET_CONTACTS_PARAMETERS, Call_kiriSheet_SetContacts, NULL },
    { CLASS_SHEET, "get_contact_forces", "kiriSheet_GetContactForces", RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 4, SHEET_GET_CONTACT_FORCES_PARAMETERS, Call_kiriSheet_GetContactForces, NULL },
    { CLASS_KIRI, "default_obstacle_def", "kiriDefaultObstacleDef", RETURNS_NOTHING, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 1, KIRI_DEFAULT_OBSTACLE_DEF_PARAMETERS, Call_kiriDefaultObstacleDef, NULL },
    { CLASS_WORLD, "create_obstacle", "kiriCreateObstacle", RETURNS_RESULT, KIND_OBJECT, CLASS_OBSTACLE, 1, 1, WORLD_CREATE_OBSTACLE_ARGUMENTS, 3, WORLD_CREATE_OBSTACLE_PARAMETERS, Call_kiriCreateObstacle, NULL },
    { CLASS_OBSTACLE, "destroy", "kiriDestroyObstacle", RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 2, OBSTACLE_DESTROY_PARAMETERS, Call_kiriDestroyObstacle, NULL },
    { CLASS_OBSTACLE, "set_pose", "kiriObstacle_SetPose", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, OBSTACLE_SET_POSE_ARGUMENTS, 4, OBSTACLE_SET_POSE_PARAMETERS, Call_kiriObstacle_SetPose, NULL },
    { CLASS_OBSTACLE, "set_velocity", "kiriObstacle_SetVelocity", RETURNS_RESULT, KIND_INT, CLASS_NONE, 2, 2, OBSTACLE_SET_VELOCITY_ARGUMENTS, 4, OBSTACLE_SET_VELOCITY_PARAMETERS, Call_kiriObstacle_SetVelocity, NULL },
    { CLASS_OBSTACLE, "set_surface_velocity", "kiriObstacle_SetSurfaceVelocity", RETURNS_RESULT, KIND_INT, CLASS_NONE, 1, 1, OBSTACLE_SET_SURFACE_VELOCITY_ARGUMENTS, 3, OBSTACLE_SET_SURFACE_VELOCITY_PARAMETERS, Call_kiriObstacle_SetSurfaceVelocity, NULL },
    { CLASS_OBSTACLE, "set_mass", "kiriObstacle_SetMass", RETURNS_RESULT, KIND_INT, CLASS_NONE, 3, 3, OBSTACLE_SET_MASS_ARGUMENTS, 5, OBSTACLE_SET_MASS_PARAMETERS, Call_kiriObstacle_SetMass, NULL },
    { CLASS_OBSTACLE, "get_state", "kiriObstacle_GetState", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 3, OBSTACLE_GET_STATE_PARAMETERS, Call_kiriObstacle_GetState, NULL },
    { CLASS_SHEET, "get_reach", "kiriSheet_GetReach", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 1, SHEET_GET_REACH_ARGUMENTS, 5, SHEET_GET_REACH_PARAMETERS, Call_kiriSheet_GetReach, NULL },
    { CLASS_KIRI, "default_debug_draw", "kiriDefaultDebugDraw", RETURNS_NOTHING, KIND_DICTIONARY, CLASS_NONE, 0, 0, NULL, 1, KIRI_DEFAULT_DEBUG_DRAW_PARAMETERS, Call_kiriDefaultDebugDraw, NULL },
    { CLASS_WORLD, "debug_draw", "kiriWorld_DebugDraw", RETURNS_RESULT, KIND_DICTIONARY, CLASS_NONE, 1, 0, WORLD_DEBUG_DRAW_ARGUMENTS, 0, NULL, NULL, DebugDraw },
    { CLASS_WORLD, "get_last_result", NULL, RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 0, NULL, NULL, GetLastResult },
    { CLASS_WORLD, "take_recording", NULL, RETURNS_RESULT, KIND_BYTES, CLASS_NONE, 0, 0, NULL, 0, NULL, NULL, TakeRecording },
    { CLASS_SHEET, "get_revision", NULL, RETURNS_RESULT, KIND_INT, CLASS_NONE, 0, 0, NULL, 0, NULL, NULL, GetRevision },
    { CLASS_SHEET, "get_surface_arrays", NULL, RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 0, 0, NULL, 0, NULL, NULL, GetSurfaceArrays },
    { CLASS_SHEET, "get_solid_arrays", NULL, RETURNS_RESULT, KIND_ARRAY, CLASS_NONE, 1, 1, SHEET_GET_SOLID_ARRAYS_ARGUMENTS, 0, NULL, NULL, GetSolidArrays },
    { CLASS_SHEET, "get_vertex_buffer", NULL, RETURNS_RESULT, KIND_BYTES, CLASS_NONE, 0, 0, NULL, 0, NULL, NULL, GetVertexBuffer },
};
const int METHOD_COUNT = (int)(sizeof METHODS / sizeof *METHODS);

/* ---- Constants ---- */

const Constant CONSTANTS[] = {
    { "ResultCode", "OK", 0, 0 },
    { "ResultCode", "PENDING", 1, 0 },
    { "ResultCode", "ERROR_ARGUMENT", -1, 0 },
    { "ResultCode", "ERROR_DEF", -2, 0 },
    { "ResultCode", "ERROR_ID", -3, 0 },
    { "ResultCode", "ERROR_MESH", -4, 0 },
    { "ResultCode", "ERROR_STATE", -5, 0 },
    { "ResultCode", "ERROR_MEMORY", -6, 0 },
    { "ResultCode", "DIVERGED", -7, 0 },
    { "ResultCode", "ERROR_LIMIT", -8, 0 },
    { "ResultCode", "ERROR_BUILD", -9, 0 },
    { "ResultCode", "ERROR_DATA", -10, 0 },
    { "ResultCode", "ERROR_REPLAY", -11, 0 },
    { "BudgetLimit", "LEAST_TRIANGLES", 16, 0 },
    { "NoteLimit", "MOST_NOTE_BYTES", 1048576, 0 },
    { "EventType", "EVENT_CUT_FINISHED", 1, 0 },
    { "EventType", "EVENT_PIECE_OFF", 2, 0 },
    { "EventType", "EVENT_FRAME_ADDED", 3, 0 },
    { "EventType", "EVENT_DIVERGED", 4, 0 },
    { "EventType", "EVENT_DEFERRED", 5, 0 },
    { "EventType", "EVENT_PIN_BROKE", 6, 0 },
    { "EventType", "EVENT_PIECE_DETACHED", 7, 0 },
    { "EventType", "EVENT_SEAM_BROKE", 8, 0 },
    { "EventType", "EVENT_TEAR_BEGAN", 9, 0 },
    { "EventType", "EVENT_TEAR_ENDED", 10, 0 },
    { "EventType", "EVENT_STRAINED", 11, 0 },
    { "Stage", "STAGE_CUT", 0, 0 },
    { "Stage", "STAGE_GRID", 1, 0 },
    { "Stage", "STAGE_REGIONS", 2, 0 },
    { "Stage", "STAGE_SHAPE", 3, 0 },
    { "Stage", "STAGE_SAMPLES", 4, 0 },
    { "Stage", "STAGE_CONSTANTS", 5, 0 },
    { "Stage", "STAGE_CONTACT", 6, 0 },
    { "Stage", "STAGE_SOLVE", 7, 0 },
    { "Stage", "STAGE_SKIN", 8, 0 },
    { "Stage", "STAGE_COUNT", 9, 0 },
    { "MaterialPreset", "MATERIAL_PAPER", 0, 0 },
    { "MaterialPreset", "MATERIAL_COTTON", 1, 0 },
    { "MaterialPreset", "MATERIAL_RUBBER", 2, 0 },
    { "MaterialPreset", "MATERIAL_FOIL", 3, 0 },
    { "MaterialPreset", "MATERIAL_CARD", 4, 0 },
    { "MaterialPreset", "MATERIAL_SILK", 5, 0 },
    { "MaterialPreset", "MATERIAL_SHIRTING", 6, 0 },
    { "MaterialPreset", "MATERIAL_WOOL", 7, 0 },
    { "MaterialPreset", "MATERIAL_DENIM", 8, 0 },
    { "MaterialPreset", "MATERIAL_JERSEY", 9, 0 },
    { "MaterialPreset", "MATERIAL_COUNT", 10, 0 },
    { "QualityPreset", "QUALITY_FAST", 0, 0 },
    { "QualityPreset", "QUALITY_BALANCED", 1, 0 },
    { "QualityPreset", "QUALITY_ACCURATE", 2, 0 },
    { "QualityPreset", "QUALITY_COUNT", 3, 0 },
    { "SetupPreset", "SETUP_CURTAIN", 0, 0 },
    { "SetupPreset", "SETUP_PAPER", 1, 0 },
    { "SetupPreset", "SETUP_FLAG", 2, 0 },
    { "SetupPreset", "SETUP_RIBBON", 3, 0 },
    { "SetupPreset", "SETUP_RUBBER", 4, 0 },
    { "SetupPreset", "SETUP_CARD", 5, 0 },
    { "SetupPreset", "SETUP_FOIL", 6, 0 },
    { "SetupPreset", "SETUP_COUNT", 7, 0 },
    { "Model", "MODEL_LINKS", 0, 0 },
    { "Model", "MODEL_AFFINE", 1, 0 },
    { "Model", "MODEL_POINTS", 2, 0 },
    { "Skinning", "SKINNING_LINEAR", 0, 0 },
    { "Skinning", "SKINNING_SMOOTH", 1, 0 },
    { "TimeStepping", "TIME_STEPPING_SECOND_ORDER", 0, 0 },
    { "TimeStepping", "TIME_STEPPING_EULER", 1, 0 },
    { "PinType", "PIN_POINT", 0, 0 },
    { "PinType", "PIN_HINGE", 1, 0 },
    { "PinType", "PIN_CLAMP", 2, 0 },
    { "ObstacleType", "OBSTACLE_PLANE", 0, 0 },
    { "ObstacleType", "OBSTACLE_SPHERE", 1, 0 },
    { "ObstacleType", "OBSTACLE_CAPSULE", 2, 0 },
    { "ObstacleType", "OBSTACLE_BOX", 3, 0 },
    { "ObstacleType", "OBSTACLE_CYLINDER", 4, 0 },
    { "ObstacleType", "OBSTACLE_PRISM", 5, 0 },
    { "DrawFlag", "DRAW_TRIANGLES", 1, 1 },
    { "DrawFlag", "DRAW_EDGES", 2, 1 },
    { "DrawFlag", "DRAW_BORDERS", 4, 1 },
    { "DrawFlag", "DRAW_FRAMES", 8, 1 },
    { "DrawFlag", "DRAW_LINKS", 16, 1 },
    { "DrawFlag", "DRAW_PINS", 32, 1 },
    { "DrawFlag", "DRAW_CONTACTS", 64, 1 },
    { "DrawFlag", "DRAW_BLADES", 128, 1 },
    { "DrawFlag", "DRAW_BOXES", 256, 1 },
    { "DrawFlag", "DRAW_OBSTACLES", 512, 1 },
    { "DrawFlag", "DRAW_POINTS", 1024, 1 },
    { "DrawFlag", "DRAW_ALL", 2047, 1 },
};
const int CONSTANT_COUNT = (int)(sizeof CONSTANTS / sizeof *CONSTANTS);
