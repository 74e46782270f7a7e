/* Plates: what bends, twists and stretches in two directions. */
#include "accuracy.h"
#include "results.h"
#include "specimen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const double PI = 3.14159265358979323846;
static const double POISSON[] = { 0.0, 0.3 };
static const int GRIDS[] = { 40, 80, 160 };

/* D / h */
static double Rigidity(const kiriMaterial* m)
{
    double nu = (double)m->poissonsRatio, h = (double)m->thickness;
    return (double)m->youngsModulus * h * h / (12.0 * (1.0 - nu * nu));
}

/* ---- Vibration of cantilever plates ----------------------------------------------------------------------------- */

/* omega L^2 sqrt(rho h / D): a Ritz solution of Kirchhoff's plate with 12 x 12 Legendre polynomials times u^2, which
   gives 3.471 and 8.507 for the square with nu = 0.3 (Leissa 1973 has 3.492 and 8.525, bounds from above). */
typedef struct PlateMode {
    double width, poisson; /* width by length */
    double bending, torsion;
} PlateMode;

static const PlateMode plateModes[] = {
    { 0.25, 0.0, 3.51602, 32.4802 },
    { 0.25, 0.3, 3.40683, 27.5180 },
    { 1.0, 0.0, 3.51602, 9.67574 },
    { 1.0, 0.3, 3.47114, 8.50706 },
};

/* data: length and width. Level at the clamp, as the mode is within about a width of it. */
static void TwistShape(const void* data, double u, double v, double w[3])
{
    const double* size = data;
    double k = 0.5 * PI / size[0], arm = v - 0.5 * size[1], layer = 0.3 * size[1];
    double root = sqrt(u * u + layer * layer), x = k * (root - layer);
    w[0] = sin(x) * arm;
    w[1] = k * u / root * cos(x) * arm;
    w[2] = sin(x);
}

/* Omega of a narrow strip by Saint-Venant: G J = 2 (1 - nu) D W, and no bending where it is clamped. */
static double SaintVenant(const PlateMode* mode)
{
    return 0.5 * PI * sqrt(24.0 * (1.0 - mode->poisson)) / mode->width;
}

/* Its length is 0.2 m. One row of frames is rigid across, and is to twist as a narrow strip does. */
static void AddMode(const char* name, const PlateMode* mode, bool twist, int kind, int columns, int rows, int grid)
{
    SpecimenDef def = Specimen_Strip(5e8, mode->poisson, 5e-4);
    def.width = mode->width * def.length;
    def.grid = grid;
    def.iterations = 1;
    def.material.airDamping = 0.0f;
    Layout_Make(&def.layout, kind, def.length, def.width, columns, rows);
    double size[2] = { def.length, def.width };
    double torsion = rows > 1 ? mode->torsion : SaintVenant(mode);
    double theory = (twist ? torsion : mode->bending) / (def.length * def.length);
    theory *= sqrt(Rigidity(&def.material) / 1000.0);
    double amplitude = 0.1 * 5e-4 / (twist ? 0.5 * def.width : 2.0); /* a tenth of the thickness: it stays linear */
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    Specimen_ClampEnd(specimen, &def, 0.0);
    double found = Specimen_Frequency(specimen, twist ? TwistShape : Accuracy_FirstShape, size, amplitude, theory);
    Row row = Row_Make(name, layoutNames[kind], specimen->count, grid, 2e-3, 0.05);
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "W/L %g, nu %g, %d row%s", mode->width, mode->poisson, rows,
             rows > 1 ? "s" : "");
    Results_AddValue(row, found / (2.0 * PI), theory / (2.0 * PI), "Hz");
}

static void Torsion(const char* data)
{
    static const int rows[] = { 1, 2, 4 }, columns[] = { 9, 9, 17 };
    for (int m = 0; m < 2; ++m) {
        for (int k = 0; k < COUNT(rows); ++k) {
            for (int g = 0; g < COUNT(GRIDS); ++g) {
                for (int kind = 0; kind < LAYOUT_KINDS; ++kind) {
                    if (rows[k] > 1 || kind == LAYOUT_ROWS) {
                        AddMode("torsion", &plateModes[m], true, kind, columns[k], rows[k], GRIDS[g]);
                    }
                }
            }
        }
    }
}

static void PlateFrequencies(const char* data)
{
    static const int frames[] = { 3, 5, 9 };
    for (int m = 2; m < 4; ++m) {
        for (int twist = 0; twist < 2; ++twist) {
            for (int k = 0; k < COUNT(frames); ++k) {
                for (int kind = 0; kind < LAYOUT_KINDS; kind += LAYOUT_LLOYD) {
                    AddMode(twist ? "plate, twist" : "plate, bending", &plateModes[m], twist, kind, frames[k],
                            frames[k], 80);
                }
            }
        }
    }
}

/* ---- A free plate ----------------------------------------------------------------------------------------------- */

/* omega L^2 sqrt(rho h / D) of a free square, from the same Ritz solution without the clamp; with nu = 0 saddle and
   ring have the same. The shapes are polynomials near the modes, each of its own symmetry. */
typedef struct FreeMode {
    const char* name;
    ShapeFunction* shape;
    double value[2]; /* nu 0 and 0.3 */
} FreeMode;

static void Twisted(const void* data, double u, double v, double w[3])
{
    double half = 0.5 * *(const double*)data, x = u - half, y = v - half;
    w[0] = x * y;
    w[1] = y;
    w[2] = x;
}

static void Saddle(const void* data, double u, double v, double w[3])
{
    double half = 0.5 * *(const double*)data, x = u - half, y = v - half;
    w[0] = x * x - y * y;
    w[1] = 2.0 * x;
    w[2] = -2.0 * y;
}

static void Ring(const void* data, double u, double v, double w[3])
{
    double half = 0.5 * *(const double*)data, x = u - half, y = v - half;
    w[0] = x * x + y * y - 2.0 / 3.0 * half * half;
    w[1] = 2.0 * x;
    w[2] = 2.0 * y;
}

static const FreeMode freeModes[] = {
    { "twist", Twisted, { 15.8226, 13.4682 } },
    { "saddle", Saddle, { 22.3733, 19.5961 } },
    { "ring", Ring, { 22.3733, 24.2702 } },
};

static void AddFreeMode(const FreeMode* mode, int n, int along, int kind)
{
    SpecimenDef def = Specimen_Strip(5e8, POISSON[n], 5e-4);
    def.length = def.width = 0.1;
    def.iterations = 1;
    def.material.airDamping = 0.0f;
    Layout_MakeFramed(&def.layout, kind, def.length, def.width, along, along);
    double theory = mode->value[n] / 0.01 * sqrt(Rigidity(&def.material) / 1000.0);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    double found = Specimen_Frequency(specimen, mode->shape, &def.length, 0.02, theory);
    Row row = Row_Make("free plate", layoutNames[kind], specimen->count, def.grid, 2e-3, 0.03);
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "nu %g, %s", POISSON[n], mode->name);
    Results_AddValue(row, found / (2.0 * PI), theory / (2.0 * PI), "Hz");
}

static void FreePlate(const char* data)
{
    static const int along[] = { 5, 7, 10 };
    for (int n = 0; n < COUNT(POISSON); ++n) {
        for (int m = 0; m < COUNT(freeModes); ++m) {
            for (int k = 0; k < COUNT(along); ++k) {
                AddFreeMode(&freeModes[m], n, along[k], LAYOUT_ROWS);
                AddFreeMode(&freeModes[m], n, along[k], LAYOUT_LLOYD);
            }
        }
    }
}

/* ---- Lateral buckling ------------------------------------------------------------------------------------------- */

typedef struct BucklingSetup {
    double poisson, width; /* width by length */
    double load;           /* critical Gamma = 12 (1 - nu^2) rho g L^3 / (E h^2) */
} BucklingSetup;

static double SidewaysFrequency(const SpecimenDef* def, double gamma, double guess, double* milliseconds)
{
    const kiriMaterial* m = &def->material;
    double L = def->length;
    SpecimenDef loaded = *def;
    loaded.gravity[1] = -gamma * Rigidity(m) / ((double)m->density * L * L * L);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&loaded);
    Require(specimen != NULL, "a strip on edge is refused");
    Specimen_ClampEnd(specimen, def, 0.0);
    double found = Specimen_Frequency(specimen, Accuracy_FirstShape, &L, 2e-4, guess);
    *milliseconds = specimen->milliseconds;
    return found;
}

/* The square of the frequency falls with the square of the load, nearly linearly, for the load couples bending and
   twist: to zero where it buckles. Each load is half as far from there as the one before. */
static double BucklingLoad(const SpecimenDef* def, double expected, double* milliseconds)
{
    double first = 3.516 / (def->length * def->length) * sqrt(Rigidity(&def->material) / 1000.0);
    double a = 0.0, b = 0.25 * expected * expected, zero = 0.0;
    double fa = pow(SidewaysFrequency(def, 0.0, first, milliseconds), 2.0), whole = fa;
    double fb = pow(SidewaysFrequency(def, sqrt(b), 0.8 * sqrt(fa), milliseconds), 2.0);
    for (int k = 0; k < 3 && fb > 0.03 * whole; ++k) {
        zero = b + fb * (b - a) / (fa - fb);
        a = b;
        fa = fb;
        b = 0.5 * (a + zero);
        fb = pow(SidewaysFrequency(def, sqrt(b), 0.7 * sqrt(fa), milliseconds), 2.0);
    }
    return sqrt(b + fb * (b - a) / (fa - fb));
}

static void AddBuckling(const BucklingSetup* setup, int kind, int columns, int rows, int grid)
{
    SpecimenDef def = Specimen_Strip(5e8, setup->poisson, 5e-4);
    def.width = setup->width * def.length;
    def.grid = grid;
    def.material.airDamping = 0.0f;
    def.iterations = 2;
    Layout_Make(&def.layout, kind, def.length, def.width, columns, rows);
    Row row = Row_Make("buckling", layoutNames[kind], def.layout.count, grid, 5e-3, 0.05);
    double found = BucklingLoad(&def, setup->load, &row.milliseconds);
    snprintf(row.setting, sizeof row.setting, "W/L %g, nu %g, %d row%s", setup->width, setup->poisson, rows,
             rows > 1 ? "s" : "");
    Results_AddValue(row, found, setup->load, "1");
}

static void Buckling(const char* data)
{
    static const double grids[] = { 80, 160 };
    char path[512], line[256];
    snprintf(path, sizeof path, "%s/lateral_buckling.csv", data);
    FILE* file = fopen(path, "r");
    Require(file != NULL, "no lateral_buckling.csv");
    while (fgets(line, sizeof line, file) != NULL) {
        BucklingSetup s;
        if (sscanf(line, "%lf,%lf,%lf", &s.poisson, &s.width, &s.load) == 3) {
            for (int g = 0; g < COUNT(grids); ++g) {
                AddBuckling(&s, LAYOUT_ROWS, 17, 1, (int)grids[g]);
            }
            if (s.width > 0.15) {
                AddBuckling(&s, LAYOUT_ROWS, 17, 2, 160);
                AddBuckling(&s, LAYOUT_LLOYD, 17, 4, 160);
            }
        }
    }
    fclose(file);
}

/* ---- Membrane --------------------------------------------------------------------------------------------------- */

/* All frames of a square are put where a plane state of strain has them; energy by that of the state. */
static void AddState(const char* name, const double strain[3], int n, int kind, int along, int grid)
{
    static const float flat[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    SpecimenDef def = Specimen_Strip(1e6, POISSON[n], 1e-3);
    double nu = POISSON[n], E = 1e6 * 1e-3 / (1.0 - nu * nu), *e = (double[3]){ strain[0], strain[1], strain[2] };
    def.length = def.width = 0.1;
    def.grid = grid;
    def.planar = 1;
    Layout_MakeFramed(&def.layout, kind, def.length, def.width, along, along);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    for (int i = 0; i < specimen->count; ++i) {
        const float* r = specimen->states[i].restPoint;
        double u = (double)r[0], v = (double)r[1];
        float to[3] = { (float)(u + e[0] * u + e[2] * v), (float)(v + e[2] * u + e[1] * v), 0.0f };
        kiriFrame_Hold(specimen->world, specimen->ids[i], to, flat);
    }
    kiriTotals totals;
    Require(kiriWorld_Tick(specimen->world, 0.01f, 1) == KIRI_OK, "no tick");
    kiriSheet_GetTotals(specimen->world, specimen->sheet, &totals);
    double theory = 0.5 * E * (e[0] * e[0] + e[1] * e[1] + 2.0 * nu * e[0] * e[1] + 2.0 * (1.0 - nu) * e[2] * e[2]);
    Row row = Row_Make("membrane", layoutNames[kind], specimen->count, grid, 2e-3, 0.01);
    snprintf(row.setting, sizeof row.setting, "nu %g, %s", nu, name);
    Results_AddValue(row, totals.elasticEnergy, theory * 0.01, "J");
}

/* A strip that is pulled; how much narrower its middle is. */
static void AddNarrowing(int n, int kind, int rows, int model)
{
    const double shift[3] = { 1e-3, 0.0, 0.0 };
    SpecimenDef def = Specimen_Strip(1e6, POISSON[n], 1e-3);
    def.length = 0.16;
    def.width = 0.04;
    def.planar = 1;
    def.model = model;
    Layout_Make(&def.layout, kind, def.length, def.width, 4 * rows, rows);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    Specimen_ClampEnd(specimen, &def, 0.0);
    Specimen_MoveClamp(specimen, Specimen_ClampEnd(specimen, &def, def.length), shift);
    Specimen_Settle(specimen);
    double sums[4] = { 0.0, 0.0, 0.0, 0.0 };
    for (int i = 0; i < specimen->count; ++i) {
        const kiriFrameState* s = &specimen->states[i];
        double arm = (double)s->restPoint[1] - 0.02, u = (double)s->restPoint[0] - 0.08;
        if (fabs(u) < 0.04) { /* a straight line fitted to the moves in the middle half */
            double moved[2] = { (double)s->position[1] - (double)s->restPoint[1],
                                (double)s->position[0] - (double)s->restPoint[0] - 5e-4 };
            sums[0] += arm * moved[0];
            sums[1] += arm * arm;
            sums[2] += u * moved[1];
            sums[3] += u * u;
        }
    }
    Row row = Row_Make("narrowing", layoutNames[kind], specimen->count, def.grid, 1e-2, 0.1);
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "nu %g, %s", POISSON[n], model == KIRI_MODEL_LINKS ? "links" : "affine");
    Results_AddValue(row, -sums[0] / sums[1] / (sums[2] / sums[3]), POISSON[n], "1");
}

static void Membrane(const char* data)
{
    static const double biaxial[] = { 0.01, 0.01, 0.0 }, shear[] = { 0.0, 0.0, 0.01 }, pull[] = { 0.01, 0.0, 0.0 };
    static const int along[] = { 5, 9 };
    for (int n = 0; n < COUNT(POISSON); ++n) {
        for (int kind = 0; kind < LAYOUT_KINDS; ++kind) {
            for (int g = 0; g < COUNT(GRIDS); ++g) {
                for (int k = 0; k < COUNT(along); ++k) {
                    AddState("biaxial", biaxial, n, kind, along[k], GRIDS[g]);
                    AddState("shear", shear, n, kind, along[k], GRIDS[g]);
                    AddState("one direction", pull, n, kind, along[k], GRIDS[g]);
                }
            }
        }
    }
}

static void Narrowing(const char* data)
{
    for (int rows = 2; rows <= 8; rows *= 2) {
        AddNarrowing(1, LAYOUT_ROWS, rows, KIRI_MODEL_LINKS);
        AddNarrowing(1, LAYOUT_LLOYD, rows, KIRI_MODEL_LINKS);
        AddNarrowing(1, LAYOUT_ROWS, rows, KIRI_MODEL_AFFINE);
    }
}

const Case plateCases[] = {
    { "torsion", Torsion },
    { "plate frequencies", PlateFrequencies },
    { "free plate", FreePlate },
    { "buckling", Buckling },
    { "membrane", Membrane },
    { "narrowing", Narrowing },
    { NULL, NULL },
};
