/* Variables that end with their scope. */
#ifndef KIRI_TEST_SCOPED_H
#define KIRI_TEST_SCOPED_H

#include "kiri/kiri.h"

#include <stdlib.h>
#include <string.h>

/* Declares a variable of zeros; `end` is called with its address at the end of its scope. */
#define SCOPED(Type, name, end) SCOPED_AS(Type, name, end) = { 0 }

/* The same, with a value that follows. */
#define SCOPED_AS(Type, name, end) __attribute__((cleanup(end))) Type name
#define SCOPED_WORLD(name) SCOPED_AS(kiriWorld*, name, Scoped_Destroy)
#define FREED(Type, name) SCOPED_AS(Type*, name, Scoped_Free)

static inline void Scoped_Destroy(kiriWorld** world)
{
    kiriDestroyWorld(*world);
}

/* `pointer` points to the pointer to free. */
static inline void Scoped_Free(void* pointer)
{
    void* block;
    memcpy(&block, pointer, sizeof block);
    free(block);
}

#endif
