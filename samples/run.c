/* Runs a scene, writes its pictures, and prints what the library did and how long it took. */
#define _POSIX_C_SOURCE 200112L

#include "export.h"
#include "glb.h"
#include "image.h"
#include "run_options.h"
#include "scene.h"
#include "scene_record.h"
#include "shot.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { SHEET_COLUMNS = 3, SHEET_ROWS = SCENE_MOMENTS / SHEET_COLUMNS, SHEET_GAP = 4, LAST_DELAY = 60 };

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
    Shot shot;
    Image picture, tile, contactSheet;
    Apng moving; /* if options say so */
    Glb model;   /* the same */
    int32_t pictures, moments;
} Film;

static void Film_Destroy(Film* film)
{
    Shot_Destroy(&film->shot);
    Image_Free(&film->picture);
    Image_Free(&film->tile);
    Image_Free(&film->contactSheet);
    Apng_Close(&film->moving);
    Glb_Free(&film->model);
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
    *film = (Film){ .pictures = 0 };
    if (options->every == 0) {
        return true;
    }
    int32_t width = options->width / 2, height = options->height / 2;
    bool fine = Shot_Create(&film->shot, options->width, options->height) &&
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
    if (!Shot_Take(&film->shot, scene, options, &film->picture)) {
        fprintf(stderr, "no memory for a picture\n");
        return false;
    }
    if (picture && (!WritePicture(film, options) || (options->film != NULL && !AddToMoving(film, options)))) {
        return false;
    }
    if (picture && options->model != NULL && !Glb_Add(&film->model, scene->world, (float)(scene->tick - 1) / 60.0f)) {
        fprintf(stderr, "no memory for %s\n", options->model);
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

typedef struct Times {
    double* seconds[KIRI_STAGE_COUNT + 1]; /* one a tick; the last row: whole ticks */
    int32_t ticks;
    int64_t cutSegments, trianglesSplit, cellsSettled, systemsSolved;
    kiriCounts before, after;
} Times;

static bool Times_Create(Times* times, int32_t ticks)
{
    *times = (Times){ .ticks = 0 };
    double* block = malloc(sizeof(double) * (KIRI_STAGE_COUNT + 1) * (size_t)ticks);
    for (int32_t i = 0; i <= KIRI_STAGE_COUNT; i++) {
        times->seconds[i] = block != NULL ? block + i * ticks : NULL;
    }
    return block != NULL;
}

static void Times_Tick(Times* times, const Scene* scene, double seconds)
{
    kiriProfile profile;
    kiriWorld_GetProfile(scene->world, &profile);
    for (int32_t i = 0; i < KIRI_STAGE_COUNT; i++) {
        times->seconds[i][times->ticks] = profile.seconds[i];
    }
    times->seconds[KIRI_STAGE_COUNT][times->ticks++] = seconds;
    times->cutSegments += profile.cutSegments;
    times->trianglesSplit += profile.trianglesSplit;
    times->cellsSettled += profile.cellsSettled;
    times->systemsSolved += profile.systemsSolved;
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

static void Times_Print(Times* times, const Scene* scene, const Options* options)
{
    const kiriCounts* a = &times->before;
    const kiriCounts* b = &times->after;
    double total = 0.0;
    for (int32_t i = 0; i < times->ticks; i++) {
        total += times->seconds[KIRI_STAGE_COUNT][i];
    }
    if (options->replay != NULL) {
        printf("%s: %d ticks\n\n", options->replay, times->ticks);
    } else {
        printf("%s: %d ticks of 1/60 s, %d substeps each\n\n", scene->type->name, times->ticks, scene->type->substeps);
    }
    printf("  %-12s %10s %10s\n", "", "before", "after");
    printf("  %-12s %10d %10d\n", "vertices", a->vertices, b->vertices);
    printf("  %-12s %10d %10d\n", "triangles", a->triangles, b->triangles);
    printf("  %-12s %10d %10d\n", "cells", a->cells, b->cells);
    printf("  %-12s %10d %10d\n", "frames", a->frames, b->frames);
    printf("  %-12s %10d %10d\n", "links", a->links, b->links);
    printf("  %-12s %10d %10d\n\n", "pieces", a->pieces, b->pieces);
    printf("  %-12s %10s %10s\n", "ms a tick", "median", "worst");
    for (int32_t i = 0; i < KIRI_STAGE_COUNT; i++) {
        PrintStage(kiriGetStageName(i), times->seconds[i], times->ticks);
    }
    PrintStage("all", times->seconds[KIRI_STAGE_COUNT], times->ticks);
    printf("\n  %.0f ticks a second\n", times->ticks / total);
    printf("  %lld cut segments, %lld linear systems; items of work: %lld of triangles, %lld of cells\n",
           (long long)times->cutSegments, (long long)times->systemsSolved, (long long)times->trianglesSplit,
           (long long)times->cellsSettled);
    uint64_t hash = 0;
    kiriWorld_GetStateHash(scene->world, &hash);
    printf("  state hash %016llx\n", (unsigned long long)hash);
}

/* ---- Running ---------------------------------------------------------------------------------------------------- */

/* `replay`: null, or in place of the scene's script. */
static bool RunTicks(Scene* scene, SceneReplay* replay, Film* film, Times* times, const Options* options, int32_t ticks)
{
    bool tells = !options->quiet && isatty(STDERR_FILENO);
    for (int32_t i = 0; i < ticks; i++) {
        double start = ReadClock(NULL);
        kiriResult result = replay != NULL ? SceneReplay_Tick(replay, scene) : Scene_Tick(scene);
        Times_Tick(times, scene, ReadClock(NULL) - start);
        if (result < 0) {
            fprintf(stderr, "\ntick %d: %s: %s\n", i, kiriGetResultName(result), kiriWorld_GetLastError(scene->world));
            return false;
        }
        if (options->every > 0 && !Film_Tick(film, scene, options, ticks)) {
            return false;
        }
        if (tells && 100 * (i + 1) / ticks > 100 * i / ticks) {
            fprintf(stderr, "\r%3d %%  tick %d of %d ", 100 * (i + 1) / ticks, i + 1, ticks);
        }
    }
    if (tells) {
        fprintf(stderr, "\n");
    }
    return true;
}

static bool WriteModel(Film* film, const Scene* scene, const char* path)
{
    FILE* file = fopen(path, "wb");
    bool fine = file != NULL && Glb_Write(&film->model, scene->type->look.front, file);
    fine = file != NULL && fclose(file) == 0 && fine;
    if (!fine) {
        fprintf(stderr, "cannot write %s\n", path);
    }
    return fine;
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

static bool WriteDrawing(const Scene* scene, const char* path)
{
    enum { MOST_SHEETS = 1024 };
    static kiriSheet sheets[MOST_SHEETS];
    int32_t count = 0;
    Import drawing;
    kiriWorld_GetSheets(scene->world, sheets, MOST_SHEETS, &count);
    bool isTaken = Export_Take(scene->world, sheets, count < MOST_SHEETS ? count : MOST_SHEETS, &drawing);
    FILE* file = isTaken ? fopen(path, "w") : NULL;
    size_t length = strlen(path);
    bool isFold = length > 5 && strcmp(path + length - 5, ".fold") == 0;
    bool fine = file != NULL && (isFold ? Export_WriteFold(&drawing, file) : Export_WriteSvg(&drawing, file));
    fine = file != NULL && fclose(file) == 0 && fine;
    if (!fine) {
        fprintf(stderr, "cannot write %s%s%s\n", path, isTaken ? "" : ": ", drawing.error);
    }
    Import_Free(&drawing);
    return fine;
}

static int32_t CountTicks(const Scene* scene, const SceneReplay* replay, const Options* options)
{
    int32_t all = replay != NULL ? replay->ticks : scene->type->ticks;
    return options->ticks > 0 && (replay == NULL || options->ticks < all) ? options->ticks : all;
}

static bool RunScene(Scene* scene, SceneReplay* replay, const Options* options)
{
    Film film;
    Times times;
    int32_t ticks = CountTicks(scene, replay, options);
    if ((options->every > 0 && !MakeFolders(options->output)) || !Film_Create(&film, options, ticks)) {
        return false;
    }
    bool fine = Times_Create(&times, ticks);
    if (fine) {
        kiriSheet_GetCounts(scene->world, scene->sheet, &times.before);
        fine = RunTicks(scene, replay, &film, &times, options, ticks);
        kiriSheet_GetCounts(scene->world, scene->sheet, &times.after);
        Times_Print(&times, scene, options);
    }
    fine = fine && (options->every == 0 || FinishPictures(&film, options));
    fine = fine && (options->model == NULL || WriteModel(&film, scene, options->model));
    fine = fine && (options->drawing == NULL || WriteDrawing(scene, options->drawing));
    free(times.seconds[0]);
    Film_Destroy(&film);
    return fine;
}

static bool RunScript(const Options* options, kiriWorldDef* def)
{
    SceneOptions sceneOptions = { .dataFolder = options->data,
                                  .gridResolution = options->grid,
                                  .frameCount = options->controlFrames,
                                  .collisionPoints = options->debug.points ? 200 : 0,
                                  .plain = options->plain,
                                  .asPaper = options->asPaper,
                                  .smooth = options->smooth };
    Scene scene;
    FILE* file = NULL;
    if (options->record != NULL && !SceneRecord_Open(&file, options->record, def)) {
        return false;
    }
    bool fine = Scene_Start(&scene, Scene_FindType(options->scene), def, &sceneOptions);
    if (fine) {
        fine = RunScene(&scene, NULL, options);
        Scene_Stop(&scene);
    }
    return SceneRecord_Close(file, options->record) && fine;
}

static bool RunReplay(const Options* options, const kiriWorldDef* def)
{
    Scene scene;
    SceneReplay replay;
    bool fine = SceneReplay_Start(&replay, options->replay, &scene, Scene_FindType(options->scene), def);
    if (fine) {
        fine = RunScene(&scene, &replay, options) && replay.isRight;
        Scene_Stop(&scene);
    }
    SceneReplay_Free(&replay);
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
    if (!Options_Read(count, words, &options) || options.help) {
        Options_PrintHelp();
        return options.help ? 0 : 2;
    }
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.clock = ReadClock;
    def.budget.cells = options.budget;
    bool fine = options.replay != NULL ? RunReplay(&options, &def) : RunScript(&options, &def);
    return fine ? 0 : 1;
}
