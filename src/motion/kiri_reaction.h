/* Reactions: what holds the sheet has to bear. */
#ifndef KIRI_REACTION_H
#define KIRI_REACTION_H

#include "../core/kiri_vec.h"

KIRI_C_BEGIN

/* The impulse that a pin, a clamp or a held frame has given to the sheet, N s, and its moment about where it holds the
   sheet, N m s. */
typedef struct kiriReaction {
    kiriVec3 impulse, moment;
} kiriReaction;

/* One for each pin row, clamp row and frame of a system; each may be null. Those of free frames stay zero. */
typedef struct kiriReactions {
    kiriReaction *pins, *clamps, *frames;
} kiriReactions;

static inline void kiriReaction_Add(kiriReaction* reaction, double scale, kiriVec3 force, kiriVec3 moment)
{
    reaction->impulse = kiriVec3_AddScaled(reaction->impulse, scale, force);
    reaction->moment = kiriVec3_AddScaled(reaction->moment, scale, moment);
}

KIRI_C_END

#endif
