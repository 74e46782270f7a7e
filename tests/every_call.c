#include "every_call.h"

#define DEFINE_CALL(function, ...)                                                                                     \
    static kiriResult Call_##function(kiriWorld* world, const Given* g)                                                \
    {                                                                                                                  \
        return function(__VA_ARGS__);                                                                                  \
    }
EVERY_CALL(DEFINE_CALL, DEFINE_CALL)

#define CHANGING_ROW(function, ...) { #function, #__VA_ARGS__, Call_##function, true },
#define READING_ROW(function, ...) { #function, #__VA_ARGS__, Call_##function, false },
const EveryCall everyCall[] = { EVERY_CALL(CHANGING_ROW, READING_ROW) };
const int32_t everyCallCount = sizeof(everyCall) / sizeof(everyCall[0]);

const EveryCall* EveryCall_Find(const char* function)
{
    for (int32_t i = 0; i < everyCallCount; ++i) {
        if (strcmp(everyCall[i].name, function) == 0) {
            return &everyCall[i];
        }
    }
    fail_msg("%s is not in every_call.h", function);
    return NULL;
}

/* ---- The world ---- */

/* So many pins fill their array: one more allocates. */
enum { PINS = 8 };

static float zigzag[400];

static const float from[2] = { 0.02f, 0.03f }, to[2] = { 0.99f, 0.97f }, vector[3] = { 0.1f, 0.2f, 0.3f },
                   spin[3] = { 0.2f, -0.1f, -1.0f }, inertia[6] = { 1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f },
                   axes[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f },
                   quad[12] = { 0.6f, -1.0f, -1.0f, 0.6f, -1.0f, 1.0f, 0.6f, 2.0f, 1.0f, 0.6f, 2.0f, -1.0f },
                   edge[4] = { 0.0f, 0.0f, 0.0f, 1.0f },
                   seamLines[2][4] = { { 1.0f, 0.4f, 1.0f, 0.6f }, { 0.0f, 0.4f, 0.0f, 0.6f } };
static const kiriBudget budget = { 0, 30, 0, 0 };
static const kiriWind wind = { { 1.0f, 0.5f, 0.2f }, 1.2f, 1.1f, 0.1f };
static const kiriTearing tearing = { 200.0f, 1e6f, { 1.0f, 0.5f }, 2.0f, 1.0f, 3 };
static const kiriFold fold = { { 0.0f, 0.3f }, { 1.0f, 0.3f }, 1e-3f, 0.5f, 0.0f };

/* What Stand_Start makes for all stands: a save and a snapshot of the world before its cuts. */
static Bytes kept[2];

static const void* Store(const kiriWorld* world, int k, int64_t* bytes)
{
    if (kept[k].data == NULL) {
        kept[k] = World_Write(world, k == 0 ? kiriWorld_Save : kiriWorld_Snapshot);
    }
    *bytes = kept[k].size;
    return kept[k].data;
}

/* A frame of the second piece, without the lists of pieces: a call is to make them. */
static kiriFrame FrameOfSecondPiece(const kiriWorld* world, kiriSheet sheet)
{
    kiriFrame frames[64];
    int32_t piece;
    assert_int_equal(World_Counts(world, sheet).pieces, 2);
    int32_t count = World_GetFrames(world, sheet, frames, 64);
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_GetPiece(world, frames[i], &piece));
        if (piece == 1) {
            return frames[i];
        }
    }
    fail_msg("the second piece has no frame");
    return 0;
}

static kiriSheetDef MeshDef(int32_t squares)
{
    static float positions[2][2 * 5 * 5];
    static int32_t indices[2][6 * 4 * 4];
    int k = squares == 4;
    kiriSheetDef def = Host_SmallDef();
    OK(kiriFillRectangle(1.0f, 1.0f, squares, squares, positions[k], indices[k]));
    def.restPositions = positions[k];
    def.indices = indices[k];
    def.vertexCount = (squares + 1) * (squares + 1);
    def.triangleCount = 2 * squares * squares;
    return def;
}

/* The arguments that are the same for all worlds. */
static void FillValues(Stand* s)
{
    static kiriPinDef pinDef;
    static kiriObstacleDef obstacleDef;
    static kiriDebugDraw draw;
    static kiriContact contacts[12];
    for (int i = 0; i < 400; ++i) {
        zigzag[i] = 0.2f + 0.0015f * (float)((i * 37) % 400);
    }
    for (int i = 0; i < 12; ++i) {
        contacts[i] = (kiriContact){ .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.001f, .friction = 0.3f };
    }
    pinDef = Host_PinDef(0.9f, 0.1f, 0.9f, 0.1f, 0.0f);
    obstacleDef = DefaultObstacle();
    obstacleDef.type = KIRI_OBSTACLE_SPHERE;
    obstacleDef.radius = 0.1f;
    obstacleDef.position[0] = 5.0f;
    kiriDefaultDebugDraw(&draw);
    s->given = (Given){ .point = from,
                        .end = to,
                        .points = zigzag,
                        .vector = vector,
                        .spin = spin,
                        .rotation = axes,
                        .inertia = inertia,
                        .quad = quad,
                        .dt = 0.01f,
                        .size = 0.5f,
                        .index = 0,
                        .one = 1,
                        .def = &s->def,
                        .pinDef = &pinDef,
                        .obstacleDef = &obstacleDef,
                        .seamDef = &s->seamDef,
                        .settings = &s->settings,
                        .draw = &draw,
                        .budget = &budget,
                        .wind = &wind,
                        .tearing = &tearing,
                        .fold = &fold,
                        .contacts = contacts,
                        .frames = &s->given.frame,
                        .replay = &s->replay,
                        .id = &s->ids[8],
                        .ids = s->ids,
                        .count = &s->count,
                        .out = s->out,
                        .spare = s->out,
                        .more = s->out + 32 };
}

static void AddThings(Stand* s)
{
    kiriWorld* world = s->tape.host.world;
    Given* g = &s->given;
    kiriSheetDef small = MeshDef(2);
    small.position[0] = 1.0f;
    OK(kiriCreateSheet(world, &s->def, &g->sheet));
    OK(kiriCreateFoldedSheet(world, &small, &(kiriFold){ { 0.5f, 0.0f }, { 0.5f, 1.0f }, 0.0f, 0.0f, 0.0f }, 1,
                             &g->folded));
    kiriDefaultSeamDef(&s->seamDef);
    s->seamDef.sheetA = g->sheet;
    s->seamDef.sheetB = g->folded;
    s->seamDef.lineA = seamLines[0];
    s->seamDef.lineB = seamLines[1];
    s->seamDef.countA = s->seamDef.countB = 2;
    OK(kiriCreateSeam(world, &s->seamDef, &g->seam));
    OK(kiriCreateObstacle(world, g->obstacleDef, &g->obstacle));
    OK(kiriBeginBlade(world, 0, &g->blade));
    for (int i = 0; i < PINS - 1; ++i) {
        g->pin = Host_Pin(&s->tape.host, g->sheet, 0.1f, 0.9f, 0.1f, 0.9f, 0.0f);
    }
    g->clamp = World_Clamp(world, g->sheet, edge, edge + 2); /* over both pieces */
}

void Stand_Start(Stand* s, kiriRecordFn* record)
{
    memset(s, 0, sizeof(*s));
    kiriWorldDef def = Tape_Def(&s->tape);
    def.record = record;
    Stand_StartBy(s, &def);
}

void Stand_StartBy(Stand* s, const kiriWorldDef* def)
{
    static const float strip[4] = { -0.1f, 0.22f, 1.1f, 0.25f }, start[4] = { 0.3f, 0.8f, 0.4f, 0.7f };
    OK(kiriCreateWorld(def, &s->tape.host.world));
    kiriWorld* world = s->tape.host.world;
    Given* g = &s->given;
    FillValues(s);
    s->def = MeshDef(4);
    s->def.framePoints = NULL;
    s->def.collisionPoints = 12;
    AddThings(s);
    Host_Cut(&s->tape.host, g->sheet, strip, 2);
    OK(kiriBeginCut(world, g->sheet, start, &g->cut));
    OK(kiriCut_Extend(world, g->cut, start + 2, 1));
    OK(kiriWorld_Tick(world, 0.01f, 2));
    g->frame = FrameOfSecondPiece(world, g->sheet);
    g->save = Store(world, 0, &g->saveBytes);
    g->snapshot = Store(world, 1, &g->snapshotBytes);
    s->replay.offset = 4;
    OK(kiriSheet_GetSettings(world, g->sheet, &s->settings));
    s->settings.friction = 0.25f;
}

void Stand_Stop(Stand* s)
{
    Tape_Free(&s->tape);
}
