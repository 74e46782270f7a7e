/* Reactions: what holds the sheet has to bear. */
#ifndef KIRI_REACTION_H
#define KIRI_REACTION_H

#include "../core/kiri_vec.h"

KIRI_C_BEGIN

/* A force, N, with its moment about a point, N m; or an impulse, N s, with its own, N m s. */
typedef struct kiriWrench {
    kiriVec3 force, moment;
} kiriWrench;

/* With what a pin, a clamp or a held frame acts on the sheet, about where it holds it. */
typedef struct kiriReaction {
    kiriWrench impulse; /* since the start of the tick */
    kiriWrench gain;    /* impulse of the last step, */
    kiriWrench pull;    /* and force at its end: the history of kiri_stepping.h, for forces one by one */
    kiriWrench now;     /* force at the end of the step at hand */
} kiriReaction;

/* One for each pin row, clamp row and frame of a system; each may be null. Those of free frames stay zero. */
typedef struct kiriReactions {
    kiriReaction *pins, *clamps, *frames;
} kiriReactions;

static inline void kiriWrench_Add(kiriWrench* sum, double scale, const kiriWrench* wrench)
{
    sum->force = kiriVec3_AddScaled(sum->force, scale, wrench->force);
    sum->moment = kiriVec3_AddScaled(sum->moment, scale, wrench->moment);
}

KIRI_C_END

#endif
