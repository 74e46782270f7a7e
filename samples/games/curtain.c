/* Curtain: cut the marked shapes out of a curtain in the wind, so that they fall into the basket. */
#include "curtain_parts.h"
#include "games.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    COLUMNS = 44,
    ROWS = 32,
    FRAME_ROWS = 6,
    MAX_FRAMES = 160,
    SUBSTEPS = 2,
    BASKET_TICKS = 60,             /* a mark is ours when it has been in the basket for so long */
    SCRAP_TICKS = 20 * GAME_RATE,  /* other scraps are swept away after that, */
    LEAST_SCRAP_TICKS = GAME_RATE, /* or when there are many: the oldest, but none younger than this */
    MANY_SCRAPS = 10,
    CRUMB_TICKS = 2 * GAME_RATE, /* how often crumbs are swept away */
    LEAVE_TICKS = 3 * GAME_RATE, /* a curtain that was let go */
    GATHER_TICKS = GAME_RATE     /* rings move on the rail */
};

const GameCamera curtainCamera = { { 0.25f, -3.55f, 1.62f }, { 0.0f, 0.0f, 0.86f }, 34.0f, 0.0f };
const float curtainRail = 1.66f;
const float basketSize[3] = { 0.56f, 0.56f, 0.18f };
const float ballRadius = 0.17f, ballPlace[3] = { 0.86f, -0.18f, 0.17f };
const float tableSize[3] = { 0.42f, 0.40f, 0.24f }, tablePlace[3] = { -0.86f, -0.12f, 0.12f };

static const float wall = 0.05f;          /* of the basket, m: how thick */
static const float basketY = 0.0f;        /* m: below the curtain; a light piece glides to either side of it */
static const float basketReach = 0.38f;   /* m: how far it goes to either side */
static const float basketPace = 0.5f;     /* m/s */
static const float crumbArea = 0.0012f;   /* m^2 */
static const float handStiffness = 60.0f; /* N/m */
static const float handForce = 7.0f;      /* N: with more it slips out of the fingers */

/* ---- Making what there is --------------------------------------------------------------------------------------- */

static bool Check(const Curtain* curtain, kiriResult result, const char* what)
{
    if (result < 0) {
        fprintf(stderr, "curtain: tick %d: %s: %s: %s\n", curtain->tick, what, kiriGetResultName(result),
                kiriWorld_GetLastError(curtain->world));
    }
    return result >= 0;
}

static bool AddRings(Curtain* curtain, Cloth* cloth, float depth)
{
    const Level* level = curtain->level;
    cloth->ringCount = level->rings;
    for (int32_t i = 0; i < level->rings; i++) {
        Ring* ring = &cloth->rings[i];
        kiriPinDef def;
        kiriDefaultPinDef(&def);
        def.restPoint[0] = level->width * (float)i / (float)(level->rings - 1);
        def.restPoint[1] = level->height;
        def.target[0] = def.restPoint[0] - 0.5f * level->width;
        def.target[1] = depth;
        def.target[2] = curtainRail - 0.06f;
        def.breakForce = level->breakForce;
        memcpy(ring->start, def.target, sizeof ring->start);
        memcpy(ring->target, def.target, sizeof ring->target);
        if (!Check(curtain, kiriCreatePin(curtain->world, cloth->sheet, &def, &ring->pin), "ring")) {
            return false;
        }
    }
    return true;
}

static void FillSheetDef(const Curtain* curtain, float depth, kiriSheetDef* def)
{
    const Level* level = curtain->level;
    kiriDefaultSheetDef(def);
    def->position[0] = -0.5f * level->width;
    def->position[1] = depth;
    def->position[2] = curtainRail - 0.06f - level->height;
    def->axisV[1] = 0.0f;
    def->axisV[2] = 1.0f;
    def->material.airDamping = 0.4f;
    def->maxFrames = MAX_FRAMES;
    def->gridResolution = 64;
    def->crumbArea = crumbArea;
    def->skinning = KIRI_SKINNING_SMOOTH;
    def->touchesSheets = 1;
    def->contactThickness = 0.008f;
}

/* Rows of frames below the rings: where the folds are to be. Frames that do not know of the folds let it buckle in other
   ways, upwards above the rail for one. */
static int32_t PlaceFrames(const Level* level, float* points)
{
    const float inside = 0.03f; /* m: from the border */
    for (int32_t i = 0; i < level->rings * FRAME_ROWS; i++) {
        int32_t ring = i % level->rings, row = i / level->rings;
        float u = level->width * (float)ring / (float)(level->rings - 1);
        points[2 * i] = fmaxf(inside, fminf(level->width - inside, u));
        points[2 * i + 1] = level->height * ((float)row + 0.5f) / FRAME_ROWS;
    }
    return level->rings * FRAME_ROWS;
}

static bool AddCloth(Curtain* curtain, Cloth* cloth, int32_t layer)
{
    static float rest[2 * (COLUMNS + 1) * (ROWS + 1)];
    static int32_t indices[6 * COLUMNS * ROWS];
    static float framePoints[2 * MAX_RINGS * FRAME_ROWS];
    const Level* level = curtain->level;
    float depth = 0.14f * (float)layer;
    memset(cloth, 0, sizeof *cloth);
    cloth->madeAt = curtain->tick;
    cloth->rgb = malloc(3 * TEXTURE_SIZE * TEXTURE_SIZE);
    if (cloth->rgb == NULL) {
        fprintf(stderr, "curtain: no memory\n");
        return false;
    }
    Level_Paint(level, curtain->clothsMade, cloth->rgb);
    cloth->texture = (CanvasTexture){ cloth->rgb,   TEXTURE_SIZE,  TEXTURE_SIZE,
                                      level->width, level->height, (uint32_t)++curtain->clothsMade };
    kiriFillRectangle(level->width, level->height, COLUMNS, ROWS, rest, indices);
    kiriSheetDef def;
    FillSheetDef(curtain, depth, &def);
    def.restPositions = rest;
    def.vertexCount = (COLUMNS + 1) * (ROWS + 1);
    def.indices = indices;
    def.triangleCount = 2 * COLUMNS * ROWS;
    def.framePoints = framePoints;
    def.frameCount = PlaceFrames(level, framePoints);
    if (!Check(curtain, kiriCreateSheet(curtain->world, &def, &cloth->sheet), "sheet")) {
        return false;
    }
    Track_Init(&cloth->track, cloth->sheet);
    return AddRings(curtain, cloth, depth);
}

void Basket_GetPart(const Curtain* curtain, int32_t part, float x, float size[3], float position[3])
{
    (void)curtain;
    int axis = part < 3 ? 0 : 1;
    float side = part % 2 == 1 ? 1.0f : -1.0f;
    memcpy(size, basketSize, sizeof basketSize);
    position[0] = x;
    position[1] = basketY;
    position[2] = 0.5f * basketSize[2];
    if (part == 0) {
        size[2] = wall;
        position[2] = 0.5f * wall;
        return;
    }
    size[axis] = wall;
    position[axis] += side * 0.5f * (basketSize[axis] - wall);
}

static bool AddObstacle(Curtain* curtain, kiriObstacleDef* def, const float position[3], kiriObstacle* obstacle)
{
    memcpy(def->position, position, sizeof def->position);
    return Check(curtain, kiriCreateObstacle(curtain->world, def, obstacle), "obstacle");
}

static bool AddObstacles(Curtain* curtain)
{
    kiriObstacle obstacle;
    kiriObstacleDef def;
    kiriDefaultObstacleDef(&def);
    def.type = KIRI_OBSTACLE_PLANE;
    bool fine = AddObstacle(curtain, &def, (float[3]){ 0.0f, 0.0f, 0.0f }, &obstacle);
    def.type = KIRI_OBSTACLE_SPHERE;
    def.radius = ballRadius;
    fine = fine && AddObstacle(curtain, &def, ballPlace, &obstacle);
    def.type = KIRI_OBSTACLE_BOX;
    memcpy(def.size, tableSize, sizeof def.size);
    fine = fine && AddObstacle(curtain, &def, tablePlace, &obstacle);
    for (int32_t i = 0; fine && i < BASKET_PARTS; i++) {
        float position[3];
        Basket_GetPart(curtain, i, curtain->basketX, def.size, position);
        fine = AddObstacle(curtain, &def, position, &curtain->basket[i]);
    }
    return fine;
}

static void DropCloth(Curtain* curtain, Cloth* cloth)
{
    if (cloth->sheet != 0) {
        kiriDestroySheet(curtain->world, cloth->sheet);
    }
    Track_Free(&cloth->track);
    free(cloth->rgb);
    memset(cloth, 0, sizeof *cloth);
}

static void Curtain_Stop(void* game)
{
    Curtain* curtain = game;
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        DropCloth(curtain, &curtain->cloths[i]);
    }
    Undo_Clear(&curtain->undo);
    kiriDestroyWorld(curtain->world);
    free(curtain);
}

static void* Curtain_Start(int32_t number, const GameHost* host)
{
    Curtain* curtain = calloc(1, sizeof(Curtain));
    if (curtain == NULL || kiriCreateWorld(&host->worldDef, &curtain->world) != KIRI_OK) {
        fprintf(stderr, "curtain: no memory\n");
        free(curtain);
        return NULL;
    }
    curtain->host = *host;
    curtain->level = &levels[number - 1];
    curtain->demo.mark = -1;
    Undo_Init(&curtain->undo, free);
    bool fine = AddObstacles(curtain);
    for (int32_t i = 0; fine && i < curtain->level->curtains; i++) {
        fine = AddCloth(curtain, &curtain->cloths[i], i);
    }
    if (!fine) {
        Curtain_Stop(curtain);
        return NULL;
    }
    return curtain;
}

/* ---- Hands and blades ------------------------------------------------------------------------------------------- */

static int32_t FindCloth(const Curtain* curtain, kiriSheet sheet)
{
    for (int32_t i = 0; i < MAX_CLOTHS; i++) {
        if (sheet != 0 && curtain->cloths[i].sheet == sheet) {
            return i;
        }
    }
    return -1;
}

static void LetGo(Curtain* curtain, Hand* hand)
{
    if (hand->pin != 0) {
        kiriDestroyPin(curtain->world, hand->pin); /* it may be gone already, with what it held */
    }
    hand->pin = 0;
}

static Hand* FindHand(Curtain* curtain, int32_t pointer)
{
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        if (curtain->hands[i].pin != 0 && curtain->hands[i].pointer == pointer) {
            return &curtain->hands[i];
        }
    }
    return NULL;
}

/* A pin in the material that the ray meets. With all hands in use the first one lets go. */
static void Grab(Curtain* curtain, int32_t pointer, const float origin[3], const float direction[3])
{
    kiriSheet sheet = 0;
    kiriHit hit;
    kiriWorld_Raycast(curtain->world, origin, direction, 20.0f, &sheet, &hit);
    if (sheet == 0) {
        return;
    }
    Hand* hand = &curtain->hands[0];
    for (int32_t i = 0; i < MAX_HANDS && hand->pin != 0; i++) {
        hand = curtain->hands[i].pin == 0 ? &curtain->hands[i] : hand;
    }
    LetGo(curtain, hand);
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    memcpy(def.restPoint, hit.restPoint, sizeof def.restPoint);
    memcpy(def.target, hit.position, sizeof def.target);
    def.stiffness = handStiffness;
    def.breakForce = handForce;
    if (kiriCreatePin(curtain->world, sheet, &def, &hand->pin) == KIRI_OK) {
        hand->cloth = FindCloth(curtain, sheet);
        hand->pointer = pointer;
        hand->away = hit.distance - 0.08f; /* a little towards the player */
        memcpy(hand->target, hit.position, sizeof hand->target);
    }
}

static void MoveHand(Curtain* curtain, Hand* hand, const float origin[3], const float direction[3])
{
    for (int i = 0; i < 3; i++) {
        hand->target[i] = origin[i] + hand->away * direction[i];
    }
    hand->target[2] = fmaxf(hand->target[2], 0.02f);
    if (kiriPin_SetTarget(curtain->world, hand->pin, hand->target) != KIRI_OK) {
        hand->pin = 0; /* what it held is gone */
    }
}

static void PointerDown(Curtain* curtain, const GameEvent* event, const float origin[3], const float direction[3])
{
    Pointer* pointer = &curtain->pointers[event->pointer];
    if (event->button == GAME_RIGHT) {
        Grab(curtain, event->pointer, origin, direction);
        return;
    }
    Curtain_Keep(curtain);
    if (kiriBeginBlade(curtain->world, 0, &pointer->blade) == KIRI_OK) {
        kiriBlade_MoveRay(curtain->world, pointer->blade, origin, direction, 20.0f);
        pointer->trailCount = 0;
    }
}

static void PointerMove(Curtain* curtain, const GameEvent* event, const float origin[3], const float direction[3])
{
    Pointer* pointer = &curtain->pointers[event->pointer];
    Hand* hand = FindHand(curtain, event->pointer);
    if (pointer->blade != 0) {
        kiriBlade_MoveRay(curtain->world, pointer->blade, origin, direction, 20.0f);
    }
    if (hand != NULL) {
        MoveHand(curtain, hand, origin, direction);
    }
}

static void PointerUp(Curtain* curtain, const GameEvent* event)
{
    Pointer* pointer = &curtain->pointers[event->pointer];
    Hand* hand = FindHand(curtain, event->pointer);
    if (event->button == GAME_RIGHT && hand != NULL) {
        LetGo(curtain, hand);
    } else if (event->button == GAME_LEFT && pointer->blade != 0) {
        kiriBlade_End(curtain->world, pointer->blade);
        pointer->blade = 0;
    }
}

/* Space: hands that pull stay where they are; with none that does, all let go. */
static void KeepHands(Curtain* curtain)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        if (curtain->hands[i].pin != 0 && curtain->hands[i].pointer >= 0) {
            curtain->hands[i].pointer = -1;
            kept++;
        }
    }
    for (int32_t i = 0; i < MAX_HANDS && kept == 0; i++) {
        LetGo(curtain, &curtain->hands[i]);
    }
}

static void Key(Curtain* curtain, const GameEvent* event)
{
    float way = event->key == GAME_KEY_LEFT || event->key == 'a'    ? -1.0f
                : event->key == GAME_KEY_RIGHT || event->key == 'd' ? 1.0f
                                                                    : 0.0f;
    bool pressed = event->type == GAME_KEY_PRESSED;
    if (way != 0.0f && (pressed || curtain->basketSpeed * way > 0.0f)) {
        curtain->basketSpeed = pressed ? way * basketPace : 0.0f;
    } else if (event->key == ' ' && pressed) {
        KeepHands(curtain);
    } else if (event->key == 'z' && pressed) {
        Curtain_Undo(curtain);
    }
}

static void Curtain_Event(void* game, const GameEvent* event)
{
    Curtain* curtain = game;
    if (event->type == GAME_KEY_PRESSED || event->type == GAME_KEY_RELEASED) {
        Key(curtain, event);
        return;
    }
    if (event->pointer < 0 || event->pointer >= MAX_POINTERS) {
        return;
    }
    float origin[3], direction[3];
    GameCamera_GetRay(&curtainCamera, (float)event->x, (float)event->y, origin, direction);
    curtain->pointers[event->pointer].x = event->x;
    curtain->pointers[event->pointer].y = event->y;
    if (event->type == GAME_DOWN) {
        PointerDown(curtain, event, origin, direction);
    } else if (event->type == GAME_MOVE) {
        PointerMove(curtain, event, origin, direction);
    } else {
        PointerUp(curtain, event);
    }
}

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
            !Check(curtain, kiriSheet_SetWind(curtain->world, curtain->cloths[i].sheet, &wind), "wind")) {
            return false;
        }
    }
    return true;
}

/* A new curtain is flat. Its rings go by turns before and behind the rail, and a little nearer to each other: it falls in
   folds. */
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
        if (!Check(curtain, kiriObstacle_SetVelocity(curtain->world, curtain->basket[i], velocity, still), "basket")) {
            return false;
        }
    }
    return true;
}

/* ---- Scraps ----------------------------------------------------------------------------------------------------- */

/* Of the same in one tick the first one is enough. */
static void AddNote(Curtain* curtain, const float place[3], const char* text)
{
    for (int32_t i = 0; i < MAX_NOTES; i++) {
        if (curtain->notes[i].since == curtain->tick && strcmp(curtain->notes[i].text, text) == 0) {
            return;
        }
    }
    Note* note = &curtain->notes[curtain->noteCount++ % MAX_NOTES];
    snprintf(note->text, sizeof note->text, "%s", text);
    memcpy(note->place, place, sizeof note->place);
    note->since = curtain->tick;
}

/* Whether a ring or a hand holds the piece. */
static bool IsHeld(const Curtain* curtain, const Cloth* cloth, int32_t piece)
{
    kiriPin pins[MAX_RINGS + MAX_HANDS];
    int32_t count = 0, other;
    kiriSheet_GetPins(curtain->world, cloth->sheet, pins, MAX_RINGS + MAX_HANDS, &count);
    for (int32_t i = 0; i < count && i < MAX_RINGS + MAX_HANDS; i++) {
        kiriPinState pin;
        kiriPointState point;
        if (kiriPin_GetState(curtain->world, pins[i], &pin) == KIRI_OK &&
            kiriSheet_GetPoint(curtain->world, cloth->sheet, pin.from, &point) == KIRI_OK &&
            kiriFrame_GetPiece(curtain->world, point.frame, &other) == KIRI_OK && other == piece) {
            return true;
        }
    }
    return false;
}

static bool IsInBasket(const Curtain* curtain, const kiriPieceState* piece)
{
    return fabs(piece->center[0] - curtain->basketX) < 0.5 * basketSize[0] &&
           fabs(piece->center[1] - basketY) < 0.5 * basketSize[1] && piece->center[2] < basketSize[2] + 0.05;
}

/* The mark whose middle is in the piece and that nobody has yet; -1: none. */
static int32_t FindMark(const Curtain* curtain, const Cloth* cloth, int32_t piece)
{
    for (int32_t m = 0; m < curtain->level->marks; m++) {
        kiriPointState point;
        int32_t other = -1;
        if (!cloth->collected[m] &&
            kiriSheet_GetPoint(curtain->world, cloth->sheet, curtain->level->mark[m].middle, &point) == KIRI_OK &&
            kiriFrame_GetPiece(curtain->world, point.frame, &other) == KIRI_OK && other == piece) {
            return m;
        }
    }
    return -1;
}

/* A hundred points for a mark that is cut to the line; none for one that is half as large again. */
static void Collect(Curtain* curtain, Cloth* cloth, int32_t mark, const kiriPieceState* piece)
{
    float corners[2 * MARK_CORNERS], wanted = Mark_GetOutline(&curtain->level->mark[mark], corners);
    float off = fabsf((float)piece->area - wanted) / wanted;
    int32_t points = (int32_t)(100.0f * fmaxf(0.0f, 1.0f - 2.0f * off));
    const float place[3] = { (float)piece->center[0], (float)piece->center[1], basketSize[2] };
    char text[24];
    snprintf(text, sizeof text, points > 0 ? "+%d" : "too rough", points);
    AddNote(curtain, place, text);
    cloth->collected[mark] = true;
    curtain->score += points;
    curtain->collected += points > 0;
    Sounds_Play(curtain->host.sounds, points > 0 ? SOUND_GOAL : SOUND_LOST, 0.8f);
}

/* True when the scrap is to be taken out of the list. */
static bool LookAtScrap(Curtain* curtain, Scrap* scrap)
{
    Cloth* cloth = &curtain->cloths[scrap->cloth];
    kiriPieceState state;
    int32_t piece, age = curtain->tick - scrap->offAt;
    if (kiriFrame_GetPiece(curtain->world, scrap->frame, &piece) != KIRI_OK ||
        kiriSheet_GetPiece(curtain->world, cloth->sheet, piece, &state) != KIRI_OK) {
        return true; /* it is gone */
    }
    if (!IsInBasket(curtain, &state)) {
        scrap->inBasketSince = 0;
    } else if (scrap->inBasketSince == 0) {
        scrap->inBasketSince = curtain->tick;
    } else if (curtain->tick - scrap->inBasketSince == BASKET_TICKS) {
        int32_t mark = FindMark(curtain, cloth, piece);
        if (mark >= 0) {
            Collect(curtain, cloth, mark, &state);
        }
    }
    bool tooMany = curtain->scrapCount > MANY_SCRAPS && age > LEAST_SCRAP_TICKS;
    if ((age > SCRAP_TICKS || tooMany) && !IsHeld(curtain, cloth, piece)) {
        return kiriFrame_DestroyPiece(curtain->world, scrap->frame) >= 0; /* also where it waits */
    }
    return false;
}

/* From the oldest to the newest. */
static void LookAtScraps(Curtain* curtain)
{
    for (int32_t i = 0; i < curtain->scrapCount; i++) {
        if (LookAtScrap(curtain, &curtain->scraps[i])) {
            curtain->scrapCount--;
            memmove(&curtain->scraps[i], &curtain->scraps[i + 1], sizeof(Scrap) * (size_t)(curtain->scrapCount - i));
            i--;
        }
    }
}

static void AddScrap(Curtain* curtain, const kiriEvent* event)
{
    int32_t cloth = FindCloth(curtain, event->sheet);
    if (cloth >= 0 && event->crumb == 0) {
        if (curtain->scrapCount == MAX_SCRAPS) {
            kiriFrame_DestroyPiece(curtain->world, curtain->scraps[0].frame);
            memmove(curtain->scraps, curtain->scraps + 1, sizeof(Scrap) * (size_t)--curtain->scrapCount);
        }
        curtain->scraps[curtain->scrapCount++] = (Scrap){ event->frame, cloth, curtain->tick, 0 };
    }
}

/* A ring or a hand. */
static void BreakPin(Curtain* curtain, kiriPin pin)
{
    for (int32_t i = 0; i < MAX_HANDS; i++) {
        curtain->hands[i].pin = curtain->hands[i].pin == pin ? 0 : curtain->hands[i].pin;
    }
    for (int32_t i = 0; i < MAX_CLOTHS * MAX_RINGS; i++) {
        Ring* ring = &curtain->cloths[i / MAX_RINGS].rings[i % MAX_RINGS];
        if (ring->pin == pin) {
            ring->pin = 0;
            AddNote(curtain, ring->target, "snap");
            Sounds_Play(curtain->host.sounds, SOUND_SNAP, 0.8f);
        }
    }
}

/* ---- Curtains come and go --------------------------------------------------------------------------------------- */

bool Curtain_HasMark(const Curtain* curtain, const Cloth* cloth, int32_t mark)
{
    kiriPointState point;
    int32_t piece;
    return cloth->sheet != 0 && cloth->leftAt == 0 && !cloth->collected[mark] &&
           kiriSheet_GetPoint(curtain->world, cloth->sheet, curtain->level->mark[mark].middle, &point) == KIRI_OK &&
           kiriFrame_GetPiece(curtain->world, point.frame, &piece) == KIRI_OK && IsHeld(curtain, cloth, piece);
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
            DropCloth(curtain, cloth);
            continue;
        }
        hangs = hangs || cloth->leftAt == 0 || curtain->tick - cloth->leftAt < GAME_RATE;
    }
    for (int32_t i = 0; i < MAX_CLOTHS && !hangs; i++) {
        if (curtain->cloths[i].sheet == 0) {
            return AddCloth(curtain, &curtain->cloths[i], 0);
        }
    }
    return true;
}

static void SweepCrumbs(Curtain* curtain)
{
    for (int32_t i = 0; i < MAX_CLOTHS && curtain->tick % CRUMB_TICKS == 0; i++) {
        int32_t count;
        if (curtain->cloths[i].sheet != 0) {
            kiriSheet_DropCrumbs(curtain->world, curtain->cloths[i].sheet, crumbArea, &count);
        }
    }
}

/* ---- The tick --------------------------------------------------------------------------------------------------- */

static void TakeEvents(Curtain* curtain)
{
    const kiriEvent* events;
    int32_t count = 0;
    kiriWorld_GetEvents(curtain->world, &events, &count);
    for (int32_t i = 0; i < count; i++) {
        if (events[i].type == KIRI_EVENT_PIECE_OFF) {
            AddScrap(curtain, &events[i]);
        } else if (events[i].type == KIRI_EVENT_PIN_BROKE) {
            BreakPin(curtain, events[i].pin);
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
    if (result != KIRI_DIVERGED && !Check(curtain, result, "tick")) {
        return false;
    }
    curtain->tick++;
    TakeEvents(curtain);
    LookAtScraps(curtain);
    SweepCrumbs(curtain);
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
                               .levels = 5,
                               .start = Curtain_Start,
                               .stop = Curtain_Stop,
                               .event = Curtain_Event,
                               .tick = Curtain_Tick,
                               .draw = Curtain_Draw,
                               .getStatus = Curtain_GetStatus,
                               .demo = Curtain_Demo };
