#include "kiri_sever.h"

#include "kiri_owner.h"

typedef struct SeverWork {
    kiriSheetData* sheet;
    kiriSevered* severed;
    int32_t pin;
    bool isStaged;
    kiriVec2 from, along, left; /* the line, local m; unit */
    double length;
    const kiriLink* links;
    int32_t linkCount;
} SeverWork;

static kiriVec2 SiteOf(const SeverWork* work, int32_t frame)
{
    return work->isStaged ? work->sheet->update->placing.sites.data[frame].at : work->sheet->frames.data[frame].site.at;
}

/* Does the way between the sites of a link cross the line? Then *t says where, and *width how much of the line its
   border is worth. */
static bool IsAcross(const SeverWork* work, const kiriLink* link, double* t, double* width)
{
    kiriVec2 a = kiriVec2_Sub(SiteOf(work, link->i), work->from), b = kiriVec2_Sub(SiteOf(work, link->j), work->from);
    double before = kiriVec2_Dot(a, work->left), behind = kiriVec2_Dot(b, work->left);
    if (!(before * behind < 0.0)) {
        return false;
    }
    double share = before / (before - behind);
    kiriVec2 crossing = kiriVec2_Add(kiriVec2_Scale(1.0 - share, a), kiriVec2_Scale(share, b));
    *t = kiriVec2_Dot(crossing, work->along) / work->length;
    *width = link->width * fabs(kiriVec2_Dot(link->normal, work->left)) / work->length;
    return *t > 0.0 && *t < 1.0 && *width > 0.0;
}

/* So much of a link, 0 to 1. */
static bool AddSevered(const SeverWork* work, int32_t link, double part)
{
    kiriSeveredLink severed = { work->pin, link, part };
    return kiriArray_Push(work->sheet->memory, work->severed, severed);
}

/* What frame `to` gets: a stretch of the line around t. */
static bool AddAcross(const SeverWork* work, int32_t to, const kiriLineShare* own, double t, double length)
{
    kiriLineShare* share = NULL;
    double low = own->ends[0] + 0.5 * length, high = own->ends[1] - 0.5 * length;
    kiriLineShare none = {
        to, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, { own->ends[0], own->ends[1] }, { own->open[0], own->open[1] }
    };
    for (int32_t k = 0; k < work->sheet->lineShares.count; ++k) {
        share = work->sheet->lineShares.data[k].frame == to ? &work->sheet->lineShares.data[k] : share;
    }
    if (share == NULL) {
        if (!kiriArray_Push(work->sheet->memory, &work->sheet->lineShares, none)) {
            return false;
        }
        share = &work->sheet->lineShares.data[work->sheet->lineShares.count - 1];
    }
    t = kiriMin(high, t);
    t = kiriMax(low, t);
    share->length += length;
    share->first += length * t;
    share->second += length * (t * t + length * length / 12.0);
    share->load += length;
    share->firstLoad += length * t;
    share->ends[0] = kiriMin(own->ends[0], share->ends[0]);
    share->ends[1] = kiriMax(own->ends[1], share->ends[1]);
    return true;
}

/* Gives what the line has within the region of a frame to those beyond it, by the widths of its links with them. */
static bool SpreadShare(const SeverWork* work, kiriLineShare own)
{
    double sum = 0.0, t, width;
    for (int32_t k = 0; k < work->linkCount; ++k) {
        const kiriLink* link = &work->links[k];
        bool isOwn = link->i == own.frame || link->j == own.frame;
        sum += isOwn && IsAcross(work, link, &t, &width) ? width : 0.0;
    }
    double spread = kiriMin(own.alone, sum);
    for (int32_t k = 0; spread > 0.0 && k < work->linkCount; ++k) {
        const kiriLink* link = &work->links[k];
        bool isOwn = link->i == own.frame || link->j == own.frame;
        if (isOwn && IsAcross(work, link, &t, &width)) {
            int32_t other = link->i == own.frame ? link->j : link->i;
            if (!AddAcross(work, other, &own, t, spread * width / sum) || !AddSevered(work, k, spread / sum)) {
                return false;
            }
        }
    }
    return true;
}

/* Where the line runs along a border, both sides have it as their own. */
static bool SeverBorder(const SeverWork* work, const kiriLinePart* part)
{
    int32_t left = kiriOwner_OfNode(work->sheet, part->node[0], work->isStaged);
    int32_t right = kiriOwner_OfNode(work->sheet, part->node[1], work->isStaged);
    int32_t i = kiriMin(left, right), j = kiriMax(right, left);
    for (int32_t k = 0; i != KIRI_NONE && i != j && k < work->linkCount; ++k) {
        double t, width;
        if (work->links[k].i == i && work->links[k].j == j && IsAcross(work, &work->links[k], &t, &width)) {
            return AddSevered(work, k, (part->to - part->from) / width);
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
                             { -along.y, along.x },
                             length,
                             isStaged ? sheet->links.next.data : sheet->links.links.data,
                             isStaged ? sheet->links.next.count : sheet->links.links.count };
    bool ok = true;
    if (sheet->settings.mechanics.model == KIRI_MODEL_POINTS) {
        return true; /* it has no links */
    }
    int32_t own = sheet->lineShares.count;
    for (int32_t k = 0; ok && k < sheet->line.parts.count; ++k) {
        ok = SeverBorder(&work, &sheet->line.parts.data[k]);
    }
    for (int32_t k = 0; ok && k < own; ++k) {
        ok = SpreadShare(&work, sheet->lineShares.data[k]);
    }
    return ok;
}
