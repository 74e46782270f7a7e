/* What the benchmarks share: a clock, series of numbers, and tables that are printed, and written to build/bench. A
   number that misses its aim is marked with *. Nothing is asserted about time: machines differ. */
#ifndef KIRI_BENCH_H
#define KIRI_BENCH_H

#include "defaults.h"
#include "scoped.h"
#include "kiri/kiri.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

/* The time of the processor, not of the wall: it stands still while others have the processor. Without what the clock
   itself takes, which is half a microsecond where it has to ask the kernel. */
static double clockCost;
static int64_t clockCalls;

static inline double Bench_Clock(void* user)
{
    (void)user;
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec - clockCost * (double)clockCalls++;
}

static inline void Bench_WeighClock(void)
{
    double least = 1.0;
    clockCost = 0.0;
    for (int batch = 0; batch < 20; batch++) {
        enum { CALLS = 1000 };
        double start = Bench_Clock(NULL);
        for (int i = 1; i < CALLS; i++) {
            Bench_Clock(NULL);
        }
        double cost = (Bench_Clock(NULL) - start) / CALLS;
        least = cost < least ? cost : least;
    }
    clockCost = least;
    clockCalls = 0;
}

static inline kiriWorldDef Bench_WorldDef(void)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.clock = Bench_Clock;
    return def;
}

/* Memory of a world: now, and the most so far. */
typedef struct Held {
    int64_t bytes, peak;
} Held;

static inline void* Held_Alloc(void* user, int64_t bytes)
{
    Held* held = user;
    int64_t* block = malloc((size_t)bytes + 16);
    if (block == NULL) {
        return NULL;
    }
    *block = bytes;
    held->bytes += bytes;
    held->peak = held->bytes > held->peak ? held->bytes : held->peak;
    return block + 2;
}

static inline void Held_Free(void* user, void* pointer)
{
    if (pointer != NULL) {
        int64_t* block = (int64_t*)pointer - 2;
        ((Held*)user)->bytes -= *block;
        free(block);
    }
}

static inline kiriResult Held_CreateWorld(Held* held, kiriWorld** world)
{
    kiriWorldDef def = Bench_WorldDef();
    def.user = held;
    def.alloc = Held_Alloc;
    def.free = Held_Free;
    return kiriCreateWorld(&def, world);
}

/* The program's result. */
static inline int Bench_End(bool fine, const char* fault)
{
    if (!fine) {
        fprintf(stderr, "%s\n", fault);
    }
    return fine ? 0 : 1;
}

/* A square sheet of one metre, with squares x squares x 2 triangles. */
static inline bool Bench_AddSheet(kiriWorld* world, kiriSheetDef* def, int32_t squares, kiriSheet* sheet)
{
    size_t vertices = (size_t)(squares + 1) * (size_t)(squares + 1), triangles = 2 * (size_t)squares * (size_t)squares;
    float* positions = malloc(2 * sizeof(float) * vertices);
    int32_t* indices = malloc(3 * sizeof(int32_t) * triangles);
    bool fine = positions != NULL && indices != NULL;
    if (fine) {
        kiriFillRectangle(1.0f, 1.0f, squares, squares, positions, indices);
        def->restPositions = positions;
        def->indices = indices;
        def->vertexCount = (int32_t)vertices;
        def->triangleCount = (int32_t)triangles;
        fine = kiriCreateSheet(world, def, sheet) == KIRI_OK;
    }
    free(positions);
    free(indices);
    return fine;
}

/* Pins the corners of u = 0 and 1 at `v` to the places (u, 0, z). */
static inline bool Bench_PinCorners(kiriWorld* world, kiriSheet sheet, float v, float z)
{
    bool fine = true;
    for (int corner = 0; fine && corner < 2; ++corner) {
        kiriPinDef pin;
        kiriPin id;
        kiriDefaultPinDef(&pin);
        pin.restPoint[0] = pin.target[0] = (float)corner;
        pin.restPoint[1] = v;
        pin.target[2] = z;
        fine = kiriCreatePin(world, sheet, &pin, &id) == KIRI_OK;
    }
    return fine;
}

/* Moves as many bytes as skinning writes. */
static inline double Bench_TimeCopy(kiriWorld* world, kiriSheet sheet, float* buffer)
{
    kiriMesh mesh;
    kiriSheet_GetMesh(world, sheet, &mesh);
    size_t count = 3 * (size_t)mesh.vertexCount;
    double start = Bench_Clock(NULL);
    memcpy(buffer, mesh.positions, count * sizeof(float));
    if (mesh.normals != NULL) {
        memcpy(buffer + count, mesh.normals, count * sizeof(float));
    }
    double seconds = Bench_Clock(NULL) - start;
    return buffer[count / 2] < 2.0f ? seconds : (double)NAN; /* read, so that it is written */
}

/* ---- Series ------------------------------------------------------------------------------------------------------ */

typedef struct Series {
    double* number;
    int32_t count, capacity;
} Series;

static inline void Series_Add(Series* series, double number)
{
    if (series->count == series->capacity) {
        series->capacity = series->capacity > 0 ? 2 * series->capacity : 64;
        series->number = realloc(series->number, sizeof(double) * (size_t)series->capacity);
        if (series->number == NULL) {
            abort();
        }
    }
    series->number[series->count++] = number;
}

static inline void Series_Free(Series* series)
{
    free(series->number);
    *series = (Series){ .number = NULL };
}

static inline int CompareNumbers(const void* left, const void* right)
{
    double l = *(const double*)left, r = *(const double*)right;
    return (l > r) - (l < r);
}

/* The number that this share of the others does not exceed; NaN of none. */
static inline double Series_Quantile(Series* series, double share)
{
    qsort(series->number, (size_t)series->count, sizeof(double), CompareNumbers);
    return series->count > 0 ? series->number[(int32_t)(share * (series->count - 1) + 0.5)] : (double)NAN;
}

static inline double Series_Median(Series* series)
{
    return Series_Quantile(series, 0.5);
}

static inline double Series_Worst(Series* series)
{
    return Series_Quantile(series, 1.0);
}

static inline double Series_Mean(const Series* series)
{
    double sum = 0.0;
    for (int32_t i = 0; i < series->count; i++) {
        sum += series->number[i];
    }
    return sum / series->count;
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

typedef struct Table {
    const char* name;
    const char* const* columns;
    FILE* csv;
    int32_t column; /* the next one */
    int32_t missed;
} Table;

static inline int Table_WidthOf(const char* column)
{
    return strlen(column) > 8 ? (int)strlen(column) : 8;
}

/* `columns` ends with null. The title says what is measured, and the aims. */
static inline bool Table_Start(Table* table, const char* name, const char* title, const char* const* columns)
{
    char path[256];
    mkdir("build", 0777);
    mkdir("build/bench", 0777);
    snprintf(path, sizeof path, "build/bench/%s.csv", name);
    *table = (Table){ .name = name, .columns = columns, .csv = fopen(path, "w") };
    if (table->csv == NULL) {
        fprintf(stderr, "cannot write %s\n", path);
        return false;
    }
    printf("%s\n", title);
    for (int32_t i = 0; columns[i] != NULL; i++) {
        printf(i > 0 ? "  %*s" : "  %-*s", Table_WidthOf(columns[i]), columns[i]);
        fprintf(table->csv, i > 0 ? ",\"%s\"" : "\"%s\"", columns[i]);
    }
    return true;
}

/* The next cell, as it is printed and as it is written to the file. */
static inline void Table_Cell(Table* table, const char* printed, const char* written)
{
    const char* column = table->columns[table->column];
    printf(table->column > 0 ? "  %*s" : "\n  %-*s", Table_WidthOf(column), printed);
    fprintf(table->csv, table->column > 0 ? ",%s" : "\n%s", written);
    table->column = table->columns[table->column + 1] != NULL ? table->column + 1 : 0;
}

static inline void Table_Text(Table* table, const char* text)
{
    char written[128];
    snprintf(written, sizeof written, "\"%s\"", text);
    Table_Cell(table, text, written);
}

/* Three digits of it, or all of a whole number. */
static inline void Table_Judge(Table* table, double number, bool fine)
{
    char printed[32], written[32];
    double size = fabs(number);
    int digits = size == floor(size) || size >= 100.0 ? 0 : size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3;
    snprintf(printed, sizeof printed, isnan(number) ? "-" : "%.*f%s", digits, number, fine ? "" : "*");
    snprintf(written, sizeof written, "%.6g", number);
    table->missed += !fine;
    Table_Cell(table, printed, written);
}

static inline void Table_Number(Table* table, double number)
{
    Table_Judge(table, number, true);
}

static inline void Table_Numbers(Table* table, const double* numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        Table_Number(table, numbers[i]);
    }
}

/* The next cells. */
#define TABLE_NUMBERS(table, ...)                                                                                      \
    Table_Numbers(table, (const double[]){ __VA_ARGS__ }, sizeof((const double[]){ __VA_ARGS__ }) / sizeof(double))

static inline bool Table_Stop(Table* table)
{
    printf("\n  (build/bench/%s.csv", table->name);
    printf(table->missed > 0 ? "; * misses its aim: %d)\n\n" : ")\n\n", table->missed);
    return fprintf(table->csv, "\n") > 0 && fclose(table->csv) == 0;
}

#endif
