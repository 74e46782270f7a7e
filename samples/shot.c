#include "shot.h"

#include <math.h>
#include <string.h>

bool Shot_Create(Shot* shot, int32_t width, int32_t height)
{
    *shot = (Shot){ .painter = Painter_Create(width, height) };
    return shot->painter != NULL && Debug_Create(&shot->debug);
}

void Shot_Destroy(Shot* shot)
{
    if (shot->painter != NULL) {
        Painter_Destroy(shot->painter);
    }
    Debug_Destroy(&shot->debug);
    Sheets_Free(&shot->sheets);
    *shot = (Shot){ .painter = NULL };
}

/* Where the vertex is that lies nearest to a rest point. */
static const float* FindVertex(const kiriMesh* mesh, const float restPoint[2])
{
    int32_t best = 0;
    float bestDistance = INFINITY;
    for (int32_t i = 0; i < mesh->vertexCount; i++) {
        float u = mesh->restPositions[2 * i] - restPoint[0], v = mesh->restPositions[2 * i + 1] - restPoint[1];
        if (u * u + v * v < bestDistance) {
            bestDistance = u * u + v * v;
            best = i;
        }
    }
    return mesh->positions + 3 * best;
}

/* The camera stays where it is, looks at a rest point, and sees less. */
static void MoveCloser(View* view, const float closeUp[3])
{
    const float rest[2] = { view->size * closeUp[0], view->size * closeUp[1] };
    const float* at = FindVertex(&view->mesh, rest);
    for (int i = 0; i < 3; i++) {
        view->camera.target[i] = at[i] / view->size;
    }
    view->camera.fieldOfView /= closeUp[2];
}

static bool ShowDebug(View* view, Shot* shot, const Scene* scene, const Options* options)
{
    const Raster* raster = &shot->debug.raster;
    if (!Debug_Update(&shot->debug, scene, &view->mesh, &options->debug)) {
        return false;
    }
    view->raster = raster->colors;
    view->rasterSize = RASTER_SIZE;
    memcpy(view->rasterOrigin, raster->origin, sizeof view->rasterOrigin);
    view->rasterWidth = RASTER_SIZE * raster->side;
    return true;
}

/* To draw it is a mesh like another. */
static bool TakeSolid(View* view, const Scene* scene, float thickness)
{
    kiriSolid solid;
    if (kiriSheet_GetSolid(scene->world, scene->sheet, thickness, &solid) != KIRI_OK) {
        return false;
    }
    view->isSolid = true;
    view->mesh.positions = solid.positions;
    view->mesh.normals = solid.normals;
    view->mesh.restPositions = solid.restPositions;
    view->mesh.indices = solid.indices;
    view->mesh.vertexCount = solid.vertexCount;
    view->mesh.triangleCount = solid.triangleCount;
    return true;
}

static int32_t TakeBodies(const Scene* scene, CanvasBody bodies[SCENE_MAX_BODIES])
{
    const float* given = scene->type->bodies;
    const Color wood = { 0.80f, 0.70f, 0.58f, 1.0f }, own = { given[0], given[1], given[2], 1.0f };
    for (int32_t i = 0; i < scene->bodyCount; i++) {
        const kiriObstacleDef* def = &scene->bodies[i];
        kiriObstacleState state;
        bodies[i] = (CanvasBody){ .shape = def->type, .radius = def->radius, .height = def->height,
                                  .color = given[0] + given[1] + given[2] > 0.0f ? own : wood };
        kiriObstacle_GetState(scene->world, scene->bodyIds[i], &state);
        memcpy(bodies[i].size, def->size, sizeof bodies[i].size);
        memcpy(bodies[i].position, state.position, sizeof bodies[i].position);
        memcpy(bodies[i].rotation, state.rotation, sizeof bodies[i].rotation);
    }
    return scene->bodyCount;
}

bool Shot_Take(Shot* shot, const Scene* scene, const Options* options, Image* image)
{
    View view = { .camera = scene->type->camera,
                  .size = scene->type->size,
                  .look = scene->type->look,
                  .print = scene->type->print,
                  .pins = scene->targets[0],
                  .pinCount = scene->pinCount,
                  .pegs = scene->type->pegs };
    CanvasBody bodies[SCENE_MAX_BODIES];
    float restPoints[VIEW_MOST_BLADES][2], blades[VIEW_MOST_BLADES][3];
    if (Debug_IsWanted(&options->debug)) { /* a raster over the rest plane is of one sheet */
        kiriSheet_GetMesh(scene->world, scene->sheet, &view.mesh);
    } else if (Sheets_Take(&shot->sheets, scene->world, scene->second)) {
        view.mesh = shot->sheets.mesh;
    } else {
        return false;
    }
    if (scene->second != 0 && view.mesh.positions == shot->sheets.mesh.positions) {
        kiriSheet_GetMesh(scene->world, scene->second, &view.second);
        view.secondLook = scene->type->secondLook;
    }
    view.bodies = bodies;
    view.bodyCount = TakeBodies(scene, bodies);
    if (options->solid > 0 && !TakeSolid(&view, scene, 1e-3f * (float)options->solid)) {
        return false;
    }
    if (options->closeUp[2] > 0.0f) {
        MoveCloser(&view, options->closeUp);
    }
    if (Debug_IsWanted(&options->debug) && !ShowDebug(&view, shot, scene, options)) {
        return false;
    }
    if (!Debug_DrawLines(&shot->debug, scene, &options->debug)) {
        return false;
    }
    view.lines = shot->debug.lines;
    view.bladeCount = Scene_GetBlades(scene, restPoints, VIEW_MOST_BLADES);
    view.blades = blades[0];
    for (int32_t i = 0; i < view.bladeCount; i++) {
        memcpy(blades[i], FindVertex(&view.mesh, restPoints[i]), sizeof blades[i]);
    }
    return Painter_Paint(shot->painter, &view, image);
}
