/* The scene that each binding runs too: 120 ticks with pins, a cut, a blade, an obstacle, and a piece that gets a sheet
   of its own. All end with the state hash that this prints. After that it prints the sizes of the structs as C lays
   them out. */
#include "defaults.h"
#include "kiri/kiri.h"

#include <inttypes.h>
#include <stdio.h>

#define PRINT_SIZE(type) printf(#type " %d\n", (int)sizeof(type))

enum { TICKS = 120 };

static kiriSheet MakeSheet(kiriWorld* world)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.position[2] = 1.0f;
    def.material.youngsModulus = 1e7f;
    def.frameCount = 6;
    kiriSheet sheet = 0;
    kiriCreateRectangle(world, 1.0f, 0.75f, 16, 12, &def, &sheet);
    return sheet;
}

static void Pin(kiriWorld* world, kiriSheet sheet, float u, float v)
{
    kiriPinDef def = DefaultPin();
    def.restPoint[0] = def.target[0] = u;
    def.restPoint[1] = def.target[1] = v;
    def.target[2] = 1.0f;
    kiriPin pin;
    kiriCreatePin(world, sheet, &def, &pin);
}

static void AddBall(kiriWorld* world)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_SPHERE);
    def.radius = 0.25f;
    Set3(def.position, 0.5f, 0.5f, 0.5f);
    kiriObstacle ball;
    kiriCreateObstacle(world, &def, &ball);
}

static void Cut(kiriWorld* world, kiriSheet sheet)
{
    const float way[8] = { 0.3f, -0.1f, 0.3f, 0.4f, 0.7f, 0.45f, 0.65f, 0.85f };
    kiriCut cut;
    kiriSheet_Cut(world, sheet, way, 4, &cut);
}

/* Through what hangs at the pin in the origin, from tick 40 on. */
static void MoveBlade(kiriWorld* world, kiriBlade blade, int tick)
{
    float x = 0.0625f * (float)(tick - 44);
    const float from[3] = { x, 0.125f, -1.0f }, to[3] = { x, 0.125f, 2.0f };
    kiriBlade_MoveEdge(world, blade, from, to);
}

/* Each piece that came off in the last tick gets a sheet of its own. */
static void DetachPieces(kiriWorld* world)
{
    const kiriEvent* events;
    int32_t count;
    kiriWorld_GetEvents(world, &events, &count);
    for (int32_t i = 0; i < count; ++i) {
        if (events[i].type == KIRI_EVENT_PIECE_OFF) {
            kiriSheet detached;
            kiriFrame_DetachPiece(world, events[i].frame, &detached);
        }
    }
}

static uint64_t Run(kiriWorld* world)
{
    kiriSheet sheet = MakeSheet(world);
    Pin(world, sheet, 0.0f, 0.0f);
    Pin(world, sheet, 1.0f, 0.0f);
    AddBall(world);
    Cut(world, sheet);
    kiriBlade blade;
    kiriBeginBlade(world, 0, &blade);
    for (int tick = 0; tick < TICKS; ++tick) {
        if (tick >= 40 && tick < 60) {
            MoveBlade(world, blade, tick);
        } else if (tick == 60) {
            kiriBlade_End(world, blade);
        }
        kiriWorld_Tick(world, 1.0f / 60.0f, 2);
        DetachPieces(world);
    }
    uint64_t hash = 0;
    kiriWorld_GetStateHash(world, &hash);
    return hash;
}

int main(void)
{
    kiriWorldDef def = DefaultWorld();
    def.gravity[0] = 1.0f;
    kiriWorld* world;
    if (kiriCreateWorld(&def, &world) != KIRI_OK) {
        return 1;
    }
    printf("hash %016" PRIx64 "\n", Run(world));
    int32_t sheets;
    kiriWorld_GetSheets(world, NULL, 0, &sheets);
    printf("sheets %d\n", (int)sheets);
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
