#include "kiri_section.h"

#include "../core/kiri_array.h"

/* ---- Windows ---- */

/* Where the side has no length, all is inside. */
static void SetSide(kiriWindow* window, int side, kiriVec3 a, kiriVec3 b, kiriVec3 inside)
{
    kiriVec3 inward = kiriVec3_Cross(window->normal, kiriVec3_Sub(b, a));
    double level = kiriVec3_Dot(inward, a);
    bool isTurned = kiriVec3_Dot(inward, inside) < level;
    window->inward[side] = isTurned ? kiriVec3_Scale(-1.0, inward) : inward;
    window->level[side] = isTurned ? -level : level;
}

static bool IsOutside(const kiriWindow* window, int side, kiriVec3 at)
{
    double level = window->level[side], depth = kiriVec3_Dot(window->inward[side], at) - level;
    return depth < -1e-9 * (fabs(level) + fabs(depth + level));
}

/* The side that an end of the edge goes along. Where the corners are no convex quadrilateral (a ray from an eye that
   hardly moves, say), that line would cut off some of the edge: then the side is where the end is farthest out. */
static void SetEndSide(kiriWindow* window, int side, const kiriVec3 corner[4], kiriVec3 inside)
{
    const kiriVec3 a = corner[side], b = corner[(side + 1) % 4];
    SetSide(window, side, a, b, inside);
    if (IsOutside(window, side, corner[(side + 2) % 4]) || IsOutside(window, side, corner[(side + 3) % 4])) {
        kiriVec3 along = kiriVec3_Add(kiriVec3_Sub(corner[0], corner[1]), kiriVec3_Sub(corner[3], corner[2]));
        kiriVec3 inward = side == KIRI_SIDE_SECOND ? along : kiriVec3_Scale(-1.0, along);
        double atA = kiriVec3_Dot(inward, a), atB = kiriVec3_Dot(inward, b);
        window->inward[side] = inward;
        window->level[side] = kiriMin(atA, atB);
    }
}

bool kiriWindow_Make(kiriWindow* window, const kiriVec3 corner[4], kiriVec3 from, kiriVec3 to)
{
    kiriVec3 along = kiriVec3_Sub(corner[1], corner[0]), middle = kiriVec3_Scale(0.5, kiriVec3_Add(from, to));
    along = kiriVec3_Dot(along, along) > 0.0 ? along : kiriVec3_Sub(corner[2], corner[3]);
    kiriVec3 normal = kiriVec3_Cross(along, kiriVec3_Sub(to, from));
    double size = kiriVec3_Dot(along, along) + kiriVec3_Dot(kiriVec3_Sub(to, from), kiriVec3_Sub(to, from));
    if (!(kiriVec3_Length(normal) > 1e-12 * size)) {
        return false;
    }
    window->normal = kiriVec3_Normalize(normal);
    window->offset = kiriVec3_Dot(window->normal, to);
    window->box = (kiriBox){ corner[0], corner[0] };
    SetSide(window, KIRI_SIDE_FROM, corner[0], corner[1], to);
    SetSide(window, KIRI_SIDE_TO, corner[2], corner[3], from);
    SetEndSide(window, KIRI_SIDE_SECOND, corner, middle);
    SetEndSide(window, KIRI_SIDE_FIRST, corner, middle);
    for (int i = 0; i < 4; ++i) {
        kiriBox_Add(&window->box, corner[i]);
    }
    return true;
}

/* Boxes a little larger, for the window's own plane is rounded, too. */
static bool MeetsWindow(const void* context, const kiriBox* box)
{
    const kiriWindow* window = context;
    kiriVec3 n = window->normal, half = kiriVec3_Scale(0.5, kiriVec3_Sub(box->upper, box->lower));
    kiriVec3 middle = kiriVec3_Add(box->lower, half);
    double reach = fabs(n.x) * half.x + fabs(n.y) * half.y + fabs(n.z) * half.z;
    double slack = 1e-9 * (fabs(window->offset) + fabs(middle.x) + fabs(middle.y) + fabs(middle.z) + reach);
    return fabs(kiriVec3_Dot(n, middle) - window->offset) <= reach + slack &&
           kiriBox_MeetWithin(&window->box, box, slack);
}

/* ---- Pieces of lines: one a triangle ---- */

enum { OPEN = -1 }; /* an end that goes on in the next triangle, if there is one */

/* What of a triangle lies in the window. Above the plane is to its left. */
typedef struct Piece {
    kiriSectionPoint point[2];
    int32_t end[2];
    int32_t edge[2][2]; /* of open ends: vertices of the edge, the lower first */
    kiriVec2 out[2];
    int32_t next; /* the piece that goes on from its end, or KIRI_NONE */
    bool isReached, isDone;
} Piece;

typedef struct Pieces {
    const kiriSurface* surface;
    const kiriWindow* window;
    KIRI_ARRAY(Piece) pieces;
    kiriIndices triangles, starts; /* starts: pieces whose first end is open, sorted by edge */
} Pieces;

static double HeightOf(const Pieces* p, int32_t vertex)
{
    return kiriVec3_Dot(p->window->normal, kiriSurface_At(p->surface, vertex)) - p->window->offset;
}

static kiriSectionPoint Between(kiriSectionPoint a, kiriSectionPoint b, double t)
{
    kiriSectionPoint point = { kiriVec2_Add(a.rest, kiriVec2_Scale(t, kiriVec2_Sub(b.rest, a.rest))),
                               kiriVec3_AddScaled(a.at, t, kiriVec3_Sub(b.at, a.at)) };
    return point;
}

/* Where the plane crosses an edge: from both of its triangles the same bits. `other` is the third corner. */
static void CrossEdge(const Pieces* p, Piece* piece, int k, int32_t a, int32_t b, int32_t other)
{
    int32_t low = kiriMin(a, b), high = kiriMax(b, a);
    const kiriVec2* rest = p->surface->rest.data;
    kiriSectionPoint from = { rest[low], kiriSurface_At(p->surface, low) },
                     to = { rest[high], kiriSurface_At(p->surface, high) };
    double above = HeightOf(p, low), t = above / (above - HeightOf(p, high));
    kiriVec2 way = kiriVec2_Sub(rest[high], rest[low]), in = kiriVec2_Sub(rest[other], rest[low]);
    kiriVec2 out = kiriVec2_Make(way.y, -way.x);
    piece->point[k] = Between(from, to, t);
    piece->end[k] = OPEN;
    piece->edge[k][0] = low;
    piece->edge[k][1] = high;
    piece->out[k] = kiriVec2_Scale((kiriVec2_Dot(out, in) > 0.0 ? -1.0 : 1.0) / kiriVec2_Length(way), out);
}

/* Cuts off what is outside of a side; false where all is. */
static bool ClipSide(const Pieces* p, Piece* piece, int side)
{
    double depth[2];
    for (int k = 0; k < 2; ++k) {
        depth[k] = kiriVec3_Dot(p->window->inward[side], piece->point[k].at) - p->window->level[side];
    }
    if (depth[0] < 0.0 && depth[1] < 0.0) {
        return false;
    }
    for (int k = 0; k < 2; ++k) {
        if (depth[k] < 0.0) {
            double t = depth[k] / (depth[k] - depth[1 - k]);
            piece->point[k] = Between(piece->point[k], piece->point[1 - k], t);
            piece->end[k] = side;
        }
    }
    return true;
}

/* A vertex in the plane counts as above it: so each triangle is crossed by two of its edges, or by none. */
static bool CrossTriangle(const Pieces* p, int32_t triangle, Piece* piece)
{
    const int32_t* v = &p->surface->indices.data[3 * (size_t)triangle];
    bool above[3];
    for (int i = 0; i < 3; ++i) {
        above[i] = HeightOf(p, v[i]) >= 0.0;
    }
    if (above[0] == above[1] && above[1] == above[2]) {
        return false;
    }
    int odd = above[1] == above[2] ? 0 : above[2] == above[0] ? 1 : 2, next = (odd + 1) % 3, last = (odd + 2) % 3;
    int first = above[odd] ? 0 : 1;
    CrossEdge(p, piece, first, v[odd], v[next], v[last]);
    CrossEdge(p, piece, 1 - first, v[odd], v[last], v[next]);
    for (int side = 0; side < KIRI_SIDES; ++side) {
        if (!ClipSide(p, piece, side)) {
            return false;
        }
    }
    piece->next = KIRI_NONE;
    piece->isReached = piece->isDone = false;
    return true;
}

static bool CollectPieces(Pieces* p, kiriMemory* memory)
{
    for (int32_t i = 0; i < p->triangles.count; ++i) {
        Piece piece;
        if (!CrossTriangle(p, p->triangles.data[i], &piece)) {
            continue;
        }
        if (!kiriArray_Push(memory, &p->pieces, piece) ||
            (piece.end[0] == OPEN && !kiriArray_Push(memory, &p->starts, p->pieces.count - 1))) {
            return false;
        }
    }
    return true;
}

/* ---- Lines ---- */

static int CompareEdges(const int32_t a[2], const int32_t b[2])
{
    return a[0] != b[0] ? (a[0] < b[0] ? -1 : 1) : a[1] != b[1] ? (a[1] < b[1] ? -1 : 1) : 0;
}

static bool IsEdgeBefore(const void* context, int32_t a, int32_t b)
{
    const Pieces* p = context;
    int order = CompareEdges(p->pieces.data[a].edge[0], p->pieces.data[b].edge[0]);
    return order < 0 || (order == 0 && a < b);
}

/* The piece that starts at the edge where this one ends, or KIRI_NONE. */
static int32_t NextTriangle(const Pieces* p, const Piece* piece)
{
    int32_t low = 0, high = p->starts.count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2, at = p->starts.data[middle];
        int order = CompareEdges(p->pieces.data[at].edge[0], piece->edge[1]);
        if (order == 0) {
            return at;
        }
        low = order < 0 ? middle + 1 : low;
        high = order < 0 ? high : middle;
    }
    return KIRI_NONE;
}

/* Across an open edge of the mesh there is none: its two sides have vertices of their own. */
static void LinkPieces(Pieces* p)
{
    kiriSort(p->starts.data, p->starts.count, IsEdgeBefore, p);
    for (int32_t i = 0; i < p->pieces.count; ++i) {
        Piece* piece = &p->pieces.data[i];
        piece->next = piece->end[1] == OPEN ? NextTriangle(p, piece) : KIRI_NONE;
        if (piece->next != KIRI_NONE) {
            p->pieces.data[piece->next].isReached = true;
        }
    }
}

static int32_t EndOf(int32_t end)
{
    return end == OPEN ? KIRI_END_BORDER : end;
}

/* The line from a piece on. */
static bool AddLine(Pieces* p, kiriSection* section, kiriMemory* memory, int32_t start)
{
    KIRI_ASSERT(start >= 0 && start < p->pieces.count);
    Piece* piece = &p->pieces.data[start];
    kiriSectionLine line = { section->points.count, 0, { EndOf(piece->end[0]), 0 }, { piece->out[0], piece->out[0] } };
    bool ok = kiriArray_Push(memory, &section->points, piece->point[0]);
    for (int32_t i = start; ok && i != KIRI_NONE && !p->pieces.data[i].isDone; i = p->pieces.data[i].next) {
        piece = &p->pieces.data[i];
        piece->isDone = true;
        ok = kiriArray_Push(memory, &section->points, piece->point[1]);
    }
    line.count = section->points.count - line.first;
    line.end[1] = EndOf(piece->end[1]);
    line.out[1] = piece->out[1];
    if (piece->next != KIRI_NONE) {
        line.end[0] = line.end[1] = KIRI_END_LOOP;
    }
    return ok && kiriArray_Push(memory, &section->lines, line);
}

/* Lines that begin somewhere, then those that do not. */
static bool AddLines(Pieces* p, kiriSection* section, kiriMemory* memory)
{
    bool ok = true;
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t i = 0; ok && i < p->pieces.count; ++i) {
            if (!p->pieces.data[i].isDone && (pass == 1 || !p->pieces.data[i].isReached)) {
                ok = AddLine(p, section, memory, i);
            }
        }
    }
    return ok;
}

bool kiriSection_Add(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                     const kiriWindow* window)
{
    Pieces p = { surface, window, { NULL, 0, 0 }, { NULL, 0, 0 }, { NULL, 0, 0 } };
    bool ok = kiriBounds_Find(bounds, surface, MeetsWindow, window, memory, &p.triangles) && CollectPieces(&p, memory);
    if (ok) {
        LinkPieces(&p);
        ok = AddLines(&p, section, memory);
    }
    kiriArray_Release(memory, &p.pieces);
    kiriArray_Release(memory, &p.triangles);
    kiriArray_Release(memory, &p.starts);
    return ok;
}

/* ---- Sweeps: two windows that share a side ---- */

typedef struct Seam {
    kiriSection parts; /* lines of the first window, then of the second */
    int32_t firstCount;
    KIRI_ARRAY(int32_t) mates; /* of each end, 2 * line + (0 or 1): the end that it goes on from, or KIRI_NONE */
    KIRI_ARRAY(bool) done;     /* lines */
} Seam;

static bool IsAtSeam(const Seam* seam, int32_t end)
{
    int32_t side = seam->parts.lines.data[end / 2].end[end % 2];
    return end / 2 < seam->firstCount ? side == KIRI_SIDE_TO : side == KIRI_SIDE_FROM;
}

static kiriVec2 RestOfEnd(const Seam* seam, int32_t end)
{
    const kiriSectionLine* line = &seam->parts.lines.data[end / 2];
    return seam->parts.points.data[line->first + (end % 2 == 0 ? 0 : line->count - 1)].rest;
}

/* Both windows find the same points on the seam, but for rounding: the nearest is the right one. */
static void MateEnds(Seam* seam)
{
    int32_t middle = 2 * seam->firstCount, count = 2 * seam->parts.lines.count;
    for (int32_t a = 0; a < middle; ++a) {
        double nearest = 1e300;
        int32_t mate = KIRI_NONE;
        for (int32_t b = middle; IsAtSeam(seam, a) && b < count; ++b) {
            double distance = kiriVec2_Length(kiriVec2_Sub(RestOfEnd(seam, a), RestOfEnd(seam, b)));
            if (IsAtSeam(seam, b) && seam->mates.data[b] == KIRI_NONE && distance < nearest) {
                nearest = distance;
                mate = b;
            }
        }
        if (mate != KIRI_NONE) {
            seam->mates.data[a] = mate;
            seam->mates.data[mate] = a;
        }
    }
}

/* The points of a line from one of its ends on. */
static bool AddPoints(const Seam* seam, kiriSection* section, kiriMemory* memory, int32_t from)
{
    const kiriSectionLine* line = &seam->parts.lines.data[from / 2];
    bool ok = true;
    for (int32_t i = 0; ok && i < line->count; ++i) {
        int32_t at = line->first + (from % 2 == 0 ? i : line->count - 1 - i);
        ok = kiriArray_Push(memory, &section->points, seam->parts.points.data[at]);
    }
    return ok;
}

static bool JoinFrom(Seam* seam, kiriSection* section, kiriMemory* memory, int32_t start)
{
    const kiriSectionLine* lines = seam->parts.lines.data;
    kiriSectionLine line = lines[start / 2];
    int32_t at = start, end = start;
    line.first = section->points.count;
    while (at != KIRI_NONE && !seam->done.data[at / 2]) {
        seam->done.data[at / 2] = true;
        if (!AddPoints(seam, section, memory, at)) {
            return false;
        }
        end = at ^ 1;
        at = seam->mates.data[end];
    }
    line.count = section->points.count - line.first;
    line.end[0] = at == KIRI_NONE ? lines[start / 2].end[start % 2] : KIRI_END_LOOP;
    line.out[0] = lines[start / 2].out[start % 2];
    line.end[1] = at == KIRI_NONE ? lines[end / 2].end[end % 2] : KIRI_END_LOOP;
    line.out[1] = lines[end / 2].out[end % 2];
    return kiriArray_Push(memory, &section->lines, line);
}

/* Lines that end somewhere, then those that do not. */
static bool JoinLines(Seam* seam, kiriSection* section, kiriMemory* memory)
{
    bool ok = true;
    section->points.count = section->lines.count = 0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t end = 0; ok && end < 2 * seam->parts.lines.count; ++end) {
            if (!seam->done.data[end / 2] && (pass == 1 || seam->mates.data[end] == KIRI_NONE)) {
                ok = JoinFrom(seam, section, memory, end);
            }
        }
    }
    return ok;
}

static bool AddHalf(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                    kiriVec3 a, kiriVec3 b, kiriVec3 c, kiriVec3 d)
{
    const kiriVec3 corner[4] = { a, b, c, d };
    kiriWindow window;
    kiriVec3 from = kiriVec3_Scale(0.5, kiriVec3_Add(a, b)), to = kiriVec3_Scale(0.5, kiriVec3_Add(c, d));
    return !kiriWindow_Make(&window, corner, from, to) || kiriSection_Add(section, memory, surface, bounds, &window);
}

bool kiriSection_Sweep(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                       const kiriVec3 edge[4])
{
    Seam seam = { { { NULL, 0, 0 }, { NULL, 0, 0 } }, 0, { NULL, 0, 0 }, { NULL, 0, 0 } };
    bool ok = AddHalf(&seam.parts, memory, surface, bounds, edge[0], edge[1], edge[2], edge[0]);
    seam.firstCount = seam.parts.lines.count;
    ok = ok && AddHalf(&seam.parts, memory, surface, bounds, edge[0], edge[2], edge[2], edge[3]) &&
         kiriArray_Resize(memory, &seam.mates, 2 * (int64_t)seam.parts.lines.count) &&
         kiriArray_Resize(memory, &seam.done, seam.parts.lines.count);
    for (int32_t i = 0; ok && i < 2 * seam.parts.lines.count; ++i) {
        seam.mates.data[i] = KIRI_NONE;
        seam.done.data[i / 2] = false;
    }
    if (ok) {
        MateEnds(&seam);
        ok = JoinLines(&seam, section, memory);
    }
    kiriArray_Release(memory, &seam.parts.points);
    kiriArray_Release(memory, &seam.parts.lines);
    kiriArray_Release(memory, &seam.mates);
    kiriArray_Release(memory, &seam.done);
    return ok;
}

/* ---- Paths ---- */

static kiriVec2 RestAt(const kiriSection* section, const kiriSectionLine* line, bool fromLast, int32_t i)
{
    return section->points.data[line->first + (fromLast ? line->count - 1 - i : i)].rest;
}

/* How many points of the line, from i on, the straight way from point i may jump to. */
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

bool kiriSection_Path(const kiriSection* section, const kiriSectionLine* line, bool fromLast, double reach,
                      double tolerance, kiriMemory* memory, kiriRestPoints* path)
{
    int start = fromLast ? 1 : 0, end = 1 - start;
    bool ok = true;
    if (line->end[start] == KIRI_END_BORDER) {
        kiriVec2 out = kiriVec2_Scale(reach, line->out[start]);
        ok = kiriArray_Push(memory, path, kiriVec2_Add(RestAt(section, line, fromLast, 0), out));
    }
    for (int32_t i = 0; ok && i < line->count; i += JumpFrom(section, line, fromLast, i, tolerance)) {
        ok = kiriArray_Push(memory, path, RestAt(section, line, fromLast, i));
    }
    if (ok && line->end[end] == KIRI_END_BORDER) {
        kiriVec2 out = kiriVec2_Scale(reach, line->out[end]);
        ok = kiriArray_Push(memory, path, kiriVec2_Add(RestAt(section, line, fromLast, line->count - 1), out));
    }
    return ok;
}
