/* A host that records: a Host (host.h) and the bytes that it got. */
#ifndef KIRI_TEST_TAPE_H
#define KIRI_TEST_TAPE_H

#include "host.h"

typedef struct Tape {
    Host host; /* first: it is the user of the hooks */
    uint8_t* bytes;
    int64_t size, room;
    kiriReplay replay;
} Tape;

static inline void Tape_Write(void* user, const void* bytes, int32_t count)
{
    Tape* tape = user;
    assert_true(count > 0);
    if (tape->size + count > tape->room) {
        tape->room = 2 * (tape->size + count);
        tape->bytes = realloc(tape->bytes, (size_t)tape->room);
        assert_non_null(tape->bytes);
    }
    memcpy(tape->bytes + tape->size, bytes, (size_t)count);
    tape->size += count;
}

static inline kiriWorldDef Tape_Def(Tape* tape)
{
    memset(tape, 0, sizeof *tape);
    tape->host.failAt = -1;
    kiriWorldDef def = Host_Def(&tape->host);
    def.record = Tape_Write;
    def.recordHashTicks = 1;
    return def;
}

static inline void Tape_Start(Tape* tape)
{
    kiriWorldDef def = Tape_Def(tape);
    OK(kiriCreateWorld(&def, &tape->host.world));
}

static inline kiriSheet Tape_AddSheet(Tape* tape, float z)
{
    kiriSheetDef def = Host_SmallDef();
    def.position[2] = z;
    return Host_AddRectangle(&tape->host, &def, 1.0f, 1.0f, 4, 4);
}

static inline void Tape_Tick(Tape* tape)
{
    assert_true(Host_Tick(&tape->host, 1.0f / 60.0f, 2) >= 0);
}

/* The end of the recording; its bytes stay. */
static inline void Tape_Stop(Tape* tape)
{
    Host_Stop(&tape->host);
}

static inline void Tape_Free(Tape* tape)
{
    Host_Stop(&tape->host);
    free(tape->bytes);
    tape->bytes = NULL;
}

/* Up to the next tick or note. */
static inline kiriResult Tape_Step(Tape* replaying, const Tape* recorded)
{
    return kiriWorld_Replay(replaying->host.world, recorded->bytes, recorded->size, &replaying->replay);
}

/* To the end, or to what is wrong. */
static inline kiriResult Tape_Play(Tape* replaying, const Tape* recorded)
{
    kiriResult result = KIRI_PENDING;
    while (result == KIRI_PENDING) {
        result = Tape_Step(replaying, recorded);
    }
    return result;
}

/* Replays the recording to its end in a new world, whose recording must be the same. Frees it. */
static inline void Tape_PlayAll(Tape* recorded)
{
    Tape again;
    Tape_Start(&again);
    OK(Tape_Play(&again, recorded));
    Tape_Stop(&again);
    assert_int_equal(again.size, recorded->size);
    assert_memory_equal(again.bytes, recorded->bytes, (size_t)recorded->size);
    Tape_Free(&again);
    Tape_Free(recorded);
}

#endif
