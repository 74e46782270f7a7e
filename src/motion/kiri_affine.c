#include "kiri_affine.h"
#include "kiri_curl.h"
#include "kiri_strain.h"

#include <string.h>

#define GAP_SHARE 0.3    /* of the membrane stiffness, against gaps in the plane */
#define LEAN_PENALTY 3.0 /* see kiri_affine.h: leaning counts 1 + 3 times */

/* ---- Links ------------------------------------------------------------------------------------------------------ */

/* The mean director of two frames. It changes with the director of end k by by[k] times the part of that change across
   the mean. */
typedef struct MeanDirector {
    kiriVec3 d;
    double by[2];
} MeanDirector;

/* Where the sheet is folded flat on itself there is no mean: the first frame's director serves. */
static MeanDirector FindMeanDirector(const kiriPose* const poses[2])
{
    kiriVec3 sum = kiriVec3_Add(poses[0]->A.d, poses[1]->A.d);
    double length = kiriVec3_Length(sum), first = kiriVec3_Length(poses[0]->A.d);
    if (length > 1e-6) {
        MeanDirector mean = { kiriVec3_Scale(1.0 / length, sum), { 1.0 / length, 1.0 / length } };
        return mean;
    }
    MeanDirector mean = { kiriVec3_Scale(first > 1e-6 ? 1.0 / first : 0.0, poses[0]->A.d),
                          { first > 1e-6 ? 1.0 / first : 0.0, 0.0 } };
    return mean;
}

static kiriVec3 AcrossDirector(const MeanDirector* mean, kiriVec3 a)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, mean->d), mean->d);
}

/* A difference of the two frames, sum over the ends of +-(x move + A_u at.x + A_v at.y): the gap at a point, or, with
   move 0, the difference of the slopes along a direction. */
typedef struct FrameDifference {
    double move;
    kiriVec2 at[2];
    kiriVec3 value;
} FrameDifference;

static FrameDifference TakeDifference(double move, kiriVec2 first, kiriVec2 second, const kiriPose* const poses[2])
{
    FrameDifference g = { move, { first, second }, { 0.0, 0.0, 0.0 } };
    g.value = kiriVec3_Scale(move, kiriVec3_Sub(poses[1]->x, poses[0]->x));
    kiriVec3 along = kiriVec3_Sub(kiriPose_Along(poses[1], second), kiriPose_Along(poses[0], first));
    g.value = kiriVec3_Add(g.value, along);
    return g;
}

static FrameDifference GapAt(const kiriFrameData* const frames[2], const kiriPose* const poses[2], kiriVec2 at)
{
    return TakeDifference(1.0, kiriVec2_Sub(at, frames[0]->center), kiriVec2_Sub(at, frames[1]->center), poses);
}

/* The derivative of a strain by the ends of a difference and by its mean director's turn. */
static void WriteRow(const FrameDifference* g, const MeanDirector* mean, kiriVec3 byValue, kiriVec3 byMean,
                     kiriFrameRow row[2])
{
    for (int k = 0; k < 2; ++k) {
        kiriVec3 by = kiriVec3_Scale(k == 0 ? -1.0 : 1.0, byValue);
        row[k].by[0] = kiriVec3_Scale(g->move, by);
        row[k].by[1] = kiriVec3_Scale(g->at[k].x, by);
        row[k].by[2] = kiriVec3_Scale(g->at[k].y, by);
        row[k].by[3] = kiriVec3_Scale(mean->by[k], AcrossDirector(mean, byMean));
    }
}

/* The part in the plane, one row an axis of space: P g = g - d (d . g). */
static void MeasureInPlane(const FrameDifference* g, const MeanDirector* mean, double* strain, kiriFrameRow rows[][2])
{
    const kiriVec3 axes[3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    double along = kiriVec3_Dot(g->value, mean->d);
    for (int a = 0; a < 3; ++a) {
        double lean = kiriVec3_Dot(axes[a], mean->d);
        strain[a] = kiriVec3_Dot(axes[a], g->value) - along * lean;
        if (rows != NULL) {
            kiriVec3 byMean = kiriVec3_Scale(-1.0, kiriVec3_AddScaled(kiriVec3_Scale(along, axes[a]), lean, g->value));
            WriteRow(g, mean, AcrossDirector(mean, axes[a]), byMean, rows[a]);
        }
    }
}

/* The difference of the directors, of which a strip that curls has more: see kiri_curl.h. */
static void MeasureBending(const kiriCurl* curl, const kiriPose* const poses[2], double* strain, kiriFrameRow rows[][2])
{
    const kiriVec3 axes[3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } }, zero = { 0.0, 0.0, 0.0 };
    kiriVec3 bent = kiriVec3_Sub(poses[1]->A.d, poses[0]->A.d);
    double slope, factor = kiriCurl_Factor(curl, kiriVec3_Dot(bent, bent), &slope);
    for (int a = 0; a < 3; ++a) {
        double part = kiriVec3_Dot(axes[a], bent);
        strain[a] = factor * part;
        if (rows != NULL) {
            kiriVec3 by = kiriVec3_AddScaled(kiriVec3_Scale(factor, axes[a]), 2.0 * slope * part, bent);
            kiriFrameRow first = { { zero, zero, zero, kiriVec3_Scale(-1.0, by) } };
            kiriFrameRow second = { { zero, zero, zero, by } };
            rows[a][0] = first;
            rows[a][1] = second;
        }
    }
}

void kiriAffine_AddTrace(kiriVec2 p, const kiriPose* const poses[2], double* strain, kiriFrameRow* const rows[2])
{
    kiriVec3 bent = kiriVec3_Sub(poses[1]->A.d, poses[0]->A.d);
    kiriVec3 along = kiriVec3_Add(kiriPose_Along(poses[0], p), kiriPose_Along(poses[1], p));
    *strain += 0.5 * kiriVec3_Dot(bent, along);
    for (int k = 0; rows != NULL && k < 2; ++k) {
        kiriVec3* by = rows[k]->by;
        by[1] = kiriVec3_AddScaled(by[1], 0.5 * p.x, bent);
        by[2] = kiriVec3_AddScaled(by[2], 0.5 * p.y, bent);
        by[3] = kiriVec3_AddScaled(by[3], k == 0 ? -0.5 : 0.5, along);
    }
}

static void MeasureTwist(const kiriLink* link, const kiriPose* const poses[2], double* strain, kiriFrameRow row[2])
{
    *strain = 0.0;
    if (row == NULL) {
        kiriAffine_AddTrace(link->tangent, poses, strain, NULL);
    } else {
        kiriFrameRow* const rows[2] = { &row[0], &row[1] };
        memset(row, 0, 2 * sizeof(*row));
        kiriAffine_AddTrace(link->tangent, poses, strain, rows);
    }
}

static void MeasureNormalGap(const kiriLink* link, const FrameDifference* g, const MeanDirector* mean, double* strain,
                             kiriFrameRow rows[][2])
{
    kiriVec3 zero = { 0.0, 0.0, 0.0 };
    double gap = kiriVec3_Dot(g->value, mean->d), over = fabs(gap) - KIRI_NORMAL_STOP_SHARE * link->length;
    strain[0] = gap;
    strain[1] = over <= 0.0 ? 0.0 : gap > 0.0 ? over : -over;
    if (rows != NULL) {
        WriteRow(g, mean, mean->d, g->value, rows[0]);
        WriteRow(g, mean, over > 0.0 ? mean->d : zero, over > 0.0 ? g->value : zero, rows[1]);
    }
}

void kiriAffine_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_AFFINE_STRAINS], kiriFrameRow rows[][2])
{
    /* Rows of bending see twist too, which does not stiffen: only of strips one region wide, where it is little. */
    kiriCurl curl = kiriCurl_Of(link, material, kiriLink_LoneWidth(link));
    MeanDirector mean = FindMeanDirector(poses);
    FrameDifference b = GapAt(frames, poses, link->centroid), m = GapAt(frames, poses, link->crossing);
    FrameDifference side = TakeDifference(0.0, link->tangent, link->tangent, poses);
    MeasureInPlane(&b, &mean, strain + KIRI_AFFINE_GAP, rows);
    MeasureInPlane(&side, &mean, strain + KIRI_AFFINE_PLANE_BENDING,
                   rows != NULL ? rows + KIRI_AFFINE_PLANE_BENDING : NULL);
    MeasureBending(&curl, poses, strain + KIRI_AFFINE_BENDING, rows != NULL ? rows + KIRI_AFFINE_BENDING : NULL);
    MeasureTwist(link, poses, strain + KIRI_AFFINE_TWIST, rows != NULL ? rows[KIRI_AFFINE_TWIST] : NULL);
    MeasureNormalGap(link, &m, &mean, strain + KIRI_AFFINE_NORMAL_GAP,
                     rows != NULL ? rows + KIRI_AFFINE_NORMAL_GAP : NULL);
}

void kiriAffine_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_AFFINE_STRAINS])
{
    double h = (double)material->thickness, nu = (double)material->poissonsRatio, l = link->length;
    double membrane = (double)material->youngsModulus * h / l, bending = membrane * h * h / (12.0 * (1.0 - nu * nu));
    for (int a = 0; a < 3; ++a) {
        stiffness[KIRI_AFFINE_GAP + a] = GAP_SHARE * membrane * link->width;
        stiffness[KIRI_AFFINE_PLANE_BENDING + a] = membrane * link->moment;
        stiffness[KIRI_AFFINE_BENDING + a] = bending * (1.0 - nu) * (link->width + nu * link->outer);
    }
    stiffness[KIRI_AFFINE_TWIST] = bending * (1.0 - nu) * (1.0 - nu) * link->outer;
    stiffness[KIRI_AFFINE_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * kiriStrain_NormalGapWidth(link, nu) / (l * l);
    stiffness[KIRI_AFFINE_NORMAL_STOP] = membrane * link->width;
}

/* ---- Regions ---------------------------------------------------------------------------------------------------- */

/* The share of a frame in the element that is being made; shares are kept in the order of frames. */
static kiriFrameShare* FrameShareOf(kiriAreaElements* elements, kiriMemory* memory, kiriAreaElement* element,
                                    int32_t frame)
{
    int32_t k = element->first + element->count;
    while (k > element->first && elements->shares.data[k - 1].frame > frame) {
        --k;
    }
    if (k > element->first && elements->shares.data[k - 1].frame == frame) {
        return &elements->shares.data[k - 1];
    }
    kiriFrameShare fresh = { frame, { 0.0, 0.0 }, { 0.0, 0.0 }, { 0.0, 0.0 }, 0.0, { 0.0, 0.0 } };
    if (!kiriArray_Push(memory, &elements->shares, fresh)) {
        return NULL;
    }
    for (int32_t n = elements->shares.count - 1; n > k; --n) {
        elements->shares.data[n] = elements->shares.data[n - 1];
    }
    elements->shares.data[k] = fresh;
    ++element->count;
    return &elements->shares.data[k];
}

/* What the frame at one end of a border brings to the integral of gap (x) n, times `scale`. */
static void AddEnd(kiriFrameShare* share, const kiriLink* link, kiriVec2 center, double scale)
{
    kiriVec2 normal = kiriVec2_Scale(scale, link->sum), arm = kiriVec2_Sub(link->centroid, center);
    share->move = kiriVec2_Add(share->move, normal);
    share->u =
        kiriVec2_Add(share->u, kiriVec2_Add(kiriVec2_Scale(arm.x, normal), kiriVec2_Scale(scale, link->spread[0])));
    share->v =
        kiriVec2_Add(share->v, kiriVec2_Add(kiriVec2_Scale(arm.y, normal), kiriVec2_Scale(scale, link->spread[1])));
}

/* What the elements of regions are made from: the links of region i are links[start[i]] to links[start[i + 1]]. */
typedef struct RegionLinks {
    kiriMemory* memory;
    const kiriMoments* material; /* of each region */
    KIRI_ARRAY(int32_t) start;
    KIRI_ARRAY(const kiriLink*) links;
} RegionLinks;

static bool AddBorder(kiriAreaElements* elements, const RegionLinks* regions, kiriAreaElement* element,
                      const kiriLink* link)
{
    for (int end = 0; end < 2; ++end) {
        int32_t frame = end == 0 ? link->i : link->j;
        kiriFrameShare* share = FrameShareOf(elements, regions->memory, element, frame);
        if (share == NULL) {
            return false;
        }
        double half = 0.5 / element->area;
        AddEnd(share, link, kiriMoments_Center(&regions->material[frame]), end == 0 ? -half : half);
    }
    return true;
}

/* An element with the frame's own A. */
static bool BeginAreaElement(kiriAreaElements* elements, kiriMemory* memory, kiriAreaElement* element, int32_t frame)
{
    kiriFrameShare* share = FrameShareOf(elements, memory, element, frame);
    if (share != NULL) {
        share->u.x = share->v.y = share->weight = 1.0;
    }
    return share != NULL;
}

static bool AddMembrane(kiriAreaElements* elements, const RegionLinks* regions, int32_t frame)
{
    double area = regions->material[frame].area;
    kiriAreaElement element = {
        area, LEAN_PENALTY, elements->shares.count, 0, KIRI_AREA_DILATION, KIRI_AREA_SHEAR + 1
    };
    bool ok = BeginAreaElement(elements, regions->memory, &element, frame);
    for (int32_t k = regions->start.data[frame]; ok && k < regions->start.data[frame + 1]; ++k) {
        ok = AddBorder(elements, regions, &element, regions->links.data[k]);
    }
    return ok && kiriArray_Push(regions->memory, &elements->elements, element);
}

static bool AddDirector(kiriAreaElements* elements, const RegionLinks* regions, int32_t frame)
{
    double area = regions->material[frame].area;
    kiriAreaElement element = { area, 0.0, elements->shares.count, 0, KIRI_AREA_LEAN_U, KIRI_AREA_STRAINS };
    return BeginAreaElement(elements, regions->memory, &element, frame) &&
           kiriArray_Push(regions->memory, &elements->elements, element);
}

static bool CollectLinksByRegion(RegionLinks* regions, const kiriLink* links, int32_t linkCount, int32_t frameCount)
{
    if (!kiriArray_Resize(regions->memory, &regions->start, (int64_t)frameCount + 1) ||
        !kiriArray_Resize(regions->memory, &regions->links, 2 * (int64_t)linkCount)) {
        return false;
    }
    int32_t* start = regions->start.data;
    for (int32_t i = 0; i <= frameCount; ++i) {
        start[i] = 0;
    }
    for (int32_t k = 0; k < linkCount; ++k) {
        ++start[links[k].i];
        ++start[links[k].j];
    }
    for (int32_t i = 0; i < frameCount; ++i) {
        start[i + 1] += start[i];
    }
    for (int32_t k = linkCount - 1; k >= 0; --k) {
        regions->links.data[--start[links[k].i]] = &links[k];
        regions->links.data[--start[links[k].j]] = &links[k];
    }
    return true;
}

bool kiriAffine_Build(kiriAreaElements* elements, kiriMemory* memory, const kiriLink* links, int32_t linkCount,
                      const kiriMoments* material, int32_t frameCount, bool planar)
{
    RegionLinks regions = { memory, material, { 0 }, { 0 } };
    elements->elements.count = elements->shares.count = 0;
    bool ok = CollectLinksByRegion(&regions, links, linkCount, frameCount);
    for (int32_t i = 0; ok && i < frameCount; ++i) {
        ok = AddMembrane(elements, &regions, i) && (planar || AddDirector(elements, &regions, i));
    }
    kiriArray_Release(memory, &regions.start);
    kiriArray_Release(memory, &regions.links);
    return ok;
}
