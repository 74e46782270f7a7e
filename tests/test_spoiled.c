/* Saves whose sum is right, but which say what no world can be: kiriWorld_Load refuses them with one line, and changes
   nothing. A world is made wrong in memory in one way at a time, and saved as it is. */
#include "host.h"

#include "world/kiri_world.h"

typedef void SpoilFn(kiriSheetData* sheet);

typedef struct Spoiler {
    const char* name;
    SpoilFn* spoil;
} Spoiler;

/* ---- Saves ---- */

typedef struct SavedBytes {
    uint8_t* data;
    int64_t size;
} SavedBytes;

static SavedBytes Save(const Host* host)
{
    SavedBytes bytes = { NULL, 0 };
    OK(kiriWorld_Save(host->world, NULL, 0, &bytes.size));
    bytes.data = malloc((size_t)bytes.size);
    OK(kiriWorld_Save(host->world, bytes.data, bytes.size, &bytes.size));
    return bytes;
}

/* A sheet with a slit. */
static void StartCut(Host* host)
{
    const float slit[4] = { 0.1f, 0.3f, 0.8f, 0.36f };
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(host, sheet, slit, 2);
    OK(Host_Tick(host, 0.01f, 1));
}

/* The world of the host is spoiled, and then what it was again. */
static void CheckRefused(Host* host, const Spoiler* spoiler)
{
    Host other;
    Host_Start(&other);
    SavedBytes good = Save(host);
    spoiler->spoil(host->world->sheets.data[0]);
    SavedBytes bad = Save(host);
    uint64_t before = Host_Hash(&other);
    if (kiriWorld_Load(other.world, bad.data, bad.size) != KIRI_ERROR_DATA || Host_Hash(&other) != before) {
        fail_msg("%s: the save is not refused", spoiler->name);
    }
    assert_non_null(strstr(kiriWorld_GetLastError(other.world), "a right sum"));
    OK(kiriWorld_Load(host->world, good.data, good.size));
    OK(kiriWorld_Load(other.world, good.data, good.size));
    free(bad.data);
    free(good.data);
    Host_Stop(&other);
}

static void CheckAllRefused(Host* host, const Spoiler* spoilers, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        CheckRefused(host, &spoilers[k]);
    }
    Host_Stop(host);
}

#define CHECK_ALL_REFUSED(host, spoilers) CheckAllRefused(host, spoilers, sizeof(spoilers) / sizeof((spoilers)[0]))

/* ---- The mesh ---- */

static void HeadIsNoVertex(kiriSheetData* sheet)
{
    sheet->mesh.squares.vertexHead[0] = 1 << 28;
}

static void VertexFollowsItself(kiriSheetData* sheet)
{
    int32_t head = sheet->mesh.squares.vertexHead[0];
    sheet->mesh.vertices.data[head].next = head;
}

static void TwinIsAnother(kiriSheetData* sheet)
{
    sheet->mesh.triangles.data[0].twin[1] = 3 * sheet->mesh.triangles.count - 1;
}

static void TestMesh(void** state)
{
    (void)state;
    static const Spoiler spoilers[] = {
        { "HeadIsNoVertex", HeadIsNoVertex },
        { "VertexFollowsItself", VertexFollowsItself },
        { "TwinIsAnother", TwinIsAnother },
    };
    Host host;
    StartCut(&host);
    CHECK_ALL_REFUSED(&host, spoilers);
}

/* ---- What is no harm ---- */

/* The cell of a point is found anew with the next cut, where the grid was made from scratch: a save may have any. */
static void TestPointOfNoCell(void** state)
{
    (void)state;
    const float slit[4] = { 0.2f, 0.6f, 0.7f, 0.65f };
    Host host;
    StartCut(&host);
    host.world->sheets.data[0]->points.data[0].cell = 1 << 28;
    SavedBytes bytes = Save(&host);
    OK(kiriWorld_Load(host.world, bytes.data, bytes.size));
    free(bytes.data);
    Host_Cut(&host, host.world->sheets.data[0]->id, slit, 2);
    OK(kiriWorld_Tick(host.world, 0.01f, 1));
    Host_Destroy(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestMesh),
        cmocka_unit_test(TestPointOfNoCell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
