#include "kiri_past.h"

bool kiriPast_Grow(kiriPast* past, int64_t tick, kiriIndices* room, kiriMemory* memory, const kiriMeshData* mesh,
                   int32_t first)
{
    const kiriPast was = kiriPast_At(past, tick); /* pieces may have left at the start of the tick */
    KIRI_ASSERT(first >= mesh->oldVertexCount && (was.count == 0 || was.others != room->data));
    int32_t same = kiriMin(was.same, first), count = mesh->vertices.count - same;
    if (!kiriArray_Resize(memory, room, count)) {
        return false;
    }
    *past = (kiriPast){ tick, was.sheet, same, room->data, count };
    for (int32_t v = same; v < first; ++v) {
        room->data[v - same] = kiriPast_IndexOf(&was, v);
    }
    for (int32_t v = first; v < mesh->vertices.count; ++v) {
        const kiriBirth* birth = &mesh->births.data[v - mesh->oldVertexCount];
        bool isTorn = birth->parent[1] == KIRI_NONE;
        KIRI_ASSERT(birth->parent[0] < v);
        room->data[v - same] = isTorn ? kiriPast_IndexOf(past, birth->parent[0]) : KIRI_NONE;
    }
    return true;
}

bool kiriPast_Keep(kiriPast* to, const kiriPast* past, kiriMemory* memory, const kiriKeep* vertices)
{
    int32_t same = kiriMin(past->same, vertices->first), count = vertices->count - same;
    int32_t* others = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    for (int32_t v = same; others != NULL && v < vertices->to.count; ++v) {
        int32_t kept = kiriKeep_To(vertices, v);
        if (kept != KIRI_NONE) {
            others[kept - same] = kiriPast_IndexOf(past, v);
        }
    }
    *to = (kiriPast){ past->tick, past->sheet, same, others, count };
    return others != NULL;
}

bool kiriPast_Part(kiriPast* to, const kiriPast* past, kiriMemory* memory, kiriSheet sheet, const int32_t* vertices,
                   int32_t count)
{
    KIRI_ASSERT(past->sheet == 0); /* a part is one piece until the next tick: nothing leaves it before */
    int32_t* others = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    for (int32_t k = 0; others != NULL && k < count; ++k) {
        others[k] = kiriPast_IndexOf(past, vertices[k]);
    }
    *to = (kiriPast){ past->tick, sheet, 0, others, count };
    return others != NULL;
}
