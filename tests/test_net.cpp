/* The game Net: its scripts win all levels, and crates and sheets keep the momentum that they have together. */
#include "../samples/games/games.h"
#include "../samples/games/net_game.h"
#include "../samples/games/play.h"
#include "../samples/games/script.h"
#include "support.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

static GameStatus StatusOf(const Play& play)
{
    GameStatus status;
    netGame.getStatus(play.game, &status);
    return status;
}

/* Plays the script of a level to its end, or to the tick in which the level is over. */
static GameStatus PlayScript(int level, int64_t* peak)
{
    char path[64];
    std::snprintf(path, sizeof path, "samples/games/scripts/net_%d.txt", level);
    Script script;
    Play play;
    assert_true(Script_Read(&script, path));
    assert_int_equal(script.level, level);
    assert_true(Play_Start(&play, &netGame, level));
    while (play.tick < script.end && StatusOf(play).state == GAME_PLAYING) {
        while (const GameEvent* event = Script_Take(&script, play.tick)) {
            assert_true(Play_Send(&play, event));
        }
        assert_true(Play_Tick(&play));
    }
    GameStatus status = StatusOf(play);
    *peak = play.peak;
    Play_Stop(&play);
    Script_Free(&script);
    return status;
}

TEST(ScriptsWin)
{
    for (int level = 1; level <= netGame.levels; ++level) {
        int64_t peak;
        GameStatus status = PlayScript(level, &peak);
        assert_int_equal(status.state, GAME_WON);
        assert_true(status.score >= 800);
        assert_true(peak < 64 << 20);
    }
}

/* Who does nothing wins nothing. */
TEST(NothingWinsNothing)
{
    for (int level = 1; level <= netGame.levels; ++level) {
        Play play;
        assert_true(Play_Start(&play, &netGame, level));
        for (int tick = 0; tick < RUNS(300); ++tick) {
            assert_true(Play_Tick(&play));
        }
        assert_int_equal(StatusOf(play).state, GAME_PLAYING);
        Play_Stop(&play);
    }
}

TEST(ReplayIsTheSame)
{
    int64_t peak;
    GameStatus first = PlayScript(3, &peak), second = PlayScript(3, &peak);
    assert_true(first.hash == second.hash);
    assert_int_equal(first.score, second.score);
}

/* ---- Going back -------------------------------------------------------------------------------------------------- */

/* Sends what a script has from event `next` on, `late` ticks later, and ticks until `end`. */
static void PlayFrom(Play* play, const Script& script, int next, int late, int end)
{
    for (; play->tick < end; Play_Tick(play)) {
        for (; next < script.count && script.events[next].tick + late <= play->tick; ++next) {
            assert_true(Play_Send(play, &script.events[next]));
        }
    }
}

/* The events that begin strokes. */
static std::vector<int> StrokesOf(const Script& script)
{
    std::vector<int> strokes;
    for (int i = 0; i < script.count; ++i) {
        if (script.events[i].type == GAME_DOWN) {
            strokes.push_back(i);
        }
    }
    return strokes;
}

/* Takes strokes back until one has not been made yet, and makes them again: sheets, crates and score are as they were
   then, and become what they became. */
static void TakeBack(int level, size_t stroke, int more)
{
    char path[64];
    std::snprintf(path, sizeof path, "samples/games/scripts/net_%d.txt", level);
    Script script;
    Play play;
    assert_true(Script_Read(&script, path));
    const std::vector<int> strokes = StrokesOf(script);
    assert_true(stroke < strokes.size());
    const int first = strokes[stroke], begin = script.events[first].tick,
              end = script.events[strokes.back()].tick + more;
    assert_true(Play_Start(&play, &netGame, level));
    PlayFrom(&play, script, 0, 0, begin);
    const GameStatus before = StatusOf(play);
    PlayFrom(&play, script, first, 0, end);
    const GameStatus after = StatusOf(play);
    const GameEvent undo = { end, GAME_KEY_PRESSED, 0, 0, 0, 0, 'z' };
    for (size_t i = stroke; i < strokes.size(); ++i) {
        assert_true(StatusOf(play).hash != before.hash);
        assert_true(Play_Send(&play, &undo));
    }
    assert_true(StatusOf(play).hash == before.hash);
    assert_int_equal(StatusOf(play).score, before.score);
    PlayFrom(&play, script, first, end - begin, end + end - begin);
    assert_true(StatusOf(play).hash == after.hash);
    assert_int_equal(StatusOf(play).state, after.state);
    Play_Stop(&play);
    assert_int_equal(play.bytes, 0);
    Script_Free(&script);
}

TEST(StrokesAreTakenBack)
{
    TakeBack(1, 0, 180); /* the crate has come to rest elsewhere */
    TakeBack(4, 0, 60);
    TakeBack(5, 0, 100);
    TakeBack(6, 0, 60);
    TakeBack(6, 2, 100);
}

/* A stroke in the air takes nothing's place: the one before it is taken back. While a stroke is made it ends. */
TEST(OnlyCutsAreTakenBack)
{
    Script script;
    Play play;
    assert_true(Script_Read(&script, "samples/games/scripts/net_1.txt"));
    const int first = StrokesOf(script)[0], begin = script.events[first].tick;
    assert_true(Play_Start(&play, &netGame, 1));
    const GameEvent undo = { 0, GAME_KEY_PRESSED, 0, 0, 0, 0, 'z' };
    PlayFrom(&play, script, 0, 0, begin);
    const uint64_t before = StatusOf(play).hash;
    assert_true(Play_Send(&play, &undo)); /* there is nothing to take back */
    assert_true(StatusOf(play).hash == before);
    PlayFrom(&play, script, first, 0, begin + 60);
    const GameEvent down = { 0, GAME_DOWN, 0, GAME_LEFT, 20, 20, 0 }, up = { 0, GAME_UP, 0, GAME_LEFT, 40, 20, 0 };
    assert_true(Play_Send(&play, &down) && Play_Tick(&play));
    assert_true(Play_Send(&play, &up) && Play_Tick(&play));
    assert_true(Play_Send(&play, &down) && Play_Tick(&play));
    assert_true(Play_Send(&play, &undo));
    assert_true(StatusOf(play).hash == before);
    assert_true(Play_Tick(&play) && Play_Send(&play, &up) && Play_Tick(&play));
    assert_int_equal(StatusOf(play).state, GAME_PLAYING);
    Play_Stop(&play);
    Script_Free(&script);
}

/* A swipe parts the rope of level 1 whenever it comes, whether the rope swings up or down. */
TEST(SwipesPart)
{
    for (int start = 10; start < 70; ++start) {
        Play play;
        assert_true(Play_Start(&play, &netGame, 1));
        for (int tick = 0; tick < start + 12; ++tick) {
            int step = tick - start;
            GameEvent event = { tick, step == 0 ? GAME_DOWN : step == 7 ? GAME_UP : GAME_MOVE, 0, 0, 570, 216, 0 };
            event.button = event.type == GAME_MOVE ? 0 : GAME_LEFT;
            event.y += 25 * std::min(step, 6);
            assert_true(step < 0 || step > 7 || Play_Send(&play, &event));
            assert_true(Play_Tick(&play));
        }
        const NetGame& game = *static_cast<NetGame*>(play.game);
        kiriCounts counts;
        assert_int_equal(kiriSheet_GetCounts(game.world, game.handles[0], &counts), KIRI_OK);
        assert_int_equal(game.cuts, 1);
        assert_int_equal(counts.pieces, 2);
        Play_Stop(&play);
    }
}

/* ---- Momentum ---------------------------------------------------------------------------------------------------- */

static b2Vec2 MomentumOf(const NetGame& game, float* mass)
{
    b2Vec2 sum(0.0f, 0.0f);
    *mass = 0.0f;
    for (const NetBody& body : game.bodies) {
        if (body.body != nullptr) {
            sum += body.body->GetMass() / NET_UNITS * body.body->GetLinearVelocity();
            *mass += body.body->GetMass();
        }
    }
    for (kiriSheet sheet : game.handles) {
        kiriTotals totals;
        assert_int_equal(kiriSheet_GetTotals(game.world, sheet, &totals), KIRI_OK);
        sum += b2Vec2(static_cast<float>(totals.momentum[0]), static_cast<float>(totals.momentum[2]));
        *mass += static_cast<float>(totals.mass);
    }
    return sum;
}

/* What pins and the air gave to the sheets in the last tick, N s. The air takes 0.3 of the momentum in a second. */
static b2Vec2 GivenToSheets(const NetGame& game)
{
    b2Vec2 sum(0.0f, 0.0f);
    for (kiriSheet sheet : game.handles) {
        kiriPin pins[8];
        int32_t count = 0;
        assert_int_equal(kiriSheet_GetPins(game.world, sheet, pins, 8, &count), KIRI_OK);
        for (int32_t i = 0; i < count; ++i) {
            double force[3], torque[3];
            assert_int_equal(kiriPin_GetReaction(game.world, pins[i], force, torque), KIRI_OK);
            sum += GAME_DT * b2Vec2(static_cast<float>(force[0]), static_cast<float>(force[2]));
        }
        kiriTotals totals;
        assert_int_equal(kiriSheet_GetTotals(game.world, sheet, &totals), KIRI_OK);
        sum -= 0.3f * GAME_DT * b2Vec2(static_cast<float>(totals.momentum[0]), static_cast<float>(totals.momentum[2]));
    }
    return sum;
}

/* A crate falls on a rope and is caught, in level 1: until somebody cuts, nothing but weight, pins and air acts on
   both. */
TEST(MomentumIsKept)
{
    Play play;
    assert_true(Play_Start(&play, &netGame, 1));
    const NetGame& game = *static_cast<NetGame*>(play.game);
    float mass, most = 0.0f;
    b2Vec2 expected = MomentumOf(game, &mass);
    float fastest = 0.0f, slowest = 1e9f;
    for (int tick = 0; tick < 60; ++tick) {
        assert_true(Play_Tick(&play));
        expected += GivenToSheets(game) + b2Vec2(0.0f, -9.81f * GAME_DT * mass);
        b2Vec2 momentum = MomentumOf(game, &mass);
        most = std::fmax(most, (momentum - expected).Length());
        fastest = std::fmax(fastest, momentum.Length());
        slowest = tick > 20 ? std::fmin(slowest, momentum.Length()) : slowest;
    }
    assert_true(fastest > 0.3f && slowest < 0.1f * fastest); /* it fell, and was caught */
    assert_true(most < 0.01f * fastest);
    Play_Stop(&play);
}
