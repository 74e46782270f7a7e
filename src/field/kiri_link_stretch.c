/* Stretches of border, face by face, and the links they make. */
#include "kiri_link_work.h"

#include "../core/kiri_sort.h"

#include <string.h>

/* In items of the budget: a link, and a face of its stretch. */
enum { LINK_ITEMS = 80, STRETCH_FACE_ITEMS = 5 };

kiriBorderSide kiriBorder_SideOf(const kiriBorder* border, int32_t face)
{
    KIRI_ASSERT(face >= 0 && face < border->grid->faces.count);
    const kiriFace* f = &border->grid->faces.data[face];
    const int32_t* owner = border->regions->field.owner.data;
    int32_t low = owner[f->cell[0]] < owner[f->cell[1]] ? 0 : 1;
    KIRI_ASSERT(f->cell[0] != KIRI_NONE && owner[f->cell[low]] != KIRI_NONE && owner[f->cell[0]] != owner[f->cell[1]]);
    kiriBorderSide side = { f->cell[low],     f->cell[1 - low],     owner[f->cell[low]], owner[f->cell[1 - low]],
                            kiriFace_Axis(f), low == 0 ? 1.0 : -1.0 };
    return side;
}

bool kiriBorder_IsFaceBefore(const void* context, int32_t a, int32_t b)
{
    const kiriBorder* border = context;
    const kiriCell* cells = border->grid->cells.data;
    const kiriFace *f = &border->grid->faces.data[a], *g = &border->grid->faces.data[b];
    const kiriCell *fHigh = &cells[f->cell[1]], *gHigh = &cells[g->cell[1]];
    if (fHigh->square != gHigh->square) {
        return fHigh->square < gHigh->square;
    }
    if (kiriFace_Axis(f) != kiriFace_Axis(g)) {
        return kiriFace_Axis(f) < kiriFace_Axis(g);
    }
    int32_t fLow = cells[f->cell[0]].triangle, gLow = cells[g->cell[0]].triangle;
    return fLow != gLow ? fLow < gLow : fHigh->triangle < gHigh->triangle;
}

/* ---- Stretches -------------------------------------------------------------------------------------------------- */

/* Adds the faces of `cell` that continue the stretch of `from`. */
static bool GatherFacesAt(const kiriBorder* border, const kiriBorderSide* from, int32_t cell, kiriFaceMark mark,
                          kiriFaceMark next)
{
    KIRI_ASSERT(cell >= 0 && cell < border->regions->onBorder.count);
    const kiriGrid* grid = border->grid;
    bool may = border->regions->onBorder.data[cell] && border->regions->field.owner.data[cell] == from->i;
    for (int32_t f = may ? grid->cells.data[cell].firstFace : KIRI_NONE; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        if (border->work->marks.data[f] == mark) {
            kiriBorderSide side = kiriBorder_SideOf(border, f);
            bool sameWay = side.axis == from->axis && side.sign == from->sign;
            if (side.x == cell && side.i == from->i && side.j == from->j && (sameWay || mark != KIRI_FACE_BENT) &&
                kiriGrid_AreNear(grid, side.y, from->y)) {
                border->work->marks.data[f] = (uint8_t)next;
                if (!kiriArray_Push(border->memory, &border->work->stretch, f)) {
                    return false;
                }
            }
        }
        f = kiriFace_Next(face, cell);
    }
    return true;
}

/* The connected stretch of faces around one that have its mark, in order; their mark becomes `next`. */
static bool GatherStretch(const kiriBorder* border, int32_t face, kiriFaceMark next)
{
    const kiriGrid* grid = border->grid;
    kiriLinkWork* work = border->work;
    kiriFaceMark mark = (kiriFaceMark)work->marks.data[face];
    work->stretch.count = 0;
    work->marks.data[face] = (uint8_t)next;
    bool ok = kiriArray_Push(border->memory, &work->stretch, face);
    for (int32_t k = 0; ok && k < work->stretch.count; ++k) {
        kiriBorderSide side = kiriBorder_SideOf(border, work->stretch.data[k]);
        kiriSteps steps;
        kiriGrid_GetStepsTo(grid, side.x, 2, &steps);
        ok = GatherFacesAt(border, &side, side.x, mark, next);
        for (int32_t s = 0; ok && s < steps.end[1]; ++s) {
            ok = GatherFacesAt(border, &side, steps.data[s].cell, mark, next);
        }
    }
    kiriSort(work->stretch.data, work->stretch.count, kiriBorder_IsFaceBefore, border);
    return ok;
}

/* Of the k-th face of the stretch. */
static kiriStretch StretchOfFace(const kiriBorder* border, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < border->work->stretch.count);
    return kiriGrid_Stretch(border->grid, border->mesh, border->work->stretch.data[k]);
}

static int32_t AxisOfFace(const kiriBorder* border, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < border->work->stretch.count);
    return kiriFace_Axis(&border->grid->faces.data[border->work->stretch.data[k]]);
}

/* The vector sum of the faces, as normals from i to j; *sum is the sum of their widths. */
static kiriVec2 SumNormals(const kiriBorder* border, double* sum)
{
    double n[2] = { 0.0, 0.0 };
    *sum = 0.0;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        double width = StretchOfFace(border, k).width;
        kiriBorderSide side = kiriBorder_SideOf(border, border->work->stretch.data[k]);
        n[side.axis] += side.sign * width;
        *sum += width;
    }
    return kiriVec2_Make(n[0], n[1]);
}

/* ---- One link --------------------------------------------------------------------------------------------------- */

/* Centroid and second moment along the tangent; a face counts by its width as seen along the normal. */
static void SetMoments(const kiriBorder* border, kiriLink* link)
{
    double normal[2] = { link->normal.x, link->normal.y };
    double total = 0.0;
    kiriVec2 first = { 0.0, 0.0 };
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriStretch face = StretchOfFace(border, k);
        double weight = face.width * fabs(normal[AxisOfFace(border, k)]);
        total += weight;
        first = kiriVec2_Add(first, kiriVec2_Scale(weight, face.middle));
    }
    link->centroid = kiriVec2_Scale(1.0 / total, first);
    link->moment = 0.0;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriStretch face = StretchOfFace(border, k);
        /* The side's direction along the tangent is as its normal along the normal. */
        double share = fabs(normal[AxisOfFace(border, k)]);
        double s = kiriVec2_Dot(kiriVec2_Sub(face.middle, link->centroid), link->tangent);
        link->moment += share * (face.width * s * s + face.moment * share * share);
    }
}

/* About the centroid of the link. */
static void SetSpread(const kiriBorder* border, kiriLink* link)
{
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriStretch face = StretchOfFace(border, k);
        kiriBorderSide side = kiriBorder_SideOf(border, border->work->stretch.data[k]);
        kiriVec2 arm = kiriVec2_Sub(face.middle, link->centroid);
        double along = side.sign * face.width;
        kiriVec2 normal = { side.axis == 0 ? along : 0.0, side.axis == 0 ? 0.0 : along };
        link->spread[0] = kiriVec2_Add(link->spread[0], kiriVec2_Scale(arm.x, normal));
        link->spread[1] = kiriVec2_Add(link->spread[1], kiriVec2_Scale(arm.y, normal));
    }
}

/* A way from site i to site j. */
typedef struct SitesWay {
    int32_t length;
    kiriVec2 crossing;
    int32_t overFaces; /* the shortest over a face: its length, */
    int32_t cell[2];   /* the cells beside the face, of regions i and j, */
    kiriVec2 over;     /* and its middle */
} SitesWay;

/* Ways by the diagonal and knight steps from `cell` over the border into region `to`. */
static void TryLongSteps(const kiriBorder* border, int32_t cell, int32_t to, SitesWay* way)
{
    const kiriGrid* grid = border->grid;
    const kiriField* field = &border->regions->field;
    kiriSteps steps;
    kiriGrid_GetSteps(grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        if (field->owner.data[step.cell] == to) {
            int32_t length = field->distance.data[cell] + step.length + field->distance.data[step.cell];
            if (length < way->length) {
                kiriVec2 a = kiriGrid_Middle(grid, border->mesh, cell);
                kiriVec2 b = kiriGrid_Middle(grid, border->mesh, step.cell);
                way->length = length;
                way->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
            }
        }
    }
}

static SitesWay ShortestWay(const kiriBorder* border)
{
    const int32_t* distance = border->regions->field.distance.data;
    SitesWay way = { KIRI_FAR, { 0.0, 0.0 }, KIRI_FAR, { KIRI_NONE, KIRI_NONE }, { 0.0, 0.0 } };
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        int32_t face = border->work->stretch.data[k];
        kiriBorderSide side = kiriBorder_SideOf(border, face);
        int32_t length = distance[side.x] + KIRI_UNIT + distance[side.y];
        if (length < way.overFaces) {
            way.overFaces = length;
            way.cell[0] = side.x;
            way.cell[1] = side.y;
            way.over = StretchOfFace(border, k).middle;
        }
        TryLongSteps(border, side.x, side.j, &way);
        TryLongSteps(border, side.y, side.i, &way);
    }
    if (way.overFaces <= way.length) {
        way.length = way.overFaces;
        way.crossing = way.over;
    }
    return way;
}

/* Lengths on the grid exceed true ones by up to 3 %, and by parts of a side at both ends: only where the true way
   cannot be told they are taken, and where they are not clearly longer the way is straight. */
static kiriWay GridWay(const kiriBorder* border, const kiriLink* link, const SitesWay* sites)
{
    kiriVec2 a = border->sites[link->i].at, b = border->sites[link->j].at;
    double straight = kiriVec2_Length(kiriVec2_Sub(b, a));
    kiriWay way;
    way.length = sites->length * (border->grid->side / KIRI_UNIT);
    way.turnCount = 1;
    way.turn[0] = sites->crossing;
    if (way.length < 1.08 * straight + 0.5 * border->grid->side) {
        way.length = straight;
        way.turnCount = 0;
    }
    return way;
}

/* The crossing is half-way: there both sites are as far. */
static void SetLength(const kiriBorder* border, kiriLink* link, const kiriLinkEnds* ends)
{
    kiriVec2 a = border->sites[link->i].at, b = border->sites[link->j].at;
    SitesWay sites = ShortestWay(border);
    kiriWay way;
    bool found = kiriBorder_FindWay(border, link, ends, sites.cell, sites.over, &way);
    way = found ? way : GridWay(border, link, &sites);
    link->length = way.length;
    link->crossing = found || way.turnCount == 0 ? kiriWay_At(&way, a, b, 0.5 * way.length) : way.turn[0];
    link->span = way.turnCount == 0 ? kiriVec2_Sub(b, a) : kiriVec2_Scale(link->length, link->normal);
    double least = 0.1 * border->grid->side;
    link->length = kiriMax(link->length, least);
}

/* From the stretch at hand. */
static bool AddLink(const kiriBorder* border, bool bent)
{
    int32_t lowest = border->work->stretch.data[0];
    kiriBorderSide side = kiriBorder_SideOf(border, lowest);
    double sum;
    kiriVec2 normal = SumNormals(border, &sum);
    kiriNewLink link;
    memset(&link, 0, sizeof(link));
    link.face = lowest;
    link.link.i = side.i;
    link.link.j = side.j;
    link.link.width = kiriVec2_Length(normal);
    link.link.normal = kiriVec2_Scale(1.0 / link.link.width, normal);
    link.link.tangent = kiriVec2_Make(-link.link.normal.y, link.link.normal.x);
    link.link.sum = normal;
    SetMoments(border, &link.link);
    link.ends = kiriBorder_FindEnds(border, &link.link, bent);
    link.isOld = kiriBorder_IsUntouched(border, &link.ends);
    if (link.isOld) {
        return kiriArray_Push(border->memory, &border->work->made, link);
    }
    if (!bent) {
        kiriBorder_MakeExact(border, &link.link, &link.ends);
    }
    SetSpread(border, &link.link);
    SetLength(border, &link.link, &link.ends);
    kiriLink_SetOuter(&link.link, &link.ends);
    return kiriArray_Push(border->memory, &border->work->made, link);
}

/* ---- All links of a stretch -------------------------------------------------------------------------------------- */

/* A border that turns back on itself, around the tip of a slit for instance, loses its width in the vector sum: it is
   split into stretches of one normal each. */
static bool SplitStretch(const kiriBorder* border)
{
    kiriLinkWork* work = border->work;
    if (!kiriArray_Resize(border->memory, &work->whole, work->stretch.count)) {
        return false;
    }
    for (int32_t k = 0; k < work->stretch.count; ++k) {
        work->whole.data[k] = work->stretch.data[k];
        work->marks.data[work->whole.data[k]] = KIRI_FACE_BENT;
    }
    for (int32_t k = 0; k < work->whole.count; ++k) {
        int32_t face = work->whole.data[k];
        if (work->marks.data[face] == KIRI_FACE_BENT &&
            !(GatherStretch(border, face, KIRI_FACE_PASSED) && AddLink(border, true))) {
            return false;
        }
    }
    return true;
}

bool kiriBorder_MakeLinksAt(const kiriBorder* border, int32_t face)
{
    double sum;
    if (!GatherStretch(border, face, KIRI_FACE_GATHERED)) {
        return false;
    }
    border->work->due += STRETCH_FACE_ITEMS * (int64_t)border->work->stretch.count + LINK_ITEMS;
    bool bent = kiriVec2_Length(SumNormals(border, &sum)) < 0.5 * sum;
    return bent ? SplitStretch(border) : AddLink(border, false);
}
