/* A point of the material, as it is seen. */
#ifndef KIRI_SEEN_H
#define KIRI_SEEN_H

#include "kiri_piece.h"
#include "kiri_sheet.h"
#include "kiri_update.h"

KIRI_C_BEGIN

typedef struct kiriPointPlace {
    kiriLatticePoint at;
    int32_t triangle;
    double shares[3]; /* of its corners */
} kiriPointPlace;

/* False outside the material. */
bool kiriPoint_Find(const kiriSheetData* sheet, kiriLatticePoint at, kiriPointPlace* place);

/* Where it was seen last, and the unit normal there. */
kiriVec3 kiriPoint_Position(const kiriSheetData* sheet, const kiriPointPlace* place);
kiriVec3 kiriPoint_Normal(const kiriSheetData* sheet, const kiriPointPlace* place);

/* Place and velocity by linear blending of the frames as they are now, without what fades: x and velocity are set. */
kiriMotion kiriPoint_Blend(const kiriSheetData* sheet, const kiriPointPlace* place);

/* Blocks of 64 vertices: which of them a tick may have to write anew, so that what sleeps, and what a cut leaves as it
   is, costs nothing. */

enum { KIRI_BLOCK = 64, KIRI_UNKNOWN = -2 };

/* Reserves room for so many vertices and frames. */
bool kiriBlocks_Reserve(kiriBlocks* blocks, kiriMemory* memory, int32_t vertexCount, int32_t frameCount);

/* Sets the counts, for which there is room. Nothing is known of new blocks. */
void kiriBlocks_Resize(kiriBlocks* blocks, int32_t vertexCount, int32_t frameCount);

/* Vertices or frames have other indices: nothing is known. */
void kiriBlocks_Forget(kiriBlocks* blocks);

/* Of these vertices some have other weights, or are new: who moves them is found anew. */
void kiriBlocks_ForgetOne(kiriBlocks* blocks, int32_t block);

/* When other pieces are awake, or blocks are not known: a block has its mover until that falls asleep, and one that has
   none gets one where a frame of it woke. */
void kiriBlocks_FindMovers(kiriSheetData* sheet);

/* Bits of the patches that are other than before. */
kiriFrameMask kiriBlocks_MaskOfOther(const kiriPatches* patches);

/* May a patch of these carry a vertex of the block? */
static inline bool kiriBlocks_MayMeet(const kiriBlocks* blocks, int32_t block, const kiriFrameMask* mask)
{
    const uint64_t *a = blocks->frames.data[block].bits, *b = mask->bits;
    bool mayNear = ((a[0] & b[0]) | (a[1] & b[1])) != 0, mayFar = ((a[2] & b[2]) | (a[3] & b[3])) != 0;
    return blocks->movers.data[block] == KIRI_UNKNOWN || (mayNear && mayFar);
}

static inline void kiriBlocks_Stale(kiriBlocks* blocks, int32_t vertex)
{
    if (vertex >= 0) {
        blocks->stale.data[vertex / KIRI_BLOCK] = 1;
    }
}

static inline bool kiriBlocks_Moves(const kiriBlocks* blocks, int32_t block)
{
    return blocks->movers.data[block] != KIRI_NONE;
}

/* What the host sees of a sheet: the skinned mesh and the collision points. */

typedef struct kiriViewCounts {
    int32_t vertices, triangles, frames, points;
} kiriViewCounts;

/* Reserves room, so that Resize, and writing, cannot fail. */
bool kiriView_Reserve(kiriSheetData* sheet, kiriViewCounts counts);

/* Makes all arrays as long as the mesh, the points, and so many frames need. */
void kiriView_Resize(kiriSheetData* sheet, int32_t frameCount);

/* Room for what fades in so much time when a cut takes effect, or what is seen changes otherwise. */
bool kiriView_ReserveFades(kiriSheetData* sheet, int32_t vertexCount, int32_t pointCount, double fadeTime);

/* The vertices whose weights are staged; before these take effect. */
void kiriView_TouchStaged(kiriSheetData* sheet);

/* What has changed in the mesh; before kiriMesh_Commit. */
void kiriView_WriteTopology(kiriSheetData* sheet);

/* New vertices of a tick in which nothing moves: they get normals, which writing positions would give them. */
void kiriView_ShowNewborn(kiriSheetData* sheet);

/* Pieces that are gone are seen no more; the indices that the host may hold are another array by now. */
void kiriView_HideGone(kiriSheetData* sheet);

/* After all commits of a tick, and before the sheet moves: what is seen stays where it is, and fades from there to
   where it belongs. Then time goes on. */
void kiriView_TakeJump(kiriSheetData* sheet);
void kiriView_Fade(kiriSheetData* sheet, double dt);

/* Would writing positions change nothing, as long as frames stay where they are? */
bool kiriView_IsSettled(const kiriSheetData* sheet);

/* Frees what fades have no use for. */
void kiriView_Trim(kiriSheetData* sheet);

/* When positions are written: the boxes around them, where somebody asks. */
void kiriView_KeepBounds(kiriSheetData* sheet);

/* Positions and normals from the frames (section 4.1 of the paper). */
void kiriView_WritePositions(kiriSheetData* sheet);

/* The same in steps, one after the other: what runs over the vertices from `begin` to `end` writes nothing else, so
   that ranges, which begin at multiples of 4, may be written at the same time. */
void kiriView_TakeFrames(kiriSheetData* sheet);
void kiriView_BlendRange(kiriSheetData* sheet, int32_t begin, int32_t end);
void kiriView_Sum(kiriSheetData* sheet);
void kiriView_WriteRange(kiriSheetData* sheet, int32_t begin, int32_t end);
void kiriView_EndWriting(kiriSheetData* sheet);

KIRI_C_END

#endif
