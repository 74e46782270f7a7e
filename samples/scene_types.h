/* The scenes. Each file of them is about one kind of sheet. */
#ifndef SCENE_TYPES_H
#define SCENE_TYPES_H

#include "scene.h"

extern const SceneType bunnyScene, patchworkScene;                               /* scene_cloth.c */
extern const SceneType spiralScene, kirigamiScene, vortexScene, fallingGuyScene; /* scene_paper.c */
extern const SceneType rubberScene;                                              /* scene_rubber.c */
extern const SceneType flatScene;                                                /* scene_flat.c */
extern const SceneType miuraScene, cardScene, craneScene;                        /* scene_fold.c */
extern const SceneType shirtScene, lanternScene, canScene, patchScene, bagScene; /* scene_sewn.c */
extern const SceneType letterScene, stampsScene, posterScene, weaveScene;       /* scene_tear.c */

#endif
