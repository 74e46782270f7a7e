/* How far sheets at rest are from the truth, and what a tick costs: a table here, a CSV file and a plot in
   build/accuracy. What moves is in trade.c.

   The error is rms |x - x_ref| over the sample points by rms |x_ref - (u, v, 0)| over the same points. Sample points
   are the frames, whose motion is what is computed; and all vertices of the mesh, which is what is seen. */
#include "kiri/kiri.h"

#include "plot.h"
#include "reference.h"
#include "trade.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

enum { MAX_FRAMES = 64, MAX_RESULTS = 128, MAX_TICKS = 4000 };

static const double G = 9.81;
static const double PI = 3.14159265358979323846;

static void Require(int ok, const char* what)
{
    if (!ok) {
        fprintf(stderr, "accuracy: %s\n", what);
        exit(1);
    }
}

/* ---- Results ---------------------------------------------------------------------------------------------------- */

typedef struct Result {
    const char *name, *setting;
    int frames;
    double error, target, milliseconds; /* target 0: none */
} Result;

static Result results[MAX_RESULTS];
static int resultCount;

static void Report(const char* name, int frames, const char* setting, double error, double target, double milliseconds)
{
    Require(resultCount < MAX_RESULTS, "too many results");
    results[resultCount++] = (Result){ name, setting, frames, error, target, milliseconds };
    printf("%-22s %6d  %-18s %9.3f %%", name, frames, setting, 100.0 * error);
    if (target > 0.0) {
        printf("  %7.2f %% %s", 100.0 * target, error <= target ? "  " : "! ");
    } else {
        printf("  %9s   ", "");
    }
    printf(" %8.4f\n", milliseconds);
    fflush(stdout);
}

static void WriteTable(const char* folder)
{
    char path[512];
    snprintf(path, sizeof path, "%s/accuracy.csv", folder);
    FILE* file = fopen(path, "w");
    Require(file != NULL, "cannot write accuracy.csv");
    fprintf(file, "case,frames,scheme/setting,error,target,ms a tick\n");
    for (int i = 0; i < resultCount; ++i) {
        const Result* r = &results[i];
        char target[32] = "";
        if (r->target > 0.0) {
            snprintf(target, sizeof target, "%.6g", r->target);
        }
        fprintf(file, "%s,%d,%s,%.6g,%s,%.6g\n", r->name, r->frames, r->setting, r->error, target, r->milliseconds);
    }
    fclose(file);
}

/* A curve for each case with several numbers of frames, by the errors of the frames. */
static void WritePlot(const char* folder)
{
    static Curve curves[MAX_RESULTS];
    static char names[MAX_RESULTS][64];
    char path[512];
    int count = 0;
    for (int i = 0; i < resultCount; ++i) {
        const Result* r = &results[i];
        int c = 0;
        if (strcmp(r->setting, "frames") != 0) {
            continue;
        }
        snprintf(names[count], sizeof names[count], "%s", r->name);
        while (c < count && strcmp(names[c], names[count]) != 0) {
            ++c;
        }
        count += c == count ? 1 : 0;
        Curve* curve = &curves[c];
        curve->name = names[c];
        if (curve->count < CURVE_POINTS) {
            curve->x[curve->count] = r->milliseconds;
            curve->y[curve->count++] = 100.0 * r->error;
        }
    }
    int kept = 0;
    for (int c = 0; c < count; ++c) {
        if (curves[c].count > 1) {
            curves[kept++] = curves[c];
        }
    }
    snprintf(path, sizeof path, "%s/statics.png", folder);
    Require(Plot_Write(path, "ms a tick of 0.05 s", "error, % of the way", curves, kept), "cannot write statics.png");
}

/* ---- Sheets ----------------------------------------------------------------------------------------------------- */

typedef struct Strip {
    float length, width, square; /* m; of mesh and grid */
    kiriMaterial material;
    float gravity[3];
    const float* slit;
    int slitPoints;
    float points[2 * MAX_FRAMES];
    int frames;
} Strip;

typedef struct Scene {
    kiriWorld* world;
    kiriSheet sheet;
    double milliseconds; /* a tick */
} Scene;

static const float FLAT[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };

static kiriSheetDef DefOf(const Strip* strip)
{
    float longer = strip->length > strip->width ? strip->length : strip->width;
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.sleepSpeed = 0.0f;
    def.material = strip->material;
    def.gridResolution = (int32_t)(longer / strip->square + 0.5f);
    def.frameCount = strip->frames;
    def.maxFrames = strip->frames; /* nothing is added */
    def.rigidWeight = 2.0f;
    def.iterations = 4;
    return def;
}

static kiriSheet AddRectangle(kiriWorld* world, const Strip* strip, const float* points)
{
    int columns = (int)(strip->length / strip->square + 0.5f), rows = (int)(strip->width / strip->square + 0.5f);
    int vertices = (columns + 1) * (rows + 1);
    float* rest = malloc(2 * sizeof(float) * (size_t)vertices);
    int32_t* indices = malloc(6 * sizeof(int32_t) * (size_t)(columns * rows));
    Require(rest != NULL && indices != NULL, "no memory");
    kiriFillRectangle(strip->length, strip->width, columns, rows, rest, indices);
    kiriSheetDef def = DefOf(strip);
    def.framePoints = points;
    def.restPositions = rest;
    def.vertexCount = vertices;
    def.indices = indices;
    def.triangleCount = 2 * columns * rows;
    kiriSheet sheet = 0;
    Require(kiriCreateSheet(world, &def, &sheet) == KIRI_OK, kiriWorld_GetLastError(world));
    free(rest);
    free(indices);
    return sheet;
}

static kiriWorld* MakeWorld(void)
{
    const float none[3] = { 0.0f, 0.0f, 0.0f };
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    memcpy(def.gravity, none, sizeof none);
    kiriWorld* world = NULL;
    Require(kiriCreateWorld(&def, &world) == KIRI_OK, "no world");
    return world;
}

/* Cuts the slit, before gravity acts. */
static void CutSlit(kiriWorld* world, kiriSheet sheet, const float* slit, int points)
{
    if (points > 0) {
        kiriCut cut;
        float outside[2] = { slit[0], slit[1] - 0.01f };
        Require(kiriBeginCut(world, sheet, outside, &cut) == KIRI_OK, "no cut");
        Require(kiriCut_Extend(world, cut, slit, points) == KIRI_OK && kiriCut_End(world, cut) == KIRI_OK, "no cut");
        Require(kiriWorld_Tick(world, 1e-3f, 1) == KIRI_OK, kiriWorld_GetLastError(world));
    }
}

static int GetFrames(const Scene* scene, kiriFrame ids[MAX_FRAMES], kiriFrameState states[MAX_FRAMES])
{
    int32_t count = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, ids, MAX_FRAMES, &count);
    Require(count <= MAX_FRAMES, "too many frames");
    for (int i = 0; i < count; ++i) {
        Require(kiriFrame_GetState(scene->world, ids[i], &states[i]) == KIRI_OK, "no frame");
    }
    return count;
}

/* The strip with its frames on the edge u = 0 held, and weight acting. */
static Scene MakeScene(const Strip* strip)
{
    kiriFrame ids[MAX_FRAMES];
    kiriFrameState states[MAX_FRAMES];
    Scene scene = { MakeWorld(), 0, 0.0 };
    scene.sheet = AddRectangle(scene.world, strip, strip->points);
    int count = GetFrames(&scene, ids, states);
    for (int i = 0; i < count; ++i) {
        if (states[i].restPoint[0] < 1e-6f) {
            kiriFrame_Hold(scene.world, ids[i], states[i].position, FLAT);
        }
    }
    CutSlit(scene.world, scene.sheet, strip->slit, strip->slitPoints);
    kiriWorld_SetGravity(scene.world, strip->gravity);
    return scene;
}

/* Ticks until nothing moves, and measures what a tick takes. */
static void Settle(Scene* scene, const Strip* strip)
{
    const double dt = 0.05, least = 3e-6 * (double)strip->length;
    int calm = 0, ticks = 0;
    clock_t start = clock();
    for (; calm < 3; ++ticks) {
        kiriTotals totals;
        Require(ticks < MAX_TICKS, "a sheet does not come to rest");
        Require(kiriWorld_Tick(scene->world, (float)dt, 1) == KIRI_OK, kiriWorld_GetLastError(scene->world));
        kiriSheet_GetTotals(scene->world, scene->sheet, &totals);
        calm = sqrt(2.0 * totals.kineticEnergy / totals.mass) * dt < least ? calm + 1 : 0;
    }
    scene->milliseconds = 1e3 * (double)(clock() - start) / CLOCKS_PER_SEC / ticks;
}

/* A row of frames along each of `rows` lines, from edge to edge. */
static void PlaceRows(Strip* strip, int columns, int rows)
{
    strip->frames = columns * rows;
    for (int i = 0; i < strip->frames; ++i) {
        strip->points[2 * i] = strip->length * (float)(i / rows) / (float)(columns - 1);
        strip->points[2 * i + 1] = strip->width * ((float)(i % rows) + 0.5f) / (float)rows;
    }
}

/* The strip from u = `margin` on as a sheet of its own, its slit a slit from the start: so frames spread over it know
   the slit. */
static Scene MakeRemainder(const Strip* strip, float margin, int frames)
{
    Strip rest = *strip;
    float slit[2 * CURVE_POINTS];
    kiriMesh mesh;
    rest.length -= margin;
    rest.frames = 1;
    for (int i = 0; i < 2 * strip->slitPoints; ++i) {
        slit[i] = strip->slit[i] - (i % 2 == 0 ? margin : 0.0f);
    }
    Scene cut = { MakeWorld(), 0, 0.0 }, scene = { MakeWorld(), 0, 0.0 };
    cut.sheet = AddRectangle(cut.world, &rest, NULL);
    CutSlit(cut.world, cut.sheet, slit, strip->slitPoints);
    kiriSheet_GetMesh(cut.world, cut.sheet, &mesh);
    rest.frames = frames;
    kiriSheetDef def = DefOf(&rest);
    def.restPositions = mesh.restPositions;
    def.vertexCount = mesh.vertexCount;
    def.indices = mesh.indices;
    def.triangleCount = mesh.triangleCount;
    Require(kiriCreateSheet(scene.world, &def, &scene.sheet) == KIRI_OK, kiriWorld_GetLastError(scene.world));
    kiriDestroyWorld(cut.world);
    return scene;
}

/* A held row on the edge u = 0, as dense as the rest, that answers for half a spacing of the strip; the others are
   spread evenly over what remains, by the library. */
static void PlaceEvenly(Strip* strip, int frames)
{
    kiriFrame ids[MAX_FRAMES];
    kiriFrameState states[MAX_FRAMES];
    float spacing = (float)sqrt((double)(strip->length * strip->width) / frames);
    float margin = strip->square * (float)(int)(0.5f * spacing / strip->square + 0.5f);
    int held = (int)(strip->width / spacing + 0.5f);
    for (int i = 0; i < held; ++i) {
        strip->points[2 * i] = 0.0f;
        strip->points[2 * i + 1] = strip->width * ((float)i + 0.5f) / (float)held;
    }
    Scene scene = MakeRemainder(strip, margin, frames - held);
    int count = GetFrames(&scene, ids, states);
    Require(held + count == frames, "frames are missing");
    for (int i = 0; i < count; ++i) {
        strip->points[2 * (held + i)] = states[i].restPoint[0] + margin;
        strip->points[2 * (held + i) + 1] = states[i].restPoint[1];
    }
    strip->frames = frames;
    kiriDestroyWorld(scene.world);
}

/* ---- Errors ----------------------------------------------------------------------------------------------------- */

/* Where a rest point should be; exactly one of the two is given. */
typedef struct Reference {
    const Elastica* elastica;
    double length;
    const Shell* shell;
} Reference;

static void ReferenceAt(const Reference* reference, const double rest[2], const double side[2], double position[3])
{
    if (reference->shell != NULL) {
        Shell_At(reference->shell, rest, side, position);
        return;
    }
    double x, drop;
    Elastica_At(reference->elastica, rest[0] / reference->length, &x, &drop);
    position[0] = reference->length * x;
    position[1] = rest[1];
    position[2] = -reference->length * drop;
}

typedef struct Sums {
    double error, way;
} Sums;

static void AddSample(Sums* sums, const Reference* reference, const float rest[2], const double side[2],
                      const float position[3])
{
    double at[3] = { (double)rest[0], (double)rest[1], 0.0 }, expected[3];
    ReferenceAt(reference, at, side, expected);
    for (int k = 0; k < 3; ++k) {
        double off = (double)position[k] - expected[k], way = expected[k] - at[k];
        sums->error += off * off;
        sums->way += way * way;
    }
}

static double FrameError(const Scene* scene, const Reference* reference)
{
    kiriFrame ids[MAX_FRAMES];
    kiriFrameState states[MAX_FRAMES];
    Sums sums = { 0.0, 0.0 };
    int count = GetFrames(scene, ids, states);
    for (int i = 0; i < count; ++i) {
        double side[2] = { (double)states[i].restPoint[0], (double)states[i].restPoint[1] };
        AddSample(&sums, reference, states[i].restPoint, side, states[i].position);
    }
    return sqrt(sums.error / sums.way);
}

/* A vertex is on the side of the triangles around it. */
static double VertexError(const Scene* scene, const Reference* reference)
{
    kiriMesh mesh;
    Sums sums = { 0.0, 0.0 };
    kiriSheet_GetMesh(scene->world, scene->sheet, &mesh);
    double* sides = calloc(3 * (size_t)mesh.vertexCount, sizeof(double));
    Require(sides != NULL, "no memory");
    for (int i = 0; i < 9 * mesh.triangleCount; ++i) {
        const int32_t* corners = &mesh.indices[i / 9 * 3];
        double* side = &sides[3 * corners[i % 3]];
        const float* rest = &mesh.restPositions[2 * corners[i / 3 % 3]];
        side[0] += (double)rest[0];
        side[1] += (double)rest[1];
        side[2] += 1.0;
    }
    for (int i = 0; i < mesh.vertexCount; ++i) {
        double side[2] = { sides[3 * i] / sides[3 * i + 2], sides[3 * i + 1] / sides[3 * i + 2] };
        AddSample(&sums, reference, &mesh.restPositions[2 * i], side, &mesh.positions[3 * i]);
    }
    free(sides);
    return sqrt(sums.error / sums.way);
}

static void ReportBoth(const char* name, const Strip* strip, const Reference* reference, double target)
{
    Scene scene = MakeScene(strip);
    Settle(&scene, strip);
    Report(name, strip->frames, "frames", FrameError(&scene, reference), target, scene.milliseconds);
    Report(name, strip->frames, "vertices", VertexError(&scene, reference), 0.0, scene.milliseconds);
    kiriDestroyWorld(scene.world);
}

/* Mean displacement of the frames on the edge u = L. */
static double TipMove(const Scene* scene, const Strip* strip, int axis)
{
    kiriFrame ids[MAX_FRAMES];
    kiriFrameState states[MAX_FRAMES];
    double sum = 0.0;
    int count = GetFrames(scene, ids, states), tips = 0;
    for (int i = 0; i < count; ++i) {
        if (states[i].restPoint[0] > strip->length - 1e-6f) {
            sum += (double)states[i].position[axis] - (axis < 2 ? (double)states[i].restPoint[axis] : 0.0);
            ++tips;
        }
    }
    return sum / tips;
}

static double SettledTip(const Strip* strip, int axis, double* milliseconds)
{
    Scene scene = MakeScene(strip);
    Settle(&scene, strip);
    double move = TipMove(&scene, strip, axis);
    *milliseconds = scene.milliseconds;
    kiriDestroyWorld(scene.world);
    return move;
}

/* ---- Cases ------------------------------------------------------------------------------------------------------ */

/* 0.2 m x 0.05 m, with strong damping of the air: it goes to rest. */
static Strip MakeStrip(double young, double poisson, double thickness)
{
    Strip strip = { 0.2f,
                    0.05f,
                    0.0025f,
                    { (float)young, (float)poisson, (float)thickness, 1000.0f, 20.0f, 0.0f },
                    { 0.0f, 0.0f, (float)-G },
                    NULL,
                    0,
                    { 0.0f },
                    0 };
    return strip;
}

static void Cantilever(void)
{
    static const int frames[] = { 3, 5, 9, 17 };
    static const double targets[] = { 0.03, 0.01, 0.005, 0.0025 };
    static Elastica elastica;
    Strip strip = MakeStrip(5e8, 0.0, 5e-4);
    Reference reference = { &elastica, 0.2, NULL };
    Elastica_Solve(&elastica, 12.0 * 1000.0 * G * 0.2 * 0.2 * 0.2 / (5e8 * 5e-4 * 5e-4));
    for (int k = 0; k < COUNT(frames); ++k) {
        PlaceRows(&strip, frames[k], 1);
        ReportBoth("cantilever", &strip, &reference, targets[k]);
    }
}

/* The thickness makes gamma. */
static void MasterCurve(const char* folder)
{
    static Elastica elastica;
    static char names[32][32];
    char path[512], line[256];
    snprintf(path, sizeof path, "%s/cantilever_master_curve.csv", folder);
    FILE* file = fopen(path, "r");
    Require(file != NULL, "no cantilever_master_curve.csv");
    for (int k = 0; k < COUNT(names) && fgets(line, sizeof line, file) != NULL;) {
        double gamma, x, drop, milliseconds;
        if (sscanf(line, "%lf,%lf,%lf", &gamma, &x, &drop) == 3) {
            Elastica_Solve(&elastica, gamma);
            Require(fabs(elastica.drop[ELASTICA_STEPS] - drop) < 1e-8 && fabs(elastica.x[ELASTICA_STEPS] - x) < 1e-8,
                    "the elastica is wrong");
            Strip strip = MakeStrip(1e9, 0.0, sqrt(12.0 * 1000.0 * G * 0.2 * 0.2 * 0.2 / (1e9 * gamma)));
            PlaceRows(&strip, 17, 1);
            double tip = -SettledTip(&strip, 2, &milliseconds);
            snprintf(names[k], sizeof names[k], "gamma %.3g", gamma);
            Report(names[k], 17, "drop", fabs(tip / (0.2 * drop) - 1.0), gamma <= 100.0 ? 0.01 : 0.03, milliseconds);
            ++k;
        }
    }
    fclose(file);
}

static void WideCantilever(const char* folder)
{
    static const int frames[] = { 12, 24, 48 };
    static const double targets[] = { 0.04, 0.02, 0.01 };
    static Shell shell;
    char path[512];
    Strip strip = MakeStrip(7.438285638990287e8, 0.3, 5e-4);
    Reference reference = { NULL, 0.0, &shell };
    snprintf(path, sizeof path, "%s/cantilever_nu03.csv", folder);
    Require(Shell_Read(&shell, path, NULL, 0), "no cantilever_nu03.csv");
    for (int k = 0; k < COUNT(frames); ++k) {
        PlaceEvenly(&strip, frames[k]);
        ReportBoth("wide cantilever", &strip, &reference, targets[k]);
    }
}

/* Thick, so that it does not buckle out of its plane. Timoshenko's beam. */
static void PlaneBending(void)
{
    static const int rows[] = { 1, 2 };
    double E = 5e8, h = 5e-3, L = 0.2, W = 0.05, load = 1000.0 * h * W * G;
    double theory = load * L * L * L * L / (8.0 * E * h * W * W * W / 12.0);
    theory += load * L * L / (2.0 * 5.0 / 6.0 * E / 2.0 * h * W);
    Strip strip = MakeStrip(E, 0.0, h);
    strip.gravity[1] = (float)-G;
    strip.gravity[2] = 0.0f;
    for (int k = 0; k < COUNT(rows); ++k) {
        double milliseconds;
        PlaceRows(&strip, 9, rows[k]);
        double tip = -SettledTip(&strip, 1, &milliseconds);
        Report("plane bending", strip.frames, rows[k] == 1 ? "one row" : "two rows", fabs(tip / theory - 1.0), 0.03,
               milliseconds);
    }
}

static void Tension(void)
{
    static const int rows[] = { 1, 2 };
    double E = 1e6;
    Strip strip = MakeStrip(E, 0.0, 5e-4);
    strip.gravity[0] = (float)G;
    strip.gravity[2] = 0.0f;
    for (int k = 0; k < COUNT(rows); ++k) {
        double milliseconds;
        PlaceRows(&strip, 9, rows[k]);
        double tip = SettledTip(&strip, 0, &milliseconds);
        double error = fabs(tip / (1000.0 * G * 0.2 * 0.2 / (2.0 * E)) - 1.0);
        Report("tension", strip.frames, rows[k] == 1 ? "one row" : "two rows", error, 0.01, milliseconds);
    }
}

static void Tongue(const char* folder)
{
    static const float slit[] = { 0.05f, 0.0f, 0.05f, 0.07f, 0.08f, 0.07f };
    static const int frames[] = { 24, 35, 48 };
    static const double targets[] = { 0.10, 0.07, 0.04 };
    static Shell shell;
    char path[512];
    Strip strip = MakeStrip(7.438285638990287e8, 0.3, 5e-4);
    Reference reference = { NULL, 0.0, &shell };
    snprintf(path, sizeof path, "%s/tongue.csv", folder);
    Require(Shell_Read(&shell, path, slit, 3), "no tongue.csv");
    strip.length = strip.width = 0.1f;
    strip.slit = slit;
    strip.slitPoints = 3;
    for (int k = 0; k < COUNT(frames); ++k) {
        PlaceEvenly(&strip, frames[k]);
        ReportBoth("tongue", &strip, &reference, targets[k]);
    }
}

/* The time from the first to the fifth passage of the tip through the plane is two periods. */
static double Frequency(const Strip* strip, float dt, double* milliseconds)
{
    const float none[3] = { 0.0f, 0.0f, 0.0f };
    Scene scene = MakeScene(strip);
    for (int k = 0; k < 400; ++k) { /* steps this long take the energy out */
        kiriWorld_Tick(scene.world, 0.5f, 1);
    }
    kiriWorld_SetGravity(scene.world, none);
    double before = TipMove(&scene, strip, 2), first = 0.0, last = 0.0;
    clock_t start = clock();
    int passages = 0, ticks = 0;
    for (; passages < 5; ++ticks) {
        Require(ticks < 100 * MAX_TICKS && kiriWorld_Tick(scene.world, dt, 1) == KIRI_OK, "no oscillation");
        double now = TipMove(&scene, strip, 2);
        if (before * now < 0.0) {
            last = ((double)ticks + before / (before - now)) * (double)dt;
            first = ++passages == 1 ? last : first;
        }
        before = now;
    }
    *milliseconds = 1e3 * (double)(clock() - start) / CLOCKS_PER_SEC / ticks;
    kiriDestroyWorld(scene.world);
    return 2.0 / (last - first);
}

static void FirstMode(void)
{
    double E = 5e8, h = 5e-4, milliseconds = 0.0, found = 0.0, before;
    double theory = 1.8751041 * 1.8751041 / (2.0 * PI) * sqrt(E * h * h / (12.0 * 1000.0 * 0.2 * 0.2 * 0.2 * 0.2));
    float dt = 0.008f;
    Strip strip = MakeStrip(E, 0.0, h);
    strip.gravity[2] = -0.01f;
    strip.material.airDamping = 0.0f;
    PlaceRows(&strip, 9, 1);
    do {
        before = found;
        dt *= 0.5f;
        found = Frequency(&strip, dt, &milliseconds);
    } while (fabs(found / before - 1.0) > 5e-4);
    Report("first frequency", 9, "one row", fabs(found / theory - 1.0), 0.02, milliseconds);
}

/* accuracy [data folder] [output folder] */
int main(int argc, char** argv)
{
    const char* data = argc > 1 ? argv[1] : "tests/data";
    const char* output = argc > 2 ? argv[2] : "build/accuracy";
    printf("%-22s %6s  %-18s %11s  %9s    %8s\n", "case", "frames", "setting", "error", "target", "ms a tick");
    Cantilever();
    MasterCurve(data);
    WideCantilever(data);
    PlaneBending();
    Tension();
    Tongue(data);
    FirstMode();
    WriteTable(output);
    WritePlot(output);
    Require(Trade_Write(output), "cannot measure the trade of speed for accuracy");
    return 0;
}
