/* Sheets and pieces against each other: piles, how they lie and what they cost; a hammock; pieces that are cut out; the
   six scenes with and without contact between their pieces. */
#include "defaults.h"
#include "contact.h"
#include "../samples/scene.h"
#include "crossing.h"

#include <math.h>
#include <stdio.h>

static const float dt = 1.0f / 60.0f;

static kiriWorld* StartWorld(void)
{
    kiriObstacle floor;
    kiriWorld* world = NULL;
    kiriWorldDef def = DefaultWorld();
    kiriCreateWorld(&def, &world);
    kiriObstacleDef floorDef = ObstacleOf(KIRI_OBSTACLE_PLANE);
    kiriCreateObstacle(world, &floorDef, &floor);
    return world;
}

/* ---- Piles ---- */

enum { MOST = 64, SIDE = 16 };

typedef struct Pile {
    kiriWorld* world;
    kiriSheet sheets[MOST];
    int count;
} Pile;

/* Squares of 0.2 m, 20 mm one above the other, each turned by a degree against the one below. */
static void StartPile(Pile* pile, int count, int32_t material)
{
    static float positions[2 * (SIDE + 1) * (SIDE + 1)];
    static int32_t indices[6 * SIDE * SIDE];
    pile->world = StartWorld();
    pile->count = count;
    kiriFillRectangle(0.2f, 0.2f, SIDE, SIDE, positions, indices);
    for (int i = 0; i < count; ++i) {
        double turn = 0.0175 * i, c = cos(turn), s = sin(turn);
        kiriSheetDef def = DefaultSheet();
        kiriGetMaterial(material, &def.material);
        def.restPositions = positions;
        def.indices = indices;
        def.vertexCount = (SIDE + 1) * (SIDE + 1);
        def.triangleCount = 2 * SIDE * SIDE;
        def.gridResolution = SIDE;
        def.frameCount = 4;
        def.touchesSheets = 1;
        def.contactThickness = 0.004f;
        def.axisU[0] = def.axisV[1] = (float)c;
        def.axisU[1] = (float)s;
        def.axisV[0] = (float)-s;
        Set3(def.position, (float)(-0.1 * (c - s)), (float)(-0.1 * (s + c)), 0.02f * (float)(i + 1));
        kiriCreateSheet(pile->world, &def, &pile->sheets[i]);
    }
}

static double Height(const Pile* pile, int i)
{
    kiriTotals totals;
    kiriSheet_GetTotals(pile->world, pile->sheets[i], &totals);
    return totals.center[2];
}

/* How many lie below one that was below them. */
static int CountMisplaced(const Pile* pile)
{
    int count = 0;
    for (int i = 1; i < pile->count; ++i) {
        count += Height(pile, i) <= Height(pile, i - 1);
    }
    return count;
}

/* Millimetres that neighbours are nearer, or farther, than what they keep: the most of all. */
static double WorstLayer(const Pile* pile)
{
    double worst = 0.0;
    for (int i = 0; i < pile->count; ++i) {
        double gap = Height(pile, i) - (i > 0 ? Height(pile, i - 1) : 0.0), due = i > 0 ? 0.004 : 0.002;
        worst = fabs(gap - due) > worst ? fabs(gap - due) : worst;
    }
    return 1e3 * worst;
}

static void MeasurePile(int count, int32_t material, const char* name)
{
    char variant[64];
    Pile pile;
    int32_t worst = 0;
    int asleepAt = 0, moreThanAll = 300;
    double awakeSeconds = 0.0, asleepSeconds = 0.0, pairTicks = 0.0;
    StartPile(&pile, count, material);
    for (int tick = 1; tick <= moreThanAll && asleepAt == 0; ++tick) {
        kiriProfile profile;
        double start = Contact_Milliseconds();
        kiriWorld_Tick(pile.world, dt, 2);
        awakeSeconds += 1e-3 * (Contact_Milliseconds() - start);
        kiriWorld_GetProfile(pile.world, &profile);
        pairTicks += profile.sheetPairs;
        if (tick % 10 == 0) {
            int32_t crossing = Crossing_Measure(pile.world, pile.sheets, count).crossing;
            worst = crossing > worst ? crossing : worst;
        }
        asleepAt = World_CountAwake(pile.world, pile.sheets, pile.count) == 0 ? tick : 0;
    }
    snprintf(variant, sizeof variant, "%d squares of %s", count, name);
    Contact_Limit("pile: worst crossing", variant, worst, 0.0, "tri.");
    Contact_Limit("pile: crossing at rest", variant, Crossing_Measure(pile.world, pile.sheets, count).crossing, 0.0,
                  "tri.");
    Contact_Limit("pile: out of order", variant, CountMisplaced(&pile), 0.0, "sheets");
    Contact_Limit("pile: layers off", variant, WorstLayer(&pile), 1.0, "mm");
    Contact_Limit("pile: asleep after", variant, asleepAt > 0 ? asleepAt * (double)dt : HUGE_VAL, 5.0, "s");
    for (int tick = 0; tick < 60; ++tick) {
        double start = Contact_Milliseconds();
        kiriWorld_Tick(pile.world, dt, 2);
        asleepSeconds += (1e-3 * (Contact_Milliseconds() - start)) / 60.0;
    }
    Contact_Limit("pile: a pair awake", variant, pairTicks > 0.0 ? 1e6 * awakeSeconds / pairTicks : 0.0, 1000.0, "us");
    Contact_Limit("pile: a tick asleep", variant, asleepAt > 0 ? 1e6 * asleepSeconds : HUGE_VAL, 100.0, "us");
    kiriDestroyWorld(pile.world);
}

/* ---- Scenes ---- */

/* The area of triangles that cross another piece, cm^2: the most that was seen at every 60th tick. */
static double OverlapOf(const SceneType* type, int touches)
{
    SceneOptions options;
    SCOPED(Scene, scene, Scene_Stop);
    double worst = 0.0;
    kiriWorldDef def = DefaultWorld();
    memset(&options, 0, sizeof options);
    if (!Scene_Start(&scene, type, &def, &options)) {
        return HUGE_VAL;
    }
    kiriSheetSettings settings;
    kiriSheet_GetSettings(scene.world, scene.sheet, &settings);
    settings.touchesSheets = touches;
    kiriSheet_SetSettings(scene.world, scene.sheet, &settings);
    for (int32_t tick = 1; tick <= type->ticks; ++tick) {
        Scene_Tick(&scene);
        if (tick % 60 == 0) {
            double area = Crossing_Measure(scene.world, &scene.sheet, 1).area;
            worst = area > worst ? area : worst;
        }
    }
    return 1e4 * worst;
}

static void MeasureScenes(void)
{
    static const char* const names[] = { "bunny", "patchwork", "spiral", "vortex", "kirigami", "fallingguy" };
    for (int i = 0; i < 6; ++i) {
        const SceneType* type = Scene_FindType(names[i]);
        char variant[64];
        snprintf(variant, sizeof variant, "%s, each for itself", names[i]);
        Contact_Limit("scene: overlap", variant, type != NULL ? OverlapOf(type, 0) : HUGE_VAL, 1e9, "cm^2");
        snprintf(variant, sizeof variant, "%s, pieces touch", names[i]);
        Contact_Limit("scene: overlap", variant, type != NULL ? OverlapOf(type, 1) : HUGE_VAL, 1.0, "cm^2");
    }
}

void Contact_MeasureSheets(void)
{
    static const int counts[] = { 4, 16, 64 };
    for (int i = 0; i < 3; ++i) {
        MeasurePile(counts[i], KIRI_MATERIAL_PAPER, "paper");
    }
    MeasurePile(4, KIRI_MATERIAL_COTTON, "cotton");
    MeasurePile(16, KIRI_MATERIAL_COTTON, "cotton");
    MeasureScenes();
}
