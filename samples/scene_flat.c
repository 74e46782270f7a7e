/* A flat game in an upright plane: a disc hangs by four ropes, all of one sheet. Two ropes are cut, the disc is halved
   while it swings, and the halves drop to the floor. Nothing leaves the plane, so the sheet is planar: its frames have
   half of the unknowns. */
#include "scene_parts.h"
#include "scene_types.h"

#include <math.h>
#include <stddef.h>

enum { DISC_SQUARES = 12, ROPES = 4, ROPE_SQUARES = 16 };
enum {
    MAX_VERTICES = (DISC_SQUARES + 1) * (DISC_SQUARES + 1) + 2 * ROPES * ROPE_SQUARES,
    MAX_TRIANGLES = 2 * (DISC_SQUARES * DISC_SQUARES + ROPES * ROPE_SQUARES)
};

/* In metres: so large is the scene. */
typedef struct GameMesh {
    float positions[2 * MAX_VERTICES];
    int32_t indices[3 * MAX_TRIANGLES];
    int32_t vertexCount, triangleCount;
} GameMesh;

/* A rope starts at one side of a square of the disc's upper border, and is pinned at its end. */
typedef struct Rope {
    int32_t square;
    float end[2];
} Rope;

static const Rope ropes[ROPES] = {
    { 1, { -0.7f, 0.72f } },
    { 4, { -0.25f, 0.8f } },
    { 7, { 0.25f, 0.8f } },
    { 10, { 0.7f, 0.72f } },
};

/* Soft, so that ropes hang slack, and light. */
static kiriMaterial Foam(void)
{
    return (kiriMaterial){ .youngsModulus = 1e5f,
                           .poissonsRatio = 0.3f,
                           .thickness = 0.0015f,
                           .density = 200.0f,
                           .airDamping = 0.3f,
                           .flexDamping = 0.01f };
}

/* ---- Mesh ------------------------------------------------------------------------------------------------------- */

static int32_t AddVertex(GameMesh* mesh, float u, float v)
{
    mesh->positions[2 * mesh->vertexCount] = u;
    mesh->positions[2 * mesh->vertexCount + 1] = v;
    return mesh->vertexCount++;
}

static void AddSquare(GameMesh* mesh, int32_t a, int32_t b, int32_t c, int32_t d)
{
    const int32_t corners[6] = { a, b, c, a, c, d };
    for (int i = 0; i < 6; i++) {
        mesh->indices[3 * mesh->triangleCount + i] = corners[i];
    }
    mesh->triangleCount += 2;
}

/* A grid over the square from (-1, -1) to (1, 1), mapped to the disc. */
static void AddDisc(GameMesh* mesh, float radius)
{
    enum { NODES = DISC_SQUARES + 1 };
    for (int32_t i = 0; i < NODES * NODES; i++) {
        float x = 2.0f * (float)(i % NODES) / DISC_SQUARES - 1.0f, y = 2.0f * (float)(i / NODES) / DISC_SQUARES - 1.0f;
        AddVertex(mesh, radius * x * sqrtf(1.0f - 0.5f * y * y), radius * y * sqrtf(1.0f - 0.5f * x * x));
    }
    for (int32_t i = 0; i < DISC_SQUARES * DISC_SQUARES; i++) {
        int32_t a = i / DISC_SQUARES * NODES + i % DISC_SQUARES;
        AddSquare(mesh, a, a + 1, a + NODES + 1, a + NODES);
    }
}

/* Where a rope starts; its right side is one vertex on. */
static int32_t GetRopeStart(const Rope* rope)
{
    return DISC_SQUARES * (DISC_SQUARES + 1) + rope->square;
}

static void AddRope(GameMesh* mesh, const Rope* rope)
{
    const float halfWidth = 0.02f;
    int32_t start = GetRopeStart(rope), last[2] = { start, start + 1 };
    for (int32_t i = 1; i <= ROPE_SQUARES; i++) {
        float share = (float)i / ROPE_SQUARES;
        int32_t next[2];
        for (int k = 0; k < 2; k++) {
            const float* from = mesh->positions + 2 * (start + k);
            float endU = rope->end[0] + (k == 0 ? -halfWidth : halfWidth);
            next[k] = AddVertex(mesh, from[0] + share * (endU - from[0]), from[1] + share * (rope->end[1] - from[1]));
        }
        AddSquare(mesh, last[0], last[1], next[1], next[0]);
        last[0] = next[0];
        last[1] = next[1];
    }
}

/* ---- Scene ------------------------------------------------------------------------------------------------------ */

/* Across the rope, a little above the disc: a long stub would fall over the disc, in the same plane. */
static bool CutRope(Scene* scene, const GameMesh* mesh, const Rope* rope)
{
    const float *left = mesh->positions + 2 * GetRopeStart(rope), *right = left + 2;
    float start[2] = { 0.5f * (left[0] + right[0]), 0.5f * (left[1] + right[1]) };
    float along[2] = { rope->end[0] - start[0], rope->end[1] - start[1] };
    float scale = 0.05f / sqrtf(along[0] * along[0] + along[1] * along[1]);
    float u = start[0] + 0.1f * along[0], v = start[1] + 0.1f * along[1];
    return Scene_AddLine(scene, u - scale * along[1], v + scale * along[0], u + scale * along[1], v - scale * along[0]);
}

static bool StartFlat(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.35f, 0.0f, 0.8f }, (float[]){ 0.0f, 0.0f, 1.0f }, Foam());
    GameMesh mesh = { .vertexCount = 0 };
    AddDisc(&mesh, 0.3f);
    for (int32_t i = 0; i < ROPES; i++) {
        AddRope(&mesh, &ropes[i]);
    }
    def.restPositions = mesh.positions;
    def.vertexCount = mesh.vertexCount;
    def.indices = mesh.indices;
    def.triangleCount = mesh.triangleCount;
    def.planar = 1;
    def.gridResolution = 64;
    def.frameCount = 36;
    def.maxFrames = 48;
    bool fine = Scene_MakeSheet(scene, &def, options, NULL);
    for (int32_t i = 0; fine && i < ROPES; i++) {
        fine = Scene_PinHere(scene, &def, ropes[i].end[0], ropes[i].end[1]);
    }
    return fine && CutRope(scene, &mesh, &ropes[0]) && CutRope(scene, &mesh, &ropes[1]) &&
           Scene_AddLine(scene, 0.12f, 0.33f, -0.12f, -0.33f) && CutRope(scene, &mesh, &ropes[2]) &&
           CutRope(scene, &mesh, &ropes[3]);
}

const SceneType flatScene = {
    .name = "flat",
    .about = "ropes of a disc are cut, it swings in its plane, is halved and drops to the floor",
    .size = 1.0f,
    .ticks = 480,
    .substeps = 4,
    .firstCut = 40,
    .lastCut = 300,
    .moments = { 40, 86, 150, 236, 262, 480 },
    .camera = { { 0.0f, -3.2f, 1.2f }, { 0.0f, -0.1f, 0.76f }, 34.0f },
    .look = { { 0.62f, 0.42f, 0.80f }, { 0.96f, 0.80f, 0.55f }, { 0.93f, 0.30f, 0.12f }, 10.0f },
    .pegs = true,
    .start = StartFlat,
};
