#include "draw.h"
#include "canvas_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OVERSAMPLING = 3, CLOTH_SIZE = 64 };

static const Color sky = { 0.985f, 0.985f, 0.98f, 1.0f }, haze = { 0.92f, 0.925f, 0.93f, 1.0f };
static const Color ground = { 0.82f, 0.82f, 0.84f, 1.0f };
static const Color ink = { 0.13f, 0.16f, 0.24f, 1.0f }, thread = { 0.35f, 0.35f, 0.38f, 1.0f };
static const Color steel = { 0.72f, 0.75f, 0.79f, 1.0f }, handle = { 0.22f, 0.23f, 0.27f, 1.0f };

/* Columns: across a knife, along its edge, and from its tip to its handle. */
static const float knifeAxes[9] = { 0.788f, 0.544f, -0.289f, 0.0f, 0.469f, 0.883f, 0.616f, -0.696f, 0.370f };

struct Painter {
    Canvas* canvas;
    EdgeLines edges[2];
    uint8_t cloth[3 * CLOTH_SIZE * CLOTH_SIZE], print[3 * PRINT_SIZE * PRINT_SIZE];
    bool isPrinted;
    uint32_t rasters; /* painted */
};

/* Checks of two stripes, and a fine weave, so that stretch and slope are seen. */
static void MakeCloth(uint8_t* pixels)
{
    for (int i = 0; i < CLOTH_SIZE * CLOTH_SIZE; i++) {
        int x = i % CLOTH_SIZE, y = i / CLOTH_SIZE;
        int stripes = (x < CLOTH_SIZE / 2) + (y < CLOTH_SIZE / 2);
        memset(pixels + 3 * i, 255 - 34 * stripes - (((x ^ y) & 2) != 0 ? 8 : 0), 3);
    }
}

Painter* Painter_Create(int32_t width, int32_t height)
{
    Painter* painter = calloc(1, sizeof(Painter));
    if (painter == NULL) {
        return NULL;
    }
    painter->canvas = Canvas_Create(width, height, OVERSAMPLING, NULL);
    if (painter->canvas == NULL) {
        Painter_Destroy(painter);
        return NULL;
    }
    MakeCloth(painter->cloth);
    return painter;
}

void Painter_Destroy(Painter* painter)
{
    if (painter->canvas != NULL) {
        Canvas_Destroy(painter->canvas);
    }
    EdgeLines_Free(&painter->edges[0]);
    EdgeLines_Free(&painter->edges[1]);
    free(painter);
}

/* ---- Scene --------------------------------------------------------------------------------------------------------- */

static Color MakeColor(const float rgb[3])
{
    return (Color){ rgb[0], rgb[1], rgb[2], 1.0f };
}

/* Without a thickness edges are drawn as lines. The texture stays until the picture is done. */
static bool AddSheet(Painter* painter, const View* view, bool isSecond, float size, CanvasTexture* texture)
{
    const kiriMesh* mesh = isSecond ? &view->second : &view->mesh;
    const Look* look = isSecond ? &view->secondLook : &view->look;
    EdgeLines* edges = &painter->edges[isSecond];
    CanvasSheet sheet = { .positions = mesh->positions,
                          .normals = mesh->normals,
                          .restPositions = mesh->restPositions,
                          .indices = mesh->indices,
                          .triangleCount = mesh->triangleCount,
                          .front = MakeColor(look->front),
                          .back = MakeColor(look->back),
                          .lip = MakeColor(look->lip),
                          .rim = ink };
    if (!view->isSolid) {
        if (!EdgeLines_Find(edges, mesh)) {
            return false;
        }
        sheet.edges = *edges;
    }
    if (view->raster != NULL) {
        *texture = (CanvasTexture){ view->raster,      view->rasterSize,
                                    view->rasterSize,  { view->rasterOrigin[0], view->rasterOrigin[1] },
                                    view->rasterWidth, view->rasterWidth,
                                    ++painter->rasters };
        sheet.texture = texture;
        sheet.front = sheet.back = (Color){ 0.85f, 0.85f, 0.85f, 1.0f };
    } else if (look->checks > 0.0f) {
        float side = size / look->checks;
        *texture = (CanvasTexture){ painter->cloth, CLOTH_SIZE, CLOTH_SIZE, { 0.0f, 0.0f }, side, side, 0 };
        if (view->print != NULL) {
            texture->rgb = painter->print;
            texture->columns = texture->rows = PRINT_SIZE;
        }
        sheet.texture = texture;
    }
    if (view->print != NULL && !painter->isPrinted) {
        view->print(painter->print);
        painter->isPrinted = true;
    }
    Canvas_AddSheet(painter->canvas, &sheet);
    return true;
}

static CanvasBody MakeBody(int32_t shape, const float position[3], const float rotation[9], Color color)
{
    CanvasBody body = { .shape = shape, .color = color, .shadowless = true };
    memcpy(body.position, position, sizeof body.position);
    memcpy(body.rotation, rotation, sizeof body.rotation);
    return body;
}

/* A round peg from the wall behind the sheet to before it. */
static void AddPeg(Canvas* canvas, const float pin[3], float size)
{
    static const float alongY[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, -1.0f, 0.0f, 1.0f, 0.0f };
    const float middle[3] = { pin[0], pin[1] - 0.01f * size, pin[2] };
    CanvasBody peg = MakeBody(CANVAS_CYLINDER, middle, alongY, handle);
    peg.radius = 0.014f * size;
    peg.height = 0.05f * size;
    Canvas_AddBody(canvas, &peg);
}

/* A thread from the ceiling, if the pin is not on the floor, and a knot. */
static void AddThread(Canvas* canvas, const float pin[3], float size, float knotRadius)
{
    static const float upright[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    const float above[3] = { pin[0], pin[1], pin[2] + 4.0f * size };
    if (pin[2] > 0.02f * size) {
        Canvas_AddLine(canvas, pin, above, 1.2f, thread);
    }
    CanvasBody knot = MakeBody(CANVAS_SPHERE, pin, upright, thread);
    knot.radius = knotRadius;
    Canvas_AddBody(canvas, &knot);
}

/* A craft knife with its tip here. */
static void AddKnife(Canvas* canvas, const float tip[3], float size, float outline[8])
{
    static const float shape[8] = { 0.0f, 0.0f, 0.008f, 0.012f, 0.008f, 0.07f, -0.008f, 0.07f };
    float middle[3];
    for (int i = 0; i < 8; i++) {
        outline[i] = size * shape[i];
    }
    for (int i = 0; i < 3; i++) {
        middle[i] = tip[i] + 0.145f * size * knifeAxes[6 + i];
    }
    float bladeAxes[9];
    for (int i = 0; i < 9; i++) {
        bladeAxes[i] = knifeAxes[(i + 3) % 9];
    }
    CanvasBody blade = MakeBody(CANVAS_PRISM, tip, bladeAxes, steel);
    blade.outline = outline;
    blade.outlineCount = 4;
    blade.height = 0.002f * size;
    CanvasBody grip = MakeBody(CANVAS_CAPSULE, middle, knifeAxes, handle);
    grip.radius = 0.0105f * size;
    grip.height = 0.14f * size;
    Canvas_AddBody(canvas, &blade);
    Canvas_AddBody(canvas, &grip);
}

bool Painter_Paint(Painter* painter, const View* view, Image* image)
{
    Canvas* canvas = painter->canvas;
    float size = view->size > 0.0f ? view->size : 1.0f, outlines[VIEW_MOST_BLADES][8];
    CanvasCamera camera = { .fieldOfView = view->camera.fieldOfView };
    CanvasTexture textures[2];
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = size * view->camera.eye[i];
        camera.target[i] = size * view->camera.target[i];
    }
    float right[3], up[3], back[3], away = CanvasCamera_GetAxes(&camera, right, up, back);
    float knotRadius = 0.008f * CanvasCamera_GetHalfHeight(&camera, away); /* as large in all pictures */
    Canvas_Begin(canvas, &camera, sky, haze);
    Canvas_SetFloor(canvas, -0.002f * size, ground);
    if (!AddSheet(painter, view, false, size, &textures[0]) ||
        (view->second.triangleCount > 0 && !AddSheet(painter, view, true, size, &textures[1]))) {
        return false;
    }
    for (int32_t i = 0; i < view->bodyCount; i++) {
        Canvas_AddBody(canvas, &view->bodies[i]);
    }
    for (int32_t i = 0; i < view->pinCount; i++) {
        if (view->pegs) {
            AddPeg(canvas, view->pins + 3 * i, size);
        } else {
            AddThread(canvas, view->pins + 3 * i, size, knotRadius);
        }
    }
    for (int32_t i = 0; i < view->bladeCount && i < VIEW_MOST_BLADES; i++) {
        AddKnife(canvas, view->blades + 3 * i, size, outlines[i]);
    }
    Canvas_SetMarks(canvas, &view->lines, view->hidesLines);
    return Canvas_Finish(canvas, image);
}
