#include "image.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

bool Image_Create(Image* image, int32_t width, int32_t height)
{
    size_t bytes = 3 * (size_t)width * (size_t)height;
    *image = (Image){ width, height, malloc(bytes) };
    if (image->rgb != NULL) {
        memset(image->rgb, 255, bytes);
    }
    return image->rgb != NULL;
}

void Image_Free(Image* image)
{
    free(image->rgb);
    *image = (Image){ 0, 0, NULL };
}

void Image_Shrink(Image* image, const uint8_t* source, int32_t sourceWidth, int32_t channels, int32_t factor)
{
    for (int32_t i = 0; i < image->width * image->height; i++) {
        int32_t x = i % image->width * factor, y = i / image->width * factor;
        for (int32_t c = 0; c < 3; c++) {
            int32_t sum = 0;
            for (int32_t k = 0; k < factor * factor; k++) {
                sum += source[((y + k / factor) * sourceWidth + x + k % factor) * channels + c];
            }
            image->rgb[3 * i + c] = (uint8_t)(sum / (factor * factor));
        }
    }
}

void Image_Paste(Image* image, const Image* part, int32_t left, int32_t top)
{
    for (int32_t y = 0; y < part->height; y++) {
        memcpy(image->rgb + 3 * ((top + y) * image->width + left), part->rgb + 3 * y * part->width,
               3 * (size_t)part->width);
    }
}

bool Image_WritePng(const Image* image, const char* path)
{
    png_image png;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    png.width = (png_uint_32)image->width;
    png.height = (png_uint_32)image->height;
    png.format = PNG_FORMAT_RGB;
    return png_image_write_to_file(&png, path, 0, image->rgb, 0, NULL) != 0;
}
