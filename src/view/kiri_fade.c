#include "kiri_fade.h"

bool kiriFades_Reserve(kiriFades* fades, kiriMemory* memory, int32_t sampleCount)
{
    int32_t room = fades->time > 0.0 ? sampleCount : 0;
    return kiriArray_Reserve(memory, &fades->fading, room) && kiriArray_Reserve(memory, &fades->older, room);
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
    kiriArray_Release(memory, &fades->older);
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

/* Lists swap: what fades is now older. */
static void MakeOlder(kiriFades* fades)
{
    kiriFading* data = fades->older.data;
    int32_t capacity = fades->older.capacity;
    fades->older.data = fades->fading.data;
    fades->older.count = fades->fading.count;
    fades->older.capacity = fades->fading.capacity;
    fades->fading.data = data;
    fades->fading.count = 0;
    fades->fading.capacity = capacity;
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
    fades->jump = jump > fades->jump ? jump : fades->jump;
    if (fades->time > 0.0 && kiriVec3_Length(offset) > fades->least) {
        kiriFading next = { older->sample, TimeLeft(fades, older, jump), offset };
        fades->fading.data[fades->fading.count++] = next; /* Reserve has made room */
    }
}

void kiriFades_Start(kiriFades* fades)
{
    MakeOlder(fades);
    fades->next = 0;
}

void kiriFades_TakeJump(kiriFades* fades, int32_t sample, kiriVec3 offset)
{
    kiriFading none = { sample, 0.0, { 0.0, 0.0, 0.0 } };
    bool fadesYet = fades->next < fades->older.count && fades->older.data[fades->next].sample == sample;
    TakeOne(fades, fadesYet ? &fades->older.data[fades->next] : &none, offset);
    fades->next += fadesYet;
}

void kiriFades_Advance(kiriFades* fades, double dt)
{
    int32_t kept = 0;
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        kiriFading fading = fades->fading.data[k];
        double share = dt < fading.left ? (fading.left - dt) / fading.left : 0.0;
        double length = kiriVec3_Length(fading.offset), left = share * length;
        left = left > fades->least ? left : 0.0;
        fades->move = length - left > fades->move ? length - left : fades->move;
        fading.left -= dt;
        fading.offset = kiriVec3_Scale(share, fading.offset);
        if (left > 0.0) {
            fades->fading.data[kept++] = fading;
        }
    }
    fades->fading.count = kept;
}
