/* What the host sees of a sheet: the skinned mesh and the collision points. */
#ifndef KIRI_VIEW_H
#define KIRI_VIEW_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* Room for the mesh as it is, for so many frames and collision points; after it writing never fails. */
bool kiriView_Resize(kiriSheetData* sheet, int32_t frameCount, int32_t pointCount);

/* What was for vertices and points that do not come is no more than room. After kiriMesh_Rollback; never fails. */
void kiriView_Truncate(kiriSheetData* sheet);

/* Room for what fades in so much time when a cut takes effect, or what is seen changes otherwise. */
bool kiriView_ReserveFades(kiriSheetData* sheet, int32_t pointCount, double fadeTime);

/* The vertices whose weights are staged; before these take effect. */
void kiriView_TouchStaged(kiriSheetData* sheet);

/* What has changed in the mesh; before kiriMesh_Commit. */
void kiriView_WriteTopology(kiriSheetData* sheet);

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
