/* Queries of a material point on the visible surface, and the visible state of a sheet. */
#ifndef KIRI_SEEN_H
#define KIRI_SEEN_H

#include "kiri_piece.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

typedef struct kiriPointPlace {
    kiriLatticePoint at;
    int32_t triangle;
    double shares[3]; /* barycentric coordinates */
} kiriPointPlace;

/* Finds the triangle of a point. Returns false outside the material. */
bool kiriPoint_Find(const kiriSheetData* sheet, kiriLatticePoint at, kiriPointPlace* place);

/* Return the last position on the skin, and the unit normal of the drawn surface there. */
kiriVec3 kiriPoint_Position(const kiriSheetData* sheet, const kiriPointPlace* place);
kiriVec3 kiriPoint_Normal(const kiriSheetData* sheet, const kiriPointPlace* place);

/* Returns the last position on the drawn surface. */
kiriVec3 kiriPoint_Drawn(const kiriSheetData* sheet, const kiriPointPlace* place);

/* Return the normal of the skin for contacts: at a vertex; and at a place of a triangle, continuous over edges, zero if
   the normals of the corners cancel out. Call kiriSurface_NeedNormals first. */
kiriVec3 kiriVertex_SkinNormal(const kiriSheetData* sheet, int32_t vertex);
kiriVec3 kiriTriangle_SkinNormal(const kiriSheetData* sheet, int32_t triangle, const double share[3]);

/* Returns x and velocity by linear blending of the current frames, without fades. The other fields are not set. */
kiriMotion kiriPoint_Blend(const kiriSheetData* sheet, const kiriPointPlace* place);

/* Returns true if the seam passes the point of the rest plane (m, local) nearer than `reach`. */
bool kiriSewn_IsNear(const kiriSheetData* sheet, kiriSeam seam, kiriVec2 at, double reach);

/* Blocks of 64 vertices: track which vertices a tick must write. Sleeping pieces, and vertices that a cut did not
   change, cost nothing. */

enum { KIRI_BLOCK = 64, KIRI_UNKNOWN = -2 };

/* Sets the counts after vertices or frames were renumbered. Room is reserved. */
void kiriBlocks_Renumber(kiriBlocks* blocks, int32_t vertexCount, int32_t frameCount);

/* The visible state of a sheet: the skinned mesh and the collision points. */

typedef struct kiriViewCounts {
    int32_t vertices, triangles, frames, points;
} kiriViewCounts;

/* Reserves all arrays, so that Resize and writing cannot fail. */
bool kiriView_Reserve(kiriSheetData* sheet, kiriViewCounts counts);

/* Resizes all arrays for the mesh, the points and `frameCount` frames. */
void kiriView_Resize(kiriSheetData* sheet, int32_t frameCount);

/* Reserves the fades of a commit, or of changed settings. `fadeTime` in s; 0 needs no room. */
bool kiriView_ReserveFades(kiriSheetData* sheet, int32_t vertexCount, int32_t pointCount, double fadeTime);

/* Marks the blocks of vertices with staged weights. Call before the commit of the weights. */
void kiriView_TouchStaged(kiriSheetData* sheet);

/* Writes the changed triangles and new vertices. Call before kiriMesh_Commit. */
void kiriView_WriteTopology(kiriSheetData* sheet);

/* Writes the normals of new vertices in a tick that does not write positions. */
void kiriView_ShowNewborn(kiriSheetData* sheet);

/* HideTriangles hides the triangles of destroyed pieces. HideGone hides the pieces: the index array that the host may hold
   was replaced before. */
void kiriView_HideTriangles(kiriSheetData* sheet);
void kiriView_HideGone(kiriSheetData* sheet);

/* TakeJump turns the change by the commits of a tick into fading offsets, so that nothing visibly jumps. Call it after
   all commits and before the sheet moves. Fade then decays the offsets over dt (s). */
void kiriView_TakeJump(kiriSheetData* sheet);
void kiriView_Fade(kiriSheetData* sheet, double dt);

/* Returns true if writing positions would change nothing while the frames do not move. */
bool kiriView_IsSettled(const kiriSheetData* sheet);

/* Frees the memory of fades that ended. */
void kiriView_Trim(kiriSheetData* sheet);

/* Updates the bounds after positions were written, if they are in use. */
void kiriView_KeepBounds(kiriSheetData* sheet);

/* Writes all positions and normals from the frames (section 4.1 of the paper). */
void kiriView_WritePositions(kiriSheetData* sheet);

/* Measures the drawn surface in rounds of a second, each triangle once. Returns the strained area, m^2, if a second round
   in a row finds more than a tenth of the surface strained by over 15 %; else 0. */
double kiriView_Watch(kiriSheetData* sheet, double dt);

/* The steps of kiriView_WritePositions, in order. A range step writes only the vertices from `begin` to `end`, so
   ranges that begin at multiples of 4 may run in parallel. */
void kiriView_TakeFrames(kiriSheetData* sheet);
void kiriView_BlendRange(kiriSheetData* sheet, int32_t begin, int32_t end);
void kiriView_AddFades(kiriSheetData* sheet);
void kiriView_Sum(kiriSheetData* sheet);
void kiriView_WriteRange(kiriSheetData* sheet, int32_t begin, int32_t end);
void kiriView_EndWriting(kiriSheetData* sheet);

/* The tick of the detail layer, between AddFades and Sum: Relax sweeps, and EndRelaxing takes the offsets. In between
   obstacles push out the vertices in `moving` of the layer. Return false if there is nothing to relax. */
bool kiriView_Relax(kiriSheetData* sheet, const kiriTasks* tasks);
void kiriView_EndRelaxing(kiriSheetData* sheet);

KIRI_C_END

#endif
