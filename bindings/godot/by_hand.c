/* Methods that the tables do not make: worlds, what is drawn, and meshes as Godot takes them. */
#include "call.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Up is y in Godot. */
void FillWorldDef(void* def)
{
    HostDef* filled = def;
    memset(filled, 0, sizeof *filled);
    kiriDefaultWorldDef(&filled->def);
    filled->def.gravity[1] = filled->def.gravity[2];
    filled->def.gravity[2] = 0.0f;
}

/* What a script gave as the only argument, a struct; an error where it is not as it should be. */
static int ReadOnly(const Method* method, const Struct* of, Self* world, const Variant* const* arguments, int count,
                    void* data)
{
    Scratch scratch = { NULL, 0, 0 };
    char wrong[MOST_TEXT] = "";
    of->fill(data);
    int good = count == 0 || ReadStruct(arguments[0], of, world, &scratch, data, wrong);
    if (!good) {
        Fail(method, "argument 1 is not as it should be", wrong);
    }
    FreeScratch(&scratch);
    return good;
}

Variant CreateWorld(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    HostDef def;
    Self* made = NULL;
    (void)self;
    if (!ReadOnly(method, &WORLD_DEF, NULL, arguments, count, &def)) {
        return OfNil();
    }
    Variant world = MakeObject(CLASS_WORLD, &made);
    if (made != NULL && !Check(method, made, BeginWorld(made, &def))) {
        DropValue(&world);
        return OfNil();
    }
    return world;
}

/* Its objects stay, and know that their world is gone. */
Variant DestroyWorld(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    (void)method, (void)arguments, (void)count;
    kiriDestroyWorld(self->world);
    self->world = NULL;
    return OfNil();
}

Variant GetLastResult(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    (void)method, (void)arguments, (void)count;
    return OfInt(self->last);
}

Variant TakeRecording(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    (void)arguments, (void)count;
    if (self->recordingFailed) {
        Fail(method, "there was no memory for a part of the recording", NULL);
    }
    Variant bytes = OfRows(KIND_BYTES, self->recording.items, self->recording.count);
    self->recording.count = 0;
    self->recordingFailed = 0;
    return bytes;
}

/* ---- Debug draw ---- */

typedef struct Drawn {
    Bytes positions, colors;
    int failed;
} Drawn;

typedef struct Drawing {
    Drawn points, lines, triangles;
} Drawing;

static void Append(Drawn* drawn, Bytes* bytes, const float* numbers, int count)
{
    int64_t size = count * (int64_t)sizeof *numbers;
    if (bytes->count + size > bytes->capacity) {
        int64_t capacity = 2 * bytes->capacity + 4096;
        uint8_t* grown = realloc(bytes->items, (size_t)capacity);
        if (grown == NULL) {
            drawn->failed = 1;
            return;
        }
        bytes->items = grown;
        bytes->capacity = capacity;
    }
    memcpy(bytes->items + bytes->count, numbers, (size_t)size);
    bytes->count += size;
}

static void TakeVertices(Drawn* drawn, const kiriDrawVertex* vertices, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        float color[4];
        for (int k = 0; k < 4; ++k) {
            color[k] = (float)(vertices[i].color >> 8 * k & 255u) / 255.0f;
        }
        Append(drawn, &drawn->positions, vertices[i].position, 3);
        Append(drawn, &drawn->colors, color, 4);
    }
}

static void TakePoints(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    TakeVertices(&((Drawing*)user)->points, vertices, count);
}

static void TakeLines(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    TakeVertices(&((Drawing*)user)->lines, vertices, count);
}

static void TakeTriangles(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    TakeVertices(&((Drawing*)user)->triangles, vertices, count);
}

static void GiveDrawn(Variant* answer, const char* key, Drawn* drawn)
{
    Variant made = NewDictionary();
    SetKey(&made, "positions",
           OfRows(KIND_VECTORS3, drawn->positions.items, drawn->failed ? 0 : drawn->positions.count / 12));
    SetKey(&made, "colors", OfRows(KIND_COLORS, drawn->colors.items, drawn->failed ? 0 : drawn->colors.count / 16));
    SetKey(answer, key, made);
    free(drawn->positions.items);
    free(drawn->colors.items);
}

Variant DebugDraw(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    kiriDebugDraw draw;
    Drawing drawing;
    Variant answer = NewDictionary();
    memset(&drawing, 0, sizeof drawing);
    if (!ReadOnly(method, &DEBUG_DRAW, self, arguments, count, &draw)) {
        return answer;
    }
    draw.points = TakePoints;
    draw.lines = TakeLines;
    draw.triangles = TakeTriangles;
    draw.user = &drawing;
    self->line[0] = 0;
    int good = Check(method, self, kiriWorld_DebugDraw(self->world, &draw));
    if (good && drawing.points.failed + drawing.lines.failed + drawing.triangles.failed > 0) {
        Fail(method, "no memory for all that is drawn", NULL);
    }
    GiveDrawn(&answer, "points", &drawing.points);
    GiveDrawn(&answer, "lines", &drawing.lines);
    GiveDrawn(&answer, "triangles", &drawing.triangles);
    return answer;
}

/* ---- Meshes ---- */

static int MeshOf(const Method* method, Self* self, kiriMesh* mesh)
{
    memset(mesh, 0, sizeof *mesh);
    if (self->owner->world == NULL) {
        Fail(method, "its world is gone", NULL);
        return 0;
    }
    self->owner->line[0] = 0;
    return Check(method, self->owner, kiriSheet_GetMesh(self->owner->world, self->id, mesh));
}

Variant CopyVertices(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    kiriMesh mesh;
    int32_t range[2] = { 0, 0 };
    Variant answer = NewDictionary();
    (void)count;
    if (!ReadItem(arguments[0], TYPE_INT32, CLASS_NONE, NULL, &range[0]) ||
        !ReadItem(arguments[1], TYPE_INT32, CLASS_NONE, NULL, &range[1])) {
        Fail(method, "arguments are not whole numbers", NULL);
    } else if (MeshOf(method, self, &mesh)) {
        Scratch scratch = { NULL, 0, 0 };
        int64_t rows = range[1] > 0 && range[1] <= mesh.vertexCount ? range[1] : 0;
        void* positions = TakeScratch(&scratch, 12 * rows);
        void* normals = mesh.normals != NULL ? TakeScratch(&scratch, 12 * rows) : NULL;
        if (Check(
                method, self->owner,
                kiriSheet_CopyVertices(self->owner->world, self->id, range[0], range[1], positions, 12, normals, 12))) {
            SetKey(&answer, "positions", OfRows(KIND_VECTORS3, positions, rows));
            SetKey(&answer, "normals", OfRows(KIND_VECTORS3, normals, normals != NULL ? rows : 0));
        }
        FreeScratch(&scratch);
    }
    return answer;
}

Variant GetRevision(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    kiriMesh mesh;
    (void)arguments, (void)count;
    return OfInt(MeshOf(method, self, &mesh) ? mesh.revision : 0);
}

/* Triangles the way round that Godot has them: clockwise. */
static Variant TurnIndices(const int32_t* indices, int32_t triangleCount)
{
    int64_t count = 3 * (int64_t)triangleCount;
    int32_t* turned = malloc((size_t)count * sizeof *turned + 1);
    for (int64_t i = 0; turned != NULL && i < count; i += 3) {
        turned[i] = indices[i];
        turned[i + 1] = indices[i + 2];
        turned[i + 2] = indices[i + 1];
    }
    Variant made = OfRows(KIND_INTS, turned, turned != NULL ? count : 0);
    free(turned);
    return made;
}

static Variant SurfaceArrays(const float* positions, const float* normals, const float* uvs, int32_t vertexCount,
                             const int32_t* indices, int32_t triangleCount)
{
    enum { POSITIONS = 0, NORMALS = 1, UVS = 4 };
    Variant arrays = NewArray(SURFACE_ARRAYS);
    SetItem(&arrays, POSITIONS, OfRows(KIND_VECTORS3, positions, vertexCount));
    if (normals != NULL) {
        SetItem(&arrays, NORMALS, OfRows(KIND_VECTORS3, normals, vertexCount));
    }
    SetItem(&arrays, UVS, OfRows(KIND_VECTORS2, uvs, vertexCount));
    SetItem(&arrays, SURFACE_ARRAYS - 1, TurnIndices(indices, triangleCount));
    return arrays;
}

Variant GetSurfaceArrays(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    kiriMesh mesh;
    (void)arguments, (void)count;
    return MeshOf(method, self, &mesh) ? SurfaceArrays(mesh.positions, mesh.normals, mesh.restPositions,
                                                       mesh.vertexCount, mesh.indices, mesh.triangleCount)
                                       : NewArray(0);
}

Variant GetSolidArrays(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    kiriMesh mesh;
    kiriSolid solid;
    float thickness = 0.0f;
    (void)count;
    if (!ReadItem(arguments[0], TYPE_FLOAT, CLASS_NONE, NULL, &thickness)) {
        Fail(method, "the thickness is no number", NULL);
        return NewArray(0);
    }
    if (!MeshOf(method, self, &mesh) ||
        !Check(method, self->owner, kiriSheet_GetSolid(self->owner->world, self->id, thickness, &solid))) {
        return NewArray(0);
    }
    return SurfaceArrays(solid.positions, solid.normals, solid.restPositions, solid.vertexCount, solid.indices,
                         solid.triangleCount);
}

/* A unit vector in 4 bytes, as Godot 4 packs it: on an octahedron, unfolded to a square. */
static void PackNormal(const float normal[3], uint16_t packed[2])
{
    float sum = fabsf(normal[0]) + fabsf(normal[1]) + fabsf(normal[2]);
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    float x = normal[0] * scale, y = normal[1] * scale;
    if (normal[2] < 0.0f) {
        float folded = (1.0f - fabsf(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - fabsf(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded;
    }
    packed[0] = (uint16_t)((x * 0.5f + 0.5f) * 65535.0f);
    packed[1] = (uint16_t)((y * 0.5f + 0.5f) * 65535.0f);
}

Variant GetVertexBuffer(const Method* method, Self* self, const Variant* const* arguments, int count)
{
    kiriMesh mesh;
    (void)arguments, (void)count;
    if (!MeshOf(method, self, &mesh)) {
        return OfRows(KIND_BYTES, NULL, 0);
    }
    int64_t positions = 12 * (int64_t)mesh.vertexCount, size = positions + (mesh.normals != NULL ? positions / 3 : 0);
    uint8_t* bytes = malloc((size_t)size + 1);
    if (bytes == NULL) {
        Fail(method, "no memory for the buffer", NULL);
        return OfRows(KIND_BYTES, NULL, 0);
    }
    memcpy(bytes, mesh.positions, (size_t)positions);
    for (int32_t i = 0; mesh.normals != NULL && i < mesh.vertexCount; ++i) {
        PackNormal(mesh.normals + 3 * i, (uint16_t*)(void*)(bytes + positions + 4 * i));
    }
    Variant made = OfRows(KIND_BYTES, bytes, size);
    free(bytes);
    return made;
}
