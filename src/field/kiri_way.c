#include "kiri_way.h"

/* ---- Corners where ways may turn --------------------------------------------------------------------------------- */

static bool IsOnePlace(kiriLatticePoint a, kiriLatticePoint b)
{
    return a.x == b.x && a.y == b.y;
}

/* By place, for the triangles of a square come in no order. */
static bool IsTurnBefore(const kiriTurn* a, const kiriTurn* b)
{
    const kiriLatticePoint p[3] = { a->at, a->before, a->after }, q[3] = { b->at, b->before, b->after };
    for (int k = 0; k < 3; ++k) {
        if (!IsOnePlace(p[k], q[k])) {
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

/* ---- The way ------------------------------------------------------------------------------------------------------- */

/* A search over the corners, from the start to the goal, which is the last node: A*, by the straight line to the goal
   (Hart, Nilsson and Raphael 1968). Whether one can go from a node to another is looked at only when that would be the
   next step. */
typedef struct WaySearch {
    const kiriSight* sight;
    const kiriTurns* turns;
    kiriVec2 at[KIRI_MOST_TURNS + 2];
    double rest[KIRI_MOST_TURNS + 2];      /* straight to the goal */
    double length[KIRI_MOST_TURNS + 2];    /* of the shortest way that may be */
    int32_t from[KIRI_MOST_TURNS + 2];     /* the node before */
    uint64_t blocked[KIRI_MOST_TURNS + 2]; /* bit k: there is no straight way from node k */
    bool isDone[KIRI_MOST_TURNS + 2];
    int32_t count;
} WaySearch;

typedef char NodesFitBits[KIRI_MOST_TURNS + 2 <= 64 ? 1 : -1];

static const double kiriNoWay = 1e300;

/* May a shortest way leave the corner in this direction, or come from it? Only where both edges are on one side: else it
   would lead into what is no material, or could be cut short. */
static bool IsTangent(const kiriSight* sight, const kiriTurn* turn, kiriVec2 direction)
{
    const kiriMeshData* mesh = sight->mesh;
    double least = 1e-6 * sight->grid->side * kiriVec2_Length(direction);
    kiriVec2 at = kiriMesh_Local(mesh, turn->at);
    kiriVec2 before = kiriVec2_Sub(kiriMesh_Local(mesh, turn->before), at);
    kiriVec2 after = kiriVec2_Sub(kiriMesh_Local(mesh, turn->after), at);
    double a = direction.x * before.y - direction.y * before.x, b = direction.x * after.y - direction.y * after.x;
    return !(a > least && b < -least) && !(a < -least && b > least);
}

static bool CanGo(const WaySearch* s, int32_t a, int32_t b)
{
    kiriVec2 way = kiriVec2_Sub(s->at[b], s->at[a]);
    return (a == 0 || IsTangent(s->sight, &s->turns->turn[a - 1], way)) &&
           (b == s->count - 1 || IsTangent(s->sight, &s->turns->turn[b - 1], kiriVec2_Scale(-1.0, way))) &&
           kiriSight_IsClear(s->sight, s->at[a], s->at[b]);
}

/* The open node on the way that may be the shortest, or KIRI_NONE. */
static int32_t NextNode(const WaySearch* s)
{
    int32_t best = KIRI_NONE;
    for (int32_t k = 0; k < s->count; ++k) {
        if (!s->isDone[k] && s->length[k] < kiriNoWay &&
            (best == KIRI_NONE || s->length[k] + s->rest[k] < s->length[best] + s->rest[best])) {
            best = k;
        }
    }
    return best;
}

static void TryWay(WaySearch* s, int32_t from, int32_t node)
{
    double length = s->length[from] + kiriVec2_Length(kiriVec2_Sub(s->at[node], s->at[from]));
    if (!s->isDone[node] && (s->blocked[node] >> from & 1) == 0 && length < s->length[node]) {
        s->length[node] = length;
        s->from[node] = from;
    }
}

/* Takes the next step to a node if one can go there; else the way over another node may be the shortest. */
static void Step(WaySearch* s, int32_t node)
{
    if (node == 0 || CanGo(s, s->from[node], node)) {
        s->isDone[node] = true;
        for (int32_t k = 0; k < s->count; ++k) {
            TryWay(s, node, k);
        }
        return;
    }
    s->blocked[node] |= (uint64_t)1 << s->from[node];
    s->length[node] = kiriNoWay;
    for (int32_t k = 0; k < s->count; ++k) {
        if (s->isDone[k]) {
            TryWay(s, k, node);
        }
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

bool kiriWay_Find(const kiriTurns* turns, const kiriSight* sight, kiriWay* way)
{
    WaySearch s;
    if (turns->isFull) {
        return false;
    }
    s.sight = sight;
    s.turns = turns;
    s.count = turns->count + 2;
    for (int32_t k = 0; k < s.count; ++k) {
        s.at[k] = k == 0             ? turns->from
                  : k == s.count - 1 ? turns->to
                                     : kiriMesh_Local(sight->mesh, turns->turn[k - 1].at);
        s.rest[k] = kiriVec2_Length(kiriVec2_Sub(turns->to, s.at[k]));
        s.length[k] = k == 0 ? 0.0 : kiriNoWay;
        s.from[k] = 0;
        s.blocked[k] = 0;
        s.isDone[k] = false;
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
