#include "kiri_blade.h"
#include "kiri_call.h"
#include "../mesh/kiri_lip.h"
#include "../sheet/kiri_seen.h"

/* A move of a blade is worked out first. Nothing in the world changes before all of it is known and room is made. */

/* The points that one cut gets. */
typedef struct Stroke {
    kiriSheetData* sheet;
    kiriCutData* cut; /* without a sheet: a new one, in a block of the move */
    bool isOver;      /* the cut ends */
} Stroke;

typedef struct StrokePoint {
    int32_t stroke;
    kiriVec2 rest;
    bool isStart;
} StrokePoint;

/* A cut that is not in the mesh yet: local rest points. */
typedef struct PendingLip {
    const kiriSheetData* sheet;
    kiriVec2 from, to;
    int32_t stroke; /* KIRI_NONE: in the queue */
} PendingLip;

/* A layer during a move. */
typedef struct Track {
    kiriSheetData* sheet;
    kiriCutData* cut; /* or null */
    int32_t stroke;   /* or KIRI_NONE: it has got no point yet */
    kiriVec2 rest, met;
    kiriVec3 at;
    kiriLoop loop;
    bool isOver; /* the blade is out of the layer */
    bool isLost; /* its layer was not found again; another track may continue it */

    /* In a step. */
    bool isSeen;
    kiriVec3 seen; /* where its place is seen */
    kiriVec3 more; /* its place came this much farther than its triangle */
} Track;

typedef struct BladeWork {
    kiriMemory memory;
    KIRI_ARRAY(Track) tracks;
    KIRI_ARRAY(Stroke) strokes;
    KIRI_ARRAY(StrokePoint) points;
    KIRI_ARRAY(PendingLip) pending; /* of the queues, then of this move */

    /* One step for one sheet. */
    kiriVec3 was[2], is[2]; /* the edge */
    int32_t ticks;          /* since the edge was there */
    kiriSheetData* sheet;
    double snap;      /* m */
    bool isHeld;      /* the edge stays: only the material moves */
    bool isMessy;     /* the edge is in many layers, for it lies in the sheet: its ways mean little */
    bool joins;       /* else and if it moves: ways that begin or end amid the material go on to other ways */
    bool isKnown;     /* where the material was when the edge was there */
    double unseen;    /* m: the farthest that an unseen way may go */
    int32_t oldCount; /* tracks before the step */
    int32_t crossings; /* of the edge as it is */
    int32_t firstPending;
    kiriSection section;
    kiriIndices taker; /* of each end of a line, first and last: the track that goes on from it, or KIRI_NONE */
    kiriRestPoints path;
} BladeWork;

/* Distances in the rest plane, in snap distances. */
#define SAME 2.0       /* places nearer than this are one; a layer that moved less is not led on */
#define STRAIGHT 0.25  /* tolerance of straight ways */
#define DEGENERATE 0.25
#define BESIDE_LIP 3.0 /* a way that stays nearer to lips is in a slit */
#define ON_LIP 0.75    /* points nearer to a lip are on it */
#define FOUND 8.0      /* a layer goes on this near to where its track is; more than this counts a place beside it */
#define SLIT 64.0      /* an edge that stays nearer to a slit slides in it */

/* Between two slits no lip is nearer to the middle than this share of their distance; between two places of one slit a lip
   is nearer than BETWEEN, unless the slit turns back. */
#define ACROSS 0.3
#define BETWEEN 0.45

/* The farthest that an unseen way may go, as a share of the sheet's longer side. */
#define UNSEEN 0.125

/* Shares of the length of a loop: it passes its beginning nearer than CLOSING, and is closed OVERLAP later. It is ROUND
   times as long as the straight way back: a way out and back encloses nothing. */
#define CLOSING 0.015
#define OVERLAP 0.1
#define ROUND 1.5

/* ---- Strokes ----------------------------------------------------------------------------------------------------- */

static bool AddStart(BladeWork* work, int32_t stroke, kiriVec2 rest)
{
    const StrokePoint point = { stroke, rest, true };
    return kiriArray_Push(&work->memory, &work->points, point);
}

/* Returns the stroke of a track. A new cut begins where the track is. KIRI_NONE for memory. */
static int32_t StrokeOf(BladeWork* work, Track* track)
{
    KIRI_ASSERT(track->sheet == work->sheet && track->stroke < work->strokes.count);
    if (track->stroke == KIRI_NONE) {
        bool isNew = track->cut == NULL;
        kiriCutData* cut = isNew ? kiriMemory_AllocZeroed(&work->memory, sizeof(*cut)) : track->cut;
        const Stroke stroke = { track->sheet, cut, false };
        if (cut == NULL || !kiriArray_Push(&work->memory, &work->strokes, stroke) ||
            (isNew && !AddStart(work, work->strokes.count - 1, track->rest))) {
            return KIRI_NONE;
        }
        track->stroke = work->strokes.count - 1;
    }
    return track->stroke;
}

static bool AddCut(BladeWork* work, int32_t stroke, kiriVec2 from, kiriVec2 to)
{
    KIRI_ASSERT_HAS(work->strokes, stroke);
    const StrokePoint point = { stroke, to, false };
    const PendingLip lip = { work->sheet, from, to, stroke };
    return kiriArray_Push(&work->memory, &work->points, point) && kiriArray_Push(&work->memory, &work->pending, lip);
}

static bool AddTrackPoint(BladeWork* work, Track* track, kiriVec2 rest)
{
    int32_t stroke = StrokeOf(work, track);
    kiriVec2 from = track->rest;
    track->loop.length += kiriVec2_Distance(from, rest);
    track->rest = rest;
    return stroke != KIRI_NONE && AddCut(work, stroke, from, rest);
}

/* True if the end of the cut is so near to its beginning that it may be closed. */
static bool IsLoopNear(const kiriLoop* loop, kiriVec2 end)
{
    return loop->isOpen && kiriVec2_Distance(loop->start, end) < CLOSING * loop->length;
}

/* Notes where the way of a track to a place passes the beginning of its loop. */
static void NotePassing(Track* track, kiriVec2 to)
{
    kiriLoop* loop = &track->loop;
    kiriVec2 way = kiriVec2_Sub(to, track->rest), left = kiriVec2_Sub(loop->start, track->rest);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(left, way) / square : 0.0;
    kiriVec2 near = kiriVec2_AddScaled(track->rest, kiriMax(share, 0.0), way);
    bool isRound = loop->length > ROUND * kiriVec2_Distance(track->rest, near);
    if (!loop->isPassed && share <= 1.0 && isRound && IsLoopNear(loop, near)) {
        loop->isPassed = true;
        loop->near = near;
        loop->then = loop->length;
    }
}

/* Cuts from where the loop passed to its beginning; then the track goes on where it is. */
static bool CloseLoop(BladeWork* work, Track* track)
{
    int32_t stroke = StrokeOf(work, track);
    bool ok = stroke != KIRI_NONE && AddStart(work, stroke, track->loop.near) &&
              AddCut(work, stroke, track->loop.near, track->loop.start) && AddStart(work, stroke, track->rest);
    track->loop.isOpen = track->loop.isPassed = false;
    return ok;
}

/* ---- An edge that is held ---- */

/* Returns the point of the segment from a to b that is nearest to p. */
static kiriVec2 FootOnWay(kiriVec2 a, kiriVec2 b, kiriVec2 p)
{
    return kiriVec2_AddScaled(a, kiriVec2_PartOnWay(p, a, b), kiriVec2_Sub(b, a));
}

static bool FindSlit(const BladeWork* work, kiriVec2 rest, double distance, kiriVec2* slit);

/* The edges that FindLipNear looks for: the outline, lips too, or lips of other slits than the place is on. There is
   material half-way to such a lip. */
enum { OUTLINE, OUTLINE_AND_LIPS, OUTLINE_AND_LIPS_ACROSS };

static void FindLipInTriangle(const BladeWork* work, int32_t triangle, kiriVec2 rest, int which, double* distance,
                              kiriVec2* lip)
{
    const kiriMeshData* mesh = &work->sheet->mesh;
    KIRI_FROM_TO(h, 3 * triangle, 3 * triangle + 3) {
        bool isOutline = kiriMesh_Twin(mesh, h) == KIRI_NONE;
        if (!isOutline && (which == OUTLINE || !kiriMesh_IsOpen(mesh, h))) {
            continue;
        }
        kiriVec2 foot = FootOnWay(kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, h)),
                                  kiriMesh_Local(mesh, kiriMesh_HeadAt(mesh, h)), rest);
        kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(rest, foot)), slit;
        double d = kiriVec2_Distance(foot, rest);
        if (d < *distance && (isOutline || which == OUTLINE_AND_LIPS ||
                              (d > work->snap && !FindSlit(work, middle, ACROSS * d, &slit)))) {
            *lip = foot;
            *distance = d;
        }
    }
}

static kiriNearby LookAround(const BladeWork* work, kiriVec2 rest, double distance)
{
    const kiriMeshData* mesh = &work->sheet->mesh;
    kiriLatticePoint at = kiriMesh_Snap(mesh, rest);
    return kiriNearby_Begin(&mesh->squares, at, at, distance / mesh->step);
}

/* Finds the point of these edges that is nearest to a place, up to a distance (m). */
static bool FindLipNear(const BladeWork* work, kiriVec2 rest, double distance, int which, kiriVec2* lip)
{
    double least = distance;
    kiriNearby around = LookAround(work, rest, distance);
    KIRI_EACH_NEARBY(t, around) {
        FindLipInTriangle(work, t, rest, which, &least, lip);
    }
    return least < distance;
}

/* Finds the nearest point of the pending cuts of the sheet from one index on, but for one stroke, up to a distance. */
enum { NO_STROKE = -2 };

static bool FindPending(const BladeWork* work, int32_t first, int32_t except, kiriVec2 rest, double distance,
                        kiriVec2* place)
{
    bool isFound = false;
    KIRI_ASSERT(first >= 0 && first <= work->pending.count);
    KIRI_FROM_TO(i, first, work->pending.count) {
        const PendingLip* lip = &work->pending.data[i];
        kiriVec2 foot = FootOnWay(lip->from, lip->to, rest);
        double d = kiriVec2_Distance(foot, rest);
        if (lip->sheet == work->sheet && lip->stroke != except && d < distance) {
            distance = d;
            *place = foot;
            isFound = true;
        }
    }
    return isFound;
}

/* Finds the nearest point of the lips of the sheet, in the mesh or pending, up to a distance (m). */
static bool FindSlit(const BladeWork* work, kiriVec2 rest, double distance, kiriVec2* slit)
{
    bool isFound = FindLipNear(work, rest, distance, OUTLINE_AND_LIPS, slit);
    distance = isFound ? kiriVec2_Distance(*slit, rest) : distance;
    return FindPending(work, 0, NO_STROKE, rest, distance, slit) || isFound;
}

/* Puts a track elsewhere in the slit. */
static bool Slide(BladeWork* work, Track* track, kiriVec2 slit)
{
    track->loop.length += kiriVec2_Distance(track->rest, slit);
    track->rest = slit;
    if (track->cut == NULL && track->stroke == KIRI_NONE) {
        return true;
    }
    int32_t stroke = StrokeOf(work, track);
    return stroke != KIRI_NONE && AddStart(work, stroke, slit);
}

/* Leads a track of an edge that stays: it slides in slits that are near instead of cutting beside them. Where the
   outline is nearer it cuts to it. */
static bool LeadHeld(BladeWork* work, Track* track, kiriVec2 rest)
{
    enum { MOST = 64 };
    double near = SLIT * work->snap, length = kiriVec2_Distance(track->rest, rest);
    int32_t count = length < 0.5 * MOST * near ? 1 + (int32_t)(length / (0.5 * near)) : 1;
    kiriVec2 from = track->rest;
    bool ok = true;
    for (int32_t i = 1; ok && i <= count; ++i) {
        kiriVec2 at = kiriVec2_AddScaled(from, (double)i / count, kiriVec2_Sub(rest, from));
        kiriVec2 slit, other, here;
        bool isNear = FindSlit(work, at, near, &slit);
        if (!isNear && FindSlit(work, at, 2.0 * near, &slit)) {
            ok = (kiriVec2_Distance(slit, track->rest) < work->snap || Slide(work, track, slit)) &&
                 AddTrackPoint(work, track, at);
        } else if (!isNear) {
            ok = AddTrackPoint(work, track, at);
        } else if (FindLipNear(work, at, near, OUTLINE, &other) &&
                   !FindLipNear(work, track->rest, work->snap, OUTLINE, &here)) {
            ok = AddTrackPoint(work, track, at) && AddTrackPoint(work, track, other);
        } else if (!FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(track->rest, slit)), 0.25 * near,
                                       &other)) {
            ok = AddTrackPoint(work, track, at) && AddTrackPoint(work, track, slit);
        } else if (kiriVec2_Distance(slit, track->rest) > work->snap) {
            ok = Slide(work, track, slit);
        }
    }
    track->loop.isPassed = false;
    track->loop.length = kiriVec2_Distance(track->loop.start, track->rest);
    return ok;
}

/* ---- Ways ---- */

/* Follows a slit along a way that keeps to it. There is nothing to cut then, and the track goes on from the slit
   itself, not from beside it. The feet of points a snap apart must lead along lips: one that jumps to another slit
   would leave a bridge between the slits. A way to the outline is cut, so that it parts. */
static bool IsInSlit(const BladeWork* work, kiriVec2 from, kiriVec2 to, kiriVec2* end, kiriVec2* start)
{
    enum { MOST_PLACES = 4096 };
    double length = kiriVec2_Distance(from, to) / work->snap;
    int32_t places = 1 + (int32_t)fmin(length, MOST_PLACES);
    kiriVec2 slit, middle;
    bool isInSlit = places <= MOST_PLACES && FindSlit(work, to, BESIDE_LIP * work->snap, end) &&
                    !FindLipNear(work, to, 2.0 * BESIDE_LIP * work->snap, OUTLINE, &slit);
    *start = *end;
    for (int32_t i = places - 1; isInSlit && i >= 0; --i) {
        kiriVec2 at = kiriVec2_AddScaled(from, (double)i / places, kiriVec2_Sub(to, from));
        isInSlit = FindSlit(work, at, BESIDE_LIP * work->snap, &slit) &&
                   FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(*start, slit)),
                            kiriMin(ON_LIP * work->snap, BETWEEN * kiriVec2_Distance(*start, slit) + 0.01 * work->snap),
                            &middle);
        *start = slit;
    }
    return isInSlit;
}

static bool LeadTrack(BladeWork* work, Track* track, kiriVec2 rest)
{
    if (work->isHeld) {
        return LeadHeld(work, track, rest);
    }
    kiriVec2 slit, foot;
    if (IsInSlit(work, track->rest, rest, &slit, &foot)) {
        bool isOn = kiriVec2_Distance(track->rest, foot) < ON_LIP * work->snap;
        return (isOn || AddTrackPoint(work, track, foot)) &&
               Slide(work, track, slit);
    }
    NotePassing(track, rest);
    bool ok = AddTrackPoint(work, track, rest);
    bool hasGoneOn = track->loop.isPassed && track->loop.length > (1.0 + OVERLAP) * track->loop.then;
    return ok && (!hasGoneOn || CloseLoop(work, track));
}

static bool LeadAlong(BladeWork* work, Track* track)
{
    bool ok = true;
    kiriVec2 start = track->rest;
    KIRI_EACH_INDEX_WHILE(ok, i, work->path) {
        bool isHere = i + 1 < work->path.count && kiriVec2_Distance(work->path.data[i], start) < SAME * work->snap;
        start = isHere ? start : kiriVec2_Make(1e300, 1e300);
        ok = isHere || LeadTrack(work, track, work->path.data[i]);
    }
    return ok;
}

/* ---- The end ---- */

/* Ends the cut of a track: the blade is out of the layer. A loop is closed, unless there is material around the end of
   the track: then it has crossed a cut. False for memory. */
static bool EndTrack(BladeWork* work, Track* track)
{
    const kiriMeshData* mesh = &track->sheet->mesh;
    bool isIdle = track->cut == NULL && track->stroke == KIRI_NONE;
    bool ok = !track->loop.isPassed || kiriMesh_Locate(mesh, kiriMesh_Snap(mesh, track->rest)) != KIRI_NONE ||
              CloseLoop(work, track);
    track->isOver = true;
    if (!isIdle) {
        int32_t stroke = StrokeOf(work, track);
        ok = ok && stroke != KIRI_NONE;
        if (ok) {
            work->strokes.data[stroke].isOver = true;
        }
    }
    return ok;
}

/* Finds where a way goes on that begins or ends amid the material: at the outline, at another slit or at another way of
   this step, whichever is nearest. An edge that has left the whole sheet left it over the outline, if that is near. */
static bool FindOther(const BladeWork* work, kiriVec2 rest, int32_t stroke, double near, kiriVec2* place)
{
    if (work->crossings == 0 && FindLipNear(work, rest, near, OUTLINE, place)) {
        return true;
    }
    bool isFound = FindLipNear(work, rest, near, work->joins ? OUTLINE_AND_LIPS_ACROSS : OUTLINE, place);
    near = isFound ? kiriVec2_Distance(rest, *place) : near;
    return FindPending(work, work->firstPending, stroke, rest, near, place) || isFound;
}

/* ---- Places in the material ---- */

/* Returns the point of a triangle that is nearest to a place, and writes the shares of its corners. */
static kiriVec2 NearestInTriangle(const kiriVec2 corner[3], kiriVec2 p, double shares[3])
{
    kiriVec2 nearest = p;
    bool isIn = true;
    KIRI_TIMES(k, 3) {
        kiriVec2 a = corner[k], b = corner[(k + 1) % 3], foot = FootOnWay(a, b, p);
        if (kiriVec2_Cross(kiriVec2_Sub(b, a), kiriVec2_Sub(p, a)) < 0.0 &&
            (isIn || kiriVec2_Distance(foot, p) < kiriVec2_Distance(nearest, p))) {
            nearest = foot;
            isIn = false;
        }
    }
    kiriVec2 ab = kiriVec2_Sub(corner[1], corner[0]), ac = kiriVec2_Sub(corner[2], corner[0]);
    kiriVec2 ap = kiriVec2_Sub(nearest, corner[0]);
    shares[1] = kiriVec2_Cross(ap, ac) / kiriVec2_Cross(ab, ac);
    shares[2] = kiriVec2_Cross(ab, ap) / kiriVec2_Cross(ab, ac);
    shares[0] = 1.0 - shares[1] - shares[2];
    return nearest;
}

/* Finds where the place of a track in the material is seen, and how much farther it came than the last tick tells. Near a
   lip there are places on both sides, and a piece that came off may have fallen far: the one that came as expected is
   taken. The place is not seen where the sheet has no material, or just a piece that is elsewhere. */
static void FindPlace(const BladeWork* work, Track* track)
{
    const kiriSheetData* sheet = work->sheet;
    const kiriSurface* surface = &sheet->seen.surface;
    double best = work->unseen, near = SAME * work->snap;
    kiriNearby around = LookAround(work, track->rest, near);
    track->isSeen = false;
    KIRI_EACH_NEARBY(t, around) {
        const int32_t* v = sheet->mesh.triangles.data[t].vertex;
        const kiriVec2 corner[3] = { surface->rest.data[v[0]], surface->rest.data[v[1]], surface->rest.data[v[2]] };
        double shares[3], off = kiriVec2_Distance(NearestInTriangle(corner, track->rest, shares), track->rest);
        kiriVec3 seen = kiriSurface_Blend(surface, v, shares), came = { 0 };
        KIRI_TIMES(k, 3) {
            came = kiriVec3_AddScaled(came, work->ticks * shares[k], kiriSurface_Came(surface, v[k]));
        }
        kiriVec3 more = kiriVec3_Sub(kiriVec3_Sub(seen, track->at), came);
        double cost = kiriVec3_Length(more) + FOUND * off;
        if (off < near && cost < best) {
            best = cost;
            track->isSeen = true;
            track->seen = seen;
            track->more = more;
        }
    }
}

/* Returns how far a vertex came since the edge was at its last place. If that is not known, it came as the tracks did. */
static kiriVec3 CameOf(const void* context, int32_t vertex)
{
    const BladeWork* work = context;
    kiriVec3 sum = { 0 };
    double weights = 0.0;
    KIRI_TIMES_WHILE(!work->isKnown, i, work->oldCount) {
        const Track* track = &work->tracks.data[i];
        if (track->sheet == work->sheet && track->isSeen) {
            kiriVec2 way = kiriVec2_Sub(work->sheet->seen.surface.rest.data[vertex], track->rest);
            double weight = 1.0 / (kiriVec2_Dot(way, way) + work->snap * work->snap);
            sum = kiriVec3_AddScaled(sum, weight, track->more);
            weights += weight;
        }
    }
    sum = weights > 0.0 ? kiriVec3_Scale(1.0 / weights, sum) : sum;
    return kiriVec3_AddScaled(sum, work->ticks, kiriSurface_Came(&work->sheet->seen.surface, vertex));
}

/* Returns false for a line that stays at a place: where a track is in its slit, rounding tells on which side it begins. */
static bool IsLong(const BladeWork* work, const kiriSectionLine* line)
{
    const kiriSectionPoint* points = &work->section.points.data[line->first];
    bool isLong = line->end[0] == KIRI_END_TO || line->end[1] == KIRI_END_TO;
    KIRI_FROM_TO_WHILE(!isLong, k, 1, line->count) {
        isLong = kiriVec2_Distance(points[k].rest, points[0].rest) > DEGENERATE * work->snap;
    }
    return isLong;
}

/* Finds the lines that the edge draws in this step. */
static bool FindLines(BladeWork* work)
{
    kiriSheetData* sheet = work->sheet;
    kiriSweep sweep = { { work->was[0], work->was[1] }, { work->is[0], work->is[1] }, CameOf, work, 0.0 };
    if (!kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface)) {
        return false;
    }
    work->isKnown = work->ticks == 0 || (work->ticks == 1 && sheet->seen.surface.before.count > 0);
    KIRI_TIMES(i, work->oldCount) {
        Track* track = &work->tracks.data[i];
        if (track->sheet == sheet) {
            FindPlace(work, track);
            sweep.reach =
                track->isSeen && !work->isKnown ? kiriMax(sweep.reach, kiriVec3_Length(track->more)) : sweep.reach;
        }
    }
    double most = 0.0;
    KIRI_TIMES_WHILE(work->ticks > 0, v, sheet->seen.surface.vertexCount) {
        kiriVec3 came = kiriSurface_Came(&sheet->seen.surface, v);
        most = kiriMax(most, kiriVec3_Dot(came, came));
    }
    sweep.reach += work->ticks * kiriRoot(most);
    return kiriSection_Sweep(&work->section, &work->memory, &sheet->seen.surface, sheet->seen.bounds, &sweep);
}

/* ---- Lines and tracks ---- */

static const kiriSectionPoint* EndOfLine(const BladeWork* work, const kiriSectionLine* line, int end)
{
    return &work->section.points.data[line->first + (end == 1 ? line->count - 1 : 0)];
}

/* Gives a track the nearest end of a line from which it goes on: where the edge was, or a border beside the track, which
   the edge was on. `most`: m. */
static void MatchTrack(BladeWork* work, int32_t index, double most)
{
    Track* track = &work->tracks.data[index];
    kiriVec2 from = work->isKnown ? track->met : track->rest;
    int32_t nearest = KIRI_NONE;
    KIRI_EACH_INDEX(i, work->taker) {
        const kiriSectionLine* line = &work->section.lines.data[i / 2];
        int32_t type = line->end[i % 2];
        double far = type == KIRI_END_FROM ? most : type == KIRI_END_BORDER ? kiriMin(most, SAME * work->snap) : 0.0;
        double d = far > 0.0 ? kiriVec2_Distance(EndOfLine(work, line, i % 2)->rest, from) : 1e300;
        if (d < far && work->taker.data[i] == KIRI_NONE) {
            most = d;
            nearest = i;
        }
    }
    if (nearest != KIRI_NONE) {
        work->taker.data[nearest] = index;
        track->isLost = false;
    }
}

/* Finds the nearest lost track of the last step, up to a distance in the rest plane, but one, or returns null. */
static Track* NearestLost(const BladeWork* work, const Track* except, kiriVec2 rest, double distance)
{
    Track* nearest = NULL;
    KIRI_ASSERT(work->oldCount <= work->tracks.count);
    KIRI_TIMES(i, work->oldCount) {
        Track* track = &work->tracks.data[i];
        double d = kiriVec2_Distance(track->rest, rest);
        if (track->sheet == work->sheet && track->isLost && track != except && (except == NULL || !track->isOver) &&
            d <= distance) {
            distance = d;
            nearest = track;
        }
    }
    return nearest;
}

static kiriLoop LoopFrom(kiriVec2 rest, bool isOpen)
{
    const kiriLoop loop = { isOpen, false, rest, rest, 0.0, 0.0 };
    return loop;
}

/* Says where the edge met the layer of a track. */
static void MeetTrack(Track* track, const kiriSectionPoint* point)
{
    track->met = point->rest;
    track->at = point->at;
}

static bool AddTrack(BladeWork* work, kiriVec2 rest, kiriLoop loop)
{
    const Track track = { .sheet = work->sheet, .stroke = KIRI_NONE, .rest = rest, .loop = loop };
    return kiriArray_Push(&work->memory, &work->tracks, track);
}

/* Begins a track where no other one went on from. The edge comes into a layer over a border, but for its ends: amid the
   material the cut goes on from something near, or is a loop that is open. */
static bool BeginTrack(BladeWork* work, const kiriSectionLine* line, int begin)
{
    int32_t type = line->end[begin];
    kiriVec2 from = work->path.data[0];
    double way = kiriVec2_Distance(EndOfLine(work, line, 0)->rest, EndOfLine(work, line, 1)->rest);
    double near = kiriMin(2.0 * way + FOUND * work->snap, work->unseen);
    const Track* lost = type == KIRI_END_FROM ? NearestLost(work, NULL, from, work->joins ? work->unseen : near) : NULL;
    from = lost != NULL ? lost->rest : from;
    KIRI_ASSERT(work->path.count > 0 && type >= KIRI_END_FROM && type <= KIRI_END_LOOP);
    bool isAmid = (type == KIRI_END_FROM && lost == NULL) || type == KIRI_END_FIRST || type == KIRI_END_SECOND;
    bool isFound = isAmid && work->joins && FindOther(work, from, KIRI_NONE, near, &from);
    if ((isAmid && !isFound) || type == KIRI_END_TO) {
        isFound = FindSlit(work, from, BESIDE_LIP * work->snap, &from);
    }
    return AddTrack(work, from, lost != NULL ? lost->loop : LoopFrom(from, isAmid && !isFound));
}

/* The order in which the ends of a line are its begin. */
static int RankOf(const BladeWork* work, int32_t end)
{
    static const int ranks[] = { [KIRI_END_FROM] = 1,   [KIRI_END_BORDER] = 2, [KIRI_END_FIRST] = 3,
                                 [KIRI_END_SECOND] = 3, [KIRI_END_TO] = 4,     [KIRI_END_LOOP] = 5 };
    return work->taker.data[end] != KIRI_NONE ? 0 : ranks[work->section.lines.data[end / 2].end[end % 2]];
}

/* Cuts along a line: with the track that goes on from its begin, or a new one. It ends at the edge as it is now, beyond a
   border, where the blade ended, or, over a fold, at another layer that the blade was in. */
static bool FollowLine(BladeWork* work, int32_t index)
{
    const kiriSectionLine* line = &work->section.lines.data[index];
    int begin = RankOf(work, 2 * index) <= RankOf(work, 2 * index + 1) ? 0 : 1;
    int32_t track = work->taker.data[2 * index + begin], other = work->taker.data[2 * index + 1 - begin];
    int32_t type = line->end[1 - begin];
    if (track == KIRI_NONE && line->end[begin] == KIRI_END_FROM && type != KIRI_END_TO) {
        return true; /* no layer was there: the material moved otherwise */
    }
    KIRI_ASSERT(line->first >= 0 && line->count >= 2 && line->first + line->count <= work->section.points.count);
    work->path.count = 0;
    if (!kiriSection_Path(&work->section, line, begin == 1, STRAIGHT * work->snap, &work->memory, &work->path) ||
        (track == KIRI_NONE && !BeginTrack(work, line, begin))) {
        return false;
    }
    track = track == KIRI_NONE ? work->tracks.count - 1 : track;
    if (line->end[begin] == KIRI_END_TO) {
        kiriVec2 from = work->tracks.data[track].rest;
        if (!AddTrack(work, from, LoopFrom(from, false))) {
            return false;
        }
        MeetTrack(&work->tracks.data[work->tracks.count - 1], EndOfLine(work, line, begin));
    }
    const kiriSectionPoint* end = EndOfLine(work, line, 1 - begin);
    Track* led = &work->tracks.data[track];
    /* A short way of a layer that was there may wait; one that joins two new layers is cut now. */
    bool isStill = type == KIRI_END_TO && line->end[begin] != KIRI_END_TO &&
                   kiriVec2_Distance(led->rest, end->rest) < SAME * work->snap;
    bool ok = isStill || LeadAlong(work, led);
    if (type == KIRI_END_TO || (type == KIRI_END_FROM && other == KIRI_NONE)) {
        led->isLost = type == KIRI_END_FROM;
        led->seen = end->at;
        MeetTrack(led, end);
        return ok;
    }
    if (other != KIRI_NONE) {
        ok = ok && LeadTrack(work, led, work->tracks.data[other].rest) && EndTrack(work, &work->tracks.data[other]);
    }
    return ok && EndTrack(work, led);
}

/* Ends a layer that the edge has left. It left over a border, or entered again on another way: where one of these is
   near, the cut goes on to it. */
static bool EndLost(BladeWork* work, Track* track)
{
    kiriVec2 place;
    bool ok = true;
    KIRI_ASSERT(track->isLost && !track->isOver);
    if (!work->isMessy && track->isSeen) {
        /* The way to there is not seen. It may be long where the edge has left the whole sheet, and not by its ends. */
        kiriVec3 way = kiriVec3_Sub(work->is[1], work->is[0]), left = kiriVec3_Sub(track->seen, work->is[0]);
        double distance = kiriVec3_Length(kiriVec3_Cross(kiriVec3_Normalize(way), left)),
               share = kiriVec3_Dot(way, left);
        bool isBeside = distance > SAME * work->snap && share > 0.0 && share < kiriVec3_Dot(way, way);
        bool hasLeft = work->crossings == 0 && isBeside;
        double near = hasLeft ? work->unseen : kiriMin(2.0 * distance + FOUND * work->snap, work->unseen);
        bool isFound = FindOther(work, track->rest, track->stroke, near, &place);
        bool isAlone = isFound || track->loop.isPassed || !work->joins;
        Track* other = isAlone ? NULL : NearestLost(work, track, track->rest, work->unseen);
        if (other != NULL) {
            return LeadTrack(work, track, other->rest) && EndTrack(work, other) && EndTrack(work, track);
        }
        ok = isFound ? LeadTrack(work, track, place) : !track->loop.isPassed || CloseLoop(work, track);
    }
    return ok && EndTrack(work, track);
}

/* ---- One step ---- */

static bool StepThroughSheet(BladeWork* work)
{
    enum { MANY = 24 };
    kiriSheetData* sheet = work->sheet;
    work->snap = sheet->settings.snap * sheet->mesh.step;
    work->unseen = UNSEEN * KIRI_LATTICE * sheet->mesh.step;
    work->firstPending = work->pending.count;
    work->isHeld = kiriVec3_Length(kiriVec3_Sub(work->is[0], work->was[0])) < work->snap &&
                   kiriVec3_Length(kiriVec3_Sub(work->is[1], work->was[1])) < work->snap;
    bool ok = FindLines(work);
    KIRI_KEEP_IF(const kiriSectionLine, line, work->section.lines, IsLong(work, line));
    int32_t layers = work->crossings = 0;
    KIRI_TIMES_WHILE(ok, i, 2 * work->section.lines.count) {
        work->crossings += work->section.lines.data[i / 2].end[i % 2] == KIRI_END_TO;
    }
    KIRI_TIMES_WHILE(ok, i, work->oldCount) {
        layers += work->tracks.data[i].sheet == work->sheet;
    }
    work->isMessy = work->crossings + layers > MANY;
    work->joins = !work->isHeld && !work->isMessy;
    ok = ok && kiriArray_Resize(&work->memory, &work->taker, 2 * work->section.lines.count);
    if (ok) {
        kiriArray_Set(&work->taker, KIRI_NONE);
    }
    KIRI_TIMES(pass, 2) { /* the ends beside a track, then others */
        KIRI_TIMES_WHILE(ok, i, work->oldCount) {
            Track* track = &work->tracks.data[i];
            double far = work->joins ? work->unseen : FOUND * work->snap + kiriVec3_Length(track->more);
            track->isLost |= track->sheet == sheet && pass == 0;
            if (track->sheet == sheet && track->isLost) {
                MatchTrack(work, i, pass == 0 ? SAME * work->snap : far);
            }
        }
    }
    KIRI_TIMES(pass, 2) { /* lines that a track goes on along, then others */
        KIRI_EACH_INDEX_WHILE(ok, i, work->section.lines) {
            bool isTaken = work->taker.data[2 * i] != KIRI_NONE || work->taker.data[2 * i + 1] != KIRI_NONE;
            ok = isTaken != (pass == 0) || FollowLine(work, i);
        }
    }
    KIRI_TIMES_WHILE(ok, i, work->oldCount) {
        Track* track = &work->tracks.data[i];
        ok = track->sheet != sheet || !track->isLost || track->isOver || EndLost(work, track);
    }
    return ok;
}

/* ---- Blades ---- */

kiriResult kiriBeginBlade(kiriWorld* world, kiriSheet sheet, kiriBlade* blade)
{
    KIRI_CHANGES(BeginBlade, &sheet, blade);
    kiriResult result = kiriArray_ReserveMore(&world->memory, &world->blades, 1)
                            ? kiriWorld_ReserveIds(world, &world->bladeIds, 1)
                            : KIRI_ERROR_MEMORY;
    kiriBladeData* made = result == KIRI_OK ? kiriMemory_AllocZeroed(&world->memory, sizeof(*made)) : NULL;
    KIRI_REQUIRE(made != NULL, result != KIRI_OK ? result : KIRI_ERROR_MEMORY, NULL);
    made->sheet = sheet;
    made->id = kiriPool_Add(&world->bladeIds, made, 0);
    KIRI_NEXT(world->blades) = made;
    *blade = made->id;
    KIRI_RETURN(KIRI_OK);
}

static kiriCutData* CutOf(const kiriWorld* world, const kiriLayer* layer)
{
    const kiriSlot* slot = kiriPool_Find(&world->cutIds, layer->cut);
    return slot != NULL ? slot->owner : NULL;
}

/* Ends the cuts of a blade. Loops whose ends have nearly met are closed. */
static void EndCuts(kiriWorld* world, const kiriBladeData* blade)
{
    KIRI_EACH(const kiriLayer, layer, blade->layers) {
        kiriCutData* cut = CutOf(world, layer);
        if (cut == NULL) {
            continue;
        }
        if (layer->loop.isPassed) {
            kiriWorld_QueuePoint(world, cut, layer->loop.near, true);
        }
        if (layer->loop.isPassed || IsLoopNear(&layer->loop, layer->rest)) {
            kiriWorld_QueuePoint(world, cut, layer->loop.start, false);
        }
        kiriWorld_EndCut(world, cut);
    }
}

kiriResult kiriBlade_End(kiriWorld* world, kiriBlade blade)
{
    KIRI_CHANGES(Blade_End, &blade);
    kiriBladeData* data = call->owner;
    KIRI_EACH(const kiriLayer, layer, data->layers) {
        const kiriCutData* cut = CutOf(world, layer);
        KIRI_REQUIRE(cut == NULL || kiriArray_ReserveMore(&world->memory, &cut->sheet->queue, 3 * data->layers.count),
                     KIRI_ERROR_MEMORY, NULL);
    }
    EndCuts(world, data);
    KIRI_KEEP_IF(kiriBladeData*, at, world->blades, *at != data);
    kiriPool_Remove(&world->bladeIds, blade);
    kiriArray_Release(&world->memory, &data->layers);
    kiriMemory_Free(&world->memory, data);
    KIRI_RETURN(KIRI_OK);
}

void kiriWorld_AdvanceBlades(kiriWorld* world)
{
    KIRI_EACH_OF(kiriBladeData, blade, world->blades) {
        blade->ticks += 1;
    }
}

/* ---- From layers to tracks ---- */

/* Makes a track of each layer whose sheet still exists. A cut that has taken all its points ends at its tip, which may
   have snapped to a vertex. */
static bool StartTracks(BladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    KIRI_EACH(const kiriLayer, layer, blade->layers) {
        const kiriSlot* slot = kiriPool_Find(&world->sheetIds, layer->sheet);
        if (slot == NULL) {
            continue;
        }
        kiriCutData* cut = CutOf(world, layer);
        kiriSheetData* sheet = slot->owner;
        bool isThere = cut != NULL && cut->waiting == 0 && cut->tip.blade.vertex != KIRI_NONE;
        kiriVec2 rest = isThere ? kiriMesh_Local(&sheet->mesh, cut->tip.blade.at) : layer->rest;
        const Track track = { .sheet = sheet,
                              .cut = cut,
                              .stroke = KIRI_NONE,
                              .rest = rest,
                              .met = layer->met,
                              .at = layer->at,
                              .loop = layer->loop };
        if (!kiriArray_Push(&work->memory, &work->tracks, track)) {
            return false;
        }
    }
    return true;
}

/* Lists the cuts that are in the queues. */
static bool ListPending(BladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    KIRI_ARRAY(kiriVec2) ends = { 0 };
    bool ok = true;
    KIRI_EACH_OF_WHILE(ok, kiriSheetData, sheet, world->sheets) {
        if (sheet->queue.count == 0 || (blade->sheet != 0 && blade->sheet != sheet->id)) {
            continue;
        }
        ends.count = 0;
        KIRI_EACH_OF_WHILE(ok, kiriCutData, cut, sheet->cuts) {
            ok = kiriArray_Push(&work->memory, &ends, cut->tip.last);
        }
        KIRI_EACH_WHILE(ok, const kiriQueuedPoint, point, sheet->queue) {
            KIRI_ASSERT(point->cut->index >= 0 && point->cut->index < ends.count);
            kiriVec2* end = &ends.data[point->cut->index];
            const PendingLip lip = { sheet, *end, point->to, KIRI_NONE };
            ok = point->jump || kiriArray_Push(&work->memory, &work->pending, lip);
            *end = point->to;
        }
    }
    return ok;
}

/* ---- Steps ---- */

static void NextStep(BladeWork* work)
{
    KIRI_KEEP_IF(const Track, track, work->tracks, !track->isOver && !track->isLost);
    work->oldCount = work->tracks.count;
}

static kiriVec3 Towards(kiriVec3 a, kiriVec3 b, double share)
{
    return share < 1.0 ? kiriVec3_AddScaled(a, share, kiriVec3_Sub(b, a)) : b;
}

/* Moves the edge in steps: in each, the edge sweeps a plane. The first step starts where the edge was when the sheet
   was elsewhere. The sheet stays in the others. */
static bool TakeSteps(BladeWork* work, const kiriWorld* world, const kiriBladeData* blade, const kiriVec3 to[2])
{
    enum { MOST_STEPS = 8 };
    int32_t steps = 1;
    bool ok = true;
    if (blade->isPlaced) {
        kiriVec3 a = kiriVec3_Normalize(kiriVec3_Sub(blade->edge[1], blade->edge[0]));
        kiriVec3 b = kiriVec3_Normalize(kiriVec3_Sub(to[1], to[0]));
        kiriVec3 way = kiriVec3_Add(kiriVec3_Sub(to[0], blade->edge[0]), kiriVec3_Sub(to[1], blade->edge[1]));
        double skew = fabs(kiriVec3_Dot(kiriVec3_Cross(a, b), kiriVec3_Normalize(way)));
        steps += (int32_t)(10.0 * skew);
        steps = kiriMin(steps, MOST_STEPS);
    }
    KIRI_TIMES_WHILE(ok, i, steps) {
        KIRI_TIMES(k, 2) {
            work->was[k] = blade->isPlaced ? Towards(blade->edge[k], to[k], (double)i / steps) : to[k];
            work->is[k] = blade->isPlaced ? Towards(blade->edge[k], to[k], (double)(i + 1) / steps) : to[k];
        }
        work->ticks = i == 0 && blade->isPlaced ? blade->ticks : 0;
        NextStep(work);
        KIRI_EACH_OF_WHILE(ok, kiriSheetData, sheet, world->sheets) {
            work->sheet = sheet;
            ok = (blade->sheet != 0 && blade->sheet != sheet->id) || StepThroughSheet(work);
        }
    }
    NextStep(work);
    return ok;
}

/* ---- Into the world ---- */

/* Makes room for all strokes in the queue and the list of cuts of each of their sheets, and for ids. */
static kiriResult ReserveStrokes(kiriWorld* world, const BladeWork* work)
{
    int64_t made = 0, strokes = work->strokes.count, points = work->points.count + strokes; /* each may end with one */
    KIRI_EACH(const Stroke, stroke, work->strokes) {
        made += stroke->cut->sheet == NULL;
        if (!kiriArray_ReserveMore(&world->memory, &stroke->sheet->queue, points) ||
            !kiriArray_ReserveMore(&world->memory, &stroke->sheet->cuts, strokes)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    return kiriWorld_ReserveIds(world, &world->cutIds, made);
}

/* Adds the points to the queues of their cuts. Never fails. */
static void QueueStrokes(kiriWorld* world, BladeWork* work)
{
    KIRI_EACH(const Stroke, stroke, work->strokes) {
        if (stroke->cut->sheet == NULL) {
            kiriMemory_Adopt(&world->memory, stroke->cut);
            kiriWorld_EnlistCut(world, stroke->sheet, stroke->cut);
        }
    }
    KIRI_EACH(const StrokePoint, point, work->points) {
        KIRI_ASSERT(work->strokes.data[point->stroke].cut->sheet == work->strokes.data[point->stroke].sheet);
        kiriWorld_QueuePoint(world, work->strokes.data[point->stroke].cut, point->rest, point->isStart);
    }
    KIRI_EACH(const Stroke, stroke, work->strokes) {
        if (stroke->isOver) {
            kiriWorld_EndCut(world, stroke->cut);
        }
    }
}

static kiriResult Apply(kiriWorld* world, kiriBladeData* blade, BladeWork* work)
{
    kiriResult result = kiriArray_Reserve(&world->memory, &blade->layers, work->tracks.count)
                            ? ReserveStrokes(world, work)
                            : KIRI_ERROR_MEMORY;
    if (result != KIRI_OK) {
        return result;
    }
    QueueStrokes(world, work);
    KIRI_ASSERT(blade->layers.capacity >= work->tracks.count);
    blade->layers.count = 0;
    KIRI_EACH(const Track, track, work->tracks) {
        const kiriCutData* cut = track->stroke != KIRI_NONE ? work->strokes.data[track->stroke].cut : track->cut;
        const kiriLayer layer = { track->sheet->id, cut != NULL ? cut->id : 0, track->rest, track->met, track->at,
                                  track->loop };
        KIRI_NEXT(blade->layers) = layer;
    }
    return KIRI_OK;
}

/* Moves each end of the edge along a straight line, and queues the cuts. Changes nothing on failure. */
static kiriResult MoveEdge(kiriWorld* world, kiriBladeData* blade, kiriVec3 from, kiriVec3 to)
{
    const kiriVec3 edge[2] = { from, to };
    BladeWork work;
    KIRI_CLEAR(&work);
    work.memory = kiriMemory_Like(&world->memory);
    kiriResult result = KIRI_ERROR_MEMORY;
    if (ListPending(&work, world, blade) && StartTracks(&work, world, blade) && TakeSteps(&work, world, blade, edge)) {
        result = Apply(world, blade, &work);
    }
    kiriMemory_FreeAll(&work.memory);
    if (result == KIRI_OK) {
        blade->edge[0] = from;
        blade->edge[1] = to;
        blade->isPlaced = true;
        blade->ticks = 0;
    }
    return result;
}

kiriResult kiriBlade_MoveEdge(kiriWorld* world, kiriBlade blade, const float from[3], const float to[3])
{
    KIRI_CHANGES(Blade_MoveEdge, &blade, from, to);
    KIRI_RETURN(MoveEdge(world, call->owner, kiriVec3_Load(from), kiriVec3_Load(to)));
}

kiriResult kiriBlade_MoveRay(kiriWorld* world, kiriBlade blade, const float origin[3], const float direction[3],
                             float length)
{
    KIRI_CHANGES(Blade_MoveRay, &blade, origin, direction, &length);
    kiriVec3 from = kiriVec3_Load(origin), unit = kiriVec3_Normalize(kiriVec3_Load(direction));
    KIRI_RETURN(MoveEdge(world, call->owner, from, kiriVec3_AddScaled(from, length, unit)));
}
