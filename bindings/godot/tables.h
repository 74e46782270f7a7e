/* The tables of tables.c, which says of kiri.h what it takes to call it: structs, methods, constants. */
#ifndef TABLES_H
#define TABLES_H

#include "host.h"

typedef enum Type {
    TYPE_NONE,
    TYPE_INT32,
    TYPE_UINT32,
    TYPE_INT64,
    TYPE_UINT64,
    TYPE_UINT16,
    TYPE_BYTE,
    TYPE_FLOAT,
    TYPE_DOUBLE,
    TYPE_FLAG, /* int32_t, 0 or 1 */
    TYPE_ID,
    TYPE_STRUCT
} Type;

typedef enum Class {
    CLASS_NONE,
    CLASS_KIRI,
    CLASS_WORLD,
    CLASS_SHEET,
    CLASS_CUT,
    CLASS_FRAME,
    CLASS_PIN,
    CLASS_OBSTACLE,
    CLASS_BLADE,
    CLASS_SEAM,
    CLASS_COUNT
} Class;

typedef struct Struct Struct;

/* A key of the dictionary that a struct is for scripts. */
typedef struct Field {
    const char* name;
    Type type;
    Kind kind;
    int offset;
    int count;               /* of numbers */
    int lengthOffset, width; /* of the rows behind a pointer; width 0: it is none */
    int nullable;            /* where there are no rows, the length stays what it was */
    Class class;             /* of an id */
    const Struct* of;        /* of a struct */
} Field;

struct Struct {
    const char* name;
    int size;
    int fieldCount;
    const Field* fields;
    void (*fill)(void* filled); /* null: with zeros */
    const uint32_t* masks;      /* bits of the fields that it has, by its first one; null: all */
};

typedef enum Form {
    FORM_WORLD,
    FORM_SELF,
    FORM_IN, /* numbers and ids */
    FORM_IN_STRUCT,
    FORM_IN_NUMBERS,
    FORM_IN_ROWS,
    FORM_IN_COUNT, /* of rows that are given */
    FORM_CAPACITY, /* for lists */
    FORM_INOUT_STRUCT,
    FORM_OUT,
    FORM_OUT_STRUCT,
    FORM_OUT_NUMBERS,
    FORM_OUT_ROWS,  /* as many as `rows` says */
    FORM_OUT_LIST,  /* up to the capacity */
    FORM_OUT_VIEW,  /* where a pointer to rows goes */
    FORM_OUT_COUNT, /* of a list or a view */
} Form;

typedef struct Parameter {
    const char* name;
    Form form;
    Type type;
    Kind kind;           /* for scripts */
    int count;           /* of numbers */
    int lengthAt, width; /* of rows */
    int nullable;
    Class class;
    const Struct* of;
    int64_t (*rows)(void* const* values);
} Parameter;

typedef enum Returns { RETURNS_RESULT, RETURNS_NOTHING, RETURNS_INT, RETURNS_TEXT } Returns;

/* A method without a table of parameters; see Invoke. */
typedef struct Method Method;
typedef Variant ByHand(const Method* method, Self* self, const Variant* const* arguments, int count);

typedef struct Argument {
    const char* name;
    Kind kind;
    Class class;
} Argument;

struct Method {
    Class class;
    const char* name;
    const char* function; /* of C; null: there is none */
    Returns returns;
    Kind answer;
    Class answerClass;
    int argumentCount, requiredCount;
    const Argument* arguments;
    int parameterCount;
    const Parameter* parameters;
    int64_t (*call)(void* const* values); /* pointers to the parameters, and to what a text is to be put in */
    ByHand* byHand;
};

typedef struct Constant {
    const char* of; /* the enum */
    const char* name;
    int64_t value;
    int isFlag;
} Constant;

extern const char* const CLASS_NAMES[CLASS_COUNT];
extern const Method METHODS[];
extern const int METHOD_COUNT;
extern const Constant CONSTANTS[];
extern const int CONSTANT_COUNT;

/* Structs that code by hand takes. */
extern const Struct WORLD_DEF, DEBUG_DRAW, SHEET_SETTINGS, HIT;

/* Written by hand, in by_hand.c. */
void FillWorldDef(void* def);
ByHand CreateWorld, DestroyWorld, DebugDraw, CopyVertices, GetLastResult, TakeRecording, GetRevision, GetSurfaceArrays,
    GetSolidArrays, GetVertexBuffer;

#endif
