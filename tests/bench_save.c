/* What it takes to save a world and to go back. The scenes, and a crowd of sheets of which one is cut now and then. */
#define _POSIX_C_SOURCE 199309L

#include "../samples/scene.h"
#include "bench.h"

enum { TICKS = 360, BASE_TICKS = 60, LOAD_TICKS = 30, CROWD = 100, CROWD_SQUARES = 16 };

/* Bytes of the host. */
typedef struct Bytes {
    uint8_t* data;
    int64_t size, capacity;
} Bytes;

typedef struct Sizes {
    Bytes base;
    kiriWorld* other;        /* that it is loaded into */
    Series tick, save, load; /* ms */
    Series untrusted;        /* ms of a load */
    Series full;             /* KB */
} Sizes;

static void Fail(const char* what)
{
    fprintf(stderr, "bench_save: %s\n", what);
    exit(1);
}

static void Bytes_Reserve(Bytes* bytes, int64_t size)
{
    if (size > bytes->capacity) {
        bytes->capacity = 2 * size;
        bytes->data = realloc(bytes->data, (size_t)bytes->capacity);
        if (bytes->data == NULL) {
            Fail("no memory");
        }
    }
}

static double Since(double start)
{
    return 1e3 * (Bench_Clock(NULL) - start);
}

/* The room is there before: a game keeps its buffers. */
static void SaveBase(Sizes* sizes, const kiriWorld* world)
{
    if (kiriWorld_Save(world, NULL, 0, &sizes->base.size) != KIRI_OK) {
        Fail("no save");
    }
    Bytes_Reserve(&sizes->base, sizes->base.size);
    double start = Bench_Clock(NULL);
    kiriWorld_Save(world, sizes->base.data, sizes->base.capacity, &sizes->base.size);
    Series_Add(&sizes->save, Since(start));
    Series_Add(&sizes->full, 1e-3 * (double)sizes->base.size);
}

/* As bytes of others, and as one's own. */
static kiriResult LoadBase(Sizes* sizes)
{
    double start = Bench_Clock(NULL);
    kiriResult result = kiriWorld_LoadUntrusted(sizes->other, sizes->base.data, sizes->base.size);
    Series_Add(&sizes->untrusted, Since(start));
    start = Bench_Clock(NULL);
    result = result == KIRI_OK ? kiriWorld_Load(sizes->other, sizes->base.data, sizes->base.size) : result;
    Series_Add(&sizes->load, Since(start));
    return result;
}

static void GoBack(Sizes* sizes, const kiriWorld* world)
{
    uint64_t is, was;
    SaveBase(sizes, world);
    kiriResult result = LoadBase(sizes);
    kiriWorld_GetStateHash(world, &is);
    kiriWorld_GetStateHash(sizes->other, &was);
    if (result != KIRI_OK || is != was) {
        Fail("the way back leads elsewhere");
    }
}

static void AfterTick(Sizes* sizes, const kiriWorld* world, int32_t tick, double milliseconds)
{
    Series_Add(&sizes->tick, milliseconds);
    if (tick % LOAD_TICKS == LOAD_TICKS - 1) {
        GoBack(sizes, world);
    }
}

static void PlayScene(Sizes* sizes, const SceneType* type)
{
    static Scene scene;
    const SceneOptions options = { 0 };
    kiriWorldDef def = Bench_WorldDef();
    if (!Scene_Start(&scene, type, &def, &options)) {
        Fail(type->name);
    }
    for (int32_t tick = 0; tick < type->ticks && tick < TICKS; tick++) {
        double start = Bench_Clock(NULL);
        Scene_Tick(&scene);
        AfterTick(sizes, scene.world, tick, Since(start));
    }
    Scene_Stop(&scene);
}

static void PlayCrowd(Sizes* sizes)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    kiriWorld* world = NULL;
    kiriSheet sheets[CROWD];
    bool fine = kiriCreateWorld(&worldDef, &world) == KIRI_OK;
    for (int32_t i = 0; fine && i < CROWD; i++) {
        kiriSheetDef def;
        kiriDefaultSheetDef(&def);
        def.position[1] = 2.0f * (float)i;
        def.gridResolution = CROWD_SQUARES;
        fine = Bench_AddSheet(world, &def, CROWD_SQUARES, &sheets[i]);
    }
    for (int32_t tick = 0; fine && tick < TICKS / 3; tick++) {
        const float way[4] = { 0.3f, -0.1f, 0.4f, 0.7f };
        kiriCut cut;
        if (tick % BASE_TICKS == BASE_TICKS / 2) {
            fine = kiriBeginCut(world, sheets[tick % CROWD], way, &cut) == KIRI_OK &&
                   kiriCut_Extend(world, cut, way + 2, 1) == KIRI_OK && kiriCut_End(world, cut) == KIRI_OK;
        }
        double start = Bench_Clock(NULL);
        fine = fine && kiriWorld_Tick(world, 1.0f / 60.0f, 2) >= 0;
        AfterTick(sizes, world, tick, Since(start));
    }
    kiriDestroyWorld(world);
    if (!fine) {
        Fail("the crowd");
    }
}

static void Print(Table* table, const char* name, Sizes* sizes)
{
    Table_Text(table, name);
    Series* numbers[] = { &sizes->tick, &sizes->full, &sizes->save, &sizes->load, &sizes->untrusted };
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        Table_Number(table, Series_Median(numbers[k]));
        Series_Free(numbers[k]);
    }
    kiriDestroyWorld(sizes->other);
    free(sizes->base.data);
}

/* A world for the way back. */
static Sizes Start(void)
{
    Sizes sizes;
    memset(&sizes, 0, sizeof sizes);
    kiriWorldDef def = Bench_WorldDef();
    if (kiriCreateWorld(&def, &sizes.other) != KIRI_OK) {
        Fail("no world");
    }
    return sizes;
}

/* bench_save NAME: that scene alone, or "crowd". */
int main(int count, char** names)
{
    static const char* const scenes[] = { "spiral", "kirigami", "patchwork", "vortex", "fallingguy", "bunny" };
    static const char* const columns[] = { "scene", "tick ms", "KB", "save ms", "load ms", "untrusted ms", NULL };
    Table table;
    Bench_WeighClock();
    if (!Table_Start(&table, "save", "Saves: medians. untrusted: a load of bytes of others.", columns)) {
        return 1;
    }
    for (size_t i = 0; i <= sizeof scenes / sizeof scenes[0]; i++) {
        const char* name = i < sizeof scenes / sizeof scenes[0] ? scenes[i] : "crowd";
        if (count > 1 && strcmp(names[1], name) != 0) {
            continue;
        }
        Sizes sizes = Start();
        if (strcmp(name, "crowd") == 0) {
            PlayCrowd(&sizes);
        } else {
            PlayScene(&sizes, Scene_FindType(name));
        }
        Print(&table, name, &sizes);
    }
    return Table_Stop(&table) ? 0 : 1;
}
