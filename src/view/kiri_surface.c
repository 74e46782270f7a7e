#include "kiri_surface.h"

#include <string.h>

bool kiriSurface_Resize(kiriSurface* surface, kiriMemory* memory, const kiriMeshData* mesh, int32_t frameCount)
{
    int64_t vertices = mesh->vertices.count, triangles = mesh->triangles.count;
    return kiriArray_Resize(memory, &surface->positions, 3 * vertices) &&
           kiriArray_Resize(memory, &surface->normals, 3 * vertices) &&
           kiriArray_Resize(memory, &surface->restPositions, 2 * vertices) &&
           kiriArray_Resize(memory, &surface->sourceWeights, 3 * vertices) &&
           kiriArray_Resize(memory, &surface->sourceTriangles, vertices) &&
           kiriArray_Resize(memory, &surface->indices, 3 * triangles) &&
           kiriArray_Resize(memory, &surface->rest, vertices) && kiriArray_Resize(memory, &surface->exact, vertices) &&
           kiriArray_Resize(memory, &surface->slopes, vertices) &&
           kiriArray_Resize(memory, &surface->corners, 3 * (triangles + triangles % 2)) &&
           kiriArray_Resize(memory, &surface->carriers, frameCount) &&
           kiriArray_Resize(memory, &surface->bends, frameCount);
}

/* ---- Topology ---- */

static void WriteNewVertex(kiriSurface* surface, const kiriMeshData* mesh, int32_t v)
{
    kiriVec2 local = kiriMesh_Local(mesh, mesh->vertices.data[v].at), rest = kiriVec2_Add(mesh->origin, local);
    surface->rest.data[v] = local;
    surface->restPositions.data[2 * (size_t)v] = (float)rest.x;
    surface->restPositions.data[2 * (size_t)v + 1] = (float)rest.y;
}

static void WriteSource(kiriSurface* surface, const kiriMeshData* mesh, int32_t v)
{
    const kiriVertex* vertex = &mesh->vertices.data[v];
    surface->sourceTriangles.data[v] = vertex->source;
    memcpy(&surface->sourceWeights.data[3 * (size_t)v], vertex->share, sizeof(vertex->share));
}

/* Shared edges are the last of the first and the first of the second triangle, so that WriteNormals reads four corners
   instead of six. A triangle alone is followed by one without area. */
static void WriteCorners(kiriSurface* surface, int32_t pair)
{
    const int32_t* a = &surface->indices.data[6 * (size_t)pair];
    const int32_t* b = a + 3;
    int32_t* corners = &surface->corners.data[6 * (size_t)pair];
    if (2 * pair + 1 == surface->triangleCount) {
        const int32_t alone[6] = { a[0], a[1], a[2], a[0], a[0], a[0] };
        memcpy(corners, alone, sizeof(alone));
        return;
    }
    memcpy(corners, a, 6 * sizeof(int32_t));
    for (int i = 0; i < 9; ++i) {
        int j = i / 3, k = i % 3;
        if (a[j] == b[(k + 1) % 3] && a[(j + 1) % 3] == b[k]) {
            const int32_t turned[6] = { a[(j + 1) % 3], a[(j + 2) % 3], a[j], b[k], b[(k + 1) % 3], b[(k + 2) % 3] };
            memcpy(corners, turned, sizeof(turned));
            return;
        }
    }
}

static void Extend(kiriRange* range, int32_t index)
{
    int32_t low = range->count == 0 || index < range->first ? index : range->first;
    int32_t end = range->count == 0 || index >= range->first + range->count ? index + 1 : range->first + range->count;
    range->first = low;
    range->count = end - low;
}

/* Vertices never move in the rest plane, but a tear may give one to another triangle of the caller. */
static void WriteOldVertices(kiriSurface* surface, const kiriMeshData* mesh, kiriChange* change)
{
    for (int32_t i = 0; i < mesh->savedVertices.count; ++i) {
        const kiriSavedVertex* saved = &mesh->savedVertices.data[i];
        const kiriVertex* vertex = &mesh->vertices.data[saved->index];
        if (saved->index < change->oldVertexCount &&
            (vertex->source != saved->was.source ||
             memcmp(vertex->share, saved->was.share, sizeof(vertex->share)) != 0)) {
            WriteSource(surface, mesh, saved->index);
            Extend(&change->vertices, saved->index);
        }
    }
}

static void WriteTriangle(kiriSurface* surface, const kiriMeshData* mesh, int32_t t)
{
    memcpy(&surface->indices.data[3 * (size_t)t], mesh->triangles.data[t].vertex, 3 * sizeof(int32_t));
}

/* The journal has more triangles than change: those with another neighbour. */
static void WriteOldTriangles(kiriSurface* surface, const kiriMeshData* mesh, kiriChange* change)
{
    for (int32_t i = 0; i < mesh->savedTriangles.count; ++i) {
        const kiriSavedTriangle* saved = &mesh->savedTriangles.data[i];
        const int32_t* vertex = mesh->triangles.data[saved->index].vertex;
        if (saved->index < change->oldTriangleCount &&
            memcmp(vertex, saved->was.vertex, sizeof(saved->was.vertex)) != 0) {
            WriteTriangle(surface, mesh, saved->index);
            Extend(&change->triangles, saved->index);
        }
    }
    /* When all of them are written: two that share an edge may both change. */
    for (int32_t i = 0; i < mesh->savedTriangles.count; ++i) {
        if (mesh->savedTriangles.data[i].index < change->oldTriangleCount) {
            WriteCorners(surface, mesh->savedTriangles.data[i].index / 2);
        }
    }
}

void kiriSurface_WriteTopology(kiriSurface* surface, const kiriMeshData* mesh)
{
    kiriChange change;
    memset(&change, 0, sizeof(change));
    change.from = surface->revision;
    change.to = mesh->revision;
    change.oldVertexCount = surface->vertexCount;
    change.oldTriangleCount = surface->triangleCount;
    surface->origin = mesh->origin;
    surface->pose += 1;
    surface->revision = mesh->revision;
    surface->vertexCount = mesh->vertices.count;
    surface->triangleCount = mesh->triangles.count;
    for (int32_t v = change.oldVertexCount; v < surface->vertexCount; ++v) {
        WriteNewVertex(surface, mesh, v);
        WriteSource(surface, mesh, v);
    }
    for (int32_t t = change.oldTriangleCount; t < surface->triangleCount; ++t) {
        WriteTriangle(surface, mesh, t);
    }
    WriteOldVertices(surface, mesh, &change);
    WriteOldTriangles(surface, mesh, &change);
    for (int32_t pair = change.oldTriangleCount / 2; 2 * pair < surface->triangleCount; ++pair) {
        WriteCorners(surface, pair);
    }
    if (change.oldVertexCount > 0 && change.from != change.to) {
        surface->lastChange = (surface->lastChange + 1) % KIRI_CHANGES;
        surface->changes[surface->lastChange] = change;
        surface->changeCount += surface->changeCount < KIRI_CHANGES ? 1 : 0;
    }
}

static kiriRange RangeFrom(int32_t first, int32_t end)
{
    kiriRange range = { first, end - first };
    return range;
}

/* Adds the part of `more` that is below `end`: from there on all is new. */
static void Unite(kiriRange* range, kiriRange more, int32_t end)
{
    if (more.count > 0 && more.first < end) {
        int32_t last = more.first + more.count - 1;
        Extend(range, more.first);
        Extend(range, last < end ? last : end - 1);
    }
}

void kiriSurface_GetDirty(const kiriSurface* surface, uint32_t sinceRevision, kiriDirty* dirty)
{
    memset(dirty, 0, sizeof(*dirty));
    dirty->revision = surface->revision;
    int32_t back = 0, vertices = surface->vertexCount, triangles = surface->triangleCount;
    uint32_t at = surface->revision;
    while (at != sinceRevision && back < surface->changeCount) {
        const kiriChange* change = &surface->changes[(surface->lastChange + KIRI_CHANGES - back) % KIRI_CHANGES];
        at = change->from;
        vertices = change->oldVertexCount;
        triangles = change->oldTriangleCount;
        ++back;
    }
    if (at != sinceRevision) {
        dirty->newVertices = RangeFrom(0, surface->vertexCount);
        dirty->newTriangles = RangeFrom(0, surface->triangleCount);
        return;
    }
    dirty->newVertices = RangeFrom(vertices, surface->vertexCount);
    dirty->newTriangles = RangeFrom(triangles, surface->triangleCount);
    for (int32_t i = 0; i < back; ++i) {
        const kiriChange* change = &surface->changes[(surface->lastChange + KIRI_CHANGES - i) % KIRI_CHANGES];
        Unite(&dirty->oldVertices, change->vertices, vertices);
        Unite(&dirty->oldTriangles, change->triangles, triangles);
    }
}

/* ---- What is not seen ---- */

bool kiriSurface_RenewIndices(kiriSurface* surface, kiriMemory* memory, kiriMemory* retired)
{
    kiriIndices fresh = { NULL, 0, 0 };
    kiriArrayHeader was = kiriArray_GetHeader(&surface->indices);
    if (!kiriArray_Resize(memory, &fresh, was.count)) {
        return false;
    }
    memcpy(fresh.data, was.data, sizeof(int32_t) * (size_t)was.count);
    kiriArray_SetHeader(&surface->indices, kiriArray_GetHeader(&fresh));
    kiriMemory_Adopt(retired, was.data);
    return true;
}

void kiriSurface_HideTriangle(kiriSurface* surface, int32_t triangle)
{
    int32_t* corners = &surface->indices.data[3 * (size_t)triangle];
    corners[1] = corners[2] = corners[0];
    WriteCorners(surface, triangle / 2);
}

/* ---- What is left ---- */

bool kiriShown_Reserve(kiriShown* shown, kiriMemory* memory, const kiriKeep* triangles, const kiriKeep* vertices)
{
    int64_t vertexCount = vertices->count, triangleCount = triangles->count;
    memset(shown, 0, sizeof(*shown));
    return kiriArray_Reserve(memory, &shown->positions, 3 * vertexCount) &&
           kiriArray_Reserve(memory, &shown->normals, 3 * vertexCount) &&
           kiriArray_Reserve(memory, &shown->restPositions, 2 * vertexCount) &&
           kiriArray_Reserve(memory, &shown->sourceWeights, 3 * vertexCount) &&
           kiriArray_Reserve(memory, &shown->sourceTriangles, vertexCount) &&
           kiriArray_Reserve(memory, &shown->indices, 3 * triangleCount);
}

void kiriShown_Release(kiriShown* shown, kiriMemory* memory)
{
    kiriArray_Release(memory, &shown->positions);
    kiriArray_Release(memory, &shown->normals);
    kiriArray_Release(memory, &shown->restPositions);
    kiriArray_Release(memory, &shown->sourceWeights);
    kiriArray_Release(memory, &shown->sourceTriangles);
    kiriArray_Release(memory, &shown->indices);
}

/* The array, with `each` entries of 4 bytes an item, becomes `fresh` with what is kept. */
static void TakeKept(const kiriKeep* keep, void* array, const void* fresh, int32_t each, kiriMemory* retired)
{
    kiriArrayHeader was = kiriArray_GetHeader(array), is = kiriArray_GetHeader(fresh);
    kiriKeep_Copy(keep, is.data, was.data, 4 * (size_t)each);
    is.count = each * keep->count;
    kiriArray_SetHeader(array, is);
    kiriMemory_Adopt(retired, was.data);
}

static void RenumberIndices(kiriSurface* surface, const kiriMeshData* mesh)
{
    for (int32_t t = 0; t < surface->triangleCount; ++t) {
        WriteTriangle(surface, mesh, t);
    }
    surface->corners.count = 3 * (surface->triangleCount + surface->triangleCount % 2);
    for (int32_t pair = 0; 2 * pair < surface->triangleCount; ++pair) {
        WriteCorners(surface, pair);
    }
}

void kiriSurface_Keep(kiriSurface* surface, kiriShown* shown, const kiriKeep* triangles, const kiriKeep* vertices,
                      const kiriMeshData* mesh, int32_t frameCount, kiriMemory* retired)
{
    TakeKept(vertices, &surface->positions, &shown->positions, 3, retired);
    TakeKept(vertices, &surface->normals, &shown->normals, 3, retired);
    TakeKept(vertices, &surface->restPositions, &shown->restPositions, 2, retired);
    TakeKept(vertices, &surface->sourceWeights, &shown->sourceWeights, 3, retired);
    TakeKept(vertices, &surface->sourceTriangles, &shown->sourceTriangles, 1, retired);
    TakeKept(triangles, &surface->indices, &shown->indices, 3, retired);
    kiriKeep_Compact(vertices, &surface->rest, 1, sizeof(kiriVec2));
    kiriKeep_Compact(vertices, &surface->exact, 1, sizeof(kiriVec3));
    kiriKeep_Compact(vertices, &surface->slopes, 1, sizeof(kiriVec3));
    surface->carriers.count = surface->bends.count = frameCount;
    surface->vertexCount = vertices->count;
    surface->triangleCount = triangles->count;
    surface->revision = mesh->revision;
    surface->changeCount = 0;
    surface->pose += 1;
    RenumberIndices(surface, mesh);
}

/* ---- Copies ---- */

static void CopyStrided(const float* from, int32_t count, void* to, int32_t stride)
{
    for (int32_t i = 0; to != NULL && i < count; ++i) {
        memcpy((char*)to + (int64_t)i * stride, from + 3 * (int64_t)i, 3 * sizeof(float));
    }
}

void kiriSurface_CopyVertices(const kiriSurface* surface, int32_t first, int32_t count, void* positions,
                              int32_t positionStride, void* normals, int32_t normalStride)
{
    if (count > 0) {
        CopyStrided(surface->positions.data + 3 * (int64_t)first, count, positions, positionStride);
        CopyStrided(surface->normals.data + 3 * (int64_t)first, count, normals, normalStride);
    }
}

bool kiriSurface_CopyIndices16(const kiriSurface* surface, int32_t firstTriangle, int32_t count, uint16_t* indices)
{
    if (surface->vertexCount > UINT16_MAX) {
        return false;
    }
    for (int64_t i = 0; i < 3 * (int64_t)count; ++i) {
        indices[i] = (uint16_t)surface->indices.data[3 * (int64_t)firstTriangle + i];
    }
    return true;
}

/* ---- Curvature ----

   In a flat patch the surface bulges: half-way between two frames that stand at an angle t on a cylinder of radius R,
   both patches are R t^2 / 8 outside. So the patch of a frame follows the arc that its neighbours' directors tell. Be K
   the curvature, g = K q and f^2 = g . g: the patch goes from q to q sin f / f in the plane, and up by
   q . g (1 - cos f) / f^2. That is exact for one direction of bending, which is what thin sheets have, and right to the
   second order elsewhere.

   A frame that stretches by s has arcs s times as long for the same angles: K and six, divided by s^2, say so. */

/* The angle, of which this is the cosine, over its sine: Pade's [4/4] of the half-angle's arc tangent, 0.7 % off at 120
   degrees. Never above 8: frames back to back tell nothing. */
static double AngleOverSine(double cosine)
{
    double lower = 1.0 + cosine > 0.1 ? 1.0 + cosine : 0.1, x = (2.0 - lower) / lower;
    double angle = (945.0 + x * (735.0 + 64.0 * x)) / (945.0 + x * (1050.0 + 225.0 * x));
    return angle * (1.0 + x);
}

/* How the director of `other` leans, seen from a frame, where it is s away. */
static void AddDirectorTurn(kiriBend* bend, const kiriCarrier* carrier, kiriVec3 other, kiriVec2 s, double weight)
{
    double k = -weight * AngleOverSine(kiriVec3_Dot(carrier->d, other));
    double tu = k * kiriVec3_Dot(carrier->u, other), tv = k * kiriVec3_Dot(carrier->v, other);
    bend->uu += weight * s.x * s.x;
    bend->uv += weight * s.x * s.y;
    bend->vv += weight * s.y * s.y;
    bend->ruu += s.x * tu;
    bend->ruv += s.y * tu + s.x * tv;
    bend->rvv += s.y * tv;
}

/* The symmetric K that best takes each way s to its lean; where the neighbours, all in a row, leave it open, the least.
   That share, a thousandth, also says how far K may follow the noise across a row. */
static void Curve(kiriCarrier* carrier, const kiriBend* bend)
{
    double least = 1e-3 * (bend->uu + bend->vv), m = bend->uv;
    double a = bend->uu + least, c = bend->vv + least, b = bend->uu + bend->vv + 2.0 * least;
    double det = a * (b * c - m * m) - m * m * c;
    double square = kiriVec3_Length(kiriVec3_Cross(carrier->u, carrier->v));
    if (!(det > 0.0 && square > 0.0)) {
        return;
    }
    double scale = 1.0 / (square * det);
    carrier->six = 6.0 / square;
    carrier->uu = scale * ((b * c - m * m) * bend->ruu - m * c * bend->ruv + m * m * bend->rvv);
    carrier->uv = scale * (-m * c * bend->ruu + a * c * bend->ruv - a * m * bend->rvv);
    carrier->vv = scale * (m * m * bend->ruu - a * m * bend->ruv + (a * b - m * m) * bend->rvv);
}

/* rad: rms of the angle by which a patch may turn over its region. On an arc that is 40 degrees from frame to frame. */
static const double mostTurn = 0.2;

/* Where neighbours turn farther, they do not tell how the region bends: there are creases, narrow bridges, and neighbours
   on both sides of a slit that bend apart. A patch that is less bent is strained less there. */
static void LimitCurve(kiriCarrier* carrier, const kiriFrameData* frame)
{
    double uu = carrier->uu, uv = carrier->uv, vv = carrier->vv;
    const double* m = frame->inertia;
    double square = (uu * uu + uv * uv) * m[0] + 2.0 * uv * (uu + vv) * m[1] + (uv * uv + vv * vv) * m[2];
    double turn = frame->mass > 0.0 && square > 0.0 ? sqrt(6.0 * square / (carrier->six * frame->mass)) : 0.0;
    if (turn > mostTurn) {
        carrier->uu *= mostTurn / turn;
        carrier->uv *= mostTurn / turn;
        carrier->vv *= mostTurn / turn;
    }
}

/* From center to center along the link. */
static kiriVec2 CentreToCentre(const kiriFrameData* frames, const kiriLink* link)
{
    kiriVec2 start = kiriVec2_Sub(frames[link->i].site.at, frames[link->i].center);
    kiriVec2 end = kiriVec2_Sub(frames[link->j].center, frames[link->j].site.at);
    return kiriVec2_Add(kiriVec2_Add(start, link->span), end);
}

static void BendCarriers(kiriSurface* surface, const kiriFrameData* frames, int32_t frameCount, const kiriLink* links,
                         int32_t linkCount)
{
    memset(surface->bends.data, 0, sizeof(kiriBend) * (size_t)frameCount);
    for (int32_t k = 0; k < linkCount; ++k) {
        const kiriLink* link = &links[k];
        kiriCarrier *i = &surface->carriers.data[link->i], *j = &surface->carriers.data[link->j];
        kiriVec2 way = CentreToCentre(frames, link);
        AddDirectorTurn(&surface->bends.data[link->i], i, j->d, way, link->width);
        AddDirectorTurn(&surface->bends.data[link->j], j, i->d, kiriVec2_Scale(-1.0, way), link->width);
    }
    for (int32_t i = 0; i < frameCount; ++i) {
        Curve(&surface->carriers.data[i], &surface->bends.data[i]);
        LimitCurve(&surface->carriers.data[i], &frames[i]);
    }
}

/* ---- Positions ---- */

static void WriteCarriers(kiriSurface* surface, const kiriFrameData* frames, int32_t frameCount)
{
    memset(surface->carriers.data, 0, sizeof(kiriCarrier) * (size_t)frameCount);
    for (int32_t i = 0; i < frameCount; ++i) {
        kiriCarrier* carrier = &surface->carriers.data[i];
        carrier->u = frames[i].A.u;
        carrier->v = frames[i].A.v;
        carrier->x = frames[i].x;
        carrier->center = frames[i].center;
        carrier->six = 6.0;
        carrier->origin = kiriFrame_Carry(&frames[i], kiriVec2_Make(0.0, 0.0));
        carrier->d = kiriVec3_Normalize(kiriVec3_Cross(carrier->u, carrier->v));
    }
}

static kiriVec3 BlendFlat(const kiriCarrier* carriers, const kiriWeight* weights, int32_t count, kiriVec2 p)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < count; ++i) {
        const kiriCarrier* c = &carriers[weights[i].frame];
        double w = weights[i].value;
        sum.x += w * (c->origin.x + p.x * c->u.x + p.y * c->v.x);
        sum.y += w * (c->origin.y + p.x * c->u.y + p.y * c->v.y);
        sum.z += w * (c->origin.z + p.x * c->u.z + p.y * c->v.z);
    }
    return sum;
}

/* sin f / f and (1 - cos f) / f^2 as fractions over 12 + f^2: one thousandth off at 40 degrees, and however strongly
   bent never farther from the center than twice q. */
static kiriVec3 BlendBent(const kiriCarrier* carriers, const kiriWeight* weights, int32_t count, kiriVec2 p)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < count; ++i) {
        const kiriCarrier* k = &carriers[weights[i].frame];
        double w = weights[i].value, qu = p.x - k->center.x, qv = p.y - k->center.y;
        double gu = k->uu * qu + k->uv * qv, gv = k->uv * qu + k->vv * qv;
        double bow = (gu * qu + gv * qv) / (k->six + 0.5 * (gu * gu + gv * gv));
        double a = qu - bow * gu, b = qv - bow * gv, c = 3.0 * bow;
        sum.x += w * (k->x.x + a * k->u.x + b * k->v.x + c * k->d.x);
        sum.y += w * (k->x.y + a * k->u.y + b * k->v.y + c * k->d.y);
        sum.z += w * (k->x.z + a * k->u.z + b * k->v.z + c * k->d.z);
    }
    return sum;
}

/* Loops of their own, for speed. */
static void BlendAll(kiriSurface* surface, const kiriSkin* skin, bool isBent)
{
    const kiriCarrier* carriers = surface->carriers.data;
    const kiriWeight* weights = skin->weights.data;
    const kiriVec2* rest = surface->rest.data;
    for (int32_t v = 0; !isBent && v < surface->vertexCount; ++v) {
        kiriSpan span = skin->spans.data[v];
        surface->exact.data[v] = BlendFlat(carriers, weights + span.first, span.count, rest[v]);
    }
    for (int32_t v = 0; isBent && v < surface->vertexCount; ++v) {
        kiriSpan span = skin->spans.data[v];
        surface->exact.data[v] = BlendBent(carriers, weights + span.first, span.count, rest[v]);
    }
}

/* ---- Normals ---- */

static void AddInPlace(kiriVec3* sum, kiriVec3 a)
{
    sum->x += a.x;
    sum->y += a.y;
    sum->z += a.z;
}

/* The cross product of two sides is twice the area times the normal: sums are area-weighted. Where two triangles share
   an edge, their corners on it get one sum from both. */
static void SumSlopes(kiriSurface* surface)
{
    const kiriVec3* x = surface->exact.data;
    kiriVec3* sums = surface->slopes.data;
    memset(sums, 0, sizeof(kiriVec3) * (size_t)surface->vertexCount);
    for (int32_t t = 0; t < surface->triangleCount; t += 2) {
        const int32_t* v = &surface->corners.data[3 * (size_t)t];
        kiriVec3 ab = kiriVec3_Sub(x[v[1]], x[v[0]]), ac = kiriVec3_Sub(x[v[2]], x[v[0]]);
        kiriVec3 first = kiriVec3_Cross(ab, ac);
        AddInPlace(&sums[v[1]], first);
        if (v[0] == v[3] && v[2] == v[4]) {
            kiriVec3 second = kiriVec3_Cross(ac, kiriVec3_Sub(x[v[5]], x[v[0]])), both = kiriVec3_Add(first, second);
            AddInPlace(&sums[v[5]], second);
            AddInPlace(&sums[v[0]], both);
            AddInPlace(&sums[v[2]], both);
        } else {
            kiriVec3 de = kiriVec3_Sub(x[v[4]], x[v[3]]), df = kiriVec3_Sub(x[v[5]], x[v[3]]);
            kiriVec3 second = kiriVec3_Cross(de, df);
            AddInPlace(&sums[v[0]], first);
            AddInPlace(&sums[v[2]], first);
            AddInPlace(&sums[v[3]], second);
            AddInPlace(&sums[v[4]], second);
            AddInPlace(&sums[v[5]], second);
        }
    }
}

/* What the host reads. Normals in floats where the squared length has a place there: twice as fast. A length that fits a float may have a square
   that does not. */
static void StoreAll(kiriSurface* surface)
{
    for (int32_t v = 0; v < surface->vertexCount; ++v) {
        kiriVec3_Store(&surface->positions.data[3 * (size_t)v], surface->exact.data[v]);
        kiriVec3 slope = surface->slopes.data[v];
        float* normal = &surface->normals.data[3 * (size_t)v];
        double square = kiriVec3_Dot(slope, slope);
        if (square > 1e-30 && square < 1e30) {
            float scale = 1.0f / sqrtf((float)square);
            normal[0] = scale * (float)slope.x;
            normal[1] = scale * (float)slope.y;
            normal[2] = scale * (float)slope.z;
        } else {
            kiriVec3 unit = kiriVec3_Normalize(slope);
            bool known = kiriVec3_Dot(unit, unit) > 0.0;
            kiriVec3_Store(normal, known ? unit : kiriVec3_Make(0.0, 0.0, 1.0));
        }
    }
}

void kiriSurface_Blend(kiriSurface* surface, const kiriSkin* skin, const kiriFrameData* frames, int32_t frameCount,
                       const kiriLink* links, int32_t linkCount)
{
    bool isBent = surface->skinning == KIRI_SKINNING_SMOOTH && linkCount > 0;
    WriteCarriers(surface, frames, frameCount);
    if (isBent) {
        BendCarriers(surface, frames, frameCount, links, linkCount);
    }
    BlendAll(surface, skin, isBent);
}

void kiriSurface_AddFades(kiriSurface* surface, const kiriFades* fades)
{
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        kiriFading fading = fades->fading.data[k];
        kiriVec3* exact = &surface->exact.data[fading.sample];
        *exact = kiriVec3_Add(*exact, fading.offset);
    }
}

void kiriSurface_WriteArrays(kiriSurface* surface)
{
    surface->pose += 1;
    SumSlopes(surface);
    StoreAll(surface);
}
