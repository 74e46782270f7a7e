#define _POSIX_C_SOURCE 200809L

#include "shell.h"
#include "play.h"
#include "script.h"
#include "window.h"

#include "../canvas_parts.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum { MINUTE = 60 * GAME_RATE, MAX_EVENTS = 256, MAX_OWED = 4, DEFAULT_TICKS = 10 * GAME_RATE };

static const double slowPace = 0.25;

typedef struct Options {
    const char *game, *script, *record, *calls, *pictures, *film;
    int32_t level, ticks, every, width, height, oversampling;
    int32_t slowFrom, slowTo; /* ticks that are shown in slow motion */
    bool headless, demo, hash, report, mute, help;
} Options;

typedef struct Shell {
    Options options;
    Play play;
    Script script;
    FILE* record;
    Canvas* canvas; /* null: nothing is drawn */
    Image image;
    Window* window; /* null: headless */
    Apng film;
    double
        owed; /* ticks that the time since the last one is worth, 0 to 1 between frames: where between them to draw */
    WindowWishes wishes;
    int32_t frames, pictures;
    double seconds[MINUTE]; /* of the ticks of this minute */
} Shell;

/* ---- Options ---------------------------------------------------------------------------------------------------- */

static void PrintHelp(const GameType* const* games)
{
    printf("kiri-play: games with sheets\n\n");
    for (; *games != NULL; games++) {
        printf("  --game %-10s %s; %d levels\n%20s%s\n", (*games)->name, (*games)->about, (*games)->levels, "",
               (*games)->keys);
    }
    printf("  --level N\n"
           "  --script FILE     plays recorded events (a script names its game and level)\n"
           "  --record FILE     writes one\n"
           "  --calls FILE      all calls of Kiri since the level was started, for kiri-run --replay\n"
           "  --demo            the game plays itself, where it can\n"
           "  --headless        no window\n"
           "  --ticks N         stops then; without a window: at the end of the script, or after %d\n"
           "  --pictures DIR    frame_0000.png and so on\n"
           "  --film FILE       a moving picture (APNG), without a window\n"
           "  --every K         a picture every so many sixtieths of a second; default 6\n"
           "  --slow FROM-TO    slow motion between these ticks\n"
           "  --size WxH        default %dx%d\n"
           "  --oversampling N  1 to 4; default 1 in a window, 2 without\n"
           "  --hash            prints the state hash at the end\n"
           "  --report          prints times and memory of each minute\n"
           "  --mute\n\n"
           "In the window: R again, N next level, P pause and keys, Z undo, S held: slow motion, M sound, Escape: "
           "quit.\n",
           DEFAULT_TICKS, GAME_WIDTH, GAME_HEIGHT);
}

static bool ReadNumber(const char* text, int32_t least, int32_t most, int32_t* number)
{
    char* end;
    long value = strtol(text, &end, 10);
    *number = (int32_t)value;
    return *text != 0 && *end == 0 && value >= least && value <= most;
}

static bool ReadFlag(const char* name, Options* options)
{
    const struct {
        const char* name;
        bool* flag;
    } flags[] = { { "--headless", &options->headless }, { "--demo", &options->demo }, { "--hash", &options->hash },
                  { "--report", &options->report },     { "--mute", &options->mute }, { "--help", &options->help } };
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        if (strcmp(name, flags[i].name) == 0) {
            *flags[i].flag = true;
            return true;
        }
    }
    return false;
}

static bool ReadText(const char* name, const char* value, Options* options)
{
    const struct {
        const char* name;
        const char** text;
    } texts[] = { { "--game", &options->game },         { "--script", &options->script },
                  { "--record", &options->record },     { "--calls", &options->calls },
                  { "--pictures", &options->pictures }, { "--film", &options->film } };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        if (strcmp(name, texts[i].name) == 0) {
            *texts[i].text = value;
            return true;
        }
    }
    return false;
}

static bool ReadValue(const char* name, const char* value, Options* options)
{
    char rest;
    if (strcmp(name, "--level") == 0) {
        return ReadNumber(value, 1, 1000, &options->level);
    } else if (strcmp(name, "--ticks") == 0) {
        return ReadNumber(value, 1, 10000000, &options->ticks);
    } else if (strcmp(name, "--every") == 0) {
        return ReadNumber(value, 1, 100000, &options->every);
    } else if (strcmp(name, "--oversampling") == 0) {
        return ReadNumber(value, 1, 4, &options->oversampling);
    } else if (strcmp(name, "--slow") == 0) {
        return sscanf(value, "%d-%d%c", &options->slowFrom, &options->slowTo, &rest) == 2;
    } else if (strcmp(name, "--size") == 0) {
        return sscanf(value, "%dx%d%c", &options->width, &options->height, &rest) == 2 && options->width >= 64 &&
               options->width <= 4096 && options->height >= 64 && options->height <= 4096;
    }
    return ReadText(name, value, options);
}

static bool ReadOptions(int count, char** words, Options* options)
{
    for (int i = 1; i < count; i++) {
        if (ReadFlag(words[i], options)) {
            continue;
        } else if (i + 1 < count && ReadValue(words[i], words[i + 1], options)) {
            i++;
        } else {
            fprintf(stderr, "kiri-play: not understood: %s %s\n", words[i], i + 1 < count ? words[i + 1] : "");
            return false;
        }
    }
    if (options->film != NULL && !options->headless) {
        fprintf(stderr, "kiri-play: --film goes with --headless\n");
        return false;
    }
    return true;
}

/* ---- Ticks ------------------------------------------------------------------------------------------------------ */

static double GetSeconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool Send(Shell* shell, const GameEvent* event)
{
    if (shell->record != NULL) {
        Script_WriteEvent(shell->record, event);
    }
    return Play_Send(&shell->play, event);
}

static int CompareNumbers(const void* left, const void* right)
{
    double l = *(const double*)left, r = *(const double*)right;
    return (l > r) - (l < r);
}

/* Times and memory of the minute that is over, or of what there is of it. */
static void Report(Shell* shell)
{
    int32_t count = (shell->play.tick - 1) % MINUTE + 1;
    qsort(shell->seconds, (size_t)count, sizeof(double), CompareNumbers);
    printf("  to tick %6d: ms a tick %6.2f median %6.2f in 99 of 100 %6.2f worst; %6.1f MB held, %6.1f at most, "
           "%8lld allocations\n",
           shell->play.tick, 1e3 * shell->seconds[count / 2], 1e3 * shell->seconds[(count - 1) * 99 / 100],
           1e3 * shell->seconds[count - 1], 1e-6 * (double)shell->play.bytes, 1e-6 * (double)shell->play.peak,
           (long long)shell->play.allocations);
    fflush(stdout);
}

/* What script and demo have for the next tick. */
static bool SendEvents(Shell* shell)
{
    const GameEvent* event;
    bool fine = true;
    while (fine && (event = Script_Take(&shell->script, shell->play.tick)) != NULL) {
        GameEvent now = *event;
        now.tick = shell->play.tick;
        fine = Send(shell, &now);
    }
    if (shell->options.demo && shell->play.type->demo != NULL) {
        GameEvent events[8];
        int32_t count = shell->play.type->demo(shell->play.game, events, 8);
        for (int32_t i = 0; fine && i < count; i++) {
            events[i].tick = shell->play.tick;
            fine = Send(shell, &events[i]);
        }
    }
    return fine;
}

static bool RunTick(Shell* shell)
{
    if (!SendEvents(shell)) {
        return false;
    }
    double start = GetSeconds();
    bool fine = Play_Tick(&shell->play);
    shell->seconds[(shell->play.tick - 1) % MINUTE] = GetSeconds() - start;
    if (shell->options.report && shell->play.tick % MINUTE == 0) {
        Report(shell);
    }
    return fine;
}

static bool IsOver(const Shell* shell)
{
    const Options* options = &shell->options;
    if (options->ticks > 0) {
        return shell->play.tick >= options->ticks;
    }
    return options->headless && shell->play.tick >= (options->script != NULL ? shell->script.end : DEFAULT_TICKS);
}

/* ---- Frames ----------------------------------------------------------------------------------------------------- */

static double GetPace(const Options* options, const WindowWishes* wishes, int32_t tick)
{
    if (wishes->pause) {
        return 0.0;
    }
    return wishes->slow || (tick >= options->slowFrom && tick < options->slowTo) ? slowPace : 1.0;
}

static bool Draw(Shell* shell, float alpha)
{
    shell->play.type->draw(shell->play.game, shell->canvas, alpha);
    if (shell->wishes.pause) {
        const Color shade = { 0.0f, 0.0f, 0.0f, 0.35f }, white = { 1.0f, 1.0f, 1.0f, 1.0f };
        Canvas_AddRectangle(shell->canvas, 0.0f, 0.0f, GAME_WIDTH, GAME_HEIGHT, shade);
        Canvas_AddText(shell->canvas, 0.5f * GAME_WIDTH, 0.45f * GAME_HEIGHT, 42.0f, 0.5f, white, "Pause");
        Canvas_AddText(shell->canvas, 0.5f * GAME_WIDTH, 0.45f * GAME_HEIGHT + 70.0f, 15.0f, 0.5f, white,
                       shell->play.type->keys);
        Canvas_AddText(shell->canvas, 0.5f * GAME_WIDTH, 0.45f * GAME_HEIGHT + 104.0f, 15.0f, 0.5f, white,
                       "P: go on   R: again   N: next level   Z: undo   S: slow motion   M: sound   Esc: quit");
    }
    if (!Canvas_Finish(shell->canvas, &shell->image)) {
        fprintf(stderr, "no memory for a picture\n");
        return false;
    }
    return true;
}

static bool WritePicture(Shell* shell)
{
    const Options* options = &shell->options;
    char path[1100];
    snprintf(path, sizeof path, "%s/frame_%04d.png", options->pictures != NULL ? options->pictures : "",
             shell->pictures++);
    if (options->pictures != NULL && !Image_WritePng(&shell->image, path)) {
        fprintf(stderr, "cannot write %s\n", path);
        return false;
    }
    if (options->film != NULL && !Apng_Add(&shell->film, &shell->image, options->every)) {
        fprintf(stderr, "cannot write %s\n", options->film);
        return false;
    }
    return true;
}

/* The time since the last frame, in ticks. A window that cannot keep up goes slower. */
static bool RunFrame(Shell* shell, double elapsed)
{
    const Options* options = &shell->options;
    shell->owed += elapsed * GetPace(options, &shell->wishes, shell->play.tick);
    shell->owed = shell->owed < MAX_OWED ? shell->owed : MAX_OWED;
    for (; shell->owed >= 1.0 && !IsOver(shell); shell->owed -= 1.0) {
        if (!RunTick(shell)) {
            return false;
        }
    }
    bool picture = (options->pictures != NULL || options->film != NULL) && shell->frames++ % options->every == 0;
    if ((shell->window != NULL || picture) && !Draw(shell, shell->owed < 1.0 ? (float)shell->owed : 1.0f)) {
        return false;
    }
    return !picture || WritePicture(shell);
}

static bool RunHeadless(Shell* shell)
{
    while (!IsOver(shell)) {
        if (!RunFrame(shell, 1.0)) {
            return false;
        }
    }
    return true;
}

static bool RunWindow(Shell* shell)
{
    static GameEvent events[MAX_EVENTS];
    double before = Window_GetSeconds();
    while (!shell->wishes.quit && !IsOver(shell)) {
        int32_t count = Window_Poll(shell->window, shell->play.tick, events, MAX_EVENTS, &shell->wishes);
        for (int32_t i = 0; i < count; i++) {
            if (!Send(shell, &events[i])) {
                return false;
            }
        }
        double now = Window_GetSeconds();
        if (!RunFrame(shell, (now - before) * GAME_RATE)) {
            return false;
        }
        before = now;
        Window_Show(shell->window, &shell->image);
        Window_PlaySounds(shell->window, &shell->play.sounds);
    }
    return true;
}

/* ---- From start to end ------------------------------------------------------------------------------------------ */

static bool MakeFolders(const char* path)
{
    char part[1024] = "";
    for (size_t i = 0; i + 1 < sizeof part && (i == 0 || path[i - 1] != 0); i++) {
        if (i > 0 && (path[i] == '/' || path[i] == 0) && mkdir(part, 0777) != 0 && errno != EEXIST) {
            fprintf(stderr, "cannot make the folder %s\n", path);
            return false;
        }
        part[i] = path[i];
    }
    return true;
}

/* The first frames of the film have one before them that is not shown: the numbers are those of RunHeadless. */
static int32_t CountPictures(const Shell* shell)
{
    const Options* options = &shell->options;
    int32_t end = options->ticks > 0 ? options->ticks : options->script != NULL ? shell->script.end : DEFAULT_TICKS;
    int32_t tick = 0, frames = 0;
    for (double owed = 0.0; tick < end; frames++) {
        for (owed += GetPace(options, &shell->wishes, tick); owed >= 1.0; owed -= 1.0) {
            tick++;
        }
    }
    return (frames + options->every - 1) / options->every;
}

static bool OpenPictures(Shell* shell)
{
    const Options* options = &shell->options;
    if (options->headless && options->pictures == NULL && options->film == NULL) {
        return true;
    }
    int32_t oversampling = options->oversampling > 0 ? options->oversampling : options->headless ? 2 : 1;
    shell->canvas = Canvas_Create(options->width, options->height, oversampling, OverlayText_Draw);
    if (shell->canvas == NULL || !Image_Create(&shell->image, options->width, options->height)) {
        fprintf(stderr, "cannot draw pictures of %d x %d\n", options->width, options->height);
        return false;
    }
    if (options->film != NULL &&
        !Apng_Open(&shell->film, options->film, options->width, options->height, CountPictures(shell))) {
        fprintf(stderr, "cannot write %s\n", options->film);
        return false;
    }
    return options->pictures == NULL || MakeFolders(options->pictures);
}

static const GameType* FindGame(const GameType* const* games, const char* name)
{
    for (; *games != NULL; games++) {
        if (strcmp((*games)->name, name) == 0) {
            return *games;
        }
    }
    fprintf(stderr, "kiri-play: no game %s\n", name);
    return NULL;
}

static bool StartPlay(Shell* shell, const GameType* const* games)
{
    const Options* options = &shell->options;
    if (options->script != NULL && !Script_Read(&shell->script, options->script)) {
        return false;
    }
    const Script* script = &shell->script;
    const GameType* type = FindGame(games, options->game != NULL  ? options->game
                                           : script->game[0] != 0 ? script->game
                                                                  : games[0]->name);
    int32_t level = options->level > 0 ? options->level : script->level > 0 ? script->level : 1;
    if (type == NULL || level > type->levels) {
        if (type != NULL) {
            fprintf(stderr, "kiri-play: no level %d\n", level);
        }
        return false;
    }
    return Play_StartRecorded(&shell->play, type, level, options->calls);
}

static bool OpenRecord(Shell* shell)
{
    if (shell->options.record == NULL) {
        return true;
    }
    shell->record = fopen(shell->options.record, "w");
    if (shell->record == NULL) {
        fprintf(stderr, "cannot write %s\n", shell->options.record);
        return false;
    }
    Script_WriteStart(shell->record, shell->play.type->name, shell->play.level);
    return true;
}

static bool OpenWindow(Shell* shell)
{
    const Options* options = &shell->options;
    if (!options->headless) {
        char title[64];
        snprintf(title, sizeof title, "Kiri: %s (P: keys)", shell->play.type->name);
        shell->window = Window_Open(title, options->width, options->height, options->mute);
    }
    return options->headless || shell->window != NULL;
}

static void PrintEnd(Shell* shell)
{
    static const char* const states[] = { "playing", "won", "lost" };
    GameStatus status;
    shell->play.type->getStatus(shell->play.game, &status);
    if (shell->options.report && shell->play.tick % MINUTE != 0) {
        Report(shell);
    }
    printf("%s, level %d, tick %d: %s, score %d\n", shell->play.type->name, shell->play.level, shell->play.tick,
           states[status.state], status.score);
    if (shell->options.hash) {
        printf("state hash %016llx\n", (unsigned long long)status.hash);
    }
}

static bool Close(Shell* shell)
{
    bool fine = true;
    if (shell->record != NULL) {
        Script_WriteEnd(shell->record, shell->play.tick);
        fine = fclose(shell->record) == 0;
    }
    if (shell->film.file != NULL && !Apng_Close(&shell->film)) {
        fine = false;
    }
    fine = Play_Stop(&shell->play) && fine;
    if (!fine) {
        fprintf(stderr, "could not write all of the record, the calls or the film\n");
    }
    if (shell->window != NULL) {
        Window_Close(shell->window);
    }
    if (shell->canvas != NULL) {
        Canvas_Destroy(shell->canvas);
    }
    Image_Free(&shell->image);
    Script_Free(&shell->script);
    return fine;
}

int Shell_Run(int count, char** words, const GameType* const* games)
{
    static Shell shell;
    shell = (Shell){ .options = { .every = 6, .width = GAME_WIDTH, .height = GAME_HEIGHT } };
    if (!ReadOptions(count, words, &shell.options) || shell.options.help) {
        PrintHelp(games);
        return shell.options.help ? 0 : 2;
    }
    bool fine = StartPlay(&shell, games) && OpenPictures(&shell) && OpenRecord(&shell) && OpenWindow(&shell) &&
                (shell.options.headless ? RunHeadless(&shell) : RunWindow(&shell));
    if (shell.play.game != NULL) {
        PrintEnd(&shell);
    }
    return Close(&shell) && fine ? 0 : 1;
}
