#include "kiri_element.h"

#include <string.h>

static const kiriAreaElement* AreaElementOf(const kiriSystem* system, int32_t k)
{
    return &system->areaElements->elements.data[k - kiriElement_LinkCount(system)];
}

int kiriElement_StrainCount(const kiriSystem* system, int32_t k)
{
    bool planar = system->mechanics.planar;
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
    return link != NULL ? link->i : system->areaElements->shares.data[AreaElementOf(system, k)->first].frame;
}

int32_t kiriElement_MostMembers(const kiriSystem* system)
{
    int32_t most = 2;
    for (int32_t k = kiriElement_LinkCount(system); k < kiriElement_Count(system); ++k) {
        int32_t count = AreaElementOf(system, k)->count;
        most = count > most ? count : most;
    }
    return most;
}

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (link == NULL) {
        kiriAreaElement_Stiffness(AreaElementOf(system, k), &system->material, stiffness);
    } else if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriAffine_Stiffness(link, &system->material, stiffness);
    } else {
        kiriStrain_Stiffness(link, &system->material, stiffness);
    }
}

static void MeasureRigidLink(const kiriLink* link, const kiriFrameData* const frames[2], const kiriPose* const poses[2],
                             double* strain, kiriFrameRow* rows)
{
    kiriStrainRow found[KIRI_STRAINS];
    kiriStrain_Measure(link, frames, poses, strain, rows != NULL ? found : NULL);
    for (int e = 0; rows != NULL && e < KIRI_STRAINS; ++e) {
        for (int end = 0; end < 2; ++end) {
            rows[2 * e + end].by[0] = found[e].end[end].move;
            rows[2 * e + end].by[1] = found[e].end[end].turn;
        }
    }
}

void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain, kiriFrameRow* rows)
{
    const kiriLink* link = kiriElement_Link(system, k);
    if (link == NULL) {
        kiriAreaElement_Measure(AreaElementOf(system, k), system->areaElements->shares.data, system->frames, poses,
                                strain, rows);
        return;
    }
    const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
    kiriPose own[2];
    if (poses == NULL) {
        own[0] = kiriPose_Of(frames[0]);
        own[1] = kiriPose_Of(frames[1]);
    }
    const kiriPose* const ends[2] = { poses != NULL ? &poses[link->i] : &own[0],
                                      poses != NULL ? &poses[link->j] : &own[1] };
    if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriAffine_Measure(link, frames, ends, strain, (kiriFrameRow(*)[2])rows);
    } else {
        MeasureRigidLink(link, frames, ends, strain, rows);
    }
}

void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling)
{
    int count = kiriElement_StrainCount(system, k);
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
