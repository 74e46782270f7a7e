// A sheet of Kiri as a mesh of babylon.js: positions and normals go from the library's memory to the buffers of WebGL, the
// rest only where a cut has changed it. Copy it into your game.

import { Buffer, VertexBuffer } from "@babylonjs/core/Buffers/buffer.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { Solid, Mesh as Surface } from "kiri";

const KINDS = { positions: [VertexBuffer.PositionKind, 3], normals: [VertexBuffer.NormalKind, 3], restPositions: [VertexBuffer.UVKind, 2] };

export class SheetMesh {
    /** thickness: m, that is drawn. The texture of `material` gets the rest positions, in metres, as its coordinates. */
    constructor(scene, sheet, material, thickness = 2e-3) {
        this.scene = scene;
        this.sheet = sheet;
        this.thickness = thickness;
        this.solid = new Solid();
        this.surface = new Surface();
        this.revision = -1;
        this.room = 0;
        this.mesh = new Mesh("sheet", scene);
        this.mesh.material = material;
        this.mesh.alwaysSelectAsActiveMesh = true;
        this.mesh.receiveShadows = true;
    }

    follow() {
        const solid = this.sheet.getSolid(this.thickness, this.solid), { revision } = this.sheet.getMesh(this.surface);
        if (solid.vertexCount > this.room) {
            this.grow(solid.vertexCount);
        }
        this.send(solid, "positions");
        this.send(solid, "normals");
        if (revision !== this.revision) {
            this.revision = revision;
            this.send(solid, "restPositions");
            this.mesh.setIndices(solid.indices.slice(), solid.vertexCount);
        }
    }

    send(solid, name) {
        this.buffers[name].updateDirectly(solid[name], 0, solid.vertexCount);
    }

    /** Half as many again, so that few cuts make buffers anew. */
    grow(vertices) {
        const engine = this.scene.getEngine();
        this.room = Math.ceil(1.5 * vertices);
        this.buffers = {};
        for (const [name, [kind, width]] of Object.entries(KINDS)) {
            const buffer = this.buffers[name] = new Buffer(engine, new Float32Array(width * this.room), true, width);
            this.mesh.setVerticesBuffer(new VertexBuffer(engine, buffer, kind, true, false, width, false, 0, width));
        }
        this.revision = -1;
    }
}
