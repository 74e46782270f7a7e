// The page: a sheet hangs there, and a finger cuts it.

import { KiriError, Replay, ResultCode, load } from "kiri";

import { Hand } from "./hand.js";
import { makeMaterials } from "./materials.js";
import { Panel } from "./panel.js";
import { readCuts } from "./paths.js";
import { disc, lantern, snowflake } from "./patterns.js";
import { Tape, pack, unpack } from "./share.js";
import { SIZE, Simulation, TICK } from "./simulation.js";
import { Skin } from "./skin.js";
import { Sound } from "./sound.js";
import { Stage } from "./stage.js";
import { Grab, Knife, Scissors, Snowflake } from "./tools.js";

const UNDOS = 24;
const text = new TextEncoder();

class Game {
    choice = { sheet: "paper", tool: "knife", quality: 1, hangs: "rod", folded: false };
    sound = new Sound();
    undos = [];
    tools = { knife: Knife, scissors: Scissors, grab: Grab };
    behind = 0; // s that the world is behind the clock
    frames = 0;
    later = []; // what the first picture does not show: made one a frame
    times = { simulation: 0, skin: 0, draw: 0 }; // ms of the last frame

    constructor(canvas) {
        this.stage = new Stage(canvas);
        this.materials = makeMaterials();
        this.panel = new Panel(this);
        this.hand = new Hand(canvas, this);
        addEventListener("resize", () => this.stage.resize());
    }

    get grabs() {
        return this.choice.tool === "grab";
    }

    get isReplaying() {
        return Boolean(this.replay);
    }

    makeTool() {
        return this.choice.folded && !this.grabs ? new Snowflake(this, SIZE / 2) : new this.tools[this.choice.tool](this);
    }

    // ---- Worlds

    restart(changes = {}, special = {}) {
        Object.assign(this.choice, changes);
        this.replay = null;
        this.undos.length = 0;
        this.tape = new Tape();
        this.open(new Simulation({ ...this.options(), ...special }, this.tape.take));
        this.simulation.world.note(text.encode(JSON.stringify(this.choice)));
        this.simulation.build();
        this.panel.showQuality(this.simulation);
        this.show();
    }

    options() {
        const { quality, hangs, sheet } = this.choice;
        return { material: this.materials[sheet], quality, hangs };
    }

    open(simulation) {
        this.simulation?.destroy();
        this.simulation = simulation;
        const look = this.materials[this.choice.sheet];
        if (this.skin) {
            this.stage.scene.remove(this.skin.mesh);
            this.skin.dispose();
        }
        const skin = this.skin = new Skin(look);
        this.later.push(() => skin.printBack());
        this.sound.look = look.sound;
        this.stage.hang(this.choice.hangs);
        this.stage.scene.add(this.skin.mesh);
        this.panel.pressSheet(this.choice.sheet);
        this.behind = 0;
    }

    // ---- What the host does

    /** What the library refuses is said, and changes nothing. */
    attempt(work) {
        try {
            return work();
        } catch (error) {
            if (!(error instanceof KiriError)) {
                this.panel.say(error.message);
                console.error(error);
            }
        }
    }

    beforeAct() {
        this.undos.push({ save: this.simulation.world.save(), recorded: this.tape.length });
        if (this.undos.length > UNDOS) {
            this.undos.shift();
        }
        this.simulation.slow = !this.grabs;
        this.panel.hint.classList.add("gone");
    }

    afterAct() {
        this.simulation.slow = false;
        this.simulation.dropCrumbs();
    }

    undo() {
        if (this.undos.length && !this.hand.tool && !this.isReplaying) {
            const { save, recorded } = this.undos.pop();
            this.simulation.world.load(save);
            this.tape.rewind(recorded);
            this.skin.revision = -1;
            this.simulation.look();
        }
    }

    cut(paths) {
        this.beforeAct();
        this.attempt(() => this.simulation.cut(paths));
        this.afterAct();
    }

    cutFile(content) {
        let paths;
        try {
            paths = readCuts(content, SIZE);
        } catch (error) {
            this.panel.say(error.message);
            return;
        }
        this.cut(paths);
    }

    showSnowflake() {
        this.restart({ sheet: "paper", hangs: "tip", folded: true }, { def: { touchesSheets: 0 } });
        this.cut(snowflake(SIZE));
        this.panel.say("Folded paper: each cut is made twelve times");
    }

    showLantern() {
        this.restart({ sheet: "paper", hangs: "middle", folded: false },
            { mesh: disc(SIZE), def: { frameCount: 80, maxFrames: 100 } });
        this.cut(lantern(SIZE));
    }

    // ---- Links

    async link() {
        return `#${await pack(this.tape.bytes())}`;
    }

    async play(packed) {
        this.recording = await unpack(packed);
        this.tape = new Tape();
        const simulation = new Simulation(this.options(), null);
        this.replay = new Replay();
        // The first note says what sheet it was.
        simulation.world.replay(this.recording, this.replay);
        if (this.replay.note) {
            Object.assign(this.choice, JSON.parse(new TextDecoder().decode(this.replay.note)));
        }
        this.open(simulation);
        this.panel.say("A recording: choose a sheet to cut your own");
    }

    /** One recorded tick. After the last one the world goes on by itself. */
    playTick() {
        const { world } = this.simulation, ticks = this.replay.ticks;
        while (this.replay && this.replay.ticks === ticks) {
            if (world.replay(this.recording, this.replay) !== ResultCode.Pending) {
                this.finished = { ticks: this.replay.ticks, hash: world.getStateHash().toString(16).padStart(16, "0") };
                this.replay = null;
            }
        }
        this.simulation.look();
    }

    // ---- Frames

    frame(seconds) {
        this.step(seconds);
        this.show();
    }

    /** What the hand did, and the ticks that are due. */
    step(seconds) {
        const start = performance.now();
        const pixels = this.hand.reach();
        this.sound.cut(this.hand.tool && !this.grabs && this.choice.tool !== "scissors" ? pixels : 0);
        // While a blade is down each picture has a tick of its own, so that the lip is where the finger is.
        this.behind = Math.min(this.behind + seconds, 2 * TICK);
        if (this.simulation.slow && !this.isReplaying) {
            this.simulation.tick();
            this.behind = 0;
        }
        for (; this.behind >= 0.9 * TICK; this.behind -= TICK) {
            if (this.isReplaying) {
                this.playTick();
            } else {
                this.simulation.tick();
            }
        }
        this.times.simulation = performance.now() - start;
    }

    show() {
        const start = performance.now();
        if (this.frames > 0) {
            this.later.shift()?.();
        }
        if (this.simulation.sheet) {
            this.skin.follow(this.simulation.sheet, this.simulation.sheet.getMesh(this.mesh).revision);
        }
        const drawn = performance.now();
        this.stage.draw();
        this.times.skin = drawn - start;
        this.times.draw = performance.now() - drawn;
        if (++this.frames % 10 === 0) {
            this.panel.showCost(this.simulation);
        }
    }

    run() {
        let before = performance.now();
        const loop = (now) => {
            requestAnimationFrame(loop);
            this.stage.spare((now - before) / 1000);
            this.frame(Math.max(0, now - before) / 1000);
            before = now;
        };
        requestAnimationFrame(loop);
    }
}

async function start() {
    await load(new URL("./kiri.wasm", import.meta.url));
    const game = globalThis.game = new Game(document.getElementById("view"));
    const packed = location.hash.slice(1);
    game.restart();
    game.later.push(() => game.stage.addSurroundings());
    if (packed) {
        await game.play(packed);
    }
    await game.stage.drawn();
    game.opened = performance.now();
    // Tests make their frames themselves.
    if (!new URLSearchParams(location.search).has("still")) {
        game.run();
    }
}

start().catch((error) => {
    console.error(error);
    document.getElementById("hint").textContent = `This browser cannot show it: ${error.message}`;
});
