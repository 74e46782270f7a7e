#include "kiri_load.h"

#include "../motion/kiri_prediction.h"

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

/* The resultant on a region acts at its centroid, where its frame has its centre. The length of A_u x A_v, 1 for a
   rigid frame, is by how much an affine one stretches the area. */
void kiriLoad_OnSurface(kiriSheetData* sheet, double pressure)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData* frame = &sheet->frames.data[i];
        kiriVec3 across = kiriVec3_Cross(frame->A.u, frame->A.v);
        frame->force = kiriVec3_AddScaled(frame->force, pressure * frame->area, across);
    }
}

/* ---- Impulses ---------------------------------------------------------------------------------------------------- */

/* What acts across the plane of a planar sheet is dropped. */
static void Push(const kiriSheetData* sheet, kiriFrameData* frame, kiriVec3 impulse, kiriVec3 moment)
{
    const kiriMechanics* mechanics = &sheet->settings.mechanics;
    kiriVec3 d = mechanics->axes.d;
    kiriMat3 inertia = kiriFrame_Inertia(frame, &sheet->settings.material);
    if (mechanics->planar) {
        impulse = kiriVec3_AddScaled(impulse, -kiriVec3_Dot(impulse, d), d);
        double about = kiriVec3_Dot(d, kiriMat3_Mul(inertia, d));
        frame->spin = kiriVec3_AddScaled(frame->spin, kiriVec3_Dot(moment, d) / about, d);
    } else {
        frame->spin = kiriVec3_Add(frame->spin, kiriMat3_Solve(&inertia, moment));
    }
    frame->velocity = kiriVec3_AddScaled(frame->velocity, 1.0 / frame->mass, impulse);
}

/* The parts of the impulse that this frame gets by the corners of the triangle; or, KIRI_NONE, each frame its own. */
static void PushFrames(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 off, kiriVec3 impulse, int32_t only,
                       kiriFrameData* frames)
{
    const int32_t* corners = sheet->mesh.triangles.data[place->triangle].vertex;
    for (int k = 0; k < 3; ++k) {
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->mesh.vertices.data[corners[k]].at);
        kiriSpan span = sheet->vertexSkin.spans.data[corners[k]];
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
            int32_t f = kiriSheet_FrameOf(sheet, weight.label);
            if (only == KIRI_NONE || only == f) {
                kiriFrameData* frame = only == KIRI_NONE ? &frames[f] : frames;
                kiriVec3 arm = kiriVec3_Add(kiriVec3_Sub(kiriFrame_Carry(frame, local), frame->x), off);
                kiriVec3 part = kiriVec3_Scale(place->shares[k] * weight.value, impulse);
                Push(sheet, frame, part, kiriVec3_Cross(arm, part));
            }
        }
    }
}

static bool FitsImpulse(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 off, kiriVec3 impulse)
{
    const int32_t* corners = sheet->mesh.triangles.data[place->triangle].vertex;
    for (int k = 0; k < 3; ++k) {
        kiriSpan span = sheet->vertexSkin.spans.data[corners[k]];
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            int32_t f = kiriSheet_FrameOf(sheet, sheet->vertexSkin.weights.data[i].label);
            kiriFrameData pushed = sheet->frames.data[f];
            PushFrames(sheet, place, off, impulse, f, &pushed);
            if (!kiriFrame_FitsFloats(&pushed)) {
                return false;
            }
        }
    }
    return true;
}

/* What is seen lies off where the weights have the point, where it fades or its patches are bent: each share of the
   impulse acts as if that much beside its frame's own point, so that the sum acts where the point is seen. */
bool kiriLoad_Impulse(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 impulse)
{
    kiriVec3 off = kiriVec3_Sub(kiriPoint_Position(sheet, place), kiriPoint_Blend(sheet, place).x);
    if (!FitsImpulse(sheet, place, off, impulse)) {
        return false;
    }
    PushFrames(sheet, place, off, impulse, KIRI_NONE, sheet->frames.data);
    return true;
}
