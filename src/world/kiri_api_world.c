#include "kiri_call.h"
#include "kiri_state.h"
#include "kiri_tick.h"
#include "../core/kiri_vec.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_build.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_piece.h"

#include <float.h>
#include <stdio.h>

/* Measured values have their source here. Damping and values called assumed are chosen for their look.

   Paper: printing paper, 110 um, 2.92 GPa (Scientific Reports 4, 6275 (2014), table 2); 80 g/m^2; Poisson's ratio
   assumed. Cotton: bending stiffness 1.4e-5 N m, as of light denim in the KES test (Journal of Textiles 2016, 4614168,
   table 5, sample B: 0.144 gf cm^2/cm); half a millimetre and 200 g/m^2 assumed. Woven cloth stretches less than a
   plate that bends as easily: Young's modulus here is the one that bends right. Rubber: natural rubber, 1.5 to 2.5 MPa,
   920 to 930 kg/m^3, nearly incompressible (Ashby, Materials Selection in Mechanical Design, appendix on property
   ranges); 1 mm assumed. Foil: aluminium, 69 GPa, 0.33, 2700 kg/m^3 (the same appendix: 68 to 82 GPa, 2500 to 2900
   kg/m^3, alloys included); 16 um, as household foil. It yields at 34 MPa, as annealed aluminium 1100-O does (ASM
   Handbook, volume 2; the appendix has 30 MPa and more); it reaches 65 MPa at 5 %, hence the hardening. Card: paperboard,
   0.4 mm: means over both directions of the board of Xia, Boyce and Parks (Int. J. Solids Struct. 39, 4053 (2002)): 5.6 and
   2 GPa; its steep part ends at about 30 and 13 MPa in tension, and at half of that in pressure; then a seventh of the
   modulus. Paper is between that and its strength, 40 MPa at 3 %: assumed. Cotton and rubber are elastic.
   Only cloths have a detail layer: paper, card and foil hardly strain, and rubber is meant to look stretched.
   Silk, shirting, wool, denim, jersey: weights as sold, 55, 120, 220, 330 and 160 g/m^2. Bending stiffness: the median
   of the fabrics within 15 % of that weight among 251 that were measured (Feng, Huang, Xu, Wang, Learning-Based Bending
   Stiffness Parameter Estimation by a Drape Tester, ACM Trans. Graph. 41, 2022, its data set: mean of warp, weft and
   both diagonals); for jersey the softest tenth, assumed, for the data name no fibres. The plate that bends so and has the
   tensile stiffness 600 N/m (jersey 150), assumed, has the thickness here. Slack: see the manual (sheets). */
static const kiriMaterial materials[KIRI_MATERIAL_COUNT] = {
    { 2.92e9f, 0.3f, 1.1e-4f, 727.0f, 1.0f, 2e-3f, 2e7f, 0.2f, 0.0f, 0, { 0.0f } },
    { 1.2e6f, 0.3f, 5e-4f, 400.0f, 0.8f, 2e-2f, 0.0f, 0.0f, 0.0f, 2, { 0.0f } },
    { 2e6f, 0.49f, 1e-3f, 925.0f, 0.3f, 1e-2f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } },
    { 6.9e10f, 0.33f, 1.6e-5f, 2700.0f, 1.0f, 1e-3f, 3.4e7f, 0.01f, 0.0f, 0, { 0.0f } },
    { 3.3e9f, 0.3f, 4e-4f, 780.0f, 1.0f, 2e-3f, 1.5e7f, 0.15f, 0.0f, 0, { 0.0f } },
    { 2.43e6f, 0.3f, 2.47e-4f, 223.0f, 0.8f, 2e-2f, 0.0f, 0.0f, 0.98f, 2, { 0.0f } },
    { 1.59e6f, 0.3f, 3.77e-4f, 318.0f, 0.8f, 2e-2f, 0.0f, 0.0f, 0.98f, 2, { 0.0f } },
    { 1.05e6f, 0.3f, 5.71e-4f, 385.0f, 0.8f, 2e-2f, 0.0f, 0.0f, 0.98f, 2, { 0.0f } },
    { 7.73e5f, 0.3f, 7.76e-4f, 425.0f, 0.8f, 2e-2f, 0.0f, 0.0f, 0.98f, 2, { 0.0f } },
    { 2.96e5f, 0.3f, 5.06e-4f, 316.0f, 0.8f, 2e-2f, 0.0f, 0.0f, 0.98f, 2, { 0.0f } },
};

kiriResult kiriGetMaterial(int32_t preset, kiriMaterial* material)
{
    if (preset < 0 || preset >= KIRI_MATERIAL_COUNT || material == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *material = materials[preset];
    return KIRI_OK;
}

/* Toughness: orders of magnitude of tear tests. Strength: paper and foil as above (1100-O: 90 MPa); card: between 45 and
   20 MPa, along and across, assumed; rubber: 22 to 32 MPa (Ashby); cloth: 15 kN/m, as of light cotton, assumed. */
kiriResult kiriGetTearing(int32_t preset, kiriTearing* tearing)
{
    static const float given[][2] = { [KIRI_MATERIAL_PAPER] = { 1e4f, 4e7f },  [KIRI_MATERIAL_COTTON] = { 4e4f, 3e7f },
                                      [KIRI_MATERIAL_RUBBER] = { 1e4f, 2.2e7f }, [KIRI_MATERIAL_FOIL] = { 1e4f, 9e7f },
                                      [KIRI_MATERIAL_CARD] = { 1.5e4f, 3e7f } };
    if (preset < 0 || preset >= KIRI_MATERIAL_COUNT || tearing == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    KIRI_CLEAR(tearing);
    const float* values = given[preset < KIRI_MATERIAL_SILK ? preset : KIRI_MATERIAL_COTTON];
    tearing->toughness = values[0];
    tearing->strength = values[1];
    return KIRI_OK;
}

/* Points of the front that `make accuracy` measures (tests/sweep.h has the scenes): no setting of the strip is more
   accurate at the same cost on a grid as coarse; and none of the square by more than a hundredth of the error, with
   half as many frames along. One Newton step in each of many substeps beats many steps in few. */
static const kiriQuality qualities[KIRI_QUALITY_COUNT] = {
    { 5, 20, 1, 2 },
    { 9, 40, 1, 4 },
    { 17, 80, 1, 8 },
};

kiriResult kiriGetQuality(int32_t preset, kiriQuality* quality)
{
    if (preset < 0 || preset >= KIRI_QUALITY_COUNT || quality == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *quality = qualities[preset];
    return KIRI_OK;
}

/* Measured, cut in the middle of the run: the manual (accuracy) has the table. */
static const struct {
    int32_t material;
    float thickness; /* part of the thickness of the material */
    int32_t model, frames, iterations;
} setups[KIRI_SETUP_COUNT] = {
    { KIRI_MATERIAL_COTTON, 1.0f, KIRI_MODEL_LINKS, 24, 1 },
    { KIRI_MATERIAL_PAPER, 1.0f, KIRI_MODEL_LINKS, 25, 1 },
    { KIRI_MATERIAL_COTTON, 0.5f, KIRI_MODEL_LINKS, 40, 1 },
    { KIRI_MATERIAL_COTTON, 0.4f, KIRI_MODEL_LINKS, 17, 1 },
    { KIRI_MATERIAL_RUBBER, 1.0f, KIRI_MODEL_AFFINE, 25, 4 },
    { KIRI_MATERIAL_CARD, 1.0f, KIRI_MODEL_LINKS, 12, 1 },
    { KIRI_MATERIAL_FOIL, 1.0f, KIRI_MODEL_LINKS, 25, 1 },
};

/* The shorter side has four squares of the grid or more, and most of a frame. */
kiriResult kiriGetSetup(int32_t preset, float width, float height, kiriSheetDef* def)
{
    float longer = width > height ? width : height, shorter = width > height ? height : width;
    if (preset < 0 || preset >= KIRI_SETUP_COUNT || def == NULL || !(shorter > 0.0f) ||
        !(longer <= 256.0f * shorter) || longer > 4e37f) {
        return KIRI_ERROR_ARGUMENT;
    }
    int32_t squares = (int32_t)(4.0f * (longer / shorter)), frames = squares / 5;
    kiriDefaultSheetDef(def);
    def->material = materials[setups[preset].material];
    def->material.thickness *= setups[preset].thickness;
    def->model = setups[preset].model;
    def->gridResolution = squares > 40 ? squares : 40;
    def->frameCount = frames > setups[preset].frames ? frames : setups[preset].frames;
    def->iterations = setups[preset].iterations;
    return KIRI_OK;
}

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
    { "KIRI_ERROR_ARGUMENT", "a pointer or the world is null, or a number is NaN, infinite or out of range" },
    { "KIRI_OK", "done" },
    { "KIRI_PENDING", "done, and work is left: call kiriWorld_Tick again" },
};

static bool IsResult(kiriResult result)
{
    return result >= KIRI_ERROR_REPLAY && result <= KIRI_PENDING;
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
    return stage >= 0 && stage < KIRI_STAGE_COUNT ? names[stage] : "";
}

void kiriDefaultWorldDef(kiriWorldDef* def)
{
    if (def != NULL) {
        KIRI_CLEAR(def);
        def->cookie = KIRI_COOKIE(kiriWorldDef);
        def->gravity[2] = -9.81f;
        def->recordHashTicks = 60;
    }
}

/* Logs a refusal, as no world exists that could store its line. `why` null: logs the text of the result. */
static kiriResult RefuseWorld(const kiriWorldDef* def, kiriResult result, const char* why)
{
    if (def->log != NULL) {
        char line[256];
        snprintf(line, sizeof(line), "kiriCreateWorld: %s (%s)", why != NULL ? why : kiriGetResultText(result),
                 kiriGetResultName(result));
        def->log(def->user, line);
    }
    return result;
}

kiriResult kiriCreateWorld(const kiriWorldDef* def, kiriWorld** world)
{
    kiriWorldDef defaults;
    kiriDefaultWorldDef(&defaults);
    def = def != NULL ? def : &defaults;
    if (world == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *world = NULL;
    if (def->cookie != KIRI_COOKIE(kiriWorldDef)) {
        return KIRI_ERROR_DEF;
    }
    kiriFault fault = { "" };
    if (kiriStruct_Check(kiriWorldDefStruct(), "def", NULL, def, &fault) != KIRI_OK) {
        return RefuseWorld(def, KIRI_ERROR_ARGUMENT, fault.line);
    }
    if ((def->alloc == NULL) != (def->free == NULL) || (def->startTask == NULL) != (def->finishTask == NULL)) {
        return RefuseWorld(def, KIRI_ERROR_ARGUMENT,
                           "only one of alloc and free is null, or only one of startTask and finishTask");
    }
    if (def->workerCount > 1 && def->startTask == NULL) {
        return RefuseWorld(def, KIRI_ERROR_ARGUMENT, "workerCount is above 1, and startTask is null");
    }
    if (!kiriExact_IsModePlain()) {
        return RefuseWorld(def, KIRI_ERROR_BUILD,
                           "this thread flushes small floats to zero (FTZ, DAZ) or does not round to nearest; set the "
                           "processor's mode back");
    }
    if (!kiriExact_AreFloats()) {
        return RefuseWorld(def, KIRI_ERROR_BUILD,
                           "the library is compiled with fused multiply-add or reordered sums; add -ffp-contract=off");
    }
    kiriMemory memory = kiriMemory_Make(def->alloc, def->free, def->user);
    kiriWorld* made = memory.alloc(memory.user, sizeof(*made)); /* not on the world's own list of blocks */
    if (made == NULL) {
        return RefuseWorld(def, KIRI_ERROR_MEMORY, NULL);
    }
    KIRI_CLEAR(made);
    made->memory = kiriMemory_Like(&memory);
    made->retired = kiriMemory_Like(&memory);
    made->log = def->log;
    made->clock = def->clock;
    made->tasks = (kiriTasks){ def->startTask, def->finishTask, def->user, def->workerCount };
    made->user = def->user;
    made->gravity = kiriVec3_Load(def->gravity);
    made->budget = def->budget;
    made->stage = KIRI_NONE;
#define INIT_POOL(pool, kind) kiriPool_Init(&made->pool, KIRI_KIND_##kind);
    KIRI_POOLS(INIT_POOL)
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
    KIRI_ASSERT(world->sheets.count == 0);
    kiriMemory_FreeAll(&world->retired);
    kiriMemory_FreeAll(&world->memory);
    world->memory.free(world->memory.user, world);
}

kiriResult kiriWorld_Tick(kiriWorld* world, float dt, int32_t substeps)
{
    KIRI_CHANGES(World_Tick, &dt, &substeps);
    world->begun += 1; /* counts refused ticks: the host copies meshes before each call */
    KIRI_CHECK_NUMBER(dt, 1e-6f, 10.0f);
    KIRI_CHECK_NUMBER(substeps, 1, 64);
    int64_t ticks = world->ticks;
    kiriResult result = kiriWorld_Advance(world, dt, substeps);
    const char* why = result == KIRI_ERROR_MEMORY && world->ticks > ticks
                          ? "out of memory; everything moved, and cuts or pieces go on in the next tick"
                      : result == KIRI_ERROR_MEMORY ? "out of memory; nothing moved, and cuts still wait"
                      : result == KIRI_ERROR_LIMIT  ? "there are no ids left for new frames; cuts still wait"
                                                    : NULL;
    return KIRI_FAIL(result, why);
}

const char* kiriWorld_GetLastError(const kiriWorld* world)
{
    return world != NULL ? world->errorLine : "";
}

kiriResult kiriWorld_SetGravity(kiriWorld* world, const float gravity[3])
{
    KIRI_CHANGES(World_SetGravity, gravity);
    kiriVec3 before = world->gravity;
    world->gravity = kiriVec3_Load(gravity);
    KIRI_EACH_OF_WHILE(!kiriVec3_Equal(before, world->gravity), kiriSheetData, sheet, world->sheets) {
        kiriSheet_WakeAll(sheet);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriWorld_SetBudget(kiriWorld* world, const kiriBudget* budget)
{
    KIRI_CHANGES(World_SetBudget, budget);
    world->budget = *budget;
    KIRI_RETURN(KIRI_OK);
}

/* Only the recording stores the note. */
kiriResult kiriWorld_Note(kiriWorld* world, const void* bytes, int32_t count)
{
    KIRI_CHANGES(World_Note, bytes, &count);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriWorld_GetSheets(const kiriWorld* world, kiriSheet* sheets, int32_t capacity, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK_LIST(sheets);
    KIRI_RETURN_IDS(sheets, world->sheets, world->sheets.data[i]);
}

kiriResult kiriWorld_GetStateHash(const kiriWorld* world, uint64_t* hash)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(hash);
    *hash = kiriStateHash_Of(world);
    return KIRI_OK;
}

kiriResult kiriWorld_GetEvents(const kiriWorld* world, const kiriEvent** events, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(events);
    KIRI_CHECK_OUT(count);
    *events = world->events.data;
    *count = world->events.count;
    return KIRI_OK;
}

kiriResult kiriWorld_GetProfile(const kiriWorld* world, kiriProfile* profile)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(profile);
    *profile = world->profile;
    return KIRI_OK;
}

static double SecondsOf(const kiriProfile* profile, int first, int last)
{
    double seconds = 0.0;
    for (int i = first; i <= last; ++i) {
        seconds += profile->seconds[i];
    }
    return seconds;
}

kiriResult kiriFitBudget(const kiriProfile* profile, float microseconds, kiriBudget* budget)
{
    kiriFault fault;
    if (profile == NULL || budget == NULL || !(microseconds > 0.0f && microseconds <= FLT_MAX) ||
        kiriStruct_Check(kiriArguments[KIRI_ARGUMENT_BUDGET].of(), "", NULL, budget, &fault) != KIRI_OK) {
        return KIRI_ERROR_ARGUMENT;
    }
    KIRI_TIMES(i, KIRI_STAGE_COUNT) {
        if (!(profile->seconds[i] >= 0.0)) {
            return KIRI_ERROR_ARGUMENT;
        }
    }
    /* The three kinds of work on cuts share one allowance, so each limit gets the time of all three. */
    double cuts = SecondsOf(profile, KIRI_STAGE_CUT, KIRI_STAGE_CONSTANTS),
           motion = SecondsOf(profile, KIRI_STAGE_CONTACT, KIRI_STAGE_SKIN),
           seconds = (cuts > 0.0 && motion > 0.0 ? 0.5e-6 : 1e-6) * microseconds;
    const int32_t items[] = { profile->trianglesSplit, profile->cellsSettled, profile->samplesRefreshed,
                              profile->solverIterations };
    const double spent[] = { SecondsOf(profile, KIRI_STAGE_CUT, KIRI_STAGE_CUT),
                             SecondsOf(profile, KIRI_STAGE_GRID, KIRI_STAGE_SHAPE),
                             SecondsOf(profile, KIRI_STAGE_SAMPLES, KIRI_STAGE_CONSTANTS), motion };
    int32_t* const limits[] = { &budget->triangles, &budget->cells, &budget->samples, &budget->iterations };
    KIRI_TIMES(i, 4) {
        if (items[i] > 0 && spent[i] > 0.0) {
            double scaled = items[i] * (seconds / spent[i]), least = i == 0 ? KIRI_LEAST_TRIANGLES : 1.0;
            *limits[i] = scaled < least ? (int32_t)least : scaled < INT32_MAX ? (int32_t)scaled : INT32_MAX;
        }
    }
    return KIRI_OK;
}

kiriResult kiriSheet_SetUserData(kiriWorld* world, kiriSheet sheet, uint64_t data)
{
    KIRI_CHANGES(Sheet_SetUserData, &sheet, &data);
    call->sheet->settings.userData = data;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetUserData(const kiriWorld* world, kiriSheet sheet, uint64_t* data)
{
    KIRI_READS_OF(sheet, data);
    *data = found->settings.userData;
    return KIRI_OK;
}

kiriResult kiriPin_SetUserData(kiriWorld* world, kiriPin pin, uint64_t data)
{
    KIRI_CHANGES(Pin_SetUserData, &pin, &data);
    call->sheet->pins.data[call->index].userData = data;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriPin_GetUserData(const kiriWorld* world, kiriPin pin, uint64_t* data)
{
    KIRI_READS_OF(pin, data);
    *data = found->pins.data[slot->index].userData;
    return KIRI_OK;
}

/* All frames of the piece store the data, and pass it on to new frames. */
kiriResult kiriFrame_SetPieceUserData(kiriWorld* world, kiriFrame frame, uint64_t data)
{
    KIRI_CHANGES(Frame_SetPieceUserData, &frame, &data);
    kiriSheetData* sheet = call->sheet;
    KIRI_ASSERT(call->index < sheet->frames.count);
    int32_t piece = sheet->layout.framePiece.data[call->index];
    KIRI_EACH_INDEX(i, sheet->frames) {
        if (sheet->layout.framePiece.data[i] == piece) {
            sheet->frames.data[i].pieceData = data;
        }
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_GetPieceUserData(const kiriWorld* world, kiriFrame frame, uint64_t* data)
{
    KIRI_READS_OF(frame, data);
    *data = found->frames.data[slot->index].pieceData;
    return KIRI_OK;
}

kiriResult kiriSheet_GetSettings(const kiriWorld* world, kiriSheet sheet, kiriSheetSettings* settings)
{
    KIRI_READS_OF(sheet, settings);
    *settings = found->settings.given;
    settings->cookie = KIRI_COOKIE(kiriSheetSettings);
    return KIRI_OK;
}

kiriResult kiriSheet_SetSettings(kiriWorld* world, kiriSheet sheet, const kiriSheetSettings* settings)
{
    KIRI_CHANGES(Sheet_SetSettings, &sheet, settings);
    KIRI_RETURN(kiriSettings_Change(call->sheet, settings) ? KIRI_OK : KIRI_ERROR_MEMORY);
}

kiriResult kiriWorld_FinishCuts(kiriWorld* world)
{
    KIRI_CHANGES(World_FinishCuts, NULL);
    world->begun += 1; /* vertices change as in a tick */
    kiriResult result = kiriWorld_FinishUpdates(world);
    return KIRI_FAIL(result, result == KIRI_ERROR_LIMIT ? "there are no ids left for new frames" : NULL);
}

/* Wakes the frame for loads that are not zero. */
static void WakeFor(kiriSheetData* sheet, int32_t frame, const float force[3], const float torque[3])
{
    KIRI_ASSERT_HAS(sheet->frames, frame);
    const kiriVec3 none = { 0 };
    if (!kiriVec3_Equal(kiriVec3_Load(force), none) || !kiriVec3_Equal(kiriVec3_Load(torque), none)) {
        kiriSheet_WakeFrame(sheet, frame);
    }
}

/* ---- Loads ------------------------------------------------------------------------------------------------------- */

kiriResult kiriFrame_ApplyForce(kiriWorld* world, kiriFrame frame, const float force[3], const float torque[3])
{
    KIRI_CHANGES(Frame_ApplyForce, &frame, force, torque);
    KIRI_ASSERT(call->index < call->sheet->frames.count);
    kiriFrameData* data = &call->sheet->frames.data[call->index];
    data->force = kiriVec3_Add(data->force, kiriVec3_Load(force));
    data->torque = kiriVec3_Add(data->torque, kiriVec3_Load(torque));
    WakeFor(call->sheet, call->index, force, torque);
    KIRI_RETURN(KIRI_OK);
}

/* Adds a force (N) at a material point of the frame, and a torque (N m). */
static void AddLoad(kiriSheetData* sheet, int32_t frame, kiriVec2 at, kiriVec3 force, kiriVec3 torque)
{
    KIRI_ASSERT_HAS(sheet->frames, frame);
    kiriFrameData* data = &sheet->frames.data[frame];
    kiriVec3 arm = kiriVec3_Sub(kiriFrame_Carry(data, at), data->x);
    data->force = kiriVec3_Add(data->force, force);
    data->torque = kiriVec3_Add(data->torque, kiriVec3_Add(torque, kiriVec3_Cross(arm, force)));
}

kiriResult kiriSheet_ApplyForce(kiriWorld* world, kiriSheet sheet, const float restPoint[2], const float force[3],
                                const float torque[3])
{
    KIRI_CHANGES(Sheet_ApplyForce, &sheet, restPoint, force, torque);
    kiriSheetData* data = call->sheet;
    kiriLatticePoint at;
    int32_t frame = kiriSheet_ToLattice(data, restPoint, &at) ? kiriOwner_At(data, at) : KIRI_NONE;
    KIRI_CHECK_INSIDE(frame != KIRI_NONE, restPoint);
    AddLoad(data, frame, kiriMesh_Local(&data->mesh, at), kiriVec3_Load(force), kiriVec3_Load(torque));
    WakeFor(data, frame, force, torque);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_ApplyLineLoad(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2],
                                   const float forcePerLength[3])
{
    KIRI_CHANGES(Sheet_ApplyLineLoad, &sheet, from, to, forcePerLength);
    kiriSheetData* data = call->sheet;
    kiriLatticePoint ends[2];
    const char* why;
    kiriResult result = kiriCall_FindLine(data, from, to, ends, &why);
    KIRI_REQUIRE(result == KIRI_OK, result, why);
    kiriVec2 a = kiriMesh_Local(&data->mesh, ends[0]), way = kiriVec2_Sub(kiriMesh_Local(&data->mesh, ends[1]), a);
    double length = kiriVec2_Length(way);
    KIRI_EACH(const kiriLineShare, share, data->lineShares) {
        kiriVec2 at = kiriVec2_AddScaled(a, share->firstLoad / share->load, way);
        kiriVec3 force = kiriVec3_Scale(length * share->load, kiriVec3_Load(forcePerLength)), none = { 0 };
        AddLoad(data, share->frame, at, force, none);
        WakeFor(data, share->frame, forcePerLength, forcePerLength);
    }
    KIRI_RETURN(KIRI_OK);
}

/* The resultant acts at the centroid of a region, which is the center of its frame. |A_u x A_v| is the area stretch of
   an affine frame, and 1 for a rigid one. */
kiriResult kiriSheet_ApplyPressure(kiriWorld* world, kiriSheet sheet, float pressure)
{
    KIRI_CHANGES(Sheet_ApplyPressure, &sheet, &pressure);
    KIRI_EACH(kiriFrameData, frame, call->sheet->frames) {
        kiriVec3 across = kiriVec3_Cross(frame->A.u, frame->A.v);
        frame->force = kiriVec3_AddScaled(frame->force, (double)pressure * frame->area, across);
    }
    if (pressure != 0.0f) {
        kiriSheet_WakeAll(call->sheet);
    }
    KIRI_RETURN(KIRI_OK);
}

/* Applies an impulse and a moment to a frame. In a planar sheet, only the components in its plane. */
static void Push(const kiriSheetData* sheet, kiriFrameData* frame, kiriVec3 impulse, kiriVec3 moment)
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 d = mechanics->axes.d;
    kiriMat3 inertia = kiriFrame_Inertia(frame, &sheet->settings.material);
    if (mechanics->planar) {
        impulse = kiriVec3_Across(impulse, d);
        double about = kiriVec3_Dot(d, kiriMat3_Mul(inertia, d));
        frame->spin = kiriVec3_AddScaled(frame->spin, kiriVec3_Dot(moment, d) / about, d);
    } else {
        frame->spin = kiriVec3_Add(frame->spin, kiriMat3_Solve(&inertia, moment));
    }
    frame->velocity = kiriVec3_AddScaled(frame->velocity, 1.0 / frame->mass, impulse);
}

/* Applies the shares of an impulse to the frames of the triangle's corners. If `only` is a frame, applies its shares
   to *frames, a copy of it. */
static void PushFrames(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 off, kiriVec3 impulse, int32_t only,
                       kiriFrameData* frames)
{
    const int32_t* corners = sheet->mesh.triangles.data[place->triangle].vertex;
    KIRI_EACH_CORNER(k) {
        kiriVec2 local = kiriMesh_LocalOf(&sheet->mesh, corners[k]);
        kiriSpan span = sheet->vertexSkin.spans.data[corners[k]];
        KIRI_EACH_IN(i, span) {
            kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
            int32_t f = weight.frame;
            if (only == KIRI_NONE || only == f) {
                kiriFrameData* frame = only == KIRI_NONE ? &frames[f] : frames;
                kiriVec3 arm = kiriVec3_Add(kiriVec3_Sub(kiriFrame_Carry(frame, local), frame->x), off);
                kiriVec3 part = kiriVec3_Scale(place->shares[k] * weight.value, impulse);
                Push(sheet, frame, part, kiriVec3_Cross(arm, part));
            }
        }
    }
}

static bool FitsImpulse(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 off, kiriVec3 impulse)
{
    const int32_t* corners = sheet->mesh.triangles.data[place->triangle].vertex;
    KIRI_EACH_CORNER(k) {
        kiriSpan span = sheet->vertexSkin.spans.data[corners[k]];
        KIRI_EACH_IN(i, span) {
            int32_t f = sheet->vertexSkin.weights.data[i].frame;
            kiriFrameData pushed = sheet->frames.data[f];
            PushFrames(sheet, place, off, impulse, f, &pushed);
            if (!kiriFrame_FitsFloats(&pushed)) {
                return false;
            }
        }
    }
    return true;
}

/* Fades and bent patches offset the visible point from the blend of the frames. Each share of the impulse acts at this
   offset from its frame's point, so the sum acts at the visible point. */
kiriResult kiriSheet_ApplyImpulse(kiriWorld* world, kiriSheet sheet, const float restPoint[2], const float impulse[3])
{
    KIRI_CHANGES(Sheet_ApplyImpulse, &sheet, restPoint, impulse);
    kiriSheetData* data = call->sheet;
    kiriLatticePoint at;
    kiriPointPlace place;
    KIRI_CHECK_INSIDE(kiriSheet_ToLattice(data, restPoint, &at) && kiriPoint_Find(data, at, &place), restPoint);
    kiriVec3 off = kiriVec3_Sub(kiriPoint_Position(data, &place), kiriPoint_Blend(data, &place).x);
    KIRI_CHECK(FitsImpulse(data, &place, off, kiriVec3_Load(impulse)), "floats cannot hold what comes of it");
    PushFrames(data, &place, off, kiriVec3_Load(impulse), KIRI_NONE, data->frames.data);
    if (impulse[0] != 0.0f || impulse[1] != 0.0f || impulse[2] != 0.0f) {
        int32_t vertex = data->mesh.triangles.data[place.triangle].vertex[0];
        kiriSheet_WakePiece(data, kiriPiece_OfVertex(data, vertex));
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_SetWind(kiriWorld* world, kiriSheet sheet, const kiriWind* wind)
{
    KIRI_CHANGES(Sheet_SetWind, &sheet, wind);
    kiriSheetData* data = call->sheet;
    const kiriAir air = { kiriVec3_Load(wind->velocity), wind->density, wind->drag, wind->lift };
    const kiriAir* was = &data->settings.air;
    if (!kiriVec3_Equal(air.velocity, was->velocity) || air.density != was->density || air.drag != was->drag ||
        air.lift != was->lift) {
        data->settings.air = air;
        kiriSheet_WakeAll(data);
    }
    KIRI_RETURN(KIRI_OK);
}
