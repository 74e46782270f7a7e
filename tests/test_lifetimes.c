/* Arrays that a call hands out stay as they are until the next tick, whatever is called in between. What is freed is
   poisoned, so a plain comparison tells. */
#include "every_call.h"

typedef struct Lent {
    const char* name;
    const void* array;
    void* copy;
    size_t bytes;
} Lent;

enum { MOST_LENT = 64 };

typedef struct Loan {
    Lent lent[MOST_LENT];
    int32_t count;
} Loan;

static void Lend(Loan* loan, const char* name, const void* array, size_t items, size_t itemBytes)
{
    assert_true(loan->count < MOST_LENT);
    Lent* lent = &loan->lent[loan->count++];
    lent->name = name;
    lent->array = array;
    lent->bytes = items * itemBytes;
    lent->copy = malloc(lent->bytes + 1);
    if (lent->bytes > 0) {
        memcpy(lent->copy, array, lent->bytes);
    }
}

static void LendMesh(Loan* loan, const Host* host, kiriSheet sheet)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    size_t vertices = (size_t)mesh.vertexCount;
    const float* points;
    int32_t count;
    OK(kiriSheet_GetCollisionPoints(host->world, sheet, &points, &count));
    Lend(loan, "positions", mesh.positions, vertices, 12);
    Lend(loan, "normals", mesh.normals, vertices, 12);
    Lend(loan, "rest positions", mesh.restPositions, vertices, 8);
    Lend(loan, "indices", mesh.indices, (size_t)mesh.triangleCount, 12);
    Lend(loan, "source triangles", mesh.sourceTriangles, vertices, 4);
    Lend(loan, "source weights", mesh.sourceWeights, vertices, 12);
    Lend(loan, "collision points", points, (size_t)count, 12);
}

static void LendPiece(Loan* loan, const Host* host, kiriSheet sheet, int32_t piece)
{
    const kiriFrame* frames;
    int32_t count;
    kiriPieceMesh mesh = World_PieceMesh(host->world, sheet, piece);
    OK(kiriSheet_GetPieceFrames(host->world, sheet, piece, &frames, &count));
    Lend(loan, "vertices of a piece", mesh.vertices, (size_t)mesh.vertexCount, 4);
    Lend(loan, "triangles of a piece", mesh.triangles, (size_t)mesh.triangleCount, 4);
    Lend(loan, "indices of a piece", mesh.indices, (size_t)mesh.triangleCount, 12);
    Lend(loan, "collision points of a piece", mesh.collisionPoints, (size_t)mesh.collisionPointCount, 4);
    Lend(loan, "frames of a piece", frames, (size_t)count, sizeof(*frames));
}

static Loan LendAll(const Host* host, kiriSheet sheet)
{
    Loan loan;
    const kiriEvent* events;
    int32_t count;
    memset(&loan, 0, sizeof(loan));
    OK(kiriWorld_GetEvents(host->world, &events, &count));
    Lend(&loan, "events", events, (size_t)count, sizeof(*events));
    LendMesh(&loan, host, sheet);
    for (int32_t piece = 0; piece < Host_Counts(host, sheet).pieces; ++piece) {
        LendPiece(&loan, host, sheet, piece);
    }
    return loan;
}

static void CheckLoan(const Loan* loan, const char* call)
{
    for (int32_t i = 0; i < loan->count; ++i) {
        const Lent* lent = &loan->lent[i];
        if (memcmp(lent->array, lent->copy, lent->bytes) != 0) {
            fail_msg("%s changes %s", call, lent->name);
        }
    }
}

static void EndLoan(Loan* loan)
{
    for (int32_t i = 0; i < loan->count; ++i) {
        free(loan->lent[i].copy);
    }
    loan->count = 0;
}

/* Any call but the first two of the table: kiriWorld_Tick and kiriWorld_FinishCuts end the arrays. */
static const EveryCall* BetweenTicks(uint32_t random)
{
    enum { ENDING = 2 };
    return &everyCall[ENDING + random % (uint32_t)(everyCallCount - ENDING)];
}

TEST(EachCall)
{
    for (const EveryCall* call = BetweenTicks(0); call < everyCall + everyCallCount; ++call) {
        START_STAND(s);
        Loan loan = LendAll(&s.tape.host, s.given.sheet);
        assert_true(Stand_Make(&s, call) >= 0);
        CheckLoan(&loan, call->name);
        EndLoan(&loan);
    }
}

/* Many calls between two ticks, a third of them refused memory, and arrays lent at any time: each stays as lent. */
TEST(CallsAtRandom)
{
    enum { RUNS = 40, STEPS = 12 };
    for (uint32_t run = 1; run <= RUNS; ++run) {
        uint32_t seed = 104729u * run;
        START_STAND(s);
        Loan loans[STEPS];
        Host* host = &s.tape.host;
        for (int step = 0; step < STEPS; ++step) {
            const EveryCall* call = BetweenTicks(Random(&seed));
            kiriCounts counts;
            if (kiriSheet_GetCounts(host->world, s.given.sheet, &counts) != KIRI_OK) { /* destroyed */
                OK(kiriCreateSheet(host->world, &s.def, &s.given.sheet));
            }
            loans[step] = LendAll(host, s.given.sheet);
            host->failAt = Random(&seed) % 3 == 0 ? host->calls + (int64_t)(Random(&seed) % 60) : -1;
            Stand_Make(&s, call);
            host->failAt = -1;
            for (int i = 0; i <= step; ++i) {
                CheckLoan(&loans[i], call->name);
            }
        }
        for (int step = 0; step < STEPS; ++step) {
            EndLoan(&loans[step]);
        }
        assert_true(kiriWorld_Tick(host->world, 1.0f / 60.0f, 1) >= 0);
    }
}

/* What was lent is given back: a tick frees it. */
TEST(TickFreesWhatWasLent)
{
    START_STAND(s);
    Host* host = &s.tape.host;
    OK(kiriDestroySheet(host->world, s.given.sheet));
    int64_t lent = host->live;
    OK(kiriWorld_Tick(host->world, 1.0f / 60.0f, 1));
    assert_true(host->live < lent);
    OK(kiriCreateSheet(host->world, &s.def, &s.given.sheet));
    int64_t before = host->live;
    for (int i = 0; i < 5; ++i) {
        OK(kiriDestroySheet(host->world, s.given.sheet));
        OK(kiriCreateSheet(host->world, &s.def, &s.given.sheet));
        OK(kiriWorld_Tick(host->world, 1.0f / 60.0f, 1));
        assert_int_equal(host->live, before);
    }
}
