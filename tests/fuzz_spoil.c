/* As fuzz_load.c, but what is changed are numbers of blocks of memory, each of which counts as much as each other: a
   stage or a cursor is hit as often as a list of thousands. */
#include "fuzz_saved.h"

#include "core/kiri_archive.h"

#include <stdlib.h>
#include <string.h>

void RealNumbers(kiriArchive* archive, void* numbers, int32_t width, int64_t count);

enum { MOST_BLOCKS = 4096, MOST_SPOILED = 5 };

/* ---- A host that knows its blocks ---- */

typedef struct Block {
    char* at;
    int64_t bytes;
} Block;

typedef struct Blocks {
    Block of[MOST_BLOCKS];
    int32_t count;
} Blocks;

static Blocks blocks;

static void* TakeBlock(void* user, int64_t bytes)
{
    (void)user;
    char* at = blocks.count < MOST_BLOCKS ? calloc(1, (size_t)bytes) : NULL;
    if (at != NULL) {
        blocks.of[blocks.count++] = (Block){ at, bytes };
    }
    return at;
}

static void GiveBlock(void* user, void* pointer)
{
    (void)user;
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

typedef struct Part {
    int32_t block, width;
    int64_t at, bytes;
} Part;

typedef struct Traced {
    Save save;
    Part* parts;
    int32_t count, capacity, blocks;
    int32_t first[MOST_BLOCKS + 2];
    int64_t words[MOST_BLOCKS + 2];
} Traced;

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
            tracing->parts = realloc(tracing->parts, sizeof(Part) * (size_t)tracing->capacity);
        }
        tracing->parts[tracing->count++] = (Part){ FindBlock(numbers), width, archive->at, width * count };
    }
    RealNumbers(archive, numbers, width, count);
}

static int CompareParts(const void* a, const void* b)
{
    const Part *x = a, *y = b;
    return x->block != y->block ? (x->block < y->block ? -1 : 1) : x->at < y->at ? -1 : x->at > y->at;
}

static const Traced* Trace(int32_t index)
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
        t->save = Saved_Make(world, NULL);
        tracing = t;
        FUZZ_CHECK(kiriWorld_Save(world, t->save.bytes, t->save.size, &t->save.size) == KIRI_OK, "no save");
        tracing = NULL;
        kiriDestroyWorld(world);
        qsort(t->parts, (size_t)t->count, sizeof(Part), CompareParts);
        for (int32_t k = 0; k < t->count; ++k) {
            if (k == 0 || t->parts[k].block != t->parts[k - 1].block) {
                t->first[t->blocks++] = k;
            }
            t->words[t->blocks - 1] += (t->parts[k].bytes + 3) / 4;
        }
    }
    return traced[index];
}

/* ---- What is changed ---- */

static int32_t Spoil(int32_t was, uint32_t kind, uint32_t value)
{
    static const int32_t odd[] = { 0, 1, -1, -2, INT32_MAX, INT32_MIN, 65536, 1 << 24 };
    switch (kind % 4) {
    case 0:
        return (int32_t)((uint32_t)was ^ 1u << value % 32);
    case 1:
        return odd[value % 8];
    case 2:
        return (int32_t)((uint32_t)was + (1u << value % 8));
    default:
        return (int32_t)((uint32_t)was + value % 16 - 8 + (value % 16 >= 8));
    }
}

static void SpoilWord(FuzzBytes* bytes, const Traced* t, Save* save)
{
    static const double odd[] = { 0.0, -1.0, 1e-300, 1e300, -1e30, 1e10, 1e-3, -0.5 };
    int32_t block = (int32_t)(FuzzBytes_GetSome(bytes, 2) % (uint32_t)t->blocks);
    uint32_t kind = FuzzBytes_Get(bytes), value = FuzzBytes_Get(bytes);
    int64_t word = (int64_t)(FuzzBytes_GetSome(bytes, 3) % (uint64_t)t->words[block]);
    const Part* part = &t->parts[t->first[block]];
    while (word >= (part->bytes + 3) / 4) {
        word -= (part->bytes + 3) / 4;
        ++part;
    }
    int64_t at = part->at + 4 * word, left = part->at + part->bytes - at;
    if (left < 4 || (part->width == 1 && kind % 2 == 0)) {
        at += value / 16 % (left < 4 ? left : 4);
        save->bytes[at] = kind / 2 % 3 == 0 ? (uint8_t)value : save->bytes[at] ^ 1;
    } else if (part->width == 8 && kind % 4 > 0) {
        memcpy(save->bytes + part->at + 4 * word / 8 * 8, &odd[value % 8], 8);
    } else {
        int32_t was;
        memcpy(&was, save->bytes + at, 4);
        was = Spoil(was, kind / 4, value);
        memcpy(save->bytes + at, &was, 4);
    }
}

static kiriResult LoadSave(kiriWorld* world, const void* context)
{
    const Save* save = context;
    return kiriWorld_LoadUntrusted(world, save->bytes, save->size);
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    FuzzBytes bytes = { data, size, 0, 0.0f };
    int32_t index = FuzzBytes_Below(&bytes, SAVED_WORLDS);
    const Traced* t = Trace(index);
    Save save = Saved_Copy(&t->save);
    for (int32_t count = 1 + FuzzBytes_Below(&bytes, MOST_SPOILED); count > 0; --count) {
        SpoilWord(&bytes, t, &save);
    }
    Saved_MendSum(&save);
    Saved_Try(LoadSave, &save, &Saved_Get(index)->storm);
    free(save.bytes);
    return 0;
}
