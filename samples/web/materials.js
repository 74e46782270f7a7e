// What the sheets are made of: the library's presets, and how they look and sound.

import { MaterialPreset, Model, getMaterial } from "kiri";

const of = (preset, changes) => ({ ...getMaterial(preset), ...changes });

/** Made after load(): numbers are the library's. toughness: J/m^2, of what tears. */
export const makeMaterials = () => ({
    paper: {
        material: of(MaterialPreset.Paper, { airDamping: 0.6, flexDamping: 2e-3, restCurvature: [3, 3, 0] }), toughness: 1e4,
        drawn: 0.5e-3, roughness: 0.92, metalness: 0, rim: 0xf4efe4, print: "paper",
        light: [1, 0.99, 0.95], shade: [0.16, 0.1, 0.07], through: 1,
        sound: { pitch: 3800, width: 0.7, volume: 0.5 },
    },
    /** Of the first task. */
    washi: {
        material: of(MaterialPreset.Paper, { airDamping: 0.6, flexDamping: 2e-3, restCurvature: [3, 3, 0] }), toughness: 1e4,
        drawn: 0.5e-3, roughness: 0.95, metalness: 0, rim: 0xfaf6ee, print: "washi",
        light: [1, 0.99, 0.95], shade: [0.16, 0.1, 0.07], through: 1.3,
        sound: { pitch: 3800, width: 0.7, volume: 0.5 },
    },
    card: of(MaterialPreset.Card, { airDamping: 4, density: 60 }), // of the origami; light, so that it does not sag
    cloth: {
        material: of(MaterialPreset.Cotton, { airDamping: 0.8, flexDamping: 4e-3 }), toughness: 3e3,
        drawn: 1.1e-3, roughness: 1, metalness: 0, rim: 0x8fa6b8, print: "cloth",
        light: [0.97, 0.99, 1], shade: [0.05, 0.1, 0.17], through: 0.6,
        sound: { pitch: 900, width: 0.5, volume: 0.35 },
    },
    foil: {
        material: of(MaterialPreset.Foil, { airDamping: 0.5, flexDamping: 1e-3 }), toughness: 1e4,
        drawn: 0.3e-3, roughness: 0.34, metalness: 0.6, creased: true, rim: 0xd9d6d0, print: "foil",
        light: [1, 0.96, 0.84], shade: [0.13, 0.08, 0.02], through: 0,
        sound: { pitch: 6200, width: 1.6, volume: 0.4 },
    },
    rubber: {
        material: of(MaterialPreset.Rubber, { airDamping: 0.5, flexDamping: 1e-2 }),
        model: Model.Affine, iterations: 4,
        drawn: 3e-3, roughness: 0.55, metalness: 0, rim: 0x8f2f27, print: "rubber",
        light: [1, 0.72, 0.62], shade: [0.16, 0.03, 0.03], through: 0,
        sound: { pitch: 320, width: 0.8, volume: 0.5 },
    },
});
