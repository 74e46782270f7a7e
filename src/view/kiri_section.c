#include "kiri_section.h"

#include "../core/kiri_array.h"

/* In the view along the edge the edge is a point, the origin, and each corner of a triangle moves along a straight way while
   the edge moves. So a triangle is a prism: below, its corners as they were, above, as they are. The prism is three
   tetrahedra, and prisms of neighbours have the same triangles on their common side. The view is linear in a
   tetrahedron, so the edge is in a straight piece between two of its faces. The corners have whole coordinates, and signs are exact,
   as if no corner were in line with another: so each piece that ends on a face goes on beyond it. */

/* ---- The view along the edge ------------------------------------------------------------------------------------- */

enum { VIEW_ACROSS, VIEW_BESIDE, VIEW_ALONG, VIEW_AXES };

/* The edge at one time. */
typedef struct EdgeView {
    kiriVec3 origin;
    kiriVec3 slope[VIEW_AXES]; /* coordinates are slope . (x - origin); VIEW_ALONG has the length of the edge at its second end */
    double length;        /* m */
} EdgeView;

typedef struct SeenCorner {
    int32_t id; /* 2 * vertex + (0: as it was, 1: as it is) */
    int32_t x, y;
    double inside[2]; /* m along the edge: beyond its first end, before its second */
} SeenCorner;

/* The part of a line in a tetrahedron. */
typedef struct Piece {
    kiriSectionPoint point[2];
    int32_t end[2];
    int32_t face[2][3]; /* of open ends: the ids of the corners, ascending */
    int32_t next; /* the piece that goes on from its end, or KIRI_NONE */
    bool isReached, isDone;
} Piece;

enum { OPEN_END = -1 }; /* an end that goes on in the next tetrahedron, if there is one */

typedef struct Pieces {
    const kiriSurface* surface;
    const kiriSweep* sweep;
    EdgeView view[2]; /* as the edge was, and as it is */
    double scale;     /* units of corners a metre */
    kiriMemory* memory;
    KIRI_ARRAY(Piece) pieces;
    kiriIndices triangles, starts; /* starts: pieces whose first end is open, sorted by face */
} Pieces;

static double ViewOf(const EdgeView* view, int axis, kiriVec3 at)
{
    return kiriVec3_Dot(view->slope[axis], kiriVec3_Sub(at, view->origin));
}

/* Returns half the size of a box with these half sides along an axis, enlarged a little for rounding. */
static double HalfOf(const EdgeView* view, int axis, kiriVec3 middle, kiriVec3 half)
{
    kiriVec3 s = view->slope[axis], d = kiriVec3_Sub(middle, view->origin);
    double size = fabs(s.x) * half.x + fabs(s.y) * half.y + fabs(s.z) * half.z;
    return size + 1e-9 * (size + fabs(s.x * d.x) + fabs(s.y * d.y) + fabs(s.z * d.z));
}

/* Returns true if the edge may go through a triangle in the box. */
static bool MeetsSweep(const void* context, const kiriBox* box)
{
    const Pieces* p = context;
    kiriVec3 half = kiriVec3_Scale(0.5, kiriVec3_Sub(box->upper, box->lower)), middle = kiriVec3_Add(box->lower, half);
    double reach = p->sweep->reach;
    bool meets = true;
    KIRI_TIMES(axis, VIEW_AXES) {
        double low = 1e300, high = -1e300;
        KIRI_TIMES(k, 2) {
            double more = k == 0 ? reach : 0.0, at = ViewOf(&p->view[k], axis, middle);
            double size = HalfOf(&p->view[k], axis, middle, kiriVec3_Add(half, kiriVec3_Make(more, more, more)));
            low = kiriMin(low, at - size - (axis == VIEW_ALONG ? p->view[k].length : 0.0));
            high = kiriMax(high, at + size);
        }
        meets = meets && low <= 0.0 && high >= 0.0;
    }
    return meets;
}

/* Looks along the edge from both sides of its sweep. Returns false if it has no direction. */
static bool MakeViews(Pieces* p, const kiriBounds* bounds)
{
    const kiriSweep* sweep = p->sweep;
    kiriVec3 way[2] = { kiriVec3_Sub(sweep->was[1], sweep->was[0]), kiriVec3_Sub(sweep->is[1], sweep->is[0]) };
    kiriVec3 go = kiriVec3_Add(kiriVec3_Sub(sweep->is[0], sweep->was[0]), kiriVec3_Sub(sweep->is[1], sweep->was[1]));
    kiriVec3 along = kiriVec3_Normalize(kiriVec3_Add(kiriVec3_Normalize(way[0]), kiriVec3_Normalize(way[1])));
    kiriVec3 beside = kiriVec3_Cross(along, kiriVec3_Normalize(go)),
             axis[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    KIRI_TIMES_WHILE(kiriVec3_Length(beside) < 1e-3, i, 3) {
        beside = kiriVec3_Cross(along, axis[i]);
    }
    beside = kiriVec3_Normalize(beside);
    kiriVec3 across = kiriVec3_Cross(beside, along);
    kiriBox all = kiriBounds_All(bounds);
    kiriVec3 half = kiriVec3_Scale(0.5, kiriVec3_Sub(all.upper, all.lower)), middle = kiriVec3_Add(all.lower, half);
    half = kiriVec3_Add(half, kiriVec3_Make(sweep->reach, sweep->reach, sweep->reach));
    double most = 0.0;
    KIRI_TIMES(k, 2) {
        EdgeView* view = &p->view[k];
        double length = kiriVec3_Dot(way[k], along);
        kiriVec3 lean = length > 0.0 ? kiriVec3_Scale(1.0 / length, way[k]) : along;
        view->origin = k == 0 ? sweep->was[0] : sweep->is[0];
        view->length = kiriMax(length, 0.0);
        view->slope[VIEW_ALONG] = along;
        view->slope[VIEW_ACROSS] = kiriVec3_AddScaled(across, -kiriVec3_Dot(across, lean), along);
        view->slope[VIEW_BESIDE] = kiriVec3_AddScaled(beside, -kiriVec3_Dot(beside, lean), along);
        for (int i = VIEW_ACROSS; i <= VIEW_BESIDE; ++i) {
            most = kiriMax(most, fabs(ViewOf(view, i, middle)) + HalfOf(view, i, middle, half));
        }
    }
    p->scale = (double)(1 << 29) / most;
    return most > 0.0 && most < 1e30 && kiriVec3_Dot(along, along) > 0.5;
}

static SeenCorner SeeCorner(const Pieces* p, int32_t vertex, int k)
{
    enum { MOST = 1 << 30 };
    const EdgeView* view = &p->view[k];
    kiriVec3 at = kiriSurface_At(p->surface, vertex);
    if (k == 0 && p->sweep->came != NULL) {
        at = kiriVec3_Sub(at, p->sweep->came(p->sweep->context, vertex));
    }
    double x = p->scale * ViewOf(view, VIEW_ACROSS, at), y = p->scale * ViewOf(view, VIEW_BESIDE, at);
    double along = ViewOf(view, VIEW_ALONG, at);
    return (SeenCorner){ 2 * vertex + k,
                     (int32_t)kiriClamp(x, -(double)MOST, (double)MOST),
                     (int32_t)kiriClamp(y, -(double)MOST, (double)MOST),
                     { along, view->length - along } };
}

/* ---- Pieces of lines: one a tetrahedron -------------------------------------------------------------------------- */

static int64_t Turn(const SeenCorner* a, const SeenCorner* b)
{
    return (int64_t)a->x * b->y - (int64_t)a->y * b->x;
}

/* Returns true if b is to the left of a, seen from the origin. The corners are moved by less than any number, the lower the
   id the more, along x more than along y: so this is never undecided. */
static bool IsLeft(const SeenCorner* a, const SeenCorner* b)
{
    if (a->id > b->id) {
        return !IsLeft(b, a);
    }
    int64_t turn = Turn(a, b);
    return turn != 0 ? turn > 0 : b->y != 0 ? b->y > 0 : b->x != 0 ? b->x < 0 : a->y < 0;
}

/* Finds the shares of the corners at the origin. A face that is seen edge-on has the origin between two of them. */
static void FindShares(const SeenCorner* const face[3], double shares[3])
{
    double sum = 0.0;
    KIRI_TIMES(i, 3) {
        shares[i] = fabs((double)Turn(face[(i + 1) % 3], face[(i + 2) % 3]));
        sum += shares[i];
    }
    KIRI_TIMES_WHILE(sum == 0.0, i, 3) {
        const SeenCorner *a = face[i], *b = face[(i + 1) % 3];
        if ((int64_t)a->x * b->x + (int64_t)a->y * b->y <= 0) {
            shares[i] = fabs((double)b->x) + fabs((double)b->y);
            shares[(i + 1) % 3] = fabs((double)a->x) + fabs((double)a->y);
            sum = shares[i] + shares[(i + 1) % 3];
        }
    }
    KIRI_TIMES(i, 3) {
        shares[i] = sum > 0.0 ? shares[i] / sum : 1.0 / 3.0;
    }
}

/* Writes an end of a piece, with the same bits from both tetrahedra at the face; its depths inside the ends of the edge. */
static void EndOnFace(const Pieces* p, const SeenCorner* const face[3], Piece* piece, int k, double depth[2])
{
    double shares[3];
    int tops = 0;
    kiriSectionPoint point = { 0 };
    FindShares(face, shares);
    depth[0] = depth[1] = 0.0;
    KIRI_TIMES(i, 3) {
        int32_t v = face[i]->id / 2;
        point.rest = kiriVec2_AddScaled(point.rest, shares[i], p->surface->rest.data[v]);
        point.at = kiriVec3_AddScaled(point.at, shares[i], kiriSurface_At(p->surface, v));
        depth[0] += shares[i] * face[i]->inside[0];
        depth[1] += shares[i] * face[i]->inside[1];
        piece->face[k][i] = face[i]->id;
        tops += face[i]->id % 2;
    }
    piece->point[k] = point;
    piece->end[k] = tops == 0 ? KIRI_END_FROM : tops == 3 ? KIRI_END_TO : OPEN_END;
}

/* Shortens the piece to between the ends of the edge. Returns false if nothing is left. */
static bool ClipPiece(Piece* piece, double depth[2][2])
{
    KIRI_TIMES(side, 2) {
        double d[2] = { depth[0][side], depth[1][side] };
        if (d[0] < 0.0 && d[1] < 0.0) {
            return false;
        }
        KIRI_TIMES(k, 2) {
            if (d[k] < 0.0) {
                double t = d[k] / (d[k] - d[1 - k]);
                kiriSectionPoint *a = &piece->point[k], *b = &piece->point[1 - k];
                a->rest = kiriVec2_AddScaled(a->rest, t, kiriVec2_Sub(b->rest, a->rest));
                a->at = kiriVec3_AddScaled(a->at, t, kiriVec3_Sub(b->at, a->at));
                depth[k][1 - side] += t * (depth[1 - k][1 - side] - depth[k][1 - side]);
                piece->end[k] = side == 0 ? KIRI_END_FIRST : KIRI_END_SECOND;
            }
        }
    }
    return true;
}

/* Adds the piece in a tetrahedron. Its corners ascend; isRight: in this order they are right-handed. Pieces go from first
   to last ends through all of them: by the side from which the origin looks at the face. */
static bool CrossTetrahedron(Pieces* p, const SeenCorner* const corner[4], bool isRight)
{
    Piece piece = { .next = KIRI_NONE };
    double depth[2][2];
    int ends = 0;
    KIRI_TIMES(f, 4) {
        const SeenCorner* const face[3] = { corner[f == 0 ? 1 : 0], corner[f < 2 ? 2 : 1], corner[f < 3 ? 3 : 2] };
        bool isLeft = IsLeft(face[0], face[1]);
        if (IsLeft(face[1], face[2]) == isLeft && IsLeft(face[2], face[0]) == isLeft) { /* it has the origin */
            int k = ((f % 2 == 0) == isRight) == isLeft ? 1 : 0;
            KIRI_ASSERT((ends & 1 << k) == 0);
            EndOnFace(p, face, &piece, k, depth[k]);
            ends |= 1 << k;
        }
    }
    KIRI_ASSERT(ends == 0 || ends == 3);
    if (ends == 0 || !ClipPiece(&piece, depth)) {
        return true;
    }
    return kiriArray_Push(p->memory, &p->pieces, piece) &&
           (piece.end[0] != OPEN_END || kiriArray_Push(p->memory, &p->starts, p->pieces.count - 1));
}

static bool CrossTriangle(Pieces* p, int32_t triangle)
{
    const int32_t* v = &p->surface->indices.data[3 * triangle];
    int32_t order[3] = { v[0], v[1], v[2] };
    bool isRight = true, beyond[4] = { true, true, true, true };
    KIRI_ASSERT(triangle >= 0 && triangle < p->surface->triangleCount);
    KIRI_TIMES(i, 3) { /* 0 and 1, 1 and 2, 0 and 1 */
        int k = i % 2;
        if (order[k] > order[k + 1]) {
            int32_t last = order[k];
            order[k] = order[k + 1];
            order[k + 1] = last;
            isRight = !isRight;
        }
    }
    SeenCorner corner[6];
    KIRI_TIMES(i, 6) {
        corner[i] = SeeCorner(p, order[i / 2], i % 2);
        const bool isBeyond[4] = { corner[i].x < 0, corner[i].x > 0, corner[i].y < 0, corner[i].y > 0 };
        KIRI_TIMES(k, 4) {
            beyond[k] = beyond[k] && isBeyond[k];
        }
    }
    const SeenCorner* const parts[3][4] = { { &corner[0], &corner[2], &corner[4], &corner[5] },
                                        { &corner[0], &corner[2], &corner[3], &corner[5] },
                                        { &corner[0], &corner[1], &corner[3], &corner[5] } };
    bool ok = true;
    for (int i = 0; ok && i < 3 && !(beyond[0] || beyond[1] || beyond[2] || beyond[3]); ++i) {
        ok = CrossTetrahedron(p, parts[i], (i == 1) != isRight);
    }
    return ok;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

static int CompareSides(const int32_t* a, const int32_t* b)
{
    int i = 0;
    while (i < 2 && a[i] == b[i]) {
        ++i;
    }
    return (a[i] > b[i]) - (a[i] < b[i]);
}

static bool IsPieceBefore(const void* context, int32_t a, int32_t b)
{
    const Piece* pieces = context;
    int order = CompareSides(pieces[a].face[0], pieces[b].face[0]);
    return order != 0 ? order < 0 : a < b;
}

/* Links each piece to the one that starts at the face where it ends. The sides of an open edge have different vertices, so
   no link goes across it. */
static void LinkPieces(Pieces* p)
{
    Piece* pieces = p->pieces.data;
    const int32_t *starts = p->starts.data, count = p->starts.count;
    kiriSort(p->starts.data, count, IsPieceBefore, pieces);
    KIRI_EACH_INDEX(i, p->pieces) {
        int32_t k = count;
        if (pieces[i].end[1] == OPEN_END) {
            KIRI_SEARCH(k, 0, count, CompareSides(pieces[starts[middle]].face[0], pieces[i].face[1]) < 0);
        }
        if (k < count && CompareSides(pieces[starts[k]].face[0], pieces[i].face[1]) == 0) {
            pieces[i].next = starts[k];
            pieces[starts[k]].isReached = true;
        }
    }
}

/* Adds the line that begins with a piece. */
static bool AddLine(Pieces* p, kiriSection* section, int32_t start)
{
    KIRI_ASSERT_HAS(p->pieces, start);
    Piece *first = &p->pieces.data[start], *last = first;
    kiriSectionLine line = { section->points.count, 0, { 0, 0 } };
    bool ok = kiriArray_Push(p->memory, &section->points, first->point[0]);
    for (int32_t i = start; ok && i != KIRI_NONE && !p->pieces.data[i].isDone; i = last->next) {
        last = &p->pieces.data[i];
        last->isDone = true;
        ok = kiriArray_Push(p->memory, &section->points, last->point[1]);
    }
    const int32_t end[2] = { first->end[0], last->end[1] };
    KIRI_TIMES(k, 2) {
        line.end[k] = last->next != KIRI_NONE ? KIRI_END_LOOP : end[k] == OPEN_END ? KIRI_END_BORDER : end[k];
    }
    line.count = section->points.count - line.first;
    return ok && kiriArray_Push(p->memory, &section->lines, line);
}

bool kiriSection_Sweep(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                       const kiriSweep* sweep)
{
    Pieces p = { .surface = surface, .sweep = sweep, .memory = memory };
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface));
    section->points.count = section->lines.count = 0;
    bool ok = bounds->levelCount == 0 || !MakeViews(&p, bounds) ||
              kiriBounds_Find(bounds, surface, MeetsSweep, &p, memory, &p.triangles);
    KIRI_EACH_LISTED_WHILE(ok, triangle, p.triangles) {
        ok = CrossTriangle(&p, triangle);
    }
    if (ok) {
        LinkPieces(&p);
    }
    /* Lines that begin somewhere, then loops. */
    KIRI_TIMES(pass, 2) {
        KIRI_EACH_INDEX_WHILE(ok, i, p.pieces) {
            if (!p.pieces.data[i].isDone && (pass == 1 || !p.pieces.data[i].isReached)) {
                ok = AddLine(&p, section, i);
            }
        }
    }
    kiriArray_Release(memory, &p.pieces);
    kiriArray_Release(memory, &p.triangles);
    kiriArray_Release(memory, &p.starts);
    return ok;
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static kiriVec2 RestAt(const kiriSection* section, const kiriSectionLine* line, bool fromLast, int32_t i)
{
    KIRI_ASSERT_HAS(*line, i);
    return section->points.data[line->first + (fromLast ? line->count - 1 - i : i)].rest;
}

/* Returns how many points a straight way from point i may jump. */
static int32_t JumpFrom(const kiriSection* section, const kiriSectionLine* line, bool fromLast, int32_t i,
                        double tolerance)
{
    enum { MOST = 64 };
    kiriVec2 from = RestAt(section, line, fromLast, i);
    int32_t jump = 1;
    for (bool fits = true; fits && jump < MOST && i + jump + 1 < line->count;) {
        kiriVec2 to = RestAt(section, line, fromLast, i + jump + 1);
        for (int32_t k = 1; fits && k <= jump; ++k) {
            fits = kiriVec2_DistanceToWay(RestAt(section, line, fromLast, i + k), from, to) <= tolerance;
        }
        jump += fits;
    }
    return jump;
}

bool kiriSection_Path(const kiriSection* section, const kiriSectionLine* line, bool fromLast, double tolerance,
                      kiriMemory* memory, kiriRestPoints* path)
{
    KIRI_ASSERT(line->count >= 2 && line->first + line->count <= section->points.count);
    bool ok = true;
    for (int32_t i = 0; ok && i < line->count; i += JumpFrom(section, line, fromLast, i, tolerance)) {
        ok = kiriArray_Push(memory, path, RestAt(section, line, fromLast, i));
    }
    return ok;
}
