/* Calls a function of C with values of a script, as the tables say. */
#ifndef CALL_H
#define CALL_H

#include "objects.h"

/* Memory for one call. */
typedef struct Scratch {
    void** items;
    int count, capacity;
} Scratch;

/* Zeros, or null. */
void* TakeScratch(Scratch* scratch, int64_t bytes);
void FreeScratch(Scratch* scratch);

/* Numbers of a kind from a value that has as many; 0 where it has not. */
int ReadNumbers(const Variant* value, Type type, int count, void* numbers);

/* One number, or the id of an object of that class (null is 0) in the world. 0 where it is none. */
int ReadItem(const Variant* value, Type type, Class class, const Self* world, void* item);

/* The keys of a dictionary go where their fields are, the others stay. A world is what ids are of. Where a key is none, or
   its value does not fit, 0, and `wrong` is what it is called. */
int ReadStruct(const Variant* dictionary, const Struct* of, Self* world, Scratch* scratch, void* data, char* wrong);

/* Rows of numbers, ids or structs: how many, or -1. */
int64_t ReadRows(const Variant* value, const Parameter* parameter, Self* world, Scratch* scratch, void** rows,
                 char* wrong);

Variant WriteItem(Type type, Class class, Self* world, const void* item);
Variant WriteNumbers(Kind kind, Type type, int count, const void* numbers);
Variant WriteRows(Kind kind, Type type, Class class, const Struct* of, int width, Self* world, const void* rows,
                  int64_t count);
/* Sets the keys of all fields. */
void WriteStruct(Variant* dictionary, const Struct* of, Self* world, const void* data);

/* What a script gets that has no other answer. */
Variant EmptyOf(Kind kind);

/* The line of an error, with class and method. */
void Fail(const Method* method, const char* why, const char* what);

/* The result goes to the world; a failure is an error of Godot. Returns 0 for that. */
int Check(const Method* method, Self* world, kiriResult result);

/* Calls a method. The answer is the caller's. An error has been pushed where it failed. */
Variant Invoke(const Method* method, Self* self, const Variant* const* arguments, int count);

#endif
