// The world: one sheet that hangs from a rod above a floor, what holds it, and time. No drawing here.

import { ObstacleType, Profile, Skinning, Stage, World, getQuality } from "kiri";

export const SIZE = 0.3; // m, of the sheet's sides
export const TICK = 1 / 60; // s
export const SLOW = 1 / 4; // of time, while a blade is down
export const LIFT = 0.13; // m, of the lower edge above the floor
export const HIGH = 0.4; // m, of a sheet that lies flat
export const TIP = 0.284; // m, where a snowflake hangs
const COLUMNS = 64;
const BREEZE = [0.22, 0, 0.3]; // m/s: flat light looks like no sheet
const CRUMB = 2e-6; // m^2

export class Simulation {
    /** options: material (of materials.js), quality (0, 1, 2), hangs ("rod", "tip", "middle"), def and mesh (where it is
     *  no square). record: gets bytes of the recording. */
    constructor(options, record) {
        this.options = options;
        this.quality = getQuality(options.quality);
        this.profile = new Profile();
        this.cost = { milliseconds: 0, vertices: 0, weights: 0 };
        this.world = new World({ gravity: [0, -9.81, 0], clock: () => performance.now() / 1000, record });
        this.pieces = 1;
        this.slow = false;
    }

    /** A world without a sheet gets its own. One that is to be replayed gets it from the recording. */
    build() {
        const { mesh } = this.options;
        this.world.createObstacle({ type: ObstacleType.Plane, rotation: [1, 0, 0, 0, 0, -1, 0, 1, 0], friction: 0.8 });
        this.sheet = mesh ? this.world.createSheet({ ...this.def(), ...mesh })
            : this.world.createRectangle(SIZE, SIZE, COLUMNS, COLUMNS, this.def());
        this.hold();
        this.sheet.setWind({ velocity: BREEZE, density: 1.2, drag: 1.2, lift: 0.02 });
    }

    def() {
        const { material, model, iterations } = this.options.material;
        const along = this.quality.framesAlong + 1 >> 1;
        const flat = this.options.hangs === "middle";
        return {
            position: flat ? [-SIZE / 2, HIGH, SIZE / 2] : [-SIZE / 2, LIFT, 0],
            axisU: [1, 0, 0], axisV: flat ? [0, 0, -1] : [0, 1, 0],
            material, skinning: Skinning.Smooth, touchesSheets: 1, friction: 0.7, contactThickness: 1.2e-3,
            gridResolution: this.quality.gridResolution,
            iterations: Math.max(this.quality.iterations, iterations ?? 0),
            frameCount: along * along, crumbArea: 4e-5, ...(model === undefined ? {} : { model }), ...this.options.def,
        };
    }

    hold() {
        const { hangs } = this.options, middle = SIZE / 2, arm = hangs === "tip" ? 0.003 : 0.008;
        if (hangs === "middle") {
            this.sheet.clampLine([middle - arm, middle], [middle + arm, middle]);
            this.sheet.clampLine([middle, middle - arm], [middle, middle + arm]);
        } else if (hangs === "tip") {
            this.sheet.clampLine([middle - arm, TIP], [middle + arm, TIP]);
        } else {
            this.sheet.hingeLine([0, SIZE], [SIZE, SIZE]);
        }
    }

    /** One step: of slow motion while a blade is down. */
    tick() {
        this.world.tick(this.slow ? TICK * SLOW : TICK, this.quality.substeps);
        this.look();
    }

    /** What the last tick did. */
    look() {
        this.world.getProfile(this.profile);
        for (const sheet of this.world.getSheets()) {
            this.sheet = sheet;
        }
        this.pieces = this.sheet ? this.sheet.getCounts().pieces : 0;
        const p = this.profile;
        if (p.commits > 0) {
            this.cost.milliseconds = 1000 * p.seconds.slice(Stage.Cut, Stage.Contact).reduce((a, b) => a + b);
            this.cost.vertices = p.verticesChanged;
            this.cost.weights = p.weightsChanged;
            this.cost.segments = p.cutSegments;
        }
    }

    get milliseconds() {
        return 1000 * this.profile.seconds.reduce((a, b) => a + b);
    }

    /** Cuts along polylines of the rest plane: arrays of numbers u, v, u, v... */
    cut(paths) {
        for (const path of paths) {
            const cut = this.sheet.beginCut(path.slice(0, 2));
            cut.extend(path.slice(2));
            cut.end();
        }
    }

    dropCrumbs() {
        if (this.pieces > 1) {
            this.sheet.dropCrumbs(CRUMB);
        }
    }

    /** Where a ray meets the sheet: a hit of the library, or null. */
    meet({ origin, direction }) {
        const { sheet, hit } = this.world.raycast(origin, direction, 100);
        return sheet ? hit : null;
    }

    destroy() {
        this.world.destroy();
    }
}
