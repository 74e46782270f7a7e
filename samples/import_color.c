/* Colours as CSS writes them. */
#include "import_parts.h"

#include <math.h>
#include <string.h>

/* The names of CSS, small letters, each with its hexadecimal digits. */
static const char names[] =
    "aliceblue f0f8ff antiquewhite faebd7 aqua 00ffff aquamarine 7fffd4 azure f0ffff beige f5f5dc bisque ffe4c4 "
    "black 000000 blanchedalmond ffebcd blue 0000ff blueviolet 8a2be2 brown a52a2a burlywood deb887 "
    "cadetblue 5f9ea0 chartreuse 7fff00 chocolate d2691e coral ff7f50 cornflowerblue 6495ed cornsilk fff8dc "
    "crimson dc143c cyan 00ffff darkblue 00008b darkcyan 008b8b darkgoldenrod b8860b darkgray a9a9a9 "
    "darkgreen 006400 darkgrey a9a9a9 darkkhaki bdb76b darkmagenta 8b008b darkolivegreen 556b2f "
    "darkorange ff8c00 darkorchid 9932cc darkred 8b0000 darksalmon e9967a darkseagreen 8fbc8f "
    "darkslateblue 483d8b darkslategray 2f4f4f darkslategrey 2f4f4f darkturquoise 00ced1 darkviolet 9400d3 "
    "deeppink ff1493 deepskyblue 00bfff dimgray 696969 dimgrey 696969 dodgerblue 1e90ff firebrick b22222 "
    "floralwhite fffaf0 forestgreen 228b22 fuchsia ff00ff gainsboro dcdcdc ghostwhite f8f8ff gold ffd700 "
    "goldenrod daa520 gray 808080 green 008000 greenyellow adff2f grey 808080 honeydew f0fff0 hotpink ff69b4 "
    "indianred cd5c5c indigo 4b0082 ivory fffff0 khaki f0e68c lavender e6e6fa lavenderblush fff0f5 "
    "lawngreen 7cfc00 lemonchiffon fffacd lightblue add8e6 lightcoral f08080 lightcyan e0ffff "
    "lightgoldenrodyellow fafad2 lightgray d3d3d3 lightgreen 90ee90 lightgrey d3d3d3 lightpink ffb6c1 "
    "lightsalmon ffa07a lightseagreen 20b2aa lightskyblue 87cefa lightslategray 778899 lightslategrey 778899 "
    "lightsteelblue b0c4de lightyellow ffffe0 lime 00ff00 limegreen 32cd32 linen faf0e6 magenta ff00ff "
    "maroon 800000 mediumaquamarine 66cdaa mediumblue 0000cd mediumorchid ba55d3 mediumpurple 9370db "
    "mediumseagreen 3cb371 mediumslateblue 7b68ee mediumspringgreen 00fa9a mediumturquoise 48d1cc "
    "mediumvioletred c71585 midnightblue 191970 mintcream f5fffa mistyrose ffe4e1 moccasin ffe4b5 "
    "navajowhite ffdead navy 000080 oldlace fdf5e6 olive 808000 olivedrab 6b8e23 orange ffa500 orangered ff4500 "
    "orchid da70d6 palegoldenrod eee8aa palegreen 98fb98 paleturquoise afeeee palevioletred db7093 "
    "papayawhip ffefd5 peachpuff ffdab9 peru cd853f pink ffc0cb plum dda0dd powderblue b0e0e6 purple 800080 "
    "rebeccapurple 663399 red ff0000 rosybrown bc8f8f royalblue 4169e1 saddlebrown 8b4513 salmon fa8072 "
    "sandybrown f4a460 seagreen 2e8b57 seashell fff5ee sienna a0522d silver c0c0c0 skyblue 87ceeb "
    "slateblue 6a5acd slategray 708090 slategrey 708090 snow fffafa springgreen 00ff7f steelblue 4682b4 "
    "tan d2b48c teal 008080 thistle d8bfd8 tomato ff6347 turquoise 40e0d0 violet ee82ee wheat f5deb3 "
    "white ffffff whitesmoke f5f5f5 yellow ffff00 yellowgreen 9acd32 ";

static int GetDigit(char c)
{
    const char *digits = "0123456789abcdef", *at = c != 0 ? strchr(digits, c >= 'A' && c <= 'F' ? c + 32 : c) : NULL;
    return at != NULL ? (int)(at - digits) : 0;
}

/* #rgb, #rgba, #rrggbb, #rrggbbaa. */
static void ReadDigits(Span text, int rgba[4])
{
    bool isShort = text.length < 7;
    for (int32_t k = 0; k < 4; k++) {
        int32_t at = isShort ? 1 + k : 1 + 2 * k;
        if (at < text.length) {
            int high = GetDigit(text.at[at]);
            rgba[k] = 16 * high + (isShort || at + 1 == text.length ? high : GetDigit(text.at[at + 1]));
        }
    }
}

/* Hue in degrees, saturation and lightness from 0 to 1. */
static void TurnHue(const double hsl[3], int rgba[4])
{
    for (int k = 0; k < 3; k++) {
        double turn = fmod(fmod(hsl[0] / 30.0 + (k == 0 ? 0.0 : k == 1 ? 8.0 : 4.0), 12.0) + 12.0, 12.0);
        double way = hsl[1] * fmin(hsl[2], 1.0 - hsl[2]) * fmax(fmin(fmin(turn - 3.0, 9.0 - turn), 1.0), -1.0);
        rgba[k] = (int)(255.0 * fmin(fmax(hsl[2] - way, 0.0), 1.0) + 0.5);
    }
}

/* rgb(), rgba(), hsl() and hsla(), with commas, spaces or a slash. */
static bool ReadFunction(Span text, int rgba[4])
{
    const char *at = memchr(text.at, '(', (size_t)text.length), *end = text.at + text.length;
    bool isHue = Span_Holds((Span){ text.at, 3 }, "hsl");
    double n[4] = { 0.0, 0.0, 0.0, 1.0 };
    int count = 0;
    for (at = at != NULL ? at + 1 : end; at < end && count < 4;) {
        const char* next = Import_ReadNumber(at, end, &n[count]);
        if (next == NULL) {
            at++;
            continue;
        }
        if (next < end && *next == '%') {
            n[count] *= count < 3 && !isHue ? 2.55 : 0.01;
        }
        count++;
        at = next;
    }
    if (isHue) {
        TurnHue(n, rgba);
    }
    for (int k = isHue ? 3 : 0; k < 4; k++) {
        rgba[k] = (int)(fmin(fmax(k < 3 ? n[k] : 255.0 * n[k], 0.0), 255.0) + 0.5);
    }
    return count >= 3;
}

bool Import_ReadColor(Span text, int rgba[4])
{
    memcpy(rgba, (const int[4]){ 0, 0, 0, 255 }, 4 * sizeof(int));
    if (text.length > 3 && text.at[0] == '#') {
        ReadDigits(text, rgba);
        return true;
    }
    if (text.length > 4 && (Span_Holds((Span){ text.at, 3 }, "rgb") || Span_Holds((Span){ text.at, 3 }, "hsl"))) {
        return ReadFunction(text, rgba);
    }
    char name[24];
    if (text.length >= (int32_t)sizeof name - 1) {
        return false;
    }
    for (int32_t i = 0; i < text.length; i++) {
        name[i] = (char)(text.at[i] >= 'A' && text.at[i] <= 'Z' ? text.at[i] + 32 : text.at[i]);
    }
    memcpy(name + text.length, " ", 2);
    const char* found = text.length > 0 ? strstr(names, name) : NULL;
    while (found != NULL && found != names && found[-1] != ' ') { /* "red" in "darkred" */
        found = strstr(found + 1, name);
    }
    for (int k = 0; k < 3 && found != NULL; k++) {
        rgba[k] = 16 * GetDigit(found[text.length + 1 + 2 * k]) + GetDigit(found[text.length + 2 + 2 * k]);
    }
    return found != NULL;
}

/* Whether a colour is clearly the first of three. */
static bool Leads(int a, int b, int c)
{
    return a >= 90 && 2 * b <= a && 2 * c <= a;
}

int32_t Import_UseOfColor(const int rgb[3])
{
    int r = rgb[0], g = rgb[1], b = rgb[2];
    return r > 240 && g > 240 && b > 240                        ? IMPORT_NONE
           : Leads(r, g, b) || (r >= 150 && g < 110 && b < 110) ? IMPORT_MOUNTAIN
           : Leads(b, r, g) || (b >= 110 && r < 110 && g < 150) ? IMPORT_VALLEY
           : Leads(g, r, b) || (g >= 110 && r < 110 && b < 110) ? IMPORT_SCORE
                                                                : IMPORT_CUT;
}
