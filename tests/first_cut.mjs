import { World, fillRectangle, load } from "kiri";

await load();
const world = new World({ gravity: [0, 0, -9.81] });
const sheet = world.createSheet(fillRectangle(0.2, 0.2, 32, 32));
const cut = sheet.beginCut([0.1, -0.01]);
cut.extend([0.1, 0.21]);
cut.end();
world.tick(1 / 60, 2);
console.log(`${sheet.getCounts().pieces} pieces, ${sheet.getMesh().vertexCount} vertices`);
