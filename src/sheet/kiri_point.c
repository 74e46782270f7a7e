#include "kiri_point.h"

#include <string.h>

bool kiriPoint_Find(const kiriSheetData* sheet, kiriLatticePoint at, kiriPointPlace* place)
{
    place->at = at;
    place->triangle = kiriMesh_Locate(&sheet->mesh, at);
    if (place->triangle == KIRI_NONE) {
        return false;
    }
    kiriLatticePoint corners[3];
    kiriMesh_Corners(&sheet->mesh, place->triangle, corners);
    double area = (double)kiriOrient(corners[0], corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) {
        place->shares[k] = (double)kiriOrient(corners[(k + 1) % 3], corners[(k + 2) % 3], at) / area;
    }
    return true;
}

static const int32_t* CornersOf(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    return sheet->mesh.triangles.data[place->triangle].vertex;
}

kiriVec3 kiriPoint_Position(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    kiriVec3 x = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3; ++k) {
        x = kiriVec3_AddScaled(x, place->shares[k], kiriSurface_At(&sheet->seen.surface, CornersOf(sheet, place)[k]));
    }
    return x;
}

static kiriVec3 AddCorner(const kiriSheetData* sheet, kiriVec3 sum, int32_t h)
{
    const kiriSurface* surface = &sheet->seen.surface;
    const int32_t* v = sheet->mesh.triangles.data[h / 3].vertex;
    kiriVec3 a = kiriSurface_At(surface, v[0]), b = kiriSurface_At(surface, v[1]), c = kiriSurface_At(surface, v[2]);
    return kiriVec3_Add(sum, kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(c, a)));
}

/* As kiriNormals_Write has it, to rounding, for those who may not write: from the fan of the vertex. */
static kiriVec3 VertexNormal(const kiriSheetData* sheet, int32_t vertex)
{
    const kiriSurface* surface = &sheet->seen.surface;
    if (surface->hasNormals) {
        return kiriVec3_Load(&surface->normals.data[3 * (size_t)vertex]);
    }
    int32_t start = sheet->mesh.vertices.data[vertex].edge, h = start;
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    do {
        sum = AddCorner(sheet, sum, h);
        h = kiriMesh_CounterClockwise(&sheet->mesh, h);
    } while (h != KIRI_NONE && h != start);
    if (h == KIRI_NONE) {
        for (h = kiriMesh_Clockwise(&sheet->mesh, start); h != KIRI_NONE; h = kiriMesh_Clockwise(&sheet->mesh, h)) {
            sum = AddCorner(sheet, sum, h);
        }
    }
    kiriVec3 unit = kiriVec3_Normalize(sum);
    return kiriVec3_Dot(unit, unit) > 0.0 ? unit : kiriVec3_Make(0.0, 0.0, 1.0);
}

/* The corner next to it. */
static int32_t HeaviestCorner(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    int best = 0;
    for (int k = 1; k < 3; ++k) {
        best = place->shares[k] > place->shares[best] ? k : best;
    }
    return CornersOf(sheet, place)[best];
}

/* Where the normals of the corners cancel out, that of the triangle; where that has no area, that of one corner. */
kiriVec3 kiriPoint_Normal(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    const int32_t* corners = CornersOf(sheet, place);
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3; ++k) {
        sum = kiriVec3_AddScaled(sum, place->shares[k], VertexNormal(sheet, corners[k]));
    }
    if (kiriVec3_Length(sum) < 1e-3) {
        const kiriSurface* surface = &sheet->seen.surface;
        kiriVec3 a = kiriSurface_At(surface, corners[0]), b = kiriSurface_At(surface, corners[1]);
        sum = kiriVec3_Cross(kiriVec3_Sub(b, a), kiriVec3_Sub(kiriSurface_At(surface, corners[2]), a));
    }
    kiriVec3 unit = kiriVec3_Normalize(sum);
    return kiriVec3_Dot(unit, unit) > 0.5 ? unit : VertexNormal(sheet, HeaviestCorner(sheet, place));
}

/* As the mesh has it: at the corners the frames are blended, between them the corners. */
kiriMotion kiriPoint_Blend(const kiriSheetData* sheet, const kiriPointPlace* place)
{
    kiriMotion motion;
    memset(&motion, 0, sizeof(motion));
    for (int k = 0; k < 3; ++k) {
        int32_t corner = CornersOf(sheet, place)[k];
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->mesh.vertices.data[corner].at);
        kiriSpan span = sheet->vertexSkin.spans.data[corner];
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
            const kiriFrameData* frame = &sheet->frames.data[kiriSheet_FrameOf(sheet, weight.label)];
            double share = place->shares[k] * weight.value;
            motion.x = kiriVec3_AddScaled(motion.x, share, kiriFrame_Carry(frame, local));
            motion.velocity = kiriVec3_AddScaled(motion.velocity, share, kiriFrame_VelocityAt(frame, local));
        }
    }
    return motion;
}
