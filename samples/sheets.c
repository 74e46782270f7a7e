#include "sheets.h"

#include <stdlib.h>
#include <string.h>

static bool Reserve(Sheets* sheets, int32_t vertices, int32_t triangles)
{
    if (vertices > sheets->vertexCapacity || triangles > sheets->triangleCapacity) {
        Sheets_Free(sheets);
        sheets->vertexCapacity = 2 * vertices;
        sheets->triangleCapacity = 2 * triangles;
        sheets->positions = malloc(sizeof(float) * 6 * (size_t)vertices);
        sheets->normals = malloc(sizeof(float) * 6 * (size_t)vertices);
        sheets->restPositions = malloc(sizeof(float) * 4 * (size_t)vertices);
        sheets->indices = malloc(sizeof(int32_t) * 6 * (size_t)triangles);
    }
    return sheets->vertexCapacity == 0 || (sheets->positions != NULL && sheets->normals != NULL &&
                                           sheets->restPositions != NULL && sheets->indices != NULL);
}

static void Append(Sheets* sheets, const kiriMesh* mesh)
{
    kiriMesh* all = &sheets->mesh;
    size_t first = (size_t)all->vertexCount, count = (size_t)mesh->vertexCount;
    memcpy(sheets->positions + 3 * first, mesh->positions, sizeof(float) * 3 * count);
    memcpy(sheets->restPositions + 2 * first, mesh->restPositions, sizeof(float) * 2 * count);
    for (size_t i = 0; i < 3 * count; i++) {
        sheets->normals[3 * first + i] = mesh->normals != NULL ? mesh->normals[i] : (float)(i % 3 == 2);
    }
    for (int32_t i = 0; i < 3 * mesh->triangleCount; i++) {
        sheets->indices[3 * all->triangleCount + i] = mesh->indices[i] + all->vertexCount;
    }
    all->vertexCount += mesh->vertexCount;
    all->triangleCount += mesh->triangleCount;
}

bool Sheets_Take(Sheets* sheets, const kiriWorld* world, kiriSheet except)
{
    enum { MOST_SHEETS = 4096 };
    kiriSheet ids[MOST_SHEETS];
    kiriMesh mesh;
    int32_t all = 0, count = 0, vertices = 0, triangles = 0;
    kiriWorld_GetSheets(world, ids, MOST_SHEETS, &all);
    for (int32_t i = 0; i < all && i < MOST_SHEETS; i++) {
        ids[count] = ids[i];
        count += ids[i] != except;
    }
    for (int32_t i = 0; i < count; i++) {
        kiriSheet_GetMesh(world, ids[i], &mesh);
        vertices += mesh.vertexCount;
        triangles += mesh.triangleCount;
    }
    if (!Reserve(sheets, vertices, triangles)) {
        return false;
    }
    sheets->mesh =
        (kiriMesh){ sheets->positions, sheets->normals, sheets->restPositions, sheets->indices, NULL, NULL, 0, 0, 0 };
    for (int32_t i = 0; i < count; i++) {
        kiriSheet_GetMesh(world, ids[i], &mesh);
        Append(sheets, &mesh);
    }
    return true;
}

void Sheets_Free(Sheets* sheets)
{
    free(sheets->positions);
    free(sheets->normals);
    free(sheets->restPositions);
    free(sheets->indices);
    *sheets = (Sheets){ .positions = NULL };
}
