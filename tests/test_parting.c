/* Pieces that are detached and destroyed, many at once, and while cuts are worked on. */
#include "host.h"

#include "layout_hash.h"

enum { MOST_SHEETS = 64, MOST_PIECES = 600 };

/* ---- Scenes ---- */

/* A square in so many pieces; blades are a little off the lines of the mesh. */
static kiriSheet Chop(Host* host, kiriSheetDef* def, int32_t across, int32_t along)
{
    kiriSheet sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, 16, 16);
    for (int32_t i = 1; i < across; ++i) {
        float at = ((float)i + 0.013f) / (float)across, way[4] = { at, -0.1f, at, 1.1f };
        Host_Cut(host, sheet, way, 2);
    }
    for (int32_t i = 1; i < along; ++i) {
        float at = ((float)i + 0.017f) / (float)along, way[4] = { -0.1f, at, 1.1f, at };
        Host_Cut(host, sheet, way, 2);
    }
    assert_int_equal(Host_Tick(host, 1.0f / 60.0f, 1), KIRI_OK);
    assert_int_equal(Host_Counts(host, sheet).pieces, across * along);
    return sheet;
}

static kiriSheetDef DefOf(int32_t resolution)
{
    kiriSheetDef def = SheetOf(resolution, 6);
    def.maxFrames = 4096;
    def.collisionPoints = 40;
    def.sleepSpeed = 0.0f;
    return def;
}

static uint64_t LayoutAt(const Host* host, int32_t index)
{
    return Layout_Hash(host->world, Host_SheetAt(host, index));
}

/* The frames of two worlds, their layouts, and what is seen are the same. */
static void CompareSheets(const Host hosts[2])
{
    assert_int_equal(Host_SheetCount(&hosts[0]), Host_SheetCount(&hosts[1]));
    for (int32_t s = 0; s < Host_SheetCount(&hosts[0]); ++s) {
        kiriSheet sheets[2] = { Host_SheetAt(&hosts[0], s), Host_SheetAt(&hosts[1], s) };
        kiriFrame frames[2][256];
        int32_t counts[2];
        kiriMesh a = Host_Mesh(&hosts[0], sheets[0]), b = Host_Mesh(&hosts[1], sheets[1]);
        assert_int_equal(LayoutAt(&hosts[0], s), LayoutAt(&hosts[1], s));
        assert_memory_equal(a.positions, b.positions, 3 * sizeof(float) * (size_t)a.vertexCount);
        for (int k = 0; k < 2; ++k) {
            OK(kiriSheet_GetFrames(hosts[k].world, sheets[k], frames[k], 256, &counts[k]));
        }
        assert_true(counts[0] == counts[1] && counts[0] <= 256);
        for (int32_t f = 0; f < counts[0]; ++f) {
            kiriFrameState states[2];
            OK(kiriFrame_GetState(hosts[0].world, frames[0][f], &states[0]));
            OK(kiriFrame_GetState(hosts[1].world, frames[1][f], &states[1]));
            assert_memory_equal(&states[0], &states[1], sizeof(kiriFrameState));
        }
    }
}

/* ---- Many at once ---- */

/* The first frames of all pieces but each `stays`-th. */
static int32_t ListFrames(Host* host, kiriSheet sheet, int32_t stays, kiriFrame* frames)
{
    int32_t count = 0;
    for (int32_t p = 0; p < Host_Counts(host, sheet).pieces; ++p) {
        if (p % stays != 0) {
            frames[count++] = Host_FrameOf(host, sheet, p);
        }
    }
    return count;
}

TEST(ManyAreAsOneByOne)
{
    static kiriFrame frames[MOST_PIECES];
    static kiriSheet sheets[2][MOST_PIECES];
    for (int detach = 0; detach < 2; ++detach) {
        HOST_PAIR(hosts);
        int32_t count = 0;
        for (int k = 0; k < 2; ++k) {
            Host_Start(&hosts[k]);
            kiriSheetDef def = DefOf(detach ? 24 : 64);
            kiriSheet sheet = detach ? Chop(&hosts[k], &def, 6, 5) : Chop(&hosts[k], &def, 25, 20);
            count = ListFrames(&hosts[k], sheet, 9, frames);
        }
        OK(detach ? kiriWorld_DetachPieces(hosts[0].world, frames, count, sheets[0])
                  : kiriWorld_DestroyPieces(hosts[0].world, frames, count));
        for (int32_t i = 0; i < count; ++i) {
            OK(detach ? kiriFrame_DetachPiece(hosts[1].world, frames[i], &sheets[1][i])
                      : kiriFrame_DestroyPiece(hosts[1].world, frames[i]));
            assert_true(!detach || (sheets[0][i] != 0 && sheets[0][i] == sheets[1][i]));
        }
        CompareSheets(hosts);
        for (int k = 0; k < 2; ++k) {
            assert_int_equal(Host_SheetCount(&hosts[k]), detach ? 1 + count : 1);
            assert_true(Host_Tick(&hosts[k], 1.0f / 60.0f, 2) >= 0 && Host_Tick(&hosts[k], 1.0f / 60.0f, 2) >= 0);
        }
        CompareSheets(hosts);
    }
}

/* Of several sheets, and frames of one piece more than once. */
TEST(OfSeveralSheets)
{
    START_HOST(host);
    kiriSheetDef def = DefOf(16);
    kiriSheet sheets[2] = { Chop(&host, &def, 3, 1), Chop(&host, &def, 1, 4) }, made[4];
    kiriFrame frames[4] = { Host_FrameOf(&host, sheets[1], 2), Host_FrameOf(&host, sheets[0], 1),
                            Host_FrameOf(&host, sheets[1], 2), Host_FrameOf(&host, sheets[1], 0) };
    OK(kiriWorld_DetachPieces(host.world, frames, 4, made));
    assert_true(made[0] == made[2] && made[0] != made[1] && made[0] != made[3] && made[1] != made[3]);
    assert_int_equal(Host_Counts(&host, sheets[0]).pieces, 2);
    assert_int_equal(Host_Counts(&host, sheets[1]).pieces, 2);
    assert_int_equal(Host_SheetCount(&host), 5);

    /* One that would leave nothing: none goes. */
    uint64_t hash = Host_Hash(&host);
    kiriFrame all[3] = { Host_FrameOf(&host, sheets[0], 0), Host_FrameOf(&host, sheets[1], 0),
                         Host_FrameOf(&host, sheets[1], 1) };
    assert_int_equal(kiriWorld_DestroyPieces(host.world, all, 3), KIRI_ERROR_STATE);
    assert_int_equal(kiriWorld_DetachPieces(host.world, all, 3, made), KIRI_ERROR_STATE);
    assert_true(made[0] == 0 && made[2] == 0);
    all[1] = 0;
    assert_int_equal(kiriWorld_DestroyPieces(host.world, all, 3), KIRI_ERROR_ID);
    assert_int_equal(kiriWorld_DestroyPieces(host.world, all, -1), KIRI_ERROR_ARGUMENT);
    OK(kiriWorld_DestroyPieces(host.world, NULL, 0));
    assert_int_equal(Host_Hash(&host), hash);
    all[1] = Host_FrameOf(&host, sheets[1], 0);
    OK(kiriWorld_DestroyPieces(host.world, all, 2));
    assert_int_equal(Host_Tick(&host, 1.0f / 60.0f, 1), KIRI_OK);
}

/* The first frame of the piece whose vertices are nearest to a rest point. */
static kiriFrame FrameNear(Host* host, kiriSheet sheet, float u, float v)
{
    kiriFrame frame = 0;
    float least = 1e30f;
    kiriMesh mesh = Host_Mesh(host, sheet);
    for (int32_t p = 0; p < Host_Counts(host, sheet).pieces; ++p) {
        float sum[2] = { 0.0f, 0.0f };
        kiriPieceMesh piece = World_PieceMesh(host->world, sheet, p);
        for (int32_t i = 0; i < 2 * piece.vertexCount; ++i) {
            sum[i % 2] += mesh.restPositions[2 * piece.vertices[i / 2] + i % 2] / (float)piece.vertexCount;
        }
        float far = hypotf(sum[0] - u, sum[1] - v);
        frame = far < least ? Host_FrameOf(host, sheet, p) : frame;
        least = fminf(far, least);
    }
    return frame;
}

/* Another material gives frames other masses, which the next commit counts exactly: in a part that leaves before it,
   too. */
TEST(PartsCountOtherMassesExactly)
{
    HOST_PAIR(hosts);
    for (int k = 0; k < 2; ++k) {
        kiriSheetDef def = DefOf(24);
        def.frameCount = 16;
        def.paper.fromScratch = k;
        Host_Start(&hosts[k]);
        kiriSheet sheet = Chop(&hosts[k], &def, 2, 1);
        kiriSheetSettings settings = World_Settings(hosts[k].world, sheet);
        settings.material.density *= 1.7f;
        OK(kiriSheet_SetSettings(hosts[k].world, sheet, &settings));
        kiriSheet part = World_Detach(hosts[k].world, FrameNear(&hosts[k], sheet, 0.75f, 0.5f));
        Host_Cut(&hosts[k], part, (float[]){ 1.1f, 0.9f, 0.9f, 0.87f }, 2);
        for (int tick = 0; tick < 4; ++tick) { /* inertia enters the motion */
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
        }
    }
    assert_true(Host_Hash(&hosts[0]) == Host_Hash(&hosts[1]));
}

/* ---- At random ---- */

/* Detaches or destroys up to three pieces of the first sheet. The area that is left is what it was but for theirs. */
static kiriResult PartAtRandom(Host* host, kiriSheet sheet, uint32_t* seed)
{
    kiriFrame frames[3];
    kiriSheet made[3];
    int32_t count = 0, pieces = Host_Counts(host, sheet).pieces;
    double area = Host_Totals(host, sheet).area;
    for (int32_t first = (int32_t)(Random(seed) % 64), i = 0; i < 3 && i + 1 < pieces; ++i) {
        kiriPieceState piece = World_PieceState(host->world, sheet, (first + i) % pieces);
        if (piece.frames > 0) {
            frames[count++] = Host_FrameOf(host, sheet, (first + i) % pieces);
            area -= piece.area;
        }
    }
    bool destroys = Random(seed) % 2 == 0;
    kiriResult result = destroys ? kiriWorld_DestroyPieces(host->world, frames, count)
                                 : kiriWorld_DetachPieces(host->world, frames, count, made);
    if (destroys && result >= 0 && count > 0) {
        kiriFrameState state;
        assert_float_equal(Host_Totals(host, sheet).area, area, 1e-9);
        assert_int_equal(kiriFrame_GetState(host->world, frames[0], &state), KIRI_ERROR_ID);
    }
    for (int32_t i = 0; !destroys && result == KIRI_OK && i < count; ++i) {
        assert_int_equal(Host_Counts(host, made[i]).pieces, 1);
    }
    return result;
}

/* The same calls to a sheet that is made anew after each cut: what is left is what a rebuild would give. */
TEST(LeftIsAsFromScratch)
{
    int32_t parted = 0;
    for (uint32_t run = 1; run <= 3; ++run) {
        HOST_PAIR(hosts);
        kiriSheet sheets[2];
        uint32_t seeds[2] = { 677u * run, 677u * run };
        for (int k = 0; k < 2; ++k) {
            kiriSheetDef def = DefOf(20);
            def.model = (int32_t)(run % 3);
            def.paper.fromScratch = k;
            Host_Start(&hosts[k]);
            sheets[k] = Host_AddRectangle(&hosts[k], &def, 1.0f, 1.0f, 10, 10);
        }
        for (int tick = 0; tick < 30; ++tick) {
            for (int k = 0; k < 2; ++k) {
                Host_CutSomewhere(&hosts[k], sheets[k], &seeds[k]);
                assert_true(Host_Tick(&hosts[k], 1.0f / 60.0f, 1) >= 0);
                if (tick % 3 == 2) {
                    kiriResult result = PartAtRandom(&hosts[k], sheets[k], &seeds[k]);
                    assert_true(result == KIRI_OK || result == KIRI_ERROR_STATE);
                    parted += result == KIRI_OK;
                }
            }
            for (int32_t s = 0; s < Host_SheetCount(&hosts[0]); ++s) {
                assert_int_equal(LayoutAt(&hosts[0], s), LayoutAt(&hosts[1], s));
            }
        }
    }
    assert_true(parted > 30);
}

/* ---- What is seen ---- */

static int32_t CountHidden(const kiriMesh* mesh)
{
    int32_t hidden = 0;
    for (int32_t t = 0; t < mesh->triangleCount; ++t) {
        const int32_t* corner = &mesh->indices[3 * t];
        hidden += corner[0] == corner[1] && corner[1] == corner[2];
    }
    return hidden;
}

static bool IsHit(const Host* host, kiriSheet sheet, float u, float v)
{
    const float origin[3] = { u, v, 1.0f }, down[3] = { 0.0f, 0.0f, -1.0f };
    kiriHit hit;
    kiriResult result = kiriSheet_Raycast(host->world, sheet, origin, down, 10.0f, &hit);
    OK(result < 0 ? result : KIRI_OK);
    return result == KIRI_OK && hit.triangle >= 0;
}

/* ---- What is left ---- */

/* Arrays that the host has stay as they were. What has left is neither in the mesh nor hit. */
TEST(GoneIsNotSeen)
{
    kiriSheetDef def = DefOf(24);
    START_HOST(host);
    World_StopGravity(host.world);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 70, 70), detached;
    Host_Cut(&host, sheet, (float[]){ 0.7f, -0.1f, 0.7f, 0.3f, 1.1f, 0.3f }, 3);
    Host_Cut(&host, sheet, (float[]){ 0.4f, -0.1f, 0.4f, 0.3f, -0.1f, 0.3f }, 3);
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    kiriCounts counts = Host_Counts(&host, sheet);
    kiriMesh before = Host_Mesh(&host, sheet);
    int32_t* indices = malloc(sizeof(int32_t) * 3 * (size_t)before.triangleCount);
    memcpy(indices, before.indices, sizeof(int32_t) * 3 * (size_t)before.triangleCount);
    kiriFrame gone = FrameNear(&host, sheet, 0.85f, 0.15f);
    int32_t index = World_PieceOf(host.world, gone);
    kiriPieceMesh piece = World_PieceMesh(host.world, sheet, index);
    int32_t triangles = piece.triangleCount, vertices = piece.vertexCount;
    assert_true(IsHit(&host, sheet, 0.85f, 0.15f) && IsHit(&host, sheet, 0.2f, 0.15f));
    OK(kiriFrame_DestroyPiece(host.world, gone));
    Host_Validate(&host);
    kiriMesh after = Host_Mesh(&host, sheet);
    assert_memory_equal(indices, before.indices, sizeof(int32_t) * 3 * (size_t)before.triangleCount);
    free(indices);
    assert_int_equal(after.triangleCount, before.triangleCount - triangles);
    assert_int_equal(after.vertexCount, before.vertexCount - vertices);
    assert_true(after.revision > before.revision && CountHidden(&after) == 0);
    assert_true(!IsHit(&host, sheet, 0.85f, 0.15f) && IsHit(&host, sheet, 0.2f, 0.15f) &&
                IsHit(&host, sheet, 0.55f, 0.15f));
    assert_int_equal(Host_Counts(&host, sheet).pieces, counts.pieces - 1);
    OK(kiriFrame_DetachPiece(host.world, FrameNear(&host, sheet, 0.2f, 0.15f), &detached));
    assert_true(!IsHit(&host, sheet, 0.2f, 0.15f) && IsHit(&host, detached, 0.2f, 0.15f));
    Host_Cut(&host, sheet, (float[]){ -0.2f, 0.15f, 1.2f, 0.16f }, 2);
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2); /* from one border of the rest to the other */
    assert_int_equal(Host_Counts(&host, detached).pieces, 1);
}

/* A small sheet falls through the place of a removed piece in a large one that is held, and lies on it beside. */
TEST(GoneTouchesNothing)
{
    START_HOST(host);
    kiriSheetDef def = DefOf(24), small = DefOf(8);
    def.touchesSheets = small.touchesSheets = 1;
    def.collisionPoints = small.collisionPoints = 0.0f;
    small.frameCount = 1;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 70, 70), fallen[2];
    Host_Cut(&host, sheet, (float[]){ 0.6f, -0.1f, 0.6f, 0.4f, 1.1f, 0.4f }, 3);
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    OK(kiriFrame_DestroyPiece(host.world, FrameNear(&host, sheet, 0.85f, 0.15f)));
    kiriFrame frames[64];
    int32_t count = World_GetFrames(host.world, sheet, frames, 64);
    assert_in_range(count, 1, 64);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState is = World_FrameState(host.world, frames[i]);
        OK(kiriFrame_Hold(host.world, frames[i], is.position, is.rotation));
    }
    for (int k = 0; k < 2; ++k) {
        small.position[0] = k == 0 ? 0.75f : 0.2f;
        small.position[1] = k == 0 ? 0.1f : 0.6f;
        small.position[2] = 0.05f;
        fallen[k] = Host_AddRectangle(&host, &small, 0.15f, 0.15f, 4, 4);
    }
    for (int tick = 0; tick < 40; ++tick) {
        assert_true(Host_Tick(&host, 1.0f / 60.0f, 2) >= 0);
        Host_Validate(&host);
    }
    assert_true(Host_Totals(&host, fallen[0]).center[2] < -0.5);
    assert_true(Host_Totals(&host, fallen[1]).center[2] > -0.01);
}

/* ---- On account ---- */

/* A call does what one tick's samples pay for, and the coming ticks have less; the rest of many pieces is made tick by
   tick, and no tick spends more than it has. In the end all is as without a budget. */
TEST(CallsKeepToTheBudget)
{
    enum { PIECES = 36, SAMPLES = 3000 };
    uint64_t layouts[2] = { 0, 0 };
    for (int k = 0; k < 2; ++k) {
        const kiriBudget budget = { 0, 0, k == 0 ? SAMPLES : 0, 0 };
        kiriFrame frames[PIECES];
        kiriSheet made[PIECES];
        int32_t ticks = 0, waiting = 0, most = 0;
        START_HOST(host);
        World_StopGravity(host.world);
        kiriSheetDef def = DefOf(48);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 80, 80);
        for (int32_t i = 1; i < 6; ++i) {
            float at = ((float)i + 0.013f) / 6.0f;
            Host_Cut(&host, sheet, (float[]){ at, -0.1f, at, 1.1f }, 2);
            Host_Cut(&host, sheet, (float[]){ -0.1f, at, 1.1f, at }, 2);
        }
        OK(Host_Tick(&host, 1.0f / 60.0f, 1));
        OK(kiriWorld_SetBudget(host.world, &budget));
        int32_t count = ListFrames(&host, sheet, 9, frames);
        kiriResult result = kiriFrame_DetachPiece(host.world, frames[0], &made[0]);
        assert_true(result == KIRI_OK && made[0] != 0);
        result = kiriWorld_DetachPieces(host.world, frames + 1, count - 1, made + 1);
        assert_int_equal(result, k == 0 ? KIRI_PENDING : KIRI_OK);
        for (int32_t i = 1; i < count; ++i) {
            assert_true((made[i] == 0) == (k == 0));
            waiting += made[i] == 0;
        }
        while (result == KIRI_PENDING) {
            kiriEvent event;
            result = Host_Tick(&host, 1.0f / 60.0f, 1);
            int32_t came = Host_Events(&host, KIRI_EVENT_PIECE_DETACHED, &event);
            assert_true(World_Profile(host.world).samplesRefreshed <= SAMPLES);
            waiting -= came;
            most = came > most ? came : most;
            ticks += came > 0;
        }
        assert_true(waiting == 0);
        assert_true(k == 1 || (ticks > 5 && most < 6));
        assert_int_equal(Host_SheetCount(&host), 1 + count);
        OK(Host_Tick(&host, 1.0f / 60.0f, 1));
        for (int32_t s = 0; s <= count; ++s) { /* the sheets come in the order that was asked for */
            layouts[k] = 3 * layouts[k] + LayoutAt(&host, s);
        }
    }
    assert_true(layouts[0] == layouts[1]);
}

/* Destroying pieces counts, too, of all sheets in one call: coming ticks pay for it. */
TEST(DestroyingIsOnAccount)
{
    const kiriBudget budget = { 0, 0, 50, 0 };
    int32_t paid[2] = { 0, 0 };
    for (int32_t sheets = 1; sheets <= 2; ++sheets) {
        kiriFrame frames[2];
        START_HOST(host);
        kiriSheetDef def = DefOf(24);
        for (int32_t i = 0; i < sheets; ++i) {
            kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 80, 80);
            Host_Cut(&host, sheet, (float[]){ 0.7f, -0.1f, 0.7f, 0.3f, 1.1f, 0.3f }, 3);
            OK(Host_Tick(&host, 1.0f / 60.0f, 1));
            frames[i] = FrameNear(&host, sheet, 0.85f, 0.15f);
        }
        OK(kiriWorld_SetBudget(host.world, &budget));
        uint64_t before = Host_Hash(&host);
        OK(kiriWorld_DestroyPieces(host.world, frames, sheets));
        assert_true(Host_Hash(&host) != before);
        kiriProfile profile;
        do {
            OK(Host_Tick(&host, 1.0f / 60.0f, 1));
            OK(kiriWorld_GetProfile(host.world, &profile));
            assert_in_range(profile.samplesRefreshed, 0, 50);
            paid[sheets - 1] += profile.samplesRefreshed;
        } while (profile.samplesRefreshed == 50);
    }
    assert_true(paid[0] > 50 && paid[1] == 2 * paid[0]);
}

/* In whatever stage the work is. The world is validated after every tick. */
TEST(UnderBudgets)
{
    int32_t waited[KIRI_STAGE_COUNT] = { 0 }, finished = 0;
    for (uint32_t run = 1; run <= 4; ++run) {
        const kiriBudget budgets[2] = { { 20, 60, 15, 0 }, { 0, 200, 60, 0 } };
        uint32_t seed = 911u * run;
        START_HOST(host);
        kiriSheetDef def = DefOf(16);
        def.model = (int32_t)(run % 3);
        kiriSheet sheet = Chop(&host, &def, 4, 3);
        OK(kiriWorld_SetBudget(host.world, &budgets[run % 2]));
        for (int tick = 0; tick < 150; ++tick) {
            if (tick % 12 == 0 && tick < 90) {
                Host_CutSomewhere(&host, sheet, &seed);
            }
            assert_true(Host_Tick(&host, 1.0f / 60.0f, 1) >= 0);
            finished += Host_Events(&host, KIRI_EVENT_PIECE_DETACHED, NULL);
            if (Random(&seed) % 6 == 0) {
                int32_t stage = Layout_Stage(host.world, sheet);
                kiriResult result = PartAtRandom(&host, sheet, &seed);
                assert_true(result >= 0 || result == KIRI_ERROR_STATE);
                if (result == KIRI_PENDING && stage >= 0) {
                    waited[stage] += 1;
                    Host_Validate(&host);
                }
            }
        }
        while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
        }
    }
    assert_true(waited[KIRI_STAGE_CUT] + waited[KIRI_STAGE_GRID] > 0 && waited[KIRI_STAGE_SHAPE] > 0 &&
                waited[KIRI_STAGE_SAMPLES] > 0 && finished > 5);
}

/* ---- While a cut waits ---- */

/* Four strips, and a cut along piece 3 whose work takes long under a budget. */
typedef struct Wait {
    kiriSheet sheet;
    kiriFrame frames[4];
    int32_t triangles; /* of what is destroyed */
} Wait;

/* Where the piece rests, from below to above. */
static void FindStrip(Host* host, kiriSheet sheet, int32_t piece, float range[2])
{
    kiriPieceMesh mesh = World_PieceMesh(host->world, sheet, piece);
    range[0] = 2.0f;
    range[1] = -1.0f;
    for (int32_t i = 0; i < mesh.vertexCount; ++i) {
        float v = Host_Mesh(host, sheet).restPositions[2 * mesh.vertices[i] + 1];
        range[0] = fminf(range[0], v);
        range[1] = fmaxf(range[1], v);
    }
}

static Wait StartWait(Host* host, const kiriBudget* budget)
{
    Wait wait;
    Host_Start(host);
    World_StopGravity(host->world);
    kiriSheetDef def = DefOf(16);
    wait.sheet = Chop(host, &def, 1, 4);
    for (int32_t p = 0; p < 4; ++p) {
        wait.frames[p] = Host_FrameOf(host, wait.sheet, p);
    }
    OK(kiriWorld_SetBudget(host->world, budget));
    float strip[2], zigzag[20];
    FindStrip(host, wait.sheet, 3, strip);
    for (int32_t i = 0; i < 10; ++i) {
        zigzag[2 * i] = -0.1f + 1.2f * (float)i / 9.0f;
        zigzag[2 * i + 1] = strip[0] + (i % 2 == 0 ? 0.3f : 0.7f) * (strip[1] - strip[0]);
    }
    Host_Cut(host, wait.sheet, zigzag, 10);
    assert_int_equal(Host_Tick(host, 1.0f / 60.0f, 1), budget->cells > 0 ? KIRI_PENDING : KIRI_OK);
    wait.triangles = World_PieceMesh(host->world, wait.sheet, 0).triangleCount;
    return wait;
}

/* What comes of it is what comes of it without a budget. */
TEST(WaitingChangesNothing)
{
    static const kiriBudget budgets[2] = { { 0, 50, 20, 0 }, { 0, 0, 0, 0 } };
    HOST_PAIR(hosts);
    for (int k = 0; k < 2; ++k) {
        Wait wait = StartWait(&hosts[k], &budgets[k]);
        kiriResult expected = k == 0 ? KIRI_PENDING : KIRI_OK, result;
        kiriSheet detached = 1;
        kiriEvent event = { 0 };
        assert_int_equal(kiriFrame_DestroyPiece(hosts[k].world, wait.frames[0]), expected);
        assert_int_equal(kiriFrame_DetachPiece(hosts[k].world, wait.frames[1], &detached), expected);
        assert_true((detached == 0) == (k == 0));
        int32_t done = 0;
        do {
            result = Host_Tick(&hosts[k], 1.0f / 60.0f, 1);
            done += Host_Events(&hosts[k], KIRI_EVENT_PIECE_DETACHED, &event);
        } while (result == KIRI_PENDING);
        assert_int_equal(result, KIRI_OK);
        assert_int_equal(done, k == 0 ? 1 : 0);
        if (done > 0) {
            assert_true(event.frame == wait.frames[1] && event.sheet != wait.sheet && event.sheet != 0);
            assert_float_equal(event.area, Host_Totals(&hosts[k], event.sheet).area, 1e-6);
        }
        assert_int_equal(Host_SheetCount(&hosts[k]), 2);
    }
    for (int32_t s = 0; s < 2; ++s) {
        assert_int_equal(LayoutAt(&hosts[0], s), LayoutAt(&hosts[1], s));
    }
}

/* A piece that waits to go is not seen, not hit and not found, and nothing touches it. */
TEST(GoneIsGone)
{
    static const kiriBudget budget = { 0, 30, 20, 0 };
    HOST(host);
    Wait wait = StartWait(&host, &budget);
    kiriPieceState zero = { 0 }, pieceState;
    kiriCounts counts = Host_Counts(&host, wait.sheet);
    kiriPieceMesh piece = World_PieceMesh(host.world, wait.sheet, 0);
    float strip[2], beside[2];
    FindStrip(&host, wait.sheet, 0, strip);
    FindStrip(&host, wait.sheet, 1, beside);
    float at[2] = { 0.5f, 0.5f * (strip[0] + strip[1]) };
    int32_t point = piece.collisionPoints[0];
    kiriPinDef pinDef = DefaultPin();
    memcpy(pinDef.restPoint, at, sizeof(at));
    kiriPin pin = World_AddPin(host.world, wait.sheet, &pinDef);
    pinDef.restPoint[1] = 0.5f * (beside[0] + beside[1]);
    kiriPin other = World_AddPin(host.world, wait.sheet, &pinDef);
    assert_true(IsHit(&host, wait.sheet, at[0], at[1]));
    kiriMesh before = Host_Mesh(&host, wait.sheet);
    int32_t* indices = malloc(sizeof(int32_t) * 3 * (size_t)before.triangleCount);
    memcpy(indices, before.indices, sizeof(int32_t) * 3 * (size_t)before.triangleCount);

    assert_int_equal(kiriFrame_DestroyPiece(host.world, wait.frames[0]), KIRI_PENDING);
    Host_Validate(&host);
    assert_memory_equal(indices, before.indices, sizeof(int32_t) * 3 * (size_t)before.triangleCount);
    free(indices);
    kiriMesh after = Host_Mesh(&host, wait.sheet);
    assert_true(after.revision > before.revision && CountHidden(&before) == 0);
    assert_int_equal(CountHidden(&after), wait.triangles);
    assert_false(IsHit(&host, wait.sheet, at[0], at[1]));
    assert_int_equal(Host_Counts(&host, wait.sheet).pieces, counts.pieces);
    OK(kiriSheet_GetPiece(host.world, wait.sheet, 0, &pieceState));
    assert_memory_equal(&pieceState, &zero, sizeof(zero));
    OK(kiriSheet_GetPieceMesh(host.world, wait.sheet, 0, &piece));
    assert_true(piece.vertexCount == 0 && piece.triangleCount == 0 && piece.collisionPointCount == 0);
    static const float up[3] = { 0.0f, 0.0f, 1.0f };
    assert_int_equal(kiriPin_SetTarget(host.world, pin, up), KIRI_ERROR_ID);
    OK(kiriPin_SetTarget(host.world, other, up));
    memcpy(pinDef.restPoint, at, sizeof(at));
    assert_int_equal(kiriCreatePin(host.world, wait.sheet, &pinDef, &pin), KIRI_ERROR_ARGUMENT);
    OK(kiriDestroyPin(host.world, other));
    const float ends[4] = { 0.2f, at[1], 0.8f, at[1] };
    assert_int_equal(kiriSheet_ClampLine(host.world, wait.sheet, ends, ends + 2, &pin), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_ApplyLineLoad(host.world, wait.sheet, ends, ends + 2, up), KIRI_ERROR_ARGUMENT);
    kiriContact contact;
    memset(&contact, 0, sizeof(contact));
    contact.point = point;
    contact.normal[2] = 1.0f;
    contact.offset = 0.1f;
    OK(kiriSheet_SetContacts(host.world, wait.sheet, &contact, 1));
    assert_int_equal(Host_Tick(&host, 1.0f / 60.0f, 1), KIRI_PENDING);
    assert_true(fabs(Host_Totals(&host, wait.sheet).momentum[2]) < 1e-12);
    assert_int_equal(kiriFrame_DestroyPiece(host.world, wait.frames[0]), KIRI_ERROR_ID);
    while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
        after = Host_Mesh(&host, wait.sheet);
        assert_true(CountHidden(&after) == 0 || CountHidden(&after) == wait.triangles);
    }
    after = Host_Mesh(&host, wait.sheet);
    assert_int_equal(CountHidden(&after), 0);
}

/* What waits to be detached may be destroyed, and something has to be left all the time. */
TEST(AskedTwice)
{
    static const kiriBudget budget = { 0, 30, 20, 0 };
    HOST(host);
    Wait wait = StartWait(&host, &budget);
    kiriSheet detached;
    int32_t dropped;
    assert_int_equal(kiriFrame_DetachPiece(host.world, wait.frames[0], &detached), KIRI_PENDING);
    assert_int_equal(kiriFrame_DetachPiece(host.world, wait.frames[0], &detached), KIRI_PENDING);
    assert_int_equal(kiriFrame_DetachPiece(host.world, wait.frames[1], &detached), KIRI_PENDING);
    assert_int_equal(kiriFrame_DestroyPiece(host.world, wait.frames[1]), KIRI_PENDING);
    assert_int_equal(kiriWorld_DestroyPieces(host.world, &wait.frames[2], 2), KIRI_ERROR_STATE);
    assert_int_equal(kiriSheet_DropCrumbs(host.world, wait.sheet, 0.001f, &dropped), KIRI_OK);
    assert_int_equal(dropped, 0);
    int32_t done = 0;
    kiriResult result;
    do {
        result = Host_Tick(&host, 1.0f / 60.0f, 1);
        done += Host_Events(&host, KIRI_EVENT_PIECE_DETACHED, NULL);
    } while (result == KIRI_PENDING);
    assert_int_equal(done, 1);
    assert_int_equal(Host_SheetCount(&host), 2);
    assert_float_equal(Host_Totals(&host, wait.sheet).area, 0.5, 0.03);
}

/* The largest piece waits to be detached: crumbs are below the next one, too, for the sheet must not be left empty. */
TEST(CrumbsWhileTheLargestLeaves)
{
    static const kiriBudget budget = { 0, 30, 20, 0 };
    HOST(host);
    Wait wait = StartWait(&host, &budget);
    kiriSheet detached;
    int32_t dropped;
    kiriPieceState largest = World_PieceState(host.world, wait.sheet, 0);
    kiriPieceState other = World_PieceState(host.world, wait.sheet, 1);
    assert_true(largest.area > other.area);
    assert_int_equal(kiriFrame_DetachPiece(host.world, wait.frames[0], &detached), KIRI_PENDING);
    assert_true(kiriSheet_DropCrumbs(host.world, wait.sheet, 10.0f, &dropped) >= 0);
    assert_int_equal(dropped, 2);
    while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
    }
    assert_int_equal(Host_SheetCount(&host), 2);
    assert_int_equal(Host_Counts(&host, wait.sheet).pieces, 1);
}

/* ---- On a floor ---- */

/* Four strips slide down a slope, and in the second world one goes. The contacts of the others are remembered, whatever number
   the vertices of a strip get. A part has its own patches, so other vertices touch. */
TEST(TouchesGoOn)
{
    for (int detach = 0; detach < 2; ++detach) {
        HOST_PAIR(hosts);
        kiriSheet sheets[2], made = 0;
        for (int k = 0; k < 2; ++k) {
            Host_Start(&hosts[k]);
            kiriObstacleDef floor = ObstacleOf(KIRI_OBSTACLE_PLANE);
            static const float gravity[3] = { 1.0f, 0.0f, -9.7f };
            OK(kiriWorld_SetGravity(hosts[k].world, gravity));
            World_AddObstacle(hosts[k].world, &floor);
            kiriSheetDef def = DefOf(16);
            def.position[2] = 0.02f;
            sheets[k] = Chop(&hosts[k], &def, 1, 4);
            for (int i = 0; i < 40; ++i) {
                assert_true(Host_Tick(&hosts[k], 1.0f / 60.0f, 2) >= 0);
            }
        }
        assert_int_equal(Host_Hash(&hosts[0]), Host_Hash(&hosts[1]));
        kiriFrame gone = Host_FrameOf(&hosts[1], sheets[1], 1), left = Host_FrameOf(&hosts[1], sheets[1], 2);
        OK(detach ? kiriFrame_DetachPiece(hosts[1].world, gone, &made) : kiriFrame_DestroyPiece(hosts[1].world, gone));
        for (int i = 0; i < 5; ++i) {
            kiriFrameState states[2];
            for (int k = 0; k < 2; ++k) {
                assert_true(Host_Tick(&hosts[k], 1.0f / 60.0f, 2) >= 0);
                OK(kiriFrame_GetState(hosts[k].world, detach ? gone : left, &states[k]));
            }
            for (int d = 0; d < 3; ++d) {
                assert_float_equal(states[0].position[d], states[1].position[d], 1e-4);
                assert_float_equal(states[0].velocity[d], states[1].velocity[d], 5e-3);
            }
        }
    }
}

/* ---- Without memory ---- */

/* Asks for both, and returns how many ticks it takes until they are done. In the last one memory is refused from an
   allocation on, unless that is below 0. */
static int32_t RunWait(Host* host, Wait* wait, int32_t ticks, int32_t refuseFrom, kiriResult* last)
{
    static const kiriBudget budget = { 0, 30, 0, 0 };
    kiriSheet detached;
    int32_t done = 0;
    *wait = StartWait(host, &budget);
    assert_int_equal(kiriFrame_DestroyPiece(host->world, wait->frames[0]), KIRI_PENDING);
    assert_int_equal(kiriFrame_DetachPiece(host->world, wait->frames[1], &detached), KIRI_PENDING);
    for (*last = KIRI_PENDING; *last == KIRI_PENDING && done < ticks; ++done) {
        host->failAt = done + 1 == ticks && refuseFrom >= 0 ? host->calls + refuseFrom : -1;
        host->failOnce = false;
        *last = kiriWorld_Tick(host->world, 1.0f / 60.0f, 1);
        host->failAt = -1;
        if (done + 2 >= ticks) { /* the last two ticks: other tests validate the others */
            Host_Validate(host);
        }
    }
    return done;
}

/* Memory that is refused in the tick in which pieces go is an error of that tick, and they wait on: no more. */
TEST(WaitingIsPatient)
{
    int32_t refused = 0, ticks;
    bool isDone = false;
    Host host;
    Wait wait;
    kiriResult result;
    ticks = RunWait(&host, &wait, 10000, -1, &result);
    assert_int_equal(result, KIRI_OK);
    assert_int_equal(Host_SheetCount(&host), 2);
    Host_Stop(&host);
    for (int32_t at = 0; !isDone; at += IS_SANITIZED ? 13 : 5) {
        assert_int_equal(RunWait(&host, &wait, ticks, at, &result), ticks);
        isDone = result == KIRI_OK;
        assert_true(isDone || result == KIRI_ERROR_MEMORY);
        refused += result == KIRI_ERROR_MEMORY;
        while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
        }
        assert_int_equal(Host_SheetCount(&host), 2);
        assert_int_equal(Host_Counts(&host, wait.sheet).pieces, 3);
        Host_Stop(&host);
    }
    assert_true(refused > 10);
}

/* ---- Sheets whose grid carries few frames ---- */

/* The sheet has a frame for two cells at most, and the call comes back. What work a cut may then make is bounded by the
   cells, too. */
static void TryShape(float width, float height, int32_t columns, int32_t rows, int32_t resolution, int32_t frames,
                     float rigidArea)
{
    START_HOST(host);
    kiriSheetDef def = SheetOf(resolution, frames);
    def.rigidArea = rigidArea;
    def.maxFrames = 60;
    kiriSheet sheet = Host_AddRectangle(&host, &def, width, height, columns, rows);
    int32_t cells = Host_Counts(&host, sheet).cells, made = Host_Counts(&host, sheet).frames;
    assert_true(made == 1 || (made <= frames && 2 * made <= cells));
    float u = 0.37f * width, v = 0.41f * height;
    float across[4] = { u, -height, u, 2.0f * height },
          square[10] = { u, v, u, 0.7f * height, 0.8f * width, 0.7f * height, 0.8f * width, v, u, v };
    Host_Cut(&host, sheet, across, 2);
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    OK(kiriFrame_DestroyPiece(host.world, Host_FrameOf(&host, sheet, 0)));
    Host_Cut(&host, sheet, square, 5);
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    kiriProfile profile = World_Profile(host.world);
    cells = Host_Counts(&host, sheet).cells;
    assert_true(profile.cellsSettled < 200 * (cells + 10)); /* measured: 29 */
    assert_in_range(Host_Counts(&host, sheet).frames, 1, cells);
}

/* What used to hang: more frames than cells, by count or by rigidArea. */
TEST(FewCells)
{
    static const int32_t resolutions[] = { 1, 2, 3, 4, 8, 24, 96 }, frames[] = { 1, 2, 5, 24 };
    static const float heights[] = { 0.01f, 0.1f, 1.0f }, rigidAreas[] = { 0.0f, 1e-4f, 5e-3f };
    for (int r = 0; r < 7; ++r) {
        for (int f = 0; f < 4; ++f) {
            for (int k = 0; k<9; k += resolutions[r]> 8 ? 3 : 1) {
                TryShape(1.0f, heights[k % 3], 8, 1 + 3 * (k % 3), resolutions[r], frames[f], rigidAreas[k / 3]);
            }
        }
    }
}
