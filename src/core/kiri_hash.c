#include "kiri_hash.h"

void kiriHash_Bytes(uint64_t* hash, const void* data, size_t bytes)
{
    const unsigned char* byte = data;
    for (size_t i = 0; i < bytes; ++i) {
        kiriHash_Word(hash, byte[i]);
    }
}
