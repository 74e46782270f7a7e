/// <reference lib="esnext.disposable" />
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
    /** success; work is left for later ticks */
    Pending = 1,
    /** null, NaN, infinite, outside the documented range, or beyond 4e37 m, m/s or 1/s */
    ErrorArgument = -1,
    /** the def was not filled by its kiriDefault function: call that first */
    ErrorDef = -2,
    /** unknown or stale id, or the id of another kind */
    ErrorId = -3,
    /** the triangles do not form a sheet: degenerate, inverted, duplicate, overlapping */
    ErrorMesh = -4,
    /** the call comes in the wrong order, or from a callback that may not make it */
    ErrorState = -5,
    /** the allocator returned null */
    ErrorMemory = -6,
    /** the motion of a sheet could not be continued; the sheet was stopped where it was */
    Diverged = -7,
    /** all ids of a kind are used up: 4 194 304 at a time, 2^29 over the life of a world */
    ErrorLimit = -8,
    /** floats are not computed as on other machines, see kiriCreateWorld */
    ErrorBuild = -9,
    /** the bytes are damaged, cut short, of another kind, or of a later version */
    ErrorData = -10,
    /** a repeated call gave another result than its recording has */
    ErrorReplay = -11,
}

/** Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance: using
 *  30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut takes
 *  effect; the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it (manual,
 *  budget). */
export const LEAST_TRIANGLES: 16;

export const MOST_NOTE_BYTES: 1048576;

/** Events since the start of the last tick that was not refused. */
export enum EventType {
    /** cut: all of it is in the mesh; the id is stale from now on */
    CutFinished = 1,
    /** frame (its first, which names it), crumb, area: a part came off, never the largest */
    PieceOff = 2,
    /** frame */
    FrameAdded = 3,
    /** the sheet was stopped */
    Diverged = 4,
    /** stage, waiting: the budget ended in this stage of the sheet's work */
    Deferred = 5,
    /** pin: its force exceeded breakForce; the id is stale from now on */
    PinBroke = 6,
    /** sheet (the new one), frame, area: a pending Frame.detachPiece is done */
    PieceDetached = 7,
    /** seam, stitches: some stitches broke; with none left the id is stale from now on */
    SeamBroke = 8,
    /** cut: the library began it, see kiriTearing */
    TearBegan = 9,
    /** cut: the tear has rested for half a second; the id is stale from now on */
    TearEnded = 10,
    /** area: of the visible surface, over a tenth of it, strained by over 15 % for 1 s */
    Strained = 11,
}

/** The stages of a tick in their order. */
export enum Stage {
    /** splits the mesh along the blade */
    Cut = 0,
    /** cells and their connections */
    Grid = 1,
    /** geodesic distances, regions, links; places frames */
    Regions = 2,
    /** shape functions */
    Shape = 3,
    /** weights of vertices and collision points */
    Samples = 4,
    /** mass, the pattern of the solver's matrix, and the commit */
    Constants = 5,
    /** contacts with obstacles, other sheets and other pieces */
    Contact = 6,
    /** the motion of the frames */
    Solve = 7,
    /** positions and normals of the mesh */
    Skin = 8,
    Count = 9,
}

/** Materials to start from; src/world/kiri_api_world.c has the sources. From SILK on: measured cloths (manual, sheets) */
export enum MaterialPreset {
    /** printing paper, 0.11 mm */
    Paper = 0,
    /** cloth, 0.5 mm; the default of a sheet def */
    Cotton = 1,
    /** natural rubber, 1 mm */
    Rubber = 2,
    /** aluminium, 16 um */
    Foil = 3,
    /** paperboard, 0.4 mm */
    Card = 4,
    Silk = 5,
    Shirting = 6,
    Wool = 7,
    Denim = 8,
    Jersey = 9,
    Count = 10,
}

/** Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual, accuracy). */
export enum QualityPreset {
    Fast = 0,
    Balanced = 1,
    Accurate = 2,
    Count = 3,
}

/** Kinds of sheets to begin with. They want a tick of 1/60 s with 4 substeps; curtain and card do with 2. */
export enum SetupPreset {
    Curtain = 0,
    Paper = 1,
    Flag = 2,
    Ribbon = 3,
    Rubber = 4,
    Card = 5,
    Foil = 6,
    Count = 7,
}

/** How a sheet deforms (manual, sheets). Rigid frames have 6 unknowns, affine ones 12. */
export enum Model {
    /** rigid frames joined by links: paper, foil, stiff cloth */
    Links = 0,
    /** affine frames joined by links: cloth and rubber that stretch inside a region */
    Affine = 1,
    /** affine frames, strains at integration points, as in the paper. Thin sheets hardly bend */
    Points = 2,
}

/** The surface between the frames, which blades and contacts meet (manual, sheets). */
export enum Skinning {
    /** each frame carries a flat patch; the weights blend them (equation 1 of the paper) */
    Linear = 0,
    /** patches bend and stretch as their neighbours lie: no bumps at the frames */
    Smooth = 1,
}

/** Integration in time, with one linear system an iteration. Steps with contacts or new pins take backward Euler. */
export enum TimeStepping {
    /** TR-BDF2, of second order: keeps the energy of motion */
    SecondOrder = 0,
    /** backward Euler, of first order: takes energy out of a swing, more in longer steps */
    Euler = 1,
}

/** The types of pins. */
export enum PinType {
    Point = 0,
    Hinge = 1,
    Clamp = 2,
}

/** A body that sheets touch: a floor, a ball, a crate of another engine. It moves on with its velocities alone: set
 *  pose and velocity before a tick, and apply the impulse of its state after it (manual, contact). Lengths: up to 1e6
 *  m. */
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
    /** outline: convex, in the plane of the first two columns; height along the third, 0: endless */
    Prism = 5,
}

/** The things to draw. */
export enum DrawFlag {
    /** a triangle for each triangle of the mesh, in a colour of its piece; sleeping: pale */
    Triangles = 1,
    /** a line for each edge between two triangles */
    Edges = 2,
    /** a line for each edge of the outline, of lips and of folds */
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

/** Limits the work of one tick, over all sheets. 0: no limit. Triangles, cells and samples share one allowance: using
 *  30 % of one leaves 70 % of the others. Other work goes on in the next tick. The budget decides when a cut takes
 *  effect; the mesh, grid, regions, weights and sites of frames after all work is done do not depend on it (manual,
 *  budget). */
export class Budget {
    /** split by blades; 0, or KIRI_LEAST_TRIANGLES and more */
    triangles: number;
    /** visited, or with a new distance: grid, regions, shape functions. A link counts as a cell */
    cells: number;
    /** vertices and collision points with new weights, and the cost of the commit, paid before it */
    samples: number;
    /** linear systems, 30 to 60 us each; a large one counts as several (manual, budget) */
    iterations: number;
}
/** What a host gives as Budget: what is left out is 0. */
export interface BudgetGiven {
    /** split by blades; 0, or KIRI_LEAST_TRIANGLES and more */
    triangles?: number;
    /** visited, or with a new distance: grid, regions, shape functions. A link counts as a cell */
    cells?: number;
    /** vertices and collision points with new weights, and the cost of the commit, paid before it */
    samples?: number;
    /** linear systems, 30 to 60 us each; a large one counts as several (manual, budget) */
    iterations?: number;
}

/** Settings of a world: gravity, budget, and functions of the host. */
export class WorldDef {
    cookie: number;
    /** m/s^2; default (0, 0, -9.81) */
    gravity: number[];
    /** default: no limit */
    budget: Budget;
    /** ticks between state hashes in the recording; one is at its end. 0: none. Default 60 */
    recordHashTicks: number;
}
/** What a host gives as WorldDef: what is left out is as the default has it. */
export interface WorldDefGiven {
    cookie?: number;
    /** m/s^2; default (0, 0, -9.81) */
    gravity?: ArrayLike<number>;
    /** default: no limit */
    budget?: BudgetGiven;
    /** ticks between state hashes in the recording; one is at its end. 0: none. Default 60 */
    recordHashTicks?: number;
    /** Gets one line for each error. */
    log?: (line: string) => void;
    /** Seconds, for the profile. */
    clock?: () => number;
    /** Gets the next bytes of the recording. */
    record?: (bytes: Uint8Array) => void;
}

export function defaultWorldDef(into?: WorldDef): WorldDef;

/** Progress of a replay. Set all fields to zero before the first call. */
export class Replay {
    /** bytes of the recording that were read; calls and ticks made, without refused ticks */
    offset: number;
    /** bytes of the recording that were read; calls and ticks made, without refused ticks */
    calls: number;
    /** bytes of the recording that were read; calls and ticks made, without refused ticks */
    ticks: number;
    /** bytes of the note where the replay stopped, in the recording; else null */
    note: Uint8Array | null;
    noteCount: number;
}
/** What a host gives as Replay: what is left out is 0. */
export interface ReplayGiven {
    /** bytes of the recording that were read; calls and ticks made, without refused ticks */
    offset?: number;
    /** bytes of the recording that were read; calls and ticks made, without refused ticks */
    calls?: number;
    /** bytes of the recording that were read; calls and ticks made, without refused ticks */
    ticks?: number;
}

/** An event. It fills the fields that its type names, and `sheet`. Other fields are 0, and `stage` is -1. */
export type Event =
    { type: EventType.CutFinished; sheet: Sheet; cut: Cut } |
    { type: EventType.PieceOff; sheet: Sheet; frame: Frame; crumb: boolean; area: number } |
    { type: EventType.FrameAdded; sheet: Sheet; frame: Frame } |
    { type: EventType.Diverged; sheet: Sheet } |
    { type: EventType.Deferred; sheet: Sheet; stage: Stage; waiting: number } |
    { type: EventType.PinBroke; sheet: Sheet; pin: Pin } |
    { type: EventType.PieceDetached; sheet: Sheet; frame: Frame; area: number } |
    { type: EventType.SeamBroke; sheet: Sheet; seam: Seam; stitches: number } |
    { type: EventType.TearBegan; sheet: Sheet; cut: Cut } |
    { type: EventType.TearEnded; sheet: Sheet; cut: Cut } |
    { type: EventType.Strained; sheet: Sheet; area: number };

/** Work and time of the last tick. */
export class Profile {
    /** of the last tick; zero without a clock */
    seconds: number[];
    /** blade segments that took effect */
    cutSegments: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    trianglesSplit: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    cellsSettled: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    samplesRefreshed: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    solverIterations: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    cellsChanged: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    weightsChanged: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    verticesChanged: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    pointsChanged: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    linksChanged: number;
    /** sheets in which a cut took effect; linear systems, large and small */
    commits: number;
    /** sheets in which a cut took effect; linear systems, large and small */
    systemsSolved: number;
    /** planes given to the solver: by the host, by obstacles, and between sheets */
    contacts: number;
    /** pairs of sheets or pieces that are near each other and not both asleep */
    sheetPairs: number;
    /** The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m. */
    largestJump: number;
    /** The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m. */
    largestFade: number;
}
/** What a host gives as Profile: what is left out is 0. */
export interface ProfileGiven {
    /** of the last tick; zero without a clock */
    seconds?: ArrayLike<number>;
    /** blade segments that took effect */
    cutSegments?: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    trianglesSplit?: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    cellsSettled?: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    samplesRefreshed?: number;
    /** Items in the units of kiriBudget. An item that takes more work counts more than once. */
    solverIterations?: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    cellsChanged?: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    weightsChanged?: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    verticesChanged?: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    pointsChanged?: number;
    /** Changes by commits: cells, weights of cells, of vertices and of collision points, links (totals: kiriCounts). */
    linksChanged?: number;
    /** sheets in which a cut took effect; linear systems, large and small */
    commits?: number;
    /** sheets in which a cut took effect; linear systems, large and small */
    systemsSolved?: number;
    /** planes given to the solver: by the host, by obstacles, and between sheets */
    contacts?: number;
    /** pairs of sheets or pieces that are near each other and not both asleep */
    sheetPairs?: number;
    /** The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m. */
    largestJump?: number;
    /** The longest jump of a vertex when a cut took effect, as without fadeTime, and the longest way by a fade; m. */
    largestFade?: number;
}

/** The material of a sheet: homogeneous, isotropic. */
export class Material {
    /** Pa, above 0 */
    youngsModulus: number;
    /** 0 to below 0.5 */
    poissonsRatio: number;
    /** m, above 0 */
    thickness: number;
    /** kg/m^3, above 0 */
    density: number;
    /** 1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets) */
    airDamping: number;
    /** s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation */
    flexDamping: number;
    /** Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not planar */
    yieldStress: number;
    /** modulus beyond the yield stress, relative to youngsModulus; 0 to below 1 */
    hardening: number;
    /** 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets) */
    slack: number;
    /** sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0 */
    detail: number;
    /** 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0 */
    restCurvature: number[];
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
    /** 1/s, 0 or more: velocities fade to the air's, as exp(-airDamping t) (manual, sheets) */
    airDamping?: number;
    /** s, 0 or more: stiffness-proportional (Rayleigh) damping of deformation */
    flexDamping?: number;
    /** Pa, 0 or more: bends beyond it stay, but sharp dents need a kiriFold. KIRI_MODEL_LINKS, not planar */
    yieldStress?: number;
    /** modulus beyond the yield stress, relative to youngsModulus; 0 to below 1 */
    hardening?: number;
    /** 0 to below 1: part of the stiffness against compression that wrinkles take (manual, sheets) */
    slack?: number;
    /** sweeps of the detail layer a tick, 0 (off, as if planar) to 16. Presets: cloths 2, others 0 */
    detail?: number;
    /** 1/m, to 1e6: along x, y, twist; above 0: rises to the front. As yieldStress. Presets: 0 */
    restCurvature?: ArrayLike<number>;
}

/** Work against accuracy: uncut strips, squares of paper are off by at most 2 %, 0.8 % and 0.4 % (manual, accuracy). */
export class Quality {
    /** control frames in a row along a strip; a square needs 3 x 3, 5 x 5, 9 x 9 */
    framesAlong: number;
    /** for the sheet def */
    gridResolution: number;
    /** for the sheet def */
    iterations: number;
    /** for World.tick */
    substeps: number;
}

/** Options of the paper, for comparison; part of the sheet def. Default 0, but for integrationOrder. */
export class PaperOptions {
    /** 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits */
    fromScratch: boolean;
    /** 1: only new frames take their motion from the surface: it jumps, momentum is not kept */
    popping: boolean;
    /** 1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS */
    linearWeights: boolean;
    /** KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
     *  frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work. */
    integrationPoints: number;
    /** KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
     *  frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work. */
    integrationOrder: number;
}
/** What a host gives as PaperOptions: what is left out is 0. */
export interface PaperOptionsGiven {
    /** 1: every cut rebuilds grid, regions and shape functions from scratch, to the same bits */
    fromScratch?: boolean | number;
    /** 1: only new frames take their motion from the surface: it jumps, momentum is not kept */
    popping?: boolean | number;
    /** 1: weights are linear between frames: a kink at each; always so with KIRI_MODEL_POINTS */
    linearWeights?: boolean | number;
    /** KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
     *  frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work. */
    integrationPoints?: number;
    /** KIRI_MODEL_POINTS: 0 to 1048576 points, spread evenly, one in every piece at least; 0: four for each of
     *  frameCount. Strain around a point: of order 1, constant (default), or 2, linear: four times the work. */
    integrationOrder?: number;
}

/** A sheet: its rest shape, start, material, and computation. */
export class SheetDef {
    cookie: number;
    /** The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge; holes and several parts
     *  are allowed. Two edges in the same place with different vertices are the lips of a cut (manual, meshes). 2
     *  floats (u, v) a vertex */
    restPositions: Float32Array;
    vertexCount: number;
    /** 3 a triangle */
    indices: Int32Array;
    triangleCount: number;
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    position: number[];
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    axisU: number[];
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    axisV: number[];
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    velocity: number[];
    material: Material;
    /** grid squares along the longer side, 1 to 4096; default 32 */
    gridResolution: number;
    /** m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side */
    snapDistance: number;
    /** m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none */
    weldDistance: number;
    /** Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
     *  frames are spread evenly, in straight rows over stiff rectangles, or fewer: one for two squares of the grid.
     *  frameCount 0: regions are split, after cuts too, to frameLength; 0: it follows from `accuracy`, the relative
     *  error (manual, accuracy). 0, or 1 and more; default 24 */
    frameCount: number;
    /** m; used where frameCount is 0; default 0 */
    frameLength: number;
    /** 1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default 0.02 */
    accuracy: number;
    /** 2 floats a frame, or null */
    framePoints: Float32Array | null;
    /** re-sampling stops here; default 256 */
    maxFrames: number;
    /** Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
     *  beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy).
     *  default 0.95, 0 */
    rigidWeight: number;
    /** Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
     *  beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy).
     *  default 0.95, 0 */
    rigidArea: number;
    /** m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0 */
    crumbArea: number;
    /** of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5 */
    friction: number;
    /** m between sheets, half to obstacles. 0: the material's, at least a 20th of a square */
    contactThickness: number;
    /** obstacles and sheets touch if they share a set bit. Default: all */
    groups: number;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    touchesSheets: boolean;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    selfContact: boolean;
    /** for Sheet.setContacts: spread evenly, at least one in every piece; default 0: none */
    collisionPoints: number;
    /** Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual */
    iterations: number;
    /** m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never */
    sleepSpeed: number;
    /** KIRI_MODEL_..., default KIRI_MODEL_LINKS */
    model: Model;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH */
    skinning: Skinning;
    /** 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0 */
    planar: boolean;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping: TimeStepping;
    /** s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2 */
    fadeTime: number;
    /** 1: every tick computes normals (default). 0: kiriMesh has none, which saves time */
    normals: boolean;
    /** default: all off */
    paper: PaperOptions;
}
/** What a host gives as SheetDef: what is left out is as the default has it. */
export interface SheetDefGiven {
    cookie?: number;
    /** The rest shape: triangles in the rest plane, counter-clockwise, at most two at an edge; holes and several parts
     *  are allowed. Two edges in the same place with different vertices are the lips of a cut (manual, meshes). 2
     *  floats (u, v) a vertex */
    restPositions?: ArrayLike<number> | null;
    /** 3 a triangle */
    indices?: ArrayLike<number> | null;
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    position?: ArrayLike<number>;
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    axisU?: ArrayLike<number>;
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    axisV?: ArrayLike<number>;
    /** Start: x = position + u axisU + v axisV (m, world), with orthonormal axes; and velocity, m/s. */
    velocity?: ArrayLike<number>;
    material?: MaterialGiven;
    /** grid squares along the longer side, 1 to 4096; default 32 */
    gridResolution?: number;
    /** m: ends of cuts this near to a lip or border meet it (cutting). 0: 1e-4 of the side */
    snapDistance?: number;
    /** m, 0 or more: merges vertices nearer than this (manual, meshes). Default 0: none */
    weldDistance?: number;
    /** Control frames. framePoints: 2 floats a frame, in the material, a grid square apart at least; null: frameCount
     *  frames are spread evenly, in straight rows over stiff rectangles, or fewer: one for two squares of the grid.
     *  frameCount 0: regions are split, after cuts too, to frameLength; 0: it follows from `accuracy`, the relative
     *  error (manual, accuracy). 0, or 1 and more; default 24 */
    frameCount?: number;
    /** m; used where frameCount is 0; default 0 */
    frameLength?: number;
    /** 1e-4 to 1; used where frameCount and frameLength are 0; heeds pins of a new sheet; default 0.02 */
    accuracy?: number;
    /** 2 floats a frame, or null */
    framePoints?: ArrayLike<number> | null;
    /** re-sampling stops here; default 256 */
    maxFrames?: number;
    /** Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
     *  beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy).
     *  default 0.95, 0 */
    rigidWeight?: number;
    /** Re-sampling: a frame whose weight exceeds rigidWeight over an area larger than rigidArea (m^2) gets new frames
     *  beside it; a new sheet only with frameCount 0. rigidArea 0: a quarter of a frame's area (manual, accuracy).
     *  default 0.95, 0 */
    rigidArea?: number;
    /** m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0 */
    crumbArea?: number;
    /** of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5 */
    friction?: number;
    /** m between sheets, half to obstacles. 0: the material's, at least a 20th of a square */
    contactThickness?: number;
    /** obstacles and sheets touch if they share a set bit. Default: all */
    groups?: number;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    touchesSheets?: boolean | number;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    selfContact?: boolean | number;
    /** for Sheet.setContacts: spread evenly, at least one in every piece; default 0: none */
    collisionPoints?: number;
    /** Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual */
    iterations?: number;
    /** m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never */
    sleepSpeed?: number;
    /** KIRI_MODEL_..., default KIRI_MODEL_LINKS */
    model?: Model;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH */
    skinning?: Skinning;
    /** 1: it stays in the plane where it starts, unbent; forces across are dropped. Default 0 */
    planar?: boolean | number;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping?: TimeStepping;
    /** s: jumps of the surface and of strains fade within this when a cut takes effect. Default 0.2 */
    fadeTime?: number;
    /** 1: every tick computes normals (default). 0: kiriMesh has none, which saves time */
    normals?: boolean | number;
    /** default: all off */
    paper?: PaperOptionsGiven;
}

export function defaultSheetDef(into?: SheetDef): SheetDef;

/** Sheet settings that can change after creation. Fields mean the same as in kiriSheetDef. */
export class SheetSettings {
    cookie: number;
    material: Material;
    /** re-sampling stops here; default 256 */
    maxFrames: number;
    /** m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0 */
    crumbArea: number;
    /** of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5 */
    friction: number;
    /** m between sheets, half to obstacles. 0: the material's, at least a 20th of a square */
    contactThickness: number;
    /** obstacles and sheets touch if they share a set bit. Default: all */
    groups: number;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    touchesSheets: boolean;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    selfContact: boolean;
    /** Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual */
    iterations: number;
    /** m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never */
    sleepSpeed: number;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH */
    skinning: Skinning;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping: TimeStepping;
    /** stays 0 with paper.popping */
    fadeTime: number;
    /** 1: every tick computes normals (default). 0: kiriMesh has none, which saves time */
    normals: boolean;
}
/** What a host gives as SheetSettings: what is left out is 0. */
export interface SheetSettingsGiven {
    cookie?: number;
    material?: MaterialGiven;
    /** re-sampling stops here; default 256 */
    maxFrames?: number;
    /** m^2: a smaller piece is a crumb: it gets one frame if it has none, and no more. Default 0 */
    crumbArea?: number;
    /** of the sheet, 0 or more. The friction between two sides is their geometric mean. Default 0.5 */
    friction?: number;
    /** m between sheets, half to obstacles. 0: the material's, at least a 20th of a square */
    contactThickness?: number;
    /** obstacles and sheets touch if they share a set bit. Default: all */
    groups?: number;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    touchesSheets?: boolean | number;
    /** touchesSheets 1: its pieces touch each other, and other sheets of the same model that have it set. selfContact
     *  1: layers of a piece that folds stay apart. Ignored if planar. Manual: contact. Default 0. */
    selfContact?: boolean | number;
    /** Newton steps a substep, 1 to 64; default 2. A sheet of 1000 frames needs 8, see the manual */
    iterations?: number;
    /** m/s: a piece slower for half a second sleeps (manual, budget). Default 0.001; 0: never */
    sleepSpeed?: number;
    /** KIRI_SKINNING_..., default KIRI_SKINNING_SMOOTH */
    skinning?: Skinning;
    /** KIRI_TIME_STEPPING_..., default KIRI_TIME_STEPPING_SECOND_ORDER */
    timeStepping?: TimeStepping;
    /** stays 0 with paper.popping */
    fadeTime?: number;
    /** 1: every tick computes normals (default). 0: kiriMesh has none, which saves time */
    normals?: boolean | number;
}

/** A straight line of the rest plane along which a sheet folds. The sheet stays in one piece, and each side has its own
 *  frames. Lines may end in the material, meet and cross; cuts go through or along them (manual, folding). */
export class Fold {
    /** m */
    from: number[];
    /** m */
    to: number[];
    /** N m/rad per metre of the line, 0 or more; 0: a free hinge */
    stiffness: number;
    /** rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it */
    restAngle: number;
    /** N m per metre: it bends for good beyond, with a yieldStress. 0: no limit */
    yieldMoment: number;
}
/** What a host gives as Fold: what is left out is 0. */
export interface FoldGiven {
    /** m */
    from?: ArrayLike<number>;
    /** m */
    to?: ArrayLike<number>;
    /** N m/rad per metre of the line, 0 or more; 0: a free hinge */
    stiffness?: number;
    /** rad, -pi to pi; above 0 the sides fold towards the normal (valley), below away from it */
    restAngle?: number;
    /** N m per metre: it bends for good beyond, with a yieldStress. 0: no limit */
    yieldMoment?: number;
}

/** A fold, its mean angle (rad, as restAngle) and the length (m) along which it joins two sides: not cut, nor rigid. */
export class FoldState {
    fold: Fold;
    angle: number;
    length: number;
}

/** The triangles to draw, as after the last tick, with the detail layer (manual, sheets). revision grows when indices
 *  or vertices are added or changed. Sources have the precision of the library, 2^-29 of the sheet. Arrays are those of
 *  the library: after the next tick they throw. */
export class Mesh {
    /** 3 a vertex, m, world */
    readonly positions: Float32Array;
    /** 3 a vertex, unit; null where the sheet makes none */
    readonly normals: Float32Array | null;
    /** 2 a vertex, m */
    readonly restPositions: Float32Array;
    /** 3 a triangle */
    readonly indices: Int32Array;
    /** 1 a vertex: the triangle of the def that contains it, */
    readonly sourceTriangles: Int32Array;
    /** 3 a vertex: and its barycentric coordinates there */
    readonly sourceWeights: Float32Array;
    vertexCount: number;
    triangleCount: number;
    revision: number;
}

/** `count` items from `first` on. */
export class Range {
    first: number;
    count: number;
}

/** Changes of the mesh, for hosts that keep a copy: of all but positions and normals, which change in every tick. */
export class Dirty {
    /** up to the last one of the mesh */
    newVertices: Range;
    /** up to the last one of the mesh */
    newTriangles: Range;
    /** the smallest ranges that hold all older ones with other data */
    oldVertices: Range;
    /** the smallest ranges that hold all older ones with other data */
    oldTriangles: Range;
    /** for the next call */
    revision: number;
}

/** The surface with a thickness, to draw: a closed mesh, with a rim along borders, holes and lips. First the vertices
 *  of kiriMesh on the side of the normal, then the same on the other side, then four for each border edge. Arrays are
 *  those of the library: after the next tick they throw. */
export class Solid {
    /** 3 a vertex, m, world */
    readonly positions: Float32Array;
    /** 3 a vertex, unit, outwards */
    readonly normals: Float32Array;
    /** 2 a vertex, m */
    readonly restPositions: Float32Array;
    /** 3 a triangle, counter-clockwise from outside */
    readonly indices: Int32Array;
    /** 1 a vertex: its vertex in kiriMesh */
    readonly sources: Int32Array;
    vertexCount: number;
    triangleCount: number;
    /** rims begin at this triangle */
    rimTriangle: number;
}

/** Numbers of items in a sheet. */
export class Counts {
    vertices: number;
    triangles: number;
    cells: number;
    frames: number;
    links: number;
    pieces: number;
    collisionPoints: number;
}

/** m^2, kg, J, J; centre of mass, m; linear and angular momentum about the world's origin, kg m/s and kg m^2/s. */
export class Totals {
    area: number;
    mass: number;
    kineticEnergy: number;
    elasticEnergy: number;
    center: number[];
    momentum: number[];
    angularMomentum: number[];
}

/** The first point where a ray meets a sheet. */
export class Hit {
    /** m: where to cut */
    restPoint: number[];
    /** m, world */
    position: number[];
    /** unit */
    normal: number[];
    /** m along the direction, which need not be a unit vector */
    distance: number;
    /** -1: none */
    triangle: number;
}

/** A point of the material on the visible surface. */
export class PointState {
    /** m, world; unit */
    position: number[];
    /** m, world; unit */
    normal: number[];
    /** m/s, by the weights of the point */
    velocity: number[];
    /** the frame of its region; it also names the piece */
    frame: Frame | null;
}

/** A connected part of a sheet. Any of its frames names it. Indices go from 0 to kiriCounts.pieces, and change when a
 *  piece comes off or goes (Frame.getPiece). Cuts with pending work have separated nothing yet. */
export class PieceState {
    /** m^2, kg */
    area: number;
    /** m^2, kg */
    mass: number;
    /** of mass, m; kg m/s, kg m^2/s about the origin */
    center: number[];
    /** of mass, m; kg m/s, kg m^2/s about the origin */
    momentum: number[];
    /** of mass, m; kg m/s, kg m^2/s about the origin */
    angularMomentum: number[];
    /** m, world: the smallest box around its vertices */
    lower: number[];
    /** m, world: the smallest box around its vertices */
    upper: number[];
    /** counts */
    frames: number;
    /** counts */
    vertices: number;
    /** counts */
    triangles: number;
    /** counts */
    collisionPoints: number;
    /** 1: see kiriSheetDef */
    crumb: boolean;
    /** 1: see sleepSpeed */
    asleep: boolean;
}

/** The mesh of a piece, in the order of the sheet's mesh. The arrays are parts of one for all pieces, piece by piece.
 *  Arrays are those of the library: after the next tick they throw. */
export class PieceMesh {
    /** 1 a vertex: its index in kiriMesh */
    readonly vertices: Int32Array;
    /** 1 a triangle: its index in kiriMesh */
    readonly triangles: Int32Array;
    /** 3 a triangle, as in kiriMesh: draw them */
    readonly indices: Int32Array;
    /** 1 a point, see Sheet.getCollisionPoints */
    readonly collisionPoints: Int32Array;
    vertexCount: number;
    triangleCount: number;
    collisionPointCount: number;
}

/** How a sheet tears. A tear is a cut whose points the library chooses: the end of an ended cut, or a sharp notch, goes
 *  on across the tension where the sheet would set more energy free than the tear takes. Two frames go with its tip.
 *  Where a mean tension over a distance of frames exceeds the strength, a tear begins at the nearest border, one at a
 *  time. */
export class Tearing {
    /** J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear */
    toughness: number;
    /** Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored */
    strength: number;
    /** direction in the rest plane along which it tears; 0, 0: none */
    grain: number[];
    /** toughness across the grain, relative to along it; below 1: 1 */
    grainRatio: number;
    /** m/s in the rest plane, 0 or more; 0: no limit but the distance above */
    maxSpeed: number;
    /** tips that tear in a tick, 0 or more; 0: 8. Others wait */
    maxTips: number;
}
/** What a host gives as Tearing: what is left out is 0. */
export interface TearingGiven {
    /** J/m^2 of torn section, 0 or more; 0 (default): the sheet does not tear */
    toughness?: number;
    /** Pa, 0 or more; 0 (default): no tear begins by itself. Without toughness: ignored */
    strength?: number;
    /** direction in the rest plane along which it tears; 0, 0: none */
    grain?: ArrayLike<number>;
    /** toughness across the grain, relative to along it; below 1: 1 */
    grainRatio?: number;
    /** m/s in the rest plane, 0 or more; 0: no limit but the distance above */
    maxSpeed?: number;
    /** tips that tear in a tick, 0 or more; 0: 8. Others wait */
    maxTips?: number;
}

/** Pose, motion and region of a frame. */
export class FrameState {
    /** m */
    restPoint: number[];
    /** m, world: of the rest point */
    position: number[];
    /** columns: direction of u, of v, normal; an affine frame: columns of A, which stretch */
    rotation: number[];
    /** m/s, rad/s */
    velocity: number[];
    /** m/s, rad/s */
    angularVelocity: number[];
    /** m^2 of its region; kg */
    area: number;
    /** m^2 of its region; kg */
    mass: number;
    /** 1: moved by the host, see Frame.hold */
    held: boolean;
}

/** What a host gives as Wind: what is left out is 0. */
export interface WindGiven {
    /** m/s */
    velocity?: ArrayLike<number>;
    /** kg/m^3, 0 or more; air: 1.2 */
    density?: number;
    /** 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01) */
    drag?: number;
    /** 0 or more: coefficients across (long plate 2, square 1.2) and along the sheet (smooth 0.01) */
    lift?: number;
}

/** A pin holds a point of the material at its target by a spring. */
export class PinDef {
    cookie: number;
    /** m, in the material */
    restPoint: number[];
    /** m, world */
    target: number[];
    /** N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target (manual) */
    stiffness: number;
    /** N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never */
    breakForce: number;
    /** 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there */
    obstacle: Obstacle | null;
}
/** What a host gives as PinDef: what is left out is as the default has it. */
export interface PinDefGiven {
    cookie?: number;
    /** m, in the material */
    restPoint?: ArrayLike<number>;
    /** m, world */
    target?: ArrayLike<number>;
    /** N/m. 0: ten times Young's modulus times thickness; from a tenth on drawn at its target (manual) */
    stiffness?: number;
    /** N: it breaks in a tick with a larger force (KIRI_EVENT_PIN_BROKE); 0: never */
    breakForce?: number;
    /** 0: none. The target moves with it; it feels the pin; destroyed, it leaves the target there */
    obstacle?: Obstacle | null;
}

export function defaultPinDef(into?: PinDef): PinDef;

/** Type and target of a pin. */
export class PinState {
    /** KIRI_PIN_... */
    type: PinType;
    sheet: Sheet | null;
    /** m, rest plane: the ends of the line, or the point twice */
    from: number[];
    /** m, rest plane: the ends of the line, or the point twice */
    to: number[];
    /** m, world */
    target: number[];
    /** of a line; of a point the identity */
    rotation: number[];
    /** N, or 0 */
    breakForce: number;
    /** that the target moves with; 0: none */
    obstacle: Obstacle | null;
}

/** A seam joins two lines in the material, of two sheets or of one: stitches join points at the same parts of both.
 *  Cuts go through a seam, and pieces keep their stitches. A stitch ends with the piece of a point (manual, sewing). */
export class SeamDef {
    cookie: number;
    /** of the same model, and not planar */
    sheetA: Sheet | null;
    /** of the same model, and not planar */
    sheetB: Sheet | null;
    /** 2 floats a point, m, in the material, such as its edge; copied */
    lineA: Float32Array;
    /** 2 floats a point */
    lineB: Float32Array;
    /** points: 2 to 65536 */
    countA: number;
    /** points: 2 to 65536 */
    countB: number;
    /** 2 to 4096; 0 (default): three for two distances of frames */
    stitches: number;
    /** N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free */
    stiffness: number;
    /** rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal */
    restAngle: number;
    /** N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never */
    breakForce: number;
}
/** What a host gives as SeamDef: what is left out is as the default has it. */
export interface SeamDefGiven {
    cookie?: number;
    /** of the same model, and not planar */
    sheetA?: Sheet | null;
    /** of the same model, and not planar */
    sheetB?: Sheet | null;
    /** 2 floats a point, m, in the material, such as its edge; copied */
    lineA?: ArrayLike<number> | null;
    /** 2 floats a point */
    lineB?: ArrayLike<number> | null;
    /** 2 to 4096; 0 (default): three for two distances of frames */
    stitches?: number;
    /** N m/rad per m: of a hinge along the seam, in series with the material of both sides; 0: free */
    stiffness?: number;
    /** rad, -pi to pi: 0 flat; above 0 sheet B turns to the side of A's normal */
    restAngle?: number;
    /** N/m: a stitch breaks if it and its neighbours carry more for their length; 0: never */
    breakForce?: number;
}

export function defaultSeamDef(into?: SeamDef): SeamDef;

/** A stitch, as after the last tick. */
export class Stitch {
    sheetA: Sheet | null;
    sheetB: Sheet | null;
    /** m, in the material */
    restA: number[];
    /** m, in the material */
    restB: number[];
    /** m, world: where both drawn lips meet; their middle while they are apart */
    position: number[];
    /** m: distance of the two points; a stitch yields by micrometres under the sheet's weight */
    gap: number;
    /** N, on sheet A: mean over the last tick that moved it */
    force: number[];
    /** rad, as restAngle */
    angle: number;
}

/** What a host gives as Contact: what is left out is 0. */
export interface ContactGiven {
    /** index of the collision point; -1: restPoint names the point */
    point?: number;
    /** m, in the material; read only where point is -1 */
    restPoint?: ArrayLike<number>;
    /** unit, out of the obstacle */
    normal?: ArrayLike<number>;
    /** m: of the obstacle's surface at the start of the tick */
    offset?: number;
    /** m/s: of the obstacle at the contact. The plane moves with it within the tick */
    velocity?: ArrayLike<number>;
    /** 0 or more: of both sides together */
    friction?: number;
    /** 1/kg, 0 or more: of the obstacle along the normal, 1/m + (r x n) . I^-1 (r x n); 0: rigid */
    inverseMass?: number;
    /** m/s, 0 or more: maximum speed of a point that is pushed out from below. 0: 1 m/s */
    pushSpeed?: number;
    /** a number of the host. Contacts with one number press on one obstacle, and share its mass */
    obstacle?: number;
}

/** The result of a contact in the last tick. */
export class ContactForce {
    /** N s, on the sheet: the sum over the tick. The obstacle gets the opposite */
    impulse: number[];
    /** m, world: the point of the sheet at the end of the tick */
    position: number[];
    /** m: of the point below the plane at the end of the tick; below 0: above it */
    depth: number;
    /** as in the contact */
    point: number;
    /** as in the contact */
    obstacle: number;
}

/** An obstacle: its shape, pose, motion, and mass. */
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
    /** 2 floats a corner, m, counter-clockwise; copied. Null: no prism */
    outline: Float32Array | null;
    /** 3 to 64 */
    outlineCount: number;
    /** m, 0 or more: prisms and boxes grow by this, with round edges. Default 0 */
    rounding: number;
    /** m, world */
    position: number[];
    /** columns; default: the axes of the world */
    rotation: number[];
    /** m/s, of its position */
    velocity: number[];
    /** rad/s */
    angularVelocity: number[];
    /** m/s, world: of its surface, added to its motion, as of a conveyor */
    surfaceVelocity: number[];
    /** 0 or more; default 0.5 */
    friction: number;
    /** kg; 0 (default): nothing moves it */
    mass: number;
    /** kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz. Positive definite,
     *  but for axes whose numbers are all 0: it does not turn about these */
    inertia: number[];
    /** m, from its position in its own axes */
    centerOfMass: number[];
    /** obstacles with the same number, except 0, are parts of one body; each has its whole mass */
    body: number;
    /** m/s, above 0: maximum speed at which points inside are pushed out. Default 1 */
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
    /** 2 floats a corner, m, counter-clockwise; copied. Null: no prism */
    outline?: ArrayLike<number> | null;
    /** m, 0 or more: prisms and boxes grow by this, with round edges. Default 0 */
    rounding?: number;
    /** m, world */
    position?: ArrayLike<number>;
    /** columns; default: the axes of the world */
    rotation?: ArrayLike<number>;
    /** m/s, of its position */
    velocity?: ArrayLike<number>;
    /** rad/s */
    angularVelocity?: ArrayLike<number>;
    /** m/s, world: of its surface, added to its motion, as of a conveyor */
    surfaceVelocity?: ArrayLike<number>;
    /** 0 or more; default 0.5 */
    friction?: number;
    /** kg; 0 (default): nothing moves it */
    mass?: number;
    /** kg m^2, about its centre of mass, axes of the world in the current pose: xx yy zz xy xz yz. Positive definite,
     *  but for axes whose numbers are all 0: it does not turn about these */
    inertia?: ArrayLike<number>;
    /** m, from its position in its own axes */
    centerOfMass?: ArrayLike<number>;
    /** obstacles with the same number, except 0, are parts of one body; each has its whole mass */
    body?: number;
    /** m/s, above 0: maximum speed at which points inside are pushed out. Default 1 */
    pushSpeed?: number;
    /** see the sheet def. Default: all */
    groups?: number;
}

export function defaultObstacleDef(into?: ObstacleDef): ObstacleDef;

/** Pose, motion, and reaction of an obstacle. */
export class ObstacleState {
    position: number[];
    rotation: number[];
    velocity: number[];
    angularVelocity: number[];
    /** N s, N m s about its centre of mass: of sheets and pins in the last tick */
    impulse: number[];
    /** N s, N m s about its centre of mass: of sheets and pins in the last tick */
    angularImpulse: number[];
    /** that pushed in the last tick */
    contacts: number;
}


/** Flags, filter and functions of debug draw. */
export class DebugDraw {
    cookie: number;
    /** KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES */
    flags: DrawFlag;
    /** draws only this one, without obstacles and blades; 0 (default): all */
    sheet: Sheet | null;
    /** m, above 0: length of axes and normals; a plane is 20 times as wide. Default 0.05 */
    size: number;
}
/** What a host gives as DebugDraw: what is left out is as the default has it. */
export interface DebugDrawGiven {
    cookie?: number;
    /** KIRI_DRAW_..., added up; default: all but TRIANGLES and EDGES */
    flags?: DrawFlag;
    /** draws only this one, without obstacles and blades; 0 (default): all */
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

/** Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning. */
export function getVersion(): number;

/** Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning. */
export function getResultName(result: ResultCode): string;

/** Return the version of the library, as KIRI_VERSION; the name of a result, as "KIRI_OK"; a line with its meaning. */
export function getResultText(result: ResultCode): string;

/** Converts microseconds a tick into a budget, at the pace of the profile, which may be a sum of several: half for
 *  cuts, half for motion; all if it has one alone. Limits without recorded work stay. A replay must set the same
 *  budgets. */
export function fitBudget(profile: ProfileGiven, microseconds: number, budget: Budget): ResultCode;

/** Returns the name of a stage; "" for another number. */
export function getStageName(stage: Stage): string;

/** Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_... */
export function getMaterial(preset: MaterialPreset, into?: Material): Material;

/** Get the numbers of a preset: KIRI_MATERIAL_..., KIRI_QUALITY_... */
export function getQuality(preset: QualityPreset, into?: Quality): Quality;

/** Gets a def for kiriCreateRectangle: material, model, skinning, grid, frames and iterations for a kind of sheet and
 *  its sides (m, 1 : 256 at most). Other fields are as kiriDefaultSheetDef has them (manual, accuracy). */
export function getSetup(preset: SetupPreset, width: number, height: number, into?: SheetDef): SheetDef;

/** Fills in the mesh of kiriCreateRectangle: 2 (columns + 1) (rows + 1) floats and 6 columns rows indices. */
export function fillRectangle(width: number, height: number, columns: number, rows: number): { restPositions: Float32Array, indices: Int32Array };

/** Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the sheet
 *  inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another preset. */
export function getTearing(preset: MaterialPreset, into?: Tearing): Tearing;

/** A world, empty at first. Destroy it when it is done with: its memory is not JavaScript's. */
export class World {
    /** def: what differs from defaultWorldDef(). */
    constructor(def?: WorldDefGiven);
    readonly isAlive: boolean;
    /** Frees the world and all that is in it; once is enough. */
    destroy(): void;
    /** For `using world = new World()`. */
    [Symbol.dispose](): void;
    /** Advances by one fixed step of dt seconds (1e-6 to 10), in `substeps` equal parts (1 to 64): takes the pending
     *  cut points, then moves every sheet. KIRI_PENDING: the budget is spent; events name the cuts that still have
     *  work. KIRI_ERROR_MEMORY: cuts and pieces that leave go on in the next tick (manual, budget). KIRI_ERROR_LIMIT:
     *  no ids are left for new frames; nothing moves until some are destroyed. KIRI_DIVERGED: events name sheets that
     *  were stopped. */
    tick(dt: number, substeps: number): ResultCode;
    /** Returns the line of the last function that changes the world, if it failed; else "". Valid until the next one. */
    getLastError(): string;
    /** Moves the origin of the world to a point (m), as large worlds need: subtracts it from all positions. Nothing
     *  wakes. Returned arrays keep the old positions until the next tick. KIRI_ERROR_ARGUMENT: a position would not fit
     *  a float. */
    shiftOrigin(origin: ArrayLike<number>): ResultCode;
    /** Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on. */
    setGravity(gravity: ArrayLike<number>): ResultCode;
    /** Set gravity (m/s^2; all pieces wake), and the budget, from the next tick on. */
    setBudget(budget: BudgetGiven): ResultCode;
    /** Hashes all state that the coming ticks depend on: two worlds with the same hash go on alike (manual, budget). */
    getStateHash(): bigint;
    /** Writes up to `capacity` ids of the world's sheets, in the order of their making; *count is how many there are. */
    getSheets(): Sheet[];
    /** Writes 1 to KIRI_MOST_NOTE_BYTES bytes of the host to the recording, such as pressed keys. A replay stops there. */
    note(bytes: Uint8Array): ResultCode;
    /** Makes the calls of a recording up to the next tick or note, included. The world must be new; hooks stay the
     *  host's. KIRI_PENDING: more calls follow. KIRI_OK: the recording ended. KIRI_ERROR_REPLAY: a call gave another
     *  result, other ids or another state; the line names it, and the next call goes on behind it. KIRI_ERROR_DATA: not
     *  a recording, damaged, cut short, or of another version. KIRI_ERROR_STATE: the world is not new.
     *  KIRI_ERROR_MEMORY: start again. */
    replay(recording: Uint8Array, replay: Replay): ResultCode;
    /** Writes the world to memory with room for `capacity`; bytes null: only counts them. *size: bytes of the save.
     *  KIRI_ERROR_ARGUMENT: `capacity` is less. KIRI_PENDING: a cut is pending (World.finishCuts); *size is 0. */
    save(): Uint8Array;
    /** Finishes the work on cuts at once, whatever the budget is, without moving anything. The next tick reports the
     *  events. Arrays that the world handed out end as with a tick. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: as in
     *  World.tick. */
    finishCuts(): ResultCode;
    /** Replaces the world by a saved one; its own hooks stay. The bytes may come from anybody: a malicious save cannot
     *  crash the program, and takes memory in proportion to its size, which is below 2^31. Old arrays live until the
     *  next tick. On failure nothing has changed: KIRI_ERROR_DATA: not a save, damaged, or of another version.
     *  KIRI_ERROR_MEMORY. */
    load(bytes: Uint8Array): ResultCode;
    /** For rollback: copies all of the world, also work in progress, into memory of the host; much faster than a save,
     *  and exact to the bit. For this process only: never store or send the bytes. bytes null: as of World.save. */
    snapshot(): Uint8Array;
    /** Replaces the world by the world of the snapshot, as World.load does. The bytes are trusted. On failure nothing
     *  has changed: KIRI_ERROR_DATA: no snapshot of this build. KIRI_ERROR_STATE: it is recorded. KIRI_ERROR_MEMORY. */
    restore(bytes: Uint8Array): ResultCode;
    /** Gets the events: *events points to *count of them. */
    getEvents(): Rows<Event>;
    /** Gets the profile of the last tick that was not refused. */
    getProfile(into?: Profile): Profile;
    /** Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
     *  failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def. */
    createSheet(def: SheetDefGiven): Sheet;
    /** Adds a rectangle from (0, 0) to (width, height) of the rest plane, of 2 * columns * rows triangles; columns or
     *  rows 0: as many as fit the grid, 3 for 2 of its squares; at most 4096. The mesh of def is not read; def null:
     *  the defaults. */
    createRectangle(width: number, height: number, columns?: number, rows?: number, def?: SheetDefGiven | null): Sheet;
    /** Adds a sheet with 1 to 65536 folds, copied in order. KIRI_ERROR_ARGUMENT: not KIRI_MODEL_LINKS, or no material
     *  at one. */
    createFoldedSheet(def: SheetDefGiven, folds: FoldGiven[]): Sheet;
    /** Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does
     *  not. */
    raycast(origin: ArrayLike<number>, direction: ArrayLike<number>, maxDistance: number, into?: Hit): { sheet: Sheet | null, hit: Hit };
    /** Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
     *  KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
     *  pending. */
    detachPieces(frames: Frame[]): (Sheet | null)[];
    /** Detach or remove the pieces of `count` frames, of any sheets, in one pass for each sheet: all or none.
     *  KIRI_PENDING: some are pending, all in a sheet together. detached[i]: the sheet made of piece of frames[i], 0:
     *  pending. */
    destroyPieces(frames: Frame[]): ResultCode;
    /** A blade in world space: a knife, a mouse, a finger. It remembers where it is in the material of each layer, and
     *  cuts on from there. Move it once a tick while it is in a sheet. Each layer has a cut (manual, cutting). `sheet`
     *  0: all. */
    beginBlade(sheet?: Sheet | null): Blade;
    /** Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
     *  KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing). */
    createSeam(def: SeamDefGiven): Seam;
    /** Writes up to `capacity` ids of the world's seams; *count is how many there are. */
    getSeams(): Seam[];
    /** Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake. */
    createObstacle(def: ObstacleDefGiven): Obstacle;
    /** Fill the struct with its defaults; draw the world as after the last tick. This only reads, and takes no memory. */
    debugDraw(draw: DebugDrawGiven): ResultCode;
}

export class Sheet {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Fill the def with its defaults, without a mesh; add a sheet, and destroy one with its cuts, frames and pins. On
     *  failure *sheet is 0. KIRI_ERROR_MESH: the triangles form no sheet; the line names them by index in the def. */
    destroy(): ResultCode;
    /** Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not
     *  come from Sheet.getSettings. It wakes if one differs. Motion, stiffness of pins and frames stay. */
    getSettings(into?: SheetSettings): SheetSettings;
    /** Get the current settings, and set all or none, with the checks of kiriCreateSheet. KIRI_ERROR_DEF: they do not
     *  come from Sheet.getSettings. It wakes if one differs. Motion, stiffness of pins and frames stay. */
    setSettings(settings: SheetSettingsGiven): ResultCode;
    /** Adds a fold; its index is the count of folds before. The next ticks make it, on the budget of cuts, until a
     *  KIRI_EVENT_CUT_FINISHED. It moves to its rest angle within fadeTime. Errors as of kiriCreateFoldedSheet. */
    addFold(fold: FoldGiven): number;
    /** A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the
     *  sheet. */
    getFold(index: number, into?: FoldState): FoldState;
    /** A fold by its index; a detached part keeps it. A rest angle drives the fold: small steps. Changes wake the
     *  sheet. */
    setFold(index: number, stiffness: number, restAngle: number): ResultCode;
    /** Gets the arrays, without a copy. */
    getMesh(into?: Mesh): Mesh;
    /** Gets the changes since a revision; the whole mesh if it is 0, too old, or of before a load or restore. */
    getDirty(sinceRevision: number, into?: Dirty): Dirty;
    /** Copies 3 floats each; positions or normals null: none. Strides: 12 bytes or more. KIRI_ERROR_STATE: no normals. */
    copyVertices(first: number, count: number, positions?: Float32Array | null, positionStride?: number, normals?: Float32Array | null, normalStride?: number): ResultCode;
    /** Copies the index that each vertex had when the last tick began, to draw between two ticks; -1: it did not exist.
     *  *from: the sheet that had them then. A vertex that a cut separated has the other's index (manual, drawing). */
    copyPrevious(first: number, count: number): { vertices: Int32Array, from: Sheet };
    /** Copies indices of some triangles as 16-bit numbers, 3 each. KIRI_ERROR_STATE: there are more than 65535
     *  vertices. */
    copyIndices16(firstTriangle: number, count: number): Uint16Array;
    /** Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9
     *  floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes). */
    copySources(firstTriangle: number, count: number): Int32Array;
    /** Map triangles to the def. Sources: the triangle of the def that contains each; -1: it was removed. Weights: 9
     *  floats each, the barycentric coordinates of its three corners there, also beside a welded seam (manual, meshes). */
    copySourceWeights(firstTriangle: number, count: number): Float32Array;
    /** Makes the solid surface, with a thickness in m; thickness 0: the material's. */
    getSolid(thickness?: number, into?: Solid): Solid;
    /** Gets the collision points: 3 floats of position (m, world) a point. */
    getCollisionPoints(): View<Float32Array>;
    /** Get the counts, at no cost; sum the totals over the frames. */
    getCounts(into?: Counts): Counts;
    /** Get the counts, at no cost; sum the totals over the frames. */
    getTotals(into?: Totals): Totals;
    /** Estimates the error of a sheet that rests; 1: too few frames. It allocates. KIRI_ERROR_STATE: not
     *  KIRI_MODEL_LINKS. */
    estimateError(): number;
    /** Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); Sheet.wake wakes all. */
    isAwake(): boolean;
    /** Read and end sleep: *awake is 0 where all pieces sleep (kiriPieceState tells which); Sheet.wake wakes all. */
    wake(): ResultCode;
    /** Teleports the sheet: every point x (m, world) moves to R x + t; velocities turn, and it wakes. A planar sheet
     *  turns about its normal only. Targets of pins and holds move along, but for pins on obstacles (manual, sheets). */
    transform(rotation: ArrayLike<number>, translation: ArrayLike<number>): ResultCode;
    /** Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its
     *  centre of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held
     *  frames stay held. */
    setVelocity(velocity: ArrayLike<number>, angularVelocity: ArrayLike<number>): ResultCode;
    /** Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
     *  piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
     *  both. */
    setUserData(data: number | bigint): ResultCode;
    /** Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
     *  piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
     *  both. */
    getUserData(): bigint;
    /** Find where a ray first meets the sheet, or any (*sheet 0: none), up to maxDistance; hit->triangle -1: it does
     *  not. */
    raycast(origin: ArrayLike<number>, direction: ArrayLike<number>, maxDistance: number, into?: Hit): Hit;
    /** Gets the state of a point. KIRI_ERROR_ARGUMENT: it is outside the sheet. On a cut: on a lip that has the point. */
    getPoint(restPoint: ArrayLike<number>, into?: PointState): PointState;
    /** Gets the shape functions at a rest point: up to `capacity` frames with weights, sum 1, and gradients (2 floats,
     *  1/m; gradients null: none). *count: all. KIRI_ERROR_ARGUMENT: outside the sheet. KIRI_ERROR_STATE: a cut is
     *  pending. */
    getWeights(restPoint: ArrayLike<number>): { frames: Frame[], weights: Float32Array, gradients: Float32Array };
    /** Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index. */
    getPiece(piece: number, into?: PieceState): PieceState;
    /** Get a piece. The first call after a cut sorts the sheet by pieces. KIRI_ERROR_ARGUMENT: no piece has the index. */
    getPieceMesh(piece: number, into?: PieceMesh): PieceMesh;
    /** Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame. */
    getPieceFrames(piece: number): Frame[];
    /** Destroys all pieces below an area (m^2) except the largest that stays, at the cost of one. *count: their number. */
    dropCrumbs(area: number): number;
    /** Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
     *  once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
     *  nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
     *  point (KIRI_EVENT_CUT_FINISHED). */
    beginCut(restPoint: ArrayLike<number>): Cut;
    /** Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
     *  once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
     *  nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
     *  point (KIRI_EVENT_CUT_FINISHED). */
    cut(restPoints: ArrayLike<number>): Cut;
    /** Cuts where the quadrilateral swept by an edge in world space, from blade[0]-blade[1] to blade[3]-blade[2], meets
     *  the current sheet; past borders, so that it separates the parts that it crosses. The cut is already ended. */
    slice(blade: ArrayLike<number>): Cut;
    /** Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the
     *  sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another
     *  preset. */
    setTearing(tearing: TearingGiven): ResultCode;
    /** Get toughness and strength of a material, in orders of magnitude, and 0 for the rest; set them: parts of the
     *  sheet inherit them. KIRI_ERROR_ARGUMENT: a toughness above 0 with a model other than KIRI_MODEL_LINKS, another
     *  preset. */
    getTearing(into?: Tearing): Tearing;
    /** Multiplies the toughness along a polyline in the rest plane (2 floats a point; one point: there) by a factor, 0
     *  or more: below 1 tears follow it, above 1 they stop there. The same points replace it. KIRI_ERROR_ARGUMENT: no
     *  material. */
    setTearLine(restPoints: ArrayLike<number>, factor: number): ResultCode;
    /** Writes up to `capacity` ids of the sheet's frames; *count is how many there are. */
    getFrames(): Frame[];
    /** Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m). */
    applyForce(restPoint: ArrayLike<number>, force: ArrayLike<number>, torque: ArrayLike<number>): ResultCode;
    /** Applies a force (N/m, world) along a straight line of the rest plane where it lies in the material, edges
     *  included. Along a cut each lip gets half. KIRI_ERROR_ARGUMENT: as of Sheet.clampLine. */
    applyLineLoad(from: ArrayLike<number>, to: ArrayLike<number>, forcePerLength: ArrayLike<number>): ResultCode;
    /** Applies a pressure (Pa) to the whole sheet along its normal; below 0: against it. */
    applyPressure(pressure: number): ResultCode;
    /** Applies an impulse (N s, world) at a point of the material on the visible surface, at once, by the mass of the
     *  frames that carry the point; a held frame's share is lost. KIRI_ERROR_ARGUMENT: the point is outside the sheet. */
    applyImpulse(restPoint: ArrayLike<number>, impulse: ArrayLike<number>): ResultCode;
    /** Copies the wind; it blows until the next call. */
    setWind(wind: WindGiven): ResultCode;
    /** Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT:
     *  outside. */
    createPin(def: PinDefGiven): Pin;
    /** Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its
     *  material, as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal,
     *  or far outside. */
    clampLine(from: ArrayLike<number>, to: ArrayLike<number>): Pin;
    /** Hold a straight line of the rest plane, at its rest length. A clamp holds the place and direction of its
     *  material, as a vice does; a hinge only the place (manual, sheets). KIRI_ERROR_ARGUMENT: no material; ends equal,
     *  or far outside. */
    hingeLine(from: ArrayLike<number>, to: ArrayLike<number>): Pin;
    /** Writes up to `capacity` ids of the sheet's pins, of all types; *count is how many there are. */
    getPins(): Pin[];
    /** Sets the contacts of the next tick alone. One with point and obstacle of an earlier one starts with its impulse. */
    setContacts(contacts: ContactGiven[]): ResultCode;
    /** Gets one result for each contact that was set before the last tick, in that order. A sleeping piece presses on. */
    getContactForces(): Rows<ContactForce>;
    /** Gets a box (m, world) around all that the sheet can touch in a tick of dt (s). For moving obstacles add their
     *  way. */
    getReach(dt: number): { lower: Float32Array, upper: Float32Array };
}

export class Cut {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
     *  once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
     *  nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
     *  point (KIRI_EVENT_CUT_FINISHED). */
    extend(restPoints: ArrayLike<number>): ResultCode;
    /** Begin a cut, a polyline in the rest plane; add points (2 floats each; count is 1 to 2^24); end it; or all at
     *  once, from 2 points. Points take effect with the next tick or, by the budget, a later one. Outside the sheet
     *  nothing is cut; an end inside stays closed until the next point. The id is stale after the tick of the last
     *  point (KIRI_EVENT_CUT_FINISHED). */
    end(): ResultCode;
}

export class Frame {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Set rigid motion of a sheet, or of the piece with a frame, until forces change it: `velocity` (m/s) of its
     *  centre of mass, and `angularVelocity` (rad/s) about it. Planar sheets drop motion across their plane; held
     *  frames stay held. */
    setPieceVelocity(velocity: ArrayLike<number>, angularVelocity: ArrayLike<number>): ResultCode;
    /** Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
     *  piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
     *  both. */
    setPieceUserData(data: number | bigint): ResultCode;
    /** Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
     *  piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
     *  both. */
    getPieceUserData(): bigint;
    /** Get the frames of a piece (*frames points to *count ids), and the current index of the piece with a frame. */
    getPiece(): number;
    /** Makes a sheet of the piece with this frame. All of the piece moves along, with ids and states; cuts stay with
     *  the old sheet. A clamp or hinge that holds both gets a copy with a new id. KIRI_PENDING: work on a cut is
     *  pending, or the budget lacks samples for the piece; *detached is 0, further cuts of the sheet wait, and
     *  KIRI_EVENT_PIECE_DETACHED names the sheet in a later tick. KIRI_ERROR_STATE: nothing would be left of the sheet
     *  (manual, cutting). */
    detachPiece(): Sheet | null;
    /** Removes the piece with this frame at once, with its pins. KIRI_PENDING: while a cut is pending its triangles
     *  stay with three equal corners, and kiriCounts counts it, with a state of zeros. KIRI_ERROR_STATE: it is all of
     *  its sheet. */
    destroyPiece(): ResultCode;
    /** Holds the frame: its rest point moves evenly to `position` (m, world) with `rotation` (columns as above) in the
     *  next tick; position and rotation null: frees it. Material that held frames mostly carry moves through obstacles. */
    hold(position?: ArrayLike<number> | null, rotation?: ArrayLike<number> | null): ResultCode;
    /** Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
     *  over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free
     *  frame. */
    getState(into?: FrameState): FrameState;
    /** Get the state; force (N, world) and torque (N m, about the rest point) that the hold applied to the sheet: means
     *  over the last tick that moved the piece, with the frame's own weight and change of momentum. Zero for a free
     *  frame. */
    getReaction(): { force: Float64Array, torque: Float64Array };
    /** Apply a force (N, world) at the frame's centre of mass, or at a point of the material, and a torque (N m). */
    applyForce(force: ArrayLike<number>, torque: ArrayLike<number>): ResultCode;
}

export class Pin {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
     *  piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
     *  both. */
    setUserData(data: number | bigint): ResultCode;
    /** Store a number of the host, 0 at first. No tick and no state hash depends on it. A sheet has one, a pin, and a
     *  piece, named by any of its frames: parts of a piece that is cut inherit it, and a sheet that is made of it has
     *  both. */
    getUserData(): bigint;
    /** Fill the def with its defaults; pin a point; destroy any pin. On failure *pin is 0. KIRI_ERROR_ARGUMENT:
     *  outside. */
    destroy(): ResultCode;
    /** Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's
     *  material (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and
     *  later. The pin moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a
     *  point. */
    setTarget(target: ArrayLike<number>): ResultCode;
    /** Set the target of the pin's point, or of the middle of its line (m, world), and the rotation of a line's
     *  material (columns: directions of u, v, normal; planar: about the normal), for the end of the next tick and
     *  later. The pin moves there evenly. It is drawn at its pin (manual, sheets). SetPose, KIRI_ERROR_ARGUMENT: a
     *  point. */
    setPose(target: ArrayLike<number>, rotation: ArrayLike<number>): ResultCode;
    /** Sets the force (N) that breaks a pin of any type; 0: it never breaks. */
    setBreakForce(breakForce: number): ResultCode;
    /** Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved
     *  it. */
    getState(into?: PinState): PinState;
    /** Get the state; force (N) and torque (N m, about the target) on the sheet: means over the last tick that moved
     *  it. */
    getReaction(): { force: Float64Array, torque: Float64Array };
}

export class Obstacle {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Fill the def with its defaults; add and destroy an obstacle. On failure *obstacle is 0. Pieces on it wake. */
    destroy(): ResultCode;
    /** Teleports the obstacle (m, world). Sheets react to its velocity (Obstacle.setVelocity), not to the jump. */
    setPose(position: ArrayLike<number>, rotation: ArrayLike<number>): ResultCode;
    /** Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
     *  mass. */
    setVelocity(velocity: ArrayLike<number>, angularVelocity: ArrayLike<number>): ResultCode;
    /** Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
     *  mass. */
    setSurfaceVelocity(velocity: ArrayLike<number>): ResultCode;
    /** Set the velocity (m/s, rad/s), and the surface's, for all coming ticks; or mass (kg), inertia and centre of
     *  mass. */
    setMass(mass: number, inertia: ArrayLike<number>, centerOfMass: ArrayLike<number>): ResultCode;
    /** Gets the current state. */
    getState(into?: ObstacleState): ObstacleState;
}

export class Blade {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
     *  casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts
     *  stay. */
    moveEdge(from: ArrayLike<number>, to: ArrayLike<number>): ResultCode;
    /** Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
     *  casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts
     *  stay. */
    moveRay(origin: ArrayLike<number>, direction: ArrayLike<number>, length: number): ResultCode;
    /** Move the blade to the straight edge between two points (m, world), or `length` m along a ray that a camera
     *  casts; each end goes straight. The first call only places it. An end inside cuts along its own way. End it: cuts
     *  stay. */
    end(): ResultCode;
}

export class Seam {
    readonly world: World;
    /** Two that are the same have the same id. */
    readonly id: number;
    /** Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
     *  KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing). */
    destroy(): ResultCode;
    /** Fill the def with its defaults; create and destroy a seam; set stiffness and restAngle. On failure *seam is 0.
     *  KIRI_ERROR_ARGUMENT: a line is empty or leaves the material; a sheet is planar; models differ (manual, sewing). */
    setHinge(stiffness: number, restAngle: number): ResultCode;
    /** Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index. */
    getStitch(index: number, into?: Stitch): Stitch;
    /** Get a stitch that is left, in the order of the lines, and their number. KIRI_ERROR_ARGUMENT: no such index. */
    getCount(): number;
}
