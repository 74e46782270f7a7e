/* The only file that knows Eigen: its order of unknowns that keeps a factor sparse. The Cholesky
   factorisation is our own, for Eigen's goes entry by entry: panels of blocks, whose products stay in registers, take a
   fraction of the time, and their memory is the host's (Chen, Davis, Hager, Rajamanickam 2008, CHOLMOD, has the same
   scheme). Numbers are summed in a fixed order: the same bits everywhere. */

#include "../core/kiri_float.h"

/* Before our own headers, which include C's headers as C. */
#include <Eigen/Sparse>
#include <algorithm>
#include <cfloat>
#include <new>
#include <vector>

#include "kiri_block_factor.h"
#include "kiri_panel.h"
extern "C" {
#include "../core/kiri_archive.h"
#include "../core/kiri_array.h"
#include "../core/kiri_hash.h"
}

namespace
{

const double LAST_BITS = 8.0 * DBL_EPSILON; /* of an entry: what a few operations round off */

const int32_t MOST_ROWS = 16;  /* of an element that are added together */
const int32_t MOST_DEPTH = 48; /* columns whose products are taken off at once: a multiple of all sizes of blocks */

/* Which blocks there are on and below the diagonal: the rows of column c are those from start[c] on, ascending, so that
   the diagonal block comes first. */
struct Pattern {
    KIRI_ARRAY(int32_t) start, row;
};

/* Columns that follow each other, and have the same rows below them: see kiri_panel.h. */
struct Panel {
    int32_t column, width; /* the first one, and how many */
    int32_t row, below;    /* into `rows`: those below the columns, ascending; and how many */
    int32_t left;          /* into `left`: of panels before it, what changes this one */
    int64_t values;        /* into `factors` */
};

/* Rows of a panel that are columns of another one. */
struct Left {
    int32_t panel, first, count; /* into the panel's rows */
};

} // namespace

/* Frames have places in the order of unknowns; rows and columns are places. Blocks of the matrix lie one after the other,
   column by column, and so do the entries of a block. With ones on the diagonal of L, matrix = L D L^T, in panels. */
struct kiriMatrix {
    kiriMemory* memory;
    int32_t size, count;
    bool hasLongVectors;
    int64_t products, chosenProducts; /* of blocks, that a factorisation takes, and one of the chosen panels */
    KIRI_ARRAY(int32_t) place;        /* of a frame */
    Pattern own;
    KIRI_ARRAY(Panel) panels;     /* and one more, where all of them end */
    KIRI_ARRAY(int32_t) panelOf;  /* of each column */
    kiriIndices chosen;           /* panels with a frame that is chosen */
    kiriIndices frames;           /* that are chosen, */
    kiriIndices idle;             /* and columns of chosen panels that are not: they are those of the identity */
    KIRI_ARRAY(uint8_t) isChosen; /* of each panel */
    KIRI_ARRAY(int32_t) rows;
    KIRI_ARRAY(Left) left;
    KIRI_ARRAY(double) values, factors, right;
    KIRI_ARRAY(double) scaled, part; /* scratch: rows of a panel times D; what is solved for, as a panel has it */
    Pattern factor;                  /* scratch: columns of the factor without padding */
    KIRI_ARRAY(int64_t) keys;        /* scratch: blocks to be sorted */
    KIRI_ARRAY(int32_t) child, sibling, mark; /* scratch: the elimination tree; where a panel has a row */
};

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
    Pattern* own = &matrix->own;
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
bool AddRows(kiriMatrix* matrix, const Pattern* from, int32_t column, int32_t c)
{
    Pattern* factor = &matrix->factor;
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
   whose first row below the diagonal it is. */
bool Eliminate(kiriMatrix* matrix)
{
    Pattern* factor = &matrix->factor;
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
        if (!ok) {
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
    const Pattern* factor = &matrix->factor;
    matrix->panels.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = factor->start.data[c], below = factor->start.data[c + 1] - first - 1;
        Panel* last = matrix->panels.count > 0 ? &matrix->panels.data[matrix->panels.count - 1] : nullptr;
        if (last != nullptr && last->below == below + 1 && factor->row.data[last->row] == c) {
            last->width += 1;
            last->row = first + 1;
            last->below = below;
        } else {
            Panel panel = { c, 1, first + 1, below, 0, 0 };
            if (!kiriArray_Push(matrix->memory, &matrix->panels, panel)) {
                return false;
            }
        }
        matrix->panelOf.data[c] = matrix->panels.count - 1;
    }
    Panel end = { matrix->count, 0, 0, 0, 0, 0 };
    return kiriArray_Push(matrix->memory, &matrix->panels, end);
}

/* Gives panels rows of their own, and places for their values. */
bool PlacePanels(kiriMatrix* matrix)
{
    int64_t area = (int64_t)matrix->size * matrix->size, values = 0;
    int32_t highest = 0, widest = 0;
    matrix->rows.count = 0;
    for (int32_t p = 0; p < matrix->panels.count; ++p) {
        Panel* panel = &matrix->panels.data[p];
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
int32_t RunLength(const kiriMatrix* matrix, const Panel* panel, int32_t n)
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
    Panel* panels = matrix->panels.data;
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
            Left left = { p, n, run };
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
bool FinishShape(kiriMatrix* matrix)
{
    if (!Eliminate(matrix) || !JoinColumns(matrix) || !PlacePanels(matrix) || !CollectLeft(matrix)) {
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

/* ---- Choice ---- */

void ChoosePanels(kiriMatrix* matrix)
{
    matrix->chosen.count = 0;
    matrix->chosenProducts = 0;
    for (int32_t p = 0; p + 1 < matrix->panels.count; ++p) {
        const Panel* panel = &matrix->panels.data[p];
        if (matrix->isChosen.data[p]) {
            matrix->chosen.data[matrix->chosen.count++] = p;
            for (int32_t n = 0; n < panel->width; ++n) {
                int64_t below = panel->below + n;
                matrix->chosenProducts += below * (below + 1) / 2;
            }
        }
    }
}

/* `mark` of a column is its own where its frame is chosen. */
void FindIdle(kiriMatrix* matrix)
{
    matrix->idle.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        if (matrix->isChosen.data[matrix->panelOf.data[c]] && matrix->mark.data[c] != c) {
            matrix->idle.data[matrix->idle.count++] = c;
        }
    }
}

void ClearPanel(kiriMatrix* matrix, const Panel* panel)
{
    int64_t area = (int64_t)matrix->size * matrix->size;
    const int32_t* start = &matrix->own.start.data[panel->column];
    std::fill(matrix->values.data + area * start[0], matrix->values.data + area * start[panel->width], 0.0);
}

/* ---- Entries ---- */

/* The block (row, column) of the matrix, row >= column; KIRI_NONE where there is none. */
int32_t BlockAt(const kiriMatrix* matrix, int32_t row, int32_t column)
{
    const int32_t* rows = matrix->own.row.data;
    int32_t at = matrix->own.start.data[column], end = matrix->own.start.data[column + 1];
    while (at < end && rows[at] < row) { /* a few: no search is as fast */
        ++at;
    }
    return at < end && rows[at] == row ? at : (int32_t)KIRI_NONE;
}

void AddNumbers(double* out, const double* numbers, int32_t count)
{
    Eigen::Map<Eigen::VectorXd>(out, count) += Eigen::Map<const Eigen::VectorXd>(numbers, count);
}

/* Of one frame: a call of a function that copies takes longer. */
inline void CopyNumbers(double* to, const double* from, int32_t size)
{
    for (int32_t n = 0; n < size; n += 3) {
        double a = from[n], b = from[n + 1], c = from[n + 2];
        to[n] = a, to[n + 1] = b, to[n + 2] = c;
    }
}

/* What one element adds, J^T k J: rows of J, and the stiffness k of each. */
struct Squares {
    const double* J;
    const double* k;
    int32_t rows; /* MOST_ROWS or less */
};

/* Adds what J and k have in one block column, b, of an element: J^T k J. */
template <int32_t size>
void AddColumn(kiriMatrix* matrix, const Squares* squares, const int32_t* frames, int32_t count, int32_t b)
{
    int32_t stride = size * count, column = matrix->place.data[frames[b]];
    double scaled[MOST_ROWS * size];
    for (int32_t e = 0; e < squares->rows; ++e) {
        const double k = -squares->k[e], *J = squares->J + stride * e + size * b;
        for (int32_t n = 0; n < size; ++n) {
            scaled[size * e + n] = k * J[n];
        }
    }
    kiriProduct product = { nullptr, nullptr, scaled, size, stride, size, size, size, squares->rows };
    for (int32_t a = 0; a < count; ++a) {
        int32_t row = matrix->place.data[frames[a]];
        if (row >= column) {
            int32_t block = BlockAt(matrix, row, column);
            KIRI_ASSERT(block != KIRI_NONE);
            product.out = &matrix->values.data[(int64_t)size * size * block];
            product.a = squares->J + size * a;
            kiriPanel_TakeOff(&product, matrix->hasLongVectors);
        }
    }
}

/* Where springs are stiffer than inertia by more than the digits of a double, elimination cancels what the inertia put
   on the diagonal, and rounding decides the sign. An addition of the size of what is rounded off makes the matrix
   positive; such a light sheet then falls too slowly. */
void ShiftDiagonal(kiriMatrix* matrix)
{
    int32_t size = matrix->size;
    for (int32_t f = 0; f < matrix->frames.count; ++f) {
        int32_t c = matrix->place.data[matrix->frames.data[f]];
        double* block = &matrix->values.data[(int64_t)size * size * matrix->own.start.data[c]];
        for (int32_t n = 0; n < size; ++n) {
            block[(size + 1) * n] *= 1.0 + LAST_BITS;
        }
    }
}

/* ---- Factorisation ---- */

/* Fills a panel with the matrix, and marks where it has which row. */
void StartPanel(kiriMatrix* matrix, const Panel* panel)
{
    int32_t size = matrix->size, height = size * (panel->width + panel->below);
    double* values = &matrix->factors.data[panel->values];
    std::fill(values, values + (int64_t)height * size * panel->width, 0.0);
    for (int32_t n = 0; n < panel->width; ++n) {
        matrix->mark.data[panel->column + n] = n;
    }
    for (int32_t n = 0; n < panel->below; ++n) {
        matrix->mark.data[matrix->rows.data[panel->row + n]] = panel->width + n;
    }
    for (int32_t n = 0; n < panel->width; ++n) {
        int32_t c = panel->column + n;
        for (int32_t b = matrix->own.start.data[c]; b < matrix->own.start.data[c + 1]; ++b) {
            const double* from = &matrix->values.data[(int64_t)size * size * b];
            double* to = values + (int64_t)height * size * n + size * matrix->mark.data[matrix->own.row.data[b]];
            for (int32_t k = 0; k < size; ++k, from += size, to += height) {
                CopyNumbers(to, from, size);
            }
        }
    }
}

/* How many rows from n on follow each other in the panel that is marked, too. */
int32_t FollowRows(const kiriMatrix* matrix, const int32_t* rows, int32_t n, int32_t count)
{
    int32_t next = n + 1;
    while (next < count && matrix->mark.data[rows[next]] == matrix->mark.data[rows[n]] + next - n) {
        ++next;
    }
    return next - n;
}

/* Takes off what a panel before it put into the panel, by the numbers from k on of `product->depth` columns: for each of
   its columns, rows that follow each other in both at once. */
void TakeOffColumns(kiriMatrix* matrix, const Panel* panel, const Left* left, int32_t k, kiriProduct* product)
{
    int32_t size = matrix->size;
    const Panel* from = &matrix->panels.data[left->panel];
    const double* values = &matrix->factors.data[from->values] + (int64_t)product->aStride * k;
    const int32_t *rows = &matrix->rows.data[from->row], *mark = matrix->mark.data;
    for (int32_t c = 0; c < left->count; ++c) {
        int32_t first = left->first + c;
        double* out = &matrix->factors.data[panel->values] + (int64_t)product->outStride * size * mark[rows[first]];
        product->b = matrix->scaled.data + (int64_t)product->bStride * k + size * c;
        for (int32_t n = first, down; n < from->below; n += down) {
            down = FollowRows(matrix, rows, n, from->below);
            product->a = values + size * (from->width + n);
            product->out = out + size * mark[rows[n]];
            product->rows = size * down;
            kiriPanel_TakeOff(product, matrix->hasLongVectors);
        }
    }
}

/* So many columns at once that their rows stay in the cache while all columns of the panel pass. */
void UpdatePanel(kiriMatrix* matrix, const Panel* panel, const Left* left)
{
    int32_t size = matrix->size, depth;
    const Panel* from = &matrix->panels.data[left->panel];
    int32_t width = size * from->width, height = width + size * from->below, count = size * left->count;
    kiriPanel_ScaleRows(&matrix->factors.data[from->values], height, 0, width, size * (from->width + left->first),
                        count, matrix->scaled.data, matrix->hasLongVectors);
    for (int32_t k = 0; k < width; k += depth) {
        depth = std::min(width - k, MOST_DEPTH);
        kiriProduct product = { nullptr, nullptr, nullptr, size * (panel->width + panel->below), height, count,
                                0,       size,    depth };
        TakeOffColumns(matrix, panel, left, k, &product);
    }
}

/* Takes what columns `first` to `last` of a panel changed off its column c, from the diagonal on. */
void TakeOffOwn(kiriMatrix* matrix, double* values, int32_t height, int32_t first, int32_t last, int32_t c)
{
    int32_t size = matrix->size;
    const double* from = values + (int64_t)height * first;
    const kiriProduct product = { values + (int64_t)height * c + c,
                                  from + c,
                                  matrix->scaled.data,
                                  height,
                                  height,
                                  size,
                                  height - c,
                                  size,
                                  last - first };
    kiriPanel_ScaleRows(from, height, first, last - first, c, size, matrix->scaled.data, matrix->hasLongVectors);
    kiriPanel_TakeOff(&product, matrix->hasLongVectors);
}

/* Block column by block column. What so many columns changed is taken off all that follow at once, while it is in the
   cache. */
bool FactorPanel(kiriMatrix* matrix, const Panel* panel)
{
    int32_t size = matrix->size, height = size * (panel->width + panel->below), width = size * panel->width;
    double* values = &matrix->factors.data[panel->values];
    for (int32_t first = 0, last; first < width; first = last) {
        last = std::min(first + MOST_DEPTH, width);
        for (int32_t c = first; c < last; c += size) {
            if (c > first) {
                TakeOffOwn(matrix, values, height, first, c, c);
            }
            if (!kiriPanel_Factor(values + (int64_t)height * c + c, height - c, height, size, matrix->hasLongVectors)) {
                return false;
            }
        }
        for (int32_t c = last; c < width; c += size) {
            TakeOffOwn(matrix, values, height, first, last, c);
        }
    }
    return true;
}

bool FactorOnce(kiriMatrix* matrix)
{
    for (int32_t k = 0; k < matrix->chosen.count; ++k) {
        const Panel* panel = &matrix->panels.data[matrix->chosen.data[k]];
        StartPanel(matrix, panel);
        for (int32_t n = panel->left; n < panel[1].left; ++n) {
            if (matrix->isChosen.data[matrix->left.data[n].panel]) { /* others have zeros there */
                UpdatePanel(matrix, panel, &matrix->left.data[n]);
            }
        }
        if (!FactorPanel(matrix, panel)) {
            return false;
        }
    }
    return true;
}

/* ---- Solution ---- */

/* L y = right in place, then y / D. */
void SolveDown(kiriMatrix* matrix, double* right)
{
    int32_t size = matrix->size;
    for (int32_t k = 0; k < matrix->chosen.count; ++k) {
        const Panel* panel = &matrix->panels.data[matrix->chosen.data[k]];
        int32_t width = size * panel->width, below = size * panel->below;
        double *own = right + size * panel->column, *part = matrix->part.data;
        CopyNumbers(part, own, width);
        std::fill(part + width, part + width + below, 0.0);
        kiriPanel_SolveDown(&matrix->factors.data[panel->values], width + below, width, part);
        CopyNumbers(own, part, width);
        part += width;
        for (int32_t n = 0; n < panel->below; ++n) {
            double* out = right + size * matrix->rows.data[panel->row + n];
            for (int32_t e = 0; e < size; ++e) {
                out[e] += *part++;
            }
        }
    }
}

/* L^T x = y in place. */
void SolveUp(kiriMatrix* matrix, double* y)
{
    int32_t size = matrix->size;
    for (int32_t k = matrix->chosen.count - 1; k >= 0; --k) {
        const Panel* panel = &matrix->panels.data[matrix->chosen.data[k]];
        int32_t width = size * panel->width;
        double *own = y + size * panel->column, *part = matrix->part.data;
        CopyNumbers(part, own, width);
        for (int32_t n = 0; n < panel->below; ++n) {
            const double* known = y + size * matrix->rows.data[panel->row + n];
            CopyNumbers(part + width + size * n, known, size);
        }
        kiriPanel_SolveUp(&matrix->factors.data[panel->values], width + size * panel->below, width, part);
        CopyNumbers(own, part, width);
    }
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
    return PlaceBlocks(matrix, pairs, pairCount) && FinishShape(matrix);
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
        archive->isShort |= !archive->isBad && !FinishShape(matrix);
    }
}

extern "C" void kiriMatrix_Choose(kiriMatrix* matrix, const int32_t* frames, int32_t count)
{
    KIRI_ASSERT(count >= 0 && count <= matrix->count);
    std::fill(matrix->isChosen.data, matrix->isChosen.data + matrix->isChosen.count, (uint8_t)0);
    std::fill(matrix->mark.data, matrix->mark.data + matrix->mark.count, (int32_t)KIRI_NONE);
    for (int32_t n = 0; n < count; ++n) {
        int32_t c = matrix->place.data[frames[n]];
        matrix->frames.data[n] = frames[n];
        matrix->mark.data[c] = c;
        matrix->isChosen.data[matrix->panelOf.data[c]] = 1;
    }
    matrix->frames.count = count;
    std::fill(matrix->right.data, matrix->right.data + matrix->right.count, 0.0);
    ChoosePanels(matrix);
    FindIdle(matrix);
}

extern "C" int32_t kiriMatrix_FrameCount(const kiriMatrix* matrix)
{
    return matrix->count;
}

extern "C" int64_t kiriMatrix_ProductCount(const kiriMatrix* matrix, bool chosen)
{
    return (chosen ? matrix->chosenProducts : matrix->products) * matrix->size * matrix->size * matrix->size / 216;
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

extern "C" bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair)
{
    KIRI_ASSERT(pair.a >= 0 && pair.a < matrix->count && pair.b >= 0 && pair.b < matrix->count);
    int32_t a = matrix->place.data[pair.a], b = matrix->place.data[pair.b];
    return BlockAt(matrix, std::max(a, b), std::min(a, b)) != KIRI_NONE;
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

extern "C" void kiriMatrix_RefuseLongVectors(kiriMatrix* matrix)
{
    matrix->hasLongVectors = false;
}

extern "C" void kiriMatrix_Clear(kiriMatrix* matrix)
{
    int32_t size = matrix->size;
    for (int32_t k = 0; k < matrix->chosen.count; ++k) {
        ClearPanel(matrix, &matrix->panels.data[matrix->chosen.data[k]]);
    }
    for (int32_t k = 0; k < matrix->idle.count; ++k) {
        double* block = &matrix->values.data[(int64_t)size * size * matrix->own.start.data[matrix->idle.data[k]]];
        for (int32_t n = 0; n < size; ++n) {
            block[(size + 1) * n] = 1.0;
        }
    }
}

extern "C" void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block)
{
    KIRI_ASSERT(frame >= 0 && frame < matrix->count);
    int32_t area = matrix->size * matrix->size;
    AddNumbers(&matrix->values.data[(int64_t)area * matrix->own.start.data[matrix->place.data[frame]]], block, area);
}

extern "C" void kiriMatrix_AddBlock(kiriMatrix* matrix, int32_t down, int32_t across, const double* block)
{
    int32_t size = matrix->size, row = matrix->place.data[down], column = matrix->place.data[across];
    int32_t at = BlockAt(matrix, std::max(row, column), std::min(row, column));
    KIRI_ASSERT(at != KIRI_NONE);
    double* out = &matrix->values.data[(int64_t)size * size * at];
    for (int32_t c = 0; row < column && c < size; ++c) {
        for (int32_t r = 0; r < size; ++r) {
            *out++ += block[size * r + c];
        }
    }
    if (row >= column) {
        AddNumbers(out, block, size * size);
    }
}

extern "C" void kiriMatrix_GetBlock(const kiriMatrix* matrix, int32_t down, int32_t across, double* block)
{
    int32_t size = matrix->size, row = matrix->place.data[down], column = matrix->place.data[across];
    int32_t at = BlockAt(matrix, std::max(row, column), std::min(row, column));
    KIRI_ASSERT(at != KIRI_NONE);
    const double* values = &matrix->values.data[(int64_t)size * size * at];
    for (int32_t c = 0; c < size; ++c) {
        for (int32_t r = 0; r < size; ++r) {
            *block++ = row < column ? values[size * r + c] : values[size * c + r];
        }
    }
}

extern "C" void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                                      const double* k, int32_t rows)
{
    for (int32_t e = 0; e < rows; e += MOST_ROWS) {
        const Squares squares = { J + (int64_t)matrix->size * frameCount * e, k + e, std::min(rows - e, MOST_ROWS) };
        for (int32_t b = 0; b < frameCount; ++b) {
            if (matrix->size == 6) {
                AddColumn<6>(matrix, &squares, frames, frameCount, b);
            } else if (matrix->size == 3) {
                AddColumn<3>(matrix, &squares, frames, frameCount, b);
            } else {
                AddColumn<12>(matrix, &squares, frames, frameCount, b);
            }
        }
    }
}

extern "C" bool kiriMatrix_Factor(kiriMatrix* matrix)
{
    if (FactorOnce(matrix)) {
        return true;
    }
    ShiftDiagonal(matrix);
    return FactorOnce(matrix);
}

extern "C" void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution)
{
    int32_t size = matrix->size;
    for (int32_t n = 0; n < matrix->frames.count; ++n) {
        int32_t f = matrix->frames.data[n];
        CopyNumbers(matrix->right.data + size * matrix->place.data[f], right + size * f, size);
    }
    SolveDown(matrix, matrix->right.data);
    SolveUp(matrix, matrix->right.data);
    for (int32_t n = 0; n < matrix->frames.count; ++n) {
        int32_t f = matrix->frames.data[n];
        const double* from = matrix->right.data + size * matrix->place.data[f];
        CopyNumbers(solution + size * f, from, size);
    }
}
