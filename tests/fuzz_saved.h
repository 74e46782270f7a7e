/* What fuzzers of saves share: a host that counts what it gives, good saves of worlds to which a storm has happened,
   and what a world that was loaded must be good for. */
#ifndef KIRI_TEST_FUZZ_SAVED_H
#define KIRI_TEST_FUZZ_SAVED_H

#include "fuzz.h"
#include "host.h"
#include "storm.h"

/* Those from SAVED_LARGE on have triangles that are large for the grid. */
enum { SAVED_LARGE = 96, SAVED_WORLDS = 98 };
enum { SAVED_HEAD_BYTES = 24, SAVED_SUM_BYTES = 8 };

/* A host without a log that refuses memory where it would hold too much. */
kiriWorldDef SavedHost_Def(Host* host);

typedef struct Save {
    uint8_t* bytes;
    int64_t size;
} Save;

/* Of a storm: a save, and a later one. */
typedef struct Saved {
    Storm storm;
    Save base, later;
} Saved;

const Saved* Saved_Get(int32_t index);

/* No work is at hand. */
Save Saved_Make(const kiriWorld* world);
Save Saved_Copy(const Save* save);

/* Of the bytes as they are. */
void Saved_MendSum(Save* save);
bool Saved_HasSum(const Save* save);

/* It ticks, is cut, is read and saved: as its budget has it, and then so that the work at hand is done. */
void Saved_GoOn(Storm* storm);

/* Loads bytes that may be anything by kiriWorld_Load into a world, which goes on; or is refused, and then
   nothing has changed. */
void Saved_Try(const Save* save, const Storm* storm);

/* The load is refused, and nothing has changed. */
void Saved_Refuse(kiriResult load(kiriWorld* world, const void* context), const void* context);

#endif
