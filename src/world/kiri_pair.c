#include "kiri_pair_work.h"

#include "../core/kiri_sort.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_probe.h"
#include "kiri_nearest.h"

#include <string.h>

#define LEVEL 0.2  /* of the direction from the lower to the upper one: less than that along gravity is level */
#define TURNED 0.5 /* more than that against gravity: the lower one has become the upper one */
#define FLAT 0.1   /* of the distance that they keep: nearer than that motion says which side it is */

/* ---- Bodies ---- */

static void SumFrames(kiriPairs* pairs, const kiriSheetData* sheet, int32_t firstBody)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        kiriBody* body = &pairs->bodies.data[firstBody + sheet->layout.framePiece.data[i]];
        body->isHeld |= frame->held != 0;
        body->isCarried |= kiriVec3_Dot(frame->support, frame->support) > 0.0;
        body->mass += frame->mass;
        body->momentum = kiriVec3_AddScaled(body->momentum, frame->mass, frame->velocity);
    }
    for (int32_t i = 0; i < sheet->layout.pinFrame.count; ++i) {
        int32_t piece = sheet->layout.framePiece.data[sheet->layout.pinFrame.data[i]];
        pairs->bodies.data[firstBody + piece].isHeld = true;
    }
}

/* How fast the fastest probe of each body is beside its mean velocity. */
static void MeasureStir(kiriPairs* pairs, const kiriSheetData* sheet, int32_t firstBody)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriBody* body = &pairs->bodies.data[firstBody + p];
        kiriSpan span = kiriPieceRow_Of(&sheet->probes.list, p);
        double most = 0.0;
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            kiriVec3 beside = kiriVec3_AddScaled(sheet->probes.velocities.data[i], -1.0 / body->mass, body->momentum);
            double squared = kiriVec3_Dot(beside, beside);
            most = kiriMax(squared, most);
        }
        body->stir = sqrt(most);
    }
}

static bool ListBodiesOf(kiriWorld* world, kiriSheetData* sheet)
{
    kiriPairs* pairs = &world->pairs;
    int32_t first = pairs->bodies.count, count = sheet->layout.pieces.count;
    sheet->probes.firstBody = first;
    if (!kiriArray_Resize(&world->memory, &pairs->bodies, (int64_t)first + count)) {
        return false;
    }
    for (int32_t p = 0; p < count; ++p) {
        kiriBody body;
        memset(&body, 0, sizeof(body));
        body.sheet = sheet;
        body.piece = p;
        body.id = sheet->frames.data[sheet->layout.pieces.data[p].frame].id;
        body.box = sheet->probes.boxes.data[p];
        body.speed = sheet->probes.speeds.data[p];
        body.asleep = !kiriPiece_IsAwake(&sheet->layout.pieces.data[p]);
        pairs->bodies.data[first + p] = body;
    }
    SumFrames(pairs, sheet, first);
    MeasureStir(pairs, sheet, first);
    return true;
}

/* What is awake: around all of it, and its fastest and thickest. */
typedef struct Waking {
    kiriBox box;
    double speed, thickness;
    bool any;
} Waking;

static double FastestOf(const kiriSheetData* sheet)
{
    double fastest = 0.0;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        fastest = kiriMax(sheet->probes.speeds.data[p], fastest);
    }
    return fastest;
}

static void AddWaking(Waking* waking, const kiriSheetData* sheet)
{
    double speed = FastestOf(sheet), thickness = sheet->settings.contactThickness;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        const kiriBox* box = &sheet->probes.boxes.data[p];
        if (kiriPiece_IsAwake(&sheet->layout.pieces.data[p])) {
            waking->box = waking->any ? waking->box : *box;
            kiriBox_Add(&waking->box, box->lower);
            kiriBox_Add(&waking->box, box->upper);
            waking->any = true;
        }
    }
    waking->speed = kiriMax(speed, waking->speed);
    waking->thickness = kiriMax(thickness, waking->thickness);
}

/* False for memory. */
static bool FindWaking(kiriWorld* world, Waking* waking)
{
    bool ok = true;
    memset(waking, 0, sizeof(*waking));
    for (int32_t k = 0; ok && k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        if (kiriPair_TakesPart(sheet) && !sheet->rest.asleep) {
            ok = kiriProbes_Update(sheet);
            if (ok) {
                AddWaking(waking, sheet);
            }
        }
    }
    return ok;
}

/* Are there two bodies at least? Of a single one nobody keeps up its probes. */
static bool AreSeveral(const kiriWorld* world)
{
    kiriSheetData* last = NULL;
    int32_t count = 0;
    for (int32_t i = 0; i < world->sheets.count && count < 2; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        count += kiriPair_TakesPart(sheet) ? sheet->layout.pieces.count : 0;
        last = kiriPair_TakesPart(sheet) ? sheet : last;
    }
    if (count == 1) {
        last->probes.isFresh = false;
    }
    return count > 1;
}

/* May anything that is awake come near the sheet in the tick? What sleeps and is farther away is no body. */
static bool IsNearWaking(const kiriWorld* world, const Waking* waking, const kiriSheetData* sheet, double dt)
{
    kiriBox box = kiriSheet_Box(sheet);
    double speed = waking->speed + FastestOf(sheet) + dt * kiriVec3_Length(world->gravity);
    return kiriBox_MeetWithin(&box, &waking->box, waking->thickness + sheet->settings.contactThickness + dt * speed);
}

static bool ListBodies(kiriWorld* world, const Waking* waking, double dt)
{
    bool ok = true;
    for (int32_t i = 0; ok && i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        if (!kiriPair_TakesPart(sheet)) {
            continue;
        }
        ok = !sheet->rest.asleep ||
             (kiriProbes_Update(sheet) && kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface));
        if (ok && (!sheet->rest.asleep || IsNearWaking(world, waking, sheet, dt))) {
            ok = ListBodiesOf(world, sheet);
        }
    }
    return ok;
}

/* ---- Where they are near ---- */

double kiriPair_Distance(const kiriBody* a, const kiriBody* b)
{
    return 0.5 * (a->sheet->settings.contactThickness + b->sheet->settings.contactThickness);
}

/* As far as they may come nearer in the tick, by the velocities of their probes and by gravity, and twice the distance
   that they keep. Pieces of one sheet that fall side by side do not come nearer, unless an obstacle stops one. */
static double ReachOfPiece(const kiriWorld* world, const kiriBody* a, const kiriBody* b, double dt)
{
    double speed = a->speed + b->speed, falling = dt * kiriVec3_Length(world->gravity);
    if (a->sheet == b->sheet && world->obstacles.count == 0) {
        kiriVec3 apart = kiriVec3_Scale(1.0 / a->mass, a->momentum);
        apart = kiriVec3_AddScaled(apart, -1.0 / b->mass, b->momentum);
        speed = kiriVec3_Length(apart) + a->stir + b->stir;
    }
    return 2.0 * kiriPair_Distance(a, b) + dt * (speed + falling);
}

static kiriBox Widened(const kiriBox* box, double by)
{
    kiriVec3 all = kiriVec3_Make(by, by, by);
    kiriBox wide = { kiriVec3_Sub(box->lower, all), kiriVec3_Add(box->upper, all) };
    return wide;
}

static bool Holds(const kiriBox* box, kiriVec3 x)
{
    kiriBox point = { x, x };
    return kiriBox_Meet(box, &point);
}

/* What the probes of one body find on another. */
static bool FindNears(kiriWorld* world, int32_t body, int32_t other, double reach)
{
    kiriPairs* pairs = &world->pairs;
    const kiriBody *a = &pairs->bodies.data[body], *b = &pairs->bodies.data[other];
    kiriSpan probes = kiriPieceRow_Of(&a->sheet->probes.list, a->piece);
    kiriBox box = Widened(&b->box, reach);
    bool ok = true;
    for (int32_t i = probes.first; ok && i < probes.first + probes.count; ++i) {
        kiriNear near = {
            body, other, a->sheet->probes.list.items.data[i], KIRI_NONE, { 0.0 }, { 0.0, 0.0, 0.0 }, 0.0
        };
        kiriVec3 x = kiriSurface_At(&a->sheet->seen.surface, near.vertex);
        if (!Holds(&box, x)) {
            continue;
        }
        if (kiriNearest_Find(&near, pairs->bodies.data, reach, kiriPair_Distance(a, b))) {
            ok = kiriArray_Push(&world->memory, &pairs->nears, near);
        }
    }
    return ok;
}

/* ---- Which is where ---- */

kiriVec3 kiriNear_PlaceVelocity(const kiriPairs* pairs, const kiriNear* near)
{
    const kiriSheetData* sheet = pairs->bodies.data[near->other].sheet;
    const int32_t* corners = &sheet->seen.surface.indices.data[3 * (size_t)near->triangle];
    kiriVec3 velocity = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3; ++k) {
        velocity = kiriVec3_AddScaled(velocity, near->share[k], kiriProbe_Velocity(sheet, corners[k]));
    }
    return velocity;
}

/* How far the probe is above the place, along the normal of that; where they are at the same height, how fast it gets
   there. */
static double Above(const kiriPairs* pairs, const kiriNear* near, double dt)
{
    const kiriBody *a = &pairs->bodies.data[near->body], *b = &pairs->bodies.data[near->other];
    if (fabs(near->height) >= FLAT * kiriPair_Distance(a, b)) {
        return near->height;
    }
    kiriVec3 v = kiriVec3_Sub(kiriProbe_Velocity(a->sheet, near->vertex), kiriNear_PlaceVelocity(pairs, near));
    return near->height + dt * kiriVec3_Dot(near->normal, v);
}

/* From body b to body a, by what is near. */
static kiriVec3 DirectionFrom(const kiriPairs* pairs, kiriSpan nears, int32_t a, double dt)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = nears.first; i < nears.first + nears.count; ++i) {
        const kiriNear* near = &pairs->nears.data[i];
        double above = Above(pairs, near, dt);
        sum = kiriVec3_AddScaled(sum, near->body == a ? above : -above, near->normal);
    }
    return kiriVec3_Normalize(sum);
}

static kiriVec3 NormalAt(const kiriSheetData* sheet, int32_t vertex)
{
    return kiriVec3_Load(&sheet->seen.surface.normals.data[3 * (size_t)vertex]);
}

/* On which side of the lower one's normals the upper one is. */
static int32_t SideOfPair(const kiriPairs* pairs, kiriSpan nears, int32_t lower, double dt)
{
    const kiriSheetData* sheet = pairs->bodies.data[lower].sheet;
    double sum = 0.0;
    for (int32_t i = nears.first; i < nears.first + nears.count; ++i) {
        const kiriNear* near = &pairs->nears.data[i];
        double above = Above(pairs, near, dt);
        sum += near->body == lower ? -above * kiriVec3_Dot(near->normal, NormalAt(sheet, near->vertex)) : above;
    }
    return sum >= 0.0 ? 1 : -1;
}

/* Which lies above which against gravity; side by side the one that is not held, or the lighter one, is the upper one,
   for it gives way. */
static bool IsUpper(const kiriWorld* world, const kiriBody* a, const kiriBody* b, kiriVec3 direction)
{
    double up = -kiriVec3_Dot(direction, kiriVec3_Normalize(world->gravity));
    if (fabs(up) > LEVEL) {
        return up > 0.0;
    }
    if (a->isHeld != b->isHeld) {
        return b->isHeld;
    }
    return a->mass < b->mass || (a->mass == b->mass && a->id < b->id);
}

static uint64_t NameOf(kiriFrame a, kiriFrame b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

/* The pair of two bodies in the last tick, or null. */
static const kiriTouchingPair* FindOld(const kiriPairs* pairs, kiriFrame a, kiriFrame b)
{
    uint64_t name = NameOf(a, b);
    int32_t low;
    KIRI_SEARCH(low, 0, pairs->pairs.count,
                NameOf(pairs->pairs.data[middle].upper, pairs->pairs.data[middle].lower) < name);
    const kiriTouchingPair* found = &pairs->pairs.data[low];
    return low < pairs->pairs.count && NameOf(found->upper, found->lower) == name ? found : NULL;
}

/* Has the lower one of before come to be the upper one? By how it is turned, and not by where the other one is: pieces
   that cross do not change places. */
static bool HasSideTurned(const kiriWorld* world, const kiriTouchingPair* old, int32_t lower, kiriSpan nears)
{
    const kiriSheetData* sheet = world->pairs.bodies.data[lower].sheet;
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t i = nears.first; i < nears.first + nears.count; ++i) {
        const kiriNear* near = &world->pairs.nears.data[i];
        sum = kiriVec3_Add(sum, near->body == lower ? NormalAt(sheet, near->vertex) : near->normal);
    }
    kiriVec3 up = kiriVec3_Scale(old->side, kiriVec3_Normalize(sum));
    return kiriVec3_Dot(up, kiriVec3_Normalize(world->gravity)) > TURNED;
}

static kiriTouchingPair Decide(const kiriWorld* world, int32_t a, int32_t b, kiriSpan nears, double dt)
{
    const kiriPairs* pairs = &world->pairs;
    const kiriBody *one = &pairs->bodies.data[a], *other = &pairs->bodies.data[b];
    const kiriTouchingPair* old = FindOld(pairs, one->id, other->id);
    if (old != NULL && HasSideTurned(world, old, old->upper == one->id ? b : a, nears)) {
        old = NULL;
    }
    bool isUpper = old != NULL ? old->upper == one->id : IsUpper(world, one, other, DirectionFrom(pairs, nears, a, dt));
    int32_t upper = isUpper ? a : b, lower = isUpper ? b : a;
    int32_t side = old != NULL ? old->side : SideOfPair(pairs, nears, lower, dt);
    kiriTouchingPair pair = {
        pairs->bodies.data[upper].id, pairs->bodies.data[lower].id, side, 0, { upper, lower }, nears
    };
    return pair;
}

/* ---- Pairs ---- */

/* Boxes that fit, and know their pieces, unless either was made anew since. */
static bool UpdateBounds(kiriSheetData* sheet)
{
    kiriBounds* bounds = sheet->seen.bounds;
    const kiriSurface* surface = &sheet->seen.surface;
    bool ok = kiriBounds_Update(bounds, sheet->memory, surface);
    if (ok && !(sheet->probes.areGrouped && bounds->groups.count == bounds->nodes.count)) {
        ok = kiriBounds_Group(bounds, sheet->memory, surface, sheet->probes.vertexPiece.data,
                              sheet->layout.pieces.count);
    }
    sheet->probes.areGrouped = ok;
    return ok;
}

/* A piece that is gone touches nothing. */
static bool IsGone(const kiriBody* body)
{
    return body->sheet->layout.pieces.data[body->piece].isGone;
}

static bool LookAtPair(kiriWorld* world, int32_t a, int32_t b, double dt)
{
    kiriPairs* pairs = &world->pairs;
    const kiriBody *one = &pairs->bodies.data[a], *other = &pairs->bodies.data[b];
    double reach = ReachOfPiece(world, one, other, dt);
    kiriBox wide = Widened(&one->box, reach);
    kiriSpan nears = { pairs->nears.count, 0 };
    if ((one->asleep && other->asleep) || IsGone(one) || IsGone(other) || !kiriBox_Meet(&wide, &other->box) ||
        (one->sheet->settings.groups & other->sheet->settings.groups) == 0) {
        return true;
    }
    if (!UpdateBounds(one->sheet) || !UpdateBounds(other->sheet) || !FindNears(world, a, b, reach) ||
        !FindNears(world, b, a, reach)) {
        return false;
    }
    nears.count = pairs->nears.count - nears.first;
    if (nears.count == 0) {
        return true;
    }
    kiriSurface_NeedNormals(&one->sheet->seen.surface);
    kiriSurface_NeedNormals(&other->sheet->seen.surface);
    kiriTouchingPair pair = Decide(world, a, b, nears, dt);
    return kiriArray_Push(&world->memory, &pairs->found, pair);
}

static bool IsFarther(const void* context, int32_t a, int32_t b)
{
    const kiriBody* bodies = context;
    double left = bodies[a].box.lower.x, right = bodies[b].box.lower.x;
    return left < right || (left == right && a < b);
}

/* Bodies by the lower end of their box: those that begin beyond the end of another are not near it. */
static bool LookAtAll(kiriWorld* world, double dt)
{
    kiriPairs* pairs = &world->pairs;
    double fastest = 0.0, thickest = 0.0;
    if (!kiriArray_Resize(&world->memory, &pairs->order, pairs->bodies.count)) {
        return false;
    }
    for (int32_t i = 0; i < pairs->bodies.count; ++i) {
        const kiriBody* body = &pairs->bodies.data[i];
        fastest = kiriMax(body->speed, fastest);
        thickest = kiriMax(kiriPair_Distance(body, body), thickest);
        pairs->order.data[i] = i;
    }
    double reach = 2.0 * thickest + dt * (2.0 * fastest + dt * kiriVec3_Length(world->gravity));
    kiriSort(pairs->order.data, pairs->order.count, IsFarther, pairs->bodies.data);
    for (int32_t i = 0; i < pairs->order.count; ++i) {
        int32_t a = pairs->order.data[i];
        double end = pairs->bodies.data[a].box.upper.x + reach;
        for (int32_t k = i + 1; k < pairs->order.count; ++k) {
            int32_t b = pairs->order.data[k];
            if (pairs->bodies.data[b].box.lower.x > end) {
                break;
            }
            if (!LookAtPair(world, kiriMin(a, b), kiriMax(b, a), dt)) {
                return false;
            }
        }
    }
    return true;
}

kiriPiece* kiriPair_PieceOf(const kiriWorld* world, kiriFrame id)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, id);
    return slot != NULL ? kiriSheet_PieceOf(slot->owner, slot->index) : NULL;
}

static bool IsPairAsleep(const kiriWorld* world, kiriFrame id)
{
    const kiriPiece* piece = kiriPair_PieceOf(world, id);
    return piece != NULL && piece->rest.asleep;
}

/* Pairs that sleep are not looked at, and stay. */
static bool KeepSleeping(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    bool ok = true;
    for (int32_t i = 0; ok && i < pairs->pairs.count; ++i) {
        kiriTouchingPair pair = pairs->pairs.data[i];
        pair.nears.count = 0;
        ok = !IsPairAsleep(world, pair.upper) || !IsPairAsleep(world, pair.lower) ||
             kiriArray_Push(&world->memory, &pairs->found, pair);
    }
    return ok;
}

static bool IsBefore(const void* context, int32_t a, int32_t b)
{
    const kiriTouchingPair* pairs = context;
    return NameOf(pairs[a].upper, pairs[a].lower) < NameOf(pairs[b].upper, pairs[b].lower);
}

static bool SortFound(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    if (!kiriArray_Resize(&world->memory, &pairs->order, pairs->found.count) ||
        !kiriArray_Resize(&world->memory, &pairs->next, pairs->found.count)) {
        return false;
    }
    for (int32_t i = 0; i < pairs->found.count; ++i) {
        pairs->order.data[i] = i;
    }
    kiriSort(pairs->order.data, pairs->order.count, IsBefore, pairs->found.data);
    for (int32_t i = 0; i < pairs->found.count; ++i) {
        pairs->next.data[i] = pairs->found.data[pairs->order.data[i]];
    }
    return true;
}

static bool LookForPairs(kiriWorld* world, double dt)
{
    Waking waking;
    return FindWaking(world, &waking) && (!waking.any || (ListBodies(world, &waking, dt) && LookAtAll(world, dt)));
}

bool kiriPairs_Find(kiriWorld* world, double dt)
{
    kiriPairs* pairs = &world->pairs;
    pairs->nears.count = pairs->found.count = pairs->next.count = pairs->bodies.count = 0;
    return (!AreSeveral(world) || LookForPairs(world, dt)) && KeepSleeping(world) && SortFound(world) &&
           kiriPairs_FindTouches(world, dt);
}

/* ---- Sleep ---- */

static void StirBody(const kiriWorld* world, kiriFrame id)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, id);
    kiriSheetData* sheet = slot->owner;
    kiriSheet_PieceOf(sheet, slot->index)->rest.isStirred = sheet->rest.isStirred = true;
}

static bool SleepsOn(const kiriWorld* world, kiriFrame id)
{
    return IsPairAsleep(world, id) && !kiriPair_PieceOf(world, id)->rest.isStirred;
}

static bool StirTouching(const kiriWorld* world, const kiriTouchingPairs* pairs)
{
    bool any = false;
    for (int32_t i = 0; i < pairs->count; ++i) {
        const kiriTouchingPair* pair = &pairs->data[i];
        bool isUpperAsleep = SleepsOn(world, pair->upper), isLowerAsleep = SleepsOn(world, pair->lower);
        if (pair->touches && isUpperAsleep != isLowerAsleep) {
            StirBody(world, isUpperAsleep ? pair->upper : pair->lower);
            any = true;
        }
    }
    return any;
}

bool kiriPairs_Stir(const kiriWorld* world)
{
    bool anyBefore = StirTouching(world, &world->pairs.pairs), anyNext = StirTouching(world, &world->pairs.next);
    return anyBefore || anyNext;
}

void kiriPairs_Commit(kiriWorld* world)
{
    kiriTouchingPairs old = world->pairs.pairs;
    world->pairs.pairs = world->pairs.next;
    world->pairs.next = old;
}

int32_t kiriPairs_CountAwake(const kiriWorld* world)
{
    int32_t count = 0;
    for (int32_t i = 0; i < world->pairs.pairs.count; ++i) {
        count += world->pairs.pairs.data[i].nears.count > 0;
    }
    return count;
}
