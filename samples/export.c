#include "export.h"

#include "import_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BORDER "B, border" /* as FOLD files are read */
#define CUT "C, cut"

/* A side of a triangle: its smaller end first, by number or by place. */
typedef struct Side {
    int32_t vertices[2];
    float ends[2][2];
} Side;

static int CompareVertices(const void* a, const void* b)
{
    const Side *x = a, *y = b;
    return memcmp(x->vertices, y->vertices, sizeof x->vertices);
}

static int CompareFloats(const float* x, const float* y, int count)
{
    for (int i = 0; i < count; i++) {
        if (x[i] != y[i]) {
            return x[i] < y[i] ? -1 : 1;
        }
    }
    return 0;
}

static int CompareEnds(const void* a, const void* b)
{
    return CompareFloats(&((const Side*)a)->ends[0][0], &((const Side*)b)->ends[0][0], 4);
}

/* Appends the sides that have a triangle on one side only. False without memory. */
static bool TakeSheet(const kiriMesh* mesh, Side** sides, int32_t* count)
{
    Side* all = malloc(sizeof(Side) * (3 * (size_t)mesh->triangleCount + 1));
    Side* grown = realloc(*sides, sizeof(Side) * ((size_t)*count + 3 * (size_t)mesh->triangleCount + 1));
    int32_t total = 0;
    *sides = grown != NULL ? grown : *sides;
    for (int32_t i = 0; i < 3 * mesh->triangleCount && all != NULL; i++) {
        int32_t a = mesh->indices[i], b = mesh->indices[i - i % 3 + (i + 1) % 3];
        if (a != b) { /* triangles of a removed piece have one corner thrice */
            Side side = { { a < b ? a : b, a < b ? b : a }, { { 0.0f, 0.0f }, { 0.0f, 0.0f } } };
            const float *p = &mesh->restPositions[2 * a], *q = &mesh->restPositions[2 * b];
            bool isFirst = CompareFloats(p, q, 2) < 0;
            memcpy(side.ends[0], isFirst ? p : q, sizeof side.ends[0]);
            memcpy(side.ends[1], isFirst ? q : p, sizeof side.ends[1]);
            all[total++] = side;
        }
    }
    bool isFine = all != NULL && grown != NULL;
    if (isFine) {
        qsort(all, (size_t)total, sizeof(Side), CompareVertices);
    }
    for (int32_t i = 0; i < total && isFine; i++) {
        bool isBefore = i > 0 && CompareVertices(&all[i - 1], &all[i]) == 0;
        bool isAfter = i + 1 < total && CompareVertices(&all[i], &all[i + 1]) == 0;
        if (!isBefore && !isAfter) {
            (*sides)[(*count)++] = all[i];
        }
    }
    free(all);
    return isFine;
}

bool Export_Take(const kiriWorld* world, const kiriSheet* sheets, int32_t count, Import* drawing)
{
    Side* sides = NULL;
    int32_t sideCount = 0;
    *drawing = (Import){ .tolerance = 0.02, .scale = 1000.0, .isSized = 1 };
    for (int32_t i = 0; i < count; i++) {
        kiriMesh mesh;
        if (kiriSheet_GetMesh(world, sheets[i], &mesh) < 0) {
            Import_Fail(drawing, "sheet %d is gone", i);
        } else if (!TakeSheet(&mesh, &sides, &sideCount)) {
            Import_Fail(drawing, "there is no memory for the drawing");
        }
    }
    int32_t border = Import_AddStyle(drawing, BORDER, IMPORT_CUT), cut = Import_AddStyle(drawing, CUT, IMPORT_CUT);
    if (sideCount > 0) {
        qsort(sides, (size_t)sideCount, sizeof(Side), CompareEnds);
    }
    for (int32_t i = 0; i < sideCount && drawing->error[0] == 0; i++) {
        bool hasTwin = i + 1 < sideCount && CompareEnds(&sides[i], &sides[i + 1]) == 0; /* the other lip */
        Import_Begin(drawing, hasTwin ? cut : border);
        Import_Add(drawing, (double)sides[i].ends[0][0], (double)sides[i].ends[0][1]);
        Import_Add(drawing, (double)sides[i].ends[1][0], (double)sides[i].ends[1][1]);
        Import_End(drawing, false);
        i += hasTwin;
    }
    free(sides);
    return drawing->error[0] == 0 && Import_Join(drawing, 1e-4);
}

bool Export_WriteSvg(const Import* drawing, FILE* file)
{
    static const char* const colors[] = { "none", "#000000", "#ff0000", "#0000ff", "#00ff00" };
    double lower[2] = { 1e300, 1e300 }, upper[2] = { -1e300, -1e300 };
    for (int32_t i = 0; i < 2 * drawing->pointCount; i++) {
        lower[i % 2] = fmin(lower[i % 2], drawing->points[i]);
        upper[i % 2] = fmax(upper[i % 2], drawing->points[i]);
    }
    double width = fmax(upper[0] - lower[0], 0.0), height = fmax(upper[1] - lower[1], 0.0);
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.9gmm\" height=\"%.9gmm\" viewBox=\"0 0 %.9g %.9g\" "
            "fill=\"none\" "
            "stroke-width=\"0.1\">\n",
            width, height, width, height);
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        const ImportLine* line = &drawing->lines[i];
        fprintf(file, "<path stroke=\"%s\" d=\"", colors[line->use]);
        for (int32_t j = 0; j < line->count; j++) {
            const double* point = &drawing->points[2 * (line->first + j)];
            fprintf(file, "%c%.9g %.9g", j == 0 ? 'M' : 'L', point[0] - lower[0], upper[1] - point[1]);
        }
        fprintf(file, "\"/>\n");
    }
    return fprintf(file, "</svg>\n") > 0 && !ferror(file);
}

/* A line has its own vertices: two lines that meet are two vertices in one place. */
bool Export_WriteFold(const Import* drawing, FILE* file)
{
    static const char letters[] = "FCMVU";
    fprintf(file, "{\"file_spec\": 1.2, \"file_creator\": \"Kiri\", \"frame_classes\": [\"creasePattern\"], "
                  "\"frame_unit\": \"mm\",\n"
                  "\"vertices_coords\": [");
    for (int32_t i = 0; i < drawing->pointCount; i++) {
        fprintf(file, "%s[%.9g, %.9g]", i > 0 ? ", " : "", drawing->points[2 * i], drawing->points[2 * i + 1]);
    }
    fprintf(file, "],\n\"edges_vertices\": [");
    const char* comma = "";
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        for (int32_t j = drawing->lines[i].first; j + 1 < drawing->lines[i].first + drawing->lines[i].count;
             j++, comma = ", ") {
            fprintf(file, "%s[%d, %d]", comma, j, j + 1);
        }
    }
    fprintf(file, "],\n\"edges_assignment\": [");
    comma = "";
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        bool isBorder = strcmp(drawing->styles[drawing->lines[i].style].name, BORDER) == 0;
        for (int32_t j = 1; j < drawing->lines[i].count; j++, comma = ", ") {
            fprintf(file, "%s\"%c\"", comma, isBorder ? 'B' : letters[drawing->lines[i].use]);
        }
    }
    return fprintf(file, "]}\n") > 0 && !ferror(file);
}
