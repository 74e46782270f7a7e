// Camera, light, wall and table.

import {
    BackSide, BoxGeometry, Color, CylinderGeometry, HalfFloatType, HemisphereLight, LinearMipmapLinearFilter, Mesh,
    MeshBasicMaterial, MeshStandardMaterial, NeutralToneMapping, PCFShadowMap, PerspectiveCamera, PlaneGeometry, PMREMGenerator,
    Scene, SphereGeometry, SpotLight, Vector3, WebGLCubeRenderTarget, WebGLRenderer,
} from "three";

import { makePlaster, makeWood } from "./print.js";
import { HIGH, LIFT, SIZE, TIP, WALLS } from "./simulation.js";

const GREY = new Color().setScalar(1.35); // as bright as the surroundings are on the whole
const MIRRORED = 256; // pixels along a side of what is mirrored
const VIEW = 25; // degrees
const FRAMED = { width: 0.375, height: 0.47 }; // m around the sheet that every window shows
/** By day and in the evening: how bright the lamp is, the sky, and what comes back from the wall. */
const DAY = { key: 3.4, sky: 1, through: 0.16 }, EVENING = { key: 1.5, sky: 0.42, through: 0.75 };

export class Stage {
    constructor(canvas) {
        this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = PCFShadowMap;
        this.renderer.toneMapping = NeutralToneMapping;
        this.scene = new Scene();
        this.scene.background = new Color(0x4d5f60);
        this.camera = new PerspectiveCamera(VIEW, 1, 0.02, 20);
        this.target = new Vector3(0, LIFT + 0.125, 0);
        this.detail = 1; // of the window's pixels: less where drawing takes too long
        this.slowFrames = 0;
        this.turn = { around: 0.16, above: 0.2, distance: 1 }; // distance: times that which frames the sheet
        this.through = new Color();
        this.evening = this.toEvening = 0;
        this.addLight();
        this.addRoom();
        this.addRod();
        this.light();
        this.resize();
    }

    addLight() {
        const key = this.key = new SpotLight(0xffe3bd, 1, 0, 0.36, 0.85, 0);
        key.position.set(-0.62, 0.92, 1.05);
        key.target.position.set(0.02, 0.19, -0.05);
        key.castShadow = true;
        key.shadow.mapSize.set(2048, 2048);
        Object.assign(key.shadow.camera, { near: 0.6, far: 2.6 });
        key.shadow.bias = -0.0004;
        key.shadow.normalBias = 0.0012;
        key.shadow.radius = 3;
        this.sky = new HemisphereLight(0xdfeaff, 0x8a7560, 1);
        this.scene.add(key, key.target, this.sky);
        this.grey = this.makeGrey();
        this.scene.environment = this.grey.texture;
    }

    /** As it is on the way from day to evening. */
    light() {
        const of = (name) => DAY[name] + this.evening * (EVENING[name] - DAY[name]);
        this.key.intensity = of("key");
        this.sky.intensity = 0.7 * of("sky");
        this.scene.environmentIntensity = 0.4 * of("sky");
        this.through.set(0xffb25e).multiplyScalar(of("through"));
    }

    /** Goes on towards the evening, or back. */
    pass(seconds) {
        if (this.evening !== this.toEvening) {
            const way = this.toEvening - this.evening;
            this.evening += Math.sign(way) * Math.min(Math.abs(way), seconds / 1.6);
            this.light();
        }
    }

    /** What is mirrored in the first picture. It is laid out as surroundings are, so that no shader is made twice. */
    makeGrey() {
        const target = new WebGLCubeRenderTarget(MIRRORED,
            { type: HalfFloatType, minFilter: LinearMipmapLinearFilter, generateMipmaps: false, depthBuffer: false });
        target.texture.isPMREMTexture = true;
        for (let size = MIRRORED; size >= 16; size /= 2) {
            target.texture.mipmaps.push({ width: size, height: size });
        }
        this.renderer.setClearColor(GREY, 1);
        for (let i = 0; i < 6 * target.texture.mipmaps.length; i++) {
            this.renderer.setRenderTarget(target, i % 6, Math.floor(i / 6));
            this.renderer.clear();
        }
        this.renderer.setRenderTarget(null);
        return target;
    }

    addSurroundings() {
        this.scene.environment = this.makeSurroundings();
        this.grey.dispose();
    }

    /** What shiny sheets mirror: a grey room with three lamps. */
    makeSurroundings() {
        const room = new Scene();
        room.add(new Mesh(new SphereGeometry(5, 16, 8), new MeshBasicMaterial({ color: 0xc9c5bf, side: BackSide })));
        const lamp = (x, y, z, w, h, brightness) => {
            const mesh = new Mesh(new BoxGeometry(w, h, 0.05), new MeshBasicMaterial());
            mesh.material.color.setScalar(brightness);
            mesh.position.set(x, y, z);
            mesh.lookAt(0, 0, 0);
            room.add(mesh);
        };
        lamp(2, 3, 2.5, 2, 1.6, 12);
        lamp(-3.5, 1.5, 1, 1, 3, 6);
        lamp(1.5, 0.4, 4, 1.2, 2.4, 5);
        lamp(0.5, 1, -4, 4, 0.6, 3);
        const generator = new PMREMGenerator(this.renderer);
        const made = generator.fromScene(room, 0.03, 0.1, 100, { size: MIRRORED }).texture;
        generator.dispose();
        return made;
    }

    /** A wall near the sheet, and a table. */
    addRoom() {
        const part = (width, height, map, roughness) => {
            const mesh = new Mesh(new PlaneGeometry(width, height), new MeshStandardMaterial({ map, roughness }));
            mesh.receiveShadow = true;
            this.scene.add(mesh);
            return mesh;
        };
        this.wall = part(4, 4, makePlaster(4), 1);
        this.table = part(4, 2, makeWood(4, 2), 0.55);
        this.table.rotation.x = -Math.PI / 2;
    }

    /** What the sheet hangs from. */
    addRod() {
        const material = new MeshStandardMaterial({ color: 0x4a3524, roughness: 0.5 });
        this.rod = new Mesh(new CylinderGeometry(0.0045, 0.0045, SIZE + 0.05, 20), material);
        this.rod.rotation.z = Math.PI / 2;
        this.rod.position.set(0, LIFT + SIZE + 0.002, 0);
        this.string = new Mesh(new CylinderGeometry(0.0011, 0.0011, 1, 8), material);
        for (const mesh of [this.rod, this.string]) {
            mesh.castShadow = true;
            this.scene.add(mesh);
        }
    }

    /** From a rod, or from a string at its tip or in its middle. */
    hang(from) {
        this.wall.position.set(0, 1, WALLS[from]);
        this.table.position.set(0, 0, WALLS[from] + 1);
        this.rod.visible = from === "rod";
        this.string.visible = !this.rod.visible;
        this.string.position.set(0, 0.5 + (from === "tip" ? LIFT + TIP : HIGH), 0);
    }

    resize() {
        const width = innerWidth, height = innerHeight;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * this.detail);
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        // The sheet fits in narrow windows too.
        const half = Math.tan(VIEW * Math.PI / 360);
        this.framing = Math.max(FRAMED.height, FRAMED.width / this.camera.aspect) / (2 * half);
        this.pixel = 2 * half / height;
        this.aim();
    }

    /** Turns by so many pixels. */
    turnBy(x, y) {
        this.turn.around = Math.min(1.3, Math.max(-1.3, this.turn.around - x * 0.006)); // the wall is behind
        this.turn.above = Math.min(1.45, Math.max(-0.05, this.turn.above + y * 0.006));
        this.aim();
    }

    zoomBy(factor) {
        this.turn.distance = Math.min(1.8, Math.max(0.3, this.turn.distance * factor));
        this.aim();
    }

    aim() {
        const { around, above, distance } = this.turn;
        this.camera.position.set(Math.sin(around) * Math.cos(above), Math.sin(above), Math.cos(around) * Math.cos(above))
            .multiplyScalar(distance * this.framing).add(this.target);
        this.camera.position.y = Math.max(0.02, this.camera.position.y);
        this.camera.lookAt(this.target);
        this.camera.updateMatrixWorld();
    }

    /** The ray through a point of the window, for the library. */
    ray(x, y) {
        const at = new Vector3(2 * x / innerWidth - 1, 1 - 2 * y / innerHeight, 0.5).unproject(this.camera);
        const origin = this.camera.position;
        const direction = at.sub(origin).normalize();
        return { origin: origin.toArray(), direction: direction.toArray() };
    }

    /** Where a point is in the window. */
    windowOf(position) {
        const at = new Vector3(...position).project(this.camera);
        return [(at.x + 1) / 2 * innerWidth, (1 - at.y) / 2 * innerHeight];
    }

    /** Slow machines draw fewer pixels. */
    spare(seconds) {
        this.slowFrames = seconds > 0.03 ? this.slowFrames + 1 : 0;
        if (this.slowFrames > 12 && this.detail > 0.4) {
            this.slowFrames = 0;
            this.detail *= 0.8;
            this.resize();
        }
    }

    draw() {
        this.renderer.render(this.scene, this.camera);
    }

    /** When what was drawn is there: calls of WebGL only queue it. */
    async drawn() {
        const gl = this.renderer.getContext(), fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        while (!gl.isContextLost() && gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) {
            await new Promise((done) => setTimeout(done));
        }
        gl.deleteSync(fence);
    }
}
