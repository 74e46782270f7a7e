#include "kiri_probe.h"

#include "kiri_piece.h"

#include <string.h>

/* ---- Choice ---- */

enum { INSIDE = 4, PROBES_A_FRAME = 6 };

/* So many squares of the grid, across and along, that have one probe inside of a piece. */
typedef struct Block {
    int32_t size, column, row;
} Block;

/* The vertex chosen so far for the material of a piece in the block at hand: of its border in a quarter of the block,
   or of the inside. */
typedef struct Choice {
    int32_t piece, quarter, vertex;
    double rank; /* the lowest is taken */
} Choice;

typedef KIRI_ARRAY(Choice) Choices;

/* The sharper the corner the shorter the way into its material. */
static double Rank(const kiriSheetData* sheet, int32_t vertex)
{
    kiriVec2 lean = kiriVec2_Scale(0.125, sheet->probes.leans.data[vertex]);
    return sheet->probes.isBorder.data[vertex] ? kiriVec2_Dot(lean, lean) : 1.0;
}

static int32_t QuarterOf(const kiriSheetData* sheet, const Block* block, int32_t vertex)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    kiriLatticePoint at = sheet->mesh.vertices.data[vertex].at;
    int64_t half = (int64_t)block->size * squares->side / 2;
    kiriLatticePoint corner = kiriSquares_Corner(squares, block->row * squares->columns + block->column);
    return !sheet->probes.isBorder.data[vertex] ? INSIDE : (at.x - corner.x >= half) + 2 * (at.y - corner.y >= half);
}

static bool ConsiderVertex(const kiriSheetData* sheet, kiriMemory* scratch, Choices* choices, const Block* block,
                           int32_t vertex)
{
    Choice choice = { sheet->probes.vertexPiece.data[vertex], QuarterOf(sheet, block, vertex), vertex,
                      Rank(sheet, vertex) };
    for (int32_t i = 0; i < choices->count; ++i) {
        Choice* other = &choices->data[i];
        if (other->piece == choice.piece && other->quarter == choice.quarter) {
            bool isBetter = choice.rank < other->rank || (choice.rank == other->rank && vertex < other->vertex);
            *other = isBetter ? choice : *other;
            return true;
        }
    }
    return kiriArray_Push(scratch, choices, choice);
}

/* The inside needs no probe where the border has one. */
static bool IsNeeded(const Choices* choices, const Choice* choice)
{
    bool hasBorder = false;
    for (int32_t i = 0; i < choices->count; ++i) {
        hasBorder |= choices->data[i].piece == choice->piece && choices->data[i].quarter != INSIDE;
    }
    return choice->quarter != INSIDE || !hasBorder;
}

static bool ChooseInBlock(kiriSheetData* sheet, kiriMemory* scratch, Choices* choices, const Block* block)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    bool ok = true;
    choices->count = 0;
    for (int32_t y = block->row; y < block->row + block->size && y < squares->rows; ++y) {
        for (int32_t x = block->column; x < block->column + block->size && x < squares->columns; ++x) {
            int32_t v = squares->vertexHead[y * squares->columns + x];
            for (; ok && v != KIRI_NONE; v = sheet->mesh.vertices.data[v].next) {
                ok = ConsiderVertex(sheet, scratch, choices, block, v);
            }
        }
    }
    for (int32_t i = 0; ok && i < choices->count; ++i) {
        sheet->probes.isChosen.data[choices->data[i].vertex] = IsNeeded(choices, &choices->data[i]);
    }
    return ok;
}

/* Frames bend the surface, so that more probes than a dozen for each tell nothing new. */
static int32_t BlockSize(const kiriSheetData* sheet)
{
    double squares = (double)sheet->grid.cellCount / (sheet->frames.count * (double)PROBES_A_FRAME);
    int32_t size = 1;
    while ((double)(size + 1) * (size + 1) <= squares) {
        ++size;
    }
    return size;
}

/* By piece, then by index. */
static bool ListChosen(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    int32_t pieces = sheet->layout.pieces.count, count = 0;
    if (!kiriArray_Resize(sheet->memory, &probes->list.first, pieces + 2)) {
        return false;
    }
    int32_t* first = probes->list.first.data;
    memset(first, 0, sizeof(int32_t) * (size_t)(pieces + 2));
    for (int32_t v = 0; v < probes->isChosen.count; ++v) {
        first[probes->vertexPiece.data[v] + 2] += probes->isChosen.data[v];
        count += probes->isChosen.data[v];
    }
    for (int32_t p = 0; p < pieces; ++p) {
        first[p + 2] += first[p + 1];
    }
    if (!kiriArray_Resize(sheet->memory, &probes->list.items, count) ||
        !kiriArray_Resize(sheet->memory, &probes->velocities, count)) {
        return false;
    }
    for (int32_t v = 0; v < probes->isChosen.count; ++v) {
        if (probes->isChosen.data[v]) {
            probes->list.items.data[first[probes->vertexPiece.data[v] + 1]++] = v;
        }
    }
    return true;
}

/* An edge of the border begins the fan at the one end, and ends that at the other. */
static void MarkBorderEdge(kiriSheetData* sheet, int32_t from, int32_t to)
{
    kiriProbes* probes = &sheet->probes;
    kiriVec2 along = kiriMesh_Direction(&sheet->mesh, from, to), left = kiriVec2_Make(-along.y, along.x);
    probes->isBorder.data[from] = probes->isBorder.data[to] = 1;
    probes->leans.data[from] = kiriVec2_Add(probes->leans.data[from], left);
    probes->leans.data[to] = kiriVec2_Add(probes->leans.data[to], left);
}

static void MarkBorder(kiriSheetData* sheet)
{
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        const kiriTriangle* triangle = &sheet->mesh.triangles.data[t];
        for (int i = 0; kiriMesh_IsTriangle(&sheet->mesh, t) && i < 3; ++i) {
            if ((triangle->marks >> i & 1) != 0 || triangle->twin[i] == KIRI_NONE) {
                MarkBorderEdge(sheet, triangle->vertex[i], triangle->vertex[(i + 1) % 3]);
            }
        }
    }
}

static bool MarkVertices(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    int32_t vertices = sheet->mesh.vertices.count;
    if (!kiriArray_Resize(sheet->memory, &probes->vertexPiece, vertices) ||
        !kiriArray_Resize(sheet->memory, &probes->isBorder, vertices) ||
        !kiriArray_Resize(sheet->memory, &probes->leans, vertices) ||
        !kiriArray_Resize(sheet->memory, &probes->isChosen, vertices) ||
        !kiriArray_Resize(sheet->memory, &probes->touch, vertices) ||
        !kiriArray_Resize(sheet->memory, &probes->boxes, sheet->layout.pieces.count) ||
        !kiriArray_Resize(sheet->memory, &probes->speeds, sheet->layout.pieces.count)) {
        return false;
    }
    probes->areGrouped = false;
    for (int32_t v = 0; v < vertices; ++v) {
        probes->vertexPiece.data[v] = kiriPiece_OfVertex(sheet, v);
        probes->isBorder.data[v] = probes->isChosen.data[v] = 0;
        probes->leans.data[v] = kiriVec2_Make(0.0, 0.0);
    }
    MarkBorder(sheet);
    return true;
}

static bool ChooseProbes(kiriSheetData* sheet)
{
    kiriMemory scratch = kiriMemory_Like(sheet->memory);
    Choices choices = { NULL, 0, 0 };
    bool ok = MarkVertices(sheet);
    Block block = { sheet->probes.block, 0, 0 };
    for (; ok && block.row < sheet->mesh.squares.rows; block.row += block.size) {
        for (block.column = 0; ok && block.column < sheet->mesh.squares.columns; block.column += block.size) {
            ok = ChooseInBlock(sheet, &scratch, &choices, &block);
        }
    }
    kiriMemory_FreeAll(&scratch);
    return ok && ListChosen(sheet);
}

/* ---- Where they are ---- */

kiriVec3 kiriProbe_Velocity(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec2 local = sheet->seen.surface.rest.data[vertex];
    kiriVec3 velocity = { 0.0, 0.0, 0.0 };
    for (int32_t i = span.first; i < span.first + span.count; ++i) {
        kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
        velocity = kiriVec3_AddScaled(
            velocity, weight.value,
            kiriFrame_VelocityAt(&sheet->frames.data[kiriSheet_FrameOf(sheet, weight.label)], local));
    }
    return velocity;
}

static void BoundPieces(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    for (int32_t p = 0; p < probes->boxes.count; ++p) {
        probes->boxes.data[p].lower = kiriVec3_Make(HUGE_VAL, HUGE_VAL, HUGE_VAL);
        probes->boxes.data[p].upper = kiriVec3_Make(-HUGE_VAL, -HUGE_VAL, -HUGE_VAL);
    }
    for (int32_t v = 0; v < probes->vertexPiece.count; ++v) {
        if (probes->vertexPiece.data[v] == KIRI_NONE) {
            continue; /* a hole */
        }
        kiriBox* box = &probes->boxes.data[probes->vertexPiece.data[v]];
        kiriVec3 x = kiriSurface_At(&sheet->seen.surface, v), *a = &box->lower, *b = &box->upper;
        *a = kiriVec3_Make(kiriMin(x.x, a->x), kiriMin(x.y, a->y), kiriMin(x.z, a->z));
        *b = kiriVec3_Make(kiriMax(x.x, b->x), kiriMax(x.y, b->y), kiriMax(x.z, b->z));
    }
}

static void MeasureVelocities(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriSpan span = kiriPieceRow_Of(&probes->list, p);
        double most = 0.0;
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            probes->velocities.data[i] = kiriProbe_Velocity(sheet, probes->list.items.data[i]);
            double squared = kiriVec3_Dot(probes->velocities.data[i], probes->velocities.data[i]);
            most = kiriMax(squared, most);
        }
        probes->speeds.data[p] = sqrt(most);
    }
}

bool kiriProbes_Update(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    bool isNew = !probes->isFresh;
    probes->block = isNew ? BlockSize(sheet) : probes->block;
    if (isNew && !ChooseProbes(sheet)) {
        return false;
    }
    probes->isFresh = true;
    if (isNew || !sheet->rest.asleep) {
        BoundPieces(sheet);
        MeasureVelocities(sheet);
    }
    return true;
}

bool kiriProbes_Remake(kiriSheetData* sheet)
{
    if (!ChooseProbes(sheet)) {
        return false;
    }
    BoundPieces(sheet);
    MeasureVelocities(sheet);
    return true;
}
