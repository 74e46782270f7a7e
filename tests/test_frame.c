#include "scene.h"

/* ---- What placing must come to, computed plainly ------------------------------------------------------------- */

enum { AWAY = 1 << 28, MOST = 100, MOST_ENDS = 3 };

typedef struct Plain {
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    int32_t* cells; /* the part, sorted */
    int32_t count;
    int32_t* holds;       /* of each cell: site, or KIRI_NONE */
    int64_t* distance;    /* of each site and cell */
    kiriSite sites[MOST]; /* old ones first */
    int32_t siteCount, oldCount;
    kiriSlitEnd ends[MOST_ENDS];
    int32_t endCount;
    double reach, closeness; /* around them; reach 0: none */
    int64_t* closer;         /* of each cell, in 16ths */
} Plain;

static int64_t* DistanceOf(const Plain* p, int32_t site, int32_t cell)
{
    return &p->distance[(int64_t)site * p->grid->cells.count + cell];
}

/* Bellman and Ford's distances from one site, whose seeds keep away from the cells of sites before `minded`. */
static void Measure(Plain* p, int32_t site, int32_t minded)
{
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriSeeds seeds = { 0 };
    for (int32_t k = 0; k < p->count; ++k) {
        *DistanceOf(p, site, p->cells[k]) = AWAY;
    }
    assert_true(kiriSite_Seed(&p->sites[site], site, &memory, p->grid, p->mesh, &seeds));
    for (int32_t k = 0; k < seeds.count; ++k) {
        bool taken = false;
        for (int32_t i = 0; i < minded; ++i) {
            taken = taken || (i != site && p->sites[i].cell == seeds.data[k].cell);
        }
        if (!taken) {
            *DistanceOf(p, site, seeds.data[k].cell) = seeds.data[k].distance;
        }
    }
    kiriArray_Release(&memory, &seeds);
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t k = 0; k < p->count; ++k) {
            int32_t cell = p->cells[k];
            kiriSteps steps;
            kiriGrid_GetSteps(p->grid, cell, &steps);
            for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
                kiriStep step = steps.data[s];
                if (*DistanceOf(p, site, cell) + step.length < *DistanceOf(p, site, step.cell)) {
                    *DistanceOf(p, site, step.cell) = *DistanceOf(p, site, cell) + step.length;
                    changed = true;
                }
            }
        }
    }
}

/* How much closer sites are: by Bellman and Ford's distances from the slit ends. */
static void MeasureCloseness(Plain* p)
{
    int64_t* distance = p->closer;
    for (int32_t k = 0; k < p->count; ++k) {
        distance[p->cells[k]] = AWAY;
    }
    for (int32_t k = 0; k < p->endCount; ++k) {
        distance[p->ends[k].cell] = 0;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t k = 0; k < p->count; ++k) {
            kiriSteps steps;
            kiriGrid_GetSteps(p->grid, p->cells[k], &steps);
            for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
                kiriStep step = steps.data[s];
                bool nearer = distance[p->cells[k]] + step.length < distance[step.cell];
                distance[step.cell] = nearer ? distance[p->cells[k]] + step.length : distance[step.cell];
                changed = changed || nearer;
            }
        }
    }
    int64_t reach = p->endCount > 0 ? (int64_t)(16 * 256 * (p->reach / p->grid->side)) : 0;
    int64_t most = reach > 0 ? (int64_t)(16.0 * p->closeness + 0.5) : 16;
    for (int32_t k = 0; k < p->count; ++k) {
        int64_t d = distance[p->cells[k]], closer = reach > 0 && d == 0 ? most : reach > 0 ? reach / d : 16;
        p->closer[p->cells[k]] = closer < 16 ? 16 : closer < most ? closer : most;
    }
}

static bool IsMostly(const Plain* p, int32_t cell)
{
    return kiriGrid_Area(p->grid, cell) > 0.5 * p->grid->side * p->grid->side;
}

/* The first of the best free cells: farthest, then mostly covered. */
static int32_t PlainFarthest(const Plain* p, const uint8_t* allowed)
{
    int32_t best = KIRI_NONE;
    int64_t bestDistance = -1;
    for (int32_t k = 0; k < p->count; ++k) {
        int32_t c = p->cells[k];
        int64_t distance = AWAY;
        bool isFree = allowed == NULL || allowed[c];
        for (int32_t i = 0; i < p->siteCount; ++i) {
            isFree = isFree && p->sites[i].cell != c;
            distance = *DistanceOf(p, i, c) < distance ? *DistanceOf(p, i, c) : distance;
        }
        distance *= p->closer[c];
        if (isFree && (distance > bestDistance || (distance == bestDistance && IsMostly(p, c) && !IsMostly(p, best)))) {
            best = c;
            bestDistance = distance;
        }
    }
    return best;
}

static int32_t PlainOwner(const Plain* p, int32_t cell)
{
    int32_t owner = 0;
    for (int32_t i = 0; i < p->siteCount; ++i) {
        if (p->sites[i].cell == cell) {
            return i;
        }
        owner = *DistanceOf(p, i, cell) < *DistanceOf(p, owner, cell) ? i : owner;
    }
    return owner;
}

/* The centroid of a site's region (all of the part: KIRI_NONE), and its cell nearest to it that is allowed. */
static int32_t PlainTarget(const Plain* p, int32_t site, const uint8_t* allowed, kiriVec2* center)
{
    const double side = p->grid->side;
    int64_t area = 0, u = 0, v = 0;
    for (int32_t k = 0; k < p->count; ++k) {
        if (site == KIRI_NONE || PlainOwner(p, p->cells[k]) == site) {
            kiriMoments m = kiriGrid_Material(p->grid, p->mesh, p->cells[k]);
            int64_t share = (int64_t)(16777216.0 * (m.area / (side * side)) + 0.5);
            int64_t closer = site == KIRI_NONE ? 16 : p->closer[p->cells[k]];
            share = (share > 0 ? share : 1) * (closer * closer * closer * closer / 65536);
            area += share;
            u += (int64_t)((double)share / (m.area * side) * m.u + 0.5);
            v += (int64_t)((double)share / (m.area * side) * m.v + 0.5);
        }
    }
    *center = kiriVec2_Scale(side / (double)area, kiriVec2_Make((double)u, (double)v));
    int32_t best = KIRI_NONE;
    double nearest = 0.0;
    for (int32_t k = 0; k < p->count; ++k) {
        int32_t c = p->cells[k];
        if ((site == KIRI_NONE || PlainOwner(p, c) == site) && (allowed == NULL || allowed[c])) {
            kiriVec2 off = kiriVec2_Sub(kiriGrid_Middle(p->grid, p->mesh, c), *center);
            double distance = kiriVec2_Dot(off, off);
            if (best == KIRI_NONE || distance < nearest ||
                (distance == nearest && IsMostly(p, c) && !IsMostly(p, best))) {
                best = c;
                nearest = distance;
            }
        }
    }
    return best;
}

/* One round of Lloyd's; did a site move? */
static bool PlainRound(Plain* p)
{
    kiriSite next[MOST];
    bool moved = false;
    for (int32_t i = p->oldCount; i < p->siteCount; ++i) {
        Measure(p, i, p->siteCount);
    }
    for (int32_t i = p->oldCount; i < p->siteCount; ++i) {
        kiriVec2 center;
        int32_t cell = PlainTarget(p, i, NULL, &center);
        kiriVec2 middle = kiriGrid_Middle(p->grid, p->mesh, cell);
        next[i] = kiriFrames_SiteIn(p->grid, p->mesh, cell);
        if (fabs(center.x - middle.x) < 0.5 * p->grid->side && fabs(center.y - middle.y) < 0.5 * p->grid->side) {
            next[i].at = center;
        }
        kiriVec2 way = kiriVec2_Sub(next[i].at, p->sites[i].at);
        moved = moved || kiriVec2_Dot(way, way) > 0.0001 * p->grid->side * p->grid->side;
    }
    for (int32_t i = p->oldCount; i < p->siteCount; ++i) {
        p->sites[i] = next[i];
    }
    return moved;
}

static void PlainPlace(Plain* p, const uint8_t* allowed, int32_t count)
{
    if (p->oldCount == 0 && count == 1) {
        kiriVec2 center;
        int32_t cell = PlainTarget(p, KIRI_NONE, allowed, &center);
        if (cell != KIRI_NONE) {
            p->sites[p->siteCount++] = kiriFrames_SiteIn(p->grid, p->mesh, cell);
        }
        return;
    }
    MeasureCloseness(p);
    for (int32_t i = 0; i < p->oldCount; ++i) {
        Measure(p, i, p->oldCount);
    }
    for (int32_t k = 0; k < count; ++k) {
        int32_t cell = PlainFarthest(p, allowed);
        if (cell == KIRI_NONE) {
            break;
        }
        p->sites[p->siteCount++] = kiriFrames_SiteIn(p->grid, p->mesh, cell);
        Measure(p, p->siteCount - 1, p->siteCount);
    }
    for (int round = 0; round < 20 && PlainRound(p); ++round) {
    }
    for (int32_t i = p->oldCount; i < p->siteCount; ++i) {
        p->sites[i] = kiriFrames_SiteIn(p->grid, p->mesh, p->sites[i].cell);
    }
}

/* ---- Placing --------------------------------------------------------------------------------------------------- */

static kiriQuota Endless(void)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    return quota;
}

/* `count` sites more in the piece of a cell; those in `sites` before are all of that piece. */
static bool Place(Scene* scene, kiriPlacer* placer, int32_t cell, int32_t count)
{
    kiriQuota quota = Endless();
    return kiriPlacer_TakePiece(placer, &scene->memory, &scene->grid, cell) &&
           kiriPlacer_Start(placer, &scene->memory, &scene->grid, &scene->mesh, NULL, count) &&
           kiriPlacer_Run(placer, (kiriMemory*)&scene->memory, &scene->grid, &scene->mesh, &quota) == KIRI_DONE;
}

static void AssertDistinct(const Scene* scene, const kiriSites* sites)
{
    for (int32_t i = 0; i < sites->count; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            assert_int_not_equal(sites->data[i].cell, sites->data[j].cell);
        }
        kiriVec2 off =
            kiriVec2_Sub(sites->data[i].at, kiriGrid_Middle(&scene->grid, &scene->mesh, sites->data[i].cell));
        assert_true(fabs(off.x) <= 0.5 * scene->grid.side && fabs(off.y) <= 0.5 * scene->grid.side);
    }
}

static int32_t CellAt(const Scene* scene, int32_t n)
{
    for (int32_t s = 0; s < scene->grid.squareCell.count; ++s) {
        for (int32_t c = scene->grid.squareCell.data[s]; c != KIRI_NONE; c = scene->grid.cells.data[c].next) {
            if (n-- == 0) {
                return c;
            }
        }
    }
    fail();
    return KIRI_NONE;
}

/* Every cell is nearest to one of the sites; the areas of their regions are about even. */
static void AssertEven(Scene* scene, const kiriSites* sites)
{
    double* area = calloc((size_t)sites->count, sizeof(double));
    kiriRule rule = { &scene->grid, KIRI_FAR, NULL, NULL, NULL, NULL, { NULL, NULL } };
    kiriQuota quota = Endless();
    kiriSeeds seeds = { 0 };
    for (int32_t i = 0; i < sites->count; ++i) {
        assert_true(kiriSite_Seed(&sites->data[i], i, &scene->memory, &scene->grid, &scene->mesh, &seeds));
    }
    assert_true(kiriField_Start(&scene->field, &scene->memory, seeds.data, seeds.count));
    assert_int_equal(kiriField_Flood(&scene->field, &rule, &quota), KIRI_DONE);
    for (int32_t c = 0; c < scene->grid.cells.count; ++c) {
        area[scene->field.owner.data[c]] += kiriGrid_Area(&scene->grid, c);
    }
    for (int32_t i = 0; i < sites->count; ++i) {
        double share = area[i] * sites->count / Scene_Area(scene);
        assert_true(share > 0.6 && share < 1.6);
    }
    kiriArray_Release(&scene->memory, &seeds);
    free(area);
}

static void SpreadsEvenly(void** state)
{
    (void)state;
    int32_t counts[4] = { 2, 5, 16, 47 };
    for (int k = 0; k < 4; ++k) {
        Scene scene;
        kiriPlacer placer = { 0 };
        Scene_Init(&scene, 1.0, 1.0, 8, 8, 48);
        Scene_BuildGrid(&scene);
        assert_true(Place(&scene, &placer, 0, counts[k]));
        assert_int_equal(placer.sites.count, counts[k]);
        AssertDistinct(&scene, &placer.sites);
        AssertEven(&scene, &placer.sites);
        Scene_Release(&scene);
    }
}

/* One frame goes to the middle of its piece, and only there. */
static void OneFrameForEachPiece(void** state)
{
    (void)state;
    Scene scene;
    kiriPlacer placer = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 31);
    Scene_Slit(&scene, 0.3, 0.0, 0.3, 1.0);
    Scene_BuildGrid(&scene);
    for (int k = 0; k < 2; ++k) {
        int32_t cell = Scene_Cell(&scene, k == 0 ? 0.9 : 0.1, 0.2), cells = 0;
        placer.sites.count = 0;
        assert_true(Place(&scene, &placer, cell, 1));
        assert_int_equal(placer.sites.count, 1);
        AssertNear(placer.sites.data[0].at.x, k == 0 ? 0.65 : 0.15, 0.6 * scene.grid.side);
        AssertNear(placer.sites.data[0].at.y, 0.5, 0.6 * scene.grid.side);
        for (int32_t i = 0; i < placer.cells.count; ++i) {
            cells += placer.cells.data[i] == placer.sites.data[0].cell;
            assert_true(i == 0 || kiriGrid_IsBefore(&scene.grid, placer.cells.data[i - 1], placer.cells.data[i]));
        }
        assert_int_equal(cells, 1);
    }
    Scene_Release(&scene);
}

static void OldSitesStay(void** state)
{
    (void)state;
    Scene scene;
    kiriPlacer placer = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 4, 4, 32);
    Scene_BuildGrid(&scene);
    kiriSite old[2] = { Scene_Site(&scene, 0.1, 0.1), Scene_Site(&scene, 0.2, 0.15) };
    assert_true(kiriArray_Push(&scene.memory, &placer.sites, old[0]));
    assert_true(kiriArray_Push(&scene.memory, &placer.sites, old[1]));
    assert_true(Place(&scene, &placer, 0, 1));
    assert_int_equal(placer.oldCount, 2);
    assert_int_equal(placer.sites.count, 3);
    assert_memory_equal(placer.sites.data, old, sizeof(old));
    assert_true(placer.sites.data[2].at.x > 0.5 && placer.sites.data[2].at.y > 0.5);
    Scene_Release(&scene);
}

/* More than there are cells: every cell gets one, and no more, also beside sites off the middle of theirs. */
static void CountIsLimitedByCells(void** state)
{
    (void)state;
    Scene scene;
    kiriPlacer placer = { 0 };
    Scene_Init(&scene, 1.0, 0.7, 3, 3, 5);
    Scene_BuildGrid(&scene);
    int32_t cells = scene.grid.cells.count;
    kiriSite old = { { 0.39, 0.21 }, Scene_Cell(&scene, 0.39, 0.21) };
    assert_true(kiriArray_Push(&scene.memory, &placer.sites, old));
    assert_true(Place(&scene, &placer, 0, 1000));
    assert_int_equal(placer.sites.count, cells);
    AssertDistinct(&scene, &placer.sites);
    assert_true(Place(&scene, &placer, 0, 1));
    assert_true(Place(&scene, &placer, 0, 0));
    assert_int_equal(placer.sites.count, cells);
    Scene_Release(&scene);
}

/* Distances to the old sites, as regions have them. */
static void UpdateRegions(kiriRegions* regions, Scene* scene, const Plain* p)
{
    kiriSiteMove moves[MOST];
    kiriQuota quota = Endless();
    for (int32_t i = 0; i < p->oldCount; ++i) {
        moves[i] = (kiriSiteMove){ i, KIRI_NONE };
    }
    kiriRegions_Reset(regions);
    assert_int_equal(kiriRegions_Update(regions, &scene->memory, &scene->grid, &scene->mesh, p->sites, p->oldCount,
                                        moves, p->oldCount, &quota),
                     KIRI_DONE);
}

/* Asks for `count` sites more in the part beside `old` in its first cells, and checks that it gets what is possible. */
static void CheckCount(Scene* scene, kiriPlacer* placer, const kiriField* known, int32_t old, int32_t count,
                       const uint8_t* allowed, int64_t slice)
{
    int32_t isFree = 0, cells = placer->cells.count;
    int64_t used = 0;
    placer->sites.count = 0;
    for (int32_t k = 0; k < cells; ++k) {
        int32_t cell = placer->cells.data[k];
        if (k < old) {
            assert_true(kiriArray_Push(&scene->memory, &placer->sites, Scene_MiddleOf(scene, cell)));
        } else {
            isFree += allowed == NULL || allowed[cell];
        }
    }
    placer->known = known;
    assert_true(kiriPlacer_Start(placer, &scene->memory, &scene->grid, &scene->mesh, allowed, count));
    for (kiriProgress progress = KIRI_MORE; progress != KIRI_DONE;) {
        kiriQuota quota = { slice, 0, 0, false };
        progress = kiriPlacer_Run(placer, &scene->memory, &scene->grid, &scene->mesh, &quota);
        used += quota.used;
        assert_true(progress == KIRI_DONE || (progress == KIRI_MORE && quota.used > 0));
        assert_true(used <= cells * (3 * (int64_t)cells + 80)); /* samplings, and up to 20 rounds of three visits */
    }
    assert_int_equal(placer->oldCount, old);
    assert_int_equal(placer->sites.count - old, count < isFree ? count : isFree);
    AssertDistinct(scene, &placer->sites);
    for (int32_t i = 0; i < placer->sites.count; ++i) {
        int32_t k = 0;
        while (k < cells && placer->cells.data[k] != placer->sites.data[i].cell) {
            ++k;
        }
        assert_true(k < cells && (i >= old || k == i));
    }
}

/* All numbers of old sites, and all counts up to too many: in the part in the placer. */
static void CheckCounts(Scene* scene, kiriPlacer* placer, uint32_t* seed)
{
    int32_t cells = placer->cells.count, most = scene->grid.cells.count;
    uint8_t* allowed = malloc((size_t)most);
    kiriRegions regions = { 0 };
    for (int32_t old = 0; old <= cells; ++old) {
        Plain plain = { .oldCount = old };
        for (int32_t i = 0; i < old; ++i) {
            plain.sites[i] = Scene_MiddleOf(scene, placer->cells.data[i]);
        }
        UpdateRegions(&regions, scene, &plain);
        for (int32_t count = 0; count <= cells + 3; ++count) {
            int32_t asked = count == cells + 3 ? INT32_MAX : count == cells + 2 ? 1000000 : count;
            for (int32_t c = 0; c < most; ++c) {
                allowed[c] = count % 4 != 3 && Random(seed) % 2;
            }
            CheckCount(scene, placer, NULL, old, asked, NULL, INT64_MAX);
            CheckCount(scene, placer, NULL, old, asked, NULL, 40);
            CheckCount(scene, placer, NULL, old, asked, allowed, INT64_MAX);
            CheckCount(scene, placer, &regions.field, old, asked, allowed, 40);
        }
    }
    free(allowed);
}

/* Tiny parts: of one cell, of two, of slivers, of many pieces. */
static void TinyPartsGetWhatIsPossible(void** state)
{
    (void)state;
    uint32_t seed = 77;
    int32_t ones = 0, twos = 0, parts = 0;
    for (int round = 0; round < 40; ++round) {
        Scene scene;
        kiriPlacer placer = { 0 };
        int32_t resolution = 1 + round % 4;
        Scene_InitMesh(&scene, 1.0, RandomBetween(&seed, 0.2, 1.0), 5, 4, resolution, 0.2, seed);
        Scene_CutAtRandom(&scene, round % 6, 9, &seed);
        Scene_BuildGrid(&scene);
        int32_t* piece;
        int32_t pieces = Scene_Pieces(&scene, &piece), cells = scene.grid.cells.count;
        for (int32_t p = 0; p <= pieces; ++p) {
            int32_t first = 0;
            while (first < cells && piece[first] != p) {
                ++first;
            }
            if (p < pieces) {
                assert_true(kiriPlacer_TakePiece(&placer, &scene.memory, &scene.grid, first));
            } else { /* all pieces as one part */
                placer.cells.count = 0;
                for (int32_t k = 0; k < cells; ++k) {
                    assert_true(kiriArray_Push(&scene.memory, &placer.cells, CellAt(&scene, k)));
                }
            }
            ones += placer.cells.count == 1;
            twos += placer.cells.count == 2;
            parts += placer.cells.count > 2;
            if (placer.cells.count <= 14) {
                CheckCounts(&scene, &placer, &seed);
            }
        }
        free(piece);
        Scene_Release(&scene);
    }
    assert_true(ones > 10 && twos > 5 && parts > 20);
}

/* ---- Against the plain answer ------------------------------------------------------------------------------------ */

static int ComparePlain(const Plain* p, int32_t a, int32_t b)
{
    const kiriCell *x = &p->grid->cells.data[a], *y = &p->grid->cells.data[b];
    return x->square != y->square ? (x->square < y->square ? -1 : 1) : (x->triangle < y->triangle ? -1 : 1);
}

/* The cells of a piece, by insertion. */
static void InitPlain(Plain* p, const Scene* scene, const int32_t* piece, int32_t which)
{
    const kiriGrid* grid = &scene->grid;
    memset(p, 0, sizeof(*p));
    p->grid = grid;
    p->mesh = &scene->mesh;
    p->cells = malloc(sizeof(int32_t) * (size_t)grid->cells.count);
    p->distance = malloc(sizeof(int64_t) * MOST * (size_t)grid->cells.count);
    p->closer = malloc(sizeof(int64_t) * (size_t)grid->cells.count);
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (kiriGrid_IsCell(grid, c) && piece[c] == which) {
            int32_t k = p->count++;
            for (; k > 0 && ComparePlain(p, c, p->cells[k - 1]) < 0; --k) {
                p->cells[k] = p->cells[k - 1];
            }
            p->cells[k] = c;
        }
    }
}

static void FreePlain(Plain* p)
{
    free(p->cells);
    free(p->distance);
    free(p->closer);
}

/* Some sites in cells of their own, as frames take them, or at sides and corners of the square; many next to the
   last. */
static void AddOldSites(Plain* p, int32_t count, uint32_t* seed)
{
    for (int32_t k = 0; k < count; ++k) {
        int32_t cell = p->cells[Random(seed) % (uint32_t)p->count];
        if (p->siteCount > 0 && Random(seed) % 2 == 0) {
            kiriSteps steps;
            kiriGrid_GetSteps(p->grid, p->sites[p->siteCount - 1].cell, &steps);
            cell = steps.end[0] > 0 ? steps.data[Random(seed) % (uint32_t)steps.end[0]].cell : cell;
        }
        kiriSite site = kiriFrames_SiteIn(p->grid, p->mesh, cell);
        bool taken = false;
        for (int32_t i = 0; i < p->siteCount; ++i) {
            taken = taken || p->sites[i].cell == cell;
        }
        if (Random(seed) % 4 > 0) {
            double u = 0.49 * ((int)(Random(seed) % 3) - 1), v = 0.49 * ((int)(Random(seed) % 3) - 1);
            kiriVec2 off = kiriVec2_Scale(p->grid->side, kiriVec2_Make(u, v));
            site.at = kiriVec2_Add(kiriGrid_Middle(p->grid, p->mesh, cell), off);
        }
        if (!taken) {
            p->sites[p->siteCount++] = site;
        }
    }
    p->oldCount = p->siteCount;
}

static void GiveOldSites(const Plain* p, kiriMemory* memory, kiriPlacer* placer)
{
    placer->sites.count = 0;
    for (int32_t i = 0; i < p->oldCount; ++i) {
        assert_true(kiriArray_Push(memory, &placer->sites, p->sites[i]));
    }
    placer->ends.count = 0;
    for (int32_t k = 0; k < p->endCount; ++k) {
        assert_true(kiriArray_Push(memory, &placer->ends, p->ends[k]));
    }
    placer->reach = p->reach;
    placer->closeness = p->closeness;
}

/* Places around which sites are closer; anywhere: the placer does not ask whether a slit ends there. */
static void AddEnds(Plain* p, uint32_t* seed)
{
    p->endCount = (int32_t)(Random(seed) % (MOST_ENDS + 1));
    for (int32_t k = 0; k < p->endCount; ++k) {
        memset(&p->ends[k], 0, sizeof(p->ends[k]));
        p->ends[k].cell = p->cells[Random(seed) % (uint32_t)p->count];
    }
    p->reach = RandomBetween(seed, 0.0, 0.4);
    p->closeness = RandomBetween(seed, 1.0, 4.0);
}

/* Runs the job with quotas below `most`, or all at once for 0. */
static void RunInParts(kiriPlacer* placer, const Scene* scene, const kiriGrid* grid, int32_t most, uint32_t* seed)
{
    for (kiriProgress progress = KIRI_MORE; progress != KIRI_DONE;) {
        int64_t left = most == 0 ? INT64_MAX : (int64_t)(Random(seed) % (uint32_t)most);
        kiriQuota quota = { left, 0, 0, false };
        progress = kiriPlacer_Run(placer, (kiriMemory*)&scene->memory, grid, &scene->mesh, &quota);
        assert_int_not_equal(progress, KIRI_FAILED);
        assert_true(quota.left >= 0 && (progress == KIRI_DONE || quota.left == 0));
        assert_true(quota.used <= left || left < 64); /* a step of a flood may settle a few more */
    }
}

static void AssertSites(const kiriPlacer* placer, const Plain* p)
{
    assert_int_equal(placer->oldCount, p->oldCount);
    assert_int_equal(placer->sites.count, p->siteCount);
    for (int32_t i = 0; i < p->siteCount; ++i) {
        assert_int_equal(placer->sites.data[i].cell, p->sites[i].cell);
        assert_true(placer->sites.data[i].at.x == p->sites[i].at.x && placer->sites.data[i].at.y == p->sites[i].at.y);
    }
}

/* All at once, by quota, after a job that was given up, and with distances known. */
static void CheckPlacing(Scene* scene, kiriPlacer* placer, kiriRegions* regions, Plain* p, const uint8_t* allowed,
                         int32_t count, uint32_t* seed)
{
    kiriMemory* memory = &scene->memory;
    PlainPlace(p, allowed, count < p->count ? count : p->count);
    for (int run = 0; run < 4; ++run) {
        GiveOldSites(p, memory, placer);
        if (run == 3) {
            UpdateRegions(regions, scene, p);
            placer->known = &regions->field;
        }
        assert_true(kiriPlacer_TakePiece(placer, memory, &scene->grid, p->cells[Random(seed) % (uint32_t)p->count]));
        assert_int_equal(placer->cells.count, p->count);
        assert_memory_equal(placer->cells.data, p->cells, sizeof(int32_t) * (size_t)p->count);
        assert_true(kiriPlacer_Start(placer, memory, &scene->grid, &scene->mesh, allowed, count));
        assert_null(placer->known);
        if (run == 1) { /* given up here or there */
            kiriQuota quota = { (int64_t)(Random(seed) % (uint32_t)(8 * p->count)), 0, 0, false };
            kiriPlacer_Run(placer, memory, &scene->grid, &scene->mesh, &quota);
            continue;
        }
        RunInParts(placer, scene, &scene->grid, run == 2 ? 6 : 0, seed);
        AssertSites(placer, p);
    }
}

static void CheckPiece(Scene* scene, kiriPlacer* placer, kiriRegions* regions, Plain* p, uint32_t* seed)
{
    uint8_t* allowed = NULL;
    int32_t most = Random(seed) % 8 == 0 ? 50 : 7, count = (int32_t)(Random(seed) % (uint32_t)most);
    AddOldSites(p, Random(seed) % 3 == 0 ? 0 : (int32_t)(Random(seed) % 6), seed);
    if (Random(seed) % 2 == 0) {
        AddEnds(p, seed);
    }
    if (Random(seed) % 3 == 0) {
        allowed = malloc((size_t)scene->grid.cells.count);
        for (int32_t c = 0; c < scene->grid.cells.count; ++c) {
            allowed[c] = Random(seed) % 3 == 0;
        }
    }
    CheckPlacing(scene, placer, regions, p, allowed, count, seed);
    free(allowed);
}

static void EqualsPlainPlacing(void** state)
{
    (void)state;
    uint32_t seed = 41;
    int32_t pieces = 0, several = 0;
    for (int round = 0; round < 80; ++round) {
        Scene scene;
        kiriSites random;
        kiriPlacer placer = { 0 };
        kiriRegions regions;
        int32_t* piece;
        memset(&regions, 0, sizeof(regions));
        Scene_InitRandom(&scene, &random, 0, &seed);
        for (int32_t which = Scene_Pieces(&scene, &piece) - 1; which >= 0; --which) {
            Plain plain;
            InitPlain(&plain, &scene, piece, which);
            CheckPiece(&scene, &placer, &regions, &plain, &seed);
            ++pieces;
            several += plain.siteCount - plain.oldCount > 1;
            FreePlain(&plain);
        }
        free(piece);
        kiriArray_Release(&scene.memory, &random);
        Scene_Release(&scene);
    }
    assert_true(pieces > 150 && several > 60);
}

/* Two sites side by side, anywhere in their squares, and then one in every other cell: the order in which these come
   tells all distances. */
static void EqualsPlainBesideNeighbours(void** state)
{
    (void)state;
    Scene scene;
    kiriPlacer placer = { 0 };
    kiriRegions regions;
    uint32_t seed = 3;
    memset(&regions, 0, sizeof(regions));
    Scene_Init(&scene, 1.0, 1.0, 3, 3, 9);
    Scene_BuildGrid(&scene);
    int32_t* piece = calloc((size_t)scene.grid.cells.count, sizeof(int32_t));
    for (int k = 0; k < 81; ++k) {
        const int places[4] = { k % 3, k / 3 % 3, k / 9 % 3, k / 27 };
        Plain plain;
        InitPlain(&plain, &scene, piece, 0);
        for (int i = 0; i < 2; ++i) {
            kiriVec2 off = kiriVec2_Make(0.49 * (places[2 * i] - 1), 0.49 * (places[2 * i + 1] - 1));
            plain.sites[i] = Scene_Site(&scene, i == 0 ? 0.4 : 0.5, 0.3);
            plain.sites[i].at = kiriVec2_Add(plain.sites[i].at, kiriVec2_Scale(scene.grid.side, off));
        }
        plain.siteCount = plain.oldCount = 2;
        CheckPlacing(&scene, &placer, &regions, &plain, NULL, 79, &seed);
        FreePlain(&plain);
    }
    free(piece);
    Scene_Release(&scene);
}

/* ---- Indices of cells mean nothing
   -------------------------------------------------------------------------------- */

/* The same grid, cell c with index to[c]; what placing reads of it. */
static void Permute(kiriGrid* out, const kiriGrid* grid, kiriMemory* memory, const int32_t* to)
{
    int32_t count = grid->cells.count;
    memset(out, 0, sizeof(*out));
    out->side = grid->side;
    memcpy(out->openTo, grid->openTo, sizeof(out->openTo));
    kiriArray_SetHeader(&out->materials, kiriArray_GetHeader(&grid->materials)); /* the same ones */
    assert_true(kiriArray_Resize(memory, &out->cells, count) && kiriArray_Resize(memory, &out->runs, count) &&
                kiriArray_Resize(memory, &out->steps, grid->steps.count) &&
                kiriArray_Resize(memory, &out->squareCell, grid->squareCell.count));
    for (int32_t c = 0; c < count; ++c) {
        out->cells.data[to[c]] = grid->cells.data[c];
        out->cells.data[to[c]].next = grid->cells.data[c].next == KIRI_NONE ? KIRI_NONE : to[grid->cells.data[c].next];
        out->runs.data[to[c]] = grid->runs.data[c];
    }
    for (int32_t c = 0; c < count; ++c) {
        const kiriStepRun* run = &grid->runs.data[c];
        int32_t end = kiriStepRun_IsOpen(run) ? run->first : run->end[KIRI_STEP_LENGTHS - 1];
        for (int32_t s = run->first; s < end; ++s) {
            out->steps.data[s] = grid->steps.data[s];
            out->steps.data[s].cell = to[grid->steps.data[s].cell];
        }
    }
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        int32_t first = grid->squareCell.data[s];
        out->squareCell.data[s] = first == KIRI_NONE ? KIRI_NONE : to[first];
    }
}

static void ReleasePermuted(kiriGrid* grid, kiriMemory* memory)
{
    kiriArray_Release(memory, &grid->cells);
    kiriArray_Release(memory, &grid->runs);
    kiriArray_Release(memory, &grid->steps);
    kiriArray_Release(memory, &grid->squareCell);
}

static int32_t* RandomPermutation(int32_t count, uint32_t* seed)
{
    int32_t* to = malloc(sizeof(int32_t) * (size_t)count);
    for (int32_t c = 0; c < count; ++c) {
        int32_t k = (int32_t)(Random(seed) % (uint32_t)(c + 1));
        to[c] = to[k];
        to[k] = c;
    }
    return to;
}

static void DoesNotDependOnIndices(void** state)
{
    (void)state;
    uint32_t seed = 77;
    for (int round = 0; round < 60; ++round) {
        Scene scene;
        kiriSites random;
        kiriPlacer first = { 0 }, second = { 0 };
        kiriGrid grid;
        Scene_InitRandom(&scene, &random, 0, &seed);
        int32_t* to = RandomPermutation(scene.grid.cells.count, &seed);
        Permute(&grid, &scene.grid, &scene.memory, to);
        for (int32_t i = 0; i < random.count; ++i) { /* one in each piece */
            int32_t count = 1 + (int32_t)(Random(&seed) % 6), old = (int32_t)(Random(&seed) % 2);
            first.sites.count = second.sites.count = 0;
            if (old == 1) {
                kiriSite moved = random.data[i];
                moved.cell = to[moved.cell];
                assert_true(kiriArray_Push(&scene.memory, &first.sites, random.data[i]));
                assert_true(kiriArray_Push(&scene.memory, &second.sites, moved));
            }
            assert_true(Place(&scene, &first, random.data[i].cell, count));
            assert_true(kiriPlacer_TakePiece(&second, &scene.memory, &grid, to[random.data[i].cell]));
            assert_true(kiriPlacer_Start(&second, &scene.memory, &grid, &scene.mesh, NULL, count));
            RunInParts(&second, &scene, &grid, 0, &seed);
            assert_int_equal(first.cells.count, second.cells.count);
            assert_int_equal(first.sites.count, second.sites.count);
            for (int32_t k = 0; k < first.sites.count; ++k) {
                assert_int_equal(to[first.sites.data[k].cell], second.sites.data[k].cell);
                assert_memory_equal(&first.sites.data[k].at, &second.sites.data[k].at, sizeof(kiriVec2));
            }
        }
        free(to);
        ReleasePermuted(&grid, &scene.memory);
        kiriArray_Release(&scene.memory, &random);
        Scene_Release(&scene);
    }
}

/* A grid that followed cuts, and the same from scratch. */
static void EqualsFromScratch(void** state)
{
    (void)state;
    uint32_t seed = 99;
    int32_t elsewhere = 0;
    for (int round = 0; round < 30; ++round) {
        Scene scene;
        kiriPlacer first = { 0 }, second = { 0 };
        int32_t* piece;
        Scene_InitMesh(&scene, 1.0, 0.8, 13, 11, 9 + (int32_t)(Random(&seed) % 16), 0.2, seed);
        Scene_BuildGrid(&scene);
        for (int cut = 0; cut < 4; ++cut) {
            kiriMesh_Begin(&scene.mesh);
            Scene_CutAtRandom(&scene, 4, 14, &seed);
            Scene_UpdateGrid(&scene);
            kiriGrid_ClearChanges(&scene.grid);
        }
        kiriGrid followed = scene.grid;
        memset(&scene.grid, 0, sizeof(scene.grid));
        Scene_BuildGrid(&scene);
        for (int32_t which = Scene_Pieces(&scene, &piece) - 1; which >= 0; --which) {
            int32_t n = 0, count = 1 + (int32_t)(Random(&seed) % 6);
            while (piece[CellAt(&scene, n)] != which) {
                ++n;
            }
            first.sites.count = second.sites.count = 0;
            assert_true(Place(&scene, &first, CellAt(&scene, n), count));
            kiriGrid fresh = scene.grid;
            scene.grid = followed;
            assert_true(kiriField_Resize(&scene.field, &scene.memory, followed.cells.count));
            assert_true(Place(&scene, &second, CellAt(&scene, n), count));
            scene.grid = fresh;
            assert_int_equal(first.sites.count, second.sites.count);
            for (int32_t k = 0; k < first.sites.count; ++k) {
                const kiriCell* a = &fresh.cells.data[first.sites.data[k].cell];
                const kiriCell* b = &followed.cells.data[second.sites.data[k].cell];
                assert_true(a->square == b->square && a->triangle == b->triangle);
                assert_memory_equal(&first.sites.data[k].at, &second.sites.data[k].at, sizeof(kiriVec2));
                elsewhere += first.sites.data[k].cell != second.sites.data[k].cell;
            }
        }
        free(piece);
        Scene_Release(&scene);
    }
    assert_true(elsewhere > 30); /* or the test would see nothing */
}

/* ---- Recentering ------------------------------------------------------------------------------------------------- */

static kiriVec3 RandomVec3(uint32_t* seed)
{
    kiriVec2 p = RandomVec2(seed, -1.0, 1.0);
    return kiriVec3_Make(p.x, p.y, RandomBetween(seed, -1.0, 1.0));
}

static kiriFrameData RandomFrame(uint32_t* seed)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.center = RandomVec2(seed, 0.0, 1.0);
    frame.x = RandomVec3(seed);
    frame.A = kiriMat3_Cayley(kiriVec3_Scale(3.0, RandomVec3(seed)));
    frame.velocity = RandomVec3(seed);
    frame.spin = RandomVec3(seed);
    return frame;
}

static kiriVec3 VelocityAt(const kiriFrameData* frame, kiriVec2 p)
{
    return kiriVec3_Add(frame->velocity,
                        kiriVec3_Cross(frame->spin, kiriVec3_Sub(kiriFrame_Carry(frame, p), frame->x)));
}

static kiriMoments RandomTriangle(uint32_t* seed, kiriVec2 corners[3])
{
    corners[0] = RandomVec2(seed, 0.0, 0.4);
    corners[1] = RandomVec2(seed, 0.0, 0.4);
    corners[1].x += 0.6;
    corners[2] = RandomVec2(seed, 0.0, 0.4);
    corners[2].y += 0.6;
    return kiriMoments_Triangle(corners[0], corners[1], corners[2]);
}

static void AssertNear3(kiriVec3 a, kiriVec3 b, double tolerance)
{
    AssertNear(a.x, b.x, tolerance);
    AssertNear(a.y, b.y, tolerance);
    AssertNear(a.z, b.z, tolerance);
}

static void RecenterKeepsTheMotion(void** state)
{
    (void)state;
    uint32_t seed = 43;
    for (int round = 0; round < 100; ++round) {
        kiriVec2 corners[3];
        kiriMoments material = RandomTriangle(&seed, corners);
        kiriFrameData before = RandomFrame(&seed), after = before;
        kiriFrame_Recenter(&after, &material, 0.3);
        for (int k = 0; k < 3; ++k) {
            AssertNear3(kiriFrame_Carry(&after, corners[k]), kiriFrame_Carry(&before, corners[k]), 1e-14);
            AssertNear3(VelocityAt(&after, corners[k]), VelocityAt(&before, corners[k]), 1e-14);
        }
        AssertNear(after.area, material.area, 0.0);
        AssertNear(after.mass, 0.3 * material.area, 1e-15);
        AssertNear(after.center.x, (corners[0].x + corners[1].x + corners[2].x) / 3.0, 1e-14);
        AssertNear3(after.spin, before.spin, 0.0);
    }
}

/* Momentum and angular momentum about the world's origin of the material by itself: a quadratic integrand, exact
   with the middles of a triangle's sides. */
static void IntegrateMomentum(const kiriFrameData* frame, const kiriVec2 corners[3], double mass, kiriVec3* linear,
                              kiriVec3* angular)
{
    *linear = *angular = kiriVec3_Make(0.0, 0.0, 0.0);
    for (int k = 0; k < 3; ++k) {
        kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(corners[k], corners[(k + 1) % 3]));
        kiriVec3 velocity = kiriVec3_Scale(mass / 3.0, VelocityAt(frame, middle));
        *linear = kiriVec3_Add(*linear, velocity);
        *angular = kiriVec3_Add(*angular, kiriVec3_Cross(kiriFrame_Carry(frame, middle), velocity));
    }
}

static void RecenterKeepsTheMomentum(void** state)
{
    (void)state;
    uint32_t seed = 47;
    for (int round = 0; round < 100; ++round) {
        kiriVec2 corners[3];
        kiriMoments material = RandomTriangle(&seed, corners);
        kiriFrameData before = RandomFrame(&seed), frame = before;
        kiriVec3 linear, angular;
        kiriFrame_Recenter(&frame, &material, 0.3);
        IntegrateMomentum(&before, corners, 0.3 * material.area, &linear, &angular);
        AssertNear3(kiriVec3_Scale(frame.mass, frame.velocity), linear, 1e-12);
        /* sum over u, v of inertia * A x (spin x A), and that of the centre of mass */
        kiriVec3 u = kiriVec3_Cross(frame.spin, frame.A.u), v = kiriVec3_Cross(frame.spin, frame.A.v);
        kiriVec3 own = kiriVec3_Scale(frame.inertia[0], kiriVec3_Cross(frame.A.u, u));
        own = kiriVec3_AddScaled(own, frame.inertia[1], kiriVec3_Cross(frame.A.u, v));
        own = kiriVec3_AddScaled(own, frame.inertia[1], kiriVec3_Cross(frame.A.v, u));
        own = kiriVec3_AddScaled(own, frame.inertia[2], kiriVec3_Cross(frame.A.v, v));
        own = kiriVec3_AddScaled(own, frame.mass, kiriVec3_Cross(frame.x, frame.velocity));
        AssertNear3(own, angular, 1e-12);
    }
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

static void FailingAllocatorLeaksNothing(void** state)
{
    (void)state;
    uint32_t seed = 5;
    Scene scene;
    kiriSites random;
    Scene_InitRandom(&scene, &random, 0, &seed);
    int64_t fewest = 0;
    int32_t cell = random.data[0].cell;
    for (bool done = false; !done; ++fewest) {
        kiriPlacer placer = { 0 };
        kiriSite old = Scene_MiddleOf(&scene, cell);
        assert_true(kiriArray_Push(&scene.memory, &placer.sites, old));
        scene.purse.budget = fewest;
        done = Place(&scene, &placer, cell, 12);
        scene.purse.budget = -1;
        assert_true(done || fewest < 1000);
        assert_true(placer.oldCount == 0 || placer.oldCount == 1);
        placer.sites.count = 1;
        assert_true(Place(&scene, &placer, cell, 12)); /* what is left is of use */
        assert_int_equal(placer.sites.count, 13);
    }
    assert_true(fewest > 10);
    kiriArray_Release(&scene.memory, &random);
    Scene_Release(&scene);
}

/* Once there is room, placing keeps no more of it: only scans take some, which they give back. */
static void PlacingAgainKeepsNoMore(void** state)
{
    (void)state;
    Scene scene;
    kiriPlacer placer = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 8, 8, 24);
    Scene_BuildGrid(&scene);
    assert_true(Place(&scene, &placer, 0, 9));
    int64_t out = scene.purse.out;
    for (int32_t count = 1; count < 9; ++count) {
        placer.sites.count = 0;
        assert_true(Place(&scene, &placer, 0, count));
        assert_int_equal(scene.purse.out, out);
    }
    Scene_Release(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(SpreadsEvenly),
        cmocka_unit_test(OneFrameForEachPiece),
        cmocka_unit_test(OldSitesStay),
        cmocka_unit_test(CountIsLimitedByCells),
        cmocka_unit_test(TinyPartsGetWhatIsPossible),
        cmocka_unit_test(EqualsPlainPlacing),
        cmocka_unit_test(EqualsPlainBesideNeighbours),
        cmocka_unit_test(DoesNotDependOnIndices),
        cmocka_unit_test(EqualsFromScratch),
        cmocka_unit_test(RecenterKeepsTheMotion),
        cmocka_unit_test(RecenterKeepsTheMomentum),
        cmocka_unit_test(FailingAllocatorLeaksNothing),
        cmocka_unit_test(PlacingAgainKeepsNoMore),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
