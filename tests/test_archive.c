/* State as bytes, of a struct that has all kinds of fields: whole, damaged, and without memory. */
#include "core/kiri_archive.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Point {
    double x, y;
} Point;

/* With padding, and something that is not kept. */
typedef struct Mark {
    int32_t number;
    uint8_t kind;
    bool isSet;
    int32_t dropped;
} Mark;

typedef struct Bag {
    KIRI_ARRAY(uint16_t) words;
} Bag;

enum { MOST_ROW = 12, BLOCK = 9 };

typedef struct Thing {
    int32_t first, second;
    uint64_t wide;
    bool flags[3];
    Mark marks[2];
    KIRI_ARRAY(int32_t) items;
    KIRI_ARRAY(Point) points;
    KIRI_ARRAY(Mark) parts;
    KIRI_ARRAY(Bag) bags;
    KIRI_ARRAY(double) room;
    KIRI_ARRAY(int32_t) space;
    Bag* owned;
    int32_t dropped;
    int32_t rowCount;
    float row[MOST_ROW];
    int32_t* block;
} Thing;

KIRI_TABLE(PointTable, Point, { KIRI_RUN(8, Point, x, y) });
KIRI_TABLE(MarkTable, Mark, { KIRI_RUN(4, Mark, number, number), KIRI_RUN(1, Mark, kind, kind),
                                          KIRI_BOOLS(Mark, isSet, isSet), KIRI_DROPPED(Mark, dropped, dropped) });
KIRI_TABLE(BagTable, Bag, { KIRI_ITEMS(2, Bag, words) });

static void ArchiveRow(kiriArchive* archive, void* object)
{
    Thing* thing = object;
    thing->rowCount = kiriArchive_Count(archive, thing->rowCount, 0, MOST_ROW);
    kiriArchive_Numbers(archive, thing->row, 4, thing->rowCount);
    kiriArchive_Block(archive, (void**)&thing->block, 4, BLOCK);
}

KIRI_TABLE(ThingTable, Thing, {
    KIRI_RUN(4, Thing, first, second),   KIRI_RUN(8, Thing, wide, wide), KIRI_BOOLS(Thing, flags, flags),
    KIRI_PART(Thing, marks, MarkTable),  KIRI_ITEMS(4, Thing, items),    KIRI_PARTS(Thing, points, PointTable),
    KIRI_PARTS(Thing, parts, MarkTable), KIRI_ROOM_OF(Thing, room),      KIRI_SPACE_OF(Thing, space),
    KIRI_OWNED(Thing, owned, BagTable),  KIRI_DROPPED(Thing, dropped, dropped),   KIRI_CUSTOM(Thing, rowCount, ArchiveRow),
    KIRI_PARTS(Thing, bags, BagTable),
});

/* ---- Things at random -------------------------------------------------------------------------------------------- */

/* Refuses all requests after so many; counts blocks. */
typedef struct Purse {
    int32_t left, out;
} Purse;

static void* PurseAlloc(void* user, int64_t bytes)
{
    Purse* purse = user;
    if (purse->left == 0) {
        return NULL;
    }
    purse->left -= 1;
    purse->out += 1;
    return memset(malloc((size_t)bytes), 0xcd, (size_t)bytes); /* whoever reads what was not written gets nonsense */
}

static void PurseFree(void* user, void* pointer)
{
    ((Purse*)user)->out -= pointer != NULL;
    free(pointer);
}

static kiriMemory Memory(Purse* purse)
{
    purse->left = INT32_MAX;
    purse->out = 0;
    return kiriMemory_Make(PurseAlloc, PurseFree, purse);
}

static Mark RandomMark(uint32_t* seed)
{
    Mark mark = { (int32_t)Random(seed), (uint8_t)Random(seed), Random(seed) % 2 == 0, 5 };
    return mark;
}

static void AddWords(kiriMemory* memory, Bag* bag, int32_t count, uint32_t* seed)
{
    for (int32_t k = 0; k < count; ++k) {
        uint16_t word = (uint16_t)Random(seed);
        assert_true(kiriArray_Push(memory, &bag->words, word));
    }
}

/* Changes a few things, so that what was is still most of it. */
static void Change(Thing* thing, kiriMemory* memory, uint32_t* seed)
{
    Point point = { RandomBetween(seed, -1.0, 1.0), 2.0 };
    Bag bag = { { NULL, 0, 0 } };
    int32_t number = (int32_t)(Random(seed) % 7);
    thing->first = number;
    thing->wide ^= (uint64_t)Random(seed) << 20;
    thing->flags[number % 3] ^= true;
    thing->marks[number % 2] = RandomMark(seed);
    for (int32_t n = 0; n < number; ++n) {
        assert_true(kiriArray_Push(memory, &thing->items, number % 2 == 0 ? 3 : (int32_t)Random(seed)));
        assert_true(kiriArray_Push(memory, &thing->points, point));
    }
    assert_true(kiriArray_Push(memory, &thing->parts, RandomMark(seed)));
    assert_true(kiriArray_Push(memory, &thing->bags, bag));
    AddWords(memory, &thing->bags.data[Random(seed) % (uint32_t)thing->bags.count], number, seed);
    assert_true(kiriArray_Reserve(memory, &thing->room, 10 * number) &&
                kiriArray_Resize(memory, &thing->space, number));
    if (thing->owned == NULL && number > 3) {
        thing->owned = kiriMemory_AllocZeroed(memory, sizeof(Bag));
        AddWords(memory, thing->owned, 20, seed);
    }
    if (number == 6) {
        thing->items.count = thing->points.count = 0;
    }
    thing->rowCount = (int32_t)(Random(seed) % (MOST_ROW + 1));
    for (int32_t k = 0; k < MOST_ROW; ++k) {
        thing->row[k] = (float)(k * number);
    }
    for (int32_t k = 0; k < BLOCK; ++k) {
        thing->block[k] = number < 3 ? -1 : (int32_t)Random(seed);
    }
    thing->dropped = 9;
}

static void MakeThing(Thing* thing, kiriMemory* memory, uint32_t* seed, int32_t changes)
{
    memset(thing, 0, sizeof(*thing));
    thing->block = kiriMemory_AllocZeroed(memory, sizeof(int32_t) * BLOCK);
    for (int32_t k = 0; k < changes; ++k) {
        Change(thing, memory, seed);
    }
}

/* ---- Bytes ------------------------------------------------------------------------------------------------------- */

typedef struct Bytes {
    uint8_t* data;
    int64_t size;
} Bytes;

/* In a block that is not larger than it has to be, so that a sanitizer sees who writes beyond. */
static Bytes Write(Thing* thing)
{
    kiriArchive measure = kiriArchive_Measure();
    kiriArchive_Object(&measure, &ThingTable, thing);
    Bytes bytes = { malloc((size_t)measure.at + 1), measure.at };
    kiriArchive archive = kiriArchive_Write(bytes.data, bytes.size);
    kiriArchive_Object(&archive, &ThingTable, thing);
    assert_false(archive.isBad);
    assert_int_equal(archive.at, bytes.size);
    return bytes;
}

static kiriArchive Read(Thing* thing, Bytes bytes, kiriMemory* memory)
{
    memset(thing, 0, sizeof(*thing));
    kiriArchive archive = kiriArchive_Read(bytes.data, bytes.size, memory);
    kiriArchive_Object(&archive, &ThingTable, thing);
    kiriArchive_Expect(&archive, archive.at == archive.size);
    return archive;
}

static void AssertSameBytes(Bytes a, Bytes b)
{
    assert_int_equal(a.size, b.size);
    assert_memory_equal(a.data, b.data, (size_t)a.size);
}

static void AssertSameThing(const Thing* a, const Thing* b)
{
    assert_true(a->first == b->first && a->second == b->second && a->wide == b->wide);
    assert_memory_equal(a->flags, b->flags, sizeof(a->flags));
    for (int32_t k = 0; k < 2; ++k) {
        assert_true(a->marks[k].number == b->marks[k].number && a->marks[k].kind == b->marks[k].kind);
        assert_true(a->marks[k].isSet == b->marks[k].isSet && b->marks[k].dropped == 0);
    }
    assert_true(a->items.count == b->items.count && a->items.capacity == b->items.capacity);
    assert_true(a->items.count == 0 || memcmp(a->items.data, b->items.data, 4 * (size_t)a->items.count) == 0);
    assert_true(a->points.count == b->points.count && a->points.capacity == b->points.capacity);
    assert_int_equal(a->parts.count, b->parts.count);
    for (int32_t k = 0; k < a->bags.count; ++k) {
        assert_int_equal(a->bags.data[k].words.count, b->bags.data[k].words.count);
    }
    assert_true(a->room.capacity == b->room.capacity && b->room.count == 0);
    assert_true(a->space.capacity == b->space.capacity && a->space.count == b->space.count);
    for (int32_t k = 0; k < b->space.count; ++k) {
        assert_int_equal(b->space.data[k], 0);
    }
    assert_true((a->owned == NULL) == (b->owned == NULL) && b->dropped == 0 && a->rowCount == b->rowCount);
    assert_memory_equal(a->row, b->row, sizeof(float) * (size_t)a->rowCount);
    assert_memory_equal(a->block, b->block, sizeof(int32_t) * BLOCK);
}

/* ---- Whole ------------------------------------------------------------------------------------------------------- */

static void TestWhole(void** state)
{
    (void)state;
    Purse purse;
    kiriMemory memory = Memory(&purse);
    for (uint32_t seed = 1; seed < 200; ++seed) {
        uint32_t random = seed;
        Thing thing, read;
        MakeThing(&thing, &memory, &random, (int32_t)(seed % 12));
        Bytes bytes = Write(&thing);
        kiriArchive archive = Read(&read, bytes, &memory);
        assert_false(kiriArchive_HasFailed(&archive));
        AssertSameThing(&thing, &read);
        Bytes again = Write(&read);
        AssertSameBytes(bytes, again);
        free(bytes.data);
        free(again.data);
        kiriMemory_FreeAll(&memory);
    }
    assert_int_equal(purse.out, 0);
}

/* Numbers have the lowest byte first, on any machine. */
static void TestOrderOfBytes(void** state)
{
    (void)state;
    static const uint8_t expected[14] = { 4, 3, 2, 1, 0xfe, 0xff, 8, 7, 6, 5, 4, 3, 2, 1 };
    uint8_t bytes[14];
    int32_t four = 0x01020304;
    int16_t two = -2;
    int64_t eight = 0x0102030405060708;
    kiriArchive archive = kiriArchive_Write(bytes, sizeof(bytes));
    kiriArchive_Int32(&archive, &four);
    kiriArchive_Numbers(&archive, &two, 2, 1);
    kiriArchive_Numbers(&archive, &eight, 8, 1);
    assert_memory_equal(bytes, expected, sizeof(bytes));
}

/* Where there are fewer bytes than it takes, nothing is written behind them. */
static void TestNoRoom(void** state)
{
    (void)state;
    Purse purse;
    kiriMemory memory = Memory(&purse);
    uint32_t seed = 5;
    Thing thing;
    MakeThing(&thing, &memory, &seed, 8);
    Bytes bytes = Write(&thing);
    for (int64_t size = 0; size < bytes.size; ++size) {
        uint8_t* few = malloc((size_t)size + 1);
        few[size] = 77;
        kiriArchive archive = kiriArchive_Write(few, size);
        kiriArchive_Object(&archive, &ThingTable, &thing);
        assert_true(archive.isBad && archive.at <= size && few[size] == 77);
        free(few);
    }
    free(bytes.data);
    kiriMemory_FreeAll(&memory);
}

/* ---- Bytes that are none ----------------------------------------------------------------------------------------- */

/* Whatever was read: arrays have room for what is in them, bools are bools, and it can be written. */
static void AssertSound(Thing* thing)
{
    uint8_t bools[5];
    memcpy(bools, thing->flags, 3);
    memcpy(bools + 3, &thing->marks[0].isSet, 1);
    memcpy(bools + 4, &thing->marks[1].isSet, 1);
    for (int32_t k = 0; k < 5; ++k) {
        assert_true(bools[k] <= 1);
    }
    assert_true(thing->items.count >= 0 && thing->items.count <= thing->items.capacity);
    assert_true(thing->bags.count >= 0 && thing->bags.count <= thing->bags.capacity);
    assert_true(thing->space.count >= 0 && thing->space.count <= thing->space.capacity);
    assert_true(thing->rowCount >= 0 && thing->rowCount <= MOST_ROW && thing->block != NULL);
    Bytes bytes = Write(thing);
    assert_true(bytes.size > 0);
    free(bytes.data);
}

static void CheckDamaged(Bytes bytes, kiriMemory* memory, int32_t* refused)
{
    Thing read;
    kiriArchive archive = Read(&read, bytes, memory);
    assert_false(archive.isShort);
    assert_true(archive.room >= 0);
    *refused += archive.isBad;
    if (!archive.isBad) {
        AssertSound(&read);
    }
    kiriMemory_FreeAll(memory);
}

/* Each bit of a thing is turned; and it is cut short anywhere. */
static void TestDamaged(void** state)
{
    (void)state;
    Purse purse, readPurse;
    kiriMemory memory = Memory(&purse), readMemory = Memory(&readPurse);
    uint32_t seed = 21;
    Thing thing;
    MakeThing(&thing, &memory, &seed, 7);
    Change(&thing, &memory, &seed);
    Bytes bytes = Write(&thing);
    int32_t refused = 0, cut = 0;
    for (int64_t bit = 0; bit < 8 * bytes.size; ++bit) {
        bytes.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
        CheckDamaged(bytes, &readMemory, &refused);
        bytes.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
    }
    assert_true(refused > 100);
    for (int64_t size = 0; size < bytes.size; ++size) {
        Bytes part = { malloc((size_t)size + 1), size };
        memcpy(part.data, bytes.data, (size_t)size);
        CheckDamaged(part, &readMemory, &cut);
        free(part.data);
    }
    assert_int_equal(cut, bytes.size);
    free(bytes.data);
    assert_int_equal(readPurse.out, 0);
    kiriMemory_FreeAll(&memory);
}

/* Counts that no bytes can have ask for no memory. */
static void TestLimits(void** state)
{
    (void)state;
    Purse purse;
    kiriMemory memory = Memory(&purse);
    Bag bag = { { NULL, 0, 0 } };
    const uint8_t many[9] = { 0xff, 0xff, 0xff, 0x7f, 1, 0, 0, 0, 0 }, negative[9] = { 0xff, 0xff, 0xff, 0xff, 0 };
    kiriArchive archive = kiriArchive_Read(many, sizeof(many), &memory);
    kiriArchive_Object(&archive, &BagTable, &bag);
    assert_true(archive.isBad && !archive.isShort && bag.words.capacity == 0 && purse.out == 0);
    archive = kiriArchive_Read(negative, sizeof(negative), &memory);
    kiriArchive_Object(&archive, &BagTable, &bag);
    assert_true(archive.isBad && bag.words.capacity == 0 && purse.out == 0);
    archive = kiriArchive_Read(many, 4, &memory);
    assert_int_equal(kiriArchive_Count(&archive, 0, 2, 10), 2);
    assert_true(archive.isBad);
}

/* ---- A new field --------------------------------------------------------------------------------------------------- */

/* A struct and its table from one list: a new field is one line. */
#define COLUMNS(X)                                                                                                     \
    X(double, weight, KIRI_REALS(Column, weight, weight))                                                              \
    X(int32_t, frame, KIRI_INDEX(KIRI_OF_FRAMES, Column, frame, frame))                                                \
    X(int32_t, added, KIRI_WITHIN(3, 5, Column, added, added))
#define DECLARE_COLUMN(type, name, entry) type name;
#define LIST_COLUMN(type, name, entry) entry,

typedef struct Column {
    COLUMNS(DECLARE_COLUMN)
} Column;

KIRI_TABLE(ColumnTable, Column, { COLUMNS(LIST_COLUMN) });

static bool CanLoad(Column column)
{
    uint8_t bytes[32];
    Column read = { 0 };
    kiriArchive archive = kiriArchive_Write(bytes, sizeof(bytes));
    kiriArchive_Object(&archive, &ColumnTable, &column);
    archive = kiriArchive_Read(bytes, archive.at, NULL);
    archive.count[KIRI_OF_FRAMES] = 7;
    kiriArchive_Object(&archive, &ColumnTable, &read);
    assert_true(archive.isBad || (read.weight == column.weight && read.frame == column.frame && read.added == column.added));
    return !archive.isBad;
}

static uint64_t HashOf(Column column)
{
    kiriArchive archive = kiriArchive_Hash();
    kiriArchive_Object(&archive, &ColumnTable, &column);
    return archive.hash;
}

/* It is saved, checked, hashed and restored. */
static void TestNewField(void** state)
{
    (void)state;
    const Column fine = { 0.5, 6, 4 }, other = { 0.5, 6, 5 };
    const Column bad[] = { { HUGE_VAL, 6, 4 }, { 0.5, 7, 4 }, { 0.5, -1, 4 }, { 0.5, 6, 2 }, { 0.5, 6, 6 } };
    assert_true(CanLoad(fine) && CanLoad(other));
    for (size_t k = 0; k < sizeof(bad) / sizeof(bad[0]); ++k) {
        assert_false(CanLoad(bad[k]));
    }
    assert_true(HashOf(fine) == HashOf(fine) && HashOf(fine) != HashOf(other));
    Column read = { 0 };
    uint8_t bytes[sizeof(Column)];
    kiriArchive archive = kiriArchive_Write(bytes, sizeof(bytes));
    archive.isWhole = true;
    kiriArchive_Object(&archive, &ColumnTable, (void*)(uintptr_t)&other);
    archive = kiriArchive_Read(bytes, sizeof(bytes), NULL);
    archive.isWhole = true;
    kiriArchive_Object(&archive, &ColumnTable, &read);
    assert_true(!archive.isBad && read.added == 5);
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

/* Without it nothing is read; that is no fault of the bytes. */
static void TestMemoryIsRefused(void** state)
{
    (void)state;
    Purse purse, readPurse;
    kiriMemory memory = Memory(&purse), readMemory = Memory(&readPurse);
    uint32_t seed = 33;
    Thing thing;
    MakeThing(&thing, &memory, &seed, 9);
    Change(&thing, &memory, &seed);
    Bytes bytes = Write(&thing);
    bool isRefused = true;
    int32_t n = 0;
    for (; isRefused; ++n) {
        Thing read;
        readPurse.left = n;
        kiriArchive archive = Read(&read, bytes, &readMemory);
        assert_false(archive.isBad);
        isRefused = archive.isShort;
        assert_true(isRefused || readPurse.left == 0);
        kiriMemory_FreeAll(&readMemory);
        assert_int_equal(readPurse.out, 0);
    }
    assert_true(n > 10);
    free(bytes.data);
    kiriMemory_FreeAll(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestWhole),           cmocka_unit_test(TestOrderOfBytes), cmocka_unit_test(TestNoRoom),
        cmocka_unit_test(TestDamaged), cmocka_unit_test(TestNewField),      cmocka_unit_test(TestLimits),
        cmocka_unit_test(TestMemoryIsRefused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
