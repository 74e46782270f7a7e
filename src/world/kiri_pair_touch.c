#include "kiri_pair_work.h"

#include "../core/kiri_hash.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_probe.h"

#include <string.h>

#define ALONG 0.3  /* of a unit: surfaces more across each other than that do not lie on each other */
#define MARGIN 0.5 /* of the distance that they keep: what is nearer than that beyond it may touch */
#define ALIKE 0.9  /* of normals: their product */
#define CLOSE 0.1  /* the same: what is nearer touches */

static kiriPlace3 VertexPlace(kiriSheetData* sheet, int32_t vertex)
{
    kiriPlace3 place = { sheet, { vertex, KIRI_NONE, KIRI_NONE }, { 1.0, 0.0, 0.0 } };
    return place;
}

static kiriPlace3 TrianglePlace(kiriSheetData* sheet, int32_t triangle, const double share[3])
{
    kiriPlace3 place = { sheet, { KIRI_NONE, KIRI_NONE, KIRI_NONE }, { share[0], share[1], share[2] } };
    memcpy(place.vertex, &sheet->seen.surface.indices.data[3 * (size_t)triangle], sizeof(place.vertex));
    return place;
}

static kiriVec3 PlaceVelocity(const kiriPlace3* place)
{
    kiriVec3 velocity = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3 && place->vertex[k] != KIRI_NONE; ++k) {
        kiriVec3 v = kiriProbe_Velocity(place->sheet, place->vertex[k]);
        velocity = kiriVec3_AddScaled(velocity, place->share[k], v);
    }
    return velocity;
}

/* Of the pair, the probe, and whose it is: a probe meets a piece once. */
static uint64_t KeyOfPair(const kiriTouchingPair* pair, const kiriNear* near)
{
    const uint64_t kind = UINT64_C(3) << 60;
    uint64_t hash = KIRI_HASH_START;
    kiriHash_Word(&hash, pair->upper);
    kiriHash_Word(&hash, pair->lower);
    kiriHash_Word(&hash, near->body == pair->bodies[0]);
    kiriHash_Word(&hash, (uint64_t)near->vertex);
    return kind | hash >> 4;
}

/* A probe of the upper one above a triangle of the lower one. */
static bool TouchFromAbove(const kiriPairs* pairs, const kiriTouchingPair* pair, const kiriNear* near,
                           kiriPairTouch* touch)
{
    const kiriBody *upper = &pairs->bodies.data[near->body], *lower = &pairs->bodies.data[near->other];
    touch->upper = VertexPlace(upper->sheet, near->vertex);
    touch->lower = TrianglePlace(lower->sheet, near->triangle, near->share);
    touch->key = KeyOfPair(pair, near);
    touch->normal = kiriVec3_Scale(pair->side, near->normal);
    touch->gap = pair->side * near->height;
    return true;
}

/* A probe of the lower one below a triangle of the upper one. */
static bool TouchFromBelow(const kiriPairs* pairs, const kiriTouchingPair* pair, const kiriNear* near,
                           kiriPairTouch* touch)
{
    const kiriBody *lower = &pairs->bodies.data[near->body], *upper = &pairs->bodies.data[near->other];
    kiriVec3 normal = kiriVec3_Load(&lower->sheet->seen.surface.normals.data[3 * (size_t)near->vertex]);
    double along = pair->side * kiriVec3_Dot(normal, near->normal);
    double sign = along >= 0.0 ? 1.0 : -1.0;
    touch->upper = TrianglePlace(upper->sheet, near->triangle, near->share);
    touch->lower = VertexPlace(lower->sheet, near->vertex);
    touch->key = KeyOfPair(pair, near);
    touch->normal = kiriVec3_Scale(sign, near->normal);
    touch->gap = -sign * near->height;
    return fabs(along) > ALONG;
}

/* Inside of the lower one the probes of the upper one feel it as well, where they are as near to each other. */
static bool IsPairNeeded(const kiriPairs* pairs, const kiriTouchingPair* pair, const kiriNear* near)
{
    const kiriSheetData* upper = pairs->bodies.data[pair->bodies[0]].sheet;
    const kiriSheetData* lower = pairs->bodies.data[pair->bodies[1]].sheet;
    return near->body == pair->bodies[0] || lower->probes.isBorder.data[near->vertex] ||
           lower->mesh.step * lower->mesh.squares.side < 0.5 * upper->mesh.step * upper->mesh.squares.side;
}

/* How much nearer the two come in the tick, at most: the lower one may be stopped by what is below it. */
static double Approach(const kiriWorld* world, const kiriPairTouch* touch, double dt)
{
    double falls = -kiriVec3_Dot(touch->normal, PlaceVelocity(&touch->upper));
    double rises = kiriVec3_Dot(touch->normal, touch->velocity);
    double speed = falls + kiriMax(rises, 0.0) + dt * kiriVec3_Length(world->gravity);
    return speed > 0.0 ? dt * speed : 0.0;
}

/* Of planes of a vertex one behind the other only the first is reached. Returns whether there was one already. */
static bool TakeNearer(kiriPairs* pairs, const kiriPairTouch* touch)
{
    const kiriPlace3* upper = &touch->upper;
    int32_t known = upper->vertex[1] == KIRI_NONE ? upper->sheet->probes.touch.data[upper->vertex[0]] : KIRI_NONE;
    if (known == KIRI_NONE || kiriVec3_Dot(pairs->touches.data[known].normal, touch->normal) < ALIKE) {
        return false;
    }
    if (touch->gap < pairs->touches.data[known].gap) {
        pairs->touches.data[known] = *touch;
    }
    return true;
}

static bool AddTouch(kiriWorld* world, const kiriPairTouch* touch)
{
    const kiriPlace3* upper = &touch->upper;
    if (TakeNearer(&world->pairs, touch)) {
        return true;
    }
    if (upper->vertex[1] == KIRI_NONE) {
        upper->sheet->probes.touch.data[upper->vertex[0]] = world->pairs.touches.count;
    }
    return kiriArray_Push(&world->memory, &world->pairs.touches, *touch);
}

static void ForgetTouches(kiriWorld* world)
{
    for (int32_t i = 0; i < world->pairs.bodies.count; ++i) {
        kiriProbes* probes = &world->pairs.bodies.data[i].sheet->probes;
        kiriSpan span = kiriPieceRow_Of(&probes->list, world->pairs.bodies.data[i].piece);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            probes->touch.data[probes->list.items.data[k]] = KIRI_NONE;
        }
    }
    world->pairs.touches.count = 0;
}

/* How the lower place moves in the tick: what nothing holds and nothing carries falls. */
static kiriVec3 LowerVelocity(const kiriWorld* world, const kiriBody* lower, const kiriPlace3* place, double dt)
{
    kiriVec3 velocity = PlaceVelocity(place);
    return lower->isHeld || lower->isCarried ? velocity : kiriVec3_AddScaled(velocity, dt, world->gravity);
}

static bool TouchPair(kiriWorld* world, kiriTouchingPair* pair, double dt)
{
    kiriPairs* pairs = &world->pairs;
    double distance = kiriPair_Distance(&pairs->bodies.data[pair->bodies[0]], &pairs->bodies.data[pair->bodies[1]]);
    bool ok = true;
    pair->touches = 0;
    for (int32_t i = pair->nears.first; ok && i < pair->nears.first + pair->nears.count; ++i) {
        const kiriNear* near = &pairs->nears.data[i];
        kiriPairTouch touch;
        bool isUpper = near->body == pair->bodies[0];
        if (!IsPairNeeded(pairs, pair, near) ||
            !(isUpper ? TouchFromAbove(pairs, pair, near, &touch) : TouchFromBelow(pairs, pair, near, &touch))) {
            continue;
        }
        const kiriBody* lower = &pairs->bodies.data[pair->bodies[1]];
        touch.velocity = LowerVelocity(world, lower, &touch.lower, dt);
        touch.touch = KIRI_NONE;
        memcpy(touch.bodies, pair->bodies, sizeof(touch.bodies));
        touch.lift = lower->isCarried ? 0.0 : kiriVec3_Dot(lower->momentum, touch.normal) / lower->mass;
        double above = touch.gap - Approach(world, &touch, dt);
        if (above < (1.0 + MARGIN) * distance) {
            ok = AddTouch(world, &touch);
        }
        pair->touches |= above < (1.0 + CLOSE) * distance;
    }
    return ok;
}

bool kiriPairs_FindTouches(kiriWorld* world, double dt)
{
    bool ok = true;
    ForgetTouches(world);
    for (int32_t i = 0; ok && i < world->pairs.next.count; ++i) {
        ok = world->pairs.next.data[i].nears.count == 0 || TouchPair(world, &world->pairs.next.data[i], dt);
    }
    return ok;
}
