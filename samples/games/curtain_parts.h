/* What the files of the game Curtain share. World: x to the right, y away from the player, z up; metres. */
#ifndef CURTAIN_PARTS_H
#define CURTAIN_PARTS_H

#include "game.h"
#include "track.h"
#include "undo.h"

enum {
    MAX_MARKS = 6,
    MAX_CLOTHS = 4,
    MAX_RINGS = 16,
    MAX_HANDS = 4,
    MAX_POINTERS = 11,
    MAX_SCRAPS = 32,
    MAX_NOTES = 6,
    MARK_CORNERS = 40,
    TRAIL = 14,
    TEXTURE_SIZE = 512,
    BASKET_PARTS = 5
};

/* ---- Levels: curtain_level.c ------------------------------------------------------------------------------------ */

enum MarkShape { MARK_CIRCLE, MARK_HEART, MARK_STAR, MARK_DROP };

/* A shape on the curtain that is to be cut out. */
typedef struct Mark {
    int32_t shape;
    float middle[2], radius; /* in the rest plane, m */
} Mark;

typedef struct Level {
    const char* name;
    const char* hint;
    int32_t curtains;    /* that hang one behind the other */
    float width, height; /* of a curtain */
    float gather;        /* share of its width that its rings take on the rail */
    int32_t rings;
    float breakForce;  /* N, of a ring; 0: they hold */
    float wind, gusts; /* m/s across: of what changes slowly, and of gusts */
    int32_t marks;     /* how many on each curtain */
    Mark mark[MAX_MARKS];
    int32_t wanted;  /* marks in the basket, to win; 0: the game has no end */
    int32_t seconds; /* 0: there is time */
} Level;

extern const Level levels[];
int32_t Level_GetCount(void);

/* Corners in the rest plane, counter-clockwise from the top, and the area (m^2). */
float Mark_GetOutline(const Mark* mark, float corners[2 * MARK_CORNERS]);

/* What the curtain looks like, marks included; rgb has TEXTURE_SIZE^2 pixels. */
void Level_Paint(const Level* level, int32_t curtain, uint8_t* rgb);

/* ---- The game: curtain.c ---------------------------------------------------------------------------------------- */

typedef struct Ring {
    kiriPin pin; /* 0: broken */
    float start[3], target[3];
} Ring;

/* A curtain, with all that is cut from it. */
typedef struct Cloth {
    kiriSheet sheet;
    Track track;
    Ring rings[MAX_RINGS];
    int32_t ringCount;
    bool collected[MAX_MARKS];
    uint8_t* rgb;
    CanvasTexture texture;
    int32_t madeAt;
    int32_t leftAt; /* the tick in which its last ring was let go; 0: it hangs */
} Cloth;

/* A part that came off. */
typedef struct Scrap {
    kiriFrame frame; /* names it */
    int32_t cloth, offAt;
    int32_t inBasketSince; /* tick; 0: it is not in it */
} Scrap;

/* A pin that goes with a pointer, or stays where it was put. */
typedef struct Hand {
    kiriPin pin; /* 0: none */
    int32_t cloth;
    int32_t pointer; /* that moves it; -1: it stays */
    float away;      /* m, along the ray of the pointer */
    float target[3];
} Hand;

typedef struct Pointer {
    kiriBlade blade; /* 0: it does not cut */
    float trail[2 * TRAIL];
    int32_t trailCount, x, y;
} Pointer;

/* A line of text that rises where something happened. */
typedef struct Note {
    char text[24];
    float place[3];
    int32_t since; /* tick; 0: none */
} Note;

typedef struct Curtain {
    GameHost host;
    const Level* level;
    kiriWorld* world;
    Cloth cloths[MAX_CLOTHS];
    int32_t clothsMade;
    kiriObstacle basket[BASKET_PARTS];
    float basketX, basketBefore, basketSpeed;
    Hand hands[MAX_HANDS];
    Pointer pointers[MAX_POINTERS];
    Scrap scraps[MAX_SCRAPS];
    int32_t scrapCount;
    Note notes[MAX_NOTES];
    int32_t noteCount;
    float wind[3]; /* m/s */
    int32_t tick;
    int32_t state, score, collected;
    int32_t landed; /* contacts of the basket in the last tick, to hear when something lands */
    Undo undo;
    struct Demo {
        int32_t jobs; /* begun so far */
        int32_t job, cloth, mark, step, wait;
        int32_t x, y; /* where it began */
    } demo;
} Curtain;

/* ---- Making what there is: curtain_build.c ---------------------------------------------------------------------- */

void* Curtain_Start(int32_t number, const GameHost* host);
void Curtain_Stop(void* game);

/* Hangs a curtain on its rings, behind the others by its layer. False: the library refused, and stderr says why. */
bool Curtain_AddCloth(Curtain* curtain, Cloth* cloth, int32_t layer);
void Curtain_DropCloth(Curtain* curtain, Cloth* cloth);

/* The index of the cloth that this sheet is; -1: none. */
int32_t Curtain_FindCloth(const Curtain* curtain, kiriSheet sheet);

/* Writes a line where the call failed. */
bool Curtain_Check(const Curtain* curtain, kiriResult result, const char* what);

/* ---- Hands and blades: curtain_hand.c --------------------------------------------------------------------------- */

void Curtain_Event(void* game, const GameEvent* event);

/* ---- Scraps: curtain_scrap.c ------------------------------------------------------------------------------------ */

enum { SCRAP_TICKS = 20 * GAME_RATE }; /* after that a scrap is swept away */
extern const float crumbArea;          /* m^2: smaller parts are no scraps */

void Curtain_AddScrap(Curtain* curtain, const kiriEvent* event);
void Curtain_LookAtScraps(Curtain* curtain);
void Curtain_SweepCrumbs(Curtain* curtain);

/* Whether a ring or a hand holds the piece. */
bool Curtain_IsHeld(const Curtain* curtain, const Cloth* cloth, int32_t piece);

/* A ring's or a hand's. */
void Curtain_BreakPin(Curtain* curtain, kiriPin pin);

/* ---- Going back: curtain_undo.c --------------------------------------------------------------------------------- */

/* A cut may begin: keeps the game as it is, as undo.h says. */
void Curtain_Keep(Curtain* curtain);

/* To before the last cut that is kept. False: there is none. */
bool Curtain_Undo(Curtain* curtain);

/* ---- The stage -------------------------------------------------------------------------------------------------- */

extern const CanvasCamera curtainCamera;
extern const float curtainRail;                 /* m: how high it is */
extern const float basketSize[3];               /* m, outside */
extern const float basketY;                     /* m: below the curtain; a light piece glides to either side of it */
extern const float ballRadius, ballPlace[3];    /* m */
extern const float tableSize[3], tablePlace[3]; /* m: a box, and its middle */

/* The place of a part of the basket: bottom and four walls. */
void Basket_GetPart(const Curtain* curtain, int32_t part, float x, float size[3], float position[3]);

/* Whether nobody has cut the mark out of a curtain that hangs. */
bool Curtain_HasMark(const Curtain* curtain, const Cloth* cloth, int32_t mark);

void Curtain_Draw(void* game, Canvas* canvas, float alpha);            /* curtain_draw.c */
int32_t Curtain_Demo(void* game, GameEvent* events, int32_t capacity); /* curtain_demo.c */

#endif
