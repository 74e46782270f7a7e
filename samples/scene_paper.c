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

/* Is frame number `index` of `count`, at a point of the sheet in sizes, held? */
typedef bool IsHeld(int32_t index, int32_t count, const float restPoint[2]);

/* Holds frames where they are, as if taped to the floor. */
static bool HoldFrames(Scene* scene, IsHeld* isHeld)
{
    kiriFrame frames[256];
    int32_t count = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    bool fine = count <= 256;
    for (int32_t i = 0; fine && i < count; i++) {
        kiriFrameState state;
        fine = kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK;
        const float point[2] = { state.restPoint[0] / scene->type->size, state.restPoint[1] / scene->type->size };
        if (fine && isHeld(i, count, point)) {
            fine = kiriFrame_Hold(scene->world, frames[i], state.position, state.rotation) == KIRI_OK;
        }
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

/* Arms turn by half a circle and more between frames that are far apart, and what is seen between them is stretched and
   creased. So frames are added along them, one in somewhat more than their width. */
static const float armFrameLength = 0.12f;
enum { MOST_FRAMES = 128 };

/* ---- Spiral: cut from the border of a sheet that is held in the middle ------------------------------------------- */

/* In from the border. The paper's spiral leaves necks of half a millimetre in the middle of the sides; ours does
   not. */
static bool AddSpiralBlade(Outline* way, bool asPaper)
{
    const Spiral wide = { { 0.5, 0.5 }, 0.52, 0.08, 0.0, 5.0, 0.014 };
    const Spiral narrow = { { 0.5, 0.5 }, 0.46, 0.08, 0.0, 4.3, 0.014 };
    return asPaper ? Outline_AddSpiral(way, &wide) : Outline_Add(way, 1.02f, 0.5f) && Outline_AddSpiral(way, &narrow);
}

static bool StartSpiral(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, 1.4f);
    /* From the middle of the sheet to the end of the strip. */
    const float few[] = { 0.5f, 0.5f, 0.35f, 0.6f, 0.72f, 0.67f, 0.72f, 0.19f, 0.1f, 0.2f };
    const int32_t squares = options->asPaper ? 8 : 64;
    const Rectangle rectangle = { 1.0f, 1.0f, squares, squares, options->asPaper ? few : NULL };
    def.gridResolution = 40;
    def.frameCount = options->asPaper ? 5 : 0;
    def.maxFrames = options->asPaper ? 5 : MOST_FRAMES;
    def.frameLength = armFrameLength * scene->type->size;
    return Scene_MakeRectangle(scene, &def, options, &rectangle) && PinMiddle(scene, &def) &&
           AddSpiralBlade(Scene_AddStroke(scene), options->asPaper);
}

const SceneType spiralScene = {
    .name = "spiral",
    .about = "a long spiral is cut into a sheet of paper, from its middle, and unwinds",
    .size = 0.2f,
    .ticks = 600,
    .substeps = 2,
    .firstCut = 60,
    .lastCut = 480,
    .moments = { 60, 140, 200, 280, 360, 600 },
    .camera = { { 1.2f, -3.2f, 1.7f }, { 0.0f, 0.0f, 0.72f }, 32.0f },
    .look = PAPER_LOOK(0.85f, 0.25f, 0.20f),
    .start = StartSpiral,
};

/* ---- Vortex: two spirals meet in the middle, and two arms hang down ---------------------------------------------- */

/* Those farther out than the arms; of the paper's five the last three. */
static bool IsInBorder(int32_t index, int32_t count, const float restPoint[2])
{
    float u = restPoint[0] - 0.5f, v = restPoint[1] - 0.5f;
    return count == 5 ? index >= 2 : u > 0.4f || u < -0.4f || v > 0.4f || v < -0.4f;
}

/* Pins would pull at whichever frame is nearest, and that changes as blades pass: so the frames are held. */
static bool HoldBorder(Scene* scene, const kiriSheetDef* def)
{
    Scene_ShowThread(scene, def, 0.0f, 0.0f);
    Scene_ShowThread(scene, def, 1.0f, 1.0f);
    return HoldFrames(scene, IsInBorder);
}

static bool StartVortex(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, 0.9f);
    /* One an arm, near its end, and three in the border, so that an arm always hangs from the same one. */
    const float few[] = { 0.486f, 0.387f, 0.514f, 0.613f, 0.08f, 0.2f, 0.92f, 0.8f, 0.05f, 0.05f };
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, options->asPaper ? few : NULL };
    def.gridResolution = 68;
    def.frameCount = options->asPaper ? 5 : 0;
    def.maxFrames = options->asPaper ? 5 : MOST_FRAMES;
    def.frameLength = armFrameLength * scene->type->size;
    /* Its frames are held, and nothing is pinned: a smooth surface is where it should be. */
    def.skinning = options->asPaper ? KIRI_SKINNING_LINEAR : KIRI_SKINNING_SMOOTH;
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
    .moments = { 160, 250, 280, 330, 390, 540 },
    .camera = { { 1.1f, -2.5f, 1.45f }, { 0.0f, 0.0f, 0.5f }, 28.0f },
    .look = PAPER_LOOK(0.20f, 0.35f, 0.70f),
    .start = StartVortex,
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

static bool AddSlit(Scene* scene, int32_t ring, int32_t slit, double step)
{
    const double bridge = 0.035; /* m */
    double radius = RadiusOf(ring), gap = bridge / (6.283185307 * radius);
    const Spiral arc = { { 0.5, 0.5 }, radius, radius, BridgeTurn(ring, slit) + 0.5 * gap, 1.0 / SLITS - gap, step };
    return Outline_AddSpiral(Scene_AddStroke(scene), &arc);
}

static bool AddFrame(Outline* frames, double radius, double turn)
{
    const Spiral point = { { 0.5, 0.5 }, radius, radius, turn, 0.0, 1.0 };
    bool fine = Outline_AddSpiral(frames, &point);
    frames->count--; /* both of its ends */
    return fine;
}

/* A band between two rings is a row of beams from bridge to bridge, which bend and twist. */
static bool PlaceFramesInBeams(Outline* frames, int32_t ring)
{
    double radius = 0.5 * (RadiusOf(ring) + RadiusOf(ring + 1)), turn = 0.5 / SLITS;
    int32_t count = (int32_t)(6.283185307 * turn * radius / 0.1 + 0.5);
    bool fine = true;
    count = count > 0 ? count : 1;
    for (int32_t i = 0; fine && i < 2 * SLITS * count; i++) {
        fine = AddFrame(frames, radius, turn * (i / count + (i % count + 1.0) / (count + 1.0)));
    }
    return fine;
}

/* In the middle, at every bridge but the innermost, in the beams of all bands but the innermost, and in the corners. */
static bool PlaceFrames(Outline* frames, bool asPaper)
{
    bool fine = Outline_Add(frames, 0.5f, 0.5f);
    for (int32_t ring = 1; fine && ring < RINGS; ring++) {
        for (int32_t bridge = 0; fine && bridge < SLITS; bridge++) {
            fine = AddFrame(frames, RadiusOf(ring), BridgeTurn(ring, bridge));
        }
    }
    for (int32_t ring = 1; fine && !asPaper && ring + 1 < RINGS; ring++) {
        fine = PlaceFramesInBeams(frames, ring);
    }
    for (int32_t i = 0; fine && i < 4; i++) {
        fine = Outline_Add(frames, 0.04f + 0.92f * (float)(i & 1), 0.04f + 0.92f * (float)(i >> 1));
    }
    return fine;
}

static bool IsInCorner(int32_t index, int32_t count, const float restPoint[2])
{
    (void)restPoint;
    return index >= count - 4;
}

static bool StartKirigami(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, floorGap);
    Outline frames = { .points = NULL };
    bool fine = PlaceFrames(&frames, options->asPaper);
    const int32_t squares = options->asPaper ? 64 : 96;
    const Rectangle rectangle = { 1.0f, 1.0f, squares, squares, frames.points };
    def.gridResolution = options->asPaper ? 68 : 100;
    def.frameCount = def.maxFrames = frames.count;
    def.iterations = 1;
    fine = fine && Scene_MakeRectangle(scene, &def, options, &rectangle) && PinMiddle(scene, &def);
    Outline_Free(&frames);
    fine = fine && HoldFrames(scene, IsInCorner);
    for (int32_t i = 0; fine && i < RINGS * SLITS; i++) {
        fine = AddSlit(scene, i / SLITS, i % SLITS, options->asPaper ? 0.02 : 0.008);
    }
    return fine;
}

static void PullKirigami(Scene* scene)
{
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
    .moments = { 200, 400, 620, 650, 690, 800 },
    .camera = { { 1.0f, -2.2f, 1.35f }, { 0.0f, 0.0f, 0.1f }, 25.0f },
    .look = PAPER_LOOK(0.20f, 0.55f, 0.50f),
    .start = StartKirigami,
    .push = PullKirigami,
};

/* ---- Falling guy: swings down, and hangs on by a finger ---------------------------------------------------------- */

/* The sheet: left and right, below and above, and beside the finger. The arm from the hand on; head, chest, elbows,
   both legs. The finger is half-way between the frame beside it and the first of the arm, so that the regions meet
   where it is thin. */
static const float guyFrames[] = { 0.06f, 0.17f,  1.93f, 0.5f,   1.0f,  0.04f,  1.0f,  0.96f,  0.18f, 0.17f,
                                   0.4f,  0.05f,  0.7f,  0.05f,  1.35f, 0.06f,  1.7f,  0.12f,  0.3f,  0.6f,
                                   0.4f,  0.9f,   1.65f, 0.87f,  0.30f, 0.16f,  0.36f, 0.155f, 0.42f, 0.155f,
                                   0.48f, 0.148f, 0.54f, 0.145f, 0.60f, 0.148f, 0.66f, 0.18f,  0.72f, 0.235f,
                                   0.56f, 0.39f,  0.8f,  0.35f,  0.80f, 0.47f,  1.0f,  0.38f,  1.2f,  0.38f,
                                   0.84f, 0.72f,  0.65f, 0.70f,  0.72f, 0.82f,  1.31f, 0.27f,  1.45f, 0.27f,
                                   1.60f, 0.28f,  1.36f, 0.52f,  1.48f, 0.57f,  1.6f,  0.66f };

static bool StartFallingGuy(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def =
        Scene_PlaceSheet(scene, (float[]){ -1.0f, -0.45f, 1.75f }, (float[]){ 0.0f, 0.96f, 0.28f }, Paper());
    /* Left and right, below and above; forearm, head, chest, elbow, both legs. */
    const float few[] = { 0.06f, 0.17f, 1.93f, 0.5f,  1.0f,  0.04f, 1.0f,  0.96f, 0.42f, 0.17f,
                          0.56f, 0.39f, 0.83f, 0.38f, 0.86f, 0.70f, 1.48f, 0.27f, 1.48f, 0.56f };
    const Rectangle rectangle = { 2.0f, 1.0f, options->asPaper ? 16 : 128, options->asPaper ? 16 : 64,
                                  options->asPaper ? few : guyFrames };
    const Figure guy = { "fallingguy", 1.6f, 1.0f, 0.5f };
    def.gridResolution = 100;
    def.frameCount = def.maxFrames = options->asPaper ? 10 : (int32_t)(sizeof guyFrames / sizeof guyFrames[0] / 2);
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
    .moments = { 140, 220, 290, 310, 330, 360 },
    .camera = { { 1.0f, -4.7f, 2.2f }, { -0.25f, 0.0f, 1.0f }, 31.0f },
    .look = PAPER_LOOK(0.90f, 0.60f, 0.15f),
    .start = StartFallingGuy,
};
