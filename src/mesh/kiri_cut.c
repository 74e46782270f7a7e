#include "kiri_cut.h"

/* The range of the lattice: the box of the sheet and half its longer side around it. */
static const double LowestCoordinate = -0.5 * KIRI_LATTICE, HighestCoordinate = 1.5 * KIRI_LATTICE;

/* About ns: to look at a triangle around a vertex, or in the list of a square; and what is worth an item of the
   quota. */
enum { LOOK_EFFORT = 8, ITEM_EFFORT = 512 };

/* One straight move of a blade. The mesh is walked as the plane triangulation that it is, whether edges are open or
   not; only the outline stops the walk. So older cuts are nothing special. */
typedef struct BladeWalk {
    kiriMeshData* mesh;
    kiriLatticePoint from, to;
    double snap;
    kiriLatticePoint at; /* where the blade is now, */
    int32_t vertex;      /* and a vertex there; KIRI_NONE outside the sheet */
    int32_t splits;      /* triangles made or reshaped */
    int64_t effort;      /* to look around, about ns */
    bool failed;         /* no memory */
} BladeWalk;

static bool IsSamePoint(kiriLatticePoint a, kiriLatticePoint b)
{
    return a.x == b.x && a.y == b.y;
}

static kiriLatticePoint VertexPoint(const BladeWalk* walk, int32_t vertex)
{
    KIRI_ASSERT(vertex >= 0 && vertex < walk->mesh->vertices.count);
    return walk->mesh->vertices.data[vertex].at;
}

static int64_t LatticeDot(kiriLatticePoint o, kiriLatticePoint a, kiriLatticePoint b)
{
    return ((int64_t)a.x - o.x) * ((int64_t)b.x - o.x) + ((int64_t)a.y - o.y) * ((int64_t)b.y - o.y);
}

/* Every step must bring the blade nearer to its target: so the walk ends, whatever rounding and snapping do. */
static bool IsNearerTarget(const BladeWalk* walk, kiriLatticePoint p)
{
    return kiriDistanceSquared(p, walk->to) < kiriDistanceSquared(walk->at, walk->to);
}

/* Where an edge of the outline passes through a vertex of another part, splitting it is no step, but the
   next step goes on from there. */
static bool IsNearerOrHere(const BladeWalk* walk, kiriLatticePoint p)
{
    return IsNearerTarget(walk, p) || IsSamePoint(walk->at, p);
}

static bool IsWithinDistance(kiriLatticePoint a, kiriLatticePoint b, double distance)
{
    return (double)kiriDistanceSquared(a, b) <= distance * distance;
}

/* Is a point so near to the line that the blade was told to follow? Measured from where the move began, not from where
   the last snap has led: small errors must not add up to a detour. */
static bool IsOnLine(const BladeWalk* walk, kiriLatticePoint p, double distance)
{
    double length = sqrt((double)kiriDistanceSquared(walk->from, walk->to));
    return fabs((double)kiriOrient(walk->from, walk->to, p)) <= distance * length;
}

static kiriLatticePoint LatticeBetween(kiriLatticePoint a, kiriLatticePoint b, double share)
{
    return kiriMesh_Round(kiriVec2_Make(a.x + share * ((double)b.x - a.x), a.y + share * ((double)b.y - a.y)));
}

static int32_t SplitEdge(BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    walk->splits += kiriMesh_Twin(walk->mesh, h) == KIRI_NONE ? 2 : 4;
    int32_t vertex = kiriMesh_SplitEdge(walk->mesh, h, at);
    walk->failed = walk->failed || vertex == KIRI_NONE;
    return vertex;
}

static int32_t SplitTriangle(BladeWalk* walk, int32_t triangle, kiriLatticePoint at)
{
    walk->splits += 3;
    int32_t vertex = kiriMesh_SplitTriangle(walk->mesh, triangle, at);
    walk->failed = walk->failed || vertex == KIRI_NONE;
    return vertex;
}

/* ---- Around a vertex --------------------------------------------------------------------------------------------- */

/* Half-edges that leave the point of a vertex, counter-clockwise, over open edges too: from the outline on, or all
   around. */
static int32_t FirstAround(const kiriMeshData* mesh, int32_t vertex)
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

/* KIRI_NONE after the last. */
static int32_t NextAround(const kiriMeshData* mesh, int32_t h, int32_t first)
{
    int32_t next = kiriMesh_Twin(mesh, kiriEdge_Previous(h));
    return next == first ? KIRI_NONE : next;
}

/* Does the way to the target start in the wedge left of h, from h (with it) to the previous half-edge (without it)? */
static bool WedgeHolds(const BladeWalk* walk, int32_t h)
{
    const kiriMeshData* mesh = walk->mesh;
    int64_t right = kiriOrient(walk->at, VertexPoint(walk, kiriMesh_Tail(mesh, kiriEdge_Next(h))), walk->to);
    int64_t left = kiriOrient(walk->at, VertexPoint(walk, kiriMesh_Tail(mesh, kiriEdge_Previous(h))), walk->to);
    return right >= 0 && left < 0;
}

/* The half-edge whose wedge holds the way to the target, or KIRI_NONE: the blade leaves the sheet. Where corners of the
   outline touch, twins do not lead from one to the other, but their triangles are in the same square. */
static int32_t FindWedge(BladeWalk* walk)
{
    const kiriMeshData* mesh = walk->mesh;
    int32_t first = FirstAround(mesh, walk->vertex), found = KIRI_NONE;
    for (int32_t h = first; h != KIRI_NONE; h = NextAround(mesh, h, first)) {
        walk->effort += LOOK_EFFORT;
        if (WedgeHolds(walk, h)) {
            return h;
        }
    }
    int32_t slot = mesh->squares.head[kiriSquares_At(&mesh->squares, walk->at)];
    for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
        int32_t h = 3 * mesh->squares.nodes.data[slot].triangle;
        walk->effort += LOOK_EFFORT;
        for (int32_t end = h + 3; h < end; ++h) {
            bool isHere = IsSamePoint(VertexPoint(walk, kiriMesh_Tail(mesh, h)), walk->at);
            if (isHere && (found == KIRI_NONE || h < found) && WedgeHolds(walk, h)) {
                found = h;
            }
        }
    }
    return found;
}

/* Opens the edge from a vertex to a neighbouring point. */
static bool OpenBetween(BladeWalk* walk, int32_t vertex, kiriLatticePoint other)
{
    const kiriMeshData* mesh = walk->mesh;
    int32_t first = FirstAround(mesh, vertex);
    for (int32_t h = first; h != KIRI_NONE; h = NextAround(mesh, h, first)) {
        int32_t previous = kiriEdge_Previous(h);
        walk->effort += 2 * LOOK_EFFORT; /* once more where the fan is torn */
        bool leaves = IsSamePoint(VertexPoint(walk, kiriMesh_Tail(mesh, kiriEdge_Next(h))), other);
        if (leaves || IsSamePoint(VertexPoint(walk, kiriMesh_Tail(mesh, previous)), other)) {
            walk->failed = !kiriMesh_Open(walk->mesh, leaves ? h : previous);
            return !walk->failed;
        }
    }
    return false;
}

/* ---- Splits that may be made ------------------------------------------------------------------------------------- */

/* Parts of the caller's sheet that are not joined may lie on each other by a few lattice steps (kiri_overlap.c). A
   split in one, at a vertex of the other, must not make an edge that the other has: each half-edge is alone between its
   ends. What they have in common is within 64 steps (along both axes) of an edge of one of them, so an edge there has a
   thin triangle on one side. Other splits inside the sheet need not look. */
enum { THIN_TRIANGLE = 256 };

static int64_t StepsBetween(kiriLatticePoint a, kiriLatticePoint b)
{
    int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y;
    return (x < 0 ? -x : x) + (y < 0 ? -y : y);
}

static bool IsThin(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint c)
{
    return kiriOrient(a, b, c) <= THIN_TRIANGLE * (StepsBetween(a, b) + StepsBetween(b, c) + StepsBetween(c, a)) / 2;
}

static bool IsVertexAt(BladeWalk* walk, kiriLatticePoint at)
{
    const kiriMeshData* mesh = walk->mesh;
    int32_t v = mesh->squares.vertexHead[kiriSquares_At(&mesh->squares, at)];
    while (v != KIRI_NONE && !IsSamePoint(VertexPoint(walk, v), at)) {
        walk->effort += LOOK_EFFORT;
        v = mesh->vertices.data[v].next;
    }
    return v != KIRI_NONE;
}

/* Has a triangle a corner at this point, with one of these edges: to the next corner, or from the previous one? */
static bool IsCornerTaken(BladeWalk* walk, kiriLatticePoint at, kiriLatticePoint next, kiriLatticePoint previous)
{
    const kiriMeshData* mesh = walk->mesh;
    int32_t slot = mesh->squares.head[kiriSquares_At(&mesh->squares, at)];
    for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, mesh->squares.nodes.data[slot].triangle, c);
        walk->effort += LOOK_EFFORT;
        for (int i = 0; i < 3; ++i) {
            if (IsSamePoint(c[i], at) && (IsSamePoint(c[(i + 1) % 3], next) || IsSamePoint(c[(i + 2) % 3], previous))) {
                return true;
            }
        }
    }
    return false;
}

/* The two triangles on one side of a split edge. */
static bool IsSideThin(const BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(walk->mesh, h / 3, c);
    return IsThin(c[h % 3], at, c[(h + 2) % 3]) || IsThin(at, c[(h + 1) % 3], c[(h + 2) % 3]);
}

static bool IsSideTaken(BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(walk->mesh, h / 3, c);
    kiriLatticePoint a = c[h % 3], b = c[(h + 1) % 3], apex = c[(h + 2) % 3];
    return IsCornerTaken(walk, at, apex, a) || IsCornerTaken(walk, at, b, apex);
}

static bool CanSplitEdge(BladeWalk* walk, int32_t h, kiriLatticePoint at)
{
    int32_t twin = kiriMesh_Twin(walk->mesh, h);
    if (!kiriMesh_CanSplitEdge(walk->mesh, h, at)) {
        return false;
    }
    bool mustLook = twin == KIRI_NONE || IsSideThin(walk, h, at) || IsSideThin(walk, twin, at);
    return !mustLook || !IsVertexAt(walk, at) ||
           (!IsSideTaken(walk, h, at) && (twin == KIRI_NONE || !IsSideTaken(walk, twin, at)));
}

static bool CanSplitTriangle(BladeWalk* walk, int32_t triangle, kiriLatticePoint at)
{
    kiriLatticePoint c[3];
    bool mustLook = false, isTaken = false;
    kiriMesh_Corners(walk->mesh, triangle, c);
    for (int i = 0; i < 3; ++i) {
        mustLook = mustLook || IsThin(c[i], c[(i + 1) % 3], at);
    }
    mustLook = mustLook && IsVertexAt(walk, at);
    for (int i = 0; i < 3 && mustLook; ++i) {
        isTaken = isTaken || IsCornerTaken(walk, at, c[i], c[(i + 1) % 3]);
    }
    return !isTaken && kiriMesh_CanSplitTriangle(walk->mesh, triangle, at);
}

/* ---- Vertices for the blade -------------------------------------------------------------------------------------- */

static int32_t NearestCorner(const BladeWalk* walk, int32_t triangle, kiriLatticePoint at)
{
    const int32_t* v = walk->mesh->triangles.data[triangle].vertex;
    int32_t nearest = v[0];
    for (int i = 1; i < 3; ++i) {
        if (kiriDistanceSquared(VertexPoint(walk, v[i]), at) < kiriDistanceSquared(VertexPoint(walk, nearest), at)) {
            nearest = v[i];
        }
    }
    return nearest;
}

/* The half-edge of the triangle that is nearest to a point in it, and the foot of the point on it. */
static int32_t NearestEdge(const BladeWalk* walk, int32_t triangle, kiriLatticePoint at, kiriLatticePoint* foot)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(walk->mesh, triangle, c);
    int32_t nearest = KIRI_NONE;
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint a = c[i], b = c[(i + 1) % 3];
        double share = (double)LatticeDot(a, b, at) / (double)kiriDistanceSquared(a, b);
        kiriLatticePoint p = LatticeBetween(a, b, share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share);
        if (nearest == KIRI_NONE || kiriDistanceSquared(p, at) < kiriDistanceSquared(*foot, at)) {
            nearest = 3 * triangle + i;
            *foot = p;
        }
    }
    return nearest;
}

/* A vertex for a point in the triangle: a corner or a point of an edge where they are near, or a new one inside. */
static int32_t VertexIn(BladeWalk* walk, int32_t triangle, kiriLatticePoint at)
{
    int32_t corner = NearestCorner(walk, triangle, at);
    if (IsWithinDistance(VertexPoint(walk, corner), at, walk->snap)) {
        return corner;
    }
    kiriLatticePoint foot;
    int32_t h = NearestEdge(walk, triangle, at, &foot);
    if (IsWithinDistance(foot, at, walk->snap) && CanSplitEdge(walk, h, foot)) {
        return SplitEdge(walk, h, foot);
    }
    return CanSplitTriangle(walk, triangle, at) ? SplitTriangle(walk, triangle, at) : corner;
}

/* A vertex where the way to the target crosses half-edge h: one of its ends where that is near, or a new one, or an end
   for want of a better. KIRI_NONE: there is none that brings the blade nearer. */
static int32_t VertexOn(BladeWalk* walk, int32_t h)
{
    int32_t a = kiriMesh_Tail(walk->mesh, h), b = kiriMesh_Tail(walk->mesh, kiriEdge_Next(h));
    kiriLatticePoint pa = VertexPoint(walk, a), pb = VertexPoint(walk, b);
    double toA = (double)kiriOrient(walk->at, walk->to, pa), toB = (double)kiriOrient(walk->at, walk->to, pb);
    double share = toA / (toA - toB);
    kiriLatticePoint crossing = LatticeBetween(pa, pb, share);
    int32_t near = share < 0.5 ? a : b, far = share < 0.5 ? b : a;
    bool canTake = IsNearerTarget(walk, VertexPoint(walk, near));
    if (canTake && IsWithinDistance(VertexPoint(walk, near), crossing, walk->snap) &&
        IsOnLine(walk, VertexPoint(walk, near), 2.0 * walk->snap)) {
        return near;
    }
    if (IsNearerOrHere(walk, crossing) && CanSplitEdge(walk, h, crossing)) {
        return SplitEdge(walk, h, crossing);
    }
    return canTake ? near : IsNearerTarget(walk, VertexPoint(walk, far)) ? far : KIRI_NONE;
}

/* ---- Into the sheet ---------------------------------------------------------------------------------------------- */

/* The first point, as a share of the way, where the way comes in over half-edge h; 2 where it does not. Both ends count
   as part of the edge: a corner that the way only touches is taken, and left again at once. */
static double EntryOver(const BladeWalk* walk, int32_t h)
{
    const kiriMeshData* mesh = walk->mesh;
    kiriLatticePoint a = VertexPoint(walk, kiriMesh_Tail(mesh, h)),
                     b = VertexPoint(walk, kiriMesh_Tail(mesh, kiriEdge_Next(h)));
    int64_t here = kiriOrient(a, b, walk->at), there = kiriOrient(a, b, walk->to);
    if (kiriMesh_Twin(mesh, h) != KIRI_NONE || here > 0 || there <= 0 || IsSamePoint(a, walk->at) ||
        IsSamePoint(b, walk->at) || kiriOrient(walk->at, walk->to, a) < 0 || kiriOrient(walk->at, walk->to, b) > 0) {
        return 2.0;
    }
    return (double)-here / ((double)there - (double)here);
}

typedef struct SheetEntry {
    int32_t edge;
    double share;
} SheetEntry;

static void FindEntryInSquare(BladeWalk* walk, int32_t square, SheetEntry* entry)
{
    const kiriMeshData* mesh = walk->mesh;
    walk->effort += LOOK_EFFORT;
    for (int32_t i = mesh->squares.head[square]; i != KIRI_NONE; i = mesh->squares.nodes.data[i].next) {
        int32_t h = 3 * mesh->squares.nodes.data[i].triangle;
        walk->effort += LOOK_EFFORT;
        for (int32_t end = h + 3; h < end; ++h) {
            double share = EntryOver(walk, h);
            if (share < entry->share || (share == entry->share && share <= 1.0 && h < entry->edge)) {
                entry->edge = h;
                entry->share = share;
            }
        }
    }
}

/* The first and last of `count` squares of a column or row, which begins at `start`, between two coordinates in any
   order, and two steps more. */
static void SquaresBetween(int32_t side, int32_t start, int32_t count, double a, double b, int32_t* first,
                           int32_t* last)
{
    double from = (double)start * side, low = (a < b ? a : b) - 1.0 - from, high = (a < b ? b : a) + 3.0 - from;
    *first = low <= 0.0 ? 0 : (int32_t)(low / side);
    *last = high < 0.0 ? -1 : (int32_t)(high / side);
    *last = *last < count ? *last : count - 1;
}

/* Where the way to the target comes into the sheet first. Only squares along the way are looked at, row by row. */
static int32_t FindSheetEntry(BladeWalk* walk)
{
    const kiriSquares* squares = &walk->mesh->squares;
    double dx = (double)walk->to.x - walk->at.x, dy = (double)walk->to.y - walk->at.y;
    int32_t firstRow, lastRow, first, last;
    SheetEntry entry = { KIRI_NONE, 2.0 };
    SquaresBetween(squares->side, squares->firstRow, squares->rows, walk->at.y, walk->to.y, &firstRow, &lastRow);
    for (int32_t row = firstRow; row <= lastRow; ++row) {
        double low = (((double)squares->firstRow + row) * squares->side - 3.0 - walk->at.y) / (dy != 0.0 ? dy : 1.0);
        double high = low + ((double)squares->side + 4.0) / (dy != 0.0 ? dy : 1.0);
        double enter = low < high ? low : high, leave = low < high ? high : low;
        enter = dy == 0.0 || enter < 0.0 ? 0.0 : enter;
        leave = dy == 0.0 || leave > 1.0 ? 1.0 : leave;
        SquaresBetween(squares->side, squares->firstColumn, squares->columns, walk->at.x + enter * dx,
                       walk->at.x + leave * dx, &first, &last);
        for (int32_t column = first; column <= last; ++column) {
            FindEntryInSquare(walk, row * squares->columns + column, &entry);
        }
    }
    return entry.edge;
}

/* From outside, or from the outline outwards: to the next point of the sheet, or all the way to the target. */
static bool EnterSheet(BladeWalk* walk)
{
    int32_t h = FindSheetEntry(walk);
    walk->vertex = h == KIRI_NONE ? KIRI_NONE : VertexOn(walk, h);
    walk->at = walk->vertex == KIRI_NONE ? walk->to : VertexPoint(walk, walk->vertex);
    return !walk->failed;
}

/* ---- Through the sheet ------------------------------------------------------------------------------------------- */

/* Can the blade go along the edge to this end of it? It must not go past the target. */
static bool CanFollow(const BladeWalk* walk, int32_t vertex)
{
    kiriLatticePoint p = VertexPoint(walk, vertex);
    return IsNearerTarget(walk, p) && LatticeDot(walk->to, p, walk->at) > 0 && IsOnLine(walk, p, walk->snap);
}

/* The next vertex in the triangle left of h, whose wedge holds the way to the target. KIRI_NONE: the blade stops. */
static int32_t NextVertex(BladeWalk* walk, int32_t h)
{
    int32_t opposite = kiriEdge_Next(h);
    int32_t a = kiriMesh_Tail(walk->mesh, opposite), b = kiriMesh_Tail(walk->mesh, kiriEdge_Next(opposite));
    if (CanFollow(walk, a) || CanFollow(walk, b)) {
        return CanFollow(walk, a) ? a : b;
    }
    if (kiriOrient(VertexPoint(walk, a), VertexPoint(walk, b), walk->to) < 0) {
        return VertexOn(walk, opposite);
    }
    int32_t vertex = VertexIn(walk, h / 3, walk->to);
    return vertex != KIRI_NONE && IsNearerTarget(walk, VertexPoint(walk, vertex)) ? vertex : KIRI_NONE;
}

/* The blade starts amid a triangle: it needs a vertex there. */
static void StartInTriangle(BladeWalk* walk, int32_t triangle)
{
    walk->vertex = VertexIn(walk, triangle, walk->at);
    walk->at = walk->failed ? walk->at : VertexPoint(walk, walk->vertex);
}

/* A triangle under the blade. */
static int32_t LocateBlade(BladeWalk* walk)
{
    const kiriSquares* squares = &walk->mesh->squares;
    int32_t square = kiriSquares_At(squares, walk->at);
    for (int32_t n = square == KIRI_NONE ? KIRI_NONE : squares->head[square]; n != KIRI_NONE;
         n = squares->nodes.data[n].next) {
        walk->effort += LOOK_EFFORT;
    }
    return kiriMesh_Locate(walk->mesh, walk->at);
}

/* One step of the walk. False: the blade is where it can get, or there is no memory. */
static bool StepBlade(BladeWalk* walk)
{
    int32_t triangle = walk->vertex == KIRI_NONE ? LocateBlade(walk) : KIRI_NONE;
    if (triangle != KIRI_NONE) {
        StartInTriangle(walk, triangle);
        return !walk->failed;
    }
    int32_t h = walk->vertex == KIRI_NONE ? KIRI_NONE : FindWedge(walk);
    if (h == KIRI_NONE) {
        return EnterSheet(walk);
    }
    int32_t here = kiriMesh_Tail(walk->mesh, h), next = NextVertex(walk, h);
    if (next == KIRI_NONE || !OpenBetween(walk, here, VertexPoint(walk, next))) {
        return false;
    }
    walk->vertex = next;
    walk->at = VertexPoint(walk, next);
    return true;
}

/* The items of a step that is done. */
static int64_t CountItems(BladeWalk* walk)
{
    kiriSquares* squares = &walk->mesh->squares;
    int64_t items = (walk->splits > 0 ? walk->splits : 1) + (walk->effort + squares->effort) / ITEM_EFFORT;
    walk->splits = 0;
    walk->effort = squares->effort = 0;
    return items;
}

kiriProgress kiriCut_Move(kiriMeshData* mesh, kiriBladeTip* blade, kiriLatticePoint to, double snap, kiriQuota* quota)
{
    BladeWalk walk = { mesh, blade->isOnItsWay ? blade->from : blade->at, to, snap, blade->at, blade->vertex, 0, 0,
                       false };
    bool isOnItsWay = !IsSamePoint(walk.from, to);
    KIRI_ASSERT(mesh->isOpen && quota->left >= 0 && snap >= 0.0);
    KIRI_ASSERT(blade->vertex == KIRI_NONE || IsSamePoint(VertexPoint(&walk, blade->vertex), blade->at));
    mesh->squares.effort = 0;
    int64_t owed = blade->owed;
    while (kiriQuota_Pay(quota, &owed) && isOnItsWay && quota->left >= KIRI_MOST_SPLITS) {
        isOnItsWay = StepBlade(&walk) && !IsSamePoint(walk.at, to);
        owed = CountItems(&walk);
    }
    if (walk.failed) {
        return KIRI_FAILED;
    }
    blade->owed = owed;
    blade->at = walk.at;
    blade->vertex = walk.vertex;
    blade->isOnItsWay = isOnItsWay;
    blade->from = walk.from;
    return isOnItsWay ? KIRI_MORE : KIRI_DONE;
}

static double ClampCoordinate(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

kiriBladeTip kiriCut_Place(const kiriMeshData* mesh, kiriVec2 local)
{
    kiriBladeTip blade;
    blade.at =
        kiriMesh_Round(kiriVec2_Make(ClampCoordinate(local.x / mesh->step, LowestCoordinate, HighestCoordinate),
                                     ClampCoordinate(local.y / mesh->step, LowestCoordinate, HighestCoordinate)));
    blade.vertex = KIRI_NONE;
    blade.isOnItsWay = false;
    blade.from = blade.at;
    blade.owed = 0;
    return blade;
}

/* Cuts off what is above the limit on one axis, or below it. (u, v) of an end: its coordinates on this axis and on the
   other. Halves and shares, so that the largest numbers stay finite. */
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
    double low = LowestCoordinate * mesh->step, high = HighestCoordinate * mesh->step;
    return ClipAxis(&from->x, &from->y, &to->x, &to->y, low, false) &&
           ClipAxis(&from->x, &from->y, &to->x, &to->y, high, true) &&
           ClipAxis(&from->y, &from->x, &to->y, &to->x, low, false) &&
           ClipAxis(&from->y, &from->x, &to->y, &to->x, high, true);
}
