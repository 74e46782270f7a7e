/* Arrays that a call hands out stay as they are until the next tick, whatever is called in between. What is freed is
   poisoned, so a plain comparison tells. */
#include "host.h"

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

/* ---- A sheet of five pieces ---- */

typedef struct Desk {
    Host host;
    kiriSheetDef def;
    Rectangle mesh;
    kiriSheet sheet;
    kiriPin pin;
    kiriCut cut;
    bool waits; /* a piece is to be detached, when the budget has paid for it */
} Desk;

static void Desk_Start(Desk* desk)
{
    static const float way[4] = { 0.5f, 2.0f, 0.6f, 2.0f };
    memset(desk, 0, sizeof(*desk));
    Host_Start(&desk->host);
    kiriPinDef pin;
    kiriDefaultPinDef(&pin);
    pin.restPoint[0] = pin.restPoint[1] = 0.1f;
    desk->def = Host_SmallDef();
    desk->def.collisionPoints = 60;
    desk->mesh = Rectangle_Make(&desk->def, 1.0f, 1.0f, 6, 6);
    OK(kiriCreateSheet(desk->host.world, &desk->def, &desk->sheet));
    OK(kiriCreatePin(desk->host.world, desk->sheet, &pin, &desk->pin));
    for (int i = 0; i < 4; ++i) {
        float v = 0.3f + 0.18f * (float)i, line[4] = { -0.1f, v, 1.1f, v + 0.03f };
        Host_Cut(&desk->host, desk->sheet, line, 2);
    }
    OK(kiriBeginCut(desk->host.world, desk->sheet, way, &desk->cut));
    OK(kiriWorld_Tick(desk->host.world, 1.0f / 60.0f, 2));
    assert_int_equal(Host_Counts(&desk->host, desk->sheet).pieces, 5);
}

static void Desk_Stop(Desk* desk)
{
    Rectangle_Free(&desk->mesh);
    Host_Stop(&desk->host);
}

/* ---- Calls in between ---- */

/* What it may be with a piece that waits: the call waits, too, or would leave nothing. */
static bool Waits(kiriResult result)
{
    return result == KIRI_OK || result == KIRI_PENDING || result == KIRI_ERROR_STATE;
}

static void DetachPiece(Desk* desk, uint32_t random)
{
    int32_t pieces = Host_Counts(&desk->host, desk->sheet).pieces;
    kiriSheet detached;
    kiriFrame frame = Host_FrameOf(&desk->host, desk->sheet, (int32_t)(random % (uint32_t)pieces));
    kiriResult result = kiriFrame_DetachPiece(desk->host.world, frame, &detached);
    desk->waits = desk->waits || result == KIRI_PENDING;
    assert_true(result == (pieces > 1 ? KIRI_OK : KIRI_ERROR_STATE) || (desk->waits && Waits(result)));
}

static void DestroyPiece(Desk* desk, uint32_t random)
{
    int32_t pieces = Host_Counts(&desk->host, desk->sheet).pieces;
    kiriFrame frame = Host_FrameOf(&desk->host, desk->sheet, (int32_t)(random % (uint32_t)pieces));
    kiriResult result = kiriFrame_DestroyPiece(desk->host.world, frame);
    assert_true(result == (pieces > 1 ? KIRI_OK : KIRI_ERROR_STATE) || (desk->waits && Waits(result)));
}

static void DropCrumbs(Desk* desk, uint32_t random)
{
    int32_t count;
    OK(kiriSheet_DropCrumbs(desk->host.world, desk->sheet, random % 2 == 0 ? 0.16f : 1.0f, &count));
}

static void DestroySheet(Desk* desk, uint32_t random)
{
    OK(kiriDestroySheet(desk->host.world, desk->sheet));
    OK(kiriCreateSheet(desk->host.world, &desk->def, &desk->sheet));
}

static void CreateSheets(Desk* desk, uint32_t random)
{
    for (uint32_t i = 0; i < 1 + random % 10; ++i) {
        kiriSheet sheet;
        OK(kiriCreateSheet(desk->host.world, &desk->def, &sheet));
    }
}

/* Getters that write into arrays of the library: those of pieces. */
static void Get(Desk* desk, uint32_t random)
{
    int32_t pieces = Host_Counts(&desk->host, desk->sheet).pieces;
    Loan loan = LendAll(&desk->host, desk->sheet);
    EndLoan(&loan);
    World_PieceState(desk->host.world, desk->sheet, (int32_t)(random % (uint32_t)pieces));
}

static void SetContacts(Desk* desk, uint32_t random)
{
    kiriContact contacts[100];
    int32_t points = Host_Counts(&desk->host, desk->sheet).collisionPoints;
    int32_t count = points > 0 ? (int32_t)(random % 100) : 0;
    for (int32_t i = 0; i < count; ++i) {
        kiriContact contact = {
            .point = i % points, .normal = { 0.0f, 0.0f, 1.0f }, .offset = -0.1f, .friction = 0.3f
        };
        contacts[i] = contact;
    }
    OK(kiriSheet_SetContacts(desk->host.world, desk->sheet, contacts, count));
}

static void Cut(Desk* desk, uint32_t random)
{
    float u = (float)(random % 100) / 100.0f;
    float blade[12] = { u, -1.0f, -1.0f, u, -1.0f, 1.0f, u, 2.0f, 1.0f, u, 2.0f, -1.0f };
    kiriCut cut;
    OK(kiriSheet_Slice(desk->host.world, desk->sheet, blade, &cut));
    OK(kiriBeginCut(desk->host.world, desk->sheet, blade, &cut));
    OK(kiriCut_Extend(desk->host.world, cut, blade, 6));
    OK(kiriCut_End(desk->host.world, cut));
}

static void Pin(Desk* desk, uint32_t random)
{
    for (uint32_t i = 0; i < 1 + random % 20; ++i) {
        const float* at = &Host_Mesh(&desk->host, desk->sheet).restPositions[0];
        Host_Pin(&desk->host, desk->sheet, at[0], at[1], 0.0f, 0.0f, 0.0f);
    }
}

static void Push(Desk* desk, uint32_t random)
{
    static const float eye[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    kiriFrame frame = Host_FrameOf(&desk->host, desk->sheet, 0);
    kiriBudget budget = { (int32_t)(16 + random % 20), 50, 50, 0 };
    OK(kiriFrame_Hold(desk->host.world, frame, eye, eye));
    OK(kiriFrame_ApplyForce(desk->host.world, frame, eye, eye));
    OK(kiriWorld_SetGravity(desk->host.world, eye));
    OK(kiriWorld_ShiftOrigin(desk->host.world, eye));
    OK(kiriWorld_SetBudget(desk->host.world, &budget));
    OK(kiriSheet_Wake(desk->host.world, desk->sheet));
}

static void Fail(Desk* desk, uint32_t random)
{
    kiriSheet sheet;
    desk->host.failAt = desk->host.calls + (int64_t)(random % 60);
    kiriResult result = kiriCreateSheet(desk->host.world, &desk->def, &sheet);
    desk->host.failAt = -1;
    assert_int_equal(result, KIRI_ERROR_MEMORY);
    assert_int_equal(kiriWorld_Tick(desk->host.world, 0.0f, 1), KIRI_ERROR_ARGUMENT); /* no tick */
}

typedef struct Between {
    const char* name;
    void (*call)(Desk* desk, uint32_t random);
} Between;

static const Between betweens[] = {
    { "kiriFrame_DetachPiece", DetachPiece },
    { "kiriFrame_DestroyPiece", DestroyPiece },
    { "kiriSheet_DropCrumbs", DropCrumbs },
    { "kiriDestroySheet", DestroySheet },
    { "kiriCreateSheet", CreateSheets },
    { "a getter", Get },
    { "kiriSheet_SetContacts", SetContacts },
    { "a cut", Cut },
    { "kiriCreatePin", Pin },
    { "kiriFrame_Hold", Push },
    { "a call that fails", Fail },
};

enum { BETWEENS = sizeof(betweens) / sizeof(betweens[0]) };

TEST(EachCall)
{
    for (int k = 0; k < BETWEENS; ++k) {
        SCOPED(Desk, desk, Desk_Stop);
        Desk_Start(&desk);
        Loan loan = LendAll(&desk.host, desk.sheet);
        betweens[k].call(&desk, 3);
        CheckLoan(&loan, betweens[k].name);
        EndLoan(&loan);
    }
}

/* Many calls between two ticks, and arrays lent at any time: what the first call makes stale the others keep. */
TEST(CallsAtRandom)
{
    enum { RUNS = 40, STEPS = 12 };
    for (uint32_t run = 1; run <= RUNS; ++run) {
        uint32_t seed = 104729u * run;
        SCOPED(Desk, desk, Desk_Stop);
        Loan loans[STEPS];
        Desk_Start(&desk);
        for (int step = 0; step < STEPS; ++step) {
            const Between* between = &betweens[Random(&seed) % BETWEENS];
            loans[step] = LendAll(&desk.host, desk.sheet);
            between->call(&desk, Random(&seed));
            for (int i = 0; i <= step; ++i) {
                CheckLoan(&loans[i], between->name);
            }
        }
        for (int step = 0; step < STEPS; ++step) {
            EndLoan(&loans[step]);
        }
        assert_true(kiriWorld_Tick(desk.host.world, 1.0f / 60.0f, 1) >= 0);
    }
}

/* What was lent is given back: a tick frees it. */
TEST(TickFreesWhatWasLent)
{
    SCOPED(Desk, desk, Desk_Stop);
    Desk_Start(&desk);
    OK(kiriDestroySheet(desk.host.world, desk.sheet));
    int64_t lent = desk.host.live;
    OK(kiriWorld_Tick(desk.host.world, 1.0f / 60.0f, 1));
    assert_true(desk.host.live < lent);
    OK(kiriCreateSheet(desk.host.world, &desk.def, &desk.sheet));
    int64_t before = desk.host.live;
    for (int i = 0; i < 5; ++i) {
        OK(kiriDestroySheet(desk.host.world, desk.sheet));
        OK(kiriCreateSheet(desk.host.world, &desk.def, &desk.sheet));
        OK(kiriWorld_Tick(desk.host.world, 1.0f / 60.0f, 1));
        assert_int_equal(desk.host.live, before);
    }
}
