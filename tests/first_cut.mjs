import { World, load } from "kiri";

await load();
const world = new World();
const sheet = world.createRectangle(0.2, 0.2);
const cut = sheet.beginCut([0.1, -0.01]);
cut.extend([0.1, 0.21]);
cut.end();
world.tick(1 / 60, 2);
console.log(`${sheet.getCounts().pieces} pieces, ${sheet.getMesh().vertexCount} vertices`);
