// The binding of JavaScript: node tests/test_javascript.mjs FOLDER, where kiri.js and kiri.wasm are, and what the C
// program tests/twin.c printed. Prints what calls cost.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { resolve } from "node:path";
import test from "node:test";
import { pathToFileURL } from "node:url";

const [folder, twinHash] = process.argv.slice(2);
const kiri = await import(pathToFileURL(resolve(folder, "kiri.js")));
const { EventType, KiriError, Mesh, ResultCode, World, load } = kiri;
const description = JSON.parse(readFileSync("bindings/kiri.json", "utf8"));
assert.throws(() => new World(), /await load\(\)/, "a world before load() says what to do");
await load();

const inWorld = (work, def) => {
    const world = new World(def);
    try {
        return work(world);
    } finally {
        world.destroy();
    }
};
const square = (world, def) => world.createRectangle(0.2, 0.2, 16, 16, def);
const throwsCode = (work, code) => assert.throws(work, (error) => error instanceof KiriError && error.code === code);
const camel = (name) => name[0].toLowerCase() + name.slice(1);

function cutAcross(sheet, u = 0.1) {
    const cut = sheet.beginCut([u, -0.01]);
    cut.extend([u, 0.21]);
    cut.end();
}

test("no function is missing", () => {
    for (const { name, method, class: owner } of description.functions) {
        assert.equal(typeof kiri.wasm[name], "function", name);
        if (name !== "kiriCreateWorld") {
            const where = owner ? kiri[owner].prototype : kiri;
            assert.equal(typeof where[camel(method)], "function", name);
        }
    }
});

test("the module asks for nothing but hooks and what memory needs", () => {
    const imports = WebAssembly.Module.imports(new WebAssembly.Module(readFileSync(resolve(folder, "kiri.wasm"))));
    const allowed = ["kiri.log", "kiri.clock", "kiri.record", "kiri.draw", "env.emscripten_notify_memory_growth",
                     "wasi_snapshot_preview1.proc_exit"];
    assert.deepEqual(imports.map((i) => `${i.module}.${i.name}`).filter((name) => !allowed.includes(name)), []);
});

// snprintf of hooks.c knows no more.
test("messages of the library have %s and %lld only", () => {
    for (const folder of ["core", "mesh", "field", "motion", "view", "sheet", "world"]) {
        for (const name of readdirSync(`src/${folder}`)) {
            const formats = readFileSync(`src/${folder}/${name}`, "utf8").matchAll(/\bv?snprintf\([^"]*"((?:[^"\\]|\\.)*)"/g);
            for (const [, format] of formats) {
                assert.equal(format.replaceAll(/%s|%lld/g, "").includes("%"), false, `${name}: ${format}`);
            }
        }
    }
});

test("enums have names both ways", () => {
    assert.equal(EventType.PieceOff, 2);
    assert.equal(EventType[2], "PieceOff");
    assert.equal(ResultCode[-3], "ErrorId");
});

test("a setup is a def", () => inWorld((world) => {
    const def = kiri.getSetup(kiri.SetupPreset.Paper, 0.3, 0.3);
    def.axisV = [0, 0, 1];
    const counts = world.createRectangle(0.3, 0.3, 0, 0, def).getCounts();
    assert.deepEqual([counts.frames, counts.triangles], [25, 7200]);
}));

// tests/twin.c has the same scene.
test("the same calls as in C give the same hash", () => inWorld((world) => {
    const sheet = world.createRectangle(1, 0.75, 16, 12, { position: [0, 0, 1], material: { youngsModulus: 1e7 },
                                                           frameCount: 6 });
    for (const u of [0, 1]) {
        sheet.createPin({ restPoint: [u, 0], target: [u, 0, 1] });
    }
    world.createObstacle({ type: kiri.ObstacleType.Sphere, radius: 0.25, position: [0.5, 0.5, 0.5] });
    const cut = sheet.beginCut([0.3, -0.1]);
    cut.extend([0.3, 0.4, 0.7, 0.45, 0.65, 0.85]);
    cut.end();
    const blade = world.beginBlade();
    for (let tick = 0; tick < 120; tick++) {
        if (tick >= 40 && tick < 60) {
            const x = 0.0625 * (tick - 44);
            blade.moveEdge([x, 0.125, -1], [x, 0.125, 2]);
        } else if (tick === 60) {
            blade.end();
        }
        world.tick(1 / 60, 2);
        for (const event of world.getEvents()) {
            if (event.type === EventType.PieceOff) {
                event.frame.detachPiece();
            }
        }
    }
    assert.ok(world.getSheets().length > 1);
    assert.equal(world.getStateHash().toString(16).padStart(16, "0"), twinHash);
}, { gravity: [1, 0, -9.81] }));

test("a cut parts a sheet, and events tell", () => inWorld((world) => {
    const sheet = square(world);
    cutAcross(sheet);
    world.tick(1 / 60, 2);
    const events = [...world.getEvents()];
    assert.equal(sheet.getCounts().pieces, 2);
    const off = events.find((event) => event.type === EventType.PieceOff);
    assert.equal(off.sheet.id, sheet.id);
    assert.ok(Math.abs(off.area - 0.02) < 1e-6 && off.frame && off.cut === null && off.crumb === false);
    const detached = off.frame.detachPiece();
    assert.deepEqual(world.getSheets().map((s) => s.id), [sheet.id, detached.id]);
    const piece = detached.getPiece(0);
    assert.ok(Math.abs(piece.area - 0.02) < 1e-6);
    assert.equal(piece.asleep, false);
}));

test("arguments are checked before the library sees them", () => inWorld((world) => {
    const sheet = square(world);
    assert.throws(() => sheet.beginCut([1, 2, 3]), RangeError);
    assert.throws(() => world.createSheet({ restPosition: [] }), /SheetDef has no restPosition/);
    assert.throws(() => sheet.createPin({ restPoint: [0] }), RangeError);
    throwsCode(() => sheet.createPin({ restPoint: [9, 9] }), ResultCode.ErrorArgument);
    throwsCode(() => world.setGravity([NaN, 0, 0]), ResultCode.ErrorArgument);
    assert.throws(() => world.setGravity([NaN, 0, 0]), { message: "World.setGravity: gravity[0] is NaN, not finite (ErrorArgument)" });
    assert.throws(() => sheet.getPoint([9, 9]), { message: /^Sheet\.getPoint: [^:]+ \(ErrorArgument\)$/ });
    assert.throws(() => kiri.fillRectangle(0, 1, 1, 1), { message: /^fillRectangle: [^:]+ \(ErrorArgument\)$/ });
    inWorld((other) => throwsCode(() => other.beginBlade(sheet), ResultCode.ErrorId));
}));

test("views are gone after the tick, and with the world", () => {
    const world = new World();
    const sheet = square(world, { collisionPoints: 8 });
    const mesh = sheet.getMesh();
    const points = sheet.getCollisionPoints();
    const events = world.getEvents();
    assert.equal(mesh.positions.length, 3 * mesh.vertexCount);
    assert.equal(mesh.positions, mesh.positions);
    assert.equal(points.array.length, 3 * 8);
    world.tick(1 / 60, 1);
    throwsCode(() => mesh.positions, ResultCode.ErrorState);
    throwsCode(() => points.array, ResultCode.ErrorState);
    throwsCode(() => events.at(0), ResultCode.ErrorState);
    assert.equal(sheet.getMesh(mesh), mesh);
    assert.equal(mesh.positions.length, 3 * mesh.vertexCount);
    world.destroy();
    world.destroy();
    throwsCode(() => mesh.positions, ResultCode.ErrorState);
    throwsCode(() => sheet.getMesh(), ResultCode.ErrorState);
    assert.equal(world.isAlive, false);
});

test("views outlive growth of the memory", () => inWorld((world) => {
    const mesh = square(world).getMesh();
    const before = mesh.positions, x = before[3];
    const buffer = kiri.wasm.memory.buffer;
    const large = world.createRectangle(0.2, 0.2, 160, 160);
    while (kiri.wasm.memory.buffer === buffer) {
        world.createRectangle(0.2, 0.2, 160, 160);
    }
    assert.equal(before.length, 0, "the old array is of no memory");
    assert.equal(mesh.positions[3], x);
    assert.ok(large.getMesh().vertexCount === 161 * 161);
}));

test("save, load", () => inWorld((world) => {
    const sheet = square(world);
    world.tick(1 / 60, 1);
    const base = world.save();
    const hash = world.getStateHash();
    inWorld((other) => {
        other.load(base);
        assert.equal(other.getSheets()[0].getCounts().pieces, 1);
        other.restore(world.snapshot());
        other.finishCuts();
        assert.equal(other.getStateHash(), hash);
        throwsCode(() => other.load(base.subarray(0, 100)), ResultCode.ErrorData);
        assert.equal(other.getStateHash(), hash);
    });
}));

test("a recording replays to the same hash, with its notes", () => {
    const parts = [];
    const hash = inWorld((world) => {
        const sheet = square(world);
        world.note(new Uint8Array([1, 2, 3]));
        cutAcross(sheet);
        for (let i = 0; i < 5; i++) {
            world.tick(1 / 60, 2);
        }
        return world.getStateHash();
    }, { record: (bytes) => parts.push(bytes) });
    const recording = new Uint8Array(Buffer.concat(parts));
    inWorld((world) => {
        const replay = new kiri.Replay(), notes = [];
        while (world.replay(recording, replay) === ResultCode.Pending) {
            if (replay.note) {
                notes.push(...replay.note);
            }
        }
        assert.deepEqual([replay.ticks, notes], [5, [1, 2, 3]]);
        assert.equal(world.getStateHash(), hash);
    });
});

test("hooks: a line for each error, a clock for the profile", () => {
    const lines = [];
    let seconds = 0;
    inWorld((world) => {
        const sheet = square(world);
        throwsCode(() => sheet.getPoint([7, 7]), ResultCode.ErrorArgument);
        assert.equal(lines.length, 1);
        world.tick(1 / 60, 1);
        assert.ok(world.getProfile().seconds.some((s) => s > 0));
    }, { log: (line) => lines.push(line), clock: () => seconds += 1e-3 });
});

test("weights, raycasts, contacts, obstacles and copies", () => inWorld((world) => {
    const sheet = square(world, { position: [0, 0, 1] });
    const { frames, weights, gradients } = sheet.getWeights([0.05, 0.05]);
    assert.equal(frames.length, weights.length);
    assert.equal(gradients.length, 2 * weights.length);
    assert.ok(Math.abs(weights.reduce((a, b) => a + b) - 1) < 1e-5);
    const { sheet: met, hit } = world.raycast([0.1, 0.1, 2], [0, 0, -1], 5);
    assert.equal(met.id, sheet.id);
    assert.ok(Math.abs(hit.distance - 1) < 1e-5);
    assert.equal(world.raycast([9, 9, 2], [0, 0, -1], 5).sheet, null);
    const buffer = new Float32Array(6 * 289);
    sheet.copyVertices(0, 289, buffer, 24, buffer.subarray(3), 24);
    assert.deepEqual([...buffer.subarray(0, 6)], [...sheet.getMesh().positions.subarray(0, 3), 0, 0, 1]);
    assert.deepEqual([...sheet.copyIndices16(0, 512)], [...sheet.getMesh().indices]);
    assert.deepEqual([...sheet.copySources(1, 2)], [1, 2]);
    assert.deepEqual([...sheet.copySourceWeights(1, 1)], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
    assert.equal(sheet.copyPrevious(0, 289).from.id, sheet.id);
    assert.equal(sheet.copyPrevious(0, 289).vertices.length, 289);
    const floor = world.createObstacle({ type: kiri.ObstacleType.Plane, position: [0, 0, 1] });
    sheet.setContacts([{ point: -1, restPoint: [0.1, 0.1], normal: [0, 0, 1], offset: 1.5, friction: 1 }]);
    world.tick(1 / 60, 2);
    assert.equal(sheet.getContactForces().length, 1);
    assert.ok(sheet.getContactForces().at(0).impulse[2] > 0);
    assert.ok(floor.getState().contacts >= 0);
    const { lower, upper } = sheet.getReach(1 / 60);
    assert.ok(lower[2] < upper[2]);
    const settings = sheet.getSettings();
    settings.skinning = kiri.Skinning.Smooth;
    sheet.setSettings(settings);
    assert.equal(sheet.getSettings().skinning, kiri.Skinning.Smooth);
    sheet.setUserData(2n ** 63n);
    assert.equal(sheet.getUserData(), 2n ** 63n);
}));

test("debug draw hands over vertices", () => inWorld((world) => {
    const sheet = square(world);
    let lines = 0, corners = 0;
    world.debugDraw({ sheet, flags: kiri.DrawFlag.All, lines: (vertices, colors, count) => {
        lines += count / 2;
        assert.ok(colors[3] >>> 24 === 255 && Math.abs(vertices[2]) < 1);
    }, triangles: (vertices, colors, count) => { corners += count; } });
    assert.ok(lines > 512 && corners >= 3 * 512);
}));

test("what calls cost", () => inWorld((world) => {
    const sheet = world.createRectangle(0.2, 0.2, 99, 99);
    const time = (count, work) => {
        work(count);
        const start = performance.now();
        work(count);
        return (performance.now() - start) / count;
    };
    const counts = sheet.getCounts(), mesh = new Mesh(), target = new Float32Array(30000);
    const call = time(2e5, (n) => { for (let i = 0; i < n; i++) { sheet.getCounts(counts); } });
    const copied = time(200, (n) => { for (let i = 0; i < n; i++) { target.set(sheet.getMesh(mesh).positions); } });
    let garbage = "not measured (node --expose-gc)";
    if (globalThis.gc) {
        const loop = (n) => { for (let i = 0; i < n; i++) { world.tick(1e-4, 1); sheet.getMesh(mesh).positions[0]; } };
        // The engine compiles what it runs at times of its own, and to look costs a few bytes too: the least of some rounds,
        // less a round of nothing, is what is left behind.
        const left = (n) => {
            gc();
            const before = process.memoryUsage().heapUsed;
            loop(n);
            return process.memoryUsage().heapUsed - before;
        };
        const least = (n) => Math.min(...Array.from({ length: 8 }, () => left(n)));
        const bytes = Math.max(0, least(300) - least(0)) / 300;
        garbage = `${bytes.toFixed(0)} bytes`;
        assert.ok(bytes < 1, garbage);
    }
    console.log(`getCounts ${(1e6 * call).toFixed(0)} ns; positions of 10 000 vertices into an array ` +
                `${(1e3 * copied).toFixed(1)} us; garbage of a tick and its mesh: ${garbage}`);
}));
