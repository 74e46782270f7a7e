"""Made from kiri.h by `make bindings`: keywords of defs, for editors and type checkers."""

from typing import Any, TypedDict


class Budget(TypedDict, total=False):
    triangles: int
    cells: int
    samples: int
    iterations: int


class WorldDef(TypedDict, total=False):
    gravity: Any
    budget: Any
    alloc: Any
    free: Any
    log: Any
    clock: Any
    startTask: Any
    finishTask: Any
    workerCount: int
    user: Any
    record: Any
    recordHashTicks: int


class SheetDef(TypedDict, total=False):
    restPositions: Any
    vertexCount: int
    indices: Any
    triangleCount: int
    position: Any
    axisU: Any
    axisV: Any
    velocity: Any
    material: Any
    gridResolution: int
    snapDistance: float
    weldDistance: float
    frameCount: int
    frameLength: float
    accuracy: float
    framePoints: Any
    maxFrames: int
    rigidWeight: float
    rigidArea: float
    crumbArea: float
    friction: float
    contactThickness: float
    groups: int
    touchesSheets: int
    selfContact: int
    collisionPoints: int
    iterations: int
    sleepSpeed: float
    model: int
    skinning: int
    planar: int
    timeStepping: int
    fadeTime: float
    normals: int
    paper: Any


class SheetSettings(TypedDict, total=False):
    material: Any
    maxFrames: int
    crumbArea: float
    friction: float
    contactThickness: float
    groups: int
    touchesSheets: int
    selfContact: int
    iterations: int
    sleepSpeed: float
    skinning: int
    timeStepping: int
    fadeTime: float
    normals: int


class Tearing(TypedDict, total=False):
    toughness: float
    strength: float
    grain: Any
    grainRatio: float
    maxSpeed: float
    maxTips: int


class Wind(TypedDict, total=False):
    velocity: Any
    density: float
    drag: float
    lift: float


class PinDef(TypedDict, total=False):
    stiffness: float
    breakForce: float
    obstacle: Any


class SeamDef(TypedDict, total=False):
    sheetA: Any
    sheetB: Any
    lineA: Any
    lineB: Any
    countA: int
    countB: int
    stitches: int
    stiffness: float
    restAngle: float
    breakForce: float


class ObstacleDef(TypedDict, total=False):
    size: Any
    radius: float
    height: float
    outline: Any
    outlineCount: int
    rounding: float
    position: Any
    rotation: Any
    velocity: Any
    angularVelocity: Any
    surfaceVelocity: Any
    friction: float
    mass: float
    inertia: Any
    centerOfMass: Any
    body: int
    pushSpeed: float
    groups: int


class DebugDraw(TypedDict, total=False):
    flags: int
    sheet: Any
    size: float
    points: Any
    lines: Any
    triangles: Any
    user: Any
