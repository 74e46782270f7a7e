/* Shape functions: weights of the frames on the cells (section 4.1 of the paper, algorithm 2; after Faure, Gilles,
   Bousquet, Pai 2011). */
#ifndef KIRI_SHAPE_H
#define KIRI_SHAPE_H

#include "kiri_reach.h"
#include "kiri_region.h"

#include <string.h>

KIRI_C_BEGIN

typedef struct kiriWeight {
    int32_t frame; /* index of the site */
    double value;
} kiriWeight;

/* A weight at a cell, before the weights there are divided by their sum. A double in two parts: so it takes no
   padding. */
typedef struct kiriCellWeight {
    int32_t label;      /* of the frame */
    uint32_t low, high; /* see kiriCellWeight_Raw */
} kiriCellWeight;

static inline kiriCellWeight kiriCellWeight_Make(int32_t label, double raw)
{
    uint64_t bits;
    memcpy(&bits, &raw, sizeof(bits));
    return (kiriCellWeight){ label, (uint32_t)bits, (uint32_t)(bits >> 32) };
}

static inline double kiriCellWeight_Raw(const kiriCellWeight* weight)
{
    uint64_t bits = (uint64_t)weight->high << 32 | weight->low;
    double raw;
    memcpy(&raw, &bits, sizeof(raw));
    return raw;
}

typedef struct kiriShapeWork kiriShapeWork; /* the update at hand: kiri_shape_work.h */

typedef struct kiriShape {
    kiriLabels
        labels; /* of frames, in weights of cells and of samples: so no frame that goes changes those of others */
    KIRI_ARRAY(kiriSpan) spans;         /* of each cell: its weights */
    KIRI_ARRAY(kiriCellWeight) weights; /* by spans; in a span by label; above zero */
    kiriSpans room;
    kiriReaches reaches; /* of each frame: how far cells are that its weight may reach */

    /* Of each frame: the cells in which its weight exceeds rigidWeight, as shares of whole squares, in units of 2^-40:
       a whole number, so that it does not depend on the order of adding. */
    KIRI_ARRAY(int64_t) rigid;
    double rigidWeight; /* set before the first update */
    bool eased; /* weights of points have no kinks at sites, see kiri_stencil.c; those of cells are linear in between */

    /* Since kiriShape_ClearChanges: live cells, each once, whose weights or steps changed, and new ones. */
    KIRI_ARRAY(int32_t) changes;
    int64_t recomputed; /* and for how many of them a weight was computed */
    kiriShapeWork* work;
} kiriShape;

/* What the raw weights of a cell are divided by. */
static inline double kiriShape_Sum(const kiriShape* shape, kiriSpan span)
{
    double sum = 0.0;
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        sum += kiriCellWeight_Raw(&shape->weights.data[k]);
    }
    return sum;
}

/* Follows the changes of grid and regions, which are cleared after it. Costs what it touches. `moves` as in
   kiriRegions_Update: distances to such a site are made from scratch. Items of the quota: one for a cell about which
   grid or regions have changed something, and two for each frame that reaches one; a cell whose distance is repaired,
   see kiriField_Repair; eight for a block of distances that is loaded, two for one that goes back, and one for two
   cells in it that have others; three weights put in their place; a cell that gets room for its first weights or whose
   weights are all in their place; 128 bytes that move where arrays grow. Every cell with an owner gets weights.
   KIRI_MORE: call again before grid, regions or sites change. KIRI_FAILED: only kiriShape_Reset helps. */
kiriProgress kiriShape_Update(kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount,
                              const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota);

/* The cells go that are listed, which are all that the frames reach that are not kept; others get their new index.
   `labels`: what labels become (kiriLabels_Map); null: they stay, and there is room to list them. Not during an update,
   nor before its changes are cleared. Never fails. */
void kiriShape_Keep(kiriShape* shape, kiriMemory* memory, const kiriKeep* frames, const kiriKeep* labels,
                    const int32_t* gone, int32_t goneCount);
void kiriShape_ClearChanges(kiriShape* shape);

/* How far the update at hand has come, for the state hash: it is not all in what the quota has given. */
void kiriShape_HashProgress(const kiriShape* shape, uint64_t* hash);

/* The array of it that is growing, as bytes, after all else. */
void kiriShape_ArchiveGrowing(kiriArchive* archive, kiriShape* shape, kiriMemory* memory);

/* Gives back the room of what is as long as what an update changes. Not during an update. */
void kiriShape_DropScratch(kiriShape* shape, kiriMemory* memory);
void kiriShape_Reset(kiriShape* shape);

KIRI_C_END

#endif
