/* What a budget means for the delay: ticks from a cut until its lips part, which no clock decides. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { MOST_TICKS = 5000, SLASH_POINTS = 20 };

typedef struct Delay {
    int32_t ticks;
    double cells, samples; /* items, in all */
} Delay;

static bool CutShort(kiriWorld* world, kiriSheet sheet)
{
    static const float from[2] = { -0.1f, 0.47f }, to[2] = { 0.35f, 0.49f };
    kiriCut cut;
    return kiriBeginCut(world, sheet, from, &cut) == KIRI_OK && kiriCut_Extend(world, cut, to, 1) == KIRI_OK &&
           kiriCut_End(world, cut) == KIRI_OK;
}

/* From side to side. */
static bool Slash(kiriWorld* world, kiriSheet sheet)
{
    float points[2 * SLASH_POINTS];
    for (int i = 0; i < SLASH_POINTS; i++) {
        points[2 * i] = -0.1f + 1.2f * (float)i / (SLASH_POINTS - 1);
        points[2 * i + 1] = 0.47f + 0.06f * (float)i / (SLASH_POINTS - 1);
    }
    kiriCut cut;
    return kiriBeginCut(world, sheet, points, &cut) == KIRI_OK &&
           kiriCut_Extend(world, cut, points + 2, SLASH_POINTS - 1) == KIRI_OK && kiriCut_End(world, cut) == KIRI_OK;
}

/* Until the commit. */
static bool Wait(kiriWorld* world, Delay* delay)
{
    kiriProfile profile = { .commits = 0 };
    bool fine = true;
    while (fine && profile.commits == 0 && delay->ticks < MOST_TICKS) {
        fine = kiriWorld_Tick(world, 1.0f / 60.0f, 1) >= 0 && kiriWorld_GetProfile(world, &profile) == KIRI_OK;
        delay->ticks += 1;
        delay->cells += profile.cellsSettled;
        delay->samples += profile.samplesRefreshed;
    }
    return fine && profile.commits > 0;
}

static bool Measure(Delay* delay, const kiriBudget* budget, int32_t squares, int32_t frames, bool isShort)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    kiriWorld* world;
    kiriSheet sheet;
    worldDef.budget = *budget;
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = squares;
    def.frameCount = frames;
    def.maxFrames = frames + 4;
    *delay = (Delay){ 0, 0.0, 0.0 };
    if (kiriCreateWorld(&worldDef, &world) != KIRI_OK) {
        return false;
    }
    bool fine = Bench_AddSheet(world, &def, squares, &sheet) &&
                (isShort ? CutShort(world, sheet) : Slash(world, sheet)) && Wait(world, delay);
    kiriDestroyWorld(world);
    return fine;
}

static bool PrintRow(Table* table, int32_t squares, int32_t frames, bool isShort)
{
    static const kiriBudget budgets[] = { { .cells = 16000, .samples = 2000 }, { .cells = 32000, .samples = 4000 } };
    enum { BUDGETS = sizeof budgets / sizeof budgets[0] };
    Delay delays[BUDGETS];
    bool fine = true;
    for (int k = 0; fine && k < BUDGETS; k++) {
        fine = Measure(&delays[k], &budgets[k], squares, frames, isShort);
    }
    if (fine) {
        double size = (double)squares * squares;
        Table_Text(table, isShort ? "short" : "across");
        Table_Number(table, squares);
        Table_Number(table, frames);
        Table_Number(table, delays[0].cells / size);
        Table_Number(table, delays[0].samples / size);
        for (int k = 0; k < BUDGETS; k++) {
            Table_Number(table, delays[k].ticks);
        }
    }
    return fine;
}

int main(void)
{
    static const char* const columns[] = { "cut",        "squares",    "frames", "cells a cell", "samples a vertex",
                                           "about 1 ms", "about 2 ms", NULL };
    static const char title[] = "Ticks until the lips of a cut part, by the budget: 16 000 cells and 2000 samples, or "
                                "twice as many; a sheet of so many squares each way,\nits grid as fine. Items of work "
                                "in all, for each cell and vertex of the sheet.";
    static const int32_t squares[] = { 64, 256 }, frames[] = { 4, 9, 25, 100 };
    Table table;
    bool fine = Table_Start(&table, "delay", title, columns);
    for (int i = 0; fine && i < 2; i++) {
        for (int k = 0; fine && k < 4; k++) {
            fine = PrintRow(&table, squares[i], frames[k], true) && PrintRow(&table, squares[i], frames[k], false);
        }
    }
    fine = Table_Stop(&table) && fine;
    if (!fine) {
        fprintf(stderr, "bench_delay: a cut without end, or an error\n");
    }
    return fine ? 0 : 1;
}
