/* Scenes, shared by the samples, the tests and the benchmarks: a sheet, how it is held, and what is cut when. */
#ifndef SCENE_H
#define SCENE_H

#include "kiri/kiri.h"
#include "outline.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Camera {
    float eye[3], target[3]; /* in sizes of the scene */
    float fieldOfView;       /* degrees, from bottom to top */
} Camera;

/* What the sheet looks like. */
typedef struct Look {
    float front[3], back[3], lip[3]; /* red, green, blue of its sides, and of the edges of cuts */
    float checks;                    /* along the sheet's height; 0: plain */
} Look;

typedef struct SceneOptions {
    const char* dataFolder;       /* null: samples/data */
    int32_t gridResolution;       /* 0: the scene's own */
    int32_t frameCount;           /* 0: the scene's own */
    int32_t collisionPoints;      /* of each sheet */
    int32_t fromScratch, popping; /* of kiriPaperOptions */
    bool unfaded;                 /* fadeTime 0 */
    bool asPaper;                 /* mesh, grid and frames of the table 1 of the paper */
    bool smooth;                  /* KIRI_SKINNING_SMOOTH */
    bool plain;                   /* rigid frames that move in space, to compare with: KIRI_MODEL_LINKS, not planar */
    float pace; /* of blades and pins; 0.2: they take five times as many ticks; 0 or 1: the scene's own */
} SceneOptions;

/* The way of a blade, point by point from one tick to another. */
typedef struct Stroke {
    Outline way;
    int32_t firstTick, lastTick;
    int32_t taken; /* points given to the library */
    float tip[2];  /* the last point given, which may lie between two of the way */
    kiriCut cut;
} Stroke;

enum { SCENE_MOMENTS = 6 };

typedef struct Scene Scene;

enum { PRINT_SIZE = 256 };

typedef struct SceneType {
    const char* name;
    const char* about;
    float size; /* m: of the sheet's height, and of the picture */
    int32_t ticks, substeps;
    int32_t parts;                  /* ticks of the world in each of the scene; 0: 1 */
    int32_t firstCut, lastCut;      /* ticks from the first move of a blade to the last */
    bool together;                  /* all blades at once; else one after the other */
    int32_t moments[SCENE_MOMENTS]; /* ticks worth a picture, rising */
    Camera camera;
    Look look, secondLook; /* secondLook: of Scene.second */
    float bodies[3];       /* colour of bodies; black: as wood */
    void (*print)(uint8_t* rgb); /* fills PRINT_SIZE x PRINT_SIZE pixels in place of each check of the sheet; or null */
    bool pegs; /* pins are pegs in a wall behind the sheet; else knots of threads from above */
    bool (*start)(Scene* scene, const SceneOptions* options); /* makes the sheet, its pins, and the strokes */
    void (*push)(Scene* scene);                               /* forces and contacts of a tick; may be null */
} SceneType;

enum { SCENE_MAX_STROKES = 64, SCENE_MAX_PINS = 16, SCENE_MAX_BODIES = 64, SCENE_NOTE_SIZE = 4096 };

struct Scene {
    const SceneType* type; /* with an own pace: `paced` */
    SceneType paced;
    float pace; /* 1: as the type has it */
    kiriWorld* world;
    kiriSheet sheet, second;
    kiriObstacle floor;
    kiriObstacleDef bodies[SCENE_MAX_BODIES];
    kiriObstacle bodyIds[SCENE_MAX_BODIES];
    int32_t bodyCount;
    const kiriFold* folds; /* of the sheet, while it is made; or null */
    int32_t foldCount;
    float ways[64]; /* of folds of a drawing (creases.h) */
    int32_t wayCount;
    int32_t gridResolution;
    int32_t tick; /* ticks done */
    Stroke strokes[SCENE_MAX_STROKES];
    int32_t strokeCount;
    kiriPin pins[SCENE_MAX_PINS];
    float targets[SCENE_MAX_PINS][3]; /* where the pins are held */
    int32_t pinCount;
    bool isRecorded;             /* its world records: notes say what is seen */
    char noted[SCENE_NOTE_SIZE]; /* the last of them */
};

/* The scene number `index`, or null when there are no more. */
const SceneType* Scene_GetType(int32_t index);

/* Null when there is none of this name. */
const SceneType* Scene_FindType(const char* name);

/* The def brings clock, log and memory; gravity is the default. Says on stderr what fails. */
bool Scene_Start(Scene* scene, const SceneType* type, const kiriWorldDef* def, const SceneOptions* options);

/* Moves the blades, then the world, by a sixtieth of a second. */
kiriResult Scene_Tick(Scene* scene);

/* Where the blades are now; returns how many cut. */
int32_t Scene_GetBlades(const Scene* scene, float (*restPoints)[2], int32_t capacity);

void Scene_Stop(Scene* scene);

#endif
