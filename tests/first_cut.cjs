/* As tests/first_cut.mjs, in a file of CommonJS. */
const { World, load } = require("kiri");

load().then(() => {
    const world = new World();
    const sheet = world.createRectangle(0.2, 0.2, 32, 32);
    const cut = sheet.beginCut([0.1, -0.01]);
    cut.extend([0.1, 0.21]);
    cut.end();
    world.tick(1 / 60, 2);
    console.log(`${sheet.getCounts().pieces} pieces, ${sheet.getMesh().vertexCount} vertices`);
});
