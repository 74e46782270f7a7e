/* Replays of recordings that differ, are damaged, end too early, or meet a lack of memory. */
#include "defaults.h"
#include "tape.h"

/* ---- Small recordings -------------------------------------------------------------------------------------------- */

/* A sheet falls on a floor while it is cut. */
static void RecordSmall(Tape* tape)
{
    static const float way[8] = { 0.3f, -0.1f, 0.5f, 0.5f, 0.4f, 0.8f, 0.2f, 1.1f };
    Tape_Start(tape);
    kiriObstacleDef floor = DefaultObstacle();
    floor.position[2] = -0.01f;
    World_AddObstacle(tape->host.world, &floor);
    kiriSheet sheet = Tape_AddSheet(tape, 0.0f);
    Tape_Tick(tape);
    Host_Cut(&tape->host, sheet, way, 4);
    Tape_Tick(tape);
    OK(kiriWorld_Note(tape->host.world, "hello", 5));
    Tape_Tick(tape);
    Tape_Stop(tape);
}

TEST(Notes)
{
    SCOPED(Tape, tape, Tape_Free);
    SCOPED(Tape, again, Tape_Free);
    RecordSmall(&tape);
    Tape_Start(&again);
    for (int tick = 1; tick <= 2; tick++) {
        assert_int_equal(Tape_Step(&again, &tape), KIRI_PENDING);
        assert_null(again.replay.note);
    }
    assert_int_equal(Tape_Step(&again, &tape), KIRI_PENDING);
    assert_int_equal(again.replay.ticks, 2);
    assert_int_equal(again.replay.noteCount, 5);
    assert_memory_equal(again.replay.note, "hello", 5);
    assert_int_equal(Tape_Step(&again, &tape), KIRI_PENDING);
    assert_null(again.replay.note);
    OK(Tape_Step(&again, &tape));
    OK(Tape_Step(&again, &tape)); /* the end stays the end */
    kiriSheet sheets[2];
    int32_t count;
    OK(kiriWorld_GetSheets(again.host.world, sheets, 2, &count));
    assert_int_equal(count, 1);
    assert_int_equal(Host_Counts(&again.host, sheets[0]).pieces, 2);
}

TEST(Misuse)
{
    SCOPED(Tape, tape, Tape_Free);
    SCOPED(Tape, again, Tape_Free);
    kiriReplay replay = { 0 };
    kiriWorldDef def = Tape_Def(&again);
    def.recordHashTicks = -1;
    assert_int_equal(kiriCreateWorld(&def, &again.host.world), KIRI_ERROR_ARGUMENT);
    RecordSmall(&tape);
    Tape_Start(&again);
    kiriWorld* world = again.host.world;
    assert_int_equal(kiriWorld_Replay(world, tape.bytes, -1, &replay), KIRI_ERROR_ARGUMENT);
    replay.offset = tape.size + 1;
    assert_int_equal(kiriWorld_Replay(world, tape.bytes, tape.size, &replay), KIRI_ERROR_ARGUMENT);
    replay.offset = -1;
    assert_int_equal(kiriWorld_Replay(world, tape.bytes, tape.size, &replay), KIRI_ERROR_ARGUMENT);
    replay.offset = 0;
    assert_int_equal(kiriWorld_Replay(world, "", 0, &replay), KIRI_ERROR_DATA);
    assert_int_equal(kiriWorld_Replay(world, "something else than a recording", 31, &replay), KIRI_ERROR_DATA);
    assert_int_equal(replay.offset, 0);
    Tape_AddSheet(&again, 0.0f);
    assert_int_equal(kiriWorld_Replay(world, tape.bytes, tape.size, &replay), KIRI_ERROR_STATE);
}

/* ---- Differences ------------------------------------------------------------------------------------------------- */

enum { VERSION_BYTE = 8, GRAVITY_BYTE = 12 }; /* after "KiriRec" and a line end */

/* Replays with one byte changed; the line. */
static kiriResult PlayChanged(const Tape* tape, int64_t byte, uint8_t flips, Tape* again)
{
    Tape_Start(again);
    tape->bytes[byte] ^= flips;
    return Tape_Play(again, tape);
}

TEST(AnotherGravity)
{
    SCOPED(Tape, tape, Tape_Free);
    SCOPED(Tape, again, Tape_Free);
    RecordSmall(&tape);
    assert_int_equal(PlayChanged(&tape, GRAVITY_BYTE + 10, 1, &again), KIRI_ERROR_REPLAY);
    assert_int_equal(again.replay.ticks, 1);
    assert_non_null(strstr(again.host.line, "kiriWorld_Tick in tick 1, leads to another state"));
    assert_int_equal(Tape_Step(&again, &tape), KIRI_ERROR_REPLAY); /* goes on, and still differs */
    assert_int_equal(again.replay.ticks, 2);
}

TEST(OtherVersions)
{
    SCOPED(Tape, tape, Tape_Free);
    SCOPED(Tape, again, Tape_Free);
    RecordSmall(&tape);
    assert_int_equal(PlayChanged(&tape, VERSION_BYTE, 3, &again), KIRI_ERROR_DATA);
    assert_non_null(strstr(again.host.line, "another version"));
}

TEST(AnotherResult)
{
    SCOPED(Tape, tape, Tape_Free);
    SCOPED(Tape, again, Tape_Free);
    Tape_Start(&tape);
    kiriSheet sheet = Tape_AddSheet(&tape, 0.0f);
    OK(kiriSheet_Wake(tape.host.world, sheet));
    int64_t resultByte = tape.size - 1;
    Tape_Tick(&tape);
    Tape_Stop(&tape);
    assert_int_equal(PlayChanged(&tape, resultByte, 4, &again), KIRI_ERROR_REPLAY);
    assert_non_null(strstr(again.host.line, "call 3, kiriSheet_Wake in tick 0, gives another result than recorded"));
    assert_int_equal(Tape_Step(&again, &tape), KIRI_PENDING);
    OK(Tape_Step(&again, &tape));
    Tape_Free(&again);
    tape.bytes[resultByte] ^= 4;
    /* The id of the sheet, before the call that wakes it: its number, its argument, its result. */
    assert_int_equal(PlayChanged(&tape, resultByte - 3, 64, &again), KIRI_ERROR_REPLAY);
    assert_non_null(strstr(again.host.line, "kiriCreateSheet in tick 0, makes other ids than recorded"));
}

/* ---- Damage ------------------------------------------------------------------------------------------------------ */

/* The end of one call is a good end; within a call it is none. */
TEST(CutShort)
{
    SCOPED(Tape, tape, Tape_Free);
    int32_t whole = 0, within = 0;
    RecordSmall(&tape);
    int64_t size = tape.size;
    for (tape.size = 1; tape.size < size; tape.size += tape.size < size - 150 ? 7 : 1) {
        SCOPED(Tape, again, Tape_Free);
        Tape_Start(&again);
        kiriResult result = Tape_Play(&again, &tape);
        whole += result == KIRI_OK;
        within += strstr(again.host.line, "is the last one: the recording ends within it") != NULL;
        assert_true(result == KIRI_OK || result == KIRI_ERROR_DATA);
    }
    assert_in_range(whole, 5, 20);
    assert_in_range(within, 5, 20);
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

/* Each allocation of a replay is refused once. Then it says so; another world plays it to the end. */
TEST(RefusedReplay)
{
    SCOPED(Tape, tape, Tape_Free);
    bool isDone = false;
    RecordSmall(&tape);
    for (int64_t failAt = 1; !isDone; failAt += failAt < 100 ? 1 : 13) {
        SCOPED(Tape, again, Tape_Free);
        Tape_Start(&again);
        again.host.failAt = failAt;
        again.host.failOnce = true;
        kiriResult result = Tape_Play(&again, &tape);
        isDone = result == KIRI_OK;
        if (!isDone) {
            assert_int_equal(result, KIRI_ERROR_MEMORY);
            Tape_Free(&again);
            Tape_Start(&again);
            OK(Tape_Play(&again, &tape));
        }
    }
}

/* What was refused memory when it was recorded is left out. */
TEST(RecordedRefusals)
{
    static const float way[4] = { 0.3f, -0.1f, 0.5f, 1.5f };
    for (int64_t failAt = 1; failAt < 400; failAt += 7) {
        SCOPED(Tape, tape, Tape_Free);
        SCOPED(Tape, again, Tape_Free);
        Tape_Start(&tape);
        tape.host.failAt = failAt;
        tape.host.failOnce = true;
        kiriSheet sheet = 0;
        kiriSheetDef def = Host_SmallDef();
        while (Host_TryRectangle(&tape.host, &def, 1.0f, 1.0f, 4, 4, &sheet) == KIRI_ERROR_MEMORY) {
        }
        kiriCut cut = 0;
        while (kiriBeginCut(tape.host.world, sheet, way, &cut) == KIRI_ERROR_MEMORY) {
        }
        while (kiriCut_Extend(tape.host.world, cut, way + 2, 1) == KIRI_ERROR_MEMORY) {
        }
        OK(kiriCut_End(tape.host.world, cut));
        while (Host_Tick(&tape.host, 0.01f, 1) == KIRI_ERROR_MEMORY) {
        }
        Tape_Tick(&tape);
        Tape_Stop(&tape);
        Tape_Start(&again);
        OK(Tape_Play(&again, &tape));
    }
}

/* ---- Loads ------------------------------------------------------------------------------------------------------- */

static void Slash(Tape* tape, kiriSheet sheet)
{
    static const float way[4] = { 0.3f, -0.1f, 0.5f, 1.5f };
    Host_Cut(&tape->host, sheet, way, 2);
    Tape_Tick(tape);
}

/* A cut that is finished at once, a save and a load. */
TEST(Load)
{
    const kiriBudget one = { 0, 1, 0, 0 };
    Tape tape;
    Tape_Start(&tape);
    kiriSheet sheet = Tape_AddSheet(&tape, 0.0f);
    OK(kiriWorld_SetBudget(tape.host.world, &one));
    Slash(&tape, sheet);
    int64_t size = 0;
    assert_int_equal(kiriWorld_Save(tape.host.world, NULL, 0, &size), KIRI_PENDING);
    OK(kiriWorld_FinishCuts(tape.host.world));
    World_Copy(tape.host.world, tape.host.world, kiriWorld_Save);
    Slash(&tape, sheet);
    Tape_Stop(&tape);
    Tape_PlayAll(&tape);
}
