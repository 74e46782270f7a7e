#include "canvas_parts.h"

#include <math.h>

float CanvasCamera_GetAxes(const CanvasCamera* camera, float right[3], float up[3], float back[3])
{
    float length = 0.0f, flat;
    for (int i = 0; i < 3; i++) {
        back[i] = camera->eye[i] - camera->target[i];
        length += back[i] * back[i];
    }
    length = sqrtf(length);
    for (int i = 0; i < 3; i++) {
        back[i] /= length;
    }
    flat = sqrtf(back[0] * back[0] + back[1] * back[1]);
    right[0] = -back[1] / flat;
    right[1] = back[0] / flat;
    right[2] = 0.0f;
    up[0] = -back[2] * right[1];
    up[1] = back[2] * right[0];
    up[2] = back[0] * right[1] - back[1] * right[0];
    return length;
}

float CanvasCamera_GetHalfHeight(const CanvasCamera* camera, float away)
{
    if (camera->fieldOfView <= 0.0f) {
        return 0.5f * camera->height;
    }
    return away * tanf(camera->fieldOfView * 0.5f * 3.14159265f / 180.0f);
}

void CanvasCamera_GetRay(const CanvasCamera* camera, float x, float y, float origin[3], float direction[3])
{
    float right[3], up[3], back[3], length = 0.0f;
    CanvasCamera_GetAxes(camera, right, up, back);
    bool parallel = camera->fieldOfView <= 0.0f;
    float half = CanvasCamera_GetHalfHeight(camera, 1.0f);
    float across = half * (2.0f * x - CANVAS_WIDTH) / CANVAS_HEIGHT,
          along = half * (CANVAS_HEIGHT - 2.0f * y) / CANVAS_HEIGHT;
    for (int i = 0; i < 3; i++) {
        float aside = across * right[i] + along * up[i];
        origin[i] = camera->eye[i] + (parallel ? aside : 0.0f);
        direction[i] = (parallel ? 0.0f : aside) - back[i];
        length += direction[i] * direction[i];
    }
    for (int i = 0; i < 3; i++) {
        direction[i] /= sqrtf(length);
    }
}

bool CanvasCamera_Project(const CanvasCamera* camera, const float point[3], float* x, float* y)
{
    float right[3], up[3], back[3], across = 0.0f, along = 0.0f, away = 0.0f;
    CanvasCamera_GetAxes(camera, right, up, back);
    for (int i = 0; i < 3; i++) {
        float d = point[i] - camera->eye[i];
        across += d * right[i];
        along += d * up[i];
        away -= d * back[i];
    }
    float half = CanvasCamera_GetHalfHeight(camera, away);
    *x = 0.5f * (CANVAS_WIDTH + across / half * CANVAS_HEIGHT);
    *y = 0.5f * (CANVAS_HEIGHT - along / half * CANVAS_HEIGHT);
    return away > 0.0f;
}
