#include "kiri_remake.h"

#include "../core/kiri_union_find.h"
#include "kiri_piece.h"
#include "kiri_pipeline.h"
#include "kiri_stages.h"

#include <string.h>

/* Did the stages end where sites are found again, though all that this takes memory for is there? Then two sites are in
   one cell. */
static bool IsCrowded(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    return u->stage == KIRI_STAGE_REGIONS && u->step == 0 && u->placing.flags.count >= sheet->grid.cells.count &&
           u->placing.moves.capacity >= sheet->frames.count;
}

/* The stages from the grid to the links, from scratch, as for a sheet that is made; no frame is added but where a piece
   has none. */
static bool RunStages(kiriSheetData* sheet, bool* isBad)
{
    kiriUpdate* u = sheet->update;
    int32_t maxFrames = sheet->settings.maxFrames, stage = u->stage, step = u->step;
    int64_t spent = u->spent;
    kiriCommitCounts counts = u->counts;
    sheet->settings.maxFrames = 0;
    u->stage = KIRI_STAGE_GRID;
    u->step = 0;
    u->needsRebuild = false;
    u->isScratch = true;
    bool ok = kiriPipeline_Make(sheet, KIRI_STAGE_SAMPLES);
    *isBad = (!ok && IsCrowded(sheet)) || u->placing.sites.count != sheet->frames.count;
    u->isScratch = false;
    u->stage = stage;
    u->step = step;
    u->spent = spent;
    u->counts = counts;
    sheet->settings.maxFrames = maxFrames;
    return ok;
}

/* A link, and a corner, are numbers without gaps. */
static bool AreLinksThose(const kiriLinks* links)
{
    int32_t count = links->links.count, corners = links->corners.count;
    return links->next.count == count && links->nextCorners.count == corners &&
           (count == 0 || memcmp(links->next.data, links->links.data, sizeof(kiriLink) * (size_t)count) == 0) &&
           (corners == 0 ||
            memcmp(links->nextCorners.data, links->corners.data, sizeof(kiriCorner) * (size_t)corners) == 0);
}

/* In force are the links that there were. Where they are not those of the mesh, all of them are made again with the
   next cut. */
static void TakeLinks(kiriSheetData* sheet, int32_t changed)
{
    if (AreLinksThose(&sheet->links)) {
        kiriLinks_Commit(&sheet->links);
    } else {
        kiriLinks_Drop(&sheet->links);
        memset(sheet->regions.dirty.data, 1, (size_t)sheet->regions.dirty.count);
    }
    sheet->links.changed = changed;
}

/* As a commit does. */
static void TakeCells(kiriSheetData* sheet)
{
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        sheet->frames.data[f].site = sheet->update->placing.sites.data[f];
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriSample* point = &sheet->points.data[i];
        point->cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, point->at);
    }
}

/* Nothing has changed: the changes are those from nothing. */
static void ClearChanges(kiriSheetData* sheet, const uint8_t* dirty)
{
    memcpy(sheet->regions.dirty.data, dirty, (size_t)sheet->frames.count);
    kiriShape_ClearChanges(&sheet->shape);
    kiriRefresh_Drop(&sheet->update->samples.refresh);
    kiriRefit_Drop(&sheet->update->refit);
}

/* ---- Pieces ---- */

/* Are the frames of each piece in one part of the grid, and those of no other one? `pieceOf`: of the roots of parts. */
static bool AreFramesInParts(const kiriSheetData* sheet, int32_t* parent, int32_t* pieceOf)
{
    bool areIn = true;
    int32_t parts = 0;
    for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
        pieceOf[c] = KIRI_NONE;
    }
    for (int32_t f = 0; areIn && f < sheet->frames.count; ++f) {
        int32_t piece = sheet->layout.framePiece.data[f];
        int32_t* of = &pieceOf[kiriUnion_Root(parent, sheet->frames.data[f].site.cell)];
        parts += *of == KIRI_NONE;
        areIn = *of == KIRI_NONE || *of == piece;
        *of = piece;
    }
    return areIn && parts == sheet->layout.pieces.count;
}

/* And do the triangles there follow these frames? Their corners are of one piece. */
static bool AreTrianglesInParts(const kiriSheetData* sheet, int32_t* parent, const int32_t* pieceOf)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    bool areIn = true;
    for (int32_t s = 0; areIn && s < squares->columns * squares->rows; ++s) {
        for (int32_t n = squares->head[s]; areIn && n != KIRI_NONE; n = squares->nodes.data[n].next) {
            int32_t root = kiriUnion_Root(parent, sheet->grid.nodeCell.data[n]);
            areIn = pieceOf[root] == kiriPiece_OfTriangle(sheet, squares->nodes.data[n].triangle);
        }
    }
    return areIn;
}

/* Is the material of the pieces where the grid has it? False for memory, too. */
static bool ArePiecesThose(kiriSheetData* sheet, bool* isBad)
{
    int64_t count = sheet->grid.cells.count;
    int32_t* parent = kiriMemory_Alloc(sheet->memory, 2 * count * (int64_t)sizeof(int32_t));
    if (parent == NULL) {
        return false;
    }
    kiriGrid_JoinCells(&sheet->grid, parent);
    *isBad = !AreFramesInParts(sheet, parent, parent + count) || !AreTrianglesInParts(sheet, parent, parent + count);
    kiriMemory_Free(sheet->memory, parent);
    return !*isBad;
}

/* ---- All of it ---- */

/* Has the work on a cut changed the mesh, or what follows from it? */
static bool IsAmidWork(const kiriUpdate* u)
{
    return u->stage > KIRI_STAGE_CUT || (u->stage == KIRI_STAGE_CUT && u->cut.meshChanged);
}

bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad)
{
    kiriUpdate* u = sheet->update;
    int32_t changed = sheet->links.changed, frames = sheet->frames.count;
    *isBad = false;
    if (IsAmidWork(u)) {
        /* What was staged is in no list. */
        return kiriSkin_Sort(&sheet->vertexSkin, sheet->memory) && kiriSkin_Sort(&sheet->pointSkin, sheet->memory) &&
               kiriOwnership_Sort(&u->refit.ownership, sheet->memory);
    }
    uint8_t* dirty = kiriMemory_Alloc(sheet->memory, frames);
    if (dirty == NULL) {
        return false;
    }
    memcpy(dirty, sheet->regions.dirty.data, (size_t)frames);
    bool ok = RunStages(sheet, isBad) && !*isBad;
    if (ok) {
        ClearChanges(sheet, dirty);
        TakeLinks(sheet, changed);
        TakeCells(sheet);
        ok = ArePiecesThose(sheet, isBad);
    }
    kiriMemory_Free(sheet->memory, dirty);
    return ok;
}
