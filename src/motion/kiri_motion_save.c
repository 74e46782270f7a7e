#include "kiri_motion_save.h"

#include "../field/kiri_field_save.h"

static const kiriMember HistoryMembers[] = {
    KIRI_RUN(8, kiriHistory, dt, dt),
    KIRI_RUN(4, kiriHistory, isHalf, isHeld),
    KIRI_RUN(8, kiriHistory, gain, turnPull),
};
static const kiriTable HistoryTable = KIRI_TABLE(kiriHistory, HistoryMembers);

static const kiriMember FrameDataMembers[] = {
    KIRI_RUN(4, kiriFrameData, id, id),
    KIRI_RUN(8, kiriFrameData, pieceData, pieceData),
    KIRI_PART(kiriFrameData, site, kiriSiteTable),
    KIRI_RUN(4, kiriFrameData, anchor, anchor),
    KIRI_RUN(8, kiriFrameData, center, support),
    KIRI_DROPPED(kiriFrameData, gained),
    KIRI_DROPPED(kiriFrameData, passed),
    KIRI_DROPPED(kiriFrameData, received),
    KIRI_PART(kiriFrameData, history, HistoryTable),
    KIRI_RUN(4, kiriFrameData, held, held),
    KIRI_RUN(8, kiriFrameData, heldPosition, heldOff),
    KIRI_BOOLS(kiriFrameData, isOffKnown, isOffKnown),
    KIRI_RUN(8, kiriFrameData, reaction, bore),
};
const kiriTable kiriFrameTable = KIRI_TABLE(kiriFrameData, FrameDataMembers);

static const kiriMember AreaElementMembers[] = {
    KIRI_RUN(8, kiriAreaElement, area, lean),
    KIRI_RUN(4, kiriAreaElement, first, lastRow),
};
static const kiriTable AreaElementTable = KIRI_TABLE(kiriAreaElement, AreaElementMembers);

static const kiriMember FrameShareMembers[] = {
    KIRI_RUN(4, kiriFrameShare, frame, frame),
    KIRI_RUN(8, kiriFrameShare, move, slope),
};
static const kiriTable FrameShareTable = KIRI_TABLE(kiriFrameShare, FrameShareMembers);

static const kiriMember AreaElementsMembers[] = {
    KIRI_PARTS(kiriAreaElements, elements, AreaElementTable),
    KIRI_PARTS(kiriAreaElements, shares, FrameShareTable),
};
const kiriTable kiriAreaElementsTable = KIRI_TABLE(kiriAreaElements, AreaElementsMembers);

static const kiriMember StrainOffsetsMembers[] = {
    KIRI_ITEMS(8, kiriStrainOffsets, strainOffsets), KIRI_ROOM_OF(kiriStrainOffsets, older),
    KIRI_ROOM_OF(kiriStrainOffsets, from),           KIRI_ROOM_OF(kiriStrainOffsets, frames),
    KIRI_ROOM_OF(kiriStrainOffsets, mayMove),
};
const kiriTable kiriStrainOffsetsTable = KIRI_TABLE(kiriStrainOffsets, StrainOffsetsMembers);

static const kiriMember TransferMembers[] = {
    KIRI_RUN(4, kiriTransfer, from, next),
    KIRI_RUN(8, kiriTransfer, material, material),
};
static const kiriTable TransferTable = KIRI_TABLE(kiriTransfer, TransferMembers);

static const kiriMember OwnershipMembers[] = {
    KIRI_ITEMS(4, kiriOwnership, squares),
    KIRI_ITEMS(4, kiriOwnership, triangleOwners),
    KIRI_RUN(4, kiriOwnership, spans, triangleCount),
    KIRI_ITEMS(4, kiriOwnership, dirty),
    KIRI_ITEMS(1, kiriOwnership, isDirty),
    KIRI_RUN(4, kiriOwnership, next, next),
    KIRI_RUN(8, kiriOwnership, due, due),
    KIRI_ITEMS(4, kiriOwnership, staged),
    KIRI_PARTS(kiriOwnership, transfers, TransferTable),
    KIRI_ITEMS(4, kiriOwnership, first),
};
static const kiriTable OwnershipTable = KIRI_TABLE(kiriOwnership, OwnershipMembers);

static const kiriMember RefitMembers[] = {
    KIRI_PART(kiriRefit, ownership, OwnershipTable),
    KIRI_ROOM_OF(kiriRefit, fits),
    KIRI_RUN(4, kiriRefit, most, most),
    KIRI_ROOM_OF(kiriRefit, gained),
    KIRI_ROOM_OF(kiriRefit, firstOf),
    KIRI_ROOM_OF(kiriRefit, nextOf),
};
const kiriTable kiriRefitTable = KIRI_TABLE(kiriRefit, RefitMembers);

static const kiriMember MechanicsMembers[] = {
    KIRI_RUN(4, kiriMechanics, model, model),
    KIRI_BOOLS(kiriMechanics, planar, planar),
    KIRI_RUN(8, kiriMechanics, axes, axes),
    KIRI_RUN(4, kiriMechanics, timeStepping, timeStepping),
};
const kiriTable kiriMechanicsTable = KIRI_TABLE(kiriMechanics, MechanicsMembers);
