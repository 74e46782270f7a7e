/* A cut that takes effect changes how the sheet is divided, and not how it moves. */
#include "defaults.h"
#include "probe.h"

#include "motion/kiri_solver.h"
#include "sheet/kiri_update.h"
#include "sheet/kiri_seen.h"

#include <stdio.h>
#include <stdlib.h>

static void Probe_Start(Probe* probe)
{
    kiriWorldDef def = Probe_Def(probe, 1.0);
    OK(kiriCreateWorld(&def, &probe->host.world));
}

static kiriSheetData* DataOf(const Probe* probe)
{
    return probe->host.world->sheets.data[0];
}

/* All of it turns about its centre and flies; beside that each frame moves at random, by up to `noise`. */
static void Spin(Probe* probe, kiriVec3 velocity, kiriVec3 spin, double noise, uint32_t* seed)
{
    kiriSheetData* sheet = DataOf(probe);
    kiriTotals totals = Host_Totals(&probe->host, probe->sheet);
    kiriVec3 center = { totals.center[0], totals.center[1], totals.center[2] };
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        kiriFrameData* frame = &sheet->frames.data[f];
        double r[6];
        for (int k = 0; k < 6; ++k) {
            r[k] = noise * RandomBetween(seed, -1.0, 1.0);
        }
        kiriVec3 turning = kiriVec3_Cross(spin, kiriVec3_Sub(frame->x, center));
        frame->velocity = kiriVec3_Add(kiriVec3_Add(velocity, turning), kiriVec3_Make(r[0], r[1], r[2]));
        frame->spin = kiriVec3_Add(spin, kiriVec3_Make(r[3], r[4], r[5]));
    }
}

/* A circle comes off, point by point. */
static void Circle(float way[][2], int32_t count, double u, double v, double radius)
{
    for (int32_t i = 0; i < count; ++i) {
        double angle = 6.5 * i / (count - 1);
        way[i][0] = (float)(u + radius * cos(angle));
        way[i][1] = (float)(v + radius * sin(angle));
    }
}

typedef struct Case {
    int32_t model, planar, grid, frames;
    double noise, speed;
} Case;

static kiriVec3 RandomSpin(const Case* c, uint32_t* seed)
{
    double r[3];
    for (int k = 0; k < 3; ++k) {
        r[k] = c->speed * RandomBetween(seed, -1.0, 1.0);
    }
    return kiriVec3_Make(c->planar ? 0.0 : r[0], c->planar ? 0.0 : r[1], r[2]);
}

/* A circle, or a scribble that leaves the sheet at times; returns how many points it has. */
static int32_t RandomWay(float way[24][2], bool isCircle, uint32_t* seed)
{
    double u = RandomBetween(seed, 0.1, 0.9), v = RandomBetween(seed, 0.1, 0.9);
    Circle(way, 24, u, v, RandomBetween(seed, 0.05, 0.3));
    for (int32_t i = 0; !isCircle && i < 24; ++i) {
        way[i][0] = (float)RandomBetween(seed, -0.1, 1.1);
        way[i][1] = (float)RandomBetween(seed, -0.1, 1.1);
    }
    return isCircle ? 24 : 5;
}

/* Random cuts while it flies. */
static void FlyAndCut(Probe* probe, const Case* c, void record(Probe* probe), uint32_t seed)
{
    kiriSheetDef def = DefaultSheet();
    def.model = c->model;
    def.planar = c->planar;
    def.gridResolution = c->grid;
    def.frameCount = c->frames;
    def.maxFrames = c->frames + 12;
    Probe_Start(probe);
    probe->sheet = Host_AddRectangle(&probe->host, &def, 1.0f, 1.0f, 16, 16);
    probe->record = record;
    kiriVec3 spin = RandomSpin(c, &seed);
    Spin(probe, kiriVec3_Make(1.0, -2.0, 0.0), spin, c->planar ? 0.0 : c->noise, &seed);
    for (int32_t k = 0; k < 5; ++k) {
        float way[24][2];
        int32_t count = RandomWay(way, k % 2 == 0, &seed);
        kiriCut cut = 0;
        OK(kiriBeginCut(probe->host.world, probe->sheet, way[0], &cut));
        for (int32_t i = 1; i < count; ++i) {
            OK(kiriCut_Extend(probe->host.world, cut, way[i], 1));
            OK(kiriWorld_Tick(probe->host.world, 1.0f / 240.0f, 1));
        }
        OK(kiriCut_End(probe->host.world, cut));
    }
}

/* ---- Owners ---- */

typedef struct Purse {
    int32_t left;
} Purse;

/* ---- Pieces ---- */

enum { MOST_FRAMES = 64 };

/* ---- Momentum and energy ---- */

static int32_t limited; /* commits in which angular momentum gave way to energy */

/* Do the frames of the piece move as one rigid body? */
static bool IsOneBody(const kiriSheetData* sheet, int32_t piece)
{
    const kiriFrameData* first = NULL;
    bool same = true;
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        const kiriFrameData* frame = &sheet->frames.data[f];
        if (sheet->layout.framePiece.data[f] == piece) {
            first = first == NULL ? frame : first;
            kiriVec3 round = kiriVec3_Cross(first->spin, kiriVec3_Sub(frame->x, first->x));
            kiriVec3 velocity = kiriVec3_Add(first->velocity, round);
            same = same && kiriVec3_Length(kiriVec3_Sub(frame->spin, first->spin)) < 1e-6 &&
                   kiriVec3_Length(kiriVec3_Sub(frame->velocity, velocity)) < 1e-6;
        }
    }
    return same;
}

/* Where a piece does nothing but turn, and gets more compact, its energy or its angular momentum must give way. */
static void CheckTurned(Probe* probe)
{
    const kiriSheetData* sheet = DataOf(probe);
    bool any = false;
    if (probe->turned > 1e-9) {
        for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
            any = any || IsOneBody(sheet, p);
        }
        assert_true(any);
        assert_true(probe->turned < 1e-3);
        ++limited;
    }
}

TEST(MomentumIsKept)
{
    double momentum = 0.0, energy = -1.0;
    int32_t commits = 0;
    limited = 0;
    for (int32_t number = 0; number < RUNS(36); ++number) {
        Probe probe;
        uint32_t seed = 77u + (uint32_t)number;
        Case c = { number % 3, number % 4 == 3, 8 + number, 1, number % 2 == 0 ? 1.0 : 0.0, 0.0 };
        c.frames = 1 + (int32_t)(Random(&seed) % 9);
        c.speed = RandomBetween(&seed, 1.0, 20.0);
        FlyAndCut(&probe, &c, CheckTurned, seed);
        assert_true(Host_Counts(&probe.host, probe.sheet).pieces > 3);
        momentum = fmax(momentum, probe.momentum);
        energy = fmax(energy, probe.energy);
        commits += probe.commits;
        Host_Stop(&probe.host);
    }
    printf("%d commits: momentum jumps by up to %.1e, energy rises by up to %.1e; %d commits limited\n", commits,
           momentum, energy, limited);
    assert_true(commits > RUNS(2000) && limited < commits / 10);
    assert_true(momentum < 1e-9 && energy < 1e-9);
}

/* ---- A rigid motion ---- */

static const kiriVec3 prediction = { 1.0, -2.0, 0.5 }, turn = { 3.0, -1.0, 7.0 };

/* Before the sheet has moved, the point at rest at (u, v) is at (u, v, 0), and moves so. */
static void CheckRigid(Probe* probe)
{
    const kiriSheetData* sheet = DataOf(probe);
    kiriVec3 middle = { 0.5, 0.5, 0.0 };
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        const kiriFrameData* frame = &sheet->frames.data[f];
        kiriVec3 at = { frame->center.x, frame->center.y, 0.0 };
        kiriVec3 velocity = kiriVec3_Add(prediction, kiriVec3_Cross(turn, kiriVec3_Sub(at, middle)));
        assert_true(kiriVec3_Length(kiriVec3_Sub(frame->x, at)) < 1e-12);
        assert_true(kiriVec3_Length(kiriVec3_Sub(frame->velocity, velocity)) < 1e-10);
        assert_true(kiriVec3_Length(kiriVec3_Sub(frame->spin, turn)) < 1e-7);
        assert_true(fabs(frame->A.u.x - 1.0) < 1e-9 && fabs(frame->A.v.y - 1.0) < 1e-9);
    }
}

TEST(RigidMotionGoesOn)
{
    for (int32_t model = KIRI_MODEL_LINKS; model <= KIRI_MODEL_POINTS; ++model) {
        Probe probe;
        uint32_t seed = 1;
        float way[40][2];
        kiriSheetDef def = DefaultSheet();
        def.model = model;
        def.frameCount = 9;
        Probe_Start(&probe);
        probe.sheet = Host_AddRectangle(&probe.host, &def, 1.0f, 1.0f, 20, 20);
        probe.record = CheckRigid;
        Spin(&probe, prediction, turn, 0.0, &seed);
        Circle(way, 40, 0.45, 0.4, 0.22);
        Host_Cut(&probe.host, probe.sheet, way[0], 40);
        OK(kiriWorld_Tick(probe.host.world, 1.0f / 60.0f, 1));
        kiriProfile profile = World_Profile(probe.host.world);
        assert_int_equal(probe.commits, 1);
        assert_true(Host_Counts(&probe.host, probe.sheet).pieces >= 2);
        assert_true(profile.largestJump < 1e-9);
        assert_int_equal(DataOf(&probe)->seen.fades.fading.count, 0);
        Host_Stop(&probe.host);
    }
}

/* Far from the cut nothing happens, to the last bit. */
TEST(FarFramesKeepTheirState)
{
    static const float way[6] = { -0.1f, 0.1f, 0.1f, 0.13f, 0.15f, -0.1f };
    Probe probe;
    kiriFrameData before[32];
    uint32_t seed = 5;
    int32_t same = 0, count;
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 32;
    Probe_Start(&probe);
    probe.sheet = Host_AddRectangle(&probe.host, &def, 1.0f, 1.0f, 20, 20);
    Spin(&probe, prediction, turn, 1.0, &seed);
    count = DataOf(&probe)->frames.count;
    memcpy(before, DataOf(&probe)->frames.data, sizeof(before));
    Host_Cut(&probe.host, probe.sheet, way, 3);
    kiriSheetData* sheet = DataOf(&probe);
    kiriQuotas all = kiriQuotas_Unlimited();
    kiriPipeline_Start(sheet, 0);
    assert_int_equal(kiriPipeline_Run(sheet, &all, NULL), KIRI_DONE);
    kiriStage_CommitMesh(sheet);
    kiriStage_Commit(sheet);
    for (int32_t f = 0; f < count; ++f) {
        const kiriFrameData *a = &before[f], *b = &sheet->frames.data[f];
        if (a->mass == b->mass && a->inertia[0] == b->inertia[0] && a->inertia[2] == b->inertia[2]) {
            assert_memory_equal(&a->x, &b->x, sizeof(a->x));
            assert_memory_equal(&a->A, &b->A, sizeof(a->A));
            assert_memory_equal(&a->velocity, &b->velocity, sizeof(a->velocity));
            assert_memory_equal(&a->spin, &b->spin, sizeof(a->spin));
            ++same;
        }
    }
    assert_true(same > count / 2 && same < count);
    kiriPipeline_Finish(sheet);
    kiriView_TakeJump(sheet);
    Host_Destroy(&probe.host); /* the new frames have no ids: no world made them */
}

/* ---- What is seen ---- */

typedef struct Seen {
    Probe probe;
    kiriVec3 at[4000]; /* after the last tick */
    double jump, longest, pointJump;
    int32_t pointCount; /* after the last tick */
} Seen;

/* Right after the commit, each sample by its weights and frames, and with what fades. */
static void CheckSeen(Probe* probe)
{
    Seen* seen = (Seen*)probe;
    const kiriSheetData* sheet = DataOf(probe);
    const kiriMeshData* mesh = &sheet->mesh;
    seen->jump = fmax(seen->jump, Probe_SeenJump(sheet, seen->at));
    for (int32_t k = 0; k < sheet->seen.fades.fading.count; ++k) {
        seen->longest = fmax(seen->longest, kiriVec3_Length(sheet->seen.fades.fading.data[k].offset));
    }
    for (int32_t i = 0; i < seen->pointCount; ++i) {
        kiriVec2 local = kiriMesh_Local(mesh, sheet->points.data[i].at);
        kiriVec3 x =
            kiriVec3_Add(kiriSkin_Position(&sheet->pointSkin, i, sheet->frames.data, local),
                         Probe_OffsetOf(&sheet->seen.pointFades, i));
        kiriVec3 was = kiriVec3_Load(&sheet->seen.pointPositions.data[3 * i]); /* since the last tick */
        seen->pointJump = fmax(seen->pointJump, kiriVec3_Length(kiriVec3_Sub(x, was)));
    }
}

/* A cloth that swings is cut, point by point. */
static void CutWhatSwings(Seen* seen, const kiriSheetDef* def)
{
    Probe* probe = &seen->probe;
    uint32_t seed = 9;
    float way[30][2];
    Probe_Start(probe);
    probe->sheet = Host_AddRectangle(&probe->host, (kiriSheetDef*)def, 1.0f, 1.0f, 16, 16);
    probe->record = CheckSeen;
    seen->jump = seen->longest = seen->pointJump = 0.0;
    Spin(probe, prediction, turn, 2.0, &seed);
    Circle(way, 30, 0.5, 0.45, 0.3);
    kiriCut cut = World_BeginCut(probe->host.world, probe->sheet, way[0]);
    for (int32_t tick = 0; tick < 40; ++tick) {
        const kiriSurface* surface = &DataOf(probe)->seen.surface;
        assert_true(surface->vertexCount <= 3000);
        seen->pointCount = DataOf(probe)->points.count;
        Probe_RememberSeen(surface, seen->at);
        if (tick >= 10) {
            OK(kiriCut_Extend(probe->host.world, cut, way[tick - 10], 1));
        }
        OK(kiriWorld_Tick(probe->host.world, 1.0f / 60.0f, 2));
    }
    OK(kiriCut_End(probe->host.world, cut));
    assert_true(probe->commits > 20);
}

TEST(NothingSeenJumps)
{
    FREED(Seen, seen) = malloc(sizeof(Seen));
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 8;
    def.collisionPoints = 40;
    CutWhatSwings(seen, &def);
    printf("with fades: jumps of %.1e m, offsets of up to %.1e m\n", seen->jump, seen->longest);
    assert_true(seen->jump < 2e-6 && seen->longest > 1e-3);
    assert_true(seen->pointCount >= 40 && seen->pointJump < 1e-6);
    Host_Stop(&seen->probe.host);

    def.fadeTime = 0.0f;
    CutWhatSwings(seen, &def);
    double fitted = seen->jump;
    assert_true(fitted > 1e-3 && seen->pointJump > 1e-3 && seen->longest == 0.0);
    Host_Stop(&seen->probe.host);

    def.fadeTime = 0.2f;
    def.paper.popping = 1;
    CutWhatSwings(seen, &def);
    printf("without: %.1e m; as in the paper: %.1e m, momentum by %.1e\n", fitted, seen->jump, seen->probe.momentum);
    assert_true(seen->longest == 0.0 && seen->probe.momentum > 1e-4); /* the probe sees what it should */
    Host_Stop(&seen->probe.host);
}

/* A commit in the first tick, and what fades after it. */
static void StartFading(Host* host, kiriSheetDef* def, kiriSheet* sheet)
{
    Host_Start(host);
    World_StopGravity(host->world);
    *sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, 16, 16);
    kiriSheetData* data = host->world->sheets.data[0];
    for (int32_t f = 0; f < data->frames.count; ++f) {
        data->frames.data[f].x.z += 0.01 * (f % 3); /* bumps that are seen */
    }
    OK(kiriWorld_Tick(host->world, 1e-6f, 1));
    Host_Cut(host, *sheet, (float[]){ -0.1f, 0.3f, 0.62f, 0.57f }, 2);
    OK(kiriWorld_Tick(host->world, 1e-6f, 1));
    assert_true(data->seen.fades.fading.count > 0);
}

static double LongestFade(const kiriFades* fades)
{
    double longest = 0.0;
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        longest = fmax(longest, kiriVec3_Length(fades->fading.data[k].offset));
    }
    return longest;
}

TEST(FadesEnd)
{
    HOST(host);
    kiriSheet sheet;
    kiriSheetDef def = DefaultSheet();
    StartFading(&host, &def, &sheet);
    kiriFades* fades = &host.world->sheets.data[0]->seen.fades;
    double length = 1e30;
    int64_t calls = host.calls, live = host.live;
    for (int32_t tick = 0; tick < 12; ++tick) {
        double longest = LongestFade(fades);
        assert_true(longest > 0.0 && longest < length);
        length = longest;
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
    }
    OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
    assert_int_equal(fades->fading.count, 0);
    assert_true(host.calls == calls && host.live < live); /* nothing allocated, and the room given back */
}

/* A sheet that lies still is not written again, until it moves or is put elsewhere, by however much. */
TEST(StillSheetsAreNotWritten)
{
    kiriSheetDef def = DefaultSheet();
    def.sleepSpeed = 0.0f;
    START_HOST(host);
    World_StopGravity(host.world);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
    const kiriSurface* surface = &host.world->sheets.data[0]->seen.surface;
    int64_t pose = surface->pose;
    OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
    assert_true(surface->pose == pose);
    kiriMesh mesh = World_Mesh(host.world, sheet);
    float x = mesh.positions[0];
    OK(kiriSheet_Transform(host.world, sheet, worldAxes, (float[]){ 2.0f, 0.0f, 0.0f }));
    OK(kiriSheet_GetMesh(host.world, sheet, &mesh));
    assert_true(mesh.positions[0] == x + 2.0f && surface->pose > pose);
    OK(kiriSheet_SetVelocity(host.world, sheet, (float[]){ 0.0f, 0.0f, 1.0f }, noVector));
    pose = surface->pose;
    OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
    assert_true(surface->pose > pose);
}

TEST(NoSleepBeforeTheEnd)
{
    HOST(host);
    kiriSheet sheet;
    int32_t awake = 1, ticks = 0;
    kiriSheetDef def = DefaultSheet();
    def.sleepSpeed = 1000.0f; /* calm, whatever it does */
    def.fadeTime = 2.0f;
    StartFading(&host, &def, &sheet);
    for (; awake; ++ticks) {
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
        OK(kiriSheet_IsAwake(host.world, sheet, &awake));
        assert_true(awake || host.world->sheets.data[0]->seen.fades.fading.count == 0);
    }
    assert_in_range(ticks, 119, 123);
}

/* A bent sheet of stiff paper, pushed together between its pins. */
static kiriSheet BentPaper(Host* host, float poissonsRatio)
{
    Host_Start(host);
    kiriSheetDef def = DefaultSheet();
    def.material = (kiriMaterial){ 2e9f, poissonsRatio, 2e-4f, 800.0f, 3.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.gridResolution = 60;
    def.frameCount = 24;
    def.maxFrames = 60;
    def.sleepSpeed = 0.0f;
    kiriSheet sheet = Host_AddRectangle(host, &def, 0.3f, 0.3f, 30, 30);
    for (int k = 0; k < 4; ++k) {
        float u = k % 2 == 0 ? 0.0f : 0.3f, v = k / 2 == 0 ? 0.0f : 0.1f;
        Host_Pin(host, sheet, u, v, 0.8f * u, v, 0.0f);
    }
    World_Ticks(host->world, 200, 1.0f / 60.0f, 2);
    return sheet;
}

/* Links go on with their strains, and corners see these: what a commit adds is little, and nothing is thrown. */
TEST(BentPaperGainsNoEnergy)
{
    uint32_t seed = 77;
    for (int trial = 0; trial < 4; ++trial) {
        HOST(host);
        kiriSheet sheet = BentPaper(&host, trial % 2 == 0 ? 0.3f : 0.45f);
        for (int cut = 0; cut < 6; ++cut) {
            double angle = RandomBetween(&seed, 0.0, 6.28), x = RandomBetween(&seed, 0.05, 0.25);
            double y = RandomBetween(&seed, 0.1, 0.3);
            const float line[4] = { (float)x, (float)y, (float)(x + 0.12 * cos(angle)),
                                    (float)(y + 0.12 * sin(angle)) };
            OK(kiriWorld_Tick(host.world, 1e-6f, 1));
            double before = Host_Totals(&host, sheet).elasticEnergy;
            Host_Cut(&host, sheet, line, 2);
            OK(kiriWorld_Tick(host.world, 1e-6f, 1));
            assert_true(before > 0.0 && Host_Totals(&host, sheet).elasticEnergy < 1.1 * before);
            World_Ticks(host.world, 20, 1.0f / 60.0f, 2);
        }
    }
}

/* A cut gives frames other poses. Springs go on with their pull, and affine frames with their stretch. */
TEST(SpringsGainNoEnergy)
{
    for (int trial = 0; trial < 24; ++trial) {
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        kiriPin hinge;
        OK(kiriGetMaterial((int32_t[]){ KIRI_MATERIAL_PAPER, KIRI_MATERIAL_FOIL, KIRI_MATERIAL_CARD }[trial % 3], &def.material));
        def.frameCount = 6 + 7 * (trial / 3 % 4), def.model = trial / 12;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.75f, 12, 12);
        if (trial < 12) {
            OK(kiriSheet_HingeLine(host.world, sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 0.0f, 0.75f }, &hinge));
        } else {
            Host_Pin(&host, sheet, 0.9f, 0.1f, 0.9f, 0.1f, 0.0f);
        }
        Host_Pin(&host, sheet, 0.0625f, 0.0625f, 0.0625f, 0.0625f, 0.0f);
        World_Ticks(host.world, 40, 1.0f / 60.0f, 2);
        kiriTotals before = Host_Totals(&host, sheet);
        Host_Cut(&host, sheet, (float[]){ -0.05f, 0.5f, 1.1f, 0.55f }, 2);
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 2));
        assert_true(Host_Totals(&host, sheet).elasticEnergy < 2.0 * (before.elasticEnergy + before.kineticEnergy));
    }
}
