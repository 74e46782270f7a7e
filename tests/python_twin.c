/* What tests/test_python.py does, in C: it prints the state hash, and the sizes of the structs as C lays them out. */
#include "kiri/kiri.h"

#include <inttypes.h>
#include <stdio.h>

#define PRINT_SIZE(type) printf(#type " %d\n", (int)sizeof(type))

enum { COLUMNS = 16, ROWS = 12, TICKS = 30 };

static kiriSheet MakeSheet(kiriWorld* world)
{
    static float positions[2 * (COLUMNS + 1) * (ROWS + 1)];
    static int32_t indices[6 * COLUMNS * ROWS];
    kiriFillRectangle(1.0f, 0.75f, COLUMNS, ROWS, positions, indices);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.restPositions = positions;
    def.vertexCount = (COLUMNS + 1) * (ROWS + 1);
    def.indices = indices;
    def.triangleCount = 2 * COLUMNS * ROWS;
    def.position[2] = 1.0f;
    def.material.youngsModulus = 1e7f;
    def.frameCount = 6;
    kiriSheet sheet = 0;
    kiriCreateSheet(world, &def, &sheet);
    return sheet;
}

static void Pin(kiriWorld* world, kiriSheet sheet, float u, float v)
{
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = def.target[0] = u;
    def.restPoint[1] = def.target[1] = v;
    def.target[2] = 1.0f;
    kiriPin pin;
    kiriCreatePin(world, sheet, &def, &pin);
}

int main(void)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.gravity[0] = 1.0f;
    kiriWorld* world;
    if (kiriCreateWorld(&def, &world) != KIRI_OK) {
        return 1;
    }
    kiriSheet sheet = MakeSheet(world);
    Pin(world, sheet, 0.0f, 0.0f);
    Pin(world, sheet, 1.0f, 0.0f);
    const float start[2] = { 0.3f, -0.1f }, way[6] = { 0.3f, 0.4f, 0.7f, 0.45f, 0.65f, 0.85f };
    kiriCut cut;
    kiriBeginCut(world, sheet, start, &cut);
    kiriCut_Extend(world, cut, way, 3);
    kiriCut_End(world, cut);
    for (int tick = 0; tick < TICKS; tick++) {
        kiriWorld_Tick(world, 1.0f / 60.0f, 2);
    }
    uint64_t hash;
    kiriWorld_GetStateHash(world, &hash);
    printf("hash %016" PRIx64 "\n", hash);
    kiriDestroyWorld(world);

    PRINT_SIZE(kiriWorldDef);
    PRINT_SIZE(kiriEvent);
    PRINT_SIZE(kiriProfile);
    PRINT_SIZE(kiriMaterial);
    PRINT_SIZE(kiriPaperOptions);
    PRINT_SIZE(kiriSheetDef);
    PRINT_SIZE(kiriMesh);
    PRINT_SIZE(kiriCounts);
    PRINT_SIZE(kiriPieceState);
    PRINT_SIZE(kiriPieceMesh);
    PRINT_SIZE(kiriTotals);
    PRINT_SIZE(kiriHit);
    PRINT_SIZE(kiriFrameState);
    PRINT_SIZE(kiriPinDef);
    PRINT_SIZE(kiriPinState);
    PRINT_SIZE(kiriContact);
    PRINT_SIZE(kiriContactForce);
    PRINT_SIZE(kiriSheetSettings);
    PRINT_SIZE(kiriPointState);
    PRINT_SIZE(kiriWind);
    PRINT_SIZE(kiriSolid);
    PRINT_SIZE(kiriObstacleDef);
    PRINT_SIZE(kiriObstacleState);
    PRINT_SIZE(kiriReplay);
    return 0;
}
