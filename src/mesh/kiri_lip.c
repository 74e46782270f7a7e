#include "kiri_lip.h"

/* Cost in ns, about: of a triangle around a vertex or in the list of a square, and of a vertex in a list. */
enum { LIP_EFFORT = 8, PASSING_EFFORT = 2 };

/* ---- Corridor ---------------------------------------------------------------------------------------------------- */

kiriCorridor kiriCorridor_Make(const kiriMeshData* mesh, kiriLatticePoint from, kiriLatticePoint to, double on,
                               double reach)
{
    kiriCorridor corridor = { mesh, from, to, sqrt((double)kiriDistanceSquared(from, to)), on, reach, 0 };
    KIRI_ASSERT(on >= 0.0 && reach >= on);
    return corridor;
}

double kiriCorridor_Side(const kiriCorridor* corridor, kiriLatticePoint p)
{
    KIRI_ASSERT(corridor->length > 0.0);
    return (double)kiriOrient(corridor->from, corridor->to, p) / corridor->length;
}

int64_t kiriCorridor_Progress(const kiriCorridor* corridor, kiriLatticePoint p)
{
    return kiriLattice_Dot(corridor->from, corridor->to, p);
}

static bool IsBetweenEnds(const kiriCorridor* corridor, double progress)
{
    return progress >= 0.0 && progress <= corridor->length * corridor->length;
}

static kiriLatticePoint PointOf(const kiriCorridor* corridor, int32_t vertex)
{
    KIRI_ASSERT(vertex >= 0 && vertex < corridor->mesh->vertices.count);
    return corridor->mesh->vertices.data[vertex].at;
}

kiriLatticePoint kiriLattice_Between(kiriLatticePoint a, kiriLatticePoint b, double share)
{
    return kiriMesh_Round(kiriVec2_Make(a.x + share * ((double)b.x - a.x), a.y + share * ((double)b.y - a.y)));
}

/* ---- Around a vertex --------------------------------------------------------------------------------------------- */

int32_t kiriMesh_FirstAround(const kiriMeshData* mesh, int32_t vertex)
{
    int32_t start = mesh->vertices.data[vertex].edge, h = start;
    for (int32_t twin = kiriMesh_Twin(mesh, h); twin != KIRI_NONE; twin = kiriMesh_Twin(mesh, h)) {
        h = kiriEdge_Next(twin);
        if (h == start) {
            break;
        }
    }
    return h;
}

int32_t kiriMesh_NextAround(const kiriMeshData* mesh, int32_t h, int32_t first)
{
    int32_t next = kiriMesh_Twin(mesh, kiriEdge_Previous(h));
    return next == first ? KIRI_NONE : next;
}

int32_t kiriMesh_VertexAt(const kiriMeshData* mesh, kiriLatticePoint at, int64_t* effort)
{
    int32_t square = kiriSquares_At(&mesh->squares, at);
    int32_t v = square == KIRI_NONE ? KIRI_NONE : mesh->squares.vertexHead[square];
    while (v != KIRI_NONE && !kiriLattice_IsSame(mesh->vertices.data[v].at, at)) {
        *effort += PASSING_EFFORT;
        v = mesh->vertices.data[v].next;
    }
    return v;
}

/* The lips at the point of a vertex, one by one. */
typedef struct LipsAround {
    int32_t first, h;
    bool isLast; /* the outline that ends the fan has its turn */
} LipsAround;

static LipsAround BeginAround(kiriCorridor* corridor, int32_t vertex)
{
    int32_t first = kiriMesh_FirstAround(corridor->mesh, vertex);
    return (LipsAround){ first, first, false };
}

/* Returns the half-edge of the next lip, and the vertex at its other end; KIRI_NONE after the last. */
static int32_t NextLip(kiriCorridor* corridor, LipsAround* around, int32_t* end)
{
    const kiriMeshData* mesh = corridor->mesh;
    while (around->h != KIRI_NONE) {
        int32_t h = around->h, previous = kiriEdge_Previous(h);
        bool isOutline = kiriMesh_Twin(mesh, previous) == KIRI_NONE;
        corridor->effort += LIP_EFFORT;
        if (around->isLast || !isOutline) {
            around->h = kiriMesh_NextAround(mesh, h, around->first);
        }
        if (around->isLast) {
            *end = kiriMesh_Tail(mesh, previous);
            return previous;
        }
        around->isLast = isOutline;
        if (kiriMesh_Twin(mesh, h) == KIRI_NONE || kiriMesh_IsOpen(mesh, h)) {
            *end = kiriMesh_Tail(mesh, kiriEdge_Next(h));
            return h;
        }
    }
    return KIRI_NONE;
}

/* Does a lip end at the vertex, or pass it? */
static bool IsOnLip(kiriCorridor* corridor, int32_t vertex)
{
    LipsAround around = BeginAround(corridor, vertex);
    int32_t end;
    return NextLip(corridor, &around, &end) != KIRI_NONE;
}

/* ---- Along lips -------------------------------------------------------------------------------------------------- */

/* Is q farther along the line than p? Points that are as far are in the order of their sides, so that no walk along lips
   comes back. */
static bool IsAhead(const kiriCorridor* corridor, kiriLatticePoint p, kiriLatticePoint q)
{
    int64_t from = kiriCorridor_Progress(corridor, p), to = kiriCorridor_Progress(corridor, q);
    return to > from ||
           (to == from && kiriOrient(corridor->from, corridor->to, q) > kiriOrient(corridor->from, corridor->to, p));
}

/* Does the line cross the edge between two points that are not on it? */
static bool Crosses(const kiriCorridor* corridor, kiriLatticePoint p, kiriLatticePoint q, kiriLatticePoint* crossing)
{
    double a = kiriCorridor_Side(corridor, p), b = kiriCorridor_Side(corridor, q);
    if (fabs(a) <= corridor->on || fabs(b) <= corridor->on || (a > 0.0) == (b > 0.0)) {
        return false;
    }
    double share = a / (a - b), from = (double)kiriCorridor_Progress(corridor, p),
           to = (double)kiriCorridor_Progress(corridor, q);
    *crossing = kiriLattice_Between(p, q, share);
    return IsBetweenEnds(corridor, from + share * (to - from));
}

/* A walk along lips within a corridor. */
enum { RECENT = 6, MOST_IDLE = 4 };

typedef struct LipWalk {
    int32_t vertex;
    kiriLatticePoint recent[RECENT]; /* where it was */
    int32_t steps;
    int64_t farthest; /* progress */
    int32_t idle;     /* steps since it came farther */
} LipWalk;

static LipWalk BeginLipWalk(const kiriCorridor* corridor, int32_t vertex)
{
    LipWalk walk = { vertex, { { 0, 0 } }, 1, kiriCorridor_Progress(corridor, PointOf(corridor, vertex)), 0 };
    walk.recent[0] = PointOf(corridor, vertex);
    return walk;
}

static bool WasThere(const LipWalk* walk, kiriLatticePoint p)
{
    bool was = false;
    for (int32_t i = 0; i < walk->steps && i < RECENT; ++i) {
        was = was || kiriLattice_IsSame(walk->recent[i], p);
    }
    return was;
}

static void StepTo(const kiriCorridor* corridor, LipWalk* walk, int32_t vertex)
{
    int64_t progress = kiriCorridor_Progress(corridor, PointOf(corridor, vertex));
    walk->vertex = vertex;
    walk->recent[walk->steps++ % RECENT] = PointOf(corridor, vertex);
    walk->idle = progress > walk->farthest ? 0 : walk->idle + 1;
    walk->farthest = progress > walk->farthest ? progress : walk->farthest;
}

/* Steps to the next vertex, the nearest to the line of those that are ahead. Where none is, a few steps may lead back, by
   no more than the width of the corridor: lips meet at any angle. */
static bool StepAlong(kiriCorridor* corridor, LipWalk* walk)
{
    LipsAround around = BeginAround(corridor, walk->vertex);
    int32_t end, best = KIRI_NONE;
    double least = 0.0, back = (double)walk->farthest - 2.0 * corridor->reach * corridor->length;
    bool isAhead = false;
    while (NextLip(corridor, &around, &end) != KIRI_NONE) {
        kiriLatticePoint there = PointOf(corridor, end);
        double side = fabs(kiriCorridor_Side(corridor, there));
        int64_t progress = kiriCorridor_Progress(corridor, there);
        bool ahead = progress > walk->farthest;
        bool may = ahead || (walk->idle < MOST_IDLE && (double)progress >= back);
        if (side <= corridor->reach && may && !WasThere(walk, there) &&
            (best == KIRI_NONE || ahead > isAhead || (ahead == isAhead && side < least))) {
            best = end;
            least = side;
            isAhead = ahead;
        }
    }
    if (best != KIRI_NONE) {
        StepTo(corridor, walk, best);
    }
    return best != KIRI_NONE;
}

/* The lip at this vertex that crosses the line beyond `start`. */
static bool FindCrossing(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint start, kiriLipPoint* place)
{
    kiriLatticePoint here = PointOf(corridor, vertex);
    LipsAround around = BeginAround(corridor, vertex);
    int32_t end;
    place->edge = NextLip(corridor, &around, &end);
    while (place->edge != KIRI_NONE &&
           !(Crosses(corridor, here, PointOf(corridor, end), &place->at) && IsAhead(corridor, start, place->at))) {
        place->edge = NextLip(corridor, &around, &end);
    }
    return place->edge != KIRI_NONE;
}

/* A lip is followed as far as it stays within this share of the reach beside the line, if it leads farther along the line
   than away from it by the factor KIRI_SHALLOW. */
static const double ALONG = 2.0 / 3.0;

/* The place farthest along the line to which lips lead beside it. */
typedef struct FarthestLip {
    kiriLipPoint place;
    double progress;
} FarthestLip;

/* Takes the point where a lip leaves the strip beside the line, or passes the limit, or its other end. */
static void TakeFarther(kiriCorridor* corridor, int32_t vertex, double most, FarthestLip* farthest)
{
    const double width = ALONG * corridor->reach;
    kiriLatticePoint here = PointOf(corridor, vertex);
    double side = kiriCorridor_Side(corridor, here), progress = (double)kiriCorridor_Progress(corridor, here);
    LipsAround around = BeginAround(corridor, vertex);
    int32_t end, h;
    while (fabs(side) <= width && (h = NextLip(corridor, &around, &end)) != KIRI_NONE) {
        kiriLatticePoint there = PointOf(corridor, end);
        double share = 1.0, sideThere = kiriCorridor_Side(corridor, there),
               progressThere = (double)kiriCorridor_Progress(corridor, there);
        if (fabs(sideThere) > width) {
            share = ((sideThere > 0.0 ? width : -width) - side) / (sideThere - side);
        }
        if (progress + share * (progressThere - progress) > most) {
            share = (most - progress) / (progressThere - progress);
        }
        if (share >= 0.0 && progress + share * (progressThere - progress) > farthest->progress) {
            farthest->place = (kiriLipPoint){ h, kiriLattice_Between(here, there, share) };
            farthest->progress = progress + share * (progressThere - progress);
        }
    }
}

/* Follows lips to where they come back on the line, beyond `start` and at most as far as `most`. Returns false if they do
   not; `farthest` then has the farthest place beside the line. */
static bool FollowFrom(kiriCorridor* corridor, LipWalk* walk, kiriLatticePoint start, int64_t most, kiriLipPoint* place,
                       FarthestLip* farthest)
{
    const double beyond = (double)most + 2.0 * corridor->reach * corridor->length;
    do {
        kiriLatticePoint here = PointOf(corridor, walk->vertex);
        bool isOn = fabs(kiriCorridor_Side(corridor, here)) <= corridor->on;
        *place = (kiriLipPoint){ corridor->mesh->vertices.data[walk->vertex].edge, here };
        if ((isOn && IsAhead(corridor, start, here)) || FindCrossing(corridor, walk->vertex, start, place)) {
            if (kiriCorridor_Progress(corridor, place->at) <= most) {
                return true;
            }
        }
        TakeFarther(corridor, walk->vertex, (double)most, farthest);
    } while ((double)walk->farthest <= beyond && StepAlong(corridor, walk));
    return false;
}

bool kiriLip_Follow(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint limit, kiriLipPoint* place)
{
    int64_t most = kiriCorridor_Progress(corridor, limit);
    kiriLatticePoint start = PointOf(corridor, vertex);
    const double first = (double)kiriCorridor_Progress(corridor, start), width = corridor->reach * corridor->length;
    FarthestLip farthest = { { KIRI_NONE, start }, first };
    if (FindCrossing(corridor, vertex, start, place)) {
        return kiriCorridor_Progress(corridor, place->at) <= most;
    }
    TakeFarther(corridor, vertex, (double)most, &farthest);
    LipsAround around = BeginAround(corridor, vertex);
    int32_t end;
    while (NextLip(corridor, &around, &end) != KIRI_NONE) {
        kiriLatticePoint there = PointOf(corridor, end);
        if (fabs(kiriCorridor_Side(corridor, there)) <= corridor->reach &&
            (double)kiriCorridor_Progress(corridor, there) >= first - 2.0 * width) {
            LipWalk walk = BeginLipWalk(corridor, vertex);
            StepTo(corridor, &walk, end);
            if (FollowFrom(corridor, &walk, start, most, place, &farthest)) {
                return true;
            }
        }
    }
    *place = farthest.place;
    return place->edge != KIRI_NONE &&
           farthest.progress - first >= KIRI_SHALLOW * fabs(kiriCorridor_Side(corridor, place->at)) * corridor->length;
}

/* Do lips lead from the vertex to an end of this edge, within the corridor? */
static bool LeadsTo(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint a, kiriLatticePoint b)
{
    double most = corridor->length * (corridor->length + corridor->reach);
    LipWalk walk = BeginLipWalk(corridor, vertex);
    do {
        kiriLatticePoint here = PointOf(corridor, walk.vertex);
        if (kiriLattice_IsSame(here, a) || kiriLattice_IsSame(here, b)) {
            return true;
        }
    } while ((double)walk.farthest <= most && StepAlong(corridor, &walk));
    return false;
}

/* ---- Near a point ------------------------------------------------------------------------------------------------ */

/* A line meets a lip at most this many times farther away than the lip itself. */
enum { OBLIQUE = 4 };

typedef struct NearestLip {
    kiriLipPoint place;
    double distance;
} NearestLip;

static void TakeNearerLip(NearestLip* nearest, int32_t h, kiriLatticePoint at, double distance)
{
    if (distance < nearest->distance ||
        (distance == nearest->distance && (nearest->place.edge == KIRI_NONE || h < nearest->place.edge))) {
        nearest->place = (kiriLipPoint){ h, at };
        nearest->distance = distance;
    }
}

/* The lips of the triangles around corridor->to, one by one; some of them twice. */
typedef struct LipsInBox {
    kiriStrips strips;
    int32_t square, slot, h, end;
} LipsInBox;

static LipsInBox BeginBox(const kiriCorridor* corridor, double size)
{
    LipsInBox box = { kiriStrips_Begin(&corridor->mesh->squares, corridor->to, corridor->to, size), 0, KIRI_NONE, 0,
                      0 };
    return box;
}

static int32_t NextInBox(kiriCorridor* corridor, LipsInBox* box)
{
    const kiriMeshData* mesh = corridor->mesh;
    for (;;) {
        while (box->h < box->end) {
            int32_t h = box->h++, twin = kiriMesh_Twin(mesh, h);
            if (twin == KIRI_NONE || (h < twin && kiriMesh_IsOpen(mesh, h))) {
                return h;
            }
        }
        while (box->slot == KIRI_NONE) {
            if (box->square == box->strips.count) {
                if (!kiriStrips_Next(&box->strips)) {
                    return KIRI_NONE;
                }
                box->square = 0;
                continue;
            }
            box->slot = mesh->squares.head[box->strips.square + box->square++ * box->strips.stride];
        }
        box->h = 3 * mesh->squares.nodes.data[box->slot].triangle;
        box->end = box->h + 3;
        box->slot = mesh->squares.nodes.data[box->slot].next;
        corridor->effort += LIP_EFFORT;
    }
}

static void EdgePoints(const kiriCorridor* corridor, int32_t h, kiriLatticePoint* a, kiriLatticePoint* b)
{
    *a = PointOf(corridor, kiriMesh_Tail(corridor->mesh, h));
    *b = PointOf(corridor, kiriMesh_Tail(corridor->mesh, kiriEdge_Next(h)));
}

static kiriLatticePoint NearestOnEdge(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint p)
{
    double share = (double)kiriLattice_Dot(a, b, p) / (double)kiriDistanceSquared(a, b);
    return kiriLattice_Between(a, b, share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share);
}

/* The line meets this lip, or one that goes on in its direction, near its end: there rather than at the nearest point, so
   that the cut stays straight. */
static void MeetOnLine(kiriCorridor* corridor, kiriLipPoint* place)
{
    kiriLatticePoint a, b, to = corridor->to;
    const double most = OBLIQUE * sqrt((double)kiriDistanceSquared(place->at, to));
    NearestLip nearest = { { KIRI_NONE, to }, most };
    EdgePoints(corridor, place->edge, &a, &b);
    double length = sqrt((double)kiriDistanceSquared(a, b));
    LipsInBox box = BeginBox(corridor, most);
    for (int32_t h = NextInBox(corridor, &box); h != KIRI_NONE; h = NextInBox(corridor, &box)) {
        kiriLatticePoint c, d;
        EdgePoints(corridor, h, &c, &d);
        double sideC = kiriCorridor_Side(corridor, c), sideD = kiriCorridor_Side(corridor, d);
        if ((sideC > 0.0) == (sideD > 0.0)) {
            continue;
        }
        kiriLatticePoint at = kiriLattice_Between(c, d, sideC / (sideC - sideD));
        double distance = sqrt((double)kiriDistanceSquared(at, to));
        if (distance <= most && kiriCorridor_Progress(corridor, at) > 0 &&
            fabs((double)kiriOrient(a, b, at)) <= 2.0 * corridor->on * length) {
            TakeNearerLip(&nearest, h, at, distance);
        }
    }
    *place = nearest.place.edge != KIRI_NONE ? nearest.place : *place;
}

kiriLipsNear kiriLip_FindNear(kiriCorridor* corridor, int32_t vertex)
{
    kiriLatticePoint to = corridor->to;
    NearestLip own = { { KIRI_NONE, to }, corridor->reach }, other = own;
    bool hasLine = corridor->length > 0.0;
    LipsInBox box = BeginBox(corridor, corridor->reach);
    for (int32_t h = NextInBox(corridor, &box); h != KIRI_NONE; h = NextInBox(corridor, &box)) {
        kiriLatticePoint a, b;
        EdgePoints(corridor, h, &a, &b);
        kiriLatticePoint foot = NearestOnEdge(a, b, to);
        double distance = sqrt((double)kiriDistanceSquared(foot, to));
        if (distance <= own.distance || distance <= other.distance) {
            bool isOwn = hasLine && vertex != KIRI_NONE && LeadsTo(corridor, vertex, a, b);
            TakeNearerLip(isOwn ? &own : &other, h, foot, distance);
        }
    }
    if (other.place.edge != KIRI_NONE && hasLine) {
        MeetOnLine(corridor, &other.place);
    }
    return (kiriLipsNear){ own.place, other.place };
}

/* ---- Along a line ------------------------------------------------------------------------------------------------ */

/* Is the vertex, which is beside the line, to be joined? Lips that lead from it to the line, or to a nearer vertex, do
   without. So do many, and those that run past an end of the line: they run along it. */
static bool IsLoose(kiriCorridor* corridor, int32_t vertex)
{
    enum { MANY = 48 };
    kiriLatticePoint seen[MANY], crossing;
    int32_t vertices[MANY], count = 1, end;
    double nearest = fabs(kiriCorridor_Side(corridor, PointOf(corridor, vertex)));
    vertices[0] = vertex;
    seen[0] = PointOf(corridor, vertex);
    for (int32_t i = 0; i < count; ++i) {
        LipsAround around = BeginAround(corridor, vertices[i]);
        while (NextLip(corridor, &around, &end) != KIRI_NONE) {
            kiriLatticePoint there = PointOf(corridor, end);
            double side = fabs(kiriCorridor_Side(corridor, there));
            if (Crosses(corridor, seen[i], there, &crossing)) {
                return false;
            }
            int32_t k = 0;
            while (k < count && !kiriLattice_IsSame(seen[k], there)) {
                ++k;
            }
            if (side > corridor->reach || k < count) {
                continue;
            }
            if (side < nearest || (side == nearest && end < vertex) || count == MANY ||
                !IsBetweenEnds(corridor, (double)kiriCorridor_Progress(corridor, there))) {
                return false;
            }
            vertices[count] = end;
            seen[count++] = there;
        }
    }
    return true;
}

static void TakeStop(kiriCorridor* corridor, int32_t vertex, int64_t after, bool* isFound, kiriLipStop* stop)
{
    kiriLatticePoint at = PointOf(corridor, vertex);
    int64_t progress = kiriCorridor_Progress(corridor, at), last = kiriCorridor_Progress(corridor, corridor->to),
            best = *isFound ? kiriCorridor_Progress(corridor, stop->at) : last;
    double side = fabs(kiriCorridor_Side(corridor, at));
    if (progress <= after || progress >= best || side > corridor->reach || !IsOnLip(corridor, vertex)) {
        return;
    }
    kiriLatticePoint foot =
        side <= corridor->on ? at : kiriLattice_Between(corridor->from, corridor->to, (double)progress / (double)last);
    if (side <= corridor->on || (IsLoose(corridor, vertex) && kiriMesh_Locate(corridor->mesh, foot) != KIRI_NONE)) {
        *isFound = true;
        *stop = (kiriLipStop){ foot, at };
    }
}

bool kiriLip_FindStop(kiriCorridor* corridor, kiriLatticePoint after, kiriLipStop* stop)
{
    const kiriMeshData* mesh = corridor->mesh;
    bool isFound = false;
    int64_t progress = kiriCorridor_Progress(corridor, after);
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, after, corridor->to, 2.0 * corridor->reach);
    while (kiriStrips_Next(&strips)) {
        for (int32_t i = 0; i < strips.count; ++i) {
            int32_t v = mesh->squares.vertexHead[strips.square + i * strips.stride];
            corridor->effort += PASSING_EFFORT;
            for (; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
                corridor->effort += PASSING_EFFORT;
                TakeStop(corridor, v, progress, &isFound, stop);
            }
        }
        /* Vertices of later strips are farther along the line. */
        double side = mesh->squares.side, border = ((double)strips.index + (strips.step < 0 ? 1.0 : 0.0)) * side;
        double start = strips.axis == 0 ? corridor->from.x : corridor->from.y;
        double way = strips.step * ((strips.axis == 0 ? corridor->to.x : corridor->to.y) - start);
        double ahead = strips.step * (border - start) - 2.0 * corridor->reach - 2.0;
        if (isFound && way > 0.0 &&
            ahead / way * corridor->length * corridor->length > (double)kiriCorridor_Progress(corridor, stop->at)) {
            break;
        }
    }
    return isFound;
}

/* ---- Strips of squares ------------------------------------------------------------------------------------------- */

/* The column or row of a coordinate, from the first one of the sheet on, in the range from -1 to `count`. */
static int32_t ClampLine(double coordinate, int32_t side, int32_t first, int32_t count)
{
    double line = (coordinate + 1.0) / side - first;
    return line < 0.0 ? -1 : line >= count ? count : (int32_t)line;
}

kiriStrips kiriStrips_Begin(const kiriSquares* squares, kiriLatticePoint from, kiriLatticePoint to, double margin)
{
    kiriStrips s = {
        squares, { from.x, from.y }, { (double)to.x - from.x, (double)to.y - from.y }, margin + 2.0, 0, 0, 0, 1, 0, 0, 0
    };
    s.axis = fabs(s.way[1]) > fabs(s.way[0]) ? 1 : 0;
    s.step = s.way[s.axis] < 0.0 ? -1 : 1;
    int32_t first = s.axis == 0 ? squares->firstColumn : squares->firstRow;
    int32_t count = s.axis == 0 ? squares->columns : squares->rows;
    double start = s.from[s.axis] - s.step * s.margin, end = s.from[s.axis] + s.way[s.axis] + s.step * s.margin;
    s.index = ClampLine(start, squares->side, first, count) + first;
    s.last = ClampLine(end, squares->side, first, count) + first;
    return s;
}

bool kiriStrips_Next(kiriStrips* s)
{
    const kiriSquares* squares = s->squares;
    int32_t other = 1 - s->axis, side = squares->side;
    int32_t first = s->axis == 0 ? squares->firstColumn : squares->firstRow;
    int32_t count = s->axis == 0 ? squares->columns : squares->rows;
    int32_t firstAcross = s->axis == 0 ? squares->firstRow : squares->firstColumn;
    int32_t countAcross = s->axis == 0 ? squares->rows : squares->columns;
    while (s->step * (s->last - s->index) >= 0) {
        int32_t strip = s->index - first;
        double near = (double)s->index * side - 1.0 - s->margin, far = near + side + 2.0 * s->margin;
        double way = s->way[s->axis];
        s->index += s->step;
        if (strip < 0 || strip >= count) {
            continue;
        }
        double a = way == 0.0 ? 0.0 : ((way > 0.0 ? near : far) - s->from[s->axis]) / way;
        double b = way == 0.0 ? 1.0 : ((way > 0.0 ? far : near) - s->from[s->axis]) / way;
        a = a < 0.0 ? 0.0 : a > 1.0 ? 1.0 : a;
        b = b < 0.0 ? 0.0 : b > 1.0 ? 1.0 : b;
        double p = s->from[other] + a * s->way[other], q = s->from[other] + b * s->way[other];
        int32_t low = ClampLine((p < q ? p : q) - s->margin, side, firstAcross, countAcross);
        int32_t high = ClampLine((p < q ? q : p) + s->margin, side, firstAcross, countAcross);
        low = low < 0 ? 0 : low;
        high = high >= countAcross ? countAcross - 1 : high;
        s->stride = s->axis == 0 ? squares->columns : 1;
        s->square = s->axis == 0 ? low * squares->columns + strip : strip * squares->columns + low;
        s->count = high - low + 1 > 0 ? high - low + 1 : 0;
        return true;
    }
    return false;
}
