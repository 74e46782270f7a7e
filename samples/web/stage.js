// Camera, light and ground.

import {
    AmbientLight, BackSide, BoxGeometry, CircleGeometry, Color, CylinderGeometry, DirectionalLight, Fog, HalfFloatType,
    HemisphereLight, LinearMipmapLinearFilter, Mesh, MeshBasicMaterial, MeshStandardMaterial, NeutralToneMapping,
    PCFShadowMap, PerspectiveCamera, PMREMGenerator, Scene, SphereGeometry, Vector3, WebGLCubeRenderTarget, WebGLRenderer,
} from "three";

import { HIGH, LIFT, SIZE, TIP } from "./simulation.js";

const BACKGROUND = 0xd9d4cb;
const GREY = new Color().setScalar(1.35); // as bright as the surroundings are on the whole
const MIRRORED = 256; // pixels along a side of what is mirrored

export class Stage {
    constructor(canvas) {
        this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = PCFShadowMap;
        this.renderer.toneMapping = NeutralToneMapping;
        this.scene = new Scene();
        this.scene.background = new Color(BACKGROUND);
        this.scene.fog = new Fog(BACKGROUND, 1.6, 4);
        this.camera = new PerspectiveCamera(35, 1, 0.02, 20);
        this.target = new Vector3(0, 0.2, 0);
        this.detail = 1; // of the window's pixels: less where drawing takes too long
        this.slowFrames = 0;
        this.turn = { around: 0.35, above: 0.22, distance: 0.98 };
        this.addLight();
        this.addGround();
        this.addRod();
        this.resize();
    }

    addLight() {
        const sun = new DirectionalLight(0xfff4e6, 2.5);
        sun.position.set(0.55, 1.1, 0.75);
        sun.target.position.set(0, 0.12, 0);
        sun.castShadow = true;
        sun.shadow.mapSize.set(1024, 1024);
        Object.assign(sun.shadow.camera, { left: -0.5, right: 0.5, top: 0.5, bottom: -0.5, near: 0.2, far: 3 });
        sun.shadow.bias = -0.0006;
        sun.shadow.normalBias = 0.002;
        sun.shadow.radius = 4;
        this.scene.add(sun, sun.target, new HemisphereLight(0xe9f0ff, 0xb8a68e, 0.85), new AmbientLight(0xffffff, 0.12));
        this.grey = this.makeGrey();
        this.scene.environment = this.grey.texture;
        this.scene.environmentIntensity = 0.55;
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

    addGround() {
        const ground = new Mesh(new CircleGeometry(6, 48), new MeshStandardMaterial({ color: 0xbdb8b0, roughness: 1 }));
        ground.rotation.x = -Math.PI / 2;
        ground.receiveShadow = true;
        this.scene.add(ground);
    }

    /** What the sheet hangs from. */
    addRod() {
        const material = new MeshStandardMaterial({ color: 0x6f5a45, roughness: 0.6 });
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
        this.rod.visible = from === "rod";
        this.string.visible = !this.rod.visible;
        this.string.position.set(0, 0.5 + (from === "tip" ? LIFT + TIP : HIGH), 0);
    }

    resize() {
        const width = innerWidth, height = innerHeight;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * this.detail);
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        // The sheet fits in narrow windows too.
        this.camera.fov = width < height ? 35 * Math.min(1.7, height / width) : 35;
        this.camera.updateProjectionMatrix();
        this.aim();
    }

    /** Turns by so many pixels. */
    turnBy(x, y) {
        this.turn.around -= x * 0.006;
        this.turn.above = Math.min(1.45, Math.max(-0.05, this.turn.above + y * 0.006));
        this.aim();
    }

    zoomBy(factor) {
        this.turn.distance = Math.min(2.2, Math.max(0.25, this.turn.distance * factor));
        this.aim();
    }

    aim() {
        const { around, above, distance } = this.turn;
        this.camera.position.set(Math.sin(around) * Math.cos(above), Math.sin(above), Math.cos(around) * Math.cos(above))
            .multiplyScalar(distance).add(this.target);
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
