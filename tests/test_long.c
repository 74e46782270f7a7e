/* Long play: a blade that never rests, pieces that are detached or dropped as crumbs, cuts that are taken back; and
   sheets that come and go, or one that stays. Work and memory must not grow with the time that a world has run. In
   `make test` a tenth of ten minutes; with an argument (`make long`) all of it. */
#include "host.h"

#include <time.h>

enum { PERIODS = 10, PERIOD = 360, LONG_PERIOD = 3600, LIFE = 60, MOST_PARTS = 64, SQUARES = 16 };

static int32_t period = PERIOD;

/* Bytes that are out. */
static int64_t bytesLive;

static void* CountingAlloc(void* user, int64_t bytes)
{
    int64_t* block = malloc(16 + (size_t)bytes);
    assert_non_null(block);
    block[0] = bytes;
    bytesLive += bytes;
    return block + 2;
}

static void CountingFree(void* user, void* pointer)
{
    if (pointer != NULL) {
        int64_t* block = (int64_t*)pointer - 2;
        bytesLive -= block[0];
        free(block);
    }
}

/* What a period took. */
typedef struct Period {
    int64_t items, worst, bytes; /* of all ticks, of one, and the most at a time */
    int32_t pieces, sheets;      /* that came off; that were made */
    int32_t undone;              /* cuts that were taken back */
    double seconds;              /* of the processor, in ticks */
} Period;

/* Bytes of a save. */
typedef struct Saved {
    void* bytes;
    int64_t size, capacity;
} Saved;

/* What falls, and goes after a while. */
typedef struct Parts {
    kiriSheet sheets[MOST_PARTS];
    int32_t ends[MOST_PARTS], count;
} Parts;

typedef struct Play {
    kiriWorld* world;
    kiriSheet sheet;
    Parts parts, partsBefore;
    Saved base, before; /* of the sheet when it was new; that from before the cut at hand */
    bool staysOne;      /* the sheet goes back to when it was new, and no other comes */
    int32_t tick, left;
    kiriCut cut;
    float at[2], way[2];
    uint32_t seed;
    Period now;
} Play;

static void Saved_Reserve(Saved* saved, int64_t size)
{
    if (size > saved->capacity) {
        saved->bytes = realloc(saved->bytes, (size_t)(2 * size));
        assert_non_null(saved->bytes);
        saved->capacity = 2 * size;
    }
}

static void SaveBase(Play* play)
{
    OK(kiriWorld_Save(play->world, NULL, 0, &play->base.size));
    Saved_Reserve(&play->base, play->base.size);
    OK(kiriWorld_Save(play->world, play->base.bytes, play->base.capacity, &play->base.size));
}

static void SaveBefore(Play* play)
{
    Saved* before = &play->before;
    OK(kiriWorld_Save(play->world, NULL, 0, &before->size));
    Saved_Reserve(before, before->size);
    OK(kiriWorld_Save(play->world, before->bytes, before->capacity, &before->size));
    play->partsBefore = play->parts;
}

/* The world is again what it was before the last cut. */
static void TakeBack(Play* play)
{
    OK(kiriWorld_Load(play->world, play->before.bytes, play->before.size));
    play->parts = play->partsBefore;
    play->now.undone += 1;
}

static void AddSheet(Play* play)
{
    kiriPin id;
    kiriSheetDef def = DefaultSheet();
    kiriPinDef pin = DefaultPin();
    def.gridResolution = 24;
    def.frameCount = 6;
    def.maxFrames = 40;
    def.crumbArea = 0.002f;
    def.collisionPoints = 20;
    Rectangle r = Rectangle_Make(&def, 1.0f, 1.0f, SQUARES, SQUARES);
    OK(kiriCreateSheet(play->world, &def, &play->sheet));
    Rectangle_Free(&r);
    for (int i = 0; i < 2; ++i) {
        pin.restPoint[0] = pin.target[0] = (float)i;
        pin.restPoint[1] = pin.target[1] = 1.0f;
        OK(kiriCreatePin(play->world, play->sheet, &pin, &id));
    }
    play->left = 0;
    play->now.sheets += 1;
    SaveBase(play);
}

/* A sheet of which too little is left goes, and another one comes; or it is new again. */
static void RenewSheet(Play* play)
{
    kiriTotals totals = World_Totals(play->world, play->sheet);
    if (totals.area < 0.4 && play->staysOne) {
        OK(kiriWorld_Load(play->world, play->base.bytes, play->base.size));
        play->parts.count = play->left = 0;
    } else if (totals.area < 0.4) {
        OK(kiriDestroySheet(play->world, play->sheet));
        AddSheet(play);
    }
}

static void MoveBlade(Play* play)
{
    if (play->left == 0) {
        for (int i = 0; i < 2; ++i) {
            play->at[i] = (float)RandomBetween(&play->seed, -0.1, 1.1);
            play->way[i] = (float)RandomBetween(&play->seed, -0.05, 0.05);
        }
        SaveBefore(play);
        OK(kiriBeginCut(play->world, play->sheet, play->at, &play->cut));
        play->left = 20 + (int32_t)(Random(&play->seed) % 60);
    }
    for (int i = 0; i < 2; ++i) {
        play->way[i] += (float)RandomBetween(&play->seed, -0.012, 0.012);
        play->at[i] += play->way[i];
    }
    OK(kiriCut_Extend(play->world, play->cut, play->at, 1));
    play->left -= 1;
    if (play->left == 0) {
        OK(kiriCut_End(play->world, play->cut));
        if (Random(&play->seed) % 3 == 0) {
            TakeBack(play);
        }
    }
}

/* The smaller pieces of the sheet, and what falls too long. */
static void PartPieces(Play* play)
{
    int32_t count;
    kiriPieceState state;
    assert_true(kiriSheet_DropCrumbs(play->world, play->sheet, 0.002f, &count) >= 0);
    play->now.pieces += count;
    kiriCounts counts = World_Counts(play->world, play->sheet);
    Parts* parts = &play->parts;
    for (int32_t p = counts.pieces - 1; p > 0 && parts->count < MOST_PARTS; --p) {
        const kiriFrame* frames;
        kiriSheet made;
        OK(kiriSheet_GetPiece(play->world, play->sheet, p, &state));
        OK(kiriSheet_GetPieceFrames(play->world, play->sheet, p, &frames, &count));
        if (count > 0 && state.area < 0.3 && kiriFrame_DetachPiece(play->world, frames[0], &made) == KIRI_OK) {
            parts->ends[parts->count] = play->tick + LIFE;
            parts->sheets[parts->count++] = made;
            play->now.pieces += 1;
        }
    }
    int32_t kept = 0;
    for (int32_t k = 0; k < parts->count; ++k) {
        if (parts->ends[k] <= play->tick) {
            OK(kiriDestroySheet(play->world, parts->sheets[k]));
        } else {
            parts->ends[kept] = parts->ends[k];
            parts->sheets[kept++] = parts->sheets[k];
        }
    }
    parts->count = kept;
}

static void Count(Play* play)
{
    kiriProfile profile = World_Profile(play->world);
    int64_t items = (int64_t)profile.trianglesSplit + profile.cellsSettled + profile.samplesRefreshed;
    play->now.items += items;
    play->now.worst = items > play->now.worst ? items : play->now.worst;
    play->now.bytes = bytesLive > play->now.bytes ? bytesLive : play->now.bytes;
}

static Period RunPeriod(Play* play)
{
    memset(&play->now, 0, sizeof(play->now));
    for (int32_t i = 0; i < period; ++i, ++play->tick) {
        RenewSheet(play);
        MoveBlade(play);
        clock_t start = clock();
        kiriResult result = kiriWorld_Tick(play->world, 1.0f / 60.0f, 1);
        play->now.seconds += (double)(clock() - start) / CLOCKS_PER_SEC;
        assert_true(result == KIRI_OK || result == KIRI_DIVERGED);
        Count(play);
        PartPieces(play);
        if (play->tick % 97 == 0) {
            const char* wrong = Validate_World(play->world);
            if (wrong != NULL) {
                fail_msg("tick %d: %s", (int)play->tick, wrong);
            }
        }
    }
    return play->now;
}

static void Print(int k, const Period* p)
{
    print_message("period %d: %lld items a tick, %lld at worst, %.2f ms, %lld KB, %d pieces, %d sheets, %d cuts taken "
                  "back\n",
                  k, (long long)(p->items / period), (long long)p->worst, 1e3 * p->seconds / period,
                  (long long)(p->bytes / 1024), (int)p->pieces, (int)p->sheets, (int)p->undone);
}

static void PlayLong(bool staysOne)
{
    Play play;
    Period periods[PERIODS];
    int32_t pieces = 0, undone = 0, sheets = 0;
    kiriWorldDef def = DefaultWorld();
    def.alloc = CountingAlloc;
    def.free = CountingFree;
    memset(&play, 0, sizeof(play));
    play.staysOne = staysOne;
    play.seed = 2463534242u;
    OK(kiriCreateWorld(&def, &play.world));
    AddSheet(&play);
    for (int k = 0; k < PERIODS; ++k) {
        periods[k] = RunPeriod(&play);
        pieces += periods[k].pieces;
        undone += periods[k].undone;
        sheets += periods[k].sheets;
        Print(k, &periods[k]);
    }
    const Period *second = &periods[1], *last = &periods[PERIODS - 1];
    print_message("the last period against the second: items %.2f, worst %.2f, memory %.2f, time %.2f\n",
                  (double)last->items / (double)second->items, (double)last->worst / (double)second->worst,
                  (double)last->bytes / (double)second->bytes, last->seconds / second->seconds);
    assert_true(pieces > 2 * PERIODS && undone > PERIODS && (sheets == 0) == staysOne);
    assert_true(last->items < 2 * second->items && last->worst < 3 * second->worst && last->bytes < 2 * second->bytes);
    kiriDestroyWorld(play.world);
    assert_int_equal(bytesLive, 0);
    free(play.base.bytes);
    free(play.before.bytes);
}

TEST(SheetsThatGo)
{
    PlayLong(false);
}

TEST(SheetThatStays)
{
    PlayLong(true);
}

SETUP
{
    period = count > 1 ? LONG_PERIOD : PERIOD;
}
