// Code generated from kiri.h by make bindings. DO NOT EDIT.

package kiri

// #include <kiri/kiri.h>
import "C"

import (
	"runtime"
	"unsafe"
)

// Version of the header.
const Version = "0.34.0"

type ResultCode int32

const (
	Ok ResultCode = 0
	// success; work is left for later ticks
	Pending ResultCode = 1
	// null, NaN, infinite, outside the documented range, or beyond 4e37 m, m/s or 1/s
	ErrArgument ResultCode = -1
	// the def was not filled by its kiriDefault function: call that first
	ErrDef ResultCode = -2
	// unknown or stale id, or the id of another kind
	ErrID ResultCode = -3
	// the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping
	ErrMesh ResultCode = -4
	// the call comes in the wrong order, or from a callback that may not make it
	ErrState ResultCode = -5
	// the allocator returned null
	ErrMemory ResultCode = -6
	// the motion of a sheet could not be continued; the sheet was stopped where it was
	Diverged ResultCode = -7
	// all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world
	ErrLimit ResultCode = -8
	// floats are not computed as on other machines, see kiriCreateWorld
	ErrBuild ResultCode = -9
	// the bytes are damaged, cut short, of another kind, or of a later version
	ErrData ResultCode = -10
	// a repeated call gave another result than its recording has
	ErrReplay ResultCode = -11
)

var namesResultCode = map[ResultCode]string{
	0:   "Ok",
	1:   "Pending",
	-1:  "ErrArgument",
	-2:  "ErrDef",
	-3:  "ErrID",
	-4:  "ErrMesh",
	-5:  "ErrState",
	-6:  "ErrMemory",
	-7:  "Diverged",
	-8:  "ErrLimit",
	-9:  "ErrBuild",
	-10: "ErrData",
	-11: "ErrReplay",
}

func (v ResultCode) String() string { return namesResultCode[v] }

// Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance: using
// 30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut takes
// effect; the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it (manual,
// budget).
type BudgetLimit int32

const (
	LeastTriangles BudgetLimit = 16
)

var namesBudgetLimit = map[BudgetLimit]string{
	16: "LeastTriangles",
}

func (v BudgetLimit) String() string { return namesBudgetLimit[v] }

type NoteLimit int32

const (
	MostNoteBytes NoteLimit = 1048576
)

var namesNoteLimit = map[NoteLimit]string{
	1048576: "MostNoteBytes",
}

func (v NoteLimit) String() string { return namesNoteLimit[v] }

// Events since the start of the last tick that was not refused.
type EventType int32

const (
	// cut: all of it is in the mesh; the id is stale from now on
	EventCutFinished EventType = 1
	// frame (its first, which names it), crumb, area: a part came off, never the largest
	EventPieceOff EventType = 2
	// frame
	EventFrameAdded EventType = 3
	// the sheet was stopped
	EventDiverged EventType = 4
	// stage, waiting: the budget ended in this stage of the sheet's work
	EventDeferred EventType = 5
	// pin: its force exceeded breakForce; the id is stale from now on
	EventPinBroke EventType = 6
	// sheet (the new one), frame, area: a pending kiriFrame_DetachPiece is done
	EventPieceDetached EventType = 7
	// seam, stitches: some stitches broke; with none left the id is stale from now on
	EventSeamBroke EventType = 8
	// cut: the library began it, see kiriTearing
	EventTearBegan EventType = 9
	// cut: the tear has rested for half a second; the id is stale from now on
	EventTearEnded EventType = 10
	// area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s
	EventStrained EventType = 11
)

var namesEventType = map[EventType]string{
	1:  "EventCutFinished",
	2:  "EventPieceOff",
	3:  "EventFrameAdded",
	4:  "EventDiverged",
	5:  "EventDeferred",
	6:  "EventPinBroke",
	7:  "EventPieceDetached",
	8:  "EventSeamBroke",
	9:  "EventTearBegan",
	10: "EventTearEnded",
	11: "EventStrained",
}

func (v EventType) String() string { return namesEventType[v] }

// The stages of a tick in their order.
type Stage int32

const (
	// splits the mesh along the blade
	StageCut Stage = 0
	// cells and their connections
	StageGrid Stage = 1
	// geodesic distances, regions, links; places frames
	StageRegions Stage = 2
	// shape functions
	StageShape Stage = 3
	// weights of vertices and collision points
	StageSamples Stage = 4
	// mass, the pattern of the solver's matrix, and the commit
	StageConstants Stage = 5
	// contacts with obstacles, other sheets and other pieces
	StageContact Stage = 6
	// the motion of the frames
	StageSolve Stage = 7
	// positions and normals of the mesh
	StageSkin  Stage = 8
	StageCount Stage = 9
)

var namesStage = map[Stage]string{
	0: "StageCut",
	1: "StageGrid",
	2: "StageRegions",
	3: "StageShape",
	4: "StageSamples",
	5: "StageConstants",
	6: "StageContact",
	7: "StageSolve",
	8: "StageSkin",
	9: "StageCount",
}

func (v Stage) String() string { return namesStage[v] }

// Materials to start from; src/world/kiri_api_world.c has the sources. From SILK on: measured cloths (manual, sheets)
type MaterialPreset int32

const (
	// printing paper, 0.11 mm
	MaterialPaper MaterialPreset = 0
	// cloth, 0.5 mm; the default of a sheet def
	MaterialCotton MaterialPreset = 1
	// natural rubber, 1 mm
	MaterialRubber MaterialPreset = 2
	// aluminium, 16 um
	MaterialFoil MaterialPreset = 3
	// paperboard, 0.4 mm
	MaterialCard     MaterialPreset = 4
	MaterialSilk     MaterialPreset = 5
	MaterialShirting MaterialPreset = 6
	MaterialWool     MaterialPreset = 7
	MaterialDenim    MaterialPreset = 8
	MaterialJersey   MaterialPreset = 9
	MaterialCount    MaterialPreset = 10
)

var namesMaterialPreset = map[MaterialPreset]string{
	0:  "MaterialPaper",
	1:  "MaterialCotton",
	2:  "MaterialRubber",
	3:  "MaterialFoil",
	4:  "MaterialCard",
	5:  "MaterialSilk",
	6:  "MaterialShirting",
	7:  "MaterialWool",
	8:  "MaterialDenim",
	9:  "MaterialJersey",
	10: "MaterialCount",
}

func (v MaterialPreset) String() string { return namesMaterialPreset[v] }

// Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual, accuracy).
type QualityPreset int32

const (
	QualityFast     QualityPreset = 0
	QualityBalanced QualityPreset = 1
	QualityAccurate QualityPreset = 2
	QualityCount    QualityPreset = 3
)

var namesQualityPreset = map[QualityPreset]string{
	0: "QualityFast",
	1: "QualityBalanced",
	2: "QualityAccurate",
	3: "QualityCount",
}

func (v QualityPreset) String() string { return namesQualityPreset[v] }

// Kinds of sheets to begin with. They want a tick of 1/60 s with 4 substeps; curtain and card do with 2.
type SetupPreset int32

const (
	SetupCurtain SetupPreset = 0
	SetupPaper   SetupPreset = 1
	SetupFlag    SetupPreset = 2
	SetupRibbon  SetupPreset = 3
	SetupRubber  SetupPreset = 4
	SetupCard    SetupPreset = 5
	SetupFoil    SetupPreset = 6
	SetupCount   SetupPreset = 7
)

var namesSetupPreset = map[SetupPreset]string{
	0: "SetupCurtain",
	1: "SetupPaper",
	2: "SetupFlag",
	3: "SetupRibbon",
	4: "SetupRubber",
	5: "SetupCard",
	6: "SetupFoil",
	7: "SetupCount",
}

func (v SetupPreset) String() string { return namesSetupPreset[v] }

// How a sheet deforms (manual, sheets). Rigid frames have 6 unknowns, affine ones 12.
type Model int32

const (
	// rigid frames joined by links: paper, foil, stiff cloth
	ModelLinks Model = 0
	// affine frames joined by links: cloth and rubber that stretch inside a region
	ModelAffine Model = 1
	// affine frames, strains at integration points, as in the paper. Thin sheets hardly bend
	ModelPoints Model = 2
)

var namesModel = map[Model]string{
	0: "ModelLinks",
	1: "ModelAffine",
	2: "ModelPoints",
}

func (v Model) String() string { return namesModel[v] }

// The surface between the frames, which blades and contacts meet (manual, sheets).
type Skinning int32

const (
	// each frame carries a flat patch; the weights blend them (equation 1 of the paper)
	SkinningLinear Skinning = 0
	// patches bend and stretch as their neighbours lie: no bumps at the frames
	SkinningSmooth Skinning = 1
)

var namesSkinning = map[Skinning]string{
	0: "SkinningLinear",
	1: "SkinningSmooth",
}

func (v Skinning) String() string { return namesSkinning[v] }

// Integration in time, with one linear system an iteration. Steps with contacts or new pins take backward Euler.
type TimeStepping int32

const (
	// TR-BDF2, of second order: keeps the energy of motion
	TimeSteppingSecondOrder TimeStepping = 0
	// backward Euler, of first order: takes energy out of a swing, more in longer steps
	TimeSteppingEuler TimeStepping = 1
)

var namesTimeStepping = map[TimeStepping]string{
	0: "TimeSteppingSecondOrder",
	1: "TimeSteppingEuler",
}

func (v TimeStepping) String() string { return namesTimeStepping[v] }

// The types of pins.
type PinType int32

const (
	PinPoint PinType = 0
	PinHinge PinType = 1
	PinClamp PinType = 2
)

var namesPinType = map[PinType]string{
	0: "PinPoint",
	1: "PinHinge",
	2: "PinClamp",
}

func (v PinType) String() string { return namesPinType[v] }

// A body that sheets touch: a floor, a ball, a crate of another engine. It moves on with its velocities alone: set
// pose and velocity before a tick, and apply the impulse of its state after it (manual, contact). Lengths: up to 1e6
// m.
type ObstacleType int32

const (
	// all below the plane through its position; the third column of its rotation points out
	ObstaclePlane ObstacleType = 0
	// radius
	ObstacleSphere ObstacleType = 1
	// radius, height: of its axis, the third column, between the middles of its round ends
	ObstacleCapsule ObstacleType = 2
	// size: lengths of its edges along the columns of its rotation
	ObstacleBox ObstacleType = 3
	// radius, height: along the third column
	ObstacleCylinder ObstacleType = 4
	// outline: convex, in the plane of the first two columns; height along the third, 0: endless
	ObstaclePrism ObstacleType = 5
)

var namesObstacleType = map[ObstacleType]string{
	0: "ObstaclePlane",
	1: "ObstacleSphere",
	2: "ObstacleCapsule",
	3: "ObstacleBox",
	4: "ObstacleCylinder",
	5: "ObstaclePrism",
}

func (v ObstacleType) String() string { return namesObstacleType[v] }

// The things to draw.
type DrawFlag uint32

const (
	// a triangle for each triangle of the mesh, in a colour of its piece; sleeping: pale
	DrawTriangles DrawFlag = 1
	// a line for each edge between two triangles
	DrawEdges DrawFlag = 2
	// a line for each edge of the outline, of lips and of folds
	DrawBorders DrawFlag = 4
	// a point and three axes each: u red, v green, normal blue; held ones red
	DrawFrames DrawFlag = 8
	// two lines each: from frame to frame by the middle of their border
	DrawLinks DrawFlag = 16
	// a point at the target; a line to the point of the material, or along the line
	DrawPins DrawFlag = 32
	// a point and its normal for each that pushed as the last tick ended
	DrawContacts DrawFlag = 64
	// a line along the edge, and a point in each layer that it is in
	DrawBlades DrawFlag = 128
	// twelve lines around each piece
	DrawBoxes DrawFlag = 256
	// lines along edges and rims, without the rounding; a plane is a square
	DrawObstacles DrawFlag = 512
	// a point for each collision point
	DrawPoints DrawFlag = 1024
	DrawAll    DrawFlag = 2047
)

var namesDrawFlag = map[DrawFlag]string{
	1:    "DrawTriangles",
	2:    "DrawEdges",
	4:    "DrawBorders",
	8:    "DrawFrames",
	16:   "DrawLinks",
	32:   "DrawPins",
	64:   "DrawContacts",
	128:  "DrawBlades",
	256:  "DrawBoxes",
	512:  "DrawObstacles",
	1024: "DrawPoints",
	2047: "DrawAll",
}

func (v DrawFlag) String() string { return namesDrawFlag[v] }

// SheetID is an id as C has it; 0 is none.
type SheetID uint32

// CutID is an id as C has it; 0 is none.
type CutID uint32

// FrameID is an id as C has it; 0 is none.
type FrameID uint32

// PinID is an id as C has it; 0 is none.
type PinID uint32

// ObstacleID is an id as C has it; 0 is none.
type ObstacleID uint32

// BladeID is an id as C has it; 0 is none.
type BladeID uint32

// SeamID is an id as C has it; 0 is none.
type SeamID uint32

// Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance: using
// 30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut takes
// effect; the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it (manual,
// budget).
type Budget struct {
	// split by blades; 0, or KIRI_LEAST_TRIANGLES and more
	Triangles int32
	// visited, or with a new distance: grid, regions, shape functions. A link counts as a cell
	Cells int32
	// vertices and collision points with new weights, and the cost of the commit, paid before it
	Samples int32
	// linear systems, 30 to 60 us each; a large one counts as several (manual, budget)
	Iterations int32
}

// An event. It fills the fields that its type names, and `sheet`. Other fields are 0, and `stage` is -1.
type Event struct {
	// KIRI_EVENT_...
	Type  EventType
	Sheet SheetID
	// 0: none
	Cut CutID
	// 0: none
	Frame FrameID
	// 0: none
	Pin PinID
	// 1: the piece is a crumb, see kiriSheetDef
	Crumb int32
	// m^2, or 0
	Area float32
	// KIRI_STAGE_..., or -1
	Stage Stage
	// points and ends of cuts that are pending or in work; or 0
	Waiting int32
	// 0: none
	Seam SeamID
	// that the seam has left, or 0
	Stitches int32
}

// Work and time of the last tick.
type Profile struct {
	// of the last tick; zero without a clock
	Seconds [9]float64
	// blade segments that took effect
	CutSegments int32
	// Items in the units of kiriBudget. An item that takes more work counts more than once.
	TrianglesSplit int32
	// Items in the units of kiriBudget. An item that takes more work counts more than once.
	CellsSettled int32
	// Items in the units of kiriBudget. An item that takes more work counts more than once.
	SamplesRefreshed int32
	// Items in the units of kiriBudget. An item that takes more work counts more than once.
	SolverIterations int32
	// Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
	CellsChanged int32
	// Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
	WeightsChanged int32
	// Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
	VerticesChanged int32
	// Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
	PointsChanged int32
	// Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts).
	LinksChanged int32
	// sheets in which a cut took effect; linear systems, large and small
	Commits int32
	// sheets in which a cut took effect; linear systems, large and small
	SystemsSolved int32
	// planes given to the solver: by the host, by obstacles, and between sheets
	Contacts int32
	// pairs of sheets or pieces that are near each other and not both asleep
	SheetPairs int32
	// The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m.
	LargestJump float64
	// The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m.
	LargestFade float64
}

// The material of a sheet: homogeneous, isotropic.
type Material struct {
	// Pa, above 0
	YoungsModulus float32
	// 0 to below 0.5
	PoissonsRatio float32
	// m, above 0
	Thickness float32
	// kg/m^3, above 0
	Density float32
	// 1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets)
	AirDamping float32
	// s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
	FlexDamping float32
	// Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not planar
	YieldStress float32
	// modulus beyond the yield stress, relative to youngsModulus; 0 to below 1
	Hardening float32
	// 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets)
	Slack float32
	// sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0
	Detail int32
	// 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0
	RestCurvature [3]float32
}

// Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual, accuracy).
type Quality struct {
	// control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9
	FramesAlong int32
	// for the sheet def
	GridResolution int32
	// for the sheet def
	Iterations int32
	// for kiriWorld_Tick
	Substeps int32
}

// Options of the paper, for comparison; part of the sheet def. Default 0, but for integrationOrder.
type PaperOptions struct {
	// 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits
	FromScratch int32
	// 1: only new frames take their motion from the surface: it jumps, momentum is not kept
	Popping int32
	// 1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS
	LinearWeights int32
	// KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
	// frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work.
	IntegrationPoints int32
	// KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
	// frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work.
	IntegrationOrder int32
}

// A sheet: its rest shape, start, material, and computation.
type SheetDef struct {
	cookie uint32
	// The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge; holes and several parts
	// are allowed. Two edges in the same place with different vertices are the lips of a cut (manual, meshes). 2 floats
	// (u, v) a vertex
	RestPositions [][2]float32
	// 3 a triangle
	Indices [][3]int32
	// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
	Position [3]float32
	// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
	AxisU [3]float32
	// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
	AxisV [3]float32
	// Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s.
	Velocity [3]float32
	Material Material
	// grid squares along the longer side, 1 to 4096; default 32
	GridResolution int32
	// m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side
	SnapDistance float32
	// m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none
	WeldDistance float32
	// Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
	// frames are spread evenly, in straight rows over stiff rectangles, or fewer: one for two squares of the grid.
	// frameCount 0: regions are split, after cuts too, to frameLength; 0: it follows from `accuracy`, the relative error
	// (manual, accuracy). 0, or 1 and more; default 24
	FrameCount int32
	// m; used where frameCount is 0; default 0
	FrameLength float32
	// 1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default 0.02
	Accuracy float32
	// 2 floats a frame, or null
	FramePoints [][2]float32
	// re-sampling stops here; default 256
	MaxFrames int32
	// Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
	// beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy).
	// default 0.95, 0
	RigidWeight float32
	// Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
	// beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy).
	// default 0.95, 0
	RigidArea float32
	// m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
	CrumbArea float32
	// of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
	Friction float32
	// m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
	ContactThickness float32
	// obstacles and sheets touch if they share a set bit. Default: all
	Groups uint32
	// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1:
	// layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
	TouchesSheets int32
	// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1:
	// layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
	SelfContact int32
	// for kiriSheet_SetContacts: spread evenly, at least one in every piece; default 0: none
	CollisionPoints int32
	// Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
	Iterations int32
	// m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
	SleepSpeed float32
	// KIRI_MODEL_..., default KIRI_MODEL_LINKS
	Model Model
	// KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH
	Skinning Skinning
	// 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0
	Planar int32
	// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
	TimeStepping TimeStepping
	// s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2
	FadeTime float32
	// 1: every tick computes normals (default). 0: kiriMesh has none, which saves time
	Normals int32
	// default: all off
	Paper PaperOptions
}

// Sheet settings that can change after creation. Fields mean the same as in kiriSheetDef.
type SheetSettings struct {
	cookie   uint32
	Material Material
	// re-sampling stops here; default 256
	MaxFrames int32
	// m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0
	CrumbArea float32
	// of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5
	Friction float32
	// m between sheets, half to obstacles. 0: the material's, at least a 20th of a square
	ContactThickness float32
	// obstacles and sheets touch if they share a set bit. Default: all
	Groups uint32
	// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1:
	// layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
	TouchesSheets int32
	// touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact 1:
	// layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0.
	SelfContact int32
	// Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual
	Iterations int32
	// m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never
	SleepSpeed float32
	// KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH
	Skinning Skinning
	// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
	TimeStepping TimeStepping
	// stays 0 with paper.popping
	FadeTime float32
	// 1: every tick computes normals (default). 0: kiriMesh has none, which saves time
	Normals int32
}

// A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and each side has its
// own frames. Lines may end in the material, meet and cross; cuts go through or along them (manual, folding).
type Fold struct {
	// m
	From [2]float32
	// m
	To [2]float32
	// N m/rad per metre of the line, 0 or more; 0: a free hinge
	Stiffness float32
	// rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it
	RestAngle float32
	// N m per metre: it bends for good beyond, with a yieldStress. 0: no limit
	YieldMoment float32
}

// A fold, its mean angle (rad, as restAngle) and the length (m) along which it joins two sides: not cut, nor rigid.
type FoldState struct {
	Fold   Fold
	Angle  float64
	Length float64
}

// The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision grows when indices
// or vertices are added or changed. Sources have the precision of the library, 2^-29 of the sheet.
type Mesh struct {
	// 3 a vertex, m, world
	Positions View[[3]float32]
	// 3 a vertex, unit; null where the sheet makes none
	Normals View[[3]float32]
	// 2 a vertex, m
	RestPositions View[[2]float32]
	// 3 a triangle
	Indices View[[3]int32]
	// 1 a vertex: the triangle of the def that contains it,
	SourceTriangles View[int32]
	// 3 a vertex: and its barycentric coordinates there
	SourceWeights View[[3]float32]
	VertexCount   int32
	TriangleCount int32
	Revision      uint32
}

// `count` items from `first` on.
type Range struct {
	First int32
	Count int32
}

// Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change in every tick.
type Dirty struct {
	// up to the last one of the mesh
	NewVertices Range
	// up to the last one of the mesh
	NewTriangles Range
	// the smallest ranges that hold all older ones with other data
	OldVertices Range
	// the smallest ranges that hold all older ones with other data
	OldTriangles Range
	// for the next call
	Revision uint32
}

// The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips. First the vertices
// of kiriMesh on the side of the normal, then the same on the other side, then four for each border edge.
type Solid struct {
	// 3 a vertex, m, world
	Positions View[[3]float32]
	// 3 a vertex, unit, outwards
	Normals View[[3]float32]
	// 2 a vertex, m
	RestPositions View[[2]float32]
	// 3 a triangle, counter-clockwise from outside
	Indices View[[3]int32]
	// 1 a vertex: its vertex in kiriMesh
	Sources       View[int32]
	VertexCount   int32
	TriangleCount int32
	// rims begin at this triangle
	RimTriangle int32
}

// Numbers of items in a sheet.
type Counts struct {
	Vertices        int32
	Triangles       int32
	Cells           int32
	Frames          int32
	Links           int32
	Pieces          int32
	CollisionPoints int32
}

// m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s and kg m^2/s.
type Totals struct {
	Area            float64
	Mass            float64
	KineticEnergy   float64
	ElasticEnergy   float64
	Center          [3]float64
	Momentum        [3]float64
	AngularMomentum [3]float64
}

// The first point where a ray meets a sheet.
type Hit struct {
	// m: where to cut
	RestPoint [2]float32
	// m, world
	Position [3]float32
	// unit
	Normal [3]float32
	// m along the direction, which need not be a unit vector
	Distance float32
	// -1: none
	Triangle int32
}

// A point of the material on the visible surface.
type PointState struct {
	// m, world; unit
	Position [3]float32
	// m, world; unit
	Normal [3]float32
	// m/s, by the weights of the point
	Velocity [3]float32
	// the frame of its region; it also names the piece
	Frame FrameID
}

// A connected part of a sheet. Any of its frames names it. Indices go from 0 to kiriCounts.pieces, and change when a
// piece comes off or goes (kiriFrame_GetPiece). Cuts with pending work have separated nothing yet.
type PieceState struct {
	// m^2, kg
	Area float64
	// m^2, kg
	Mass float64
	// of mass, m; kg m/s, kg m^2/s about the origin
	Center [3]float64
	// of mass, m; kg m/s, kg m^2/s about the origin
	Momentum [3]float64
	// of mass, m; kg m/s, kg m^2/s about the origin
	AngularMomentum [3]float64
	// m, world: the smallest box around its vertices
	Lower [3]float32
	// m, world: the smallest box around its vertices
	Upper [3]float32
	// counts
	Frames int32
	// counts
	Vertices int32
	// counts
	Triangles int32
	// counts
	CollisionPoints int32
	// 1: see kiriSheetDef
	Crumb int32
	// 1: see sleepSpeed
	Asleep int32
}

// The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all pieces, piece by piece.
type PieceMesh struct {
	// 1 a vertex: its index in kiriMesh
	Vertices View[int32]
	// 1 a triangle: its index in kiriMesh
	Triangles View[int32]
	// 3 a triangle, as in kiriMesh: draw them
	Indices View[[3]int32]
	// 1 a point, see kiriSheet_GetCollisionPoints
	CollisionPoints     View[int32]
	VertexCount         int32
	TriangleCount       int32
	CollisionPointCount int32
}

// How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or a sharp notch,
// goes on across the tension where the sheet would set more energy free than the tear takes. Two frames go with its
// tip. Where a mean tension over a distance of frames exceeds the strength, a tear begins at the nearest border, one
// at a time.
type Tearing struct {
	// J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear
	Toughness float32
	// Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored
	Strength float32
	// direction in the rest plane along which it tears; 0, 0: none
	Grain [2]float32
	// toughness across the grain, relative to along it; below 1: 1
	GrainRatio float32
	// m/s in the rest plane, 0 or more; 0: no limit but the distance above
	MaxSpeed float32
	// tips that tear in a tick, 0 or more; 0: 8. Others wait
	MaxTips int32
}

// Pose, motion and region of a frame.
type FrameState struct {
	// m
	RestPoint [2]float32
	// m, world: of the rest point
	Position [3]float32
	// columns: direction of u, of v, normal; an affine frame: columns of A, which stretch
	Rotation [9]float32
	// m/s, rad/s
	Velocity [3]float32
	// m/s, rad/s
	AngularVelocity [3]float32
	// m^2 of its region; kg
	Area float32
	// m^2 of its region; kg
	Mass float32
	// 1: moved by the host, see kiriFrame_Hold
	Held int32
}

// Air past the sheet. v is the velocity of the air less the material's, n the normal: each square metre gets density
// / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)); airDamping acts in any density. A sheet can sleep in wind.
type Wind struct {
	// m/s
	Velocity [3]float32
	// kg/m^3, 0 or more; air: 1.2
	Density float32
	// 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
	Drag float32
	// 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01)
	Lift float32
}

// A pin holds a point of the material at its target by a spring.
type PinDef struct {
	cookie uint32
	// m, in the material
	RestPoint [2]float32
	// m, world
	Target [3]float32
	// N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target (manual)
	Stiffness float32
	// N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never
	BreakForce float32
	// 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there
	Obstacle ObstacleID
}

// Type and target of a pin.
type PinState struct {
	// KIRI_PIN_...
	Type  PinType
	Sheet SheetID
	// m, rest plane: the ends of the line, or the point twice
	From [2]float32
	// m, rest plane: the ends of the line, or the point twice
	To [2]float32
	// m, world
	Target [3]float32
	// of a line; of a point the identity
	Rotation [9]float32
	// N, or 0
	BreakForce float32
	// that the target moves with; 0: none
	Obstacle ObstacleID
}

// A seam joins two lines in the material, of two sheets or of one: stitches join points at the same parts of both.
// Cuts go through a seam, and pieces keep their stitches. A stitch ends with the piece of a point (manual, sewing).
type SeamDef struct {
	cookie uint32
	// of the same model, and not planar
	SheetA SheetID
	// of the same model, and not planar
	SheetB SheetID
	// 2 floats a point, m, in the material, such as its edge; copied
	LineA [][2]float32
	// 2 floats a point
	LineB [][2]float32
	// 2 to 4096; 0 (default): three for two distances of frames
	Stitches int32
	// N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free
	Stiffness float32
	// rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal
	RestAngle float32
	// N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never
	BreakForce float32
}

// A stitch, as after the last tick.
type Stitch struct {
	SheetA SheetID
	SheetB SheetID
	// m, in the material
	RestA [2]float32
	// m, in the material
	RestB [2]float32
	// m, world: where both drawn lips meet; their middle while they are apart
	Position [3]float32
	// m: distance of the two points; a stitch yields by micrometres under the sheet's weight
	Gap float32
	// N, on sheet A: mean over the last tick that moved it
	Force [3]float32
	// rad, as restAngle
	Angle float32
}

// A contact of a point of the material: the plane dot(normal, x) = offset keeps the point on its upper side, with
// Coulomb friction. The host computes planes from the visible surface for each tick. Planes out of reach do nothing.
type Contact struct {
	// index of the collision point; -1: restPoint names the point
	Point int32
	// m, in the material; read only where point is -1
	RestPoint [2]float32
	// unit, out of the obstacle
	Normal [3]float32
	// m: of the obstacle's surface at the start of the tick
	Offset float32
	// m/s: of the obstacle at the contact. The plane moves with it within the tick
	Velocity [3]float32
	// 0 or more: of both sides together
	Friction float32
	// 1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid
	InverseMass float32
	// m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s
	PushSpeed float32
	// a number of the host. Contacts with one number press on one obstacle, and share its mass
	Obstacle int32
}

// The result of a contact in the last tick.
type ContactForce struct {
	// N s, on the sheet: the sum over the tick. The obstacle gets the opposite
	Impulse [3]float64
	// m, world: the point of the sheet at the end of the tick
	Position [3]float64
	// m: of the point below the plane at the end of the tick; below 0: above it
	Depth float64
	// as in the contact
	Point int32
	// as in the contact
	Obstacle int32
}

// An obstacle: its shape, pose, motion, and mass.
type ObstacleDef struct {
	cookie uint32
	// KIRI_OBSTACLE_...
	Type ObstacleType
	// m
	Size [3]float32
	// m
	Radius float32
	// m
	Height float32
	// 2 floats a corner, m, counter-clockwise; copied. Null: no prism
	Outline [][2]float32
	// m, 0 or more: prisms and boxes grow by this, with round edges. Default 0
	Rounding float32
	// m, world
	Position [3]float32
	// columns; default: the axes of the world
	Rotation [9]float32
	// m/s, of its position
	Velocity [3]float32
	// rad/s
	AngularVelocity [3]float32
	// m/s, world: of its surface, added to its motion, as of a conveyor
	SurfaceVelocity [3]float32
	// 0 or more; default 0.5
	Friction float32
	// kg; 0 (default): nothing moves it
	Mass float32
	// kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz. Positive definite, but
	// for axes whose numbers are all 0: it does not turn about these
	Inertia [6]float32
	// m, from its position in its own axes
	CenterOfMass [3]float32
	// obstacles with the same number, except 0, are parts of one body; each has its whole mass
	Body uint32
	// m/s, above 0: maximum speed at which points inside are pushed out. Default 1
	PushSpeed float32
	// see the sheet def. Default: all
	Groups uint32
}

// Pose, motion, and reaction of an obstacle.
type ObstacleState struct {
	Position        [3]float32
	Rotation        [9]float32
	Velocity        [3]float32
	AngularVelocity [3]float32
	// N s, N m s about its centre of mass: of sheets and pins in the last tick
	Impulse [3]float64
	// N s, N m s about its centre of mass: of sheets and pins in the last tick
	AngularImpulse [3]float64
	// that pushed in the last tick
	Contacts int32
}

// A corner to draw, in a layout for a GPU.
type DrawVertex struct {
	// m, world
	Position [3]float32
	// red in its lowest byte, then green, blue, and opacity, which is 255
	Color uint32
}

var _ [0]struct{} = [unsafe.Sizeof(Budget{}) - C.sizeof_kiriBudget]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Event{}) - C.sizeof_kiriEvent]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Profile{}) - C.sizeof_kiriProfile]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Material{}) - C.sizeof_kiriMaterial]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Quality{}) - C.sizeof_kiriQuality]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PaperOptions{}) - C.sizeof_kiriPaperOptions]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(SheetSettings{}) - C.sizeof_kiriSheetSettings]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Fold{}) - C.sizeof_kiriFold]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(FoldState{}) - C.sizeof_kiriFoldState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Range{}) - C.sizeof_kiriRange]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Dirty{}) - C.sizeof_kiriDirty]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Counts{}) - C.sizeof_kiriCounts]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Totals{}) - C.sizeof_kiriTotals]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Hit{}) - C.sizeof_kiriHit]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PointState{}) - C.sizeof_kiriPointState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PieceState{}) - C.sizeof_kiriPieceState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Tearing{}) - C.sizeof_kiriTearing]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(FrameState{}) - C.sizeof_kiriFrameState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Wind{}) - C.sizeof_kiriWind]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PinDef{}) - C.sizeof_kiriPinDef]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PinState{}) - C.sizeof_kiriPinState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Stitch{}) - C.sizeof_kiriStitch]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Contact{}) - C.sizeof_kiriContact]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(ContactForce{}) - C.sizeof_kiriContactForce]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(ObstacleState{}) - C.sizeof_kiriObstacleState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(DrawVertex{}) - C.sizeof_kiriDrawVertex]struct{}{}

// Arrays stay where they are until the pinner lets go.
func (def *SheetDef) toC(pinner *runtime.Pinner) *C.kiriSheetDef {
	c := new(C.kiriSheetDef)
	c.cookie = C.uint32_t(def.cookie)
	if len(def.RestPositions) > 0 {
		pinner.Pin(&def.RestPositions[0])
		c.restPositions = (*C.float)(unsafe.Pointer(&def.RestPositions[0]))
	}
	c.vertexCount = C.int32_t(len(def.RestPositions))
	if len(def.Indices) > 0 {
		pinner.Pin(&def.Indices[0])
		c.indices = (*C.int32_t)(unsafe.Pointer(&def.Indices[0]))
	}
	c.triangleCount = C.int32_t(len(def.Indices))
	*(*[3]float32)(unsafe.Pointer(&c.position)) = def.Position
	*(*[3]float32)(unsafe.Pointer(&c.axisU)) = def.AxisU
	*(*[3]float32)(unsafe.Pointer(&c.axisV)) = def.AxisV
	*(*[3]float32)(unsafe.Pointer(&c.velocity)) = def.Velocity
	*(*Material)(unsafe.Pointer(&c.material)) = def.Material
	c.gridResolution = C.int32_t(def.GridResolution)
	c.snapDistance = C.float(def.SnapDistance)
	c.weldDistance = C.float(def.WeldDistance)
	c.frameCount = C.int32_t(def.FrameCount)
	c.frameLength = C.float(def.FrameLength)
	c.accuracy = C.float(def.Accuracy)
	if len(def.FramePoints) > 0 {
		pinner.Pin(&def.FramePoints[0])
		c.framePoints = (*C.float)(unsafe.Pointer(&def.FramePoints[0]))
	}
	c.maxFrames = C.int32_t(def.MaxFrames)
	c.rigidWeight = C.float(def.RigidWeight)
	c.rigidArea = C.float(def.RigidArea)
	c.crumbArea = C.float(def.CrumbArea)
	c.friction = C.float(def.Friction)
	c.contactThickness = C.float(def.ContactThickness)
	c.groups = C.uint32_t(def.Groups)
	c.touchesSheets = C.int32_t(def.TouchesSheets)
	c.selfContact = C.int32_t(def.SelfContact)
	c.collisionPoints = C.int32_t(def.CollisionPoints)
	c.iterations = C.int32_t(def.Iterations)
	c.sleepSpeed = C.float(def.SleepSpeed)
	c.model = C.int32_t(def.Model)
	c.skinning = C.int32_t(def.Skinning)
	c.planar = C.int32_t(def.Planar)
	c.timeStepping = C.int32_t(def.TimeStepping)
	c.fadeTime = C.float(def.FadeTime)
	c.normals = C.int32_t(def.Normals)
	*(*PaperOptions)(unsafe.Pointer(&c.paper)) = def.Paper
	if len(def.FramePoints) > 0 {
		c.frameCount = C.int32_t(len(def.FramePoints))
	}
	return c
}

func (def *SheetDef) fromC(c *C.kiriSheetDef) {
	def.cookie = uint32(c.cookie)
	def.Position = *(*[3]float32)(unsafe.Pointer(&c.position))
	def.AxisU = *(*[3]float32)(unsafe.Pointer(&c.axisU))
	def.AxisV = *(*[3]float32)(unsafe.Pointer(&c.axisV))
	def.Velocity = *(*[3]float32)(unsafe.Pointer(&c.velocity))
	def.Material = *(*Material)(unsafe.Pointer(&c.material))
	def.GridResolution = int32(c.gridResolution)
	def.SnapDistance = float32(c.snapDistance)
	def.WeldDistance = float32(c.weldDistance)
	def.FrameCount = int32(c.frameCount)
	def.FrameLength = float32(c.frameLength)
	def.Accuracy = float32(c.accuracy)
	def.MaxFrames = int32(c.maxFrames)
	def.RigidWeight = float32(c.rigidWeight)
	def.RigidArea = float32(c.rigidArea)
	def.CrumbArea = float32(c.crumbArea)
	def.Friction = float32(c.friction)
	def.ContactThickness = float32(c.contactThickness)
	def.Groups = uint32(c.groups)
	def.TouchesSheets = int32(c.touchesSheets)
	def.SelfContact = int32(c.selfContact)
	def.CollisionPoints = int32(c.collisionPoints)
	def.Iterations = int32(c.iterations)
	def.SleepSpeed = float32(c.sleepSpeed)
	def.Model = Model(c.model)
	def.Skinning = Skinning(c.skinning)
	def.Planar = int32(c.planar)
	def.TimeStepping = TimeStepping(c.timeStepping)
	def.FadeTime = float32(c.fadeTime)
	def.Normals = int32(c.normals)
	def.Paper = *(*PaperOptions)(unsafe.Pointer(&c.paper))
}

func viewMesh(world *World, c *C.kiriMesh) Mesh {
	return Mesh{
		Positions:       viewOf[[3]float32](world, unsafe.Pointer(c.positions), int(c.vertexCount)),
		Normals:         viewOf[[3]float32](world, unsafe.Pointer(c.normals), int(c.vertexCount)),
		RestPositions:   viewOf[[2]float32](world, unsafe.Pointer(c.restPositions), int(c.vertexCount)),
		Indices:         viewOf[[3]int32](world, unsafe.Pointer(c.indices), int(c.triangleCount)),
		SourceTriangles: viewOf[int32](world, unsafe.Pointer(c.sourceTriangles), int(c.vertexCount)),
		SourceWeights:   viewOf[[3]float32](world, unsafe.Pointer(c.sourceWeights), int(c.vertexCount)),
		VertexCount:     int32(c.vertexCount),
		TriangleCount:   int32(c.triangleCount),
		Revision:        uint32(c.revision),
	}
}

func viewSolid(world *World, c *C.kiriSolid) Solid {
	return Solid{
		Positions:     viewOf[[3]float32](world, unsafe.Pointer(c.positions), int(c.vertexCount)),
		Normals:       viewOf[[3]float32](world, unsafe.Pointer(c.normals), int(c.vertexCount)),
		RestPositions: viewOf[[2]float32](world, unsafe.Pointer(c.restPositions), int(c.vertexCount)),
		Indices:       viewOf[[3]int32](world, unsafe.Pointer(c.indices), int(c.triangleCount)),
		Sources:       viewOf[int32](world, unsafe.Pointer(c.sources), int(c.vertexCount)),
		VertexCount:   int32(c.vertexCount),
		TriangleCount: int32(c.triangleCount),
		RimTriangle:   int32(c.rimTriangle),
	}
}

func viewPieceMesh(world *World, c *C.kiriPieceMesh) PieceMesh {
	return PieceMesh{
		Vertices:            viewOf[int32](world, unsafe.Pointer(c.vertices), int(c.vertexCount)),
		Triangles:           viewOf[int32](world, unsafe.Pointer(c.triangles), int(c.triangleCount)),
		Indices:             viewOf[[3]int32](world, unsafe.Pointer(c.indices), int(c.triangleCount)),
		CollisionPoints:     viewOf[int32](world, unsafe.Pointer(c.collisionPoints), int(c.collisionPointCount)),
		VertexCount:         int32(c.vertexCount),
		TriangleCount:       int32(c.triangleCount),
		CollisionPointCount: int32(c.collisionPointCount),
	}
}

// Arrays stay where they are until the pinner lets go.
func (def *SeamDef) toC(pinner *runtime.Pinner) *C.kiriSeamDef {
	c := new(C.kiriSeamDef)
	c.cookie = C.uint32_t(def.cookie)
	c.sheetA = C.kiriSheet(def.SheetA)
	c.sheetB = C.kiriSheet(def.SheetB)
	if len(def.LineA) > 0 {
		pinner.Pin(&def.LineA[0])
		c.lineA = (*C.float)(unsafe.Pointer(&def.LineA[0]))
	}
	if len(def.LineB) > 0 {
		pinner.Pin(&def.LineB[0])
		c.lineB = (*C.float)(unsafe.Pointer(&def.LineB[0]))
	}
	c.countA = C.int32_t(len(def.LineA))
	c.countB = C.int32_t(len(def.LineB))
	c.stitches = C.int32_t(def.Stitches)
	c.stiffness = C.float(def.Stiffness)
	c.restAngle = C.float(def.RestAngle)
	c.breakForce = C.float(def.BreakForce)
	return c
}

func (def *SeamDef) fromC(c *C.kiriSeamDef) {
	def.cookie = uint32(c.cookie)
	def.SheetA = SheetID(c.sheetA)
	def.SheetB = SheetID(c.sheetB)
	def.Stitches = int32(c.stitches)
	def.Stiffness = float32(c.stiffness)
	def.RestAngle = float32(c.restAngle)
	def.BreakForce = float32(c.breakForce)
}

// Arrays stay where they are until the pinner lets go.
func (def *ObstacleDef) toC(pinner *runtime.Pinner) *C.kiriObstacleDef {
	c := new(C.kiriObstacleDef)
	c.cookie = C.uint32_t(def.cookie)
	c._type = C.int32_t(def.Type)
	*(*[3]float32)(unsafe.Pointer(&c.size)) = def.Size
	c.radius = C.float(def.Radius)
	c.height = C.float(def.Height)
	if len(def.Outline) > 0 {
		pinner.Pin(&def.Outline[0])
		c.outline = (*C.float)(unsafe.Pointer(&def.Outline[0]))
	}
	c.outlineCount = C.int32_t(len(def.Outline))
	c.rounding = C.float(def.Rounding)
	*(*[3]float32)(unsafe.Pointer(&c.position)) = def.Position
	*(*[9]float32)(unsafe.Pointer(&c.rotation)) = def.Rotation
	*(*[3]float32)(unsafe.Pointer(&c.velocity)) = def.Velocity
	*(*[3]float32)(unsafe.Pointer(&c.angularVelocity)) = def.AngularVelocity
	*(*[3]float32)(unsafe.Pointer(&c.surfaceVelocity)) = def.SurfaceVelocity
	c.friction = C.float(def.Friction)
	c.mass = C.float(def.Mass)
	*(*[6]float32)(unsafe.Pointer(&c.inertia)) = def.Inertia
	*(*[3]float32)(unsafe.Pointer(&c.centerOfMass)) = def.CenterOfMass
	c.body = C.uint32_t(def.Body)
	c.pushSpeed = C.float(def.PushSpeed)
	c.groups = C.uint32_t(def.Groups)
	return c
}

func (def *ObstacleDef) fromC(c *C.kiriObstacleDef) {
	def.cookie = uint32(c.cookie)
	def.Type = ObstacleType(c._type)
	def.Size = *(*[3]float32)(unsafe.Pointer(&c.size))
	def.Radius = float32(c.radius)
	def.Height = float32(c.height)
	def.Rounding = float32(c.rounding)
	def.Position = *(*[3]float32)(unsafe.Pointer(&c.position))
	def.Rotation = *(*[9]float32)(unsafe.Pointer(&c.rotation))
	def.Velocity = *(*[3]float32)(unsafe.Pointer(&c.velocity))
	def.AngularVelocity = *(*[3]float32)(unsafe.Pointer(&c.angularVelocity))
	def.SurfaceVelocity = *(*[3]float32)(unsafe.Pointer(&c.surfaceVelocity))
	def.Friction = float32(c.friction)
	def.Mass = float32(c.mass)
	def.Inertia = *(*[6]float32)(unsafe.Pointer(&c.inertia))
	def.CenterOfMass = *(*[3]float32)(unsafe.Pointer(&c.centerOfMass))
	def.Body = uint32(c.body)
	def.PushSpeed = float32(c.pushSpeed)
	def.Groups = uint32(c.groups)
}

// Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
func GetVersion() int32 {
	return int32(C.kiriGetVersion())
}

// Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
func GetResultName(result ResultCode) string {
	return C.GoString(C.kiriGetResultName(C.kiriResult(result)))
}

// Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning.
func GetResultText(result ResultCode) string {
	return C.GoString(C.kiriGetResultText(C.kiriResult(result)))
}

// Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the pending cut
// points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that still have work.
// KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget). KIRI_ERROR_LIMIT: no ids are
// left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED: events name sheets that were stopped.
func (w *World) Tick(dt float32, substeps int32) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_Tick(w.c, C.float(dt), C.int32_t(substeps))
	w.epoch++
	runtime.KeepAlive(w)
	if err := failure(w, "World.Tick", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolWorldShiftOrigin pool[struct {
	origin [3]float32
}]

// Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing wakes.
// Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not fit a float.
func (w *World) ShiftOrigin(origin [3]float32) error {
	if err := w.check(); err != nil {
		return err
	}
	block := poolWorldShiftOrigin.take()
	block.origin = origin
	result := C.kiriWorld_ShiftOrigin(w.c, (*C.float)(unsafe.Pointer(&block.origin)))
	poolWorldShiftOrigin.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.ShiftOrigin", result, true); err != nil {
		return err
	}
	return nil
}

var poolWorldSetGravity pool[struct {
	gravity [3]float32
}]

// Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
func (w *World) SetGravity(gravity [3]float32) error {
	if err := w.check(); err != nil {
		return err
	}
	block := poolWorldSetGravity.take()
	block.gravity = gravity
	result := C.kiriWorld_SetGravity(w.c, (*C.float)(unsafe.Pointer(&block.gravity)))
	poolWorldSetGravity.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.SetGravity", result, true); err != nil {
		return err
	}
	return nil
}

// Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on.
func (w *World) SetBudget(budget *Budget) error {
	if err := w.check(); err != nil {
		return err
	}
	result := C.kiriWorld_SetBudget(w.c, (*C.kiriBudget)(unsafe.Pointer(budget)))
	runtime.KeepAlive(w)
	if err := failure(w, "World.SetBudget", result, true); err != nil {
		return err
	}
	return nil
}

var poolWorldGetStateHash pool[struct {
	hash C.uint64_t
}]

// Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual, budget).
func (w *World) StateHash() (uint64, error) {
	var made0 uint64
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldGetStateHash.take()
	result := C.kiriWorld_GetStateHash(w.c, &block.hash)
	answer := poolWorldGetStateHash.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.StateHash", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.hash), nil
}

var poolWorldGetSheets pool[struct {
	count C.int32_t
}]

// Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are.
func (w *World) Sheets() ([]Sheet, error) {
	var made0 []Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	room := C.int32_t(64)
again:
	sheets := make([]C.kiriSheet, room)
	block := poolWorldGetSheets.take()
	result := C.kiriWorld_GetSheets(w.c, unsafe.SliceData(sheets), room, &block.count)
	answer := poolWorldGetSheets.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.Sheets", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Sheet](w, sheets[:answer.count]), nil
}

// Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A replay stops there.
func (w *World) Note(bytes []byte) error {
	if err := w.check(); err != nil {
		return err
	}
	result := C.kiriWorld_Note(w.c, unsafe.Pointer(unsafe.SliceData(bytes)), C.int32_t(len(bytes)))
	runtime.KeepAlive(w)
	if err := failure(w, "World.Note", result, true); err != nil {
		return err
	}
	return nil
}

// Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports the
// events. Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
// kiriWorld_Tick.
func (w *World) FinishCuts() error {
	if err := w.check(); err != nil {
		return err
	}
	result := C.kiriWorld_FinishCuts(w.c)
	runtime.KeepAlive(w)
	if err := failure(w, "World.FinishCuts", result, true); err != nil {
		return err
	}
	return nil
}

// Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a malicious save cannot
// crash the program, and takes memory in proportion to its size, which is below 2^31. Old arrays live until the next
// tick. On failure nothing has changed: KIRI_ERROR_DATA: not a save, damaged, or of another version.
// KIRI_ERROR_MEMORY.
func (w *World) Load(bytes []byte) error {
	if err := w.check(); err != nil {
		return err
	}
	result := C.kiriWorld_Load(w.c, unsafe.Pointer(unsafe.SliceData(bytes)), C.int64_t(len(bytes)))
	runtime.KeepAlive(w)
	if err := failure(w, "World.Load", result, true); err != nil {
		return err
	}
	return nil
}

// Replaces the world by the world of the snapshot, as kiriWorld_Load does. The bytes are trusted. On failure nothing
// has changed: KIRI_ERROR_DATA: no snapshot of this build. KIRI_ERROR_STATE: it is recorded. KIRI_ERROR_MEMORY.
func (w *World) Restore(bytes []byte) error {
	if err := w.check(); err != nil {
		return err
	}
	result := C.kiriWorld_Restore(w.c, unsafe.Pointer(unsafe.SliceData(bytes)), C.int64_t(len(bytes)))
	runtime.KeepAlive(w)
	if err := failure(w, "World.Restore", result, true); err != nil {
		return err
	}
	return nil
}

var poolWorldGetEvents pool[struct {
	events *C.kiriEvent
	count  C.int32_t
}]

// Gets the events: *events points to *count of them.
func (w *World) Events() (View[Event], error) {
	var made0 View[Event]
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldGetEvents.take()
	result := C.kiriWorld_GetEvents(w.c, &block.events, &block.count)
	answer := poolWorldGetEvents.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.Events", result, false); err != nil {
		return made0, err
	}
	return viewOf[Event](w, unsafe.Pointer(answer.events), int(answer.count)), nil
}

var poolWorldGetProfile pool[struct {
	profile Profile
}]

// Gets the profile of the last tick that was not refused.
func (w *World) Profile() (Profile, error) {
	var made0 Profile
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldGetProfile.take()
	result := C.kiriWorld_GetProfile(w.c, (*C.kiriProfile)(unsafe.Pointer(&block.profile)))
	answer := poolWorldGetProfile.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.Profile", result, false); err != nil {
		return made0, err
	}
	return answer.profile, nil
}

// Returns the name of a stage; "" for another number.
func GetStageName(stage Stage) string {
	return C.GoString(C.kiriGetStageName(C.int32_t(stage)))
}

var poolGetMaterial pool[struct {
	material Material
}]

// Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
func GetMaterial(preset MaterialPreset) (Material, error) {
	var made0 Material
	block := poolGetMaterial.take()
	result := C.kiriGetMaterial(C.int32_t(preset), (*C.kiriMaterial)(unsafe.Pointer(&block.material)))
	answer := poolGetMaterial.give(block)
	if err := failure(nil, "GetMaterial", result, false); err != nil {
		return made0, err
	}
	return answer.material, nil
}

var poolGetQuality pool[struct {
	quality Quality
}]

// Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_...
func GetQuality(preset QualityPreset) (Quality, error) {
	var made0 Quality
	block := poolGetQuality.take()
	result := C.kiriGetQuality(C.int32_t(preset), (*C.kiriQuality)(unsafe.Pointer(&block.quality)))
	answer := poolGetQuality.give(block)
	if err := failure(nil, "GetQuality", result, false); err != nil {
		return made0, err
	}
	return answer.quality, nil
}

var poolDefaultSheetDef pool[struct {
	def C.kiriSheetDef
}]

// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
// failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
func DefaultSheetDef() SheetDef {
	block := poolDefaultSheetDef.take()
	C.kiriDefaultSheetDef(&block.def)
	answer := poolDefaultSheetDef.give(block)
	var made SheetDef
	made.fromC(&answer.def)
	return made
}

var poolWorldCreateSheet pool[struct {
	sheet C.kiriSheet
}]

// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
// failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
func (w *World) CreateSheet(def *SheetDef) (Sheet, error) {
	var made0 Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	block := poolWorldCreateSheet.take()
	result := C.kiriCreateSheet(w.c, def.toC(&pinner), &block.sheet)
	answer := poolWorldCreateSheet.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.CreateSheet", result, true); err != nil {
		return made0, err
	}
	return Sheet{w, SheetID(answer.sheet)}, nil
}

// Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
// failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def.
func (s Sheet) Destroy() error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriDestroySheet(s.World.c, C.kiriSheet(s.ID))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Destroy", result, true); err != nil {
		return err
	}
	return nil
}

var poolGetSetup pool[struct {
	def C.kiriSheetDef
}]

// Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of sheet and
// its sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual, accuracy).
func GetSetup(preset SetupPreset, width float32, height float32) (SheetDef, error) {
	var made0 SheetDef
	block := poolGetSetup.take()
	result := C.kiriGetSetup(C.int32_t(preset), C.float(width), C.float(height), &block.def)
	answer := poolGetSetup.give(block)
	if err := failure(nil, "GetSetup", result, false); err != nil {
		return made0, err
	}
	var made SheetDef
	made.fromC(&answer.def)
	return made, nil
}

var poolWorldCreateRectangle pool[struct {
	sheet C.kiriSheet
}]

// Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns or rows
// 0: as many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def null: the
// defaults.
func (w *World) CreateRectangle(width float32, height float32, columns int32, rows int32, def *SheetDef) (Sheet, error) {
	var made0 Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	var inC *C.kiriSheetDef
	if def != nil {
		inC = def.toC(&pinner)
	}
	block := poolWorldCreateRectangle.take()
	result := C.kiriCreateRectangle(w.c, C.float(width), C.float(height), C.int32_t(columns), C.int32_t(rows), inC, &block.sheet)
	answer := poolWorldCreateRectangle.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.CreateRectangle", result, true); err != nil {
		return made0, err
	}
	return Sheet{w, SheetID(answer.sheet)}, nil
}

var poolSheetGetSettings pool[struct {
	settings SheetSettings
}]

// Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not come
// from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
func (s Sheet) Settings() (SheetSettings, error) {
	var made0 SheetSettings
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetSettings.take()
	result := C.kiriSheet_GetSettings(s.World.c, C.kiriSheet(s.ID), (*C.kiriSheetSettings)(unsafe.Pointer(&block.settings)))
	answer := poolSheetGetSettings.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Settings", result, false); err != nil {
		return made0, err
	}
	return answer.settings, nil
}

// Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not come
// from kiriSheet_GetSettings. It wakes if one differs. Motion, stiffness of pins and frames stay.
func (s Sheet) SetSettings(settings *SheetSettings) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetSettings(s.World.c, C.kiriSheet(s.ID), (*C.kiriSheetSettings)(unsafe.Pointer(settings)))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetSettings", result, true); err != nil {
		return err
	}
	return nil
}

var poolWorldCreateFoldedSheet pool[struct {
	sheet C.kiriSheet
}]

// Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no material at
// one.
func (w *World) CreateFoldedSheet(def *SheetDef, folds []Fold) (Sheet, error) {
	var made0 Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	block := poolWorldCreateFoldedSheet.take()
	result := C.kiriCreateFoldedSheet(w.c, def.toC(&pinner), (*C.kiriFold)(unsafe.Pointer(unsafe.SliceData(folds))), C.int32_t(len(folds)), &block.sheet)
	answer := poolWorldCreateFoldedSheet.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.CreateFoldedSheet", result, true); err != nil {
		return made0, err
	}
	return Sheet{w, SheetID(answer.sheet)}, nil
}

var poolSheetAddFold pool[struct {
	index C.int32_t
}]

// Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
// KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet.
func (s Sheet) AddFold(fold *Fold) (int32, error) {
	var made0 int32
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetAddFold.take()
	result := C.kiriSheet_AddFold(s.World.c, C.kiriSheet(s.ID), (*C.kiriFold)(unsafe.Pointer(fold)), &block.index)
	answer := poolSheetAddFold.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.AddFold", result, true); err != nil {
		return made0, err
	}
	return int32(answer.index), nil
}

var poolSheetGetFold pool[struct {
	state FoldState
}]

// A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet.
func (s Sheet) Fold(index int32) (FoldState, error) {
	var made0 FoldState
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetFold.take()
	result := C.kiriSheet_GetFold(s.World.c, C.kiriSheet(s.ID), C.int32_t(index), (*C.kiriFoldState)(unsafe.Pointer(&block.state)))
	answer := poolSheetGetFold.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Fold", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

// A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the sheet.
func (s Sheet) SetFold(index int32, stiffness float32, restAngle float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetFold(s.World.c, C.kiriSheet(s.ID), C.int32_t(index), C.float(stiffness), C.float(restAngle))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetFold", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetGetMesh pool[struct {
	mesh C.kiriMesh
}]

// Gets the arrays, without a copy.
func (s Sheet) Mesh() (Mesh, error) {
	var made0 Mesh
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetMesh.take()
	result := C.kiriSheet_GetMesh(s.World.c, C.kiriSheet(s.ID), &block.mesh)
	answer := poolSheetGetMesh.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Mesh", result, false); err != nil {
		return made0, err
	}
	return viewMesh(s.World, &answer.mesh), nil
}

var poolSheetGetDirty pool[struct {
	dirty Dirty
}]

// Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore.
func (s Sheet) Dirty(sinceRevision uint32) (Dirty, error) {
	var made0 Dirty
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetDirty.take()
	result := C.kiriSheet_GetDirty(s.World.c, C.kiriSheet(s.ID), C.uint32_t(sinceRevision), (*C.kiriDirty)(unsafe.Pointer(&block.dirty)))
	answer := poolSheetGetDirty.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Dirty", result, false); err != nil {
		return made0, err
	}
	return answer.dirty, nil
}

var poolSheetGetSolid pool[struct {
	solid C.kiriSolid
}]

// Makes the solid surface, with a thickness in m; thickness 0: the material's.
func (s Sheet) Solid(thickness float32) (Solid, error) {
	var made0 Solid
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetSolid.take()
	result := C.kiriSheet_GetSolid(s.World.c, C.kiriSheet(s.ID), C.float(thickness), &block.solid)
	answer := poolSheetGetSolid.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Solid", result, true); err != nil {
		return made0, err
	}
	return viewSolid(s.World, &answer.solid), nil
}

var poolSheetGetCollisionPoints pool[struct {
	positions *C.float
	count     C.int32_t
}]

// Gets the collision points: 3 floats of position (m, world) a point.
func (s Sheet) CollisionPoints() (View[[3]float32], error) {
	var made0 View[[3]float32]
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetCollisionPoints.take()
	result := C.kiriSheet_GetCollisionPoints(s.World.c, C.kiriSheet(s.ID), &block.positions, &block.count)
	answer := poolSheetGetCollisionPoints.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.CollisionPoints", result, false); err != nil {
		return made0, err
	}
	return viewOf[[3]float32](s.World, unsafe.Pointer(answer.positions), int(answer.count)), nil
}

var poolSheetGetCounts pool[struct {
	counts Counts
}]

// Get the counts, at no cost; sum the totals over the frames.
func (s Sheet) Counts() (Counts, error) {
	var made0 Counts
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetCounts.take()
	result := C.kiriSheet_GetCounts(s.World.c, C.kiriSheet(s.ID), (*C.kiriCounts)(unsafe.Pointer(&block.counts)))
	answer := poolSheetGetCounts.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Counts", result, false); err != nil {
		return made0, err
	}
	return answer.counts, nil
}

var poolSheetGetTotals pool[struct {
	totals Totals
}]

// Get the counts, at no cost; sum the totals over the frames.
func (s Sheet) Totals() (Totals, error) {
	var made0 Totals
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetTotals.take()
	result := C.kiriSheet_GetTotals(s.World.c, C.kiriSheet(s.ID), (*C.kiriTotals)(unsafe.Pointer(&block.totals)))
	answer := poolSheetGetTotals.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Totals", result, false); err != nil {
		return made0, err
	}
	return answer.totals, nil
}

var poolSheetEstimateError pool[struct {
	relative C.double
}]

// Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not KIRI_MODEL_LINKS.
func (s Sheet) EstimateError() (float64, error) {
	var made0 float64
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetEstimateError.take()
	result := C.kiriSheet_EstimateError(s.World.c, C.kiriSheet(s.ID), &block.relative)
	answer := poolSheetEstimateError.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.EstimateError", result, false); err != nil {
		return made0, err
	}
	return float64(answer.relative), nil
}

var poolSheetIsAwake pool[struct {
	awake C.int32_t
}]

// Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all.
func (s Sheet) IsAwake() (bool, error) {
	var made0 bool
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetIsAwake.take()
	result := C.kiriSheet_IsAwake(s.World.c, C.kiriSheet(s.ID), &block.awake)
	answer := poolSheetIsAwake.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.IsAwake", result, false); err != nil {
		return made0, err
	}
	return answer.awake != 0, nil
}

// Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); kiriSheet_Wake wakes all.
func (s Sheet) Wake() error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_Wake(s.World.c, C.kiriSheet(s.ID))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Wake", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetTransform pool[struct {
	rotation    [9]float32
	translation [3]float32
}]

// Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar sheet turns
// about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual, sheets).
func (s Sheet) Transform(rotation [9]float32, translation [3]float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	block := poolSheetTransform.take()
	block.rotation = rotation
	block.translation = translation
	result := C.kiriSheet_Transform(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.rotation)), (*C.float)(unsafe.Pointer(&block.translation)))
	poolSheetTransform.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Transform", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetSetVelocity pool[struct {
	velocity        [3]float32
	angularVelocity [3]float32
}]

// Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre
// of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay
// held.
func (s Sheet) SetVelocity(velocity [3]float32, angularVelocity [3]float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	block := poolSheetSetVelocity.take()
	block.velocity = velocity
	block.angularVelocity = angularVelocity
	result := C.kiriSheet_SetVelocity(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.velocity)), (*C.float)(unsafe.Pointer(&block.angularVelocity)))
	poolSheetSetVelocity.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetVelocity", result, true); err != nil {
		return err
	}
	return nil
}

var poolFrameSetPieceVelocity pool[struct {
	velocity        [3]float32
	angularVelocity [3]float32
}]

// Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its centre
// of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held frames stay
// held.
func (f Frame) SetPieceVelocity(velocity [3]float32, angularVelocity [3]float32) error {
	if err := f.World.check(); err != nil {
		return err
	}
	block := poolFrameSetPieceVelocity.take()
	block.velocity = velocity
	block.angularVelocity = angularVelocity
	result := C.kiriFrame_SetPieceVelocity(f.World.c, C.kiriFrame(f.ID), (*C.float)(unsafe.Pointer(&block.velocity)), (*C.float)(unsafe.Pointer(&block.angularVelocity)))
	poolFrameSetPieceVelocity.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.SetPieceVelocity", result, true); err != nil {
		return err
	}
	return nil
}

// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
// piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
// both.
func (s Sheet) SetUserData(data uint64) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetUserData(s.World.c, C.kiriSheet(s.ID), C.uint64_t(data))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetUserData", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetGetUserData pool[struct {
	data C.uint64_t
}]

// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
// piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
// both.
func (s Sheet) UserData() (uint64, error) {
	var made0 uint64
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetUserData.take()
	result := C.kiriSheet_GetUserData(s.World.c, C.kiriSheet(s.ID), &block.data)
	answer := poolSheetGetUserData.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.UserData", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.data), nil
}

// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
// piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
// both.
func (p Pin) SetUserData(data uint64) error {
	if err := p.World.check(); err != nil {
		return err
	}
	result := C.kiriPin_SetUserData(p.World.c, C.kiriPin(p.ID), C.uint64_t(data))
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.SetUserData", result, true); err != nil {
		return err
	}
	return nil
}

var poolPinGetUserData pool[struct {
	data C.uint64_t
}]

// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
// piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
// both.
func (p Pin) UserData() (uint64, error) {
	var made0 uint64
	if err := p.World.check(); err != nil {
		return made0, err
	}
	block := poolPinGetUserData.take()
	result := C.kiriPin_GetUserData(p.World.c, C.kiriPin(p.ID), &block.data)
	answer := poolPinGetUserData.give(block)
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.UserData", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.data), nil
}

// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
// piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
// both.
func (f Frame) SetPieceUserData(data uint64) error {
	if err := f.World.check(); err != nil {
		return err
	}
	result := C.kiriFrame_SetPieceUserData(f.World.c, C.kiriFrame(f.ID), C.uint64_t(data))
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.SetPieceUserData", result, true); err != nil {
		return err
	}
	return nil
}

var poolFrameGetPieceUserData pool[struct {
	data C.uint64_t
}]

// Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
// piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
// both.
func (f Frame) PieceUserData() (uint64, error) {
	var made0 uint64
	if err := f.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameGetPieceUserData.take()
	result := C.kiriFrame_GetPieceUserData(f.World.c, C.kiriFrame(f.ID), &block.data)
	answer := poolFrameGetPieceUserData.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.PieceUserData", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.data), nil
}

var poolSheetRaycast pool[struct {
	origin    [3]float32
	direction [3]float32
	hit       Hit
}]

// Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not.
func (s Sheet) Raycast(origin [3]float32, direction [3]float32, maxDistance float32) (Hit, error) {
	var made0 Hit
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetRaycast.take()
	block.origin = origin
	block.direction = direction
	result := C.kiriSheet_Raycast(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.origin)), (*C.float)(unsafe.Pointer(&block.direction)), C.float(maxDistance), (*C.kiriHit)(unsafe.Pointer(&block.hit)))
	answer := poolSheetRaycast.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Raycast", result, false); err != nil {
		return made0, err
	}
	return answer.hit, nil
}

var poolWorldRaycast pool[struct {
	origin    [3]float32
	direction [3]float32
	sheet     C.kiriSheet
	hit       Hit
}]

// Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does not.
func (w *World) Raycast(origin [3]float32, direction [3]float32, maxDistance float32) (Sheet, Hit, error) {
	var made0 Sheet
	var made1 Hit
	if err := w.check(); err != nil {
		return made0, made1, err
	}
	block := poolWorldRaycast.take()
	block.origin = origin
	block.direction = direction
	result := C.kiriWorld_Raycast(w.c, (*C.float)(unsafe.Pointer(&block.origin)), (*C.float)(unsafe.Pointer(&block.direction)), C.float(maxDistance), &block.sheet, (*C.kiriHit)(unsafe.Pointer(&block.hit)))
	answer := poolWorldRaycast.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.Raycast", result, false); err != nil {
		return made0, made1, err
	}
	return Sheet{w, SheetID(answer.sheet)}, answer.hit, nil
}

var poolSheetGetPoint pool[struct {
	restPoint [2]float32
	state     PointState
}]

// Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the point.
func (s Sheet) Point(restPoint [2]float32) (PointState, error) {
	var made0 PointState
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPoint.take()
	block.restPoint = restPoint
	result := C.kiriSheet_GetPoint(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), (*C.kiriPointState)(unsafe.Pointer(&block.state)))
	answer := poolSheetGetPoint.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Point", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolSheetGetPiece pool[struct {
	state PieceState
}]

// Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index.
func (s Sheet) Piece(piece int32) (PieceState, error) {
	var made0 PieceState
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPiece.take()
	result := C.kiriSheet_GetPiece(s.World.c, C.kiriSheet(s.ID), C.int32_t(piece), (*C.kiriPieceState)(unsafe.Pointer(&block.state)))
	answer := poolSheetGetPiece.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Piece", result, true); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolSheetGetPieceMesh pool[struct {
	mesh C.kiriPieceMesh
}]

// Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index.
func (s Sheet) PieceMesh(piece int32) (PieceMesh, error) {
	var made0 PieceMesh
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPieceMesh.take()
	result := C.kiriSheet_GetPieceMesh(s.World.c, C.kiriSheet(s.ID), C.int32_t(piece), &block.mesh)
	answer := poolSheetGetPieceMesh.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.PieceMesh", result, true); err != nil {
		return made0, err
	}
	return viewPieceMesh(s.World, &answer.mesh), nil
}

var poolSheetGetPieceFrames pool[struct {
	frames *C.kiriFrame
	count  C.int32_t
}]

// Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.
func (s Sheet) PieceFrames(piece int32) (View[FrameID], error) {
	var made0 View[FrameID]
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPieceFrames.take()
	result := C.kiriSheet_GetPieceFrames(s.World.c, C.kiriSheet(s.ID), C.int32_t(piece), &block.frames, &block.count)
	answer := poolSheetGetPieceFrames.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.PieceFrames", result, true); err != nil {
		return made0, err
	}
	return viewOf[FrameID](s.World, unsafe.Pointer(answer.frames), int(answer.count)), nil
}

var poolFrameGetPiece pool[struct {
	piece C.int32_t
}]

// Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame.
func (f Frame) Piece() (int32, error) {
	var made0 int32
	if err := f.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameGetPiece.take()
	result := C.kiriFrame_GetPiece(f.World.c, C.kiriFrame(f.ID), &block.piece)
	answer := poolFrameGetPiece.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.Piece", result, false); err != nil {
		return made0, err
	}
	return int32(answer.piece), nil
}

var poolFrameDetachPiece pool[struct {
	detached C.kiriSheet
}]

// Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay with the
// old sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut is pending, or
// the budget lacks samples for the piece; *detached is 0, further cuts of the sheet wait, and
// KIRI_EVENT_PIECE_DETACHED names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the sheet
// (manual, cutting).
func (f Frame) DetachPiece() (Sheet, error) {
	var made0 Sheet
	if err := f.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameDetachPiece.take()
	result := C.kiriFrame_DetachPiece(f.World.c, C.kiriFrame(f.ID), &block.detached)
	answer := poolFrameDetachPiece.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.DetachPiece", result, true); err != nil {
		return made0, err
	}
	return Sheet{f.World, SheetID(answer.detached)}, nil
}

// Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles stay
// with three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all of its
// sheet.
func (f Frame) DestroyPiece() (bool, error) {
	if err := f.World.check(); err != nil {
		return false, err
	}
	result := C.kiriFrame_DestroyPiece(f.World.c, C.kiriFrame(f.ID))
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.DestroyPiece", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
// KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
// pending.
func (w *World) DetachPieces(frames []Frame) ([]Sheet, error) {
	var made0 []Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	ids := idsOf(frames)
	detached := make([]C.kiriSheet, len(ids))
	result := C.kiriWorld_DetachPieces(w.c, (*C.kiriFrame)(unsafe.Pointer(unsafe.SliceData(ids))), C.int32_t(len(ids)), unsafe.SliceData(detached))
	runtime.KeepAlive(w)
	if err := failure(w, "World.DetachPieces", result, true); err != nil {
		return made0, err
	}
	return things[Sheet](w, detached), nil
}

// Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
// KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
// pending.
func (w *World) DestroyPieces(frames []Frame) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	ids := idsOf(frames)
	result := C.kiriWorld_DestroyPieces(w.c, (*C.kiriFrame)(unsafe.Pointer(unsafe.SliceData(ids))), C.int32_t(len(ids)))
	runtime.KeepAlive(w)
	if err := failure(w, "World.DestroyPieces", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetDropCrumbs pool[struct {
	count C.int32_t
}]

// Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. *count: their number.
func (s Sheet) DropCrumbs(area float32) (int, error) {
	var made0 int
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetDropCrumbs.take()
	result := C.kiriSheet_DropCrumbs(s.World.c, C.kiriSheet(s.ID), C.float(area), &block.count)
	answer := poolSheetDropCrumbs.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.DropCrumbs", result, true); err != nil {
		return made0, err
	}
	return int(answer.count), nil
}

var poolSheetBeginCut pool[struct {
	restPoint [2]float32
	cut       C.kiriCut
}]

// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
// from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
// cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
// (KIRI_EVENT_CUT_FINISHED).
func (s Sheet) BeginCut(restPoint [2]float32) (Cut, error) {
	var made0 Cut
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetBeginCut.take()
	block.restPoint = restPoint
	result := C.kiriBeginCut(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), &block.cut)
	answer := poolSheetBeginCut.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.BeginCut", result, true); err != nil {
		return made0, err
	}
	return Cut{s.World, CutID(answer.cut)}, nil
}

// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
// from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
// cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
// (KIRI_EVENT_CUT_FINISHED).
func (c Cut) Extend(restPoints [][2]float32) error {
	if err := c.World.check(); err != nil {
		return err
	}
	result := C.kiriCut_Extend(c.World.c, C.kiriCut(c.ID), (*C.float)(unsafe.Pointer(unsafe.SliceData(restPoints))), C.int32_t(len(restPoints)))
	runtime.KeepAlive(c.World)
	if err := failure(c.World, "Cut.Extend", result, true); err != nil {
		return err
	}
	return nil
}

// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
// from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
// cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
// (KIRI_EVENT_CUT_FINISHED).
func (c Cut) End() error {
	if err := c.World.check(); err != nil {
		return err
	}
	result := C.kiriCut_End(c.World.c, C.kiriCut(c.ID))
	runtime.KeepAlive(c.World)
	if err := failure(c.World, "Cut.End", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetCut pool[struct {
	cut C.kiriCut
}]

// Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at once,
// from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet nothing is
// cut; an end inside stays closed until the next point. The id is stale after the tick of the last point
// (KIRI_EVENT_CUT_FINISHED).
func (s Sheet) Cut(restPoints [][2]float32) (Cut, error) {
	var made0 Cut
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetCut.take()
	result := C.kiriSheet_Cut(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(unsafe.SliceData(restPoints))), C.int32_t(len(restPoints)), &block.cut)
	answer := poolSheetCut.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Cut", result, true); err != nil {
		return made0, err
	}
	return Cut{s.World, CutID(answer.cut)}, nil
}

var poolSheetSlice pool[struct {
	blade [12]float32
	cut   C.kiriCut
}]

// Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2], meets
// the current sheet; past borders, so that it separates the parts that it crosses. The cut is already ended.
func (s Sheet) Slice(blade [12]float32) (Cut, error) {
	var made0 Cut
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetSlice.take()
	block.blade = blade
	result := C.kiriSheet_Slice(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.blade)), &block.cut)
	answer := poolSheetSlice.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Slice", result, true); err != nil {
		return made0, err
	}
	return Cut{s.World, CutID(answer.cut)}, nil
}

var poolGetTearing pool[struct {
	tearing Tearing
}]

// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
// inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
func GetTearing(preset MaterialPreset) (Tearing, error) {
	var made0 Tearing
	block := poolGetTearing.take()
	result := C.kiriGetTearing(C.int32_t(preset), (*C.kiriTearing)(unsafe.Pointer(&block.tearing)))
	answer := poolGetTearing.give(block)
	if err := failure(nil, "GetTearing", result, false); err != nil {
		return made0, err
	}
	return answer.tearing, nil
}

// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
// inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
func (s Sheet) SetTearing(tearing *Tearing) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetTearing(s.World.c, C.kiriSheet(s.ID), (*C.kiriTearing)(unsafe.Pointer(tearing)))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetTearing", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetGetTearing pool[struct {
	tearing Tearing
}]

// Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
// inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset.
func (s Sheet) Tearing() (Tearing, error) {
	var made0 Tearing
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetTearing.take()
	result := C.kiriSheet_GetTearing(s.World.c, C.kiriSheet(s.ID), (*C.kiriTearing)(unsafe.Pointer(&block.tearing)))
	answer := poolSheetGetTearing.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Tearing", result, false); err != nil {
		return made0, err
	}
	return answer.tearing, nil
}

// Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a factor, 0 or
// more: below 1 tears follow it, above 1 they stop there. The same points replace it. KIRI_ERROR_ARGUMENT: no
// material.
func (s Sheet) SetTearLine(restPoints [][2]float32, factor float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetTearLine(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(unsafe.SliceData(restPoints))), C.int32_t(len(restPoints)), C.float(factor))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetTearLine", result, true); err != nil {
		return err
	}
	return nil
}

var poolWorldBeginBlade pool[struct {
	blade C.kiriBlade
}]

// A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer, and
// cuts on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting). `sheet` 0:
// all.
func (w *World) BeginBlade(sheet Sheet) (Blade, error) {
	var made0 Blade
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldBeginBlade.take()
	result := C.kiriBeginBlade(w.c, C.kiriSheet(sheet.ID), &block.blade)
	answer := poolWorldBeginBlade.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.BeginBlade", result, true); err != nil {
		return made0, err
	}
	return Blade{w, BladeID(answer.blade)}, nil
}

var poolBladeMoveEdge pool[struct {
	from [3]float32
	to   [3]float32
}]

// Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
// each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
func (b Blade) MoveEdge(from [3]float32, to [3]float32) error {
	if err := b.World.check(); err != nil {
		return err
	}
	block := poolBladeMoveEdge.take()
	block.from = from
	block.to = to
	result := C.kiriBlade_MoveEdge(b.World.c, C.kiriBlade(b.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)))
	poolBladeMoveEdge.give(block)
	runtime.KeepAlive(b.World)
	if err := failure(b.World, "Blade.MoveEdge", result, true); err != nil {
		return err
	}
	return nil
}

var poolBladeMoveRay pool[struct {
	origin    [3]float32
	direction [3]float32
}]

// Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
// each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
func (b Blade) MoveRay(origin [3]float32, direction [3]float32, length float32) error {
	if err := b.World.check(); err != nil {
		return err
	}
	block := poolBladeMoveRay.take()
	block.origin = origin
	block.direction = direction
	result := C.kiriBlade_MoveRay(b.World.c, C.kiriBlade(b.ID), (*C.float)(unsafe.Pointer(&block.origin)), (*C.float)(unsafe.Pointer(&block.direction)), C.float(length))
	poolBladeMoveRay.give(block)
	runtime.KeepAlive(b.World)
	if err := failure(b.World, "Blade.MoveRay", result, true); err != nil {
		return err
	}
	return nil
}

// Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera casts;
// each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts stay.
func (b Blade) End() error {
	if err := b.World.check(); err != nil {
		return err
	}
	result := C.kiriBlade_End(b.World.c, C.kiriBlade(b.ID))
	runtime.KeepAlive(b.World)
	if err := failure(b.World, "Blade.End", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetGetFrames pool[struct {
	count C.int32_t
}]

// Writes up to `capacity` ids of the sheet's frames; *count is how many there are.
func (s Sheet) Frames() ([]Frame, error) {
	var made0 []Frame
	if err := s.World.check(); err != nil {
		return made0, err
	}
	room := C.int32_t(64)
again:
	frames := make([]C.kiriFrame, room)
	block := poolSheetGetFrames.take()
	result := C.kiriSheet_GetFrames(s.World.c, C.kiriSheet(s.ID), unsafe.SliceData(frames), room, &block.count)
	answer := poolSheetGetFrames.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Frames", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Frame](s.World, frames[:answer.count]), nil
}

// Holds the frame: its rest point moves evenly to `position` (m, world) with `rotation` (columns as above) in the
// next tick; position and rotation null: frees it. Material that held frames mostly carry moves through obstacles.
func (f Frame) Hold(position *[3]float32, rotation *[9]float32) error {
	if err := f.World.check(); err != nil {
		return err
	}
	result := C.kiriFrame_Hold(f.World.c, C.kiriFrame(f.ID), (*C.float)(unsafe.Pointer(position)), (*C.float)(unsafe.Pointer(rotation)))
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.Hold", result, true); err != nil {
		return err
	}
	return nil
}

var poolFrameGetState pool[struct {
	state FrameState
}]

// Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
// over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free frame.
func (f Frame) State() (FrameState, error) {
	var made0 FrameState
	if err := f.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameGetState.take()
	result := C.kiriFrame_GetState(f.World.c, C.kiriFrame(f.ID), (*C.kiriFrameState)(unsafe.Pointer(&block.state)))
	answer := poolFrameGetState.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.State", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolFrameGetReaction pool[struct {
	force  [3]float64
	torque [3]float64
}]

// Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
// over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free frame.
func (f Frame) Reaction() ([3]float64, [3]float64, error) {
	var made0 [3]float64
	var made1 [3]float64
	if err := f.World.check(); err != nil {
		return made0, made1, err
	}
	block := poolFrameGetReaction.take()
	result := C.kiriFrame_GetReaction(f.World.c, C.kiriFrame(f.ID), (*C.double)(unsafe.Pointer(&block.force)), (*C.double)(unsafe.Pointer(&block.torque)))
	answer := poolFrameGetReaction.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.Reaction", result, false); err != nil {
		return made0, made1, err
	}
	return answer.force, answer.torque, nil
}

var poolFrameApplyForce pool[struct {
	force  [3]float32
	torque [3]float32
}]

// Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).
func (f Frame) ApplyForce(force [3]float32, torque [3]float32) error {
	if err := f.World.check(); err != nil {
		return err
	}
	block := poolFrameApplyForce.take()
	block.force = force
	block.torque = torque
	result := C.kiriFrame_ApplyForce(f.World.c, C.kiriFrame(f.ID), (*C.float)(unsafe.Pointer(&block.force)), (*C.float)(unsafe.Pointer(&block.torque)))
	poolFrameApplyForce.give(block)
	runtime.KeepAlive(f.World)
	if err := failure(f.World, "Frame.ApplyForce", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetApplyForce pool[struct {
	restPoint [2]float32
	force     [3]float32
	torque    [3]float32
}]

// Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m).
func (s Sheet) ApplyForce(restPoint [2]float32, force [3]float32, torque [3]float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	block := poolSheetApplyForce.take()
	block.restPoint = restPoint
	block.force = force
	block.torque = torque
	result := C.kiriSheet_ApplyForce(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), (*C.float)(unsafe.Pointer(&block.force)), (*C.float)(unsafe.Pointer(&block.torque)))
	poolSheetApplyForce.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.ApplyForce", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetApplyLineLoad pool[struct {
	from           [2]float32
	to             [2]float32
	forcePerLength [3]float32
}]

// Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges included.
// Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of kiriSheet_ClampLine.
func (s Sheet) ApplyLineLoad(from [2]float32, to [2]float32, forcePerLength [3]float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	block := poolSheetApplyLineLoad.take()
	block.from = from
	block.to = to
	block.forcePerLength = forcePerLength
	result := C.kiriSheet_ApplyLineLoad(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)), (*C.float)(unsafe.Pointer(&block.forcePerLength)))
	poolSheetApplyLineLoad.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.ApplyLineLoad", result, true); err != nil {
		return err
	}
	return nil
}

// Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it.
func (s Sheet) ApplyPressure(pressure float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_ApplyPressure(s.World.c, C.kiriSheet(s.ID), C.float(pressure))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.ApplyPressure", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetApplyImpulse pool[struct {
	restPoint [2]float32
	impulse   [3]float32
}]

// Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of the
// frames that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the sheet.
func (s Sheet) ApplyImpulse(restPoint [2]float32, impulse [3]float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	block := poolSheetApplyImpulse.take()
	block.restPoint = restPoint
	block.impulse = impulse
	result := C.kiriSheet_ApplyImpulse(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), (*C.float)(unsafe.Pointer(&block.impulse)))
	poolSheetApplyImpulse.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.ApplyImpulse", result, true); err != nil {
		return err
	}
	return nil
}

// Copies the wind; it blows until the next call.
func (s Sheet) SetWind(wind *Wind) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetWind(s.World.c, C.kiriSheet(s.ID), (*C.kiriWind)(unsafe.Pointer(wind)))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetWind", result, true); err != nil {
		return err
	}
	return nil
}

var poolDefaultPinDef pool[struct {
	def PinDef
}]

// Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
func DefaultPinDef() PinDef {
	block := poolDefaultPinDef.take()
	C.kiriDefaultPinDef((*C.kiriPinDef)(unsafe.Pointer(&block.def)))
	answer := poolDefaultPinDef.give(block)
	return answer.def
}

var poolSheetCreatePin pool[struct {
	pin C.kiriPin
}]

// Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
func (s Sheet) CreatePin(def *PinDef) (Pin, error) {
	var made0 Pin
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetCreatePin.take()
	result := C.kiriCreatePin(s.World.c, C.kiriSheet(s.ID), (*C.kiriPinDef)(unsafe.Pointer(def)), &block.pin)
	answer := poolSheetCreatePin.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.CreatePin", result, true); err != nil {
		return made0, err
	}
	return Pin{s.World, PinID(answer.pin)}, nil
}

// Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT: outside.
func (p Pin) Destroy() error {
	if err := p.World.check(); err != nil {
		return err
	}
	result := C.kiriDestroyPin(p.World.c, C.kiriPin(p.ID))
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.Destroy", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetClampLine pool[struct {
	from  [2]float32
	to    [2]float32
	clamp C.kiriPin
}]

// Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material,
// as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far
// outside.
func (s Sheet) ClampLine(from [2]float32, to [2]float32) (Pin, error) {
	var made0 Pin
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetClampLine.take()
	block.from = from
	block.to = to
	result := C.kiriSheet_ClampLine(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)), &block.clamp)
	answer := poolSheetClampLine.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.ClampLine", result, true); err != nil {
		return made0, err
	}
	return Pin{s.World, PinID(answer.clamp)}, nil
}

var poolSheetHingeLine pool[struct {
	from  [2]float32
	to    [2]float32
	hinge C.kiriPin
}]

// Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its material,
// as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal, or far
// outside.
func (s Sheet) HingeLine(from [2]float32, to [2]float32) (Pin, error) {
	var made0 Pin
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetHingeLine.take()
	block.from = from
	block.to = to
	result := C.kiriSheet_HingeLine(s.World.c, C.kiriSheet(s.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)), &block.hinge)
	answer := poolSheetHingeLine.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.HingeLine", result, true); err != nil {
		return made0, err
	}
	return Pin{s.World, PinID(answer.hinge)}, nil
}

var poolPinSetTarget pool[struct {
	target [3]float32
}]

// Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
// (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
// moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
func (p Pin) SetTarget(target [3]float32) error {
	if err := p.World.check(); err != nil {
		return err
	}
	block := poolPinSetTarget.take()
	block.target = target
	result := C.kiriPin_SetTarget(p.World.c, C.kiriPin(p.ID), (*C.float)(unsafe.Pointer(&block.target)))
	poolPinSetTarget.give(block)
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.SetTarget", result, true); err != nil {
		return err
	}
	return nil
}

var poolPinSetPose pool[struct {
	target   [3]float32
	rotation [9]float32
}]

// Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's material
// (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and later. The pin
// moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a point.
func (p Pin) SetPose(target [3]float32, rotation [9]float32) error {
	if err := p.World.check(); err != nil {
		return err
	}
	block := poolPinSetPose.take()
	block.target = target
	block.rotation = rotation
	result := C.kiriPin_SetPose(p.World.c, C.kiriPin(p.ID), (*C.float)(unsafe.Pointer(&block.target)), (*C.float)(unsafe.Pointer(&block.rotation)))
	poolPinSetPose.give(block)
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.SetPose", result, true); err != nil {
		return err
	}
	return nil
}

// Sets the force (N) that breaks a pin of any type; 0: it never breaks.
func (p Pin) SetBreakForce(breakForce float32) error {
	if err := p.World.check(); err != nil {
		return err
	}
	result := C.kiriPin_SetBreakForce(p.World.c, C.kiriPin(p.ID), C.float(breakForce))
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.SetBreakForce", result, true); err != nil {
		return err
	}
	return nil
}

var poolPinGetState pool[struct {
	state PinState
}]

// Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it.
func (p Pin) State() (PinState, error) {
	var made0 PinState
	if err := p.World.check(); err != nil {
		return made0, err
	}
	block := poolPinGetState.take()
	result := C.kiriPin_GetState(p.World.c, C.kiriPin(p.ID), (*C.kiriPinState)(unsafe.Pointer(&block.state)))
	answer := poolPinGetState.give(block)
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.State", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolPinGetReaction pool[struct {
	force  [3]float64
	torque [3]float64
}]

// Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved it.
func (p Pin) Reaction() ([3]float64, [3]float64, error) {
	var made0 [3]float64
	var made1 [3]float64
	if err := p.World.check(); err != nil {
		return made0, made1, err
	}
	block := poolPinGetReaction.take()
	result := C.kiriPin_GetReaction(p.World.c, C.kiriPin(p.ID), (*C.double)(unsafe.Pointer(&block.force)), (*C.double)(unsafe.Pointer(&block.torque)))
	answer := poolPinGetReaction.give(block)
	runtime.KeepAlive(p.World)
	if err := failure(p.World, "Pin.Reaction", result, false); err != nil {
		return made0, made1, err
	}
	return answer.force, answer.torque, nil
}

var poolSheetGetPins pool[struct {
	count C.int32_t
}]

// Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are.
func (s Sheet) Pins() ([]Pin, error) {
	var made0 []Pin
	if err := s.World.check(); err != nil {
		return made0, err
	}
	room := C.int32_t(64)
again:
	pins := make([]C.kiriPin, room)
	block := poolSheetGetPins.take()
	result := C.kiriSheet_GetPins(s.World.c, C.kiriSheet(s.ID), unsafe.SliceData(pins), room, &block.count)
	answer := poolSheetGetPins.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Pins", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Pin](s.World, pins[:answer.count]), nil
}

var poolDefaultSeamDef pool[struct {
	def C.kiriSeamDef
}]

// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
// KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
func DefaultSeamDef() SeamDef {
	block := poolDefaultSeamDef.take()
	C.kiriDefaultSeamDef(&block.def)
	answer := poolDefaultSeamDef.give(block)
	var made SeamDef
	made.fromC(&answer.def)
	return made
}

var poolWorldCreateSeam pool[struct {
	seam C.kiriSeam
}]

// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
// KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
func (w *World) CreateSeam(def *SeamDef) (Seam, error) {
	var made0 Seam
	if err := w.check(); err != nil {
		return made0, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	block := poolWorldCreateSeam.take()
	result := C.kiriCreateSeam(w.c, def.toC(&pinner), &block.seam)
	answer := poolWorldCreateSeam.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.CreateSeam", result, true); err != nil {
		return made0, err
	}
	return Seam{w, SeamID(answer.seam)}, nil
}

// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
// KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
func (s Seam) Destroy() error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriDestroySeam(s.World.c, C.kiriSeam(s.ID))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Seam.Destroy", result, true); err != nil {
		return err
	}
	return nil
}

// Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
// KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing).
func (s Seam) SetHinge(stiffness float32, restAngle float32) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSeam_SetHinge(s.World.c, C.kiriSeam(s.ID), C.float(stiffness), C.float(restAngle))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Seam.SetHinge", result, true); err != nil {
		return err
	}
	return nil
}

var poolSeamGetStitch pool[struct {
	stitch Stitch
}]

// Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.
func (s Seam) Stitch(index int32) (Stitch, error) {
	var made0 Stitch
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSeamGetStitch.take()
	result := C.kiriSeam_GetStitch(s.World.c, C.kiriSeam(s.ID), C.int32_t(index), (*C.kiriStitch)(unsafe.Pointer(&block.stitch)))
	answer := poolSeamGetStitch.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Seam.Stitch", result, false); err != nil {
		return made0, err
	}
	return answer.stitch, nil
}

var poolSeamGetCount pool[struct {
	stitches C.int32_t
}]

// Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index.
func (s Seam) Count() (int32, error) {
	var made0 int32
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSeamGetCount.take()
	result := C.kiriSeam_GetCount(s.World.c, C.kiriSeam(s.ID), &block.stitches)
	answer := poolSeamGetCount.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Seam.Count", result, false); err != nil {
		return made0, err
	}
	return int32(answer.stitches), nil
}

var poolWorldGetSeams pool[struct {
	count C.int32_t
}]

// Writes up to `capacity` ids of the world's seams; *count is how many there are.
func (w *World) Seams() ([]Seam, error) {
	var made0 []Seam
	if err := w.check(); err != nil {
		return made0, err
	}
	room := C.int32_t(64)
again:
	seams := make([]C.kiriSeam, room)
	block := poolWorldGetSeams.take()
	result := C.kiriWorld_GetSeams(w.c, unsafe.SliceData(seams), room, &block.count)
	answer := poolWorldGetSeams.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.Seams", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Seam](w, seams[:answer.count]), nil
}

// Sets the contacts of the next tick alone. One with point and obstacle of an earlier one starts with its impulse.
func (s Sheet) SetContacts(contacts []Contact) error {
	if err := s.World.check(); err != nil {
		return err
	}
	result := C.kiriSheet_SetContacts(s.World.c, C.kiriSheet(s.ID), (*C.kiriContact)(unsafe.Pointer(unsafe.SliceData(contacts))), C.int32_t(len(contacts)))
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.SetContacts", result, true); err != nil {
		return err
	}
	return nil
}

var poolSheetGetContactForces pool[struct {
	forces *C.kiriContactForce
	count  C.int32_t
}]

// Gets one result for each contact that was set before the last tick, in that order. A sleeping piece presses on.
func (s Sheet) ContactForces() (View[ContactForce], error) {
	var made0 View[ContactForce]
	if err := s.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetContactForces.take()
	result := C.kiriSheet_GetContactForces(s.World.c, C.kiriSheet(s.ID), &block.forces, &block.count)
	answer := poolSheetGetContactForces.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.ContactForces", result, false); err != nil {
		return made0, err
	}
	return viewOf[ContactForce](s.World, unsafe.Pointer(answer.forces), int(answer.count)), nil
}

var poolDefaultObstacleDef pool[struct {
	def C.kiriObstacleDef
}]

// Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
func DefaultObstacleDef() ObstacleDef {
	block := poolDefaultObstacleDef.take()
	C.kiriDefaultObstacleDef(&block.def)
	answer := poolDefaultObstacleDef.give(block)
	var made ObstacleDef
	made.fromC(&answer.def)
	return made
}

var poolWorldCreateObstacle pool[struct {
	obstacle C.kiriObstacle
}]

// Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
func (w *World) CreateObstacle(def *ObstacleDef) (Obstacle, error) {
	var made0 Obstacle
	if err := w.check(); err != nil {
		return made0, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	block := poolWorldCreateObstacle.take()
	result := C.kiriCreateObstacle(w.c, def.toC(&pinner), &block.obstacle)
	answer := poolWorldCreateObstacle.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "World.CreateObstacle", result, true); err != nil {
		return made0, err
	}
	return Obstacle{w, ObstacleID(answer.obstacle)}, nil
}

// Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake.
func (o Obstacle) Destroy() error {
	if err := o.World.check(); err != nil {
		return err
	}
	result := C.kiriDestroyObstacle(o.World.c, C.kiriObstacle(o.ID))
	runtime.KeepAlive(o.World)
	if err := failure(o.World, "Obstacle.Destroy", result, true); err != nil {
		return err
	}
	return nil
}

var poolObstacleSetPose pool[struct {
	position [3]float32
	rotation [9]float32
}]

// Teleports the obstacle (m, world). Sheets react to its velocity (kiriObstacle_SetVelocity), not to the jump.
func (o Obstacle) SetPose(position [3]float32, rotation [9]float32) error {
	if err := o.World.check(); err != nil {
		return err
	}
	block := poolObstacleSetPose.take()
	block.position = position
	block.rotation = rotation
	result := C.kiriObstacle_SetPose(o.World.c, C.kiriObstacle(o.ID), (*C.float)(unsafe.Pointer(&block.position)), (*C.float)(unsafe.Pointer(&block.rotation)))
	poolObstacleSetPose.give(block)
	runtime.KeepAlive(o.World)
	if err := failure(o.World, "Obstacle.SetPose", result, true); err != nil {
		return err
	}
	return nil
}

var poolObstacleSetVelocity pool[struct {
	velocity        [3]float32
	angularVelocity [3]float32
}]

// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
func (o Obstacle) SetVelocity(velocity [3]float32, angularVelocity [3]float32) error {
	if err := o.World.check(); err != nil {
		return err
	}
	block := poolObstacleSetVelocity.take()
	block.velocity = velocity
	block.angularVelocity = angularVelocity
	result := C.kiriObstacle_SetVelocity(o.World.c, C.kiriObstacle(o.ID), (*C.float)(unsafe.Pointer(&block.velocity)), (*C.float)(unsafe.Pointer(&block.angularVelocity)))
	poolObstacleSetVelocity.give(block)
	runtime.KeepAlive(o.World)
	if err := failure(o.World, "Obstacle.SetVelocity", result, true); err != nil {
		return err
	}
	return nil
}

var poolObstacleSetSurfaceVelocity pool[struct {
	velocity [3]float32
}]

// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
func (o Obstacle) SetSurfaceVelocity(velocity [3]float32) error {
	if err := o.World.check(); err != nil {
		return err
	}
	block := poolObstacleSetSurfaceVelocity.take()
	block.velocity = velocity
	result := C.kiriObstacle_SetSurfaceVelocity(o.World.c, C.kiriObstacle(o.ID), (*C.float)(unsafe.Pointer(&block.velocity)))
	poolObstacleSetSurfaceVelocity.give(block)
	runtime.KeepAlive(o.World)
	if err := failure(o.World, "Obstacle.SetSurfaceVelocity", result, true); err != nil {
		return err
	}
	return nil
}

var poolObstacleSetMass pool[struct {
	inertia      [6]float32
	centerOfMass [3]float32
}]

// Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of mass.
func (o Obstacle) SetMass(mass float32, inertia [6]float32, centerOfMass [3]float32) error {
	if err := o.World.check(); err != nil {
		return err
	}
	block := poolObstacleSetMass.take()
	block.inertia = inertia
	block.centerOfMass = centerOfMass
	result := C.kiriObstacle_SetMass(o.World.c, C.kiriObstacle(o.ID), C.float(mass), (*C.float)(unsafe.Pointer(&block.inertia)), (*C.float)(unsafe.Pointer(&block.centerOfMass)))
	poolObstacleSetMass.give(block)
	runtime.KeepAlive(o.World)
	if err := failure(o.World, "Obstacle.SetMass", result, true); err != nil {
		return err
	}
	return nil
}

var poolObstacleGetState pool[struct {
	state ObstacleState
}]

// Gets the current state.
func (o Obstacle) State() (ObstacleState, error) {
	var made0 ObstacleState
	if err := o.World.check(); err != nil {
		return made0, err
	}
	block := poolObstacleGetState.take()
	result := C.kiriObstacle_GetState(o.World.c, C.kiriObstacle(o.ID), (*C.kiriObstacleState)(unsafe.Pointer(&block.state)))
	answer := poolObstacleGetState.give(block)
	runtime.KeepAlive(o.World)
	if err := failure(o.World, "Obstacle.State", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolSheetGetReach pool[struct {
	lower [3]float32
	upper [3]float32
}]

// Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add their way.
func (s Sheet) Reach(dt float32) ([3]float32, [3]float32, error) {
	var made0 [3]float32
	var made1 [3]float32
	if err := s.World.check(); err != nil {
		return made0, made1, err
	}
	block := poolSheetGetReach.take()
	result := C.kiriSheet_GetReach(s.World.c, C.kiriSheet(s.ID), C.float(dt), (*C.float)(unsafe.Pointer(&block.lower)), (*C.float)(unsafe.Pointer(&block.upper)))
	answer := poolSheetGetReach.give(block)
	runtime.KeepAlive(s.World)
	if err := failure(s.World, "Sheet.Reach", result, false); err != nil {
		return made0, made1, err
	}
	return answer.lower, answer.upper, nil
}

// For the test that none is missing.
var functions = map[string]string{
	"kiriGetVersion":                  ".GetVersion",
	"kiriGetResultName":               ".GetResultName",
	"kiriGetResultText":               ".GetResultText",
	"kiriDefaultWorldDef":             ".NewWorld",
	"kiriCreateWorld":                 ".NewWorld",
	"kiriDestroyWorld":                "World.Destroy",
	"kiriWorld_Tick":                  "World.Tick",
	"kiriWorld_GetLastError":          "World.LastError",
	"kiriWorld_ShiftOrigin":           "World.ShiftOrigin",
	"kiriWorld_SetGravity":            "World.SetGravity",
	"kiriWorld_SetBudget":             "World.SetBudget",
	"kiriWorld_GetStateHash":          "World.StateHash",
	"kiriWorld_GetSheets":             "World.Sheets",
	"kiriWorld_Note":                  "World.Note",
	"kiriWorld_Replay":                "World.Replay",
	"kiriWorld_Save":                  "World.Save",
	"kiriWorld_FinishCuts":            "World.FinishCuts",
	"kiriWorld_Load":                  "World.Load",
	"kiriWorld_Snapshot":              "World.Snapshot",
	"kiriWorld_Restore":               "World.Restore",
	"kiriWorld_GetEvents":             "World.Events",
	"kiriWorld_GetProfile":            "World.Profile",
	"kiriFitBudget":                   ".FitBudget",
	"kiriGetStageName":                ".GetStageName",
	"kiriGetMaterial":                 ".GetMaterial",
	"kiriGetQuality":                  ".GetQuality",
	"kiriDefaultSheetDef":             ".DefaultSheetDef",
	"kiriCreateSheet":                 "World.CreateSheet",
	"kiriDestroySheet":                "Sheet.Destroy",
	"kiriGetSetup":                    ".GetSetup",
	"kiriCreateRectangle":             "World.CreateRectangle",
	"kiriSheet_GetSettings":           "Sheet.Settings",
	"kiriSheet_SetSettings":           "Sheet.SetSettings",
	"kiriCreateFoldedSheet":           "World.CreateFoldedSheet",
	"kiriSheet_AddFold":               "Sheet.AddFold",
	"kiriSheet_GetFold":               "Sheet.Fold",
	"kiriSheet_SetFold":               "Sheet.SetFold",
	"kiriFillRectangle":               ".FillRectangle",
	"kiriSheet_GetMesh":               "Sheet.Mesh",
	"kiriSheet_GetDirty":              "Sheet.Dirty",
	"kiriSheet_CopyVertices":          "Sheet.CopyVertices",
	"kiriSheet_CopyPrevious":          "Sheet.CopyPrevious",
	"kiriSheet_CopyIndices16":         "Sheet.CopyIndices16",
	"kiriSheet_CopySources":           "Sheet.CopySources",
	"kiriSheet_CopySourceWeights":     "Sheet.CopySourceWeights",
	"kiriSheet_GetSolid":              "Sheet.Solid",
	"kiriSheet_GetCollisionPoints":    "Sheet.CollisionPoints",
	"kiriSheet_GetCounts":             "Sheet.Counts",
	"kiriSheet_GetTotals":             "Sheet.Totals",
	"kiriSheet_EstimateError":         "Sheet.EstimateError",
	"kiriSheet_IsAwake":               "Sheet.IsAwake",
	"kiriSheet_Wake":                  "Sheet.Wake",
	"kiriSheet_Transform":             "Sheet.Transform",
	"kiriSheet_SetVelocity":           "Sheet.SetVelocity",
	"kiriFrame_SetPieceVelocity":      "Frame.SetPieceVelocity",
	"kiriSheet_SetUserData":           "Sheet.SetUserData",
	"kiriSheet_GetUserData":           "Sheet.UserData",
	"kiriPin_SetUserData":             "Pin.SetUserData",
	"kiriPin_GetUserData":             "Pin.UserData",
	"kiriFrame_SetPieceUserData":      "Frame.SetPieceUserData",
	"kiriFrame_GetPieceUserData":      "Frame.PieceUserData",
	"kiriSheet_Raycast":               "Sheet.Raycast",
	"kiriWorld_Raycast":               "World.Raycast",
	"kiriSheet_GetPoint":              "Sheet.Point",
	"kiriSheet_GetWeights":            "Sheet.Weights",
	"kiriSheet_GetPiece":              "Sheet.Piece",
	"kiriSheet_GetPieceMesh":          "Sheet.PieceMesh",
	"kiriSheet_GetPieceFrames":        "Sheet.PieceFrames",
	"kiriFrame_GetPiece":              "Frame.Piece",
	"kiriFrame_DetachPiece":           "Frame.DetachPiece",
	"kiriFrame_DestroyPiece":          "Frame.DestroyPiece",
	"kiriWorld_DetachPieces":          "World.DetachPieces",
	"kiriWorld_DestroyPieces":         "World.DestroyPieces",
	"kiriSheet_DropCrumbs":            "Sheet.DropCrumbs",
	"kiriBeginCut":                    "Sheet.BeginCut",
	"kiriCut_Extend":                  "Cut.Extend",
	"kiriCut_End":                     "Cut.End",
	"kiriSheet_Cut":                   "Sheet.Cut",
	"kiriSheet_Slice":                 "Sheet.Slice",
	"kiriGetTearing":                  ".GetTearing",
	"kiriSheet_SetTearing":            "Sheet.SetTearing",
	"kiriSheet_GetTearing":            "Sheet.Tearing",
	"kiriSheet_SetTearLine":           "Sheet.SetTearLine",
	"kiriBeginBlade":                  "World.BeginBlade",
	"kiriBlade_MoveEdge":              "Blade.MoveEdge",
	"kiriBlade_MoveRay":               "Blade.MoveRay",
	"kiriBlade_End":                   "Blade.End",
	"kiriSheet_GetFrames":             "Sheet.Frames",
	"kiriFrame_Hold":                  "Frame.Hold",
	"kiriFrame_GetState":              "Frame.State",
	"kiriFrame_GetReaction":           "Frame.Reaction",
	"kiriFrame_ApplyForce":            "Frame.ApplyForce",
	"kiriSheet_ApplyForce":            "Sheet.ApplyForce",
	"kiriSheet_ApplyLineLoad":         "Sheet.ApplyLineLoad",
	"kiriSheet_ApplyPressure":         "Sheet.ApplyPressure",
	"kiriSheet_ApplyImpulse":          "Sheet.ApplyImpulse",
	"kiriSheet_SetWind":               "Sheet.SetWind",
	"kiriDefaultPinDef":               ".DefaultPinDef",
	"kiriCreatePin":                   "Sheet.CreatePin",
	"kiriDestroyPin":                  "Pin.Destroy",
	"kiriSheet_ClampLine":             "Sheet.ClampLine",
	"kiriSheet_HingeLine":             "Sheet.HingeLine",
	"kiriPin_SetTarget":               "Pin.SetTarget",
	"kiriPin_SetPose":                 "Pin.SetPose",
	"kiriPin_SetBreakForce":           "Pin.SetBreakForce",
	"kiriPin_GetState":                "Pin.State",
	"kiriPin_GetReaction":             "Pin.Reaction",
	"kiriSheet_GetPins":               "Sheet.Pins",
	"kiriDefaultSeamDef":              ".DefaultSeamDef",
	"kiriCreateSeam":                  "World.CreateSeam",
	"kiriDestroySeam":                 "Seam.Destroy",
	"kiriSeam_SetHinge":               "Seam.SetHinge",
	"kiriSeam_GetStitch":              "Seam.Stitch",
	"kiriSeam_GetCount":               "Seam.Count",
	"kiriWorld_GetSeams":              "World.Seams",
	"kiriSheet_SetContacts":           "Sheet.SetContacts",
	"kiriSheet_GetContactForces":      "Sheet.ContactForces",
	"kiriDefaultObstacleDef":          ".DefaultObstacleDef",
	"kiriCreateObstacle":              "World.CreateObstacle",
	"kiriDestroyObstacle":             "Obstacle.Destroy",
	"kiriObstacle_SetPose":            "Obstacle.SetPose",
	"kiriObstacle_SetVelocity":        "Obstacle.SetVelocity",
	"kiriObstacle_SetSurfaceVelocity": "Obstacle.SetSurfaceVelocity",
	"kiriObstacle_SetMass":            "Obstacle.SetMass",
	"kiriObstacle_GetState":           "Obstacle.State",
	"kiriSheet_GetReach":              "Sheet.Reach",
	"kiriDefaultDebugDraw":            ".DebugDraw",
	"kiriWorld_DebugDraw":             "World.DebugDraw",
}
