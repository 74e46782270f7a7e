// Code generated from kiri.h by make bindings. DO NOT EDIT.

package kiri

// #include <kiri/kiri.h>
import "C"

import (
	"runtime"
	"unsafe"
)

// Version of the header.
const Version = "0.12.0"

type ResultCode int32

const (
	Ok ResultCode = 0
	// done, and work is left for later ticks
	Pending ResultCode = 1
	// null pointer, NaN, infinite, or outside the documented range; or a sheet or obstacle would be where floats end, or
	// move that fast: 4e37 m, m/s or 1/s
	ErrorArgument ResultCode = -1
	// the def was not filled by its kiriDefault function, all zeros say: call that first
	ErrorDef ResultCode = -2
	// unknown or stale id, or the id of another kind
	ErrorId ResultCode = -3
	// the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping
	ErrorMesh ResultCode = -4
	// the call comes in the wrong order, or from a callback that may not make it
	ErrorState ResultCode = -5
	// the allocator returned null
	ErrorMemory ResultCode = -6
	// the motion of a sheet could not be continued; it was put to rest where it was
	Diverged ResultCode = -7
	// all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world
	ErrorLimit ResultCode = -8
	// floats are not computed as on other machines, see kiriCreateWorld
	ErrorBuild ResultCode = -9
	// bytes that are damaged, cut short, of something else, or of a later version
	ErrorData ResultCode = -10
	// a call that was made again gave something else than its recording has
	ErrorReplay ResultCode = -11
)

var namesResultCode = map[ResultCode]string{
	0: "KIRI_OK",
	1: "KIRI_PENDING",
	-1: "KIRI_ERROR_ARGUMENT",
	-2: "KIRI_ERROR_DEF",
	-3: "KIRI_ERROR_ID",
	-4: "KIRI_ERROR_MESH",
	-5: "KIRI_ERROR_STATE",
	-6: "KIRI_ERROR_MEMORY",
	-7: "KIRI_DIVERGED",
	-8: "KIRI_ERROR_LIMIT",
	-9: "KIRI_ERROR_BUILD",
	-10: "KIRI_ERROR_DATA",
	-11: "KIRI_ERROR_REPLAY",
}

func (value ResultCode) String() string { return namesResultCode[value] }

type BudgetLimit int32

const (
	LeastTriangles BudgetLimit = 16
)

var namesBudgetLimit = map[BudgetLimit]string{
	16: "KIRI_LEAST_TRIANGLES",
}

func (value BudgetLimit) String() string { return namesBudgetLimit[value] }

type NoteLimit int32

const (
	MostNoteBytes NoteLimit = 1048576
)

var namesNoteLimit = map[NoteLimit]string{
	1048576: "KIRI_MOST_NOTE_BYTES",
}

func (value NoteLimit) String() string { return namesNoteLimit[value] }

// What happened since the start of the last tick that was not refused.
type EventType int32

const (
	// cut: all of it is in the mesh; the id is stale from now on
	EventCutFinished EventType = 1
	// frame (its first, which names it), crumb, area: a connected part came off
	EventPieceOff EventType = 2
	// frame
	EventFrameAdded EventType = 3
	// the sheet was put to rest
	EventDiverged EventType = 4
	// stage, waiting: the budget ended in this stage of the sheet's work
	EventDeferred EventType = 5
	// pin: its force passed breakForce; the id is stale from now on
	EventPinBroke EventType = 6
	// sheet (the new one), frame, area: what kiriFrame_DetachPiece left waiting is done
	EventPieceDetached EventType = 7
)

var namesEventType = map[EventType]string{
	1: "KIRI_EVENT_CUT_FINISHED",
	2: "KIRI_EVENT_PIECE_OFF",
	3: "KIRI_EVENT_FRAME_ADDED",
	4: "KIRI_EVENT_DIVERGED",
	5: "KIRI_EVENT_DEFERRED",
	6: "KIRI_EVENT_PIN_BROKE",
	7: "KIRI_EVENT_PIECE_DETACHED",
}

func (value EventType) String() string { return namesEventType[value] }

// The stages of a tick in their order.
type Stage int32

const (
	// split the mesh along the blade
	StageCut Stage = 0
	// cells and what links them
	StageGrid Stage = 1
	// geodesic distances, regions, links; placing of frames
	StageRegions Stage = 2
	// shape functions
	StageShape Stage = 3
	// weights of vertices and collision points
	StageSamples Stage = 4
	// mass, the pattern of the solver's matrix, and when all is put in force
	StageConstants Stage = 5
	// what touches obstacles, other sheets and other pieces
	StageContact Stage = 6
	// the motion of the frames
	StageSolve Stage = 7
	// positions and normals of the mesh
	StageSkin Stage = 8
	StageCount Stage = 9
)

var namesStage = map[Stage]string{
	0: "KIRI_STAGE_CUT",
	1: "KIRI_STAGE_GRID",
	2: "KIRI_STAGE_REGIONS",
	3: "KIRI_STAGE_SHAPE",
	4: "KIRI_STAGE_SAMPLES",
	5: "KIRI_STAGE_CONSTANTS",
	6: "KIRI_STAGE_CONTACT",
	7: "KIRI_STAGE_SOLVE",
	8: "KIRI_STAGE_SKIN",
	9: "KIRI_STAGE_COUNT",
}

func (value Stage) String() string { return namesStage[value] }

// Materials to start from; src/world/kiri_preset.c says where their numbers come from.
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
	MaterialCount MaterialPreset = 4
)

var namesMaterialPreset = map[MaterialPreset]string{
	0: "KIRI_MATERIAL_PAPER",
	1: "KIRI_MATERIAL_COTTON",
	2: "KIRI_MATERIAL_RUBBER",
	3: "KIRI_MATERIAL_FOIL",
	4: "KIRI_MATERIAL_COUNT",
}

func (value MaterialPreset) String() string { return namesMaterialPreset[value] }

type QualityPreset int32

const (
	QualityFast QualityPreset = 0
	QualityBalanced QualityPreset = 1
	QualityAccurate QualityPreset = 2
	QualityCount QualityPreset = 3
)

var namesQualityPreset = map[QualityPreset]string{
	0: "KIRI_QUALITY_FAST",
	1: "KIRI_QUALITY_BALANCED",
	2: "KIRI_QUALITY_ACCURATE",
	3: "KIRI_QUALITY_COUNT",
}

func (value QualityPreset) String() string { return namesQualityPreset[value] }

// How a sheet deforms.
type Model int32

const (
	// Rigid frames joined by links: paper, foil, stiff cloth. 6 unknowns a frame, which its neighbours couple.
	ModelLinks Model = 0
	// Affine frames joined by links: cloth and rubber, whose stretch inside a region is seen. 12 unknowns a frame, which
	// neighbours of neighbours couple: a tick takes five to seven times as long as with KIRI_MODEL_LINKS. From 1e8 Pa or
	// so on it needs more `iterations`, 8 say.
	ModelAffine Model = 1
	// Affine frames, strains at integration points: the scheme of the paper, to compare with. Weights that vary across a
	// strip cannot bend it as a cylinder, however many points there are: a clamped strip on 9 frames goes 3, 20, 51 and
	// 70 % too short a way down where it is a 10th, 20th, 50th and 400th of its length thick. 12 unknowns a frame.
	ModelPoints Model = 2
)

var namesModel = map[Model]string{
	0: "KIRI_MODEL_LINKS",
	1: "KIRI_MODEL_AFFINE",
	2: "KIRI_MODEL_POINTS",
}

func (value Model) String() string { return namesModel[value] }

// What is seen between the frames, and met by rays, blades, obstacles, other sheets, and contacts of rest points;
// pins, clamps and holds hold it. Where nothing touches or holds the sheet it does not change how that moves.
// Collision points stay on the linear surface.
type Skinning int32

const (
	// each frame carries a flat patch; the weights blend them (equation 1 of the paper)
	SkinningLinear Skinning = 0
	// each carries a patch that bends towards its neighbours: no bumps at the frames
	SkinningSmooth Skinning = 1
)

var namesSkinning = map[Skinning]string{
	0: "KIRI_SKINNING_LINEAR",
	1: "KIRI_SKINNING_SMOOTH",
}

func (value Skinning) String() string { return namesSkinning[value] }

// How time is stepped. Both solve one linear system an iteration.
type TimeStepping int32

const (
	// TR-BDF2: trapezoid and BDF2 by turns, of second order. Motion lasts: of the energy of a swinging strip of 9 frames
	// 96 to 98 % is left after 10 s with 2 substeps a 60th of a second and 1 iteration, 99.7 % with 4. Backward Euler
	// takes its place in the steps in which a contact touches a piece, a pin or hold is made, moved or removed, or a
	// frame is new or turns by more than a radian.
	TimeSteppingSecondOrder TimeStepping = 0
	// Backward Euler, of first order: takes energy out of all that swings, the more the longer the step. Of that strip's
	// 0.4 % is left.
	TimeSteppingEuler TimeStepping = 1
)

var namesTimeStepping = map[TimeStepping]string{
	0: "KIRI_TIME_STEPPING_SECOND_ORDER",
	1: "KIRI_TIME_STEPPING_EULER",
}

func (value TimeStepping) String() string { return namesTimeStepping[value] }

// What a pin holds.
type PinType int32

const (
	PinPoint PinType = 0
	PinHinge PinType = 1
	PinClamp PinType = 2
)

var namesPinType = map[PinType]string{
	0: "KIRI_PIN_POINT",
	1: "KIRI_PIN_HINGE",
	2: "KIRI_PIN_CLAMP",
}

func (value PinType) String() string { return namesPinType[value] }

// A body that sheets touch: a floor, a ball, a crate of another engine. Kiri moves no obstacle by forces. An obstacle
// goes on with its velocities; a host that moves bodies by an engine of its own sets pose and velocities before each
// tick, and gives the impulse that kiriObstacle_GetState tells to that engine after it. Contacts follow its motion
// within the tick, and push no harder than its mass resists. Sheets stay half their contactThickness away from it;
// that is what is seen of them, with smooth skinning too. A sheet that rests wakes where an obstacle near it comes,
// goes, or has moved by half a second of its sleepSpeed. Lengths of shapes are up to 1e6 m.
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
	// outline: a convex polygon in the plane of the first two columns; height: along the third, 0: without end
	ObstaclePrism ObstacleType = 5
)

var namesObstacleType = map[ObstacleType]string{
	0: "KIRI_OBSTACLE_PLANE",
	1: "KIRI_OBSTACLE_SPHERE",
	2: "KIRI_OBSTACLE_CAPSULE",
	3: "KIRI_OBSTACLE_BOX",
	4: "KIRI_OBSTACLE_CYLINDER",
	5: "KIRI_OBSTACLE_PRISM",
}

func (value ObstacleType) String() string { return namesObstacleType[value] }

// What is drawn.
type DrawFlag uint32

const (
	// a triangle for each of the mesh, in a colour of its piece, pale where that sleeps
	DrawTriangles DrawFlag = 1
	// a line for each edge between two triangles
	DrawEdges DrawFlag = 2
	// a line for each edge of the outline and of lips
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
	DrawAll DrawFlag = 2047
)

var namesDrawFlag = map[DrawFlag]string{
	1: "KIRI_DRAW_TRIANGLES",
	2: "KIRI_DRAW_EDGES",
	4: "KIRI_DRAW_BORDERS",
	8: "KIRI_DRAW_FRAMES",
	16: "KIRI_DRAW_LINKS",
	32: "KIRI_DRAW_PINS",
	64: "KIRI_DRAW_CONTACTS",
	128: "KIRI_DRAW_BLADES",
	256: "KIRI_DRAW_BOXES",
	512: "KIRI_DRAW_OBSTACLES",
	1024: "KIRI_DRAW_POINTS",
	2047: "KIRI_DRAW_ALL",
}

func (value DrawFlag) String() string { return namesDrawFlag[value] }

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

// The most work that one tick may do, over all sheets. 0: no limit. Triangles, cells and samples share one allowance:
// using 30 % of one leaves 70 % of the others. So the work on cuts takes no longer than the costliest of the three
// limits alone. A single step that exceeds the whole limit is not split. It runs alone in its tick. Work that does
// not fit goes on in the next tick. Until a cut takes effect its lips move together. All points of a sheet that are
// pending when work on them begins take effect together, whatever ticks they were given before. So the tick in which
// a cut takes effect depends on the budget, too. Its result does not: when all work is done, mesh, grid, regions,
// weights and sites of frames equal, bit for bit, a run of the same calls without a budget. Motion differs. Sheets
// take turns. In every other tick the sheet whose points came first is served first, in the ticks between the sheet
// whose work has used least. Pieces that wait to be detached get half of every other tick. An example at 60 Hz, with
// 2 ms of work on cuts a tick (about 32 000 cells and 4000 samples): a cut from side to side of 64 x 64 squares with
// 9 frames parts 17 to 100 ms after the blade has left, one of 127 x 127 squares with 24 frames 67 to 200 ms. A slow
// blade parts sooner, for its work is done on the way. tests/bench_swipe.c prints the table.
type Budget struct {
	// split by blades; 0, or KIRI_LEAST_TRIANGLES and more
	Triangles int32
	// looked at, or given another distance: grid, regions, shape functions; a link counts as many
	Cells int32
	// vertices and collision points with new weights; and what it takes to put all that is new in force at once, which
	// is paid before
	Samples int32
	// work on linear systems, of 30 to 60 us each. A system counts 1, and 1 more for each 16 frames (5 of affine ones),
	// for each 64 contacts, and for each 1280 products of blocks that its factorisation takes: in a square of 24, 289,
	// 1000, 5000 frames it is 2, 36, 184, 2411. A sheet that gets fewer systems than its substeps takes longer ones.
	// Where one system of all its pieces is more than what is left, they take turns: some are moved, the others stay
	// where they are in this tick, with their velocity, and come first in the next; a sheet that gets none stands still,
	// too. A piece whose system is more than the whole limit is moved alone
	Iterations int32
}

// Of the fields after `sheet` an event has those that its type names; the others are 0, `stage` is -1.
type Event struct {
	// KIRI_EVENT_...
	Type EventType
	Sheet SheetID
	// or 0
	Cut CutID
	// or 0
	Frame FrameID
	// or 0
	Pin PinID
	// 1: the piece is a crumb, see kiriSheetDef
	Crumb int32
	// m^2 of the piece, or 0
	Area float32
	// KIRI_STAGE_..., or -1
	Stage Stage
	// blade points and ends of cuts that are pending or being worked on; or 0
	Waiting int32
}

// What the last tick did, and what it took.
type Profile struct {
	// of the last tick; zero without a clock
	Seconds [9]float64
	// blade segments that took effect
	CutSegments int32
	// Items, as the budget counts them: more than what is split or weighed, where one takes more work.
	TrianglesSplit int32
	// Items, as the budget counts them: more than what is split or weighed, where one takes more work.
	CellsSettled int32
	// Items, as the budget counts them: more than what is split or weighed, where one takes more work.
	SamplesRefreshed int32
	// Items, as the budget counts them: more than what is split or weighed, where one takes more work.
	SolverIterations int32
	// What commits changed: cells made or with other material, cells with other weights, vertices and collision points
	// with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.
	CellsChanged int32
	// What commits changed: cells made or with other material, cells with other weights, vertices and collision points
	// with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.
	WeightsChanged int32
	// What commits changed: cells made or with other material, cells with other weights, vertices and collision points
	// with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.
	VerticesChanged int32
	// What commits changed: cells made or with other material, cells with other weights, vertices and collision points
	// with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.
	PointsChanged int32
	// What commits changed: cells made or with other material, cells with other weights, vertices and collision points
	// with other weights, links that are other than before. Of how many: kiriSheet_GetCounts.
	LinksChanged int32
	// sheets in which a cut took effect
	Commits int32
	// linear systems, large and small
	SystemsSolved int32
	// planes given to the solver: the host's, those of obstacles, and those between sheets
	Contacts int32
	// pairs of sheets or pieces, near each other and not both asleep
	SheetPairs int32
	// The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by a
	// fade.
	LargestJump float64
	// The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by a
	// fade.
	LargestFade float64
}

// What a sheet is made of: homogeneous, isotropic.
type Material struct {
	// Pa, above 0
	YoungsModulus float32
	// 0 to below 0.5
	PoissonsRatio float32
	// m, above 0
	Thickness float32
	// kg/m^3, above 0
	Density float32
	// 1/s, 0 or more: velocities fade as exp(-airDamping t)
	AirDamping float32
	// s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation
	FlexDamping float32
}

// How much work for how much accuracy. The presets are measured (`make accuracy`; tests/sweep.h has the scenes) on a
// strip of stiff paper, 0.2 m x 0.05 m, clamped at one end, with one row of frames, and on a square of 0.2 m that
// bends five times as easily, hangs by two corners, and has half as many rows and columns, rounded up. Let go, they
// swing for 0.4 s at 60 ticks a second. Error: rms distance of the vertices from where a much finer run brings them,
// by the rms way that they go; at most, over grids from 4/5 to 5/4 as fine and with frames in regular rows or moved a
// little. FAST: 2 %. BALANCED: 0.8 %. ACCURATE: 0.4 %. What a cut leaves narrow wants more frames: see `accuracy` in
// the sheet def.
type Quality struct {
	// control frames in a row along a strip; a square does with half as many in either direction, rounded up: 3 x 3, 5 x
	// 5, 9 x 9
	FramesAlong int32
	// for the sheet def
	GridResolution int32
	// for the sheet def
	Iterations int32
	// for kiriWorld_Tick
	Substeps int32
}

// The paper's own ways, to compare with; part of the sheet def.
type PaperOptions struct {
	// 1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the same bit for bit. Default
	// 0.
	FromScratch int32
	// 1: when a cut takes effect, only new frames take their motion from the surface: what is seen jumps, and momentum
	// is not kept. Default 0.
	Popping int32
	// 1: the weights of frames are linear on the way from frame to frame, so the surface that is seen has a kink at each
	// frame. Always so with KIRI_MODEL_POINTS. Default 0: their slope is zero at the frames.
	LinearWeights int32
	// KIRI_MODEL_POINTS only. Work grows with the points: spread evenly over the sheet, at least one in every piece;
	// default 0: four for each of frameCount. Order 1 (default) takes the strain at a point for all of the material
	// around it, order 2 a strain linear in it, at four times the work a point. 0 to 1048576
	IntegrationPoints int32
	// 1 or 2
	IntegrationOrder int32
}

// Of a sheet: its rest shape, where it starts, its material, and how it is computed.
type SheetDef struct {
	cookie uint32
	// The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge. Holes and several parts
	// are fine. Copied by kiriCreateSheet; vertices of no triangle are left out. Edges whose ends lie at the same
	// places, but are different vertices, are the lips of a cut that is there already; weldDistance closes them. 2
	// floats (u, v) a vertex
	RestPositions [][2]float32
	// 3 a triangle
	Indices [][3]int32
	// Where it starts: x = position + u axisU + v axisV. The axes are orthonormal.
	Position [3]float32
	AxisU [3]float32
	AxisV [3]float32
	// m/s
	Velocity [3]float32
	Material Material
	// grid squares along the longer side, 1 to 4096; default 32
	GridResolution int32
	// m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a cut keeps within half
	// of it of its line; 0: 1e-4 of the longer side
	SnapDistance float32
	// Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture coordinates, and triangles
	// without shared vertices (STL). In the order of vertices, each becomes the nearest vertex that was kept before and
	// is nearer than this; else it is kept. So none moves farther, and a chain of near vertices is not one point. A
	// triangle with two corners at one vertex is left out. kiriSheet_CopySources leads to the vertices of the def.
	// Default 0: vertices are as the indices say.
	WeldDistance float32
	// Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
	// frames are spread evenly, some of them in pairs at both sides of slit ends. The grid carries one frame for every
	// two squares of material at most: more are refused (KIRI_ERROR_ARGUMENT), and re-sampling stops there. A new sheet
	// has no more frames than frameCount, or than pieces where these are more. frameCount 0: as many as the sheet needs:
	// a region is split while its size, 2.45 times its radius of gyration, exceeds 1.25 frameLength, after cuts too: so
	// arms that a cut leaves get frames along them. frameLength 0: it follows from `accuracy`, the relative error of the
	// shape under the sheet's own weight that is good enough, but is three squares of the grid at least.
	// kiriSheet_EstimateError says what came of it. 0, or 1 and more; default 5
	FrameCount int32
	// m; used where frameCount is 0; default 0
	FrameLength float32
	// 1e-4 to 1; used where frameCount and frameLength are 0; default 0.02
	Accuracy float32
	FramePoints [][2]float32
	// re-sampling stops here; default 256
	MaxFrames int32
	// Re-sampling (section 5 of the paper): a frame whose weight exceeds rigidWeight over an area larger than rigidArea
	// (m^2) gets others beside it. In a new sheet this is done only with frameCount 0. After cuts it is done where the
	// area is also larger than in the new sheet: when a cut ends, or has met the border or another cut. A sheet that is
	// to stay rigid sets frameCount and maxFrames to 1. rigidArea 0: a quarter of the area that a frame has at the
	// start. default 0.95
	RigidWeight float32
	// default 0
	RigidArea float32
	// A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it. Default
	// 0.
	CrumbArea float32
	// Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric
	// mean. Default 0.5
	Friction float32
	// m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's thickness, a
	// 20th of a grid square at least. Default 0
	ContactThickness float32
	// obstacles and sheets touch where a bit is set in the groups of both. Default: all
	Groups uint32
	// 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
	// two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other by
	// planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
	// feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays, and
	// momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its vertices,
	// about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps around the
	// border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece do not touch
	// each other. Pieces that touch wake and fall asleep together. Default 0.
	TouchesSheets int32
	// spread evenly over the sheet, at least one in every piece; default 0: none
	CollisionPoints int32
	// Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual
	Iterations int32
	// A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
	// asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
	// effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
	// something that moves and comes near. Gravity, wind, settings and kiriSheet_Wake wake all pieces of the sheet. The
	// ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.
	SleepSpeed float32
	// KIRI_MODEL_..., default KIRI_MODEL_LINKS
	Model Model
	// KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR
	Skinning Skinning
	// 1: the sheet stays in the plane where it starts, without bending; what velocities, forces and held positions have
	// across the plane is dropped. 3 unknowns a rigid frame, 6 an affine one: two thirds of the solver's work, or about
	// a third. Default 0.
	Planar int32
	// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
	TimeStepping TimeStepping
	// When a cut takes effect, weights change, and what is seen between the frames would jump. The difference fades
	// within this time (s). So does the difference of strain in links of KIRI_MODEL_LINKS whose borders have moved.
	// Default 0.2; 0: at once.
	FadeTime float32
	// 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and kiriSheet_CopyVertices copies none; this
	// saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
	// other sheets touch it, the tick makes normals for itself. So does kiriSheet_GetSolid; and what kiriSheet_GetPoint
	// says is the same to rounding. Default 1.
	Normals int32
	// default: none of the paper's own ways
	Paper PaperOptions
}

// What of the def may be changed while the sheet lives, as there. kiriSheet_GetSettings stamps it.
type SheetSettings struct {
	cookie uint32
	Material Material
	// re-sampling stops here; default 256
	MaxFrames int32
	// A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it. Default
	// 0.
	CrumbArea float32
	// Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric
	// mean. Default 0.5
	Friction float32
	// m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's thickness, a
	// 20th of a grid square at least. Default 0
	ContactThickness float32
	// obstacles and sheets touch where a bit is set in the groups of both. Default: all
	Groups uint32
	// 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
	// two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other by
	// planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
	// feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays, and
	// momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its vertices,
	// about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps around the
	// border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece do not touch
	// each other. Pieces that touch wake and fall asleep together. Default 0.
	TouchesSheets int32
	// Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual
	Iterations int32
	// A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
	// asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
	// effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
	// something that moves and comes near. Gravity, wind, settings and kiriSheet_Wake wake all pieces of the sheet. The
	// ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps.
	SleepSpeed float32
	// KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR
	Skinning Skinning
	// KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER
	TimeStepping TimeStepping
	// stays 0 with paper.popping
	FadeTime float32
	// 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and kiriSheet_CopyVertices copies none; this
	// saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
	// other sheets touch it, the tick makes normals for itself. So does kiriSheet_GetSolid; and what kiriSheet_GetPoint
	// says is the same to rounding. Default 1.
	Normals int32
}

// The triangles that are seen, as after the last tick. revision grows whenever indices or vertices are added or
// changed. Rest positions are floats, 6e-8 of the distance from the origin of the rest plane apart: where triangles
// are not much larger than that, they look flat or inverted. The library computes with the positions of the def to
// 2^-29 of the sheet; sourceTriangles and sourceWeights are as exact as the sheet is large.
type Mesh struct {
	// 3 a vertex, m, world
	Positions View[[3]float32]
	// 3 a vertex, unit; null where the sheet makes none
	Normals View[[3]float32]
	// 2 a vertex, m
	RestPositions View[[2]float32]
	// 3 a triangle
	Indices View[[3]int32]
	// 1 a vertex: the triangle of the def that it lies in,
	SourceTriangles View[int32]
	// 3 a vertex: and its barycentric coordinates there
	SourceWeights View[[3]float32]
	VertexCount int32
	TriangleCount int32
	Revision uint32
}

// So many items from the first on.
type Range struct {
	First int32
	Count int32
}

// What has changed in the mesh, for hosts that keep a copy of it, on a GPU say. Positions and normals change with
// every tick; all else of a vertex, and the corners of a triangle, only in these ranges.
type Dirty struct {
	// up to the last one of the mesh
	NewVertices Range
	// up to the last one of the mesh
	NewTriangles Range
	// the least ranges that hold all older ones with other data
	OldVertices Range
	// the least ranges that hold all older ones with other data
	OldTriangles Range
	// for the next call
	Revision uint32
}

// The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the lips of cuts. First
// come the vertices of kiriMesh on the side that the normal leaves, then the same on the other side, then four for
// each edge of the border, so that rims are flat and their edges sharp.
type Solid struct {
	// 3 a vertex, m, world
	Positions View[[3]float32]
	// 3 a vertex, unit, outwards
	Normals View[[3]float32]
	// 2 a vertex, m
	RestPositions View[[2]float32]
	// 3 a triangle, counter-clockwise from outside
	Indices View[[3]int32]
	// 1 a vertex: that of kiriMesh which it stands on
	Sources View[int32]
	VertexCount int32
	TriangleCount int32
	// from this one on triangles are rims
	RimTriangle int32
}

// How many there are of each.
type Counts struct {
	Vertices int32
	Triangles int32
	Cells int32
	Frames int32
	Links int32
	Pieces int32
	CollisionPoints int32
}

// Area (m^2), mass (kg), kinetic energy and elastic energy (J), linear and angular momentum about the world's origin
// (kg m/s, kg m^2/s), centre of mass (m).
type Totals struct {
	Area float64
	Mass float64
	KineticEnergy float64
	ElasticEnergy float64
	Center [3]float64
	Momentum [3]float64
	AngularMomentum [3]float64
}

// What a ray meets.
type Hit struct {
	// where to cut
	RestPoint [2]float32
	Position [3]float32
	Normal [3]float32
	// m along the direction, which need not be a unit vector
	Distance float32
	Triangle int32
}

// A point of the material, as it is seen.
type PointState struct {
	// m, world; unit
	Position [3]float32
	// m, world; unit
	Normal [3]float32
	// m/s, by the weights of the point
	Velocity [3]float32
	// in whose region it is; it names the piece, too
	Frame FrameID
}

// The connected parts of a sheet. A piece is named by any of its frames. To go through all of them there are indices
// too, from 0 on to kiriCounts.pieces, in the order of first frames: they change when a piece comes off or is taken
// away; kiriFrame_GetPiece has that of now. A cut whose work waits for its budget has not parted anything yet.
// Momentum is about the world's origin.
type PieceState struct {
	// m^2, kg
	Area float64
	// m^2, kg
	Mass float64
	// of mass, m; kg m/s; kg m^2/s
	Center [3]float64
	// of mass, m; kg m/s; kg m^2/s
	Momentum [3]float64
	// of mass, m; kg m/s; kg m^2/s
	AngularMomentum [3]float64
	// m, world: the least box around its vertices
	Lower [3]float32
	// m, world: the least box around its vertices
	Upper [3]float32
	// how many
	Frames int32
	// how many
	Vertices int32
	// how many
	Triangles int32
	// how many
	CollisionPoints int32
	// 1: see kiriSheetDef
	Crumb int32
	// 1: see sleepSpeed
	Asleep int32
}

// What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece after piece.
type PieceMesh struct {
	// of kiriMesh
	Vertices View[int32]
	// of kiriMesh
	Triangles View[int32]
	// 3 a triangle, as in kiriMesh: draw them
	Indices View[[3]int32]
	// see kiriSheet_GetCollisionPoints
	CollisionPoints View[int32]
	VertexCount int32
	TriangleCount int32
	CollisionPointCount int32
}

// Pose, motion and region of a frame.
type FrameState struct {
	RestPoint [2]float32
	// of the rest point
	Position [3]float32
	// columns: direction of u, direction of v, normal; of an affine frame the columns of A, which stretch with the sheet
	Rotation [9]float32
	// m/s
	Velocity [3]float32
	// rad/s
	AngularVelocity [3]float32
	// m^2 of its region
	Area float32
	// kg
	Mass float32
	// 1: moved by the host, see kiriFrame_Hold
	Held int32
}

// Air that moves past the sheet, in every tick until the next call. On each square metre act, with v the velocity of
// the air less that of the material, and n the normal: density / 2 times |v| (drag (v.n) n + lift (v - (v.n) n)).
// Zero velocity with drag and lift above zero: still air, which resists. All zero: none. It acts at four points of
// the region of each frame, and follows its motion within the tick: sheets flutter, and no wind is too strong. Gusts
// are a call a tick. Wind that stays as it is lets a sheet sleep.
type Wind struct {
	// m/s
	Velocity [3]float32
	// kg/m^3, 0 or more; 1.2 of air
	Density float32
	// 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along the sheet, 0.01 or
	// so of a smooth one
	Drag float32
	// 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along the sheet, 0.01 or
	// so of a smooth one
	Lift float32
}

// A pin holds a point of the material at its target, by a spring.
type PinDef struct {
	cookie uint32
	// in the material
	RestPoint [2]float32
	// m, world: where it is held
	Target [3]float32
	// N/m; 0: ten times Young's modulus times thickness
	Stiffness float32
	// N: it breaks (KIRI_EVENT_PIN_BROKE) in a tick in which it held with more; 0: never
	BreakForce float32
	// or 0. The target goes with this obstacle from where it is when the pin is made, or kiriPin_SetTarget puts it, and
	// the obstacle feels the pin (kiriObstacle_GetState); one with mass yields to it within the tick. When it is
	// destroyed the target stays where it was
	Obstacle ObstacleID
}

// What a pin is, and where it holds.
type PinState struct {
	// KIRI_PIN_...
	Type PinType
	Sheet SheetID
	// rest position: of a point, twice, or of the ends of the line
	From [2]float32
	// rest position: of a point, twice, or of the ends of the line
	To [2]float32
	Target [3]float32
	// of a line; of a point the identity
	Rotation [9]float32
	// N, or 0
	BreakForce float32
	// that it goes with, or 0
	Obstacle ObstacleID
}

// A point of the material that touches something: the plane dot(normal, x) = offset keeps it on its upper side, with
// as much force as that takes, and Coulomb friction acts along the plane. The plane is that of an obstacle of the
// host, who finds it anew for each tick from where the sheet is seen. A contact may lie in the path of the point,
// above or below it: one that does not reach its plane in the tick costs little and does nothing.
type Contact struct {
	// index of the collision point; -1: restPoint says which point of the material
	Point int32
	// in the material; only read where point is -1
	RestPoint [2]float32
	// unit, out of the obstacle
	Normal [3]float32
	// m: of the obstacle's surface at the start of the tick
	Offset float32
	// m/s: of the obstacle there. The plane moves with it within the tick, and friction acts against the sliding that is
	// left
	Velocity [3]float32
	// 0 or more: of both sides together
	Friction float32
	// 1/kg, 0 or more: of the obstacle as felt along the normal there, 1/m + (r x n) . I^-1 (r x n); 0: it does not
	// yield
	InverseMass float32
	// m/s, 0 or more: a point that starts below the plane is pushed out no faster. 0: 1 m/s
	PushSpeed float32
	// the host's number. Contacts of one number press on one obstacle, and share its mass
	Obstacle int32
}

// What a contact did in the last tick.
type ContactForce struct {
	// N s, on the sheet: the sum over the tick. The obstacle gets the opposite
	Impulse [3]float64
	// m, world: where it acted, the point of the sheet at the end of the tick
	Position [3]float64
	// m: how deep the point is below the plane at the end of the tick; below 0: above it
	Depth float64
	// as in the contact
	Point int32
	// as in the contact
	Obstacle int32
}

// Of an obstacle: its shape, where it is, its motion, and its mass.
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
	// 2 floats a corner, m, counter-clockwise; copied
	Outline [][2]float32
	// m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0
	Rounding float32
	// m, world
	Position [3]float32
	// columns; default: the axes of the world
	Rotation [9]float32
	// m/s, of its position
	Velocity [3]float32
	// rad/s
	AngularVelocity [3]float32
	// m/s, world: of its surface beside that, as of a conveyor
	SurfaceVelocity [3]float32
	// 0 or more; default 0.5
	Friction float32
	// kg; 0 (default): nothing moves it
	Mass float32
	// kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz. Positive definite, but
	// for axes whose numbers are all 0: it does not turn about these
	Inertia [6]float32
	// m, from its position in its own axes
	CenterOfMass [3]float32
	// obstacles of the same number, but 0, are parts of one body, whose mass each of them has
	Body uint32
	// m/s, above 0: what is inside is pushed out no faster. Default 1
	PushSpeed float32
	// see the sheet def. Default: all
	Groups uint32
}

// Where it is now, with what it moves, and what it felt.
type ObstacleState struct {
	Position [3]float32
	Rotation [9]float32
	Velocity [3]float32
	AngularVelocity [3]float32
	// N s, N m s about its centre of mass: what sheets and pins gave it in the last tick
	Impulse [3]float64
	// N s, N m s about its centre of mass: what sheets and pins gave it in the last tick
	AngularImpulse [3]float64
	// that pushed in the last tick
	Contacts int32
}

// A corner of what is drawn: as it is, it may go to a GPU.
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
var _ [0]struct{} = [unsafe.Sizeof(Range{}) - C.sizeof_kiriRange]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Dirty{}) - C.sizeof_kiriDirty]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Counts{}) - C.sizeof_kiriCounts]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Totals{}) - C.sizeof_kiriTotals]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Hit{}) - C.sizeof_kiriHit]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PointState{}) - C.sizeof_kiriPointState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PieceState{}) - C.sizeof_kiriPieceState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(FrameState{}) - C.sizeof_kiriFrameState]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(Wind{}) - C.sizeof_kiriWind]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PinDef{}) - C.sizeof_kiriPinDef]struct{}{}
var _ [0]struct{} = [unsafe.Sizeof(PinState{}) - C.sizeof_kiriPinState]struct{}{}
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
		Positions: viewOf[[3]float32](world, unsafe.Pointer(c.positions), int(c.vertexCount)),
		Normals: viewOf[[3]float32](world, unsafe.Pointer(c.normals), int(c.vertexCount)),
		RestPositions: viewOf[[2]float32](world, unsafe.Pointer(c.restPositions), int(c.vertexCount)),
		Indices: viewOf[[3]int32](world, unsafe.Pointer(c.indices), int(c.triangleCount)),
		SourceTriangles: viewOf[int32](world, unsafe.Pointer(c.sourceTriangles), int(c.vertexCount)),
		SourceWeights: viewOf[[3]float32](world, unsafe.Pointer(c.sourceWeights), int(c.vertexCount)),
		VertexCount: int32(c.vertexCount),
		TriangleCount: int32(c.triangleCount),
		Revision: uint32(c.revision),
	}
}

func viewSolid(world *World, c *C.kiriSolid) Solid {
	return Solid{
		Positions: viewOf[[3]float32](world, unsafe.Pointer(c.positions), int(c.vertexCount)),
		Normals: viewOf[[3]float32](world, unsafe.Pointer(c.normals), int(c.vertexCount)),
		RestPositions: viewOf[[2]float32](world, unsafe.Pointer(c.restPositions), int(c.vertexCount)),
		Indices: viewOf[[3]int32](world, unsafe.Pointer(c.indices), int(c.triangleCount)),
		Sources: viewOf[int32](world, unsafe.Pointer(c.sources), int(c.vertexCount)),
		VertexCount: int32(c.vertexCount),
		TriangleCount: int32(c.triangleCount),
		RimTriangle: int32(c.rimTriangle),
	}
}

func viewPieceMesh(world *World, c *C.kiriPieceMesh) PieceMesh {
	return PieceMesh{
		Vertices: viewOf[int32](world, unsafe.Pointer(c.vertices), int(c.vertexCount)),
		Triangles: viewOf[int32](world, unsafe.Pointer(c.triangles), int(c.triangleCount)),
		Indices: viewOf[[3]int32](world, unsafe.Pointer(c.indices), int(c.triangleCount)),
		CollisionPoints: viewOf[int32](world, unsafe.Pointer(c.collisionPoints), int(c.collisionPointCount)),
		VertexCount: int32(c.vertexCount),
		TriangleCount: int32(c.triangleCount),
		CollisionPointCount: int32(c.collisionPointCount),
	}
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

// The library's version, as KIRI_VERSION.
func GetVersion() int32 {
	return int32(C.kiriGetVersion())
}

// The name of a result, "KIRI_OK" and so on; "unknown" for another number.
func GetResultName(result ResultCode) string {
	return C.GoString(C.kiriGetResultName(C.kiriResult(result)))
}

// One line: the meaning of a result, and its cure. For calls without a world that keeps a line, such as
// kiriCreateWorld with a def of zeros (KIRI_ERROR_DEF).
func GetResultText(result ResultCode) string {
	return C.GoString(C.kiriGetResultText(C.kiriResult(result)))
}

// One fixed step of dt seconds (1e-6 to 10), solved in `substeps` equal parts (1 to 64). Takes the waiting cut
// points, then moves every sheet. KIRI_PENDING: the budget is spent and more work waits: the events say which cuts; a
// sheet, or some of its pieces, may also have stood still for want of iterations. KIRI_ERROR_MEMORY: nothing moved;
// cuts and pieces still wait, call again. Refused work is prepared again: until then kiriSheet_GetWeights gives
// KIRI_ERROR_STATE, and with a budget a cut may take effect some ticks later than it would have. KIRI_ERROR_LIMIT:
// the same, and it stays so until frames are destroyed. KIRI_DIVERGED: the sheets named by the events were put to
// rest, the others moved. Work may wait then, too, as KIRI_EVENT_DEFERRED says.
func (w *World) Tick(dt float32, substeps int32) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_Tick(w.c, C.float(dt), C.int32_t(substeps))
	w.epoch++
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_Tick", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolWorldSetGravity pool[struct {
	gravity [3]float32
}]

// m/s^2. All pieces wake.
func (w *World) SetGravity(gravity [3]float32) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	block := poolWorldSetGravity.take()
	block.gravity = gravity
	result := C.kiriWorld_SetGravity(w.c, (*C.float)(unsafe.Pointer(&block.gravity)))
	poolWorldSetGravity.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_SetGravity", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolWorldShiftOrigin pool[struct {
	origin [3]float32
}]

// Moves the origin of the world to a point (m): subtracts it from the positions of sheets, targets of pins and holds,
// obstacles, blades, and contacts that wait. The motion goes on as before, to rounding. Nothing wakes; (0, 0, 0)
// changes nothing. Use it in large worlds: far from the origin floats lose places. The host shifts its own data
// itself. Arrays that the library handed out keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a
// position would not fit a float. KIRI_ERROR_MEMORY: nothing has changed.
func (w *World) ShiftOrigin(origin [3]float32) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	block := poolWorldShiftOrigin.take()
	block.origin = origin
	result := C.kiriWorld_ShiftOrigin(w.c, (*C.float)(unsafe.Pointer(&block.origin)))
	poolWorldShiftOrigin.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_ShiftOrigin", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// Takes effect with the next tick.
func (w *World) SetBudget(budget *Budget) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_SetBudget(w.c, (*C.kiriBudget)(unsafe.Pointer(budget)))
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_SetBudget", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolWorldGetStateHash pool[struct {
	hash C.uint64_t
}]

// A hash of everything that the coming ticks depend on, work that waits for its budget included: two worlds that got
// the same calls have the same hash, and two with the same hash go on alike. After a refused allocation some items
// are made again: the hash tells that while work waits, or while the budget limits cells or samples.
func (w *World) StateHash() (uint64, error) {
	var made0 uint64
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldGetStateHash.take()
	result := C.kiriWorld_GetStateHash(w.c, &block.hash)
	answer := poolWorldGetStateHash.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_GetStateHash", result, false); err != nil {
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
	if err := failure(w, "kiriWorld_GetSheets", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Sheet](w, sheets[:answer.count]), nil
}

// Puts some bytes of the host's own (1 to KIRI_MOST_NOTE_BYTES) in the recording, where a replay finds them: what its
// camera saw, what a player pressed. The world does not change; without a recording nothing happens.
func (w *World) Note(bytes []byte) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_Note(w.c, unsafe.Pointer(unsafe.SliceData(bytes)), C.int32_t(len(bytes)))
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_Note", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts that wait for a budget
// take effect. The next tick reports the events. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in kiriWorld_Tick. Arrays
// that the world handed out end as with a tick.
func (w *World) FinishCuts() (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_FinishCuts(w.c)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_FinishCuts", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// Replaces the world by a saved one. It may have any hooks; its own allocation, log, clock and tasks stay. The bytes
// may come from anybody: a malicious save may give a strange world but cannot crash the program, and takes memory in
// proportion to its size. Takes about as long as to create the sheets. The profile has no times until the next tick.
// Arrays that the old world handed out live until then. KIRI_ERROR_DATA: the bytes are not a save, damaged, or of
// another version. KIRI_ERROR_MEMORY. Then nothing has changed. A recording has the bytes, up to 2^31 of them.
func (w *World) Load(bytes []byte) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_Load(w.c, unsafe.Pointer(unsafe.SliceData(bytes)), C.int64_t(len(bytes)))
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_Load", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// Replaces the world by the world of the snapshot; ids name the same things. The bytes are trusted: hand over only
// the output of kiriWorld_Snapshot. KIRI_ERROR_DATA: not a snapshot of this build of the library. KIRI_ERROR_MEMORY.
// KIRI_ERROR_STATE: the world is recorded. Then nothing has changed. Hooks and arrays as with kiriWorld_Load.
func (w *World) Restore(bytes []byte) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	result := C.kiriWorld_Restore(w.c, unsafe.Pointer(unsafe.SliceData(bytes)), C.int64_t(len(bytes)))
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_Restore", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolWorldGetEvents pool[struct {
	events *C.kiriEvent
	count C.int32_t
}]

// *events points to *count events.
func (w *World) Events() (View[Event], error) {
	var made0 View[Event]
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldGetEvents.take()
	result := C.kiriWorld_GetEvents(w.c, &block.events, &block.count)
	answer := poolWorldGetEvents.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_GetEvents", result, false); err != nil {
		return made0, err
	}
	return viewOf[Event](w, unsafe.Pointer(answer.events), int(answer.count)), nil
}

var poolWorldGetProfile pool[struct {
	profile Profile
}]

// Of the last tick that was not refused.
func (w *World) Profile() (Profile, error) {
	var made0 Profile
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldGetProfile.take()
	result := C.kiriWorld_GetProfile(w.c, (*C.kiriProfile)(unsafe.Pointer(&block.profile)))
	answer := poolWorldGetProfile.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_GetProfile", result, false); err != nil {
		return made0, err
	}
	return answer.profile, nil
}

// The name of a stage, for tables; "" for a number that is none.
func GetStageName(stage Stage) string {
	return C.GoString(C.kiriGetStageName(C.int32_t(stage)))
}

var poolGetMaterial pool[struct {
	material Material
}]

// The numbers of a preset, KIRI_MATERIAL_...
func GetMaterial(preset MaterialPreset) (Material, error) {
	var made0 Material
	block := poolGetMaterial.take()
	result := C.kiriGetMaterial(C.int32_t(preset), (*C.kiriMaterial)(unsafe.Pointer(&block.material)))
	answer := poolGetMaterial.give(block)
	if err := failure(nil, "kiriGetMaterial", result, false); err != nil {
		return made0, err
	}
	return answer.material, nil
}

var poolGetQuality pool[struct {
	quality Quality
}]

// The numbers of a preset, KIRI_QUALITY_...
func GetQuality(preset QualityPreset) (Quality, error) {
	var made0 Quality
	block := poolGetQuality.take()
	result := C.kiriGetQuality(C.int32_t(preset), (*C.kiriQuality)(unsafe.Pointer(&block.quality)))
	answer := poolGetQuality.give(block)
	if err := failure(nil, "kiriGetQuality", result, false); err != nil {
		return made0, err
	}
	return answer.quality, nil
}

var poolDefaultSheetDef pool[struct {
	def C.kiriSheetDef
}]

// Fills the def with its defaults, and stamps it. It has no mesh yet.
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

// Adds a sheet. On failure *sheet is 0. KIRI_ERROR_MESH: the triangles do not form a sheet. The line names a
// triangle, or the two triangles at an edge, by their numbers in the def, and says why.
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
	if err := failure(w, "kiriCreateSheet", result, true); err != nil {
		return made0, err
	}
	return Sheet{w, SheetID(answer.sheet)}, nil
}

// The sheet is gone, with its cuts, frames and pins; their ids are stale.
func (self Sheet) Destroy() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriDestroySheet(self.World.c, C.kiriSheet(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriDestroySheet", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolWorldCreateRectangle pool[struct {
	sheet C.kiriSheet
}]

// A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles;
// columns and rows are 1 to 4096. def: all but the mesh, which is not read; null: the defaults. A recording has it as
// kiriCreateSheet.
func (w *World) CreateRectangle(width float32, height float32, columns int32, rows int32, def *SheetDef) (Sheet, error) {
	var made0 Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	var pinner runtime.Pinner
	defer pinner.Unpin()
	var c *C.kiriSheetDef
	if def != nil {
		c = def.toC(&pinner)
	}
	block := poolWorldCreateRectangle.take()
	result := C.kiriCreateRectangle(w.c, C.float(width), C.float(height), C.int32_t(columns), C.int32_t(rows), c, &block.sheet)
	answer := poolWorldCreateRectangle.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriCreateRectangle", result, true); err != nil {
		return made0, err
	}
	return Sheet{w, SheetID(answer.sheet)}, nil
}

var poolSheetGetSettings pool[struct {
	settings SheetSettings
}]

// What they are now, stamped for kiriSheet_SetSettings.
func (self Sheet) Settings() (SheetSettings, error) {
	var made0 SheetSettings
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetSettings.take()
	result := C.kiriSheet_GetSettings(self.World.c, C.kiriSheet(self.ID), (*C.kiriSheetSettings)(unsafe.Pointer(&block.settings)))
	answer := poolSheetGetSettings.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetSettings", result, false); err != nil {
		return made0, err
	}
	return answer.settings, nil
}

// Checked as the def is: all or nothing. KIRI_ERROR_DEF: they did not come from GetSettings. The sheet wakes where
// one is other than before. Places and velocities stay: with another mass so momentum changes. Stiffnesses that pins
// have, and the lengths that frames were spread by, stay as they are.
func (self Sheet) SetSettings(settings *SheetSettings) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriSheet_SetSettings(self.World.c, C.kiriSheet(self.ID), (*C.kiriSheetSettings)(unsafe.Pointer(settings)))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_SetSettings", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetGetMesh pool[struct {
	mesh C.kiriMesh
}]

// The arrays, without a copy.
func (self Sheet) Mesh() (Mesh, error) {
	var made0 Mesh
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetMesh.take()
	result := C.kiriSheet_GetMesh(self.World.c, C.kiriSheet(self.ID), &block.mesh)
	answer := poolSheetGetMesh.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetMesh", result, false); err != nil {
		return made0, err
	}
	return viewMesh(self.World, &answer.mesh), nil
}

var poolSheetGetDirty pool[struct {
	dirty Dirty
}]

// What changed since the host saw that revision; all of the mesh where that is too long ago, or 0.
func (self Sheet) Dirty(sinceRevision uint32) (Dirty, error) {
	var made0 Dirty
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetDirty.take()
	result := C.kiriSheet_GetDirty(self.World.c, C.kiriSheet(self.ID), C.uint32_t(sinceRevision), (*C.kiriDirty)(unsafe.Pointer(&block.dirty)))
	answer := poolSheetGetDirty.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetDirty", result, false); err != nil {
		return made0, err
	}
	return answer.dirty, nil
}

var poolSheetGetSolid pool[struct {
	solid C.kiriSolid
}]

// thickness: m, 0: that of the material. Made when it is asked for.
func (self Sheet) Solid(thickness float32) (Solid, error) {
	var made0 Solid
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetSolid.take()
	result := C.kiriSheet_GetSolid(self.World.c, C.kiriSheet(self.ID), C.float(thickness), &block.solid)
	answer := poolSheetGetSolid.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetSolid", result, true); err != nil {
		return made0, err
	}
	return viewSolid(self.World, &answer.solid), nil
}

var poolSheetGetCollisionPoints pool[struct {
	positions *C.float
	count C.int32_t
}]

// Collision points: 3 floats of position (m, world) a point.
func (self Sheet) CollisionPoints() (View[[3]float32], error) {
	var made0 View[[3]float32]
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetCollisionPoints.take()
	result := C.kiriSheet_GetCollisionPoints(self.World.c, C.kiriSheet(self.ID), &block.positions, &block.count)
	answer := poolSheetGetCollisionPoints.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetCollisionPoints", result, false); err != nil {
		return made0, err
	}
	return viewOf[[3]float32](self.World, unsafe.Pointer(answer.positions), int(answer.count)), nil
}

var poolSheetGetCounts pool[struct {
	counts Counts
}]

// Costs nothing.
func (self Sheet) Counts() (Counts, error) {
	var made0 Counts
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetCounts.take()
	result := C.kiriSheet_GetCounts(self.World.c, C.kiriSheet(self.ID), (*C.kiriCounts)(unsafe.Pointer(&block.counts)))
	answer := poolSheetGetCounts.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetCounts", result, false); err != nil {
		return made0, err
	}
	return answer.counts, nil
}

var poolSheetGetTotals pool[struct {
	totals Totals
}]

// Sums over the frames, made when they are asked for.
func (self Sheet) Totals() (Totals, error) {
	var made0 Totals
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetTotals.take()
	result := C.kiriSheet_GetTotals(self.World.c, C.kiriSheet(self.ID), (*C.kiriTotals)(unsafe.Pointer(&block.totals)))
	answer := poolSheetGetTotals.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetTotals", result, false); err != nil {
		return made0, err
	}
	return answer.totals, nil
}

var poolSheetEstimateError pool[struct {
	relative C.double
}]

// An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly: rms distance from where
// a sheet of very many frames would be under the same loads, over the rms way that it has gone from its flat shape; 0
// to 1, and 1 where there are too few frames to tell. It compares the strains of neighbouring links (KIRI_MODEL_LINKS
// only; else KIRI_ERROR_STATE). Measured on cantilevers and on a sheet with a slit, of 3 to 140 frames, it is not
// below a third of the error, and not above four times the error or, where that is below 0.5 %, 1.5 %. Where a sheet
// also turned as a whole, as by hanging from two corners, it says up to ten times too much. It knows nothing of
// errors of the grid, of time stepping, and of loads that are finer than frames. It takes memory and time for one
// pass over the links, when it is called.
func (self Sheet) EstimateError() (float64, error) {
	var made0 float64
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetEstimateError.take()
	result := C.kiriSheet_EstimateError(self.World.c, C.kiriSheet(self.ID), &block.relative)
	answer := poolSheetEstimateError.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_EstimateError", result, false); err != nil {
		return made0, err
	}
	return float64(answer.relative), nil
}

var poolSheetIsAwake pool[struct {
	awake C.int32_t
}]

// *awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do. kiriSheet_Wake wakes
// all of them.
func (self Sheet) IsAwake() (bool, error) {
	var made0 bool
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetIsAwake.take()
	result := C.kiriSheet_IsAwake(self.World.c, C.kiriSheet(self.ID), &block.awake)
	answer := poolSheetIsAwake.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_IsAwake", result, false); err != nil {
		return made0, err
	}
	return answer.awake != 0, nil
}

// *awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do. kiriSheet_Wake wakes
// all of them.
func (self Sheet) Wake() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriSheet_Wake(self.World.c, C.kiriSheet(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_Wake", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetTransform pool[struct {
	rotation [9]float32
	translation [3]float32
}]

// Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities turn. The columns of
// `rotation` are where R takes the axes of the world; a planar sheet turns about its normal only. It wakes. Targets
// of its pins, hinges, clamps and holds go along, so nothing draws it back. To set a target to its current value
// changes nothing. A target that the host has set nearer to the new place of the pin than to the old one stays: so
// the host may set targets before or after. Pins on an obstacle stay on it: put the obstacle elsewhere by the same
// motion (kiriObstacle_SetPose), before or after. Loads and contacts that wait for the next tick stay.
func (self Sheet) Transform(rotation [9]float32, translation [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolSheetTransform.take()
	block.rotation = rotation
	block.translation = translation
	result := C.kiriSheet_Transform(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.rotation)), (*C.float)(unsafe.Pointer(&block.translation)))
	poolSheetTransform.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_Transform", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetSetVelocity pool[struct {
	velocity [3]float32
	angularVelocity [3]float32
}]

// From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
// `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow their
// hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone.
func (self Sheet) SetVelocity(velocity [3]float32, angularVelocity [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolSheetSetVelocity.take()
	block.velocity = velocity
	block.angularVelocity = angularVelocity
	result := C.kiriSheet_SetVelocity(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.velocity)), (*C.float)(unsafe.Pointer(&block.angularVelocity)))
	poolSheetSetVelocity.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_SetVelocity", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolFrameSetPieceVelocity pool[struct {
	velocity [3]float32
	angularVelocity [3]float32
}]

// From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
// `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow their
// hold. kiriFrame_SetPieceVelocity: of the piece with that frame alone.
func (self Frame) SetPieceVelocity(velocity [3]float32, angularVelocity [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolFrameSetPieceVelocity.take()
	block.velocity = velocity
	block.angularVelocity = angularVelocity
	result := C.kiriFrame_SetPieceVelocity(self.World.c, C.kiriFrame(self.ID), (*C.float)(unsafe.Pointer(&block.velocity)), (*C.float)(unsafe.Pointer(&block.angularVelocity)))
	poolFrameSetPieceVelocity.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_SetPieceVelocity", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
// parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
func (self Sheet) SetUserData(data uint64) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriSheet_SetUserData(self.World.c, C.kiriSheet(self.ID), C.uint64_t(data))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_SetUserData", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetGetUserData pool[struct {
	data C.uint64_t
}]

// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
// parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
func (self Sheet) UserData() (uint64, error) {
	var made0 uint64
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetUserData.take()
	result := C.kiriSheet_GetUserData(self.World.c, C.kiriSheet(self.ID), &block.data)
	answer := poolSheetGetUserData.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetUserData", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.data), nil
}

// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
// parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
func (self Pin) SetUserData(data uint64) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriPin_SetUserData(self.World.c, C.kiriPin(self.ID), C.uint64_t(data))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_SetUserData", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolPinGetUserData pool[struct {
	data C.uint64_t
}]

// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
// parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
func (self Pin) UserData() (uint64, error) {
	var made0 uint64
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolPinGetUserData.take()
	result := C.kiriPin_GetUserData(self.World.c, C.kiriPin(self.ID), &block.data)
	answer := poolPinGetUserData.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_GetUserData", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.data), nil
}

// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
// parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
func (self Frame) SetPieceUserData(data uint64) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriFrame_SetPieceUserData(self.World.c, C.kiriFrame(self.ID), C.uint64_t(data))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_SetPieceUserData", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolFrameGetPieceUserData pool[struct {
	data C.uint64_t
}]

// A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
// kiriFrame_DetachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
// parts of a piece that is cut have that of the piece, as does a sheet that is made of it.
func (self Frame) PieceUserData() (uint64, error) {
	var made0 uint64
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameGetPieceUserData.take()
	result := C.kiriFrame_GetPieceUserData(self.World.c, C.kiriFrame(self.ID), &block.data)
	answer := poolFrameGetPieceUserData.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_GetPieceUserData", result, false); err != nil {
		return made0, err
	}
	return uint64(answer.data), nil
}

var poolSheetRaycast pool[struct {
	origin [3]float32
	direction [3]float32
	hit Hit
}]

// Where a ray first meets the sheet, up to maxDistance. KIRI_OK with hit->triangle = -1: nowhere. The first ray looks
// at every triangle; the next tick makes boxes over them, and as long as somebody asks every now and then (in 120
// ticks) they follow the sheet: a ray takes some microseconds, and a tick of a large sheet a quarter more.
func (self Sheet) Raycast(origin [3]float32, direction [3]float32, maxDistance float32) (Hit, error) {
	var made0 Hit
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetRaycast.take()
	block.origin = origin
	block.direction = direction
	result := C.kiriSheet_Raycast(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.origin)), (*C.float)(unsafe.Pointer(&block.direction)), C.float(maxDistance), (*C.kiriHit)(unsafe.Pointer(&block.hit)))
	answer := poolSheetRaycast.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_Raycast", result, false); err != nil {
		return made0, err
	}
	return answer.hit, nil
}

var poolWorldRaycast pool[struct {
	origin [3]float32
	direction [3]float32
	sheet C.kiriSheet
	hit Hit
}]

// The first sheet that a ray meets; *sheet is 0 where there is none.
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
	if err := failure(w, "kiriWorld_Raycast", result, false); err != nil {
		return made0, made1, err
	}
	return Sheet{w, SheetID(answer.sheet)}, answer.hit, nil
}

var poolSheetGetPoint pool[struct {
	restPoint [2]float32
	state PointState
}]

// Outside the sheet: KIRI_ERROR_ARGUMENT. On a cut, the lip that holds the point; either where both do.
func (self Sheet) Point(restPoint [2]float32) (PointState, error) {
	var made0 PointState
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPoint.take()
	block.restPoint = restPoint
	result := C.kiriSheet_GetPoint(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), (*C.kiriPointState)(unsafe.Pointer(&block.state)))
	answer := poolSheetGetPoint.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetPoint", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolSheetGetPiece pool[struct {
	state PieceState
}]

// The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An index
// that is no piece's: KIRI_ERROR_ARGUMENT.
func (self Sheet) Piece(piece int32) (PieceState, error) {
	var made0 PieceState
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPiece.take()
	result := C.kiriSheet_GetPiece(self.World.c, C.kiriSheet(self.ID), C.int32_t(piece), (*C.kiriPieceState)(unsafe.Pointer(&block.state)))
	answer := poolSheetGetPiece.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetPiece", result, true); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolSheetGetPieceMesh pool[struct {
	mesh C.kiriPieceMesh
}]

// The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An index
// that is no piece's: KIRI_ERROR_ARGUMENT.
func (self Sheet) PieceMesh(piece int32) (PieceMesh, error) {
	var made0 PieceMesh
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPieceMesh.take()
	result := C.kiriSheet_GetPieceMesh(self.World.c, C.kiriSheet(self.ID), C.int32_t(piece), &block.mesh)
	answer := poolSheetGetPieceMesh.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetPieceMesh", result, true); err != nil {
		return made0, err
	}
	return viewPieceMesh(self.World, &answer.mesh), nil
}

var poolSheetGetPieceFrames pool[struct {
	frames *C.kiriFrame
	count C.int32_t
}]

// *frames points to *count ids.
func (self Sheet) PieceFrames(piece int32) (View[FrameID], error) {
	var made0 View[FrameID]
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetPieceFrames.take()
	result := C.kiriSheet_GetPieceFrames(self.World.c, C.kiriSheet(self.ID), C.int32_t(piece), &block.frames, &block.count)
	answer := poolSheetGetPieceFrames.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetPieceFrames", result, true); err != nil {
		return made0, err
	}
	return viewOf[FrameID](self.World, unsafe.Pointer(answer.frames), int(answer.count)), nil
}

var poolFrameGetPiece pool[struct {
	piece C.int32_t
}]

// The index that the piece with this frame has now.
func (self Frame) Piece() (int32, error) {
	var made0 int32
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameGetPiece.take()
	result := C.kiriFrame_GetPiece(self.World.c, C.kiriFrame(self.ID), &block.piece)
	answer := poolFrameGetPiece.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_GetPiece", result, false); err != nil {
		return made0, err
	}
	return int32(answer.piece), nil
}

var poolFrameDetachPiece pool[struct {
	detached C.kiriSheet
}]

// Makes a sheet of the piece with this frame. Its frames, pins and collision points move along, in their order; they
// keep their ids and states, and what waits for the next tick: the motion goes on as if nothing had happened, but for
// the solver's guard over energy and step length, which is one for each sheet. A clamp or hinge that holds both
// becomes two: the rest keeps the id, the new sheet's has one of its own (kiriSheet_GetPins). Both sheets have all
// settings (of collisionPoints and integrationPoints the share that falls to their area), maxFrames each for itself;
// a piece that sleeps goes on sleeping. Cuts stay with the rest: a blade in the piece cuts nothing until it is back.
// Indices of collision points of the rest change. Its triangles and vertices keep their indices where it has more
// than 4096 vertices, and while no more than half of them are of pieces that went: these triangles have three equal
// corners, these vertices are of no triangle. Else all move together, and their indices change. In either case its
// revision grows, and kiriSheet_GetDirty says what changed. The new sheet has the squares of the grid around it, at
// about 40 bytes a square: crumbs are better dropped. Costs what the piece takes to make, and a look at the weights
// of what is left; where indices change more. KIRI_PENDING: work on a cut is at hand in the sheet, or it takes more
// samples than the budget leaves calls before the next tick; *detached is 0. When the work is done, what is the piece
// of this frame then becomes a sheet, and KIRI_EVENT_PIECE_DETACHED names it. Samples pay for it before, over several
// ticks if need be, of many pieces one after the other: of the first that waits 3 for each vertex, 2.5 to 9 for each
// cell (the more frames, the more) and 100 for each frame, of others 3 for each vertex and 1.4 for each cell; and one
// for 80 vertices of the rest. Until then further cuts of the sheet wait. The first piece is made as it is paid, and
// leaves at the start of the tick after the last sample is paid. That tick does an eighth of the work; the first tick
// after a load makes the parts again that saves leave out. The coming ticks have fewer samples for the work of calls.
// KIRI_ERROR_STATE: nothing would be left of the sheet.
func (self Frame) DetachPiece() (Sheet, error) {
	var made0 Sheet
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameDetachPiece.take()
	result := C.kiriFrame_DetachPiece(self.World.c, C.kiriFrame(self.ID), &block.detached)
	answer := poolFrameDetachPiece.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_DetachPiece", result, true); err != nil {
		return made0, err
	}
	return Sheet{self.World, SheetID(answer.detached)}, nil
}

// The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but for making a sheet:
// that is done at once, and the coming ticks have less. Where kiriSheet_GetMesh has been called since the last tick,
// all indices are copied. KIRI_PENDING: work on a cut is at hand. The piece is gone all the same: its triangles are
// in kiriMesh, with three equal corners; it touches nothing; no point of it is found. When the work is done its
// vertices go, too; until then kiriCounts still counts it, and its kiriPieceState is all zeros.
func (self Frame) DestroyPiece() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriFrame_DestroyPiece(self.World.c, C.kiriFrame(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_DestroyPiece", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece count
// once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together. detached[i] is the
// sheet that the piece of frames[i] has become, 0 where it waits.
func (w *World) DetachPieces(frames []Frame) ([]Sheet, error) {
	var made0 []Sheet
	if err := w.check(); err != nil {
		return made0, err
	}
	ids := idsOf(frames)
	detached := make([]C.kiriSheet, len(ids))
	result := C.kiriWorld_DetachPieces(w.c, (*C.kiriFrame)(unsafe.Pointer(unsafe.SliceData(ids))), C.int32_t(len(ids)), unsafe.SliceData(detached))
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_DetachPieces", result, true); err != nil {
		return made0, err
	}
	return things[Sheet](w, detached), nil
}

// The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece count
// once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together. detached[i] is the
// sheet that the piece of frames[i] has become, 0 where it waits.
func (w *World) DestroyPieces(frames []Frame) (bool, error) {
	if err := w.check(); err != nil {
		return false, err
	}
	ids := idsOf(frames)
	result := C.kiriWorld_DestroyPieces(w.c, (*C.kiriFrame)(unsafe.Pointer(unsafe.SliceData(ids))), C.int32_t(len(ids)))
	runtime.KeepAlive(w)
	if err := failure(w, "kiriWorld_DestroyPieces", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetDropCrumbs pool[struct {
	count C.int32_t
}]

// Destroys all pieces below an area (m^2) except the largest piece, at the cost of one. *count is how many. Where
// that one waits to become a sheet, the largest of the others stays, too.
func (self Sheet) DropCrumbs(area float32) (int, error) {
	var made0 int
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetDropCrumbs.take()
	result := C.kiriSheet_DropCrumbs(self.World.c, C.kiriSheet(self.ID), C.float(area), &block.count)
	answer := poolSheetDropCrumbs.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_DropCrumbs", result, true); err != nil {
		return made0, err
	}
	return int(answer.count), nil
}

var poolSheetBeginCut pool[struct {
	restPoint [2]float32
	cut C.kiriCut
}]

// A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet cuts nothing. Points wait
// until the next tick. The end of a cut that lies inside the sheet stays closed until the blade moves on.
func (self Sheet) BeginCut(restPoint [2]float32) (Cut, error) {
	var made0 Cut
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetBeginCut.take()
	block.restPoint = restPoint
	result := C.kiriBeginCut(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), &block.cut)
	answer := poolSheetBeginCut.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriBeginCut", result, true); err != nil {
		return made0, err
	}
	return Cut{self.World, CutID(answer.cut)}, nil
}

// restPoints: 2 floats a point; count is 1 to 2^24.
func (self Cut) Extend(restPoints [][2]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriCut_Extend(self.World.c, C.kiriCut(self.ID), (*C.float)(unsafe.Pointer(unsafe.SliceData(restPoints))), C.int32_t(len(restPoints)))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriCut_Extend", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// No more points come. After the tick in which the last of them takes effect the id is stale, and
// KIRI_EVENT_CUT_FINISHED tells. Frames that the sheet needs after the cut are added then.
func (self Cut) End() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriCut_End(self.World.c, C.kiriCut(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriCut_End", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetSlice pool[struct {
	blade [12]float32
	cut C.kiriCut
}]

// A blade (a straight edge) that moves in world space from blade[0]-blade[1] to blade[3]-blade[2] cuts where the
// swept quadrilateral meets the sheet as it is now, past borders, so that it parts what it crosses. The cut is ended
// already. Slices of a sheet that moves do not join from tick to tick: for that take a blade.
func (self Sheet) Slice(blade [12]float32) (Cut, error) {
	var made0 Cut
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetSlice.take()
	block.blade = blade
	result := C.kiriSheet_Slice(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.blade)), &block.cut)
	answer := poolSheetSlice.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_Slice", result, true); err != nil {
		return made0, err
	}
	return Cut{self.World, CutID(answer.cut)}, nil
}

var poolWorldBeginBlade pool[struct {
	blade C.kiriBlade
}]

// sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of their own. A blade for
// one sheet whose sheet is gone cuts nothing.
func (w *World) BeginBlade(sheet Sheet) (Blade, error) {
	var made0 Blade
	if err := w.check(); err != nil {
		return made0, err
	}
	block := poolWorldBeginBlade.take()
	result := C.kiriBeginBlade(w.c, C.kiriSheet(sheet.ID), &block.blade)
	answer := poolWorldBeginBlade.give(block)
	runtime.KeepAlive(w)
	if err := failure(w, "kiriBeginBlade", result, true); err != nil {
		return made0, err
	}
	return Blade{w, BladeID(answer.blade)}, nil
}

var poolBladeMoveEdge pool[struct {
	from [3]float32
	to [3]float32
}]

// The blade is now the straight edge between two points (m, world). From where it was it got there straight, each end
// along a line. The first call only says where it begins. Where an end of the edge lies inside of what it sweeps of
// the sheet, it cuts only what it sweeps. An edge without length cuts nothing.
func (self Blade) MoveEdge(from [3]float32, to [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolBladeMoveEdge.take()
	block.from = from
	block.to = to
	result := C.kiriBlade_MoveEdge(self.World.c, C.kiriBlade(self.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)))
	poolBladeMoveEdge.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriBlade_MoveEdge", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolBladeMoveRay pool[struct {
	origin [3]float32
	direction [3]float32
}]

// The same for a ray that a camera casts: an edge `length` m long.
func (self Blade) MoveRay(origin [3]float32, direction [3]float32, length float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolBladeMoveRay.take()
	block.origin = origin
	block.direction = direction
	result := C.kiriBlade_MoveRay(self.World.c, C.kiriBlade(self.ID), (*C.float)(unsafe.Pointer(&block.origin)), (*C.float)(unsafe.Pointer(&block.direction)), C.float(length))
	poolBladeMoveRay.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriBlade_MoveRay", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends.
func (self Blade) End() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriBlade_End(self.World.c, C.kiriBlade(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriBlade_End", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetGetFrames pool[struct {
	count C.int32_t
}]

// Writes up to `capacity` ids of the sheet's frames; *count is how many there are.
func (self Sheet) Frames() ([]Frame, error) {
	var made0 []Frame
	if err := self.World.check(); err != nil {
		return made0, err
	}
	room := C.int32_t(64)
	again:
	frames := make([]C.kiriFrame, room)
	block := poolSheetGetFrames.take()
	result := C.kiriSheet_GetFrames(self.World.c, C.kiriSheet(self.ID), unsafe.SliceData(frames), room, &block.count)
	answer := poolSheetGetFrames.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetFrames", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Frame](self.World, frames[:answer.count]), nil
}

var poolFrameGetState pool[struct {
	state FrameState
}]

// Pose, motion and region as they are now.
func (self Frame) State() (FrameState, error) {
	var made0 FrameState
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolFrameGetState.take()
	result := C.kiriFrame_GetState(self.World.c, C.kiriFrame(self.ID), (*C.kiriFrameState)(unsafe.Pointer(&block.state)))
	answer := poolFrameGetState.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_GetState", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

// The host moves the frame: its rest point, as it is seen, goes to `position` with `rotation` (a rotation matrix,
// columns as above) in the next tick, evenly, and stays there until the next call. An affine frame is not stretched
// then. On a planar sheet the rotation is about its normal. Null, null: it is free again. Contacts do not push
// material that held frames carry for more than half: it goes where the host has it, through obstacles too.
func (self Frame) Hold(position *[3]float32, rotation *[9]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriFrame_Hold(self.World.c, C.kiriFrame(self.ID), (*C.float)(unsafe.Pointer(position)), (*C.float)(unsafe.Pointer(rotation)))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_Hold", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolFrameGetReaction pool[struct {
	force [3]float64
	torque [3]float64
}]

// With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the frame's rest point; means
// over the last tick, impulses divided by its dt. They carry the frame's own weight and change its momentum, too.
// Zero for a frame that was free. A piece that sleeps keeps those that it fell asleep with.
func (self Frame) Reaction() ([3]float64, [3]float64, error) {
	var made0 [3]float64
	var made1 [3]float64
	if err := self.World.check(); err != nil {
		return made0, made1, err
	}
	block := poolFrameGetReaction.take()
	result := C.kiriFrame_GetReaction(self.World.c, C.kiriFrame(self.ID), (*C.double)(unsafe.Pointer(&block.force)), (*C.double)(unsafe.Pointer(&block.torque)))
	answer := poolFrameGetReaction.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_GetReaction", result, false); err != nil {
		return made0, made1, err
	}
	return answer.force, answer.torque, nil
}

var poolFrameApplyForce pool[struct {
	force [3]float32
	torque [3]float32
}]

// A force (N, world) on the frame's centre of mass and a torque (N m).
func (self Frame) ApplyForce(force [3]float32, torque [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolFrameApplyForce.take()
	block.force = force
	block.torque = torque
	result := C.kiriFrame_ApplyForce(self.World.c, C.kiriFrame(self.ID), (*C.float)(unsafe.Pointer(&block.force)), (*C.float)(unsafe.Pointer(&block.torque)))
	poolFrameApplyForce.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriFrame_ApplyForce", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetApplyForce pool[struct {
	restPoint [2]float32
	force [3]float32
	torque [3]float32
}]

// A force (N, world) on a point of the material and a torque (N m).
func (self Sheet) ApplyForce(restPoint [2]float32, force [3]float32, torque [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolSheetApplyForce.take()
	block.restPoint = restPoint
	block.force = force
	block.torque = torque
	result := C.kiriSheet_ApplyForce(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), (*C.float)(unsafe.Pointer(&block.force)), (*C.float)(unsafe.Pointer(&block.torque)))
	poolSheetApplyForce.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_ApplyForce", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetApplyLineLoad pool[struct {
	from [2]float32
	to [2]float32
	forcePerLength [3]float32
}]

// A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in the material, edges
// included. Where it runs along a cut, each lip gets half. The ends differ; a line that meets no material:
// KIRI_ERROR_ARGUMENT.
func (self Sheet) ApplyLineLoad(from [2]float32, to [2]float32, forcePerLength [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolSheetApplyLineLoad.take()
	block.from = from
	block.to = to
	block.forcePerLength = forcePerLength
	result := C.kiriSheet_ApplyLineLoad(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)), (*C.float)(unsafe.Pointer(&block.forcePerLength)))
	poolSheetApplyLineLoad.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_ApplyLineLoad", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0.
func (self Sheet) ApplyPressure(pressure float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriSheet_ApplyPressure(self.World.c, C.kiriSheet(self.ID), C.float(pressure))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_ApplyPressure", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetApplyImpulse pool[struct {
	restPoint [2]float32
	impulse [3]float32
}]

// An impulse (N s, world) on a point of the material, where it is seen now. Velocities change at once, by as much as
// the frames that carry the point resist; a held frame's part is lost. Outside the sheet: KIRI_ERROR_ARGUMENT.
func (self Sheet) ApplyImpulse(restPoint [2]float32, impulse [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolSheetApplyImpulse.take()
	block.restPoint = restPoint
	block.impulse = impulse
	result := C.kiriSheet_ApplyImpulse(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.restPoint)), (*C.float)(unsafe.Pointer(&block.impulse)))
	poolSheetApplyImpulse.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_ApplyImpulse", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// Copied; it blows until the next call.
func (self Sheet) SetWind(wind *Wind) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriSheet_SetWind(self.World.c, C.kiriSheet(self.ID), (*C.kiriWind)(unsafe.Pointer(wind)))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_SetWind", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolDefaultPinDef pool[struct {
	def PinDef
}]

// Fills the def with its defaults, and stamps it.
func DefaultPinDef() PinDef {
	block := poolDefaultPinDef.take()
	C.kiriDefaultPinDef((*C.kiriPinDef)(unsafe.Pointer(&block.def)))
	answer := poolDefaultPinDef.give(block)
	return answer.def
}

var poolSheetCreatePin pool[struct {
	pin C.kiriPin
}]

// Pins a point of the sheet. On failure *pin is 0. A point outside the sheet: KIRI_ERROR_ARGUMENT.
func (self Sheet) CreatePin(def *PinDef) (Pin, error) {
	var made0 Pin
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetCreatePin.take()
	result := C.kiriCreatePin(self.World.c, C.kiriSheet(self.ID), (*C.kiriPinDef)(unsafe.Pointer(def)), &block.pin)
	answer := poolSheetCreatePin.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriCreatePin", result, true); err != nil {
		return made0, err
	}
	return Pin{self.World, PinID(answer.pin)}, nil
}

var poolSheetClampLine pool[struct {
	from [2]float32
	to [2]float32
	clamp C.kiriPin
}]

// Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and direction
// of the material there, as a vice does; a hinge its place only, so that the sheet may turn about the line. Both
// begin where the material is now; the line stays straight, and as long as it is at rest: so material that is bent
// there is pulled straight, and pieces that have come apart are pulled together, however fast that makes them.
// They hold what the line meets, edges included, with the stiffness that the material has between the line and the
// frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of frames, where
// kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two sides, so that neither
// bends the other. A line that runs along a cut holds both lips; one beside it, by a 512th of a square of the grid or
// more, holds one. The ends differ; a line that meets no material: KIRI_ERROR_ARGUMENT.
func (self Sheet) ClampLine(from [2]float32, to [2]float32) (Pin, error) {
	var made0 Pin
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetClampLine.take()
	block.from = from
	block.to = to
	result := C.kiriSheet_ClampLine(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)), &block.clamp)
	answer := poolSheetClampLine.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_ClampLine", result, true); err != nil {
		return made0, err
	}
	return Pin{self.World, PinID(answer.clamp)}, nil
}

var poolSheetHingeLine pool[struct {
	from [2]float32
	to [2]float32
	hinge C.kiriPin
}]

// Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and direction
// of the material there, as a vice does; a hinge its place only, so that the sheet may turn about the line. Both
// begin where the material is now; the line stays straight, and as long as it is at rest: so material that is bent
// there is pulled straight, and pieces that have come apart are pulled together, however fast that makes them.
// They hold what the line meets, edges included, with the stiffness that the material has between the line and the
// frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of frames, where
// kiriFrame_Hold clamps at a frame's site. A clamp through the sheet parts what is on its two sides, so that neither
// bends the other. A line that runs along a cut holds both lips; one beside it, by a 512th of a square of the grid or
// more, holds one. The ends differ; a line that meets no material: KIRI_ERROR_ARGUMENT.
func (self Sheet) HingeLine(from [2]float32, to [2]float32) (Pin, error) {
	var made0 Pin
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetHingeLine.take()
	block.from = from
	block.to = to
	result := C.kiriSheet_HingeLine(self.World.c, C.kiriSheet(self.ID), (*C.float)(unsafe.Pointer(&block.from)), (*C.float)(unsafe.Pointer(&block.to)), &block.hinge)
	answer := poolSheetHingeLine.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_HingeLine", result, true); err != nil {
		return made0, err
	}
	return Pin{self.World, PinID(answer.hinge)}, nil
}

var poolPinSetTarget pool[struct {
	target [3]float32
}]

// Where the pin holds its point, or the middle of its line (m, world): at the end of the next tick, and until the
// next call. Within the tick it goes there evenly. The current target of kiriPin_GetState changes nothing. With
// KIRI_SKINNING_SMOOTH what pins and clamps hold is what is seen there; of a clamp the mean along its line, for each
// piece: single points of the line are seen a little off it.
func (self Pin) SetTarget(target [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolPinSetTarget.take()
	block.target = target
	result := C.kiriPin_SetTarget(self.World.c, C.kiriPin(self.ID), (*C.float)(unsafe.Pointer(&block.target)))
	poolPinSetTarget.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_SetTarget", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolPinSetPose pool[struct {
	target [3]float32
	rotation [9]float32
}]

// The same with the rotation of the line's material: columns are the directions of u and v and the normal. On a
// planar sheet it is about the sheet's normal. KIRI_ERROR_ARGUMENT for a pin that holds a point.
func (self Pin) SetPose(target [3]float32, rotation [9]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolPinSetPose.take()
	block.target = target
	block.rotation = rotation
	result := C.kiriPin_SetPose(self.World.c, C.kiriPin(self.ID), (*C.float)(unsafe.Pointer(&block.target)), (*C.float)(unsafe.Pointer(&block.rotation)))
	poolPinSetPose.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_SetPose", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// As in the def, for pins of all types; N, 0: it never breaks.
func (self Pin) SetBreakForce(breakForce float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriPin_SetBreakForce(self.World.c, C.kiriPin(self.ID), C.float(breakForce))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_SetBreakForce", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolPinGetState pool[struct {
	state PinState
}]

// What it is, and where it holds now.
func (self Pin) State() (PinState, error) {
	var made0 PinState
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolPinGetState.take()
	result := C.kiriPin_GetState(self.World.c, C.kiriPin(self.ID), (*C.kiriPinState)(unsafe.Pointer(&block.state)))
	answer := poolPinGetState.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_GetState", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolPinGetReaction pool[struct {
	force [3]float64
	torque [3]float64
}]

// With what the pin acted on the sheet: force (N, world) and torque (N m) about its target; means over the last tick,
// impulses divided by its dt. So the reactions of all pins and held frames are the weight of a sheet at rest, and in
// motion what changes its momentum (as far as `iterations` have the tick solved). Zero before the first tick. A piece
// that sleeps keeps those that it fell asleep with.
func (self Pin) Reaction() ([3]float64, [3]float64, error) {
	var made0 [3]float64
	var made1 [3]float64
	if err := self.World.check(); err != nil {
		return made0, made1, err
	}
	block := poolPinGetReaction.take()
	result := C.kiriPin_GetReaction(self.World.c, C.kiriPin(self.ID), (*C.double)(unsafe.Pointer(&block.force)), (*C.double)(unsafe.Pointer(&block.torque)))
	answer := poolPinGetReaction.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriPin_GetReaction", result, false); err != nil {
		return made0, made1, err
	}
	return answer.force, answer.torque, nil
}

var poolSheetGetPins pool[struct {
	count C.int32_t
}]

// Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are.
func (self Sheet) Pins() ([]Pin, error) {
	var made0 []Pin
	if err := self.World.check(); err != nil {
		return made0, err
	}
	room := C.int32_t(64)
	again:
	pins := make([]C.kiriPin, room)
	block := poolSheetGetPins.take()
	result := C.kiriSheet_GetPins(self.World.c, C.kiriSheet(self.ID), unsafe.SliceData(pins), room, &block.count)
	answer := poolSheetGetPins.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetPins", result, false); err != nil {
		return made0, err
	}
	if answer.count > room {
		room = answer.count
		goto again
	}
	return things[Pin](self.World, pins[:answer.count]), nil
}

// It lets go; its id is stale.
func (self Pin) Destroy() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriDestroyPin(self.World.c, C.kiriPin(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriDestroyPin", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

// The contacts of the next tick; they replace those of an earlier call, and are gone after the tick. A contact is
// known again by its point, or its rest point, and its obstacle: what it pushed with is where the next tick starts.
func (self Sheet) SetContacts(contacts []Contact) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriSheet_SetContacts(self.World.c, C.kiriSheet(self.ID), (*C.kiriContact)(unsafe.Pointer(unsafe.SliceData(contacts))), C.int32_t(len(contacts)))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_SetContacts", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolSheetGetContactForces pool[struct {
	forces *C.kiriContactForce
	count C.int32_t
}]

// One for each contact that was set before the last tick, in the order given. The sum of the impulses, with those of
// gravity, loads and obstacles, is the change of momentum of a piece that nothing holds. A piece that sleeps goes on
// to press with what it fell asleep with.
func (self Sheet) ContactForces() (View[ContactForce], error) {
	var made0 View[ContactForce]
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolSheetGetContactForces.take()
	result := C.kiriSheet_GetContactForces(self.World.c, C.kiriSheet(self.ID), &block.forces, &block.count)
	answer := poolSheetGetContactForces.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetContactForces", result, false); err != nil {
		return made0, err
	}
	return viewOf[ContactForce](self.World, unsafe.Pointer(answer.forces), int(answer.count)), nil
}

var poolDefaultObstacleDef pool[struct {
	def C.kiriObstacleDef
}]

// Fills the def with its defaults, and stamps it.
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

// Adds an obstacle. On failure *obstacle is 0.
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
	if err := failure(w, "kiriCreateObstacle", result, true); err != nil {
		return made0, err
	}
	return Obstacle{w, ObstacleID(answer.obstacle)}, nil
}

// It is gone, its id stale. What rested on it wakes.
func (self Obstacle) Destroy() (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	result := C.kiriDestroyObstacle(self.World.c, C.kiriObstacle(self.ID))
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriDestroyObstacle", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolObstacleSetPose pool[struct {
	position [3]float32
	rotation [9]float32
}]

// Where it is when the next tick starts. It did not move there: velocities alone say what sheets feel. rotation: a
// rotation matrix, columns as in the def.
func (self Obstacle) SetPose(position [3]float32, rotation [9]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolObstacleSetPose.take()
	block.position = position
	block.rotation = rotation
	result := C.kiriObstacle_SetPose(self.World.c, C.kiriObstacle(self.ID), (*C.float)(unsafe.Pointer(&block.position)), (*C.float)(unsafe.Pointer(&block.rotation)))
	poolObstacleSetPose.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriObstacle_SetPose", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolObstacleSetVelocity pool[struct {
	velocity [3]float32
	angularVelocity [3]float32
}]

// With what it moves in the next tick and from then on.
func (self Obstacle) SetVelocity(velocity [3]float32, angularVelocity [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolObstacleSetVelocity.take()
	block.velocity = velocity
	block.angularVelocity = angularVelocity
	result := C.kiriObstacle_SetVelocity(self.World.c, C.kiriObstacle(self.ID), (*C.float)(unsafe.Pointer(&block.velocity)), (*C.float)(unsafe.Pointer(&block.angularVelocity)))
	poolObstacleSetVelocity.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriObstacle_SetVelocity", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolObstacleSetSurfaceVelocity pool[struct {
	velocity [3]float32
}]

// With what it moves in the next tick and from then on.
func (self Obstacle) SetSurfaceVelocity(velocity [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolObstacleSetSurfaceVelocity.take()
	block.velocity = velocity
	result := C.kiriObstacle_SetSurfaceVelocity(self.World.c, C.kiriObstacle(self.ID), (*C.float)(unsafe.Pointer(&block.velocity)))
	poolObstacleSetSurfaceVelocity.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriObstacle_SetSurfaceVelocity", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolObstacleSetMass pool[struct {
	inertia [6]float32
	centerOfMass [3]float32
}]

// As in the def.
func (self Obstacle) SetMass(mass float32, inertia [6]float32, centerOfMass [3]float32) (bool, error) {
	if err := self.World.check(); err != nil {
		return false, err
	}
	block := poolObstacleSetMass.take()
	block.inertia = inertia
	block.centerOfMass = centerOfMass
	result := C.kiriObstacle_SetMass(self.World.c, C.kiriObstacle(self.ID), C.float(mass), (*C.float)(unsafe.Pointer(&block.inertia)), (*C.float)(unsafe.Pointer(&block.centerOfMass)))
	poolObstacleSetMass.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriObstacle_SetMass", result, true); err != nil {
		return false, err
	}
	return result == C.KIRI_PENDING, nil
}

var poolObstacleGetState pool[struct {
	state ObstacleState
}]

// Pose and velocities as they are now.
func (self Obstacle) State() (ObstacleState, error) {
	var made0 ObstacleState
	if err := self.World.check(); err != nil {
		return made0, err
	}
	block := poolObstacleGetState.take()
	result := C.kiriObstacle_GetState(self.World.c, C.kiriObstacle(self.ID), (*C.kiriObstacleState)(unsafe.Pointer(&block.state)))
	answer := poolObstacleGetState.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriObstacle_GetState", result, false); err != nil {
		return made0, err
	}
	return answer.state, nil
}

var poolSheetGetReach pool[struct {
	lower [3]float32
	upper [3]float32
}]

// The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no obstacles or contacts
// outside. It reaches as far around the sheet as its fastest point can go by its velocity and gravity, twice, and the
// contact thickness. Obstacles that move themselves come as much nearer. dt as in kiriWorld_Tick.
func (self Sheet) Reach(dt float32) ([3]float32, [3]float32, error) {
	var made0 [3]float32
	var made1 [3]float32
	if err := self.World.check(); err != nil {
		return made0, made1, err
	}
	block := poolSheetGetReach.take()
	result := C.kiriSheet_GetReach(self.World.c, C.kiriSheet(self.ID), C.float(dt), (*C.float)(unsafe.Pointer(&block.lower)), (*C.float)(unsafe.Pointer(&block.upper)))
	answer := poolSheetGetReach.give(block)
	runtime.KeepAlive(self.World)
	if err := failure(self.World, "kiriSheet_GetReach", result, false); err != nil {
		return made0, made1, err
	}
	return answer.lower, answer.upper, nil
}

// For the test that none is missing.
var functions = map[string]string{
	"kiriGetVersion": ".GetVersion",
	"kiriGetResultName": ".GetResultName",
	"kiriGetResultText": ".GetResultText",
	"kiriDefaultWorldDef": ".NewWorld",
	"kiriCreateWorld": ".NewWorld",
	"kiriDestroyWorld": "World.Destroy",
	"kiriWorld_Tick": "World.Tick",
	"kiriWorld_GetLastError": "World.LastError",
	"kiriWorld_SetGravity": "World.SetGravity",
	"kiriWorld_ShiftOrigin": "World.ShiftOrigin",
	"kiriWorld_SetBudget": "World.SetBudget",
	"kiriWorld_GetStateHash": "World.StateHash",
	"kiriWorld_GetSheets": "World.Sheets",
	"kiriWorld_Note": "World.Note",
	"kiriWorld_Replay": "World.Replay",
	"kiriWorld_Save": "World.Save",
	"kiriWorld_FinishCuts": "World.FinishCuts",
	"kiriWorld_Load": "World.Load",
	"kiriWorld_Snapshot": "World.Snapshot",
	"kiriWorld_Restore": "World.Restore",
	"kiriWorld_GetEvents": "World.Events",
	"kiriWorld_GetProfile": "World.Profile",
	"kiriFitBudget": ".FitBudget",
	"kiriGetStageName": ".GetStageName",
	"kiriGetMaterial": ".GetMaterial",
	"kiriGetQuality": ".GetQuality",
	"kiriDefaultSheetDef": ".DefaultSheetDef",
	"kiriCreateSheet": "World.CreateSheet",
	"kiriDestroySheet": "Sheet.Destroy",
	"kiriCreateRectangle": "World.CreateRectangle",
	"kiriSheet_GetSettings": "Sheet.Settings",
	"kiriSheet_SetSettings": "Sheet.SetSettings",
	"kiriFillRectangle": ".FillRectangle",
	"kiriSheet_GetMesh": "Sheet.Mesh",
	"kiriSheet_GetDirty": "Sheet.Dirty",
	"kiriSheet_CopyVertices": "Sheet.CopyVertices",
	"kiriSheet_CopyPrevious": "Sheet.CopyPrevious",
	"kiriSheet_CopyIndices16": "Sheet.CopyIndices16",
	"kiriSheet_CopySources": "Sheet.CopySources",
	"kiriSheet_CopySourceWeights": "Sheet.CopySourceWeights",
	"kiriSheet_GetSolid": "Sheet.Solid",
	"kiriSheet_GetCollisionPoints": "Sheet.CollisionPoints",
	"kiriSheet_GetCounts": "Sheet.Counts",
	"kiriSheet_GetTotals": "Sheet.Totals",
	"kiriSheet_EstimateError": "Sheet.EstimateError",
	"kiriSheet_IsAwake": "Sheet.IsAwake",
	"kiriSheet_Wake": "Sheet.Wake",
	"kiriSheet_Transform": "Sheet.Transform",
	"kiriSheet_SetVelocity": "Sheet.SetVelocity",
	"kiriFrame_SetPieceVelocity": "Frame.SetPieceVelocity",
	"kiriSheet_SetUserData": "Sheet.SetUserData",
	"kiriSheet_GetUserData": "Sheet.UserData",
	"kiriPin_SetUserData": "Pin.SetUserData",
	"kiriPin_GetUserData": "Pin.UserData",
	"kiriFrame_SetPieceUserData": "Frame.SetPieceUserData",
	"kiriFrame_GetPieceUserData": "Frame.PieceUserData",
	"kiriSheet_Raycast": "Sheet.Raycast",
	"kiriWorld_Raycast": "World.Raycast",
	"kiriSheet_GetPoint": "Sheet.Point",
	"kiriSheet_GetWeights": "Sheet.Weights",
	"kiriSheet_GetPiece": "Sheet.Piece",
	"kiriSheet_GetPieceMesh": "Sheet.PieceMesh",
	"kiriSheet_GetPieceFrames": "Sheet.PieceFrames",
	"kiriFrame_GetPiece": "Frame.Piece",
	"kiriFrame_DetachPiece": "Frame.DetachPiece",
	"kiriFrame_DestroyPiece": "Frame.DestroyPiece",
	"kiriWorld_DetachPieces": "World.DetachPieces",
	"kiriWorld_DestroyPieces": "World.DestroyPieces",
	"kiriSheet_DropCrumbs": "Sheet.DropCrumbs",
	"kiriBeginCut": "Sheet.BeginCut",
	"kiriCut_Extend": "Cut.Extend",
	"kiriCut_End": "Cut.End",
	"kiriSheet_Slice": "Sheet.Slice",
	"kiriBeginBlade": "World.BeginBlade",
	"kiriBlade_MoveEdge": "Blade.MoveEdge",
	"kiriBlade_MoveRay": "Blade.MoveRay",
	"kiriBlade_End": "Blade.End",
	"kiriSheet_GetFrames": "Sheet.Frames",
	"kiriFrame_GetState": "Frame.State",
	"kiriFrame_Hold": "Frame.Hold",
	"kiriFrame_GetReaction": "Frame.Reaction",
	"kiriFrame_ApplyForce": "Frame.ApplyForce",
	"kiriSheet_ApplyForce": "Sheet.ApplyForce",
	"kiriSheet_ApplyLineLoad": "Sheet.ApplyLineLoad",
	"kiriSheet_ApplyPressure": "Sheet.ApplyPressure",
	"kiriSheet_ApplyImpulse": "Sheet.ApplyImpulse",
	"kiriSheet_SetWind": "Sheet.SetWind",
	"kiriDefaultPinDef": ".DefaultPinDef",
	"kiriCreatePin": "Sheet.CreatePin",
	"kiriSheet_ClampLine": "Sheet.ClampLine",
	"kiriSheet_HingeLine": "Sheet.HingeLine",
	"kiriPin_SetTarget": "Pin.SetTarget",
	"kiriPin_SetPose": "Pin.SetPose",
	"kiriPin_SetBreakForce": "Pin.SetBreakForce",
	"kiriPin_GetState": "Pin.State",
	"kiriPin_GetReaction": "Pin.Reaction",
	"kiriSheet_GetPins": "Sheet.Pins",
	"kiriDestroyPin": "Pin.Destroy",
	"kiriSheet_SetContacts": "Sheet.SetContacts",
	"kiriSheet_GetContactForces": "Sheet.ContactForces",
	"kiriDefaultObstacleDef": ".DefaultObstacleDef",
	"kiriCreateObstacle": "World.CreateObstacle",
	"kiriDestroyObstacle": "Obstacle.Destroy",
	"kiriObstacle_SetPose": "Obstacle.SetPose",
	"kiriObstacle_SetVelocity": "Obstacle.SetVelocity",
	"kiriObstacle_SetSurfaceVelocity": "Obstacle.SetSurfaceVelocity",
	"kiriObstacle_SetMass": "Obstacle.SetMass",
	"kiriObstacle_GetState": "Obstacle.State",
	"kiriSheet_GetReach": "Sheet.Reach",
	"kiriDefaultDebugDraw": ".DebugDraw",
	"kiriWorld_DebugDraw": "World.DebugDraw",
}
