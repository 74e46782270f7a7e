#include "kiri_sight.h"

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
