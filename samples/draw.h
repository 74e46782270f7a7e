/* Draws a scene with a sheet into a picture (canvas.h). */
#ifndef DRAW_H
#define DRAW_H

#include "canvas.h"
#include "scene.h"

enum { VIEW_MOST_BLADES = 4 };

typedef struct View {
    Camera camera;
    float size; /* m: one of the camera's lengths; 0: 1 */
    kiriMesh mesh;
    bool isSolid; /* it has rims: no lines along its edges */
    Look look;
    void (*print)(uint8_t* rgb); /* of the scene's type */
    kiriMesh second; /* another sheet with its own look; no triangles: none */
    Look secondLook;
    const CanvasBody* bodies;
    int32_t bodyCount;
    const float* pins; /* 3 a pin: the sheet hangs from threads here */
    int32_t pinCount;
    bool pegs;             /* or it is on pegs in a wall */
    const uint8_t* raster; /* rasterSize x rasterSize colours over the rest plane instead of the look; or null */
    int32_t rasterSize;
    float rasterOrigin[2], rasterWidth; /* m */
    Lines lines;                        /* over all else, */
    bool hidesLines;                    /* or hidden by what is before them */
    const float* blades;                /* 3 a blade: where its tip is */
    int32_t bladeCount;
} View;

typedef struct Painter Painter;

/* Null without memory, or where no OpenGL can do this size. */
Painter* Painter_Create(int32_t width, int32_t height);
void Painter_Destroy(Painter* painter);

/* False without memory. The image has the painter's size. */
bool Painter_Paint(Painter* painter, const View* view, Image* image);

#endif
