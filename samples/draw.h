/* Draws a sheet into a picture with OSMesa: OpenGL in software, with no window and no graphics card. */
#ifndef DRAW_H
#define DRAW_H

#include "image.h"
#include "scene.h"

typedef struct View {
    Camera camera;
    kiriMesh mesh;
    const float* colors; /* 9 a triangle: red, green, blue at its corners; null: cloth */
    const kiriFrameState* axes;
    int32_t axesCount;
    const float* blade; /* where its tip is, 3 floats; null: none */
} View;

typedef struct Painter Painter;

/* Null without memory, or when OSMesa cannot do this size. */
Painter* Painter_Create(int32_t width, int32_t height);
void Painter_Destroy(Painter* painter);

/* False without memory. The image has the painter's size. */
bool Painter_Paint(Painter* painter, const View* view, Image* image);

#endif
