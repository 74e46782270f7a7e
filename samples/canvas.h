/* Draws the pictures of all samples and games, without a window (offscreen.h). A program adds sheets, bodies and lines, in
   any order; then all is drawn at once, with shadows. Arrays that were added stay unchanged until then. */
#ifndef CANVAS_H
#define CANVAS_H

#include "edges.h"
#include "image.h"
#include "lines.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The picture that places and widths of the overlay refer to, whatever its pixels are: (0, 0) is its top left corner. */
enum { CANVAS_WIDTH = 960, CANVAS_HEIGHT = 720 };

typedef struct Color {
    float red, green, blue, alpha;
} Color;

/* Looks from eye to target; up is +z. */
typedef struct CanvasCamera {
    float eye[3], target[3]; /* m */
    float fieldOfView;       /* degrees, from bottom to top; 0: parallel rays, and */
    float height;            /* m: what the picture shows from bottom to top at the target */
} CanvasCamera;

/* A point that moves over the picture looks along this ray; x, y are places of the overlay, direction a unit vector. */
void CanvasCamera_GetRay(const CanvasCamera* camera, float x, float y, float origin[3], float direction[3]);

/* Where a point (m) is seen; false behind the camera. */
bool CanvasCamera_Project(const CanvasCamera* camera, const float point[3], float* x, float* y);

/* Pixels over the rest plane, from `origin` over width x height metres, the first row at the lowest v; they repeat. */
typedef struct CanvasTexture {
    const uint8_t* rgb;
    int32_t columns, rows;
    float origin[2], width, height; /* m */
    uint32_t revision;              /* another number when the pixels have changed */
} CanvasTexture;

typedef struct CanvasSheet {
    const float* positions;     /* 3 a vertex, m */
    const float* normals;       /* 3 a vertex */
    const float* restPositions; /* 2 a vertex, m */
    const int32_t* indices;     /* 3 a triangle */
    int32_t triangleCount;
    EdgeLines edges;              /* a cut that has not opened is a dark line with edges of the lips' colour */
    const CanvasTexture* texture; /* or null: plain */
    Color front, back, lip, rim;  /* with a texture `front` and `back` tint it */
    float lineWidth;              /* of rims, in units of the overlay; 0: 1.5 */
} CanvasSheet;

/* As kiriObstacleType has them. */
enum CanvasShape { CANVAS_PLANE, CANVAS_SPHERE, CANVAS_CAPSULE, CANVAS_BOX, CANVAS_CYLINDER, CANVAS_PRISM };

typedef struct CanvasBody {
    int32_t shape;
    float size[3], radius, height; /* of a plane: size[0] x size[1] is drawn */
    const float* outline;          /* of a prism: convex, counter-clockwise, 2 floats a corner */
    int32_t outlineCount;
    float position[3], rotation[9]; /* columns */
    Color color;
    bool shadowless; /* throws none */
} CanvasBody;

typedef struct Canvas Canvas;

struct OverlayText;

/* Draws a text into the current picture with `scale` pixels a unit of the overlay. */
typedef void CanvasTextDrawer(const struct OverlayText* text, float scale);

/* The picture has width x height pixels, each the mean of oversampling^2 (1 to 4). Null without memory, or where no OpenGL
   can do this size. One canvas at a time. Null for drawText: texts are left out. */
Canvas* Canvas_Create(int32_t width, int32_t height, int32_t oversampling, CanvasTextDrawer* drawText);
void Canvas_Destroy(Canvas* canvas);

/* Begins a picture: nothing to see but a background that goes from top to bottom. */
void Canvas_Begin(Canvas* canvas, const CanvasCamera* camera, Color top, Color bottom);

/* Shadows fall on the floor z = height, or on a wall y = depth behind all. Without these there are none. */
void Canvas_SetFloor(Canvas* canvas, float height, Color color);
void Canvas_SetWall(Canvas* canvas, float depth, Color color);

void Canvas_AddSheet(Canvas* canvas, const CanvasSheet* sheet);
void Canvas_AddBody(Canvas* canvas, const CanvasBody* body);

/* In the world; width in units of the overlay. */
void Canvas_AddLine(Canvas* canvas, const float from[3], const float to[3], float width, Color color);

/* Draws lines and points over all sheets and bodies; isHidden: these hide them. */
void Canvas_SetMarks(Canvas* canvas, const Lines* marks, bool isHidden);

/* Shapes over the world, in units of the overlay; y grows downwards. A later shape covers an earlier one. */
void Canvas_AddRectangle(Canvas* canvas, float left, float top, float width, float height, Color color);
void Canvas_AddStroke(Canvas* canvas, const float* points, int32_t count, float width, Color color);
void Canvas_AddDisc(Canvas* canvas, float x, float y, float radius, Color color);

/* Capitals are `size` units high; up to 95 bytes of UTF-8 are copied. Align 0: it begins at x, 0.5: x is its middle, 1: its end. */
void Canvas_AddText(Canvas* canvas, float x, float y, float size, float align, Color color, const char* text);

/* Draws all that was added into the image, which has the canvas's size. False without memory. */
bool Canvas_Finish(Canvas* canvas, Image* image);

#ifdef __cplusplus
}
#endif

#endif
