#include "kiri_fade.h"

#include <string.h>

bool kiriFades_Reserve(kiriFades* fades, kiriMemory* memory, int32_t sampleCount)
{
    return kiriArray_Reserve(memory, &fades->fading, sampleCount);
}

void kiriFades_Trim(kiriFades* fades, kiriMemory* memory)
{
    if (fades->fading.count == 0 && fades->fading.capacity > 0) {
        kiriFades_Release(fades, memory);
    }
}

void kiriFades_Release(kiriFades* fades, kiriMemory* memory)
{
    kiriArray_Release(memory, &fades->fading);
}

void kiriFades_Keep(kiriFades* fades, const kiriKeep* samples)
{
    int32_t kept = 0;
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        kiriFading fading = fades->fading.data[k];
        fading.sample = kiriKeep_To(samples, fading.sample);
        if (fading.sample != KIRI_NONE) {
            fades->fading.data[kept++] = fading;
        }
    }
    fades->fading.count = kept;
}

/* A jump on top of another leaves both as much time as they are long. */
static double TimeLeft(const kiriFades* fades, const kiriFading* older, double jump)
{
    double length = kiriVec3_Length(older->offset), sum = length + jump;
    return sum > 0.0 ? (length * older->left + jump * fades->time) / sum : 0.0;
}

static void TakeOne(kiriFades* fades, const kiriFading* older, kiriVec3 offset)
{
    double jump = kiriVec3_Length(kiriVec3_Sub(offset, older->offset));
    fades->jump = kiriMax(jump, fades->jump);
    if (fades->time > 0.0 && kiriVec3_Length(offset) > fades->least) {
        kiriFading next = { older->sample, TimeLeft(fades, older, jump), offset };
        KIRI_ASSERT(fades->fading.count < fades->older); /* Reserve has made room */
        fades->fading.data[fades->fading.count++] = next;
    }
}

/* What fades goes to the end of the room; from there it is merged to the front with what comes. As there is room for
   every sample, the front stays behind. */
void kiriFades_Start(kiriFades* fades)
{
    kiriFading* data = fades->fading.data;
    int32_t count = fades->fading.count;
    fades->older = fades->fading.capacity - count;
    if (count > 0) {
        memmove(data + fades->older, data, sizeof(*data) * (size_t)count);
    }
    fades->fading.count = 0;
}

void kiriFades_TakeJump(kiriFades* fades, int32_t sample, kiriVec3 offset)
{
    kiriFading older = { sample, 0.0, { 0.0, 0.0, 0.0 } };
    if (kiriFades_Has(fades, sample)) {
        older = fades->fading.data[fades->older++];
    }
    TakeOne(fades, &older, offset);
}

void kiriFades_Advance(kiriFades* fades, double dt)
{
    int32_t kept = 0;
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        kiriFading fading = fades->fading.data[k];
        double share = dt < fading.left ? (fading.left - dt) / fading.left : 0.0;
        double length = kiriVec3_Length(fading.offset), left = share * length;
        left = left > fades->least ? left : 0.0;
        fades->move = kiriMax(length - left, fades->move);
        fading.left -= dt;
        fading.offset = kiriVec3_Scale(share, fading.offset);
        if (left > 0.0) {
            fades->fading.data[kept++] = fading;
        }
    }
    fades->fading.count = kept;
}
