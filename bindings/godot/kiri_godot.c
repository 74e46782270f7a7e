/* The class KiriWorld for scripts of Godot 3: a world, and what the sample does with it. */
#include "godot.h"

#include "kiri/kiri.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const Core* core;

#define CALL(index, result, parameters) ((result(*) parameters)core->functions[index])

/* ---- What goes to scripts and comes from them ---- */

static Variant OfNil(void)
{
    Variant made;
    CALL(VARIANT_NIL, void, (Variant*))(&made);
    return made;
}

static Variant OfInt(int64_t value)
{
    Variant made;
    CALL(VARIANT_INT, void, (Variant*, int64_t))(&made, value);
    return made;
}

static Variant OfText(const char* text)
{
    Variant made;
    String string;
    CALL(STRING_NEW, void, (String*))(&string);
    CALL(STRING_PARSE, uint8_t, (String*, const char*))(&string, text);
    CALL(VARIANT_STRING, void, (Variant*, const String*))(&made, &string);
    CALL(STRING_DESTROY, void, (String*))(&string);
    return made;
}

/* An array of `count` items of `size` bytes each. */
static Variant OfRows(const PoolKind* kind, const void* rows, int count, int size)
{
    Pool pool;
    Variant made;
    CALL(kind->make, void, (Pool*))(&pool);
    CALL(kind->resize, void, (Pool*, int))(&pool, count);
    void* access = CALL(kind->write, void*, (Pool*))(&pool);
    if (count > 0) {
        memcpy(CALL(kind->writeAt, void*, (void*))(access), rows, (size_t)count * (size_t)size);
    }
    CALL(kind->writeEnd, void, (void*))(access);
    CALL(kind->toVariant, void, (Variant*, const Pool*))(&made, &pool);
    CALL(kind->destroy, void, (Pool*))(&pool);
    return made;
}

static int32_t ToInt(const Variant* value)
{
    return (int32_t)CALL(AS_INT, int64_t, (const Variant*))(value);
}

static float ToFloat(const Variant* value)
{
    return (float)CALL(AS_REAL, double, (const Variant*))(value);
}

static void ToVector2(const Variant* value, float vector[2])
{
    Vector2 got = CALL(AS_VECTOR2, Vector2, (const Variant*))(value);
    memcpy(vector, &got, sizeof got);
}

static void ToVector3(const Variant* value, float vector[3])
{
    Vector3 got = CALL(AS_VECTOR3, Vector3, (const Variant*))(value);
    memcpy(vector, &got, sizeof got);
}

/* ---- Methods ---- */

typedef kiriWorld World;

/* A rectangle of paper that hangs in x and y: width, height, columns, rows, position. */
static Variant CreateRectangle(World* world, Variant** arguments)
{
    kiriSheetDef def;
    kiriSheet sheet;
    kiriDefaultSheetDef(&def);
    kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material);
    def.material.youngsModulus = 2e8f;
    def.frameCount = 9;
    def.touchesSheets = 1;
    def.contactThickness = 0.01f;
    def.axisV[1] = 1.0f;
    def.axisV[2] = 0.0f;
    ToVector3(arguments[4], def.position);
    kiriCreateRectangle(world, ToFloat(arguments[0]), ToFloat(arguments[1]), ToInt(arguments[2]), ToInt(arguments[3]),
                        &def, &sheet);
    return OfInt(sheet);
}

/* Sheet, rest point, target. */
static Variant CreatePin(World* world, Variant** arguments)
{
    kiriPinDef def;
    kiriPin pin;
    kiriDefaultPinDef(&def);
    ToVector2(arguments[1], def.restPoint);
    ToVector3(arguments[2], def.target);
    kiriCreatePin(world, (kiriSheet)ToInt(arguments[0]), &def, &pin);
    return OfInt(pin);
}

/* Position, radius. */
static Variant CreateBall(World* world, Variant** arguments)
{
    kiriObstacleDef def;
    kiriObstacle ball;
    kiriDefaultObstacleDef(&def);
    def.type = KIRI_OBSTACLE_SPHERE;
    ToVector3(arguments[0], def.position);
    def.radius = ToFloat(arguments[1]);
    kiriCreateObstacle(world, &def, &ball);
    return OfInt(ball);
}

/* A plane with y up, at a height. */
static Variant CreateFloor(World* world, Variant** arguments)
{
    static const float UP[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, -1.0f, 0.0f, 1.0f, 0.0f };
    kiriObstacleDef def;
    kiriObstacle plane;
    kiriDefaultObstacleDef(&def);
    def.position[1] = ToFloat(arguments[0]);
    memcpy(def.rotation, UP, sizeof UP);
    kiriCreateObstacle(world, &def, &plane);
    return OfInt(plane);
}

static Variant BeginBlade(World* world, Variant** arguments)
{
    kiriBlade blade;
    (void)arguments;
    kiriBeginBlade(world, 0, &blade);
    return OfInt(blade);
}

/* Blade, origin, direction, length. */
static Variant MoveRay(World* world, Variant** arguments)
{
    float origin[3], direction[3];
    ToVector3(arguments[1], origin);
    ToVector3(arguments[2], direction);
    return OfInt(kiriBlade_MoveRay(world, (kiriBlade)ToInt(arguments[0]), origin, direction, ToFloat(arguments[3])));
}

static Variant EndBlade(World* world, Variant** arguments)
{
    return OfInt(kiriBlade_End(world, (kiriBlade)ToInt(arguments[0])));
}

/* dt, substeps. Each piece that comes off gets a sheet of its own. */
static Variant Tick(World* world, Variant** arguments)
{
    const kiriEvent* events;
    int32_t count;
    kiriResult result = kiriWorld_Tick(world, ToFloat(arguments[0]), ToInt(arguments[1]));
    kiriWorld_GetEvents(world, &events, &count);
    for (int32_t i = 0; i < count; ++i) {
        kiriSheet detached;
        if (events[i].type == KIRI_EVENT_PIECE_OFF) {
            kiriFrame_DetachPiece(world, events[i].frame, &detached);
        }
    }
    return OfInt(result);
}

static Variant GetSheets(World* world, Variant** arguments)
{
    kiriSheet sheets[256];
    int32_t count;
    (void)arguments;
    kiriWorld_GetSheets(world, sheets, 256, &count);
    return OfRows(&INTS, sheets, count < 256 ? count : 256, sizeof *sheets);
}

static kiriMesh MeshOf(World* world, Variant** arguments)
{
    kiriMesh mesh = { 0 };
    kiriSheet_GetMesh(world, (kiriSheet)ToInt(arguments[0]), &mesh);
    return mesh;
}

static Variant GetRevision(World* world, Variant** arguments)
{
    return OfInt(MeshOf(world, arguments).revision);
}

static Variant GetPositions(World* world, Variant** arguments)
{
    kiriMesh mesh = MeshOf(world, arguments);
    return OfRows(&VECTORS3, mesh.positions, mesh.vertexCount, 12);
}

static Variant GetNormals(World* world, Variant** arguments)
{
    kiriMesh mesh = MeshOf(world, arguments);
    return OfRows(&VECTORS3, mesh.normals, mesh.vertexCount, 12);
}

static Variant GetRestPositions(World* world, Variant** arguments)
{
    kiriMesh mesh = MeshOf(world, arguments);
    return OfRows(&VECTORS2, mesh.restPositions, mesh.vertexCount, 8);
}

static Variant GetIndices(World* world, Variant** arguments)
{
    kiriMesh mesh = MeshOf(world, arguments);
    return OfRows(&INTS, mesh.indices, 3 * mesh.triangleCount, sizeof(int32_t));
}

static Variant GetStateHash(World* world, Variant** arguments)
{
    char text[17];
    uint64_t hash = 0;
    (void)arguments;
    kiriWorld_GetStateHash(world, &hash);
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return OfText(text);
}

static Variant GetLastError(World* world, Variant** arguments)
{
    (void)arguments;
    return OfText(kiriWorld_GetLastError(world));
}

typedef struct Named {
    const char* name;
    Variant (*method)(World* world, Variant** arguments);
    int count; /* of arguments */
} Named;

static const Named METHODS[] = {
    { "create_rectangle", CreateRectangle, 5 },
    { "create_pin", CreatePin, 3 },
    { "create_ball", CreateBall, 2 },
    { "create_floor", CreateFloor, 1 },
    { "begin_blade", BeginBlade, 0 },
    { "move_ray", MoveRay, 4 },
    { "end_blade", EndBlade, 1 },
    { "tick", Tick, 2 },
    { "get_sheets", GetSheets, 0 },
    { "get_revision", GetRevision, 1 },
    { "get_positions", GetPositions, 1 },
    { "get_normals", GetNormals, 1 },
    { "get_rest_positions", GetRestPositions, 1 },
    { "get_indices", GetIndices, 1 },
    { "get_state_hash", GetStateHash, 0 },
    { "get_last_error", GetLastError, 0 },
};

static Variant CallMethod(void* object, void* data, void* world, int count, Variant** arguments)
{
    const Named* named = data;
    (void)object;
    return world != NULL && count == named->count ? named->method(world, arguments) : OfNil();
}

/* ---- The class ---- */

static void* CreateWorld(void* object, void* data)
{
    kiriWorldDef def;
    kiriWorld* world;
    (void)object, (void)data;
    kiriDefaultWorldDef(&def);
    def.gravity[1] = -9.81f;
    def.gravity[2] = 0.0f;
    kiriCreateWorld(&def, &world);
    return world;
}

static void DestroyWorld(void* object, void* data, void* world)
{
    (void)object, (void)data;
    kiriDestroyWorld(world);
}

/* What Godot looks for in the library. */
KIRI_API void godot_gdnative_init(Options* options);
KIRI_API void godot_gdnative_terminate(void* options);
KIRI_API void godot_nativescript_init(void* library);

void godot_gdnative_init(Options* options)
{
    core = options->core;
}

void godot_gdnative_terminate(void* options)
{
    (void)options;
    core = NULL;
}

void godot_nativescript_init(void* library)
{
    for (unsigned i = 0; i < core->extensionCount; ++i) {
        const Extension* extension = core->extensions[i];
        if (extension->type != NATIVE_SCRIPT) {
            continue;
        }
        extension->registerClass(library, "KiriWorld", "Reference", (Create){ CreateWorld, NULL, NULL },
                                 (Destroy){ DestroyWorld, NULL, NULL });
        for (size_t k = 0; k < sizeof METHODS / sizeof *METHODS; ++k) {
            extension->registerMethod(library, "KiriWorld", METHODS[k].name, (Attributes){ 0 },
                                      (Method){ CallMethod, (void*)&METHODS[k], NULL });
        }
    }
}
