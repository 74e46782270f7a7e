/* Sheets of one frame and of more fall, tilted, on a floor and on what stands there, as the scraps of a game do: they
   gain no energy, are never given up, and do not stretch. */
#include "defaults.h"
#include "kiri/kiri.h"
#include "support.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

enum { SQUARES = 16, TICKS = 400, SUBSTEPS = 2 };

static const float side = 0.34f, height = 0.8f; /* m */

typedef struct Fall {
    int32_t frames, obstacle; /* -1: floor only */
    float tilt;               /* rad */
} Fall;

static void AddObstacle(kiriWorld* world, int32_t type, float z)
{
    kiriObstacle obstacle;
    kiriObstacleDef def = ObstacleOf(type);
    Set3(def.size, 0.42f, 0.40f, 2.0f * z);
    def.radius = z;
    def.position[0] = type == KIRI_OBSTACLE_PLANE ? 0.0f : 0.1f;
    def.position[2] = z;
    assert_int_equal(kiriCreateObstacle(world, &def, &obstacle), KIRI_OK);
}

static kiriSheet AddSheet(kiriWorld* world, const Fall* fall)
{
    static float rest[2 * (SQUARES + 1) * (SQUARES + 1)];
    static int32_t indices[6 * SQUARES * SQUARES];
    kiriSheet sheet;
    kiriFillRectangle(side, side, SQUARES, SQUARES, rest, indices);
    kiriSheetDef def = DefaultSheet();
    def.restPositions = rest;
    def.vertexCount = (SQUARES + 1) * (SQUARES + 1);
    def.indices = indices;
    def.triangleCount = 2 * SQUARES * SQUARES;
    def.position[0] = def.position[1] = -0.5f * side;
    def.position[2] = height;
    def.axisV[1] = cosf(fall->tilt);
    def.axisV[2] = sinf(fall->tilt);
    def.frameCount = fall->frames;
    def.gridResolution = SQUARES;
    def.contactThickness = 0.008f;
    assert_int_equal(kiriCreateSheet(world, &def, &sheet), KIRI_OK);
    return sheet;
}

/* The longer of its two diagonals, from corner to corner. */
static double GetDiagonal(kiriWorld* world, kiriSheet sheet)
{
    enum { ROW = SQUARES + 1 };
    static const int32_t ends[2][2] = { { 0, ROW * ROW - 1 }, { SQUARES, ROW * SQUARES } };
    kiriMesh mesh;
    double longest = 0.0;
    assert_int_equal(kiriSheet_GetMesh(world, sheet, &mesh), KIRI_OK);
    for (int k = 0; k < 2; k++) {
        double square = 0.0;
        for (int i = 0; i < 3; i++) {
            double d = (double)mesh.positions[3 * ends[k][0] + i] - (double)mesh.positions[3 * ends[k][1] + i];
            square += d * d;
        }
        longest = fmax(longest, sqrt(square));
    }
    return longest;
}

static bool TryFall(const Fall* fall)
{
    SCOPED_WORLD(world) = NULL;
    kiriWorldDef def = DefaultWorld();
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_OK);
    AddObstacle(world, KIRI_OBSTACLE_PLANE, 0.0f);
    if (fall->obstacle >= 0) {
        AddObstacle(world, fall->obstacle, fall->obstacle == KIRI_OBSTACLE_BOX ? 0.12f : 0.17f);
    }
    kiriSheet sheet = AddSheet(world, fall);
    double first = World_Energy(world, sheet), most = 0.0, longest = 0.0, length = sqrt(2.0) * (double)side;
    int32_t diverged = 0;
    for (int32_t i = 0; i < TICKS; i++) {
        diverged += kiriWorld_Tick(world, 1.0f / 60.0f, SUBSTEPS) != KIRI_OK;
        most = fmax(most, World_Energy(world, sheet));
        longest = fmax(longest, GetDiagonal(world, sheet));
    }
    bool fine = diverged == 0 && most < 1.02 * first && longest < 1.15 * length;
    if (!fine) {
        printf("%d frames, tilt %.2f, obstacle %d: %d ticks given up, energy %.3g of the first, %.2f times as long\n",
               fall->frames, (double)fall->tilt, fall->obstacle, diverged, most / first, longest / length);
    }
    return fine;
}

TEST(Falls)
{
    static const int32_t frames[] = { 1, 4, 12 }, obstacles[] = { -1, KIRI_OBSTACLE_BOX, KIRI_OBSTACLE_SPHERE };
    static const float tilts[] = { 0.0f, 0.3f, 1.2f, 1.57f };
    int failed = 0;
    for (int f = 0; f < 3; f++) {
        for (int o = 0; o < 3; o++) {
            for (int t = 0; t < 4; t++) {
                const Fall fall = { frames[f], obstacles[o], tilts[t] };
                failed += !TryFall(&fall);
            }
        }
    }
    assert_int_equal(failed, 0);
}
