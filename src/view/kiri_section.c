#include "kiri_section.h"

#include "../core/kiri_array.h"

/* ---- Windows ----------------------------------------------------------------------------------------------------- */

/* Sets a side along a and b. If it has no length, all is inside. */
static void SetSide(kiriWindow* window, int side, kiriVec3 a, kiriVec3 b, kiriVec3 inside)
{
    kiriVec3 inward = kiriVec3_Cross(window->normal, kiriVec3_Sub(b, a));
    double level = kiriVec3_Dot(inward, a);
    bool isTurned = kiriVec3_Dot(inward, inside) < level;
    window->inward[side] = isTurned ? kiriVec3_Scale(-1.0, inward) : inward;
    window->level[side] = isTurned ? -level : level;
}

/* Sets the side along which an end of the edge moves. If the corners are not a convex quadrilateral (such as a ray from an
   eye that hardly moves), that line would cut off a part of the edge: then the side is where the end is farthest out. */
static void SetEndSide(kiriWindow* window, int side, const kiriVec3 corner[4], kiriVec3 inside)
{
    const kiriVec3 a = corner[side], b = corner[(side + 1) % 4];
    bool isConvex = true;
    SetSide(window, side, a, b, inside);
    for (int k = 2; k < 4; ++k) {
        double level = window->level[side], at = kiriVec3_Dot(window->inward[side], corner[(side + k) % 4]),
               depth = at - level;
        isConvex = isConvex && !(depth < -1e-9 * (fabs(level) + fabs(depth + level)));
    }
    if (!isConvex) {
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

/* Boxes are enlarged a little: the plane of the window is rounded, too. */
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

/* ---- Pieces of lines: one a triangle ----------------------------------------------------------------------------- */

enum { OPEN_END = -1 }; /* an end that goes on in the next triangle, if there is one */

/* The part of a line in a triangle. The side above the plane is to its left. */
typedef struct Piece {
    kiriSectionPoint point[2];
    int32_t end[2];
    int64_t edge[2]; /* of open ends: the edge of the mesh, by its vertices */
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

/* Writes the end where the plane crosses an edge, with the same bits from both triangles. `other` is the third corner. */
static void CrossEdge(const Pieces* p, Piece* piece, int k, int32_t a, int32_t b, int32_t other)
{
    int32_t low = kiriMin(a, b), high = kiriMax(b, a);
    const kiriVec2* rest = p->surface->rest.data;
    kiriSectionPoint from = { rest[low], kiriSurface_At(p->surface, low) },
                     to = { rest[high], kiriSurface_At(p->surface, high) };
    KIRI_ASSERT(low >= 0 && low < high && high < p->surface->vertexCount);
    double above = HeightOf(p, low), t = above / (above - HeightOf(p, high));
    kiriVec2 way = kiriVec2_Sub(rest[high], rest[low]), in = kiriVec2_Sub(rest[other], rest[low]);
    kiriVec2 out = kiriVec2_Make(way.y, -way.x);
    piece->point[k] = Between(from, to, t);
    piece->end[k] = OPEN_END;
    piece->edge[k] = (int64_t)low << 32 | high;
    piece->out[k] = kiriVec2_Scale((kiriVec2_Dot(out, in) > 0.0 ? -1.0 : 1.0) / kiriVec2_Length(way), out);
}

/* Cuts a triangle with the plane and the window. Returns false if nothing is left. A vertex in the plane counts as above
   it: so each triangle is crossed by two of its edges, or by none. */
static bool CrossTriangle(const Pieces* p, int32_t triangle, Piece* piece)
{
    const int32_t* v = &p->surface->indices.data[3 * (size_t)triangle];
    bool above[3];
    KIRI_ASSERT(triangle >= 0 && triangle < p->surface->triangleCount);
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
        double depth[2];
        for (int k = 0; k < 2; ++k) {
            depth[k] = kiriVec3_Dot(p->window->inward[side], piece->point[k].at) - p->window->level[side];
        }
        if (depth[0] < 0.0 && depth[1] < 0.0) {
            return false;
        }
        for (int k = 0; k < 2; ++k) {
            if (depth[k] < 0.0) {
                piece->point[k] =
                    Between(piece->point[k], piece->point[1 - k], depth[k] / (depth[k] - depth[1 - k]));
                piece->end[k] = side;
            }
        }
    }
    piece->next = KIRI_NONE;
    piece->isReached = piece->isDone = false;
    return true;
}

static bool IsEdgeBefore(const void* context, int32_t a, int32_t b)
{
    const Piece* pieces = context;
    return pieces[a].edge[0] != pieces[b].edge[0] ? pieces[a].edge[0] < pieces[b].edge[0] : a < b;
}

/* Collects the pieces, and links each to the piece that starts at the edge where it ends. The sides of an open edge have
   different vertices, so no link goes across it. */
static bool CollectPieces(Pieces* p, kiriMemory* memory)
{
    for (int32_t i = 0; i < p->triangles.count; ++i) {
        Piece piece;
        if (CrossTriangle(p, p->triangles.data[i], &piece) &&
            (!kiriArray_Push(memory, &p->pieces, piece) ||
             (piece.end[0] == OPEN_END && !kiriArray_Push(memory, &p->starts, p->pieces.count - 1)))) {
            return false;
        }
    }
    Piece* pieces = p->pieces.data;
    const int32_t *starts = p->starts.data, count = p->starts.count;
    kiriSort(p->starts.data, count, IsEdgeBefore, pieces);
    for (int32_t i = 0; i < p->pieces.count; ++i) {
        int32_t k = count;
        if (pieces[i].end[1] == OPEN_END) {
            KIRI_SEARCH(k, 0, count, pieces[starts[middle]].edge[0] < pieces[i].edge[1]);
        }
        if (k < count && pieces[starts[k]].edge[0] == pieces[i].edge[1]) {
            pieces[i].next = starts[k];
            pieces[starts[k]].isReached = true;
        }
    }
    return true;
}

/* Adds the line that begins with a piece. */
static bool AddLine(Pieces* p, kiriSection* section, kiriMemory* memory, int32_t start)
{
    KIRI_ASSERT(start >= 0 && start < p->pieces.count);
    Piece *first = &p->pieces.data[start], *last = first;
    kiriSectionLine line = { section->points.count, 0, { 0, 0 }, { first->out[0], first->out[0] } };
    bool ok = kiriArray_Push(memory, &section->points, first->point[0]);
    for (int32_t i = start; ok && i != KIRI_NONE && !p->pieces.data[i].isDone; i = last->next) {
        last = &p->pieces.data[i];
        last->isDone = true;
        ok = kiriArray_Push(memory, &section->points, last->point[1]);
    }
    const int32_t end[2] = { first->end[0], last->end[1] };
    for (int k = 0; k < 2; ++k) {
        line.end[k] = last->next != KIRI_NONE ? KIRI_END_LOOP : end[k] == OPEN_END ? KIRI_END_BORDER : end[k];
    }
    line.count = section->points.count - line.first;
    line.out[1] = last->out[1];
    return ok && kiriArray_Push(memory, &section->lines, line);
}

bool kiriSection_Add(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                     const kiriWindow* window)
{
    Pieces p = { surface, window, { NULL, 0, 0 }, { NULL, 0, 0 }, { NULL, 0, 0 } };
    KIRI_ASSERT(kiriBounds_IsFresh(bounds, surface));
    bool ok = kiriBounds_Find(bounds, surface, MeetsWindow, window, memory, &p.triangles) && CollectPieces(&p, memory);
    /* Lines that begin somewhere, then loops. */
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t i = 0; ok && i < p.pieces.count; ++i) {
            if (!p.pieces.data[i].isDone && (pass == 1 || !p.pieces.data[i].isReached)) {
                ok = AddLine(&p, section, memory, i);
            }
        }
    }
    kiriArray_Release(memory, &p.pieces);
    kiriArray_Release(memory, &p.triangles);
    kiriArray_Release(memory, &p.starts);
    return ok;
}

/* ---- Sweeps: two windows that share a side ----------------------------------------------------------------------- */

/* An end of a line is 2 * line + (0 or 1). */
typedef struct Seam {
    kiriSection parts; /* lines of the first window, then of the second */
    int32_t firstCount;
    kiriIndices mates;     /* of each end: the end that it goes on from, or KIRI_NONE */
    KIRI_ARRAY(bool) done; /* of each line */
} Seam;

static bool IsAtSeam(const Seam* seam, int32_t end)
{
    KIRI_ASSERT(end >= 0 && end / 2 < seam->parts.lines.count);
    return seam->parts.lines.data[end / 2].end[end % 2] ==
           (end / 2 < seam->firstCount ? KIRI_SIDE_TO : KIRI_SIDE_FROM);
}

static kiriVec2 RestOfEnd(const Seam* seam, int32_t end)
{
    const kiriSectionLine* line = &seam->parts.lines.data[end / 2];
    return seam->parts.points.data[line->first + (end % 2 == 0 ? 0 : line->count - 1)].rest;
}

/* Both windows find the same points on the seam, but for rounding: so the nearest free end is the mate. */
static void MateEnds(Seam* seam)
{
    int32_t second = 2 * seam->firstCount, *mates = seam->mates.data;
    for (int32_t i = 0; i < seam->mates.count; ++i) {
        mates[i] = KIRI_NONE;
        seam->done.data[i / 2] = false;
    }
    for (int32_t a = 0; a < second; ++a) {
        double nearest = 1e300;
        for (int32_t b = second; IsAtSeam(seam, a) && b < seam->mates.count; ++b) {
            double distance = kiriVec2_Length(kiriVec2_Sub(RestOfEnd(seam, a), RestOfEnd(seam, b)));
            if (IsAtSeam(seam, b) && mates[b] == KIRI_NONE && distance < nearest) {
                nearest = distance;
                mates[a] = b;
            }
        }
        if (mates[a] != KIRI_NONE) {
            mates[mates[a]] = a;
        }
    }
}

/* Adds the line that begins with an end of a part. */
static bool JoinLine(Seam* seam, kiriSection* section, kiriMemory* memory, int32_t start)
{
    const kiriSectionLine* lines = seam->parts.lines.data;
    kiriSectionLine line = { section->points.count, 0, { KIRI_END_LOOP, KIRI_END_LOOP }, { { 0, 0 }, { 0, 0 } } };
    int32_t at = start, end = start;
    while (at != KIRI_NONE && !seam->done.data[at / 2]) {
        const kiriSectionLine* part = &lines[at / 2];
        seam->done.data[at / 2] = true;
        for (int32_t i = 0; i < part->count; ++i) {
            int32_t point = part->first + (at % 2 == 0 ? i : part->count - 1 - i);
            if (!kiriArray_Push(memory, &section->points, seam->parts.points.data[point])) {
                return false;
            }
        }
        end = at ^ 1;
        at = seam->mates.data[end];
    }
    if (at == KIRI_NONE) {
        line.end[0] = lines[start / 2].end[start % 2];
        line.end[1] = lines[end / 2].end[end % 2];
    }
    line.out[0] = lines[start / 2].out[start % 2];
    line.out[1] = lines[end / 2].out[end % 2];
    line.count = section->points.count - line.first;
    return kiriArray_Push(memory, &section->lines, line);
}

bool kiriSection_Sweep(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                       const kiriVec3 edge[4])
{
    const kiriVec3 halves[2][4] = { { edge[0], edge[1], edge[2], edge[0] }, { edge[0], edge[2], edge[2], edge[3] } };
    Seam seam = { { { NULL, 0, 0 }, { NULL, 0, 0 } }, 0, { NULL, 0, 0 }, { NULL, 0, 0 } };
    bool ok = true;
    for (int k = 0; ok && k < 2; ++k) {
        const kiriVec3* c = halves[k];
        kiriVec3 from = kiriVec3_Scale(0.5, kiriVec3_Add(c[0], c[1])), to = kiriVec3_Scale(0.5, kiriVec3_Add(c[2], c[3]));
        kiriWindow window;
        seam.firstCount = seam.parts.lines.count;
        ok = !kiriWindow_Make(&window, c, from, to) || kiriSection_Add(&seam.parts, memory, surface, bounds, &window);
    }
    int32_t lines = seam.parts.lines.count;
    ok = ok && kiriArray_Resize(memory, &seam.mates, 2 * (int64_t)lines) && kiriArray_Resize(memory, &seam.done, lines);
    if (ok) {
        MateEnds(&seam);
    }
    section->points.count = section->lines.count = 0;
    /* Lines that end somewhere, then loops. */
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t end = 0; ok && end < 2 * lines; ++end) {
            if (!seam.done.data[end / 2] && (pass == 1 || seam.mates.data[end] == KIRI_NONE)) {
                ok = JoinLine(&seam, section, memory, end);
            }
        }
    }
    kiriArray_Release(memory, &seam.parts.points);
    kiriArray_Release(memory, &seam.parts.lines);
    kiriArray_Release(memory, &seam.mates);
    kiriArray_Release(memory, &seam.done);
    return ok;
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static kiriVec2 RestAt(const kiriSection* section, const kiriSectionLine* line, bool fromLast, int32_t i)
{
    KIRI_ASSERT(i >= 0 && i < line->count);
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

/* Adds a point beyond an end of the line, if that is at a border. */
static bool AddBeyond(const kiriSection* section, const kiriSectionLine* line, int end, double reach,
                      kiriMemory* memory, kiriRestPoints* path)
{
    kiriVec2 at = RestAt(section, line, end == 1, 0);
    return line->end[end] != KIRI_END_BORDER ||
           kiriArray_Push(memory, path, kiriVec2_Add(at, kiriVec2_Scale(reach, line->out[end])));
}

bool kiriSection_Path(const kiriSection* section, const kiriSectionLine* line, bool fromLast, double reach,
                      double tolerance, kiriMemory* memory, kiriRestPoints* path)
{
    KIRI_ASSERT(line->count >= 2 && line->first + line->count <= section->points.count);
    bool ok = AddBeyond(section, line, fromLast ? 1 : 0, reach, memory, path);
    for (int32_t i = 0; ok && i < line->count; i += JumpFrom(section, line, fromLast, i, tolerance)) {
        ok = kiriArray_Push(memory, path, RestAt(section, line, fromLast, i));
    }
    return ok && AddBeyond(section, line, fromLast ? 0 : 1, reach, memory, path);
}
