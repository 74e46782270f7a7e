/* Promises of the header that need more than one call: weights and pins while work on a cut waits, events that name
   pieces, the state hash, and ids. */
#include "defaults.h"
#include "look.h"
#include "layout_hash.h"

#include "sheet/kiri_update.h"
#include "world/kiri_world.h"

/* ---- Weights and pins while a cut waits ---- */

enum { ZIGZAG = 60 };

/* A blade that goes to and fro over all of the sheet, and out of it. */
static void GiveZigzag(Host* host, kiriSheet sheet)
{
    float way[2 * ZIGZAG];
    for (int i = 0; i < ZIGZAG; ++i) {
        way[2 * i] = i % 2 == 0 ? 0.04f : 0.96f;
        way[2 * i + 1] = 0.05f + 0.9f * (float)i / ZIGZAG;
    }
    way[2 * ZIGZAG - 2] = 1.1f;
    Host_Cut(host, sheet, way, ZIGZAG);
}

/* Returns how many answers there were. */
static int32_t CheckWeights(const Host* host, kiriSheet sheet)
{
    int32_t answers = 0;
    for (int i = 0; i < 400; ++i) {
        const float at[2] = { ((float)(i % 20) + 0.47f) / 20.0f, ((float)(i / 20) + 0.53f) / 20.0f };
        kiriFrame frames[64];
        float weights[64];
        int32_t count;
        kiriResult result = kiriSheet_GetWeights(host->world, sheet, at, frames, weights, NULL, 64, &count);
        if (result != KIRI_ERROR_STATE) {
            double sum = 0.0;
            assert_int_equal(result, KIRI_OK);
            assert_in_range(count, 1, 64);
            for (int32_t k = 0; k < count; ++k) {
                World_FrameState(host->world, frames[k]);
                sum += weights[k];
            }
            assert_float_equal(sum, 1.0, 1e-5);
            ++answers;
        }
    }
    return answers;
}

/* Pins wherever there is material; each gets a frame, and goes again. */
static void CheckPins(Host* host, kiriSheet sheet)
{
    const kiriSheetData* data = host->world->sheets.data[0];
    for (int i = 0; i < 400; ++i) {
        float u = ((float)(i % 20) + 0.47f) / 20.0f, v = ((float)(i / 20) + 0.53f) / 20.0f;
        kiriPin pin = Host_Pin(host, sheet, u, v, 0.0f, 0.0f, 0.0f);
        for (int32_t k = 0; k < data->pins.count; ++k) {
            assert_in_range(data->layout.pinFrame.data[k], 0, data->frames.count - 1);
        }
        OK(kiriDestroyPin(host->world, pin));
    }
}

/* How far the frame that a pin holds takes the pin's point from its target. What is seen there is a blend of frames. */
static double OffTarget(const Host* host, int32_t pin)
{
    const kiriSheetData* sheet = host->world->sheets.data[0];
    const kiriFrameData* frame = &sheet->frames.data[sheet->layout.pinFrame.data[pin]];
    kiriVec3 x = kiriFrame_Carry(frame, kiriMesh_Local(&sheet->mesh, sheet->pins.data[pin].at));
    return kiriVec3_Length(kiriVec3_Sub(x, sheet->pins.data[pin].target));
}

/* Four corners are pinned while work waits at a stage, and hold when it is done. */
TEST(WhileWorkWaits)
{
    for (int32_t stage = KIRI_STAGE_CUT; stage <= KIRI_STAGE_SAMPLES; ++stage) {
        static const kiriBudget tight = { KIRI_LEAST_TRIANGLES, 40, 8, 0 }, none = { 0, 0, 0, 0 };
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.gridResolution = 16;
        def.collisionPoints = 10;
        def.sleepSpeed = 0.0f;
        def.material.detail = 0;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
        assert_int_equal(CheckWeights(&host, sheet), 400);
        GiveZigzag(&host, sheet);
        OK(kiriWorld_SetBudget(host.world, &tight));
        int ticks = 0;
        do {
            assert_int_equal(kiriWorld_Tick(host.world, 1e-6f, 1), KIRI_PENDING);
            assert_true(stage < KIRI_STAGE_SAMPLES || CheckWeights(&host, sheet) == 0 ||
                        Layout_Stage(host.world, Host_SheetAt(&host, 0)) == KIRI_STAGE_CUT);
            if (stage == KIRI_STAGE_SAMPLES && ticks++ % 14 == 0) { /* the others come the same way */
                CheckPins(&host, sheet);
            }
        } while (Layout_Stage(host.world, Host_SheetAt(&host, 0)) != stage);
        for (int corner = 0; corner < 4; ++corner) {
            float u = (float)(corner % 2), v = (float)(corner / 2);
            Host_Pin(&host, sheet, u, v, u, v, 0.0f);
        }
        OK(kiriWorld_SetBudget(host.world, &none));
        World_Ticks(host.world, 60, 1.0f / 60.0f, 1);
        assert_int_equal(CheckWeights(&host, sheet), 400);
        CheckPins(&host, sheet);
        for (int corner = 0; corner < 4; ++corner) {
            assert_true(OffTarget(&host, corner) < 0.002);
        }
    }
}

/* ---- Events ---- */

static void GiveDisc(Host* host, kiriSheet sheet, float u, float v, float radius)
{
    float way[2 * 34];
    for (int i = 0; i < 34; ++i) {
        double angle = 2.0 * 3.14159265358979 * i / 32.0;
        way[2 * i] = u + radius * (float)cos(angle);
        way[2 * i + 1] = v + radius * (float)sin(angle);
    }
    Host_Cut(host, sheet, way, 34);
}

/* The loop that every host writes: the piece of each event gets a sheet, and no call makes the frame of another event
   name something else. */
TEST(LoopOverEvents)
{
    for (int order = 0; order < 6; ++order) {
        static const int orders[6][3] = {
            { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 }
        };
        static const float radii[3] = { 0.05f, 0.08f, 0.11f };
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.frameCount = 9;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
        double area = Host_Totals(&host, sheet).area;
        for (int i = 0; i < 3; ++i) {
            GiveDisc(&host, sheet, 0.2f + 0.3f * (float)i, 0.5f, radii[orders[order][i]]);
        }
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 2));
        const kiriEvent* events;
        int32_t count, off = 0;
        OK(kiriWorld_GetEvents(host.world, &events, &count));
        for (int32_t i = 0; i < count; ++i) {
            if (events[i].type == KIRI_EVENT_PIECE_OFF) {
                assert_int_equal(events[i].sheet, sheet);
                kiriSheet detached = World_Detach(host.world, events[i].frame);
                assert_float_equal(Host_Totals(&host, detached).area, events[i].area, 1e-7);
                area -= events[i].area;
                ++off;
            }
        }
        assert_int_equal(off, 3);
        assert_float_equal(Host_Totals(&host, sheet).area, area, 1e-6);
    }
}

/* ---- The state hash ---- */

/* How far the work has come, and what it has worked on. */
typedef struct Progress {
    int32_t stage, step, taken, vertices;
    int64_t spent;
} Progress;

static Progress ProgressOf(const Host* host)
{
    const kiriSheetData* sheet = host->world->sheets.data[0];
    const kiriUpdate* u = sheet->update;
    Progress p;
    memset(&p, 0, sizeof(p));
    p.stage = u->stage;
    p.vertices = sheet->mesh.vertices.count;
    if (u->stage != KIRI_NONE) {
        p.step = u->step;
        p.taken = u->cut.taken;
        p.spent = u->spent;
    }
    return p;
}

static void StartZigzag(Host* host)
{
    static const float line[6] = { -0.1f, 0.4f, 0.35f, 0.6f, 0.75f, 0.45f };
    static const float loop[10] = { 0.55f, 0.7f, 0.8f, 0.7f, 0.8f, 0.9f, 0.55f, 0.9f, 0.55f, 0.7f };
    Host_Start(host);
    kiriSheet sheet = Host_AddSmall(host, 4);
    Host_Cut(host, sheet, line, 3);
    Host_Cut(host, sheet, loop, 5);
}

/* The same budgets in another order, some of them others, or with a limit that nothing comes near. */
static void MixBudgets(kiriBudget* budgets, int32_t count, uint32_t* seed)
{
    uint32_t how = Random(seed) % 3;
    for (int32_t k = count - 1; k > 0 && how < 2; --k) {
        int32_t other = (int32_t)(Random(seed) % (uint32_t)(k + 1));
        kiriBudget budget = budgets[k];
        budgets[k] = budgets[other];
        budgets[other] = budget;
    }
    kiriBudget* any = &budgets[Random(seed) % (uint32_t)count];
    any->cells += how == 1 ? 1 + (int32_t)(Random(seed) % 9) : 0;
    any->triangles += how == 1 ? 1 + (int32_t)(Random(seed) % 3) : 0;
    any->iterations = how == 2 ? 1000 : 0;
}

enum { MOST_TICKS = 40 };

static void TickUnder(Host* host, const kiriBudget* budgets, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) {
        OK(kiriWorld_SetBudget(host->world, &budgets[k]));
        assert_true(kiriWorld_Tick(host->world, 0.01f, 1) >= 0);
    }
}

/* To the end, and a while on. */
static void GoOnAlike(Host* a, Host* b)
{
    int32_t more = 3;
    while (more > 0) {
        kiriResult result = kiriWorld_Tick(a->world, 0.01f, 1);
        assert_int_equal(kiriWorld_Tick(b->world, 0.01f, 1), result);
        assert_true(Host_Hash(a) == Host_Hash(b) && Look_World(a->world) == Look_World(b->world));
        more -= result == KIRI_OK;
    }
}

/* Two worlds that got other budgets until some tick, and the same from there on. */
FIGURE(HashTellsProgress)
{
    int32_t alike[KIRI_READY] = { 0 }, apart[KIRI_READY] = { 0 };
    for (uint32_t run = 1; run <= 150; ++run) {
        uint32_t seed = 2654435761u * run;
        kiriBudget budgets[MOST_TICKS], next = { KIRI_LEAST_TRIANGLES, 9, 4, 0 };
        int32_t ticks = 1 + (int32_t)(Random(&seed) % 32),
                most = run % 2 == 0 ? 1000 : 5 + (int32_t)(Random(&seed) % 120);
        Host a, b;
        for (int32_t k = 0; k < ticks; ++k) {
            kiriBudget budget = { KIRI_LEAST_TRIANGLES + (int32_t)(Random(&seed) % 3), 5, 3, 0 };
            budget.cells += (int32_t)(Random(&seed) % (uint32_t)most);
            budget.samples += (int32_t)(Random(&seed) % 4);
            budgets[k] = budget;
        }
        StartZigzag(&a);
        StartZigzag(&b);
        TickUnder(&a, budgets, ticks);
        MixBudgets(budgets, ticks, &seed);
        TickUnder(&b, budgets, ticks);
        OK(kiriWorld_SetBudget(a.world, &next));
        OK(kiriWorld_SetBudget(b.world, &next));
        Progress pa = ProgressOf(&a), pb = ProgressOf(&b);
        bool isSame = memcmp(&pa, &pb, sizeof(pa)) == 0;
        if (Host_Hash(&a) == Host_Hash(&b)) {
            assert_true(isSame);
            GoOnAlike(&a, &b);
        }
        if (pa.stage != KIRI_NONE) {
            (Host_Hash(&a) == Host_Hash(&b) ? alike : apart)[pa.stage] += 1;
        }
        Host_Stop(&a);
        Host_Stop(&b);
    }
    for (int32_t stage = KIRI_STAGE_CUT; stage <= KIRI_STAGE_SAMPLES; ++stage) {
        print_message("%s: %d pairs alike, %d apart\n", kiriGetStageName(stage), alike[stage], apart[stage]);
        assert_true(alike[stage] > 0 && apart[stage] > 0);
    }
}

/* ---- Ids ---- */

static int CompareIds(const void* a, const void* b)
{
    uint32_t x = *(const uint32_t*)a, y = *(const uint32_t*)b;
    return x < y ? -1 : x > y;
}

static void CheckUnique(uint32_t* ids, int32_t count)
{
    qsort(ids, (size_t)count, sizeof(*ids), CompareIds);
    for (int32_t i = 0; i < count; ++i) {
        assert_true(ids[i] != 0 && (i == 0 || ids[i] != ids[i - 1]));
    }
}

static kiriSheetDef TinyDef(void)
{
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = 1;
    def.frameCount = def.maxFrames = 1;
    def.framePoints = NULL;
    def.collisionPoints = 0;
    return def;
}

/* Sheets, cuts and frames that come and go, and many more pins: more than a slot has generations. */
TEST(IdsComeOnce)
{
    enum { SHEETS = 600, PINS = 20000 };
    static uint32_t ids[3 * SHEETS + PINS];
    int32_t all = 0;
    START_HOST(host);
    kiriSheetDef def = TinyDef();
    SCOPED_AS(Rectangle, mesh, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 1, 1);
    kiriPinDef pin = DefaultPin();
    kiriSheet sheet;
    for (int i = 0; i < SHEETS; ++i) {
        OK(kiriCreateSheet(host.world, &def, &sheet));
        OK(kiriBeginCut(host.world, sheet, pin.restPoint, &ids[all]));
        World_GetFrames(host.world, sheet, &ids[all + 1], 1);
        ids[all + 2] = sheet;
        all += 3;
        if (i < SHEETS - 1) {
            OK(kiriDestroySheet(host.world, sheet));
            assert_int_equal(kiriSheet_Wake(host.world, sheet), KIRI_ERROR_ID);
        }
    }
    for (int i = 0; i < PINS; ++i) {
        OK(kiriCreatePin(host.world, sheet, &pin, &ids[all]));
        OK(kiriDestroyPin(host.world, ids[all]));
        assert_int_equal(kiriDestroyPin(host.world, ids[all]), KIRI_ERROR_ID);
        ++all;
    }
    CheckUnique(ids, all);
}

/* A pool that has no slot left: as if all that the header allows were in use. */
static kiriPool Exhaust(kiriPool* pool)
{
    kiriPool before = *pool;
    pool->freeSlot = KIRI_NONE;
    pool->freeCount = 0;
    pool->slots.count = pool->slots.capacity = 4194304;
    return before;
}

typedef struct Office {
    Host host;
    kiriSheetDef def;
    kiriSheet sheet, made;
    kiriFrame frame;
    kiriPinDef pin;
} Office;

enum { ADD_SHEET, ADD_FRAMES, DETACH, BEGIN_CUT, SLICE, ADD_PIN, TICK, WAYS };

static kiriResult Ask(Office* office, int way)
{
    static const float blade[12] = { 0.6f, -1.0f, -1.0f, 0.6f, -1.0f, 1.0f, 0.6f, 2.0f, 1.0f, 0.6f, 2.0f, -1.0f };
    kiriWorld* world = office->host.world;
    uint32_t made;
    switch (way) {
    case ADD_SHEET:
    case ADD_FRAMES:
        return kiriCreateSheet(world, &office->def, &office->made);
    case DETACH:
        return kiriFrame_DetachPiece(world, office->frame, &office->made);
    case BEGIN_CUT:
        return kiriBeginCut(world, office->sheet, blade, &made);
    case SLICE:
        return kiriSheet_Slice(world, office->sheet, blade, &made);
    case ADD_PIN:
        return kiriCreatePin(world, office->sheet, &office->pin, &made);
    default:
        return kiriWorld_Tick(world, 0.01f, 1);
    }
}

static kiriPool* PoolOf(kiriWorld* world, int way)
{
    switch (way) {
    case ADD_SHEET:
    case DETACH:
        return &world->sheetIds;
    case BEGIN_CUT:
    case SLICE:
        return &world->cutIds;
    case ADD_PIN:
        return &world->pinIds;
    default:
        return &world->frameIds;
    }
}

/* No id left of a kind: the call says so, and nothing has changed; when there are ids again, it goes through. */
TEST(IdsRunOut)
{
    for (int way = 0; way < WAYS; ++way) {
        Office office;
        memset(&office, 0, sizeof(office));
        Host* host = &office.host;
        Host_Start(host);
        office.def = Host_SmallDef();
        SCOPED_AS(Rectangle, mesh, Rectangle_Free) = Rectangle_Make(&office.def, 1.0f, 1.0f, 3, 3);
        kiriDefaultPinDef(&office.pin);
        OK(kiriCreateSheet(host->world, &office.def, &office.sheet));
        GiveDisc(host, office.sheet, 0.5f, 0.5f, 0.2f);
        OK(kiriWorld_Tick(host->world, 0.01f, 1));
        office.frame = Host_FrameOf(host, office.sheet, 1);
        GiveDisc(host, office.sheet, 0.5f, 0.85f, 0.05f); /* has no frame yet */
        uint64_t hash = Host_Hash(host), look = Look_World(host->world);
        kiriPool* pool = PoolOf(host->world, way);
        kiriPool before = Exhaust(pool);
        for (int again = 0; again < 2; ++again) {
            assert_int_equal(Ask(&office, way), KIRI_ERROR_LIMIT);
            assert_non_null(strstr(kiriWorld_GetLastError(host->world), "KIRI_ERROR_LIMIT"));
            /* A tick keeps the work that it has done on cuts. */
            assert_true(way == TICK || Host_Hash(host) == hash);
        }
        *pool = before;
        assert_true(way == TICK || Look_World(host->world) == look);
        OK(Ask(&office, way));
        OK(kiriWorld_Tick(host->world, 0.01f, 1));
        Host_Stop(host);
    }
}
