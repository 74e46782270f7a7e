/* Pieces that part at random, under small budgets and without one: what comes of it is the same. */
#include "defaults.h"
#include "look.h"

#include "layout_hash.h"

enum { ROUNDS = 6, MOST_TARGETS = 8, MOST_PIECES = 400 };

/* What a piece is, wherever it is listed and whatever indices it has. */
typedef struct Portrait {
    double area;
    uint64_t rest; /* of the places of its vertices at rest */
    int32_t frames, triangles, points;
} Portrait;

typedef struct Gallery {
    Portrait of[MOST_PIECES];
    int32_t count;
    double area; /* of all */
} Gallery;

/* ---- What is there ---- */

static uint64_t HashRest(const kiriMesh* mesh, const kiriPieceMesh* piece)
{
    uint64_t sum = 0;
    for (int32_t i = 0; i < piece->vertexCount; ++i) {
        sum += Look_Bytes(0, &mesh->restPositions[2 * piece->vertices[i]], 2 * sizeof(float));
    }
    return sum;
}

static int ComparePortraits(const void* left, const void* right)
{
    const Portrait *a = left, *b = right;
    return a->area != b->area ? (a->area > b->area) - (a->area < b->area) : (a->rest > b->rest) - (a->rest < b->rest);
}

/* All pieces of all sheets, the smallest first. */
static Gallery Portray(const Host* host)
{
    Gallery gallery = { .count = 0 };
    for (int32_t s = 0; s < Host_SheetCount(host); ++s) {
        kiriSheet sheet = Host_SheetAt(host, s);
        kiriMesh mesh = Host_Mesh(host, sheet);
        for (int32_t p = 0; p < Host_Counts(host, sheet).pieces; ++p) {
            kiriPieceState state = World_PieceState(host->world, sheet, p);
            kiriPieceMesh piece = World_PieceMesh(host->world, sheet, p);
            assert_in_range(gallery.count, 0, MOST_PIECES - 1);
            gallery.area += state.area;
            gallery.of[gallery.count++] =
                (Portrait){ state.area, HashRest(&mesh, &piece), state.frames, state.triangles, state.collisionPoints };
        }
    }
    qsort(gallery.of, (size_t)gallery.count, sizeof(Portrait), ComparePortraits);
    return gallery;
}

static void CompareGalleries(const Gallery* a, const Gallery* b)
{
    assert_int_equal(a->count, b->count);
    for (int32_t i = 0; i < a->count; ++i) {
        assert_true(a->of[i].area == b->of[i].area && a->of[i].rest == b->of[i].rest);
        assert_int_equal(a->of[i].frames, b->of[i].frames);
        assert_int_equal(a->of[i].triangles, b->of[i].triangles);
        assert_int_equal(a->of[i].points, b->of[i].points);
    }
}

/* ---- What is done ---- */

static void TickOnce(Host* host, int32_t samples, kiriResult* result)
{
    *result = Host_Tick(host, 1.0f / 60.0f, 1);
    assert_true(*result >= 0);
    assert_true(samples == 0 || World_Profile(host->world).samplesRefreshed <= samples);
}

/* Until nothing waits. */
static int32_t Settle(Host* host, int32_t samples)
{
    kiriResult result = KIRI_PENDING;
    int32_t ticks = 0;
    while (result == KIRI_PENDING) {
        TickOnce(host, samples, &result);
        assert_in_range(++ticks, 1, 20000);
    }
    return ticks;
}

static kiriSheet AnySheet(const Host* host, uint32_t* seed)
{
    uint32_t draw = Random(seed), other = Random(seed);
    uint32_t count = (uint32_t)Host_SheetCount(host);
    return Host_SheetAt(host, draw % 5 == 0 ? (int32_t)(other % count) : 0);
}

/* Frames of so many pieces of the sheet, each once, and not of all. */
static int32_t ChooseTargets(const Host* host, kiriSheet sheet, uint32_t* seed, kiriFrame* targets)
{
    int32_t pieces = Host_Counts(host, sheet).pieces, first = (int32_t)(Random(seed) % 64);
    int32_t count = (int32_t)(Random(seed) % MOST_TARGETS);
    count = count < pieces ? count : pieces - 1;
    for (int32_t i = 0; i < count; ++i) {
        targets[i] = Host_FrameOf(host, sheet, (first + i) % pieces);
    }
    return count;
}

static double AreaOf(const Host* host, kiriSheet sheet, kiriFrame frame)
{
    int32_t piece = World_PieceOf(host->world, frame);
    return World_PieceState(host->world, sheet, piece).area;
}

/* Parts the targets in calls of one or a few, with ticks between them; returns the area that is destroyed. `waited`
   counts the calls that were not done at once. */
static double Part(Host* host, kiriSheet sheet, const kiriFrame* targets, int32_t count, uint32_t* seed,
                   int32_t* waited, int32_t samples)
{
    double destroyed = 0.0;
    for (int32_t i = 0, many; i < count; i += many) {
        kiriSheet made[MOST_TARGETS];
        kiriResult result;
        many = 1 + (int32_t)(Random(seed) % 3);
        many = many < count - i ? many : count - i;
        if (Random(seed) % 3 == 0) {
            for (int32_t k = i; k < i + many; ++k) {
                destroyed += AreaOf(host, sheet, targets[k]);
            }
            result = kiriWorld_DestroyPieces(host->world, targets + i, many);
        } else {
            result = kiriWorld_DetachPieces(host->world, targets + i, many, made);
        }
        assert_true(result == KIRI_OK || result == KIRI_PENDING);
        *waited += result == KIRI_PENDING;
        Host_Validate(host);
        for (int32_t ticks = (int32_t)(Random(seed) % 3); ticks > 0; --ticks) {
            TickOnce(host, samples, &result);
        }
    }
    return destroyed;
}

/* The area of what is dropped. */
static double Drop(Host* host, kiriSheet sheet, double area)
{
    int32_t dropped;
    double before = Host_Totals(host, sheet).area;
    OK(kiriSheet_DropCrumbs(host->world, sheet, (float)area, &dropped));
    return before - Host_Totals(host, sheet).area;
}

static kiriSheetDef DefOfRun(uint32_t run)
{
    static const float layers[] = { 0.0f, 30.0f };
    kiriSheetDef def = SheetOf(20, 6);
    def.maxFrames = 4096;
    def.collisionPoints = layers[run % 2];
    def.sleepSpeed = run % 3 == 0 ? def.sleepSpeed : 0.0f;
    def.model = run % 5 == 4 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS;
    return def;
}

/* A round: cuts, and when they are done, pieces that part while the next cuts wait. Returns the area that goes. */
static double PlayRound(Host* host, uint32_t* seed, int32_t samples, int32_t* waited)
{
    kiriFrame targets[MOST_TARGETS];
    for (int32_t cuts = 2 + (int32_t)(Random(seed) % 3); cuts > 0; --cuts) {
        Host_CutSomewhere(host, AnySheet(host, seed), seed);
    }
    Settle(host, samples);
    kiriSheet sheet = AnySheet(host, seed);
    double gone = Random(seed) % 3 == 0 ? Drop(host, sheet, 0.004) : 0.0;
    int32_t count = ChooseTargets(host, sheet, seed, targets);
    gone += Part(host, sheet, targets, count, seed, waited, samples);
    Host_CutSomewhere(host, sheet, seed);
    return gone;
}

/* ---- Disturbed while waiting ---- */

enum { SETTINGS, PIN, CLAMP, ANOTHER_GOES, IT_GOES, TURN, REFUSE, SHEET_GOES, DISTURBANCES };

static void Disturb(Host* host, kiriSheet sheet, kiriFrame leaves, kiriFrame other, int disturbance)
{
    static const float quarter[9] = { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f }, shift[3] = { 1, 2, 3 };
    kiriSheetSettings settings;
    kiriPin pin;
    kiriPinDef def = DefaultPin();
    def.restPoint[0] = 0.5f;
    def.restPoint[1] = 0.12f;
    switch (disturbance) {
    case SETTINGS:
        OK(kiriSheet_GetSettings(host->world, sheet, &settings));
        settings.skinning = KIRI_SKINNING_SMOOTH;
        settings.normals = 1;
        settings.maxFrames = 7;
        OK(kiriSheet_SetSettings(host->world, sheet, &settings));
        break;
    case PIN:
        OK(kiriCreatePin(host->world, sheet, &def, &pin));
        break;
    case CLAMP:
        OK(kiriSheet_ClampLine(host->world, sheet, (float[]){ 0.5f, 0.1f }, (float[]){ 0.5f, 0.9f }, &pin));
        break;
    case ANOTHER_GOES:
        OK(kiriFrame_DestroyPiece(host->world, other));
        break;
    case IT_GOES:
        OK(kiriFrame_DestroyPiece(host->world, leaves));
        break;
    case TURN:
        OK(kiriSheet_Transform(host->world, sheet, quarter, shift));
        break;
    default:
        break;
    }
}

/* Three strips, of which one is detached. Under a budget it waits: meanwhile something else happens. */
static void StartDisturbed(Host* host, int disturbance, bool hasBudget)
{
    const kiriBudget budget = { 0, 0, 60, 0 };
    kiriResult result;
    kiriSheet made;
    Host_Start(host);
    World_StopGravity(host->world);
    kiriSheetDef def = DefOfRun(1);
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 70, 70);
    Host_Cut(host, sheet, (float[]){ -0.1f, 0.241f, 1.1f, 0.252f }, 2);
    Host_Cut(host, sheet, (float[]){ -0.1f, 0.603f, 1.1f, 0.622f }, 2);
    Settle(host, 0);
    int32_t leaves = 0;
    kiriPieceState state;
    for (int32_t p = 0; p < 3; ++p) {
        OK(kiriSheet_GetPiece(host->world, sheet, p, &state));
        leaves = state.center[1] < 0.24 ? p : leaves;
    }
    kiriFrame frame = Host_FrameOf(host, sheet, leaves), other = Host_FrameOf(host, sheet, (leaves + 1) % 3);
    if (!hasBudget) {
        Disturb(host, sheet, frame, other, disturbance);
        assert_true(disturbance == IT_GOES || kiriFrame_DetachPiece(host->world, frame, &made) == KIRI_OK);
        return;
    }
    OK(kiriWorld_SetBudget(host->world, &budget));
    assert_int_equal(kiriFrame_DetachPiece(host->world, frame, &made), KIRI_PENDING);
    for (int32_t tick = 0; tick < 20; ++tick) {
        host->failAt = disturbance == REFUSE ? host->calls + tick % 16 : -1;
        result = Host_Tick(host, 1.0f / 60.0f, 1);
        assert_true(result >= 0 || (disturbance == REFUSE && result == KIRI_ERROR_MEMORY));
    }
    host->failAt = -1;
    assert_int_equal(Host_SheetCount(host), 1);
    Disturb(host, sheet, frame, other, disturbance);
}

/* Ticks until a piece of one sheet has left, while another, which comes first, is cut or not. */
static int32_t TicksToLeave(const kiriBudget* budget, bool isOtherCut)
{
    kiriSheet made;
    int32_t ticks = 0;
    START_HOST(host);
    kiriSheetDef def = DefOfRun(1);
    kiriSheet other = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 20, 20);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 20, 20);
    Host_Cut(&host, sheet, (float[]){ -0.1f, 0.241f, 1.1f, 0.252f }, 2);
    Settle(&host, 0);
    OK(kiriWorld_SetBudget(host.world, budget));
    assert_int_equal(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 0), &made), KIRI_PENDING);
    for (kiriResult result = KIRI_PENDING; Host_SheetCount(&host) == 2; ++ticks) {
        float at = 0.1f + 0.01f * (float)(ticks % 80);
        assert_in_range(ticks, 0, 2000);
        if (isOtherCut) {
            Host_Cut(&host, other, (float[]){ at, 0.1f, at + 0.05f, 0.9f }, 2);
        }
        TickOnce(&host, budget->samples, &result);
    }
    return ticks;
}

/* Cuts in another sheet take all of a tick, or what they need, and leave enough. */
TEST(OthersAreCut)
{
    static const kiriBudget budgets[] = { { 0, 0, 20, 0 }, { 40, 100, 20, 0 }, { 40, 400, 100, 0 } };
    for (size_t i = 0; i < sizeof(budgets) / sizeof(*budgets); ++i) {
        int32_t alone = TicksToLeave(&budgets[i], false), beside = TicksToLeave(&budgets[i], true);
        assert_true(alone > 1 && beside >= alone && beside <= 4 * alone + 2);
    }
}

/* The part is what it would be at once. */
TEST(Disturbed)
{
    for (int disturbance = 0; disturbance < DISTURBANCES; ++disturbance) {
        HOST_PAIR(hosts);
        StartDisturbed(&hosts[0], disturbance, true);
        if (disturbance == SHEET_GOES) {
            OK(kiriDestroySheet(hosts[0].world, Host_SheetAt(&hosts[0], 0)));
            Host_Stop(&hosts[0]);
            continue;
        }
        Settle(&hosts[0], 60);
        StartDisturbed(&hosts[1], disturbance, false);
        Settle(&hosts[1], 0);
        assert_int_equal(Host_SheetCount(&hosts[0]), disturbance == IT_GOES ? 1 : 2);
        assert_int_equal(Host_SheetCount(&hosts[1]), Host_SheetCount(&hosts[0]));
        assert_true(Layout_HashAll(hosts[0].world) == Layout_HashAll(hosts[1].world));
        for (int32_t s = 0; s < Host_SheetCount(&hosts[0]); ++s) {
            kiriSheetSettings settings[2];
            int32_t pins[2];
            for (int k = 0; k < 2; ++k) {
                kiriSheet sheet = Host_SheetAt(&hosts[k], s);
                OK(kiriSheet_GetSettings(hosts[k].world, sheet, &settings[k]));
                OK(kiriSheet_GetPins(hosts[k].world, sheet, NULL, 0, &pins[k]));
            }
            assert_int_equal(pins[0], pins[1]);
            assert_int_equal(settings[0].skinning, settings[1].skinning);
            assert_int_equal(settings[0].maxFrames, settings[1].maxFrames);
        }
    }
}

/* ---- Tests ---- */

static void RunAtRandom(uint32_t run, int32_t squares, const kiriBudget* budget, int32_t* waited)
{
    static Gallery galleries[2];
    HOST_PAIR(hosts);
    double gone[2] = { 0.0, 0.0 };
    uint32_t seeds[2] = { 1201u * run, 1201u * run };
    int32_t samples[2] = { budget->samples, 0 }, unlimited = 0;
    for (int k = 0; k < 2; ++k) {
        kiriSheetDef def = DefOfRun(run);
        Host_Start(&hosts[k]);
        hosts[k].every = squares > 60 ? 4 : 0;
        World_StopGravity(hosts[k].world);
        Host_AddRectangle(&hosts[k], &def, 1.0f, 1.0f, squares, squares);
    }
    OK(kiriWorld_SetBudget(hosts[0].world, budget));
    for (int round = 0; round < ROUNDS; ++round) {
        for (int k = 0; k < 2; ++k) {
            gone[k] += PlayRound(&hosts[k], &seeds[k], samples[k], k == 0 ? waited : &unlimited);
            Settle(&hosts[k], samples[k]);
            galleries[k] = Portray(&hosts[k]);
            assert_float_equal(galleries[k].area + gone[k], 1.0, 1e-6);
        }
        CompareGalleries(&galleries[0], &galleries[1]);
        assert_true(Layout_HashAll(hosts[0].world) == Layout_HashAll(hosts[1].world));
    }
    assert_int_equal(unlimited, 0);
}

TEST(SmallAndLargeSheets)
{
    int32_t waited[2] = { 0, 0 };
    for (uint32_t run = 1; run <= 8; ++run) {
        const kiriBudget few = { 60, 300, run % 2 ? 25 : 150, 0 }, many = { 200, 1500, run % 2 ? 150 : 1500, 0 };
        RunAtRandom(run, 14, &few, &waited[0]);
        if (run <= 2) {
            RunAtRandom(run, 70, &many, &waited[1]);
        }
    }
    assert_true(waited[0] > 20 && waited[1] > 5);
}
