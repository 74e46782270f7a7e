#include "kiri_seen.h"

#include "kiri_piece.h"

#include <string.h>

bool kiriView_ReserveFades(kiriSheetData* sheet, int32_t pointCount, double fadeTime)
{
    bool fade = fadeTime > 0.0;
    return kiriArray_Reserve(sheet->memory, &sheet->seen.pointsBefore, pointCount) &&
           kiriFades_Reserve(&sheet->seen.fades, sheet->memory, fade ? sheet->mesh.vertices.count : 0) &&
           kiriFades_Reserve(&sheet->seen.pointFades, sheet->memory, fade ? pointCount : 0);
}

enum { BLOCK = 64 }; /* vertices */

static bool ResizeBlocks(kiriSheetData* sheet)
{
    int32_t old = sheet->seen.touched.count, blocks = sheet->mesh.vertices.count / BLOCK + 1;
    if (!kiriArray_Resize(sheet->memory, &sheet->seen.touched, blocks) ||
        !kiriArray_Resize(sheet->memory, &sheet->seen.movers, blocks)) {
        return false;
    }
    for (int32_t block = old; block < sheet->seen.touched.count; ++block) {
        sheet->seen.touched.data[block] = 0;
    }
    return true;
}

/* ---- What sleeps ---- */

static int32_t FindMover(const kiriSheetData* sheet, int32_t block)
{
    int32_t end = (block + 1) * BLOCK, count = sheet->seen.surface.vertexCount;
    for (int32_t v = block * BLOCK; v < end && v < count; ++v) {
        kiriSpan span = sheet->vertexSkin.spans.data[v]; /* of a hole it is empty */
        int32_t frame = span.count > 0 ? sheet->vertexSkin.weights.data[span.first].frame : KIRI_NONE;
        if (frame != KIRI_NONE && kiriSheet_Moves(sheet, frame)) {
            return frame;
        }
    }
    return KIRI_NONE;
}

/* When other pieces are awake: a block has its mover until that falls asleep, and one that has none gets one where a piece
   woke. */
static void FindMovers(kiriSheetData* sheet, bool isNew)
{
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    int32_t* movers = sheet->seen.movers.data;
    bool hasWoken = isNew || awake->wakes != sheet->seen.wakes;
    for (int32_t block = 0; block < sheet->seen.movers.count; ++block) {
        bool isKnown = !isNew && (movers[block] == KIRI_NONE ? !hasWoken : kiriSheet_Moves(sheet, movers[block]));
        movers[block] = isKnown ? movers[block] : FindMover(sheet, block);
    }
    sheet->seen.lists = awake->lists;
    sheet->seen.wakes = awake->wakes;
}

/* Null where anything may be elsewhere than it was seen last. */
static const kiriAwake* AwakeOf(kiriSheetData* sheet)
{
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    bool hasLinks = sheet->settings.mechanics.model != KIRI_MODEL_POINTS;
    bool isOther = sheet->seen.isElsewhere || !sheet->seen.surface.isSteady;
    return awake->isListed && !isOther && (hasLinks || sheet->settings.skinning == KIRI_SKINNING_LINEAR) ? awake : NULL;
}

/* The end of the blocks from `begin` on that have a mover, or have none, like that at `begin`. */
static int32_t EndOfMovers(const kiriSheetData* sheet, int32_t begin, int32_t end, bool* moves)
{
    const int32_t* movers = sheet->seen.movers.data;
    int32_t block = begin / BLOCK, last = (end - 1) / BLOCK;
    *moves = movers[block] != KIRI_NONE;
    while (block < last && (movers[block + 1] != KIRI_NONE) == *moves) {
        ++block;
    }
    return block < last ? (block + 1) * BLOCK : end;
}

typedef void WriteVerticesFn(kiriSheetData* sheet, int32_t begin, int32_t end);

/* For all vertices, or those of the blocks that move. */
static void ForMoving(kiriSheetData* sheet, int32_t begin, int32_t end, WriteVerticesFn* write)
{
    if (!sheet->seen.surface.isPartly) {
        write(sheet, begin, end);
        return;
    }
    for (int32_t next; begin < end; begin = next) {
        bool moves;
        next = EndOfMovers(sheet, begin, end, &moves);
        if (moves) {
            write(sheet, begin, next);
        }
    }
}

bool kiriView_Resize(kiriSheetData* sheet, int32_t frameCount, int32_t pointCount)
{
    return kiriSurface_Resize(&sheet->seen.surface, &sheet->shown, &sheet->mesh, frameCount) &&
           kiriArray_Resize(&sheet->shown, &sheet->seen.pointPositions, 3 * (int64_t)pointCount) &&
           kiriArray_Resize(sheet->memory, &sheet->seen.exactPoints, pointCount) && ResizeBlocks(sheet) &&
           (!sheet->update->isBegun || kiriView_ReserveFades(sheet, pointCount, sheet->seen.fades.time));
}

/* A newborn vertex lies on the triangle that was seen. */
static void PlaceNewborn(kiriSheetData* sheet, int32_t vertex)
{
    const kiriBirth* birth = &sheet->mesh.births.data[vertex - sheet->mesh.oldVertexCount];
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        at = kiriVec3_AddScaled(at, birth->share[k], kiriSurface_At(&sheet->seen.surface, birth->parent[k]));
    }
    kiriSurface_Place(&sheet->seen.surface, vertex, at);
}

static void HideTriangles(kiriSheetData* sheet)
{
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        int32_t piece = kiriMesh_IsTriangle(&sheet->mesh, t) ? kiriPiece_OfTriangle(sheet, t) : KIRI_NONE;
        if (piece != KIRI_NONE && sheet->layout.pieces.data[piece].isGone) {
            kiriSurface_HideTriangle(&sheet->seen.surface, t);
        }
    }
}

void kiriView_HideGone(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriSurface_NeedNormals(surface); /* what is gone has them until the next tick */
    HideTriangles(sheet);
    surface->isWritten = surface->isSteady = false;
    sheet->mesh.revision += 1;
    surface->revision = sheet->mesh.revision;
    surface->changeCount = 0;
    surface->pose += 1;
}

void kiriView_WriteTopology(kiriSheetData* sheet)
{
    for (int32_t v = sheet->mesh.oldVertexCount; v < sheet->mesh.oldVertexCount + sheet->mesh.births.count; ++v) {
        PlaceNewborn(sheet, v);
    }
    kiriSurface_WriteTopology(&sheet->seen.surface, &sheet->mesh);
    if (kiriPieces_AnyGone(sheet)) {
        HideTriangles(sheet); /* a cut goes on in what is gone */
    }
    sheet->seen.isElsewhere = true;
}

void kiriView_TakeFrames(kiriSheetData* sheet)
{
    const kiriAwake* awake = AwakeOf(sheet);
    sheet->seen.hasNewBlocks = sheet->seen.hasNewBlocks || !sheet->seen.surface.isSteady;
    kiriSurface_TakeFrames(&sheet->seen.surface, sheet->frames.data, sheet->frames.count, sheet->links.links.data,
                           sheet->links.links.count, awake);
    if (sheet->seen.surface.isPartly && awake->lists != sheet->seen.lists) {
        FindMovers(sheet, sheet->seen.hasNewBlocks);
        sheet->seen.hasNewBlocks = false;
    }
    sheet->seen.surface.isWritten &= sheet->seen.fades.fading.count == 0;
}

/* Linear whatever is seen: here contacts push (see kiri_motion.c). */
static void BlendPoints(kiriSheetData* sheet, bool isPartly)
{
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        if (isPartly && !kiriSheet_Moves(sheet, sheet->points.data[i].frame)) {
            continue;
        }
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->points.data[i].at);
        sheet->seen.exactPoints.data[i] = kiriSkin_Position(&sheet->pointSkin, i, sheet->frames.data, local);
    }
}

static void AddPointFades(kiriSheetData* sheet)
{
    for (int32_t k = 0; k < sheet->seen.pointFades.fading.count; ++k) {
        kiriFading fading = sheet->seen.pointFades.fading.data[k];
        kiriVec3* at = &sheet->seen.exactPoints.data[fading.sample];
        *at = kiriVec3_Add(*at, fading.offset);
    }
}

void kiriView_TouchStaged(kiriSheetData* sheet)
{
    for (int32_t k = 0; k < sheet->vertexSkin.staged.count; ++k) {
        sheet->seen.touched.data[sheet->vertexSkin.staged.data[k].sample / BLOCK] = 1;
    }
}

static void TouchFading(kiriSheetData* sheet)
{
    for (int32_t k = 0; k < sheet->seen.fades.fading.count; ++k) {
        sheet->seen.touched.data[sheet->seen.fades.fading.data[k].sample / BLOCK] = 1;
    }
}

static bool MayBeElsewhere(const kiriSheetData* sheet, int32_t begin, int32_t end)
{
    return sheet->seen.touched.data[begin / BLOCK] || end > sheet->seen.vertexCount ||
           kiriPatches_MayMove(&sheet->seen.surface.patches, &sheet->vertexSkin, begin, end);
}

/* The vertices of a block, `before` being where all are seen, go where their weights have them. */
static void LookAtVertices(kiriSheetData* sheet, int32_t begin, int32_t end, const float* before, kiriVec3 shift)
{
    float room[3 * BLOCK], *was = room;
    memcpy(was, before + 3 * (ptrdiff_t)begin, 3 * sizeof(float) * (size_t)(end - begin));
    kiriSurface_BlendRange(&sheet->seen.surface, &sheet->vertexSkin, begin, end);
    const float* is = kiriSurface_Places(&sheet->seen.surface) + 3 * (ptrdiff_t)begin;
    for (int32_t v = begin; v < end; ++v, was += 3, is += 3) {
        kiriVec3 offset = kiriVec3_Sub(kiriVec3_Load(was), kiriVec3_Load(is));
        if (kiriMesh_IsVertex(&sheet->mesh, v)) {
            kiriFades_Take(&sheet->seen.fades, v, kiriVec3_Add(offset, shift));
        }
    }
}

/* All other vertices are seen where they were written last, by the same weights and patches: they do not jump. */
static void TakeVertexJumps(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriVec3 middle = surface->middle;
    const float* before = kiriSurface_Places(surface);
    TouchFading(sheet);
    kiriView_TakeFrames(sheet);
    surface->isWritten = false;
    kiriVec3 shift = kiriVec3_Sub(middle, surface->middle);
    kiriFades_Start(&sheet->seen.fades);
    for (int32_t begin = 0; begin < surface->vertexCount; begin += BLOCK) {
        int32_t end = begin + BLOCK < surface->vertexCount ? begin + BLOCK : surface->vertexCount;
        if (MayBeElsewhere(sheet, begin, end)) {
            LookAtVertices(sheet, begin, end, before, shift);
        }
    }
}

/* Points that are new have not been seen elsewhere. */
static void TakePointJumps(kiriSheetData* sheet)
{
    const kiriVec3 *was = sheet->seen.pointsBefore.data, *is = sheet->seen.exactPoints.data;
    if (sheet->seen.pointCount > 0) {
        memcpy(sheet->seen.pointsBefore.data, is, sizeof(kiriVec3) * (size_t)sheet->seen.pointCount);
    }
    BlendPoints(sheet, false);
    kiriFades_Start(&sheet->seen.pointFades);
    for (int32_t i = 0; i < sheet->seen.pointCount; ++i) {
        kiriFades_Take(&sheet->seen.pointFades, i, kiriVec3_Sub(was[i], is[i]));
    }
    sheet->seen.pointCount = sheet->points.count;
}

void kiriView_TakeJump(kiriSheetData* sheet)
{
    if (sheet->seen.isElsewhere) {
        TakeVertexJumps(sheet);
        TakePointJumps(sheet);
        AddPointFades(sheet);
    }
}

/* Gives memory back where nothing fades. */
static void TrimFades(kiriSheetData* sheet)
{
    kiriFades_Trim(&sheet->seen.fades, sheet->memory);
    kiriFades_Trim(&sheet->seen.pointFades, sheet->memory);
    if (sheet->seen.pointFades.fading.count == 0 && sheet->seen.pointsBefore.capacity > 0) {
        kiriArray_Release(sheet->memory, &sheet->seen.pointsBefore);
    }
}

void kiriView_Fade(kiriSheetData* sheet, double dt)
{
    kiriFades_Advance(&sheet->seen.fades, dt);
    kiriFades_Advance(&sheet->seen.pointFades, dt);
}

void kiriView_Trim(kiriSheetData* sheet)
{
    if (!sheet->update->isBegun) {
        TrimFades(sheet);
    }
}

static void BlendVertices(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    kiriSurface_BlendRange(&sheet->seen.surface, &sheet->vertexSkin, begin, end);
}

static void WriteVertices(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    kiriSurface_WriteRange(&sheet->seen.surface, begin, end);
}

void kiriView_BlendRange(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    if (!sheet->seen.surface.isWritten) {
        ForMoving(sheet, begin, end, BlendVertices);
    }
}

void kiriView_Sum(kiriSheetData* sheet)
{
    if (!sheet->seen.surface.isWritten) {
        kiriSurface_AddFades(&sheet->seen.surface, &sheet->seen.fades);
        kiriSurface_SumNormals(&sheet->seen.surface);
    }
    BlendPoints(sheet, sheet->seen.surface.isPartly);
    AddPointFades(sheet);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriVec3_Store(&sheet->seen.pointPositions.data[3 * i], sheet->seen.exactPoints.data[i]);
    }
    sheet->seen.pointCount = sheet->points.count;
    sheet->seen.vertexCount = sheet->seen.surface.vertexCount;
    if (sheet->seen.isElsewhere) {
        memset(sheet->seen.touched.data, 0, (size_t)sheet->seen.touched.count);
    }
    sheet->seen.isElsewhere = false;
}

void kiriView_WriteRange(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    if (!sheet->seen.surface.isWritten) {
        ForMoving(sheet, begin, end, WriteVertices);
    }
}

void kiriView_EndWriting(kiriSheetData* sheet)
{
    sheet->seen.surface.isWritten = sheet->seen.fades.fading.count == 0;
    sheet->seen.surface.isSteady = true;
}

void kiriView_KeepBounds(kiriSheetData* sheet)
{
    bool isKnown = sheet->seen.surface.isPartly;
    const kiriMovers movers = { isKnown ? sheet->seen.movers.data : NULL, BLOCK, sheet->seen.lists };
    kiriBounds_Keep(sheet->seen.bounds, &sheet->seen.surface, &movers);
}

void kiriView_WritePositions(kiriSheetData* sheet)
{
    int32_t count = sheet->seen.surface.vertexCount;
    kiriView_TakeFrames(sheet);
    kiriView_BlendRange(sheet, 0, count);
    kiriView_Sum(sheet);
    kiriView_WriteRange(sheet, 0, count);
    kiriView_EndWriting(sheet);
}
