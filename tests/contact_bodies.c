/* Bodies with mass that fall on a held cloth: do they rest, and how deep do they get? The body moves as in the manual's
   chapter on contact. */
#include "defaults.h"
#include "contact.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 40, TICKS = 600, LAST = 60 };

static const float dt = 1.0f / 60.0f, gravity = 9.81f, half = 0.1f;

typedef struct Case {
    double ratio; /* mass of the body to the cloth's */
    int32_t frames, substeps, skinning, material;
    int isHung, isCrate; /* by four corners, not held all round; not a ball */
    float speed;         /* m/s, as it falls */
} Case;

typedef struct Body {
    kiriObstacle id;
    double mass, inertia;
    float position[3], rotation[9], velocity[3], spin[3];
} Body;

static kiriSheet AddCloth(kiriWorld* world, const Case* c)
{
    static const float corners[5][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } };
    kiriSheet sheet;
    kiriPin pin;
    kiriSheetDef def = DefaultSheet();
    kiriGetMaterial(c->material, &def.material);
    def.frameCount = c->frames;
    def.skinning = c->skinning;
    def.position[0] = def.position[1] = -0.5f;
    kiriCreateRectangle(world, 1.0f, 1.0f, CELLS, CELLS, &def, &sheet);
    for (int i = 0; i < 4; ++i) {
        kiriPinDef corner = DefaultPin();
        memcpy(corner.restPoint, corners[i], sizeof(corners[i]));
        corner.target[0] = corners[i][0] - 0.5f;
        corner.target[1] = corners[i][1] - 0.5f;
        if (c->isHung) {
            kiriCreatePin(world, sheet, &corner, &pin);
        } else {
            kiriSheet_HingeLine(world, sheet, corners[i], corners[i + 1], &pin);
        }
    }
    return sheet;
}

static Body AddBody(kiriWorld* world, const Case* c, double mass)
{
    kiriObstacleDef def = DefaultObstacle();
    Body body = { 0, mass, (c->isCrate ? 2.0 / 3.0 : 0.4) * mass * half * half, { 0.013f, 0.007f, 0.0f }, { 0 }, { 0 }, { 0 } };
    def.type = c->isCrate ? KIRI_OBSTACLE_BOX : KIRI_OBSTACLE_SPHERE;
    def.radius = half;
    def.size[0] = def.size[1] = def.size[2] = 2.0f * half;
    def.mass = (float)mass;
    def.inertia[0] = def.inertia[1] = def.inertia[2] = (float)body.inertia;
    body.velocity[2] = -c->speed;
    body.position[2] = half + 0.003f + 2.0f * dt * c->speed;
    memcpy(body.rotation, def.rotation, sizeof(body.rotation));
    kiriCreateObstacle(world, &def, &body.id);
    return body;
}

static void Turn(float rotation[9], const float spin[3])
{
    for (int c = 0; c < 3; ++c) {
        float x[3] = { rotation[3 * c], rotation[3 * c + 1], rotation[3 * c + 2] };
        for (int i = 0; i < 3; ++i) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            rotation[3 * c + i] = x[i] + dt * (spin[j] * x[k] - spin[k] * x[j]);
        }
    }
    for (int c = 0; c < 3; ++c) { /* the first column stays, the others become normal to those before */
        float *x = &rotation[3 * c], length = 0.0f;
        for (int b = 0; b < c; ++b) {
            float* y = &rotation[3 * b];
            float along = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
            for (int i = 0; i < 3; ++i) {
                x[i] -= along * y[i];
            }
        }
        for (int i = 0; i < 3; ++i) {
            length += x[i] * x[i];
        }
        for (int i = 0; i < 3; ++i) {
            x[i] /= sqrtf(length);
        }
    }
}

/* A tick of the world, and one of the engine that moves the body. */
static void Tick(kiriWorld* world, Body* body, int32_t substeps)
{
    kiriObstacleState state;
    body->velocity[2] -= gravity * dt;
    kiriObstacle_SetPose(world, body->id, body->position, body->rotation);
    kiriObstacle_SetVelocity(world, body->id, body->velocity, body->spin);
    kiriWorld_Tick(world, dt, substeps);
    kiriObstacle_GetState(world, body->id, &state);
    for (int i = 0; i < 3; ++i) {
        body->velocity[i] += (float)(state.impulse[i] / body->mass);
        body->spin[i] += (float)(state.angularImpulse[i] / body->inertia);
        body->position[i] += dt * body->velocity[i];
    }
    Turn(body->rotation, body->spin);
    kiriObstacle_SetPose(world, body->id, body->position, body->rotation); /* depth is measured where it is now */
}

static double EnergyOf(const kiriWorld* world, kiriSheet sheet, const Body* body)
{
    kiriTotals t;
    kiriSheet_GetTotals(world, sheet, &t);
    double energy = t.kineticEnergy + t.elasticEnergy + t.mass * (double)gravity * t.center[2];
    energy += body->mass * (double)gravity * (double)body->position[2];
    for (int i = 0; i < 3; ++i) {
        energy += 0.5 * body->mass * (double)(body->velocity[i] * body->velocity[i]);
        energy += 0.5 * body->inertia * (double)(body->spin[i] * body->spin[i]);
    }
    return energy;
}

/* m: how far the lowest vertex of the cloth is below the middle of the body. Below 0: the body fell through. */
static double Below(const kiriWorld* world, kiriSheet sheet, const Body* body)
{
    kiriMesh mesh;
    float lowest = 0.0f;
    kiriSheet_GetMesh(world, sheet, &mesh);
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        lowest = fminf(mesh.positions[3 * v + 2], lowest);
    }
    return (double)(body->position[2] - lowest);
}

static void MeasureFall(const Case* c)
{
    char variant[80];
    double deepest = 0.0, gained = 0.0, lowest = 0.0, fastest = 0.0, borne = 0.0, last = HUGE_VAL;
    int isThrough = 0;
    SCOPED_WORLD(world) = NULL;
    kiriTotals totals;
    kiriWorldDef def = DefaultWorld();
    kiriCreateWorld(&def, &world);
    kiriSheet sheet = AddCloth(world, c);
    kiriSheet_GetTotals(world, sheet, &totals);
    Body body = AddBody(world, c, c->ratio * totals.mass);
    for (int tick = 0; tick < TICKS && !isThrough; ++tick) {
        Tick(world, &body, c->substeps);
        double energy = EnergyOf(world, sheet, &body);
        gained = fmax(energy - last, gained);
        last = energy;
        deepest = fmax(Contact_Depth(world, sheet), deepest);
        lowest = fmin((double)body.position[2], lowest);
        if (fmaxf(fabsf(body.position[0]), fabsf(body.position[1])) > 0.5f) {
            break; /* it was thrown off, and falls beside the cloth */
        }
        isThrough = Below(world, sheet, &body) < 0.0;
        if (tick >= TICKS - LAST) {
            kiriObstacleState state;
            kiriObstacle_GetState(world, body.id, &state);
            borne += state.impulse[2] / (LAST * body.mass * (double)(gravity * dt));
            fastest = fmax((double)sqrtf(body.velocity[0] * body.velocity[0] + body.velocity[1] * body.velocity[1] +
                                         body.velocity[2] * body.velocity[2]), fastest);
        }
    }
    snprintf(variant, sizeof variant, "%s %g x, %s, %d fr, %d sub, %s, %g m/s", c->isCrate ? "crate" : "ball", c->ratio,
             c->isHung ? "hung" : "held", (int)c->frames, (int)c->substeps,
             c->skinning == KIRI_SKINNING_SMOOTH ? "smooth" : "linear", (double)c->speed);
    double fall = body.mass * ((double)gravity * (0.1 - lowest) + 0.5 * (double)(c->speed * c->speed));
    Contact_Limit("body: falls through", variant, isThrough, 0.0, "");
    Contact_Limit("body: deepest vertex", variant, 1e3 * deepest, 5.0, "mm");
    Contact_Limit("body: energy gained in a tick", variant, gained / fall, 1e-3, "of 1");
    if (!isThrough && c->speed == 0.0f) {
        Contact_Limit("body: speed after 9 s", variant, fastest, 0.02, "m/s");
        Contact_Line("body: weight that is borne", variant, borne, 1.0, 0.01, "of 1");
    }
}

/* Two fingers of 0.1 kg on rails press on a hanging cloth with the same force each, and lift it by 0.5 m once its pins go. */
static void MeasureGrip(const Case* c, double force)
{
    enum { LET_GO = 90, LIFTED = 240, END = 480 };
    static const float ends[2][2] = { { 0.0f, 0.4f }, { 0.4f, 0.4f } }, held[2] = { 0.2f, 0.36f }, none[3] = { 0.0f, 0.0f, 0.0f };
    Body fingers[2] = { { .mass = 0.1 }, { .mass = 0.1 } };
    SCOPED_WORLD(world) = NULL;
    kiriPin pins[2];
    kiriSheet sheet;
    kiriPointState at;
    kiriWorldDef worldDef = DefaultWorld();
    kiriSheetDef def = DefaultSheet();
    char variant[80];
    float height = -0.04f, before = 0.0f;
    double pressed = 0.0, slid = 0.0;
    kiriCreateWorld(&worldDef, &world);
    def.frameCount = c->frames;
    def.skinning = c->skinning;
    memcpy(def.position, (const float[3]){ -0.2f, 0.0f, -0.4f }, sizeof(def.position));
    memcpy(def.axisV, (const float[3]){ 0.0f, 0.0f, 1.0f }, sizeof(def.axisV));
    kiriCreateRectangle(world, 0.4f, 0.4f, CELLS, CELLS, &def, &sheet);
    for (int i = 0; i < 2; ++i) {
        kiriPinDef pin = DefaultPin();
        kiriObstacleDef finger = DefaultObstacle();
        memcpy(pin.restPoint, ends[i], sizeof(ends[i]));
        pin.target[0] = ends[i][0] - 0.2f;
        kiriCreatePin(world, sheet, &pin, &pins[i]);
        memcpy(finger.size, (const float[3]){ 0.03f, 0.01f, 0.02f }, sizeof(finger.size));
        finger.type = KIRI_OBSTACLE_BOX;
        finger.mass = (float)fingers[i].mass;
        fingers[i].position[1] = i == 0 ? -0.025f : 0.025f;
        fingers[i].position[2] = height;
        memcpy(fingers[i].rotation, finger.rotation, sizeof(finger.rotation));
        kiriCreateObstacle(world, &finger, &fingers[i].id);
    }
    for (int tick = 0; tick < END; ++tick) {
        for (int i = 0; i < 2 && tick == LET_GO; ++i) {
            kiriDestroyPin(world, pins[i]);
        }
        height += tick >= LET_GO + 30 && tick < LIFTED ? 0.25f * dt : 0.0f;
        for (int i = 0; i < 2; ++i) {
            Body* finger = &fingers[i];
            finger->velocity[0] = -finger->position[0] / dt; /* motors hold it on its rail */
            finger->velocity[1] += (float)((i == 0 ? force : -force) / finger->mass) * dt;
            finger->velocity[2] = (height - finger->position[2]) / dt;
            kiriObstacle_SetPose(world, finger->id, finger->position, finger->rotation);
            kiriObstacle_SetVelocity(world, finger->id, finger->velocity, none);
        }
        kiriWorld_Tick(world, dt, c->substeps);
        for (int i = 0; i < 2; ++i) {
            kiriObstacleState state;
            kiriObstacle_GetState(world, fingers[i].id, &state);
            for (int k = 0; k < 3; ++k) {
                fingers[i].velocity[k] += (float)(state.impulse[k] / fingers[i].mass);
                fingers[i].position[k] += dt * fingers[i].velocity[k];
            }
            pressed += tick >= LIFTED ? (i == 0 ? -0.5 : 0.5) * state.impulse[1] / (double)(dt * (END - LIFTED)) : 0.0;
        }
        kiriSheet_GetPoint(world, sheet, held, &at);
        before = tick == LET_GO - 1 ? at.position[2] - fingers[0].position[2] : before;
        slid = tick >= LET_GO ? fmax(slid, (double)fabsf(at.position[2] - fingers[0].position[2] - before)) : slid;
    }
    snprintf(variant, sizeof variant, "%g N, %d fr, %d sub, %s", force, (int)c->frames, (int)c->substeps,
             c->skinning == KIRI_SKINNING_SMOOTH ? "smooth" : "linear");
    Contact_Line("grip: force", variant, pressed / force, 1.0, 0.02, "of 1");
    Contact_Limit("grip: slides", variant, 1e3 * slid, 10.0, "mm");
}

void Contact_MeasureBodies(void)
{
    for (int i = 0; i < 4 * 3; ++i) {
        MeasureGrip(&(Case){ .frames = i % 2 ? 100 : 25, .substeps = i / 2 % 2 ? 8 : 2,
                             .skinning = i % 3 ? KIRI_SKINNING_LINEAR : KIRI_SKINNING_SMOOTH },
                    (const double[3]){ 2.0, 3.0, 5.0 }[i / 4]);
    }
    static const double ratios[] = { 1.0, 10.0, 100.0, 1000.0 };
    static const float speeds[] = { 5.0f, 15.0f, 30.0f, 60.0f, 100.0f };
    for (int i = 0; i < 2 * 4 * 2 * 4; ++i) { /* the settings of the solver change by turns */
        int turn = i % 4;
        Case c = { ratios[i / 4 % 4], turn % 2 ? 100 : 25, turn / 2 ? 8 : 2, (turn + i / 16) % 2 ? KIRI_SKINNING_SMOOTH : KIRI_SKINNING_LINEAR,
                   KIRI_MATERIAL_COTTON, i / 32, i / 16 % 2, 0.0f };
        /* Cotton stretches to several times its size under 1000 masses: paper does not. */
        c.material = c.ratio > 100.0 ? KIRI_MATERIAL_PAPER : c.material;
        MeasureFall(&c);
    }
    for (int i = 0; i < 2 * 5 * 2; ++i) {
        MeasureFall(&(Case){ i / 10 ? 10.0 : 1.0, 25, i % 2 ? 8 : 2, KIRI_SKINNING_LINEAR, KIRI_MATERIAL_COTTON, 0, 0, speeds[i / 2 % 5] });
    }
}
