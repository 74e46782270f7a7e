/* As much of GDNative of Godot 3 as the classes take: the functions stand in a table, in the order of gdnative_api.json,
   version 1.0 of the core. */
#ifndef HOST3_H
#define HOST3_H

#include "host.h"

/* Bytes, as Godot declares them: so they are passed alike. */
typedef struct Small {
    uint8_t bytes[8];
} Small; /* String, Array, Dictionary, PoolIntArray and so on, Vector2 */
typedef struct Vector3 {
    uint8_t bytes[12];
} Vector3;
typedef struct Basis {
    uint8_t bytes[36];
} Basis;

typedef struct Version {
    unsigned major, minor;
} Version;

/* Extensions; the class is registered by the one of type NATIVE_SCRIPT. */
enum { NATIVE_SCRIPT = 1 };

typedef void* ConstructFn(void);
typedef void* CreateFn(void* object, void* methodData);
typedef void DestroyFn(void* object, void* methodData, void* userData);
typedef Variant MethodFn(void* object, void* methodData, void* userData, int count, Variant** arguments);
typedef struct Create {
    CreateFn* create;
    void* data;
    void (*free)(void*);
} Create;
typedef struct Destroy {
    DestroyFn* destroy;
    void* data;
    void (*free)(void*);
} Destroy;
typedef struct Bound {
    MethodFn* method;
    void* data;
    void (*free)(void*);
} Bound;
typedef struct Attributes {
    int rpcMode;
} Attributes;

/* Version 1.1, the next of 1.0. */
typedef struct Extension2 {
    unsigned type;
    Version version;
    const void* next;
    void (*unused[7])(void);
    void (*setTypeTag)(void* library, const char* name, const void* tag);
    const void* (*getTypeTag)(const void* object);
} Extension2;

typedef struct Extension {
    unsigned type;
    Version version;
    const Extension2* next;
    void (*registerClass)(void* library, const char* name, const char* base, Create create, Destroy destroy);
    void (*registerToolClass)(void* library, const char* name, const char* base, Create create, Destroy destroy);
    void (*registerMethod)(void* library, const char* name, const char* method, Attributes attributes, Bound function);
    void (*unused[2])(void);
    void* (*getUserData)(void* object);
} Extension;

typedef struct Core {
    unsigned type;
    Version version;
    const void* next;
    unsigned extensionCount;
    const Extension** extensions;
    void (*functions[])(void);
} Core;

typedef struct Options {
    uint8_t inEditor;
    uint64_t coreHash, editorHash, noHash;
    void *reportMismatch, *reportError;
    void* library;
    const Core* core;
    const void* path;
} Options;

/* Of arrays: how to make one, and to get at what is in it. */
typedef struct Pool {
    int make, resize, read, write, size, destroy, readAt, readEnd, writeAt, writeEnd, toVariant, ofVariant;
} Pool;

static const Pool POOLS[] = {
    { 155, 164, 165, 166, 169, 170, 268, 270, 296, 298, 530, 557 }, /* KIND_BYTES, and so on */
    { 171, 180, 181, 182, 185, 186, 272, 274, 300, 302, 531, 558 },
    { 187, 196, 197, 198, 201, 202, 276, 278, 304, 306, 532, 559 },
    { 219, 228, 229, 230, 233, 234, 284, 286, 312, 314, 534, 561 },
    { 235, 244, 245, 246, 249, 250, 288, 290, 316, 318, 535, 562 },
    { 251, 260, 261, 262, 265, 266, 292, 294, 320, 322, 536, 563 },
};

enum {
    ARRAY_NEW = 323,
    ARRAY_SET = 332,
    ARRAY_GET = 333,
    ARRAY_RESIZE = 354,
    ARRAY_SIZE = 356,
    ARRAY_DESTROY = 361,
    DICTIONARY_NEW = 362,
    DICTIONARY_DESTROY = 364,
    DICTIONARY_KEYS = 372,
    DICTIONARY_GET = 374,
    DICTIONARY_SET = 375,
    VARIANT_TYPE = 507,
    VARIANT_COPY = 508,
    VARIANT_NIL = 509,
    VARIANT_BOOL = 510,
    VARIANT_INT = 512,
    VARIANT_REAL = 513,
    VARIANT_STRING = 514,
    VARIANT_VECTOR2 = 515,
    VARIANT_VECTOR3 = 517,
    VARIANT_BASIS = 522,
    VARIANT_OBJECT = 527,
    VARIANT_DICTIONARY = 528,
    VARIANT_ARRAY = 529,
    AS_BOOL = 537,
    AS_INT = 539,
    AS_REAL = 540,
    AS_STRING = 541,
    AS_VECTOR2 = 542,
    AS_VECTOR3 = 544,
    AS_BASIS = 549,
    AS_OBJECT = 554,
    AS_DICTIONARY = 555,
    AS_ARRAY = 556,
    VARIANT_DESTROY = 570,
    CHARS_LENGTH = 571,
    CHARS_DATA = 572,
    CHARS_DESTROY = 573,
    STRING_NEW = 574,
    STRING_UTF8 = 678,
    STRING_PARSE = 679,
    STRING_DESTROY = 721,
    METHOD_GET = 732,
    METHOD_CALL = 734,
    CLASS_CONSTRUCTOR = 735,
    PRINT_ERROR = 741
};

#endif
