/* Which blocks the matrix and its factor have, and their panels. The only file that knows Eigen: its order of unknowns
   that keeps a factor sparse. */

#include "../core/kiri_float.h"

/* Before our own headers, which include C's headers as C. */
#include <Eigen/Sparse>
#include <algorithm>
#include <new>
#include <vector>

#include "kiri_block_work.h"
#include "kiri_panel.h"
extern "C" {
#include "../core/kiri_archive.h"
#include "../core/kiri_hash.h"
}

namespace
{

/* ---- Pattern ---- */

/* An order of the frames that keeps the factor sparse. */
void PlaceFrames(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    int32_t count = matrix->count;
    std::vector<Eigen::Triplet<double>> entries;
    for (int32_t f = 0; f < count; ++f) {
        entries.push_back(Eigen::Triplet<double>(f, f, 1.0));
    }
    for (int64_t k = 0; k < pairCount; ++k) {
        KIRI_ASSERT(pairs[k].a >= 0 && pairs[k].a < count && pairs[k].b >= 0 && pairs[k].b < count);
        entries.push_back(Eigen::Triplet<double>(pairs[k].a, pairs[k].b, 1.0));
        entries.push_back(Eigen::Triplet<double>(pairs[k].b, pairs[k].a, 1.0));
    }
    Eigen::SparseMatrix<double> graph(count, count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
    for (int32_t place = 0; place < count; ++place) {
        matrix->place.data[order.indices()[place]] = place;
    }
}

bool PlaceBlocks(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    kiriBlockPattern* own = &matrix->own;
    const int32_t* place = matrix->place.data;
    if (!kiriArray_Resize(matrix->memory, &matrix->keys, matrix->count + pairCount) ||
        !kiriArray_Reserve(matrix->memory, &own->row, matrix->count + pairCount)) {
        return false;
    }
    int64_t *keys = matrix->keys.data, *end = keys;
    for (int32_t c = 0; c < matrix->count; ++c) {
        *end++ = ((int64_t)c << 32) + c;
    }
    for (int64_t k = 0; k < pairCount; ++k) {
        int32_t a = place[pairs[k].a], b = place[pairs[k].b];
        *end++ = ((int64_t)std::min(a, b) << 32) + std::max(a, b);
    }
    std::sort(keys, end);
    end = std::unique(keys, end);
    own->row.count = 0;
    for (const int64_t* key = keys; key != end; ++key) {
        int32_t column = (int32_t)(*key >> 32), row = (int32_t)(*key & INT32_MAX);
        if (row == column) {
            own->start.data[column] = own->row.count;
        }
        own->row.data[own->row.count++] = row;
    }
    own->start.data[matrix->count] = own->row.count;
    return true;
}

/* Adds the rows of a column, from `first` on, that the factor's column c does not have yet. */
bool AddRows(kiriMatrix* matrix, const kiriBlockPattern* from, int32_t column, int32_t c)
{
    kiriBlockPattern* factor = &matrix->factor;
    for (int32_t b = from->start.data[column]; b < from->start.data[column + 1]; ++b) {
        int32_t row = from->row.data[b];
        if (row >= c && matrix->mark.data[row] != c) {
            matrix->mark.data[row] = c;
            if (!kiriArray_Push(matrix->memory, &factor->row, row)) {
                return false;
            }
        }
    }
    return true;
}

/* A column of the factor has the rows of the matrix, and those of its children in the elimination tree: the columns
   whose first row below the diagonal it is. False for memory, or where there are more than `most` blocks. */
bool Eliminate(kiriMatrix* matrix, int64_t most)
{
    kiriBlockPattern* factor = &matrix->factor;
    int32_t *child = matrix->child.data, *sibling = matrix->sibling.data;
    std::fill(child, child + matrix->count, (int32_t)KIRI_NONE);
    std::fill(matrix->mark.data, matrix->mark.data + matrix->count, (int32_t)KIRI_NONE);
    factor->start.data[0] = factor->row.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = factor->row.count;
        bool ok = AddRows(matrix, &matrix->own, c, c);
        for (int32_t k = child[c]; ok && k != KIRI_NONE; k = sibling[k]) {
            ok = AddRows(matrix, factor, k, c);
        }
        if (!ok || factor->row.count > most) {
            return false;
        }
        std::sort(factor->row.data + first, factor->row.data + factor->row.count);
        factor->start.data[c + 1] = factor->row.count;
        if (factor->row.count > first + 1) {
            int32_t parent = factor->row.data[first + 1];
            sibling[c] = child[parent];
            child[parent] = c;
        }
    }
    return true;
}

/* Joins columns to panels: those whose rows are the next column and its rows. */
bool JoinColumns(kiriMatrix* matrix)
{
    const kiriBlockPattern* factor = &matrix->factor;
    matrix->panels.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = factor->start.data[c], below = factor->start.data[c + 1] - first - 1;
        kiriBlockPanel* last = matrix->panels.count > 0 ? &matrix->panels.data[matrix->panels.count - 1] : nullptr;
        if (last != nullptr && last->below == below + 1 && factor->row.data[last->row] == c) {
            last->width += 1;
            last->row = first + 1;
            last->below = below;
        } else {
            kiriBlockPanel panel = { c, 1, first + 1, below, 0, 0 };
            if (!kiriArray_Push(matrix->memory, &matrix->panels, panel)) {
                return false;
            }
        }
        matrix->panelOf.data[c] = matrix->panels.count - 1;
    }
    kiriBlockPanel end = { matrix->count, 0, 0, 0, 0, 0 };
    return kiriArray_Push(matrix->memory, &matrix->panels, end);
}

/* Gives panels rows of their own, and places for their values. */
bool PlacePanels(kiriMatrix* matrix)
{
    int64_t area = (int64_t)matrix->size * matrix->size, values = 0;
    int32_t highest = 0, widest = 0;
    matrix->rows.count = 0;
    for (int32_t p = 0; p < matrix->panels.count; ++p) {
        kiriBlockPanel* panel = &matrix->panels.data[p];
        int32_t from = panel->row;
        panel->row = matrix->rows.count;
        panel->values = values;
        values += area * panel->width * (panel->width + panel->below);
        highest = std::max(highest, panel->width + panel->below);
        widest = std::max(widest, panel->width);
        for (int32_t n = 0; n < panel->below; ++n) {
            if (!kiriArray_Push(matrix->memory, &matrix->rows, matrix->factor.row.data[from + n])) {
                return false;
            }
        }
    }
    return kiriArray_Resize(matrix->memory, &matrix->values, area * matrix->own.row.count) &&
           kiriArray_Resize(matrix->memory, &matrix->factors, values) &&
           kiriArray_Resize(matrix->memory, &matrix->scaled, area * highest * widest) &&
           kiriArray_Resize(matrix->memory, &matrix->part, (int64_t)matrix->size * highest);
}

/* The rows from n on that are columns of one panel. */
int32_t RunLength(const kiriMatrix* matrix, const kiriBlockPanel* panel, int32_t n)
{
    const int32_t* rows = &matrix->rows.data[panel->row];
    int32_t end = n + 1;
    while (end < panel->below && matrix->panelOf.data[rows[end]] == matrix->panelOf.data[rows[n]]) {
        ++end;
    }
    return end - n;
}

/* By the panels that they change, each from the lowest panel on. */
bool CollectLeft(kiriMatrix* matrix)
{
    kiriBlockPanel* panels = matrix->panels.data;
    int32_t count = matrix->panels.count, total = 0;
    for (int32_t p = 0; p < count; ++p) {
        for (int32_t n = 0; n < panels[p].below; n += RunLength(matrix, &panels[p], n)) {
            panels[matrix->panelOf.data[matrix->rows.data[panels[p].row + n]]].left += 1;
            ++total;
        }
    }
    if (!kiriArray_Resize(matrix->memory, &matrix->left, total)) {
        return false;
    }
    for (int32_t p = 0, sum = 0; p < count; ++p) {
        sum += panels[p].left;
        panels[p].left = sum;
    }
    for (int32_t p = count - 1; p >= 0; --p) {
        for (int32_t n = 0, run; n < panels[p].below; n += run) {
            run = RunLength(matrix, &panels[p], n);
            kiriBlockLeft left = { p, n, run };
            matrix->left.data[--panels[matrix->panelOf.data[matrix->rows.data[panels[p].row + n]]].left] = left;
        }
    }
    return true;
}

bool MakeRoomForFrames(kiriMatrix* matrix)
{
    kiriMemory* memory = matrix->memory;
    int64_t count = matrix->count;
    return kiriArray_Resize(memory, &matrix->place, count) && kiriArray_Resize(memory, &matrix->child, count) &&
           kiriArray_Resize(memory, &matrix->sibling, count) && kiriArray_Resize(memory, &matrix->mark, count) &&
           kiriArray_Resize(memory, &matrix->panelOf, count) && kiriArray_Resize(memory, &matrix->frames, count) &&
           kiriArray_Resize(memory, &matrix->chosen, count) && kiriArray_Resize(memory, &matrix->idle, count) &&
           kiriArray_Resize(memory, &matrix->isChosen, count) &&
           kiriArray_Resize(memory, &matrix->own.start, count + 1) &&
           kiriArray_Resize(memory, &matrix->factor.start, count + 1) &&
           kiriArray_Resize(memory, &matrix->right, count * matrix->size);
}

/* When the order of frames and the blocks are known. */
bool FinishShape(kiriMatrix* matrix, int64_t most)
{
    if (!Eliminate(matrix, most) || !JoinColumns(matrix) || !PlacePanels(matrix) || !CollectLeft(matrix)) {
        return false;
    }
    for (int32_t f = 0; f < matrix->count; ++f) {
        matrix->frames.data[f] = f;
    }
    kiriMatrix_Choose(matrix, matrix->frames.data, matrix->count);
    matrix->products = matrix->chosenProducts;
    return true;
}

/* ---- What bytes may have ---- */

bool IsOrder(kiriMatrix* matrix)
{
    int32_t *seen = matrix->mark.data, count = matrix->count;
    bool isOrder = true;
    std::fill(seen, seen + count, 0);
    for (int32_t f = 0; isOrder && f < count; ++f) {
        int32_t place = matrix->place.data[f];
        isOrder = place >= 0 && place < count && seen[place]++ == 0;
    }
    return isOrder;
}

bool AreStarts(const kiriMatrix* matrix)
{
    const int32_t* start = matrix->own.start.data;
    bool areFine = start[0] == 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        areFine &= start[c + 1] > start[c];
    }
    return areFine;
}

bool AreRows(const kiriMatrix* matrix)
{
    bool areFine = true;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = matrix->own.start.data[c], end = matrix->own.start.data[c + 1];
        areFine &= matrix->own.row.data[first] == c && matrix->own.row.data[end - 1] < matrix->count;
        for (int32_t b = first + 1; b < end; ++b) {
            areFine &= matrix->own.row.data[b] > matrix->own.row.data[b - 1];
        }
    }
    return areFine;
}

/* An order of frames that somebody made up may fill the factor: it takes no more memory than arrays may. */
void FinishReading(kiriArchive* archive, kiriMatrix* matrix)
{
    int64_t most = archive->room / ((int64_t)sizeof(double) * matrix->size * matrix->size);
    bool isDone = archive->isBad || FinishShape(matrix, most);
    kiriArchive_Expect(archive, isDone || matrix->factor.row.count <= most);
    archive->isShort |= !isDone && !archive->isBad;
}

} // namespace

extern "C" kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size)
{
    void* room = kiriMemory_Alloc(memory, (int64_t)sizeof(kiriMatrix));
    if (room == NULL) {
        return NULL;
    }
    kiriMatrix* matrix = new (room) kiriMatrix();
    matrix->memory = memory;
    matrix->size = size;
    matrix->hasLongVectors = kiriPanel_HasLongVectors();
    return matrix;
}

extern "C" bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount)
{
    matrix->count = frameCount;
    if (!MakeRoomForFrames(matrix)) {
        return false;
    }
    try {
        PlaceFrames(matrix, pairs, pairCount);
    } catch (...) {
        return false;
    }
    return PlaceBlocks(matrix, pairs, pairCount) && FinishShape(matrix, INT64_MAX);
}

extern "C" void kiriMatrix_Archive(kiriArchive* archive, kiriMatrix* matrix)
{
    bool reads = kiriArchive_Reads(archive);
    int32_t count = kiriArchive_Count(archive, matrix->count, 0, reads ? archive->room / 64 : INT32_MAX);
    if (count == 0 || kiriArchive_HasFailed(archive)) {
        return;
    }
    if (reads) {
        matrix->count = count;
        archive->isShort |= !MakeRoomForFrames(matrix);
    }
    if (archive->isShort) {
        return;
    }
    kiriArchive_Numbers(archive, matrix->place.data, 4, count);
    kiriArchive_Numbers(archive, matrix->own.start.data, 4, (int64_t)count + 1);
    int32_t blocks = matrix->own.start.data[count];
    if (reads) {
        kiriArchive_Expect(archive, IsOrder(matrix) && AreStarts(matrix) && blocks <= archive->room / 8);
        archive->isShort |= !archive->isBad && !kiriArray_Resize(matrix->memory, &matrix->own.row, blocks);
    }
    if (!kiriArchive_HasFailed(archive)) {
        kiriArchive_Numbers(archive, matrix->own.row.data, 4, blocks);
    }
    if (reads && !kiriArchive_HasFailed(archive)) {
        kiriArchive_Expect(archive, AreRows(matrix));
        FinishReading(archive, matrix);
    }
}

extern "C" int32_t kiriMatrix_FrameCount(const kiriMatrix* matrix)
{
    return matrix->count;
}

extern "C" int32_t kiriMatrix_PairCount(const kiriMatrix* matrix)
{
    return matrix->own.row.count - matrix->count;
}

extern "C" void kiriMatrix_GetPairs(kiriMatrix* matrix, kiriPair* pairs)
{
    int32_t* frameAt = matrix->child.data; /* of each place */
    for (int32_t f = 0; f < matrix->count; ++f) {
        frameAt[matrix->place.data[f]] = f;
    }
    for (int32_t c = 0; c < matrix->count; ++c) {
        for (int32_t b = matrix->own.start.data[c] + 1; b < matrix->own.start.data[c + 1]; ++b) {
            kiriPair pair = { frameAt[c], frameAt[matrix->own.row.data[b]] };
            *pairs++ = pair;
        }
    }
}

extern "C" uint64_t kiriMatrix_Hash(const kiriMatrix* matrix)
{
    uint64_t hash = KIRI_HASH_START;
    for (int32_t f = 0; f < matrix->count; ++f) {
        kiriHash_Word(&hash, (uint64_t)matrix->place.data[f]);
    }
    for (int32_t b = 0; matrix->count > 0 && b < matrix->own.row.count; ++b) {
        kiriHash_Word(&hash, (uint64_t)matrix->own.row.data[b]);
    }
    return hash;
}
