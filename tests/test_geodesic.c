/* Distances inside the cut sheet: against the closed formula where there are no cuts, and against Bellman and Ford
   where there are. */
#include "field/kiri_geodesic.h"
#include "mesh/kiri_cut.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

/* ---- Sheets ------------------------------------------------------------------------------------------------------ */

/* Counts live blocks, and returns null at the allocation numbered failAt. */
typedef struct Blocks {
    int32_t live, calls, failAt;
} Blocks;

static void* CountedAlloc(void* user, int64_t bytes)
{
    Blocks* blocks = user;
    if (++blocks->calls == blocks->failAt) {
        return NULL;
    }
    ++blocks->live;
    return malloc((size_t)bytes);
}

static void CountedFree(void* user, void* pointer)
{
    --((Blocks*)user)->live;
    free(pointer);
}

typedef struct Sheet {
    Blocks blocks;
    kiriMemory memory;
    kiriMeshData mesh;
    kiriGrid grid;
    kiriField field;
} Sheet;

/* The unit square, of two triangles. */
static void OpenSquare(Sheet* sheet, int32_t resolution)
{
    const float positions[8] = { 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 0.0f, 1.0f };
    const int32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    kiriFault why;
    memset(sheet, 0, sizeof(*sheet));
    sheet->memory = kiriMemory_Make(CountedAlloc, CountedFree, &sheet->blocks);
    assert_int_equal(kiriMesh_Init(&sheet->mesh, &sheet->memory,
                                   &(kiriMeshInput){ positions, 4, indices, 2, resolution, 0.0 }, &why),
                     KIRI_OK);
}

static void CloseSheet(Sheet* sheet)
{
    kiriMemory_FreeAll(sheet->mesh.memory);
    assert_int_equal(sheet->blocks.live, 0);
}

static void CutLine(Sheet* sheet, double x0, double y0, double x1, double y1)
{
    kiriMesh_Begin(&sheet->mesh);
    kiriBladeTip blade = kiriCut_Place(&sheet->mesh, kiriVec2_Make(x0, y0));
    kiriLatticePoint to = kiriMesh_Snap(&sheet->mesh, kiriVec2_Make(x1, y1));
    kiriQuota all = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriCut_Move(&sheet->mesh, &blade, to, 16.0, &all), KIRI_DONE);
    kiriMesh_Commit(&sheet->mesh);
}

static void CutRandomly(Sheet* sheet, uint32_t* seed, int32_t cuts)
{
    while (cuts-- > 0) {
        double x = RandomBetween(seed, -0.1, 1.1), y = RandomBetween(seed, -0.1, 1.1);
        CutLine(sheet, x, y, x + RandomBetween(seed, -0.7, 0.7), y + RandomBetween(seed, -0.7, 0.7));
    }
}

static void UpdateGrid(Sheet* sheet)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriGrid_Update(&sheet->grid, &sheet->mesh, &quota), KIRI_DONE);
    kiriSquares_ClearDirty(&sheet->mesh.squares);
}

static void Build(Sheet* sheet)
{
    UpdateGrid(sheet);
    kiriGrid_ClearChanges(&sheet->grid);
    kiriField_Clear(&sheet->field);
    assert_true(kiriField_Resize(&sheet->field, &sheet->memory, sheet->grid.cells.count));
}

static void FloodBy(Sheet* sheet, kiriField* field, const kiriRule* rule, const kiriSeed* seeds, int32_t count)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_true(kiriField_Start(field, &sheet->memory, seeds, count));
    assert_int_equal(kiriField_Flood(field, rule, &quota), KIRI_DONE);
}

static void Flood(Sheet* sheet, const kiriSeed* seeds, int32_t count, int32_t limit)
{
    kiriRule rule = { &sheet->grid, limit, NULL, NULL, NULL, NULL, { NULL, NULL } };
    FloodBy(sheet, &sheet->field, &rule, seeds, count);
}

static void FloodFrom(Sheet* sheet, int32_t cell)
{
    kiriSeed seed = { cell, 0, 7 };
    kiriField_Reset(&sheet->field);
    Flood(sheet, &seed, 1, KIRI_FAR);
}

static int32_t CellAt(const Sheet* sheet, double x, double y)
{
    kiriLatticePoint at = kiriMesh_Snap(&sheet->mesh, kiriVec2_Make(x, y));
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    assert_int_not_equal(triangle, KIRI_NONE);
    return kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
}

/* For each cell one of its piece, connected over faces: the same for all of them. */
static int32_t* Pieces(const kiriGrid* grid)
{
    int32_t* piece = malloc(sizeof(int32_t) * (size_t)grid->cells.count);
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        piece[c] = c;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t f = 0; f < grid->faces.count; ++f) {
            const int32_t* cell = grid->faces.data[f].cell;
            if (cell[0] != KIRI_NONE && piece[cell[0]] != piece[cell[1]]) {
                int32_t low = piece[cell[0]] < piece[cell[1]] ? piece[cell[0]] : piece[cell[1]];
                piece[cell[0]] = piece[cell[1]] = low;
                changed = true;
            }
        }
    }
    return piece;
}

/* ---- Independent answers ----------------------------------------------------------------------------------------- */

/* The shortest way in an open plane: knight moves while they are nearest to the direction, the rest straight or
   diagonal. */
static int32_t OpenDistance(int32_t dx, int32_t dy)
{
    int32_t a = abs(dx) > abs(dy) ? abs(dx) : abs(dy), b = abs(dx) > abs(dy) ? abs(dy) : abs(dx);
    return 2 * b <= a ? 572 * b + 256 * (a - 2 * b) : 572 * (a - b) + 362 * (2 * b - a);
}

/* The least (distance, owner) by relaxing all steps until nothing changes (Bellman and Ford). */
static void Relax(const kiriGrid* grid, const kiriSeed* seeds, int32_t count, int32_t limit, kiriPassFn* pass,
                  const void* context, int32_t* distance, int32_t* owner)
{
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        distance[c] = KIRI_FAR;
        owner[c] = KIRI_NONE;
    }
    for (int32_t i = 0; i < count; ++i) {
        int32_t c = seeds[i].cell, d = seeds[i].distance;
        if (d <= limit && (d < distance[c] || (d == distance[c] && seeds[i].owner < owner[c]))) {
            distance[c] = d;
            owner[c] = seeds[i].owner;
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t c = 0; c < grid->cells.count; ++c) {
            kiriSteps steps;
            kiriGrid_GetSteps(grid, c, &steps);
            for (int32_t s = 0; distance[c] < KIRI_FAR && s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
                int32_t to = steps.data[s].cell, d = distance[c] + steps.data[s].length;
                if (d <= limit && (d < distance[to] || (d == distance[to] && owner[c] < owner[to])) &&
                    (pass == NULL || pass(context, c))) {
                    distance[to] = d;
                    owner[to] = owner[c];
                    changed = true;
                }
            }
        }
    }
}

static void CheckAgainstRelaxing(Sheet* sheet, const kiriSeed* seeds, int32_t count, int32_t limit, kiriPassFn* pass,
                                 const void* context)
{
    int32_t n = sheet->grid.cells.count, reached = 0;
    int32_t *distance = malloc(sizeof(int32_t) * (size_t)n), *owner = malloc(sizeof(int32_t) * (size_t)n);
    Relax(&sheet->grid, seeds, count, limit, pass, context, distance, owner);
    kiriRule rule = { &sheet->grid, limit, pass, NULL, context, NULL, { NULL, NULL } };
    FloodBy(sheet, &sheet->field, &rule, seeds, count);
    assert_memory_equal(distance, sheet->field.distance.data, sizeof(int32_t) * (size_t)n);
    assert_memory_equal(owner, sheet->field.owner.data, sizeof(int32_t) * (size_t)n);
    for (int32_t c = 0; c < n; ++c) {
        reached += distance[c] != KIRI_FAR;
    }
    assert_int_equal(sheet->field.settled.count, reached);
    for (int32_t i = 0; i < reached; ++i) {
        int32_t c = sheet->field.settled.data[i];
        assert_true(distance[c] >= 0 && distance[c] != KIRI_FAR);
        assert_true(i == 0 || distance[c] >= distance[sheet->field.settled.data[i - 1]]);
    }
    free(distance);
    free(owner);
}

/* ---- The open sheet ---------------------------------------------------------------------------------------------- */

static void TestOpenSheet(void** state)
{
    (void)state;
    enum { N = 24 };
    Sheet sheet;
    OpenSquare(&sheet, N);
    Build(&sheet);
    const int32_t from[][2] = { { 0, 0 }, { 11, 11 }, { 0, 9 }, { 23, 1 }, { 5, 18 } };
    for (size_t i = 0; i < sizeof(from) / sizeof(from[0]); ++i) {
        FloodFrom(&sheet, sheet.grid.squareCell.data[from[i][1] * N + from[i][0]]);
        for (int32_t s = 0; s < N * N; ++s) {
            int32_t dx = s % N - from[i][0], dy = s / N - from[i][1];
            int32_t distance = sheet.field.distance.data[sheet.grid.squareCell.data[s]];
            double straight = 256.0 * sqrt((double)(dx * dx + dy * dy));
            assert_int_equal(distance, OpenDistance(dx, dy));
            assert_true(distance >= 0.999 * straight && distance <= 1.03 * straight);
            assert_int_equal(sheet.field.owner.data[sheet.grid.squareCell.data[s]], 7);
        }
        assert_int_equal(sheet.field.settled.count, N * N);
    }
    CloseSheet(&sheet);
}

static void TestSymmetric(void** state)
{
    (void)state;
    uint32_t seed = 99;
    Sheet sheet;
    OpenSquare(&sheet, 12);
    CutRandomly(&sheet, &seed, 9);
    Build(&sheet);
    int32_t n = sheet.grid.cells.count;
    int32_t* all = malloc(sizeof(int32_t) * (size_t)n * (size_t)n);
    int32_t* piece = Pieces(&sheet.grid);
    for (int32_t c = 0; c < n; ++c) {
        FloodFrom(&sheet, c);
        memcpy(all + c * n, sheet.field.distance.data, sizeof(int32_t) * (size_t)n);
    }
    for (int32_t a = 0; a < n; ++a) {
        for (int32_t b = 0; b < n; ++b) {
            assert_int_equal(all[a * n + b], all[b * n + a]);
            assert_int_equal(all[a * n + b] == KIRI_FAR, piece[a] != piece[b]);
        }
    }
    free(piece);
    free(all);
    CloseSheet(&sheet);
}

/* ---- Cuts -------------------------------------------------------------------------------------------------------- */

/* A slit from the left as far as into column 12, inside row 10: the way from above to below leads through its tip. */
static void TestDetourAroundSlit(void** state)
{
    (void)state;
    enum { N = 20, TIP = 12, ROW = 10 };
    Sheet sheet;
    OpenSquare(&sheet, N);
    CutLine(&sheet, -0.1, (ROW + 0.45) / N, (TIP + 0.6) / N, (ROW + 0.45) / N);
    Build(&sheet);
    for (int32_t column = 0; column < N; ++column) {
        for (int32_t up = 1; up < 8; ++up) {
            int32_t from = sheet.grid.squareCell.data[(ROW + up) * N + column];
            int32_t to = sheet.grid.squareCell.data[(ROW - up) * N + column];
            FloodFrom(&sheet, from);
            int32_t detour = column < TIP ? 2 * OpenDistance(TIP - column, up) : 2 * up * 256;
            assert_int_equal(sheet.field.distance.data[to], detour);
        }
    }
    /* From lip to lip, a thousandth of a square apart. */
    int32_t above = CellAt(&sheet, 2.5 / N, (ROW + 0.451) / N), below = CellAt(&sheet, 2.5 / N, (ROW + 0.449) / N);
    FloodFrom(&sheet, above);
    assert_int_equal(sheet.field.distance.data[below], 2 * 256 * (TIP - 2));
    CloseSheet(&sheet);
}

static void TestOtherPieceIsFar(void** state)
{
    (void)state;
    Sheet sheet;
    OpenSquare(&sheet, 10);
    CutLine(&sheet, -0.1, 0.33, 1.1, 0.57);
    Build(&sheet);
    FloodFrom(&sheet, CellAt(&sheet, 0.5, 0.1));
    int32_t *piece = Pieces(&sheet.grid), below = piece[CellAt(&sheet, 0.5, 0.1)], far = 0;
    assert_int_not_equal(piece[CellAt(&sheet, 0.5, 0.9)], below);
    for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
        bool isFar = sheet.field.distance.data[c] == KIRI_FAR;
        assert_int_equal(isFar, piece[c] != below);
        assert_int_equal(isFar, sheet.field.owner.data[c] == KIRI_NONE);
        far += isFar;
    }
    assert_int_equal(sheet.field.settled.count, sheet.grid.cells.count - far);
    free(piece);
    CloseSheet(&sheet);
}

/* ---- Seeds ------------------------------------------------------------------------------------------------------- */

static void TestTiesGoToTheLowerOwner(void** state)
{
    (void)state;
    enum { N = 9 };
    Sheet sheet;
    OpenSquare(&sheet, N);
    Build(&sheet);
    for (int order = 0; order < 2; ++order) {
        kiriSeed low = { sheet.grid.squareCell.data[4 * N], 0, 3 },
                 high = { sheet.grid.squareCell.data[4 * N + 8], 0, 5 };
        kiriSeed seeds[2] = { order == 0 ? low : high, order == 0 ? high : low };
        kiriField_Reset(&sheet.field);
        Flood(&sheet, seeds, 2, KIRI_FAR);
        for (int32_t s = 0; s < N * N; ++s) {
            assert_int_equal(sheet.field.owner.data[sheet.grid.squareCell.data[s]], s % N <= 4 ? 3 : 5);
        }
    }
    kiriSeed same[3] = { { 4, 10, 8 }, { 4, 10, 2 }, { 4, 11, 1 } };
    kiriField_Reset(&sheet.field);
    Flood(&sheet, same, 3, KIRI_FAR);
    assert_int_equal(sheet.field.owner.data[4], 2);
    assert_int_equal(sheet.field.owner.data[80], 2);
    assert_int_equal(sheet.field.settled.count, N * N);
    CloseSheet(&sheet);
}

static void TestLimitAndReset(void** state)
{
    (void)state;
    enum { N = 15 };
    Sheet sheet;
    OpenSquare(&sheet, N);
    Build(&sheet);
    kiriSeed seed = { sheet.grid.squareCell.data[7 * N + 7], 0, 0 };
    const int32_t limits[] = { 0, 255, 256, 361, 362, 572, 1000, 1280, -1 };
    for (size_t i = 0; i < sizeof(limits) / sizeof(limits[0]); ++i) {
        Flood(&sheet, &seed, 1, limits[i]);
        for (int32_t s = 0; s < N * N; ++s) {
            int32_t open = OpenDistance(s % N - 7, s / N - 7);
            assert_int_equal(sheet.field.distance.data[sheet.grid.squareCell.data[s]],
                             open <= limits[i] ? open : KIRI_FAR);
        }
        kiriField_Reset(&sheet.field);
        assert_int_equal(sheet.field.settled.count, 0);
        for (int32_t c = 0; c < N * N; ++c) {
            assert_int_equal(sheet.field.distance.data[c], KIRI_FAR);
            assert_int_equal(sheet.field.owner.data[c], KIRI_NONE);
        }
    }
    CloseSheet(&sheet);
}

/* Seeds that start late, even after the rest of the sweep has ended, and near the largest number there is. */
static void TestLateSeeds(void** state)
{
    (void)state;
    Sheet sheet;
    OpenSquare(&sheet, 10);
    CutLine(&sheet, -0.1, 0.45, 1.1, 0.45);
    Build(&sheet);
    int32_t above = CellAt(&sheet, 0.55, 0.95), below = CellAt(&sheet, 0.55, 0.05);
    kiriSeed seeds[3] = { { above, KIRI_FAR - 300, 1 }, { below, 0, 2 }, { below, 1, 0 } };
    Flood(&sheet, seeds, 3, KIRI_FAR);
    assert_int_equal(sheet.field.distance.data[CellAt(&sheet, 0.65, 0.95)], KIRI_FAR - 300 + 256);
    assert_int_equal(sheet.field.distance.data[CellAt(&sheet, 0.65, 0.85)], KIRI_FAR);
    assert_int_equal(sheet.field.owner.data[CellAt(&sheet, 0.05, 0.4)], 2);
    kiriField_Reset(&sheet.field);
    seeds[0].distance = 100000;
    CheckAgainstRelaxing(&sheet, seeds, 3, KIRI_FAR, NULL, NULL);
    CloseSheet(&sheet);
}

/* ---- Properties -------------------------------------------------------------------------------------------------- */

/* Stops at some cells: whatever the caller's rule, it is followed. */
static bool PassSome(const void* context, int32_t cell)
{
    return cell % (2 * *(const int32_t*)context) != 0;
}

static void TestRandomSheets(void** state)
{
    (void)state;
    uint32_t seed = 4242;
    for (int round = 0; round < 40; ++round) {
        Sheet sheet;
        OpenSquare(&sheet, 3 + (int32_t)(Random(&seed) % 18));
        CutRandomly(&sheet, &seed, (int32_t)(Random(&seed) % 25));
        Build(&sheet);
        for (int flood = 0; flood < 12; ++flood) {
            kiriSeed seeds[40];
            int32_t count = 1 + (int32_t)(Random(&seed) % 40), spread = flood % 3 == 0   ? 1
                                                                        : flood % 3 == 1 ? 700
                                                                                         : 5000;
            for (int32_t i = 0; i < count; ++i) {
                seeds[i].cell = (int32_t)(Random(&seed) % (uint32_t)sheet.grid.cells.count);
                seeds[i].distance = (int32_t)(Random(&seed) % (uint32_t)spread);
                seeds[i].owner = (int32_t)(Random(&seed) % 6);
            }
            int32_t limit = flood % 4 == 3 ? (int32_t)(Random(&seed) % 3000) : KIRI_FAR;
            int32_t rule = 2 + (int32_t)(Random(&seed) % 4);
            CheckAgainstRelaxing(&sheet, seeds, count, limit, flood % 2 == 1 ? PassSome : NULL, &rule);
            kiriField_Reset(&sheet.field);
        }
        CloseSheet(&sheet);
    }
}

/* Cells in their order. */
static int32_t* OrderedCells(const kiriGrid* grid)
{
    int32_t count = 0, *cells = malloc(sizeof(int32_t) * (size_t)grid->cells.count);
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        for (int32_t c = grid->squareCell.data[s]; c != KIRI_NONE; c = grid->cells.data[c].next) {
            cells[count++] = c;
        }
    }
    assert_int_equal(count, grid->cellCount);
    return cells;
}

/* A scan, or the flood that it could not replace, leaves what a flood leaves. Returns whether it could. */
static bool CheckScan(Sheet* sheet, const kiriSeed* seeds, int32_t count)
{
    int32_t *cells = OrderedCells(&sheet->grid), settled = 0;
    kiriRule rule = { &sheet->grid, KIRI_FAR, NULL, NULL, NULL, NULL, { NULL, NULL } };
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    kiriField scanned = { 0 };
    assert_true(kiriField_Resize(&scanned, &sheet->memory, sheet->grid.cells.count));
    assert_true(kiriField_Start(&scanned, &sheet->memory, seeds, count));
    kiriProgress progress = kiriField_Scan(&scanned, &sheet->memory, &sheet->grid, cells, sheet->grid.cellCount);
    bool isScanned = progress == KIRI_DONE;
    assert_true(isScanned || progress == KIRI_MORE); /* there is memory */
    assert_int_equal(scanned.settled.count > 0, isScanned);
    for (int32_t k = 0; isScanned && k < sheet->grid.cellCount; ++k) {
        if (scanned.distance.data[cells[k]] != KIRI_FAR) {
            assert_int_equal(scanned.settled.data[settled++], cells[k]);
        }
    }
    assert_int_equal(scanned.settled.count, settled);
    assert_int_equal(kiriField_Flood(&scanned, &rule, &quota), KIRI_DONE); /* nothing is left where it is scanned */
    Flood(sheet, seeds, count, KIRI_FAR);
    assert_int_equal(scanned.settled.count, sheet->field.settled.count);
    size_t bytes = sizeof(int32_t) * (size_t)sheet->grid.cells.count;
    assert_memory_equal(scanned.distance.data, sheet->field.distance.data, bytes);
    assert_memory_equal(scanned.owner.data, sheet->field.owner.data, bytes);
    kiriField_Reset(&sheet->field);
    kiriField_Reset(&scanned);
    for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
        assert_int_equal(scanned.distance.data[c], KIRI_FAR);
    }
    free(cells);
    return isScanned;
}

static void TestScans(void** state)
{
    (void)state;
    uint32_t seed = 77;
    int32_t scanned = 0, floods = 0;
    for (int round = 0; round < 40; ++round) {
        Sheet sheet;
        OpenSquare(&sheet, 3 + (int32_t)(Random(&seed) % 30));
        CutRandomly(&sheet, &seed, (int32_t)(Random(&seed) % 25));
        Build(&sheet);
        for (int flood = 0; flood < 8; ++flood, ++floods) {
            kiriSeed seeds[40];
            int32_t count = 1 + (int32_t)(Random(&seed) % 40);
            for (int32_t i = 0; i < count; ++i) {
                seeds[i].cell = (int32_t)(Random(&seed) % (uint32_t)sheet.grid.cells.count);
                seeds[i].distance = (int32_t)(Random(&seed) % (flood % 2 == 0 ? 3 : 900));
                seeds[i].owner = (int32_t)(Random(&seed) % 6);
            }
            scanned += CheckScan(&sheet, seeds, count);
        }
        CloseSheet(&sheet);
    }
    assert_true(scanned > floods / 2);
}

/* Around slits from both sides: too many bends for scans. */
static void TestWindingWays(void** state)
{
    (void)state;
    enum { SLITS = 12 };
    Sheet sheet;
    OpenSquare(&sheet, 40);
    Build(&sheet);
    kiriSeed seed = { CellAt(&sheet, 0.01, 0.01), 0, 3 };
    assert_true(CheckScan(&sheet, &seed, 1));
    for (int k = 1; k <= SLITS; ++k) {
        double x = (double)k / (SLITS + 1);
        CutLine(&sheet, x, k % 2 == 0 ? -0.1 : 1.1, x, k % 2 == 0 ? 0.9 : 0.1);
    }
    Build(&sheet);
    seed.cell = CellAt(&sheet, 0.01, 0.01);
    assert_false(CheckScan(&sheet, &seed, 1));
    CloseSheet(&sheet);
}

/* A cut divides cells and takes steps away, so from the copies of one square to those of another the way only grows.
   The field of the old grid serves the new one. */
static void TestCutsOnlyMakeWaysLonger(void** state)
{
    (void)state;
    enum { N = 14 };
    uint32_t seed = 31;
    Sheet sheet;
    OpenSquare(&sheet, N);
    int32_t last[N * N] = { 0 }, grown = 0;
    for (int cut = 0; cut < 15; ++cut) {
        Build(&sheet);
        kiriSeed seeds[64];
        int32_t count = 0;
        for (int32_t c = sheet.grid.squareCell.data[100]; c != KIRI_NONE; c = sheet.grid.cells.data[c].next) {
            kiriSeed start = { c, 0, 0 };
            seeds[count++] = start;
        }
        Flood(&sheet, seeds, count, KIRI_FAR);
        for (int32_t s = 0; s < N * N; ++s) {
            int32_t least = KIRI_FAR;
            for (int32_t c = sheet.grid.squareCell.data[s]; c != KIRI_NONE; c = sheet.grid.cells.data[c].next) {
                least = sheet.field.distance.data[c] < least ? sheet.field.distance.data[c] : least;
            }
            assert_true(least >= last[s]);
            grown += cut > 0 && least > last[s];
            last[s] = least;
        }
        CutRandomly(&sheet, &seed, 1);
    }
    assert_true(grown > 100);
    CloseSheet(&sheet);
}

/* ---- Repairs ----------------------------------------------------------------------------------------------------- */

typedef struct Starts {
    const kiriGrid* grid;
    int32_t columns;
} Starts;

/* All cells of some squares are seeds. */
static kiriSeed StartOf(const void* context, int32_t cell)
{
    const Starts* starts = context;
    int32_t square = starts->grid->cells.data[cell].square, column = square % starts->columns;
    int32_t row = square / starts->columns;
    kiriSeed start = { cell, 3 * row, square }, none = { cell, KIRI_FAR, KIRI_NONE };
    return column % 7 == 3 && row % 9 == 4 ? start : none;
}

/* The field from scratch, in another one; equal to the repaired one. */
static void CheckRepaired(Sheet* sheet, const kiriRule* rule)
{
    kiriField other = { 0 };
    KIRI_ARRAY(kiriSeed) seeds = { 0 };
    int32_t n = sheet->grid.cells.count;
    for (int32_t c = 0; c < n; ++c) {
        kiriSeed start = StartOf(rule->context, c);
        if (kiriGrid_IsCell(&sheet->grid, c) && start.distance != KIRI_FAR) {
            assert_true(kiriArray_Push(&sheet->memory, &seeds, start));
        }
    }
    assert_true(kiriField_Resize(&other, &sheet->memory, n));
    FloodBy(sheet, &other, rule, seeds.data, seeds.count);
    assert_memory_equal(other.distance.data, sheet->field.distance.data, sizeof(int32_t) * (size_t)n);
    assert_memory_equal(other.owner.data, sheet->field.owner.data, sizeof(int32_t) * (size_t)n);
    kiriArray_Release(&sheet->memory, &seeds);
}

/* Cut after cut, over many squares or within one, through and through or not. */
static void TestRepairsFollowCuts(void** state)
{
    (void)state;
    uint32_t seed = 12;
    for (int round = 0; round < 12; ++round) {
        Sheet sheet;
        OpenSquare(&sheet, 10 + (int32_t)(Random(&seed) % 20));
        Starts starts = { &sheet.grid, sheet.mesh.squares.columns };
        kiriRule rule = { &sheet.grid, round % 3 == 2 ? 1500 : KIRI_FAR, NULL, StartOf, &starts, NULL, { NULL, NULL } };
        for (int cut = 0; cut < 40; ++cut) {
            CutRandomly(&sheet, &seed, cut % 3);
            UpdateGrid(&sheet);
            const kiriGridChanges* changes = &sheet.grid.changes;
            assert_true(kiriField_Resize(&sheet.field, &sheet.memory, sheet.grid.cells.count));
            for (int32_t k = 0; k < changes->gone.count; ++k) {
                kiriField_Forget(&sheet.field, changes->gone.data[k]);
            }
            for (int32_t k = 0; k < changes->made.count + changes->steps.count; ++k) {
                int32_t cell =
                    k < changes->made.count ? changes->made.data[k] : changes->steps.data[k - changes->made.count];
                if (kiriGrid_IsCell(&sheet.grid, cell)) {
                    kiriField_MarkDirty(&sheet.field, cell);
                }
            }
            kiriQuota quota = { INT64_MAX, 0, 0, false };
            assert_int_equal(kiriField_Repair(&sheet.field, &sheet.memory, &rule, &quota), KIRI_DONE);
            kiriGrid_ClearChanges(&sheet.grid);
            CheckRepaired(&sheet, &rule);
        }
        CloseSheet(&sheet);
    }
}

static void TestFailingMemory(void** state)
{
    (void)state;
    Sheet sheet;
    OpenSquare(&sheet, 6);
    Build(&sheet);
    kiriSeed seeds[2] = { { 0, 0, 0 }, { 30, 0, 1 } };
    int32_t live = sheet.blocks.live, failures = 0;
    for (bool done = false; !done; ++failures) {
        kiriMemory own = kiriMemory_Like(&sheet.memory);
        kiriField field = { 0 };
        sheet.blocks.calls = 0;
        sheet.blocks.failAt = failures + 1;
        done = kiriField_Resize(&field, &own, sheet.grid.cells.count) && kiriField_Start(&field, &own, seeds, 2);
        assert_int_equal(done, sheet.blocks.calls < sheet.blocks.failAt);
        kiriMemory_FreeAll(&own);
        assert_int_equal(sheet.blocks.live, live);
    }
    assert_int_equal(failures, 6); /* five arrays */
    CloseSheet(&sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestOpenSheet),
        cmocka_unit_test(TestSymmetric),
        cmocka_unit_test(TestDetourAroundSlit),
        cmocka_unit_test(TestOtherPieceIsFar),
        cmocka_unit_test(TestTiesGoToTheLowerOwner),
        cmocka_unit_test(TestLimitAndReset),
        cmocka_unit_test(TestLateSeeds),
        cmocka_unit_test(TestRandomSheets),
        cmocka_unit_test(TestScans),
        cmocka_unit_test(TestWindingWays),
        cmocka_unit_test(TestCutsOnlyMakeWaysLonger),
        cmocka_unit_test(TestRepairsFollowCuts),
        cmocka_unit_test(TestFailingMemory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
