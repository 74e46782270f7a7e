/* A tick without a cut allocates nothing: neither from the host nor behind its back; and few with one do. */
#include "host.h"

#include "layout_hash.h"

/* malloc of the whole program, counted, where the C library lets us stand in front of it. */
#if REPLACES_MALLOC
extern void* __libc_malloc(size_t bytes);
extern void* __libc_calloc(size_t count, size_t bytes);
extern void* __libc_realloc(void* pointer, size_t bytes);

static int64_t taken;

void* malloc(size_t bytes)
{
    ++taken;
    return __libc_malloc(bytes);
}

void* calloc(size_t count, size_t bytes)
{
    ++taken;
    return __libc_calloc(count, bytes);
}

void* realloc(void* pointer, size_t bytes)
{
    ++taken;
    return __libc_realloc(pointer, bytes);
}
#else
static int64_t taken;
#endif

/* What this takes is not the library's. */
static void Validate(const Host* host)
{
    int64_t before = taken;
    Host_Validate(host);
    taken = before;
}

typedef struct Setting {
    int32_t model, planar, order;
} Setting;

/* Everything that acts on a sheet, found anew each tick. */
static void Act(Host* host, kiriSheet sheet, int tick)
{
    kiriFrame frames[64];
    float force[3] = { 0.01f, 0.02f, tick % 2 == 0 ? 0.0f : 0.03f }, torque[3] = { 0.0f, 0.0f, 0.001f };
    float place[3] = { 0.1f, 0.1f + 0.001f * (float)tick, 0.0f };
    kiriContact contacts[4];
    for (int i = 0; i < 4; ++i) {
        kiriContact contact = { .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.001f, .friction = 0.3f };
        contacts[i] = contact;
    }
    World_GetFrames(host->world, sheet, frames, 64);
    OK(kiriFrame_Hold(host->world, frames[0], place, worldAxes));
    OK(kiriFrame_ApplyForce(host->world, frames[1], force, torque));
    OK(kiriSheet_SetContacts(host->world, sheet, contacts, 1 + tick % 4));
    OK(kiriWorld_Tick(host->world, 1.0f / 60.0f, 1 + tick % 3));
    Validate(host);
}

static kiriSheet AddSheet(Host* host, const Setting* setting)
{
    kiriSheetDef def = Host_SmallDef();
    def.framePoints = NULL;
    def.frameCount = 9;
    def.model = setting->model;
    def.planar = setting->planar;
    def.paper.integrationOrder = setting->order;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 6, 6);
    Host_Pin(host, sheet, 0.9f, 0.9f, 0.9f, 0.9f, 0.0f);
    return sheet;
}

TEST(PlainTicks)
{
    static const Setting settings[] = { { KIRI_MODEL_LINKS, 0, 1 },  { KIRI_MODEL_LINKS, 1, 1 },
                                        { KIRI_MODEL_AFFINE, 0, 1 }, { KIRI_MODEL_AFFINE, 1, 1 },
                                        { KIRI_MODEL_POINTS, 0, 2 }, { KIRI_MODEL_POINTS, 1, 1 } };
    static const float across[6] = { -0.1f, 0.4f, 0.5f, 0.45f, 1.1f, 0.4f };
    for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); ++i) {
        START_HOST(host);
        int64_t calls = host.calls, before = taken;
        kiriSheet sheet = AddSheet(&host, &settings[i]);
        assert_true(host.calls > calls);
        assert_true(!REPLACES_MALLOC || taken - before >= host.calls - calls); /* so it does count */
        for (int pass = 0; pass < 2; ++pass) {
            for (int tick = 0; tick < 4; ++tick) {
                Act(&host, sheet, tick);
            }
            calls = host.calls;
            before = taken;
            for (int tick = 4; tick < 40; ++tick) {
                Act(&host, sheet, tick);
            }
            assert_int_equal(host.calls, calls);
            assert_int_equal(taken, before);
            Host_Cut(&host, sheet, across, 3); /* and again for what the cut leaves */
        }
    }
}

/* A long spiral, from its middle, a cell or so a tick. What it leaves grows, and so does the room for it, which
   doubles: so ever fewer ticks ask for memory. */
TEST(CuttingTicks)
{
    enum { TICKS = 800 };
    kiriCut cut;
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = 40;
    def.collisionPoints = 100;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
    int32_t first = 0, second = 0;
    for (int32_t tick = 0; tick < TICKS; ++tick) {
        float t = 75.0f * (float)tick / TICKS, r = 0.02f + 0.44f * (float)tick / TICKS;
        float point[2] = { 0.5f + r * cosf(t), 0.5f + r * sinf(t) };
        OK(tick == 0 ? kiriBeginCut(host.world, sheet, point, &cut) : kiriCut_Extend(host.world, cut, point, 1));
        int64_t calls = host.calls, before = taken;
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
        bool asked = host.calls > calls || taken > before;
        Validate(&host);
        first += asked && tick < TICKS / 2;
        second += asked && tick >= TICKS / 2;
    }
    assert_in_range(first, 1, TICKS / 8);
    assert_in_range(second, 0, 3 * first / 4);
    assert_true(Host_Counts(&host, sheet).vertices > 2000);
}

/* ---- Memory that is refused ---- */

static kiriSheet AddForCut(Host* host, int32_t columns)
{
    static const float way[12] = { -0.1f, 0.4f, 0.3f, 0.6f, 0.5f, 0.2f, 0.7f, 0.7f, 1.1f, 0.4f, 0.9f, 0.3f };
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = columns;
    def.collisionPoints = 40;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, columns, columns);
    OK(kiriWorld_Tick(host->world, 1.0f / 60.0f, 1));
    Host_Cut(host, sheet, way, 6);
    return sheet;
}

/* What a cut leaves when nothing fails. */
static uint64_t LayoutWithoutFailure(int32_t columns)
{
    START_HOST(host);
    AddForCut(&host, columns);
    OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
    uint64_t layout = Layout_HashAll(host.world);
    return layout;
}

/* The triangles that are there, all of vertices that are there. */
static void CheckIndices(const Host* host, kiriSheet sheet, kiriCounts counts)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    assert_int_equal(mesh.triangleCount, counts.triangles);
    assert_int_equal(mesh.vertexCount, counts.vertices);
    for (int32_t i = 0; i < 3 * mesh.triangleCount; ++i) {
        assert_in_range(mesh.indices[i], 0, counts.vertices - 1);
    }
}

/* A cut that a budget spreads over ticks, while each 10th request for memory is refused: it is done within three times
   the ticks, no tick stands still, and nothing is lost. */
TEST(ScarceMemoryIsASpentBudget)
{
    enum { EVERY = 10 };
    const kiriBudget budget = { 64, 700, 700, 0 };
    int32_t ticks[2] = { 0, 0 };
    for (int isScarce = 0; isScarce < 2; ++isScarce) {
        START_HOST(host);
        kiriSheet sheet = AddForCut(&host, 16);
        OK(kiriWorld_SetBudget(host.world, &budget));
        host.failEvery = isScarce ? EVERY : 0;
        for (kiriResult result = KIRI_PENDING; result != KIRI_OK; ++ticks[isScarce]) {
            assert_in_range(ticks[isScarce], 0, 2000);
            result = kiriWorld_Tick(host.world, 1.0f / 60.0f, 1);
            assert_true(result >= 0 || result == KIRI_ERROR_MEMORY);
            Host_Validate(&host);
        }
        host.failEvery = 0;
        CheckIndices(&host, sheet, Host_Counts(&host, sheet));
        assert_true(Layout_HashAll(host.world) == LayoutWithoutFailure(16));
    }
    print_message("%d ticks with all the memory, %d where each %dth request is refused\n", ticks[0], ticks[1], EVERY);
    assert_in_range(ticks[1], ticks[0], 3 * ticks[0]);
}

/* Data that are stored twice show in the sum; also after six cuts, for which arrays grow. Cells take the most where the
   grid is as fine as the mesh. The detail layer of cotton takes 121. */
TEST(BytesOfVertices)
{
    static const struct {
        int32_t grid;
        double most, cut;
    } cases[] = { { 64, 970.0, 1200.0 }, { 16, 530.0, 700.0 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.gridResolution = cases[i].grid;
        int64_t before = host.bytes;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 64, 64);
        assert_true((double)(host.bytes - before) < cases[i].most * 65.0 * 65.0);
        for (int k = 0; k < 6; ++k) {
            kiriCut cut;
            OK(kiriSheet_Cut(host.world, sheet, (float[]){ 0.1f + 0.1f * (float)k, 0.1f, 0.13f + 0.1f * (float)k, 0.8f }, 2, &cut));
            Host_Tick(&host, 1.0f / 60.0f, 1);
        }
        assert_true((double)(host.bytes - before) < cases[i].cut * Host_Counts(&host, sheet).vertices);
    }
}
