#include "kiri_path.h"

/* ---- Edges of the material --------------------------------------------------------------------------------------- */

kiriLatticePoint kiriSight_HeadOf(const kiriMeshData* mesh, int32_t h)
{
    return mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at;
}

static bool IsMaterialEdge(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_Twin(mesh, h) == KIRI_NONE || kiriMesh_IsOpen(mesh, h);
}

int32_t kiriSight_EdgeAfter(const kiriMeshData* mesh, int32_t h)
{
    int32_t next = kiriEdge_Next(h);
    while (!IsMaterialEdge(mesh, next)) {
        next = kiriEdge_Next(kiriMesh_Twin(mesh, next));
    }
    return next;
}

int32_t kiriSight_EdgeBefore(const kiriMeshData* mesh, int32_t h)
{
    int32_t before = kiriEdge_Previous(h);
    while (!IsMaterialEdge(mesh, before)) {
        before = kiriEdge_Previous(kiriMesh_Twin(mesh, before));
    }
    return before;
}

bool kiriSightEdges_Start(kiriSightEdges* edges, const kiriMeshData* mesh)
{
    int32_t squares = mesh->squares.columns * mesh->squares.rows, old = edges->listed.count;
    if (!kiriArray_ResizeJust(edges->memory, &edges->listed, squares)) {
        return false;
    }
    for (int32_t s = old; s < squares; ++s) {
        edges->listed.data[s] = KIRI_NONE;
    }
    for (int32_t k = 0; k < edges->squares.count; ++k) {
        edges->listed.data[edges->squares.data[k]] = KIRI_NONE;
    }
    edges->squares.count = edges->spans.count = edges->edges.count = 0;
    edges->failed = false;
    return true;
}

/* At the end of a slit the way turns back: from the edge to its other side. */
static bool IsTurn(kiriLatticePoint tail, kiriLatticePoint head, kiriLatticePoint after)
{
    return kiriOrient(tail, head, after) < 0 || (tail.x == after.x && tail.y == after.y);
}

static bool AddSightEdge(const kiriSight* sight, int32_t square, int32_t h, int32_t cell)
{
    const kiriMeshData* mesh = sight->mesh;
    kiriLatticePoint tail = mesh->vertices.data[kiriMesh_Tail(mesh, h)].at, head = kiriSight_HeadOf(mesh, h);
    kiriLatticePoint after = kiriSight_HeadOf(mesh, kiriSight_EdgeAfter(mesh, h));
    kiriSightEdge edge;
    edge.tail = kiriMesh_Local(mesh, tail);
    edge.head = kiriMesh_Local(mesh, head);
    edge.after = kiriMesh_Local(mesh, after);
    edge.edge = h;
    edge.cell = cell;
    edge.isTurn = kiriSquares_At(&mesh->squares, head) == square && IsTurn(tail, head, after);
    return kiriArray_Push(sight->edges->memory, &sight->edges->edges, edge);
}

static bool CollectEdges(const kiriSight* sight, int32_t square)
{
    const kiriMeshData* mesh = sight->mesh;
    kiriSightEdges* edges = sight->edges;
    kiriSpan span = { edges->edges.count, 0 };
    bool ok = kiriArray_Reserve(edges->memory, &edges->spans, (int64_t)edges->spans.count + 1) &&
              kiriArray_Push(edges->memory, &edges->squares, square);
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        int32_t triangle = mesh->squares.nodes.data[n].triangle;
        for (int32_t h = 3 * triangle; ok && h < 3 * triangle + 3; ++h) {
            ok = !IsMaterialEdge(mesh, h) || AddSightEdge(sight, square, h, sight->grid->nodeCell.data[n]);
        }
    }
    if (ok) {
        span.count = edges->edges.count - span.first;
        edges->listed.data[square] = edges->spans.count;
        edges->spans.data[edges->spans.count++] = span;
    }
    return ok;
}

const kiriSightEdge* kiriSight_EdgesOf(const kiriSight* sight, int32_t square, int32_t* count)
{
    kiriSightEdges* edges = sight->edges;
    KIRI_ASSERT(square >= 0 && square < edges->listed.count);
    if (edges->listed.data[square] == KIRI_NONE && !edges->failed) {
        edges->failed = !CollectEdges(sight, square);
    }
    if (edges->failed) {
        *count = 0;
        return NULL;
    }
    kiriSpan span = edges->spans.data[edges->listed.data[square]];
    *count = span.count;
    return edges->edges.data + span.first;
}

/* ---- What is met ------------------------------------------------------------------------------------------------- */

/* A segment on its way through the squares. */
typedef struct SightRay {
    kiriVec2 from, way;
    double length;
    double least;         /* m: what is as near to the way, or to its ends, only touches */
    kiriSightHit nearest; /* share above 1: none */
    kiriVec2 head;        /* of its edge */
} SightRay;

static double Cross(kiriVec2 a, kiriVec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* On which side of the way a point is: left 1, right -1, or on it 0. */
static int SideOf(const SightRay* ray, kiriVec2 p)
{
    double off = Cross(ray->way, kiriVec2_Sub(p, ray->from)), least = ray->least * ray->length;
    return off > least ? 1 : off < -least ? -1 : 0;
}

/* Of two edges that are met at the same place the one with the lower head counts. */
static void Meet(SightRay* ray, double share, const kiriSightEdge* e)
{
    kiriSightHit* nearest = &ray->nearest;
    bool isLower =
        share == nearest->share && (e->head.x != ray->head.x ? e->head.x < ray->head.x : e->head.y < ray->head.y);
    if (share * ray->length > ray->least && (1.0 - share) * ray->length > ray->least &&
        (share < nearest->share || isLower)) {
        nearest->share = share;
        nearest->edge = e->edge;
        ray->head = e->head;
    }
}

/* An edge of the material stops the way where the way crosses it, coming from the material to its left, or passes its
   head from the edge's side to that of the edge after it: a way may touch what it runs along. */
static void MeetEdge(SightRay* ray, const kiriSightEdge* e)
{
    int tail = SideOf(ray, e->tail), head = SideOf(ray, e->head);
    if (tail < 0 && head > 0) {
        kiriVec2 edge = kiriVec2_Sub(e->head, e->tail);
        Meet(ray, Cross(kiriVec2_Sub(e->tail, ray->from), edge) / Cross(ray->way, edge), e);
    } else if (head == 0 && tail < 0 && SideOf(ray, e->after) > 0) {
        Meet(ray, kiriVec2_Dot(kiriVec2_Sub(e->head, ray->from), ray->way) / (ray->length * ray->length), e);
    }
}

static void MeetEdgesOf(SightRay* ray, const kiriSight* sight, int32_t square)
{
    int32_t count;
    const kiriSightEdge* edges = kiriSight_EdgesOf(sight, square, &count);
    for (int32_t k = 0; k < count; ++k) {
        MeetEdge(ray, &edges[k]);
    }
}

/* ---- The way through the squares --------------------------------------------------------------------------------- */

bool kiriSight_MayLookIn(const kiriSight* sight, int32_t cell)
{
    for (int32_t k = 0; k < sight->regionCount; ++k) {
        if (sight->owner[cell] == sight->regions[k]) {
            return true;
        }
    }
    return false;
}

bool kiriSight_MayLookAt(const kiriSight* sight, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < sight->grid->squareCell.count);
    for (int32_t c = sight->grid->squareCell.data[square]; c != KIRI_NONE; c = sight->grid->cells.data[c].next) {
        if (kiriSight_MayLookIn(sight, c)) {
            return true;
        }
    }
    return false;
}

/* Along one axis: the column (or row) that the way is in, and the share of the way at which it comes to the next. */
typedef struct SightAxis {
    int32_t at, step;
    double next, each;
} SightAxis;

/* `first`: the first column of the grid, or its first row. */
static SightAxis StartAxis(double from, double way, int32_t first, const kiriGrid* grid, const kiriMeshData* mesh)
{
    double x = (from + mesh->step) / grid->side;
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
    const kiriSquares* squares = &sight->mesh->squares;
    kiriVec2 way = kiriVec2_Sub(q, p);
    double least = 1e-6 * sight->grid->side;
    SightRay ray = { p, way, kiriVec2_Length(way), least, { 2.0, KIRI_NONE }, p };
    SightAxis u = StartAxis(p.x, way.x, squares->firstColumn, sight->grid, sight->mesh),
              v = StartAxis(p.y, way.y, squares->firstRow, sight->grid, sight->mesh);
    for (double entry = 0.0; entry < 1.0;) {
        int32_t square = v.at * squares->columns + u.at;
        bool isInside = u.at >= 0 && u.at < squares->columns && v.at >= 0 && v.at < squares->rows;
        hit->share = entry;
        if (!isInside || !kiriSight_MayLookAt(sight, square)) {
            return (1.0 - entry) * ray.length <= least ? KIRI_SIGHT_CLEAR : KIRI_SIGHT_LOST;
        }
        if (!sight->grid->whole.data[square]) {
            MeetEdgesOf(&ray, sight, square);
        }
        SightAxis* axis = u.next < v.next ? &u : &v;
        entry = axis->next;
        if (ray.nearest.share <= 1.0 && ray.nearest.share <= entry) {
            *hit = ray.nearest;
            return KIRI_SIGHT_EDGE;
        }
        axis->at += axis->step;
        axis->next += axis->each;
    }
    hit->share = 1.0;
    return KIRI_SIGHT_CLEAR;
}

/* ---- Corners where ways may turn --------------------------------------------------------------------------------- */

/* By place, for the triangles of a square come in no order. */
static bool IsTurnBefore(const kiriTurn* a, const kiriTurn* b)
{
    const kiriLatticePoint p[3] = { a->at, a->before, a->after }, q[3] = { b->at, b->before, b->after };
    for (int k = 0; k < 3; ++k) {
        if (p[k].x != q[k].x || p[k].y != q[k].y) {
            return p[k].x != q[k].x ? p[k].x < q[k].x : p[k].y < q[k].y;
        }
    }
    return false;
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

static bool IsOnTheWay(const kiriTurns* turns, kiriVec2 at)
{
    return kiriVec2_Length(kiriVec2_Sub(at, turns->from)) + kiriVec2_Length(kiriVec2_Sub(at, turns->to)) <= turns->most;
}

static void ScanSquare(kiriTurns* turns, const kiriSight* sight, int32_t square)
{
    const kiriMeshData* mesh = sight->mesh;
    for (int32_t k = 0; k < turns->scannedCount; ++k) {
        if (turns->scanned[k] == square) {
            return;
        }
    }
    if (turns->scannedCount == KIRI_MOST_SCANNED) {
        turns->isFull = true;
        return;
    }
    turns->scanned[turns->scannedCount++] = square;
    int32_t count;
    const kiriSightEdge* edges = kiriSight_EdgesOf(sight, square, &count);
    for (int32_t k = 0; k < count; ++k) {
        if (edges[k].isTurn && IsOnTheWay(turns, edges[k].head) && kiriSight_MayLookIn(sight, edges[k].cell)) {
            int32_t h = edges[k].edge;
            kiriTurn turn = { kiriSight_HeadOf(mesh, h), mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                              kiriSight_HeadOf(mesh, kiriSight_EdgeAfter(mesh, h)) };
            AddTurn(turns, &turn);
        }
    }
}

void kiriTurns_Start(kiriTurns* turns, kiriVec2 from, kiriVec2 to, double most)
{
    turns->from = from;
    turns->to = to;
    turns->most = most;
    turns->count = turns->scannedCount = 0;
    turns->isFull = false;
}

void kiriTurns_AddAround(kiriTurns* turns, const kiriSight* sight, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < sight->grid->cells.count);
    const kiriSquares* squares = &sight->mesh->squares;
    int32_t square = sight->grid->cells.data[cell].square;
    int32_t column = square % squares->columns, row = square / squares->columns;
    for (int32_t v = row > 0 ? row - 1 : 0; v <= row + 1 && v < squares->rows; ++v) {
        for (int32_t u = column > 0 ? column - 1 : 0; u <= column + 1 && u < squares->columns; ++u) {
            int32_t at = v * squares->columns + u;
            if (!sight->grid->whole.data[at] && kiriSight_MayLookAt(sight, at)) {
                ScanSquare(turns, sight, at);
            }
        }
    }
}

/* ---- The way ----------------------------------------------------------------------------------------------------- */

/* A search over the corners, from the start to the goal, which is the last node: A*, by the straight line to the goal
   (Hart, Nilsson and Raphael 1968). Whether one can go from a node to another is looked at only when that would be the
   next step. */
typedef struct WaySearch {
    const kiriSight* sight;
    kiriVec2 at[KIRI_MOST_TURNS + 2];
    kiriVec2 before[KIRI_MOST_TURNS + 2], after[KIRI_MOST_TURNS + 2]; /* of corners, from where they are */
    double rest[KIRI_MOST_TURNS + 2];                                 /* straight to the goal */
    double length[KIRI_MOST_TURNS + 2];                               /* of the shortest way that may be */
    double whole[KIRI_MOST_TURNS + 2]; /* with the rest; kiriNoWay where there is none, and of nodes that are done */
    int32_t from[KIRI_MOST_TURNS + 2]; /* the node before */
    uint64_t blocked[KIRI_MOST_TURNS + 2]; /* bit k: there is no straight way from node k */
    bool isDone[KIRI_MOST_TURNS + 2];
    int32_t done[KIRI_MOST_TURNS + 2]; /* the nodes that are, rising: of ways of one length the lowest counts */
    int32_t doneCount, count;
} WaySearch;

typedef char NodesFitBits[KIRI_MOST_TURNS + 2 <= 64 ? 1 : -1];

static const double kiriNoWay = 1e300;

/* May a shortest way leave the node in this direction, or come from it? At a corner only where both edges are on one
   side: else it would lead into what is no material, or could be cut short. */
static bool IsTangent(const WaySearch* s, int32_t node, kiriVec2 direction)
{
    if (node == 0 || node == s->count - 1) {
        return true;
    }
    kiriVec2 before = s->before[node], after = s->after[node];
    double least = 1e-6 * s->sight->grid->side * kiriVec2_Length(direction);
    double a = direction.x * before.y - direction.y * before.x, b = direction.x * after.y - direction.y * after.x;
    return !(a > least && b < -least) && !(a < -least && b > least);
}

static bool CanGo(const WaySearch* s, int32_t a, int32_t b)
{
    kiriVec2 way = kiriVec2_Sub(s->at[b], s->at[a]);
    return IsTangent(s, a, way) && IsTangent(s, b, kiriVec2_Scale(-1.0, way)) &&
           kiriSight_IsClear(s->sight, s->at[a], s->at[b]);
}

/* The open node on the way that may be the shortest, or KIRI_NONE. */
static int32_t NextNode(const WaySearch* s)
{
    int32_t best = KIRI_NONE;
    double least = kiriNoWay;
    for (int32_t k = 0; k < s->count; ++k) {
        if (s->whole[k] < least) {
            least = s->whole[k];
            best = k;
        }
    }
    return best;
}

static inline void TryWay(WaySearch* s, int32_t from, int32_t node)
{
    if (!s->isDone[node] && (s->blocked[node] >> from & 1) == 0) {
        double length = s->length[from] + kiriVec2_Length(kiriVec2_Sub(s->at[node], s->at[from]));
        if (length < s->length[node]) {
            s->length[node] = length;
            s->whole[node] = length + s->rest[node];
            s->from[node] = from;
        }
    }
}

static void SetDone(WaySearch* s, int32_t node)
{
    int32_t at = s->doneCount++;
    for (; at > 0 && s->done[at - 1] > node; --at) {
        s->done[at] = s->done[at - 1];
    }
    s->done[at] = node;
    s->isDone[node] = true;
    s->whole[node] = kiriNoWay;
}

/* Takes the next step to a node if one can go there; else the way over another node may be the shortest. Most steps
   fail, and nearly all for the corners alone. */
static void Step(WaySearch* s, int32_t node)
{
    if (node == 0 || CanGo(s, s->from[node], node)) {
        SetDone(s, node);
        for (int32_t k = 0; k < s->count; ++k) {
            TryWay(s, node, k);
        }
        return;
    }
    s->blocked[node] |= (uint64_t)1 << s->from[node];
    s->length[node] = s->whole[node] = kiriNoWay;
    for (int32_t k = 0; k < s->doneCount; ++k) { /* in this order */
        TryWay(s, s->done[k], node);
    }
}

static bool TakeWay(const WaySearch* s, kiriWay* way)
{
    way->length = s->length[s->count - 1];
    way->turnCount = 0;
    for (int32_t k = s->from[s->count - 1]; k != 0; k = s->from[k]) {
        ++way->turnCount;
    }
    int32_t at = way->turnCount;
    for (int32_t k = s->from[s->count - 1]; k != 0 && way->turnCount <= KIRI_WAY_TURNS; k = s->from[k]) {
        way->turn[--at] = s->at[k];
    }
    return way->turnCount <= KIRI_WAY_TURNS;
}

static void SetWayNode(WaySearch* s, const kiriTurns* turns, int32_t k)
{
    const kiriMeshData* mesh = s->sight->mesh;
    if (k == 0 || k == s->count - 1) {
        s->at[k] = k == 0 ? turns->from : turns->to;
    } else {
        const kiriTurn* turn = &turns->turn[k - 1];
        s->at[k] = kiriMesh_Local(mesh, turn->at);
        s->before[k] = kiriVec2_Sub(kiriMesh_Local(mesh, turn->before), s->at[k]);
        s->after[k] = kiriVec2_Sub(kiriMesh_Local(mesh, turn->after), s->at[k]);
    }
    s->rest[k] = kiriVec2_Length(kiriVec2_Sub(turns->to, s->at[k]));
    s->length[k] = k == 0 ? 0.0 : kiriNoWay;
    s->whole[k] = kiriNoWay; /* the start is taken first, before the others */
    s->from[k] = 0;
    s->blocked[k] = 0;
    s->isDone[k] = false;
}

bool kiriWay_Find(const kiriTurns* turns, const kiriSight* sight, kiriWay* way)
{
    WaySearch s;
    if (turns->isFull) {
        return false;
    }
    s.sight = sight;
    s.doneCount = 0;
    s.count = turns->count + 2;
    for (int32_t k = 0; k < s.count; ++k) {
        SetWayNode(&s, turns, k);
    }
    int32_t node = 0;
    while (node != KIRI_NONE && !s.isDone[s.count - 1]) {
        Step(&s, node);
        node = NextNode(&s);
    }
    return s.isDone[s.count - 1] && TakeWay(&s, way);
}

kiriVec2 kiriWay_At(const kiriWay* way, kiriVec2 from, kiriVec2 to, double length)
{
    kiriVec2 at = from;
    for (int32_t k = 0; k <= way->turnCount; ++k) {
        kiriVec2 next = k < way->turnCount ? way->turn[k] : to, step = kiriVec2_Sub(next, at);
        double size = kiriVec2_Length(step);
        if (length <= size || k == way->turnCount) {
            return size > 0.0 ? kiriVec2_Add(at, kiriVec2_Scale(length / size, step)) : at;
        }
        length -= size;
        at = next;
    }
    return to;
}
