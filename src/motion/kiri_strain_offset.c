#include "kiri_strain_offset.h"

#include <string.h>

bool kiriStrainOffsets_Reserve(kiriStrainOffsets* strainOffsets, kiriMemory* memory, int32_t linkCount,
                               int32_t frameCount)
{
    return kiriArray_Reserve(memory, &strainOffsets->strainOffsets, linkCount) &&
           kiriArray_Reserve(memory, &strainOffsets->older, linkCount) &&
           kiriArray_Reserve(memory, &strainOffsets->from, linkCount) &&
           kiriArray_Reserve(memory, &strainOffsets->frames, frameCount) &&
           kiriArray_Reserve(memory, &strainOffsets->mayMove, frameCount);
}

void kiriStrainOffsets_Remember(kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t frameCount,
                                const uint8_t* mayMove)
{
    KIRI_ASSERT(frameCount <= strainOffsets->frames.capacity && frameCount <= strainOffsets->mayMove.capacity);
    strainOffsets->frames.count = strainOffsets->mayMove.count = frameCount;
    for (int32_t f = 0; f < frameCount; ++f) {
        strainOffsets->mayMove.data[f] = mayMove[f];
        if (mayMove[f]) {
            strainOffsets->frames.data[f] = frames[f];
        }
    }
}

/* Links and frames are compared byte by byte, so they must have no padding. */
typedef char kiriLinkHasNoPadding[sizeof(kiriLink) == 2 * sizeof(int32_t) + 20 * sizeof(double) ? 1 : -1];
typedef char kiriPoseHasNoPadding[sizeof(kiriPose) == 12 * sizeof(double) ? 1 : -1];

static void MeasureLink(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* i,
                        const kiriFrameData* j, double* strain)
{
    const kiriFrameData* const ends[2] = { i, j };
    const kiriPose now[2] = { kiriPose_Of(i), kiriPose_Of(j) };
    const kiriPose* const poses[2] = { &now[0], &now[1] };
    kiriStrain_Measure(link, material, ends, poses, strain, NULL);
}

const kiriFrameData* kiriStrainOffsets_FrameBefore(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames,
                                                   int32_t frame)
{
    KIRI_ASSERT(frame >= 0 && frame < strainOffsets->mayMove.count);
    return strainOffsets->mayMove.data[frame] ? &strainOffsets->frames.data[frame] : &frames[frame];
}

static bool IsFrameUnmoved(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t f)
{
    const kiriFrameData *was = kiriStrainOffsets_FrameBefore(strainOffsets, frames, f), *is = &frames[f];
    return was == is || (memcmp(&was->x, &is->x, sizeof(is->x)) == 0 && memcmp(&was->A, &is->A, sizeof(is->A)) == 0 &&
                         memcmp(&was->center, &is->center, sizeof(is->center)) == 0);
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
    MeasureLink(link, material, &frames[link->i], &frames[link->j], offset.strain);
    if (old != NULL) {
        MeasureLink(old, material, kiriStrainOffsets_FrameBefore(strainOffsets, frames, old->i),
                    kiriStrainOffsets_FrameBefore(strainOffsets, frames, old->j), was);
    }
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        offset.strain[e] -= old != NULL ? was[e] - older->strain[e] : 0.0;
    }
    return offset;
}

/* Which old link each goes on from. One that is what the next old one was is not looked at. */
static void FindOlder(kiriStrainOffsets* strainOffsets, const kiriLink* old, int32_t oldCount, const kiriLink* links,
                      int32_t linkCount, const int32_t* was)
{
    int32_t o = 0;
    for (int32_t k = 0; k < linkCount; ++k) {
        bool known = was != NULL && was[k] == o;
        if (!known) {
            while (o < oldCount && IsLinkBefore(&old[o], &links[k])) {
                ++o;
            }
            known = o < oldCount && !IsLinkBefore(&links[k], &old[o]);
        }
        strainOffsets->from.data[k] = known ? o : KIRI_NONE;
        o += known;
    }
}

/* A link keeps its index, as a rule. */
static void SaveOlder(kiriStrainOffsets* strainOffsets, int32_t linkCount)
{
    for (int32_t k = 0; k < linkCount; ++k) {
        int32_t from = strainOffsets->from.data[k];
        if (from != k && from != KIRI_NONE && from < strainOffsets->strainOffsets.count) {
            strainOffsets->older.data[from] = strainOffsets->strainOffsets.data[from];
        }
    }
}

void kiriStrainOffsets_Take(kiriStrainOffsets* strainOffsets, const kiriLink* old, int32_t oldCount,
                            const kiriLink* links, int32_t linkCount, const int32_t* was, const kiriFrameData* frames,
                            const kiriMaterial* material)
{
    KIRI_ASSERT(linkCount <= strainOffsets->strainOffsets.capacity && linkCount <= strainOffsets->from.capacity);
    const kiriStrainOffset none = { { 0.0 } };
    int32_t had = strainOffsets->strainOffsets.count;
    kiriStrainOffset* offsets = strainOffsets->strainOffsets.data;
    FindOlder(strainOffsets, old, oldCount, links, linkCount, was);
    SaveOlder(strainOffsets, linkCount);
    for (int32_t k = 0; k < linkCount; ++k) {
        int32_t from = strainOffsets->from.data[k];
        const kiriStrainOffset* older = from == KIRI_NONE || from >= had ? &none
                                        : from == k                      ? &offsets[k]
                                                                         : &strainOffsets->older.data[from];
        bool isSame = from != KIRI_NONE &&
                      ((was != NULL && was[k] == from) || memcmp(&old[from], &links[k], sizeof(*links)) == 0);
        if (!isSame || !IsFrameUnmoved(strainOffsets, frames, links[k].i) ||
            !IsFrameUnmoved(strainOffsets, frames, links[k].j)) {
            offsets[k] = StrainOffsetOf(strainOffsets, &links[k], from != KIRI_NONE ? &old[from] : NULL, older, frames,
                                        material);
        } else if (older != &offsets[k]) {
            offsets[k] = *older;
        }
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
