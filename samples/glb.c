#include "glb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FLOATS = 5126, INDICES = 5125, NO_ACCESSOR = -1, FILE_HEADER = 12, CHUNK_HEADER = 8 };

static const char chunkJson[] = "JSON", chunkBinary[] = "BIN";

/* Numbers of one kind, in a buffer view of their own. */
typedef struct GlbAccessor {
    int64_t offset;
    int32_t count, width, type;
    float lower[3], upper[3];
} GlbAccessor;

typedef struct GlbPart {
    int32_t moment;
    kiriSheet sheet;
    uint32_t revision;
    int32_t positions, normals, restPositions, indices; /* accessors */
} GlbPart;

/* Room for more items. Null without memory. */
static void* Grow(void* items, int64_t needed, int64_t* room, size_t size)
{
    if (needed <= *room) {
        return items;
    }
    *room = 2 * needed;
    return realloc(items, (size_t)*room * size);
}

static void* Grow32(void* items, int32_t needed, int32_t* room, size_t size)
{
    int64_t wide = *room;
    void* grown = Grow(items, needed, &wide, size);
    *room = grown != NULL ? (int32_t)wide : *room;
    return grown;
}

/* Copies numbers of four bytes. The accessor, or NO_ACCESSOR without memory. */
static int32_t AddNumbers(Glb* glb, const void* numbers, int32_t count, int32_t width, int32_t type)
{
    int64_t size = (int64_t)4 * width * count, room = glb->byteRoom;
    uint8_t* bytes = Grow(glb->bytes, glb->byteCount + size, &room, 1);
    glb->bytes = bytes != NULL ? bytes : glb->bytes;
    glb->byteRoom = bytes != NULL ? room : glb->byteRoom;
    GlbAccessor* accessors = Grow32(glb->accessors, glb->accessorCount + 1, &glb->accessorRoom, sizeof(GlbAccessor));
    glb->accessors = accessors != NULL ? accessors : glb->accessors;
    if (bytes == NULL || accessors == NULL) {
        return NO_ACCESSOR;
    }
    GlbAccessor* accessor = &accessors[glb->accessorCount];
    *accessor = (GlbAccessor){ .offset = glb->byteCount, .count = count, .width = width, .type = type };
    for (int32_t i = 0; i < count * width && type == FLOATS; i++) {
        float value = ((const float*)numbers)[i];
        float *lower = &accessor->lower[i % width], *upper = &accessor->upper[i % width];
        *lower = i < width || value < *lower ? value : *lower;
        *upper = i < width || value > *upper ? value : *upper;
    }
    memcpy(bytes + glb->byteCount, numbers, (size_t)size);
    glb->byteCount += size;
    return glb->accessorCount++;
}

/* The sheet in the last moment that had it; null if there is none. */
static const GlbPart* FindBefore(const Glb* glb, kiriSheet sheet)
{
    int32_t at = glb->partCount - 1;
    while (at >= 0 && glb->parts[at].sheet != sheet) {
        at--;
    }
    return at >= 0 ? &glb->parts[at] : NULL;
}

/* Arrays that have not changed since the moment before are not written again. */
static bool AddSheet(Glb* glb, const kiriWorld* world, kiriSheet sheet)
{
    kiriMesh mesh;
    kiriSheet_GetMesh(world, sheet, &mesh);
    if (mesh.triangleCount == 0) {
        return true;
    }
    GlbPart* parts = Grow32(glb->parts, glb->partCount + 1, &glb->partRoom, sizeof(GlbPart));
    glb->parts = parts != NULL ? parts : glb->parts;
    const GlbPart* before = FindBefore(glb, sheet);
    GlbPart part = { glb->timeCount, sheet, mesh.revision, NO_ACCESSOR, NO_ACCESSOR, NO_ACCESSOR, NO_ACCESSOR };
    int32_t count = mesh.vertexCount;
    part.positions = AddNumbers(glb, mesh.positions, count, 3, FLOATS);
    part.normals = mesh.normals != NULL ? AddNumbers(glb, mesh.normals, count, 3, FLOATS) : NO_ACCESSOR;
    if (before != NULL && before->revision == mesh.revision) {
        part.restPositions = before->restPositions;
        part.indices = before->indices;
    } else {
        part.restPositions = AddNumbers(glb, mesh.restPositions, count, 2, FLOATS);
        part.indices = AddNumbers(glb, mesh.indices, 3 * mesh.triangleCount, 1, INDICES);
    }
    bool isFine = parts != NULL && part.positions >= 0 && part.restPositions >= 0 && part.indices >= 0 &&
                  (part.normals >= 0 || mesh.normals == NULL);
    if (isFine) {
        parts[glb->partCount++] = part;
    }
    return isFine;
}

bool Glb_Add(Glb* glb, const kiriWorld* world, float seconds)
{
    int32_t count = 0;
    kiriSheet first;
    kiriWorld_GetSheets(world, &first, 1, &count);
    kiriSheet* sheets = malloc(sizeof(kiriSheet) * ((size_t)count + 1));
    float* times = Grow32(glb->times, glb->timeCount + 1, &glb->timeRoom, sizeof(float));
    glb->times = times != NULL ? times : glb->times;
    bool isFine = sheets != NULL && times != NULL;
    if (isFine) {
        kiriWorld_GetSheets(world, sheets, count, &count);
    }
    for (int32_t i = 0; i < count && isFine; i++) {
        isFine = AddSheet(glb, world, sheets[i]);
    }
    if (isFine) {
        times[glb->timeCount++] = seconds;
    }
    free(sheets);
    return isFine;
}

static void WriteBounds(const char* name, const float* values, int32_t width, FILE* file)
{
    fprintf(file, ",\"%s\":[", name);
    for (int32_t i = 0; i < width; i++) {
        fprintf(file, "%s%.9g", i > 0 ? "," : "", (double)values[i]);
    }
    fprintf(file, "]");
}

static void WriteAccessors(const Glb* glb, FILE* file)
{
    static const char* const shapes[] = { "", "SCALAR", "VEC2", "VEC3" };
    fprintf(file, ",\n\"accessors\":[");
    for (int32_t i = 0; i < glb->accessorCount; i++) {
        const GlbAccessor* accessor = &glb->accessors[i];
        fprintf(file, "%s\n{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"", i > 0 ? "," : "", i,
                accessor->type, accessor->count, shapes[accessor->width]);
        if (accessor->type == FLOATS) {
            WriteBounds("min", accessor->lower, accessor->width, file);
            WriteBounds("max", accessor->upper, accessor->width, file);
        }
        fprintf(file, "}");
    }
    fprintf(file, "],\n\"bufferViews\":[");
    for (int32_t i = 0; i < glb->accessorCount; i++) {
        const GlbAccessor* accessor = &glb->accessors[i];
        fprintf(file, "%s\n{\"buffer\":0,\"byteOffset\":%lld,\"byteLength\":%lld}", i > 0 ? "," : "",
                (long long)accessor->offset, (long long)4 * accessor->width * accessor->count);
    }
    fprintf(file, "],\n\"buffers\":[{\"byteLength\":%lld}]", (long long)glb->byteCount);
}

static void WriteMeshes(const Glb* glb, FILE* file)
{
    fprintf(file, ",\n\"meshes\":[");
    for (int32_t i = 0; i < glb->partCount; i++) {
        const GlbPart* part = &glb->parts[i];
        bool isFirst = i == 0 || part[-1].moment != part->moment;
        bool isLast = i + 1 == glb->partCount || part[1].moment != part->moment;
        fprintf(file, "%s{\"attributes\":{\"POSITION\":%d,\"TEXCOORD_0\":%d",
                i == 0    ? "\n{\"primitives\":["
                : isFirst ? ",\n{\"primitives\":["
                          : ",",
                part->positions, part->restPositions);
        if (part->normals >= 0) {
            fprintf(file, ",\"NORMAL\":%d", part->normals);
        }
        fprintf(file, "},\"indices\":%d,\"material\":0}%s", part->indices, isLast ? "]}" : "");
    }
    fprintf(file, "]");
}

/* The first node turns z up to y up; each other one is a moment. */
static void WriteNodes(const Glb* glb, FILE* file)
{
    int32_t mesh = 0, part = 0;
    fprintf(file, ",\n\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\n\"nodes\":[{\"name\":\"Kiri\","
                  "\"rotation\":[-0.70710678,0,0,0.70710678],\"children\":[");
    for (int32_t i = 0; i < glb->timeCount; i++) {
        fprintf(file, "%s%d", i > 0 ? "," : "", i + 1);
    }
    fprintf(file, "]}");
    for (int32_t i = 0; i < glb->timeCount; i++) {
        fprintf(file, ",\n{\"name\":\"%.9g s\"", (double)glb->times[i]);
        if (part < glb->partCount && glb->parts[part].moment == i) {
            fprintf(file, ",\"mesh\":%d", mesh++);
        }
        while (part < glb->partCount && glb->parts[part].moment == i) {
            part++;
        }
        fprintf(file, "}");
    }
    fprintf(file, "]");
}

/* A moment is seen until the next one: its node has size 1 then, else 0. */
static bool AddKeys(Glb* glb, int32_t moment, int32_t* times, int32_t* sizes)
{
    bool isFirst = moment == 0, isLast = moment + 1 == glb->timeCount;
    float at[3] = { glb->times[0], glb->times[moment], isLast ? 0.0f : glb->times[moment + 1] };
    float scales[3][3] = { { 0.0f, 0.0f, 0.0f }, { 1.0f, 1.0f, 1.0f }, { 0.0f, 0.0f, 0.0f } };
    int32_t count = 3 - isFirst - isLast;
    *times = AddNumbers(glb, at + isFirst, count, 1, FLOATS);
    *sizes = AddNumbers(glb, scales[isFirst], count, 3, FLOATS);
    return *times >= 0 && *sizes >= 0;
}

static bool WriteAnimation(Glb* glb, FILE* file)
{
    bool isFine = true;
    fprintf(file, ",\n\"animations\":[{\"channels\":[");
    for (int32_t i = 0; i < glb->timeCount; i++) {
        fprintf(file, "%s\n{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"scale\"}}", i > 0 ? "," : "", i, i + 1);
    }
    fprintf(file, "],\n\"samplers\":[");
    for (int32_t i = 0; i < glb->timeCount && isFine; i++) {
        int32_t times, sizes;
        isFine = AddKeys(glb, i, &times, &sizes);
        fprintf(file, "%s\n{\"input\":%d,\"output\":%d,\"interpolation\":\"STEP\"}", i > 0 ? "," : "", times, sizes);
    }
    fprintf(file, "]}]");
    return isFine;
}

static void WriteWord(int64_t word, FILE* file)
{
    for (int i = 0; i < 4; i++) {
        fputc((int)(word >> 8 * i & 255), file);
    }
}

bool Glb_Write(Glb* glb, const float color[3], FILE* file)
{
    long start = ftell(file);
    for (int32_t i = 0; i < FILE_HEADER + CHUNK_HEADER; i++) {
        fputc(0, file); /* written below, when lengths are known */
    }
    fprintf(file, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Kiri\"}");
    fprintf(
        file,
        ",\n\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":");
    fprintf(file, "[%.4f,%.4f,%.4f,1]}}]", pow((double)color[0], 2.2), pow((double)color[1], 2.2),
            pow((double)color[2], 2.2));
    WriteNodes(glb, file);
    WriteMeshes(glb, file);
    bool isFine = glb->timeCount < 2 || WriteAnimation(glb, file);
    WriteAccessors(glb, file);
    fputc('}', file);
    long end = ftell(file);
    while ((end - start) % 4 != 0) {
        fputc(' ', file);
        end++;
    }
    int64_t json = end - start - FILE_HEADER - CHUNK_HEADER, all = end - start + CHUNK_HEADER + glb->byteCount;
    WriteWord(glb->byteCount, file);
    fwrite(chunkBinary, 1, 4, file);
    isFine =
        fwrite(glb->bytes, 1, (size_t)glb->byteCount, file) == (size_t)glb->byteCount && isFine && all <= UINT32_MAX;
    isFine = fseek(file, start, SEEK_SET) == 0 && isFine;
    fputs("glTF", file);
    WriteWord(2, file);
    WriteWord(all, file);
    WriteWord(json, file);
    fwrite(chunkJson, 1, 4, file);
    return fseek(file, 0, SEEK_END) == 0 && isFine && !ferror(file);
}

void Glb_Free(Glb* glb)
{
    free(glb->accessors);
    free(glb->parts);
    free(glb->times);
    free(glb->bytes);
    *glb = (Glb){ .accessors = NULL };
}
