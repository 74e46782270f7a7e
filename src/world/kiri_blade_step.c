#include "kiri_blade_work.h"

#include "../sheet/kiri_seen.h"

/* Measured in snap distances: nearer in the rest plane than STILL a layer is not led on; past a border a cut goes on by
   REACH, which is less than what a blade snaps to, so that it cuts no notch into what is beyond. */
#define STILL 2.0
#define REACH 0.5
#define STRAIGHT 0.25
#define DEGENERATE 0.25

static kiriVec3 EdgeAt(const kiriVec3* edge, double share)
{
    return kiriVec3_AddScaled(edge[0], share, kiriVec3_Sub(edge[1], edge[0]));
}

/* The foot of x on the line through the edge, as a share of it. */
static double ShareOf(const kiriVec3* edge, kiriVec3 x)
{
    kiriVec3 way = kiriVec3_Sub(edge[1], edge[0]);
    double square = kiriVec3_Dot(way, way);
    return square > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(x, edge[0]), way) / square : 0.0;
}

/* ---- Places in the material ---- */

/* Finds where a place in the material is seen. A lip has a place on each side; the one nearest to `by` is taken, because
   a piece that came off may have fallen far. False where the sheet has no material. */
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

/* How the frames move a vertex. */
static kiriVec3 VelocityOf(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = 0; i < span.count; ++i) {
        kiriSampleWeight w = sheet->vertexSkin.weights.data[span.first + i];
        kiriVec2 rest = sheet->seen.surface.rest.data[vertex];
        sum = kiriVec3_AddScaled(sum, w.value,
                                 kiriFrame_VelocityAt(&sheet->frames.data[kiriSheet_FrameOf(sheet, w.label)], rest));
    }
    return sum;
}

/* How far the material of a triangle has gone since the edge was where it was. */
static kiriVec3 DriftOf(const kiriBladeWork* work, int32_t triangle)
{
    const int32_t* v = work->sheet->mesh.triangles.data[triangle].vertex;
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3; ++k) {
        sum = kiriVec3_AddScaled(sum, work->elapsed / 3.0, VelocityOf(work->sheet, v[k]));
    }
    return sum;
}

/* ---- Crossings ---- */

enum { TAKEN = -1 }; /* the triangle of a crossing that belongs to a track */

/* The nearest crossing that is free, up to a distance in the rest plane; null: there is none. */
static kiriCrossing* NearestCrossing(const kiriBladeWork* work, kiriVec2 rest, double distance)
{
    kiriCrossing* nearest = NULL;
    for (int32_t i = 0; i < work->crossings.count; ++i) {
        kiriCrossing* crossing = &work->crossings.data[i];
        double d = kiriRest_Distance(crossing->rest, rest);
        if (crossing->triangle != TAKEN && d <= distance) {
            distance = d;
            nearest = crossing;
        }
    }
    return nearest;
}

/* The track is in the layer at this crossing, and is led there, unless that is no way. */
static bool GoOn(kiriBladeWork* work, kiriTrack* track, kiriCrossing* crossing)
{
    bool isStill = kiriRest_Distance(track->rest, crossing->rest) < STILL * work->snap;
    bool ok = isStill || kiriTrack_Lead(work, track, crossing->rest);
    track->at = crossing->at;
    track->share = crossing->share;
    track->isDone = true;
    crossing->triangle = TAKEN;
    return ok;
}

/* ---- Lines of the section ---- */

/* The line with an end at a place, the longest where there are several; *fromLast says which end. Null: none. */
static const kiriSectionLine* LineFrom(const kiriBladeWork* work, kiriVec2 rest, bool* fromLast)
{
    const kiriSection* section = &work->section;
    const kiriSectionLine* found = NULL;
    double longest = -1.0;
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        const kiriSectionPoint* points = &section->points.data[line->first];
        double d[2] = { kiriRest_Distance(points[0].rest, rest),
                        kiriRest_Distance(points[line->count - 1].rest, rest) };
        int end = d[0] <= d[1] ? 0 : 1;
        if (d[end] < KIRI_BLADE_SAME * work->snap && d[1 - end] > longest) {
            longest = d[1 - end];
            found = line;
            *fromLast = end == 1;
        }
    }
    return found;
}

static const kiriSectionPoint* EndOfWay(const kiriBladeWork* work, const kiriSectionLine* line, bool last)
{
    return &work->section.points.data[line->first + (last ? line->count - 1 : 0)];
}

static bool FindPath(kiriBladeWork* work, const kiriSectionLine* line, bool fromLast)
{
    work->path.count = 0;
    return kiriSection_Path(&work->section, line, fromLast, REACH * work->snap, STRAIGHT * work->snap, &work->memory,
                            &work->path);
}

/* The section with what the edge sweeps in a plane. `from` and `to` are on its way. False for memory. */
static bool CutPlane(kiriBladeWork* work, const kiriVec3* was, const kiriVec3* is, kiriVec3 from, kiriVec3 to)
{
    const kiriVec3 corner[4] = { was[0], was[1], is[1], is[0] };
    const kiriSurface* surface = &work->sheet->seen.surface;
    kiriWindow window;
    work->section.points.count = work->section.lines.count = 0;
    return !kiriWindow_Make(&window, corner, from, to) ||
           kiriSection_Add(&work->section, &work->memory, surface, work->sheet->seen.bounds, &window);
}

/* The ends of an edge, brought into the plane through the other edge and x. False where x lies on the other edge: there
   is no way from one to the other. */
static bool Flatten(const kiriBladeWork* work, const kiriVec3* other, kiriVec3 x, const kiriVec3* edge, kiriVec3* flat)
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

/* The track at the other end of a line over a fold: the nearest one that is not seen to, or null. Its material has gone
   another way than that of this track, and where the edge only touches the fold that counts for much: so it need not be
   where the line ends, but nearer to it than this track. */
static kiriTrack* OtherTrack(kiriBladeWork* work, const kiriTrack* track, kiriVec2 rest)
{
    double nearest = kiriRest_Distance(track->rest, rest);
    kiriTrack* found = NULL;
    for (int32_t i = 0; i < work->oldCount; ++i) {
        kiriTrack* other = &work->tracks.data[i];
        double distance = kiriRest_Distance(other->rest, rest);
        if (other != track && other->sheet == work->sheet && !other->isDone && distance < nearest) {
            nearest = distance;
            found = other;
        }
    }
    return found;
}

/* Where the line that a track follows ends: at the edge as it is now, and the track goes on from there; beyond a
   border; where the blade ended; or, over a fold, at another layer that the blade was in. */
static bool FollowLine(kiriBladeWork* work, kiriTrack* track, const kiriSectionLine* line, bool fromLast)
{
    const kiriSectionPoint* end = EndOfWay(work, line, !fromLast);
    int32_t type = line->end[fromLast ? 0 : 1];
    kiriCrossing* crossing =
        type == KIRI_SIDE_TO ? NearestCrossing(work, end->rest, KIRI_BLADE_SAME * work->snap) : NULL;
    bool isStill = crossing != NULL && kiriRest_Distance(track->rest, crossing->rest) < STILL * work->snap;
    kiriTrack* other = type == KIRI_SIDE_FROM ? OtherTrack(work, track, end->rest) : NULL;
    bool ok = isStill || (FindPath(work, line, fromLast) && kiriTrack_LeadAlong(work, track));
    if (!ok || crossing != NULL) {
        return ok && GoOn(work, track, crossing);
    }
    if (other != NULL) {
        ok = kiriTrack_Lead(work, track, other->rest) && kiriTrack_End(work, other);
    }
    bool isLost = type == KIRI_SIDE_FROM && other == NULL;
    return ok && (isLost || kiriTrack_End(work, track));
}

/* Is the line more than what is around its beginning? */
static bool LeadsOn(const kiriBladeWork* work, const kiriSectionLine* line, bool fromLast)
{
    double length = kiriRest_Distance(EndOfWay(work, line, false)->rest, EndOfWay(work, line, true)->rest);
    return line->end[fromLast ? 0 : 1] == KIRI_SIDE_TO || length > KIRI_BLADE_SAME * work->snap;
}

/* To a border that is here, perhaps; but the way may go on elsewhere (PassAlong): the track counts as lost. */
static bool FollowShort(kiriBladeWork* work, kiriTrack* track, const kiriSectionLine* line, bool fromLast)
{
    kiriVec2 rest = track->rest;
    bool ok = line->end[fromLast ? 0 : 1] != KIRI_END_BORDER ||
              (FindPath(work, line, fromLast) && kiriTrack_LeadAlong(work, track));
    track->rest = rest;
    return ok;
}

/* From where the edge would be now, had it gone on with the material, to where it is. */
static bool FollowTrack(kiriBladeWork* work, kiriTrack* track)
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
        if (line != NULL && LeadsOn(work, line, fromLast)) {
            return FollowLine(work, track, line, fromLast);
        }
    }
    /* Hardly any way, or the tip of the cut stands out of the surface: then the layer is where the edge is nearest in
       the material. */
    double way = kiriVec3_Length(kiriVec3_Sub(to, x));
    kiriCrossing* crossing = NearestCrossing(work, track->rest, 2.0 * way + KIRI_BLADE_SAME * work->snap);
    return crossing != NULL ? GoOn(work, track, crossing) : line == NULL || FollowShort(work, track, line, fromLast);
}

/* ---- Layers that it has come into ---- */

/* A track that was not found again, in whatever sheet its material is now, near where a line begins. */
static const kiriTrack* LostTrack(const kiriBladeWork* work, kiriVec2 rest, double distance)
{
    const kiriTrack* nearest = NULL;
    for (int32_t i = 0; i < work->oldCount; ++i) {
        const kiriTrack* track = &work->tracks.data[i];
        double d = kiriRest_Distance(track->rest, rest);
        if (track->isLost && d <= distance) {
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

static bool AddTrack(kiriBladeWork* work, const kiriCrossing* crossing, kiriVec2 rest, kiriLoop loop)
{
    const kiriTrack track = { work->sheet,     NULL, KIRI_NONE, rest,  crossing->at,
                              crossing->share, loop, true,      false, false };
    return kiriArray_Push(&work->memory, &work->tracks, track);
}

/* The crossing where a line over a fold begins. The line is in the plane of the crossing at its other end, and begins
   beside this one: it need only be nearer to it than to that one. */
static kiriCrossing* OtherCrossing(kiriBladeWork* work, kiriCrossing* crossing, kiriVec2 rest)
{
    int32_t triangle = crossing->triangle;
    crossing->triangle = TAKEN;
    kiriCrossing* other = NearestCrossing(work, rest, kiriRest_Distance(crossing->rest, rest));
    crossing->triangle = triangle;
    return other;
}

/* As far as a border or a lip that a blade went over unseen may be, as a share of the sheet's longer side. */
#define BORDER_DISTANCE 0.05

/* From the beginning of the line to the crossing at its other end. */
static bool EnterAlong(kiriBladeWork* work, kiriCrossing* crossing, const kiriSectionLine* line, bool fromLast,
                       double near)
{
    const kiriSectionPoint* start = EndOfWay(work, line, fromLast);
    int32_t type = line->end[fromLast ? 1 : 0];
    kiriCrossing* other = type == KIRI_SIDE_TO ? OtherCrossing(work, crossing, start->rest) : NULL;
    const kiriTrack* lost = type == KIRI_SIDE_FROM ? LostTrack(work, start->rest, near) : NULL;
    if (!FindPath(work, line, fromLast)) {
        return false;
    }
    kiriVec2 from = lost != NULL ? lost->rest : work->path.data[0];
    kiriLoop loop = lost != NULL ? lost->loop : LoopFrom(from, type != KIRI_END_BORDER);
    if (other != NULL) {
        other->triangle = TAKEN;
        if (!AddTrack(work, other, from, LoopFrom(from, true))) {
            return false;
        }
    }
    if (!AddTrack(work, crossing, from, loop)) {
        return false;
    }
    kiriTrack* track = &work->tracks.data[work->tracks.count - 1];
    return kiriTrack_LeadAlong(work, track) && GoOn(work, track, crossing);
}

/* The line that leads to the crossing from where the edge was. Where the material was then is known only nearly, and an
   edge that comes into a layer comes over a border, but for its ends: so from farther back where there is a border. */
static bool FindLineTo(kiriBladeWork* work, const kiriCrossing* crossing, const kiriVec3* was, const kiriVec3* flat,
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

static bool EnterLayer(kiriBladeWork* work, kiriCrossing* crossing)
{
    kiriVec3 drift = DriftOf(work, crossing->triangle), flat[2];
    const kiriVec3 was[2] = { kiriVec3_Add(work->was[0], drift), kiriVec3_Add(work->was[1], drift) };
    const kiriSectionLine* line = NULL;
    bool fromLast = false;
    work->drift = drift;
    if (Flatten(work, was, crossing->at, work->is, flat) && !FindLineTo(work, crossing, was, flat, &line, &fromLast)) {
        return false;
    }
    if (line != NULL) {
        double near = kiriVec3_Length(kiriVec3_Sub(EdgeAt(was, crossing->share), crossing->at));
        return EnterAlong(work, crossing, line, !fromLast, 2.0 * near + KIRI_BLADE_SAME * work->snap);
    }
    bool ok = AddTrack(work, crossing, crossing->rest, LoopFrom(crossing->rest, true));
    crossing->triangle = TAKEN;
    return ok;
}

/* ---- Layers that it has passed through ---- */

static kiriSectionPoint MiddleOf(const kiriSection* section, const kiriSectionLine* line)
{
    const kiriSectionPoint* b = &section->points.data[line->first + line->count / 2];
    kiriSectionPoint middle = { kiriVec2_Scale(0.5, kiriVec2_Add(b[-1].rest, b->rest)),
                                kiriVec3_Scale(0.5, kiriVec3_Add(b[-1].at, b->at)) };
    return middle;
}

/* Has the step led a cut through the middle of the line already? */
static bool IsLed(const kiriBladeWork* work, const kiriSectionLine* line)
{
    kiriVec2 rest = MiddleOf(&work->section, line).rest;
    double near = 2.0 * KIRI_BLADE_SAME * work->snap + kiriVec3_Length(work->drift);
    bool isLed = false;
    for (int32_t i = work->firstPending; !isLed && i < work->pending.count; ++i) {
        const kiriPendingLip* lip = &work->pending.data[i];
        isLed = lip->sheet == work->sheet && kiriVec2_DistanceToWay(rest, lip->from, lip->to) < near;
    }
    return isLed;
}

/* Lines from a layer that the blade is in, or was in, are those of tracks; but for a track that was lost. */
static bool PassAlong(kiriBladeWork* work, const kiriSectionLine* line)
{
    double near = 2.0 * kiriVec3_Length(work->drift) + KIRI_BLADE_SAME * work->snap;
    int inner = line->end[0] == KIRI_SIDE_FROM ? 0 : line->end[1] == KIRI_SIDE_FROM ? 1 : KIRI_NONE;
    const kiriSectionPoint *first = EndOfWay(work, line, false), *last = EndOfWay(work, line, true);
    if (line->end[0] == KIRI_SIDE_TO || line->end[1] == KIRI_SIDE_TO || IsLed(work, line)) {
        return true;
    }
    const kiriTrack* lost = inner != KIRI_NONE ? LostTrack(work, inner == 0 ? first->rest : last->rest, near) : NULL;
    if (inner != KIRI_NONE && (lost == NULL || line->end[1 - inner] == KIRI_SIDE_FROM)) {
        return true;
    }
    if (!FindPath(work, line, inner == 1)) {
        return false;
    }
    kiriVec2 from = lost != NULL ? lost->rest : work->path.data[0];
    kiriTrack track = {
        work->sheet, NULL, KIRI_NONE, from, work->is[0], 0.0, LoopFrom(from, false), false, false, false
    };
    return kiriTrack_LeadAlong(work, &track) && kiriTrack_End(work, &track);
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

/* The sweep of an edge that turns, near a place on it: in the plane that touches it there. */
static bool PassNear(kiriBladeWork* work, const kiriVec3 was[2], const kiriSectionPoint* place)
{
    kiriVec3 edge[2], from = was[0], way = { 0.0, 0.0, 0.0 }, flat[4];
    double share = 0.5, time = 0.5;
    for (int k = 0; k < 3; ++k) {
        edge[0] = kiriVec3_AddScaled(was[0], time, kiriVec3_Sub(work->is[0], was[0]));
        edge[1] = kiriVec3_AddScaled(was[1], time, kiriVec3_Sub(work->is[1], was[1]));
        share = ShareOf(edge, place->at);
        from = EdgeAt(was, share);
        way = kiriVec3_Sub(EdgeAt(work->is, share), from);
        double square = kiriVec3_Dot(way, way);
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

static bool IsFlat(const kiriBladeWork* work, const kiriVec3 corner[4])
{
    kiriVec3 normal =
        kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(corner[2], corner[0]), kiriVec3_Sub(corner[3], corner[1])));
    return fabs(kiriVec3_Dot(normal, kiriVec3_Sub(corner[1], corner[0]))) < DEGENERATE * work->snap;
}

/* Where the edge neither is nor was in a layer, nobody has said how far the material went: it may have come over the
   edge meanwhile, and then the sweep seems to begin inside it. */
static bool FindDrift(kiriBladeWork* work)
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

static bool PassThrough(kiriBladeWork* work)
{
    const kiriSheetData* sheet = work->sheet;
    bool isKnown = kiriVec3_Dot(work->drift, work->drift) > 0.0;
    if (!isKnown && !FindDrift(work)) {
        return false;
    }
    const kiriVec3 corner[4] = { kiriVec3_Add(work->was[0], work->drift), kiriVec3_Add(work->was[1], work->drift),
                                 work->is[1], work->is[0] };
    bool isFlat = IsFlat(work, corner);
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

/* Finds the nearest point of what other tracks cut in this step, nearer than `distance`. */
static bool FindOtherWay(const kiriBladeWork* work, const kiriTrack* track, double distance, kiriVec2* place)
{
    bool isFound = false;
    for (int32_t i = work->firstPending; i < work->pending.count; ++i) {
        const kiriPendingLip* lip = &work->pending.data[i];
        kiriVec2 foot = kiriRest_Foot(lip->from, lip->to, track->rest);
        double d = kiriRest_Distance(foot, track->rest);
        if (lip->sheet == work->sheet && lip->stroke != track->stroke && d < distance) {
            distance = d;
            *place = foot;
            isFound = true;
        }
    }
    return isFound;
}

/* Ends a layer that the edge is in no longer. The edge went out over a border, or came in again on another way: where
   one of these is near, the cut goes on to it. */
static bool EndLost(kiriBladeWork* work, kiriTrack* track)
{
    kiriVec3 x;
    kiriVec2 place;
    bool ok = true;
    if (Seen(work->sheet, track->rest, track->at, &x)) {
        double near = 2.0 * kiriVec3_Length(kiriVec3_Sub(x, EdgeAt(work->is, track->share))) + 8.0 * work->snap;
        near = kiriMin(near, BORDER_DISTANCE * KIRI_LATTICE * work->sheet->mesh.step);
        bool isFound = kiriBlade_FindLip(&work->sheet->mesh, track->rest, near, false, &place);
        near = isFound ? kiriRest_Distance(track->rest, place) : near;
        isFound = FindOtherWay(work, track, near, &place) || isFound;
        ok = !isFound || kiriTrack_Lead(work, track, place);
    }
    return ok && kiriTrack_End(work, track);
}

/* ---- One step ---- */

bool kiriBlade_Step(kiriBladeWork* work)
{
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
    for (int32_t i = 0; ok && i < work->oldCount; ++i) {
        kiriTrack* track = &work->tracks.data[i];
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
        kiriTrack* track = &work->tracks.data[i];
        ok = track->sheet != sheet || !track->isLost || track->isOver || EndLost(work, track);
    }
    return ok;
}
