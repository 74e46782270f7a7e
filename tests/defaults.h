/* Defs with their defaults, for tests and benchmarks. */
#ifndef KIRI_TEST_DEFAULTS_H
#define KIRI_TEST_DEFAULTS_H

#include "kiri/kiri.h"

static inline kiriWorldDef DefaultWorld(void)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    return def;
}

static inline kiriPinDef DefaultPin(void)
{
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    return def;
}

static inline kiriSeamDef DefaultSeam(void)
{
    kiriSeamDef def;
    kiriDefaultSeamDef(&def);
    return def;
}

/* Has few frames and the linear skin, so tests are quick. */
static inline kiriSheetDef DefaultSheet(void)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.frameCount = 5;
    def.skinning = KIRI_SKINNING_LINEAR;
    return def;
}

static inline kiriSheetDef SheetOf(int32_t gridResolution, int32_t frameCount)
{
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = gridResolution;
    def.frameCount = frameCount;
    return def;
}

static inline kiriObstacleDef DefaultObstacle(void)
{
    kiriObstacleDef def;
    kiriDefaultObstacleDef(&def);
    return def;
}

static inline kiriObstacleDef ObstacleOf(int32_t type)
{
    kiriObstacleDef def = DefaultObstacle();
    def.type = type;
    return def;
}

/* J: of motion, strains and height. */
static inline double World_Energy(const kiriWorld* world, kiriSheet sheet)
{
    kiriTotals totals;
    kiriSheet_GetTotals(world, sheet, &totals);
    return totals.kineticEnergy + totals.elasticEnergy + 9.81 * totals.mass * totals.center[2];
}

static inline int World_CountAwake(const kiriWorld* world, const kiriSheet* sheets, int count)
{
    int awake = 0;
    for (int i = 0; i < count; ++i) {
        int32_t one = 0;
        kiriSheet_IsAwake(world, sheets[i], &one);
        awake += one;
    }
    return awake;
}

static inline void Set3(float vector[3], float x, float y, float z)
{
    vector[0] = x;
    vector[1] = y;
    vector[2] = z;
}

#endif
