// What a finger does on the sheet. A tool has begin, move and end, with rays of the window, and `at`, where it is.

import { SIZE } from "./simulation.js";

const DEPTH = 0.1; // m: how far behind the sheet a blade reaches
const SNIP = 0.011; // m: of scissors
const PULL = 300; // N/m: of a hand that tears
const NOTCH = { near: 0.09, beside: 0.025, long: 0.045 }; // m from the border to the finger, from the finger to the notch; its length

const add = (a, b, by) => [a[0] + b[0] * by, a[1] + b[1] * by, a[2] + b[2] * by];

/** Follows the finger wherever it goes. */
export class Knife {
    constructor(game) {
        this.game = game;
    }

    begin(ray, hit) {
        this.length = hit.distance + DEPTH;
        this.blade = this.game.simulation.world.beginBlade();
        this.move(ray);
    }

    move({ origin, direction }) {
        this.blade.moveRay(origin, direction, this.length);
        this.at = add(origin, direction, this.length - DEPTH);
    }

    end() {
        this.blade.end();
    }
}

/** Cuts straight snips towards the finger. */
export class Scissors extends Knife {
    begin(ray, hit) {
        this.snipped = null;
        super.begin(ray, hit);
    }

    move(ray) {
        const to = add(ray.origin, ray.direction, this.length - DEPTH);
        const from = this.snipped, gone = from ? Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) : SNIP;
        if (gone >= SNIP) {
            this.snipped = to;
            super.move(ray);
            this.game.sound.snip();
            this.game.cutter.snip();
        }
    }
}

/** Holds the sheet by a pin, which follows the finger at the depth where it took it. */
export class Grab {
    constructor(game) {
        this.game = game;
    }

    /** N/m; 0: as the library has it. */
    get stiffness() {
        return 0;
    }

    begin(ray, hit) {
        this.distance = hit.distance;
        this.at = hit.position;
        this.pin = this.game.simulation.sheet.createPin({ restPoint: hit.restPoint, target: hit.position, stiffness: this.stiffness });
    }

    move({ origin, direction }) {
        this.pin.setTarget(this.at = add(origin, direction, this.distance));
    }

    end() {
        this.pin.destroy();
    }
}

/** Pulls at the sheet until it tears: from the ends of cuts, or from a notch that it makes where a finger takes the border. */
export class Tear extends Grab {
    begin(ray, hit) {
        const { sheet, options } = this.game.simulation;
        if (options.material.toughness) {
            sheet.setTearing({ toughness: options.material.toughness });
            this.notchFor = hit.restPoint;
        } else {
            this.game.panel.say("This sheet does not tear: cut it");
        }
        super.begin(ray, hit);
    }

    get stiffness() {
        return PULL;
    }

    move(ray) {
        const before = this.at[0];
        super.move(ray);
        if (this.notchFor && this.at[0] !== before) {
            this.notch(this.game.simulation.sheet, this.notchFor, Math.sign(before - this.at[0]));
            this.notchFor = null;
        }
    }

    /** From the nearest border but the upper one: above the finger, or on the side (1: right) that it goes away from. */
    notch(sheet, [u, v], away) {
        const { near, beside, long } = NOTCH, aside = Math.min(u, SIZE - u), inward = Math.sign(SIZE / 2 - u) || 1, border = inward > 0 ? 0 : SIZE;
        const along = aside < v ? [border, v + beside, inward, 0] : [u + beside * away, 0, 0, 1];
        if (Math.min(aside, v) < near && along[1] < SIZE) {
            const cut = sheet.beginCut([along[0] - 0.002 * along[2], along[1] - 0.002 * along[3]]);
            cut.extend([along[0] + long * along[2], along[1] + long * along[3]]);
            cut.end();
            if (along[2] === 0) { // the other hand holds the sheet beyond the notch; a side hangs from the rod
                const rest = [Math.min(SIZE, Math.max(0, along[0] + beside * away)), 0.004];
                this.other = sheet.createPin({ restPoint: rest, target: sheet.getPoint(rest).position });
            }
        }
    }

    end() {
        super.end();
        this.other?.destroy();
        const { sheet, options } = this.game.simulation;
        if (options.material.toughness) {
            sheet.setTearing({ toughness: 0 });
        }
    }
}

/** Cuts in the sheet itself, repeated six times around its middle and mirrored: as in folded paper. */
export class Snowflake {
    constructor(game, middle) {
        this.game = game;
        this.middle = middle;
    }

    begin(ray, hit) {
        this.copies = this.all(hit.restPoint).map((at) => this.game.simulation.sheet.beginCut(at));
        this.last = hit.restPoint;
        this.at = hit.position;
    }

    all([u, v]) {
        const x = u - this.middle, y = v - this.middle;
        return Array.from({ length: 12 }, (_, i) => {
            const angle = (i >> 1) * Math.PI / 3, c = Math.cos(angle), s = Math.sin(angle), m = i % 2 ? -x : x;
            return [this.middle + c * m - s * y, this.middle + s * m + c * y];
        });
    }

    move(ray) {
        const hit = this.game.simulation.meet(ray);
        const way = hit && Math.hypot(hit.restPoint[0] - this.last[0], hit.restPoint[1] - this.last[1]);
        if (!hit || way < 0.0015 || way > 0.08) {
            return;
        }
        this.last = hit.restPoint;
        this.at = hit.position;
        this.all(hit.restPoint).forEach((at, i) => this.copies[i].extend(at));
    }

    end() {
        this.copies.forEach((cut) => cut.end());
    }
}

/** Follows a closed line of the sheet as far as the finger goes along it, in both directions, and its copies around the
 *  middle with it. What the finger does beside the line does not matter. */
export class Guided {
    constructor(game, trace) {
        this.game = game;
        this.trace = trace;
    }

    begin(ray, hit) {
        this.hit(hit);
        this.cuts = null;
        this.move(ray);
    }

    hit(hit) {
        this.at = hit.position;
        return hit.restPoint;
    }

    move(ray) {
        const hit = this.game.simulation.meet(ray), points = hit ? this.trace.advance(this.hit(hit)) : [];
        for (const copies of points) {
            this.cuts ??= copies.map((at) => this.game.simulation.sheet.beginCut(at));
            copies.forEach((at, i) => this.cuts[i].extend(at));
        }
        this.done = this.trace.done; // and the hand lets go
    }

    end() {
        this.cuts?.forEach((cut) => cut.end());
    }
}
