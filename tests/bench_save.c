/* Sizes and times of saves and snapshots: of scenes, and of a crowd of sheets where one is cut now and then. */
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
    kiriWorld* other; /* that it is loaded into */
    Bytes save, snapshot;
    Series tick, saving, loading, copying, restoring; /* ms */
    Series savedSize, copiedSize;                     /* KB */
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

typedef kiriResult WriteFn(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);
typedef kiriResult ReadFn(kiriWorld* world, const void* bytes, int64_t size);

/* The room is there before: a game keeps its buffers. */
static void Write(WriteFn* write, const kiriWorld* world, Bytes* bytes, Series* time, Series* size)
{
    if (write(world, NULL, 0, &bytes->size) != KIRI_OK) {
        Fail("no bytes");
    }
    Bytes_Reserve(bytes, bytes->size);
    double start = Bench_Clock(NULL);
    write(world, bytes->data, bytes->capacity, &bytes->size);
    Series_Add(time, Since(start));
    Series_Add(size, 1e-3 * (double)bytes->size);
}

static void Read(ReadFn* read, Sizes* sizes, const kiriWorld* world, const Bytes* bytes, Series* time)
{
    uint64_t is, was;
    double start = Bench_Clock(NULL);
    kiriResult result = read(sizes->other, bytes->data, bytes->size);
    Series_Add(time, Since(start));
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
        Write(kiriWorld_Save, world, &sizes->save, &sizes->saving, &sizes->savedSize);
        Read(kiriWorld_Load, sizes, world, &sizes->save, &sizes->loading);
        Write(kiriWorld_Snapshot, world, &sizes->snapshot, &sizes->copying, &sizes->copiedSize);
        Read(kiriWorld_Restore, sizes, world, &sizes->snapshot, &sizes->restoring);
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
        kiriSheetDef def = DefaultSheet();
        def.position[1] = 2.0f * (float)i;
        def.gridResolution = CROWD_SQUARES;
        fine = Bench_AddSheet(world, &def, CROWD_SQUARES, &sheets[i]);
    }
    for (int32_t tick = 0; fine && tick < TICKS / 3; tick++) {
        const float way[4] = { 0.3f, -0.1f, 0.4f, 0.7f };
        kiriCut cut;
        if (tick % BASE_TICKS == BASE_TICKS / 2) {
            fine = kiriSheet_Cut(world, sheets[tick % CROWD], way, 2, &cut) == KIRI_OK;
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
    Series* numbers[] = { &sizes->tick,       &sizes->savedSize, &sizes->saving,   &sizes->loading,
                          &sizes->copiedSize, &sizes->copying,   &sizes->restoring };
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        Table_Number(table, Series_Median(numbers[k]));
        Series_Free(numbers[k]);
    }
    kiriDestroyWorld(sizes->other);
    free(sizes->save.data);
    free(sizes->snapshot.data);
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
    static const char* const columns[] = { "scene",       "tick ms",     "save KB",    "save ms", "load ms",
                                           "snapshot KB", "snapshot ms", "restore ms", NULL };
    Table table;
    Bench_WeighClock();
    if (!Table_Start(&table, "save", "Saves and snapshots: medians.", columns)) {
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
