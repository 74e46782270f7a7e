// The page in a browser without a window: node tests/test_web.mjs PAGE PLAYWRIGHT PICTURES BROWSER. Prints what a frame
// takes, and writes pictures.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

import { openBrowser } from "./browser.mjs";

const [page, playwright, pictures, browserPath] = process.argv.slice(2);
const browser = await openBrowser(page, playwright, pictures, browserPath);
const { open, picture, errors } = browser;

/** Ticks of the page by hand: pictures of a slow machine are then those of a fast one. */
const pass = (tab, ticks) => tab.evaluate((count) => {
    const { game } = globalThis;
    for (let i = 0; i < count; i++) {
        game.simulation.tick();
    }
    game.show();
    while (game.later.length) {
        game.show();
    }
    game.panel.showCost(game.simulation);
}, ticks);

/** Where a rest position is in the window. */
const seen = (tab, u, v) => tab.evaluate(([u, v]) => {
    const { simulation, stage } = globalThis.game;
    const at = stage.target.clone().fromArray(simulation.sheet.getPoint([u, v]).position).project(stage.camera);
    return [(at.x + 1) / 2 * innerWidth, (1 - at.y) / 2 * innerHeight];
}, [u, v]);

/** Until no cut waits for its work, which has a budget. */
const settle = (tab) => tab.evaluate(() => {
    let ticks = 0;
    do {
        globalThis.game.step(1 / 60);
    } while (globalThis.game.simulation.pending && ++ticks < 120);
});

/** The same picture on a busy machine: no budget follows the clock. */
const ignoreClock = (tab) => tab.evaluate(() => {
    const { simulation } = globalThis.game;
    simulation.world.setBudget({});
    simulation.measure = () => {};
});

/** points: of the window, or of the rest plane, which moves: then they are where they are when the hand is there. */
async function drag(tab, points, steps = 6, rest = false) {
    const at = (point) => rest ? seen(tab, ...point) : point;
    await tab.mouse.move(...await at(points[0]));
    await tab.mouse.down();
    for (const point of points.slice(1)) {
        await tab.mouse.move(...await at(point), { steps });
        await tab.evaluate(() => globalThis.game.step(1 / 60));
    }
    await tab.mouse.up();
    await settle(tab);
}

const pieces = (tab) => tab.evaluate(() => globalThis.game.simulation.sheet.getCounts().pieces);

try {
    // The page says that it is open when the first picture is there, and makes the rest after that.
    const tab = await open("?still&free", { viewport: { width: 1000, height: 640 } }, () => {
        const of = WebGL2RenderingContext.prototype, wait = of.clientWaitSync;
        globalThis.waits = [];
        of.clientWaitSync = function (...given) {
            globalThis.waits.push(Boolean(globalThis.game.opened));
            return globalThis.waits.length < 4 ? this.TIMEOUT_EXPIRED : wait.apply(this, given);
        };
    });
    const [opened, waits, later] = await tab.evaluate(() => [game.opened, globalThis.waits, game.later.length]);
    assert.ok(waits.length >= 4 && !waits.includes(true), `opened while it waits: ${waits}`);
    assert.equal(later, 2, "the back and the surroundings are made later");
    await picture(tab, "0_first");
    await pass(tab, 60);
    await picture(tab, "1_opened");

    // A drag across parts the sheet.
    const across = [];
    for (let i = 0; i <= 12; i++) {
        across.push(await seen(tab, 0.003 + 0.294 * i / 12, 0.1 + 0.05 * Math.sin(i)));
    }
    across.unshift([across[0][0] - 12, across[0][1]]);
    across.push([across.at(-1)[0] + 30, across.at(-1)[1]]);
    await drag(tab, across);
    await pass(tab, 12);
    assert.equal(await pieces(tab), 2, "a drag from side to side makes two pieces");
    await picture(tab, "2_cut");

    // A circle drawn by hand falls out.
    const circle = [];
    for (let i = 0; i <= 24; i++) {
        circle.push([0.15 + 0.05 * Math.cos(i * Math.PI / 12), 0.22 + 0.04 * Math.sin(i * Math.PI / 12)]);
    }
    await drag(tab, circle, 3, true);
    await pass(tab, 90);
    assert.equal(await pieces(tab), 3, "a circle comes off");
    await picture(tab, "3_pieces");

    // Undo brings it back; beside the sheet the view turns.
    await tab.evaluate(() => globalThis.game.undo());
    assert.equal(await pieces(tab), 2, "undo takes the last cut back");
    const before = await tab.evaluate(() => globalThis.game.stage.turn.around);
    await drag(tab, [[60, 560], [160, 560]]);
    assert.notEqual(await tab.evaluate(() => globalThis.game.stage.turn.around), before, "a drag beside the sheet turns");

    // Sheets.
    for (const name of ["cloth", "foil", "rubber"]) {
        await tab.evaluate((name) => globalThis.game.restart({ sheet: name }), name);
        await pass(tab, 20);
        const way = [];
        for (let i = 0; i <= 10; i++) {
            way.push([0.3 * (0.2 + 0.06 * i), 0.15 + 0.06 * Math.cos(0.6 * i)]);
        }
        await drag(tab, way, 6, true);
        await pass(tab, 40);
        await picture(tab, `4_${name}`);
    }
    await tab.evaluate(() => globalThis.game.showSnowflake());
    await ignoreClock(tab);
    await pass(tab, 200);
    await picture(tab, "5_snowflake");
    await tab.evaluate(() => globalThis.game.showLantern());
    await ignoreClock(tab);
    await pass(tab, 260);
    await picture(tab, "6_lantern");

    // What a frame takes at 4225 vertices.
    await tab.evaluate(() => globalThis.game.restart({ sheet: "paper", hangs: "rod", folded: false }));
    const median = await tab.evaluate(() => {
        const { game } = globalThis, rows = [];
        for (let i = 0; i < 60; i++) {
            game.frame(1 / 60);
            rows.push({ ...game.times });
        }
        const of = (name) => rows.map((row) => row[name]).sort((a, b) => a - b)[30].toFixed(1);
        return `${game.simulation.sheet.getCounts().vertices} vertices: simulation ${of("simulation")} ms, ` +
            `buffers ${of("skin")} ms, calls of WebGL ${of("draw")} ms`;
    });

    // A link plays to the same hash.
    await drag(tab, [[0.05, 0.2], [0.25, 0.25]], 10, true);
    await pass(tab, 5);
    await tab.evaluate(() => globalThis.game.undo());
    await drag(tab, [[0.05, 0.1], [0.25, 0.15]], 10, true);
    await pass(tab, 10);
    const recording = await tab.evaluate(() => [...globalThis.game.tape.bytes()]);
    const [link, hash] = await tab.evaluate(async () => [await globalThis.game.link(),
        globalThis.game.simulation.world.getStateHash().toString(16).padStart(16, "0")]);
    const other = await open(`?still${link}`);
    const played = await other.evaluate(() => {
        const { game } = globalThis;
        while (game.replay) {
            game.playTick();
        }
        return game.finished.hash;
    });
    assert.equal(played, hash, "a link ends in the same state");
    writeFileSync(join(pictures, "recording"), new Uint8Array(recording));
    writeFileSync(join(pictures, "hash"), hash);

    // A phone.
    const phone = await open("?still&free", { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true });
    await pass(phone, 30);
    await picture(phone, "7_phone");

    assert.deepEqual(errors, []);
    console.log(`web: opened after ${opened.toFixed(0)} ms; ${median}; a link of ${link.length} characters; all as it should be`);
} catch (error) {
    console.error(errors.join("\n"));
    throw error;
} finally {
    await browser.close();
}
