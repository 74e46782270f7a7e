#include "kiri_element.h"

#include <string.h>

static const kiriAreaElement* AreaElementOf(const kiriSystem* system, int32_t k)
{
    return &system->areaElements->elements.data[k - kiriElement_LinkCount(system) - kiriElement_CornerCount(system)];
}

int kiriElement_StrainCount(const kiriSystem* system, int32_t k)
{
    bool planar = system->mechanics.planar;
    if (kiriElement_Corner(system, k) != NULL) {
        return planar || kiriMechanics_IsAffine(&system->mechanics) ? 1 : KIRI_TRACES;
    }
    if (kiriElement_Link(system, k) == NULL) {
        return AreaElementOf(system, k)->lastRow - AreaElementOf(system, k)->firstRow;
    }
    return kiriMechanics_IsAffine(&system->mechanics) ? (planar ? KIRI_AFFINE_BENDING : KIRI_AFFINE_STRAINS)
                                                      : (planar ? KIRI_PLANE_BENDING + 1 : KIRI_STRAINS);
}

int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (link != NULL) {
        KIRI_ASSERT(link->i >= 0 && link->i < link->j && link->j < system->frameCount);
        members[0] = link->i;
        members[1] = link->j;
        return 2;
    }
    if (kiriElement_Corner(system, k) != NULL) {
        int32_t ends[4][2];
        kiriTrace_Members(kiriElement_Corner(system, k), system->links, members, ends);
        return kiriElement_Corner(system, k)->count;
    }
    const kiriAreaElement* element = AreaElementOf(system, k);
    for (int32_t m = 0; m < element->count; ++m) {
        members[m] = system->areaElements->shares.data[element->first + m].frame;
        KIRI_ASSERT(members[m] >= 0 && members[m] < system->frameCount);
        KIRI_ASSERT(m == 0 || members[m - 1] < members[m]);
    }
    return element->count;
}

int32_t kiriElement_FirstMember(const kiriSystem* system, int32_t k)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Corner(system, k) != NULL) {
        link = &system->links[kiriElement_Corner(system, k)->link[0]];
    }
    return link != NULL ? link->i : system->areaElements->shares.data[AreaElementOf(system, k)->first].frame;
}

int32_t kiriElement_MostMembers(const kiriSystem* system)
{
    int32_t most = kiriElement_CornerCount(system) > 0 ? 4 : 2;
    for (int32_t k = kiriElement_LinkCount(system) + kiriElement_CornerCount(system); k < kiriElement_Count(system);
         ++k) {
        int32_t count = AreaElementOf(system, k)->count;
        most = kiriMax(count, most);
    }
    return most;
}

/* What counts of an element: of a corner as much as of the link that counts least. */
static double CountedPart(const kiriSystem* system, int32_t k)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    double part = kiriElement_Link(system, k) != NULL ? system->linkParts[k] : 1.0;
    for (int32_t n = 0; corner != NULL && n < corner->count; ++n) {
        double other = system->linkParts[corner->link[n]];
        part = kiriMin(other, part);
    }
    return part;
}

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Corner(system, k) != NULL) {
        double all[KIRI_TRACES];
        kiriTrace_Stiffness(kiriElement_Corner(system, k), &system->material, all);
        bool isAffine = kiriMechanics_IsAffine(&system->mechanics);
        stiffness[0] = all[isAffine ? KIRI_TRACE_CURVATURE : KIRI_TRACE_STRETCH];
        stiffness[1] = all[KIRI_TRACE_CURVATURE]; /* counts where it has two strains */
    } else if (link == NULL) {
        kiriAreaElement_Stiffness(AreaElementOf(system, k), &system->material, stiffness);
    } else if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriAffine_Stiffness(link, &system->material, stiffness);
    } else {
        kiriStrain_Stiffness(link, &system->material, stiffness);
    }
    double part = system->linkParts != NULL ? CountedPart(system, k) : 1.0;
    for (int e = 0; part < 1.0 && e < kiriElement_StrainCount(system, k); ++e) {
        stiffness[e] *= part;
    }
}

/* The frames of a link, and their poses: those given, or as the frames are. */
typedef struct LinkEnds {
    const kiriFrameData* frames[2];
    kiriPose poses[2];
} LinkEnds;

static LinkEnds LinkEndsOf(const kiriSystem* system, const kiriLink* link, const kiriPose* poses)
{
    LinkEnds ends;
    ends.frames[0] = &system->frames[link->i];
    ends.frames[1] = &system->frames[link->j];
    ends.poses[0] = poses != NULL ? poses[link->i] : kiriPose_Of(ends.frames[0]);
    ends.poses[1] = poses != NULL ? poses[link->j] : kiriPose_Of(ends.frames[1]);
    return ends;
}

static void MeasureRigidLink(const kiriSystem* system, const kiriLink* link, const kiriPose* poses, double* strain,
                             kiriStrainRow* rows)
{
    LinkEnds ends = LinkEndsOf(system, link, poses);
    const kiriPose* const endPoses[2] = { &ends.poses[0], &ends.poses[1] };
    kiriStrain_Measure(link, &system->material, ends.frames, endPoses, strain, rows);
}

static void MeasureRigidRows(const kiriSystem* system, const kiriLink* link, const kiriPose* poses, double* strain,
                             kiriFrameRow* rows)
{
    kiriStrainRow found[KIRI_STRAINS];
    MeasureRigidLink(system, link, poses, strain, rows != NULL ? found : NULL);
    for (int e = 0; rows != NULL && e < KIRI_STRAINS; ++e) {
        for (int end = 0; end < 2; ++end) {
            rows[2 * e + end].by[0] = found[e].end[end].move;
            rows[2 * e + end].by[1] = found[e].end[end].turn;
        }
    }
}

static void AddFrameRow(kiriFrameRow* row, double a, kiriVec3 move, kiriVec3 turn)
{
    row->by[0] = kiriVec3_AddScaled(row->by[0], a, move);
    row->by[1] = kiriVec3_AddScaled(row->by[1], a, turn);
}

static void MeasureCorner(const kiriSystem* system, const kiriCorner* corner, const kiriPose* poses, double* strain,
                          kiriFrameRow* rows)
{
    int32_t count = corner->count, traces = system->mechanics.planar ? KIRI_TRACE_STRETCH + 1 : KIRI_TRACES;
    double strains[4][KIRI_STRAINS];
    kiriStrainRow found[4][KIRI_STRAINS];
    const double* const all[4] = { strains[0], strains[1], strains[2], strains[3] };
    for (int32_t k = 0; k < count; ++k) {
        MeasureRigidLink(system, &system->links[corner->link[k]], poses, strains[k], rows != NULL ? found[k] : NULL);
    }
    kiriTrace trace = kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
    memcpy(strain, trace.strain, sizeof(double) * (size_t)traces);
    if (rows == NULL) {
        return;
    }
    int32_t members[4], ends[4][2];
    kiriTrace_Members(corner, system->links, members, ends);
    memset(rows, 0, sizeof(*rows) * (size_t)(traces * count));
    for (int32_t k = 0; k < count; ++k) {
        for (int s = 0; s < 2 * traces; ++s) {
            const kiriStrainRow* row = &found[k][kiriTrace_Source(s)];
            for (int end = 0; end < 2; ++end) {
                AddFrameRow(&rows[count * (s / 2) + ends[k][end]], trace.by[k][s], row->end[end].move,
                            row->end[end].turn);
            }
        }
    }
}

static void MeasureAffineCorner(const kiriSystem* system, const kiriCorner* corner, const kiriPose* poses,
                                double* strain, kiriFrameRow* rows)
{
    int32_t members[4], ends[4][2];
    kiriTrace_Members(corner, system->links, members, ends);
    *strain = 0.0;
    if (rows != NULL) {
        memset(rows, 0, sizeof(*rows) * (size_t)corner->count);
    }
    for (int32_t k = 0; k < corner->count; ++k) {
        LinkEnds link = LinkEndsOf(system, &system->links[corner->link[k]], poses);
        const kiriPose* const endPoses[2] = { &link.poses[0], &link.poses[1] };
        kiriFrameRow* own[2] = { NULL, NULL };
        for (int end = 0; rows != NULL && end < 2; ++end) {
            own[end] = &rows[ends[k][end]];
        }
        kiriAffine_AddTrace(corner->weight[k], endPoses, strain, rows != NULL ? own : NULL);
    }
}

void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain, kiriFrameRow* rows)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (kiriElement_Corner(system, k) != NULL && kiriMechanics_IsAffine(&system->mechanics)) {
        MeasureAffineCorner(system, kiriElement_Corner(system, k), poses, strain, rows);
    } else if (kiriElement_Corner(system, k) != NULL) {
        MeasureCorner(system, kiriElement_Corner(system, k), poses, strain, rows);
    } else if (link == NULL) {
        kiriAreaElement_Measure(AreaElementOf(system, k), system->areaElements->shares.data, system->frames, poses,
                                strain, rows);
    } else if (kiriMechanics_IsAffine(&system->mechanics)) {
        LinkEnds ends = LinkEndsOf(system, link, poses);
        const kiriPose* const endPoses[2] = { &ends.poses[0], &ends.poses[1] };
        kiriAffine_Measure(link, &system->material, ends.frames, endPoses, strain, (kiriFrameRow(*)[2])rows);
    } else {
        MeasureRigidRows(system, link, poses, strain, rows);
    }
}

kiriTrace kiriElement_Trace(const kiriSystem* system, int32_t k, const double* strains)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    const double* all[4] = { NULL, NULL, NULL, NULL };
    for (int32_t n = 0; n < corner->count; ++n) {
        all[n] = &strains[KIRI_MOST_STRAINS * (size_t)corner->link[n]];
    }
    return kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
}

/* Offsets stay what they are in folds, where they fade as all do. */
static void TakeCornerOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    const double* all[4] = { NULL, NULL, NULL, NULL };
    for (int32_t n = 0; n < corner->count; ++n) {
        all[n] = system->strainOffsets[corner->link[n]].strain;
    }
    kiriTrace offset = kiriTrace_Measure(corner, system->links, all, system->mechanics.planar);
    for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
        pulling[e] = strain[e] - offset.strain[e];
    }
}

void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling)
{
    int count = kiriElement_StrainCount(system, k);
    if (system->strainOffsets != NULL && kiriElement_IsRigidCorner(system, k)) {
        TakeCornerOffsets(system, k, strain, pulling);
        return;
    }
    if (system->strainOffsets == NULL || !kiriElement_IsRigidLink(system, k)) {
        memcpy(pulling, strain, sizeof(double) * (size_t)count);
        return;
    }
    const double* offset = system->strainOffsets[k].strain;
    for (int e = 0; e < count; ++e) {
        pulling[e] = strain[e] - offset[e];
    }
    if (count > KIRI_NORMAL_STOP) { /* the stop only pushes */
        double over = fabs(strain[KIRI_NORMAL_STOP]) - fabs(offset[KIRI_NORMAL_STOP]);
        pulling[KIRI_NORMAL_STOP] = over <= 0.0 ? 0.0 : strain[KIRI_NORMAL_STOP] > 0.0 ? over : -over;
    }
}

double kiriSolver_ElasticEnergy(const kiriSystem* system)
{
    double sum = 0.0;
    for (int32_t k = 0; k < kiriElement_Count(system); ++k) {
        double strain[KIRI_MOST_STRAINS], stiffness[KIRI_MOST_STRAINS], pulling[KIRI_MOST_STRAINS];
        kiriElement_Measure(system, k, NULL, strain, NULL);
        kiriElement_Stiffness(system, k, stiffness);
        kiriElement_TakeOffsets(system, k, strain, pulling);
        for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
            sum += 0.5 * stiffness[e] * pulling[e] * pulling[e];
        }
    }
    return sum;
}
