#define _POSIX_C_SOURCE 199309L
/* Sheets that meet sheets: two free ones, cloths on a ball, heaps of patches. */
#include "contact.h"
#include "kiri/kiri.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_SHEETS = 200, MOST_SIDE = 64 };

static const float dt = 1.0f / 60.0f;

typedef struct Play {
    kiriWorld* world;
    kiriSheet sheets[MOST_SHEETS];
    int count;
    double worstTick, meanTick; /* ms, of this thread */
    double asleep;              /* s; infinite: never */
    double energy, mostEnergy;  /* J */
} Play;

typedef struct Cloth {
    double width, height, position[3];
    int32_t columns, rows, frames, grid, material, model;
    double thickness, velocity, turn, density, damping;
} Cloth;

static double Milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void Start(Play* play, double gravity)
{
    kiriWorldDef def;
    memset(play, 0, sizeof(*play));
    kiriDefaultWorldDef(&def);
    def.gravity[2] = (float)-gravity;
    kiriCreateWorld(&def, &play->world);
}

static void AddObstacle(Play* play, int32_t type, double radius, double z)
{
    kiriObstacleDef def;
    kiriObstacle id;
    kiriDefaultObstacleDef(&def);
    def.type = type;
    def.radius = (float)radius;
    def.position[2] = (float)z;
    kiriCreateObstacle(play->world, &def, &id);
}

static kiriSheet Add(Play* play, const Cloth* cloth)
{
    static float positions[2 * (MOST_SIDE + 1) * (MOST_SIDE + 1)];
    static int32_t indices[6 * MOST_SIDE * MOST_SIDE];
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    kiriGetMaterial(cloth->material, &def.material);
    def.material.density *= (float)(cloth->density > 0.0 ? cloth->density : 1.0);
    def.material.airDamping = (float)(cloth->damping < 0.0 ? 0.0 : def.material.airDamping);
    kiriFillRectangle((float)cloth->width, (float)cloth->height, cloth->columns, cloth->rows, positions, indices);
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = (cloth->columns + 1) * (cloth->rows + 1);
    def.triangleCount = 2 * cloth->columns * cloth->rows;
    def.frameCount = cloth->frames;
    def.gridResolution = cloth->grid > 0 ? cloth->grid : 32;
    def.touchesSheets = 1;
    def.model = cloth->model;
    def.contactThickness = (float)cloth->thickness;
    double c = cos(cloth->turn), s = sin(cloth->turn);
    for (int a = 0; a < 3; ++a) {
        def.position[a] = (float)cloth->position[a];
    }
    def.axisU[0] = (float)c;
    def.axisU[1] = (float)s;
    def.axisV[0] = (float)-s;
    def.axisV[1] = (float)c;
    def.velocity[2] = (float)cloth->velocity;
    kiriSheet* sheet = &play->sheets[play->count++];
    kiriResult result = kiriCreateSheet(play->world, &def, sheet);
    if (result < KIRI_OK) {
        printf("%s\n", kiriWorld_GetLastError(play->world));
        exit(1);
    }
    return *sheet;
}

static double EnergyOf(const Play* play, double momentum[3])
{
    double energy = 0.0;
    momentum[0] = momentum[1] = momentum[2] = 0.0;
    for (int i = 0; i < play->count; ++i) {
        kiriTotals totals;
        kiriSheet_GetTotals(play->world, play->sheets[i], &totals);
        energy += totals.kineticEnergy + totals.elasticEnergy;
        for (int a = 0; a < 3; ++a) {
            momentum[a] += totals.momentum[a];
        }
    }
    return energy;
}

static int CountAwake(const Play* play)
{
    int count = 0;
    for (int i = 0; i < play->count; ++i) {
        int32_t awake = 0;
        kiriSheet_IsAwake(play->world, play->sheets[i], &awake);
        count += awake;
    }
    return count;
}

static void Tick(Play* play, int32_t substeps)
{
    double start = Milliseconds();
    kiriWorld_Tick(play->world, dt, substeps);
    double spent = Milliseconds() - start;
    play->worstTick = spent > play->worstTick ? spent : play->worstTick;
    play->meanTick += spent;
}

/* Ticks until all sleep. */
static void Run(Play* play, int ticks, int32_t substeps)
{
    int done = 0;
    play->asleep = HUGE_VAL;
    play->meanTick = play->worstTick = 0.0;
    for (; done < ticks && play->asleep == HUGE_VAL; ++done) {
        Tick(play, substeps);
        if (CountAwake(play) == 0) {
            play->asleep = (done + 1) * (double)dt;
        }
    }
    play->meanTick /= done > 0 ? done : 1;
}

/* ---- Two free sheets meet ---- */

static void MeasureMeeting(int32_t model, double density, double aside)
{
    Play play;
    char variant[64];
    double first[3], now[3], most = 0.0, off = 0.0;
    Start(&play, 0.0);
    for (int i = 0; i < 2; ++i) {
        Cloth cloth = { .width = 0.2, .height = 0.2, .columns = 16, .rows = 16, .frames = 4, .grid = 16,
                        .material = KIRI_MATERIAL_PAPER, .model = model, .thickness = 0.004, .damping = -1.0 };
        cloth.position[0] = i * aside;
        cloth.position[2] = i * 0.02;
        cloth.velocity = i == 1 ? -1.0 : 0.0;
        cloth.density = i == 1 ? density : 1.0;
        Add(&play, &cloth);
    }
    double energy = EnergyOf(&play, first);
    for (int tick = 0; tick < 60; ++tick) {
        kiriWorld_Tick(play.world, dt, 2);
        most = fmax(most, EnergyOf(&play, now) / energy - 1.0);
        off = fmax(off, fabs(now[2] - first[2]) / fabs(first[2]));
    }
    kiriTotals a, b;
    kiriSheet_GetTotals(play.world, play.sheets[0], &a);
    kiriSheet_GetTotals(play.world, play.sheets[1], &b);
    double apart = a.momentum[2] / a.mass - b.momentum[2] / b.mass;
    snprintf(variant, sizeof variant, "model %d, mass %g, aside %g", (int)model, density, aside);
    Contact_Limit("meet: momentum", variant, off, 1e-6, "");
    Contact_Limit("meet: energy gained", variant, most, 1e-3, "");
    if (aside == 0.0) { /* else they turn, and their centres may pass each other */
        Contact_Limit("meet: restitution", variant, -apart, 1.0, "");
        Contact_Limit("meet: goes through", variant, apart, 0.01, "m/s");
    }
    kiriDestroyWorld(play.world);
}

/* ---- Cloths on a ball ---- */

static void MeasureBall(int count, int32_t frames)
{
    Play play;
    char variant[64];
    Start(&play, 9.81);
    AddObstacle(&play, KIRI_OBSTACLE_SPHERE, 0.25, 0.6);
    for (int i = 0; i < count; ++i) {
        Cloth cloth = { .width = 0.8, .height = 0.8, .columns = 32, .rows = 32, .frames = frames,
                        .material = KIRI_MATERIAL_COTTON, .thickness = 0.004, .position = { -0.4, -0.4, 0.88 + 0.02 * i } };
        Add(&play, &cloth);
    }
    Run(&play, 720, 2);
    snprintf(variant, sizeof variant, "%d cottons, %d frames", count, (int)frames);
    Contact_Limit("ball: asleep after", variant, play.asleep, 8.0, "s");
    double lowest = HUGE_VAL;
    for (int i = 0; i < count; ++i) {
        kiriTotals totals;
        kiriSheet_GetTotals(play.world, play.sheets[i], &totals);
        lowest = fmin(lowest, totals.center[2]);
    }
    Contact_Limit("ball: fell off", variant, lowest < 0.4, 0.0, "");
    Contact_Limit("ball: a tick", variant, play.meanTick, 10.0, "ms");
    kiriDestroyWorld(play.world);
}

/* ---- Heaps ---- */

static void MeasureHeap(int count, int32_t material, const char* name)
{
    Play play;
    char variant[64];
    Start(&play, 9.81);
    AddObstacle(&play, KIRI_OBSTACLE_PLANE, 0.0, 0.0);
    for (int i = 0; i < count; ++i) {
        double turn = 2.4 * i;
        Cloth cloth = { .width = 0.12, .height = 0.12, .columns = 12, .rows = 12, .frames = 9, .grid = 16, .material = material,
                        .thickness = 0.002, .turn = turn };
        cloth.position[0] = 0.02 * cos(5.0 * i) - 0.06 * (cos(turn) - sin(turn));
        cloth.position[1] = 0.02 * sin(5.0 * i) - 0.06 * (cos(turn) + sin(turn));
        cloth.position[2] = 0.02 + 0.012 * i;
        Add(&play, &cloth);
    }
    Run(&play, 600, 2);
    snprintf(variant, sizeof variant, "%d of %s", count, name);
    Contact_Limit("heap: asleep after", variant, play.asleep, 5.0, "s");
    Contact_Limit("heap: a tick", variant, play.meanTick, count > 50 ? 8.0 : 4.0, "ms");
    Contact_Limit("heap: worst tick", variant, play.worstTick, 20.0, "ms");
    kiriDestroyWorld(play.world);
}

void Contact_MeasureMeetings(void)
{
    static const double densities[] = { 1.0, 1e-3, 1e3 };
    for (int i = 0; i < 3; ++i) {
        MeasureMeeting(KIRI_MODEL_LINKS, densities[i], 0.0);
        MeasureMeeting(KIRI_MODEL_LINKS, densities[i], 0.1);
        MeasureMeeting(KIRI_MODEL_AFFINE, densities[i], 0.0);
    }
    for (int count = 1; count <= 3; ++count) {
        MeasureBall(count, 25);
    }
    MeasureHeap(20, KIRI_MATERIAL_COTTON, "cotton");
    MeasureHeap(20, KIRI_MATERIAL_PAPER, "paper");
    MeasureHeap(200, KIRI_MATERIAL_COTTON, "cotton");
}
