#include "canvas_parts.h"
#include "game.h"

#include "../offscreen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTURES = 8 };

static const float nearest = 0.05f, farthest = 60.0f;     /* m */
static const float toLight[3] = { -0.35f, -0.45f, 1.0f }; /* as in draw.c */
static const float toLamp[3] = { -0.22f, -1.0f, 0.42f };  /* before the wall */

typedef struct Line {
    float ends[2][3], width;
    Color color;
} Line;

/* What shadows fall on: a plane across an axis. */
typedef struct Ground {
    bool isThere;
    float at;
    Color color;
} Ground;

typedef struct TextureSlot {
    GLuint name;
    const uint8_t* rgb;
    uint32_t revision;
} TextureSlot;

struct Canvas {
    Offscreen* offscreen;
    int32_t width, height, oversampling;
    GLuint shadowTextures[3]; /* of the grounds */
    TextureSlot textures[TEXTURES];
    int32_t nextTexture;

    GameCamera camera;
    Color top, bottom;
    Ground grounds[3]; /* across y: the wall; across z: the floor */
    CanvasSheet* sheets;
    CanvasBody* bodies;
    Line* lines;
    int32_t sheetCount, sheetCapacity, bodyCount, bodyCapacity, lineCount, lineCapacity;
    Overlay overlay;
    bool failed; /* for want of memory */
};

/* ---- What there is to see --------------------------------------------------------------------------------------- */

Canvas* Canvas_Create(int32_t width, int32_t height, int32_t oversampling)
{
    Canvas* canvas = calloc(1, sizeof(Canvas));
    if (canvas == NULL) {
        return NULL;
    }
    canvas->width = width;
    canvas->height = height;
    canvas->oversampling = oversampling;
    canvas->offscreen = Offscreen_Create(oversampling * width, oversampling * height);
    if (canvas->offscreen == NULL) {
        Canvas_Destroy(canvas);
        return NULL;
    }
    glGenTextures(3, canvas->shadowTextures);
    for (int32_t i = 0; i < TEXTURES; i++) {
        glGenTextures(1, &canvas->textures[i].name);
    }
    glEnable(GL_NORMALIZE);
    glEnable(GL_LINE_SMOOTH);
    return canvas;
}

void Canvas_Destroy(Canvas* canvas)
{
    Offscreen_Destroy(canvas->offscreen);
    free(canvas->sheets);
    free(canvas->bodies);
    free(canvas->lines);
    free(canvas->overlay.corners);
    free(canvas);
}

void Canvas_Begin(Canvas* canvas, const GameCamera* camera, Color top, Color bottom)
{
    canvas->camera = *camera;
    canvas->top = top;
    canvas->bottom = bottom;
    memset(canvas->grounds, 0, sizeof canvas->grounds);
    canvas->sheetCount = canvas->bodyCount = canvas->lineCount = canvas->overlay.count = canvas->overlay.textCount = 0;
    canvas->failed = canvas->overlay.failed = false;
}

void Canvas_SetFloor(Canvas* canvas, float height, Color color)
{
    canvas->grounds[2] = (Ground){ true, height, color };
}

void Canvas_SetWall(Canvas* canvas, float depth, Color color)
{
    canvas->grounds[1] = (Ground){ true, depth, color };
}

/* Room for one more; null without memory. */
static void* AddItem(Canvas* canvas, void** items, int32_t* count, int32_t* capacity, size_t size)
{
    if (*count == *capacity) {
        void* grown = realloc(*items, size * 2 * (size_t)(*count + 8));
        if (grown == NULL) {
            canvas->failed = true;
            return NULL;
        }
        *items = grown;
        *capacity = 2 * (*count + 8);
    }
    return (char*)*items + size * (size_t)(*count)++;
}

void Canvas_AddSheet(Canvas* canvas, const CanvasSheet* sheet)
{
    CanvasSheet* added =
        AddItem(canvas, (void**)&canvas->sheets, &canvas->sheetCount, &canvas->sheetCapacity, sizeof(CanvasSheet));
    if (added != NULL) {
        *added = *sheet;
    }
}

void Canvas_AddBody(Canvas* canvas, const CanvasBody* body)
{
    CanvasBody* added =
        AddItem(canvas, (void**)&canvas->bodies, &canvas->bodyCount, &canvas->bodyCapacity, sizeof(CanvasBody));
    if (added != NULL) {
        *added = *body;
    }
}

void Canvas_AddLine(Canvas* canvas, const float from[3], const float to[3], float width, Color color)
{
    Line* added = AddItem(canvas, (void**)&canvas->lines, &canvas->lineCount, &canvas->lineCapacity, sizeof(Line));
    if (added != NULL) {
        *added = (Line){ { { from[0], from[1], from[2] }, { to[0], to[1], to[2] } }, width, color };
    }
}

void Canvas_AddRectangle(Canvas* canvas, float left, float top, float width, float height, Color color)
{
    const float corners[8] = { left, top, left + width, top, left + width, top + height, left, top + height };
    Overlay_AddQuad(&canvas->overlay, corners, color);
}

void Canvas_AddDisc(Canvas* canvas, float x, float y, float radius, Color color)
{
    Overlay_AddDisc(&canvas->overlay, x, y, radius, color);
}

void Canvas_AddStroke(Canvas* canvas, const float* points, int32_t count, float width, Color color)
{
    for (int32_t i = 0; i + 1 < count; i++) {
        Overlay_AddStroke(&canvas->overlay, points + 2 * i, points + 2 * i + 2, width, color);
    }
}

void Canvas_AddText(Canvas* canvas, float x, float y, float size, float align, Color color, const char* text)
{
    Overlay_AddText(&canvas->overlay, x, y, size, align, color, text);
}

/* ---- Camera and background -------------------------------------------------------------------------------------- */

static void SetProjection(const GameCamera* camera, float aspect)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    float height = GameCamera_GetHalfHeight(camera, nearest);
    if (camera->fieldOfView > 0.0f) {
        glFrustum(-height * aspect, height * aspect, -height, height, nearest, farthest);
    } else {
        glOrtho(-height * aspect, height * aspect, -height, height, nearest, farthest);
    }
}

static void SetCamera(const Canvas* canvas)
{
    const GameCamera* camera = &canvas->camera;
    SetProjection(camera, (float)canvas->width / (float)canvas->height);
    float right[3], up[3], back[3];
    GameCamera_GetAxes(camera, right, up, back);
    Offscreen_LookFrom(camera->eye, right, up, back);
}

static void SetColor(Color color)
{
    glColor4f(color.red, color.green, color.blue, color.alpha);
}

static void DrawBackground(const Canvas* canvas)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glBegin(GL_QUADS);
    SetColor(canvas->bottom);
    glVertex2f(-1.0f, -1.0f);
    glVertex2f(1.0f, -1.0f);
    SetColor(canvas->top);
    glVertex2f(1.0f, 1.0f);
    glVertex2f(-1.0f, 1.0f);
    glEnd();
    glEnable(GL_DEPTH_TEST);
}

/* ---- Ground and shadows ----------------------------------------------------------------------------------------- */

/* Half the side of the square around the target that shadows are kept of. */
static float GetReach(const GameCamera* camera)
{
    float right[3], up[3], back[3], away = GameCamera_GetAxes(camera, right, up, back);
    return 1.5f * GameCamera_GetHalfHeight(camera, away);
}

static void DrawFlat(const Canvas* canvas)
{
    for (int32_t i = 0; i < canvas->sheetCount; i++) {
        glVertexPointer(3, GL_FLOAT, 0, canvas->sheets[i].positions);
        glDrawElements(GL_TRIANGLES, 3 * canvas->sheets[i].triangleCount, GL_UNSIGNED_INT, canvas->sheets[i].indices);
    }
    for (int32_t i = 0; i < canvas->bodyCount; i++) {
        if (!canvas->bodies[i].shadowless) {
            CanvasBody_Draw(&canvas->bodies[i]);
        }
    }
}

/* Projects all along the light onto the plane across `axis`, in a square around the target. */
static void SetShadowMatrices(const Canvas* canvas, int axis, const float* light)
{
    int u = 0, v = axis == 2 ? 1 : 2;
    float reach = GetReach(&canvas->camera);
    const float* middle = canvas->camera.target;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-reach, reach, -reach, reach, -1.0, 1.0);
    float along[16] = { 0.0f }; /* to (u, v, 0) */
    along[4 * u] = along[4 * v + 1] = along[15] = 1.0f;
    along[4 * axis] = -light[u] / light[axis];
    along[4 * axis + 1] = -light[v] / light[axis];
    along[12] = light[u] / light[axis] * canvas->grounds[axis].at - middle[u];
    along[13] = light[v] / light[axis] * canvas->grounds[axis].at - middle[v];
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(along);
}

/* All as the light sees it on the ground, blurred, as a texture. Uses a corner of the picture: it comes first. */
static void MakeShadow(const Canvas* canvas, int axis)
{
    int32_t size = OFFSCREEN_SHADOW_SIZE;
    while (size > canvas->oversampling * canvas->width || size > canvas->oversampling * canvas->height) {
        size /= 2;
    }
    glViewport(0, 0, size, size);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    SetShadowMatrices(canvas, axis, axis == 2 ? toLight : toLamp);
    glDisable(GL_DEPTH_TEST);
    glColor3f(1.0f, 1.0f, 1.0f);
    DrawFlat(canvas);
    Offscreen_MakeShadow(canvas->shadowTextures[axis], size, size / 100 + 1, 2);
}

/* The ground fades into the background. */
static void DrawGround(const Canvas* canvas, int axis)
{
    enum { SIDES = 64 };
    const Ground* ground = &canvas->grounds[axis];
    int u = 0, v = axis == 2 ? 1 : 2;
    float reach = 2.2f * GetReach(&canvas->camera), at[3];
    at[axis] = ground->at;
    at[u] = canvas->camera.target[u];
    at[v] = canvas->camera.target[v];
    glBegin(GL_TRIANGLE_FAN);
    SetColor(ground->color);
    glVertex3fv(at);
    for (int i = 0; i <= SIDES; i++) {
        glColor4f(ground->color.red, ground->color.green, ground->color.blue, 0.0f);
        at[u] = canvas->camera.target[u] + reach * cosf((float)i * 6.2831853f / SIDES);
        at[v] = canvas->camera.target[v] + reach * sinf((float)i * 6.2831853f / SIDES);
        glVertex3fv(at);
    }
    glEnd();
}

static void DrawShadow(const Canvas* canvas, int axis)
{
    int u = 0, v = axis == 2 ? 1 : 2;
    float reach = GetReach(&canvas->camera), at[3];
    at[axis] = canvas->grounds[axis].at;
    glBindTexture(GL_TEXTURE_2D, canvas->shadowTextures[axis]);
    glEnable(GL_TEXTURE_2D);
    glColor4f(0.10f, 0.10f, 0.17f, axis == 2 ? 0.42f : 0.28f);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        float x = i == 1 || i == 2 ? 1.0f : 0.0f, y = i >= 2 ? 1.0f : 0.0f;
        at[u] = canvas->camera.target[u] + reach * (2.0f * x - 1.0f);
        at[v] = canvas->camera.target[v] + reach * (2.0f * y - 1.0f);
        glTexCoord2f(x, y);
        glVertex3fv(at);
    }
    glEnd();
    glDisable(GL_TEXTURE_2D);
}

/* ---- Sheets and bodies ------------------------------------------------------------------------------------------ */

static void SetMaterial(GLenum face, Color color)
{
    glMaterialfv(face, GL_AMBIENT_AND_DIFFUSE, (float[]){ color.red, color.green, color.blue, color.alpha });
}

static void SetLights(void)
{
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (float[]){ 0.40f, 0.41f, 0.44f, 1.0f });
    glLightfv(GL_LIGHT0, GL_POSITION, (float[]){ toLight[0], toLight[1], toLight[2], 0.0f });
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (float[]){ 0.66f, 0.64f, 0.60f, 1.0f });
    glLightfv(GL_LIGHT1, GL_POSITION, (float[]){ 0.6f, -0.7f, -0.2f, 0.0f });
    glLightfv(GL_LIGHT1, GL_DIFFUSE, (float[]){ 0.36f, 0.38f, 0.42f, 1.0f });
    glLightfv(GL_LIGHT2, GL_POSITION, (float[]){ -0.3f, 1.0f, 0.4f, 0.0f });
    glLightfv(GL_LIGHT2, GL_DIFFUSE, (float[]){ 0.40f, 0.40f, 0.40f, 1.0f });
    glEnable(GL_LIGHT0);
    glEnable(GL_LIGHT1);
    glEnable(GL_LIGHT2);
}

/* Its pixels are given to OpenGL when they are new. */
static void SetTexture(Canvas* canvas, const CanvasTexture* texture)
{
    TextureSlot* slot = NULL;
    for (int32_t i = 0; i < TEXTURES; i++) {
        if (canvas->textures[i].rgb == texture->rgb && canvas->textures[i].revision == texture->revision) {
            slot = &canvas->textures[i];
        }
    }
    bool isNew = slot == NULL;
    if (isNew) {
        slot = &canvas->textures[canvas->nextTexture++ % TEXTURES];
        slot->rgb = texture->rgb;
        slot->revision = texture->revision;
    }
    glBindTexture(GL_TEXTURE_2D, slot->name);
    if (isNew) {
        glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, texture->columns, texture->rows, 0, GL_RGB, GL_UNSIGNED_BYTE,
                     texture->rgb);
    }
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glScalef(1.0f / texture->width, 1.0f / texture->height, 1.0f);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_TEXTURE_2D);
}

static void ResetTexture(void)
{
    glDisable(GL_TEXTURE_2D);
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
}

static void DrawSheet(Canvas* canvas, const CanvasSheet* sheet)
{
    SetMaterial(GL_FRONT, sheet->front);
    SetMaterial(GL_BACK, sheet->back);
    if (sheet->texture != NULL) {
        SetTexture(canvas, sheet->texture);
    }
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, sheet->positions);
    glNormalPointer(GL_FLOAT, 0, sheet->normals);
    glTexCoordPointer(2, GL_FLOAT, 0, sheet->restPositions);
    glDrawElements(GL_TRIANGLES, 3 * sheet->triangleCount, GL_UNSIGNED_INT, sheet->indices);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
    glDisableClientState(GL_NORMAL_ARRAY);
    ResetTexture();
}

static void DrawEdges(const CanvasSheet* sheet, float scale)
{
    glLineWidth((sheet->lineWidth > 0.0f ? sheet->lineWidth : 1.5f) * scale);
    glVertexPointer(3, GL_FLOAT, 0, sheet->positions);
    SetColor(sheet->lip);
    glDrawElements(GL_LINES, 2 * sheet->lipCount, GL_UNSIGNED_INT, sheet->lips);
    SetColor(sheet->rim);
    glDrawElements(GL_LINES, 2 * sheet->rimCount, GL_UNSIGNED_INT, sheet->rims);
}

static void DrawScene(Canvas* canvas, float scale)
{
    SetLights();
    glEnable(GL_LIGHTING);
    for (int32_t i = 0; i < canvas->bodyCount; i++) {
        SetMaterial(GL_FRONT_AND_BACK, canvas->bodies[i].color);
        CanvasBody_Draw(&canvas->bodies[i]);
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 4.0f);
    for (int32_t i = 0; i < canvas->sheetCount; i++) {
        DrawSheet(canvas, &canvas->sheets[i]);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_LIGHTING);
    for (int32_t i = 0; i < canvas->sheetCount; i++) {
        DrawEdges(&canvas->sheets[i], scale);
    }
    for (int32_t i = 0; i < canvas->lineCount; i++) {
        glLineWidth(canvas->lines[i].width * scale);
        SetColor(canvas->lines[i].color);
        glBegin(GL_LINES);
        glVertex3fv(canvas->lines[i].ends[0]);
        glVertex3fv(canvas->lines[i].ends[1]);
        glEnd();
    }
}

/* ---- The picture ------------------------------------------------------------------------------------------------ */

static void DrawCorners(const Overlay* overlay, int32_t first, int32_t end)
{
    if (first < end) {
        glEnableClientState(GL_COLOR_ARRAY);
        glVertexPointer(2, GL_FLOAT, sizeof(OverlayCorner), &overlay->corners[0].x);
        glColorPointer(4, GL_FLOAT, sizeof(OverlayCorner), &overlay->corners[0].color);
        glDrawArrays(GL_TRIANGLES, first, end - first);
        glDisableClientState(GL_COLOR_ARRAY);
    }
}

static void DrawOverlay(const Overlay* overlay, float scale)
{
    int32_t drawn = 0;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, GAME_WIDTH, GAME_HEIGHT, 0.0, -1.0, 1.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    for (int32_t i = 0; i < overlay->textCount; i++) {
        DrawCorners(overlay, drawn, overlay->texts[i].after);
        drawn = overlay->texts[i].after;
        OverlayText_Draw(&overlay->texts[i], scale);
    }
    DrawCorners(overlay, drawn, overlay->count);
    glEnable(GL_DEPTH_TEST);
}

/* Bodies and sheets hide the ground, and it hides nothing. */
static void DrawGrounds(const Canvas* canvas)
{
    SetCamera(canvas);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    for (int axis = 1; axis < 3; axis++) {
        if (canvas->grounds[axis].isThere) {
            DrawGround(canvas, axis);
            DrawShadow(canvas, axis);
        }
    }
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_TEST);
}

bool Canvas_Finish(Canvas* canvas, Image* image)
{
    if (canvas->failed || canvas->overlay.failed) {
        return false;
    }
    int32_t columns = canvas->oversampling * canvas->width, rows = canvas->oversampling * canvas->height;
    float scale = (float)rows / GAME_HEIGHT;
    glEnableClientState(GL_VERTEX_ARRAY);
    for (int axis = 1; axis < 3; axis++) {
        if (canvas->grounds[axis].isThere) {
            MakeShadow(canvas, axis);
        }
    }
    glViewport(0, 0, columns, rows);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    DrawBackground(canvas);
    glEnable(GL_BLEND);
    DrawGrounds(canvas);
    DrawScene(canvas, scale);
    DrawOverlay(&canvas->overlay, scale);
    glDisable(GL_BLEND);
    glDisableClientState(GL_VERTEX_ARRAY);
    Offscreen_Shrink(canvas->offscreen, image, canvas->oversampling);
    return true;
}
