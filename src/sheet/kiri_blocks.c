#include "kiri_blocks.h"

#include <string.h>

bool kiriBlocks_Resize(kiriBlocks* blocks, kiriMemory* memory, int32_t vertexCount, int32_t frameCount)
{
    int32_t old = blocks->movers.count, count = vertexCount / KIRI_BLOCK + 1, oldFrames = blocks->moved.count;
    if (!kiriArray_Reserve(memory, &blocks->touched, count) || !kiriArray_Reserve(memory, &blocks->stale, count) ||
        !kiriArray_Reserve(memory, &blocks->frames, count) || !kiriArray_Reserve(memory, &blocks->movers, count) ||
        !kiriArray_Reserve(memory, &blocks->moved, frameCount)) {
        return false;
    }
    blocks->touched.count = blocks->stale.count = blocks->frames.count = blocks->movers.count = count;
    blocks->moved.count = frameCount;
    for (int32_t block = old; block < count; ++block) {
        blocks->touched.data[block] = blocks->stale.data[block] = 0;
        kiriBlocks_ForgetOne(blocks, block);
    }
    for (int32_t i = oldFrames; i < frameCount; ++i) {
        blocks->moved.data[i] = 0;
    }
    return true;
}

void kiriBlocks_ForgetOne(kiriBlocks* blocks, int32_t block)
{
    blocks->movers.data[block] = KIRI_UNKNOWN;
    blocks->hasUnknown = true;
}

void kiriBlocks_Forget(kiriBlocks* blocks)
{
    for (int32_t block = 0; block < blocks->movers.count; ++block) {
        kiriBlocks_ForgetOne(blocks, block);
    }
    for (int32_t i = 0; i < blocks->moved.count; ++i) {
        blocks->moved.data[i] = 0;
    }
}

/* ---- Frames of a block ---- */

/* Frames share bits: a block may seem to have one that it has not. */
static void AddToMask(kiriFrameMask* mask, int32_t frame)
{
    mask->bits[frame / 64 % 4] |= UINT64_C(1) << frame % 64;
}

kiriFrameMask kiriBlocks_MaskOfOther(const kiriPatches* patches)
{
    kiriFrameMask mask = { { 0 } };
    for (int32_t i = 0; patches->areOther && i < patches->count; ++i) {
        if (patches->isOther.data[i]) {
            AddToMask(&mask, i);
        }
    }
    return mask;
}

static int32_t EndOfBlock(const kiriSheetData* sheet, int32_t block)
{
    int32_t count = sheet->seen.surface.vertexCount;
    return (block + 1) * KIRI_BLOCK < count ? (block + 1) * KIRI_BLOCK : count;
}

static void WriteMask(kiriSheetData* sheet, int32_t block)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriFrameMask mask = { { 0 } };
    for (int32_t v = block * KIRI_BLOCK; v < EndOfBlock(sheet, block); ++v) {
        const kiriSampleWeight* weight = skin->weights.data + skin->spans.data[v].first;
        for (const kiriSampleWeight* end = weight + skin->spans.data[v].count; weight < end; ++weight) {
            AddToMask(&mask, weight->frame);
        }
    }
    sheet->seen.blocks.frames.data[block] = mask;
}

/* ---- Movers ---- */

static int32_t FindMover(const kiriSheetData* sheet, int32_t block)
{
    for (int32_t v = block * KIRI_BLOCK; v < EndOfBlock(sheet, block); ++v) {
        kiriSpan span = sheet->vertexSkin.spans.data[v]; /* of a hole it is empty */
        int32_t frame = span.count > 0 ? sheet->vertexSkin.weights.data[span.first].frame : KIRI_NONE;
        if (frame != KIRI_NONE && kiriSheet_Moves(sheet, frame)) {
            return frame;
        }
    }
    return KIRI_NONE;
}

/* Frames that move and did not when movers were found last. */
static kiriFrameMask TakeWoken(kiriSheetData* sheet)
{
    kiriFrameMask woken = { { 0 } };
    uint8_t* moved = sheet->seen.blocks.moved.data;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        uint8_t moves = kiriSheet_Moves(sheet, i);
        if (moves && !moved[i]) {
            AddToMask(&woken, i);
        }
        moved[i] = moves;
    }
    return woken;
}

/* Is the mover of the block what it was? */
static bool IsMoverKnown(const kiriSheetData* sheet, int32_t block, const kiriFrameMask* woken)
{
    const kiriBlocks* blocks = &sheet->seen.blocks;
    int32_t mover = blocks->movers.data[block];
    return mover == KIRI_NONE ? !kiriBlocks_MayMeet(blocks, block, woken)
                              : mover != KIRI_UNKNOWN && kiriSheet_Moves(sheet, mover);
}

void kiriBlocks_FindMovers(kiriSheetData* sheet)
{
    kiriBlocks* blocks = &sheet->seen.blocks;
    kiriFrameMask woken = TakeWoken(sheet);
    for (int32_t block = 0; block < blocks->movers.count; ++block) {
        if (blocks->movers.data[block] == KIRI_UNKNOWN) {
            WriteMask(sheet, block);
        }
        if (!IsMoverKnown(sheet, block, &woken)) {
            blocks->movers.data[block] = FindMover(sheet, block);
        }
    }
    blocks->hasUnknown = false;
}
