#include "kiri_world.h"

#include "../sheet/kiri_extract.h"
#include "../sheet/kiri_update.h"

#include <string.h>

/* ---- The tick: algorithm 1 of the paper ---- */

enum { TRIANGLES, CELLS, SAMPLES, ITERATIONS, NOTHING, QUOTA_COUNT };

/* What is left of the budget in this tick. */
typedef struct Quotas {
    kiriQuota of[QUOTA_COUNT];
} Quotas;

typedef struct Stage {
    int32_t name;
    int quota;
    kiriProgress (*run)(kiriSheetData* sheet, kiriQuota* quota);
} Stage;

/* What a cut sets off, in order. Any stage may spend its quota, or run out of memory; nothing is in force before the
   commit. */
static const Stage stages[] = {
    { KIRI_STAGE_CUT, TRIANGLES, kiriUpdate_SplitMesh },     /* appendix A, algorithm 4 */
    { KIRI_STAGE_GRID, CELLS, kiriUpdate_Grid },             /* section 4.2, algorithm 3 */
    { KIRI_STAGE_REGIONS, CELLS, kiriUpdate_Regions },       /* section 5: frames for pieces that have none */
    { KIRI_STAGE_SHAPE, CELLS, kiriUpdate_Shape },           /* section 4.1, algorithm 2; re-sampling of section 5 */
    { KIRI_STAGE_SAMPLES, SAMPLES, kiriUpdate_Samples },     /* section 6 */
    { KIRI_STAGE_CONSTANTS, NOTHING, kiriUpdate_Constants }, /* mass, links, the pattern of the matrix */
};
enum { STAGE_COUNT = sizeof(stages) / sizeof(stages[0]) };

static void Enter(kiriWorld* world, int32_t stage)
{
    double now = world->clock != NULL ? world->clock(world->user) : 0.0;
    if (world->stage != KIRI_NONE) {
        world->profile.seconds[world->stage] += now - world->stageStart;
    }
    world->stage = stage;
    world->stageStart = now;
}

static int64_t Limit(int32_t items)
{
    return items > 0 ? items : INT64_MAX;
}

static Quotas ShareOut(const kiriBudget* budget)
{
    Quotas quotas = { { { Limit(budget->triangles), 0 },
                        { Limit(budget->cells), 0 },
                        { Limit(budget->samples), 0 },
                        { Limit(budget->iterations), 0 },
                        { 0, 0 } } };
    return quotas;
}

static bool IsReady(const kiriSheetData* sheet)
{
    return sheet->update.stage == STAGE_COUNT;
}

/* Carries the sheet's update on as far as its quotas go. False for memory. */
static bool Update(kiriWorld* world, kiriSheetData* sheet, Quotas* quotas)
{
    kiriUpdate* u = &sheet->update;
    u->isBegun = true;
    u->startStage = u->stage;
    u->startTaken = u->taken;
    u->startMeshChanged = u->meshChanged;
    while (u->stage < STAGE_COUNT) {
        const Stage* stage = &stages[u->stage];
        Enter(world, stage->name);
        kiriProgress progress = stage->run(sheet, &quotas->of[stage->quota]);
        if (progress != KIRI_DONE) {
            return progress == KIRI_MORE;
        }
        /* A blade may move outside the sheet, or along edges that are open already. */
        u->stage = u->meshChanged ? u->stage + 1 : STAGE_COUNT;
    }
    return true;
}

/* The earliest tick, from this one on, before which points were given that are at hand now; -1 when there is none. */
static int64_t NextStamp(const kiriWorld* world, int64_t from)
{
    int64_t next = -1;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriUpdate* u = &world->sheets.data[i]->update;
        if (u->stage != KIRI_NONE && u->stamp >= from && (next < 0 || u->stamp < next)) {
            next = u->stamp;
        }
    }
    return next;
}

/* First come, first served; of those that came together, in the order of sheets. */
static bool UpdateAll(kiriWorld* world, Quotas* quotas)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriUpdate_Start(world->sheets.data[i]);
    }
    for (int64_t stamp = NextStamp(world, 0); stamp >= 0; stamp = NextStamp(world, stamp + 1)) {
        for (int32_t i = 0; i < world->sheets.count; ++i) {
            kiriSheetData* sheet = world->sheets.data[i];
            if (sheet->update.stage != KIRI_NONE && sheet->update.stamp == stamp && !Update(world, sheet, quotas)) {
                return false;
            }
        }
    }
    return true;
}

static void AbortAll(kiriWorld* world)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriUpdate_Abort(world->sheets.data[i]);
    }
}

/* Room for the ids and events of the tick. */
static bool ReserveRoom(kiriWorld* world)
{
    int64_t frames = 0, events = 2 * (int64_t)world->sheets.count;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        events += sheet->cuts.count;
        if (IsReady(sheet) && sheet->update.meshChanged) {
            frames += sheet->update.sites.count - sheet->frames.count;
            events += sheet->update.next.pieces.count;
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
    event->piece = event->stage = KIRI_NONE;
    return event;
}

static void CountWork(kiriProfile* profile, const kiriSheetData* sheet)
{
    const kiriCommitCounts* counts = &sheet->update.counts;
    profile->cellsChanged += counts->cells;
    profile->weightsChanged += counts->weights;
    profile->verticesChanged += counts->vertices;
    profile->pointsChanged += counts->points;
    profile->linksChanged += counts->links;
    profile->commits += 1;
}

static void Commit(kiriWorld* world, kiriSheetData* sheet)
{
    int32_t oldFrames = sheet->frames.count;
    kiriUpdate_Commit(sheet);
    CountWork(&world->profile, sheet);
    for (int32_t i = oldFrames; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].id = kiriPool_Add(&world->frameIds, &world->memory, sheet, i);
    }
    for (int32_t piece = 0; piece < sheet->layout.pieces.count; ++piece) {
        if (sheet->layout.pieces.data[piece].cameOff) {
            kiriEvent* event = AddEvent(world, KIRI_EVENT_PIECE_OFF, sheet);
            event->piece = piece;
            event->frame = sheet->frames.data[sheet->layout.pieces.data[piece].frame].id;
            event->crumb = sheet->layout.pieces.data[piece].area < sheet->crumbArea;
            event->area = (float)sheet->layout.pieces.data[piece].area;
        }
    }
    for (int32_t i = oldFrames; i < sheet->frames.count; ++i) {
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

static void Finish(kiriWorld* world, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->update.count; ++i) {
        world->profile.cutSegments += !sheet->queue.data[i].jump;
    }
    if (sheet->update.meshChanged) {
        Commit(world, sheet);
    }
    kiriUpdate_Finish(sheet);
}

static void CommitAll(kiriWorld* world)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        if (sheet->update.isBegun) {
            kiriUpdate_CommitMesh(sheet);
            kiriMotion_Wake(sheet);
        }
        if (IsReady(sheet)) {
            Finish(world, sheet);
        }
        FinishCuts(world, sheet);
    }
    Enter(world, KIRI_STAGE_SKIN);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriView_TakeJump(world->sheets.data[i]);
    }
}

/* Says which sheets have work left, and where it stands. */
static bool ReportDeferred(kiriWorld* world)
{
    bool any = false;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        if (sheet->queue.count > 0) {
            kiriEvent* event = AddEvent(world, KIRI_EVENT_DEFERRED, sheet);
            event->stage = sheet->update.stage == KIRI_NONE ? KIRI_STAGE_CUT : stages[sheet->update.stage].name;
            event->waiting = sheet->queue.count;
            any = true;
        }
    }
    return any;
}

/* Moves the sheets, first the one that came too late in the last tick. */
static kiriResult SolveAll(kiriWorld* world, double dt, int32_t substeps, kiriQuota* iterations)
{
    kiriResult result = ReportDeferred(world) ? KIRI_PENDING : KIRI_OK;
    bool isLate = false;
    int32_t count = world->sheets.count, first = count > 0 ? world->turn % count : 0;
    Enter(world, KIRI_STAGE_SOLVE);
    world->turn = 0;
    for (int32_t k = 0; k < count; ++k) {
        int32_t i = (first + k) % count;
        kiriProgress progress = kiriMotion_Solve(world->sheets.data[i], world->gravity, dt, substeps, iterations);
        if (progress == KIRI_FAILED) {
            AddEvent(world, KIRI_EVENT_DIVERGED, world->sheets.data[i]);
            result = KIRI_DIVERGED;
        } else if (progress == KIRI_MORE) {
            world->turn = isLate ? world->turn : i;
            result = result == KIRI_OK ? KIRI_PENDING : result;
            isLate = true;
        }
    }
    return result;
}

static void CountJumps(kiriProfile* profile, const kiriSheetData* sheet)
{
    const kiriFades* fades = &sheet->fades;
    profile->largestJump = fades->jump > profile->largestJump ? fades->jump : profile->largestJump;
    profile->largestFade = fades->move > profile->largestFade ? fades->move : profile->largestFade;
}

static void SkinAll(kiriWorld* world, double dt)
{
    Enter(world, KIRI_STAGE_SKIN);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        if (!sheet->asleep) {
            kiriView_Fade(sheet, dt);
            kiriView_WritePositions(sheet);
        }
        CountJumps(&world->profile, sheet);
    }
}

static void CountItems(kiriProfile* profile, const Quotas* quotas)
{
    profile->trianglesSplit = (int32_t)quotas->of[TRIANGLES].used;
    profile->cellsSettled = (int32_t)quotas->of[CELLS].used;
    profile->samplesRefreshed = (int32_t)quotas->of[SAMPLES].used;
    profile->solverIterations = (int32_t)quotas->of[ITERATIONS].used;
}

kiriResult kiriWorld_Advance(kiriWorld* world, double dt, int32_t substeps)
{
    kiriMemory_FreeAll(&world->retired);
    memset(&world->profile, 0, sizeof(world->profile));
    world->events.count = 0;
    kiriResult result = KIRI_ERROR_MEMORY;
    Quotas quotas = ShareOut(&world->budget);
    if (UpdateAll(world, &quotas) && ReserveRoom(world)) {
        CommitAll(world);
        result = SolveAll(world, dt, substeps, &quotas.of[ITERATIONS]);
        SkinAll(world, dt);
        world->ticks += 1;
    } else {
        AbortAll(world);
    }
    CountItems(&world->profile, &quotas);
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
    kiriSheetData* sheet = kiriSheet_New(&world->memory);
    kiriResult result = sheet == NULL ? KIRI_ERROR_MEMORY : kiriSheet_Init(sheet, def, why);
    if (result == KIRI_OK && !ReserveSheet(world, sheet)) {
        result = KIRI_ERROR_MEMORY;
    }
    if (result != KIRI_OK) {
        kiriSheet_Delete(sheet, &world->memory);
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
    kiriMemory_AdoptAll(&world->retired, &sheet->shown);
    kiriSheet_Delete(sheet, &world->memory);
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

/* ---- Pieces ---- */

/* Ids name what has moved to this sheet, or to another place in it. */
static void PointIds(kiriWorld* world, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriSlot* slot = kiriPool_Find(&world->frameIds, sheet->frames.data[i].id);
        slot->owner = sheet;
        slot->index = i;
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriSlot* slot = kiriPool_Find(&world->pinIds, sheet->pins.data[i].id);
        slot->owner = sheet;
        slot->index = i;
    }
}

/* A sheet of the pieces that are kept, without ids; null for memory. */
static kiriSheetData* Part(kiriWorld* world, kiriExtract* extract)
{
    kiriSheetData* part = kiriSheet_New(&world->memory);
    if (part != NULL && !kiriExtract_Build(extract, part)) {
        kiriSheet_Delete(part, &world->memory);
        part = NULL;
    }
    return part;
}

/* The rest takes the place of the sheet, which is deleted. */
static void Replace(kiriWorld* world, const kiriExtract* extract, kiriSheetData* sheet, kiriSheetData* rest)
{
    kiriExtract_MoveCuts(extract, sheet, rest);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        world->sheets.data[i] = world->sheets.data[i] == sheet ? rest : world->sheets.data[i];
    }
    kiriPool_Find(&world->sheetIds, rest->id)->owner = rest;
    PointIds(world, rest);
    kiriMemory_AdoptAll(&world->retired, &sheet->shown);
    kiriSheet_Delete(sheet, &world->memory);
}

static void Invert(kiriExtract* extract)
{
    for (int32_t p = 0; p < extract->keep.count; ++p) {
        extract->keep.data[p] = !extract->keep.data[p];
    }
}

static bool Detach(kiriWorld* world, kiriSheetData* sheet, kiriExtract* extract, kiriSheet* id)
{
    if (!kiriArray_Reserve(&world->memory, &world->sheets, (int64_t)world->sheets.count + 1) ||
        !kiriPool_Reserve(&world->sheetIds, &world->memory, 1)) {
        return false;
    }
    kiriSheetData* part = Part(world, extract);
    Invert(extract);
    kiriSheetData* rest = part != NULL ? Part(world, extract) : NULL;
    if (rest == NULL) {
        kiriSheet_Delete(part, &world->memory);
        return false;
    }
    Replace(world, extract, sheet, rest);
    world->sheets.data[world->sheets.count++] = part;
    part->id = *id = kiriPool_Add(&world->sheetIds, &world->memory, part, 0);
    PointIds(world, part);
    return true;
}

/* Only what is kept stays. */
static bool Drop(kiriWorld* world, kiriSheetData* sheet, kiriExtract* extract)
{
    kiriSheetData* rest = Part(world, extract);
    if (rest == NULL) {
        return false;
    }
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (extract->frameTo.data[i] == KIRI_NONE) {
            kiriPool_Remove(&world->frameIds, sheet->frames.data[i].id);
        }
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (extract->pinTo.data[i] == KIRI_NONE) {
            kiriPool_Remove(&world->pinIds, sheet->pins.data[i].id);
        }
    }
    Replace(world, extract, sheet, rest);
    return true;
}

bool kiriWorld_DetachPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece, kiriSheet* id)
{
    kiriExtract extract;
    bool ok = kiriExtract_Init(&extract, sheet);
    if (ok) {
        extract.keep.data[piece] = 1;
        ok = Detach(world, sheet, &extract, id);
    }
    kiriMemory_FreeAll(&extract.memory);
    return ok;
}

bool kiriWorld_DropPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece)
{
    kiriExtract extract;
    bool ok = kiriExtract_Init(&extract, sheet);
    if (ok) {
        extract.keep.data[piece] = 1;
        Invert(&extract);
        ok = Drop(world, sheet, &extract);
    }
    kiriMemory_FreeAll(&extract.memory);
    return ok;
}

/* Marks what stays, and returns how many pieces do not. */
static int32_t KeepAbove(kiriExtract* extract, double area)
{
    const kiriLayout* layout = &extract->from->layout;
    int32_t largest = 0, dropped = 0;
    for (int32_t p = 1; p < layout->pieces.count; ++p) {
        largest = layout->pieces.data[p].area > layout->pieces.data[largest].area ? p : largest;
    }
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        extract->keep.data[p] = p == largest || layout->pieces.data[p].area >= area;
        dropped += !extract->keep.data[p];
    }
    return dropped;
}

bool kiriWorld_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count)
{
    kiriExtract extract;
    bool ok = kiriExtract_Init(&extract, sheet);
    int32_t dropped = ok ? KeepAbove(&extract, area) : 0;
    ok = ok && (dropped == 0 || Drop(world, sheet, &extract));
    *count = ok ? dropped : 0;
    kiriMemory_FreeAll(&extract.memory);
    return ok;
}
