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

static void WriteCalls(void* user, const void* bytes, int32_t count)
{
    fwrite(bytes, 1, (size_t)count, ((Play*)user)->calls);
}

static bool CloseCalls(Play* play)
{
    bool fine = play->calls == NULL || !ferror(play->calls);
    fine = (play->calls == NULL || fclose(play->calls) == 0) && fine;
    play->calls = NULL;
    return fine;
}

/* Unbuffered: whole after a crash, too. */
static bool OpenCalls(Play* play)
{
    play->calls = fopen(play->callsPath, "wb");
    if (play->calls == NULL) {
        fprintf(stderr, "cannot write %s\n", play->callsPath);
        return false;
    }
    setvbuf(play->calls, NULL, _IONBF, 0);
    play->host.worldDef.record = WriteCalls;
    return true;
}

static bool StartLevel(Play* play, int32_t level)
{
    bool fine = Play_Stop(play) && (play->callsPath == NULL || OpenCalls(play));
    if (!fine) {
        return false;
    }
    play->level = level;
    play->game = play->type->start(level, &play->host);
    return play->game != NULL;
}

bool Play_StartRecorded(Play* play, const GameType* type, int32_t level, const char* callsPath)
{
    memset(play, 0, sizeof *play);
    play->type = type;
    play->callsPath = callsPath;
    Sounds_Init(&play->sounds);
    kiriDefaultWorldDef(&play->host.worldDef);
    play->host.worldDef.alloc = Allocate;
    play->host.worldDef.free = Free;
    play->host.worldDef.user = play;
    play->host.sounds = &play->sounds;
    return StartLevel(play, level);
}

bool Play_Start(Play* play, const GameType* type, int32_t level)
{
    return Play_StartRecorded(play, type, level, NULL);
}

bool Play_Stop(Play* play)
{
    if (play->game != NULL) {
        play->type->stop(play->game);
        play->game = NULL;
    }
    return CloseCalls(play);
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
