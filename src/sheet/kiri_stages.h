/* The stages of the work on a cut, in their order, and what its commit does. Each stage goes on where the quota of the
   last tick ended, and costs what the cut touched. KIRI_FAILED is for memory. kiri_pipeline.h runs them. */
#ifndef KIRI_STAGES_H
#define KIRI_STAGES_H

#include "kiri_update.h"

KIRI_C_BEGIN

kiriProgress kiriStage_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles);
kiriProgress kiriStage_Grid(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Regions(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Shape(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Samples(kiriSheetData* sheet, kiriQuota* samples);
kiriProgress kiriStage_Constants(kiriSheetData* sheet, kiriQuota* samples);

/* After a commit, in later ticks and before samples are weighed again: see kiriSkin_Settle. */
kiriProgress kiriStage_Settle(kiriSheetData* sheet, kiriQuota* samples);

/* A stage in steps: goes on with sheet->update->step, which starts with 0. */
typedef kiriProgress kiriStageStep(kiriSheetData* sheet, kiriQuota* quota);
kiriProgress kiriStage_RunSteps(kiriSheetData* sheet, kiriQuota* quota, kiriStageStep* const* steps, int32_t count);

/* Of a sheet that is made: the first step of the constants, which depends on the mesh alone. */
kiriProgress kiriStage_Owners(kiriSheetData* sheet, kiriQuota* samples);

/* Stages the solver for so many frames, with the links and the layout that are staged. False for memory. */
bool kiriStage_Solver(kiriSheetData* sheet, int32_t frameCount);

/* What this tick did to the mesh becomes final. Never fails. */
void kiriStage_CommitMesh(kiriSheetData* sheet);

/* After the last stage: what is staged comes in force. New frames take their motion from the surface as it was (section
   5 of the paper). Never fails. */
void kiriStage_Commit(kiriSheetData* sheet);

/* Forgets what is staged. */
void kiriStage_Drop(kiriSheetData* sheet);

KIRI_C_END

#endif
