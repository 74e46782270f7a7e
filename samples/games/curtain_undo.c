/* Curtain goes back to before a cut: a save of the world, and a copy of the rest. */
#include "curtain_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct CurtainSave {
    Curtain game;
    int64_t size;
    uint8_t bytes[]; /* of the world */
};

/* Of a curtain that has gone since, what it looks like. */
typedef struct Paint {
    uint8_t* rgb[MAX_CLOTHS];
} Paint;

static void DropFirst(Curtain* curtain)
{
    free(curtain->saves[0]);
    curtain->saveCount--;
    memmove(curtain->saves, curtain->saves + 1, sizeof(curtain->saves[0]) * (size_t)curtain->saveCount);
}

void Curtain_Forget(Curtain* curtain)
{
    while (curtain->saveCount > 0) {
        DropFirst(curtain);
    }
}

/* With the last save nobody has cut since: it does as well as a new one, and is older. */
void Curtain_Keep(Curtain* curtain)
{
    int64_t size = 0;
    if (curtain->saveCount > 0 && !curtain->hasCut) {
        free(curtain->saves[--curtain->saveCount]);
    }
    kiriWorld_Save(curtain->world, NULL, 0, &size);
    CurtainSave* save = malloc(sizeof(CurtainSave) + (size_t)size);
    if (save == NULL) {
        fprintf(stderr, "curtain: no memory to go back to tick %d\n", curtain->tick);
        return;
    }
    kiriWorld_Save(curtain->world, save->bytes, size, &save->size);
    save->game = *curtain;
    if (curtain->saveCount == MAX_SAVES) {
        DropFirst(curtain);
    }
    curtain->saves[curtain->saveCount++] = save;
    curtain->hasCut = false;
}

static bool HasPaint(const Curtain* curtain, const CurtainSave* save, int32_t i)
{
    return save->game.cloths[i].sheet == 0 || save->game.cloths[i].sheet == curtain->cloths[i].sheet;
}

static void FreePaint(Paint* paint)
{
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        free(paint->rgb[i]);
    }
}

/* False, with nothing made, for memory. */
static bool MakePaint(const Curtain* curtain, const CurtainSave* save, Paint* paint)
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
        Level_Paint(curtain->level, (int32_t)save->game.cloths[i].texture.revision - 1, paint->rgb[i]);
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
    if (!curtain->hasCut && curtain->saveCount > 1) {
        free(curtain->saves[--curtain->saveCount]); /* nobody has cut since */
    }
    CurtainSave* save = curtain->saveCount > 0 ? curtain->saves[curtain->saveCount - 1] : NULL;
    if (save == NULL || !MakePaint(curtain, save, &paint)) {
        return false;
    }
    if (kiriWorld_Load(curtain->world, save->bytes, save->size) != KIRI_OK) {
        fprintf(stderr, "curtain: undo: %s\n", kiriWorld_GetLastError(curtain->world));
        FreePaint(&paint);
        return false;
    }
    Curtain now = *curtain;
    *curtain = save->game;
    memcpy(curtain->cloths, now.cloths, sizeof curtain->cloths);
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        TakeCloth(curtain, &save->game.cloths[i], paint.rgb[i], i);
    }
    memcpy(curtain->saves, now.saves, sizeof curtain->saves);
    curtain->saveCount = now.saveCount - 1;
    curtain->hasCut = true; /* between this save and the one before */
    curtain->basketSpeed = now.basketSpeed;
    LeavePointers(curtain, &now);
    free(save);
    return true;
}
