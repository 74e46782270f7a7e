// What a finger does on the sheet. A tool has begin, move and end, with rays of the window.

const DEPTH = 0.1; // m: how far behind the sheet a blade reaches
const SNIP = 0.011; // m: of scissors

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
    }

    end() {
        this.blade.end();
    }
}

/** Cuts straight snips towards the finger. */
export class Scissors extends Knife {
    begin(ray, hit) {
        this.at = null;
        super.begin(ray, hit);
    }

    move(ray) {
        const to = add(ray.origin, ray.direction, this.length - DEPTH);
        const gone = this.at ? Math.hypot(to[0] - this.at[0], to[1] - this.at[1], to[2] - this.at[2]) : SNIP;
        if (gone >= SNIP) {
            this.at = to;
            super.move(ray);
            this.game.sound.snip();
        }
    }
}

/** Holds the sheet by a pin, which follows the finger at the depth where it took it. */
export class Grab {
    constructor(game) {
        this.game = game;
    }

    begin(ray, hit) {
        this.distance = hit.distance;
        this.pin = this.game.simulation.sheet.createPin({ restPoint: hit.restPoint, target: hit.position });
    }

    move({ origin, direction }) {
        this.pin.setTarget(add(origin, direction, this.distance));
    }

    end() {
        this.pin.destroy();
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
        this.all(hit.restPoint).forEach((at, i) => this.copies[i].extend(at));
    }

    end() {
        this.copies.forEach((cut) => cut.end());
    }
}
