/* What scenes are made of: sheets, pins, blades and a floor. Lengths are in sizes of the scene, unless said
   otherwise. */
#ifndef SCENE_PARTS_H
#define SCENE_PARTS_H

#include "outline.h"
#include "scene.h"

static const float floorGap = 0.004f; /* a sheet lies so high above the floor z = 0 */

/* `corner` is where the rest point (0, 0) starts; axis u is x. */
kiriSheetDef Scene_PlaceSheet(const Scene* scene, const float corner[3], const float axisV[3], kiriMaterial material);

typedef struct Rectangle {
    float width, height;
    int32_t columns, rows;
    const float* frames; /* 2 a frame; null: they spread evenly */
} Rectangle;

/* Makes the sheet of the def, whose mesh is in metres, but for what the options say otherwise. frames: 2 numbers a
   frame, in sizes; null: they spread evenly. */
bool Scene_MakeSheet(Scene* scene, kiriSheetDef* def, const SceneOptions* options, const float* frames);

/* Fills the def's mesh with a rectangle and makes the sheet. */
bool Scene_MakeRectangle(Scene* scene, kiriSheetDef* def, const SceneOptions* options, const Rectangle* rectangle);

/* Pins the rest point (u, v) to a place. */
bool Scene_PinAt(Scene* scene, float u, float v, float x, float y, float z);

/* Pins it where it is when the sheet starts. */
bool Scene_PinHere(Scene* scene, const kiriSheetDef* def, float u, float v);

/* Moves a pin along the axis x, y or z: 0, 1 or 2. */
void Scene_MovePin(Scene* scene, int32_t pin, int axis, float to);

/* A thread for the eye alone, where a frame is held. */
void Scene_ShowThread(Scene* scene, const kiriSheetDef* def, float u, float v);

/* A new blade, whose way is to be drawn. */
Outline* Scene_AddStroke(Scene* scene);

/* A blade goes along a straight line. */
bool Scene_AddLine(Scene* scene, float u, float v, float toU, float toV);

typedef struct Figure {
    const char* name; /* of its outline */
    float size, u, v;
} Figure;

/* A blade goes around the figure. */
bool Scene_AddFigure(Scene* scene, const SceneOptions* options, const Figure* figure);

/* Writes the frames, up to `capacity`, whose rest points the way of a blade encloses; returns how many. */
int32_t Scene_GetEnclosedFrames(const Scene* scene, const Stroke* stroke, kiriFrame* frames, int32_t capacity);

/* The floor z = 0, for all sheets. */
bool Scene_AddFloor(Scene* scene);

/* A capsule between two points, or a ball at one. groups: of kiriObstacleDef. */
bool Scene_AddCapsule(Scene* scene, const float from[3], const float to[3], float radius, uint32_t groups);

/* 0 to 1 from one tick to another, without a jerk. */
float Scene_Ease(int32_t tick, int32_t first, int32_t last);

/* As many ticks at another pace. */
int32_t Scene_Slow(int32_t ticks, float pace);

#endif
