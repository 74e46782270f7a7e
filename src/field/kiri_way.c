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

/* Adds the corner at the head of an edge of the material, if it lies in the square and is one. */
static void AddTurnAt(kiriTurns* turns, const kiriMeshData* mesh, int32_t square, int32_t h)
{
    kiriTurn turn = { kiriSight_HeadOf(mesh, h), mesh->vertices.data[kiriMesh_Tail(mesh, h)].at, { 0, 0 } };
    if (kiriSquares_At(&mesh->squares, turn.at) == square) {
        turn.after = kiriSight_HeadOf(mesh, kiriSight_EdgeAfter(mesh, h));
        if (kiriOrient(turn.before, turn.at, turn.after) < 0 || IsOnePlace(turn.before, turn.after)) {
            AddTurn(turns, &turn);
        }
    }
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
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        int32_t triangle = mesh->squares.nodes.data[n].triangle;
        bool isOwn = kiriSight_HasEdge(mesh, triangle) && kiriSight_MayLookIn(sight, sight->grid->nodeCell.data[n]);
        for (int32_t h = 3 * triangle; isOwn && h < 3 * triangle + 3; ++h) {
            if (kiriSight_IsEdge(mesh, h)) {
                AddTurnAt(turns, mesh, square, h);
            }
        }
    }
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

/* Dijkstra's search over the corners, from the start; the goal is the last node. */
typedef struct WaySearch {
    const kiriSight* sight;
    const kiriTurns* turns;
    kiriVec2 at[KIRI_MOST_TURNS + 2];
    double length[KIRI_MOST_TURNS + 2]; /* of the shortest way known */
    int32_t from[KIRI_MOST_TURNS + 2];
    bool isDone[KIRI_MOST_TURNS + 2];
    int32_t count;
} WaySearch;

static const double kiriNoWay = 1e300;

/* May a way leave the corner in this direction, or come from it? Not into what is no material. */
static bool IsFree(const kiriMeshData* mesh, const kiriTurn* turn, kiriVec2 direction)
{
    kiriVec2 at = kiriMesh_Local(mesh, turn->at);
    kiriVec2 before = kiriVec2_Sub(kiriMesh_Local(mesh, turn->before), at);
    kiriVec2 after = kiriVec2_Sub(kiriMesh_Local(mesh, turn->after), at);
    return !(before.x * direction.y - before.y * direction.x > 0.0 &&
             direction.x * after.y - direction.y * after.x > 0.0);
}

static bool CanGo(const WaySearch* s, int32_t a, int32_t b)
{
    kiriVec2 way = kiriVec2_Sub(s->at[b], s->at[a]);
    return (a == 0 || IsFree(s->sight->mesh, &s->turns->turn[a - 1], way)) &&
           (b == s->count - 1 || IsFree(s->sight->mesh, &s->turns->turn[b - 1], kiriVec2_Scale(-1.0, way))) &&
           kiriSight_IsClear(s->sight, s->at[a], s->at[b]);
}

/* The open node with the shortest way, or KIRI_NONE. */
static int32_t NextNode(const WaySearch* s)
{
    int32_t best = KIRI_NONE;
    for (int32_t k = 0; k < s->count; ++k) {
        if (!s->isDone[k] && s->length[k] < (best == KIRI_NONE ? kiriNoWay : s->length[best])) {
            best = k;
        }
    }
    return best;
}

static void GoOnFrom(WaySearch* s, int32_t node)
{
    s->isDone[node] = true;
    for (int32_t k = s->count - 1; k > 0; --k) { /* the goal first: it may rule out others */
        double length = s->length[node] + kiriVec2_Length(kiriVec2_Sub(s->at[k], s->at[node]));
        double rest = kiriVec2_Length(kiriVec2_Sub(s->at[s->count - 1], s->at[k]));
        if (!s->isDone[k] && length < s->length[k] && length + rest <= s->length[s->count - 1] && CanGo(s, node, k)) {
            s->length[k] = length;
            s->from[k] = node;
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

bool kiriWay_Find(kiriTurns* turns, const kiriSight* sight, kiriVec2 from, kiriVec2 to, kiriWay* way)
{
    WaySearch s;
    if (turns->isFull) {
        return false;
    }
    s.sight = sight;
    s.turns = turns;
    s.count = turns->count + 2;
    for (int32_t k = 0; k < s.count; ++k) {
        s.at[k] = k == 0 ? from : k == s.count - 1 ? to : kiriMesh_Local(sight->mesh, turns->turn[k - 1].at);
        s.length[k] = k == 0 ? 0.0 : kiriNoWay;
        s.from[k] = 0;
        s.isDone[k] = false;
    }
    for (int32_t node = 0; node != KIRI_NONE && node != s.count - 1; node = NextNode(&s)) {
        GoOnFrom(&s, node);
    }
    return s.length[s.count - 1] < kiriNoWay && TakeWay(&s, way);
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
