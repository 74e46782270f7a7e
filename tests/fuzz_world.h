/* One or two worlds that get the same calls, made of bytes; and what must hold after each call. */
#ifndef KIRI_TEST_FUZZ_WORLD_H
#define KIRI_TEST_FUZZ_WORLD_H

#include "fuzz.h"

#include "look.h"

/* What the second world does in another way, with the same outcome. */
typedef enum FuzzTwin {
    FUZZ_ALONE,   /* there is none */
    FUZZ_SCRATCH, /* every cut rebuilds all from scratch */
    FUZZ_TASKS,   /* ticks are shared out, in another order */
    FUZZ_REFUSED, /* calls are refused memory, and made again */
    FUZZ_TWINS
} FuzzTwin;

enum { FUZZ_POINTS = 12, FUZZ_IDS = 24, FUZZ_SQUARES = 8, FUZZ_FOLDS = 4 };

/* Ids of a kind that were seen, stale ones too. */
typedef struct FuzzIds {
    uint32_t ids[FUZZ_IDS];
    int32_t count, next;
} FuzzIds;

/* Arguments of any call, and what it says. */
typedef struct FuzzAct {
    kiriSheet sheet;
    kiriFrame frame;
    kiriPin pin;
    kiriCut cut;
    kiriObstacle obstacle;
    kiriBlade blade;
    kiriSeam seam;
    uint32_t nulls; /* bits: pointers that are null */
    float vectors[4][3], rests[3][2], rotation[9], scalar;
    int32_t numbers[3], vectorCount, restCount, numberCount;
    float points[2 * FUZZ_POINTS];
    int32_t pointCount;
    kiriFrame frames[4];
    int32_t frameCount;
    union {
        kiriBudget budget;
        kiriWind wind;
        kiriTearing tearing;
        kiriPinDef pin;
        kiriObstacleDef obstacle;
        kiriSheetDef sheet;
        kiriSheetSettings settings;
        kiriContact contacts[FUZZ_POINTS];
        kiriSeamDef seam;
    } def;
    kiriFold folds[FUZZ_FOLDS];
    int32_t foldCount;
    float lines[2][2 * FUZZ_POINTS];
    float outline[2 * FUZZ_POINTS];
    float positions[2 * (FUZZ_SQUARES + 1) * (FUZZ_SQUARES + 1) + 4 * (FUZZ_SQUARES + 1)];
    int32_t indices[6 * FUZZ_SQUARES * FUZZ_SQUARES];
    float framePoints[2 * FUZZ_POINTS];

    struct {
        uint32_t id; /* of what it made, or 0 */
        uint32_t ids[4];
        int32_t count;
        uint64_t hash;
    } said;
} FuzzAct;

typedef struct Fuzz {
    FuzzBytes bytes;
    FuzzTwin twin;
    Host hosts[2];
    int32_t hostCount, sheetsMade, ticks;
    float scale; /* m: of the sheets */
    FuzzIds sheets, frames, pins, cuts, obstacles, blades, seams;
    double area, mass, slack;  /* of all sheets together; the latter by itself */
    double energy, energySize; /* J: the most that there can be; and of what size its parts were */
    bool isStirred;            /* something gave energy that nobody counts */
    bool mayShrink;            /* a piece that was destroyed waits to go */
    bool isOver;               /* it gets too large to go on */
} Fuzz;

typedef kiriResult FuzzCallFn(kiriWorld* world, FuzzAct* act);

enum FuzzCallFlags {
    FUZZ_READS = 1,
    FUZZ_TICKS = 2,
    FUZZ_MAKES_SHEET = 4,
    FUZZ_DESTROYS = 8, /* material */
    FUZZ_ADDS = 16,    /* things that cost in each tick */
    FUZZ_SEVERAL = 32, /* calls in one: not refused memory */
    FUZZ_STIRS = 64    /* later ticks may add energy */
};

/* `needs` lists the arguments, see FuzzAct_Read. */
typedef struct FuzzCall {
    const char* name;
    FuzzCallFn* call;
    const char* needs;
    int flags;
    FuzzIds* (*makes)(Fuzz* fuzz); /* where the id of what it makes belongs, or null */
} FuzzCall;

extern const FuzzCall fuzzCalls[];
extern const int32_t fuzzCallCount;

/* s f p c o b m: ids, m of a seam. v: a place in the world, V: a vector. r: a rest point. R: a rotation. x: a number. n: a small whole
   one. P: rest points, F: frames, L: folds. B W A I O S T C E: budget, wind, tearing, pin,
   obstacle, sheet, settings, contacts, seam. */
void FuzzAct_Read(FuzzAct* act, Fuzz* fuzz, const char* needs);

void FuzzIds_Add(FuzzIds* ids, uint32_t id);

/* Makes the call in all worlds. */
void Fuzz_Make(Fuzz* fuzz, const FuzzCall* call, FuzzAct* act);

void Fuzz_Start(Fuzz* fuzz, const uint8_t* data, size_t size);

/* The world goes on working, whatever has happened. */
void Fuzz_Stop(Fuzz* fuzz);

/* The triangles of all sheets. */
int32_t Fuzz_CountTriangles(const Fuzz* fuzz);

#endif
