#include "kiri_element.h"

/* F_u, F_v, D_u, D_v, D; or the derivatives of a strain by them. */
typedef struct SurfaceState {
    kiriVec3 u, v, du, dv, d;
} SurfaceState;

static void AddVector(kiriVec3* sum, double a, kiriVec3 b)
{
    *sum = kiriVec3_AddScaled(*sum, a, b);
}

static SurfaceState SurfaceStateOf(const kiriAreaElement* element, const kiriFrameShare* shares,
                                   const kiriFrameData* frames, const kiriPose* poses)
{
    kiriVec3 zero = { 0 };
    SurfaceState s = { zero, zero, zero, zero, zero };
    KIRI_EACH_INDEX(k, *element) {
        const kiriFrameShare* share = &shares[element->first + k];
        KIRI_ASSERT(share->frame >= 0);
        kiriPose pose = poses != NULL ? poses[share->frame] : kiriPose_Of(&frames[share->frame]);
        AddVector(&s.u, share->move.x, pose.x);
        AddVector(&s.u, share->u.x, pose.A.u);
        AddVector(&s.u, share->v.x, pose.A.v);
        AddVector(&s.v, share->move.y, pose.x);
        AddVector(&s.v, share->u.y, pose.A.u);
        AddVector(&s.v, share->v.y, pose.A.v);
        AddVector(&s.d, share->weight, pose.A.d);
        AddVector(&s.du, share->slope.x, pose.A.d);
        AddVector(&s.dv, share->slope.y, pose.A.d);
    }
    return s;
}

static void StrainsOf(const SurfaceState* s, double lean, double strain[KIRI_AREA_STRAINS])
{
    double uu = kiriVec3_Dot(s->u, s->u), vv = kiriVec3_Dot(s->v, s->v);
    double leanU = kiriVec3_Dot(s->u, s->d), leanV = kiriVec3_Dot(s->v, s->d);
    double bendU = kiriVec3_Dot(s->u, s->du), bendV = kiriVec3_Dot(s->v, s->dv);
    strain[KIRI_AREA_DILATION] = 0.5 * (uu + vv + lean * (leanU * leanU + leanV * leanV)) - 1.0;
    strain[KIRI_AREA_STRETCH] = 0.5 * (uu - vv + lean * (leanU * leanU - leanV * leanV));
    strain[KIRI_AREA_SHEAR] = kiriVec3_Dot(s->u, s->v) + lean * leanU * leanV;
    strain[KIRI_AREA_DOME] = bendU + bendV;
    strain[KIRI_AREA_SADDLE] = bendU - bendV;
    strain[KIRI_AREA_TWIST] = kiriVec3_Dot(s->u, s->dv) + kiriVec3_Dot(s->v, s->du);
    strain[KIRI_AREA_LEAN_U] = leanU;
    strain[KIRI_AREA_LEAN_V] = leanV;
    strain[KIRI_AREA_THICKNESS] = 0.5 * (kiriVec3_Dot(s->d, s->d) - 1.0);
}

/* Writes the derivative of each strain by the shape. */
static void SlopesOf(const SurfaceState* s, double lean, SurfaceState slope[KIRI_AREA_STRAINS])
{
    kiriVec3 zero = { 0 }, minusV = kiriVec3_Scale(-1.0, s->v), minusDv = kiriVec3_Scale(-1.0, s->dv);
    double leanU = lean * kiriVec3_Dot(s->u, s->d), leanV = lean * kiriVec3_Dot(s->v, s->d);
    kiriVec3 u = kiriVec3_AddScaled(s->u, leanU, s->d), v = kiriVec3_AddScaled(s->v, leanV, s->d);
    kiriVec3 byU = kiriVec3_Scale(leanU, s->u), byV = kiriVec3_Scale(leanV, s->v);
    const SurfaceState slopes[KIRI_AREA_STRAINS] = {
        { u, v, zero, zero, kiriVec3_Add(byU, byV) },
        { u, kiriVec3_Scale(-1.0, v), zero, zero, kiriVec3_Sub(byU, byV) },
        { v, u, zero, zero, kiriVec3_AddScaled(kiriVec3_Scale(leanU, s->v), leanV, s->u) },
        { s->du, s->dv, s->u, s->v, zero },
        { s->du, minusDv, s->u, minusV, zero },
        { s->dv, s->du, s->v, s->u, zero },
        { s->d, zero, zero, zero, s->u },
        { zero, s->d, zero, zero, s->v },
        { zero, zero, zero, zero, s->d },
    };
    KIRI_TIMES(e, KIRI_AREA_STRAINS) {
        slope[e] = slopes[e];
    }
}

static kiriVec3 AlongColumns(const SurfaceState* slope, kiriVec2 a)
{
    return kiriVec3_AddScaled(kiriVec3_Scale(a.x, slope->u), a.y, slope->v);
}

void kiriAreaElement_Measure(const kiriAreaElement* element, const kiriFrameShare* shares, const kiriFrameData* frames,
                             const kiriPose* poses, double* strain, kiriFrameRow* rows)
{
    KIRI_ASSERT(element->firstRow >= 0 && element->firstRow < element->lastRow &&
                element->lastRow <= KIRI_AREA_STRAINS);
    SurfaceState shape = SurfaceStateOf(element, shares, frames, poses), slope[KIRI_AREA_STRAINS];
    double all[KIRI_AREA_STRAINS];
    StrainsOf(&shape, element->lean, all);
    KIRI_FROM_TO(e, element->firstRow, element->lastRow) {
        strain[e - element->firstRow] = all[e];
    }
    if (rows != NULL) {
        SlopesOf(&shape, element->lean, slope);
        KIRI_FROM_TO(e, element->firstRow, element->lastRow) {
            KIRI_EACH_INDEX(k, *element) {
                const kiriFrameShare* share = &shares[element->first + k];
                kiriVec3 bend = kiriVec3_Scale(share->slope.x, slope[e].du);
                bend = kiriVec3_AddScaled(bend, share->slope.y, slope[e].dv);
                rows->by[0] = AlongColumns(&slope[e], share->move);
                rows->by[1] = AlongColumns(&slope[e], share->u);
                rows->by[2] = AlongColumns(&slope[e], share->v);
                rows->by[3] = kiriVec3_AddScaled(bend, share->weight, slope[e].d);
                ++rows;
            }
        }
    }
}

void kiriAreaElement_Stiffness(const kiriAreaElement* element, const kiriMaterial* material, double* stiffness)
{
    double E = material->youngsModulus, nu = material->poissonsRatio, h = material->thickness;
    double G = 0.5 * E / (1.0 + nu) * h * element->area, K = 0.5 * E / (1.0 - nu) * h * element->area,
           bend = h * h / 12.0;
    const double all[KIRI_AREA_STRAINS] = { K, G, G, bend * K, bend * G, bend * G, G, G, E * h * element->area };
    KIRI_FROM_TO(e, element->firstRow, element->lastRow) {
        stiffness[e - element->firstRow] = all[e];
    }
}

bool kiriAreaElements_Keep(kiriAreaElements* elements, kiriMemory* memory, const kiriAreaElements* from,
                           const kiriKeep* frames)
{
    bool ok = true;
    KIRI_EACH_INDEX_WHILE(ok, k, from->elements) {
        kiriAreaElement element = from->elements.data[k];
        const kiriFrameShare* shares = &from->shares.data[element.first];
        if (kiriKeep_Has(frames, shares[0].frame)) {
            element.first = elements->shares.count;
            ok = kiriArray_Push(memory, &elements->elements, element);
            KIRI_EACH_INDEX_WHILE(ok, n, element) {
                kiriFrameShare share = shares[n];
                share.frame = kiriKeep_To(frames, share.frame);
                ok = kiriArray_Push(memory, &elements->shares, share);
            }
        }
    }
    return ok;
}

typedef struct PointBuilder {
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriShape* shape;
    const kiriMoments* material; /* of each frame's region */
    kiriIntegrationWork* work;
    kiriAreaElements* elements;
    double perArea; /* points, 1/m^2 */
    int32_t order;
    int32_t lastRow;
} PointBuilder;

static const kiriMoments NoMaterial = { 0 };

/* ---- Elements ---------------------------------------------------------------------------------------------------- */

/* Adds an element at a place `off` the point, with linear-blend skinning, x(p) = sum of w_i(p) (x_i + A_i (p - c_i)).
   The weights are linear around the point. */
static bool AddAreaElement(PointBuilder* b, kiriVec2 point, kiriVec2 off, double area)
{
    const kiriPointWeights* weights = &b->work->weights;
    kiriAreaElement element = { area, 0.0, b->elements->shares.count, weights->count, 0, b->lastRow };
    kiriVec2 at = kiriVec2_Add(point, off);
    KIRI_EACH(const kiriPointWeight, from, *weights) {
        kiriPointWeight w = *from;
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

/* Adds two pairs of places on opposite sides of the point. Together they have the region's second moments: their
   offsets are the columns of its Cholesky factor. */
static bool AddFour(PointBuilder* b, kiriVec2 point, const kiriMoments* material)
{
    kiriMoments about = kiriMoments_About(material, point);
    double perArea = 2.0 / about.area, u = kiriRoot(perArea * about.uu), v = u > 0.0 ? perArea * about.uv / u : 0.0;
    double rest = kiriRoot(perArea * about.vv - v * v);
    const kiriVec2 off[4] = { { u, v }, { -u, -v }, { 0.0, rest }, { 0.0, -rest } };
    bool ok = true;
    KIRI_TIMES_WHILE(ok, k, 4) {
        ok = AddAreaElement(b, point, off[k], 0.25 * about.area);
    }
    return ok;
}

/* Adds the elements of a point. A region without area gets none. */
static bool AddIntegrationPoint(PointBuilder* b, const kiriSite* point, const kiriMoments* material)
{
    const kiriVec2 here = { 0 };
    if (!(material->area > 0.0)) {
        return true;
    }
    return kiriShape_At(b->shape, b->memory, b->grid, point->cell, point->at, &b->work->weights) &&
           (b->order == 1 ? AddAreaElement(b, point->at, here, material->area) : AddFour(b, point->at, material));
}

/* ---- Points of a piece ------------------------------------------------------------------------------------------ */

static bool FloodFromPoints(PointBuilder* b)
{
    kiriIntegrationWork* work = b->work;
    const kiriSites* points = &work->placer.sites;
    kiriRule rule = { b->grid, KIRI_FAR - 1, NULL, NULL, NULL, NULL };
    kiriQuota endless = { INT64_MAX, 0, 0, false };
    kiriField_Reset(&work->field);
    work->seeds.count = 0;
    KIRI_EACH_INDEX(i, *points) {
        if (!kiriSite_Seed(&points->data[i], i, b->grid, &work->seeds)) {
            return false;
        }
    }
    return kiriField_Resize(&work->field, b->memory, b->grid->cells.count, KIRI_FIELD_OWNERS) &&
           kiriField_Start(&work->field, b->memory, work->seeds.data, work->seeds.count) &&
           kiriField_Flood(&work->field, &rule, &endless) == KIRI_DONE;
}

/* Divides the piece into the regions of its points, as placing does: the cell of a point belongs to the point. */
static bool DividePiece(PointBuilder* b)
{
    kiriIntegrationWork* work = b->work;
    const kiriSites* points = &work->placer.sites;
    if (!kiriArray_Resize(b->memory, &work->material, points->count) || !FloodFromPoints(b)) {
        return false;
    }
    KIRI_EACH_INDEX(i, *points) {
        work->field.owner.data[points->data[i].cell] = i;
        work->material.data[i] = NoMaterial;
    }
    KIRI_EACH(const int32_t, at, work->placer.cells) {
        int32_t cell = *at;
        kiriMoments material = kiriGrid_Material(b->grid, cell);
        kiriMoments_Add(&work->material.data[work->field.owner.data[cell]], &material);
    }
    return true;
}

static bool AddPiecePoints(PointBuilder* b, int32_t cell)
{
    kiriIntegrationWork* work = b->work;
    if (!kiriPlacer_TakePiece(&work->placer, b->grid, cell)) {
        return false;
    }
    kiriMoments material = NoMaterial;
    KIRI_EACH(const int32_t, at, work->placer.cells) {
        kiriMoments more = kiriGrid_Material(b->grid, *at);
        kiriMoments_Add(&material, &more);
        work->seen.data[*at] = 1;
    }
    const kiriSites* points = &work->placer.sites;
    kiriQuota endless = { INT64_MAX, 0, 0, false };
    double share = material.area * b->perArea + 0.5;
    int32_t cells = work->placer.cells.count, count = share < 2.0 ? 1 : share < cells ? (int32_t)share : cells;
    work->placer.sites.count = 0;
    bool ok = kiriPlacer_Start(&work->placer, b->grid, NULL, count) &&
              kiriPlacer_Run(&work->placer, b->grid, &endless) == KIRI_DONE;
    if (ok && points->count == 1) { /* without a flood: confetti comes in thousands */
        return AddIntegrationPoint(b, &points->data[0], &material);
    }
    ok = ok && DividePiece(b);
    KIRI_TIMES_WHILE(ok, i, points->count) {
        ok = AddIntegrationPoint(b, &points->data[i], &work->material.data[i]);
    }
    return ok;
}

/* ---- All ------------------------------------------------------------------------------------------------------ */

bool kiriIntegration_Build(kiriAreaElements* elements, kiriIntegrationWork* work, const kiriGrid* grid,
                           const kiriShape* shape, const kiriMoments* material, double count, int32_t order,
                           bool planar)
{
    PointBuilder b = { grid->mesh->memory, grid, shape, material, work, elements, 0.0, order, KIRI_AREA_STRAINS };
    double total = 0.0; /* summed in the order of cells, as are the pieces below */
    KIRI_EACH_INDEX(s, grid->squareCell) {
        KIRI_EACH_CELL(c, grid, s) {
            total += kiriGrid_Area(grid, c);
        }
    }
    b.perArea = count / total;
    b.lastRow = planar ? KIRI_AREA_SHEAR + 1 : KIRI_AREA_STRAINS;
    elements->elements.count = elements->shares.count = 0;
    bool ok = kiriArray_Resize(b.memory, &work->seen, grid->cells.count);
    kiriArray_Set(&work->seen, 0);
    KIRI_EACH_INDEX_WHILE(ok, s, grid->squareCell) {
        for (int32_t c = grid->squareCell.data[s]; ok && c != KIRI_NONE; c = grid->cells.data[c].next) {
            ok = work->seen.data[c] || AddPiecePoints(&b, c);
        }
    }
    return ok;
}
