/* Recordings of whatever bytes. The input goes on where a good recording has made a world and a sheet; it is replayed,
   past all differences. What that does is recorded, too, and goes the same way when it is replayed: the same results,
   ids and state hashes. */
#include "fuzz.h"
#include "tape.h"

enum { MOST_HELD = 64 << 20, MOST_STOPS = 60 };

/* Grids and meshes as large as they may be would take all day. */
static void Start(Tape* tape)
{
    kiriWorldDef def = Tape_Def(tape);
    def.log = NULL;
    tape->host.room = MOST_HELD;
    FUZZ_CHECK(kiriCreateWorld(&def, &tape->host.world) == KIRI_OK, "no world");
}

static void Stop(Tape* tape)
{
    kiriDestroyWorld(tape->host.world);
    FUZZ_CHECK(tape->host.live == 0, "%lld blocks leak", (long long)tape->host.live);
}

/* A square of 2 x 2 squares, as the input finds it. */
static void AddSheet(Tape* tape)
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
    FUZZ_CHECK(kiriCreateSheet(tape->host.world, &def, &sheet) == KIRI_OK, "no sheet");
}

/* What the input has made nobody trusts. */
static kiriResult Play(Tape* tape, const uint8_t* bytes, int64_t size, bool goesOn)
{
    kiriReplay replay = { 0 };
    kiriResult result = KIRI_PENDING;
    for (int i = 0; (i < MOST_STOPS || !goesOn) && (result == KIRI_PENDING || (goesOn && result == KIRI_ERROR_REPLAY));
         ++i) {
        int64_t before = replay.offset;
        result = kiriWorld_Replay(tape->host.world, bytes, size, &replay);
        FUZZ_CHECK(replay.offset >= before && replay.offset <= size, "a replay goes from byte %lld to %lld",
                   (long long)before, (long long)replay.offset);
    }
    return result;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    Tape first, made, again;
    Start(&first);
    AddSheet(&first);
    int64_t begun = first.size;
    if (size > 0) {
        Tape_Write(&first, data, (int32_t)size);
    }
    Start(&made);
    Play(&made, first.bytes, begun + (int64_t)size, true);
    Stop(&made);
    Stop(&first);
    Start(&again);
    kiriResult result = made.host.refused > 0 ? KIRI_OK : Play(&again, made.bytes, made.size, false);
    FUZZ_CHECK(result == KIRI_OK, "%s", kiriWorld_GetLastError(again.host.world));
    const char* wrong = Validate_World(again.host.world);
    FUZZ_CHECK(wrong == NULL, "%s", wrong);
    Stop(&again);
    free(first.bytes);
    free(made.bytes);
    free(again.bytes);
    return 0;
}
