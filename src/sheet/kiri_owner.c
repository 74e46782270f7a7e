#include "kiri_owner.h"

/* While an update is at hand regions may be half done: then the frame that weighs most at the corners. */
static int32_t HeaviestAt(const kiriSheetData* sheet, int32_t triangle)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriSampleWeight heaviest = { KIRI_NONE, 0.0f };
    for (int corner = 0; corner < 3; ++corner) {
        kiriSpan span = skin->spans.data[sheet->mesh.triangles.data[triangle].vertex[corner]];
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            if (skin->weights.data[k].value > heaviest.value) {
                heaviest = skin->weights.data[k];
            }
        }
    }
    return heaviest.label != KIRI_NONE ? kiriSheet_FrameOf(sheet, heaviest.label) : KIRI_NONE;
}

static int32_t FrameAt(const kiriSheetData* sheet, int32_t triangle, kiriLatticePoint at)
{
    if (!kiriUpdate_IsFieldCurrent(sheet->update)) {
        return HeaviestAt(sheet, triangle);
    }
    int32_t cell = kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
    return cell == KIRI_NONE ? HeaviestAt(sheet, triangle) : sheet->regions.field.owner.data[cell];
}

int32_t kiriOwner_At(const kiriSheetData* sheet, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    int32_t frame = triangle != KIRI_NONE ? FrameAt(sheet, triangle, at) : KIRI_NONE;
    return frame != KIRI_NONE && !kiriSheet_IsGone(sheet, frame) ? frame : KIRI_NONE;
}

int32_t kiriOwner_OfNode(const kiriSheetData* sheet, int32_t node, bool isStaged)
{
    if (node == KIRI_NONE) {
        return KIRI_NONE;
    }
    int32_t frame = isStaged || kiriUpdate_IsFieldCurrent(sheet->update)
                        ? sheet->regions.field.owner.data[sheet->grid.nodeCell.data[node]]
                        : HeaviestAt(sheet, sheet->mesh.squares.nodes.data[node].triangle);
    return isStaged || !kiriSheet_IsGone(sheet, frame) ? frame : KIRI_NONE;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

typedef struct LineWork {
    kiriSheetData* sheet;
    bool isStaged;
} LineWork;

static bool AreLinked(const LineWork* work, int32_t a, int32_t b)
{
    const kiriLinks* links = &work->sheet->links;
    const kiriLink* list = work->isStaged ? links->next.data : links->links.data;
    int32_t count = work->isStaged ? links->next.count : links->links.count, i = kiriMin(a, b), j = kiriMax(b, a);
    for (int32_t k = 0; k < count; ++k) {
        if (list[k].i == i && list[k].j == j) {
            return true;
        }
    }
    return false;
}

/* At a point of the line where `frame` begins: those that end there and are linked to it have a neighbour beyond their
   end. Returns whether there are any: then it has one as well. */
static bool CloseEnds(const LineWork* work, int32_t frame, double at)
{
    bool any = false;
    for (int32_t k = 0; k < work->sheet->lineShares.count; ++k) {
        kiriLineShare* share = &work->sheet->lineShares.data[k];
        if (share->ends[1] == at && share->frame != frame && AreLinked(work, share->frame, frame)) {
            share->open[1] = false;
            any = true;
        }
    }
    return any;
}

static kiriLineShare* FindShare(const LineWork* work, int32_t frame)
{
    for (int32_t k = 0; k < work->sheet->lineShares.count; ++k) {
        if (work->sheet->lineShares.data[k].frame == frame) {
            return &work->sheet->lineShares.data[k];
        }
    }
    return NULL;
}

/* `other` is the frame on the other side, which takes half of a load, or KIRI_NONE, or the same. */
static bool AddPart(const LineWork* work, int32_t frame, int32_t other, const kiriLinePart* part)
{
    double a = part->from, b = part->to, length = b - a;
    bool isShared = other != KIRI_NONE && other != frame, isAlone = !isShared || !AreLinked(work, frame, other);
    double loaded = isShared ? 0.5 : 1.0;
    kiriLineShare* share = FindShare(work, frame);
    if (share == NULL || share->ends[1] != a) {
        bool isOpen = !CloseEnds(work, frame, a);
        kiriLineShare none = { frame, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, { a, b }, { isOpen, true } };
        if (share == NULL && !kiriArray_Push(work->sheet->memory, &work->sheet->lineShares, none)) {
            return false;
        }
        share = FindShare(work, frame);
    }
    share->length += length;
    share->first += 0.5 * length * (a + b);
    share->second += length * (a * a + a * b + b * b) / 3.0;
    share->alone += isAlone ? length : 0.0;
    share->load += loaded * length;
    share->firstLoad += loaded * 0.5 * length * (a + b);
    share->ends[1] = b;
    share->open[1] = true;
    return true;
}

bool kiriOwner_FindShares(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, bool isStaged)
{
    const LineWork work = { sheet, isStaged };
    sheet->lineShares.count = 0;
    bool ok = kiriLine_Trace(&sheet->line, sheet->memory, &sheet->mesh, from, to);
    for (int32_t k = 0; ok && k < sheet->line.parts.count; ++k) {
        const kiriLinePart* part = &sheet->line.parts.data[k];
        int32_t left = kiriOwner_OfNode(sheet, part->node[0], isStaged);
        int32_t right = kiriOwner_OfNode(sheet, part->node[1], isStaged);
        if (left != KIRI_NONE) {
            ok = AddPart(&work, left, right, part);
        }
        if (ok && right != KIRI_NONE && right != left) {
            ok = AddPart(&work, right, left, part);
        }
    }
    return ok;
}
