/* What contacts with obstacles cost: a cloth on a floor, in the air above it, and asleep; many obstacles near and far;
   as ratios to the same cloth in a world without. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { TICKS = 60, SQUARES = 64 };

typedef struct Case {
    const char* name;
    int32_t frames, obstacles; /* obstacles: boxes in a square grid below the cloth, or 0: a floor */
    float height, apart;       /* m: of the cloth above them; from obstacle to obstacle */
    bool sleeps, isBare;       /* bare: without any */
} Case;

static const Case cases[] = {
    { "none, falling", 25, 0, 1000.0f, 0.0f, false, true },
    { "floor, far below", 25, 0, 1000.0f, 0.0f, false, false },
    { "floor, sliding on it", 25, 0, 0.0005f, 0.0f, false, false },
    { "100 boxes below, far", 25, 100, 1000.0f, 0.1f, false, false },
    { "1000 boxes, 3 near", 25, 1000, 0.0005f, 0.5f, false, false },
    { "100 boxes touched", 25, 100, 0.0005f, 0.1f, false, false },
    { "none, 100 frames", 100, 0, 1000.0f, 0.0f, false, true },
    { "floor, 100 frames", 100, 0, 0.0005f, 0.0f, false, false },
    { "floor, asleep", 25, 0, 0.0005f, 0.0f, true, false },
};

static bool AddBoxes(kiriWorld* world, const Case* c)
{
    bool fine = true;
    int32_t side = 1;
    while (side * side < c->obstacles) {
        side++;
    }
    for (int32_t i = 0; fine && i < c->obstacles; i++) {
        kiriObstacle obstacle;
        kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_BOX);
        def.size[0] = def.size[1] = 0.06f;
        def.size[2] = 0.1f;
        Set3(def.position, 0.05f + c->apart * (float)(i % side), 0.05f + c->apart * (float)(i / side), -0.05f);
        fine = kiriCreateObstacle(world, &def, &obstacle) == KIRI_OK;
    }
    return fine;
}

static bool AddObstacles(kiriWorld* world, const Case* c)
{
    kiriObstacle obstacle;
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_PLANE);
    return c->isBare || (c->obstacles > 0 ? AddBoxes(world, c) : kiriCreateObstacle(world, &def, &obstacle) == KIRI_OK);
}

typedef struct Cost {
    double tick, find; /* ms, medians */
    double contacts;   /* mean */
} Cost;

static bool Measure(kiriWorld* world, const Case* c, Cost* cost)
{
    Series ticks = { NULL, 0, 0 }, finds = ticks, contacts = ticks;
    bool fine = true;
    for (int32_t i = 0; fine && c->sleeps && i < 100; i++) {
        fine = kiriWorld_Tick(world, 1.0f / 60.0f, 2) == KIRI_OK;
    }
    for (int32_t i = 0; fine && i < TICKS; i++) {
        kiriProfile profile;
        double start = Bench_Clock(NULL);
        fine = kiriWorld_Tick(world, 1.0f / 60.0f, 2) == KIRI_OK && kiriWorld_GetProfile(world, &profile) == KIRI_OK;
        Series_Add(&ticks, 1e3 * (Bench_Clock(NULL) - start));
        Series_Add(&finds, 1e3 * profile.seconds[KIRI_STAGE_CONTACT]);
        Series_Add(&contacts, profile.contacts);
    }
    *cost = (Cost){ Series_Median(&ticks), Series_Median(&finds), Series_Mean(&contacts) };
    Series_Free(&ticks);
    Series_Free(&finds);
    Series_Free(&contacts);
    return fine;
}

static bool RunCase(const Case* c, Cost* cost)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    SCOPED_WORLD(world) = NULL;
    kiriSheet sheet;
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 32;
    def.frameCount = def.maxFrames = c->frames;
    def.position[2] = c->height;
    def.velocity[0] = c->sleeps ? 0.0f : 2.0f;
    bool fine = kiriCreateWorld(&worldDef, &world) == KIRI_OK;
    fine = fine && AddObstacles(world, c) && Bench_AddSheet(world, &def, SQUARES, &sheet) && Measure(world, c, cost);
    return fine;
}

int main(void)
{
    static const char* const columns[] = { "cloth",   "frames",  "contacts",     "tick ms",
                                           "find ms", "to none", "us a contact", NULL };
    Table table;
    double bare = 1.0;
    bool fine =
        Table_Start(&table, "contact", "Contacts with obstacles: a cloth of 8192 triangles, 2 substeps", columns);
    Bench_WeighClock();
    for (size_t i = 0; fine && i < sizeof cases / sizeof cases[0]; i++) {
        Cost cost = { 0.0, 0.0, 0.0 };
        fine = RunCase(&cases[i], &cost);
        bare = cases[i].isBare ? cost.tick : bare;
        Table_Text(&table, cases[i].name);
        TABLE_NUMBERS(&table, cases[i].frames, cost.contacts, cost.tick, cost.find, cost.tick / bare,
                      cost.contacts > 0.0 ? 1e3 * (cost.tick - bare) / cost.contacts : (double)NAN);
    }
    return Bench_End(Table_Stop(&table) && fine, "bench_contact: something failed");
}
