/* Sheets of paper. */
#include "scene_parts.h"
#include "scene_types.h"

#include <stddef.h>

static kiriMaterial Paper(void)
{
    kiriMaterial paper;
    kiriGetMaterial(KIRI_MATERIAL_PAPER, &paper);
    return paper;
}

#define PAPER_LOOK(red, green, blue)                                                                                   \
    {                                                                                                                  \
        { 0.81f, 0.80f, 0.775f }, { red, green, blue }, { 0.45f, 0.42f, 0.40f }, 0.0f                                  \
    }

static kiriSheetDef LevelPaper(const Scene* scene, float z)
{
    return Scene_PlaceSheet(scene, (float[]){ -0.5f, -0.5f, z }, (float[]){ 0.0f, 1.0f, 0.0f }, Paper());
}

/* In the corners and half-way between them. */
static bool PinBorder(Scene* scene, const kiriSheetDef* def, float width, float height)
{
    bool fine = true;
    for (int32_t i = 0; fine && i < 9; i++) {
        fine = i == 4 || Scene_PinHere(scene, def, 0.5f * width * (float)(i % 3), 0.5f * height * (float)(i / 3));
    }
    return fine;
}

/* Holds the last frames of the sheet where they are, as if taped to the floor. */
static bool HoldLastFrames(Scene* scene, int32_t held)
{
    kiriFrame frames[256];
    kiriFrameState state;
    int32_t count = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    bool fine = count >= held && count <= 256;
    for (int32_t i = count - held; fine && i < count; i++) {
        fine = kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK &&
               kiriFrame_Hold(scene->world, frames[i], state.position, state.rotation) == KIRI_OK;
    }
    return fine;
}

enum { MIDDLE_PINS = 3 };

/* Three pins hold the middle level. */
static bool PinMiddle(Scene* scene, const kiriSheetDef* def)
{
    return Scene_PinHere(scene, def, 0.47f, 0.48f) && Scene_PinHere(scene, def, 0.53f, 0.48f) &&
           Scene_PinHere(scene, def, 0.5f, 0.53f);
}

/* ---- Spiral: cut from the border of a sheet that is held in the middle ------------------------------------------- */

static bool StartSpiral(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, 1.4f);
    /* From the middle of the sheet to the end of the strip. */
    const float frames[] = { 0.5f, 0.5f, 0.35f, 0.6f, 0.72f, 0.67f, 0.72f, 0.19f, 0.1f, 0.2f };
    const Rectangle rectangle = { 1.0f, 1.0f, 8, 8, frames };
    def.gridResolution = 40;
    def.frameCount = def.maxFrames = 5;
    def.collisionPoints = 200;
    const Spiral spiral = { { 0.5, 0.5 }, 0.52, 0.08, 0.0, 5.0, 0.014 };
    return Scene_MakeRectangle(scene, &def, options, &rectangle) && PinMiddle(scene, &def) &&
           Outline_AddSpiral(Scene_AddStroke(scene), &spiral);
}

const SceneType spiralScene = {
    .name = "spiral",
    .about = "a long spiral is cut into a sheet of paper, from its middle, and unwinds",
    .size = 0.2f,
    .ticks = 600,
    .substeps = 2,
    .firstCut = 60,
    .lastCut = 480,
    .moments = { 60, 140, 200, 280, 360, 440, 490, 600 },
    .camera = { { 1.2f, -3.2f, 1.7f }, { 0.0f, 0.0f, 0.72f }, 32.0f },
    .look = PAPER_LOOK(0.85f, 0.25f, 0.20f),
    .start = StartSpiral,
    .push = Scene_TouchFloor,
};

/* ---- Vortex: two spirals meet in the middle, and two arms hang down ---------------------------------------------- */

/* Pins would pull at whichever frame is nearest, and that changes as blades pass: so the frames are held. */
static bool HoldBorder(Scene* scene, const kiriSheetDef* def)
{
    Scene_ShowThread(scene, def, 0.0f, 0.0f);
    Scene_ShowThread(scene, def, 1.0f, 1.0f);
    return HoldLastFrames(scene, 3);
}

static bool StartVortex(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, 0.9f);
    /* One an arm, near its end, and three in the border, so that an arm always hangs from the same one. */
    const float frames[] = { 0.486f, 0.387f, 0.514f, 0.613f, 0.08f, 0.2f, 0.92f, 0.8f, 0.05f, 0.05f };
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, frames };
    def.gridResolution = 68;
    def.frameCount = def.maxFrames = 5;
    def.collisionPoints = 200;
    const Spiral first = { { 0.5, 0.5 }, 0.0, 0.38, 0.0, 1.6, 0.014 };
    const Spiral second = { { 0.5, 0.5 }, 0.0, 0.38, 0.5, 1.6, 0.014 };
    return Scene_MakeRectangle(scene, &def, options, &rectangle) && HoldBorder(scene, &def) &&
           Outline_AddSpiral(Scene_AddStroke(scene), &first) && Outline_AddSpiral(Scene_AddStroke(scene), &second);
}

const SceneType vortexScene = {
    .name = "vortex",
    .together = true,
    .about = "two spirals that meet let two arms of a sheet of paper hang down",
    .size = 0.36f,
    .ticks = 540,
    .substeps = 2,
    .firstCut = 60,
    .lastCut = 390,
    .moments = { 60, 160, 225, 250, 280, 330, 390, 540 },
    .camera = { { 1.1f, -2.5f, 1.45f }, { 0.0f, 0.0f, 0.5f }, 28.0f },
    .look = PAPER_LOOK(0.20f, 0.35f, 0.70f),
    .start = StartVortex,
    .push = Scene_TouchFloor,
};

/* ---- Kirigami: 8 rings of 6 slits, and the middle is pulled up --------------------------------------------------- */

enum { RINGS = 8, SLITS = 6, PULL_PAUSE = 20, PULL_TICKS = 180 };

static double RadiusOf(int32_t ring)
{
    return 0.06 + 0.05 * ring;
}

/* Rings are turned by half a slit from one to the next, so that a bridge leads to the middle of a slit. */
static double BridgeTurn(int32_t ring, int32_t bridge)
{
    return (bridge + 0.5 * (ring % 2)) / SLITS;
}

static bool AddSlit(Scene* scene, int32_t ring, int32_t slit)
{
    const double bridge = 0.035; /* m */
    double radius = RadiusOf(ring), gap = bridge / (6.283185307 * radius);
    const Spiral arc = { { 0.5, 0.5 }, radius, radius, BridgeTurn(ring, slit) + 0.5 * gap, 1.0 / SLITS - gap, 0.02 };
    return Outline_AddSpiral(Scene_AddStroke(scene), &arc);
}

/* In the middle, at every bridge but the innermost, and in the corners. */
static bool PlaceFrames(Outline* frames)
{
    bool fine = Outline_Add(frames, 0.5f, 0.5f);
    for (int32_t ring = 1; fine && ring < RINGS; ring++) {
        for (int32_t bridge = 0; fine && bridge < SLITS; bridge++) {
            double turn = BridgeTurn(ring, bridge), radius = RadiusOf(ring);
            const Spiral point = { { 0.5, 0.5 }, radius, radius, turn, 0.0, 1.0 };
            fine = Outline_AddSpiral(frames, &point);
            frames->count--; /* both of its ends */
        }
    }
    for (int32_t i = 0; fine && i < 4; i++) {
        fine = Outline_Add(frames, 0.04f + 0.92f * (float)(i & 1), 0.04f + 0.92f * (float)(i >> 1));
    }
    return fine;
}

static bool StartKirigami(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, floorGap);
    Outline frames = { .points = NULL };
    bool fine = PlaceFrames(&frames);
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, frames.points };
    def.gridResolution = 68;
    def.frameCount = def.maxFrames = frames.count;
    def.collisionPoints = 600;
    def.iterations = 1;
    fine = fine && Scene_MakeRectangle(scene, &def, options, &rectangle) && PinMiddle(scene, &def);
    Outline_Free(&frames);
    fine = fine && HoldLastFrames(scene, 4);
    for (int32_t i = 0; fine && i < RINGS * SLITS; i++) {
        fine = AddSlit(scene, i / SLITS, i % SLITS);
    }
    return fine;
}

static void PullKirigami(Scene* scene)
{
    Scene_TouchFloor(scene);
    int32_t first = scene->type->lastCut + Scene_Slow(PULL_PAUSE, scene->pace),
            last = first + Scene_Slow(PULL_TICKS, scene->pace);
    for (int32_t i = 0; i < MIDDLE_PINS; i++) {
        Scene_MovePin(scene, i, 2, floorGap + 0.32f * Scene_Ease(scene->tick, first, last));
    }
}

const SceneType kirigamiScene = {
    .name = "kirigami",
    .about = "48 slits let a sheet of paper rise when its middle is pulled up",
    .size = 0.3f,
    .ticks = 800,
    .substeps = 4,
    .firstCut = 60,
    .lastCut = 540,
    .moments = { 60, 200, 400, 540, 620, 650, 690, 800 },
    .camera = { { 1.0f, -2.2f, 1.35f }, { 0.0f, 0.0f, 0.1f }, 25.0f },
    .look = PAPER_LOOK(0.20f, 0.55f, 0.50f),
    .start = StartKirigami,
    .push = PullKirigami,
};

/* ---- Falling guy: swings down, and hangs on by a finger ---------------------------------------------------------- */

static bool StartFallingGuy(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def =
        Scene_PlaceSheet(scene, (float[]){ -1.0f, -0.45f, 1.75f }, (float[]){ 0.0f, 0.96f, 0.28f }, Paper());
    /* Left and right, below and above; forearm, head, chest, elbow, both legs. The finger is half-way from the first to
       the forearm, so that the regions meet where it is thin. */
    const float frames[] = { 0.06f, 0.17f, 1.93f, 0.5f,  1.0f,  0.04f, 1.0f,  0.96f, 0.42f, 0.17f,
                             0.56f, 0.39f, 0.83f, 0.38f, 0.86f, 0.70f, 1.48f, 0.27f, 1.48f, 0.56f };
    const Rectangle rectangle = { 2.0f, 1.0f, 16, 16, frames };
    const Figure guy = { "fallingguy", 1.6f, 1.0f, 0.5f };
    def.gridResolution = 100;
    def.frameCount = def.maxFrames = 10;
    def.collisionPoints = 500;
    def.iterations = 2; /* large turns at each tick while he swings */
    bool fine = Scene_MakeRectangle(scene, &def, options, &rectangle) && PinBorder(scene, &def, 2.0f, 1.0f) &&
                Scene_AddFigure(scene, options, &guy);
    if (fine) {
        scene->strokes[0].way.count--; /* from one side of the finger to the other: not closed */
    }
    return fine;
}

const SceneType fallingGuyScene = {
    .name = "fallingguy",
    .about = "a man is cut out of a sheet of paper, swings down and hangs on by a finger",
    .size = 0.4f,
    .ticks = 600,
    .substeps = 2,
    .firstCut = 60,
    .lastCut = 300,
    .moments = { 60, 140, 220, 290, 310, 330, 360, 600 },
    .camera = { { 1.0f, -4.7f, 2.2f }, { -0.25f, 0.0f, 1.0f }, 31.0f },
    .look = PAPER_LOOK(0.90f, 0.60f, 0.15f),
    .start = StartFallingGuy,
    .push = Scene_TouchFloor,
};
