/* Hashes of 64 bits. A hash begins as KIRI_HASH_START, and each call adds to it. Numbers are added by value, so the
   hash is the same on machines of either byte order. */
#ifndef KIRI_ARCHIVE_H
#define KIRI_ARCHIVE_H

#include "kiri_base.h"
#include "kiri_array.h"

#include <string.h>

KIRI_C_BEGIN

#define KIRI_HASH_START UINT64_C(14695981039346656037)

/* Adds a whole number as one byte of FNV-1a (Fowler, Noll, Vo), for lists of indices. */
static inline void kiriHash_Word(uint64_t* hash, uint64_t value)
{
    *hash = (*hash ^ value) * UINT64_C(1099511628211);
}

/* The same for numbers whose highest bits matter: they are brought down, for a product carries bits up alone. */
static inline void kiriHash_Int64(uint64_t* hash, int64_t value)
{
    uint64_t mixed = (*hash ^ (uint64_t)value) * UINT64_C(0x9E3779B97F4A7C15);
    *hash = mixed ^ mixed >> 32;
}

static inline void kiriHash_Int32(uint64_t* hash, int32_t value)
{
    kiriHash_Int64(hash, value);
}

/* Two at the price of one. */
static inline void kiriHash_Pair(uint64_t* hash, int32_t first, int32_t second)
{
    kiriHash_Int64(hash, (int64_t)((uint64_t)(uint32_t)first << 32 | (uint32_t)second));
}

/* Its bits: 0.0 and -0.0 differ. */
static inline void kiriHash_Double(uint64_t* hash, double value)
{
    int64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    kiriHash_Int64(hash, bits);
}

/* State as bytes, and back. Tables of fields say what of a struct is kept; size, bytes and reading follow from the same
   tables. Numbers are little-endian by value, without padding and pointers, so bytes are the same on every machine. */

typedef struct kiriArchive kiriArchive;

/* Does one thing in both directions: `object` is written where bytes are read, and else only read. */
typedef void kiriArchiveFn(kiriArchive* archive, void* object);

enum kiriMemberKind {
    KIRI_MEMBER_RUN,    /* numbers of one width, in fields that follow each other */
    KIRI_MEMBER_BOOLS,  /* the same of bools */
    KIRI_MEMBER_PART,   /* a struct, or an array of C of them */
    KIRI_MEMBER_ITEMS,  /* a KIRI_ARRAY of numbers of one width, or of structs of them */
    KIRI_MEMBER_PARTS,  /* a KIRI_ARRAY of structs */
    KIRI_MEMBER_ROOM,   /* a KIRI_ARRAY: its room alone; it is empty when it is read */
    KIRI_MEMBER_SPACE,  /* a KIRI_ARRAY: its room and its count; whoever reads it writes the items anew */
    KIRI_MEMBER_SHOWN,  /* the same; but in a snapshot the items, too */
    KIRI_MEMBER_OWNED,  /* a pointer to a struct in a block of its own, or null */
    KIRI_MEMBER_CUSTOM, /* what a function says, of the whole object */
    KIRI_MEMBER_DROPPED /* nothing: it is zero when it is read */
};

typedef struct kiriMember {
    int32_t kind, width; /* width: bytes a number */
    int32_t offset;
    int32_t size;                  /* bytes of the run, of the part, or of an item */
    const struct kiriTable* table; /* of the part, or of an item */
    kiriArchiveFn* custom;
} kiriMember;

typedef struct kiriTable {
    const kiriMember* fields;
    int32_t count;
    int32_t size; /* bytes of the struct */
} kiriTable;

#define KIRI_FIELD_SIZE(Type, field) (int32_t)sizeof(((Type*)NULL)->field)
#define KIRI_ITEM_SIZE(Type, field) (int32_t)sizeof(*((Type*)NULL)->field.data)
#define KIRI_FIELD_END(Type, field) ((int32_t)offsetof(Type, field) + KIRI_FIELD_SIZE(Type, field))

/* `tests/fields.py` (make fields) holds the tables against the structs: each field is in its table, once and as what it
   is. */
#define KIRI_RUN(width, Type, first, last)                                                                             \
    {                                                                                                                  \
        KIRI_MEMBER_RUN, width, (int32_t)offsetof(Type, first),                                                        \
            KIRI_FIELD_END(Type, last) - (int32_t)offsetof(Type, first), NULL, NULL                                    \
    }
#define KIRI_BOOLS(Type, first, last)                                                                                  \
    {                                                                                                                  \
        KIRI_MEMBER_BOOLS, 1, (int32_t)offsetof(Type, first),                                                          \
            KIRI_FIELD_END(Type, last) - (int32_t)offsetof(Type, first), NULL, NULL                                    \
    }
#define KIRI_PART(Type, field, table)                                                                                  \
    {                                                                                                                  \
        KIRI_MEMBER_PART, 0, (int32_t)offsetof(Type, field), KIRI_FIELD_SIZE(Type, field), &table, NULL                \
    }
#define KIRI_ITEMS(width, Type, field)                                                                                 \
    {                                                                                                                  \
        KIRI_MEMBER_ITEMS, width, (int32_t)offsetof(Type, field), KIRI_ITEM_SIZE(Type, field), NULL, NULL              \
    }
#define KIRI_PARTS(Type, field, table)                                                                                 \
    {                                                                                                                  \
        KIRI_MEMBER_PARTS, 0, (int32_t)offsetof(Type, field), KIRI_ITEM_SIZE(Type, field), &table, NULL                \
    }
#define KIRI_ROOM_OF(Type, field)                                                                                      \
    {                                                                                                                  \
        KIRI_MEMBER_ROOM, 0, (int32_t)offsetof(Type, field), KIRI_ITEM_SIZE(Type, field), NULL, NULL                   \
    }
#define KIRI_SPACE_OF(Type, field)                                                                                     \
    {                                                                                                                  \
        KIRI_MEMBER_SPACE, 0, (int32_t)offsetof(Type, field), KIRI_ITEM_SIZE(Type, field), NULL, NULL                  \
    }
#define KIRI_SHOWN_OF(Type, field)                                                                                     \
    {                                                                                                                  \
        KIRI_MEMBER_SHOWN, 0, (int32_t)offsetof(Type, field), KIRI_ITEM_SIZE(Type, field), NULL, NULL                  \
    }
#define KIRI_OWNED(Type, field, table)                                                                                 \
    {                                                                                                                  \
        KIRI_MEMBER_OWNED, 0, (int32_t)offsetof(Type, field), 0, &table, NULL                                          \
    }
#define KIRI_CUSTOM(Type, field, function)                                                                             \
    {                                                                                                                  \
        KIRI_MEMBER_CUSTOM, 0, (int32_t)offsetof(Type, field), 0, NULL, function                                       \
    }
#define KIRI_DROPPED(Type, field)                                                                                      \
    {                                                                                                                  \
        KIRI_MEMBER_DROPPED, 0, (int32_t)offsetof(Type, field), 0, NULL, NULL                                          \
    }
#define KIRI_TABLE(Type, fields)                                                                                       \
    {                                                                                                                  \
        fields, (int32_t)(sizeof(fields) / sizeof(fields[0])), (int32_t)sizeof(Type)                                   \
    }

typedef enum kiriArchiveMode { KIRI_ARCHIVE_MEASURE, KIRI_ARCHIVE_WRITE, KIRI_ARCHIVE_READ } kiriArchiveMode;

struct kiriArchive {
    kiriArchiveMode mode;
    uint8_t* bytes;     /* null where they are measured */
    int64_t at, size;   /* so many are done, of so many */
    int64_t room;       /* READ: bytes of memory that arrays may still take */
    kiriMemory* memory; /* READ: of what is made */
    bool isBad;   /* READ: these bytes are none that were written; what is read then is zero. WRITE: more than `size` */
    bool isShort; /* no memory */
    bool
        isWhole; /* a snapshot: derived data too, and structs as they lie in memory. Else a save: what cannot be made again */
};

kiriArchive kiriArchive_Measure(void);
kiriArchive kiriArchive_Write(void* bytes, int64_t size);
kiriArchive kiriArchive_Read(const void* bytes, int64_t size, kiriMemory* memory);

static inline bool kiriArchive_Reads(const kiriArchive* archive)
{
    return archive->mode == KIRI_ARCHIVE_READ;
}

static inline bool kiriArchive_HasFailed(const kiriArchive* archive)
{
    return archive->isBad || archive->isShort;
}

/* Bytes that were read are nonsense, unless `isFine`. */
void kiriArchive_Expect(kiriArchive* archive, bool isFine);

/* Numbers that lie one after the other. */
void kiriArchive_Numbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count);

static inline void kiriArchive_Int32(kiriArchive* archive, int32_t* number)
{
    kiriArchive_Numbers(archive, number, 4, 1);
}

/* So many numbers that are in no KIRI_ARRAY, with their count: where bytes are read that is at most `room`, and
   returned. */
int32_t kiriArchive_Row(kiriArchive* archive, void* numbers, int32_t width, int32_t count, int32_t room);

/* A whole number that is none of an object; where bytes are read, what they have. It is within these. */
int32_t kiriArchive_Count(kiriArchive* archive, int64_t count, int64_t least, int64_t most);

/* An object, or so many in a row. Where bytes are read it is zero before; what it has then is in blocks of
   archive->memory. */
void kiriArchive_Object(kiriArchive* archive, const kiriTable* table, void* object);
void kiriArchive_Objects(kiriArchive* archive, const kiriTable* table, void* objects, int64_t count);

/* Hashes sizes and places of all fields. */
void kiriArchive_HashLayout(const kiriTable* table, uint64_t* hash);

/* A block of so many numbers, of *block. */
void kiriArchive_Block(kiriArchive* archive, void** block, int32_t width, int64_t count);

KIRI_C_END

#endif
