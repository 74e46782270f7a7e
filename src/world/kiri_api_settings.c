#include "kiri_call.h"
#include "../sheet/kiri_settings.h"

static const char* FaultOfMaterial(const kiriMaterial* m)
{
    if (!kiriCall_IsAbove(m->youngsModulus, 0.0f) || !kiriCall_IsAbove(m->thickness, 0.0f) ||
        !kiriCall_IsAbove(m->density, 0.0f)) {
        return "Young's modulus, thickness or density is not above 0";
    }
    if (!kiriCall_IsAtLeast(m->poissonsRatio, 0.0f) || m->poissonsRatio >= 0.5f) {
        return "Poisson's ratio is not within 0 and 0.5";
    }
    return kiriCall_IsAtLeast(m->airDamping, 0.0f) && kiriCall_IsAtLeast(m->flexDamping, 0.0f) ? NULL
                                                                                               : "a damping is below 0";
}

static const char* FaultOfTouching(const kiriSheetSettings* s)
{
    if (!kiriCall_IsAtLeast(s->friction, 0.0f) || !kiriCall_IsAtLeast(s->contactThickness, 0.0f)) {
        return "friction or contactThickness is below 0";
    }
    return kiriCall_IsWithin(s->touchesSheets, 0, 1) ? NULL : "touchesSheets is not 0 or 1";
}

static const char* FaultOfMotion(const kiriSheetSettings* s)
{
    if (!kiriCall_IsWithin(s->timeStepping, KIRI_TIME_STEPPING_SECOND_ORDER, KIRI_TIME_STEPPING_EULER)) {
        return "timeStepping is not one of KIRI_TIME_STEPPING";
    }
    if (!kiriCall_IsWithin(s->skinning, KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH)) {
        return "skinning is not one of KIRI_SKINNING";
    }
    if (!kiriCall_IsAtLeast(s->sleepSpeed, 0.0f) || !kiriCall_IsAtLeast(s->fadeTime, 0.0f)) {
        return "sleepSpeed or fadeTime is below 0";
    }
    if (!kiriCall_IsWithin(s->normals, 0, 1)) {
        return "normals is not 0 or 1";
    }
    return kiriCall_IsWithin(s->iterations, 1, 64) ? NULL : "iterations is not within 1 and 64";
}

const char* kiriCall_FaultOfSettings(const kiriSheetSettings* settings)
{
    const char* faults[] = { FaultOfMaterial(&settings->material), FaultOfTouching(settings), FaultOfMotion(settings) };
    for (int i = 0; i < 3; ++i) {
        if (faults[i] != NULL) {
            return faults[i];
        }
    }
    return settings->maxFrames >= 1 && kiriCall_IsAtLeast(settings->crumbArea, 0.0f)
               ? NULL
               : "maxFrames is below 1, or crumbArea below 0";
}

kiriResult kiriSheet_GetSettings(const kiriWorld* world, kiriSheet sheet, kiriSheetSettings* settings)
{
    KIRI_READS(world);
    KIRI_CHECK(settings != NULL, "settings is null");
    KIRI_FIND_SHEET(data, sheet);
    *settings = data->settings.given;
    settings->cookie = KIRI_COOKIE(kiriSheetSettings);
    return KIRI_OK;
}

kiriResult kiriSheet_SetSettings(kiriWorld* world, kiriSheet sheet, const kiriSheetSettings* settings)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SET_SETTINGS, &sheet, settings);
    KIRI_CHECK(settings != NULL, "settings is null");
    if (settings->cookie != KIRI_COOKIE(kiriSheetSettings)) {
        return KIRI_FAIL(KIRI_ERROR_DEF, "the settings were not filled by kiriSheet_GetSettings");
    }
    const char* why = kiriCall_FaultOfSettings(settings);
    KIRI_CHECK(why == NULL, why);
    KIRI_FIND_SHEET(data, sheet);
    KIRI_RETURN(kiriSettings_Change(data, settings) ? KIRI_OK : KIRI_ERROR_MEMORY);
}
