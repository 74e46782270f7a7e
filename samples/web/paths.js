// Drawings to cut: SVG, DXF and FOLD, read by samples/import.c. Its WebAssembly loads with the first file.

const TOLERANCE = 0.02, MEET = 0.05; // mm: of curves; of ends that are joined
const LARGEST = 0.96, FITTED = 0.8; // of the sheet's width: a drawing with units; one without, or a larger one

/** What a line may mean, by number. */
export const USES = ["nothing", "cut", "mountain", "valley", "score"];
const CUT = USES.indexOf("cut");

let loading;

async function load() {
    const unused = new Proxy({}, { get: () => () => 0 });
    const imports = new Proxy({}, { get: () => unused });
    const answer = await fetch(new URL("./import.wasm", import.meta.url));
    const { instance } = await WebAssembly.instantiate(await answer.arrayBuffer(), imports);
    instance.exports._initialize?.();
    return instance.exports;
}

function textAt(code, at, most = 1 << 16) {
    const bytes = new Uint8Array(code.memory.buffer, at, Math.min(most, code.memory.buffer.byteLength - at));
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

/** The drawing in mm: its lines, the table of its styles, and one line about what was left out. uses: name of a style to its use. */
async function read(content, uses) {
    const code = await (loading ??= load()), text = new TextEncoder().encode(content), place = code.malloc(text.length + 1);
    new Uint8Array(code.memory.buffer, place, text.length).set(text);
    const isRead = code.readDrawing(place, text.length, TOLERANCE);
    code.free(place);
    if (!isRead) {
        throw new Error(textAt(code, code.getText()));
    }
    const note = textAt(code, code.getText()), [count, , , isSized, size, offset] = [0, 1, 2, 3, 4, 5].map(code.getNumber);
    const styles = Array.from({ length: count }, (_, i) => {
        const at = code.getStyles() + i * size, numbers = new Int32Array(code.memory.buffer, at + offset, 2), name = textAt(code, at, offset);
        numbers[0] = uses[name] ?? numbers[0];
        return { name, use: numbers[0], count: numbers[1] };
    });
    if (!code.joinDrawing(MEET)) {
        throw new Error(textAt(code, code.getText()));
    }
    const numbers = new Int32Array(code.memory.buffer, code.getLines(), 4 * code.getNumber(1));
    const points = new Float64Array(code.memory.buffer, code.getPoints(), 2 * code.getNumber(2));
    const lines = Array.from({ length: numbers.length / 4 }, (_, i) => {
        const [first, length, , use] = numbers.subarray(4 * i, 4 * i + 4);
        return { use, points: points.slice(2 * first, 2 * (first + length)) };
    });
    return { lines, styles: styles.filter((style) => style.count), note, isSized };
}

/** Cuts of a square sheet of this size (m) in its rest plane: arrays u, v, u, v...; the table of styles; and one line to show. */
export async function readCuts(content, size, uses = {}) {
    const { lines, styles, note, isSized } = await read(content, uses), all = lines.flatMap(({ points }) => [...points]);
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    all.forEach((x, i) => {
        low[i % 2] = Math.min(low[i % 2], x);
        high[i % 2] = Math.max(high[i % 2], x);
    });
    const width = Math.max(high[0] - low[0], high[1] - low[1]), isTrue = isSized && width <= 1000 * LARGEST * size;
    const scale = isTrue ? 0.001 : FITTED * size / width, cuts = lines.filter((line) => line.use === CUT);
    const folds = lines.length - cuts.length, plural = (n, word) => `${n} ${word}${n === 1 ? "" : "s"}`;
    const says = [plural(cuts.length, "cut"), folds > 0 && `${plural(folds, "fold")} left whole`,
        isSized && !isTrue && `at ${(100 * scale * 1000).toPrecision(2)} % of its size`, note];
    return {
        paths: cuts.map(({ points }) => Array.from(points, (x, i) => size / 2 + (x - (low[i % 2] + high[i % 2]) / 2) * scale)),
        styles, says: says.filter(Boolean).join("; "),
    };
}
