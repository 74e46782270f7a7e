/* One linear system of each block size. Its solution's hash is the same with every compiler, vector length and machine:
   tests/test_matrix.c and `make portable` compare it. */
#ifndef KIRI_MATRIX_HASH_H
#define KIRI_MATRIX_HASH_H

#include "hash.h"
#include "solver/kiri_matrix.h"

enum { MATRIX_SIZES = 3, MATRIX_FRAMES = 40, MATRIX_ELEMENTS = 60, MATRIX_ROWS = 7, MATRIX_MEMBERS = 4 };

typedef struct MatrixGolden {
    int32_t size; /* unknowns a frame */
    uint64_t hash;
} MatrixGolden;

static const MatrixGolden matrixGolden[MATRIX_SIZES] = {
    { 3, UINT64_C(0x03C87CF1FC3654E4) },
    { 6, UINT64_C(0x1001B4162301BB5D) },
    { 12, UINT64_C(0x5C7AEF6BD4B30FC5) },
};

/* From -1 to 1 in steps of 1/128: exact, so this file's own arithmetic rounds nothing. */
static inline double MatrixNumber(uint32_t* seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return (double)((int32_t)(*seed >> 8 & 255) - 128) * (1.0 / 128.0);
}

/* A ring of elements of four frames, on a diagonal of ones. Returns 0 on failure. */
static inline uint64_t MatrixHash(kiriMemory* memory, int32_t size, bool refusesAvx)
{
    static kiriPair pairs[MATRIX_ELEMENTS * MATRIX_MEMBERS * MATRIX_MEMBERS];
    static double right[MATRIX_FRAMES * KIRI_MOST_UNKNOWNS], solution[MATRIX_FRAMES * KIRI_MOST_UNKNOWNS];
    double J[MATRIX_ROWS * MATRIX_MEMBERS * KIRI_MOST_UNKNOWNS], k[MATRIX_ROWS];
    double own[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS] = { 0.0 };
    static const int32_t offsets[MATRIX_MEMBERS] = { 0, 1, 7, 9 };
    int32_t frames[MATRIX_ELEMENTS][MATRIX_MEMBERS], pairCount = 0;
    uint32_t seed = 2015;
    for (int32_t e = 0; e < MATRIX_ELEMENTS; ++e) {
        for (int32_t m = 0; m < MATRIX_MEMBERS; ++m) {
            frames[e][m] = (e + offsets[m]) % MATRIX_FRAMES;
            for (int32_t n = 0; n < m; ++n) {
                pairs[pairCount++] = (kiriPair){ frames[e][n], frames[e][m] };
            }
        }
    }
    kiriMatrix* matrix = kiriMatrix_Create(memory, size);
    if (matrix == NULL || !kiriMatrix_Shape(matrix, MATRIX_FRAMES, pairs, pairCount)) {
        return 0;
    }
    matrix->usesAvx &= !refusesAvx;
    kiriMatrix_Clear(matrix);
    for (int32_t n = 0; n < size; ++n) {
        own[(size + 1) * n] = 1.0;
    }
    for (int32_t f = 0; f < MATRIX_FRAMES; ++f) {
        kiriMatrix_AddOwn(matrix, f, own);
    }
    for (int32_t e = 0; e < MATRIX_ELEMENTS; ++e) {
        for (int32_t n = 0; n < MATRIX_ROWS * MATRIX_MEMBERS * size; ++n) {
            J[n] = MatrixNumber(&seed);
        }
        for (int32_t n = 0; n < MATRIX_ROWS; ++n) {
            k[n] = 16.0 + 15.0 * MatrixNumber(&seed);
        }
        kiriMatrix_AddSquares(matrix, frames[e], MATRIX_MEMBERS, J, k, MATRIX_ROWS);
    }
    for (int32_t n = 0; n < size * MATRIX_FRAMES; ++n) {
        right[n] = MatrixNumber(&seed);
    }
    if (!kiriMatrix_Factor(matrix)) {
        return 0;
    }
    kiriMatrix_Solve(matrix, right, solution);
    uint64_t hash = KIRI_HASH_START;
    for (int32_t n = 0; n < size * MATRIX_FRAMES; ++n) {
        kiriHash_Double(&hash, solution[n]);
    }
    return hash;
}

#endif
