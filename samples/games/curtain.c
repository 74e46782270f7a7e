/* Curtain: cut the marked shapes out of a curtain in the wind, so that they fall into the basket. */
#include "curtain_parts.h"
#include "games.h"

#include <math.h>
#include <string.h>

enum {
    SUBSTEPS = 2,
    LEAVE_TICKS = 3 * GAME_RATE, /* a curtain that was let go */
    GATHER_TICKS = GAME_RATE     /* rings move on the rail */
};

const CanvasCamera curtainCamera = { { 0.25f, -3.55f, 1.62f }, { 0.0f, 0.0f, 0.86f }, 34.0f, 0.0f };
const float curtainRail = 1.66f;
const float basketSize[3] = { 0.56f, 0.56f, 0.18f };
const float ballRadius = 0.17f, ballPlace[3] = { 0.86f, -0.18f, 0.17f };
const float tableSize[3] = { 0.42f, 0.40f, 0.24f }, tablePlace[3] = { -0.86f, -0.12f, 0.12f };
const float basketY = 0.0f;
const float crumbArea = 0.0012f;

static const float basketReach = 0.38f; /* m: how far it goes to either side */

/* ---- Wind and basket -------------------------------------------------------------------------------------------- */

/* -1 to 1, from whole numbers. */
static float GetNoise(uint32_t seed, int32_t at)
{
    uint32_t h = seed * 747796405u + (uint32_t)at * 2891336453u;
    h = (h >> 15 ^ h) * 2246822519u;
    h = (h >> 13 ^ h) * 3266489917u;
    return (float)((h >> 16 ^ h) >> 8) / 8388608.0f - 1.0f;
}

/* The same in between: smooth, and another number every `period` seconds. */
static float GetGust(uint32_t seed, int32_t tick, float period)
{
    float t = (float)tick * GAME_DT / period;
    int32_t at = (int32_t)t;
    float share = t - (float)at, from = GetNoise(seed, at), to = GetNoise(seed, at + 1);
    return from + share * share * (3.0f - 2.0f * share) * (to - from);
}

static bool BlowWind(Curtain* curtain)
{
    const Level* level = curtain->level;
    float gust = 0.7f * GetGust(1, curtain->tick, 1.4f) + 0.3f * GetGust(2, curtain->tick, 0.45f);
    curtain->wind[0] = level->wind * GetGust(3, curtain->tick, 4.0f) + level->gusts * gust;
    curtain->wind[1] = 0.4f * level->gusts * GetGust(4, curtain->tick, 0.8f);
    curtain->wind[2] = 0.1f * level->gusts * gust;
    kiriWind wind = { .density = 1.2f, .drag = 1.2f, .lift = 0.1f };
    memcpy(wind.velocity, curtain->wind, sizeof wind.velocity);
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        if (curtain->cloths[i].sheet != 0 &&
            !Curtain_Check(curtain, kiriSheet_SetWind(curtain->world, curtain->cloths[i].sheet, &wind), "wind")) {
            return false;
        }
    }
    return true;
}

/* A new curtain is flat. Its rings go by turns before and behind the rail, and a little nearer to each other: it falls
   in folds. */
static void GatherCloth(Curtain* curtain, Cloth* cloth)
{
    int32_t age = curtain->tick - cloth->madeAt;
    float share = fminf(1.0f, (float)age / GATHER_TICKS), aside = share < 0.3f ? share / 0.3f : 1.0f;
    for (int32_t i = 0; i < cloth->ringCount && age <= GATHER_TICKS; i++) {
        Ring* ring = &cloth->rings[i];
        ring->target[0] = ring->start[0] * (1.0f + share * (curtain->level->gather - 1.0f));
        ring->target[1] = ring->start[1] + aside * (i % 2 == 0 ? 0.05f : -0.05f);
        if (ring->pin != 0) {
            kiriPin_SetTarget(curtain->world, ring->pin, ring->target);
        }
    }
}

static bool MoveBasket(Curtain* curtain)
{
    float x = curtain->basketX + curtain->basketSpeed * GAME_DT;
    x = fminf(basketReach, fmaxf(-basketReach, x));
    const float velocity[3] = { (x - curtain->basketX) / GAME_DT, 0.0f, 0.0f }, still[3] = { 0.0f };
    curtain->basketBefore = curtain->basketX;
    curtain->basketX = x;
    for (int32_t i = 0; i < BASKET_PARTS; i++) {
        if (!Curtain_Check(curtain, kiriObstacle_SetVelocity(curtain->world, curtain->basket[i], velocity, still),
                           "basket")) {
            return false;
        }
    }
    return true;
}

/* ---- Curtains come and go --------------------------------------------------------------------------------------- */

bool Curtain_HasMark(const Curtain* curtain, const Cloth* cloth, int32_t mark)
{
    kiriPointState point;
    int32_t piece;
    return cloth->sheet != 0 && cloth->leftAt == 0 && !cloth->collected[mark] &&
           kiriSheet_GetPoint(curtain->world, cloth->sheet, curtain->level->mark[mark].middle, &point) == KIRI_OK &&
           kiriFrame_GetPiece(curtain->world, point.frame, &piece) == KIRI_OK && Curtain_IsHeld(curtain, cloth, piece);
}

static bool IsUsedUp(const Curtain* curtain, const Cloth* cloth)
{
    int32_t left = 0, rings = 0;
    for (int32_t m = 0; m < curtain->level->marks; m++) {
        left += Curtain_HasMark(curtain, cloth, m);
    }
    for (int32_t i = 0; i < cloth->ringCount; i++) {
        rings += cloth->rings[i].pin != 0;
    }
    return left == 0 || rings < 3;
}

/* What goes soon need not touch other sheets: a heap of cloth that does is the dearest of all. */
static void LetFall(Curtain* curtain, Cloth* cloth)
{
    kiriSheetSettings settings;
    for (int32_t i = 0; i < cloth->ringCount; i++) {
        if (cloth->rings[i].pin != 0) {
            kiriDestroyPin(curtain->world, cloth->rings[i].pin);
        }
        cloth->rings[i].pin = 0;
    }
    if (kiriSheet_GetSettings(curtain->world, cloth->sheet, &settings) == KIRI_OK) {
        settings.touchesSheets = 0;
        kiriSheet_SetSettings(curtain->world, cloth->sheet, &settings);
    }
    cloth->leftAt = curtain->tick;
}

/* In a level without end: lets go of a curtain without marks, hangs up a new one, and takes the old one away later. */
static bool ChangeCloths(Curtain* curtain)
{
    bool hangs = false;
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        Cloth* cloth = &curtain->cloths[i];
        if (cloth->sheet == 0) {
            continue;
        }
        if (cloth->leftAt == 0 && curtain->tick - cloth->madeAt > SCRAP_TICKS && IsUsedUp(curtain, cloth)) {
            LetFall(curtain, cloth);
        } else if (cloth->leftAt != 0 && curtain->tick - cloth->leftAt > LEAVE_TICKS) {
            Curtain_DropCloth(curtain, cloth);
            continue;
        }
        hangs = hangs || cloth->leftAt == 0 || curtain->tick - cloth->leftAt < GAME_RATE;
    }
    for (int32_t i = 0; i < MAX_CLOTHS && !hangs; i++) {
        if (curtain->cloths[i].sheet == 0) {
            return Curtain_AddCloth(curtain, &curtain->cloths[i], 0);
        }
    }
    return true;
}

/* ---- The tick --------------------------------------------------------------------------------------------------- */

static void TakeEvents(Curtain* curtain)
{
    const kiriEvent* events;
    int32_t count = 0;
    kiriWorld_GetEvents(curtain->world, &events, &count);
    for (int32_t i = 0; i < count; i++) {
        if (events[i].type == KIRI_EVENT_PIECE_OFF) {
            Curtain_AddScrap(curtain, &events[i]);
        } else if (events[i].type == KIRI_EVENT_PIN_BROKE) {
            Curtain_BreakPin(curtain, events[i].pin);
        }
    }
}

static void MakeSounds(Curtain* curtain)
{
    kiriProfile profile;
    kiriObstacleState bottom;
    kiriWorld_GetProfile(curtain->world, &profile);
    if (profile.cutSegments > 0) {
        curtain->undo.hasCut = true;
        Sounds_Play(curtain->host.sounds, SOUND_CUT, 0.7f);
    }
    if (kiriObstacle_GetState(curtain->world, curtain->basket[0], &bottom) == KIRI_OK) {
        if (curtain->landed == 0 && bottom.contacts > 0) {
            Sounds_Play(curtain->host.sounds, SOUND_THUD, 0.6f);
        }
        curtain->landed = bottom.contacts;
    }
}

static void MoveTrails(Curtain* curtain)
{
    for (int32_t i = 0; i < MAX_POINTERS; i++) {
        Pointer* pointer = &curtain->pointers[i];
        if (pointer->blade == 0) {
            pointer->trailCount -= pointer->trailCount > 0;
            continue;
        }
        memmove(pointer->trail + 2, pointer->trail, sizeof(float) * 2 * (TRAIL - 1));
        pointer->trail[0] = (float)pointer->x;
        pointer->trail[1] = (float)pointer->y;
        pointer->trailCount += pointer->trailCount < TRAIL;
    }
}

static void Judge(Curtain* curtain)
{
    const Level* level = curtain->level;
    if (curtain->state != GAME_PLAYING || level->wanted == 0) {
        return;
    }
    if (curtain->collected >= level->wanted) {
        curtain->state = GAME_WON;
        curtain->score += level->seconds - curtain->tick / GAME_RATE;
        Sounds_Play(curtain->host.sounds, SOUND_GOAL, 1.0f);
    } else if (curtain->tick >= level->seconds * GAME_RATE) {
        curtain->state = GAME_LOST;
        Sounds_Play(curtain->host.sounds, SOUND_LOST, 1.0f);
    }
}

static bool Curtain_Tick(void* game)
{
    Curtain* curtain = game;
    bool fine = BlowWind(curtain) && MoveBasket(curtain);
    for (int32_t i = 0; fine && i < MAX_CLOTHS; i++) {
        GatherCloth(curtain, &curtain->cloths[i]);
        fine = curtain->cloths[i].sheet == 0 || Track_BeforeTick(&curtain->cloths[i].track, curtain->world);
    }
    kiriResult result = fine ? kiriWorld_Tick(curtain->world, GAME_DT, SUBSTEPS) : KIRI_ERROR_MEMORY;
    if (result != KIRI_DIVERGED && !Curtain_Check(curtain, result, "tick")) {
        return false;
    }
    curtain->tick++;
    TakeEvents(curtain);
    Curtain_LookAtScraps(curtain);
    Curtain_SweepCrumbs(curtain);
    MakeSounds(curtain);
    MoveTrails(curtain);
    Judge(curtain);
    return curtain->level->wanted > 0 || ChangeCloths(curtain);
}

/* FNV-1a. */
static uint64_t AddToHash(uint64_t hash, const void* data, size_t bytes)
{
    const uint8_t* byte = data;
    for (size_t i = 0; i < bytes; i++) {
        hash = (hash ^ byte[i]) * 1099511628211u;
    }
    return hash;
}

static void Curtain_GetStatus(void* game, GameStatus* status)
{
    Curtain* curtain = game;
    *status = (GameStatus){ .state = curtain->state, .score = curtain->score };
    kiriWorld_GetStateHash(curtain->world, &status->hash);
    status->hash = AddToHash(status->hash, &curtain->basketX, sizeof curtain->basketX);
    status->hash = AddToHash(status->hash, curtain->scraps, sizeof(Scrap) * (size_t)curtain->scrapCount);
    status->hash = AddToHash(status->hash, &curtain->score, sizeof curtain->score);
}

const GameType curtainGame = { .name = "curtain",
                               .about = "cut the marked shapes out of a curtain in the wind",
                               .keys = "Left button: cut   Right button: pull   Space: leave the hand   "
                                       "Arrows or A, D: basket",
                               .levels = 5,
                               .start = Curtain_Start,
                               .stop = Curtain_Stop,
                               .event = Curtain_Event,
                               .tick = Curtain_Tick,
                               .draw = Curtain_Draw,
                               .getStatus = Curtain_GetStatus,
                               .demo = Curtain_Demo };
