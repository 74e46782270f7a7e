#include "picture.h"

#undef kiriCreateObstacle
#undef kiriWorld_Tick
#undef kiriDestroyWorld

#include "../draw.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TICKS = 4, MOST_SHEETS = 16, MOST_PINS = 64, MOST_BODIES = 64, GAP = 4 };

typedef struct Album {
    char path[512];
    int ticks[MOST_TICKS], count; /* when it takes a picture */
    float floor;
    Camera camera;
    uint32_t flags;
    int tick, taken;
    Painter* painter;
    Image all, one;
    CanvasBody bodies[MOST_BODIES];
    kiriObstacle obstacles[MOST_BODIES];
    int32_t bodyCount;
} Album;

static Album album;

static void Stop(const char* why)
{
    fprintf(stderr, "picture: %s\n", why);
    exit(1);
}

/* ---- What is wanted --------------------------------------------------------------------------------------------- */

static void ReadFlags(const char* words)
{
    static const struct {
        const char* name;
        uint32_t flag;
    } flags[] = { { "blades", KIRI_DRAW_BLADES }, { "frames", KIRI_DRAW_FRAMES }, { "links", KIRI_DRAW_LINKS } };
    for (int i = 0; i < 3; i++) {
        album.flags |= strstr(words, flags[i].name) != NULL ? flags[i].flag : 0;
    }
}

static void ReadPart(const char* part)
{
    float* eye = album.camera.eye;
    float* target = album.camera.target;
    int* ticks = album.ticks;
    if (sscanf(part, " ticks %d %d %d %d", ticks, ticks + 1, ticks + 2, ticks + 3) > 0) {
        while (album.count < MOST_TICKS && ticks[album.count] > 0) {
            album.count++;
        }
    } else if (strncmp(part, " draw ", 6) == 0) {
        ReadFlags(part);
    } else if (sscanf(part, " eye %f %f %f", eye, eye + 1, eye + 2) != 3 &&
               sscanf(part, " target %f %f %f", target, target + 1, target + 2) != 3 &&
               sscanf(part, " floor %f", &album.floor) != 1 &&
               sscanf(part, " view %f", &album.camera.fieldOfView) != 1) {
        Stop(part);
    }
}

static void Open(void)
{
    char words[1024];
    const char* given = getenv("KIRI_PICTURE");
    if (given == NULL || strlen(given) >= sizeof words) {
        Stop("KIRI_PICTURE is not set");
    }
    strcpy(words, given);
    strcpy(album.path, strtok(words, ";"));
    for (char* part = strtok(NULL, ";"); part != NULL; part = strtok(NULL, ";")) {
        ReadPart(part);
    }
    album.camera.eye[2] -= album.floor;
    album.camera.target[2] -= album.floor;
    int32_t width = album.count > 1 ? 400 : 720, height = album.count > 1 ? 360 : 440;
    album.painter = Painter_Create(width, height);
    if (album.count == 0 || album.painter == NULL || !Image_Create(&album.one, width, height) ||
        !Image_Create(&album.all, album.count * (width + GAP) - GAP, height)) {
        Stop("no ticks, or no memory");
    }
    memset(album.all.rgb, 255, 3 * (size_t)album.all.width * (size_t)height);
}

/* ---- What is there ---------------------------------------------------------------------------------------------- */

static void* Grow(void* block, int64_t count, size_t size)
{
    void* grown = realloc(block, (size_t)count * size + 1);
    if (grown == NULL) {
        Stop("no memory");
    }
    return grown;
}

/* All sheets as one mesh, the floor at 0. Its arrays stay for the next picture. */
static void AddMesh(kiriMesh* all, const kiriMesh* mesh, int32_t sheet)
{
    static float *positions, *normals, *rest;
    static int32_t* indices;
    int32_t first = all->vertexCount, firstIndex = 3 * all->triangleCount;
    all->vertexCount += mesh->vertexCount;
    all->triangleCount += mesh->triangleCount;
    positions = Grow(positions, 3 * (int64_t)all->vertexCount, sizeof(float));
    normals = Grow(normals, 3 * (int64_t)all->vertexCount, sizeof(float));
    rest = Grow(rest, 2 * (int64_t)all->vertexCount, sizeof(float));
    indices = Grow(indices, 3 * (int64_t)all->triangleCount, sizeof(int32_t));
    memcpy(positions + 3 * first, mesh->positions, 3 * sizeof(float) * (size_t)mesh->vertexCount);
    memcpy(normals + 3 * first, mesh->normals, 3 * sizeof(float) * (size_t)mesh->vertexCount);
    memcpy(rest + 2 * first, mesh->restPositions, 2 * sizeof(float) * (size_t)mesh->vertexCount);
    for (int32_t i = first; i < all->vertexCount; i++) {
        positions[3 * i + 2] -= album.floor;
        rest[2 * i] += (float)(16 * sheet); /* no edge has its twin in another sheet */
    }
    for (int32_t i = 0; i < 3 * mesh->triangleCount; i++) {
        indices[firstIndex + i] = first + mesh->indices[i];
    }
    all->positions = positions;
    all->normals = normals;
    all->restPositions = rest;
    all->indices = indices;
}

static void AddPins(View* view, const kiriWorld* world, kiriSheet sheet)
{
    static float targets[MOST_PINS][3];
    kiriPin pins[MOST_PINS];
    kiriPinState pin;
    int32_t count = 0;
    kiriSheet_GetPins(world, sheet, pins, MOST_PINS, &count);
    for (int32_t i = 0; i < count && view->pinCount < MOST_PINS; i++) {
        kiriPin_GetState(world, pins[i], &pin);
        if (pin.type == KIRI_PIN_POINT) {
            memcpy(targets[view->pinCount], pin.target, sizeof pin.target);
            targets[view->pinCount++][2] -= album.floor;
        }
    }
    view->pins = targets[0];
}

static void AddBodies(View* view, const kiriWorld* world)
{
    static CanvasBody bodies[MOST_BODIES];
    for (int32_t i = 0; i < album.bodyCount; i++) {
        CanvasBody* body = &bodies[view->bodyCount];
        kiriObstacleState state;
        if (kiriObstacle_GetState(world, album.obstacles[i], &state) == KIRI_OK) {
            *body = album.bodies[i];
            memcpy(body->position, state.position, sizeof body->position);
            memcpy(body->rotation, state.rotation, sizeof body->rotation);
            body->position[2] -= album.floor;
            view->bodyCount++;
        }
    }
    view->bodies = bodies;
}

static void AddLines(View* view, const kiriWorld* world)
{
    static Lines lines;
    Lines_Clear(&lines);
    if (!Lines_Add(&lines, world, 0, album.flags, 0.012f, LINES_POINTS | LINES_LINES)) {
        Stop("no lines");
    }
    for (int32_t i = 0; i < lines.points.count; i++) {
        lines.points.data[i].position[2] -= album.floor;
    }
    for (int32_t i = 0; i < lines.lines.count; i++) {
        lines.lines.data[i].position[2] -= album.floor;
    }
    view->lines = lines;
    view->hidesLines = (album.flags & KIRI_DRAW_LINKS) == 0;
}

static void TakePicture(kiriWorld* world)
{
    kiriSheet sheets[MOST_SHEETS];
    kiriMesh mesh;
    int32_t count = 0;
    View view = { .camera = album.camera,
                  .look = { { 0.93f, 0.62f, 0.36f }, { 0.36f, 0.52f, 0.66f }, { 0.75f, 0.16f, 0.13f }, 8.0f } };
    kiriWorld_GetSheets(world, sheets, MOST_SHEETS, &count);
    for (int32_t i = 0; i < count && i < MOST_SHEETS; i++) {
        kiriSheet_GetMesh(world, sheets[i], &mesh);
        AddMesh(&view.mesh, &mesh, i);
        AddPins(&view, world, sheets[i]);
    }
    AddBodies(&view, world);
    AddLines(&view, world);
    if (!Painter_Paint(album.painter, &view, &album.one)) {
        Stop("no memory");
    }
    Image_Paste(&album.all, &album.one, album.taken++ * (album.one.width + GAP), 0);
}

/* ---- In place of the library's calls ----------------------------------------------------------------------------- */

kiriResult Picture_CreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle)
{
    kiriResult result = kiriCreateObstacle(world, def, obstacle);
    bool isDrawn = def->type != KIRI_OBSTACLE_PLANE && def->type != KIRI_OBSTACLE_PRISM;
    if (result == KIRI_OK && isDrawn && album.bodyCount < MOST_BODIES) {
        CanvasBody body = { .shape = def->type,
                            .radius = def->radius,
                            .height = def->height,
                            .color = { 0.80f, 0.70f, 0.58f, 1.0f } };
        memcpy(body.size, def->size, sizeof body.size);
        album.obstacles[album.bodyCount] = *obstacle;
        album.bodies[album.bodyCount++] = body;
    }
    return result;
}

kiriResult Picture_Tick(kiriWorld* world, float dt, int32_t substeps)
{
    if (album.painter == NULL) {
        Open();
    }
    kiriResult result = kiriWorld_Tick(world, dt, substeps);
    album.tick++;
    if (album.taken < album.count && album.tick == album.ticks[album.taken]) {
        TakePicture(world);
    }
    return result;
}

void Picture_Destroy(kiriWorld* world)
{
    if (album.painter == NULL || album.taken < album.count || !Image_WritePng(&album.all, album.path)) {
        Stop("a tick did not come, or the file cannot be written");
    }
    Painter_Destroy(album.painter);
    Image_Free(&album.all);
    Image_Free(&album.one);
    kiriDestroyWorld(world);
}
