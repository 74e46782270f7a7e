/* Curtain goes back to before a cut: a save of the world, and a copy of the rest. */
#include "curtain_parts.h"

#include <stdlib.h>
#include <string.h>

/* Of a curtain that has gone since, what it looks like. */
typedef struct Paint {
    uint8_t* rgb[MAX_CLOTHS];
} Paint;

void Curtain_Keep(Curtain* curtain)
{
    Curtain* game = malloc(sizeof(Curtain));
    if (game != NULL) {
        *game = *curtain;
    }
    Undo_Keep(&curtain->undo, curtain->world, game);
}

static bool HasPaint(const Curtain* curtain, const Curtain* save, int32_t i)
{
    return save->cloths[i].sheet == 0 || save->cloths[i].sheet == curtain->cloths[i].sheet;
}

static void FreePaint(Paint* paint)
{
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        free(paint->rgb[i]);
    }
}

/* False, with nothing made, for memory. */
static bool MakePaint(const Curtain* curtain, const Curtain* save, Paint* paint)
{
    memset(paint, 0, sizeof *paint);
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        if (HasPaint(curtain, save, i)) {
            continue;
        }
        paint->rgb[i] = malloc(3 * TEXTURE_SIZE * TEXTURE_SIZE);
        if (paint->rgb[i] == NULL) {
            FreePaint(paint);
            return false;
        }
        Level_Paint(curtain->level, (int32_t)save->cloths[i].texture.revision - 1, paint->rgb[i]);
    }
    return true;
}

/* The curtain as it was, with its paint. What was drawn of it since is of no use. */
static void TakeCloth(Curtain* curtain, const Cloth* was, uint8_t* rgb, int32_t i)
{
    Cloth* cloth = &curtain->cloths[i];
    uint8_t* kept = cloth->rgb;
    Track_Free(&cloth->track);
    *cloth = *was;
    if (was->sheet == 0 || rgb != NULL) {
        free(kept);
        kept = rgb;
    }
    cloth->rgb = kept;
    cloth->texture.rgb = kept;
    Track_Init(&cloth->track, cloth->sheet);
}

/* Blades end, and hands stay where they were: what pointers do now is not what they did then. */
static void LeavePointers(Curtain* curtain, const Curtain* now)
{
    for (int32_t i = 0; i < MAX_POINTERS; i++) {
        if (curtain->pointers[i].blade != 0) {
            kiriBlade_End(curtain->world, curtain->pointers[i].blade);
        }
        curtain->pointers[i] = now->pointers[i];
        curtain->pointers[i].blade = 0;
        curtain->pointers[i].trailCount = 0;
    }
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        curtain->hands[i].pointer = -1;
    }
}

bool Curtain_Undo(Curtain* curtain)
{
    Paint paint;
    const Curtain* save = Undo_GetGame(&curtain->undo);
    if (save == NULL || !MakePaint(curtain, save, &paint)) {
        return false;
    }
    if (!Undo_LoadWorld(&curtain->undo, curtain->world)) {
        FreePaint(&paint);
        return false;
    }
    Curtain now = *curtain;
    *curtain = *save;
    memcpy(curtain->cloths, now.cloths, sizeof curtain->cloths);
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        TakeCloth(curtain, &save->cloths[i], paint.rgb[i], i);
    }
    curtain->undo = now.undo;
    curtain->basketSpeed = now.basketSpeed;
    LeavePointers(curtain, &now);
    Undo_Drop(&curtain->undo);
    return true;
}
