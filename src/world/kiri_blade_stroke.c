/* What a blade cuts: points are added to the strokes of its tracks, and loops are closed. */
#include "kiri_blade_work.h"

/* Shares of the length of a loop: as near as CLOSING it comes by its beginning; it is closed when it has gone on by
   OVERLAP. */
#define CLOSING 0.015
#define OVERLAP 0.1

/* The stroke of a track, which begins where the track is when its cut is new. KIRI_NONE for memory. */
static int32_t StrokeOf(kiriBladeWork* work, kiriTrack* track)
{
    if (track->stroke == KIRI_NONE) {
        const kiriStroke stroke = { track->sheet, track->cut, false };
        const kiriStrokePoint start = { work->strokes.count, track->rest, track->rest, true };
        if (!kiriArray_Push(&work->memory, &work->strokes, stroke) ||
            (track->cut == NULL && !kiriArray_Push(&work->memory, &work->points, start))) {
            return KIRI_NONE;
        }
        track->stroke = work->strokes.count - 1;
    }
    return track->stroke;
}

static bool AddPoint(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    const kiriStrokePoint point = { StrokeOf(work, track), track->rest, rest, false };
    track->loop.length += kiriRest_Distance(track->rest, rest);
    track->rest = rest;
    return point.stroke != KIRI_NONE && kiriArray_Push(&work->memory, &work->points, point);
}

bool kiriLoop_IsNear(const kiriLoop* loop, kiriVec2 end)
{
    return loop->isOpen && kiriRest_Distance(loop->start, end) < CLOSING * loop->length;
}

/* On the way to a place: it is nearest here, no longer on the way there. */
static void NotePassing(kiriTrack* track, kiriVec2 to)
{
    kiriLoop* loop = &track->loop;
    kiriVec2 way = kiriVec2_Sub(to, track->rest), left = kiriVec2_Sub(loop->start, track->rest);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(left, way) / square : 0.0;
    kiriVec2 near = kiriVec2_Add(track->rest, kiriVec2_Scale(share > 0.0 ? share : 0.0, way));
    if (!loop->isPassed && share <= 1.0 && kiriLoop_IsNear(loop, near)) {
        loop->isPassed = true;
        loop->near = near;
        loop->then = loop->length;
    }
}

/* From where it came by, and back to where it is. */
static bool CloseLoop(kiriBladeWork* work, kiriTrack* track)
{
    int32_t stroke = StrokeOf(work, track);
    const kiriStrokePoint points[3] = { { stroke, track->loop.near, track->loop.near, true },
                                        { stroke, track->loop.near, track->loop.start, false },
                                        { stroke, track->rest, track->rest, true } };
    bool ok = stroke != KIRI_NONE;
    for (int k = 0; ok && k < 3; ++k) {
        ok = kiriArray_Push(&work->memory, &work->points, points[k]);
    }
    track->loop.isOpen = track->loop.isPassed = false;
    return ok;
}

bool kiriTrack_Lead(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    NotePassing(track, rest);
    bool ok = AddPoint(work, track, rest);
    bool hasGoneOn = track->loop.isPassed && track->loop.length > (1.0 + OVERLAP) * track->loop.then;
    return ok && (!hasGoneOn || CloseLoop(work, track));
}

bool kiriTrack_LeadAlong(kiriBladeWork* work, kiriTrack* track)
{
    bool ok = true;
    kiriVec2 start = track->rest;
    for (int32_t i = 0; ok && i < work->path.count; ++i) {
        bool isHere =
            i + 1 < work->path.count && kiriRest_Distance(work->path.data[i], start) < KIRI_BLADE_SAME * work->snap;
        start = isHere ? start : kiriVec2_Make(1e300, 1e300);
        ok = isHere || kiriTrack_Lead(work, track, work->path.data[i]);
    }
    return ok;
}

/* Is there material around the end of a track, though it went over a border? Then it has crossed a cut. */
static bool IsAtLip(const kiriTrack* track)
{
    const kiriMeshData* mesh = &track->sheet->mesh;
    return kiriMesh_Locate(mesh, kiriMesh_Snap(mesh, track->rest)) != KIRI_NONE;
}

bool kiriTrack_End(kiriBladeWork* work, kiriTrack* track)
{
    bool isIdle = track->cut == NULL && track->stroke == KIRI_NONE;
    bool ok = !track->loop.isPassed || IsAtLip(track) || CloseLoop(work, track);
    track->isDone = track->isOver = true;
    if (!isIdle) {
        int32_t stroke = StrokeOf(work, track);
        ok = ok && stroke != KIRI_NONE;
        if (ok) {
            work->strokes.data[stroke].isOver = true;
        }
    }
    return ok;
}
