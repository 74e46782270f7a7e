/* A cut that takes effect changes how the sheet is divided, and not how it moves. */
#include "probe.h"

#include <stdio.h>

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

static void Begin(kiriCut* cut, Probe* probe, const float at[2])
{
    OK(kiriBeginCut(probe->host.world, probe->sheet, at, cut));
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

/* Random cuts and circles while it flies. */
static void FlyAndCut(Probe* probe, const Case* c, uint32_t seed)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.model = c->model;
    def.planar = c->planar;
    def.gridResolution = c->grid;
    def.frameCount = c->frames;
    def.maxFrames = c->frames + 12;
    Probe_Start(probe);
    probe->sheet = Host_AddRectangle(&probe->host, &def, 1.0f, 1.0f, 16, 16);
    double w = c->speed;
    kiriVec3 spin = { c->planar ? 0.0 : w * RandomBetween(&seed, -1.0, 1.0),
                      c->planar ? 0.0 : w * RandomBetween(&seed, -1.0, 1.0), w * RandomBetween(&seed, -1.0, 1.0) };
    Spin(probe, kiriVec3_Make(1.0, -2.0, 0.0), spin, c->planar ? 0.0 : c->noise, &seed);
    kiriCut cut = 0;
    for (int32_t k = 0; k < 5; ++k) {
        float way[24][2];
        int32_t count = 24;
        Circle(way, count, RandomBetween(&seed, 0.1, 0.9), RandomBetween(&seed, 0.1, 0.9),
               RandomBetween(&seed, 0.05, 0.3));
        for (int32_t i = 0; k % 2 == 1 && i < count; ++i) {
            way[i][0] = (float)RandomBetween(&seed, -0.1, 1.1); /* or a scribble */
            way[i][1] = (float)RandomBetween(&seed, -0.1, 1.1);
            count = 5;
        }
        Begin(&cut, probe, way[0]);
        for (int32_t i = 1; i < count; ++i) {
            OK(kiriCut_Extend(probe->host.world, cut, way[i], 1));
            kiriResult result = kiriWorld_Tick(probe->host.world, 1.0f / 240.0f, 1);
            assert_int_equal(result, KIRI_OK);
        }
        OK(kiriCut_End(probe->host.world, cut));
    }
}

static void TestMomentumIsKept(void** state)
{
    (void)state;
    for (int32_t number = 0; number < 24; ++number) {
        Probe probe;
        uint32_t seed = 77u + (uint32_t)number;
        Case c = { number % 3, number % 4 == 3, 8 + number, 1 + (int32_t)(Random(&seed) % 9),
                   number % 2 == 0 ? 1.0 : 0.0, RandomBetween(&seed, 1.0, 20.0) };
        FlyAndCut(&probe, &c, seed);
        printf("%2d model %d planar %d frames %d speed %.1f: %d commits, %d pieces, momentum %.1e angular %.1e energy %+.1e\n", number, c.model, c.planar, c.frames, c.speed,
               probe.commits, Host_Counts(&probe.host, probe.sheet).pieces, probe.momentum, probe.angular, probe.energy);
        Host_Stop(&probe.host);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(TestMomentumIsKept) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
