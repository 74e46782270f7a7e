/* Pictures of what the library works with. Frames, links and points are those of its debug draw. Shape functions,
   regions and cells are asked for through the public header, on a raster over the rest plane: it shows what a host can
   know, as exactly as the raster is fine. */
#ifndef DEBUG_H
#define DEBUG_H

#include "lines.h"
#include "scene.h"

enum { RASTER_SIZE = 768, DEBUG_MAX_FRAMES = 1024 };

typedef struct DebugOptions {
    int32_t weightsOf; /* a frame's number; DEBUG_ALL_FRAMES; or DEBUG_NO_FRAME */
    bool regions, links, cells, points, axes, contacts;
} DebugOptions;

enum { DEBUG_NO_FRAME = -2, DEBUG_ALL_FRAMES = -1 };

/* Squares of the rest plane, rows from low v to high v. */
typedef struct Raster {
    float origin[2], side; /* m: its corner, and the side of a square */
    int32_t* triangles;    /* that hold the middles; -1 outside of the sheet */
    int32_t* owners;       /* number of the frame with the largest weight there, or -1 */
    uint8_t* colors;       /* red, green, blue */
    uint32_t revision;     /* of the mesh that it shows */
} Raster;

typedef struct Debug {
    Raster raster;
    kiriFrame frames[DEBUG_MAX_FRAMES];
    int32_t frameCount;
    Lines lines;
} Debug;

/* False without memory. */
bool Debug_Create(Debug* debug);
void Debug_Destroy(Debug* debug);

/* Whether the options want a raster. */
bool Debug_IsWanted(const DebugOptions* options);

/* Lines and points of the scene as it is now. False without memory. */
bool Debug_DrawLines(Debug* debug, const Scene* scene, const DebugOptions* options);

/* The raster of the scene as it is now. False without memory. */
bool Debug_Update(Debug* debug, const Scene* scene, const kiriMesh* mesh, const DebugOptions* options);

#endif
