/* Objects of the classes: a world, or an id with its world. */
#ifndef OBJECTS_H
#define OBJECTS_H

#include "tables.h"

#include "kiri/kiri.h"

/* The def of a world as scripts have it. */
typedef struct HostDef {
    kiriWorldDef def;
    int32_t record, clock;
} HostDef;

/* What a tick lends to threads: one at a time. */
typedef struct Task {
    kiriTaskFn* call;
    void* context;
    int32_t itemCount, range;
} Task;

/* Bytes that a recording has given, and no script has taken yet. */
typedef struct Bytes {
    uint8_t* items;
    int64_t count, capacity;
} Bytes;

/* The objects that scripts hold, by id, so that one id is one object. */
typedef struct Handles {
    Self** slots; /* by hash; null: free */
    int count, capacity;
} Handles;

struct Self {
    Class class;
    void* object; /* Godot's */
    /* Of a world. */
    kiriWorld* world;
    Handles handles;
    Bytes recording;
    int recordingFailed; /* no memory for some of it */
    int32_t workerCount;
    Task task;
    kiriResult last;     /* result */
    char line[MOST_TEXT];
    /* Of the others: the world's object, which they keep. */
    Self* owner;
    Variant kept;
    uint32_t id;
};

/* For an object that Godot makes. Null: no memory. A world is made with its defaults. */
Self* NewSelf(Class class, void* object);
void FreeSelf(Self* self);

/* A world in place of what it has; KIRI_OK or why not. */
kiriResult BeginWorld(Self* self, const HostDef* def);

/* The object of an id: nil where that is 0. */
Variant HandleOf(Self* world, Class class, uint32_t id);

/* The object that is a world: itself, or that of an id. */
Self* WorldOf(Self* self);

#endif
