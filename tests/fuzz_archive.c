/* The archive, whose function for numbers is another's: fuzz_spoil.c looks at what saves write. */
#pragma weak kiriArchive_Numbers
#include "core/kiri_archive.c"

void RealNumbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count)
    __attribute__((alias("kiriArchive_Numbers")));
