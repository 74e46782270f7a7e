/* Where control frames are placed (section 5 of the paper). */
#ifndef KIRI_PLACE_H
#define KIRI_PLACE_H

#include "kiri_slit.h"

KIRI_C_BEGIN

typedef struct kiriPlacerWork kiriPlacerWork; /* private to kiri_place.c */

/* Puts sites evenly into a part of the sheet: farthest-point sampling, then Lloyd relaxation of the new ones only. A
   job that a budget may interrupt. */
typedef struct kiriPlacer {
    kiriSites sites;           /* those that were there, then the new ones; right when Run is done */
    int32_t oldCount;          /* sites before it stay where they are */
    KIRI_ARRAY(int32_t) cells; /* the part: cells that hang together, in their order (or all cells, of many pieces) */
    /* Distances to the sites that are there, as kiriRegions has them, where the caller knows them; they must stay
       until the job is done. Null: they are flooded. Start takes it, and makes it null. */
    const kiriField* known;
    /* Around slit ends sites are closer than elsewhere: `closeness` times (1 to 4) at an end, then less, in proportion
       to 1 / distance, and as elsewhere from `reach` (m) on. 0: they are as close everywhere. Start makes it 0. */
    kiriSlitEnds ends;
    double reach, closeness;
    kiriPlacerWork* work;
} kiriPlacer;

/* The cells that hang together with this one over faces, in the order of cells, into placer->cells. False for
   memory. */
bool kiriPlacer_TakePiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, int32_t cell);

/* The same as a job: start, which is false for memory, and then go on until it is done. An item of the quota is some
   cells. It is done at once where the piece is there. After KIRI_FAILED, or where the job is given up, start again. */
bool kiriPlacer_StartPiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, int32_t cell);
kiriProgress kiriPlacer_GoOnWithPiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, kiriQuota* quota);

/* For the part in placer->cells and the sites in placer->sites, which lie in it, each in a cell of its own: `count`
   more, or one in each free cell where there are fewer. Sampling takes only cells that `allowed` marks (one byte a cell
   of the grid; null: all); it is read now and not kept. One site in a part without sites goes to the cell nearest to
   the centroid, without relaxation: confetti comes in thousands. False for memory. */
bool kiriPlacer_Start(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      const uint8_t* allowed, int32_t count);

/* An item of the quota is a cell settled, or four visited. After KIRI_FAILED, start again. */
kiriProgress kiriPlacer_Run(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                            kiriQuota* quota);

/* The site that a frame takes in a cell. */
kiriSite kiriFrames_SiteIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

KIRI_C_END

#endif
