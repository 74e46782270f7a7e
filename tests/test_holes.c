/* What stays known of a large sheet when pieces leave it, and what is left keeps its indices. */
#include "host.h"

#include "sheet/kiri_seen.h"
#include "sheet/kiri_piece.h"
#include "world/kiri_world.h"

enum { SQUARES = 72, STRIPS = 8 };

/* Strips from side to side, in nothing but air. */
static kiriSheet StartStrips(Host* host, int32_t frameCount, float sleepSpeed)
{
    static const float none[3] = { 0.0f, 0.0f, 0.0f };
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.gridResolution = 48;
    def.frameCount = frameCount;
    def.maxFrames = 4096;
    def.collisionPoints = 50;
    def.sleepSpeed = sleepSpeed;
    Host_Start(host);
    host->every = 16;
    OK(kiriWorld_SetGravity(host->world, none));
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, SQUARES, SQUARES);
    for (int32_t i = 1; i < STRIPS; ++i) {
        float at = ((float)i + 0.013f) / STRIPS;
        Host_Cut(host, sheet, (float[]){ -0.1f, at, 1.1f, at }, 2);
    }
    OK(Host_Tick(host, 1.0f / 60.0f, 1));
    assert_int_equal(Host_Counts(host, sheet).pieces, STRIPS);
    return sheet;
}

static kiriSheetData* DataOf(const Host* host)
{
    return host->world->sheets.data[0];
}

/* ---- Lists of pieces ---- */

typedef struct Listed {
    kiriPieceMesh mesh;
    kiriPieceState state;
    const kiriFrame* frames;
    int32_t frameCount;
} Listed;

static Listed ListPiece(const Host* host, kiriSheet sheet, int32_t piece)
{
    Listed listed;
    OK(kiriSheet_GetPieceFrames(host->world, sheet, piece, &listed.frames, &listed.frameCount));
    OK(kiriSheet_GetPiece(host->world, sheet, piece, &listed.state));
    OK(kiriSheet_GetPieceMesh(host->world, sheet, piece, &listed.mesh));
    return listed;
}

static void CompareListed(const Host hosts[2], kiriSheet sheet)
{
    for (int32_t p = 0; p < Host_Counts(&hosts[0], sheet).pieces; ++p) {
        Listed a = ListPiece(&hosts[0], sheet, p), b = ListPiece(&hosts[1], sheet, p);
        assert_memory_equal(&a.state, &b.state, sizeof(a.state));
        assert_int_equal(a.frameCount, b.frameCount);
        assert_memory_equal(a.frames, b.frames, sizeof(*a.frames) * (size_t)a.frameCount);
        assert_int_equal(a.mesh.vertexCount, b.mesh.vertexCount);
        assert_int_equal(a.mesh.triangleCount, b.mesh.triangleCount);
        assert_int_equal(a.mesh.triangleCount, a.state.triangles);
        assert_int_equal(a.mesh.collisionPointCount, b.mesh.collisionPointCount);
        assert_memory_equal(a.mesh.vertices, b.mesh.vertices, sizeof(int32_t) * (size_t)a.mesh.vertexCount);
        assert_memory_equal(a.mesh.triangles, b.mesh.triangles, sizeof(int32_t) * (size_t)a.mesh.triangleCount);
        assert_memory_equal(a.mesh.indices, b.mesh.indices, 3 * sizeof(int32_t) * (size_t)a.mesh.triangleCount);
        assert_memory_equal(a.mesh.collisionPoints, b.mesh.collisionPoints,
                            sizeof(int32_t) * (size_t)a.mesh.collisionPointCount);
    }
}

/* In the second world lists are made anew each time. They hold what is in the mesh, each once. */
static void TestListsStay(void** state)
{
    (void)state;
    Host hosts[2];
    kiriSheet sheet = 0, made;
    for (int k = 0; k < 2; ++k) {
        sheet = StartStrips(&hosts[k], 20, 0.0f);
    }
    for (int32_t round = 0; round < 3; ++round) {
        Listed stays = ListPiece(&hosts[0], sheet, 3 - round);
        int32_t first = stays.mesh.vertices[0], corner = stays.mesh.indices[0];
        for (int k = 0; k < 2; ++k) {
            kiriFrame gone = Host_FrameOf(&hosts[k], sheet, 2 - round);
            OK(round == 1 ? kiriFrame_DestroyPiece(hosts[k].world, gone)
                          : kiriFrame_DetachPiece(hosts[k].world, gone, &made));
        }
        assert_true(DataOf(&hosts[0])->mesh.vertexHoles > 0);
        Listed kept = ListPiece(&hosts[0], sheet, 2 - round);
        assert_ptr_equal(kept.mesh.vertices, stays.mesh.vertices);
        assert_ptr_equal(kept.mesh.indices, stays.mesh.indices);
        assert_true(kept.mesh.vertices[0] == first && kept.mesh.indices[0] == corner);
        for (int again = 0; again < 2; ++again) {
            kiriPieceLists_Forget(&DataOf(&hosts[1])->lists);
            CompareListed(hosts, sheet);
            for (int k = 0; k < 2; ++k) {
                Host_Cut(&hosts[k], sheet, (float[]){ 0.31f, 0.9f, 0.4f + 0.1f * (float)round, 0.97f }, 2);
                OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
            }
        }
    }
    Host_Stop(&hosts[0]);
    Host_Stop(&hosts[1]);
}

/* What is asked for first is made, whatever it is; what memory is refused for is made when it is asked for again. */
static void TestListsByNeed(void** state)
{
    (void)state;
    Host host;
    kiriSheet sheet = StartStrips(&host, 20, 0.0f);
    kiriPieceLists* lists = &DataOf(&host)->lists;
    Listed whole = ListPiece(&host, sheet, 5);
    int32_t triangles = whole.mesh.triangleCount;
    kiriPieceLists_Retire(lists, &host.world->retired);
    const kiriFrame* frames;
    int32_t count;
    OK(kiriSheet_GetPieceFrames(host.world, sheet, 5, &frames, &count));
    assert_true(count == whole.frameCount && lists->hasFrames && !lists->hasVertices && !lists->hasTriangles);
    kiriPieceState piece;
    OK(kiriSheet_GetPiece(host.world, sheet, 5, &piece));
    assert_true(piece.triangles == triangles && lists->hasVertices && !lists->hasTriangles);
    assert_int_equal(lists->triangles.items.count, 0);
    kiriPieceMesh mesh;
    host.failAt = host.calls;
    assert_int_equal(kiriSheet_GetPieceMesh(host.world, sheet, 5, &mesh), KIRI_ERROR_MEMORY);
    host.failAt = -1;
    OK(kiriSheet_GetPieceMesh(host.world, sheet, 5, &mesh));
    assert_int_equal(mesh.triangleCount, triangles);
    Host_Stop(&host);
}

/* ---- Blocks of vertices ---- */

/* Most of a sheet sleeps. In the second world nothing is known of blocks when pieces have left: the same is seen. */
static void LeaveAsleep(int32_t frameCount)
{
    static const float up[3] = { 0.0f, 0.0f, 0.4f }, still[3] = { 0.0f, 0.0f, 0.0f };
    Host hosts[2];
    for (int k = 0; k < 2; ++k) {
        kiriSheet sheet = StartStrips(&hosts[k], frameCount, 0.01f);
        while (!DataOf(&hosts[k])->rest.asleep) {
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
        }
        OK(kiriFrame_SetPieceVelocity(hosts[k].world, Host_FrameOf(&hosts[k], sheet, 4), up, still));
        for (int tick = 0; tick < 3; ++tick) {
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
        }
        for (int round = 0; round < 3; ++round) {
            OK(kiriFrame_DestroyPiece(hosts[k].world, Host_FrameOf(&hosts[k], sheet, 3 - round)));
            if (k == 1) {
                kiriBlocks_Forget(&DataOf(&hosts[k])->seen.blocks);
            }
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
            OK(kiriFrame_SetPieceVelocity(hosts[k].world, Host_FrameOf(&hosts[k], sheet, 4 - round), up, still));
            for (int tick = 0; tick < 3; ++tick) {
                OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
            }
        }
        assert_true(DataOf(&hosts[k])->seen.surface.isPartly && DataOf(&hosts[k])->mesh.vertexHoles > 0);
        assert_false(DataOf(&hosts[k])->seen.blocks.hasUnknown);
    }
    const kiriSurface *a = &DataOf(&hosts[0])->seen.surface, *b = &DataOf(&hosts[1])->seen.surface;
    assert_memory_equal(a->positions.data, b->positions.data, sizeof(float) * (size_t)a->positions.count);
    Host_Stop(&hosts[0]);
    Host_Stop(&hosts[1]);
}

static void TestBlocksStayKnown(void** state)
{
    (void)state;
    LeaveAsleep(24);
    LeaveAsleep(260); /* more than there are bits for */
}

/* ---- Labels of frames in weights ---- */

static void KeepAll(kiriKeep* keep, kiriMemory* memory, int32_t items)
{
    assert_true(kiriKeep_Init(keep, memory, items));
    while (keep->to.count < items) {
        kiriKeep_Add(keep, true);
    }
}

/* Each frame is its own label again, in all weights, as in a sheet of which nothing has left. */
static void ForgetLabels(kiriSheetData* sheet)
{
    kiriMemory scratch = kiriMemory_Like(sheet->memory);
    kiriKeep frames, vertices, points, labels;
    KeepAll(&frames, &scratch, sheet->frames.count);
    KeepAll(&vertices, &scratch, sheet->mesh.vertices.count);
    KeepAll(&points, &scratch, sheet->points.count);
    assert_true(kiriKeep_Init(&labels, &scratch, kiriLabels_Count(&sheet->shape.labels, sheet->frames.count)));
    kiriLabels_Map(&sheet->shape.labels, &frames, &labels);
    kiriShape_Keep(&sheet->shape, sheet->memory, &frames, &labels, NULL, 0);
    kiriSkin_Keep(&sheet->vertexSkin, &vertices, &labels);
    kiriSkin_Keep(&sheet->pointSkin, &points, &labels);
    kiriPatches_Forget(&sheet->seen.surface.patches);
    kiriBlocks_Forget(&sheet->seen.blocks);
    sheet->seen.surface.isWritten = sheet->seen.surface.isSteady = false;
    kiriMemory_FreeAll(&scratch);
}

static void AssertSameState(const Host hosts[2])
{
    uint64_t hash[2];
    for (int k = 0; k < 2; ++k) {
        OK(kiriWorld_GetStateHash(hosts[k].world, &hash[k]));
    }
    assert_true(hash[0] == hash[1]);
}

static void SaveAndLoad(Host* host)
{
    int64_t size;
    assert_int_equal(kiriWorld_Save(host->world, NULL, 0, &size), KIRI_OK);
    void* bytes = malloc((size_t)size);
    OK(kiriWorld_Save(host->world, bytes, size, &size));
    OK(kiriWorld_Load(host->world, bytes, size));
    free(bytes);
}

/* Strips leave, and cuts bring new frames. In the second world labels are forgotten each time: it stays the same. */
static void TestLabels(void** state)
{
    (void)state;
    Host hosts[2];
    kiriSheet sheet = 0, made;
    for (int k = 0; k < 2; ++k) {
        sheet = StartStrips(&hosts[k], 24, 0.0f);
    }
    for (int32_t round = 0; round < 3; ++round) {
        for (int k = 0; k < 2; ++k) {
            kiriFrame gone = Host_FrameOf(&hosts[k], sheet, 2 * round);
            OK(round == 1 ? kiriFrame_DestroyPiece(hosts[k].world, gone)
                          : kiriFrame_DetachPiece(hosts[k].world, gone, &made));
        }
        assert_true(DataOf(&hosts[0])->shape.labels.itemOf.count > DataOf(&hosts[0])->frames.count);
        ForgetLabels(DataOf(&hosts[1]));
        assert_int_equal(DataOf(&hosts[1])->shape.labels.itemOf.count, 0);
        AssertSameState(hosts);
        float u = 0.2f + 0.2f * (float)round;
        for (int k = 0; k < 2; ++k) {
            Host_Cut(&hosts[k], sheet, (float[]){ u, -0.1f, u, 1.1f }, 2);
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
        }
        AssertSameState(hosts);
        SaveAndLoad(&hosts[0]);
        for (int tick = 0; tick < 2; ++tick) {
            OK(Host_Tick(&hosts[0], 1.0f / 60.0f, 1));
            OK(Host_Tick(&hosts[1], 1.0f / 60.0f, 1));
        }
        AssertSameState(hosts);
    }
    Host_Stop(&hosts[0]);
    Host_Stop(&hosts[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestListsStay),
        cmocka_unit_test(TestListsByNeed),
        cmocka_unit_test(TestBlocksStayKnown),
        cmocka_unit_test(TestLabels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
