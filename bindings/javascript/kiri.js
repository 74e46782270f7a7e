// Made from include/kiri/kiri.h by bindings/generator/to_javascript.py. Do not edit.

import {
    F32, F64, I32, KiriError, Rows, Shown, Thing, U32, U64, U8, View, WorldBase, copy, enumeration, fail, fill, idOf, int64,
    known, load, pointer, put, putRows, release, scatter, scratch, setDraw, string, take, thing, wasm,
} from "./runtime.js";

export { KiriError, Rows, View, load, wasm };

/** Of the header that this file is made from. */
export const VERSION = "0.34.0";

export const ResultCode = enumeration({ Ok: 0, Pending: 1, ErrorArgument: -1, ErrorDef: -2, ErrorId: -3, ErrorMesh:
    -4, ErrorState: -5, ErrorMemory: -6, Diverged: -7, ErrorLimit: -8, ErrorBuild: -9, ErrorData: -10, ErrorReplay:
    -11 });
export const LEAST_TRIANGLES = 16;
export const MOST_NOTE_BYTES = 1048576;
export const EventType = enumeration({ CutFinished: 1, PieceOff: 2, FrameAdded: 3, Diverged: 4, Deferred: 5, PinBroke:
    6, PieceDetached: 7, SeamBroke: 8, TearBegan: 9, TearEnded: 10, Strained: 11 });
export const Stage = enumeration({ Cut: 0, Grid: 1, Regions: 2, Shape: 3, Samples: 4, Constants: 5, Contact: 6, Solve:
    7, Skin: 8, Count: 9 });
export const MaterialPreset = enumeration({ Paper: 0, Cotton: 1, Rubber: 2, Foil: 3, Card: 4, Silk: 5, Shirting: 6,
    Wool: 7, Denim: 8, Jersey: 9, Count: 10 });
export const QualityPreset = enumeration({ Fast: 0, Balanced: 1, Accurate: 2, Count: 3 });
export const SetupPreset = enumeration({ Curtain: 0, Paper: 1, Flag: 2, Ribbon: 3, Rubber: 4, Card: 5, Foil: 6, Count:
    7 });
export const Model = enumeration({ Links: 0, Affine: 1, Points: 2 });
export const Skinning = enumeration({ Linear: 0, Smooth: 1 });
export const TimeStepping = enumeration({ SecondOrder: 0, Euler: 1 });
export const PinType = enumeration({ Point: 0, Hinge: 1, Clamp: 2 });
export const ObstacleType = enumeration({ Plane: 0, Sphere: 1, Capsule: 2, Box: 3, Cylinder: 4, Prism: 5 });
export const DrawFlag = enumeration({ Triangles: 1, Edges: 2, Borders: 4, Frames: 8, Links: 16, Pins: 32, Contacts:
    64, Blades: 128, Boxes: 256, Obstacles: 512, Points: 1024, All: 2047 });

function things(Class, world, at, count) {
    return Array.from(U32.subarray(at >> 2, (at >> 2) + count), (id) => thing(Class, world, id));
}

function bytesAt(at, count) {
    return at ? U8.slice(at, at + count) : null;
}

/** Bytes of structs in the memory of WebAssembly, and where their fields are: for calls of `wasm`. */
export const layouts = {
    kiriBudget: { size: 16, fields: { triangles: 0, cells: 4, samples: 8, iterations: 12 } },
    kiriWorldDef: { size: 72, fields: { cookie: 0, gravity: 4, budget: 16, alloc: 32, free: 36, log: 40, clock: 44,
        startTask: 48, finishTask: 52, workerCount: 56, user: 60, record: 64, recordHashTicks: 68 } },
    kiriReplay: { size: 32, fields: { offset: 0, calls: 8, ticks: 16, note: 24, noteCount: 28 } },
    kiriEvent: { size: 44, fields: { type: 0, sheet: 4, cut: 8, frame: 12, pin: 16, crumb: 20, area: 24, stage: 28,
        waiting: 32, seam: 36, stitches: 40 } },
    kiriProfile: { size: 144, fields: { seconds: 0, cutSegments: 72, trianglesSplit: 76, cellsSettled: 80,
        samplesRefreshed: 84, solverIterations: 88, cellsChanged: 92, weightsChanged: 96, verticesChanged: 100,
        pointsChanged: 104, linksChanged: 108, commits: 112, systemsSolved: 116, contacts: 120, sheetPairs: 124,
        largestJump: 128, largestFade: 136 } },
    kiriMaterial: { size: 52, fields: { youngsModulus: 0, poissonsRatio: 4, thickness: 8, density: 12, airDamping: 16,
        flexDamping: 20, yieldStress: 24, hardening: 28, slack: 32, detail: 36, restCurvature: 40 } },
    kiriQuality: { size: 16, fields: { framesAlong: 0, gridResolution: 4, iterations: 8, substeps: 12 } },
    kiriPaperOptions: { size: 20, fields: { fromScratch: 0, popping: 4, linearWeights: 8, integrationPoints: 12,
        integrationOrder: 16 } },
    kiriSheetDef: { size: 240, fields: { cookie: 0, restPositions: 4, vertexCount: 8, indices: 12, triangleCount: 16,
        position: 20, axisU: 32, axisV: 44, velocity: 56, material: 68, gridResolution: 120, snapDistance: 124,
        weldDistance: 128, frameCount: 132, frameLength: 136, accuracy: 140, framePoints: 144, maxFrames: 148,
        rigidWeight: 152, rigidArea: 156, crumbArea: 160, friction: 164, contactThickness: 168, groups: 172,
        touchesSheets: 176, selfContact: 180, collisionPoints: 184, iterations: 188, sleepSpeed: 192, model: 196,
        skinning: 200, planar: 204, timeStepping: 208, fadeTime: 212, normals: 216, paper: 220 } },
    kiriSheetSettings: { size: 108, fields: { cookie: 0, material: 4, maxFrames: 56, crumbArea: 60, friction: 64,
        contactThickness: 68, groups: 72, touchesSheets: 76, selfContact: 80, iterations: 84, sleepSpeed: 88,
        skinning: 92, timeStepping: 96, fadeTime: 100, normals: 104 } },
    kiriFold: { size: 28, fields: { from: 0, to: 8, stiffness: 16, restAngle: 20, yieldMoment: 24 } },
    kiriFoldState: { size: 48, fields: { fold: 0, angle: 32, length: 40 } },
    kiriMesh: { size: 36, fields: { positions: 0, normals: 4, restPositions: 8, indices: 12, sourceTriangles: 16,
        sourceWeights: 20, vertexCount: 24, triangleCount: 28, revision: 32 } },
    kiriRange: { size: 8, fields: { first: 0, count: 4 } },
    kiriDirty: { size: 36, fields: { newVertices: 0, newTriangles: 8, oldVertices: 16, oldTriangles: 24, revision: 32
        } },
    kiriSolid: { size: 32, fields: { positions: 0, normals: 4, restPositions: 8, indices: 12, sources: 16,
        vertexCount: 20, triangleCount: 24, rimTriangle: 28 } },
    kiriCounts: { size: 28, fields: { vertices: 0, triangles: 4, cells: 8, frames: 12, links: 16, pieces: 20,
        collisionPoints: 24 } },
    kiriTotals: { size: 104, fields: { area: 0, mass: 8, kineticEnergy: 16, elasticEnergy: 24, center: 32, momentum:
        56, angularMomentum: 80 } },
    kiriHit: { size: 40, fields: { restPoint: 0, position: 8, normal: 20, distance: 32, triangle: 36 } },
    kiriPointState: { size: 40, fields: { position: 0, normal: 12, velocity: 24, frame: 36 } },
    kiriPieceState: { size: 136, fields: { area: 0, mass: 8, center: 16, momentum: 40, angularMomentum: 64, lower: 88,
        upper: 100, frames: 112, vertices: 116, triangles: 120, collisionPoints: 124, crumb: 128, asleep: 132 } },
    kiriPieceMesh: { size: 28, fields: { vertices: 0, triangles: 4, indices: 8, collisionPoints: 12, vertexCount: 16,
        triangleCount: 20, collisionPointCount: 24 } },
    kiriTearing: { size: 28, fields: { toughness: 0, strength: 4, grain: 8, grainRatio: 16, maxSpeed: 20, maxTips: 24
        } },
    kiriFrameState: { size: 92, fields: { restPoint: 0, position: 8, rotation: 20, velocity: 56, angularVelocity: 68,
        area: 80, mass: 84, held: 88 } },
    kiriWind: { size: 24, fields: { velocity: 0, density: 12, drag: 16, lift: 20 } },
    kiriPinDef: { size: 36, fields: { cookie: 0, restPoint: 4, target: 12, stiffness: 24, breakForce: 28, obstacle: 32
        } },
    kiriPinState: { size: 80, fields: { type: 0, sheet: 4, from: 8, to: 16, target: 24, rotation: 36, breakForce: 72,
        obstacle: 76 } },
    kiriSeamDef: { size: 44, fields: { cookie: 0, sheetA: 4, sheetB: 8, lineA: 12, lineB: 16, countA: 20, countB: 24,
        stitches: 28, stiffness: 32, restAngle: 36, breakForce: 40 } },
    kiriStitch: { size: 56, fields: { sheetA: 0, sheetB: 4, restA: 8, restB: 16, position: 24, gap: 36, force: 40,
        angle: 52 } },
    kiriContact: { size: 56, fields: { point: 0, restPoint: 4, normal: 12, offset: 24, velocity: 28, friction: 40,
        inverseMass: 44, pushSpeed: 48, obstacle: 52 } },
    kiriContactForce: { size: 64, fields: { impulse: 0, position: 24, depth: 48, point: 56, obstacle: 60 } },
    kiriObstacleDef: { size: 180, fields: { cookie: 0, type: 4, size: 8, radius: 20, height: 24, outline: 28,
        outlineCount: 32, rounding: 36, position: 40, rotation: 52, velocity: 88, angularVelocity: 100,
        surfaceVelocity: 112, friction: 124, mass: 128, inertia: 132, centerOfMass: 156, body: 168, pushSpeed: 172,
        groups: 176 } },
    kiriObstacleState: { size: 128, fields: { position: 0, rotation: 12, velocity: 48, angularVelocity: 60, impulse:
        72, angularImpulse: 96, contacts: 120 } },
    kiriDrawVertex: { size: 16, fields: { position: 0, color: 12 } },
    kiriDebugDraw: { size: 32, fields: { cookie: 0, flags: 4, sheet: 8, size: 12, points: 16, lines: 20, triangles:
        24, user: 28 } },
};

export class Budget {
    triangles = 0;
    cells = 0;
    samples = 0;
    iterations = 0;
}

function readBudget(o, at, world) {
    o.triangles = I32[(at) >> 2];
    o.cells = I32[(at + 4) >> 2];
    o.samples = I32[(at + 8) >> 2];
    o.iterations = I32[(at + 12) >> 2];
    return o;
}

const fieldsOfBudget = new Set(["triangles", "cells", "samples", "iterations"]);

function writeBudget(o, at, world) {
    known(o, fieldsOfBudget, "Budget");
    if (o.triangles !== undefined) {
        I32[(at) >> 2] = o.triangles;
    }
    if (o.cells !== undefined) {
        I32[(at + 4) >> 2] = o.cells;
    }
    if (o.samples !== undefined) {
        I32[(at + 8) >> 2] = o.samples;
    }
    if (o.iterations !== undefined) {
        I32[(at + 12) >> 2] = o.iterations;
    }
}

export class WorldDef {
    cookie = 0;
    gravity = [0, 0, 0];
    budget = new Budget();
    recordHashTicks = 0;
}

function readWorldDef(o, at, world) {
    o.cookie = U32[(at) >> 2];
    fill(F32, (at + 4) >> 2, o.gravity);
    readBudget(o.budget, at + 16, world);
    o.recordHashTicks = I32[(at + 68) >> 2];
    return o;
}

const fieldsOfWorldDef = new Set(["cookie", "gravity", "budget", "recordHashTicks", "log", "clock", "record"]);

function writeWorldDef(o, at, world) {
    known(o, fieldsOfWorldDef, "WorldDef");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.gravity !== undefined) {
        put("Float32Array", at + 4, o.gravity, 3, "gravity");
    }
    if (o.budget !== undefined) {
        writeBudget(o.budget, at + 16, world);
    }
    if (o.recordHashTicks !== undefined) {
        I32[(at + 68) >> 2] = o.recordHashTicks;
    }
}

export class Replay {
    offset = 0;
    calls = 0;
    ticks = 0;
    note = null;
    noteCount = 0;
}

function readReplay(o, at, world) {
    o.offset = int64(at);
    o.calls = int64(at + 8);
    o.ticks = int64(at + 16);
    o.note = bytesAt(U32[(at + 24) >> 2], I32[(at + 28) >> 2]);
    o.noteCount = I32[(at + 28) >> 2];
    return o;
}

const fieldsOfReplay = new Set(["offset", "calls", "ticks", "note", "noteCount"]);

function writeReplay(o, at, world) {
    known(o, fieldsOfReplay, "Replay");
    if (o.offset !== undefined) {
        U64[(at) >> 3] = BigInt(o.offset);
    }
    if (o.calls !== undefined) {
        U64[(at + 8) >> 3] = BigInt(o.calls);
    }
    if (o.ticks !== undefined) {
        U64[(at + 16) >> 3] = BigInt(o.ticks);
    }
}

export class Event {
    type = 0;
    sheet = null;
    cut = null;
    frame = null;
    pin = null;
    crumb = false;
    area = 0;
    stage = 0;
    waiting = 0;
    seam = null;
    stitches = 0;
}

function readEvent(o, at, world) {
    o.type = I32[(at) >> 2];
    o.sheet = thing(Sheet, world, U32[(at + 4) >> 2], o.sheet);
    o.cut = thing(Cut, world, U32[(at + 8) >> 2], o.cut);
    o.frame = thing(Frame, world, U32[(at + 12) >> 2], o.frame);
    o.pin = thing(Pin, world, U32[(at + 16) >> 2], o.pin);
    o.crumb = I32[(at + 20) >> 2] !== 0;
    o.area = F32[(at + 24) >> 2];
    o.stage = I32[(at + 28) >> 2];
    o.waiting = I32[(at + 32) >> 2];
    o.seam = thing(Seam, world, U32[(at + 36) >> 2], o.seam);
    o.stitches = I32[(at + 40) >> 2];
    return o;
}

export class Profile {
    seconds = [0, 0, 0, 0, 0, 0, 0, 0, 0];
    cutSegments = 0;
    trianglesSplit = 0;
    cellsSettled = 0;
    samplesRefreshed = 0;
    solverIterations = 0;
    cellsChanged = 0;
    weightsChanged = 0;
    verticesChanged = 0;
    pointsChanged = 0;
    linksChanged = 0;
    commits = 0;
    systemsSolved = 0;
    contacts = 0;
    sheetPairs = 0;
    largestJump = 0;
    largestFade = 0;
}

function readProfile(o, at, world) {
    fill(F64, (at) >> 3, o.seconds);
    o.cutSegments = I32[(at + 72) >> 2];
    o.trianglesSplit = I32[(at + 76) >> 2];
    o.cellsSettled = I32[(at + 80) >> 2];
    o.samplesRefreshed = I32[(at + 84) >> 2];
    o.solverIterations = I32[(at + 88) >> 2];
    o.cellsChanged = I32[(at + 92) >> 2];
    o.weightsChanged = I32[(at + 96) >> 2];
    o.verticesChanged = I32[(at + 100) >> 2];
    o.pointsChanged = I32[(at + 104) >> 2];
    o.linksChanged = I32[(at + 108) >> 2];
    o.commits = I32[(at + 112) >> 2];
    o.systemsSolved = I32[(at + 116) >> 2];
    o.contacts = I32[(at + 120) >> 2];
    o.sheetPairs = I32[(at + 124) >> 2];
    o.largestJump = F64[(at + 128) >> 3];
    o.largestFade = F64[(at + 136) >> 3];
    return o;
}

const fieldsOfProfile = new Set(["seconds", "cutSegments", "trianglesSplit", "cellsSettled", "samplesRefreshed",
    "solverIterations", "cellsChanged", "weightsChanged", "verticesChanged", "pointsChanged", "linksChanged",
    "commits", "systemsSolved", "contacts", "sheetPairs", "largestJump", "largestFade"]);

function writeProfile(o, at, world) {
    known(o, fieldsOfProfile, "Profile");
    if (o.seconds !== undefined) {
        put("Float64Array", at, o.seconds, 9, "seconds");
    }
    if (o.cutSegments !== undefined) {
        I32[(at + 72) >> 2] = o.cutSegments;
    }
    if (o.trianglesSplit !== undefined) {
        I32[(at + 76) >> 2] = o.trianglesSplit;
    }
    if (o.cellsSettled !== undefined) {
        I32[(at + 80) >> 2] = o.cellsSettled;
    }
    if (o.samplesRefreshed !== undefined) {
        I32[(at + 84) >> 2] = o.samplesRefreshed;
    }
    if (o.solverIterations !== undefined) {
        I32[(at + 88) >> 2] = o.solverIterations;
    }
    if (o.cellsChanged !== undefined) {
        I32[(at + 92) >> 2] = o.cellsChanged;
    }
    if (o.weightsChanged !== undefined) {
        I32[(at + 96) >> 2] = o.weightsChanged;
    }
    if (o.verticesChanged !== undefined) {
        I32[(at + 100) >> 2] = o.verticesChanged;
    }
    if (o.pointsChanged !== undefined) {
        I32[(at + 104) >> 2] = o.pointsChanged;
    }
    if (o.linksChanged !== undefined) {
        I32[(at + 108) >> 2] = o.linksChanged;
    }
    if (o.commits !== undefined) {
        I32[(at + 112) >> 2] = o.commits;
    }
    if (o.systemsSolved !== undefined) {
        I32[(at + 116) >> 2] = o.systemsSolved;
    }
    if (o.contacts !== undefined) {
        I32[(at + 120) >> 2] = o.contacts;
    }
    if (o.sheetPairs !== undefined) {
        I32[(at + 124) >> 2] = o.sheetPairs;
    }
    if (o.largestJump !== undefined) {
        F64[(at + 128) >> 3] = o.largestJump;
    }
    if (o.largestFade !== undefined) {
        F64[(at + 136) >> 3] = o.largestFade;
    }
}

export class Material {
    youngsModulus = 0;
    poissonsRatio = 0;
    thickness = 0;
    density = 0;
    airDamping = 0;
    flexDamping = 0;
    yieldStress = 0;
    hardening = 0;
    slack = 0;
    detail = 0;
    restCurvature = [0, 0, 0];
}

function readMaterial(o, at, world) {
    o.youngsModulus = F32[(at) >> 2];
    o.poissonsRatio = F32[(at + 4) >> 2];
    o.thickness = F32[(at + 8) >> 2];
    o.density = F32[(at + 12) >> 2];
    o.airDamping = F32[(at + 16) >> 2];
    o.flexDamping = F32[(at + 20) >> 2];
    o.yieldStress = F32[(at + 24) >> 2];
    o.hardening = F32[(at + 28) >> 2];
    o.slack = F32[(at + 32) >> 2];
    o.detail = I32[(at + 36) >> 2];
    fill(F32, (at + 40) >> 2, o.restCurvature);
    return o;
}

const fieldsOfMaterial = new Set(["youngsModulus", "poissonsRatio", "thickness", "density", "airDamping",
    "flexDamping", "yieldStress", "hardening", "slack", "detail", "restCurvature"]);

function writeMaterial(o, at, world) {
    known(o, fieldsOfMaterial, "Material");
    if (o.youngsModulus !== undefined) {
        F32[(at) >> 2] = o.youngsModulus;
    }
    if (o.poissonsRatio !== undefined) {
        F32[(at + 4) >> 2] = o.poissonsRatio;
    }
    if (o.thickness !== undefined) {
        F32[(at + 8) >> 2] = o.thickness;
    }
    if (o.density !== undefined) {
        F32[(at + 12) >> 2] = o.density;
    }
    if (o.airDamping !== undefined) {
        F32[(at + 16) >> 2] = o.airDamping;
    }
    if (o.flexDamping !== undefined) {
        F32[(at + 20) >> 2] = o.flexDamping;
    }
    if (o.yieldStress !== undefined) {
        F32[(at + 24) >> 2] = o.yieldStress;
    }
    if (o.hardening !== undefined) {
        F32[(at + 28) >> 2] = o.hardening;
    }
    if (o.slack !== undefined) {
        F32[(at + 32) >> 2] = o.slack;
    }
    if (o.detail !== undefined) {
        I32[(at + 36) >> 2] = o.detail;
    }
    if (o.restCurvature !== undefined) {
        put("Float32Array", at + 40, o.restCurvature, 3, "restCurvature");
    }
}

export class Quality {
    framesAlong = 0;
    gridResolution = 0;
    iterations = 0;
    substeps = 0;
}

function readQuality(o, at, world) {
    o.framesAlong = I32[(at) >> 2];
    o.gridResolution = I32[(at + 4) >> 2];
    o.iterations = I32[(at + 8) >> 2];
    o.substeps = I32[(at + 12) >> 2];
    return o;
}

export class PaperOptions {
    fromScratch = false;
    popping = false;
    linearWeights = false;
    integrationPoints = 0;
    integrationOrder = 0;
}

function readPaperOptions(o, at, world) {
    o.fromScratch = I32[(at) >> 2] !== 0;
    o.popping = I32[(at + 4) >> 2] !== 0;
    o.linearWeights = I32[(at + 8) >> 2] !== 0;
    o.integrationPoints = I32[(at + 12) >> 2];
    o.integrationOrder = I32[(at + 16) >> 2];
    return o;
}

const fieldsOfPaperOptions = new Set(["fromScratch", "popping", "linearWeights", "integrationPoints",
    "integrationOrder"]);

function writePaperOptions(o, at, world) {
    known(o, fieldsOfPaperOptions, "PaperOptions");
    if (o.fromScratch !== undefined) {
        I32[(at) >> 2] = o.fromScratch;
    }
    if (o.popping !== undefined) {
        I32[(at + 4) >> 2] = o.popping;
    }
    if (o.linearWeights !== undefined) {
        I32[(at + 8) >> 2] = o.linearWeights;
    }
    if (o.integrationPoints !== undefined) {
        I32[(at + 12) >> 2] = o.integrationPoints;
    }
    if (o.integrationOrder !== undefined) {
        I32[(at + 16) >> 2] = o.integrationOrder;
    }
}

export class SheetDef {
    cookie = 0;
    restPositions = null;
    vertexCount = 0;
    indices = null;
    triangleCount = 0;
    position = [0, 0, 0];
    axisU = [0, 0, 0];
    axisV = [0, 0, 0];
    velocity = [0, 0, 0];
    material = new Material();
    gridResolution = 0;
    snapDistance = 0;
    weldDistance = 0;
    frameCount = 0;
    frameLength = 0;
    accuracy = 0;
    framePoints = null;
    maxFrames = 0;
    rigidWeight = 0;
    rigidArea = 0;
    crumbArea = 0;
    friction = 0;
    contactThickness = 0;
    groups = 0;
    touchesSheets = false;
    selfContact = false;
    collisionPoints = 0;
    iterations = 0;
    sleepSpeed = 0;
    model = 0;
    skinning = 0;
    planar = false;
    timeStepping = 0;
    fadeTime = 0;
    normals = false;
    paper = new PaperOptions();
}

function readSheetDef(o, at, world) {
    o.cookie = U32[(at) >> 2];
    o.restPositions = null;
    o.vertexCount = I32[(at + 8) >> 2];
    o.indices = null;
    o.triangleCount = I32[(at + 16) >> 2];
    fill(F32, (at + 20) >> 2, o.position);
    fill(F32, (at + 32) >> 2, o.axisU);
    fill(F32, (at + 44) >> 2, o.axisV);
    fill(F32, (at + 56) >> 2, o.velocity);
    readMaterial(o.material, at + 68, world);
    o.gridResolution = I32[(at + 120) >> 2];
    o.snapDistance = F32[(at + 124) >> 2];
    o.weldDistance = F32[(at + 128) >> 2];
    o.frameCount = I32[(at + 132) >> 2];
    o.frameLength = F32[(at + 136) >> 2];
    o.accuracy = F32[(at + 140) >> 2];
    o.framePoints = null;
    o.maxFrames = I32[(at + 148) >> 2];
    o.rigidWeight = F32[(at + 152) >> 2];
    o.rigidArea = F32[(at + 156) >> 2];
    o.crumbArea = F32[(at + 160) >> 2];
    o.friction = F32[(at + 164) >> 2];
    o.contactThickness = F32[(at + 168) >> 2];
    o.groups = U32[(at + 172) >> 2];
    o.touchesSheets = I32[(at + 176) >> 2] !== 0;
    o.selfContact = I32[(at + 180) >> 2] !== 0;
    o.collisionPoints = I32[(at + 184) >> 2];
    o.iterations = I32[(at + 188) >> 2];
    o.sleepSpeed = F32[(at + 192) >> 2];
    o.model = I32[(at + 196) >> 2];
    o.skinning = I32[(at + 200) >> 2];
    o.planar = I32[(at + 204) >> 2] !== 0;
    o.timeStepping = I32[(at + 208) >> 2];
    o.fadeTime = F32[(at + 212) >> 2];
    o.normals = I32[(at + 216) >> 2] !== 0;
    readPaperOptions(o.paper, at + 220, world);
    return o;
}

const fieldsOfSheetDef = new Set(["cookie", "restPositions", "vertexCount", "indices", "triangleCount", "position",
    "axisU", "axisV", "velocity", "material", "gridResolution", "snapDistance", "weldDistance", "frameCount",
    "frameLength", "accuracy", "framePoints", "maxFrames", "rigidWeight", "rigidArea", "crumbArea", "friction",
    "contactThickness", "groups", "touchesSheets", "selfContact", "collisionPoints", "iterations", "sleepSpeed",
    "model", "skinning", "planar", "timeStepping", "fadeTime", "normals", "paper"]);

function writeSheetDef(o, at, world) {
    known(o, fieldsOfSheetDef, "SheetDef");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.restPositions != null) {
        U32[(at + 4) >> 2] = putRows("Float32Array", o.restPositions, 2, "restPositions");
        I32[(at + 8) >> 2] = o.restPositions.length / 2;
    }
    if (o.indices != null) {
        U32[(at + 12) >> 2] = putRows("Int32Array", o.indices, 3, "indices");
        I32[(at + 16) >> 2] = o.indices.length / 3;
    }
    if (o.position !== undefined) {
        put("Float32Array", at + 20, o.position, 3, "position");
    }
    if (o.axisU !== undefined) {
        put("Float32Array", at + 32, o.axisU, 3, "axisU");
    }
    if (o.axisV !== undefined) {
        put("Float32Array", at + 44, o.axisV, 3, "axisV");
    }
    if (o.velocity !== undefined) {
        put("Float32Array", at + 56, o.velocity, 3, "velocity");
    }
    if (o.material !== undefined) {
        writeMaterial(o.material, at + 68, world);
    }
    if (o.gridResolution !== undefined) {
        I32[(at + 120) >> 2] = o.gridResolution;
    }
    if (o.snapDistance !== undefined) {
        F32[(at + 124) >> 2] = o.snapDistance;
    }
    if (o.weldDistance !== undefined) {
        F32[(at + 128) >> 2] = o.weldDistance;
    }
    if (o.frameCount !== undefined) {
        I32[(at + 132) >> 2] = o.frameCount;
    }
    if (o.frameLength !== undefined) {
        F32[(at + 136) >> 2] = o.frameLength;
    }
    if (o.accuracy !== undefined) {
        F32[(at + 140) >> 2] = o.accuracy;
    }
    if (o.framePoints != null) {
        U32[(at + 144) >> 2] = putRows("Float32Array", o.framePoints, 2, "framePoints");
        I32[(at + 132) >> 2] = o.framePoints.length / 2;
    }
    if (o.maxFrames !== undefined) {
        I32[(at + 148) >> 2] = o.maxFrames;
    }
    if (o.rigidWeight !== undefined) {
        F32[(at + 152) >> 2] = o.rigidWeight;
    }
    if (o.rigidArea !== undefined) {
        F32[(at + 156) >> 2] = o.rigidArea;
    }
    if (o.crumbArea !== undefined) {
        F32[(at + 160) >> 2] = o.crumbArea;
    }
    if (o.friction !== undefined) {
        F32[(at + 164) >> 2] = o.friction;
    }
    if (o.contactThickness !== undefined) {
        F32[(at + 168) >> 2] = o.contactThickness;
    }
    if (o.groups !== undefined) {
        U32[(at + 172) >> 2] = o.groups;
    }
    if (o.touchesSheets !== undefined) {
        I32[(at + 176) >> 2] = o.touchesSheets;
    }
    if (o.selfContact !== undefined) {
        I32[(at + 180) >> 2] = o.selfContact;
    }
    if (o.collisionPoints !== undefined) {
        I32[(at + 184) >> 2] = o.collisionPoints;
    }
    if (o.iterations !== undefined) {
        I32[(at + 188) >> 2] = o.iterations;
    }
    if (o.sleepSpeed !== undefined) {
        F32[(at + 192) >> 2] = o.sleepSpeed;
    }
    if (o.model !== undefined) {
        I32[(at + 196) >> 2] = o.model;
    }
    if (o.skinning !== undefined) {
        I32[(at + 200) >> 2] = o.skinning;
    }
    if (o.planar !== undefined) {
        I32[(at + 204) >> 2] = o.planar;
    }
    if (o.timeStepping !== undefined) {
        I32[(at + 208) >> 2] = o.timeStepping;
    }
    if (o.fadeTime !== undefined) {
        F32[(at + 212) >> 2] = o.fadeTime;
    }
    if (o.normals !== undefined) {
        I32[(at + 216) >> 2] = o.normals;
    }
    if (o.paper !== undefined) {
        writePaperOptions(o.paper, at + 220, world);
    }
}

export class SheetSettings {
    cookie = 0;
    material = new Material();
    maxFrames = 0;
    crumbArea = 0;
    friction = 0;
    contactThickness = 0;
    groups = 0;
    touchesSheets = false;
    selfContact = false;
    iterations = 0;
    sleepSpeed = 0;
    skinning = 0;
    timeStepping = 0;
    fadeTime = 0;
    normals = false;
}

function readSheetSettings(o, at, world) {
    o.cookie = U32[(at) >> 2];
    readMaterial(o.material, at + 4, world);
    o.maxFrames = I32[(at + 56) >> 2];
    o.crumbArea = F32[(at + 60) >> 2];
    o.friction = F32[(at + 64) >> 2];
    o.contactThickness = F32[(at + 68) >> 2];
    o.groups = U32[(at + 72) >> 2];
    o.touchesSheets = I32[(at + 76) >> 2] !== 0;
    o.selfContact = I32[(at + 80) >> 2] !== 0;
    o.iterations = I32[(at + 84) >> 2];
    o.sleepSpeed = F32[(at + 88) >> 2];
    o.skinning = I32[(at + 92) >> 2];
    o.timeStepping = I32[(at + 96) >> 2];
    o.fadeTime = F32[(at + 100) >> 2];
    o.normals = I32[(at + 104) >> 2] !== 0;
    return o;
}

const fieldsOfSheetSettings = new Set(["cookie", "material", "maxFrames", "crumbArea", "friction", "contactThickness",
    "groups", "touchesSheets", "selfContact", "iterations", "sleepSpeed", "skinning", "timeStepping", "fadeTime",
    "normals"]);

function writeSheetSettings(o, at, world) {
    known(o, fieldsOfSheetSettings, "SheetSettings");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.material !== undefined) {
        writeMaterial(o.material, at + 4, world);
    }
    if (o.maxFrames !== undefined) {
        I32[(at + 56) >> 2] = o.maxFrames;
    }
    if (o.crumbArea !== undefined) {
        F32[(at + 60) >> 2] = o.crumbArea;
    }
    if (o.friction !== undefined) {
        F32[(at + 64) >> 2] = o.friction;
    }
    if (o.contactThickness !== undefined) {
        F32[(at + 68) >> 2] = o.contactThickness;
    }
    if (o.groups !== undefined) {
        U32[(at + 72) >> 2] = o.groups;
    }
    if (o.touchesSheets !== undefined) {
        I32[(at + 76) >> 2] = o.touchesSheets;
    }
    if (o.selfContact !== undefined) {
        I32[(at + 80) >> 2] = o.selfContact;
    }
    if (o.iterations !== undefined) {
        I32[(at + 84) >> 2] = o.iterations;
    }
    if (o.sleepSpeed !== undefined) {
        F32[(at + 88) >> 2] = o.sleepSpeed;
    }
    if (o.skinning !== undefined) {
        I32[(at + 92) >> 2] = o.skinning;
    }
    if (o.timeStepping !== undefined) {
        I32[(at + 96) >> 2] = o.timeStepping;
    }
    if (o.fadeTime !== undefined) {
        F32[(at + 100) >> 2] = o.fadeTime;
    }
    if (o.normals !== undefined) {
        I32[(at + 104) >> 2] = o.normals;
    }
}

export class Fold {
    from = [0, 0];
    to = [0, 0];
    stiffness = 0;
    restAngle = 0;
    yieldMoment = 0;
}

function readFold(o, at, world) {
    fill(F32, (at) >> 2, o.from);
    fill(F32, (at + 8) >> 2, o.to);
    o.stiffness = F32[(at + 16) >> 2];
    o.restAngle = F32[(at + 20) >> 2];
    o.yieldMoment = F32[(at + 24) >> 2];
    return o;
}

const fieldsOfFold = new Set(["from", "to", "stiffness", "restAngle", "yieldMoment"]);

function writeFold(o, at, world) {
    known(o, fieldsOfFold, "Fold");
    if (o.from !== undefined) {
        put("Float32Array", at, o.from, 2, "from");
    }
    if (o.to !== undefined) {
        put("Float32Array", at + 8, o.to, 2, "to");
    }
    if (o.stiffness !== undefined) {
        F32[(at + 16) >> 2] = o.stiffness;
    }
    if (o.restAngle !== undefined) {
        F32[(at + 20) >> 2] = o.restAngle;
    }
    if (o.yieldMoment !== undefined) {
        F32[(at + 24) >> 2] = o.yieldMoment;
    }
}

export class FoldState {
    fold = new Fold();
    angle = 0;
    length = 0;
}

function readFoldState(o, at, world) {
    readFold(o.fold, at, world);
    o.angle = F64[(at + 32) >> 3];
    o.length = F64[(at + 40) >> 3];
    return o;
}

export class Mesh extends Shown {
    vertexCount = 0;
    triangleCount = 0;
    revision = 0;

    get positions() {
        return this._view("positions", "Float32Array", 3 * this.vertexCount);
    }

    get normals() {
        return this._view("normals", "Float32Array", 3 * this.vertexCount);
    }

    get restPositions() {
        return this._view("restPositions", "Float32Array", 2 * this.vertexCount);
    }

    get indices() {
        return this._view("indices", "Int32Array", 3 * this.triangleCount);
    }

    get sourceTriangles() {
        return this._view("sourceTriangles", "Int32Array", this.vertexCount);
    }

    get sourceWeights() {
        return this._view("sourceWeights", "Float32Array", 3 * this.vertexCount);
    }
}

function readMesh(o, at, world) {
    o._show(world);
    o._at.positions = U32[(at) >> 2];
    o._at.normals = U32[(at + 4) >> 2];
    o._at.restPositions = U32[(at + 8) >> 2];
    o._at.indices = U32[(at + 12) >> 2];
    o._at.sourceTriangles = U32[(at + 16) >> 2];
    o._at.sourceWeights = U32[(at + 20) >> 2];
    o.vertexCount = I32[(at + 24) >> 2];
    o.triangleCount = I32[(at + 28) >> 2];
    o.revision = U32[(at + 32) >> 2];
    return o;
}

export class Range {
    first = 0;
    count = 0;
}

function readRange(o, at, world) {
    o.first = I32[(at) >> 2];
    o.count = I32[(at + 4) >> 2];
    return o;
}

export class Dirty {
    newVertices = new Range();
    newTriangles = new Range();
    oldVertices = new Range();
    oldTriangles = new Range();
    revision = 0;
}

function readDirty(o, at, world) {
    readRange(o.newVertices, at, world);
    readRange(o.newTriangles, at + 8, world);
    readRange(o.oldVertices, at + 16, world);
    readRange(o.oldTriangles, at + 24, world);
    o.revision = U32[(at + 32) >> 2];
    return o;
}

export class Solid extends Shown {
    vertexCount = 0;
    triangleCount = 0;
    rimTriangle = 0;

    get positions() {
        return this._view("positions", "Float32Array", 3 * this.vertexCount);
    }

    get normals() {
        return this._view("normals", "Float32Array", 3 * this.vertexCount);
    }

    get restPositions() {
        return this._view("restPositions", "Float32Array", 2 * this.vertexCount);
    }

    get indices() {
        return this._view("indices", "Int32Array", 3 * this.triangleCount);
    }

    get sources() {
        return this._view("sources", "Int32Array", this.vertexCount);
    }
}

function readSolid(o, at, world) {
    o._show(world);
    o._at.positions = U32[(at) >> 2];
    o._at.normals = U32[(at + 4) >> 2];
    o._at.restPositions = U32[(at + 8) >> 2];
    o._at.indices = U32[(at + 12) >> 2];
    o._at.sources = U32[(at + 16) >> 2];
    o.vertexCount = I32[(at + 20) >> 2];
    o.triangleCount = I32[(at + 24) >> 2];
    o.rimTriangle = I32[(at + 28) >> 2];
    return o;
}

export class Counts {
    vertices = 0;
    triangles = 0;
    cells = 0;
    frames = 0;
    links = 0;
    pieces = 0;
    collisionPoints = 0;
}

function readCounts(o, at, world) {
    o.vertices = I32[(at) >> 2];
    o.triangles = I32[(at + 4) >> 2];
    o.cells = I32[(at + 8) >> 2];
    o.frames = I32[(at + 12) >> 2];
    o.links = I32[(at + 16) >> 2];
    o.pieces = I32[(at + 20) >> 2];
    o.collisionPoints = I32[(at + 24) >> 2];
    return o;
}

export class Totals {
    area = 0;
    mass = 0;
    kineticEnergy = 0;
    elasticEnergy = 0;
    center = [0, 0, 0];
    momentum = [0, 0, 0];
    angularMomentum = [0, 0, 0];
}

function readTotals(o, at, world) {
    o.area = F64[(at) >> 3];
    o.mass = F64[(at + 8) >> 3];
    o.kineticEnergy = F64[(at + 16) >> 3];
    o.elasticEnergy = F64[(at + 24) >> 3];
    fill(F64, (at + 32) >> 3, o.center);
    fill(F64, (at + 56) >> 3, o.momentum);
    fill(F64, (at + 80) >> 3, o.angularMomentum);
    return o;
}

export class Hit {
    restPoint = [0, 0];
    position = [0, 0, 0];
    normal = [0, 0, 0];
    distance = 0;
    triangle = 0;
}

function readHit(o, at, world) {
    fill(F32, (at) >> 2, o.restPoint);
    fill(F32, (at + 8) >> 2, o.position);
    fill(F32, (at + 20) >> 2, o.normal);
    o.distance = F32[(at + 32) >> 2];
    o.triangle = I32[(at + 36) >> 2];
    return o;
}

export class PointState {
    position = [0, 0, 0];
    normal = [0, 0, 0];
    velocity = [0, 0, 0];
    frame = null;
}

function readPointState(o, at, world) {
    fill(F32, (at) >> 2, o.position);
    fill(F32, (at + 12) >> 2, o.normal);
    fill(F32, (at + 24) >> 2, o.velocity);
    o.frame = thing(Frame, world, U32[(at + 36) >> 2], o.frame);
    return o;
}

export class PieceState {
    area = 0;
    mass = 0;
    center = [0, 0, 0];
    momentum = [0, 0, 0];
    angularMomentum = [0, 0, 0];
    lower = [0, 0, 0];
    upper = [0, 0, 0];
    frames = 0;
    vertices = 0;
    triangles = 0;
    collisionPoints = 0;
    crumb = false;
    asleep = false;
}

function readPieceState(o, at, world) {
    o.area = F64[(at) >> 3];
    o.mass = F64[(at + 8) >> 3];
    fill(F64, (at + 16) >> 3, o.center);
    fill(F64, (at + 40) >> 3, o.momentum);
    fill(F64, (at + 64) >> 3, o.angularMomentum);
    fill(F32, (at + 88) >> 2, o.lower);
    fill(F32, (at + 100) >> 2, o.upper);
    o.frames = I32[(at + 112) >> 2];
    o.vertices = I32[(at + 116) >> 2];
    o.triangles = I32[(at + 120) >> 2];
    o.collisionPoints = I32[(at + 124) >> 2];
    o.crumb = I32[(at + 128) >> 2] !== 0;
    o.asleep = I32[(at + 132) >> 2] !== 0;
    return o;
}

export class PieceMesh extends Shown {
    vertexCount = 0;
    triangleCount = 0;
    collisionPointCount = 0;

    get vertices() {
        return this._view("vertices", "Int32Array", this.vertexCount);
    }

    get triangles() {
        return this._view("triangles", "Int32Array", this.triangleCount);
    }

    get indices() {
        return this._view("indices", "Int32Array", 3 * this.triangleCount);
    }

    get collisionPoints() {
        return this._view("collisionPoints", "Int32Array", this.collisionPointCount);
    }
}

function readPieceMesh(o, at, world) {
    o._show(world);
    o._at.vertices = U32[(at) >> 2];
    o._at.triangles = U32[(at + 4) >> 2];
    o._at.indices = U32[(at + 8) >> 2];
    o._at.collisionPoints = U32[(at + 12) >> 2];
    o.vertexCount = I32[(at + 16) >> 2];
    o.triangleCount = I32[(at + 20) >> 2];
    o.collisionPointCount = I32[(at + 24) >> 2];
    return o;
}

export class Tearing {
    toughness = 0;
    strength = 0;
    grain = [0, 0];
    grainRatio = 0;
    maxSpeed = 0;
    maxTips = 0;
}

function readTearing(o, at, world) {
    o.toughness = F32[(at) >> 2];
    o.strength = F32[(at + 4) >> 2];
    fill(F32, (at + 8) >> 2, o.grain);
    o.grainRatio = F32[(at + 16) >> 2];
    o.maxSpeed = F32[(at + 20) >> 2];
    o.maxTips = I32[(at + 24) >> 2];
    return o;
}

const fieldsOfTearing = new Set(["toughness", "strength", "grain", "grainRatio", "maxSpeed", "maxTips"]);

function writeTearing(o, at, world) {
    known(o, fieldsOfTearing, "Tearing");
    if (o.toughness !== undefined) {
        F32[(at) >> 2] = o.toughness;
    }
    if (o.strength !== undefined) {
        F32[(at + 4) >> 2] = o.strength;
    }
    if (o.grain !== undefined) {
        put("Float32Array", at + 8, o.grain, 2, "grain");
    }
    if (o.grainRatio !== undefined) {
        F32[(at + 16) >> 2] = o.grainRatio;
    }
    if (o.maxSpeed !== undefined) {
        F32[(at + 20) >> 2] = o.maxSpeed;
    }
    if (o.maxTips !== undefined) {
        I32[(at + 24) >> 2] = o.maxTips;
    }
}

export class FrameState {
    restPoint = [0, 0];
    position = [0, 0, 0];
    rotation = [0, 0, 0, 0, 0, 0, 0, 0, 0];
    velocity = [0, 0, 0];
    angularVelocity = [0, 0, 0];
    area = 0;
    mass = 0;
    held = false;
}

function readFrameState(o, at, world) {
    fill(F32, (at) >> 2, o.restPoint);
    fill(F32, (at + 8) >> 2, o.position);
    fill(F32, (at + 20) >> 2, o.rotation);
    fill(F32, (at + 56) >> 2, o.velocity);
    fill(F32, (at + 68) >> 2, o.angularVelocity);
    o.area = F32[(at + 80) >> 2];
    o.mass = F32[(at + 84) >> 2];
    o.held = I32[(at + 88) >> 2] !== 0;
    return o;
}

const fieldsOfWind = new Set(["velocity", "density", "drag", "lift"]);

function writeWind(o, at, world) {
    known(o, fieldsOfWind, "Wind");
    if (o.velocity !== undefined) {
        put("Float32Array", at, o.velocity, 3, "velocity");
    }
    if (o.density !== undefined) {
        F32[(at + 12) >> 2] = o.density;
    }
    if (o.drag !== undefined) {
        F32[(at + 16) >> 2] = o.drag;
    }
    if (o.lift !== undefined) {
        F32[(at + 20) >> 2] = o.lift;
    }
}

export class PinDef {
    cookie = 0;
    restPoint = [0, 0];
    target = [0, 0, 0];
    stiffness = 0;
    breakForce = 0;
    obstacle = null;
}

function readPinDef(o, at, world) {
    o.cookie = U32[(at) >> 2];
    fill(F32, (at + 4) >> 2, o.restPoint);
    fill(F32, (at + 12) >> 2, o.target);
    o.stiffness = F32[(at + 24) >> 2];
    o.breakForce = F32[(at + 28) >> 2];
    o.obstacle = thing(Obstacle, world, U32[(at + 32) >> 2], o.obstacle);
    return o;
}

const fieldsOfPinDef = new Set(["cookie", "restPoint", "target", "stiffness", "breakForce", "obstacle"]);

function writePinDef(o, at, world) {
    known(o, fieldsOfPinDef, "PinDef");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.restPoint !== undefined) {
        put("Float32Array", at + 4, o.restPoint, 2, "restPoint");
    }
    if (o.target !== undefined) {
        put("Float32Array", at + 12, o.target, 3, "target");
    }
    if (o.stiffness !== undefined) {
        F32[(at + 24) >> 2] = o.stiffness;
    }
    if (o.breakForce !== undefined) {
        F32[(at + 28) >> 2] = o.breakForce;
    }
    if (o.obstacle !== undefined) {
        U32[(at + 32) >> 2] = idOf(o.obstacle, world);
    }
}

export class PinState {
    type = 0;
    sheet = null;
    from = [0, 0];
    to = [0, 0];
    target = [0, 0, 0];
    rotation = [0, 0, 0, 0, 0, 0, 0, 0, 0];
    breakForce = 0;
    obstacle = null;
}

function readPinState(o, at, world) {
    o.type = I32[(at) >> 2];
    o.sheet = thing(Sheet, world, U32[(at + 4) >> 2], o.sheet);
    fill(F32, (at + 8) >> 2, o.from);
    fill(F32, (at + 16) >> 2, o.to);
    fill(F32, (at + 24) >> 2, o.target);
    fill(F32, (at + 36) >> 2, o.rotation);
    o.breakForce = F32[(at + 72) >> 2];
    o.obstacle = thing(Obstacle, world, U32[(at + 76) >> 2], o.obstacle);
    return o;
}

export class SeamDef {
    cookie = 0;
    sheetA = null;
    sheetB = null;
    lineA = null;
    lineB = null;
    countA = 0;
    countB = 0;
    stitches = 0;
    stiffness = 0;
    restAngle = 0;
    breakForce = 0;
}

function readSeamDef(o, at, world) {
    o.cookie = U32[(at) >> 2];
    o.sheetA = thing(Sheet, world, U32[(at + 4) >> 2], o.sheetA);
    o.sheetB = thing(Sheet, world, U32[(at + 8) >> 2], o.sheetB);
    o.lineA = null;
    o.lineB = null;
    o.countA = I32[(at + 20) >> 2];
    o.countB = I32[(at + 24) >> 2];
    o.stitches = I32[(at + 28) >> 2];
    o.stiffness = F32[(at + 32) >> 2];
    o.restAngle = F32[(at + 36) >> 2];
    o.breakForce = F32[(at + 40) >> 2];
    return o;
}

const fieldsOfSeamDef = new Set(["cookie", "sheetA", "sheetB", "lineA", "lineB", "countA", "countB", "stitches",
    "stiffness", "restAngle", "breakForce"]);

function writeSeamDef(o, at, world) {
    known(o, fieldsOfSeamDef, "SeamDef");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.sheetA !== undefined) {
        U32[(at + 4) >> 2] = idOf(o.sheetA, world);
    }
    if (o.sheetB !== undefined) {
        U32[(at + 8) >> 2] = idOf(o.sheetB, world);
    }
    if (o.lineA != null) {
        U32[(at + 12) >> 2] = putRows("Float32Array", o.lineA, 2, "lineA");
        I32[(at + 20) >> 2] = o.lineA.length / 2;
    }
    if (o.lineB != null) {
        U32[(at + 16) >> 2] = putRows("Float32Array", o.lineB, 2, "lineB");
        I32[(at + 24) >> 2] = o.lineB.length / 2;
    }
    if (o.stitches !== undefined) {
        I32[(at + 28) >> 2] = o.stitches;
    }
    if (o.stiffness !== undefined) {
        F32[(at + 32) >> 2] = o.stiffness;
    }
    if (o.restAngle !== undefined) {
        F32[(at + 36) >> 2] = o.restAngle;
    }
    if (o.breakForce !== undefined) {
        F32[(at + 40) >> 2] = o.breakForce;
    }
}

export class Stitch {
    sheetA = null;
    sheetB = null;
    restA = [0, 0];
    restB = [0, 0];
    position = [0, 0, 0];
    gap = 0;
    force = [0, 0, 0];
    angle = 0;
}

function readStitch(o, at, world) {
    o.sheetA = thing(Sheet, world, U32[(at) >> 2], o.sheetA);
    o.sheetB = thing(Sheet, world, U32[(at + 4) >> 2], o.sheetB);
    fill(F32, (at + 8) >> 2, o.restA);
    fill(F32, (at + 16) >> 2, o.restB);
    fill(F32, (at + 24) >> 2, o.position);
    o.gap = F32[(at + 36) >> 2];
    fill(F32, (at + 40) >> 2, o.force);
    o.angle = F32[(at + 52) >> 2];
    return o;
}

const fieldsOfContact = new Set(["point", "restPoint", "normal", "offset", "velocity", "friction", "inverseMass",
    "pushSpeed", "obstacle"]);

function writeContact(o, at, world) {
    known(o, fieldsOfContact, "Contact");
    if (o.point !== undefined) {
        I32[(at) >> 2] = o.point;
    }
    if (o.restPoint !== undefined) {
        put("Float32Array", at + 4, o.restPoint, 2, "restPoint");
    }
    if (o.normal !== undefined) {
        put("Float32Array", at + 12, o.normal, 3, "normal");
    }
    if (o.offset !== undefined) {
        F32[(at + 24) >> 2] = o.offset;
    }
    if (o.velocity !== undefined) {
        put("Float32Array", at + 28, o.velocity, 3, "velocity");
    }
    if (o.friction !== undefined) {
        F32[(at + 40) >> 2] = o.friction;
    }
    if (o.inverseMass !== undefined) {
        F32[(at + 44) >> 2] = o.inverseMass;
    }
    if (o.pushSpeed !== undefined) {
        F32[(at + 48) >> 2] = o.pushSpeed;
    }
    if (o.obstacle !== undefined) {
        I32[(at + 52) >> 2] = o.obstacle;
    }
}

export class ContactForce {
    impulse = [0, 0, 0];
    position = [0, 0, 0];
    depth = 0;
    point = 0;
    obstacle = 0;
}

function readContactForce(o, at, world) {
    fill(F64, (at) >> 3, o.impulse);
    fill(F64, (at + 24) >> 3, o.position);
    o.depth = F64[(at + 48) >> 3];
    o.point = I32[(at + 56) >> 2];
    o.obstacle = I32[(at + 60) >> 2];
    return o;
}

export class ObstacleDef {
    cookie = 0;
    type = 0;
    size = [0, 0, 0];
    radius = 0;
    height = 0;
    outline = null;
    outlineCount = 0;
    rounding = 0;
    position = [0, 0, 0];
    rotation = [0, 0, 0, 0, 0, 0, 0, 0, 0];
    velocity = [0, 0, 0];
    angularVelocity = [0, 0, 0];
    surfaceVelocity = [0, 0, 0];
    friction = 0;
    mass = 0;
    inertia = [0, 0, 0, 0, 0, 0];
    centerOfMass = [0, 0, 0];
    body = 0;
    pushSpeed = 0;
    groups = 0;
}

function readObstacleDef(o, at, world) {
    o.cookie = U32[(at) >> 2];
    o.type = I32[(at + 4) >> 2];
    fill(F32, (at + 8) >> 2, o.size);
    o.radius = F32[(at + 20) >> 2];
    o.height = F32[(at + 24) >> 2];
    o.outline = null;
    o.outlineCount = I32[(at + 32) >> 2];
    o.rounding = F32[(at + 36) >> 2];
    fill(F32, (at + 40) >> 2, o.position);
    fill(F32, (at + 52) >> 2, o.rotation);
    fill(F32, (at + 88) >> 2, o.velocity);
    fill(F32, (at + 100) >> 2, o.angularVelocity);
    fill(F32, (at + 112) >> 2, o.surfaceVelocity);
    o.friction = F32[(at + 124) >> 2];
    o.mass = F32[(at + 128) >> 2];
    fill(F32, (at + 132) >> 2, o.inertia);
    fill(F32, (at + 156) >> 2, o.centerOfMass);
    o.body = U32[(at + 168) >> 2];
    o.pushSpeed = F32[(at + 172) >> 2];
    o.groups = U32[(at + 176) >> 2];
    return o;
}

const fieldsOfObstacleDef = new Set(["cookie", "type", "size", "radius", "height", "outline", "outlineCount",
    "rounding", "position", "rotation", "velocity", "angularVelocity", "surfaceVelocity", "friction", "mass",
    "inertia", "centerOfMass", "body", "pushSpeed", "groups"]);

function writeObstacleDef(o, at, world) {
    known(o, fieldsOfObstacleDef, "ObstacleDef");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.type !== undefined) {
        I32[(at + 4) >> 2] = o.type;
    }
    if (o.size !== undefined) {
        put("Float32Array", at + 8, o.size, 3, "size");
    }
    if (o.radius !== undefined) {
        F32[(at + 20) >> 2] = o.radius;
    }
    if (o.height !== undefined) {
        F32[(at + 24) >> 2] = o.height;
    }
    if (o.outline != null) {
        U32[(at + 28) >> 2] = putRows("Float32Array", o.outline, 2, "outline");
        I32[(at + 32) >> 2] = o.outline.length / 2;
    }
    if (o.rounding !== undefined) {
        F32[(at + 36) >> 2] = o.rounding;
    }
    if (o.position !== undefined) {
        put("Float32Array", at + 40, o.position, 3, "position");
    }
    if (o.rotation !== undefined) {
        put("Float32Array", at + 52, o.rotation, 9, "rotation");
    }
    if (o.velocity !== undefined) {
        put("Float32Array", at + 88, o.velocity, 3, "velocity");
    }
    if (o.angularVelocity !== undefined) {
        put("Float32Array", at + 100, o.angularVelocity, 3, "angularVelocity");
    }
    if (o.surfaceVelocity !== undefined) {
        put("Float32Array", at + 112, o.surfaceVelocity, 3, "surfaceVelocity");
    }
    if (o.friction !== undefined) {
        F32[(at + 124) >> 2] = o.friction;
    }
    if (o.mass !== undefined) {
        F32[(at + 128) >> 2] = o.mass;
    }
    if (o.inertia !== undefined) {
        put("Float32Array", at + 132, o.inertia, 6, "inertia");
    }
    if (o.centerOfMass !== undefined) {
        put("Float32Array", at + 156, o.centerOfMass, 3, "centerOfMass");
    }
    if (o.body !== undefined) {
        U32[(at + 168) >> 2] = o.body;
    }
    if (o.pushSpeed !== undefined) {
        F32[(at + 172) >> 2] = o.pushSpeed;
    }
    if (o.groups !== undefined) {
        U32[(at + 176) >> 2] = o.groups;
    }
}

export class ObstacleState {
    position = [0, 0, 0];
    rotation = [0, 0, 0, 0, 0, 0, 0, 0, 0];
    velocity = [0, 0, 0];
    angularVelocity = [0, 0, 0];
    impulse = [0, 0, 0];
    angularImpulse = [0, 0, 0];
    contacts = 0;
}

function readObstacleState(o, at, world) {
    fill(F32, (at) >> 2, o.position);
    fill(F32, (at + 12) >> 2, o.rotation);
    fill(F32, (at + 48) >> 2, o.velocity);
    fill(F32, (at + 60) >> 2, o.angularVelocity);
    fill(F64, (at + 72) >> 3, o.impulse);
    fill(F64, (at + 96) >> 3, o.angularImpulse);
    o.contacts = I32[(at + 120) >> 2];
    return o;
}

export class DebugDraw {
    cookie = 0;
    flags = 0;
    sheet = null;
    size = 0;
}

function readDebugDraw(o, at, world) {
    o.cookie = U32[(at) >> 2];
    o.flags = U32[(at + 4) >> 2];
    o.sheet = thing(Sheet, world, U32[(at + 8) >> 2], o.sheet);
    o.size = F32[(at + 12) >> 2];
    return o;
}

const fieldsOfDebugDraw = new Set(["cookie", "flags", "sheet", "size", "points", "lines", "triangles"]);

function writeDebugDraw(o, at, world) {
    known(o, fieldsOfDebugDraw, "DebugDraw");
    if (o.cookie !== undefined) {
        U32[(at) >> 2] = o.cookie;
    }
    if (o.flags !== undefined) {
        U32[(at + 4) >> 2] = o.flags;
    }
    if (o.sheet !== undefined) {
        U32[(at + 8) >> 2] = idOf(o.sheet, world);
    }
    if (o.size !== undefined) {
        F32[(at + 12) >> 2] = o.size;
    }
}

export function defaultWorldDef(into = new WorldDef()) {
    wasm.kiriDefaultWorldDef(scratch);
    return readWorldDef(into, scratch, null);
}

export function defaultSheetDef(into = new SheetDef()) {
    wasm.kiriDefaultSheetDef(scratch);
    return readSheetDef(into, scratch, null);
}

export function defaultPinDef(into = new PinDef()) {
    wasm.kiriDefaultPinDef(scratch);
    return readPinDef(into, scratch, null);
}

export function defaultSeamDef(into = new SeamDef()) {
    wasm.kiriDefaultSeamDef(scratch);
    return readSeamDef(into, scratch, null);
}

export function defaultObstacleDef(into = new ObstacleDef()) {
    wasm.kiriDefaultObstacleDef(scratch);
    return readObstacleDef(into, scratch, null);
}

export function defaultDebugDraw(into = new DebugDraw()) {
    wasm.kiriDefaultDebugDraw(scratch);
    return readDebugDraw(into, scratch, null);
}

export function getVersion() {
    return wasm.kiriGetVersion();
}

export function getResultName(result) {
    return string(wasm.kiriGetResultName(result));
}

export function getResultText(result) {
    return string(wasm.kiriGetResultText(result));
}

export function fitBudget(profile, microseconds, budget) {
    U8.fill(0, scratch, scratch + 144);
    writeProfile(profile, scratch, null);
    U8.fill(0, scratch + 144, scratch + 144 + 16);
    writeBudget(budget, scratch + 144, null);
    const $result = wasm.kiriFitBudget(scratch, microseconds, scratch + 144);
    if ($result < 0) {
        fail(null, $result, "fitBudget");
    }
    readBudget(budget, scratch + 144, null);
    return $result;
}

export function getStageName(stage) {
    return string(wasm.kiriGetStageName(stage));
}

export function getMaterial(preset, into = new Material()) {
    const $result = wasm.kiriGetMaterial(preset, scratch);
    if ($result < 0) {
        fail(null, $result, "getMaterial");
    }
    return readMaterial(into, scratch, null);
}

export function getQuality(preset, into = new Quality()) {
    const $result = wasm.kiriGetQuality(preset, scratch);
    if ($result < 0) {
        fail(null, $result, "getQuality");
    }
    return readQuality(into, scratch, null);
}

export function getSetup(preset, width, height, into = new SheetDef()) {
    const $result = wasm.kiriGetSetup(preset, width, height, scratch);
    if ($result < 0) {
        fail(null, $result, "getSetup");
    }
    return readSheetDef(into, scratch, null);
}

export function fillRectangle(width, height, columns, rows) {
    try {
        const $restPositions = take(4 * 2 * (columns + 1) * (rows + 1));
        const $indices = take(4 * 6 * columns * rows);
        const $result = wasm.kiriFillRectangle(width, height, columns, rows, $restPositions, $indices);
        if ($result < 0) {
            fail(null, $result, "fillRectangle");
        }
        return { restPositions: copy("Float32Array", $restPositions, 2 * (columns + 1) * (rows + 1)), indices: copy("Int32Array", $indices, 6 * columns * rows) };
    } finally {
        release();
    }
}

export function getTearing(preset, into = new Tearing()) {
    const $result = wasm.kiriGetTearing(preset, scratch);
    if ($result < 0) {
        fail(null, $result, "getTearing");
    }
    return readTearing(into, scratch, null);
}

export class World extends WorldBase {
    /** def: what differs from defaultWorldDef(); and log, clock and record, functions. */
    constructor(def = {}) {
        super();
        wasm.kiriDefaultWorldDef(scratch);
        writeWorldDef(def, scratch, this);
        this._begin(def, scratch);
        const $result = wasm.kiriCreateWorld(scratch, scratch + 72);
        if ($result < 0) {
            this._end();
            fail(this, $result, "World");
        }
        this._pointer = U32[(scratch + 72) >> 2];
    }

    /** Frees the world and all that is in it; once is enough. */
    destroy() {
        if (this._pointer) {
            wasm.kiriDestroyWorld(this._pointer);
            this._end();
        }
    }

    tick(dt, substeps) {
        const $world = pointer(this);
        this._epoch++;
        const $result = wasm.kiriWorld_Tick($world, dt, substeps);
        if ($result < 0) {
            fail(this, $result, "World.tick");
        }
        return $result;
    }

    getLastError() {
        const $world = pointer(this);
        return string(wasm.kiriWorld_GetLastError($world));
    }

    shiftOrigin(origin) {
        const $world = pointer(this);
        const $result = wasm.kiriWorld_ShiftOrigin($world, put("Float32Array", scratch, origin, 3, "origin"));
        if ($result < 0) {
            fail(this, $result, "World.shiftOrigin");
        }
        return $result;
    }

    setGravity(gravity) {
        const $world = pointer(this);
        const $result = wasm.kiriWorld_SetGravity($world, put("Float32Array", scratch, gravity, 3, "gravity"));
        if ($result < 0) {
            fail(this, $result, "World.setGravity");
        }
        return $result;
    }

    setBudget(budget) {
        const $world = pointer(this);
        U8.fill(0, scratch, scratch + 16);
        writeBudget(budget, scratch, this);
        const $result = wasm.kiriWorld_SetBudget($world, scratch);
        if ($result < 0) {
            fail(this, $result, "World.setBudget");
        }
        return $result;
    }

    getStateHash() {
        const $world = pointer(this);
        const $result = wasm.kiriWorld_GetStateHash($world, scratch);
        if ($result < 0) {
            fail(this, $result, "World.getStateHash");
        }
        return U64[(scratch) >> 3];
    }

    getSheets() {
        const $world = pointer(this);
        try {
            let $result = wasm.kiriWorld_GetSheets($world, scratch + 2048, 0, scratch);
            if ($result < 0) {
                fail(this, $result, "World.getSheets");
            }
            const $capacity = I32[(scratch) >> 2];
            const $sheets = take(4 * $capacity);
            $result = wasm.kiriWorld_GetSheets($world, $sheets, $capacity, scratch);
            if ($result < 0) {
                fail(this, $result, "World.getSheets");
            }
            return things(Sheet, this, $sheets, $capacity);
        } finally {
            release();
        }
    }

    note(bytes) {
        const $world = pointer(this);
        try {
            const $bytes = putRows("Uint8Array", bytes, 1, "bytes");
            const $result = wasm.kiriWorld_Note($world, $bytes, bytes.length);
            if ($result < 0) {
                fail(this, $result, "World.note");
            }
            return $result;
        } finally {
            release();
        }
    }

    replay(recording, replay) {
        const $world = pointer(this);
        try {
            this._epoch++;
            const $recording = putRows("Uint8Array", recording, 1, "recording");
            U8.fill(0, scratch, scratch + 32);
            writeReplay(replay, scratch, this);
            const $result = wasm.kiriWorld_Replay($world, $recording, BigInt(recording.length), scratch);
            if ($result < 0) {
                fail(this, $result, "World.replay");
            }
            readReplay(replay, scratch, this);
            return $result;
        } finally {
            release();
        }
    }

    save() {
        const $world = pointer(this);
        try {
            let $result = wasm.kiriWorld_Save($world, 0, 0n, scratch);
            if ($result < 0) {
                fail(this, $result, "World.save");
            }
            const $capacity = int64(scratch);
            const $bytes = take($capacity);
            $result = wasm.kiriWorld_Save($world, $bytes, BigInt($capacity), scratch);
            if ($result < 0) {
                fail(this, $result, "World.save");
            }
            return copy("Uint8Array", $bytes, $capacity);
        } finally {
            release();
        }
    }

    finishCuts() {
        const $world = pointer(this);
        this._epoch++;
        const $result = wasm.kiriWorld_FinishCuts($world);
        if ($result < 0) {
            fail(this, $result, "World.finishCuts");
        }
        return $result;
    }

    load(bytes) {
        const $world = pointer(this);
        try {
            this._epoch++;
            const $bytes = putRows("Uint8Array", bytes, 1, "bytes");
            const $result = wasm.kiriWorld_Load($world, $bytes, BigInt(bytes.length));
            if ($result < 0) {
                fail(this, $result, "World.load");
            }
            return $result;
        } finally {
            release();
        }
    }

    snapshot() {
        const $world = pointer(this);
        try {
            let $result = wasm.kiriWorld_Snapshot($world, 0, 0n, scratch);
            if ($result < 0) {
                fail(this, $result, "World.snapshot");
            }
            const $capacity = int64(scratch);
            const $bytes = take($capacity);
            $result = wasm.kiriWorld_Snapshot($world, $bytes, BigInt($capacity), scratch);
            if ($result < 0) {
                fail(this, $result, "World.snapshot");
            }
            return copy("Uint8Array", $bytes, $capacity);
        } finally {
            release();
        }
    }

    restore(bytes) {
        const $world = pointer(this);
        try {
            this._epoch++;
            const $bytes = putRows("Uint8Array", bytes, 1, "bytes");
            const $result = wasm.kiriWorld_Restore($world, $bytes, BigInt(bytes.length));
            if ($result < 0) {
                fail(this, $result, "World.restore");
            }
            return $result;
        } finally {
            release();
        }
    }

    getEvents() {
        const $world = pointer(this);
        const $result = wasm.kiriWorld_GetEvents($world, scratch, scratch + 8);
        if ($result < 0) {
            fail(this, $result, "World.getEvents");
        }
        const $count = I32[(scratch + 8) >> 2];
        return new Rows(this, U32[(scratch) >> 2], $count, 44, Event, readEvent);
    }

    getProfile(into = new Profile()) {
        const $world = pointer(this);
        const $result = wasm.kiriWorld_GetProfile($world, scratch);
        if ($result < 0) {
            fail(this, $result, "World.getProfile");
        }
        return readProfile(into, scratch, this);
    }

    createSheet(def) {
        const $world = pointer(this);
        try {
            wasm.kiriDefaultSheetDef(scratch);
            writeSheetDef(def, scratch, this);
            const $result = wasm.kiriCreateSheet($world, scratch, scratch + 240);
            if ($result < 0) {
                fail(this, $result, "World.createSheet");
            }
            return thing(Sheet, this, U32[(scratch + 240) >> 2]);
        } finally {
            release();
        }
    }

    createRectangle(width, height, columns = 0, rows = 0, def = null) {
        const $world = pointer(this);
        try {
            if (def) {
                wasm.kiriDefaultSheetDef(scratch);
                writeSheetDef(def, scratch, this);
            }
            const $result = wasm.kiriCreateRectangle($world, width, height, columns, rows, def ? scratch : 0, scratch + 240);
            if ($result < 0) {
                fail(this, $result, "World.createRectangle");
            }
            return thing(Sheet, this, U32[(scratch + 240) >> 2]);
        } finally {
            release();
        }
    }

    createFoldedSheet(def, folds) {
        const $world = pointer(this);
        try {
            wasm.kiriDefaultSheetDef(scratch);
            writeSheetDef(def, scratch, this);
            const $folds = take(28 * folds.length);
            U8.fill(0, $folds, $folds + 28 * folds.length);
            for (let i = 0; i < folds.length; i++) {
                writeFold(folds[i], $folds + 28 * i, this);
            }
            const $result = wasm.kiriCreateFoldedSheet($world, scratch, $folds, folds.length, scratch + 240);
            if ($result < 0) {
                fail(this, $result, "World.createFoldedSheet");
            }
            return thing(Sheet, this, U32[(scratch + 240) >> 2]);
        } finally {
            release();
        }
    }

    raycast(origin, direction, maxDistance, into = new Hit()) {
        const $world = pointer(this);
        const $result = wasm.kiriWorld_Raycast($world, put("Float32Array", scratch, origin, 3, "origin"), put("Float32Array", scratch + 16, direction, 3, "direction"), maxDistance, scratch + 32, scratch + 40);
        if ($result < 0) {
            fail(this, $result, "World.raycast");
        }
        return { sheet: thing(Sheet, this, U32[(scratch + 32) >> 2]), hit: readHit(into, scratch + 40, this) };
    }

    detachPieces(frames) {
        const $world = pointer(this);
        try {
            const $frames = take(4 * frames.length);
            for (let i = 0; i < frames.length; i++) {
                U32[($frames >> 2) + i] = idOf(frames[i], this);
            }
            const $detached = take(4 * frames.length);
            const $result = wasm.kiriWorld_DetachPieces($world, $frames, frames.length, $detached);
            if ($result < 0) {
                fail(this, $result, "World.detachPieces");
            }
            return things(Sheet, this, $detached, frames.length);
        } finally {
            release();
        }
    }

    destroyPieces(frames) {
        const $world = pointer(this);
        try {
            const $frames = take(4 * frames.length);
            for (let i = 0; i < frames.length; i++) {
                U32[($frames >> 2) + i] = idOf(frames[i], this);
            }
            const $result = wasm.kiriWorld_DestroyPieces($world, $frames, frames.length);
            if ($result < 0) {
                fail(this, $result, "World.destroyPieces");
            }
            return $result;
        } finally {
            release();
        }
    }

    beginBlade(sheet = null) {
        const $world = pointer(this);
        const $result = wasm.kiriBeginBlade($world, idOf(sheet, this), scratch);
        if ($result < 0) {
            fail(this, $result, "World.beginBlade");
        }
        return thing(Blade, this, U32[(scratch) >> 2]);
    }

    createSeam(def) {
        const $world = pointer(this);
        try {
            wasm.kiriDefaultSeamDef(scratch);
            writeSeamDef(def, scratch, this);
            const $result = wasm.kiriCreateSeam($world, scratch, scratch + 48);
            if ($result < 0) {
                fail(this, $result, "World.createSeam");
            }
            return thing(Seam, this, U32[(scratch + 48) >> 2]);
        } finally {
            release();
        }
    }

    getSeams() {
        const $world = pointer(this);
        try {
            let $result = wasm.kiriWorld_GetSeams($world, scratch + 2048, 0, scratch);
            if ($result < 0) {
                fail(this, $result, "World.getSeams");
            }
            const $capacity = I32[(scratch) >> 2];
            const $seams = take(4 * $capacity);
            $result = wasm.kiriWorld_GetSeams($world, $seams, $capacity, scratch);
            if ($result < 0) {
                fail(this, $result, "World.getSeams");
            }
            return things(Seam, this, $seams, $capacity);
        } finally {
            release();
        }
    }

    createObstacle(def) {
        const $world = pointer(this);
        try {
            wasm.kiriDefaultObstacleDef(scratch);
            writeObstacleDef(def, scratch, this);
            const $result = wasm.kiriCreateObstacle($world, scratch, scratch + 184);
            if ($result < 0) {
                fail(this, $result, "World.createObstacle");
            }
            return thing(Obstacle, this, U32[(scratch + 184) >> 2]);
        } finally {
            release();
        }
    }

    debugDraw(draw) {
        const $world = pointer(this);
        wasm.kiriDefaultDebugDraw(scratch);
        writeDebugDraw(draw, scratch, this);
        setDraw(draw, scratch);
        const $result = wasm.kiriWorld_DebugDraw($world, scratch);
        if ($result < 0) {
            fail(this, $result, "World.debugDraw");
        }
        return $result;
    }
}

export class Sheet extends Thing {
    destroy() {
        const $world = pointer(this.world);
        const $result = wasm.kiriDestroySheet($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.destroy");
        }
        return $result;
    }

    getSettings(into = new SheetSettings()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetSettings($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getSettings");
        }
        return readSheetSettings(into, scratch, this.world);
    }

    setSettings(settings) {
        const $world = pointer(this.world);
        U8.fill(0, scratch, scratch + 108);
        writeSheetSettings(settings, scratch, this.world);
        const $result = wasm.kiriSheet_SetSettings($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.setSettings");
        }
        return $result;
    }

    addFold(fold) {
        const $world = pointer(this.world);
        U8.fill(0, scratch, scratch + 28);
        writeFold(fold, scratch, this.world);
        const $result = wasm.kiriSheet_AddFold($world, this.id, scratch, scratch + 32);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.addFold");
        }
        return I32[(scratch + 32) >> 2];
    }

    getFold(index, into = new FoldState()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetFold($world, this.id, index, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getFold");
        }
        return readFoldState(into, scratch, this.world);
    }

    setFold(index, stiffness, restAngle) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_SetFold($world, this.id, index, stiffness, restAngle);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.setFold");
        }
        return $result;
    }

    getMesh(into = new Mesh()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetMesh($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getMesh");
        }
        return readMesh(into, scratch, this.world);
    }

    getDirty(sinceRevision, into = new Dirty()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetDirty($world, this.id, sinceRevision, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getDirty");
        }
        return readDirty(into, scratch, this.world);
    }

    copyVertices(first, count, positions = null, positionStride = 12, normals = null, normalStride = 12) {
        const $world = pointer(this.world);
        try {
            const $positions = positions ? take(12 * count) : 0;
            const $normals = normals ? take(12 * count) : 0;
            const $result = wasm.kiriSheet_CopyVertices($world, this.id, first, count, $positions, 12, $normals, 12);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.copyVertices");
            }
            if (positions) {
                scatter($positions, positions, positionStride, count);
            }
            if (normals) {
                scatter($normals, normals, normalStride, count);
            }
            return $result;
        } finally {
            release();
        }
    }

    copyPrevious(first, count) {
        const $world = pointer(this.world);
        try {
            const $vertices = take(4 * count);
            const $result = wasm.kiriSheet_CopyPrevious($world, this.id, first, count, $vertices, scratch);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.copyPrevious");
            }
            return { vertices: copy("Int32Array", $vertices, count), from: thing(Sheet, this.world, U32[(scratch) >> 2]) };
        } finally {
            release();
        }
    }

    copyIndices16(firstTriangle, count) {
        const $world = pointer(this.world);
        try {
            const $indices = take(2 * 3 * count);
            const $result = wasm.kiriSheet_CopyIndices16($world, this.id, firstTriangle, count, $indices);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.copyIndices16");
            }
            return copy("Uint16Array", $indices, 3 * count);
        } finally {
            release();
        }
    }

    copySources(firstTriangle, count) {
        const $world = pointer(this.world);
        try {
            const $sources = take(4 * count);
            const $result = wasm.kiriSheet_CopySources($world, this.id, firstTriangle, count, $sources);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.copySources");
            }
            return copy("Int32Array", $sources, count);
        } finally {
            release();
        }
    }

    copySourceWeights(firstTriangle, count) {
        const $world = pointer(this.world);
        try {
            const $weights = take(4 * 9 * count);
            const $result = wasm.kiriSheet_CopySourceWeights($world, this.id, firstTriangle, count, $weights);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.copySourceWeights");
            }
            return copy("Float32Array", $weights, 9 * count);
        } finally {
            release();
        }
    }

    getSolid(thickness = 0, into = new Solid()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetSolid($world, this.id, thickness, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getSolid");
        }
        return readSolid(into, scratch, this.world);
    }

    getCollisionPoints() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetCollisionPoints($world, this.id, scratch, scratch + 8);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getCollisionPoints");
        }
        const $count = I32[(scratch + 8) >> 2];
        return new View(this.world, "Float32Array", U32[(scratch) >> 2], 3 * $count);
    }

    getCounts(into = new Counts()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetCounts($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getCounts");
        }
        return readCounts(into, scratch, this.world);
    }

    getTotals(into = new Totals()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetTotals($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getTotals");
        }
        return readTotals(into, scratch, this.world);
    }

    estimateError() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_EstimateError($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.estimateError");
        }
        return F64[(scratch) >> 3];
    }

    isAwake() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_IsAwake($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.isAwake");
        }
        return I32[(scratch) >> 2] !== 0;
    }

    wake() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_Wake($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.wake");
        }
        return $result;
    }

    transform(rotation, translation) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_Transform($world, this.id, put("Float32Array", scratch, rotation, 9, "rotation"), put("Float32Array", scratch + 40, translation, 3, "translation"));
        if ($result < 0) {
            fail(this.world, $result, "Sheet.transform");
        }
        return $result;
    }

    setVelocity(velocity, angularVelocity) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_SetVelocity($world, this.id, put("Float32Array", scratch, velocity, 3, "velocity"), put("Float32Array", scratch + 16, angularVelocity, 3, "angularVelocity"));
        if ($result < 0) {
            fail(this.world, $result, "Sheet.setVelocity");
        }
        return $result;
    }

    setUserData(data) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_SetUserData($world, this.id, BigInt(data));
        if ($result < 0) {
            fail(this.world, $result, "Sheet.setUserData");
        }
        return $result;
    }

    getUserData() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetUserData($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getUserData");
        }
        return U64[(scratch) >> 3];
    }

    raycast(origin, direction, maxDistance, into = new Hit()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_Raycast($world, this.id, put("Float32Array", scratch, origin, 3, "origin"), put("Float32Array", scratch + 16, direction, 3, "direction"), maxDistance, scratch + 32);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.raycast");
        }
        return readHit(into, scratch + 32, this.world);
    }

    getPoint(restPoint, into = new PointState()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetPoint($world, this.id, put("Float32Array", scratch, restPoint, 2, "restPoint"), scratch + 8);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getPoint");
        }
        return readPointState(into, scratch + 8, this.world);
    }

    getWeights(restPoint) {
        const $world = pointer(this.world);
        try {
            let $result = wasm.kiriSheet_GetWeights($world, this.id, put("Float32Array", scratch, restPoint, 2, "restPoint"), scratch + 2048, scratch + 2048, scratch + 2048, 0, scratch + 8);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.getWeights");
            }
            const $capacity = I32[(scratch + 8) >> 2];
            const $frames = take(4 * $capacity);
            const $weights = take(4 * $capacity);
            const $gradients = take(8 * $capacity);
            $result = wasm.kiriSheet_GetWeights($world, this.id, put("Float32Array", scratch, restPoint, 2, "restPoint"), $frames, $weights, $gradients, $capacity, scratch + 8);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.getWeights");
            }
            return { frames: things(Frame, this.world, $frames, $capacity), weights: copy("Float32Array", $weights, $capacity), gradients: copy("Float32Array", $gradients, 2 * $capacity) };
        } finally {
            release();
        }
    }

    getPiece(piece, into = new PieceState()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetPiece($world, this.id, piece, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getPiece");
        }
        return readPieceState(into, scratch, this.world);
    }

    getPieceMesh(piece, into = new PieceMesh()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetPieceMesh($world, this.id, piece, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getPieceMesh");
        }
        return readPieceMesh(into, scratch, this.world);
    }

    getPieceFrames(piece) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetPieceFrames($world, this.id, piece, scratch, scratch + 8);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getPieceFrames");
        }
        const $count = I32[(scratch + 8) >> 2];
        return things(Frame, this.world, U32[(scratch) >> 2], $count);
    }

    dropCrumbs(area) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_DropCrumbs($world, this.id, area, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.dropCrumbs");
        }
        return I32[(scratch) >> 2];
    }

    beginCut(restPoint) {
        const $world = pointer(this.world);
        const $result = wasm.kiriBeginCut($world, this.id, put("Float32Array", scratch, restPoint, 2, "restPoint"), scratch + 8);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.beginCut");
        }
        return thing(Cut, this.world, U32[(scratch + 8) >> 2]);
    }

    cut(restPoints) {
        const $world = pointer(this.world);
        try {
            const $restPoints = putRows("Float32Array", restPoints, 2, "restPoints");
            const $result = wasm.kiriSheet_Cut($world, this.id, $restPoints, restPoints.length / 2, scratch);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.cut");
            }
            return thing(Cut, this.world, U32[(scratch) >> 2]);
        } finally {
            release();
        }
    }

    slice(blade) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_Slice($world, this.id, put("Float32Array", scratch, blade, 12, "blade"), scratch + 48);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.slice");
        }
        return thing(Cut, this.world, U32[(scratch + 48) >> 2]);
    }

    setTearing(tearing) {
        const $world = pointer(this.world);
        U8.fill(0, scratch, scratch + 28);
        writeTearing(tearing, scratch, this.world);
        const $result = wasm.kiriSheet_SetTearing($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.setTearing");
        }
        return $result;
    }

    getTearing(into = new Tearing()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetTearing($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getTearing");
        }
        return readTearing(into, scratch, this.world);
    }

    setTearLine(restPoints, factor) {
        const $world = pointer(this.world);
        try {
            const $restPoints = putRows("Float32Array", restPoints, 2, "restPoints");
            const $result = wasm.kiriSheet_SetTearLine($world, this.id, $restPoints, restPoints.length / 2, factor);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.setTearLine");
            }
            return $result;
        } finally {
            release();
        }
    }

    getFrames() {
        const $world = pointer(this.world);
        try {
            let $result = wasm.kiriSheet_GetFrames($world, this.id, scratch + 2048, 0, scratch);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.getFrames");
            }
            const $capacity = I32[(scratch) >> 2];
            const $frames = take(4 * $capacity);
            $result = wasm.kiriSheet_GetFrames($world, this.id, $frames, $capacity, scratch);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.getFrames");
            }
            return things(Frame, this.world, $frames, $capacity);
        } finally {
            release();
        }
    }

    applyForce(restPoint, force, torque) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_ApplyForce($world, this.id, put("Float32Array", scratch, restPoint, 2, "restPoint"), put("Float32Array", scratch + 8, force, 3, "force"), put("Float32Array", scratch + 24, torque, 3, "torque"));
        if ($result < 0) {
            fail(this.world, $result, "Sheet.applyForce");
        }
        return $result;
    }

    applyLineLoad(from, to, forcePerLength) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_ApplyLineLoad($world, this.id, put("Float32Array", scratch, from, 2, "from"), put("Float32Array", scratch + 8, to, 2, "to"), put("Float32Array", scratch + 16, forcePerLength, 3, "forcePerLength"));
        if ($result < 0) {
            fail(this.world, $result, "Sheet.applyLineLoad");
        }
        return $result;
    }

    applyPressure(pressure) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_ApplyPressure($world, this.id, pressure);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.applyPressure");
        }
        return $result;
    }

    applyImpulse(restPoint, impulse) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_ApplyImpulse($world, this.id, put("Float32Array", scratch, restPoint, 2, "restPoint"), put("Float32Array", scratch + 8, impulse, 3, "impulse"));
        if ($result < 0) {
            fail(this.world, $result, "Sheet.applyImpulse");
        }
        return $result;
    }

    setWind(wind) {
        const $world = pointer(this.world);
        U8.fill(0, scratch, scratch + 24);
        writeWind(wind, scratch, this.world);
        const $result = wasm.kiriSheet_SetWind($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.setWind");
        }
        return $result;
    }

    createPin(def) {
        const $world = pointer(this.world);
        wasm.kiriDefaultPinDef(scratch);
        writePinDef(def, scratch, this.world);
        const $result = wasm.kiriCreatePin($world, this.id, scratch, scratch + 40);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.createPin");
        }
        return thing(Pin, this.world, U32[(scratch + 40) >> 2]);
    }

    clampLine(from, to) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_ClampLine($world, this.id, put("Float32Array", scratch, from, 2, "from"), put("Float32Array", scratch + 8, to, 2, "to"), scratch + 16);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.clampLine");
        }
        return thing(Pin, this.world, U32[(scratch + 16) >> 2]);
    }

    hingeLine(from, to) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_HingeLine($world, this.id, put("Float32Array", scratch, from, 2, "from"), put("Float32Array", scratch + 8, to, 2, "to"), scratch + 16);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.hingeLine");
        }
        return thing(Pin, this.world, U32[(scratch + 16) >> 2]);
    }

    getPins() {
        const $world = pointer(this.world);
        try {
            let $result = wasm.kiriSheet_GetPins($world, this.id, scratch + 2048, 0, scratch);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.getPins");
            }
            const $capacity = I32[(scratch) >> 2];
            const $pins = take(4 * $capacity);
            $result = wasm.kiriSheet_GetPins($world, this.id, $pins, $capacity, scratch);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.getPins");
            }
            return things(Pin, this.world, $pins, $capacity);
        } finally {
            release();
        }
    }

    setContacts(contacts) {
        const $world = pointer(this.world);
        try {
            const $contacts = take(56 * contacts.length);
            U8.fill(0, $contacts, $contacts + 56 * contacts.length);
            for (let i = 0; i < contacts.length; i++) {
                writeContact(contacts[i], $contacts + 56 * i, this.world);
            }
            const $result = wasm.kiriSheet_SetContacts($world, this.id, $contacts, contacts.length);
            if ($result < 0) {
                fail(this.world, $result, "Sheet.setContacts");
            }
            return $result;
        } finally {
            release();
        }
    }

    getContactForces() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetContactForces($world, this.id, scratch, scratch + 8);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getContactForces");
        }
        const $count = I32[(scratch + 8) >> 2];
        return new Rows(this.world, U32[(scratch) >> 2], $count, 64, ContactForce, readContactForce);
    }

    getReach(dt) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSheet_GetReach($world, this.id, dt, scratch, scratch + 16);
        if ($result < 0) {
            fail(this.world, $result, "Sheet.getReach");
        }
        return { lower: copy("Float32Array", scratch, 3), upper: copy("Float32Array", scratch + 16, 3) };
    }
}

export class Cut extends Thing {
    extend(restPoints) {
        const $world = pointer(this.world);
        try {
            const $restPoints = putRows("Float32Array", restPoints, 2, "restPoints");
            const $result = wasm.kiriCut_Extend($world, this.id, $restPoints, restPoints.length / 2);
            if ($result < 0) {
                fail(this.world, $result, "Cut.extend");
            }
            return $result;
        } finally {
            release();
        }
    }

    end() {
        const $world = pointer(this.world);
        const $result = wasm.kiriCut_End($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Cut.end");
        }
        return $result;
    }
}

export class Frame extends Thing {
    setPieceVelocity(velocity, angularVelocity) {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_SetPieceVelocity($world, this.id, put("Float32Array", scratch, velocity, 3, "velocity"), put("Float32Array", scratch + 16, angularVelocity, 3, "angularVelocity"));
        if ($result < 0) {
            fail(this.world, $result, "Frame.setPieceVelocity");
        }
        return $result;
    }

    setPieceUserData(data) {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_SetPieceUserData($world, this.id, BigInt(data));
        if ($result < 0) {
            fail(this.world, $result, "Frame.setPieceUserData");
        }
        return $result;
    }

    getPieceUserData() {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_GetPieceUserData($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Frame.getPieceUserData");
        }
        return U64[(scratch) >> 3];
    }

    getPiece() {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_GetPiece($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Frame.getPiece");
        }
        return I32[(scratch) >> 2];
    }

    detachPiece() {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_DetachPiece($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Frame.detachPiece");
        }
        return thing(Sheet, this.world, U32[(scratch) >> 2]);
    }

    destroyPiece() {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_DestroyPiece($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Frame.destroyPiece");
        }
        return $result;
    }

    hold(position = null, rotation = null) {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_Hold($world, this.id, position ? put("Float32Array", scratch, position, 3, "position") : 0, rotation ? put("Float32Array", scratch + 16, rotation, 9, "rotation") : 0);
        if ($result < 0) {
            fail(this.world, $result, "Frame.hold");
        }
        return $result;
    }

    getState(into = new FrameState()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_GetState($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Frame.getState");
        }
        return readFrameState(into, scratch, this.world);
    }

    getReaction() {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_GetReaction($world, this.id, scratch, scratch + 24);
        if ($result < 0) {
            fail(this.world, $result, "Frame.getReaction");
        }
        return { force: copy("Float64Array", scratch, 3), torque: copy("Float64Array", scratch + 24, 3) };
    }

    applyForce(force, torque) {
        const $world = pointer(this.world);
        const $result = wasm.kiriFrame_ApplyForce($world, this.id, put("Float32Array", scratch, force, 3, "force"), put("Float32Array", scratch + 16, torque, 3, "torque"));
        if ($result < 0) {
            fail(this.world, $result, "Frame.applyForce");
        }
        return $result;
    }
}

export class Pin extends Thing {
    setUserData(data) {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_SetUserData($world, this.id, BigInt(data));
        if ($result < 0) {
            fail(this.world, $result, "Pin.setUserData");
        }
        return $result;
    }

    getUserData() {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_GetUserData($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Pin.getUserData");
        }
        return U64[(scratch) >> 3];
    }

    destroy() {
        const $world = pointer(this.world);
        const $result = wasm.kiriDestroyPin($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Pin.destroy");
        }
        return $result;
    }

    setTarget(target) {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_SetTarget($world, this.id, put("Float32Array", scratch, target, 3, "target"));
        if ($result < 0) {
            fail(this.world, $result, "Pin.setTarget");
        }
        return $result;
    }

    setPose(target, rotation) {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_SetPose($world, this.id, put("Float32Array", scratch, target, 3, "target"), put("Float32Array", scratch + 16, rotation, 9, "rotation"));
        if ($result < 0) {
            fail(this.world, $result, "Pin.setPose");
        }
        return $result;
    }

    setBreakForce(breakForce) {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_SetBreakForce($world, this.id, breakForce);
        if ($result < 0) {
            fail(this.world, $result, "Pin.setBreakForce");
        }
        return $result;
    }

    getState(into = new PinState()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_GetState($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Pin.getState");
        }
        return readPinState(into, scratch, this.world);
    }

    getReaction() {
        const $world = pointer(this.world);
        const $result = wasm.kiriPin_GetReaction($world, this.id, scratch, scratch + 24);
        if ($result < 0) {
            fail(this.world, $result, "Pin.getReaction");
        }
        return { force: copy("Float64Array", scratch, 3), torque: copy("Float64Array", scratch + 24, 3) };
    }
}

export class Obstacle extends Thing {
    destroy() {
        const $world = pointer(this.world);
        const $result = wasm.kiriDestroyObstacle($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Obstacle.destroy");
        }
        return $result;
    }

    setPose(position, rotation) {
        const $world = pointer(this.world);
        const $result = wasm.kiriObstacle_SetPose($world, this.id, put("Float32Array", scratch, position, 3, "position"), put("Float32Array", scratch + 16, rotation, 9, "rotation"));
        if ($result < 0) {
            fail(this.world, $result, "Obstacle.setPose");
        }
        return $result;
    }

    setVelocity(velocity, angularVelocity) {
        const $world = pointer(this.world);
        const $result = wasm.kiriObstacle_SetVelocity($world, this.id, put("Float32Array", scratch, velocity, 3, "velocity"), put("Float32Array", scratch + 16, angularVelocity, 3, "angularVelocity"));
        if ($result < 0) {
            fail(this.world, $result, "Obstacle.setVelocity");
        }
        return $result;
    }

    setSurfaceVelocity(velocity) {
        const $world = pointer(this.world);
        const $result = wasm.kiriObstacle_SetSurfaceVelocity($world, this.id, put("Float32Array", scratch, velocity, 3, "velocity"));
        if ($result < 0) {
            fail(this.world, $result, "Obstacle.setSurfaceVelocity");
        }
        return $result;
    }

    setMass(mass, inertia, centerOfMass) {
        const $world = pointer(this.world);
        const $result = wasm.kiriObstacle_SetMass($world, this.id, mass, put("Float32Array", scratch, inertia, 6, "inertia"), put("Float32Array", scratch + 24, centerOfMass, 3, "centerOfMass"));
        if ($result < 0) {
            fail(this.world, $result, "Obstacle.setMass");
        }
        return $result;
    }

    getState(into = new ObstacleState()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriObstacle_GetState($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Obstacle.getState");
        }
        return readObstacleState(into, scratch, this.world);
    }
}

export class Blade extends Thing {
    moveEdge(from, to) {
        const $world = pointer(this.world);
        const $result = wasm.kiriBlade_MoveEdge($world, this.id, put("Float32Array", scratch, from, 3, "from"), put("Float32Array", scratch + 16, to, 3, "to"));
        if ($result < 0) {
            fail(this.world, $result, "Blade.moveEdge");
        }
        return $result;
    }

    moveRay(origin, direction, length) {
        const $world = pointer(this.world);
        const $result = wasm.kiriBlade_MoveRay($world, this.id, put("Float32Array", scratch, origin, 3, "origin"), put("Float32Array", scratch + 16, direction, 3, "direction"), length);
        if ($result < 0) {
            fail(this.world, $result, "Blade.moveRay");
        }
        return $result;
    }

    end() {
        const $world = pointer(this.world);
        const $result = wasm.kiriBlade_End($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Blade.end");
        }
        return $result;
    }
}

export class Seam extends Thing {
    destroy() {
        const $world = pointer(this.world);
        const $result = wasm.kiriDestroySeam($world, this.id);
        if ($result < 0) {
            fail(this.world, $result, "Seam.destroy");
        }
        return $result;
    }

    setHinge(stiffness, restAngle) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSeam_SetHinge($world, this.id, stiffness, restAngle);
        if ($result < 0) {
            fail(this.world, $result, "Seam.setHinge");
        }
        return $result;
    }

    getStitch(index, into = new Stitch()) {
        const $world = pointer(this.world);
        const $result = wasm.kiriSeam_GetStitch($world, this.id, index, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Seam.getStitch");
        }
        return readStitch(into, scratch, this.world);
    }

    getCount() {
        const $world = pointer(this.world);
        const $result = wasm.kiriSeam_GetCount($world, this.id, scratch);
        if ($result < 0) {
            fail(this.world, $result, "Seam.getCount");
        }
        return I32[(scratch) >> 2];
    }
}
