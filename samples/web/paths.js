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
    let before = null;
    for (let i = 0; i <= count; i++) {
        const at = shape.getPointAtLength(length * i / count);
        if (before && Math.hypot(at.x - before.x, at.y - before.y) > 1.5 * length / count + 1e-9) {
            lines.push([]);
        }
        lines.at(-1).push([matrix.a * at.x + matrix.c * at.y + matrix.e, -(matrix.b * at.x + matrix.d * at.y + matrix.f)]);
        before = at;
    }
    return lines.filter((line) => line.length > 1);
}

/** FOLD: edges that are cuts (C) or borders (B). */
function fromFold(text) {
    const fold = JSON.parse(text), frame = fold.vertices_coords ? fold : fold.file_frames[0];
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
