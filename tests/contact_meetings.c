/* Sheets that meet sheets: two free ones, cloths on a ball, heaps of patches. */
#include "defaults.h"
#include "contact.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_SHEETS = 200 };

static const float dt = 1.0f / 60.0f;

typedef struct Play {
    kiriWorld* world;
    kiriSheet sheets[MOST_SHEETS];
    int count;
    double worstTick, meanTick; /* ms, of this thread */
    double asleep;              /* s; infinite: never */
} Play;

static void Start(Play* play, float gravity, int32_t obstacle, float radius, float z)
{
    kiriObstacle id;
    memset(play, 0, sizeof(*play));
    kiriWorldDef def = DefaultWorld();
    def.gravity[2] = -gravity;
    kiriCreateWorld(&def, &play->world);
    kiriObstacleDef below = ObstacleOf(obstacle);
    below.radius = radius;
    below.position[2] = z;
    kiriCreateObstacle(play->world, &below, &id);
}

/* Adds a square whose middle is at `at`, turned by an angle. The other settings are set in the def. */
static void Add(Play* play, kiriSheetDef* def, int32_t material, double size, int32_t cells, const double at[3], double turn)
{
    double c = cos(turn), s = sin(turn), half = 0.5 * size;
    kiriMaterial given = def->material;
    kiriGetMaterial(material, &def->material);
    def->material.density *= given.density;
    def->material.airDamping *= given.airDamping;
    def->touchesSheets = 1;
    def->axisU[0] = def->axisV[1] = (float)c;
    def->axisU[1] = (float)s;
    def->axisV[0] = (float)-s;
    Set3(def->position, (float)(at[0] - half * (c - s)), (float)(at[1] - half * (c + s)), (float)at[2]);
    kiriCreateRectangle(play->world, (float)size, (float)size, cells, cells, def, &play->sheets[play->count++]);
}

static kiriSheetDef DefOf(int32_t frames, int32_t grid, double thickness)
{
    kiriSheetDef def = DefaultSheet();
    def.frameCount = frames;
    def.gridResolution = grid;
    def.contactThickness = (float)thickness;
    def.material.density = def.material.airDamping = 1.0f; /* factors, see Add */
    return def;
}

/* Ticks until all sleep. */
static void Run(Play* play, int ticks)
{
    int done = 0;
    play->asleep = HUGE_VAL;
    for (; done < ticks && play->asleep == HUGE_VAL; ++done) {
        int32_t any = 0;
        double start = Contact_Milliseconds();
        kiriWorld_Tick(play->world, dt, 2);
        double spent = Contact_Milliseconds() - start;
        play->worstTick = fmax(spent, play->worstTick);
        play->meanTick += spent;
        for (int i = 0; i < play->count; ++i) {
            int32_t awake = 0;
            kiriSheet_IsAwake(play->world, play->sheets[i], &awake);
            any |= awake;
        }
        play->asleep = any ? HUGE_VAL : (done + 1) * (double)dt;
    }
    play->meanTick /= done;
}

/* Two free sheets: one meets the other at 1 m/s. */
static void MeasureMeeting(int32_t model, float density, double aside)
{
    Play play;
    char variant[64];
    double mass[2], speed[2] = { 0.0 }, first = 0.0, firstEnergy = 0.0, gained = 0.0, off = 0.0;
    Start(&play, 0.0f, KIRI_OBSTACLE_PLANE, 0.0f, -100.0f);
    for (int i = 0; i < 2; ++i) {
        kiriSheetDef def = DefOf(4, 16, 0.004);
        def.model = model;
        def.velocity[2] = i == 1 ? -1.0f : 0.0f;
        def.material.density = i == 1 ? density : 1.0f;
        def.material.airDamping = 0.0f;
        Add(&play, &def, KIRI_MATERIAL_PAPER, 0.2, 16, (double[]){ i * aside, 0.0, i * 0.02 }, 0.0);
    }
    for (int tick = 0; tick <= 60; ++tick) {
        double momentum = 0.0, energy = 0.0;
        for (int i = 0; i < 2; ++i) {
            kiriTotals totals;
            kiriSheet_GetTotals(play.world, play.sheets[i], &totals);
            energy += totals.kineticEnergy + totals.elasticEnergy;
            momentum += totals.momentum[2];
            mass[i] = totals.mass;
            speed[i] = totals.momentum[2] / mass[i];
        }
        first = tick == 0 ? momentum : first;
        firstEnergy = tick == 0 ? energy : firstEnergy;
        off = fmax(off, fabs(momentum / first - 1.0));
        gained = fmax(gained, energy / firstEnergy - 1.0);
        kiriWorld_Tick(play.world, dt, 2);
    }
    snprintf(variant, sizeof variant, "model %d, mass %g, aside %g", (int)model, (double)density, aside);
    Contact_Limit("meet: momentum", variant, off, 1e-6, "");
    Contact_Limit("meet: energy gained", variant, gained, 1e-3, "");
    if (aside == 0.0) { /* else they turn, and their centres may pass each other */
        Contact_Limit("meet: restitution", variant, speed[1] - speed[0], 1.0, "");
        Contact_Limit("meet: goes through", variant, speed[0] - speed[1], 0.01, "m/s");
    }
    kiriDestroyWorld(play.world);
}

static void MeasureBall(int count)
{
    Play play;
    char variant[64];
    double lowest = HUGE_VAL;
    Start(&play, 9.81f, KIRI_OBSTACLE_SPHERE, 0.25f, 0.6f);
    for (int i = 0; i < count; ++i) {
        kiriSheetDef def = DefOf(25, 32, 0.004);
        Add(&play, &def, KIRI_MATERIAL_COTTON, 0.8, 32, (double[]){ 0.0, 0.0, 0.88 + 0.02 * i }, 0.0);
    }
    Run(&play, 720);
    for (int i = 0; i < count; ++i) {
        kiriTotals totals;
        kiriSheet_GetTotals(play.world, play.sheets[i], &totals);
        lowest = fmin(lowest, totals.center[2]);
    }
    snprintf(variant, sizeof variant, "%d cottons, 25 frames", count);
    Contact_Limit("ball: asleep after", variant, play.asleep, 8.0, "s");
    Contact_Limit("ball: fell off", variant, lowest < 0.4, 0.0, "");
    Contact_Limit("ball: a tick", variant, play.meanTick, 10.0, "ms");
    kiriDestroyWorld(play.world);
}

static void MeasureHeap(int count, int32_t material, const char* name)
{
    Play play;
    char variant[64];
    Start(&play, 9.81f, KIRI_OBSTACLE_PLANE, 0.0f, 0.0f);
    for (int i = 0; i < count; ++i) {
        kiriSheetDef def = DefOf(9, 16, 0.002);
        const double at[3] = { 0.02 * cos(5.0 * i), 0.02 * sin(5.0 * i), 0.02 + 0.012 * i };
        Add(&play, &def, material, 0.12, 12, at, 2.4 * i);
    }
    Run(&play, 600);
    snprintf(variant, sizeof variant, "%d of %s", count, name);
    Contact_Limit("heap: asleep after", variant, play.asleep, 5.0, "s");
    Contact_Limit("heap: a tick", variant, play.meanTick, 4.0, "ms");
    Contact_Limit("heap: worst tick", variant, play.worstTick, 20.0, "ms");
    kiriDestroyWorld(play.world);
}

void Contact_MeasureMeetings(void)
{
    static const float densities[] = { 1.0f, 1e-3f, 1e3f };
    for (int i = 0; i < 3; ++i) {
        MeasureMeeting(KIRI_MODEL_LINKS, densities[i], 0.0);
        MeasureMeeting(KIRI_MODEL_LINKS, densities[i], 0.1);
        MeasureMeeting(KIRI_MODEL_AFFINE, densities[i], 0.0);
    }
    for (int count = 1; count <= 3; ++count) {
        MeasureBall(count);
    }
    MeasureHeap(20, KIRI_MATERIAL_COTTON, "cotton");
    MeasureHeap(20, KIRI_MATERIAL_PAPER, "paper");
}
