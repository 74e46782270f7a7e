/* What a cut sets off in a sheet, stage by stage; world.c runs the stages, and says what they cost. Each goes on where
   the last tick's quota ended, and costs what the cut touched. */
#ifndef KIRI_UPDATE_H
#define KIRI_UPDATE_H

#include "kiri_sheet.h"

/* Takes the points that were given before one tick from the queue, when nothing is at hand; false where none wait. */
bool kiriUpdate_Start(kiriSheetData* sheet);

/* The stages in their order. KIRI_FAILED is for memory: then kiriUpdate_Abort. */
kiriProgress kiriUpdate_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles);
kiriProgress kiriUpdate_Grid(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriUpdate_Regions(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriUpdate_Shape(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriUpdate_Samples(kiriSheetData* sheet, kiriQuota* samples);
kiriProgress kiriUpdate_Constants(kiriSheetData* sheet, kiriQuota* none);

/* What this tick did to the mesh becomes final. Never fails. */
void kiriUpdate_CommitMesh(kiriSheetData* sheet);

/* After the last stage: what is staged comes in force. New frames take their motion from the surface as it was (section
   5 of the paper). Never fails. */
void kiriUpdate_Commit(kiriSheetData* sheet);

/* After a commit, or when the strokes changed nothing: they leave the queue. */
void kiriUpdate_Finish(kiriSheetData* sheet);

/* Takes back what this tick has done, as far as anyone can see. What grid, regions and shape have learned is lost. */
void kiriUpdate_Abort(kiriSheetData* sheet);

#endif
