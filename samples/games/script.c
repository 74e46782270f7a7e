#include "script.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char* name;
    int32_t key;
} keys[] = { { "space", GAME_KEY_SPACE },
             { "left", GAME_KEY_LEFT },
             { "right", GAME_KEY_RIGHT },
             { "up", GAME_KEY_UP },
             { "down", GAME_KEY_DOWN } };

enum { KEYS = sizeof keys / sizeof keys[0] };

static const char* const types[GAME_EVENT_COUNT] = { "down", "move", "up", "keydown", "keyup" };

static bool ReadKey(const char* word, int32_t* key)
{
    for (int i = 0; i < KEYS; i++) {
        if (strcmp(word, keys[i].name) == 0) {
            *key = keys[i].key;
            return true;
        }
    }
    *key = word[0];
    return word[0] != 0 && word[1] == 0;
}

/* The words after tick and type. */
static bool ReadRest(const char* text, GameEvent* event)
{
    char word[16] = "";
    switch (event->type) {
    case GAME_MOVE:
        return sscanf(text, "%d %d %d", &event->pointer, &event->x, &event->y) == 3;
    case GAME_DOWN:
    case GAME_UP:
        return sscanf(text, "%d %d %d %d", &event->pointer, &event->button, &event->x, &event->y) == 4;
    default:
        return sscanf(text, "%15s", word) == 1 && ReadKey(word, &event->key);
    }
}

static bool AddEvent(Script* script, const GameEvent* event)
{
    if (script->count == script->capacity) {
        int32_t capacity = 2 * script->capacity + 64;
        GameEvent* events = realloc(script->events, sizeof(GameEvent) * (size_t)capacity);
        if (events == NULL) {
            return false;
        }
        script->events = events;
        script->capacity = capacity;
    }
    script->events[script->count++] = *event;
    script->end = event->tick + 1;
    return true;
}

static bool ReadLine(Script* script, const char* line)
{
    char type[16] = "";
    int start = 0;
    GameEvent event = { .type = -1 };
    if (line[0] == '#' || strspn(line, " \t\r\n") == strlen(line)) {
        return true;
    }
    if (sscanf(line, "game %31s", script->game) == 1 || sscanf(line, "level %d", &script->level) == 1) {
        return true;
    }
    if (sscanf(line, "%d %15s%n", &event.tick, type, &start) != 2 || event.tick < script->end - 1) {
        return false;
    }
    if (strcmp(type, "end") == 0) {
        script->end = event.tick;
        return true;
    }
    for (int i = 0; i < GAME_EVENT_COUNT; i++) {
        event.type = strcmp(type, types[i]) == 0 ? i : event.type;
    }
    return event.type >= 0 && ReadRest(line + start, &event) && AddEvent(script, &event);
}

bool Script_Read(Script* script, const char* path)
{
    memset(script, 0, sizeof *script);
    FILE* file = fopen(path, "r");
    if (file == NULL) {
        fprintf(stderr, "cannot read %s\n", path);
        return false;
    }
    char line[128];
    bool fine = true;
    for (int32_t number = 1; fine && fgets(line, sizeof line, file) != NULL; number++) {
        fine = ReadLine(script, line);
        if (!fine) {
            fprintf(stderr, "%s:%d: not understood: %s", path, number, line);
            Script_Free(script);
        }
    }
    fclose(file);
    return fine;
}

void Script_Free(Script* script)
{
    free(script->events);
    memset(script, 0, sizeof *script);
}

const GameEvent* Script_Take(Script* script, int32_t tick)
{
    if (script->next < script->count && script->events[script->next].tick <= tick) {
        return &script->events[script->next++];
    }
    return NULL;
}

void Script_WriteStart(FILE* file, const char* game, int32_t level)
{
    fprintf(file, "game %s\nlevel %d\n", game, level);
}

void Script_WriteEvent(FILE* file, const GameEvent* event)
{
    fprintf(file, "%d %s ", event->tick, types[event->type]);
    if (event->type == GAME_MOVE) {
        fprintf(file, "%d %d %d\n", event->pointer, event->x, event->y);
        return;
    }
    if (event->type == GAME_DOWN || event->type == GAME_UP) {
        fprintf(file, "%d %d %d %d\n", event->pointer, event->button, event->x, event->y);
        return;
    }
    for (int i = 0; i < KEYS; i++) {
        if (event->key == keys[i].key) {
            fprintf(file, "%s\n", keys[i].name);
            return;
        }
    }
    fprintf(file, "%c\n", event->key);
}

void Script_WriteEnd(FILE* file, int32_t tick)
{
    fprintf(file, "%d end\n", tick);
}
