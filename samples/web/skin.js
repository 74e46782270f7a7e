// A sheet as it is drawn: with thickness, a print on both sides, and rims along every cut.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, MeshStandardMaterial } from "three";
import { Solid } from "kiri";

import { makeCreases, makePrint } from "./print.js";
import { SIZE } from "./simulation.js";

let creases = null;

export class Skin {
    constructor(look) {
        const front = makePrint(look.print);
        const shine = { roughness: look.roughness, metalness: look.metalness };
        if (look.creased) {
            Object.assign(shine, { bumpMap: creases ??= makeCreases(), bumpScale: 2.2 });
        }
        this.materials = [
            new MeshStandardMaterial({ map: front, ...shine }),
            new MeshStandardMaterial({ map: front, ...shine }), // the back: see printBack
            new MeshStandardMaterial({ color: look.rim, ...shine }),
        ];
        this.print = look.print;
        this.thickness = look.drawn;
        this.solid = new Solid();
        this.revision = -1;
        this.mesh = new Mesh(new BufferGeometry(), this.materials);
        this.mesh.castShadow = this.mesh.receiveShadow = true;
        this.mesh.frustumCulled = false;
        this.room(1 << 14, 1 << 15);
    }

    /** Not before the first picture, which does not show it. */
    printBack() {
        this.materials[1].map = makePrint(`${this.print}Back`);
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

    /** Positions and normals each time, the rest where a cut has changed it. */
    follow(sheet, revision) {
        const solid = sheet.getSolid(this.thickness, this.solid);
        if (solid.vertexCount > this.vertices || solid.triangleCount > this.triangles) {
            this.room(2 * solid.vertexCount, 2 * solid.triangleCount);
        }
        const { position, normal, uv } = this.mesh.geometry.attributes;
        this.copy(position, solid.positions);
        this.copy(normal, solid.normals);
        if (revision !== this.revision) {
            this.revision = revision;
            const rest = solid.restPositions;
            for (let i = 0; i < rest.length; i++) {
                uv.array[i] = rest[i] / SIZE;
            }
            this.sent(uv, rest.length);
            this.copy(this.mesh.geometry.index, solid.indices);
            this.group(solid);
        }
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
    }
}
