// Cuts from files: outlines of an SVG, or cuts and borders of a FOLD.

const STEP = 0.002; // of the drawing: how far points of a curve are apart

/** Polylines of the drawing: arrays of [x, y]. */
function fromSvg(text) {
    const svg = new DOMParser().parseFromString(text, "image/svg+xml").querySelector("svg");
    if (!svg) {
        throw new Error("this is no SVG");
    }
    svg.style.cssText = "position:absolute;visibility:hidden";
    document.body.append(svg);
    const box = svg.getBBox(), step = STEP * Math.max(box.width, box.height, 1e-9);
    const lines = [...svg.querySelectorAll("path,polygon,polyline,line,rect,circle,ellipse")].flatMap((shape) => lineOf(shape, step));
    svg.remove();
    return lines;
}

/** A shape, parted where a path jumps. */
function lineOf(shape, step) {
    const length = shape.getTotalLength(), matrix = shape.getCTM() ?? new DOMMatrix(), lines = [[]];
    const count = Math.min(4000, Math.max(2, Math.ceil(length / step)));
    const add = ({ x, y }) => lines.at(-1).push([matrix.a * x + matrix.c * y + matrix.e, -(matrix.b * x + matrix.d * y + matrix.f)]);
    add(shape.getPointAtLength(0));
    for (let i = 1; i <= count; i++) {
        const [end, next] = findJump(shape, length * (i - 1) / count, length * i / count);
        if (end) {
            add(end);
            lines.push([]);
            add(next);
        }
        add(shape.getPointAtLength(length * i / count));
    }
    return lines.filter((line) => line.length > 1);
}

/** Where a path ends between two lengths, and where it goes on: points that are further apart than the way between them. */
function findJump(shape, from, to) {
    const jumps = (a, b) => {
        const p = shape.getPointAtLength(a), q = shape.getPointAtLength(b);
        return Math.hypot(p.x - q.x, p.y - q.y) > 1.5 * (b - a) + 1e-4 * (to - from);
    };
    if (!jumps(from, to)) {
        return [];
    }
    for (let i = 0; i < 20; i++) {
        const middle = (from + to) / 2;
        [from, to] = jumps(from, middle) ? [from, middle] : [middle, to];
    }
    return [shape.getPointAtLength(from), shape.getPointAtLength(to)];
}

function frameOf(text) {
    try {
        const fold = JSON.parse(text);
        return fold.vertices_coords ? fold : fold.file_frames?.[0];
    } catch {
        return null;
    }
}

/** FOLD: edges that are cuts (C) or borders (B). */
function fromFold(text) {
    const frame = frameOf(text);
    if (!frame?.vertices_coords || !frame.edges_vertices) {
        throw new Error("this is no FOLD with edges");
    }
    return frame.edges_vertices
        .filter((_, i) => /[BC]/.test(frame.edges_assignment?.[i] ?? "C"))
        .map((edge) => edge.map((vertex) => frame.vertices_coords[vertex].slice(0, 2)));
}

/** Polylines of the rest plane, in a square of this size with a margin: arrays u, v, u, v... */
export function readCuts(text, size) {
    const lines = text.trimStart().startsWith("{") ? fromFold(text) : fromSvg(text), points = lines.flat();
    if (!points.length) {
        throw new Error("there is no outline in this file");
    }
    const low = [0, 1].map((k) => Math.min(...points.map((p) => p[k])));
    const high = [0, 1].map((k) => Math.max(...points.map((p) => p[k])));
    const scale = 0.8 * size / Math.max(high[0] - low[0], high[1] - low[1]);
    return lines.map((line) => line.flatMap((p) => [0, 1].map((k) => size / 2 + (p[k] - (low[k] + high[k]) / 2) * scale)));
}
