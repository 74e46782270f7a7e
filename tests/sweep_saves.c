/* Saves that are wrong in one number: each number of a field in turn, and some of each list, with each of some odd
   values. kiriWorld_Load refuses such bytes, and nothing has changed; or the world that comes of them goes on
   as in fuzz_load.c.

   sweep_saves [FIRST [END [ITEMS [APART]]]]: worlds; how many numbers of a list; and that only each so manyth save is
   tried. A line for each that breaks something. */
#define _DEFAULT_SOURCE
#include "fuzz_traced.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { VALUES = 12, SECONDS = 20, LEAST_KINDS = 5, KINDS = 8 };

/* ---- What is wrong ---- */

static void PutBytes(Save* save, int64_t at, int32_t value)
{
    static const uint8_t odd[] = { 0, 1, 2, 3, 128, 255 };
    if (value < 4) {
        save->bytes[at + value] = save->bytes[at + value] == 0 ? 1 : 0;
    } else if (value < 10) {
        save->bytes[at] = odd[value - 4];
    } else {
        save->bytes[at] = (uint8_t)(save->bytes[at] + (value == 10 ? 1 : 255));
    }
}

static void PutInt(Save* save, int64_t at, int32_t value)
{
    static const int32_t odd[] = { 0, 1, -1, -2, 3, 17, 65536, INT32_MAX, INT32_MIN };
    int32_t was;
    memcpy(&was, save->bytes + at, 4);
    was = value < 9 ? odd[value] : (int32_t)((uint32_t)was + (value == 9 ? 1u : value == 10 ? UINT32_MAX : 7u));
    memcpy(save->bytes + at, &was, 4);
}

/* A double, or an integer. */
static void PutLong(Save* save, int64_t at, int32_t value)
{
    static const double odd[] = { 0.0, -1.0, 1e-300, 1e300, -1e30, 1e10, 0.5 };
    static const int64_t whole[] = { 1, -1, INT64_MAX };
    int64_t was;
    memcpy(&was, save->bytes + at, 8);
    was = value < 10 ? whole[value < 7 ? 0 : value - 7] : (int64_t)((uint64_t)was + (value == 10 ? 1u : UINT64_MAX));
    memcpy(save->bytes + at, value < 7 ? (const void*)&odd[value] : (const void*)&was, 8);
}

static void PutWrong(const Traced* t, int32_t block, int64_t word, int32_t value, Save* save)
{
    const TracedPart* part = Traced_Find(t, block, &word);
    int64_t at = part->at + 4 * word, left = part->at + part->bytes - at;
    if (left < 4 || part->width == 1) {
        PutBytes(save, at, left < 4 && value < 4 ? value % (int32_t)left : value);
    } else if (part->width == 8) {
        PutLong(save, part->at + 4 * word / 8 * 8, value);
    } else {
        PutInt(save, at, value);
    }
}

/* ---- In turn ---- */

/* Parts of many lengths are the fields of a struct; a list has few, again and again. What is in no block are the counts
   of lists. */
static bool HasFields(const Traced* t, int32_t block)
{
    int64_t lengths[KINDS];
    int32_t kinds = 0, end = block + 1 < t->blocks ? t->first[block + 1] : t->count;
    for (int32_t k = t->first[block]; k < end && kinds < LEAST_KINDS; ++k) {
        int32_t i = 0;
        while (i < kinds && lengths[i] != t->parts[k].bytes) {
            ++i;
        }
        if (i == kinds) {
            lengths[kinds++] = t->parts[k].bytes;
        }
    }
    return kinds >= LEAST_KINDS || block + 1 == t->blocks;
}

static int64_t NumbersOf(const Traced* t, int32_t block, int32_t items)
{
    return HasFields(t, block) || t->words[block] < items ? t->words[block] : items;
}

/* Of a list others in each world. */
static int64_t WordOf(const Traced* t, int32_t block, int64_t number, int64_t numbers, int32_t world)
{
    int64_t words = t->words[block], apart = words / numbers;
    return numbers == words ? number : number * apart + (world * 7919 + number * 104729) % apart;
}

typedef struct Progress {
    int32_t block, value;
    int64_t number, seen, tried;
} Progress;

typedef struct Sweep {
    int32_t items, apart;
} Sweep;

static void TryOne(const Traced* t, int32_t world, Progress* at, int64_t word)
{
    struct itimerval timer = { { 0, 0 }, { SECONDS, 0 } };
    Save save = Saved_Copy(&t->save);
    PutWrong(t, at->block, word, at->value, &save);
    if (memcmp(save.bytes, t->save.bytes, (size_t)save.size) != 0) {
        at->tried += 1;
        setitimer(ITIMER_VIRTUAL, &timer, NULL);
        Saved_MendSum(&save);
        Saved_Try(&save, &Saved_Get(world)->storm);
    }
    free(save.bytes);
}

/* From where it stands; it says where that is before each. */
static void GoOn(const Traced* t, int32_t world, Sweep sweep, Progress* at)
{
    for (; at->block < t->blocks; ++at->block, at->number = 0) {
        int64_t numbers = NumbersOf(t, at->block, sweep.items);
        for (; at->number < numbers; ++at->number, at->value = 0) {
            for (; at->value < VALUES; ++at->value, ++at->seen) {
                if (at->seen % sweep.apart == world % sweep.apart) {
                    TryOne(t, world, at, WordOf(t, at->block, at->number, numbers, world));
                }
            }
        }
    }
}

/* In a process of its own, which another follows where it ends early. Returns how many broke something. */
static int32_t SweepWorld(int32_t world, Sweep sweep, Progress* at)
{
    const Traced* t = Traced_Get(world);
    int32_t broken = 0;
    memset(at, 0, sizeof(*at));
    for (;;) {
        int status = 0;
        fflush(NULL);
        pid_t child = fork();
        if (child == 0) {
            GoOn(t, world, sweep, at);
            _exit(0);
        }
        if (child < 0 || waitpid(child, &status, 0) != child) {
            perror("sweep_saves");
            exit(1);
        }
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
            return broken;
        }
        int64_t word = WordOf(t, at->block, at->number, NumbersOf(t, at->block, sweep.items), world);
        const TracedPart* part = Traced_Find(t, at->block, &word);
        printf("world %d: byte %lld of %lld (%d bytes wide), value %d: status %d\n", (int)world,
               (long long)(part->at + 4 * word), (long long)t->save.size, (int)part->width, (int)at->value, status);
        ++broken;
        ++at->value;
        ++at->seen;
    }
}

int main(int count, char** arguments)
{
    int32_t first = count > 1 ? atoi(arguments[1]) : 0, end = count > 2 ? atoi(arguments[2]) : SAVED_WORLDS, broken = 0;
    Sweep sweep = { count > 3 ? atoi(arguments[3]) : 8, count > 4 && atoi(arguments[4]) > 1 ? atoi(arguments[4]) : 1 };
    int64_t tried = 0;
    Progress* at = mmap(NULL, sizeof(*at), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) {
        perror("sweep_saves");
        return 1;
    }
    for (int32_t world = first; world < end && world < SAVED_WORLDS; ++world) {
        broken += SweepWorld(world, sweep, at);
        tried += at->tried;
        printf("world %d: %lld saves, %lld bytes each\n", (int)world, (long long)at->tried,
               (long long)Traced_Get(world)->save.size);
    }
    printf("%s %lld saves, %d broke something.\n", broken == 0 ? "[  PASSED  ]" : "[  FAILED  ]", (long long)tried,
           (int)broken);
    return broken > 0;
}
