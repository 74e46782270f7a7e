// The page: a sheet hangs there, and a finger cuts it.

import { KiriError, Replay, ResultCode, load } from "kiri";

import { Cutter } from "./cutter.js";
import { Hand } from "./hand.js";
import { makeMaterials } from "./materials.js";
import { Panel } from "./panel.js";
import { readCuts } from "./paths.js";
import { disc, lantern, miura, snowflake } from "./patterns.js";
import { Tape, pack, unpack } from "./share.js";
import { SIZE, Simulation, TICK } from "./simulation.js";
import { Skin } from "./skin.js";
import { Sound } from "./sound.js";
import { Stage } from "./stage.js";
import { Task } from "./task.js";
import { Grab, Knife, Scissors, Snowflake, Tear } from "./tools.js";

const UNDOS = 24;
const MOST_TICK = 8, SLOW_TICKS = 20; // ms of a tick, and of all of a frame; ticks in turn that take longer: then the quality goes down
const MOST_BEHIND = 2 * TICK; // s: a device that is slower than this shows slow motion
const text = new TextEncoder();

class Game {
    choice = { sheet: "paper", tool: "knife", quality: 1, hangs: "rod", folded: false };
    sound = new Sound();
    undos = [];
    tools = { knife: Knife, scissors: Scissors, grab: Grab, tear: Tear };
    most = MOST_TICK; // ms of ticks in a frame
    behind = 0; // s that the world is behind the clock
    smooth = false; // pictures come more often than ticks: they show what is between two
    task = null;
    frames = 0;
    slowTicks = 0;
    later = []; // what the first picture does not show: made one a frame
    times = { simulation: 0, skin: 0, draw: 0 }; // ms of the last frame

    constructor(canvas) {
        this.stage = new Stage(canvas);
        this.materials = makeMaterials();
        this.panel = new Panel(this);
        this.hand = new Hand(canvas, this);
        this.cutter = new Cutter(this.stage.scene);
        addEventListener("resize", () => this.stage.resize());
    }

    /** No blade: a pin holds the sheet. */
    get grabs() {
        return this.choice.tool === "grab" || this.choice.tool === "tear";
    }

    get isReplaying() {
        return Boolean(this.replay);
    }

    makeTool() {
        if (this.task?.trace && !this.grabs) {
            return this.task.makeTool();
        }
        return this.choice.folded && !this.grabs ? new Snowflake(this, SIZE / 2) : new this.tools[this.choice.tool](this);
    }

    // ---- Worlds

    restart(changes = {}, special = {}) {
        Object.assign(this.choice, changes);
        this.replay = null;
        this.leaveTask();
        this.undos.length = 0;
        this.tape = new Tape();
        this.open(new Simulation({ ...this.options(), ...special }, this.tape.take));
        this.simulation.world.note(text.encode(JSON.stringify(this.choice)));
        this.simulation.build();
        this.panel.showQuality(this.simulation);
        this.show();
    }

    options() {
        const { quality, hangs, sheet, tool } = this.choice;
        return { material: this.materials[sheet], quality, hangs, tears: tool === "tear" && hangs === "rod" };
    }

    open(simulation) {
        this.simulation?.destroy();
        this.simulation = simulation;
        const look = this.materials[this.choice.sheet];
        if (this.skin) {
            this.stage.scene.remove(this.skin.mesh);
            this.skin.dispose();
        }
        const skin = this.skin = new Skin(look, this.stage, this.choice.hangs === "middle");
        this.later.push(() => skin.printBack());
        this.sound.look = look.sound;
        this.stage.hang(this.choice.hangs);
        this.stage.scene.add(this.skin.mesh);
        this.panel.pressSheet(this.choice.sheet);
        this.panel.showFold(Boolean(simulation.options.origami));
        this.panel.showStyles([]);
        this.behind = 0;
        this.seen = -1;
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
        if (!this.grabs) {
            this.simulation.dropCrumbs();
            this.simulation.breathe();
        }
        this.task?.stroked();
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

    /** uses: what lines of a style mean, where the user chose it. */
    async cutFile(content, uses = {}) {
        try {
            const { paths, styles, says } = await readCuts(content, SIZE, uses);
            if (paths.length) {
                this.cut(paths);
            }
            this.panel.say(says);
            this.panel.showStyles(styles, (name, use) => {
                if (paths.length) {
                    this.undo();
                }
                this.cutFile(content, { ...uses, [name]: use });
            });
        } catch (error) {
            this.panel.say(error.message);
        }
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

    /** To tear takes a sheet with more frames. */
    choose(tool) {
        this.choice.tool = tool;
        if (tool === "tear" && !this.simulation.options.tears && !this.isReplaying) {
            this.restart({ sheet: this.choice.sheet === "washi" ? "paper" : this.choice.sheet, hangs: "rod", folded: false });
            this.panel.say("Take the border, and pull");
        }
    }

    /** A sheet of card, which the slider folds. */
    showMiura() {
        this.restart({ sheet: "paper", tool: "knife", hangs: "middle", folded: false },
            { origami: miura(SIZE), def: { material: this.materials.card, frameCount: 25, iterations: 4 } });
        this.panel.pressTool("knife");
        this.panel.say("Fold it with the slider, and cut it");
    }

    /** The first task, in quality that this device has time for. */
    startTask() {
        this.restart({ sheet: "washi", tool: "knife", hangs: "tip", folded: false }, { def: { touchesSheets: 0 } });
        this.panel.pressTool("knife");
        this.task = new Task(this);
        this.taskTime = 0;
    }

    leaveTask() {
        if (this.task) {
            this.task = null;
            this.stage.toEvening = 0;
            this.panel.showTask(null);
        }
    }

    /** Free play, with a sheet as it hangs at the start. */
    playFreely() {
        this.restart({ sheet: "paper", hangs: "rod", folded: false });
        this.panel.say("Draw across the sheet to cut it");
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
        if (this.hand.tool?.done) {
            this.hand.letGo();
        }
        this.sound.cut(this.hand.tool && !this.grabs && this.choice.tool !== "scissors" ? pixels : 0);
        // Ticks are as long at each rate of pictures. One that comes a little late is not waited for. None begins where those of
        // this frame took all that a frame has for them: time goes slower then.
        const { simulation } = this, { period } = simulation;
        this.behind = Math.min(this.behind + seconds, MOST_BEHIND);
        const last = start + this.most;
        for (let ticks = 0; this.behind >= 0.9 * period && (ticks === 0 || performance.now() < last); ticks++, this.behind -= period) {
            if (this.isReplaying) {
                this.playTick();
            } else {
                simulation.tick();
            }
        }
        this.stage.pass(seconds);
        this.times.simulation = performance.now() - start;
    }

    show() {
        const start = performance.now();
        if (this.frames > 0) {
            this.later.shift()?.();
        }
        const { simulation } = this;
        if (simulation.sheet && (this.seen !== simulation.looks || this.skin.revision < 0)) {
            this.seen = simulation.looks;
            this.skin.take(simulation.sheet, simulation.sheet.getMesh(this.mesh).revision);
        }
        this.cutter.place(this.choice.tool, this.hand.point(), Boolean(this.hand.tool), this.stage.camera);
        this.skin.show(this.smooth ? Math.max(0, Math.min(1, this.behind / simulation.period)) : 1);
        const drawn = performance.now();
        this.stage.draw();
        this.times.skin = drawn - start;
        this.times.draw = performance.now() - drawn;
        if (++this.frames % 10 === 0) {
            this.panel.showCost(this.simulation);
        }
    }

    /** A device that is too slow for this quality gets a lower one: at once while nothing is cut, else with the next sheet. */
    adapt() {
        this.slowTicks = this.simulation.milliseconds > MOST_TICK ? this.slowTicks + 1 : 0;
        if (this.slowTicks < SLOW_TICKS || this.choice.quality === 0 || this.isReplaying) {
            return;
        }
        this.slowTicks = 0;
        this.choice.quality--;
        if (!this.undos.length) {
            this.task ? this.startTask() : this.simulation.options.origami ? this.showMiura() : this.restart();
        }
    }

    run() {
        let before = performance.now(), pace = TICK;
        const loop = (now) => {
            requestAnimationFrame(loop);
            const seconds = Math.max(0, now - before) / 1000;
            pace += 0.05 * (Math.min(seconds, TICK) - pace);
            this.smooth = pace < 0.85 * TICK;
            this.stage.spare(seconds);
            this.frame(seconds);
            this.adapt();
            if (this.task) {
                this.panel.showWay(this.task.shows(this.taskTime += seconds));
            }
            before = now;
        };
        requestAnimationFrame(loop);
    }
}

async function start() {
    await load(new URL("./kiri.wasm", import.meta.url));
    const game = globalThis.game = new Game(document.getElementById("view"));
    const packed = location.hash.slice(1), asked = new URLSearchParams(location.search);
    if (packed || asked.has("free")) {
        game.restart();
    } else {
        game.startTask();
    }
    game.later.push(() => game.stage.addSurroundings());
    if (packed) {
        await game.play(packed);
    }
    await game.stage.drawn();
    document.body.classList.add("opened");
    game.opened = performance.now();
    // Tests make their frames themselves.
    if (!asked.has("still")) {
        game.run();
    }
}

start().catch((error) => {
    console.error(error);
    document.getElementById("hint").textContent = `This browser cannot show it: ${error.message}`;
});
