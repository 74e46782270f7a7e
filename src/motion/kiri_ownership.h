/* Which frame owns which material: the owners in force, and what changes owner with the next commit. */
#ifndef KIRI_OWNERSHIP_H
#define KIRI_OWNERSHIP_H

#include "../field/kiri_region.h"

KIRI_C_BEGIN

/* The owner of what a triangle has in a square. */
typedef struct kiriTriangleOwner {
    int32_t triangle, owner;
} kiriTriangleOwner;

/* Owners of the material of a square. Cells have no lasting name, for an update from scratch makes all of them anew; so
   a square that is divided into several cells knows their owners by triangle. */
typedef struct kiriSquareOwners {
    int32_t owner;  /* of the whole square, where `parts` is empty; KIRI_NONE: nobody has owned it yet */
    kiriSpan parts; /* of triangleOwners */
} kiriSquareOwners;

typedef struct kiriStagedOwners {
    int32_t square;
    kiriSquareOwners owners;
} kiriStagedOwners;

/* Material that changes owner. */
typedef struct kiriTransfer {
    int32_t from;
    int32_t next; /* of the same receiver, by growing `from`, or KIRI_NONE */
    kiriTally material;
} kiriTransfer;

/* A zeroed one knows of no material. */
typedef struct kiriOwnership {
    KIRI_ARRAY(kiriSquareOwners) squares;         /* in force, of each square */
    KIRI_ARRAY(kiriTriangleOwner) triangleOwners; /* of divided squares */
    kiriSpans spans;                              /* the free room in triangleOwners */
    int32_t triangleCount;                        /* when they came in force */

    /* Of the update at hand. */
    KIRI_ARRAY(int32_t) dirty;   /* squares in which owners may have changed, each once */
    KIRI_ARRAY(uint8_t) isDirty; /* of each square */
    int32_t next;                /* in `dirty`: the next to stage; 0: nothing is staged */
    int64_t due;                 /* items of the one before it that are not paid yet */
    KIRI_ARRAY(kiriStagedOwners) staged;
    KIRI_ARRAY(kiriTransfer) transfers;
    KIRI_ARRAY(int32_t) first; /* of each frame: the first transfer to it, or KIRI_NONE */
} kiriOwnership;

/* The extent of the tallies of material. */
static inline double kiriOwnership_Extent(const kiriMeshData* mesh)
{
    return KIRI_LATTICE * mesh->step;
}

/* Makes the squares dirty in which owners may change: those of mesh->squares.dirty, and those of regions->changes. To
   be called before these are cleared. Both false for memory. */
bool kiriOwnership_NoteDirty(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh);
bool kiriOwnership_NoteChanges(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                               const kiriMeshData* mesh, const kiriRegions* regions);

/* Cells and frames have been taken away, and triangles have been renumbered: `of` are the squares where cells went.
   With regions and mesh as they are. Nothing is dirty or staged. Never fails. */
void kiriOwnership_Keep(kiriOwnership* ownership, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, const kiriKeep* triangles, const kiriKeep* frames,
                        const int32_t* of, int32_t count);

/* Finds what changes owner when the regions come in force: in dirty squares, or in all where `isScratch`. An item of
   the quota is a square that several cells share, its triangles count, too; or eight others. After KIRI_MORE it goes on
   where it was. */
kiriProgress kiriOwnership_Stage(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                                 const kiriMeshData* mesh, const kiriRegions* regions, bool isScratch,
                                 kiriQuota* quota);

/* Forgets what is dirty and staged. */
void kiriOwnership_Drop(kiriOwnership* ownership);

/* What is staged comes in force. Never fails. */
void kiriOwnership_Commit(kiriOwnership* ownership, const kiriMeshData* mesh);

KIRI_C_END

#endif
