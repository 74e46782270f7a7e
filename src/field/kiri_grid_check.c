#include "kiri_field_check.h"
#include "kiri_grid_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust IsCellIndex[] = { KIRI_INDEX(KIRI_OF_CELLS, kiriSpan, first, first) };
static const kiriMust IsCellOrNone[] = { KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriSpan, first, first) };

static const kiriMust CellMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_SQUARES, kiriCell, square, square),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriCell, next, next),
    KIRI_INDEX_OR_NONE(KIRI_OF_FACES, kiriCell, firstFace, firstFace),
};

static const kiriMust FaceMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriFace, cell, cell),
    KIRI_INDEX_OR_NONE(KIRI_OF_FACES, kiriFace, next, next),
};

static const kiriMust MaterialChangeMust[] = {
    KIRI_INDEX(KIRI_OF_CELLS, kiriMaterialChange, cell, cell),
    KIRI_REALS(kiriMaterialChange, was, was),
};

static const kiriMust GridMust[] = {
    KIRI_REALS(kiriGrid, side, side),
    KIRI_ITEMS_MUST(kiriGrid, cells, CellMust),
    KIRI_LENGTH(KIRI_OF_CELLS, kiriGrid, runs),
    KIRI_ITEMS_MUST(kiriGrid, faces, FaceMust),
    KIRI_ITEMS_MUST(kiriGrid, squareCell, IsCellOrNone),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGrid, squareCell),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriGrid, whole),
    KIRI_ITEMS_MUST(kiriGrid, changes.made, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGrid, changes.gone, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGrid, changes.steps, IsCellIndex),
    KIRI_ITEMS_MUST(kiriGrid, changes.material, MaterialChangeMust),
    KIRI_ITEMS_MUST(kiriGrid, changes.edges, IsCellIndex),
};

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

/* Of a part of a square: sums of it hold. */
static bool IsMaterial(const kiriMoments* m, double side, double farthest)
{
    double area = m->area, most = area * farthest, mostOfSquares = most * farthest;
    return area >= 0.0 && area <= 1.01 * side * side && fabs(m->u) <= most && fabs(m->v) <= most &&
           fabs(m->uu) <= mostOfSquares && fabs(m->uv) <= mostOfSquares && fabs(m->vv) <= mostOfSquares;
}

static bool AreMaterials(const kiriGrid* grid, const kiriMeshData* mesh)
{
    double farthest = 2.0 * KIRI_LATTICE * mesh->step;
    bool areFine = grid->side == mesh->step * mesh->squares.side;
    for (int32_t c = 0; areFine && c < grid->cells.count; ++c) {
        int32_t own = grid->cells.data[c].material;
        areFine = own == KIRI_NONE || (IsMaterial(&grid->materials.data[own], grid->side, farthest) &&
                                       (grid->materials.data[own].area > 0.0 || !kiriGrid_IsCell(grid, c)));
    }
    for (int32_t k = 0; areFine && k < grid->changes.material.count; ++k) {
        areFine = IsMaterial(&grid->changes.material.data[k].was, grid->side, farthest);
    }
    return areFine;
}

/* Cells that are gone are in no list yet: nobody may get their index. */
static bool TakeGone(kiriCheck* check, const kiriGrid* grid, kiriChains* chains, int32_t cell)
{
    bool isFine = kiriCheck_That(check, !kiriGrid_IsCell(grid, cell) && !chains->seen[cell]);
    chains->seen[cell] = 1;
    chains->listed += 1;
    return isFine;
}

/* Those that were made, or are gone since the changes were cleared. */
static bool AreGone(kiriCheck* check, const kiriGrid* grid, kiriChains* chains)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < grid->changes.gone.count; ++k) {
        areFine = TakeGone(check, grid, chains, grid->changes.gone.data[k]);
    }
    for (int32_t k = 0; areFine && k < grid->changes.made.count; ++k) {
        int32_t cell = grid->changes.made.data[k];
        areFine = kiriGrid_IsCell(grid, cell) || kiriGrid_IsForgotten(grid, KIRI_CHANGES_MADE, k) ||
                  TakeGone(check, grid, chains, cell);
    }
    return areFine;
}

/* The cells of a square; a whole one has one. */
static bool AreCellsOf(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh, kiriChains* chains,
                       int32_t square)
{
    int32_t first = grid->squareCell.data[square];
    bool areFine = kiriCheck_Chain(check, chains, first);
    for (int32_t c = first; areFine && c != KIRI_NONE; c = grid->cells.data[c].next) {
        int32_t triangle = grid->cells.data[c].triangle;
        areFine = kiriCheck_That(check, grid->cells.data[c].square == square && triangle >= 0 &&
                                            triangle < mesh->triangles.count && kiriMesh_IsTriangle(mesh, triangle));
    }
    return areFine && kiriCheck_That(check, !grid->whole.data[square] ||
                                                (first != KIRI_NONE && grid->cells.data[first].next == KIRI_NONE));
}

/* Each cell is of its square, or free, or gone. */
static bool AreCellsSound(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriChains chains;
    bool areFine = kiriCheck_StartChains(check, &chains, &grid->cells.data->next, sizeof(kiriCell), grid->cells.count);
    for (int32_t s = 0; areFine && s < grid->squareCell.count; ++s) {
        areFine = AreCellsOf(check, grid, mesh, &chains, s);
    }
    areFine = areFine && kiriCheck_That(check, chains.listed == grid->cellCount && grid->freeCell >= KIRI_NONE &&
                                                   grid->freeCell < grid->cells.count);
    for (int32_t c = grid->freeCell; areFine && c != KIRI_NONE; c = grid->cells.data[c].next) {
        areFine = TakeGone(check, grid, &chains, c);
    }
    areFine = areFine && AreGone(check, grid, &chains) && kiriCheck_That(check, chains.listed == grid->cells.count);
    kiriMemory_Free(&check->memory, chains.seen);
    return areFine;
}

/* ---- Faces ------------------------------------------------------------------------------------------------------- */

/* Of two cells that live, in squares beside each other. Those of the side at hand are empty until they are added up. */
static bool IsFace(const kiriGrid* grid, const kiriSquareRows* rows, const kiriFace* face)
{
    bool mayBeEmpty = grid->work->running && grid->work->isMerging;
    double width = kiriFace_HasOwnStretch(face) ? grid->stretches.data[face->kind / 2 - 1].width : 1.0;
    if (face->cell[1] == KIRI_NONE || !(width > 0.0 || (mayBeEmpty && width == 0.0))) {
        return false;
    }
    int32_t a = grid->cells.data[face->cell[0]].square, b = grid->cells.data[face->cell[1]].square;
    int32_t axis = kiriFace_Axis(face), apart = axis == 0 ? 1 : rows->columns;
    return a != KIRI_NONE && b == a + apart && (axis == 1 || kiriSquareRows_At(rows, a) == kiriSquareRows_At(rows, b));
}

static int32_t CountFaces(const kiriGrid* grid, const kiriSquares* squares, bool* areFine)
{
    kiriSquareRows rows = kiriSquareRows_Of(squares);
    int32_t live = 0;
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        if (grid->faces.data[f].cell[0] != KIRI_NONE) {
            *areFine = *areFine && IsFace(grid, &rows, &grid->faces.data[f]);
            ++live;
        }
    }
    return live;
}

/* Faces are in the lists of both their cells, once; or free. A list that does not end has too many. */
static bool AreFaces(const kiriGrid* grid, const kiriSquares* squares)
{
    bool areFine = true;
    int64_t live = CountFaces(grid, squares, &areFine), listed = 0, unused = 0;
    for (int32_t c = 0; areFine && c < grid->cells.count; ++c) {
        int32_t f = grid->cells.data[c].square != KIRI_NONE ? grid->cells.data[c].firstFace : KIRI_NONE;
        while (areFine && f != KIRI_NONE) {
            const kiriFace* face = &grid->faces.data[f];
            areFine = face->cell[0] != KIRI_NONE && (face->cell[0] == c || face->cell[1] == c) && listed < 2 * live;
            f = face->next[face->cell[1] == c];
            ++listed;
        }
    }
    areFine = areFine && listed == 2 * live && grid->freeFace >= KIRI_NONE && grid->freeFace < grid->faces.count;
    for (int32_t f = grid->freeFace; areFine && f != KIRI_NONE; f = grid->faces.data[f].next[0]) {
        areFine = grid->faces.data[f].cell[0] == KIRI_NONE && unused < grid->faces.count;
        ++unused;
    }
    return areFine && live + unused == grid->faces.count;
}

/* ---- What the mesh has in cells ---------------------------------------------------------------------------------- */

/* Which squares the grid has not seen since they changed: those from some dirty one on. */
static int32_t FirstUnseen(const kiriGrid* grid, const kiriSquares* squares)
{
    const kiriGridWork* work = grid->work;
    return !work->running ? 0 : work->fromScratch || work->stage > 0 ? squares->dirty.count : work->item;
}

static bool AreNodesIn(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    const uint32_t count = (uint32_t)grid->cells.count;
    int32_t last = KIRI_NONE;
    for (int32_t n = squares->head[square]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
        int32_t cell = n < grid->nodeCell.count ? grid->nodeCell.data[n] : KIRI_NONE;
        if (cell == last && cell != KIRI_NONE) {
            continue;
        }
        if ((uint32_t)cell >= count || grid->cells.data[cell].square != square) {
            return false;
        }
        last = cell;
    }
    return true;
}

/* In a square with several cells. */
static bool AreVerticesIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    int32_t first = grid->squareCell.data[square];
    bool areFine = true, areSeveral = first != KIRI_NONE && grid->cells.data[first].next != KIRI_NONE;
    for (int32_t v = areSeveral ? mesh->squares.vertexHead[square] : KIRI_NONE; areFine && v != KIRI_NONE;
         v = mesh->vertices.data[v].next) {
        int32_t cell = v < grid->vertexCell.count ? grid->vertexCell.data[v] : KIRI_NONE;
        areFine = cell >= 0 && cell < grid->cells.count && grid->cells.data[cell].square == square;
    }
    return areFine;
}

/* Cells of triangles and of vertices, in all squares that the grid has seen. */
static bool AreMembers(kiriCheck* check, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    const kiriGridWork* work = grid->work;
    uint8_t* isUnseen = kiriCheck_Bytes(check, grid->squareCell.count);
    bool areFine = isUnseen != NULL;
    for (int32_t k = FirstUnseen(grid, squares); areFine && k < squares->dirty.count; ++k) {
        isUnseen[squares->dirty.data[k]] = 1;
    }
    bool isScratch = work->running && work->fromScratch && work->stage == 0;
    for (int32_t s = 0; areFine && s < grid->squareCell.count; ++s) {
        bool isSeen = isScratch ? s < work->item : !isUnseen[s];
        areFine = !isSeen || (AreNodesIn(grid, squares, s) && AreVerticesIn(grid, mesh, s));
    }
    kiriMemory_Free(&check->memory, isUnseen);
    return kiriCheck_That(check, areFine);
}

/* Nodes and vertices that came since the grid was that of the mesh are in squares that changed. */
static bool HaveCells(const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    return grid->nodeCell.count <= squares->nodes.count && grid->vertexCell.count <= mesh->vertices.count &&
           (squares->dirty.count > 0 ||
            (grid->nodeCell.count == squares->nodes.count && grid->vertexCell.count == mesh->vertices.count));
}

bool kiriGrid_Check(const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check)
{
    const kiriSquares* squares = &mesh->squares;
    check->count[KIRI_OF_CELLS] = grid->cells.count;
    check->count[KIRI_OF_FACES] = grid->faces.count;
    return kiriCheck_That(check, grid->work != NULL && grid->cells.count > 0) &&
           kiriCheck_Object(check, GridMust, grid) && kiriGrid_CheckOwn(grid, check) &&
           kiriCheck_That(check, AreMaterials(grid, mesh) && HaveCells(grid, mesh)) &&
           AreCellsSound(check, grid, mesh) && kiriCheck_That(check, AreFaces(grid, squares)) &&
           kiriGrid_CheckSteps(grid, squares, check) && kiriGrid_CheckWork(grid, mesh, check) &&
           AreMembers(check, grid, mesh);
}

bool kiriGrid_CheckLeft(const kiriGrid* grid, kiriCheck* check)
{
    return grid->work == NULL || kiriCheck_Indices(check, &grid->work->flagged, grid->work->squareFlags.count);
}

bool kiriGrid_IsAtWork(const kiriGrid* grid)
{
    return grid->work != NULL && grid->work->running;
}
