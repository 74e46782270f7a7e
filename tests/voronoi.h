/* Sheets whose regions are an exact Voronoi diagram of the sites in a rectangle: links and corners without a grid. */
#ifndef KIRI_TEST_VORONOI_H
#define KIRI_TEST_VORONOI_H

#include "motion/kiri_solver.h"
#include "pieces.h"
#include "support.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { VORONOI_SITES = 640, VORONOI_LINKS = 4 * VORONOI_SITES, VORONOI_SIDES = 32 };

typedef struct Voronoi {
    double length, width; /* of the rectangle, from the origin */
    kiriVec2 sites[VORONOI_SITES];
    kiriFrameData frames[VORONOI_SITES];
    kiriLink links[VORONOI_LINKS];
    kiriCorner corners[VORONOI_LINKS];
    kiriAreaElements elements;
    kiriSystem system;
    kiriMemory memory; /* of the solver and the area elements */
    kiriSolver* solver;
} Voronoi;

/* A convex polygon; side k leads from corner k to the next, and borders on this site, or on the edge of the sheet. */
typedef struct VoronoiCell {
    int count;
    kiriVec2 at[VORONOI_SIDES];
    int32_t beside[VORONOI_SIDES];
} VoronoiCell;

/* What lies on the first site's side of the middle line between two. */
static inline void Voronoi_Clip(VoronoiCell* cell, kiriVec2 a, kiriVec2 b, int32_t beside)
{
    VoronoiCell out = { 0, { { 0.0, 0.0 } }, { 0 } };
    kiriVec2 way = kiriVec2_Sub(b, a), middle = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
    double least = 1e-9 * kiriVec2_Dot(way, way);
    for (int k = 0; k < cell->count; ++k) {
        kiriVec2 p = cell->at[k], q = cell->at[(k + 1) % cell->count];
        double before = kiriVec2_Dot(kiriVec2_Sub(p, middle), way), behind = kiriVec2_Dot(kiriVec2_Sub(q, middle), way);
        assert_true(out.count + 2 <= VORONOI_SIDES);
        if (before <= least) {
            out.at[out.count] = p;
            out.beside[out.count++] = cell->beside[k];
        }
        if ((before <= least) != (behind <= least)) {
            out.at[out.count] = kiriVec2_Add(p, kiriVec2_Scale(before / (before - behind), kiriVec2_Sub(q, p)));
            out.beside[out.count++] = before <= least ? beside : cell->beside[k];
        }
    }
    *cell = out;
}

static inline VoronoiCell Voronoi_CellOf(const Voronoi* v, int32_t i)
{
    VoronoiCell cell = { 4,
                         { { 0.0, 0.0 }, { v->length, 0.0 }, { v->length, v->width }, { 0.0, v->width } },
                         { KIRI_NONE, KIRI_NONE, KIRI_NONE, KIRI_NONE } };
    for (int32_t j = 0; j < v->system.frameCount; ++j) {
        if (j != i) {
            Voronoi_Clip(&cell, v->sites[i], v->sites[j], j);
        }
    }
    return cell;
}

/* Area, centroid and moments by triangles from the site. */
static inline void Voronoi_SetFrame(Voronoi* v, int32_t i, const VoronoiCell* cell)
{
    kiriFrameData* f = &v->frames[i];
    double areaMass = (double)v->system.material.density * (double)v->system.material.thickness;
    kiriVec2 sum = { 0.0, 0.0 };
    double m[3] = { 0.0, 0.0, 0.0 };
    memset(f, 0, sizeof(*f));
    for (int k = 0; k < cell->count; ++k) {
        kiriVec2 p = kiriVec2_Sub(cell->at[k], v->sites[i]);
        kiriVec2 q = kiriVec2_Sub(cell->at[(k + 1) % cell->count], v->sites[i]);
        double area = 0.5 * (p.x * q.y - p.y * q.x);
        f->area += area;
        sum = kiriVec2_Add(sum, kiriVec2_Scale(area / 3.0, kiriVec2_Add(p, q)));
        m[0] += area / 6.0 * (p.x * p.x + p.x * q.x + q.x * q.x);
        m[1] += area / 12.0 * (2.0 * p.x * p.y + p.x * q.y + q.x * p.y + 2.0 * q.x * q.y);
        m[2] += area / 6.0 * (p.y * p.y + p.y * q.y + q.y * q.y);
    }
    kiriVec2 c = kiriVec2_Scale(1.0 / f->area, sum);
    f->inertia[0] = areaMass * (m[0] - f->area * c.x * c.x);
    f->inertia[1] = areaMass * (m[1] - f->area * c.x * c.y);
    f->inertia[2] = areaMass * (m[2] - f->area * c.y * c.y);
    f->mass = areaMass * f->area;
    f->site.at = v->sites[i];
    f->center = kiriVec2_Add(v->sites[i], c);
    f->x = kiriVec3_Make(f->center.x, f->center.y, 0.0);
    f->A.u.x = f->A.v.y = f->A.d.z = 1.0;
}

static inline bool Voronoi_IsOnEdge(const Voronoi* v, kiriVec2 p)
{
    double near = 1e-7 * v->length;
    return p.x < near || p.y < near || p.x > v->length - near || p.y > v->width - near;
}

static inline double Clamped(double a, double most)
{
    return a < 0.0 ? 0.0 : a < most ? a : most;
}

/* The link over a side of cell i, whose ends are p and q. */
static inline void Voronoi_AddLink(Voronoi* v, int32_t i, int32_t j, kiriVec2 p, kiriVec2 q)
{
    assert_true(v->system.linkCount < VORONOI_LINKS);
    kiriLink* k = &v->links[v->system.linkCount++];
    memset(k, 0, sizeof(*k));
    k->i = i;
    k->j = j;
    k->width = kiriVec2_Length(kiriVec2_Sub(q, p));
    k->span = kiriVec2_Sub(v->sites[j], v->sites[i]);
    k->length = kiriVec2_Length(k->span);
    k->moment = k->width * k->width * k->width / 12.0;
    k->normal = kiriVec2_Scale(1.0 / k->length, k->span);
    k->tangent = kiriVec2_Make(-k->normal.y, k->normal.x);
    k->sum = kiriVec2_Scale(k->width, k->normal);
    k->centroid = kiriVec2_Scale(0.5, kiriVec2_Add(p, q));
    k->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(v->sites[i], v->sites[j]));
    double fromP = kiriVec2_Dot(kiriVec2_Sub(k->crossing, p), k->tangent);
    double toQ = kiriVec2_Dot(kiriVec2_Sub(q, k->crossing), k->tangent);
    k->outer = Voronoi_IsOnEdge(v, p) ? Clamped(fromP, k->width) : 0.0;
    k->outer = Clamped(k->outer + (Voronoi_IsOnEdge(v, q) ? Clamped(toQ, k->width) : 0.0), k->width);
}

static inline int32_t Voronoi_LinkOf(const Voronoi* v, int32_t i, int32_t j)
{
    for (int32_t k = 0; k < v->system.linkCount; ++k) {
        if (v->links[k].i == (i < j ? i : j) && v->links[k].j == (i < j ? j : i)) {
            return k;
        }
    }
    return KIRI_NONE;
}

/* The place that is as far from each of three sites. */
static inline kiriVec2 Voronoi_CenterOf(kiriVec2 a, kiriVec2 b, kiriVec2 c)
{
    kiriVec2 s = kiriVec2_Sub(b, a), t = kiriVec2_Sub(c, a);
    double ss = kiriVec2_Dot(s, s), tt = kiriVec2_Dot(t, t), per = 0.5 / kiriVec2_Cross(s, t);
    return kiriVec2_Make(a.x + per * (t.y * ss - s.y * tt), a.y + per * (s.x * tt - t.x * ss));
}

/* The width of a link up to the corner, by its length; 0 if the third site sees the corner beyond the link. */
static inline double Voronoi_ShareOf(const kiriLink* link, kiriVec2 at, kiriVec2 third)
{
    double way = kiriVec2_Dot(kiriVec2_Sub(at, link->crossing), link->tangent);
    double side = kiriVec2_Dot(kiriVec2_Sub(third, link->crossing), link->tangent);
    return fmax(side < 0.0 ? -way : way, 0.0) / link->length;
}

/* A ring of `count` regions. */
static inline void Voronoi_AddCorner(Voronoi* v, const int32_t* ring, int count)
{
    assert_true(v->system.cornerCount < VORONOI_LINKS);
    kiriCorner* c = &v->corners[v->system.cornerCount];
    kiriVec2 at = Voronoi_CenterOf(v->sites[ring[0]], v->sites[ring[1]], v->sites[ring[2]]);
    double xx = 0.0, xy = 0.0, yy = 0.0, pairs = 0.0, share[4];
    memset(c, 0, sizeof(*c));
    c->count = count;
    for (int k = 0; k < 4; ++k) {
        c->link[k] = k < count ? Voronoi_LinkOf(v, ring[k], ring[(k + 1) % count]) : KIRI_NONE;
        if (k < count) {
            assert_true(c->link[k] != KIRI_NONE);
            kiriLink* link = &v->links[c->link[k]];
            kiriVec2 s = link->span;
            share[k] = Voronoi_ShareOf(link, at, v->sites[ring[(k + 2) % count]]);
            link->square += count == 4 ? share[k] * link->length : 0.0;
            xx += share[k] * s.x * s.x;
            xy += share[k] * s.x * s.y;
            yy += share[k] * s.y * s.y;
        }
    }
    double det = xx * yy - xy * xy;
    for (int k = 0; k < count; ++k) {
        kiriVec2 s = v->links[c->link[k]].span, t = v->links[c->link[(k + 1) % count]].span;
        c->weight[k] = kiriVec2_Scale(share[k] / det, kiriVec2_Make(yy * s.x - xy * s.y, xx * s.y - xy * s.x));
        c->area += 0.5 * fabs(s.x * t.y - s.y * t.x) * (count == 4 ? 2.0 : 1.0);
        pairs += 1.0;
    }
    c->area /= pairs;
    ++v->system.cornerCount;
}

/* Corners of the diagram, seen from their lowest region. */
static inline void Voronoi_AddCorners(Voronoi* v, int32_t i, const VoronoiCell* cell)
{
    double near = 1e-6 * v->length;
    for (int k = 0; k < cell->count; ++k) {
        kiriVec2 p = cell->at[k];
        int32_t from = cell->beside[(k + cell->count - 1) % cell->count], to = cell->beside[k], opposite = KIRI_NONE;
        double reach = kiriVec2_Length(kiriVec2_Sub(v->sites[i], p));
        if (from == KIRI_NONE || to == KIRI_NONE) {
            continue;
        }
        for (int32_t j = 0; j < v->system.frameCount; ++j) {
            bool isNear = fabs(kiriVec2_Length(kiriVec2_Sub(v->sites[j], p)) - reach) < near;
            opposite = isNear && j != i && j != from && j != to ? j : opposite;
        }
        int32_t ring[4] = { i, from, opposite == KIRI_NONE ? to : opposite, to };
        if (i < from && i < to && (opposite == KIRI_NONE || i < opposite)) {
            Voronoi_AddCorner(v, ring, opposite == KIRI_NONE ? 3 : 4);
        }
    }
}

/* From length, width, sites, frameCount and material. */
static inline void Voronoi_Build(Voronoi* v)
{
    v->system.frames = v->frames;
    v->system.links = v->links;
    v->system.corners = v->corners;
    v->system.linkCount = v->system.cornerCount = 0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t i = 0; i < v->system.frameCount; ++i) {
            VoronoiCell cell = Voronoi_CellOf(v, i);
            for (int k = 0; pass == 0 && k < cell.count; ++k) {
                kiriVec2 p = cell.at[k], q = cell.at[(k + 1) % cell.count];
                if (cell.beside[k] > i && kiriVec2_Length(kiriVec2_Sub(p, q)) > 1e-6 * v->length) {
                    Voronoi_AddLink(v, i, cell.beside[k], p, q);
                }
            }
            pass == 0 ? Voronoi_SetFrame(v, i, &cell) : Voronoi_AddCorners(v, i, &cell);
        }
    }
}

/* Moves every inner site to the centroid of its region, again and again. Those on the ends u = 0 and u = L stay on
   them. */
static inline void Voronoi_Relax(Voronoi* v, int rounds)
{
    for (int n = 0; n < rounds; ++n) {
        kiriVec2 to[VORONOI_SITES];
        for (int32_t i = 0; i < v->system.frameCount; ++i) {
            VoronoiCell cell = Voronoi_CellOf(v, i);
            Voronoi_SetFrame(v, i, &cell);
            to[i] = v->frames[i].center;
            if (v->sites[i].x == 0.0 || v->sites[i].x == v->length) {
                to[i].x = v->sites[i].x;
            }
        }
        memcpy(v->sites, to, sizeof(to[0]) * (size_t)v->system.frameCount);
    }
}

static inline void Voronoi_AddSite(Voronoi* v, double x, double y)
{
    assert_true(v->system.frameCount < VORONOI_SITES);
    v->sites[v->system.frameCount++] = kiriVec2_Make(x, y);
}

static inline void Voronoi_Begin(Voronoi* v, double length, double width, kiriMaterial material)
{
    memset(v, 0, sizeof(*v));
    v->length = length;
    v->width = width;
    v->system.material = material;
}

/* Of affine frames; Voronoi_Drop frees them. */
static inline void Voronoi_AddAreaElements(Voronoi* v)
{
    static kiriMoments material[VORONOI_SITES];
    v->memory = kiriMemory_Make(NULL, NULL, NULL);
    for (int32_t f = 0; f < v->system.frameCount; ++f) {
        double area = v->frames[f].area;
        kiriVec2 c = v->frames[f].center;
        material[f] = (kiriMoments){ area, area * c.x, area * c.y, 0.0, 0.0, 0.0 };
    }
    if (v->system.mechanics.model == KIRI_MODEL_AFFINE) {
        assert_true(kiriAffine_Build(&v->elements, &v->memory, v->links, v->system.linkCount, material,
                                     v->system.frameCount, false));
        v->system.areaElements = &v->elements;
    }
}

static inline void Voronoi_Drop(Voronoi* v)
{
    kiriMemory_FreeAll(&v->memory);
}

#endif
