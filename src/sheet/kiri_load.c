#include "kiri_load.h"

void kiriLoad_AtPoint(kiriSheetData* sheet, int32_t frame, kiriVec2 at, kiriVec3 force, kiriVec3 torque)
{
    KIRI_ASSERT(frame >= 0 && frame < sheet->frames.count);
    kiriFrameData* data = &sheet->frames.data[frame];
    kiriVec3 arm = kiriVec3_Sub(kiriFrame_Carry(data, at), data->x);
    data->force = kiriVec3_Add(data->force, force);
    data->torque = kiriVec3_Add(data->torque, kiriVec3_Add(torque, kiriVec3_Cross(arm, force)));
}

void kiriLoad_AlongLine(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, kiriVec3 perLength)
{
    kiriVec2 a = kiriMesh_Local(&sheet->mesh, from), way = kiriVec2_Sub(kiriMesh_Local(&sheet->mesh, to), a);
    double length = kiriVec2_Length(way);
    for (int32_t k = 0; k < sheet->lineShares.count; ++k) {
        const kiriLineShare* share = &sheet->lineShares.data[k];
        kiriVec2 at = kiriVec2_Add(a, kiriVec2_Scale(share->firstLoad / share->load, way));
        kiriVec3 none = { 0.0, 0.0, 0.0 };
        kiriLoad_AtPoint(sheet, share->frame, at, kiriVec3_Scale(length * share->load, perLength), none);
    }
}

/* The resultant on a region acts at its centroid, where its frame has its centre. The length of A_u x A_v, 1 for a rigid
   frame, is by how much an affine one stretches the area. */
void kiriLoad_OnSurface(kiriSheetData* sheet, double pressure)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData* frame = &sheet->frames.data[i];
        kiriVec3 across = kiriVec3_Cross(frame->A.u, frame->A.v);
        frame->force = kiriVec3_AddScaled(frame->force, pressure * frame->area, across);
    }
}
