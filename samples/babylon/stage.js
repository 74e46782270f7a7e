// What babylon.js has in the scene: camera, light with shadows, ground, ball, and the print of the cloth.

import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { HemisphericLight } from "@babylonjs/core/Lights/hemisphericLight.js";
import { ShadowGenerator } from "@babylonjs/core/Lights/Shadows/shadowGenerator.js";
import { StandardMaterial } from "@babylonjs/core/Materials/standardMaterial.js";
import { DynamicTexture } from "@babylonjs/core/Materials/Textures/dynamicTexture.js";
import { Color3, Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CreateGround } from "@babylonjs/core/Meshes/Builders/groundBuilder.js";
import { CreateSphere } from "@babylonjs/core/Meshes/Builders/sphereBuilder.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/core/Culling/ray.js";

const paint = (name, scene, color, gloss = 0) => {
    const material = new StandardMaterial(name, scene);
    material.diffuseColor = Color3.FromHexString(color);
    material.specularColor = Color3.White().scale(gloss);
    return material;
};

/** Stripes and a border, once over `size` metres. */
function makeCloth(scene, size) {
    const side = 512, texture = new DynamicTexture("print", side, scene), c = texture.getContext();
    c.fillStyle = "#f4efe4";
    c.fillRect(0, 0, side, side);
    c.fillStyle = "#2d6a8e66";
    for (let i = 0; i < side; i += 64) {
        c.fillRect(i, 0, 32, side);
        c.fillRect(0, i, side, 32);
    }
    c.lineWidth = 16;
    c.strokeStyle = "#b0432f";
    c.strokeRect(20, 20, side - 40, side - 40);
    texture.update();
    texture.uScale = texture.vScale = 1 / size;
    const cloth = paint("cloth", scene, "#ffffff");
    cloth.diffuseTexture = texture;
    cloth.backFaceCulling = false;
    return cloth;
}

function makeLight(scene) {
    new HemisphericLight("sky", Vector3.Up(), scene).intensity = 0.7;
    const sun = new DirectionalLight("sun", new Vector3(-0.3, -1.2, -0.4), scene);
    sun.position.set(0.5, 1.8, 0.65);
    sun.intensity = 0.6;
    sun.autoUpdateExtends = false;
    Object.assign(sun, { orthoLeft: -0.55, orthoRight: 0.55, orthoBottom: -0.55, orthoTop: 0.55, shadowMinZ: 0.2, shadowMaxZ: 3 });
    const shadows = new ShadowGenerator(2048, sun);
    shadows.usePercentageCloserFiltering = true;
    shadows.bias = 0.0015;
    shadows.normalBias = 0.004;
    shadows.forceBackFacesOnly = true; // the far sides of cloth and ball: near ones throw no stripes on themselves
    return shadows;
}

export function makeStage(canvas, { radius, position }, size) {
    const engine = new Engine(canvas, true), scene = new Scene(engine);
    scene.useRightHandedSystem = true; // as the library
    scene.clearColor = Color4.FromHexString("#d9d4cbff");
    Object.assign(scene, { fogMode: Scene.FOGMODE_LINEAR, fogColor: Color3.FromHexString("#d9d4cb"), fogStart: 1.2, fogEnd: 4 }); // no horizon
    const camera = new ArcRotateCamera("camera", 1.1, 1.15, 1.0, new Vector3(0, 0.24, 0), scene);
    Object.assign(camera, { minZ: 0.05, lowerRadiusLimit: 0.6, upperRadiusLimit: 4, upperBetaLimit: 1.5, wheelDeltaPercentage: 0.01 });
    camera.attachControl();
    const shadows = makeLight(scene);
    const ground = CreateGround("ground", { width: 16, height: 16 }, scene);
    ground.material = paint("ground", scene, "#a8a298");
    const ball = CreateSphere("ball", { diameter: 2 * radius - 0.004, segments: 48 }, scene);
    ball.position.fromArray(position);
    ball.material = paint("ball", scene, "#c2463a", 0.3);
    ground.receiveShadows = ball.receiveShadows = true;
    shadows.addShadowCaster(ball);
    addEventListener("resize", () => engine.resize());
    return { engine, scene, camera, shadows, cloth: makeCloth(scene, size) };
}
