#include "track.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void Track_Init(Track* track, kiriSheet sheet)
{
    memset(track, 0, sizeof *track);
    track->sheet = sheet;
}

void Track_Free(Track* track)
{
    free(track->before);
    free(track->restBefore);
    free(track->between);
    EdgeLines_Free(&track->edges);
    Track_Init(track, 0);
}

static bool Reserve(float** numbers, int32_t count)
{
    float* grown = realloc(*numbers, sizeof(float) * (size_t)count);
    *numbers = grown != NULL ? grown : *numbers;
    return grown != NULL;
}

bool Track_BeforeTick(Track* track, const kiriWorld* world)
{
    kiriMesh mesh;
    track->beforeCount = 0;
    if (kiriSheet_GetMesh(world, track->sheet, &mesh) != KIRI_OK) {
        return true; /* it is gone, and will not be drawn */
    }
    if (mesh.vertexCount > track->beforeCapacity) {
        int32_t capacity = mesh.vertexCount + mesh.vertexCount / 2;
        if (!Reserve(&track->before, 3 * capacity) || !Reserve(&track->restBefore, 2 * capacity)) {
            return false;
        }
        track->beforeCapacity = capacity;
    }
    memcpy(track->before, mesh.positions, 3 * sizeof(float) * (size_t)mesh.vertexCount);
    memcpy(track->restBefore, mesh.restPositions, 2 * sizeof(float) * (size_t)mesh.vertexCount);
    track->beforeCount = mesh.vertexCount;
    return true;
}

/* The same place of the rest plane: the same vertex, unless indices moved, and then one of the other lip at worst. */
static bool WasThere(const Track* track, const kiriMesh* mesh, int32_t vertex)
{
    return vertex < track->beforeCount && track->restBefore[2 * vertex] == mesh->restPositions[2 * vertex] &&
           track->restBefore[2 * vertex + 1] == mesh->restPositions[2 * vertex + 1];
}

bool Track_Get(Track* track, const kiriWorld* world, float alpha, CanvasSheet* sheet)
{
    kiriMesh mesh;
    if (kiriSheet_GetMesh(world, track->sheet, &mesh) != KIRI_OK) {
        return false;
    }
    if (track->edges.lips == NULL || track->revision != mesh.revision) {
        if (!EdgeLines_Find(&track->edges, &mesh)) {
            return false;
        }
        track->revision = mesh.revision;
    }
    if (mesh.vertexCount > track->betweenCapacity) {
        if (!Reserve(&track->between, 3 * (mesh.vertexCount + mesh.vertexCount / 2))) {
            return false;
        }
        track->betweenCapacity = mesh.vertexCount + mesh.vertexCount / 2;
    }
    for (int32_t i = 0; i < mesh.vertexCount; i++) {
        float share = WasThere(track, &mesh, i) ? alpha : 1.0f;
        for (int32_t k = 3 * i; k < 3 * i + 3; k++) {
            track->between[k] =
                share < 1.0f ? track->before[k] + share * (mesh.positions[k] - track->before[k]) : mesh.positions[k];
        }
    }
    sheet->positions = track->between;
    sheet->normals = mesh.normals;
    sheet->restPositions = mesh.restPositions;
    sheet->indices = mesh.indices;
    sheet->triangleCount = mesh.triangleCount;
    sheet->edges = track->edges;
    return true;
}

/* Columns made orthonormal again. */
static void Straighten(float rotation[9])
{
    for (int c = 0; c < 2; c++) {
        float* column = rotation + 3 * c;
        float along = c == 1 ? column[0] * rotation[0] + column[1] * rotation[1] + column[2] * rotation[2] : 0.0f;
        float square = 0.0f;
        for (int i = 0; i < 3; i++) {
            column[i] -= along * rotation[i];
            square += column[i] * column[i];
        }
        for (int i = 0; i < 3; i++) {
            column[i] /= sqrtf(square);
        }
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        rotation[6 + i] = rotation[j] * rotation[3 + k] - rotation[k] * rotation[3 + j];
    }
}

void Pose_Mix(const Pose* before, const Pose* after, float alpha, Pose* between)
{
    for (int i = 0; i < 3; i++) {
        between->position[i] = before->position[i] + alpha * (after->position[i] - before->position[i]);
    }
    for (int i = 0; i < 9; i++) {
        between->rotation[i] = before->rotation[i] + alpha * (after->rotation[i] - before->rotation[i]);
    }
    Straighten(between->rotation);
}
