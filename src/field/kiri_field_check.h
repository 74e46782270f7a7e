/* Are grid, regions, shape functions, links and sites that were read such that work may go on with them? */
#ifndef KIRI_FIELD_CHECK_H
#define KIRI_FIELD_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_link.h"
#include "kiri_place.h"
#include "kiri_shape.h"

KIRI_C_BEGIN

/* Distances of ways that a step may go on from. */
enum { KIRI_FARTHEST = KIRI_FAR - 4 * KIRI_UNIT_KNIGHT };

extern const kiriMust kiriSiteMust[2];

/* Is it over the squares of the sheet? Lines of sight from it go through these. */
bool kiriSite_IsOver(const kiriSite* site, const kiriMeshData* mesh);

/* The mesh is right. Counts cells and faces. */
bool kiriGrid_Check(const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check);

/* Rows of squares, without divisions: the quotient is so far from a whole number that rounding does not show. */
typedef struct kiriSquareRows {
    int32_t columns, rows;
    double perColumn;
} kiriSquareRows;

static inline kiriSquareRows kiriSquareRows_Of(const kiriSquares* squares)
{
    return (kiriSquareRows){ squares->columns, squares->rows, 1.0 / squares->columns };
}

static inline int32_t kiriSquareRows_At(const kiriSquareRows* rows, int32_t square)
{
    return (int32_t)(((double)square + 0.5) * rows->perColumn);
}

/* Steps of cells lead as far as they say. */
bool kiriGrid_CheckSteps(const kiriGrid* grid, const kiriSquares* squares, kiriCheck* check);

/* Its part for what cells and faces have of their own. */
bool kiriGrid_CheckOwn(const kiriGrid* grid, kiriCheck* check);

/* And for the update at hand, and what updates have changed. */
bool kiriGrid_CheckWork(const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check);

/* Lists of changes, in the order in which cells that are gone leave them at the end of an update: was this one taken
   out already, or moved to the front? */
enum { KIRI_CHANGES_STEPS, KIRI_CHANGES_EDGES, KIRI_CHANGES_MATERIAL, KIRI_CHANGES_MADE, KIRI_CHANGES_LISTS };
bool kiriGrid_IsForgotten(const kiriGrid* grid, int32_t list, int32_t k);

/* Of a grid that is reset before it is used again. */
bool kiriGrid_CheckLeft(const kiriGrid* grid, kiriCheck* check);

/* What a field is for, at the moment. */
typedef enum kiriFieldUse {
    KIRI_FIELD_RESTS,   /* nothing is at hand */
    KIRI_FIELD_FLOODS,  /* a flood is, or what it has settled is in use; no repair ever is */
    KIRI_FIELD_MARKED,  /* cells are marked for a repair, */
    KIRI_FIELD_REPAIRS, /* which is at hand or comes next, */
    KIRI_FIELD_READ,    /* or has left its log */
    KIRI_FIELD_EMPTIED  /* it is emptied after either, block by block */
} kiriFieldUse;

/* A field of the grid, whose owners are below so many. */
bool kiriField_Check(const kiriField* field, kiriCheck* check, int64_t owners, kiriFieldUse use);

/* Of a field that is emptied before it is used again: it may have been larger. */
bool kiriField_CheckLeft(const kiriField* field, kiriCheck* check);

/* May parts of a sheet be added and taken away? */
bool kiriTally_IsSum(const kiriTally* tally);
bool kiriRegions_Check(const kiriRegions* regions, const kiriGrid* grid, kiriCheck* check, bool areAllOwned);
bool kiriShape_Check(const kiriShape* shape, const kiriGrid* grid, const kiriRegions* regions, kiriCheck* check);
bool kiriLinks_Check(const kiriLinks* links, const kiriGrid* grid, const kiriMeshData* mesh, const kiriRegions* regions,
                     kiriCheck* check);

/* Is an update at hand? */
bool kiriGrid_IsAtWork(const kiriGrid* grid);
bool kiriShape_IsAtWork(const kiriShape* shape);
bool kiriLinks_AreAtWork(const kiriLinks* links);

/* A piece is being taken, or sites are being placed; else the placer is started anew before it is used. */
bool kiriPlacer_Check(const kiriPlacer* placer, const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check,
                      bool isTaking, bool isPlacing);

KIRI_C_END

#endif
