// What fingers do on the page beside cutting: tools, files, touches, sound, buttons. As tests/test_web.mjs.

import assert from "node:assert/strict";

import { openBrowser } from "./browser.mjs";

const browser = await openBrowser(...process.argv.slice(2));
const frame = (tab, count = 1) => tab.evaluate((count) => {
    for (let i = 0; i < count; i++) {
        globalThis.game.step(1 / 60);
    }
}, count);
/** Until no cut waits for its work, which has a budget. */
const settle = (tab) => tab.evaluate(() => {
    let ticks = 0;
    do {
        globalThis.game.step(1 / 60);
    } while (globalThis.game.simulation.pending && ++ticks < 120);
    return ticks;
});
/** The same on a busy machine: no budget follows the clock. */
const ignoreClock = (tab) => tab.evaluate(() => {
    const { game } = globalThis;
    game.simulation.world.setBudget({});
    game.simulation.measure = () => {};
    game.most = Infinity;
});
const picture = async (tab, name) => {
    await tab.evaluate(() => {
        do {
            globalThis.game.show();
        } while (globalThis.game.later.length);
    });
    await browser.picture(tab, name);
};
const counts = (tab) => tab.evaluate(() => globalThis.game.simulation.sheet.getCounts());
const hint = (tab) => tab.evaluate(() => document.getElementById("hint").textContent);
const press = (tab, name) => tab.evaluate((name) => [...document.querySelectorAll("button")].find((b) => b.textContent === name).click(), name);

/** Where a rest position is in the window. */
const seen = (tab, u, v) => tab.evaluate(([u, v]) => {
    const { simulation, stage } = globalThis.game;
    return stage.windowOf(simulation.sheet.getPoint([u, v]).position);
}, [u, v]);

/** Areas of the pieces, largest first; m2. */
const areas = (tab) => tab.evaluate(() => {
    const { sheet } = globalThis.game.simulation;
    return Array.from({ length: sheet.getCounts().pieces }, (_, i) => sheet.getPiece(i).area).sort((a, b) => b - a);
});

async function drag(tab, points, steps = 4) {
    await tab.mouse.move(...points[0]);
    await tab.mouse.down();
    for (const point of points.slice(1)) {
        await tab.mouse.move(...point, { steps });
        await frame(tab);
    }
    await tab.mouse.up();
}

async function across(tab, v, from = 0.002, to = 0.298) {
    const points = [];
    for (let i = 0; i <= 10; i++) {
        points.push(await seen(tab, from + (to - from) * i / 10, v));
    }
    points.unshift([points[0][0] - 12, points[0][1]]);
    points.push([points.at(-1)[0] + 40, points.at(-1)[1]]);
    return points;
}

const near = (is, should, by, what) => assert.ok(Math.abs(is - should) < by, `${what}: ${is}, not ${should}`);

// ---- Files

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><g transform="translate(10 0)">
    <rect x="0" y="0" width="80" height="80"/><path d="M20 20h10v10h-10z M50 50h10v10h-10z"/></g></svg>`;
const FOLD = {
    file_spec: 1.1, vertices_coords: [[0, 0], [2, 0], [2, 1], [0, 1], [1, 0], [1, 1]],
    edges_vertices: [[0, 4], [4, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]],
    edges_assignment: ["B", "B", "B", "B", "B", "B", "M"],
};

/** Presses the button until its question comes: the first time the browser may not yet tell of it. */
async function askForFile(tab, left = 3) {
    const asked = tab.waitForEvent("filechooser", { timeout: 10000 }).catch((error) => { if (left === 0) throw error; });
    await press(tab, "Cut a file…");
    return await asked ?? askForFile(tab, left - 1);
}

/** A rect and two squares within, in 0.8 of the sheet's width. */
async function cutsSvg(tab) {
    await (await askForFile(tab)).setFiles({ name: "cut.svg", mimeType: "image/svg+xml", buffer: Buffer.from(SVG) });
    await tab.waitForFunction(() => globalThis.game.undos.length > 0);
    await settle(tab);
    const [rect, around, one, two, ...more] = await areas(tab);
    near(rect, (0.24 ** 2) * (1 - 2 / 64), 2e-4, "the rect without its holes");
    near(one, 0.03 ** 2, 2e-5, "a square");
    near(two, 0.03 ** 2, 2e-5, "the other");
    near(around, 0.3 ** 2 - 0.24 ** 2, 2e-4, "what is around");
    assert.deepEqual(more, []);
}

/** Borders are cut, mountains are not. */
async function cutsFold(tab) {
    await press(tab, "New sheet");
    await tab.evaluate((text) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([text], "cut.fold"));
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    }, JSON.stringify(FOLD));
    await tab.waitForFunction(() => globalThis.game.undos.length > 0);
    await settle(tab);
    const found = await areas(tab);
    assert.equal(found.length, 2, `pieces of ${found}`);
    near(found[1], 0.24 * 0.12, 1e-4, "the outline");
}

/** Sizes in mm are kept. A red line in a drawing with black ones is a fold, until the table says otherwise. */
async function cutsStyles(tab) {
    const text = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="120mm" viewBox="0 0 120 120" fill="none">
        <path d="M10 10h100v100h-100z" stroke="#000"/><path d="M0 60h120" stroke="#f00"/><text>a</text></svg>`;
    await press(tab, "New sheet");
    await tab.evaluate((text) => globalThis.game.panel.readFile(new File([text], "x")), text);
    await settle(tab);
    const [, square, ...none] = await areas(tab);
    near(square, 0.1 ** 2, 1e-4, "the square in its size");
    assert.deepEqual(none, []);
    assert.match(await hint(tab), /^1 cut; 1 fold left whole; left out: 1 x text$/);
    assert.equal(await tab.evaluate(() => document.querySelectorAll("#styles label").length), 2);
    await tab.evaluate(() => {
        const select = document.querySelectorAll("#styles select")[1];
        select.value = "1";
        select.dispatchEvent(new Event("change"));
    });
    await tab.waitForFunction(() => document.querySelectorAll("#styles select")[1].value === "1" && /^2 cuts/.test(document.getElementById("hint").textContent));
    await settle(tab);
    near((await areas(tab))[1], 0.1 * 0.05, 1e-4, "half of the square");
    await press(tab, "Undo");
}

async function refusesOthers(tab) {
    await press(tab, "New sheet");
    for (const [text, says] of [["{}", /FOLD/], ["<p>no</p>", /SVG/], ["{ \"a\"", /FOLD/], ["<svg xmlns='http://www.w3.org/2000/svg'/>", /no line/],
        ["0\nSECTION\n2\nHEADER\n0\nEOF\n", /ENTITIES/]]) {
        await tab.evaluate((text) => globalThis.game.panel.readFile(new File([text], "x")), text);
        assert.match(await hint(tab), says);
    }
    assert.equal((await counts(tab)).pieces, 1);
    assert.equal(await tab.evaluate(() => globalThis.game.undos.length), 0, "nothing to undo");
}

// ---- Tools

async function scissorsSnip(tab) {
    await press(tab, "Scissors");
    await tab.evaluate(() => globalThis.heard.length = 0);
    await drag(tab, await across(tab, 0.2), 8);
    await settle(tab);
    assert.equal((await areas(tab)).filter((area) => area > 1e-4).length, 2, "scissors part the sheet");
    const snips = await tab.evaluate(() => globalThis.heard.filter(([what]) => what === "start").length);
    assert.ok(snips >= 20 && snips <= 34, `${snips} snips of 11 mm along 300 mm`);
    await tab.keyboard.press("Control+z");
    assert.equal((await counts(tab)).pieces, 1);
}

/** The sheet is where the finger took it, and goes on without it. */
async function grabHolds(tab) {
    await press(tab, "Grab");
    const [x, y] = await seen(tab, 0.27, 0.03), pins = () => tab.evaluate(() => globalThis.game.simulation.sheet.getPins().length);
    const before = await pins();
    await tab.mouse.move(x, y);
    await tab.mouse.down();
    assert.equal(await pins(), before + 1);
    for (let i = 1; i <= 10; i++) {
        await tab.mouse.move(x + 6 * i, y - 8 * i);
        await frame(tab, 2);
    }
    await frame(tab, 20);
    const held = await seen(tab, 0.27, 0.03);
    near(held[0], x + 60, 12, "x of what is held");
    near(held[1], y - 80, 12, "y of what is held");
    assert.equal(await tab.evaluate(() => globalThis.game.simulation.slow), false, "time goes on as ever");
    await picture(tab, "8_grab");
    await tab.mouse.up();
    assert.equal(await pins(), before);
    await frame(tab, 20);
    const free = await seen(tab, 0.27, 0.03);
    assert.ok(Math.hypot(free[0] - held[0], free[1] - held[1]) > 20, "it swings back");
    assert.equal((await counts(tab)).pieces, 1);
}

/** A finger that takes the border makes a notch where it goes away from, and pulls a strip off. Rubber does not tear. */
async function fingerTears(tab) {
    for (const [sheet, from, way] of [["Cloth", [0.27, 0.05], [-5, 2]], ["Paper", [0.15, 0.01], [3, 3]], ["Paper", [0.27, 0.05], [-5, 2]]]) {
        await press(tab, sheet);
        await press(tab, "Tear");
        await ignoreClock(tab);
        const [x, y] = await seen(tab, ...from);
        await tab.mouse.move(x, y);
        await tab.mouse.down();
        await tab.mouse.move(x + way[0], y + way[1]);
        await frame(tab, 2);
        const { vertices } = await counts(tab);
        for (let i = 2; i <= 40; i++) {
            await tab.mouse.move(x + way[0] * i, y + way[1] * i);
            await frame(tab, 2);
        }
        const torn = (await counts(tab)).vertices - vertices;
        await picture(tab, "9_tear");
        await tab.mouse.up();
        assert.ok(torn > 30, `${sheet}: the notch goes on: ${torn} vertices of lips`);
    }
    await press(tab, "Rubber");
    await drag(tab, [await seen(tab, 0.27, 0.05), await seen(tab, 0.2, 0.05)]);
    assert.match(await hint(tab), /does not tear/);
}

/** While the knife is down ticks are an eighth as long, two a frame, and the cut is there in the frame of the finger's move. */
async function knifeIsSlow(tab) {
    await press(tab, "New sheet");
    await press(tab, "Knife");
    await tab.evaluate(() => {
        const { world } = globalThis.game.simulation, tick = world.tick;
        globalThis.steps = [];
        world.tick = (dt, substeps) => { globalThis.steps.push(dt); return tick.call(world, dt, substeps); };
    });
    const triangles = (await counts(tab)).triangles, way = await across(tab, 0.15, 0.002, 0.2);
    await tab.mouse.move(...way[0]);
    await tab.mouse.down();
    await tab.mouse.move(...way[3], { steps: 6 });
    await frame(tab);
    assert.ok((await counts(tab)).triangles > triangles, "the lip is where the finger is, in the same frame");
    const last = () => tab.evaluate(() => globalThis.steps.at(-1));
    near(await last(), 1 / 480, 1e-9, "s a tick while the blade is down");
    await tab.mouse.up();
    await frame(tab, 2);
    near(await last(), 1 / 60, 1e-9, "s a tick then");
    await tab.evaluate(() => globalThis.game.panel.showCost(globalThis.game.simulation));
    assert.match(await tab.evaluate(() => document.getElementById("cost").textContent),
        /last cut \d+\.\d ms · [1-9]\d* vertices · [1-9]\d* weights\s+tick \d+\.\d ms · 1 piece/);
}

/** Folded paper: one triangle drawn by hand leaves twelve holes, or less where two meet. */
async function foldedPaper(tab) {
    await press(tab, "Snowflake");
    await tab.evaluate(() => {
        const { game } = globalThis;
        game.restart({ sheet: "paper", hangs: "tip", folded: true }, { def: { touchesSheets: 0 } });
        game.simulation.world.setBudget({ triangles: 1500, cells: 20000, samples: 3000 }); // of a computer, whatever it does beside
        game.simulation.measure = () => {};
    });
    const at = (r, angle) => seen(tab, 0.15 + r * Math.cos(angle), 0.15 + r * Math.sin(angle));
    const points = [];
    for (const [r, angle] of [[0.05, 0.2], [0.09, 0.15], [0.09, 0.4], [0.05, 0.3], [0.055, 0.12]]) {
        points.push(await at(r, angle));
    }
    await drag(tab, points, 10);
    assert.ok(await settle(tab) < 30, "the budget lets the cut take effect soon");
    const holes = (await areas(tab)).filter((area) => area > 1e-4).length - 1;
    assert.equal(holes, 12);
}

// ---- Sound

/** What an AudioContext is told, in globalThis.heard: [what, value]. */
const listen = () => {
    const heard = globalThis.heard = [], { setTargetAtTime } = AudioParam.prototype, { start } = AudioBufferSourceNode.prototype;
    AudioParam.prototype.setTargetAtTime = function (value, ...rest) {
        heard.push([this.maxValue > 1e9 ? "gain" : "pitch", value]);
        return setTargetAtTime.call(this, value, ...rest);
    };
    AudioBufferSourceNode.prototype.start = function (...rest) {
        heard.push(["start", this.loop]);
        return start.apply(this, rest);
    };
};

/** Loud and high while the blade goes fast, nothing when it rests; rubber sounds lower than foil. */
async function knifeSounds(tab) {
    const pitches = {};
    for (const name of ["Foil", "Rubber"]) {
        await press(tab, name);
        await press(tab, "Knife");
        const sounds = async (pixels) => {
            await tab.evaluate(() => globalThis.heard.length = 0);
            await tab.mouse.move(x += pixels, y);
            await frame(tab);
            return Object.fromEntries(await tab.evaluate(() => globalThis.heard));
        };
        let [x, y] = await seen(tab, 0.05, 0.2);
        await tab.mouse.move(x, y);
        await tab.mouse.down();
        await sounds(4);
        const slow = await sounds(4), fast = await sounds(40), rest = await sounds(0);
        assert.ok(slow.gain > 0 && fast.gain > 2 * slow.gain, `${name}: ${slow.gain}, ${fast.gain}`);
        assert.ok(fast.pitch > slow.pitch);
        assert.equal(rest.gain, 0);
        pitches[name] = fast.pitch;
        await press(tab, "Sound off");
        assert.equal((await sounds(20)).gain, 0, "switched off");
        await press(tab, "Sound on");
        await tab.mouse.up();
    }
    assert.ok(pitches.Foil > 5 * pitches.Rubber);
    assert.equal(await tab.evaluate(() => globalThis.game.sound.context.state), "running");
}

// ---- Buttons

/** The slider says what it changes, and changes it. */
async function sliderTells(tab) {
    await press(tab, "Paper");
    const said = [], frames = [];
    for (const quality of [0, 1, 2]) {
        await tab.evaluate((quality) => {
            const slider = document.getElementById("quality");
            slider.value = quality;
            slider.dispatchEvent(new Event("input"));
        }, quality);
        said.push(await tab.evaluate(() => document.getElementById("quality-says").textContent));
        frames.push((await counts(tab)).frames);
        assert.ok(said.at(-1).startsWith(`${frames.at(-1)} frames`), said.at(-1));
    }
    assert.ok(frames[0] < frames[1] && frames[1] < frames[2], `frames ${frames}`);
    assert.equal(new Set(said).size, 3);
    await tab.evaluate(() => globalThis.game.restart({ quality: 1 }));
}

/** The origami is flat, and folds as far as its slider says. */
async function sliderFolds(tab) {
    const slide = (to) => tab.evaluate((to) => {
        const slider = document.querySelector("#fold input");
        slider.value = to;
        slider.dispatchEvent(new Event("input"));
    }, to);
    const angles = () => tab.evaluate(() => [0, 1, 10].map((i) => globalThis.game.simulation.sheet.getFold(i).angle));
    await press(tab, "Origami");
    await frame(tab, 10);
    assert.ok((await angles()).every((angle) => Math.abs(angle) < 0.05), "flat");
    for (const share of [100, 50]) {
        await slide(share);
        await frame(tab, 180);
        const zigzag = 0.011 * share, line = 2 * Math.atan(Math.tan(zigzag / 2) / Math.sqrt(5));
        (await angles()).forEach((angle, i) => assert.ok(Math.abs(angle - [-zigzag, line, zigzag][i]) < 0.05, `${share}: ${angle}`));
        await picture(tab, `origami_${share}`);
    }
    await press(tab, "New sheet");
    assert.ok(await tab.evaluate(() => document.getElementById("fold").hidden));
}

async function wheelZooms(tab) {
    const distance = () => tab.evaluate(() => globalThis.game.stage.turn.distance), before = await distance();
    await tab.mouse.move(500, 300);
    await tab.mouse.wheel(0, -120);
    await tab.waitForFunction((before) => globalThis.game.stage.turn.distance < before, before);
}

/** The button puts the run into the address; who opens it sees the run and may then cut on. */
async function linkPlays(tab) {
    await press(tab, "New sheet");
    await press(tab, "Knife");
    await drag(tab, await across(tab, 0.1));
    await settle(tab);
    const hash = await tab.evaluate(() => globalThis.game.simulation.world.getStateHash());
    await press(tab, "Copy link");
    await tab.waitForFunction(() => location.hash.length > 100);
    const other = await browser.open(`?still${await tab.evaluate(() => location.hash)}`);
    const ended = await other.evaluate(() => {
        const { game } = globalThis;
        for (let i = 0; i < 10000 && game.replay; i++) {
            game.step(1 / 60);
        }
        return game.finished.hash;
    });
    assert.equal(ended, hash.toString(16).padStart(16, "0"));
    await frame(other, 3);
    assert.ok((await counts(other)).pieces >= 2);
    await other.close();
}

// ---- Touches

async function touch([tab, session], type, ...points) {
    await session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    // The page gets moves before its next pictures.
    await tab.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** One finger cuts. A second one ends the cut; both zoom and turn, and cut nothing. */
async function fingers(tab) {
    const session = [tab, await tab.context().newCDPSession(tab)];
    const view = () => tab.evaluate(() => ({ ...globalThis.game.stage.turn })), way = await across(tab, 0.1);
    await touch(session, "touchStart", way[0]);
    for (const point of way.slice(1)) {
        await touch(session, "touchMove", point);
        await frame(tab);
    }
    await touch(session, "touchEnd");
    await settle(tab);
    assert.equal((await areas(tab)).filter((area) => area > 1e-4).length, 2, "a finger parts the sheet");

    const undos = () => tab.evaluate(() => globalThis.game.undos.length), acts = await undos();
    const before = await view(), { triangles } = await counts(tab), [x, y] = await seen(tab, 0.15, 0.2);
    await touch(session, "touchStart", [x, y]);
    await touch(session, "touchStart", [x, y], [x + 60, y + 60]);
    assert.equal(await tab.evaluate(() => globalThis.game.hand.tool), null, "the second finger ends the cut");
    for (let i = 1; i <= 6; i++) {
        await touch(session, "touchMove", [x - 8 * i, y - 8 * i], [x + 60 + 8 * i, y + 60 + 8 * i]);
        await frame(tab);
    }
    const zoomed = await view();
    near(zoomed.distance / before.distance, 60 / (60 + 96), 0.05, "fingers twice and a half as far apart");
    near(zoomed.around, before.around, 0.02, "a pinch does not turn");
    for (let i = 1; i <= 5; i++) {
        await touch(session, "touchMove", [x - 48 + 8 * i, y - 48], [x + 108 + 8 * i, y + 108]);
    }
    const turned = await view();
    near(turned.around - zoomed.around, -40 * 0.006, 0.02, "two that go along turn");
    near(turned.distance, zoomed.distance, 0.02, "and do not zoom");
    await touch(session, "touchEnd");
    await frame(tab, 2);
    assert.equal((await counts(tab)).triangles, triangles, "nothing was cut");
    assert.equal(await undos(), acts, "and nothing is to be undone");
    await picture(tab, "9_pinched");
}

try {
    const tab = await browser.open("?still&free", { viewport: { width: 1000, height: 640 } }, listen);
    await frame(tab, 20);
    for (const test of [cutsSvg, cutsFold, cutsStyles, refusesOthers, scissorsSnip, grabHolds, fingerTears, knifeIsSlow, foldedPaper, knifeSounds, sliderTells,
                        sliderFolds, wheelZooms, linkPlays]) {
        await test(tab);
        console.log(`web: ${test.name}`);
    }
    const phone = await browser.open("?still&free", { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true });
    await fingers(phone);
    console.log("web: fingers");
    assert.deepEqual(browser.errors, []);
} catch (error) {
    console.error(browser.errors.join("\n"));
    throw error;
} finally {
    await browser.close();
}
