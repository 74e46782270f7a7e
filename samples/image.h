/* Pictures in memory and as PNG files. */
#ifndef IMAGE_H
#define IMAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Image {
    int32_t width, height;
    uint8_t* rgb; /* rows from the top */
} Image;

bool Image_Create(Image* image, int32_t width, int32_t height);
void Image_Free(Image* image);

/* Averages squares of factor x factor pixels. The source is `factor` times as wide and high as the image, rows from
   the top, `channels` bytes a pixel of which the first three are taken. */
void Image_Shrink(Image* image, const uint8_t* source, int32_t sourceWidth, int32_t channels, int32_t factor);

void Image_Paste(Image* image, const Image* part, int32_t left, int32_t top);

bool Image_WritePng(const Image* image, const char* path);

/* A moving picture on its way into a file: animated PNG. It goes round without end; a program that knows only PNG shows
   its first frame. */
typedef struct Apng {
    FILE* file;
    int32_t frameCount; /* all that are to come */
    int32_t added;
    uint32_t sequence; /* the number of the next fcTL or fdAT chunk */
    Image shown;       /* what a viewer sees after the frames so far */
    uint8_t* rgba;     /* the next frame: transparent where it shows what was there before */
} Apng;

/* False, with nothing to close, without memory or when the file cannot be written. */
bool Apng_Open(Apng* apng, const char* path, int32_t width, int32_t height, int32_t frameCount);

/* The image has the size given before, and stays for `delay` sixtieths of a second. A pixel may be seen off by 2 in
   255: one that changes by so little is not stored. */
bool Apng_Add(Apng* apng, const Image* image, int32_t delay);

/* False when frames are missing, or when anything could not be written. Closes in any case; again, it does nothing. */
bool Apng_Close(Apng* apng);

#ifdef __cplusplus
}
#endif

#endif
