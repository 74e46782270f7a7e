/* A storm: worlds to which anything happens that the interface has, at random, but the same on every machine. It prints
   hashes of what comes of it; `make portable` compares these between machines and compilers. */
#ifndef KIRI_STORM_H
#define KIRI_STORM_H

#include "kiri/kiri.h"

#include <stdbool.h>
#include <stdint.h>

enum { STORM_SHEETS = 10, STORM_OBSTACLES = 8, STORM_SQUARES = 12 };

/* What its sheets are, and what else there is. */
typedef struct StormType {
    const char* name;
    int32_t model, skinning, timeStepping;
    bool planar, fromScratch;
    bool touches;   /* sheets touch each other */
    bool obstacles; /* there are obstacles, and contacts of the host */
    bool tasks;     /* ticks are shared out */
    bool folds;     /* sheets have folds */
    bool seams;     /* sheets are sewn to each other, and to themselves */
    int32_t sheets; /* at the start */
    kiriBudget budget;
} StormType;

typedef struct Storm {
    const StormType* type;
    kiriWorld* world;
    uint32_t seed;
    uint64_t results; /* a hash of what calls returned, and what they told */
    kiriSheet sheets[STORM_SHEETS];
    kiriObstacle obstacles[STORM_OBSTACLES];
    int32_t sheetCount, obstacleCount;
    kiriSeam seam;   /* the last one, or 0 */
    kiriBlade blade; /* or 0 */
    float edge[2][3];
    kiriCut cut; /* that goes on from tick to tick, or 0 */
    float tip[2];
} Storm;

/* ---- Storms ---- */

enum { STORM_TYPES = 12 };
extern const StormType Storm_Types[STORM_TYPES];

/* With a world of the def, which gets the type's budget and tasks. */
kiriResult Storm_Start(Storm* storm, int32_t kind, kiriWorldDef* def);

/* Something happens, and time goes on. */
void Storm_Tick(Storm* storm);

/* ---- Random numbers ---- */

uint32_t Storm_Random(Storm* storm, uint32_t below);
float Storm_Between(Storm* storm, float low, float high);
void Storm_Vector(Storm* storm, float size, float vector[3]);

/* A rotation about a random axis: of the world, or of the sheets where they are planar. */
void Storm_Rotation(Storm* storm, float rotation[9]);

/* ---- What there is, at random ---- */

kiriSheet Storm_AnySheet(Storm* storm);
kiriFrame Storm_AnyFrame(Storm* storm);

/* Sheets are squares of one metre; a little beside them, too. */
void Storm_AnyRestPoint(Storm* storm, float point[2]);

/* In the box around a sheet. */
void Storm_AnyPlace(Storm* storm, float place[3]);

/* ---- Acts ---- */

/* Adds to `results`, and returns the same. */
kiriResult Storm_Note(Storm* storm, kiriResult result);

/* Adds it to the storm's, or destroys it where these are many. */
void Storm_KeepSheet(Storm* storm, kiriSheet sheet);

void Storm_Cut(Storm* storm);
void Storm_CutDisc(Storm* storm);
void Storm_GoOnCutting(Storm* storm);
void Storm_Slice(Storm* storm);
void Storm_MoveBlade(Storm* storm);
void Storm_TakePiece(Storm* storm);

/* Sheets that came of pieces while a cut waited. */
void Storm_TakeDetached(Storm* storm);

void Storm_AddSheet(Storm* storm);
void Storm_AddObstacle(Storm* storm);

/* Something happens. */
void Storm_Act(Storm* storm);

/* ---- What is seen ---- */

/* Of all that the host can see: arrays, events, forces, totals. */
uint64_t Storm_HashSeen(Storm* storm);

#endif
