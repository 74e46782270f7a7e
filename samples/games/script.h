/* Events in a text file: what was recorded in a window plays again without one.

     game net          which, and
     level 2           where it starts; both once, at the top
     120 down 0 1 480 360     tick, type, pointer, button, x, y
     121 move 0 490 362       tick, type, pointer, x, y
     130 up 0 1 560 380
     140 keydown r            or space, left, right, up, down
     900 end                  the tick before which the recording stopped
     # and a comment */
#ifndef SCRIPT_H
#define SCRIPT_H

#include "game.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { SCRIPT_NAME_SIZE = 32 };

typedef struct Script {
    char game[SCRIPT_NAME_SIZE]; /* "": not said */
    int32_t level;               /* 0: not said */
    GameEvent* events;           /* in the order of their ticks */
    int32_t count, capacity;
    int32_t end;  /* tick; after the last event when not said */
    int32_t next; /* the first event that nobody took */
} Script;

/* False, with nothing to free: it says on stderr what is wrong, and in which line. */
bool Script_Read(Script* script, const char* path);
void Script_Free(Script* script);

/* The next event of this tick or earlier ones; null: there are none. */
const GameEvent* Script_Take(Script* script, int32_t tick);

void Script_WriteStart(FILE* file, const char* game, int32_t level);
void Script_WriteEvent(FILE* file, const GameEvent* event);
void Script_WriteEnd(FILE* file, int32_t tick);

#ifdef __cplusplus
}
#endif

#endif
