/* Links and the ways between sites: against the Euclidean Voronoi diagram, sums over faces, and all edges of the mesh. */
#include "scene.h"

#include "field/kiri_link.h"
#include "field/kiri_path.h"

typedef struct Links {
    kiriRegions regions;
    kiriLinks made;
} Links;

static void Build(Scene* scene, Links* l, const kiriSite* sites, int32_t count)
{
    FREED(kiriSiteMove, moves) = malloc(sizeof(kiriSiteMove) * (size_t)(count + 1));
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    for (int32_t i = 0; i < count; ++i) {
        moves[i] = (kiriSiteMove){ i, KIRI_NONE };
    }
    memset(l, 0, sizeof(*l));
    assert_int_equal(kiriRegions_Update(&l->regions, &scene->grid, sites, count, moves, count, &quota), KIRI_DONE);
    assert_int_equal(kiriLinks_Update(&l->made, &scene->grid, &l->regions, sites, count, &quota), KIRI_DONE);
    assert_int_equal(l->made.links.count, 0);
    assert_int_equal(l->made.changed, l->made.next.count);
    kiriLinks_Commit(&l->made);
}

static int32_t OwnerOf(const Links* l, int32_t cell)
{
    return l->regions.field.owner.data[cell];
}

/* What every corner promises: with the links' strains of one curvature (or stretch) K, each K s_k, the weights give
   its trace. */
static void CheckCorner(const Links* l, const kiriCorner* corner)
{
    double a[4] = { 0.0, 0.0, 0.0, 0.0 };
    for (int32_t k = 0; k < corner->count; ++k) {
        const kiriLink* link = &l->made.links.data[corner->link[k]];
        assert_true(k == 0 || corner->link[k] > corner->link[k - 1]);
        a[0] += corner->weight[k].x * link->span.x;
        a[1] += corner->weight[k].x * link->span.y;
        a[2] += corner->weight[k].y * link->span.x;
        a[3] += corner->weight[k].y * link->span.y;
    }
    AssertNear(a[0], 1.0, 1e-9);
    AssertNear(a[1], 0.0, 1e-9);
    AssertNear(a[2], 0.0, 1e-9);
    AssertNear(a[3], 1.0, 1e-9);
}

/* Three rows, the middle one shifted by half a region: three regions meet at each corner. */
TEST(CornersOfShiftedRows)
{
    SCOPED(Scene, scene, Scene_Release);
    Links links;
    kiriSite sites[12];
    Scene_Init(&scene, 1.0, 0.75, 4, 3, 60);
    Scene_BuildGrid(&scene);
    for (int i = 0; i < 12; ++i) {
        sites[i] = Scene_Site(&scene, (7.5 + 15 * (i % 4) + (i / 4 == 1 ? 6 : 0)) / 60, (7.5 + 15 * (i / 4)) / 60);
    }
    Build(&scene, &links, sites, 12);
    assert_int_equal(links.made.corners.count, 12);
    double area = 0.0;
    for (int k = 0; k < 12; ++k) {
        const kiriCorner* corner = &links.made.corners.data[k];
        assert_int_equal(corner->count, 3);
        AssertNear(corner->area, 0.5 * 0.25 * 0.25, 1e-6);
        CheckCorner(&links, corner);
        area += corner->area;
    }
    AssertNear(area, 12 * 0.5 * 0.25 * 0.25, 1e-6);
}

/* On randomly cut sheets: links are in order, no shorter than the straight line, and join what hangs together; and
   their borders are those of the grid, pair by pair, but for three squares at each end. */
TEST(RandomSheetsAddUp)
{
    uint32_t seed = 3;
    int32_t found = 0, corners = 0;
    for (int round = 0; round < 150; ++round) {
        SCOPED(Scene, scene, Scene_Release);
        kiriSites sites;
        Links links;
        Scene_InitRandom(&scene, &sites, 2 + (int32_t)(Random(&seed) % 20), &seed);
        int32_t n = sites.count;
        Build(&scene, &links, sites.data, n);
        kiriVec2* sums = calloc((size_t)(n * n), sizeof(kiriVec2));
        int32_t* counts = calloc((size_t)(n * n), sizeof(int32_t));
        for (int32_t i = 0; i < n; ++i) {
            assert_int_equal(OwnerOf(&links, sites.data[i].cell), i);
        }
        for (int32_t f = 0; f < scene.grid.faces.count; ++f) {
            const kiriFace* face = &scene.grid.faces.data[f];
            int32_t a = OwnerOf(&links, face->cell[0]), b = OwnerOf(&links, face->cell[1]);
            double full = kiriGrid_Stretch(&scene.grid, f).width, width = a < b ? full : -full;
            if (a != b) {
                kiriVec2* sum = &sums[a < b ? a * n + b : b * n + a];
                sum->x += kiriFace_Axis(face) == 0 ? width : 0.0;
                sum->y += kiriFace_Axis(face) == 1 ? width : 0.0;
            }
        }
        for (int32_t k = 0; k < links.made.links.count; ++k) {
            const kiriLink* link = &links.made.links.data[k];
            kiriVec2* sum = &sums[link->i * n + link->j];
            *sum = kiriVec2_Sub(*sum, kiriVec2_Scale(link->width, link->normal));
            counts[link->i * n + link->j] += 1;
        }
        for (int32_t k = 0; k < n * n; ++k) {
            AssertNear(kiriVec2_Length(sums[k]), 0.0, 6.0 * counts[k] * scene.grid.side);
        }
        for (int32_t k = 0; k < links.made.corners.count; ++k) {
            CheckCorner(&links, &links.made.corners.data[k]);
        }
        found += links.made.links.count;
        corners += links.made.corners.count;
        free(sums);
        free(counts);
        kiriArray_Release(&scene.memory, &sites);
    }
    assert_true(found > 1000);
    assert_true(corners > 200);
}

/* ---- Against the Euclidean Voronoi diagram ----------------------------------------------------------------------- */

/* The part of a rectangle that is nearest to one site, by clipping it at all others: an edge a neighbour. */
typedef struct Polygon {
    kiriVec2 at[40];
    int32_t beyond[40]; /* the edge from this corner to the next: what is beyond, or KIRI_NONE at the outline */
    int32_t count;
} Polygon;

static void ClipAt(Polygon* polygon, kiriVec2 middle, kiriVec2 normal, int32_t beyond)
{
    Polygon was = *polygon;
    polygon->count = 0;
    for (int32_t i = 0; i < was.count; ++i) {
        kiriVec2 p = was.at[i], q = was.at[(i + 1) % was.count];
        double a = kiriVec2_Dot(kiriVec2_Sub(p, middle), normal), b = kiriVec2_Dot(kiriVec2_Sub(q, middle), normal);
        if (a <= 0.0) {
            polygon->at[polygon->count] = p;
            polygon->beyond[polygon->count++] = was.beyond[i];
        }
        if ((a <= 0.0) != (b <= 0.0)) {
            polygon->at[polygon->count] = kiriVec2_Add(p, kiriVec2_Scale(a / (a - b), kiriVec2_Sub(q, p)));
            polygon->beyond[polygon->count++] = a <= 0.0 ? beyond : was.beyond[i];
        }
        assert_true(polygon->count < 38);
    }
}

static Polygon NearestTo(const kiriSite* sites, int32_t count, int32_t i, double width, double height)
{
    Polygon polygon = { { { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } },
                        { KIRI_NONE, KIRI_NONE, KIRI_NONE, KIRI_NONE },
                        4 };
    for (int32_t k = 0; k < count; ++k) {
        if (k != i) {
            kiriVec2 way = kiriVec2_Sub(sites[k].at, sites[i].at);
            ClipAt(&polygon, kiriVec2_Scale(0.5, kiriVec2_Add(sites[k].at, sites[i].at)), way, k);
        }
    }
    return polygon;
}

static const kiriLink* LinkOf(const Links* l, int32_t i, int32_t j)
{
    for (int32_t k = 0; k < l->made.links.count; ++k) {
        const kiriLink* link = &l->made.links.data[k];
        if (link->i == (i < j ? i : j) && link->j == (i < j ? j : i)) {
            return link;
        }
    }
    return NULL;
}

static bool IsOnOutline(kiriVec2 p, double width, double height)
{
    return fabs(p.x) < 1e-9 || fabs(p.y) < 1e-9 || fabs(p.x - width) < 1e-9 || fabs(p.y - height) < 1e-9;
}

/* Of the way from the crossing to an end at the outline. */
static double OuterPart(const kiriLink* link, kiriVec2 end)
{
    double way = fabs(kiriVec2_Dot(kiriVec2_Sub(end, link->crossing), link->tangent));
    bool ahead = kiriVec2_Dot(kiriVec2_Sub(end, link->centroid), kiriVec2_Sub(end, link->crossing)) > 0.0;
    return ahead ? way : 0.0;
}

/* Every edge of the diagram that is not next to nothing is a link, and every link an edge. Returns the sum of the
   lengths of all edges between regions. */
static double CheckVoronoi(const Links* l, const kiriSite* sites, int32_t count, double width, double height)
{
    double sum = 0.0, found = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        Polygon polygon = NearestTo(sites, count, i, width, height);
        for (int32_t e = 0; e < polygon.count; ++e) {
            kiriVec2 a = polygon.at[e], b = polygon.at[(e + 1) % polygon.count];
            int32_t j = polygon.beyond[e];
            double length = kiriVec2_Length(kiriVec2_Sub(b, a));
            if (j < i || length < 1e-6) {
                continue; /* the outline, seen already, or four regions that meet in a point */
            }
            const kiriLink* link = LinkOf(l, i, j);
            assert_non_null(link);
            AssertNear(link->width, length, 1e-9);
            AssertNear(kiriVec2_Length(kiriVec2_Sub(link->centroid, kiriVec2_Scale(0.5, kiriVec2_Add(a, b)))), 0.0,
                       1e-9);
            AssertNear(link->moment, length * length * length / 12.0, 1e-9);
            AssertNear(link->length, kiriVec2_Length(kiriVec2_Sub(sites[j].at, sites[i].at)), 1e-12);
            double outer = (IsOnOutline(a, width, height) ? OuterPart(link, a) : 0.0) +
                           (IsOnOutline(b, width, height) ? OuterPart(link, b) : 0.0);
            AssertNear(link->outer, outer, 1e-9);
            sum += length;
        }
    }
    for (int32_t k = 0; k < l->made.links.count; ++k) {
        found += l->made.links.data[k].width;
    }
    AssertNear(found, sum, 1e-5);
    return sum;
}

/* The sum over links of W l n n^T, and over stretches of the outline of their length times n (middle - site)^T, is the
   area times the unit matrix: the divergence of (p - site), region by region. So a sheet of such links bends alike in
   all directions. */
static void CheckIsotropy(const Links* l, const kiriSite* sites, int32_t count, double width, double height)
{
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (int32_t k = 0; k < l->made.links.count; ++k) {
        const kiriLink* link = &l->made.links.data[k];
        double area = link->width * link->length;
        xx += area * link->normal.x * link->normal.x;
        xy += area * link->normal.x * link->normal.y;
        yy += area * link->normal.y * link->normal.y;
    }
    for (int32_t i = 0; i < count; ++i) {
        Polygon polygon = NearestTo(sites, count, i, width, height);
        for (int32_t e = 0; e < polygon.count; ++e) {
            kiriVec2 a = polygon.at[e], b = polygon.at[(e + 1) % polygon.count];
            if (polygon.beyond[e] == KIRI_NONE) {
                kiriVec2 out = kiriVec2_Make(b.y - a.y, a.x - b.x);
                kiriVec2 arm = kiriVec2_Sub(kiriVec2_Scale(0.5, kiriVec2_Add(a, b)), sites[i].at);
                xx += out.x * arm.x;
                xy += out.x * arm.y;
                yy += out.y * arm.y;
            }
        }
    }
    double area = width * height;
    AssertNear(xx, area, 1e-5 * area);
    AssertNear(xy, 0.0, 1e-5 * area);
    AssertNear(yy, area, 1e-5 * area);
}

/* Sites in rows: 0: regular; 1: every second row shifted by half; 2: a slanted net, whose links along the long diagonal
   are shorter than a cell; 3: anywhere near a regular net. */
enum { NETS = 4 };
static kiriVec2 NetSite(int net, int i, int j, int n, uint32_t* seed)
{
    kiriVec2 p = { (i + 0.5) / n, (j + 0.5) / n };
    if (net == 1) {
        p.x += (j % 2 == 0 ? 0.25 : -0.25) / n;
    } else if (net == 2) {
        p.x += 0.03 * (j - 0.5 * n) / n;
    } else if (net == 3) {
        p = kiriVec2_Add(p, RandomVec2(seed, -0.3 / n, 0.3 / n));
    }
    return p;
}

static int32_t PlaceNet(const Scene* scene, int net, int n, uint32_t* seed, kiriSite* sites)
{
    for (int k = 0; k < n * n; ++k) {
        sites[k].at = NetSite(net, k % n, k / n, n, seed);
        sites[k].cell = Scene_Cell(scene, sites[k].at.x, sites[k].at.y);
    }
    return n * n;
}

/* On nets of 1.7 to 12 cells a spacing, of 4 to 12 where sites are anywhere, wherever in its cell a site is. */
TEST(BordersAreThoseOfVoronoi)
{
    enum { ROWS = 6, GRIDS = 7 };
    const int grids[GRIDS] = { 10, 11, 15, 24, 36, 48, 72 };
    uint32_t seed = 11;
    for (int net = 0; net < NETS; ++net) {
        double sum[GRIDS];
        uint32_t first = seed;
        for (int r = net == 3 ? 3 : 0; r < GRIDS; ++r) {
            SCOPED(Scene, scene, Scene_Release);
            Links links;
            kiriSite sites[ROWS * ROWS];
            seed = first;
            Scene_Init(&scene, 1.0, 1.0, 5, 5, grids[r]);
            Scene_BuildGrid(&scene);
            int32_t count = PlaceNet(&scene, net, ROWS, &seed, sites);
            Build(&scene, &links, sites, count);
            sum[r] = CheckVoronoi(&links, sites, count, 1.0, 1.0);
            CheckIsotropy(&links, sites, count, 1.0, 1.0);
            int32_t expected = net == 0 ? (ROWS - 1) * (ROWS - 1) : 2 * (ROWS - 1) * (ROWS - 1);
            assert_int_equal(links.made.corners.count, expected);
            for (int32_t k = 0; k < links.made.corners.count; ++k) {
                CheckCorner(&links, &links.made.corners.data[k]);
            }
            AssertNear(sum[r], sum[r < 3 ? r : 3], 1e-5);
        }
    }
}

/* What changes when one site moves through a cell, in steps of a fiftieth of it: the sizes of all links, between all
   pairs. The largest step is no jump: not much more than the mean of them. */
static void CheckContinuous(Scene* scene, kiriSite* sites, int32_t count, int32_t which, double most)
{
    enum { STEPS = 75, SIZES = 4 };
    double* was = calloc((size_t)(count * count * SIZES), sizeof(double));
    double* is = calloc((size_t)(count * count * SIZES), sizeof(double));
    double sum = 0.0, largest = 0.0;
    for (int step = 0; step <= STEPS; ++step) {
        Links links;
        double change = 0.0;
        sites[which].at = kiriVec2_Add(sites[which].at, kiriVec2_Make(scene->grid.side / 50, scene->grid.side / 83));
        sites[which].cell = Scene_Cell(scene, sites[which].at.x, sites[which].at.y);
        Build(scene, &links, sites, count);
        memset(is, 0, sizeof(double) * (size_t)(count * count * SIZES));
        for (int32_t k = 0; k < links.made.links.count; ++k) {
            const kiriLink* link = &links.made.links.data[k];
            double* size = &is[SIZES * (link->i * count + link->j)];
            size[0] += link->width;
            size[1] += link->outer;
            size[2] += link->width * link->length;
            size[3] += link->moment / (scene->grid.side * scene->grid.side);
        }
        for (int32_t k = 0; k < count * count * SIZES; ++k) {
            change += fabs(is[k] - was[k]);
            was[k] = is[k];
        }
        largest = step > 0 && change > largest ? change : largest;
        sum += step > 0 ? change : 0.0;
    }
    free(was);
    free(is);
    assert_true(sum > 0.0);
    if (largest > most * sum / STEPS) {
        fail_msg("site %d: the largest step is %g times the mean", which, largest * STEPS / sum);
    }
}

TEST(LinksAreContinuous)
{
    for (int net = 0; net < NETS; ++net) {
        enum { ROWS = 4 };
        uint32_t seed = 5;
        SCOPED(Scene, scene, Scene_Release);
        kiriSite sites[ROWS * ROWS];
        Scene_Init(&scene, 1.0, 1.0, 5, 5, 5 * ROWS);
        Scene_BuildGrid(&scene);
        int32_t count = PlaceNet(&scene, net, ROWS, &seed, sites);
        CheckContinuous(&scene, sites, count, 5, 4.0);
        CheckContinuous(&scene, sites, count, 1, 4.0);
    }
}

/* Beside slits: ways turn at their ends, and borders come to their sides. */
TEST(LinksAreContinuousBesideSlits)
{
    enum { ROWS = 4 };
    const int32_t moved[] = { 5, 6, 9, 13 };
    uint32_t seed = 5;
    SCOPED(Scene, scene, Scene_Release);
    kiriSite sites[ROWS * ROWS];
    Scene_Init(&scene, 1.0, 1.0, 20, 20, 6 * ROWS);
    Scene_Slit(&scene, 0.5, 0.0, 0.5, 0.65);
    Scene_Slit(&scene, 0.1, 0.75, 0.4, 0.75);
    Scene_BuildGrid(&scene);
    int32_t count = PlaceNet(&scene, 3, ROWS, &seed, sites);
    for (size_t k = 0; k < sizeof(moved) / sizeof(moved[0]); ++k) {
        kiriSite was = sites[moved[k]];
        CheckContinuous(&scene, sites, count, moved[k], 4.0);
        sites[moved[k]] = was;
    }
}

/* ---- Sight, and ways around slits ---- */

/* A sheet of one region: all squares may be looked at. */
typedef struct Plain {
    Scene scene;
    int32_t* owner;
    int32_t region;
    kiriSightEdges edges;
    kiriSight sight;
} Plain;

static void Plain_Start(Plain* p, double width, double height, int32_t columns, int32_t rows, int32_t resolution)
{
    memset(p, 0, sizeof(*p));
    Scene_Init(&p->scene, width, height, columns, rows, resolution);
}

static void Plain_Look(Plain* p)
{
    Scene_BuildGrid(&p->scene);
    p->owner = calloc((size_t)p->scene.grid.cells.count, sizeof(int32_t));
    p->sight = (kiriSight){ &p->scene.grid, p->owner, &p->region, 1, &p->edges };
    assert_true(kiriSightEdges_Start(&p->edges, &p->scene.mesh));
}

static void Plain_Stop(Plain* p)
{
    free(p->owner);
    Scene_Release(&p->scene);
}

static kiriVec2 At(double u, double v)
{
    return kiriVec2_Make(u, v);
}

static kiriTurns AllTurns(const Plain* p, kiriVec2 from, kiriVec2 to, double most)
{
    kiriTurns turns;
    kiriTurns_Start(&turns, from, to, most);
    for (int32_t c = 0; c < p->scene.grid.cells.count; ++c) {
        kiriTurns_AddAround(&turns, &p->sight, c);
    }
    return turns;
}

/* The length of the way, and its turns. */
static kiriWay WayOf(Plain* p, kiriVec2 from, kiriVec2 to)
{
    kiriTurns turns = AllTurns(p, from, to, 1e9);
    kiriWay way;
    assert_false(turns.isFull);
    assert_true(kiriWay_Find(&turns, &p->sight, &way));
    /* No corner is missed that is needed. */
    double length = way.length;
    turns = AllTurns(p, from, to, 1.0001 * length);
    assert_true(kiriWay_Find(&turns, &p->sight, &way));
    AssertNear(way.length, length, 0.0);
    return way;
}

TEST(SlitsStopTheSight)
{
    SCOPED(Plain, p, Plain_Stop);
    kiriSightHit hit;
    Plain_Start(&p, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&p.scene, 0.5, 0.0, 0.5, 0.8);
    Plain_Look(&p);
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.1, 0.3), At(0.9, 0.3), &hit), KIRI_SIGHT_EDGE);
    AssertNear(hit.share, 0.5, 1e-7);
    AssertNear(kiriMesh_Local(&p.scene.mesh, kiriMesh_HeadAt(&p.scene.mesh, hit.edge)).x, 0.5, 1e-7);
    assert_int_equal(kiriSight_EdgeBeside(&p.scene.mesh, kiriSight_EdgeBeside(&p.scene.mesh, hit.edge, true), false), hit.edge);
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.9, 0.1), At(0.3, 0.4), &hit), KIRI_SIGHT_EDGE);
    AssertNear(hit.share, 2.0 / 3.0, 1e-7);
    assert_true(kiriSight_IsClear(&p.sight, At(0.1, 0.9), At(0.9, 0.9)));
    /* Past the outline there is nothing; up to a lip, or along it, there is. */
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.1, 0.9), At(0.1, 1.5), &hit), KIRI_SIGHT_EDGE);
    AssertNear(hit.share, 1.0 / 6.0, 1e-7);
    assert_true(kiriSight_IsClear(&p.sight, At(0.1, 0.3), At(0.5, 0.3)));
    assert_true(kiriSight_IsClear(&p.sight, At(0.5, 0.05), At(0.5, 0.95)));
    /* A vertex of the slit stops the sight; its end does not. */
    assert_false(kiriSight_IsClear(&p.sight, At(0.1, 0.4), At(0.9, 0.4)));
    assert_true(kiriSight_IsClear(&p.sight, At(0.1, 0.8), At(0.9, 0.8)));
}

/* Against all edges of the mesh, one by one. */
TEST(SightIsThatOfAllEdges)
{
    uint32_t seed = 9;
    int32_t clear = 0, stopped = 0;
    for (int round = 0; round < 40; ++round) {
        SCOPED(Plain, p, Plain_Stop);
        memset(&p, 0, sizeof(p));
        Scene_InitMesh(&p.scene, 1.0, 1.0, 9, 9, 4 + (int32_t)(Random(&seed) % 30), 0.25, seed);
        Scene_CutAtRandom(&p.scene, 6, 8, &seed);
        Plain_Look(&p);
        for (int k = 0; k < 100; ++k) {
            kiriVec2 a = RandomVec2(&seed, 0.001, 0.999), b = RandomVec2(&seed, 0.001, 0.999);
            kiriVec2 way = kiriVec2_Sub(b, a);
            double nearest = 2.0;
            for (int32_t h = 0; h < 3 * p.scene.mesh.triangles.count; ++h) {
                if (kiriMesh_Twin(&p.scene.mesh, h) == KIRI_NONE || kiriMesh_IsOpen(&p.scene.mesh, h)) {
                    int32_t next = kiriMesh_Tail(&p.scene.mesh, kiriEdge_Next(h));
                    kiriVec2 q =
                        kiriMesh_Local(&p.scene.mesh, p.scene.mesh.vertices.data[kiriMesh_Tail(&p.scene.mesh, h)].at);
                    kiriVec2 e = kiriVec2_Sub(kiriMesh_Local(&p.scene.mesh, p.scene.mesh.vertices.data[next].at), q);
                    kiriVec2 o = kiriVec2_Sub(q, a);
                    double det = way.x * e.y - way.y * e.x;
                    double t = (o.x * e.y - o.y * e.x) / det, s = (o.x * way.y - o.y * way.x) / det;
                    nearest = s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0 && t < nearest ? t : nearest;
                }
            }
            kiriSightHit hit;
            kiriSightEnd end = kiriSight_Cast(&p.sight, a, b, &hit);
            assert_int_equal(end, nearest <= 1.0 ? KIRI_SIGHT_EDGE : KIRI_SIGHT_CLEAR);
            AssertNear(hit.share, nearest <= 1.0 ? nearest : 1.0, 1e-9);
            clear += end == KIRI_SIGHT_CLEAR;
            stopped += end == KIRI_SIGHT_EDGE;
        }
    }
    assert_true(clear > 500 && stopped > 500);
}

TEST(WaysTurnAtSlitEnds)
{
    SCOPED(Plain, p, Plain_Stop);
    Plain_Start(&p, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&p.scene, 0.3, 0.0, 0.3, 0.8);
    Scene_Slit(&p.scene, 0.7, 0.2, 0.7, 1.0);
    Plain_Look(&p);
    kiriWay way = WayOf(&p, At(0.1, 0.9), At(0.5, 0.9));
    assert_int_equal(way.turnCount, 0);
    AssertNear(way.length, 0.4, 1e-12);
    way = WayOf(&p, At(0.1, 0.2), At(0.5, 0.6));
    double first = sqrt(0.04 + 0.36), second = sqrt(0.04 + 0.04);
    assert_int_equal(way.turnCount, 1);
    AssertNear(way.turn[0].x, 0.3, 1e-7);
    AssertNear(way.turn[0].y, 0.8, 1e-7);
    AssertNear(way.length, first + second, 1e-7);
    kiriVec2 half = kiriWay_At(&way, At(0.1, 0.2), At(0.5, 0.6), first + 0.5 * second);
    AssertNear(half.x, 0.4, 1e-7);
    AssertNear(half.y, 0.7, 1e-7);
    way = WayOf(&p, At(0.1, 0.1), At(0.9, 0.9));
    assert_int_equal(way.turnCount, 2);
    AssertNear(way.length, 2.0 * sqrt(0.04 + 0.49) + sqrt(0.16 + 0.36), 1e-7);
}

/* A slit of two legs: its knee is a corner on one side only. From the hollow side no way turns there, and none slips
   through it. */
TEST(NoWayThroughAKnee)
{
    SCOPED(Plain, p, Plain_Stop);
    Plain_Start(&p, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&p.scene, 0.5, 0.2, 0.5, 0.5);
    Scene_Slit(&p.scene, 0.5, 0.5, 0.8, 0.5);
    Plain_Look(&p);
    kiriWay way = WayOf(&p, At(0.45, 0.6), At(0.6, 0.4));
    assert_true(way.turnCount >= 1);
    double left = sqrt(0.05 * 0.05 + 0.1 * 0.1) + 0.3 + sqrt(0.1 * 0.1 + 0.2 * 0.2);
    double right = sqrt(0.35 * 0.35 + 0.1 * 0.1) + sqrt(0.2 * 0.2 + 0.1 * 0.1);
    AssertNear(way.length, left < right ? left : right, 1e-6);
    way = WayOf(&p, At(0.4, 0.3), At(0.6, 0.7));
    assert_int_equal(way.turnCount, 0); /* past the knee, outside */
    way = WayOf(&p, At(0.48, 0.3), At(0.7, 0.52));
    assert_int_equal(way.turnCount, 1); /* around it */
    AssertNear(way.turn[0].x, 0.5, 1e-7);
    AssertNear(way.turn[0].y, 0.5, 1e-7);
}
