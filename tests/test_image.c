/* An animated PNG is what its specification says, and its frames show what was drawn. */
#include "../samples/image.h"
#include "support.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { WIDTH = 128, HEIGHT = 64, BYTES = 3 * WIDTH * HEIGHT, FRAMES = 3, DELAY = 4, MAX_FILE = 1 << 17 };

static char filePath[1024];                   /* beside the program */
static const int steps[FRAMES] = { 0, 2, 4 }; /* how much lighter than the first frame; 2 is not stored */

/* Noise, which takes more than one data chunk. Later frames are a little lighter, and their upper rows new. */
static void Draw(Image* image, int frame)
{
    for (int i = 0; i < BYTES; i++) {
        bool upper = i < BYTES / 2;
        uint32_t noise = (uint32_t)(i + (upper ? frame * BYTES : 0)) * 2654435761u;
        noise = (noise ^ noise >> 15) * 2246822519u;
        image->rgb[i] = (uint8_t)((noise >> 16) % 250 + (uint32_t)(upper ? 0 : steps[frame]));
    }
}

static void WriteFilm(void)
{
    SCOPED(Image, image, Image_Free);
    Apng apng;
    assert_true(Image_Create(&image, WIDTH, HEIGHT));
    assert_true(Apng_Open(&apng, filePath, WIDTH, HEIGHT, FRAMES));
    for (int k = 0; k < FRAMES; k++) {
        Draw(&image, k);
        assert_true(Apng_Add(&apng, &image, DELAY + k));
    }
    assert_true(Apng_Close(&apng));
}

static size_t ReadFile(uint8_t* bytes)
{
    FILE* file = fopen(filePath, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, MAX_FILE, file);
    assert_true(size < MAX_FILE);
    fclose(file);
    return size;
}

static uint32_t Number(const uint8_t* bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static bool Is(const uint8_t* chunk, const char* type)
{
    return memcmp(chunk + 4, type, 4) == 0;
}

/* What the chunks of a file must agree on. */
typedef struct Walk {
    uint32_t chunks, sequence, frames, data; /* data chunks of the frame */
} Walk;

static void CheckControl(Walk* walk, const uint8_t* chunk)
{
    const uint8_t* fields = chunk + 8;
    assert_int_equal(Number(chunk), 26);
    assert_int_equal(Number(fields), walk->sequence++);
    assert_int_equal(Number(fields + 4), WIDTH);
    assert_int_equal(Number(fields + 8), HEIGHT);
    assert_int_equal(Number(fields + 12), 0);
    assert_int_equal(Number(fields + 16), 0);
    assert_int_equal(Number(fields + 20), (DELAY + walk->frames) << 16 | 60);
    assert_int_equal(fields[24], 0);
    assert_int_equal(fields[25], walk->frames > 0);
    assert_true(walk->frames == 0 || walk->data > 0);
    walk->frames++;
    walk->data = 0;
}

static void CheckData(Walk* walk, const uint8_t* chunk)
{
    assert_true(Is(chunk, walk->frames == 1 ? "IDAT" : "fdAT"));
    if (walk->frames > 1) {
        assert_int_equal(Number(chunk + 8), walk->sequence++);
    }
    walk->data++;
}

static void CheckChunk(Walk* walk, const uint8_t* chunk)
{
    assert_int_equal(Number(chunk + 8 + Number(chunk)), crc32(0, chunk + 4, Number(chunk) + 4));
    if (walk->chunks < 2) {
        assert_true(Is(chunk, walk->chunks == 0 ? "IHDR" : "acTL"));
    } else if (Is(chunk, "fcTL")) {
        CheckControl(walk, chunk);
    } else if (!Is(chunk, "IEND")) {
        CheckData(walk, chunk);
    }
    walk->chunks++;
}

TEST(Chunks)
{
    static uint8_t bytes[MAX_FILE];
    WriteFilm();
    size_t size = ReadFile(bytes), at = 8;
    Walk walk = { .chunks = 0 };
    const uint8_t* last = NULL;
    while (at < size) {
        assert_true(at + 12 <= size && at + 12 + Number(bytes + at) <= size);
        last = bytes + at;
        CheckChunk(&walk, last);
        at += 12 + Number(last);
    }
    const uint8_t* animation = bytes + 8 + 12 + 13;
    assert_int_equal(Number(animation), 8);
    assert_int_equal(Number(animation + 8), FRAMES);
    assert_int_equal(Number(animation + 12), 0); /* round without end */
    assert_int_equal(walk.frames, FRAMES);
    assert_true(walk.data > 0 && walk.sequence > 2 * FRAMES - 1); /* some frame has more than one data chunk */
    assert_true(last != NULL && Is(last, "IEND") && Number(last) == 0);
}

/* A program that does not know animated PNG sees the first frame. */
TEST(FirstFrame)
{
    static uint8_t seen[BYTES];
    SCOPED(Image, drawn, Image_Free);
    png_image png;
    WriteFilm();
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    assert_true(png_image_begin_read_from_file(&png, filePath));
    assert_true(png.width == WIDTH && png.height == HEIGHT && png.format == PNG_FORMAT_RGBA);
    png.format = PNG_FORMAT_RGB;
    assert_true(png_image_finish_read(&png, NULL, seen, 0, NULL));
    assert_int_equal(png.warning_or_error, 0);
    assert_true(Image_Create(&drawn, WIDTH, HEIGHT));
    Draw(&drawn, 0);
    assert_memory_equal(seen, drawn.rgb, BYTES);
}

static uint8_t* PutChunk(uint8_t* to, const char* type, const uint8_t* data, uint32_t size)
{
    const uint32_t numbers[2] = { size, (uint32_t)crc32(crc32(0, (const uint8_t*)type, 4), data, size) };
    memcpy(to + 4, type, 4);
    memcpy(to + 8, data, size);
    for (int i = 0; i < 4; i++) {
        to[i] = (uint8_t)(numbers[0] >> (24 - 8 * i));
        to[8 + size + i] = (uint8_t)(numbers[1] >> (24 - 8 * i));
    }
    return to + 12 + size;
}

/* The data of a frame as a PNG file of its own; returns its size. */
static size_t TakeFrame(const uint8_t* film, size_t size, int frame, uint8_t* png)
{
    uint8_t* to = png + 8 + 12 + 13;
    memcpy(png, film, 8 + 12 + 13); /* signature and header */
    int passed = -1;
    for (size_t at = 8; at < size; at += 12 + Number(film + at)) {
        const uint8_t* chunk = film + at;
        passed += Is(chunk, "fcTL");
        if (passed == frame && (Is(chunk, "IDAT") || Is(chunk, "fdAT"))) {
            uint32_t skip = frame > 0 ? 4 : 0;
            to = PutChunk(to, "IDAT", chunk + 8 + skip, Number(chunk) - skip);
        }
    }
    return (size_t)(PutChunk(to, "IEND", png, 0) - png);
}

static void GoOver(uint8_t* shown, const uint8_t* rgba)
{
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(rgba[4 * i + 3] == 0 || rgba[4 * i + 3] == 255);
        if (rgba[4 * i + 3] == 255) {
            memcpy(shown + 3 * i, rgba + 4 * i, 3);
        }
    }
}

/* One over the other, all frames show what was drawn but for 2 in 255, and these do not add up. */
TEST(AllFrames)
{
    static uint8_t film[MAX_FILE], file[MAX_FILE], rgba[4 * WIDTH * HEIGHT], shown[BYTES];
    static const int seen[FRAMES] = { 0, 0, 2 }; /* of which frame the lower rows are */
    Image drawn, lower;
    WriteFilm();
    size_t size = ReadFile(film);
    assert_true(Image_Create(&drawn, WIDTH, HEIGHT) && Image_Create(&lower, WIDTH, HEIGHT));
    for (int k = 0; k < FRAMES; k++) {
        png_image png;
        memset(&png, 0, sizeof png);
        png.version = PNG_IMAGE_VERSION;
        assert_true(png_image_begin_read_from_memory(&png, file, TakeFrame(film, size, k, file)));
        png.format = PNG_FORMAT_RGBA;
        assert_true(png_image_finish_read(&png, NULL, rgba, 0, NULL));
        assert_int_equal(rgba[4 * WIDTH * HEIGHT - 1], k == 1 ? 0 : 255); /* the last pixel */
        GoOver(shown, rgba);
        Draw(&drawn, k);
        Draw(&lower, seen[k]);
        assert_memory_equal(shown + BYTES / 2, lower.rgb + BYTES / 2, BYTES / 2);
        for (int i = 0; i < BYTES / 2; i++) {
            assert_true(abs(shown[i] - drawn.rgb[i]) <= 2);
        }
    }
    Image_Free(&drawn);
    Image_Free(&lower);
}

TEST(Refusals)
{
    SCOPED(Image, image, Image_Free);
    Apng apng;
    assert_true(Image_Create(&image, WIDTH, HEIGHT));
    assert_false(Apng_Open(&apng, "build/no such folder/film.png", WIDTH, HEIGHT, 1));
    assert_false(Apng_Close(&apng));
    assert_true(Apng_Open(&apng, filePath, WIDTH, HEIGHT, 1));
    assert_true(Apng_Add(&apng, &image, DELAY));
    assert_false(Apng_Add(&apng, &image, DELAY)); /* one too many: not stored */
    assert_true(Apng_Close(&apng));
    assert_true(Apng_Open(&apng, filePath, WIDTH, HEIGHT, 2));
    assert_true(Apng_Add(&apng, &image, DELAY));
    assert_false(Apng_Close(&apng)); /* one is missing */
}

static void RemoveFile(void)
{
    remove(filePath);
}

SETUP
{
    snprintf(filePath, sizeof filePath, "%s.png", words[0]);
    atexit(RemoveFile);
}
