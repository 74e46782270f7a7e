/* The public API: checks arguments, turns ids into pointers, and calls the floor below. The only file that does
   either. */
#include "kiri_material.h"
#include "../sheet/kiri_piece.h"
#include "kiri_quality.h"
#include "kiri_state_hash.h"
#include "kiri_world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The defs are stamped with their size, so that a def of another version, or a forgotten default, is found out. */
#define COOKIE(Type) (0x4b000000u | (uint32_t)sizeof(Type))

enum { LINE_BYTES = sizeof(((kiriWorld*)NULL)->error.line) };

/* Every function ends through here or with KIRI_OK. */
static kiriResult Fail(const kiriWorld* world, char* line, kiriResult result, const char* function, const char* why)
{
    snprintf(line, LINE_BYTES, "%s: %s (%s)", function, why, kiriGetResultName(result));
    if (world->log != NULL) {
        world->log(world->user, line);
    }
    return result;
}

#define FAIL(result, why) Fail(world, line, result, __func__, why)

#define CHECK(condition, why)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            return FAIL(KIRI_ERROR_ARGUMENT, why);                                                                     \
        }                                                                                                              \
    } while (0)

/* A function that changes the world keeps its line there; one that only reads gives it to the log alone, so that several
   threads may read. Without a world there is only the code. */
#define BEGIN(world)                                                                                                   \
    if ((world) == NULL) {                                                                                             \
        return KIRI_ERROR_ARGUMENT;                                                                                    \
    }                                                                                                                  \
    char* line = (world)->error.line;                                                                                  \
    line[0] = '\0'

#define READ(world)                                                                                                    \
    if ((world) == NULL) {                                                                                             \
        return KIRI_ERROR_ARGUMENT;                                                                                    \
    }                                                                                                                  \
    char line[LINE_BYTES]

#define FIND(pointer, Type, pool, id)                                                                                  \
    Type* pointer = Owner(&world->pool, id);                                                                           \
    do {                                                                                                               \
        if (pointer == NULL) {                                                                                         \
            return FAIL(KIRI_ERROR_ID, "no such " #Type " id");                                                        \
        }                                                                                                              \
    } while (0)

static void* Owner(const kiriPool* pool, uint32_t id)
{
    const kiriSlot* slot = kiriPool_Find(pool, id);
    return slot != NULL ? slot->owner : NULL;
}

static bool AreFinite(const float* values, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

static bool IsAbove(float value, float low)
{
    return isfinite(value) && value > low;
}
static bool IsAtLeast(float value, float low)
{
    return isfinite(value) && value >= low;
}
static bool IsWithin(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

static bool AreOrthonormal(const float* a, const float* b)
{
    if (!AreFinite(a, 3) || !AreFinite(b, 3)) {
        return false;
    }
    kiriVec3 u = kiriVec3_Load(a), v = kiriVec3_Load(b);
    return fabs(kiriVec3_Dot(u, u) - 1.0) < 1e-3 && fabs(kiriVec3_Dot(v, v) - 1.0) < 1e-3 &&
           fabs(kiriVec3_Dot(u, v)) < 1e-3;
}

/* ---- Names ---- */

int32_t kiriGetVersion(void)
{
    return 100;
}

const char* kiriGetResultName(kiriResult result)
{
    switch (result) {
    case KIRI_OK:
        return "KIRI_OK";
    case KIRI_PENDING:
        return "KIRI_PENDING";
    case KIRI_ERROR_ARGUMENT:
        return "KIRI_ERROR_ARGUMENT";
    case KIRI_ERROR_DEF:
        return "KIRI_ERROR_DEF";
    case KIRI_ERROR_ID:
        return "KIRI_ERROR_ID";
    case KIRI_ERROR_MESH:
        return "KIRI_ERROR_MESH";
    case KIRI_ERROR_STATE:
        return "KIRI_ERROR_STATE";
    case KIRI_ERROR_MEMORY:
        return "KIRI_ERROR_MEMORY";
    case KIRI_DIVERGED:
        return "KIRI_DIVERGED";
    default:
        return "unknown";
    }
}

const char* kiriGetStageName(int32_t stage)
{
    static const char* const names[KIRI_STAGE_COUNT] = { "cut",     "grid",      "regions", "shape",
                                                         "samples", "constants", "solve",   "skin" };
    return IsWithin(stage, 0, KIRI_STAGE_COUNT - 1) ? names[stage] : "";
}

/* ---- World ---- */

void kiriDefaultWorldDef(kiriWorldDef* def)
{
    if (def != NULL) {
        memset(def, 0, sizeof(*def));
        def->cookie = COOKIE(kiriWorldDef);
        def->gravity[2] = -9.81f;
    }
}

static bool IsBudget(const kiriBudget* budget)
{
    return (budget->triangles == 0 || budget->triangles >= KIRI_LEAST_TRIANGLES) && budget->cells >= 0 &&
           budget->samples >= 0 && budget->iterations >= 0;
}

static kiriResult CheckWorldDef(const kiriWorldDef* def)
{
    if (def->cookie != COOKIE(kiriWorldDef)) {
        return KIRI_ERROR_DEF;
    }
    bool hooksMatch = (def->alloc == NULL) == (def->free == NULL);
    return hooksMatch && IsBudget(&def->budget) && AreFinite(def->gravity, 3) ? KIRI_OK : KIRI_ERROR_ARGUMENT;
}

kiriResult kiriCreateWorld(const kiriWorldDef* def, kiriWorld** world)
{
    if (def == NULL || world == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *world = NULL;
    kiriResult result = CheckWorldDef(def);
    if (result != KIRI_OK) {
        return result;
    }
    kiriMemory memory = kiriMemory_Make(def->alloc, def->free, def->user);
    kiriWorld* made = memory.alloc(memory.user, sizeof(*made)); /* owns itself: no block of its memory */
    if (made == NULL) {
        return KIRI_ERROR_MEMORY;
    }
    memset(made, 0, sizeof(*made));
    made->memory = kiriMemory_Like(&memory);
    made->retired = kiriMemory_Like(&memory);
    made->log = def->log;
    made->clock = def->clock;
    made->user = def->user;
    made->gravity = kiriVec3_Load(def->gravity);
    made->budget = def->budget;
    made->stage = KIRI_NONE;
    kiriPool_Init(&made->sheetIds, KIRI_KIND_SHEET);
    kiriPool_Init(&made->cutIds, KIRI_KIND_CUT);
    kiriPool_Init(&made->frameIds, KIRI_KIND_FRAME);
    kiriPool_Init(&made->pinIds, KIRI_KIND_PIN);
    *world = made;
    return KIRI_OK;
}

void kiriDestroyWorld(kiriWorld* world)
{
    if (world == NULL) {
        return;
    }
    while (world->sheets.count > 0) {
        kiriWorld_RemoveSheet(world, world->sheets.data[world->sheets.count - 1]);
    }
    kiriMemory_FreeAll(&world->retired);
    kiriMemory_FreeAll(&world->memory);
    world->memory.free(world->memory.user, world);
}

kiriResult kiriWorld_Tick(kiriWorld* world, float dt, int32_t substeps)
{
    BEGIN(world);
    CHECK(IsAtLeast(dt, 1e-6f) && dt <= 10.0f, "dt is not within 1e-6 and 10 s");
    CHECK(IsWithin(substeps, 1, 64), "substeps is not within 1 and 64");
    kiriResult result = kiriWorld_Advance(world, dt, substeps);
    if (result == KIRI_ERROR_MEMORY) {
        return FAIL(result, "out of memory; nothing moved, and the cut points still wait");
    }
    return result == KIRI_DIVERGED ? FAIL(result, "a sheet could not be moved on and rests; see the events") : result;
}

const char* kiriWorld_GetLastError(const kiriWorld* world)
{
    return world != NULL ? world->error.line : "";
}

kiriResult kiriWorld_SetGravity(kiriWorld* world, const float gravity[3])
{
    BEGIN(world);
    CHECK(gravity != NULL && AreFinite(gravity, 3), "gravity is null or not finite");
    kiriVec3 before = world->gravity;
    world->gravity = kiriVec3_Load(gravity);
    for (int32_t i = 0; i < world->sheets.count && !kiriVec3_Equal(before, world->gravity); ++i) {
        kiriMotion_Wake(world->sheets.data[i]);
    }
    return KIRI_OK;
}

kiriResult kiriWorld_SetBudget(kiriWorld* world, const kiriBudget* budget)
{
    BEGIN(world);
    CHECK(budget != NULL && IsBudget(budget),
          "budget is null, or below 0, or its triangles below KIRI_LEAST_TRIANGLES");
    world->budget = *budget;
    return KIRI_OK;
}

/* So many times the items that took `seconds`. */
static int32_t ScaleItems(int32_t items, double times, int32_t least, int32_t was)
{
    double scaled = items * times;
    return items <= 0 ? was : scaled < least ? least : scaled < INT32_MAX ? (int32_t)scaled : INT32_MAX;
}

kiriResult kiriFitBudget(const kiriProfile* profile, float microseconds, kiriBudget* budget)
{
    if (profile == NULL || budget == NULL || !IsAbove(microseconds, 0.0f) || !IsBudget(budget)) {
        return KIRI_ERROR_ARGUMENT;
    }
    double seconds = 0.0;
    for (int i = 0; i < KIRI_STAGE_COUNT; ++i) {
        if (!(profile->seconds[i] >= 0.0)) {
            return KIRI_ERROR_ARGUMENT;
        }
        seconds += profile->seconds[i];
    }
    if (seconds > 0.0) {
        double times = 1e-6 * microseconds / seconds;
        budget->triangles = ScaleItems(profile->trianglesSplit, times, KIRI_LEAST_TRIANGLES, budget->triangles);
        budget->cells = ScaleItems(profile->cellsSettled, times, 1, budget->cells);
        budget->samples = ScaleItems(profile->samplesRefreshed, times, 1, budget->samples);
        budget->iterations = ScaleItems(profile->solverIterations, times, 1, budget->iterations);
    }
    return KIRI_OK;
}

kiriResult kiriWorld_GetStateHash(const kiriWorld* world, uint64_t* hash)
{
    READ(world);
    CHECK(hash != NULL, "hash is null");
    *hash = kiriSnapshot_Hash(world);
    return KIRI_OK;
}

kiriResult kiriWorld_GetEvents(const kiriWorld* world, const kiriEvent** events, int32_t* count)
{
    READ(world);
    CHECK(events != NULL && count != NULL, "events or count is null");
    *events = world->events.data;
    *count = world->events.count;
    return KIRI_OK;
}

kiriResult kiriWorld_GetProfile(const kiriWorld* world, kiriProfile* profile)
{
    READ(world);
    CHECK(profile != NULL, "profile is null");
    *profile = world->profile;
    return KIRI_OK;
}

/* ---- Sheet ---- */

void kiriDefaultSheetDef(kiriSheetDef* def)
{
    if (def == NULL) {
        return;
    }
    memset(def, 0, sizeof(*def));
    def->cookie = COOKIE(kiriSheetDef);
    def->axisU[0] = 1.0f;
    def->axisV[1] = 1.0f;
    def->material = *kiriMaterial_Preset(KIRI_MATERIAL_COTTON);
    def->gridResolution = 32;
    def->frameCount = 5;
    def->maxFrames = 256;
    def->rigidWeight = 0.95f;
    def->iterations = 2;
    def->integrationOrder = 1;
    def->sleepSpeed = 0.001f;
    def->fadeTime = 0.2f;
}

kiriResult kiriGetMaterial(int32_t preset, kiriMaterial* material)
{
    const kiriMaterial* found = kiriMaterial_Preset(preset);
    if (found == NULL || material == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *material = *found;
    return KIRI_OK;
}

kiriResult kiriGetQuality(int32_t preset, kiriQuality* quality)
{
    const kiriQuality* found = kiriQuality_Preset(preset);
    if (found == NULL || quality == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    *quality = *found;
    return KIRI_OK;
}

static const char* FaultOfMaterial(const kiriMaterial* m)
{
    if (!IsAbove(m->youngsModulus, 0.0f) || !IsAbove(m->thickness, 0.0f) || !IsAbove(m->density, 0.0f)) {
        return "Young's modulus, thickness or density is not above 0";
    }
    if (!IsAtLeast(m->poissonsRatio, 0.0f) || m->poissonsRatio >= 0.5f) {
        return "Poisson's ratio is not within 0 and 0.5";
    }
    return IsAtLeast(m->airDamping, 0.0f) && IsAtLeast(m->flexDamping, 0.0f) ? NULL : "a damping is below 0";
}

static const char* FaultOfPlacement(const kiriSheetDef* def)
{
    if (!AreFinite(def->position, 3) || !AreFinite(def->velocity, 3)) {
        return "position or velocity is not finite";
    }
    return AreOrthonormal(def->axisU, def->axisV) ? NULL : "axisU and axisV are not orthonormal";
}

static const char* FaultOfFrames(const kiriSheetDef* def)
{
    if (!IsWithin(def->frameCount, 0, 65536) || def->maxFrames < 1) {
        return "frameCount is not within 0 and 65536, or maxFrames below 1";
    }
    if (!IsAtLeast(def->frameLength, 0.0f) || (def->frameCount == 0 && def->framePoints != NULL)) {
        return "frameLength is below 0, or there are framePoints and no frameCount";
    }
    if (def->framePoints != NULL && !AreFinite(def->framePoints, 2 * def->frameCount)) {
        return "a frame point is not finite";
    }
    if (!IsAbove(def->rigidWeight, 0.0f) || !IsAtLeast(def->rigidArea, 0.0f) || !IsAtLeast(def->crumbArea, 0.0f)) {
        return "rigidWeight is not above 0, or rigidArea or crumbArea below 0";
    }
    return NULL;
}

static const char* FaultOfModel(const kiriSheetDef* def)
{
    if (!IsWithin(def->model, KIRI_MODEL_LINKS, KIRI_MODEL_POINTS) ||
        !IsWithin(def->skinning, KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH)) {
        return "model is not one of KIRI_MODEL, or skinning not one of KIRI_SKINNING";
    }
    if (!IsWithin(def->planar, 0, 1) || !IsWithin(def->fromScratch, 0, 1) || !IsWithin(def->popping, 0, 1)) {
        return "planar, fromScratch or popping is not 0 or 1";
    }
    return IsWithin(def->integrationPoints, 0, 1 << 20) && IsWithin(def->integrationOrder, 1, 2)
               ? NULL
               : "integrationPoints is not within 0 and 1048576, or integrationOrder not 1 or 2";
}

static const char* FaultOfSheet(const kiriSheetDef* def)
{
    const char* faults[] = { FaultOfMaterial(&def->material), FaultOfPlacement(def), FaultOfFrames(def),
                             FaultOfModel(def) };
    for (int i = 0; i < 4; ++i) {
        if (faults[i] != NULL) {
            return faults[i];
        }
    }
    if (!IsWithin(def->gridResolution, 1, 4096)) {
        return "gridResolution is not within 1 and 4096";
    }
    if (!IsAtLeast(def->snapDistance, 0.0f)) {
        return "snapDistance is below 0";
    }
    if (!IsAtLeast(def->sleepSpeed, 0.0f) || !IsAtLeast(def->fadeTime, 0.0f)) {
        return "sleepSpeed or fadeTime is below 0";
    }
    if (!IsWithin(def->collisionPoints, 0, 1 << 20) || !IsWithin(def->iterations, 1, 64)) {
        return "collisionPoints is not within 0 and 1048576, or iterations not within 1 and 64";
    }
    return NULL;
}

kiriResult kiriCreateSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* sheet)
{
    BEGIN(world);
    CHECK(def != NULL && sheet != NULL, "def or sheet is null");
    *sheet = 0;
    if (def->cookie != COOKIE(kiriSheetDef)) {
        return FAIL(KIRI_ERROR_DEF, "the def was not filled by kiriDefaultSheetDef");
    }
    const char* why = FaultOfSheet(def);
    CHECK(why == NULL, why);
    why = "out of memory";
    kiriResult result = kiriWorld_AddSheet(world, def, sheet, &why);
    return result == KIRI_OK ? result : FAIL(result, why);
}

kiriResult kiriDestroySheet(kiriWorld* world, kiriSheet sheet)
{
    BEGIN(world);
    FIND(data, kiriSheetData, sheetIds, sheet);
    kiriWorld_RemoveSheet(world, data);
    return KIRI_OK;
}

kiriResult kiriFillRectangle(float width, float height, int32_t columns, int32_t rows, float* restPositions,
                             int32_t* indices)
{
    if (!IsAbove(width, 0.0f) || !IsAbove(height, 0.0f) || !IsWithin(columns, 1, 4096) || !IsWithin(rows, 1, 4096) ||
        restPositions == NULL || indices == NULL) {
        return KIRI_ERROR_ARGUMENT;
    }
    for (int32_t j = 0; j <= rows; ++j) {
        for (int32_t i = 0; i <= columns; ++i) {
            *restPositions++ = (float)((double)width * i / columns);
            *restPositions++ = (float)((double)height * j / rows);
        }
    }
    for (int32_t j = 0; j < rows; ++j) {
        for (int32_t i = 0; i < columns; ++i) {
            /* Diagonals alternate, so that the mesh has no grain. */
            int32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 2, d = a + columns + 1;
            int32_t even[6] = { a, b, c, a, c, d }, odd[6] = { a, b, d, b, c, d };
            memcpy(indices, (i + j) % 2 == 0 ? even : odd, sizeof(even));
            indices += 6;
        }
    }
    return KIRI_OK;
}

kiriResult kiriSheet_GetMesh(const kiriWorld* world, kiriSheet sheet, kiriMesh* mesh)
{
    READ(world);
    CHECK(mesh != NULL, "mesh is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    const kiriSurface* surface = &data->surface;
    mesh->positions = surface->positions.data;
    mesh->normals = surface->normals.data;
    mesh->restPositions = surface->restPositions.data;
    mesh->indices = surface->indices.data;
    mesh->sourceTriangles = surface->sourceTriangles.data;
    mesh->sourceWeights = surface->sourceWeights.data;
    mesh->vertexCount = surface->vertexCount;
    mesh->triangleCount = surface->triangleCount;
    mesh->revision = surface->revision;
    return KIRI_OK;
}

kiriResult kiriSheet_GetDirty(const kiriWorld* world, kiriSheet sheet, uint32_t sinceRevision, kiriDirty* dirty)
{
    READ(world);
    CHECK(dirty != NULL, "dirty is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    kiriSurface_GetDirty(&data->surface, sinceRevision, dirty);
    return KIRI_OK;
}

static bool IsRange(int32_t first, int32_t count, int32_t all)
{
    return first >= 0 && count >= 0 && first <= all && count <= all - first;
}

kiriResult kiriSheet_CopyVertices(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                  void* positions, int32_t positionStride, void* normals, int32_t normalStride)
{
    READ(world);
    CHECK((positions == NULL || positionStride >= 12) && (normals == NULL || normalStride >= 12),
          "a stride is below 12 bytes");
    FIND(data, kiriSheetData, sheetIds, sheet);
    CHECK(IsRange(first, count, data->surface.vertexCount), "the sheet has no such vertices");
    kiriSurface_CopyVertices(&data->surface, first, count, positions, positionStride, normals, normalStride);
    return KIRI_OK;
}

kiriResult kiriSheet_CopyIndices16(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                   uint16_t* indices)
{
    READ(world);
    CHECK(count == 0 || indices != NULL, "indices is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    CHECK(IsRange(firstTriangle, count, data->surface.triangleCount), "the sheet has no such triangles");
    if (!kiriSurface_CopyIndices16(&data->surface, firstTriangle, count, indices)) {
        return FAIL(KIRI_ERROR_STATE, "16 bits are not enough for so many vertices");
    }
    return KIRI_OK;
}

kiriResult kiriSheet_GetCollisionPoints(const kiriWorld* world, kiriSheet sheet, const float** positions,
                                        int32_t* count)
{
    READ(world);
    CHECK(positions != NULL && count != NULL, "positions or count is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    *positions = data->pointPositions.data;
    *count = data->points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetCounts(const kiriWorld* world, kiriSheet sheet, kiriCounts* counts)
{
    READ(world);
    CHECK(counts != NULL, "counts is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    counts->vertices = data->mesh.vertices.count;
    counts->triangles = data->mesh.triangles.count;
    counts->cells = data->grid.cellCount;
    counts->frames = data->frames.count;
    counts->links = data->links.links.count;
    counts->pieces = data->layout.pieces.count;
    counts->collisionPoints = data->points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetTotals(const kiriWorld* world, kiriSheet sheet, kiriTotals* totals)
{
    READ(world);
    CHECK(totals != NULL, "totals is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    *totals = kiriMotion_Totals(data);
    return KIRI_OK;
}

kiriResult kiriSheet_IsAwake(const kiriWorld* world, kiriSheet sheet, int32_t* awake)
{
    READ(world);
    CHECK(awake != NULL, "awake is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    *awake = !data->asleep;
    return KIRI_OK;
}

kiriResult kiriSheet_Wake(kiriWorld* world, kiriSheet sheet)
{
    BEGIN(world);
    FIND(data, kiriSheetData, sheetIds, sheet);
    kiriMotion_Wake(data);
    return KIRI_OK;
}

kiriResult kiriSheet_Raycast(const kiriWorld* world, kiriSheet sheet, const float origin[3], const float direction[3],
                             float maxDistance, kiriHit* hit)
{
    READ(world);
    CHECK(origin != NULL && direction != NULL && hit != NULL, "origin, direction or hit is null");
    CHECK(AreFinite(origin, 3) && AreFinite(direction, 3) && IsAtLeast(maxDistance, 0.0f),
          "origin, direction or maxDistance is not finite, or maxDistance below 0");
    CHECK(direction[0] != 0.0f || direction[1] != 0.0f || direction[2] != 0.0f, "direction is zero");
    FIND(data, kiriSheetData, sheetIds, sheet);
    kiriView_Raycast(data, kiriVec3_Load(origin), kiriVec3_Normalize(kiriVec3_Load(direction)), maxDistance, hit);
    return KIRI_OK;
}

kiriResult kiriSheet_GetWeights(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriFrame* frames,
                                float* weights, float* gradients, int32_t capacity, int32_t* count)
{
    READ(world);
    CHECK(restPoint != NULL && AreFinite(restPoint, 2) && count != NULL, "restPoint or count is null, or not finite");
    CHECK(capacity == 0 || (capacity > 0 && frames != NULL && weights != NULL), "capacity without frames and weights");
    FIND(data, kiriSheetData, sheetIds, sheet);
    if (data->update.stage > 0 || data->update.needsRebuild) {
        return FAIL(KIRI_ERROR_STATE, "a cut is being worked on; ask again when its work is done");
    }
    kiriLatticePoint at;
    bool inRange = kiriSheet_ToLattice(data, restPoint, &at);
    int32_t cell = inRange ? kiriGrid_CellAt(&data->grid, &data->mesh, at) : KIRI_NONE;
    CHECK(cell != KIRI_NONE, "restPoint lies outside the material");
    kiriPointWeights found = { NULL, 0, 0 };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    if (!kiriShape_At(&data->shape, &scratch, &data->grid, &data->mesh, cell, kiriMesh_Local(&data->mesh, at),
                      &found)) {
        kiriMemory_FreeAll(&scratch);
        return FAIL(KIRI_ERROR_MEMORY, "out of memory");
    }
    for (int32_t i = 0; i < found.count && i < capacity; ++i) {
        frames[i] = data->frames.data[found.data[i].frame].id;
        weights[i] = (float)found.data[i].value;
        if (gradients != NULL) {
            gradients[2 * i] = (float)found.data[i].gradient.x;
            gradients[2 * i + 1] = (float)found.data[i].gradient.y;
        }
    }
    *count = found.count;
    kiriMemory_FreeAll(&scratch);
    return KIRI_OK;
}

/* ---- Piece ---- */

#define FIND_PIECE(data, piece)                                                                                        \
    do {                                                                                                               \
        CHECK(IsWithin(piece, 0, data->layout.pieces.count - 1), "the sheet has no such piece");                       \
        if (!kiriPieces_List(data)) {                                                                                  \
            return FAIL(KIRI_ERROR_MEMORY, "out of memory");                                                           \
        }                                                                                                              \
    } while (0)

kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state)
{
    BEGIN(world);
    CHECK(state != NULL, "state is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    FIND_PIECE(data, piece);
    *state = kiriPiece_State(data, piece);
    return KIRI_OK;
}

kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh)
{
    BEGIN(world);
    CHECK(mesh != NULL, "mesh is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    FIND_PIECE(data, piece);
    const kiriPieceLists* lists = &data->lists;
    kiriSpan vertices = kiriPiece_Span(&lists->vertices, piece), triangles = kiriPiece_Span(&lists->triangles, piece);
    kiriSpan points = kiriPiece_Span(&lists->points, piece);
    mesh->vertices = lists->vertices.items.data + vertices.first;
    mesh->triangles = lists->triangles.items.data + triangles.first;
    mesh->indices = lists->corners.data + 3 * (int64_t)triangles.first;
    mesh->collisionPoints = points.count > 0 ? lists->points.items.data + points.first : NULL;
    mesh->vertexCount = vertices.count;
    mesh->triangleCount = triangles.count;
    mesh->collisionPointCount = points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetPieceFrames(kiriWorld* world, kiriSheet sheet, int32_t piece, const kiriFrame** frames,
                                    int32_t* count)
{
    BEGIN(world);
    CHECK(frames != NULL && count != NULL, "frames or count is null");
    FIND(data, kiriSheetData, sheetIds, sheet);
    FIND_PIECE(data, piece);
    kiriSpan span = kiriPiece_Span(&data->lists.frames, piece);
    *frames = data->lists.ids.data + span.first;
    *count = span.count;
    return KIRI_OK;
}

kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece)
{
    READ(world);
    CHECK(piece != NULL, "piece is null");
    FIND(sheet, kiriSheetData, frameIds, frame);
    *piece = sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
    return KIRI_OK;
}

/* Why the sheet cannot be taken apart now, or null. */
static const char* FaultOfParting(const kiriSheetData* sheet)
{
    if (sheet->update.stage != KIRI_NONE || sheet->update.needsRebuild) {
        return "a cut is being worked on; ask again when its work is done";
    }
    return NULL;
}

#define CHECK_PARTING(data, piece)                                                                                     \
    do {                                                                                                               \
        const char* parting = FaultOfParting(data);                                                                    \
        if (parting != NULL) {                                                                                         \
            return FAIL(KIRI_ERROR_STATE, parting);                                                                    \
        }                                                                                                              \
        CHECK(IsWithin(piece, 0, data->layout.pieces.count - 1), "the sheet has no such piece");                       \
        if (data->layout.pieces.count == 1) {                                                                          \
            return FAIL(KIRI_ERROR_STATE, "the piece is all of the sheet");                                            \
        }                                                                                                              \
    } while (0)

kiriResult kiriSheet_DetachPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriSheet* detached)
{
    BEGIN(world);
    CHECK(detached != NULL, "detached is null");
    *detached = 0;
    FIND(data, kiriSheetData, sheetIds, sheet);
    CHECK_PARTING(data, piece);
    bool ok = kiriWorld_DetachPiece(world, data, piece, detached);
    return ok ? KIRI_OK : FAIL(KIRI_ERROR_MEMORY, "out of memory; nothing has changed");
}

kiriResult kiriSheet_DestroyPiece(kiriWorld* world, kiriSheet sheet, int32_t piece)
{
    BEGIN(world);
    FIND(data, kiriSheetData, sheetIds, sheet);
    CHECK_PARTING(data, piece);
    bool ok = kiriWorld_DropPiece(world, data, piece);
    return ok ? KIRI_OK : FAIL(KIRI_ERROR_MEMORY, "out of memory; nothing has changed");
}

kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count)
{
    BEGIN(world);
    CHECK(count != NULL && IsAtLeast(area, 0.0f), "count is null, or area not finite or below 0");
    FIND(data, kiriSheetData, sheetIds, sheet);
    const char* why = FaultOfParting(data);
    if (why != NULL) {
        return FAIL(KIRI_ERROR_STATE, why);
    }
    bool ok = kiriWorld_DropCrumbs(world, data, area, count);
    return ok ? KIRI_OK : FAIL(KIRI_ERROR_MEMORY, "out of memory; nothing has changed");
}

/* ---- Cut ---- */

static void Wait(const kiriWorld* world, kiriCutData* cut, kiriVec2 to, bool jump)
{
    kiriSheetData* sheet = cut->sheet;
    kiriQueuedPoint stroke = { cut, to, world->ticks, jump };
    cut->waiting += 1;
    sheet->queue.data[sheet->queue.count++] = stroke;
}

kiriResult kiriBeginCut(kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriCut* cut)
{
    BEGIN(world);
    CHECK(restPoint != NULL && AreFinite(restPoint, 2) && cut != NULL, "restPoint or cut is null, or not finite");
    *cut = 0;
    FIND(data, kiriSheetData, sheetIds, sheet);
    kiriCutData* made = NULL;
    if (kiriArray_Reserve(&world->memory, &data->queue, (int64_t)data->queue.count + 1)) {
        made = kiriWorld_AddCut(world, data);
    }
    if (made == NULL) {
        return FAIL(KIRI_ERROR_MEMORY, "out of memory");
    }
    Wait(world, made, kiriSheet_ToLocal(data, restPoint), true);
    *cut = made->id;
    return KIRI_OK;
}

kiriResult kiriCut_Extend(kiriWorld* world, kiriCut cut, const float* restPoints, int32_t count)
{
    BEGIN(world);
    CHECK(restPoints != NULL && IsWithin(count, 1, 1 << 24), "restPoints is null, or count not within 1 and 16777216");
    CHECK(AreFinite(restPoints, 2 * count), "a point is not finite");
    FIND(data, kiriCutData, cutIds, cut);
    kiriSheetData* sheet = data->sheet;
    if (data->ended) {
        return FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    if (!kiriArray_Reserve(&world->memory, &sheet->queue, (int64_t)sheet->queue.count + count)) {
        return FAIL(KIRI_ERROR_MEMORY, "out of memory");
    }
    for (int32_t i = 0; i < count; ++i) {
        Wait(world, data, kiriSheet_ToLocal(sheet, &restPoints[2 * i]), false);
    }
    return KIRI_OK;
}

kiriResult kiriCut_End(kiriWorld* world, kiriCut cut)
{
    BEGIN(world);
    FIND(data, kiriCutData, cutIds, cut);
    if (data->ended) {
        return FAIL(KIRI_ERROR_STATE, "the cut has been ended");
    }
    data->ended = true;
    return KIRI_OK;
}

kiriResult kiriSheet_Slice(kiriWorld* world, kiriSheet sheet, const float blade[12], kiriCut* cut)
{
    BEGIN(world);
    CHECK(blade != NULL && AreFinite(blade, 12) && cut != NULL, "blade or cut is null, or not finite");
    *cut = 0;
    FIND(data, kiriSheetData, sheetIds, sheet);
    const kiriVec3 quad[4] = { kiriVec3_Load(&blade[0]), kiriVec3_Load(&blade[3]), kiriVec3_Load(&blade[6]),
                               kiriVec3_Load(&blade[9]) };
    kiriRestPoints segments = { NULL, 0, 0 };
    kiriCutData* made = NULL;
    if (kiriView_Slice(data, quad, &segments) &&
        kiriArray_Reserve(&world->memory, &data->queue, (int64_t)data->queue.count + segments.count)) {
        made = kiriWorld_AddCut(world, data);
    }
    for (int32_t i = 0; made != NULL && i < segments.count; ++i) {
        Wait(world, made, segments.data[i], i % 2 == 0);
    }
    kiriArray_Release(&world->memory, &segments);
    if (made == NULL) {
        return FAIL(KIRI_ERROR_MEMORY, "out of memory");
    }
    made->ended = true;
    *cut = made->id;
    return KIRI_OK;
}

/* ---- Frame ---- */

static kiriFrameData* FindFrame(const kiriWorld* world, kiriFrame frame)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
    return slot != NULL ? &((kiriSheetData*)slot->owner)->frames.data[slot->index] : NULL;
}

kiriResult kiriSheet_GetFrames(const kiriWorld* world, kiriSheet sheet, kiriFrame* frames, int32_t capacity,
                               int32_t* count)
{
    READ(world);
    CHECK(count != NULL && (capacity == 0 || (capacity > 0 && frames != NULL)), "count is null, or frames is");
    FIND(data, kiriSheetData, sheetIds, sheet);
    for (int32_t i = 0; i < data->frames.count && i < capacity; ++i) {
        frames[i] = data->frames.data[i].id;
    }
    *count = data->frames.count;
    return KIRI_OK;
}

kiriResult kiriFrame_GetState(const kiriWorld* world, kiriFrame frame, kiriFrameState* state)
{
    READ(world);
    CHECK(state != NULL, "state is null");
    const kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return FAIL(KIRI_ERROR_ID, "no such frame id");
    }
    const kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frame)->owner;
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, data->site.at);
    kiriVec3 x = kiriFrame_Carry(data, data->site.at);
    state->restPoint[0] = (float)rest.x;
    state->restPoint[1] = (float)rest.y;
    kiriVec3_Store(state->position, x);
    kiriVec3_Store(&state->rotation[0], data->A.u);
    kiriVec3_Store(&state->rotation[3], data->A.v);
    kiriVec3_Store(&state->rotation[6], data->A.d);
    kiriVec3_Store(state->velocity, kiriFrame_VelocityAt(data, data->site.at));
    kiriVec3_Store(state->angularVelocity, data->spin);
    state->area = (float)data->area;
    state->mass = (float)data->mass;
    state->held = data->held;
    return KIRI_OK;
}

kiriResult kiriFrame_Hold(kiriWorld* world, kiriFrame frame, const float position[3], const float rotation[9])
{
    BEGIN(world);
    CHECK((position == NULL) == (rotation == NULL), "only one of position and rotation is null");
    kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return FAIL(KIRI_ERROR_ID, "no such frame id");
    }
    kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frame)->owner;
    if (position == NULL) {
        if (data->held) {
            kiriMotion_Wake(sheet);
        }
        data->held = 0;
        return KIRI_OK;
    }
    CHECK(AreFinite(position, 3), "position is not finite");
    CHECK(AreOrthonormal(&rotation[0], &rotation[3]) && AreOrthonormal(&rotation[3], &rotation[6]) &&
              AreOrthonormal(&rotation[6], &rotation[0]),
          "rotation is not orthonormal");
    kiriMat3 m = { kiriVec3_Load(&rotation[0]), kiriVec3_Load(&rotation[3]), kiriVec3_Load(&rotation[6]) };
    CHECK(kiriVec3_Dot(kiriVec3_Cross(m.u, m.v), m.d) > 0.0, "rotation mirrors");
    CHECK(!sheet->mechanics.planar || kiriVec3_Dot(m.d, sheet->mechanics.axes.d) > 0.999999,
          "rotation turns a planar sheet out of its plane");
    kiriFrameData before = *data;
    data->held = 1;
    data->heldPosition = kiriVec3_Load(position);
    data->heldRotation = kiriMat3_Rotation(m);
    if (!before.held || !kiriVec3_Equal(before.heldPosition, data->heldPosition) ||
        !kiriVec3_Equal(before.heldRotation.u, data->heldRotation.u) ||
        !kiriVec3_Equal(before.heldRotation.v, data->heldRotation.v)) {
        kiriMotion_Wake(sheet);
    }
    return KIRI_OK;
}

kiriResult kiriFrame_ApplyForce(kiriWorld* world, kiriFrame frame, const float force[3], const float torque[3])
{
    BEGIN(world);
    CHECK(force != NULL && torque != NULL && AreFinite(force, 3) && AreFinite(torque, 3),
          "force or torque is null or not finite");
    kiriFrameData* data = FindFrame(world, frame);
    if (data == NULL) {
        return FAIL(KIRI_ERROR_ID, "no such frame id");
    }
    kiriVec3 none = { 0.0, 0.0, 0.0 };
    data->force = kiriVec3_Add(data->force, kiriVec3_Load(force));
    data->torque = kiriVec3_Add(data->torque, kiriVec3_Load(torque));
    if (!kiriVec3_Equal(kiriVec3_Load(force), none) || !kiriVec3_Equal(kiriVec3_Load(torque), none)) {
        kiriMotion_Wake(kiriPool_Find(&world->frameIds, frame)->owner);
    }
    return KIRI_OK;
}

/* ---- Pin and contact ---- */

void kiriDefaultPinDef(kiriPinDef* def)
{
    if (def != NULL) {
        memset(def, 0, sizeof(*def));
        def->cookie = COOKIE(kiriPinDef);
    }
}

kiriResult kiriCreatePin(kiriWorld* world, kiriSheet sheet, const kiriPinDef* def, kiriPin* pin)
{
    BEGIN(world);
    CHECK(def != NULL && pin != NULL, "def or pin is null");
    *pin = 0;
    if (def->cookie != COOKIE(kiriPinDef)) {
        return FAIL(KIRI_ERROR_DEF, "the def was not filled by kiriDefaultPinDef");
    }
    CHECK(AreFinite(def->restPoint, 2) && AreFinite(def->target, 3) && IsAtLeast(def->stiffness, 0.0f),
          "restPoint, target or stiffness is not finite, or stiffness below 0");
    FIND(data, kiriSheetData, sheetIds, sheet);
    kiriPinData made;
    memset(&made, 0, sizeof(made));
    bool inRange = kiriSheet_ToLattice(data, def->restPoint, &made.at);
    int32_t frame = inRange ? kiriSheet_FrameAt(data, made.at) : KIRI_NONE;
    CHECK(frame != KIRI_NONE, "restPoint lies outside the material");
    made.target = kiriVec3_Load(def->target);
    made.stiffness =
        def->stiffness > 0.0f ? def->stiffness : 10.0 * data->material.youngsModulus * data->material.thickness;
    if (!kiriPool_Reserve(&world->pinIds, &world->memory, 1) || !kiriSheet_AddPin(data, &made, frame)) {
        return FAIL(KIRI_ERROR_MEMORY, "out of memory");
    }
    *pin = kiriPool_Add(&world->pinIds, &world->memory, data, data->pins.count - 1);
    data->pins.data[data->pins.count - 1].id = *pin;
    kiriMotion_Wake(data);
    return KIRI_OK;
}

kiriResult kiriPin_SetTarget(kiriWorld* world, kiriPin pin, const float target[3])
{
    BEGIN(world);
    CHECK(target != NULL && AreFinite(target, 3), "target is null or not finite");
    FIND(sheet, kiriSheetData, pinIds, pin);
    kiriPinData* data = &sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index];
    if (!kiriVec3_Equal(data->target, kiriVec3_Load(target))) {
        data->target = kiriVec3_Load(target);
        kiriMotion_Wake(sheet);
    }
    return KIRI_OK;
}

kiriResult kiriDestroyPin(kiriWorld* world, kiriPin pin)
{
    BEGIN(world);
    FIND(sheet, kiriSheetData, pinIds, pin);
    int32_t index = kiriPool_Find(&world->pinIds, pin)->index;
    kiriSheet_RemovePin(sheet, index);
    kiriMotion_Wake(sheet);
    if (index < sheet->pins.count) {
        kiriPool_Find(&world->pinIds, sheet->pins.data[index].id)->index = index;
    }
    kiriPool_Remove(&world->pinIds, pin);
    return KIRI_OK;
}

static const char* FaultOfContact(const kiriContact* contact, int32_t points)
{
    if (!IsWithin(contact->point, 0, points - 1)) {
        return "a contact names no collision point";
    }
    if (!AreFinite(contact->normal, 3) || fabs(kiriVec3_Length(kiriVec3_Load(contact->normal)) - 1.0) > 1e-3) {
        return "the normal of a contact is not a unit vector";
    }
    return isfinite(contact->offset) && IsAtLeast(contact->friction, 0.0f) && IsAbove(contact->stiffness, 0.0f)
               ? NULL
               : "offset, friction or stiffness of a contact is out of range";
}

kiriResult kiriSheet_SetContacts(kiriWorld* world, kiriSheet sheet, const kiriContact* contacts, int32_t count)
{
    BEGIN(world);
    CHECK(count == 0 || (count > 0 && contacts != NULL), "contacts is null, or count below 0");
    FIND(data, kiriSheetData, sheetIds, sheet);
    for (int32_t i = 0; i < count; ++i) {
        const char* why = FaultOfContact(&contacts[i], data->points.count);
        CHECK(why == NULL, why);
    }
    if (!kiriArray_Reserve(&world->memory, &data->contacts, count) ||
        !kiriArray_Reserve(&world->memory, &data->lastContacts, count) ||
        !kiriArray_Reserve(&world->memory, &data->contactRows, count)) {
        return FAIL(KIRI_ERROR_MEMORY, "out of memory");
    }
    if (count > 0) {
        memcpy(data->contacts.data, contacts, sizeof(*contacts) * (size_t)count);
    }
    data->contacts.count = count;
    return KIRI_OK;
}
