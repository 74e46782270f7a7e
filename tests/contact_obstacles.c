/* Cloths that fall on obstacles: how deep they are in them, and when they rest. */
#include "defaults.h"
#include "contact.h"
#include "kiri/kiri.h"
#include "world/kiri_world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SQUARES = 32, CELLS = 64, FRAMES = 25, SUBSTEPS = 2 };

static const float tickSeconds = 1.0f / 60.0f, clothSize = 1.0f;

/* ---- Obstacles --------------------------------------------------------------------------------------------------- */

typedef struct Setting {
    const char* name;
    int32_t type;
    float size[3], radius, height;
    float axis[3]; /* where the third column points; */
    float turn[3]; /* and, roughly, the first */
    float z;       /* of its position */
    float start;   /* the height that the cloth falls from */
} Setting;

static const Setting settings[] = {
    { "plane", KIRI_OBSTACLE_PLANE, { 0 }, 0, 0, { 0, 0, 1 }, { 1, 0, 0 }, 0.0f, 0.3f },
    { "slope of 15 degrees", KIRI_OBSTACLE_PLANE, { 0 }, 0, 0, { 0.2588f, 0, 0.9659f }, { 1, 0, 0 }, 0.0f, 0.3f },
    { "sphere", KIRI_OBSTACLE_SPHERE, { 0 }, 0.25f, 0, { 0, 0, 1 }, { 1, 0, 0 }, 0.6f, 0.9f },
    { "capsule", KIRI_OBSTACLE_CAPSULE, { 0 }, 0.15f, 0.4f, { 1, 0, 0 }, { 0, 0, 1 }, 0.6f, 0.8f },
    { "box", KIRI_OBSTACLE_BOX, { 0.4f, 0.4f, 0.4f }, 0, 0, { 0, 0, 1 }, { 1, 0, 0 }, 0.6f, 0.9f },
    { "box, corner up", KIRI_OBSTACLE_BOX, { 0.4f, 0.4f, 0.4f }, 0, 0, { 1, 1, 1 }, { 1, -1, 0 }, 0.6f, 1.05f },
    { "cylinder", KIRI_OBSTACLE_CYLINDER, { 0 }, 0.2f, 0.3f, { 0, 0, 1 }, { 1, 0, 0 }, 0.6f, 0.85f },
    { "prism, edge up", KIRI_OBSTACLE_PRISM, { 0 }, 0, 0.6f, { 0, 1, 0 }, { 0.5f, 0, 0.866f }, 0.6f, 0.95f },
};

static const float hexagon[12] = { 0.25f,  0.0f, 0.125f,  0.216506f,  -0.125f, 0.216506f,
                                   -0.25f, 0.0f, -0.125f, -0.216506f, 0.125f,  -0.216506f };

static void Normalize(float v[3])
{
    float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) {
        v[i] /= length;
    }
}

static void Cross(const float a[3], const float b[3], float c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static kiriObstacleDef DefOf(const Setting* setting)
{
    kiriObstacleDef def = DefaultObstacle();
    def.type = setting->type;
    memcpy(def.size, setting->size, sizeof(def.size));
    def.radius = setting->radius;
    def.height = setting->height;
    def.outline = hexagon;
    def.outlineCount = 6;
    def.position[2] = setting->z;
    float *u = &def.rotation[0], *v = &def.rotation[3], *d = &def.rotation[6];
    if (setting->type == KIRI_OBSTACLE_BOX && setting->axis[0] != 0.0f) { /* the diagonal points up, turned a little */
        const float rows[9] = { 0.7071068f,  -0.7071068f, 0,          0.4082483f, 0.4082483f,
                                -0.8164966f, 0.5773503f,  0.5773503f, 0.5773503f };
        for (int i = 0; i < 9; ++i) {
            def.rotation[3 * (i % 3) + i / 3] = rows[i];
        }
        return def;
    }
    memcpy(d, setting->axis, sizeof(setting->axis));
    Normalize(d);
    Cross(d, setting->turn, v);
    Normalize(v);
    Cross(v, d, u);
    return def;
}

/* ---- Cloth ------------------------------------------------------------------------------------------------------- */

typedef struct Drape {
    kiriWorld* world;
    kiriSheet sheet;
    kiriObstacle obstacle;
    double square; /* m */
} Drape;

static kiriSheet MakeCloth(kiriWorld* world, float height, int32_t skinning, int32_t model)
{
    static float positions[2 * (CELLS + 1) * (CELLS + 1)];
    static int32_t indices[6 * CELLS * CELLS];
    kiriSheet sheet = 0;
    kiriSheetDef def = DefaultSheet();
    kiriFillRectangle(clothSize, clothSize, CELLS, CELLS, positions, indices);
    def.restPositions = positions;
    def.vertexCount = (CELLS + 1) * (CELLS + 1);
    def.indices = indices;
    def.triangleCount = 2 * CELLS * CELLS;
    def.position[0] = -0.48f * clothSize; /* a little off the middle */
    def.position[1] = -0.51f * clothSize;
    def.position[2] = height;
    def.gridResolution = SQUARES;
    def.frameCount = def.maxFrames = FRAMES;
    def.material.airDamping = 3.0f; /* else it swings for a quarter of a minute */
    def.skinning = skinning;
    def.model = model;
    kiriCreateSheet(world, &def, &sheet);
    return sheet;
}

static Drape StartDrape(const Setting* setting, int32_t skinning)
{
    Drape drape = { NULL, 0, 0, clothSize / SQUARES };
    kiriWorldDef worldDef = DefaultWorld();
    kiriCreateWorld(&worldDef, &drape.world);
    kiriObstacleDef def = DefOf(setting);
    kiriCreateObstacle(drape.world, &def, &drape.obstacle);
    drape.sheet = MakeCloth(drape.world, setting->start, skinning, KIRI_MODEL_LINKS);
    return drape;
}

double Contact_Depth(const kiriWorld* world, kiriSheet sheet)
{
    kiriVec3 none = { 0.0, 0.0, 0.0 };
    double deepest = -1.0;
    kiriMesh mesh;
    kiriSheet_GetMesh(world, sheet, &mesh);
    for (int32_t i = 0; i < world->obstacles.count; ++i) {
        const kiriObstacleData* obstacle = world->obstacles.data[i];
        for (int32_t v = 0; v < mesh.vertexCount; ++v) {
            kiriVec3 local = kiriObstacle_PointToLocal(obstacle, kiriVec3_Load(&mesh.positions[3 * v]));
            double depth = -kiriObstacleShape_Nearest(&obstacle->shape, local, none).distance;
            deepest = depth > deepest ? depth : deepest;
        }
    }
    return deepest;
}

/* m: how far edges and corners of the obstacle stand out through the triangles. */
static double EdgeDepth(const Drape* drape)
{
    const kiriObstacleData* obstacle = drape->world->obstacles.data[0];
    double deepest = 0.0;
    kiriMesh mesh;
    kiriSheet_GetMesh(drape->world, drape->sheet, &mesh);
    for (int32_t i = 0; i < kiriObstacleShape_EdgeCount(&obstacle->shape); ++i) {
        kiriObstacleEdge edge;
        if (!kiriObstacleShape_EdgeAt(&obstacle->shape, i, &edge)) {
            continue;
        }
        for (int32_t k = 0; k <= 200; ++k) {
            kiriVec3 side = edge.faces[1], at;
            if (edge.radius > 0.0) {
                double angle = 2.0 * 3.14159265358979 * k / 200.0;
                side = kiriVec3_Make(cos(angle), sin(angle), 0.0);
                at = kiriVec3_AddScaled(edge.from, edge.radius, side);
            } else {
                at = kiriVec3_AddScaled(edge.from, k / 200.0, kiriVec3_Sub(edge.to, edge.from));
            }
            kiriVec3 out = kiriVec3_Normalize(kiriVec3_Add(edge.faces[0], side));
            kiriVec3 start = kiriObstacle_PointToWorld(obstacle, at);
            kiriVec3 in = kiriObstacle_ToWorld(obstacle, kiriVec3_Scale(-1.0, out));
            float origin[3], direction[3];
            kiriVec3_Store(origin, start);
            kiriVec3_Store(direction, in);
            kiriHit hit;
            if (kiriSheet_Raycast(drape->world, drape->sheet, origin, direction, 0.1f, &hit) == KIRI_OK &&
                hit.triangle >= 0) {
                deepest = hit.distance > deepest ? hit.distance : deepest;
            }
        }
    }
    return deepest;
}

typedef struct Fall {
    double worst, rest, edge; /* m */
    double asleep;            /* s; or as long as it was looked at */
    double contacts;          /* planes, at rest */
} Fall;

static Fall Watch(Drape* drape, int32_t ticks)
{
    Fall fall = { 0.0, 0.0, 0.0, (double)ticks * tickSeconds, 0.0 };
    for (int32_t t = 0; t < ticks; ++t) {
        kiriProfile profile;
        int32_t awake = 1;
        kiriWorld_Tick(drape->world, tickSeconds, SUBSTEPS);
        kiriSheet_IsAwake(drape->world, drape->sheet, &awake);
        fall.rest = Contact_Depth(drape->world, drape->sheet);
        fall.worst = fall.rest > fall.worst ? fall.rest : fall.worst;
        if (!awake) {
            fall.asleep = (double)t * tickSeconds;
            break;
        }
        kiriWorld_GetProfile(drape->world, &profile);
        fall.contacts = profile.contacts;
    }
    fall.edge = EdgeDepth(drape);
    return fall;
}

static void MeasureDrape(const Setting* setting, int32_t skinning)
{
    char name[64];
    Drape drape = StartDrape(setting, skinning);
    Fall fall = Watch(&drape, 420);
    const char* variant = skinning == KIRI_SKINNING_SMOOTH ? "smooth" : "linear";
    snprintf(name, sizeof(name), "%s", setting->name);
    Contact_Limit(name, variant, 1e3 * fall.rest, 100.0 * drape.square, "mm rest");
    Contact_Limit(name, variant, fall.rest / drape.square, 0.1, "sq rest");
    Contact_Limit(name, variant, fall.worst / drape.square, 0.5, "sq worst");
    Contact_Limit(name, variant, fall.edge / drape.square, 0.1, "sq edges");
    Contact_Limit(name, variant, fall.asleep, 6.0, "s asleep");
    Contact_Limit(name, variant, fall.contacts, 1000.0, "planes");
    kiriDestroyWorld(drape.world);
}

/* ---- A ball that its host moves by what it gets ------------------------------------------------------------------ */

static kiriSheet MakePlate(kiriWorld* world, float velocity)
{
    float positions[2 * 81];
    int32_t indices[6 * 64];
    kiriSheet sheet = 0;
    kiriSheetDef def = DefaultSheet();
    kiriFillRectangle(0.4f, 0.4f, 8, 8, positions, indices);
    def.restPositions = positions;
    def.vertexCount = 81;
    def.indices = indices;
    def.triangleCount = 128;
    def.gridResolution = 16;
    def.frameCount = def.maxFrames = 9;
    def.position[0] = def.position[1] = -0.2f;
    def.velocity[2] = velocity;
    def.material.airDamping = 0.0f;
    kiriCreateSheet(world, &def, &sheet);
    return sheet;
}

/* A ball of so many times its mass meets a cloth that flies at it with 1 m/s. */
static void MeasureBall(float ratio, int32_t substeps)
{
    kiriWorldDef worldDef = DefaultWorld();
    worldDef.gravity[2] = 0.0f;
    SCOPED_WORLD(world) = NULL;
    kiriCreateWorld(&worldDef, &world);
    kiriSheet sheet = MakePlate(world, -1.0f);
    kiriTotals totals;
    kiriSheet_GetTotals(world, sheet, &totals);
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_SPHERE);
    def.radius = 0.1f;
    def.position[2] = -0.11f;
    def.mass = ratio * (float)totals.mass;
    def.friction = 0.0f;
    kiriObstacle ball;
    kiriCreateObstacle(world, &def, &ball);
    double start = totals.momentum[2], energy = totals.kineticEnergy, velocity[3] = { 0.0, 0.0, 0.0 }, most = 0.0;
    for (int tick = 0; tick < 30; ++tick) {
        const float none[3] = { 0.0f, 0.0f, 0.0f };
        kiriObstacleState state;
        kiriWorld_Tick(world, tickSeconds, substeps);
        kiriObstacle_GetState(world, ball, &state);
        float next[3];
        for (int i = 0; i < 3; ++i) {
            velocity[i] += state.impulse[i] / (double)def.mass;
            next[i] = (float)velocity[i];
        }
        kiriObstacle_SetVelocity(world, ball, next, none);
        kiriSheet_GetTotals(world, sheet, &totals);
        double speed2 = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
        double all = totals.kineticEnergy + totals.elasticEnergy + 0.5 * (double)def.mass * speed2;
        most = all > most ? all : most;
    }
    char variant[64];
    snprintf(variant, sizeof(variant), "ball of %g masses, %d substeps", (double)ratio, (int)substeps);
    double end = totals.momentum[2] + (double)def.mass * velocity[2];
    Contact_Limit("momentum that is lost", variant, 100.0 * fabs(end / start - 1.0), 1.0, "%");
    Contact_Limit("most energy, to that at start", variant, most / energy, 1.01, "");
}

/* ---- Fast -------------------------------------------------------------------------------------------------------- */

/* A cloth at 100 m/s against a wall of 1 cm, flat and edge-on: how many of its vertices get to the other side. */
static void MeasureFast(int isEdgeOn, int32_t substeps)
{
    static float positions[2 * 33 * 33];
    static int32_t indices[6 * 32 * 32];
    kiriWorldDef worldDef = DefaultWorld();
    SCOPED_WORLD(world) = NULL;
    kiriCreateWorld(&worldDef, &world);
    kiriObstacleDef wall = ObstacleOf(KIRI_OBSTACLE_BOX);
    wall.size[0] = wall.size[1] = 8.0f;
    wall.size[2] = 0.01f;
    kiriObstacle obstacle;
    kiriCreateObstacle(world, &wall, &obstacle);
    kiriSheetDef def = DefaultSheet();
    kiriFillRectangle(1.0f, 1.0f, 32, 32, positions, indices);
    def.restPositions = positions;
    def.vertexCount = 33 * 33;
    def.indices = indices;
    def.triangleCount = 2 * 32 * 32;
    def.frameCount = def.maxFrames = 16;
    def.position[2] = 1.3f;
    def.axisV[1] = isEdgeOn ? 0.0f : 1.0f;
    def.axisV[2] = isEdgeOn ? 1.0f : 0.0f;
    def.velocity[2] = -100.0f;
    kiriSheet sheet;
    kiriCreateSheet(world, &def, &sheet);
    int passed = 0;
    for (int tick = 0; tick < 30; ++tick) {
        kiriMesh mesh;
        int now = 0;
        kiriWorld_Tick(world, tickSeconds, substeps);
        kiriSheet_GetMesh(world, sheet, &mesh);
        for (int32_t v = 0; v < mesh.vertexCount; ++v) {
            now += mesh.positions[3 * v + 2] < -0.005f;
        }
        passed = now > passed ? now : passed;
    }
    char variant[64];
    snprintf(variant, sizeof(variant), "%s, %d substeps", isEdgeOn ? "edge-on" : "flat", (int)substeps);
    Contact_Limit("100 m/s through 1 cm", variant, passed, 0.0, "vertices");
}

void Contact_MeasureObstacles(void)
{
    for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); ++i) {
        MeasureDrape(&settings[i], KIRI_SKINNING_LINEAR);
        MeasureDrape(&settings[i], KIRI_SKINNING_SMOOTH);
    }
    for (float ratio = 1e-3f; ratio < 2e3f; ratio *= 10.0f) {
        MeasureBall(ratio, 2);
    }
    MeasureBall(1.0f, 1);
    MeasureBall(1.0f, 8);
    for (int i = 0; i < 4; ++i) {
        MeasureFast(i % 2, i < 2 ? 2 : 8);
    }
}
