#include "kiri_touch.h"

#include "../core/kiri_sort.h"
#include "kiri_touch_memory.h"

#include <string.h>

#define CALM_SLOPE 1e-3  /* by how much the normal of a contact may change while a sheet falls asleep */
#define DEFAULT_PUSH 1.0 /* m/s */

/* ---- What is found ----------------------------------------------------------------------------------------------- */

static kiriVec3 WhereSeen(const kiriSheetData* sheet, const kiriTouch* touch)
{
    if (touch->point != KIRI_NONE) {
        return sheet->seen.exactPoints.data[touch->point];
    }
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    for (int n = 0; n < 3 && touch->vertex[n] != KIRI_NONE; ++n) {
        at = kiriVec3_AddScaled(at, touch->share[n], kiriSurface_At(&sheet->seen.surface, touch->vertex[n]));
    }
    return at;
}

#define KIRI_FAR_BELOW 1e9 /* m */

/* A cut may have come between the vertices of a touch: it is of the piece of the first. */
static kiriPiece* PieceOfTouch(const kiriSheetData* sheet, const kiriTouch* touch)
{
    if (touch->point != KIRI_NONE) {
        return kiriSheet_PieceOf(sheet, sheet->points.data[touch->point].frame);
    }
    int32_t first = sheet->vertexSkin.spans.data[touch->vertex[0]].first;
    return kiriSheet_PieceOf(sheet, kiriSheet_FrameOf(sheet, sheet->vertexSkin.weights.data[first].label));
}

static bool IsTouchFinite(const kiriTouch* touch)
{
    const kiriVec3 *n = &touch->normal, *v = &touch->velocity;
    double sum = touch->share[0] + touch->share[1] + touch->share[2] + touch->offset;
    sum += n->x + n->y + n->z + v->x + v->y + v->z;
    return sum - sum == 0.0;
}

/* Places and speeds of 1e30 and more come to what doubles cannot hold. Then nothing reaches the plane. */
static void Disarm(const kiriSheetData* sheet, kiriTouch* touch)
{
    const kiriVec3 up = { 0.0, 0.0, 1.0 }, none = { 0.0, 0.0, 0.0 };
    touch->share[0] = 1.0;
    touch->share[1] = touch->share[2] = 0.0;
    touch->normal = up;
    touch->velocity = none;
    touch->seen = WhereSeen(sheet, touch);
    touch->offset = touch->seen.z - KIRI_FAR_BELOW;
}

bool kiriTouches_Add(kiriSheetData* sheet, const kiriTouch* touch)
{
    kiriTouch found = *touch;
    found.row = KIRI_NONE;
    if (PieceOfTouch(sheet, touch)->isGone) {
        found.offset -= KIRI_FAR_BELOW; /* the host is told of each of its contacts */
    }
    KIRI_ASSERT(kiriSheet_IsActive(sheet));
    KIRI_ASSERT(touch->yield == KIRI_NONE || touch->yield < sheet->touches.yields.count);
    KIRI_ASSERT(touch->point != KIRI_NONE || touch->vertex[0] < sheet->seen.surface.vertexCount);
    found.seen = WhereSeen(sheet, touch);
    if (!IsTouchFinite(&found)) {
        Disarm(sheet, &found);
    }
    return kiriArray_Push(sheet->memory, &sheet->touches.found, found);
}

int32_t kiriTouches_AddYield(kiriSheetData* sheet, const kiriYieldRow* yield)
{
    return kiriArray_Push(sheet->memory, &sheet->touches.yields, *yield) ? sheet->touches.yields.count - 1 : KIRI_NONE;
}

int32_t kiriTouches_FindYield(const kiriSheetData* sheet, int64_t number)
{
    for (int32_t k = sheet->touches.yields.count - 1; k >= 0; --k) {
        if (sheet->touches.yields.data[k].number == number) {
            return k;
        }
    }
    return KIRI_NONE;
}

/* ---- What the host gave ------------------------------------------------------------------------------------------ */

#define OF_PLACE (UINT64_C(1) << 59) /* in a key: of a rest point, not of a collision point */

/* By point and obstacle. */
static uint64_t KeyOfGiven(const kiriSheetData* sheet, const kiriContact* contact)
{
    uint64_t kind = (uint64_t)KIRI_TOUCH_HOST << 60, obstacle = (uint64_t)(uint32_t)contact->obstacle & 0x1fffffu;
    if (contact->point >= 0) {
        return kind | obstacle << 32 | (uint32_t)contact->point;
    }
    kiriLatticePoint at;
    kiriSheet_ToLattice(sheet, contact->restPoint, &at);
    uint64_t place = ((uint64_t)(uint32_t)at.x * UINT64_C(0x9e3779b97f4a7c15)) ^
                     ((uint64_t)(uint32_t)at.y * UINT64_C(0xc2b2ae3d27d4eb4f));
    return kind | OF_PLACE | (obstacle << 32 ^ (place & UINT64_C(0x07ffffffffffffff)));
}

/* The contacts of one number share a yield row. Each says itself how it feels the mass. */
static bool FindYieldOf(kiriSheetData* sheet, const kiriContact* contact, int32_t* yield)
{
    int64_t number = -1 - (int64_t)(uint32_t)contact->obstacle;
    *yield = contact->inverseMass > 0.0f ? kiriTouches_FindYield(sheet, number) : KIRI_NONE;
    if (contact->inverseMass > 0.0f && *yield == KIRI_NONE) {
        kiriYieldRow row;
        memset(&row, 0, sizeof(row));
        row.number = number;
        row.inverseMass = contact->inverseMass;
        *yield = kiriTouches_AddYield(sheet, &row);
        return *yield != KIRI_NONE;
    }
    return true;
}

static bool AddGiven(kiriSheetData* sheet, const kiriGivenContact* given)
{
    const kiriContact* contact = &given->contact;
    kiriTouch touch;
    memset(&touch, 0, sizeof(touch));
    touch.key = KeyOfGiven(sheet, contact);
    touch.point = contact->point >= 0 ? contact->point : KIRI_NONE;
    memcpy(touch.vertex, given->vertex, sizeof(touch.vertex));
    memcpy(touch.share, given->share, sizeof(touch.share));
    touch.normal = kiriVec3_Normalize(kiriVec3_Load(contact->normal));
    touch.offset = contact->offset;
    touch.velocity = kiriVec3_Load(contact->velocity);
    touch.friction = contact->friction;
    touch.pushSpeed = contact->pushSpeed > 0.0f ? (double)contact->pushSpeed : DEFAULT_PUSH;
    touch.felt = contact->inverseMass;
    return FindYieldOf(sheet, contact, &touch.yield) && kiriTouches_Add(sheet, &touch);
}

static bool HasLowerGivenKey(const void* context, int32_t a, int32_t b)
{
    const kiriTouch* found = context;
    return found[a].key < found[b].key || (found[a].key == found[b].key && a < b);
}

/* Contacts at one point with one obstacle get different keys, in the order in which the host gave them: up to 64 of
   them. */
static void NumberRepeated(kiriTouches* touches)
{
    enum { MOST_REPEATED = 64 };
    kiriTouch* found = touches->found.data;
    KIRI_ASSERT(touches->order.capacity >= touches->found.count);
    for (int32_t i = 0; i < touches->found.count; ++i) {
        touches->order.data[i] = i;
    }
    kiriSort(touches->order.data, touches->found.count, HasLowerGivenKey, found);
    uint64_t last = 0, repeated = 0;
    for (int32_t k = 0; k < touches->found.count; ++k) {
        kiriTouch* touch = &found[touches->order.data[k]];
        repeated = k > 0 && touch->key == last ? repeated + 1 : 0;
        last = touch->key;
        touch->key ^= repeated % MOST_REPEATED << 53; /* above the obstacle */
    }
}

bool kiriTouches_Begin(kiriSheetData* sheet)
{
    bool ok = true;
    sheet->touches.found.count = sheet->touches.yields.count = sheet->touches.rows.count = 0;
    for (int32_t i = 0; ok && i < sheet->contacts.count; ++i) {
        ok = AddGiven(sheet, &sheet->contacts.data[i]);
    }
    if (ok && sheet->contacts.count > 1) {
        NumberRepeated(&sheet->touches);
    }
    return ok;
}

static bool ReserveMemory(kiriSheetData* sheet, kiriTouchMemory* memory, int64_t count)
{
    return kiriArray_Reserve(sheet->memory, &memory->touches, count) &&
           kiriArray_Reserve(sheet->memory, &memory->forces, count);
}

/* All may fall asleep, or wake, before the next touches are found. */
static bool RoomToRemember(kiriSheetData* sheet, int64_t count)
{
    kiriTouches* touches = &sheet->touches;
    int64_t all = count + touches->last.touches.count + touches->slept.touches.count;
    return ReserveMemory(sheet, &touches->last, all) && ReserveMemory(sheet, &touches->slept, all) &&
           kiriArray_Reserve(sheet->memory, &touches->order, all);
}

bool kiriTouches_Room(kiriSheetData* sheet, int64_t count)
{
    kiriTouches* touches = &sheet->touches;
    return kiriArray_Reserve(sheet->memory, &touches->found, count) &&
           kiriArray_Reserve(sheet->memory, &touches->yields, count) &&
           kiriArray_Reserve(sheet->memory, &touches->rows, count) && RoomToRemember(sheet, count) &&
           kiriSolver_ReserveContacts(sheet->solver, (int32_t)count);
}

bool kiriTouches_Reserve(kiriSheetData* sheet)
{
    return sheet->touches.found.count == 0 || kiriTouches_Room(sheet, sheet->touches.found.capacity);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

enum { MOST_BLENDED = 96 }; /* frames of three vertices */

typedef struct TouchBlend {
    kiriWeight weights[MOST_BLENDED];
    int32_t count;
    kiriVec2 at;
} TouchBlend;

static void AddWeights(TouchBlend* blend, const kiriSheetData* sheet, const kiriSkin* skin, int32_t sample,
                       double share)
{
    kiriSpan span = skin->spans.data[sample];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        kiriSampleWeight weight = skin->weights.data[k];
        int32_t n = 0, frame = kiriSheet_FrameOf(sheet, weight.label);
        while (n < blend->count && blend->weights[n].frame != frame) {
            ++n;
        }
        if (n < blend->count) {
            blend->weights[n].value += share * weight.value;
        } else if (n < MOST_BLENDED) {
            blend->weights[n].frame = frame;
            blend->weights[n].value = share * weight.value;
            blend->count += 1;
        }
    }
}

static TouchBlend BlendOf(const kiriSheetData* sheet, const kiriTouch* touch)
{
    TouchBlend blend;
    blend.count = 0;
    if (touch->point != KIRI_NONE) {
        blend.at = kiriMesh_Local(&sheet->mesh, sheet->points.data[touch->point].at);
        AddWeights(&blend, sheet, &sheet->pointSkin, touch->point, 1.0);
        return blend;
    }
    blend.at = kiriVec2_Make(0.0, 0.0);
    for (int n = 0; n < 3 && touch->vertex[n] != KIRI_NONE; ++n) {
        kiriVec2 corner = kiriMesh_Local(&sheet->mesh, sheet->mesh.vertices.data[touch->vertex[n]].at);
        blend.at = kiriVec2_Add(blend.at, kiriVec2_Scale(touch->share[n], corner));
        AddWeights(&blend, sheet, &sheet->vertexSkin, touch->vertex[n], touch->share[n]);
    }
    return blend;
}

/* The largest first; of equal ones the lower frame. */
static void TakeLargest(TouchBlend* blend, int32_t n)
{
    int32_t best = n;
    for (int32_t k = n + 1; k < blend->count; ++k) {
        const kiriWeight *a = &blend->weights[k], *b = &blend->weights[best];
        best = a->value > b->value || (a->value == b->value && a->frame < b->frame) ? k : best;
    }
    kiriWeight largest = blend->weights[best];
    blend->weights[best] = blend->weights[n];
    blend->weights[n] = largest;
}

/* A cut may have come between the vertices of a touch: then the piece with the largest weight has the contact. */
static void WriteWeights(const kiriSheetData* sheet, TouchBlend* blend, kiriContactRow* row)
{
    double sum = 0.0;
    row->weightCount = 0;
    for (int32_t n = 0; n < blend->count && row->weightCount < KIRI_CONTACT_WEIGHTS; ++n) {
        TakeLargest(blend, n);
        const int32_t* piece = sheet->layout.framePiece.data;
        kiriWeight weight = blend->weights[n];
        if (weight.value > 0.0 && (n == 0 || piece[weight.frame] == piece[row->weights[0].frame])) {
            row->weights[row->weightCount++] = weight;
            sum += weight.value;
        }
    }
    KIRI_ASSERT(row->weightCount > 0);
    for (int32_t n = 0; n < row->weightCount; ++n) {
        row->weights[n].value /= sum;
    }
}

static void WriteContactRow(const kiriSheetData* sheet, const kiriTouch* touch, kiriContactRow* row)
{
    TouchBlend blend = BlendOf(sheet, touch);
    memset(row, 0, sizeof(*row));
    row->key = touch->key;
    row->at = blend.at;
    row->normal = touch->normal;
    row->velocity = touch->velocity;
    row->friction = touch->friction;
    row->pushSpeed = touch->pushSpeed;
    row->yield = touch->yield;
    row->felt = touch->felt;
    row->cushion = touch->cushion;
    row->force = kiriTouches_ForceOf(sheet, touch->key);
    WriteWeights(sheet, &blend, row);
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    for (int32_t n = 0; n < row->weightCount; ++n) {
        const kiriFrameData* frame = &sheet->frames.data[row->weights[n].frame];
        at = kiriVec3_AddScaled(at, row->weights[n].value, kiriFrame_Carry(frame, row->at));
    }
    row->offset = touch->offset + kiriVec3_Dot(row->normal, kiriVec3_Sub(at, touch->seen));
}

void kiriTouches_WriteRows(kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    KIRI_ASSERT(touches->rows.capacity >= touches->found.count);
    touches->rows.count = 0;
    for (int32_t i = 0; i < touches->found.count; ++i) {
        kiriTouch* touch = &touches->found.data[i];
        kiriContactRow* row = &touches->rows.data[touches->rows.count];
        WriteContactRow(sheet, touch, row);
        bool isAwake = kiriSheet_Moves(sheet, row->weights[0].frame);
        touch->row = isAwake ? touches->rows.count : KIRI_NONE;
        touches->rows.count += isAwake;
    }
}

/* ---- What is remembered ------------------------------------------------------------------------------------------ */

kiriVec3 kiriTouches_ForceOf(const kiriSheetData* sheet, uint64_t key)
{
    kiriVec3 force = { 0.0, 0.0, 0.0 };
    if (!kiriTouchMemory_Find(&sheet->touches.last, key, &force)) {
        kiriTouchMemory_Find(&sheet->touches.slept, key, &force);
    }
    return force;
}

static bool IsRowBefore(const void* context, int32_t a, int32_t b)
{
    const kiriTouches* touches = context;
    uint64_t first = touches->rows.data[a].key, second = touches->rows.data[b].key;
    return first < second || (first == second && a < b);
}

static void SortForces(kiriTouches* touches)
{
    KIRI_ASSERT(touches->order.capacity >= touches->rows.count);
    KIRI_ASSERT(touches->last.forces.capacity >= touches->rows.count);
    touches->order.count = touches->last.forces.count = 0;
    for (int32_t i = 0; i < touches->rows.count; ++i) {
        if (kiriVec3_Dot(touches->rows.data[i].force, touches->rows.data[i].normal) > 0.0) {
            touches->order.data[touches->order.count++] = i;
        }
    }
    kiriSort(touches->order.data, touches->order.count, IsRowBefore, touches);
    for (int32_t k = 0; k < touches->order.count; ++k) {
        const kiriContactRow* row = &touches->rows.data[touches->order.data[k]];
        kiriTouchForce force = { row->key, row->force };
        touches->last.forces.data[touches->last.forces.count++] = force;
    }
}

void kiriTouches_End(kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    SortForces(touches);
    KIRI_ASSERT(touches->last.touches.capacity >= touches->found.count);
    touches->last.touches.count = touches->last.given = 0;
    for (int32_t i = 0; i < touches->found.count; ++i) {
        if (touches->found.data[i].row != KIRI_NONE) {
            touches->last.touches.data[touches->last.touches.count++] = touches->found.data[i];
            touches->last.given += kiriTouch_IsOfKind(&touches->found.data[i], KIRI_TOUCH_HOST);
        }
    }
}

void kiriTouches_Clear(kiriSheetData* sheet)
{
    sheet->touches.last.forces.count = sheet->touches.last.touches.count = sheet->touches.last.given = 0;
    sheet->touches.rows.count = 0;
    for (int32_t i = 0; i < sheet->touches.found.count; ++i) {
        sheet->touches.found.data[i].row = KIRI_NONE;
    }
}

/* ---- Sleep ------------------------------------------------------------------------------------------------------- */

/* Those of pieces that are not moved, or of the others, go over; and those of pieces that are gone go. */
static void MoveTouches(kiriSheetData* sheet, kiriTouchMemory* from, kiriTouchMemory* to, bool areMoved)
{
    int32_t kept = 0, given = 0, before = to->touches.count;
    for (int32_t i = 0; i < from->touches.count; ++i) {
        kiriTouch touch = from->touches.data[i];
        const kiriPiece* piece = PieceOfTouch(sheet, &touch);
        if (piece->isGone) {
            kiriTouchMemory_Take(from, touch.key);
        } else if (kiriPiece_IsMoved(piece) == areMoved) {
            kiriTouchMemory_Add(to, &touch, kiriTouchMemory_Take(from, touch.key));
        } else {
            from->touches.data[kept++] = touch;
            given += kiriTouch_IsOfKind(&touch, KIRI_TOUCH_HOST);
        }
    }
    from->touches.count = kept;
    from->given = given;
    kiriTouchMemory_DropTaken(from);
    kiriTouchMemory_SortForces(to, before, &sheet->touches.order);
}

void kiriTouches_Sort(kiriSheetData* sheet)
{
    sheet->touches.rests.areSummed = false;
    MoveTouches(sheet, &sheet->touches.last, &sheet->touches.slept, false);
    MoveTouches(sheet, &sheet->touches.slept, &sheet->touches.last, true);
}

/* Touches are found anew each tick, where a sheet that hardly moves is seen: a plane that passes the point as near as
   the sheet may have gone meanwhile is the same. */
static bool IsSame(const kiriSheetData* sheet, const kiriTouch* a, const kiriTouch* b)
{
    kiriVec3 tilt = kiriVec3_Sub(b->normal, a->normal), faster = kiriVec3_Sub(b->velocity, a->velocity);
    double rise = b->offset - a->offset - kiriVec3_Dot(tilt, b->seen);
    return a->key == b->key && a->friction == b->friction && kiriVec3_Length(tilt) <= CALM_SLOPE &&
           fabs(rise) <= KIRI_CALM_SECONDS * sheet->settings.sleepSpeed &&
           kiriVec3_Length(faster) <= sheet->settings.sleepSpeed;
}

/* Of all that are found, then of those of the last tick, then of those of pieces that sleep. */
static const kiriTouch* TouchAt(const kiriTouches* touches, int32_t i)
{
    int32_t last = i - touches->found.count, slept = last - touches->last.touches.count;
    return last < 0    ? &touches->found.data[i]
           : slept < 0 ? &touches->last.touches.data[last]
                       : &touches->slept.touches.data[slept];
}

static bool HasLowerTouchKey(const void* context, int32_t a, int32_t b)
{
    uint64_t first = TouchAt(context, a)->key, second = TouchAt(context, b)->key;
    return first < second || (first == second && a < b);
}

/* By key: the host's contacts of pieces that are calm, those found first. */
static void ListCalm(kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    int32_t count = touches->found.count + touches->last.touches.count + touches->slept.touches.count;
    touches->order.count = 0;
    for (int32_t i = 0; i < count; ++i) {
        const kiriTouch* touch = TouchAt(touches, i);
        if (kiriTouch_IsOfKind(touch, KIRI_TOUCH_HOST) && PieceOfTouch(sheet, touch)->rest.calm >= KIRI_CALM_SECONDS) {
            KIRI_ASSERT(touches->order.count < touches->order.capacity);
            touches->order.data[touches->order.count++] = i;
        }
    }
    if (touches->order.count > 1) {
        kiriSort(touches->order.data, touches->order.count, HasLowerTouchKey, touches);
    }
}

/* Has each of one key that was found its like among those remembered, in their order, and none is left? */
static bool AreSame(const kiriSheetData* sheet, const int32_t* order, int32_t count)
{
    const kiriTouches* touches = &sheet->touches;
    int32_t found = 0;
    while (found < count && order[found] < touches->found.count) {
        ++found;
    }
    bool same = 2 * found == count;
    for (int32_t n = 0; same && n < found; ++n) {
        same = IsSame(sheet, TouchAt(touches, order[found + n]), TouchAt(touches, order[n]));
    }
    return same;
}

int32_t kiriTouch_Piece(const kiriSheetData* sheet, const kiriTouch* touch)
{
    return (int32_t)(PieceOfTouch(sheet, touch) - sheet->layout.pieces.data);
}

bool kiriTouches_NextNew(kiriSheetData* sheet, int32_t* at, int32_t* piece)
{
    const kiriTouches* touches = &sheet->touches;
    if (sheet->contacts.count + touches->last.given + touches->slept.given == 0) {
        return false;
    }
    if (*at == 0) {
        ListCalm(sheet);
    }
    const int32_t* order = touches->order.data;
    while (*at < touches->order.count) {
        int32_t first = *at;
        uint64_t key = TouchAt(touches, order[first])->key;
        while (*at < touches->order.count && TouchAt(touches, order[*at])->key == key) {
            *at += 1;
        }
        if (!AreSame(sheet, order + first, *at - first)) {
            *piece = kiriTouch_Piece(sheet, TouchAt(touches, order[first]));
            return true;
        }
    }
    return false;
}

/* The key of a collision point has its index. */
bool kiriTouch_Follow(kiriTouch* touch, const kiriKeep* points, const kiriKeep* vertices)
{
    if (!kiriTouch_IsOfKind(touch, KIRI_TOUCH_HOST)) {
        return false;
    }
    if (touch->point != KIRI_NONE) {
        touch->point = kiriKeep_To(points, touch->point);
        touch->key = (touch->key & ~UINT64_C(0xffffffff)) | (uint32_t)touch->point;
        return touch->point != KIRI_NONE;
    }
    for (int n = 0; n < 3; ++n) {
        touch->vertex[n] = kiriKeep_To(vertices, touch->vertex[n]);
        if (touch->vertex[n] == KIRI_NONE) {
            return false;
        }
    }
    return true;
}

/* ---- What the host is told --------------------------------------------------------------------------------------- */

/* The host's contacts come first among the touches. */
static void TellOne(const kiriSheetData* sheet, int32_t i, double dt, kiriContactForce* told)
{
    const kiriTouch* touch = &sheet->touches.found.data[i];
    const kiriContact* contact = &sheet->contacts.data[i].contact;
    kiriVec3 at = touch->seen, impulse = kiriVec3_Scale(dt, kiriTouches_ForceOf(sheet, touch->key));
    kiriVec3 way = kiriVec3_Make(0.0, 0.0, 0.0);
    if (touch->row != KIRI_NONE) {
        const kiriContactRow* row = &sheet->touches.rows.data[touch->row];
        kiriVec3 now = { 0.0, 0.0, 0.0 };
        for (int32_t n = 0; n < row->weightCount; ++n) {
            kiriVec3 x = kiriFrame_Carry(&sheet->frames.data[row->weights[n].frame], row->at);
            now = kiriVec3_AddScaled(now, row->weights[n].value, x);
        }
        /* The seen point is off the frames' blend by as much as the plane was moved. */
        at = kiriVec3_AddScaled(now, touch->offset - row->offset, row->normal);
        impulse = row->impulse;
        way = row->way;
    }
    kiriVec3_StoreDoubles(told->impulse, impulse);
    kiriVec3_StoreDoubles(told->position, at);
    told->depth = touch->offset + kiriVec3_Dot(touch->normal, way) - kiriVec3_Dot(touch->normal, at);
    told->point = contact->point;
    told->obstacle = contact->obstacle;
}

void kiriTouches_Tell(kiriSheetData* sheet, double dt)
{
    kiriTouches* touches = &sheet->touches;
    KIRI_ASSERT(touches->nextTold.capacity >= sheet->contacts.count);
    touches->nextTold.count = sheet->contacts.count;
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        TellOne(sheet, i, dt, &touches->nextTold.data[i]);
    }
    kiriArrayHeader told = kiriArray_GetHeader(&touches->told);
    kiriArray_SetHeader(&touches->told, kiriArray_GetHeader(&touches->nextTold));
    kiriArray_SetHeader(&touches->nextTold, told);
    sheet->contacts.count = 0;
}
