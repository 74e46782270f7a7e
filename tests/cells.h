/* Cells and faces with what they cover, be it stored or not. */
#ifndef KIRI_TESTS_CELLS_H
#define KIRI_TESTS_CELLS_H

#include "../src/field/kiri_grid.h"

typedef struct Face {
    int32_t cell[2], axis;
    double width;
    kiriVec2 middle;
    double moment;
} Face;

static inline Face Face_Of(const kiriGrid* grid, const kiriMeshData* mesh, int32_t f)
{
    const kiriFace* face = &grid->faces.data[f];
    kiriStretch s = kiriGrid_Stretch(grid, mesh, f);
    return (Face){ { face->cell[0], face->cell[1] }, kiriFace_Axis(face), s.width, s.middle, s.moment };
}

/* Nothing for a cell that is neither alive nor has gone just now. */
static inline kiriMoments Cell_Material(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    bool has = kiriGrid_IsCell(grid, cell) || grid->cells.data[cell].material != KIRI_NONE;
    return has ? kiriGrid_Material(grid, mesh, cell) : (kiriMoments){ 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
}

#endif
