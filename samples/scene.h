/* Scenes, shared by the samples, the tests and the benchmarks: a sheet, how it is held, and what is cut when. */
#ifndef SCENE_H
#define SCENE_H

#include "kiri/kiri.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Camera {
    float eye[3], target[3];
    float fieldOfView; /* degrees, from bottom to top */
} Camera;

typedef struct SceneOptions {
    const char* dataFolder; /* null: samples/data */
    int32_t gridResolution; /* 0: the scene's own */
    int32_t frameCount;     /* 0: the scene's own */
} SceneOptions;

/* The way of a blade, point by point from one tick to another. */
typedef struct Stroke {
    const float* points; /* 2 a point */
    int32_t count;
    int32_t firstTick, lastTick;
    int32_t taken; /* points given to the library */
    kiriCut cut;
} Stroke;

typedef struct Scene Scene;

typedef struct SceneType {
    const char* name;
    const char* about;
    int32_t ticks, substeps;
    int32_t moments[8]; /* ticks worth a picture, rising */
    Camera camera;
    bool (*start)(Scene* scene, const SceneOptions* options); /* makes the sheet, its pins, and the strokes */
    void (*push)(Scene* scene);                               /* forces and contacts of a tick; may be null */
} SceneType;

enum { SCENE_MAX_STROKES = 64 };

struct Scene {
    const SceneType* type;
    kiriWorld* world;
    kiriSheet sheet;
    int32_t tick;  /* ticks done */
    float* points; /* of all strokes */
    Stroke strokes[SCENE_MAX_STROKES];
    int32_t strokeCount;
};

/* The scene number `index`, or null when there are no more. */
const SceneType* Scene_GetType(int32_t index);

/* Null when there is none of this name. */
const SceneType* Scene_FindType(const char* name);

/* The def brings clock, log and memory; gravity is the default. Says on stderr what fails. */
bool Scene_Start(Scene* scene, const SceneType* type, const kiriWorldDef* def, const SceneOptions* options);

/* Moves the blades, then the world, by a sixtieth of a second. */
kiriResult Scene_Tick(Scene* scene);

/* Where the blade is now; false when none cuts. */
bool Scene_GetBlade(const Scene* scene, float restPoint[2]);

void Scene_Stop(Scene* scene);

#endif
