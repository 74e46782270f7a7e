/* Pictures in memory and as PNG files. */
#ifndef IMAGE_H
#define IMAGE_H

#include <stdbool.h>
#include <stdint.h>

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

#endif
