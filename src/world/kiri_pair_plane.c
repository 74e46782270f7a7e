#include "kiri_pair_work.h"

#include "../sheet/kiri_touch.h"

#include <string.h>

#define FIRM 0.5        /* of a unit: what is pushed along a normal as much as that is carried against it */
#define PUSH_SPEED 0.25 /* m/s: pieces that are too near each other part no faster */
enum { PASSES = 8 };

#define CUSHION 100.0 /* times the mass of a frame, see below */

static kiriVec3 SeenAt(const kiriPlace3* place)
{
    kiriVec3 x = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3 && place->vertex[k] != KIRI_NONE; ++k) {
        x = kiriVec3_AddScaled(x, place->share[k], kiriSurface_At(&place->sheet->seen.surface, place->vertex[k]));
    }
    return x;
}

static const kiriFrameData* LargestFrame(const kiriPlace3* place)
{
    double most = 0.0;
    int32_t best = KIRI_NONE;
    for (int k = 0; k < 3 && place->vertex[k] != KIRI_NONE; ++k) {
        kiriSpan span = place->sheet->vertexSkin.spans.data[place->vertex[k]];
        for (int32_t i = span.first; i < span.first + span.count; ++i) {
            kiriSampleWeight weight = place->sheet->vertexSkin.weights.data[i];
            if (weight.value * place->share[k] > most) {
                most = weight.value * place->share[k];
                best = weight.label;
            }
        }
    }
    KIRI_ASSERT(best != KIRI_NONE);
    return &place->sheet->frames.data[kiriSheet_FrameOf(place->sheet, best)];
}

/* The plane moves with the material of the lower one, but not as all of that moves. What lies on something goes no
   farther into it: the velocity that an implicit step leaves there is that of its way to it. And a lower one that flaps
   does not throw the upper one, which it does not feel in time: it lifts no faster than it rises as a whole. */
static kiriVec3 PlaneVelocity(const kiriPairs* pairs, const kiriPairTouch* pair)
{
    double stopped = pairs->bodies.data[pair->bodies[1]].least;
    const kiriFrameData* frame = LargestFrame(&pair->lower);
    double rises = kiriVec3_Dot(pair->velocity, pair->normal), most = kiriMax(pair->lift, 0.0);
    bool isCarried = kiriVec3_Dot(frame->support, pair->normal) > FIRM;
    double least = isCarried || stopped > 0.0 ? 0.0 : stopped, taken = kiriClamp(rises, least, most);
    return frame->held ? pair->velocity : kiriVec3_AddScaled(pair->velocity, taken - rises, pair->normal);
}

/* Surfaces that bend touch in places that change with their last bits, were the planes as hard as those of obstacles.
   So each frame has a cushion: all that presses on it meets so many times its mass. 1/kg. */
static double SoftnessOf(const kiriPlace3* place)
{
    return 1.0 / (CUSHION * LargestFrame(place)->mass);
}

/* The planes under a frame share its cushion. False for memory. */
static bool FindCushion(const kiriPlace3* place, int32_t* yield)
{
    int64_t number = INT64_C(1) << 40 | LargestFrame(place)->id;
    *yield = kiriTouches_FindYield(place->sheet, number);
    if (*yield == KIRI_NONE) {
        kiriYieldRow row;
        memset(&row, 0, sizeof(row));
        row.number = number;
        *yield = kiriTouches_AddYield(place->sheet, &row);
    }
    return *yield != KIRI_NONE;
}

static bool AddPlaneTouch(const kiriPairs* pairs, kiriPairTouch* pair)
{
    kiriSheetData* sheet = pair->upper.sheet;
    const kiriSettings *a = &sheet->settings, *b = &pair->lower.sheet->settings;
    kiriTouch touch;
    memset(&touch, 0, sizeof(touch));
    touch.key = pair->key;
    touch.point = KIRI_NONE;
    memcpy(touch.vertex, pair->upper.vertex, sizeof(touch.vertex));
    memcpy(touch.share, pair->upper.share, sizeof(touch.share));
    touch.normal = pair->normal;
    touch.offset = kiriVec3_Dot(pair->normal, SeenAt(&pair->lower)) + 0.5 * (a->contactThickness + b->contactThickness);
    touch.velocity = PlaneVelocity(pairs, pair);
    touch.friction = sqrt(a->friction * b->friction);
    touch.pushSpeed = PUSH_SPEED;
    touch.felt = -1.0;
    touch.cushion = SoftnessOf(&pair->upper);
    if (!FindCushion(&pair->upper, &touch.yield)) {
        return false;
    }
    pair->touch = sheet->touches.found.count;
    return kiriTouches_Add(sheet, &touch);
}

/* ---- What will stop a piece in the tick ---- */

static void RaisePlane(kiriBody* body, const kiriWorld* world, kiriVec3 normal, double least)
{
    bool carries = -kiriVec3_Dot(normal, kiriVec3_Normalize(world->gravity)) > FIRM;
    body->least = carries && least > body->least ? least : body->least;
}

static void StopAtObstacles(kiriWorld* world, kiriSheetData* sheet, double dt)
{
    for (int32_t i = 0; i < sheet->touches.found.count; ++i) {
        const kiriTouch* touch = &sheet->touches.found.data[i];
        if (touch->point == KIRI_NONE) {
            int32_t piece = sheet->probes.vertexPiece.data[touch->vertex[0]];
            double gap = kiriVec3_Dot(touch->normal, touch->seen) - touch->offset;
            RaisePlane(&world->pairs.bodies.data[sheet->probes.firstBody + piece], world, touch->normal,
                       gap / dt + kiriVec3_Dot(touch->normal, touch->velocity));
        }
    }
}

/* From below upwards: a piece that lands stops what follows it. Passes end when nothing changes, or after some. */
static void StopFalls(kiriWorld* world, double dt)
{
    kiriPairs* pairs = &world->pairs;
    bool isChanged = true;
    for (int pass = 0; isChanged && pass < PASSES; ++pass) {
        isChanged = false;
        for (int32_t i = 0; i < pairs->touches.count; ++i) {
            const kiriPairTouch* touch = &pairs->touches.data[i];
            kiriBody *upper = &pairs->bodies.data[touch->bodies[0]], *lower = &pairs->bodies.data[touch->bodies[1]];
            double rises = kiriVec3_Dot(touch->normal, touch->velocity), before = upper->least;
            rises = kiriMax(rises, lower->least);
            RaisePlane(upper, world, touch->normal, (touch->gap - kiriPair_Distance(upper, lower)) / dt + rises);
            isChanged |= upper->least > before;
        }
    }
}

static void FindStops(kiriWorld* world, double dt)
{
    for (int32_t i = 0; i < world->pairs.bodies.count; ++i) {
        world->pairs.bodies.data[i].least = -HUGE_VAL;
    }
    for (int32_t i = 0; i < world->pairs.bodies.count; ++i) {
        if (world->pairs.bodies.data[i].piece == 0) {
            StopAtObstacles(world, world->pairs.bodies.data[i].sheet, dt);
        }
    }
    StopFalls(world, dt);
}

bool kiriPairs_AddTouches(kiriWorld* world, double dt)
{
    FindStops(world, dt);
    bool ok = kiriArray_Reserve(&world->memory, &world->pairs.nextFelt, world->pairs.touches.count) &&
              kiriArray_Reserve(&world->memory, &world->pairs.order, world->pairs.touches.count) &&
              kiriPairs_ReserveIslands(world);
    for (int32_t i = 0; ok && i < world->pairs.touches.count; ++i) {
        kiriPairTouch* touch = &world->pairs.touches.data[i];
        ok = !kiriSheet_IsActive(touch->upper.sheet) || AddPlaneTouch(&world->pairs, touch);
    }
    return ok;
}
