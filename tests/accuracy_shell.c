/* Sheets that bend in two directions as far as they like, against shells. */
#include "accuracy.h"
#include "reference.h"
#include "results.h"
#include "specimen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const double G = 9.81, PI = 3.14159265358979323846;
static const double POISSON[] = { 0.0, 0.3 };
static const int GRIDS[] = { 40, 80, 160 };

/* ---- Against shells --------------------------------------------------------------------------------------------- */

static double ShellError(const Specimen* specimen, const Shell* shell)
{
    double error = 0.0, way = 0.0;
    for (int i = 0; i < specimen->count; ++i) {
        const kiriFrameState* s = &specimen->states[i];
        double at[3] = { (double)s->restPoint[0], (double)s->restPoint[1], 0.0 }, expected[3];
        Shell_At(shell, at, at, expected);
        for (int k = 0; k < 3; ++k) {
            double off = (double)s->position[k] - expected[k], moved = expected[k] - at[k];
            error += off * off;
            way += moved * moved;
        }
    }
    return sqrt(error / way);
}

/* Clamped along u = 0, under its weight, with its frames as the def has them. */
static void AddShell(const SpecimenDef* def, const char* name, const char* layout, const Shell* shell, double target)
{
    SCOPED_SPECIMEN(specimen) = Specimen_Create(def);
    if (specimen == NULL) {
        return;
    }
    Row row = Row_Make(name, layout, specimen->count, def->grid, 2e-3, target);
    row.unit = "est.";
    Specimen_ClampEnd(specimen, def, 0.0);
    Specimen_Settle(specimen);
    Require(kiriSheet_EstimateError(specimen->world, specimen->sheet, &row.value) == KIRI_OK, "no estimate");
    row.error = row.reference = ShellError(specimen, shell);
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "nu %g", (double)def->material.poissonsRatio);
    if (def->accuracy > 0.0) {
        snprintf(row.setting, sizeof row.setting, "nu %g, wanted %g %%", (double)def->material.poissonsRatio,
                 100.0 * def->accuracy);
    }
    Results_Add(&row);
}

/* The sheet of the shell data, its frames still to be chosen. */
static SpecimenDef ShellSheet(double poisson, double length, double width, int grid)
{
    SpecimenDef def = Specimen_Strip(7.438285638990287e8, poisson, 5e-4);
    def.gravity[2] = -G;
    def.length = length;
    def.width = width;
    def.grid = grid;
    return def;
}

static const float tongueSlit[] = { 0.05f, 0.0f, 0.05f, 0.07f, 0.08f, 0.07f };

static SpecimenDef TongueSheet(double poisson, int grid)
{
    SpecimenDef def = ShellSheet(poisson, 0.1, 0.1, grid);
    def.slits[def.slitCount++] = (Slit){ tongueSlit, 3 };
    return def;
}

static const Shell* ReadShell(const char* data, const char* name, const float* slit, int points)
{
    static Shell shell;
    char path[512];
    snprintf(path, sizeof path, "%s/%s.csv", data, name);
    Require(Shell_Read(&shell, path, slit, points), "no data of a shell");
    return &shell;
}

static const Shell* ReadWide(const char* data, int n)
{
    return ReadShell(data, n == 0 ? "cantilever_nu0" : "cantilever_nu03", NULL, 0);
}

static const Shell* ReadTongue(const char* data, int n)
{
    return ReadShell(data, n == 0 ? "tongue_nu0" : "tongue", tongueSlit, 3);
}

/* Frames that the library spreads, or in a layout with about as many. */
static void ChooseFrames(SpecimenDef* def, int kind, int frames)
{
    int rows = (int)(sqrt(frames * def->width / def->length) + 0.5);
    if (kind < LAYOUT_KINDS) {
        Layout_Make(&def->layout, kind, def->length, def->width, frames / rows, rows);
    } else {
        def->frames = frames;
    }
}

static void WideCantilever(const char* data)
{
    static const int frames[] = { 12, 24, 48, 96, 192 };
    static const int kinds[] = { LAYOUT_ROWS, LAYOUT_JITTERED, LAYOUT_LLOYD, LAYOUT_KINDS };
    static const double targets[] = { 0.04, 0.02, 0.01, 0.005, 0.005 };
    for (int n = 0; n < COUNT(POISSON); ++n) {
        const Shell* shell = ReadWide(data, n);
        for (int l = 0; l < COUNT(kinds); ++l) {
            for (int g = 0; g < COUNT(GRIDS); ++g) {
                for (int k = 0; k < COUNT(frames); ++k) {
                    SpecimenDef def = ShellSheet(POISSON[n], 0.2, 0.05, GRIDS[g]);
                    ChooseFrames(&def, kinds[l], frames[k]);
                    AddShell(&def, "wide cantilever", l < 3 ? layoutNames[kinds[l]] : "spread", shell, targets[k]);
                }
            }
        }
    }
}

static void Tongue(const char* data)
{
    static const int frames[] = { 24, 48, 96, 192 };
    static const double targets[] = { 0.08, 0.04, 0.02, 0.01 };
    for (int n = 0; n < COUNT(POISSON); ++n) {
        const Shell* shell = ReadTongue(data, n);
        for (int g = 0; g < COUNT(GRIDS); ++g) {
            for (int k = 0; k < COUNT(frames); ++k) {
                SpecimenDef def = TongueSheet(POISSON[n], GRIDS[g]);
                ChooseFrames(&def, LAYOUT_KINDS, frames[k]);
                AddShell(&def, "tongue", "spread", shell, targets[k]);
            }
        }
    }
}

/* As many frames as the library takes for an accuracy that is wanted: within a factor of two. */
static void WantedAccuracy(const char* data)
{
    static const double wanted[] = { 0.1, 0.05, 0.02, 0.01 };
    for (int n = 0; n < COUNT(POISSON); ++n) {
        for (int g = 0; g < COUNT(GRIDS); ++g) {
            for (int k = 0; k < COUNT(wanted); ++k) {
                SpecimenDef wide = ShellSheet(POISSON[n], 0.2, 0.05, GRIDS[g]),
                            tongue = TongueSheet(POISSON[n], GRIDS[g]);
                wide.accuracy = tongue.accuracy = wanted[k];
                AddShell(&wide, "wanted, cantilever", "automatic", ReadWide(data, n), 2.0 * wanted[k]);
                AddShell(&tongue, "wanted, tongue", "automatic", ReadTongue(data, n), 2.0 * wanted[k]);
            }
        }
    }
}

/* ---- Slit annular plate ----------------------------------------------------------------------------------------- */

enum { AROUND = 120, ACROSS = 12 }; /* triangles of the mesh, in pairs */

static const double INNER = 6.0, OUTER = 10.0;

/* In a box of 20 x 20. */
static void PolarPoint(double r, double angle, float point[2])
{
    point[0] = (float)(OUTER + r * cos(angle));
    point[1] = (float)(OUTER + r * sin(angle));
}

/* The lips at angle 0 are two rows of vertices. */
static void MakeAnnulus(SpecimenMesh* mesh)
{
    static float rest[2 * (AROUND + 1) * (ACROSS + 1)];
    static int32_t indices[6 * AROUND * ACROSS];
    for (int i = 0; i < (AROUND + 1) * (ACROSS + 1); ++i) {
        int step = i / (ACROSS + 1), ring = i % (ACROSS + 1);
        PolarPoint(INNER + (OUTER - INNER) * ring / ACROSS, 2.0 * PI * (step % AROUND) / AROUND, &rest[2 * i]);
    }
    for (int k = 0; k < AROUND * ACROSS; ++k) {
        int32_t a = k / ACROSS * (ACROSS + 1) + k % ACROSS, b = a + ACROSS + 1;
        const int32_t corners[6] = { a, a + 1, b, b, a + 1, b + 1 };
        memcpy(&indices[6 * k], corners, sizeof corners);
    }
    *mesh = (SpecimenMesh){ rest, indices, (AROUND + 1) * (ACROSS + 1), 2 * AROUND * ACROSS };
}

static void PlaceInRings(Layout* layout, int rings, int around)
{
    layout->count = 0;
    for (int i = 0; i < rings * around; ++i) {
        double r = INNER + (OUTER - INNER) * (i % rings + 0.5) / rings, share = ((double)(i / rings) + 0.5) / around;
        PolarPoint(r, 2.0 * PI * share, &layout->points[2 * layout->count++]);
    }
}

/* Where the vertex of the second lip at radius r is. */
static double LiftOf(const Specimen* specimen, int ring)
{
    kiriMesh mesh;
    kiriSheet_GetMesh(specimen->world, specimen->sheet, &mesh);
    return (double)mesh.positions[3 * (AROUND * (ACROSS + 1) + ring) + 2];
}

/* Clamp and load are a hair beside the slit, each on its lip. */
static void AddAnnulus(int rings, int around, int grid)
{
    SpecimenMesh mesh;
    MakeAnnulus(&mesh);
    SpecimenDef def = Specimen_Strip(21e6, 0.0, 0.03);
    double beside = 20.0 / grid / 32.0;
    def.length = def.width = 20.0;
    def.grid = grid;
    def.mesh = &mesh;
    def.material.density = 1.0f;
    def.material.airDamping = 2.0f;
    PlaceInRings(&def.layout, rings, around);
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    if (specimen == NULL) {
        return;
    }
    Specimen_Clamp(specimen, OUTER + INNER, OUTER + beside, 2.0 * OUTER, OUTER + beside);
    specimen->loaded = true;
    specimen->load = (Load){ { (float)(OUTER + INNER), (float)(OUTER - beside) },
                             { (float)(2.0 * OUTER), (float)(OUTER - beside) },
                             { 0.0f, 0.0f, 0.8f },
                             { 0.0f } };
    Specimen_Settle(specimen);
    Row row = Row_Make("slit annulus", "rings", specimen->count, grid, 2e-3, 0.03);
    row.milliseconds = specimen->milliseconds;
    snprintf(row.setting, sizeof row.setting, "nu 0, inner corner");
    Results_AddValue(row, LiftOf(specimen, 0), 13.891, "m");
    snprintf(row.setting, sizeof row.setting, "nu 0, outer corner");
    Results_AddValue(row, LiftOf(specimen, ACROSS), 17.528, "m");
}

static void Annulus(const char* data)
{
    static const int around[] = { 16, 25, 38, 50, 76 }, grids[] = { 80, 160 };
    static const int rings[] = { 1, 2, 3, 4, 6 };
    for (int g = 0; g < COUNT(grids); ++g) {
        for (int k = 0; k < COUNT(rings); ++k) {
            AddAnnulus(rings[k], around[k], grids[g]);
        }
    }
}

const Case shellCases[] = {
    { "wide cantilever", WideCantilever }, { "tongue", Tongue }, { "wanted accuracy", WantedAccuracy },
    { "slit annulus", Annulus },           { NULL, NULL },
};
