/* A picture to draw into by OpenGL with glBegin, without a window: by OSMesa, or where Mesa (25.1 and later) has none, by
   EGL without a surface. */
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#include "image.h"

#include <GL/gl.h>
#include <GL/glext.h>

enum { OFFSCREEN_SHADOW_SIZE = 512 };

typedef struct Offscreen Offscreen;

/* Makes a picture of columns x rows pixels current, with a depth buffer. Null without memory, or where no OpenGL can do
   this size. */
Offscreen* Offscreen_Create(int32_t columns, int32_t rows);

/* Takes null too. */
void Offscreen_Destroy(Offscreen* offscreen);

/* Averages squares of factor x factor drawn pixels. The image has the size of the picture divided by `factor`. */
void Offscreen_Shrink(Offscreen* offscreen, Image* image, int32_t factor);

/* Loads the matrix of a view from `eye` along -back. The axes are unit vectors: right, up, back. */
void Offscreen_LookFrom(const float eye[3], const float right[3], const float up[3], const float back[3]);

/* Blurs the red of the lower left size x size pixels by box filters, and makes it the alpha of a texture. The size is
   OFFSCREEN_SHADOW_SIZE at most. */
void Offscreen_MakeShadow(GLuint texture, int32_t size, int32_t radius, int passes);

#endif
