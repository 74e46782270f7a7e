#include "../canvas_parts.h"

#include <GL/gl.h>
#include <SDL2/SDL_ttf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define CAPITAL 0.729f /* height of a capital of DejaVu Sans, in sizes of the font */

/* Opened once. Null: there is none, and one line said so. */
static TTF_Font* GetFont(void)
{
    static const char* const paths[] = { "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                         "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                         "/usr/share/fonts/TTF/DejaVuSans.ttf" };
    static TTF_Font* font;
    static bool isTried;
    if (isTried || TTF_Init() != 0) {
        return font;
    }
    isTried = true;
    const char* named = getenv("KIRI_FONT");
    font = named != NULL ? TTF_OpenFont(named, 16) : NULL;
    for (size_t i = 0; font == NULL && i < sizeof paths / sizeof paths[0]; i++) {
        font = TTF_OpenFont(paths[i], 16);
    }
    if (font == NULL) {
        fprintf(stderr, "no DejaVuSans.ttf (Debian: fonts-dejavu-core): no texts. KIRI_FONT=file names another font\n");
    }
    return font;
}

void OverlayText_Draw(const OverlayText* text, float scale)
{
    TTF_Font* font = GetFont();
    const SDL_Color color = { (uint8_t)(255.0f * text->color.red), (uint8_t)(255.0f * text->color.green),
                              (uint8_t)(255.0f * text->color.blue),
                              (uint8_t)(255.0f * fmaxf(0.0f, fminf(1.0f, text->color.alpha))) };
    if (font == NULL || text->words[0] == 0 || color.a == 0 ||
        TTF_SetFontSize(font, (int)lroundf(text->size * scale / CAPITAL)) != 0) {
        return;
    }
    SDL_Surface* drawn = TTF_RenderUTF8_Blended(font, text->words, color);
    if (drawn == NULL) {
        return;
    }
    float left = text->x * scale - text->align * (float)drawn->w;
    float top = (text->y + text->size) * scale - (float)TTF_FontAscent(font);
    glRasterPos2f(0.0f, 0.0f);
    glBitmap(0, 0, 0.0f, 0.0f, roundf(left), -roundf(top), NULL); /* moves, also to where nothing is seen */
    glPixelZoom(1.0f, -1.0f);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, drawn->pitch / 4);
    glDrawPixels(drawn->w, drawn->h, GL_BGRA, GL_UNSIGNED_BYTE, drawn->pixels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelZoom(1.0f, 1.0f);
    SDL_FreeSurface(drawn);
}

void Image_WriteText(Image* image, const char* words, int32_t size, int32_t left, int32_t top, const uint8_t color[3])
{
    TTF_Font* font = GetFont();
    SDL_Surface* drawn = NULL;
    if (font != NULL && TTF_SetFontSize(font, size) == 0) {
        drawn = TTF_RenderUTF8_Blended(font, words, (SDL_Color){ color[0], color[1], color[2], 255 });
    }
    for (int32_t i = 0; drawn != NULL && i < drawn->w * drawn->h; i++) {
        int32_t x = left + i % drawn->w, y = top + i / drawn->w;
        const uint8_t* from = (const uint8_t*)drawn->pixels + drawn->pitch * (i / drawn->w) + 4 * (i % drawn->w);
        uint8_t* to = image->rgb + 3 * (image->width * y + x);
        for (int k = 0; k < 3 && x < image->width && y < image->height; k++) {
            to[k] = (uint8_t)(to[k] + (color[k] - to[k]) * from[3] / 255);
        }
    }
    SDL_FreeSurface(drawn);
}
