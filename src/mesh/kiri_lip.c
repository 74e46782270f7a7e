#include "kiri_lip.h"

/* Costs in ns, about: of a triangle around a vertex or in the list of a square, and of a vertex in a list. */
enum { LIP_EFFORT = 8, PASSING_EFFORT = 2 };

/* ---- Corridor ---------------------------------------------------------------------------------------------------- */

kiriCorridor kiriCorridor_Make(const kiriMeshData* mesh, kiriLatticePoint from, kiriLatticePoint to, double on,
                               double reach, bool isFold)
{
    kiriCorridor corridor = { mesh, from, to, sqrt((double)kiriDistanceSquared(from, to)), on, reach, isFold, 0 };
    KIRI_ASSERT(on >= 0.0 && reach >= on);
    return corridor;
}

static bool IsLip(const kiriCorridor* corridor, int32_t h)
{
    return kiriMesh_IsOpen(corridor->mesh, h) && (corridor->isFold || !kiriMesh_IsCrease(corridor->mesh, h));
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
    return kiriMesh_At(corridor->mesh, vertex);
}

kiriLatticePoint kiriLattice_Between(kiriLatticePoint a, kiriLatticePoint b, double share)
{
    return kiriMesh_Round(kiriVec2_Make(a.x + share * ((double)b.x - a.x), a.y + share * ((double)b.y - a.y)));
}

kiriLatticePoint kiriLattice_Nearest(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint p)
{
    double share = (double)kiriLattice_Dot(a, b, p) / (double)kiriDistanceSquared(a, b);
    return kiriLattice_Between(a, b, kiriClamp(share, 0.0, 1.0));
}

/* ---- Around a vertex --------------------------------------------------------------------------------------------- */

int32_t kiriMesh_FirstAround(const kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT_HAS(mesh->vertices, vertex);
    int32_t start = mesh->vertices.data[vertex].edge, h = start;
    KIRI_ASSERT(kiriMesh_Tail(mesh, start) == vertex);
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
    while (v != KIRI_NONE && !kiriLattice_IsSame(kiriMesh_At(mesh, v), at)) {
        *effort += PASSING_EFFORT;
        v = mesh->vertices.data[v].next;
    }
    return v;
}

/* The lips at the point of a vertex. */
typedef struct LipsAround {
    int32_t first, next;  /* half-edges around the point */
    bool endsWithOutline; /* the outline that ends the fan is the next lip */
    int32_t lip, end;     /* the current lip, and the vertex at its other end */
} LipsAround;

static LipsAround BeginLips(const kiriCorridor* corridor, int32_t vertex)
{
    int32_t first = kiriMesh_FirstAround(corridor->mesh, vertex);
    return (LipsAround){ first, first, false, KIRI_NONE, KIRI_NONE };
}

/* Goes to the next lip. Returns false after the last. */
static bool NextLip(kiriCorridor* corridor, LipsAround* around)
{
    const kiriMeshData* mesh = corridor->mesh;
    while (around->next != KIRI_NONE) {
        int32_t h = around->next, previous = kiriEdge_Previous(h);
        bool isLast = around->endsWithOutline, isOutline = kiriMesh_Twin(mesh, previous) == KIRI_NONE;
        corridor->effort += LIP_EFFORT;
        around->endsWithOutline = isOutline && !isLast;
        around->next = around->endsWithOutline ? h : kiriMesh_NextAround(mesh, h, around->first);
        if (isLast || kiriMesh_Twin(mesh, h) == KIRI_NONE || IsLip(corridor, h)) {
            around->lip = isLast ? previous : h;
            around->end = isLast ? kiriMesh_Tail(mesh, previous) : kiriMesh_Head(mesh, h);
            return true;
        }
    }
    return false;
}

/* ---- Along lips -------------------------------------------------------------------------------------------------- */

/* Returns true if q is farther along the line than p. Points that are as far are ordered by their sides, so that no walk
   along lips comes back. */
static bool IsAhead(const kiriCorridor* corridor, kiriLatticePoint p, kiriLatticePoint q)
{
    int64_t from = kiriCorridor_Progress(corridor, p), to = kiriCorridor_Progress(corridor, q);
    return to > from ||
           (to == from && kiriOrient(corridor->from, corridor->to, q) > kiriOrient(corridor->from, corridor->to, p));
}

/* Returns true if the line crosses the edge between two points that are not on it. */
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
    kiriLatticePoint recent[RECENT]; /* the last points, a ring */
    int32_t steps;
    int64_t farthest; /* progress */
    int32_t idle;     /* steps since the progress grew */
} LipWalk;

static void StepTo(const kiriCorridor* corridor, LipWalk* walk, int32_t vertex)
{
    int64_t progress = kiriCorridor_Progress(corridor, PointOf(corridor, vertex));
    walk->vertex = vertex;
    walk->recent[walk->steps++ % RECENT] = PointOf(corridor, vertex);
    walk->idle = progress > walk->farthest ? 0 : walk->idle + 1;
    walk->farthest = kiriMax(progress, walk->farthest);
}

static LipWalk BeginLipWalk(const kiriCorridor* corridor, int32_t vertex)
{
    LipWalk walk = { vertex, { { 0, 0 } }, 0, INT64_MIN, 0 };
    StepTo(corridor, &walk, vertex);
    return walk;
}

/* Steps to the next vertex: of the vertices that are ahead the one nearest to the line. If none is ahead, a few steps may
   lead back, by no more than the width of the corridor: lips meet at any angle. */
static bool StepAlong(kiriCorridor* corridor, LipWalk* walk)
{
    LipsAround around = BeginLips(corridor, walk->vertex);
    int32_t best = KIRI_NONE;
    double least = 0.0, back = (double)walk->farthest - 2.0 * corridor->reach * corridor->length;
    bool isBestAhead = false;
    while (NextLip(corridor, &around)) {
        kiriLatticePoint there = PointOf(corridor, around.end);
        double side = fabs(kiriCorridor_Side(corridor, there));
        int64_t progress = kiriCorridor_Progress(corridor, there);
        bool isAhead = progress > walk->farthest;
        bool canTake =
            side <= corridor->reach && (isAhead || (walk->idle < MOST_IDLE && (double)progress >= back));
        for (int32_t i = 0; i < walk->steps && i < RECENT; ++i) {
            canTake = canTake && !kiriLattice_IsSame(walk->recent[i], there);
        }
        if (canTake &&
            (best == KIRI_NONE || isAhead > isBestAhead || (isAhead == isBestAhead && side < least))) {
            best = around.end;
            least = side;
            isBestAhead = isAhead;
        }
    }
    if (best != KIRI_NONE) {
        StepTo(corridor, walk, best);
    }
    return best != KIRI_NONE;
}

/* Finds the lip at this vertex that crosses the line beyond `start`. */
static bool FindCrossing(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint start, kiriLipPoint* place)
{
    LipsAround around = BeginLips(corridor, vertex);
    bool isFound = false;
    while (!isFound && NextLip(corridor, &around)) {
        isFound = Crosses(corridor, PointOf(corridor, vertex), PointOf(corridor, around.end), &place->at) &&
                  IsAhead(corridor, start, place->at);
    }
    place->edge = isFound ? around.lip : KIRI_NONE;
    return isFound;
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
    LipsAround around = BeginLips(corridor, vertex);
    while (fabs(side) <= width && NextLip(corridor, &around)) {
        kiriLatticePoint there = PointOf(corridor, around.end);
        double share = 1.0, sideThere = kiriCorridor_Side(corridor, there),
               progressThere = (double)kiriCorridor_Progress(corridor, there);
        if (fabs(sideThere) > width) {
            share = ((sideThere > 0.0 ? width : -width) - side) / (sideThere - side);
        }
        if (progress + share * (progressThere - progress) > most) {
            share = (most - progress) / (progressThere - progress);
        }
        if (share >= 0.0 && progress + share * (progressThere - progress) > farthest->progress) {
            farthest->place = (kiriLipPoint){ around.lip, kiriLattice_Between(here, there, share) };
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
        bool isOn = fabs(kiriCorridor_Side(corridor, here)) <= corridor->on && IsAhead(corridor, start, here);
        *place = (kiriLipPoint){ corridor->mesh->vertices.data[walk->vertex].edge, here };
        if ((isOn || FindCrossing(corridor, walk->vertex, start, place)) &&
            kiriCorridor_Progress(corridor, place->at) <= most) {
            return true;
        }
        TakeFarther(corridor, walk->vertex, (double)most, farthest);
    } while ((double)walk->farthest <= beyond && StepAlong(corridor, walk));
    return false;
}

/* Adds a vertex, unless one at its point is there. */
static bool AddPoint(const kiriCorridor* corridor, int32_t vertex, int32_t* vertices, int32_t most, int32_t* count)
{
    int32_t k = 0;
    while (k < *count && !kiriLattice_IsSame(PointOf(corridor, vertices[k]), PointOf(corridor, vertex))) {
        ++k;
    }
    bool isAdded = k == *count && k < most;
    if (isAdded) {
        vertices[(*count)++] = vertex;
    }
    return isAdded;
}

/* Returns true if lips lead from the vertex to a point, on any way within the corridor: at most its width before `first`
   or beyond the point. */
static bool IsReached(kiriCorridor* corridor, int32_t vertex, double first, kiriLatticePoint to)
{
    enum { MANY = 48 };
    int32_t vertices[MANY] = { vertex }, count = 1;
    const double width = 2.0 * corridor->reach * corridor->length;
    const double least = first - width, most = (double)kiriCorridor_Progress(corridor, to) + width;
    KIRI_TIMES(i, count) {
        LipsAround around = BeginLips(corridor, vertices[i]);
        while (NextLip(corridor, &around)) {
            kiriLatticePoint there = PointOf(corridor, around.end);
            double progress = (double)kiriCorridor_Progress(corridor, there);
            if (kiriLattice_IsSame(there, to)) {
                return true;
            }
            if (fabs(kiriCorridor_Side(corridor, there)) <= corridor->reach && progress >= least && progress <= most) {
                AddPoint(corridor, around.end, vertices, MANY, &count);
            }
        }
    }
    return false;
}

bool kiriLip_Follow(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint limit, kiriLipPoint* place)
{
    int64_t most = kiriCorridor_Progress(corridor, limit);
    kiriLatticePoint start = PointOf(corridor, vertex);
    KIRI_ASSERT(corridor->length > 0.0);
    const double first = (double)kiriCorridor_Progress(corridor, start), width = corridor->reach * corridor->length;
    FarthestLip farthest = { { KIRI_NONE, start }, first };
    if (FindCrossing(corridor, vertex, start, place)) {
        return kiriCorridor_Progress(corridor, place->at) <= most;
    }
    TakeFarther(corridor, vertex, (double)most, &farthest);
    LipsAround around = BeginLips(corridor, vertex);
    while (NextLip(corridor, &around)) {
        kiriLatticePoint there = PointOf(corridor, around.end);
        if (fabs(kiriCorridor_Side(corridor, there)) <= corridor->reach &&
            (double)kiriCorridor_Progress(corridor, there) >= first - 2.0 * width) {
            LipWalk walk = BeginLipWalk(corridor, vertex);
            StepTo(corridor, &walk, around.end);
            if (FollowFrom(corridor, &walk, start, most, place, &farthest)) {
                return true;
            }
        }
    }
    int32_t last = kiriMesh_VertexAt(corridor->mesh, limit, &corridor->effort);
    if (last != KIRI_NONE && IsReached(corridor, vertex, first, limit)) {
        *place = (kiriLipPoint){ corridor->mesh->vertices.data[last].edge, limit };
        return true;
    }
    *place = farthest.place;
    return place->edge != KIRI_NONE &&
           farthest.progress - first >= KIRI_SHALLOW * fabs(kiriCorridor_Side(corridor, place->at)) * corridor->length;
}

/* Returns true if lips lead from the vertex to a or b, within the corridor. */
static bool LeadsTo(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint a, kiriLatticePoint b)
{
    double most = corridor->length * (corridor->length + corridor->reach);
    LipWalk walk = BeginLipWalk(corridor, vertex);
    bool isThere;
    do {
        kiriLatticePoint here = PointOf(corridor, walk.vertex);
        isThere = kiriLattice_IsSame(here, a) || kiriLattice_IsSame(here, b);
    } while (!isThere && (double)walk.farthest <= most && StepAlong(corridor, &walk));
    return isThere;
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

/* The lips of the triangles around corridor->to. Some come twice. */
typedef struct LipsInBox {
    kiriNearby nearby;
    int32_t next, end; /* half-edges of the current triangle */
    int32_t lip;
    kiriLatticePoint a, b; /* the ends of the lip */
} LipsInBox;

static LipsInBox BeginBox(const kiriCorridor* corridor, double size)
{
    kiriNearby nearby = kiriNearby_Begin(&corridor->mesh->squares, corridor->to, corridor->to, size);
    return (LipsInBox){ nearby, 0, 0, KIRI_NONE, corridor->to, corridor->to };
}

/* Goes to the next lip. Returns false after the last. */
static bool NextInBox(kiriCorridor* corridor, LipsInBox* box)
{
    const kiriMeshData* mesh = corridor->mesh;
    for (;;) {
        while (box->next < box->end) {
            int32_t h = box->next++, twin = kiriMesh_Twin(mesh, h);
            if (twin == KIRI_NONE || (h < twin && IsLip(corridor, h))) {
                box->lip = h;
                box->a = kiriMesh_TailAt(mesh, h);
                box->b = kiriMesh_HeadAt(mesh, h);
                return true;
            }
        }
        int32_t triangle = kiriNearby_Next(&box->nearby);
        if (triangle == KIRI_NONE) {
            return false;
        }
        box->next = 3 * triangle;
        box->end = box->next + 3;
        corridor->effort += LIP_EFFORT;
    }
}

/* Moves the place to where the line meets this lip, or one that goes on in its direction, near the end of the line: so the
   cut stays straight. */
static void MeetOnLine(kiriCorridor* corridor, kiriLipPoint* place)
{
    kiriLatticePoint a = kiriMesh_TailAt(corridor->mesh, place->edge), b = kiriMesh_HeadAt(corridor->mesh, place->edge),
                     to = corridor->to;
    const double most = OBLIQUE * sqrt((double)kiriDistanceSquared(place->at, to)),
                 length = sqrt((double)kiriDistanceSquared(a, b));
    NearestLip nearest = { { KIRI_NONE, to }, most };
    LipsInBox box = BeginBox(corridor, most);
    while (NextInBox(corridor, &box)) {
        double sideA = kiriCorridor_Side(corridor, box.a), sideB = kiriCorridor_Side(corridor, box.b);
        if ((sideA > 0.0) == (sideB > 0.0)) {
            continue;
        }
        kiriLatticePoint at = kiriLattice_Between(box.a, box.b, sideA / (sideA - sideB));
        double distance = sqrt((double)kiriDistanceSquared(at, to));
        if (distance <= most && kiriCorridor_Progress(corridor, at) > 0 &&
            fabs((double)kiriOrient(a, b, at)) <= 2.0 * corridor->on * length) {
            TakeNearerLip(&nearest, box.lip, at, distance);
        }
    }
    *place = nearest.place.edge != KIRI_NONE ? nearest.place : *place;
}

kiriLipsNear kiriLip_FindNear(kiriCorridor* corridor, int32_t vertex)
{
    KIRI_ASSERT(vertex == KIRI_NONE || kiriLattice_IsSame(PointOf(corridor, vertex), corridor->from));
    kiriLatticePoint to = corridor->to;
    NearestLip own = { { KIRI_NONE, to }, corridor->reach }, other = own;
    bool hasLine = corridor->length > 0.0;
    LipsInBox box = BeginBox(corridor, corridor->reach);
    while (NextInBox(corridor, &box)) {
        kiriLatticePoint foot = kiriLattice_Nearest(box.a, box.b, to);
        double distance = sqrt((double)kiriDistanceSquared(foot, to));
        if (distance <= own.distance || distance <= other.distance) {
            bool isOwn = hasLine && vertex != KIRI_NONE && LeadsTo(corridor, vertex, box.a, box.b);
            TakeNearerLip(isOwn ? &own : &other, box.lip, foot, distance);
        }
    }
    if (other.place.edge != KIRI_NONE && hasLine) {
        MeetOnLine(corridor, &other.place);
    }
    return (kiriLipsNear){ own.place, other.place };
}

/* ---- Along a line ------------------------------------------------------------------------------------------------ */

/* Returns true if a vertex beside the line is to be joined: no lip leads from it to the line, or to a nearer vertex. Lips
   that run past an end of the line, and long lips, run along it. */
static bool IsLoose(kiriCorridor* corridor, int32_t vertex)
{
    enum { MANY = 48 };
    int32_t vertices[MANY] = { vertex }, count = 1;
    double nearest = fabs(kiriCorridor_Side(corridor, PointOf(corridor, vertex)));
    KIRI_TIMES(i, count) {
        LipsAround around = BeginLips(corridor, vertices[i]);
        while (NextLip(corridor, &around)) {
            kiriLatticePoint there = PointOf(corridor, around.end), crossing;
            double side = fabs(kiriCorridor_Side(corridor, there));
            if (Crosses(corridor, PointOf(corridor, vertices[i]), there, &crossing)) {
                return false;
            }
            bool isFull = count == MANY;
            if (side > corridor->reach ||
                !(isFull || AddPoint(corridor, around.end, vertices, MANY, &count))) {
                continue;
            }
            if (side < nearest || (side == nearest && around.end < vertex) || isFull ||
                !IsBetweenEnds(corridor, (double)kiriCorridor_Progress(corridor, there))) {
                return false;
            }
        }
    }
    return true;
}

/* Returns true if lips lead from the blade to a point at most twice the reach beside the line: a cut that joins it would cut
   off a thin crumb. */
static bool HasLeft(kiriCorridor* corridor, int32_t blade, kiriLatticePoint at)
{
    kiriCorridor wide = *corridor;
    wide.reach *= 2.0;
    bool hasLeft = blade != KIRI_NONE && IsReached(&wide, blade, 0.0, at);
    corridor->effort = wide.effort;
    return hasLeft;
}

/* Takes a vertex as the stop if it is to be joined, between `after` and the stop that was found before. */
static void TakeStop(kiriCorridor* corridor, int32_t blade, int32_t vertex, int64_t after, bool* isFound,
                     kiriLipStop* stop)
{
    kiriLatticePoint at = PointOf(corridor, vertex);
    int64_t progress = kiriCorridor_Progress(corridor, at), last = kiriCorridor_Progress(corridor, corridor->to),
            best = *isFound ? kiriCorridor_Progress(corridor, stop->at) : last;
    double side = fabs(kiriCorridor_Side(corridor, at));
    if (progress <= after || progress >= best || side > corridor->reach) {
        return;
    }
    LipsAround around = BeginLips(corridor, vertex);
    bool isOn = side <= corridor->on, isOnLip = NextLip(corridor, &around);
    kiriLatticePoint foot =
        isOn ? at : kiriLattice_Between(corridor->from, corridor->to, (double)progress / (double)last);
    if (isOnLip &&
        (isOn || (IsLoose(corridor, vertex) && kiriMesh_Locate(corridor->mesh, foot) != KIRI_NONE &&
                  !HasLeft(corridor, blade, at)))) {
        *isFound = true;
        *stop = (kiriLipStop){ foot, at };
    }
}

bool kiriLip_FindStop(kiriCorridor* corridor, int32_t vertex, kiriLatticePoint after, kiriLipStop* stop)
{
    KIRI_ASSERT(corridor->length > 0.0);
    const kiriMeshData* mesh = corridor->mesh;
    bool isFound = false;
    int64_t progress = kiriCorridor_Progress(corridor, after);
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, after, corridor->to, 2.0 * corridor->reach);
    while (kiriStrips_Next(&strips)) {
        KIRI_EACH_INDEX(i, strips) {
            int32_t v = mesh->squares.vertexHead[strips.square + i * strips.stride];
            corridor->effort += PASSING_EFFORT;
            for (; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
                corridor->effort += PASSING_EFFORT;
                TakeStop(corridor, vertex, v, progress, &isFound, stop);
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
