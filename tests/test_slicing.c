/* A game in which banners of paper and cotton are sliced. Pieces touch each other, a floor, a ball and a box; they fall
   asleep and wake; each piece becomes a new sheet. In `make test` the game is short. With the argument `all`, as in
   `make long`, it takes 60 seconds and 20 seeds; `all 7 2` runs two seeds from 7 on. Sanitizers, assertions and the
   validator look on. */
#include "host.h"

enum { ROWS = 2, MOST_BANNERS = 50, MOST_PARTS = 60, SWIPE = 20, STROKE = 3, WORKERS = 4 };

static bool isLong = false;
static uint32_t firstSeed = 0, seeds = 1;
static int banners = 16;

typedef struct Game {
    Host host; /* first: its hooks get the game */
    uint32_t seed;
    kiriSheet banners[MOST_BANNERS];
    kiriSheet parts[MOST_PARTS]; /* detached pieces, the oldest first */
    int32_t partCount, made, slept;
    kiriObstacle ball;
    kiriBlade blade;
    float from[2], to[2]; /* of the stroke, x and z */
} Game;

/* A crew of one, who works on ranges from the last one on. */
static void* DoBackwards(void* user, kiriTaskFn* task, int32_t items, int32_t range, void* context)
{
    for (int32_t start = (items - 1) / range * range; start >= 0; start -= range) {
        task(start, start + range < items ? start + range : items, context);
    }
    return NULL;
}

static void NothingToFinish(void* user, void* handle)
{
}

static void HangBanner(Game* game, int i)
{
    kiriSheetDef def = DefaultSheet();
    kiriGetMaterial(i % 2 == 0 ? KIRI_MATERIAL_PAPER : KIRI_MATERIAL_COTTON, &def.material);
    def.material.airDamping = 2.0f;
    def.gridResolution = 8;
    def.frameCount = 4;
    def.maxFrames = 12;
    def.touchesSheets = 1;
    def.crumbArea = 0.001f;
    def.sleepSpeed = 0.02f; /* soon: the game is short */
    Set3(def.position, 0.35f * (float)(i / ROWS), 0.05f * (float)(i % ROWS), 0.3f + 0.05f * (float)(i % ROWS));
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    game->banners[i] = Host_AddRectangle(&game->host, &def, 0.3f, 0.5f, 4, 6);
    World_Hinge(game->host.world, game->banners[i], (float[]){ 0.0f, 0.5f }, (float[]){ 0.3f, 0.5f });
}

static void AddObstacles(Game* game)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_PLANE);
    kiriObstacle id = World_AddObstacle(game->host.world, &def);
    def.type = KIRI_OBSTACLE_BOX;
    def.size[0] = def.size[1] = 0.4f;
    def.size[2] = 0.3f;
    def.position[0] = 2.0f;
    def.position[2] = 0.1f;
    OK(kiriCreateObstacle(game->host.world, &def, &id));
    def.type = KIRI_OBSTACLE_SPHERE;
    def.radius = 0.1f;
    def.position[2] = 0.15f;
    OK(kiriCreateObstacle(game->host.world, &def, &game->ball));
}

static void StartGame(Game* game, uint32_t seed, bool hasBudget, bool hasTasks)
{
    memset(game, 0, sizeof(*game));
    game->host.failAt = -1;
    game->host.every = isLong ? 5 : 20;
    game->seed = 2654435761u * (seed + 1);
    kiriWorldDef def = Host_Def(&game->host);
    def.user = game;
    if (hasTasks) {
        def.startTask = DoBackwards;
        def.finishTask = NothingToFinish;
        def.workerCount = WORKERS;
    }
    OK(kiriCreateWorld(&def, &game->host.world));
    const kiriBudget budget = { 60, 1000, 200, 40 };
    if (hasBudget) {
        OK(kiriWorld_SetBudget(game->host.world, &budget));
    }
    AddObstacles(game);
    for (int i = 0; i < banners; ++i) {
        HangBanner(game, i);
    }
}

/* The oldest part goes where there are too many. */
static void KeepPart(Game* game, kiriSheet part)
{
    if (game->partCount == MOST_PARTS) {
        OK(kiriDestroySheet(game->host.world, game->parts[0]));
        memmove(&game->parts[0], &game->parts[1], sizeof(kiriSheet) * (MOST_PARTS - 1));
        game->partCount -= 1;
    }
    game->parts[game->partCount++] = part;
    game->made += 1;
}

/* Detaches each new piece, and destroys crumbs. Then old parts may go: before, they may still have events. */
static void DetachAll(Game* game)
{
    enum { MOST = 256 };
    kiriEvent come[MOST];
    kiriSheet parts[MOST];
    const kiriEvent* events;
    int32_t count, partCount = 0;
    OK(kiriWorld_GetEvents(game->host.world, &events, &count));
    count = count < MOST ? count : MOST;
    memcpy(come, events, sizeof(kiriEvent) * (size_t)count);
    for (int32_t i = 0; i < count; ++i) {
        kiriSheet part = 0;
        if (come[i].type == KIRI_EVENT_PIECE_OFF && come[i].crumb) {
            assert_true(kiriFrame_DestroyPiece(game->host.world, come[i].frame) >= KIRI_OK);
        } else if (come[i].type == KIRI_EVENT_PIECE_OFF) {
            kiriResult result = kiriFrame_DetachPiece(game->host.world, come[i].frame, &part);
            assert_true(result >= KIRI_OK || result == KIRI_ERROR_STATE);
        } else if (come[i].type == KIRI_EVENT_PIECE_DETACHED) {
            part = come[i].sheet;
        }
        if (part != 0) {
            parts[partCount++] = part;
        }
    }
    for (int32_t i = 0; i < partCount; ++i) {
        KeepPart(game, parts[i]);
    }
}

/* Across all that hangs, or over the heap: the edge stands along y. */
static void MoveBlade(Game* game, int tick)
{
    kiriWorld* world = game->host.world;
    int step = tick % SWIPE;
    if (step == 0) {
        OK(kiriBeginBlade(world, 0, &game->blade));
        game->from[0] = (float)RandomBetween(&game->seed, -0.3, 0.35 * banners / ROWS);
        game->to[0] = game->from[0] + (float)RandomBetween(&game->seed, 0.5, 1.5);
        for (int i = 0; i < 2; ++i) {
            (i == 0 ? game->from : game->to)[1] = (float)RandomBetween(&game->seed, 0.1, 0.9);
        }
    }
    if (step <= STROKE) {
        float t = (float)step / STROKE, x = game->from[0] + t * (game->to[0] - game->from[0]);
        float z = game->from[1] + t * (game->to[1] - game->from[1]);
        float from[3] = { x, -0.5f, z }, to[3] = { x, 0.5f, z };
        assert_true(kiriBlade_MoveEdge(world, game->blade, from, to) >= KIRI_OK);
    }
    if (step == STROKE) {
        OK(kiriBlade_End(world, game->blade));
    }
}

/* To and fro, and still for a while at the ends. */
static void MoveBall(Game* game, int tick)
{
    int part = tick % 400;
    float speed = part < 150 ? 1.2f : part >= 200 && part < 350 ? -1.2f : 0.0f;
    OK(kiriObstacle_SetVelocity(game->host.world, game->ball, (float[]){ speed, 0.0f, 0.0f },
                                (float[]){ 0.0f, 0.0f, 0.0f }));
}

/* A banner of which little is left is taken down, and a new one hangs there. */
static void RenewBanner(Game* game, int i)
{
    if (Host_Totals(&game->host, game->banners[i]).area < 0.05) {
        OK(kiriDestroySheet(game->host.world, game->banners[i]));
        HangBanner(game, i);
    }
}

static void CountSleepers(Game* game)
{
    for (int32_t i = 0; i < game->partCount + banners; ++i) {
        int32_t awake = 1;
        OK(kiriSheet_IsAwake(game->host.world, i < banners ? game->banners[i] : game->parts[i - banners], &awake));
        game->slept += !awake;
    }
}

static void Play(uint32_t seed, bool hasBudget, bool hasTasks, int ticks)
{
    Game game;
    StartGame(&game, seed, hasBudget, hasTasks);
    for (int tick = 0; tick < ticks; ++tick) {
        MoveBall(&game, tick);
        MoveBlade(&game, tick);
        kiriResult result = Host_Tick(&game.host, 1.0f / 60.0f, 2);
        assert_true(result == KIRI_OK || result == KIRI_PENDING);
        DetachAll(&game);
        RenewBanner(&game, tick % banners);
        CountSleepers(&game);
    }
    print_message("seed %u%s%s: %d parts, %d asleep in a tick\n", seed, hasBudget ? ", budget" : "",
                  hasTasks ? ", tasks" : "", game.made, game.slept / ticks);
    assert_true(game.made > 0);
    Host_Stop(&game.host);
}

TEST(Games)
{
    for (uint32_t seed = firstSeed; seed < firstSeed + seeds; ++seed) {
        Play(seed, (seed & 1) != 0, (seed & 2) != 0, isLong ? 3600 : 200);
    }
}

SETUP
{
    isLong = count > 1;
    seeds = isLong ? 20 : 4;
    if (count > 3) { /* first seed, count */
        firstSeed = (uint32_t)strtoul(words[2], NULL, 10);
        seeds = (uint32_t)strtoul(words[3], NULL, 10);
    }
    banners = isLong ? MOST_BANNERS : banners;
}
