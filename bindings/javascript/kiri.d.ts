// Made from include/kiri/kiri.h by bindings/generator. Do not edit.

/** Loads kiri.wasm, once, before anything else here is used. source: its URL, bytes or module; else it lies beside kiri.js. */
export function load(source?: string | URL | BufferSource | Response | WebAssembly.Module): Promise<void>;

/** All functions as C has them, with pointers as numbers: `layouts` has the structs. Null before load(). */
export const wasm: Record<string, any> & { memory: WebAssembly.Memory };

/** Bytes of structs in that memory, and where their fields are. */
export const layouts: Record<string, { size: number, fields: Record<string, number> }>;

/** Of the header that this file is made from. */
export const VERSION: string;

/** What failed, and the library's line about it. */
export class KiriError extends Error {
    readonly code: ResultCode;
}

/** Numbers of the library, without a copy. After the next tick they are gone, and `array` throws. Ask for it anew after
 *  other calls: the memory may have grown. */
export class View<A> {
    readonly length: number;
    readonly array: A;
}

/** Structs of the library, read one by one. After the next tick they are gone, and `at` throws. */
export class Rows<T> implements Iterable<T> {
    readonly length: number;
    /** into: what to read into, for those who make no garbage. */
    at(index: number, into?: T): T;
    [Symbol.iterator](): Iterator<T>;
}

export enum ResultCode {
    Ok = 0,
    /** done, and work is left for later ticks */
    Pending = 1,
    /** null pointer, NaN, infinite, or outside the documented range; or a sheet or obstacle would be where floats end,
     *  or move that fast: 4e37 m, m/s or 1/s */
    ErrorArgument = -1,
    /** the def was not filled by its kiriDefault function, all zeros say: call that first */
    ErrorDef = -2,
    /** unknown or stale id, or the id of another kind */
    ErrorId = -3,
    /** the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping */
    ErrorMesh = -4,
    /** the call comes in the wrong order, or from a callback that may not make it */
    ErrorState = -5,
    /** the allocator returned null */
    ErrorMemory = -6,
    /** the motion of a sheet could not be continued; it was put to rest where it was */
    Diverged = -7,
    /** all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world */
    ErrorLimit = -8,
    /** floats are not computed as on other machines, see kiriCreateWorld */
    ErrorBuild = -9,
    /** bytes that are damaged, cut short, of something else, or of a later version */
    ErrorData = -10,
    /** a call that was made again gave something else than its recording has */
    ErrorReplay = -11,
}

export const LEAST_TRIANGLES: 16;

export const MOST_NOTE_BYTES: 1048576;

/** What happened since the start of the last tick that was not refused. */
export enum EventType {
    /** cut: all of it is in the mesh; the id is stale from now on */
    CutFinished = 1,
    /** frame (its first, which names it), crumb, area: a connected part came off */
    PieceOff = 2,
    /** frame */
    FrameAdded = 3,
    /** the sheet was put to rest */
    Diverged = 4,
    /** stage, waiting: the budget ended in this stage of the sheet's work */
    Deferred = 5,
    /** pin: its force passed breakForce; the id is stale from now on */
    PinBroke = 6,
    /** sheet (the new one), frame, area: what Frame.detachPiece left waiting is done */
    PieceDetached = 7,
}

/** The stages of a tick in their order. */
export enum Stage {
    /** split the mesh along the blade */
    Cut = 0,
    /** cells and what links them */
    Grid = 1,
    /** geodesic distances, regions, links; placing of frames */
    Regions = 2,
    /** shape functions */
    Shape = 3,
    /** weights of vertices and collision points */
    Samples = 4,
    /** mass, the pattern of the solver's matrix, and when all is put in force */
    Constants = 5,
    /** what touches obstacles, other sheets and other pieces */
    Contact = 6,
    /** the motion of the frames */
    Solve = 7,
    /** positions and normals of the mesh */
    Skin = 8,
    Count = 9,
}

/** Materials to start from; src/world/kiri_preset.c says where their numbers come from. */
export enum MaterialPreset {
    /** printing paper, 0.11 mm */
    Paper = 0,
    /** cloth, 0.5 mm; the default of a sheet def */
    Cotton = 1,
    /** natural rubber, 1 mm */
    Rubber = 2,
    /** aluminium, 16 um */
    Foil = 3,
    Count = 4,
}

export enum QualityPreset {
    Fast = 0,
    Balanced = 1,
    Accurate = 2,
    Count = 3,
}

/** How a sheet deforms. */
export enum Model {
    /** Rigid frames joined by links: paper, foil, stiff cloth. 6 unknowns a frame, which its neighbours couple. */
    Links = 0,
    /** Affine frames joined by links: cloth and rubber, whose stretch inside a region is seen. 12 unknowns a frame,
     *  which neighbours of neighbours couple: a tick takes five to seven times as long as with KIRI_MODEL_LINKS. From
     *  1e8 Pa or so on it needs more `iterations`, 8 say. */
    Affine = 1,
    /** Affine frames, strains at integration points: the scheme of the paper, to compare with. Weights that vary across
     *  a strip cannot bend it as a cylinder, however many points there are: a clamped strip on 9 frames goes 3, 20, 51
     *  and 70 % too short a way down where it is a 10th, 20th, 50th and 400th of its length thick. 12 unknowns a frame. */
    Points = 2,
}

/** What is seen between the frames, and met by rays, blades, obstacles, other sheets, and contacts of rest points;
 *  pins, clamps and holds hold it. Where nothing touches or holds the sheet it does not change how that moves.
 *  Collision points stay on the linear surface. */
export enum Skinning {
    /** each frame carries a flat patch; the weights blend them (equation 1 of the paper) */
    Linear = 0,
    /** each carries a patch that bends towards its neighbours: no bumps at the frames */
    Smooth = 1,
}

/** How time is stepped. Both solve one linear system an iteration. */
export enum TimeStepping {
    /** TR-BDF2: trapezoid and BDF2 by turns, of second order. Motion lasts: of the energy of a swinging strip of 9
     *  frames 96 to 98 % is left after 10 s with 2 substeps a 60th of a second and 1 iteration, 99.7 % with 4. Backward
     *  Euler takes its place in the steps in which a contact touches a piece, a pin or hold is made, moved or removed,
     *  or a frame is new or turns by more than a radian. */
    SecondOrder = 0,
    /** Backward Euler, of first order: takes energy out of all that swings, the more the longer the step. Of that
     *  strip's 0.4 % is left. */
    Euler = 1,
}

/** What a pin holds. */
export enum PinType {
    Point = 0,
    Hinge = 1,
    Clamp = 2,
}

/** A body that sheets touch: a floor, a ball, a crate of another engine. Kiri moves no obstacle by forces. An obstacle
 *  goes on with its velocities; a host that moves bodies by an engine of its own sets pose and velocities before each
 *  tick, and gives the impulse that Obstacle.getState tells to that engine after it. Contacts follow its motion within
 *  the tick, and push no harder than its mass resists. Sheets stay half their contactThickness away from it; that is
 *  what is seen of them, with smooth skinning too. A sheet that rests wakes where an obstacle near it comes, goes, or
 *  has moved by half a second of its sleepSpeed. Lengths of shapes are up to 1e6 m. */
export enum ObstacleType {
    /** all below the plane through its position; the third column of its rotation points out */
    Plane = 0,
    /** radius */
    Sphere = 1,
    /** radius, height: of its axis, the third column, between the middles of its round ends */
    Capsule = 2,
    /** size: lengths of its edges along the columns of its rotation */
    Box = 3,
    /** radius, height: along the third column */
    Cylinder = 4,
    /** outline: a convex polygon in the plane of the first two columns; height: along the third, 0: without end */
    Prism = 5,
}

/** What is drawn. */
export enum DrawFlag {
    /** a triangle for each of the mesh, in a colour of its piece, pale where that sleeps */
    Triangles = 1,
    /** a line for each edge between two triangles */
    Edges = 2,
    /** a line for each edge of the outline and of lips */
    Borders = 4,
    /** a point and three axes each: u red, v green, normal blue; held ones red */
    Frames = 8,
    /** two lines each: from frame to frame by the middle of their border */
    Links = 16,
    /** a point at the target; a line to the point of the material, or along the line */
    Pins = 32,
    /** a point and its normal for each that pushed as the last tick ended */
    Contacts = 64,
    /** a line along the edge, and a point in each layer that it is in */
    Blades = 128,
    /** twelve lines around each piece */
    Boxes = 256,
    /** lines along edges and rims, without the rounding; a plane is a square */
    Obstacles = 512,
    /** a point for each collision point */
    Points = 1024,
    All = 2047,
}

/** The most work that one tick may do, over all sheets. 0: no limit. Triangles, cells and samples share one allowance:
 *  using 30 % of one leaves 70 % of the others. So the work on cuts takes no longer than the costliest of the three
 *  limits alone. A single step that exceeds the whole limit is not split. It runs alone in its tick. Work that does not
 *  fit goes on in the next tick. Until a cut takes effect its lips move together. All points of a sheet that are
 *  pending when work on them begins take effect together, whatever ticks they were given before. So the tick in which a
 *  cut takes effect depends on the budget, too. Its result does not: when all work is done, mesh, grid, regions,
 *  weights and sites of frames equal, bit for bit, a run of the same calls without a budget. Motion differs. Sheets
 *  take turns. In every other tick the sheet whose points came first is served first, in the ticks between the sheet
 *  whose work has used least. Pieces that wait to be detached get half of every other tick. An example at 60 Hz, with 2
 *  ms of work on cuts a tick (about 32 000 cells and 4000 samples): a cut from side to side of 64 x 64 squares with 9
 *  frames parts 17 to 100 ms after the blade has left, one of 127 x 127 squares with 24 frames 67 to 200 ms. A slow
 *  blade parts sooner, for its work is done on the way. tests/bench_swipe.c prints the table. */
export class Budget {
    /** split by blades; 0, or KIRI_LEAST_TRIANGLES and more */
    triangles: number;
    /** looked at, or given another distance: grid, regions, shape functions; a link counts as many */
    cells: number;
    /** vertices and collision points with new weights; and what it takes to put all that is new in force at once, which
     *  is paid before */
    samples: number;
    /** work on linear systems, of 30 to 60 us each. A system counts 1, and 1 more for each 16 frames (5 of affine
     *  ones), for each 64 contacts, and for each 1280 products of blocks that its factorisation takes: in a square of
     *  24, 289, 1000, 5000 frames it is 2, 36, 184, 2411. A sheet that gets fewer systems than its substeps takes
     *  longer ones. Where one system of all its pieces is more than what is left, they take turns: some are moved, the
     *  others stay where they are in this tick, with their velocity, and come first in the next; a sheet that gets none
     *  stands still, too. A piece whose system is more than the whole limit is moved alone */
    iterations: number;
}
/** What a host gives as Budget: what is left out is 0. */
export interface BudgetGiven {
    /** split by blades; 0, or KIRI_LEAST_TRIANGLES and more */
    triangles?: number;
    /** looked at, or given another distance: grid, regions, shape functions; a link counts as many */
    cells?: number;
    /** vertices and collision points with new weights; and what it takes to put all that is new in force at once, which
     *  is paid before */
    samples?: number;
    /** work on linear systems, of 30 to 60 us each. A system counts 1, and 1 more for each 16 frames (5 of affine
     *  ones), for each 64 contacts, and for each 1280 products of blocks that its factorisation takes: in a square of
     *  24, 289, 1000, 5000 frames it is 2, 36, 184, 2411. A sheet that gets fewer systems than its substeps takes
     *  longer ones. Where one system of all its pieces is more than what is left, they take turns: some are moved, the
     *  others stay where they are in this tick, with their velocity, and come first in the next; a sheet that gets none
     *  stands still, too. A piece whose system is more than the whole limit is moved alone */
    iterations?: number;
}

/** Of a world: gravity, budget, and the host's functions. */
export class WorldDef {
    cookie: number;
    /** m/s^2; default (0, 0, -9.81) */
    gravity: number[];
    /** default: no limit */
    budget: Budget;
    /** the recording has the state hash after so many ticks, and at the end; 0: never. Default 60 */
    recordHashTicks: number;
}
/** What a host gives as WorldDef: what is left out is as the default has it. */
export interface WorldDefGiven {
    cookie?: number;
    /** m/s^2; default (0, 0, -9.81) */
    gravity?: ArrayLike<number>;
    /** default: no limit */
    budget?: BudgetGiven;
    /** the recording has the state hash after so many ticks, and at the end; 0: never. Default 60 */
    recordHashTicks?: number;
    /** Gets one line for each error. */
    log?: (line: string) => void;
    /** Seconds, for the profile. */
    clock?: () => number;
    /** Gets the next bytes of the recording. */
    record?: (bytes: Uint8Array) => void;
}

export function defaultWorldDef(into?: WorldDef): WorldDef;

/** How far a replay has come: all zero at its start. */
export class Replay {
    /** in the recording: where it goes on */
    offset: number;
    /** made so far */
    calls: number;
    /** that were not refused */
    ticks: number;
    /** where it stopped at a note: its bytes, in the recording; else null */
    note: Uint8Array | null;
    noteCount: number;
}
/** What a host gives as Replay: what is left out is 0. */
export interface ReplayGiven {
    /** in the recording: where it goes on */
    offset?: number;
    /** made so far */
    calls?: number;
    /** that were not refused */
    ticks?: number;
}

/** Of the fields after `sheet` an event has those that its type names; the others are 0, `stage` is -1. */
export type Event =
    { type: EventType.CutFinished; sheet: Sheet; cut: Cut } |
    { type: EventType.PieceOff; sheet: Sheet; frame: Frame; crumb: boolean; area: number } |
    { type: EventType.FrameAdded; sheet: Sheet; frame: Frame } |
    { type: EventType.Diverged; sheet: Sheet } |
    { type: EventType.Deferred; sheet: Sheet; stage: Stage; waiting: number } |
    { type: EventType.PinBroke; sheet: Sheet; pin: Pin } |
    { type: EventType.PieceDetached; sheet: Sheet; frame: Frame; area: number };

/** What the last tick did, and what it took. */
export class Profile {
    /** of the last tick; zero without a clock */
    seconds: number[];
    /** blade segments that took effect */
    cutSegments: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    trianglesSplit: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    cellsSettled: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    samplesRefreshed: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    solverIterations: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    cellsChanged: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    weightsChanged: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    verticesChanged: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    pointsChanged: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    linksChanged: number;
    /** sheets in which a cut took effect */
    commits: number;
    /** linear systems, large and small */
    systemsSolved: number;
    /** planes given to the solver: the host's, those of obstacles, and those between sheets */
    contacts: number;
    /** pairs of sheets or pieces, near each other and not both asleep */
    sheetPairs: number;
    /** The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by
     *  a fade. */
    largestJump: number;
    /** The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by
     *  a fade. */
    largestFade: number;
}
/** What a host gives as Profile: what is left out is 0. */
export interface ProfileGiven {
    /** of the last tick; zero without a clock */
    seconds?: ArrayLike<number>;
    /** blade segments that took effect */
    cutSegments?: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    trianglesSplit?: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    cellsSettled?: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    samplesRefreshed?: number;
    /** Items, as the budget counts them: more than what is split or weighed, where one takes more work. */
    solverIterations?: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    cellsChanged?: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    weightsChanged?: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    verticesChanged?: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    pointsChanged?: number;
    /** What commits changed: cells made or with other material, cells with other weights, vertices and collision points
     *  with other weights, links that are other than before. Of how many: Sheet.getCounts. */
    linksChanged?: number;
    /** sheets in which a cut took effect */
    commits?: number;
    /** linear systems, large and small */
    systemsSolved?: number;
    /** planes given to the solver: the host's, those of obstacles, and those between sheets */
    contacts?: number;
    /** pairs of sheets or pieces, near each other and not both asleep */
    sheetPairs?: number;
    /** The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by
     *  a fade. */
    largestJump?: number;
    /** The farthest that a vertex would have jumped, m, when a cut took effect, without fadeTime; and that one went by
     *  a fade. */
    largestFade?: number;
}

/** What a sheet is made of: homogeneous, isotropic. */
export class Material {
    /** Pa, above 0 */
    youngsModulus: number;
    /** 0 to below 0.5 */
    poissonsRatio: number;
    /** m, above 0 */
    thickness: number;
    /** kg/m^3, above 0 */
    density: number;
    /** 1/s, 0 or more: velocities fade as exp(-airDamping t) */
    airDamping: number;
    /** s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation */
    flexDamping: number;
}
/** What a host gives as Material: what is left out is 0. */
export interface MaterialGiven {
    /** Pa, above 0 */
    youngsModulus?: number;
    /** 0 to below 0.5 */
    poissonsRatio?: number;
    /** m, above 0 */
    thickness?: number;
    /** kg/m^3, above 0 */
    density?: number;
    /** 1/s, 0 or more: velocities fade as exp(-airDamping t) */
    airDamping?: number;
    /** s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation */
    flexDamping?: number;
}

/** How much work for how much accuracy. The presets are measured (`make accuracy`; tests/sweep.h has the scenes) on a
 *  strip of stiff paper, 0.2 m x 0.05 m, clamped at one end, with one row of frames, and on a square of 0.2 m that
 *  bends five times as easily, hangs by two corners, and has half as many rows and columns, rounded up. Let go, they
 *  swing for 0.4 s at 60 ticks a second. Error: rms distance of the vertices from where a much finer run brings them,
 *  by the rms way that they go; at most, over grids from 4/5 to 5/4 as fine and with frames in regular rows or moved a
 *  little. FAST: 2 %. BALANCED: 0.8 %. ACCURATE: 0.4 %. What a cut leaves narrow wants more frames: see `accuracy` in
 *  the sheet def. */
export class Quality {
    /** control frames in a row along a strip; a square does with half as many in either direction, rounded up: 3 x 3, 5
     *  x 5, 9 x 9 */
    framesAlong: number;
    /** for the sheet def */
    gridResolution: number;
    /** for the sheet def */
    iterations: number;
    /** for World.tick */
    substeps: number;
}

/** The paper's own ways, to compare with; part of the sheet def. */
export class PaperOptions {
    /** 1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the same bit for bit.
     *  Default 0. */
    fromScratch: boolean;
    /** 1: when a cut takes effect, only new frames take their motion from the surface: what is seen jumps, and momentum
     *  is not kept. Default 0. */
    popping: boolean;
    /** 1: the weights of frames are linear on the way from frame to frame, so the surface that is seen has a kink at
     *  each frame. Always so with KIRI_MODEL_POINTS. Default 0: their slope is zero at the frames. */
    linearWeights: boolean;
    /** KIRI_MODEL_POINTS only. Work grows with the points: spread evenly over the sheet, at least one in every piece;
     *  default 0: four for each of frameCount. Order 1 (default) takes the strain at a point for all of the material
     *  around it, order 2 a strain linear in it, at four times the work a point. 0 to 1048576 */
    integrationPoints: number;
    /** 1 or 2 */
    integrationOrder: number;
}
/** What a host gives as PaperOptions: what is left out is 0. */
export interface PaperOptionsGiven {
    /** 1: every cut rebuilds grid, regions and shape functions from scratch; the outcome is the same bit for bit.
     *  Default 0. */
    fromScratch?: boolean | number;
    /** 1: when a cut takes effect, only new frames take their motion from the surface: what is seen jumps, and momentum
     *  is not kept. Default 0. */
    popping?: boolean | number;
    /** 1: the weights of frames are linear on the way from frame to frame, so the surface that is seen has a kink at
     *  each frame. Always so with KIRI_MODEL_POINTS. Default 0: their slope is zero at the frames. */
    linearWeights?: boolean | number;
    /** KIRI_MODEL_POINTS only. Work grows with the points: spread evenly over the sheet, at least one in every piece;
     *  default 0: four for each of frameCount. Order 1 (default) takes the strain at a point for all of the material
     *  around it, order 2 a strain linear in it, at four times the work a point. 0 to 1048576 */
    integrationPoints?: number;
    /** 1 or 2 */
    integrationOrder?: number;
}

/** Of a sheet: its rest shape, where it starts, its material, and how it is computed. */
export class SheetDef {
    cookie: number;
    /** The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge. Holes and several parts
     *  are fine. Copied by kiriCreateSheet; vertices of no triangle are left out. Edges whose ends lie at the same
     *  places, but are different vertices, are the lips of a cut that is there already; weldDistance closes them. 2
     *  floats (u, v) a vertex */
    restPositions: Float32Array;
    vertexCount: number;
    /** 3 a triangle */
    indices: Int32Array;
    triangleCount: number;
    /** Where it starts: x = position + u axisU + v axisV. The axes are orthonormal. */
    position: number[];
    axisU: number[];
    axisV: number[];
    /** m/s */
    velocity: number[];
    material: Material;
    /** grid squares along the longer side, 1 to 4096; default 32 */
    gridResolution: number;
    /** m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a cut keeps within half
     *  of it of its line; 0: 1e-4 of the longer side */
    snapDistance: number;
    /** Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture coordinates, and triangles
     *  without shared vertices (STL). In the order of vertices, each becomes the nearest vertex that was kept before
     *  and is nearer than this; else it is kept. So none moves farther, and a chain of near vertices is not one point.
     *  A triangle with two corners at one vertex is left out. Sheet.copySources leads to the vertices of the def.
     *  Default 0: vertices are as the indices say. */
    weldDistance: number;
    /** Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
     *  frames are spread evenly, some of them in pairs at both sides of slit ends. The grid carries one frame for every
     *  two squares of material at most: more are refused (KIRI_ERROR_ARGUMENT), and re-sampling stops there. A new
     *  sheet has no more frames than frameCount, or than pieces where these are more. frameCount 0: as many as the
     *  sheet needs: a region is split while its size, 2.45 times its radius of gyration, exceeds 1.25 frameLength,
     *  after cuts too: so arms that a cut leaves get frames along them. frameLength 0: it follows from `accuracy`, the
     *  relative error of the shape under the sheet's own weight that is good enough, but is three squares of the grid
     *  at least. Sheet.estimateError says what came of it. 0, or 1 and more; default 5 */
    frameCount: number;
    /** m; used where frameCount is 0; default 0 */
    frameLength: number;
    /** 1e-4 to 1; used where frameCount and frameLength are 0; default 0.02 */
    accuracy: number;
    framePoints: Float32Array | null;
    /** re-sampling stops here; default 256 */
    maxFrames: number;
    /** Re-sampling (section 5 of the paper): a frame whose weight exceeds rigidWeight over an area larger than
     *  rigidArea (m^2) gets others beside it. In a new sheet this is done only with frameCount 0. After cuts it is done
     *  where the area is also larger than in the new sheet: when a cut ends, or has met the border or another cut. A
     *  sheet that is to stay rigid sets frameCount and maxFrames to 1. rigidArea 0: a quarter of the area that a frame
     *  has at the start. default 0.95 */
    rigidWeight: number;
    /** default 0 */
    rigidArea: number;
    /** A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it.
     *  Default 0. */
    crumbArea: number;
    /** Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric
     *  mean. Default 0.5 */
    friction: number;
    /** m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's thickness,
     *  a 20th of a grid square at least. Default 0 */
    contactThickness: number;
    /** obstacles and sheets touch where a bit is set in the groups of both. Default: all */
    groups: number;
    /** 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
     *  two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other
     *  by planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
     *  feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays,
     *  and momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its
     *  vertices, about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps
     *  around the border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece
     *  do not touch each other. Pieces that touch wake and fall asleep together. Default 0. */
    touchesSheets: boolean;
    /** spread evenly over the sheet, at least one in every piece; default 0: none */
    collisionPoints: number;
    /** Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual */
    iterations: number;
    /** A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
     *  asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
     *  effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
     *  something that moves and comes near. Gravity, wind, settings and Sheet.wake wake all pieces of the sheet. The
     *  ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps. */
    sleepSpeed: number;
    /** KIRI_MODEL_..., default KIRI_MODEL_LINKS */
    model: Model;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR */
    skinning: Skinning;
    /** 1: the sheet stays in the plane where it starts, without bending; what velocities, forces and held positions
     *  have across the plane is dropped. 3 unknowns a rigid frame, 6 an affine one: two thirds of the solver's work, or
     *  about a third. Default 0. */
    planar: boolean;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping: TimeStepping;
    /** When a cut takes effect, weights change, and what is seen between the frames would jump. The difference fades
     *  within this time (s). So does the difference of strain in links of KIRI_MODEL_LINKS whose borders have moved.
     *  Default 0.2; 0: at once. */
    fadeTime: number;
    /** 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and Sheet.copyVertices copies none; this
     *  saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
     *  other sheets touch it, the tick makes normals for itself. So does Sheet.getSolid; and what Sheet.getPoint says
     *  is the same to rounding. Default 1. */
    normals: boolean;
    /** default: none of the paper's own ways */
    paper: PaperOptions;
}
/** What a host gives as SheetDef: what is left out is as the default has it. */
export interface SheetDefGiven {
    cookie?: number;
    /** The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge. Holes and several parts
     *  are fine. Copied by kiriCreateSheet; vertices of no triangle are left out. Edges whose ends lie at the same
     *  places, but are different vertices, are the lips of a cut that is there already; weldDistance closes them. 2
     *  floats (u, v) a vertex */
    restPositions?: ArrayLike<number> | null;
    /** 3 a triangle */
    indices?: ArrayLike<number> | null;
    /** Where it starts: x = position + u axisU + v axisV. The axes are orthonormal. */
    position?: ArrayLike<number>;
    axisU?: ArrayLike<number>;
    axisV?: ArrayLike<number>;
    /** m/s */
    velocity?: ArrayLike<number>;
    material?: MaterialGiven;
    /** grid squares along the longer side, 1 to 4096; default 32 */
    gridResolution?: number;
    /** m: ends of cuts this near to a lip or the border meet it, those twice as far do not, and a cut keeps within half
     *  of it of its line; 0: 1e-4 of the longer side */
    snapDistance?: number;
    /** Vertices nearer than this (m, rest plane; 0 or more) are one: for seams of texture coordinates, and triangles
     *  without shared vertices (STL). In the order of vertices, each becomes the nearest vertex that was kept before
     *  and is nearer than this; else it is kept. So none moves farther, and a chain of near vertices is not one point.
     *  A triangle with two corners at one vertex is left out. Sheet.copySources leads to the vertices of the def.
     *  Default 0: vertices are as the indices say. */
    weldDistance?: number;
    /** Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
     *  frames are spread evenly, some of them in pairs at both sides of slit ends. The grid carries one frame for every
     *  two squares of material at most: more are refused (KIRI_ERROR_ARGUMENT), and re-sampling stops there. A new
     *  sheet has no more frames than frameCount, or than pieces where these are more. frameCount 0: as many as the
     *  sheet needs: a region is split while its size, 2.45 times its radius of gyration, exceeds 1.25 frameLength,
     *  after cuts too: so arms that a cut leaves get frames along them. frameLength 0: it follows from `accuracy`, the
     *  relative error of the shape under the sheet's own weight that is good enough, but is three squares of the grid
     *  at least. Sheet.estimateError says what came of it. 0, or 1 and more; default 5 */
    frameCount?: number;
    /** m; used where frameCount is 0; default 0 */
    frameLength?: number;
    /** 1e-4 to 1; used where frameCount and frameLength are 0; default 0.02 */
    accuracy?: number;
    framePoints?: ArrayLike<number> | null;
    /** re-sampling stops here; default 256 */
    maxFrames?: number;
    /** Re-sampling (section 5 of the paper): a frame whose weight exceeds rigidWeight over an area larger than
     *  rigidArea (m^2) gets others beside it. In a new sheet this is done only with frameCount 0. After cuts it is done
     *  where the area is also larger than in the new sheet: when a cut ends, or has met the border or another cut. A
     *  sheet that is to stay rigid sets frameCount and maxFrames to 1. rigidArea 0: a quarter of the area that a frame
     *  has at the start. default 0.95 */
    rigidWeight?: number;
    /** default 0 */
    rigidArea?: number;
    /** A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it.
     *  Default 0. */
    crumbArea?: number;
    /** Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric
     *  mean. Default 0.5 */
    friction?: number;
    /** m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's thickness,
     *  a 20th of a grid square at least. Default 0 */
    contactThickness?: number;
    /** obstacles and sheets touch where a bit is set in the groups of both. Default: all */
    groups?: number;
    /** 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
     *  two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other
     *  by planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
     *  feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays,
     *  and momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its
     *  vertices, about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps
     *  around the border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece
     *  do not touch each other. Pieces that touch wake and fall asleep together. Default 0. */
    touchesSheets?: boolean | number;
    /** spread evenly over the sheet, at least one in every piece; default 0: none */
    collisionPoints?: number;
    /** Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual */
    iterations?: number;
    /** A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
     *  asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
     *  effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
     *  something that moves and comes near. Gravity, wind, settings and Sheet.wake wake all pieces of the sheet. The
     *  ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps. */
    sleepSpeed?: number;
    /** KIRI_MODEL_..., default KIRI_MODEL_LINKS */
    model?: Model;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR */
    skinning?: Skinning;
    /** 1: the sheet stays in the plane where it starts, without bending; what velocities, forces and held positions
     *  have across the plane is dropped. 3 unknowns a rigid frame, 6 an affine one: two thirds of the solver's work, or
     *  about a third. Default 0. */
    planar?: boolean | number;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping?: TimeStepping;
    /** When a cut takes effect, weights change, and what is seen between the frames would jump. The difference fades
     *  within this time (s). So does the difference of strain in links of KIRI_MODEL_LINKS whose borders have moved.
     *  Default 0.2; 0: at once. */
    fadeTime?: number;
    /** 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and Sheet.copyVertices copies none; this
     *  saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
     *  other sheets touch it, the tick makes normals for itself. So does Sheet.getSolid; and what Sheet.getPoint says
     *  is the same to rounding. Default 1. */
    normals?: boolean | number;
    /** default: none of the paper's own ways */
    paper?: PaperOptionsGiven;
}

export function defaultSheetDef(into?: SheetDef): SheetDef;

/** What of the def may be changed while the sheet lives, as there. Sheet.getSettings stamps it. */
export class SheetSettings {
    cookie: number;
    material: Material;
    /** re-sampling stops here; default 256 */
    maxFrames: number;
    /** A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it.
     *  Default 0. */
    crumbArea: number;
    /** Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric
     *  mean. Default 0.5 */
    friction: number;
    /** m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's thickness,
     *  a 20th of a grid square at least. Default 0 */
    contactThickness: number;
    /** obstacles and sheets touch where a bit is set in the groups of both. Default: all */
    groups: number;
    /** 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
     *  two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other
     *  by planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
     *  feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays,
     *  and momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its
     *  vertices, about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps
     *  around the border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece
     *  do not touch each other. Pieces that touch wake and fall asleep together. Default 0. */
    touchesSheets: boolean;
    /** Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual */
    iterations: number;
    /** A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
     *  asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
     *  effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
     *  something that moves and comes near. Gravity, wind, settings and Sheet.wake wake all pieces of the sheet. The
     *  ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps. */
    sleepSpeed: number;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR */
    skinning: Skinning;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping: TimeStepping;
    /** stays 0 with paper.popping */
    fadeTime: number;
    /** 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and Sheet.copyVertices copies none; this
     *  saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
     *  other sheets touch it, the tick makes normals for itself. So does Sheet.getSolid; and what Sheet.getPoint says
     *  is the same to rounding. Default 1. */
    normals: boolean;
}
/** What a host gives as SheetSettings: what is left out is 0. */
export interface SheetSettingsGiven {
    cookie?: number;
    material?: MaterialGiven;
    /** re-sampling stops here; default 256 */
    maxFrames?: number;
    /** A piece with less area (m^2) is a crumb: it gets one frame if it has none, and no frames are added to it.
     *  Default 0. */
    crumbArea?: number;
    /** Contact, see below. of the sheet, 0 or more; with that of an obstacle or of another sheet counts the geometric
     *  mean. Default 0.5 */
    friction?: number;
    /** m, 0 or more: sheets and pieces stay so far apart, and half as far from obstacles. 0: the material's thickness,
     *  a 20th of a grid square at least. Default 0 */
    contactThickness?: number;
    /** obstacles and sheets touch where a bit is set in the groups of both. Default: all */
    groups?: number;
    /** 1: its pieces touch each other, and other sheets that have it set; not where one of the two sheets is planar. Of
     *  two pieces that are near each other the one that lies above, against gravity, is kept on its side of the other
     *  by planes; side by side the one that nothing holds, or the lighter one. So piles keep their order. The lower one
     *  feels what presses on it within 0.3 s: weight acts in full, an impact does so only while the upper one stays,
     *  and momentum is not exchanged exactly. Pieces that cross are parted at 0.25 m/s. A sheet feels others by its
     *  vertices, about one a grid square and more along borders: two edges that cross are not seen. A piece that wraps
     *  around the border of another, so that it lies on both sides of it, has one side all the same. Folds of one piece
     *  do not touch each other. Pieces that touch wake and fall asleep together. Default 0. */
    touchesSheets?: boolean | number;
    /** Newton steps a substep, 1 to 64; default 2. Sheets of 1000 frames want 8, see the manual */
    iterations?: number;
    /** A piece all of whose frames move slower than this (m/s, rms over the material of each) for half a second falls
     *  asleep: it rests, and costs next to nothing. What is new to it wakes it: a cut that changes it, when that takes
     *  effect; a pin that holds it, or the pin's pose; a hold, a load, contacts other than those it fell asleep with;
     *  something that moves and comes near. Gravity, wind, settings and Sheet.wake wake all pieces of the sheet. The
     *  ticks of a sheet all of whose pieces sleep cost nothing. Default 0.001; 0: none sleeps. */
    sleepSpeed?: number;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_LINEAR */
    skinning?: Skinning;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping?: TimeStepping;
    /** stays 0 with paper.popping */
    fadeTime?: number;
    /** 1: normals of the mesh are made in every tick. 0: kiriMesh has none, and Sheet.copyVertices copies none; this
     *  saves half of the time of linear skinning. The sheet moves the same, bit for bit: where edges of obstacles or
     *  other sheets touch it, the tick makes normals for itself. So does Sheet.getSolid; and what Sheet.getPoint says
     *  is the same to rounding. Default 1. */
    normals?: boolean | number;
}

/** The triangles that are seen, as after the last tick. revision grows whenever indices or vertices are added or
 *  changed. Rest positions are floats, 6e-8 of the distance from the origin of the rest plane apart: where triangles
 *  are not much larger than that, they look flat or inverted. The library computes with the positions of the def to
 *  2^-29 of the sheet; sourceTriangles and sourceWeights are as exact as the sheet is large. Arrays are those of the
 *  library: after the next tick they throw. */
export class Mesh {
    /** 3 a vertex, m, world */
    readonly positions: Float32Array;
    /** 3 a vertex, unit; null where the sheet makes none */
    readonly normals: Float32Array | null;
    /** 2 a vertex, m */
    readonly restPositions: Float32Array;
    /** 3 a triangle */
    readonly indices: Int32Array;
    /** 1 a vertex: the triangle of the def that it lies in, */
    readonly sourceTriangles: Int32Array;
    /** 3 a vertex: and its barycentric coordinates there */
    readonly sourceWeights: Float32Array;
    vertexCount: number;
    triangleCount: number;
    revision: number;
}

/** So many items from the first on. */
export class Range {
    first: number;
    count: number;
}

/** What has changed in the mesh, for hosts that keep a copy of it, on a GPU say. Positions and normals change with
 *  every tick; all else of a vertex, and the corners of a triangle, only in these ranges. */
export class Dirty {
    /** up to the last one of the mesh */
    newVertices: Range;
    /** up to the last one of the mesh */
    newTriangles: Range;
    /** the least ranges that hold all older ones with other data */
    oldVertices: Range;
    /** the least ranges that hold all older ones with other data */
    oldTriangles: Range;
    /** for the next call */
    revision: number;
}

/** The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and the lips of cuts. First
 *  come the vertices of kiriMesh on the side that the normal leaves, then the same on the other side, then four for
 *  each edge of the border, so that rims are flat and their edges sharp. Arrays are those of the library: after the
 *  next tick they throw. */
export class Solid {
    /** 3 a vertex, m, world */
    readonly positions: Float32Array;
    /** 3 a vertex, unit, outwards */
    readonly normals: Float32Array;
    /** 2 a vertex, m */
    readonly restPositions: Float32Array;
    /** 3 a triangle, counter-clockwise from outside */
    readonly indices: Int32Array;
    /** 1 a vertex: that of kiriMesh which it stands on */
    readonly sources: Int32Array;
    vertexCount: number;
    triangleCount: number;
    /** from this one on triangles are rims */
    rimTriangle: number;
}

/** How many there are of each. */
export class Counts {
    vertices: number;
    triangles: number;
    cells: number;
    frames: number;
    links: number;
    pieces: number;
    collisionPoints: number;
}

/** Area (m^2), mass (kg), kinetic energy and elastic energy (J), linear and angular momentum about the world's origin
 *  (kg m/s, kg m^2/s), centre of mass (m). */
export class Totals {
    area: number;
    mass: number;
    kineticEnergy: number;
    elasticEnergy: number;
    center: number[];
    momentum: number[];
    angularMomentum: number[];
}

/** What a ray meets. */
export class Hit {
    /** where to cut */
    restPoint: number[];
    position: number[];
    normal: number[];
    /** m along the direction, which need not be a unit vector */
    distance: number;
    triangle: number;
}

/** A point of the material, as it is seen. */
export class PointState {
    /** m, world; unit */
    position: number[];
    /** m, world; unit */
    normal: number[];
    /** m/s, by the weights of the point */
    velocity: number[];
    /** in whose region it is; it names the piece, too */
    frame: Frame | null;
}

/** The connected parts of a sheet. A piece is named by any of its frames. To go through all of them there are indices
 *  too, from 0 on to kiriCounts.pieces, in the order of first frames: they change when a piece comes off or is taken
 *  away; Frame.getPiece has that of now. A cut whose work waits for its budget has not parted anything yet. Momentum is
 *  about the world's origin. */
export class PieceState {
    /** m^2, kg */
    area: number;
    /** m^2, kg */
    mass: number;
    /** of mass, m; kg m/s; kg m^2/s */
    center: number[];
    /** of mass, m; kg m/s; kg m^2/s */
    momentum: number[];
    /** of mass, m; kg m/s; kg m^2/s */
    angularMomentum: number[];
    /** m, world: the least box around its vertices */
    lower: number[];
    /** m, world: the least box around its vertices */
    upper: number[];
    /** how many */
    frames: number;
    /** how many */
    vertices: number;
    /** how many */
    triangles: number;
    /** how many */
    collisionPoints: number;
    /** 1: see kiriSheetDef */
    crumb: boolean;
    /** 1: see sleepSpeed */
    asleep: boolean;
}

/** What is in a piece, in the order of the mesh. The arrays are parts of one for all pieces, piece after piece. Arrays
 *  are those of the library: after the next tick they throw. */
export class PieceMesh {
    /** of kiriMesh */
    readonly vertices: Int32Array;
    /** of kiriMesh */
    readonly triangles: Int32Array;
    /** 3 a triangle, as in kiriMesh: draw them */
    readonly indices: Int32Array;
    /** see Sheet.getCollisionPoints */
    readonly collisionPoints: Int32Array;
    vertexCount: number;
    triangleCount: number;
    collisionPointCount: number;
}

/** Pose, motion and region of a frame. */
export class FrameState {
    restPoint: number[];
    /** of the rest point */
    position: number[];
    /** columns: direction of u, direction of v, normal; of an affine frame the columns of A, which stretch with the
     *  sheet */
    rotation: number[];
    /** m/s */
    velocity: number[];
    /** rad/s */
    angularVelocity: number[];
    /** m^2 of its region */
    area: number;
    /** kg */
    mass: number;
    /** 1: moved by the host, see Frame.hold */
    held: boolean;
}

/** What a host gives as Wind: what is left out is 0. */
export interface WindGiven {
    /** m/s */
    velocity?: ArrayLike<number>;
    /** kg/m^3, 0 or more; 1.2 of air */
    density?: number;
    /** 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along the sheet, 0.01
     *  or so of a smooth one */
    drag?: number;
    /** 0 or more: coefficients of pressure, 2 of a long plate, 1.2 of a square, and of the force along the sheet, 0.01
     *  or so of a smooth one */
    lift?: number;
}

/** A pin holds a point of the material at its target, by a spring. */
export class PinDef {
    cookie: number;
    /** in the material */
    restPoint: number[];
    /** m, world: where it is held */
    target: number[];
    /** N/m; 0: ten times Young's modulus times thickness */
    stiffness: number;
    /** N: it breaks (KIRI_EVENT_PIN_BROKE) in a tick in which it held with more; 0: never */
    breakForce: number;
    /** or 0. The target goes with this obstacle from where it is when the pin is made, or Pin.setTarget puts it, and
     *  the obstacle feels the pin (Obstacle.getState); one with mass yields to it within the tick. When it is destroyed
     *  the target stays where it was */
    obstacle: Obstacle | null;
}
/** What a host gives as PinDef: what is left out is as the default has it. */
export interface PinDefGiven {
    cookie?: number;
    /** in the material */
    restPoint?: ArrayLike<number>;
    /** m, world: where it is held */
    target?: ArrayLike<number>;
    /** N/m; 0: ten times Young's modulus times thickness */
    stiffness?: number;
    /** N: it breaks (KIRI_EVENT_PIN_BROKE) in a tick in which it held with more; 0: never */
    breakForce?: number;
    /** or 0. The target goes with this obstacle from where it is when the pin is made, or Pin.setTarget puts it, and
     *  the obstacle feels the pin (Obstacle.getState); one with mass yields to it within the tick. When it is destroyed
     *  the target stays where it was */
    obstacle?: Obstacle | null;
}

export function defaultPinDef(into?: PinDef): PinDef;

/** What a pin is, and where it holds. */
export class PinState {
    /** KIRI_PIN_... */
    type: PinType;
    sheet: Sheet | null;
    /** rest position: of a point, twice, or of the ends of the line */
    from: number[];
    /** rest position: of a point, twice, or of the ends of the line */
    to: number[];
    target: number[];
    /** of a line; of a point the identity */
    rotation: number[];
    /** N, or 0 */
    breakForce: number;
    /** that it goes with, or 0 */
    obstacle: Obstacle | null;
}

/** What a host gives as Contact: what is left out is 0. */
export interface ContactGiven {
    /** index of the collision point; -1: restPoint says which point of the material */
    point?: number;
    /** in the material; only read where point is -1 */
    restPoint?: ArrayLike<number>;
    /** unit, out of the obstacle */
    normal?: ArrayLike<number>;
    /** m: of the obstacle's surface at the start of the tick */
    offset?: number;
    /** m/s: of the obstacle there. The plane moves with it within the tick, and friction acts against the sliding that
     *  is left */
    velocity?: ArrayLike<number>;
    /** 0 or more: of both sides together */
    friction?: number;
    /** 1/kg, 0 or more: of the obstacle as felt along the normal there, 1/m + (r x n) . I^-1 (r x n); 0: it does not
     *  yield */
    inverseMass?: number;
    /** m/s, 0 or more: a point that starts below the plane is pushed out no faster. 0: 1 m/s */
    pushSpeed?: number;
    /** the host's number. Contacts of one number press on one obstacle, and share its mass */
    obstacle?: number;
}

/** What a contact did in the last tick. */
export class ContactForce {
    /** N s, on the sheet: the sum over the tick. The obstacle gets the opposite */
    impulse: number[];
    /** m, world: where it acted, the point of the sheet at the end of the tick */
    position: number[];
    /** m: how deep the point is below the plane at the end of the tick; below 0: above it */
    depth: number;
    /** as in the contact */
    point: number;
    /** as in the contact */
    obstacle: number;
}

/** Of an obstacle: its shape, where it is, its motion, and its mass. */
export class ObstacleDef {
    cookie: number;
    /** KIRI_OBSTACLE_... */
    type: ObstacleType;
    /** m */
    size: number[];
    /** m */
    radius: number;
    /** m */
    height: number;
    /** 2 floats a corner, m, counter-clockwise; copied */
    outline: Float32Array | null;
    /** 3 to 64 */
    outlineCount: number;
    /** m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0 */
    rounding: number;
    /** m, world */
    position: number[];
    /** columns; default: the axes of the world */
    rotation: number[];
    /** m/s, of its position */
    velocity: number[];
    /** rad/s */
    angularVelocity: number[];
    /** m/s, world: of its surface beside that, as of a conveyor */
    surfaceVelocity: number[];
    /** 0 or more; default 0.5 */
    friction: number;
    /** kg; 0 (default): nothing moves it */
    mass: number;
    /** kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz. Positive definite, but
     *  for axes whose numbers are all 0: it does not turn about these */
    inertia: number[];
    /** m, from its position in its own axes */
    centerOfMass: number[];
    /** obstacles of the same number, but 0, are parts of one body, whose mass each of them has */
    body: number;
    /** m/s, above 0: what is inside is pushed out no faster. Default 1 */
    pushSpeed: number;
    /** see the sheet def. Default: all */
    groups: number;
}
/** What a host gives as ObstacleDef: what is left out is as the default has it. */
export interface ObstacleDefGiven {
    cookie?: number;
    /** KIRI_OBSTACLE_... */
    type?: ObstacleType;
    /** m */
    size?: ArrayLike<number>;
    /** m */
    radius?: number;
    /** m */
    height?: number;
    /** 2 floats a corner, m, counter-clockwise; copied */
    outline?: ArrayLike<number> | null;
    /** m, 0 or more: prisms and boxes are that much larger, with round edges. Default 0 */
    rounding?: number;
    /** m, world */
    position?: ArrayLike<number>;
    /** columns; default: the axes of the world */
    rotation?: ArrayLike<number>;
    /** m/s, of its position */
    velocity?: ArrayLike<number>;
    /** rad/s */
    angularVelocity?: ArrayLike<number>;
    /** m/s, world: of its surface beside that, as of a conveyor */
    surfaceVelocity?: ArrayLike<number>;
    /** 0 or more; default 0.5 */
    friction?: number;
    /** kg; 0 (default): nothing moves it */
    mass?: number;
    /** kg m^2, about its centre of mass, axes of the world as it stands now: xx yy zz xy xz yz. Positive definite, but
     *  for axes whose numbers are all 0: it does not turn about these */
    inertia?: ArrayLike<number>;
    /** m, from its position in its own axes */
    centerOfMass?: ArrayLike<number>;
    /** obstacles of the same number, but 0, are parts of one body, whose mass each of them has */
    body?: number;
    /** m/s, above 0: what is inside is pushed out no faster. Default 1 */
    pushSpeed?: number;
    /** see the sheet def. Default: all */
    groups?: number;
}

export function defaultObstacleDef(into?: ObstacleDef): ObstacleDef;

/** Where it is now, with what it moves, and what it felt. */
export class ObstacleState {
    position: number[];
    rotation: number[];
    velocity: number[];
    angularVelocity: number[];
    /** N s, N m s about its centre of mass: what sheets and pins gave it in the last tick */
    impulse: number[];
    /** N s, N m s about its centre of mass: what sheets and pins gave it in the last tick */
    angularImpulse: number[];
    /** that pushed in the last tick */
    contacts: number;
}


/** What is drawn, and by whom. */
export class DebugDraw {
    cookie: number;
    /** KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES */
    flags: DrawFlag;
    /** only this one is drawn, without obstacles and blades; 0 (default): all */
    sheet: Sheet | null;
    /** m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05 */
    size: number;
}
/** What a host gives as DebugDraw: what is left out is as the default has it. */
export interface DebugDrawGiven {
    cookie?: number;
    /** KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES */
    flags?: DrawFlag;
    /** only this one is drawn, without obstacles and blades; 0 (default): all */
    sheet?: Sheet | null;
    /** m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05 */
    size?: number;
    /** Gets points, one vertex each. vertices: x, y, z and a color a row; colors: the same memory. */
    points?: (vertices: Float32Array, colors: Uint32Array, count: number) => void;
    /** Gets lines, two. vertices: x, y, z and a color a row; colors: the same memory. */
    lines?: (vertices: Float32Array, colors: Uint32Array, count: number) => void;
    /** Gets triangles, three. vertices: x, y, z and a color a row; colors: the same memory. */
    triangles?: (vertices: Float32Array, colors: Uint32Array, count: number) => void;
}

export function defaultDebugDraw(into?: DebugDraw): DebugDraw;

/** The library's version, as KIRI_VERSION. */
export function getVersion(): number;

/** The name of a result, "KIRI_OK" and so on; "unknown" for another number. */
export function getResultName(result: ResultCode): string;

/** One line: the meaning of a result, and its cure. For calls without a world that keeps a line, such as
 *  kiriCreateWorld with a def of zeros (KIRI_ERROR_DEF). */
export function getResultText(result: ResultCode): string;

/** For hosts that would rather think in time than in items: the budget whose work would have taken so many microseconds
 *  a tick at the pace of the profile, which may be the sum of several. Work on cuts and linear systems share the time
 *  as they did in the profile, and each of triangles, cells and samples gets what the three took together, see
 *  kiriBudget. Each item that the profile has some of is set; others stay. The simulation never reads a clock: the
 *  choice is the host's, and a replay must hand in the same budgets. */
export function fitBudget(profile: ProfileGiven, microseconds: number, budget: Budget): ResultCode;

/** The name of a stage, for tables; "" for a number that is none. */
export function getStageName(stage: Stage): string;

/** The numbers of a preset, KIRI_MATERIAL_... */
export function getMaterial(preset: MaterialPreset, into?: Material): Material;

/** The numbers of a preset, KIRI_QUALITY_... */
export function getQuality(preset: QualityPreset, into?: Quality): Quality;

/** A rectangle from (0, 0) to (width, height) for a sheet def: writes 2 * (columns + 1) * (rows + 1) floats and 6 *
 *  columns * rows indices. columns and rows are 1 to 4096. */
export function fillRectangle(width: number, height: number, columns: number, rows: number): { restPositions: Float32Array, indices: Int32Array };

/** A world, empty at first. Destroy it when it is done with: its memory is not JavaScript's. */
export class World {
    /** def: what differs from defaultWorldDef(). */
    constructor(def?: WorldDefGiven);
    readonly isAlive: boolean;
    /** Frees the world and all that is in it; once is enough. */
    destroy(): void;
    /** One fixed step of dt seconds (1e-6 to 10), solved in `substeps` equal parts (1 to 64). Takes the waiting cut
     *  points, then moves every sheet. KIRI_PENDING: the budget is spent and more work waits: the events say which
     *  cuts; a sheet, or some of its pieces, may also have stood still for want of iterations. KIRI_ERROR_MEMORY:
     *  nothing moved; cuts and pieces still wait, call again. Refused work is prepared again: until then
     *  Sheet.getWeights gives KIRI_ERROR_STATE, and with a budget a cut may take effect some ticks later than it would
     *  have. KIRI_ERROR_LIMIT: the same, and it stays so until frames are destroyed. KIRI_DIVERGED: the sheets named by
     *  the events were put to rest, the others moved. Work may wait then, too, as KIRI_EVENT_DEFERRED says. */
    tick(dt: number, substeps: number): ResultCode;
    /** What went wrong in the last function that changes the world, in one line; "" when nothing did. A function that
     *  only reads leaves it as it is, and gives its line to the log. Valid until the next function that changes the
     *  world. */
    getLastError(): string;
    /** m/s^2. All pieces wake. */
    setGravity(gravity: ArrayLike<number>): ResultCode;
    /** Moves the origin of the world to a point (m): subtracts it from the positions of sheets, targets of pins and
     *  holds, obstacles, blades, and contacts that wait. The motion goes on as before, to rounding. Nothing wakes; (0,
     *  0, 0) changes nothing. Use it in large worlds: far from the origin floats lose places. The host shifts its own
     *  data itself. Arrays that the library handed out keep the old positions until the next tick. KIRI_ERROR_ARGUMENT:
     *  a position would not fit a float. KIRI_ERROR_MEMORY: nothing has changed. */
    shiftOrigin(origin: ArrayLike<number>): ResultCode;
    /** Takes effect with the next tick. */
    setBudget(budget: BudgetGiven): ResultCode;
    /** A hash of everything that the coming ticks depend on, work that waits for its budget included: two worlds that
     *  got the same calls have the same hash, and two with the same hash go on alike. After a refused allocation some
     *  items are made again: the hash tells that while work waits, or while the budget limits cells or samples. */
    getStateHash(): bigint;
    /** Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are. */
    getSheets(): Sheet[];
    /** Puts some bytes of the host's own (1 to KIRI_MOST_NOTE_BYTES) in the recording, where a replay finds them: what
     *  its camera saw, what a player pressed. The world does not change; without a recording nothing happens. */
    note(bytes: Uint8Array): ResultCode;
    /** Makes the calls of a recording up to the next tick or note, and that one. The world is to be new, as
     *  kiriCreateWorld makes it; gravity and budget become those of the recording. What the host has of its own, such
     *  as memory, log and tasks, stays the host's. Ids are those of the recording: World.getSheets has those of sheets.
     *  KIRI_PENDING: more follows, call it again. KIRI_OK: that was the end. KIRI_ERROR_REPLAY: a call gave another
     *  result, other ids or another state than recorded; the line says which. The next call goes on behind it.
     *  KIRI_ERROR_DATA: the bytes are no recording, damaged, cut short, or of a later version; the line says where.
     *  Calls before that place have been made. So has the last one of a recording that ends within a call, as that of a
     *  run which crashed. KIRI_ERROR_STATE: the world is not new. KIRI_ERROR_MEMORY: the next call was refused memory,
     *  and may be tried again. Calls that were refused memory when they were recorded are left out: they changed
     *  nothing. Where that was a tick and a budget limits cells or samples, the next hashes may differ. */
    replay(recording: Uint8Array, replay: Replay): ResultCode;
    /** Writes the world, which only is read. *size: bytes of the save. `bytes` null: they are counted only, and
     *  capacity is not read; else it has room for `capacity`. KIRI_ERROR_ARGUMENT: that is less than *size; nothing is
     *  written. KIRI_PENDING: a cut is being worked on; *size is 0, and nothing is written. Save after a later tick, or
     *  after World.finishCuts. */
    save(): Uint8Array;
    /** Finishes the work on cuts at once, whatever the budget is, and without moving anything. Cuts that wait for a
     *  budget take effect. The next tick reports the events. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in World.tick.
     *  Arrays that the world handed out end as with a tick. */
    finishCuts(): ResultCode;
    /** Replaces the world by a saved one. It may have any hooks; its own allocation, log, clock and tasks stay. The
     *  bytes may come from anybody: a malicious save may give a strange world but cannot crash the program, and takes
     *  memory in proportion to its size. Takes about as long as to create the sheets. The profile has no times until
     *  the next tick. Arrays that the old world handed out live until then. KIRI_ERROR_DATA: the bytes are not a save,
     *  damaged, or of another version. KIRI_ERROR_MEMORY. Then nothing has changed. A recording has the bytes, up to
     *  2^31 of them. */
    load(bytes: Uint8Array): ResultCode;
    /** For rollback: copies all of the world, also work on cuts and pieces that wait, into memory of the host. Much
     *  faster than a save, and exact to the bit. The bytes are good for this process only: never store or send them.
     *  Arguments as of World.save. */
    snapshot(): Uint8Array;
    /** Replaces the world by the world of the snapshot; ids name the same things. The bytes are trusted: hand over only
     *  the output of World.snapshot. KIRI_ERROR_DATA: not a snapshot of this build of the library. KIRI_ERROR_MEMORY.
     *  KIRI_ERROR_STATE: the world is recorded. Then nothing has changed. Hooks and arrays as with World.load. */
    restore(bytes: Uint8Array): ResultCode;
    /** *events points to *count events. */
    getEvents(): Rows<Event>;
    /** Of the last tick that was not refused. */
    getProfile(into?: Profile): Profile;
    /** Adds a sheet. On failure *sheet is 0. KIRI_ERROR_MESH: the triangles do not form a sheet. The line names a
     *  triangle, or the two triangles at an edge, by their numbers in the def, and says why. */
    createSheet(def: SheetDefGiven): Sheet;
    /** A sheet that is a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles;
     *  columns and rows are 1 to 4096. def: all but the mesh, which is not read; null: the defaults. A recording has it
     *  as kiriCreateSheet. */
    createRectangle(width: number, height: number, columns: number, rows: number, def?: SheetDefGiven | null): Sheet;
    /** The first sheet that a ray meets; *sheet is 0 where there is none. */
    raycast(origin: ArrayLike<number>, direction: ArrayLike<number>, maxDistance: number, into?: Hit): { sheet: Sheet | null, hit: Hit };
    /** The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece count
     *  once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together. detached[i] is the
     *  sheet that the piece of frames[i] has become, 0 where it waits. */
    detachPieces(frames: Frame[]): (Sheet | null)[];
    /** The same for the pieces of so many frames, of any sheets, in one pass for each sheet; frames of one piece count
     *  once. Where one is refused, none goes. KIRI_PENDING: some wait, those of one sheet together. detached[i] is the
     *  sheet that the piece of frames[i] has become, 0 where it waits. */
    destroyPieces(frames: Frame[]): ResultCode;
    /** sheet 0: it cuts all sheets, also those that are made later and pieces that get a sheet of their own. A blade
     *  for one sheet whose sheet is gone cuts nothing. */
    beginBlade(sheet?: Sheet | null): Blade;
    /** Adds an obstacle. On failure *obstacle is 0. */
    createObstacle(def: ObstacleDefGiven): Obstacle;
    /** Draws the world as after the last tick, by the host's functions. Only reads the world, and takes no memory. */
    debugDraw(draw: DebugDrawGiven): ResultCode;
}

export class Sheet {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** The sheet is gone, with its cuts, frames and pins; their ids are stale. */
    destroy(): ResultCode;
    /** What they are now, stamped for Sheet.setSettings. */
    getSettings(into?: SheetSettings): SheetSettings;
    /** Checked as the def is: all or nothing. KIRI_ERROR_DEF: they did not come from GetSettings. The sheet wakes where
     *  one is other than before. Places and velocities stay: with another mass so momentum changes. Stiffnesses that
     *  pins have, and the lengths that frames were spread by, stay as they are. */
    setSettings(settings: SheetSettingsGiven): ResultCode;
    /** The arrays, without a copy. */
    getMesh(into?: Mesh): Mesh;
    /** What changed since the host saw that revision; all of the mesh where that is too long ago, or 0. */
    getDirty(sinceRevision: number, into?: Dirty): Dirty;
    /** Copies positions and normals of some vertices, 3 floats each, to where the host wants them; strides in bytes, 12
     *  or more. Null: without these. KIRI_ERROR_STATE: normals of a sheet that makes none. */
    copyVertices(first: number, count: number, positions?: Float32Array | null, positionStride?: number, normals?: Float32Array | null, normalStride?: number): ResultCode;
    /** Copies the index that some vertices had when the last call of World.tick began, for hosts that draw between two
     *  ticks. *from: the sheet that had them then, which is another one if this sheet was a piece of it. A vertex that
     *  a cut tore off another one gets the index of the other. -1: the vertex did not exist; so all vertices of a sheet
     *  that was created or loaded since. The manual has the code (drawing). */
    copyPrevious(first: number, count: number): { vertices: Int32Array, from: Sheet };
    /** Copies the indices of some triangles, 3 each, as 16-bit numbers. KIRI_ERROR_STATE: there are more than 65535
     *  vertices. */
    copyIndices16(firstTriangle: number, count: number): Uint16Array;
    /** Map triangles to the def, to draw with data that the host keeps by its own vertices. Sources: the triangle of
     *  the def that contains each; -1 for one that has left (its corners are equal). Weights: 9 floats each, the
     *  barycentric coordinates of its three corners in that triangle. They are right on both sides of a seam that
     *  weldDistance has closed; sourceTriangles name a triangle on one side. The manual has the code (meshes). */
    copySources(firstTriangle: number, count: number): Int32Array;
    /** Map triangles to the def, to draw with data that the host keeps by its own vertices. Sources: the triangle of
     *  the def that contains each; -1 for one that has left (its corners are equal). Weights: 9 floats each, the
     *  barycentric coordinates of its three corners in that triangle. They are right on both sides of a seam that
     *  weldDistance has closed; sourceTriangles name a triangle on one side. The manual has the code (meshes). */
    copySourceWeights(firstTriangle: number, count: number): Float32Array;
    /** thickness: m, 0: that of the material. Made when it is asked for. */
    getSolid(thickness: number, into?: Solid): Solid;
    /** Collision points: 3 floats of position (m, world) a point. */
    getCollisionPoints(): View<Float32Array>;
    /** Costs nothing. */
    getCounts(into?: Counts): Counts;
    /** Sums over the frames, made when they are asked for. */
    getTotals(into?: Totals): Totals;
    /** An estimate of the error of the sheet's shape as it is now, where it rests or moves slowly: rms distance from
     *  where a sheet of very many frames would be under the same loads, over the rms way that it has gone from its flat
     *  shape; 0 to 1, and 1 where there are too few frames to tell. It compares the strains of neighbouring links
     *  (KIRI_MODEL_LINKS only; else KIRI_ERROR_STATE). Measured on cantilevers and on a sheet with a slit, of 3 to 140
     *  frames, it is not below a third of the error, and not above four times the error or, where that is below 0.5 %,
     *  1.5 %. Where a sheet also turned as a whole, as by hanging from two corners, it says up to ten times too much.
     *  It knows nothing of errors of the grid, of time stepping, and of loads that are finer than frames. It takes
     *  memory and time for one pass over the links, when it is called. */
    estimateError(): number;
    /** *awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do. Sheet.wake wakes
     *  all of them. */
    isAwake(): boolean;
    /** *awake is 0 where all pieces of the sheet sleep, see sleepSpeed; kiriPieceState says which do. Sheet.wake wakes
     *  all of them. */
    wake(): ResultCode;
    /** Every point x (m, world) of the sheet goes to R x + t at once, and is seen there; velocities turn. The columns
     *  of `rotation` are where R takes the axes of the world; a planar sheet turns about its normal only. It wakes.
     *  Targets of its pins, hinges, clamps and holds go along, so nothing draws it back. To set a target to its current
     *  value changes nothing. A target that the host has set nearer to the new place of the pin than to the old one
     *  stays: so the host may set targets before or after. Pins on an obstacle stay on it: put the obstacle elsewhere
     *  by the same motion (Obstacle.setPose), before or after. Loads and contacts that wait for the next tick stay. */
    transform(rotation: ArrayLike<number>, translation: ArrayLike<number>): ResultCode;
    /** From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
     *  `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow
     *  their hold. Frame.setPieceVelocity: of the piece with that frame alone. */
    setVelocity(velocity: ArrayLike<number>, angularVelocity: ArrayLike<number>): ResultCode;
    /** A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
     *  Frame.detachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
     *  parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
    setUserData(data: number | bigint): ResultCode;
    /** A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
     *  Frame.detachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
     *  parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
    getUserData(): bigint;
    /** Where a ray first meets the sheet, up to maxDistance. KIRI_OK with hit->triangle = -1: nowhere. The first ray
     *  looks at every triangle; the next tick makes boxes over them, and as long as somebody asks every now and then
     *  (in 120 ticks) they follow the sheet: a ray takes some microseconds, and a tick of a large sheet a quarter more. */
    raycast(origin: ArrayLike<number>, direction: ArrayLike<number>, maxDistance: number, into?: Hit): Hit;
    /** Outside the sheet: KIRI_ERROR_ARGUMENT. On a cut, the lip that holds the point; either where both do. */
    getPoint(restPoint: ArrayLike<number>, into?: PointState): PointState;
    /** The shape functions at a rest point: up to `capacity` frames with their weights (sum 1) and, unless null,
     *  gradients (2 floats a frame, 1/m). *count is how many there are, however many fit. Outside the sheet:
     *  KIRI_ERROR_ARGUMENT; while work on a cut waits for its budget: KIRI_ERROR_STATE. */
    getWeights(restPoint: ArrayLike<number>): { frames: Frame[], weights: Float32Array, gradients: Float32Array };
    /** The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An index
     *  that is no piece's: KIRI_ERROR_ARGUMENT. */
    getPiece(piece: number, into?: PieceState): PieceState;
    /** The first of these calls after a cut sorts the sheet by pieces, which may fail with KIRI_ERROR_MEMORY. An index
     *  that is no piece's: KIRI_ERROR_ARGUMENT. */
    getPieceMesh(piece: number, into?: PieceMesh): PieceMesh;
    /** *frames points to *count ids. */
    getPieceFrames(piece: number): Frame[];
    /** Destroys all pieces below an area (m^2) except the largest piece, at the cost of one. *count is how many. Where
     *  that one waits to become a sheet, the largest of the others stays, too. */
    dropCrumbs(area: number): number;
    /** A cut is a polyline in the rest plane. Points may lie anywhere: what is outside the sheet cuts nothing. Points
     *  wait until the next tick. The end of a cut that lies inside the sheet stays closed until the blade moves on. */
    beginCut(restPoint: ArrayLike<number>): Cut;
    /** A blade (a straight edge) that moves in world space from blade[0]-blade[1] to blade[3]-blade[2] cuts where the
     *  swept quadrilateral meets the sheet as it is now, past borders, so that it parts what it crosses. The cut is
     *  ended already. Slices of a sheet that moves do not join from tick to tick: for that take a blade. */
    slice(blade: ArrayLike<number>): Cut;
    /** Writes up to `capacity` ids of the sheet's frames; *count is how many there are. */
    getFrames(): Frame[];
    /** A force (N, world) on a point of the material and a torque (N m). */
    applyForce(restPoint: ArrayLike<number>, force: ArrayLike<number>, torque: ArrayLike<number>): ResultCode;
    /** A force (N, world) on each metre of a straight line of the rest plane, as far as it lies in the material, edges
     *  included. Where it runs along a cut, each lip gets half. The ends differ; a line that meets no material:
     *  KIRI_ERROR_ARGUMENT. */
    applyLineLoad(from: ArrayLike<number>, to: ArrayLike<number>, forcePerLength: ArrayLike<number>): ResultCode;
    /** A pressure (Pa) that pushes the whole sheet along its normal, or against it where below 0. */
    applyPressure(pressure: number): ResultCode;
    /** An impulse (N s, world) on a point of the material, where it is seen now. Velocities change at once, by as much
     *  as the frames that carry the point resist; a held frame's part is lost. Outside the sheet: KIRI_ERROR_ARGUMENT. */
    applyImpulse(restPoint: ArrayLike<number>, impulse: ArrayLike<number>): ResultCode;
    /** Copied; it blows until the next call. */
    setWind(wind: WindGiven): ResultCode;
    /** Pins a point of the sheet. On failure *pin is 0. A point outside the sheet: KIRI_ERROR_ARGUMENT. */
    createPin(def: PinDefGiven): Pin;
    /** Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and
     *  direction of the material there, as a vice does; a hinge its place only, so that the sheet may turn about the
     *  line. Both begin where the material is now; the line stays straight, and as long as it is at rest: so material
     *  that is bent there is pulled straight, and pieces that have come apart are pulled together, however fast that
     *  makes them.
     *
     *  They hold what the line meets, edges included, with the stiffness that the material has between the line and the
     *  frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of frames, where
     *  Frame.hold clamps at a frame's site. A clamp through the sheet parts what is on its two sides, so that neither
     *  bends the other. A line that runs along a cut holds both lips; one beside it, by a 512th of a square of the grid
     *  or more, holds one. The ends differ; a line that meets no material: KIRI_ERROR_ARGUMENT. */
    clampLine(from: ArrayLike<number>, to: ArrayLike<number>): Pin;
    /** Pins along a straight line of the rest plane, an edge of the sheet or any other. A clamp holds place and
     *  direction of the material there, as a vice does; a hinge its place only, so that the sheet may turn about the
     *  line. Both begin where the material is now; the line stays straight, and as long as it is at rest: so material
     *  that is bent there is pulled straight, and pieces that have come apart are pulled together, however fast that
     *  makes them.
     *
     *  They hold what the line meets, edges included, with the stiffness that the material has between the line and the
     *  frames that it meets. So a clamp along an edge is where the drawing has it, whatever the number of frames, where
     *  Frame.hold clamps at a frame's site. A clamp through the sheet parts what is on its two sides, so that neither
     *  bends the other. A line that runs along a cut holds both lips; one beside it, by a 512th of a square of the grid
     *  or more, holds one. The ends differ; a line that meets no material: KIRI_ERROR_ARGUMENT. */
    hingeLine(from: ArrayLike<number>, to: ArrayLike<number>): Pin;
    /** Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are. */
    getPins(): Pin[];
    /** The contacts of the next tick; they replace those of an earlier call, and are gone after the tick. A contact is
     *  known again by its point, or its rest point, and its obstacle: what it pushed with is where the next tick
     *  starts. */
    setContacts(contacts: ContactGiven[]): ResultCode;
    /** One for each contact that was set before the last tick, in the order given. The sum of the impulses, with those
     *  of gravity, loads and obstacles, is the change of momentum of a piece that nothing holds. A piece that sleeps
     *  goes on to press with what it fell asleep with. */
    getContactForces(): Rows<ContactForce>;
    /** The box (m, world) that holds all that the sheet may touch in a tick of dt: a host needs no obstacles or
     *  contacts outside. It reaches as far around the sheet as its fastest point can go by its velocity and gravity,
     *  twice, and the contact thickness. Obstacles that move themselves come as much nearer. dt as in World.tick. */
    getReach(dt: number): { lower: Float32Array, upper: Float32Array };
}

export class Cut {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** restPoints: 2 floats a point; count is 1 to 2^24. */
    extend(restPoints: ArrayLike<number>): ResultCode;
    /** No more points come. After the tick in which the last of them takes effect the id is stale, and
     *  KIRI_EVENT_CUT_FINISHED tells. Frames that the sheet needs after the cut are added then. */
    end(): ResultCode;
}

export class Frame {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** From now on it moves as a rigid body, until forces change that: `velocity` (m/s) of its centre of mass, and
     *  `angularVelocity` (rad/s) about it. What a planar sheet has across its plane is dropped; held frames follow
     *  their hold. Frame.setPieceVelocity: of the piece with that frame alone. */
    setPieceVelocity(velocity: ArrayLike<number>, angularVelocity: ArrayLike<number>): ResultCode;
    /** A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
     *  Frame.detachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
     *  parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
    setPieceUserData(data: number | bigint): ResultCode;
    /** A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
     *  Frame.detachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
     *  parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
    getPieceUserData(): bigint;
    /** The index that the piece with this frame has now. */
    getPiece(): number;
    /** Makes a sheet of the piece with this frame. Its frames, pins and collision points move along, in their order;
     *  they keep their ids and states, and what waits for the next tick: the motion goes on as if nothing had happened,
     *  but for the solver's guard over energy and step length, which is one for each sheet. A clamp or hinge that holds
     *  both becomes two: the rest keeps the id, the new sheet's has one of its own (Sheet.getPins). Both sheets have
     *  all settings (of collisionPoints and integrationPoints the share that falls to their area), maxFrames each for
     *  itself; a piece that sleeps goes on sleeping. Cuts stay with the rest: a blade in the piece cuts nothing until
     *  it is back. Indices of collision points of the rest change. Its triangles and vertices keep their indices where
     *  it has more than 4096 vertices, and while no more than half of them are of pieces that went: these triangles
     *  have three equal corners, these vertices are of no triangle. Else all move together, and their indices change.
     *  In either case its revision grows, and Sheet.getDirty says what changed. The new sheet has the squares of the
     *  grid around it, at about 40 bytes a square: crumbs are better dropped. Costs what the piece takes to make, and a
     *  look at the weights of what is left; where indices change more. KIRI_PENDING: work on a cut is at hand in the
     *  sheet, or it takes more samples than the budget leaves calls before the next tick; *detached is 0. When the work
     *  is done, what is the piece of this frame then becomes a sheet, and KIRI_EVENT_PIECE_DETACHED names it. Samples
     *  pay for it before, over several ticks if need be, of many pieces one after the other: of the first that waits 3
     *  for each vertex, 2.5 to 9 for each cell (the more frames, the more) and 100 for each frame, of others 3 for each
     *  vertex and 1.4 for each cell; and one for 80 vertices of the rest. Until then further cuts of the sheet wait.
     *  The first piece is made as it is paid, and leaves at the start of the tick after the last sample is paid. That
     *  tick does an eighth of the work; the first tick after a load makes the parts again that saves leave out. The
     *  coming ticks have fewer samples for the work of calls. KIRI_ERROR_STATE: nothing would be left of the sheet. */
    detachPiece(): Sheet | null;
    /** The same without keeping the piece: ids of its frames and pins are stale. Costs as much, but for making a sheet:
     *  that is done at once, and the coming ticks have less. Where Sheet.getMesh has been called since the last tick,
     *  all indices are copied. KIRI_PENDING: work on a cut is at hand. The piece is gone all the same: its triangles
     *  are in kiriMesh, with three equal corners; it touches nothing; no point of it is found. When the work is done
     *  its vertices go, too; until then kiriCounts still counts it, and its kiriPieceState is all zeros. */
    destroyPiece(): ResultCode;
    /** Pose, motion and region as they are now. */
    getState(into?: FrameState): FrameState;
    /** The host moves the frame: its rest point, as it is seen, goes to `position` with `rotation` (a rotation matrix,
     *  columns as above) in the next tick, evenly, and stays there until the next call. An affine frame is not
     *  stretched then. On a planar sheet the rotation is about its normal. Null, null: it is free again. Contacts do
     *  not push material that held frames carry for more than half: it goes where the host has it, through obstacles
     *  too. */
    hold(position?: ArrayLike<number> | null, rotation?: ArrayLike<number> | null): ResultCode;
    /** With what the host's hold acted on the sheet: force (N, world) and torque (N m) about the frame's rest point;
     *  means over the last tick, impulses divided by its dt. They carry the frame's own weight and change its momentum,
     *  too. Zero for a frame that was free. A piece that sleeps keeps those that it fell asleep with. */
    getReaction(): { force: Float64Array, torque: Float64Array };
    /** A force (N, world) on the frame's centre of mass and a torque (N m). */
    applyForce(force: ArrayLike<number>, torque: ArrayLike<number>): ResultCode;
}

export class Pin {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
     *  Frame.detachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
     *  parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
    setUserData(data: number | bigint): ResultCode;
    /** A number of the host's own; 0 at first. No tick depends on it, nor does the state hash. A sheet that
     *  Frame.detachPiece makes has that of the sheet it came from. A piece has one, named by any of its frames: the
     *  parts of a piece that is cut have that of the piece, as does a sheet that is made of it. */
    getUserData(): bigint;
    /** Where the pin holds its point, or the middle of its line (m, world): at the end of the next tick, and until the
     *  next call. Within the tick it goes there evenly. The current target of Pin.getState changes nothing. With
     *  KIRI_SKINNING_SMOOTH what pins and clamps hold is what is seen there; of a clamp the mean along its line, for
     *  each piece: single points of the line are seen a little off it. */
    setTarget(target: ArrayLike<number>): ResultCode;
    /** The same with the rotation of the line's material: columns are the directions of u and v and the normal. On a
     *  planar sheet it is about the sheet's normal. KIRI_ERROR_ARGUMENT for a pin that holds a point. */
    setPose(target: ArrayLike<number>, rotation: ArrayLike<number>): ResultCode;
    /** As in the def, for pins of all types; N, 0: it never breaks. */
    setBreakForce(breakForce: number): ResultCode;
    /** What it is, and where it holds now. */
    getState(into?: PinState): PinState;
    /** With what the pin acted on the sheet: force (N, world) and torque (N m) about its target; means over the last
     *  tick, impulses divided by its dt. So the reactions of all pins and held frames are the weight of a sheet at
     *  rest, and in motion what changes its momentum (as far as `iterations` have the tick solved). Zero before the
     *  first tick. A piece that sleeps keeps those that it fell asleep with. */
    getReaction(): { force: Float64Array, torque: Float64Array };
    /** It lets go; its id is stale. */
    destroy(): ResultCode;
}

export class Obstacle {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** It is gone, its id stale. What rested on it wakes. */
    destroy(): ResultCode;
    /** Where it is when the next tick starts. It did not move there: velocities alone say what sheets feel. rotation: a
     *  rotation matrix, columns as in the def. */
    setPose(position: ArrayLike<number>, rotation: ArrayLike<number>): ResultCode;
    /** With what it moves in the next tick and from then on. */
    setVelocity(velocity: ArrayLike<number>, angularVelocity: ArrayLike<number>): ResultCode;
    /** With what it moves in the next tick and from then on. */
    setSurfaceVelocity(velocity: ArrayLike<number>): ResultCode;
    /** As in the def. */
    setMass(mass: number, inertia: ArrayLike<number>, centerOfMass: ArrayLike<number>): ResultCode;
    /** Pose and velocities as they are now. */
    getState(into?: ObstacleState): ObstacleState;
}

export class Blade {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** The blade is now the straight edge between two points (m, world). From where it was it got there straight, each
     *  end along a line. The first call only says where it begins. Where an end of the edge lies inside of what it
     *  sweeps of the sheet, it cuts only what it sweeps. An edge without length cuts nothing. */
    moveEdge(from: ArrayLike<number>, to: ArrayLike<number>): ResultCode;
    /** The same for a ray that a camera casts: an edge `length` m long. */
    moveRay(origin: ArrayLike<number>, direction: ArrayLike<number>, length: number): ResultCode;
    /** It is gone, its id stale; what it has cut stays, and where it was in a layer the cut ends. */
    end(): ResultCode;
}
