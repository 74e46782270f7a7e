/* Strips that bend in one direction: theory and the heavy elastica. One row of frames unless said otherwise. */
#include "accuracy.h"
#include "reference.h"
#include "results.h"
#include "specimen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const double G = 9.81, PI = 3.14159265358979323846;

/* rho g h L^3 / D of a strip with nu = 0. */
static double Gamma(const SpecimenDef* def)
{
    double h = (double)def->material.thickness, E = (double)def->material.youngsModulus;
    return 12.0 * (double)def->material.density * G * def->length * def->length * def->length / (E * h * h);
}

/* rms distance of the frames from the elastica, by the rms way that they go. */
static double ElasticaError(const Specimen* specimen, const SpecimenDef* def)
{
    static Elastica elastica;
    static double solved;
    double error = 0.0, way = 0.0, gamma = Gamma(def);
    if (solved != gamma) {
        Elastica_Solve(&elastica, gamma);
        solved = gamma;
    }
    for (int i = 0; i < specimen->count; ++i) {
        const kiriFrameState* s = &specimen->states[i];
        double x, drop, u = (double)s->restPoint[0] / def->length;
        Elastica_At(&elastica, u, &x, &drop);
        double off[2] = { (double)s->position[0] - def->length * x, (double)s->position[2] + def->length * drop };
        error += off[0] * off[0] + off[1] * off[1];
        way += def->length * def->length * ((u - x) * (u - x) + drop * drop);
    }
    return sqrt(error / way);
}

/* Clamped along u = 0, under gravity. */
static Row Hang(const SpecimenDef* def, const char* name, const char* setting)
{
    Row row = Row_Make(name, "rows", def->layout.count, def->grid, 1e-4, 0.0);
    snprintf(row.setting, sizeof row.setting, "%s", setting);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(def);
    if (specimen == NULL) {
        row.error = NAN;
        return row;
    }
    Specimen_ClampEnd(specimen, def, 0.0);
    Specimen_Settle(specimen);
    row.error = ElasticaError(specimen, def);
    row.milliseconds = specimen->milliseconds;
    return row;
}

static SpecimenDef Hanging(double young, double thickness, int frames, int grid)
{
    SpecimenDef def = Specimen_Strip(young, 0.0, thickness);
    def.gravity[2] = -G;
    def.grid = grid;
    Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, frames, 1);
    return def;
}

/* Cantilevers of each number of frames on the first `grids` of the grids 40, 80, 160. */
static void HangAll(const char* name, int model, int grids, const int* frames, const double* targets, int count)
{
    for (int k = 0; k < grids * count; ++k) {
        SpecimenDef def = Hanging(5e8, 5e-4, frames[k % count], 40 << k / count);
        def.model = model;
        def.iterations = model == KIRI_MODEL_AFFINE ? 8 : def.iterations;
        Row row = Hang(&def, name, "nu 0");
        row.target = targets[k % count];
        Results_Add(&row);
    }
}

static void Cantilever(const char* data)
{
    static const int frames[] = { 3, 5, 9, 17, 33 };
    static const double targets[] = { 0.03, 0.01, 0.005, 0.0025, 0.0025 };
    HangAll("cantilever", KIRI_MODEL_LINKS, 3, frames, targets, COUNT(frames));
}

/* Clamped by holding the frames on the edge: a held frame clamps at its site, and its region moves with it. */
static void HeldFrames(const char* data)
{
    static const int frames[] = { 3, 5, 9, 17 };
    for (int ends = 0; ends < 2; ++ends) {
        for (int k = 0; k < COUNT(frames); ++k) {
            SpecimenDef def = Hanging(5e8, 5e-4, frames[k], 80);
            if (ends) {
                Layout_MakeToEnds(&def.layout, LAYOUT_ROWS, def.length, def.width, frames[k], 1);
            }
            SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
            Require(specimen != NULL, "a strip is refused");
            Row row = Row_Make("held frames", "rows", frames[k], def.grid, 1e-4, 0.0);
            snprintf(row.setting, sizeof row.setting, "nu 0, %s", ends ? "site on the edge" : "site in its region");
            Specimen_HoldLine(specimen, (double)def.layout.points[0]);
            Specimen_Settle(specimen);
            row.error = ElasticaError(specimen, &def);
            row.milliseconds = specimen->milliseconds;
            Results_Add(&row);
        }
    }
}

/* More frames than the grid can carry must not go wrong silently. */
static void Crowded(const char* data)
{
    static const int frames[] = { 17, 25, 29, 33, 37 };
    static const double targets[] = { 0.0025, 0.0025, 0.0025, 0.0025, 0.0025 };
    HangAll("crowded row", KIRI_MODEL_LINKS, 2, frames, targets, COUNT(frames));
}

static void Models(const char* data)
{
    static const int frames[] = { 5, 9, 17 };
    static const double targets[] = { 0.0, 0.01, 0.0 };
    HangAll("affine cantilever", KIRI_MODEL_AFFINE, 2, frames, targets, COUNT(frames));
}

/* The same curve whatever the thickness: Young's modulus goes with it. */
static SpecimenDef HangingThin(double thin, int frames)
{
    double h = thin * 0.2;
    return Hanging(12.0 * 1000.0 * G * 0.2 * 0.2 * 0.2 / (7.5 * h * h), h, frames, 80);
}

static void Thinness(const char* data)
{
    static const double thin[] = { 10.0, 50.0, 200.0, 400.0, 1000.0, 4000.0 };
    static const int frames[] = { 5, 9, 17 };
    for (int t = 0; t < COUNT(thin); ++t) {
        for (int k = 0; k < COUNT(frames); ++k) {
            char setting[SETTING_LENGTH];
            SpecimenDef def = HangingThin(1.0 / thin[t], frames[k]);
            snprintf(setting, sizeof setting, "h/L 1/%g", thin[t]);
            Row row = Hang(&def, "thin cantilever", setting);
            row.target = k == 1 ? 0.005 : 0.0;
            Results_Add(&row);
        }
    }
}

/* The paper's scheme. */
static void Points(const char* data)
{
    static const double thin[] = { 10.0, 20.0, 50.0, 100.0, 200.0, 400.0 };
    for (int t = 0; t < COUNT(thin); ++t) {
        char setting[SETTING_LENGTH];
        SpecimenDef def = HangingThin(1.0 / thin[t], 9);
        def.model = KIRI_MODEL_POINTS;
        def.iterations = 8;
        snprintf(setting, sizeof setting, "h/L 1/%g", thin[t]);
        Row row = Hang(&def, "points cantilever", setting);
        Results_Add(&row);
    }
}

/* ---- Heavy elastica --------------------------------------------------------------------------------------------- */

/* Of the middle of the edge u = length, as seen. */
static double TipMove(Specimen* specimen, const SpecimenDef* def, int axis)
{
    double at[3], rest[3] = { def->length, 0.5 * def->width, 0.0 };
    Specimen_At(specimen, rest[0], rest[1], at);
    return at[axis] - rest[axis];
}

static void AddTip(const SpecimenDef* def, const char* name, const char* setting, int axis, double theory,
                   double target)
{
    Row row = Row_Make(name, "rows", def->layout.count, def->grid, 1e-4, target);
    snprintf(row.setting, sizeof row.setting, "%s", setting);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(def);
    if (specimen == NULL) {
        return;
    }
    Specimen_ClampEnd(specimen, def, 0.0);
    Specimen_Settle(specimen);
    row.milliseconds = specimen->milliseconds;
    Results_AddValue(row, TipMove(specimen, def, axis), theory, "m");
}

/* The thickness makes gamma. */
static void MasterCurve(const char* data)
{
    static Elastica elastica;
    char path[512], line[256], setting[SETTING_LENGTH];
    snprintf(path, sizeof path, "%s/cantilever_master_curve.csv", data);
    FILE* file = fopen(path, "r");
    Require(file != NULL, "no cantilever_master_curve.csv");
    while (fgets(line, sizeof line, file) != NULL) {
        double gamma, x, drop;
        if (sscanf(line, "%lf,%lf,%lf", &gamma, &x, &drop) == 3) {
            Elastica_Solve(&elastica, gamma);
            Require(fabs(elastica.drop[ELASTICA_STEPS] - drop) < 1e-8 && fabs(elastica.x[ELASTICA_STEPS] - x) < 1e-8,
                    "the elastica is wrong");
            SpecimenDef def = Hanging(1e9, sqrt(12.0 * 1000.0 * G * 0.2 * 0.2 * 0.2 / (1e9 * gamma)), 17, 80);
            snprintf(setting, sizeof setting, "gamma %.3g", gamma);
            AddTip(&def, "heavy elastica", setting, 2, -0.2 * drop, gamma <= 100.0 ? 0.01 : 0.03);
        }
    }
    fclose(file);
}

/* ---- In the plane ----------------------------------------------------------------------------------------------- */

/* Thick, so that it does not buckle out of its plane. Timoshenko's beam. */
static void PlaneBending(const char* data)
{
    static const int rows[] = { 1, 2, 4 }, columns[] = { 9, 9, 17 };
    double E = 5e8, h = 5e-3, L = 0.2, W = 0.05, load = 1000.0 * h * W * G;
    double theory = load * L * L * L * L / (8.0 * E * h * W * W * W / 12.0);
    theory += load * L * L / (2.0 * 5.0 / 6.0 * E / 2.0 * h * W);
    for (int k = 0; k < COUNT(rows); ++k) {
        char setting[SETTING_LENGTH];
        SpecimenDef def = Specimen_Strip(E, 0.0, h);
        def.gravity[1] = -G;
        Layout_Make(&def.layout, LAYOUT_ROWS, L, W, columns[k], rows[k]);
        snprintf(setting, sizeof setting, "nu 0, %d row%s", rows[k], rows[k] > 1 ? "s" : "");
        AddTip(&def, "plane bending", setting, 1, -theory, 0.03);
    }
}

/* With nu above 0 the clamp keeps the end from narrowing, which the theory leaves out: about a percent. */
static void Tension(const char* data)
{
    static const int rows[] = { 1, 2, 4 }, columns[] = { 9, 9, 17 };
    for (int n = 0; n < 2; ++n) {
        for (int k = 0; k < COUNT(rows); ++k) {
            char setting[SETTING_LENGTH];
            SpecimenDef def = Specimen_Strip(1e6, n == 0 ? 0.0 : 0.3, 5e-4);
            def.gravity[0] = G;
            def.planar = 1;
            Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, columns[k], rows[k]);
            snprintf(setting, sizeof setting, "nu %g, %d row%s", n == 0 ? 0.0 : 0.3, rows[k], rows[k] > 1 ? "s" : "");
            AddTip(&def, "tension", setting, 0, 1000.0 * G * 0.2 * 0.2 / (2.0 * 1e6), n == 0 ? 0.005 : 0.02);
        }
    }
}

/* ---- End loads -------------------------------------------------------------------------------------------------- */

/* The strip of Sze, Liu, Lo, Popular benchmark problems for geometric nonlinear analysis of shells, 2004. The moves are
   those of the elastica (Mattiasson, Numerical results from large deflection beam and frame problems analysed by means
   of elliptic integrals, 1981); shells have 1.604, 4.933 and 3.286, 6.698. */

static SpecimenDef SzeStrip(double length, int frames, int grid)
{
    SpecimenDef def = Specimen_Strip(1.2e6, 0.0, 0.1);
    def.length = length;
    def.width = 1.0;
    def.grid = grid;
    def.columns = 80;
    def.material.density = 1.0f;
    def.material.airDamping = 4.0f;
    Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, frames, 1);
    return def;
}

static void AddEndLoad(double P, const double moves[2], int frames, int grid)
{
    SpecimenDef def = SzeStrip(10.0, frames, grid);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    double tip[3];
    Row row = Row_Make("end load", "rows", frames, grid, 2e-4, 0.005);
    Specimen_ClampEnd(specimen, &def, 0.0);
    specimen->load = (Load){ { 10.0f, 0.5f }, { 10.0f, 0.5f }, { 0.0f, 0.0f, (float)P }, { 0.0f } };
    specimen->loaded = true;
    Specimen_Settle(specimen);
    Specimen_At(specimen, 10.0, 0.5, tip);
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "P %g, deflection", P);
    Results_AddValue(row, tip[2], moves[1], "m");
    snprintf(row.setting, sizeof row.setting, "P %g, shortening", P);
    Results_AddValue(row, 10.0 - tip[0], moves[0], "m");
}

static void EndLoad(const char* data)
{
    static const int frames[] = { 5, 9, 17, 33 }, grids[] = { 40, 80, 160 };
    static const double loads[] = { 2.0, 4.0 }, moves[][2] = { { 1.6064, 4.9346 }, { 3.2894, 6.6996 } };
    for (int p = 0; p < 2; ++p) {
        for (int g = 0; g < COUNT(grids); ++g) {
            for (int k = 0; k < COUNT(frames); ++k) {
                AddEndLoad(loads[p], moves[p], frames[k], grids[g]);
            }
        }
    }
}

/* A moment M at the end makes it an arc that turns by M L / (E I) about -v. */
static void AddRollUp(int halfTurns, int frames, int grid)
{
    SpecimenDef def = SzeStrip(12.0, frames, grid);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    double turn = PI * halfTurns, tip[3], way[2] = { sin(turn) / turn - 1.0, (1.0 - cos(turn)) / turn };
    Row row = Row_Make("roll-up", "rows", frames, grid, 2e-4, 0.02);
    Specimen_ClampEnd(specimen, &def, 0.0);
    specimen->loaded = true;
    specimen->load = (Load){ { 12.0f, 0.5f }, { 12.0f, 0.5f }, { 0.0f }, { 0.0f } };
    for (int part = 1; part <= 8; ++part) { /* the moment grows, or it coils the other way */
        specimen->load.torque[1] = (float)(-turn * part / 8.0 * 1.2e6 * 1e-3 / 12.0 / 12.0);
        Specimen_Settle(specimen);
    }
    Specimen_At(specimen, 12.0, 0.5, tip);
    double off[2] = { tip[0] / 12.0 - 1.0 - way[0], tip[2] / 12.0 - way[1] };
    row.error = sqrt((off[0] * off[0] + off[1] * off[1]) / (way[0] * way[0] + way[1] * way[1]));
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "nu 0, turn %d pi", halfTurns);
    Results_Add(&row);
}

static void RollUp(const char* data)
{
    static const int frames[] = { 9, 17, 33 }, grids[] = { 40, 80, 160 };
    for (int half = 1; half <= 2; ++half) {
        for (int g = 0; g < COUNT(grids); ++g) {
            for (int k = 0; k < COUNT(frames); ++k) {
                AddRollUp(half, frames[k], grids[g]);
            }
        }
    }
}

/* ---- Vibration -------------------------------------------------------------------------------------------------- */

void Accuracy_FirstShape(const void* data, double u, double v, double w[3])
{
    double L = *(const double*)data, k = 1.8751040687 / L, x = k * u;
    double s = (cosh(1.8751040687) + cos(1.8751040687)) / (sinh(1.8751040687) + sin(1.8751040687));
    w[0] = cosh(x) - cos(x) - s * (sinh(x) - sin(x));
    w[1] = k * (sinh(x) + sin(x) - s * (cosh(x) - cos(x)));
    w[2] = 0.0;
}

static void FirstFrequency(const char* data)
{
    static const int frames[] = { 5, 9, 17 }, grids[] = { 40, 80, 160 };
    for (int g = 0; g < COUNT(grids); ++g) {
        for (int k = 0; k < COUNT(frames); ++k) {
            double E = 5e8, h = 5e-4, L = 0.2;
            double theory = 1.8751041 * 1.8751041 * sqrt(E * h * h / (12.0 * 1000.0 * L * L * L * L));
            SpecimenDef def = Specimen_Strip(E, 0.0, h);
            def.grid = grids[g];
            def.material.airDamping = 0.0f;
            Layout_Make(&def.layout, LAYOUT_ROWS, L, def.width, frames[k], 1);
            SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
            if (specimen == NULL) {
                continue;
            }
            Specimen_ClampEnd(specimen, &def, 0.0);
            double found = Specimen_Frequency(specimen, Accuracy_FirstShape, &L, 1e-3, theory);
            Row row = Row_Make("first frequency", "rows", frames[k], grids[g], 1e-3, 0.02);
            snprintf(row.setting, sizeof row.setting, "%s", "nu 0");
            row.milliseconds = specimen->milliseconds;
            Results_AddValue(row, found / (2.0 * PI), theory / (2.0 * PI), "Hz");
        }
    }
}

const Case beamCases[] = {
    { "cantilever", Cantilever },
    { "held frames", HeldFrames },
    { "crowded row", Crowded },
    { "heavy elastica", MasterCurve },
    { "thin cantilever", Thinness },
    { "affine cantilever", Models },
    { "points cantilever", Points },
    { "plane bending", PlaneBending },
    { "tension", Tension },
    { "end load", EndLoad },
    { "roll-up", RollUp },
    { "first frequency", FirstFrequency },
    { NULL, NULL },
};
