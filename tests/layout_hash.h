/* A hash of all that a sheet is but for its motion: mesh, grid, regions, shape functions, links, weights of samples. It
   does not depend on the indices of cells, which tell in what order they were made. No update may be at hand. */
#ifndef KIRI_TEST_LAYOUT_HASH_H
#define KIRI_TEST_LAYOUT_HASH_H

#include "core/kiri_archive.h"
#include "world/kiri_state.h"

/* Adds bytes by FNV-1a. */
static void HashBytes(uint64_t* hash, const void* data, size_t bytes)
{
    for (size_t i = 0; i < bytes; ++i) {
        kiriHash_Word(hash, ((const unsigned char*)data)[i]);
    }
}

static inline void HashPlace(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    kiriHash_Int32(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].square);
    kiriHash_Int32(hash, cell == KIRI_NONE ? KIRI_NONE : grid->cells.data[cell].triangle);
}

static inline void HashSteps(uint64_t* hash, const kiriGrid* grid, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetSteps(grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        HashPlace(hash, grid, step.cell);
        kiriHash_Int32(hash, step.length);
    }
}

/* A sum, for a cell's faces come in no order. */
static inline uint64_t HashFaces(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    uint64_t sum = 0;
    for (int32_t f = grid->cells.data[cell].firstFace; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        kiriStretch s = kiriGrid_Stretch(grid, mesh, f);
        uint64_t hash = KIRI_HASH_START;
        HashPlace(&hash, grid, face->cell[0]);
        HashPlace(&hash, grid, face->cell[1]);
        kiriHash_Int32(&hash, kiriFace_Axis(face));
        kiriHash_Double(&hash, s.width);
        kiriHash_Double(&hash, s.moment);
        kiriHash_Double(&hash, s.middle.x);
        kiriHash_Double(&hash, s.middle.y);
        sum += hash;
        f = face->next[face->cell[1] == cell];
    }
    return sum;
}

static inline void HashCellWeights(uint64_t* hash, const kiriShape* shape, int32_t cell)
{
    kiriSpan span = shape->spans.data[cell];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        kiriHash_Int32(hash, kiriLabels_Item(&shape->labels, shape->weights.data[k].label));
        kiriHash_Double(hash, kiriCellWeight_Raw(&shape->weights.data[k]) / kiriShape_Sum(shape, span));
    }
}

static inline void HashCell(uint64_t* hash, const kiriSheetData* sheet, int32_t cell)
{
    uint64_t faces = HashFaces(&sheet->grid, &sheet->mesh, cell);
    HashPlace(hash, &sheet->grid, cell);
    kiriMoments material = kiriGrid_Material(&sheet->grid, &sheet->mesh, cell);
    HashBytes(hash, &material, sizeof(kiriMoments));
    HashSteps(hash, &sheet->grid, cell);
    HashBytes(hash, &faces, sizeof(faces));
    kiriHash_Int32(hash, sheet->regions.field.owner.data[cell]);
    kiriHash_Int32(hash, sheet->regions.field.distance.data[cell]);
    kiriHash_Int32(hash, sheet->regions.onBorder.data[cell]);
    HashCellWeights(hash, &sheet->shape, cell);
}

static inline uint64_t HashLayout(const kiriSheetData* sheet)
{
    uint64_t hash = KIRI_HASH_START;
    kiriStateHash_AddLayout(&hash, sheet);
    for (int32_t s = 0; s < sheet->grid.squareCell.count; ++s) {
        for (int32_t c = sheet->grid.squareCell.data[s]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            HashCell(&hash, sheet, c);
        }
    }
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        HashBytes(&hash, &sheet->regions.material.data[f], sizeof(kiriTally));
        HashBytes(&hash, &sheet->shape.rigid.data[f], sizeof(int64_t));
        HashPlace(&hash, &sheet->grid, sheet->frames.data[f].site.cell);
    }
    return hash;
}

#endif
