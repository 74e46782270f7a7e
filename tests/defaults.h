/* Defs with their defaults, for tests and benchmarks. */
#ifndef KIRI_TEST_DEFAULTS_H
#define KIRI_TEST_DEFAULTS_H

#include "kiri/kiri.h"

static inline kiriSheetDef DefaultSheet(void)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    return def;
}

static inline kiriObstacleDef DefaultObstacle(void)
{
    kiriObstacleDef def;
    kiriDefaultObstacleDef(&def);
    return def;
}

#endif
