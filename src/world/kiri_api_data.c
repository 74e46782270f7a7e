#include "kiri_call.h"

kiriResult kiriSheet_SetUserData(kiriWorld* world, kiriSheet sheet, uint64_t data)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_SET_USER_DATA, &sheet, &data);
    KIRI_FIND_SHEET(found, sheet);
    found->settings.userData = data;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriSheet_GetUserData(const kiriWorld* world, kiriSheet sheet, uint64_t* data)
{
    KIRI_READS(world);
    KIRI_CHECK(data != NULL, "data is null");
    KIRI_FIND_SHEET(found, sheet);
    *data = found->settings.userData;
    return KIRI_OK;
}

kiriResult kiriPin_SetUserData(kiriWorld* world, kiriPin pin, uint64_t data)
{
    KIRI_CHANGES(world, KIRI_CALL_PIN_SET_USER_DATA, &pin, &data);
    KIRI_FIND_PIN_SHEET(sheet, pin);
    sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index].userData = data;
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriPin_GetUserData(const kiriWorld* world, kiriPin pin, uint64_t* data)
{
    KIRI_READS(world);
    KIRI_CHECK(data != NULL, "data is null");
    KIRI_FIND_PIN_SHEET(sheet, pin);
    *data = sheet->pins.data[kiriPool_Find(&world->pinIds, pin)->index].userData;
    return KIRI_OK;
}

/* All frames of the piece have it, and hand it to new ones. */
kiriResult kiriFrame_SetPieceUserData(kiriWorld* world, kiriFrame frame, uint64_t data)
{
    KIRI_CHANGES(world, KIRI_CALL_FRAME_SET_PIECE_USER_DATA, &frame, &data);
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    int32_t piece = sheet->layout.framePiece.data[kiriPool_Find(&world->frameIds, frame)->index];
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (sheet->layout.framePiece.data[i] == piece) {
            sheet->frames.data[i].pieceData = data;
        }
    }
    KIRI_RETURN(KIRI_OK);
}

kiriResult kiriFrame_GetPieceUserData(const kiriWorld* world, kiriFrame frame, uint64_t* data)
{
    KIRI_READS(world);
    KIRI_CHECK(data != NULL, "data is null");
    KIRI_FIND_FRAME_SHEET(sheet, frame);
    *data = sheet->frames.data[kiriPool_Find(&world->frameIds, frame)->index].pieceData;
    return KIRI_OK;
}
