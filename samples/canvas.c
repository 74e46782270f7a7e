#define GL_GLEXT_PROTOTYPES
#include "canvas_parts.h"

#include "offscreen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTURES = 8 };

static const float nearest = 0.02f, farthest = 25.0f; /* in distances of the target from the eye */
static const float toLight[3] = { -0.35f, -0.45f, 1.0f };
static const float toLamp[3] = { -0.22f, -1.0f, 0.42f }; /* before the wall */

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
    CanvasTextDrawer* drawText;
    int32_t width, height, oversampling;
    GLuint shadowTextures[3]; /* of the grounds */
    GLuint depthTexture, shader; /* of shadows on things; shader 0: none */
    float lightMatrices[2][16];  /* projection, view */
    TextureSlot textures[TEXTURES];
    int32_t nextTexture;

    CanvasCamera camera;
    Color top, bottom;
    Ground grounds[3]; /* across y: the wall; across z: the floor */
    CanvasSheet* sheets;
    CanvasBody* bodies;
    Line* lines;
    int32_t sheetCount, sheetCapacity, bodyCount, bodyCapacity, lineCount, lineCapacity;
    Lines marks;
    bool marksAreHidden;
    Overlay overlay;
    bool failed; /* for want of memory */
};

/* Multiplies the colour by the part of the light that comes through, the mean over a small square. */
static const char shaderText[] =
    "uniform sampler2D print; uniform sampler2DShadow depth; uniform bool hasPrint;"
    "void main() {"
    "  float lit = 0.0;"
    "  for (float x = -1.5; x < 2.0; x++) for (float y = -1.5; y < 2.0; y++)"
    "    lit += shadow2D(depth, gl_TexCoord[1].xyz + vec3(x, y, 0.0) * 0.002).r;"
    "  vec3 color = hasPrint ? texture2D(print, gl_TexCoord[0].xy).rgb : vec3(1.0);"
    "  gl_FragColor = vec4(gl_Color.rgb * color * lit / 16.0, gl_Color.a);"
    "}";

static GLuint MakeShader(void)
{
    const char* text = shaderText;
    GLuint shader = glCreateShader(GL_FRAGMENT_SHADER), program = glCreateProgram();
    GLint isFine = 0;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &isFine);
    if (isFine == 0) {
        return 0;
    }
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "depth"), 1);
    glUseProgram(0);
    return program;
}

/* ---- What there is to see --------------------------------------------------------------------------------------- */

Canvas* Canvas_Create(int32_t width, int32_t height, int32_t oversampling, CanvasTextDrawer* drawText)
{
    Canvas* canvas = calloc(1, sizeof(Canvas));
    if (canvas == NULL) {
        return NULL;
    }
    canvas->width = width;
    canvas->height = height;
    canvas->oversampling = oversampling;
    canvas->drawText = drawText;
    canvas->offscreen = Offscreen_Create(oversampling * width, oversampling * height);
    if (canvas->offscreen == NULL) {
        Canvas_Destroy(canvas);
        return NULL;
    }
    glGenTextures(3, canvas->shadowTextures);
    glGenTextures(1, &canvas->depthTexture);
    canvas->shader = MakeShader();
    for (int32_t i = 0; i < TEXTURES; i++) {
        glGenTextures(1, &canvas->textures[i].name);
    }
    glEnable(GL_NORMALIZE);
    glEnable(GL_LINE_SMOOTH);
    glEnable(GL_POINT_SMOOTH);
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

void Canvas_Begin(Canvas* canvas, const CanvasCamera* camera, Color top, Color bottom)
{
    canvas->camera = *camera;
    canvas->top = top;
    canvas->bottom = bottom;
    memset(canvas->grounds, 0, sizeof canvas->grounds);
    canvas->sheetCount = canvas->bodyCount = canvas->lineCount = canvas->overlay.count = canvas->overlay.textCount = 0;
    canvas->marks = (Lines){ .isShort = false };
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

void Canvas_SetMarks(Canvas* canvas, const Lines* marks, bool isHidden)
{
    canvas->marks = *marks;
    canvas->marksAreHidden = isHidden;
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

static void SetCamera(const Canvas* canvas)
{
    const CanvasCamera* camera = &canvas->camera;
    float right[3], up[3], back[3], away = CanvasCamera_GetAxes(camera, right, up, back);
    float height = CanvasCamera_GetHalfHeight(camera, nearest * away);
    float width = height * (float)canvas->width / (float)canvas->height;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    if (camera->fieldOfView > 0.0f) {
        glFrustum(-width, width, -height, height, nearest * away, farthest * away);
    } else {
        glOrtho(-width, width, -height, height, nearest * away, farthest * away);
    }
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

/* Finds the square of the ground that holds the shadows of things around the target. Returns half of its side. */
static float GetShadowSquare(const Canvas* canvas, int axis, float middle[3])
{
    const float* light = axis == 2 ? toLight : toLamp;
    float right[3], up[3], back[3], away = CanvasCamera_GetAxes(&canvas->camera, right, up, back);
    float way = (canvas->grounds[axis].at - canvas->camera.target[axis]) / light[axis];
    for (int i = 0; i < 3; i++) {
        middle[i] = canvas->camera.target[i] + way * light[i];
    }
    return 1.5f * CanvasCamera_GetHalfHeight(&canvas->camera, away);
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

/* Projects all along the light onto the plane across `axis`. */
static void SetShadowMatrices(const Canvas* canvas, int axis)
{
    const float* light = axis == 2 ? toLight : toLamp;
    int u = 0, v = axis == 2 ? 1 : 2;
    float middle[3], reach = GetShadowSquare(canvas, axis, middle);
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
    SetShadowMatrices(canvas, axis);
    glDisable(GL_DEPTH_TEST);
    glColor3f(1.0f, 1.0f, 1.0f);
    DrawFlat(canvas);
    Offscreen_MakeShadow(canvas->shadowTextures[axis], size, size / 80 + 1, 3);
}

/* The ground fades into the background. */
static void DrawGround(const Canvas* canvas, int axis)
{
    enum { SIDES = 64, RINGS = 8 };
    const Ground* ground = &canvas->grounds[axis];
    const float* middle = canvas->camera.target;
    int u = 0, v = axis == 2 ? 1 : 2;
    float right[3], up[3], back[3], away = CanvasCamera_GetAxes(&canvas->camera, right, up, back), at[3];
    float reach = 4.0f * CanvasCamera_GetHalfHeight(&canvas->camera, away);
    at[axis] = ground->at;
    for (int ring = 0; ring < RINGS; ring++) {
        glBegin(GL_QUAD_STRIP);
        for (int i = 0; i < 2 * SIDES + 2; i++) {
            float share = (float)(ring + i % 2) / RINGS, fade = 1.0f - share * share;
            float angle = (float)(i / 2) * 6.2831853f / SIDES;
            at[u] = middle[u] + share * reach * cosf(angle);
            at[v] = middle[v] + share * reach * sinf(angle);
            glColor4f(ground->color.red, ground->color.green, ground->color.blue, fade * fade);
            glVertex3fv(at);
        }
        glEnd();
    }
}

static void DrawShadow(const Canvas* canvas, int axis)
{
    int u = 0, v = axis == 2 ? 1 : 2;
    float at[3], middle[3], reach = GetShadowSquare(canvas, axis, middle);
    at[axis] = canvas->grounds[axis].at;
    glBindTexture(GL_TEXTURE_2D, canvas->shadowTextures[axis]);
    glEnable(GL_TEXTURE_2D);
    glColor4f(0.10f, 0.10f, 0.17f, axis == 2 ? 0.36f : 0.28f);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        float x = i == 1 || i == 2 ? 1.0f : 0.0f, y = i >= 2 ? 1.0f : 0.0f;
        at[u] = middle[u] + reach * (2.0f * x - 1.0f);
        at[v] = middle[v] + reach * (2.0f * y - 1.0f);
        glTexCoord2f(x, y);
        glVertex3fv(at);
    }
    glEnd();
    glDisable(GL_TEXTURE_2D);
}

/* ---- Shadows of things on things --------------------------------------------------------------------------------- */

/* How far the light goes, as a texture. Uses a corner of the picture: it comes first. */
static void MakeDepth(Canvas* canvas)
{
    const float* at = canvas->camera.target;
    const float from[3] = { at[0] + toLight[0], at[1] + toLight[1], at[2] + toLight[2] };
    int32_t size = canvas->oversampling * (canvas->width < canvas->height ? canvas->width : canvas->height);
    float right[3], up[3], back[3], away = CanvasCamera_GetAxes(&canvas->camera, right, up, back);
    float reach = 1.5f * CanvasCamera_GetHalfHeight(&canvas->camera, away);
    glViewport(0, 0, size, size);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-reach, reach, -reach, reach, -4.0f * reach, 4.0f * reach);
    CanvasCamera_GetAxes(&(CanvasCamera){ .eye = { from[0], from[1], from[2] }, .target = { at[0], at[1], at[2] } }, right, up, back);
    Offscreen_LookFrom(at, right, up, back);
    glGetFloatv(GL_PROJECTION_MATRIX, canvas->lightMatrices[0]);
    glGetFloatv(GL_MODELVIEW_MATRIX, canvas->lightMatrices[1]);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(12.0f, 16.0f);
    DrawFlat(canvas);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glBindTexture(GL_TEXTURE_2D, canvas->depthTexture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, (float[]){ 1.0f, 1.0f, 1.0f, 1.0f });
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 0, 0, size, size, 0);
}

/* Texture coordinates of unit 1 become places in the light's view. The current matrix is of the camera. */
static void UseDepth(const Canvas* canvas)
{
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, canvas->depthTexture);
    for (int i = 0; i < 4; i++) {
        const float axis[4] = { i == 0, i == 1, i == 2, i == 3 };
        glTexGeni(GL_S + (GLenum)i, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
        glTexGenfv(GL_S + (GLenum)i, GL_EYE_PLANE, axis);
        glEnable(GL_TEXTURE_GEN_S + (GLenum)i);
    }
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glTranslatef(0.5f, 0.5f, 0.5f);
    glScalef(0.5f, 0.5f, 0.5f);
    glMultMatrixf(canvas->lightMatrices[0]);
    glMultMatrixf(canvas->lightMatrices[1]);
    glMatrixMode(GL_MODELVIEW);
    glActiveTexture(GL_TEXTURE0);
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
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (float[]){ 0.74f, 0.72f, 0.68f, 1.0f });
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
    glTranslatef(-texture->origin[0], -texture->origin[1], 0.0f);
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

static void DrawSheet(Canvas* canvas, const CanvasSheet* sheet, bool isLit)
{
    SetMaterial(GL_FRONT, sheet->front);
    SetMaterial(GL_BACK, sheet->back);
    if (sheet->texture != NULL) {
        SetTexture(canvas, sheet->texture);
    }
    if (isLit) {
        glUniform1i(glGetUniformLocation(canvas->shader, "hasPrint"), sheet->texture != NULL);
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

/* Round at each end, so that lines join. Thin lines join by themselves, and a point would be seen as a dot. */
static void DrawEdges(const int32_t* ends, int32_t count, float width, Color color)
{
    glLineWidth(width);
    glPointSize(width);
    SetColor(color);
    glDrawElements(GL_LINES, 2 * count, GL_UNSIGNED_INT, ends);
    if (width > 2.0f) {
        glDrawElements(GL_POINTS, 2 * count, GL_UNSIGNED_INT, ends);
    }
}

/* All lips, then all dark lines; none hides another. */
static void DrawOpenEdges(const Canvas* canvas, float scale)
{
    glDepthMask(GL_FALSE);
    for (int32_t i = 0; i < 2 * canvas->sheetCount; i++) {
        const CanvasSheet* sheet = &canvas->sheets[i % canvas->sheetCount];
        const EdgeLines* edges = &sheet->edges;
        float width = (sheet->lineWidth > 0.0f ? sheet->lineWidth : 1.5f) * scale;
        glVertexPointer(3, GL_FLOAT, 0, sheet->positions);
        if (i < canvas->sheetCount) {
            DrawEdges(edges->lips, edges->lipCount, 2.6f * width, sheet->lip);
        } else {
            DrawEdges(edges->lips, edges->lipCount, width, sheet->rim);
            DrawEdges(edges->rims, edges->rimCount, width, sheet->rim);
        }
    }
    glDepthMask(GL_TRUE);
}

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

static void DrawMarks(const Canvas* canvas, float scale)
{
    if (!canvas->marksAreHidden) {
        glDisable(GL_DEPTH_TEST);
    }
    glLineWidth(2.0f * scale);
    glPointSize(7.0f * scale);
    DrawVertices(GL_LINES, &canvas->marks.lines);
    DrawVertices(GL_POINTS, &canvas->marks.points);
    glEnable(GL_DEPTH_TEST);
}

static void DrawThings(Canvas* canvas, bool isLit)
{
    for (int32_t i = 0; i < canvas->bodyCount; i++) {
        SetMaterial(GL_FRONT_AND_BACK, canvas->bodies[i].color);
        CanvasBody_Draw(&canvas->bodies[i]);
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 4.0f);
    for (int32_t i = 0; i < canvas->sheetCount; i++) {
        DrawSheet(canvas, &canvas->sheets[i], isLit);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
}

/* Adds the light that throws shadows to the others. */
static void AddLight(Canvas* canvas)
{
    UseDepth(canvas);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (float[]){ 0.0f, 0.0f, 0.0f, 1.0f });
    glEnable(GL_LIGHT0);
    glDisable(GL_LIGHT1);
    glDisable(GL_LIGHT2);
    glUseProgram(canvas->shader);
    glUniform1i(glGetUniformLocation(canvas->shader, "hasPrint"), 0); /* of bodies */
    glBlendFunc(GL_SRC_ALPHA, GL_ONE);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_STENCIL_TEST); /* once where two faces lie in one plane */
    glStencilFunc(GL_EQUAL, 0, 1);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    DrawThings(canvas, true);
    glDisable(GL_STENCIL_TEST);
    glDepthFunc(GL_LESS);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(0);
}

static void DrawScene(Canvas* canvas, float scale)
{
    SetLights();
    glEnable(GL_LIGHTING);
    if (canvas->shader != 0) {
        glDisable(GL_LIGHT0);
    }
    DrawThings(canvas, false);
    if (canvas->shader != 0) {
        AddLight(canvas);
    }
    glDisable(GL_LIGHTING);
    DrawOpenEdges(canvas, scale);
    for (int32_t i = 0; i < canvas->lineCount; i++) {
        glLineWidth(canvas->lines[i].width * scale);
        SetColor(canvas->lines[i].color);
        glBegin(GL_LINES);
        glVertex3fv(canvas->lines[i].ends[0]);
        glVertex3fv(canvas->lines[i].ends[1]);
        glEnd();
    }
    DrawMarks(canvas, scale);
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

static void DrawOverlay(const Canvas* canvas, float scale)
{
    const Overlay* overlay = &canvas->overlay;
    int32_t drawn = 0;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, CANVAS_WIDTH, CANVAS_HEIGHT, 0.0, -1.0, 1.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    for (int32_t i = 0; i < overlay->textCount; i++) {
        DrawCorners(overlay, drawn, overlay->texts[i].after);
        drawn = overlay->texts[i].after;
        if (canvas->drawText != NULL) {
            canvas->drawText(&overlay->texts[i], scale);
        }
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
    float scale = (float)rows / CANVAS_HEIGHT;
    glEnableClientState(GL_VERTEX_ARRAY);
    if (canvas->shader != 0) {
        MakeDepth(canvas);
    }
    for (int axis = 1; axis < 3; axis++) {
        if (canvas->grounds[axis].isThere) {
            MakeShadow(canvas, axis);
        }
    }
    glViewport(0, 0, columns, rows);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    DrawBackground(canvas);
    glEnable(GL_BLEND);
    DrawGrounds(canvas);
    DrawScene(canvas, scale);
    DrawOverlay(canvas, scale);
    glDisable(GL_BLEND);
    glDisableClientState(GL_VERTEX_ARRAY);
    Offscreen_Shrink(canvas->offscreen, image, canvas->oversampling);
    return true;
}
