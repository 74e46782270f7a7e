// Cuts that are ready: a snowflake, and slits that open to a lantern.

const around = (middle, radius, angle) => [middle + radius * Math.cos(angle), middle + radius * Math.sin(angle)];

function arc(middle, radius, from, to, step = 0.003) {
    const count = Math.max(6, Math.ceil(Math.abs(to - from) * radius / step));
    return Array.from({ length: count + 1 }, (_, i) => around(middle, radius, from + (to - from) * i / count)).flat();
}

/** Holes of a snowflake and its outline, six times and mirrored. */
export function snowflake(size) {
    const middle = size / 2, unit = size / 2, paths = [];
    const leaf = (radius, at, length, width) => {
        // A closed rhomb, along the ray `at`.
        const point = (r, w) => {
            const c = Math.cos(at), s = Math.sin(at);
            return [middle + unit * (r * c - w * s), middle + unit * (r * s + w * c)];
        };
        paths.push([point(radius, 0), point(radius + length / 2, width), point(radius + length, 0),
                    point(radius + length / 2, -width), point(radius, 0)].flat());
    };
    for (let i = 0; i < 6; i++) {
        const ray = i * Math.PI / 3 + Math.PI / 6;
        leaf(0.14, ray, 0.2, 0.045);
        leaf(0.47, ray, 0.2, 0.07);
        leaf(0.3, ray + Math.PI / 6, 0.2, 0.05);
    }
    const outline = [];
    for (let i = 0; i <= 60; i++) {
        const angle = i * Math.PI / 30 + Math.PI / 6;
        const radius = [0.94, 0.86, 0.87, 0.7, 0.6, 0.52, 0.6, 0.7, 0.87, 0.86][i % 10];
        outline.push(...around(middle, unit * radius, angle));
    }
    paths.push(outline);
    return paths;
}

/** Rings of slits, each over the gaps of the one before: a disc that is held in its middle opens. */
export function lantern(size) {
    const middle = size / 2, paths = [], rings = 9, slits = 4;
    for (let ring = 0; ring < rings; ring++) {
        const radius = size * (0.09 + 0.36 * ring / (rings - 1)), turn = (ring % 2) * Math.PI / slits;
        const half = 0.024 * size / radius; // of what stays
        for (let i = 0; i < slits; i++) {
            const from = turn + i * 2 * Math.PI / slits;
            paths.push(arc(middle, radius, from + half, from + 2 * Math.PI / slits - half));
        }
    }
    return paths;
}

const STRAIGHT = 1 / Math.sqrt(5); // cosine of the angle between zigzags and straight lines

/** Folds of a Miura sheet, zigzags and straight lines. ways: the tangent of half the angle of each, relative to that of a
 *  zigzag; below 0: a mountain. */
export function miura(size, cells = 5) {
    const folds = [], ways = [], side = size / cells;
    const zigzag = (i, j) => side * (i + (j % 2 ? 0.25 : -0.25));
    const add = (from, to, way) => {
        folds.push({ from, to, stiffness: 0.05 });
        ways.push(way);
    };
    for (let i = 1; i < cells; i++) {
        for (let j = 0; j < cells; j++) {
            add([zigzag(i, j), side * j], [zigzag(i, j + 1), side * (j + 1)], i % 2 ? -1 : 1);
            add([j ? zigzag(j, i) : 0, side * i], [j < cells - 1 ? zigzag(j + 1, i) : size, side * i],
                (i + j) % 2 ? STRAIGHT : -STRAIGHT);
        }
    }
    return { folds, ways };
}

/** A round sheet: a mesh for a sheet def. */
export function disc(size, rings = 26, sectors = 120) {
    const restPositions = [size / 2, size / 2], indices = [];
    for (let ring = 1; ring <= rings; ring++) {
        const first = 1 + (ring - 1) * sectors;
        for (let i = 0; i < sectors; i++) {
            restPositions.push(...around(size / 2, size / 2 * ring / rings, i * 2 * Math.PI / sectors));
            const next = (i + 1) % sectors;
            if (ring === 1) {
                indices.push(0, first + i, first + next);
            } else {
                indices.push(first - sectors + i, first + i, first + next, first - sectors + i, first + next, first - sectors + next);
            }
        }
    }
    return { restPositions, indices };
}
