#include "canvas_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DISC_SIDES = 24 };

static OverlayCorner* Reserve(Overlay* overlay, int32_t count)
{
    if (overlay->count + count > overlay->capacity) {
        int32_t capacity = 2 * (overlay->count + count);
        OverlayCorner* corners = realloc(overlay->corners, sizeof(OverlayCorner) * (size_t)capacity);
        if (corners == NULL) {
            overlay->failed = true;
            return NULL;
        }
        overlay->corners = corners;
        overlay->capacity = capacity;
    }
    overlay->count += count;
    return overlay->corners + overlay->count - count;
}

void Overlay_AddQuad(Overlay* overlay, const float corners[8], Color color)
{
    static const int order[6] = { 0, 1, 2, 0, 2, 3 };
    OverlayCorner* corner = Reserve(overlay, 6);
    for (int i = 0; corner != NULL && i < 6; i++) {
        corner[i] = (OverlayCorner){ corners[2 * order[i]], corners[2 * order[i] + 1], color };
    }
}

void Overlay_AddDisc(Overlay* overlay, float x, float y, float radius, Color color)
{
    OverlayCorner* corner = Reserve(overlay, 3 * DISC_SIDES);
    for (int32_t i = 0; corner != NULL && i < DISC_SIDES; i++) {
        float from = (float)i * 6.2831853f / DISC_SIDES, to = (float)(i + 1) * 6.2831853f / DISC_SIDES;
        corner[3 * i] = (OverlayCorner){ x, y, color };
        corner[3 * i + 1] = (OverlayCorner){ x + radius * cosf(from), y + radius * sinf(from), color };
        corner[3 * i + 2] = (OverlayCorner){ x + radius * cosf(to), y + radius * sinf(to), color };
    }
}

void Overlay_AddStroke(Overlay* overlay, const float from[2], const float to[2], float width, Color color)
{
    float dx = to[0] - from[0], dy = to[1] - from[1], length = sqrtf(dx * dx + dy * dy);
    if (length > 0.0f) {
        float x = -0.5f * width * dy / length, y = 0.5f * width * dx / length;
        const float corners[8] = { from[0] + x, from[1] + y, to[0] + x,   to[1] + y,
                                   to[0] - x,   to[1] - y,   from[0] - x, from[1] - y };
        Overlay_AddQuad(overlay, corners, color);
    }
}

void Overlay_AddText(Overlay* overlay, float x, float y, float size, float align, Color color, const char* text)
{
    if (overlay->textCount == OVERLAY_MOST_TEXTS) {
        return;
    }
    OverlayText* added = &overlay->texts[overlay->textCount++];
    *added = (OverlayText){ .after = overlay->count, .x = x, .y = y, .size = size, .align = align, .color = color };
    snprintf(added->words, sizeof added->words, "%s", text);
}
