#include "kiri_strain_offset.h"

#include <string.h>

bool kiriStrainOffsets_Reserve(kiriStrainOffsets* strainOffsets, kiriMemory* memory, int32_t linkCount,
                               int32_t frameCount)
{
    return kiriArray_Reserve(memory, &strainOffsets->strainOffsets, linkCount) &&
           kiriArray_Reserve(memory, &strainOffsets->older, linkCount) &&
           kiriArray_Reserve(memory, &strainOffsets->frames, frameCount);
}

void kiriStrainOffsets_Remember(kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t frameCount)
{
    KIRI_ASSERT(frameCount <= strainOffsets->frames.capacity);
    if (frameCount > 0) {
        memcpy(strainOffsets->frames.data, frames, sizeof(*frames) * (size_t)frameCount);
    }
    strainOffsets->frames.count = frameCount;
}

/* Links and frames are compared byte by byte, so they must have no padding. */
typedef char kiriLinkHasNoPadding[sizeof(kiriLink) == 2 * sizeof(int32_t) + 20 * sizeof(double) ? 1 : -1];
typedef char kiriPoseHasNoPadding[sizeof(kiriPose) == 12 * sizeof(double) ? 1 : -1];

static void MeasureLink(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* frames, double* strain)
{
    const kiriFrameData* const ends[2] = { &frames[link->i], &frames[link->j] };
    const kiriPose now[2] = { kiriPose_Of(ends[0]), kiriPose_Of(ends[1]) };
    const kiriPose* const poses[2] = { &now[0], &now[1] };
    kiriStrain_Measure(link, material, ends, poses, strain, NULL);
}

static bool IsFrameUnmoved(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < strainOffsets->frames.count);
    const kiriFrameData *was = &strainOffsets->frames.data[f], *is = &frames[f];
    return memcmp(&was->x, &is->x, sizeof(is->x)) == 0 && memcmp(&was->A, &is->A, sizeof(is->A)) == 0 &&
           memcmp(&was->center, &is->center, sizeof(is->center)) == 0;
}

static bool IsLinkBefore(const kiriLink* a, const kiriLink* b)
{
    return a->i != b->i ? a->i < b->i : a->j < b->j;
}

/* Of a link with an older one, or none. */
static kiriStrainOffset StrainOffsetOf(const kiriStrainOffsets* strainOffsets, const kiriLink* link,
                                       const kiriLink* old, const kiriStrainOffset* older, const kiriFrameData* frames,
                                       const kiriMaterial* material)
{
    kiriStrainOffset offset;
    double was[KIRI_STRAINS] = { 0.0 };
    if (old != NULL && memcmp(old, link, sizeof(*link)) == 0 && IsFrameUnmoved(strainOffsets, frames, link->i) &&
        IsFrameUnmoved(strainOffsets, frames, link->j)) {
        return *older;
    }
    MeasureLink(link, material, frames, offset.strain);
    if (old != NULL) {
        MeasureLink(old, material, strainOffsets->frames.data, was);
    }
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        offset.strain[e] -= old != NULL ? was[e] - older->strain[e] : 0.0;
    }
    return offset;
}

void kiriStrainOffsets_Take(kiriStrainOffsets* strainOffsets, const kiriLink* old, int32_t oldCount,
                            const kiriLink* links, int32_t linkCount, const kiriFrameData* frames,
                            const kiriMaterial* material)
{
    KIRI_ASSERT(linkCount <= strainOffsets->strainOffsets.capacity);
    const kiriStrainOffset none = { { 0.0 } };
    int32_t o = 0, had = strainOffsets->strainOffsets.count;
    if (had > 0) {
        memcpy(strainOffsets->older.data, strainOffsets->strainOffsets.data, sizeof(kiriStrainOffset) * (size_t)had);
    }
    for (int32_t k = 0; k < linkCount; ++k) {
        while (o < oldCount && IsLinkBefore(&old[o], &links[k])) {
            ++o;
        }
        bool known = o < oldCount && !IsLinkBefore(&links[k], &old[o]);
        const kiriStrainOffset* older = known && o < had ? &strainOffsets->older.data[o] : &none;
        strainOffsets->strainOffsets.data[k] =
            StrainOffsetOf(strainOffsets, &links[k], known ? &old[o] : NULL, older, frames, material);
        o += known;
    }
    strainOffsets->strainOffsets.count = linkCount;
}

void kiriStrainOffsets_Advance(kiriStrainOffsets* strainOffsets, const kiriIndices* elements, double dt, double time)
{
    double keep = time / (time + dt);
    KIRI_EACH(k, *elements) {
        for (int e = 0; k < strainOffsets->strainOffsets.count && e < KIRI_STRAINS; ++e) {
            double* strain = &strainOffsets->strainOffsets.data[k].strain[e];
            *strain = fabs(*strain) > 1e-12 ? keep * *strain : 0.0;
        }
    }
}
