#include "debug.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = RASTER_SIZE, SQUARES = RASTER_SIZE * RASTER_SIZE, MAX_WEIGHTS = 64 };

bool Debug_Create(Debug* debug)
{
    *debug = (Debug){ .frameCount = 0 };
    Raster* raster = &debug->raster;
    raster->triangles = malloc(SQUARES * sizeof(int32_t));
    raster->owners = malloc(SQUARES * sizeof(int32_t));
    raster->colors = malloc(3 * SQUARES);
    return raster->triangles != NULL && raster->owners != NULL && raster->colors != NULL;
}

void Debug_Destroy(Debug* debug)
{
    free(debug->raster.triangles);
    free(debug->raster.owners);
    free(debug->raster.colors);
    Lines_Free(&debug->lines);
    *debug = (Debug){ .frameCount = 0 };
}

bool Debug_IsWanted(const DebugOptions* options)
{
    return options->weightsOf != DEBUG_NO_FRAME || options->regions || options->links || options->cells;
}

bool Debug_DrawLines(Debug* debug, const Scene* scene, const DebugOptions* options)
{
    const uint32_t around = KIRI_DRAW_CONTACTS | KIRI_DRAW_OBSTACLES | KIRI_DRAW_PINS | KIRI_DRAW_BLADES;
    const struct {
        bool wanted;
        uint32_t flags;
        int kinds;
    } all[] = { { options->points, KIRI_DRAW_POINTS, LINES_POINTS },
                { options->links, KIRI_DRAW_LINKS, LINES_LINES },
                { options->links, KIRI_DRAW_FRAMES, LINES_POINTS },
                { options->axes, KIRI_DRAW_FRAMES, LINES_LINES },
                { options->contacts, around, LINES_POINTS | LINES_LINES } };
    bool fine = true;
    Lines_Clear(&debug->lines);
    for (size_t i = 0; fine && i < sizeof all / sizeof all[0]; i++) {
        fine = !all[i].wanted || Lines_Add(&debug->lines, scene->world, all[i].flags == around ? 0 : scene->sheet,
                                           all[i].flags, 0.05f * scene->type->size, all[i].kinds);
    }
    return fine;
}

/* ---- Triangles -------------------------------------------------------------------------------------------------- */

static void GetMiddle(const Raster* raster, int32_t square, float point[2])
{
    point[0] = raster->origin[0] + raster->side * ((float)(square % SIZE) + 0.5f);
    point[1] = raster->origin[1] + raster->side * ((float)(square / SIZE) + 0.5f);
}

/* Two squares of margin, so that the picture's filter finds colour beyond the outline. */
static void PlaceRaster(Raster* raster, const kiriMesh* mesh)
{
    float low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (int32_t i = 0; i < 2 * mesh->vertexCount; i++) {
        low[i % 2] = fminf(low[i % 2], mesh->restPositions[i]);
        high[i % 2] = fmaxf(high[i % 2], mesh->restPositions[i]);
    }
    raster->side = fmaxf(high[0] - low[0], high[1] - low[1]) / (SIZE - 4);
    raster->origin[0] = low[0] - 2.0f * raster->side;
    raster->origin[1] = low[1] - 2.0f * raster->side;
}

/* Barycentric coordinates of a rest point in a triangle; false outside of it. */
static bool GetShares(const kiriMesh* mesh, int32_t triangle, const float point[2], float shares[3])
{
    const int32_t* corners = mesh->indices + 3 * triangle;
    double area = 0.0, parts[3];
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        const float* a = mesh->restPositions + 2 * corners[(i + 1) % 3];
        const float* b = mesh->restPositions + 2 * corners[(i + 2) % 3];
        parts[i] =
            ((double)b[0] - a[0]) * ((double)point[1] - a[1]) - ((double)b[1] - a[1]) * ((double)point[0] - a[0]);
        inside = inside && parts[i] >= 0.0;
        area += parts[i];
    }
    for (int i = 0; i < 3; i++) {
        shares[i] = (float)(parts[i] / area);
    }
    return inside;
}

static int32_t Clamp(float x)
{
    return x < 0.0f ? 0 : x > SIZE - 1 ? SIZE - 1 : (int32_t)x;
}

static void FillTriangle(Raster* raster, const kiriMesh* mesh, int32_t triangle)
{
    float low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (int i = 0; i < 6; i++) {
        int c = i % 2;
        float x = (mesh->restPositions[2 * mesh->indices[3 * triangle + i / 2] + c] - raster->origin[c]) / raster->side;
        low[c] = fminf(low[c], x);
        high[c] = fmaxf(high[c], x);
    }
    for (int32_t row = Clamp(low[1] - 1.0f); row <= Clamp(high[1]); row++) {
        for (int32_t column = Clamp(low[0] - 1.0f); column <= Clamp(high[0]); column++) {
            float point[2], shares[3];
            GetMiddle(raster, row * SIZE + column, point);
            if (GetShares(mesh, triangle, point, shares)) {
                raster->triangles[row * SIZE + column] = triangle;
            }
        }
    }
}

static void FindTriangles(Raster* raster, const kiriMesh* mesh)
{
    memset(raster->triangles, 0xff, SQUARES * sizeof(int32_t));
    for (int32_t i = 0; i < mesh->triangleCount; i++) {
        FillTriangle(raster, mesh, i);
    }
}

/* Whether the material goes on from one square to its neighbour: the lips of a cut have no vertex in common. */
static bool AreJoined(const Raster* raster, const kiriMesh* mesh, int32_t a, int32_t b)
{
    int32_t s = raster->triangles[a], t = raster->triangles[b];
    bool joined = s == t;
    for (int i = 0; i < 9 && !joined && s >= 0 && t >= 0; i++) {
        joined = mesh->indices[3 * s + i / 3] == mesh->indices[3 * t + i % 3];
    }
    return joined && s >= 0;
}

/* ---- Weights and regions ---------------------------------------------------------------------------------------- */

static void SetColor(uint8_t* pixel, const float color[3])
{
    for (int c = 0; c < 3; c++) {
        pixel[c] = (uint8_t)(255.0f * fminf(fmaxf(color[c], 0.0f), 1.0f));
    }
}

/* A colour of its own for every frame: hues by the golden ratio. */
static void ColorOfFrame(int32_t frame, float color[3])
{
    float hue = fmodf(0.58f + 0.61803399f * (float)frame, 1.0f) * 6.0f;
    for (int i = 0; i < 3; i++) {
        float distance = fabsf(fmodf(hue + 6.0f - 2.0f * (float)i, 6.0f) - 3.0f);
        color[i] = 0.34f + 0.60f * fminf(fmaxf(distance - 1.0f, 0.0f), 1.0f);
    }
}

/* From blue by white to red, with a dark line at every tenth. */
static void ColorOfWeight(float weight, float color[3])
{
    static const float ramp[5][3] = { { 0.20f, 0.32f, 0.66f },
                                      { 0.52f, 0.76f, 0.89f },
                                      { 0.97f, 0.97f, 0.86f },
                                      { 0.97f, 0.63f, 0.35f },
                                      { 0.75f, 0.12f, 0.16f } };
    float x = 4.0f * fminf(fmaxf(weight, 0.0f), 0.9999f), tenth = fabsf(10.0f * weight - roundf(10.0f * weight));
    int step = (int)x;
    bool line = tenth < 0.06f && weight > 0.05f && weight < 0.95f;
    for (int c = 0; c < 3; c++) {
        float plain = ramp[step][c] + (x - (float)step) * (ramp[step + 1][c] - ramp[step][c]);
        color[c] = line ? 0.6f * plain : plain;
    }
}

static int32_t NumberOf(const Debug* debug, kiriFrame frame)
{
    int32_t number = 0;
    while (number < debug->frameCount && debug->frames[number] != frame) {
        number++;
    }
    return number;
}

static void AskSquare(Debug* debug, const Scene* scene, int32_t square, int32_t weightsOf)
{
    Raster* raster = &debug->raster;
    kiriFrame frames[MAX_WEIGHTS];
    float point[2], weights[MAX_WEIGHTS], color[3] = { 0.0f, 0.0f, 0.0f }, largest = 0.0f, shown = 0.0f;
    int32_t count = 0;
    GetMiddle(raster, square, point);
    kiriSheet_GetWeights(scene->world, scene->sheet, point, frames, weights, NULL, MAX_WEIGHTS, &count);
    for (int32_t i = 0; i < count && i < MAX_WEIGHTS; i++) {
        int32_t number = NumberOf(debug, frames[i]);
        float own[3];
        ColorOfFrame(number, own);
        for (int c = 0; c < 3; c++) {
            color[c] += weights[i] * own[c];
        }
        shown += number == weightsOf ? weights[i] : 0.0f;
        if (weights[i] > largest) {
            largest = weights[i];
            raster->owners[square] = number;
        }
    }
    if (weightsOf >= 0) {
        ColorOfWeight(shown, color);
    }
    SetColor(raster->colors + 3 * square, color);
}

static void AskForWeights(Debug* debug, const Scene* scene, int32_t weightsOf)
{
    memset(debug->raster.owners, 0xff, SQUARES * sizeof(int32_t));
    kiriSheet_GetFrames(scene->world, scene->sheet, debug->frames, DEBUG_MAX_FRAMES, &debug->frameCount);
    debug->frameCount = debug->frameCount < DEBUG_MAX_FRAMES ? debug->frameCount : DEBUG_MAX_FRAMES;
    for (int32_t square = 0; square < SQUARES; square++) {
        if (debug->raster.triangles[square] >= 0) {
            AskSquare(debug, scene, square, weightsOf);
        }
    }
}

/* Where two regions meet, and the material goes on. */
static bool IsBorder(const Raster* raster, const kiriMesh* mesh, int32_t a, int32_t b)
{
    return raster->owners[a] >= 0 && raster->owners[b] >= 0 && raster->owners[a] != raster->owners[b] &&
           AreJoined(raster, mesh, a, b);
}

static void ColorRegions(Raster* raster, const kiriMesh* mesh)
{
    for (int32_t square = 0; square < SQUARES - SIZE; square++) {
        if (raster->owners[square] >= 0) {
            float color[3];
            ColorOfFrame(raster->owners[square], color);
            bool border = IsBorder(raster, mesh, square, square + 1) || IsBorder(raster, mesh, square, square + SIZE);
            SetColor(raster->colors + 3 * square, border ? (float[]){ 0.1f, 0.1f, 0.1f } : color);
        }
    }
}

/* ---- Cells ------------------------------------------------------------------------------------------------------ */

/* Marks the part of the material inside one grid square that is joined to a raster square; returns how large it is. */
static int32_t FloodCell(Raster* raster, const kiriMesh* mesh, const int32_t* cells, int32_t start, int32_t part,
                         int32_t* stack)
{
    int32_t depth = 0, count = 0;
    const int32_t steps[4] = { 1, -1, SIZE, -SIZE };
    stack[depth++] = start;
    raster->owners[start] = part;
    while (depth > 0) {
        int32_t square = stack[--depth];
        count++;
        for (int k = 0; k < 4; k++) {
            int32_t next = square + steps[k];
            if (cells[next] == cells[start] && raster->owners[next] < 0 && AreJoined(raster, mesh, square, next)) {
                raster->owners[next] = part;
                stack[depth++] = next;
            }
        }
    }
    return count;
}

static void ColorCell(Raster* raster, const int32_t* cells, int32_t square, int32_t part)
{
    static const float parts[4][3] = {
        { 0.93f, 0.92f, 0.88f }, { 0.95f, 0.58f, 0.25f }, { 0.35f, 0.62f, 0.85f }, { 0.45f, 0.72f, 0.42f }
    };
    bool edge = cells[square] != cells[square + 1] || cells[square] != cells[square + SIZE];
    SetColor(raster->colors + 3 * square, edge ? (float[]){ 0.45f, 0.47f, 0.5f } : parts[part % 4]);
}

/* Grid squares, and in another colour each further copy of one. A part of less than 3 % of its square is taken for
   the raster's doing. */
static bool ColorCells(Raster* raster, const kiriMesh* mesh, int32_t resolution)
{
    int32_t* cells = malloc(SQUARES * sizeof(int32_t));
    int32_t* stack = malloc(SQUARES * sizeof(int32_t));
    int32_t* parts = calloc((size_t)(resolution + 1) * (size_t)(resolution + 1), sizeof(int32_t));
    bool fine = cells != NULL && stack != NULL && parts != NULL;
    double width = (double)(SIZE - 4) / resolution;
    memset(raster->owners, 0xff, SQUARES * sizeof(int32_t));
    for (int32_t i = 0; fine && i < SQUARES; i++) {
        int32_t column = (int32_t)((i % SIZE - 2) / width), row = (int32_t)((i / SIZE - 2) / width);
        bool in = raster->triangles[i] >= 0 && column <= resolution && row <= resolution;
        cells[i] = in ? row * (resolution + 1) + column : -1;
    }
    for (int32_t i = 0; fine && i < SQUARES; i++) {
        if (cells[i] >= 0 && raster->owners[i] < 0) {
            int32_t count = FloodCell(raster, mesh, cells, i, parts[cells[i]], stack);
            parts[cells[i]] += count > 0.03 * width * width;
        }
    }
    for (int32_t i = 0; fine && i < SQUARES; i++) {
        if (cells[i] >= 0) {
            ColorCell(raster, cells, i, raster->owners[i]);
        }
    }
    free(cells);
    free(stack);
    free(parts);
    return fine;
}

/* ---- All of it -------------------------------------------------------------------------------------------------- */

/* Colours the margin as its neighbours are. */
static void SpreadColors(Raster* raster)
{
    const int32_t steps[4] = { 1, -1, SIZE, -SIZE };
    for (int32_t i = SIZE; i < SQUARES - SIZE; i++) {
        for (int k = 0; k < 4 && raster->triangles[i] < 0; k++) {
            if (raster->triangles[i + steps[k]] >= 0) {
                memcpy(raster->colors + 3 * i, raster->colors + 3 * (i + steps[k]), 3);
            }
        }
    }
}

/* Between cuts nothing changes in the rest plane. */
static bool UpdateRaster(Debug* debug, const Scene* scene, const kiriMesh* mesh, const DebugOptions* options)
{
    Raster* raster = &debug->raster;
    PlaceRaster(raster, mesh);
    FindTriangles(raster, mesh);
    if (options->cells) {
        return ColorCells(raster, mesh, scene->gridResolution);
    }
    AskForWeights(debug, scene, options->weightsOf);
    if (options->weightsOf == DEBUG_NO_FRAME) {
        ColorRegions(raster, mesh);
    }
    return true;
}

bool Debug_Update(Debug* debug, const Scene* scene, const kiriMesh* mesh, const DebugOptions* options)
{
    if (debug->raster.side == 0.0f || debug->raster.revision != mesh->revision) {
        if (!UpdateRaster(debug, scene, mesh, options)) {
            return false;
        }
        SpreadColors(&debug->raster);
        debug->raster.revision = mesh->revision;
    }
    return true;
}
