/* What a game goes back to: how its kiriWorld was before the last cuts, each time with what the game knows beside
   it. */
#ifndef UNDO_H
#define UNDO_H

#include "kiri/kiri.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { UNDO_SAVES = 8 };

typedef struct UndoSave {
    void* game;     /* what the game knows */
    uint8_t* bytes; /* of the world */
    int64_t size;
} UndoSave;

typedef struct Undo {
    void (*freeGame)(void* game);
    UndoSave saves[UNDO_SAVES]; /* the last one is the youngest */
    int32_t count;
    bool hasCut; /* since the last of them; the game sets it */
} Undo;

void Undo_Init(Undo* undo, void (*freeGame)(void* game));
void Undo_Clear(Undo* undo);

/* A cut may begin: keeps the world as it is, and `game`, which is freed with it. It takes the place of a save after
   which nobody has cut, and else of the oldest where there are many. False: no memory; nothing is kept, and `game` is
   freed. */
bool Undo_Keep(Undo* undo, const kiriWorld* world, void* game);

/* What the game knew before the last cut; null: no cut is kept. */
const void* Undo_GetGame(Undo* undo);

/* The world as it was then. False, with nothing changed: it says on stderr why. */
bool Undo_LoadWorld(const Undo* undo, kiriWorld* world);

/* All is as it was then: the next one to go back to is the one before. */
void Undo_Drop(Undo* undo);

#ifdef __cplusplus
}
#endif

#endif
