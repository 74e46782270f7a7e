#include "kiri_call.h"

#include <math.h>
#include <stdio.h>

kiriResult kiriCall_Fail(const kiriWorld* world, char* line, kiriResult result, const char* function, const char* why)
{
    snprintf(line, KIRI_LINE_BYTES, "%s: %s (%s)", function, why != NULL ? why : kiriGetResultText(result),
             kiriGetResultName(result));
    if (world->log != NULL) {
        kiriWord_Add(&world->logs, 1);
        world->log(world->user, line);
        kiriWord_Add(&world->logs, -1);
    }
    return result;
}

/* A log that calls gets no line for it: that would be another call of it. */
kiriResult kiriCall_Refuse(const kiriWorld* world, const char* function)
{
    char line[KIRI_LINE_BYTES];
    if (kiriWord_Read(&world->logs) != 0) {
        return KIRI_ERROR_STATE;
    }
    return kiriCall_Fail(world, line, KIRI_ERROR_STATE, function, "called by a callback of this world");
}

void* kiriCall_Owner(const kiriPool* pool, uint32_t id)
{
    const kiriSlot* slot = kiriPool_Find(pool, id);
    return slot != NULL ? slot->owner : NULL;
}

bool kiriCall_AreFinite(const float* values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

bool kiriCall_IsAbove(float value, float low)
{
    return isfinite(value) && value > low;
}

bool kiriCall_IsAtLeast(float value, float low)
{
    return isfinite(value) && value >= low;
}

bool kiriCall_IsWithin(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

bool kiriCall_AreOrthonormal(const float a[3], const float b[3])
{
    if (!kiriCall_AreFinite(a, 3) || !kiriCall_AreFinite(b, 3)) {
        return false;
    }
    kiriVec3 u = kiriVec3_Load(a), v = kiriVec3_Load(b);
    return fabs(kiriVec3_Dot(u, u) - 1.0) < 1e-3 && fabs(kiriVec3_Dot(v, v) - 1.0) < 1e-3 &&
           fabs(kiriVec3_Dot(u, v)) < 1e-3;
}

const char* kiriCall_FaultOfRotation(const kiriSheetData* sheet, const float rotation[9])
{
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    bool isPlanar = sheet->settings.mechanics.planar;
    if (!kiriCall_AreOrthonormal(&rotation[0], &rotation[3]) || !kiriCall_AreOrthonormal(&rotation[3], &rotation[6]) ||
        !kiriCall_AreOrthonormal(&rotation[6], &rotation[0])) {
        return "rotation is not orthonormal";
    }
    if (!(kiriVec3_Dot(kiriVec3_Cross(m.u, m.v), m.d) > 0.0)) {
        return "rotation mirrors";
    }
    return isPlanar && !(kiriVec3_Dot(m.d, sheet->settings.mechanics.axes.d) > 0.999999)
               ? "rotation turns a planar sheet out of its plane"
               : NULL;
}

const char* kiriCall_FaultOfLine(const kiriSheetData* sheet, const float from[2], const float to[2],
                                 kiriLatticePoint ends[2])
{
    if (from == NULL || to == NULL || !kiriCall_AreFinite(from, 2) || !kiriCall_AreFinite(to, 2)) {
        return "from or to is null or not finite";
    }
    if (!kiriSheet_ToLattice(sheet, from, &ends[0]) || !kiriSheet_ToLattice(sheet, to, &ends[1])) {
        return "from or to lies too far outside the sheet";
    }
    return ends[0].x == ends[1].x && ends[0].y == ends[1].y ? "from and to are the same point" : NULL;
}
