/* A host of the library for the tests that use the public header alone: an allocator that counts, poisons and refuses,
   a log, and rectangles. */
#ifndef KIRI_TEST_HOST_H
#define KIRI_TEST_HOST_H

#include "defaults.h"
#include "kiri/kiri.h"
#include "scoped.h"
#include "support.h"
#include "validate.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const float noVector[3] = { 0.0f, 0.0f, 0.0f };
static const float worldAxes[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };

typedef struct Host {
    kiriWorld* world;
    int64_t live;    /* blocks that are out */
    int64_t bytes;   /* of these */
    int64_t calls;   /* of the allocator */
    int64_t failAt;  /* the call that gets null; negative: none */
    bool failOnce;   /* or all calls from there on */
    int64_t most;    /* bytes that a block may have; 0: no limit */
    int64_t room;    /* bytes that all may have; 0: no limit */
    int64_t peak;    /* the most bytes that were out */
    int64_t failEvery; /* each so many calls one gets null; 0: none */
    int64_t refused; /* calls that got null */
    uint8_t
        poison;    /* other bits than usual, for what is not written: two hosts that differ in it tell who reads that */
    int32_t ticks; /* through Host_Tick */
    int32_t every; /* so many ticks the world is validated; 0: every one */
    int32_t lines; /* logged */
    char line[256]; /* the last of them */
} Host;

/* Comes before each block. 16 bytes, so that the block is aligned. */
typedef struct HostBlock {
    int64_t bytes, unused;
} HostBlock;

/* Poisoned, so that whoever reads what was not written gets nonsense. */
static inline void* Host_Alloc(void* user, int64_t bytes)
{
    Host* host = user;
    int64_t call = host->calls++;
    bool isTooLarge = (host->most > 0 && bytes > host->most) || (host->room > 0 && host->bytes + bytes > host->room),
         isTurn = host->failEvery > 0 && call % host->failEvery == host->failEvery - 1;
    if (isTooLarge || isTurn || (host->failAt >= 0 && (host->failOnce ? call == host->failAt : call >= host->failAt))) {
        ++host->refused;
        return NULL;
    }
    HostBlock* block = malloc(sizeof(HostBlock) + (size_t)bytes);
    assert_non_null(block);
    block->bytes = bytes;
    host->bytes += bytes;
    host->peak = host->bytes > host->peak ? host->bytes : host->peak;
    ++host->live;
    return memset(block + 1, 0xcd ^ host->poison, (size_t)bytes);
}

/* Poisoned again, for whoever still reads it. The compiler would leave the poison out before a plain call of free. */
static inline void Host_Free(void* user, void* pointer)
{
    static void (*volatile const release)(void*) = free;
    HostBlock* block = pointer;
    --((Host*)user)->live;
    if (block != NULL) {
        --block;
        ((Host*)user)->bytes -= block->bytes;
        memset(block, 0xdd, sizeof(HostBlock) + (size_t)block->bytes);
        release(block);
    }
}

/* Does it name a type of the library's own, kiriSheetData say? */
static inline bool Host_NamesData(const char* line)
{
    const char* at = strstr(line, "Data");
    while (at != NULL && at - line >= 4 && strncmp(at - 4, "User", 4) == 0) {
        at = strstr(at + 4, "Data");
    }
    return at != NULL;
}

/* Does it name a triangle by its number? */
static inline bool Host_NamesTriangle(const char* line)
{
    const char* at = strstr(line, "triangle");
    at = at != NULL ? at + strlen("triangle") : "";
    at += *at == 's';
    return at[0] == ' ' && at[1] >= '0' && at[1] <= '9';
}

/* What the header says of a line: one line, of at most 255 characters, in the words of the header. */
static inline void Host_CheckLine(const char* line)
{
    bool isNamed = strstr(line, "(KIRI_ERROR_MESH)") == NULL || Host_NamesTriangle(line);
    if (!isNamed || strncmp(line, "kiri", 4) != 0 || strchr(line, '\n') != NULL || strlen(line) > 255 ||
        Host_NamesData(line) || strstr(line, ": ") == NULL || strstr(line, " (KIRI_") == NULL) {
        fail_msg("a line for the host: \"%s\"", line);
    }
}

static inline void Host_Log(void* user, const char* line)
{
    Host* host = user;
    ++host->lines;
    Host_CheckLine(line);
    strcpy(host->line, line);
}

static inline kiriWorldDef Host_Def(Host* host)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.alloc = Host_Alloc;
    def.free = Host_Free;
    def.log = Host_Log;
    def.user = host;
    return def;
}

static inline void Host_Start(Host* host)
{
    memset(host, 0, sizeof(*host));
    host->failAt = -1;
    kiriWorldDef def = Host_Def(host);
    assert_int_equal(kiriCreateWorld(&def, &host->world), KIRI_OK);
}

/* Declare a host, or two, which stop at the end of their scope; the last one starts it too. */
#define HOST(name) SCOPED(Host, name, Host_Stop)
#define HOST_PAIR(name) __attribute__((cleanup(Host_StopPair))) Host name[2] = { { 0 } }
#define START_HOST(name)                                                                                               \
    HOST(name);                                                                                                        \
    Host_Start(&name)

/* Fails the test where anything in the world contradicts itself. */
static inline void Host_Validate(const Host* host)
{
    const char* wrong = Validate_World(host->world);
    if (wrong != NULL) {
        fail_msg("%s", wrong);
    }
}

/* A tick, after which the world must be sound whatever came of it. With sanitizers, which take longer, some are looked at. */
static inline kiriResult Host_Tick(Host* host, float dt, int32_t substeps)
{
    kiriResult result = kiriWorld_Tick(host->world, dt, substeps);
    int32_t every = host->every > 0 ? host->every : IS_SANITIZED ? 7 : 1;
    if (host->ticks++ % every == 0) {
        Host_Validate(host);
    }
    return result;
}

/* So many ticks; each must be a success. */
static inline void Host_Ticks(Host* host, int32_t count, float dt, int32_t substeps)
{
    for (int32_t i = 0; i < count; ++i) {
        assert_int_equal(Host_Tick(host, dt, substeps), KIRI_OK);
    }
}

/* For worlds that a test has made unsound. */
static inline void Host_Destroy(Host* host)
{
    kiriDestroyWorld(host->world);
    host->world = NULL;
    assert_int_equal(host->live, 0);
}

static inline void Host_Stop(Host* host)
{
    if (host->world != NULL) {
        Host_Validate(host);
        Host_Destroy(host);
    }
}

static inline void Host_StopPair(Host (*hosts)[2])
{
    Host_Stop(&(*hosts)[0]);
    Host_Stop(&(*hosts)[1]);
}

static inline uint64_t Host_Hash(const Host* host)
{
    uint64_t hash = 0;
    assert_int_equal(kiriWorld_GetStateHash(host->world, &hash), KIRI_OK);
    return hash;
}

#define OK(call) assert_int_equal(call, KIRI_OK)

/* ---- Getters, and calls that make one thing, which must succeed ---- */

#define WORLD_GETTER(Type, Name, call, Id)                                                                             \
    static inline Type Name(const kiriWorld* world, Id id)                                                             \
    {                                                                                                                  \
        Type value;                                                                                                    \
        OK(call(world, id, &value));                                                                                   \
        return value;                                                                                                  \
    }
#define PIECE_GETTER(Type, Name, call)                                                                                 \
    static inline Type Name(kiriWorld* world, kiriSheet sheet, int32_t piece)                                          \
    {                                                                                                                  \
        Type value;                                                                                                    \
        OK(call(world, sheet, piece, &value));                                                                         \
        return value;                                                                                                  \
    }
WORLD_GETTER(kiriFrameState, World_FrameState, kiriFrame_GetState, kiriFrame)
WORLD_GETTER(int32_t, World_PieceOf, kiriFrame_GetPiece, kiriFrame)
WORLD_GETTER(kiriTotals, World_Totals, kiriSheet_GetTotals, kiriSheet)
WORLD_GETTER(kiriSheetSettings, World_Settings, kiriSheet_GetSettings, kiriSheet)
WORLD_GETTER(kiriMesh, World_Mesh, kiriSheet_GetMesh, kiriSheet)
WORLD_GETTER(kiriCounts, World_Counts, kiriSheet_GetCounts, kiriSheet)
WORLD_GETTER(kiriTearing, World_Tearing, kiriSheet_GetTearing, kiriSheet)
WORLD_GETTER(int32_t, World_IsAwake, kiriSheet_IsAwake, kiriSheet)
WORLD_GETTER(kiriObstacleState, World_ObstacleState, kiriObstacle_GetState, kiriObstacle)
WORLD_GETTER(kiriPinState, World_PinState, kiriPin_GetState, kiriPin)
WORLD_GETTER(int32_t, World_StitchCount, kiriSeam_GetCount, kiriSeam)
PIECE_GETTER(kiriPieceState, World_PieceState, kiriSheet_GetPiece)
PIECE_GETTER(kiriPieceMesh, World_PieceMesh, kiriSheet_GetPieceMesh)

static inline kiriProfile World_Profile(const kiriWorld* world)
{
    kiriProfile profile;
    OK(kiriWorld_GetProfile(world, &profile));
    return profile;
}

static inline kiriPointState World_PointState(const kiriWorld* world, kiriSheet sheet, const float rest[2])
{
    kiriPointState state;
    OK(kiriSheet_GetPoint(world, sheet, rest, &state));
    return state;
}

static inline kiriFoldState World_FoldState(const kiriWorld* world, kiriSheet sheet, int32_t fold)
{
    kiriFoldState state;
    OK(kiriSheet_GetFold(world, sheet, fold, &state));
    return state;
}

/* Returns the number of frames of the sheet. */
static inline int32_t World_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity)
{
    int32_t count;
    OK(kiriSheet_GetFrames(world, sheet, frames, capacity, &count));
    return count;
}

static inline int32_t World_GetPins(const kiriWorld* world, kiriSheet sheet, kiriPin* pins, int32_t capacity)
{
    int32_t count;
    OK(kiriSheet_GetPins(world, sheet, pins, capacity, &count));
    return count;
}

static inline kiriSheet World_AddSheet(kiriWorld* world, const kiriSheetDef* def)
{
    kiriSheet made;
    OK(kiriCreateSheet(world, def, &made));
    return made;
}

static inline kiriObstacle World_AddObstacle(kiriWorld* world, const kiriObstacleDef* def)
{
    kiriObstacle made;
    OK(kiriCreateObstacle(world, def, &made));
    return made;
}

/* Ticks until the sheet sleeps, `most` times at most. Returns false if it is still awake then. */
static inline bool Host_Sleeps(Host* host, kiriSheet sheet, float dt, int32_t most)
{
    int32_t awake = 1;
    for (int32_t tick = 0; tick < most && awake; ++tick) {
        OK(Host_Tick(host, dt, 2));
        OK(kiriSheet_IsAwake(host->world, sheet, &awake));
    }
    return !awake;
}

static inline kiriObstacle World_AddFloor(kiriWorld* world)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_PLANE);
    return World_AddObstacle(world, &def);
}

static inline kiriSeam World_AddSeam(kiriWorld* world, const kiriSeamDef* def)
{
    kiriSeam made;
    OK(kiriCreateSeam(world, def, &made));
    return made;
}

static inline kiriPin World_AddPin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def)
{
    kiriPin made;
    OK(kiriCreatePin(world, sheet, def, &made));
    return made;
}

static inline kiriPin World_Clamp(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2])
{
    kiriPin made;
    OK(kiriSheet_ClampLine(world, sheet, from, to, &made));
    return made;
}

static inline kiriPin World_Hinge(kiriWorld* world, kiriSheet sheet, const float from[2], const float to[2])
{
    kiriPin made;
    OK(kiriSheet_HingeLine(world, sheet, from, to, &made));
    return made;
}

static inline kiriCut World_BeginCut(kiriWorld* world, kiriSheet sheet, const float rest[2])
{
    kiriCut made;
    OK(kiriBeginCut(world, sheet, rest, &made));
    return made;
}

static inline kiriBlade World_BeginBlade(kiriWorld* world, kiriSheet sheet)
{
    kiriBlade made;
    OK(kiriBeginBlade(world, sheet, &made));
    return made;
}

static inline kiriSheet World_Detach(kiriWorld* world, kiriFrame frame)
{
    kiriSheet made;
    OK(kiriFrame_DetachPiece(world, frame, &made));
    return made;
}

static inline kiriSheet World_AddRectangle(kiriWorld* world, float width, float height, int32_t columns, int32_t rows,
                                           const kiriSheetDef* def)
{
    kiriSheet made;
    OK(kiriCreateRectangle(world, width, height, columns, rows, def, &made));
    return made;
}

/* Sets gravity to 0. */
static inline void World_StopGravity(kiriWorld* world)
{
    OK(kiriWorld_SetGravity(world, (const float[]){ 0.0f, 0.0f, 0.0f }));
}

/* Makes `count` ticks without a check of the world. Each must return KIRI_OK. */
static inline void World_Ticks(kiriWorld* world, int32_t count, float dt, int32_t substeps)
{
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriWorld_Tick(world, dt, substeps));
    }
}

/* ---- Saves and snapshots ---- */

typedef kiriResult WriteFn(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size);

typedef struct Bytes {
    uint8_t* data;
    int64_t size;
} Bytes;

static inline void Bytes_Free(Bytes* bytes)
{
    free(bytes->data);
}

/* Writes the world by kiriWorld_Save or kiriWorld_Snapshot. */
static inline Bytes World_Write(const kiriWorld* world, WriteFn* write)
{
    Bytes bytes = { NULL, 0 };
    int64_t size = 0;
    OK(write(world, NULL, 0, &bytes.size));
    bytes.data = malloc((size_t)bytes.size);
    assert_non_null(bytes.data);
    OK(write(world, bytes.data, bytes.size, &size));
    assert_int_equal(size, bytes.size);
    return bytes;
}

/* Replaces a world by what kiriWorld_Save or kiriWorld_Snapshot writes of another, or of itself. */
static inline void World_Copy(kiriWorld* to, const kiriWorld* from, WriteFn* write)
{
    Bytes bytes = World_Write(from, write);
    OK((write == kiriWorld_Save ? kiriWorld_Load : kiriWorld_Restore)(to, bytes.data, bytes.size));
    Bytes_Free(&bytes);
}

/* The mesh of a def. */
typedef struct Rectangle {
    float* positions;
    int32_t* indices;
} Rectangle;

static inline Rectangle Rectangle_Make(kiriSheetDef* def, float width, float height, int32_t columns, int32_t rows)
{
    Rectangle r;
    r.positions = malloc(2 * sizeof(float) * (size_t)((columns + 1) * (rows + 1)));
    r.indices = malloc(6 * sizeof(int32_t) * (size_t)(columns * rows));
    OK(kiriFillRectangle(width, height, columns, rows, r.positions, r.indices));
    def->restPositions = r.positions;
    def->indices = r.indices;
    def->vertexCount = (columns + 1) * (rows + 1);
    def->triangleCount = 2 * columns * rows;
    return r;
}

static inline void Rectangle_Free(Rectangle* r)
{
    free(r->positions);
    free(r->indices);
}

static inline kiriResult Host_TryRectangle(Host* host, kiriSheetDef* def, float width, float height, int32_t columns,
                                           int32_t rows, kiriSheet* sheet)
{
    Rectangle r = Rectangle_Make(def, width, height, columns, rows);
    kiriResult result = kiriCreateSheet(host->world, def, sheet);
    Rectangle_Free(&r);
    Host_Validate(host);
    return result;
}

static inline kiriSheet Host_AddRectangle(Host* host, kiriSheetDef* def, float width, float height, int32_t columns,
                                          int32_t rows)
{
    kiriSheet sheet = 0;
    OK(Host_TryRectangle(host, def, width, height, columns, rows, &sheet));
    return sheet;
}

/* A grid of 8, four frames at the middles of cells: small and quick. */
static inline kiriSheetDef Host_SmallDef(void)
{
    static const float points[8] = { 0.1875f, 0.1875f, 0.8125f, 0.1875f, 0.1875f, 0.8125f, 0.8125f, 0.8125f };
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 8;
    def.frameCount = 4;
    def.framePoints = points;
    def.collisionPoints = 6;
    return def;
}

/* Adds a square of 1 m with this def. */
static inline kiriSheet Host_AddSmall(Host* host, int32_t squares)
{
    kiriSheetDef def = Host_SmallDef();
    return Host_AddRectangle(host, &def, 1.0f, 1.0f, squares, squares);
}

/* A whole cut, waiting for the next tick. */
static inline kiriCut Host_Cut(Host* host, kiriSheet sheet, const float* points, int32_t count)
{
    kiriCut cut = 0;
    OK(kiriSheet_Cut(host->world, sheet, points, count, &cut));
    return cut;
}

static inline kiriPinDef Host_PinDef(float u, float v, float x, float y, float z)
{
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = u;
    def.restPoint[1] = v;
    def.target[0] = x;
    def.target[1] = y;
    def.target[2] = z;
    return def;
}

static inline kiriPin Host_Pin(Host* host, kiriSheet sheet, float u, float v, float x, float y, float z)
{
    kiriPinDef def = Host_PinDef(u, v, x, y, z);
    kiriPin pin = 0;
    OK(kiriCreatePin(host->world, sheet, &def, &pin));
    return pin;
}

/* A cut across all of the sheet, a slit, or a loop in it. */
static inline void Host_CutSomewhere(Host* host, kiriSheet sheet, uint32_t* seed)
{
    float from = (float)RandomBetween(seed, 0.0, 1.0), to = (float)RandomBetween(seed, 0.0, 1.0);
    float u = (float)RandomBetween(seed, 0.1, 0.8), v = (float)RandomBetween(seed, 0.1, 0.8);
    switch (Random(seed) % 4) {
    case 0:
        Host_Cut(host, sheet, (float[]){ from, -0.1f, to, 1.1f }, 2);
        break;
    case 1:
        Host_Cut(host, sheet, (float[]){ -0.1f, from, 1.1f, to }, 2);
        break;
    case 2:
        Host_Cut(host, sheet, (float[]){ u, v, u + 0.1f, v + 0.07f }, 2);
        break;
    default:
        Host_Cut(host, sheet, (float[]){ u, v, u + 0.15f, v, u + 0.1f, v + 0.15f, u, v }, 4);
    }
}

static inline int32_t Host_SheetCount(const Host* host)
{
    int32_t count;
    OK(kiriWorld_GetSheets(host->world, NULL, 0, &count));
    return count;
}

/* The sheets by age, the oldest first. */
static inline kiriSheet Host_SheetAt(const Host* host, int32_t index)
{
    kiriSheet sheets[64];
    int32_t count;
    assert_in_range(index, 0, 63);
    OK(kiriWorld_GetSheets(host->world, sheets, 64, &count));
    assert_in_range(index, 0, count - 1);
    return sheets[index];
}

static inline kiriCounts Host_Counts(const Host* host, kiriSheet sheet)
{
    kiriCounts counts;
    OK(kiriSheet_GetCounts(host->world, sheet, &counts));
    return counts;
}

static inline kiriTotals Host_Totals(const Host* host, kiriSheet sheet)
{
    kiriTotals totals;
    OK(kiriSheet_GetTotals(host->world, sheet, &totals));
    return totals;
}

static inline kiriMesh Host_Mesh(const Host* host, kiriSheet sheet)
{
    kiriMesh mesh;
    OK(kiriSheet_GetMesh(host->world, sheet, &mesh));
    return mesh;
}

/* The first frame of a piece, which names it. */
static inline kiriFrame Host_FrameOf(const Host* host, kiriSheet sheet, int32_t piece)
{
    const kiriFrame* frames;
    int32_t count;
    OK(kiriSheet_GetPieceFrames(host->world, sheet, piece, &frames, &count));
    assert_true(count > 0);
    return frames[0];
}

/* How many events of this type the last tick had; *first is one of them. */
static inline int32_t Host_Events(const Host* host, int32_t type, kiriEvent* first)
{
    const kiriEvent* events;
    int32_t count, found = 0;
    OK(kiriWorld_GetEvents(host->world, &events, &count));
    for (int32_t i = 0; i < count; ++i) {
        if (events[i].type == type && found++ == 0 && first != NULL) {
            *first = events[i];
        }
    }
    return found;
}

static inline bool AllFinite(const float* values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

#endif
