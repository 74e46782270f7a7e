// What is printed on both sides of a sheet, drawn once.

import { CanvasTexture, RepeatWrapping, SRGBColorSpace } from "three";

const SIDE = 1024;
const prints = new Map();

function texture(draw, color = true) {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = SIDE;
    draw(canvas.getContext("2d"));
    const made = new CanvasTexture(canvas);
    made.anisotropy = 8;
    made.wrapS = made.wrapT = RepeatWrapping;
    if (color) {
        made.colorSpace = SRGBColorSpace;
    }
    return made;
}

const fill = (c, color) => { c.fillStyle = color; c.fillRect(0, 0, SIDE, SIDE); };

/** Fine noise: fibres of paper, dust. */
function grain(c, strength, seed = 1) {
    const image = c.getImageData(0, 0, SIDE, SIDE), data = image.data;
    let s = seed;
    for (let i = 0; i < data.length; i += 4) {
        s = (Math.imul(s, 1664525) + 1013904223) >>> 0;
        const change = (s / 4294967296 - 0.5) * strength;
        data[i] += change; data[i + 1] += change; data[i + 2] += change;
    }
    c.putImageData(image, 0, 0);
}

/** Rows of waves, as on Japanese paper. */
function waves(c, radius, line, ground, y0 = 0) {
    c.lineWidth = radius / 14;
    for (let row = 0, y = y0; y < SIDE + radius; row++, y += radius / 2) {
        for (let x = (row % 2) * radius - radius; x < SIDE + radius; x += 2 * radius) {
            for (let r = radius; r > radius / 8; r -= radius / 4) {
                c.beginPath();
                c.arc(x, y, r, Math.PI, 0);
                c.fillStyle = ground;
                c.strokeStyle = line;
                c.fill();
                c.stroke();
            }
        }
    }
}

/** A ring of petals. */
function ring(c, radius, count, length, width, turn = 0) {
    for (let i = 0; i < count; i++) {
        c.save();
        c.translate(SIDE / 2, SIDE / 2);
        c.rotate((i + turn) * 2 * Math.PI / count);
        c.beginPath();
        c.moveTo(0, -radius);
        c.bezierCurveTo(width, -radius - length / 3, width, -radius - 2 * length / 3, 0, -radius - length);
        c.bezierCurveTo(-width, -radius - 2 * length / 3, -width, -radius - length / 3, 0, -radius);
        c.fill();
        c.restore();
    }
}

/** Long fibres, as in Japanese paper. */
function fibres(c, count, color) {
    let s = 5;
    const next = () => (s = (Math.imul(s, 1664525) + 1013904223) >>> 0) / 4294967296;
    c.strokeStyle = color;
    for (let i = 0; i < count; i++) {
        const x = next() * SIDE, y = next() * SIDE, bend = () => (next() - 0.5) * 130;
        c.lineWidth = 0.6 + 1.4 * next();
        c.beginPath();
        c.moveTo(x, y);
        c.quadraticCurveTo(x + bend(), y + bend(), x + bend(), y + bend());
        c.stroke();
    }
}

const paints = {
    washi(c) {
        fill(c, "#f6efe0");
        const wash = c.createRadialGradient(SIDE / 2, SIDE / 2, 0, SIDE / 2, SIDE / 2, SIDE * 0.5);
        wash.addColorStop(0, "#f3c8bb");
        wash.addColorStop(0.35, "#f5dccb");
        wash.addColorStop(1, "#f6efe000");
        fill(c, wash);
        c.fillStyle = "#c8402f";
        ring(c, 20, 12, 92, 15);
        c.fillStyle = "#27507a";
        ring(c, 232, 24, 60, 12, 0.5);
        ring(c, 350, 36, 30, 7);
        c.fillStyle = "#c79a45";
        ring(c, 130, 12, 70, 10, 0.5);
        ring(c, 310, 36, 22, 5, 0.5);
        ring(c, 398, 48, 22, 5);
        fibres(c, 260, "#ffffff48");
        fibres(c, 90, "#b59f7838");
        grain(c, 9, 2);
    },
    washiBack(c) {
        fill(c, "#efe5d2");
        fibres(c, 260, "#ffffff70");
        fibres(c, 90, "#b59f7840");
        grain(c, 9, 8);
    },
    paper(c) {
        fill(c, "#f3ecdd");
        c.fillStyle = "#c8402f";
        c.beginPath();
        c.arc(SIDE * 0.5, SIDE * 0.42, SIDE * 0.24, 0, 7);
        c.fill();
        waves(c, 84, "#27507a", "#f3ecdd", SIDE * 0.62);
        c.strokeStyle = "#27507a";
        c.lineWidth = 6;
        c.strokeRect(28, 28, SIDE - 56, SIDE - 56);
        grain(c, 12);
    },
    paperBack(c) {
        fill(c, "#e9dfc9");
        c.strokeStyle = "#c9bda2";
        c.lineWidth = 1.5;
        for (let i = 0; i <= SIDE; i += 64) {
            c.beginPath(); c.moveTo(i, 0); c.lineTo(i, SIDE); c.moveTo(0, i); c.lineTo(SIDE, i); c.stroke();
        }
        grain(c, 12, 7);
    },
    cloth(c) {
        fill(c, "#eef1f0");
        for (let i = 0; i < SIDE; i += 128) {
            c.fillStyle = "#3d6c9766";
            c.fillRect(i, 0, 64, SIDE);
            c.fillRect(0, i, SIDE, 64);
        }
        c.globalAlpha = 0.13;
        for (let i = 0; i < SIDE; i += 4) {
            c.fillStyle = i % 8 ? "#000" : "#fff";
            c.fillRect(i, 0, 1.6, SIDE);
            c.fillRect(0, i, SIDE, 1.6);
        }
        c.globalAlpha = 1;
        grain(c, 16, 3);
    },
    clothBack(c) {
        paints.cloth(c);
        c.fillStyle = "#ffffff8c";
        c.fillRect(0, 0, SIDE, SIDE);
    },
    foil(c) {
        fill(c, "#e2bd6a");
        c.strokeStyle = "#f3dca0";
        c.lineWidth = 5;
        for (let i = 0; i < SIDE; i += 128) {
            for (let j = 0; j < SIDE; j += 128) {
                c.beginPath(); c.moveTo(i + 64, j + 16); c.lineTo(i + 112, j + 64); c.lineTo(i + 64, j + 112);
                c.lineTo(i + 16, j + 64); c.closePath(); c.stroke();
            }
        }
        grain(c, 5, 5);
    },
    foilBack(c) {
        fill(c, "#dcdad6");
        grain(c, 5, 9);
    },
    rubber(c) {
        fill(c, "#c2463a");
        for (let i = 0; i < 16; i++) {
            for (let j = 0; j < 16; j++) {
                c.beginPath();
                c.arc((i + (j % 2 ? 0.75 : 0.25)) * 64, (j + 0.5) * 64, 14, 0, 7);
                c.fillStyle = "#d9695b";
                c.fill();
            }
        }
        grain(c, 9, 11);
    },
    rubberBack(c) {
        fill(c, "#a83a30");
        grain(c, 9, 13);
    },
};

/** The texture of a side, made once: "paper", "paperBack" and so on. */
export function makePrint(name) {
    if (!prints.has(name)) {
        prints.set(name, texture(paints[name]));
    }
    return prints.get(name);
}

/** A print with a line to cut along, dashed, and its copies around the middle, faint. Points of the rest plane; which of
 *  them, from `first` on, are what a finger cuts. */
export function makeGuide(name, points, first, need, copies, middle) {
    const print = makePrint(name).image;
    return texture((c) => {
        c.drawImage(print, 0, 0);
        const scale = SIDE / (2 * middle);
        const stroke = (from, count, turn) => {
            c.save();
            c.translate(SIDE / 2, SIDE / 2);
            c.rotate(turn);
            c.beginPath();
            for (let i = 0; i <= count; i++) {
                const [u, v] = points[(from + i) % points.length];
                c.lineTo((u - middle) * scale, (middle - v) * scale);
            }
            c.stroke();
            c.restore();
        };
        c.lineCap = "round";
        c.lineJoin = "round";
        c.strokeStyle = "#2c292566";
        c.lineWidth = 3;
        c.setLineDash([2, 12]);
        for (let i = 1; i < copies; i++) {
            stroke(first, need, i * 2 * Math.PI / copies);
        }
        c.setLineDash([]);
        c.strokeStyle = "#fffaf0e0";
        c.lineWidth = 13;
        stroke(first, need, 0);
        c.setLineDash([18, 16]);
        c.strokeStyle = "#2c2925";
        c.lineWidth = 6;
        stroke(first, need, 0);
    });
}

/** Heights of foil that was crumpled and smoothed: straight folds in all directions. */
export function makeCreases() {
    return texture((c) => {
        fill(c, "#808080");
        let s = 17;
        const next = () => (s = (Math.imul(s, 1664525) + 1013904223) >>> 0) / 4294967296;
        for (let i = 0; i < 60; i++) {
            const x = next() * SIDE, y = next() * SIDE, angle = next() * 7, wide = 90 + 260 * next();
            c.save();
            c.translate(x, y);
            c.rotate(angle);
            const slope = c.createLinearGradient(0, 0, wide, 0), light = next() > 0.5;
            slope.addColorStop(0, light ? "#ffffff00" : "#00000000");
            slope.addColorStop(0.2 + 0.6 * next(), light ? "#ffffff50" : "#00000050");
            slope.addColorStop(1, light ? "#ffffff00" : "#00000000");
            c.fillStyle = slope;
            c.fillRect(0, -1500, wide, 3000);
            c.restore();
        }
    }, false);
}

/** Repeats a texture once a metre. */
function tiled(map, width, height) {
    map.repeat.set(width, height);
    return map;
}

/** A wall: strokes of a trowel, hardly seen. */
export function makePlaster(size) {
    return tiled(texture((c) => {
        fill(c, "#93a7a1");
        let s = 31;
        const next = () => (s = (Math.imul(s, 1664525) + 1013904223) >>> 0) / 4294967296;
        for (let i = 0; i < 1400; i++) {
            const x = next() * SIDE, y = next() * SIDE, radius = 20 + 60 * next(), from = 7 * next();
            c.strokeStyle = next() > 0.5 ? "#ffffff07" : "#00000006";
            c.lineWidth = 2 + 12 * next();
            for (const [dx, dy] of [[0, 0], [SIDE, 0], [-SIDE, 0], [0, SIDE], [0, -SIDE]]) {
                c.beginPath();
                c.arc(x + dx, y + dy, radius, from, from + 1.4);
                c.stroke();
            }
        }
        grain(c, 9, 21);
    }), size, size);
}

/** Planks of walnut. */
export function makeWood(width, height) {
    return tiled(texture((c) => {
        fill(c, "#6b4a30");
        let s = 77;
        const next = () => (s = (Math.imul(s, 1664525) + 1013904223) >>> 0) / 4294967296;
        for (let plank = 0; plank < 8; plank++) {
            const top = plank * SIDE / 8, dark = next();
            c.fillStyle = `rgba(30, 16, 6, ${0.25 * dark})`;
            c.fillRect(0, top, SIDE, SIDE / 8);
            for (let i = 0; i < 40; i++) {
                const y = top + next() * SIDE / 8, wave = 4 * next();
                c.strokeStyle = next() > 0.4 ? `rgba(35, 18, 6, ${0.3 * next()})` : `rgba(214, 160, 106, ${0.16 * next()})`;
                c.lineWidth = 0.5 + 1.6 * next();
                c.beginPath();
                for (let x = 0; x <= SIDE; x += 64) {
                    c.lineTo(x, y + wave * Math.sin(2 * Math.PI * x / SIDE + i));
                }
                c.stroke();
            }
            c.fillStyle = "#1d0f06b0";
            c.fillRect(0, top, SIDE, 2);
        }
        grain(c, 10, 41);
    }), width, height);
}
