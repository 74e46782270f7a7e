/* Values and objects of Godot 4, and the classes for it: the library is a GDExtension. */
#include "host4.h"

#include "call.h"

#include <string.h>

/* All of the interface, and what it says of types, which is asked for once. */
#define MEMBER(answer, name, parameters) answer(*name) parameters;
static struct Api {
    HOST4_FUNCTIONS(MEMBER)
    void (*editor_help_load_xml_from_utf8_chars)(const char* text); /* since 4.3, in the editor; may be null */
    void* library;
    void* classNames[CLASS_COUNT];
    ConvertFn *toValue[KIND_COUNT], *fromValue[KIND_COUNT];
    ConstructFn* construct[KIND_COUNT];
    DestructFn *destruct[KIND_COUNT], *destructName;
    BuiltinFn *resize[KIND_COUNT], *size[KIND_COUNT];
    void* (*index[KIND_COUNT])(void* array, int64_t i);
} api;

static const int TYPES[KIND_COUNT] = { GODOT_NIL,      GODOT_BOOL,    GODOT_INT,   GODOT_FLOAT,  GODOT_STRING,
                                       GODOT_VECTOR2,  GODOT_VECTOR3, GODOT_BASIS, GODOT_OBJECT, GODOT_DICTIONARY,
                                       GODOT_ARRAY,    GODOT_BYTES,   GODOT_INTS,  GODOT_FLOATS, GODOT_VECTORS2,
                                       GODOT_VECTORS3, GODOT_COLORS,  GODOT_NIL };

/* What methods of arrays are called by, since 4.1. */
enum { RESIZE = 848867239 };
static const int64_t SIZE = 3173160232;

const int SURFACE_ARRAYS = 13;

/* A string, or its name. */
typedef struct Text {
    void* data;
} Text;

/* Anything but a variant: the largest is a basis. */
typedef union Typed {
    uint64_t aligned;
    Bool is;
    int64_t whole;
    double real;
    void* object;
    float numbers[9];
} Typed;

/* ---- Values ---- */

static Text NameOf(const char* text)
{
    Text name;
    api.string_name_new_with_utf8_chars(&name, text);
    return name;
}

static Variant FromTyped(Kind kind, void* typed)
{
    Variant made;
    api.toValue[kind](&made, typed);
    return made;
}

static Typed ToTyped(Kind kind, const Variant* value)
{
    Typed typed;
    Variant same = *value;
    api.fromValue[kind](&typed, &same);
    return typed;
}

Variant OfNil(void)
{
    Variant made;
    api.variant_new_nil(&made);
    return made;
}

Variant OfBool(int value)
{
    Bool is = value != 0;
    return FromTyped(KIND_BOOL, &is);
}

Variant OfInt(int64_t value)
{
    return FromTyped(KIND_INT, &value);
}

Variant OfReal(double value)
{
    return FromTyped(KIND_REAL, &value);
}

Variant OfText(const char* text)
{
    Text string;
    api.string_new_with_utf8_chars(&string, text);
    Variant made = FromTyped(KIND_STRING, &string);
    api.destruct[KIND_STRING](&string);
    return made;
}

Variant OfVector(Kind kind, const float* numbers)
{
    Typed typed;
    memcpy(typed.numbers, numbers, (size_t)SizeOfItem(kind));
    return FromTyped(kind, &typed);
}

Variant OfRows(Kind kind, const void* rows, int64_t count)
{
    Typed array;
    int64_t unused;
    const void* arguments[] = { &count };
    api.construct[kind](&array, NULL);
    if (count > 0) {
        api.resize[kind](&array, arguments, &unused, 1);
        memcpy(api.index[kind](&array, 0), rows, (size_t)(count * SizeOfItem(kind)));
    }
    Variant made = FromTyped(kind, &array);
    api.destruct[kind](&array);
    return made;
}

static Variant Construct(Kind kind)
{
    Variant made;
    CallError error;
    api.variant_construct(TYPES[kind], &made, NULL, 0, &error);
    return made;
}

Variant NewDictionary(void)
{
    return Construct(KIND_DICTIONARY);
}

Variant NewArray(int64_t count)
{
    Typed array;
    int64_t unused;
    const void* arguments[] = { &count };
    api.construct[KIND_ARRAY](&array, NULL);
    api.resize[KIND_ARRAY](&array, arguments, &unused, 1);
    Variant made = FromTyped(KIND_ARRAY, &array);
    api.destruct[KIND_ARRAY](&array);
    return made;
}

void SetKey(Variant* dictionary, const char* key, Variant value)
{
    Bool valid;
    Variant text = OfText(key);
    api.variant_set_keyed(dictionary, &text, &value, &valid);
    DropValue(&text);
    DropValue(&value);
}

void SetItem(Variant* array, int64_t i, Variant value)
{
    Bool valid, outside;
    api.variant_set_indexed(array, i, &value, &valid, &outside);
    DropValue(&value);
}

void CopyValue(Variant* to, const Variant* from)
{
    api.variant_new_copy(to, from);
}

void DropValue(Variant* value)
{
    api.variant_destroy(value);
}

Kind KindOf(const Variant* value)
{
    int type = api.variant_get_type(value);
    for (int kind = 0; kind < KIND_OTHER; ++kind) {
        if (TYPES[kind] == type) {
            return kind == KIND_OBJECT && ToTyped(KIND_OBJECT, value).object == NULL ? KIND_NIL : (Kind)kind;
        }
    }
    return KIND_OTHER;
}

int64_t ToInt(const Variant* value)
{
    Kind kind = KindOf(value);
    Typed typed = ToTyped(kind, value);
    return kind == KIND_BOOL ? typed.is : kind == KIND_REAL ? (int64_t)typed.real : typed.whole;
}

double ToReal(const Variant* value)
{
    Kind kind = KindOf(value);
    Typed typed = ToTyped(kind, value);
    return kind == KIND_BOOL ? typed.is : kind == KIND_INT ? (double)typed.whole : typed.real;
}

void ToVector(const Variant* value, float* numbers)
{
    Kind kind = KindOf(value);
    Typed typed = ToTyped(kind, value);
    memcpy(numbers, typed.numbers, (size_t)SizeOfItem(kind));
}

int64_t CountRows(const Variant* array)
{
    int64_t count = 0;
    Kind kind = KindOf(array);
    Typed typed = ToTyped(kind, array);
    api.size[kind](&typed, NULL, &count, 0);
    api.destruct[kind](&typed);
    return count;
}

void CopyRows(const Variant* array, void* rows)
{
    int64_t count = 0;
    Kind kind = KindOf(array);
    Typed typed = ToTyped(kind, array);
    api.size[kind](&typed, NULL, &count, 0);
    if (count > 0) {
        memcpy(rows, api.index[kind](&typed, 0), (size_t)(count * SizeOfItem(kind)));
    }
    api.destruct[kind](&typed);
}

Variant GetItem(const Variant* array, int64_t i)
{
    Bool valid, outside;
    Variant item;
    api.variant_get_indexed(array, i, &item, &valid, &outside);
    return item;
}

/* A key that is a string, or a name. */
static int ReadText(const Variant* key, char text[MOST_TEXT])
{
    Text string;
    int type = api.variant_get_type(key);
    if (type != GODOT_STRING && type != GODOT_STRING_NAME) {
        return 0;
    }
    api.construct[KIND_STRING](&string, NULL); /* what takes no memory: some Godots do not free what was there */
    api.variant_stringify(key, &string);
    int64_t count = api.string_to_utf8_chars(&string, text, MOST_TEXT - 1);
    text[count < MOST_TEXT ? count : MOST_TEXT - 1] = 0;
    api.destruct[KIND_STRING](&string);
    return count < MOST_TEXT;
}

static int VisitKey(const Variant* dictionary, const Variant* key, EachKeyFn* each, void* user)
{
    Bool valid;
    Variant value;
    char text[MOST_TEXT];
    if (!ReadText(key, text)) {
        return 0;
    }
    api.variant_get_keyed(dictionary, key, &value, &valid);
    int good = each(user, text, &value);
    DropValue(&value);
    return good;
}

int EachKey(const Variant* dictionary, EachKeyFn* each, void* user)
{
    Bool valid;
    Variant iterator = OfNil();
    int good = 1;
    for (Bool more = api.variant_iter_init(dictionary, &iterator, &valid); more && good;
         more = api.variant_iter_next(dictionary, &iterator, &valid)) {
        Variant key;
        api.variant_iter_get(dictionary, &iterator, &key, &valid);
        good = VisitKey(dictionary, &key, each, user);
        DropValue(&key);
    }
    DropValue(&iterator);
    return good;
}

void PushError(const char* line)
{
    api.print_error(line, "kiri", __FILE__, __LINE__, 1);
}

/* ---- Threads ---- */

/* The pool of Godot's threads, which is there later than the library. */
static void* ThreadPool(void)
{
    Text name = NameOf("WorkerThreadPool");
    void* pool = api.global_get_singleton(&name);
    api.destructName(&name);
    return pool;
}

/* What waits for a task, since 4.1. */
static void* WaitMethod(void)
{
    enum { WAIT = 1286410249 };
    Text class = NameOf("WorkerThreadPool"), name = NameOf("wait_for_group_task_completion");
    void* method = api.classdb_get_method_bind(&class, &name, WAIT);
    api.destructName(&class);
    api.destructName(&name);
    return method;
}

void* BeginTask(EachFn* each, void* user, int32_t count)
{
    Text description;
    api.string_new_with_utf8_chars(&description, "kiri");
    int64_t task = api.worker_thread_pool_add_native_group_task(ThreadPool(), each, user, count, -1, 1, &description);
    api.destruct[KIND_STRING](&description);
    return (void*)(intptr_t)task;
}

void EndTask(void* task)
{
    int64_t id = (intptr_t)task;
    const void* arguments[] = { &id };
    api.object_method_bind_ptrcall(WaitMethod(), ThreadPool(), arguments, NULL);
}

/* ---- Objects ---- */

static const BindingCallbacks NO_CALLBACKS = { NULL, NULL, NULL };

/* With the Self of the class. */
static void* CreateObject(Class class, Self** self)
{
    Text parent = NameOf("RefCounted");
    void* object = api.classdb_construct_object(&parent);
    api.destructName(&parent);
    *self = NewSelf(class, object);
    if (*self != NULL) {
        api.object_set_instance(object, &api.classNames[class], *self);
        api.object_set_instance_binding(object, api.library, *self, &NO_CALLBACKS);
    }
    return object;
}

static void* CreateInstance(void* user)
{
    Self* self;
    return CreateObject((Class)(intptr_t)user, &self);
}

static void FreeInstance(void* user, void* instance)
{
    (void)user;
    FreeSelf(instance);
}

Variant MakeObject(int class, Self** self)
{
    void* object = CreateObject((Class) class, self);
    return FromTyped(KIND_OBJECT, &object);
}

Variant OfObject(const Self* self)
{
    void* object = self->object;
    return FromTyped(KIND_OBJECT, &object);
}

Self* ToSelf(const Variant* value)
{
    void* object = KindOf(value) == KIND_OBJECT ? ToTyped(KIND_OBJECT, value).object : NULL;
    return object != NULL ? api.object_get_instance_binding(object, api.library, NULL) : NULL;
}

/* ---- Calls ---- */

static void CallValues(void* user, void* instance, const void* const* arguments, int64_t count, void* answer,
                       CallError* error)
{
    Variant made = Invoke(user, instance, (const Variant* const*)arguments, (int)count);
    memcpy(answer, &made, sizeof made);
    error->error = 0;
}

static Variant OfArgument(Kind kind, const void* argument)
{
    Variant made;
    if (kind == KIND_NIL) {
        CopyValue(&made, argument);
        return made;
    }
    return FromTyped(kind, (void*)(uintptr_t)argument);
}

/* What is there has a value already. */
static void GiveTyped(Kind kind, Variant* made, void* answer)
{
    if (kind == KIND_NIL) {
        return;
    }
    if (kind == KIND_OBJECT) {
        void* object = KindOf(made) == KIND_OBJECT ? ToTyped(KIND_OBJECT, made).object : NULL;
        if (object != NULL) {
            api.ref_set_object(answer, object);
        }
        return;
    }
    if (api.destruct[kind] != NULL) {
        api.destruct[kind](answer);
    }
    api.fromValue[kind](answer, made);
}

static void CallTyped(void* user, void* instance, const void* const* arguments, void* answer)
{
    const Method* method = user;
    Variant values[MOST_ARGUMENTS];
    const Variant* given[MOST_ARGUMENTS];
    for (int i = 0; i < method->argumentCount; ++i) {
        values[i] = OfArgument(method->arguments[i].kind, arguments[i]);
        given[i] = &values[i];
    }
    Variant made = Invoke(method, instance, given, method->argumentCount);
    GiveTyped(method->answer, &made, answer);
    DropValue(&made);
    for (int i = 0; i < method->argumentCount; ++i) {
        DropValue(&values[i]);
    }
}

/* ---- Registration ---- */

static PropertyInfo DescribeValue(Text* name, Text* empty, Kind kind, Class class)
{
    PropertyInfo info = { TYPES[kind], name,  class != CLASS_NONE ? (void*)&api.classNames[class] : (void*)empty,
                          0,           empty, USAGE_DEFAULT };
    info.usage |= kind == KIND_NIL ? USAGE_NIL_IS_VARIANT : 0u;
    return info;
}

static void RegisterMethod(const Method* method)
{
    Text name = NameOf(method->name), empty = NameOf(""), names[MOST_ARGUMENTS];
    PropertyInfo answer = DescribeValue(&empty, &empty, method->answer, method->answerClass), arguments[MOST_ARGUMENTS];
    int metadata[MOST_ARGUMENTS] = { 0 }, defaults = method->argumentCount - method->requiredCount;
    Variant values[MOST_ARGUMENTS];
    void* pointers[MOST_ARGUMENTS];
    for (int i = 0; i < method->argumentCount; ++i) {
        names[i] = NameOf(method->arguments[i].name);
        arguments[i] = DescribeValue(&names[i], &empty, method->arguments[i].kind, method->arguments[i].class);
    }
    for (int i = 0; i < defaults; ++i) {
        values[i] = EmptyOf(method->arguments[method->requiredCount + i].kind);
        pointers[i] = &values[i];
    }
    MethodInfo info = { &name,
                        (void*)(uintptr_t)method,
                        CallValues,
                        CallTyped,
                        METHOD_NORMAL | (method->class == CLASS_KIRI ? METHOD_STATIC : 0u),
                        method->answer != KIND_NIL,
                        &answer,
                        0,
                        (uint32_t)method->argumentCount,
                        arguments,
                        metadata,
                        (uint32_t)defaults,
                        pointers };
    api.classdb_register_extension_class_method(api.library, &api.classNames[method->class], &info);
    for (int i = 0; i < defaults; ++i) {
        DropValue(&values[i]);
    }
    for (int i = 0; i < method->argumentCount; ++i) {
        api.destructName(&names[i]);
    }
    api.destructName(&name);
    api.destructName(&empty);
}

static void RegisterConstant(const Constant* constant)
{
    Text of = NameOf(constant->of), name = NameOf(constant->name);
    api.classdb_register_extension_class_integer_constant(api.library, &api.classNames[CLASS_KIRI], &of, &name,
                                                          constant->value, (Bool)constant->isFlag);
    api.destructName(&of);
    api.destructName(&name);
}

static void RegisterClasses(void)
{
    Text parent = NameOf("RefCounted");
    for (int class = CLASS_KIRI; class < CLASS_COUNT; ++class) {
        ClassInfo info = { 0 };
        info.isAbstract = class != CLASS_WORLD;
        info.isExposed = 1;
        info.create = CreateInstance;
        info.free = FreeInstance;
        info.user = (void*)(intptr_t) class;
        api.string_name_new_with_utf8_chars(&api.classNames[class], CLASS_NAMES[class]);
        api.classdb_register_extension_class2(api.library, &api.classNames[class], &parent, &info);
    }
    api.destructName(&parent);
    for (int i = 0; i < METHOD_COUNT; ++i) {
        RegisterMethod(&METHODS[i]);
    }
    for (int i = 0; i < CONSTANT_COUNT; ++i) {
        RegisterConstant(&CONSTANTS[i]);
    }
}

/* ---- The library ---- */

extern const char* const DOCUMENTS[];

static void AskOfType(Kind kind)
{
    Text resize = NameOf("resize"), size = NameOf("size");
    api.toValue[kind] = api.get_variant_from_type_constructor(TYPES[kind]);
    api.fromValue[kind] = api.get_variant_to_type_constructor(TYPES[kind]);
    api.destruct[kind] = api.variant_get_ptr_destructor(TYPES[kind]);
    api.construct[kind] = api.variant_get_ptr_constructor(TYPES[kind], 0);
    if (kind >= KIND_ARRAY) {
        api.resize[kind] = api.variant_get_ptr_builtin_method(TYPES[kind], &resize, RESIZE);
        api.size[kind] = api.variant_get_ptr_builtin_method(TYPES[kind], &size, SIZE);
    }
    api.destructName(&resize);
    api.destructName(&size);
}

static void AskOfTypes(void)
{
    api.destructName = api.variant_get_ptr_destructor(GODOT_STRING_NAME);
    for (int kind = KIND_BOOL; kind < KIND_OTHER; ++kind) {
        AskOfType((Kind)kind);
    }
    api.index[KIND_BYTES] = api.packed_byte_array_operator_index;
    api.index[KIND_INTS] = api.packed_int32_array_operator_index;
    api.index[KIND_FLOATS] = api.packed_float32_array_operator_index;
    api.index[KIND_VECTORS2] = api.packed_vector2_array_operator_index;
    api.index[KIND_VECTORS3] = api.packed_vector3_array_operator_index;
    api.index[KIND_COLORS] = api.packed_color_array_operator_index;
}

static void Initialize(void* user, int level)
{
    (void)user;
    if (level == LEVEL_SCENE) {
        AskOfTypes();
        RegisterClasses();
    } else if (level == LEVEL_EDITOR && api.editor_help_load_xml_from_utf8_chars != NULL) {
        for (int i = 0; DOCUMENTS[i] != NULL; ++i) {
            api.editor_help_load_xml_from_utf8_chars(DOCUMENTS[i]);
        }
    }
}

static void Deinitialize(void* user, int level)
{
    (void)user;
    for (int class = CLASS_COUNT - 1; level == LEVEL_SCENE && class >= CLASS_KIRI; --class) {
        api.classdb_unregister_extension_class(api.library, &api.classNames[class]);
        api.destructName(&api.classNames[class]);
    }
}

/* What Godot looks for in the library, as kiri.gdextension says. Where it is older than the classes need, it is told so. */
KIRI_API Bool kiri_godot4_begin(GetProcAddress* get, void* library, Initialization* initialization);

Bool kiri_godot4_begin(GetProcAddress* get, void* library, Initialization* initialization)
{
#define TAKE(answer, name, parameters)                                                                                 \
    api.name = (answer(*) parameters)get(#name);                                                                       \
    found &= api.name != NULL;
    int found = 1;
    HOST4_FUNCTIONS(TAKE)
    api.editor_help_load_xml_from_utf8_chars = (void (*)(const char*))get("editor_help_load_xml_from_utf8_chars");
    api.library = library;
    initialization->minimumLevel = LEVEL_SCENE;
    initialization->initialize = Initialize;
    initialization->deinitialize = Deinitialize;
    return (Bool)found;
}
