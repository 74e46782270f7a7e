// Mouse, pen and fingers: one on the sheet uses the tool, one beside it turns the view, two turn and zoom.

const NEAR = 16; // pixels beside the sheet from which a cut may come in

export class Hand {
    constructor(canvas, game) {
        this.game = game;
        this.pointers = new Map();
        this.tool = null; // that is in use
        this.waiting = []; // rays since the last frame
        this.idle = false; // the tool is done, and the finger still down
        this.over = null; // where a mouse is, while no button is down
        canvas.addEventListener("pointerdown", (event) => this.down(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        for (const name of ["pointerup", "pointercancel"]) {
            canvas.addEventListener(name, (event) => this.up(event));
        }
        canvas.addEventListener("pointerleave", () => { this.over = null; });
        canvas.addEventListener("wheel", (event) => {
            event.preventDefault();
            game.stage.zoomBy(Math.exp(Math.sign(event.deltaY) * Math.min(60, Math.abs(event.deltaY)) * 0.002));
        }, { passive: false });
        canvas.addEventListener("contextmenu", (event) => event.preventDefault());
        this.canvas = canvas;
    }

    down(event) {
        this.canvas.setPointerCapture(event.pointerId);
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        this.game.sound.wake();
        if (this.pointers.size > 1) {
            const touched = this.tool && !this.last && !this.waiting.length;
            this.letGo();
            if (touched) {
                this.game.undos.pop(); // of an act that was none
            }
            return;
        }
        this.idle = false;
        const hit = event.button === 0 && !this.game.isReplaying && this.meet(event.clientX, event.clientY);
        if (hit) {
            this.game.beforeAct();
            this.tool = this.game.makeTool();
            this.game.attempt(() => this.tool.begin(this.game.stage.ray(event.clientX, event.clientY), hit));
        }
    }

    /** The sheet there, or a few pixels beside. */
    meet(x, y) {
        const { stage, simulation, grabs } = this.game;
        for (const [dx, dy] of grabs ? [[0, 0]] : [[0, 0], [NEAR, 0], [-NEAR, 0], [0, NEAR], [0, -NEAR]]) {
            const hit = simulation.meet(stage.ray(x + dx, y + dy));
            if (hit) {
                return hit;
            }
        }
        return null;
    }

    move(event) {
        const before = this.pointers.get(event.pointerId);
        if (!before) {
            this.over = event.pointerType === "mouse" ? [event.clientX, event.clientY] : null;
            return;
        }
        if (this.tool) {
            const all = event.getCoalescedEvents?.() ?? [];
            for (const { clientX, clientY } of all.length ? all : [event]) {
                this.waiting.push([clientX, clientY]);
            }
        } else if (this.idle) {
            // nothing
        } else if (this.pointers.size === 1) {
            this.game.stage.turnBy(event.clientX - before.x, event.clientY - before.y);
        } else {
            this.pinch(event, before);
        }
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    }

    pinch(event, before) {
        const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
        const was = Math.hypot(before.x - other.x, before.y - other.y);
        const is = Math.hypot(event.clientX - other.x, event.clientY - other.y);
        this.game.stage.zoomBy(was / Math.max(1, is));
        this.game.stage.turnBy((event.clientX - before.x) / 2, (event.clientY - before.y) / 2);
    }

    /** Before a tick: where the finger went since the last one. */
    reach() {
        let pixels = 0;
        if (this.tool) {
            for (const [x, y] of this.waiting) {
                pixels += this.last ? Math.hypot(x - this.last[0], y - this.last[1]) : 0;
                this.last = [x, y];
                this.game.attempt(() => this.tool.move(this.game.stage.ray(x, y)));
            }
            this.waiting.length = 0;
            // A blade stays in the sheet by being where it is.
            if (this.last && pixels === 0) {
                this.game.attempt(() => this.tool.move(this.game.stage.ray(...this.last)));
            }
        }
        return pixels;
    }

    up(event) {
        if (this.pointers.delete(event.pointerId)) {
            this.letGo();
        }
    }

    letGo() {
        const { tool } = this;
        this.idle = Boolean(tool?.done) && this.pointers.size > 0;
        if (tool) {
            this.reach();
            this.tool = null;
            this.game.attempt(() => tool.end());
            this.game.afterAct();
        }
        this.last = null;
        this.waiting.length = 0;
    }

    /** Where the tool is in the sheet, or where it would come in; null: nowhere. */
    point() {
        const { stage, simulation, isReplaying } = this.game, { tool } = this, at = tool ? this.last : this.over;
        const hit = at && !isReplaying && !tool?.pin ? simulation.meet(stage.ray(...at)) : null;
        return hit?.position ?? tool?.at ?? null;
    }
}
