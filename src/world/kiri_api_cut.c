#include "kiri_call.h"
#include "../view/kiri_section.h"

kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut)
{
    KIRI_CHANGES(world, KIRI_CALL_BEGIN_CUT, &sheet, restPoint, cut);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2) && cut != NULL,
               "restPoint or cut is null, or not finite");
    *cut = 0;
    KIRI_FIND_SHEET(data, sheet);
    kiriCutData* made;
    kiriResult result = kiriWorld_AddCut(world, data, 1, &made);
    if (result != KIRI_OK) {
        return KIRI_FAIL(result, NULL);
    }
    kiriWorld_QueuePoint(world, made, kiriSheet_ToLocal(data, restPoint), true);
    *cut = made->id;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count)
{
    KIRI_CHANGES(world, KIRI_CALL_CUT_EXTEND, &cut, restPoints, &count);
    KIRI_CHECK(restPoints != NULL && kiriCall_IsWithin(count, 1, 1 << 24),
               "restPoints is null, or count not within 1 and 16777216");
    KIRI_CHECK(kiriCall_AreFinite(restPoints, 2 * count), "a point is not finite");
    KIRI_FIND_CUT(data, cut);
    kiriSheetData* sheet = data->sheet;
    if (data->ended) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    if (!kiriArray_Reserve(&world->memory, &sheet->queue, (int64_t)sheet->queue.count + count)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    for (int32_t i = 0; i < count; ++i) {
        kiriWorld_QueuePoint(world, data, kiriSheet_ToLocal(sheet, &restPoints[2 * i]), false);
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriCut_End(kiriWorld* world, kiriCut cut)
{
    KIRI_CHANGES(world, KIRI_CALL_CUT_END, &cut);
    KIRI_FIND_CUT(data, cut);
    if (data->ended) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    if (!kiriArray_Reserve(&world->memory, &data->sheet->queue, (int64_t)data->sheet->queue.count + 1)) {
        return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);
    }
    kiriWorld_EndCut(world, data);
    KIRI_RETURN(KIRI_OK);
}

/* The ways of a cut along all lines of a section, and where each of them starts. */
static bool FindWays(const kiriSheetData* sheet, const kiriSection* section, kiriMemory* scratch, kiriRestPoints* ways,
                     kiriIndices* starts)
{
    double snap = sheet->settings.snap * sheet->mesh.step;
    bool ok = true;
    for (int32_t i = 0; ok && i < section->lines.count; ++i) {
        ok = kiriArray_Push(scratch, starts, ways->count) &&
             kiriSection_Path(section, &section->lines.data[i], false, 0.5 * snap, 0.25 * snap, scratch, ways);
    }
    return ok;
}

static kiriResult QueueSlice(kiriWorld* world, kiriSheetData* sheet, const kiriVec3 quad[4], kiriMemory* scratch,
                             kiriCut* cut)
{
    kiriSection section = { { NULL, 0, 0 }, { NULL, 0, 0 } };
    kiriRestPoints ways = { NULL, 0, 0 };
    kiriIndices starts = { NULL, 0, 0 };
    if (!kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) ||
        !kiriSection_Sweep(&section, scratch, &sheet->seen.surface, sheet->seen.bounds, quad) ||
        !FindWays(sheet, &section, scratch, &ways, &starts)) {
        return KIRI_ERROR_MEMORY;
    }
    kiriCutData* made;
    kiriResult result = kiriWorld_AddCut(world, sheet, ways.count, &made);
    if (result != KIRI_OK) {
        return result;
    }
    for (int32_t i = 0, k = 0; i < ways.count; ++i) {
        bool isStart = k < starts.count && starts.data[k] == i;
        kiriWorld_QueuePoint(world, made, ways.data[i], isStart);
        k += isStart;
    }
    kiriWorld_EndCut(world, made);
    *cut = made->id;
    return KIRI_OK;
}

kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SLICE, &sheet, blade, cut);
    KIRI_CHECK(blade != NULL && kiriCall_AreFinite(blade, 12) && cut != NULL, "blade or cut is null, or not finite");
    *cut = 0;
    KIRI_FIND_SHEET(data, sheet);
    const kiriVec3 quad[4] = { kiriVec3_Load(&blade[0]), kiriVec3_Load(&blade[3]), kiriVec3_Load(&blade[6]),
                               kiriVec3_Load(&blade[9]) };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriResult result = QueueSlice(world, data, quad, &scratch, cut);
    kiriMemory_FreeAll(&scratch);
    KIRI_RETURN(result);
}
