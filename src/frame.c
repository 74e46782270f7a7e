#include "frame.h"

/* ---- Placing (section 5) ---------------------------------------------------------------------------------------- */

typedef struct Placer {
    const kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    kiriField* field;
    int32_t piece;
    const uint8_t* allowed; /* cells to sample, or null */
    kiriSites sites;        /* of the piece: floods from them never leave it */
    int32_t oldCount;       /* sites before it stay where they are */
    kiriRegions regions;    /* scratch */
} Placer;

/* A full cell is taken at its middle, where the cell's weight is exactly 1; of others the middle may not be material. */
kiriSite kiriFrames_SiteIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    const kiriMoments* material = &grid->cells.data[cell].material;
    bool full = material->area > 0.999 * grid->side * grid->side;
    kiriSite site = { full ? kiriGrid_Middle(grid, mesh, cell) : kiriMoments_Center(material), cell };
    return site;
}

static kiriSite SiteIn(const Placer* p, int32_t cell)
{
    return kiriFrames_SiteIn(p->grid, p->mesh, cell);
}

static bool MostlyCovered(const Placer* p, int32_t cell)
{
    return p->grid->cells.data[cell].material.area > 0.5 * p->grid->side * p->grid->side;
}

static double SquaredDistance(kiriVec2 a, kiriVec2 b)
{
    kiriVec2 d = kiriVec2_Sub(a, b);
    return kiriVec2_Dot(d, d);
}

static bool Divide(Placer* p)
{
    return kiriRegions_Divide(&p->regions, p->memory, p->grid, p->mesh, p->field, p->sites.data, p->sites.count);
}

/* The free cell of the piece that is farthest from all sites, or KIRI_NONE. In a piece without a site all cells are
   equally far; relaxation makes up for where the first one goes. */
static int32_t FarthestCell(Placer* p)
{
    int32_t* distance = p->regions.distance.data;
    int32_t best = KIRI_NONE;
    for (int32_t i = 0; i < p->sites.count; ++i) {
        distance[p->sites.data[i].cell] = KIRI_NONE; /* taken */
    }
    for (int32_t c = 0; c < p->grid->cells.count; ++c) {
        bool isFree = distance[c] != KIRI_NONE && (p->allowed == NULL || p->allowed[c]);
        if (isFree && p->grid->cells.data[c].piece == p->piece) {
            bool farther = best == KIRI_NONE || distance[c] > distance[best];
            if (farther || (distance[c] == distance[best] && MostlyCovered(p, c) && !MostlyCovered(p, best))) {
                best = c;
            }
        }
    }
    return best;
}

static bool AddFarthest(Placer* p, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) {
        if (!Divide(p)) {
            return false;
        }
        int32_t cell = FarthestCell(p);
        if (cell == KIRI_NONE) {
            break;
        }
        if (!kiriArray_Push(p->memory, &p->sites, SiteIn(p, cell))) {
            return false;
        }
    }
    return true;
}

typedef struct Target {
    kiriMoments material;
    int32_t cell; /* of the region, nearest to its centroid */
    double distance;
} Target;

/* For every site the cell of its region that is nearest to the region's centroid. */
static void Aim(const Placer* p, Target* targets)
{
    const int32_t* owner = p->regions.owner.data;
    for (int32_t i = 0; i < p->sites.count; ++i) {
        targets[i] = (Target){ { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, KIRI_NONE, 0.0 };
    }
    for (int32_t c = 0; c < p->grid->cells.count; ++c) {
        if (owner[c] != KIRI_NONE) {
            kiriMoments_Add(&targets[owner[c]].material, &p->grid->cells.data[c].material);
        }
    }
    for (int32_t c = 0; c < p->grid->cells.count; ++c) {
        if (owner[c] != KIRI_NONE) {
            Target* target = &targets[owner[c]];
            kiriVec2 center = kiriMoments_Center(&target->material);
            double distance = SquaredDistance(kiriGrid_Middle(p->grid, p->mesh, c), center);
            bool nearer = target->cell == KIRI_NONE || distance < target->distance;
            if (nearer || (distance == target->distance && MostlyCovered(p, c) && !MostlyCovered(p, target->cell))) {
                target->cell = c;
                target->distance = distance;
            }
        }
    }
}

/* The centroid itself where it lies in the square of the target cell. */
static kiriSite SiteFor(const Placer* p, const Target* target)
{
    kiriVec2 center = kiriMoments_Center(&target->material);
    kiriVec2 off = kiriVec2_Sub(center, kiriGrid_Middle(p->grid, p->mesh, target->cell));
    double half = 0.5 * p->grid->side;
    kiriSite site = SiteIn(p, target->cell);
    if (fabs(off.x) < half && fabs(off.y) < half) {
        site.at = center;
    }
    return site;
}

/* Lloyd's iteration. Regions share no cell, so neither do the sites that move within them. On the way a site may lie
   anywhere in its cell: from middle to middle it would stick where its centroid is less than half a side away. */
static bool Relax(Placer* p, Target* targets)
{
    bool moved = true;
    for (int round = 0; round < 20 && moved; ++round) {
        if (!Divide(p)) {
            return false;
        }
        Aim(p, targets);
        moved = false;
        for (int32_t i = p->oldCount; i < p->sites.count; ++i) {
            kiriSite site = SiteFor(p, &targets[i]);
            moved = moved || SquaredDistance(site.at, p->sites.data[i].at) > 0.0001 * p->grid->side * p->grid->side;
            p->sites.data[i] = site;
        }
    }
    for (int32_t i = p->oldCount; i < p->sites.count; ++i) {
        p->sites.data[i] = SiteIn(p, p->sites.data[i].cell);
    }
    return true;
}

static bool TakeSitesOfPiece(Placer* p, const kiriSites* sites)
{
    for (int32_t i = 0; i < sites->count; ++i) {
        kiriSite site = sites->data[i];
        if (p->grid->cells.data[site.cell].piece == p->piece && !kiriArray_Push(p->memory, &p->sites, site)) {
            return false;
        }
    }
    p->oldCount = p->sites.count;
    return true;
}

static bool GiveNewSites(const Placer* p, kiriSites* sites)
{
    if (!kiriArray_Reserve(p->memory, sites, (int64_t)sites->count + p->sites.count - p->oldCount)) {
        return false;
    }
    for (int32_t i = p->oldCount; i < p->sites.count; ++i) {
        sites->data[sites->count++] = p->sites.data[i];
    }
    return true;
}

bool kiriFrames_Place(kiriSites* sites, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      kiriField* field, int32_t piece, const uint8_t* allowed, int32_t count)
{
    Placer p = { memory, grid, mesh, field, piece, allowed, { 0 }, 0, { { 0 }, { 0 }, { 0 }, { 0 } } };
    KIRI_ARRAY(Target) targets = { 0 };
    bool ok = TakeSitesOfPiece(&p, sites) && AddFarthest(&p, count) &&
              kiriArray_Resize(memory, &targets, p.sites.count) && Relax(&p, targets.data) && GiveNewSites(&p, sites);
    kiriArray_Release(memory, &targets);
    kiriArray_Release(memory, &p.sites);
    kiriRegions_Release(&p.regions, memory);
    return ok;
}

/* ---- State ------------------------------------------------------------------------------------------------------ */

void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea)
{
    kiriVec2 center = kiriMoments_Center(material);
    kiriMoments about = kiriMoments_About(material, center);
    kiriVec3 x = kiriFrame_Carry(frame, center);
    frame->velocity = kiriFrame_VelocityAt(frame, center);
    frame->x = x;
    frame->center = center;
    frame->area = material->area;
    frame->mass = densityPerArea * about.area;
    frame->inertia[0] = densityPerArea * about.uu;
    frame->inertia[1] = densityPerArea * about.uv;
    frame->inertia[2] = densityPerArea * about.vv;
}
