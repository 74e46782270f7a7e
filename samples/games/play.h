/* A game as it is played: it gets events and ticks, and its memory is counted. Knows no window and draws nothing. */
#ifndef PLAY_H
#define PLAY_H

#include "game.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Play {
    const GameType* type;
    void* game;
    int32_t level;
    int32_t tick;        /* ticks done since the program began, restarts or not */
    int64_t bytes, peak; /* that worlds hold, and the most that they held */
    int64_t allocations; /* how often worlds asked for memory */
    GameHost host;
    Sounds sounds;
    const char* callsPath; /* where the recording of the level's world goes; null: there is none */
    FILE* calls;
} Play;

/* Level 1 to type->levels. A play stays where it is: the game points into it. */
bool Play_Start(Play* play, const GameType* type, int32_t level);

/* With a recording (kiriWorld_Replay) of all calls since the level was last started, in a file of this name; null:
   none. */
bool Play_StartRecorded(Play* play, const GameType* type, int32_t level, const char* callsPath);

/* False: the recording is not whole. */
bool Play_Stop(Play* play);

/* Restarts and changes of level are events, too. */
bool Play_Send(Play* play, const GameEvent* event);
bool Play_Tick(Play* play);

#ifdef __cplusplus
}
#endif

#endif
