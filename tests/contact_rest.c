/* Sheets that come to rest on obstacles: how far vertices move a tick, when all sleep, how deep they are. */
#include "defaults.h"
#include "contact.h"
#include "kiri/kiri.h"
#include "world/kiri_world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CELLS = 64, MOST_OBSTACLES = 8 };

typedef struct Scene {
    const char* name;
    float size;    /* m: side of the cloth */
    float height;  /* m: where it starts */
    int32_t edgeOn;
    int32_t obstacleCount;
    struct {
        int32_t type;
        float size[3], radius, height, at[3];
        int32_t lies; /* 1: its axis along x */
    } obstacles[MOST_OBSTACLES];
    float seconds; /* within which all must sleep */
} Scene;

static const Scene scenes[] = {
    { "tablecloth", 1.2f, 0.75f, 0, 1, { { KIRI_OBSTACLE_CYLINDER, { 0 }, 0.4f, 0.7f, { 0, 0, 0.35f }, 0 } }, 5.0f },
    { "cloth on a ball", 1.0f, 0.9f, 0, 1, { { KIRI_OBSTACLE_SPHERE, { 0 }, 0.25f, 0, { 0, 0, 0.6f }, 0 } }, 8.0f },
    { "cloth on a box", 1.0f, 0.85f, 0, 1, { { KIRI_OBSTACLE_BOX, { 0.5f, 0.5f, 0.5f }, 0, 0, { 0, 0, 0.55f }, 0 } }, 8.0f },
    { "flat on a floor", 1.0f, 0.1f, 0, 1, { { KIRI_OBSTACLE_PLANE, { 0 }, 0, 0, { 0 }, 0 } }, 5.0f },
    { "blanket on a bed", 1.4f, 0.75f, 0, 4,
      { { KIRI_OBSTACLE_BOX, { 0.9f, 0.9f, 0.4f }, 0, 0, { 0, 0, 0.2f }, 0 },
        { KIRI_OBSTACLE_BOX, { 0.5f, 0.3f, 0.15f }, 0, 0, { 0, 0.3f, 0.475f }, 0 },
        { KIRI_OBSTACLE_CAPSULE, { 0 }, 0.1f, 0.5f, { -0.1f, -0.1f, 0.5f }, 1 },
        { KIRI_OBSTACLE_PLANE, { 0 }, 0, 0, { 0 }, 0 } }, 8.0f },
    { "towel over a bar", 1.0f, 0.75f, 0, 1, { { KIRI_OBSTACLE_CAPSULE, { 0 }, 0.03f, 1.4f, { 0, 0.05f, 0.7f }, 1 } }, 8.0f },
    { "falls on its edge", 1.0f, 1.05f, 1, 1, { { KIRI_OBSTACLE_PLANE, { 0 }, 0, 0, { 0 }, 0 } }, 8.0f },
};

typedef struct Setup {
    int32_t grid, cells, frames, substeps, skinning;
    float dt;
} Setup;

typedef struct Rest {
    double way, deep, worst, asleep, milliseconds; /* mm rms, mm, mm, s, ms */
} Rest;

static kiriWorld* MakeScene(const Scene* scene, const Setup* setup, kiriSheet* sheet)
{
    static float positions[2 * (MOST_CELLS + 1) * (MOST_CELLS + 1)];
    static int32_t indices[6 * MOST_CELLS * MOST_CELLS];
    kiriWorld* world = NULL;
    kiriWorldDef worldDef = DefaultWorld();
    kiriCreateWorld(&worldDef, &world);
    for (int32_t i = 0; i < scene->obstacleCount; ++i) {
        kiriObstacle id;
        kiriObstacleDef obstacle = DefaultObstacle();
        obstacle.type = scene->obstacles[i].type;
        memcpy(obstacle.size, scene->obstacles[i].size, sizeof(obstacle.size));
        obstacle.radius = scene->obstacles[i].radius;
        obstacle.height = scene->obstacles[i].height;
        memcpy(obstacle.position, scene->obstacles[i].at, sizeof(obstacle.position));
        if (scene->obstacles[i].lies) {
            const float turned[9] = { 0, 0, -1, 0, 1, 0, 1, 0, 0 };
            memcpy(obstacle.rotation, turned, sizeof(turned));
        }
        kiriCreateObstacle(world, &obstacle, &id);
    }
    kiriSheetDef def = DefaultSheet();
    kiriFillRectangle(scene->size, scene->size, setup->cells, setup->cells, positions, indices);
    def.restPositions = positions;
    def.vertexCount = (setup->cells + 1) * (setup->cells + 1);
    def.indices = indices;
    def.triangleCount = 2 * setup->cells * setup->cells;
    def.position[0] = -0.49f * scene->size;
    def.position[1] = scene->edgeOn ? 0.0f : -0.51f * scene->size;
    def.position[2] = scene->edgeOn ? scene->height - scene->size : scene->height;
    if (scene->edgeOn) {
        const float up[3] = { 0.0f, 0.02f, 0.9998f };
        memcpy(def.axisV, up, sizeof(up));
        def.axisV[2] = sqrtf(1.0f - 0.0004f);
    }
    def.gridResolution = setup->grid;
    def.frameCount = def.maxFrames = setup->frames;
    def.skinning = setup->skinning;
    kiriCreateSheet(world, &def, sheet);
    return world;
}

/* The way of vertices in a tick is taken over the last second; depth when it ends, and the worst. */
static Rest Watch(const Scene* scene, const Setup* setup, double seconds)
{
    static float before[3 * (MOST_CELLS + 1) * (MOST_CELLS + 1)];
    kiriSheet sheet = 0;
    SCOPED_WORLD(world) = MakeScene(scene, setup, &sheet);
    Rest rest = { 0.0, -HUGE_VAL, -HUGE_VAL, seconds, 0.0 };
    int32_t ticks = (int32_t)(seconds / setup->dt), done = 0;
    double spent = 0.0;
    for (int32_t t = 0; t < ticks; ++t) {
        kiriMesh mesh;
        int32_t awake = 1;
        double start = Contact_Milliseconds();
        kiriWorld_Tick(world, setup->dt, setup->substeps);
        spent += 1e-3 * (Contact_Milliseconds() - start);
        done += 1;
        kiriSheet_GetMesh(world, sheet, &mesh);
        rest.deep = 1e3 * Contact_Depth(world, sheet);
        rest.worst = rest.deep > rest.worst ? rest.deep : rest.worst;
        if ((t + 1) * setup->dt > seconds - 1.0f) {
            double sum = 0.0;
            for (int32_t v = 0; v < mesh.vertexCount; ++v) {
                double squared = 0.0;
                for (int i = 0; i < 3; ++i) {
                    double way = 1e3 * (mesh.positions[3 * v + i] - before[3 * v + i]);
                    squared += way * way;
                }
                sum += squared;
            }
            double rms = sqrt(sum / mesh.vertexCount);
            rest.way = rms > rest.way ? rms : rest.way;
        }
        memcpy(before, mesh.positions, sizeof(float) * 3 * (size_t)mesh.vertexCount);
        kiriSheet_IsAwake(world, sheet, &awake);
        if (!awake) {
            rest.asleep = (t + 1) * (double)setup->dt;
            rest.way = 0.0;
            break;
        }
    }
    rest.milliseconds = 1e3 * spent / done;
    return rest;
}

static void Measure(const Scene* scene, const Setup* setup)
{
    char variant[64];
    Rest rest = Watch(scene, setup, 12.0);
    snprintf(variant, sizeof(variant), "grid %d mesh %d, %d fr, %d sub%s", (int)setup->grid, (int)setup->cells,
             (int)setup->frames, (int)setup->substeps, setup->skinning ? ", smooth" : "");
    Contact_Limit(scene->name, variant, rest.asleep, scene->seconds, "s asleep");
    Contact_Limit(scene->name, variant, rest.way, 0.1, "mm way");
    Contact_Limit(scene->name, variant, rest.deep, 1.0, "mm deep");
    Contact_Limit(scene->name, variant, rest.worst, 3.0, "mm worst");
    Contact_Limit(scene->name, variant, rest.milliseconds, 4.0, "ms");
}

void Contact_MeasureRest(void)
{
    const Setup usual = { 32, 32, 25, 2, KIRI_SKINNING_LINEAR, 1.0f / 60.0f };
    for (int32_t i = 0; i < 6; ++i) {
        static const int32_t cells[3] = { 32, 40, 64 };
        Setup setup = usual;
        setup.grid = 32 + 32 * (i % 2);
        setup.cells = cells[i / 2];
        Measure(&scenes[0], &setup);
    }
    for (size_t i = 1; i < sizeof(scenes) / sizeof(scenes[0]); ++i) {
        Setup setup = usual;
        Measure(&scenes[i], &setup);
        setup.skinning = KIRI_SKINNING_SMOOTH;
        Measure(&scenes[i], &setup);
        setup.substeps = 8;
        Measure(&scenes[i], &setup);
        setup = usual;
        setup.frames = 100;
        setup.cells = 64;
        Measure(&scenes[i], &setup);
    }
}
