/* How what is seen, and how it moves, jumps when cuts take effect: as the paper has it (new frames take their motion from the
   surface, nothing else happens), with fitted frames, and with the rest faded. */
#include "probe.h"
#include "../samples/scene.h"

#include <stdio.h>

enum { PAPER, FITTED, FADED, WAYS };

typedef struct Jumps {
    double jump, meanJump, fade, momentum, angular, energy;
    int32_t commits;
} Jumps;

static void Choose(Probe* probe, int way)
{
    kiriSheetData* sheet = probe->host.world->sheets.data[0];
    sheet->popping = way == PAPER;
    if (way != FADED) {
        sheet->fades.time = 0.0;
    }
}

static double CellSize(const Probe* probe)
{
    return probe->host.world->sheets.data[0]->grid.side;
}

/* Lengths in cells. */
static Jumps Measure(const SceneType* type, int way)
{
    Probe probe;
    Scene scene;
    kiriWorldDef def = Probe_Def(&probe, type->size);
    const SceneOptions options = { NULL, 0, 0 };
    Jumps jumps = { 0 };
    if (!Scene_Start(&scene, type, &def, &options)) {
        exit(1);
    }
    probe.host.world = scene.world;
    probe.sheet = scene.sheet;
    Choose(&probe, way);
    double cell = CellSize(&probe), sum = 0.0;
    for (int32_t tick = 0; tick < type->ticks; ++tick) {
        kiriProfile profile;
        Scene_Tick(&scene);
        kiriWorld_GetProfile(scene.world, &profile);
        jumps.jump = fmax(jumps.jump, profile.largestJump / cell);
        jumps.fade = fmax(jumps.fade, profile.largestFade / cell);
        sum += profile.commits > 0 ? profile.largestJump / cell : 0.0;
    }
    jumps.commits = probe.commits;
    jumps.meanJump = sum / probe.commits;
    jumps.momentum = probe.momentum;
    jumps.angular = probe.angular;
    jumps.energy = probe.energy;
    Scene_Stop(&scene);
    return jumps;
}

static void Print(const char* scene, int way, const Jumps* jumps)
{
    static const char* const names[WAYS] = { "paper", "fitted", "faded" };
    printf("%-11s %-7s %7d %10.2e %10.2e %10.2e %10.1e %10.1e %+10.1e\n", scene, names[way], jumps->commits,
           way == FADED ? 0.0 : jumps->jump, way == FADED ? 0.0 : jumps->meanJump, way == FADED ? jumps->fade : 0.0,
           jumps->momentum, jumps->angular, jumps->energy);
}

int main(int count, char** arguments)
{
    printf("%-11s %-7s %7s %10s %10s %10s %10s %10s %10s\n", "scene", "way", "commits", "jump/cell", "mean", "a tick",
           "momentum", "angular", "energy");
    for (int32_t i = 0; Scene_GetType(i) != NULL; ++i) {
        const SceneType* type = Scene_GetType(i);
        for (int way = 0; way < WAYS && (count < 2 || strcmp(arguments[1], type->name) == 0); ++way) {
            Jumps jumps = Measure(type, way);
            Print(type->name, way, &jumps);
            fflush(stdout);
        }
    }
    return 0;
}
