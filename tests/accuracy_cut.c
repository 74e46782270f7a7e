/* Sheets with cuts. */
#include "accuracy.h"
#include "results.h"
#include "specimen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const double G = 9.81, NOWHERE[3] = { 0.0, 0.0, 0.0 }, YOUNG = 7.438285638990287e8;
static const int GRIDS[] = { 40, 80, 160 };

/* ---- A slit across a strip -------------------------------------------------------------------------------------- */

/* Mean drop of the edge u = length, as seen; or NAN. */
static double EdgeDrop(const SpecimenDef* def, double* milliseconds)
{
    SCOPED_SPECIMEN(specimen) = Specimen_Create(def);
    if (specimen == NULL) {
        return NAN;
    }
    kiriMesh mesh;
    double sum = 0.0;
    int count = 0;
    Specimen_ClampEnd(specimen, def, 0.0);
    Specimen_Settle(specimen);
    kiriSheet_GetMesh(specimen->world, specimen->sheet, &mesh);
    for (int i = 0; i < mesh.vertexCount; ++i) {
        if ((double)mesh.restPositions[2 * i] > def->length - 1e-6) {
            sum -= (double)mesh.positions[3 * i + 2];
            ++count;
        }
    }
    *milliseconds = specimen->milliseconds;
    return sum / count;
}

/* What the slit adds to the drop of the same strip without it, its frames spread as many. */
static void AddSlit(double end, double added, int frames, int grid)
{
    const float slit[4] = { 0.05f, 0.0f, 0.05f, (float)end };
    SpecimenDef whole = Specimen_Strip(YOUNG, 0.3, 5e-4), cut;
    whole.gravity[2] = -G;
    whole.grid = grid;
    whole.frames = frames;
    cut = whole;
    cut.slits[cut.slitCount++] = (Slit){ slit, 2 };
    Row row = Row_Make("slit across", "spread", frames, grid, 0.03, 0.05);
    snprintf(row.setting, sizeof row.setting, "nu 0.3, %g of the width", end / 0.05);
    double drop = EdgeDrop(&cut, &row.milliseconds);
    Results_AddValue(row, drop - EdgeDrop(&whole, &row.milliseconds), added, "m");
}

/* CalculiX, 80 x 20 S8R elements; on 40 x 10 it has 7.59 and 21.9 mm: so about 3 % below what it converges to. */
static void SlitAcross(const char* data)
{
    static const double ends[] = { 0.025, 0.04 }, added[] = { 7.845e-3, 22.50e-3 };
    static const int frames[] = { 24, 48, 96, 192 };
    for (int e = 0; e < COUNT(ends); ++e) {
        for (int g = 0; g < COUNT(GRIDS); ++g) {
            for (int k = 0; k < COUNT(frames); ++k) {
                AddSlit(ends[e], added[e], frames[k], GRIDS[g]);
            }
        }
    }
}

/* ---- Kirigami in its plane -------------------------------------------------------------------------------------- */

/* N/m: u = 0 is clamped, u = length moved along u. */
static double Stiffness(const SpecimenDef* def, double move, double* milliseconds)
{
    const double shift[3] = { move, 0.0, 0.0 };
    SCOPED_SPECIMEN(specimen) = Specimen_Create(def);
    if (specimen == NULL) {
        return NAN;
    }
    double force[3];
    Specimen_ClampEnd(specimen, def, 0.0);
    kiriPin end = Specimen_ClampEnd(specimen, def, def->length);
    Specimen_MoveClamp(specimen, end, shift);
    Specimen_Settle(specimen);
    Specimen_Reaction(specimen, end, force);
    *milliseconds = specimen->milliseconds;
    return force[0] / move;
}

/* Three slits in a strip. */
static SpecimenDef KirigamiDef(int grid)
{
    static const float slits[3][4] = {
        { 0.08f, 0.0f, 0.08f, 0.035f },
        { 0.12f, 0.0f, 0.12f, 0.035f },
        { 0.1f, 0.05f, 0.1f, 0.015f },
    };
    SpecimenDef def = Specimen_Strip(YOUNG, 0.3, 5e-4);
    def.grid = grid;
    def.planar = 1;
    for (int k = 0; k < 3; ++k) {
        def.slits[def.slitCount++] = (Slit){ slits[k], 2 };
    }
    return def;
}

/* CalculiX, S8R in the plane: 7.054, 6.901 and 6.826 kN/m with 80, 160 and 320 elements along; so 6.75 in the limit,
   for the differences halve. */
static void AddKirigami(const SpecimenDef* def, const char* setting, const char* layout)
{
    int frames = def->frames > 0 ? def->frames : def->layout.count;
    Row row = Row_Make("kirigami strip", layout, frames, def->grid, 0.02, 0.1);
    snprintf(row.setting, sizeof row.setting, "nu 0.3%s", setting);
    double found = Stiffness(def, 1e-4, &row.milliseconds);
    Results_AddValue(row, found, 6750.0, "N/m");
}

/* As they come; and with a border between regions on each line on which a slit would go on. */
static void Kirigami(const char* data)
{
    static const int frames[] = { 24, 48, 96, 192 }, grids[] = { 40, 80, 160, 320 };
    for (int g = 0; g < COUNT(grids); ++g) {
        for (int k = 0; k < COUNT(frames); ++k) {
            SpecimenDef def = KirigamiDef(grids[g]);
            int rows = (int)(sqrt(frames[k] * def.width / def.length) + 0.5);
            Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, frames[k] / rows, rows);
            AddKirigami(&def, "", "rows");
            Layout_Make(&def.layout, LAYOUT_JITTERED, def.length, def.width, frames[k] / rows, rows);
            AddKirigami(&def, "", "jittered");
            def.layout.count = 0;
            def.frames = frames[k];
            AddKirigami(&def, "", "spread");
        }
        for (int columns = 20; columns <= 40; columns += 20) {
            SpecimenDef def = KirigamiDef(grids[g]);
            Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, columns, 10);
            AddKirigami(&def, ", borders at slit ends", "rows");
        }
    }
}

/* ---- Kirigami: how stiffness scales ----------------------------------------------------------------------------- */

/* Isobe and Okumura, Initial rigid response and softening transition of highly stretchable kirigami sheet materials,
   Scientific Reports 6, 24758 (2016): N strips of width d and length w, between slits from both sides in turns. In the
   plane they are k1 ~ E h d^3 / (N w^3) stiff; where they have turned out of it, k2 ~ E d h^3 / (N w^3). These are
   scalings for d much below w: with d = w / 12 ends of the strips make exponents of d and w some tenths larger. */
typedef struct Accordion {
    double d, w, h;
    int strips, along; /* frames along each strip */
} Accordion;

static SpecimenDef AccordionDef(const Accordion* a)
{
    static float points[MAX_SLITS][4];
    SpecimenDef def = Specimen_Strip(1e9, 0.0, a->h);
    def.length = a->strips * a->d;
    def.width = a->w;
    def.grid = (int)(8.0 * fmax(def.length, def.width) / a->d + 0.5);
    def.columns = def.grid;
    for (int k = 0; k + 1 < a->strips; ++k) {
        float u = (float)((k + 1) * a->d), tip = (float)(k % 2 == 0 ? a->w - a->d : a->d);
        const float slit[4] = { u, k % 2 == 0 ? 0.0f : (float)a->w, u, tip };
        memcpy(points[k], slit, sizeof slit);
        def.slits[def.slitCount++] = (Slit){ points[k], 2 };
    }
    Layout_Make(&def.layout, LAYOUT_ROWS, def.length, def.width, a->strips, a->along);
    return def;
}

static double InPlane(const Accordion* a, double* milliseconds)
{
    SpecimenDef def = AccordionDef(a);
    def.planar = 1;
    return Stiffness(&def, 1e-3 * a->d, milliseconds);
}

static double PullingForce(Specimen* specimen, kiriPin end, double move)
{
    const double shift[3] = { move, 0.0, 0.0 };
    double force[3];
    Specimen_MoveClamp(specimen, end, shift);
    Specimen_Settle(specimen);
    Specimen_Reaction(specimen, end, force);
    return force[0];
}

/* The force by the pull, at 8 mm, once it has turned out of its plane. */
static double OutOfPlane(const Accordion* a, double* milliseconds)
{
    SpecimenDef def = AccordionDef(a);
    const double pull = 0.008, push[3] = { 0.0, 0.0, -1e-3 * G };
    SCOPED_SPECIMEN(specimen) = Specimen_Create(&def);
    Require(specimen != NULL, "an accordion is refused");
    Specimen_ClampEnd(specimen, &def, 0.0);
    kiriPin end = Specimen_ClampEnd(specimen, &def, def.length);
    Specimen_SetGravity(specimen, push); /* so that it finds the way */
    PullingForce(specimen, end, 0.25 * pull);
    PullingForce(specimen, end, 0.5 * pull);
    Specimen_SetGravity(specimen, NOWHERE);
    double force = PullingForce(specimen, end, pull);
    *milliseconds = specimen->milliseconds;
    return force / pull;
}

typedef double MeasureStiffness(const Accordion* a, double* milliseconds);

static void AddExponent(const char* setting, const Accordion* a, const Accordion* b, double ratio, double expected,
                        MeasureStiffness* measure)
{
    Row row = Row_Make("kirigami scaling", "rows", b->strips * b->along, 0, 0.05, 0.2);
    double first = measure(a, &row.milliseconds), second = measure(b, &row.milliseconds);
    row.grid = AccordionDef(b).grid;
    snprintf(row.setting, sizeof row.setting, "%s", setting);
    Results_AddValue(row, log(second / first) / log(ratio), expected, "1");
}

/* The strips at the ends are held, and do not bend. */
static void Scaling(const char* data)
{
    for (int dense = 1; dense <= 2; ++dense) {
        const Accordion base = { 0.04 / 12.0, 0.04, 5e-5, 8, 12 * dense };
        Accordion narrow = base, thick = base, many = base, wide = base;
        narrow.d = 0.0025;
        narrow.along = wide.along = 16 * dense;
        thick.h *= 2.0;
        many.strips = 14;
        wide.w *= 16.0 / 12.0;
        AddExponent("k1, exponent of d", &base, &narrow, 0.75, 3.0, InPlane);
        AddExponent("k1, exponent of w", &base, &wide, 16.0 / 12.0, -3.0, InPlane);
        AddExponent("k1, exponent of N", &base, &many, 2.0, -1.0, InPlane);
        AddExponent("k2, exponent of d", &base, &narrow, 0.75, 1.0, OutOfPlane);
        AddExponent("k2, exponent of h", &base, &thick, 2.0, 3.0, OutOfPlane);
    }
}

/* ---- Cut then load, load then cut ------------------------------------------------------------------------------- */

/* rms distance of the frames at rest, by the rms way that they go. */
static double Difference(const Specimen* a, const Specimen* b)
{
    double error = 0.0, way = 0.0;
    for (int i = 0; i < a->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            double rest = k < 2 ? (double)a->states[i].restPoint[k] : 0.0, x = (double)a->states[i].position[k];
            double off = (double)b->states[i].position[k] - x;
            error += off * off;
            way += (x - rest) * (x - rest);
        }
    }
    return sqrt(error / way);
}

/* Where the library puts frames in the sheet with its slits. */
static void SpreadFrames(SpecimenDef* def, int frames)
{
    def->frames = frames;
    SCOPED_SPECIMEN(spread) = Specimen_Create(def);
    Require(spread != NULL, "frames are refused");
    def->layout.count = spread->count;
    for (int i = 0; i < spread->count; ++i) {
        memcpy(&def->layout.points[2 * i], spread->states[i].restPoint, 2 * sizeof(float));
    }
}

static Specimen* HangTongue(const SpecimenDef* def, const Slit* slit, bool loadFirst)
{
    Specimen* specimen = Specimen_Create(def);
    Require(specimen != NULL, "a tongue is refused");
    Specimen_ClampEnd(specimen, def, 0.0);
    for (int step = 0; step < 2; ++step) {
        if ((step == 0) == loadFirst) {
            const double gravity[3] = { 0.0, 0.0, -G };
            Specimen_SetGravity(specimen, gravity);
            Specimen_Settle(specimen);
        } else {
            Specimen_Cut(specimen, slit);
        }
    }
    Specimen_Settle(specimen);
    Specimen_Look(specimen);
    return specimen;
}

static void Order(const char* data)
{
    static const float points[] = { 0.05f, 0.0f, 0.05f, 0.07f, 0.08f, 0.07f };
    static const int frames[] = { 24, 48, 96, 192 };
    const Slit slit = { points, 3 };
    for (int n = 0; n < 2; ++n) {
        for (int k = 0; k < COUNT(frames); ++k) {
            SpecimenDef def = Specimen_Strip(YOUNG, n == 0 ? 0.0 : 0.3, 5e-4);
            def.length = def.width = 0.1;
            def.slits[def.slitCount++] = slit;
            SpreadFrames(&def, frames[k]);
            def.slitCount = 0;
            Specimen *a = HangTongue(&def, &slit, false), *b = HangTongue(&def, &slit, true);
            Row row = Row_Make("load, then cut", "spread", frames[k], def.grid, 1e-4, 5e-4);
            row.error = Difference(a, b);
            row.milliseconds = b->milliseconds;
            snprintf(row.setting, sizeof row.setting, "nu %g, tongue", n == 0 ? 0.0 : 0.3);
            Results_Add(&row);
            Specimen_Destroy(a);
            Specimen_Destroy(b);
        }
    }
}

const Case cutCases[] = {
    { "slit across", SlitAcross },
    { "kirigami strip", Kirigami },
    { "kirigami scaling", Scaling },
    { "load, then cut", Order },
    { NULL, NULL },
};
