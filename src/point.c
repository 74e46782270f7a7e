#include "point.h"

typedef struct Builder {
    const kiriMemory* memory;
    const kiriRegions* regions;
    kiriPatches* patches;
    kiriPointWeights weights; /* at the point at hand */
    int32_t lastRow;
} Builder;

/* Linear-blend skinning, x(p) = sum of w_i(p) (x_i + A_i (p - c_i)), at a place `off` the point, with the weights
   linear around it. */
static bool AddPatch(Builder* b, kiriVec2 point, kiriVec2 off, double area)
{
    kiriPatch patch = { area, 0.0, b->patches->shares.count, b->weights.count, 0, b->lastRow };
    kiriVec2 at = kiriVec2_Add(point, off);
    for (int32_t k = 0; k < b->weights.count; ++k) {
        kiriPointWeight w = b->weights.data[k];
        kiriVec2 arm = kiriVec2_Sub(at, kiriMoments_Center(&b->regions->regions.data[w.frame].material));
        kiriShare share = { w.frame,
                            w.gradient,
                            kiriVec2_Scale(arm.x, w.gradient),
                            kiriVec2_Scale(arm.y, w.gradient),
                            w.value + kiriVec2_Dot(w.gradient, off),
                            w.gradient };
        share.u.x += share.weight;
        share.v.y += share.weight;
        if (!kiriArray_Push(b->memory, &b->patches->shares, share)) {
            return false;
        }
    }
    return kiriArray_Push(b->memory, &b->patches->patches, patch);
}

/* Two pairs of places on either side of the point, that together have the region's second moments: the columns of their
   Cholesky factor. */
static bool AddFour(Builder* b, kiriVec2 point, const kiriMoments* material)
{
    kiriMoments about = kiriMoments_About(material, point);
    double perArea = 2.0 / about.area, u = sqrt(perArea * about.uu), v = u > 0.0 ? perArea * about.uv / u : 0.0;
    double rest = perArea * about.vv - v * v;
    const kiriVec2 off[4] = {
        { u, v }, { -u, -v }, { 0.0, sqrt(rest > 0.0 ? rest : 0.0) }, { 0.0, -sqrt(rest > 0.0 ? rest : 0.0) }
    };
    bool ok = true;
    for (int k = 0; ok && k < 4; ++k) {
        ok = AddPatch(b, point, off[k], 0.25 * about.area);
    }
    return ok;
}

static void SumMaterial(const kiriGrid* grid, const kiriRegions* around, kiriMoments* material, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        material[i] = (kiriMoments){ 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (around->owner.data[c] != KIRI_NONE) {
            kiriMoments_Add(&material[around->owner.data[c]], &grid->cells.data[c].material);
        }
    }
}

bool kiriPoints_Build(kiriPatches* patches, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      kiriField* field, const kiriShape* shape, const kiriRegions* regions, int32_t count,
                      int32_t order, bool planar)
{
    Builder b = { memory, regions, patches, { 0 }, planar ? KIRI_PATCH_SHEAR + 1 : KIRI_PATCH_STRAINS };
    kiriSites points = { 0 };
    kiriRegions around = { { 0 }, { 0 }, { 0 }, { 0 } };
    KIRI_ARRAY(kiriMoments) material = { 0 };
    patches->patches.count = patches->shares.count = 0;
    bool ok = kiriSites_Spread(&points, memory, grid, mesh, field, count) &&
              kiriRegions_Divide(&around, memory, grid, mesh, field, points.data, points.count) &&
              kiriArray_Resize(memory, &material, points.count);
    if (ok) {
        SumMaterial(grid, &around, material.data, points.count);
    }
    for (int32_t i = 0; ok && i < points.count; ++i) {
        kiriVec2 at = points.data[i].at, none = { 0.0, 0.0 };
        ok = kiriShape_At(shape, memory, grid, mesh, points.data[i].cell, at, &b.weights) &&
             (order == 1 ? AddPatch(&b, at, none, material.data[i].area) : AddFour(&b, at, &material.data[i]));
    }
    kiriArray_Release(memory, &material);
    kiriArray_Release(memory, &b.weights);
    kiriArray_Release(memory, &points);
    kiriRegions_Release(&around, memory);
    return ok;
}
