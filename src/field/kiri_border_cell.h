/* The cells on borders of regions, a list for each region: so who follows the borders of a few regions need not look at
   all their cells. A list is in no order. */
#ifndef KIRI_BORDER_CELL_H
#define KIRI_BORDER_CELL_H

#include "../core/kiri_keep.h"

KIRI_C_BEGIN

typedef struct kiriBorderCell {
    int32_t region;       /* in whose list it is, or KIRI_NONE */
    int32_t next, before; /* in that list, or KIRI_NONE */
} kiriBorderCell;

/* A zeroed one is empty. */
typedef struct kiriBorderCells {
    KIRI_ARRAY(int32_t) first; /* of each region, or KIRI_NONE */
    KIRI_ARRAY(kiriBorderCell) cells;
} kiriBorderCells;

/* Room for more cells and regions; new cells are in no list. False for memory. */
bool kiriBorderCells_Resize(kiriBorderCells* lists, kiriMemory* memory, int32_t cellCount, int32_t regionCount);

/* Puts a cell into the list of a region, and into no other; KIRI_NONE: into none. */
void kiriBorderCells_Put(kiriBorderCells* lists, int32_t cell, int32_t region);

/* Regions get their new index. No cell is in the list of one that is not kept. */
void kiriBorderCells_Keep(kiriBorderCells* lists, const kiriKeep* regions);

void kiriBorderCells_Reset(kiriBorderCells* lists);

KIRI_C_END

#endif
