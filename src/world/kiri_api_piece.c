#include "kiri_call.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_update.h"

/* Brings the lists of pieces up to date. */
#define LIST_PIECES(data, piece)                                                                                       \
    do {                                                                                                               \
        KIRI_CHECK(kiriCall_IsWithin(piece, 0, data->layout.pieces.count - 1), "the sheet has no such piece");         \
        if (!kiriPieces_List(data)) {                                                                                  \
            return KIRI_FAIL(KIRI_ERROR_MEMORY, NULL);                                                                 \
        }                                                                                                              \
    } while (0)

kiriResult kiriSheet_GetPiece(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceState* state)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(state != NULL, "state is null");
    KIRI_FIND_SHEET(data, sheet);
    LIST_PIECES(data, piece);
    *state = kiriPiece_State(data, piece);
    return KIRI_OK;
}

kiriResult kiriSheet_GetPieceMesh(kiriWorld* world, kiriSheet sheet, int32_t piece, kiriPieceMesh* mesh)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(mesh != NULL, "mesh is null");
    KIRI_FIND_SHEET(data, sheet);
    LIST_PIECES(data, piece);
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
    KIRI_CHANGES(world);
    KIRI_CHECK(frames != NULL && count != NULL, "frames or count is null");
    KIRI_FIND_SHEET(data, sheet);
    LIST_PIECES(data, piece);
    kiriSpan span = kiriPiece_Span(&data->lists.frames, piece);
    *frames = data->lists.ids.data + span.first;
    *count = span.count;
    return KIRI_OK;
}

static int32_t PieceOf(const kiriWorld* world, const kiriSheetData* sheet, kiriFrame frame)
{
    return sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
}

kiriResult kiriFrame_GetPiece(const kiriWorld* world, kiriFrame frame, int32_t* piece)
{
    KIRI_READS(world);
    KIRI_CHECK(piece != NULL, "piece is null");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    *piece = PieceOf(world, sheet, frame);
    return KIRI_OK;
}

/* Why the sheet cannot be taken apart now, or null. */
static const char* FaultOfWork(const kiriSheetData* sheet)
{
    bool isAtRest = sheet->update->stage == KIRI_NONE && !sheet->update->needsRebuild;
    return isAtRest ? NULL : "a cut is being worked on; ask again when its work is done";
}

static const char* FaultOfParting(const kiriSheetData* sheet)
{
    bool isWhole = sheet->layout.pieces.count == 1;
    return isWhole ? "the piece is all of the sheet" : FaultOfWork(sheet);
}

kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(detached != NULL, "detached is null");
    *detached = 0;
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    const char* why = FaultOfParting(sheet);
    if (why != NULL) {
        return KIRI_FAIL(KIRI_ERROR_STATE, why);
    }
    KIRI_RETURN(kiriWorld_DetachPiece(world, sheet, PieceOf(world, sheet, frame), detached));
}

kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame)
{
    KIRI_CHANGES(world);
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    const char* why = FaultOfParting(sheet);
    if (why != NULL) {
        return KIRI_FAIL(KIRI_ERROR_STATE, why);
    }
    KIRI_RETURN(kiriWorld_DestroyPiece(world, sheet, PieceOf(world, sheet, frame)));
}

kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count)
{
    KIRI_CHANGES(world);
    KIRI_CHECK(count != NULL && kiriCall_IsAtLeast(area, 0.0f), "count is null, or area not finite or below 0");
    KIRI_FIND_SHEET(data, sheet);
    const char* why = FaultOfWork(data);
    if (why != NULL) {
        return KIRI_FAIL(KIRI_ERROR_STATE, why);
    }
    KIRI_RETURN(kiriWorld_DropCrumbs(world, data, area, count));
}
