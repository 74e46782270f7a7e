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
