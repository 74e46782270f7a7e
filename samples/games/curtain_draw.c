/* What the player of Curtain sees. */
#include "curtain_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const Color sky = { 0.95f, 0.93f, 0.89f, 1.0f }, dusk = { 0.80f, 0.76f, 0.73f, 1.0f };
static const Color boards = { 0.62f, 0.50f, 0.40f, 1.0f }, brass = { 0.82f, 0.66f, 0.30f, 1.0f };
static const Color wicker = { 0.70f, 0.52f, 0.32f, 1.0f }, wickerInside = { 0.56f, 0.40f, 0.24f, 1.0f };
static const Color wood = { 0.52f, 0.36f, 0.25f, 1.0f }, ballColor = { 0.27f, 0.52f, 0.58f, 1.0f };
static const Color skin = { 0.93f, 0.72f, 0.58f, 1.0f }, sleeve = { 0.25f, 0.30f, 0.42f, 1.0f };
static const Color ink = { 0.20f, 0.16f, 0.18f, 1.0f }, paleInk = { 0.20f, 0.16f, 0.18f, 0.55f };
static const Color white = { 1.0f, 1.0f, 1.0f, 1.0f }, panel = { 1.0f, 0.99f, 0.96f, 0.80f };

static const float upright[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
static const float alongX[9] = { 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f };

static CanvasBody MakeBody(int32_t shape, const float position[3], const float rotation[9], Color color)
{
    CanvasBody body = { .shape = shape, .color = color };
    memcpy(body.position, position, sizeof body.position);
    memcpy(body.rotation, rotation, sizeof body.rotation);
    return body;
}

static void DrawBall(Canvas* canvas, const float place[3], float radius, Color color)
{
    CanvasBody ball = MakeBody(CANVAS_SPHERE, place, upright, color);
    ball.radius = radius;
    Canvas_AddBody(canvas, &ball);
}

static void DrawBox(Canvas* canvas, const float place[3], const float size[3], Color color)
{
    CanvasBody box = MakeBody(CANVAS_BOX, place, upright, color);
    memcpy(box.size, size, sizeof box.size);
    Canvas_AddBody(canvas, &box);
}

static void DrawRail(Canvas* canvas)
{
    const float half = 0.98f;
    CanvasBody rail = MakeBody(CANVAS_CYLINDER, (float[3]){ 0.0f, 0.0f, curtainRail }, alongX, brass);
    rail.radius = 0.016f;
    rail.height = 2.0f * half;
    Canvas_AddBody(canvas, &rail);
    DrawBall(canvas, (float[3]){ -half, 0.0f, curtainRail }, 0.034f, brass);
    DrawBall(canvas, (float[3]){ half, 0.0f, curtainRail }, 0.034f, brass);
}

static void DrawRing(Canvas* canvas, const Ring* ring)
{
    if (ring->pin == 0) {
        return;
    }
    const float above[3] = { ring->target[0], 0.0f, curtainRail };
    DrawBall(canvas, ring->target, 0.012f, brass);
    Canvas_AddLine(canvas, ring->target, above, 2.5f, brass);
}

static void DrawBasket(Canvas* canvas, const Curtain* curtain, float alpha)
{
    float x = curtain->basketBefore + alpha * (curtain->basketX - curtain->basketBefore);
    for (int32_t part = 0; part < BASKET_PARTS; part++) {
        float size[3], position[3];
        Basket_GetPart(curtain, part, x, size, position);
        size[0] -= part == 0 ? 0.02f : 0.0f; /* the floor ends inside the walls, not in their planes */
        size[1] -= part == 0 ? 0.02f : 0.0f;
        DrawBox(canvas, position, size, part == 0 ? wickerInside : wicker);
        for (int32_t rib = 0; part > 2 && rib < 9; rib++) { /* the weave of the walls before and behind */
            float from[3] = { position[0] + ((float)rib / 8.0f - 0.5f) * 0.94f * size[0], position[1] - 0.51f * size[1],
                              0.01f };
            float to[3] = { from[0], from[1], basketSize[2] - 0.02f };
            Canvas_AddLine(canvas, from, to, 2.0f, wickerInside);
        }
    }
}

/* An arm that comes from the player's side. */
static void DrawHand(Canvas* canvas, const Hand* hand)
{
    if (hand->pin == 0) {
        return;
    }
    const float axis[3] = { 0.46f, -0.76f, -0.46f };
    float rotation[9] = { 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, axis[0], axis[1], axis[2] }, place[3], palm[3];
    float length = sqrtf(axis[1] * axis[1] + axis[2] * axis[2]); /* first two columns: across the axis */
    memcpy(rotation, (float[3]){ 0.0f, -axis[2] / length, axis[1] / length }, sizeof axis);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        rotation[3 + i] = axis[j] * rotation[k] - axis[k] * rotation[j];
        palm[i] = hand->target[i] + 0.025f * axis[i];
        place[i] = hand->target[i] + 0.21f * axis[i];
    }
    DrawBall(canvas, palm, 0.042f, skin);
    CanvasBody arm = MakeBody(CANVAS_CAPSULE, place, rotation, sleeve);
    arm.radius = 0.032f;
    arm.height = 0.28f;
    Canvas_AddBody(canvas, &arm);
}

static void DrawCloth(Canvas* canvas, Curtain* curtain, Cloth* cloth, float alpha)
{
    CanvasSheet sheet = { .texture = &cloth->texture,
                          .front = white,
                          .back = { 0.74f, 0.70f, 0.70f, 1.0f },
                          .lip = { 0.87f, 0.66f, 0.44f, 1.0f },
                          .rim = { 0.35f, 0.22f, 0.16f, 1.0f } };
    if (cloth->sheet != 0 && Track_Get(&cloth->track, curtain->world, alpha, &sheet)) {
        Canvas_AddSheet(canvas, &sheet);
    }
    for (int32_t i = 0; i < cloth->ringCount; i++) {
        DrawRing(canvas, &cloth->rings[i]);
    }
}

/* ---- Over all else ---------------------------------------------------------------------------------------------- */

static void DrawTrails(Canvas* canvas, const Curtain* curtain)
{
    for (int32_t p = 0; p < MAX_POINTERS; p++) {
        const Pointer* pointer = &curtain->pointers[p];
        for (int32_t i = 0; i + 1 < pointer->trailCount; i++) {
            float share = 1.0f - (float)i / TRAIL;
            Canvas_AddStroke(canvas, pointer->trail + 2 * i, 2, 5.0f * share,
                             (Color){ 1.0f, 1.0f, 1.0f, 0.8f * share });
        }
    }
}

static void DrawNotes(Canvas* canvas, const Curtain* curtain)
{
    for (int32_t i = 0; i < MAX_NOTES; i++) {
        const Note* note = &curtain->notes[i];
        float age = (float)(curtain->tick - note->since) / GAME_RATE, x, y;
        if (note->since > 0 && age < 1.6f && CanvasCamera_Project(&curtainCamera, note->place, &x, &y)) {
            Color color = ink;
            color.alpha = fminf(1.0f, 3.2f - 2.0f * age);
            Canvas_AddText(canvas, x, fmaxf(y - 20.0f, 150.0f) - 30.0f * age, 28.0f, 0.5f, color, note->text);
        }
    }
}

/* Where the wind blows to, from above: a player sees what the next gust does. */
static void DrawWind(Canvas* canvas, const Curtain* curtain)
{
    const float x = 866.0f, y = 118.0f, scale = 12.0f;
    float tip[2] = { x + scale * curtain->wind[0], y - scale * curtain->wind[1] }, from[2] = { x, y };
    const float shaft[4] = { from[0], from[1], tip[0], tip[1] };
    Canvas_AddDisc(canvas, x, y, 40.0f, panel);
    Canvas_AddStroke(canvas, shaft, 2, 5.0f, paleInk);
    Canvas_AddDisc(canvas, tip[0], tip[1], 7.0f, ink);
    Canvas_AddText(canvas, x, y + 48.0f, 15.0f, 0.5f, ink, "wind");
}

static void DrawStatus(Canvas* canvas, const Curtain* curtain)
{
    const Level* level = curtain->level;
    char text[64];
    Canvas_AddRectangle(canvas, 0.0f, 0.0f, GAME_WIDTH, 58.0f, panel);
    Canvas_AddText(canvas, 24.0f, 18.0f, 22.0f, 0.0f, ink, level->name);
    for (int32_t i = 0; i < level->wanted; i++) {
        float x = 0.5f * GAME_WIDTH + 40.0f * ((float)i - 0.5f * (float)(level->wanted - 1));
        Canvas_AddDisc(canvas, x, 29.0f, 15.0f, paleInk);
        Canvas_AddDisc(canvas, x, 29.0f, 12.0f, i < curtain->collected ? brass : sky);
    }
    int32_t left = level->seconds - curtain->tick / GAME_RATE;
    if (level->seconds > 0) {
        snprintf(text, sizeof text, "%d s   score %d", left > 0 ? left : 0, curtain->score);
    } else {
        snprintf(text, sizeof text, "caught %d   score %d", curtain->collected, curtain->score);
    }
    Canvas_AddText(canvas, GAME_WIDTH - 24.0f, 18.0f, 22.0f, 1.0f, ink, text);
    if (curtain->tick < 8 * GAME_RATE && curtain->state == GAME_PLAYING) {
        Canvas_AddText(canvas, 0.5f * GAME_WIDTH, GAME_HEIGHT - 36.0f, 16.0f, 0.5f, ink, level->hint);
    }
}

static void DrawEnd(Canvas* canvas, const Curtain* curtain)
{
    char text[64];
    if (curtain->state == GAME_PLAYING) {
        return;
    }
    Canvas_AddRectangle(canvas, 0.0f, 250.0f, GAME_WIDTH, 150.0f, panel);
    snprintf(text, sizeof text, curtain->state == GAME_WON ? "Done: %d points" : "Time is over", curtain->score);
    Canvas_AddText(canvas, 0.5f * GAME_WIDTH, 280.0f, 42.0f, 0.5f, ink, text);
    Canvas_AddText(canvas, 0.5f * GAME_WIDTH, 350.0f, 20.0f, 0.5f, paleInk, "R: again    N: next level");
}

void Curtain_Draw(void* game, Canvas* canvas, float alpha)
{
    Curtain* curtain = game;
    Canvas_Begin(canvas, &curtainCamera, sky, dusk);
    Canvas_SetWall(canvas, 1.1f, sky);
    Canvas_SetFloor(canvas, 0.0f, boards);
    DrawRail(canvas);
    DrawBall(canvas, ballPlace, ballRadius, ballColor);
    DrawBox(canvas, tablePlace, tableSize, wood);
    DrawBasket(canvas, curtain, alpha);
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        DrawCloth(canvas, curtain, &curtain->cloths[i], alpha);
    }
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        DrawHand(canvas, &curtain->hands[i]);
    }
    DrawTrails(canvas, curtain);
    DrawNotes(canvas, curtain);
    DrawWind(canvas, curtain);
    DrawStatus(canvas, curtain);
    DrawEnd(canvas, curtain);
}
