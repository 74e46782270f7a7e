#include "kiri_weld.h"

/* Those that stay are listed by the cells of a grid, which are as wide as the distance: so each cell has a few at most,
   and all that are near a vertex are in its cell and the eight around it. Open addressing, in the order of vertices: the
   same on every machine. */
typedef struct WeldGrid {
    const kiriLatticePoint* at;
    int64_t side;       /* lattice steps of a cell */
    double nearSquared; /* lattice steps, squared */
    int64_t mask;       /* slots less 1 */
    int32_t* slots;     /* the last vertex of a cell that stays, or KIRI_NONE */
    int32_t* previous;  /* of each vertex that stays: the one before in its cell, or KIRI_NONE */
} WeldGrid;

static int64_t SlotOf(const WeldGrid* grid, int64_t column, int64_t row)
{
    uint64_t hash = ((uint64_t)column << 32 ^ (uint64_t)row) * 0x9E3779B97F4A7C15u;
    int64_t i = (int64_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32) & grid->mask;
    for (int32_t v = grid->slots[i]; v != KIRI_NONE; v = grid->slots[i]) {
        if (grid->at[v].x / grid->side == column && grid->at[v].y / grid->side == row) {
            break;
        }
        i = (i + 1) & grid->mask;
    }
    return i;
}

/* The nearest that stays, or KIRI_NONE. */
static int32_t FindNearKept(const WeldGrid* grid, int32_t vertex)
{
    kiriLatticePoint at = grid->at[vertex];
    int32_t found = KIRI_NONE;
    int64_t nearest = 0;
    for (int k = 0; k < 9; ++k) {
        int64_t slot = SlotOf(grid, at.x / grid->side + k % 3 - 1, at.y / grid->side + k / 3 - 1);
        for (int32_t v = grid->slots[slot]; v != KIRI_NONE; v = grid->previous[v]) {
            int64_t distance = kiriDistanceSquared(grid->at[v], at);
            bool isNearer = found == KIRI_NONE || distance < nearest || (distance == nearest && v < found);
            if ((double)distance < grid->nearSquared && isNearer) {
                found = v;
                nearest = distance;
            }
        }
    }
    return found;
}

static bool MakeGrid(WeldGrid* grid, const kiriLatticePoint* at, int32_t count, double distance, kiriMemory* memory)
{
    const double widest = 1 << 30;
    int64_t size = 16;
    while (size < 2 * (int64_t)count) {
        size *= 2;
    }
    grid->at = at;
    grid->side = distance < 2.0 ? 2 : distance < widest ? (int64_t)distance + 1 : (int64_t)widest;
    grid->nearSquared = distance * distance;
    grid->mask = size - 1;
    grid->slots = kiriMemory_Alloc(memory, size * (int64_t)sizeof(int32_t));
    grid->previous = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    for (int64_t i = 0; grid->slots != NULL && i < size; ++i) {
        grid->slots[i] = KIRI_NONE;
    }
    return grid->slots != NULL && grid->previous != NULL;
}

bool kiriWeld_Find(const kiriLatticePoint* at, int32_t count, double distance, int32_t* to, kiriMemory* memory)
{
    WeldGrid grid = { NULL, 0, 0.0, 0, NULL, NULL };
    bool ok = MakeGrid(&grid, at, count, distance, memory);
    for (int32_t v = 0; ok && v < count; ++v) {
        int32_t near = to[v] != KIRI_NONE ? FindNearKept(&grid, v) : KIRI_NONE;
        if (to[v] != KIRI_NONE && near == KIRI_NONE) {
            int64_t slot = SlotOf(&grid, at[v].x / grid.side, at[v].y / grid.side);
            grid.previous[v] = grid.slots[slot];
            grid.slots[slot] = v;
            near = v;
        }
        to[v] = near;
    }
    kiriMemory_Free(memory, grid.slots);
    kiriMemory_Free(memory, grid.previous);
    return ok;
}
