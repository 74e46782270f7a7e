#include "kiri_archive.h"

enum { MEMORY_A_BYTE = 96, MEMORY_FREE = 4 << 20 }; /* memory limit of arrays: for each byte read, plus a constant */

kiriArchive kiriArchive_Measure(void)
{
    return (kiriArchive){ .mode = KIRI_ARCHIVE_MEASURE, .size = INT64_MAX };
}

kiriArchive kiriArchive_Write(void* bytes, int64_t size)
{
    return (kiriArchive){ .mode = KIRI_ARCHIVE_WRITE, .bytes = bytes, .size = size };
}

kiriArchive kiriArchive_Read(const void* bytes, int64_t size, kiriMemory* memory)
{
    int64_t room = size < INT64_MAX / (2 * MEMORY_A_BYTE) ? MEMORY_FREE + MEMORY_A_BYTE * size : INT64_MAX;
    return (kiriArchive){
        .mode = KIRI_ARCHIVE_READ, .bytes = (uint8_t*)(uintptr_t)bytes, .size = size, .room = room, .memory = memory
    };
}

kiriArchive kiriArchive_Hash(void)
{
    return (kiriArchive){ .mode = KIRI_ARCHIVE_HASH, .hash = KIRI_HASH_START };
}

void kiriArchive_Expect(kiriArchive* archive, bool isFine)
{
    archive->isBad |= kiriArchive_Reads(archive) && !isFine && !archive->isShort;
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static bool IsLittleEndian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 1;
}

static void CopyNumbers(uint8_t* to, const uint8_t* from, int32_t width, int64_t count)
{
    if (width == 1 || IsLittleEndian()) {
        memcpy(to, from, (size_t)(count * width));
        return;
    }
    for (int64_t n = 0; n < count * width; n += width) {
        KIRI_TIMES(k, width) {
            to[n + k] = from[n + width - 1 - k];
        }
    }
}

/* Hashes values, so the hash is the same on machines of either byte order. */
static void HashNumbers(uint64_t* hash, const uint8_t* numbers, int32_t width, int64_t count)
{
    for (int64_t n = 0; n < count; ++n) {
        int64_t wide = numbers[n];
        int32_t narrow;
        if (width == 8) {
            memcpy(&wide, numbers + 8 * n, 8);
        } else if (width == 4) {
            memcpy(&narrow, numbers + 4 * n, 4);
            wide = narrow;
        }
        kiriHash_Int64(hash, wide);
    }
}

void kiriArchive_Numbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count)
{
    KIRI_ASSERT(count >= 0 && (width == 1 || width == 2 || width == 4 || width == 8));
    if (archive->mode == KIRI_ARCHIVE_HASH) {
        KIRI_ASSERT(width != 2);
        HashNumbers(&archive->hash, numbers, width, count);
        return;
    }
    uint8_t* bytes = NULL; /* numbers are only measured, or there are too few bytes */
    if (count * width > archive->size - archive->at || kiriArchive_HasFailed(archive)) {
        archive->isBad |= count > 0 && !archive->isShort;
    } else {
        bytes = archive->bytes == NULL || count == 0 ? NULL : archive->bytes + archive->at;
        archive->at += count * width;
    }
    KIRI_ASSERT(archive->at >= 0);
    if (bytes != NULL && kiriArchive_Reads(archive)) {
        CopyNumbers(numbers, bytes, width, count);
    } else if (bytes != NULL) {
        CopyNumbers(bytes, numbers, width, count);
    } else if (count > 0 && kiriArchive_Reads(archive)) {
        memset(numbers, 0, (size_t)(count * width));
    }
}

int32_t kiriArchive_Count(kiriArchive* archive, int64_t count, int64_t least, int64_t most)
{
    int32_t number = (int32_t)count;
    kiriArchive_Int32(archive, &number);
    kiriArchive_Expect(archive, number >= least && number <= most);
    return number < least || number > most ? (int32_t)least : number;
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

/* Returns false if all bits of an exponent are set: infinity, or NaN. */
static bool AreFinite(const uint8_t* numbers, int32_t width, int64_t bytes)
{
    bool areFinite = true;
    for (int64_t k = 0; k < bytes; k += width) {
        uint64_t wide;
        uint32_t narrow;
        if (width == 8) {
            memcpy(&wide, numbers + k, 8);
            areFinite &= (~wide & UINT64_C(0x7ff0000000000000)) != 0;
        } else {
            memcpy(&narrow, numbers + k, 4);
            areFinite &= (~narrow & 0x7f800000u) != 0;
        }
    }
    return areFinite;
}

static bool AreFine(const kiriArchive* archive, const kiriMember* field, const void* numbers, int64_t bytes)
{
    int64_t high = field->high + (field->of == KIRI_OF_NOTHING ? 0 : archive->count[field->of]);
    bool areFine = true;
    switch (field->item) {
    case KIRI_MEMBER_REALS:
    case KIRI_MEMBER_FLOATS:
        return AreFinite(numbers, field->width, bytes);
    case KIRI_MEMBER_COUNTS:
        for (int64_t k = 0; k < bytes / 8; ++k) {
            int64_t count = ((const int64_t*)numbers)[k];
            areFine &= count >= 0 && count < INT64_C(1) << 56; /* sums of a few cannot overflow */
        }
        return areFine;
    case KIRI_MEMBER_INTS:
        for (int64_t k = 0; k < bytes / 4; ++k) {
            int32_t number = ((const int32_t*)numbers)[k];
            areFine &= number >= field->low && number <= high;
        }
        return areFine;
    default:
        return true;
    }
}

static void MoveNumbers(kiriArchive* archive, const kiriMember* field, void* numbers, int64_t bytes)
{
    KIRI_ASSERT(field->width > 0 && bytes % field->width == 0);
    if (!archive->isUnmoved) {
        kiriArchive_Numbers(archive, numbers, field->width, bytes / field->width);
    }
    if (kiriArchive_Reads(archive) && !archive->isWhole && !kiriArchive_HasFailed(archive)) {
        archive->isBad = !AreFine(archive, field, numbers, bytes);
    }
}

/* ---- Arrays ------------------------------------------------------------------------------------------------------ */

static void* MakeBlock(kiriArchive* archive, int64_t bytes)
{
    archive->isBad |= bytes > archive->room;
    void* block = kiriArchive_HasFailed(archive) || bytes == 0 ? NULL : kiriMemory_Alloc(archive->memory, bytes);
    archive->isShort |= block == NULL && bytes > 0 && !archive->isBad;
    archive->room -= block != NULL ? bytes : 0;
    return block;
}

void kiriArchive_Block(kiriArchive* archive, void** block, int32_t width, int64_t count)
{
    if (kiriArchive_Reads(archive)) {
        *block = kiriArchive_HasFailed(archive) ? NULL : MakeBlock(archive, count * width);
    }
    if (*block != NULL) {
        kiriArchive_Numbers(archive, *block, width, count);
    }
}

/* Moves the items of an array. In a snapshot the enclosing struct contains count and capacity. */
static void MoveBlock(kiriArchive* archive, const kiriMember* field, void* array)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    bool hasItems = field->kind == KIRI_MEMBER_ARRAY;
    if (archive->mode == KIRI_ARCHIVE_HASH && !hasItems) {
        return;
    }
    header.count = field->kind == KIRI_MEMBER_ROOM ? 0 : header.count;
    if (!archive->isWhole) {
        if (archive->mode != KIRI_ARCHIVE_HASH) {
            kiriArchive_Int32(archive, &header.capacity);
        }
        if (field->kind != KIRI_MEMBER_ROOM) {
            kiriArchive_Int32(archive, &header.count);
        }
    }
    if (kiriArchive_Reads(archive)) {
        kiriArchive_Expect(archive, header.count >= 0 && header.count <= header.capacity);
        header.data = header.capacity < 0 ? NULL : MakeBlock(archive, header.capacity * (int64_t)field->size);
        header.capacity = header.data == NULL ? 0 : header.capacity;
        header.count = header.data == NULL ? 0 : header.count;
        kiriArray_SetHeader(array, header);
        if (header.count > 0 && (!hasItems || (field->table != NULL && !archive->isWhole))) {
            memset(header.data, 0, (size_t)header.count * field->size);
        }
    }
    if (hasItems && field->table != NULL) {
        kiriArchive_Objects(archive, field->table, header.data, header.count);
    } else if (hasItems && header.count > 0) {
        MoveNumbers(archive, field, header.data, header.count * (int64_t)field->size);
    }
}

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

static void MoveOwned(kiriArchive* archive, const kiriMember* field, void* pointer)
{
    void* object;
    memcpy(&object, pointer, sizeof(object));
    int32_t isThere = kiriArchive_Count(archive, object != NULL, 0, 1);
    if (kiriArchive_Reads(archive)) {
        object = isThere ? MakeBlock(archive, field->table()->size) : NULL;
        if (object != NULL) {
            memset(object, 0, field->table()->size);
        }
        memcpy(pointer, &object, sizeof(object));
    }
    if (object != NULL) {
        kiriArchive_Object(archive, field->table, object);
    }
}

static void MoveFields(kiriArchive* archive, const kiriTable* table, uint8_t* object);

static void MoveField(kiriArchive* archive, const kiriMember* field, uint8_t* object)
{
    uint8_t* at = object + field->offset;
    switch (field->kind) {
    case KIRI_MEMBER_NUMBERS:
    case KIRI_MEMBER_REALS:
    case KIRI_MEMBER_FLOATS:
    case KIRI_MEMBER_COUNTS:
    case KIRI_MEMBER_INTS:
        if (!archive->isWhole) {
            MoveNumbers(archive, field, at, field->size);
        }
        break;
    case KIRI_MEMBER_BOOLS:
        /* Writes any byte but 0 as 1, for memory may be uninitialised. Refuses other bytes than 0 and 1 of a save. */
        KIRI_TIMES_WHILE(!archive->isWhole, k, field->size) {
            uint8_t byte = kiriArchive_Reads(archive) ? 0 : at[k] != 0;
            kiriArchive_Numbers(archive, &byte, 1, 1);
            if (kiriArchive_Reads(archive)) {
                kiriArchive_Expect(archive, byte <= 1);
                at[k] = byte == 1;
            }
        }
        break;
    case KIRI_MEMBER_PART:
        KIRI_ASSERT(field->size % field->table()->size == 0);
        for (int32_t n = 0; n < field->size; n += field->table()->size) {
            MoveFields(archive, field->table(), at + n);
        }
        break;
    case KIRI_MEMBER_ARRAY:
    case KIRI_MEMBER_ROOM:
    case KIRI_MEMBER_SPACE:
        MoveBlock(archive, field, at);
        break;
    case KIRI_MEMBER_OWNED:
        MoveOwned(archive, field, at);
        break;
    case KIRI_MEMBER_CUSTOM:
        field->custom(archive, object);
        break;
    case KIRI_MEMBER_DROPPED:
        if (archive->isWhole && kiriArchive_Reads(archive)) {
            memset(at, 0, field->size);
        }
        break;
    default:
        break;
    }
}

static void MoveFields(kiriArchive* archive, const kiriTable* table, uint8_t* object)
{
    kiriMemory* memory = archive->memory;
    KIRI_EACH_INDEX(k, *table) {
        const kiriMember* field = &table->fields[k];
        if ((field->kind == KIRI_MEMBER_DERIVED && !archive->isWhole) ||
            (field->kind == KIRI_MEMBER_UNHASHED && archive->mode == KIRI_ARCHIVE_HASH)) {
            break;
        }
        archive->memory = field->kind == KIRI_MEMBER_HANDED ? archive->shown : archive->memory;
        MoveField(archive, field, object);
    }
    archive->memory = memory;
}

enum { MOST_KEPT = 1024 };

/* Copies the KEPT fields of an object, or puts them back. Returns their bytes. */
static int32_t MoveKept(const kiriTable* table, uint8_t* object, uint8_t* kept, bool isBack)
{
    int32_t bytes = 0;
    KIRI_EACH_INDEX(k, *table) {
        const kiriMember* field = &table->fields[k];
        uint8_t* at = object + field->offset;
        if (field->kind == KIRI_MEMBER_KEPT) {
            KIRI_ASSERT(bytes + field->size <= MOST_KEPT);
            memcpy(isBack ? at : kept + bytes, isBack ? kept + bytes : at, field->size);
            bytes += field->size;
        } else if (field->kind == KIRI_MEMBER_PART && field->size == field->table()->size) {
            bytes += MoveKept(field->table(), at, kept + bytes, isBack);
        }
    }
    return bytes;
}

/* Returns true if a struct contains only numbers: then a snapshot needs only its bytes. */
static bool IsFlat(const kiriTable* table)
{
    bool isFlat = true;
    KIRI_TIMES_WHILE(isFlat, k, table->count) {
        const kiriMember* field = &table->fields[k];
        isFlat = field->kind <= KIRI_MEMBER_BOOLS || field->kind == KIRI_MEMBER_UNHASHED ||
                 (field->kind == KIRI_MEMBER_PART && IsFlat(field->table()));
    }
    return isFlat;
}

/* Returns true if memory and save have the same bytes: fields are numbers, in order, without padding. */
static bool IsTight(const kiriTable* table)
{
    int32_t size = 0;
    KIRI_EACH_INDEX(k, *table) {
        const kiriMember* field = &table->fields[k];
        bool isNumbers =
            field->kind < KIRI_MEMBER_BOOLS || (field->kind == KIRI_MEMBER_PART && IsTight(field->table()));
        if (field->kind == KIRI_MEMBER_UNHASHED) {
            continue;
        }
        if (!isNumbers || field->offset != size) {
            return false;
        }
        size += field->size;
    }
    return size == table->size;
}

/* Moves objects in a snapshot, which begins with all their bytes. */
static void MoveWhole(kiriArchive* archive, const kiriTable* table, uint8_t* objects, int64_t count)
{
    uint8_t kept[MOST_KEPT];
    bool isKept = count == 1 && kiriArchive_Reads(archive) && MoveKept(table, objects, kept, false) > 0;
    kiriArchive_Numbers(archive, objects, 1, count * table->size);
    if (isKept) {
        MoveKept(table, objects, kept, true);
    }
    for (int64_t n = 0; n < count && !IsFlat(table) && !kiriArchive_HasFailed(archive); ++n) {
        MoveFields(archive, table, objects + n * table->size);
    }
}

void kiriArchive_Objects(kiriArchive* archive, kiriTableFn* of, void* objects, int64_t count)
{
    const kiriTable* table = of();
    KIRI_ASSERT(count >= 0);
    if (archive->isWhole) {
        MoveWhole(archive, table, objects, count);
        return;
    }
    bool isRow = count > 1 && archive->mode != KIRI_ARCHIVE_HASH && IsLittleEndian() && IsTight(table);
    if (isRow) {
        kiriArchive_Numbers(archive, objects, 1, count * table->size);
        archive->isUnmoved = true;
    }
    for (int64_t n = 0; n < count && (!isRow || kiriArchive_Reads(archive)) && !kiriArchive_HasFailed(archive); ++n) {
        MoveFields(archive, table, (uint8_t*)objects + n * table->size);
    }
    archive->isUnmoved = false;
}

void kiriArchive_Object(kiriArchive* archive, kiriTableFn* table, void* object)
{
    kiriArchive_Objects(archive, table, object, 1);
}

void kiriArchive_HashLayout(kiriTableFn* of, uint64_t* hash)
{
    const kiriTable* table = of();
    kiriHash_Int32(hash, table->size);
    KIRI_EACH_INDEX(k, *table) {
        const kiriMember* field = &table->fields[k];
        kiriHash_Int32(hash, field->kind);
        kiriHash_Int32(hash, field->offset);
        kiriHash_Int32(hash, field->size);
        if (field->table != NULL) {
            kiriArchive_HashLayout(field->table, hash);
        }
    }
}
