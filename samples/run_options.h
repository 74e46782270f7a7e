/* What the words after kiri-run say. */
#ifndef RUN_OPTIONS_H
#define RUN_OPTIONS_H

#include "debug.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Options {
    const char* scene;
    const char* output;
    const char* data;
    const char* film;
    const char* drawing;
    const char* model;
    const char *record, *replay; /* files of a recording, or null */
    DebugOptions debug;
    int32_t ticks, every, width, height, grid, controlFrames, budget;
    int32_t solid;    /* mm; 0: the surface alone */
    float closeUp[3]; /* rest point, m, and factor; factor 0: as the scene has it */
    bool plain, asPaper, smooth, quiet, help;
} Options;

void Options_PrintHelp(void);

/* False: it says on stderr what it does not understand. */
bool Options_Read(int count, char** words, Options* options);

#endif
