/* What Godot does for the classes: values of scripts, objects, messages. host3.c does it for Godot 3, host4.c for Godot 4. */
#ifndef HOST_H
#define HOST_H

#include <stdint.h>

/* A value of a script: as large in both, where Godot is built with single precision. */
typedef struct Variant {
    uint64_t bytes[3];
} Variant;

typedef enum Kind {
    KIND_NIL, /* as a parameter: a value of any kind */
    KIND_BOOL,
    KIND_INT,
    KIND_REAL,
    KIND_STRING,
    KIND_VECTOR2,
    KIND_VECTOR3,
    KIND_BASIS,
    KIND_OBJECT,
    KIND_DICTIONARY,
    KIND_ARRAY,
    KIND_BYTES, /* from here on packed arrays, as Godot 4 calls them, or pools */
    KIND_INTS,
    KIND_FLOATS,
    KIND_VECTORS2,
    KIND_VECTORS3,
    KIND_COLORS,
    KIND_OTHER,
    KIND_COUNT
} Kind;

/* ROOM: bytes for a struct that a call takes or gives. SIZE_OF does not compile for a larger one. */
enum { MOST_TEXT = 256, MOST_ARGUMENTS = 8, ROOM = 320 };
#define SIZE_OF(Type) ((int)(sizeof(Type) * sizeof(char[sizeof(Type) <= ROOM ? 1 : -1])))

/* An object of one of the classes; see objects.h. */
typedef struct Self Self;

/* Bytes of a number of a kind, or of an item of an array. */
int SizeOfItem(Kind kind);

/* What is made is the caller's, who drops it, or gives it away to SetKey or SetItem. */
Variant OfNil(void);
Variant OfBool(int value);
Variant OfInt(int64_t value);
Variant OfReal(double value);
Variant OfText(const char* text);
Variant OfVector(Kind kind, const float* numbers); /* KIND_VECTOR2, KIND_VECTOR3, KIND_BASIS: rows */
Variant OfRows(Kind kind, const void* rows, int64_t count);
Variant NewDictionary(void);
Variant NewArray(int64_t count);
void SetKey(Variant* dictionary, const char* key, Variant value);
void SetItem(Variant* array, int64_t i, Variant value);
void CopyValue(Variant* to, const Variant* from);
void DropValue(Variant* value);

Kind KindOf(const Variant* value);   /* KIND_NIL of an object that is null, too */
int64_t ToInt(const Variant* value); /* KIND_BOOL, KIND_INT, KIND_REAL */
double ToReal(const Variant* value); /* the same */
void ToVector(const Variant* value, float* numbers);
int64_t CountRows(const Variant* array); /* of KIND_ARRAY too */
void CopyRows(const Variant* array, void* rows);
Variant GetItem(const Variant* array, int64_t i);

/* Calls for each key that is a text. Returns 0 where one is not, or a call did; that ends it. */
typedef int EachKeyFn(void* user, const char* key, const Variant* value);
int EachKey(const Variant* dictionary, EachKeyFn* each, void* user);

/* A new object of a class; *self is what NewSelf made for it. Nil where there is no memory. */
Variant MakeObject(int class, Self** self);
/* The same object once more. */
Variant OfObject(const Self* self);
/* Null where it is none of these classes. */
Self* ToSelf(const Variant* value);

/* Items of the array that a surface of a mesh is made from; the last one has the indices. */
extern const int SURFACE_ARRAYS;

void PushError(const char* line);

/* Calls for each of 0 to count - 1, from threads of the engine; EndTask waits for what it gave. Null: all is done. */
typedef void EachFn(void* user, uint32_t i);
void* BeginTask(EachFn* each, void* user, int32_t count);
void EndTask(void* task);

#endif
