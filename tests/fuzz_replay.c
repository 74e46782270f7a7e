/* Recordings of whatever bytes. The input goes on where a good recording has made a world and a sheet; it is replayed,
   past all differences. What that does is recorded, too, and goes the same way when it is replayed: the same results,
   ids and state hashes. */
#include "defaults.h"
#include "fuzz.h"
#include "validate.h"

#include "kiri/kiri.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_HELD = 64 << 20, MOST_STOPS = 60 };

typedef struct FuzzTape {
    kiriWorld* world;
    int64_t held; /* memory */
    bool wasRefused;
    uint8_t* bytes;
    int64_t size, room;
} FuzzTape;

/* Grids and meshes as large as they may be would take all day. */
static void* Allocate(void* user, int64_t bytes)
{
    FuzzTape* tape = user;
    int64_t* block = tape->held + bytes <= MOST_HELD ? malloc((size_t)bytes + 16) : NULL;
    if (block == NULL) {
        tape->wasRefused = true;
        return NULL;
    }
    tape->held += bytes;
    *block = bytes;
    return block + 2;
}

static void Free(void* user, void* pointer)
{
    if (pointer != NULL) {
        int64_t* block = (int64_t*)pointer - 2;
        ((FuzzTape*)user)->held -= *block;
        free(block);
    }
}

static void Write(void* user, const void* bytes, int32_t count)
{
    FuzzTape* tape = user;
    if (tape->size + count > tape->room) {
        tape->room = 2 * (tape->size + count);
        tape->bytes = realloc(tape->bytes, (size_t)tape->room);
        FUZZ_CHECK(tape->bytes != NULL, "no memory for a tape");
    }
    memcpy(tape->bytes + tape->size, bytes, (size_t)count);
    tape->size += count;
}

static void Start(FuzzTape* tape)
{
    memset(tape, 0, sizeof(*tape));
    kiriWorldDef def = DefaultWorld();
    def.alloc = Allocate;
    def.free = Free;
    def.record = Write;
    def.recordHashTicks = 1;
    def.user = tape;
    FUZZ_CHECK(kiriCreateWorld(&def, &tape->world) == KIRI_OK, "no world");
}

static void Stop(FuzzTape* tape)
{
    kiriDestroyWorld(tape->world);
    FUZZ_CHECK(tape->held == 0, "%lld bytes leak", (long long)tape->held);
}

/* A square of 2 x 2 squares, as the input finds it. */
static void AddSheet(FuzzTape* tape)
{
    float positions[18];
    int32_t indices[24];
    kiriSheet sheet;
    kiriSheetDef def = DefaultSheet();
    kiriFillRectangle(1.0f, 1.0f, 2, 2, positions, indices);
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = 9;
    def.triangleCount = 8;
    def.gridResolution = 8;
    FUZZ_CHECK(kiriCreateSheet(tape->world, &def, &sheet) == KIRI_OK, "no sheet");
}

/* What the input has made nobody trusts. */
static kiriResult Play(FuzzTape* tape, const uint8_t* bytes, int64_t size, bool goesOn)
{
    kiriReplay replay = { 0 };
    kiriResult result = KIRI_PENDING;
    for (int i = 0; (i < MOST_STOPS || !goesOn) && (result == KIRI_PENDING || (goesOn && result == KIRI_ERROR_REPLAY));
         ++i) {
        int64_t before = replay.offset;
        result = kiriWorld_Replay(tape->world, bytes, size, &replay);
        FUZZ_CHECK(replay.offset >= before && replay.offset <= size, "a replay goes from byte %lld to %lld",
                   (long long)before, (long long)replay.offset);
    }
    return result;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    FuzzTape first, made, again;
    Start(&first);
    AddSheet(&first);
    int64_t begun = first.size;
    Write(&first, data, (int32_t)size);
    Start(&made);
    Play(&made, first.bytes, begun + (int64_t)size, true);
    Stop(&made);
    Stop(&first);
    Start(&again);
    kiriResult result = made.wasRefused ? KIRI_OK : Play(&again, made.bytes, made.size, false);
    FUZZ_CHECK(result == KIRI_OK, "%s", kiriWorld_GetLastError(again.world));
    const char* wrong = Validate_World(again.world);
    FUZZ_CHECK(wrong == NULL, "%s", wrong);
    Stop(&again);
    free(first.bytes);
    free(made.bytes);
    free(again.bytes);
    return 0;
}
