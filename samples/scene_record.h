/* Recordings (kiriWorld_Replay) and saves in files. Notes in them name the shapes that a picture shows beside the
   sheet, so a replay looks like the run. */
#ifndef SCENE_RECORD_H
#define SCENE_RECORD_H

#include "scene.h"

#include <stdio.h>

/* Worlds of this def write their recording to the file, whole up to the call at hand whatever happens. False: it says
   on stderr that it cannot. */
bool SceneRecord_Open(FILE** file, const char* path, kiriWorldDef* def);

/* False: it says on stderr that not all could be written. Null is allowed. */
bool SceneRecord_Close(FILE* file, const char* path);

/* Notes which scene this is, and what the next picture shows where that has changed. */
void Scene_NoteStart(const Scene* scene);
void Scene_NoteTick(Scene* scene);

typedef struct SceneReplay {
    uint8_t* bytes;
    int64_t byteCount;
    kiriReplay at;
    int32_t ticks;            /* that it has; of a save SCENE_SAVE_TICKS */
    bool isRight;             /* everything went as recorded */
    bool isSave;              /* bytes of kiriWorld_Save: the world goes on from there */
    float size, distance;     /* m: of the box that the camera shows, and to it; size 0: the scene has a camera */
    float* targets;           /* m: where it looks, 3 floats a tick */
} SceneReplay;

enum { SCENE_SAVE_TICKS = 600 };

/* Replays the file once, and says on stderr where something is other than recorded; then makes a scene that starts from
   it. The type: the colours of a recording without a scene. Its camera shows held pieces, and moving ones near them. */
bool SceneReplay_Start(SceneReplay* replay, const char* path, Scene* scene, const SceneType* type,
                       const kiriWorldDef* def);

/* Up to the next tick, in place of Scene_Tick. */
kiriResult SceneReplay_Tick(SceneReplay* replay, Scene* scene);
void SceneReplay_Free(SceneReplay* replay);

#endif
