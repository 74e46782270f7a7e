#include "kiri_path.h"

/* ---- Edges of the material --------------------------------------------------------------------------------------- */

static bool IsMaterialEdge(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_Twin(mesh, h) == KIRI_NONE || kiriMesh_IsOpen(mesh, h);
}

int32_t kiriSight_EdgeBeside(const kiriMeshData* mesh, int32_t h, bool ahead)
{
    int32_t beside = ahead ? kiriEdge_Next(h) : kiriEdge_Previous(h);
    while (!IsMaterialEdge(mesh, beside)) {
        int32_t twin = kiriMesh_Twin(mesh, beside);
        beside = ahead ? kiriEdge_Next(twin) : kiriEdge_Previous(twin);
    }
    return beside;
}

bool kiriSightEdges_Start(kiriSightEdges* edges, const kiriMeshData* mesh)
{
    int32_t squares = mesh->squares.columns * mesh->squares.rows;
    if (!kiriArray_ReserveJust(mesh->memory, &edges->listed, squares)) {
        return false;
    }
    kiriArray_Extend(&edges->listed, squares, KIRI_NONE);
    KIRI_EACH(const kiriSquareEdges, square, edges->squares) {
        edges->listed.data[square->square] = KIRI_NONE;
    }
    edges->squares.count = edges->edges.count = 0;
    edges->failed = false;
    return true;
}

static bool AddSightEdge(const kiriSight* sight, int32_t square, int32_t h, int32_t cell)
{
    const kiriMeshData* mesh = sight->grid->mesh;
    kiriLatticePoint tail = kiriMesh_TailAt(mesh, h), head = kiriMesh_HeadAt(mesh, h);
    kiriLatticePoint after = kiriMesh_HeadAt(mesh, kiriSight_EdgeBeside(mesh, h, true));
    /* At the end of a slit the way turns back: from the edge to its other side. */
    bool turns = kiriOrient(tail, head, after) < 0 || kiriLattice_IsSame(tail, after);
    kiriSightEdge edge = { kiriMesh_Local(mesh, tail),
                           kiriMesh_Local(mesh, head),
                           kiriMesh_Local(mesh, after),
                           h,
                           cell,
                           turns && kiriSquares_At(&mesh->squares, head) == square };
    return kiriArray_Push(mesh->memory, &sight->edges->edges, edge);
}

static bool CollectEdges(const kiriSight* sight, int32_t square)
{
    const kiriMeshData* mesh = sight->grid->mesh;
    kiriSightEdges* edges = sight->edges;
    kiriSquareEdges entry = { square, { edges->edges.count, 0 } };
    bool ok = true;
    KIRI_EACH_NODE(n, &mesh->squares, square) {
        int32_t first = 3 * mesh->squares.nodes.data[n].triangle;
        KIRI_FROM_TO_WHILE(ok, h, first, first + 3) {
            ok = !IsMaterialEdge(mesh, h) || AddSightEdge(sight, square, h, sight->grid->nodeCell.data[n]);
        }
    }
    entry.edges.count = edges->edges.count - entry.edges.first;
    if (!ok || !kiriArray_Push(mesh->memory, &edges->squares, entry)) {
        return false;
    }
    edges->listed.data[square] = edges->squares.count - 1;
    return true;
}

/* Returns the edges of the material in a square, in no order. Valid until the next call. */
static const kiriSightEdge* EdgesOfSquare(const kiriSight* sight, int32_t square, int32_t* count)
{
    kiriSightEdges* edges = sight->edges;
    KIRI_ASSERT_HAS(edges->listed, square);
    if (edges->listed.data[square] == KIRI_NONE && !edges->failed) {
        edges->failed = !CollectEdges(sight, square);
    }
    if (edges->failed) {
        *count = 0;
        return NULL;
    }
    KIRI_ASSERT(edges->listed.data[square] < edges->squares.count);
    kiriSpan span = edges->squares.data[edges->listed.data[square]].edges;
    KIRI_ASSERT(span.first >= 0 && span.first + span.count <= edges->edges.count);
    *count = span.count;
    return edges->edges.data + span.first;
}

/* ---- Straight ways ----------------------------------------------------------------------------------------------- */

/* A segment on its way through the squares. */
typedef struct SightRay {
    kiriVec2 from, way;
    double length;
    double least;         /* m: anything as near to the way, or to its ends, only touches */
    kiriSightHit nearest; /* share above 1: none */
    kiriVec2 head;        /* head of the nearest edge */
    kiriSightHit entry;   /* where it first comes into material, see nearest. Only the ray of a site that a cut has
                             parted from its material begins outside */
} SightRay;

/* Returns the side of the way on which a point is: 1 left, -1 right, 0 on it. */
static int SideOf(const SightRay* ray, kiriVec2 p)
{
    double off = kiriVec2_Cross(ray->way, kiriVec2_Sub(p, ray->from)), least = ray->least * ray->length;
    return off > least ? 1 : off < -least ? -1 : 0;
}

/* Stops the way at an edge of the material where it crosses the edge, coming from the material to its left, or passes
   its head from the edge's side to the side of the next edge: a way may touch the edges that it runs along. Among edges
   at the same place the one with the lower head counts. */
static void MeetEdge(SightRay* ray, const kiriSightEdge* e)
{
    kiriSightHit* nearest = &ray->nearest;
    int tail = SideOf(ray, e->tail), head = SideOf(ray, e->head);
    double share;
    if (tail * head < 0) {
        kiriVec2 edge = kiriVec2_Sub(e->head, e->tail);
        share = kiriVec2_Cross(kiriVec2_Sub(e->tail, ray->from), edge) / kiriVec2_Cross(ray->way, edge);
    } else if (head == 0 && tail < 0 && SideOf(ray, e->after) > 0) {
        share = kiriVec2_Dot(kiriVec2_Sub(e->head, ray->from), ray->way) / (ray->length * ray->length);
    } else {
        return;
    }
    bool isLower = e->head.x != ray->head.x ? e->head.x < ray->head.x : e->head.y < ray->head.y;
    bool isInside = share * ray->length > ray->least && (1.0 - share) * ray->length > ray->least;
    if (isInside && tail > 0) {
        ray->entry = share < ray->entry.share ? (kiriSightHit){ share, e->edge } : ray->entry;
    } else if (isInside && (share < nearest->share || (share == nearest->share && isLower))) {
        *nearest = (kiriSightHit){ share, e->edge };
        ray->head = e->head;
    }
}

static bool MayLookIn(const kiriSight* sight, int32_t cell)
{
    KIRI_ASSERT_HAS(sight->grid->cells, cell);
    KIRI_TIMES(k, sight->regionCount) {
        if (sight->owner[cell] == sight->regions[k]) {
            return true;
        }
    }
    return false;
}

static bool MayLookAt(const kiriSight* sight, int32_t square)
{
    KIRI_ASSERT_HAS(sight->grid->squareCell, square);
    int32_t c = sight->grid->squareCell.data[square];
    while (c != KIRI_NONE && !MayLookIn(sight, c)) {
        c = sight->grid->cells.data[c].next;
    }
    return c != KIRI_NONE;
}

/* One axis of the way: its column (or row), and the share of the way at which it comes to the next. */
typedef struct SightAxis {
    int32_t at, step;
    double next, each;
} SightAxis;

/* Starts the axis. `first`: the first column of the grid, or its first row. */
static SightAxis StartAxis(double from, double way, int32_t first, const kiriGrid* grid)
{
    double x = (from + grid->mesh->step) / grid->side;
    int32_t at = (int32_t)(x + 1.0) - 1; /* rounded down: never below -1 */
    SightAxis axis = { at - first, way > 0.0 ? 1 : -1, 2.0, 2.0 };
    if (way != 0.0) {
        axis.each = grid->side / fabs(way);
        axis.next = (way > 0.0 ? at + 1 - x : x - at) * axis.each;
    }
    return axis;
}

kiriSightEnd kiriSight_Cast(const kiriSight* sight, kiriVec2 p, kiriVec2 q, kiriSightHit* hit)
{
    const kiriSquares* squares = &sight->grid->mesh->squares;
    kiriVec2 way = kiriVec2_Sub(q, p);
    double least = 1e-6 * sight->grid->side;
    SightRay ray = { p, way, kiriVec2_Length(way), least, { 2.0, KIRI_NONE }, p, { 2.0, KIRI_NONE } };
    SightAxis u = StartAxis(p.x, way.x, squares->firstColumn, sight->grid),
              v = StartAxis(p.y, way.y, squares->firstRow, sight->grid);
    for (double entry = 0.0; entry < 1.0;) {
        int32_t square = v.at * squares->columns + u.at, count = 0;
        bool isInside = u.at >= 0 && u.at < squares->columns && v.at >= 0 && v.at < squares->rows;
        hit->share = entry;
        if (!isInside || !MayLookAt(sight, square)) {
            return (1.0 - entry) * ray.length <= least ? KIRI_SIGHT_CLEAR : KIRI_SIGHT_LOST;
        }
        const kiriSightEdge* edges = sight->grid->whole.data[square] ? NULL : EdgesOfSquare(sight, square, &count);
        KIRI_TIMES(k, count) {
            MeetEdge(&ray, &edges[k]);
        }
        SightAxis* axis = u.next < v.next ? &u : &v;
        entry = axis->next;
        const kiriSightHit* first = ray.nearest.share <= entry ? &ray.nearest : &ray.entry;
        if (first->share <= 1.0 && first->share <= entry) {
            *hit = *first;
            return KIRI_SIGHT_EDGE;
        }
        axis->at += axis->step;
        axis->next += axis->each;
    }
    hit->share = 1.0;
    return KIRI_SIGHT_CLEAR;
}

/* ---- Corners where ways may turn --------------------------------------------------------------------------------- */

void kiriTurns_Start(kiriTurns* turns, kiriVec2 from, kiriVec2 to, double most)
{
    turns->from = from;
    turns->to = to;
    turns->most = most;
    turns->count = turns->scannedCount = 0;
    turns->isFull = false;
}

/* Orders turns by place: the triangles of a square come in no order. */
static bool IsTurnBefore(const kiriTurn* a, const kiriTurn* b)
{
    const double p[6] = { a->at.x, a->at.y, a->before.x, a->before.y, a->after.x, a->after.y };
    const double q[6] = { b->at.x, b->at.y, b->before.x, b->before.y, b->after.x, b->after.y };
    int k = 0;
    while (k < 6 && p[k] == q[k]) {
        ++k;
    }
    return k < 6 && p[k] < q[k];
}

/* Adds a corner, in order, once. */
static void AddTurn(kiriTurns* turns, const kiriTurn* turn)
{
    int32_t at = turns->count;
    while (at > 0 && IsTurnBefore(turn, &turns->turn[at - 1])) {
        --at;
    }
    if (at > 0 && !IsTurnBefore(&turns->turn[at - 1], turn)) {
        return;
    }
    turns->isFull = turns->isFull || turns->count == KIRI_MOST_TURNS;
    if (!turns->isFull) {
        for (int32_t k = turns->count++; k > at; --k) {
            turns->turn[k] = turns->turn[k - 1];
        }
        turns->turn[at] = *turn;
    }
}

static void ScanSquare(kiriTurns* turns, const kiriSight* sight, int32_t square)
{
    int32_t count;
    KIRI_TIMES(k, turns->scannedCount) {
        if (turns->scanned[k] == square) {
            return;
        }
    }
    if (turns->scannedCount == KIRI_MOST_SCANNED) {
        turns->isFull = true;
        return;
    }
    turns->scanned[turns->scannedCount++] = square;
    const kiriSightEdge* edges = EdgesOfSquare(sight, square, &count);
    KIRI_TIMES(k, count) {
        const kiriSightEdge* e = &edges[k];
        if (e->isTurn &&
            kiriVec2_Distance(e->head, turns->from) + kiriVec2_Distance(e->head, turns->to) <= turns->most &&
            MayLookIn(sight, e->cell)) {
            kiriTurn turn = { e->head, e->tail, e->after };
            AddTurn(turns, &turn);
        }
    }
}

void kiriTurns_AddAround(kiriTurns* turns, const kiriSight* sight, int32_t cell)
{
    KIRI_ASSERT_HAS(sight->grid->cells, cell);
    const kiriSquares* squares = &sight->grid->mesh->squares;
    int32_t square = sight->grid->cells.data[cell].square;
    int32_t column = square % squares->columns, row = square / squares->columns;
    KIRI_TIMES(k, 9) {
        int32_t u = column + k % 3 - 1, v = row + k / 3 - 1, at = v * squares->columns + u;
        if (u >= 0 && u < squares->columns && v >= 0 && v < squares->rows && !sight->grid->whole.data[at] &&
            MayLookAt(sight, at)) {
            ScanSquare(turns, sight, at);
        }
    }
}

/* ---- Shortest ways ----------------------------------------------------------------------------------------------- */

typedef struct WayNode {
    kiriVec2 at;
    kiriVec2 before, after; /* the edges of a corner, seen from it */
    double rest;            /* straight to the goal */
    double length;          /* shortest way that may exist */
    double whole;           /* with the rest; kiriNoWay where there is none, and for nodes that are done */
    int32_t from;           /* the previous node */
    uint64_t blocked;       /* bit k: node k does not see this one */
    bool isDone;
} WayNode;

/* A search over the corners, from the start to the goal, which is the last node: A*, by the straight line to the goal
   (Hart, Nilsson and Raphael 1968). Whether a node sees another one is tested only when that would be the next step. */
typedef struct WaySearch {
    const kiriSight* sight;
    WayNode node[KIRI_MOST_TURNS + 2];
    int32_t count;
} WaySearch;

typedef char NodesFitBits[KIRI_MOST_TURNS + 2 <= 64 ? 1 : -1];

static const double kiriNoWay = 1e300;

/* Returns true if a shortest way may lead along this line through the node. At a corner it does only where both edges are
   on one side: else it would lead out of the material, or could be cut short. */
static bool IsTangent(const WaySearch* s, const WayNode* node, kiriVec2 direction, double least)
{
    if (node == s->node || node == &s->node[s->count - 1]) {
        return true;
    }
    double a = kiriVec2_Cross(direction, node->before), b = kiriVec2_Cross(direction, node->after);
    return !(a > least && b < -least) && !(a < -least && b > least);
}

/* Takes the way to a node over one that is done, if it is shorter. */
static inline void TryWay(WaySearch* s, int32_t from, WayNode* node)
{
    kiriVec2 way = kiriVec2_Sub(node->at, s->node[from].at);
    double size = kiriVec2_Length(way), length = s->node[from].length + size, least = 1e-6 * s->sight->grid->side * size;
    if ((node->blocked >> from & 1) == 0 && length < node->length && IsTangent(s, &s->node[from], way, least) &&
        IsTangent(s, node, way, least)) {
        node->length = length;
        node->whole = length + node->rest;
        node->from = from;
    }
}

/* Takes the next step to a node if one can go there; else the way over another node may be the shortest. */
static void Step(WaySearch* s, int32_t k)
{
    WayNode* node = &s->node[k];
    KIRI_ASSERT(!node->isDone && (k == 0 || s->node[node->from].isDone));
    bool canGo = k == 0 || kiriSight_IsClear(s->sight, s->node[node->from].at, node->at);
    node->isDone = canGo;
    node->whole = kiriNoWay;
    if (!canGo) {
        node->blocked |= (uint64_t)1 << node->from;
        node->length = kiriNoWay;
    }
    KIRI_EACH_INDEX(other, *s) {
        if (canGo && !s->node[other].isDone) {
            TryWay(s, k, &s->node[other]);
        } else if (!canGo && s->node[other].isDone) {
            TryWay(s, other, node);
        }
    }
}

bool kiriWay_Find(const kiriTurns* turns, const kiriSight* sight, kiriWay* way)
{
    WaySearch s;
    if (turns->isFull) {
        return false;
    }
    s.sight = sight;
    s.count = turns->count + 2;
    WayNode* goal = &s.node[s.count - 1];
    KIRI_ASSERT(s.count <= KIRI_MOST_TURNS + 2);
    KIRI_EACH_INDEX(k, s) {
        WayNode* node = &s.node[k];
        *node =
            (WayNode){ .at = k == 0 ? turns->from : turns->to, .length = k == 0 ? 0.0 : kiriNoWay, .whole = kiriNoWay };
        if (k > 0 && node != goal) {
            const kiriTurn* turn = &turns->turn[k - 1];
            node->at = turn->at;
            node->before = kiriVec2_Sub(turn->before, turn->at);
            node->after = kiriVec2_Sub(turn->after, turn->at);
        }
        node->rest = kiriVec2_Distance(turns->to, node->at);
    }
    for (int32_t next = 0; next != KIRI_NONE && !goal->isDone;) {
        double least = kiriNoWay;
        Step(&s, next);
        next = KIRI_NONE;
        KIRI_EACH_INDEX(k, s) {
            if (s.node[k].whole < least) {
                least = s.node[k].whole;
                next = k;
            }
        }
    }
    way->length = goal->length;
    way->turnCount = 0;
    for (int32_t k = goal->from; k != 0; k = s.node[k].from) {
        ++way->turnCount;
    }
    if (!goal->isDone || way->turnCount > KIRI_WAY_TURNS) {
        return false;
    }
    for (int32_t k = goal->from, at = way->turnCount; k != 0; k = s.node[k].from) {
        way->turn[--at] = s.node[k].at;
    }
    return true;
}

kiriVec2 kiriWay_At(const kiriWay* way, kiriVec2 from, kiriVec2 to, double length)
{
    kiriVec2 at = from;
    for (int32_t k = 0; k <= way->turnCount; ++k) {
        kiriVec2 next = k < way->turnCount ? way->turn[k] : to, step = kiriVec2_Sub(next, at);
        double size = kiriVec2_Length(step);
        if (length <= size || k == way->turnCount) {
            return size > 0.0 ? kiriVec2_AddScaled(at, length / size, step) : at;
        }
        length -= size;
        at = next;
    }
    return to;
}
