#include "kiri_frame.h"

void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea)
{
    kiriVec2 center = kiriMoments_Center(material);
    kiriMoments about = kiriMoments_About(material, center);
    kiriVec3 x = kiriFrame_Carry(frame, center);
    frame->velocity = kiriFrame_VelocityAt(frame, center);
    frame->x = x;
    frame->center = center;
    frame->area = material->area;
    frame->mass = densityPerArea * about.area;
    frame->inertia[0] = densityPerArea * about.uu;
    frame->inertia[1] = densityPerArea * about.uv;
    frame->inertia[2] = densityPerArea * about.vv;
}
