/* All that follows the cuts of a mesh, from grid to samples; for tests that compare it with the same made from scratch.
   */
#ifndef KIRI_TEST_FOLLOW_H
#define KIRI_TEST_FOLLOW_H

#include "scene.h"

#include "mesh/kiri_cut.h"
#include "field/kiri_link.h"
#include "view/kiri_sample.h"
#include "reaches.h"

typedef struct Follow {
    kiriMemory* memory;
    kiriMeshData* mesh;
    kiriGrid grid;
    kiriSites sites;
    KIRI_ARRAY(kiriLatticePoint) anchors; /* of the sites */
    KIRI_ARRAY(kiriSiteMove) moves;
    kiriRegions regions;
    kiriShape shape;
    kiriLinks links;
    kiriRefresh refresh;
    kiriSkin vertexSkin, pointSkin;
    kiriPlaces places;
    kiriSamples points;
    int32_t oldVertices; /* of the last commit */
    int64_t slice;       /* items of a quota; 0: all at once */
    int64_t used;
} Follow;

static inline void Follow_Init(Follow* f, const Scene* scene)
{
    memset(f, 0, sizeof(*f));
    f->memory = (kiriMemory*)&scene->memory;
    f->mesh = (kiriMeshData*)&scene->mesh;
    f->shape.rigidWeight = 0.9;
}

static inline void Follow_Release(Follow* f)
{
    kiriArray_Release(f->memory, &f->sites);
    kiriArray_Release(f->memory, &f->anchors);
    kiriArray_Release(f->memory, &f->moves);
    kiriArray_Release(f->memory, &f->points);
}

/* ---- Sites ---- */

static inline bool Follow_IsTaken(const Follow* f, int32_t cell)
{
    for (int32_t i = 0; i < f->sites.count; ++i) {
        if (f->sites.data[i].cell == cell) {
            return true;
        }
    }
    return false;
}

/* Moves are as kiriRegions_Update wants them. */
static inline void Follow_Move(Follow* f, int32_t frame, kiriSite site)
{
    kiriSiteMove move = { frame, frame < f->sites.count ? f->sites.data[frame].cell : KIRI_NONE };
    kiriLatticePoint anchor = kiriGrid_Anchor(&f->grid, f->mesh, site.cell);
    assert_true(kiriArray_Push(f->memory, &f->moves, move));
    if (frame == f->sites.count) {
        assert_true(kiriArray_Push(f->memory, &f->sites, site));
        assert_true(kiriArray_Push(f->memory, &f->anchors, anchor));
    }
    f->sites.data[frame] = site;
    f->anchors.data[frame] = anchor;
}

static inline int32_t Follow_AnyFreeCell(const Follow* f)
{
    int32_t cell = 0;
    while (!kiriGrid_IsCell(&f->grid, cell) || Follow_IsTaken(f, cell)) {
        ++cell;
        assert_true(cell < f->grid.cells.count);
    }
    return cell;
}

/* Finds the sites again whose cells are gone: where cells of a square have merged, one of their sites moves away. */
static inline void Follow_Relocate(Follow* f)
{
    for (int32_t i = 0; i < f->sites.count; ++i) {
        kiriSite* site = &f->sites.data[i];
        int32_t was = site->cell, cell = kiriGrid_CellAround(&f->grid, f->mesh, f->anchors.data[i]);
        if (cell != was) {
            site->cell = KIRI_NONE;
            for (cell = Follow_IsTaken(f, cell) ? f->grid.squareCell.data[f->grid.cells.data[cell].square] : cell;
                 cell != KIRI_NONE && Follow_IsTaken(f, cell);) {
                cell = f->grid.cells.data[cell].next;
            }
            if (cell == KIRI_NONE) {
                cell = Follow_AnyFreeCell(f);
                site->at = kiriGrid_Middle(&f->grid, f->mesh, cell);
                f->anchors.data[i] = kiriGrid_Anchor(&f->grid, f->mesh, cell);
            }
            site->cell = cell;
            kiriSiteMove move = { i, was };
            assert_true(kiriArray_Push(f->memory, &f->moves, move));
        }
    }
}

static inline int32_t Follow_AnyCell(const Follow* f, uint32_t* seed)
{
    int32_t cell;
    do {
        cell = (int32_t)(Random(seed) % (uint32_t)f->grid.cells.count);
    } while (!kiriGrid_IsCell(&f->grid, cell));
    return cell;
}

/* A site somewhere in a free cell: in its middle, or off it. */
static inline void Follow_AddSite(Follow* f, uint32_t* seed)
{
    int32_t cell = Follow_AnyCell(f, seed);
    if (!Follow_IsTaken(f, cell)) {
        kiriSite site = { kiriGrid_Middle(&f->grid, f->mesh, cell), cell };
        double half = Random(seed) % 2 ? 0.0 : 0.49 * f->grid.side;
        site.at = kiriVec2_Add(site.at, RandomVec2(seed, -half, half));
        Follow_Move(f, f->sites.count, site);
    }
}

/* ---- Stages: KIRI_DONE or KIRI_FAILED ---- */

static inline kiriQuota Follow_Quota(const Follow* f)
{
    kiriQuota quota = { f->slice > 0 ? f->slice : INT64_MAX, 0, 0, false };
    return quota;
}

static inline void Follow_Spend(Follow* f, const kiriQuota* quota)
{
    f->used += quota->used;
    /* A flood may go a few cells over its quota. */
    assert_true(f->slice == 0 || quota->used <= f->slice + 24);
}

static inline void Follow_Grid(Follow* f)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriGrid_Update(&f->grid, f->mesh, &quota), KIRI_DONE);
}

static inline void Follow_Regions(Follow* f, int32_t seen)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriRegions_Update(&f->regions, f->memory, &f->grid, f->mesh, f->sites.data, f->sites.count,
                                        f->moves.data + seen, f->moves.count - seen, &quota),
                     KIRI_DONE);
}

/* Regions, and a site for each part that has none. */
static inline void Follow_AllRegions(Follow* f)
{
    Follow_Regions(f, 0);
    while (f->regions.orphans.count > 0) {
        int32_t seen = f->moves.count;
        Follow_Move(f, f->sites.count, kiriFrames_SiteIn(&f->grid, f->mesh, f->regions.orphans.data[0]));
        Follow_Regions(f, seen);
    }
}

static inline kiriProgress Follow_Shape(Follow* f)
{
    kiriProgress progress;
    do {
        kiriQuota quota = Follow_Quota(f);
        progress = kiriShape_Update(&f->shape, f->memory, &f->grid, f->mesh, &f->regions, f->sites.data, f->sites.count,
                                    f->moves.data, f->moves.count, &quota);
        Follow_Spend(f, &quota);
        assert_true(progress != KIRI_MORE || (f->slice > 0 && quota.used > 0));
    } while (progress == KIRI_MORE);
    if (progress == KIRI_DONE) {
        kiriGrid_ClearChanges(&f->grid);
        kiriRegions_ClearChanges(&f->regions);
        f->moves.count = 0;
    }
    return progress;
}

static inline bool Follow_Links(Follow* f)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    return kiriLinks_Update(&f->links, f->memory, &f->grid, f->mesh, &f->regions, f->sites.data, f->sites.count,
                            &quota) == KIRI_DONE;
}

static inline kiriProgress Follow_Samples(Follow* f)
{
    kiriSampleSource vertices = { f->memory, &f->shape, &f->grid, f->mesh, &f->vertexSkin, NULL, NULL };
    kiriSampleSource points = { f->memory, &f->shape, &f->grid, f->mesh, &f->pointSkin, &f->places, &f->points };
    kiriProgress progress = kiriRefresh_NoteDirty(&f->refresh, f->memory, f->mesh) ? KIRI_MORE : KIRI_FAILED;
    while (progress == KIRI_MORE) {
        kiriQuota quota = Follow_Quota(f);
        progress = kiriRefresh_Start(&f->refresh, &vertices, f->oldVertices, &quota);
    }
    progress = progress == KIRI_DONE ? KIRI_MORE : progress;
    while (progress == KIRI_MORE) {
        kiriQuota quota = Follow_Quota(f);
        progress = kiriRefresh_Stage(&f->refresh, &vertices, &quota);
        assert_true(quota.used > 0 || f->slice == 0 || progress == KIRI_DONE);
    }
    progress = progress == KIRI_DONE ? KIRI_MORE : progress;
    while (progress == KIRI_MORE) {
        kiriQuota quota = Follow_Quota(f);
        progress = kiriRefresh_Stage(&f->refresh, &points, &quota);
        assert_true(quota.used > 0 || f->slice == 0 || progress == KIRI_DONE);
    }
    return progress;
}

static inline void Follow_Commit(Follow* f)
{
    kiriSkin_Commit(&f->vertexSkin);
    kiriSkin_Commit(&f->pointSkin);
    kiriLinks_Commit(&f->links);
    kiriShape_ClearChanges(&f->shape);
    f->oldVertices = f->mesh->vertices.count;
    for (int32_t i = 0; i < f->regions.dirty.count; ++i) {
        f->regions.dirty.data[i] = 0;
    }
}

/* Up to the weights, with a frame more at times, as where a rigid one is split. The mesh has been cut. */
static inline void Follow_Weights(Follow* f, uint32_t* seed)
{
    Follow_Grid(f);
    Follow_Relocate(f);
    Follow_AllRegions(f);
    assert_int_equal(Follow_Shape(f), KIRI_DONE);
    if (Random(seed) % 3 == 0) {
        Follow_AddSite(f, seed);
        Follow_AllRegions(f);
        assert_int_equal(Follow_Shape(f), KIRI_DONE);
    }
}

static inline void Follow_Update(Follow* f, uint32_t* seed)
{
    Follow_Weights(f, seed);
    assert_true(Follow_Links(f));
    assert_int_equal(Follow_Samples(f), KIRI_DONE);
    Follow_Commit(f);
}

/* Forgets grid, regions and shape, and makes grid and regions anew: all sites are new. */
static inline void Follow_StartAgain(Follow* f)
{
    kiriGrid_Reset(&f->grid);
    kiriRegions_Reset(&f->regions);
    kiriShape_Reset(&f->shape);
    f->shape.rigidWeight = 0.9;
    Follow_Grid(f);
    f->moves.count = 0;
    for (int32_t i = 0; i < f->sites.count; ++i) {
        kiriSiteMove move = { i, KIRI_NONE };
        f->sites.data[i].cell = kiriGrid_CellAround(&f->grid, f->mesh, f->anchors.data[i]);
        assert_true(kiriArray_Push(f->memory, &f->moves, move));
    }
    Follow_Regions(f, 0);
}

/* The same from scratch: all sites are new. */
static inline void Follow_ScratchWeights(Follow* f, const Follow* other)
{
    memset(f, 0, sizeof(*f));
    f->memory = other->memory;
    f->mesh = other->mesh;
    f->shape.rigidWeight = other->shape.rigidWeight;
    f->slice = other->slice;
    Follow_Grid(f);
    for (int32_t i = 0; i < other->sites.count; ++i) {
        int32_t a = other->grid.squareCell.data[other->grid.cells.data[other->sites.data[i].cell].square];
        int32_t b = f->grid.squareCell.data[other->grid.cells.data[other->sites.data[i].cell].square];
        for (; a != other->sites.data[i].cell; a = other->grid.cells.data[a].next) {
            b = f->grid.cells.data[b].next;
        }
        kiriSite site = { other->sites.data[i].at, b };
        Follow_Move(f, i, site);
    }
    Follow_Regions(f, 0);
    assert_int_equal(f->regions.orphans.count, other->regions.orphans.count);
    assert_int_equal(Follow_Shape(f), KIRI_DONE);
}

static inline void Follow_Scratch(Follow* f, const Follow* other)
{
    kiriSpan none = { 0, 0 };
    Follow_ScratchWeights(f, other);
    for (int32_t i = 0; i < other->points.count; ++i) {
        assert_true(kiriArray_Push(f->memory, &f->points, other->points.data[i]));
        assert_true(kiriPlaces_Add(&f->places, f->memory, f->mesh, other->points.data[i].at));
        assert_true(kiriArray_Push(f->memory, &f->pointSkin.spans, none));
    }
    for (int32_t v = 0; v < f->mesh->vertices.count; ++v) {
        assert_true(kiriArray_Push(f->memory, &f->vertexSkin.spans, none));
    }
    assert_true(Follow_Links(f));
    assert_int_equal(Follow_Samples(f), KIRI_DONE);
    Follow_Commit(f);
}

/* A new sheet whose mesh is not cut yet, but may be slit. */
static inline void Follow_Start(Follow* f, const Scene* scene, int32_t siteCount, int32_t pointCount, uint32_t* seed)
{
    kiriSpan none = { 0, 0 };
    Follow_Init(f, scene);
    Follow_Grid(f);
    for (int32_t k = 0; k < siteCount; ++k) {
        Follow_AddSite(f, seed);
    }
    for (int32_t k = 0; k < pointCount; ++k) {
        int32_t cell = Follow_AnyCell(f, seed);
        kiriSample point = { kiriGrid_Anchor(&f->grid, f->mesh, cell), cell, KIRI_NONE };
        assert_true(kiriArray_Push(f->memory, &f->points, point));
        assert_true(kiriPlaces_Add(&f->places, f->memory, f->mesh, point.at));
        assert_true(kiriArray_Push(f->memory, &f->pointSkin.spans, none));
    }
    for (int32_t v = 0; v < f->mesh->vertices.count; ++v) {
        assert_true(kiriArray_Push(f->memory, &f->vertexSkin.spans, none));
    }
    Follow_AllRegions(f);
    assert_int_equal(Follow_Shape(f), KIRI_DONE);
    assert_true(Follow_Links(f));
    assert_int_equal(Follow_Samples(f), KIRI_DONE);
    Follow_Commit(f);
    kiriSquares_ClearDirty(&f->mesh->squares);
}

/* ---- A wandering blade ---- */

typedef struct Wander {
    kiriBladeTip blade;
    kiriVec2 at, heading;
    int32_t left;
} Wander;

static inline kiriVec2 Wander_Random(const Follow* f, uint32_t* seed)
{
    kiriVec2 p = RandomVec2(seed, -0.05, 1.05);
    p.x *= f->grid.side * f->mesh->squares.columns;
    p.y *= f->grid.side * f->mesh->squares.rows;
    return p;
}

/* Cuts on by a segment; where it has wandered long enough it starts anew. Not committed. */
static inline void Wander_Move(Wander* w, Follow* f, double length, uint32_t* seed)
{
    if (w->left-- <= 0) {
        w->at = Wander_Random(f, seed);
        w->heading = RandomVec2(seed, -1.0, 1.0);
        w->left = 4 + (int32_t)(Random(seed) % 30);
        w->blade = kiriCut_Place(f->mesh, w->at);
    }
    double turn = RandomBetween(seed, -0.6, 0.9), size = kiriVec2_Length(w->heading) + 1e-3;
    w->heading = kiriVec2_Scale(1.0 / size,
                                kiriVec2_Make(w->heading.x - turn * w->heading.y, w->heading.y + turn * w->heading.x));
    size = kiriVec2_Length(w->heading) + 1e-3;
    kiriVec2 from = w->at, to = kiriVec2_Add(w->at, kiriVec2_Scale(length / size, w->heading));
    w->at = to;
    if (!kiriCut_Clip(f->mesh, &from, &to)) {
        w->left = 0;
    } else {
        kiriQuota quota = { INT64_MAX, 0, 0, false };
        assert_int_equal(kiriCut_Move(f->mesh, &w->blade, kiriMesh_Snap(f->mesh, to), 16.0, &quota), KIRI_DONE);
    }
}

/* The same, committed; newborn vertices inherit their weights. */
static inline void Wander_Cut(Wander* w, Follow* f, double length, uint32_t* seed)
{
    kiriMesh_Begin(f->mesh);
    Wander_Move(w, f, length, seed);
    assert_true(kiriSkin_ReserveBirths(&f->vertexSkin, f->memory, f->mesh->vertices.count - f->mesh->oldVertexCount,
                                       f->sites.count));
    kiriSkin_Inherit(&f->vertexSkin, f->memory, f->mesh);
    kiriMesh_Commit(f->mesh);
}

/* ---- Equality ---- */

/* The cell of b that is cell c of a. */
static inline int32_t Follow_Twin(const Follow* a, const Follow* b, int32_t c)
{
    int32_t square = a->grid.cells.data[c].square;
    int32_t x = a->grid.squareCell.data[square], y = b->grid.squareCell.data[square];
    while (x != c) {
        x = a->grid.cells.data[x].next;
        y = b->grid.cells.data[y].next;
    }
    assert_int_not_equal(y, KIRI_NONE);
    assert_int_equal(a->grid.cells.data[x].triangle, b->grid.cells.data[y].triangle);
    return y;
}

static inline void Follow_CompareReaches(const Follow* a, const Follow* b)
{
    const Reach none = { KIRI_NONE, KIRI_FAR, KIRI_FAR, KIRI_NONE };
    const kiriReaches *ours = &a->shape.reaches, *theirs = &b->shape.reaches;
    Reach* reaches = malloc(sizeof(Reach) * (size_t)b->grid.cells.count);
    for (int32_t i = 0; i < a->sites.count; ++i) {
        int32_t left = 0;
        for (int32_t c = 0; c < b->grid.cells.count; ++c) {
            reaches[c] = none;
        }
        for (Reach x = Reaches_First(theirs, i); x.cell != KIRI_NONE; x = Reaches_After(theirs, x)) {
            reaches[x.cell] = x;
            left++;
        }
        for (Reach x = Reaches_First(ours, i); x.cell != KIRI_NONE; x = Reaches_After(ours, x)) {
            Reach* y = &reaches[Follow_Twin(a, b, x.cell)];
            assert_int_equal(x.fromSite, y->fromSite);
            assert_int_equal(x.fromBorder, y->fromBorder);
            *y = none; /* each once */
            left--;
        }
        assert_int_equal(left, 0);
    }
    free(reaches);
}

static inline void Follow_CompareWeights(const Follow* a, const Follow* b)
{
    for (int32_t c = 0; c < a->grid.cells.count; ++c) {
        kiriSpan x = a->shape.spans.data[c];
        if (!kiriGrid_IsCell(&a->grid, c)) {
            assert_int_equal(x.count, 0);
            continue;
        }
        kiriSpan y = b->shape.spans.data[Follow_Twin(a, b, c)];
        assert_int_equal(x.count, y.count);
        for (int32_t k = 0; k < x.count; ++k) {
            kiriCellWeight v = a->shape.weights.data[x.first + k], w = b->shape.weights.data[y.first + k];
            assert_int_equal(v.frame, w.frame);
            assert_true(v.low == w.low && v.high == w.high);
        }
    }
    for (int32_t i = 0; i < a->sites.count; ++i) {
        assert_true(a->shape.rigid.data[i] == b->shape.rigid.data[i]);
    }
}

static inline void Follow_CompareLinks(const Follow* a, const Follow* b)
{
    assert_int_equal(a->links.links.count, b->links.links.count);
    for (int32_t k = 0; k < a->links.links.count; ++k) {
        assert_memory_equal(&a->links.links.data[k], &b->links.links.data[k], sizeof(kiriLink));
    }
    assert_int_equal(a->links.corners.count, b->links.corners.count);
    for (int32_t k = 0; k < a->links.corners.count; ++k) {
        assert_memory_equal(&a->links.corners.data[k], &b->links.corners.data[k], sizeof(kiriCorner));
    }
}

static inline void Follow_CompareSkins(const kiriSkin* a, const kiriSkin* b)
{
    assert_int_equal(a->spans.count, b->spans.count);
    for (int32_t s = 0; s < a->spans.count; ++s) {
        kiriSpan x = a->spans.data[s], y = b->spans.data[s];
        assert_true(x.count > 0);
        assert_int_equal(x.count, y.count);
        for (int32_t k = 0; k < x.count; ++k) {
            kiriSampleWeight v = a->weights.data[x.first + k], w = b->weights.data[y.first + k];
            assert_int_equal(v.frame, w.frame);
            assert_true(v.value == w.value);
        }
    }
}

static inline void Follow_Compare(const Follow* f)
{
    Follow scratch;
    Follow_Scratch(&scratch, f);
    Follow_CompareReaches(f, &scratch);
    Follow_CompareWeights(f, &scratch);
    Follow_CompareLinks(f, &scratch);
    Follow_CompareSkins(&f->vertexSkin, &scratch.vertexSkin);
    Follow_CompareSkins(&f->pointSkin, &scratch.pointSkin);
    Follow_Release(&scratch);
}

#endif
