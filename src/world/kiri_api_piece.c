#include "kiri_call.h"
#include "kiri_part.h"
#include "../sheet/kiri_piece_list.h"

#define CHECK_PIECE(data, piece)                                                                                       \
    KIRI_CHECK(kiriCall_IsWithin(piece, 0, (data)->layout.pieces.count - 1), "the sheet has no such piece")

/* Brings lists of pieces up to date. */
#define LIST_PIECES(isListed)                                                                                          \
    do {                                                                                                               \
        if (!(isListed)) {                                                                                             \
            return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);                                                                 \
        }                                                                                                              \
    } while (0)

kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(state != NULL, "state is null");
    KIRI_FIND_SHEET(data, sheet);
    CHECK_PIECE(data, piece);
    LIST_PIECES(kiriPieces_ListFrames(data) && kiriPieces_ListVertices(data));
    *state = kiriPiece_State(data, piece);
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(mesh != NULL, "mesh is null");
    KIRI_FIND_SHEET(data, sheet);
    CHECK_PIECE(data, piece);
    LIST_PIECES(kiriPieces_ListFrames(data) && kiriPieces_ListTriangles(data));
    const kiriPieceLists* lists = &data->lists;
    kiriSpan vertices = kiriPieceItems_Of(&lists->vertices, piece);
    kiriSpan triangles = kiriPieceItems_Of(&lists->triangles, piece);
    kiriSpan points = kiriPieceItems_Of(&lists->points, piece);
    if (data->layout.pieces.data[piece].isGone) {
        vertices.count = triangles.count = points.count = 0;
    }
    mesh->vertices = lists->vertices.items.data + vertices.first;
    mesh->triangles = lists->triangles.items.data + triangles.first;
    mesh->indices = lists->corners.data + 3 * (int64_t)triangles.first;
    mesh->collisionPoints = points.count > 0 ? lists->points.items.data + points.first : NULL;
    mesh->vertexCount = vertices.count;
    mesh->triangleCount = triangles.count;
    mesh->collisionPointCount = points.count;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetPieceFrames(kiriWorld* world, kiriSheet sheet, int32_t piece, const kiriFrame** frames,
                                    int32_t* count)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(frames != NULL && count != NULL, "frames or count is null");
    KIRI_FIND_SHEET(data, sheet);
    CHECK_PIECE(data, piece);
    LIST_PIECES(kiriPieces_ListFrames(data));
    kiriSpan span = kiriPieceItems_Of(&data->lists.frames, piece);
    *frames = data->lists.ids.data + span.first;
    *count = data->layout.pieces.data[piece].isGone ? 0 : span.count;
    KIRI_RETURN(KIRI_OK);
}

static int32_t PieceThatHas(const kiriWorld* world, const kiriSheetData* sheet, kiriFrame frame)
{
    return sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
}

kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece)
{
    KIRI_READS(world);
    KIRI_CHECK(piece != NULL, "piece is null");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    *piece = PieceThatHas(world, sheet, frame);
    return KIRI_OK;
}

/* The library's line for a result of taking apart. */
static const char* FaultOfParting(kiriResult result)
{
    return result == KIRI_ERROR_STATE ? "the piece is all that is left of its sheet" : NULL;
}

kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached)
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_DETACH_PIECE, &frame, detached);
    KIRI_CHECK(detached != NULL, "detached is null");
    *detached = 0;
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    (void)sheet;
    kiriResult result = kiriParts_Detach(world, &frame, 1, detached);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame)
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_DESTROY_PIECE, &frame);
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    (void)sheet;
    kiriResult result = kiriParts_Destroy(world, &frame, 1);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

static bool AreFrames(const kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    bool all = true;
    for (int32_t i = 0; i < count; ++i) {
        all = all && kiriPool_Find(&world->frameIds, frames[i]) != NULL;
    }
    return all;
}

#define CHECK_FRAMES(frames, count)                                                                                    \
    do {                                                                                                               \
        KIRI_CHECK((count) == 0 || ((count) > 0 && (frames) != NULL), "frames is null, or count below 0");             \
        if (!AreFrames(world, frames, count)) {                                                                        \
            return KIRI_FAIL(KIRI_ERROR_ID, "there is no frame with one of these ids");                                \
        }                                                                                                              \
    } while (0)

kiriResult kiriWorld_DetachPieces(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* detached)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_DETACH_PIECES, frames, &count, detached);
    KIRI_CHECK(count <= 0 || detached != NULL, "detached is null");
    for (int32_t i = 0; i < count; ++i) {
        detached[i] = 0;
    }
    CHECK_FRAMES(frames, count);
    kiriResult result = kiriParts_Detach(world, frames, count, detached);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

kiriResult kiriWorld_DestroyPieces(kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_DESTROY_PIECES, frames, &count);
    CHECK_FRAMES(frames, count);
    kiriResult result = kiriParts_Destroy(world, frames, count);
    KIRI_RETURN_OR_SAY(result, FaultOfParting(result));
}

kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_DROP_CRUMBS, &sheet, &area, count);
    KIRI_CHECK(count != NULL && kiriCall_IsAtLeast(area, 0.0f), "count is null, or area not finite or below 0");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_RETURN(kiriParts_DropCrumbs(world, data, area, count));
}
