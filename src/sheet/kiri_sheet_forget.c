#include "kiri_sheet_save.h"

#include "../field/kiri_field_save.h"
#include "kiri_update.h"

#include <string.h>

/* Who owns what is state of the motion; what changes owner is not. Its room in the list is not used before the next
   update, which is from scratch. */
static void ForgetTransfers(kiriOwnership* ownership)
{
    ownership->dirty.count = ownership->staged.count = ownership->transfers.count = ownership->first.count = 0;
    ownership->next = 0;
    ownership->due = 0;
    if (ownership->isDirty.count > 0) {
        memset(ownership->isDirty.data, 0, (size_t)ownership->isDirty.count);
    }
}

static void ForgetUpdate(kiriUpdate* u, kiriMemory* memory)
{
    kiriUpdate was = *u;
    memset(&u->refit.ownership, 0, sizeof(u->refit.ownership));
    kiriGrowing_Drop(&u->growing);
    kiriArchive_Forget(&kiriUpdateTable, u, memory);
    u->stage = was.stage > KIRI_STAGE_CUT ? KIRI_STAGE_GRID : was.stage;
    u->step = was.stage == KIRI_STAGE_CUT ? was.step : 0;
    u->spent = was.stage == KIRI_STAGE_CUT ? was.spent : 0;
    u->needsRebuild = true;
    u->isUnsettled = was.isUnsettled;
    u->growsSince = was.growsSince;
    u->cut = was.cut;
    u->cut.meshChanged = was.cut.meshChanged || was.stage > KIRI_STAGE_CUT;
    u->samples.oldVertices = was.samples.oldVertices;
    u->refit.ownership = was.refit.ownership;
    u->counts = was.counts;
    ForgetTransfers(&u->refit.ownership);
}

/* Weights that are staged are no more. */
static void ForgetStagedWeights(kiriSkin* skin)
{
    skin->settling.count = skin->staged.count > 0 ? 0 : skin->settling.count;
    skin->staged.count = 0;
}

static bool KeepDirt(kiriSheetData* sheet, const kiriArrayHeader* was)
{
    int32_t count = sheet->frames.count;
    if (!kiriArray_Resize(sheet->memory, &sheet->regions.dirty, count)) {
        return false;
    }
    for (int32_t f = 0; f < count; ++f) {
        sheet->regions.dirty.data[f] = was->count != count || ((const uint8_t*)was->data)[f] != 0;
    }
    return true;
}

bool kiriSheet_ForgetWork(kiriSheetData* sheet)
{
    kiriMemory* memory = sheet->memory;
    kiriUpdate* u = sheet->update;
    kiriArrayHeader dirt = kiriArray_GetHeader(&sheet->regions.dirty);
    memset(&sheet->regions.dirty, 0, sizeof(sheet->regions.dirty));
    kiriGrid_Forget(&sheet->grid, memory);
    kiriRegions_Forget(&sheet->regions, memory);
    kiriShape_Forget(&sheet->shape, memory);
    kiriLinks_Forget(&sheet->links, memory);
    ForgetUpdate(u, memory);
    ForgetStagedWeights(&sheet->vertexSkin);
    ForgetStagedWeights(&sheet->pointSkin);
    bool ok = KeepDirt(sheet, &dirt) && kiriArray_Reserve(memory, &u->placing.sites, sheet->frames.count);
    kiriArray_Release(memory, &dirt);
    for (int32_t f = 0; ok && f < sheet->frames.count; ++f) {
        sheet->frames.data[f].site.cell = 0;
        u->placing.sites.data[u->placing.sites.count++] = sheet->frames.data[f].site;
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        sheet->points.data[i].cell = 0;
    }
    return ok;
}
