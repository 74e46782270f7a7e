/* For `make portable`: names each linear system whose solution has other bits than it should. */
#include "matrix_hash.h"

#include <stdio.h>

int main(void)
{
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    int wrong = 0;
    for (int k = 0; k < 2 * MATRIX_SIZES; ++k) {
        const MatrixGolden* golden = &matrixGolden[k / 2];
        uint64_t hash = MatrixHash(&memory, golden->size, k % 2 != 0);
        if (hash != golden->hash) {
            printf("size %d: 0x%08lX%08lX\n", (int)golden->size, (unsigned long)(hash >> 32),
                   (unsigned long)(hash & 0xffffffff));
            ++wrong;
        }
    }
    kiriMemory_FreeAll(&memory);
    return wrong > 0;
}
