/* The cost of detaching and destroying pieces, beside a plain tick of the same sheet. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { TICKS = 5, ROUNDS = 5 };

typedef struct Bed {
    kiriWorld* world;
    kiriSheet sheet;
} Bed;

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
    for (int32_t i = 1; fine && i < across + along; i += i == across - 1 ? 2 : 1) {
        bool isAcross = i < across;
        float at = isAcross ? ((float)i + 0.013f) / (float)across : ((float)(i - across) + 0.017f) / (float)along;
        const float way[4] = { isAcross ? at : -0.1f, isAcross ? -0.1f : at, isAcross ? at : 1.1f,
                               isAcross ? 1.1f : at };
        kiriCut cut;
        fine = kiriSheet_Cut(bed->world, bed->sheet, way, 2, &cut) == KIRI_OK;
    }
    for (int32_t i = 0; fine && i < 2 * TICKS; i++) {
        fine = kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2) >= 0;
    }
    return fine;
}

enum Act { TICK, DETACH, DESTROY, ACTS };

/* A tick, then an act on the piece in the middle of the list. Adds its time, ms. */
static bool TimeAct(Bed* bed, enum Act act, Series* times)
{
    const kiriFrame* frames;
    kiriCounts counts;
    kiriSheet made = 0;
    int32_t count;
    bool fine = kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2) >= 0 &&
                kiriSheet_GetCounts(bed->world, bed->sheet, &counts) == KIRI_OK &&
                kiriSheet_GetPieceFrames(bed->world, bed->sheet, counts.pieces / 2, &frames, &count) == KIRI_OK;
    kiriFrame frame = fine ? frames[0] : 0;
    double start = Bench_Clock(NULL);
    fine = fine && (act == TICK     ? kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2)
                    : act == DETACH ? kiriFrame_DetachPiece(bed->world, frame, &made)
                                    : kiriFrame_DestroyPiece(bed->world, frame)) >= 0;
    Series_Add(times, 1e3 * (Bench_Clock(NULL) - start));
    return fine && (act != DETACH || kiriDestroySheet(bed->world, made) == KIRI_OK);
}

int main(void)
{
    static const char* const columns[] = { "squares",   "pieces",     "tick ms",   "detach ms",
                                           "of a tick", "destroy ms", "of a tick", NULL };
    static const int32_t cases[][4] = { { 64, 32, 4, 3 }, { 64, 64, 25, 20 }, { 256, 64, 4, 3 }, { 256, 64, 25, 20 },
                                        { 1000, 128, 4, 3 } };
    Table table;
    Bench_WeighClock();
    bool fine = Table_Start(&table, "pieces", "pieces: one of so many is detached, or destroyed", columns);
    for (size_t i = 0; fine && i < sizeof cases / sizeof cases[0]; i++) {
        Bed bed = { NULL, 0 };
        Series times[ACTS] = { { .number = NULL } };
        const int32_t* c = cases[i];
        fine = Bed_Start(&bed, c[0], c[1], c[2], c[3]);
        for (int32_t n = 0; fine && n < ACTS * ROUNDS; n++) {
            fine = TimeAct(&bed, n % ACTS, &times[n % ACTS]);
        }
        double plain = Series_Median(&times[TICK]), detach = Series_Median(&times[DETACH]),
               destroy = Series_Median(&times[DESTROY]);
        TABLE_NUMBERS(&table, c[0], c[2] * c[3], plain, detach, detach / plain, destroy, destroy / plain);
        for (int k = 0; k < ACTS; k++) {
            Series_Free(&times[k]);
        }
        kiriDestroyWorld(bed.world);
    }
    return Table_Stop(&table) && fine ? 0 : 1;
}
