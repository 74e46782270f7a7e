/* Values of scripts to those of C, and back. */
#include "call.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_NUMBERS = 16 };

static const int SIZES[] = { 0, 4, 4, 8, 8, 2, 1, 4, 8, 4, 4, 0 };

int SizeOfItem(Kind kind)
{
    static const int ITEMS[KIND_COUNT] = { 0, 1, 8, 8, 0, 8, 12, 36, 0, 0, 0, 1, 4, 4, 8, 12, 16, 0 };
    return ITEMS[kind];
}

/* ---- Memory for a call ---- */

void* TakeScratch(Scratch* scratch, int64_t bytes)
{
    if (scratch->count == scratch->capacity) {
        int capacity = scratch->capacity > 0 ? 2 * scratch->capacity : 8;
        void** grown = realloc(scratch->items, (size_t)capacity * sizeof *grown);
        if (grown == NULL) {
            return NULL;
        }
        scratch->items = grown;
        scratch->capacity = capacity;
    }
    void* taken = calloc(1, bytes > 0 ? (size_t)bytes : 1);
    if (taken != NULL) {
        scratch->items[scratch->count++] = taken;
    }
    return taken;
}

void FreeScratch(Scratch* scratch)
{
    for (int i = 0; i < scratch->count; ++i) {
        free(scratch->items[i]);
    }
    free(scratch->items);
}

/* ---- Numbers ---- */

static int64_t LoadInt(Type type, const void* from)
{
    switch (type) {
    case TYPE_UINT32:
        return *(const uint32_t*)from;
    case TYPE_INT64:
    case TYPE_UINT64:
        return *(const int64_t*)from;
    default:
        return *(const int32_t*)from;
    }
}

static double LoadReal(Type type, const void* from)
{
    return type == TYPE_DOUBLE ? *(const double*)from : *(const float*)from;
}

static int IsReal(Type type)
{
    return type == TYPE_FLOAT || type == TYPE_DOUBLE;
}

static int IsNumber(const Variant* value)
{
    Kind kind = KindOf(value);
    return kind == KIND_INT || kind == KIND_REAL || kind == KIND_BOOL;
}

/* Whether a whole number fits. */
static int StoreInt(Type type, int64_t value, void* to)
{
    if (type == TYPE_INT64 || type == TYPE_UINT64) {
        *(int64_t*)to = value;
        return 1;
    }
    if (type == TYPE_BYTE) {
        *(uint8_t*)to = (uint8_t)value;
        return value >= 0 && value <= UINT8_MAX;
    }
    if (type == TYPE_UINT32) {
        *(uint32_t*)to = (uint32_t)value;
        return value >= INT32_MIN && value <= UINT32_MAX;
    }
    *(int32_t*)to = (int32_t)value;
    return value >= INT32_MIN && value <= INT32_MAX;
}

static int ReadNumber(const Variant* value, Type type, void* to)
{
    if (!IsNumber(value)) {
        return 0;
    }
    if (type == TYPE_DOUBLE) {
        *(double*)to = ToReal(value);
        return 1;
    }
    if (type == TYPE_FLOAT) {
        *(float*)to = (float)ToReal(value);
        return 1;
    }
    return StoreInt(type, ToInt(value), to);
}

int ReadItem(const Variant* value, Type type, Class class, const Self* world, void* item)
{
    if (type != TYPE_ID) {
        return ReadNumber(value, type, item);
    }
    const Self* self = ToSelf(value);
    *(uint32_t*)item = self != NULL ? self->id : 0;
    return KindOf(value) == KIND_NIL || (self != NULL && self->class == class && self->owner == world);
}

static int TakeFloats(const Variant* value, float numbers[MOST_NUMBERS]);

/* Of an array of numbers, or of vectors. */
static int TakeEach(const Variant* array, float numbers[MOST_NUMBERS])
{
    int64_t rows = CountRows(array);
    int taken = 0;
    for (int64_t i = 0; i < rows; ++i) {
        float some[MOST_NUMBERS];
        Variant item = GetItem(array, i);
        int count = ReadNumber(&item, TYPE_FLOAT, some) ? 1 : KindOf(&item) <= KIND_BASIS ? TakeFloats(&item, some) : 0;
        DropValue(&item);
        if (count == 0 || taken + count > MOST_NUMBERS) {
            return 0;
        }
        memcpy(numbers + taken, some, (size_t)count * sizeof *some);
        taken += count;
    }
    return taken;
}

/* Numbers of a vector, of a packed array, or of an array: how many, 0 where there are none or too many. */
static int TakeFloats(const Variant* value, float numbers[MOST_NUMBERS])
{
    Kind kind = KindOf(value);
    if (kind >= KIND_VECTOR2 && kind <= KIND_BASIS) {
        ToVector(value, numbers);
        return SizeOfItem(kind) / 4;
    }
    if (kind == KIND_ARRAY) {
        return TakeEach(value, numbers);
    }
    if (kind != KIND_FLOATS && kind != KIND_VECTORS2 && kind != KIND_VECTORS3) {
        return 0;
    }
    int64_t count = CountRows(value) * SizeOfItem(kind) / 4;
    if (count > MOST_NUMBERS) {
        return 0;
    }
    CopyRows(value, numbers);
    return (int)count;
}

/* Godot stores a basis by rows, and Kiri a rotation by columns. */
static void Transpose(float numbers[9])
{
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < i; ++k) {
            float kept = numbers[3 * i + k];
            numbers[3 * i + k] = numbers[3 * k + i];
            numbers[3 * k + i] = kept;
        }
    }
}

int ReadNumbers(const Variant* value, Type type, int count, void* numbers)
{
    float taken[MOST_NUMBERS];
    if (TakeFloats(value, taken) != count) {
        return 0;
    }
    if (KindOf(value) == KIND_BASIS) {
        Transpose(taken);
    }
    for (int i = 0; i < count; ++i) {
        if (type == TYPE_DOUBLE) {
            ((double*)numbers)[i] = taken[i];
        } else {
            ((float*)numbers)[i] = taken[i];
        }
    }
    return 1;
}

Variant WriteItem(Type type, Class class, Self* world, const void* item)
{
    if (type == TYPE_ID) {
        return HandleOf(world, class, *(const uint32_t*)item);
    }
    if (IsReal(type)) {
        return OfReal(LoadReal(type, item));
    }
    return type == TYPE_FLAG ? OfBool(*(const int32_t*)item != 0) : OfInt(LoadInt(type, item));
}

Variant WriteNumbers(Kind kind, Type type, int count, const void* numbers)
{
    float floats[MOST_NUMBERS];
    for (int i = 0; i < count; ++i) {
        floats[i] = (float)LoadReal(type, (const char*)numbers + i * SIZES[type]);
    }
    if (kind == KIND_FLOATS) {
        return OfRows(kind, floats, count);
    }
    if (kind == KIND_BASIS) {
        Transpose(floats);
    }
    return OfVector(kind, floats);
}

/* ---- Rows ---- */

/* What an array may be given as: packed, or a plain array of what its items are. */
static int64_t ReadEach(const Variant* array, Type type, Class class, const Struct* of, int width, Self* world,
                        Scratch* scratch, void** rows, char* wrong)
{
    int64_t count = CountRows(array);
    int size = of != NULL ? of->size : width * SIZES[type];
    char* to = *rows = TakeScratch(scratch, count * size);
    int good = to != NULL;
    for (int64_t i = 0; i < count && good; ++i) {
        Variant item = GetItem(array, i);
        good = of != NULL  ? ReadStruct(&item, of, world, scratch, to + i * size, wrong)
               : width > 1 ? ReadNumbers(&item, type, width, to + i * size)
                           : ReadItem(&item, type, class, world, to + i * size);
        DropValue(&item);
    }
    return good ? count : -1;
}

static int64_t ReadArray(const Variant* value, Type type, Class class, const Struct* of, int width, Self* world,
                         Scratch* scratch, void** rows, char* wrong)
{
    Kind kind = KindOf(value);
    if (kind == KIND_ARRAY) {
        return ReadEach(value, type, class, of, width, world, scratch, rows, wrong);
    }
    int size = width * SIZES[type];
    int fits = type == TYPE_BYTE    ? kind == KIND_BYTES
               : type == TYPE_INT32 ? kind == KIND_INTS
               : type == TYPE_FLOAT ? kind == KIND_FLOATS || kind == KIND_VECTORS2 || kind == KIND_VECTORS3
                                    : 0;
    int64_t bytes = fits ? CountRows(value) * SizeOfItem(kind) : -1;
    if (bytes < 0 || bytes % size != 0 || (*rows = TakeScratch(scratch, bytes)) == NULL) {
        return -1;
    }
    CopyRows(value, *rows);
    return bytes / size;
}

int64_t ReadRows(const Variant* value, const Parameter* parameter, Self* world, Scratch* scratch, void** rows,
                 char* wrong)
{
    return ReadArray(value, parameter->type, parameter->class, parameter->of, parameter->width, world, scratch, rows,
                     wrong);
}

Variant WriteRows(Kind kind, Type type, Class class, const Struct* of, int width, Self* world, const void* rows,
                  int64_t count)
{
    if (kind != KIND_ARRAY) {
        return OfRows(kind, rows, rows != NULL ? count * width * SIZES[type] / SizeOfItem(kind) : 0);
    }
    int size = of != NULL ? of->size : SIZES[type];
    Variant made = NewArray(count);
    for (int64_t i = 0; i < count; ++i) {
        const void* row = (const char*)rows + i * size;
        if (of != NULL) {
            Variant item = NewDictionary();
            WriteStruct(&item, of, world, row);
            SetItem(&made, i, item);
        } else {
            SetItem(&made, i, WriteItem(type, class, world, row));
        }
    }
    return made;
}

/* ---- Structs ---- */

typedef struct Reading {
    const Struct* of;
    Self* world;
    Scratch* scratch;
    char* data;
    char* wrong;
} Reading;

static int ReadPointer(const Variant* value, const Field* field, Reading* reading)
{
    void* rows = NULL;
    int64_t count = ReadArray(value, field->type, CLASS_NONE, NULL, field->width, reading->world, reading->scratch,
                              &rows, reading->wrong);
    if (count < 0 || count > INT32_MAX) {
        return 0;
    }
    if (count > 0 || !field->nullable) {
        *(void**)(void*)(reading->data + field->offset) = rows;
        *(int32_t*)(void*)(reading->data + field->lengthOffset) = (int32_t)count;
    }
    return 1;
}

static int ReadField(const Variant* value, const Field* field, Reading* reading)
{
    char* to = reading->data + field->offset;
    if (field->type == TYPE_BYTE) { /* what the library gives only */
        return 1;
    }
    if (field->width > 0) {
        return ReadPointer(value, field, reading);
    }
    if (field->type == TYPE_STRUCT) {
        return ReadStruct(value, field->of, reading->world, reading->scratch, to, reading->wrong);
    }
    return field->count > 1 ? ReadNumbers(value, field->type, field->count, to)
                            : ReadItem(value, field->type, field->class, reading->world, to);
}

static int ReadKey(void* user, const char* key, const Variant* value)
{
    Reading* reading = user;
    strncpy(reading->wrong, key, MOST_TEXT - 1);
    for (int i = 0; i < reading->of->fieldCount; ++i) {
        const Field* field = &reading->of->fields[i];
        if (strcmp(field->name, key) == 0) {
            return ReadField(value, field, reading);
        }
    }
    return 0;
}

int ReadStruct(const Variant* dictionary, const Struct* of, Self* world, Scratch* scratch, void* data, char* wrong)
{
    Reading reading = { of, world, scratch, data, wrong };
    return KindOf(dictionary) == KIND_DICTIONARY && EachKey(dictionary, ReadKey, &reading);
}

static Variant WriteField(const Field* field, Self* world, const char* data)
{
    const char* from = data + field->offset;
    if (field->width > 0) {
        int32_t count = *(const int32_t*)(const void*)(data + field->lengthOffset);
        return WriteRows(field->kind, field->type, CLASS_NONE, NULL, field->width, world,
                         *(const void* const*)(const void*)from, count);
    }
    if (field->type == TYPE_STRUCT) {
        Variant made = NewDictionary();
        WriteStruct(&made, field->of, world, from);
        return made;
    }
    return field->count > 1 ? WriteNumbers(field->kind, field->type, field->count, from)
                            : WriteItem(field->type, field->class, world, from);
}

void WriteStruct(Variant* dictionary, const Struct* of, Self* world, const void* data)
{
    uint32_t mask = of->masks != NULL ? of->masks[*(const int32_t*)data] : UINT32_MAX;
    for (int i = 0; i < of->fieldCount; ++i) {
        if (i >= 32 || (mask >> i & 1) != 0) {
            SetKey(dictionary, of->fields[i].name, WriteField(&of->fields[i], world, data));
        }
    }
}

Variant EmptyOf(Kind kind)
{
    static const float ZEROS[9] = { 0.0f };
    switch (kind) {
    case KIND_BOOL:
        return OfBool(0);
    case KIND_INT:
        return OfInt(0);
    case KIND_REAL:
        return OfReal(0.0);
    case KIND_STRING:
        return OfText("");
    case KIND_VECTOR2:
    case KIND_VECTOR3:
    case KIND_BASIS:
        return OfVector(kind, ZEROS);
    case KIND_DICTIONARY:
        return NewDictionary();
    case KIND_ARRAY:
        return NewArray(0);
    default:
        return kind >= KIND_BYTES && kind <= KIND_COLORS ? OfRows(kind, NULL, 0) : OfNil();
    }
}
