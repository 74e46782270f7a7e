/* See storm.h. Prints for each world, at some ticks, its state hash and one of what is seen. Now and then it goes on in
   another world, which was loaded from what this one saved. */
#include "storm.h"

#include <stdio.h>
#include <stdlib.h>

enum { TICKS = 24, PRINTED = 8, MOVED = 7 };

/* In halves: not every C library prints 64 bits alike. */
static void PrintHash(uint64_t hash)
{
    printf(" %08lx%08lx", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffff));
}

static void Print(Storm* storm, int32_t tick)
{
    uint64_t hash = 0;
    kiriWorld_GetStateHash(storm->world, &hash);
    printf("%-8s %2d", storm->type->name, (int)tick);
    PrintHash(hash);
    PrintHash(Storm_HashSeen(storm));
    printf("\n");
}

static kiriResult MoveOn(Storm* storm, const kiriWorldDef* def)
{
    int64_t size = 0;
    kiriWorld* next = NULL;
    bool isSaved = kiriWorld_Save(storm->world, NULL, 0, &size) == KIRI_OK && storm->type->budget.cells == 0 &&
                   storm->type->budget.samples == 0 && storm->type->budget.triangles == 0;
    kiriResult result = isSaved ? KIRI_OK : kiriWorld_Snapshot(storm->world, NULL, 0, &size);
    void* bytes = result == KIRI_OK ? malloc((size_t)size) : NULL;
    result = bytes == NULL ? KIRI_ERROR_MEMORY
             : isSaved     ? kiriWorld_Save(storm->world, bytes, size, &size)
                           : kiriWorld_Snapshot(storm->world, bytes, size, &size);
    result = result == KIRI_OK ? kiriCreateWorld(def, &next) : result;
    result = result != KIRI_OK ? result : (isSaved ? kiriWorld_Load : kiriWorld_Restore)(next, bytes, size);
    free(bytes);
    if (result == KIRI_OK) {
        kiriDestroyWorld(storm->world);
        storm->world = next;
    }
    return result;
}

static bool Run(int32_t kind)
{
    Storm storm;
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    const StormType* type = &Storm_Types[kind];
    kiriResult result = Storm_Start(&storm, kind, &def);
    if (result != KIRI_OK) {
        printf("%-8s %s\n", type->name, kiriGetResultName(result));
        return false;
    }
    for (int32_t tick = 1; tick <= TICKS; tick++) {
        Storm_Tick(&storm);
        result = tick % MOVED == 0 ? MoveOn(&storm, &def) : KIRI_OK;
        if (result != KIRI_OK) {
            printf("%-8s %2d %s\n", type->name, (int)tick, kiriGetResultName(result));
            return false;
        }
        if (tick % PRINTED == 0) {
            Print(&storm, tick);
        }
    }
    kiriDestroyWorld(storm.world);
    return true;
}

int main(void)
{
    bool fine = true;
    for (int32_t kind = 0; kind < STORM_TYPES; kind++) {
        fine = Run(kind) && fine;
    }
    return fine ? 0 : 1;
}
