/* A picture of a scene, with the marks that options ask for. */
#ifndef SHOT_H
#define SHOT_H

#include "draw.h"
#include "run_options.h"
#include "sheets.h"

typedef struct Shot {
    Painter* painter;
    Debug debug;
    Sheets sheets;
} Shot;

/* False without memory, or where no OpenGL can do this size. Destroy it in any case. */
bool Shot_Create(Shot* shot, int32_t width, int32_t height);
void Shot_Destroy(Shot* shot);

/* False without memory. The image has the size of the shot. */
bool Shot_Take(Shot* shot, const Scene* scene, const Options* options, Image* image);

#endif
