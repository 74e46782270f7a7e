/* What a blade cuts: points are added to the strokes of its tracks, and loops are closed. */
#include "kiri_blade_work.h"

#include "../mesh/kiri_lip.h"

/* Shares of the length of a loop: as near as CLOSING it comes by its beginning; it is closed when it has gone on by
   OVERLAP. It has come ROUND times as far as it would go straight back: a way out and back encloses nothing. */
#define CLOSING 0.015
#define OVERLAP 0.1
#define ROUND 1.5

/* The stroke of a track, which begins where the track is when its cut is new. KIRI_NONE for memory. */
static int32_t StrokeOf(kiriBladeWork* work, kiriTrack* track)
{
    if (track->stroke == KIRI_NONE) {
        const kiriStroke stroke = { track->sheet, track->cut, false };
        const kiriStrokePoint start = { work->strokes.count, track->rest, true };
        if (!kiriArray_Push(&work->memory, &work->strokes, stroke) ||
            (track->cut == NULL && !kiriArray_Push(&work->memory, &work->points, start))) {
            return KIRI_NONE;
        }
        track->stroke = work->strokes.count - 1;
    }
    return track->stroke;
}

static bool AddCut(kiriBladeWork* work, int32_t stroke, kiriVec2 from, kiriVec2 to)
{
    const kiriStrokePoint point = { stroke, to, false };
    const kiriPendingLip lip = { work->sheet, from, to, stroke };
    return kiriArray_Push(&work->memory, &work->points, point) && kiriArray_Push(&work->memory, &work->pending, lip);
}

static bool AddStart(kiriBladeWork* work, int32_t stroke, kiriVec2 rest)
{
    const kiriStrokePoint point = { stroke, rest, true };
    return kiriArray_Push(&work->memory, &work->points, point);
}

static bool AddPoint(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    int32_t stroke = StrokeOf(work, track);
    kiriVec2 from = track->rest;
    track->loop.length += kiriRest_Distance(from, rest);
    track->rest = rest;
    return stroke != KIRI_NONE && AddCut(work, stroke, from, rest);
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
    bool isRound = loop->length > ROUND * kiriRest_Distance(track->rest, near);
    if (!loop->isPassed && share <= 1.0 && isRound && kiriLoop_IsNear(loop, near)) {
        loop->isPassed = true;
        loop->near = near;
        loop->then = loop->length;
    }
}

/* From where it came by, and back to where it is. */
static bool CloseLoop(kiriBladeWork* work, kiriTrack* track)
{
    int32_t stroke = StrokeOf(work, track);
    bool ok = stroke != KIRI_NONE && AddStart(work, stroke, track->loop.near) &&
              AddCut(work, stroke, track->loop.near, track->loop.start) && AddStart(work, stroke, track->rest);
    track->loop.isOpen = track->loop.isPassed = false;
    return ok;
}

/* ---- An edge that is held ---- */

/* Snap distances: a way that stays nearer to lips than BESIDE_LIP is in a slit, and so is an edge that is held nearer to one
   than SLIT. Points nearer to a lip than ON_LIP are on it. */
#define BESIDE_LIP 1.5
#define ON_LIP 0.75
#define SLIT 64.0

kiriVec2 kiriRest_Foot(kiriVec2 a, kiriVec2 b, kiriVec2 p)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(kiriVec2_Sub(p, a), way) / square : 0.0;
    return kiriVec2_Add(a, kiriVec2_Scale(share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share, way));
}

static void FindLipInTriangle(const kiriMeshData* mesh, int32_t triangle, kiriVec2 rest, bool isOpen, double* distance,
                              kiriVec2* lip)
{
    for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        if (kiriMesh_Twin(mesh, h) == KIRI_NONE || (isOpen && kiriMesh_IsOpen(mesh, h))) {
            kiriVec2 foot = kiriRest_Foot(
                kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at),
                kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at), rest);
            double d = kiriRest_Distance(foot, rest);
            *lip = d < *distance ? foot : *lip;
            *distance = d < *distance ? d : *distance;
        }
    }
}

bool kiriBlade_FindLip(const kiriMeshData* mesh, kiriVec2 rest, double distance, bool isOpen, kiriVec2* lip)
{
    kiriLatticePoint at = kiriMesh_Snap(mesh, rest);
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, at, at, distance / mesh->step);
    double least = distance;
    while (kiriStrips_Next(&strips)) {
        for (int32_t i = 0; i < strips.count; ++i) {
            int32_t slot = mesh->squares.head[strips.square + i * strips.stride];
            for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
                FindLipInTriangle(mesh, mesh->squares.nodes.data[slot].triangle, rest, isOpen, &least, lip);
            }
        }
    }
    return least < distance;
}

bool kiriBlade_FindSlit(const kiriBladeWork* work, kiriVec2 rest, double distance, kiriVec2* slit)
{
    bool isFound = kiriBlade_FindLip(&work->sheet->mesh, rest, distance, true, slit);
    distance = isFound ? kiriRest_Distance(*slit, rest) : distance;
    for (int32_t i = 0; i < work->pending.count; ++i) {
        const kiriPendingLip* lip = &work->pending.data[i];
        kiriVec2 foot = kiriRest_Foot(lip->from, lip->to, rest);
        if (lip->sheet == work->sheet && kiriRest_Distance(foot, rest) < distance) {
            distance = kiriRest_Distance(foot, rest);
            *slit = foot;
            isFound = true;
        }
    }
    return isFound;
}

/* Shortens a loop to the straight way from its start. */
static void StraightenLoop(kiriTrack* track)
{
    track->loop.isPassed = false;
    track->loop.length = kiriRest_Distance(track->loop.start, track->rest);
}

/* Puts a track elsewhere in the slit. */
static bool Slide(kiriBladeWork* work, kiriTrack* track, kiriVec2 slit)
{
    track->rest = slit;
    StraightenLoop(track);
    if (track->cut == NULL && track->stroke == KIRI_NONE) {
        return true;
    }
    int32_t stroke = StrokeOf(work, track);
    return stroke != KIRI_NONE && AddStart(work, stroke, slit);
}

/* The edge slides in slits that are near instead of cutting beside them. Where it is nearer to the outline it cuts to
   it. */
static bool LeadHeld(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    enum { MOST = 64 };
    const kiriMeshData* mesh = &work->sheet->mesh;
    double near = SLIT * work->snap, length = kiriRest_Distance(track->rest, rest);
    int32_t count = length < 0.5 * MOST * near ? 1 + (int32_t)(length / (0.5 * near)) : 1;
    kiriVec2 from = track->rest;
    bool ok = true;
    for (int32_t i = 1; ok && i <= count; ++i) {
        kiriVec2 at = kiriVec2_Add(from, kiriVec2_Scale((double)i / count, kiriVec2_Sub(rest, from)));
        kiriVec2 slit, other, here;
        bool isNear = kiriBlade_FindSlit(work, at, near, &slit);
        if (!isNear && kiriBlade_FindSlit(work, at, 2.0 * near, &slit)) {
            ok = (kiriRest_Distance(slit, track->rest) < work->snap || Slide(work, track, slit)) &&
                 AddPoint(work, track, at);
        } else if (!isNear) {
            ok = AddPoint(work, track, at);
        } else if (kiriBlade_FindLip(mesh, at, near, false, &other) &&
                   !kiriBlade_FindLip(mesh, track->rest, work->snap, false, &here)) {
            ok = AddPoint(work, track, at) && AddPoint(work, track, other);
        } else if (!kiriBlade_FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(track->rest, slit)), 0.25 * near,
                                       &other)) {
            ok = AddPoint(work, track, at) && AddPoint(work, track, slit);
        } else if (kiriRest_Distance(slit, track->rest) > work->snap) {
            ok = Slide(work, track, slit);
        }
    }
    StraightenLoop(track);
    return ok;
}

/* ---- Ways ---- */

/* Follows a slit along a way that keeps to it. There is nothing to cut then, and the track goes on from the slit itself,
   not from beside it. The feet of points a snap apart must lead along lips: one that jumps to another slit would leave
   a bridge between the slits. A way to the outline is cut, so that it parts. */
static bool IsInSlit(const kiriBladeWork* work, kiriVec2 from, kiriVec2 to, kiriVec2* end)
{
    enum { MOST_PLACES = 4096 };
    double length = kiriRest_Distance(from, to) / work->snap;
    int32_t places = 1 + (int32_t)fmin(length, MOST_PLACES);
    kiriVec2 slit, last;
    bool isInSlit = places <= MOST_PLACES && kiriBlade_FindSlit(work, to, BESIDE_LIP * work->snap, end) &&
                    !kiriBlade_FindLip(&work->sheet->mesh, to, 2.0 * BESIDE_LIP * work->snap, false, &slit);
    last = *end;
    for (int32_t i = places - 1; isInSlit && i >= 0; --i) {
        kiriVec2 at = kiriVec2_Add(from, kiriVec2_Scale((double)i / places, kiriVec2_Sub(to, from)));
        isInSlit = kiriBlade_FindSlit(work, at, BESIDE_LIP * work->snap, &slit) &&
                   kiriBlade_FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(last, slit)), ON_LIP * work->snap, &last);
        last = slit;
    }
    return isInSlit;
}

bool kiriTrack_Lead(kiriBladeWork* work, kiriTrack* track, kiriVec2 rest)
{
    if (work->isHeld) {
        return LeadHeld(work, track, rest);
    }
    kiriVec2 slit;
    if (IsInSlit(work, track->rest, rest, &slit)) {
        return Slide(work, track, slit);
    }
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

/* ---- The end ---- */

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
