/* Normals are made where the host asks for them: without them all else is the same. */
#include "host.h"

#include <math.h>
#include <string.h>

enum { SHEETS = 3, TICKS = 60 };

static const float dt = 1.0f / 60.0f;

typedef struct Pile {
    Host host;
    kiriSheet sheets[SHEETS];
} Pile;

/* Sheets over the edges of a box, each a little above the one before. */
static void Start(Pile* pile, int32_t normals, int32_t skinning, int32_t touches)
{
    Host_Start(&pile->host);
    kiriObstacleDef box = ObstacleOf(KIRI_OBSTACLE_BOX);
    Set3(box.size, 0.3f, 0.4f, 0.2f);
    World_AddObstacle(pile->host.world, &box);
    for (int32_t i = 0; i < SHEETS; ++i) {
        kiriSheetDef def = Host_SmallDef();
        Set3(def.position, -0.4f + 0.05f * (float)i, -0.45f, 0.21f + 0.03f * (float)i);
        def.touchesSheets = touches;
        def.contactThickness = 0.01f;
        def.normals = normals;
        def.skinning = skinning;
        pile->sheets[i] = Host_AddRectangle(&pile->host, &def, 1.0f, 1.0f, 6, 6);
    }
}

static void CheckSame(const Pile* with, const Pile* without)
{
    assert_true(Host_Hash(&with->host) == Host_Hash(&without->host));
    for (int32_t i = 0; i < SHEETS; ++i) {
        kiriMesh a = Host_Mesh(&with->host, with->sheets[i]), b = Host_Mesh(&without->host, without->sheets[i]);
        assert_int_equal(a.vertexCount, b.vertexCount);
        assert_memory_equal(a.positions, b.positions, 3 * sizeof(float) * (size_t)a.vertexCount);
        assert_true(a.normals != NULL && b.normals == NULL);
    }
}

static void CheckSolid(const Pile* with, const Pile* without, int32_t i)
{
    kiriSolid a, b;
    OK(kiriSheet_GetSolid(with->host.world, with->sheets[i], 0.02f, &a));
    OK(kiriSheet_GetSolid(without->host.world, without->sheets[i], 0.02f, &b));
    assert_int_equal(a.vertexCount, b.vertexCount);
    assert_memory_equal(a.positions, b.positions, 3 * sizeof(float) * (size_t)a.vertexCount);
    assert_memory_equal(a.normals, b.normals, 3 * sizeof(float) * (size_t)a.vertexCount);
}

static void CheckPoints(const Pile* with, const Pile* without)
{
    for (int32_t k = 0; k < 121; ++k) {
        const float at[2] = { 0.1f * (float)(k % 11), 0.1f * (float)(k / 11) };
        kiriPointState a = World_PointState(with->host.world, with->sheets[k % SHEETS], at);
        kiriPointState b = World_PointState(without->host.world, without->sheets[k % SHEETS], at);
        for (int c = 0; c < 3; ++c) {
            assert_true(fabsf(a.normal[c] - b.normal[c]) < 1e-5f);
        }
    }
}

/* With contacts at edges, with sheets that touch each other or do not, and with cuts that take effect. */
TEST(AllElseIsTheSame)
{
    for (int32_t which = 0; which < 4; ++which) {
        const int32_t skinning = which % 2, touches = which / 2;
        static const float line[4] = { -0.1f, 0.4f, 0.6f, 0.55f }, across[4] = { -0.1f, 0.2f, 1.1f, 0.3f };
        Pile piles[2];
        kiriProfile profile;
        int32_t contacts = 0, pairs = 0;
        for (int way = 0; way < 2; ++way) {
            Start(&piles[way], way == 0, skinning, touches);
        }
        for (int32_t t = 0; t < TICKS; ++t) {
            for (int way = 0; way < 2; ++way) {
                if (t == 10 || t == 30) {
                    Host_Cut(&piles[way].host, piles[way].sheets[t / 20], t == 10 ? line : across, 2);
                }
                assert_true(Host_Tick(&piles[way].host, dt, 2) >= 0);
            }
            OK(kiriWorld_GetProfile(piles[1].host.world, &profile));
            contacts += profile.contacts;
            pairs += profile.sheetPairs;
            CheckSame(&piles[0], &piles[1]);
            if (t % 20 == 5) {
                CheckPoints(&piles[0], &piles[1]);
                CheckSolid(&piles[0], &piles[1], t / 20);
            }
        }
        assert_true(contacts > 100 && (pairs > 20) == (touches != 0));
        Host_Stop(&piles[0].host);
        Host_Stop(&piles[1].host);
    }
}

/* Normals that are asked for in between are there at once; those of a sheet that makes none are refused. */
TEST(NormalsComeAndGo)
{
    Pile piles[2];
    float copied[3];
    for (int way = 0; way < 2; ++way) {
        Start(&piles[way], way == 0, KIRI_SKINNING_LINEAR, 1);
        Host_Ticks(&piles[way].host, 20, dt, 2);
    }
    kiriWorld* world = piles[1].host.world;
    kiriSheet sheet = piles[1].sheets[0];
    assert_int_equal(kiriSheet_CopyVertices(world, sheet, 0, 1, NULL, 0, copied, 12), KIRI_ERROR_STATE);
    OK(kiriSheet_CopyVertices(world, sheet, 0, 1, copied, 12, NULL, 0));
    kiriSheetSettings settings = World_Settings(world, sheet);
    assert_int_equal(settings.normals, 0);
    settings.normals = 1;
    OK(kiriSheet_SetSettings(world, sheet, &settings));
    for (int32_t t = 0; t < 2; ++t) {
        kiriMesh a = Host_Mesh(&piles[0].host, piles[0].sheets[0]), b = Host_Mesh(&piles[1].host, sheet);
        assert_non_null(b.normals);
        assert_memory_equal(a.normals, b.normals, 3 * sizeof(float) * (size_t)a.vertexCount);
        OK(Host_Tick(&piles[0].host, dt, 2));
        OK(Host_Tick(&piles[1].host, dt, 2));
    }
    settings.normals = 0;
    OK(kiriSheet_SetSettings(world, sheet, &settings));
    assert_null(Host_Mesh(&piles[1].host, sheet).normals);
    Host_Stop(&piles[0].host);
    Host_Stop(&piles[1].host);
}
