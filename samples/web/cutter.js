// What is in the hand: a knife, scissors, or a pin that holds the sheet.

import { BoxGeometry, CylinderGeometry, ExtrudeGeometry, Group, Mesh, MeshStandardMaterial, Shape, SphereGeometry, TorusGeometry, Vector3 } from "three";

const HOVER = 0.012; // m before the sheet, while nothing is cut
const LEAN = 0.035; // radians of a lean, a mm of a step

const steel = new MeshStandardMaterial({ color: 0xd5d9dc, roughness: 0.25, metalness: 0.9 });
const red = new MeshStandardMaterial({ color: 0xb0432f, roughness: 0.45 });
const black = new MeshStandardMaterial({ color: 0x23211f, roughness: 0.6 });

function mesh(geometry, material, x = 0, y = 0, z = 0) {
    const made = new Mesh(geometry, material);
    made.position.set(x, y, z);
    made.castShadow = true;
    return made;
}

/** Of a knife or of scissors, with its tip at the origin, along y. */
function blade(length, width) {
    const shape = new Shape();
    shape.moveTo(0, 0);
    shape.lineTo(width, length * 0.45);
    shape.lineTo(width, length);
    shape.lineTo(0, length);
    return mesh(new ExtrudeGeometry(shape, { depth: 0.0007, bevelEnabled: false }), steel, 0, 0, -0.00035);
}

function makeKnife() {
    const knife = new Group();
    knife.add(blade(0.026, 0.006), mesh(new CylinderGeometry(0.0042, 0.0034, 0.014, 20), steel, 0.003, 0.031, 0),
        mesh(new CylinderGeometry(0.0048, 0.0044, 0.075, 20), red, 0.003, 0.0755, 0),
        mesh(new SphereGeometry(0.0048, 20, 10), red, 0.003, 0.113, 0));
    return knife;
}

function makeScissors() {
    const scissors = new Group();
    scissors.halves = [1, -1].map((side) => {
        const half = new Group(), sharp = blade(0.05, 0.006), grip = mesh(new TorusGeometry(0.012, 0.0028, 10, 28), black, 0, 0.047, 0);
        sharp.position.set(0, -0.05, side * 0.0005);
        sharp.scale.x = side;
        grip.scale.y = 1.4;
        grip.position.x = -side * 0.013;
        half.add(sharp, grip, mesh(new BoxGeometry(0.005, 0.026, 0.003), black, -side * 0.005, 0.016, 0));
        scissors.add(half);
        return half;
    });
    scissors.children.forEach((half) => half.position.set(0, 0.05, 0));
    return scissors;
}

function makePin() {
    const pin = new Group();
    pin.add(mesh(new SphereGeometry(0.007, 20, 14), red, 0, 0.012, 0), mesh(new CylinderGeometry(0.0008, 0.0003, 0.012, 8), steel, 0, 0.006, 0));
    return pin;
}

export class Cutter {
    constructor(scene) {
        this.models = { knife: makeKnife(), scissors: makeScissors(), grab: makePin() };
        for (const model of Object.values(this.models)) {
            model.visible = false;
            scene.add(model);
        }
        this.at = new Vector3();
        this.lean = 0;
    }

    /** point: in the sheet, or null where there is none. down: whether it cuts. */
    place(tool, point, down, camera) {
        tool = tool === "tear" ? "grab" : tool;
        for (const [name, model] of Object.entries(this.models)) {
            model.visible = name === tool && Boolean(point);
        }
        if (!point) {
            this.moves = false;
            return;
        }
        const model = this.models[tool], right = new Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
        const before = this.at.clone(), towards = camera.position.clone();
        this.at.fromArray(point);
        towards.sub(this.at).normalize();
        const step = this.moves ? this.at.distanceTo(before) : 0;
        const aim = step > 0 ? Math.max(-0.5, Math.min(0.5, 1000 * LEAN * right.dot(this.at.clone().sub(before)))) : 0;
        this.lean += 0.15 * (aim - this.lean);
        this.moves = true;
        // The handle comes from the right, below the eye of who looks.
        const up = new Vector3(0, 1, 0).applyQuaternion(camera.quaternion), handle = new Vector3();
        handle.addScaledVector(right, 0.62 - this.lean).addScaledVector(up, tool === "grab" ? 0.2 : -0.3).addScaledVector(towards, 0.8).normalize();
        model.position.copy(this.at).addScaledVector(towards, down ? 0.001 : HOVER);
        model.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), handle);
        if (tool === "scissors") {
            this.open = down ? this.open * 0.8 : 0.3 + 0.7 * (this.open ?? 0);
            model.halves.forEach((half, i) => { half.rotation.z = (i ? 1 : -1) * 0.22 * this.open; });
        }
    }

    /** Scissors open for the next snip. */
    snip() {
        this.open = 1;
    }
}
