/* The table that `make accuracy` prints: a row a measurement; the same as a CSV file and as plots. */
#ifndef KIRI_TEST_RESULTS_H
#define KIRI_TEST_RESULTS_H

#include <stdbool.h>

enum { MAX_ROWS = 2048, SETTING_LENGTH = 64 };

typedef struct Row {
    const char* name;             /* of the case */
    char setting[SETTING_LENGTH]; /* what else tells series apart: Poisson's ratio, what is compared */
    const char* layout;           /* of the frames: rows, jittered, Lloyd, spread, ... */
    int frames, grid;             /* grid: squares along the longer side */
    int substeps;                 /* a sixtieth of a second; 0: not of interest, for the sheet is at rest */
    double value, reference;      /* in `unit`; a unit of null: only the error has a meaning; "est.": the library's own
                                     estimate of the error, and the error */
    const char* unit;
    double error;        /* of the reference */
    double noise;        /* what the reference is uncertain by: changes of the error below it say nothing */
    double target;       /* 0: none */
    double milliseconds; /* of processor a tick */
} Row;

/* Without setting, value, error and time. */
Row Row_Make(const char* name, const char* layout, int frames, int grid, double noise, double target);

void Results_PrintHead(void);

/* Copies, prints and keeps the row, unless its error is no number (nothing was measured). Says "not monotone" where its
   error is more than 20 % above that of a row of the same series with fewer frames, a coarser grid or fewer substeps,
   all else being equal. */
void Results_Add(const Row* row);

/* error = value / reference - 1. */
void Results_AddValue(Row row, double value, double reference, const char* unit);

/* Writes all rows to accuracy.csv. False where that cannot be written. */
bool Results_Write(const char* folder);

#endif
