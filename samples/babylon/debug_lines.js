// The library's debug draw as lines of babylon.js.

import { Buffer, VertexBuffer } from "@babylonjs/core/Buffers/buffer.js";
import { Material } from "@babylonjs/core/Materials/material.js";
import { StandardMaterial } from "@babylonjs/core/Materials/standardMaterial.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { DrawFlag } from "kiri";

const ROOM = 1 << 15; // vertices
const BYTES = 16; // of a vertex: three floats, and a color

export class DebugLines {
    constructor(scene, world) {
        this.world = world;
        this.vertices = new Float32Array(4 * ROOM);
        this.buffer = new Buffer(scene.getEngine(), this.vertices, true, 4);
        this.mesh = new Mesh("debug", scene);
        this.mesh.setVerticesBuffer(new VertexBuffer(scene.getEngine(), this.buffer, VertexBuffer.PositionKind, true, false,
            BYTES, false, 0, 3, VertexBuffer.FLOAT, false, true));
        this.mesh.setVerticesBuffer(new VertexBuffer(scene.getEngine(), this.buffer, VertexBuffer.ColorKind, true, false,
            BYTES, false, 12, 4, VertexBuffer.UNSIGNED_BYTE, true, true));
        this.mesh.setIndices(Uint32Array.from({ length: ROOM }, (_, i) => i), ROOM);
        this.mesh.material = new StandardMaterial("debug", scene);
        this.mesh.material.disableLighting = true;
        this.mesh.material.emissiveColor = Color3.White();
        this.mesh.material.fillMode = Material.LineListDrawMode;
        this.mesh.alwaysSelectAsActiveMesh = true;
        this.mesh.setEnabled(false);
        this.draw = { flags: DrawFlag.Frames | DrawFlag.Borders, size: 0.02, lines: (...batch) => this.add(...batch) };
    }

    toggle() {
        this.mesh.setEnabled(!this.mesh.isEnabled());
    }

    add(vertices, colors, count) {
        if (this.count + count <= ROOM) {
            this.vertices.set(vertices, 4 * this.count);
            this.count += count;
        }
    }

    follow() {
        if (this.mesh.isEnabled()) {
            this.count = 0;
            this.world.debugDraw(this.draw);
            this.buffer.updateDirectly(this.vertices, 0, this.count);
            this.mesh.subMeshes[0].indexCount = this.count;
        }
    }
}
