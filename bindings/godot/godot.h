/* As much of GDNative of Godot 3 as the sample takes: the functions stand in a table, in the order of gdnative_api.json,
   version 1.0 of the core. */
#ifndef GODOT_H
#define GODOT_H

#include <stdint.h>

/* Bytes, as Godot declares them: so they are passed alike. */
typedef struct Variant {
    uint8_t bytes[24];
} Variant;
typedef struct Vector2 {
    uint8_t bytes[8];
} Vector2;
typedef struct Vector3 {
    uint8_t bytes[12];
} Vector3;
typedef struct Pool {
    uint8_t bytes[8];
} Pool; /* PoolIntArray, PoolVector2Array, PoolVector3Array */
typedef struct String {
    uint8_t bytes[8];
} String;

typedef struct Version {
    unsigned major, minor;
} Version;

/* Extensions; the class is registered by the one of type NATIVE_SCRIPT. */
enum { NATIVE_SCRIPT = 1 };

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
typedef struct Method {
    MethodFn* method;
    void* data;
    void (*free)(void*);
} Method;
typedef struct Attributes {
    int rpcMode;
} Attributes;

typedef struct Extension {
    unsigned type;
    Version version;
    const void* next;
    void (*registerClass)(void* library, const char* name, const char* base, Create create, Destroy destroy);
    void (*registerToolClass)(void* library, const char* name, const char* base, Create create, Destroy destroy);
    void (*registerMethod)(void* library, const char* name, const char* method, Attributes attributes, Method function);
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
    const String* path;
} Options;

/* Of arrays: how to make one, and to get at what is in it. */
typedef struct PoolKind {
    int make, resize, read, write, size, destroy, readAt, readEnd, writeAt, writeEnd, toVariant;
} PoolKind;

static const PoolKind INTS = { 171, 180, 181, 182, 185, 186, 272, 274, 300, 302, 531 };
static const PoolKind VECTORS2 = { 219, 228, 229, 230, 233, 234, 284, 286, 312, 314, 534 };
static const PoolKind VECTORS3 = { 235, 244, 245, 246, 249, 250, 288, 290, 316, 318, 535 };

enum {
    VARIANT_NIL = 509,
    VARIANT_INT = 512,
    VARIANT_STRING = 514,
    AS_INT = 539,
    AS_REAL = 540,
    AS_VECTOR2 = 542,
    AS_VECTOR3 = 544,
    AS_POOL_VECTOR2 = 561,
    STRING_NEW = 574,
    STRING_PARSE = 679,
    STRING_DESTROY = 721
};

#endif
