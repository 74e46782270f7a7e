/* Every number of a def over its documented range, one by one and together: what lies outside is refused, and what lies
   inside comes to an end. */
#define _XOPEN_SOURCE 700

#include "host.h"

#include <float.h>
#include <signal.h>
#include <stdio.h>
#include <sys/time.h>
#include <unistd.h>

enum { IS_SLOW = IS_SANITIZED };

/* ---- A guard against endless loops ---- */

enum { GUARD_SECONDS = 60, GUARD_BYTES = 512 };

/* What is being tried, for the guard. */
static char trial[GUARD_BYTES];

static void OnAlarm(int number)
{
    static const char what[] = "\nendless: ";
    ssize_t written = write(STDERR_FILENO, what, sizeof(what) - 1);
    written += write(STDERR_FILENO, trial, strlen(trial));
    _exit(written > 0 ? 1 : 2);
}

static void Name(const char* what)
{
    snprintf(trial, sizeof(trial), "%s", what);
}

static void NameMore(const char* name, double value)
{
    size_t used = strlen(trial);
    snprintf(trial + used, sizeof(trial) - used, " %s %g", name, value);
}

/* From here on so many seconds of the processor are too much, however busy the machine is. 0: as many as it takes. */
static void Guard(int seconds)
{
    setitimer(ITIMER_PROF, &(struct itimerval){ .it_value.tv_sec = seconds }, NULL);
}

/* ---- Fields ---- */

enum { MOST_GOOD = 7, MOST_BAD = 4 };

typedef struct Field {
    const char* name;
    size_t offset;
    bool isWhole;                          /* int32_t; else float */
    double good[MOST_GOOD], bad[MOST_BAD]; /* ended by END */
} Field;

#define END 1.25e-37
#define REAL(Type, field) #field, offsetof(Type, field), false
#define WHOLE(Type, field) #field, offsetof(Type, field), true
#define NO_NUMBER NAN, INFINITY

/* The material's numbers overflow at the far ends, and then sheets are put to rest; they must end all the same. */
static const Field sheetFields[] = {
    { REAL(kiriSheetDef, position[0]), { -1e6, 0.0, 3e37, END }, { FLT_MAX, NO_NUMBER, END } },
    { REAL(kiriSheetDef, position[2]), { -3e37, 1e3, END }, { -FLT_MAX, NO_NUMBER, END } },
    { REAL(kiriSheetDef, axisU[0]), { 0.9999, 1.0001, END }, { 0.0, 1.1, NO_NUMBER } },
    { REAL(kiriSheetDef, axisV[0]), { 0.0, 1e-4, END }, { 0.1, NO_NUMBER, END } },
    { REAL(kiriSheetDef, velocity[2]), { -3e37, -1.0, 1e4, END }, { -FLT_MAX, NO_NUMBER, END } },
    { REAL(kiriSheetDef, material.youngsModulus), { FLT_MIN, 1.0, 1e6, 1e12, FLT_MAX, END }, { 0.0, -1.0, NO_NUMBER } },
    { REAL(kiriSheetDef, material.poissonsRatio), { 0.0, 0.3, 0.4999, END }, { -1e-6, 0.5, NO_NUMBER } },
    { REAL(kiriSheetDef, material.thickness), { FLT_MIN, 1e-6, 0.1, FLT_MAX, END }, { 0.0, -1e-3, NO_NUMBER } },
    { REAL(kiriSheetDef, material.density), { FLT_MIN, 1.0, 2e4, FLT_MAX, END }, { 0.0, -1.0, NO_NUMBER } },
    { REAL(kiriSheetDef, material.airDamping), { 0.0, 1.0, 1e4, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, material.flexDamping), { 0.0, 0.01, 1e4, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, material.yieldStress), { 0.0, 1e-30, 1e5, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, material.hardening), { 0.0, 0.5, 0.9999999, END }, { -1e-6, 1.0, NAN, END } },
    { REAL(kiriSheetDef, material.slack), { 0.0, 0.5, 0.9999999, END }, { -1e-6, 1.0, NAN, END } },
    { WHOLE(kiriSheetDef, material.detail), { 0, 1, 16, END }, { -1, 17, END } },
    { REAL(kiriSheetDef, material.restCurvature[0]), { 0.0, -1e-3, 1e6, END }, { -1.1e6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, material.restCurvature[2]), { 0.0, -1e6, 50.0, END }, { 1.1e6, NO_NUMBER, END } },
    { WHOLE(kiriSheetDef, gridResolution), { 1, 2, 3, 7, 24, 64, END }, { 0, 4097, -1, END } },
    { REAL(kiriSheetDef, snapDistance), { 0.0, FLT_MIN, 1e-3, 0.1, 2.0, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, weldDistance), { 0.0, FLT_MIN, 1e-6, 1e-3, END }, { -1e-6, NO_NUMBER, END } },
    { WHOLE(kiriSheetDef, frameCount), { 0, 1, 2, 24, 500, 65536, END }, { -1, 65537, END } },
    { REAL(kiriSheetDef, frameLength), { 0.0, FLT_MIN, 0.01, 1.0, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, accuracy), { 1e-4f, 0.01, 1.0, END }, { 0.0, 0.99e-4, 1.01 } },
    { WHOLE(kiriSheetDef, maxFrames), { 1, 2, 20, 256, INT32_MAX, END }, { 0, -1, END } },
    { REAL(kiriSheetDef, rigidWeight), { FLT_MIN, 0.1, 0.5, 1.0, FLT_MAX, END }, { 0.0, -1.0, NO_NUMBER } },
    { REAL(kiriSheetDef, rigidArea), { 0.0, FLT_MIN, 1e-4, 1e-3, 0.005, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, crumbArea), { 0.0, FLT_MIN, 0.01, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, friction), { 0.0, FLT_MIN, 0.5, 2.0, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriSheetDef, contactThickness), { 0.0, FLT_MIN, 0.01, 1.0, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { WHOLE(kiriSheetDef, groups), { 0, 1, -1, INT32_MIN, END }, { END } },
    { WHOLE(kiriSheetDef, touchesSheets), { 0, 1, END }, { -1, 2, END } },
    { WHOLE(kiriSheetDef, collisionPoints), { 0, 1, 10, 1000, 1048576, END }, { -1, 1048577, END } },
    { WHOLE(kiriSheetDef, iterations), { 1, 5, 64, END }, { 0, 65, END } },
    { REAL(kiriSheetDef, sleepSpeed), { 0.0, FLT_MIN, 1.0, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { WHOLE(kiriSheetDef, model), { 0, 1, 2, END }, { -1, 3, END } },
    { WHOLE(kiriSheetDef, skinning), { 0, 1, END }, { -1, 2, END } },
    { WHOLE(kiriSheetDef, planar), { 0, 1, END }, { -1, 2, END } },
    { WHOLE(kiriSheetDef, timeStepping), { 0, 1, END }, { -1, 2, END } },
    { REAL(kiriSheetDef, fadeTime), { 0.0, FLT_MIN, 1.0, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { WHOLE(kiriSheetDef, normals), { 0, 1, END }, { -1, 2, END } },
};

static const Field paperFields[] = {
    { WHOLE(kiriPaperOptions, fromScratch), { 0, 1, END }, { -1, 2, END } },
    { WHOLE(kiriPaperOptions, popping), { 0, 1, END }, { -1, 2, END } },
    { WHOLE(kiriPaperOptions, linearWeights), { 0, 1, END }, { -1, 2, END } },
    { WHOLE(kiriPaperOptions, integrationPoints), { 0, 1, 7, 300, 1048576, END }, { -1, 1048577, END } },
    { WHOLE(kiriPaperOptions, integrationOrder), { 1, 2, END }, { 0, 3, END } },
};

static const Field pinFields[] = {
    { REAL(kiriPinDef, restPoint[0]), { 0.0, 0.31, 1.0, END }, { -0.01, 1.01, NO_NUMBER } },
    { REAL(kiriPinDef, target[1]), { -FLT_MAX, 0.0, 1e3, FLT_MAX, END }, { NO_NUMBER, END } },
    { REAL(kiriPinDef, stiffness), { 0.0, FLT_MIN, 1e4, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriPinDef, breakForce), { 0.0, FLT_MIN, 1e4, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
};

static const Field contactFields[] = {
    { WHOLE(kiriContact, point), { -1, 0, 1, END }, { -2, 1048577, END } },
    { REAL(kiriContact, velocity[0]), { -100.0, 0.0, 100.0, END }, { NO_NUMBER, END } },
    { REAL(kiriContact, normal[2]), { 0.9995, 1.0, 1.0005, END }, { 0.0, 2.0, NO_NUMBER } },
    { REAL(kiriContact, offset), { -FLT_MAX, 0.0, 0.1, FLT_MAX, END }, { NO_NUMBER, END } },
    { REAL(kiriContact, friction), { 0.0, 0.5, FLT_MAX, END }, { -1e-6, NO_NUMBER, END } },
    { REAL(kiriContact, inverseMass), { 0.0, FLT_MIN, 10.0, FLT_MAX }, { -1.0, NO_NUMBER, END } },
    { REAL(kiriContact, pushSpeed), { 0.0, FLT_MIN, 10.0, FLT_MAX }, { -1.0, NO_NUMBER, END } },
    { WHOLE(kiriContact, obstacle), { INT32_MIN, 0, INT32_MAX }, { END } },
};

static const Field worldFields[] = {
    { REAL(kiriWorldDef, gravity[0]), { -FLT_MAX, 0.0, 9.81, FLT_MAX, END }, { NO_NUMBER, END } },
    { WHOLE(kiriWorldDef, budget.triangles), { 0, 16, 17, INT32_MAX, END }, { -1, 1, 15, END } },
    { WHOLE(kiriWorldDef, budget.cells), { 0, 1, 50, INT32_MAX, END }, { -1, END } },
    { WHOLE(kiriWorldDef, budget.samples), { 0, 1, 50, INT32_MAX, END }, { -1, END } },
    { WHOLE(kiriWorldDef, budget.iterations), { 0, 1, 3, INT32_MAX, END }, { -1, END } },
};

typedef struct TickDef {
    float dt;
    int32_t substeps;
} TickDef;

static const Field tickFields[] = {
    { REAL(TickDef, dt), { 1e-6, 0.001, 1.0 / 60.0, 1.0, 10.0, END }, { 0.9e-6, 10.001, 0.0, NAN } },
    { WHOLE(TickDef, substeps), { 1, 2, 64, END }, { 0, 65, END } },
};

static void Set(void* def, const Field* field, double value)
{
    char* at = (char*)def + field->offset;
    int32_t whole = field->isWhole ? (int32_t)value : 0;
    float real = (float)value;
    memcpy(at, field->isWhole ? (const void*)&whole : (const void*)&real, 4);
}

static int32_t CountOf(const double* values, int32_t most)
{
    int32_t count = 0;
    while (count < most && values[count] != END) {
        ++count;
    }
    return count;
}

/* ---- A play: a world, a sheet, a pin, contacts, cuts, ticks ---- */

typedef struct Play {
    kiriWorldDef world;
    kiriSheetDef sheet;
    kiriPinDef pin;
    kiriContact contact;
    TickDef tick;
} Play;

/* What holds fields, and how many. */
enum { PARTS = 6 };

typedef struct Part {
    const Field* fields;
    int32_t count;
    void* def;
} Part;

#define FIELDS(fields) fields, (int32_t)(sizeof(fields) / sizeof(fields[0]))

static void ListParts(Play* play, Part parts[PARTS])
{
    const Part all[PARTS] = { { FIELDS(sheetFields), &play->sheet }, { FIELDS(paperFields), &play->sheet.paper },
                              { FIELDS(pinFields), &play->pin },     { FIELDS(contactFields), &play->contact },
                              { FIELDS(worldFields), &play->world }, { FIELDS(tickFields), &play->tick } };
    memcpy(parts, all, sizeof(all));
}

static void Play_Init(Play* play, Host* host)
{
    static const kiriContact contact = {
        .point = 0, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.01f, .friction = 0.3f
    };
    memset(host, 0, sizeof(*host));
    host->failAt = -1;
    play->world = Host_Def(host);
    play->sheet = DefaultSheet();
    kiriDefaultPinDef(&play->pin);
    play->sheet.gridResolution = 8;
    play->sheet.collisionPoints = 5;
    play->contact = contact;
    play->tick.dt = 1.0f / 60.0f;
    play->tick.substeps = 1;
}

static void GiveCuts(Host* host, kiriSheet sheet, float height)
{
    float line[8] = { -0.1f, 0.4f * height, 0.4f, 0.6f * height, 0.7f, 0.3f * height, 1.1f, 0.5f * height };
    float loop[10] = { 0.55f,         0.6f * height, 0.8f,          0.6f * height, 0.8f,
                       0.9f * height, 0.55f,         0.9f * height, 0.55f,         0.6f * height };
    Host_Cut(host, sheet, line, 4);
    Host_Cut(host, sheet, loop, 5);
}

/* Ticks, at most so many, until no cut waits. */
static void TickOn(Host* host, const TickDef* tick, int most)
{
    kiriResult result = KIRI_PENDING;
    for (int i = 0; i < most && (i < 2 || result == KIRI_PENDING); ++i) {
        Guard(GUARD_SECONDS);
        result = kiriWorld_Tick(host->world, tick->dt, tick->substeps);
        if (result < 0 && result != KIRI_DIVERGED) {
            fail_msg("%s: a tick gives %s", trial, kiriGetResultName(result));
        }
    }
}

/* Returns the first result that is a failure. */
static kiriResult Play_Use(Play* play, Host* host, kiriSheet sheet)
{
    float height = play->sheet.restPositions[2 * play->sheet.vertexCount - 1];
    kiriPin pin;
    Guard(GUARD_SECONDS);
    kiriResult result = kiriCreatePin(host->world, sheet, &play->pin, &pin);
    if (result >= 0 && Host_Counts(host, sheet).collisionPoints > 1) {
        result = kiriSheet_SetContacts(host->world, sheet, &play->contact, 1);
    }
    if (result < 0) {
        return result;
    }
    result = kiriWorld_Tick(host->world, play->tick.dt, play->tick.substeps);
    if (result < 0 && result != KIRI_DIVERGED) {
        return result;
    }
    GiveCuts(host, sheet, height);
    TickOn(host, &play->tick, 40);
    GiveCuts(host, sheet, 0.3f * height);
    TickOn(host, &play->tick, 4);
    return KIRI_OK;
}

static kiriResult Play_Run(Play* play, Host* host)
{
    kiriSheet sheet;
    Guard(GUARD_SECONDS);
    kiriResult result = kiriCreateWorld(&play->world, &host->world);
    if (result == KIRI_OK) {
        result = kiriCreateSheet(host->world, &play->sheet, &sheet);
        result = result == KIRI_OK ? Play_Use(play, host, sheet) : result;
        Guard(GUARD_SECONDS);
        Host_Stop(host);
    }
    Guard(0);
    return result;
}

/* A square, or a strip that few squares of the grid cover. */
static Rectangle MeshFor(kiriSheetDef* def, bool isStrip)
{
    return isStrip ? Rectangle_Make(def, 1.0f, 0.01f, 100, 1) : Rectangle_Make(def, 1.0f, 1.0f, 4, 4);
}

/* ---- Tests ---- */

/* All else as it is by default. */
static void TryField(int32_t part, int32_t index, bool isStrip)
{
    Play play;
    Host host;
    Part parts[PARTS];
    ListParts(&play, parts);
    const Field* field = &parts[part].fields[index];
    int32_t good = CountOf(field->good, MOST_GOOD), all = good + CountOf(field->bad, MOST_BAD);
    for (int32_t k = 0; k < all; ++k) {
        double value = k < good ? field->good[k] : field->bad[k - good];
        Play_Init(&play, &host);
        SCOPED_AS(Rectangle, mesh, Rectangle_Free) = MeshFor(&play.sheet, isStrip);
        Set(parts[part].def, field, value);
        Name(isStrip ? "strip:" : "square:");
        NameMore(field->name, value);
        kiriResult result = Play_Run(&play, &host);
        if (result != (k < good ? KIRI_OK : KIRI_ERROR_ARGUMENT)) {
            fail_msg("%s gives %s", trial, kiriGetResultName(result));
        }
    }
}

TEST(OneByOne)
{
    Play play;
    Part parts[PARTS];
    ListParts(&play, parts);
    for (int32_t part = 0; part < PARTS; ++part) {
        for (int32_t i = 0; i < parts[part].count; ++i) {
            TryField(part, i, false);
            if (!IS_SLOW) {
                TryField(part, i, true);
            }
        }
    }
}

/* Some of the fields, each at one of its values. */
static void SetAtRandom(Part parts[PARTS], uint32_t* seed)
{
    uint32_t odds = 3 + Random(seed) % 8;
    for (int32_t part = 0; part < PARTS; ++part) {
        for (int32_t i = 0; i < parts[part].count; ++i) {
            const Field* field = &parts[part].fields[i];
            if (Random(seed) % odds == 0) {
                double value = field->good[Random(seed) % (uint32_t)CountOf(field->good, MOST_GOOD)];
                Set(parts[part].def, field, value);
                NameMore(field->name, value);
            }
        }
    }
}

/* The most expensive combinations have nothing to do with one another. */
static void Restrain(Play* play)
{
    kiriSheetDef* def = &play->sheet;
    if (def->gridResolution > 24) {
        def->maxFrames = def->maxFrames < 40 ? def->maxFrames : 40;
        def->frameCount = def->frameCount < 40 ? def->frameCount : 40;
        play->sheet.paper.integrationPoints =
            play->sheet.paper.integrationPoints < 300 ? play->sheet.paper.integrationPoints : 300;
    }
    if (play->tick.substeps * def->iterations > 64) {
        def->iterations = 1;
    }
}

TEST(AtRandom)
{
    int32_t accepted = 0, runs = IS_SLOW ? 60 : 250;
    for (int32_t run = 1; run <= runs; ++run) {
        uint32_t seed = 2654435761u * (uint32_t)run;
        Play play;
        Host host;
        Part parts[PARTS];
        Play_Init(&play, &host);
        ListParts(&play, parts);
        SCOPED_AS(Rectangle, mesh, Rectangle_Free) = MeshFor(&play.sheet, run % 3 == 0);
        Name("at random:");
        SetAtRandom(parts, &seed);
        play.pin.restPoint[1] = 0.0f;
        Restrain(&play);
        kiriResult result = Play_Run(&play, &host);
        if (result != KIRI_OK && result != KIRI_ERROR_ARGUMENT) {
            fail_msg("%s gives %s", trial, kiriGetResultName(result));
        }
        accepted += result == KIRI_OK;
    }
    print_message("%d of %d combinations accepted\n", accepted, runs);
    assert_true(accepted > runs / 2);
}

/* More frames are wanted than the grid carries: at once, which is refused, or by re-sampling, which stops. */
TEST(MoreFramesThanCells)
{
    static const struct {
        int32_t grid, frames, most;
        float rigidArea;
        bool isStrip;
    } cases[] = {
        { 1, 5, 256, 0.0f, false },  { 2, 5, 256, 0.0f, false },   { 8, 5, 256, 1e-4f, false },
        { 1, 1, 256, 1e-6f, false }, { 2, 2, 256, 1e-6f, false },  { 3, 4, 256, 1e-6f, false },
        { 4, 5, 20, 1e-3f, false },  { 96, 24, 256, 0.0f, true },  { 1, 65536, 65536, 1e-6f, false },
        { 8, 65536, 256, 0, false }, { 8, 0, INT32_MAX, 0, true },
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
        Play play;
        Host host;
        Play_Init(&play, &host);
        SCOPED_AS(Rectangle, mesh, Rectangle_Free) = MeshFor(&play.sheet, cases[i].isStrip);
        play.sheet.gridResolution = cases[i].grid;
        play.sheet.frameCount = cases[i].frames;
        play.sheet.maxFrames = cases[i].most;
        play.sheet.rigidArea = cases[i].rigidArea;
        Name("more frames than cells:");
        NameMore("case", (double)i);
        OK(Play_Run(&play, &host));
    }
}

/* In a tick: a strip is cut off and destroyed, then a single cell is cut out. */
TEST(SingleCellCutOut)
{
    static const float strip[4] = { 0.3f, -0.1f, 0.3f, 1.1f };
    static const float cell[10] = { 0.626f, 0.626f, 0.749f, 0.626f, 0.749f, 0.749f, 0.626f, 0.749f, 0.626f, 0.626f };
    Play play;
    Host host;
    kiriEvent event = { .type = 0 };
    Play_Init(&play, &host);
    Name("a single cell cut out");
    Guard(GUARD_SECONDS);
    OK(kiriCreateWorld(&play.world, &host.world));
    play.sheet.maxFrames = 30;
    play.sheet.rigidArea = 0.005f;
    kiriSheet sheet = Host_AddRectangle(&host, &play.sheet, 1.0f, 1.0f, 8, 8);
    Host_Cut(&host, sheet, strip, 2);
    OK(kiriWorld_Tick(host.world, 0.01f, 1));
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIECE_OFF, &event), 1);
    OK(kiriFrame_DestroyPiece(host.world, event.frame));
    Host_Cut(&host, sheet, cell, 5);
    OK(kiriWorld_Tick(host.world, 0.01f, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    Host_Stop(&host);
    Guard(0);
}

/* The finest grid, the most frames and points, each on a sheet that they do not make large. */
TEST(TheMost)
{
    for (int what = 0; what < (IS_SLOW ? 1 : 4); ++what) {
        Play play;
        Host host;
        Play_Init(&play, &host);
        SCOPED_AS(Rectangle, mesh, Rectangle_Free) = MeshFor(&play.sheet, what == 0);
        play.sheet.gridResolution = what == 0 ? 4096 : 64;
        play.sheet.frameCount = what == 1 ? 64 * 64 / 2 : 4;
        play.sheet.collisionPoints = what == 2 ? 1048576 : 0;
        play.sheet.model = what == 3 ? KIRI_MODEL_POINTS : KIRI_MODEL_LINKS;
        play.sheet.paper.integrationPoints = what == 3 ? 1048576 : 0;
        Name("the most:");
        NameMore("case", (double)what);
        OK(Play_Run(&play, &host));
    }
}

SETUP
{
    signal(SIGPROF, OnAlarm);
}
