#include "offscreen.h"

#include <stdlib.h>

#ifdef KIRI_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#else
#include <GL/osmesa.h>
#endif

struct Offscreen {
#ifdef KIRI_EGL
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface;
#else
    OSMesaContext context;
#endif
    int32_t columns, rows;
    uint8_t* pixels; /* rows from the top */
};

#ifdef KIRI_EGL

/* A pixel buffer takes the place of a window. */
static bool MakeContext(Offscreen* offscreen)
{
    const EGLint wanted[] = { EGL_SURFACE_TYPE,
                              EGL_PBUFFER_BIT,
                              EGL_RENDERABLE_TYPE,
                              EGL_OPENGL_BIT,
                              EGL_RED_SIZE,
                              8,
                              EGL_GREEN_SIZE,
                              8,
                              EGL_BLUE_SIZE,
                              8,
                              EGL_DEPTH_SIZE,
                              24,
                              EGL_STENCIL_SIZE,
                              8,
                              EGL_NONE };
    const EGLint size[] = { EGL_WIDTH, offscreen->columns, EGL_HEIGHT, offscreen->rows, EGL_NONE };
    EGLConfig config;
    EGLint count = 0;
    offscreen->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!eglInitialize(offscreen->display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
        !eglChooseConfig(offscreen->display, wanted, &config, 1, &count) || count == 0) {
        return false;
    }
    offscreen->surface = eglCreatePbufferSurface(offscreen->display, config, size);
    offscreen->context = eglCreateContext(offscreen->display, config, EGL_NO_CONTEXT, NULL);
    return eglMakeCurrent(offscreen->display, offscreen->surface, offscreen->surface, offscreen->context);
}

static void DropContext(Offscreen* offscreen)
{
    eglMakeCurrent(offscreen->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(offscreen->display, offscreen->context);
    eglDestroySurface(offscreen->display, offscreen->surface);
}

/* Rows of OpenGL begin below. */
static void ReadPixels(Offscreen* offscreen)
{
    for (int32_t row = 0; row < offscreen->rows; row++) {
        glReadPixels(0, offscreen->rows - 1 - row, offscreen->columns, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                     offscreen->pixels + 4 * (size_t)row * (size_t)offscreen->columns);
    }
}

#else

static bool MakeContext(Offscreen* offscreen)
{
    offscreen->context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 0, NULL);
    if (offscreen->context == NULL || !OSMesaMakeCurrent(offscreen->context, offscreen->pixels, GL_UNSIGNED_BYTE,
                                                         offscreen->columns, offscreen->rows)) {
        return false;
    }
    OSMesaPixelStore(OSMESA_Y_UP, 0);
    return true;
}

static void DropContext(Offscreen* offscreen)
{
    if (offscreen->context != NULL) {
        OSMesaDestroyContext(offscreen->context);
    }
}

/* OSMesa draws into the pixels themselves. */
static void ReadPixels(Offscreen* offscreen)
{
    (void)offscreen;
    glFinish();
}

#endif

Offscreen* Offscreen_Create(int32_t columns, int32_t rows)
{
    Offscreen* offscreen = calloc(1, sizeof(Offscreen));
    if (offscreen == NULL) {
        return NULL;
    }
    offscreen->columns = columns;
    offscreen->rows = rows;
    offscreen->pixels = malloc(4 * (size_t)columns * (size_t)rows);
    if (offscreen->pixels == NULL || !MakeContext(offscreen)) {
        Offscreen_Destroy(offscreen);
        return NULL;
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    return offscreen;
}

void Offscreen_Destroy(Offscreen* offscreen)
{
    if (offscreen != NULL) {
        DropContext(offscreen);
        free(offscreen->pixels);
        free(offscreen);
    }
}

void Offscreen_Shrink(Offscreen* offscreen, Image* image, int32_t factor)
{
    ReadPixels(offscreen);
    Image_Shrink(image, offscreen->pixels, offscreen->columns, 4, factor);
}

void Offscreen_LookFrom(const float eye[3], const float right[3], const float up[3], const float back[3])
{
    float matrix[16] = { 0.0f };
    for (int i = 0; i < 3; i++) {
        matrix[4 * i] = right[i];
        matrix[4 * i + 1] = up[i];
        matrix[4 * i + 2] = back[i];
    }
    matrix[15] = 1.0f;
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(matrix);
    glTranslatef(-eye[0], -eye[1], -eye[2]);
}

/* One pass of a box filter over rows; `step` from pixel to pixel, `stride` from row to row. */
static void BlurRows(uint8_t* pixels, int32_t size, int32_t step, int32_t stride, int32_t radius)
{
    uint8_t line[OFFSCREEN_SHADOW_SIZE];
    for (int32_t y = 0; y < size; y++) {
        uint8_t* row = pixels + y * stride;
        int32_t sum = 0;
        for (int32_t x = 0; x < size + radius; x++) {
            sum += x < size ? row[x * step] : 0;
            sum -= x > 2 * radius ? line[x - 2 * radius - 1] : 0;
            if (x < size) {
                line[x] = row[x * step];
            }
            if (x >= radius) {
                row[(x - radius) * step] = (uint8_t)(sum / (2 * radius + 1));
            }
        }
    }
}

void Offscreen_MakeShadow(GLuint texture, int32_t size, int32_t radius, int passes)
{
    static uint8_t mask[OFFSCREEN_SHADOW_SIZE * OFFSCREEN_SHADOW_SIZE];
    glReadPixels(0, 0, size, size, GL_RED, GL_UNSIGNED_BYTE, mask);
    for (int pass = 0; pass < passes; pass++) {
        BlurRows(mask, size, 1, size, radius);
        BlurRows(mask, size, size, 1, radius);
    }
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, size, size, 0, GL_ALPHA, GL_UNSIGNED_BYTE, mask);
}
