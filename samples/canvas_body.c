#include "canvas_parts.h"

#include <GL/gl.h>
#include <math.h>

/* Corners of the circles of a body: small balls, of which there may be many, look round with fewer. */
enum { SIDES = 40, SMALL_SIDES = 12 };

static const float smallRadius = 0.03f; /* m */

static const float pi = 3.14159265f;

static void DrawBox(const float size[3])
{
    for (int axis = 0; axis < 3; axis++) {
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int side = -1; side <= 1; side += 2) {
            float normal[3] = { 0.0f }, corner[3];
            normal[axis] = (float)side;
            glBegin(GL_TRIANGLE_STRIP);
            glNormal3fv(normal);
            for (int i = 0; i < 4; i++) {
                corner[axis] = 0.5f * (float)side * size[axis];
                corner[u] = (i & 1 ? 0.5f : -0.5f) * (float)side * size[u];
                corner[v] = (i & 2 ? 0.5f : -0.5f) * size[v];
                glVertex3fv(corner);
            }
            glEnd();
        }
    }
}

/* Draws the part of a ball between two heights of its axis, from -1 to 1, moved up by `lift`. */
static void DrawCap(float radius, float from, float to, float lift, int sides)
{
    int rings = sides / 2;
    float first = asinf(from), last = asinf(to), step = (last - first) / (float)rings;
    for (int i = 0; i < rings; i++) {
        float low = first + step * (float)i, high = first + step * (float)(i + 1);
        glBegin(GL_QUAD_STRIP);
        for (int k = 0; k <= sides; k++) {
            float angle = 2.0f * pi * (float)k / (float)sides, x = cosf(angle), y = sinf(angle);
            glNormal3f(x * cosf(high), y * cosf(high), sinf(high));
            glVertex3f(radius * x * cosf(high), radius * y * cosf(high), lift + radius * sinf(high));
            glNormal3f(x * cosf(low), y * cosf(low), sinf(low));
            glVertex3f(radius * x * cosf(low), radius * y * cosf(low), lift + radius * sinf(low));
        }
        glEnd();
    }
}

static void DrawTube(float radius, float height)
{
    glBegin(GL_QUAD_STRIP);
    for (int k = 0; k <= SIDES; k++) {
        float angle = 2.0f * pi * (float)k / SIDES, x = cosf(angle), y = sinf(angle);
        glNormal3f(x, y, 0.0f);
        glVertex3f(radius * x, radius * y, 0.5f * height);
        glVertex3f(radius * x, radius * y, -0.5f * height);
    }
    glEnd();
}

static void DrawEnds(const float* outline, int32_t count, float height)
{
    for (int side = -1; side <= 1; side += 2) {
        glBegin(GL_POLYGON);
        glNormal3f(0.0f, 0.0f, (float)side);
        for (int32_t i = 0; i < count; i++) {
            const float* corner = outline + 2 * (side > 0 ? i : count - 1 - i);
            glVertex3f(corner[0], corner[1], 0.5f * (float)side * height);
        }
        glEnd();
    }
}

static void DrawCylinder(float radius, float height)
{
    float rim[2 * SIDES];
    for (int k = 0; k < SIDES; k++) {
        rim[2 * k] = radius * cosf(2.0f * pi * (float)k / SIDES);
        rim[2 * k + 1] = radius * sinf(2.0f * pi * (float)k / SIDES);
    }
    DrawTube(radius, height);
    DrawEnds(rim, SIDES, height);
}

static void DrawPrism(const float* outline, int32_t count, float height)
{
    glBegin(GL_QUADS);
    for (int32_t i = 0; i < count; i++) {
        const float *a = outline + 2 * i, *b = outline + 2 * ((i + 1) % count);
        glNormal3f(b[1] - a[1], a[0] - b[0], 0.0f);
        glVertex3f(a[0], a[1], -0.5f * height);
        glVertex3f(b[0], b[1], -0.5f * height);
        glVertex3f(b[0], b[1], 0.5f * height);
        glVertex3f(a[0], a[1], 0.5f * height);
    }
    glEnd();
    DrawEnds(outline, count, height);
}

static void DrawPlane(float width, float height)
{
    const float outline[8] = { -0.5f * width, -0.5f * height, 0.5f * width,  -0.5f * height,
                               0.5f * width,  0.5f * height,  -0.5f * width, 0.5f * height };
    DrawEnds(outline, 4, 0.0f);
}

void CanvasBody_Draw(const CanvasBody* body)
{
    float matrix[16] = { 0.0f };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            matrix[4 * i + k] = body->rotation[3 * i + k];
        }
        matrix[12 + i] = body->position[i];
    }
    matrix[15] = 1.0f;
    glPushMatrix();
    glMultMatrixf(matrix);
    if (body->shape == CANVAS_PLANE) {
        DrawPlane(body->size[0], body->size[1]);
    } else if (body->shape == CANVAS_SPHERE) {
        DrawCap(body->radius, -1.0f, 1.0f, 0.0f, body->radius < smallRadius ? SMALL_SIDES : SIDES);
    } else if (body->shape == CANVAS_CAPSULE) {
        DrawTube(body->radius, body->height);
        DrawCap(body->radius, 0.0f, 1.0f, 0.5f * body->height, SIDES);
        DrawCap(body->radius, -1.0f, 0.0f, -0.5f * body->height, SIDES);
    } else if (body->shape == CANVAS_BOX) {
        DrawBox(body->size);
    } else if (body->shape == CANVAS_CYLINDER) {
        DrawCylinder(body->radius, body->height);
    } else if (body->outlineCount >= 3) {
        DrawPrism(body->outline, body->outlineCount, body->height);
    }
    glPopMatrix();
}
