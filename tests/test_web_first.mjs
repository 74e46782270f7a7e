// What a visitor of the page sees first: the first task, the first stroke in each sheet, the pace of time. As
// tests/test_web.mjs.

import assert from "node:assert/strict";

import { openBrowser } from "./browser.mjs";

const browser = await openBrowser(...process.argv.slice(2));
const LEAST = 60; // of 255: how much darker or lighter a pixel of the line becomes, in the mean over the line
const WEAK = 25; // and at fewer than one in ten points less than this

const step = (tab, count = 1, rate = 60) => tab.evaluate(([count, rate]) => {
    for (let i = 0; i < count; i++) {
        globalThis.game.step(1 / rate);
    }
}, [count, rate]);

const draw = (tab) => tab.evaluate(() => {
    do {
        globalThis.game.show();
    } while (globalThis.game.later.length);
});

/** The same on a busy machine: no budget follows the clock. */
const ignoreClock = (tab) => tab.evaluate(() => {
    const { game } = globalThis;
    game.simulation.world.setBudget({});
    game.simulation.measure = () => {};
    game.most = Infinity;
});

/** Where a rest position is in the window. */
const seen = (tab, [u, v]) => tab.evaluate(([u, v]) => {
    const { simulation, stage } = globalThis.game;
    return stage.windowOf(simulation.sheet.getPoint([u, v]).position);
}, [u, v]);

/** Keeps the pixels of a picture, with what is in the hand left out. */
const keep = (tab, name) => tab.evaluate((name) => {
    const { game } = globalThis, gl = game.stage.renderer.getContext();
    game.show();
    for (const model of Object.values(game.cutter.models)) {
        model.visible = false;
    }
    game.stage.draw();
    const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight, pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    globalThis[name] = { width, height, pixels };
}, name);

/** By how much the brightest change of brightness within 2 pixels of the window is, at each of some places. */
const changes = (tab, places) => tab.evaluate((places) => {
    const { before: { pixels: was }, after: { width, height, pixels } } = globalThis, scale = width / innerWidth;
    const bright = (of, at) => 0.3 * of[at] + 0.6 * of[at + 1] + 0.1 * of[at + 2];
    return places.map(([x, y]) => {
        let most = 0;
        for (let dy = -2 * scale; dy <= 2 * scale; dy++) {
            for (let dx = -2 * scale; dx <= 2 * scale; dx++) {
                const at = 4 * (Math.round(x * scale + dx) + width * Math.round(height - 1 - (y * scale + dy)));
                most = Math.max(most, Math.abs(bright(pixels, at) - bright(was, at)));
            }
        }
        return most;
    });
}, places);

/** Two pictures after the blade has passed there is a line. */
async function strokeIsSeen(name, pixels) {
    const tab = await browser.open("?still&free", { viewport: { width: 700, height: 500 }, deviceScaleFactor: pixels });
    await tab.evaluate((sheet) => globalThis.game.restart({ sheet, hangs: "rod" }), name);
    await ignoreClock(tab);
    await step(tab, 40);
    await draw(tab);
    const way = Array.from({ length: 21 }, (_, i) => [0.06 + 0.18 * i / 20, 0.14 + 0.05 * Math.sin(i * 0.4)]);
    await keep(tab, "before");
    await tab.mouse.move(...await seen(tab, way[0]));
    await tab.mouse.down();
    for (const at of way.slice(1)) {
        await tab.mouse.move(...await seen(tab, at), { steps: 2 });
        await step(tab);
    }
    await step(tab, 2);
    await keep(tab, "after");
    await browser.picture(tab, `10_${name}_${pixels}`);
    const places = await Promise.all(way.slice(1, -1).map((at) => seen(tab, at)));
    const found = await changes(tab, places), mean = found.reduce((a, b) => a + b) / found.length;
    await tab.mouse.up();
    await tab.close();
    assert.ok(mean >= LEAST, `${name}: the line changes pixels by ${mean.toFixed(0)} of 255`);
    assert.ok(found.filter((change) => change < WEAK).length < found.length / 10, `${name}: gaps in the line: ${found.map(Math.round)}`);
    return mean;
}

/** A second has 60 ticks at each rate of pictures, and a quarter of a second of slow motion while a blade is down. */
async function paceIsEven(tab) {
    const hashes = new Set();
    for (const rate of [30, 60, 144]) {
        await tab.evaluate(() => globalThis.game.playFreely());
        await ignoreClock(tab);
        const told = await tab.evaluate(async (rate) => {
            const { game } = globalThis, { world } = game.simulation, tick = world.tick.bind(world);
            let time = 0, ticks = 0;
            world.tick = (dt, substeps) => { time += dt; ticks++; return tick(dt, substeps); };
            for (let i = 0; i < rate; i++) {
                game.step(1 / rate);
            }
            const second = { time, ticks, hash: world.getStateHash().toString() };
            time = ticks = 0;
            game.simulation.slow = true;
            for (let i = 0; i < rate; i++) {
                game.step(1 / rate);
            }
            game.simulation.slow = false;
            return [second, { time, ticks }];
        }, rate);
        const [second, slow] = told;
        assert.equal(second.ticks, 60, `ticks of a second at ${rate} Hz`);
        assert.ok(Math.abs(second.time - 1) < 1e-6);
        assert.ok(Math.abs(slow.time - 0.25) < 1 / 240, `${slow.time} s of slow motion at ${rate} Hz`);
        hashes.add(second.hash);
    }
    assert.equal(hashes.size, 1, "the same motion at each rate");
}

/** A frame whose first tick takes all that a frame has begins no other one: time goes slower. */
async function framesAreBounded(tab) {
    const ticks = await tab.evaluate(() => {
        const { game } = globalThis, before = game.simulation.ticks;
        game.most = 0;
        for (let i = 0; i < 30; i++) {
            game.step(1 / 30);
        }
        return game.simulation.ticks - before;
    });
    assert.equal(ticks, 30);
}

/** Follows the line, not exactly. back: begins at its end. */
async function follow(tab, { back = false, lift = false } = {}) {
    const way = await tab.evaluate(() => {
        const { points, first, need } = globalThis.game.task.trace;
        return Array.from({ length: 31 }, (_, i) => points[(first + Math.round(need * i / 30)) % points.length]);
    });
    const shaky = (back ? way.reverse() : way).map(([u, v], i) => [u + 0.004 * Math.sin(i), v + 0.004 * Math.cos(2 * i)]);
    await tab.mouse.move(...await seen(tab, shaky[0]));
    await tab.mouse.down();
    for (const [i, at] of shaky.entries()) {
        await tab.mouse.move(...await seen(tab, at), { steps: 2 });
        await step(tab);
        if (lift && i === 15) {
            await tab.mouse.up();
            await step(tab, 5);
            await tab.mouse.down();
        }
    }
    await tab.mouse.up();
}

/** The page begins with a line to cut along; three of them make an ornament, then all is free. */
async function taskEnds(tab, name) {
    const text = () => tab.evaluate(() => document.getElementById("task").innerText);
    assert.match(await text(), /Cut along the line/);
    await ignoreClock(tab);
    await step(tab, 20);
    await draw(tab);
    await browser.picture(tab, `${name}_0`);
    const pieces = () => tab.evaluate(() => globalThis.game.simulation.sheet.getCounts().pieces);
    for (const [i, [how, count]] of [[{}, 2], [{ back: true }, 8], [{ lift: true }, 14]].entries()) {
        await follow(tab, how);
        await step(tab, 60);
        await draw(tab);
        await browser.picture(tab, `${name}_${i + 1}`);
        assert.equal(await pieces(), count, `pieces after line ${i + 1}`);
    }
    assert.match(await text(), /Yours/);
    await step(tab, 120);
    assert.equal(await tab.evaluate(() => globalThis.game.stage.evening), 1, "it is evening");
    await tab.evaluate(() => [...document.querySelectorAll("#next button")].find((b) => b.textContent === "Cut freely").click());
    assert.equal(await pieces(), 1);
    assert.equal(await tab.evaluate(() => document.getElementById("task").hidden), true);
}

/** Before the library is there, a sheet is. */
async function posterIsSeen() {
    const tab = await browser.open("?still&free", undefined, () => {
        const { compileStreaming, instantiateStreaming } = WebAssembly;
        const note = (does) => (...given) => {
            const poster = document.getElementById("poster"), box = poster?.getBoundingClientRect();
            globalThis.poster = { width: box?.width ?? 0, visible: poster && getComputedStyle(poster).visibility };
            return does(...given);
        };
        WebAssembly.compileStreaming = note(compileStreaming);
        WebAssembly.instantiateStreaming = note(instantiateStreaming);
        WebAssembly.instantiate = note(WebAssembly.instantiate);
        WebAssembly.compile = note(WebAssembly.compile);
    });
    assert.deepEqual(await tab.evaluate(() => globalThis.poster), { width: 1000, visible: "visible" });
    assert.equal(await tab.evaluate(() => getComputedStyle(document.getElementById("poster")).visibility), "hidden");
    await tab.close();
}

try {
    const tab = await browser.open("?still", { viewport: { width: 1000, height: 640 } });
    await taskEnds(tab, "11_task");
    await paceIsEven(tab);
    await tab.evaluate(() => globalThis.game.playFreely());
    await framesAreBounded(tab);
    await tab.close();
    const phone = await browser.open("?still", { viewport: { width: 390, height: 780 }, isMobile: true, deviceScaleFactor: 2 });
    await taskEnds(phone, "12_phone");
    await phone.close();
    await posterIsSeen();
    const means = [];
    for (const name of ["washi", "paper", "cloth", "foil", "rubber"]) {
        for (const pixels of [1, 2]) {
            means.push(`${name} ${(await strokeIsSeen(name, pixels)).toFixed(0)}`);
        }
    }
    assert.deepEqual(browser.errors, []);
    console.log(`web: task, pace, poster; a line changes its pixels by, of 255: ${means.join(", ")}`);
} catch (error) {
    console.error(browser.errors.join("\n"));
    throw error;
} finally {
    await browser.close();
}
