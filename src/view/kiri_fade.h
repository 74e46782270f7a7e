/* What is left of a jump when a cut takes effect: samples are seen to go on where they were, and go over to where the
   new weights have them within a few ticks. */
#ifndef KIRI_FADE_H
#define KIRI_FADE_H

#include "../core/kiri_keep.h"
#include "../core/kiri_vec.h"

KIRI_C_BEGIN

typedef struct kiriFading {
    int32_t sample;
    double left; /* s until it is gone */
    kiriVec3 offset;
} kiriFading;

/* Of a row of samples: those that are seen elsewhere than their weights have them. */
typedef struct kiriFades {
    double time;                   /* s that a jump takes; 0: samples jump at once */
    double least;                  /* m: what is less is not seen */
    KIRI_ARRAY(kiriFading) fading; /* by sample */
    int32_t older;                 /* while jumps are taken: the next of those from before, at the end of the room */
    double jump, move;             /* m, in this tick: the longest jump that came, and way that a fade went */
} kiriFades;

/* Room for so many samples, so that the others do not fail; none is needed where jumps take no time. */
bool kiriFades_Reserve(kiriFades* fades, kiriMemory* memory, int32_t sampleCount);

/* Gives memory back where nothing fades. */
void kiriFades_Trim(kiriFades* fades, kiriMemory* memory);
void kiriFades_Release(kiriFades* fades, kiriMemory* memory);

/* Samples are taken away. */
void kiriFades_Keep(kiriFades* fades, const kiriKeep* samples);

/* A cut takes effect: Start, then Take, in their order, for each sample that fades, or whose place may be another. The
   sample is seen so far from where it would be if nothing faded: from here on that fades. */
void kiriFades_Start(kiriFades* fades);
void kiriFades_TakeJump(kiriFades* fades, int32_t sample, kiriVec3 offset);

/* Does the sample, which is the next to take, fade already? */
static inline bool kiriFades_Has(const kiriFades* fades, int32_t sample)
{
    return fades->older < fades->fading.capacity && fades->fading.data[fades->older].sample == sample;
}

/* Or one before `end`? */
static inline bool kiriFades_HasBelow(const kiriFades* fades, int32_t end)
{
    return fades->older < fades->fading.capacity && fades->fading.data[fades->older].sample < end;
}

static inline void kiriFades_Take(kiriFades* fades, int32_t sample, kiriVec3 offset)
{
    if (kiriFades_Has(fades, sample) || kiriVec3_Dot(offset, offset) > fades->least * fades->least) { /* few do */
        kiriFades_TakeJump(fades, sample, offset);
    }
}

/* Time goes on. */
void kiriFades_Advance(kiriFades* fades, double dt);

KIRI_C_END

#endif
