#include "results.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static Row rows[MAX_ROWS];
static int rowCount;

/* ---- Order ------------------------------------------------------------------------------------------------------ */

static bool SameSeries(const Row* a, const Row* b)
{
    return strcmp(a->name, b->name) == 0 && strcmp(a->setting, b->setting) == 0 && strcmp(a->layout, b->layout) == 0;
}

/* The one number in which `fine` is finer, all else being equal; or null. */
static const char* Refined(const Row* coarse, const Row* fine)
{
    bool frames = fine->frames == coarse->frames, grid = fine->grid == coarse->grid;
    bool substeps = fine->substeps == coarse->substeps;
    if (fine->frames > coarse->frames && grid && substeps) {
        return "frames";
    }
    if (frames && fine->grid > coarse->grid && substeps) {
        return "grid";
    }
    return frames && grid && fine->substeps > coarse->substeps ? "substeps" : NULL;
}

static const char* NotMonotone(const Row* row)
{
    for (int i = rowCount - 1; i >= 0; --i) {
        const char* what = SameSeries(&rows[i], row) ? Refined(&rows[i], row) : NULL;
        if (what != NULL && fabs(row->error) > 1.2 * fabs(rows[i].error) + row->noise) {
            return what;
        }
    }
    return NULL;
}

/* ---- Table ------------------------------------------------------------------------------------------------------ */

Row Row_Make(const char* name, const char* layout, int frames, int grid, double noise, double target)
{
    return (Row){ .name = name, .layout = layout, .frames = frames, .grid = grid, .noise = noise, .target = target };
}

void Results_PrintHead(void)
{
    printf("%-22s %-27s %-9s %6s %5s %8s %11s %11s %-6s %10s %9s %10s\n", "case", "setting", "layout", "frames", "grid",
           "substeps", "value", "reference", "unit", "error", "target", "ms a tick");
}

void Results_Add(const Row* row)
{
    if (isnan(row->error)) {
        return; /* refused, and said so */
    }
    const char* what = NotMonotone(row);
    printf("%-22s %-27s %-9s %6d %5d ", row->name, row->setting, row->layout, row->frames, row->grid);
    printf(row->substeps > 0 ? "%8d " : "%8.0d ", row->substeps);
    if (row->unit != NULL) {
        printf("%11.5g %11.5g %-6s ", row->value, row->reference, row->unit);
    } else {
        printf("%11s %11s %-6s ", "", "", "");
    }
    printf("%8.3f %% ", 100.0 * row->error);
    if (row->target > 0.0) {
        printf("%7.2f %% ", 100.0 * row->target);
    } else {
        printf("%9s ", "");
    }
    printf("%10.4f%s", row->milliseconds,
           row->target > 0.0 && !(fabs(row->error) <= row->target) ? "  above target" : "");
    printf(what != NULL ? "  not monotone in %s\n" : "\n", what);
    fflush(stdout);
    if (rowCount < MAX_ROWS) {
        rows[rowCount++] = *row;
    }
}

void Results_AddValue(Row row, double value, double reference, const char* unit)
{
    row.value = value;
    row.reference = reference;
    row.unit = unit;
    row.error = value / reference - 1.0;
    Results_Add(&row);
}

/* ---- Files ------------------------------------------------------------------------------------------------------ */

bool Results_Write(const char* folder)
{
    char path[512];
    snprintf(path, sizeof path, "%s/accuracy.csv", folder);
    FILE* file = fopen(path, "w");
    if (file == NULL) {
        return false;
    }
    fprintf(file,
            "case,setting,layout,frames,grid,substeps,value,reference,unit,error,target,ms a tick,not monotone in\n");
    int all = rowCount;
    for (rowCount = 0; rowCount < all; ++rowCount) { /* as when it was added, only those before count */
        const Row* r = &rows[rowCount];
        const char* what = NotMonotone(r);
        fprintf(file, "%s,\"%s\",%s,%d,%d,%d,%.7g,%.7g,%s,%.5g,%.5g,%.4g,%s\n", r->name, r->setting, r->layout,
                r->frames, r->grid, r->substeps, r->value, r->reference, r->unit != NULL ? r->unit : "", r->error,
                r->target, r->milliseconds, what != NULL ? what : "");
    }
    return fclose(file) == 0;
}
