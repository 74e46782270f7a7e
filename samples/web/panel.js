// Buttons, the slider, and the line about the last cut.

const button = (text, act) => {
    const made = document.createElement("button");
    made.textContent = text;
    made.addEventListener("click", act);
    return made;
};

/** A row of buttons of which one is pressed. */
function choice(where, names, chosen, act) {
    const buttons = Object.entries(names).map(([name, text]) => {
        const made = button(text, () => { press(name); act(name); });
        made.dataset.name = name;
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
        this.pressSheet = choice(at("sheets"), { paper: "Paper", cloth: "Cloth", foil: "Foil", rubber: "Rubber" }, game.choice.sheet,
            (name) => game.restart({ sheet: name }));
        this.pressTool = choice(at("tools"), { scissors: "Scissors", knife: "Knife", grab: "Grab" }, game.choice.tool,
            (name) => { game.choice.tool = name; });
        this.cost = at("cost");
        this.hint = at("hint");
        this.slider = at("quality");
        this.slider.value = game.choice.quality;
        this.slider.addEventListener("input", () => game.restart({ quality: Number(this.slider.value) }));
        at("acts").append(
            button("Undo", () => game.undo()), button("New sheet", () => game.restart({ hangs: "rod", folded: false })),
            button("Snowflake", () => game.showSnowflake()), button("Lantern", () => game.showLantern()),
            button("Cut a file…", () => this.askFile()), button("Copy link", () => this.copyLink()),
            this.sound = button("Sound off", () => {
                game.sound.muted = !game.sound.muted;
                this.sound.textContent = game.sound.muted ? "Sound on" : "Sound off";
            }));
        at("more").open = innerWidth > 720;
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

    askFile() {
        const input = document.createElement("input");
        input.type = "file";
        input.accept = ".svg,.fold,image/svg+xml,application/json";
        input.addEventListener("change", () => this.readFile(input.files[0]));
        input.click();
    }

    async readFile(file) {
        if (file) {
            this.game.attempt(this.game.cutFile.bind(this.game, await file.text()));
        }
    }

    async copyLink() {
        const link = await this.game.link();
        history.replaceState(null, "", link);
        await navigator.clipboard?.writeText(location.href).catch(() => {});
        this.say(`Link copied: ${(location.href.length / 1024).toFixed(0)} KB, plays the same bits anywhere`);
    }

    say(text) {
        this.hint.textContent = text;
        this.hint.classList.remove("gone");
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.hint.classList.add("gone"), 4000);
    }

    /** What the slider changes. */
    showQuality(simulation) {
        const { frames } = simulation.sheet ? simulation.sheet.getCounts() : { frames: 0 };
        const { gridResolution, substeps } = simulation.quality;
        document.getElementById("quality-says").textContent =
            `${frames} frames carry it, a grid of ${gridResolution}, ${substeps} substeps: error about ` +
            `${["2", "0.8", "0.4"][simulation.options.quality]}\u00a0%`;
        this.slider.value = simulation.options.quality;
    }

    showCost({ cost, pieces, milliseconds }) {
        const cut = cost.milliseconds ? `last cut ${cost.milliseconds.toFixed(1)} ms · ${cost.vertices} vertices · ${cost.weights} weights\n` : "";
        this.cost.innerText = `${cut}tick ${milliseconds.toFixed(1)} ms · ${pieces} ${pieces === 1 ? "piece" : "pieces"}`;
    }
}
