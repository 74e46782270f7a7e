/* How what is seen, and how it moves, jumps when cuts take effect: as the paper has it (new frames take their motion
   from the surface, nothing else happens), with fitted frames, and with the rest faded. */
#include "probe.h"
#include "../samples/scene.h"

#include <stdio.h>

enum { PAPER, FITTED, FADED, WAYS };

typedef struct Jumps {
    Probe probe; /* first: so the probe's record finds the rest */
    kiriVec3* at;
    int32_t room;
    double cell, jump, sum, fade; /* jumps and ways in cells */
} Jumps;

static kiriSheetData* SeenSheet(const Jumps* jumps)
{
    return jumps->probe.host.world->sheets.data[0];
}

static void Record(Probe* probe)
{
    Jumps* jumps = (Jumps*)probe;
    double jump = Probe_SeenJump(SeenSheet(jumps), jumps->at) / jumps->cell;
    jumps->jump = fmax(jumps->jump, jump);
    jumps->sum += jump;
}

/* Where vertices are; with room for as many as a tick may add. */
static void Remember(Jumps* jumps)
{
    const kiriSurface* surface = &SeenSheet(jumps)->seen.surface;
    if (jumps->room < surface->vertexCount + 10000) {
        jumps->room = 2 * surface->vertexCount + 20000;
        free(jumps->at);
        jumps->at = malloc(sizeof(kiriVec3) * (size_t)jumps->room);
    }
    Probe_RememberSeen(surface, jumps->at);
}

static void Measure(Jumps* jumps, const SceneType* type, int way)
{
    static Scene scene;
    memset(jumps, 0, sizeof(*jumps));
    kiriWorldDef def = Probe_Def(&jumps->probe, type->size);
    const SceneOptions options = { .asPaper = true, .popping = way == PAPER, .unfaded = way != FADED };
    if (!Scene_Start(&scene, type, &def, &options)) {
        exit(1);
    }
    jumps->probe.host.world = scene.world;
    jumps->probe.sheet = scene.sheet;
    jumps->probe.record = Record;
    jumps->cell = SeenSheet(jumps)->grid.side;
    for (int32_t tick = 0; tick < type->ticks; ++tick) {
        kiriProfile profile;
        Remember(jumps);
        Scene_Tick(&scene);
        kiriWorld_GetProfile(scene.world, &profile);
        jumps->fade = fmax(jumps->fade, profile.largestFade / jumps->cell);
    }
    Scene_Stop(&scene);
    free(jumps->at);
}

static void Print(const char* scene, int way, const Jumps* jumps)
{
    static const char* const names[WAYS] = { "paper", "fitted", "faded" };
    const Probe* probe = &jumps->probe;
    printf("%-11s %-7s %7d %10.2e %10.2e %10.2e %10.1e %10.1e %+10.1e\n", scene, names[way], probe->commits,
           jumps->jump, jumps->sum / probe->commits, jumps->fade, probe->momentum, probe->angular, probe->energy);
}

/* The argument is a scene; none: all. */
int main(int count, char** arguments)
{
    static Jumps jumps;
    printf("%-11s %-7s %7s %10s %10s %10s %10s %10s %10s\n", "scene", "way", "commits", "jump/cell", "mean",
           "fade/tick", "momentum", "angular", "energy");
    for (int32_t i = 0; Scene_GetType(i) != NULL; ++i) {
        const SceneType* type = Scene_GetType(i);
        for (int way = 0; way < WAYS && (count < 2 || strcmp(arguments[1], type->name) == 0); ++way) {
            Measure(&jumps, type, way);
            Print(type->name, way, &jumps);
        }
    }
    return 0;
}
