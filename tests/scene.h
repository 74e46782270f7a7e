/* A sheet for the tests of the upper floors: a rectangle with slits along its mesh lines, its grid, and a field. */
#ifndef KIRI_TEST_SCENE_H
#define KIRI_TEST_SCENE_H

#include "field/kiri_site.h"
#include "field/kiri_stencil.h"
#include "mesh/kiri_mesh.h"
#include "motion/kiri_frame.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

/* u before v: the order of arguments is the compiler's to choose. */
static inline kiriVec2 RandomVec2(uint32_t* seed, double low, double high)
{
    kiriVec2 p;
    p.x = RandomBetween(seed, low, high);
    p.y = RandomBetween(seed, low, high);
    return p;
}

/* An allocator that counts what is out, and refuses when its budget is spent (negative: never). */
typedef struct Purse {
    int64_t budget;
    int64_t out;
} Purse;

static inline void* PurseAlloc(void* user, int64_t bytes)
{
    Purse* purse = user;
    if (purse->budget == 0) {
        return NULL;
    }
    --purse->budget;
    ++purse->out;
    return malloc((size_t)bytes);
}

static inline void PurseFree(void* user, void* pointer)
{
    --((Purse*)user)->out;
    free(pointer);
}

typedef struct Scene {
    Purse purse;
    kiriMemory memory;
    kiriMeshData mesh;
    kiriGrid grid;
    kiriField field;
    double width, height;
} Scene;

/* Makes the mesh of a zeroed scene that has its memory: columns x rows squares of two triangles. Inner vertices move by
   up to `jitter` of a square. */
static inline void Scene_MakeMesh(Scene* scene, double width, double height, int32_t columns, int32_t rows,
                                  int32_t resolution, double jitter, uint32_t seed)
{
    float* positions = malloc(2 * sizeof(float) * (size_t)((columns + 1) * (rows + 1)));
    int32_t* indices = malloc(6 * sizeof(int32_t) * (size_t)(columns * rows));
    int32_t count = 0;
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= columns; ++i) {
            bool inner = i > 0 && j > 0 && i < columns && j < rows;
            double a = inner ? jitter * RandomBetween(&seed, -1.0, 1.0) : 0.0;
            double b = inner ? jitter * RandomBetween(&seed, -1.0, 1.0) : 0.0;
            positions[2 * (j * (columns + 1) + i)] = (float)(width * (i + a) / columns);
            positions[2 * (j * (columns + 1) + i) + 1] = (float)(height * (j + b) / rows);
        }
    }
    for (int32_t j = 0; j < rows; ++j) {
        for (int32_t i = 0; i < columns; ++i) {
            int32_t a = j * (columns + 1) + i, b = a + columns + 1;
            int32_t corners[6] = { a, a + 1, b + 1, a, b + 1, b };
            memcpy(indices + count, corners, sizeof(corners));
            count += 6;
        }
    }
    scene->width = width;
    scene->height = height;
    kiriFault why;
    if (kiriMesh_Init(&scene->mesh, &scene->memory,
                      &(kiriMeshInput){ positions, (columns + 1) * (rows + 1), indices, count / 3, resolution, 0.0 },
                      &why) != KIRI_OK) {
        fail_msg("%s", why.line);
    }
    kiriMesh_Begin(&scene->mesh);
    free(positions);
    free(indices);
}

/* The same, with memory that is counted. */
static inline void Scene_InitMesh(Scene* scene, double width, double height, int32_t columns, int32_t rows,
                                  int32_t resolution, double jitter, uint32_t seed)
{
    memset(scene, 0, sizeof(*scene));
    scene->purse.budget = -1;
    scene->memory = kiriMemory_Make(PurseAlloc, PurseFree, &scene->purse);
    Scene_MakeMesh(scene, width, height, columns, rows, resolution, jitter, seed);
}

/* Opens the mesh edges that lie on the segment, but for the sheet's outline. */
static inline void Scene_Slit(Scene* scene, double u0, double v0, double u1, double v1)
{
    kiriVec2 from = { u0, v0 }, way = { u1 - u0, v1 - v0 };
    double length = kiriVec2_Length(way), near = 1e-5;
    for (int32_t h = 0; h < 3 * scene->mesh.triangles.count; ++h) {
        kiriLatticePoint ends[2];
        bool on = kiriMesh_Twin(&scene->mesh, h) != KIRI_NONE && !kiriMesh_IsOpen(&scene->mesh, h);
        ends[0] = scene->mesh.vertices.data[kiriMesh_Tail(&scene->mesh, h)].at;
        ends[1] = scene->mesh.vertices.data[kiriMesh_Tail(&scene->mesh, kiriEdge_Next(h))].at;
        for (int k = 0; k < 2; ++k) {
            kiriVec2 p = kiriVec2_Sub(kiriMesh_Local(&scene->mesh, ends[k]), from);
            double along = kiriVec2_Dot(p, way) / length, across = (p.x * way.y - p.y * way.x) / length;
            on = on && along > -near && along < length + near && fabs(across) < near;
        }
        if (on) {
            assert_true(kiriMesh_Open(&scene->mesh, h, false));
        }
    }
}

/* Opens `count` walks of up to `steps` edges from random places: slits, bays, loose pieces. */
static inline void Scene_CutAtRandom(Scene* scene, int32_t count, int32_t steps, uint32_t* seed)
{
    for (int32_t k = 0; k < count; ++k) {
        int32_t h = (int32_t)(Random(seed) % (uint32_t)(3 * scene->mesh.triangles.count));
        for (int32_t s = 0; s < steps && kiriMesh_Twin(&scene->mesh, h) != KIRI_NONE; ++s) {
            assert_true(kiriMesh_Open(&scene->mesh, h, false));
            h = kiriEdge_Next(h);
            for (uint32_t turn = Random(seed) % 3; turn > 0 && kiriMesh_Twin(&scene->mesh, h) != KIRI_NONE; --turn) {
                h = kiriEdge_Next(kiriMesh_Twin(&scene->mesh, h));
            }
        }
    }
}

/* The grid follows the mesh, from the one before. */
static inline void Scene_UpdateGrid(Scene* scene)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    kiriMesh_Commit(&scene->mesh);
    assert_int_equal(kiriGrid_Update(&scene->grid, &scene->mesh, &quota), KIRI_DONE);
    kiriSquares_ClearDirty(&scene->mesh.squares);
    assert_true(kiriField_Resize(&scene->field, &scene->memory, scene->grid.cells.count, KIRI_FIELD_OWNERS));
}

static inline void Scene_BuildGrid(Scene* scene)
{
    kiriGrid_Reset(&scene->grid);
    Scene_UpdateGrid(scene);
}

/* Numbers the pieces in the order of cells, over faces, and returns how many there are; `piece`, of each cell, is the
   caller's to free. */
static inline int32_t Scene_Pieces(const Scene* scene, int32_t** piece)
{
    const kiriGrid* grid = &scene->grid;
    int32_t pieces = 0, *of = malloc(sizeof(int32_t) * (size_t)(grid->cells.count + 1));
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        of[c] = KIRI_NONE;
    }
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        for (int32_t c = grid->squareCell.data[s]; c != KIRI_NONE; c = grid->cells.data[c].next) {
            bool grown = of[c] == KIRI_NONE;
            of[c] = grown ? pieces++ : of[c];
            while (grown) {
                grown = false;
                for (int32_t f = 0; f < grid->faces.count; ++f) {
                    const int32_t* ends = grid->faces.data[f].cell;
                    if (ends[0] != KIRI_NONE && (of[ends[0]] == of[c]) != (of[ends[1]] == of[c])) {
                        of[ends[0]] = of[ends[1]] = of[c];
                        grown = true;
                    }
                }
            }
        }
    }
    *piece = of;
    return pieces;
}

static inline void Scene_Init(Scene* scene, double width, double height, int32_t columns, int32_t rows,
                              int32_t resolution)
{
    Scene_InitMesh(scene, width, height, columns, rows, resolution, 0.0, 1);
}

/* Whatever is out after this was not owned. */
static inline void Scene_Release(Scene* scene)
{
    kiriMemory_FreeAll(&scene->memory);
    assert_int_equal(scene->purse.out, 0);
}

static inline int32_t Scene_Cell(const Scene* scene, double u, double v)
{
    kiriLatticePoint p = kiriMesh_Snap(&scene->mesh, kiriVec2_Make(u, v));
    int32_t triangle = kiriMesh_Locate(&scene->mesh, p);
    assert_int_not_equal(triangle, KIRI_NONE);
    return kiriGrid_CellOf(&scene->grid, triangle, p);
}

static inline kiriSite Scene_MiddleOf(const Scene* scene, int32_t cell)
{
    kiriSite site = { kiriGrid_Middle(&scene->grid, cell), cell };
    return site;
}

/* A site in the middle of the square at a place. */
static inline kiriSite Scene_Site(const Scene* scene, double u, double v)
{
    return Scene_MiddleOf(scene, Scene_Cell(scene, u, v));
}

/* A random sheet with random cuts, and `count` sites at the middles of random cells, after one for every piece. */
static inline void Scene_InitRandom(Scene* scene, kiriSites* sites, int32_t count, uint32_t* seed)
{
    int32_t resolution = 4 + (int32_t)(Random(seed) % 20);
    double height = RandomBetween(seed, 0.3, 1.0);
    Scene_InitMesh(scene, 1.0, height, 13, 11, resolution, 0.2, *seed);
    Scene_CutAtRandom(scene, 12, 14, seed);
    Scene_BuildGrid(scene);
    memset(sites, 0, sizeof(*sites));
    int32_t* piece;
    bool* taken = calloc((size_t)scene->grid.cells.count, sizeof(bool));
    int32_t pieces = Scene_Pieces(scene, &piece);
    for (int32_t p = 0; p < pieces; ++p) {
        int32_t c = 0;
        while (piece[c] != p) {
            ++c;
        }
        taken[c] = true;
        assert_true(kiriArray_Push(&scene->memory, sites, Scene_MiddleOf(scene, c)));
    }
    free(piece);
    for (int32_t k = 0; k < count; ++k) {
        int32_t c = (int32_t)(Random(seed) % (uint32_t)scene->grid.cells.count);
        if (!taken[c]) {
            taken[c] = true;
            assert_true(kiriArray_Push(&scene->memory, sites, Scene_MiddleOf(scene, c)));
        }
    }
    free(taken);
}

static inline void AssertNear(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
    }
}

#endif
