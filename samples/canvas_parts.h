/* What the files of the canvas share. */
#ifndef CANVAS_PARTS_H
#define CANVAS_PARTS_H

#include "canvas.h"

/* A growing array of flat shapes in units of the overlay: triangles. */
typedef struct OverlayCorner {
    float x, y;
    Color color;
} OverlayCorner;

enum { OVERLAY_MOST_TEXTS = 32 };

typedef struct OverlayText { /* places and sizes in units of the overlay */
    int32_t after;           /* corners that it covers */
    float x, y, size, align;
    Color color;
    char words[96];
} OverlayText;

typedef struct Overlay {
    OverlayCorner* corners;
    int32_t count, capacity;
    OverlayText texts[OVERLAY_MOST_TEXTS];
    int32_t textCount;
    bool failed; /* for want of memory */
} Overlay;

void Overlay_AddQuad(Overlay* overlay, const float corners[8], Color color);
void Overlay_AddDisc(Overlay* overlay, float x, float y, float radius, Color color);
void Overlay_AddStroke(Overlay* overlay, const float from[2], const float to[2], float width, Color color);
void Overlay_AddText(Overlay* overlay, float x, float y, float size, float align, Color color, const char* text);

/* Draws a text in a font of the system, for Canvas_Create (games/canvas_text.c). */
void OverlayText_Draw(const OverlayText* text, float scale);

/* Writes a text on a picture in the same font; left, top: pixels. */
void Image_WriteText(Image* image, const char* words, int32_t size, int32_t left, int32_t top, const uint8_t color[3]);

/* To the right, up, and towards the eye: unit vectors. Returns how far the eye is from the target. */
float CanvasCamera_GetAxes(const CanvasCamera* camera, float right[3], float up[3], float back[3]);

/* Half of what the picture shows from bottom to top, m, so far from the eye. */
float CanvasCamera_GetHalfHeight(const CanvasCamera* camera, float away);

/* Draws the body with the current matrix, colour and light. */
void CanvasBody_Draw(const CanvasBody* body);

#endif
