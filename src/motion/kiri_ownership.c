#include "kiri_ownership.h"

#include <string.h>

/* ---- Owners in force ----

   A triangle is convex, so what it has in a square lies in one cell; and cells only ever fall apart, so what the parts
   of the triangle have there later has lain in that cell. */

static bool NoteSquare(kiriOwnership* ownership, kiriMemory* memory, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < ownership->isDirty.count);
    if (!ownership->isDirty.data[square] && !kiriArray_Push(memory, &ownership->dirty, square)) {
        return false;
    }
    ownership->isDirty.data[square] = 1;
    return true;
}

static bool ReserveOwners(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh)
{
    int32_t count = mesh->squares.columns * mesh->squares.rows;
    const kiriSquareOwners none = { KIRI_NONE, { 0, 0 } };
    if (!kiriArray_ReserveJust(memory, &ownership->squares, count) ||
        !kiriArray_ReserveJust(memory, &ownership->isDirty, count)) {
        return false;
    }
    while (ownership->squares.count < count) {
        ownership->squares.data[ownership->squares.count++] = none;
        ownership->isDirty.data[ownership->isDirty.count++] = 0;
    }
    return true;
}

bool kiriOwnership_NoteDirty(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh)
{
    bool ok = ReserveOwners(ownership, memory, mesh);
    for (int32_t k = 0; ok && k < mesh->squares.dirty.count; ++k) {
        ok = NoteSquare(ownership, memory, mesh->squares.dirty.data[k]);
    }
    return ok;
}

bool kiriOwnership_NoteChanges(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                               const kiriMeshData* mesh, const kiriRegions* regions)
{
    bool ok = ReserveOwners(ownership, memory, mesh);
    for (int32_t k = 0; ok && k < regions->changes.count; ++k) {
        int32_t cell = regions->changes.data[k].cell;
        ok = !kiriGrid_IsCell(grid, cell) || NoteSquare(ownership, memory, grid->cells.data[cell].square);
    }
    return ok;
}

/* A part that rounding brought into a square where its triangle was not goes to the lowest owner there. */
static int32_t OwnerBefore(const kiriOwnership* ownership, const kiriMeshData* mesh, int32_t square, int32_t triangle)
{
    const kiriSquareOwners* owners = &ownership->squares.data[square];
    if (owners->parts.count == 0) {
        return owners->owner;
    }
    while (triangle >= ownership->triangleCount) {
        triangle = mesh->triangles.data[triangle].parent;
    }
    const kiriTriangleOwner* owned = &ownership->triangleOwners.data[owners->parts.first];
    int32_t lowest = owned[0].owner;
    for (int32_t k = 0; k < owners->parts.count; ++k) {
        if (owned[k].triangle == triangle) {
            return owned[k].owner;
        }
        lowest = kiriMin(owned[k].owner, lowest);
    }
    return lowest;
}

/* ---- Staging ---- */

/* The transfer between two frames, an empty one where there was none. */
static kiriTransfer* FindTransfer(kiriOwnership* ownership, kiriMemory* memory, int32_t to, int32_t from)
{
    KIRI_ASSERT(to >= 0 && to < ownership->first.count && from >= 0 && from < ownership->first.count);
    int32_t before = KIRI_NONE, at = ownership->first.data[to];
    while (at != KIRI_NONE && ownership->transfers.data[at].from < from) {
        before = at;
        at = ownership->transfers.data[at].next;
    }
    if (at != KIRI_NONE && ownership->transfers.data[at].from == from) {
        return &ownership->transfers.data[at];
    }
    kiriTransfer transfer = { from, at, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } } };
    if (!kiriArray_Push(memory, &ownership->transfers, transfer)) {
        return NULL;
    }
    int32_t index = ownership->transfers.count - 1;
    *(before == KIRI_NONE ? &ownership->first.data[to] : &ownership->transfers.data[before].next) = index;
    return &ownership->transfers.data[index];
}

static bool StageTransfers(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                           const kiriRegions* regions, int32_t square)
{
    double extent = kiriOwnership_Extent(mesh);
    for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
        int32_t to = regions->field.owner.data[c];
        int32_t from = OwnerBefore(ownership, mesh, square, grid->cells.data[c].triangle);
        if (from != KIRI_NONE && from != to) {
            kiriTransfer* transfer = FindTransfer(ownership, memory, to, from);
            if (transfer == NULL) {
                return false;
            }
            kiriMoments material = kiriGrid_Material(grid, mesh, c);
            kiriTally_Add(&transfer->material, &material, 1, extent);
        }
    }
    return true;
}

/* A square without material has no cells to own. */
static bool StageOwners(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, int32_t square)
{
    int32_t cell = grid->squareCell.data[square];
    if (cell == KIRI_NONE) {
        return true;
    }
    kiriStagedOwners staged = { square, { regions->field.owner.data[cell], { 0, 0 } } };
    bool isDivided = grid->cells.data[cell].next != KIRI_NONE;
    int32_t count = isDivided ? kiriSquares_CountNodes(&mesh->squares, square) : 0;
    if (!kiriArray_Reserve(memory, &ownership->staged, (int64_t)ownership->staged.count + 1) ||
        !kiriSpan_Resize(&staged.owners.parts, &ownership->spans, memory, &ownership->triangleOwners,
                         sizeof(kiriTriangleOwner), count)) {
        return false;
    }
    int32_t n = mesh->squares.head[square];
    for (int32_t k = 0; k < count; ++k, n = mesh->squares.nodes.data[n].next) {
        kiriTriangleOwner owned = { mesh->squares.nodes.data[n].triangle,
                                    regions->field.owner.data[grid->nodeCell.data[n]] };
        ownership->triangleOwners.data[staged.owners.parts.first + k] = owned;
    }
    ownership->staged.data[ownership->staged.count++] = staged;
    return true;
}

static void FreeParts(kiriOwnership* ownership, kiriSpan* parts)
{
    /* To give back never fails. */
    kiriSpan_Resize(parts, &ownership->spans, NULL, &ownership->triangleOwners, sizeof(kiriTriangleOwner), 0);
}

static void DropStagedOwners(kiriOwnership* ownership)
{
    for (int32_t k = 0; k < ownership->staged.count; ++k) {
        FreeParts(ownership, &ownership->staged.data[k].owners.parts);
    }
    ownership->staged.count = ownership->transfers.count = ownership->next = 0;
    ownership->due = 0;
}

static bool ClearTransfers(kiriOwnership* ownership, kiriMemory* memory, int32_t frameCount)
{
    DropStagedOwners(ownership);
    if (!kiriArray_Resize(memory, &ownership->first, frameCount)) {
        return false;
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        ownership->first.data[f] = KIRI_NONE;
    }
    return true;
}

static bool StartStaging(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh, int32_t frameCount,
                         bool isScratch)
{
    bool ok = ReserveOwners(ownership, memory, mesh) && ClearTransfers(ownership, memory, frameCount);
    for (int32_t s = 0; ok && isScratch && s < ownership->isDirty.count; ++s) {
        ok = NoteSquare(ownership, memory, s);
    }
    return ok;
}

/* Of the k-th dirty square. One that is not divided has one owner, which takes little. */
static int64_t ItemsOfSquare(const kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int32_t k)
{
    enum { WHOLE_AN_ITEM = 8, NODES_AN_ITEM = 8 };
    int32_t cell = grid->squareCell.data[square];
    bool isDivided = cell != KIRI_NONE && grid->cells.data[cell].next != KIRI_NONE;
    return isDivided ? 1 + kiriSquares_CountNodes(&mesh->squares, square) / NODES_AN_ITEM : k % WHOLE_AN_ITEM == 0;
}

kiriProgress kiriOwnership_Stage(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                                 const kiriMeshData* mesh, const kiriRegions* regions, bool isScratch, kiriQuota* quota)
{
    if (ownership->next == 0 && !StartStaging(ownership, memory, mesh, regions->material.count, isScratch)) {
        return KIRI_FAILED;
    }
    while (kiriQuota_Pay(quota, &ownership->due)) {
        if (ownership->next == ownership->dirty.count) {
            return KIRI_DONE;
        }
        int32_t square = ownership->dirty.data[ownership->next++];
        if (!StageTransfers(ownership, memory, grid, mesh, regions, square) ||
            !StageOwners(ownership, memory, grid, mesh, regions, square)) {
            return KIRI_FAILED;
        }
        ownership->due = ItemsOfSquare(grid, mesh, square, ownership->next);
    }
    return KIRI_MORE;
}

static void ClearDirtySquares(kiriOwnership* ownership)
{
    for (int32_t k = 0; k < ownership->dirty.count; ++k) {
        ownership->isDirty.data[ownership->dirty.data[k]] = 0;
    }
    ownership->dirty.count = 0;
}

void kiriOwnership_Drop(kiriOwnership* ownership)
{
    DropStagedOwners(ownership);
    ClearDirtySquares(ownership);
}

void kiriOwnership_Commit(kiriOwnership* ownership, const kiriMeshData* mesh)
{
    for (int32_t k = 0; k < ownership->staged.count; ++k) {
        kiriSquareOwners* owners = &ownership->squares.data[ownership->staged.data[k].square];
        FreeParts(ownership, &owners->parts);
        *owners = ownership->staged.data[k].owners;
    }
    ownership->staged.count = ownership->transfers.count = ownership->next = 0;
    ownership->triangleCount = mesh->triangles.count;
    ClearDirtySquares(ownership);
}

/* ---- What is left ---- */

/* Triangles of what is gone leave the parts of the square. */
static void DropParts(kiriOwnership* ownership, const kiriKeep* triangles, kiriSpan* parts)
{
    kiriTriangleOwner* owned = ownership->triangleOwners.data + parts->first;
    int32_t kept = 0;
    for (int32_t k = 0; k < parts->count; ++k) {
        if (kiriKeep_Has(triangles, owned[k].triangle)) {
            owned[kept++] = owned[k];
        }
    }
    /* To shrink never fails. */
    kiriSpan_Resize(parts, &ownership->spans, NULL, &ownership->triangleOwners, sizeof(kiriTriangleOwner), kept);
}

static void RenumberOwners(kiriOwnership* ownership, const kiriKeep* triangles, const kiriKeep* frames)
{
    for (int32_t s = 0; s < ownership->squares.count; ++s) {
        kiriSquareOwners* owners = &ownership->squares.data[s];
        if (owners->owner >= frames->first) {
            owners->owner = frames->to.data[owners->owner];
        }
        for (int32_t k = owners->parts.first; k < owners->parts.first + owners->parts.count; ++k) {
            kiriTriangleOwner* owned = &ownership->triangleOwners.data[k];
            owned->triangle = kiriKeep_To(triangles, owned->triangle);
            owned->owner = kiriKeep_To(frames, owned->owner);
        }
    }
}

void kiriOwnership_Keep(kiriOwnership* ownership, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, const kiriKeep* triangles, const kiriKeep* frames,
                        const int32_t* of, int32_t count)
{
    KIRI_ASSERT(ownership->dirty.count == 0 && ownership->staged.count == 0);
    for (int32_t k = 0; k < count; ++k) {
        kiriSquareOwners* owners = &ownership->squares.data[of[k]];
        int32_t cell = grid->squareCell.data[of[k]];
        bool isDivided = cell != KIRI_NONE && grid->cells.data[cell].next != KIRI_NONE;
        isDivided ? DropParts(ownership, triangles, &owners->parts) : FreeParts(ownership, &owners->parts);
    }
    if (kiriKeep_Moves(triangles) || kiriKeep_Moves(frames)) {
        RenumberOwners(ownership, triangles, frames);
    }
    for (int32_t k = 0; k < count; ++k) {
        int32_t cell = grid->squareCell.data[of[k]];
        ownership->squares.data[of[k]].owner = cell == KIRI_NONE ? KIRI_NONE : regions->field.owner.data[cell];
    }
    ownership->triangleCount = mesh->triangles.count;
}
