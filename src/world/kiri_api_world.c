#include "kiri_call.h"
#include "kiri_state_hash.h"
#include "kiri_tick.h"
#include "../core/kiri_exact.h"
#include "../sheet/kiri_motion.h"

#include <string.h>

int32_t kiriGetVersion(void)
{
    return KIRI_VERSION;
}

/* Name and text of each result, from KIRI_ERROR_REPLAY to KIRI_PENDING. */
static const struct {
    const char *name, *text;
} results[] = {
    { "KIRI_ERROR_REPLAY",
      "a call that was made again gave something else than recorded: replay with the library version "
      "that recorded, and no other calls between" },
    { "KIRI_ERROR_DATA",
      "the bytes are damaged, cut short, of something else or of a later version: hand over all bytes "
      "that this library version wrote" },
    { "KIRI_ERROR_BUILD", "floats are not computed as on other machines: build with -ffp-contract=off and without "
                          "-ffast-math, and let the processor keep small floats and round to nearest" },
    { "KIRI_ERROR_LIMIT", "all ids of a kind are used up and nothing has changed: destroy what is not needed" },
    { "KIRI_DIVERGED",
      "the motion of a sheet could not be continued and it was put to rest: the events name it; give more "
      "substeps or iterations, or smaller forces" },
    { "KIRI_ERROR_MEMORY", "out of memory and nothing has changed: free some and call again" },
    { "KIRI_ERROR_STATE", "the call comes at the wrong time: kiriWorld_GetLastError says what has to come first" },
    { "KIRI_ERROR_MESH", "the triangles form no sheet: kiriWorld_GetLastError names one; set weldDistance for doubled "
                         "vertices" },
    { "KIRI_ERROR_ID",
      "the id is unknown, stale or of another kind: what it named may be destroyed, detached or done" },
    { "KIRI_ERROR_DEF", "the struct was not filled by this library version: call kiriDefaultWorldDef, "
                        "kiriDefaultSheetDef or the like before setting fields; for settings kiriSheet_GetSettings" },
    { "KIRI_ERROR_ARGUMENT", "a pointer or the world is null, or a number is NaN, infinite or out of range: "
                             "kiriWorld_GetLastError, or the log, says which" },
    { "KIRI_OK", "done" },
    { "KIRI_PENDING", "done, and work is left: call kiriWorld_Tick again" },
};

static bool IsResult(kiriResult result)
{
    return kiriCall_IsWithin(result, KIRI_ERROR_REPLAY, KIRI_PENDING);
}

const char* kiriGetResultName(kiriResult result)
{
    return IsResult(result) ? results[result - KIRI_ERROR_REPLAY].name : "unknown";
}

const char* kiriGetResultText(kiriResult result)
{
    return IsResult(result) ? results[result - KIRI_ERROR_REPLAY].text : "no result of this library";
}

const char* kiriGetStageName(int32_t stage)
{
    static const char* const names[KIRI_STAGE_COUNT] = { "cut",       "grid",    "regions", "shape", "samples",
                                                         "constants", "contact", "solve",   "skin" };
    return kiriCall_IsWithin(stage, 0, KIRI_STAGE_COUNT - 1) ? names[stage] : "";
}

void kiriDefaultWorldDef(kiriWorldDef* def)
{
    if (def != NULL) {
        memset(def, 0, sizeof(*def));
        def->cookie = KIRI_COOKIE(kiriWorldDef);
        def->gravity[2] = -9.81f;
        def->recordHashTicks = 60;
    }
}

static bool IsBudget(const kiriBudget* budget)
{
    return (budget->triangles == 0 || budget->triangles >= KIRI_LEAST_TRIANGLES) && budget->cells >= 0 &&
           budget->samples >= 0 && budget->iterations >= 0;
}

static const char* FaultOfWorld(const kiriWorldDef* def)
{
    if ((def->alloc == NULL) != (def->free == NULL) || !IsBudget(&def->budget) ||
        !kiriCall_AreFinite(def->gravity, 3)) {
        return "kiriCreateWorld: only one of alloc and free is null, budget is out of range, or gravity is not finite "
               "(KIRI_ERROR_ARGUMENT)";
    }
    if (def->recordHashTicks < 0) {
        return "kiriCreateWorld: recordHashTicks is below 0 (KIRI_ERROR_ARGUMENT)";
    }
    if ((def->startTask == NULL) != (def->finishTask == NULL) || !kiriCall_IsWithin(def->workerCount, 0, 1024)) {
        return "kiriCreateWorld: only one of startTask and finishTask is null, or workerCount is not within 0 and 1024 "
               "(KIRI_ERROR_ARGUMENT)";
    }
    return NULL;
}

/* There is no world yet to keep a line. */
static kiriResult RefuseWorld(const kiriWorldDef* def, kiriResult result, const char* why)
{
    if (def->log != NULL) {
        def->log(def->user, why);
    }
    return result;
}

kiriResult kiriCreateWorld(const kiriWorldDef* def, kiriWorld** world)
{
    if (def == NULL || world == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *world = NULL;
    if (def->cookie != KIRI_COOKIE(kiriWorldDef)) {
        return KIRI_ERROR_DEF;
    }
    const char* why = FaultOfWorld(def);
    if (why != NULL) {
        return RefuseWorld(def, KIRI_ERROR_ARGUMENT, why);
    }
    if (!kiriExact_IsModePlain()) {
        return RefuseWorld(def, KIRI_ERROR_BUILD,
                           "kiriCreateWorld: this thread flushes small floats to zero (FTZ, DAZ) or does not round to "
                           "nearest; set the processor's mode back (KIRI_ERROR_BUILD)");
    }
    if (!kiriExact_AreFloats()) {
        return RefuseWorld(def, KIRI_ERROR_BUILD,
                           "kiriCreateWorld: the library is compiled with fused multiply-add or reordered sums; add "
                           "-ffp-contract=off (KIRI_ERROR_BUILD)");
    }
    kiriMemory memory = kiriMemory_Make(def->alloc, def->free, def->user);
    kiriWorld* made = memory.alloc(memory.user, sizeof(*made)); /* owns itself: no block of its memory */
    if (made == NULL) {
        return RefuseWorld(def, KIRI_ERROR_MEMORY, "kiriCreateWorld: out of memory (KIRI_ERROR_MEMORY)");
    }
    memset(made, 0, sizeof(*made));
    made->memory = kiriMemory_Like(&memory);
    made->retired = kiriMemory_Like(&memory);
    made->log = def->log;
    made->clock = def->clock;
    made->tasks = (kiriTasks){ def->startTask, def->finishTask, def->user, def->workerCount };
    made->user = def->user;
    made->gravity = kiriVec3_Load(def->gravity);
    made->budget = def->budget;
    made->stage = KIRI_NONE;
    kiriPool_Init(&made->sheetIds, KIRI_KIND_SHEET);
    kiriPool_Init(&made->cutIds, KIRI_KIND_CUT);
    kiriPool_Init(&made->frameIds, KIRI_KIND_FRAME);
    kiriPool_Init(&made->pinIds, KIRI_KIND_PIN);
    kiriPool_Init(&made->obstacleIds, KIRI_KIND_OBSTACLE);
    kiriPool_Init(&made->bladeIds, KIRI_KIND_BLADE);
    kiriRecord_Start(made, def);
    *world = made;
    return KIRI_OK;
}

void kiriDestroyWorld(kiriWorld* world)
{
    if (world == NULL) {
        return;
    }
    if (world->isBusy || kiriCall_IsRead(world)) {
        (void)kiriCall_Refuse(world, __func__);
        return;
    }
    world->isBusy = true;
    kiriRecord_Stop(world);
    while (world->sheets.count > 0) {
        kiriWorld_RemoveSheet(world, world->sheets.data[world->sheets.count - 1]);
    }
    kiriMemory_FreeAll(&world->retired);
    kiriMemory_FreeAll(&world->memory);
    world->memory.free(world->memory.user, world);
}

kiriResult kiriWorld_Tick(kiriWorld* world, float dt, int32_t substeps)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_TICK, &dt, &substeps, NULL);
    world->begun += 1; /* refused ticks count: the host copies meshes before each call */
    KIRI_CHECK(kiriCall_IsAtLeast(dt, 1e-6f) && dt <= 10.0f, "dt is not within 1e-6 and 10 s");
    KIRI_CHECK(kiriCall_IsWithin(substeps, 1, 64), "substeps is not within 1 and 64");
    kiriResult result = kiriWorld_Advance(world, dt, substeps);
    if (result == KIRI_ERROR_MEMORY) {
        return KIRI_FAIL(result, "out of memory; nothing moved, and cuts still wait");
    }
    if (result == KIRI_ERROR_LIMIT) {
        return KIRI_FAIL(result, "there are no ids left for new frames; nothing moved, and cuts still wait");
    }
    KIRI_RETURN(result);
}

const char* kiriWorld_GetLastError(const kiriWorld* world)
{
    return world != NULL ? world->errorLine : "";
}

kiriResult kiriWorld_SetGravity(kiriWorld* world, const float gravity[3])
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_SET_GRAVITY, gravity);
    KIRI_CHECK(gravity != NULL && kiriCall_AreFinite(gravity, 3), "gravity is null or not finite");
    kiriVec3 before = world->gravity;
    world->gravity = kiriVec3_Load(gravity);
    for (int32_t i = 0; i < world->sheets.count && !kiriVec3_Equal(before, world->gravity); ++i) {
        kiriMotion_Wake(world->sheets.data[i]);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriWorld_SetBudget(kiriWorld* world, const kiriBudget* budget)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_SET_BUDGET, budget);
    KIRI_CHECK(budget != NULL && IsBudget(budget),
               "budget is null, or below 0, or its triangles below KIRI_LEAST_TRIANGLES");
    world->budget = *budget;
    KIRI_RETURN(KIRI_OK);
}

/* The recording has it; the world itself does not care. */
kiriResult kiriWorld_Note(kiriWorld* world, const void* bytes, int32_t count)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_NOTE, bytes, &count);
    KIRI_CHECK(bytes != NULL && kiriCall_IsWithin(count, 1, KIRI_MOST_NOTE_BYTES),
               "bytes is null, or count not within 1 and 1048576");
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriWorld_GetSheets(const kiriWorld* world, kiriSheet* sheets, int32_t capacity, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(count != NULL && (capacity == 0 || (capacity > 0 && sheets != NULL)), "count is null, or sheets is");
    for (int32_t i = 0; i < world->sheets.count && i < capacity; ++i) {
        sheets[i] = world->sheets.data[i]->id;
    }
    *count = world->sheets.count;
    return KIRI_OK;
}

kiriResult kiriWorld_GetStateHash(const kiriWorld* world, uint64_t* hash)
{
    KIRI_READS(world);
    KIRI_CHECK(hash != NULL, "hash is null");
    *hash = kiriStateHash_Of(world);
    return KIRI_OK;
}

kiriResult kiriWorld_GetEvents(const kiriWorld* world, const kiriEvent** events, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(events != NULL && count != NULL, "events or count is null");
    *events = world->events.data;
    *count = world->events.count;
    return KIRI_OK;
}

kiriResult kiriWorld_GetProfile(const kiriWorld* world, kiriProfile* profile)
{
    KIRI_READS(world);
    KIRI_CHECK(profile != NULL, "profile is null");
    *profile = world->profile;
    return KIRI_OK;
}

/* So many times the items. */
static int32_t ScaleItems(int32_t items, double times, int32_t least, int32_t was)
{
    double scaled = items * times;
    return items <= 0 ? was : scaled < least ? least : scaled < INT32_MAX ? (int32_t)scaled : INT32_MAX;
}

static double SecondsOf(const kiriProfile* profile, int first, int last)
{
    double seconds = 0.0;
    for (int i = first; i <= last; ++i) {
        seconds += profile->seconds[i];
    }
    return seconds;
}

/* What all work on cuts took, in times of what these stages of it took. */
static double TimesAlone(const kiriProfile* profile, int first, int last)
{
    double seconds = SecondsOf(profile, first, last);
    return seconds > 0.0 ? SecondsOf(profile, KIRI_STAGE_CUT, KIRI_STAGE_CONSTANTS) / seconds : 1.0;
}

/* The three kinds of work on cuts share a tick: each may take the time of all three. */
static void FitCuts(const kiriProfile* profile, double times, kiriBudget* budget)
{
    double triangles = times * TimesAlone(profile, KIRI_STAGE_CUT, KIRI_STAGE_CUT),
           cells = times * TimesAlone(profile, KIRI_STAGE_GRID, KIRI_STAGE_SHAPE),
           samples = times * TimesAlone(profile, KIRI_STAGE_SAMPLES, KIRI_STAGE_CONSTANTS);
    budget->triangles = ScaleItems(profile->trianglesSplit, triangles, KIRI_LEAST_TRIANGLES, budget->triangles);
    budget->cells = ScaleItems(profile->cellsSettled, cells, 1, budget->cells);
    budget->samples = ScaleItems(profile->samplesRefreshed, samples, 1, budget->samples);
}

kiriResult kiriFitBudget(const kiriProfile* profile, float microseconds, kiriBudget* budget)
{
    if (profile == NULL || budget == NULL || !kiriCall_IsAbove(microseconds, 0.0f) || !IsBudget(budget)) {
        return KIRI_ERROR_ARGUMENT;
    }
    for (int i = 0; i < KIRI_STAGE_COUNT; ++i) {
        if (!(profile->seconds[i] >= 0.0)) {
            return KIRI_ERROR_ARGUMENT;
        }
    }
    double seconds = SecondsOf(profile, 0, KIRI_STAGE_COUNT - 1);
    if (seconds > 0.0) {
        double times = 1e-6 * microseconds / seconds;
        FitCuts(profile, times, budget);
        budget->iterations = ScaleItems(profile->solverIterations, times, 1, budget->iterations);
    }
    return KIRI_OK;
}
