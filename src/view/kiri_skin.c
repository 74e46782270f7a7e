#include "kiri_skin.h"
#include "../core/kiri_lanes.h"

#include <string.h>

static int32_t CarrierCount(const kiriIndices* list, int32_t count)
{
    return list != NULL ? list->count : count;
}

static int32_t CarrierAt(const kiriIndices* list, int32_t n)
{
    return list != NULL ? list->data[n] : n;
}

void kiriCarriers_Write(kiriCarrier* carriers, const kiriFrameData* frames, int32_t count, const kiriIndices* some)
{
    for (int32_t n = 0; n < CarrierCount(some, count); ++n) {
        int32_t i = CarrierAt(some, n);
        kiriCarrier* carrier = &carriers[i];
        memset(carrier, 0, sizeof(*carrier));
        carrier->u = frames[i].A.u;
        carrier->v = frames[i].A.v;
        carrier->x = frames[i].x;
        carrier->center = frames[i].center;
        carrier->six = 6.0;
        carrier->d = kiriVec3_Normalize(kiriVec3_Cross(carrier->u, carrier->v));
    }
}

/* ---- Curvature ----

   In a flat patch the surface bulges: half-way between two frames that stand at an angle t on a cylinder of radius R,
   both patches are R t^2 / 8 outside. So the patch of a frame follows the arc that its neighbours' directors tell. Be K
   the curvature, g = K q and f^2 = g . g: the patch goes from q to q sin f / f in the plane, and up by
   q . g (1 - cos f) / f^2. That is exact for one direction of bending, which is what thin sheets have, and right to the
   second order elsewhere.

   A frame that stretches by s has arcs s times as long for the same angles: K and six, divided by s^2, say so. */

/* The angle, of which this is the cosine, over its sine: Pade's [4/4] of the half-angle's arc tangent, 0.7 % off at 120
   degrees. Never above 8: frames back to back tell nothing. */
static double AngleOverSine(double cosine)
{
    double lower = kiriMax(1.0 + cosine, 0.1), x = (2.0 - lower) / lower;
    double angle = (945.0 + x * (735.0 + 64.0 * x)) / (945.0 + x * (1050.0 + 225.0 * x));
    return angle * (1.0 + x);
}

/* How the director of `other` leans, seen from a frame, where it is s away. */
static void AddDirectorTurn(kiriBend* bend, const kiriCarrier* carrier, kiriVec3 other, kiriVec2 s, double weight)
{
    double k = -weight * AngleOverSine(kiriVec3_Dot(carrier->d, other));
    double tu = k * kiriVec3_Dot(carrier->u, other), tv = k * kiriVec3_Dot(carrier->v, other);
    bend->uu += weight * s.x * s.x;
    bend->uv += weight * s.x * s.y;
    bend->vv += weight * s.y * s.y;
    bend->ruu += s.x * tu;
    bend->ruv += s.y * tu + s.x * tv;
    bend->rvv += s.y * tv;
}

/* The symmetric K that best takes each way s to its lean; where the neighbours, all in a row, leave it open, the least.
   That share, a thousandth, also says how far K may follow the noise across a row. */
static void Curve(kiriCarrier* carrier, const kiriBend* bend)
{
    double least = 1e-3 * (bend->uu + bend->vv), m = bend->uv;
    double a = bend->uu + least, c = bend->vv + least, b = bend->uu + bend->vv + 2.0 * least;
    double det = a * (b * c - m * m) - m * m * c;
    double square = kiriVec3_Length(kiriVec3_Cross(carrier->u, carrier->v));
    /* A patch that is nearly a line, or is stretched 1e12 times, stays flat: floats cannot hold `six`. */
    if (!(det > 0.0 && square > 1e-24 && square < 1e24)) {
        return;
    }
    double scale = 1.0 / (square * det);
    carrier->six = 6.0 / square;
    carrier->uu = scale * ((b * c - m * m) * bend->ruu - m * c * bend->ruv + m * m * bend->rvv);
    carrier->uv = scale * (-m * c * bend->ruu + a * c * bend->ruv - a * m * bend->rvv);
    carrier->vv = scale * (m * m * bend->ruu - a * m * bend->ruv + (a * b - m * m) * bend->rvv);
}

/* rad: rms of the angle by which a patch may turn over its region. On an arc that is 40 degrees from frame to frame. */
static const double mostTurn = 0.2;

/* Where neighbours turn farther, they do not tell how the region bends: there are creases, narrow bridges, and
   neighbours on both sides of a slit that bend apart. A patch that is less bent is strained less there. */
static void LimitCurve(kiriCarrier* carrier, const kiriFrameData* frame)
{
    double uu = carrier->uu, uv = carrier->uv, vv = carrier->vv;
    const double* m = frame->inertia;
    double square = (uu * uu + uv * uv) * m[0] + 2.0 * uv * (uu + vv) * m[1] + (uv * uv + vv * vv) * m[2];
    double turn = frame->mass > 0.0 && square > 0.0 ? sqrt(6.0 * square / (carrier->six * frame->mass)) : 0.0;
    if (turn > mostTurn) {
        carrier->uu *= mostTurn / turn;
        carrier->uv *= mostTurn / turn;
        carrier->vv *= mostTurn / turn;
    }
}

void kiriCarriers_Bend(kiriCarrier* carriers, kiriBend* bends, const kiriFrameData* frames, int32_t count,
                       const kiriLink* links, int32_t linkCount, const kiriIndices* some, const kiriIndices* someLinks)
{
    for (int32_t n = 0; n < CarrierCount(some, count); ++n) {
        memset(&bends[CarrierAt(some, n)], 0, sizeof(kiriBend));
    }
    for (int32_t n = 0; n < CarrierCount(someLinks, linkCount) && CarrierAt(someLinks, n) < linkCount; ++n) {
        const kiriLink* link = &links[CarrierAt(someLinks, n)];
        kiriCarrier *i = &carriers[link->i], *j = &carriers[link->j];
        kiriVec2 start = kiriVec2_Sub(frames[link->i].site.at, frames[link->i].center);
        kiriVec2 end = kiriVec2_Sub(frames[link->j].center, frames[link->j].site.at);
        kiriVec2 way = kiriVec2_Add(kiriVec2_Add(start, link->span), end); /* from centre to centre */
        AddDirectorTurn(&bends[link->i], i, j->d, way, link->width);
        AddDirectorTurn(&bends[link->j], j, i->d, kiriVec2_Scale(-1.0, way), link->width);
    }
    for (int32_t n = 0; n < CarrierCount(some, count); ++n) {
        int32_t i = CarrierAt(some, n);
        Curve(&carriers[i], &bends[i]);
        LimitCurve(&carriers[i], &frames[i]);
    }
}

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

/* ---- Two triangles ----------------------------------------------------------------------------------------------- */

/* Which of their six corners come in which order: as they are; turned by their edges j and k, which they share, from
   1 + 3 j + k on; one alone, followed by one without area. */
enum { PAIR_AS_IS, PAIR_TURNED, PAIR_ALONE = PAIR_TURNED + 9, PAIR_TURNS };
static const uint8_t pairOrders[PAIR_TURNS][6] = {
    { 0, 1, 2, 3, 4, 5 }, { 1, 2, 0, 3, 4, 5 }, { 1, 2, 0, 4, 5, 3 }, { 1, 2, 0, 5, 3, 4 },
    { 2, 0, 1, 3, 4, 5 }, { 2, 0, 1, 4, 5, 3 }, { 2, 0, 1, 5, 3, 4 }, { 0, 1, 2, 3, 4, 5 },
    { 0, 1, 2, 4, 5, 3 }, { 0, 1, 2, 5, 3, 4 }, { 0, 1, 2, 0, 0, 0 },
};

uint8_t kiriNormals_TurnOf(const int32_t* indices, bool isAlone)
{
    const int32_t *a = indices, *b = indices + 3;
    int turn = isAlone ? PAIR_ALONE : PAIR_AS_IS;
    for (int i = 0; turn == PAIR_AS_IS && i < 9; ++i) {
        int j = i / 3, k = i % 3;
        bool isShared = a[j] == b[(k + 1) % 3] && a[(j + 1) % 3] == b[k];
        turn = isShared ? PAIR_TURNED + i : turn;
    }
    return (uint8_t)turn;
}

static void GetPair(const kiriCorners* corners, int32_t pair, int32_t v[6])
{
    const int32_t* indices = corners->indices + 6 * (ptrdiff_t)pair;
    const uint8_t* order = pairOrders[corners->turns[pair]];
    for (int i = 0; i < 6; ++i) {
        v[i] = indices[order[i]];
    }
}

/* ---- Sums -------------------------------------------------------------------------------------------------------- */

static kiriLanes EdgeAlong(const float* x, int32_t from, int32_t to)
{
    return kiriLanes_Sub(kiriLanes_Load(x + 3 * (ptrdiff_t)to), kiriLanes_Load(x + 3 * (ptrdiff_t)from));
}

static void AddSlope(float* slopes, int32_t vertex, kiriLanes slope)
{
    float* sum = slopes + 4 * (ptrdiff_t)vertex;
    kiriLanes_Store(sum, kiriLanes_Add(kiriLanes_Load(sum), slope));
}

/* The cross product of two sides is twice the area times the normal: sums are area-weighted. Where two triangles share
   an edge, their corners on it get one sum from both. */
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners)
{
    memset(slopes, 0, 4 * sizeof(float) * (size_t)vertexCount);
    for (int32_t t = 0; t < corners->triangleCount; t += 2) {
        int32_t v[6];
        GetPair(corners, t / 2, v);
        kiriLanes ac = EdgeAlong(positions, v[0], v[2]), first = kiriLanes_Cross(EdgeAlong(positions, v[0], v[1]), ac);
        AddSlope(slopes, v[1], first);
        if (v[0] == v[3] && v[2] == v[4]) {
            kiriLanes second = kiriLanes_Cross(ac, EdgeAlong(positions, v[0], v[5])),
                      both = kiriLanes_Add(first, second);
            AddSlope(slopes, v[5], second);
            AddSlope(slopes, v[0], both);
            AddSlope(slopes, v[2], both);
        } else {
            kiriLanes second = kiriLanes_Cross(EdgeAlong(positions, v[3], v[4]), EdgeAlong(positions, v[3], v[5]));
            AddSlope(slopes, v[0], first);
            AddSlope(slopes, v[2], first);
            AddSlope(slopes, v[3], second);
            AddSlope(slopes, v[4], second);
            AddSlope(slopes, v[5], second);
        }
    }
}

/* The same for one vertex of a pair, in the same order. */
static kiriLanes AddPairTo(kiriLanes sum, int32_t vertex, const float* positions, const int32_t* v)
{
    kiriLanes ac = EdgeAlong(positions, v[0], v[2]), first = kiriLanes_Cross(EdgeAlong(positions, v[0], v[1]), ac);
    if (v[0] == v[3] && v[2] == v[4]) {
        kiriLanes second = kiriLanes_Cross(ac, EdgeAlong(positions, v[0], v[5])), both = kiriLanes_Add(first, second);
        const kiriLanes by[4] = { first, second, both, both };
        const int32_t of[4] = { v[1], v[5], v[0], v[2] };
        for (int k = 0; k < 4; ++k) {
            sum = of[k] == vertex ? kiriLanes_Add(sum, by[k]) : sum;
        }
        return sum;
    }
    kiriLanes second = kiriLanes_Cross(EdgeAlong(positions, v[3], v[4]), EdgeAlong(positions, v[3], v[5]));
    for (int k = 0; k < 6; ++k) {
        sum = v[k] == vertex ? kiriLanes_Add(sum, k < 3 ? first : second) : sum;
    }
    return sum;
}

enum { MOST_PAIRS = 64 }; /* around a vertex */

/* Into a row of pairs that ascends, once; false where there is no room. */
static bool InsertPair(int32_t* pairs, int32_t* count, int32_t pair)
{
    int32_t at = *count;
    while (at > 0 && pairs[at - 1] > pair) {
        --at;
    }
    if (at > 0 && pairs[at - 1] == pair) {
        return true;
    }
    if (*count == MOST_PAIRS) {
        return false;
    }
    memmove(pairs + at + 1, pairs + at, sizeof(*pairs) * (size_t)(*count - at));
    pairs[at] = pair;
    *count += 1;
    return true;
}

/* The pairs of the fan of a vertex: counter-clockwise all around or to its end, else clockwise from where it began. */
static bool ListPairs(const kiriMeshData* mesh, int32_t vertex, int32_t* pairs, int32_t* count)
{
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
    int32_t start = mesh->vertices.data[vertex].edge, h = start;
    bool ok = true;
    *count = 0;
    while (ok && h != KIRI_NONE) {
        ok = InsertPair(pairs, count, h / 6);
        h = kiriMesh_CounterClockwise(mesh, h);
        if (h == start) {
            return ok;
        }
    }
    h = start == KIRI_NONE ? KIRI_NONE : kiriMesh_Clockwise(mesh, start);
    while (ok && h != KIRI_NONE) {
        ok = InsertPair(pairs, count, h / 6);
        h = kiriMesh_Clockwise(mesh, h);
    }
    return ok;
}

bool kiriNormals_SumOne(float* slopes, int32_t vertex, const float* positions, const kiriCorners* corners,
                        const kiriMeshData* mesh)
{
    int32_t pairs[MOST_PAIRS], count;
    kiriLanes sum = kiriLanes_Splat(0.0f);
    if (!ListPairs(mesh, vertex, pairs, &count)) {
        return false;
    }
    for (int32_t k = 0; k < count; ++k) {
        int32_t v[6];
        GetPair(corners, pairs[k], v);
        sum = AddPairTo(sum, vertex, positions, v);
    }
    kiriLanes_Store(slopes + 4 * (ptrdiff_t)vertex, sum);
    return true;
}

/* A length that fits a float may have a square that does not. */
static void WriteNormal(float* normal, const float* slope)
{
    kiriVec3 unit = kiriVec3_Normalize(kiriVec3_Load(slope));
    bool known = kiriVec3_Dot(unit, unit) > 0.0;
    kiriVec3_Store(normal, known ? unit : kiriVec3_Make(0.0, 0.0, 1.0));
}

/* Four squared lengths: x, y and z of each are brought together first. */
static kiriLanes SquaresOf(const float* slopes)
{
    kiriLanes a = kiriLanes_Load(slopes), b = kiriLanes_Load(slopes + 4);
    kiriLanes c = kiriLanes_Load(slopes + 8), d = kiriLanes_Load(slopes + 12);
    kiriLanes abxy = kiriLanes_Join(a, 0, 1, b, 0, 1), cdxy = kiriLanes_Join(c, 0, 1, d, 0, 1);
    kiriLanes x = kiriLanes_Join(abxy, 0, 2, cdxy, 0, 2), y = kiriLanes_Join(abxy, 1, 3, cdxy, 1, 3);
    kiriLanes z = kiriLanes_Join(kiriLanes_Join(a, 2, 2, b, 2, 2), 0, 2, kiriLanes_Join(c, 2, 2, d, 2, 2), 0, 2);
    kiriLanes xy = kiriLanes_Add(kiriLanes_Mul(x, x), kiriLanes_Mul(y, y));
    return kiriLanes_Add(xy, kiriLanes_Mul(z, z));
}

static void WriteFourNormals(float* normals, const float* slopes)
{
    float square[4], scale[4];
    kiriLanes squares = SquaresOf(slopes);
    kiriLanes_Store(square, squares);
    kiriLanes_Store(scale, kiriLanes_Div(kiriLanes_Splat(1.0f), kiriLanes_Sqrt(squares)));
    for (int k = 0; k < 4; ++k) {
        if (square[k] > 1e-30f && square[k] < 1e30f) {
            kiriLanes unit = kiriLanes_Mul(kiriLanes_Splat(scale[k]), kiriLanes_Load(slopes + 4 * k));
            kiriLanes_StoreThree(normals + 3 * k, unit);
        } else {
            WriteNormal(normals + 3 * k, slopes + 4 * k);
        }
    }
}

/* The last ones are written by fours too, so that ranges do not change any. */
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end)
{
    int32_t v = begin;
    for (; v + 4 <= end; v += 4) {
        WriteFourNormals(normals + 3 * (ptrdiff_t)v, slopes + 4 * (ptrdiff_t)v);
    }
    float last[16] = { 0.0f }, written[12];
    if (v < end) {
        memcpy(last, slopes + 4 * (ptrdiff_t)v, 4 * sizeof(float) * (size_t)(end - v));
        WriteFourNormals(written, last);
        memcpy(normals + 3 * (ptrdiff_t)v, written, 3 * sizeof(float) * (size_t)(end - v));
    }
}
