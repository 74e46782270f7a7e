#include "kiri_coder.h"

#include <string.h>

void kiriSink_Flush(kiriSink* sink)
{
    if (sink->count > 0) {
        sink->write(sink->user, sink->bytes, sink->count);
        sink->count = 0;
    }
}

void kiriCoder_Stop(kiriCoder* coder, kiriCoderFault fault)
{
    coder->fault = coder->fault == KIRI_CODER_FINE ? fault : coder->fault;
    coder->at = coder->end;
}

void kiriCoder_Byte(kiriCoder* coder, uint8_t* value)
{
    if (!kiriCoder_Reads(coder)) {
        if (coder->sink->count == KIRI_SINK_BYTES) {
            kiriSink_Flush(coder->sink);
        }
        coder->sink->bytes[coder->sink->count++] = *value;
    } else if (coder->at == coder->end) {
        kiriCoder_Stop(coder, KIRI_CODER_SHORT);
        *value = 0;
    } else {
        *value = *coder->at++;
    }
}

/* Seven bits a byte, the lowest first; the top bit says that more follow. */
static void WriteUnsigned(kiriCoder* coder, uint64_t value)
{
    do {
        uint8_t byte = (uint8_t)((value & 0x7f) | (value > 0x7f ? 0x80 : 0));
        kiriCoder_Byte(coder, &byte);
        value >>= 7;
    } while (value > 0);
}

static uint64_t ReadUnsigned(kiriCoder* coder)
{
    uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
        uint8_t byte = 0;
        kiriCoder_Byte(coder, &byte);
        if (shift == 63 && byte > 1) {
            break;
        }
        value |= (uint64_t)(byte & 0x7f) << shift;
        if (byte < 0x80) {
            return value;
        }
    }
    kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
    return 0;
}

void kiriCoder_Unsigned(kiriCoder* coder, uint64_t* value)
{
    if (kiriCoder_Reads(coder)) {
        *value = ReadUnsigned(coder);
    } else {
        WriteUnsigned(coder, *value);
    }
}

/* 0, -1, 1, -2 and so on are 0, 1, 2, 3. */
void kiriCoder_Signed(kiriCoder* coder, int64_t* value)
{
    uint64_t folded = *value < 0 ? ~((uint64_t)*value << 1) : (uint64_t)*value << 1;
    kiriCoder_Unsigned(coder, &folded);
    if (kiriCoder_Reads(coder)) {
        *value = (folded & 1) != 0 ? -(int64_t)(folded >> 1) - 1 : (int64_t)(folded >> 1);
    }
}

/* What does not fit in 32 bits was never written. */
static int32_t Narrow(kiriCoder* coder, int64_t value)
{
    if (value < INT32_MIN || value > INT32_MAX) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
        return 0;
    }
    return (int32_t)value;
}

void kiriCoder_Int(kiriCoder* coder, int32_t* value)
{
    int64_t wide = *value;
    kiriCoder_Signed(coder, &wide);
    if (kiriCoder_Reads(coder)) {
        *value = Narrow(coder, wide);
    }
}

/* The slot comes first, so that ids of few things are short: see kiri_pool.h. */
void kiriCoder_Id(kiriCoder* coder, uint32_t* value)
{
    uint64_t turned = (uint32_t)(*value << 10 | *value >> 22);
    kiriCoder_Unsigned(coder, &turned);
    if (turned > UINT32_MAX) {
        kiriCoder_Stop(coder, KIRI_CODER_DAMAGED);
    }
    if (kiriCoder_Reads(coder)) {
        *value = (uint32_t)turned >> 10 | (uint32_t)turned << 22;
    }
}

static void CodeFixed(kiriCoder* coder, uint64_t* value, int bytes)
{
    uint64_t read = 0;
    for (int i = 0; i < bytes; ++i) {
        uint8_t byte = (uint8_t)(*value >> 8 * i);
        kiriCoder_Byte(coder, &byte);
        read |= (uint64_t)byte << 8 * i;
    }
    if (kiriCoder_Reads(coder)) {
        *value = read;
    }
}

void kiriCoder_Float(kiriCoder* coder, float* value)
{
    uint32_t bits;
    memcpy(&bits, value, sizeof(bits));
    uint64_t wide = bits;
    CodeFixed(coder, &wide, 4);
    if (kiriCoder_Reads(coder)) {
        bits = (uint32_t)wide;
        memcpy(value, &bits, sizeof(bits));
    }
}

void kiriCoder_Hash(kiriCoder* coder, uint64_t* value)
{
    CodeFixed(coder, value, 8);
}

void kiriCoder_Indices(kiriCoder* coder, int32_t* values, int64_t count)
{
    int64_t last = 0;
    for (int64_t i = 0; i < count; ++i) {
        int64_t step = kiriCoder_Reads(coder) ? 0 : values[i] - last;
        kiriCoder_Signed(coder, &step);
        bool isNear = step >= -(int64_t)UINT32_MAX && step <= (int64_t)UINT32_MAX;
        last = Narrow(coder, isNear ? last + step : INT64_MAX);
        if (kiriCoder_Reads(coder)) {
            values[i] = (int32_t)last;
        }
    }
}

void* kiriCoder_Alloc(kiriCoder* coder, int64_t count, int64_t itemBytes, int64_t least)
{
    KIRI_ASSERT(kiriCoder_Reads(coder) && count > 0 && least > 0);
    if (count > (coder->end - coder->at) / least) {
        kiriCoder_Stop(coder, KIRI_CODER_SHORT);
        return NULL;
    }
    void* items = kiriMemory_AllocZeroed(coder->memory, count * itemBytes);
    if (items == NULL) {
        kiriCoder_Stop(coder, KIRI_CODER_MEMORY);
    }
    return items;
}
