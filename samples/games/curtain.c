/* Curtain: cut the marked shapes out of a curtain in the wind, so that they fall into the basket. */
#include "games.h"
#include "track.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 48, ROWS = 40, PINS = 9 };

static const float width = 1.6f, height = 1.2f;

static const GameCamera camera = { { 0.35f, -3.6f, 1.3f }, { 0.0f, 0.0f, 0.8f }, 34.0f, 0.0f };

typedef struct Curtain {
    GameHost host;
    kiriWorld* world;
    kiriSheet sheet;
    kiriPin pins[PINS];
    Track track;
    kiriCut cut;
    int32_t tick;
} Curtain;

static void Curtain_Stop(void* game)
{
    Curtain* curtain = game;
    Track_Free(&curtain->track);
    kiriDestroyWorld(curtain->world);
    free(curtain);
}

static bool MakeSheet(Curtain* curtain)
{
    static float rest[2 * (COLUMNS + 1) * (ROWS + 1)];
    static int32_t indices[6 * COLUMNS * ROWS];
    kiriFillRectangle(width, height, COLUMNS, ROWS, rest, indices);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.restPositions = rest;
    def.vertexCount = (COLUMNS + 1) * (ROWS + 1);
    def.indices = indices;
    def.triangleCount = 2 * COLUMNS * ROWS;
    def.position[0] = -0.5f * width;
    def.position[2] = 0.3f;
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    def.frameCount = 48;
    def.gridResolution = 64;
    kiriResult result = kiriCreateSheet(curtain->world, &def, &curtain->sheet);
    for (int i = 0; i < PINS && result == KIRI_OK; i++) {
        kiriPinDef pin;
        kiriDefaultPinDef(&pin);
        pin.restPoint[0] = width * (float)i / (PINS - 1);
        pin.restPoint[1] = height;
        pin.target[0] = 0.9f * (pin.restPoint[0] - 0.5f * width);
        pin.target[1] = i % 2 == 0 ? 0.05f : -0.05f;
        pin.target[2] = 0.3f + height;
        result = kiriCreatePin(curtain->world, curtain->sheet, &pin, &curtain->pins[i]);
    }
    Track_Init(&curtain->track, curtain->sheet);
    return result == KIRI_OK;
}

static void* Curtain_Start(int32_t level, const GameHost* host)
{
    (void)level;
    Curtain* curtain = calloc(1, sizeof(Curtain));
    if (curtain == NULL) {
        return NULL;
    }
    curtain->host = *host;
    if (kiriCreateWorld(&host->worldDef, &curtain->world) != KIRI_OK || !MakeSheet(curtain)) {
        fprintf(stderr, "curtain: %s\n", kiriWorld_GetLastError(curtain->world));
        Curtain_Stop(curtain);
        return NULL;
    }
    return curtain;
}

static void Curtain_Event(void* game, const GameEvent* event)
{
    Curtain* curtain = game;
    float origin[3], direction[3];
    kiriHit hit;
    if (event->type == GAME_KEY_PRESSED || event->type == GAME_KEY_RELEASED) {
        return;
    }
    GameCamera_GetRay(&camera, (float)event->x, (float)event->y, origin, direction);
    kiriSheet_Raycast(curtain->world, curtain->sheet, origin, direction, 10.0f, &hit);
    if (event->type == GAME_DOWN && hit.triangle >= 0) {
        kiriBeginCut(curtain->world, curtain->sheet, hit.restPoint, &curtain->cut);
    } else if (event->type == GAME_MOVE && curtain->cut != 0 && hit.triangle >= 0) {
        kiriCut_Extend(curtain->world, curtain->cut, hit.restPoint, 1);
        Sounds_Play(curtain->host.sounds, SOUND_CUT, 0.5f);
    } else if (event->type == GAME_UP && curtain->cut != 0) {
        kiriCut_End(curtain->world, curtain->cut);
        curtain->cut = 0;
    }
}

static bool Curtain_Tick(void* game)
{
    Curtain* curtain = game;
    Track_BeforeTick(&curtain->track, curtain->world);
    kiriResult result = kiriWorld_Tick(curtain->world, GAME_DT, 2);
    curtain->tick++;
    if (result < 0) {
        fprintf(stderr, "curtain: tick %d: %s\n", curtain->tick, kiriWorld_GetLastError(curtain->world));
    }
    return result >= 0 || result == KIRI_DIVERGED;
}

static void Curtain_Draw(void* game, Canvas* canvas, float alpha)
{
    Curtain* curtain = game;
    Canvas_Begin(canvas, &camera, (Color){ 0.93f, 0.92f, 0.90f, 1.0f }, (Color){ 0.78f, 0.78f, 0.80f, 1.0f });
    Canvas_SetFloor(canvas, 0.0f, (Color){ 0.72f, 0.66f, 0.58f, 1.0f });
    CanvasSheet sheet = { .front = { 0.72f, 0.15f, 0.17f, 1.0f }, .back = { 0.5f, 0.1f, 0.12f, 1.0f } };
    sheet.lip = (Color){ 1.0f, 0.9f, 0.8f, 1.0f };
    sheet.rim = (Color){ 0.3f, 0.05f, 0.06f, 1.0f };
    if (Track_Get(&curtain->track, curtain->world, alpha, &sheet)) {
        Canvas_AddSheet(canvas, &sheet);
    }
    CanvasBody rail = { .shape = CANVAS_CYLINDER, .radius = 0.02f, .height = 2.0f, .position = { 0.0f, 0.0f, 1.53f } };
    memcpy(rail.rotation, (float[9]){ 0, 1, 0, 0, 0, 1, 1, 0, 0 }, sizeof rail.rotation);
    rail.color = (Color){ 0.75f, 0.62f, 0.3f, 1.0f };
    Canvas_AddBody(canvas, &rail);
    CanvasBody ball = { .shape = CANVAS_SPHERE, .radius = 0.15f, .position = { 0.4f, -0.3f, 0.15f } };
    memcpy(ball.rotation, (float[9]){ 1, 0, 0, 0, 1, 0, 0, 0, 1 }, sizeof ball.rotation);
    ball.color = (Color){ 0.3f, 0.5f, 0.7f, 1.0f };
    Canvas_AddBody(canvas, &ball);
    CanvasBody box = { .shape = CANVAS_BOX, .size = { 0.3f, 0.3f, 0.2f }, .position = { -0.4f, -0.3f, 0.1f } };
    memcpy(box.rotation, ball.rotation, sizeof ball.rotation);
    box.color = (Color){ 0.8f, 0.6f, 0.4f, 1.0f };
    Canvas_AddBody(canvas, &box);
    Canvas_AddText(canvas, 24.0f, 24.0f, 21.0f, 0.0f, (Color){ 0.2f, 0.2f, 0.25f, 1.0f }, "Curtain  0123456789");
}

static void Curtain_GetStatus(void* game, GameStatus* status)
{
    Curtain* curtain = game;
    *status = (GameStatus){ .state = GAME_PLAYING };
    kiriWorld_GetStateHash(curtain->world, &status->hash);
}

const GameType curtainGame = { .name = "curtain",
                               .about = "cut the marked shapes out of a curtain in the wind",
                               .levels = 1,
                               .start = Curtain_Start,
                               .stop = Curtain_Stop,
                               .event = Curtain_Event,
                               .tick = Curtain_Tick,
                               .draw = Curtain_Draw,
                               .getStatus = Curtain_GetStatus };
