// The moving picture of the README: the first task of the page, played by script. node film.mjs PAGE PLAYWRIGHT PICTURES
// BROWSER writes pictures, 15 a second; `make web-film` joins them.

import { openBrowser } from "../../tests/browser.mjs";

const RATE = 15; // pictures a second
const TICKS = 60 / RATE;
const STROKE = 1.5; // s
const FIRST = 0.45; // of the first stroke: the film begins in it

const [page, playwright, pictures, browserPath] = process.argv.slice(2);
const browser = await openBrowser(page, playwright, pictures, browserPath);
let count = -1; // pictures so far; none is taken before 0

async function pass(tab, seconds, before = () => {}) {
    for (let i = 0; i < Math.round(seconds * RATE); i++) {
        await before((i + 1) / Math.round(seconds * RATE));
        await tab.evaluate((ticks) => {
            for (let i = 0; i < ticks; i++) {
                globalThis.game.step(1 / 60);
            }
            globalThis.game.show();
        }, TICKS);
        if (count >= 0) {
            await browser.picture(tab, `film_${String(count++).padStart(3, "0")}`);
        }
    }
}

const seen = (tab, at) => tab.evaluate((at) => {
    const { simulation, stage } = globalThis.game;
    return stage.windowOf(simulation.sheet.getPoint(at).position);
}, at);

async function cut(tab, starts = 0) {
    const way = await tab.evaluate(() => {
        const { points, first, need } = globalThis.game.task.trace;
        return Array.from({ length: need + 1 }, (_, i) => points[(first + i) % points.length]);
    });
    const at = (share) => seen(tab, way[Math.round(share * (way.length - 1))]);
    await tab.mouse.move(...await at(0));
    await tab.mouse.down();
    let from = 0;
    await pass(tab, STROKE, async (share) => {
        for (const part of [0.25, 0.5, 0.75, 1]) {
            await tab.mouse.move(...await at(from + part * (share - from)));
        }
        from = share;
        count = count < 0 && share >= starts ? 0 : count;
    });
    await tab.mouse.up();
    await tab.mouse.move(5, 5);
}

const tab = await browser.open("?still", { viewport: { width: 640, height: 400 } });
await tab.addStyleTag({ content: "#task, #dock, #more, #hint { display: none !important; }" });
await tab.evaluate(() => { // the same film on any machine
    const { simulation, stage } = globalThis.game;
    // More of the table than the page shows behind its buttons.
    stage.camera.setViewOffset(innerWidth, innerHeight, -0.06 * innerWidth, 0.04 * innerHeight, 1.12 * innerWidth, 1.12 * innerHeight);
    simulation.world.setBudget({});
    simulation.measure = () => {};
});
await pass(tab, 0.5);
await tab.evaluate(() => {
    while (globalThis.game.later.length) {
        globalThis.game.show();
    }
});
await cut(tab, FIRST);
await pass(tab, 1.4);
await cut(tab);
await pass(tab, 0.6);
await cut(tab);
await pass(tab, 2.4);
console.log(`${count} pictures`);
await browser.close();
