// The host of babylon.js in a browser without a window: node tests/test_babylon.mjs PAGE PLAYWRIGHT PICTURES BROWSER.

import assert from "node:assert/strict";

import { openBrowser } from "./browser.mjs";

const browser = await openBrowser(...process.argv.slice(2));

const pass = (tab, ticks) => tab.evaluate((count) => {
    const { game } = globalThis;
    for (let i = 0; i < count; i++) {
        game.tick();
    }
    game.draw();
    return game.sheet.getCounts().pieces;
}, ticks);

/** The color in the picture where a rest position is. */
const colorAt = (tab, u, v) => tab.evaluate(([u, v]) => {
    const { game } = globalThis, { engine } = game, at = game.project(game.sheet.getPoint([u, v]).position);
    game.draw();
    const pixels = new Uint8Array(4), gl = engine._gl;
    gl.readPixels(at[0], engine.getRenderHeight() - at[1], 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return [...pixels.subarray(0, 3)];
}, [u, v]);

const seen = (tab, u, v) => tab.evaluate(([u, v]) => {
    const { game } = globalThis;
    return game.project(game.sheet.getPoint([u, v]).position);
}, [u, v]);

try {
    const tab = await browser.open();
    assert.equal(await pass(tab, 150), 1);
    await browser.picture(tab, "1_draped");

    // The cloth is drawn, with its print: the border is red, the sheet within is not.
    const border = await colorAt(tab, 0.3, 0.024), within = await colorAt(tab, 0.3, 0.1);
    assert.ok(border[0] > 1.5 * border[2], `border ${border}`);
    assert.ok(within[0] < 1.3 * within[2], `within ${within}`);

    // A corner comes off in two strokes from its middle, the view stays.
    const turned = () => tab.evaluate(() => globalThis.game.camera.alpha), alpha = await turned();
    const stroke = async (from, to) => { // a quick and straight one, past the border
        const start = await seen(tab, ...from), end = await seen(tab, ...to);
        const beyond = 1 + 70 / Math.hypot(end[0] - start[0], end[1] - start[1]); // of its length
        await tab.mouse.move(...start);
        await tab.mouse.down();
        for (let i = 1; i <= 5; i++) {
            await tab.mouse.move(...end.map((part, k) => start[k] + i / 5 * beyond * (part - start[k])), { steps: 2 });
            await pass(tab, 1);
        }
        await tab.mouse.up();
    };
    await stroke([0.405, 0.205], [0.203, 0.003]);
    await stroke([0.395, 0.195], [0.597, 0.397]);
    await pass(tab, 3);
    const areas = await tab.evaluate(() => {
        const { sheet } = globalThis.game;
        return Array.from({ length: sheet.getCounts().pieces }, (_, i) => sheet.getPiece(i).area).sort((a, b) => b - a);
    });
    assert.ok(areas[1] > 0.04, `a corner comes off, of ${areas[1]} m2`);
    assert.equal(await turned(), alpha);
    await browser.picture(tab, "2_cut");
    await pass(tab, 60);
    await browser.picture(tab, "3_fallen");

    // Beside the cloth a drag turns.
    await tab.mouse.move(60, 560);
    await tab.mouse.down();
    await tab.mouse.move(160, 560, { steps: 4 });
    await tab.mouse.up();
    await pass(tab, 1);
    assert.notEqual(await turned(), alpha);

    await tab.keyboard.press("d");
    await pass(tab, 0);
    assert.ok(await tab.evaluate(() => globalThis.game.lines.count) > 200, "frames and borders are lines");
    await browser.picture(tab, "4_debug");

    assert.deepEqual(browser.errors, []);
    console.log("babylon: a corner was cut off the cloth; all as it should be");
} catch (error) {
    console.error(browser.errors.join("\n"));
    throw error;
} finally {
    await browser.close();
}
