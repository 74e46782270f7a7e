/* Triangles that lie on the lines of the grid, by themselves or in a net with holes: regions without width, or with a
   moment that rounds below zero. All numbers stay finite. */
#include "host.h"

enum { MOST = 12 };

typedef struct Net {
    float positions[2 * (MOST + 1) * (MOST + 1) + 12 * MOST * MOST];
    int32_t indices[6 * MOST * MOST];
    int32_t vertices, triangles;
} Net;

/* A triangle of a square of the net; by itself it has its own corners. */
static void AddTriangle(Net* net, int32_t squares, int32_t corners[3][2], bool isAlone)
{
    for (int k = 0; k < 3; ++k) {
        int32_t vertex = isAlone ? net->vertices++ : corners[k][0] + corners[k][1] * (squares + 1);
        net->positions[2 * vertex] = (float)corners[k][0] / (float)squares;
        net->positions[2 * vertex + 1] = (float)corners[k][1] / (float)squares;
        net->indices[3 * net->triangles + k] = vertex;
    }
    ++net->triangles;
}

/* Squares of the net, halved either way, of which some halves are left out. */
static void MakeNet(Net* net, int32_t squares, bool isAlone, uint32_t* seed)
{
    static const int32_t halves[4][3][2] = { { { 0, 0 }, { 1, 0 }, { 1, 1 } },
                                             { { 0, 0 }, { 1, 1 }, { 0, 1 } },
                                             { { 0, 0 }, { 1, 0 }, { 0, 1 } },
                                             { { 1, 0 }, { 1, 1 }, { 0, 1 } } };
    net->triangles = 0;
    net->vertices = isAlone ? 0 : (squares + 1) * (squares + 1);
    for (int32_t square = 0; square < squares * squares; ++square) {
        int32_t way = 2 * (int32_t)(Random(seed) % 2);
        for (int32_t half = way; half < way + 2; ++half) {
            int32_t corners[3][2];
            for (int k = 0; k < 3; ++k) {
                corners[k][0] = square % squares + halves[half][k][0];
                corners[k][1] = square / squares + halves[half][k][1];
            }
            if (net->triangles == 0 || Random(seed) % 3 > 0) {
                AddTriangle(net, squares, corners, isAlone);
            }
        }
    }
}

/* The caller's mesh has no vertices without triangles. */
static void DropUnused(Net* net)
{
    int32_t to[(MOST + 1) * (MOST + 1) + 6 * MOST * MOST], count = 0;
    memset(to, -1, sizeof(to));
    for (int32_t k = 0; k < 3 * net->triangles; ++k) {
        to[net->indices[k]] = 0;
    }
    for (int32_t v = 0; v < net->vertices; ++v) {
        if (to[v] == 0) {
            to[v] = count;
            net->positions[2 * count] = net->positions[2 * v];
            net->positions[2 * count + 1] = net->positions[2 * v + 1];
            ++count;
        }
    }
    for (int32_t k = 0; k < 3 * net->triangles; ++k) {
        net->indices[k] = to[net->indices[k]];
    }
    net->vertices = count;
}

static void CheckFinite(const Host* host, kiriSheet sheet)
{
    kiriTotals totals = Host_Totals(host, sheet);
    kiriMesh mesh = Host_Mesh(host, sheet);
    assert_true(isfinite(totals.elasticEnergy) && isfinite(totals.kineticEnergy) && totals.elasticEnergy >= 0.0);
    assert_true(AllFinite(mesh.positions, 3 * (int64_t)mesh.vertexCount));
    assert_true(AllFinite(mesh.normals, 3 * (int64_t)mesh.vertexCount));
}

static void RunNet(uint32_t run)
{
    static Net net;
    static const kiriWind air = { { 1.0f, -2.0f, 3.0f }, 1.2f, 1.2f, 0.01f };
    uint32_t seed = 7u * run + 1u;
    int32_t squares = 1 + (int32_t)(Random(&seed) % MOST);
    kiriSheet sheet;
    START_HOST(host);
    host.every = 4;
    kiriSheetDef def = DefaultSheet();
    MakeNet(&net, squares, run % 2 == 0, &seed);
    DropUnused(&net);
    def.restPositions = net.positions;
    def.indices = net.indices;
    def.vertexCount = net.vertices;
    def.triangleCount = net.triangles;
    def.gridResolution = squares * (1 + (int32_t)(Random(&seed) % 2));
    def.frameCount = 1 + (int32_t)(Random(&seed) % 6);
    def.maxFrames = 40;
    def.snapDistance = Random(&seed) % 3 == 0 ? 1.0f : 0.0f;
    def.model = (int32_t)(Random(&seed) % 3);
    def.planar = Random(&seed) % 4 == 0;
    def.skinning = Random(&seed) % 2 ? KIRI_SKINNING_SMOOTH : KIRI_SKINNING_LINEAR;
    def.paper.integrationPoints = def.model == KIRI_MODEL_POINTS ? (int32_t)(Random(&seed) % 60) : 0;
    def.paper.integrationOrder = 1 + (int32_t)(Random(&seed) % 2);
    kiriResult result = kiriCreateSheet(host.world, &def, &sheet);
    if (result == KIRI_OK) {
        OK(kiriSheet_SetWind(host.world, sheet, &air));
        CheckFinite(&host, sheet);
        for (int32_t tick = 0; tick < 4; ++tick) {
            if (tick == 2) {
                float at = (float)(1 + (int32_t)(Random(&seed) % 7)) / 8.0f;
                Host_Cut(&host, sheet, (float[]){ at, -0.1f, at, 1.1f }, 2);
            }
            OK(Host_Tick(&host, 1.0f / 60.0f, 2));
            CheckFinite(&host, sheet);
        }
    } else {
        assert_true(result == KIRI_ERROR_ARGUMENT || result == KIRI_ERROR_MESH);
    }
}

TEST(Nets)
{
    for (uint32_t run = 1; run <= 150; ++run) {
        RunNet(run);
    }
}
