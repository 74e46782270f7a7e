#include "kiri_cut.h"
#include "../core/kiri_array.h"
#include "kiri_lip.h"

/* ---- The material along a line ----------------------------------------------------------------------------------- */

/* Distance beside the line at which the material is searched, in sides of a square. */
#define BESIDE (1.0 / 1024.0)

/* Clips [*from, *to] to the part where a linear function, with these values at the ends of the line, is positive. If
   the function is zero throughout, `keep` decides. Neighbours that share a side have the same function with opposite
   signs, so their parts have no gap and no overlap. */
static void ClipBy(double first, double last, bool keep, double* from, double* to)
{
    if (first == 0.0 && last == 0.0) {
        *to = keep ? *to : *from;
    } else if (first <= 0.0 && last <= 0.0) {
        *to = *from;
    } else if (first < 0.0) {
        double t = first / (first - last);
        *from = kiriMax(t, *from);
    } else if (last < 0.0) {
        double t = first / (first - last);
        *to = kiriMin(t, *to);
    }
}

/* Adds the parts of the line from p[0] to p[1] in the triangles of a square. */
static bool CoverSquare(const kiriMeshData* mesh, const kiriLatticePoint p[2], kiriMemory* memory, int32_t square,
                        kiriLine* line)
{
    const kiriSquares* squares = &mesh->squares;
    const kiriLatticePoint low = kiriSquares_Corner(squares, square);
    const double side = squares->side;
    KIRI_ASSERT((p[0].x & 1) != 0 && (p[0].y & 1) != 0 && (p[1].x & 1) != 0 && (p[1].y & 1) != 0);
    kiriLineCover whole = { 0.0, 1.0, KIRI_NONE };
    ClipBy((double)p[0].x - low.x, (double)p[1].x - low.x, true, &whole.from, &whole.to);
    ClipBy(low.x + side - p[0].x, low.x + side - p[1].x, false, &whole.from, &whole.to);
    ClipBy((double)p[0].y - low.y, (double)p[1].y - low.y, true, &whole.from, &whole.to);
    ClipBy(low.y + side - p[0].y, low.y + side - p[1].y, false, &whole.from, &whole.to);
    for (int32_t node = squares->head[square]; whole.from < whole.to && node != KIRI_NONE;
         node = squares->nodes.data[node].next) {
        kiriLineCover cover = { whole.from, whole.to, node };
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, squares->nodes.data[node].triangle, c);
        KIRI_EACH_CORNER(i) {
            kiriLatticePoint a = c[i], b = c[(i + 1) % 3];
            bool isUp = a.y < b.y || (a.y == b.y && a.x < b.x);
            ClipBy((double)kiriOrient(a, b, p[0]), (double)kiriOrient(a, b, p[1]), isUp, &cover.from, &cover.to);
        }
        if (cover.from < cover.to && !kiriArray_Push(memory, &line->covers, cover)) {
            return false;
        }
    }
    return true;
}

static bool IsCoverBefore(const void* context, int32_t a, int32_t b)
{
    const kiriLineCover *x = (const kiriLineCover*)context + a, *y = (const kiriLineCover*)context + b;
    return x->from != y->from ? x->from < y->from : x->to != y->to ? x->to < y->to : a < b;
}

/* Adds the covers of the line beside the traced one, to its left (way 1) or right (-1), and sorts them. The ends of that
   line are odd, so no vertex is on them, and it runs along no edge that is parallel to an axis. */
static bool CoverLine(const kiriMeshData* mesh, kiriMemory* memory, const kiriLatticePoint ends[2], double way,
                      kiriLine* line, kiriIndices* order)
{
    kiriVec2 along = { (double)ends[1].x - ends[0].x, (double)ends[1].y - ends[0].y };
    double beside = way * BESIDE * mesh->squares.side / kiriVec2_Length(along);
    int32_t first = line->covers.count;
    kiriLatticePoint p[2];
    KIRI_TIMES(k, 2) {
        p[k] = kiriMesh_Round(kiriVec2_Make(ends[k].x - beside * along.y, ends[k].y + beside * along.x));
        p[k].x += 1;
        p[k].y += 1;
    }
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, p[0], p[1], 0.0);
    while (kiriStrips_Next(&strips)) {
        KIRI_EACH_INDEX(i, strips) {
            if (!CoverSquare(mesh, p, memory, strips.square + i * strips.stride, line)) {
                return false;
            }
        }
    }
    if (!kiriArray_Resize(memory, order, line->covers.count - first)) {
        return false;
    }
    KIRI_EACH_INDEX(k, *order) {
        order->data[k] = first + k;
    }
    kiriSort(order->data, order->count, IsCoverBefore, line->covers.data);
    return true;
}

/* Returns the node that covers the line at t, or KIRI_NONE. *next is its place in the order; *end is moved to where the
   cover changes. */
static int32_t CoverAt(const kiriLine* line, const kiriIndices* order, int32_t* next, double t, double* end)
{
    while (*next < order->count && line->covers.data[order->data[*next]].to <= t) {
        *next += 1;
    }
    if (*next == order->count) {
        return KIRI_NONE;
    }
    const kiriLineCover* cover = &line->covers.data[order->data[*next]];
    double change = cover->from <= t ? cover->to : cover->from;
    KIRI_ASSERT(change > t);
    *end = kiriMin(change, *end);
    return cover->from <= t ? cover->node : KIRI_NONE;
}

bool kiriLine_Trace(kiriLine* line, kiriMemory* memory, const kiriMeshData* mesh, kiriLatticePoint from,
                    kiriLatticePoint to)
{
    const kiriLatticePoint ends[2] = { from, to };
    int32_t next[2] = { 0 };
    bool ok = true;
    KIRI_ASSERT(!kiriLattice_IsSame(from, to));
    line->parts.count = line->covers.count = 0;
    KIRI_TIMES_WHILE(ok, k, 2) {
        ok = CoverLine(mesh, memory, ends, k == 0 ? 1.0 : -1.0, line, &line->order[k]);
    }
    for (double t = 0.0; ok && t < 1.0;) {
        kiriLinePart part = { t, 1.0, { KIRI_NONE, KIRI_NONE } };
        KIRI_TIMES(k, 2) {
            part.node[k] = CoverAt(line, &line->order[k], &next[k], t, &part.to);
        }
        bool isCovered = part.node[0] != KIRI_NONE || part.node[1] != KIRI_NONE;
        ok = !isCovered || kiriArray_Push(memory, &line->parts, part);
        t = part.to;
    }
    return ok;
}

/* ---- The blade --------------------------------------------------------------------------------------------------- */

/* Range of the lattice: the box of the sheet and half its longer side around it. */
static const double LowestCoordinate = -0.5 * KIRI_LATTICE, HighestCoordinate = 1.5 * KIRI_LATTICE;

/* Cost in ns, about, of a triangle around a vertex or in the list of a square; and of an item of the quota. */
enum { LOOK_EFFORT = 8, ITEM_EFFORT = 512 };

/* Distances in snaps: the blade takes corners and edges of the mesh within ON, and lips within REACH. The ends of a cut
   are within ON of their points, and the cut within ON of the line between them: so within 2 ON of the line that was
   drawn. Then ends that are a snap apart are within REACH, and ends two snaps apart are not. Edges that cross the way
   within APART of each other are flipped if possible: else lines beside each other would make more vertices each time. */
static const double ON = 0.25, REACH = 1.5, APART = 4.0;
enum { SLACK = 16 };

/* One straight move of a blade. It walks the mesh as the plane triangulation that it is, whether edges are open or not;
   only the outline stops the walk. So older cuts are not special. */
typedef struct BladeWalk {
    kiriMeshData* mesh;
    kiriBladeTip* tip;
    double on, reach, apart; /* lattice steps */
    double slack; /* lattice steps: vertices nearer to each other would make triangles too thin to split */
    kiriLatticePoint lineFrom, lineTo; /* the blade keeps to this line */
    int32_t splits;                    /* triangles made or reshaped */
    int64_t effort;                    /* of searches, about ns */
    bool failed;                       /* out of memory */
} BladeWalk;

static kiriLatticePoint VertexPoint(const BladeWalk* walk, int32_t vertex)
{
    return kiriMesh_At(walk->mesh, vertex);
}

/* Every step must bring the blade nearer to its goal: so the walk ends, whatever rounding and snapping do. */
static bool IsNearerGoal(const BladeWalk* walk, kiriLatticePoint p)
{
    return kiriDistanceSquared(p, walk->tip->goal) < kiriDistanceSquared(walk->tip->at, walk->tip->goal);
}

static bool IsWithinDistance(kiriLatticePoint a, kiriLatticePoint b, double distance)
{
    return (double)kiriDistanceSquared(a, b) <= distance * distance;
}

/* Returns true if a point is within `on` of the line of the move. That is the line from the begin of the move, not from
   the last corner: small errors must not add up to a detour. */
static bool IsOnLine(const BladeWalk* walk, kiriLatticePoint p)
{
    double length = sqrt((double)kiriDistanceSquared(walk->lineFrom, walk->lineTo));
    return fabs((double)kiriOrient(walk->lineFrom, walk->lineTo, p)) <= walk->on * length;
}

static int32_t SplitEdge(BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    KIRI_ASSERT(kiriMesh_CanSplitEdge(walk->mesh, h, at));
    walk->splits += kiriMesh_Twin(walk->mesh, h) == KIRI_NONE ? 2 : 4;
    int32_t vertex = kiriMesh_SplitEdge(walk->mesh, h, at);
    walk->failed = walk->failed || vertex == KIRI_NONE;
    return vertex;
}

/* ---- Around a vertex --------------------------------------------------------------------------------------------- */

/* Returns true if the way to the goal starts in the wedge left of h, from h (inclusive) to the previous half-edge
   (exclusive). */
static bool WedgeHolds(const BladeWalk* walk, int32_t h)
{
    kiriLatticePoint right = kiriMesh_HeadAt(walk->mesh, h), left = kiriMesh_TailAt(walk->mesh, kiriEdge_Previous(h));
    return kiriOrient(walk->tip->at, right, walk->tip->goal) >= 0 &&
           kiriOrient(walk->tip->at, left, walk->tip->goal) < 0;
}

/* Returns the half-edge whose wedge holds the way to the goal, or KIRI_NONE: the blade leaves the sheet. Where corners of
   the outline touch, twins do not lead from one to the other, but their triangles are in the same square. */
static int32_t FindWedge(BladeWalk* walk)
{
    const kiriMeshData* mesh = walk->mesh;
    KIRI_ASSERT(kiriLattice_IsSame(VertexPoint(walk, walk->tip->vertex), walk->tip->at));
    int32_t first = kiriMesh_FirstAround(mesh, walk->tip->vertex), found = KIRI_NONE;
    for (int32_t h = first; h != KIRI_NONE; h = kiriMesh_NextAround(mesh, h, first)) {
        walk->effort += LOOK_EFFORT;
        if (WedgeHolds(walk, h)) {
            return h;
        }
    }
    KIRI_EACH_NODE(slot, &mesh->squares, kiriSquares_At(&mesh->squares, walk->tip->at)) {
        walk->effort += LOOK_EFFORT;
        KIRI_EACH_CORNER(i) {
            int32_t h = 3 * mesh->squares.nodes.data[slot].triangle + i;
            bool isHere = kiriLattice_IsSame(kiriMesh_TailAt(mesh, h), walk->tip->at);
            if (isHere && (found == KIRI_NONE || h < found) && WedgeHolds(walk, h)) {
                found = h;
            }
        }
    }
    return found;
}

/* Opens the edge from a vertex to a neighboring point. */
static bool OpenBetween(BladeWalk* walk, int32_t vertex, kiriLatticePoint other)
{
    const kiriMeshData* mesh = walk->mesh;
    KIRI_ASSERT(!kiriLattice_IsSame(VertexPoint(walk, vertex), other));
    int32_t first = kiriMesh_FirstAround(mesh, vertex);
    for (int32_t h = first; h != KIRI_NONE; h = kiriMesh_NextAround(mesh, h, first)) {
        int32_t previous = kiriEdge_Previous(h);
        walk->effort += 2 * LOOK_EFFORT; /* once more where the fan is torn */
        bool leaves = kiriLattice_IsSame(kiriMesh_HeadAt(mesh, h), other);
        if (leaves || kiriLattice_IsSame(kiriMesh_TailAt(mesh, previous), other)) {
            walk->failed = !kiriMesh_Open(walk->mesh, leaves ? h : previous, walk->tip->fold != 0);
            return !walk->failed;
        }
    }
    return false;
}

/* ---- Splits that may be made ------------------------------------------------------------------------------------- */

/* Parts of the caller's sheet that are not joined may lie on each other by a few lattice steps (kiri_mesh_build.c). A
   split in one, at a vertex of the other, must not make an edge that the other has: each half-edge is alone between its
   ends. The parts overlap only within 64 steps (along both axes) of an edge of one of them, so an edge there has a thin
   triangle on one side. Other splits inside the sheet need no search. */
static bool IsThin(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint c)
{
    enum { THIN = 256 };
    const kiriLatticePoint p[4] = { a, b, c, a };
    int64_t around = 0;
    KIRI_EACH_CORNER(i) {
        int64_t x = (int64_t)p[i + 1].x - p[i].x, y = (int64_t)p[i + 1].y - p[i].y;
        around += kiriMax(x, -x) + kiriMax(y, -y);
    }
    return kiriOrient(a, b, c) <= THIN * around / 2;
}

/* Returns true if a triangle has a corner at this point, and one of these edges: to the next or from the previous
   corner. */
static bool IsCornerTaken(BladeWalk* walk, kiriLatticePoint at, kiriLatticePoint next, kiriLatticePoint previous)
{
    const kiriMeshData* mesh = walk->mesh;
    KIRI_EACH_NODE(slot, &mesh->squares, kiriSquares_At(&mesh->squares, at)) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, mesh->squares.nodes.data[slot].triangle, c);
        walk->effort += LOOK_EFFORT;
        KIRI_EACH_CORNER(i) {
            if (kiriLattice_IsSame(c[i], at) &&
                (kiriLattice_IsSame(c[(i + 1) % 3], next) || kiriLattice_IsSame(c[(i + 2) % 3], previous))) {
                return true;
            }
        }
    }
    return false;
}

/* Returns true if no triangle has an edge that these new triangles get, each with a corner at this point and the side
   opposite of it. */
static bool AreEdgesFree(BladeWalk* walk, kiriLatticePoint at, const kiriLatticePoint (*sides)[2], int count,
                         bool isOutline)
{
    bool mustLook = isOutline, isTaken = false;
    KIRI_TIMES(k, count) {
        mustLook = mustLook || IsThin(at, sides[k][0], sides[k][1]);
    }
    mustLook = mustLook && kiriMesh_VertexAt(walk->mesh, at, &walk->effort) != KIRI_NONE;
    KIRI_TIMES_WHILE(mustLook, k, count) {
        isTaken = isTaken || IsCornerTaken(walk, at, sides[k][0], sides[k][1]);
    }
    return !isTaken;
}

static bool CanSplitEdge(BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    const kiriMeshData* mesh = walk->mesh;
    kiriLatticePoint sides[4][2];
    int count = 0;
    for (int32_t g = h; count < 4 && g != KIRI_NONE; g = kiriMesh_Twin(mesh, h), count += 2) {
        kiriLatticePoint apex = kiriMesh_TailAt(mesh, kiriEdge_Previous(g));
        sides[count][0] = sides[count + 1][1] = apex;
        sides[count][1] = kiriMesh_TailAt(mesh, g);
        sides[count + 1][0] = kiriMesh_HeadAt(mesh, g);
    }
    return kiriMesh_CanSplitEdge(mesh, h, at) &&
           AreEdgesFree(walk, at, (const kiriLatticePoint(*)[2])sides, count, count == 2);
}

/* Flips an edge, so that the vertex opposite of it sees farther. The segment from there to the goal then crosses one edge
   less, so a walk flips finitely many. */
static bool FlipEdge(BladeWalk* walk, int32_t h)
{
    if (!kiriMesh_CanFlipEdge(walk->mesh, h)) {
        return false;
    }
    kiriLatticePoint c = kiriMesh_TailAt(walk->mesh, kiriEdge_Previous(h)),
                     d = kiriMesh_TailAt(walk->mesh, kiriEdge_Previous(kiriMesh_Twin(walk->mesh, h)));
    if (IsCornerTaken(walk, d, c, c)) {
        return false;
    }
    walk->splits += 2;
    walk->failed = !kiriMesh_FlipEdge(walk->mesh, h);
    return true;
}

/* ---- Vertices for the blade -------------------------------------------------------------------------------------- */

/* Finds a point near this one where the edge can be split, within `on`. Beside a triangle that is only a few lattice steps
   high it is a little beside the edge, or farther along it, so that new triangles are counter-clockwise. */
static bool FindSplit(BladeWalk* walk, int32_t h, kiriLatticePoint* at)
{
    static const double along[] = { 0.0, 0.125, -0.125, 0.25, -0.25, 0.5, -0.5, 1.0, -1.0 };
    kiriLatticePoint a = kiriMesh_TailAt(walk->mesh, h), b = kiriMesh_HeadAt(walk->mesh, h), p = *at;
    KIRI_ASSERT(!kiriLattice_IsSame(a, b));
    double length = sqrt((double)kiriDistanceSquared(a, b)), x = ((double)b.x - a.x) / length,
           y = ((double)b.y - a.y) / length;
    bool canSplit = CanSplitEdge(walk, h, p), isOutline = kiriMesh_Twin(walk->mesh, h) == KIRI_NONE;
    KIRI_TIMES_WHILE(!canSplit, i, 9) {
        for (int32_t steps = 1; !canSplit && steps <= SLACK; steps = steps < 0 ? -2 * steps : -steps) {
            double s = along[i] * walk->on, t = steps == 1 || (isOutline && steps < 0) ? 0.0 : steps;
            p = kiriMesh_Round(kiriVec2_Make(at->x + s * x - t * y, at->y + s * y + t * x));
            bool isBetween = kiriLattice_Dot(a, b, p) > 0 && kiriLattice_Dot(b, a, p) > 0;
            canSplit = isBetween && kiriSquares_At(&walk->mesh->squares, p) != KIRI_NONE && CanSplitEdge(walk, h, p);
        }
    }
    *at = p;
    return canSplit;
}

/* Returns a vertex for a point of an edge: the nearer end, if it is near or the edge cannot be split; else a new one. */
static int32_t VertexOnEdge(BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    int32_t a = kiriMesh_Tail(walk->mesh, h), b = kiriMesh_Head(walk->mesh, h);
    bool isFirst = kiriDistanceSquared(VertexPoint(walk, a), at) <= kiriDistanceSquared(VertexPoint(walk, b), at);
    int32_t near = isFirst ? a : b;
    bool takesEnd = IsWithinDistance(VertexPoint(walk, near), at, walk->on) || !FindSplit(walk, h, &at);
    return takesEnd ? near : SplitEdge(walk, h, at);
}

/* Returns a vertex for a point in the triangle: a corner or a point of an edge if it is near, else a new one inside. */
static int32_t VertexIn(BladeWalk* walk, int32_t triangle, kiriLatticePoint at)
{
    const int32_t* v = walk->mesh->triangles.data[triangle].vertex;
    kiriLatticePoint c[3], foot = at;
    int nearest = 0;
    int32_t h = KIRI_NONE;
    KIRI_ASSERT_HAS(walk->mesh->triangles, triangle);
    kiriMesh_Corners(walk->mesh, triangle, c);
    KIRI_FROM_TO(i, 1, 3) {
        nearest = kiriDistanceSquared(c[i], at) < kiriDistanceSquared(c[nearest], at) ? i : nearest;
    }
    int32_t corner = v[nearest];
    if (IsWithinDistance(c[nearest], at, walk->on)) {
        return corner;
    }
    KIRI_EACH_CORNER(i) {
        kiriLatticePoint p = kiriLattice_Nearest(c[i], c[(i + 1) % 3], at);
        if (h == KIRI_NONE || kiriDistanceSquared(p, at) < kiriDistanceSquared(foot, at)) {
            h = 3 * triangle + i;
            foot = p;
        }
    }
    if (IsWithinDistance(foot, at, walk->on) && FindSplit(walk, h, &foot)) {
        return SplitEdge(walk, h, foot);
    }
    const kiriLatticePoint sides[3][2] = { { c[0], c[1] }, { c[1], c[2] }, { c[2], c[0] } };
    if (!AreEdgesFree(walk, at, sides, 3, false) || !kiriMesh_Holds(walk->mesh, triangle, at, 1)) {
        return corner;
    }
    walk->splits += 3;
    int32_t vertex = kiriMesh_SplitTriangle(walk->mesh, triangle, at);
    walk->failed = walk->failed || vertex == KIRI_NONE;
    return vertex;
}

/* Returns a vertex where the way to the goal crosses half-edge h: one of its ends if it is near, or a new one. If the walk
   is near, or the triangles beside h are too thin to split, flips h and returns the vertex opposite of it, where the walk
   is; if that cannot be done, returns an end that is nearer to the goal, or KIRI_NONE. */
static int32_t VertexOn(BladeWalk* walk, int32_t h)
{
    int32_t a = kiriMesh_Tail(walk->mesh, h), b = kiriMesh_Head(walk->mesh, h);
    kiriLatticePoint pa = VertexPoint(walk, a), pb = VertexPoint(walk, b), at = walk->tip->at, goal = walk->tip->goal;
    double toA = (double)kiriOrient(at, goal, pa), toB = (double)kiriOrient(at, goal, pb);
    double share = toA / (toA - toB);
    kiriLatticePoint crossing = kiriLattice_Between(pa, pb, share), p = share < 0.5 ? pa : pb;
    int32_t near = share < 0.5 ? a : b, far = share < 0.5 ? b : a,
            here = kiriMesh_Tail(walk->mesh, kiriEdge_Previous(h));
    bool canTake = IsNearerGoal(walk, p);
    bool isNear =
        IsWithinDistance(p, crossing, walk->slack) || (IsWithinDistance(p, crossing, walk->on) && IsOnLine(walk, p));
    if (canTake && isNear) {
        return near;
    }
    if (IsWithinDistance(at, crossing, walk->apart) && kiriMesh_FlipKeepsCells(walk->mesh, h) && FlipEdge(walk, h)) {
        return here;
    }
    /* An edge of the outline may pass through a vertex of another part, at `at`: then the next step goes on from there. */
    if (FindSplit(walk, h, &crossing) && (IsNearerGoal(walk, crossing) || kiriLattice_IsSame(at, crossing))) {
        return SplitEdge(walk, h, crossing);
    }
    if (FlipEdge(walk, h)) {
        return here;
    }
    return canTake ? near : IsNearerGoal(walk, VertexPoint(walk, far)) ? far : KIRI_NONE;
}

static void MoveTo(BladeWalk* walk, int32_t vertex)
{
    if (!walk->failed) {
        walk->tip->vertex = vertex;
        walk->tip->at = VertexPoint(walk, vertex);
    }
}

/* ---- Into the sheet ---------------------------------------------------------------------------------------------- */

/* Returns the share of the way where it comes in over half-edge h; 2 if it does not. Both ends count as part of the edge:
   a corner that the way only touches is taken, and left again at once. */
static double EntryOver(const BladeWalk* walk, int32_t h)
{
    kiriLatticePoint a = kiriMesh_TailAt(walk->mesh, h), b = kiriMesh_HeadAt(walk->mesh, h), at = walk->tip->at,
                     goal = walk->tip->goal;
    int64_t here = kiriOrient(a, b, at), there = kiriOrient(a, b, goal);
    if (kiriMesh_Twin(walk->mesh, h) != KIRI_NONE || here > 0 || there <= 0 || kiriLattice_IsSame(a, at) ||
        kiriLattice_IsSame(b, at) || kiriOrient(at, goal, a) < 0 || kiriOrient(at, goal, b) > 0) {
        return 2.0;
    }
    return (double)-here / ((double)there - (double)here);
}

/* Goes from outside, or from the outline outwards, to where the way to the goal first comes into the sheet; or all the way
   to the goal. */
static bool EnterSheet(BladeWalk* walk)
{
    const kiriMeshData* mesh = walk->mesh;
    int32_t edge = KIRI_NONE;
    double least = 2.0;
    kiriNearby nearby = kiriNearby_Begin(&mesh->squares, walk->tip->at, walk->tip->goal, 0.0);
    walk->effort += LOOK_EFFORT;
    KIRI_EACH_NEARBY(t, nearby) {
        walk->effort += LOOK_EFFORT;
        KIRI_FROM_TO(h, 3 * t, 3 * t + 3) {
            double share = EntryOver(walk, h);
            if (share < least || (share == least && share <= 1.0 && h < edge)) {
                edge = h;
                least = share;
            }
        }
    }
    int32_t vertex =
        edge == KIRI_NONE ? kiriMesh_VertexAt(mesh, walk->tip->goal, &walk->effort) : VertexOn(walk, edge);
    walk->tip->vertex = vertex;
    walk->tip->at = vertex == KIRI_NONE ? walk->tip->goal : VertexPoint(walk, vertex);
    return !walk->failed;
}

/* ---- Through the sheet ------------------------------------------------------------------------------------------- */

/* Returns true if the blade can go along the edge to this end of it. It must not go past the goal. */
static bool CanFollow(const BladeWalk* walk, int32_t vertex)
{
    kiriLatticePoint p = VertexPoint(walk, vertex), goal = walk->tip->goal;
    return kiriLattice_IsSame(p, goal) ||
           (IsNearerGoal(walk, p) && kiriLattice_Dot(goal, p, walk->tip->at) > 0 && IsOnLine(walk, p));
}

/* Returns the next vertex in the triangle left of h, whose wedge holds the way to the goal. KIRI_NONE: the blade stops. */
static int32_t NextVertex(BladeWalk* walk, int32_t h)
{
    KIRI_ASSERT(kiriLattice_IsSame(kiriMesh_TailAt(walk->mesh, h), walk->tip->at));
    int32_t opposite = kiriEdge_Next(h), a = kiriMesh_Tail(walk->mesh, opposite),
            b = kiriMesh_Head(walk->mesh, opposite);
    bool takesA = CanFollow(walk, a), takesB = CanFollow(walk, b);
    if (takesA || takesB) {
        return takesB && (!takesA || kiriLattice_IsSame(VertexPoint(walk, b), walk->tip->goal)) ? b : a;
    }
    if (kiriOrient(VertexPoint(walk, a), VertexPoint(walk, b), walk->tip->goal) < 0) {
        return VertexOn(walk, opposite);
    }
    /* The goal is a vertex of another part, which touches this one, or lies on it by a few lattice steps. */
    int32_t vertex = VertexIn(walk, h / 3, walk->tip->goal);
    return vertex != KIRI_NONE && IsNearerGoal(walk, VertexPoint(walk, vertex)) ? vertex : KIRI_NONE;
}

/* Takes one step of the walk to the goal. Returns false if the blade cannot get farther, and on out of memory. */
static bool StepBlade(BladeWalk* walk)
{
    int32_t h = walk->tip->vertex == KIRI_NONE ? KIRI_NONE : FindWedge(walk);
    if (h == KIRI_NONE) {
        return EnterSheet(walk);
    }
    int32_t here = kiriMesh_Tail(walk->mesh, h), next = NextVertex(walk, h);
    if (next == here) {
        return true; /* an edge was flipped */
    }
    if (next == KIRI_NONE || walk->failed || !OpenBetween(walk, here, VertexPoint(walk, next))) {
        return false;
    }
    MoveTo(walk, next);
    return true;
}

/* ---- A move ------------------------------------------------------------------------------------------------------ */

static kiriCorridor CorridorOf(const BladeWalk* walk, kiriLatticePoint from, kiriLatticePoint to)
{
    return kiriCorridor_Make(walk->mesh, from, to, walk->on + walk->slack, walk->reach, walk->tip->fold != 0);
}

/* Returns a triangle at a point, or KIRI_NONE. */
static int32_t LocatePoint(BladeWalk* walk, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&walk->mesh->squares, at);
    walk->effort +=
        square == KIRI_NONE ? 0 : LOOK_EFFORT * (int64_t)kiriSquares_CountNodes(&walk->mesh->squares, square);
    return kiriMesh_Locate(walk->mesh, at);
}

/* Returns a vertex for a point in the sheet, or KIRI_NONE. */
static int32_t VertexFor(BladeWalk* walk, kiriLatticePoint at)
{
    int32_t triangle = LocatePoint(walk, at), vertex = triangle == KIRI_NONE ? KIRI_NONE : VertexIn(walk, triangle, at);
    return walk->failed ? KIRI_NONE : vertex;
}

/* Returns a vertex for an end of the line from `from` to `at`, or KIRI_NONE outside of the sheet: on a near lip, where the
   line meets it or nearest to it; else in the triangle. If lips lead there along the line, the blade jumps and cuts
   nothing. */
static int32_t FindEnd(BladeWalk* walk, kiriLatticePoint from, kiriLatticePoint at)
{
    kiriBladeTip* tip = walk->tip;
    int32_t triangle = LocatePoint(walk, at);
    if (triangle == KIRI_NONE) {
        return KIRI_NONE;
    }
    kiriCorridor corridor = CorridorOf(walk, from, at);
    kiriLipsNear near = kiriLip_FindNear(&corridor, tip->vertex);
    walk->effort += corridor.effort;
    if (near.other.edge != KIRI_NONE) {
        return VertexOnEdge(walk, near.other.edge, near.other.at);
    }
    if (near.own.edge != KIRI_NONE && !kiriLattice_IsSame(near.own.at, tip->at)) {
        MoveTo(walk, VertexOnEdge(walk, near.own.edge, near.own.at));
        return tip->vertex;
    }
    bool isHere = tip->vertex != KIRI_NONE && IsWithinDistance(tip->at, at, walk->on);
    return isHere ? tip->vertex : VertexIn(walk, triangle, at);
}

/* Finds the end of the move. */
static void Aim(BladeWalk* walk, kiriLatticePoint to)
{
    kiriBladeTip* tip = walk->tip;
    tip->from = tip->lip = tip->at;
    int32_t vertex = FindEnd(walk, tip->at, to);
    tip->to = vertex == KIRI_NONE || walk->failed ? to : VertexPoint(walk, vertex);
    tip->phase = kiriLattice_IsSame(tip->at, tip->to) ? KIRI_BLADE_RESTS : KIRI_BLADE_LOOKS;
}

/* Finds the next goal: a lip on the line, the place beside a lip that is to be joined, the point where the blade comes
   back to the line, or the end. */
static void Look(BladeWalk* walk)
{
    kiriBladeTip* tip = walk->tip;
    kiriCorridor corridor = CorridorOf(walk, tip->from, tip->to);
    KIRI_ASSERT(!kiriLattice_IsSame(tip->from, tip->to));
    kiriLipStop stop;
    bool isFound = kiriLip_FindStop(&corridor, tip->vertex, tip->lip, &stop);
    int64_t progress = kiriCorridor_Progress(&corridor, tip->at);
    /* A blade that has left the line along a lip goes back at a small angle. */
    double side = fabs(kiriCorridor_Side(&corridor, tip->at)), square = corridor.length * corridor.length;
    double share = ((double)progress + KIRI_SHALLOW * side * corridor.length) / square;
    bool isOff = tip->vertex != KIRI_NONE && side > corridor.on && share < 1.0;
    kiriLatticePoint back = isOff ? kiriLattice_Between(tip->from, tip->to, share) : tip->to;
    tip->goal = tip->lip = tip->to;
    if (kiriCorridor_Progress(&corridor, back) < kiriCorridor_Progress(&corridor, isFound ? stop.at : tip->to)) {
        int32_t vertex = VertexFor(walk, back);
        if (vertex != KIRI_NONE && kiriCorridor_Progress(&corridor, VertexPoint(walk, vertex)) > progress) {
            tip->goal = tip->lip = VertexPoint(walk, vertex);
            isFound = false;
        }
    }
    if (isFound) {
        int32_t foot = kiriLattice_IsSame(stop.foot, stop.at) ? KIRI_NONE : VertexFor(walk, stop.foot);
        tip->lip = stop.at;
        tip->goal = foot == KIRI_NONE ? stop.at : VertexPoint(walk, foot);
    }
    walk->effort += corridor.effort;
    tip->phase = KIRI_BLADE_WALKS;
}

/* Goes on along a lip, if it comes back on the line before the goal, or leads on beside the line. Rounding would pull the
   outline along if the reach were a few steps. */
static bool FollowLip(BladeWalk* walk)
{
    kiriBladeTip* tip = walk->tip;
    kiriCorridor corridor = CorridorOf(walk, tip->from, tip->to);
    kiriLipPoint place;
    bool follows =
        tip->vertex != KIRI_NONE && walk->reach >= SLACK && kiriLip_Follow(&corridor, tip->vertex, tip->goal, &place);
    walk->effort += corridor.effort;
    int32_t vertex = follows ? VertexOnEdge(walk, place.edge, place.at) : KIRI_NONE;
    follows = follows && !walk->failed && IsNearerGoal(walk, VertexPoint(walk, vertex)) &&
              kiriCorridor_Progress(&corridor, VertexPoint(walk, vertex)) > kiriCorridor_Progress(&corridor, tip->at);
    if (follows) {
        MoveTo(walk, vertex);
        tip->phase = fabs(kiriCorridor_Side(&corridor, tip->at)) > corridor.on ? KIRI_BLADE_LOOKS : tip->phase;
    }
    return follows;
}

static void Walk(BladeWalk* walk)
{
    kiriBladeTip* tip = walk->tip;
    bool joins = !kiriLattice_IsSame(tip->goal, tip->lip);
    if (!FollowLip(walk) && !StepBlade(walk)) {
        tip->phase = KIRI_BLADE_RESTS;
    } else if (tip->phase == KIRI_BLADE_LOOKS) {
        tip->lip = tip->at; /* the blade has left the line along a lip */
    } else if (kiriLattice_IsSame(tip->at, tip->goal) || (joins && IsWithinDistance(tip->at, tip->goal, walk->slack))) {
        tip->phase = joins                                  ? KIRI_BLADE_JOINS
                     : kiriLattice_IsSame(tip->at, tip->to) ? KIRI_BLADE_RESTS
                                                            : KIRI_BLADE_LOOKS;
        tip->goal = joins ? tip->lip : tip->at;
        tip->lip = tip->at;
    }
}

/* Cuts to the lip, and jumps back along that cut. */
static void Join(BladeWalk* walk)
{
    kiriBladeTip* tip = walk->tip;
    if (!StepBlade(walk) || kiriLattice_IsSame(tip->at, tip->goal)) {
        tip->at = tip->lip;
        tip->lip = tip->goal;
        tip->vertex = kiriMesh_VertexAt(walk->mesh, tip->at, &walk->effort);
        tip->phase = kiriLattice_IsSame(tip->at, tip->to) ? KIRI_BLADE_RESTS : KIRI_BLADE_LOOKS;
    }
}

static void TakeStep(BladeWalk* walk, kiriLatticePoint to)
{
    bool joins = walk->tip->phase == KIRI_BLADE_JOINS;
    walk->lineFrom = joins ? walk->tip->lip : walk->tip->from;
    walk->lineTo = joins ? walk->tip->goal : walk->tip->to;
    int32_t start = KIRI_NONE;
    switch (walk->tip->phase) {
    case KIRI_BLADE_STARTS: /* makes a vertex where the blade is */
        start = FindEnd(walk, to, walk->tip->at);
        if (start != KIRI_NONE) {
            MoveTo(walk, start);
        }
        walk->tip->phase = KIRI_BLADE_AIMS;
        break;
    case KIRI_BLADE_AIMS:
        Aim(walk, to);
        break;
    case KIRI_BLADE_LOOKS:
        Look(walk);
        break;
    case KIRI_BLADE_WALKS:
        Walk(walk);
        break;
    default:
        Join(walk);
        break;
    }
}

kiriProgress kiriCut_Move(kiriMeshData* mesh, kiriBladeTip* blade, kiriLatticePoint to, double snap, kiriQuota* quota)
{
    kiriBladeTip tip = *blade;
    double on = ON * snap;
    BladeWalk walk = { mesh, &tip, on, REACH * snap, APART * snap, kiriMin(on, SLACK), tip.at, to, 0, 0, false };
    KIRI_ASSERT(mesh->isOpen && quota->left >= 0 && snap >= 0.0);
    KIRI_ASSERT(tip.vertex == KIRI_NONE || kiriLattice_IsSame(VertexPoint(&walk, tip.vertex), tip.at));
    mesh->squares.effort = 0;
    if (tip.phase == KIRI_BLADE_RESTS && !kiriLattice_IsSame(tip.at, to)) {
        tip.phase = tip.vertex == KIRI_NONE ? KIRI_BLADE_STARTS : KIRI_BLADE_AIMS;
    }
    while (!walk.failed && kiriQuota_Pay(quota, &tip.owed) && tip.phase != KIRI_BLADE_RESTS &&
           quota->left >= KIRI_MOST_SPLITS) {
        *blade = tip;
        /* A step makes two vertices at most, and opens an edge. */
        walk.failed = !kiriMesh_Reserve(mesh, 3);
        if (!walk.failed) {
            TakeStep(&walk, to);
            tip.owed = kiriMax(walk.splits, 1) + (walk.effort + mesh->squares.effort) / ITEM_EFFORT;
            walk.splits = 0;
            walk.effort = mesh->squares.effort = 0;
        }
    }
    if (walk.failed) {
        return KIRI_FAILED;
    }
    *blade = tip;
    return tip.phase == KIRI_BLADE_RESTS ? KIRI_DONE : KIRI_MORE;
}

kiriBladeTip kiriCut_Place(const kiriMeshData* mesh, kiriVec2 local)
{
    double x = local.x / mesh->step, y = local.y / mesh->step;
    return kiriCut_PlaceAt(kiriMesh_Round(kiriVec2_Make(kiriClamp(x, LowestCoordinate, HighestCoordinate),
                                                        kiriClamp(y, LowestCoordinate, HighestCoordinate))));
}

/* Cuts off the part above (or below) the limit on one axis. u and v: coordinates on this axis and on the other. Halves keep
   the largest numbers finite. */
static bool ClipAxis(double* fromU, double* fromV, double* toU, double* toV, double limit, bool above)
{
    bool fromOut = above ? *fromU > limit : *fromU < limit, toOut = above ? *toU > limit : *toU < limit;
    if (fromOut != toOut) {
        double share = (0.5 * limit - 0.5 * *fromU) / (0.5 * *toU - 0.5 * *fromU);
        double v = (1.0 - share) * *fromV + share * *toV;
        *(fromOut ? fromU : toU) = limit;
        *(fromOut ? fromV : toV) = v;
    }
    return !fromOut || !toOut;
}

bool kiriCut_Clip(const kiriMeshData* mesh, kiriVec2* from, kiriVec2* to)
{
    KIRI_ASSERT(mesh->step > 0.0);
    double low = LowestCoordinate * mesh->step, high = HighestCoordinate * mesh->step;
    return ClipAxis(&from->x, &from->y, &to->x, &to->y, low, false) &&
           ClipAxis(&from->x, &from->y, &to->x, &to->y, high, true) &&
           ClipAxis(&from->y, &from->x, &to->y, &to->x, low, false) &&
           ClipAxis(&from->y, &from->x, &to->y, &to->x, high, true);
}
