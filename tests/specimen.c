#define _POSIX_C_SOURCE 199309L /* clock_gettime */

#include "defaults.h"
#include "specimen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double PI = 3.14159265358979323846;

void Require(bool ok, const char* what)
{
    if (!ok) {
        fprintf(stderr, "accuracy: %s\n", what);
        exit(1);
    }
}

double ProcessorTime(void* user)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- Making ----------------------------------------------------------------------------------------------------- */

SpecimenDef Specimen_Strip(double young, double poisson, double thickness)
{
    SpecimenDef def;
    memset(&def, 0, sizeof def);
    def.length = 0.2;
    def.width = 0.05;
    def.grid = def.columns = 80;
    def.material = (kiriMaterial){ (float)young, (float)poisson, (float)thickness, 1000.0f, 20.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.model = KIRI_MODEL_LINKS;
    def.iterations = 4;
    def.timeStepping = KIRI_TIME_STEPPING_EULER;
    return def;
}

static SpecimenMesh Rectangle(const SpecimenDef* def)
{
    SpecimenMesh mesh;
    double side = fmax(def->length, def->width) / (def->columns > 0 ? def->columns : def->grid);
    int columns = (int)(def->length / side + 0.5), rows = (int)(def->width / side + 0.5);
    mesh.vertexCount = (columns + 1) * (rows + 1);
    mesh.triangleCount = 2 * columns * rows;
    mesh.restPositions = malloc(2 * sizeof(float) * (size_t)mesh.vertexCount);
    mesh.indices = malloc(3 * sizeof(int32_t) * (size_t)mesh.triangleCount);
    Require(mesh.restPositions != NULL && mesh.indices != NULL, "no memory");
    kiriFillRectangle((float)def->length, (float)def->width, columns, rows, mesh.restPositions, mesh.indices);
    return mesh;
}

static kiriWorld* MakeWorld(void)
{
    kiriWorld* world = NULL;
    kiriWorldDef def = DefaultWorld();
    memset(def.gravity, 0, sizeof def.gravity);
    Require(kiriCreateWorld(&def, &world) == KIRI_OK, "no world");
    return world;
}

static kiriSheetDef SheetDef(const SpecimenDef* from)
{
    kiriSheetDef def = DefaultSheet();
    def.sleepSpeed = 0.0f;
    def.material = from->material;
    def.gridResolution = from->grid;
    def.frameCount = from->layout.count > 0 ? from->layout.count : from->frames;
    def.framePoints = from->layout.count > 0 ? from->layout.points : NULL;
    def.maxFrames = def.frameCount > 0 ? def.frameCount : MAX_FRAMES; /* nothing is added later */
    def.accuracy = from->accuracy > 0.0 ? (float)from->accuracy : def.accuracy;
    def.rigidWeight = 2.0f;
    def.iterations = from->iterations;
    def.model = from->model;
    def.planar = from->planar;
    def.timeStepping = from->timeStepping;
    return def;
}

static void CutSlit(kiriWorld* world, kiriSheet sheet, const Slit* slit)
{
    kiriCut cut;
    float outside[2] = { slit->points[0], slit->points[1] };
    outside[1] += slit->points[1] > 0.0f ? 0.01f : -0.01f;
    Require(kiriBeginCut(world, sheet, outside, &cut) == KIRI_OK, "no cut");
    Require(kiriCut_Extend(world, cut, slit->points, slit->count) == KIRI_OK && kiriCut_End(world, cut) == KIRI_OK,
            "no cut");
    Require(kiriWorld_Tick(world, 1e-3f, 1) == KIRI_OK, kiriWorld_GetLastError(world));
}

static bool Create(Specimen* specimen, const SpecimenDef* from, const SpecimenMesh* mesh)
{
    kiriSheetDef def = SheetDef(from);
    def.restPositions = mesh->restPositions;
    def.vertexCount = mesh->vertexCount;
    def.indices = mesh->indices;
    def.triangleCount = mesh->triangleCount;
    specimen->world = MakeWorld();
    specimen->size = fmax(from->length, from->width);
    kiriResult result = kiriCreateSheet(specimen->world, &def, &specimen->sheet);
    if (result != KIRI_OK) {
        printf("%d frames, grid %d: refused; %s\n", def.frameCount, from->grid,
               kiriWorld_GetLastError(specimen->world));
        kiriDestroyWorld(specimen->world);
    }
    return result == KIRI_OK;
}

/* A mesh with the slits as open edges: so frames that are spread know them. */
static SpecimenMesh MeshWithSlits(const SpecimenDef* def, const SpecimenMesh* whole)
{
    Specimen scratch;
    SpecimenDef one = *def;
    SpecimenMesh copy;
    kiriMesh mesh;
    one.layout.count = 0;
    one.frames = 1;
    Require(Create(&scratch, &one, whole), "a sheet with one frame is refused");
    for (int k = 0; k < def->slitCount; ++k) {
        CutSlit(scratch.world, scratch.sheet, &def->slits[k]);
    }
    kiriSheet_GetMesh(scratch.world, scratch.sheet, &mesh);
    copy.vertexCount = mesh.vertexCount;
    copy.triangleCount = mesh.triangleCount;
    copy.restPositions = malloc(2 * sizeof(float) * (size_t)mesh.vertexCount);
    copy.indices = malloc(3 * sizeof(int32_t) * (size_t)mesh.triangleCount);
    Require(copy.restPositions != NULL && copy.indices != NULL, "no memory");
    memcpy(copy.restPositions, mesh.restPositions, 2 * sizeof(float) * (size_t)mesh.vertexCount);
    memcpy(copy.indices, mesh.indices, 3 * sizeof(int32_t) * (size_t)mesh.triangleCount);
    kiriDestroyWorld(scratch.world);
    return copy;
}

static void FreeMesh(SpecimenMesh* mesh)
{
    free(mesh->restPositions);
    free(mesh->indices);
}

Specimen* Specimen_Create(const SpecimenDef* def)
{
    Specimen* specimen = calloc(1, sizeof *specimen);
    Require(specimen != NULL, "no memory");
    SpecimenMesh own = { NULL, NULL, 0, 0 }, cut = own;
    const SpecimenMesh* mesh = def->mesh;
    if (mesh == NULL) {
        own = Rectangle(def);
        mesh = &own;
    }
    if (def->slitCount > 0) {
        cut = MeshWithSlits(def, mesh);
        mesh = &cut;
    }
    bool created = Create(specimen, def, mesh);
    FreeMesh(&own);
    FreeMesh(&cut);
    if (!created) {
        free(specimen);
        return NULL;
    }
    Specimen_SetGravity(specimen, def->gravity);
    Specimen_Look(specimen);
    return specimen;
}

void Specimen_Destroy(Specimen* specimen)
{
    kiriDestroyWorld(specimen->world);
    free(specimen);
}

/* ---- Loads ------------------------------------------------------------------------------------------------------ */

void Specimen_Look(Specimen* specimen)
{
    int32_t count = 0;
    kiriSheet_GetFrames(specimen->world, specimen->sheet, specimen->ids, MAX_FRAMES, &count);
    Require(count <= MAX_FRAMES, "too many frames");
    for (int i = 0; i < count; ++i) {
        Require(kiriFrame_GetState(specimen->world, specimen->ids[i], &specimen->states[i]) == KIRI_OK, "no frame");
    }
    specimen->count = count;
}

void Specimen_HoldLine(Specimen* specimen, double u)
{
    Specimen_Look(specimen);
    for (int i = 0; i < specimen->count; ++i) {
        const kiriFrameState* s = &specimen->states[i];
        if (fabs((double)s->restPoint[0] - u) < 1e-6 * specimen->size) {
            kiriFrame_Hold(specimen->world, specimen->ids[i], s->position, s->rotation);
        }
    }
}

kiriPin Specimen_Clamp(Specimen* specimen, double fromU, double fromV, double toU, double toV)
{
    const float from[2] = { (float)fromU, (float)fromV }, to[2] = { (float)toU, (float)toV };
    kiriPin clamp = 0;
    Require(kiriSheet_ClampLine(specimen->world, specimen->sheet, from, to, &clamp) == KIRI_OK,
            kiriWorld_GetLastError(specimen->world));
    return clamp;
}

kiriPin Specimen_ClampEnd(Specimen* specimen, const SpecimenDef* def, double u)
{
    return Specimen_Clamp(specimen, u, 0.0, u, def->width);
}

/* From where it was made: the sheet was level then. */
void Specimen_MoveClamp(Specimen* specimen, kiriPin clamp, const double shift[3])
{
    kiriPinState state;
    float target[3];
    Require(kiriPin_GetState(specimen->world, clamp, &state) == KIRI_OK, "no clamp");
    for (int k = 0; k < 3; ++k) {
        double rest = k < 2 ? 0.5 * ((double)state.from[k] + (double)state.to[k]) : 0.0;
        target[k] = (float)(rest + shift[k]);
    }
    kiriPin_SetTarget(specimen->world, clamp, target);
}

void Specimen_Reaction(const Specimen* specimen, kiriPin clamp, double force[3])
{
    double torque[3];
    Require(kiriPin_GetReaction(specimen->world, clamp, force, torque) == KIRI_OK, "no reaction");
}

void Specimen_SetGravity(Specimen* specimen, const double gravity[3])
{
    float g[3] = { (float)gravity[0], (float)gravity[1], (float)gravity[2] };
    kiriWorld_SetGravity(specimen->world, g);
}

void Specimen_Cut(Specimen* specimen, const Slit* slit)
{
    CutSlit(specimen->world, specimen->sheet, slit);
}

/* The vertex nearest to a rest point. */
void Specimen_At(Specimen* specimen, double u, double v, double position[3])
{
    kiriMesh mesh;
    double least = 1e30;
    kiriSheet_GetMesh(specimen->world, specimen->sheet, &mesh);
    for (int i = 0; i < mesh.vertexCount; ++i) {
        double du = (double)mesh.restPositions[2 * i] - u, dv = (double)mesh.restPositions[2 * i + 1] - v;
        if (du * du + dv * dv < least) {
            least = du * du + dv * dv;
            for (int k = 0; k < 3; ++k) {
                position[k] = (double)mesh.positions[3 * i + k];
            }
        }
    }
}

static void ApplyLoad(Specimen* specimen)
{
    const Load* load = &specimen->load;
    bool isPoint = load->from[0] == load->to[0] && load->from[1] == load->to[1];
    if (specimen->loaded) {
        kiriResult result =
            isPoint ? kiriSheet_ApplyForce(specimen->world, specimen->sheet, load->from, load->force, load->torque)
                    : kiriSheet_ApplyLineLoad(specimen->world, specimen->sheet, load->from, load->to, load->force);
        Require(result == KIRI_OK, kiriWorld_GetLastError(specimen->world));
    }
}

/* ---- Rest ------------------------------------------------------------------------------------------------------- */

enum { MAX_TICKS = 6000 };

/* The largest way that a frame went in it, m. */
static double Tick(Specimen* specimen, double dt)
{
    double largest = 0.0;
    ApplyLoad(specimen);
    Require(kiriWorld_Tick(specimen->world, (float)dt, 1) == KIRI_OK, kiriWorld_GetLastError(specimen->world));
    for (int i = 0; i < specimen->count; ++i) {
        kiriFrameState now;
        kiriFrame_GetState(specimen->world, specimen->ids[i], &now);
        double way = 0.0;
        for (int k = 0; k < 3; ++k) {
            double d = (double)now.position[k] - (double)specimen->states[i].position[k];
            way += d * d;
        }
        specimen->states[i] = now;
        largest = fmax(largest, sqrt(way));
    }
    return largest;
}

/* A sheet is at rest when no frame is faster than this many sizes a second. Positions are floats: less than LEAST_WAY
   sizes a tick is not seen. */
static const double REST_SPEED = 1e-6, LEAST_WAY = 3e-7;

/* Steps grow, so that inertia and the air's damping hardly hold the sheet. A limp one does not bear steps of a second:
   where it keeps going farther than in the tick before, the longest step becomes shorter. */
void Specimen_Settle(Specimen* specimen)
{
    double dt = 0.05, longest = 1.0, before = 1.0;
    int calm = 0, ticks = 0, rises = 0;
    Specimen_Look(specimen);
    double start = ProcessorTime(NULL);
    for (; calm < 3; ++ticks) {
        Require(ticks < MAX_TICKS, "a sheet does not come to rest");
        double way = Tick(specimen, dt) / specimen->size;
        calm = dt >= longest && way < fmax(REST_SPEED * dt, LEAST_WAY) ? calm + 1 : 0;
        rises += way > before && way > 1e-4 && dt >= longest ? 1 : 0;
        if (rises > 4 || ticks % 500 == 499) {
            longest = fmax(0.05, 0.25 * longest);
            rises = 0;
        }
        dt = fmin(longest, way < 0.01 ? 1.4 * dt : dt);
        before = way;
    }
    specimen->milliseconds = 1e3 * (ProcessorTime(NULL) - start) / ticks;
}

/* ---- Vibration -------------------------------------------------------------------------------------------------- */

static void Normalize(double a[3])
{
    double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int k = 0; k < 3; ++k) {
        a[k] /= length;
    }
}

/* Columns of the rotation whose normal is (-slope, 1). */
static void RotationOf(const double slope[2], float rotation[9])
{
    double d[3] = { -slope[0], -slope[1], 1.0 }, u[3] = { 1.0, 0.0, slope[0] };
    Normalize(d);
    Normalize(u);
    double v[3] = { d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0] };
    for (int k = 0; k < 3; ++k) {
        rotation[k] = (float)u[k];
        rotation[3 + k] = (float)v[k];
        rotation[6 + k] = (float)d[k];
    }
}

/* The frames that are free now; 1 in `moves`. */
static void TakeShape(Specimen* specimen, ShapeFunction* shape, const void* data, double amplitude, char* moves)
{
    for (int i = 0; i < specimen->count; ++i) {
        const kiriFrameState* s = &specimen->states[i];
        double w[3], slope[2];
        float to[3] = { s->restPoint[0], s->restPoint[1], 0.0f }, rotation[9];
        moves[i] = !s->held;
        shape(data, (double)s->restPoint[0], (double)s->restPoint[1], w);
        slope[0] = amplitude * w[1];
        slope[1] = amplitude * w[2];
        to[2] = (float)(amplitude * w[0]);
        RotationOf(slope, rotation);
        if (moves[i]) {
            Require(kiriFrame_Hold(specimen->world, specimen->ids[i], to, rotation) == KIRI_OK, "no hold");
        }
    }
}

/* How far it is in the shape, by the mass of the frames and, for their leaning, that of squares as large as their
   regions. */
static double Share(Specimen* specimen, ShapeFunction* shape, const void* data)
{
    double sum = 0.0;
    Specimen_Look(specimen);
    for (int i = 0; i < specimen->count; ++i) {
        const kiriFrameState* s = &specimen->states[i];
        double w[3], z = (double)s->position[2], lean[2] = { -(double)s->rotation[6], -(double)s->rotation[7] };
        shape(data, (double)s->restPoint[0], (double)s->restPoint[1], w);
        sum += (double)s->mass * (w[0] * z + (double)s->area / 12.0 * (w[1] * lean[0] + w[2] * lean[1]));
    }
    return sum;
}

static void LetGo(Specimen* specimen, const char* moves)
{
    for (int i = 0; i < specimen->count; ++i) {
        if (moves[i]) {
            kiriFrame_Hold(specimen->world, specimen->ids[i], NULL, NULL);
        }
    }
}

static void SwingTick(Specimen* specimen, double dt)
{
    Require(kiriWorld_Tick(specimen->world, (float)dt, 1) == KIRI_OK, kiriWorld_GetLastError(specimen->world));
}

/* Two periods in long steps, which take the other modes out more than this one. */
static void Purify(Specimen* specimen, double period)
{
    for (int tick = 0; tick < 100; ++tick) {
        SwingTick(specimen, period / 50.0);
    }
}

/* From the first passage to the third. */
static double MeasurePeriod(Specimen* specimen, ShapeFunction* shape, const void* data, double dt)
{
    double before = Share(specimen, shape, data), first = 0.0, last = 0.0, start = ProcessorTime(NULL);
    int passages = 0, ticks = 0;
    for (; passages < 3; ++ticks) {
        Require(ticks < MAX_TICKS, "no oscillation");
        SwingTick(specimen, dt);
        double now = Share(specimen, shape, data);
        if (before * now < 0.0) {
            last = ((double)ticks + before / (before - now)) * dt;
            first = ++passages == 1 ? last : first;
        }
        before = now;
    }
    specimen->milliseconds = 1e3 * (ProcessorTime(NULL) - start) / ticks;
    return last - first;
}

double Specimen_Frequency(Specimen* specimen, ShapeFunction* shape, const void* data, double amplitude, double guess)
{
    static char moves[MAX_FRAMES];
    const double period = 2.0 * PI / guess;
    Specimen_Look(specimen);
    TakeShape(specimen, shape, data, amplitude, moves);
    Tick(specimen, period / 50.0);
    Tick(specimen, period / 50.0);
    LetGo(specimen, moves);
    Purify(specimen, period);
    return 2.0 * PI / MeasurePeriod(specimen, shape, data, period / 200.0);
}
