/* Contacts that the host gives, through the public header: laws of friction and of impacts, impulses, sleep. `make
   contact` measures more of the same. */
#include "support.h"
#include "touching.h"

#include <stdbool.h>

static const double down[3] = { 0.0, 0.0, -9.81 }, none[3] = { 0.0, 0.0, 0.0 };

static void AssertWithin(double value, double expected, double tolerance, const char* what)
{
    if (!(fabs(value - expected) <= tolerance)) {
        fail_msg("%s: %.9g, not %.9g +- %.2g", what, value, expected, tolerance);
    }
}

static double MeanSpeed(const Touching* t, int axis)
{
    return Touching_Totals(t).momentum[axis] / t->mass;
}

/* ---- Friction ---------------------------------------------------------------------------------------------------- */

/* A degree below the angle of friction it stands still, to the last micrometre, and falls asleep. A degree above it
   slides as a block does. */
TEST(FrictionAngle)
{
    static const double frictions[] = { 0.2, 0.5, 1.0 };
    for (int k = 0; k < 12; ++k) {
        double friction = frictions[k % 3], degree = 0.017453292519943295, gravity[3], from = 0.0;
        TouchingDef def = Touching_Def(k / 6, k / 3 % 2 ? 5 : 1);
        Plane floor = Touching_Floor(friction);
        SCOPED(Touching, t, Touching_Stop);
        Touching_Slope(atan(friction) - degree, gravity);
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 120; ++tick) {
            from = tick == 60 ? Touching_Totals(&t).center[0] : from;
            Touching_Tick(&t, &floor);
        }
        kiriCounts counts;
        assert_int_equal(kiriSheet_GetCounts(t.world, t.sheet, &counts), KIRI_OK);
        AssertWithin(Touching_Totals(&t).center[0], from, 1e-6, "creep");
        AssertWithin(MeanSpeed(&t, 0), 0.0, 0.0, "sleep");
        Touching_Stop(&t);

        double steep = atan(friction) + 2.0 * degree, pull = 9.81 * (sin(steep) - friction * cos(steep));
        Touching_Slope(steep, gravity);
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 120; ++tick) {
            from = tick == 60 ? MeanSpeed(&t, 0) : from; /* it has come down */
            Touching_Tick(&t, &floor);
        }
        AssertWithin(MeanSpeed(&t, 0) - from, pull, 0.01 * friction * 9.81, "gain of speed in a second");
    }
}

TEST(Stopping)
{
    for (int k = 0; k < 4; ++k) {
        TouchingDef def = Touching_Def(k % 2, 5);
        Plane floor = Touching_Floor(0.4);
        SCOPED(Touching, t, Touching_Stop);
        def.speed[0] = 2.0;
        def.substeps = k / 2 ? 4 : 1;
        def.model = k == 3 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS;
        Touching_Start(&t, &def, down);
        Touching_Ticks(&t, &floor, 60);
        double law = 4.0 / (2.0 * 0.4 * 9.81);
        AssertWithin(Touching_Totals(&t).center[0] - 0.2, law, 0.05 * law, "stopping distance");
    }
}

/* The floor of a conveyor moves on, and where it is does not change. */
TEST(Conveyor)
{
    TouchingDef def = Touching_Def(TOUCHING_CLOTH, 5);
    Plane belt = Touching_Floor(0.3);
    SCOPED(Touching, t, Touching_Stop);
    belt.velocity[0] = 1.0;
    Touching_Start(&t, &def, down);
    for (int tick = 0; tick < 60; ++tick) {
        Touching_Tick(&t, &belt);
        if (tick == 11) {
            AssertWithin(MeanSpeed(&t, 0), 0.2 * 0.3 * 9.81, 0.08, "speed after 0.2 s");
        }
    }
    AssertWithin(MeanSpeed(&t, 0), 1.0, 1e-3, "speed of the belt");
    AssertWithin(t.impulse[0], 0.0, 1e-3 * t.mass * 9.81 * def.dt, "no force at its speed");
}

/* A lift carries the sheet up and along, and slows down no faster than it falls. */
TEST(Lift)
{
    TouchingDef def = Touching_Def(TOUCHING_PLATE, 3);
    Plane floor = Touching_Floor(0.3);
    SCOPED(Touching, t, Touching_Stop);
    Touching_Start(&t, &def, down);
    for (int tick = 0; tick < 90; ++tick) {
        double pace = tick < 20 ? 0.0 : tick < 50 ? (tick - 19) / 30.0 : tick < 80 ? (79 - tick) / 30.0 : 0.0;
        floor.velocity[2] = 2.0 * pace;
        floor.velocity[0] = 0.5 * pace;
        Touching_Tick(&t, &floor);
        if (tick > 20) {
            AssertWithin(Touching_Totals(&t).center[2], floor.at[2], 2e-5, "height over the lift");
        }
    }
    AssertWithin(Touching_Totals(&t).center[0] - 0.2, floor.at[0], 1e-3, "carried along");
}

/* ---- Impulses ---------------------------------------------------------------------------------------------------- */

/* A sheet that drops, slides and turns: impulses are its change of momentum but for gravity, to rounding, and it turns
   by their moments. */
TEST(SumsOfImpulses)
{
    for (int k = 0; k < 6; ++k) {
        double gravity[3];
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, 3);
        Plane floor = Touching_Floor(0.4);
        SCOPED(Touching, t, Touching_Stop);
        def.model = k % 3;
        def.substeps = k / 3 ? 4 : 1;
        def.height = 0.03;
        def.speed[0] = 2.0;
        Touching_Slope(0.2, gravity);
        Touching_Start(&t, &def, gravity);
        for (int tick = 0; tick < 40; ++tick) {
            kiriTotals before = Touching_Totals(&t);
            Touching_Tick(&t, &floor);
            kiriTotals after = Touching_Totals(&t);
            double dt = (double)(float)def.dt, unit = t.mass * 9.81 * dt;
            for (int a = 0; a < 3; ++a) {
                double change = after.momentum[a] - before.momentum[a] - t.mass * (double)(float)gravity[a] * dt;
                AssertWithin(t.impulse[a], change, 1e-11 * unit, "sum of impulses");
            }
            double moment = t.moment[1] - after.center[2] * t.impulse[0] + after.center[0] * t.impulse[2];
            if (def.substeps == 1) {
                AssertWithin(OwnTurning(&after) - OwnTurning(&before), moment, 1e-7 * unit, "sum of moments");
            }
        }
    }
}

/* Where it lies at rest, and where a hand lets it down on the floor: floor and hand bear the weight together. */
TEST(RestAndHolds)
{
    for (int held = 0; held < 2; ++held) {
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, 3);
        Plane floor = Touching_Floor(0.5);
        SCOPED(Touching, t, Touching_Stop);
        kiriFrame frames[16];
        int32_t count;
        double force[3] = { 0.0, 0.0, 0.0 }, torque[3];
        Touching_Start(&t, &def, down);
        assert_int_equal(kiriSheet_GetFrames(t.world, t.sheet, frames, 16, &count), KIRI_OK);
        kiriFrameState at;
        assert_int_equal(kiriFrame_GetState(t.world, frames[0], &at), KIRI_OK);
        at.position[2] = 0.1f;
        for (int tick = 0; tick < 240; ++tick) {
            if (held) {
                assert_int_equal(kiriFrame_Hold(t.world, frames[0], at.position, at.rotation), KIRI_OK);
            }
            Touching_Tick(&t, &floor);
        }
        if (held) {
            assert_int_equal(kiriFrame_GetReaction(t.world, frames[0], force, torque), KIRI_OK);
            assert_true(force[2] > 0.05 * t.mass * 9.81);
        }
        assert_true(t.deepest < 1e-5 && t.impulse[2] > 0.2 * t.mass * 9.81 * def.dt);
        AssertWithin(t.impulse[2] / def.dt + force[2], t.mass * 9.81, 1e-2 * t.mass * 9.81, "weight");
    }
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

/* A sheet meets a free body: they go on together, momentum stays to rounding, and energy never grows. */
TEST(MassRatios)
{
    for (int k = 0; k < 14; ++k) {
        double ratio = pow(10.0, k % 7 - 3);
        TouchingDef def = Touching_Def(TOUCHING_PLATE, 3);
        SCOPED(Touching, t, Touching_Stop);
        def.substeps = k / 7 ? 8 : 1;
        def.height = 0.1;
        def.speed[2] = -3.0;
        Touching_Start(&t, &def, none);
        Plane body = Touching_Floor(0.3);
        body.mass = ratio * t.mass;
        double had = 4.5 * t.mass, together = -3.0 / (1.0 + ratio);
        for (int tick = 0; tick < 15; ++tick) {
            Touching_Tick(&t, &body);
            kiriTotals now = Touching_Totals(&t);
            double has = now.kineticEnergy + now.elasticEnergy + 0.5 * body.mass * body.velocity[2] * body.velocity[2];
            AssertWithin(now.momentum[2] + body.mass * body.velocity[2], -3.0 * t.mass, 1e-9 * t.mass, "momentum");
            assert_true(has <= had + 1e-9 * t.mass);
            had = has;
        }
        AssertWithin(MeanSpeed(&t, 2), together, 0.1, "speed of the sheet");
        AssertWithin(body.velocity[2], together, 0.1, "speed of the body");
    }
}

/* A crate drops on a sheet that lies on the floor. Neither is thrown up, the crate does not come through, and it
   rests. */
TEST(Crates)
{
    static kiriContact contacts[2 * TOUCHING_MOST_POINTS];
    for (int k = 0; k < 7; ++k) {
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, 3);
        Plane floor = Touching_Floor(0.5), crate = { { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 0.2 }, { 0.0 }, 0.5, 0.0, 0.0 };
        SCOPED(Touching, t, Touching_Stop);
        Touching_Start(&t, &def, down);
        crate.mass = t.mass * pow(10.0, k - 3);
        for (int tick = 0; tick < 90; ++tick) {
            crate.velocity[2] -= 9.81 * def.dt;
            int32_t count = Touching_AddPlane(&t, &floor, 1, contacts);
            count += Touching_AddPlane(&t, &crate, 2, &contacts[count]);
            assert_int_equal(kiriSheet_SetContacts(t.world, t.sheet, contacts, count), KIRI_OK);
            assert_int_equal(kiriWorld_Tick(t.world, (float)def.dt, 1), KIRI_OK);
            const kiriContactForce* forces;
            assert_int_equal(kiriSheet_GetContactForces(t.world, t.sheet, &forces, &count), KIRI_OK);
            for (int32_t n = 0; n < count; ++n) {
                crate.velocity[2] -= forces[n].obstacle == 2 ? forces[n].impulse[2] / crate.mass : 0.0;
            }
            crate.at[2] += def.dt * crate.velocity[2];
            assert_true(crate.velocity[2] < 0.05 && MeanSpeed(&t, 2) < 0.05 && crate.at[2] > -1e-3);
        }
        AssertWithin(crate.velocity[2], 0.0, 1e-3, "crate at rest");
    }
}

/* ---- Depth and speed --------------------------------------------------------------------------------------------- */

TEST(Loads)
{
    for (int k = 0; k < 8; ++k) {
        double load = pow(10.0, k % 4);
        TouchingDef def = Touching_Def(k / 4, 5);
        const double gravity[3] = { 0.0, 0.0, -9.81 * load };
        Plane floor = Touching_Floor(0.5);
        SCOPED(Touching, t, Touching_Stop);
        Touching_Start(&t, &def, gravity);
        Touching_Ticks(&t, &floor, 90);
        assert_true(t.deepest < 1e-4);
        AssertWithin(t.impulse[2], load * t.mass * 9.81 * def.dt, 1e-3 * load * t.mass * 9.81 * def.dt, "weight");
    }
}

/* At 100 m/s in the way of a wall 1 cm thick, by any step. */
TEST(Fast)
{
    for (int k = 0; k < 12; ++k) {
        TouchingDef def = Touching_Def(k % 2, k / 2 % 2 ? 5 : 1);
        Plane wall = Touching_Floor(0.3);
        SCOPED(Touching, t, Touching_Stop);
        def.dt = k / 4 == 0 ? 1.0 / 30.0 : k / 4 == 1 ? 1.0 / 60.0 : 1.0 / 240.0;
        def.speed[2] = -100.0;
        def.height = 2.0;
        Touching_Start(&t, &def, down);
        for (int tick = 0; tick * def.dt < 0.5; ++tick) {
            Touching_Tick(&t, &wall);
            assert_true(t.deepest < 0.01);
            assert_true(MeanSpeed(&t, 2) < 0.5);
        }
        AssertWithin(Touching_Totals(&t).center[2], 0.0, 2e-3, "height");
    }
}

TEST(PushSpeed)
{
    static const double speeds[] = { 0.0, 0.25, 2.0 };
    for (int k = 0; k < 3; ++k) {
        double fastest = 0.0, speed = speeds[k] > 0.0 ? speeds[k] : 1.0;
        TouchingDef def = Touching_Def(TOUCHING_CLOTH, 3);
        Plane floor = Touching_Floor(0.3);
        SCOPED(Touching, t, Touching_Stop);
        floor.pushSpeed = speeds[k];
        def.height = -0.1;
        Touching_Start(&t, &def, down);
        for (int tick = 0; tick < 90; ++tick) {
            Touching_Tick(&t, &floor);
            fastest = fmax(fastest, MeanSpeed(&t, 2));
        }
        AssertWithin(fastest, speed, 0.02 * speed, "speed out of the floor");
        assert_true(t.deepest < 1e-5);
    }
}

/* ---- Contacts and their ticks ------------------------------------------------------------------------------------ */

/* Four places that are no collision points. */
static int32_t Corners(kiriContact contacts[4], const float velocity[3])
{
    static const float places[4][2] = { { 0.01f, 0.02f }, { 0.39f, 0.01f }, { 0.38f, 0.39f }, { 0.02f, 0.37f } };
    for (int k = 0; k < 4; ++k) {
        kiriContact contact = { .point = -1, .normal = { 0.0f, 0.0f, 1.0f }, .friction = 0.5f, .obstacle = k };
        memcpy(contact.restPoint, places[k], sizeof(contact.restPoint));
        memcpy(contact.velocity, velocity, sizeof(contact.velocity));
        contacts[k] = contact;
    }
    return 4;
}

TEST(RestPoints)
{
    static const float still[3] = { 0.0f, 0.0f, 0.0f };
    TouchingDef def = Touching_Def(TOUCHING_PLATE, 3);
    kiriContact contacts[4];
    const kiriContactForce* forces;
    int32_t count;
    SCOPED(Touching, t, Touching_Stop);
    def.points = 0;
    Touching_Start(&t, &def, down);
    for (int tick = 0; tick < 60; ++tick) {
        assert_int_equal(kiriSheet_SetContacts(t.world, t.sheet, contacts, Corners(contacts, still)), KIRI_OK);
        assert_int_equal(kiriWorld_Tick(t.world, 1.0f / 60.0f, 1), KIRI_OK);
    }
    assert_int_equal(kiriSheet_GetContactForces(t.world, t.sheet, &forces, &count), KIRI_OK);
    assert_int_equal(count, 4);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        assert_int_equal(forces[k].point, -1);
        assert_int_equal(forces[k].obstacle, k);
        assert_true(forces[k].impulse[2] > 0.0 && fabs(forces[k].depth) < 1e-5);
        AssertWithin(forces[k].position[0], (double)contacts[k].restPoint[0], 1e-3, "position");
        sum += forces[k].impulse[2];
    }
    AssertWithin(sum, t.mass * 9.81 / 60.0, 1e-3 * t.mass, "weight");
    /* Cut off: the pieces have what lies in them. */
    kiriCut cut;
    assert_int_equal(kiriSheet_Cut(t.world, t.sheet, (const float[]){ 0.2f, -0.1f, 0.2f, 0.5f }, 2, &cut), KIRI_OK);
    for (int tick = 0; tick < 3; ++tick) {
        assert_int_equal(kiriSheet_SetContacts(t.world, t.sheet, contacts, Corners(contacts, still)), KIRI_OK);
        assert_true(kiriWorld_Tick(t.world, 1.0f / 60.0f, 1) >= 0);
    }
    contacts[0].restPoint[0] = 0.5f;
    assert_int_equal(kiriSheet_SetContacts(t.world, t.sheet, contacts, 4), KIRI_ERROR_ARGUMENT);
}

static bool Sleeps(const Touching* t)
{
    kiriProfile profile;
    assert_int_equal(kiriWorld_GetProfile(t->world, &profile), KIRI_OK);
    return profile.solverIterations == 0;
}

static void LieDown(Touching* t, Plane* floor)
{
    TouchingDef def = Touching_Def(TOUCHING_CLOTH, 3);
    Touching_Start(t, &def, down);
    Touching_Ticks(t, floor, 120);
    assert_true(Sleeps(t));
}

/* A sheet that sleeps goes on to press. What moves below it, or goes, wakes it. */
TEST(Sleep)
{
    for (int k = 0; k < 4; ++k) {
        Plane floor = Touching_Floor(0.5);
        SCOPED(Touching, t, Touching_Stop);
        LieDown(&t, &floor);
        AssertWithin(t.impulse[2], t.mass * 9.81 * t.def.dt, 1e-3 * t.mass * 9.81 * t.def.dt, "weight asleep");
        if (k == 0) {
            floor.velocity[0] = 0.2;
        } else if (k == 1) {
            floor.at[2] = 0.02;
        } else if (k == 2) {
            floor.at[2] = -1.0;
        }
        Touching_Tick(&t, &floor);
        assert_int_equal(Sleeps(&t), k == 3);
        Touching_Ticks(&t, &floor, 10);
        assert_true(k != 0 || MeanSpeed(&t, 0) > 0.1);
        assert_true(k != 2 || MeanSpeed(&t, 2) < -0.5);
    }
}

/* Nothing of contact is left where there is none: forces are of the last tick. */
TEST(ForcesAreOfTheLastTick)
{
    Plane floor = Touching_Floor(0.5);
    SCOPED(Touching, t, Touching_Stop);
    const kiriContactForce* forces;
    int32_t count;
    LieDown(&t, &floor);
    assert_int_equal(kiriSheet_GetContactForces(t.world, t.sheet, &forces, &count), KIRI_OK);
    assert_true(count > 40);
    assert_int_equal(kiriWorld_Tick(t.world, 1.0f / 60.0f, 1), KIRI_OK);
    assert_int_equal(kiriSheet_GetContactForces(t.world, t.sheet, &forces, &count), KIRI_OK);
    assert_int_equal(count, 0);
    assert_int_equal(kiriSheet_GetContactForces(t.world, t.sheet, NULL, &count), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_GetContactForces(t.world, 0, &forces, &count), KIRI_ERROR_ID);
}

/* A planar sheet that stands on a floor in its plane. */
TEST(Planar)
{
    for (int model = 0; model < 2; ++model) {
        TouchingDef def = Touching_Def(TOUCHING_PLATE, 3);
        const double along[3] = { 0.0, -9.81, 0.0 };
        Plane floor = { { 0.0, 1.0, 0.0 }, { 0.0, -0.02, 0.0 }, { 0.0 }, 0.5, 0.0, 0.0 };
        SCOPED(Touching, t, Touching_Stop);
        def.planar = 1;
        def.model = model;
        def.points = 400;
        def.speed[0] = 1.0;
        Touching_Start(&t, &def, along);
        Touching_Ticks(&t, &floor, 90);
        assert_true(t.deepest < 1e-4);
        AssertWithin(t.impulse[1], t.mass * 9.81 * def.dt, 1e-2 * t.mass * 9.81 * def.dt, "weight");
        AssertWithin(MeanSpeed(&t, 0), 0.0, 1e-3, "it stopped");
    }
}
