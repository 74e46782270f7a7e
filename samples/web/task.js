// The first task: lines on a sheet of paper that hangs by its tip. Who follows them has an ornament.

import { makeGuide } from "./print.js";
import { SIZE } from "./simulation.js";
import { Guided } from "./tools.js";

const COPIES = 6; // around the middle
const NEAR = 0.016; // m from the line to the finger
const AHEAD = 0.03; // m along the line that the finger may skip
const STEP = 0.0012; // m between points
const CLOSES = 0.95; // of the way: the rest is cut for the finger

const middle = SIZE / 2;

/** A closed line of points that are evenly apart. at: a function of 0 to 1. */
function line(at) {
    const fine = Array.from({ length: 4000 }, (_, i) => at(i / 4000)), points = [];
    let gone = STEP;
    fine.forEach(([u, v], i) => {
        const [p, q] = fine[(i + 3999) % 4000];
        gone += Math.hypot(u - p, v - q);
        if (gone >= STEP) {
            gone -= STEP;
            points.push([u, v]);
        }
    });
    return points;
}

/** A point, so many sixths around the middle. */
function turned([u, v], sixths) {
    const c = Math.cos(2 * Math.PI * sixths / COPIES), s = Math.sin(2 * Math.PI * sixths / COPIES), x = u - middle, y = v - middle;
    return [middle + c * x - s * y, middle + s * x + c * y];
}

const polar = (radius, angle) => [middle + middle * radius * Math.cos(angle), middle + middle * radius * Math.sin(angle)];

/** The border of the ornament: six petals, each with two small lobes. */
const border = line((t) => {
    const angle = 2 * Math.PI * t + Math.PI / 2;
    return polar(0.735 + 0.16 * Math.cos(6 * (angle - Math.PI / 2)) + 0.035 * Math.cos(18 * (angle - Math.PI / 2)), angle);
});

/** A leaf along a ray: its ends are at radii, and it is so wide. */
const leaf = (ray, from, to, width) => line((t) => {
    const s = t < 0.5 ? 2 * t : 2 - 2 * t, side = t < 0.5 ? 1 : -1;
    const r = from + (to - from) * s, w = side * width * Math.sin(Math.PI * s) ** 0.8 * (1 - 0.35 * s);
    const c = Math.cos(ray), d = Math.sin(ray);
    return [middle + middle * (r * c - w * d), middle + middle * (r * d + w * c)];
});

/** share: of a line that the finger cuts; copies do the rest. */
const STEPS = [
    { points: border, share: 1 / COPIES, start: 1 / 12 + 4 / 6, says: "Cut along the line", more: "Five more cuts follow yours" },
    { points: leaf(Math.PI / 6, 0.4, 0.76, 0.085), share: 1, start: 0, says: "Now a leaf", more: "All the way round" },
    { points: leaf(0, 0.2, 0.47, 0.075), share: 1, start: 0, says: "And the last one", more: "All the way round" },
];

/** How far a finger has gone along a line. */
class Trace {
    constructor({ points, share, start }) {
        this.points = points;
        this.need = Math.round(share * points.length);
        this.first = Math.round(start * points.length); // where the line is thick; a finger may begin elsewhere
        this.from = -1;
        this.way = 0; // 1 or -1 when it is known
        this.gone = 0;
    }

    get done() {
        return this.gone >= this.need;
    }

    index(i) {
        const { length } = this.points;
        return ((this.from + i) % length + length) % length;
    }

    /** The point and its copies. */
    copies(i) {
        return Array.from({ length: COPIES }, (_, k) => turned(this.points[this.index(i)], k));
    }

    away([u, v], i) {
        const [p, q] = this.points[this.index(i)];
        return Math.hypot(u - p, v - q);
    }

    /** The finger is at a point of the sheet, or at a copy of it. Gives the points that are cut now, each with its copies. */
    advance(at) {
        if (this.done) {
            return [];
        }
        if (this.from < 0) {
            this.begin(at);
            return [];
        }
        at = turned(at, this.turn);
        const ahead = Math.round(AHEAD / STEP);
        if (this.way === 0) {
            const near = this.nearest(at, -ahead, ahead);
            if (near === null || Math.abs(near) < 3) {
                return [];
            }
            this.way = Math.sign(near);
        }
        const to = this.nearest(at, this.way * this.gone, this.way * (this.gone + ahead));
        if (to === null || to * this.way <= this.gone) {
            return [];
        }
        let end = to * this.way;
        end = end >= CLOSES * this.need ? this.need : end;
        const cut = [];
        for (let i = this.gone === 0 || this.lifted ? this.gone : this.gone + 1; i <= end; i++) {
            cut.push(this.copies(this.way * i));
        }
        this.lifted = false;
        this.gone = end;
        return cut;
    }

    /** The finger may begin anywhere on the line, or on one of its copies. */
    begin(at) {
        for (let turn = 0; turn < COPIES; turn++) {
            const near = this.nearest(turned(at, turn), 1, this.points.length);
            if (near !== null) {
                this.from = this.index(near);
                this.turn = turn;
                return;
            }
        }
    }

    /** Which of some points is next to the finger: null where all are far. */
    nearest(at, from, to) {
        let best = null, least = NEAR;
        for (let i = Math.min(from, to); i <= Math.max(from, to); i++) {
            const away = this.away(at, i);
            if (away < least) {
                least = away;
                best = i;
            }
        }
        return best;
    }
}

export class Task {
    constructor(game) {
        this.game = game;
        this.step = 0;
        this.begin();
    }

    get ended() {
        return this.step >= STEPS.length;
    }

    begin() {
        const { game } = this, step = STEPS[this.step];
        this.trace = step ? new Trace(step) : null;
        game.skin.printFront(step ? makeGuide("washi", step.points, this.trace.first, this.trace.need, COPIES, middle) : null);
        game.panel.showTask(step ? step.says : "Yours, cut by hand", step ? step.more : "Now cut whatever you like", this.step, STEPS.length);
        if (!step) {
            game.stage.toEvening = 1;
        }
    }

    makeTool() {
        this.trace.lifted = true;
        return new Guided(this.game, this.trace);
    }

    /** After a stroke. */
    stroked() {
        if (this.trace?.done) {
            this.step++;
            this.game.sound.chime(this.step);
            this.begin();
        }
    }

    /** Where a finger that shows the way is, `time` s after the task began: a rest position, or null. */
    shows(time) {
        if (!this.trace || this.trace.gone > 0) {
            return null;
        }
        const part = Math.min(1, Math.max(0, time % 3.2 - 0.5) / 1.8), { first, need, points } = this.trace;
        return points[(first + Math.round(part * need)) % points.length];
    }
}
