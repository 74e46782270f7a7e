// Buttons, the task, and numbers for who asks for them.

import { USES } from "./paths.js";

const ICONS = {
    knife: "M4 20l4-1 11-11a2.1 2.1 0 0 0-3-3L5 16zM14 7l3 3",
    scissors: "M20 4 8.6 15.4M14.8 14.8 20 20M8.6 8.6 12 12M9 6a3 3 0 1 1-6 0 3 3 0 0 1 6 0zM9 18a3 3 0 1 1-6 0 3 3 0 0 1 6 0z",
    grab: "M8 12V6.5a1.5 1.5 0 0 1 3 0V11 5a1.5 1.5 0 0 1 3 0v6-4.5a1.5 1.5 0 0 1 3 0V14c0 4-2 7-5.5 7S7 19 5 15l-1-2a1.4 1.4 0 0 1 2.4-1.4L8 14",
    tear: "M5 3h14v7M5 3v18h4l-1-4 3-2-1-4 4-1M13 21l-1-3 3-2-1-3 5 1v7z",
    undo: "M9 7 4 12l5 5M4 12h10a6 6 0 0 1 6 6",
    fresh: "M6 3h8l4 4v14H6zM14 3v4h4",
};
const SWATCHES = { paper: "#f3ead8", cloth: "#7f9fbd", foil: "linear-gradient(135deg, #f6e1a4, #b98d35 55%, #f3dca0)", rubber: "#c2463a" };

function button(text, act, icon) {
    const made = document.createElement("button");
    made.innerHTML = icon ? `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[icon]}"/></svg>` : "";
    const label = document.createElement("span");
    label.textContent = text;
    made.append(label);
    made.addEventListener("click", act);
    return made;
}

/** A row of buttons of which one is pressed. */
function choice(where, names, chosen, act) {
    const buttons = Object.entries(names).map(([name, text]) => {
        const made = button(text, () => { press(name); act(name); }, ICONS[name] && name);
        made.dataset.name = name;
        made.style.setProperty("--swatch", SWATCHES[name] ?? "none");
        return made;
    });
    const press = (name) => buttons.forEach((b) => b.setAttribute("aria-pressed", b.dataset.name === name));
    press(chosen);
    where.append(...buttons);
    return press;
}

export class Panel {
    constructor(game) {
        this.game = game;
        const at = (id) => document.getElementById(id);
        this.pressTool = choice(at("tools"), { knife: "Knife", scissors: "Scissors", grab: "Grab", tear: "Tear" }, game.choice.tool,
            (name) => game.choose(name));
        this.pressSheet = choice(at("sheets"), { paper: "Paper", cloth: "Cloth", foil: "Foil", rubber: "Rubber" }, game.choice.sheet,
            (name) => game.restart({ sheet: name, hangs: "rod", folded: false }));
        at("main").append(button("Undo", () => game.undo(), "undo"),
            button("New sheet", () => game.restart({ sheet: game.choice.sheet === "washi" ? "paper" : game.choice.sheet, hangs: "rod", folded: false }), "fresh"));
        const again = button("Once more", () => game.startTask());
        again.className = "after";
        at("next").append(again, button("Cut freely", () => game.playFreely()));
        this.cost = at("cost");
        this.hint = at("hint");
        this.task = at("task");
        this.way = at("way");
        this.slider = at("quality");
        this.slider.value = game.choice.quality;
        this.slider.addEventListener("input", () => game.restart({ quality: Number(this.slider.value) }));
        this.fold = at("fold");
        this.fold.querySelector("input").addEventListener("input", ({ target }) => { game.simulation.toFold = target.value / 100; });
        const act = (text, does) => button(text, () => { at("more").open = false; does(); });
        at("acts").append(
            act("Cut along the line", () => game.startTask()), act("Cut freely", () => game.playFreely()),
            act("Snowflake", () => game.showSnowflake()), act("Lantern", () => game.showLantern()), act("Origami", () => game.showMiura()),
            act("Cut a file…", () => this.askFile()), act("Copy link", () => this.copyLink()),
            this.sound = button("Sound off", () => {
                game.sound.muted = !game.sound.muted;
                this.sound.lastChild.textContent = game.sound.muted ? "Sound on" : "Sound off";
            }));
        document.getElementById("view").addEventListener("pointerdown", () => { at("more").open = false; });
        addEventListener("keydown", (event) => {
            if (event.key === "z" && (event.ctrlKey || event.metaKey)) {
                game.undo();
            }
        });
        addEventListener("dragover", (event) => event.preventDefault());
        addEventListener("drop", (event) => {
            event.preventDefault();
            this.readFile(event.dataTransfer.files[0]);
        });
    }

    /** What is to do; null: nothing. step of steps are done. */
    showTask(says, more, step, steps) {
        this.task.hidden = !says;
        document.body.classList.toggle("task", Boolean(says));
        document.body.classList.toggle("ended", step === steps);
        this.way.hidden = true;
        if (says) {
            const [title, line, dots] = this.task.children;
            title.textContent = says;
            line.textContent = more;
            dots.replaceChildren(...Array.from({ length: steps }, (_, i) => {
                const dot = document.createElement("u");
                dot.className = i < step ? "done" : "";
                return dot;
            }));
        }
    }

    /** A ring goes along the line, as a finger would. */
    showWay(at) {
        this.way.hidden = !at;
        if (at) {
            const { simulation, stage } = this.game, [x, y] = stage.windowOf(simulation.sheet.getPoint(at).position);
            this.way.style.transform = `translate(${x}px, ${y}px)`;
        }
    }

    askFile() {
        const input = this.input = document.createElement("input"); // else it may be collected before a file is chosen
        input.type = "file";
        input.accept = ".svg,.dxf,.fold,image/svg+xml,image/vnd.dxf,application/json";
        input.addEventListener("change", () => this.readFile(input.files[0]));
        input.click();
    }

    async readFile(file) {
        if (file) {
            await this.game.cutFile(await file.text());
        }
    }

    /** The table of a drawing with several styles: a choice of use each. */
    showStyles(styles, choose) {
        const table = document.getElementById("styles");
        table.hidden = styles.length < 2;
        table.replaceChildren(...styles.map(({ name, use, count }) => {
            const row = document.createElement("label"), select = document.createElement("select");
            select.append(...USES.map((text, i) => new Option(text, i, i === use, i === use)));
            select.addEventListener("change", () => choose(name, Number(select.value)));
            row.style.setProperty("--swatch", name.slice(0, 7));
            row.append(`${name} (${count})`, select);
            return row;
        }));
    }

    async copyLink() {
        const link = await this.game.link();
        history.replaceState(null, "", link);
        await navigator.clipboard?.writeText(location.href).catch(() => {});
        this.say("Link copied: who opens it sees these cuts");
    }

    say(text) {
        this.hint.textContent = text;
        this.hint.classList.remove("gone");
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.hint.classList.add("gone"), 4000);
    }

    /** The slider of a sheet that folds. */
    showFold(folds) {
        this.fold.hidden = !folds;
        this.fold.querySelector("input").value = 0;
    }

    /** What the slider changes. */
    showQuality(simulation) {
        const { frames } = simulation.sheet ? simulation.sheet.getCounts() : { frames: 0 };
        const { gridResolution, substeps } = simulation.quality;
        document.getElementById("quality-says").textContent =
            `${frames} frames, ${gridResolution} x ${gridResolution} cells, ${substeps} steps a tick: bends right to ` +
            `${["2", "0.8", "0.4"][simulation.options.quality]}\u00a0%`;
        this.slider.value = simulation.options.quality;
    }

    showCost({ cost, pieces, milliseconds }) {
        const cut = cost.milliseconds ? `last cut ${cost.milliseconds.toFixed(1)} ms · ${cost.vertices} vertices · ${cost.weights} weights\n` : "";
        this.cost.textContent = `${cut}tick ${milliseconds.toFixed(1)} ms · ${pieces} ${pieces === 1 ? "piece" : "pieces"}`;
    }
}
