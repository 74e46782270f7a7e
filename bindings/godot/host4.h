/* As much of gdextension_interface.h of Godot 4 as the classes take, with void* for what is opaque there. `make godot4`
   compares it with the header that Godot itself writes. */
#ifndef HOST4_H
#define HOST4_H

#include <stdint.h>

typedef uint8_t Bool;

enum { LEVEL_SCENE = 2, LEVEL_EDITOR = 3 };
enum { METHOD_NORMAL = 1, METHOD_STATIC = 32 };
enum { USAGE_DEFAULT = 6, USAGE_NIL_IS_VARIANT = 1 << 17 };

/* Types of variants. */
enum {
    GODOT_NIL = 0,
    GODOT_BOOL = 1,
    GODOT_INT = 2,
    GODOT_FLOAT = 3,
    GODOT_STRING = 4,
    GODOT_VECTOR2 = 5,
    GODOT_VECTOR3 = 9,
    GODOT_BASIS = 17,
    GODOT_STRING_NAME = 21,
    GODOT_OBJECT = 24,
    GODOT_DICTIONARY = 27,
    GODOT_ARRAY = 28,
    GODOT_BYTES = 29,
    GODOT_INTS = 30,
    GODOT_FLOATS = 32,
    GODOT_VECTORS2 = 35,
    GODOT_VECTORS3 = 36,
    GODOT_COLORS = 37,
    GODOT_COUNT = 39
};

typedef struct Initialization {
    int minimumLevel;
    void* user;
    void (*initialize)(void* user, int level);
    void (*deinitialize)(void* user, int level);
} Initialization;

typedef struct CallError {
    int error;
    int32_t argument, expected;
} CallError;

typedef struct BindingCallbacks {
    void* (*create)(void* token, void* instance);
    void (*free)(void* token, void* instance, void* binding);
    Bool (*reference)(void* token, void* binding, Bool reference);
} BindingCallbacks;

typedef struct PropertyInfo {
    int type;
    void *name, *className;
    uint32_t hint;
    void* hintText;
    uint32_t usage;
} PropertyInfo;

/* Version 2 of it: since Godot 4.2. */
typedef struct ClassInfo {
    Bool isVirtual, isAbstract, isExposed;
    void (*unused[11])(void); /* what the classes do not have */
    void* (*create)(void* user);
    void (*free)(void* user, void* instance);
    void (*unusedToo[5])(void);
    void* user;
} ClassInfo;

typedef struct MethodInfo {
    void* name;
    void* user;
    void (*call)(void* user, void* instance, const void* const* arguments, int64_t count, void* answer,
                 CallError* error);
    void (*typedCall)(void* user, void* instance, const void* const* arguments, void* answer);
    uint32_t flags;
    Bool hasAnswer;
    PropertyInfo* answer;
    int answerMetadata;
    uint32_t argumentCount;
    PropertyInfo* arguments;
    int* argumentsMetadata;
    uint32_t defaultCount;
    void** defaults;
} MethodInfo;

typedef void AnyFn(void);
typedef AnyFn* GetProcAddress(const char* name);
typedef void ConvertFn(void* to, void* from);
typedef void DestructFn(void* base);
typedef void ConstructFn(void* base, const void* const* arguments);
typedef void BuiltinFn(void* base, const void* const* arguments, void* answer, int32_t count);
typedef void* IndexFn(void* array, int64_t i);

/* Its functions: answer, name, parameters. */
#define HOST4_FUNCTIONS(X)                                                                                             \
    X(void, variant_new_copy, (void* to, const void* from))                                                            \
    X(void, variant_new_nil, (void* made))                                                                             \
    X(void, variant_destroy, (void* value))                                                                            \
    X(int, variant_get_type, (const void* value))                                                                      \
    X(void, variant_construct, (int type, void* made, const void* const* arguments, int32_t count, CallError* error))  \
    X(void, variant_get_keyed, (const void* value, const void* key, void* got, Bool* valid))                           \
    X(void, variant_set_keyed, (void* value, const void* key, const void* set, Bool* valid))                           \
    X(void, variant_get_indexed, (const void* value, int64_t i, void* got, Bool* valid, Bool* outside))                \
    X(void, variant_set_indexed, (void* value, int64_t i, const void* set, Bool* valid, Bool* outside))                \
    X(Bool, variant_iter_init, (const void* value, void* iterator, Bool* valid))                                       \
    X(Bool, variant_iter_next, (const void* value, void* iterator, Bool* valid))                                       \
    X(void, variant_iter_get, (const void* value, void* iterator, void* got, Bool* valid))                             \
    X(ConvertFn*, get_variant_from_type_constructor, (int type))                                                       \
    X(ConvertFn*, get_variant_to_type_constructor, (int type))                                                         \
    X(ConstructFn*, variant_get_ptr_constructor, (int type, int32_t index))                                            \
    X(DestructFn*, variant_get_ptr_destructor, (int type))                                                             \
    X(BuiltinFn*, variant_get_ptr_builtin_method, (int type, const void* name, int64_t hash))                          \
    X(void, string_new_with_utf8_chars, (void* made, const char* text))                                                \
    X(int64_t, string_to_utf8_chars, (const void* string, char* text, int64_t capacity))                               \
    X(void, string_name_new_with_utf8_chars, (void* made, const char* text))                                           \
    X(void, variant_stringify, (const void* value, void* string))                                                      \
    X(void, print_error, (const char* line, const char* function, const char* file, int32_t at, Bool inEditor))        \
    X(void*, classdb_construct_object, (const void* className))                                                        \
    X(void, object_set_instance, (void* object, const void* className, void* instance))                                \
    X(void, object_set_instance_binding,                                                                               \
      (void* object, void* token, void* binding, const BindingCallbacks* callbacks))                                   \
    X(void*, object_get_instance_binding, (void* object, void* token, const BindingCallbacks* callbacks))              \
    X(void*, global_get_singleton, (const void* name))                                                                 \
    X(void*, classdb_get_method_bind, (const void* className, const void* name, int64_t hash))                         \
    X(void, object_method_bind_ptrcall, (void* method, void* object, const void* const* arguments, void* answer))      \
    X(int64_t, worker_thread_pool_add_native_group_task,                                                               \
      (void* pool, void (*each)(void* user, uint32_t i), void* user, int32_t count, int32_t tasks, Bool isHigh,        \
       const void* description))                                                                                       \
    X(void, ref_set_object, (void* reference, void* object))                                                           \
    X(void, classdb_register_extension_class2,                                                                         \
      (void* library, const void* name, const void* parent, const ClassInfo* info))                                    \
    X(void, classdb_register_extension_class_method, (void* library, const void* className, const MethodInfo* info))   \
    X(void, classdb_register_extension_class_integer_constant,                                                         \
      (void* library, const void* className, const void* enumName, const void* name, int64_t value, Bool isFlag))      \
    X(void, classdb_unregister_extension_class, (void* library, const void* name))                                     \
    X(void*, packed_byte_array_operator_index, (void* array, int64_t i))                                               \
    X(void*, packed_int32_array_operator_index, (void* array, int64_t i))                                              \
    X(void*, packed_float32_array_operator_index, (void* array, int64_t i))                                            \
    X(void*, packed_vector2_array_operator_index, (void* array, int64_t i))                                            \
    X(void*, packed_vector3_array_operator_index, (void* array, int64_t i))                                            \
    X(void*, packed_color_array_operator_index, (void* array, int64_t i))

#endif
