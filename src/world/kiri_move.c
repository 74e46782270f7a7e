#include "kiri_move.h"
#include "../core/kiri_array.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_meeting.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_update.h"
#include "kiri_island.h"
#include "kiri_seam.h"

/* ---- Pins on obstacles ---- */

kiriObstacleData* kiriPinStep_Obstacle(const kiriWorld* world, const kiriPinData* pin)
{
    const kiriSlot* slot = pin->anchor.obstacle != 0 ? kiriPool_Find(&world->obstacleIds, pin->anchor.obstacle) : NULL;
    return slot != NULL ? slot->owner : NULL;
}

void kiriPinStep_Fasten(const kiriWorld* world, kiriPinData* pin)
{
    const kiriObstacleData* obstacle = kiriPinStep_Obstacle(world, pin);
    if (obstacle != NULL) {
        pin->anchor.local = kiriObstacle_PointToLocal(obstacle, pin->target);
    }
}

/* Returns the move of the point by an impulse along an axis. */
static kiriVec3 GiveAlong(const kiriYieldRow* body, kiriVec3 arm, kiriVec3 axis)
{
    kiriVec3 spin = kiriMat3_Mul(body->inverseInertia, kiriVec3_Cross(arm, axis));
    return kiriVec3_AddScaled(kiriVec3_Cross(spin, arm), body->inverseMass, axis);
}

/* Softens a pin on an obstacle. Obstacles of one body share its mass, and so do their pins. */
static void Soften(const kiriWorld* world, const kiriSheetData* sheet, const kiriObstacleData* obstacle,
                   kiriVec3 target, kiriPinAnchor* anchor)
{
    int32_t pins = 0;
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        const kiriObstacleData* other = kiriPinStep_Obstacle(world, pin);
        pins += other != NULL && (other == obstacle || (other->body != 0 && other->body == obstacle->body));
    }
    kiriYieldRow body = kiriObstacle_YieldRow(obstacle);
    kiriVec3 arm = kiriVec3_Sub(target, body.center);
    anchor->give.u = kiriVec3_Scale(pins, GiveAlong(&body, arm, kiriVec3_Make(1.0, 0.0, 0.0)));
    anchor->give.v = kiriVec3_Scale(pins, GiveAlong(&body, arm, kiriVec3_Make(0.0, 1.0, 0.0)));
    anchor->give.d = kiriVec3_Scale(pins, GiveAlong(&body, arm, kiriVec3_Make(0.0, 0.0, 1.0)));
    double turning = anchor->give.u.x + anchor->give.v.y + anchor->give.d.z - 3.0 * pins * body.inverseMass;
    anchor->most = pins * body.inverseMass + kiriMax(turning, 0.0);
}

static void BeginPin(const kiriWorld* world, kiriSheetData* sheet, int32_t index, double dt)
{
    KIRI_ASSERT_HAS(sheet->pins, index);
    kiriPinData* pin = &sheet->pins.data[index];
    const kiriObstacleData* obstacle = kiriPinStep_Obstacle(world, pin);
    if (obstacle == NULL) {
        return;
    }
    kiriObstacleData later = *obstacle;
    kiriObstacle_Advance(&later, dt);
    kiriVec3 from = kiriObstacle_PointToWorld(obstacle, pin->anchor.local);
    kiriVec3 to = kiriObstacle_PointToWorld(&later, pin->anchor.local);
    /* A move that is too small does not wake the pin's piece: it would move as far itself before it woke. */
    bool isAsleep = kiriSheet_PieceOf(sheet, sheet->layout.pinFrame.data[index])->rest.asleep;
    double most = kiriMax(kiriVec3_Distance(from, pin->target), kiriVec3_Distance(to, pin->target));
    if (isAsleep ? most > KIRI_CALM_SECONDS * sheet->settings.sleepSpeed
                 : !kiriVec3_Equal(from, pin->target) || !kiriVec3_Equal(to, pin->target)) {
        pin->lastTarget = from;
        pin->target = to;
        kiriPins_ForgetHistory(sheet, index);
        kiriSheet_WakePin(sheet, index);
    }
    Soften(world, sheet, obstacle, from, &pin->anchor);
}

/* Sets the motion of targets from the obstacles' current poses to their poses at the end of the tick. Wakes the sheet
   if a target moved. */
static void BeginPins(const kiriWorld* world, kiriSheetData* sheet, double dt)
{
    KIRI_EACH_INDEX(i, sheet->pins) {
        kiriPinAnchor* anchor = &sheet->pins.data[i].anchor;
        KIRI_CLEAR(&anchor->give);
        anchor->most = anchor->softness = 0.0;
        anchor->way = kiriVec3_Make(0.0, 0.0, 0.0);
        BeginPin(world, sheet, i, dt);
    }
}

/* ---- The list ---------------------------------------------------------------------------------------------------- */

kiriResult kiriObstacles_Reserve(kiriWorld* world)
{
    return kiriArray_ReserveMore(&world->memory, &world->obstacles, 1)
               ? kiriWorld_ReserveIds(world, &world->obstacleIds, 1)
               : KIRI_ERROR_MEMORY;
}

void kiriObstacles_Add(kiriWorld* world, kiriObstacleData* obstacle)
{
    KIRI_NEXT(world->obstacles) = obstacle;
    obstacle->id = kiriPool_Add(&world->obstacleIds, obstacle, 0);
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        sheet->touches.rests.areSummed = false; /* another obstacle may have had its slot */
    }
}

/* ---- What rests near them ---------------------------------------------------------------------------------------- */

/* Returns the smallest displacement of an obstacle that wakes a sheet, m. */
static double LeastDrift(const kiriWorld* world)
{
    double least = KIRI_ENDLESS;
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        double far = KIRI_CALM_SECONDS * sheet->settings.sleepSpeed;
        least = far > 0.0 && far < least ? far : least;
    }
    return least;
}

/* Finds the parts of the sheet within reach of an obstacle whose bounds are set. Fails on out of memory. */
static bool FindNear(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle, double reach)
{
    return kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) &&
           kiriObstacleSearch_Near(search, sheet, obstacle, reach);
}

static void WakeNear(kiriWorld* world, kiriSheetData* sheet, const kiriObstacleData* obstacle)
{
    kiriObstacleSearch* search = &world->obstacleSearch;
    const kiriIndices* triangles = &search->triangles;
    search->memory = &world->memory;
    if (sheet->layout.pieces.count == 1 || !FindNear(search, sheet, obstacle, sheet->settings.contactThickness)) {
        kiriSheet_WakeAll(sheet);
        return;
    }
    KIRI_EACH_LISTED(triangle, *triangles) {
        kiriSheet_WakePiece(sheet, kiriPiece_OfTriangle(sheet, triangle));
    }
}

static void WakeAround(kiriWorld* world, kiriObstacleData* obstacle)
{
    kiriObstacle_Bound(obstacle, 0.0);
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        kiriBox box = kiriSheet_Box(sheet);
        if ((obstacle->groups & sheet->settings.groups) != 0 &&
            kiriObstacle_IsNear(obstacle, box.lower, box.upper, sheet->settings.contactThickness)) {
            WakeNear(world, sheet, obstacle);
        }
    }
}

void kiriObstacles_Remove(kiriWorld* world, kiriObstacleData* obstacle)
{
    WakeAround(world, obstacle);
    KIRI_KEEP_IF(kiriObstacleData*, at, world->obstacles, *at != obstacle);
    kiriPool_Remove(&world->obstacleIds, obstacle->id);
    kiriMemory_Free(&world->memory, obstacle);
}

/* Returns the largest displacement of a point of the obstacle by a change of pose, m; KIRI_ENDLESS for large turns. */
static double WayToObstacle(const kiriObstacleData* obstacle, kiriVec3 position, kiriMat3 rotation)
{
    kiriObstacleData turning = *obstacle;
    const kiriMat3* r = &obstacle->rotation;
    double turn = kiriVec3_Distance(rotation.u, r->u) + kiriVec3_Distance(rotation.v, r->v);
    if (turn > 0.1) {
        return KIRI_ENDLESS;
    }
    turning.spin = kiriVec3_Scale(
        0.5, kiriVec3_Add(kiriVec3_Cross(r->u, rotation.u),
                          kiriVec3_Add(kiriVec3_Cross(r->v, rotation.v), kiriVec3_Cross(r->d, rotation.d))));
    return kiriVec3_Distance(position, obstacle->position) + kiriObstacle_TurnSpeed(&turning);
}

void kiriObstacles_Put(kiriWorld* world, kiriObstacleData* obstacle, kiriVec3 position, kiriMat3 rotation)
{
    double way = WayToObstacle(obstacle, position, rotation);
    if (way > LeastDrift(world)) {
        WakeAround(world, obstacle);
    }
    obstacle->drift += way;
    obstacle->position = position;
    obstacle->rotation = rotation;
}

/* ---- Touches ----------------------------------------------------------------------------------------------------- */

static bool IsMoving(const kiriObstacleData* obstacle, double dt, double least)
{
    double speed = kiriVec3_Length(obstacle->velocity) + kiriObstacle_TurnSpeed(obstacle);
    return obstacle->drift + dt * speed > least;
}

/* Returns the number of the obstacle's body, above zero. An obstacle without a body has a unique number. */
static int64_t NumberOf(const kiriObstacleData* obstacle)
{
    return (int64_t)(obstacle->body != 0 ? (uint64_t)obstacle->body << 32 : (uint64_t)obstacle->id << 32 | 1u);
}

/* Orders obstacles by the lower x of their boxes, which are extended by twice their motion in the tick. */
static bool ComesFirst(const void* context, int32_t a, int32_t b)
{
    const kiriWorld* world = context;
    double x = world->obstacles.data[a]->lower.x, y = world->obstacles.data[b]->lower.x;
    return x < y || (x == y && a < b);
}

/* The space in which a sheet may touch obstacles. */
typedef struct Around {
    kiriBox box;
    double speed, reach;
} Around;

/* Returns the next obstacle, in their order, that the sheet may touch, or null. Starts at *at and advances it. */
static kiriObstacleData* NextNear(const kiriWorld* world, const kiriSheetData* sheet, const Around* around, int32_t* at)
{
    while (*at < world->obstacleOrder.count) {
        kiriObstacleData* obstacle = world->obstacles.data[world->obstacleOrder.data[(*at)++]];
        if (obstacle->lower.x > around->box.upper.x + around->reach) {
            return NULL;
        }
        if ((obstacle->groups & sheet->settings.groups) != 0 &&
            kiriObstacle_IsNear(obstacle, around->box.lower, around->box.upper, around->reach)) {
            return obstacle;
        }
    }
    return NULL;
}

/* The search for the touches of all sheets in a tick. */
typedef struct TouchSearch {
    kiriWorld* world;
    double dt, least;
    bool isAnyMoving;
} TouchSearch;

static void Stir(kiriSheetData* sheet, int32_t piece)
{
    KIRI_ASSERT_HAS(sheet->layout.pieces, piece);
    kiriRest* rest = &sheet->layout.pieces.data[piece].rest;
    rest->isStirred = rest->isStirred || rest->asleep;
    sheet->rest.isStirred = sheet->rest.isStirred || rest->asleep;
}

/* Stirs the pieces near an obstacle. Fails on out of memory. */
static bool StirNear(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle, double reach)
{
    const kiriIndices* triangles = &search->triangles;
    if (sheet->layout.pieces.count == 1) {
        Stir(sheet, 0);
        return true;
    }
    bool ok = FindNear(search, sheet, obstacle, reach);
    KIRI_EACH_LISTED_WHILE(ok, triangle, *triangles) {
        Stir(sheet, kiriPiece_OfTriangle(sheet, triangle));
    }
    return ok;
}

/* Stirs sleeping pieces that a moving obstacle approaches. Fails on out of memory. */
static bool StirSleepers(const TouchSearch* looking, kiriObstacleSearch* search, kiriSheetData* sheet,
                         const Around* around)
{
    double fall = kiriReach_Of(0.0, looking->world->gravity, looking->dt);
    const Around still = { around->box, 0.0, fall + sheet->settings.contactThickness };
    int32_t at = 0;
    bool ok = true;
    for (kiriObstacleData* obstacle; ok && (obstacle = NextNear(looking->world, sheet, &still, &at)) != NULL;) {
        ok = !IsMoving(obstacle, looking->dt, looking->least) || StirNear(search, sheet, obstacle, still.reach);
    }
    return ok;
}

/* Returns the momentum that the host gave a body since the last tick to make up for what sheets gave it, N s: weight, or what
   presses on them. Given at once, it would move the body in the first substeps, and sheets would push it back in the last. */
static kiriVec3 LentTo(const kiriWorld* world, const kiriObstacleData* obstacle)
{
    kiriVec3 given = obstacle->impulse.force;
    KIRI_EACH_OF_WHILE(obstacle->body != 0, kiriObstacleData, other, world->obstacles) {
        given = other != obstacle && other->body == obstacle->body ? kiriVec3_Add(given, other->impulse.force) : given;
    }
    kiriVec3 now = kiriObstacle_VelocityAt(obstacle, kiriObstacle_CenterOfMass(obstacle));
    double size = kiriVec3_Dot(given, given);
    double back = size - obstacle->mass * kiriVec3_Dot(kiriVec3_Sub(now, obstacle->was), given);
    return kiriVec3_Scale(size > 0.0 ? -kiriClamp(back / size, 0.0, 1.0) : 0.0, given);
}

static bool TouchAll(const kiriWorld* world, kiriObstacleSearch* search, kiriSheetData* sheet, const Around* around)
{
    int32_t at = 0;
    bool ok = true;
    for (kiriObstacleData* obstacle; ok && (obstacle = NextNear(world, sheet, around, &at)) != NULL;) {
        int32_t yield = kiriTouches_FindYield(sheet, NumberOf(obstacle));
        if (yield == KIRI_NONE) { /* one row for each body */
            kiriYieldRow row = kiriObstacle_YieldRow(obstacle);
            row.number = NumberOf(obstacle);
            row.lent = kiriObstacle_IsMovable(obstacle) ? LentTo(world, obstacle) : row.lent;
            yield = kiriTouches_AddYield(sheet, &row);
        }
        ok = yield != KIRI_NONE && kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface) &&
             kiriObstacleSearch_Reserve(search, sheet) &&
             kiriObstacleSearch_Run(search, sheet, obstacle, around->speed, yield);
    }
    return ok;
}

/* Finds the touches of a sheet. Sleeping pieces that a cut changes in this tick are stirred already. */
static bool FindTouchesOf(const TouchSearch* looking, kiriObstacleSearch* search, kiriSheetData* sheet)
{
    bool sleeps = sheet->rest.asleep && !sheet->rest.isStirred && sheet->update->stage != KIRI_READY;
    if (sleeps && !looking->isAnyMoving) {
        return true;
    }
    if (sleeps && !kiriBounds_Update(sheet->seen.bounds, sheet->memory, &sheet->seen.surface)) {
        return false;
    }
    Around around = { kiriSheet_Box(sheet), 0.0, 0.0 };
    around.speed = sheet->rest.asleep ? 0.0 : kiriSheet_SpeedLimit(sheet, &around.box);
    around.reach =
        kiriReach_Of(around.speed, looking->world->gravity, looking->dt) + sheet->settings.contactThickness;
    bool hasSleepers = false;
    KIRI_EACH_WHILE(!hasSleepers, const kiriPiece, piece, sheet->layout.pieces) {
        hasSleepers = piece->rest.asleep;
    }
    if (hasSleepers && !StirSleepers(looking, search, sheet, &around)) {
        return false;
    }
    if (sheet->rest.isIdle && sheet->rest.isStirred && !kiriTouches_Begin(sheet)) {
        return false; /* others have begun */
    }
    return (sleeps && !sheet->rest.isStirred) || TouchAll(looking->world, search, sheet, &around);
}

/* Finds the touches of a sheet in a task, which must not allocate. If room is missing, restores the sheet; it is
   searched again after all tasks. */
static void TryTouchesOf(const TouchSearch* looking, kiriObstacleSearch* search, kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    kiriMemory *own = sheet->memory, none = kiriMemory_None();
    int32_t found = touches->found.count, yields = touches->yields.count;
    sheet->memory = search->memory = &none;
    touches->isShort = !FindTouchesOf(looking, search, sheet);
    sheet->memory = own;
    search->memory = &looking->world->memory;
    touches->found.count = touches->isShort ? found : touches->found.count;
    touches->yields.count = touches->isShort ? yields : touches->yields.count;
}

/* Finds the touches of every n-th sheet, n the number of searches. Sheets with adjacent indices are often near each
   other and similar, so this balances the load. */
static void LookForTouches(int32_t start, int32_t end, void* context)
{
    const TouchSearch* looking = context;
    const kiriWorld* world = looking->world;
    KIRI_FROM_TO(k, start, end) {
        for (int32_t i = k; i < world->sheets.count; i += world->searches.count) {
            TryTouchesOf(looking, &world->searches.data[k], world->sheets.data[i]);
        }
    }
}

static void ReadySearch(kiriWorld* world, kiriObstacleSearch* search, double dt)
{
    search->memory = &world->memory;
    search->dt = dt;
    search->gravity = world->gravity;
}

/* Searches in tasks, two a worker, so that workers finish at about the same time. Fails on out of memory. */
static bool LookInTasks(TouchSearch* looking)
{
    kiriWorld* world = looking->world;
    int32_t made = world->searches.count, wanted = 2 * world->tasks.workers;
    if (made < wanted && !kiriArray_Resize(&world->memory, &world->searches, wanted)) {
        return false;
    }
    KIRI_FROM_TO(k, made, wanted) {
        KIRI_CLEAR(&world->searches.data[k]);
    }
    KIRI_TIMES(k, wanted) {
        ReadySearch(world, &world->searches.data[k], looking->dt);
    }
    kiriTasks_Run(&world->tasks, LookForTouches, wanted, 1, looking);
    return true;
}

bool kiriObstacles_FindTouches(kiriWorld* world, double dt)
{
    if (world->obstacles.count == 0) {
        return true;
    }
    double least = LeastDrift(world);
    TouchSearch looking = { world, dt, least, false };
    KIRI_EACH_OF(kiriObstacleData, obstacle, world->obstacles) {
        kiriObstacle_Bound(obstacle, 2.0 * dt);
        looking.isAnyMoving |= IsMoving(obstacle, dt, least);
    }
    bool areTasks = kiriTasks_AreGiven(&world->tasks);
    bool ok = kiriSort_Order(&world->memory, &world->obstacleOrder, world->obstacles.count, ComesFirst, world) &&
              (!areTasks || LookInTasks(&looking));
    ReadySearch(world, &world->obstacleSearch, dt);
    KIRI_EACH_INDEX_WHILE(ok, i, world->sheets) {
        kiriSheetData* sheet = world->sheets.data[i];
        kiriObstacleSearch* search =
            areTasks ? &world->searches.data[i % world->searches.count] : &world->obstacleSearch;
        ok = (areTasks && !sheet->touches.isShort) || FindTouchesOf(&looking, search, sheet);
    }
    return ok;
}

/* ---- Impulses ---------------------------------------------------------------------------------------------------- */

void kiriObstacles_Begin(kiriWorld* world)
{
    KIRI_EACH_OF(kiriObstacleData, obstacle, world->obstacles) {
        KIRI_CLEAR(&obstacle->impulse);
        obstacle->was = kiriObstacle_VelocityAt(obstacle, kiriObstacle_CenterOfMass(obstacle));
        obstacle->contacts = 0;
    }
}

/* Adds to the sheet's yield rows the impulses of other sheets on the same bodies. */
static void LoadYields(const kiriWorld* world, kiriSheetData* sheet)
{
    KIRI_EACH(kiriYieldRow, row, sheet->touches.yields) {
        KIRI_EACH_OF_WHILE(row->number > 0 && row->inverseMass > 0.0, kiriObstacleData, obstacle, world->obstacles) {
            if (NumberOf(obstacle) == row->number) {
                kiriVec3 arm = kiriVec3_Sub(kiriObstacle_CenterOfMass(obstacle), row->center);
                kiriWrench_Add(&row->impulse, 1.0, &obstacle->impulse);
                row->impulse.moment = kiriVec3_Add(row->impulse.moment, kiriVec3_Cross(arm, obstacle->impulse.force));
            }
        }
    }
}

/* Returns the obstacle of a touch, or null if the touch has no obstacle. */
static kiriObstacleData* OwnerOfKey(const kiriWorld* world, uint64_t key)
{
    int32_t slot = kiriObstacle_SlotOfKey(key);
    return key >> 60 == KIRI_TOUCH_OBSTACLE && slot < world->obstacleIds.slots.count
               ? world->obstacleIds.slots.data[slot].owner
               : NULL;
}

bool kiriObstacles_ReserveRests(const kiriWorld* world, kiriSheetData* sheet)
{
    int32_t touches = sheet->touches.last.touches.count + sheet->touches.slept.touches.count;
    int32_t most = kiriMin(touches, world->obstacles.count);
    return kiriArray_Reserve(sheet->memory, &sheet->touches.rests.on, most);
}

/* Returns the load on an obstacle. Searches from the end, because touches of one obstacle are mostly consecutive. */
static kiriRestLoad* RestLoadOn(kiriRestLoads* rests, int32_t slot, kiriVec3 center)
{
    KIRI_EACH_INDEX_BACK(k, rests->on) {
        if (rests->on.data[k].slot == slot) {
            return &rests->on.data[k];
        }
    }
    kiriRestLoad* load = &KIRI_NEXT(rests->on);
    KIRI_CLEAR(load);
    load->slot = slot;
    load->center = center;
    return load;
}

static void AddToRests(const kiriWorld* world, kiriRestLoads* rests, const kiriTouch* touch)
{
    const kiriObstacleData* obstacle = OwnerOfKey(world, touch->key);
    kiriVec3 impulse = kiriVec3_Scale(rests->dt, touch->force);
    if (obstacle != NULL && kiriVec3_Dot(impulse, touch->normal) > 0.0) {
        kiriVec3 center = kiriObstacle_CenterOfMass(obstacle), back = kiriVec3_Scale(-1.0, impulse);
        kiriRestLoad* load = RestLoadOn(rests, kiriObstacle_SlotOfKey(touch->key), center);
        kiriVec3 turn = kiriVec3_Cross(kiriVec3_Sub(touch->on, center), back);
        load->impulse.force = kiriVec3_Add(load->impulse.force, back);
        load->impulse.moment = kiriVec3_Add(load->impulse.moment, turn);
        load->contacts += 1;
    }
}

static kiriObstacleData* OwnerOfSlot(const kiriWorld* world, int32_t slot)
{
    return world->obstacleIds.slots.data[slot].owner;
}

/* Sums for each sheet by itself, so that the sums can be kept. */
static void SumRests(const kiriWorld* world, kiriSheetData* sheet, double dt)
{
    kiriRestLoads* rests = &sheet->touches.rests;
    bool areSummed = rests->areSummed && rests->dt == dt;
    KIRI_EACH_WHILE(areSummed, const kiriRestLoad, load, rests->on) {
        const kiriObstacleData* obstacle = OwnerOfSlot(world, load->slot);
        areSummed = obstacle != NULL && kiriVec3_Equal(kiriObstacle_CenterOfMass(obstacle), load->center);
    }
    if (!areSummed) {
        rests->on.count = 0;
        rests->dt = dt;
        rests->areSummed = true;
        KIRI_EACH(const kiriTouch, touch, sheet->touches.slept.touches) {
            AddToRests(world, rests, touch);
        }
    }
}

/* Gives the impulses of a sheet to obstacles: to movable ones, or to the others. */
static void TakeImpulses(const kiriWorld* world, kiriSheetData* sheet, double dt, bool areMovable)
{
    const kiriTouches* touches = &sheet->touches;
    SumRests(world, sheet, dt);
    KIRI_EACH(const kiriRestLoad, load, touches->rests.on) {
        kiriObstacleData* obstacle = OwnerOfSlot(world, load->slot);
        if (kiriObstacle_IsMovable(obstacle) == areMovable) {
            kiriWrench_Add(&obstacle->impulse, 1.0, &load->impulse);
            obstacle->contacts += load->contacts;
        }
    }
    KIRI_EACH(const kiriTouch, touch, touches->found) {
        const kiriContactRow* row = touch->row != KIRI_NONE ? &touches->rows.data[touch->row] : NULL;
        kiriObstacleData* obstacle = row != NULL ? OwnerOfKey(world, row->key) : NULL;
        if (obstacle != NULL && kiriObstacle_IsMovable(obstacle) == areMovable &&
            (areMovable || kiriVec3_Dot(row->impulse, row->normal) > 0.0)) {
            kiriObstacle_TakeImpulse(obstacle, kiriVec3_Scale(-1.0, row->impulse), touch->on);
            obstacle->contacts += kiriVec3_Dot(row->impulse, row->normal) > 0.0;
        }
    }
}

/* ---- Groups ---- */

/* Returns the item of an obstacle in the forest of groups: these follow the sheets. */
static int32_t ItemOf(const kiriWorld* world, const kiriObstacleData* obstacle)
{
    const kiriSlot* slot = kiriPool_Find(&world->obstacleIds, obstacle->id);
    return world->sheets.count + (int32_t)(slot - world->obstacleIds.slots.data);
}

/* Joins a sheet with an obstacle to which it may give an impulse, or null. */
static void JoinObstacle(const kiriWorld* world, int32_t sheet, const kiriObstacleData* obstacle)
{
    if (obstacle != NULL && kiriObstacle_IsMovable(obstacle)) {
        kiriUnion_Join(world->moves.parent.data, sheet, ItemOf(world, obstacle));
    }
}

/* Joins a sheet with the obstacles that it touches or touched, for it may sleep. */
static void JoinTouched(const kiriWorld* world, int32_t sheet)
{
    const kiriSheetData* data = world->sheets.data[sheet];
    const kiriTouchMemory* memories[] = { &data->touches.last, &data->touches.slept };
    KIRI_EACH(const kiriTouch, touch, data->touches.found) {
        JoinObstacle(world, sheet, OwnerOfKey(world, touch->key));
    }
    KIRI_TIMES(n, 2) {
        KIRI_EACH(const kiriTouch, touch, memories[n]->touches) {
            JoinObstacle(world, sheet, OwnerOfKey(world, touch->key));
        }
    }
    KIRI_EACH(const kiriPinData, pin, data->pins) {
        JoinObstacle(world, sheet, kiriPinStep_Obstacle(world, pin));
    }
}

static bool HasLowerNumber(const void* context, int32_t a, int32_t b)
{
    kiriObstacleData* const* obstacles = context;
    int64_t x = NumberOf(obstacles[a]), y = NumberOf(obstacles[b]);
    return x < y || (x == y && a < b);
}

/* Joins sheets that move the same body into groups. A sheet's yield rows include the impulses of earlier sheets. */
static bool JoinByBodies(kiriWorld* world)
{
    kiriMoves* moves = &world->moves;
    if (!kiriSort_Order(&world->memory, &moves->order, world->obstacles.count, HasLowerNumber, world->obstacles.data)) {
        return false;
    }
    KIRI_FROM_TO(k, 1, moves->order.count) {
        const kiriObstacleData* a = world->obstacles.data[moves->order.data[k - 1]];
        const kiriObstacleData* b = world->obstacles.data[moves->order.data[k]];
        if (NumberOf(a) == NumberOf(b)) {
            kiriUnion_Join(moves->parent.data, ItemOf(world, a), ItemOf(world, b));
        }
    }
    KIRI_EACH_INDEX(i, world->sheets) {
        JoinTouched(world, i);
    }
    return true;
}

bool kiriMoves_Prepare(kiriWorld* world)
{
    kiriMoves* moves = &world->moves;
    int32_t count = world->sheets.count;
    if (!kiriArray_Resize(&world->memory, &moves->of, count) ||
        !kiriArray_Resize(&world->memory, &moves->parent, (int64_t)count + world->obstacleIds.slots.count) ||
        !kiriArray_Reserve(&world->memory, &moves->heads, count)) {
        return false;
    }
    kiriUnion_Init(moves->parent.data, moves->parent.count);
    if (!kiriIslands_FindClusters(world)) {
        return false;
    }
    KIRI_TIMES(i, count) {
        int32_t cluster = kiriIslands_ClusterOf(&world->islands, i);
        if (cluster != KIRI_NONE) {
            kiriUnion_Join(moves->parent.data, i, cluster);
        }
    }
    return !kiriTasks_AreGiven(&world->tasks) || world->obstacles.count == 0 || JoinByBodies(world);
}

void kiriMoves_BeginClusters(kiriWorld* world, double dt)
{
    KIRI_EACH_INDEX(k, world->active) {
        if (kiriIslands_ClusterOf(&world->islands, world->active.data[k]) != KIRI_NONE) {
            BeginPins(world, kiriWorld_Active(world, k), dt);
        }
    }
}

/* ---- Moving ---- */

typedef struct MoveTask {
    kiriWorld* world;
    double dt;
    int32_t substeps;
    kiriQuota systems; /* limit for each sheet; the sheets of a wave do not exceed it together */
} MoveTask;

/* Gives the impulses of a sheet to obstacles: movable ones, which are in the group of the sheet, right after it moved;
   the others after all sheets moved, in the order of sheets. */
static void GiveImpulses(const MoveTask* task, int32_t i, bool areMovable)
{
    kiriSheetData* sheet = task->world->sheets.data[i];
    TakeImpulses(task->world, sheet, task->dt, areMovable);
    KIRI_EACH_WHILE(task->world->moves.of.data[i].progress != KIRI_MORE, const kiriPinData, pin, sheet->pins) {
        kiriObstacleData* obstacle = kiriPinStep_Obstacle(task->world, pin);
        if (obstacle != NULL && kiriObstacle_IsMovable(obstacle) == areMovable) {
            kiriObstacle_TakeImpulse(obstacle, kiriVec3_Scale(-task->dt, pin->bore.force), pin->target);
        }
    }
}

/* Moves a sheet, or all sheets of a cluster when its first one moves, which gets the items. */
static void MoveSheet(const MoveTask* task, int32_t first)
{
    kiriWorld* world = task->world;
    kiriSheetData* sheet = world->sheets.data[first];
    kiriMove* moves = world->moves.of.data;
    kiriQuota systems = task->systems;
    int32_t cluster = kiriIslands_ClusterOf(&world->islands, first), next = 0;
    bool isAlone = cluster == KIRI_NONE;
    if (!isAlone && cluster != first) {
        return;
    }
    /* No system is left for the sheet, and its visible surface does not change. Then waiting costs nearly nothing, even
       for many sheets. */
    if (isAlone && kiriQuota_IsSpent(&systems) && kiriView_IsSettled(sheet) && kiriMotion_Wait(sheet, task->dt)) {
        moves[first].progress = KIRI_MORE;
        moves[first].systems = 0;
        return;
    }
    KIRI_EACH_OF_CLUSTER(i, &world->islands, first) {
        LoadYields(world, world->sheets.data[i]);
        moves[i].systems = 0;
    }
    if (isAlone) {
        BeginPins(world, sheet, task->dt);
        next = kiriMotion_Begin(sheet, world->gravity, task->dt, &systems, &world->islands.systems.data[first]);
    }
    bool isMoved = !sheet->rest.asleep;
    kiriIslands_Move(world, first, task->dt, task->substeps, &systems);
    moves[first].systems = systems.used - task->systems.used;
    if (isAlone && isMoved && moves[first].progress == KIRI_DONE) {
        sheet->turns.next = next;
    }
    KIRI_EACH_OF_CLUSTER(i, &world->islands, first) {
        GiveImpulses(task, i, true);
    }
}

static void MoveGroups(int32_t start, int32_t end, void* context)
{
    const MoveTask* task = context;
    const kiriMoves* moves = &task->world->moves;
    KIRI_FROM_TO(k, start, end) {
        for (int32_t i = moves->heads.data[k]; i != KIRI_NONE; i = moves->of.data[i].next) {
            MoveSheet(task, i);
        }
    }
}

/* Sheets are moved in this order. */
int32_t kiriMoves_SheetAt(const kiriWorld* world, int32_t turn, int32_t k)
{
    const kiriIndices* active = &world->active;
    int32_t low;
    KIRI_SEARCH(low, 0, active->count, active->data[middle] < turn);
    return active->data[(low + k) % active->count];
}

/* Returns the end of a wave: sheets from `first` on, at least one, for which the systems suffice in the worst case. If
   no systems are left, all sheets. */
static int32_t EndOfWave(const MoveTask* task, int32_t first)
{
    const kiriWorld* world = task->world;
    int32_t end = kiriQuota_IsSpent(&task->systems) ? world->active.count : first;
    int64_t most = 0;
    while (end < world->active.count) {
        int32_t i = kiriMoves_SheetAt(world, world->turn, end),
                cluster = kiriIslands_ClusterOf(&task->world->islands, i);
        most += cluster == KIRI_NONE ? kiriMotion_MostItems(world->sheets.data[i], task->substeps)
                : cluster == i       ? kiriIslands_MostItems(world, i, task->substeps)
                                     : 0;
        if (most > task->systems.left && end > first) {
            break;
        }
        ++end;
    }
    return end;
}

/* Lists the groups of these sheets, each in the order of motion. */
static void ListGroups(kiriWorld* world, int32_t first, int32_t end)
{
    kiriMoves* moves = &world->moves;
    moves->heads.count = 0;
    KIRI_FROM_TO(k, first, end) {
        moves->of.data[kiriUnion_Root(moves->parent.data, kiriMoves_SheetAt(world, world->turn, k))].tail = KIRI_NONE;
    }
    KIRI_FROM_TO(k, first, end) {
        int32_t i = kiriMoves_SheetAt(world, world->turn, k);
        int32_t* tail = &moves->of.data[kiriUnion_Root(moves->parent.data, i)].tail;
        if (*tail == KIRI_NONE) {
            KIRI_NEXT(moves->heads) = i;
        } else {
            moves->of.data[*tail].next = i;
        }
        *tail = i;
        moves->of.data[i].next = KIRI_NONE;
    }
}

/* Gives impulses to fixed obstacles and counts the items of a sheet, or of a cluster with its first sheet. */
static void EndMoved(const MoveTask* task, int32_t i, kiriQuota* systems)
{
    kiriWorld* world = task->world;
    int32_t cluster = kiriIslands_ClusterOf(&world->islands, i);
    if (cluster != KIRI_NONE && cluster != i) {
        return;
    }
    systems->left = kiriMax(systems->left - world->moves.of.data[i].systems, 0);
    systems->used += world->moves.of.data[i].systems;
    KIRI_EACH_OF_CLUSTER(k, &world->islands, i) {
        GiveImpulses(task, k, false);
        world->profile.systemsSolved += kiriSolver_TakeSolved(world->sheets.data[k]->solver);
    }
}

/* Moves sheets in waves. The sheets of a wave move in parallel; each wave gets the systems that the last one left. */
void kiriMoves_Run(kiriWorld* world, double dt, int32_t substeps, kiriQuota* systems)
{
    for (int32_t first = 0, end; first < world->active.count; first = end) {
        MoveTask task = { world, dt, substeps, *systems };
        end = EndOfWave(&task, first);
        ListGroups(world, first, end);
        kiriTasks_Run(&world->tasks, MoveGroups, world->moves.heads.count, 1, &task);
        KIRI_FROM_TO(k, first, end) {
            EndMoved(&task, kiriMoves_SheetAt(world, world->turn, k), systems);
        }
    }
}

void kiriObstacles_End(kiriWorld* world, double dt)
{
    double least = world->obstacles.count > 0 ? LeastDrift(world) : 0.0;
    KIRI_EACH_OF(kiriObstacleData, obstacle, world->obstacles) {
        kiriObstacle_Advance(obstacle, dt);
        obstacle->drift = obstacle->drift > least ? 0.0 : obstacle->drift;
    }
}

enum { RANGE_VERTICES = 2048 }; /* about 10 us; a multiple of 4, see kiri_surface.c */

typedef struct SkinTask {
    kiriWorld* world;
    double dt;
    void (*run)(kiriSheetData* sheet, int32_t begin, int32_t end); /* of a range */
} SkinTask;

static bool StoodStill(const kiriWorld* world, int32_t k)
{
    return world->moves.of.data[world->active.data[k]].isStill;
}

/* Returns true if the sheet is skinned by ranges: with tasks, and unless it is one range, sleeps or was not moved. Lips of
   sewn sheets are drawn together when all skins are blended: so these go by ranges, too. */
static bool IsInRanges(const kiriWorld* world, int32_t k)
{
    const kiriSheetData* sheet = kiriWorld_Active(world, k);
    bool isLarge = kiriTasks_AreGiven(&world->tasks) && sheet->mesh.vertices.count > RANGE_VERTICES;
    return (isLarge || sheet->sewn.count > 0) && !StoodStill(world, k) && !sheet->rest.asleep;
}

bool kiriSkinStep_Prepare(kiriWorld* world)
{
    int64_t count = 0;
    bool isRanged = kiriTasks_AreGiven(&world->tasks) || world->seams.count > 0;
    KIRI_EACH_OF_WHILE(isRanged, kiriSheetData, sheet, world->sheets) {
        count += sheet->mesh.vertices.count / RANGE_VERTICES + 1;
    }
    return kiriArray_Reserve(&world->memory, &world->skinRanges, count) && kiriWelds_Reserve(world);
}

static void ListRanges(kiriWorld* world)
{
    world->skinRanges.count = 0;
    KIRI_EACH_INDEX(k, world->active) {
        const kiriSheetData* sheet = kiriWorld_Active(world, k);
        int32_t vertices = IsInRanges(world, k) ? sheet->mesh.vertices.count : 0;
        for (int32_t v = 0; v < vertices; v += RANGE_VERTICES) {
            kiriSkinRange range = { world->active.data[k], v, kiriMin(v + RANGE_VERTICES, vertices) };
            KIRI_NEXT(world->skinRanges) = range;
        }
    }
}

/* Returns true if the detail layer of the sheet is worth tasks for each color. */
static bool IsLarge(const kiriSheetData* sheet)
{
    return sheet->mesh.vertices.count > 16 * RANGE_VERTICES;
}

/* Ends the skin of a sheet: fades, and the detail layer if time goes on. */
static void Relax(const SkinTask* task, kiriSheetData* sheet, const kiriTasks* tasks)
{
    kiriView_AddFades(sheet);
    if (task->dt > 0.0 && kiriView_Relax(sheet, tasks)) {
        kiriObstacles_PushDetail(task->world->obstacles.data, task->world->obstacles.count, sheet);
        kiriView_EndRelaxing(sheet);
    }
    if (task->dt > 0.0) {
        kiriPins_Draw(sheet, task->dt);
    }
}

static void BeginSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    KIRI_FROM_TO(k, start, end) {
        kiriSheetData* sheet = kiriWorld_Active(task->world, k);
        if (StoodStill(task->world, k)) {
            continue;
        }
        if (!sheet->rest.asleep) {
            kiriView_Fade(sheet, task->dt);
        }
        if (IsInRanges(task->world, k)) {
            kiriView_TakeFrames(sheet);
            continue;
        }
        if (!sheet->rest.asleep || sheet->seen.isElsewhere) {
            const kiriTasks none = { NULL, NULL, NULL, 0 };
            kiriView_TakeFrames(sheet);
            kiriView_BlendRange(sheet, 0, sheet->seen.surface.vertexCount);
            Relax(task, sheet, &none);
            kiriView_Sum(sheet);
            kiriView_WriteRange(sheet, 0, sheet->seen.surface.vertexCount);
            kiriView_EndWriting(sheet);
        }
        kiriView_KeepBounds(sheet);
    }
}

static void RunRanges(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    KIRI_FROM_TO(k, start, end) {
        kiriSkinRange range = task->world->skinRanges.data[k];
        task->run(task->world->sheets.data[range.sheet], range.begin, range.end);
    }
}

static void RelaxSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    const kiriTasks none = { NULL, NULL, NULL, 0 };
    KIRI_FROM_TO(k, start, end) {
        kiriSheetData* sheet = kiriWorld_Active(task->world, k);
        if (IsInRanges(task->world, k) && !IsLarge(sheet)) {
            Relax(task, sheet, &none);
        }
    }
}

static void SumSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    KIRI_FROM_TO(k, start, end) {
        if (IsInRanges(task->world, k)) {
            kiriView_Sum(kiriWorld_Active(task->world, k));
        }
    }
}

static void EndSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    KIRI_FROM_TO(k, start, end) {
        kiriSheetData* sheet = kiriWorld_Active(task->world, k);
        if (IsInRanges(task->world, k)) {
            kiriView_EndWriting(sheet);
            kiriView_KeepBounds(sheet);
        }
    }
}

void kiriSkinStep_Run(kiriWorld* world, double dt)
{
    SkinTask task = { world, dt, kiriView_BlendRange };
    /* The surfaces of sheets that the budget left unmoved stay as last written. */
    KIRI_EACH_INDEX(k, world->active) {
        kiriMove* move = &world->moves.of.data[world->active.data[k]];
        move->isStill = move->progress == KIRI_MORE && kiriView_IsSettled(kiriWorld_Active(world, k));
    }
    ListRanges(world);
    kiriTasks_Run(&world->tasks, BeginSheets, world->active.count, 1, &task);
    if (world->skinRanges.count > 0) {
        kiriTasks_Run(&world->tasks, RunRanges, world->skinRanges.count, 1, &task);
        KIRI_EACH_INDEX(k, world->active) {
            if (IsInRanges(world, k) && IsLarge(kiriWorld_Active(world, k))) {
                Relax(&task, kiriWorld_Active(world, k), &world->tasks);
            }
        }
        kiriTasks_Run(&world->tasks, RelaxSheets, world->active.count, 1, &task);
        kiriWelds_Close(world); /* the last seam may have broken in this tick */
        kiriTasks_Run(&world->tasks, SumSheets, world->active.count, 1, &task);
        task.run = kiriView_WriteRange;
        kiriTasks_Run(&world->tasks, RunRanges, world->skinRanges.count, 1, &task);
        kiriTasks_Run(&world->tasks, EndSheets, world->active.count, 1, &task);
    }
    KIRI_EACH_INDEX(k, world->active) {
        if (!StoodStill(world, k) && !kiriWorld_Active(world, k)->rest.asleep) {
            kiriView_Trim(kiriWorld_Active(world, k));
        }
    }
}
