/* Hashes of 64 bits. A hash begins as KIRI_HASH_START, and each call adds to it. Numbers are added by value, so the
   hash is the same on machines of either byte order. */
#ifndef KIRI_ARCHIVE_H
#define KIRI_ARCHIVE_H

#include "kiri_base.h"
#include "kiri_array.h"

KIRI_C_BEGIN

#define KIRI_HASH_START UINT64_C(14695981039346656037)

/* Adds a whole number as one byte of FNV-1a (Fowler, Noll, Vo), for lists of indices. */
static inline void kiriHash_Word(uint64_t* hash, uint64_t value)
{
    *hash = (*hash ^ value) * UINT64_C(1099511628211);
}

/* Adds a number whose highest bits matter. The shift brings them down, because a product carries bits only upwards. */
static inline void kiriHash_Int64(uint64_t* hash, int64_t value)
{
    uint64_t mixed = (*hash ^ (uint64_t)value) * UINT64_C(0x9E3779B97F4A7C15);
    *hash = mixed ^ mixed >> 32;
}

static inline void kiriHash_Int32(uint64_t* hash, int32_t value)
{
    kiriHash_Int64(hash, value);
}

/* Adds two numbers at the cost of one. */
static inline void kiriHash_Pair(uint64_t* hash, int32_t first, int32_t second)
{
    kiriHash_Int64(hash, (int64_t)((uint64_t)(uint32_t)first << 32 | (uint32_t)second));
}

/* State as bytes, and back: one table of fields a struct. Saves, loads, the checks of loaded bytes, snapshots and the
   state hash follow from the same tables.

   - A save has the fields before KIRI_DERIVED, as little-endian numbers without padding and pointers. A load checks each
     number against its entry: the bytes are untrusted.
   - A snapshot has structs as they lie in memory, and the blocks of their arrays. It is for the same process, and is
     not checked.
   - The state hash has the fields before KIRI_UNHASHED. */

typedef struct kiriArchive kiriArchive;

/* Writes or reads part of an object; it changes the object only when it reads. */
typedef void kiriArchiveFn(kiriArchive* archive, void* object);

/* Kinds of indexed items. A sheet stores their counts first. */
enum kiriOf {
    KIRI_OF_NOTHING = -1,
    KIRI_OF_TRIANGLES,
    KIRI_OF_HALF_EDGES,
    KIRI_OF_VERTICES,
    KIRI_OF_FRAMES,
    KIRI_OF_PIECES,
    KIRI_OF_PINS,
    KIRI_OF_POINTS,
    KIRI_OF_COUNT
};

enum kiriMemberKind {
    KIRI_MEMBER_NUMBERS, /* numbers of one width */
    KIRI_MEMBER_REALS,   /* finite doubles */
    KIRI_MEMBER_FLOATS,  /* finite floats */
    KIRI_MEMBER_COUNTS,  /* int64_t in [0, 2^56) */
    KIRI_MEMBER_INTS,    /* int32_t in [low, high + count(of)] */
    KIRI_MEMBER_BOOLS,
    KIRI_MEMBER_PART,   /* a struct, or a C array of structs */
    KIRI_MEMBER_ARRAY,  /* a KIRI_ARRAY of structs; without a table, of numbers */
    KIRI_MEMBER_ROOM,   /* a KIRI_ARRAY: only its capacity; empty after a read */
    KIRI_MEMBER_SPACE,  /* a KIRI_ARRAY: only capacity and count; zeroed after a read */
    KIRI_MEMBER_OWNED,  /* a pointer to a struct in its own block, or null */
    KIRI_MEMBER_CUSTOM, /* a function of the whole object */
    KIRI_MEMBER_DROPPED, /* zero after a read */
    KIRI_MEMBER_KEPT,    /* unchanged by reading a snapshot */

    /* Marks for the entries after them. */
    KIRI_MEMBER_UNHASHED,
    KIRI_MEMBER_DERIVED, /* only in snapshots; numbers need no entry */
    KIRI_MEMBER_HANDED   /* arrays are blocks of archive->shown */
};

typedef const struct kiriTable* kiriTableFn(void);

typedef struct kiriMember {
    int32_t kind;
    int32_t item;         /* ARRAY of numbers: their kind */
    int32_t width;        /* bytes a number */
    int32_t offset, size; /* size: bytes of the field, or of an item of an array */
    int32_t of, low, high;
    kiriTableFn* table; /* of parts or items */
    kiriArchiveFn* custom;
} kiriMember;

typedef struct kiriTable {
    const kiriMember* fields;
    int32_t count;
    int32_t size; /* bytes of the struct */
} kiriTable;

/* kiriThis is the struct of the table that an entry is in. */
#define KIRI_FIELD_SIZE(field) sizeof(((kiriThis*)NULL)->field)
#define KIRI_MEMBER_ENTRY(kind, item, width, size, field, of, low, high, table, custom)                                \
    {                                                                                                                  \
        kind, item, width, (int32_t)offsetof(kiriThis, field), (int32_t)(size), of, low, high, table, custom           \
    }
#define KIRI_MEMBER_LIST(kind, item, width, field, of, low, high, table)                                               \
    KIRI_MEMBER_ENTRY(kind, item, width, sizeof(*((kiriThis*)NULL)->field.data), field, of, low, high, table, NULL)

/* A field, or the fields from a first to a last one. */
#define KIRI_MEMBER_RUN(kind, width, of, low, high, ...)                                                               \
    KIRI_ONCE_MORE(KIRI_RUN_PICK(__VA_ARGS__, KIRI_RUN_2, KIRI_RUN_1, )(kind, width, of, low, high, __VA_ARGS__))
#define KIRI_RUN_PICK(first, last, Run, ...) Run
#define KIRI_RUN_1(kind, width, of, low, high, field) KIRI_RUN_2(kind, width, of, low, high, field, field)
#define KIRI_RUN_2(kind, width, of, low, high, first, last)                                                            \
    KIRI_MEMBER_ENTRY(kind, kind, width, offsetof(kiriThis, last) + KIRI_FIELD_SIZE(last) - offsetof(kiriThis, first), \
                      first, of, low, high, NULL, NULL)

/* Entries of tables; `make fields` compares them with the structs. Numbers in a field, or from a first to a last one: */
#define KIRI_RUN(width, ...) KIRI_MEMBER_RUN(KIRI_MEMBER_NUMBERS, width, KIRI_OF_NOTHING, 0, 0, __VA_ARGS__)
#define KIRI_REALS(...) KIRI_MEMBER_RUN(KIRI_MEMBER_REALS, 8, KIRI_OF_NOTHING, 0, 0, __VA_ARGS__)
#define KIRI_FLOATS(...) KIRI_MEMBER_RUN(KIRI_MEMBER_FLOATS, 4, KIRI_OF_NOTHING, 0, 0, __VA_ARGS__)
#define KIRI_COUNTS(...) KIRI_MEMBER_RUN(KIRI_MEMBER_COUNTS, 8, KIRI_OF_NOTHING, 0, 0, __VA_ARGS__)
#define KIRI_BOOLS(...) KIRI_MEMBER_RUN(KIRI_MEMBER_BOOLS, 1, KIRI_OF_NOTHING, 0, 0, __VA_ARGS__)
#define KIRI_INDEX(of, ...) KIRI_MEMBER_RUN(KIRI_MEMBER_INTS, 4, of, 0, -1, __VA_ARGS__)
#define KIRI_INDEX_OR_NONE(of, ...) KIRI_MEMBER_RUN(KIRI_MEMBER_INTS, 4, of, KIRI_NONE, -1, __VA_ARGS__)
#define KIRI_WITHIN(low, high, ...) KIRI_MEMBER_RUN(KIRI_MEMBER_INTS, 4, KIRI_OF_NOTHING, low, high, __VA_ARGS__)
#define KIRI_DROPPED(...) KIRI_MEMBER_RUN(KIRI_MEMBER_DROPPED, 1, 0, 0, 0, __VA_ARGS__)
#define KIRI_KEPT(...) KIRI_MEMBER_RUN(KIRI_MEMBER_KEPT, 1, 0, 0, 0, __VA_ARGS__)

/* Structs, and arrays: */
#define KIRI_PART(field, table)                                                                                        \
    KIRI_MEMBER_ENTRY(KIRI_MEMBER_PART, 0, 0, KIRI_FIELD_SIZE(field), field, 0, 0, 0, table, NULL)
#define KIRI_PARTS(field, table) KIRI_MEMBER_LIST(KIRI_MEMBER_ARRAY, 0, 0, field, 0, 0, 0, table)
#define KIRI_ITEMS(width, field) KIRI_MEMBER_LIST(KIRI_MEMBER_ARRAY, KIRI_MEMBER_NUMBERS, width, field, 0, 0, 0, NULL)
#define KIRI_FLOAT_ITEMS(field) KIRI_MEMBER_LIST(KIRI_MEMBER_ARRAY, KIRI_MEMBER_FLOATS, 4, field, 0, 0, 0, NULL)
#define KIRI_INDICES(of, field) KIRI_MEMBER_LIST(KIRI_MEMBER_ARRAY, KIRI_MEMBER_INTS, 4, field, of, 0, -1, NULL)
#define KIRI_ROOM_OF(field) KIRI_MEMBER_LIST(KIRI_MEMBER_ROOM, 0, 1, field, 0, 0, 0, NULL)
#define KIRI_SPACE_OF(field) KIRI_MEMBER_LIST(KIRI_MEMBER_SPACE, 0, 1, field, 0, 0, 0, NULL)
#define KIRI_OWNED(field, table) KIRI_MEMBER_ENTRY(KIRI_MEMBER_OWNED, 0, 0, sizeof(void*), field, 0, 0, 0, table, NULL)
#define KIRI_CUSTOM(field, function) KIRI_MEMBER_ENTRY(KIRI_MEMBER_CUSTOM, 0, 0, 0, field, 0, 0, 0, NULL, function)

/* Several arrays with items in snapshots only; several arrays with their capacity. */
#define KIRI_ARRAY_OF(field) KIRI_ITEMS(1, field)
#define KIRI_ARRAYS(...) KIRI_EACH_FIELD(KIRI_ARRAY_OF, __VA_ARGS__)
#define KIRI_ROOMS(...) KIRI_EACH_FIELD(KIRI_ROOM_OF, __VA_ARGS__)

#define KIRI_MARK(kind)                                                                                                \
    {                                                                                                                  \
        kind, 0, 0, 0, 0, 0, 0, 0, NULL, NULL                                                                          \
    }
#define KIRI_UNHASHED KIRI_MARK(KIRI_MEMBER_UNHASHED)
#define KIRI_DERIVED KIRI_MARK(KIRI_MEMBER_DERIVED)
#define KIRI_HANDED KIRI_MARK(KIRI_MEMBER_HANDED)

/* A table of a struct, { with its entries }. Other sources may use a shared table. */
#define KIRI_TABLE(Name, Type, ...) static KIRI_SHARED_TABLE(Name, Type, __VA_ARGS__)
#define KIRI_SHARED_TABLE(Name, Type, ...)                                                                             \
    const kiriTable* Name(void)                                                                                        \
    {                                                                                                                  \
        typedef Type kiriThis;                                                                                         \
        static const kiriMember members[] = __VA_ARGS__;                                                               \
        static const kiriTable table = { members, (int32_t)(sizeof(members) / sizeof(kiriMember)),                     \
                                         (int32_t)sizeof(kiriThis) };                                                  \
        return &table;                                                                                                 \
    }

typedef enum kiriArchiveMode {
    KIRI_ARCHIVE_MEASURE,
    KIRI_ARCHIVE_WRITE,
    KIRI_ARCHIVE_READ,
    KIRI_ARCHIVE_HASH
} kiriArchiveMode;

struct kiriArchive {
    kiriArchiveMode mode;
    bool isWhole;       /* a snapshot */
    bool isBad;         /* READ: no writer made these bytes; reads give zero from then on. WRITE: `size` is too small */
    bool isShort;       /* READ: out of memory */
    bool isUnmoved;     /* READ: numbers are already in place and only checked */
    uint8_t* bytes;     /* null: bytes are only measured or hashed */
    int64_t at, size;   /* bytes: position, and total */
    int64_t room;       /* READ: bytes of memory that arrays may still take */
    kiriMemory *memory, *shown; /* READ: owners of new blocks */
    uint64_t hash;
    int64_t count[KIRI_OF_COUNT];
};

kiriArchive kiriArchive_Measure(void);
kiriArchive kiriArchive_Write(void* bytes, int64_t size);
kiriArchive kiriArchive_Read(const void* bytes, int64_t size, kiriMemory* memory);
kiriArchive kiriArchive_Hash(void);

static inline bool kiriArchive_Reads(const kiriArchive* archive)
{
    return archive->mode == KIRI_ARCHIVE_READ;
}

static inline bool kiriArchive_HasFailed(const kiriArchive* archive)
{
    return archive->isBad || archive->isShort;
}

/* READ: the bytes are bad unless `isFine`. */
void kiriArchive_Expect(kiriArchive* archive, bool isFine);

/* Transfers consecutive numbers of `width` bytes. */
void kiriArchive_Numbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count);

static inline void kiriArchive_Int32(kiriArchive* archive, int32_t* number)
{
    kiriArchive_Numbers(archive, number, 4, 1);
}

/* Transfers an integer that is not a field. READ: returns the stored value, checked to be in [least, most]. */
int32_t kiriArchive_Count(kiriArchive* archive, int64_t count, int64_t least, int64_t most);

/* Transfer one object, or several. READ: the objects must be zeroed, and get blocks of archive->memory. */
void kiriArchive_Object(kiriArchive* archive, kiriTableFn* table, void* object);
void kiriArchive_Objects(kiriArchive* archive, kiriTableFn* table, void* objects, int64_t count);

/* Transfers a block of numbers that is not a KIRI_ARRAY. READ: charges it to the room; null on failure. */
void kiriArchive_Block(kiriArchive* archive, void** block, int32_t width, int64_t count);

/* Hashes sizes and offsets of all fields. */
void kiriArchive_HashLayout(kiriTableFn* table, uint64_t* hash);

KIRI_C_END

#endif
