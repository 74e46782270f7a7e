#include "kiri_blend.h"

#include "../core/kiri_lanes.h"

#include <string.h>

bool kiriPatches_Reserve(kiriPatches* patches, kiriMemory* memory, int32_t count)
{
    return kiriArray_Reserve(memory, &patches->floats, (int64_t)KIRI_BENT_FLOATS * count) &&
           kiriArray_Reserve(memory, &patches->isOther, count);
}

void kiriPatches_Forget(kiriPatches* patches)
{
    patches->count = 0;
}

/* ---- Rows of floats ---- */

/* A row: origin, u, v; the origin is where the patch has the local origin. */
static void WriteFlat(float* row, const kiriCarrier* carrier, kiriVec3 from)
{
    kiriVec3 origin = kiriVec3_Sub(carrier->x, from);
    origin = kiriVec3_AddScaled(origin, -carrier->center.x, carrier->u);
    origin = kiriVec3_AddScaled(origin, -carrier->center.y, carrier->v);
    kiriVec3_Store(row, origin);
    kiriVec3_Store(row + 4, carrier->u);
    kiriVec3_Store(row + 8, carrier->v);
    row[3] = row[7] = row[11] = 0.0f;
}

static void WriteFour(float* four, double a, double b, double c, double d)
{
    four[0] = (float)a;
    four[1] = (float)b;
    four[2] = (float)c;
    four[3] = (float)d;
}

/* A row: center; curvature in two parts; twice six; x, u, v, six d. */
static void WriteBent(float* row, const kiriCarrier* carrier, kiriVec3 from)
{
    WriteFour(row, carrier->center.x, carrier->center.y, carrier->uu, carrier->vv);
    WriteFour(row + 4, carrier->uv, carrier->uv, 2.0 * carrier->six, 2.0 * carrier->six);
    const kiriVec3 axes[4] = { kiriVec3_Sub(carrier->x, from), carrier->u, carrier->v,
                               kiriVec3_Scale(6.0, carrier->d) };
    for (int k = 0; k < 4; ++k) {
        WriteFour(row + 8 + 4 * k, axes[k].x, axes[k].y, axes[k].z, 0.0);
    }
}

/* A frame that gets another center carries the same flat patch, but for the last bits of its doubles. Of floats only
   those near 0 tell. */
static uint8_t ChangeOfRow(const float* was, const float* row, size_t each)
{
    const float least = 1e-12f;
    uint8_t change = KIRI_PATCH_SAME;
    for (size_t k = 0; k < each; ++k) {
        float by = row[k] - was[k];
        if (memcmp(&row[k], &was[k], sizeof(float)) != 0) {
            change = change != KIRI_PATCH_OTHER && by > -least && by < least ? KIRI_PATCH_ROUNDED : KIRI_PATCH_OTHER;
        }
    }
    return change;
}

static void ClearUnused(kiriPatches* patches, const kiriLabels* labels, size_t each)
{
    for (int32_t label = 0; label < labels->itemOf.count; ++label) {
        if (labels->itemOf.data[label] == KIRI_NONE) {
            memset(patches->floats.data + each * (size_t)label, 0, sizeof(float) * each);
        }
    }
}

/* All rows are empty, or as they were written last. Returns how many are. */
static int32_t StartWriting(kiriPatches* patches, const kiriLabels* labels, int32_t rows, bool isBent, size_t each)
{
    int32_t known = patches->isBent == isBent ? patches->count : 0;
    patches->areOther = patches->count != rows;
    patches->count = patches->isOther.count = rows;
    patches->isBent = isBent;
    patches->floats.count = (int32_t)each * rows;
    KIRI_ASSERT(patches->floats.count <= patches->floats.capacity);
    if (rows > 0) {
        memset(patches->isOther.data, 0, (size_t)rows);
    }
    if (known != rows) {
        ClearUnused(patches, labels, each);
    }
    return known;
}

bool kiriPatches_Write(kiriPatches* patches, const kiriLabels* labels, const kiriCarrier* carriers, int32_t count,
                       kiriVec3 from, bool isBent, const kiriIndices* some)
{
    size_t each = isBent ? KIRI_BENT_FLOATS : KIRI_FLAT_FLOATS;
    int32_t rows = kiriLabels_Count(labels, count), known = StartWriting(patches, labels, rows, isBent, each);
    KIRI_ASSERT(some == NULL || known == rows);
    for (int32_t n = 0; n < (some != NULL ? some->count : count); ++n) {
        int32_t i = some != NULL ? some->data[n] : n, at = kiriLabels_Of(labels, i);
        float row[KIRI_BENT_FLOATS], *was = patches->floats.data + each * (size_t)at;
        if (isBent) {
            WriteBent(row, &carriers[i], from);
        } else {
            WriteFlat(row, &carriers[i], from);
        }
        patches->isOther.data[at] = at >= known ? KIRI_PATCH_OTHER : ChangeOfRow(was, row, each);
        patches->areOther |= patches->isOther.data[at] != KIRI_PATCH_SAME;
        memcpy(was, row, sizeof(float) * each);
    }
    return patches->areOther;
}

bool kiriPatches_MayMove(const kiriPatches* patches, const kiriSkin* skin, int32_t begin, int32_t end)
{
    bool mayMove = false;
    for (int32_t s = begin; patches->areOther && !mayMove && s < end; ++s) {
        const kiriSampleWeight* weight = skin->weights.data + skin->spans.data[s].first;
        const kiriSampleWeight* last = weight + skin->spans.data[s].count;
        for (; weight < last; ++weight) {
            mayMove |= patches->isOther.data[weight->label];
        }
    }
    return mayMove;
}

/* ---- Positions ---- */

static kiriLanes BlendFlat(const float* rows, const kiriSampleWeight* weight, const kiriSampleWeight* end, kiriVec2 p)
{
    kiriLanes px = kiriLanes_Splat((float)p.x), py = kiriLanes_Splat((float)p.y), sum = kiriLanes_Splat(0.0f);
    for (; weight < end; ++weight) {
        const float* row = rows + (ptrdiff_t)KIRI_FLAT_FLOATS * weight->label;
        kiriLanes at = kiriLanes_Add(kiriLanes_Load(row), kiriLanes_Mul(px, kiriLanes_Load(row + 4)));
        at = kiriLanes_Add(at, kiriLanes_Mul(py, kiriLanes_Load(row + 8)));
        sum = kiriLanes_Add(sum, kiriLanes_Mul(kiriLanes_Splat(weight->value), at));
    }
    return sum;
}

/* x + a u + b v + bow d, a and b being lanes of `flat`. */
#define CARRY_BENT(row, flat, a, b, bow, at)                                                                           \
    do {                                                                                                               \
        (at) = kiriLanes_Add(kiriLanes_Load((row) + 8),                                                                \
                             kiriLanes_Mul(kiriLanes_Pick(flat, a, a, a, a), kiriLanes_Load((row) + 12)));             \
        (at) = kiriLanes_Add(at, kiriLanes_Mul(kiriLanes_Pick(flat, b, b, b, b), kiriLanes_Load((row) + 16)));         \
        (at) = kiriLanes_Add(at, kiriLanes_Mul(kiriLanes_Pick(bow, a, a, a, a), kiriLanes_Load((row) + 20)));          \
    } while (0)

/* Two frames at a time. With q = p - center and g = K q the lanes have q, g, then q . g and g . g, then q - bow g;
   `half` is half of bow. sin f / f and (1 - cos f) / f^2 are fractions over 12 + f^2: one thousandth off at 40 degrees,
   and however strongly bent never farther from the center than twice q. */
static kiriLanes AddBent(kiriLanes sum, const float* rows, kiriSampleWeight first, kiriSampleWeight second, kiriLanes p)
{
    const float* a = rows + (ptrdiff_t)KIRI_BENT_FLOATS * first.label;
    const float* b = rows + (ptrdiff_t)KIRI_BENT_FLOATS * second.label;
    kiriLanes q = kiriLanes_Sub(p, kiriLanes_LoadTwice(a, b)), at;
    kiriLanes g = kiriLanes_Add(kiriLanes_Mul(q, kiriLanes_LoadTwice(a + 2, b + 2)),
                                kiriLanes_Mul(kiriLanes_Pick(q, 1, 0, 3, 2), kiriLanes_LoadTwice(a + 4, b + 4)));
    kiriLanes qg = kiriLanes_Mul(q, g), gg = kiriLanes_Mul(g, g);
    qg = kiriLanes_Add(qg, kiriLanes_Pick(qg, 1, 0, 3, 2));
    gg = kiriLanes_Add(gg, kiriLanes_Pick(gg, 1, 0, 3, 2));
    kiriLanes half = kiriLanes_Div(qg, kiriLanes_Add(kiriLanes_LoadTwice(a + 6, b + 6), gg));
    kiriLanes flat = kiriLanes_Sub(q, kiriLanes_Mul(kiriLanes_Add(half, half), g));
    CARRY_BENT(a, flat, 0, 1, half, at);
    sum = kiriLanes_Add(sum, kiriLanes_Mul(kiriLanes_Splat(first.value), at));
    CARRY_BENT(b, flat, 2, 3, half, at);
    return kiriLanes_Add(sum, kiriLanes_Mul(kiriLanes_Splat(second.value), at));
}

/* An odd last one has a partner that counts nothing. */
static kiriLanes BlendBent(const float* rows, const kiriSampleWeight* weight, const kiriSampleWeight* end, kiriVec2 p)
{
    float x = (float)p.x, y = (float)p.y;
    kiriLanes at = kiriLanes_Four(x, y, x, y), sum = kiriLanes_Splat(0.0f);
    for (; weight + 1 < end; weight += 2) {
        sum = AddBent(sum, rows, weight[0], weight[1], at);
    }
    if (weight < end) {
        sum = AddBent(sum, rows, *weight, (kiriSampleWeight){ weight->label, 0.0f }, at);
    }
    return sum;
}

/* Loops of their own, for speed. */
void kiriSkin_WritePositions(const kiriSkin* skin, const kiriPatches* patches, const kiriVec2* rest, int32_t begin,
                             int32_t end, float* positions)
{
    const float* rows = patches->floats.data;
    for (int32_t v = begin; !patches->isBent && v < end; ++v) {
        const kiriSampleWeight* first = skin->weights.data + skin->spans.data[v].first;
        kiriLanes at = BlendFlat(rows, first, first + skin->spans.data[v].count, rest[v]);
        kiriLanes_StoreThree(positions + 3 * (ptrdiff_t)v, at);
    }
    for (int32_t v = begin; patches->isBent && v < end; ++v) {
        const kiriSampleWeight* first = skin->weights.data + skin->spans.data[v].first;
        kiriLanes at = BlendBent(rows, first, first + skin->spans.data[v].count, rest[v]);
        kiriLanes_StoreThree(positions + 3 * (ptrdiff_t)v, at);
    }
}
