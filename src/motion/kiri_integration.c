#include "kiri_integration.h"

typedef struct PointBuilder {
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriShape* shape;
    const kiriMoments* material; /* of each frame's region */
    kiriIntegrationWork* work;
    kiriAreaElements* elements;
    double perArea; /* points, 1/m^2 */
    int32_t order;
    int32_t lastRow;
} PointBuilder;

static const kiriMoments NoMaterial = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };

/* ---- Elements ---------------------------------------------------------------------------------------------------- */

/* Linear-blend skinning, x(p) = sum of w_i(p) (x_i + A_i (p - c_i)), at a place `off` the point, with the weights
   linear around it. */
static bool AddAreaElement(PointBuilder* b, kiriVec2 point, kiriVec2 off, double area)
{
    const kiriPointWeights* weights = &b->work->weights;
    kiriAreaElement element = { area, 0.0, b->elements->shares.count, weights->count, 0, b->lastRow };
    kiriVec2 at = kiriVec2_Add(point, off);
    for (int32_t k = 0; k < weights->count; ++k) {
        kiriPointWeight w = weights->data[k];
        kiriVec2 arm = kiriVec2_Sub(at, kiriMoments_Center(&b->material[w.frame]));
        kiriFrameShare share = { w.frame,
                                 w.gradient,
                                 kiriVec2_Scale(arm.x, w.gradient),
                                 kiriVec2_Scale(arm.y, w.gradient),
                                 w.value + kiriVec2_Dot(w.gradient, off),
                                 w.gradient };
        share.u.x += share.weight;
        share.v.y += share.weight;
        if (!kiriArray_Push(b->memory, &b->elements->shares, share)) {
            return false;
        }
    }
    return kiriArray_Push(b->memory, &b->elements->elements, element);
}

/* Two pairs of places on either side of the point, that together have the region's second moments: the columns of
   their Cholesky factor. */
static bool AddFour(PointBuilder* b, kiriVec2 point, const kiriMoments* material)
{
    kiriMoments about = kiriMoments_About(material, point);
    double perArea = 2.0 / about.area, u = kiriRoot(perArea * about.uu), v = u > 0.0 ? perArea * about.uv / u : 0.0;
    double rest = kiriRoot(perArea * about.vv - v * v);
    const kiriVec2 off[4] = { { u, v }, { -u, -v }, { 0.0, rest }, { 0.0, -rest } };
    bool ok = true;
    for (int k = 0; ok && k < 4; ++k) {
        ok = AddAreaElement(b, point, off[k], 0.25 * about.area);
    }
    return ok;
}

/* A region without area has no energy. */
static bool AddIntegrationPoint(PointBuilder* b, const kiriSite* point, const kiriMoments* material)
{
    const kiriVec2 here = { 0.0, 0.0 };
    if (!(material->area > 0.0)) {
        return true;
    }
    return kiriShape_At(b->shape, b->memory, b->grid, b->mesh, point->cell, point->at, &b->work->weights) &&
           (b->order == 1 ? AddAreaElement(b, point->at, here, material->area) : AddFour(b, point->at, material));
}

/* ---- Points of a piece ------------------------------------------------------------------------------------------ */

static kiriMoments MaterialOfPiece(const PointBuilder* b)
{
    kiriMoments sum = NoMaterial;
    for (int32_t k = 0; k < b->work->placer.cells.count; ++k) {
        kiriMoments material = kiriGrid_Material(b->grid, b->mesh, b->work->placer.cells.data[k]);
        kiriMoments_Add(&sum, &material);
    }
    return sum;
}

static bool PlaceIntegrationPoints(PointBuilder* b, double area)
{
    kiriPlacer* placer = &b->work->placer;
    kiriQuota endless = { INT64_MAX, 0, 0, false };
    double share = area * b->perArea + 0.5;
    int32_t count = share < 2.0 ? 1 : share < placer->cells.count ? (int32_t)share : placer->cells.count;
    placer->sites.count = 0;
    return kiriPlacer_Start(placer, b->memory, b->grid, b->mesh, NULL, count) &&
           kiriPlacer_Run(placer, b->memory, b->grid, b->mesh, &endless) == KIRI_DONE;
}

static bool FloodFromPoints(PointBuilder* b)
{
    kiriIntegrationWork* work = b->work;
    const kiriSites* points = &work->placer.sites;
    kiriRule rule = { b->grid, KIRI_FAR - 1, NULL, NULL, NULL, NULL, { NULL, NULL } };
    kiriQuota endless = { INT64_MAX, 0, 0, false };
    kiriField_Reset(&work->field);
    work->seeds.count = 0;
    for (int32_t i = 0; i < points->count; ++i) {
        if (!kiriSite_Seed(&points->data[i], i, b->memory, b->grid, b->mesh, &work->seeds)) {
            return false;
        }
    }
    return kiriField_Resize(&work->field, b->memory, b->grid->cells.count) &&
           kiriField_Start(&work->field, b->memory, work->seeds.data, work->seeds.count) &&
           kiriField_Flood(&work->field, &rule, &endless) == KIRI_DONE;
}

/* The regions of points, as placing defines them: a point's own cell is its own. */
static bool DividePiece(PointBuilder* b)
{
    kiriIntegrationWork* work = b->work;
    const kiriSites* points = &work->placer.sites;
    if (!kiriArray_Resize(b->memory, &work->material, points->count) || !FloodFromPoints(b)) {
        return false;
    }
    for (int32_t i = 0; i < points->count; ++i) {
        work->field.owner.data[points->data[i].cell] = i;
        work->material.data[i] = NoMaterial;
    }
    for (int32_t k = 0; k < work->placer.cells.count; ++k) {
        int32_t cell = work->placer.cells.data[k];
        kiriMoments material = kiriGrid_Material(b->grid, b->mesh, cell);
        kiriMoments_Add(&work->material.data[work->field.owner.data[cell]], &material);
    }
    return true;
}

static bool AddPiecePoints(PointBuilder* b, int32_t cell)
{
    kiriIntegrationWork* work = b->work;
    if (!kiriPlacer_TakePiece(&work->placer, b->memory, b->grid, cell)) {
        return false;
    }
    for (int32_t k = 0; k < work->placer.cells.count; ++k) {
        work->seen.data[work->placer.cells.data[k]] = 1;
    }
    kiriMoments material = MaterialOfPiece(b);
    const kiriSites* points = &work->placer.sites;
    bool ok = PlaceIntegrationPoints(b, material.area);
    if (ok && points->count == 1) { /* without a flood: confetti comes in thousands */
        return AddIntegrationPoint(b, &points->data[0], &material);
    }
    ok = ok && DividePiece(b);
    for (int32_t i = 0; ok && i < points->count; ++i) {
        ok = AddIntegrationPoint(b, &points->data[i], &work->material.data[i]);
    }
    return ok;
}

/* ---- All ------------------------------------------------------------------------------------------------------ */

static bool ClearSeen(PointBuilder* b)
{
    if (!kiriArray_Resize(b->memory, &b->work->seen, b->grid->cells.count)) {
        return false;
    }
    for (int32_t c = 0; c < b->grid->cells.count; ++c) {
        b->work->seen.data[c] = 0;
    }
    return true;
}

/* In the order of cells, as are the pieces below. */
static double TotalArea(const kiriGrid* grid)
{
    double total = 0.0;
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        for (int32_t c = grid->squareCell.data[s]; c != KIRI_NONE; c = grid->cells.data[c].next) {
            total += kiriGrid_Area(grid, c);
        }
    }
    return total;
}

bool kiriIntegration_Build(kiriAreaElements* elements, kiriIntegrationWork* work, kiriMemory* memory,
                           const kiriGrid* grid, const kiriMeshData* mesh, const kiriShape* shape,
                           const kiriMoments* material, double count, int32_t order, bool planar)
{
    PointBuilder b = { memory, grid, mesh, shape, material, work, elements, 0.0, order, KIRI_AREA_STRAINS };
    b.perArea = count / TotalArea(grid);
    b.lastRow = planar ? KIRI_AREA_SHEAR + 1 : KIRI_AREA_STRAINS;
    elements->elements.count = elements->shares.count = 0;
    bool ok = ClearSeen(&b);
    for (int32_t s = 0; ok && s < grid->squareCell.count; ++s) {
        for (int32_t c = grid->squareCell.data[s]; ok && c != KIRI_NONE; c = grid->cells.data[c].next) {
            ok = work->seen.data[c] || AddPiecePoints(&b, c);
        }
    }
    return ok;
}
