/* The families of `make accuracy`: each case prints its rows through results.h. */
#ifndef KIRI_TEST_ACCURACY_H
#define KIRI_TEST_ACCURACY_H

typedef struct Case {
    const char* name;
    void (*run)(const char* data); /* folder of the reference data */
} Case;

/* Each ends with a name of null. */
extern const Case beamCases[], plateCases[], shellCases[], cutCases[], motionCases[];

/* The first mode of a cantilever of length *data. */
void Accuracy_FirstShape(const void* data, double u, double v, double w[3]);

#endif
