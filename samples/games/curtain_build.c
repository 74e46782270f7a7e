/* Cloths on their rings, the basket, and what else stands there. */
#include "curtain_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 44, ROWS = 32, FRAME_ROWS = 6, MAX_FRAMES = 160 };

static const float wall = 0.05f; /* of the basket, m: how thick */

bool Curtain_Check(const Curtain* curtain, kiriResult result, const char* what)
{
    if (result < 0) {
        fprintf(stderr, "curtain: tick %d: %s: %s: %s\n", curtain->tick, what, kiriGetResultName(result),
                kiriWorld_GetLastError(curtain->world));
    }
    return result >= 0;
}

static bool AddRings(Curtain* curtain, Cloth* cloth, float depth)
{
    const Level* level = curtain->level;
    cloth->ringCount = level->rings;
    for (int32_t i = 0; i < level->rings; i++) {
        Ring* ring = &cloth->rings[i];
        kiriPinDef def;
        kiriDefaultPinDef(&def);
        def.restPoint[0] = level->width * (float)i / (float)(level->rings - 1);
        def.restPoint[1] = level->height;
        def.target[0] = def.restPoint[0] - 0.5f * level->width;
        def.target[1] = depth;
        def.target[2] = curtainRail - 0.06f;
        def.breakForce = level->breakForce;
        memcpy(ring->start, def.target, sizeof ring->start);
        memcpy(ring->target, def.target, sizeof ring->target);
        if (!Curtain_Check(curtain, kiriCreatePin(curtain->world, cloth->sheet, &def, &ring->pin), "ring")) {
            return false;
        }
    }
    return true;
}

static void FillSheetDef(const Curtain* curtain, float depth, kiriSheetDef* def)
{
    const Level* level = curtain->level;
    kiriDefaultSheetDef(def);
    def->position[0] = -0.5f * level->width;
    def->position[1] = depth;
    def->position[2] = curtainRail - 0.06f - level->height;
    def->axisV[1] = 0.0f;
    def->axisV[2] = 1.0f;
    def->material.airDamping = 0.4f;
    def->maxFrames = MAX_FRAMES;
    def->gridResolution = 64;
    def->crumbArea = crumbArea;
    def->skinning = KIRI_SKINNING_SMOOTH;
    def->touchesSheets = 1;
    def->contactThickness = 0.008f;
}

/* Rows of frames below the rings: where the folds are to be. Frames that do not know of the folds let it buckle in
   other ways, upwards above the rail for one. */
static int32_t PlaceFrames(const Level* level, float* points)
{
    const float inside = 0.03f; /* m: from the border */
    for (int32_t i = 0; i < level->rings * FRAME_ROWS; i++) {
        int32_t ring = i % level->rings, row = i / level->rings;
        float u = level->width * (float)ring / (float)(level->rings - 1);
        points[2 * i] = fmaxf(inside, fminf(level->width - inside, u));
        points[2 * i + 1] = level->height * ((float)row + 0.5f) / FRAME_ROWS;
    }
    return level->rings * FRAME_ROWS;
}

bool Curtain_AddCloth(Curtain* curtain, Cloth* cloth, int32_t layer)
{
    static float rest[2 * (COLUMNS + 1) * (ROWS + 1)];
    static int32_t indices[6 * COLUMNS * ROWS];
    static float framePoints[2 * MAX_RINGS * FRAME_ROWS];
    const Level* level = curtain->level;
    float depth = 0.14f * (float)layer;
    memset(cloth, 0, sizeof *cloth);
    cloth->madeAt = curtain->tick;
    cloth->rgb = malloc(3 * TEXTURE_SIZE * TEXTURE_SIZE);
    if (cloth->rgb == NULL) {
        fprintf(stderr, "curtain: no memory\n");
        return false;
    }
    Level_Paint(level, curtain->clothsMade, cloth->rgb);
    cloth->texture = (CanvasTexture){ .rgb = cloth->rgb,
                                      .columns = TEXTURE_SIZE,
                                      .rows = TEXTURE_SIZE,
                                      .width = level->width,
                                      .height = level->height,
                                      .revision = (uint32_t)++curtain->clothsMade };
    kiriFillRectangle(level->width, level->height, COLUMNS, ROWS, rest, indices);
    kiriSheetDef def;
    FillSheetDef(curtain, depth, &def);
    def.restPositions = rest;
    def.vertexCount = (COLUMNS + 1) * (ROWS + 1);
    def.indices = indices;
    def.triangleCount = 2 * COLUMNS * ROWS;
    def.framePoints = framePoints;
    def.frameCount = PlaceFrames(level, framePoints);
    if (!Curtain_Check(curtain, kiriCreateSheet(curtain->world, &def, &cloth->sheet), "sheet")) {
        return false;
    }
    Track_Init(&cloth->track, cloth->sheet);
    return AddRings(curtain, cloth, depth);
}

void Basket_GetPart(const Curtain* curtain, int32_t part, float x, float size[3], float position[3])
{
    (void)curtain;
    int axis = part < 3 ? 0 : 1;
    float side = part % 2 == 1 ? 1.0f : -1.0f;
    memcpy(size, basketSize, sizeof basketSize);
    position[0] = x;
    position[1] = basketY;
    position[2] = 0.5f * basketSize[2];
    if (part == 0) {
        size[2] = wall;
        position[2] = 0.5f * wall;
        return;
    }
    size[axis] = wall;
    position[axis] += side * 0.5f * (basketSize[axis] - wall);
}

static bool AddObstacle(Curtain* curtain, kiriObstacleDef* def, const float position[3], kiriObstacle* obstacle)
{
    memcpy(def->position, position, sizeof def->position);
    return Curtain_Check(curtain, kiriCreateObstacle(curtain->world, def, obstacle), "obstacle");
}

static bool AddObstacles(Curtain* curtain)
{
    kiriObstacle obstacle;
    kiriObstacleDef def;
    kiriDefaultObstacleDef(&def);
    def.type = KIRI_OBSTACLE_PLANE;
    bool fine = AddObstacle(curtain, &def, (float[3]){ 0.0f, 0.0f, 0.0f }, &obstacle);
    def.type = KIRI_OBSTACLE_SPHERE;
    def.radius = ballRadius;
    fine = fine && AddObstacle(curtain, &def, ballPlace, &obstacle);
    def.type = KIRI_OBSTACLE_BOX;
    memcpy(def.size, tableSize, sizeof def.size);
    fine = fine && AddObstacle(curtain, &def, tablePlace, &obstacle);
    for (int32_t i = 0; fine && i < BASKET_PARTS; i++) {
        float position[3];
        Basket_GetPart(curtain, i, curtain->basketX, def.size, position);
        fine = AddObstacle(curtain, &def, position, &curtain->basket[i]);
    }
    return fine;
}

void Curtain_DropCloth(Curtain* curtain, Cloth* cloth)
{
    if (cloth->sheet != 0) {
        kiriDestroySheet(curtain->world, cloth->sheet);
    }
    Track_Free(&cloth->track);
    free(cloth->rgb);
    memset(cloth, 0, sizeof *cloth);
}

int32_t Curtain_FindCloth(const Curtain* curtain, kiriSheet sheet)
{
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        if (sheet != 0 && curtain->cloths[i].sheet == sheet) {
            return i;
        }
    }
    return -1;
}

void Curtain_Stop(void* game)
{
    Curtain* curtain = game;
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        Curtain_DropCloth(curtain, &curtain->cloths[i]);
    }
    Undo_Clear(&curtain->undo);
    kiriDestroyWorld(curtain->world);
    free(curtain);
}

void* Curtain_Start(int32_t number, const GameHost* host)
{
    Curtain* curtain = calloc(1, sizeof(Curtain));
    if (curtain == NULL || kiriCreateWorld(&host->worldDef, &curtain->world) != KIRI_OK) {
        fprintf(stderr, "curtain: no memory\n");
        free(curtain);
        return NULL;
    }
    curtain->host = *host;
    curtain->level = &levels[number - 1];
    curtain->demo.mark = -1;
    Undo_Init(&curtain->undo, free);
    bool fine = AddObstacles(curtain);
    for (int32_t i = 0; fine && i < curtain->level->curtains; i++) {
        fine = Curtain_AddCloth(curtain, &curtain->cloths[i], i);
    }
    if (!fine) {
        Curtain_Stop(curtain);
        return NULL;
    }
    return curtain;
}
