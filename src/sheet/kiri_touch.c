#include "kiri_touch.h"
#include "../core/kiri_array.h"
#include "kiri_piece.h"
#include "kiri_seen.h"

/* ---- The sheet as a whole ---------------------------------------------------------------------------------------- */

kiriBox kiriSheet_Box(const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    if (kiriBounds_IsFresh(sheet->seen.bounds, surface)) {
        return kiriBounds_All(sheet->seen.bounds);
    }
    kiriBox box = KIRI_EMPTY_BOX;
    KIRI_TIMES(v, surface->vertexCount) {
        kiriBox_Add(&box, kiriSurface_At(surface, v));
    }
    return box;
}

double kiriSheet_SpeedLimit(const kiriSheetData* sheet, const kiriBox* box)
{
    double fastest = 0.0;
    KIRI_EACH_INDEX(i, sheet->frames) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        if (kiriSheet_PieceOf(sheet, i)->rest.asleep) {
            continue;
        }
        double turn = kiriVec3_Length(frame->spin) + kiriVec3_Length(frame->rate.u) + kiriVec3_Length(frame->rate.v);
        /* The farthest point that the frame carries: six radii of gyration of its region, or the corner of the box. */
        double corner = kiriBox_Farthest(box, frame->x), square = frame->inertia[0] + frame->inertia[2];
        double radius = frame->mass > 0.0 ? 6.0 * kiriRoot(square / frame->mass) : corner;
        double speed = kiriVec3_Length(frame->velocity) + turn * kiriMin(radius, corner);
        fastest = kiriMax(speed, fastest);
    }
    return fastest;
}

double kiriReach_Of(double speed, kiriVec3 gravity, double dt)
{
    return 2.0 * dt * (speed + dt * kiriVec3_Length(gravity));
}

int32_t kiriSkin_LeadingFrame(const kiriSkin* skin, int32_t sample)
{
    kiriSpan span = skin->spans.data[sample];
    const kiriSampleWeight *weights = &skin->weights.data[span.first], *end = weights + span.count, *most = weights;
    float value = weights->value;
    for (const kiriSampleWeight* at = weights + 1; at < end; ++at) {
        float other = at->value;
        most = other > value ? at : most;
        value = other > value ? other : value;
    }
    return most->frame;
}

/* ---- Choice ---- */

enum { INSIDE = 4, PROBES_A_FRAME = 6 };

/* A block of size x size grid squares; it has one probe inside a piece. */
typedef struct Block {
    int32_t size, column, row;
} Block;

/* The best vertex so far of a piece in the current block: on its border in a quarter of the block, or inside. */
typedef struct Choice {
    int32_t piece, quarter, vertex;
    double rank; /* lower is better */
} Choice;

typedef KIRI_ARRAY(Choice) Choices;

static bool ConsiderVertex(const kiriSheetData* sheet, kiriMemory* scratch, Choices* choices, const Block* block,
                           int32_t vertex)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    kiriLatticePoint at = sheet->mesh.vertices.data[vertex].at;
    kiriLatticePoint corner = kiriSquares_Corner(squares, block->row * squares->columns + block->column);
    int64_t half = (int64_t)block->size * squares->side / 2;
    Choice choice = { sheet->probes.vertexPiece.data[vertex], INSIDE, vertex, 1.0 };
    if (sheet->probes.isBorder.data[vertex]) { /* a sharper corner of the border has a lower rank */
        kiriVec2 lean = kiriVec2_Scale(0.125, sheet->probes.leans.data[vertex]);
        choice.quarter = (at.x - corner.x >= half) + 2 * (at.y - corner.y >= half);
        choice.rank = kiriVec2_Dot(lean, lean);
    }
    KIRI_EACH(Choice, other, *choices) {
        if (other->piece == choice.piece && other->quarter == choice.quarter) {
            bool isBetter = choice.rank < other->rank || (choice.rank == other->rank && vertex < other->vertex);
            *other = isBetter ? choice : *other;
            return true;
        }
    }
    return kiriArray_Push(scratch, choices, choice);
}

static bool ChooseInBlock(kiriSheetData* sheet, kiriMemory* scratch, Choices* choices, const Block* block)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    bool ok = true;
    choices->count = 0;
    for (int32_t y = block->row; y < block->row + block->size && y < squares->rows; ++y) {
        for (int32_t x = block->column; x < block->column + block->size && x < squares->columns; ++x) {
            int32_t v = squares->vertexHead[y * squares->columns + x];
            for (; ok && v != KIRI_NONE; v = sheet->mesh.vertices.data[v].next) {
                ok = ConsiderVertex(sheet, scratch, choices, block, v);
            }
        }
    }
    KIRI_TIMES_WHILE(ok, i, choices->count) {
        const Choice* choice = &choices->data[i]; /* the inside needs no probe if the border has one */
        bool hasBorder = false;
        KIRI_EACH(const Choice, other, *choices) {
            hasBorder |= other->piece == choice->piece && other->quarter != INSIDE;
        }
        sheet->probes.isChosen.data[choice->vertex] = choice->quarter != INSIDE || !hasBorder;
    }
    return ok;
}

/* Lists the probes by the group of their vertex, then by index. */
static bool ListChosen(kiriSheetData* sheet, const int32_t* ofVertex, int32_t groups, kiriPieceRow* row)
{
    const kiriProbes* probes = &sheet->probes;
    if (!kiriArray_Resize(sheet->memory, &row->first, groups + 2)) {
        return false;
    }
    int32_t *first = row->first.data, count = 0;
    memset(first, 0, sizeof(int32_t) * (size_t)(groups + 2));
    KIRI_EACH_INDEX(v, probes->isChosen) {
        first[ofVertex[v] + 2] += probes->isChosen.data[v];
        count += probes->isChosen.data[v];
    }
    KIRI_TIMES(g, groups) {
        first[g + 2] += first[g + 1];
    }
    if (!kiriArray_Resize(sheet->memory, &row->items, count)) {
        return false;
    }
    KIRI_EACH_INDEX(v, probes->isChosen) {
        if (probes->isChosen.data[v]) {
            row->items.data[first[ofVertex[v] + 1]++] = v;
        }
    }
    return true;
}

/* Marks the vertices of the border, and adds the normals of border edges to their leans. */
static void MarkBorder(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    KIRI_EACH(const kiriTriangle, triangle, sheet->mesh.triangles) {
        KIRI_TIMES(i, 3) {
            if ((triangle->marks >> i & 1) != 0 || triangle->twin[i] == KIRI_NONE) {
                int32_t from = triangle->vertex[i], to = triangle->vertex[(i + 1) % 3];
                kiriVec2 along = kiriMesh_Direction(&sheet->mesh, from, to), left = kiriVec2_Make(-along.y, along.x);
                probes->isBorder.data[from] = probes->isBorder.data[to] = 1;
                probes->leans.data[from] = kiriVec2_Add(probes->leans.data[from], left);
                probes->leans.data[to] = kiriVec2_Add(probes->leans.data[to], left);
            }
        }
    }
}

static bool MarkVertices(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    int32_t vertices = sheet->mesh.vertices.count;
    if (!kiriArrays_Resize(sheet->memory, vertices, &probes->vertexPiece, &probes->isBorder, &probes->leans,
                           &probes->isChosen) ||
        !kiriArray_Resize(sheet->memory, &probes->touch, 2 * (int64_t)vertices) ||
        !kiriArrays_Resize(sheet->memory, sheet->layout.pieces.count, &probes->boxes, &probes->speeds)) {
        return false;
    }
    probes->areGrouped = false;
    KIRI_TIMES(v, vertices) {
        probes->vertexPiece.data[v] = kiriPiece_OfVertex(sheet, v);
        probes->isBorder.data[v] = probes->isChosen.data[v] = 0;
        probes->leans.data[v] = kiriVec2_Make(0.0, 0.0);
    }
    MarkBorder(sheet);
    return true;
}

/* Adds the farthest vertex in each quarter of a frame, round its centre of mass, that has no probe: a piece lies on probes on all
   sides, however small or narrow it is. */
static bool ChooseInQuarters(kiriSheetData* sheet, kiriMemory* scratch)
{
    Choices quarters = { NULL, 0, 0 };
    if (!kiriArray_Resize(scratch, &quarters, 4 * (int64_t)sheet->frames.count)) {
        return false;
    }
    KIRI_EACH(Choice, quarter, quarters) {
        quarter->vertex = KIRI_NONE;
        quarter->rank = HUGE_VAL;
    }
    KIRI_EACH_INDEX(v, sheet->probes.isChosen) {
        int32_t f = kiriSkin_LeadingFrame(&sheet->vertexSkin, v);
        kiriVec2 from = kiriVec2_Sub(sheet->seen.surface.rest.data[v], sheet->frames.data[f].center);
        double rank = sheet->probes.isChosen.data[v] ? -HUGE_VAL : -kiriVec2_Dot(from, from);
        KIRI_ASSERT_HAS(sheet->frames, f);
        Choice* quarter = &quarters.data[4 * f + (from.x >= 0.0) + 2 * (from.y >= 0.0)];
        quarter->vertex = rank < quarter->rank ? v : quarter->vertex;
        quarter->rank = kiriMin(rank, quarter->rank);
    }
    KIRI_EACH(const Choice, quarter, quarters) {
        if (quarter->vertex != KIRI_NONE) {
            sheet->probes.isChosen.data[quarter->vertex] = 1;
        }
    }
    return true;
}

static bool ChooseProbes(kiriSheetData* sheet)
{
    kiriMemory scratch = kiriMemory_Like(sheet->memory);
    Choices choices = { NULL, 0, 0 };
    bool ok = MarkVertices(sheet);
    Block block = { sheet->probes.block, 0, 0 };
    for (; ok && block.row < sheet->mesh.squares.rows; block.row += block.size) {
        for (block.column = 0; ok && block.column < sheet->mesh.squares.columns; block.column += block.size) {
            ok = ChooseInBlock(sheet, &scratch, &choices, &block);
        }
    }
    ok = ok && ChooseInQuarters(sheet, &scratch);
    kiriMemory_FreeAll(&scratch);
    return ok && ListChosen(sheet, sheet->probes.vertexPiece.data, sheet->layout.pieces.count, &sheet->probes.list) &&
           kiriArray_Resize(sheet->memory, &sheet->probes.velocities, sheet->probes.list.items.count);
}

/* ---- Where they are ---- */

kiriVec3 kiriProbe_Velocity(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec2 local = sheet->seen.surface.rest.data[vertex];
    kiriVec3 velocity = { 0 };
    KIRI_EACH_IN(i, span) {
        kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
        velocity = kiriVec3_AddScaled(
            velocity, weight.value,
            kiriFrame_VelocityAt(&sheet->frames.data[weight.frame], local));
    }
    return velocity;
}

static void BoundPieces(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    KIRI_EACH_INDEX(p, probes->boxes) {
        probes->boxes.data[p] = KIRI_EMPTY_BOX;
    }
    KIRI_EACH_INDEX(v, probes->vertexPiece) {
        kiriBox_Add(&probes->boxes.data[probes->vertexPiece.data[v]], kiriSurface_At(&sheet->seen.surface, v));
    }
}

static void MeasureVelocities(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        kiriSpan span = kiriPieceRow_Of(&probes->list, p);
        double most = 0.0;
        KIRI_EACH_IN(i, span) {
            probes->velocities.data[i] = kiriProbe_Velocity(sheet, probes->list.items.data[i]);
            double squared = kiriVec3_Dot(probes->velocities.data[i], probes->velocities.data[i]);
            most = kiriMax(squared, most);
        }
        probes->speeds.data[p] = sqrt(most);
    }
}

bool kiriProbes_Remake(kiriSheetData* sheet)
{
    if (!ChooseProbes(sheet)) {
        return false;
    }
    BoundPieces(sheet);
    MeasureVelocities(sheet);
    return true;
}

bool kiriProbes_Update(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    double squares = (double)sheet->grid.cellCount / (sheet->frames.count * (double)PROBES_A_FRAME);
    if (!probes->isFresh) {
        probes->block = 1;
        while ((double)(probes->block + 1) * (probes->block + 1) <= squares) {
            ++probes->block;
        }
        probes->isFresh = kiriProbes_Remake(sheet);
    } else if (!sheet->rest.asleep) {
        BoundPieces(sheet);
        MeasureVelocities(sheet);
    }
    return probes->isFresh;
}

int32_t kiriTouchMemory_FirstFrom(const kiriTouchMemory* memory, uint64_t key)
{
    int32_t low;
    KIRI_SEARCH(low, 0, memory->forces.count, memory->forces.data[middle].key < key);
    return low;
}

void kiriTouchMemory_Add(kiriTouchMemory* memory, const kiriTouch* touch, kiriVec3 force)
{
    memory->given += kiriTouch_IsOfKind(touch, KIRI_TOUCH_HOST);
    memory->touches.data[memory->touches.count] = *touch;
    KIRI_NEXT(memory->touches).force = force;
}

static bool IsKeyBefore(const void* context, int32_t a, int32_t b)
{
    const kiriTouch* touches = context;
    return touches[a].key < touches[b].key || (touches[a].key == touches[b].key && a < b);
}

/* Merges new forces into the sorted ones, from the end on, so that each moves once. Older forces come first among equal
   keys. */
static void MergeForces(kiriTouchMemory* memory, const int32_t* order, int32_t count)
{
    int32_t left = memory->forces.count;
    memory->forces.count += count;
    KIRI_ASSERT(memory->forces.count <= memory->forces.capacity);
    for (int32_t to = memory->forces.count - 1; count > 0; --to) {
        const kiriTouch* added = &memory->touches.data[order[count - 1]];
        if (left > 0 && memory->forces.data[left - 1].key > added->key) {
            memory->forces.data[to] = memory->forces.data[--left];
        } else {
            memory->forces.data[to].key = added->key;
            memory->forces.data[to].force = added->force;
            memory->forces.data[to].normal = added->normal;
            count -= 1;
        }
    }
}

void kiriTouchMemory_SortForces(kiriTouchMemory* memory, int32_t first, kiriIndices* order)
{
    order->count = 0;
    KIRI_FROM_TO(i, first, memory->touches.count) {
        kiriVec3 force = memory->touches.data[i].force;
        if (kiriVec3_Dot(force, force) > 0.0) {
            KIRI_NEXT(*order) = i;
        }
    }
    kiriSort(order->data, order->count, IsKeyBefore, memory->touches.data);
    MergeForces(memory, order->data, order->count);
}

static bool IsNone(kiriVec3 force)
{
    return force.x == 0.0 && force.y == 0.0 && force.z == 0.0;
}

kiriVec3 kiriTouchMemory_Take(kiriTouchMemory* memory, uint64_t key)
{
    const kiriVec3 none = { 0 };
    for (int32_t at = kiriTouchMemory_FirstFrom(memory, key); at < memory->forces.count && memory->forces.data[at].key == key; ++at) {
        kiriVec3 force = memory->forces.data[at].force;
        if (!IsNone(force)) {
            memory->forces.data[at].force = none;
            return force;
        }
    }
    return none;
}

void kiriTouchMemory_DropTaken(kiriTouchMemory* memory)
{
    KIRI_KEEP_IF(const kiriTouchForce, force, memory->forces, !IsNone(force->force));
}

#define CALM_SLOPE 1e-3  /* largest change of a contact normal while a sheet falls asleep */
#define DEFAULT_PUSH 1.0 /* m/s */

/* ---- Adding touches ---------------------------------------------------------------------------------------------- */

kiriVec3 kiriTouch_Seen(const kiriSheetData* sheet, const kiriTouch* touch)
{
    KIRI_ASSERT(touch->point < sheet->points.count);
    return touch->point != KIRI_NONE ? sheet->seen.exactPoints.data[touch->point]
                                     : kiriSurface_Blend(&sheet->seen.surface, touch->vertex, touch->share);
}

#define KIRI_FAR_BELOW 1e9 /* m */

/* Returns the piece of the first vertex: a cut may have separated the vertices of a touch. */
static kiriPiece* PieceOfTouch(const kiriSheetData* sheet, const kiriTouch* touch)
{
    if (touch->point != KIRI_NONE) {
        return kiriSheet_PieceOf(sheet, sheet->points.data[touch->point].frame);
    }
    int32_t first = sheet->vertexSkin.spans.data[touch->vertex[0]].first;
    return kiriSheet_PieceOf(sheet, sheet->vertexSkin.weights.data[first].frame);
}

bool kiriTouches_Add(kiriSheetData* sheet, const kiriTouch* touch)
{
    kiriTouch found = *touch;
    found.row = KIRI_NONE;
    if (PieceOfTouch(sheet, touch)->isGone) {
        found.offset -= KIRI_FAR_BELOW; /* stays in the list: each contact of the host has a result */
    }
    KIRI_ASSERT(kiriSheet_IsActive(sheet));
    KIRI_ASSERT(touch->yield == KIRI_NONE || touch->yield < sheet->touches.yields.count);
    KIRI_ASSERT(touch->point != KIRI_NONE || touch->vertex[0] < sheet->seen.surface.vertexCount);
    found.seen = kiriTouch_Seen(sheet, touch);
    found.on = kiriTouch_IsOfKind(touch, KIRI_TOUCH_OBSTACLE) ? touch->on : found.seen;
    const kiriVec3 *n = &found.normal, *v = &found.velocity;
    double sum = found.share[0] + found.share[1] + found.share[2] + found.offset;
    sum += n->x + n->y + n->z + v->x + v->y + v->z;
    if (!(sum - sum == 0.0)) {
        /* It overflowed (positions or speeds near 1e30): nothing reaches its plane. */
        found.share[0] = 1.0;
        found.share[1] = found.share[2] = 0.0;
        found.normal = kiriVec3_Make(0.0, 0.0, 1.0);
        found.velocity = kiriVec3_Make(0.0, 0.0, 0.0);
        found.on = found.seen = kiriTouch_Seen(sheet, &found);
        found.offset = found.seen.z - KIRI_FAR_BELOW;
    }
    return kiriArray_Push(sheet->memory, &sheet->touches.found, found);
}

int32_t kiriTouches_AddYield(kiriSheetData* sheet, const kiriYieldRow* yield)
{
    return kiriArray_Push(sheet->memory, &sheet->touches.yields, *yield) ? sheet->touches.yields.count - 1 : KIRI_NONE;
}

int32_t kiriTouches_FindYield(const kiriSheetData* sheet, int64_t number)
{
    KIRI_EACH_INDEX_BACK(k, sheet->touches.yields) {
        if (sheet->touches.yields.data[k].number == number) {
            return k;
        }
    }
    return KIRI_NONE;
}

/* ---- Contacts of the host ---------------------------------------------------------------------------------------- */

#define OF_PLACE (UINT64_C(1) << 59) /* key bit: the item is a rest point, not a collision point */

/* Returns the key of a contact, from its point and obstacle. */
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

/* Finds or adds the yield row that contacts with the same obstacle number share. Each contact has its own inverse
   mass. */
static bool FindYieldOf(kiriSheetData* sheet, const kiriContact* contact, int32_t* yield)
{
    int64_t number = -1 - (int64_t)(uint32_t)contact->obstacle;
    *yield = contact->inverseMass > 0.0f ? kiriTouches_FindYield(sheet, number) : KIRI_NONE;
    if (contact->inverseMass > 0.0f && *yield == KIRI_NONE) {
        kiriYieldRow row;
        KIRI_CLEAR(&row);
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
    KIRI_CLEAR(&touch);
    touch.key = KeyOfGiven(sheet, contact);
    touch.point = contact->point >= 0 ? contact->point : KIRI_NONE;
    memcpy(touch.vertex, given->vertex, sizeof(touch.vertex));
    memcpy(touch.share, given->share, sizeof(touch.share));
    touch.normal = kiriVec3_Normalize(kiriVec3_Load(contact->normal));
    touch.offset = contact->offset;
    touch.velocity = kiriVec3_Load(contact->velocity);
    touch.friction = contact->friction;
    touch.pushSpeed = contact->pushSpeed > 0.0f ? contact->pushSpeed : DEFAULT_PUSH;
    touch.felt = contact->inverseMass;
    return FindYieldOf(sheet, contact, &touch.yield) && kiriTouches_Add(sheet, &touch);
}

/* Makes the keys of up to 64 contacts at one point with one obstacle different, in the order of the host. */
static void NumberRepeated(kiriTouches* touches)
{
    enum { MOST_REPEATED = 64 };
    kiriTouch* found = touches->found.data;
    KIRI_ASSERT(touches->order.capacity >= touches->found.count);
    KIRI_EACH_INDEX(i, touches->found) {
        touches->order.data[i] = i;
    }
    kiriSort(touches->order.data, touches->found.count, IsKeyBefore, found);
    uint64_t last = 0, repeated = 0;
    KIRI_EACH_INDEX(k, touches->found) {
        kiriTouch* touch = &found[touches->order.data[k]];
        repeated = k > 0 && touch->key == last ? repeated + 1 : 0;
        last = touch->key;
        touch->key ^= repeated % MOST_REPEATED << 53; /* bits above the obstacle number */
    }
}

bool kiriTouches_Begin(kiriSheetData* sheet)
{
    bool ok = true;
    sheet->touches.found.count = sheet->touches.yields.count = sheet->touches.rows.count = 0;
    KIRI_EACH_WHILE(ok, const kiriGivenContact, contact, sheet->contacts) {
        ok = AddGiven(sheet, contact);
    }
    if (ok && sheet->contacts.count > 1) {
        NumberRepeated(&sheet->touches);
    }
    return ok;
}

static bool ReserveMemory(kiriSheetData* sheet, kiriTouchMemory* memory, int64_t count)
{
    return kiriArrays_Reserve(sheet->memory, count, &memory->touches, &memory->forces);
}

bool kiriTouches_Room(kiriSheetData* sheet, int64_t count)
{
    kiriTouches* touches = &sheet->touches;
    /* All may fall asleep, or wake, before the next search. */
    int64_t all = count + touches->last.touches.count + touches->slept.touches.count;
    return kiriArrays_Reserve(sheet->memory, count, &touches->found, &touches->yields, &touches->rows) &&
           ReserveMemory(sheet, &touches->last, all) && ReserveMemory(sheet, &touches->slept, all) &&
           kiriArray_Reserve(sheet->memory, &touches->order, all) && kiriSolver_ReserveRows(sheet->solver, 0, 0, count);
}

bool kiriTouches_Reserve(kiriSheetData* sheet)
{
    int32_t bodies = 0;
    KIRI_EACH(const kiriYieldRow, row, sheet->touches.yields) {
        bodies += row->inverseMass > 0.0;
    }
    return sheet->touches.found.count == 0 ||
           (kiriTouches_Room(sheet, sheet->touches.found.capacity) &&
            kiriSolver_ReserveBodies(sheet->solver, bodies, sheet->solver->before.capacity));
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

enum { MOST_BLENDED = 96 }; /* largest count of frames that carry three vertices */

typedef struct TouchBlend {
    kiriContactMember weights[MOST_BLENDED]; /* `at`: sum of places by their weights */
    int32_t count;
} TouchBlend;

static void AddWeights(TouchBlend* blend, const kiriSkin* skin, int32_t sample, double share, kiriVec2 at)
{
    kiriSpan span = skin->spans.data[sample];
    KIRI_EACH_IN(k, span) {
        kiriSampleWeight weight = skin->weights.data[k];
        int32_t n = 0, frame = weight.frame;
        while (n < blend->count && blend->weights[n].frame != frame) {
            ++n;
        }
        if (n == blend->count && n < MOST_BLENDED) {
            blend->weights[blend->count++] = (kiriContactMember){ .frame = frame };
        }
        if (n < blend->count) {
            blend->weights[n].value += share * weight.value;
            blend->weights[n].at = kiriVec2_AddScaled(blend->weights[n].at, share * weight.value, at);
        }
    }
}

static TouchBlend BlendOf(const kiriSheetData* sheet, const kiriTouch* touch)
{
    TouchBlend blend;
    blend.count = 0;
    if (touch->point != KIRI_NONE) {
        kiriVec2 at = kiriMesh_Local(&sheet->mesh, sheet->points.data[touch->point].at);
        AddWeights(&blend, &sheet->pointSkin, touch->point, 1.0, at);
        return blend;
    }
    for (int n = 0; n < 3 && touch->vertex[n] != KIRI_NONE; ++n) {
        kiriVec2 corner = kiriMesh_Local(&sheet->mesh, sheet->mesh.vertices.data[touch->vertex[n]].at);
        AddWeights(&blend, &sheet->vertexSkin, touch->vertex[n], touch->share[n], corner);
    }
    return blend;
}

/* Writes the largest weights, at most `most`, and returns their number. If a cut separated the vertices, the piece with
   the largest weight gets the contact. */
static int32_t WriteWeights(const kiriSheetData* sheet, TouchBlend* blend, kiriContactMember* weights, int32_t most)
{
    const int32_t* piece = sheet->layout.framePiece.data;
    int32_t count = 0;
    double sum = 0.0;
    KIRI_TIMES_WHILE(count < most, n, blend->count) {
        int32_t best = n; /* the largest one that remains; among equal ones the lower frame */
        KIRI_FROM_TO(k, n + 1, blend->count) {
            const kiriContactMember *a = &blend->weights[k], *b = &blend->weights[best];
            best = a->value > b->value || (a->value == b->value && a->frame < b->frame) ? k : best;
        }
        kiriContactMember weight = blend->weights[best];
        blend->weights[best] = blend->weights[n];
        blend->weights[n] = weight;
        if (weight.value > 0.0 && (n == 0 || piece[weight.frame] == piece[weights[0].frame])) {
            weight.at = kiriVec2_Scale(1.0 / weight.value, weight.at);
            weights[count++] = weight;
            sum += weight.value;
        }
    }
    KIRI_ASSERT(count > 0);
    KIRI_TIMES(n, count) {
        weights[n].value /= sum;
    }
    return count;
}

int32_t kiriTouches_WeighPoint(const kiriSheetData* sheet, kiriLatticePoint at, kiriContactMember* weights)
{
    kiriTouch touch = { .point = KIRI_NONE };
    kiriPointPlace place;
    if (!kiriPoint_Find(sheet, at, &place)) {
        return 0;
    }
    memcpy(touch.vertex, sheet->mesh.triangles.data[place.triangle].vertex, sizeof(touch.vertex));
    memcpy(touch.share, place.shares, sizeof(touch.share));
    TouchBlend blend = BlendOf(sheet, &touch);
    return WriteWeights(sheet, &blend, weights, KIRI_STITCH_SIDE);
}

kiriVec3 kiriSheet_CarriedPoint(const kiriSheetData* sheet, const kiriContactMember* weights, int32_t count)
{
    kiriVec3 x = { 0 };
    KIRI_TIMES(n, count) {
        x = kiriVec3_AddScaled(x, weights[n].value, kiriFrame_Carry(&sheet->frames.data[weights[n].frame], weights[n].at));
    }
    return x;
}

static void WriteContactRow(const kiriSheetData* sheet, const kiriTouch* touch, double sampleMass, kiriContactRow* row)
{
    TouchBlend blend = BlendOf(sheet, touch);
    KIRI_CLEAR(row);
    row->key = touch->key;
    row->normal = touch->normal;
    row->velocity = touch->velocity;
    row->friction = touch->friction;
    row->pushSpeed = touch->pushSpeed;
    if (kiriTouch_IsOfKind(touch, KIRI_TOUCH_OBSTACLE)) {
        row->mass = sampleMass;
        row->reach = 0.5 * sheet->settings.contactThickness;
    }
    row->yield = touch->yield;
    row->place = touch->on;
    row->felt = touch->felt;
    row->force = kiriTouches_ForceOf(sheet, touch->key);
    row->weightCount = WriteWeights(sheet, &blend, row->weights, KIRI_CONTACT_MEMBERS);
    kiriVec3 at = kiriSheet_CarriedPoint(sheet, row->weights, row->weightCount);
    row->offset = touch->offset + kiriVec3_Dot(row->normal, kiriVec3_Sub(at, touch->seen));
}

#define PROBE_SHARE 0.25 /* of the mass of the frames that carry a probe: most that it represents */

/* Returns the mass that a probe represents, kg: of its block of grid squares, or less in a small piece. */
static double ProbeMass(const kiriSheetData* sheet, const kiriContactMember* weights, int32_t count)
{
    const kiriMaterial* material = &sheet->settings.material;
    double side = sheet->mesh.step * sheet->mesh.squares.side * sheet->probes.block, carried = 0.0;
    KIRI_TIMES(n, count) {
        carried += weights[n].value * sheet->frames.data[weights[n].frame].mass;
    }
    return kiriMin((double)material->density * material->thickness * side * side, PROBE_SHARE * carried);
}

bool kiriTouches_JoinRow(kiriSheetData* sheet, const kiriTouch* touch, double distance, kiriSheetData* other,
                         const int32_t vertex[3], const double share[3])
{
    kiriContactRow* row = &sheet->touches.rows.data[touch->row];
    kiriTouch place = { .point = KIRI_NONE };
    memcpy(place.vertex, vertex, sizeof(place.vertex));
    memcpy(place.share, share, sizeof(place.share));
    TouchBlend blend = BlendOf(other, &place);
    KIRI_ASSERT(touch->row >= 0 && touch->row < sheet->touches.rows.count);
    row->otherCount = WriteWeights(other, &blend, row->otherWeights, KIRI_CONTACT_SIDE);
    row->mass = kiriMin(ProbeMass(sheet, row->weights, row->weightCount),
                        ProbeMass(other, row->otherWeights, row->otherCount));
    const int32_t* pieces = sheet->layout.framePiece.data;
    row->isFold = sheet == other && pieces[row->weights[0].frame] == pieces[row->otherWeights[0].frame];
    row->reach = 0.5 * (row->isFold ? sheet->settings.foldThickness : distance);
    if (!kiriSheet_Moves(other, row->otherWeights[0].frame) || other->rest.asleep ||
        other->settings.mechanics.model != sheet->settings.mechanics.model) {
        return false;
    }
    blend = BlendOf(sheet, touch);
    row->weightCount = WriteWeights(sheet, &blend, row->weights, KIRI_CONTACT_SIDE);
    row->other = other->solver;
    row->velocity = kiriVec3_Make(0.0, 0.0, 0.0);
    /* The plane is at `distance` of the second point. Visible points differ from those that frames carry. */
    kiriVec3 from = kiriSheet_CarriedPoint(other, row->otherWeights, row->otherCount);
    kiriVec3 to = kiriSheet_CarriedPoint(sheet, row->weights, row->weightCount);
    kiriVec3 apart = kiriVec3_Sub(to, from);
    const kiriMat3* A = &other->frames.data[row->otherWeights[0].frame].A;
    row->offset = touch->offset + kiriVec3_Dot(row->normal, kiriVec3_Sub(apart, touch->seen));
    row->otherNormal = kiriMat3_MulTransposed(A, row->normal);
    row->place = kiriMat3_MulTransposed(A, apart);
    return true;
}

void kiriTouches_WriteRows(kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    KIRI_ASSERT(touches->rows.capacity >= touches->found.count);
    touches->rows.count = 0;
    double square = sheet->mesh.step * sheet->mesh.squares.side, mass = 0.0;
    KIRI_EACH_WHILE(touches->found.count > 0, const kiriFrameData, frame, sheet->frames) {
        mass += frame->mass;
    }
    /* A soft contact represents a vertex or a grid square, whichever is larger. */
    double least = (double)sheet->settings.material.density * sheet->settings.material.thickness * square * square;
    mass = kiriMax(mass / sheet->mesh.vertices.count, least);
    KIRI_EACH(kiriTouch, touch, touches->found) {
        kiriContactRow* row = &touches->rows.data[touches->rows.count];
        WriteContactRow(sheet, touch, mass, row);
        bool isAwake = kiriSheet_Moves(sheet, row->weights[0].frame);
        touch->row = isAwake ? touches->rows.count : KIRI_NONE;
        touches->rows.count += isAwake;
    }
}

/* ---- Stored forces ----------------------------------------------------------------------------------------------- */

const kiriTouchForce* kiriTouches_Find(const kiriSheetData* sheet, uint64_t key)
{
    const kiriTouchMemory* memories[] = { &sheet->touches.last, &sheet->touches.slept };
    KIRI_TIMES(n, 2) {
        int32_t at = kiriTouchMemory_FirstFrom(memories[n], key);
        if (at < memories[n]->forces.count && memories[n]->forces.data[at].key == key) {
            return &memories[n]->forces.data[at];
        }
    }
    return NULL;
}

kiriVec3 kiriTouches_ForceOf(const kiriSheetData* sheet, uint64_t key)
{
    const kiriTouchForce* found = kiriTouches_Find(sheet, key);
    return found != NULL ? found->force : kiriVec3_Make(0.0, 0.0, 0.0);
}

void kiriTouches_End(kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    const kiriVec3 none = { 0 };
    KIRI_ASSERT(touches->last.touches.capacity >= touches->found.count);
    touches->last.touches.count = touches->last.forces.count = touches->last.given = 0;
    KIRI_EACH(const kiriTouch, touch, touches->found) {
        if (touch->row != KIRI_NONE) {
            const kiriContactRow* row = &touches->rows.data[touch->row];
            kiriTouch kept = *touch;
            kept.normal = row->normal;
            kiriTouchMemory_Add(&touches->last, &kept, kiriVec3_Dot(row->force, row->normal) > 0.0 ? row->force : none);
        }
    }
    kiriTouchMemory_SortForces(&touches->last, 0, &touches->order);
}

void kiriTouches_Clear(kiriSheetData* sheet)
{
    sheet->touches.last.forces.count = sheet->touches.last.touches.count = sheet->touches.last.given = 0;
    sheet->touches.rows.count = 0;
    KIRI_EACH(kiriTouch, touch, sheet->touches.found) {
        touch->row = KIRI_NONE;
    }
}

/* ---- Sleep ------------------------------------------------------------------------------------------------------- */

/* Moves the touches of moved (areMoved), or of resting, pieces to the other memory. Drops touches of destroyed
   pieces. */
static void MoveTouches(kiriSheetData* sheet, kiriTouchMemory* from, kiriTouchMemory* to, bool areMoved)
{
    int32_t kept = 0, given = 0, before = to->touches.count;
    KIRI_EACH_INDEX(i, from->touches) {
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

/* Returns true if two touches are the same up to the motion of a calm sheet. Each tick finds its touches again at the
   visible position, so planes may differ by the distance that the sheet can drift meanwhile. */
static bool IsSame(const kiriSheetData* sheet, const kiriTouch* a, const kiriTouch* b)
{
    kiriVec3 tilt = kiriVec3_Sub(b->normal, a->normal), faster = kiriVec3_Sub(b->velocity, a->velocity);
    double rise = b->offset - a->offset - kiriVec3_Dot(tilt, b->seen);
    return a->key == b->key && a->friction == b->friction && kiriVec3_Length(tilt) <= CALM_SLOPE &&
           fabs(rise) <= KIRI_CALM_SECONDS * sheet->settings.sleepSpeed &&
           kiriVec3_Length(faster) <= sheet->settings.sleepSpeed;
}

/* Returns touch i of the concatenated lists: found, last tick, sleeping pieces. */
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

/* Lists the host's contacts of calm pieces, sorted by key; among equal keys the found ones come first. */
static void ListCalm(kiriSheetData* sheet)
{
    kiriTouches* touches = &sheet->touches;
    int32_t count = touches->found.count + touches->last.touches.count + touches->slept.touches.count;
    touches->order.count = 0;
    KIRI_TIMES(i, count) {
        const kiriTouch* touch = TouchAt(touches, i);
        if (kiriTouch_IsOfKind(touch, KIRI_TOUCH_HOST) && PieceOfTouch(sheet, touch)->rest.calm >= KIRI_CALM_SECONDS) {
            KIRI_NEXT(touches->order) = i;
        }
    }
    if (touches->order.count > 1) {
        kiriSort(touches->order.data, touches->order.count, HasLowerTouchKey, touches);
    }
}

/* Returns true if the found touches of one key match the stored ones, one by one in order. */
static bool AreSame(const kiriSheetData* sheet, const int32_t* order, int32_t count)
{
    const kiriTouches* touches = &sheet->touches;
    int32_t found = 0;
    while (found < count && order[found] < touches->found.count) {
        ++found;
    }
    bool same = 2 * found == count;
    KIRI_TIMES_WHILE(same, n, found) {
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

/* The key of a collision point contains its index. */
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
    KIRI_TIMES(n, 3) {
        touch->vertex[n] = kiriKeep_To(vertices, touch->vertex[n]);
        if (touch->vertex[n] == KIRI_NONE) {
            return false;
        }
    }
    return true;
}

/* ---- Results for the host ---------------------------------------------------------------------------------------- */

/* Writes the result of contact i of the host. These contacts are the first of the found touches. */
static void TellOne(const kiriSheetData* sheet, int32_t i, double dt, kiriContactForce* told)
{
    const kiriTouch* touch = &sheet->touches.found.data[i];
    const kiriContact* contact = &sheet->contacts.data[i].contact;
    kiriVec3 at = touch->seen, impulse = kiriVec3_Scale(dt, kiriTouches_ForceOf(sheet, touch->key));
    kiriVec3 way = kiriVec3_Make(0.0, 0.0, 0.0);
    if (touch->row != KIRI_NONE) {
        const kiriContactRow* row = &sheet->touches.rows.data[touch->row];
        kiriVec3 now = kiriSheet_CarriedPoint(sheet, row->weights, row->weightCount);
        /* The visible point is offset from the frames' blend by the same distance as the plane. */
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
    KIRI_EACH_INDEX(i, sheet->contacts) {
        TellOne(sheet, i, dt, &touches->nextTold.data[i]);
    }
    kiriArray_Swap(&touches->told, &touches->nextTold);
    sheet->contacts.count = 0;
}
