/* What cells and faces cover. In a whole square that follows from where it is; others have it stored. */
#include "kiri_grid_work.h"

/* ---- Of whole squares -------------------------------------------------------------------------------------------- */

kiriMoments kiriGrid_MaterialOfWhole(const kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    double x = grid->side, area = x * x;
    kiriMoments about = {
        area, x / 2.0 * area, x / 2.0 * area, area * area / 3.0, area * area / 4.0, area * area / 3.0
    };
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    return kiriMoments_About(&about, kiriVec2_Scale(-1.0, corner));
}

static kiriStretch StretchOfWhole(const kiriMeshData* mesh, int32_t square, int32_t axis)
{
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    double side = mesh->squares.side, width = mesh->step * side, along = 0.5 * mesh->step * side;
    kiriVec2 middle = axis == 0 ? kiriVec2_Make(corner.x, corner.y + along) : kiriVec2_Make(corner.x + along, corner.y);
    return (kiriStretch){ width, middle, width * width * width / 12.0 };
}

/* ---- What they have ---------------------------------------------------------------------------------------------- */

kiriMoments kiriGrid_Material(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    const kiriCell* at = &grid->cells.data[cell];
    return at->material == KIRI_NONE ? kiriGrid_MaterialOfWhole(grid, mesh, at->square)
                                     : grid->materials.data[at->material];
}

/* Of a whole square term by term as kiriGrid_MaterialOfWhole has them. */
kiriFirstMoments kiriGrid_FirstMoments(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    const kiriCell* at = &grid->cells.data[cell];
    if (at->material != KIRI_NONE) {
        const kiriMoments* own = &grid->materials.data[at->material];
        return (kiriFirstMoments){ own->area, own->u, own->v };
    }
    double x = grid->side, area = x * x, about = x / 2.0 * area;
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, at->square));
    return (kiriFirstMoments){ area, about + corner.x * area, about + corner.y * area };
}

static int32_t StretchIndexOf(const kiriFace* face)
{
    return (face->kind >> 1) - 1;
}

kiriStretch kiriGrid_Stretch(const kiriGrid* grid, const kiriMeshData* mesh, int32_t face)
{
    const kiriFace* at = &grid->faces.data[face];
    int32_t index = StretchIndexOf(at);
    return index == KIRI_NONE ? StretchOfWhole(mesh, grid->cells.data[at->cell[1]].square, kiriFace_Axis(at))
                              : grid->stretches.data[index];
}

/* ---- Their own --------------------------------------------------------------------------------------------------- */

/* Room for one more item, or an unused one. The list of unused ones always has room for all. */
static bool MakeRoomForOwn(kiriMemory* memory, void* array, size_t itemBytes, kiriIndices* unused)
{
    int64_t need = (int64_t)kiriArray_GetHeader(array).count + 1;
    return unused->count > 0 ||
           (kiriArray_Grow(memory, array, need, itemBytes) && kiriArray_Reserve(memory, unused, need));
}

/* There is one, or room. */
static int32_t TakeOwn(void* array, kiriIndices* unused)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (unused->count > 0) {
        return unused->data[--unused->count];
    }
    header.count += 1;
    kiriArray_SetHeader(array, header);
    return header.count - 1;
}

kiriMoments* kiriGrid_OwnMaterial(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    int32_t* own = &grid->cells.data[cell].material;
    if (*own == KIRI_NONE) {
        if (!MakeRoomForOwn(memory, &grid->materials, sizeof(kiriMoments), &grid->unusedMaterials)) {
            return NULL;
        }
        *own = TakeOwn(&grid->materials, &grid->unusedMaterials);
    }
    return &grid->materials.data[*own];
}

kiriStretch* kiriGrid_OwnStretch(kiriGrid* grid, kiriMemory* memory, int32_t face)
{
    kiriFace* at = &grid->faces.data[face];
    if (StretchIndexOf(at) == KIRI_NONE) {
        if (!MakeRoomForOwn(memory, &grid->stretches, sizeof(kiriStretch), &grid->unusedStretches)) {
            return NULL;
        }
        at->kind = 2 * (TakeOwn(&grid->stretches, &grid->unusedStretches) + 1) + kiriFace_Axis(at);
    }
    return &grid->stretches.data[StretchIndexOf(at)];
}

static void GiveBack(kiriIndices* unused, int32_t index)
{
    if (index != KIRI_NONE) {
        KIRI_ASSERT(unused->count < unused->capacity);
        unused->data[unused->count++] = index;
    }
}

void kiriGrid_DropMaterial(kiriGrid* grid, int32_t cell)
{
    GiveBack(&grid->unusedMaterials, grid->cells.data[cell].material);
    grid->cells.data[cell].material = KIRI_NONE;
}

void kiriGrid_DropStretch(kiriGrid* grid, int32_t face)
{
    kiriFace* at = &grid->faces.data[face];
    GiveBack(&grid->unusedStretches, StretchIndexOf(at));
    at->kind = kiriFace_Axis(at);
}
