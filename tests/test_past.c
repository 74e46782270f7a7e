/* Where vertices were when the last tick began: kiriSheet_CopyPrevious, whatever cuts and pieces that went have
   changed. */
#include "host.h"

#include <stdio.h>

enum { MOST_SHEETS = 64 };

/* The host keeps this of each sheet before a tick. */
typedef struct Copy {
    kiriSheet sheet;
    float *rest, *positions;
    int32_t count;
    uint8_t *isUsed, *isFound; /* of each vertex; what pieces that went have left is of no triangle */
} Copy;

typedef struct Past {
    Host host;
    uint32_t seed;
    Copy copies[MOST_SHEETS];
    int32_t copyCount;
    bool mayLose;                         /* something has been destroyed since */
    bool areStill;                        /* nothing moves */
    int64_t new, torn, moved, fromOthers; /* vertices */
} Past;

static double Between(Past* past, double low, double high)
{
    return RandomBetween(&past->seed, low, high);
}

static void Forget(Past* past)
{
    for (int32_t i = 0; i < past->copyCount; ++i) {
        free(past->copies[i].rest);
        free(past->copies[i].positions);
        free(past->copies[i].isUsed);
        free(past->copies[i].isFound);
    }
    past->copyCount = 0;
    past->mayLose = false;
}

static void* CopyOf(const void* data, size_t bytes)
{
    return memcpy(malloc(bytes), data, bytes);
}

static uint8_t* MarkUsed(const kiriMesh* mesh)
{
    uint8_t* isUsed = calloc((size_t)mesh->vertexCount, 1);
    for (int32_t t = 0; t < mesh->triangleCount; ++t) {
        const int32_t* c = &mesh->indices[3 * t];
        for (int k = 0; k < 3 && c[0] != c[1]; ++k) {
            isUsed[c[k]] = 1;
        }
    }
    return isUsed;
}

static void CopyAll(Past* past)
{
    Forget(past);
    for (int32_t i = 0; i < Host_SheetCount(&past->host); ++i) {
        kiriSheet sheet = Host_SheetAt(&past->host, i);
        kiriMesh mesh = Host_Mesh(&past->host, sheet);
        size_t count = (size_t)mesh.vertexCount;
        assert_true(past->copyCount < MOST_SHEETS);
        past->copies[past->copyCount++] = (Copy){ sheet,
                                                  CopyOf(mesh.restPositions, 8 * count),
                                                  CopyOf(mesh.positions, 12 * count),
                                                  mesh.vertexCount,
                                                  MarkUsed(&mesh),
                                                  malloc(count) };
    }
}

static Copy* FindCopy(Past* past, kiriSheet sheet)
{
    for (int32_t i = 0; i < past->copyCount; ++i) {
        if (past->copies[i].sheet == sheet) {
            return &past->copies[i];
        }
    }
    return NULL;
}

static int CompareRests(const void* a, const void* b)
{
    return memcmp(a, b, 8);
}

/* A vertex that was not there lies where none was. */
static void CheckNew(const Copy* sorted, const float* rest)
{
    if (sorted->count > 0 && bsearch(rest, sorted->rest, (size_t)sorted->count, 8, CompareRests) != NULL) {
        fail_msg("a vertex at %g %g is said to be new", rest[0], rest[1]);
    }
}

static void CheckVertex(Past* past, Copy* copy, const kiriMesh* mesh, int32_t v, int32_t was, bool isUsed)
{
    assert_in_range(was, 0, copy->count - 1);
    assert_memory_equal(&copy->rest[2 * was], &mesh->restPositions[2 * v], 8);
    past->torn += copy->isFound[was];
    past->moved += was != v;
    copy->isFound[was] = 1;
    for (int k = 0; k < 3 && past->areStill && isUsed; ++k) {
        float way = mesh->positions[3 * v + k] - copy->positions[3 * was + k];
        if (!(fabsf(way) < 1e-4f)) {
            fail_msg("vertex %d, which was %d, has gone %g m", v, was, way);
        }
    }
}

static void CheckSheet(Past* past, kiriSheet sheet)
{
    kiriMesh mesh = Host_Mesh(&past->host, sheet);
    FREED(int32_t, was) = malloc(sizeof(int32_t) * (size_t)mesh.vertexCount);
    uint8_t* isUsed = MarkUsed(&mesh);
    kiriSheet from = 0;
    OK(kiriSheet_CopyPrevious(past->host.world, sheet, 0, mesh.vertexCount, was, &from));
    Copy* copy = FindCopy(past, from);
    Copy sorted = { 0,    copy != NULL ? CopyOf(copy->rest, 8 * (size_t)copy->count) : NULL,
                    NULL, copy != NULL ? copy->count : 0,
                    NULL, NULL };
    if (copy != NULL) {
        qsort(sorted.rest, (size_t)sorted.count, 8, CompareRests);
    }
    past->fromOthers += from != sheet;
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        if (was[v] == -1) {
            CheckNew(&sorted, &mesh.restPositions[2 * v]);
            ++past->new;
        } else {
            assert_non_null(copy);
            CheckVertex(past, copy, &mesh, v, was[v], isUsed[v]);
        }
    }
    free(sorted.rest);
    free(isUsed);
}

/* Checks all sheets, at any time between ticks. Every vertex of a copy is found again, unless it was destroyed. */
static void Check(Past* past)
{
    for (int32_t i = 0; i < past->copyCount; ++i) {
        memset(past->copies[i].isFound, 0, (size_t)past->copies[i].count);
    }
    for (int32_t i = 0; i < Host_SheetCount(&past->host); ++i) {
        CheckSheet(past, Host_SheetAt(&past->host, i));
    }
    for (int32_t i = 0; i < past->copyCount && !past->mayLose; ++i) {
        for (int32_t v = 0; v < past->copies[i].count; ++v) {
            assert_true(past->copies[i].isFound[v] || !past->copies[i].isUsed[v]);
        }
    }
}

/* ---- A storm ---- */

static void AddSheet(Past* past)
{
    int32_t squares = Random(&past->seed) % 3 == 0 ? 68 : 4 + (int32_t)(Random(&past->seed) % 20);
    kiriSheetDef def = DefaultSheet();
    kiriPinDef pin = DefaultPin();
    def.gridResolution = 16;
    def.frameCount = 4;
    def.maxFrames = 64;
    def.position[0] = (float)Between(past, -3.0, 3.0);
    kiriSheet sheet = World_AddRectangle(past->host.world, 1.0f, 1.0f, squares, squares, &def);
    pin.target[0] = def.position[0];
    World_AddPin(past->host.world, sheet, &pin);
}

static kiriSheet AnySheet(Past* past)
{
    return Host_SheetAt(&past->host, (int32_t)(Random(&past->seed) % (uint32_t)Host_SheetCount(&past->host)));
}

static void Cut(Past* past)
{
    float line[8];
    for (int k = 0; k < 8; ++k) {
        line[k] = (float)Between(past, -0.2, 1.2);
    }
    Host_Cut(&past->host, AnySheet(past), line, 4);
}

static kiriFrame FrameOfAnyPiece(Past* past, kiriSheet sheet)
{
    int32_t pieces = Host_Counts(&past->host, sheet).pieces;
    for (int i = 0; i < 8; ++i) { /* some may be gone */
        const kiriFrame* frames;
        int32_t count;
        kiriResult result = kiriSheet_GetPieceFrames(
            past->host.world, sheet, (int32_t)(Random(&past->seed) % (uint32_t)pieces), &frames, &count);
        if (result == KIRI_OK && count > 0 && frames[0] != 0) {
            return frames[0];
        }
    }
    return 0;
}

static void TakePiece(Past* past)
{
    kiriSheet sheet = AnySheet(past), made;
    kiriFrame frame = FrameOfAnyPiece(past, sheet);
    int32_t count;
    switch (frame != 0 ? Random(&past->seed) % 4 : 4) {
    case 0:
    case 1:
        if (Host_SheetCount(&past->host) < MOST_SHEETS / 2) {
            kiriFrame_DetachPiece(past->host.world, frame, &made);
        }
        break;
    case 2:
        past->mayLose = true;
        kiriFrame_DestroyPiece(past->host.world, frame);
        break;
    case 3:
        past->mayLose = true;
        kiriSheet_DropCrumbs(past->host.world, sheet, 0.01f, &count);
        break;
    default:
        break;
    }
}

static void ChangeBudget(Past* past)
{
    static const kiriBudget budgets[] = { { 0, 0, 0, 0 }, { 64, 2000, 300, 20 }, { 0, 500, 100, 0 } };
    OK(kiriWorld_SetBudget(past->host.world, &budgets[Random(&past->seed) % 3]));
}

/* The world as it is now, from its own snapshot: all that is in it is new. */
static void Load(Past* past)
{
    World_Copy(past->host.world, past->host.world, kiriWorld_Snapshot);
    Forget(past);
}

static void Act(Past* past)
{
    switch (Random(&past->seed) % 16) {
    case 0:
        if (Host_SheetCount(&past->host) < 6) {
            AddSheet(past);
        }
        break;
    case 1:
        ChangeBudget(past);
        break;
    case 2:
        if (Random(&past->seed) % 8 == 0) {
            Load(past);
        } else if (Host_SheetCount(&past->host) > 3) {
            past->mayLose = true;
            OK(kiriDestroySheet(past->host.world, AnySheet(past)));
        }
        break;
    case 3:
    case 4:
    case 5:
        Cut(past);
        break;
    default:
        TakePiece(past);
        break;
    }
}

/* Some ticks, and some calls, are refused memory. */
static void Tick(Past* past)
{
    Host* host = &past->host;
    CopyAll(past);
    if (Random(&past->seed) % 16 == 0) {
        assert_int_equal(kiriWorld_Tick(host->world, -1.0f, 1), KIRI_ERROR_ARGUMENT);
        Check(past);
    }
    host->failAt = Random(&past->seed) % 4 == 0 ? host->calls + (int64_t)(Random(&past->seed) % 40) : -1;
    host->failOnce = true;
    kiriResult result = Host_Tick(host, 1.0f / 60.0f, 1);
    host->failAt = -1;
    assert_true(result == KIRI_OK || result == KIRI_PENDING || result == KIRI_ERROR_MEMORY);
    Check(past);
}

TEST(FollowsAStorm)
{
    int64_t moved = 0, torn = 0, fromOthers = 0, new = 0;
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        Past past = { .seed = seed * 7919 };
        Host_Start(&past.host);
        past.host.every = 20;
        past.areStill = seed % 2 == 0;
        if (past.areStill) {
            World_StopGravity(past.host.world);
        }
        AddSheet(&past);
        Check(&past);
        for (int tick = 0; tick < 50; ++tick) {
            for (uint32_t acts = Random(&past.seed) % 5; acts > 0; --acts) {
                Act(&past);
                Check(&past);
            }
            Tick(&past);
        }
        moved += past.moved;
        torn += past.torn;
        fromOthers += past.fromOthers;
        new += past.new;
        Forget(&past);
        Host_Stop(&past.host);
    }
    assert_true(moved > 1000 && torn > 50 && fromOthers > 20 && new > 1000);
}

TEST(CostsNothingWhereNothingChanges)
{
    Past past = { .seed = 3 };
    Host_Start(&past.host);
    AddSheet(&past);
    Tick(&past);
    Tick(&past);
    int64_t calls = past.host.calls, bytes = past.host.bytes;
    past.host.failAt = -1;
    Host_Ticks(&past.host, 10, 1.0f / 60.0f, 1);
    assert_true(past.host.calls == calls && past.host.bytes == bytes);
    kiriSheet sheet = Host_SheetAt(&past.host, 0), from;
    int32_t vertices[2];
    OK(kiriSheet_CopyPrevious(past.host.world, sheet, 3, 2, vertices, &from));
    assert_true(vertices[0] == 3 && vertices[1] == 4 && from == sheet);
    Forget(&past);
    Host_Stop(&past.host);
}

TEST(Refuses)
{
    Past past = { .seed = 3 };
    Host_Start(&past.host);
    AddSheet(&past);
    const kiriWorld* world = past.host.world;
    kiriSheet sheet = Host_SheetAt(&past.host, 0), from;
    int32_t vertices[4], count = Host_Counts(&past.host, sheet).vertices;
    assert_int_equal(kiriSheet_CopyPrevious(NULL, sheet, 0, 1, vertices, &from), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopyPrevious(world, sheet + 1, 0, 1, vertices, &from), KIRI_ERROR_ID);
    assert_int_equal(kiriSheet_CopyPrevious(world, sheet, 0, 1, NULL, &from), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopyPrevious(world, sheet, 0, 1, vertices, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopyPrevious(world, sheet, -1, 1, vertices, &from), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopyPrevious(world, sheet, count - 3, 4, vertices, &from), KIRI_ERROR_ARGUMENT);
    OK(kiriSheet_CopyPrevious(world, sheet, count, 0, NULL, &from));
    OK(kiriSheet_CopyPrevious(world, sheet, count - 4, 4, vertices, &from));
    int32_t sources[4];
    float weights[36];
    assert_int_equal(kiriSheet_CopySources(NULL, sheet, 0, 1, sources), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopySourceWeights(NULL, sheet, 0, 1, weights), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopySources(world, sheet + 1, 0, 1, sources), KIRI_ERROR_ID);
    assert_int_equal(kiriSheet_CopySourceWeights(world, sheet + 1, 0, 1, weights), KIRI_ERROR_ID);
    assert_int_equal(kiriSheet_CopySources(world, sheet, 0, 1, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopySourceWeights(world, sheet, 0, 1, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopySources(world, sheet, -1, 1, sources), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_CopySourceWeights(world, sheet, 0, INT32_MAX, weights), KIRI_ERROR_ARGUMENT);
    OK(kiriSheet_CopySources(world, sheet, 0, 0, NULL));
    OK(kiriSheet_CopySourceWeights(world, sheet, 0, 0, NULL));
    Host_Stop(&past.host);
}
