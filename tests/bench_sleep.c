/* What pieces that sleep cost while others of their sheet move. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { SETTLING = 400, TICKS = 100 };

typedef struct Case {
    const char* name;
    int32_t squares, resolution, dice; /* cut into dice x dice pieces */
    bool onFloor, normals;
} Case;

typedef struct Bed {
    kiriWorld* world;
    kiriSheet sheet;
    kiriFrame mover;
} Bed;

static bool Bed_Dice(Bed* bed, int32_t dice)
{
    bool fine = true;
    for (int32_t i = 1; fine && i < 2 * dice; i++) {
        float at = ((float)(i < dice ? i : i - dice) + 0.013f) / (float)dice;
        const float way[4] = { i < dice ? at : -0.1f, i < dice ? -0.1f : at, i < dice ? at : 1.1f,
                               i < dice ? 1.1f : at };
        kiriCut cut;
        fine = i == dice || kiriSheet_Cut(bed->world, bed->sheet, way, 2, &cut) == KIRI_OK;
    }
    return fine;
}

static bool Bed_Start(Bed* bed, const Case* c, float sleepSpeed, int32_t dice)
{
    static const float none[3] = { 0.0f, 0.0f, 0.0f }, middle[2] = { 0.5f, 0.5f };
    kiriWorldDef worldDef = Bench_WorldDef();
    kiriObstacle floor;
    kiriPointState at;
    kiriSheetDef def = DefaultSheet();
    kiriObstacleDef floorDef = ObstacleOf(KIRI_OBSTACLE_PLANE);
    def.gridResolution = c->resolution;
    def.frameCount = 1;
    def.maxFrames = 100000;
    def.rigidArea = 1.0f;
    def.sleepSpeed = sleepSpeed;
    def.position[2] = 0.001f;
    def.normals = c->normals;
    bool fine = kiriCreateWorld(&worldDef, &bed->world) == KIRI_OK &&
                (c->onFloor ? kiriCreateObstacle(bed->world, &floorDef, &floor)
                            : kiriWorld_SetGravity(bed->world, none)) == KIRI_OK &&
                Bench_AddSheet(bed->world, &def, c->squares, &bed->sheet) && Bed_Dice(bed, dice) &&
                kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2) == KIRI_OK &&
                kiriSheet_GetPoint(bed->world, bed->sheet, middle, &at) == KIRI_OK;
    bed->mover = at.frame;
    return fine;
}

/* One piece is pushed to and fro. */
static bool Bed_Tick(Bed* bed, int32_t k)
{
    static const float none[3] = { 0.0f, 0.0f, 0.0f };
    const float velocity[3] = { k % 2 == 0 ? 0.02f : -0.02f, 0.0f, 0.0f };
    return kiriFrame_SetPieceVelocity(bed->world, bed->mover, velocity, none) == KIRI_OK &&
           kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2) == KIRI_OK;
}

/* ms of a tick; *pieces and how many of them are asleep. */
static double TimeTicks(const Case* c, float sleepSpeed, int32_t dice, int32_t* pieces, int32_t* asleep)
{
    Bed bed = { NULL, 0, 0 };
    Series times = { .number = NULL };
    kiriCounts counts = { .pieces = 0 };
    bool fine = Bed_Start(&bed, c, sleepSpeed, dice);
    for (int32_t k = 0; fine && k < (sleepSpeed > 0.0f ? SETTLING : 10); k++) {
        fine = Bed_Tick(&bed, k);
    }
    for (int32_t k = 0; fine && k < (sleepSpeed > 0.0f ? TICKS : TICKS / 10); k++) {
        double start = Bench_Clock(NULL);
        fine = Bed_Tick(&bed, k);
        Series_Add(&times, 1e3 * (Bench_Clock(NULL) - start));
    }
    fine = fine && kiriSheet_GetCounts(bed.world, bed.sheet, &counts) == KIRI_OK;
    *pieces = counts.pieces;
    *asleep = 0;
    for (int32_t p = 0; fine && p < counts.pieces; p++) {
        kiriPieceState state;
        fine = kiriSheet_GetPiece(bed.world, bed.sheet, p, &state) == KIRI_OK;
        *asleep += fine && state.asleep;
    }
    double median = Series_Median(&times);
    Series_Free(&times);
    kiriDestroyWorld(bed.world);
    return fine ? median : (double)NAN;
}

static bool Measure(Table* table, const Case* c)
{
    static const float speed = 0.001f;
    int32_t pieces, asleep, few, none;
    double all = TimeTicks(c, 0.0f, c->dice, &pieces, &none);
    double rest = TimeTicks(c, speed, c->dice, &pieces, &asleep);
    Case alone = *c;
    alone.squares = c->squares / c->dice > 1 ? c->squares / c->dice : 2;
    alone.resolution = 4;
    double one = TimeTicks(&alone, speed, 1, &few, &none), each = 1e3 * (rest - one) / asleep;
    Table_Text(table, c->name);
    TABLE_NUMBERS(table, pieces, asleep, all, rest, one, 1e3 * (all - one) / pieces);
    Table_Judge(table, each, each < 0.05);
    return !isnan(all) && !isnan(rest) && !isnan(one);
}

int main(void)
{
    static const char* const columns[] = { "sheet",          "pieces",          "asleep",
                                           "all awake, ms",  "one moves, ms",   "a piece alone, ms",
                                           "awake, us each", "asleep, us each", NULL };
    static const Case cases[] = {
        { "257 x 257, in the air", 256, 128, 40, false, false },
        { "81 x 81, in the air", 80, 80, 40, false, false },
        { "257 x 257, in the air, normals", 256, 128, 40, false, true },
        { "257 x 257, on a floor", 256, 128, 40, true, false },
    };
    Table table;
    Bench_WeighClock();
    bool fine =
        Table_Start(&table, "sleep",
                    "sleep: a square in 40 x 40 pieces, of which all rest but one: ms of a tick with all awake, "
                    "with one awake, and of that one alone.\nAim: 0.05 us for each that sleeps.",
                    columns);
    for (size_t i = 0; fine && i < sizeof cases / sizeof cases[0]; i++) {
        fine = Measure(&table, &cases[i]);
    }
    return Table_Stop(&table) && fine ? 0 : 1;
}
