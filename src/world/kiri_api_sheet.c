#include "kiri_call.h"
#include "../sheet/kiri_settings.h"

#include <string.h>

void kiriDefaultSheetDef(kiriSheetDef* def)
{
    if (def == NULL) {
        return;
    }
    memset(def, 0, sizeof(*def));
    def->cookie = KIRI_COOKIE(kiriSheetDef);
    def->axisU[0] = 1.0f;
    def->axisV[1] = 1.0f;
    kiriGetMaterial(KIRI_MATERIAL_COTTON, &def->material);
    def->gridResolution = 32;
    def->frameCount = 5;
    def->accuracy = 0.02f;
    def->maxFrames = 256;
    def->rigidWeight = 0.95f;
    def->friction = 0.5f;
    def->groups = UINT32_MAX;
    def->iterations = 2;
    def->sleepSpeed = 0.001f;
    def->timeStepping = KIRI_TIME_STEPPING_SECOND_ORDER;
    def->fadeTime = 0.2f;
    def->normals = 1;
    def->paper.integrationOrder = 1;
}

static const char* FaultOfPlacement(const kiriSheetDef* def)
{
    if (!kiriCall_AreFinite(def->position, 3) || !kiriCall_AreFinite(def->velocity, 3)) {
        return "position or velocity is not finite";
    }
    return kiriCall_AreOrthonormal(def->axisU, def->axisV) ? NULL : "axisU and axisV are not orthonormal";
}

static const char* FaultOfFrames(const kiriSheetDef* def)
{
    if (!kiriCall_IsWithin(def->frameCount, 0, 65536)) {
        return "frameCount is not within 0 and 65536";
    }
    if (!kiriCall_IsAtLeast(def->frameLength, 0.0f) || (def->frameCount == 0 && def->framePoints != NULL)) {
        return "frameLength is below 0, or there are framePoints and no frameCount";
    }
    if (!kiriCall_IsAtLeast(def->accuracy, 1e-4f) || def->accuracy > 1.0f) {
        return "accuracy is not within 1e-4 and 1";
    }
    if (def->framePoints != NULL && !kiriCall_AreFinite(def->framePoints, 2 * def->frameCount)) {
        return "a frame point is not finite";
    }
    return kiriCall_IsAbove(def->rigidWeight, 0.0f) && kiriCall_IsAtLeast(def->rigidArea, 0.0f)
               ? NULL
               : "rigidWeight is not above 0, or rigidArea below 0";
}

static const char* FaultOfModel(const kiriSheetDef* def)
{
    if (!kiriCall_IsWithin(def->model, KIRI_MODEL_LINKS, KIRI_MODEL_POINTS)) {
        return "model is not one of KIRI_MODEL";
    }
    return kiriCall_IsWithin(def->planar, 0, 1) ? NULL : "planar is not 0 or 1";
}

static const char* FaultOfPaper(const kiriPaperOptions* paper)
{
    if (!kiriCall_IsWithin(paper->fromScratch, 0, 1) || !kiriCall_IsWithin(paper->popping, 0, 1) ||
        !kiriCall_IsWithin(paper->linearWeights, 0, 1)) {
        return "fromScratch, popping or linearWeights is not 0 or 1";
    }
    return kiriCall_IsWithin(paper->integrationPoints, 0, 1 << 20) && kiriCall_IsWithin(paper->integrationOrder, 1, 2)
               ? NULL
               : "integrationPoints is not within 0 and 1048576, or integrationOrder not 1 or 2";
}

static const char* FaultOfSheetValues(const kiriSheetDef* def)
{
    const kiriSheetSettings settings = kiriSettings_Of(def);
    const char* faults[] = { kiriCall_FaultOfSettings(&settings), FaultOfPlacement(def), FaultOfFrames(def),
                             FaultOfModel(def), FaultOfPaper(&def->paper) };
    for (int i = 0; i < 5; ++i) {
        if (faults[i] != NULL) {
            return faults[i];
        }
    }
    if (!kiriCall_IsWithin(def->gridResolution, 1, 4096)) {
        return "gridResolution is not within 1 and 4096";
    }
    if (!kiriCall_IsAtLeast(def->snapDistance, 0.0f) || !kiriCall_IsAtLeast(def->weldDistance, 0.0f)) {
        return "snapDistance or weldDistance is below 0";
    }
    return kiriCall_IsWithin(def->collisionPoints, 0, 1 << 20) ? NULL : "collisionPoints is not within 0 and 1048576";
}

static kiriResult CheckSheetDef(const kiriSheetDef* def, kiriSheet* sheet, kiriFault* fault)
{
    if (def == NULL || sheet == NULL) {
        KIRI_SAY(fault, "def or sheet is null");
        return KIRI_ERROR_ARGUMENT;
    }
    *sheet = 0;
    if (def->cookie != KIRI_COOKIE(kiriSheetDef)) {
        KIRI_SAY(fault, "the def was not filled by kiriDefaultSheetDef");
        return KIRI_ERROR_DEF;
    }
    const char* why = FaultOfSheetValues(def);
    if (why != NULL) {
        KIRI_SAY(fault, "%s", why);
        return KIRI_ERROR_ARGUMENT;
    }
    return KIRI_OK;
}

/* Adds a sheet and records that. `function` is the one that the host has called. */
static kiriResult AddSheet(kiriWorld* world, char* line, const char* function, const kiriSheetDef* def,
                           kiriSheet* sheet)
{
    const void* const arguments[] = { def, sheet };
    const kiriCall call = { world, KIRI_CALL_CREATE_SHEET, arguments };
    const kiriCall* record = world->recorder.sink.write != NULL ? kiriRecord_Begin(&call) : NULL;
    kiriFault fault = { "" };
    kiriResult result = CheckSheetDef(def, sheet, &fault);
    result = result == KIRI_OK ? kiriWorld_AddSheet(world, def, sheet, &fault) : result;
    const char* why = fault.line[0] != '\0' ? fault.line : NULL;
    return kiriCall_End(NULL, record, result < 0 ? kiriCall_Fail(world, line, result, function, why) : result);
}

kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet)
{
    KIRI_PREPARES(world);
    return kiriCall_End(entered, record, AddSheet(world, line, __func__, def, sheet));
}

kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet)
{
    KIRI_CHANGES(world, KIRI_CALL_DESTROY_SHEET, &sheet);
    KIRI_FIND_SHEET(data, sheet);
    kiriWorld_RemoveSheet(world, data);
    KIRI_RETURN(KIRI_OK);
}

static bool IsRectangle(float width, float height, int32_t columns, int32_t rows)
{
    return kiriCall_IsAbove(width, 0.0f) && kiriCall_IsAbove(height, 0.0f) && kiriCall_IsWithin(columns, 1, 4096) &&
           kiriCall_IsWithin(rows, 1, 4096);
}

kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions,
                             int32_t* indices)
{
    if (!IsRectangle(width, height, columns, rows) || restPositions == NULL || indices == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= columns; ++i) {
            *restPositions++ = (float)((double)width * i / columns);
            *restPositions++ = (float)((double)height * j / rows);
        }
    }
    for (int32_t j = 0; j < rows; ++j) {
        for (int32_t i = 0; i < columns; ++i) {
            /* Diagonals alternate, so that the mesh has no grain. */
            int32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 2, d = a + columns + 1;
            int32_t even[6] = { a, b, c, a, c, d }, odd[6] = { a, b, d, b, c, d };
            memcpy(indices, (i + j) % 2 == 0 ? even : odd, sizeof(even));
            indices += 6;
        }
    }
    return KIRI_OK;
}

kiriResult kiriCreateRectangle(kiriWorld* world, float width, float height, int32_t columns, int32_t rows,
                               const kiriSheetDef* def, kiriSheet* sheet)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(sheet != NULL, "sheet is null");
    *sheet = 0;
    KIRI_CHECK(IsRectangle(width, height, columns, rows), "a size is not above 0, or a count not within 1 and 4096");
    kiriSheetDef filled;
    kiriDefaultSheetDef(&filled);
    if (def != NULL) {
        filled = *def;
    }
    filled.vertexCount = (columns + 1) * (rows + 1);
    filled.triangleCount = 2 * columns * rows;
    float* positions = kiriMemory_Alloc(&world->memory, (int64_t)sizeof(float) * 2 * filled.vertexCount);
    int32_t* indices = kiriMemory_Alloc(&world->memory, (int64_t)sizeof(int32_t) * 3 * filled.triangleCount);
    kiriResult result = KIRI_ERROR_MEMORY;
    if (positions != NULL && indices != NULL) {
        kiriFillRectangle(width, height, columns, rows, positions, indices);
        filled.restPositions = positions;
        filled.indices = indices;
        result = AddSheet(world, line, __func__, &filled, sheet);
    }
    kiriMemory_Free(&world->memory, positions);
    kiriMemory_Free(&world->memory, indices);
    bool isSaid = line[0] != '\0' || result >= 0;
    return isSaid ? kiriCall_End(entered, record, result) : KIRI_FAIL(result, NULL);
}
