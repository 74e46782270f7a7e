#include "region.h"

/* ---- Division --------------------------------------------------------------------------------------------------- */

static int32_t GridLength(double meters, double side)
{
    return (int32_t)(KIRI_UNIT * (meters / side) + 0.5);
}

bool kiriSite_Seed(const kiriSite* site, int32_t owner, const kiriMemory* memory, const kiriGrid* grid,
                   const kiriMeshData* mesh, kiriSeeds* seeds)
{
    double off = kiriVec2_Length(kiriVec2_Sub(kiriGrid_Middle(grid, mesh, site->cell), site->at));
    bool atMiddle = off <= 0.01 * grid->side;
    kiriSeed own = { site->cell, atMiddle ? 0 : GridLength(off, grid->side), owner };
    if (!kiriArray_Push(memory, seeds, own)) {
        return false;
    }
    int32_t end = atMiddle ? 0 : grid->stepStart.data[site->cell + 1];
    for (int32_t s = grid->stepStart.data[site->cell]; s < end; ++s) {
        int32_t cell = grid->steps.data[s].cell;
        kiriVec2 way = kiriVec2_Sub(kiriGrid_Middle(grid, mesh, cell), site->at);
        kiriSeed seed = { cell, GridLength(kiriVec2_Length(way), grid->side), owner };
        if (!kiriArray_Push(memory, seeds, seed)) {
            return false;
        }
    }
    return true;
}

/* The seeds of all sites, less those in the own cell of another site. So no region is ever empty: a site is within
   half a diagonal of its cell's middle, and every way into that cell is at least a side long. Uses `owner` as a
   mark. */
static bool CollectSeeds(kiriRegions* regions, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                         const kiriSite* sites, int32_t siteCount, kiriSeeds* seeds)
{
    int32_t* owner = regions->owner.data;
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        owner[c] = KIRI_NONE;
    }
    for (int32_t i = 0; i < siteCount; ++i) {
        owner[sites[i].cell] = i;
        if (!kiriSite_Seed(&sites[i], i, memory, grid, mesh, seeds)) {
            return false;
        }
    }
    int32_t kept = 0;
    for (int32_t k = 0; k < seeds->count; ++k) {
        kiriSeed seed = seeds->data[k];
        if (owner[seed.cell] == KIRI_NONE || owner[seed.cell] == seed.owner) {
            seeds->data[kept++] = seed;
        }
    }
    seeds->count = kept;
    return true;
}

bool kiriRegions_Divide(kiriRegions* regions, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        kiriField* field, const kiriSite* sites, int32_t siteCount)
{
    int32_t cellCount = grid->cells.count;
    kiriSeeds seeds = { 0 };
    bool ok = kiriArray_Resize(memory, &regions->owner, cellCount) &&
              kiriArray_Resize(memory, &regions->distance, cellCount) &&
              CollectSeeds(regions, memory, grid, mesh, sites, siteCount, &seeds) &&
              kiriField_Flood(field, memory, grid, seeds.data, seeds.count, KIRI_FAR - 1, NULL, NULL);
    for (int32_t c = 0; ok && c < cellCount; ++c) {
        regions->owner.data[c] = field->owner.data[c];
        regions->distance.data[c] = field->distance.data[c];
    }
    kiriField_Reset(field);
    kiriArray_Release(memory, &seeds);
    return ok;
}

static bool Measure(kiriRegions* regions, const kiriMemory* memory, const kiriGrid* grid, int32_t siteCount)
{
    if (!kiriArray_Resize(memory, &regions->regions, siteCount)) {
        return false;
    }
    for (int32_t i = 0; i < siteCount; ++i) {
        regions->regions.data[i] = (kiriRegion){ { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, 0, { 0.0, 0.0, 0.0 } };
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (regions->owner.data[c] != KIRI_NONE) {
            kiriRegion* region = &regions->regions.data[regions->owner.data[c]];
            int32_t distance = regions->distance.data[c];
            kiriMoments_Add(&region->material, &grid->cells.data[c].material);
            region->reach = distance > region->reach ? distance : region->reach;
        }
    }
    return true;
}

/* ---- Links ------------------------------------------------------------------------------------------------------ */

/* What is known of a face. */
typedef enum Mark {
    INNER, /* between cells of one region */
    FRESH,
    SEEN,
    PLAIN, /* its whole stretch makes one link */
    BENT,  /* the stretch is split where its normal turns */
    DONE
} Mark;

typedef struct Border {
    const kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriSite* sites;
    kiriRegions* regions;
    KIRI_ARRAY(Mark) marks;      /* one a face */
    KIRI_ARRAY(int32_t) stretch; /* the faces of the stretch at hand */
} Border;

/* A border face seen from the region with the lower index. */
typedef struct Side {
    int32_t x, y; /* its cells in regions i and j, i < j */
    int32_t i, j;
    int32_t axis;
    double sign; /* of the normal from i to j along the axis */
} Side;

static Side SideOf(const Border* border, int32_t face)
{
    const kiriFace* f = &border->grid->faces.data[face];
    const int32_t* owner = border->regions->owner.data;
    int32_t low = owner[f->cell[0]] < owner[f->cell[1]] ? 0 : 1;
    Side side = { f->cell[low], f->cell[1 - low],     owner[f->cell[low]], owner[f->cell[1 - low]],
                  f->axis,      low == 0 ? 1.0 : -1.0 };
    return side;
}

/* The same cell, or a straight or diagonal step apart. */
static bool Touch(const kiriGrid* grid, int32_t a, int32_t b)
{
    if (a == b) {
        return true;
    }
    for (int32_t s = grid->stepStart.data[a]; s < grid->stepStart.data[a + 1]; ++s) {
        if (grid->steps.data[s].cell == b) {
            return grid->steps.data[s].length <= KIRI_UNIT_DIAGONAL;
        }
    }
    return false;
}

/* Adds the faces of `cell` that carry on the stretch from side `from`. */
static bool GatherAt(Border* border, const Side* from, int32_t cell, Mark mark, Mark next)
{
    const kiriGrid* grid = border->grid;
    for (int32_t f = grid->faceHead.data[cell]; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        if (border->marks.data[f] == mark) {
            Side side = SideOf(border, f);
            bool sameWay = side.axis == from->axis && side.sign == from->sign;
            if (side.x == cell && side.i == from->i && side.j == from->j && (sameWay || mark != BENT) &&
                Touch(grid, side.y, from->y)) {
                border->marks.data[f] = next;
                if (!kiriArray_Push(border->memory, &border->stretch, f)) {
                    return false;
                }
            }
        }
        f = face->next[face->cell[0] == cell ? 0 : 1];
    }
    return true;
}

/* The connected stretch around a face, as far as the faces bear the same mark; they are marked `next`. */
static bool Gather(Border* border, int32_t face, Mark next)
{
    const kiriGrid* grid = border->grid;
    Mark mark = border->marks.data[face];
    border->stretch.count = 0;
    border->marks.data[face] = next;
    bool ok = kiriArray_Push(border->memory, &border->stretch, face);
    for (int32_t k = 0; ok && k < border->stretch.count; ++k) {
        Side side = SideOf(border, border->stretch.data[k]);
        ok = GatherAt(border, &side, side.x, mark, next);
        for (int32_t s = grid->stepStart.data[side.x]; ok && s < grid->stepStart.data[side.x + 1]; ++s) {
            if (grid->steps.data[s].length <= KIRI_UNIT_DIAGONAL) {
                ok = GatherAt(border, &side, grid->steps.data[s].cell, mark, next);
            }
        }
    }
    return ok;
}

/* The vector sum of the faces, as normals from i to j; *sum is their plain sum. */
static kiriVec2 SumNormals(const Border* border, double* sum)
{
    double n[2] = { 0.0, 0.0 };
    *sum = 0.0;
    for (int32_t k = 0; k < border->stretch.count; ++k) {
        double width = border->grid->faces.data[border->stretch.data[k]].width;
        Side side = SideOf(border, border->stretch.data[k]);
        n[side.axis] += side.sign * width;
        *sum += width;
    }
    return kiriVec2_Make(n[0], n[1]);
}

/* A border that turns back on itself (around the tip of a slit, say) loses its width in the vector sum: it is
   split into stretches of one normal each. */
static bool MarkBent(Border* border)
{
    for (int32_t f = 0; f < border->grid->faces.count; ++f) {
        if (border->marks.data[f] == FRESH) {
            double sum;
            if (!Gather(border, f, SEEN)) {
                return false;
            }
            bool bent = kiriVec2_Length(SumNormals(border, &sum)) < 0.5 * sum;
            for (int32_t k = 0; k < border->stretch.count; ++k) {
                border->marks.data[border->stretch.data[k]] = bent ? BENT : PLAIN;
            }
        }
    }
    return true;
}

/* Centroid and second moment along the tangent; a face counts by what it shows to the normal. */
static void SetMoments(const Border* border, kiriLink* link)
{
    double normal[2] = { link->normal.x, link->normal.y };
    double total = 0.0;
    kiriVec2 first = { 0.0, 0.0 };
    for (int32_t k = 0; k < border->stretch.count; ++k) {
        const kiriFace* face = &border->grid->faces.data[border->stretch.data[k]];
        double weight = face->width * fabs(normal[face->axis]);
        total += weight;
        first = kiriVec2_Add(first, kiriVec2_Scale(weight, face->middle));
    }
    link->centroid = kiriVec2_Scale(1.0 / total, first);
    link->moment = 0.0;
    for (int32_t k = 0; k < border->stretch.count; ++k) {
        const kiriFace* face = &border->grid->faces.data[border->stretch.data[k]];
        /* The side's direction along the tangent is as its normal along the normal. */
        double share = fabs(normal[face->axis]);
        double s = kiriVec2_Dot(kiriVec2_Sub(face->middle, link->centroid), link->tangent);
        link->moment += share * (face->width * s * s + face->moment * share * share);
    }
}

/* The border is a staircase of faces, whose normals differ: what the link's one normal leaves out. */
static void SetSpread(const Border* border, kiriLink* link)
{
    for (int32_t k = 0; k < border->stretch.count; ++k) {
        const kiriFace* face = &border->grid->faces.data[border->stretch.data[k]];
        Side side = SideOf(border, border->stretch.data[k]);
        kiriVec2 arm = kiriVec2_Sub(face->middle, link->centroid);
        double along = side.sign * face->width;
        kiriVec2 normal = { side.axis == 0 ? along : 0.0, side.axis == 0 ? 0.0 : along };
        link->spread[0] = kiriVec2_Add(link->spread[0], kiriVec2_Scale(arm.x, normal));
        link->spread[1] = kiriVec2_Add(link->spread[1], kiriVec2_Scale(arm.y, normal));
    }
}

/* A way from site i to site j. */
typedef struct Way {
    int32_t length;
    kiriVec2 crossing;
} Way;

/* Takes the longer steps from `cell` over the border into region `to` where they shorten the way. */
static void TrySteps(const Border* border, int32_t cell, int32_t to, Way* way)
{
    const kiriGrid* grid = border->grid;
    const int32_t* distance = border->regions->distance.data;
    for (int32_t s = grid->stepStart.data[cell]; s < grid->stepStart.data[cell + 1]; ++s) {
        kiriStep step = grid->steps.data[s];
        if (border->regions->owner.data[step.cell] == to) {
            int32_t length = distance[cell] + step.length + distance[step.cell];
            if (length < way->length) {
                kiriVec2 a = kiriGrid_Middle(grid, border->mesh, cell);
                kiriVec2 b = kiriGrid_Middle(grid, border->mesh, step.cell);
                way->length = length;
                way->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
            }
        }
    }
}

static Way ShortestWay(const Border* border)
{
    const int32_t* distance = border->regions->distance.data;
    Way way = { KIRI_FAR, { 0.0, 0.0 } };
    for (int32_t k = 0; k < border->stretch.count; ++k) {
        int32_t face = border->stretch.data[k];
        Side side = SideOf(border, face);
        int32_t length = distance[side.x] + KIRI_UNIT + distance[side.y];
        if (length < way.length) {
            way.length = length;
            way.crossing = border->grid->faces.data[face].middle;
        }
        TrySteps(border, side.x, side.j, &way);
        TrySteps(border, side.y, side.i, &way);
    }
    return way;
}

/* Lengths on the grid exceed true ones by up to 3 %, and by parts of a side at both ends: a way that is not clearly longer
   than the straight line is one. */
static void SetLength(const Border* border, kiriLink* link)
{
    kiriVec2 a = border->sites[link->i].at, b = border->sites[link->j].at;
    double straight = kiriVec2_Length(kiriVec2_Sub(b, a));
    Way way = ShortestWay(border);
    link->length = way.length * (border->grid->side / KIRI_UNIT);
    link->crossing = way.crossing;
    link->span = kiriVec2_Scale(link->length, link->normal);
    if (link->length < 1.08 * straight + 0.5 * border->grid->side) {
        link->length = straight;
        link->span = kiriVec2_Sub(b, a);
        link->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
    }
    double least = 0.1 * border->grid->side;
    link->length = link->length > least ? link->length : least;
}

static bool AddLink(Border* border)
{
    Side side = SideOf(border, border->stretch.data[0]);
    double sum;
    kiriVec2 normal = SumNormals(border, &sum);
    kiriLink link = { 0 };
    link.i = side.i;
    link.j = side.j;
    link.width = kiriVec2_Length(normal);
    link.normal = kiriVec2_Scale(1.0 / link.width, normal);
    link.tangent = kiriVec2_Make(-link.normal.y, link.normal.x);
    SetMoments(border, &link);
    SetSpread(border, &link);
    SetLength(border, &link);
    return kiriArray_Push(border->memory, &border->regions->links, link);
}

static bool AddLinks(Border* border)
{
    int32_t faceCount = border->grid->faces.count;
    if (!kiriArray_Resize(border->memory, &border->marks, faceCount)) {
        return false;
    }
    for (int32_t f = 0; f < faceCount; ++f) {
        Side side = SideOf(border, f);
        border->marks.data[f] = side.i != side.j ? FRESH : INNER;
    }
    if (!MarkBent(border)) {
        return false;
    }
    for (int32_t f = 0; f < faceCount; ++f) {
        Mark mark = border->marks.data[f];
        if ((mark == PLAIN || mark == BENT) && !(Gather(border, f, DONE) && AddLink(border))) {
            return false;
        }
    }
    return true;
}

static void AddSpread(kiriRegion* region, const kiriLink* link)
{
    double half = 0.5 * link->width * link->length;
    region->spread[0] += half * link->normal.x * link->normal.x;
    region->spread[1] += half * link->normal.x * link->normal.y;
    region->spread[2] += half * link->normal.y * link->normal.y;
}

static double BracedIn(const kiriRegion* region, kiriVec2 t)
{
    const double* spread = region->spread;
    double sum = t.x * t.x * spread[0] + 2.0 * t.x * t.y * spread[1] + t.y * t.y * spread[2];
    return sum < region->material.area ? sum / region->material.area : 1.0;
}

static void SetBraced(kiriRegions* regions)
{
    for (int32_t k = 0; k < regions->links.count; ++k) {
        AddSpread(&regions->regions.data[regions->links.data[k].i], &regions->links.data[k]);
        AddSpread(&regions->regions.data[regions->links.data[k].j], &regions->links.data[k]);
    }
    for (int32_t k = 0; k < regions->links.count; ++k) {
        kiriLink* link = &regions->links.data[k];
        const kiriRegion *i = &regions->regions.data[link->i], *j = &regions->regions.data[link->j];
        link->braced = 0.5 * (BracedIn(i, link->tangent) + BracedIn(j, link->tangent));
    }
}

/* One pass of a radix sort: stable, by i or by j. */
static void SortLinks(const kiriLink* from, kiriLink* to, int32_t count, int32_t* start, int32_t siteCount, bool byI)
{
    for (int32_t i = 0; i <= siteCount; ++i) {
        start[i] = 0;
    }
    for (int32_t k = 0; k < count; ++k) {
        ++start[(byI ? from[k].i : from[k].j) + 1];
    }
    for (int32_t i = 0; i < siteCount; ++i) {
        start[i + 1] += start[i];
    }
    for (int32_t k = 0; k < count; ++k) {
        to[start[byI ? from[k].i : from[k].j]++] = from[k];
    }
}

/* Links were added by their lowest face; now by (i, j) first. */
static bool OrderLinks(kiriRegions* regions, const kiriMemory* memory, int32_t siteCount)
{
    KIRI_ARRAY(kiriLink) other = { 0 };
    KIRI_ARRAY(int32_t) start = { 0 };
    int32_t count = regions->links.count;
    bool ok = kiriArray_Resize(memory, &other, count) && kiriArray_Resize(memory, &start, (int64_t)siteCount + 1);
    if (ok) {
        SortLinks(regions->links.data, other.data, count, start.data, siteCount, false);
        SortLinks(other.data, regions->links.data, count, start.data, siteCount, true);
    }
    kiriArray_Release(memory, &other);
    kiriArray_Release(memory, &start);
    return ok;
}

bool kiriRegions_Build(kiriRegions* regions, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                       kiriField* field, const kiriSite* sites, int32_t siteCount)
{
    Border border = { memory, grid, mesh, sites, regions, { 0 }, { 0 } };
    regions->links.count = 0;
    bool ok = kiriRegions_Divide(regions, memory, grid, mesh, field, sites, siteCount) &&
              Measure(regions, memory, grid, siteCount) && AddLinks(&border) && OrderLinks(regions, memory, siteCount);
    if (ok) {
        SetBraced(regions);
    }
    kiriArray_Release(memory, &border.marks);
    kiriArray_Release(memory, &border.stretch);
    return ok;
}

void kiriRegions_Release(kiriRegions* regions, const kiriMemory* memory)
{
    kiriArray_Release(memory, &regions->owner);
    kiriArray_Release(memory, &regions->distance);
    kiriArray_Release(memory, &regions->regions);
    kiriArray_Release(memory, &regions->links);
}
