/* What is seen: as if all of it were written anew. */
#include "validate_check.h"

#include "sheet/kiri_build.h"

#include <math.h>
#include <string.h>

static float* CopyFloats(Check* check, const float* from, int64_t count)
{
    float* copy = (float*)Check_Bytes(check, (count + 4) * (int64_t)sizeof(float));
    if (count > 0) {
        memcpy(copy, from, sizeof(float) * (size_t)count);
    }
    return copy;
}

static bool Check_SameFloats(Check* check, const kiriSheetData* sheet, const char* what, const float* is,
                             const float* should)
{
    for (int32_t v = 0; v < sheet->seen.surface.vertexCount; ++v) {
        const float *a = is + 3 * (size_t)v, *b = should + 3 * (size_t)v;
        REQUIRE(memcmp(a, b, 3 * sizeof(float)) == 0,
                "the %s of vertex %d is %.9g %.9g %.9g, written anew %.9g %.9g %.9g", what, v, (double)a[0],
                (double)a[1], (double)a[2], (double)b[0], (double)b[1], (double)b[2]);
    }
    return true;
}

/* Far from the origin of the world positions are sums of floats, in whatever way these were added. */
static bool Check_AreFarSums(Check* check, const kiriSurface* surface)
{
    const float middle[3] = { (float)surface->middle.x, (float)surface->middle.y, (float)surface->middle.z };
    for (int64_t k = 0; kiriSurface_IsFar(surface) && k < 3 * (int64_t)surface->vertexCount; ++k) {
        float sum = middle[k % 3] + kiriSurface_Drawn(surface)[k];
        REQUIRE(surface->positions.data[k] == sum, "coordinate %d is %.9g, and not %.9g", (int)k, (double)surface->positions.data[k], (double)sum);
    }
    return true;
}

/* Offsets are no longer than the leash, and edges of a color share no vertex. */
static bool Check_Detail(Check* check, const kiriSheetData* sheet)
{
    const kiriDetail* detail = &sheet->seen.surface.detail;
    int32_t* last = Check_Ints(check, sheet->mesh.vertices.count, KIRI_NONE);
    REQUIRE(detail->sweeps == kiriSettings_Detail(&sheet->settings), "%d sweeps", detail->sweeps);
    REQUIRE(detail->offsets.count == (kiriDetail_IsOn(detail) ? 3 * sheet->seen.surface.vertexCount : 0), "%d offsets",
            detail->offsets.count);
    for (int32_t k = 0; k < detail->offsets.count; ++k) {
        REQUIRE(isfinite(detail->offsets.data[k]), "the offset of vertex %d is %g", k / 3, (double)detail->offsets.data[k]);
    }
    for (int32_t color = 0; detail->isListed && color < KIRI_DETAIL_COLORS - 1; ++color) {
        for (int32_t k = detail->colorStart[color]; k < detail->colorStart[color + 1]; ++k) {
            const kiriDetailEdge* edge = &detail->edges.data[k];
            REQUIRE(last[edge->a] != color && last[edge->b] != color, "edge %d %d meets another of color %d", edge->a,
                    edge->b, color);
            last[edge->a] = last[edge->b] = color;
        }
    }
    return true;
}

bool Check_Seen(Check* check, const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    kiriSurface anew = *surface;
    int64_t count = surface->vertexCount;
    check->part = "seen";
    if (!Check_Detail(check, sheet)) {
        return false;
    }
    if (!surface->isSteady || surface->patches.count != sheet->frames.count ||
        sheet->seen.isElsewhere) {
        return true; /* something has changed since it was written */
    }
    anew.positions.data = CopyFloats(check, surface->positions.data, 3 * count + 1);
    anew.places.data = CopyFloats(check, surface->places.data, 3 * count + 1);
    anew.detail.drawn.data = CopyFloats(check, surface->detail.drawn.data, surface->detail.drawn.count);
    anew.normals.data = CopyFloats(check, surface->normals.data, 3 * count);
    anew.slopes.data = CopyFloats(check, surface->slopes.data, 4 * count);
    kiriSurface_BlendRange(&anew, &sheet->vertexSkin, 0, surface->vertexCount);
    kiriSurface_AddFades(&anew, &sheet->seen.fades);
    kiriSurface_DrawRange(&anew, 0, surface->vertexCount);
    kiriSurface_SumNormals(&anew);
    kiriSurface_WriteRange(&anew, 0, surface->vertexCount);
    return Check_AreFarSums(check, &anew) &&
           Check_SameFloats(check, sheet, "position", surface->positions.data, anew.positions.data) &&
           (!surface->wantsNormals || !surface->hasNormals ||
            Check_SameFloats(check, sheet, "normal", surface->normals.data, anew.normals.data));
}
