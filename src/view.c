#include "view.h"

#include <string.h>

bool kiriView_Resize(kiriSheetData* sheet, int32_t pointCount)
{
    const kiriMemory* memory = sheet->memory;
    int64_t vertices = sheet->mesh.vertices.count, triangles = sheet->mesh.triangles.count;
    return kiriArray_Resize(memory, &sheet->positions, 3 * vertices) &&
           kiriArray_Resize(memory, &sheet->normals, 3 * vertices) &&
           kiriArray_Resize(memory, &sheet->exact, vertices) && kiriArray_Resize(memory, &sheet->slopes, vertices) &&
           kiriArray_Resize(memory, &sheet->restPositions, 2 * vertices) &&
           kiriArray_Resize(memory, &sheet->sourceTriangles, vertices) &&
           kiriArray_Resize(memory, &sheet->sourceWeights, 3 * vertices) &&
           kiriArray_Resize(memory, &sheet->indices, 3 * triangles) &&
           kiriArray_Resize(memory, &sheet->pointPositions, 3 * (int64_t)pointCount);
}

void kiriView_Release(kiriSheetData* sheet)
{
    kiriArray_Release(sheet->memory, &sheet->positions);
    kiriArray_Release(sheet->memory, &sheet->normals);
    kiriArray_Release(sheet->memory, &sheet->exact);
    kiriArray_Release(sheet->memory, &sheet->slopes);
    kiriArray_Release(sheet->memory, &sheet->restPositions);
    kiriArray_Release(sheet->memory, &sheet->sourceTriangles);
    kiriArray_Release(sheet->memory, &sheet->sourceWeights);
    kiriArray_Release(sheet->memory, &sheet->indices);
    kiriArray_Release(sheet->memory, &sheet->pointPositions);
}

void kiriView_WriteTopology(kiriSheetData* sheet)
{
    const kiriMeshData* mesh = &sheet->mesh;
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        kiriVec2 rest = kiriVec2_Add(mesh->origin, kiriMesh_Local(mesh, vertex->at));
        sheet->restPositions.data[2 * v] = (float)rest.x;
        sheet->restPositions.data[2 * v + 1] = (float)rest.y;
        sheet->sourceTriangles.data[v] = vertex->source;
        memcpy(&sheet->sourceWeights.data[3 * v], vertex->share, sizeof(vertex->share));
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        memcpy(&sheet->indices.data[3 * t], mesh->triangles.data[t].vertex, sizeof(mesh->triangles.data[t].vertex));
    }
}

/* Not the floats that the host reads: far from the origin they tell the corners of a triangle no more apart. */
static kiriVec3 Position(const kiriSheetData* sheet, int32_t vertex)
{
    return sheet->exact.data[vertex];
}

/* Area-weighted: the cross product of two sides is twice the area times the normal. Summed in doubles, for a length
   that fits a float may have a square that does not. */
static void WriteNormals(kiriSheetData* sheet)
{
    const kiriMeshData* mesh = &sheet->mesh;
    memset(sheet->slopes.data, 0, sizeof(kiriVec3) * (size_t)mesh->vertices.count);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const int32_t* vertex = mesh->triangles.data[t].vertex;
        kiriVec3 a = Position(sheet, vertex[0]);
        kiriVec3 normal =
            kiriVec3_Cross(kiriVec3_Sub(Position(sheet, vertex[1]), a), kiriVec3_Sub(Position(sheet, vertex[2]), a));
        for (int k = 0; k < 3; ++k) {
            kiriVec3* sum = &sheet->slopes.data[vertex[k]];
            *sum = kiriVec3_Add(*sum, normal);
        }
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriVec3 unit = kiriVec3_Normalize(sheet->slopes.data[v]);
        bool known = kiriVec3_Dot(unit, unit) > 0.0;
        kiriVec3_Store(&sheet->normals.data[3 * v], known ? unit : kiriVec3_Make(0.0, 0.0, 1.0));
    }
}

void kiriView_WritePositions(kiriSheetData* sheet)
{
    const kiriModel* model = &sheet->model;
    for (int32_t v = 0; v < sheet->mesh.vertices.count; ++v) {
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->mesh.vertices.data[v].at);
        sheet->exact.data[v] = kiriSkin_Position(&model->vertexSkin, v, sheet->frames.data, local);
        kiriVec3_Store(&sheet->positions.data[3 * v], sheet->exact.data[v]);
    }
    for (int32_t i = 0; i < model->points.count; ++i) {
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, model->points.data[i].at);
        kiriVec3_Store(&sheet->pointPositions.data[3 * i],
                       kiriSkin_Position(&model->pointSkin, i, sheet->frames.data, local));
    }
    WriteNormals(sheet);
}

/* ---- Rays ---- */

typedef struct Barycentric {
    double distance, b, c; /* along the ray; shares of the second and third corner */
} Barycentric;

/* Where a ray meets a triangle (Moeller and Trumbore 1997). */
static bool MeetTriangle(const kiriVec3 corner[3], kiriVec3 origin, kiriVec3 direction, Barycentric* at)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec3 p = kiriVec3_Cross(direction, ac);
    double determinant = kiriVec3_Dot(ab, p);
    if (determinant == 0.0) {
        return false;
    }
    kiriVec3 s = kiriVec3_Sub(origin, corner[0]), q = kiriVec3_Cross(s, ab);
    at->b = kiriVec3_Dot(s, p) / determinant;
    at->c = kiriVec3_Dot(direction, q) / determinant;
    at->distance = kiriVec3_Dot(ac, q) / determinant;
    return at->b >= 0.0 && at->c >= 0.0 && at->b + at->c <= 1.0;
}

static void WorldCorners(const kiriSheetData* sheet, int32_t triangle, kiriVec3 corner[3])
{
    for (int k = 0; k < 3; ++k) {
        corner[k] = Position(sheet, sheet->mesh.triangles.data[triangle].vertex[k]);
    }
}

static kiriVec2 RestPoint(const kiriSheetData* sheet, int32_t triangle, double b, double c)
{
    kiriPoint corner[3];
    kiriMesh_Corners(&sheet->mesh, triangle, corner);
    kiriVec2 p = kiriVec2_Scale(1.0 - b - c, kiriMesh_Local(&sheet->mesh, corner[0]));
    p = kiriVec2_Add(p, kiriVec2_Scale(b, kiriMesh_Local(&sheet->mesh, corner[1])));
    return kiriVec2_Add(p, kiriVec2_Scale(c, kiriMesh_Local(&sheet->mesh, corner[2])));
}

static void WriteHit(const kiriSheetData* sheet, int32_t triangle, const kiriVec3 corner[3], Barycentric at,
                     kiriHit* hit)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, RestPoint(sheet, triangle, at.b, at.c));
    hit->restPoint[0] = (float)rest.x;
    hit->restPoint[1] = (float)rest.y;
    kiriVec3_Store(hit->position, kiriVec3_AddScaled(kiriVec3_AddScaled(corner[0], at.b, ab), at.c, ac));
    kiriVec3_Store(hit->normal, kiriVec3_Normalize(kiriVec3_Cross(ab, ac)));
    hit->distance = (float)at.distance;
    hit->triangle = triangle;
}

void kiriView_Raycast(const kiriSheetData* sheet, kiriVec3 origin, kiriVec3 direction, double maxDistance, kiriHit* hit)
{
    memset(hit, 0, sizeof(*hit));
    hit->triangle = KIRI_NONE;
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        kiriVec3 corner[3];
        Barycentric at;
        WorldCorners(sheet, t, corner);
        if (MeetTriangle(corner, origin, direction, &at) && at.distance >= 0.0 && at.distance <= maxDistance) {
            maxDistance = at.distance;
            WriteHit(sheet, t, corner, at, hit);
        }
    }
}

/* ---- Blades ---- */

/* Where the segment p-q meets the triangle, as a share of the segment. */
static bool MeetSegment(const kiriVec3 corner[3], kiriVec3 p, kiriVec3 q, Barycentric* at)
{
    return MeetTriangle(corner, p, kiriVec3_Sub(q, p), at) && at->distance >= 0.0 && at->distance <= 1.0;
}

/* Adds the points in which a mesh triangle meets a blade triangle: sides of the one through the other, both ways. In
   general there are two. */
static int32_t MeetTriangles(const kiriSheetData* sheet, int32_t triangle, const kiriVec3 corner[3],
                             const kiriVec3 blade[3], kiriVec2 points[6])
{
    int32_t count = 0;
    Barycentric at;
    static const double cornerB[3] = { 0.0, 1.0, 0.0 }, cornerC[3] = { 0.0, 0.0, 1.0 };
    for (int k = 0; k < 3; ++k) {
        int n = (k + 1) % 3;
        if (MeetSegment(blade, corner[k], corner[n], &at)) {
            double b = cornerB[k] + at.distance * (cornerB[n] - cornerB[k]);
            double c = cornerC[k] + at.distance * (cornerC[n] - cornerC[k]);
            points[count++] = RestPoint(sheet, triangle, b, c);
        }
        if (MeetSegment(corner, blade[k], blade[n], &at)) {
            points[count++] = RestPoint(sheet, triangle, at.b, at.c);
        }
    }
    return count;
}

/* The two points farthest apart, for a point on a shared corner is found more than once. */
static void Farthest(const kiriVec2* points, int32_t count, kiriVec2* from, kiriVec2* to)
{
    double best = -1.0;
    for (int32_t i = 0; i < count; ++i) {
        for (int32_t j = i + 1; j < count; ++j) {
            double length = kiriVec2_Length(kiriVec2_Sub(points[j], points[i]));
            if (length > best) {
                best = length;
                *from = points[i];
                *to = points[j];
            }
        }
    }
}

bool kiriView_Slice(const kiriSheetData* sheet, const kiriVec3 quad[4], kiriRestPoints* segments)
{
    const kiriVec3 blades[2][3] = { { quad[0], quad[1], quad[2] }, { quad[0], quad[2], quad[3] } };
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        kiriVec3 corner[3];
        WorldCorners(sheet, t, corner);
        for (int side = 0; side < 2; ++side) {
            kiriVec2 points[6], from, to;
            int32_t count = MeetTriangles(sheet, t, corner, blades[side], points);
            if (count < 2) {
                continue;
            }
            Farthest(points, count, &from, &to);
            if (!kiriArray_Push(sheet->memory, segments, from) || !kiriArray_Push(sheet->memory, segments, to)) {
                return false;
            }
        }
    }
    return true;
}
