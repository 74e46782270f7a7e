#include "kiri_tear.h"

#include "kiri_piece.h"
#include "../field/kiri_site.h"

#define RING_INNER 0.5  /* spacings: radii of the ring in which energy is measured */
#define RING_OUTER 1.5
#define REACH 2.0       /* spacings ahead over which the stress is taken */
#define TURN 1.5        /* rad: of a tear over a spacing, at most */
#define PACE 0.5        /* spacings in a tick, at most */
#define LEAST_PACE 0.05 /* spacings, where the pace is lower: each step shakes the sheet */
#define SLOW_PACE 0.02  /* spacings, where a longer step takes all tension away */
#define TO_SLACK 1.5    /* of the step after which the tension is as the tear takes it: legs that are bent are as soft again */
#define LEAST_STEP 4.0  /* snap distances */
#define ROUNDED 4.0      /* lattice steps: a tip this near to a lip is on it */
#define LINE_REACH 2.0  /* snap distances: a tip this near to a tear line is on it */
#define STRESS_SHARE 2.0 /* spacings: the stress ahead opens a crack of about this length */
#define OWN_REACH 1.0    /* spacings around a site: the mean stress there is compared with the strength */
#define STRONG_REACH 0.3 /* times toughness E / strength^2: the mean over a half disc of a crack that just tears */
#define FIRST_STEP 0.5   /* spacings: length of a new tear */
#define TIP_REACH 2.0    /* spacings from a tip within which no other tear begins */

bool kiriTears_AreGrowing(const kiriSheetData* sheet)
{
    bool isTearing = false;
    KIRI_EACH_OF(kiriCutData, cut, sheet->cuts) {
        isTearing |= kiriCut_IsTear(cut);
    }
    return isTearing;
}

double kiriTears_Spacing(const kiriSheetData* sheet, int32_t piece)
{
    int32_t frames = 0;
    double area = 0.0;
    KIRI_EACH_INDEX(f, sheet->layout.framePiece) {
        bool isIn = sheet->layout.framePiece.data[f] == piece;
        frames += isIn;
        area += isIn ? sheet->frames.data[f].area : 0.0;
    }
    KIRI_ASSERT(frames > 0 && area > 0.0);
    return sqrt(area / frames);
}

/* ---- Tips -------------------------------------------------------------------------------------------------------- */

static bool IsTipBefore(const void* context, int32_t a, int32_t b)
{
    const kiriTearTip *s = &((const kiriTears*)context)->found.data[a], *t = &((const kiriTears*)context)->found.data[b];
    kiriLatticePoint p = s->point, q = t->point;
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : s->along.x != t->along.x ? s->along.x < t->along.x :
                                                                                        s->along.y < t->along.y;
}

static bool IsTornEdge(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_Twin(mesh, h) == KIRI_NONE || (kiriMesh_IsOpen(mesh, h) && !kiriMesh_IsCrease(mesh, h));
}

/* Returns true if lips keep a snap distance from a point. */
static bool IsClear(const kiriSheetData* sheet, kiriVec2 p)
{
    const kiriMeshData* mesh = &sheet->mesh;
    kiriLatticePoint at = kiriMesh_Snap(mesh, p);
    kiriNearby around = kiriNearby_Begin(&mesh->squares, at, at, sheet->settings.snap);
    bool isClear = true;
    KIRI_EACH_NEARBY(t, around) {
        KIRI_FROM_TO(h, 3 * t, 3 * t + 3) {
            kiriVec2 a = kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, h));
            kiriVec2 b = kiriMesh_Local(mesh, kiriMesh_HeadAt(mesh, h));
            isClear &= !IsTornEdge(mesh, h) || kiriVec2_DistanceToWay(p, a, b) > sheet->settings.snap * mesh->step;
        }
    }
    return isClear;
}

static bool IsOn(const kiriSheetData* sheet, const kiriTearLine* line, kiriVec2 p)
{
    return kiriVec2_DistanceToWay(p, line->from, line->to) <= LINE_REACH * sheet->settings.snap * sheet->mesh.step;
}

/* Finds where a perforation meets a lip. Lips along the perforation, as of a tear that follows it, do not count. */
static bool FindLineEnd(const kiriSheetData* sheet, const kiriTearLine* line, int32_t h, kiriTearTip* tip)
{
    const kiriMeshData* mesh = &sheet->mesh;
    KIRI_ASSERT(h >= 0 && h < 3 * mesh->triangles.count && line->factor < 1.0);
    double snap = sheet->settings.snap * mesh->step, reach = LINE_REACH * snap;
    kiriVec2 a = kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, h)), b = kiriMesh_Local(mesh, kiriMesh_HeadAt(mesh, h));
    kiriVec2 from = line->from, e = kiriVec2_Normalize(kiriVec2_Sub(line->to, from));
    double left = kiriVec2_Cross(e, kiriVec2_Sub(a, from)), right = kiriVec2_Cross(e, kiriVec2_Sub(b, from));
    if ((left > reach) == (right > reach)) {
        return false;
    }
    kiriVec2 at = kiriVec2_AddScaled(a, kiriClamp(left / (left - right), 0.0, 1.0), kiriVec2_Sub(b, a));
    e = left > right ? e : kiriVec2_Scale(-1.0, e);
    *tip = (kiriTearTip){ kiriMesh_Snap(mesh, at), e, kiriMesh_Tail(mesh, h) };
    return IsOn(sheet, line, at) && IsClear(sheet, kiriVec2_AddScaled(at, LEAST_STEP * snap, tip->along));
}

/* The ends of slits, sharp notches, and perforations at lips. Their order does not depend on how the mesh came about. */
bool kiriTears_List(kiriSheetData* sheet)
{
    const kiriMeshData* mesh = &sheet->mesh;
    kiriTears* tears = &sheet->tears;
    if (tears->areListed) {
        return true;
    }
    tears->found.count = 0;
    KIRI_EACH_INDEX(v, mesh->vertices) {
        kiriTearTip tip = { kiriMesh_At(mesh, v), { 0.0, 0.0 }, v };
        if (kiriSlits_WayOn(mesh, v, &tip.along) && !kiriArray_Push(sheet->memory, &tears->found, tip)) {
            return false;
        }
    }
    KIRI_TIMES_WHILE(sheet->tearLines.count > 0, h, 3 * mesh->triangles.count) {
        KIRI_EACH_WHILE(IsTornEdge(mesh, h), const kiriTearLine, line, sheet->tearLines) {
            kiriTearTip tip;
            if (line->factor < 1.0 && FindLineEnd(sheet, line, h, &tip) &&
                !kiriArray_Push(sheet->memory, &tears->found, tip)) {
                return false;
            }
        }
    }
    tears->areListed = kiriSort_Order(sheet->memory, &tears->order, tears->found.count, IsTipBefore, tears);
    return tears->areListed;
}

/* ---- Strains ----------------------------------------------------------------------------------------------------- */

/* Measures the strains of a link that pull. */
static void MeasurePull(const kiriSheetData* sheet, int32_t k, const kiriLink* link, const kiriFrameData* i,
                        const kiriFrameData* j, double pulling[KIRI_STRAINS])
{
    const kiriStrainOffset none = { { 0.0 } };
    double strain[KIRI_STRAINS];
    bool hasOffsets = sheet->strainOffsets.strainOffsets.count > 0;
    const double* offset = hasOffsets ? sheet->strainOffsets.strainOffsets.data[k].strain : none.strain;
    kiriStrain_MeasureLink(link, &sheet->settings.material, i, j, offset[KIRI_PLANE_BENDING], strain);
    kiriStrain_TakeOffsets(strain, offset, KIRI_STRAINS, false, pulling);
}

/* Measures the links, and fits a membrane strain to each region. */
static void MeasurePulls(kiriSheetData* sheet)
{
    kiriTears* tears = &sheet->tears;
    const kiriLink* links = sheet->links.links.data;
    int32_t count = kiriLink_CountBorders(links, sheet->links.links.count);
    KIRI_ASSERT(count <= tears->pulls.capacity && sheet->frames.count <= tears->regions.capacity);
    tears->pulls.count = count;
    tears->regions.count = sheet->frames.count;
    memset(tears->regions.data, 0, sizeof(kiriPlasticRegion) * sheet->frames.count);
    KIRI_TIMES(k, count) {
        double *pull = tears->pulls.data[k].strain, w = links[k].width / links[k].length;
        MeasurePull(sheet, k, &links[k], &sheet->frames.data[links[k].i], &sheet->frames.data[links[k].j], pull);
        kiriVec2 s = links[k].span, gap = kiriVec2_Scale(pull[KIRI_STRETCH], links[k].normal);
        gap = kiriVec2_AddScaled(gap, pull[KIRI_SHEAR], links[k].tangent);
        KIRI_TIMES(end, 2) {
            kiriPlasticRegion* region = &tears->regions.data[end == 0 ? links[k].i : links[k].j];
            region->matrix.uu += w * s.x * s.x;
            region->matrix.uv += w * s.x * s.y;
            region->matrix.vv += w * s.y * s.y;
            region->by[0] = kiriVec2_AddScaled(region->by[0], w * gap.x, s);
            region->by[1] = kiriVec2_AddScaled(region->by[1], w * gap.y, s);
        }
    }
    KIRI_EACH(kiriPlasticRegion, region, tears->regions) {
        double least = 0.02 * (region->matrix.uu + region->matrix.vv);
        region->matrix.uu += least;
        region->matrix.vv += least;
        if (least > 0.0) {
            region->bent = kiriTensor_Solve(region->matrix, region->by);
        }
    }
}

bool kiriTears_Measure(kiriSheetData* sheet)
{
    kiriTears* tears = &sheet->tears;
    KIRI_ASSERT(tears->areListed);
    if (!kiriArray_Reserve(sheet->memory, &tears->pulls, sheet->links.links.count) ||
        !kiriArray_Reserve(sheet->memory, &tears->regions, sheet->frames.count)) {
        return false;
    }
    if (tears->found.count > 0 || sheet->settings.tearing.strength > 0.0f) {
        MeasurePulls(sheet);
    }
    return true;
}

/* ---- Energy ------------------------------------------------------------------------------------------------------

   A domain integral (Shih, Moran and Nakamura 1986). The material moves by q e in the rest plane: q is 1 around the tip, and
   falls to 0 over a ring. The maps of the regions stay, so points far away keep their places. The loss of elastic energy is
   the energy that a longer tear sets free, per length. */

typedef struct Ring {
    kiriVec2 at, along;
    double inner, outer;
} Ring;

static double RingMoveAt(const Ring* ring, kiriVec2 p)
{
    double share = (ring->outer - kiriVec2_Distance(p, ring->at)) / (ring->outer - ring->inner);
    return share <= 0.0 ? 0.0 : kiriMin(share, 1.0);
}

/* Returns the move of a frame's site. The ring holds no load: a frame that a point pulls stays, but beside the tip. */
static double RingMoveOf(const kiriSheetData* sheet, const Ring* ring, int32_t frame)
{
    double share = RingMoveAt(ring, sheet->frames.data[frame].site.at);
    KIRI_EACH_INDEX_WHILE(share > 0.0 && share < 1.0, i, sheet->pins) {
        share = sheet->layout.pinFrame.data[i] == frame ? 0.0 : share;
    }
    return share;
}

/* Returns the energy of a link after its material has moved. moves: of its sites; wider: growth of its border. */
static double EnergyAfter(const kiriSheetData* sheet, int32_t k, const kiriVec2 moves[2], double wider)
{
    kiriLink link = sheet->links.links.data[k];
    kiriFrameData frames[2] = { sheet->frames.data[link.i], sheet->frames.data[link.j] };
    double pull[KIRI_STRAINS], stiffness[KIRI_STRAINS], sum = 0.0, growth = 1.0 + wider / link.width;
    KIRI_ASSERT(link.fold == 0 && growth > 0.0);
    double longer = kiriVec2_Dot(kiriVec2_Sub(moves[1], moves[0]), link.normal);
    kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(moves[0], moves[1]));
    link.length += longer;
    link.span = kiriVec2_AddScaled(link.span, longer, link.normal);
    link.width *= growth;
    link.outer *= growth;
    link.square *= growth;
    link.moment *= growth * growth * growth;
    link.centroid = kiriVec2_Add(link.centroid, middle);
    link.crossing = kiriVec2_Add(link.crossing, middle);
    KIRI_TIMES(end, 2) {
        kiriPose pose = kiriPose_Of(&frames[end]);
        frames[end].center = kiriVec2_Add(frames[end].center, moves[end]);
        frames[end].site.at = kiriVec2_Add(frames[end].site.at, moves[end]);
        frames[end].x = kiriVec3_Add(frames[end].x, kiriPose_Along(&pose, moves[end]));
    }
    MeasurePull(sheet, k, &link, &frames[0], &frames[1], pull);
    kiriStrain_Stiffness(&link, &sheet->settings.material, stiffness);
    KIRI_TIMES(e, KIRI_STRAINS) {
        sum += 0.5 * stiffness[e] * pull[e] * pull[e];
    }
    return sum;
}

/* Returns the energy that a link sets free. A link measures moves across its border; the last term is for moves along it. */
static double ReleaseOfLink(const kiriSheetData* sheet, const Ring* ring, int32_t k)
{
    const kiriLink* link = &sheet->links.links.data[k];
    const double* pull = sheet->tears.pulls.data[k].strain;
    kiriVec2 half = kiriVec2_Scale(0.5 * link->width, link->tangent), t = link->tangent;
    double i = RingMoveOf(sheet, ring, link->i), j = RingMoveOf(sheet, ring, link->j);
    double across = RingMoveAt(ring, kiriVec2_Add(link->centroid, half)) - RingMoveAt(ring, kiriVec2_Sub(link->centroid, half));
    /* The moved link keeps a width and a length. */
    double step = kiriMin(1e-4 * ring->outer, 0.25 * kiriMin(link->width, link->length));
    if (i == 0.0 && j == 0.0 && across == 0.0) {
        return 0.0;
    }
    double stiffness[KIRI_STRAINS], along = kiriVec2_Dot(ring->along, t);
    const kiriVec2 on[2] = { kiriVec2_Scale(i * step, ring->along), kiriVec2_Scale(j * step, ring->along) };
    const kiriVec2 back[2] = { kiriVec2_Scale(-1.0, on[0]), kiriVec2_Scale(-1.0, on[1]) };
    double wider = step * across * along;
    double lost = EnergyAfter(sheet, k, back, -wider) - EnergyAfter(sheet, k, on, wider);
    const kiriTensor *a = &sheet->tears.regions.data[link->i].bent, *b = &sheet->tears.regions.data[link->j].bent;
    double tt = 0.5 * (t.x * t.x * (a->uu + b->uu) + 2.0 * t.x * t.y * (a->uv + b->uv) + t.y * t.y * (a->vv + b->vv));
    kiriStrain_Stiffness(link, &sheet->settings.material, stiffness);
    double beside = stiffness[KIRI_STRETCH] * pull[KIRI_STRETCH] * pull[KIRI_SHEAR] / link->length +
                    stiffness[KIRI_SHEAR] * pull[KIRI_SHEAR] * tt;
    double part = sheet->linkParts.count > 0 ? sheet->linkParts.data[k].part : 1.0;
    return part * (0.5 * lost / step + (j - i) * along * beside);
}

/* Returns the energy that a corner sets free. Let t be the trace of the gradient of the displacement u, k its stiffness, and q' the
   gradient of q: k t (e . grad u) . q' - k t^2 / 2 e . q'. u is measured from frames that turn, so q k t times the divergence of
   what turns e is taken off. */
static double ReleaseOfCorner(const kiriSheetData* sheet, const Ring* ring, const kiriCorner* corner)
{
    const kiriLink* links = sheet->links.links.data;
    bool planar = sheet->settings.mechanics.planar;
    const double* pulls[4] = { 0 };
    double stiffness[KIRI_TRACES], sum = 0.0;
    kiriVec2 slope = { 0.0, 0.0 };
    KIRI_EACH_INDEX(n, *corner) {
        const kiriLink* link = &links[corner->link[n]];
        double change = RingMoveOf(sheet, ring, link->j) - RingMoveOf(sheet, ring, link->i);
        slope = kiriVec2_AddScaled(slope, change, corner->weight[n]);
        pulls[n] = sheet->tears.pulls.data[corner->link[n]].strain;
    }
    kiriTrace trace = kiriTrace_Measure(corner, links, pulls, planar);
    kiriTrace_Stiffness(corner, &sheet->settings.material, stiffness);
    double stretch = stiffness[KIRI_TRACE_STRETCH] * trace.strain[KIRI_TRACE_STRETCH];
    double bending = planar ? 0.0 : stiffness[KIRI_TRACE_CURVATURE] * trace.strain[KIRI_TRACE_CURVATURE];
    KIRI_EACH_INDEX(n, *corner) {
        const kiriLink* link = &links[corner->link[n]];
        double normal = kiriVec2_Dot(link->normal, slope), tangent = kiriVec2_Dot(link->tangent, slope);
        const kiriPose i = kiriPose_Of(&sheet->frames.data[link->i]), j = kiriPose_Of(&sheet->frames.data[link->j]);
        kiriVec3 turn = kiriVec3_Sub(kiriPose_Along(&j, ring->along), kiriPose_Along(&i, ring->along));
        double u = kiriVec3_Dot(turn, kiriVec3_Add(i.A.u, j.A.u)), v = kiriVec3_Dot(turn, kiriVec3_Add(i.A.v, j.A.v));
        double move = RingMoveOf(sheet, ring, link->i) + RingMoveOf(sheet, ring, link->j);
        sum -= 0.25 * move * stretch * kiriVec2_Dot(corner->weight[n], kiriVec2_Make(u, v));
        sum += kiriVec2_Dot(corner->weight[n], ring->along) *
               (stretch * (pulls[n][KIRI_STRETCH] * normal + pulls[n][KIRI_SHEAR] * tangent) +
                bending * (pulls[n][KIRI_BENDING] * normal + pulls[n][KIRI_TWIST] * tangent));
    }
    double stored = stretch * trace.strain[KIRI_TRACE_STRETCH] + bending * trace.strain[KIRI_TRACE_CURVATURE];
    return sum - 0.5 * stored * kiriVec2_Dot(ring->along, slope);
}

/* Returns the energy that a tear takes per length, N. */
static double TakenAlong(const kiriSheetData* sheet, kiriVec2 along)
{
    const kiriTearing* tearing = &sheet->settings.tearing;
    kiriVec2 grain = kiriVec2_Load(tearing->grain);
    double square = kiriVec2_Dot(grain, grain), sine = kiriVec2_Cross(grain, along);
    double across = square > 0.0 ? (tearing->grainRatio - 1.0) * sine * sine / square : 0.0;
    return tearing->toughness * (double)sheet->settings.material.thickness * (1.0 + kiriMax(across, 0.0));
}

/* ---- Direction --------------------------------------------------------------------------------------------------- */

/* Returns the membrane stress of a strain, times a weight, relative to Young's modulus. */
static kiriTensor StressOf(const kiriTensor* strain, double nu, double weight)
{
    double w = weight / (1.0 - nu * nu), trace = nu * (strain->uu + strain->vv);
    KIRI_ASSERT(nu >= 0.0 && nu < 1.0);
    return (kiriTensor){ w * ((1.0 - nu) * strain->uu + trace), w * (1.0 - nu) * strain->uv,
                         w * ((1.0 - nu) * strain->vv + trace) };
}

/* Returns the mean membrane stress over a half disc ahead, relative to Young's modulus. along 0: over the disc. */
static kiriTensor StressAhead(const kiriSheetData* sheet, kiriVec2 at, kiriVec2 along, int32_t piece, double reach)
{
    double nu = sheet->settings.material.poissonsRatio, mass = 0.0;
    kiriTensor sum = { 0.0, 0.0, 0.0 };
    KIRI_EACH_INDEX(f, sheet->tears.regions) {
        kiriVec2 off = kiriVec2_Sub(sheet->frames.data[f].site.at, at);
        if (sheet->layout.framePiece.data[f] == piece && kiriVec2_Dot(off, along) >= 0.0 &&
            kiriVec2_Dot(off, off) < reach * reach) {
            kiriTensor stress = StressOf(&sheet->tears.regions.data[f].bent, nu, sheet->frames.data[f].mass);
            sum = (kiriTensor){ sum.uu + stress.uu, sum.uv + stress.uv, sum.vv + stress.vv };
            mass += sheet->frames.data[f].mass;
        }
    }
    double scale = mass > 0.0 ? 1.0 / mass : 0.0;
    return (kiriTensor){ scale * sum.uu, scale * sum.uv, scale * sum.vv };
}

/* Returns the largest principal stress. */
static double LargestStress(const kiriTensor* stress)
{
    double half = 0.5 * (stress->uu - stress->vv);
    return 0.5 * (stress->uu + stress->vv) + sqrt(half * half + stress->uv * stress->uv);
}

/* Returns the mean stress over a reach, relative to the strength. The least reach is the one over which the mean ahead of a crack
   is the strength when the crack sets enough energy free: so short cracks tear at their strength, and long ones at their
   toughness (Taylor 2007, theory of critical distances). */
static double Load(const kiriSheetData* sheet, kiriVec2 at, kiriVec2 along, int32_t piece, double reach)
{
    double young = sheet->settings.material.youngsModulus, strength = sheet->settings.tearing.strength;
    KIRI_ASSERT(strength > 0.0 && reach > 0.0);
    double least = STRONG_REACH * sheet->settings.tearing.toughness * young / (strength * strength);
    kiriTensor stress = StressAhead(sheet, at, along, piece, kiriMax(reach, least));
    return young * kiriMax(LargestStress(&stress), 0.0) / strength;
}

/* Turns a unit vector by an angle of which `half` is the tangent of the half. */
static kiriVec2 TurnedWay(kiriVec2 e, double half)
{
    KIRI_ASSERT(half > -1.0 && half < 1.0);
    double scale = 1.0 / (1.0 + half * half), c = scale * (1.0 - half * half), s = scale * 2.0 * half;
    return kiriVec2_Make(c * e.x - s * e.y, s * e.x + c * e.y);
}

/* Returns the stress across a way, 0 or more. */
static double PullAcross(const kiriTensor* stress, kiriVec2 way)
{
    return kiriMax(way.y * way.y * stress->uu - 2.0 * way.x * way.y * stress->uv + way.x * way.x * stress->vv, 0.0);
}

/* Finds the direction with the largest stress across it, over the energy that it takes: both modes of a slanted crack together
   set free what grows with the stress, not with its square. opens: energy that the mean stress can set free, as a share of the
   whole. Where it is small, as in a leg that is torn off by bending, the tear goes straight on. */
static kiriVec2 AimTear(const kiriSheetData* sheet, kiriVec2 e, const kiriTensor* stress, double limit, double opens)
{
    enum { WAYS = 12 };
    double most = 0.0, best = 0.0;
    for (int m = -WAYS; m <= WAYS; ++m) {
        kiriVec2 way = TurnedWay(e, limit * m / WAYS);
        double value = PullAcross(stress, way) / TakenAlong(sheet, way);
        best = value > most ? limit * m / WAYS : best;
        most = kiriMax(value, most);
    }
    return TurnedWay(e, kiriMin(opens, 1.0) * best);
}

/* ---- The way on -------------------------------------------------------------------------------------------------- */

/* Returns the part of the way from a tip at which a line crosses it, above 0; 1: it does not. */
static double CrossedAt(const kiriMeshData* mesh, kiriVec2 a, kiriVec2 b, kiriVec2 from, kiriVec2 way)
{
    a = kiriVec2_Sub(a, from);
    b = kiriVec2_Sub(b, from);
    double left = kiriVec2_Cross(way, a), right = kiriVec2_Cross(way, b);
    if (left == right || left * right > 0.0) {
        return 1.0;
    }
    kiriVec2 at = kiriVec2_AddScaled(a, left / (left - right), kiriVec2_Sub(b, a));
    KIRI_ASSERT(way.x != 0.0 || way.y != 0.0);
    double square = kiriVec2_Dot(way, way), part = kiriVec2_Dot(at, way) / square;
    return part > ROUNDED * mesh->step / sqrt(square) ? part : 1.0;
}

/* Returns the part of a way that is free of lips and outline, but for those that end at a vertex; 1: all. */
static double FreePart(const kiriSheetData* sheet, kiriVec2 from, kiriVec2 way, int32_t vertex)
{
    const kiriMeshData* mesh = &sheet->mesh;
    kiriLatticePoint start = kiriMesh_Snap(mesh, from), end = kiriMesh_Snap(mesh, kiriVec2_Add(from, way));
    double part = 1.0;
    kiriNearby around = kiriNearby_Begin(&mesh->squares, start, end, 0.0);
    KIRI_EACH_NEARBY(t, around) {
        KIRI_FROM_TO(h, 3 * t, 3 * t + 3) {
            if (IsTornEdge(mesh, h) && kiriMesh_Tail(mesh, h) != vertex && kiriMesh_Head(mesh, h) != vertex) {
                kiriVec2 a = kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, h));
                part = kiriMin(CrossedAt(mesh, a, kiriMesh_Local(mesh, kiriMesh_HeadAt(mesh, h)), from, way), part);
            }
        }
    }
    return part;
}

/* Returns the energy that the tear sets free per length, N. The ring holds no other tip, if that leaves a spacing. */
static double ReleaseAt(const kiriSheetData* sheet, const kiriTearTip* tip, kiriVec2 at, double spacing)
{
    Ring ring = { at, tip->along, RING_INNER * spacing, RING_OUTER * spacing };
    double sum = 0.0;
    KIRI_EACH(const kiriTearTip, other, sheet->tears.found) {
        double d = kiriVec2_Distance(kiriMesh_Local(&sheet->mesh, other->point), at);
        ring.outer = d > 0.0 ? kiriMin(ring.outer, d) : ring.outer;
    }
    ring.outer = kiriMax(ring.outer, spacing);
    KIRI_EACH_INDEX(k, sheet->tears.pulls) {
        sum += ReleaseOfLink(sheet, &ring, k);
    }
    KIRI_EACH(const kiriCorner, corner, sheet->links.corners) {
        sum += ReleaseOfCorner(sheet, &ring, corner);
    }
    return sum;
}

/* A way on, with the energy that it sets free and the energy that it takes, N. */
typedef struct Way {
    kiriVec2 along;
    double free, taken, most; /* N, N, m */
} Way;

/* Returns the energy that the mean stress across a crack sets free, N. */
static double OpenedBy(double stress, double spacing, const kiriMaterial* material)
{
    double stiffness = material->youngsModulus * (double)material->thickness;
    KIRI_ASSERT(stress >= 0.0 && spacing > 0.0);
    return STRESS_SHARE * spacing * stiffness * stress * stress;
}

/* Multiplies the toughness where tear lines pass the tip, and chooses a perforation if its surplus is larger. A tear that
   turns by an angle c sets free cos(c/2)^4 of the energy that it sets free straight on. */
static void FollowLines(const kiriSheetData* sheet, kiriVec2 at, kiriVec2 straight, double release,
                        const kiriTensor* stress, double spacing, Way* best)
{
    const kiriMaterial* material = &sheet->settings.material;
    KIRI_ASSERT(spacing > 0.0 && best->taken >= 0.0 && kiriVec2_Dot(straight, straight) > 0.5);
    double tough = 1.0, least = LINE_REACH * sheet->settings.snap * sheet->mesh.step;
    KIRI_EACH(const kiriTearLine, line, sheet->tearLines) {
        if (IsOn(sheet, line, at)) { /* stress along a line opens nothing */
            tough = kiriMax(line->factor, tough);
            best->free = kiriMax(OpenedBy(PullAcross(stress, straight), spacing, material), release);
        }
    }
    best->taken *= tough;
    KIRI_EACH(const kiriTearLine, line, sheet->tearLines) {
        KIRI_TIMES_WHILE(line->factor < 1.0 && IsOn(sheet, line, at), end, 2) {
            kiriVec2 off = kiriVec2_Sub(end == 0 ? line->from : line->to, at);
            Way way = { kiriVec2_Normalize(off), 0.0, 0.0, kiriVec2_Length(off) };
            double share = 0.5 * (1.0 + kiriVec2_Dot(way.along, straight));
            kiriVec2 e = way.along;
            double pull = PullAcross(stress, e);
            double shear = e.x * e.y * (stress->vv - stress->uu) + (e.x * e.x - e.y * e.y) * stress->uv;
            double traction = sqrt(pull * pull + shear * shear);
            way.free = share * share * kiriMax(release, OpenedBy(traction, spacing, material));
            way.taken = line->factor * tough * TakenAlong(sheet, way.along);
            *best = way.most > least && way.free * best->taken > best->free * way.taken ? way : *best;
        }
    }
}

/* Returns the energy of a piece that is gone once it is slack: of tension, and of springs that pull. */
static double Tension(const kiriSheetData* sheet, int32_t piece)
{
    double sum = 0.0, stiffness[KIRI_STRAINS];
    KIRI_EACH_INDEX(k, sheet->tears.pulls) {
        const kiriLink* link = &sheet->links.links.data[k];
        const double* pull = sheet->tears.pulls.data[k].strain;
        if (sheet->layout.framePiece.data[link->i] == piece) {
            kiriStrain_Stiffness(link, &sheet->settings.material, stiffness);
            sum += 0.5 * (stiffness[KIRI_STRETCH] * pull[KIRI_STRETCH] * pull[KIRI_STRETCH] +
                          stiffness[KIRI_SHEAR] * pull[KIRI_SHEAR] * pull[KIRI_SHEAR]);
        }
    }
    KIRI_EACH(const kiriPinRow, pin, sheet->pinRows) {
        const kiriFrameData* frame = &sheet->frames.data[pin->frame];
        const kiriPose pose = kiriPose_Of(frame);
        kiriVec3 off = kiriPose_Along(&pose, kiriVec2_Sub(pin->at, frame->center));
        kiriVec3 way = kiriVec3_Sub(pin->target, kiriVec3_Add(pose.x, off));
        bool isIn = sheet->layout.framePiece.data[pin->frame] == piece;
        sum += isIn ? 0.5 * pin->stiffness * kiriVec3_Dot(way, way) : 0.0;
    }
    return sum;
}

kiriVec2 kiriTear_Next(const kiriSheetData* sheet, const kiriTearTip* tip, double most, kiriVec2* along)
{
    int32_t piece = kiriPiece_OfVertex(sheet, tip->vertex);
    kiriVec2 at = kiriMesh_Local(&sheet->mesh, tip->point);
    double spacing = kiriTears_Spacing(sheet, piece);
    KIRI_ASSERT(most > 0.0 && spacing > 0.0);
    kiriTensor stress = StressAhead(sheet, at, tip->along, piece, REACH * spacing);
    double largest = kiriMax(LargestStress(&stress), 0.0);
    /* The measure fails where commits left strains between frames that are not at rest: then the stress bounds it. */
    double opens = OpenedBy(largest, spacing, &sheet->settings.material), release = ReleaseAt(sheet, tip, at, spacing);
    if (sheet->settings.tearing.strength > 0.0f) {
        double load = Load(sheet, at, tip->along, piece, REACH * spacing);
        release = kiriMax(release, load * load * TakenAlong(sheet, tip->along));
    }
    Way way = { { 0.0, 0.0 }, kiriMax(release, opens), TakenAlong(sheet, tip->along), most };
    FollowLines(sheet, at, tip->along, release, &stress, spacing, &way);
    *along = tip->along;
    if (!(way.free > way.taken)) {
        return at;
    }
    double surplus = 1.0 - way.taken / way.free, slack = TO_SLACK * surplus * Tension(sheet, piece) / way.taken;
    double pace = kiriMin(spacing * (LEAST_PACE + PACE * surplus), kiriMax(slack, SLOW_PACE * spacing));
    double step = kiriMin(kiriMin(pace, way.most), most);
    /* Legs that are taut pull along the sheet: their stress grows with the square of the release. */
    double turns = 3.0 * opens * way.taken / (way.free * way.free);
    bool isFree = way.along.x == 0.0 && way.along.y == 0.0;
    *along = isFree ? AimTear(sheet, tip->along, &stress, 0.5 * TURN * step / spacing, turns) : way.along;
    kiriVec2 to = kiriVec2_Scale(step, *along);
    double part = FreePart(sheet, at, to, tip->vertex), least = LEAST_STEP * sheet->settings.snap * sheet->mesh.step;
    KIRI_EACH(const kiriTearLine, line, sheet->tearLines) {
        part = IsOn(sheet, line, at) ? part : kiriMin(CrossedAt(&sheet->mesh, line->from, line->to, at, to), part);
    }
    KIRI_ASSERT(part > 0.0 && part <= 1.0);
    return part < 1.0 || step >= least ? kiriVec2_AddScaled(at, part, to) : at;
}

/* ---- New tears --------------------------------------------------------------------------------------------------- */

/* Returns the frame around which the mean stress exceeds the strength most, or KIRI_NONE. Tips that are near go on instead. */
static int32_t FindLoaded(const kiriSheetData* sheet)
{
    const kiriMeshData* mesh = &sheet->mesh;
    double most = 1.0, strength = sheet->settings.tearing.strength / (double)sheet->settings.material.youngsModulus;
    int32_t found = KIRI_NONE;
    KIRI_EACH_INDEX(f, sheet->tears.regions) {
        const kiriFrameData* frame = &sheet->frames.data[f];
        int32_t piece = sheet->layout.framePiece.data[f];
        kiriTensor own = StressOf(&sheet->tears.regions.data[f].bent, sheet->settings.material.poissonsRatio, 1.0);
        if (LargestStress(&own) > strength && kiriPiece_IsAwake(&sheet->layout.pieces.data[piece])) {
            double spacing = kiriTears_Spacing(sheet, piece), near = TIP_REACH * spacing;
            double load = Load(sheet, frame->site.at, kiriVec2_Make(0.0, 0.0), piece, OWN_REACH * spacing);
            KIRI_EACH(const kiriTearTip, tip, sheet->tears.found) {
                load = kiriVec2_Distance(kiriMesh_Local(mesh, tip->point), frame->center) > near ? load : 0.0;
            }
            bool isMore = load > most && kiriMesh_Locate(mesh, kiriMesh_Snap(mesh, frame->center)) != KIRI_NONE;
            found = isMore ? f : found;
            most = isMore ? load : most;
        }
    }
    return found;
}

/* Begins at the nearest lip across the largest tension, or, if lips are over a spacing away, inside. */
bool kiriTears_FindStart(const kiriSheetData* sheet, double most, kiriVec2* from, kiriVec2* to)
{
    int32_t frame = FindLoaded(sheet);
    if (frame == KIRI_NONE) {
        return false;
    }
    const kiriFrameData* loaded = &sheet->frames.data[frame];
    int32_t piece = sheet->layout.framePiece.data[frame];
    double spacing = kiriTears_Spacing(sheet, piece), step = kiriMin(FIRST_STEP * spacing, most);
    kiriTensor stress = StressAhead(sheet, loaded->site.at, kiriVec2_Make(0.0, 0.0), piece, OWN_REACH * spacing);
    double tension = LargestStress(&stress);
    kiriVec2 u = { stress.uu - tension, stress.uv }, v = { stress.uv, stress.vv - tension }; /* both lie across it, or are 0 */
    kiriVec2 across = kiriVec2_Normalize(kiriVec2_Dot(u, u) > kiriVec2_Dot(v, v) ? u : v);
    across = kiriVec2_Dot(across, across) > 0.5 ? across : kiriVec2_Make(1.0, 0.0);
    double ahead = FreePart(sheet, loaded->center, kiriVec2_Scale(spacing, across), KIRI_NONE);
    double behind = FreePart(sheet, loaded->center, kiriVec2_Scale(-spacing, across), KIRI_NONE);
    across = ahead < behind ? kiriVec2_Scale(-1.0, across) : across; /* the lip behind is the nearer one */
    double back = ahead == 1.0 && behind == 1.0 ? 0.5 * step : spacing * kiriMin(ahead, behind);
    *from = kiriVec2_AddScaled(loaded->center, -back, across);
    *to = kiriVec2_AddScaled(*from, kiriMin(step, back + spacing * kiriMax(ahead, behind)), across);
    return step >= LEAST_STEP * sheet->settings.snap * sheet->mesh.step;
}
