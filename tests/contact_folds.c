/* Sheets that fold over themselves: triangles of one piece that cross, in motion and at rest. */
#include "defaults.h"
#include "contact.h"
#include "crossing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float dt = 1.0f / 60.0f;

/* A sheet that folds, its pins and its wheel. */
typedef struct Fold {
    kiriWorld* world;
    kiriSheet sheet;
    kiriPin pins[8];
    int32_t pinCount;
    kiriObstacle wheel;
    float size;
} Fold;

typedef struct FoldCase {
    const char* name;
    float width, height;
    int32_t columns, rows, grid, frames;
    float thickness, position[3], axisV[3];
    int32_t ticks, freeAt; /* freeAt: the host lets go */
    void (*start)(Fold* fold);
    void (*move)(Fold* fold, double time);
} FoldCase;

static void AddPin(Fold* fold, float u, float v)
{
    kiriMesh mesh;
    int32_t best = 0;
    kiriSheet_GetMesh(fold->world, fold->sheet, &mesh);
    for (int32_t i = 1; i < mesh.vertexCount; ++i) {
        double du = mesh.restPositions[2 * i] - u, dv = mesh.restPositions[2 * i + 1] - v;
        double eu = mesh.restPositions[2 * best] - u, ev = mesh.restPositions[2 * best + 1] - v;
        best = du * du + dv * dv < eu * eu + ev * ev ? i : best;
    }
    kiriPinDef def = DefaultPin();
    memcpy(def.restPoint, &mesh.restPositions[2 * best], sizeof def.restPoint);
    memcpy(def.target, &mesh.positions[3 * best], sizeof def.target);
    kiriCreatePin(fold->world, fold->sheet, &def, &fold->pins[fold->pinCount++]);
}

static kiriObstacle AddObstacle(Fold* fold, int32_t type, float radius, float height, const float at[3])
{
    kiriObstacle obstacle = 0;
    kiriObstacleDef def = ObstacleOf(type);
    def.radius = radius;
    def.height = height;
    memcpy(def.position, at, sizeof def.position);
    kiriCreateObstacle(fold->world, &def, &obstacle);
    return obstacle;
}

static void StartFolded(Fold* fold)
{
    for (int i = 0; i < 3; ++i) {
        AddPin(fold, fold->size, 0.5f * fold->size * (float)i);
    }
}

/* Carries one edge over to the other. */
static void MoveFolded(Fold* fold, double time)
{
    double angle = 3.1 * fmin(time / 1.5, 1.0), radius = 0.45 * (double)fold->size;
    for (int i = 0; i < fold->pinCount; ++i) {
        const float target[3] = { (float)(0.5 * (double)fold->size + 1.1 * radius * cos(angle)), 0.5f * fold->size * (float)i,
                                  (float)(0.01 + 1.1 * radius * sin(angle)) };
        kiriPin_SetTarget(fold->world, fold->pins[i], target);
    }
}

static void StartHung(Fold* fold)
{
    for (int i = 0; i < 8; ++i) {
        AddPin(fold, fold->size * (float)i / 7.0f, fold->size);
    }
}

static void StartRibbon(Fold* fold)
{
    const float at[3] = { 0.0f, 0.03f, 1.3f };
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_CYLINDER);
    def.radius = 0.06f;
    def.height = 0.2f;
    memcpy(def.position, at, sizeof at);
    const float along[9] = { 1, 0, 0, 0, 0, 1, 0, -1, 0 };
    memcpy(def.rotation, along, sizeof along);
    kiriCreateObstacle(fold->world, &def, &fold->wheel);
    for (int i = 0; i < 3; ++i) {
        kiriPinDef pin = DefaultPin();
        pin.restPoint[0] = 0.001f;
        pin.restPoint[1] = 0.001f + 0.029f * (float)i;
        Set3(pin.target, 0.0f, pin.restPoint[1], 1.3f + 0.061f);
        pin.obstacle = fold->wheel;
        kiriCreatePin(fold->world, fold->sheet, &pin, &fold->pins[i]);
    }
}

static void MoveRibbon(Fold* fold, double time)
{
    const float none[3] = { 0.0f, 0.0f, 0.0f }, spin[3] = { 0.0f, time < 4.0 ? -5.0f : 0.0f, 0.0f };
    kiriObstacle_SetVelocity(fold->world, fold->wheel, none, spin);
}

static const FoldCase cases[] = {
    { "square folded once", 0.6f, 0.6f, 32, 32, 32, 36, 0.0f, { 0.0f, 0.0f, 0.005f }, { 0, 1, 0 }, 480, 110, StartFolded,
      MoveFolded },
    { "cloth folded once", 1.0f, 1.0f, 40, 40, 32, 64, 0.0f, { 0.0f, 0.0f, 0.005f }, { 0, 1, 0 }, 480, 110, StartFolded,
      MoveFolded },
    { "crumpled", 1.0f, 1.0f, 32, 32, 32, 49, 0.0f, { 0.0f, 0.0f, 0.05f }, { 0.0f, 0.02f, 0.9998f }, 600, 0, NULL, NULL },
    { "fallen curtain", 1.5f, 1.5f, 40, 40, 32, 64, 0.0f, { 0.0f, 0.0f, 0.02f }, { 0, 0, 1 }, 600, 30, StartHung, NULL },
    { "ribbon on a wheel", 1.2f, 0.06f, 80, 4, 80, 30, 0.003f, { 0.0f, 0.0f, 1.361f }, { 0, 1, 0 }, 480, 0, StartRibbon, MoveRibbon },
};

static void StartFold(Fold* fold, const FoldCase* of, int32_t selfContact)
{
    const float at[3] = { 0.0f, 0.0f, 0.0f };
    memset(fold, 0, sizeof *fold);
    kiriWorldDef worldDef = DefaultWorld();
    kiriCreateWorld(&worldDef, &fold->world);
    AddObstacle(fold, KIRI_OBSTACLE_PLANE, 0.0f, 0.0f, at);
    kiriSheetDef def = DefaultSheet();
    memcpy(def.position, of->position, sizeof def.position);
    memcpy(def.axisV, of->axisV, sizeof def.axisV);
    double length = sqrt((double)(def.axisV[0] * def.axisV[0] + def.axisV[1] * def.axisV[1] + def.axisV[2] * def.axisV[2]));
    for (int i = 0; i < 3; ++i) {
        def.axisV[i] = (float)(def.axisV[i] / length);
    }
    def.gridResolution = of->grid;
    def.frameCount = of->frames;
    def.selfContact = selfContact;
    def.contactThickness = of->thickness;
    fold->size = of->width;
    kiriCreateRectangle(fold->world, of->width, of->height, of->columns, of->rows, &def, &fold->sheet);
    if (of->start != NULL) {
        of->start(fold);
    }
}

static void MeasureFold(const FoldCase* of, int32_t selfContact)
{
    Fold fold;
    char variant[64];
    double worst = 0.0, last = 0.0, spent = 0.0, gained = 0.0, energy = 0.0, asleep = HUGE_VAL;
    double more = selfContact ? 0.0 : HUGE_VAL; /* without self contact layers cross, and nothing is promised */
    int32_t longest = 0, since = 0, ticks = 0;
    StartFold(&fold, of, selfContact);
    for (int32_t tick = 1; tick <= of->ticks && asleep == HUGE_VAL; ++tick, ++ticks) {
        if (of->move != NULL && (of->freeAt == 0 || tick < of->freeAt)) {
            of->move(&fold, tick * (double)dt);
        }
        for (int i = 0; tick == of->freeAt && i < fold.pinCount; ++i) {
            kiriDestroyPin(fold.world, fold.pins[i]);
        }
        double start = Contact_Milliseconds(), before = energy;
        kiriWorld_Tick(fold.world, dt, 2);
        spent += Contact_Milliseconds() - start;
        energy = World_Energy(fold.world, fold.sheet);
        gained = tick > of->freeAt + 1 && of->move == NULL ? fmax(gained, energy / before - 1.0) : gained;
        Crossing crossing = Crossing_MeasureSelf(fold.world, fold.sheet);
        last = crossing.crossing;
        worst = fmax(worst, last / crossing.triangles);
        since = last > 0.0 ? since + 1 : 0;
        longest = since > longest ? since : longest;
        int32_t awake = 1;
        kiriSheet_IsAwake(fold.world, fold.sheet, &awake);
        asleep = awake ? HUGE_VAL : tick * (double)dt;
    }
    snprintf(variant, sizeof variant, "%d frames%s", (int)of->frames, selfContact ? "" : ", off");
    Contact_Limit(of->name, variant, last, more, "crossing at the end");
    Contact_Limit(of->name, variant, 100.0 * worst, 0.2 + more, "% crossing at worst");
    Contact_Limit(of->name, variant, longest * (double)dt, 1.0 + more, "s crossing");
    Contact_Limit(of->name, variant, gained, 1e-3 + more, "energy gained");
    Contact_Limit(of->name, variant, asleep, 8.0 + more, "s asleep");
    Contact_Limit(of->name, variant, spent / ticks, 10.0 + more, "ms");
    kiriDestroyWorld(fold.world);
}

void Contact_MeasureFolds(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        MeasureFold(&cases[i], 0);
        MeasureFold(&cases[i], 1);
    }
}
