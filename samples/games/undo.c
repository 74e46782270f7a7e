#include "undo.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void Undo_Init(Undo* undo, void (*freeGame)(void* game))
{
    memset(undo, 0, sizeof *undo);
    undo->freeGame = freeGame;
}

static void FreeLast(Undo* undo)
{
    UndoSave* last = &undo->saves[--undo->count];
    undo->freeGame(last->game);
    free(last->bytes);
}

static void FreeFirst(Undo* undo)
{
    undo->freeGame(undo->saves[0].game);
    free(undo->saves[0].bytes);
    undo->count--;
    memmove(undo->saves, undo->saves + 1, sizeof(undo->saves[0]) * (size_t)undo->count);
}

void Undo_Clear(Undo* undo)
{
    while (undo->count > 0) {
        FreeLast(undo);
    }
}

bool Undo_Keep(Undo* undo, const kiriWorld* world, void* game)
{
    UndoSave save = { game, NULL, 0 };
    if (undo->count > 0 && !undo->hasCut) {
        FreeLast(undo);
        undo->hasCut = true; /* between the one before and now */
    }
    if (game != NULL && kiriWorld_Save(world, NULL, 0, &save.size) == KIRI_OK) {
        save.bytes = malloc((size_t)save.size);
    }
    if (save.bytes == NULL || kiriWorld_Save(world, save.bytes, save.size, &save.size) != KIRI_OK) {
        fprintf(stderr, "undo: no memory to go back to this tick\n");
        undo->freeGame(game);
        free(save.bytes);
        return false;
    }
    if (undo->count == UNDO_SAVES) {
        FreeFirst(undo);
    }
    undo->saves[undo->count++] = save;
    undo->hasCut = false;
    return true;
}

const void* Undo_GetGame(Undo* undo)
{
    if (undo->count > 1 && !undo->hasCut) {
        FreeLast(undo);
        undo->hasCut = true;
    }
    return undo->count > 0 ? undo->saves[undo->count - 1].game : NULL;
}

bool Undo_LoadWorld(const Undo* undo, kiriWorld* world)
{
    const UndoSave* last = &undo->saves[undo->count - 1];
    bool isLoaded = kiriWorld_Load(world, last->bytes, last->size) == KIRI_OK;
    if (!isLoaded) {
        fprintf(stderr, "undo: %s\n", kiriWorld_GetLastError(world));
    }
    return isLoaded;
}

void Undo_Drop(Undo* undo)
{
    FreeLast(undo);
    undo->hasCut = true; /* between this save and the one before */
}
