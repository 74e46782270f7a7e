#include "kiri_room.h"

#include <string.h>

/* For each edge that a blade crosses; a triangle is in two squares or so, and a vertex has few weights. */
enum { ROOM_VERTICES = 3, ROOM_TRIANGLES = 3, ROOM_NODES = 6, ROOM_WEIGHTS = 24, ROOM_CORNERS = 24 };

enum { ROOM_BYTES = 768 }; /* that an item moves */

/* About as many edges as the points of the update cross, in a mesh of even triangles; at most as many as it has
   vertices. */
static int64_t CountCrossings(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    const kiriMeshData* mesh = &sheet->mesh;
    double way = 0.0, most = mesh->vertices.count, width = (double)mesh->squares.columns * mesh->squares.side,
           height = (double)mesh->squares.rows * mesh->squares.side;
    for (int32_t i = u->cut.taken; i < u->cut.count; ++i) {
        const kiriQueuedPoint* point = &sheet->queue.data[i];
        kiriVec2 from = i > 0 && sheet->queue.data[i - 1].cut == point->cut ? sheet->queue.data[i - 1].to
                                                                            : point->cut->tip.last,
                 to = point->to;
        if (!point->jump && kiriCut_Clip(mesh, &from, &to)) {
            way += kiriVec2_Length(kiriVec2_Sub(to, from)) / mesh->step;
        }
    }
    double spacing = sqrt(2.0 * width * height / (mesh->triangles.count + 1.0)), crossings = 3.0 * way / spacing;
    return (int64_t)kiriMin(crossings, most) + u->cut.count;
}

enum { ROOMS = 16 };

static void ListRooms(kiriSheetData* sheet, int64_t more, kiriRoom rooms[ROOMS])
{
    kiriMemory *own = sheet->memory, *shown = &sheet->shown;
    kiriMeshData* mesh = &sheet->mesh;
    kiriSkin* skin = &sheet->vertexSkin;
    kiriSurface* s = &sheet->seen.surface;
    int64_t vertices = mesh->vertices.count + ROOM_VERTICES * more,
            added = mesh->triangles.count + ROOM_TRIANGLES * more, corners = 3 * (added + 1),
            blocks = mesh->sources.count > 0 ? 0 : mesh->sourceCorners.count + ROOM_CORNERS * more;
    const kiriRoom all[ROOMS] = { KIRI_ROOM(own, &mesh->vertices, vertices),
                                  KIRI_ROOM(own, &mesh->triangles, added),
                                  KIRI_ROOM(own, &mesh->squares.nodes, mesh->squares.nodes.count + ROOM_NODES * more),
                                  KIRI_ROOM(own, &mesh->sourceCorners, blocks),
                                  KIRI_ROOM(own, &skin->spans, vertices),
                                  KIRI_ROOM(own, &skin->weights, skin->weights.count + ROOM_WEIGHTS * more),
                                  KIRI_ROOM(shown, &s->restPositions, 2 * vertices),
                                  KIRI_ROOM(shown, &s->sourceWeights, 3 * vertices),
                                  KIRI_ROOM(shown, &s->sourceTriangles, vertices),
                                  KIRI_ROOM(shown, &s->indices, corners),
                                  KIRI_ROOM(shown, &s->turns, added / 2 + 1),
                                  KIRI_ROOM(shown, &s->rest, vertices),
                                  KIRI_CHANGING_ROOM(shown, &s->positions, 3 * vertices + 1),
                                  KIRI_CHANGING_ROOM(shown, &s->normals, 3 * vertices),
                                  KIRI_CHANGING_ROOM(shown, &s->places, 3 * vertices + 1),
                                  KIRI_CHANGING_ROOM(shown, &s->slopes, 4 * vertices) };
    memcpy(rooms, all, sizeof(all));
}

/* What a tick may need: each triangle made takes an item. */
static int64_t CrossingsInTick(const kiriQuota* triangles, int64_t crossings)
{
    int64_t most = triangles->left / ROOM_TRIANGLES + 1;
    return kiriMin(most, 4 * crossings);
}

bool kiriRoom_IsLow(kiriSheetData* sheet, const kiriQuota* triangles)
{
    kiriRoom rooms[ROOMS];
    bool isLow = false;
    ListRooms(sheet, CrossingsInTick(triangles, CountCrossings(sheet)), rooms);
    for (int32_t i = 0; i < ROOMS; ++i) {
        isLow |= rooms[i].need > kiriArray_GetHeader(rooms[i].array).capacity;
    }
    return isLow;
}

/* What has been moved counts no more where pieces have gone. */
static void StartGrowing(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (u->growsSince != sheet->mesh.revision) {
        kiriGrowing_Drop(&u->growing);
        u->growsSince = sheet->mesh.revision;
    }
}

kiriProgress kiriRoom_ForCut(kiriSheetData* sheet, kiriQuota* triangles)
{
    kiriUpdate* u = sheet->update;
    kiriRoom rooms[ROOMS];
    StartGrowing(sheet);
    int64_t crossings = CountCrossings(sheet), inTick = CrossingsInTick(triangles, crossings);
    ListRooms(sheet, u->cut.taken > 0 && crossings < inTick ? inTick : crossings, rooms);
    return kiriGrowing_GoOn(&u->growing, rooms, ROOMS, triangles, ROOM_BYTES);
}

enum { WEIGHT_ROOMS = 2, WEIGHT_BYTES = 512 }; /* that an item moves */

/* In a mesh of even triangles. */
static void ListWeightRooms(kiriSheetData* sheet, kiriRoom rooms[WEIGHT_ROOMS])
{
    const kiriSquares* squares = &sheet->mesh.squares;
    kiriSkin* skin = &sheet->vertexSkin;
    int64_t vertices = sheet->mesh.vertices.count, all = (int64_t)squares->columns * squares->rows,
            more = vertices * sheet->update->samples.refresh.squares.count / all,
            each = skin->weights.count / (vertices > 0 ? vertices : 1) + 1;
    const kiriRoom both[WEIGHT_ROOMS] = { KIRI_ROOM(sheet->memory, &skin->staged, more),
                                          KIRI_ROOM(sheet->memory, &skin->weights, skin->weights.count + each * more) };
    memcpy(rooms, both, sizeof(both));
}

kiriProgress kiriRoom_ForWeights(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriRoom rooms[WEIGHT_ROOMS];
    ListWeightRooms(sheet, rooms);
    StartGrowing(sheet);
    return kiriGrowing_GoOn(&sheet->update->growing, rooms, WEIGHT_ROOMS, samples, WEIGHT_BYTES);
}

/* An array that is small grows when it is full, at one go. */
static void PassOverSmall(kiriRoom* room)
{
    enum { SMALL_BYTES = 1 << 18 };
    int64_t bytes = kiriArray_GetHeader(room->array).count * (int64_t)room->itemBytes;
    room->need = bytes < SMALL_BYTES ? 0 : room->need;
}

kiriProgress kiriRoom_ForMoreWeights(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriRoom rooms[WEIGHT_ROOMS];
    kiriSkin* skin = &sheet->vertexSkin;
    int64_t vertices = sheet->mesh.vertices.count, more = samples->left < vertices ? samples->left : 0,
            each = skin->weights.count / (vertices > 0 ? vertices : 1) + 1;
    StartGrowing(sheet);
    ListWeightRooms(sheet, rooms);
    rooms[0].need = skin->staged.count + more;
    rooms[1].need = skin->weights.count + each * more;
    PassOverSmall(&rooms[0]);
    PassOverSmall(&rooms[1]);
    return kiriGrowing_GoOn(&sheet->update->growing, rooms, WEIGHT_ROOMS, samples, WEIGHT_BYTES);
}

/* What counts no more is not kept: its array may have become shorter. */
void kiriRoom_ArchiveGrowing(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriRoom rooms[ROOMS + WEIGHT_ROOMS];
    kiriUpdate* u = sheet->update;
    kiriGrowing none = { NULL, NULL, NULL, 0, 0, u->growing.owed };
    bool counts = kiriArchive_Reads(archive) || u->growsSince == sheet->mesh.revision;
    ListRooms(sheet, 0, rooms);
    ListWeightRooms(sheet, rooms + ROOMS);
    kiriArchive_Growing(archive, counts ? &u->growing : &none, rooms, ROOMS + WEIGHT_ROOMS);
}
