#include "contact.h"
#include "touching.h"

/* ---- Friction ---------------------------------------------------------------------------------------------------- */

/* m/s: how fast the sheet slides after so many seconds on a slope; of half a second later. */
static double SlideSpeed(const TouchingDef* def, double friction, double angle)
{
    SCOPED(Touching, t, Touching_Stop);
    double gravity[3], from = 0.0;
    Plane floor = Touching_Floor(friction);
    Touching_Slope(angle, gravity);
    Touching_Start(&t, def, gravity);
    int settled = (int)(0.75 / def->dt + 0.5), ticks = (int)(1.5 / def->dt + 0.5);
    for (int tick = 0; tick < ticks; ++tick) {
        from = tick == settled ? Touching_Totals(&t).center[0] : from;
        Touching_Tick(&t, &floor);
    }
    double speed = (Touching_Totals(&t).center[0] - from) / (def->dt * (ticks - settled));
    return speed;
}

/* The steepest angle at which it does not go a tenth of a millimetre a second. */
static double HoldingAngle(const TouchingDef* def, double friction)
{
    double low = 0.0, high = 1.2;
    for (int k = 0; k < 10; ++k) {
        double middle = 0.5 * (low + high);
        if (SlideSpeed(def, friction, middle) < 1e-4) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 57.29577951308232 * low;
}

static void MeasureFrictionAngles(void)
{
    static const double frictions[] = { 0.1, 0.3, 0.5, 0.7, 1.0 };
    for (int kind = 0; kind < 2; ++kind) {
        for (int frames = 1; frames <= 5; frames += 2) {
            TouchingDef def = Touching_Def(kind, frames);
            for (int k = 0; k < 5; ++k) {
                char variant[64];
                snprintf(variant, sizeof variant, "%s, %d frames, mu %.1f", kind ? "cloth" : "plate", frames * frames,
                         frictions[k]);
                Contact_Line("friction angle", variant, HoldingAngle(&def, frictions[k]),
                             57.29577951308232 * atan(frictions[k]), 1.0, "deg");
            }
        }
    }
}

/* m: how far a sheet goes that slides at 2 m/s. */
static void MeasureStopping(void)
{
    for (int k = 0; k < 8; ++k) {
        int kind = k / 4, frames = k % 2 ? 5 : 1, substeps = k / 2 % 2 ? 4 : 1;
        TouchingDef def = Touching_Def(kind, frames);
        const double gravity[3] = { 0.0, 0.0, -9.81 };
        Plane floor = Touching_Floor(0.4);
        SCOPED(Touching, t, Touching_Stop);
        char variant[64];
        def.speed[0] = 2.0;
        def.substeps = substeps;
        Touching_Start(&t, &def, gravity);
        double from = Touching_Totals(&t).center[0];
        Touching_Ticks(&t, &floor, 90);
        double way = Touching_Totals(&t).center[0] - from, law = 4.0 / (2.0 * 0.4 * 9.81);
        snprintf(variant, sizeof variant, "%s, %d frames, %d substeps", kind ? "cloth" : "plate", frames * frames,
                 substeps);
        Contact_Line("stopping distance", variant, way, law, 0.05 * law, "m");
    }
}

/* The belt goes at 1 m/s: its speed is reached after v / (mu g). */
static void MeasureConveyor(void)
{
    for (int frames = 1; frames <= 5; frames += 4) {
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, frames);
        const double gravity[3] = { 0.0, 0.0, -9.81 };
        Plane belt = Touching_Floor(0.3);
        SCOPED(Touching, t, Touching_Stop);
        char variant[64];
        double reached = 0.0, last = 0.0;
        belt.velocity[0] = 1.0;
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 90; ++tick) {
            belt.at[0] = 0.0;
            Touching_Tick(&t, &belt);
            kiriTotals now = Touching_Totals(&t);
            last = now.momentum[0] / now.mass;
            reached = reached == 0.0 && last > 0.99 ? (tick + 1) * def.dt : reached;
        }
        snprintf(variant, sizeof variant, "cloth, %d frames, mu 0.3", frames * frames);
        Contact_Line("conveyor: speed", variant, last, 1.0, 1e-3, "m/s");
        Contact_Line("conveyor: time", variant, reached, 0.99 / (0.3 * 9.81), 2.0 * def.dt, "s");
    }
}

/* ---- Momentum and energy ----------------------------------------------------------------------------------------- */

static double Energy(const kiriTotals* totals, const Plane* body, double gravity)
{
    return totals->kineticEnergy + totals->elasticEnergy + totals->mass * gravity * totals->center[2] +
           0.5 * body->mass * Touching_Dot(body->velocity, body->velocity) + body->mass * gravity * body->at[2];
}

/* A sheet at 3 m/s meets a free body without gravity: they go on together, as nothing bounces. */
static void MeasureImpact(double ratio, int substeps, int frames)
{
    TouchingDef def = Touching_Def(TOUCHING_PLATE, frames);
    const double none[3] = { 0.0, 0.0, 0.0 };
    SCOPED(Touching, t, Touching_Stop);
    char variant[64];
    def.substeps = substeps;
    def.height = 0.1;
    def.speed[2] = -3.0;
    Touching_Start(&t, &def, none);
    Plane body = Touching_Floor(0.3);
    body.mass = ratio * t.mass;
    double before = -3.0 * t.mass, most = 0.5 * 9.0 * t.mass, gained = 0.0, off = 0.0, had = most;
    for (int tick = 0; tick < 30; ++tick) {
        Touching_Tick(&t, &body);
        kiriTotals now = Touching_Totals(&t);
        off = fmax(off, fabs((now.momentum[2] + body.mass * body.velocity[2] - before) / before));
        double has = Energy(&now, &body, 0.0);
        gained = fmax(gained, (has - had) / most);
        had = has;
    }
    kiriTotals now = Touching_Totals(&t);
    double together = before / (t.mass + body.mass);
    snprintf(variant, sizeof variant, "mass %g, %d substeps, %d frames", ratio, substeps, frames * frames);
    Contact_Limit("impact: momentum", variant, off, 0.01, "");
    Contact_Limit("impact: energy gained", variant, gained, 1e-3, "");
    Contact_Line("impact: sheet's speed", variant, now.momentum[2] / now.mass, together, 0.15, "m/s");
    Contact_Line("impact: body's speed", variant, body.velocity[2], together, 0.15, "m/s");
}

/* A body falls on a sheet that lies on the floor; or the sheet falls on a body in the air that gravity lets fall after
   it. The most that anything rises after the blow. */
static void MeasureCrate(double ratio, int frames)
{
    TouchingDef def = Touching_Def(TOUCHING_CLOTH, frames);
    const double gravity[3] = { 0.0, 0.0, -9.81 };
    static kiriContact contacts[2 * TOUCHING_MOST_POINTS];
    SCOPED(Touching, t, Touching_Stop);
    char variant[64];
    Touching_Start(&t, &def, gravity);
    Plane floor = Touching_Floor(0.5),
          crate = { { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 0.2 }, { 0.0, 0.0, 0.0 }, 0.5, 0.0, 0.0 };
    crate.mass = ratio * t.mass;
    double fastest = 0.0, deepest = 0.0, sheet = 0.0;
    for (int tick = 0; tick < 120; ++tick) {
        crate.velocity[2] -= 9.81 * def.dt;
        int count = Touching_AddPlane(&t, &floor, 1, contacts);
        count += Touching_AddPlane(&t, &crate, 2, &contacts[count]);
        REQUIRE_OK(kiriSheet_SetContacts(t.world, t.sheet, contacts, count));
        REQUIRE_OK(kiriWorld_Tick(t.world, (float)def.dt, def.substeps));
        const kiriContactForce* forces;
        REQUIRE_OK(kiriSheet_GetContactForces(t.world, t.sheet, &forces, &count));
        for (int k = 0; k < count; ++k) {
            crate.velocity[2] -= forces[k].obstacle == 2 ? forces[k].impulse[2] / crate.mass : 0.0;
        }
        crate.at[2] += def.dt * crate.velocity[2];
        fastest = fmax(fastest, crate.velocity[2]);
        deepest = fmax(deepest, -crate.at[2]);
        sheet = fmax(sheet, Touching_Totals(&t).momentum[2] / t.mass);
    }
    snprintf(variant, sizeof variant, "mass %g, %d frames", ratio, frames * frames);
    Contact_Limit("crate: speed up", variant, fastest, 0.2, "m/s");
    Contact_Limit("crate: deepest", variant, 1e3 * deepest, 1.0, "mm");
    Contact_Limit("crate: at rest", variant, fabs(crate.velocity[2]), 1e-3, "m/s");
    Contact_Limit("crate: sheet's speed up", variant, sheet, 0.2, "m/s");
}

static void MeasureMomentum(void)
{
    static const double ratios[] = { 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0 };
    for (int k = 0; k < 7; ++k) {
        for (int substeps = 1; substeps <= 8; substeps *= 8) {
            MeasureImpact(ratios[k], substeps, 5);
        }
    }
    for (int k = 0; k < 7; ++k) {
        MeasureCrate(ratios[k], 5);
    }
}

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/* Under a load of so many times the weight, spread over its frames. */
static void Load(const Touching* t, double load)
{
    kiriFrame frames[64];
    int32_t count;
    REQUIRE_OK(kiriSheet_GetFrames(t->world, t->sheet, frames, 64, &count));
    for (int32_t f = 0; f < count; ++f) {
        kiriFrameState state;
        REQUIRE_OK(kiriFrame_GetState(t->world, frames[f], &state));
        const float force[3] = { 0.0f, 0.0f, (float)(-load * state.mass * 9.81) }, none[3] = { 0.0f, 0.0f, 0.0f };
        REQUIRE_OK(kiriFrame_ApplyForce(t->world, frames[f], force, none));
    }
}

static void MeasureDepth(void)
{
    for (int k = 0; k < 8; ++k) {
        double load = k % 4 == 0 ? 0.0 : pow(10.0, k % 4);
        TouchingDef def = Touching_Def(k / 4 ? TOUCHING_CLOTH : TOUCHING_PLATE, 5);
        const double gravity[3] = { 0.0, 0.0, -9.81 };
        Plane floor = Touching_Floor(0.5);
        SCOPED(Touching, t, Touching_Stop);
        char variant[64];
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 120; ++tick) {
            Load(&t, load);
            Touching_Tick(&t, &floor);
        }
        snprintf(variant, sizeof variant, "%s, %g times its weight", k / 4 ? "cloth" : "plate", load);
        Contact_Limit("depth at rest", variant, 1e3 * t.deepest, 0.1, "mm");
        double law = (load + 1.0) * t.mass * 9.81 * def.dt;
        Contact_Line("force at rest", variant, t.impulse[2] / law, 1.0, 1e-3, "");
    }
}

/* At 100 m/s into a wall: the host gives it as a plane in the way of the points. */
static void MeasureSpeed(void)
{
    for (int k = 0; k < 4; ++k) {
        TouchingDef def = Touching_Def(k % 2 ? TOUCHING_CLOTH : TOUCHING_PLATE, 5);
        const double gravity[3] = { 0.0, 0.0, -9.81 };
        Plane wall = Touching_Floor(0.3);
        SCOPED(Touching, t, Touching_Stop);
        char variant[64];
        double deepest = 0.0, rebound = 0.0;
        def.speed[0] = k / 2 ? 70.0 : 0.0;
        def.speed[2] = -100.0;
        def.height = 2.0;
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 60; ++tick) {
            Touching_Tick(&t, &wall);
            deepest = fmax(deepest, t.deepest);
            rebound = fmax(rebound, Touching_Totals(&t).momentum[2] / t.mass);
        }
        snprintf(variant, sizeof variant, "%s%s", k % 2 ? "cloth" : "plate", k / 2 ? ", aslant" : "");
        Contact_Limit("100 m/s: deepest", variant, 1e3 * deepest, 10.0, "mm");
        Contact_Limit("100 m/s: speed up", variant, rebound, 1.0, "m/s");
    }
}

/* Starts below the floor. */
static void MeasurePush(void)
{
    static const double depths[] = { 0.01, 0.05, 0.2 };
    for (int k = 0; k < 6; ++k) {
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, 5);
        const double gravity[3] = { 0.0, 0.0, -9.81 };
        Plane floor = Touching_Floor(0.3);
        SCOPED(Touching, t, Touching_Stop);
        char variant[64];
        double fastest = 0.0;
        floor.pushSpeed = k / 3 ? 0.5 : 0.0;
        def.height = -depths[k % 3];
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 60; ++tick) {
            Touching_Tick(&t, &floor);
            fastest = fmax(fastest, Touching_Totals(&t).momentum[2] / t.mass);
        }
        snprintf(variant, sizeof variant, "%g mm deep, %g m/s", 1e3 * depths[k % 3], k / 3 ? 0.5 : 1.0);
        Contact_Limit("pushed out: fastest", variant, fastest, k / 3 ? 0.51 : 1.02, "m/s");
        Contact_Limit("pushed out: left", variant, 1e3 * t.deepest, 0.1, "mm");
    }
}

/* A lift that goes up at 1 m/s and stops. */
static void MeasureLift(void)
{
    TouchingDef def = Touching_Def(TOUCHING_PLATE, 5);
    const double gravity[3] = { 0.0, 0.0, -9.81 };
    Plane floor = Touching_Floor(0.3);
    SCOPED(Touching, t, Touching_Stop);
    double slip = 0.0;
    Touching_Start(&t, &def, gravity);
    for (int tick = 0; tick < 120; ++tick) {
        double pace = tick < 30 ? 0.0 : tick < 60 ? (tick - 29) / 30.0 : tick < 90 ? (89 - tick) / 30.0 : 0.0;
        floor.velocity[2] = 2.0 * pace;
        floor.velocity[0] = 0.5 * pace;
        Touching_Tick(&t, &floor);
        slip = tick > 30 ? fmax(slip, fabs(Touching_Totals(&t).center[2] - floor.at[2])) : slip;
    }
    kiriTotals now = Touching_Totals(&t);
    Contact_Limit("lift: lag", "plate", 1e3 * slip, 0.5, "mm");
    Contact_Line("lift: carried along", "plate", now.center[0] - 0.2, floor.at[0], 1e-3, "m");
}

/* ---- Sums -------------------------------------------------------------------------------------------------------- */

static double MomentAbout(const Touching* t, const double center[3])
{
    return t->moment[1] - center[2] * t->impulse[0] + center[0] * t->impulse[2];
}

/* A sheet slides and tumbles over the floor: the change of momentum, less that of gravity, is the sum of impulses; and
   so it turns. */
static void MeasureSums(void)
{
    for (int model = 0; model < 3; ++model) {
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, 3);
        double gravity[3], off = 0.0, turned = 0.0;
        Plane floor = Touching_Floor(0.4);
        SCOPED(Touching, t, Touching_Stop);
        char variant[64];
        def.model = model;
        def.height = 0.05;
        def.speed[0] = 2.0;
        Touching_Slope(0.2, gravity);
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 60; ++tick) {
            kiriTotals before = Touching_Totals(&t);
            Touching_Tick(&t, &floor);
            kiriTotals after = Touching_Totals(&t);
            for (int k = 0; k < 3; ++k) {
                double weight = t.mass * (double)(float)gravity[k] * (double)(float)def.dt;
                double change = after.momentum[k] - before.momentum[k] - weight;
                off = fmax(off, fabs(change - t.impulse[k]) / (t.mass * 9.81 * def.dt));
            }
            double spun = OwnTurning(&after) - OwnTurning(&before);
            double due = MomentAbout(&t, after.center);
            turned = fmax(turned, fabs(spun - due) / (t.mass * 9.81 * def.dt * def.size));
        }
        snprintf(variant, sizeof variant, "model %d", model);
        Contact_Limit("sum of impulses", variant, off, 1e-9, "weight");
        Contact_Limit("sum of their moments", variant, turned, 1e-2, "");
    }
}

void Contact_MeasureLaws(void)
{
    MeasureStopping();
    MeasureConveyor();
    MeasureLift();
    MeasureDepth();
    MeasureSpeed();
    MeasurePush();
    MeasureSums();
    MeasureMomentum();
    MeasureFrictionAngles();
}
