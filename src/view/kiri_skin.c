#include "kiri_skin.h"
#include "../core/kiri_lanes.h"

/* Items of a list, or all if there is none. */
static int32_t ItemCount(const kiriIndices* list, int32_t count)
{
    return list != NULL ? list->count : count;
}

static int32_t SampleAt(const kiriIndices* list, int32_t n)
{
    return list != NULL ? list->data[n] : n;
}

void kiriCarriers_Write(kiriCarrier* carriers, const kiriFrameData* frames, int32_t count, const kiriIndices* some)
{
    KIRI_TIMES(n, ItemCount(some, count)) {
        int32_t i = SampleAt(some, n);
        kiriVec3 u = frames[i].A.u, v = frames[i].A.v, d = kiriVec3_Normalize(kiriVec3_Cross(u, v));
        KIRI_ASSERT(i >= 0 && i < count);
        carriers[i] = (kiriCarrier){ u, v, d, frames[i].x, frames[i].center, 0.0, 0.0, 0.0, 6.0 };
    }
}

/* ---- Curvature ----------------------------------------------------------------------------------------------------

   Flat patches bulge: half-way between two frames that stand at an angle t on a cylinder of radius R, both are R t^2 / 8
   outside. So the patch of a frame follows the arc that the directors of its neighbors tell. Let K be the curvature,
   g = K q and f^2 = g . g: the patch goes from q to q sin f / f in the plane, and up by q . g (1 - cos f) / f^2. That is
   exact for one direction of bending, which thin sheets have, and right to the second order elsewhere.

   A frame that stretches by s has arcs s times as long for the same angles: so K and six are divided by s^2. */

/* Returns the turn of the director of another frame, seen from a frame. */
static kiriVec2 TurnOf(const kiriCarrier* carrier, kiriVec3 other)
{
    /* The angle over its sine, from its cosine: Pade's [2/2] of the arc tangent of the half-angle, 0.8 % off at a right
       angle. Beyond it the factor stays: frames back to back do not lean, so the surface does not jump as they turn past. */
    double lower = kiriMax(1.0 + kiriVec3_Dot(carrier->d, other), 1.0), x = (2.0 - lower) / lower;
    double k = -(1.0 + x) * (15.0 + 4.0 * x) / (15.0 + 9.0 * x);
    return kiriVec2_Make(k * kiriVec3_Dot(carrier->u, other), k * kiriVec3_Dot(carrier->v, other));
}

/* The patch is bent less where it would turn too far: there are creases, narrow bridges, and neighbors on both sides of a
   slit that bend apart, so neighbors do not tell how the region bends. */
static void BendCarrier(kiriCarrier* carrier, const kiriBend* bend, const kiriFrameData* frame)
{
    const double mostTurn = 0.2; /* rad, rms over the region: on an arc that is 40 degrees from frame to frame */
    double square = kiriVec3_Length(kiriVec3_Cross(carrier->u, carrier->v));
    /* A patch that is nearly a line, or is stretched 1e12 times, stays flat: floats cannot hold `six`. */
    if (square > 1e-24 && square < 1e24) {
        kiriTensor turn = kiriTensor_Solve(bend->matrix, bend->turnBy);
        carrier->six = 6.0 / square;
        carrier->uu = turn.uu / square;
        carrier->uv = turn.uv / square;
        carrier->vv = turn.vv / square;
    }
    double uu = carrier->uu, uv = carrier->uv, vv = carrier->vv;
    const double* moments = frame->inertia;
    double squareTurn = (uu * uu + uv * uv) * moments[0] + 2.0 * uv * (uu + vv) * moments[1] +
                        (uv * uv + vv * vv) * moments[2];
    double turn =
        frame->mass > 0.0 && squareTurn > 0.0 ? sqrt(6.0 * squareTurn / (carrier->six * frame->mass)) : 0.0;
    if (turn > mostTurn) {
        carrier->uu *= mostTurn / turn;
        carrier->uv *= mostTurn / turn;
        carrier->vv *= mostTurn / turn;
    }
}

/* Stretches a patch about the site of its frame as its neighbors lie farther than at rest; at most so far that it cannot
   turn over. Towards a free border it does not stretch, by a weight of 100: nothing pulls there, and the frame of a strip
   that hangs is as far down as its end should be. */
static void StretchCarrier(kiriCarrier* carrier, const kiriBend* bend, const kiriFrameData* frame)
{
    const double most = 0.9, free = 100.0;
    const kiriTensor* links = &bend->matrix;
    kiriVec2 s = kiriVec2_Scale(sqrt(free * (links->uu + links->vv)) / bend->width, bend->open);
    const kiriTensor matrix = { links->uu + s.x * s.x, links->uv + s.x * s.y, links->vv + s.y * s.y };
    kiriTensor by = kiriTensor_Solve(matrix, bend->longerBy);
    double size = sqrt(by.uu * by.uu + 2.0 * by.uv * by.uv + by.vv * by.vv), part = size > most ? most / size : 1.0;
    kiriVec3 u = carrier->u, v = carrier->v;
    kiriVec2 off = kiriVec2_Scale(part, kiriVec2_Sub(carrier->center, frame->site.at));
    carrier->u = kiriVec3_AddScaled(kiriVec3_AddScaled(u, part * by.uu, u), part * by.uv, v);
    carrier->v = kiriVec3_AddScaled(kiriVec3_AddScaled(v, part * by.uv, u), part * by.vv, v);
    carrier->x = kiriVec3_AddScaled(carrier->x, by.uu * off.x + by.uv * off.y, u);
    carrier->x = kiriVec3_AddScaled(carrier->x, by.uv * off.x + by.vv * off.y, v);
}

/* A thousandth of the sum of squares is added: it chooses the least tensor where neighbors in a row leave it open, and
   limits how far it follows the noise across the row. */
void kiriCarriers_Fit(kiriCarrier* carriers, kiriBend* bends, const kiriFrameData* frames, int32_t count,
                      const kiriPulls* pulls, const kiriIndices* some, const kiriIndices* someLinks)
{
    KIRI_TIMES(n, ItemCount(some, count)) {
        bends[SampleAt(some, n)] = (kiriBend){ 0 };
    }
    int32_t linkCount = kiriLink_CountBorders(pulls->links, pulls->count); /* a patch does not bend over a fold */
    KIRI_TIMES(n, ItemCount(someLinks, linkCount)) {
        if (SampleAt(someLinks, n) >= linkCount) {
            continue; /* the links of the next piece follow */
        }
        const kiriLink* link = &pulls->links[SampleAt(someLinks, n)];
        KIRI_ASSERT(link->i >= 0 && link->i < count && link->j >= 0 && link->j < count);
        const kiriFrameData *i = &frames[link->i], *j = &frames[link->j];
        const kiriCarrier *patch = &carriers[link->i], *next = &carriers[link->j];
        kiriVec2 start = kiriVec2_Sub(i->site.at, i->center), end = kiriVec2_Sub(j->center, j->site.at);
        kiriVec2 s = kiriVec2_Add(kiriVec2_Add(start, link->span), end), longer = { 0 }; /* from center to center */
        /* Tension alone: with pressure and shear, cloths on obstacles come to rest later. It fades in folds, where the way
           from site to site is not in one plane. */
        if (pulls->areRigid) {
            double strain[KIRI_STRAINS], fold = 2.0 * (1.0 - kiriVec3_Dot(patch->d, next->d));
            kiriStrain_MeasureLink(link, pulls->material, i, j, 0.0, strain);
            double tension = kiriMax(strain[KIRI_STRETCH], 0.0) / (link->length * (1.0 + fold * fold));
            longer = kiriVec2_Scale(tension * kiriVec2_Length(s), link->normal);
        }
        const kiriVec2 turns[2] = { TurnOf(patch, next->d), kiriVec2_Scale(-1.0, TurnOf(next, patch->d)) };
        KIRI_TIMES(k, 2) {
            kiriBend* bend = &bends[k == 0 ? link->i : link->j];
            kiriVec2 ws = kiriVec2_Scale(link->width, s);
            bend->matrix.uu += ws.x * s.x;
            bend->matrix.uv += ws.x * s.y;
            bend->matrix.vv += ws.y * s.y;
            bend->turnBy[0] = kiriVec2_AddScaled(bend->turnBy[0], turns[k].x, ws);
            bend->turnBy[1] = kiriVec2_AddScaled(bend->turnBy[1], turns[k].y, ws);
            bend->longerBy[0] = kiriVec2_AddScaled(bend->longerBy[0], longer.x, ws);
            bend->longerBy[1] = kiriVec2_AddScaled(bend->longerBy[1], longer.y, ws);
            bend->width += link->width;
            bend->open = kiriVec2_AddScaled(bend->open, k == 0 ? -link->width : link->width, link->normal);
        }
    }
    KIRI_TIMES(n, ItemCount(some, count)) {
        int32_t i = SampleAt(some, n);
        kiriTensor* matrix = &bends[i].matrix;
        double least = 1e-3 * (matrix->uu + matrix->vv);
        if (least > 0.0) {
            matrix->uu += least;
            matrix->vv += least;
            BendCarrier(&carriers[i], &bends[i], &frames[i]);
            StretchCarrier(&carriers[i], &bends[i], &frames[i]);
        }
    }
}

/* ---- Rows of floats ---------------------------------------------------------------------------------------------- */

bool kiriPatches_Reserve(kiriPatches* patches, kiriMemory* memory, int32_t count)
{
    return kiriArray_Reserve(memory, &patches->floats, (int64_t)KIRI_BENT_FLOATS * count) &&
           kiriArray_Reserve(memory, &patches->isOther, count);
}

void kiriPatches_Forget(kiriPatches* patches)
{
    patches->count = 0;
}

/* Writes a row. Flat: the point where the patch has the local origin; u; v. Bent: center, curvature in two parts, twice six;
   x; u; v; six d. Each vector has a fourth float, 0. */
static void WritePatchRow(float* row, const kiriCarrier* carrier, kiriVec3 from, bool isBent)
{
    kiriVec3 vectors[4] = { kiriVec3_Sub(carrier->x, from), carrier->u, carrier->v, kiriVec3_Scale(6.0, carrier->d) };
    if (isBent) {
        const double first[8] = { carrier->center.x, carrier->center.y, carrier->uu,        carrier->vv,
                                  carrier->uv,       carrier->uv,       2.0 * carrier->six, 2.0 * carrier->six };
        KIRI_TIMES(k, 8) {
            *row++ = (float)first[k];
        }
    } else {
        vectors[0] = kiriVec3_AddScaled(vectors[0], -carrier->center.x, carrier->u);
        vectors[0] = kiriVec3_AddScaled(vectors[0], -carrier->center.y, carrier->v);
    }
    KIRI_TIMES(k, isBent ? 4 : 3) {
        kiriVec3_Store(row + 4 * k, vectors[k]);
        row[4 * k + 3] = 0.0f;
    }
}

/* Compares a row with its previous values. A frame that gets another center carries the same flat patch, but for the last
   bits of its doubles. They show only in floats near 0. */
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

bool kiriPatches_Write(kiriPatches* patches, const kiriCarrier* carriers, int32_t count, kiriVec3 from, bool isBent,
                       const kiriIndices* some)
{
    size_t each = isBent ? KIRI_BENT_FLOATS : KIRI_FLAT_FLOATS;
    int32_t known = patches->isBent == isBent ? patches->count : 0;
    KIRI_ASSERT(some == NULL || known == count);
    patches->areOther = patches->count != count;
    patches->count = patches->isOther.count = count;
    patches->isBent = isBent;
    patches->floats.count = (int32_t)each * count;
    KIRI_ASSERT(patches->floats.count <= patches->floats.capacity && count <= patches->isOther.capacity);
    kiriArray_Set(&patches->isOther, KIRI_PATCH_SAME);
    KIRI_TIMES(n, ItemCount(some, count)) {
        int32_t i = SampleAt(some, n);
        float row[KIRI_BENT_FLOATS], *was = patches->floats.data + each * i;
        KIRI_ASSERT(i >= 0 && i < count);
        WritePatchRow(row, &carriers[i], from, isBent);
        patches->isOther.data[i] = i >= known ? KIRI_PATCH_OTHER : ChangeOfRow(was, row, each);
        patches->areOther |= patches->isOther.data[i] != KIRI_PATCH_SAME;
        memcpy(was, row, sizeof(float) * each);
    }
    return patches->areOther;
}

bool kiriPatches_MayMove(const kiriPatches* patches, const kiriSkin* skin, int32_t begin, int32_t end)
{
    bool mayMove = false;
    KIRI_FROM_TO_WHILE(patches->areOther && !mayMove, s, begin, end) {
        const kiriSampleWeight* weight = skin->weights.data + skin->spans.data[s].first;
        const kiriSampleWeight* last = weight + skin->spans.data[s].count;
        for (; weight < last; ++weight) {
            mayMove |= patches->isOther.data[weight->frame];
        }
    }
    return mayMove;
}

/* ---- Positions --------------------------------------------------------------------------------------------------- */

/* at = x + a u + b v + bow d. a and b are lanes of `flat`. */
#define CARRY_BENT(row, flat, a, b, bow, at)                                                                           \
    do {                                                                                                               \
        (at) = kiriLanes_Add(kiriLanes_Load((row) + 8),                                                                \
                             kiriLanes_Mul(kiriLanes_Pick(flat, a, a, a, a), kiriLanes_Load((row) + 12)));             \
        (at) = kiriLanes_Add(at, kiriLanes_Mul(kiriLanes_Pick(flat, b, b, b, b), kiriLanes_Load((row) + 16)));         \
        (at) = kiriLanes_Add(at, kiriLanes_Mul(kiriLanes_Pick(bow, a, a, a, a), kiriLanes_Load((row) + 20)));          \
    } while (0)

/* Adds two frames at a time. With q = p - center and g = K q the lanes hold q, g, then q . g and g . g, then q - bow g;
   `half` is half of bow. sin f / f and (1 - cos f) / f^2 are fractions over 12 + f^2: one thousandth off at 40 degrees,
   and at any curvature at most twice as far from the center as q. */
static kiriLanes AddBent(kiriLanes sum, const float* rows, kiriSampleWeight first, kiriSampleWeight second, kiriLanes p)
{
    const float* a = rows + KIRI_BENT_FLOATS * first.frame;
    const float* b = rows + KIRI_BENT_FLOATS * second.frame;
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

/* If the number is odd, the last has a partner of weight 0. */
static kiriLanes BlendBent(const float* rows, const kiriSampleWeight* weight, const kiriSampleWeight* end, kiriVec2 p)
{
    float x = (float)p.x, y = (float)p.y;
    kiriLanes at = kiriLanes_Four(x, y, x, y), sum = kiriLanes_Splat(0.0f);
    for (; weight + 1 < end; weight += 2) {
        sum = AddBent(sum, rows, weight[0], weight[1], at);
    }
    if (weight < end) {
        sum = AddBent(sum, rows, *weight, (kiriSampleWeight){ weight->frame, 0.0f }, at);
    }
    return sum;
}

/* Two loops, for speed. */
void kiriSkin_WritePositions(const kiriSkin* skin, const kiriPatches* patches, const kiriVec2* rest, int32_t begin,
                             int32_t end, float* positions)
{
    const float* rows = patches->floats.data;
    KIRI_FROM_TO_WHILE(!patches->isBent, v, begin, end) {
        const kiriSampleWeight* weight = skin->weights.data + skin->spans.data[v].first;
        const kiriSampleWeight* last = weight + skin->spans.data[v].count;
        kiriLanes px = kiriLanes_Splat((float)rest[v].x), py = kiriLanes_Splat((float)rest[v].y);
        kiriLanes sum = kiriLanes_Splat(0.0f);
        for (; weight < last; ++weight) {
            const float* row = rows + KIRI_FLAT_FLOATS * weight->frame;
            kiriLanes at = kiriLanes_Add(kiriLanes_Load(row), kiriLanes_Mul(px, kiriLanes_Load(row + 4)));
            at = kiriLanes_Add(at, kiriLanes_Mul(py, kiriLanes_Load(row + 8)));
            sum = kiriLanes_Add(sum, kiriLanes_Mul(kiriLanes_Splat(weight->value), at));
        }
        kiriLanes_StoreThree(positions + 3 * v, sum);
    }
    KIRI_FROM_TO_WHILE(patches->isBent, v, begin, end) {
        const kiriSampleWeight* first = skin->weights.data + skin->spans.data[v].first;
        kiriLanes at = BlendBent(rows, first, first + skin->spans.data[v].count, rest[v]);
        kiriLanes_StoreThree(positions + 3 * v, at);
    }
}

/* ---- Two triangles ----------------------------------------------------------------------------------------------- */

/* Orders of the six corners of two triangles: as they are; if edge j of the first is edge k of the second, turned, at
   1 + 3 j + k; a triangle alone, followed by one without area. */
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
    KIRI_TIMES_WHILE(turn == PAIR_AS_IS, i, 9) {
        int j = i / 3, k = i % 3;
        bool isShared = a[j] == b[(k + 1) % 3] && a[(j + 1) % 3] == b[k];
        turn = isShared ? PAIR_TURNED + i : turn;
    }
    return (uint8_t)turn;
}

/* ---- Sums -------------------------------------------------------------------------------------------------------- */

static kiriLanes EdgeAlong(const float* x, int32_t from, int32_t to)
{
    return kiriLanes_Sub(kiriLanes_Load(x + 3 * to), kiriLanes_Load(x + 3 * from));
}

/* A slope that a vertex gets from a pair of triangles. */
typedef struct PairSlope {
    int32_t vertex;
    kiriLanes slope;
} PairSlope;

/* Writes the slopes of a pair. Returns their number. The cross product of two sides is twice the area times the normal:
   sums are area-weighted. If the triangles share an edge, its corners get one sum from both. */
static inline int GetPairSlopes(const kiriCorners* corners, int32_t pair, const float* positions, PairSlope slopes[6])
{
    const int32_t* indices = corners->indices + 6 * pair;
    const uint8_t* order = pairOrders[corners->turns[pair]];
    int32_t v[6];
    KIRI_TIMES(i, 6) {
        v[i] = indices[order[i]];
    }
    kiriLanes ac = EdgeAlong(positions, v[0], v[2]), first = kiriLanes_Cross(EdgeAlong(positions, v[0], v[1]), ac);
    slopes[0] = (PairSlope){ v[1], first };
    if (v[0] == v[3] && v[2] == v[4]) {
        kiriLanes second = kiriLanes_Cross(ac, EdgeAlong(positions, v[0], v[5])), both = kiriLanes_Add(first, second);
        slopes[1] = (PairSlope){ v[5], second };
        slopes[2] = (PairSlope){ v[0], both };
        slopes[3] = (PairSlope){ v[2], both };
        return 4;
    }
    kiriLanes second = kiriLanes_Cross(EdgeAlong(positions, v[3], v[4]), EdgeAlong(positions, v[3], v[5]));
    slopes[1] = (PairSlope){ v[0], first };
    slopes[2] = (PairSlope){ v[2], first };
    KIRI_FROM_TO(k, 3, 6) {
        slopes[k] = (PairSlope){ v[k], second };
    }
    return 6;
}

void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners)
{
    memset(slopes, 0, 4 * sizeof(float) * vertexCount);
    for (int32_t pair = 0; 2 * pair < corners->triangleCount; ++pair) {
        PairSlope of[6];
        int count = GetPairSlopes(corners, pair, positions, of);
        KIRI_TIMES(k, count) {
            float* sum = slopes + 4 * of[k].vertex;
            KIRI_ASSERT(of[k].vertex >= 0 && of[k].vertex < vertexCount);
            kiriLanes_Store(sum, kiriLanes_Add(kiriLanes_Load(sum), of[k].slope));
        }
    }
}

bool kiriNormals_SumOne(float* slopes, int32_t vertex, const float* positions, const kiriCorners* corners,
                        const kiriMeshData* mesh)
{
    enum { MOST_PAIRS = 64 };
    int32_t pairs[MOST_PAIRS], count = 0, edge = mesh->vertices.data[vertex].edge, first = edge;
    kiriLanes sum = kiriLanes_Splat(0.0f);
    KIRI_ASSERT_HAS(mesh->vertices, vertex);
    for (int32_t h = edge; h != KIRI_NONE;) {
        first = h;
        h = kiriMesh_Clockwise(mesh, h);
        h = h == edge ? KIRI_NONE : h;
    }
    /* The pairs of the fan, in ascending order, each once. */
    for (int32_t h = first; h != KIRI_NONE;) {
        int32_t pair = h / 6, at = count;
        while (at > 0 && pairs[at - 1] > pair) {
            --at;
        }
        if (at == 0 || pairs[at - 1] != pair) {
            if (count == MOST_PAIRS) {
                return false;
            }
            memmove(pairs + at + 1, pairs + at, sizeof(*pairs) * (count - at));
            pairs[at] = pair;
            ++count;
        }
        h = kiriMesh_CounterClockwise(mesh, h);
        h = h == first ? KIRI_NONE : h;
    }
    KIRI_TIMES(k, count) {
        PairSlope of[6];
        int slopeCount = GetPairSlopes(corners, pairs[k], positions, of);
        KIRI_TIMES(i, slopeCount) {
            sum = of[i].vertex == vertex ? kiriLanes_Add(sum, of[i].slope) : sum;
        }
    }
    kiriLanes_Store(slopes + 4 * vertex, sum);
    return true;
}

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

static void WriteFourNormals(float* normals, const float* slopes)
{
    float square[4], scale[4];
    kiriLanes a = kiriLanes_Load(slopes), b = kiriLanes_Load(slopes + 4);
    kiriLanes c = kiriLanes_Load(slopes + 8), d = kiriLanes_Load(slopes + 12);
    /* Lanes of x, y and z give four squared lengths at once. */
    kiriLanes abxy = kiriLanes_Join(a, 0, 1, b, 0, 1), cdxy = kiriLanes_Join(c, 0, 1, d, 0, 1);
    kiriLanes x = kiriLanes_Join(abxy, 0, 2, cdxy, 0, 2), y = kiriLanes_Join(abxy, 1, 3, cdxy, 1, 3);
    kiriLanes z = kiriLanes_Join(kiriLanes_Join(a, 2, 2, b, 2, 2), 0, 2, kiriLanes_Join(c, 2, 2, d, 2, 2), 0, 2);
    kiriLanes squares = kiriLanes_Add(kiriLanes_Mul(x, x), kiriLanes_Mul(y, y));
    squares = kiriLanes_Add(squares, kiriLanes_Mul(z, z));
    kiriLanes_Store(square, squares);
    kiriLanes_Store(scale, kiriLanes_Div(kiriLanes_Splat(1.0f), kiriLanes_Sqrt(squares)));
    KIRI_TIMES(k, 4) {
        if (square[k] > 1e-30f && square[k] < 1e30f) {
            kiriLanes unit = kiriLanes_Mul(kiriLanes_Splat(scale[k]), kiriLanes_Load(slopes + 4 * k));
            kiriLanes_StoreThree(normals + 3 * k, unit);
        } else { /* a length that fits a float may have a square that does not */
            kiriVec3 unit = kiriVec3_Normalize(kiriVec3_Load(slopes + 4 * k));
            bool isKnown = kiriVec3_Dot(unit, unit) > 0.0;
            kiriVec3_Store(normals + 3 * k, isKnown ? unit : kiriVec3_Make(0.0, 0.0, 1.0));
        }
    }
}

/* The last are written by fours, too, so that ranges do not change a bit. */
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end)
{
    int32_t v = begin;
    for (; v + 4 <= end; v += 4) {
        WriteFourNormals(normals + 3 * v, slopes + 4 * v);
    }
    float last[16] = { 0.0f }, written[12];
    if (v < end) {
        memcpy(last, slopes + 4 * v, 4 * sizeof(float) * (end - v));
        WriteFourNormals(written, last);
        memcpy(normals + 3 * v, written, 3 * sizeof(float) * (end - v));
    }
}
