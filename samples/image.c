#include "image.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

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

static void CopyPixels(Image* image, const uint8_t* source, int32_t sourceWidth, int32_t channels)
{
    uint8_t* to = image->rgb;
    for (int32_t y = 0; y < image->height; y++) {
        const uint8_t* from = source + (size_t)y * (size_t)sourceWidth * (size_t)channels;
        for (int32_t x = 0; x < image->width; x++, to += 3, from += channels) {
            to[0] = from[0];
            to[1] = from[1];
            to[2] = from[2];
        }
    }
}

void Image_Shrink(Image* image, const uint8_t* source, int32_t sourceWidth, int32_t channels, int32_t factor)
{
    if (factor == 1) {
        CopyPixels(image, source, sourceWidth, channels);
        return;
    }
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

static png_image DescribePng(const Image* image, png_uint_32 format)
{
    png_image png;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    png.width = (png_uint_32)image->width;
    png.height = (png_uint_32)image->height;
    png.format = format;
    return png;
}

bool Image_WritePng(const Image* image, const char* path)
{
    png_image png = DescribePng(image, PNG_FORMAT_RGB);
    return png_image_write_to_file(&png, path, 0, image->rgb, 0, NULL) != 0;
}

/* ---- Moving pictures -------------------------------------------------------------------------------------------- */

/* Chunks of the PNG specification, third edition: IHDR, acTL, then fcTL and the data of each frame, IEND. The data is
   what libpng makes of the frame as a picture of its own, under the name fdAT from the second frame on. */

enum { UNSEEN = 2, SIGNATURE_SIZE = 8, CHUNK_FRAME_SIZE = 12, MAX_DELAY = 65535 };

static void PutNumber(uint8_t* bytes, uint32_t number)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (uint8_t)(number >> (24 - 8 * i));
    }
}

static uint32_t GetNumber(const uint8_t* bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void WriteChunk(FILE* file, const char* type, const uint8_t* data, uint32_t size)
{
    uint8_t start[8], end[4];
    PutNumber(start, size);
    memcpy(start + 4, type, 4);
    PutNumber(end, (uint32_t)crc32(crc32(0, start + 4, 4), data, size));
    fwrite(start, sizeof start, 1, file);
    fwrite(data, 1, size, file);
    fwrite(end, sizeof end, 1, file);
}

static void WriteStart(const Apng* apng)
{
    static const uint8_t signature[SIGNATURE_SIZE] = { 137, 'P', 'N', 'G', '\r', '\n', 26, '\n' };
    uint8_t header[13] = { [8] = 8, [9] = PNG_COLOR_TYPE_RGB_ALPHA }, animation[8] = { 0 };
    PutNumber(header, (uint32_t)apng->shown.width);
    PutNumber(header + 4, (uint32_t)apng->shown.height);
    PutNumber(animation, (uint32_t)apng->frameCount);
    fwrite(signature, sizeof signature, 1, apng->file);
    WriteChunk(apng->file, "IHDR", header, sizeof header);
    WriteChunk(apng->file, "acTL", animation, sizeof animation);
}

/* The frame covers all of the picture, and from the second on goes over what is there. */
static void WriteControl(Apng* apng, int32_t delay)
{
    uint8_t control[26] = { 0 };
    PutNumber(control, apng->sequence++);
    PutNumber(control + 4, (uint32_t)apng->shown.width);
    PutNumber(control + 8, (uint32_t)apng->shown.height);
    PutNumber(control + 20, (uint32_t)(delay < MAX_DELAY ? delay : MAX_DELAY) << 16 | 60);
    control[25] = apng->added > 0;
    WriteChunk(apng->file, "fcTL", control, sizeof control);
}

/* The data chunks of a picture in memory. In fdAT the sequence number comes first: it goes where the name IDAT was. */
static void WriteData(Apng* apng, uint8_t* png, size_t size)
{
    for (size_t at = SIGNATURE_SIZE; at + CHUNK_FRAME_SIZE <= size; at += CHUNK_FRAME_SIZE + GetNumber(png + at)) {
        uint8_t* name = png + at + 4;
        if (memcmp(name, "IDAT", 4) != 0) {
            continue;
        } else if (apng->added == 0) {
            WriteChunk(apng->file, "IDAT", name + 4, GetNumber(png + at));
        } else {
            PutNumber(name, apng->sequence++);
            WriteChunk(apng->file, "fdAT", name, GetNumber(png + at) + 4);
        }
    }
}

static bool IsSeen(const uint8_t* pixel, const uint8_t* shown)
{
    return abs(pixel[0] - shown[0]) > UNSEEN || abs(pixel[1] - shown[1]) > UNSEEN || abs(pixel[2] - shown[2]) > UNSEEN;
}

static void TakeChanges(Apng* apng, const Image* image)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    memset(apng->rgba, 0, 4 * pixels);
    for (size_t i = 0; i < pixels; i++) {
        const uint8_t* pixel = image->rgb + 3 * i;
        if (apng->added == 0 || IsSeen(pixel, apng->shown.rgb + 3 * i)) {
            memcpy(apng->shown.rgb + 3 * i, pixel, 3);
            memcpy(apng->rgba + 4 * i, pixel, 3);
            apng->rgba[4 * i + 3] = 255;
        }
    }
}

bool Apng_Open(Apng* apng, const char* path, int32_t width, int32_t height, int32_t frameCount)
{
    *apng = (Apng){ .frameCount = frameCount };
    apng->rgba = malloc(4 * (size_t)width * (size_t)height);
    bool fine = Image_Create(&apng->shown, width, height) && apng->rgba != NULL;
    apng->file = fine ? fopen(path, "wb") : NULL;
    if (apng->file == NULL) {
        Apng_Close(apng);
        return false;
    }
    WriteStart(apng);
    return true;
}

bool Apng_Add(Apng* apng, const Image* image, int32_t delay)
{
    png_image png = DescribePng(image, PNG_FORMAT_RGBA);
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    uint8_t* bytes = apng->added < apng->frameCount ? malloc(size) : NULL;
    if (bytes == NULL) {
        return false;
    }
    TakeChanges(apng, image);
    bool fine = png_image_write_to_memory(&png, bytes, &size, 0, apng->rgba, 0, NULL) != 0;
    if (fine) {
        WriteControl(apng, delay);
        WriteData(apng, bytes, size);
        apng->added++;
    }
    free(bytes);
    return fine && !ferror(apng->file);
}

bool Apng_Close(Apng* apng)
{
    bool fine = apng->file != NULL && apng->added == apng->frameCount;
    if (apng->file != NULL) {
        WriteChunk(apng->file, "IEND", (const uint8_t*)"", 0);
        fine = !ferror(apng->file) && fine;
        fine = fclose(apng->file) == 0 && fine;
    }
    Image_Free(&apng->shown);
    free(apng->rgba);
    *apng = (Apng){ .file = NULL };
    return fine;
}
