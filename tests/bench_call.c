/* What calls cost from C: what a binding adds is measured against this. Calls of getters, and ways to get the vertices
   of a sheet of 10 000 into a buffer of the host's. Through the shared library a call takes about 1 ns more. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { SQUARES = 99, VERTICES = (SQUARES + 1) * (SQUARES + 1), BATCHES = 15, MOST_BYTES = 64 * VERTICES };

typedef struct Stage {
    kiriWorld* world;
    kiriSheet sheet;
    kiriFrame frame;
    kiriPin pin;
    kiriDebugDraw draw;
    int64_t drawn; /* vertices */
    uint8_t* buffer;
} Stage;

typedef struct Row {
    const char* name;
    void (*call)(Stage* stage);
    int32_t calls; /* in a batch */
} Row;

/* ---- Calls ------------------------------------------------------------------------------------------------------- */

static void GetVersion(Stage* stage)
{
    stage->buffer[0] = (uint8_t)kiriGetVersion();
}

static void GetCounts(Stage* stage)
{
    kiriSheet_GetCounts(stage->world, stage->sheet, (kiriCounts*)stage->buffer);
}

static void GetMesh(Stage* stage)
{
    kiriSheet_GetMesh(stage->world, stage->sheet, (kiriMesh*)stage->buffer);
}

static void GetEvents(Stage* stage)
{
    const kiriEvent* events;
    kiriWorld_GetEvents(stage->world, &events, (int32_t*)stage->buffer);
}

static void GetFrame(Stage* stage)
{
    kiriFrame_GetState(stage->world, stage->frame, (kiriFrameState*)stage->buffer);
}

static void GetPoint(Stage* stage)
{
    static const float point[2] = { 0.3f, 0.6f };
    kiriSheet_GetPoint(stage->world, stage->sheet, point, (kiriPointState*)stage->buffer);
}

static void SetTarget(Stage* stage)
{
    static const float target[3] = { 0.0f, 0.0f, 0.0f };
    kiriPin_SetTarget(stage->world, stage->pin, target);
}

static void GetStaleCounts(Stage* stage)
{
    kiriSheet_GetCounts(stage->world, stage->frame, (kiriCounts*)stage->buffer);
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

static void CopyWith(Stage* stage, int32_t stride, bool normals)
{
    kiriSheet_CopyVertices(stage->world, stage->sheet, 0, VERTICES, stage->buffer, stride,
                           normals ? stage->buffer + 12 : NULL, stride);
}

static void CopyPositions(Stage* stage)
{
    CopyWith(stage, 12, false);
}

static void CopyBoth(Stage* stage)
{
    CopyWith(stage, 24, true);
}

/* Position, normal, colour, texture coordinates. */
static void CopyInto36(Stage* stage)
{
    CopyWith(stage, 36, true);
}

static void CopyByMemcpy(Stage* stage)
{
    kiriMesh mesh;
    kiriSheet_GetMesh(stage->world, stage->sheet, &mesh);
    memcpy(stage->buffer, mesh.positions, 12 * VERTICES);
}

static void CopyIndices(Stage* stage)
{
    kiriSheet_CopyIndices16(stage->world, stage->sheet, 0, 2 * SQUARES * SQUARES, (uint16_t*)stage->buffer);
}

static void Count(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    ((Stage*)user)->drawn += count + (vertices->color == 0);
}

static void DrawEdges(Stage* stage)
{
    stage->draw.flags = KIRI_DRAW_EDGES;
    kiriWorld_DebugDraw(stage->world, &stage->draw);
}

static void DrawDefault(Stage* stage)
{
    stage->draw.flags = KIRI_DRAW_ALL & ~(KIRI_DRAW_TRIANGLES | KIRI_DRAW_EDGES);
    kiriWorld_DebugDraw(stage->world, &stage->draw);
}

/* ---- Measuring --------------------------------------------------------------------------------------------------- */

static bool Start(Stage* stage)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    int32_t count;
    kiriSheetDef def = DefaultSheet();
    kiriPinDef pin = DefaultPin();
    kiriDefaultDebugDraw(&stage->draw);
    stage->draw.points = stage->draw.lines = Count;
    stage->draw.user = stage;
    def.frameCount = 25;
    stage->buffer = malloc(MOST_BYTES);
    return stage->buffer != NULL && kiriCreateWorld(&worldDef, &stage->world) == KIRI_OK &&
           kiriCreateRectangle(stage->world, 1.0f, 1.0f, SQUARES, SQUARES, &def, &stage->sheet) == KIRI_OK &&
           kiriCreatePin(stage->world, stage->sheet, &pin, &stage->pin) == KIRI_OK &&
           kiriSheet_GetFrames(stage->world, stage->sheet, &stage->frame, 1, &count) == KIRI_OK &&
           kiriWorld_Tick(stage->world, 1.0f / 60.0f, 2) == KIRI_OK;
}

/* s a call, of each batch. */
static void Measure(Stage* stage, const Row* row, Series* seconds)
{
    for (int batch = 0; batch < BATCHES; batch++) {
        double start = Bench_Clock(NULL);
        for (int32_t i = 0; i < row->calls; i++) {
            row->call(stage);
        }
        Series_Add(seconds, (Bench_Clock(NULL) - start) / row->calls);
    }
}

static bool Print(Stage* stage, const char* name, const char* title, const Row* rows, size_t count, const char* unit,
                  double units)
{
    const char* const columns[] = { "call                           ", unit, "median", NULL };
    Table table;
    if (!Table_Start(&table, name, title, columns)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        SCOPED(Series, seconds, Series_Free);
        Measure(stage, &rows[i], &seconds);
        Table_Text(&table, rows[i].name);
        TABLE_NUMBERS(&table, units * Series_Quantile(&seconds, 0.0), units * Series_Median(&seconds));
    }
    return Table_Stop(&table);
}

int main(void)
{
    static const Row calls[] = {
        { "kiriGetVersion", GetVersion, 200000 },   { "kiriSheet_GetCounts", GetCounts, 200000 },
        { "kiriSheet_GetMesh", GetMesh, 200000 },   { "kiriWorld_GetEvents", GetEvents, 200000 },
        { "kiriFrame_GetState", GetFrame, 100000 }, { "kiriPin_SetTarget", SetTarget, 100000 },
        { "kiriSheet_GetPoint", GetPoint, 10000 },  { "GetCounts of an id of another kind", GetStaleCounts, 10000 },
    };
    static const Row copies[] = {
        { "memcpy of kiriMesh.positions", CopyByMemcpy, 1000 },
        { "CopyVertices: positions, 12", CopyPositions, 1000 },
        { "positions, normals, 24", CopyBoth, 1000 },
        { "positions, normals, 36", CopyInto36, 1000 },
        { "CopyIndices16", CopyIndices, 1000 },
        { "DebugDraw of edges", DrawEdges, 100 },
        { "DebugDraw by its defaults", DrawDefault, 100 },
    };
    Stage stage = { .world = NULL };
    Bench_WeighClock();
    if (!Start(&stage)) {
        fprintf(stderr, "no world\n");
        return 1;
    }
    bool fine = Print(&stage, "call", "Calls: ns, least of 15 batches, and median", calls,
                      sizeof calls / sizeof calls[0], "ns", 1e9) &&
                Print(&stage, "copy", "10 000 vertices, 19 602 triangles: us, least of 15 batches, and median", copies,
                      sizeof copies / sizeof copies[0], "us", 1e6);
    kiriDestroyWorld(stage.world);
    free(stage.buffer);
    return fine ? 0 : 1;
}
