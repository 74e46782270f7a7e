#include "kiri_sheet_site.h"
#include "kiri_piece.h"
#include "kiri_tear.h"
#include "../core/kiri_array.h"
#include "../field/kiri_site.h"

#include <math.h>

typedef struct SeverWork {
    kiriSheetData* sheet;
    kiriSevered* severed;
    int32_t pin;
    bool isStaged;
    kiriVec2 from, along, left; /* start of the line, m, local; unit vectors */
    double length;
    const kiriLink* links;
    int32_t linkCount;
} SeverWork;

static kiriVec2 SiteOf(const SeverWork* work, int32_t frame)
{
    return work->isStaged ? work->sheet->update->placing.sites.data[frame].at : work->sheet->frames.data[frame].site.at;
}

/* Returns true if the segment between the sites of a link crosses the line. *t is the position on the line, *width the
   width of the link projected onto the line; both relative to the length of the line. */
static bool IsAcross(const SeverWork* work, const kiriLink* link, double* t, double* width)
{
    kiriVec2 a = kiriVec2_Sub(SiteOf(work, link->i), work->from), b = kiriVec2_Sub(SiteOf(work, link->j), work->from);
    double before = kiriVec2_Dot(a, work->left), behind = kiriVec2_Dot(b, work->left);
    if (!(before * behind < 0.0)) {
        return false;
    }
    double share = before / (before - behind);
    kiriVec2 crossing = kiriVec2_AddScaled(kiriVec2_Scale(1.0 - share, a), share, b);
    *t = kiriVec2_Dot(crossing, work->along) / work->length;
    *width = link->width * fabs(kiriVec2_Dot(link->normal, work->left)) / work->length;
    return *t > 0.0 && *t < 1.0 && *width > 0.0;
}

/* Adds a severed link. `part` and `held` are in [0, 1]. */
static bool AddSevered(const SeverWork* work, int32_t link, double part, double held)
{
    KIRI_ASSERT(link >= 0 && link < work->linkCount);
    kiriSeveredLink severed = { work->pin, link, part, held };
    return kiriArray_Push(work->sheet->memory, work->severed, severed);
}

/* Adds a stretch of the line around t to the share of frame `to`. */
static bool AddAcross(const SeverWork* work, int32_t to, const kiriLineShare* own, double t, double length)
{
    const kiriLineShare none = {
        to, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, { own->ends[0], own->ends[1] }, { own->open[0], own->open[1] }
    };
    kiriLineShare* share = kiriOwner_ShareOf(work->sheet, &none);
    if (share == NULL) {
        return false;
    }
    t = kiriMin(own->ends[1] - 0.5 * length, t);
    t = kiriMax(own->ends[0] + 0.5 * length, t);
    share->length += length;
    share->first += length * t;
    share->second += length * (t * t + length * length / 12.0);
    share->load += length;
    share->firstLoad += length * t;
    share->ends[0] = kiriMin(own->ends[0], share->ends[0]);
    share->ends[1] = kiriMax(own->ends[1], share->ends[1]);
    return true;
}

/* Distributes a share whose other side has no linked frame to the frames across the line, by widths of links. */
static bool SpreadShare(const SeverWork* work, kiriLineShare own)
{
    double sum = 0.0, t, width;
    KIRI_TIMES(k, work->linkCount) {
        const kiriLink* link = &work->links[k];
        bool isOwn = link->i == own.frame || link->j == own.frame; /* a fold beside a clamp turns freely */
        sum += isOwn && link->fold == 0 && IsAcross(work, link, &t, &width) ? width : 0.0;
    }
    double spread = kiriMin(own.alone, sum);
    KIRI_TIMES_WHILE(spread > 0.0, k, work->linkCount) {
        const kiriLink* link = &work->links[k];
        bool isOwn = link->i == own.frame || link->j == own.frame;
        if (isOwn && link->fold == 0 && IsAcross(work, link, &t, &width)) {
            int32_t other = link->i + link->j - own.frame;
            if (!AddAcross(work, other, &own, t, spread * width / sum) || !AddSevered(work, k, spread / sum, 0.0)) {
                return false;
            }
        }
    }
    return true;
}

/* Severs the link of two regions whose common border the line follows: both already have it in their shares. */
static bool SeverBorder(const SeverWork* work, const kiriLinePart* part)
{
    int32_t left = kiriOwner_OfNode(work->sheet, part->node[0], work->isStaged);
    int32_t right = kiriOwner_OfNode(work->sheet, part->node[1], work->isStaged);
    int32_t i = kiriMin(left, right), j = kiriMax(right, left);
    KIRI_TIMES_WHILE(i != KIRI_NONE && i != j, k, work->linkCount) {
        double t, width;
        if (work->links[k].i == i && work->links[k].j == j && IsAcross(work, &work->links[k], &t, &width)) {
            return AddSevered(work, k, (part->to - part->from) / width, 0.0);
        }
    }
    return true;
}

/* Holds the links that end at the line from inside, at an edge of the material. They run along the clamped edge, which
   neither curls nor twists, and the clamp has the curvature across it. */
static bool HoldEdges(const SeverWork* work)
{
    const double near = 0.01 * work->sheet->grid.side;
    KIRI_TIMES(k, work->linkCount) {
        const kiriLink* link = &work->links[k];
        for (int32_t end = -1; end <= 1; end += 2) {
            kiriVec2 at = kiriVec2_AddScaled(link->centroid, 0.5 * end * link->width, link->tangent);
            kiriVec2 off = kiriVec2_Sub(at, work->from);
            double t = kiriVec2_Dot(off, work->along) / work->length;
            double way = end * kiriVec2_Dot(kiriVec2_Sub(at, link->crossing), link->tangent);
            bool isOuter = way > 0.0 && fabs(way - link->outer - link->beyond) < near;
            if (isOuter && t >= 0.0 && t <= 1.0 && fabs(kiriVec2_Dot(off, work->left)) < near &&
                !AddSevered(work, k, 0.0, 1.0)) {
                return false;
            }
        }
    }
    return true;
}

bool kiriSever_Across(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, int32_t pin, bool isStaged,
                      kiriSevered* severed)
{
    kiriVec2 a = kiriMesh_Local(&sheet->mesh, from), way = kiriVec2_Sub(kiriMesh_Local(&sheet->mesh, to), a);
    double length = kiriVec2_Length(way);
    kiriVec2 along = kiriVec2_Scale(1.0 / length, way);
    const SeverWork work = { sheet,
                             severed,
                             pin,
                             isStaged,
                             a,
                             along,
                             kiriVec2_Left(along),
                             length,
                             isStaged ? sheet->links.next.data : sheet->links.links.data,
                             isStaged ? sheet->links.next.count : sheet->links.links.count };
    bool ok = true;
    if (sheet->settings.mechanics.model == KIRI_MODEL_POINTS) {
        return true; /* no links */
    }
    int32_t own = sheet->lineShares.count;
    KIRI_EACH_WHILE(ok, const kiriLinePart, part, sheet->line.parts) {
        ok = SeverBorder(&work, part);
    }
    KIRI_TIMES_WHILE(ok, k, own) {
        ok = SpreadShare(&work, sheet->lineShares.data[k]);
    }
    return ok && HoldEdges(&work);
}

/* ---- Existing sites ---- */

static bool RecordMove(kiriSheetData* sheet, int32_t frame, int32_t was)
{
    kiriSiteMove move = { frame, was };
    return kiriArray_Push(sheet->memory, &sheet->update->placing.moves, move);
}

static bool AddSite(kiriSheetData* sheet, kiriSite site)
{
    return kiriArray_Push(sheet->memory, &sheet->update->placing.sites, site) &&
           RecordMove(sheet, sheet->update->placing.sites.count - 1, KIRI_NONE);
}

/* Finds the cell of an existing site and flags it as taken. Cells only ever split, so sites in different cells stay in
   different cells; if rounding breaks this, the later site takes a free cell of its square. Returns false if none is
   free, which only a corrupt save can cause. */
static bool Relocate(kiriSheetData* sheet, int32_t frame)
{
    KIRI_ASSERT_HAS(sheet->frames, frame);
    kiriPlacingWork* placing = &sheet->update->placing;
    int32_t cell = kiriGrid_CellAround(&sheet->grid, sheet->frames.data[frame].anchor);
    if (placing->flags.data[cell]) {
        cell = sheet->grid.squareCell.data[sheet->grid.cells.data[cell].square];
        while (placing->flags.data[cell] && sheet->grid.cells.data[cell].next != KIRI_NONE) {
            cell = sheet->grid.cells.data[cell].next;
        }
    }
    if (placing->flags.data[cell]) {
        return false;
    }
    placing->flags.data[cell] = 1;
    placing->sites.data[frame].cell = cell;
    return true;
}

/* Sets or clears the flags of squares with sites whose cells changed. Sites conflict only within a square, so only the
   sites of these squares are located again. Returns true if there is such a square. */
static bool FlagSquares(kiriSheetData* sheet, uint8_t flag)
{
    const kiriGridChanges* changes = &sheet->grid.changes;
    int32_t gone = changes->gone.count, steps = gone + changes->steps.count;
    bool any = false;
    KIRI_TIMES(i, steps + changes->material.count) {
        int32_t cell = i < gone    ? changes->gone.data[i]
                       : i < steps ? changes->steps.data[i - gone]
                                   : changes->material.data[i - steps].cell;
        int32_t frame = cell < sheet->regions.siteAt.count ? sheet->regions.siteAt.data[cell] : KIRI_NONE;
        if (frame != KIRI_NONE) {
            int32_t square = kiriSquares_At(&sheet->mesh.squares, sheet->frames.data[frame].anchor);
            sheet->update->placing.flags.data[square] = flag;
            any = true;
        }
    }
    return any;
}

/* Adds a move for each frame whose site may have to be located again: all frames if regions are rebuilt. */
static bool CollectMoves(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    bool any = u->isScratch || FlagSquares(sheet, 1), ok = true;
    KIRI_EACH_INDEX_WHILE(ok && any, f, sheet->frames) {
        if (u->isScratch) {
            ok = RecordMove(sheet, f, KIRI_NONE);
        } else if (u->placing.flags.data[kiriSquares_At(&sheet->mesh.squares, sheet->frames.data[f].anchor)]) {
            ok = RecordMove(sheet, f, u->placing.sites.data[f].cell);
        }
    }
    if (!u->isScratch) {
        FlagSquares(sheet, 0);
    }
    return ok;
}

bool kiriSites_Relocate(kiriSheetData* sheet)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    placing->moves.count = placing->movesSeen = 0;
    if (sheet->frames.count == 0) { /* a new sheet: its def may give sites */
        bool ok = true;
        KIRI_EACH_INDEX_WHILE(ok, i, placing->sites) {
            ok = RecordMove(sheet, i, KIRI_NONE);
        }
        return ok;
    }
    /* Flags of squares or cells. All are 0 between uses, so a use costs only the flags that it sets. */
    int32_t squares = sheet->mesh.squares.columns * sheet->mesh.squares.rows;
    int32_t most = kiriMax(sheet->grid.cells.count, squares), kept = 0, found = 0;
    if (!kiriArray_Reserve(sheet->memory, &placing->flags, most)) {
        return false;
    }
    kiriArray_Extend(&placing->flags, most, 0);
    if (!CollectMoves(sheet)) {
        return false;
    }
    while (found < placing->moves.count && Relocate(sheet, placing->moves.data[found].frame)) {
        ++found;
    }
    bool ok = found == placing->moves.count;
    KIRI_TIMES(m, found) {
        kiriSiteMove move = placing->moves.data[m];
        placing->flags.data[placing->sites.data[move.frame].cell] = 0;
        if (placing->sites.data[move.frame].cell != move.was) {
            placing->moves.data[kept++] = move;
        }
    }
    placing->moves.count = kept;
    return ok;
}

/* ---- Tears ----

   The nearest site on each side of a tear goes with its tip, and to the end of a cut in a sheet that can tear: so the way
   on is a border of regions, and the energy that is measured there does not depend on how the other sites lie. */

#define PAIR_REACH 0.25 /* spacings from the way */
#define PAIR_LAG 0.4    /* spacings behind the tip, at most */
#define PAIR_RANGE 1.5  /* spacings from the tip within which sites are taken */

/* Returns the site nearest to a place on one side of the tip that may move, or KIRI_NONE. Sites close together jam. */
static int32_t SiteBeside(const kiriSheetData* sheet, const kiriSlitEnd* end, kiriVec2 at, int32_t piece, double side,
                          double range)
{
    int32_t nearest = KIRI_NONE;
    KIRI_EACH_INDEX(f, sheet->frames) {
        kiriVec2 site = sheet->update->placing.sites.data[f].at;
        double d = kiriVec2_Distance(site, at);
        double off = side * kiriVec2_Cross(end->along, kiriVec2_Sub(site, end->at));
        bool isThere = sheet->layout.framePiece.data[f] == piece && off > 0.0;
        nearest = isThere && d < range && !sheet->frames.data[f].held ? f : nearest;
        range = nearest == f ? d : range;
    }
    return nearest;
}

/* Returns true if the site lies in the material, and no site but two is in its cell or less than a square away. */
static bool IsFree(const kiriSheetData* sheet, const kiriSite* site, const int32_t except[2])
{
    bool isFree = site->cell != KIRI_NONE;
    KIRI_EACH_INDEX_WHILE(isFree, f, sheet->update->placing.sites) {
        const kiriSite* other = &sheet->update->placing.sites.data[f];
        isFree = f == except[0] || f == except[1] ||
                 (other->cell != site->cell && kiriVec2_Distance(other->at, site->at) > sheet->grid.side);
    }
    return isFree;
}

/* Puts the two sites beside a tip, unless they are there. */
static bool MovePair(kiriSheetData* sheet, const kiriSlitEnd* end, int32_t piece)
{
    double spacing = kiriTears_Spacing(sheet, piece), reach = kiriMax(PAIR_REACH * spacing, sheet->grid.side);
    int32_t frames[2];
    kiriSite pair[2];
    KIRI_ASSERT_HAS(sheet->layout.pieces, piece);
    bool isFar = false, ok = true;
    KIRI_TIMES(k, 2) {
        double side = k == 0 ? 1.0 : -1.0;
        pair[k] = kiriSlit_SiteBeside(&sheet->grid, end, side * reach);
        frames[k] = SiteBeside(sheet, end, pair[k].at, piece, side, PAIR_RANGE * spacing);
        if (frames[k] == KIRI_NONE) {
            return true;
        }
        kiriVec2 way = kiriVec2_Sub(pair[k].at, sheet->update->placing.sites.data[frames[k]].at);
        isFar |= fabs(kiriVec2_Dot(way, end->along)) > PAIR_LAG * spacing ||
                 fabs(kiriVec2_Cross(way, end->along)) > 0.25 * reach;
    }
    bool isFree = pair[0].cell != pair[1].cell && IsFree(sheet, &pair[0], frames) && IsFree(sheet, &pair[1], frames);
    kiriPlacingWork* placing = &sheet->update->placing;
    KIRI_TIMES_WHILE(ok&& isFar&& isFree, k, 2) {
        bool hasMoved = false;
        KIRI_EACH(const kiriSiteMove, move, placing->moves) {
            hasMoved |= move->frame == frames[k];
        }
        ok = hasMoved || RecordMove(sheet, frames[k], placing->sites.data[frames[k]].cell);
        placing->sites.data[frames[k]] = pair[k];
    }
    return ok;
}

bool kiriSites_FollowTears(kiriSheetData* sheet)
{
    bool ok = true, isUpdate = sheet->update->cut.taken > 0; /* else a load makes the field again */
    KIRI_EACH_OF_WHILE(ok && isUpdate, kiriCutData, cut, sheet->cuts) {
        int32_t vertex = cut->tip.blade.vertex;
        kiriSlitEnd end;
        bool mayTear = kiriCut_IsTear(cut) || (cut->ended && kiriTears_MayGrow(sheet));
        if (mayTear && vertex != KIRI_NONE && kiriSlits_WayOn(&sheet->mesh, vertex, &end.along)) {
            end.at = kiriMesh_LocalOf(&sheet->mesh, vertex);
            end.along = kiriCut_IsTear(cut) ? cut->tears : end.along;
            end.cell = kiriGrid_CellOfVertex(&sheet->grid, vertex);
            ok = MovePair(sheet, &end, kiriPiece_OfVertex(sheet, vertex));
        }
    }
    return ok;
}

/* ---- Density of sites ---- */

int32_t kiriSites_MostIn(int32_t cells)
{
    return cells > 2 ? cells / 2 : 1;
}

bool kiriSites_IsCrowded(const kiriGrid* grid, const kiriSites* sites, const kiriSite* site, const int32_t* holder)
{
    double least = 0.999 * grid->side; /* points of the caller are floats */
    KIRI_EACH_STEP(step, grid, site->cell, KIRI_DIAGONAL) {
        int32_t other = holder[step.cell];
        if (other != KIRI_NONE) {
            kiriVec2 off = kiriVec2_Sub(sites->data[other].at, site->at);
            if (kiriVec2_Dot(off, off) < least * least) {
                return true;
            }
        }
    }
    return false;
}

/* ---- Pieces without a frame ---- */

/* Returns the area of the current piece. */
static double TakenArea(const kiriSheetData* sheet)
{
    const kiriPlacer* placer = &sheet->update->placing.placer;
    double area = 0.0;
    KIRI_EACH_LISTED(cell, placer->cells) {
        area += kiriGrid_Area(&sheet->grid, cell);
    }
    return area;
}

static bool IsCrumbTaken(const kiriSheetData* sheet)
{
    return sheet->settings.crumbArea > 0.0 && TakenArea(sheet) < sheet->settings.crumbArea;
}

kiriProgress kiriSites_RunPlacer(kiriSheetData* sheet, kiriQuota* quota)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    kiriProgress progress = kiriPlacer_Run(&placing->placer, &sheet->grid, quota);
    placing->isPlacing = progress == KIRI_MORE;
    return progress;
}

int32_t kiriSites_ShareOf(const kiriSheetData* sheet, double count)
{
    if (count == 0.0) {
        return 1;
    }
    int32_t whole = (int32_t)(count * (TakenArea(sheet) / sheet->update->placing.whole) + 0.5);
    return kiriMax(whole, 1);
}

/* Sites are denser around slit ends, where strains are large: `closeness` (c) times at an end, falling off to 1 at
   `reach` spacings. The spacing s = max(d / c, d r / reach) at distance r from an end takes 2 pi (reach / d)^2 ln c extra
   frames. If the count is open, they are added, if there is room for all. If it is given, the density is lower, to leave
   enough frames elsewhere; in a thin sheet the ends get no more than a share of the frames, because uneven sites lock.
   Measured with slit strips and a tongue (tests/test_estimate.c), and slits in squares (tests/test_layout.c). */
#define GIVEN_CLOSENESS 2.5
#define GIVEN_REACH 2.0
#define THIN 200.0       /* spacing by thickness */
#define THIN_SHARE 0.013 /* 0.3 by 2 pi GIVEN_REACH^2 ln GIVEN_CLOSENESS */
#define OPEN_CLOSENESS 3.0
#define OPEN_REACH 1.5
#define OPEN_FRAMES_AN_END 15.5
#define BETWEEN_PINS 0.6 /* spacings: a sheet between pins bends to and fro */

/* Most spacing of straight rows, in lengths at which bending stiffness and weight balance. Softer sheets fold along the rows:
   cotton that hangs by two corners collapses to a rope. */
#define ROW_SPACING 1.5

/* Returns the initial count of frames of the current piece, which has `own` frames. */
static int32_t FramesFor(const kiriSheetData* sheet, int32_t own)
{
    const kiriPlacingWork* placing = &sheet->update->placing;
    if (IsCrumbTaken(sheet)) {
        return 1;
    }
    int32_t most = kiriSites_MostIn(placing->placer.cells.count);
    if (sheet->settings.frameLength == 0.0) {
        int32_t share = kiriSites_ShareOf(sheet, placing->spread);
        int32_t left = placing->spread - placing->sites.count - (placing->pieces - 1); /* one for each later piece */
        left = kiriMax(left, 1);
        most = kiriMin(left, most);
        return kiriMin(share, most);
    }
    double even = TakenArea(sheet) / (sheet->settings.frameLength * sheet->settings.frameLength);
    double full = OPEN_CLOSENESS * OPEN_CLOSENESS * even;
    double count = even + OPEN_FRAMES_AN_END * placing->placer.ends.count;
    count = 0.5 + kiriMin(count, full);
    int32_t left = sheet->settings.maxFrames - placing->sites.count + own;
    most = kiriMin(left, most);
    return count < 1.0 || most < 1 ? 1 : count < most ? (int32_t)count : most;
}

/* Returns how much closer sites of `spacing` are to be around ends. */
static double ClosenessFor(const kiriSheetData* sheet, double spacing)
{
    double closeness = sheet->settings.frameLength > 0.0 ? OPEN_CLOSENESS : GIVEN_CLOSENESS;
    double most = 0.5 * spacing / sheet->grid.side; /* two squares apart */
    return kiriMin(closeness, kiriMax(most, 1.0));
}

/* Starts placing `count` frames, about `spacing` apart, in the current piece: in straight rows, or first in pairs at slit
   ends, at most half of them, then evenly. The slit ends are known, and none of the `own` sites of the piece stays. */
static bool StartPlacing(kiriSheetData* sheet, int32_t count, int32_t own, double spacing)
{
    kiriPlacer* placer = &sheet->update->placing.placer;
    bool isOpen = sheet->settings.frameLength > 0.0;
    bool isStiff = spacing <= ROW_SPACING * kiriStrain_BalanceLength(&sheet->settings.material);
    if (placer->ends.count == 0 && count > 1 && isStiff && sheet->settings.mechanics.model == KIRI_MODEL_LINKS) {
        int32_t room = sheet->settings.maxFrames - sheet->update->placing.sites.count + own;
        int32_t most = kiriSites_MostIn(placer->cells.count);
        most = isOpen ? kiriMin(room, most) : count;
        if (!kiriPlacer_PlaceRows(placer, &sheet->grid, count, kiriMax(count, most))) {
            return false;
        }
        if (placer->sites.count > 0) {
            return kiriPlacer_Start(placer, &sheet->grid, NULL, 0);
        }
    }
    double closeness = ClosenessFor(sheet, spacing), reach = isOpen ? OPEN_REACH : GIVEN_REACH;
    if (!isOpen && !sheet->settings.mechanics.planar && spacing > THIN * sheet->settings.material.thickness) {
        reach *= sqrt(kiriMin(THIN_SHARE * count / kiriMax(placer->ends.count, 1), 1.0));
    }
    placer->sites.count = 0;
    placer->closeness = closeness;
    placer->reach = closeness > 1.0 ? reach * spacing : 0.0;
    return kiriSlits_AddPairs(&placer->sites, &sheet->grid, &placer->ends, spacing / closeness, count / 2) &&
           kiriPlacer_Start(placer, &sheet->grid, NULL, count - placer->sites.count);
}

/* Finds a place for a pair of sites beside a pin: on each side of both ends of a line, in four directions from a point.
   Corners of the sheet have no room for one. */
static bool FindHoldEnd(const kiriSheetData* sheet, const kiriPinData* pin, int32_t k, kiriSlitEnd* end)
{
    const kiriGrid* grid = &sheet->grid;
    double spacing = sheet->settings.frameLength, inset = 0.5 * spacing / ClosenessFor(sheet, spacing);
    kiriVec2 from = kiriMesh_Local(grid->mesh, pin->at), to = kiriMesh_Local(grid->mesh, pin->to);
    kiriVec2 along = pin->type == KIRI_PIN_POINT ? kiriVec2_Make(k % 2, 1 - k % 2)
                                                 : kiriVec2_Normalize(kiriVec2_Sub(to, from));
    double side = k < 2 ? 1.0 : -1.0;
    end->along = kiriVec2_Scale(side, kiriVec2_Left(along));
    end->at = kiriVec2_AddScaled(k % 2 == 0 ? from : to, inset, end->along);
    end->cell = kiriGrid_CellAt(grid, kiriMesh_Snap(grid->mesh, end->at));
    return end->cell != KIRI_NONE && kiriSlit_SiteBeside(grid, end, inset).cell != KIRI_NONE &&
           kiriSlit_SiteBeside(grid, end, -inset).cell != KIRI_NONE;
}

#define LINE_ENDS 4 /* calls of FindHoldEnd */

bool kiriSites_MeetPins(kiriSheetData* sheet)
{
    double* length = &sheet->settings.frameLength;
    kiriSlitEnd end;
    bool meets = sheet->pins.count > 1;
    KIRI_TIMES_WHILE(!meets, k, LINE_ENDS * sheet->pins.count) {
        meets = FindHoldEnd(sheet, &sheet->pins.data[k / LINE_ENDS], k % LINE_ENDS, &end);
    }
    KIRI_EACH_WHILE(meets, const kiriFrameData, frame, sheet->frames) {
        meets = !frame->held;
    }
    if (meets && sheet->pins.count > 1) {
        *length = kiriMin(*length, kiriMax(BETWEEN_PINS * *length, 3.0 * sheet->grid.side));
    }
    return meets;
}

/* Adds the ends of pins that lie in the current piece to its slit ends. Fails on out of memory. */
static bool AddHoldEnds(kiriSheetData* sheet)
{
    kiriPlacer* placer = &sheet->update->placing.placer;
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        bool isFound = false;
        KIRI_TIMES_WHILE(!isFound, k, LINE_ENDS) {
            kiriSlitEnd end;
            bool isHere = false;
            if (FindHoldEnd(sheet, pin, k, &end)) {
                KIRI_EACH_LISTED_WHILE(!isHere, cell, placer->cells) {
                    isHere = cell == end.cell;
                }
            }
            if (isHere && !kiriArray_Push(sheet->memory, &placer->ends, end)) {
                return false;
            }
            isFound = isHere && pin->type == KIRI_PIN_POINT;
        }
    }
    return true;
}

/* Loads the piece of a cell, and its slit ends, into the placer. */
static kiriProgress TakePiece(kiriSheetData* sheet, int32_t cell, kiriQuota* cells)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    kiriPlacer* placer = &placing->placer;
    if (!placing->isTaking) {
        placing->search = (kiriSlitSearch){ 0 };
        if (!kiriPlacer_StartPiece(placer, &sheet->grid, cell)) {
            return KIRI_FAILED;
        }
    }
    kiriProgress progress = kiriPlacer_GoOnWithPiece(placer, &sheet->grid, cells);
    if (progress == KIRI_DONE) {
        progress = kiriSlits_FindEnds(&placer->ends, &placing->search, &sheet->grid, placer->cells.data,
                                      placer->cells.count, cells);
    }
    if (progress == KIRI_DONE && placing->isAfresh && !AddHoldEnds(sheet)) {
        return KIRI_FAILED;
    }
    placing->isTaking = progress == KIRI_MORE;
    return progress;
}

/* Returns the spacing of `count` frames in the current piece, away from slit ends, m. */
static double SpacingOf(const kiriSheetData* sheet, int32_t count)
{
    return sheet->settings.frameLength > 0.0 ? sheet->settings.frameLength : sqrt(TakenArea(sheet) / count);
}

/* Starts placing frames in the piece of an orphan, and marks its cells as done. */
static kiriProgress StartOrphan(kiriSheetData* sheet, int32_t cell, kiriQuota* cells)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    kiriProgress progress = TakePiece(sheet, cell, cells);
    if (progress != KIRI_DONE) {
        return progress;
    }
    KIRI_EACH_LISTED(at, placing->placer.cells) {
        placing->marks.data[at] = 1;
    }
    int32_t count = FramesFor(sheet, 0);
    placing->pieces -= placing->pieces > 0;
    return StartPlacing(sheet, count, 0, SpacingOf(sheet, count)) ? KIRI_DONE : KIRI_FAILED;
}

static bool IsAtPiece(const kiriSheetData* sheet)
{
    return sheet->update->placing.isTaking || sheet->update->placing.isPlacing;
}

kiriProgress kiriSites_PlaceInOrphans(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    for (; placing->at < sheet->regions.orphans.count; ++placing->at) {
        int32_t cell = sheet->regions.orphans.data[placing->at];
        if (!IsAtPiece(sheet) && placing->marks.data[cell]) {
            continue;
        }
        kiriProgress progress = placing->isPlacing ? KIRI_DONE : StartOrphan(sheet, cell, cells);
        progress = progress == KIRI_DONE ? kiriSites_RunPlacer(sheet, cells) : progress;
        if (progress != KIRI_DONE) {
            return progress;
        }
        KIRI_EACH(const kiriSite, site, placing->placer.sites) {
            if (!AddSite(sheet, *site)) {
                return KIRI_FAILED;
            }
        }
    }
    return KIRI_DONE;
}

bool kiriSites_ClearMarks(kiriSheetData* sheet, int32_t count)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    placing->at = 0;
    if (!kiriArray_Resize(sheet->memory, &placing->marks, count)) {
        return false;
    }
    kiriArray_Set(&placing->marks, 0);
    return true;
}

/* ---- Re-sampling ---- */

/* Returns the area over which the frame's weight exceeds rigidWeight, divided by rigidArea. Returns 0 if it is not more
   than in the new sheet. */
static double FrameRigidity(const kiriSheetData* sheet, int32_t frame)
{
    int64_t rigid = sheet->shape.rigid.data[frame];
    double square = sheet->grid.side * sheet->grid.side / 1099511627776.0; /* 2^40, see kiriShape.rigid */
    bool isMore = frame >= sheet->frames.count || rigid > sheet->frames.data[frame].rigidAtStart;
    return isMore ? (double)rigid * square / sheet->settings.rigidArea : 0.0;
}

/* Returns the squared size of a frame's region, divided by the largest that it may have. The size follows from the
   radius of gyration, so long regions count as large. A square is as large as its side. */
static double Largeness(const kiriSheetData* sheet, int32_t frame)
{
    if (sheet->settings.frameLength == 0.0) {
        return 0.0;
    }
    kiriMoments m = kiriTally_Moments(&sheet->regions.material.data[frame], kiriSheet_Extent(sheet));
    kiriMoments about = kiriMoments_About(&m, kiriMoments_Center(&m));
    /* 1.25 times the frame length, squared: sizes of regions vary. */
    double most = 1.5625 * sheet->settings.frameLength * sheet->settings.frameLength;
    return 6.0 * (about.uu + about.vv) / (most * m.area);
}

/* Returns the need of a frame for another one nearby: above 1 if it needs one. */
static double NeedOf(const kiriSheetData* sheet, int32_t frame)
{
    double rigidity = FrameRigidity(sheet, frame), largeness = Largeness(sheet, frame);
    return kiriMax(rigidity, largeness);
}

/* Marks the cells of the piece in which the weight of a rigid frame exceeds rigidWeight, or whose region is too
   large. */
static bool MarkRigidCells(kiriSheetData* sheet)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    if (!kiriArray_Resize(sheet->memory, &placing->allowed, sheet->grid.cells.count)) {
        return false;
    }
    int32_t last = KIRI_NONE; /* cache: consecutive cells are mostly of one region */
    bool isLarge = false;
    KIRI_EACH_LISTED(cell, placing->placer.cells) {
        int32_t owner = sheet->regions.field.owner.data[cell];
        kiriSpan span = sheet->shape.spans.data[cell];
        isLarge = owner == last ? isLarge : Largeness(sheet, owner) > 1.0;
        last = owner;
        placing->allowed.data[cell] = isLarge;
        KIRI_EACH_IN(k, span) {
            const kiriCellWeight* weight = &sheet->shape.weights.data[k];
            placing->allowed.data[cell] |= kiriCellWeight_Value(weight) > sheet->shape.rigidWeight &&
                                             FrameRigidity(sheet, weight->frame) > 1.0;
        }
    }
    return true;
}

/* Lists the frames and sites of the current piece. *old is true if a frame existed before this update. */
static bool TakeSitesOfPiece(kiriSheetData* sheet, bool* old)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    placing->placer.sites.count = placing->own.count = 0;
    *old = false;
    KIRI_EACH_LISTED(cell, placing->placer.cells) {
        int32_t frame = sheet->regions.siteAt.data[cell];
        if (frame != KIRI_NONE) {
            placing->marks.data[frame] = 1;
            *old = *old || frame < sheet->frames.count;
            if (!kiriArray_Push(sheet->memory, &placing->own, frame)) {
                return false;
            }
        }
    }
    kiriSort(placing->own.data, placing->own.count, NULL, NULL);
    bool ok = true;
    KIRI_EACH_LISTED_WHILE(ok, own, placing->own) {
        ok = kiriArray_Push(sheet->memory, &placing->placer.sites, placing->sites.data[own]);
    }
    return ok;
}

/* Returns the count of sites to add to the current piece. If all sites are new, they are placed again (isAgain), to be
   even: in the first round, and while more than a quarter of the frames need another. Areas shrink as the count grows;
   it grows by half at most. Otherwise adds one site for every two frames in need, because a new site also helps its
   neighbors. A crumb gets none. The limit is kiriSites_MostIn. */
static int32_t SitesToAdd(kiriSheetData* sheet, bool areNew)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    int32_t own = placing->own.count, most = kiriSites_MostIn(placing->placer.cells.count) - own,
            left = sheet->settings.maxFrames - placing->sites.count, needing = 0;
    double largest = 1.0;
    KIRI_TIMES(i, own) {
        double need = NeedOf(sheet, placing->own.data[i]);
        needing += need > 1.0;
        largest = kiriMax(need, largest);
    }
    most = kiriMin(left, most);
    if (placing->isAfresh && placing->isFirst) {
        int32_t count = FramesFor(sheet, own) - own;
        placing->isAgain = true;
        return kiriMax(count, 0);
    }
    placing->isAgain = (areNew || placing->isAfresh) && (placing->isFirst || needing > own / 4) && most > 0 &&
                       !IsCrumbTaken(sheet);
    double more = placing->isAgain ? own * (largest < 1.5 ? largest - 1.0 : 0.5) : 0.5 * needing + 0.5;
    more = kiriMax(1.0, more);
    return most < 1 || IsCrumbTaken(sheet) ? 0 : more < most ? (int32_t)more : most;
}

/* Starts adding sites to the current piece: evenly if all are placed again, otherwise in the marked cells. */
static bool AddToPiece(kiriSheetData* sheet)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    bool old;
    if (!MarkRigidCells(sheet) || !TakeSitesOfPiece(sheet, &old)) {
        return false;
    }
    int32_t more = SitesToAdd(sheet, !old);
    if (placing->isAgain) {
        int32_t count = placing->own.count + more;
        return StartPlacing(sheet, count, placing->own.count, SpacingOf(sheet, count));
    }
    placing->placer.known = &sheet->regions.field;
    return kiriPlacer_Start(&placing->placer, &sheet->grid, placing->allowed.data, more);
}

/* Stores the placed sites: they reuse the indices of sites that were placed again, then get new ones. A piece without a
   cell for one more stays unchanged. */
static bool GiveSites(kiriSheetData* sheet)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    bool ok = true, isAgain = placing->isAgain;
    int32_t next = isAgain ? 0 : placing->placer.oldCount;
    if (isAgain && placing->placer.sites.count <= placing->own.count) {
        return true;
    }
    KIRI_EACH_LISTED_WHILE(ok && isAgain, f, placing->own) {
        ok = RecordMove(sheet, f, placing->sites.data[f].cell);
        placing->sites.data[f] = placing->placer.sites.data[next++];
    }
    while (ok && next < placing->placer.sites.count) {
        ok = AddSite(sheet, placing->placer.sites.data[next++]);
    }
    return ok;
}

/* Returns true if the committed piece of the frame is a crumb; then it still is one. */
static bool IsOfCrumb(const kiriSheetData* sheet, int32_t frame)
{
    return frame < sheet->frames.count &&
           sheet->layout.pieces.data[sheet->layout.framePiece.data[frame]].area < sheet->settings.crumbArea;
}

bool kiriSites_MayBeFew(const kiriSheetData* sheet)
{
    bool mayBe = sheet->update->needsRebuild;
    KIRI_EACH_INDEX_WHILE(!mayBe && sheet->frames.count < sheet->settings.maxFrames, f, sheet->frames) {
        mayBe = NeedOf(sheet, f) > 1.0 && !IsOfCrumb(sheet, f);
    }
    return mayBe;
}

kiriProgress kiriSites_Resample(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    for (; placing->at < placing->marks.count && placing->sites.count < sheet->settings.maxFrames;
         ++placing->at) {
        bool needs = (placing->isAfresh && placing->isFirst) || NeedOf(sheet, placing->at) > 1.0;
        if (!IsAtPiece(sheet) &&
            (placing->marks.data[placing->at] || !needs || IsOfCrumb(sheet, placing->at))) {
            continue;
        }
        kiriProgress progress = KIRI_DONE;
        if (!placing->isPlacing) {
            progress = TakePiece(sheet, placing->sites.data[placing->at].cell, cells);
            progress = progress != KIRI_DONE || AddToPiece(sheet) ? progress : KIRI_FAILED;
        }
        progress = progress == KIRI_DONE ? kiriSites_RunPlacer(sheet, cells) : progress;
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!GiveSites(sheet)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}
