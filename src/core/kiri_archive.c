#include "kiri_archive.h"

#include <string.h>

/* An array is written as its count, its capacity, and its items: as they are, or as four bytes that repeat. */
enum { ITEMS_AS_THEY_ARE, ITEMS_REPEAT, REPEATED_BYTES = 4 };

enum { MEMORY_A_BYTE = 64, MEMORY_FREE = 1 << 20 }; /* that arrays may take for each byte that is read, and beside */

kiriArchive kiriArchive_Measure(void)
{
    kiriArchive archive = { KIRI_ARCHIVE_MEASURE, NULL, 0, INT64_MAX, 0, NULL, false, false, false };
    return archive;
}

kiriArchive kiriArchive_Write(void* bytes, int64_t size)
{
    kiriArchive archive = { KIRI_ARCHIVE_WRITE, bytes, 0, size, 0, NULL, false, false, false };
    return archive;
}

kiriArchive kiriArchive_Read(const void* bytes, int64_t size, kiriMemory* memory)
{
    int64_t room = size < INT64_MAX / (2 * MEMORY_A_BYTE) ? MEMORY_FREE + MEMORY_A_BYTE * size : INT64_MAX;
    kiriArchive archive = { KIRI_ARCHIVE_READ, (uint8_t*)(uintptr_t)bytes, 0, size, room, memory, false, false, false };
    return archive;
}

void kiriArchive_Expect(kiriArchive* archive, bool isFine)
{
    archive->isBad |= kiriArchive_Reads(archive) && !isFine && !archive->isShort;
}

/* ---- Bytes ------------------------------------------------------------------------------------------------------- */

/* Where the next bytes are; null where there are not so many, or none are kept. */
static uint8_t* TakeBytes(kiriArchive* archive, int64_t count)
{
    if (count > archive->size - archive->at || kiriArchive_HasFailed(archive)) {
        archive->isBad |= !archive->isShort;
        return NULL;
    }
    uint8_t* bytes = archive->bytes == NULL ? NULL : archive->bytes + archive->at;
    archive->at += count;
    return bytes;
}

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
        for (int32_t k = 0; k < width; ++k) {
            to[n + k] = from[n + width - 1 - k];
        }
    }
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

void kiriArchive_Numbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count)
{
    uint8_t* bytes = count == 0 ? NULL : TakeBytes(archive, count * width);
    if (bytes != NULL && kiriArchive_Reads(archive)) {
        CopyNumbers(numbers, bytes, width, count);
    } else if (bytes != NULL) {
        CopyNumbers(bytes, numbers, width, count);
    } else if (count > 0 && kiriArchive_Reads(archive)) {
        memset(numbers, 0, (size_t)(count * width));
    }
}

/* A byte that is neither 0 nor 1 is no bool, and nobody may read it: of what was never written, or of bytes that are
   none. */
static void MoveBools(kiriArchive* archive, void* bools, int32_t count)
{
    uint8_t* bytes = bools;
    if (archive->isWhole) {
        kiriArchive_Numbers(archive, bools, 1, count);
        return;
    }
    for (int32_t k = 0; k < count; ++k) {
        uint8_t byte = kiriArchive_Reads(archive) ? 0 : bytes[k] != 0;
        kiriArchive_Numbers(archive, &byte, 1, 1);
        if (kiriArchive_Reads(archive)) {
            kiriArchive_Expect(archive, byte <= 1);
            bytes[k] = byte == 1;
        }
    }
}

int32_t kiriArchive_Count(kiriArchive* archive, int64_t count, int64_t least, int64_t most)
{
    int32_t number = (int32_t)count;
    kiriArchive_Int32(archive, &number);
    kiriArchive_Expect(archive, number >= least && number <= most);
    return number < least || number > most ? (int32_t)least : number;
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

/* The header of an array, which is made where bytes are read; `hasItems`: else it is empty then. */
static kiriArrayHeader MoveHeader(kiriArchive* archive, void* array, int32_t itemBytes, bool hasItems)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    kiriArchive_Int32(archive, &header.capacity);
    if (hasItems) {
        kiriArchive_Int32(archive, &header.count);
    }
    if (kiriArchive_Reads(archive)) {
        header.count = hasItems ? header.count : 0;
        kiriArchive_Expect(archive, header.count >= 0 && header.count <= header.capacity);
        header.data = header.capacity < 0 ? NULL : MakeBlock(archive, header.capacity * (int64_t)itemBytes);
        header.capacity = header.data == NULL ? 0 : header.capacity;
        header.count = header.data == NULL ? 0 : header.count;
        kiriArray_SetHeader(array, header);
    }
    return header;
}

static bool Repeats(const uint8_t* bytes, int64_t count)
{
    return count > 2 * REPEATED_BYTES && memcmp(bytes, bytes + REPEATED_BYTES, (size_t)(count - REPEATED_BYTES)) == 0;
}

/* Lists of marks are mostly the same number over and over. */
static void MoveItems(kiriArchive* archive, uint8_t* data, int32_t width, int64_t bytes)
{
    if (archive->isWhole) {
        kiriArchive_Numbers(archive, data, 1, bytes);
        return;
    }
    uint8_t tag = !kiriArchive_Reads(archive) && Repeats(data, bytes) ? ITEMS_REPEAT : ITEMS_AS_THEY_ARE;
    kiriArchive_Numbers(archive, &tag, 1, 1);
    if (tag != ITEMS_REPEAT) {
        kiriArchive_Expect(archive, tag == ITEMS_AS_THEY_ARE);
        kiriArchive_Numbers(archive, data, width, bytes / width);
        return;
    }
    kiriArchive_Expect(archive, bytes > 2 * REPEATED_BYTES);
    if (kiriArchive_HasFailed(archive)) {
        return;
    }
    int32_t narrow = width < REPEATED_BYTES ? width : REPEATED_BYTES;
    kiriArchive_Numbers(archive, data, narrow, REPEATED_BYTES / narrow);
    for (int64_t n = REPEATED_BYTES; n < bytes && kiriArchive_Reads(archive); n *= 2) {
        memcpy(data + n, data, (size_t)(bytes - n < n ? bytes - n : n)); /* what is there, as often as it fits */
    }
}

static void MoveArrayOfNumbers(kiriArchive* archive, const kiriMember* member, void* array)
{
    kiriArrayHeader header = MoveHeader(archive, array, member->size, true);
    if (header.count > 0) {
        MoveItems(archive, header.data, member->width, header.count * (int64_t)member->size);
    }
}

int32_t kiriArchive_Row(kiriArchive* archive, void* numbers, int32_t width, int32_t count, int32_t room)
{
    count = kiriArchive_Count(archive, count, 0, kiriArchive_Reads(archive) ? room : INT32_MAX);
    kiriArchive_Numbers(archive, numbers, width, count);
    return count;
}

static void MoveArrayOfParts(kiriArchive* archive, const kiriMember* member, void* array)
{
    kiriArrayHeader header = MoveHeader(archive, array, member->size, true);
    if (header.count > 0) {
        memset(header.data, 0, kiriArchive_Reads(archive) ? (size_t)header.count * (size_t)member->size : 0);
        kiriArchive_Objects(archive, member->table, header.data, header.count);
    }
}

static void MoveSpace(kiriArchive* archive, const kiriMember* member, void* array)
{
    kiriArrayHeader header = MoveHeader(archive, array, member->size, true);
    if (archive->isWhole && member->kind == KIRI_MEMBER_SHOWN) {
        kiriArchive_Numbers(archive, header.data, 1, header.count * (int64_t)member->size);
    } else if (header.count > 0 && kiriArchive_Reads(archive)) {
        memset(header.data, 0, (size_t)header.count * (size_t)member->size);
    }
}

void kiriArchive_Block(kiriArchive* archive, void** block, int32_t width, int64_t count)
{
    if (kiriArchive_HasFailed(archive)) {
        return; /* the count may be any */
    }
    if (kiriArchive_Reads(archive)) {
        *block = MakeBlock(archive, count * width);
    }
    if (*block != NULL) {
        MoveItems(archive, *block, width, count * width);
    }
}

/* ---- Objects ----------------------------------------------------------------------------------------------------- */

static void MoveOwned(kiriArchive* archive, const kiriMember* member, void* pointer)
{
    void* object;
    memcpy(&object, pointer, sizeof(object));
    int32_t isThere = kiriArchive_Count(archive, object != NULL, 0, 1);
    if (isThere && kiriArchive_Reads(archive)) {
        object = MakeBlock(archive, member->table->size);
        if (object != NULL) {
            memset(object, 0, (size_t)member->table->size);
        }
        memcpy(pointer, &object, sizeof(object));
    }
    if (isThere && object != NULL) {
        kiriArchive_Object(archive, member->table, object);
    }
}

static void MoveField(kiriArchive* archive, const kiriMember* member, uint8_t* object)
{
    void* at = object + member->offset;
    switch (member->kind) {
    case KIRI_MEMBER_RUN:
        kiriArchive_Numbers(archive, at, member->width, member->size / member->width);
        break;
    case KIRI_MEMBER_BOOLS:
        MoveBools(archive, at, member->size);
        break;
    case KIRI_MEMBER_PART:
        kiriArchive_Objects(archive, member->table, at, member->size / member->table->size);
        break;
    case KIRI_MEMBER_ITEMS:
        MoveArrayOfNumbers(archive, member, at);
        break;
    case KIRI_MEMBER_PARTS:
        MoveArrayOfParts(archive, member, at);
        break;
    case KIRI_MEMBER_ROOM:
        MoveHeader(archive, at, member->size, false);
        break;
    case KIRI_MEMBER_SPACE:
    case KIRI_MEMBER_SHOWN:
        MoveSpace(archive, member, at);
        break;
    case KIRI_MEMBER_OWNED:
        MoveOwned(archive, member, at);
        break;
    case KIRI_MEMBER_CUSTOM:
        member->custom(archive, object);
        break;
    default:
        break;
    }
}

void kiriArchive_Object(kiriArchive* archive, const kiriTable* table, void* object)
{
    for (int32_t k = 0; k < table->count; ++k) {
        MoveField(archive, &table->fields[k], object);
    }
}

/* True if an object in memory is its bytes: always for numbers without padding, in a snapshot for all that owns
   nothing. */
static bool IsTight(const kiriTable* table, bool isWhole)
{
    int32_t size = 0;
    bool isTight = true;
    for (int32_t k = 0; k < table->count; ++k) {
        const kiriMember* member = &table->fields[k];
        bool isNumbers = member->kind == KIRI_MEMBER_RUN || (member->kind == KIRI_MEMBER_BOOLS && isWhole) ||
                         (member->kind == KIRI_MEMBER_PART && IsTight(member->table, isWhole));
        isTight = isTight && isNumbers;
        size += member->size;
    }
    return isTight && (isWhole || size == table->size);
}

/* How many bytes an object is that has no arrays; KIRI_NONE where that is not the same of all. */
static int64_t BytesOfObject(const kiriTable* table)
{
    int64_t bytes = 0;
    for (int32_t k = 0; k < table->count && bytes != KIRI_NONE; ++k) {
        const kiriMember* member = &table->fields[k];
        int64_t part = member->kind == KIRI_MEMBER_PART ? BytesOfObject(member->table) : 1;
        bool isPart = member->kind == KIRI_MEMBER_PART && part != KIRI_NONE;
        bool isFixed = isPart || member->kind == KIRI_MEMBER_RUN || member->kind == KIRI_MEMBER_BOOLS;
        int64_t more = isPart ? part * (member->size / member->table->size) : member->size;
        bytes = isFixed ? bytes + more : member->kind == KIRI_MEMBER_DROPPED ? bytes : KIRI_NONE;
    }
    return bytes;
}

void kiriArchive_Objects(kiriArchive* archive, const kiriTable* table, void* objects, int64_t count)
{
    if (count > 1 && IsLittleEndian() && IsTight(table, archive->isWhole)) {
        kiriArchive_Numbers(archive, objects, 1, count * table->size);
        return;
    }
    int64_t each = archive->mode == KIRI_ARCHIVE_MEASURE && !archive->isWhole ? BytesOfObject(table) : KIRI_NONE;
    if (each != KIRI_NONE) {
        TakeBytes(archive, each * count);
        return;
    }
    for (int64_t n = 0; n < count && !kiriArchive_HasFailed(archive); ++n) {
        kiriArchive_Object(archive, table, (uint8_t*)objects + n * table->size);
    }
}

void kiriArchive_HashLayout(const kiriTable* table, uint64_t* hash)
{
    kiriHash_Int32(hash, table->size);
    for (int32_t k = 0; k < table->count; ++k) {
        const kiriMember* member = &table->fields[k];
        kiriHash_Int32(hash, member->kind);
        kiriHash_Int32(hash, member->offset);
        kiriHash_Int32(hash, member->size);
        if (member->table != NULL) {
            kiriArchive_HashLayout(member->table, hash);
        }
    }
}
