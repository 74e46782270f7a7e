#include "kiri_motion_check.h"

#include <math.h>

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust HistoryMust[] = {
    KIRI_REALS(kiriHistory, dt, dt),
    KIRI_WITHIN(0, 1, kiriHistory, isHalf, isHeld),
    KIRI_REALS(kiriHistory, gain, turnPull),
};

static const kiriMust FrameMust[] = {
    KIRI_REALS(kiriFrameData, site.at, site.at),
    KIRI_REALS(kiriFrameData, center, support),
    KIRI_PART_MUST(kiriFrameData, history, kiriHistory, HistoryMust),
    KIRI_WITHIN(0, 1, kiriFrameData, held, held),
    KIRI_REALS(kiriFrameData, reaction, bore),
};

static const kiriMust FrameShareMust[] = {
    KIRI_INDEX(KIRI_OF_FRAMES, kiriFrameShare, frame, frame),
};

static const kiriMust AreaElementMust[] = {
    KIRI_REALS(kiriAreaElement, area, lean),
    KIRI_WITHIN(0, KIRI_AREA_STRAINS, kiriAreaElement, firstRow, lastRow),
};

static const kiriMust AreaElementsMust[] = {
    KIRI_ITEMS_MUST(kiriAreaElements, elements, AreaElementMust),
    KIRI_ITEMS_MUST(kiriAreaElements, shares, FrameShareMust),
};

static const kiriMust OwnershipMust[] = {
    KIRI_UP_TO(KIRI_OF_TRIANGLES, kiriOwnership, triangleCount, triangleCount),
};

static const kiriMust MechanicsMust[] = {
    KIRI_WITHIN(KIRI_MODEL_LINKS, KIRI_MODEL_POINTS, kiriMechanics, model, model),
    KIRI_REALS(kiriMechanics, axes, axes),
    KIRI_WITHIN(KIRI_TIME_STEPPING_SECOND_ORDER, KIRI_TIME_STEPPING_EULER, kiriMechanics, timeStepping, timeStepping),
};

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

bool kiriMechanics_Check(const kiriMechanics* mechanics, kiriCheck* check)
{
    return kiriCheck_Object(check, MechanicsMust, mechanics);
}

/* But for rounding. */
static bool IsSiteIn(const kiriFrameData* frame, const kiriMeshData* mesh, int32_t square)
{
    double half = 0.5 * mesh->squares.side, most = 1.02 * half * mesh->step;
    kiriLatticePoint corner = kiriSquares_Corner(&mesh->squares, square);
    kiriVec2 middle = kiriVec2_Make(mesh->step * (corner.x + half), mesh->step * (corner.y + half));
    return fabs(frame->site.at.x - middle.x) <= most && fabs(frame->site.at.y - middle.y) <= most;
}

/* The anchor is where there is material, and the site is in its square. */
bool kiriFrame_Check(const kiriFrameData* frame, kiriCheck* check, const kiriMeshData* mesh)
{
    int32_t square =
        frame->anchor.x < 0 || frame->anchor.y < 0 ? KIRI_NONE : kiriSquares_At(&mesh->squares, frame->anchor);
    return kiriCheck_Object(check, FrameMust, frame) &&
           kiriCheck_That(check, square != KIRI_NONE && mesh->squares.head[square] != KIRI_NONE &&
                                     ((frame->anchor.x | frame->anchor.y) & 1) == 0 && frame->mass > 0.0 &&
                                     frame->area > 0.0 && kiriFrame_FitsFloats(frame) && IsSiteIn(frame, mesh, square));
}

bool kiriAreaElements_Check(const kiriAreaElements* elements, kiriCheck* check)
{
    int64_t next = 0;
    bool areFine = kiriCheck_Object(check, AreaElementsMust, elements);
    for (int32_t k = 0; areFine && k < elements->elements.count; ++k) {
        const kiriAreaElement* element = &elements->elements.data[k];
        areFine = element->first == next && element->count > 0 && element->firstRow < element->lastRow;
        next += element->count;
        areFine = areFine && next <= elements->shares.count;
    }
    return kiriCheck_That(check, areFine && next == elements->shares.count);
}

/* ---- Owners ------------------------------------------------------------------------------------------------------ */

/* Owners of the parts of a square. */
static bool ArePartsOwned(kiriCheck* check, const kiriOwnership* ownership, kiriRooms* rooms,
                          const kiriSquareOwners* owners)
{
    int64_t frames = check->count[KIRI_OF_FRAMES];
    bool areFine = kiriCheck_That(check, owners->owner >= KIRI_NONE && owners->owner < frames) &&
                   kiriCheck_Span(check, rooms, owners->parts);
    for (int32_t k = owners->parts.first; areFine && k < owners->parts.first + owners->parts.count; ++k) {
        const kiriTriangleOwner* owned = &ownership->triangleOwners.data[k];
        areFine = owned->triangle >= 0 && owned->triangle < check->count[KIRI_OF_TRIANGLES] &&
                  owned->owner >= KIRI_NONE && owned->owner < frames;
    }
    return kiriCheck_That(check, areFine);
}

static bool AreOwners(kiriCheck* check, const kiriOwnership* ownership)
{
    kiriRooms rooms;
    bool areFine =
        kiriCheck_StartRooms(check, &rooms, &ownership->triangleOwners, sizeof(kiriTriangleOwner), &ownership->spans);
    for (int32_t s = 0; areFine && s < ownership->squares.count; ++s) {
        areFine = ArePartsOwned(check, ownership, &rooms, &ownership->squares.data[s]);
    }
    kiriMemory_Free(&check->memory, areFine ? rooms.taken : NULL);
    return areFine;
}

/* Triangles that are newer than the owners know which older ones they were split from. */
static bool HaveParents(const kiriOwnership* ownership, const kiriMeshData* mesh)
{
    bool have = true;
    for (int32_t t = ownership->triangleCount; have && t < mesh->triangles.count; ++t) {
        have = !kiriMesh_IsTriangle(mesh, t) || mesh->triangles.data[t].parent != KIRI_NONE;
    }
    return have;
}

bool kiriOwnership_Check(const kiriOwnership* ownership, kiriCheck* check, const kiriMeshData* mesh)
{
    return kiriCheck_Object(check, OwnershipMust, ownership) &&
           kiriCheck_That(check, ownership->squares.count == ownership->isDirty.count &&
                                     ownership->squares.count == check->count[KIRI_OF_SQUARES] &&
                                     HaveParents(ownership, mesh)) &&
           AreOwners(check, ownership);
}
