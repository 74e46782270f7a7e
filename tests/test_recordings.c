/* Recordings of games go as they did: the same results, ids and state hashes. After a change that moves hashes, and
   says why, `make recordings` writes them anew: the same calls, and what comes of them now. */
#include "tape.h"

#include <stdio.h>

enum { MOST_BYTES = 128 << 10 };

static const char* const paths[] = { "tests/data/recordings/curtain_5.kiri", "tests/data/recordings/net_3.kiri" };
enum { RECORDINGS = sizeof paths / sizeof paths[0] };

static void Read(Tape* tape, const char* path)
{
    FILE* file = fopen(path, "rb");
    assert_non_null(file);
    memset(tape, 0, sizeof *tape);
    tape->bytes = malloc(MOST_BYTES);
    assert_non_null(tape->bytes);
    tape->size = (int64_t)fread(tape->bytes, 1, MOST_BYTES, file);
    assert_true(tape->size < MOST_BYTES);
    fclose(file);
}

TEST(Recordings)
{
    for (int i = 0; i < RECORDINGS; i++) {
        Tape tape, again;
        Read(&tape, paths[i]);
        Tape_Start(&again);
        kiriResult result = Tape_Play(&again, &tape);
        if (result != KIRI_OK) {
            fail_msg("%s: %s; make recordings writes it anew", paths[i], again.host.line);
        }
        assert_true(again.replay.ticks >= 200);
        Tape_Stop(&again);
        Tape_Free(&again);
        Tape_Free(&tape);
    }
}

/* Goes on where something is other than recorded. */
static bool WriteAnew(const char* path)
{
    Tape tape, again;
    Read(&tape, path);
    tape.bytes[9] = (uint8_t)(KIRI_VERSION % 128 + 128); /* the version, whatever it was: see CodeStart in kiri_record.c */
    tape.bytes[10] = (uint8_t)(KIRI_VERSION / 128);
    kiriWorldDef def = Tape_Def(&again);
    def.recordHashTicks = 60;
    OK(kiriCreateWorld(&def, &again.host.world));
    kiriResult result = KIRI_PENDING;
    while (result == KIRI_PENDING || result == KIRI_ERROR_REPLAY) {
        result = Tape_Step(&again, &tape);
    }
    Tape_Stop(&again);
    FILE* file = result == KIRI_OK ? fopen(path, "wb") : NULL;
    bool fine = file != NULL && fwrite(again.bytes, 1, (size_t)again.size, file) == (size_t)again.size;
    fine = file != NULL && fclose(file) == 0 && fine;
    printf("%s: %s\n", path, fine ? "written" : "not written");
    Tape_Free(&again);
    Tape_Free(&tape);
    return fine;
}

SETUP
{
    if (count > 1 && strcmp(words[1], "--write") == 0) {
        bool fine = true;
        for (int i = 0; i < RECORDINGS; i++) {
            fine = WriteAnew(paths[i]) && fine;
        }
        exit(fine ? 0 : 1);
    }
}
