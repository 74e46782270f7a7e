#include "kiri_kept.h"

#include "kiri_obstacle_touch.h"
#include "kiri_piece.h"
#include "kiri_touch.h"

#include <string.h>

bool kiriKept_Init(kiriKept* kept, const kiriSheetData* from)
{
    memset(kept, 0, sizeof(*kept));
    kept->from = from;
    kept->memory = kiriMemory_Like(from->memory);
    if (!kiriArray_Resize(&kept->memory, &kept->pieces, from->layout.pieces.count)) {
        return false;
    }
    memset(kept->pieces.data, 0, (size_t)kept->pieces.count);
    return true;
}

static bool IsFrameKept(const kiriKept* kept, int32_t frame)
{
    return kept->pieces.data[kept->from->layout.framePiece.data[frame]] != 0;
}

int32_t kiriKept_FrameOfPin(const kiriKept* kept, int32_t pin)
{
    const kiriLayout* layout = &kept->from->layout;
    const kiriLineShare* longest = NULL;
    if (IsFrameKept(kept, layout->pinFrame.data[pin])) {
        return layout->pinFrame.data[pin];
    }
    for (int32_t k = 0; k < layout->pinShares.count; ++k) {
        const kiriPinShare* pinned = &layout->pinShares.data[k];
        if (pinned->pin == pin && IsFrameKept(kept, pinned->share.frame) &&
            (longest == NULL || pinned->share.length > longest->length)) {
            longest = &pinned->share;
        }
    }
    return longest != NULL ? longest->frame : KIRI_NONE;
}

static bool MapMesh(kiriKept* kept)
{
    const kiriMeshData* mesh = &kept->from->mesh;
    if (!kiriKeep_Init(&kept->triangles, &kept->memory, mesh->triangles.count) ||
        !kiriKeep_Init(&kept->vertices, &kept->memory, mesh->vertices.count)) {
        return false;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t piece = kiriPiece_OfVertex(kept->from, v);
        kiriKeep_Add(&kept->vertices, piece != KIRI_NONE && kept->pieces.data[piece] != 0);
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriKeep_Add(&kept->triangles, kiriKeep_Has(&kept->vertices, mesh->triangles.data[t].vertex[0]));
    }
    return true;
}

static bool ReserveRest(kiriKept* kept)
{
    const kiriSheetData* from = kept->from;
    return kiriKeep_Init(&kept->frames, &kept->memory, from->frames.count) &&
           kiriKeep_Init(&kept->points, &kept->memory, from->points.count) &&
           kiriKeep_Init(&kept->pins, &kept->memory, from->pins.count) &&
           kiriKeep_Init(&kept->links, &kept->memory, from->links.links.count);
}

/* There is room. */
static void MapRest(kiriKept* kept)
{
    const kiriSheetData* from = kept->from;
    for (int32_t i = 0; i < from->frames.count; ++i) {
        kiriKeep_Add(&kept->frames, IsFrameKept(kept, i));
    }
    for (int32_t i = 0; i < from->points.count; ++i) {
        kiriKeep_Add(&kept->points, IsFrameKept(kept, from->points.data[i].frame));
    }
    for (int32_t i = 0; i < from->pins.count; ++i) {
        kiriKeep_Add(&kept->pins, kiriKept_FrameOfPin(kept, i) != KIRI_NONE);
    }
    for (int32_t k = 0; k < from->links.links.count; ++k) {
        kiriKeep_Add(&kept->links, IsFrameKept(kept, from->links.links.data[k].i));
    }
}

bool kiriKept_LeaveHoles(kiriKept* kept)
{
    kept->vertices = kiriKeep_LeaveHoles(&kept->from->taking.vertices);
    kept->triangles = kiriKeep_LeaveHoles(&kept->from->taking.triangles);
    if (!ReserveRest(kept)) {
        return false;
    }
    MapRest(kept);
    return true;
}

bool kiriKept_Map(kiriKept* kept)
{
    if (!MapMesh(kept) || !ReserveRest(kept)) {
        return false;
    }
    MapRest(kept);
    return true;
}

/* ---- One piece after the other ---- */

bool kiriKept_InitParts(kiriKept* kept, const kiriSheetData* from)
{
    return kiriKept_Init(kept, from) && ReserveRest(kept);
}

void kiriKept_TakePart(kiriKept* kept, int32_t piece, const kiriIndices* vertices, const kiriIndices* triangles)
{
    kept->vertices = kept->from->taking.vertices;
    kept->triangles = kept->from->taking.triangles;
    kept->pieces.data[piece] = 1;
    kiriKeep_Take(&kept->vertices, vertices->data, vertices->count);
    kiriKeep_Take(&kept->triangles, triangles->data, triangles->count);
    MapRest(kept);
}

void kiriKept_DropPart(kiriKept* kept, int32_t piece, const kiriIndices* vertices, const kiriIndices* triangles)
{
    kept->pieces.data[piece] = 0;
    kiriKeep_Drop(&kept->vertices, vertices->data, vertices->count);
    kiriKeep_Drop(&kept->triangles, triangles->data, triangles->count);
    kiriKeep_Restart(&kept->frames);
    kiriKeep_Restart(&kept->points);
    kiriKeep_Restart(&kept->pins);
    kiriKeep_Restart(&kept->links);
}

/* ---- What follows ---- */

bool kiriKept_FollowContact(const kiriKept* kept, kiriGivenContact* given)
{
    if (given->contact.point >= 0) {
        given->contact.point = kiriKeep_To(&kept->points, given->contact.point);
        return given->contact.point != KIRI_NONE;
    }
    bool isKept = true;
    for (int n = 0; n < 3 && given->vertex[n] != KIRI_NONE; ++n) {
        given->vertex[n] = kiriKeep_To(&kept->vertices, given->vertex[n]);
        isKept = isKept && given->vertex[n] != KIRI_NONE;
    }
    return isKept;
}

bool kiriKept_FollowTouch(const kiriKept* kept, kiriTouch* touch)
{
    bool isKept = true;
    if (touch->key >> 60 != KIRI_TOUCH_OBSTACLE) {
        return kiriTouch_Follow(touch, &kept->points, &kept->vertices);
    }
    for (int n = 0; n < 3 && touch->vertex[n] != KIRI_NONE; ++n) {
        touch->vertex[n] = kiriKeep_To(&kept->vertices, touch->vertex[n]);
        isKept = isKept && touch->vertex[n] != KIRI_NONE;
    }
    return isKept && kiriObstacle_FollowKey(&touch->key, &kept->vertices, &kept->triangles);
}

double kiriKept_Share(const kiriKept* kept)
{
    const kiriLayout* layout = &kept->from->layout;
    double share = 0.0, whole = 0.0;
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        whole += layout->pieces.data[p].area;
        share += kept->pieces.data[p] ? layout->pieces.data[p].area : 0.0;
    }
    return share / whole;
}
