/* Shows a recording or a save in a window, forwards and backwards. */
#define _POSIX_C_SOURCE 199309L

#include "../canvas_parts.h"
#include "../games/window.h"
#include "../scene_record.h"
#include "../shot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { KEEP_EVERY = 20, MOST_EVENTS = 64, WIDTH = 960, HEIGHT = 720, BAR = 24 };

/* A tick to go on from: the world, and all beside it. */
typedef struct Moment {
    void* bytes;
    int64_t size;
    Scene scene;
    kiriReplay at;
} Moment;

typedef struct Viewer {
    Scene scene;
    SceneReplay replay;
    Options options;
    Shot shot;
    Image image;
    Moment* moments; /* of each KEEP_EVERYth tick, as far as it was played */
    int32_t momentCount;
    float turn, rise, away; /* of the camera: rad, rad, sizes */
    int32_t steps;          /* of the keys that go nearer; each goes a fifth of the way */
    bool isPlaying, isTurning, isScrubbing, showsBudget;
    int32_t held; /* ticks a picture while an arrow key is down */
    int32_t mouse[2];
} Viewer;

static bool Keep(Viewer* viewer)
{
    Moment moment = { .scene = viewer->scene, .at = viewer->replay.at };
    kiriWorld_Snapshot(viewer->scene.world, NULL, 0, &moment.size);
    moment.bytes = malloc((size_t)moment.size);
    if (moment.bytes == NULL ||
        kiriWorld_Snapshot(viewer->scene.world, moment.bytes, moment.size, &moment.size) != KIRI_OK) {
        free(moment.bytes);
        return false;
    }
    viewer->moments[viewer->momentCount++] = moment;
    return true;
}

/* Goes to a tick, from the last kept one before it. False: it says on stderr what failed. */
static bool GoTo(Viewer* viewer, int32_t tick)
{
    tick = tick < 0 ? 0 : tick > viewer->replay.ticks ? viewer->replay.ticks : tick;
    int32_t nearest = tick > 0 ? (tick - 1) / KEEP_EVERY : 0; /* before it: only a tick that is played has times */
    nearest = nearest < viewer->momentCount ? nearest : viewer->momentCount - 1;
    if (tick < viewer->scene.tick || nearest * KEEP_EVERY > viewer->scene.tick) {
        const Moment* moment = &viewer->moments[nearest];
        if (kiriWorld_Restore(viewer->scene.world, moment->bytes, moment->size) != KIRI_OK) {
            fprintf(stderr, "%s\n", kiriWorld_GetLastError(viewer->scene.world));
            return false;
        }
        viewer->scene = moment->scene;
        viewer->replay.at = moment->at;
    }
    while (viewer->scene.tick < tick) {
        kiriResult result = SceneReplay_Tick(&viewer->replay, &viewer->scene);
        if (result < 0) {
            fprintf(stderr, "%s\n", kiriWorld_GetLastError(viewer->scene.world));
            return false;
        }
        if (viewer->scene.tick == viewer->momentCount * KEEP_EVERY && !Keep(viewer)) {
            fprintf(stderr, "no memory for ticks\n");
            return false;
        }
    }
    return true;
}

static double ReadClock(void* user)
{
    struct timespec now;
    (void)user;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool Open(Viewer* viewer, const char* path)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.clock = ReadClock;
    if (!SceneReplay_Start(&viewer->replay, path, &viewer->scene, Scene_GetType(0), &def)) {
        return false;
    }
    if (viewer->scene.type != &viewer->scene.paced) { /* the camera is to be moved */
        viewer->scene.paced = *viewer->scene.type;
        viewer->scene.type = &viewer->scene.paced;
    }
    const Camera* camera = &viewer->scene.paced.camera;
    float way[3];
    for (int k = 0; k < 3; k++) {
        way[k] = camera->eye[k] - camera->target[k];
    }
    viewer->away = sqrtf(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    viewer->turn = atan2f(way[0], -way[1]);
    viewer->rise = asinf(way[2] / viewer->away);
    viewer->moments = calloc((size_t)viewer->replay.ticks / KEEP_EVERY + 1, sizeof(Moment));
    return viewer->moments != NULL && Shot_Create(&viewer->shot, WIDTH, HEIGHT) &&
           Image_Create(&viewer->image, WIDTH, HEIGHT) && Keep(viewer);
}

static void Close(Viewer* viewer)
{
    for (int32_t i = 0; i < viewer->momentCount; i++) {
        free(viewer->moments[i].bytes);
    }
    free(viewer->moments);
    Image_Free(&viewer->image);
    Shot_Destroy(&viewer->shot);
    SceneReplay_Free(&viewer->replay);
    if (viewer->scene.world != NULL) {
        Scene_Stop(&viewer->scene);
    }
}

/* parts: of the colour in 4; the rest shows through. */
static void FillBox(Image* image, int32_t left, int32_t top, int32_t width, int32_t height, const uint8_t color[3],
                    int32_t parts)
{
    for (int32_t i = 0; i < 3 * width * height; i++) {
        uint8_t* at = image->rgb + 3 * (image->width * (top + i / 3 / width) + left + i / 3 % width) + i % 3;
        *at = (uint8_t)((parts * color[i % 3] + (4 - parts) * *at) / 4);
    }
}

/* Draws milliseconds of each stage of the last tick, and below them the items of kiriBudget. A whole bar is 8 ms. */
static void DrawBudget(const kiriWorld* world, Image* image)
{
    enum { LEFT = 12, TOP = 12, ROW = 20, SIZE = 13, NAME = 90, BAR_WIDTH = 200, PANEL = 380 };
    static const uint8_t paper[3] = { 250, 248, 242 }, ink[3] = { 40, 42, 52 }, bar[3] = { 74, 122, 180 };
    kiriProfile profile;
    char words[160];
    double sum = 0.0;
    kiriWorld_GetProfile(world, &profile);
    FillBox(image, LEFT, TOP, PANEL, ROW * (KIRI_STAGE_COUNT + 3), paper, 2);
    for (int32_t i = 0; i <= KIRI_STAGE_COUNT; i++) {
        double seconds = i < KIRI_STAGE_COUNT ? profile.seconds[i] : sum;
        int32_t top = TOP + 6 + ROW * i, width = (int32_t)(fmin(1.0, seconds / 8e-3) * BAR_WIDTH + 0.5);
        sum += seconds;
        snprintf(words, sizeof words, "%.2f ms", 1e3 * seconds);
        Image_WriteText(image, i < KIRI_STAGE_COUNT ? kiriGetStageName(i) : "all", SIZE, LEFT + 8, top, ink);
        FillBox(image, LEFT + NAME, top + 2, width, ROW - 8, bar, 4);
        Image_WriteText(image, words, SIZE, LEFT + NAME + BAR_WIDTH + 10, top, ink);
    }
    snprintf(words, sizeof words, "%d triangles, %d cells, %d samples, %d iterations", profile.trianglesSplit,
             profile.cellsSettled, profile.samplesRefreshed, profile.solverIterations);
    Image_WriteText(image, words, SIZE, LEFT + 8, TOP + 12 + ROW * (KIRI_STAGE_COUNT + 1), ink);
}

/* A bar below: the ticks played so far are dark, and the tick shown is red. */
static bool Draw(Viewer* viewer)
{
    Camera* camera = &viewer->scene.paced.camera;
    float away = viewer->away * powf(0.8f, (float)viewer->steps);
    camera->eye[0] = camera->target[0] + away * cosf(viewer->rise) * sinf(viewer->turn);
    camera->eye[1] = camera->target[1] - away * cosf(viewer->rise) * cosf(viewer->turn);
    camera->eye[2] = camera->target[2] + away * sinf(viewer->rise);
    viewer->scene.type = &viewer->scene.paced;
    if (!Shot_Take(&viewer->shot, &viewer->scene, &viewer->options, &viewer->image)) {
        fprintf(stderr, "no memory for a picture\n");
        return false;
    }
    if (viewer->showsBudget) {
        DrawBudget(viewer->scene.world, &viewer->image);
    }
    float scale = (float)(WIDTH - 1) / (float)viewer->replay.ticks;
    int32_t shown = (int32_t)((float)viewer->scene.tick * scale), played = (viewer->momentCount - 1) * KEEP_EVERY;
    for (int32_t i = 0; i < WIDTH * BAR; i++) {
        int32_t x = i % WIDTH;
        uint8_t* pixel = viewer->image.rgb + 3 * (WIDTH * (HEIGHT - BAR) + i);
        memset(pixel, (float)x <= (float)played * scale ? 90 : 160, 3);
        if (abs(x - shown) < 3) {
            memcpy(pixel, (uint8_t[3]){ 210, 40, 40 }, 3);
        }
    }
    return true;
}

static bool Scrub(Viewer* viewer, int32_t x)
{
    return GoTo(viewer, (int32_t)((float)x / (float)(WIDTH - 1) * (float)viewer->replay.ticks + 0.5f));
}

static bool TakeMouse(Viewer* viewer, const GameEvent* event)
{
    if (event->type == GAME_DOWN) {
        viewer->isScrubbing = event->y >= HEIGHT - BAR;
        viewer->isTurning = !viewer->isScrubbing;
        viewer->isPlaying = viewer->isPlaying && !viewer->isScrubbing;
    } else if (event->type == GAME_UP) {
        viewer->isTurning = viewer->isScrubbing = false;
    } else if (viewer->isTurning) {
        viewer->turn -= 0.01f * (float)(event->x - viewer->mouse[0]);
        viewer->rise += 0.01f * (float)(event->y - viewer->mouse[1]);
        viewer->rise = fmaxf(-1.5f, fminf(viewer->rise, 1.5f));
    }
    viewer->mouse[0] = event->x;
    viewer->mouse[1] = event->y;
    return !viewer->isScrubbing || Scrub(viewer, event->x);
}

static void TakeKey(Viewer* viewer, const GameEvent* event)
{
    DebugOptions* debug = &viewer->options.debug;
    bool isDown = event->type == GAME_KEY_PRESSED;
    const struct {
        int32_t key;
        bool* flag;
    } flags[] = { { ' ', &viewer->isPlaying }, { 'r', &debug->regions },     { 'l', &debug->links },
                  { 'c', &debug->cells },      { 'f', &debug->axes },        { 'k', &debug->contacts },
                  { 'o', &debug->points },     { 'b', &viewer->showsBudget } };
    for (size_t i = 0; isDown && i < sizeof flags / sizeof flags[0]; i++) {
        *flags[i].flag ^= event->key == flags[i].key;
    }
    if (isDown && event->key == 'w') {
        debug->weightsOf = debug->weightsOf == DEBUG_ALL_FRAMES ? DEBUG_NO_FRAME : DEBUG_ALL_FRAMES;
    }
    viewer->shot.debug.raster.side = 0.0f; /* another raster may be wanted */
    if (event->key == GAME_KEY_LEFT || event->key == GAME_KEY_RIGHT) {
        viewer->held = !isDown ? 0 : event->key == GAME_KEY_LEFT ? -1 : 1;
        viewer->isPlaying = false;
    }
    if (isDown && (event->key == GAME_KEY_UP || event->key == GAME_KEY_DOWN)) {
        viewer->steps += event->key == GAME_KEY_UP ? 1 : -1;
    }
}

static bool Step(Viewer* viewer)
{
    int32_t step = viewer->held != 0 ? viewer->held : viewer->isPlaying;
    return step == 0 || GoTo(viewer, viewer->scene.tick + step);
}

static bool Show(Viewer* viewer, const char* path)
{
    Window* window = Window_Open(path, WIDTH, HEIGHT, true);
    WindowWishes wishes = { .quit = window == NULL };
    bool isFine = window != NULL && GoTo(viewer, 1);
    viewer->isPlaying = true;
    while (isFine && !wishes.quit) {
        GameEvent events[MOST_EVENTS];
        int32_t count = Window_Poll(window, 0, events, MOST_EVENTS, &wishes);
        for (int32_t i = 0; i < count && isFine; i++) {
            if (events[i].type == GAME_KEY_PRESSED || events[i].type == GAME_KEY_RELEASED) {
                TakeKey(viewer, &events[i]);
            } else {
                isFine = TakeMouse(viewer, &events[i]);
            }
        }
        isFine = isFine && Step(viewer) && Draw(viewer);
        if (isFine) {
            Window_Show(window, &viewer->image);
        }
    }
    if (window != NULL) {
        Window_Close(window);
    }
    return isFine;
}

/* Presses the keys of a word: <, >, - and + are arrows. */
static void PressKeys(Viewer* viewer, const char* keys)
{
    static const char arrows[] = "<>+-"; /* as the keys of game.h are numbered */
    for (; *keys != '\0'; keys++) {
        const char* arrow = strchr(arrows, *keys);
        GameEvent event = { .type = GAME_KEY_PRESSED, .key = *keys };
        if (arrow != NULL) {
            event.key = GAME_KEY_LEFT + (int32_t)(arrow - arrows);
        }
        TakeKey(viewer, &event);
    }
}

/* Without a window: goes to each tick in turn, presses its keys, and writes its picture. */
static bool Write(Viewer* viewer, int count, char** words)
{
    const Options options = viewer->options;
    for (int i = 0; i + 1 < count; i += 2) {
        char* keys;
        long tick = strtol(words[i], &keys, 10);
        viewer->options = options;
        viewer->steps = 0;
        viewer->isPlaying = viewer->showsBudget = false;
        viewer->held = 0;
        if (!GoTo(viewer, (int32_t)tick)) {
            return false;
        }
        PressKeys(viewer, keys);
        if (!Step(viewer) || !Draw(viewer) || !Image_WritePng(&viewer->image, words[i + 1])) {
            fprintf(stderr, "cannot write %s\n", words[i + 1]);
            return false;
        }
    }
    return true;
}

int main(int count, char** words)
{
    static Viewer viewer;
    if (count < 2 || count % 2 != 0) {
        fprintf(
            stderr,
            "kiri-view FILE                        a recording or a save, in a window\n"
            "kiri-view FILE [TICK[KEYS] PNG] ...   pictures of ticks after keys, without a window: 60rl, with arrows "
            "as <>+-\n\n"
            "Space plays and stops; left and right go by ticks, up and down nearer and away; the mouse turns, or drags "
            "the bar.\n"
            "R regions, L links, C cells, F frames, K contacts, O collision points, W weights, B budget, Escape.\n");
        return 2;
    }
    viewer.options = (Options){ .debug = { .weightsOf = DEBUG_NO_FRAME, .contacts = true } };
    bool isFine =
        Open(&viewer, words[1]) && (count > 2 ? Write(&viewer, count - 2, words + 2) : Show(&viewer, words[1]));
    Close(&viewer);
    return isFine ? 0 : 1;
}
