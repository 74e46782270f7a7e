/* Debug draw: as many points, lines and triangles as there are things, where they are. */
#include "host.h"

enum { MOST_VERTICES = 200000 };

typedef struct Drawn {
    kiriDrawVertex* vertices;
    int32_t count, most; /* most: of a batch */
} Drawn;

typedef struct Canvas {
    kiriDebugDraw draw;
    Drawn points, lines, triangles;
} Canvas;

static void Take(Drawn* drawn, const kiriDrawVertex* vertices, int32_t count)
{
    assert_true(count > 0 && drawn->count + count <= MOST_VERTICES);
    memcpy(drawn->vertices + drawn->count, vertices, (size_t)count * sizeof(kiriDrawVertex));
    drawn->count += count;
    drawn->most = count > drawn->most ? count : drawn->most;
}

static void TakePoints(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    Take(&((Canvas*)user)->points, vertices, count);
}

static void TakeLines(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    assert_int_equal(count % 2, 0);
    Take(&((Canvas*)user)->lines, vertices, count);
}

static void TakeTriangles(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    assert_int_equal(count % 3, 0);
    Take(&((Canvas*)user)->triangles, vertices, count);
}

static void Canvas_Create(Canvas* canvas)
{
    memset(canvas, 0, sizeof(*canvas));
    kiriDefaultDebugDraw(&canvas->draw);
    canvas->draw.points = TakePoints;
    canvas->draw.lines = TakeLines;
    canvas->draw.triangles = TakeTriangles;
    canvas->draw.user = canvas;
    Drawn* all[3] = { &canvas->points, &canvas->lines, &canvas->triangles };
    for (int i = 0; i < 3; ++i) {
        all[i]->vertices = malloc(MOST_VERTICES * sizeof(kiriDrawVertex));
        assert_non_null(all[i]->vertices);
    }
}

static void Canvas_Free(Canvas* canvas)
{
    free(canvas->points.vertices);
    free(canvas->lines.vertices);
    free(canvas->triangles.vertices);
}

/* Draws what the flags say; the world stays as it is, and takes no memory. */
static void Draw(Canvas* canvas, const Host* host, uint32_t flags)
{
    int64_t calls = host->calls;
    uint64_t hash = Host_Hash(host);
    canvas->points.count = canvas->lines.count = canvas->triangles.count = 0;
    canvas->draw.flags = flags;
    OK(kiriWorld_DebugDraw(host->world, &canvas->draw));
    assert_int_equal(host->calls, calls);
    assert_true(Host_Hash(host) == hash);
}

static void CheckCounts(const Canvas* canvas, int32_t points, int32_t lines, int32_t triangles)
{
    assert_int_equal(canvas->points.count, points);
    assert_int_equal(canvas->lines.count, 2 * lines);
    assert_int_equal(canvas->triangles.count, 3 * triangles);
}

/* ---- A scene ----------------------------------------------------------------------------------------------------- */

typedef struct Stage {
    Host host;
    Canvas canvas;
    kiriSheet sheet;
    kiriObstacle ball;
} Stage;

/* A sheet that lies on a ball, held by a pin and along a line; a corner of it is cut off. */
static void Begin(Stage* stage)
{
    Host_Start(&stage->host);
    Canvas_Create(&stage->canvas);
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 9;
    def.collisionPoints = 7;
    stage->sheet = Host_AddRectangle(&stage->host, &def, 1.0f, 1.0f, 24, 24);

    kiriObstacleDef ball = ObstacleOf(KIRI_OBSTACLE_SPHERE);
    ball.radius = 0.25f;
    ball.position[0] = ball.position[1] = 0.5f;
    ball.position[2] = -0.27f;
    OK(kiriCreateObstacle(stage->host.world, &ball, &stage->ball));

    kiriPin made = Host_Pin(&stage->host, stage->sheet, 0.0f, 0.0f, 0.0f, 0.0f, 0.01f);
    OK(kiriSheet_HingeLine(stage->host.world, stage->sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 1.0f, 0.0f }, &made));
    Host_Cut(&stage->host, stage->sheet, (float[]){ 0.7f, 1.1f, 0.72f, 0.71f, 1.1f, 0.7f }, 3);
    Host_Ticks(&stage->host, 30, 1.0f / 60.0f, 2);
}

static void End(Stage* stage)
{
    Canvas_Free(&stage->canvas);
    Host_Stop(&stage->host);
}

/* Edges of the mesh that is seen: all of its own, and those of one triangle. */
static void CountEdges(const kiriMesh* mesh, int32_t* inner, int32_t* border)
{
    uint8_t* sides = calloc((size_t)mesh->vertexCount * (size_t)mesh->vertexCount, 1);
    assert_non_null(sides);
    *inner = *border = 0;
    for (int32_t i = 0; i < 3 * mesh->triangleCount; ++i) {
        int32_t a = mesh->indices[i], b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
        ++sides[(a < b ? a : b) * mesh->vertexCount + (a < b ? b : a)];
    }
    for (int32_t i = 0; i < mesh->vertexCount * mesh->vertexCount; ++i) {
        *border += sides[i] == 1;
        *inner += sides[i] == 2;
        assert_true(sides[i] <= 2);
    }
    free(sides);
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

TEST(Counts)
{
    Stage stage;
    Begin(&stage);
    Canvas* canvas = &stage.canvas;
    kiriCounts counts = Host_Counts(&stage.host, stage.sheet);
    kiriMesh mesh = Host_Mesh(&stage.host, stage.sheet);
    int32_t inner, border;
    CountEdges(&mesh, &inner, &border);
    assert_int_equal(counts.pieces, 2);
    assert_true(counts.links > 8);

    Draw(canvas, &stage.host, KIRI_DRAW_TRIANGLES);
    CheckCounts(canvas, 0, 0, mesh.triangleCount);
    Draw(canvas, &stage.host, KIRI_DRAW_EDGES);
    CheckCounts(canvas, 0, inner, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_BORDERS);
    CheckCounts(canvas, 0, border, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_FRAMES);
    CheckCounts(canvas, counts.frames, 3 * counts.frames, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_LINKS);
    CheckCounts(canvas, 0, 2 * counts.links, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_PINS);
    CheckCounts(canvas, 2, 2, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_BOXES);
    CheckCounts(canvas, 0, 12 * counts.pieces, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_OBSTACLES);
    CheckCounts(canvas, 0, 32 + 4 * 16, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_POINTS);
    CheckCounts(canvas, counts.collisionPoints, 0, 0);
    Draw(canvas, &stage.host, 0);
    CheckCounts(canvas, 0, 0, 0);

    /* Some may have pushed earlier in the tick alone, and some have pulled more than they push now. */
    Draw(canvas, &stage.host, KIRI_DRAW_CONTACTS);
    kiriObstacleState ball = World_ObstacleState(stage.host.world, stage.ball);
    int32_t contacts = canvas->points.count;
    assert_true(contacts > 0 && contacts <= ball.contacts + 2);
    CheckCounts(canvas, contacts, contacts, 0);

    Draw(canvas, &stage.host, KIRI_DRAW_ALL);
    CheckCounts(canvas, counts.frames + 2 + counts.collisionPoints + contacts,
                inner + border + 3 * counts.frames + 2 * counts.links + 2 + 12 * counts.pieces + 96 + contacts,
                mesh.triangleCount);
    assert_int_equal(canvas->lines.most, 240); /* more than one batch */
    End(&stage);
}

static float DistanceTo(const kiriDrawVertex* vertex, const float point[3])
{
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) {
        sum += (vertex->position[c] - point[c]) * (vertex->position[c] - point[c]);
    }
    return sqrtf(sum);
}

TEST(Places)
{
    Stage stage;
    Begin(&stage);
    Canvas* canvas = &stage.canvas;
    kiriMesh mesh = Host_Mesh(&stage.host, stage.sheet);
    Draw(canvas, &stage.host, KIRI_DRAW_TRIANGLES);
    for (int32_t i = 0; i < canvas->triangles.count; ++i) {
        assert_true(DistanceTo(&canvas->triangles.vertices[i], mesh.positions + 3 * mesh.indices[i]) == 0.0f);
        assert_int_equal(canvas->triangles.vertices[i].color >> 24, 255);
    }

    const float middle[3] = { 0.5f, 0.5f, -0.27f };
    Draw(canvas, &stage.host, KIRI_DRAW_OBSTACLES);
    for (int32_t i = 0; i < canvas->lines.count; ++i) {
        assert_float_equal(DistanceTo(&canvas->lines.vertices[i], middle), 0.25f, 1e-6f);
    }

    Draw(canvas, &stage.host, KIRI_DRAW_CONTACTS);
    assert_true(canvas->points.count > 0);
    for (int32_t i = 0; i < canvas->points.count; ++i) { /* half of the contactThickness off, and some depth */
        assert_float_equal(DistanceTo(&canvas->points.vertices[i], middle), 0.25f, 0.01f);
        assert_float_equal(DistanceTo(&canvas->lines.vertices[2 * i + 1], middle), 0.30f, 0.01f);
    }

    kiriFrame frames[64];
    kiriFrameState frame;
    int32_t count = World_GetFrames(stage.host.world, stage.sheet, frames, 64);
    Draw(canvas, &stage.host, KIRI_DRAW_FRAMES);
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_GetState(stage.host.world, frames[i], &frame));
        assert_true(DistanceTo(&canvas->points.vertices[i], frame.position) == 0.0f);
    }

    Draw(canvas, &stage.host, KIRI_DRAW_BOXES);
    for (int32_t p = 0; p < 2; ++p) {
        kiriPieceState piece = World_PieceState(stage.host.world, stage.sheet, p);
        const kiriDrawVertex* first = canvas->lines.vertices + 24 * p;
        assert_true(DistanceTo(first, piece.lower) == 0.0f);
        assert_true(DistanceTo(first + 23, piece.upper) == 0.0f);
    }
    End(&stage);
}

TEST(Blades)
{
    Stage stage;
    Begin(&stage);
    Canvas* canvas = &stage.canvas;
    kiriBlade blade = World_BeginBlade(stage.host.world, 0);
    Draw(canvas, &stage.host, KIRI_DRAW_BLADES);
    CheckCounts(canvas, 0, 0, 0); /* it is nowhere yet */
    OK(kiriBlade_MoveEdge(stage.host.world, blade, (float[]){ 0.2f, 0.2f, 1.0f }, (float[]){ 0.2f, 0.2f, -1.0f }));
    OK(kiriBlade_MoveEdge(stage.host.world, blade, (float[]){ 0.2f, 0.4f, 1.0f }, (float[]){ 0.2f, 0.4f, -1.0f }));
    Draw(canvas, &stage.host, KIRI_DRAW_BLADES);
    CheckCounts(canvas, 1, 1, 0);
    assert_true(DistanceTo(canvas->lines.vertices, (float[]){ 0.2f, 0.4f, 1.0f }) == 0.0f);
    assert_float_equal(canvas->points.vertices[0].position[1], 0.4f, 1e-5f);
    End(&stage);
}

/* While a cut waits for its budget, and for pieces that are destroyed meanwhile: what is seen is drawn. */
TEST(Work)
{
    Stage stage;
    Begin(&stage);
    kiriBudget budget = { .cells = 40, .samples = 20 };
    OK(kiriWorld_SetBudget(stage.host.world, &budget));
    Host_Cut(&stage.host, stage.sheet, (float[]){ -0.1f, 0.31f, 1.1f, 0.32f }, 2);
    assert_int_equal(Host_Tick(&stage.host, 1.0f / 60.0f, 2), KIRI_PENDING);
    kiriFrame off = Host_FrameOf(&stage.host, stage.sheet, 1);
    assert_int_equal(kiriFrame_DestroyPiece(stage.host.world, off), KIRI_PENDING);
    kiriMesh mesh = Host_Mesh(&stage.host, stage.sheet);
    int32_t seen = 0, inner, border, frames;
    for (int32_t t = 0; t < mesh.triangleCount; ++t) {
        seen += mesh.indices[3 * t] != mesh.indices[3 * t + 1];
    }
    assert_true(seen < mesh.triangleCount);
    Draw(&stage.canvas, &stage.host, KIRI_DRAW_TRIANGLES);
    CheckCounts(&stage.canvas, 0, 0, seen);
    Draw(&stage.canvas, &stage.host, KIRI_DRAW_EDGES | KIRI_DRAW_BORDERS);
    int32_t lines = stage.canvas.lines.count / 2;
    Draw(&stage.canvas, &stage.host, KIRI_DRAW_BORDERS);
    border = stage.canvas.lines.count / 2;
    inner = lines - border;
    assert_int_equal(2 * inner + border, 3 * seen);
    OK(kiriSheet_GetFrames(stage.host.world, stage.sheet, NULL, 0, &frames));
    Draw(&stage.canvas, &stage.host, KIRI_DRAW_FRAMES | KIRI_DRAW_BOXES);
    CheckCounts(&stage.canvas, frames, 3 * frames + 12, 0);
    End(&stage);
}

static void AddShape(Host* host, int32_t type, float height)
{
    static const float outline[6] = { 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f };
    kiriObstacleDef def = ObstacleOf(type);
    def.radius = 0.5f;
    def.height = height;
    def.size[0] = def.size[1] = def.size[2] = 1.0f;
    def.outline = outline;
    def.outlineCount = 3;
    World_AddObstacle(host->world, &def);
}

TEST(Shapes)
{
    static const int32_t lines[6] = { 5, 96, 132, 12, 68, 9 }; /* by type */
    int32_t all = 0;
    Canvas canvas;
    START_HOST(host);
    Canvas_Create(&canvas);
    for (int32_t type = KIRI_OBSTACLE_PLANE; type <= KIRI_OBSTACLE_PRISM; ++type) {
        AddShape(&host, type, type == KIRI_OBSTACLE_PRISM ? 0.0f : 1.0f);
        Draw(&canvas, &host, KIRI_DRAW_OBSTACLES);
        all += lines[type];
        CheckCounts(&canvas, 0, all, 0);
        for (int32_t i = 0; i < canvas.lines.count; ++i) { /* none is endless */
            assert_true(fabsf(canvas.lines.vertices[i].position[2]) <= 1.0f);
        }
    }
    Canvas_Free(&canvas);
}

TEST(OfOneSheet)
{
    Stage stage;
    Begin(&stage);
    kiriSheet other = Host_AddSmall(&stage.host, 8);
    stage.canvas.draw.sheet = other;
    Draw(&stage.canvas, &stage.host, KIRI_DRAW_OBSTACLES | KIRI_DRAW_TRIANGLES | KIRI_DRAW_POINTS);
    CheckCounts(&stage.canvas, 6, 0, 128);
    stage.canvas.draw.lines = stage.canvas.draw.triangles = NULL;
    Draw(&stage.canvas, &stage.host, KIRI_DRAW_ALL);
    CheckCounts(&stage.canvas, 4 + 6, 0, 0);
    End(&stage);
}
