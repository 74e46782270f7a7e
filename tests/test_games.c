/* What games share (scripts, camera, sounds, memory), and Curtain: it goes on as its script says, and can be won. */
#include "../samples/canvas_parts.h"
#include "../samples/games/games.h"
#include "../samples/games/play.h"
#include "../samples/games/script.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static char filePath[1024]; /* beside the program */

/* ---- Scripts ---------------------------------------------------------------------------------------------------- */

static void WriteText(const char* text)
{
    FILE* file = fopen(filePath, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

TEST(ScriptKeepsEvents)
{
    const GameEvent events[] = { { 3, GAME_DOWN, 0, GAME_LEFT, 480, 360, 0 },
                                 { 3, GAME_MOVE, 0, 0, -5, 719, 0 },
                                 { 4, GAME_KEY_PRESSED, 0, 0, 0, 0, GAME_KEY_SPACE },
                                 { 9, GAME_KEY_RELEASED, 0, 0, 0, 0, GAME_KEY_DOWN },
                                 { 9, GAME_KEY_PRESSED, 0, 0, 0, 0, 'r' },
                                 { 70, GAME_UP, 2, GAME_RIGHT, 1, 2, 0 } };
    enum { COUNT = sizeof events / sizeof events[0] };
    FILE* file = fopen(filePath, "w");
    assert_non_null(file);
    Script_WriteStart(file, "curtain", 4);
    for (int i = 0; i < COUNT; i++) {
        Script_WriteEvent(file, &events[i]);
    }
    Script_WriteEnd(file, 100);
    assert_int_equal(fclose(file), 0);

    SCOPED(Script, script, Script_Free);
    assert_true(Script_Read(&script, filePath));
    assert_string_equal(script.game, "curtain");
    assert_int_equal(script.level, 4);
    assert_int_equal(script.end, 100);
    assert_null(Script_Take(&script, 2));
    for (int i = 0; i < COUNT; i++) {
        const GameEvent* event = Script_Take(&script, 70);
        assert_non_null(event);
        assert_memory_equal(event, &events[i], sizeof events[i]);
    }
    assert_null(Script_Take(&script, 1000));
}

TEST(ScriptRefusesNonsense)
{
    static const char* const texts[] = { "3 jump 0 1\n", "down 0 1 2 3\n", "3 down 0 1 2\n", "3 keydown enter\n",
                                         "5 move 0 1 2\n4 move 0 1 2\n" };
    SCOPED(Script, script, Script_Free);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        WriteText(texts[i]);
        assert_false(Script_Read(&script, filePath));
    }
    WriteText("# a comment\n\ngame net\n3 keydown up\n");
    assert_true(Script_Read(&script, filePath));
    assert_int_equal(script.count, 1);
    assert_int_equal(script.end, 4);
}

/* ---- Camera and sounds ------------------------------------------------------------------------------------------ */

TEST(RaysMeetWhatIsSeenThere)
{
    const CanvasCamera cameras[2] = { { { 0.3f, -3.0f, 1.5f }, { 0.0f, 0.2f, 0.8f }, 34.0f, 0.0f },
                                      { { 0.0f, -5.0f, 1.0f }, { 0.5f, 0.0f, 1.2f }, 0.0f, 2.5f } };
    const float point[3] = { 0.4f, 0.3f, 1.1f };
    for (int i = 0; i < 2; i++) {
        float x, y, origin[3], direction[3], along = 0.0f, off = 0.0f;
        assert_true(CanvasCamera_Project(&cameras[i], point, &x, &y));
        CanvasCamera_GetRay(&cameras[i], x, y, origin, direction);
        for (int k = 0; k < 3; k++) {
            along += (point[k] - origin[k]) * direction[k];
        }
        for (int k = 0; k < 3; k++) {
            off += fabsf(origin[k] + along * direction[k] - point[k]);
        }
        assert_true(along > 0.0f && off < 1e-5f);
        assert_true(CanvasCamera_Project(&cameras[i], cameras[i].target, &x, &y));
        assert_true(fabsf(x - 0.5f * GAME_WIDTH) < 1e-3f && fabsf(y - 0.5f * GAME_HEIGHT) < 1e-3f);
    }
}

/* Dark pixels of a text lie between the top of its capitals and the line below; later shapes cover it. */
TEST(TextIsSeen)
{
    const Color white = { 1.0f, 1.0f, 1.0f, 1.0f }, black = { 0.0f, 0.0f, 0.0f, 1.0f };
    const CanvasCamera camera = { { 0.0f, -1.0f, 0.0f }, { 0.0f, 0.0f, 0.0f }, 45.0f, 0.0f };
    Canvas* canvas = Canvas_Create(GAME_WIDTH, GAME_HEIGHT, 1, OverlayText_Draw);
    Image image;
    int32_t dark[3] = { 0, 0, 0 };
    assert_non_null(canvas);
    assert_true(Image_Create(&image, GAME_WIDTH, GAME_HEIGHT));
    for (int32_t covered = 0; covered < 2; covered++) {
        Canvas_Begin(canvas, &camera, white, white);
        Canvas_AddText(canvas, 300.0f, 200.0f, 40.0f, 0.0f, black, "HIM");
        if (covered) {
            Canvas_AddRectangle(canvas, 0.0f, 0.0f, GAME_WIDTH, GAME_HEIGHT, white);
        }
        assert_true(Canvas_Finish(canvas, &image));
        for (int32_t i = 0; i < GAME_WIDTH * GAME_HEIGHT; i++) {
            int32_t x = i % GAME_WIDTH, y = i / GAME_WIDTH, isOutside = y < 199 || y >= 241 || x < 300 || x >= 420;
            dark[covered ? 2 : isOutside] += image.rgb[3 * i] < 128;
        }
    }
    Image_Free(&image);
    Canvas_Destroy(canvas);
    if (dark[0] == 0) {
        print_message("no font: text not tested\n");
        skip();
    }
    assert_true(dark[0] > 500);
    assert_int_equal(dark[1], 0);
    assert_int_equal(dark[2], 0);
}

TEST(SoundsAreHeardAndEnd)
{
    static float samples[2 * SOUND_RATE];
    Sounds sounds;
    for (int32_t type = 0; type < SOUND_COUNT; type++) {
        double loud = 0.0;
        Sounds_Init(&sounds);
        Sounds_Play(&sounds, type, 1.0f);
        Sounds_Mix(&sounds, samples, 2 * SOUND_RATE);
        for (int i = 0; i < 2 * SOUND_RATE; i++) {
            assert_true(fabsf(samples[i]) <= 1.0f);
            loud += i < SOUND_RATE / 10 ? fabsf(samples[i]) : 0.0;
        }
        assert_true(loud / (SOUND_RATE / 10) > 1e-3);
        assert_true(samples[2 * SOUND_RATE - 1] == 0.0f);
    }
}

/* ---- Curtain ---------------------------------------------------------------------------------------------------- */

enum { RECORD_TICKS = 420, MAX_RECORD = 1000 };

typedef struct Recorded {
    GameEvent events[MAX_RECORD];
    int32_t count;
    GameStatus end;
} Recorded;

/* The game waits for `wait` ticks, and then plays itself. `recorded` keeps its events. */
static void PlayDemo(const GameType* type, int32_t level, int32_t wait, int32_t ticks, Recorded* recorded)
{
    static Play play;
    recorded->count = 0;
    assert_true(Play_Start(&play, type, level));
    for (int32_t i = 0; i < ticks; i++) {
        int32_t count =
            i < wait ? 0 : type->demo(play.game, recorded->events + recorded->count, MAX_RECORD - recorded->count);
        for (int32_t k = 0; k < count; k++) {
            recorded->events[recorded->count].tick = i;
            assert_true(Play_Send(&play, &recorded->events[recorded->count++]));
        }
        assert_true(Play_Tick(&play));
    }
    type->getStatus(play.game, &recorded->end);
    Play_Stop(&play);
    assert_int_equal(play.bytes, 0);
}

static uint64_t PlayEvents(Play* play, const Recorded* recorded, int32_t firstTick)
{
    int32_t next = 0;
    for (int32_t i = 0; i < RECORD_TICKS; i++) {
        for (; next < recorded->count && recorded->events[next].tick == i; next++) {
            GameEvent event = recorded->events[next];
            event.tick += firstTick;
            assert_true(Play_Send(play, &event));
        }
        assert_true(Play_Tick(play));
    }
    GameStatus status;
    play->type->getStatus(play->game, &status);
    return status.hash;
}

/* What was recorded gives the same again, after a restart, too. */
FIGURE(CurtainIsReplayed)
{
    static Recorded recorded;
    static Play play;
    const GameEvent restart = { RECORD_TICKS, GAME_KEY_PRESSED, 0, 0, 0, 0, 'r' };
    PlayDemo(&curtainGame, 2, 0, RECORD_TICKS, &recorded);
    assert_true(recorded.count > 100);
    assert_true(Play_Start(&play, &curtainGame, 2));
    assert_true(PlayEvents(&play, &recorded, 0) == recorded.end.hash);
    assert_true(Play_Send(&play, &restart));
    assert_true(PlayEvents(&play, &recorded, RECORD_TICKS) == recorded.end.hash);
    Play_Stop(&play);
}

/* The file has the calls since the level was last started: they go as they did without the game. */
TEST(CallsAreRecorded)
{
    static Play play;
    static uint8_t bytes[1 << 18];
    const GameEvent restart = { 2, GAME_KEY_PRESSED, 0, 0, 0, 0, 'r' };
    assert_true(Play_StartRecorded(&play, &curtainGame, 2, filePath));
    for (int32_t i = 0; i < 32; i++) {
        assert_true(i != restart.tick || Play_Send(&play, &restart));
        assert_true(Play_Tick(&play));
    }
    assert_true(Play_Stop(&play));
    assert_false(Play_StartRecorded(&play, &curtainGame, 2, "build/no such folder/calls"));
    FILE* file = fopen(filePath, "rb");
    assert_non_null(file);
    int64_t size = (int64_t)fread(bytes, 1, sizeof bytes, file);
    fclose(file);

    kiriWorldDef def;
    SCOPED_WORLD(world) = NULL;
    kiriReplay replay = { 0 };
    kiriDefaultWorldDef(&def);
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_OK);
    kiriResult result = KIRI_PENDING;
    while (result == KIRI_PENDING) {
        result = kiriWorld_Replay(world, bytes, size, &replay);
    }
    assert_int_equal(result, KIRI_OK);
    assert_int_equal(replay.ticks, 30);
}

static uint64_t HashOf(const Play* play)
{
    GameStatus status;
    play->type->getStatus(play->game, &status);
    return status.hash;
}

static bool IsCut(const GameEvent* event)
{
    return event->type == GAME_DOWN && event->button == GAME_LEFT;
}

/* Plays until the tick; returns the hash before the first cut. */
static uint64_t PlayUntil(Play* play, const Recorded* recorded, int32_t tick, int32_t delay)
{
    uint64_t before = 0;
    int32_t next = 0;
    for (int32_t i = 0; i < tick; i++) {
        for (; next < recorded->count && recorded->events[next].tick == i; next++) {
            GameEvent event = recorded->events[next];
            before = before == 0 && IsCut(&event) ? HashOf(play) : before;
            event.tick += delay;
            assert_true(Play_Send(play, &event));
        }
        assert_true(Play_Tick(play));
    }
    return before;
}

/* A cut that is taken back was never there: what follows goes as it did. */
TEST(CutsAreTakenBack)
{
    static Recorded recorded;
    static Play play;
    PlayDemo(&curtainGame, 5, 0, RECORD_TICKS, &recorded);
    int32_t first = 0;
    while (first < recorded.count && !IsCut(&recorded.events[first])) {
        first++;
    }
    assert_true(first < recorded.count);
    /* The basket stands still 240 ticks later: a key that is held is not taken back. */
    int32_t tick = recorded.events[first].tick, more = 240;
    assert_true(Play_Start(&play, &curtainGame, 5));
    uint64_t before = PlayUntil(&play, &recorded, tick + more, 0), after = HashOf(&play);
    const GameEvent undo = { tick + more, GAME_KEY_PRESSED, 0, 0, 0, 0, 'z' };
    assert_true(after != before);
    for (int32_t k = 0; k < 8 && HashOf(&play) != before; k++) {
        assert_true(Play_Send(&play, &undo));
    }
    assert_true(HashOf(&play) == before);
    assert_true(Play_Send(&play, &undo)); /* there is no more to take back */
    assert_true(HashOf(&play) == before);
    for (int32_t i = tick, next = first; i < RECORD_TICKS; i++) {
        for (; next < recorded.count && recorded.events[next].tick == i; next++) {
            GameEvent event = recorded.events[next];
            event.tick += more;
            assert_true(Play_Send(&play, &event));
        }
        assert_true(Play_Tick(&play));
    }
    assert_true(HashOf(&play) == recorded.end.hash);
    Play_Stop(&play);
    assert_int_equal(play.bytes, 0);
}

/* The demo cuts the same lines whatever the cloth does, so it does not win every level. */
FIGURE(CurtainIsWon)
{
    static Recorded recorded;
    int32_t won = 0;
    for (int32_t i = 0; i < 4 && won == 0; i++) {
        PlayDemo(&curtainGame, 1 + i, 0, 12 * GAME_RATE, &recorded);
        won += recorded.end.state == GAME_WON;
        assert_true(recorded.end.state != GAME_WON || recorded.end.score > 90);
    }
    assert_int_equal(won, 1);
}

/* Mesa keeps its buffers of a picture. */
const char* __lsan_default_suppressions(void);
const char* __lsan_default_suppressions(void)
{
    return "leak:libOSMesa";
}

static void RemoveFile(void)
{
    remove(filePath);
}

SETUP
{
    snprintf(filePath, sizeof filePath, "%s.script", words[0]);
    atexit(RemoveFile);
}
