// A cloth falls over a ball of babylon.js. A drag on the cloth cuts it, one beside it turns the view; D shows the frames.

import { Matrix, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { MaterialPreset, ObstacleType, Skinning, World, getMaterial, load } from "kiri";

import { DebugLines } from "./debug_lines.js";
import { SheetMesh } from "./sheet_mesh.js";
import { makeStage } from "./stage.js";

const TICK = 1 / 60; // s
const BUDGET = { cells: 32000, samples: 4000 }; // of work on cuts in a tick: about 2 ms
const SIZE = 0.6; // m
const BALL = { radius: 0.15, position: [0, 0.32, 0] }; // m
const REACH = 0.16; // m: how far a blade reaches behind where it meets the cloth

class Game {
    constructor(canvas) {
        Object.assign(this, makeStage(canvas, BALL, SIZE)); // engine, scene, camera, cloth, shadows
        this.world = new World({ gravity: [0, -9.81, 0] });
        this.world.createObstacle({ type: ObstacleType.Plane, rotation: [1, 0, 0, 0, 0, -1, 0, 1, 0], friction: 0.7 });
        this.world.setBudget(BUDGET);
        this.world.createObstacle({ type: ObstacleType.Sphere, ...BALL, friction: 0.6 });
        this.sheet = this.world.createRectangle(SIZE, SIZE, 64, 64, {
            position: [-SIZE / 2, 0.52, SIZE / 2], axisU: [1, 0, 0], axisV: [0, 0, -1],
            material: getMaterial(MaterialPreset.Cotton), frameCount: 64, skinning: Skinning.Smooth, contactThickness: 3e-3, friction: 0.6,
            touchesSheets: 1,
        });
        this.mesh = new SheetMesh(this.scene, this.sheet, this.cloth);
        this.shadows.addShadowCaster(this.mesh.mesh);
        this.lines = new DebugLines(this.scene, this.world);
        this.scene.onPointerObservable.add(({ event }) => this.pointer(event));
        addEventListener("keydown", ({ key }) => key === "d" && this.lines.toggle());
    }

    /** While it is down, the blade is the ray under the pointer. */
    pointer({ type, offsetX, offsetY }) {
        const { origin: o, direction: d } = this.scene.createPickingRay(offsetX, offsetY, null, this.camera);
        const origin = [o.x, o.y, o.z], direction = [d.x, d.y, d.z];
        if (type === "pointerdown") {
            const { sheet, hit } = this.world.raycast(origin, direction, 10);
            if (sheet) {
                this.camera.detachControl();
                this.reach = hit.distance + REACH;
                this.blade = this.world.beginBlade();
            }
        }
        this.blade?.moveRay(origin, direction, this.reach);
        if (type === "pointerup" && this.blade) {
            this.blade.end();
            this.blade = null;
            this.camera.attachControl();
        }
    }

    tick() {
        this.world.tick(TICK, 2);
    }

    draw() {
        this.mesh.follow();
        this.lines.follow();
        this.scene.render();
    }

    /** Where a point of the world is in the window. */
    project(position) {
        const { engine, scene, camera } = this, view = camera.viewport.toGlobal(engine.getRenderWidth(), engine.getRenderHeight());
        const at = Vector3.Project(Vector3.FromArray(position), Matrix.Identity(), scene.getTransformMatrix(), view);
        return [at.x, at.y];
    }

    run() {
        let behind = 0;
        this.engine.runRenderLoop(() => {
            behind = Math.min(behind + this.engine.getDeltaTime() / 1000, 2 * TICK);
            for (; behind >= 0.9 * TICK; behind -= TICK) {
                this.tick();
            }
            this.draw();
        });
    }
}

await load(new URL("./kiri.wasm", import.meta.url));
const game = globalThis.game = new Game(document.getElementById("view"));
game.draw();
game.opened = true;
if (!location.search.includes("still")) { // a test makes its frames itself
    game.run();
}
