/* Sheets of card that fold. */
#include "creases.h"
#include "scene_parts.h"
#include "scene_types.h"

#include <math.h>
#include <stdio.h>

static kiriSheetDef LevelCard(const Scene* scene, const float corner[3], int32_t frames, int32_t grid)
{
    kiriMaterial card;
    kiriGetMaterial(KIRI_MATERIAL_CARD, &card);
    card.airDamping = 4.0f;
    kiriSheetDef def = Scene_PlaceSheet(scene, corner, (float[]){ 0.0f, 1.0f, 0.0f }, card);
    def.frameCount = frames;
    def.gridResolution = grid;
    return def;
}

static void SetFold(const Scene* scene, int32_t fold, float stiffness, float angle)
{
    kiriSheet_SetFold(scene->world, scene->sheet, fold, stiffness, angle);
}

/* Makes a fold between two points, in sizes of the scene. */
static kiriFold FoldAt(const Scene* scene, float u, float v, float toU, float toV, float stiffness)
{
    const float size = scene->type->size;
    return (kiriFold){ { size * u, size * v }, { size * toU, size * toV }, stiffness, 0.0f, 0.0f };
}

#define CARD_LOOK(red, green, blue)                                                                                    \
    {                                                                                                                  \
        { 0.86f, 0.84f, 0.79f }, { red, green, blue }, { 0.45f, 0.42f, 0.40f }, 0.0f                                   \
    }

/* ---- Miura: folds from flat, is cut in two, and one half opens while the other one closes ------------------------ */

enum { CELLS = 6, ZIGZAGS = CELLS * (CELLS - 1), FOLD_FIRST = 30, FOLD_LAST = 270, PART_TICKS = 160 };

static float ZigzagAt(int32_t i, int32_t j)
{
    return ((float)i + (j % 2 != 0 ? 0.25f : -0.25f)) / CELLS;
}

/* Zigzags first, line by line; then the straight lines, which are free hinges. */
static bool StartMiura(Scene* scene, const SceneOptions* options)
{
    kiriFold folds[2 * ZIGZAGS];
    for (int32_t i = 1; i < CELLS; i++) {
        for (int32_t j = 0; j < CELLS; j++) {
            float v = (float)j / CELLS, line = (float)i / CELLS;
            int32_t at = CELLS * (i - 1) + j;
            folds[at] = FoldAt(scene, ZigzagAt(i, j), v, ZigzagAt(i, j + 1), v + 1.0f / CELLS, 0.02f);
            folds[ZIGZAGS + at] = FoldAt(scene, j == 0 ? 0.0f : ZigzagAt(j, i), line,
                                         j == CELLS - 1 ? 1.0f : ZigzagAt(j + 1, i), line, 0.0f);
        }
    }
    kiriSheetDef def = LevelCard(scene, (float[]){ -0.5f, -0.5f, 0.1f }, CELLS * CELLS, 72);
    scene->folds = folds;
    scene->foldCount = 2 * ZIGZAGS;
    return Scene_MakeRectangle(scene, &def, options, &(Rectangle){ 1.0f, 1.0f, 24, 24, NULL }) &&
           Scene_AddLine(scene, 0.58f, -0.05f, 0.58f, 1.05f);
}

static void FoldMiura(Scene* scene)
{
    int32_t first = scene->type->lastCut, last = first + Scene_Slow(PART_TICKS, scene->pace);
    float folded = 1.5f * Scene_Ease(scene->tick, FOLD_FIRST, FOLD_LAST), parted = Scene_Ease(scene->tick, first, last);
    for (int32_t k = 0; k < ZIGZAGS; k++) {
        int32_t line = k / CELLS;
        float angle = folded + parted * (line < CELLS / 2 ? -1.2f : 0.9f); /* to the left and right of the cut */
        SetFold(scene, k, 0.02f, line % 2 != 0 ? angle : -angle);
    }
}

const SceneType miuraScene = {
    .name = "miura",
    .about = "a flat sheet of card folds along 60 lines, is cut in two, and one half opens while the other closes",
    .size = 0.24f,
    .ticks = 600,
    .substeps = 2,
    .firstCut = 300,
    .lastCut = 380,
    .moments = { 30, 180, 290, 420, 480, 600 },
    .camera = { { 1.3f, -1.8f, 1.6f }, { 0.0f, 0.0f, 0.05f }, 30.0f },
    .look = CARD_LOOK(0.85f, 0.42f, 0.30f),
    .start = StartMiura,
    .push = FoldMiura,
};

/* ---- Card: two cuts free a strip across its spine, which becomes a step as the card opens ------------------------ */

enum { SPINES = 2, STEP = SPINES, CARD_FOLDS = 5, OPEN_PAUSE = 20, OPEN_TICKS = 180 };

static bool StartCard(Scene* scene, const SceneOptions* options)
{
    const float third = 1.0f / 3.0f, left = 0.4f, spine = 2.0f / 3.0f, right = 1.13f, edge = left + right - spine;
    const kiriFold folds[CARD_FOLDS] = {
        FoldAt(scene, spine, 0.0f, spine, third, 0.002f),        FoldAt(scene, spine, 2.0f * third, spine, 1.0f, 0.002f),
        FoldAt(scene, edge, third, edge, 2.0f * third, 0.002f), FoldAt(scene, left, third, left, 2.0f * third, 0.0f),
        FoldAt(scene, right, third, right, 2.0f * third, 0.0f),
    };
    const float size = scene->type->size;
    kiriSheetDef def = LevelCard(scene, (float[]){ -spine, -0.5f, floorGap }, 16, 40);
    kiriPin pin;
    scene->folds = folds;
    scene->foldCount = CARD_FOLDS;
    return Scene_MakeRectangle(scene, &def, options, &(Rectangle){ 4.0f * third, 1.0f, 40, 30, NULL }) &&
           kiriSheet_ClampLine(scene->world, scene->sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 0.0f, size }, &pin) ==
               KIRI_OK &&
           Scene_AddLine(scene, left, third, right, third) && Scene_AddLine(scene, left, 2.0f * third, right, 2.0f * third);
}

static void OpenCard(Scene* scene)
{
    int32_t first = scene->type->lastCut + Scene_Slow(OPEN_PAUSE, scene->pace);
    float angle = 1.57f * Scene_Ease(scene->tick, first, first + Scene_Slow(OPEN_TICKS, scene->pace));
    for (int32_t k = 0; k <= STEP; k++) {
        SetFold(scene, k, 0.3f, k < SPINES ? angle : -angle);
    }
}

const SceneType cardScene = {
    .name = "card",
    .about = "two cuts free a strip across the spine of a card, which becomes a step as the card opens",
    .size = 0.15f,
    .ticks = 400,
    .substeps = 4,
    .firstCut = 20,
    .lastCut = 120,
    .moments = { 20, 120, 190, 230, 260, 400 },
    .camera = { { -1.9f, -2.0f, 1.9f }, { -0.05f, 0.0f, 0.3f }, 34.0f },
    .look = CARD_LOOK(0.25f, 0.45f, 0.65f),
    .start = StartCard,
    .push = OpenCard,
};

/* ---- Crane: a bird base from a FOLD file folds by its rest angles -------------------------------------------------- */

enum { CRANE_FOLDS = 64, CRANE_FIRST = 20, CRANE_LAST = 380 };

static bool ReadFolds(Scene* scene, const SceneOptions* options, const char* name, kiriFold* folds)
{
    char path[1024], text[4096];
    Import drawing = { 0 };
    snprintf(path, sizeof path, "%s/%s.fold", options->dataFolder, name);
    FILE* file = fopen(path, "rb");
    size_t size = file != NULL ? fread(text, 1, sizeof text, file) : 0;
    if (file != NULL) {
        fclose(file);
    }
    bool fine = Import_Read(&drawing, text, (int64_t)size, 0.01) && Import_Join(&drawing, 0.01);
    if (fine) {
        float unit = scene->type->size / (float)Import_GetSize(&drawing);
        scene->folds = folds;
        scene->foldCount = Creases_Make(&drawing, unit, 0.02f, folds, scene->ways, CRANE_FOLDS);
        scene->wayCount = scene->foldCount;
    }
    Import_Free(&drawing);
    return fine && scene->foldCount <= CRANE_FOLDS;
}

static bool StartCrane(Scene* scene, const SceneOptions* options)
{
    kiriFold folds[CRANE_FOLDS];
    kiriSheetDef def = LevelCard(scene, (float[]){ -0.5f, -0.5f, 0.75f }, 64, 64);
    return kiriWorld_SetGravity(scene->world, (float[]){ 0.0f, 0.0f, 0.0f }) == KIRI_OK &&
           ReadFolds(scene, options, "birdbase", folds) &&
           Scene_MakeRectangle(scene, &def, options, &(Rectangle){ 1.0f, 1.0f, 40, 40, NULL }) &&
           Scene_PinHere(scene, &def, 0.5f, 0.5f);
}

static void FoldCrane(Scene* scene)
{
    float angle = 3.0f * Scene_Ease(scene->tick, CRANE_FIRST, CRANE_LAST);
    for (int32_t k = 0; k < scene->wayCount; k++) {
        kiriFoldState state;
        kiriSheet_GetFold(scene->world, scene->sheet, k, &state);
        const float *a = state.fold.from, *b = state.fold.to;
        float off = fmaxf(fabsf(a[0] - a[1]), fabsf(b[0] - b[1])); /* from the diagonal between the petals */
        bool isDriven = scene->ways[k] < 0.0f && off < 0.6f * scene->type->size;
        SetFold(scene, k, isDriven ? 0.05f : 0.001f, scene->ways[k] * angle);
    }
}

const SceneType craneScene = {
    .name = "crane",
    .about = "a square of card from a FOLD file folds to the base of a crane",
    .size = 0.24f,
    .ticks = 460,
    .substeps = 2,
    .moments = { 20, 130, 190, 240, 290, 460 },
    .camera = { { 1.3f, -1.8f, 1.6f }, { 0.0f, 0.0f, 0.62f }, 30.0f },
    .look = { { 0.22f, 0.50f, 0.60f }, { 0.88f, 0.86f, 0.80f }, { 0.45f, 0.42f, 0.40f }, 0.0f },
    .start = StartCrane,
    .push = FoldCrane,
};
