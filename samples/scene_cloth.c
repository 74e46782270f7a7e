/* Figures cut out of a hanging cloth. */
#include "scene_parts.h"
#include "scene_types.h"

#include <stddef.h>

static kiriMaterial Felt(void)
{
    return (kiriMaterial){ .youngsModulus = 1e7f,
                           .poissonsRatio = 0.3f,
                           .thickness = 0.0015f,
                           .density = 200.0f,
                           .airDamping = 0.8f,
                           .flexDamping = 0.03f };
}

/* A push against a figure from `lead` ticks before it comes off, harder the higher above `foot`, so that it topples out
   of the hole. As short at any pace of the blade: the figure falls as fast. */
static void PushFigure(Scene* scene, const Stroke* stroke, int32_t lead, float foot, float strength)
{
    if (scene->tick <= stroke->lastTick - lead || scene->tick > stroke->lastTick + 12) {
        return;
    }
    kiriFrame frames[256];
    int32_t count = Scene_GetEnclosedFrames(scene, stroke, frames, 256);
    for (int32_t i = 0; i < count; i++) {
        kiriFrameState state;
        if (kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK) {
            float force[3] = { 0.0f, -strength * state.mass * (1.6f + 8.0f * (state.restPoint[1] - foot)), 0.0f };
            float torque[3] = { 0.0f, 0.0f, 0.0f };
            kiriFrame_ApplyForce(scene->world, frames[i], force, torque);
        }
    }
}

static bool StartBunny(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.5f, 0.0f, 0.4f }, (float[]){ 0.0f, 0.0f, 1.0f }, Felt());
    def.gridResolution = 50;
    def.frameCount = 9;
    def.rigidArea = 0.022f;
    def.touchesSheets = 1;
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, NULL };
    const Figure figure = { "bunny", 0.55f, 0.5f, 0.5f };
    return Scene_MakeRectangle(scene, &def, options, &rectangle) &&
           Scene_PinAt(scene, 0.0f, 1.0f, -0.49f, 0.0f, 1.4f) && Scene_PinAt(scene, 1.0f, 1.0f, 0.49f, 0.0f, 1.4f) &&
           Scene_AddFigure(scene, options, &figure);
}

static void PushBunny(Scene* scene)
{
    PushFigure(scene, &scene->strokes[0], 40, 0.45f, 1.0f);
}

const SceneType bunnyScene = {
    .name = "bunny",
    .about = "a bunny is cut out of a hanging cloth and falls",
    .size = 1.0f,
    .ticks = 210,
    .substeps = 2,
    .firstCut = 18,
    .lastCut = 138,
    .moments = { 60, 100, 140, 148, 156, 188 },
    .camera = { { 0.95f, -2.75f, 1.2f }, { 0.03f, -0.1f, 0.59f }, 35.0f },
    .look = { { 0.38f, 0.64f, 0.90f }, { 0.96f, 0.80f, 0.55f }, { 0.93f, 0.30f, 0.12f }, 10.0f },
    .start = StartBunny,
    .push = PushBunny,
};

static const Figure patches[] = {
    { "bunny", 0.38f, 0.27f, 0.74f },
    { "teapot", 0.42f, 0.74f, 0.73f },
    { "dragon", 0.42f, 0.26f, 0.26f },
    { "armadillo", 0.42f, 0.74f, 0.26f },
};

enum { PATCHES = sizeof patches / sizeof patches[0] };

static bool StartPatchwork(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.5f, 0.0f, 0.45f }, (float[]){ 0.0f, 0.0f, 1.0f }, Felt());
    const float frames[] = { 0.06f, 0.92f, 0.94f, 0.92f, 0.5f, 0.5f, 0.06f, 0.06f, 0.94f, 0.06f };
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, frames };
    def.gridResolution = 50;
    def.frameCount = 5;
    def.maxFrames = 12;
    def.rigidArea = 0.035f;
    def.touchesSheets = 1;
    bool fine = Scene_MakeRectangle(scene, &def, options, &rectangle);
    for (int32_t i = 0; fine && i < 3; i++) {
        fine = Scene_PinHere(scene, &def, 0.5f * (float)i, 1.0f);
    }
    for (int32_t i = 0; fine && i < PATCHES; i++) {
        fine = Scene_AddFigure(scene, options, &patches[i]);
    }
    return fine;
}

static void PushPatches(Scene* scene)
{
    for (int32_t i = 0; i < PATCHES; i++) {
        PushFigure(scene, &scene->strokes[i], 0, patches[i].v - 0.05f, 1.5f);
    }
}

const SceneType patchworkScene = {
    .name = "patchwork",
    .about = "a bunny, a teapot, a dragon and an armadillo are cut out of a cloth, and fall",
    .size = 1.0f,
    .ticks = 600,
    .substeps = 2,
    .firstCut = 60,
    .lastCut = 480,
    .moments = { 165, 200, 290, 400, 500, 600 },
    .camera = { { 0.95f, -2.85f, 1.2f }, { 0.04f, -0.1f, 0.64f }, 35.0f },
    .look = { { 0.80f, 0.28f, 0.25f }, { 0.95f, 0.85f, 0.60f }, { 0.98f, 0.95f, 0.88f }, 10.0f },
    .start = StartPatchwork,
    .push = PushPatches,
};
