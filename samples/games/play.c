#include "play.h"

#include <stdlib.h>
#include <string.h>

/* Before each block, its size; 16 bytes, as blocks are aligned. */
enum { HEAD = 16 };

static void* Allocate(void* user, int64_t bytes)
{
    Play* play = user;
    char* block = malloc((size_t)bytes + HEAD);
    if (block == NULL) {
        return NULL;
    }
    memcpy(block, &bytes, sizeof bytes);
    play->bytes += bytes;
    play->peak = play->bytes > play->peak ? play->bytes : play->peak;
    play->allocations++;
    return block + HEAD;
}

static void Free(void* user, void* pointer)
{
    Play* play = user;
    if (pointer != NULL) {
        int64_t bytes;
        memcpy(&bytes, (char*)pointer - HEAD, sizeof bytes);
        play->bytes -= bytes;
        free((char*)pointer - HEAD);
    }
}

static bool StartLevel(Play* play, int32_t level)
{
    if (play->game != NULL) {
        play->type->stop(play->game);
    }
    play->level = level;
    play->game = play->type->start(level, &play->host);
    return play->game != NULL;
}

bool Play_Start(Play* play, const GameType* type, int32_t level)
{
    memset(play, 0, sizeof *play);
    play->type = type;
    Sounds_Init(&play->sounds);
    kiriDefaultWorldDef(&play->host.worldDef);
    play->host.worldDef.alloc = Allocate;
    play->host.worldDef.free = Free;
    play->host.worldDef.user = play;
    play->host.sounds = &play->sounds;
    return StartLevel(play, level);
}

void Play_Stop(Play* play)
{
    if (play->game != NULL) {
        play->type->stop(play->game);
        play->game = NULL;
    }
}

bool Play_Send(Play* play, const GameEvent* event)
{
    if (event->type == GAME_KEY_PRESSED && event->key == 'r') {
        return StartLevel(play, play->level);
    }
    if (event->type == GAME_KEY_PRESSED && event->key == 'n') {
        return StartLevel(play, play->level % play->type->levels + 1);
    }
    play->type->event(play->game, event);
    return true;
}

bool Play_Tick(Play* play)
{
    play->tick++;
    return play->type->tick(play->game);
}
