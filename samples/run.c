/* Runs a scene, writes its pictures, and prints what the library did and how long it took. */
#define _POSIX_C_SOURCE 199309L

#include "debug.h"
#include "draw.h"
#include "image.h"
#include "scene.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum { SHEET_COLUMNS = 4, SHEET_ROWS = 2, SHEET_GAP = 4, MAX_BLADES = 4, LAST_DELAY = 60 };

/* ---- Options ---------------------------------------------------------------------------------------------------- */

typedef struct Options {
    const char* scene;
    const char* output;
    const char* data;
    const char* film;
    DebugOptions debug;
    int32_t ticks, every, width, height, grid, controlFrames, budget;
    int32_t solid;    /* mm; 0: the surface alone */
    float closeUp[3]; /* rest point, m, and factor; factor 0: as the scene has it */
    bool axes, plain, asPaper, smooth, quiet, help;
} Options;

static void PrintHelp(void)
{
    printf("kiri-run: runs a scene and writes its pictures\n\n"
           "  --scene NAME          which scene\n"
           "  --output FOLDER       where the pictures go (build/pictures)\n"
           "  --film FILE           a moving picture of them too, an animated PNG\n"
           "  --data FOLDER         where the outlines are (samples/data)\n"
           "  --ticks N             sixtieths of a second to run (the scene's own)\n"
           "  --size WxH            of a picture, in pixels, 100x100 or more (640x480)\n"
           "  --every N             ticks from picture to picture (2); 0: no pictures\n"
           "  --grid N              grid squares along the sheet (the scene's own)\n"
           "  --control-frames N    control frames at the start (the scene's own)\n"
           "  --budget N            blade points taken in one tick; 0: no limit (0)\n"
           "  --zoom U,V,FACTOR     a close-up of the rest point, in sizes of the scene\n"
           "  --paper               mesh, grid and frames of the paper's table 1\n"
           "  --smooth              smooth skinning\n"
           "  --solid N             show the sheet N mm thick, with its rims\n"
           "  --plain               rigid frames, free in space, in scenes that have others\n"
           "  --frames-axes         show the control frames\n"
           "  --weights all|N       colour the sheet by the shape functions of all frames, or of frame N\n"
           "  --regions             show where each frame has the largest weight\n"
           "  --links               show which regions touch\n"
           "  --cells               show the grid, and which of its squares the cuts divide\n"
           "  --points              show the collision points\n"
           "  --quiet               no progress line\n"
           "  --help\n\nScenes:\n");
    for (int32_t i = 0; Scene_GetType(i) != NULL; i++) {
        printf("  %-10s %s\n", Scene_GetType(i)->name, Scene_GetType(i)->about);
    }
}

static bool ReadNumber(const char* text, int32_t low, int32_t high, int32_t* number)
{
    char* end;
    long value = strtol(text, &end, 10);
    *number = (int32_t)value;
    return end != text && *end == 0 && value >= low && value <= high;
}

static bool ReadSize(const char* text, Options* options)
{
    char rest;
    return sscanf(text, "%d x %d%c", &options->width, &options->height, &rest) == 2 && options->width >= 100 &&
           options->height >= 100 && options->width <= 4096 && options->height <= 4096;
}

static bool ReadCloseUp(const char* text, Options* options)
{
    char rest;
    float* at = options->closeUp;
    return sscanf(text, "%f,%f,%f%c", &at[0], &at[1], &at[2], &rest) == 3 && at[2] >= 1.0f && at[2] <= 100.0f;
}

static bool ReadFlag(const char* name, Options* options)
{
    const struct {
        const char* name;
        bool* flag;
    } flags[] = { { "--help", &options->help },           { "--quiet", &options->quiet },
                  { "--frames-axes", &options->axes },    { "--regions", &options->debug.regions },
                  { "--links", &options->debug.links },   { "--cells", &options->debug.cells },
                  { "--points", &options->debug.points }, { "--plain", &options->plain },
                  { "--smooth", &options->smooth },       { "--paper", &options->asPaper } };
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        if (strcmp(name, flags[i].name) == 0) {
            *flags[i].flag = true;
            return true;
        }
    }
    return false;
}

static bool ReadWeights(const char* text, Options* options)
{
    if (strcmp(text, "all") == 0) {
        options->debug.weightsOf = DEBUG_ALL_FRAMES;
        return true;
    }
    return ReadNumber(text, 0, DEBUG_MAX_FRAMES - 1, &options->debug.weightsOf);
}

static bool ReadValue(const char* name, const char* value, Options* options)
{
    if (strcmp(name, "--scene") == 0) {
        options->scene = value;
        return Scene_FindType(value) != NULL;
    } else if (strcmp(name, "--output") == 0) {
        options->output = value;
        return true;
    } else if (strcmp(name, "--film") == 0) {
        options->film = value;
        return true;
    } else if (strcmp(name, "--data") == 0) {
        options->data = value;
        return true;
    } else if (strcmp(name, "--weights") == 0) {
        return ReadWeights(value, options);
    } else if (strcmp(name, "--size") == 0) {
        return ReadSize(value, options);
    } else if (strcmp(name, "--zoom") == 0) {
        return ReadCloseUp(value, options);
    } else if (strcmp(name, "--ticks") == 0) {
        return ReadNumber(value, 1, 100000, &options->ticks);
    } else if (strcmp(name, "--every") == 0) {
        return ReadNumber(value, 0, 100000, &options->every);
    } else if (strcmp(name, "--grid") == 0) {
        return ReadNumber(value, 1, 4096, &options->grid);
    } else if (strcmp(name, "--control-frames") == 0) {
        return ReadNumber(value, 1, DEBUG_MAX_FRAMES, &options->controlFrames);
    }
    if (strcmp(name, "--solid") == 0) {
        return ReadNumber(value, 1, 1000, &options->solid);
    }
    if (strcmp(name, "--budget") == 0) {
        return ReadNumber(value, 0, 1 << 24, &options->budget);
    }
    return false;
}

static bool ReadOptions(int count, char** words, Options* options)
{
    for (int i = 1; i < count; i++) {
        if (ReadFlag(words[i], options)) {
            continue;
        } else if (i + 1 < count && ReadValue(words[i], words[i + 1], options)) {
            i++;
        } else {
            fprintf(stderr, "kiri-run: not understood: %s %s\n", words[i], i + 1 < count ? words[i + 1] : "");
            return false;
        }
    }
    if (options->film != NULL && options->every == 0) {
        fprintf(stderr, "kiri-run: --film without pictures: --every 0\n");
        return false;
    }
    return true;
}

static bool MakeFolders(const char* path)
{
    char part[1024];
    for (size_t i = 0; i < sizeof part; i++) {
        part[i] = path[i];
        if (i > 0 && (path[i] == '/' || path[i] == 0)) {
            part[i] = 0;
            if (mkdir(part, 0777) != 0 && errno != EEXIST) {
                break;
            }
            part[i] = path[i];
        }
        if (path[i] == 0) {
            return true;
        }
    }
    fprintf(stderr, "cannot make the folder %s\n", path);
    return false;
}

/* ---- Pictures --------------------------------------------------------------------------------------------------- */

typedef struct Film {
    Painter* painter;
    Image picture, tile, contactSheet;
    Apng moving; /* if options say so */
    Debug debug;
    int32_t pictures, moments;
} Film;

static void Film_Destroy(Film* film)
{
    if (film->painter != NULL) {
        Painter_Destroy(film->painter);
    }
    Image_Free(&film->picture);
    Image_Free(&film->tile);
    Image_Free(&film->contactSheet);
    Apng_Close(&film->moving);
    Debug_Destroy(&film->debug);
}

static bool OpenMoving(Film* film, const Options* options, int32_t ticks)
{
    int32_t frames = (ticks + options->every - 1) / options->every;
    if (options->film == NULL || Apng_Open(&film->moving, options->film, options->width, options->height, frames)) {
        return true;
    }
    fprintf(stderr, "cannot write %s\n", options->film);
    return false;
}

static bool Film_Create(Film* film, const Options* options, int32_t ticks)
{
    *film = (Film){ .painter = NULL };
    if (options->every == 0) {
        return true;
    }
    film->painter = Painter_Create(options->width, options->height);
    int32_t width = options->width / 2, height = options->height / 2;
    bool fine = film->painter != NULL && Debug_Create(&film->debug) &&
                Image_Create(&film->picture, options->width, options->height) &&
                Image_Create(&film->tile, width, height) &&
                Image_Create(&film->contactSheet, SHEET_COLUMNS * width + (SHEET_COLUMNS - 1) * SHEET_GAP,
                             SHEET_ROWS * height + (SHEET_ROWS - 1) * SHEET_GAP);
    if (!fine) {
        fprintf(stderr, "no memory for pictures\n");
    }
    fine = fine && OpenMoving(film, options, ticks);
    if (!fine) {
        Film_Destroy(film);
    }
    return fine;
}

static int32_t GetAxes(const Scene* scene, kiriFrameState* states)
{
    kiriFrame frames[DEBUG_MAX_FRAMES];
    int32_t count = 0, known = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, DEBUG_MAX_FRAMES, &count);
    for (int32_t i = 0; i < count && i < DEBUG_MAX_FRAMES; i++) {
        known += kiriFrame_GetState(scene->world, frames[i], &states[known]) == KIRI_OK;
    }
    return known;
}

/* Where the vertex is that lies nearest to a rest point. */
static const float* FindVertex(const kiriMesh* mesh, const float restPoint[2])
{
    int32_t best = 0;
    float bestDistance = INFINITY;
    for (int32_t i = 0; i < mesh->vertexCount; i++) {
        float u = mesh->restPositions[2 * i] - restPoint[0], v = mesh->restPositions[2 * i + 1] - restPoint[1];
        if (u * u + v * v < bestDistance) {
            bestDistance = u * u + v * v;
            best = i;
        }
    }
    return mesh->positions + 3 * best;
}

/* The camera stays where it is, looks at a rest point, and sees less. */
static void MoveCloser(View* view, const float closeUp[3])
{
    const float rest[2] = { view->size * closeUp[0], view->size * closeUp[1] };
    const float* at = FindVertex(&view->mesh, rest);
    for (int i = 0; i < 3; i++) {
        view->camera.target[i] = at[i] / view->size;
    }
    view->camera.fieldOfView /= closeUp[2];
}

static bool ShowDebug(View* view, Film* film, const Scene* scene, const Options* options)
{
    const Raster* raster = &film->debug.raster;
    if (!Debug_Update(&film->debug, scene, &view->mesh, &options->debug)) {
        return false;
    }
    view->raster = raster->colors;
    view->rasterSize = RASTER_SIZE;
    memcpy(view->rasterOrigin, raster->origin, sizeof view->rasterOrigin);
    view->rasterWidth = RASTER_SIZE * raster->side;
    view->lines = film->debug.lines;
    view->lineCount = film->debug.lineCount;
    return true;
}

/* To draw it is a mesh like another. */
static bool TakeSolid(View* view, const Scene* scene, float thickness)
{
    kiriSolid solid;
    if (kiriSheet_GetSolid(scene->world, scene->sheet, thickness, &solid) != KIRI_OK) {
        return false;
    }
    view->isSolid = true;
    view->mesh.positions = solid.positions;
    view->mesh.normals = solid.normals;
    view->mesh.restPositions = solid.restPositions;
    view->mesh.indices = solid.indices;
    view->mesh.vertexCount = solid.vertexCount;
    view->mesh.triangleCount = solid.triangleCount;
    return true;
}

static bool Film_Shoot(Film* film, const Scene* scene, const Options* options)
{
    static kiriFrameState axes[DEBUG_MAX_FRAMES];
    View view = { .camera = scene->type->camera,
                  .size = scene->type->size,
                  .look = scene->type->look,
                  .pins = scene->targets[0],
                  .pinCount = scene->pinCount,
                  .pegs = scene->type->pegs };
    float restPoints[MAX_BLADES][2], blades[MAX_BLADES][3];
    kiriSheet_GetMesh(scene->world, scene->sheet, &view.mesh);
    if (options->solid > 0 && !TakeSolid(&view, scene, 1e-3f * (float)options->solid)) {
        return false;
    }
    if (options->closeUp[2] > 0.0f) {
        MoveCloser(&view, options->closeUp);
    }
    if (Debug_IsWanted(&options->debug) && !ShowDebug(&view, film, scene, options)) {
        return false;
    }
    if (options->debug.points) {
        kiriSheet_GetCollisionPoints(scene->world, scene->sheet, &view.points, &view.pointCount);
    }
    if (options->axes) {
        view.axes = axes;
        view.axesCount = GetAxes(scene, axes);
    }
    view.bladeCount = Scene_GetBlades(scene, restPoints, MAX_BLADES);
    view.blades = blades[0];
    for (int32_t i = 0; i < view.bladeCount; i++) {
        memcpy(blades[i], FindVertex(&view.mesh, restPoints[i]), sizeof blades[i]);
    }
    return Painter_Paint(film->painter, &view, &film->picture);
}

static bool WritePicture(Film* film, const Options* options)
{
    char path[1100];
    snprintf(path, sizeof path, "%s/frame_%04d.png", options->output, film->pictures++);
    if (!Image_WritePng(&film->picture, path)) {
        fprintf(stderr, "cannot write %s\n", path);
        return false;
    }
    return true;
}

/* As fast as the scene goes; the last picture stays longer. */
static bool AddToMoving(Film* film, const Options* options)
{
    bool last = film->moving.added == film->moving.frameCount - 1;
    if (!Apng_Add(&film->moving, &film->picture, options->every + (last ? LAST_DELAY : 0))) {
        fprintf(stderr, "cannot write %s\n", options->film);
        return false;
    }
    return true;
}

static void AddMoment(Film* film)
{
    int32_t column = film->moments % SHEET_COLUMNS, row = film->moments / SHEET_COLUMNS;
    Image_Shrink(&film->tile, film->picture.rgb, film->picture.width, 3, 2);
    Image_Paste(&film->contactSheet, &film->tile, column * (film->tile.width + SHEET_GAP),
                row * (film->tile.height + SHEET_GAP));
    film->moments++;
}

/* A shorter or longer run has its moments sooner or later. */
static bool IsMoment(const Film* film, const Scene* scene, int32_t ticks)
{
    const SceneType* type = scene->type;
    return film->moments < SHEET_COLUMNS * SHEET_ROWS &&
           (int64_t)scene->tick * type->ticks >= (int64_t)type->moments[film->moments] * ticks;
}

static bool Film_Tick(Film* film, const Scene* scene, const Options* options, int32_t ticks)
{
    bool picture = (scene->tick - 1) % options->every == 0, moment = IsMoment(film, scene, ticks);
    if (!picture && !moment) {
        return true;
    }
    if (!Film_Shoot(film, scene, options)) {
        fprintf(stderr, "no memory for a picture\n");
        return false;
    }
    if (picture && (!WritePicture(film, options) || (options->film != NULL && !AddToMoving(film, options)))) {
        return false;
    }
    while (IsMoment(film, scene, ticks)) {
        AddMoment(film);
    }
    return true;
}

/* ---- Measuring -------------------------------------------------------------------------------------------------- */

static double ReadClock(void* user)
{
    (void)user;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct Record {
    double* seconds[KIRI_STAGE_COUNT + 1]; /* one a tick; the last row: whole ticks */
    int32_t ticks;
    int64_t cutSegments, trianglesSplit, cellsSettled, systemsSolved;
    kiriCounts before, after;
} Record;

static bool Record_Create(Record* record, int32_t ticks)
{
    *record = (Record){ .ticks = 0 };
    double* block = malloc(sizeof(double) * (KIRI_STAGE_COUNT + 1) * (size_t)ticks);
    for (int32_t i = 0; i <= KIRI_STAGE_COUNT; i++) {
        record->seconds[i] = block != NULL ? block + i * ticks : NULL;
    }
    return block != NULL;
}

static void Record_Tick(Record* record, const Scene* scene, double seconds)
{
    kiriProfile profile;
    kiriWorld_GetProfile(scene->world, &profile);
    for (int32_t i = 0; i < KIRI_STAGE_COUNT; i++) {
        record->seconds[i][record->ticks] = profile.seconds[i];
    }
    record->seconds[KIRI_STAGE_COUNT][record->ticks++] = seconds;
    record->cutSegments += profile.cutSegments;
    record->trianglesSplit += profile.trianglesSplit;
    record->cellsSettled += profile.cellsSettled;
    record->systemsSolved += profile.systemsSolved;
}

static int CompareNumbers(const void* left, const void* right)
{
    double l = *(const double*)left, r = *(const double*)right;
    return (l > r) - (l < r);
}

static void PrintStage(const char* name, double* seconds, int32_t count)
{
    qsort(seconds, (size_t)count, sizeof(double), CompareNumbers);
    printf("  %-12s %10.3f %10.3f\n", name, 1e3 * seconds[count / 2], 1e3 * seconds[count - 1]);
}

static void Record_Print(Record* record, const Scene* scene)
{
    const kiriCounts* a = &record->before;
    const kiriCounts* b = &record->after;
    double total = 0.0;
    for (int32_t i = 0; i < record->ticks; i++) {
        total += record->seconds[KIRI_STAGE_COUNT][i];
    }
    printf("%s: %d ticks of 1/60 s, %d substeps each\n\n", scene->type->name, record->ticks, scene->type->substeps);
    printf("  %-12s %10s %10s\n", "", "before", "after");
    printf("  %-12s %10d %10d\n", "vertices", a->vertices, b->vertices);
    printf("  %-12s %10d %10d\n", "triangles", a->triangles, b->triangles);
    printf("  %-12s %10d %10d\n", "cells", a->cells, b->cells);
    printf("  %-12s %10d %10d\n", "frames", a->frames, b->frames);
    printf("  %-12s %10d %10d\n", "links", a->links, b->links);
    printf("  %-12s %10d %10d\n\n", "pieces", a->pieces, b->pieces);
    printf("  %-12s %10s %10s\n", "ms a tick", "median", "worst");
    for (int32_t i = 0; i < KIRI_STAGE_COUNT; i++) {
        PrintStage(kiriGetStageName(i), record->seconds[i], record->ticks);
    }
    PrintStage("all", record->seconds[KIRI_STAGE_COUNT], record->ticks);
    printf("\n  %.0f ticks a second\n", record->ticks / total);
    printf("  %lld cut segments, %lld linear systems; items of work: %lld of triangles, %lld of cells\n",
           (long long)record->cutSegments, (long long)record->systemsSolved, (long long)record->trianglesSplit,
           (long long)record->cellsSettled);
    uint64_t hash = 0;
    kiriWorld_GetStateHash(scene->world, &hash);
    printf("  state hash %016llx\n", (unsigned long long)hash);
}

/* ---- Running ---------------------------------------------------------------------------------------------------- */

static bool RunTicks(Scene* scene, Film* film, Record* record, const Options* options, int32_t ticks)
{
    for (int32_t i = 0; i < ticks; i++) {
        double start = ReadClock(NULL);
        kiriResult result = Scene_Tick(scene);
        Record_Tick(record, scene, ReadClock(NULL) - start);
        if (result < 0) {
            fprintf(stderr, "\ntick %d: %s: %s\n", i, kiriGetResultName(result), kiriWorld_GetLastError(scene->world));
            return false;
        }
        if (options->every > 0 && !Film_Tick(film, scene, options, ticks)) {
            return false;
        }
        if (!options->quiet) {
            fprintf(stderr, "\r%3d %%  tick %d of %d ", 100 * (i + 1) / ticks, i + 1, ticks);
        }
    }
    if (!options->quiet) {
        fprintf(stderr, "\n");
    }
    return true;
}

static bool FinishPictures(Film* film, const Options* options)
{
    char path[1100];
    snprintf(path, sizeof path, "%s/contact_sheet.png", options->output);
    if (!Image_WritePng(&film->contactSheet, path)) {
        fprintf(stderr, "cannot write %s\n", path);
        return false;
    }
    printf("  %d pictures and contact_sheet.png in %s\n", film->pictures, options->output);
    if (options->film != NULL && !Apng_Close(&film->moving)) {
        fprintf(stderr, "cannot write %s\n", options->film);
        return false;
    }
    return true;
}

static bool RunScene(Scene* scene, const Options* options)
{
    Film film;
    Record record;
    int32_t ticks = options->ticks > 0 ? options->ticks : scene->type->ticks;
    if ((options->every > 0 && !MakeFolders(options->output)) || !Film_Create(&film, options, ticks)) {
        return false;
    }
    bool fine = Record_Create(&record, ticks);
    if (fine) {
        kiriSheet_GetCounts(scene->world, scene->sheet, &record.before);
        fine = RunTicks(scene, &film, &record, options, ticks);
        kiriSheet_GetCounts(scene->world, scene->sheet, &record.after);
        Record_Print(&record, scene);
    }
    fine = fine && (options->every == 0 || FinishPictures(&film, options));
    free(record.seconds[0]);
    Film_Destroy(&film);
    return fine;
}

int main(int count, char** words)
{
    Options options = { .scene = "bunny",
                        .output = "build/pictures",
                        .every = 2,
                        .width = 640,
                        .height = 480,
                        .debug = { .weightsOf = DEBUG_NO_FRAME } };
    if (!ReadOptions(count, words, &options) || options.help) {
        PrintHelp();
        return options.help ? 0 : 2;
    }
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.clock = ReadClock;
    def.budget.cells = options.budget;
    SceneOptions sceneOptions = { .dataFolder = options.data,
                                  .gridResolution = options.grid,
                                  .frameCount = options.controlFrames,
                                  .plain = options.plain,
                                  .asPaper = options.asPaper,
                                  .smooth = options.smooth };
    Scene scene;
    if (!Scene_Start(&scene, Scene_FindType(options.scene), &def, &sceneOptions)) {
        return 1;
    }
    bool fine = RunScene(&scene, &options);
    Scene_Stop(&scene);
    return fine ? 0 : 1;
}
