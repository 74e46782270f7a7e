/* Sheets and pieces that touch each other. */
#include "host.h"

static int32_t Pairs(const Host* host)
{
    kiriProfile profile;
    OK(kiriWorld_GetProfile(host->world, &profile));
    return profile.sheetPairs;
}

/* A square of stiff paper, 0.2 m wide, whose corner is at a place. */
static kiriSheetDef SquareDef(float x, float y, float z)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material);
    def.gridResolution = 16;
    def.frameCount = 4;
    def.touchesSheets = 1;
    def.contactThickness = 0.004f;
    def.position[0] = x;
    def.position[1] = y;
    def.position[2] = z;
    return def;
}

static kiriSheet AddSquare(Host* host, const kiriSheetDef* def)
{
    kiriSheetDef own = *def;
    return Host_AddRectangle(host, &own, 0.2f, 0.2f, 16, 16);
}

static void TestPairsAreFoundWhereNear(void** state)
{
    (void)state;
    static const float none[3] = { 0.0f, 0.0f, 0.0f };
    const struct {
        float x, z;
        int32_t touches, pairs;
    } cases[] = {
        { 0.05f, 0.003f, 1, 1 }, { 0.05f, -0.003f, 1, 1 }, { 0.05f, 0.05f, 1, 0 }, { 0.25f, 0.003f, 1, 0 },
        { 0.05f, 0.003f, 0, 0 }, { 0.2f, 0.0f, 1, 0 }, /* beside each other in one plane */
    };
    for (int i = 0; i < (int)(sizeof cases / sizeof cases[0]); ++i) {
        Host host;
        Host_Start(&host);
        OK(kiriWorld_SetGravity(host.world, none));
        kiriSheetDef def = SquareDef(0.0f, 0.0f, 0.0f);
        AddSquare(&host, &def);
        def = SquareDef(cases[i].x, 0.02f, cases[i].z);
        def.touchesSheets = cases[i].touches;
        AddSquare(&host, &def);
        OK(Host_Tick(&host, 1.0f / 60.0f, 2));
        assert_int_equal(Pairs(&host), cases[i].pairs);
        Host_Stop(&host);
    }
}

static void TestGroupsApart(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = SquareDef(0.0f, 0.0f, 0.0f);
    def.groups = 1;
    AddSquare(&host, &def);
    def = SquareDef(0.05f, 0.0f, 0.003f);
    def.groups = 2;
    AddSquare(&host, &def);
    OK(Host_Tick(&host, 1.0f / 60.0f, 2));
    assert_int_equal(Pairs(&host), 0);
    Host_Stop(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestPairsAreFoundWhereNear),
        cmocka_unit_test(TestGroupsApart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
