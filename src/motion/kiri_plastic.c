#include "kiri_plastic.h"

/* ---- The law ----------------------------------------------------------------------------------------------------- */

static double SectionMoment(double c, double hardening)
{
    return c <= 1.0 ? c : (1.0 - hardening) * (1.5 - 0.5 / (c * c)) + hardening * c;
}

/* Integral of the moment from c = a to c = b, both 1 or more. */
static double SectionEnergy(double a, double b, double hardening)
{
    return (b - a) * ((1.0 - hardening) * (1.5 - 0.5 / (a * b)) + 0.5 * hardening * (a + b));
}

void kiriYield_Begin(kiriYield* yield, const kiriPlastic* plastic, const kiriMaterial* material, double length,
                     const kiriBentStrain* stiffness, const kiriBentStrain* offset, const kiriBentStrain* strain)
{
    double E = material->youngsModulus, h = material->thickness;
    KIRI_CLEAR(yield);
    yield->start = *offset;
    yield->elastic = (kiriBentStrain){ strain->bending - offset->bending, strain->twist - offset->twist, 0.0 };
    if (material->yieldStress > 0.0f && stiffness->bending > 0.0) {
        yield->limit = 2.0 * material->yieldStress / (E * h) * length;
        yield->hardening = material->hardening;
        yield->reach = kiriMax(plastic->reach, 1.0);
        yield->flowed = yield->reach - SectionMoment(yield->reach, yield->hardening);
        yield->stiffness = stiffness->bending;
        yield->perTwist = stiffness->twist / stiffness->bending;
        yield->perFold = stiffness->fold / stiffness->bending;
    }
}

void kiriYield_Flow(kiriYield* yield, const kiriBentStrain* strain, bool mayFlow, kiriBentStrain* offset)
{
    *offset = yield->start;
    yield->flows = yield->turns = false;
    yield->lost = 0.0;
    if (!mayFlow || !(yield->limit > 0.0)) {
        return;
    }
    double over = strain->fold - fabs(yield->start.fold);
    kiriBentStrain e = { strain->bending - yield->start.bending, strain->twist - yield->start.twist,
                         kiriMax(over, 0.0) };
    double squared = e.bending * e.bending + yield->perTwist * e.twist * e.twist + yield->perFold * e.fold * e.fold;
    double length = sqrt(squared), L = yield->limit, c = length / L + yield->flowed;
    double g = SectionMoment(c, yield->hardening);
    if (!(c > yield->reach)) {
        return;
    }
    double first = SectionMoment(yield->reach, yield->hardening);
    double spent = SectionEnergy(yield->reach, c, yield->hardening) - 0.5 * (g - first) * (g + first);
    yield->flows = true;
    yield->turns = e.fold == 0.0;
    yield->c = c;
    yield->share = L * g / length;
    yield->slope = (1.0 - yield->hardening) / (c * c * c) + yield->hardening;
    yield->lost = yield->stiffness * L * L * kiriMax(spent, 0.0);
    yield->along[0] = e.bending / length;
    yield->along[1] = sqrt(yield->perTwist) * e.twist / length;
    double flow = 1.0 - yield->share;
    offset->bending += flow * e.bending;
    offset->twist += flow * e.twist;
    offset->fold += flow * e.fold;
}

void kiriYield_TurnRows(const kiriYield* yield, int width, double* bending, double* twist, double* const elastic[2])
{
    double a = yield->along[0], b = yield->along[1], root = sqrt(yield->perTwist);
    KIRI_TIMES_WHILE(yield->turns, n, width) {
        double along = a * bending[n] + b * root * twist[n], across = a * root * twist[n] - b * bending[n];
        bending[n] = along;
        twist[n] = across;
        if (elastic[0] != NULL) {
            elastic[0][n] = a * yield->slope * along - b * yield->share * across;
            elastic[1][n] = (b * yield->slope * along + a * yield->share * across) / root;
        }
    }
    KIRI_TIMES_WHILE(!yield->turns && elastic[0] != NULL, n, width) {
        elastic[0][n] *= yield->share;
        elastic[1][n] *= yield->share;
    }
}

void kiriYield_TurnSprings(const kiriYield* yield, double loss, const kiriBentStrain* change, kiriBentStrain* springs,
                           kiriBentStrain* pulls)
{
    double k = yield->stiffness, a = yield->along[0], b = yield->along[1];
    if (yield->turns) {
        double bending = change->bending, twist = sqrt(yield->perTwist) * change->twist;
        springs->bending = k * yield->slope + loss;
        springs->twist = k * yield->share + loss;
        pulls->bending =
            -k * yield->limit * SectionMoment(yield->c, yield->hardening) - loss * (a * bending + b * twist);
        pulls->twist = -loss * (a * twist - b * bending);
    } else { /* the secant: the rows of bending, twist and fold have no common direction */
        double flow = 1.0 - yield->share;
        springs->bending -= flow * k;
        springs->twist -= flow * k * yield->perTwist;
        springs->fold -= flow * k * yield->perFold;
    }
}

/* ---- Folds -------------------------------------------------------------------------------------------------------

   In a fold the vector a of bending and twist is seen as keep a, and as the fold lost |a|, where the squares of keep and
   lost have the sum 1 (kiri_strain.h). So the vector follows from the three strains. */

static double LengthOf(const kiriBentStrain* seen)
{
    return sqrt(seen->bending * seen->bending + seen->twist * seen->twist + seen->fold * seen->fold);
}

/* Returns the vector; where the fold hides its direction, in the direction of another one. */
static kiriVec2 Unfold(const kiriBentStrain* seen, const kiriBentStrain* other)
{
    kiriVec2 v = { seen->bending, seen->twist };
    if (seen->fold == 0.0) {
        return v;
    }
    double length = kiriVec2_Length(v);
    if (!(length > 0.0)) {
        v = kiriVec2_Make(other->bending, other->twist);
        length = kiriVec2_Length(v);
    }
    return length > 0.0 ? kiriVec2_Scale(LengthOf(seen) / length, v) : kiriVec2_Make(LengthOf(seen), 0.0);
}

/* Returns the vector v as it is seen where the strains are `by`. */
static kiriBentStrain Refold(kiriVec2 v, const kiriBentStrain* by)
{
    double all = LengthOf(by);
    double keep = by->fold != 0.0 ? kiriVec2_Length(kiriVec2_Make(by->bending, by->twist)) / all : 1.0;
    double lost = by->fold != 0.0 ? fabs(by->fold) / all : 0.0;
    kiriBentStrain seen = { keep * v.x, keep * v.y, lost * kiriVec2_Length(v) };
    return seen;
}

void kiriYield_End(const kiriYield* yield, const kiriBentStrain* strain, kiriPlastic* plastic, kiriBentStrain* offset)
{
    if (yield->flows) {
        plastic->reach = yield->c;
        plastic->part.bending += offset->bending - yield->start.bending;
        plastic->part.twist += offset->twist - yield->start.twist;
        plastic->part.fold += offset->fold - yield->start.fold;
    }
    if (strain->fold != 0.0 || plastic->part.fold != 0.0) {
        kiriBentStrain seen = Refold(Unfold(&plastic->part, strain), strain);
        offset->bending += seen.bending - plastic->part.bending;
        offset->twist += seen.twist - plastic->part.twist;
        offset->fold += seen.fold - plastic->part.fold;
        plastic->part = seen;
    }
}

/* ---- Commits ------------------------------------------------------------------------------------------------------ */

kiriTensor kiriTensor_Solve(kiriTensor m, const kiriVec2 B[2])
{
    double a = m.uu, b = m.uv, c = m.vv, sum = a + c;
    double p = B[0].x, q = B[0].y + B[1].x, r = B[1].y;
    double middle = sum - b * b / a - b * b / c;
    kiriTensor t;
    t.uv = (q - b * p / a - b * r / c) / middle;
    t.uu = (p - b * t.uv) / a;
    t.vv = (r - b * t.uv) / c;
    return t;
}

static kiriVec2 AlongTensor(kiriTensor t, kiriVec2 s)
{
    return kiriVec2_Make(t.uu * s.x + t.uv * s.y, t.uv * s.x + t.vv * s.y);
}

/* Returns a strain by length, as a vector of the rest plane: the curvature times the normal of the link. */
static kiriVec2 CurvatureOf(const kiriBentStrain* strain, const kiriLink* link)
{
    const kiriBentStrain none = { 1.0, 0.0, 0.0 };
    kiriVec2 v = kiriVec2_Scale(1.0 / link->length, Unfold(strain, &none));
    return kiriLink_FromEdge(link, v);
}

#define MOST_REST 1.5 /* rad: angle of a link at rest; beyond, strains move to the fold */

/* Returns the rest curvature of a material times the normal of a link. Strains count bending to the back. */
static kiriVec2 RestCurvatureOf(const kiriMaterial* material, const kiriLink* link)
{
    const float* rest = material->restCurvature;
    kiriVec2 v = AlongTensor((kiriTensor){ -rest[0], -rest[2], -rest[1] }, link->normal);
    double angle = link->length * kiriVec2_Length(v);
    return angle > MOST_REST ? kiriVec2_Scale(MOST_REST / angle, v) : v;
}

/* Returns a curvature times the normal of a link, as strains that are folded as `by` is. */
static kiriBentStrain BendTo(kiriVec2 curvature, const kiriLink* link, const kiriBentStrain* by)
{
    curvature = kiriVec2_Scale(link->length, curvature);
    kiriVec2 parts = { kiriVec2_Dot(curvature, link->normal), kiriVec2_Dot(curvature, link->tangent) };
    return Refold(kiriLink_AlongEdge(link, parts), by);
}

kiriPlastic kiriPlastic_AtRest(const kiriMaterial* material, const kiriLink* link)
{
    const kiriBentStrain flat = { 1.0, 0.0, 0.0 };
    return (kiriPlastic){ BendTo(RestCurvatureOf(material, link), link, &flat), 0.0 };
}

void kiriPlastic_Rest(kiriPlastic* plastic, const kiriMaterial* before, const kiriMaterial* now, const kiriLink* link)
{
    kiriVec2 change = kiriVec2_Sub(RestCurvatureOf(now, link), RestCurvatureOf(before, link));
    plastic->part = BendTo(kiriVec2_Add(CurvatureOf(&plastic->part, link), change), link, &plastic->part);
}

/* Adds a link to its two regions. */
static void AddLink(kiriPlasticRegion* regions, const kiriLink* link, kiriVec2 curvature, double reach)
{
    double w = link->width * link->length;
    kiriVec2 n = kiriVec2_Scale(w, link->normal);
    KIRI_TIMES(end, 2) {
        kiriPlasticRegion* region = &regions[end == 0 ? link->i : link->j];
        region->matrix.uu += n.x * link->normal.x;
        region->matrix.uv += n.x * link->normal.y;
        region->matrix.vv += n.y * link->normal.y;
        region->by[0] = kiriVec2_AddScaled(region->by[0], curvature.x, n);
        region->by[1] = kiriVec2_AddScaled(region->by[1], curvature.y, n);
        region->reach += w * reach;
        region->weight += w;
    }
}

/* Solves twice, the second time for the residual of the first: so the addition to the matrix affects only the undetermined
   part. Regions without links have no curvature. */
static void SolveRegions(kiriPlasticRegion* regions, int32_t count)
{
    const double share = 0.02;
    KIRI_TIMES(f, count) {
        kiriPlasticRegion* region = &regions[f];
        if (region->weight > 0.0) {
            kiriTensor m = region->matrix, more, t;
            double least = share * (m.uu + m.vv);
            m.uu += least;
            m.vv += least;
            t = kiriTensor_Solve(m, region->by);
            const kiriVec2 rest[2] = { { least * t.uu, least * t.uv }, { least * t.uv, least * t.vv } };
            more = kiriTensor_Solve(m, rest);
            region->bent = (kiriTensor){ t.uu + more.uu, t.uv + more.uv, t.vv + more.vv };
            region->reach /= region->weight;
        }
    }
}

#define LEAST_LIMIT 0.2 /* of the whole */

void kiriYields_Share(kiriYield* yields, const kiriLink* links, int32_t linkCount, kiriPlasticRegion* regions,
                      int32_t frameCount)
{
    memset(regions, 0, sizeof(*regions) * (size_t)frameCount);
    linkCount = kiriLink_CountBorders(links, linkCount);
    KIRI_TIMES(k, linkCount) {
        AddLink(regions, &links[k], CurvatureOf(&yields[k].elastic, &links[k]), 0.0);
    }
    SolveRegions(regions, frameCount);
    KIRI_TIMES(k, linkCount) {
        const kiriTensor *a = &regions[links[k].i].bent, *b = &regions[links[k].j].bent;
        double mean = 0.25 * (a->uu + a->vv + b->uu + b->vv), half = 0.25 * (a->uu - a->vv + b->uu - b->vv);
        double across = 0.5 * (a->uv + b->uv), most = fabs(mean) + sqrt(half * half + across * across);
        double seen = kiriVec2_Length(CurvatureOf(&yields[k].elastic, &links[k]));
        yields[k].limit *= seen < most ? kiriMax(seen / most, LEAST_LIMIT) : 1.0;
    }
}

bool kiriPlastics_Reserve(kiriPlastics* plastics, kiriMemory* memory, int32_t linkCount, int32_t frameCount)
{
    return kiriArrays_Reserve(memory, linkCount, &plastics->links, &plastics->next) &&
           kiriArray_Reserve(memory, &plastics->regions, frameCount);
}

void kiriPlastics_Remember(kiriPlastics* plastics, const kiriLink* links, int32_t linkCount, int32_t oldCount,
                           int32_t frameCount, const kiriOwnership* ownership, const kiriMaterial* material, double extent)
{
    kiriPlasticRegion* regions = plastics->regions.data;
    KIRI_ASSERT(frameCount <= plastics->regions.capacity && oldCount <= frameCount);
    KIRI_ASSERT(plastics->links.count == 0 || plastics->links.count == linkCount);
    plastics->regions.count = frameCount;
    memset(regions, 0, sizeof(*regions) * (size_t)frameCount);
    for (int32_t k = 0, end = kiriLink_CountBorders(links, plastics->links.count); k < end; ++k) {
        const kiriPlastic* plastic = &plastics->links.data[k];
        kiriVec2 flowed = kiriVec2_Sub(CurvatureOf(&plastic->part, &links[k]), RestCurvatureOf(material, &links[k]));
        AddLink(regions, &links[k], flowed, plastic->reach);
    }
    SolveRegions(regions, oldCount);
    for (int32_t f = oldCount; f < frameCount && f < ownership->first.count; ++f) {
        double whole = 0.0;
        for (int32_t n = ownership->first.data[f]; n != KIRI_NONE; n = ownership->transfers.data[n].next) {
            const kiriTransfer* transfer = &ownership->transfers.data[n];
            double area = transfer->from < oldCount ? kiriTally_Moments(&transfer->material, extent).area : 0.0;
            if (area > 0.0) {
                const kiriPlasticRegion* from = &regions[transfer->from];
                whole += area;
                double part = area / whole; /* a running mean */
                regions[f].bent.uu += part * (from->bent.uu - regions[f].bent.uu);
                regions[f].bent.uv += part * (from->bent.uv - regions[f].bent.uv);
                regions[f].bent.vv += part * (from->bent.vv - regions[f].bent.vv);
                regions[f].reach += part * (from->reach - regions[f].reach);
            }
        }
    }
}

kiriPlastic kiriPlastic_Scaled(const kiriPlastic* plastic, double scale)
{
    kiriPlastic scaled = { { scale * plastic->part.bending, scale * plastic->part.twist, scale * plastic->part.fold },
                           plastic->reach };
    return scaled;
}

/* Returns the mean plastic curvature of the regions i and j, times a normal. */
static kiriVec2 MeanCurvature(const kiriPlastics* plastics, int32_t i, int32_t j, kiriVec2 normal)
{
    const kiriPlasticRegion* regions = plastics->regions.data;
    KIRI_ASSERT(i >= 0 && i < plastics->regions.count && j >= 0 && j < plastics->regions.count);
    return kiriVec2_Scale(0.5,
                          kiriVec2_Add(AlongTensor(regions[i].bent, normal), AlongTensor(regions[j].bent, normal)));
}

void kiriPlastics_Take(kiriPlastics* plastics, const kiriLink* old, const kiriLink* links, int32_t linkCount,
                       const int32_t* from, const kiriMaterial* material)
{
    KIRI_ASSERT(linkCount <= plastics->next.capacity && linkCount <= plastics->links.capacity);
    KIRI_TIMES(k, linkCount) {
        const kiriLink *link = &links[k], *was = from[k] != KIRI_NONE ? &old[from[k]] : NULL;
        kiriPlastic* next = &plastics->next.data[k];
        bool hasOlder = was != NULL && from[k] < plastics->links.count;
        if (link->fold != 0 && !hasOlder) {
            KIRI_CLEAR(next);
            continue;
        }
        if (hasOlder && (link->fold != 0 || memcmp(was, link, sizeof(*link)) == 0)) {
            *next = plastics->links.data[from[k]];
            continue;
        }
        kiriVec2 curvature = MeanCurvature(plastics, link->i, link->j, link->normal);
        kiriBentStrain by = { 1.0, 0.0, 0.0 };
        next->reach = 0.5 * (plastics->regions.data[link->i].reach + plastics->regions.data[link->j].reach);
        if (hasOlder) { /* it keeps its difference to the mean */
            const kiriPlastic* older = &plastics->links.data[from[k]];
            kiriVec2 mean = kiriVec2_Add(MeanCurvature(plastics, was->i, was->j, was->normal), RestCurvatureOf(material, was));
            curvature = kiriVec2_Add(curvature, kiriVec2_Sub(CurvatureOf(&older->part, was), mean));
            by = older->part;
            next->reach = older->reach;
        }
        next->part = BendTo(kiriVec2_Add(curvature, RestCurvatureOf(material, link)), link, &by);
    }
    kiriArray_Swap(&plastics->links, &plastics->next);
    plastics->links.count = linkCount;
}
