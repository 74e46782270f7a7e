// The world: one sheet that hangs from a rod above a table, what holds it, and time. No drawing here.

import { ObstacleType, Profile, ResultCode, Skinning, Stage, World, fillRectangle, fitBudget, getQuality } from "kiri";

export const SIZE = 0.3; // m, of the sheet's sides
export const TICK = 1 / 60; // s
export const SLOW = 1 / 4; // of time, while a blade is down
export const LIFT = 0.075; // m, of the lower edge above the table
export const HIGH = 0.37; // m, of a sheet that lies flat
export const TIP = 0.284; // m, where a snowflake hangs
export const WALLS = { rod: -0.1, tip: -0.1, middle: -0.24 }; // m, z of the wall, by what a sheet hangs from
const COLUMNS = 64;
const BREEZE = [0.22, 0, -0.25]; // m/s: flat light looks like no sheet
const GUST = [0.3, 0, -1]; // m/s, for a moment after a cut: it opens lips and flaps, and lets pieces lean on the wall
const GUST_TICKS = 20;
const FOLDED = 1.1; // rad, of driven folds
const FOLDING = 1 / 150; // part of the way in a tick
const TEARING = { frameCount: 64, iterations: 4 }; // a tear goes from frame to frame
const CRUMB = 2e-6; // m^2
const CUTS = 3000, MOTION = 5000; // us of a tick that the budget allows
const MEASURED = 30; // ticks between two budgets
/** Until it was measured: items of a slow phone. */
const BUDGET = { triangles: 500, cells: 4000, samples: 600 };

/** Bits of the sides of the sheet that a rest position is on; of a disc there is one. */
export function borderOf(u, v, round) {
    const near = 1e-6;
    return round ? Number(Math.hypot(u - SIZE / 2, v - SIZE / 2) > SIZE / 2 - 2e-4)
        : Number(u < near) | Number(u > SIZE - near) << 1 | Number(v < near) << 2 | Number(v > SIZE - near) << 3;
}

export class Simulation {
    /** options: material (of materials.js), quality (0, 1, 2), hangs ("rod", "tip", "middle"), tears, def and mesh (where it is
     *  no square), origami (of patterns.js). record: gets bytes of the recording. */
    constructor(options, record) {
        this.options = options;
        this.quality = getQuality(options.quality);
        this.profile = new Profile();
        this.cuts = new Profile(); // sums, for the budget
        this.motion = new Profile();
        this.ticks = this.looks = 0;
        this.gust = 0; // ticks that are left of it
        this.cost = { milliseconds: 0, vertices: 0, weights: 0 };
        this.world = new World({ gravity: [0, -9.81, 0], clock: () => performance.now() / 1000, record, budget: BUDGET });
        this.pieces = 1;
        this.folded = this.toFold = 0; // part of the way from flat, and where the slider is
        this.slow = false;
    }

    /** A world without a sheet gets its own. One that is to be replayed gets it from the recording. */
    build() {
        const { mesh, origami } = this.options;
        this.world.createObstacle({ type: ObstacleType.Plane, rotation: [1, 0, 0, 0, 0, -1, 0, 1, 0], friction: 0.8 });
        this.world.createObstacle({ type: ObstacleType.Plane, position: [0, 0, WALLS[this.options.hangs]], friction: 0.5 });
        this.sheet = origami ? this.world.createFoldedSheet({ ...this.def(), ...fillRectangle(SIZE, SIZE, COLUMNS, COLUMNS) }, origami.folds)
            : mesh ? this.world.createSheet({ ...this.def(), ...mesh })
            : this.world.createRectangle(SIZE, SIZE, COLUMNS, COLUMNS, this.def());
        this.hold();
        this.blow(BREEZE);
    }

    /** What is cut off an ornament falls to the front, so that the wall is free. */
    blow([x, y, z]) {
        const velocity = [x, y, this.options.hangs === "tip" ? -z : z];
        this.sheet.setWind({ velocity, density: 1.2, drag: 1.2, lift: 0.02 });
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
            frameCount: along * along, crumbArea: 4e-5, ...(model === undefined ? {} : { model }), ...(this.options.tears ? TEARING : {}), ...this.options.def,
        };
    }

    hold() {
        const { hangs } = this.options, middle = SIZE / 2, arm = hangs === "tip" ? 0.003 : 0.008;
        if (this.options.origami) { // a facet
            const { frame } = this.sheet.getPoint([middle, middle]), { position, rotation } = frame.getState();
            frame.hold(position, rotation);
        } else if (hangs === "middle") {
            this.sheet.clampLine([middle - arm, middle], [middle + arm, middle]);
            this.sheet.clampLine([middle, middle - arm], [middle, middle + arm]);
        } else if (hangs === "tip") {
            this.sheet.clampLine([middle - arm, TIP], [middle + arm, TIP]);
        } else {
            this.sheet.hingeLine([0, SIZE], [SIZE, SIZE]);
        }
    }

    /** Seconds of the clock between two ticks. While a blade is down ticks are shorter, and come twice as often. */
    get period() {
        return this.slow ? TICK / 2 : TICK;
    }

    tick() {
        if (this.gust > 0 && --this.gust === 0) {
            this.blow(BREEZE);
        }
        this.fold();
        const { substeps } = this.quality;
        const result = this.world.tick(this.slow ? TICK / 2 * SLOW : TICK, this.slow ? Math.max(1, substeps >> 1) : substeps);
        this.pending = result === ResultCode.Pending; // work on a cut is left for the next tick
        this.look();
        this.measure();
    }

    /** Drives the folds by a small step towards the slider. */
    fold() {
        const step = Math.max(-FOLDING, Math.min(FOLDING, this.toFold - this.folded));
        if (step !== 0) {
            this.folded += step;
            const { folds, ways } = this.options.origami, half = Math.tan(0.5 * FOLDED * this.folded);
            ways.forEach((way, i) => this.sheet.setFold(i, folds[i].stiffness, 2 * Math.atan(way * half)));
        }
    }

    /** Ticks keep to a budget of items, which comes from what cuts and motion took so far on this device. */
    measure() {
        const add = (sum, from, to, ...items) => {
            for (const item of items) {
                sum[item] += this.profile[item];
            }
            for (let i = from; i < to; i++) {
                sum.seconds[i] += this.profile.seconds[i];
            }
        };
        add(this.cuts, Stage.Cut, Stage.Contact, "trianglesSplit", "cellsSettled", "samplesRefreshed");
        add(this.motion, Stage.Contact, Stage.Count, "solverIterations");
        if (++this.ticks % MEASURED === 0) {
            const budget = { ...BUDGET };
            fitBudget(this.cuts, CUTS, budget);
            if (!this.options.tears) { // a step that ends early holds the sheet still
                fitBudget(this.motion, MOTION, budget);
            }
            this.world.setBudget(budget);
        }
    }

    /** A breath of air, which opens what was cut. */
    breathe() {
        if (this.sheet) {
            this.blow(GUST);
            this.gust = GUST_TICKS;
        }
    }

    /** What the last tick did. */
    look() {
        this.looks++;
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
