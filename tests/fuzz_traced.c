#include "fuzz_traced.h"

#include "core/kiri_archive.h"

#include <stdlib.h>
#include <string.h>

/* That of fuzz_archive.c. */
void RealNumbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count);

/* ---- A host that knows its blocks ---- */

typedef struct Block {
    char* at;
    int64_t bytes;
} Block;

typedef struct Blocks {
    Block of[TRACED_BLOCKS];
    int32_t count;
} Blocks;

static Blocks blocks;

static void* TakeBlock(void* user, int64_t bytes)
{
    char* at = blocks.count < TRACED_BLOCKS ? calloc(1, (size_t)bytes) : NULL;
    if (at != NULL) {
        blocks.of[blocks.count++] = (Block){ at, bytes };
    }
    return at;
}

static void GiveBlock(void* user, void* pointer)
{
    int32_t k = 0;
    while (k < blocks.count && blocks.of[k].at != pointer) {
        ++k;
    }
    if (k < blocks.count) {
        memmove(&blocks.of[k], &blocks.of[k + 1], sizeof(Block) * (size_t)(--blocks.count - k));
        free(pointer);
    }
}

/* ---- What saves have of which block ---- */

static Traced* tracing;
static Traced* traced[SAVED_WORLDS];

static int32_t FindBlock(const char* at)
{
    int32_t k = 0;
    while (k < blocks.count && (at < blocks.of[k].at || at >= blocks.of[k].at + blocks.of[k].bytes)) {
        ++k;
    }
    return k;
}

void kiriArchive_Numbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count)
{
    if (tracing != NULL && archive->mode == KIRI_ARCHIVE_WRITE && archive->at >= SAVED_HEAD_BYTES && count > 0) {
        if (tracing->count == tracing->capacity) {
            tracing->capacity = 2 * tracing->capacity + 1024;
            tracing->parts = realloc(tracing->parts, sizeof(TracedPart) * (size_t)tracing->capacity);
        }
        tracing->parts[tracing->count++] = (TracedPart){ FindBlock(numbers), width, archive->at, width * count };
    }
    RealNumbers(archive, numbers, width, count);
}

static int CompareParts(const void* a, const void* b)
{
    const TracedPart *x = a, *y = b;
    return x->block != y->block ? (x->block < y->block ? -1 : 1) : x->at < y->at ? -1 : x->at > y->at;
}

const Traced* Traced_Get(int32_t index)
{
    if (traced[index] == NULL) {
        const Saved* saved = Saved_Get(index);
        kiriWorldDef def;
        kiriWorld* world = NULL;
        Traced* t = traced[index] = calloc(1, sizeof(Traced));
        blocks.count = 0;
        kiriDefaultWorldDef(&def);
        def.alloc = TakeBlock;
        def.free = GiveBlock;
        FUZZ_CHECK(kiriCreateWorld(&def, &world) == KIRI_OK, "no world");
        FUZZ_CHECK(kiriWorld_Load(world, saved->later.bytes, saved->later.size) == KIRI_OK, "a good save is refused");
        t->save = Saved_Make(world);
        tracing = t;
        FUZZ_CHECK(kiriWorld_Save(world, t->save.bytes, t->save.size, &t->save.size) == KIRI_OK, "no save");
        tracing = NULL;
        kiriDestroyWorld(world);
        qsort(t->parts, (size_t)t->count, sizeof(TracedPart), CompareParts);
        for (int32_t k = 0; k < t->count; ++k) {
            if (k == 0 || t->parts[k].block != t->parts[k - 1].block) {
                t->first[t->blocks++] = k;
            }
            t->words[t->blocks - 1] += (t->parts[k].bytes + 3) / 4;
        }
    }
    return traced[index];
}

const TracedPart* Traced_Find(const Traced* of, int32_t block, int64_t* word)
{
    const TracedPart* part = &of->parts[of->first[block]];
    while (*word >= (part->bytes + 3) / 4) {
        *word -= (part->bytes + 3) / 4;
        ++part;
    }
    return part;
}
