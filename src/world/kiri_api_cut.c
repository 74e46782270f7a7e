#include "kiri_call.h"
#include "../view/kiri_ray.h"

static void Queue(const kiriWorld* world, kiriCutData* cut, kiriVec2 to, bool jump)
{
    kiriSheetData* sheet = cut->sheet;
    kiriQueuedPoint point = { cut, to, world->ticks, jump };
    cut->waiting += 1;
    sheet->queue.data[sheet->queue.count++] = point;
}

kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2) && cut != NULL,
               "restPoint or cut is null, or not finite");
    *cut = 0;
    KIRI_FIND_SHEET(data, sheet);
    kiriCutData* made;
    kiriResult result = kiriWorld_AddCut(world, data, 1, &made);
    if (result != KIRI_OK) {
        return KIRI_FAIL(result, NULL);
    }
    Queue(world, made, kiriSheet_ToLocal(data, restPoint), true);
    *cut = made->id;
    return KIRI_OK;
}

kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count)
{
    KIRI_CHANGES(world);
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
        Queue(world, data, kiriSheet_ToLocal(sheet, &restPoints[2 * i]), false);
    }
    return KIRI_OK;
}

kiriResult kiriCut_End(kiriWorld* world, kiriCut cut)
{
    KIRI_CHANGES(world);
    KIRI_FIND_CUT(data, cut);
    if (data->ended) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    data->ended = true;
    return KIRI_OK;
}

kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(blade != NULL && kiriCall_AreFinite(blade, 12) && cut != NULL, "blade or cut is null, or not finite");
    *cut = 0;
    KIRI_FIND_SHEET(data, sheet);
    const kiriVec3 quad[4] = { kiriVec3_Load(&blade[0]), kiriVec3_Load(&blade[3]), kiriVec3_Load(&blade[6]),
                               kiriVec3_Load(&blade[9]) };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriRestPoints segments = { NULL, 0, 0 };
    kiriCutData* made = NULL;
    kiriResult result = kiriSurface_Slice(&data->seen.surface, &scratch, quad, &segments)
                            ? kiriWorld_AddCut(world, data, segments.count, &made)
                            : KIRI_ERROR_MEMORY;
    for (int32_t i = 0; made != NULL && i < segments.count; ++i) {
        Queue(world, made, segments.data[i], i % 2 == 0);
    }
    kiriMemory_FreeAll(&scratch);
    if (result == KIRI_OK) {
        made->ended = true;
        *cut = made->id;
    }
    KIRI_RETURN(result);
}
