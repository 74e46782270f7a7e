#include "kiri_blocks.h"

#include <string.h>

static void SetCounts(kiriBlocks* blocks, int32_t count, int32_t frameCount)
{
    blocks->touched.count = blocks->stale.count = blocks->frames.count = blocks->movers.count = count;
    blocks->moved.count = frameCount;
}

bool kiriBlocks_Resize(kiriBlocks* blocks, kiriMemory* memory, int32_t vertexCount, int32_t frameCount)
{
    int32_t old = blocks->movers.count, count = vertexCount / KIRI_BLOCK + 1, oldFrames = blocks->moved.count;
    if (!kiriArray_Reserve(memory, &blocks->touched, count) || !kiriArray_Reserve(memory, &blocks->stale, count) ||
        !kiriArray_Reserve(memory, &blocks->frames, count) || !kiriArray_Reserve(memory, &blocks->movers, count) ||
        !kiriArray_Reserve(memory, &blocks->moved, frameCount)) {
        return false;
    }
    SetCounts(blocks, count, frameCount);
    for (int32_t block = old; block < count; ++block) {
        blocks->touched.data[block] = blocks->stale.data[block] = 0;
        kiriBlocks_ForgetOne(blocks, block);
    }
    for (int32_t i = oldFrames; i < frameCount; ++i) {
        blocks->moved.data[i] = 0;
    }
    return true;
}

void kiriBlocks_Truncate(kiriBlocks* blocks, int32_t vertexCount, int32_t frameCount)
{
    KIRI_ASSERT(vertexCount / KIRI_BLOCK + 1 <= blocks->movers.count && frameCount <= blocks->moved.count);
    SetCounts(blocks, vertexCount / KIRI_BLOCK + 1, frameCount);
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

enum { MASK_WORDS = 4, MASK_BITS = 64 * MASK_WORDS, MASK_HALF = MASK_BITS / 2 };

static void AddBit(kiriFrameMask* mask, int bit)
{
    mask->bits[bit / 64] |= UINT64_C(1) << bit % 64;
}

/* Of the two bits of a label one tells it from those near its own, and the other from those far from it. Labels share
   bits: a block may seem to have one that it has not. */
static void AddToMask(kiriFrameMask* mask, int32_t label)
{
    AddBit(mask, label % MASK_HALF);
    AddBit(mask, MASK_HALF + label / MASK_HALF % MASK_HALF);
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

/* ---- Frames that go ---- */

static void KeepMoved(kiriBlocks* blocks, const kiriKeep* frames)
{
    for (int32_t i = 0; i < blocks->moved.count; ++i) {
        int32_t to = i < frames->to.count ? kiriKeep_To(frames, i) : KIRI_NONE;
        if (to != KIRI_NONE) {
            blocks->moved.data[to] = blocks->moved.data[i];
        }
    }
    for (int32_t i = frames->count; i < blocks->moved.count; ++i) {
        blocks->moved.data[i] = 0;
    }
}

void kiriBlocks_LeaveHoles(kiriBlocks* blocks, const kiriIndices* vertices, const kiriKeep* frames)
{
    for (int32_t k = 0; k < vertices->count; ++k) {
        kiriBlocks_ForgetOne(blocks, vertices->data[k] / KIRI_BLOCK);
    }
    KeepMoved(blocks, frames);
}

/* ---- Masks ---- */

static const uint64_t ALL_BITS = UINT64_MAX;

/* It may meet any other, so it is right for every block. */
static void FillMask(kiriFrameMask* mask)
{
    for (int k = 0; k < MASK_WORDS; ++k) {
        mask->bits[k] = ALL_BITS;
    }
}

static bool IsFull(const kiriFrameMask* mask)
{
    return (mask->bits[0] & mask->bits[1] & mask->bits[2] & mask->bits[3]) == ALL_BITS;
}

static int32_t EndOfBlock(const kiriSheetData* sheet, int32_t block)
{
    int32_t count = sheet->seen.surface.vertexCount;
    return kiriMin((block + 1) * KIRI_BLOCK, count);
}

static void WriteMask(kiriSheetData* sheet, int32_t block)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriFrameMask mask = { { 0 } };
    for (int32_t v = block * KIRI_BLOCK; v < EndOfBlock(sheet, block); ++v) {
        const kiriSampleWeight* weight = skin->weights.data + skin->spans.data[v].first;
        for (const kiriSampleWeight* end = weight + skin->spans.data[v].count; weight < end; ++weight) {
            AddToMask(&mask, weight->label);
        }
    }
    sheet->seen.blocks.frames.data[block] = mask;
}

/* Of some blocks in each tick: after a cut all of a large sheet may be due. */
static void WriteSomeMasks(kiriSheetData* sheet)
{
    enum { MASKS_A_TICK = 128 };
    kiriBlocks* blocks = &sheet->seen.blocks;
    int32_t left = MASKS_A_TICK;
    for (int32_t block = 0; left > 0 && block < blocks->frames.count; ++block) {
        if (IsFull(&blocks->frames.data[block])) {
            WriteMask(sheet, block);
            --left;
        }
    }
    blocks->hasUnknown = left == 0;
}

/* ---- Movers ---- */

/* What moves is known of all frames. */
static int32_t FindMover(const kiriSheetData* sheet, int32_t block)
{
    const uint8_t* moves = sheet->seen.blocks.moved.data;
    for (int32_t v = block * KIRI_BLOCK; v < EndOfBlock(sheet, block); ++v) {
        kiriSpan span = sheet->vertexSkin.spans.data[v]; /* of a hole it is empty */
        int32_t label = span.count > 0 ? sheet->vertexSkin.weights.data[span.first].label : KIRI_NONE;
        if (label != KIRI_NONE && moves[kiriSheet_FrameOf(sheet, label)]) {
            return label;
        }
    }
    return KIRI_NONE;
}

/* Of frames: those that move, and those of them that did not when movers were found last. */
typedef struct MovingFrames {
    kiriFrameMask all, woken;
} MovingFrames;

static MovingFrames TakeMoving(kiriSheetData* sheet)
{
    MovingFrames moving = { { { 0 } }, { { 0 } } };
    uint8_t* moved = sheet->seen.blocks.moved.data;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        uint8_t moves = kiriSheet_Moves(sheet, i);
        int32_t label = kiriLabels_Of(&sheet->shape.labels, i);
        if (moves) {
            AddToMask(&moving.all, label);
        }
        if (moves && !moved[i]) {
            AddToMask(&moving.woken, label);
        }
        moved[i] = moves;
    }
    return moving;
}

/* Is the mover of the block what it was? */
static bool IsMoverKnown(const kiriSheetData* sheet, int32_t block, const MovingFrames* moving)
{
    const kiriBlocks* blocks = &sheet->seen.blocks;
    int32_t mover = blocks->movers.data[block];
    return mover == KIRI_NONE ? !kiriBlocks_MayMeet(blocks, block, &moving->woken)
                              : mover != KIRI_UNKNOWN && blocks->moved.data[kiriSheet_FrameOf(sheet, mover)];
}

void kiriBlocks_FindMovers(kiriSheetData* sheet)
{
    kiriBlocks* blocks = &sheet->seen.blocks;
    MovingFrames moving = TakeMoving(sheet);
    for (int32_t block = 0; block < blocks->movers.count; ++block) {
        if (blocks->movers.data[block] == KIRI_UNKNOWN) {
            FillMask(&blocks->frames.data[block]);
            blocks->movers.data[block] = FindMover(sheet, block);
        } else if (!IsMoverKnown(sheet, block, &moving)) {
            bool may = kiriBlocks_MayMeet(blocks, block, &moving.all);
            blocks->movers.data[block] = may ? FindMover(sheet, block) : KIRI_NONE;
        }
    }
    WriteSomeMasks(sheet);
}
