/* A sheet among planes, for what tests and measures contact through the public header. A plane touches all collision
   points; it may move, and may be a body of so much mass, which the impulses of the sheet move from tick to tick. */
#ifndef KIRI_TOUCHING_H
#define KIRI_TOUCHING_H

#include "defaults.h"
#include "kiri/kiri.h"
#include "scoped.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TOUCHING_PLATE, TOUCHING_CLOTH, TOUCHING_MOST_POINTS = 512 };

typedef struct TouchingDef {
    int kind;        /* TOUCHING_... */
    int frames;      /* along each side */
    int points;      /* collision points */
    double size;     /* m */
    double height;   /* m: of the sheet above z = 0 */
    double speed[3]; /* m/s */
    double dt;       /* s */
    int substeps, model, planar;
} TouchingDef;

typedef struct Plane {
    double normal[3], at[3], velocity[3]; /* unit; m; m/s */
    double friction, mass;                /* kg; 0: nothing moves it */
    double pushSpeed;
} Plane;

typedef struct Touching {
    TouchingDef def;
    kiriWorld* world;
    kiriSheet sheet;
    double mass, impulse[3], moment[3]; /* kg; N s, N m s about the origin: of contacts in the last tick */
    double deepest;                     /* m: of a contact after the last tick */
} Touching;

static inline TouchingDef Touching_Def(int kind, int frames)
{
    TouchingDef def = { kind, frames, 49, 0.4, 1e-4, { 0.0, 0.0, 0.0 }, 1.0 / 60.0, 1, KIRI_MODEL_LINKS, 0 };
    return def;
}

static inline void Touching_Require(kiriResult result, const char* what)
{
    if (result < 0) {
        fprintf(stderr, "%s: %s\n", what, kiriGetResultName(result));
        abort();
    }
}

#define REQUIRE_OK(call) Touching_Require(call, #call)

static inline kiriMaterial Touching_Material(int kind)
{
    kiriMaterial material;
    REQUIRE_OK(kiriGetMaterial(KIRI_MATERIAL_COTTON, &material));
    if (kind == TOUCHING_PLATE) {
        material.youngsModulus = 1e9f;
        material.thickness = 0.002f;
        material.density = 500.0f;
        material.poissonsRatio = 0.3f;
    }
    material.airDamping = 0.0f;
    return material;
}

static inline void Touching_AddSheet(Touching* t)
{
    enum { SIDE = 24 };
    static float positions[2 * (SIDE + 1) * (SIDE + 1)], frames[2 * 32 * 32];
    static int32_t indices[6 * SIDE * SIDE];
    const TouchingDef* d = &t->def;
    kiriSheetDef def = DefaultSheet();
    kiriFillRectangle((float)d->size, (float)d->size, SIDE, SIDE, positions, indices);
    for (int k = 0; k < d->frames * d->frames; ++k) {
        frames[2 * k] = (float)(d->size * (k % d->frames + 0.5) / d->frames);
        frames[2 * k + 1] = (float)(d->size * (k / d->frames + 0.5) / d->frames);
    }
    def.restPositions = positions;
    def.vertexCount = (SIDE + 1) * (SIDE + 1);
    def.indices = indices;
    def.triangleCount = 2 * SIDE * SIDE;
    def.framePoints = frames;
    def.frameCount = def.maxFrames = d->frames * d->frames;
    def.collisionPoints = d->points;
    def.material = Touching_Material(d->kind);
    def.model = d->model;
    def.planar = d->planar;
    def.position[2] = (float)d->height;
    for (int k = 0; k < 3; ++k) {
        def.velocity[k] = (float)d->speed[k];
    }
    REQUIRE_OK(kiriCreateSheet(t->world, &def, &t->sheet));
}

static inline kiriTotals Touching_Totals(const Touching* t)
{
    kiriTotals totals;
    REQUIRE_OK(kiriSheet_GetTotals(t->world, t->sheet, &totals));
    return totals;
}

static inline void Touching_Start(Touching* t, const TouchingDef* def, const double gravity[3])
{
    memset(t, 0, sizeof(*t));
    t->def = *def;
    kiriWorldDef world;
    kiriDefaultWorldDef(&world);
    for (int k = 0; k < 3; ++k) {
        world.gravity[k] = (float)gravity[k];
    }
    REQUIRE_OK(kiriCreateWorld(&world, &t->world));
    Touching_AddSheet(t);
    t->mass = Touching_Totals(t).mass;
}

static inline void Touching_Stop(Touching* t)
{
    kiriDestroyWorld(t->world);
    t->world = NULL;
}

/* A floor on which gravity is inclined by an angle towards x. */
static inline void Touching_Slope(double angle, double gravity[3])
{
    gravity[0] = 9.81 * sin(angle);
    gravity[1] = 0.0;
    gravity[2] = -9.81 * cos(angle);
}

static inline Plane Touching_Floor(double friction)
{
    Plane plane = { { 0.0, 0.0, 1.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, friction, 0.0, 0.0 };
    return plane;
}

static inline double Touching_Dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline int Touching_AddPlane(const Touching* t, const Plane* plane, int32_t obstacle, kiriContact* contacts)
{
    const float* points;
    int32_t count;
    REQUIRE_OK(kiriSheet_GetCollisionPoints(t->world, t->sheet, &points, &count));
    for (int32_t i = 0; i < count && i < TOUCHING_MOST_POINTS; ++i) {
        kiriContact contact = { .point = i, .obstacle = obstacle };
        contact.offset = (float)Touching_Dot(plane->normal, plane->at);
        contact.friction = (float)plane->friction;
        contact.inverseMass = plane->mass > 0.0 ? (float)(1.0 / plane->mass) : 0.0f;
        contact.pushSpeed = (float)plane->pushSpeed;
        for (int k = 0; k < 3; ++k) {
            contact.normal[k] = (float)plane->normal[k];
            contact.velocity[k] = (float)plane->velocity[k];
        }
        contacts[i] = contact;
    }
    return count < TOUCHING_MOST_POINTS ? count : TOUCHING_MOST_POINTS;
}

static inline void Touching_SumForces(Touching* t)
{
    const kiriContactForce* forces;
    int32_t count;
    REQUIRE_OK(kiriSheet_GetContactForces(t->world, t->sheet, &forces, &count));
    memset(t->impulse, 0, sizeof(t->impulse));
    memset(t->moment, 0, sizeof(t->moment));
    t->deepest = -1e30;
    for (int32_t i = 0; i < count; ++i) {
        const double *j = forces[i].impulse, *x = forces[i].position;
        for (int k = 0; k < 3; ++k) {
            t->impulse[k] += j[k];
            t->moment[k] += x[(k + 1) % 3] * j[(k + 2) % 3] - x[(k + 2) % 3] * j[(k + 1) % 3];
        }
        t->deepest = forces[i].depth > t->deepest ? forces[i].depth : t->deepest;
    }
}

/* One tick. A body gets the impulse, and goes on as the host's engine would have it: velocity first, then place. */
static inline void Touching_Tick(Touching* t, Plane* plane)
{
    static kiriContact contacts[TOUCHING_MOST_POINTS];
    int count = Touching_AddPlane(t, plane, 7, contacts);
    REQUIRE_OK(kiriSheet_SetContacts(t->world, t->sheet, contacts, count));
    REQUIRE_OK(kiriWorld_Tick(t->world, (float)t->def.dt, t->def.substeps));
    Touching_SumForces(t);
    for (int k = 0; k < 3; ++k) {
        plane->velocity[k] -= plane->mass > 0.0 ? t->impulse[k] / plane->mass : 0.0;
        plane->at[k] += t->def.dt * plane->velocity[k];
    }
}

static inline void Touching_Ticks(Touching* t, Plane* plane, int count)
{
    for (int tick = 0; tick < count; ++tick) {
        Touching_Tick(t, plane);
    }
}

/* Angular momentum about the centre of mass, along y. */
static inline double OwnTurning(const kiriTotals* t)
{
    return t->angularMomentum[1] - t->center[2] * t->momentum[0] + t->center[0] * t->momentum[2];
}

#endif
