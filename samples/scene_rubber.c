/* Soft rubber between pegs that move apart. Slits gape, a disc comes off smaller than its hole, and what is cut through
   snaps back. Frames are affine, so that the sheet stretches inside a region; rigid ones can only move apart. */
#include "scene_parts.h"
#include "scene_types.h"

#include <stddef.h>

enum { PEGS_A_SIDE = 5, PULL_FIRST = 20, PULL_LAST = 100, DISC = 2 };

static const float sheetHeight = 0.8f, margin = 0.02f; /* margin: from pegs to the border */

/* As soft as silicone for casts, a twentieth of natural rubber: under the same pull both look the same, and the solver
   needs fewer iterations for the softer one. */
static kiriMaterial SoftRubber(void)
{
    kiriMaterial rubber;
    kiriGetMaterial(KIRI_MATERIAL_RUBBER, &rubber);
    rubber.youngsModulus = 1e5f;
    return rubber;
}

static float HeightOfPeg(int32_t row)
{
    return margin + (sheetHeight - 2.0f * margin) * (float)row / (PEGS_A_SIDE - 1);
}

/* One at every peg, and in the disc; along both sides of a slit and before its ends, so that its lips can bow; and
   beside the bridges. */
static bool PlaceFrames(Outline* frames)
{
    const float left[][2] = { { 0.25f, 0.2f },  { 0.25f, 0.6f },  { 0.18f, 0.3f },  { 0.18f, 0.4f },  { 0.18f, 0.5f },
                              { 0.32f, 0.3f },  { 0.32f, 0.4f },  { 0.32f, 0.5f },  { 0.17f, 0.06f }, { 0.33f, 0.06f },
                              { 0.17f, 0.74f }, { 0.33f, 0.74f }, { 0.43f, 0.11f }, { 0.43f, 0.69f } };
    bool fine = Outline_Add(frames, 0.5f, 0.4f);
    for (int32_t i = 0; fine && i < PEGS_A_SIDE; i++) {
        fine = Outline_Add(frames, margin, HeightOfPeg(i)) && Outline_Add(frames, 1.0f - margin, HeightOfPeg(i));
    }
    for (size_t i = 0; fine && i < sizeof left / sizeof left[0]; i++) {
        fine = Outline_Add(frames, left[i][0], left[i][1]) && Outline_Add(frames, 1.0f - left[i][0], left[i][1]);
    }
    return fine;
}

/* Two slits, a disc between them, and the bridges above and below it, just to the hole: the disc is not to be cut. */
static bool AddStrokes(Scene* scene)
{
    const Spiral disc = { { 0.5, 0.4 }, 0.12, 0.12, 0.25, 1.0, 0.02 }; /* starts and ends on top */
    return Scene_AddLine(scene, 0.25f, 0.55f, 0.25f, 0.25f) && Scene_AddLine(scene, 0.75f, 0.25f, 0.75f, 0.55f) &&
           Outline_AddSpiral(Scene_AddStroke(scene), &disc) &&
           Scene_AddLine(scene, 0.5f, sheetHeight + 0.02f, 0.5f, 0.519f) &&
           Scene_AddLine(scene, 0.5f, 0.281f, 0.5f, -0.02f);
}

static bool StartRubber(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def =
        Scene_PlaceSheet(scene, (float[]){ -0.5f, 0.0f, 0.35f }, (float[]){ 0.0f, 0.0f, 1.0f }, SoftRubber());
    Outline frames = { .points = NULL };
    bool fine = PlaceFrames(&frames);
    const Rectangle rectangle = { 1.0f, sheetHeight, 40, 32, frames.points };
    def.model = KIRI_MODEL_AFFINE;
    def.gridResolution = 50;
    def.frameCount = def.maxFrames = frames.count;
    fine = fine && Scene_MakeRectangle(scene, &def, options, &rectangle);
    Outline_Free(&frames);
    for (int32_t i = 0; fine && i < 2 * PEGS_A_SIDE; i++) {
        fine = Scene_PinHere(scene, &def, i < PEGS_A_SIDE ? margin : 1.0f - margin, HeightOfPeg(i % PEGS_A_SIDE));
    }
    return fine && AddStrokes(scene);
}

/* Topples the disc when it comes off, so that it does not land on its edge. */
static void TurnDisc(Scene* scene)
{
    const Stroke* stroke = &scene->strokes[DISC];
    kiriFrame frames[8];
    if (scene->tick <= stroke->lastTick || scene->tick > stroke->lastTick + 12) {
        return;
    }
    int32_t count = Scene_GetEnclosedFrames(scene, stroke, frames, 8);
    for (int32_t i = 0; i < count; i++) {
        kiriFrameState state;
        if (kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK) {
            float force[3] = { 0.0f, -1.0f * state.mass, 0.0f };
            float torque[3] = { 0.008f * state.mass, 0.0f, 0.0f };
            kiriFrame_ApplyForce(scene->world, frames[i], force, torque);
        }
    }
}

static void PullRubber(Scene* scene)
{
    float way = 0.25f * Scene_Ease(scene->tick, PULL_FIRST, PULL_LAST);
    for (int32_t i = 0; i < 2 * PEGS_A_SIDE; i++) {
        float side = i < PEGS_A_SIDE ? -1.0f : 1.0f;
        Scene_MovePin(scene, i, 0, side * (0.5f - margin + way));
    }
    TurnDisc(scene);
}

const SceneType rubberScene = {
    .name = "rubber",
    .about = "rubber is pulled, slits gape, a disc comes off smaller than its hole, and the halves snap back",
    .size = 0.3f,
    .ticks = 440,
    .substeps = 2,
    .firstCut = 120,
    .lastCut = 360,
    .moments = { 1, 180, 245, 322, 353, 440 },
    .camera = { { 0.35f, -3.2f, 1.3f }, { 0.0f, 0.0f, 0.55f }, 28.0f },
    .look = { { 0.22f, 0.66f, 0.55f }, { 0.85f, 0.72f, 0.40f }, { 0.06f, 0.25f, 0.22f }, 10.0f },
    .pegs = true,
    .start = StartRubber,
    .push = PullRubber,
};
