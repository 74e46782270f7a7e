#include "follow.h"

typedef struct Links {
    kiriRegions regions;
    kiriShape shape;
    kiriLinks made;
} Links;

static void Build(Scene* scene, Links* l, const kiriSite* sites, int32_t count)
{
    kiriSiteMove* moves = malloc(sizeof(kiriSiteMove) * (size_t)(count + 1));
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    for (int32_t i = 0; i < count; ++i) {
        moves[i] = (kiriSiteMove){ i, KIRI_NONE };
    }
    memset(l, 0, sizeof(*l));
    assert_int_equal(
        kiriRegions_Update(&l->regions, &scene->memory, &scene->grid, &scene->mesh, sites, count, moves, count, &quota),
        KIRI_DONE);
    assert_int_equal(kiriShape_Update(&l->shape, &scene->memory, &scene->grid, &scene->mesh, &l->regions, sites, count,
                                      moves, count, &quota),
                     KIRI_DONE);
    assert_int_equal(
        kiriLinks_Update(&l->made, &scene->memory, &scene->grid, &scene->mesh, &l->regions, sites, count, &quota),
        KIRI_DONE);
    assert_int_equal(l->made.links.count, 0);
    assert_int_equal(l->made.changed, l->made.next.count);
    kiriLinks_Commit(&l->made);
    free(moves);
}

static int32_t OwnerOf(const Links* l, int32_t cell)
{
    return l->regions.field.owner.data[cell];
}

static void StripHasStraightLinks(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    kiriSite sites[5];
    Scene_Init(&scene, 1.0, 0.25, 8, 2, 36);
    Scene_BuildGrid(&scene);
    for (int i = 0; i < 5; ++i) {
        sites[i] = Scene_Site(&scene, (4.5 + 7 * i) / 36, 0.125);
    }
    Build(&scene, &links, sites, 5);
    assert_int_equal(links.made.links.count, 4);
    assert_int_equal(links.made.corners.count, 0);
    for (int k = 0; k < 4; ++k) {
        const kiriLink* link = &links.made.links.data[k];
        assert_int_equal(link->i, k);
        assert_int_equal(link->j, k + 1);
        AssertNear(link->width, 0.25, 1e-12);
        AssertNear(link->length, 7.0 * scene.grid.side, 1e-12);
        AssertNear(link->moment, 0.25 * 0.25 * 0.25 / 12.0, 1e-12);
        AssertNear(link->normal.x, 1.0, 0.0);
        AssertNear(link->normal.y, 0.0, 0.0);
        AssertNear(link->tangent.y, 1.0, 0.0);
        AssertNear(link->centroid.x, (8 + 7 * k) * scene.grid.side, 1e-6);
        AssertNear(link->centroid.y, 0.125, 1e-12);
        AssertNear(link->crossing.x, 0.5 * (sites[k].at.x + sites[k + 1].at.x), 1e-12);
        AssertNear(link->crossing.y, sites[k].at.y, 1e-12);
        AssertNear(link->span.x, 7.0 * scene.grid.side, 1e-12);
        AssertNear(link->span.y, 0.0, 1e-12);
        AssertNear(link->outer, link->width, 0.0);
    }
    Scene_Release(&scene);
}

/* Sixteen square regions: borders of those at the outline are open at one end. */
static void OuterEndsAreOpen(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    kiriSite sites[16];
    Scene_Init(&scene, 1.0, 1.0, 4, 4, 36);
    Scene_BuildGrid(&scene);
    for (int i = 0; i < 16; ++i) {
        sites[i] = Scene_Site(&scene, (4.5 + 9 * (i % 4)) / 36, (4.5 + 9 * (i / 4)) / 36);
    }
    Build(&scene, &links, sites, 16);
    assert_int_equal(links.made.links.count, 24);
    for (int k = 0; k < 24; ++k) {
        const kiriLink* link = &links.made.links.data[k];
        int line = link->j - link->i == 1 ? link->i / 4 : link->i % 4; /* of regions, that the link lies in */
        AssertNear(link->outer, line == 0 || line == 3 ? 0.125 : 0.0, 1e-7);
    }
    assert_int_equal(links.made.corners.count, 9);
    Scene_Release(&scene);
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
static void CornersOfShiftedRows(void** state)
{
    (void)state;
    Scene scene;
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
    Scene_Release(&scene);
}

/* The same border, crossed from right to left: the link is seen from the lower index. */
static void NormalPointsToTheHigherIndex(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 0.25, 8, 2, 36);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.8, 0.1), Scene_Site(&scene, 0.2, 0.1) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 1);
    AssertNear(links.made.links.data[0].normal.x, -1.0, 0.0);
    AssertNear(links.made.links.data[0].tangent.y, -1.0, 0.0);
    AssertNear(links.made.links.data[0].width, 0.25, 1e-12);
    Scene_Release(&scene);
}

static void SlitMakesTheLongWay(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&scene, 0.5, 0.0, 0.5, 0.8);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.25, 0.25), Scene_Site(&scene, 0.75, 0.25) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 1);
    const kiriLink* link = &links.made.links.data[0];
    double across = 0.5 * (sites[1].at.x - sites[0].at.x), up = 0.8 - sites[0].at.y;
    double way = 2.0 * sqrt(across * across + up * up);
    AssertNear(link->length, way, 1e-6);
    AssertNear(link->crossing.x, 0.5, 1e-6);
    AssertNear(link->crossing.y, 0.8, 1e-6);
    AssertNear(link->width, 0.2, 2e-6);
    AssertNear(link->outer, link->width, 0.0);
    Scene_Release(&scene);
}

static void CompleteCutHasNoLink(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&scene, 0.5, 0.0, 0.5, 1.0);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.25, 0.25), Scene_Site(&scene, 0.75, 0.25) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 0);
    Build(&scene, &links, sites, 1);
    assert_int_equal(OwnerOf(&links, sites[1].cell), KIRI_NONE);
    Scene_Release(&scene);
}

static void HoleMakesTwoStretches(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 0.5, 10, 5, 41);
    Scene_Slit(&scene, 0.4, 0.2, 0.6, 0.2);
    Scene_Slit(&scene, 0.6, 0.2, 0.6, 0.4);
    Scene_Slit(&scene, 0.6, 0.4, 0.4, 0.4);
    Scene_Slit(&scene, 0.4, 0.4, 0.4, 0.2);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.25, 0.25), Scene_Site(&scene, 0.75, 0.25) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 2);
    for (int k = 0; k < 2; ++k) {
        const kiriLink* link = &links.made.links.data[k];
        assert_int_equal(link->i, 0);
        assert_int_equal(link->j, 1);
        AssertNear(link->width, k == 0 ? 0.2 : 0.1, 1e-6);
        AssertNear(link->moment, link->width * link->width * link->width / 12.0, 1e-9);
        AssertNear(link->centroid.y, k == 0 ? 0.1 : 0.45, 1e-6);
    }
    /* Over the hole it is a longer way than under it, and one that passes by a corner of the hole. */
    assert_true(links.made.links.data[1].length > links.made.links.data[0].length);
    AssertNear(links.made.links.data[1].crossing.y, 0.41, 0.02);
    Scene_Release(&scene);
}

static void DiagonalBorderHasItsTrueLength(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 1.0, 4, 4, 41);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 10.5 / 41, 10.5 / 41), Scene_Site(&scene, 30.5 / 41, 30.5 / 41) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 1);
    const kiriLink* link = &links.made.links.data[0];
    double width = sqrt(2.0);
    AssertNear(link->width, width, 1e-6);
    AssertNear(link->normal.x, sqrt(0.5), 1e-9);
    AssertNear(link->normal.y, sqrt(0.5), 1e-9);
    AssertNear(link->centroid.x, 0.5, 1e-6);
    AssertNear(link->centroid.y, 0.5, 1e-6);
    AssertNear(link->moment, width * width * width / 12.0, 1e-6);
    AssertNear(link->length, 20.0 * sqrt(2.0) * scene.grid.side, 1e-12);
    AssertNear(link->crossing.x, 20.5 * scene.grid.side, 1e-6);
    Scene_Release(&scene);
}

/* The nearest neighbours on a diagonal: a way over faces alone would be half as long again. */
static void ShortDiagonalIsStraight(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 1.0, 4, 4, 8);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.3, 0.3), Scene_Site(&scene, 0.55, 0.55) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 1);
    AssertNear(links.made.links.data[0].length, 2.0 * sqrt(2.0) * scene.grid.side, 1e-12);
    AssertNear(links.made.links.data[0].crossing.x, 0.5 * (sites[0].at.x + sites[1].at.x), 1e-12);
    Scene_Release(&scene);
}

/* Frame 0 sits at the bottom of a corridor, and frame 1 before its mouth, hardly farther from it: the border turns back
   around the mouth and runs along the corridor on both sides. */
static void BentBorderIsSplit(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 1.0, 20, 20, 41);
    Scene_Slit(&scene, 0.0, 0.45, 0.4, 0.45);
    Scene_Slit(&scene, 0.0, 0.55, 0.4, 0.55);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.01, 0.5), Scene_Site(&scene, 0.85, 0.5) };
    Build(&scene, &links, sites, 2);
    assert_true(links.made.links.count >= 3);
    double total = 0.0, expected = 0.0;
    kiriVec2 vector = { 0.0, 0.0 };
    for (int32_t k = 0; k < links.made.links.count; ++k) {
        const kiriLink* link = &links.made.links.data[k];
        assert_true(link->width > 0.0);
        assert_true(fabs(link->normal.x) == 1.0 || fabs(link->normal.y) == 1.0);
        total += link->width;
        vector = kiriVec2_Add(vector, kiriVec2_Scale(link->width, link->normal));
    }
    for (int32_t f = 0; f < scene.grid.faces.count; ++f) {
        const kiriFace* face = &scene.grid.faces.data[f];
        double width = kiriGrid_Stretch(&scene.grid, &scene.mesh, f).width;
        expected += OwnerOf(&links, face->cell[0]) != OwnerOf(&links, face->cell[1]) ? width : 0.0;
    }
    AssertNear(total, expected, 1e-12);
    assert_true(kiriVec2_Length(vector) < 0.5 * total);
    Scene_Release(&scene);
}

/* Width, centroid and second moment of a link between partly covered squares, where the faces are no whole sides. */
static void PartialFacesCount(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 0.13, 7, 1, 10);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 0.25, 0.05), Scene_Site(&scene, 0.75, 0.05) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 1);
    AssertNear(links.made.links.data[0].width, 0.13, 1e-7);
    AssertNear(links.made.links.data[0].centroid.y, 0.065, 1e-7);
    AssertNear(links.made.links.data[0].moment, 0.13 * 0.13 * 0.13 / 12.0, 1e-9);
    Scene_Release(&scene);
}

static int32_t RootOf(const int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        i = parent[i];
    }
    return i;
}

/* Links join the regions that faces join, and no others. */
static void CheckPieces(const Scene* scene, const Links* l, int32_t n)
{
    int32_t* parent[2];
    for (int k = 0; k < 2; ++k) {
        parent[k] = malloc(sizeof(int32_t) * (size_t)n);
        for (int32_t i = 0; i < n; ++i) {
            parent[k][i] = i;
        }
    }
    for (int32_t k = 0; k < l->made.links.count; ++k) {
        parent[0][RootOf(parent[0], l->made.links.data[k].i)] = RootOf(parent[0], l->made.links.data[k].j);
    }
    for (int32_t f = 0; f < scene->grid.faces.count; ++f) {
        const kiriFace* face = &scene->grid.faces.data[f];
        parent[1][RootOf(parent[1], OwnerOf(l, face->cell[0]))] = RootOf(parent[1], OwnerOf(l, face->cell[1]));
    }
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            assert_int_equal(RootOf(parent[0], i) == RootOf(parent[0], j),
                             RootOf(parent[1], i) == RootOf(parent[1], j));
        }
    }
    free(parent[0]);
    free(parent[1]);
}

/* What holds for every link: the order, axes, sizes that make sense. */
static void CheckLink(const Links* l, const kiriSite* sites, double side, int32_t k)
{
    const kiriLink* link = &l->made.links.data[k];
    const kiriLink* before = k > 0 ? link - 1 : NULL;
    kiriVec2 straight = kiriVec2_Sub(sites[link->j].at, sites[link->i].at);
    assert_true(link->i < link->j);
    assert_true(before == NULL || before->i < link->i || (before->i == link->i && before->j <= link->j));
    assert_true(link->width > 0.0);
    assert_true(link->outer >= 0.0 && link->outer <= link->width);
    assert_true(link->moment >= 0.0);
    assert_true(link->length >= kiriVec2_Length(straight) - 1e-12);
    assert_true(link->length < 3.0); /* of a sheet of length 1 */
    assert_true(link->length >= 0.1 * side - 1e-12);
    AssertNear(kiriVec2_Length(link->normal), 1.0, 1e-12);
    AssertNear(link->tangent.x, -link->normal.y, 1e-14);
    AssertNear(link->tangent.y, link->normal.x, 1e-14);
}

/* On randomly cut sheets: links are in order, no shorter than the straight line, and join what hangs together; and
   their borders are those of the grid, pair by pair, but for three squares at each end. */
static void RandomSheetsAddUp(void** state)
{
    (void)state;
    uint32_t seed = 3;
    int32_t found = 0, corners = 0;
    for (int round = 0; round < 150; ++round) {
        Scene scene;
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
            double full = kiriGrid_Stretch(&scene.grid, &scene.mesh, f).width, width = a < b ? full : -full;
            if (a != b) {
                kiriVec2* sum = &sums[a < b ? a * n + b : b * n + a];
                sum->x += kiriFace_Axis(face) == 0 ? width : 0.0;
                sum->y += kiriFace_Axis(face) == 1 ? width : 0.0;
            }
        }
        for (int32_t k = 0; k < links.made.links.count; ++k) {
            const kiriLink* link = &links.made.links.data[k];
            CheckLink(&links, sites.data, scene.grid.side, k);
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
        CheckPieces(&scene, &links, n);
        found += links.made.links.count;
        corners += links.made.corners.count;
        free(sums);
        free(counts);
        kiriArray_Release(&scene.memory, &sites);
        Scene_Release(&scene);
    }
    assert_true(found > 1000);
    assert_true(corners > 200);
}

/* A slit that ends at the border parts the border, though the squares before it are whole. */
static void SlitAcrossTheBorderPartsIt(void** state)
{
    (void)state;
    Scene scene;
    Links links;
    Scene_Init(&scene, 1.0, 0.5, 10, 2, 41);
    Scene_Slit(&scene, 0.5, 0.25, 0.7, 0.25);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 10.5 / 41, 0.25), Scene_Site(&scene, 30.5 / 41, 0.25) };
    Build(&scene, &links, sites, 2);
    assert_int_equal(links.made.links.count, 2);
    for (int k = 0; k < 2; ++k) {
        AssertNear(links.made.links.data[k].width, 0.25, 1e-6);
        AssertNear(links.made.links.data[k].centroid.y, k == 0 ? 0.125 : 0.375, 1e-6);
    }
    Scene_Release(&scene);
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

/* On nets of 4, 6, 8 and 12 cells a spacing, wherever in its cell a site is. */
static void BordersAreThoseOfVoronoi(void** state)
{
    (void)state;
    const int perSpacing[4] = { 4, 6, 8, 12 };
    uint32_t seed = 11;
    for (int net = 0; net < NETS; ++net) {
        double sum[4];
        uint32_t first = seed;
        for (int r = 0; r < 4; ++r) {
            enum { ROWS = 6 };
            Scene scene;
            Links links;
            kiriSite sites[ROWS * ROWS];
            seed = first;
            Scene_Init(&scene, 1.0, 1.0, 5, 5, ROWS * perSpacing[r]);
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
            AssertNear(sum[r], sum[0], 1e-5);
            Scene_Release(&scene);
        }
    }
}

/* One row of frames hardly farther apart than the cells of the grid. */
static void RowOnACoarseGrid(void** state)
{
    (void)state;
    for (int32_t n = 25; n <= 37; n += 4) {
        Scene scene;
        Links links;
        kiriSite sites[37];
        Scene_Init(&scene, 1.0, 0.1, 40, 4, 40);
        Scene_BuildGrid(&scene);
        for (int32_t i = 0; i < n; ++i) {
            double u = (double)i / (n - 1);
            sites[i].at = kiriVec2_Make(i == 0 ? 1e-4 : i == n - 1 ? 1.0 - 1e-4 : u, 0.05);
            sites[i].cell = Scene_Cell(&scene, sites[i].at.x, sites[i].at.y);
        }
        Build(&scene, &links, sites, n);
        assert_int_equal(links.made.links.count, n - 1);
        for (int32_t k = 0; k < n - 1; ++k) {
            const kiriLink* link = &links.made.links.data[k];
            AssertNear(link->width, 0.1, 1e-8);
            AssertNear(link->outer, 0.1, 1e-8);
            AssertNear(link->length, sites[k + 1].at.x - sites[k].at.x, 1e-12);
            AssertNear(link->normal.x, 1.0, 1e-12);
            AssertNear(link->moment, 1e-3 / 12.0, 1e-9);
        }
        Scene_Release(&scene);
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

static void LinksAreContinuous(void** state)
{
    (void)state;
    for (int net = 0; net < NETS; ++net) {
        enum { ROWS = 4 };
        uint32_t seed = 5;
        Scene scene;
        kiriSite sites[ROWS * ROWS];
        Scene_Init(&scene, 1.0, 1.0, 5, 5, 5 * ROWS);
        Scene_BuildGrid(&scene);
        int32_t count = PlaceNet(&scene, net, ROWS, &seed, sites);
        CheckContinuous(&scene, sites, count, 5, 4.0);
        CheckContinuous(&scene, sites, count, 1, 4.0);
        Scene_Release(&scene);
    }
}

/* ---- Following cuts ---------------------------------------------------------------------------------------------- */

/* A link is the same bits as before where neither region is dirty, and as one from scratch everywhere. */
static void CutSheetsEqualThoseFromScratch(void** state)
{
    (void)state;
    int64_t all = 0, changed = 0;
    for (uint32_t round = 0; round < 40; ++round) {
        uint32_t seed = 29 + 7919 * round;
        Scene scene;
        Follow f, scratch;
        Wander wander;
        memset(&wander, 0, sizeof(wander));
        Scene_InitMesh(&scene, 1.0, RandomBetween(&seed, 0.3, 1.0), 7, 6, 3 + (int32_t)(Random(&seed) % 28), 0.2, seed);
        Scene_CutAtRandom(&scene, (int32_t)(Random(&seed) % 4), 8, &seed);
        kiriMesh_Commit(&scene.mesh);
        Follow_Start(&f, &scene, 1 + (int32_t)(Random(&seed) % 24), 0, &seed);
        double length = RandomBetween(&seed, 0.3, 2.5) * f.grid.side;
        for (int step = 0; step < 30; ++step) {
            Wander_Cut(&wander, &f, length, &seed);
            Follow_Weights(&f, &seed);
            assert_true(Follow_Links(&f));
            all += f.links.next.count;
            changed += f.links.changed;
            Follow_Commit(&f);
            kiriSquares_ClearDirty(&scene.mesh.squares);
            Follow_ScratchWeights(&scratch, &f);
            assert_true(Follow_Links(&scratch));
            Follow_Commit(&scratch);
            Follow_CompareLinks(&f, &scratch);
            Follow_Release(&scratch);
        }
        Follow_Release(&f);
        Scene_Release(&scene);
    }
    assert_true(all > 10000);
    assert_true(2 * changed < all);
}

/* Wherever memory fails the links are as before, and the next update makes them. */
static void FailingAllocatorLeaksNothing(void** state)
{
    (void)state;
    int32_t failures = 0;
    bool done = false;
    for (int64_t budget = 0; !done; ++budget) {
        uint32_t seed = 5;
        Scene scene;
        Follow f, scratch;
        Wander wander;
        memset(&wander, 0, sizeof(wander));
        Scene_InitMesh(&scene, 1.0, 0.8, 5, 4, 16, 0.2, seed);
        kiriMesh_Commit(&scene.mesh);
        Follow_Init(&f, &scene);
        Follow_Grid(&f);
        for (int32_t k = 0; k < 14; ++k) {
            Follow_AddSite(&f, &seed);
        }
        Follow_AllRegions(&f);
        assert_int_equal(Follow_Shape(&f), KIRI_DONE);
        for (int step = 0; step < 2; ++step) {
            kiriLinks was = f.links;
            scene.purse.budget = budget;
            done = Follow_Links(&f);
            scene.purse.budget = -1;
            if (!done) {
                ++failures;
                assert_ptr_equal(f.links.links.data, was.links.data);
                assert_int_equal(f.links.links.count, was.links.count);
                assert_true(Follow_Links(&f));
            }
            Follow_Commit(&f);
            Follow_ScratchWeights(&scratch, &f);
            assert_true(Follow_Links(&scratch));
            Follow_Commit(&scratch);
            Follow_CompareLinks(&f, &scratch);
            Follow_Release(&scratch);
            for (int cut = 0; cut < 9; ++cut) {
                kiriMesh_Begin(f.mesh);
                kiriQuota quota = { INT64_MAX, 0, 0, false };
                kiriBladeTip blade = kiriCut_Place(f.mesh, kiriVec2_Make(0.1 * cut, 0.2));
                kiriLatticePoint to = kiriMesh_Snap(f.mesh, kiriVec2_Make(0.1 * cut + 0.05, 0.5));
                assert_int_equal(kiriCut_Move(f.mesh, &blade, to, 16.0, &quota), KIRI_DONE);
                kiriMesh_Commit(f.mesh);
            }
            Follow_Weights(&f, &seed);
        }
        Follow_Release(&f);
        Scene_Release(&scene);
        assert_true(budget < 500);
    }
    assert_true(failures > 4);
}

/* Beside slits: ways turn at their ends, and borders come to their sides. */
static void LinksAreContinuousBesideSlits(void** state)
{
    (void)state;
    enum { ROWS = 4 };
    const int32_t moved[] = { 5, 6, 9, 13 };
    uint32_t seed = 5;
    Scene scene;
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
    Scene_Release(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(StripHasStraightLinks),
        cmocka_unit_test(OuterEndsAreOpen),
        cmocka_unit_test(CornersOfShiftedRows),
        cmocka_unit_test(NormalPointsToTheHigherIndex),
        cmocka_unit_test(SlitMakesTheLongWay),
        cmocka_unit_test(CompleteCutHasNoLink),
        cmocka_unit_test(HoleMakesTwoStretches),
        cmocka_unit_test(DiagonalBorderHasItsTrueLength),
        cmocka_unit_test(ShortDiagonalIsStraight),
        cmocka_unit_test(BentBorderIsSplit),
        cmocka_unit_test(PartialFacesCount),
        cmocka_unit_test(RandomSheetsAddUp),
        cmocka_unit_test(SlitAcrossTheBorderPartsIt),
        cmocka_unit_test(BordersAreThoseOfVoronoi),
        cmocka_unit_test(RowOnACoarseGrid),
        cmocka_unit_test(LinksAreContinuous),
        cmocka_unit_test(LinksAreContinuousBesideSlits),
        cmocka_unit_test(CutSheetsEqualThoseFromScratch),
        cmocka_unit_test(FailingAllocatorLeaksNothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
