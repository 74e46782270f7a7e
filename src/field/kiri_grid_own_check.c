#include "kiri_field_check.h"

/* Items that are somebody's or unused, each once: so there is always room to give one back. `indexOf`: that which the
   item of a row has, or KIRI_NONE. */
typedef int32_t OwnIndexFn(const kiriGrid* grid, int32_t item);

static bool AreOwnedOnce(kiriCheck* check, const kiriGrid* grid, int32_t rows, OwnIndexFn* indexOf,
                         const kiriIndices* unused, int32_t count)
{
    uint8_t* isTaken = kiriCheck_Bytes(check, (int64_t)count + 1);
    bool areFine = isTaken != NULL && unused->capacity >= count;
    for (int32_t k = 0; areFine && k < rows + unused->count; ++k) {
        int32_t index = k < rows ? indexOf(grid, k) : unused->data[k - rows];
        areFine = index == KIRI_NONE ? k < rows : index >= 0 && index < count && !isTaken[index];
        if (areFine && index != KIRI_NONE) {
            isTaken[index] = 1;
        }
    }
    kiriMemory_Free(&check->memory, isTaken);
    return areFine;
}

static int32_t MaterialIndexOf(const kiriGrid* grid, int32_t cell)
{
    return grid->cells.data[cell].material;
}

static int32_t StretchIndexOfFace(const kiriGrid* grid, int32_t face)
{
    int32_t kind = grid->faces.data[face].kind;
    return kind < 0 ? INT32_MAX : kind / 2 - 1;
}

/* What a cell covered that is gone cannot follow from its square. */
static bool HasMaterial(const kiriGrid* grid, int32_t cell)
{
    return kiriGrid_IsCell(grid, cell) || grid->cells.data[cell].material != KIRI_NONE;
}

static bool HaveGoneMaterial(const kiriGrid* grid)
{
    bool have = true;
    for (int32_t k = 0; have && k < grid->changes.gone.count; ++k) {
        have = HasMaterial(grid, grid->changes.gone.data[k]);
    }
    for (int32_t k = 0; have && k < grid->changes.material.count; ++k) {
        have = HasMaterial(grid, grid->changes.material.data[k].cell);
    }
    return have;
}

static const kiriMust StretchMust[] = { KIRI_REALS(kiriStretch, width, moment) };

static bool AreStretchesFinite(kiriCheck* check, const kiriGrid* grid)
{
    bool areFinite = true;
    for (int32_t f = 0; areFinite && f < grid->faces.count; ++f) {
        int32_t own = StretchIndexOfFace(grid, f);
        if (own != KIRI_NONE) {
            areFinite = kiriCheck_Object(check, StretchMust, &grid->stretches.data[own]);
        }
    }
    return areFinite;
}

bool kiriGrid_CheckOwn(const kiriGrid* grid, kiriCheck* check)
{
    return kiriCheck_That(check, AreOwnedOnce(check, grid, grid->cells.count, MaterialIndexOf, &grid->unusedMaterials,
                                              grid->materials.count)) &&
           kiriCheck_That(check, AreOwnedOnce(check, grid, grid->faces.count, StretchIndexOfFace,
                                              &grid->unusedStretches, grid->stretches.count)) &&
           kiriCheck_That(check, HaveGoneMaterial(grid) && AreStretchesFinite(check, grid));
}
