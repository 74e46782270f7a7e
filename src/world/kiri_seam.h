/* Seams: stitches between material points, of two sheets or of one. Stitches of a tick are rows of islands (kiri_island.h):
   so both sides are in one system, and keep their momentum. A stitch belongs to its points, whatever cuts the material
   and whichever sheet a piece is in. It ends with the piece of one of them. */
#ifndef KIRI_SEAM_H
#define KIRI_SEAM_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Returns the sheet of one end of a stitch, or null if its piece is destroyed. */
kiriSheetData* kiriStitch_Sheet(const kiriWorld* world, const kiriStitchData* stitch, int end);

/* Returns the position of one end by the current frames. */
kiriVec3 kiriStitch_Point(const kiriWorld* world, const kiriSeamData* seam, int32_t stitch, int end);

/* Removes the stitches of pieces that are destroyed, and seams without stitches. */
void kiriSeams_DropStale(kiriWorld* world);

/* Finds the frames that carry the points. Call it after a commit. */
void kiriSeams_Follow(kiriWorld* world);

/* Lists the lines of seams in each sheet. Fails on out of memory. */
bool kiriSeams_ListLines(kiriWorld* world);

/* Returns the angle of the seam at a stitch, rad. */
double kiriStitch_Angle(const kiriWorld* world, const kiriSeamData* seam, int32_t stitch);

/* Stirs sleeping pieces that are sewn to moving ones. Returns true if there are any. */
bool kiriSeams_Stir(const kiriWorld* world);

/* Writes the row of a stitch for a tick of dt. sheets[]: of its ends; null: the end does not move. Returns false if none
   moves. */
bool kiriSeam_WriteRow(const kiriWorld* world, kiriSeamData* seam, int32_t stitch, double dt, kiriSheetData* sheets[2]);

/* Takes the forces of a tick of dt, and breaks stitches. Room for an event of each seam is reserved. */
void kiriSeams_End(kiriWorld* world, double dt);

/* ---- Drawn lips: a weld ---- */

/* Lists the lips of a new or loaded seam. Fails on out of memory. */
bool kiriWeld_Make(kiriWorld* world, kiriSeamData* seam);

/* Reserves for the lips of all seams, so that Close cannot fail. Call it when the meshes of the tick are made. */
bool kiriWelds_Reserve(kiriWorld* world);

/* Moves the drawn lips of all seams together, after the skins of all sheets are blended. */
void kiriWelds_Close(kiriWorld* world);

KIRI_C_END

#endif
