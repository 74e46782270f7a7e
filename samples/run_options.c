#include "run_options.h"

#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void Options_PrintHelp(void)
{
    printf("kiri-run: runs a scene and writes its pictures\n\n"
           "  --scene NAME          which scene\n"
           "  --output FOLDER       where the pictures go (build/pictures)\n"
           "  --film FILE           a moving picture of them too, an animated PNG\n"
           "  --drawing FILE        borders and cuts at the end: FOLD if the name ends so, else SVG\n"
           "  --export FILE         the sheets in motion, a mesh for each picture: binary glTF 2.0 (.glb)\n"
           "  --record FILE         all calls of the library, to be replayed\n"
           "  --replay FILE         a recording, or a save, instead of a scene's script\n"
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
           "  --points              give sheets 200 collision points, and show them\n"
           "  --contacts            show contacts, obstacles, pins and blades of the world\n"
           "  --quiet               no progress line, as where no terminal reads\n"
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
    } flags[] = { { "--help", &options->help },
                  { "--quiet", &options->quiet },
                  { "--frames-axes", &options->debug.axes },
                  { "--regions", &options->debug.regions },
                  { "--links", &options->debug.links },
                  { "--cells", &options->debug.cells },
                  { "--points", &options->debug.points },
                  { "--contacts", &options->debug.contacts },
                  { "--plain", &options->plain },
                  { "--smooth", &options->smooth },
                  { "--paper", &options->asPaper } };
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
    } else if (strcmp(name, "--drawing") == 0) {
        options->drawing = value;
        return true;
    } else if (strcmp(name, "--export") == 0) {
        options->model = value;
        return true;
    } else if (strcmp(name, "--record") == 0) {
        options->record = value;
        return true;
    } else if (strcmp(name, "--replay") == 0) {
        options->replay = value;
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

bool Options_Read(int count, char** words, Options* options)
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
    if ((options->film != NULL || options->model != NULL) && options->every == 0) {
        fprintf(stderr, "kiri-run: --film or --export without pictures: --every 0\n");
        return false;
    }
    if (options->record != NULL && options->replay != NULL) {
        fprintf(stderr, "kiri-run: --record or --replay, not both\n");
        return false;
    }
    return true;
}
