/* The pattern of a matrix, and its symbolic factorisation: which blocks and panels there are. All numbers are whole. */
#include "../core/kiri_archive.h"

#include "kiri_matrix.h"

kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size)
{
    KIRI_ASSERT(size == 3 || size == 6 || size == 12);
    kiriMatrix* matrix = kiriMemory_AllocZeroed(memory, (int64_t)sizeof(kiriMatrix));
    if (matrix != NULL) {
        matrix->memory = memory;
        matrix->size = size;
        matrix->usesAvx = kiriMatrix_HasAvx();
    }
    return matrix;
}

void kiriMatrix_Destroy(kiriMatrix* matrix)
{
    if (matrix != NULL) {
        const size_t step = sizeof(kiriArrayHeader);
        for (size_t at = offsetof(kiriMatrix, graph); at + step <= sizeof(kiriMatrix); at += step) {
            kiriArray_Release(matrix->memory, (char*)matrix + at);
        }
        kiriMemory_Free(matrix->memory, matrix);
    }
}

/* ---- Blocks ---- */

/* Sums counts: start[c] becomes the end of list c. The lists are then filled from their ends. */
static void SumCounts(kiriIndices* start)
{
    KIRI_FROM_TO(c, 1, start->count) {
        start->data[c] += start->data[c - 1];
    }
}

/* Makes the lists of rows of each column from lists of columns of each row. Rows ascend. */
static bool Transpose(kiriMatrix* matrix, const kiriColumns* from, kiriColumns* to)
{
    if (!kiriArray_Resize(matrix->memory, &to->start, from->start.count) ||
        !kiriArray_Resize(matrix->memory, &to->row, from->row.count)) {
        return false;
    }
    kiriArray_Set(&to->start, 0);
    KIRI_EACH_LISTED(column, from->row) {
        to->start.data[column] += 1;
    }
    SumCounts(&to->start);
    for (int32_t r = matrix->count - 1, b = from->row.count - 1; r >= 0; --r) {
        for (; b >= from->start.data[r]; --b) {
            to->row.data[--to->start.data[from->row.data[b]]] = r;
        }
    }
    return true;
}

static void DropRepeats(kiriColumns* columns)
{
    int32_t kept = 0, b = 0, *start = columns->start.data, *rows = columns->row.data;
    KIRI_TIMES(c, columns->start.count - 1) {
        start[c] = kept;
        for (; b < start[c + 1]; ++b) {
            if (kept == start[c] || rows[b] != rows[kept - 1]) {
                rows[kept++] = rows[b];
            }
        }
    }
    start[columns->start.count - 1] = columns->row.count = kept;
}

/* Fills a lower pattern by the order of frames: blocks of pairs, and the diagonal. `rows` gets columns of each row. */
static bool FillPattern(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount, kiriColumns* pattern)
{
    kiriColumns* rows = &matrix->rows;
    if (!kiriArray_Resize(matrix->memory, &rows->start, (int64_t)matrix->count + 1) ||
        !kiriArray_Resize(matrix->memory, &rows->row, matrix->count + pairCount)) {
        return false;
    }
    int32_t *start = rows->start.data, *order = matrix->order.data;
    KIRI_TIMES(r, matrix->count) {
        start[r] = 1;
    }
    start[matrix->count] = 0;
    for (int64_t k = 0; k < pairCount; ++k) {
        KIRI_ASSERT_HAS(matrix->order, pairs[k].a);
        KIRI_ASSERT_HAS(matrix->order, pairs[k].b);
        start[kiriMax(order[pairs[k].a], order[pairs[k].b])] += 1;
    }
    SumCounts(&rows->start);
    for (int64_t k = 0; k < pairCount; ++k) {
        int32_t a = order[pairs[k].a], b = order[pairs[k].b];
        rows->row.data[--start[kiriMax(a, b)]] = kiriMin(a, b);
    }
    KIRI_TIMES(r, matrix->count) {
        rows->row.data[--start[r]] = r;
    }
    if (!Transpose(matrix, rows, pattern)) {
        return false;
    }
    DropRepeats(pattern);
    return true;
}

/* ---- Symbolic factorisation ---- */

/* Row r of the factor has all columns on the ways up the elimination tree from columns of the matrix's row r to r. The
   parent of a column is its first row below the diagonal (Liu 1986). Fails on out of memory, or on more than `most`
   blocks. */
static bool Eliminate(kiriMatrix* matrix, int64_t most)
{
    const kiriColumns* rows = &matrix->rows;
    kiriColumns* ways = &matrix->ways;
    int32_t *parent = matrix->parent.data, *mark = matrix->mark.data;
    kiriArray_Set(&matrix->parent, KIRI_NONE);
    kiriArray_Set(&matrix->mark, KIRI_NONE);
    ways->row.count = 0;
    KIRI_TIMES(r, matrix->count) {
        ways->start.data[r] = ways->row.count;
        mark[r] = r;
        bool isDone = kiriArray_Push(matrix->memory, &ways->row, r);
        KIRI_FROM_TO(b, rows->start.data[r], rows->start.data[r + 1]) {
            for (int32_t c = rows->row.data[b]; isDone && mark[c] != r; c = parent[c]) {
                mark[c] = r;
                parent[c] = parent[c] == KIRI_NONE ? r : parent[c];
                isDone = kiriArray_Push(matrix->memory, &ways->row, c);
            }
        }
        if (!isDone || ways->row.count > most) {
            return false;
        }
    }
    ways->start.data[matrix->count] = ways->row.count;
    return Transpose(matrix, ways, &matrix->factor);
}

/* Joins a column to the last panel if that panel's rows are this column and its rows. */
static bool JoinColumns(kiriMatrix* matrix)
{
    const kiriColumns* factor = &matrix->factor;
    int64_t products = 0;
    matrix->panels.count = 0;
    KIRI_TIMES(c, matrix->count) {
        int32_t first = factor->start.data[c], below = factor->start.data[c + 1] - first - 1;
        kiriPanel* last = matrix->panels.count > 0 ? &matrix->panels.data[matrix->panels.count - 1] : NULL;
        KIRI_ASSERT(factor->row.data[first] == c);
        if (last != NULL && last->below == below + 1 && factor->row.data[last->row] == c) {
            last->width += 1;
            last->row = first + 1;
            last->below = below;
        } else {
            kiriPanel panel = { c, 1, first + 1, below, KIRI_NONE, 0 };
            if (!kiriArray_Push(matrix->memory, &matrix->panels, panel)) {
                return false;
            }
        }
        matrix->panelOf.data[c] = matrix->panels.count - 1;
        products += (int64_t)below * (below + 1) / 2;
    }
    matrix->products = products * matrix->size * matrix->size * matrix->size / 216;
    return true;
}

/* Lists updates of each panel by ascending source: for each run of rows of a panel that are columns of one panel. */
static bool ListUpdates(kiriMatrix* matrix)
{
    const int32_t* panelOf = matrix->panelOf.data;
    matrix->updates.count = 0;
    KIRI_EACH_INDEX_BACK(p, matrix->panels) {
        const kiriPanel* panel = &matrix->panels.data[p];
        const int32_t* rows = matrix->factor.row.data + panel->row;
        for (int32_t first = 0, end; first < panel->below; first = end) {
            kiriPanel* changed = &matrix->panels.data[panelOf[rows[first]]];
            KIRI_ASSERT(changed > panel);
            for (end = first + 1; end < panel->below && panelOf[rows[end]] == panelOf[rows[first]];) {
                ++end;
            }
            kiriPanelUpdate update = { p, first, end - first, changed->update };
            if (!kiriArray_Push(matrix->memory, &matrix->updates, update)) {
                return false;
            }
            changed->update = matrix->updates.count - 1;
        }
    }
    return true;
}

static bool PlacePanels(kiriMatrix* matrix)
{
    int64_t size = matrix->size, area = size * size, values = 0;
    int32_t highest = 0, widest = 0;
    KIRI_EACH(kiriPanel, panel, matrix->panels) {
        int32_t height = panel->width + panel->below;
        panel->values = values;
        values += area * panel->width * height;
        highest = kiriMax(highest, height);
        widest = kiriMax(widest, panel->width);
    }
    kiriMemory* memory = matrix->memory;
    return kiriArray_Resize(memory, &matrix->values, area * matrix->pattern.row.count) &&
           kiriArray_Resize(memory, &matrix->factors, values) &&
           kiriArray_Resize(memory, &matrix->right, size * matrix->count) &&
           kiriArray_Resize(memory, &matrix->scaled, area * highest * widest) &&
           kiriArray_Resize(memory, &matrix->part, size * highest);
}

/* Reserves for the frames, whose order is at first by index. */
static bool ReserveFrames(kiriMatrix* matrix, int32_t count)
{
    matrix->count = count;
    if (!kiriArrays_Resize(matrix->memory, (int64_t)count + 1, &matrix->graph.start, &matrix->ways.start) ||
        !kiriArrays_Resize(matrix->memory, count, &matrix->order, &matrix->parent, &matrix->mark, &matrix->panelOf)) {
        return false;
    }
    KIRI_TIMES(f, count) {
        matrix->order.data[f] = f;
    }
    return true;
}

/* Shapes the matrix of the graph. Fails on out of memory, or on more than `most` blocks of the factor. */
static bool ShapeGraph(kiriMatrix* matrix, int64_t most)
{
    int32_t pairs = kiriMatrix_PairCount(matrix);
    if (!kiriMatrix_Order(matrix) || !kiriArray_Resize(matrix->memory, &matrix->pairs, pairs)) {
        return false;
    }
    kiriMatrix_GetPairs(matrix, matrix->pairs.data);
    return FillPattern(matrix, matrix->pairs.data, pairs, &matrix->pattern) && Eliminate(matrix, most) &&
           JoinColumns(matrix) && ListUpdates(matrix) && PlacePanels(matrix);
}

bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount)
{
    return ReserveFrames(matrix, frameCount) && FillPattern(matrix, pairs, pairCount, &matrix->graph) &&
           ShapeGraph(matrix, INT64_MAX);
}

/* ---- Pairs ---- */

/* Returns the count of a frame's pairs with higher frames, and points to these. */
static int32_t GetPartners(const kiriMatrix* matrix, int32_t frame, int32_t** partners)
{
    const int32_t* start = &matrix->graph.start.data[frame];
    *partners = matrix->graph.row.data + start[0] + 1;
    return start[1] - start[0] - 1;
}

int32_t kiriMatrix_PairCount(const kiriMatrix* matrix)
{
    return matrix->graph.row.count - matrix->count;
}

void kiriMatrix_GetPairs(const kiriMatrix* matrix, kiriPair* pairs)
{
    KIRI_TIMES(f, matrix->count) {
        int32_t *partners, count = GetPartners(matrix, f, &partners);
        KIRI_TIMES(n, count) {
            *pairs++ = (kiriPair){ f, partners[n] };
        }
    }
}

uint64_t kiriMatrix_Hash(const kiriMatrix* matrix)
{
    uint64_t hash = KIRI_HASH_START;
    kiriHash_Int32(&hash, matrix->count);
    KIRI_TIMES(f, matrix->count) {
        int32_t *partners, count = GetPartners(matrix, f, &partners);
        KIRI_TIMES(n, count) {
            kiriHash_Pair(&hash, f, partners[n]);
        }
    }
    return hash;
}

/* Threads may write at the same time: into no array of the matrix. */
static void WritePairs(kiriArchive* archive, const kiriMatrix* matrix)
{
    int32_t* partners;
    KIRI_TIMES(f, matrix->count) {
        int32_t count = GetPartners(matrix, f, &partners);
        kiriArchive_Int32(archive, &count);
    }
    KIRI_TIMES(f, matrix->count) {
        int32_t count = GetPartners(matrix, f, &partners);
        kiriArchive_Numbers(archive, partners, 4, count);
    }
}

/* Reads the graph. Fails on out of memory, on bad bytes, and on more than `most` pairs. */
static void ReadGraph(kiriArchive* archive, kiriMatrix* matrix, int64_t most)
{
    int32_t count = matrix->count, *counts = matrix->mark.data, at = 0;
    int64_t total = 0;
    kiriArchive_Numbers(archive, counts, 4, count);
    KIRI_TIMES(f, count) {
        kiriArchive_Expect(archive, counts[f] >= 0 && counts[f] < count - f);
        total += counts[f];
    }
    kiriArchive_Expect(archive, total <= most);
    archive->isShort |= !archive->isBad && !kiriArray_Resize(matrix->memory, &matrix->graph.row, count + total);
    int32_t* row = matrix->graph.row.data;
    KIRI_TIMES_WHILE(!kiriArchive_HasFailed(archive), f, count) {
        matrix->graph.start.data[f] = at;
        row[at++] = f;
        kiriArchive_Numbers(archive, &row[at], 4, counts[f]);
        for (int32_t end = at + counts[f]; at < end; ++at) {
            kiriArchive_Expect(archive, row[at] > row[at - 1] && row[at] < count);
        }
    }
    matrix->graph.start.data[count] = at;
}

/* Pairs are stored as the count of higher partners of each frame, then the partners. A made-up pattern may fill the
   factor: `room` bounds it. */
void kiriMatrix_Archive(kiriArchive* archive, kiriMatrix* matrix)
{
    bool reads = kiriArchive_Reads(archive);
    int64_t most = archive->room / ((int64_t)sizeof(double) * matrix->size * matrix->size);
    int32_t count = kiriArchive_Count(archive, matrix->count, 0, reads ? archive->room / 256 : INT32_MAX);
    if (count == 0 || kiriArchive_HasFailed(archive)) {
        return;
    }
    if (!reads) {
        WritePairs(archive, matrix);
        return;
    }
    archive->isShort |= !ReserveFrames(matrix, count);
    if (!archive->isShort) {
        ReadGraph(archive, matrix, most);
    }
    if (!kiriArchive_HasFailed(archive) && !ShapeGraph(matrix, most)) {
        bool isTooMuch = matrix->ways.row.count > most;
        kiriArchive_Expect(archive, !isTooMuch);
        archive->isShort |= !isTooMuch;
    }
}
