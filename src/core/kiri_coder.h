/* Numbers in few bytes, the same on all machines. A coder either writes or reads, and each function does what its coder
   does: so one description of data serves for both ways. Integers take 7 bits a byte, small ones of either sign one
   byte; floats are 4 bytes, the lowest first. */
#ifndef KIRI_CODER_H
#define KIRI_CODER_H

#include "kiri_base.h"

KIRI_C_BEGIN

enum { KIRI_SINK_BYTES = 512 };

/* Where a coder writes to: the host's function, which gets some bytes at a time. */
typedef struct kiriSink {
    kiriRecordFn* write;
    void* user;
    int32_t count;
    uint8_t bytes[KIRI_SINK_BYTES];
} kiriSink;

/* Hands over what it still has. */
void kiriSink_Flush(kiriSink* sink);

/* Why a coder that reads stopped. From then on it reads zeros. */
typedef enum kiriCoderFault {
    KIRI_CODER_FINE,
    KIRI_CODER_SHORT,   /* the bytes end too early */
    KIRI_CODER_DAMAGED, /* they mean nothing */
    KIRI_CODER_NEWER,   /* a later version wrote them */
    KIRI_CODER_MEMORY   /* there is no memory for an array */
} kiriCoderFault;

typedef struct kiriCoder {
    kiriSink* sink; /* null: it reads, */
    const uint8_t *at, *end;
    kiriMemory* memory; /* which arrays are from, */
    kiriCoderFault fault;
} kiriCoder;

static inline bool kiriCoder_Reads(const kiriCoder* coder)
{
    return coder->sink == NULL;
}

/* Keeps the first fault. */
void kiriCoder_Stop(kiriCoder* coder, kiriCoderFault fault);

/* They write what is there, which may be read-only, or read into it; it has been initialised in either case. */
void kiriCoder_Byte(kiriCoder* coder, uint8_t* value);
void kiriCoder_Unsigned(kiriCoder* coder, uint64_t* value);
void kiriCoder_Signed(kiriCoder* coder, int64_t* value);
void kiriCoder_Int(kiriCoder* coder, int32_t* value);
void kiriCoder_Id(kiriCoder* coder, uint32_t* value);
void kiriCoder_Float(kiriCoder* coder, float* value);
void kiriCoder_Hash(kiriCoder* coder, uint64_t* value);

/* Neighbours are near each other, as in the indices of a mesh. */
void kiriCoder_Indices(kiriCoder* coder, int32_t* values, int64_t count);

/* For a coder that reads: zeroed memory for `count` items of so many bytes, each of which takes `least` bytes or more
   to read. Null where there are not so many bytes, or no memory. */
void* kiriCoder_Alloc(kiriCoder* coder, int64_t count, int64_t itemBytes, int64_t least);

KIRI_C_END

#endif
