// Lips of cuts: a dark core, a light edge and the shade of a small curl, drawn as strips with a width in pixels of the window.

import { BufferAttribute, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, Vector3 } from "three";

import { borderOf } from "./simulation.js";

const CLOSED = 0.8e-3, OPEN = 3e-3; // m between two lips: the core fades between these
const GRAIN = 1e8; // steps a metre of the rest plane, to find the other lip

const vertexShader = `
    attribute vec2 corner;
    attribute vec3 a, b, outA, outB;
    attribute vec2 core;
    uniform float pixel, raise;
    uniform vec3 lamp;
    varying float x, depth, dark, tilt;
    const float CURL = 3.0e-3; // m
    void main() {
        vec3 at = mix(a, b, corner.x), outward = mix(outA, outB, corner.x);
        vec4 eye = modelViewMatrix * vec4(at, 1.0);
        float one = -eye.z * pixel, across = mix(-1.6 * one, max(3.2 * one, CURL), corner.y);
        x = across / one;
        depth = across / max(3.2 * one, CURL);
        dark = mix(core.x, core.y, corner.x);
        vec3 way = normalize(cameraPosition - at);
        tilt = -dot(outward, lamp) * (dot(cross(outward, b - a), way) > 0.0 ? 1.0 : -1.0);
        gl_Position = projectionMatrix * viewMatrix * vec4(at - across * outward + raise * way, 1.0);
    }`;

const fragmentShader = `
    uniform vec3 light, shade;
    varying float x, depth, dark, tilt;
    void main() {
        float curl = 0.4 * abs(tilt) * (1.0 - smoothstep(0.1, 1.0, depth)) * step(0.0, x);
        vec3 color = tilt > 0.0 ? light : shade;
        float alpha = curl;
        float edge = smoothstep(0.7, 1.2, x) * (1.0 - smoothstep(2.2, 3.0, x)) * (tilt > -0.3 ? 0.85 : 0.5) * (0.35 + 0.65 * dark);
        color = mix(color, light, edge);
        alpha = max(alpha, edge);
        float line = 0.9 * dark * smoothstep(-1.6, -0.9, x) * (1.0 - smoothstep(0.7, 1.2, x));
        color = mix(color, shade, line / max(1e-4, max(alpha, line)));
        alpha = max(alpha, line);
        gl_FragColor = vec4(color, alpha);
    }`;

export class Lips {
    /** light, shade: colours, as they are seen. thickness: m, of the sheet as it is drawn. */
    constructor({ light, shade, drawn }, lamp) {
        const uniforms = {
            pixel: { value: 1e-3 }, raise: { value: drawn / 2 + 0.8e-3 }, lamp: { value: new Vector3().copy(lamp).normalize() },
            light: { value: new Vector3(...light) }, shade: { value: new Vector3(...shade) },
        };
        this.material = new ShaderMaterial({ vertexShader, fragmentShader, uniforms, transparent: true, depthWrite: false, side: 2 });
        this.mesh = new Mesh(new InstancedBufferGeometry(), this.material);
        this.mesh.frustumCulled = false;
        this.mesh.renderOrder = 1;
        this.edges = new Int32Array(0);
        this.room(256);
    }

    room(edges) {
        this.mesh.geometry.dispose();
        const geometry = this.mesh.geometry = new InstancedBufferGeometry();
        geometry.setAttribute("corner", new BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
        geometry.setIndex([0, 1, 2, 0, 2, 3]);
        for (const [name, width] of [["a", 3], ["b", 3], ["outA", 3], ["outB", 3], ["core", 2]]) {
            geometry.setAttribute(name,
                new InstancedBufferAttribute(new Float32Array(width * edges), width).setUsage(DynamicDrawUsage));
        }
        this.capacity = edges;
    }

    /** Lists the edges of cuts, and for each of their vertices one in the same place of the rest plane. round: of a disc. */
    find(solid, round) {
        const { sources, restPositions: rest } = solid, count = solid.triangleCount - solid.rimTriangle >> 1;
        const first = solid.vertexCount - 4 * count, at = new Map(), edges = [];
        this.twin = new Int32Array(first / 2).fill(-1);
        for (let edge = 0; edge < count; edge++) {
            const rim = first + 4 * edge, p = sources[rim], q = sources[rim + 1];
            if (borderOf(rest[2 * p], rest[2 * p + 1], round) & borderOf(rest[2 * q], rest[2 * q + 1], round)) {
                continue;
            }
            edges.push(rim);
            for (const v of [p, q]) {
                const key = Math.round(rest[2 * v] * GRAIN) * 67108864 + Math.round(rest[2 * v + 1] * GRAIN), other = at.get(key);
                if (other === undefined) {
                    at.set(key, v);
                } else if (other !== v) {
                    this.twin[v] = other;
                    this.twin[other] = v;
                }
            }
        }
        this.edges = Int32Array.from(edges);
        this.outs = new Float32Array(3 * this.twin.length);
        if (edges.length > this.capacity) {
            this.room(2 * edges.length);
        }
    }

    /** How dark a vertex is: 1 while the other lip is near. Less than 0: it has none. */
    dark(positions, v) {
        const w = this.twin[v];
        if (w < 0) {
            return -1;
        }
        const gap = Math.hypot(positions[3 * v] - positions[3 * w], positions[3 * v + 1] - positions[3 * w + 1],
            positions[3 * v + 2] - positions[3 * w + 2]);
        return 1 - Math.min(1, Math.max(0, (gap - CLOSED) / (OPEN - CLOSED)));
    }

    /** positions, normals: of the solid, as they are drawn. pixel: m that a pixel shows at a distance of 1 m. */
    follow({ sources }, positions, normals, pixel) {
        const { edges, outs } = this, { a, b, outA, outB, core } = this.mesh.geometry.attributes;
        outs.fill(0);
        for (let i = 0; i < 2 * edges.length; i++) {
            const rim = edges[i >> 1], v = sources[rim + i % 2];
            for (let k = 0; k < 3; k++) {
                outs[3 * v + k] += normals[3 * rim + k];
            }
        }
        const end = (i, v, corner, point, out) => {
            const length = Math.max(0.5, Math.hypot(outs[3 * v], outs[3 * v + 1], outs[3 * v + 2]));
            for (let k = 0; k < 3; k++) {
                // Half-way between both sides of the sheet.
                point[3 * i + k] = (positions[3 * corner + k] + positions[3 * (corner + 2) + k]) / 2;
                out[3 * i + k] = outs[3 * v + k] / length;
            }
        };
        for (let i = 0; i < edges.length; i++) {
            const rim = edges[i], p = sources[rim], q = sources[rim + 1], c = this.dark(positions, p), d = this.dark(positions, q);
            end(i, p, rim, a.array, outA.array);
            end(i, q, rim + 1, b.array, outB.array);
            core.array[2 * i] = Math.max(0.3, c < 0 ? d : c);
            core.array[2 * i + 1] = Math.max(0.3, d < 0 ? c : d);
        }
        this.mesh.geometry.instanceCount = edges.length;
        this.mesh.visible = edges.length > 0;
        for (const attribute of [a, b, outA, outB, core]) {
            attribute.clearUpdateRanges();
            attribute.addUpdateRange(0, attribute.itemSize * edges.length);
            attribute.needsUpdate = true;
        }
        this.material.uniforms.pixel.value = pixel;
    }

    dispose() {
        this.mesh.geometry.dispose();
        this.material.dispose();
    }
}
