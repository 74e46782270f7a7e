/* What a game is: a struct of functions. shell.h runs it in a window or from a script, play.h without either. */
#ifndef GAME_H
#define GAME_H

#include "../canvas.h"
#include "sound.h"

#include "kiri/kiri.h"

#include <stdbool.h>
#include <stdint.h>

/* Ticks a second; and the size of the overlay, in which events have their places. */
enum { GAME_RATE = 60, GAME_WIDTH = CANVAS_WIDTH, GAME_HEIGHT = CANVAS_HEIGHT };

#define GAME_DT (1.0f / (float)GAME_RATE)

enum GameEventType { GAME_DOWN, GAME_MOVE, GAME_UP, GAME_KEY_PRESSED, GAME_KEY_RELEASED, GAME_EVENT_COUNT };

/* The mouse is pointer 0, fingers are 1 and up. The first finger on the glass is the left button, others the right. */
enum GameButton { GAME_LEFT = 1, GAME_RIGHT = 2 };

/* Keys: small letters and digits as in ASCII, and these. R restarts, N goes to the next level: the shell does that. P
   (pause), S (slow motion), M (mute) and Escape never come to a game, nor into a script. */
enum GameKey { GAME_KEY_SPACE = ' ', GAME_KEY_LEFT = 256, GAME_KEY_RIGHT, GAME_KEY_UP, GAME_KEY_DOWN };

/* Takes effect before the tick of this number, which counts from the start of the program. */
typedef struct GameEvent {
    int32_t tick;
    int32_t type;    /* GAME_DOWN and so on */
    int32_t pointer; /* of the first three types */
    int32_t button;  /* of GAME_DOWN and GAME_UP */
    int32_t x, y;    /* of the first three types */
    int32_t key;     /* of the last two */
} GameEvent;

/* What the shell gives to a game. */
typedef struct GameHost {
    kiriWorldDef worldDef; /* default, with memory that is counted */
    Sounds* sounds;        /* may be silent, but is not null */
} GameHost;

enum GameState { GAME_PLAYING, GAME_WON, GAME_LOST };

typedef struct GameStatus {
    int32_t state; /* GAME_PLAYING and so on */
    int32_t score;
    uint64_t hash; /* of all that coming ticks depend on */
} GameStatus;

typedef struct GameType {
    const char* name;
    const char* about; /* one line */
    const char* keys;  /* one line: its own keys and buttons, without the keys of the shell */
    int32_t levels;    /* numbered from 1 */

    void* (*start)(int32_t level, const GameHost* host); /* null: it says on stderr what failed */
    void (*stop)(void* game);

    void (*event)(void* game, const GameEvent* event);

    /* A step of GAME_DT. False: it says on stderr what failed. */
    bool (*tick)(void* game);

    /* alpha: 0 draws what was before the last tick, 1 what is after it. Changes nothing that ticks depend on. */
    void (*draw)(void* game, Canvas* canvas, float alpha);

    void (*getStatus)(void* game, GameStatus* status);

    /* May be null. The game plays itself: writes up to `capacity` events for the next tick, and returns how many. */
    int32_t (*demo)(void* game, GameEvent* events, int32_t capacity);
} GameType;

#endif
