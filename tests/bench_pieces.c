/* What it costs to detach, destroy and drop pieces, beside a plain tick of the same sheet. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { TICKS = 5, ROUNDS = 5 };

typedef struct Bed {
    kiriWorld* world;
    kiriSheet sheet;
} Bed;

static bool Bed_Tick(Bed* bed)
{
    return kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2) >= 0;
}

/* A square of strips, `across` times `along` pieces, that hangs still in the air. */
static bool Bed_Start(Bed* bed, int32_t squares, int32_t resolution, int32_t across, int32_t along)
{
    static const float none[3] = { 0.0f, 0.0f, 0.0f };
    kiriWorldDef worldDef = Bench_WorldDef();
    kiriSheetDef def = SheetOf(resolution, 4);
    def.maxFrames = 100000;
    def.rigidArea = 1.0f;
    def.sleepSpeed = 0.0f;
    bool fine = kiriCreateWorld(&worldDef, &bed->world) == KIRI_OK &&
                kiriWorld_SetGravity(bed->world, none) == KIRI_OK &&
                Bench_AddSheet(bed->world, &def, squares, &bed->sheet);
    for (int32_t i = 1; fine && i < across + along; i++) {
        bool isAcross = i < across;
        if (i == across) {
            continue;
        }
        float at = isAcross ? ((float)i + 0.013f) / (float)across : ((float)(i - across) + 0.017f) / (float)along;
        const float way[4] = { isAcross ? at : -0.1f, isAcross ? -0.1f : at, isAcross ? at : 1.1f,
                               isAcross ? 1.1f : at };
        kiriCut cut;
        fine = kiriBeginCut(bed->world, bed->sheet, way, &cut) == KIRI_OK &&
               kiriCut_Extend(bed->world, cut, way + 2, 1) == KIRI_OK && kiriCut_End(bed->world, cut) == KIRI_OK;
    }
    for (int32_t i = 0; fine && i < 2 * TICKS; i++) {
        fine = Bed_Tick(bed);
    }
    return fine;
}

static bool TimeTick(Bed* bed, Series* times)
{
    double start = Bench_Clock(NULL);
    bool fine = Bed_Tick(bed);
    Series_Add(times, 1e3 * (Bench_Clock(NULL) - start));
    return fine;
}

static kiriFrame FrameOf(const Bed* bed, int32_t piece)
{
    const kiriFrame* frames;
    int32_t count;
    return kiriSheet_GetPieceFrames(bed->world, bed->sheet, piece, &frames, &count) == KIRI_OK ? frames[0] : 0;
}

/* The piece in the middle of the list, time and again. */
static bool TimeParting(Bed* bed, bool detach, Series* times)
{
    kiriCounts counts;
    kiriSheet made = 0;
    bool fine = Bed_Tick(bed) && kiriSheet_GetCounts(bed->world, bed->sheet, &counts) == KIRI_OK;
    kiriFrame frame = fine ? FrameOf(bed, counts.pieces / 2) : 0;
    double start = Bench_Clock(NULL);
    fine = fine && (detach ? kiriFrame_DetachPiece(bed->world, frame, &made)
                           : kiriFrame_DestroyPiece(bed->world, frame)) == KIRI_OK;
    Series_Add(times, 1e3 * (Bench_Clock(NULL) - start));
    return fine && (!detach || kiriDestroySheet(bed->world, made) == KIRI_OK);
}

/* All but the largest, at last. */
static bool TimeDropping(Bed* bed, double* time, int32_t* dropped)
{
    double start = Bench_Clock(NULL);
    bool fine = Bed_Tick(bed);
    start = Bench_Clock(NULL);
    fine = fine && kiriSheet_DropCrumbs(bed->world, bed->sheet, 10.0f, dropped) == KIRI_OK;
    *time = 1e3 * (Bench_Clock(NULL) - start);
    return fine;
}

typedef struct Case {
    const char* name;
    int32_t squares, resolution, across, along;
} Case;

static bool Measure(Table* table, const Case* c)
{
    Bed bed = { NULL, 0 };
    Series tick = { .number = NULL }, detach = { .number = NULL }, destroy = { .number = NULL };
    double drop = 0.0;
    int32_t dropped = 0;
    bool fine = Bed_Start(&bed, c->squares, c->resolution, c->across, c->along);
    for (int32_t i = 0; fine && i < ROUNDS; i++) {
        fine = TimeTick(&bed, &tick) && TimeParting(&bed, true, &detach) && TimeParting(&bed, false, &destroy);
    }
    fine = fine && TimeDropping(&bed, &drop, &dropped);
    double plain = Series_Median(&tick);
    Table_Text(table, c->name);
    TABLE_NUMBERS(table, plain, Series_Median(&detach), Series_Median(&detach) / plain, Series_Median(&destroy),
                  Series_Median(&destroy) / plain, dropped, drop, drop / plain);
    Series_Free(&tick);
    Series_Free(&detach);
    Series_Free(&destroy);
    kiriDestroyWorld(bed.world);
    return fine;
}

int main(void)
{
    static const char* const columns[] = { "sheet",     "tick ms", "detach ms", "of a tick", "destroy ms",
                                           "of a tick", "dropped", "drop ms",   "of a tick", NULL };
    static const Case cases[] = {
        { "65 x 65, 12", 64, 32, 4, 3 },        { "65 x 65, 500", 64, 64, 25, 20 },
        { "257 x 257, 12", 256, 64, 4, 3 },     { "257 x 257, 500", 256, 64, 25, 20 },
        { "1001 x 1001, 12", 1000, 128, 4, 3 },
    };
    Table table;
    Bench_WeighClock();
    bool fine =
        Table_Start(&table, "pieces",
                    "pieces: one of so many is detached, or destroyed; then all are dropped but the largest", columns);
    for (size_t i = 0; fine && i < sizeof cases / sizeof cases[0]; i++) {
        fine = Measure(&table, &cases[i]);
    }
    return Table_Stop(&table) && fine ? 0 : 1;
}
