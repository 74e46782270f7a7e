#include "kiri_strain_offset.h"

#include <string.h>

bool kiriEases_Reserve(kiriEases* eases, const kiriMemory* memory, int32_t linkCount, int32_t frameCount)
{
    return kiriArray_Reserve(memory, &eases->eases, linkCount) && kiriArray_Reserve(memory, &eases->older, linkCount) &&
           kiriArray_Reserve(memory, &eases->frames, frameCount);
}

void kiriEases_Release(kiriEases* eases, const kiriMemory* memory)
{
    kiriArray_Release(memory, &eases->eases);
    kiriArray_Release(memory, &eases->older);
    kiriArray_Release(memory, &eases->frames);
}

void kiriEases_Remember(kiriEases* eases, const kiriFrameData* frames, int32_t frameCount)
{
    if (frameCount > 0) {
        memcpy(eases->frames.data, frames, sizeof(*frames) * (size_t)frameCount);
    }
    eases->frames.count = frameCount;
}

static void Measure(const kiriLink* link, const kiriFrameData* frames, double* strain)
{
    const kiriFrameData* const ends[2] = { &frames[link->i], &frames[link->j] };
    const kiriPose now[2] = { kiriPose_Of(ends[0]), kiriPose_Of(ends[1]) };
    const kiriPose* const poses[2] = { &now[0], &now[1] };
    kiriStrain_Measure(link, ends, poses, strain, NULL);
}

static bool StandsAsBefore(const kiriEases* eases, const kiriFrameData* frames, int32_t f)
{
    const kiriFrameData *was = &eases->frames.data[f], *is = &frames[f];
    return memcmp(&was->x, &is->x, sizeof(is->x)) == 0 && memcmp(&was->A, &is->A, sizeof(is->A)) == 0 &&
           memcmp(&was->center, &is->center, sizeof(is->center)) == 0;
}

static bool IsBefore(const kiriLink* a, const kiriLink* b)
{
    return a->i != b->i ? a->i < b->i : a->j < b->j;
}

/* Of a link with an older one, or none. */
static kiriEase EaseOf(const kiriEases* eases, const kiriLink* link, const kiriLink* old, const kiriEase* older,
                       const kiriFrameData* frames)
{
    kiriEase ease;
    double was[KIRI_STRAINS] = { 0.0 };
    if (old != NULL && memcmp(old, link, sizeof(*link)) == 0 && StandsAsBefore(eases, frames, link->i) &&
        StandsAsBefore(eases, frames, link->j)) {
        return *older;
    }
    Measure(link, frames, ease.strain);
    if (old != NULL) {
        Measure(old, eases->frames.data, was);
    }
    for (int e = 0; e < KIRI_STRAINS; ++e) {
        ease.strain[e] -= old != NULL ? was[e] - older->strain[e] : 0.0;
    }
    return ease;
}

void kiriEases_Take(kiriEases* eases, const kiriLink* old, int32_t oldCount, const kiriLink* links, int32_t linkCount,
                    const kiriFrameData* frames)
{
    const kiriEase none = { { 0.0 } };
    int32_t o = 0, had = eases->eases.count;
    if (had > 0) {
        memcpy(eases->older.data, eases->eases.data, sizeof(kiriEase) * (size_t)had);
    }
    for (int32_t k = 0; k < linkCount; ++k) {
        while (o < oldCount && IsBefore(&old[o], &links[k])) {
            ++o;
        }
        bool known = o < oldCount && !IsBefore(&links[k], &old[o]);
        const kiriEase* older = known && o < had ? &eases->older.data[o] : &none;
        eases->eases.data[k] = EaseOf(eases, &links[k], known ? &old[o] : NULL, older, frames);
        o += known;
    }
    eases->eases.count = linkCount;
}

void kiriEases_Advance(kiriEases* eases, double dt, double time)
{
    double keep = time / (time + dt);
    for (int32_t k = 0; k < eases->eases.count; ++k) {
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            double* strain = &eases->eases.data[k].strain[e];
            *strain = fabs(*strain) > 1e-12 ? keep * *strain : 0.0;
        }
    }
}
