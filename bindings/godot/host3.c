/* Values and objects of Godot 3, and the classes for it: the library is a NativeScript of GDNative. */
#include "host3.h"

#include "call.h"

#include <string.h>

static struct Godot3 {
    const Core* core;
    const Extension* scripts;
    void* library;
    Variant makers[CLASS_COUNT]; /* scripts of classes that handles are made from */
} godot;

#define CALL(index, result, parameters) ((result(*) parameters)godot.core->functions[index])

const int SURFACE_ARRAYS = 9;

/* Kinds of variants, by their type. */
static const Kind KINDS[] = { KIND_NIL,        KIND_BOOL,     KIND_INT,   KIND_REAL,  KIND_STRING, KIND_VECTOR2,
                              KIND_OTHER,      KIND_VECTOR3,  KIND_OTHER, KIND_OTHER, KIND_OTHER,  KIND_OTHER,
                              KIND_BASIS,      KIND_OTHER,    KIND_OTHER, KIND_OTHER, KIND_OTHER,  KIND_OBJECT,
                              KIND_DICTIONARY, KIND_ARRAY,    KIND_BYTES, KIND_INTS,  KIND_FLOATS, KIND_OTHER,
                              KIND_VECTORS2,   KIND_VECTORS3, KIND_COLORS };

static const Pool* PoolOf(Kind kind)
{
    return &POOLS[kind - KIND_BYTES];
}

/* ---- Values ---- */

Variant OfNil(void)
{
    Variant made;
    CALL(VARIANT_NIL, void, (Variant*))(&made);
    return made;
}

Variant OfBool(int value)
{
    Variant made;
    CALL(VARIANT_BOOL, void, (Variant*, uint8_t))(&made, value != 0);
    return made;
}

Variant OfInt(int64_t value)
{
    Variant made;
    CALL(VARIANT_INT, void, (Variant*, int64_t))(&made, value);
    return made;
}

Variant OfReal(double value)
{
    Variant made;
    CALL(VARIANT_REAL, void, (Variant*, double))(&made, value);
    return made;
}

Variant OfText(const char* text)
{
    Variant made;
    Small string;
    CALL(STRING_NEW, void, (Small*))(&string);
    CALL(STRING_PARSE, uint8_t, (Small*, const char*))(&string, text);
    CALL(VARIANT_STRING, void, (Variant*, const Small*))(&made, &string);
    CALL(STRING_DESTROY, void, (Small*))(&string);
    return made;
}

Variant OfVector(Kind kind, const float* numbers)
{
    Variant made;
    int index = kind == KIND_VECTOR2 ? VARIANT_VECTOR2 : kind == KIND_VECTOR3 ? VARIANT_VECTOR3 : VARIANT_BASIS;
    CALL(index, void, (Variant*, const void*))(&made, numbers);
    return made;
}

Variant OfRows(Kind kind, const void* rows, int64_t count)
{
    const Pool* pool = PoolOf(kind);
    Small array;
    Variant made;
    CALL(pool->make, void, (Small*))(&array);
    if (count > 0) {
        CALL(pool->resize, void, (Small*, int))(&array, (int)count);
        void* access = CALL(pool->write, void*, (Small*))(&array);
        memcpy(CALL(pool->writeAt, void*, (void*))(access), rows, (size_t)(count * SizeOfItem(kind)));
        CALL(pool->writeEnd, void, (void*))(access);
    }
    CALL(pool->toVariant, void, (Variant*, const Small*))(&made, &array);
    CALL(pool->destroy, void, (Small*))(&array);
    return made;
}

Variant NewDictionary(void)
{
    Variant made;
    Small dictionary;
    CALL(DICTIONARY_NEW, void, (Small*))(&dictionary);
    CALL(VARIANT_DICTIONARY, void, (Variant*, const Small*))(&made, &dictionary);
    CALL(DICTIONARY_DESTROY, void, (Small*))(&dictionary);
    return made;
}

Variant NewArray(int64_t count)
{
    Variant made;
    Small array;
    CALL(ARRAY_NEW, void, (Small*))(&array);
    CALL(ARRAY_RESIZE, void, (Small*, int))(&array, (int)count);
    CALL(VARIANT_ARRAY, void, (Variant*, const Small*))(&made, &array);
    CALL(ARRAY_DESTROY, void, (Small*))(&array);
    return made;
}

void SetKey(Variant* dictionary, const char* key, Variant value)
{
    Variant text = OfText(key);
    Small same = CALL(AS_DICTIONARY, Small, (const Variant*))(dictionary);
    CALL(DICTIONARY_SET, void, (Small*, const Variant*, const Variant*))(&same, &text, &value);
    CALL(DICTIONARY_DESTROY, void, (Small*))(&same);
    DropValue(&text);
    DropValue(&value);
}

void SetItem(Variant* array, int64_t i, Variant value)
{
    Small same = CALL(AS_ARRAY, Small, (const Variant*))(array);
    CALL(ARRAY_SET, void, (Small*, int, const Variant*))(&same, (int)i, &value);
    CALL(ARRAY_DESTROY, void, (Small*))(&same);
    DropValue(&value);
}

void CopyValue(Variant* to, const Variant* from)
{
    CALL(VARIANT_COPY, void, (Variant*, const Variant*))(to, from);
}

void DropValue(Variant* value)
{
    CALL(VARIANT_DESTROY, void, (Variant*))(value);
}

static void* ObjectOf(const Variant* value)
{
    return CALL(AS_OBJECT, void*, (const Variant*))(value);
}

Kind KindOf(const Variant* value)
{
    Kind kind = KINDS[CALL(VARIANT_TYPE, int, (const Variant*))(value)];
    return kind == KIND_OBJECT && ObjectOf(value) == NULL ? KIND_NIL : kind;
}

int64_t ToInt(const Variant* value)
{
    return CALL(AS_INT, int64_t, (const Variant*))(value);
}

double ToReal(const Variant* value)
{
    return CALL(AS_REAL, double, (const Variant*))(value);
}

void ToVector(const Variant* value, float* numbers)
{
    Kind kind = KindOf(value);
    if (kind == KIND_VECTOR2) {
        Small vector = CALL(AS_VECTOR2, Small, (const Variant*))(value);
        memcpy(numbers, &vector, sizeof vector);
    } else if (kind == KIND_VECTOR3) {
        Vector3 vector = CALL(AS_VECTOR3, Vector3, (const Variant*))(value);
        memcpy(numbers, &vector, sizeof vector);
    } else {
        Basis basis = CALL(AS_BASIS, Basis, (const Variant*))(value);
        memcpy(numbers, &basis, sizeof basis);
    }
}

int64_t CountRows(const Variant* array)
{
    Kind kind = KindOf(array);
    int isPool = kind >= KIND_BYTES;
    Small same = CALL(isPool ? PoolOf(kind)->ofVariant : AS_ARRAY, Small, (const Variant*))(array);
    int count = CALL(isPool ? PoolOf(kind)->size : ARRAY_SIZE, int, (const Small*))(&same);
    CALL(isPool ? PoolOf(kind)->destroy : ARRAY_DESTROY, void, (Small*))(&same);
    return count;
}

void CopyRows(const Variant* array, void* rows)
{
    Kind kind = KindOf(array);
    const Pool* pool = PoolOf(kind);
    Small same = CALL(pool->ofVariant, Small, (const Variant*))(array);
    int count = CALL(pool->size, int, (const Small*))(&same);
    if (count > 0) {
        void* access = CALL(pool->read, void*, (const Small*))(&same);
        memcpy(rows, CALL(pool->readAt, const void*, (const void*))(access), (size_t)(count * SizeOfItem(kind)));
        CALL(pool->readEnd, void, (void*))(access);
    }
    CALL(pool->destroy, void, (Small*))(&same);
}

Variant GetItem(const Variant* array, int64_t i)
{
    Small same = CALL(AS_ARRAY, Small, (const Variant*))(array);
    Variant item = CALL(ARRAY_GET, Variant, (const Small*, int))(&same, (int)i);
    CALL(ARRAY_DESTROY, void, (Small*))(&same);
    return item;
}

static int ReadText(const Variant* key, char text[MOST_TEXT])
{
    if (KindOf(key) != KIND_STRING) {
        return 0;
    }
    Small string = CALL(AS_STRING, Small, (const Variant*))(key);
    Small chars = CALL(STRING_UTF8, Small, (const Small*))(&string);
    int count = CALL(CHARS_LENGTH, int, (const Small*))(&chars);
    if (count < MOST_TEXT) {
        memcpy(text, CALL(CHARS_DATA, const char*, (const Small*))(&chars), (size_t)count);
        text[count] = 0;
    }
    CALL(CHARS_DESTROY, void, (Small*))(&chars);
    CALL(STRING_DESTROY, void, (Small*))(&string);
    return count < MOST_TEXT;
}

int EachKey(const Variant* dictionary, EachKeyFn* each, void* user)
{
    Small same = CALL(AS_DICTIONARY, Small, (const Variant*))(dictionary);
    Small keys = CALL(DICTIONARY_KEYS, Small, (const Small*))(&same);
    int count = CALL(ARRAY_SIZE, int, (const Small*))(&keys), good = 1;
    for (int i = 0; i < count && good; ++i) {
        char text[MOST_TEXT];
        Variant key = CALL(ARRAY_GET, Variant, (const Small*, int))(&keys, i);
        Variant value = CALL(DICTIONARY_GET, Variant, (const Small*, const Variant*))(&same, &key);
        good = ReadText(&key, text) && each(user, text, &value);
        DropValue(&value);
        DropValue(&key);
    }
    CALL(ARRAY_DESTROY, void, (Small*))(&keys);
    CALL(DICTIONARY_DESTROY, void, (Small*))(&same);
    return good;
}

void PushError(const char* line)
{
    CALL(PRINT_ERROR, void, (const char*, const char*, const char*, int))(line, "kiri", __FILE__, __LINE__);
}

/* Godot 3 has no threads to lend. */
void* BeginTask(EachFn* each, void* user, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        each(user, (uint32_t)i);
    }
    return NULL;
}

void EndTask(void* task)
{
    (void)task;
}

/* ---- Objects ---- */

Variant OfObject(const Self* self)
{
    Variant made;
    CALL(VARIANT_OBJECT, void, (Variant*, const void*))(&made, self->object);
    return made;
}

/* All classes have this tag. */
static const char TAG[] = "Kiri";

Self* ToSelf(const Variant* value)
{
    void* object = KindOf(value) == KIND_OBJECT ? ObjectOf(value) : NULL;
    return object != NULL && godot.scripts->next->getTypeTag(object) == TAG ? godot.scripts->getUserData(object) : NULL;
}

static Variant CallObject(const char* class, const char* method, void* object, const Variant* argument)
{
    int error[3];
    void* bound = CALL(METHOD_GET, void*, (const char*, const char*))(class, method);
    return CALL(METHOD_CALL, Variant, (void*, void*, const Variant**, int, int*))(bound, object, &argument,
                                                                                  argument != NULL, error);
}

static void SetProperty(void* object, const char* method, Variant value)
{
    Variant nothing = CallObject("NativeScript", method, object, &value);
    DropValue(&nothing);
    DropValue(&value);
}

/* The script that a class is for Godot 3. */
static void MakeMaker(int class)
{
    void* script = CALL(CLASS_CONSTRUCTOR, ConstructFn*, (const char*))("NativeScript")();
    Variant library;
    CALL(VARIANT_OBJECT, void, (Variant*, const void*))(&godot.makers[class], script);
    CALL(VARIANT_OBJECT, void, (Variant*, const void*))(&library, godot.library);
    SetProperty(script, "set_class_name", OfText(CLASS_NAMES[class]));
    SetProperty(script, "set_library", library);
}

Variant MakeObject(int class, Self** self)
{
    if (KindOf(&godot.makers[class]) == KIND_NIL) {
        MakeMaker(class);
    }
    Variant made = CallObject("NativeScript", "new", ObjectOf(&godot.makers[class]), NULL);
    *self = ToSelf(&made);
    return made;
}

/* ---- The library ---- */

static void* CreateInstance(void* object, void* class)
{
    return NewSelf((Class)(intptr_t) class, object);
}

static void FreeInstance(void* object, void* class, void* self)
{
    (void)object, (void)class;
    FreeSelf(self);
}

static Variant CallMethod(void* object, void* method, void* self, int count, Variant** arguments)
{
    (void)object;
    return Invoke(method, self, (const Variant* const*)arguments, count);
}

/* What Godot looks for in the library. */
KIRI_API void kiri_gdnative_init(Options* options);
KIRI_API void kiri_gdnative_terminate(void* options);
KIRI_API void kiri_nativescript_init(void* library);

void kiri_gdnative_init(Options* options)
{
    godot.core = options->core;
    godot.library = options->library;
    for (unsigned i = 0; i < godot.core->extensionCount; ++i) {
        if (godot.core->extensions[i]->type == NATIVE_SCRIPT) {
            godot.scripts = godot.core->extensions[i];
        }
    }
    for (int class = 0; class < CLASS_COUNT; ++class) {
        godot.makers[class] = OfNil();
    }
}

void kiri_gdnative_terminate(void* options)
{
    (void)options;
    for (int class = 0; class < CLASS_COUNT; ++class) {
        DropValue(&godot.makers[class]);
    }
}

void kiri_nativescript_init(void* library)
{
    const Extension* scripts = godot.scripts;
    for (int class = CLASS_KIRI; class < CLASS_COUNT; ++class) {
        void* data = (void*)(intptr_t) class;
        scripts->registerClass(library, CLASS_NAMES[class], "Reference", (Create){ CreateInstance, data, NULL },
                               (Destroy){ FreeInstance, data, NULL });
        scripts->next->setTypeTag(library, CLASS_NAMES[class], TAG);
    }
    for (int i = 0; i < METHOD_COUNT; ++i) {
        scripts->registerMethod(library, CLASS_NAMES[METHODS[i].class], METHODS[i].name, (Attributes){ 0 },
                                (Bound){ CallMethod, (void*)(uintptr_t)&METHODS[i], NULL });
    }
}
