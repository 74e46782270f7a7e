#include "kiri_stages.h"

#include "kiri_seen.h"

/* Moves the blade of a cut to the next point of its polyline. */
static kiriProgress TakeQueuedPoint(kiriSheetData* sheet, const kiriQueuedPoint* point, kiriQuota* triangles)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriTip* tip = &point->cut->tip;
    kiriVec2 from = tip->last, to = point->to;
    if (point->jump || !kiriCut_Clip(mesh, &from, &to)) {
        tip->last = point->to;
        tip->blade = kiriCut_Place(mesh, point->to);
        return KIRI_DONE;
    }
    kiriLatticePoint start = kiriMesh_Snap(mesh, from);
    if (tip->blade.vertex == KIRI_NONE && (start.x != tip->blade.at.x || start.y != tip->blade.at.y)) {
        tip->blade = kiriCut_Place(mesh, from); /* it comes from far outside */
    }
    kiriProgress progress = kiriCut_Move(mesh, &tip->blade, kiriMesh_Snap(mesh, to), sheet->settings.snap, triangles);
    if (progress == KIRI_DONE) {
        tip->last = point->to;
    }
    return progress;
}

/* Takes queued points as far as the quota goes. Newborn vertices stay on the surface as it is. */
kiriProgress kiriStage_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles)
{
    kiriUpdate* u = sheet->update;
    kiriProgress progress = KIRI_DONE;
    kiriMesh_Begin(&sheet->mesh);
    while (progress == KIRI_DONE && u->cut.taken < u->cut.count) {
        progress = TakeQueuedPoint(sheet, &sheet->queue.data[u->cut.taken], triangles);
        u->cut.taken += progress == KIRI_DONE;
    }
    u->cut.meshChanged = u->cut.meshChanged || sheet->mesh.savedTriangles.count > 0;
    bool hasRoom = progress != KIRI_FAILED && kiriSkin_Inherit(&sheet->vertexSkin, sheet->memory, &sheet->mesh) &&
                   kiriView_Resize(sheet, sheet->frames.count, sheet->points.count);
    return hasRoom ? progress : KIRI_FAILED;
}

void kiriStage_CommitMesh(kiriSheetData* sheet)
{
    if (sheet->mesh.savedTriangles.count > 0) {
        sheet->lists.isFresh = false;
        kiriView_WriteTopology(sheet);
    }
    kiriMesh_Commit(&sheet->mesh);
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->committed = sheet->cuts.data[i]->tip;
    }
}
