#include "kiri_past.h"

static bool StartPast(kiriPast* to, const kiriPast* past, kiriMemory* memory, int32_t same, int32_t count)
{
    *to =
        (kiriPast){ past->tick, past->sheet, same, kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t)), count };
    return to->others != NULL;
}

bool kiriPast_Grow(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriMeshData* mesh, int32_t first)
{
    int32_t same = past->same < first ? past->same : first;
    if (!StartPast(to, past, memory, same, mesh->vertices.count - same)) {
        return false;
    }
    for (int32_t v = same; v < mesh->vertices.count; ++v) {
        const kiriBirth* birth = v < first ? NULL : &mesh->births.data[v - mesh->oldVertexCount];
        int32_t parent = birth != NULL && birth->parent[1] == KIRI_NONE ? birth->parent[0] : KIRI_NONE;
        if (birth == NULL) {
            to->others[v - same] = kiriPast_IndexOf(past, v);
        } else {
            KIRI_ASSERT(parent < v);
            to->others[v - same] = parent == KIRI_NONE ? KIRI_NONE : kiriPast_IndexOf(to, parent);
        }
    }
    return true;
}

bool kiriPast_Keep(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriKeep* vertices)
{
    int32_t same = past->same < vertices->first ? past->same : vertices->first;
    if (!StartPast(to, past, memory, same, vertices->count - same)) {
        return false;
    }
    for (int32_t v = same; v < vertices->to.count; ++v) {
        int32_t kept = kiriKeep_To(vertices, v);
        if (kept != KIRI_NONE) {
            to->others[kept - same] = kiriPast_IndexOf(past, v);
        }
    }
    return true;
}

bool kiriPast_Part(kiriPast* to, const kiriPast* past, kiriMemory* memory, kiriSheet sheet, const int32_t* vertices,
                   int32_t count)
{
    KIRI_ASSERT(past->sheet == 0); /* a part is one piece until the next tick: nothing leaves it before */
    if (!StartPast(to, past, memory, 0, count)) {
        return false;
    }
    to->sheet = sheet;
    for (int32_t k = 0; k < count; ++k) {
        to->others[k] = kiriPast_IndexOf(past, vertices[k]);
    }
    return true;
}
