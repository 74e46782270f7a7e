/* The Cholesky factorisation is our own, for Eigen's goes entry by entry: panels of blocks, whose products stay in
   registers, take a fraction of the time, and their memory is the host's (Chen, Davis, Hager, Rajamanickam 2008,
   CHOLMOD, has the same scheme). Numbers are summed in a fixed order: the same bits everywhere. */
#include "kiri_block_work.h"
#include "kiri_panel.h"

#include <float.h>
#include <string.h>

#define LAST_BITS (8.0 * DBL_EPSILON) /* of an entry: what a few operations round off */

enum {
    MOST_ROWS = 16,   /* of an element that are added together */
    MOST_COLUMNS = 48 /* whose products are taken off at once: a multiple of all sizes of blocks */
};

static void SetZero(double* numbers, int64_t count)
{
    memset(numbers, 0, (size_t)count * sizeof(double));
}

/* ---- Choice ---- */

static void ChoosePanels(kiriMatrix* matrix)
{
    matrix->chosen.count = 0;
    matrix->chosenProducts = 0;
    for (int32_t p = 0; p + 1 < matrix->panels.count; ++p) {
        const kiriBlockPanel* panel = &matrix->panels.data[p];
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
static void FindIdle(kiriMatrix* matrix)
{
    matrix->idle.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        if (matrix->isChosen.data[matrix->panelOf.data[c]] && matrix->mark.data[c] != c) {
            matrix->idle.data[matrix->idle.count++] = c;
        }
    }
}

static void ClearPanel(kiriMatrix* matrix, const kiriBlockPanel* panel)
{
    int64_t area = (int64_t)matrix->size * matrix->size;
    const int32_t* start = &matrix->own.start.data[panel->column];
    SetZero(matrix->values.data + area * start[0], area * (start[panel->width] - start[0]));
}

/* ---- Entries ---- */

/* The block (row, column) of the matrix, row >= column; KIRI_NONE where there is none. */
static int32_t BlockAt(const kiriMatrix* matrix, int32_t row, int32_t column)
{
    const int32_t* rows = matrix->own.row.data;
    int32_t at = matrix->own.start.data[column], end = matrix->own.start.data[column + 1];
    while (at < end && rows[at] < row) { /* a few: no search is as fast */
        ++at;
    }
    return at < end && rows[at] == row ? at : KIRI_NONE;
}

static int32_t FindBlock(const kiriMatrix* matrix, int32_t a, int32_t b)
{
    return a > b ? BlockAt(matrix, a, b) : BlockAt(matrix, b, a);
}

static void AddNumbers(double* out, const double* numbers, int32_t count)
{
    for (int32_t n = 0; n < count; ++n) {
        out[n] += numbers[n];
    }
}

/* Of one frame: a call of a function that copies takes longer. */
static inline void CopyEntries(double* to, const double* from, int32_t size)
{
    for (int32_t n = 0; n < size; n += 3) {
        double a = from[n], b = from[n + 1], c = from[n + 2];
        to[n] = a, to[n + 1] = b, to[n + 2] = c;
    }
}

/* What one element adds, J^T k J: rows of J, and the stiffness k of each. */
typedef struct Squares {
    const double* J;
    const double* k;
    int32_t rows; /* MOST_ROWS or less */
} Squares;

/* Adds what J and k have in one block column, b, of an element: J^T k J. Inline, so that the size is a constant. */
static inline void AddColumn(kiriMatrix* matrix, const Squares* squares, const int32_t* frames, int32_t count,
                             int32_t b, int32_t size)
{
    int32_t stride = size * count, column = matrix->place.data[frames[b]];
    double scaled[MOST_ROWS * KIRI_MOST_UNKNOWNS];
    for (int32_t e = 0; e < squares->rows; ++e) {
        const double k = -squares->k[e], *J = squares->J + stride * e + size * b;
        for (int32_t n = 0; n < size; ++n) {
            scaled[size * e + n] = k * J[n];
        }
    }
    kiriProduct product = { NULL, NULL, scaled, size, stride, size, size, size, squares->rows };
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
static void ShiftDiagonal(kiriMatrix* matrix)
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
static void StartPanel(kiriMatrix* matrix, const kiriBlockPanel* panel)
{
    int32_t size = matrix->size, height = size * (panel->width + panel->below);
    double* values = &matrix->factors.data[panel->values];
    SetZero(values, (int64_t)height * size * panel->width);
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
                CopyEntries(to, from, size);
            }
        }
    }
}

/* How many rows from n on follow each other in the panel that is marked, too. */
static int32_t FollowRows(const kiriMatrix* matrix, const int32_t* rows, int32_t n, int32_t count)
{
    int32_t next = n + 1;
    while (next < count && matrix->mark.data[rows[next]] == matrix->mark.data[rows[n]] + next - n) {
        ++next;
    }
    return next - n;
}

/* Takes off what a panel before it put into the panel, by the numbers from k on of `product->depth` columns: for each
   of its columns, rows that follow each other in both at once. */
static void TakeOffColumns(kiriMatrix* matrix, const kiriBlockPanel* panel, const kiriBlockLeft* left, int32_t k,
                           kiriProduct* product)
{
    int32_t size = matrix->size;
    const kiriBlockPanel* from = &matrix->panels.data[left->panel];
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
static void UpdatePanel(kiriMatrix* matrix, const kiriBlockPanel* panel, const kiriBlockLeft* left)
{
    int32_t size = matrix->size, depth;
    const kiriBlockPanel* from = &matrix->panels.data[left->panel];
    int32_t width = size * from->width, height = width + size * from->below, count = size * left->count;
    kiriPanel_ScaleRows(&matrix->factors.data[from->values], height, 0, width, size * (from->width + left->first),
                        count, matrix->scaled.data, matrix->hasLongVectors);
    for (int32_t k = 0; k < width; k += depth) {
        depth = width - k < MOST_COLUMNS ? width - k : MOST_COLUMNS;
        kiriProduct product = { NULL, NULL, NULL, size * (panel->width + panel->below), height, count, 0, size, depth };
        TakeOffColumns(matrix, panel, left, k, &product);
    }
}

/* Takes what columns `first` to `last` of a panel changed off its column c, from the diagonal on. */
static void TakeOffOwn(kiriMatrix* matrix, double* values, int32_t height, int32_t first, int32_t last, int32_t c)
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
static bool FactorPanel(kiriMatrix* matrix, const kiriBlockPanel* panel)
{
    int32_t size = matrix->size, height = size * (panel->width + panel->below), width = size * panel->width;
    double* values = &matrix->factors.data[panel->values];
    for (int32_t first = 0, last; first < width; first = last) {
        last = first + MOST_COLUMNS < width ? first + MOST_COLUMNS : width;
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

static bool FactorOnce(kiriMatrix* matrix)
{
    for (int32_t k = 0; k < matrix->chosen.count; ++k) {
        const kiriBlockPanel* panel = &matrix->panels.data[matrix->chosen.data[k]];
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
static void SolveDown(kiriMatrix* matrix, double* right)
{
    int32_t size = matrix->size;
    for (int32_t k = 0; k < matrix->chosen.count; ++k) {
        const kiriBlockPanel* panel = &matrix->panels.data[matrix->chosen.data[k]];
        int32_t width = size * panel->width, below = size * panel->below;
        double *own = right + size * panel->column, *part = matrix->part.data;
        CopyEntries(part, own, width);
        SetZero(part + width, below);
        kiriPanel_SolveDown(&matrix->factors.data[panel->values], width + below, width, part);
        CopyEntries(own, part, width);
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
static void SolveUp(kiriMatrix* matrix, double* y)
{
    int32_t size = matrix->size;
    for (int32_t k = matrix->chosen.count - 1; k >= 0; --k) {
        const kiriBlockPanel* panel = &matrix->panels.data[matrix->chosen.data[k]];
        int32_t width = size * panel->width;
        double *own = y + size * panel->column, *part = matrix->part.data;
        CopyEntries(part, own, width);
        for (int32_t n = 0; n < panel->below; ++n) {
            const double* known = y + size * matrix->rows.data[panel->row + n];
            CopyEntries(part + width + size * n, known, size);
        }
        kiriPanel_SolveUp(&matrix->factors.data[panel->values], width + size * panel->below, width, part);
        CopyEntries(own, part, width);
    }
}

/* ---- The whole ---- */

void kiriMatrix_Choose(kiriMatrix* matrix, const int32_t* frames, int32_t count)
{
    KIRI_ASSERT(count >= 0 && count <= matrix->count);
    for (int32_t p = 0; p < matrix->isChosen.count; ++p) {
        matrix->isChosen.data[p] = 0;
    }
    for (int32_t c = 0; c < matrix->mark.count; ++c) {
        matrix->mark.data[c] = KIRI_NONE;
    }
    for (int32_t n = 0; n < count; ++n) {
        int32_t c = matrix->place.data[frames[n]];
        matrix->frames.data[n] = frames[n];
        matrix->mark.data[c] = c;
        matrix->isChosen.data[matrix->panelOf.data[c]] = 1;
    }
    matrix->frames.count = count;
    SetZero(matrix->right.data, matrix->right.count);
    ChoosePanels(matrix);
    FindIdle(matrix);
}

int64_t kiriMatrix_ProductCount(const kiriMatrix* matrix, bool chosen)
{
    return (chosen ? matrix->chosenProducts : matrix->products) * matrix->size * matrix->size * matrix->size / 216;
}

bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair)
{
    KIRI_ASSERT(pair.a >= 0 && pair.a < matrix->count && pair.b >= 0 && pair.b < matrix->count);
    int32_t a = matrix->place.data[pair.a], b = matrix->place.data[pair.b];
    return FindBlock(matrix, a, b) != KIRI_NONE;
}

void kiriMatrix_RefuseLongVectors(kiriMatrix* matrix)
{
    matrix->hasLongVectors = false;
}

void kiriMatrix_Clear(kiriMatrix* matrix)
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

void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block)
{
    KIRI_ASSERT(frame >= 0 && frame < matrix->count);
    int32_t area = matrix->size * matrix->size;
    AddNumbers(&matrix->values.data[(int64_t)area * matrix->own.start.data[matrix->place.data[frame]]], block, area);
}

void kiriMatrix_AddBlock(kiriMatrix* matrix, int32_t down, int32_t across, const double* block)
{
    int32_t size = matrix->size, row = matrix->place.data[down], column = matrix->place.data[across];
    int32_t at = FindBlock(matrix, row, column);
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

void kiriMatrix_GetBlock(const kiriMatrix* matrix, int32_t down, int32_t across, double* block)
{
    int32_t size = matrix->size, row = matrix->place.data[down], column = matrix->place.data[across];
    int32_t at = FindBlock(matrix, row, column);
    KIRI_ASSERT(at != KIRI_NONE);
    const double* values = &matrix->values.data[(int64_t)size * size * at];
    for (int32_t c = 0; c < size; ++c) {
        for (int32_t r = 0; r < size; ++r) {
            *block++ = row < column ? values[size * r + c] : values[size * c + r];
        }
    }
}

void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* k, int32_t rows)
{
    for (int32_t e = 0; e < rows; e += MOST_ROWS) {
        Squares squares = { J + (int64_t)matrix->size * frameCount * e, k + e, rows - e };
        squares.rows = squares.rows < MOST_ROWS ? squares.rows : MOST_ROWS;
        for (int32_t b = 0; b < frameCount; ++b) {
            if (matrix->size == 6) {
                AddColumn(matrix, &squares, frames, frameCount, b, 6);
            } else if (matrix->size == 3) {
                AddColumn(matrix, &squares, frames, frameCount, b, 3);
            } else {
                AddColumn(matrix, &squares, frames, frameCount, b, 12);
            }
        }
    }
}

bool kiriMatrix_Factor(kiriMatrix* matrix)
{
    if (FactorOnce(matrix)) {
        return true;
    }
    ShiftDiagonal(matrix);
    return FactorOnce(matrix);
}

void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution)
{
    int32_t size = matrix->size;
    for (int32_t n = 0; n < matrix->frames.count; ++n) {
        int32_t f = matrix->frames.data[n];
        CopyEntries(matrix->right.data + size * matrix->place.data[f], right + size * f, size);
    }
    SolveDown(matrix, matrix->right.data);
    SolveUp(matrix, matrix->right.data);
    for (int32_t n = 0; n < matrix->frames.count; ++n) {
        int32_t f = matrix->frames.data[n];
        const double* from = matrix->right.data + size * matrix->place.data[f];
        CopyEntries(solution + size * f, from, size);
    }
}
