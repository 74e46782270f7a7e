/* Detaches pieces of a sheet as new sheets, or removes them. Nothing couples two pieces, so the rest of the sheet keeps
   all its bits, with other indices. */
#ifndef KIRI_DETACH_H
#define KIRI_DETACH_H

#include "kiri_sheet.h"
#include "kiri_update.h"

KIRI_C_BEGIN

/* Some pieces of a sheet: which of its items belong to them, and the index of each item among these. */
typedef struct kiriSubset {
    const kiriSheetData* from;
    kiriFlags pieces; /* 1 for each piece of the subset */
    kiriKeep triangles, vertices, frames, points, pins, links;
} kiriSubset;

/* The lists of items by piece that parts are copied from. */
enum kiriListed {
    KIRI_LISTED_VERTICES,
    KIRI_LISTED_TRIANGLES,
    KIRI_LISTED_FRAMES,
    KIRI_LISTED_POINTS,
    KIRI_LISTED_LINKS,
    KIRI_LISTED_FADES,
    KIRI_LISTED_POINT_FADES,
    KIRI_LISTED_LAST,  /* contacts of the last tick, */
    KIRI_LISTED_SLEPT, /* and of pieces that sleep */
    KIRI_LISTED_COUNT
};

typedef struct kiriDetach {
    kiriSheetData* sheet;
    kiriMemory memory;                    /* of all arrays below, except for `shown` and `points` */
    kiriSubset rest;                      /* the pieces that stay; the caller sets rest.pieces */
    kiriSubset part;                      /* the piece that is copied; empty between two parts */
    kiriIndices framePart, vertexPart;    /* of each frame, vertex: its piece if it leaves, else KIRI_NONE */
    kiriPieceItems of[KIRI_LISTED_COUNT]; /* items of the pieces that leave */
    double area;                          /* m^2 of all pieces */
    kiriIndices cells, squares;           /* cells that leave, and their squares, each once */
    kiriShown shown;
    kiriFloats points; /* positions of the collision points that stay */
} kiriDetach;

/* Initialises the work. No piece stays until the caller sets detach->rest.pieces. Fails on out of memory. Call
   kiriDetach_Drop in any case. */
bool kiriDetach_Init(kiriDetach* detach, kiriSheetData* sheet);

/* Makes the maps, in one pass over the sheet; with makesParts also the lists. The field belongs to the current mesh
   (kiriUpdate_IsFieldCurrent). Fails on out of memory. */
bool kiriDetach_Map(kiriDetach* detach, bool makesParts);

/* Makes the sheet of a piece that leaves, at the cost of the piece. `to` is new. It has the lattice and the squares of
   the old sheet, so its field, made from scratch, has the same bits. Frames, pins and contacts keep ids and state. Cuts
   stay behind. False for memory. */
bool kiriDetach_MakePart(kiriDetach* detach, int32_t piece, kiriSheetData* to);

/* Reserves everything that kiriDetach_Commit needs. Changes nothing on out of memory: false. */
bool kiriDetach_Stage(kiriDetach* detach);

/* Removes the pieces from the sheet in place. Blades inside them end up outside all material; other cuts continue.
   Arrays that the host may hold get the owner `retired`. The caller updates ids. Cannot fail. */
void kiriDetach_Commit(kiriDetach* detach, kiriMemory* retired);

void kiriDetach_Drop(kiriDetach* detach);

/* Returns the frame of the subset that a pin holds; for a line, the one with the longest share. KIRI_NONE if it holds
   none. */
int32_t kiriSubset_FrameOfPin(const kiriSubset* subset, int32_t pin);

/* Returns the fraction of the sheet's area in the subset. */
double kiriSubset_Share(const kiriSubset* subset);

/* Returns the cost in samples of removing this fraction of the area; with makesParts, also of making sheets from it. */
double kiriDetach_Samples(const kiriSheetData* sheet, double share, bool makesParts);

/* Derives the data that saves leave out from the mesh and the frames: grid, regions, shape functions, links, weights of
   samples, owners of material. Runs the stages of a sheet whose saved fields were checked. Returns false on out of
   memory; or, with *isBad, if two sites share a cell, or the pieces differ from the saved ones. */
bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad);

KIRI_C_END

#endif
