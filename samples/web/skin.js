// A sheet as it is drawn: with thickness, a print on both sides, light that shines through, and rims along every cut.

import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Mesh, MeshStandardMaterial, Vector3 } from "three";
import { Solid } from "kiri";

import { Lips } from "./lips.js";
import { makeCreases, makePrint } from "./print.js";
import { SIZE } from "./simulation.js";

let creases = null;

/** What shines through: light on the wall behind, which comes back to the other side. */
const SHINES = `
    totalEmissiveRadiance += diffuseColor.rgb * through * (0.55 + 0.45 * dot(normal, throughFrom));`;

export class Skin {
    /** stage: of which the lamps are. */
    constructor(look, stage, round) {
        const front = makePrint(look.print);
        const shine = { roughness: look.roughness, metalness: look.metalness };
        if (look.creased) {
            Object.assign(shine, { bumpMap: creases ??= makeCreases(), bumpScale: 2.2 });
        }
        this.through = { value: new Color(0) };
        this.materials = [
            this.shining(new MeshStandardMaterial({ map: front, ...shine })),
            this.shining(new MeshStandardMaterial({ map: front, ...shine })), // the back: see printBack
            new MeshStandardMaterial({ color: look.rim, ...shine }),
        ];
        this.look = look;
        this.stage = stage;
        this.round = round;
        this.solid = new Solid();
        this.before = new Float32Array(0); // positions one tick ago
        this.now = new Float32Array(0);
        this.revision = -1;
        this.mesh = new Mesh(new BufferGeometry(), this.materials);
        this.mesh.castShadow = this.mesh.receiveShadow = true;
        this.mesh.frustumCulled = false;
        this.lips = new Lips(look, stage.key.position);
        this.mesh.add(this.lips.mesh);
        this.room(1 << 14, 1 << 15);
    }

    shining(material) {
        material.onBeforeCompile = (shader) => {
            Object.assign(shader.uniforms, { through: this.through, throughFrom: { value: new Vector3(0.5, -0.4, 0.77) } });
            shader.fragmentShader = `uniform vec3 through, throughFrom;\n${shader.fragmentShader}`
                .replace("#include <emissivemap_fragment>", `#include <emissivemap_fragment>${SHINES}`);
        };
        return material;
    }

    /** Not before the first picture, which does not show it. */
    printBack() {
        this.materials[1].map = makePrint(`${this.look.print}Back`);
    }

    /** map: null for the print itself. */
    printFront(map) {
        this.guide?.dispose();
        this.guide = map;
        this.materials[0].map = map ?? makePrint(this.look.print);
    }

    /** Buffers with room for so many vertices and triangles. */
    room(vertices, triangles) {
        this.mesh.geometry.dispose();
        const geometry = this.mesh.geometry = new BufferGeometry();
        const add = (name, width) => geometry.setAttribute(name,
            new BufferAttribute(new Float32Array(width * vertices), width).setUsage(DynamicDrawUsage));
        add("position", 3);
        add("normal", 3);
        add("uv", 2);
        geometry.setIndex(new BufferAttribute(new Uint32Array(3 * triangles), 1).setUsage(DynamicDrawUsage));
        this.vertices = vertices;
        this.triangles = triangles;
        this.revision = -1;
    }

    /** After a tick. Positions and normals each time, the rest where a cut has changed it. */
    take(sheet, revision) {
        const solid = sheet.getSolid(this.look.drawn, this.solid);
        if (solid.vertexCount > this.vertices || solid.triangleCount > this.triangles) {
            this.room(2 * solid.vertexCount, 2 * solid.triangleCount);
        }
        const { normal, uv } = this.mesh.geometry.attributes, same = revision === this.revision;
        [this.before, this.now] = [this.now, this.before];
        if (this.now.length < solid.positions.length) {
            this.now = new Float32Array(3 * this.vertices);
        }
        this.now.set(solid.positions);
        this.count = solid.positions.length;
        if (!same || this.before.length < this.count) {
            this.before = this.now.slice();
        }
        this.copy(normal, solid.normals);
        if (!same) {
            this.revision = revision;
            const rest = solid.restPositions;
            for (let i = 0; i < rest.length; i++) {
                uv.array[i] = rest[i] / SIZE;
            }
            this.sent(uv, rest.length);
            this.copy(this.mesh.geometry.index, solid.indices);
            this.group(solid);
            this.lips.find(solid, this.round);
            this.sources = solid.sources.slice();
        }
    }

    /** For a picture: 0 is one tick ago, 1 is now. */
    show(part) {
        const { position, normal } = this.mesh.geometry.attributes, { before, now, count } = this;
        for (let i = 0; i < count; i++) {
            position.array[i] = before[i] + part * (now[i] - before[i]);
        }
        this.sent(position, count);
        this.lips.follow(this, position.array, normal.array, this.stage.pixel);
        this.through.value.copy(this.stage.through).multiplyScalar(this.look.through);
    }

    copy(attribute, values) {
        attribute.array.set(values);
        this.sent(attribute, values.length);
    }

    sent(attribute, count) {
        attribute.clearUpdateRanges();
        attribute.addUpdateRange(0, count);
        attribute.needsUpdate = true;
    }

    /** Half of the triangles that are no rims are the front. */
    group(solid) {
        const geometry = this.mesh.geometry, rim = 3 * solid.rimTriangle;
        geometry.clearGroups();
        geometry.addGroup(0, rim / 2, 0);
        geometry.addGroup(rim / 2, rim / 2, 1);
        geometry.addGroup(rim, 3 * solid.triangleCount - rim, 2);
    }

    dispose() {
        this.mesh.geometry.dispose();
        this.materials.forEach((material) => material.dispose());
        this.lips.dispose();
        this.guide?.dispose();
    }
}
