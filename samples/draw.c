#include "draw.h"
#include "edges.h"
#include "offscreen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OVERSAMPLING = 3, SHADOW_SIZE = 256, CLOTH_SIZE = 64 };

static const float shadowReach = 1.6f; /* half the side of the square of floor that the shadow texture covers */
static const float toLight[3] = { -0.35f, -0.45f, 1.0f };
static const float edgeColor[3] = { 0.13f, 0.16f, 0.24f };

struct Painter {
    Offscreen* offscreen;
    int32_t width, height; /* of the picture; the buffer is OVERSAMPLING times as large */
    GLuint clothTexture, shadowTexture, rasterTexture;
    Edge* edges;
    int32_t edgeCapacity;
};

/* ---- Camera ----------------------------------------------------------------------------------------------------- */

static void Normalize(float v[3])
{
    float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

static void Cross(const float a[3], const float b[3], float result[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        result[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void SetCamera(const Camera* camera, float aspect)
{
    const float nearest = 0.05f;
    float height = nearest * tanf(camera->fieldOfView * 0.5f * 3.14159265f / 180.0f);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-height * aspect, height * aspect, -height, height, nearest, 20.0);

    float back[3], right[3], up[3] = { 0.0f, 0.0f, 1.0f };
    for (int i = 0; i < 3; i++) {
        back[i] = camera->eye[i] - camera->target[i];
    }
    Normalize(back);
    Cross(up, back, right);
    Normalize(right);
    Cross(back, right, up);
    Offscreen_LookFrom(camera->eye, right, up, back);
}

/* ---- Background and shadow -------------------------------------------------------------------------------------- */

static void DrawBackground(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glBegin(GL_QUAD_STRIP);
    glColor3f(0.80f, 0.81f, 0.83f);
    glVertex2f(-1.0f, -1.0f);
    glVertex2f(1.0f, -1.0f);
    glColor3f(0.93f, 0.935f, 0.94f);
    glVertex2f(-1.0f, -0.2f);
    glVertex2f(1.0f, -0.2f);
    glColor3f(0.985f, 0.985f, 0.98f);
    glVertex2f(-1.0f, 1.0f);
    glVertex2f(1.0f, 1.0f);
    glEnd();
    glEnable(GL_DEPTH_TEST);
}

/* The sheet as the light sees it on the floor, blurred, as a texture. Uses a corner of the picture: it comes first. */
static void MakeShadow(Painter* painter, const kiriMesh* mesh, float zoom)
{
    glViewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-shadowReach, shadowReach, -shadowReach, shadowReach, -1.0, 1.0);
    float along[16] = { 0.0f }; /* onto the floor, along the light */
    along[0] = along[5] = along[15] = 1.0f;
    along[8] = -toLight[0] / toLight[2];
    along[9] = -toLight[1] / toLight[2];
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(along);
    glScalef(zoom, zoom, zoom);
    glDisable(GL_DEPTH_TEST);
    glColor3f(1.0f, 1.0f, 1.0f);
    glDrawElements(GL_TRIANGLES, 3 * mesh->triangleCount, GL_UNSIGNED_INT, mesh->indices);

    Offscreen_MakeShadow(painter->shadowTexture, SHADOW_SIZE, 4, 3);
}

static void DrawShadow(const Painter* painter)
{
    glBindTexture(GL_TEXTURE_2D, painter->shadowTexture);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glColor4f(0.12f, 0.13f, 0.20f, 0.34f);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        float x = i == 1 || i == 2 ? 1.0f : 0.0f, y = i >= 2 ? 1.0f : 0.0f;
        glTexCoord2f(x, y);
        glVertex3f(shadowReach * (2.0f * x - 1.0f), shadowReach * (2.0f * y - 1.0f), -0.002f);
    }
    glEnd();
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_TEXTURE_2D);
}

/* ---- Sheet ------------------------------------------------------------------------------------------------------ */

/* Checks of two stripes, and a fine weave, so that stretch and slope are seen. */
static void MakeClothTexture(const Painter* painter)
{
    uint8_t pixels[CLOTH_SIZE * CLOTH_SIZE];
    for (int i = 0; i < CLOTH_SIZE * CLOTH_SIZE; i++) {
        int x = i % CLOTH_SIZE, y = i / CLOTH_SIZE;
        int stripes = (x < CLOTH_SIZE / 2) + (y < CLOTH_SIZE / 2);
        pixels[i] = (uint8_t)(255 - 34 * stripes - (((x ^ y) & 2) != 0 ? 8 : 0));
    }
    glBindTexture(GL_TEXTURE_2D, painter->clothTexture);
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, CLOTH_SIZE, CLOTH_SIZE, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, pixels);
}

static void SetMaterial(GLenum face, float red, float green, float blue)
{
    glMaterialfv(face, GL_AMBIENT_AND_DIFFUSE, (float[]){ red, green, blue, 1.0f });
}

static void SetLights(void)
{
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (float[]){ 0.40f, 0.41f, 0.44f, 1.0f });
    glLightfv(GL_LIGHT0, GL_POSITION, (float[]){ toLight[0], toLight[1], toLight[2], 0.0f });
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (float[]){ 0.74f, 0.72f, 0.68f, 1.0f });
    glLightfv(GL_LIGHT1, GL_POSITION, (float[]){ 0.6f, -0.7f, -0.5f, 0.0f });
    glLightfv(GL_LIGHT1, GL_DIFFUSE, (float[]){ 0.26f, 0.28f, 0.32f, 1.0f });
    glLightfv(GL_LIGHT2, GL_POSITION, (float[]){ -0.3f, 1.0f, 0.4f, 0.0f });
    glLightfv(GL_LIGHT2, GL_DIFFUSE, (float[]){ 0.40f, 0.40f, 0.40f, 1.0f });
    glEnable(GL_LIGHT0);
    glEnable(GL_LIGHT1);
    glEnable(GL_LIGHT2);
    glEnable(GL_NORMALIZE);
}

static void SetClothTexture(const Painter* painter, const Look* look, float zoom)
{
    SetMaterial(GL_FRONT, look->front[0], look->front[1], look->front[2]);
    SetMaterial(GL_BACK, look->back[0], look->back[1], look->back[2]);
    glBindTexture(GL_TEXTURE_2D, painter->clothTexture);
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glScalef(zoom * look->checks, zoom * look->checks, 1.0f);
    glMatrixMode(GL_MODELVIEW);
    if (look->checks > 0.0f) {
        glEnable(GL_TEXTURE_2D);
    }
}

static void SetRasterTexture(const Painter* painter, const View* view)
{
    SetMaterial(GL_FRONT_AND_BACK, 0.85f, 0.85f, 0.85f);
    glBindTexture(GL_TEXTURE_2D, painter->rasterTexture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, view->rasterSize, view->rasterSize, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 view->raster);
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glScalef(1.0f / view->rasterWidth, 1.0f / view->rasterWidth, 1.0f);
    glTranslatef(-view->rasterOrigin[0], -view->rasterOrigin[1], 0.0f);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_TEXTURE_2D);
}

static void DrawTextured(const kiriMesh* mesh)
{
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    glNormalPointer(GL_FLOAT, 0, mesh->normals);
    glTexCoordPointer(2, GL_FLOAT, 0, mesh->restPositions);
    glDrawElements(GL_TRIANGLES, 3 * mesh->triangleCount, GL_UNSIGNED_INT, mesh->indices);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
    glDisableClientState(GL_NORMAL_ARRAY);
    glDisable(GL_TEXTURE_2D);
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
}

static void DrawColored(const kiriMesh* mesh, const float* colors)
{
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    glEnable(GL_COLOR_MATERIAL);
    glBegin(GL_TRIANGLES);
    for (int32_t i = 0; i < 3 * mesh->triangleCount; i++) {
        glColor3fv(colors + 3 * i);
        glNormal3fv(mesh->normals + 3 * mesh->indices[i]);
        glVertex3fv(mesh->positions + 3 * mesh->indices[i]);
    }
    glEnd();
    glDisable(GL_COLOR_MATERIAL);
}

static void DrawSheet(const Painter* painter, const View* view, float zoom)
{
    glEnable(GL_LIGHTING);
    if (!view->isSolid) { /* lines along its edges lie before it */
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(2.0f, 12.0f);
    }
    if (view->colors != NULL) {
        DrawColored(&view->mesh, view->colors);
    } else {
        if (view->raster != NULL) {
            SetRasterTexture(painter, view);
        } else {
            SetClothTexture(painter, &view->look, zoom);
        }
        DrawTextured(&view->mesh);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_LIGHTING);
}

/* ---- Open edges ------------------------------------------------------------------------------------------------- */

/* Those of cuts, or the others; width in pixels. */
static void DrawEdgesOfKind(const Edge* edges, int32_t count, const float* positions, bool cut, const float color[3],
                            float width)
{
    glLineWidth(width * OVERSAMPLING);
    glColor3fv(color);
    glBegin(GL_LINES);
    for (int32_t i = 0; i < count; i++) {
        if (edges[i].cut == cut) {
            glVertex3fv(positions + 3 * edges[i].a);
            glVertex3fv(positions + 3 * edges[i].b);
        }
    }
    glEnd();
}

/* A cut that has not opened is a dark line with edges of the lips' colour. */
static void DrawOpenEdges(Painter* painter, const kiriMesh* mesh, const float cutColor[3])
{
    int32_t count = Edges_FindOpen(painter->edges, mesh);
    DrawEdgesOfKind(painter->edges, count, mesh->positions, false, edgeColor, 1.3f);
    DrawEdgesOfKind(painter->edges, count, mesh->positions, true, cutColor, 3.2f);
    glDepthFunc(GL_LEQUAL);
    DrawEdgesOfKind(painter->edges, count, mesh->positions, true, edgeColor, 1.2f);
    glDepthFunc(GL_LESS);
}

static bool ReserveEdges(Painter* painter, int32_t count)
{
    if (painter->edgeCapacity < count) {
        free(painter->edges);
        painter->edges = malloc(2 * sizeof(Edge) * (size_t)count);
        painter->edgeCapacity = painter->edges != NULL ? 2 * count : 0;
    }
    return painter->edgeCapacity >= count;
}

/* ---- Lines and blade --------------------------------------------------------------------------------------------- */

static void DrawVertices(GLenum kind, const Vertices* vertices)
{
    glBegin(kind);
    for (int32_t i = 0; i < vertices->count; i++) {
        uint32_t color = vertices->data[i].color;
        glColor3ub(color & 0xff, color >> 8 & 0xff, color >> 16 & 0xff);
        glVertex3fv(vertices->data[i].position);
    }
    glEnd();
}

static void DrawLines(const View* view)
{
    if (!view->hidesLines) {
        glDisable(GL_DEPTH_TEST);
    }
    glLineWidth(1.6f * OVERSAMPLING);
    glPointSize(6.0f * OVERSAMPLING);
    glEnable(GL_POINT_SMOOTH);
    glEnable(GL_BLEND);
    DrawVertices(GL_LINES, &view->lines.lines);
    DrawVertices(GL_POINTS, &view->lines.points);
    glDisable(GL_BLEND);
    glDisable(GL_POINT_SMOOTH);
    glEnable(GL_DEPTH_TEST);
}

/* A round bar along the z axis. */
static void DrawBar(float bottom, float top, float bottomRadius, float topRadius)
{
    enum { SIDES = 24 };
    float slope = (bottomRadius - topRadius) / (top - bottom);
    glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= SIDES; i++) {
        float angle = (float)i * 6.2831853f / SIDES, x = cosf(angle), y = sinf(angle);
        glNormal3f(x, y, slope);
        glVertex3f(topRadius * x, topRadius * y, top);
        glVertex3f(bottomRadius * x, bottomRadius * y, bottom);
    }
    glEnd();
}

static void DrawBlade(const float tip[3], float zoom)
{
    glPushMatrix();
    glTranslatef(zoom * tip[0], zoom * tip[1], zoom * tip[2]);
    glRotatef(62.0f, 1.0f, 0.0f, 0.0f);
    glRotatef(38.0f, 0.0f, 1.0f, 0.0f);
    glEnable(GL_LIGHTING);
    SetMaterial(GL_FRONT_AND_BACK, 0.78f, 0.80f, 0.83f);
    DrawBar(0.0f, 0.07f, 0.0003f, 0.0075f);
    SetMaterial(GL_FRONT_AND_BACK, 0.22f, 0.23f, 0.27f);
    DrawBar(0.07f, 0.22f, 0.0095f, 0.012f);
    DrawBar(0.22f, 0.2201f, 0.012f, 0.0f);
    glDisable(GL_LIGHTING);
    glPopMatrix();
}

/* A round peg from the wall behind the sheet to before it. */
static void DrawPegs(const float* pins, int32_t count, float zoom)
{
    glEnable(GL_LIGHTING);
    SetMaterial(GL_FRONT_AND_BACK, 0.24f, 0.25f, 0.29f);
    for (int32_t i = 0; i < count; i++) {
        glPushMatrix();
        glTranslatef(zoom * pins[3 * i], zoom * pins[3 * i + 1], zoom * pins[3 * i + 2]);
        glRotatef(90.0f, 1.0f, 0.0f, 0.0f);
        DrawBar(-0.01f, 0.03f, 0.014f, 0.014f);
        DrawBar(0.03f, 0.0301f, 0.014f, 0.0f);
        glPopMatrix();
    }
    glDisable(GL_LIGHTING);
}

/* A thread from the ceiling, and a knot. */
static void DrawThreads(const float* pins, int32_t count, float zoom)
{
    glLineWidth(0.8f * OVERSAMPLING);
    glPointSize(4.5f * OVERSAMPLING);
    glEnable(GL_POINT_SMOOTH);
    glEnable(GL_BLEND);
    glColor3f(0.35f, 0.35f, 0.38f);
    for (int32_t i = 0; i < count; i++) {
        float floorReach = 0.02f / zoom; /* nothing hangs there */
        glBegin(GL_LINES);
        glVertex3fv(pins + 3 * i);
        glVertex3f(pins[3 * i], pins[3 * i + 1], pins[3 * i + 2] + (pins[3 * i + 2] > floorReach ? 4.0f / zoom : 0.0f));
        glEnd();
        glBegin(GL_POINTS);
        glVertex3fv(pins + 3 * i);
        glEnd();
    }
    glDisable(GL_BLEND);
    glDisable(GL_POINT_SMOOTH);
}

/* ---- Painter ---------------------------------------------------------------------------------------------------- */

Painter* Painter_Create(int32_t width, int32_t height)
{
    Painter* painter = calloc(1, sizeof(Painter));
    if (painter == NULL) {
        return NULL;
    }
    int32_t columns = OVERSAMPLING * width, rows = OVERSAMPLING * height;
    painter->width = width;
    painter->height = height;
    painter->offscreen = columns < SHADOW_SIZE || rows < SHADOW_SIZE ? NULL : Offscreen_Create(columns, rows);
    if (painter->offscreen == NULL) {
        Painter_Destroy(painter);
        return NULL;
    }
    glGenTextures(1, &painter->clothTexture);
    glGenTextures(1, &painter->shadowTexture);
    glGenTextures(1, &painter->rasterTexture);
    MakeClothTexture(painter);
    return painter;
}

void Painter_Destroy(Painter* painter)
{
    Offscreen_Destroy(painter->offscreen);
    free(painter->edges);
    free(painter);
}

bool Painter_Paint(Painter* painter, const View* view, Image* image)
{
    if (!ReserveEdges(painter, 3 * view->mesh.triangleCount)) {
        return false;
    }
    int32_t columns = OVERSAMPLING * painter->width, rows = OVERSAMPLING * painter->height;
    float zoom = view->size > 0.0f ? 1.0f / view->size : 1.0f;
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, view->mesh.positions);
    MakeShadow(painter, &view->mesh, zoom);
    glViewport(0, 0, columns, rows);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    DrawBackground();
    SetCamera(&view->camera, (float)columns / (float)rows);
    SetLights();
    DrawShadow(painter);
    glPushMatrix();
    glScalef(zoom, zoom, zoom);
    DrawSheet(painter, view, zoom);
    if (!view->isSolid) {
        DrawOpenEdges(painter, &view->mesh, view->look.lip);
    }
    if (!view->pegs) {
        DrawThreads(view->pins, view->pinCount, zoom);
    }
    DrawLines(view);
    glPopMatrix();
    if (view->pegs) {
        DrawPegs(view->pins, view->pinCount, zoom);
    }
    for (int32_t i = 0; i < view->bladeCount; i++) {
        DrawBlade(view->blades + 3 * i, zoom);
    }
    glDisableClientState(GL_VERTEX_ARRAY);
    Offscreen_Shrink(painter->offscreen, image, OVERSAMPLING);
    return true;
}
