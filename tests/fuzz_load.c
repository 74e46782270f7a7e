/* Bytes given to loads. The input changes some bytes of a good save of a world to which a storm
   has happened. As they are, all loads refuse them. Then the sum of the save is made right, as somebody does who means
   harm, and kiriWorld_Load refuses it; or it becomes a world that goes on: it ticks, is cut, is read
   and saved. It may move in any way, but it reads and writes no memory that is not its own, ends each call, and gives
   all memory back. */
#include "fuzz_saved.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_CHANGES = 6 };

/* ---- Bytes that are changed ---- */

static int64_t GetWord(const uint8_t* bytes)
{
    return (int32_t)((uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                     (uint32_t)bytes[3] << 24);
}

static void PutWord(uint8_t* bytes, int64_t word)
{
    for (int k = 0; k < 4; ++k) {
        bytes[k] = (uint8_t)((uint64_t)word >> 8 * k);
    }
}

/* Most numbers are floats: from some place on, where the next index or count seems to be. */
static int64_t FindSmall(const Save* save, int64_t at)
{
    int64_t end = save->size - SAVED_SUM_BYTES - 4;
    while (at < end && (GetWord(save->bytes + at) < -1 || GetWord(save->bytes + at) > 1 << 20)) {
        ++at;
    }
    return at;
}

static void PutOddDouble(uint8_t* bytes, uint32_t choice)
{
    static const double odd[] = { 0.0, -1.0, 1e-300, 1e300, -1e30, 1e10 };
    double value = odd[choice % 6];
    uint64_t bits = choice % 8 == 6 ? UINT64_C(0x7ff8000000000000) : UINT64_C(0xfff0000000000000);
    memcpy(bytes, choice % 8 < 6 ? (const void*)&value : (const void*)&bits, 8);
}

static void Change(FuzzBytes* bytes, Save* save)
{
    static const int32_t odd[] = { 0, 1, -1, -2, INT32_MAX, INT32_MIN, 65536, 1 << 24 };
    uint32_t kind = FuzzBytes_Get(bytes), value = FuzzBytes_Get(bytes);
    int64_t length = save->size - SAVED_HEAD_BYTES - SAVED_SUM_BYTES - 8;
    int64_t at = SAVED_HEAD_BYTES + (int64_t)(FuzzBytes_GetSome(bytes, 4) % (uint64_t)length),
            small = FindSmall(save, at);
    int64_t from = SAVED_HEAD_BYTES + (int64_t)(FuzzBytes_GetSome(bytes, 3) % (uint64_t)length);
    switch (kind % 8) {
    case 0:
        save->bytes[at] ^= (uint8_t)(1 << value % 8);
        break;
    case 1:
        PutOddDouble(save->bytes + at, value);
        break;
    case 2:
        PutWord(save->bytes + small, odd[value % 8]);
        break;
    case 3:
        PutWord(save->bytes + small, GetWord(save->bytes + FindSmall(save, from)));
        break;
    default:
        PutWord(save->bytes + small, GetWord(save->bytes + small) + (int64_t)(value % 16) - 8 + (value % 16 >= 8));
        break;
    }
}

/* ---- Loads ---- */

static kiriResult Load(kiriWorld* world, const void* context)
{
    const Save* changed = context;
    return kiriWorld_Load(world, changed->bytes, changed->size);
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    FuzzBytes bytes = { data, size, 0, 0.0f };
    const Saved* saved = Saved_Get(FuzzBytes_Below(&bytes, SAVED_WORLDS));
    int32_t isBase = FuzzBytes_Below(&bytes, 5) == 4, count = 1 + FuzzBytes_Below(&bytes, MOST_CHANGES);
    Save changed = Saved_Copy(isBase ? &saved->base : &saved->later);
    for (int32_t k = 0; k < count && !FuzzBytes_AtEnd(&bytes); ++k) {
        Change(&bytes, &changed);
    }
    if (!Saved_HasSum(&changed)) {
        Saved_Refuse(Load, &changed);
    }
    Saved_MendSum(&changed);
    Saved_Try(&changed, &saved->storm);
    free(changed.bytes);
    return 0;
}
