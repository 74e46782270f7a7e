#include "world.h"

#include <string.h>

/* ---- The tick: algorithm 1 of the paper ---- */

typedef struct Stage {
    int32_t name;
    bool (*run)(kiriSheetData* sheet);
} Stage;

/* What a cut sets off, in order. Any stage may run out of memory; nothing is final before the commit. */
static const Stage cutStages[] = {
    { KIRI_STAGE_CUT, kiriSheet_SplitMesh },            /* appendix A, algorithm 4 */
    { KIRI_STAGE_GRID, kiriSheet_BuildGrid },           /* section 4.2, algorithm 3 */
    { KIRI_STAGE_REGIONS, kiriSheet_BuildRegions },     /* section 5: frames for pieces that have none */
    { KIRI_STAGE_SHAPE, kiriSheet_BuildShape },         /* section 4.1, algorithm 2; re-sampling of section 5 */
    { KIRI_STAGE_SAMPLES, kiriSheet_BuildSamples },     /* section 6 */
    { KIRI_STAGE_CONSTANTS, kiriSheet_BuildConstants }, /* mass, links, the pattern of the matrix */
};
enum { CUT_STAGE_COUNT = sizeof(cutStages) / sizeof(cutStages[0]) };

static void Enter(kiriWorld* world, int32_t stage)
{
    double now = world->clock != NULL ? world->clock(world->user) : 0.0;
    if (world->stage != KIRI_NONE) {
        world->profile.seconds[world->stage] += now - world->stageStart;
    }
    world->stage = stage;
    world->stageStart = now;
}

static bool HasStrokes(const kiriSheetData* sheet)
{
    return sheet->granted > 0;
}

/* Shares the budget out, sheet by sheet. What is not granted waits. */
static void Grant(kiriWorld* world)
{
    int32_t left = world->cutBudget > 0 ? world->cutBudget : INT32_MAX;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        sheet->granted = sheet->queue.count < left ? sheet->queue.count : left;
        left -= sheet->granted;
    }
}

static bool IsRecut(const kiriSheetData* sheet)
{
    return HasStrokes(sheet) && kiriSheet_IsTorn(sheet);
}

/* Takes the waiting blade points, and builds the model that follows from the mesh they leave. */
static bool Recut(kiriWorld* world, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < CUT_STAGE_COUNT; ++i) {
        Enter(world, cutStages[i].name);
        if (!cutStages[i].run(sheet)) {
            return false;
        }
        if (!kiriSheet_IsTorn(sheet)) {
            break; /* the blade moved outside the sheet, or along edges that are open already */
        }
    }
    return true;
}

static bool RecutAll(kiriWorld* world, int32_t* begun)
{
    for (*begun = 0; *begun < world->sheets.count;) {
        kiriSheetData* sheet = world->sheets.data[(*begun)++];
        if (HasStrokes(sheet) && !Recut(world, sheet)) {
            return false;
        }
    }
    return true;
}

static void RollbackAll(kiriWorld* world, int32_t begun)
{
    for (int32_t i = 0; i < begun; ++i) {
        if (HasStrokes(world->sheets.data[i])) {
            kiriSheet_Rollback(world->sheets.data[i]);
        }
    }
}

/* Room for the ids and events of the commits to come. */
static bool ReserveRoom(kiriWorld* world)
{
    int64_t frames = 0, events = world->sheets.count;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        events += sheet->cuts.count;
        if (IsRecut(sheet)) {
            frames += sheet->next.sites.count - sheet->frames.count;
            events += sheet->next.grid.pieces;
        }
    }
    return kiriPool_Reserve(&world->frameIds, &world->memory, (int32_t)frames) &&
           kiriArray_Reserve(&world->memory, &world->events, events + frames);
}

static kiriEvent* AddEvent(kiriWorld* world, int32_t type, const kiriSheetData* sheet)
{
    kiriEvent* event = &world->events.data[world->events.count++];
    memset(event, 0, sizeof(*event));
    event->type = type;
    event->sheet = sheet->id;
    event->piece = KIRI_NONE;
    return event;
}

static void CountWork(kiriProfile* profile, const kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->granted; ++i) {
        profile->cutSegments += !sheet->queue.data[i].jump;
    }
    if (IsRecut(sheet)) {
        profile->trianglesSplit +=
            sheet->mesh.savedTriangles.count + sheet->mesh.triangles.count - sheet->mesh.oldTriangleCount;
        profile->cellsSettled += sheet->next.grid.cells.count;
        profile->samplesRefreshed += sheet->mesh.vertices.count + sheet->next.points.count;
    }
}

static void SwapModel(kiriWorld* world, kiriSheetData* sheet)
{
    int32_t oldFrames = sheet->frames.count;
    kiriSheet_SwapModel(sheet);
    for (int32_t piece = 0; piece < sheet->model.grid.pieces; ++piece) {
        if (sheet->model.pieces.data[piece].cameOff) {
            kiriEvent* event = AddEvent(world, KIRI_EVENT_PIECE_OFF, sheet);
            event->piece = piece;
            event->area = (float)sheet->model.pieces.data[piece].area;
        }
    }
    for (int32_t i = oldFrames; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].id = kiriPool_Add(&world->frameIds, &world->memory, sheet, i);
        AddEvent(world, KIRI_EVENT_FRAME_ADDED, sheet)->frame = sheet->frames.data[i].id;
    }
}

static void RemoveCut(kiriWorld* world, kiriCutData* cut)
{
    kiriPool_Remove(&world->cutIds, cut->id);
    kiriMemory_Free(&world->memory, cut);
}

static void FinishCuts(kiriWorld* world, kiriSheetData* sheet)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        kiriCutData* cut = sheet->cuts.data[i];
        if (cut->ended && cut->waiting == 0) {
            AddEvent(world, KIRI_EVENT_CUT_FINISHED, sheet)->cut = cut->id;
            RemoveCut(world, cut);
        } else {
            sheet->cuts.data[kept++] = cut;
        }
    }
    sheet->cuts.count = kept;
}

static void CommitAll(kiriWorld* world)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        CountWork(&world->profile, sheet);
        if (IsRecut(sheet)) {
            SwapModel(world, sheet);
        }
        if (HasStrokes(sheet)) {
            kiriSheet_Commit(sheet);
            kiriMotion_Wake(sheet);
        }
        FinishCuts(world, sheet);
    }
}

static kiriResult SolveAll(kiriWorld* world, double dt, int32_t substeps)
{
    kiriResult result = KIRI_OK;
    Enter(world, KIRI_STAGE_SOLVE);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i]->queue.count > 0 && result == KIRI_OK) {
            result = KIRI_PENDING;
        }
        int32_t solved = kiriMotion_Solve(world->sheets.data[i], world->gravity, dt, substeps);
        if (solved < 0) {
            AddEvent(world, KIRI_EVENT_DIVERGED, world->sheets.data[i]);
            result = KIRI_DIVERGED;
        } else {
            world->profile.solverIterations += solved;
        }
    }
    return result;
}

static void SkinAll(kiriWorld* world)
{
    Enter(world, KIRI_STAGE_SKIN);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (!world->sheets.data[i]->asleep) {
            kiriView_WritePositions(world->sheets.data[i]);
        }
    }
}

kiriResult kiriWorld_Advance(kiriWorld* world, double dt, int32_t substeps)
{
    memset(&world->profile, 0, sizeof(world->profile));
    world->events.count = 0;
    kiriResult result = KIRI_ERROR_MEMORY;
    int32_t begun;
    Grant(world);
    if (RecutAll(world, &begun) && ReserveRoom(world)) {
        CommitAll(world);
        result = SolveAll(world, dt, substeps);
        SkinAll(world);
    } else {
        RollbackAll(world, begun);
    }
    Enter(world, KIRI_NONE);
    return result;
}

/* ---- Sheets and cuts ---- */

static bool ReserveSheet(kiriWorld* world, kiriSheetData* sheet)
{
    return kiriArray_Reserve(&world->memory, &world->sheets, (int64_t)world->sheets.count + 1) &&
           kiriPool_Reserve(&world->sheetIds, &world->memory, 1) &&
           kiriPool_Reserve(&world->frameIds, &world->memory, sheet->frames.count);
}

kiriResult kiriWorld_AddSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* id, const char** why)
{
    kiriSheetData* sheet = kiriMemory_Alloc(&world->memory, sizeof(*sheet));
    kiriResult result = sheet == NULL ? KIRI_ERROR_MEMORY : kiriSheet_Init(sheet, &world->memory, def, why);
    if (result == KIRI_OK && !ReserveSheet(world, sheet)) {
        kiriSheet_Release(sheet);
        result = KIRI_ERROR_MEMORY;
    }
    if (result != KIRI_OK) {
        kiriMemory_Free(&world->memory, sheet);
        return result;
    }
    world->sheets.data[world->sheets.count++] = sheet;
    sheet->id = kiriPool_Add(&world->sheetIds, &world->memory, sheet, 0);
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].id = kiriPool_Add(&world->frameIds, &world->memory, sheet, i);
    }
    kiriView_WritePositions(sheet);
    *id = sheet->id;
    return KIRI_OK;
}

void kiriWorld_RemoveSheet(kiriWorld* world, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriPool_Remove(&world->frameIds, sheet->frames.data[i].id);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriPool_Remove(&world->pinIds, sheet->pins.data[i].id);
    }
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        RemoveCut(world, sheet->cuts.data[i]);
    }
    kiriPool_Remove(&world->sheetIds, sheet->id);
    int32_t kept = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i] != sheet) {
            world->sheets.data[kept++] = world->sheets.data[i];
        }
    }
    world->sheets.count = kept;
    kiriSheet_Release(sheet);
    kiriMemory_Free(&world->memory, sheet);
}

kiriCutData* kiriWorld_AddCut(kiriWorld* world, kiriSheetData* sheet)
{
    if (!kiriArray_Reserve(&world->memory, &sheet->cuts, (int64_t)sheet->cuts.count + 1) ||
        !kiriPool_Reserve(&world->cutIds, &world->memory, 1)) {
        return NULL;
    }
    kiriCutData* cut = kiriMemory_Alloc(&world->memory, sizeof(*cut));
    if (cut == NULL) {
        return NULL;
    }
    memset(cut, 0, sizeof(*cut));
    cut->sheet = sheet;
    cut->tip.blade.vertex = cut->committed.blade.vertex = KIRI_NONE;
    cut->id = kiriPool_Add(&world->cutIds, &world->memory, cut, 0);
    sheet->cuts.data[sheet->cuts.count++] = cut;
    return cut;
}
