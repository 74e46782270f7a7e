#include "kiri_hash.h"

#include <string.h>

void kiriHash_Bytes(uint64_t* hash, const void* data, size_t bytes)
{
    const unsigned char* byte = data;
    for (size_t i = 0; i < bytes; ++i) {
        kiriHash_Word(hash, byte[i]);
    }
}

static void HashNumber(uint64_t* hash, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i) {
        kiriHash_Word(hash, value >> (8 * i) & 255u);
    }
}

void kiriHash_Int32(uint64_t* hash, int32_t value)
{
    HashNumber(hash, (uint32_t)value, 4);
}

void kiriHash_Int64(uint64_t* hash, int64_t value)
{
    HashNumber(hash, (uint64_t)value, 8);
}

void kiriHash_Double(uint64_t* hash, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    HashNumber(hash, bits, 8);
}
