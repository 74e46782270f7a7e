#include "kiri_blade.h"
#include "../mesh/kiri_lip.h"
#include "../sheet/kiri_seen.h"

#include <string.h>

/* A move of a blade is worked out first. Nothing in the world changes before all of it is known and room is made. */

/* The points that one cut gets. */
typedef struct Stroke {
    kiriSheetData* sheet;
    kiriCutData* cut; /* null: a new one */
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
    kiriVec2 rest;
    kiriVec3 at;
    double share;
    kiriLoop loop;
    bool isDone; /* this step has handled it */
    bool isOver; /* the blade is out of the layer */
    bool isLost; /* its layer was not found again; another track may continue it */
} Track;

typedef struct BladeWork {
    kiriMemory memory;
    KIRI_ARRAY(Track) tracks;
    KIRI_ARRAY(Stroke) strokes;
    KIRI_ARRAY(StrokePoint) points;
    KIRI_ARRAY(PendingLip) pending; /* of the queues, then of this move */

    /* One step for one sheet. */
    kiriVec3 was[2], is[2]; /* the edge */
    double elapsed;         /* s since the edge was there */
    kiriSheetData* sheet;
    double snap;      /* m */
    bool isHeld;      /* the edge stays: only the material moves */
    bool isMessy;     /* the edge is in many layers, for it lies in the sheet: its ways mean little */
    bool joins;       /* else and if it moves: ways that begin or end amid the material go on to other ways */
    double unseen;    /* m: the farthest that an unseen way may go */
    int32_t oldCount; /* tracks before the step */
    kiriVec3 drift;   /* motion of the material, of the last layer handled */
    int32_t firstPending;
    kiriCrossings crossings; /* of the edge as it is */
    kiriSection section;
    KIRI_ARRAY(kiriSectionPoint) middles; /* of lines */
    kiriRestPoints path;
} BladeWork;

/* Distances in the rest plane, in snap distances. */
#define SAME 2.0       /* places nearer than this are one; a layer that moved less is not led on */
#define PAST 0.5       /* past a border a cut goes on by this, less than blades snap to: so it cuts no notch beyond */
#define STRAIGHT 0.25  /* tolerance of straight ways */
#define DEGENERATE 0.25
#define BESIDE_LIP 3.0 /* a way that stays nearer to lips is in a slit */
#define ON_LIP 0.75    /* points nearer to a lip are on it */
#define SLIT 64.0      /* an edge that stays nearer to a slit slides in it */

/* Between two slits no lip is nearer to the middle than this share of their distance. */
#define ACROSS 0.3

/* The farthest that an unseen way may go, as a share of the sheet's longer side. */
#define UNSEEN 0.125

/* Shares of the length of a loop: it passes its beginning nearer than CLOSING, and is closed OVERLAP later. It is ROUND
   times as long as the straight way back: a way out and back encloses nothing. */
#define CLOSING 0.015
#define OVERLAP 0.1
#define ROUND 1.5

static double RestDistance(kiriVec2 a, kiriVec2 b)
{
    return kiriVec2_Length(kiriVec2_Sub(a, b));
}

/* ---- Strokes ----------------------------------------------------------------------------------------------------- */

/* Returns the stroke of a track. A new cut begins where the track is. KIRI_NONE for memory. */
static int32_t StrokeOf(BladeWork* work, Track* track)
{
    KIRI_ASSERT(track->sheet == work->sheet && track->stroke < work->strokes.count);
    if (track->stroke == KIRI_NONE) {
        const Stroke stroke = { track->sheet, track->cut, false };
        const StrokePoint start = { work->strokes.count, track->rest, true };
        if (!kiriArray_Push(&work->memory, &work->strokes, stroke) ||
            (track->cut == NULL && !kiriArray_Push(&work->memory, &work->points, start))) {
            return KIRI_NONE;
        }
        track->stroke = work->strokes.count - 1;
    }
    return track->stroke;
}

static bool AddCut(BladeWork* work, int32_t stroke, kiriVec2 from, kiriVec2 to)
{
    KIRI_ASSERT(stroke >= 0 && stroke < work->strokes.count);
    const StrokePoint point = { stroke, to, false };
    const PendingLip lip = { work->sheet, from, to, stroke };
    return kiriArray_Push(&work->memory, &work->points, point) && kiriArray_Push(&work->memory, &work->pending, lip);
}

static bool AddStart(BladeWork* work, int32_t stroke, kiriVec2 rest)
{
    const StrokePoint point = { stroke, rest, true };
    return kiriArray_Push(&work->memory, &work->points, point);
}

static bool AddPoint(BladeWork* work, Track* track, kiriVec2 rest)
{
    int32_t stroke = StrokeOf(work, track);
    kiriVec2 from = track->rest;
    track->loop.length += RestDistance(from, rest);
    track->rest = rest;
    return stroke != KIRI_NONE && AddCut(work, stroke, from, rest);
}

/* True if the end of the cut is so near to its beginning that it may be closed. */
static bool IsLoopNear(const kiriLoop* loop, kiriVec2 end)
{
    return loop->isOpen && RestDistance(loop->start, end) < CLOSING * loop->length;
}

/* Notes where the way of a track to a place passes the beginning of its loop. */
static void NotePassing(Track* track, kiriVec2 to)
{
    kiriLoop* loop = &track->loop;
    kiriVec2 way = kiriVec2_Sub(to, track->rest), left = kiriVec2_Sub(loop->start, track->rest);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(left, way) / square : 0.0;
    kiriVec2 near = kiriVec2_Add(track->rest, kiriVec2_Scale(share > 0.0 ? share : 0.0, way));
    bool isRound = loop->length > ROUND * RestDistance(track->rest, near);
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
    kiriVec2 way = kiriVec2_Sub(b, a);
    double square = kiriVec2_Dot(way, way), share = square > 0.0 ? kiriVec2_Dot(kiriVec2_Sub(p, a), way) / square : 0.0;
    return kiriVec2_Add(a, kiriVec2_Scale(share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share, way));
}

static bool FindSlit(const BladeWork* work, kiriVec2 rest, double distance, kiriVec2* slit);

/* The edges that FindLipNear looks for: the outline, lips too, or lips of other slits than the place is on. There is
   material half-way to such a lip. */
enum { OUTLINE, OUTLINE_AND_LIPS, OUTLINE_AND_LIPS_ACROSS };

static void FindLipInTriangle(const BladeWork* work, int32_t triangle, kiriVec2 rest, int which, double* distance,
                              kiriVec2* lip)
{
    const kiriMeshData* mesh = &work->sheet->mesh;
    for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        bool isOutline = kiriMesh_Twin(mesh, h) == KIRI_NONE;
        if (!isOutline && (which == OUTLINE || !kiriMesh_IsOpen(mesh, h))) {
            continue;
        }
        kiriVec2 foot = FootOnWay(kiriMesh_Local(mesh, kiriMesh_TailAt(mesh, h)),
                                  kiriMesh_Local(mesh, kiriMesh_HeadAt(mesh, h)), rest);
        kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(rest, foot)), slit;
        double d = RestDistance(foot, rest);
        if (d < *distance && (isOutline || which == OUTLINE_AND_LIPS ||
                              (d > work->snap && !FindSlit(work, middle, ACROSS * d, &slit)))) {
            *lip = foot;
            *distance = d;
        }
    }
}

/* Finds the point of these edges that is nearest to a place, up to a distance (m). */
static bool FindLipNear(const BladeWork* work, kiriVec2 rest, double distance, int which, kiriVec2* lip)
{
    const kiriMeshData* mesh = &work->sheet->mesh;
    kiriLatticePoint at = kiriMesh_Snap(mesh, rest);
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, at, at, distance / mesh->step);
    double least = distance;
    while (kiriStrips_Next(&strips)) {
        for (int32_t i = 0; i < strips.count; ++i) {
            int32_t slot = mesh->squares.head[strips.square + i * strips.stride];
            for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
                FindLipInTriangle(work, mesh->squares.nodes.data[slot].triangle, rest, which, &least, lip);
            }
        }
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
    for (int32_t i = first; i < work->pending.count; ++i) {
        const PendingLip* lip = &work->pending.data[i];
        kiriVec2 foot = FootOnWay(lip->from, lip->to, rest);
        double d = RestDistance(foot, rest);
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
    distance = isFound ? RestDistance(*slit, rest) : distance;
    return FindPending(work, 0, NO_STROKE, rest, distance, slit) || isFound;
}

/* Puts a track elsewhere in the slit. */
static bool Slide(BladeWork* work, Track* track, kiriVec2 slit)
{
    track->loop.length += RestDistance(track->rest, slit);
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
    double near = SLIT * work->snap, length = RestDistance(track->rest, rest);
    int32_t count = length < 0.5 * MOST * near ? 1 + (int32_t)(length / (0.5 * near)) : 1;
    kiriVec2 from = track->rest;
    bool ok = true;
    for (int32_t i = 1; ok && i <= count; ++i) {
        kiriVec2 at = kiriVec2_Add(from, kiriVec2_Scale((double)i / count, kiriVec2_Sub(rest, from)));
        kiriVec2 slit, other, here;
        bool isNear = FindSlit(work, at, near, &slit);
        if (!isNear && FindSlit(work, at, 2.0 * near, &slit)) {
            ok = (RestDistance(slit, track->rest) < work->snap || Slide(work, track, slit)) &&
                 AddPoint(work, track, at);
        } else if (!isNear) {
            ok = AddPoint(work, track, at);
        } else if (FindLipNear(work, at, near, OUTLINE, &other) &&
                   !FindLipNear(work, track->rest, work->snap, OUTLINE, &here)) {
            ok = AddPoint(work, track, at) && AddPoint(work, track, other);
        } else if (!FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(track->rest, slit)), 0.25 * near,
                                       &other)) {
            ok = AddPoint(work, track, at) && AddPoint(work, track, slit);
        } else if (RestDistance(slit, track->rest) > work->snap) {
            ok = Slide(work, track, slit);
        }
    }
    track->loop.isPassed = false;
    track->loop.length = RestDistance(track->loop.start, track->rest);
    return ok;
}

/* ---- Ways ---- */

/* Follows a slit along a way that keeps to it. There is nothing to cut then, and the track goes on from the slit
   itself, not from beside it. The feet of points a snap apart must lead along lips: one that jumps to another slit
   would leave a bridge between the slits. A way to the outline is cut, so that it parts. */
static bool IsInSlit(const BladeWork* work, kiriVec2 from, kiriVec2 to, kiriVec2* end, kiriVec2* start)
{
    enum { MOST_PLACES = 4096 };
    double length = RestDistance(from, to) / work->snap;
    int32_t places = 1 + (int32_t)fmin(length, MOST_PLACES);
    kiriVec2 slit, middle;
    bool isInSlit = places <= MOST_PLACES && FindSlit(work, to, BESIDE_LIP * work->snap, end) &&
                    !FindLipNear(work, to, 2.0 * BESIDE_LIP * work->snap, OUTLINE, &slit);
    *start = *end;
    for (int32_t i = places - 1; isInSlit && i >= 0; --i) {
        kiriVec2 at = kiriVec2_Add(from, kiriVec2_Scale((double)i / places, kiriVec2_Sub(to, from)));
        isInSlit = FindSlit(work, at, BESIDE_LIP * work->snap, &slit) &&
                   FindSlit(work, kiriVec2_Scale(0.5, kiriVec2_Add(*start, slit)), ON_LIP * work->snap, &middle);
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
        bool isOn = RestDistance(track->rest, foot) < ON_LIP * work->snap;
        return (isOn || (track->cut == NULL && track->stroke == KIRI_NONE) || AddPoint(work, track, foot)) &&
               Slide(work, track, slit);
    }
    NotePassing(track, rest);
    bool ok = AddPoint(work, track, rest);
    bool hasGoneOn = track->loop.isPassed && track->loop.length > (1.0 + OVERLAP) * track->loop.then;
    return ok && (!hasGoneOn || CloseLoop(work, track));
}

static bool LeadAlong(BladeWork* work, Track* track)
{
    bool ok = true;
    kiriVec2 start = track->rest;
    for (int32_t i = 0; ok && i < work->path.count; ++i) {
        bool isHere =
            i + 1 < work->path.count && RestDistance(work->path.data[i], start) < SAME * work->snap;
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

static kiriVec3 EdgeAt(const kiriVec3* edge, double share)
{
    return kiriVec3_AddScaled(edge[0], share, kiriVec3_Sub(edge[1], edge[0]));
}

/* Returns how far a way may go that is not seen, where the edge left a place or came to it: as far as that may be where
   the edge has left the whole sheet, and not by its ends. */
static double UnseenWay(const BladeWork* work, const kiriVec3* edge, kiriVec3 at)
{
    kiriVec3 way = kiriVec3_Sub(edge[1], edge[0]), along = kiriVec3_Normalize(way), left = kiriVec3_Sub(at, edge[0]);
    double distance = kiriVec3_Length(kiriVec3_Cross(along, left)), share = kiriVec3_Dot(along, left);
    bool isBeside = distance > SAME * work->snap && share > 0.0 && share < kiriVec3_Length(way);
    bool hasLeft = work->crossings.count == 0 && isBeside;
    return hasLeft ? work->unseen : kiriMin(2.0 * distance + 8.0 * work->snap, work->unseen);
}

/* Finds where a way goes on that begins or ends amid the material: at the outline, at another slit or at another way of
   this step, whichever is nearest. An edge that has left the whole sheet left it over the outline, if that is near. */
static bool FindOther(const BladeWork* work, kiriVec2 rest, int32_t stroke, double near, kiriVec2* place)
{
    if (work->crossings.count == 0 && FindLipNear(work, rest, near, OUTLINE, place)) {
        return true;
    }
    bool isFound = FindLipNear(work, rest, near, work->joins ? OUTLINE_AND_LIPS_ACROSS : OUTLINE, place);
    near = isFound ? RestDistance(rest, *place) : near;
    return FindPending(work, work->firstPending, stroke, rest, near, place) || isFound;
}

/* ---- Places in the material ---- */

/* Finds where a place in the material is seen. A lip has a place on each side; the one nearest to `by` is taken,
   because a piece that came off may have fallen far. False where the sheet has no material. */
static bool Seen(const kiriSheetData* sheet, kiriVec2 rest, kiriVec3 by, kiriVec3* at)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    kiriLatticePoint p = kiriMesh_Snap(&sheet->mesh, rest), c[3];
    int32_t square = kiriSquares_At(squares, p);
    double nearest = 1e300;
    bool isFound = false;
    for (int32_t n = square == KIRI_NONE ? KIRI_NONE : squares->head[square]; n != KIRI_NONE;
         n = squares->nodes.data[n].next) {
        int32_t triangle = squares->nodes.data[n].triangle;
        kiriMesh_Corners(&sheet->mesh, triangle, c);
        const int32_t* v = sheet->mesh.triangles.data[triangle].vertex;
        const int64_t part[3] = { kiriOrient(c[1], c[2], p), kiriOrient(c[2], c[0], p), kiriOrient(c[0], c[1], p) };
        if (part[0] < 0 || part[1] < 0 || part[2] < 0) {
            continue;
        }
        double whole = (double)kiriOrient(c[0], c[1], c[2]);
        kiriVec3 seen = kiriVec3_Make(0.0, 0.0, 0.0);
        for (int k = 0; k < 3; ++k) {
            seen = kiriVec3_AddScaled(seen, (double)part[k] / whole, kiriSurface_At(&sheet->seen.surface, v[k]));
        }
        double distance = kiriVec3_Length(kiriVec3_Sub(seen, by));
        if (!isFound || distance < nearest) {
            nearest = distance;
            *at = seen;
            isFound = true;
        }
    }
    return isFound;
}

/* Returns the velocity that the frames give a vertex. */
static kiriVec3 VelocityOf(const kiriSheetData* sheet, int32_t vertex)
{
    KIRI_ASSERT(vertex >= 0 && vertex < sheet->vertexSkin.spans.count);
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < span.count; ++i) {
        kiriSampleWeight w = sheet->vertexSkin.weights.data[span.first + i];
        kiriVec2 rest = sheet->seen.surface.rest.data[vertex];
        sum = kiriVec3_AddScaled(sum, w.value,
                                 kiriFrame_VelocityAt(&sheet->frames.data[w.frame], rest));
    }
    return sum;
}

/* Returns how far the material of a triangle has moved since the last move of the edge. */
static kiriVec3 DriftOf(const BladeWork* work, int32_t triangle)
{
    KIRI_ASSERT(triangle >= 0 && triangle < work->sheet->mesh.triangles.count);
    const int32_t* v = work->sheet->mesh.triangles.data[triangle].vertex;
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3; ++k) {
        sum = kiriVec3_AddScaled(sum, work->elapsed / 3.0, VelocityOf(work->sheet, v[k]));
    }
    return sum;
}

/* ---- Crossings ---- */

enum { TAKEN = -1 }; /* the triangle of a crossing that belongs to a track */

/* Finds the nearest free crossing but one, up to a distance in the rest plane, or returns null. */
static kiriCrossing* NearestCrossing(const BladeWork* work, kiriVec2 rest, double distance, const kiriCrossing* except)
{
    kiriCrossing* nearest = NULL;
    for (int32_t i = 0; i < work->crossings.count; ++i) {
        kiriCrossing* crossing = &work->crossings.data[i];
        double d = RestDistance(crossing->rest, rest);
        if (crossing->triangle != TAKEN && crossing != except && d <= distance) {
            distance = d;
            nearest = crossing;
        }
    }
    return nearest;
}

/* Leads a track to a crossing, unless it is there. */
static bool GoOn(BladeWork* work, Track* track, kiriCrossing* crossing)
{
    KIRI_ASSERT(crossing->triangle != TAKEN && track->sheet == work->sheet);
    bool isStill = RestDistance(track->rest, crossing->rest) < SAME * work->snap;
    bool ok = isStill || LeadTrack(work, track, crossing->rest);
    track->at = crossing->at;
    track->share = crossing->share;
    track->isDone = true;
    crossing->triangle = TAKEN;
    return ok;
}

/* ---- Lines of the section ---- */

/* Finds the longest line with an end at a place, or returns null; *fromLast says which end. */
static const kiriSectionLine* LineFrom(const BladeWork* work, kiriVec2 rest, bool* fromLast)
{
    const kiriSection* section = &work->section;
    const kiriSectionLine* found = NULL;
    double longest = -1.0;
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        const kiriSectionPoint* points = &section->points.data[line->first];
        double d[2] = { RestDistance(points[0].rest, rest),
                        RestDistance(points[line->count - 1].rest, rest) };
        int end = d[0] <= d[1] ? 0 : 1;
        if (d[end] < SAME * work->snap && d[1 - end] > longest) {
            longest = d[1 - end];
            found = line;
            *fromLast = end == 1;
        }
    }
    return found;
}

static const kiriSectionPoint* EndOfWay(const BladeWork* work, const kiriSectionLine* line, bool last)
{
    return &work->section.points.data[line->first + (last ? line->count - 1 : 0)];
}

static bool FindPath(BladeWork* work, const kiriSectionLine* line, bool fromLast)
{
    KIRI_ASSERT(line->first >= 0 && line->count >= 2 && line->first + line->count <= work->section.points.count);
    work->path.count = 0;
    return kiriSection_Path(&work->section, line, fromLast, PAST * work->snap, STRAIGHT * work->snap, &work->memory,
                            &work->path);
}

/* Makes the section with the area that the edge sweeps in a plane, on a way `from` `to`. False for memory. */
static bool CutPlane(BladeWork* work, const kiriVec3* was, const kiriVec3* is, kiriVec3 from, kiriVec3 to)
{
    const kiriVec3 corner[4] = { was[0], was[1], is[1], is[0] };
    const kiriSurface* surface = &work->sheet->seen.surface;
    kiriWindow window;
    work->section.points.count = work->section.lines.count = 0;
    return !kiriWindow_Make(&window, corner, from, to) ||
           kiriSection_Add(&work->section, &work->memory, surface, work->sheet->seen.bounds, &window);
}

/* Projects the ends of an edge into the plane through the other edge and x. False where x lies on the other edge. */
static bool Flatten(const BladeWork* work, const kiriVec3* other, kiriVec3 x, const kiriVec3* edge, kiriVec3* flat)
{
    kiriVec3 along = kiriVec3_Normalize(kiriVec3_Sub(other[1], other[0]));
    kiriVec3 normal = kiriVec3_Cross(along, kiriVec3_Sub(x, other[0]));
    double distance = kiriVec3_Length(normal);
    if (!(distance > DEGENERATE * work->snap)) {
        return false;
    }
    normal = kiriVec3_Scale(1.0 / distance, normal);
    for (int k = 0; k < 2; ++k) {
        flat[k] = kiriVec3_AddScaled(edge[k], -kiriVec3_Dot(normal, kiriVec3_Sub(edge[k], other[0])), normal);
    }
    return true;
}

/* ---- Layers that the blade was in ---- */

/* Finds the nearest track of the last step, up to a distance in the rest plane, or returns null. With `except`: one of
   this sheet that is not handled yet, but this one; without: one that was lost, in whatever sheet its material is
   now. */
static Track* NearestTrack(const BladeWork* work, const Track* except, kiriVec2 rest, double distance)
{
    Track* nearest = NULL;
    KIRI_ASSERT(work->oldCount <= work->tracks.count);
    for (int32_t i = 0; i < work->oldCount; ++i) {
        Track* track = &work->tracks.data[i];
        double d = RestDistance(track->rest, rest);
        bool fits =
            except != NULL ? track != except && track->sheet == work->sheet && !track->isDone : track->isLost;
        if (fits && d <= distance) {
            distance = d;
            nearest = track;
        }
    }
    return nearest;
}

/* Leads a track along a line. It ends at the edge as it is now, beyond a border, where the blade ended, or, over a
   fold, at another layer that the blade was in. */
static bool FollowLine(BladeWork* work, Track* track, const kiriSectionLine* line, bool fromLast)
{
    const kiriSectionPoint* end = EndOfWay(work, line, !fromLast);
    int32_t type = line->end[fromLast ? 0 : 1];
    kiriCrossing* crossing =
        type != KIRI_SIDE_FROM ? NearestCrossing(work, end->rest, SAME * work->snap, NULL) : NULL;
    bool isStill = crossing != NULL && RestDistance(track->rest, crossing->rest) < SAME * work->snap;
    /* Over a fold the material of the other track has gone another way, and where the edge only touches the fold that
       counts for much: so that track need only be nearer to the end of the line than this one. */
    Track* other =
        type == KIRI_SIDE_FROM ? NearestTrack(work, track, end->rest, RestDistance(track->rest, end->rest)) : NULL;
    if (type == KIRI_SIDE_FROM && other == NULL) {
        return true; /* the material moved otherwise: the track is lost where it is */
    }
    bool ok = isStill || (FindPath(work, line, fromLast) && LeadAlong(work, track));
    if (!ok || crossing != NULL) {
        return ok && GoOn(work, track, crossing);
    }
    if (other != NULL) {
        ok = LeadTrack(work, track, other->rest) && EndTrack(work, other);
    }
    return ok && EndTrack(work, track);
}

/* Leads a track from where the edge would be had it moved with the material, to where the edge is. */
static bool FollowTrack(BladeWork* work, Track* track)
{
    kiriVec3 x, to = EdgeAt(work->is, track->share);
    if (!Seen(work->sheet, track->rest, track->at, &x)) {
        return true;
    }
    work->drift = kiriVec3_Sub(x, track->at);
    const kiriVec3 was[2] = { kiriVec3_Add(work->was[0], work->drift), kiriVec3_Add(work->was[1], work->drift) };
    kiriVec3 flat[2];
    const kiriSectionLine* line = NULL;
    bool fromLast = false;
    if (Flatten(work, work->is, x, was, flat)) {
        if (!CutPlane(work, flat, work->is, x, to)) {
            return false;
        }
        line = LineFrom(work, track->rest, &fromLast);
        if (line != NULL &&
            (line->end[fromLast ? 0 : 1] == KIRI_SIDE_TO ||
             RestDistance(EndOfWay(work, line, false)->rest, EndOfWay(work, line, true)->rest) > SAME * work->snap)) {
            return FollowLine(work, track, line, fromLast);
        }
    }
    /* Hardly any way, or the tip of the cut stands out of the surface: then the layer is where the edge is nearest in
       the material. */
    double way = kiriVec3_Length(kiriVec3_Sub(to, x));
    kiriCrossing* crossing = NearestCrossing(work, track->rest, 2.0 * way + SAME * work->snap, NULL);
    if (crossing != NULL) {
        return GoOn(work, track, crossing);
    }
    /* There may be a border here; but the way may go on elsewhere (PassAlong): the track counts as lost. */
    kiriVec2 rest = track->rest;
    bool ok = line == NULL || line->end[fromLast ? 0 : 1] != KIRI_END_BORDER ||
              (FindPath(work, line, fromLast) && LeadAlong(work, track));
    track->rest = rest;
    return ok;
}

/* ---- Layers that it has come into ---- */

static kiriLoop LoopFrom(kiriVec2 rest, bool isOpen)
{
    const kiriLoop loop = { isOpen, false, rest, rest, 0.0, 0.0 };
    return loop;
}

static bool AddTrack(BladeWork* work, const kiriCrossing* crossing, kiriVec2 rest, kiriLoop loop)
{
    const Track track = { work->sheet,     NULL, KIRI_NONE, rest,  crossing->at,
                              crossing->share, loop, true,      false, false };
    return kiriArray_Push(&work->memory, &work->tracks, track);
}

/* Cuts from the beginning of the line to the crossing at its other end. */
static bool EnterAlong(BladeWork* work, kiriCrossing* crossing, const kiriSectionLine* line, bool fromLast, double near)
{
    const kiriSectionPoint* start = EndOfWay(work, line, fromLast);
    double length = RestDistance(crossing->rest, start->rest);
    int32_t type = line->end[fromLast ? 1 : 0];
    /* A line over a fold is in the plane of the crossing at its other end, and begins beside another one: that need
       only be nearer to its beginning than this one. */
    kiriCrossing* other = type == KIRI_SIDE_TO ? NearestCrossing(work, start->rest, length, crossing) : NULL;
    bool isAmid = type == KIRI_SIDE_FROM || type == KIRI_SIDE_TO;
    const Track* lost = type == KIRI_SIDE_FROM
                            ? NearestTrack(work, NULL, start->rest, work->joins ? work->unseen : near)
                            : NULL;
    if (!FindPath(work, line, fromLast)) {
        return false;
    }
    kiriVec2 from = lost != NULL ? lost->rest : work->path.data[0];
    bool isFound = work->joins && isAmid && lost == NULL && FindOther(work, from, KIRI_NONE, near, &from);
    bool isInside = type != KIRI_END_BORDER && !isFound;
    kiriLoop loop = lost != NULL ? lost->loop : LoopFrom(from, isInside);
    if (other != NULL) {
        other->triangle = TAKEN;
        if (!AddTrack(work, other, work->path.data[0], LoopFrom(from, isInside))) {
            return false;
        }
    }
    if (!AddTrack(work, crossing, from, loop)) {
        return false;
    }
    Track* track = &work->tracks.data[work->tracks.count - 1];
    return LeadAlong(work, track) && GoOn(work, track, crossing);
}

/* Finds the line that leads to the crossing from where the edge was. An edge enters a layer over a border, but for its
   ends, and where the material was then is known only roughly: so the search goes farther back to find a border. */
static bool FindLineTo(BladeWork* work, const kiriCrossing* crossing, const kiriVec3* was, const kiriVec3* flat,
                       const kiriSectionLine** line, bool* fromLast)
{
    static const double farther[] = { 0.5, 2.0, 8.0, 0.0 };
    kiriVec3 from = EdgeAt(was, crossing->share), back = kiriVec3_Sub(from, crossing->at);
    double length = kiriVec3_Length(back);
    for (int i = 0; i < 4; ++i) {
        kiriVec3 more = kiriVec3_Scale(farther[i] * (1.0 + 8.0 * work->snap / length), back);
        const kiriVec3 edge[2] = { kiriVec3_Add(was[0], more), kiriVec3_Add(was[1], more) };
        if (!CutPlane(work, edge, flat, kiriVec3_Add(from, more), crossing->at)) {
            return false;
        }
        *line = LineFrom(work, crossing->rest, fromLast);
        if (*line != NULL && (*line)->end[*fromLast ? 0 : 1] != KIRI_SIDE_FROM) {
            break;
        }
    }
    return true;
}

static bool EnterLayer(BladeWork* work, kiriCrossing* crossing)
{
    kiriVec3 drift = DriftOf(work, crossing->triangle), flat[2];
    const kiriVec3 was[2] = { kiriVec3_Add(work->was[0], drift), kiriVec3_Add(work->was[1], drift) };
    const kiriSectionLine* line = NULL;
    bool fromLast = false;
    work->drift = drift;
    if (Flatten(work, was, crossing->at, work->is, flat) && !FindLineTo(work, crossing, was, flat, &line, &fromLast)) {
        return false;
    }
    double near = UnseenWay(work, was, crossing->at);
    if (line != NULL) {
        return EnterAlong(work, crossing, line, !fromLast, near);
    }
    const Track* lost = NearestTrack(work, NULL, crossing->rest, near);
    kiriVec2 from = lost != NULL ? lost->rest : crossing->rest;
    bool isInside = lost != NULL || !work->joins || !FindOther(work, from, KIRI_NONE, near, &from);
    return AddTrack(work, crossing, from, lost != NULL ? lost->loop : LoopFrom(from, isInside)) &&
           GoOn(work, &work->tracks.data[work->tracks.count - 1], crossing);
}

/* ---- Layers that it has passed through ---- */

static kiriSectionPoint MiddleOf(const kiriSection* section, const kiriSectionLine* line)
{
    const kiriSectionPoint* b = &section->points.data[line->first + line->count / 2];
    kiriSectionPoint middle = { kiriVec2_Scale(0.5, kiriVec2_Add(b[-1].rest, b->rest)),
                                kiriVec3_Scale(0.5, kiriVec3_Add(b[-1].at, b->at)) };
    return middle;
}

/* Cuts along a line that no track follows. A line from a layer that the blade is in, or was in, belongs to its track,
   unless that was lost. */
static bool PassAlong(BladeWork* work, const kiriSectionLine* line)
{
    double near = 2.0 * kiriVec3_Length(work->drift) + SAME * work->snap;
    int inner = line->end[0] == KIRI_SIDE_FROM ? 0 : line->end[1] == KIRI_SIDE_FROM ? 1 : KIRI_NONE;
    const kiriSectionPoint *first = EndOfWay(work, line, false), *last = EndOfWay(work, line, true);
    kiriVec2 middle = MiddleOf(&work->section, line).rest, led;
    bool isLed = FindPending(work, work->firstPending, NO_STROKE, middle,
                             2.0 * SAME * work->snap + kiriVec3_Length(work->drift), &led);
    if (line->end[0] == KIRI_SIDE_TO || line->end[1] == KIRI_SIDE_TO || isLed) {
        return true;
    }
    const Track* lost =
        inner != KIRI_NONE ? NearestTrack(work, NULL, inner == 0 ? first->rest : last->rest, near) : NULL;
    if (inner != KIRI_NONE && (lost == NULL || line->end[1 - inner] == KIRI_SIDE_FROM)) {
        return true;
    }
    if (!FindPath(work, line, inner == 1)) {
        return false;
    }
    kiriVec2 from = lost != NULL ? lost->rest : work->path.data[0];
    Track track = {
        work->sheet, NULL, KIRI_NONE, from, work->is[0], 0.0, LoopFrom(from, false), false, false, false
    };
    return LeadAlong(work, &track) && EndTrack(work, &track);
}

static const kiriSectionLine* LineNear(const kiriSection* section, kiriVec2 rest)
{
    const kiriSectionLine* nearest = NULL;
    double least = 1e300;
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        for (int32_t k = line->first; k + 1 < line->first + line->count; ++k) {
            const kiriSectionPoint* at = &section->points.data[k];
            double distance = kiriVec2_DistanceToWay(rest, at->rest, at[1].rest);
            nearest = distance < least ? line : nearest;
            least = distance < least ? distance : least;
        }
    }
    return nearest;
}

/* Cuts along the sweep of an edge that turns, near a place on it: in the plane that touches it there. */
static bool PassNear(BladeWork* work, const kiriVec3 was[2], const kiriSectionPoint* place)
{
    kiriVec3 edge[2], from = was[0], way = { 0.0, 0.0, 0.0 }, flat[4];
    double share = 0.5, time = 0.5;
    for (int k = 0; k < 3; ++k) {
        edge[0] = kiriVec3_AddScaled(was[0], time, kiriVec3_Sub(work->is[0], was[0]));
        edge[1] = kiriVec3_AddScaled(was[1], time, kiriVec3_Sub(work->is[1], was[1]));
        way = kiriVec3_Sub(edge[1], edge[0]);
        double square = kiriVec3_Dot(way, way);
        share = square > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(place->at, edge[0]), way) / square : 0.0;
        from = EdgeAt(was, share);
        way = kiriVec3_Sub(EdgeAt(work->is, share), from);
        square = kiriVec3_Dot(way, way);
        time = square > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(place->at, from), way) / square : 0.0;
    }
    kiriVec3 normal = kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(edge[1], edge[0]), way));
    const kiriVec3 corner[4] = { was[0], was[1], work->is[0], work->is[1] };
    for (int k = 0; k < 4; ++k) {
        flat[k] = kiriVec3_AddScaled(corner[k], -kiriVec3_Dot(normal, kiriVec3_Sub(corner[k], from)), normal);
    }
    if (!CutPlane(work, flat, flat + 2, from, kiriVec3_Add(from, way))) {
        return false;
    }
    const kiriSectionLine* line = LineNear(&work->section, place->rest);
    return line == NULL || PassAlong(work, line);
}

/* Finds the drift of the material where no layer has told it. The material may have moved over the edge, and then the
   sweep would seem to begin inside it. */
static bool FindDrift(BladeWork* work)
{
    const kiriSheetData* sheet = work->sheet;
    const kiriVec3 corner[4] = { work->was[0], work->was[1], work->is[1], work->is[0] };
    bool ok = kiriSection_Sweep(&work->section, &work->memory, &sheet->seen.surface, sheet->seen.bounds, corner);
    if (ok && work->section.lines.count > 0) {
        kiriVec2 rest = MiddleOf(&work->section, &work->section.lines.data[0]).rest;
        int32_t triangle = kiriMesh_Locate(&sheet->mesh, kiriMesh_Snap(&sheet->mesh, rest));
        work->drift = triangle != KIRI_NONE ? DriftOf(work, triangle) : work->drift;
    }
    return ok;
}

static bool PassThrough(BladeWork* work)
{
    const kiriSheetData* sheet = work->sheet;
    bool isKnown = kiriVec3_Dot(work->drift, work->drift) > 0.0;
    if (!isKnown && !FindDrift(work)) {
        return false;
    }
    const kiriVec3 corner[4] = { kiriVec3_Add(work->was[0], work->drift), kiriVec3_Add(work->was[1], work->drift),
                                 work->is[1], work->is[0] };
    kiriVec3 normal =
        kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(corner[2], corner[0]), kiriVec3_Sub(corner[3], corner[1])));
    bool isFlat = fabs(kiriVec3_Dot(normal, kiriVec3_Sub(corner[1], corner[0]))) < DEGENERATE * work->snap;
    bool ok = kiriSection_Sweep(&work->section, &work->memory, &sheet->seen.surface, sheet->seen.bounds, corner);
    work->middles.count = 0;
    for (int32_t i = 0; ok && i < work->section.lines.count; ++i) {
        const kiriSectionLine* line = &work->section.lines.data[i];
        ok = isFlat ? PassAlong(work, line)
                    : kiriArray_Push(&work->memory, &work->middles, MiddleOf(&work->section, line));
    }
    for (int32_t i = 0; ok && i < work->middles.count; ++i) {
        ok = PassNear(work, corner, &work->middles.data[i]);
    }
    return ok;
}

/* ---- Layers that it was not found in ---- */

/* Ends a layer that the edge has left. It left over a border, or entered again on another way: where one of these is
   near, the cut goes on to it. */
static bool EndLost(BladeWork* work, Track* track)
{
    kiriVec3 x;
    kiriVec2 place;
    bool ok = true;
    if (!work->isMessy && Seen(work->sheet, track->rest, track->at, &x)) {
        bool isFound = FindOther(work, track->rest, track->stroke, UnseenWay(work, work->is, x), &place);
        bool isAlone = isFound || track->loop.isPassed || !work->joins;
        Track* other = isAlone ? NULL : NearestTrack(work, track, track->rest, work->unseen);
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
    bool ok = true;
    work->snap = sheet->settings.snap * sheet->mesh.step;
    work->firstPending = work->pending.count;
    work->isHeld = kiriVec3_Length(kiriVec3_Sub(work->is[0], work->was[0])) < work->snap &&
                   kiriVec3_Length(kiriVec3_Sub(work->is[1], work->was[1])) < work->snap;
    work->crossings.count = 0;
    work->drift = kiriVec3_Make(0.0, 0.0, 0.0);
    ok = kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) &&
         kiriSurface_Cross(&sheet->seen.surface, sheet->seen.bounds, work->is[0], work->is[1], DEGENERATE * work->snap,
                           &work->memory, &work->crossings);
    work->isMessy = work->crossings.count + work->oldCount > MANY;
    work->joins = !work->isHeld && !work->isMessy;
    work->unseen = UNSEEN * KIRI_LATTICE * sheet->mesh.step;
    for (int32_t i = 0; ok && i < work->oldCount; ++i) {
        Track* track = &work->tracks.data[i];
        if (track->sheet == sheet && !track->isDone) {
            ok = FollowTrack(work, track);
            track->isLost = !track->isDone;
        }
    }
    for (int32_t i = 0; ok && i < work->crossings.count; ++i) {
        if (work->crossings.data[i].triangle != TAKEN) {
            ok = EnterLayer(work, &work->crossings.data[i]);
        }
    }
    ok = ok && PassThrough(work);
    for (int32_t i = 0; ok && i < work->oldCount; ++i) {
        Track* track = &work->tracks.data[i];
        ok = track->sheet != sheet || !track->isLost || track->isOver || EndLost(work, track);
    }
    return ok;
}

/* ---- Blades ---- */

kiriResult kiriWorld_AddBlade(kiriWorld* world, kiriSheet sheet, kiriBladeData** made)
{
    kiriResult result = kiriArray_Reserve(&world->memory, &world->blades, (int64_t)world->blades.count + 1)
                            ? kiriWorld_ReserveIds(world, &world->bladeIds, 1)
                            : KIRI_ERROR_MEMORY;
    kiriBladeData* blade = result == KIRI_OK ? kiriMemory_AllocZeroed(&world->memory, sizeof(*blade)) : NULL;
    if (blade == NULL) {
        return result != KIRI_OK ? result : KIRI_ERROR_MEMORY;
    }
    blade->sheet = sheet;
    blade->id = kiriPool_Add(&world->bladeIds, &world->memory, blade, 0);
    world->blades.data[world->blades.count++] = blade;
    *made = blade;
    return KIRI_OK;
}

static kiriCutData* CutOf(const kiriWorld* world, const kiriLayer* layer)
{
    const kiriSlot* slot = kiriPool_Find(&world->cutIds, layer->cut);
    return slot != NULL ? slot->owner : NULL;
}

/* Ends the cuts of a blade. Loops whose ends have nearly met are closed. */
static void EndCuts(kiriWorld* world, const kiriBladeData* blade)
{
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        const kiriLayer* layer = &blade->layers.data[i];
        kiriCutData* cut = CutOf(world, layer);
        if (cut != NULL && layer->loop.isPassed) {
            kiriWorld_QueuePoint(world, cut, layer->loop.near, true);
        }
        if (cut != NULL && (layer->loop.isPassed || IsLoopNear(&layer->loop, layer->rest))) {
            kiriWorld_QueuePoint(world, cut, layer->loop.start, false);
        }
        if (cut != NULL) {
            kiriWorld_EndCut(world, cut);
        }
    }
}

kiriResult kiriWorld_RemoveBlade(kiriWorld* world, kiriBladeData* blade)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        const kiriCutData* cut = CutOf(world, &blade->layers.data[i]);
        if (cut != NULL && !kiriArray_Reserve(&world->memory, &cut->sheet->queue,
                                              (int64_t)cut->sheet->queue.count + 3 * (int64_t)blade->layers.count)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    EndCuts(world, blade);
    for (int32_t i = 0; i < world->blades.count; ++i) {
        if (world->blades.data[i] != blade) {
            world->blades.data[kept++] = world->blades.data[i];
        }
    }
    KIRI_ASSERT(kept == world->blades.count - 1);
    world->blades.count = kept;
    kiriPool_Remove(&world->bladeIds, blade->id);
    kiriArray_Release(&world->memory, &blade->layers);
    kiriMemory_Free(&world->memory, blade);
    return KIRI_OK;
}

void kiriWorld_AdvanceBlades(kiriWorld* world, double dt)
{
    for (int32_t i = 0; i < world->blades.count; ++i) {
        world->blades.data[i]->elapsed += dt;
    }
}

/* ---- From layers to tracks ---- */

/* Makes a track of each layer whose sheet still exists. A cut that has taken all its points ends at its tip, which may
   have snapped to a vertex. */
static bool StartTracks(BladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        const kiriLayer* layer = &blade->layers.data[i];
        const kiriSlot* slot = kiriPool_Find(&world->sheetIds, layer->sheet);
        if (slot == NULL) {
            continue;
        }
        kiriCutData* cut = CutOf(world, layer);
        kiriSheetData* sheet = slot->owner;
        bool isThere = cut != NULL && cut->waiting == 0 && cut->tip.blade.vertex != KIRI_NONE;
        kiriVec2 rest = isThere ? kiriMesh_Local(&sheet->mesh, cut->tip.blade.at) : layer->rest;
        const Track track = { sheet,     cut,          KIRI_NONE,   rest,  layer->at,
                              layer->share, layer->loop, false, false, false };
        if (!kiriArray_Push(&work->memory, &work->tracks, track)) {
            return false;
        }
    }
    return true;
}

/* Lists the cuts that are in the queues. */
static bool ListPending(BladeWork* work, const kiriWorld* world, const kiriBladeData* blade)
{
    KIRI_ARRAY(kiriVec2) ends = { NULL, 0, 0 };
    bool ok = true;
    for (int32_t i = 0; ok && i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        if (sheet->queue.count == 0 || (blade->sheet != 0 && blade->sheet != sheet->id)) {
            continue;
        }
        ends.count = 0;
        for (int32_t k = 0; ok && k < sheet->cuts.count; ++k) {
            ok = kiriArray_Push(&work->memory, &ends, sheet->cuts.data[k]->tip.last);
        }
        for (int32_t k = 0; ok && k < sheet->queue.count; ++k) {
            const kiriQueuedPoint* point = &sheet->queue.data[k];
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
    int32_t kept = 0;
    for (int32_t i = 0; i < work->tracks.count; ++i) {
        if (!work->tracks.data[i].isOver && !work->tracks.data[i].isLost) {
            work->tracks.data[kept] = work->tracks.data[i];
            work->tracks.data[kept++].isDone = false;
        }
    }
    work->tracks.count = work->oldCount = kept;
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
    for (int32_t i = 0; ok && i < steps; ++i) {
        for (int k = 0; k < 2; ++k) {
            work->was[k] = blade->isPlaced ? Towards(blade->edge[k], to[k], (double)i / steps) : to[k];
            work->is[k] = blade->isPlaced ? Towards(blade->edge[k], to[k], (double)(i + 1) / steps) : to[k];
        }
        work->elapsed = i == 0 && blade->isPlaced ? blade->elapsed : 0.0;
        NextStep(work);
        for (int32_t k = 0; ok && k < world->sheets.count; ++k) {
            work->sheet = world->sheets.data[k];
            ok = (blade->sheet != 0 && blade->sheet != work->sheet->id) || StepThroughSheet(work);
        }
    }
    NextStep(work);
    return ok;
}

/* ---- Into the world ---- */

typedef KIRI_ARRAY(kiriCutData*) CutList;

/* Makes room in the queues and lists of cuts, and for ids. */
static kiriResult ReserveStrokes(kiriWorld* world, const BladeWork* work)
{
    int64_t made = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        int64_t points = sheet->queue.count, cuts = sheet->cuts.count;
        for (int32_t k = 0; k < work->points.count; ++k) {
            points += work->strokes.data[work->points.data[k].stroke].sheet == sheet;
        }
        for (int32_t k = 0; k < work->strokes.count; ++k) {
            cuts += work->strokes.data[k].sheet == sheet && work->strokes.data[k].cut == NULL;
            points += work->strokes.data[k].sheet == sheet; /* to end with */
        }
        made += cuts - sheet->cuts.count;
        if (!kiriArray_Reserve(&world->memory, &sheet->queue, points) ||
            !kiriArray_Reserve(&world->memory, &sheet->cuts, cuts)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    return kiriWorld_ReserveIds(world, &world->cutIds, made);
}

/* Allocates the new cuts; all or none. */
static bool MakeCuts(kiriWorld* world, BladeWork* work, CutList* made)
{
    bool ok = true;
    for (int32_t i = 0; ok && i < work->strokes.count; ++i) {
        if (work->strokes.data[i].cut == NULL) {
            kiriCutData* cut = kiriMemory_AllocZeroed(&world->memory, sizeof(*cut));
            ok = cut != NULL && kiriArray_Push(&work->memory, made, cut);
            if (!ok) {
                kiriMemory_Free(&world->memory, cut);
            }
        }
    }
    for (int32_t i = 0; !ok && i < made->count; ++i) {
        kiriMemory_Free(&world->memory, made->data[i]);
    }
    return ok;
}

/* Adds the points to the queues of their cuts. Never fails. */
static void QueueStrokes(kiriWorld* world, BladeWork* work, const CutList* made)
{
    int32_t used = 0;
    for (int32_t i = 0; i < work->strokes.count; ++i) {
        Stroke* stroke = &work->strokes.data[i];
        if (stroke->cut == NULL) {
            KIRI_ASSERT(used < made->count);
            stroke->cut = made->data[used++];
            kiriWorld_EnlistCut(world, stroke->sheet, stroke->cut);
        }
    }
    for (int32_t i = 0; i < work->points.count; ++i) {
        const StrokePoint* point = &work->points.data[i];
        KIRI_ASSERT(work->strokes.data[point->stroke].cut->sheet == work->strokes.data[point->stroke].sheet);
        kiriWorld_QueuePoint(world, work->strokes.data[point->stroke].cut, point->rest, point->isStart);
    }
    for (int32_t i = 0; i < work->strokes.count; ++i) {
        if (work->strokes.data[i].isOver) {
            kiriWorld_EndCut(world, work->strokes.data[i].cut);
        }
    }
}

static kiriResult Apply(kiriWorld* world, kiriBladeData* blade, BladeWork* work)
{
    CutList made = { NULL, 0, 0 };
    kiriResult result = ReserveStrokes(world, work);
    if (result != KIRI_OK) {
        return result;
    }
    if (!kiriArray_Reserve(&world->memory, &blade->layers, work->tracks.count) || !MakeCuts(world, work, &made)) {
        return KIRI_ERROR_MEMORY;
    }
    QueueStrokes(world, work, &made);
    KIRI_ASSERT(blade->layers.capacity >= work->tracks.count);
    blade->layers.count = 0;
    for (int32_t i = 0; i < work->tracks.count; ++i) {
        const Track* track = &work->tracks.data[i];
        const kiriCutData* cut = track->stroke != KIRI_NONE ? work->strokes.data[track->stroke].cut : track->cut;
        const kiriLayer layer = { track->sheet->id, cut != NULL ? cut->id : 0, track->rest, track->at, track->share,
                                  track->loop };
        blade->layers.data[blade->layers.count++] = layer;
    }
    return KIRI_OK;
}

kiriResult kiriWorld_MoveBlade(kiriWorld* world, kiriBladeData* blade, kiriVec3 from, kiriVec3 to)
{
    const kiriVec3 edge[2] = { from, to };
    BladeWork work;
    memset(&work, 0, sizeof(work));
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
        blade->elapsed = 0.0;
    }
    return result;
}
