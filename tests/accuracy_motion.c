/* What moves: how much of a swing is left. How far presets are from much finer runs is in trade.c. */
#include "accuracy.h"
#include "results.h"
#include "specimen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const double G = 9.81;

/* J: of motion, bending and weight. */
static double Energy(const Specimen* specimen)
{
    kiriTotals t;
    kiriSheet_GetTotals(specimen->world, specimen->sheet, &t);
    return t.kineticEnergy + t.elasticEnergy + t.mass * G * t.center[2];
}

static void PinCorner(Specimen* specimen, double u, double v)
{
    kiriPinDef def;
    kiriPin pin;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = (float)u;
    def.restPoint[1] = (float)v;
    def.target[1] = (float)v;
    def.target[2] = -(float)u;
    Require(kiriCreatePin(specimen->world, specimen->sheet, &def, &pin) == KIRI_OK, "no pin");
}

/* Holds all frames of the sheet as it hangs from the line u = 0, turned by an angle about it. */
static void HoldHanging(Specimen* specimen, double angle)
{
    const float c = (float)cos(angle), s = (float)sin(angle);
    const float rotation[9] = { s, 0.0f, -c, 0.0f, 1.0f, 0.0f, c, 0.0f, s };
    for (int i = 0; i < specimen->count; ++i) {
        const float* r = specimen->states[i].restPoint;
        const float to[3] = { r[0] * s, r[1], -r[0] * c };
        Require(kiriFrame_Hold(specimen->world, specimen->ids[i], to, rotation) == KIRI_OK, "no hold");
    }
    Require(kiriWorld_Tick(specimen->world, 1.0f / 60.0f, 1) == KIRI_OK, "no tick");
}

/* It hangs down from two pinned corners and turns about them at 3 rad/s: two ticks in which all is held make that. */
static Specimen* MakePendulum(int frames, int timeStepping)
{
    const double gravity[3] = { 0.0, 0.0, -G };
    SpecimenDef def = Specimen_Strip(5e8, 0.3, 5e-4);
    def.material.airDamping = 0.0f;
    def.iterations = 1;
    def.timeStepping = timeStepping;
    Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, frames, 1);
    Specimen* specimen = Specimen_Create(&def);
    Require(specimen != NULL, "a pendulum is refused");
    HoldHanging(specimen, -3.0 / 60.0);
    HoldHanging(specimen, 0.0);
    for (int i = 0; i < specimen->count; ++i) {
        kiriFrame_Hold(specimen->world, specimen->ids[i], NULL, NULL);
    }
    PinCorner(specimen, 0.0, 0.0);
    PinCorner(specimen, 0.0, def.width);
    Specimen_SetGravity(specimen, gravity);
    return specimen;
}

static void AddSwing(int timeStepping, int frames, int substeps)
{
    SCOPED_SPECIMEN(specimen) = MakePendulum(frames, timeStepping);
    kiriTotals totals;
    kiriSheet_GetTotals(specimen->world, specimen->sheet, &totals);
    double first = Energy(specimen), given = totals.kineticEnergy, start = ProcessorTime(NULL);
    for (int tick = 0; tick < 600; ++tick) {
        Require(kiriWorld_Tick(specimen->world, 1.0f / 60.0f, substeps) == KIRI_OK, "no tick");
    }
    Row row = Row_Make("energy of a swing", "rows", frames, 80, 1e-3, 0.05);
    row.substeps = substeps;
    row.milliseconds = 1e3 * (ProcessorTime(NULL) - start) / 600;
    snprintf(row.setting, sizeof row.setting, "%s, after 10 s",
             timeStepping == KIRI_TIME_STEPPING_EULER ? "Euler" : "second order");
    Results_AddValue(row, (given + Energy(specimen) - first) / given, 1.0, "1");
}

static void Swing(const char* data)
{
    static const int frames[] = { 5, 9 }, substeps[] = { 1, 2, 4, 8, 64 };
    for (int k = 0; k < 2; ++k) {
        for (int f = 0; f < COUNT(frames); ++f) {
            for (int s = 0; s < COUNT(substeps); ++s) {
                AddSwing(k == 0 ? KIRI_TIME_STEPPING_SECOND_ORDER : KIRI_TIME_STEPPING_EULER, frames[f], substeps[s]);
            }
        }
    }
}

const Case motionCases[] = {
    { "energy of a swing", Swing },
    { NULL, NULL },
};
