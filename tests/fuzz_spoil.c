/* As fuzz_load.c, but what is changed are numbers of blocks of memory, each of which counts as much as each other: a
   stage or a cursor is hit as often as a list of thousands. */
#include "fuzz_traced.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_SPOILED = 5 };

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
    const TracedPart* part = Traced_Find(t, block, &word);
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

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    FuzzBytes bytes = { data, size, 0, 0.0f };
    int32_t index = FuzzBytes_Below(&bytes, SAVED_WORLDS);
    const Traced* t = Traced_Get(index);
    Save save = Saved_Copy(&t->save);
    for (int32_t count = 1 + FuzzBytes_Below(&bytes, MOST_SPOILED); count > 0; --count) {
        SpoilWord(&bytes, t, &save);
    }
    Saved_MendSum(&save);
    Saved_Try(&save, &Saved_Get(index)->storm);
    free(save.bytes);
    return 0;
}
