#include "kiri_pair.h"
#include "../core/kiri_array.h"
#include "../motion/kiri_frame.h"
#include "../sheet/kiri_touch.h"
#include "../core/kiri_archive.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_update.h"
#include "../sheet/kiri_motion.h"

#define PUSH_SPEED 0.5       /* m/s: limit of the speed at which surfaces that are too close separate, */
#define FOLD_PUSH_SPEED 0.05 /* and of the same piece: a fold that is in its own way must not gain energy */

static bool TakesPart(const kiriSheetData* sheet)
{
    return sheet->settings.touchesSheets && !sheet->settings.mechanics.planar;
}

/* Returns the piece of a body, or null if it no longer exists. */
static kiriPiece* PieceOfBody(const kiriWorld* world, kiriFrame id)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, id);
    return slot != NULL ? kiriSheet_PieceOf(slot->owner, slot->index) : NULL;
}

/* Returns the distance that two bodies, or the layers of one, keep, m. */
static double KeptDistance(const kiriBody* a, const kiriBody* b)
{
    return a == b ? a->sheet->settings.foldThickness
                  : 0.5 * (a->sheet->settings.contactThickness + b->sheet->settings.contactThickness);
}

/* ---- Contacts ---- */

/* Adds a contact to the sheet of the upper place. Its plane is fixed unless kiriIslands_Prepare joins it to the lower
   place. */
static bool AddPlaneTouch(kiriPairTouch* pair)
{
    kiriSheetData* sheet = pair->upper.sheet;
    const kiriSettings *a = &sheet->settings, *b = &pair->lower.sheet->settings;
    const kiriPlace3* lower = &pair->lower;
    kiriVec3 under = kiriSurface_Blend(&lower->sheet->seen.surface, lower->vertex, lower->share);
    kiriTouch touch;
    KIRI_CLEAR(&touch);
    touch.key = pair->key;
    touch.point = touch.yield = KIRI_NONE;
    touch.normal = pair->normal;
    touch.offset = kiriVec3_Dot(pair->normal, under) + pair->distance;
    touch.velocity = pair->velocity;
    touch.friction = sqrt(a->friction * b->friction);
    touch.pushSpeed = pair->isFold ? FOLD_PUSH_SPEED : PUSH_SPEED;
    touch.felt = -1.0;
    memcpy(touch.vertex, pair->upper.vertex, sizeof(touch.vertex));
    memcpy(touch.share, pair->upper.share, sizeof(touch.share));
    pair->touch = sheet->touches.found.count;
    return kiriTouches_Add(sheet, &touch);
}

bool kiriPairs_AddTouches(kiriWorld* world)
{
    bool ok = true;
    KIRI_EACH_WHILE(ok, kiriPairTouch, touch, world->pairs.touches) {
        ok = !kiriSheet_IsActive(touch->upper.sheet) || AddPlaneTouch(touch);
    }
    /* Room for kiriPairs_JoinCalm: pieces as they are now, or as a ready update will make them. */
    int64_t count = 0;
    KIRI_EACH_ACTIVE(sheet, world) {
        bool isReady = sheet->update->stage == KIRI_READY && sheet->update->cut.meshChanged;
        int32_t now = sheet->layout.pieces.count, next = isReady ? sheet->update->next.pieces.count : 0;
        count += kiriMax(next, now);
    }
    return ok && kiriArrays_Reserve(&world->memory, count, &world->pairs.parents, &world->pairs.calms);
}

#define MARGIN 0.5 /* of the distance that pieces keep: a gap up to this may close in the tick */
#define SAME_SIDE 0.5 /* minimum cosine between the normals of a contact in two ticks */
#define ALIKE 0.9  /* minimum cosine between normals of planes that are alike */
#define NEARER 0.5 /* of that distance: a surface must be nearer by this to replace one that pushed */
#define CLOSE 0.1  /* of the distance that pieces keep: a gap up to this counts as touching */

static kiriPlace3 VertexPlace(kiriSheetData* sheet, int32_t vertex)
{
    return (kiriPlace3){ sheet, { vertex, KIRI_NONE, KIRI_NONE }, { 1.0, 0.0, 0.0 } };
}

static kiriPlace3 TrianglePlace(kiriSheetData* sheet, int32_t triangle, const double share[3])
{
    kiriPlace3 place = { sheet, { KIRI_NONE, KIRI_NONE, KIRI_NONE }, { share[0], share[1], share[2] } };
    memcpy(place.vertex, kiriSurface_Triangle(&sheet->seen.surface, triangle), sizeof(place.vertex));
    return place;
}

static kiriVec3 PlaceVelocity(const kiriPlace3* place)
{
    kiriVec3 velocity = { 0 };
    for (int k = 0; k < 3 && place->vertex[k] != KIRI_NONE; ++k) {
        velocity = kiriVec3_AddScaled(velocity, place->share[k], kiriProbe_Velocity(place->sheet, place->vertex[k]));
    }
    return velocity;
}

/* Returns the key of a touch: of two pieces, a probe of the first, and whether the other is in front of it; or of an edge of
   the first and a triangle of the other. */
static uint64_t KeyOfTouch(uint64_t a, uint64_t b, uint64_t c, uint64_t d)
{
    const uint64_t words[4] = { a, b, c, d }, kind = UINT64_C(3) << 60;
    uint64_t hash = KIRI_HASH_START;
    KIRI_TIMES(k, 4) {
        kiriHash_Word(&hash, words[k]);
    }
    return kind | hash >> 4;
}

/* Inside of one of two bodies its border is enough: of the one with the larger squares. */
static bool AreAllNeeded(const kiriBody* a, const kiriBody* b)
{
    double size = a->sheet->mesh.step * a->sheet->mesh.squares.side;
    double other = b->sheet->mesh.step * b->sheet->mesh.squares.side;
    return size < other || (size == other && a <= b);
}

/* Returns the largest approach of the two in the tick, m. Either may be stopped by something behind it. */
static double Approach(const kiriWorld* world, const kiriPairTouch* touch, double dt)
{
    double falls = -kiriVec3_Dot(touch->normal, PlaceVelocity(&touch->upper));
    double rises = kiriVec3_Dot(touch->normal, touch->velocity);
    double speed = touch->isFold ? kiriMax(falls + rises, 0.0) : kiriMax(falls, 0.0) + kiriMax(rises, 0.0);
    return dt * (speed + dt * kiriVec3_Length(world->gravity));
}

/* Adds a touch to a slot of its probe: in front or behind. If there are several surfaces behind each other, the nearest one
   counts. */
static bool AddTouch(kiriWorld* world, int32_t* slot, const kiriPairTouch* touch)
{
    kiriPairs* pairs = &world->pairs;
    if (*slot == KIRI_NONE || kiriVec3_Dot(pairs->touches.data[*slot].normal, touch->normal) < ALIKE) {
        *slot = pairs->touches.count;
        return kiriArray_Push(&world->memory, &pairs->touches, *touch);
    }
    if (touch->rank < pairs->touches.data[*slot].rank) {
        pairs->touches.data[*slot] = *touch;
    }
    return true;
}

#define SEWN_REACH 4.0    /* of the distance that pieces keep: beside a seam, lips that near do not push each other, */
#define SEWN_SPACING 0.25 /* and of the distance of frames: the skins of lips differ from what stitches hold */

static kiriVec2 RestOfPlace(const kiriPlace3* place)
{
    kiriVec2 at = { 0.0, 0.0 };
    for (int k = 0; k < 3 && place->vertex[k] != KIRI_NONE; ++k) {
        const kiriMeshData* mesh = &place->sheet->mesh;
        at = kiriVec2_AddScaled(at, place->share[k], kiriMesh_LocalOf(mesh, place->vertex[k]));
    }
    return at;
}

/* Returns true if one seam passes near both places. */
static bool AreSewn(const kiriPlace3* a, const kiriPlace3* b, double thickness)
{
    bool areSewn = false;
    kiriVec2 at = RestOfPlace(a), other = RestOfPlace(b);
    kiriSeam last = 0;
    KIRI_EACH_WHILE(!areSewn, const kiriSewnLine, line, a->sheet->sewn) {
        if (line->seam != last) {
            double spacing = kiriMax(kiriSheet_Spacing(a->sheet), kiriSheet_Spacing(b->sheet));
            double reach = kiriMax(SEWN_REACH * thickness, SEWN_SPACING * spacing);
            last = line->seam;
            areSewn = kiriSewn_IsNear(a->sheet, last, at, reach) && kiriSewn_IsNear(b->sheet, last, other, reach);
        }
    }
    return areSewn;
}

/* Completes a touch. Returns the gap that the tick may leave, m; HUGE_VAL: a seam joins the places. */
static double CompleteTouch(const kiriWorld* world, kiriPairTouch* touch, double thickness, double dt)
{
    touch->velocity = PlaceVelocity(&touch->lower);
    touch->touch = KIRI_NONE;
    double above = touch->gap - Approach(world, touch, dt);
    if (above < (1.0 + MARGIN) * touch->distance) {
        if (AreSewn(&touch->upper, &touch->lower, thickness)) {
            return HUGE_VAL;
        }
        /* So surfaces at nearly the same distance do not alternate. */
        const kiriTouchForce* last = kiriTouches_Find(touch->upper.sheet, touch->key);
        touch->rank = touch->gap - (last != NULL ? NEARER * touch->distance : 0.0);
        if (last != NULL && kiriVec3_Dot(last->normal, touch->normal) > SAME_SIDE) {
            touch->normal = kiriVec3_Normalize(kiriVec3_Add(last->normal, touch->normal));
        }
    }
    return above;
}

/* ---- Calm ---- */

/* Numbers the pieces that are awake. */
static void ListAwake(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    pairs->calms.count = 0;
    KIRI_EACH_INDEX(k, world->active) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        KIRI_EACH(kiriPiece, piece, sheet->layout.pieces) {
            piece->awake = KIRI_NONE;
            if (kiriPiece_IsAwake(piece)) {
                piece->awake = pairs->calms.count;
                KIRI_NEXT(pairs->calms) = HUGE_VAL;
            }
        }
    }
    pairs->parents.count = pairs->calms.count;
    kiriUnion_Init(pairs->parents.data, pairs->parents.count);
}

void kiriPairs_JoinCalm(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    ListAwake(world);
    KIRI_EACH(const kiriTouchingPair, pair, pairs->pairs) {
        const kiriPiece *one = PieceOfBody(world, pair->ids[0]), *other = PieceOfBody(world, pair->ids[1]);
        if (pair->touches && one != NULL && other != NULL && one != other && kiriPiece_IsAwake(one) &&
            kiriPiece_IsAwake(other)) {
            kiriUnion_Join(pairs->parents.data, one->awake, other->awake);
        }
    }
    KIRI_EACH_OF(kiriSeamData, seam, world->seams) {
        KIRI_EACH(const kiriStitchData, stitch, seam->stitches) {
            const kiriPiece* one = PieceOfBody(world, stitch->frames[0]);
            const kiriPiece* other = PieceOfBody(world, stitch->frames[1]);
            KIRI_ASSERT(one != NULL && other != NULL);
            if (kiriPiece_IsAwake(one) && kiriPiece_IsAwake(other)) {
                kiriUnion_Join(pairs->parents.data, one->awake, other->awake);
            }
        }
    }
    KIRI_TIMES(isGiven, 2) {
        KIRI_EACH_INDEX(k, world->active) {
            kiriSheetData* sheet = kiriWorld_Active(world, k);
            KIRI_EACH(kiriPiece, piece, sheet->layout.pieces) {
                if (kiriPiece_IsAwake(piece)) {
                    double* calm = &pairs->calms.data[kiriUnion_Root(pairs->parents.data, piece->awake)];
                    *calm = kiriMin(piece->rest.calm, *calm);
                    piece->rest.calm = isGiven ? *calm : piece->rest.calm;
                }
            }
        }
    }
}

/* ---- Bodies ---- */

static void SumFrames(kiriPairs* pairs, const kiriSheetData* sheet, int32_t firstBody)
{
    KIRI_EACH_INDEX(i, sheet->frames) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        kiriBody* body = &pairs->bodies.data[firstBody + sheet->layout.framePiece.data[i]];
        body->mass += frame->mass;
        body->momentum = kiriVec3_AddScaled(body->momentum, frame->mass, frame->velocity);
    }
}

/* Measures the speed of the fastest probe of each body relative to its mean velocity. */
static void MeasureStir(kiriPairs* pairs, const kiriSheetData* sheet, int32_t firstBody)
{
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        kiriBody* body = &pairs->bodies.data[firstBody + p];
        kiriSpan span = kiriPieceRow_Of(&sheet->probes.list, p);
        double most = 0.0;
        KIRI_EACH_IN(i, span) {
            kiriVec3 beside = kiriVec3_AddScaled(sheet->probes.velocities.data[i], -1.0 / body->mass, body->momentum);
            double squared = kiriVec3_Dot(beside, beside);
            most = kiriMax(squared, most);
        }
        body->stir = sqrt(most);
    }
}

/* Begins the limits of the detail layer in this tick, unless they have begun. */
static bool BeginRooms(kiriSheetData* sheet)
{
    kiriProbes* probes = &sheet->probes;
    KIRI_ASSERT(probes->isFresh);
    bool begins = probes->rooms.count == 0;
    bool ok = !begins || kiriArrays_Resize(sheet->memory, probes->vertexPiece.count, &probes->marks, &probes->rooms);
    KIRI_EACH_INDEX_WHILE(ok && begins, v, probes->rooms) {
        probes->marks.data[v] = probes->isChosen.data[v] ? 1 : UINT8_MAX;
        probes->rooms.data[v] = HUGE_VALF;
    }
    return ok;
}

static bool ListBodiesOf(kiriWorld* world, kiriSheetData* sheet)
{
    kiriPairs* pairs = &world->pairs;
    int32_t first = pairs->bodies.count, count = sheet->layout.pieces.count;
    bool hasDetail = !sheet->rest.asleep && sheet->seen.surface.detail.sweeps > 0;
    if ((hasDetail && !BeginRooms(sheet)) || !kiriArray_Resize(&world->memory, &pairs->bodies, (int64_t)first + count)) {
        return false;
    }
    KIRI_TIMES(p, count) {
        const kiriPiece* piece = &sheet->layout.pieces.data[p];
        pairs->bodies.data[first + p] = (kiriBody){ .sheet = sheet, .piece = p, .id = sheet->frames.data[piece->frame].id,
                                                    .box = sheet->probes.boxes.data[p],
                                                    .speed = sheet->probes.speeds.data[p],
                                                    .asleep = !kiriPiece_IsAwake(piece),
                                                    .folds = kiriPiece_Folds(sheet, p) };
    }
    KIRI_EACH_LISTED(v, sheet->probes.list.items) {
        sheet->probes.touch.data[2 * v] = sheet->probes.touch.data[2 * v + 1] = KIRI_NONE;
    }
    SumFrames(pairs, sheet, first);
    MeasureStir(pairs, sheet, first);
    return true;
}

/* Everything that is awake: its box, and the largest speed and thickness. */
typedef struct Waking {
    kiriBox box;
    double speed, thickness;
    bool any;
} Waking;

static double FastestOf(const kiriSheetData* sheet)
{
    double fastest = 0.0;
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        fastest = kiriMax(sheet->probes.speeds.data[p], fastest);
    }
    return fastest;
}

static void AddWaking(Waking* waking, const kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        const kiriBox* box = &sheet->probes.boxes.data[p];
        if (kiriPiece_IsAwake(&sheet->layout.pieces.data[p])) {
            waking->box = waking->any ? waking->box : *box;
            kiriBox_Add(&waking->box, box->lower);
            kiriBox_Add(&waking->box, box->upper);
            waking->any = true;
        }
    }
    waking->speed = kiriMax(FastestOf(sheet), waking->speed);
    waking->thickness = kiriMax(sheet->settings.contactThickness, waking->thickness);
}

/* Finds everything that is awake. Fails on out of memory. */
static bool FindWaking(kiriWorld* world, Waking* waking)
{
    bool ok = true;
    KIRI_EACH_INDEX_WHILE(ok, k, world->active) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        if (TakesPart(sheet) && !sheet->rest.asleep) {
            ok = kiriProbes_Update(sheet);
            if (ok) {
                AddWaking(waking, sheet);
            }
        }
    }
    return ok;
}

/* Returns true if there are at least two bodies. The probes of a single body that does not fold are not kept up to
   date. */
static bool AreSeveral(const kiriWorld* world)
{
    kiriSheetData* last = NULL;
    int32_t count = 0;
    KIRI_EACH_OF_WHILE(count < 2, kiriSheetData, sheet, world->sheets) {
        count += TakesPart(sheet) ? sheet->layout.pieces.count : 0;
        last = TakesPart(sheet) ? sheet : last;
    }
    if (count == 1) {
        last->probes.isFresh &= last->probes.folds;
    }
    return count > 1;
}

static kiriBox Widened(const kiriBox* box, double by)
{
    kiriVec3 all = kiriVec3_Make(by, by, by);
    return (kiriBox){ kiriVec3_Sub(box->lower, all), kiriVec3_Add(box->upper, all) };
}

/* Returns true if something awake may come near the sheet in the tick. Farther sheets that sleep do not become bodies.
   */
static bool IsNearWaking(const kiriWorld* world, const Waking* waking, const kiriSheetData* sheet, double dt)
{
    kiriBox box = kiriSheet_Box(sheet);
    double speed = waking->speed + FastestOf(sheet) + dt * kiriVec3_Length(world->gravity);
    double reach = waking->thickness + sheet->settings.contactThickness + dt * speed;
    box = Widened(&box, reach);
    return kiriBox_Meet(&box, &waking->box);
}

static bool ListBodies(kiriWorld* world, const Waking* waking, double dt)
{
    bool ok = true;
    KIRI_EACH_OF_WHILE(ok, kiriSheetData, sheet, world->sheets) {
        if (!TakesPart(sheet)) {
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

/* Returns the distance within which pieces are near: their largest approach in the tick, by the velocities of their
   probes and by gravity, plus twice the distance that they keep. Pieces of one sheet that fall side by side do not
   approach each other, unless an obstacle stops one. */
static double ReachOfPiece(const kiriWorld* world, const kiriBody* a, const kiriBody* b, double dt)
{
    double speed = a->speed + b->speed, falling = dt * kiriVec3_Length(world->gravity);
    if (a->sheet == b->sheet && world->obstacles.count == 0) {
        kiriVec3 apart = kiriVec3_Scale(1.0 / a->mass, a->momentum);
        apart = kiriVec3_AddScaled(apart, -1.0 / b->mass, b->momentum);
        speed = kiriVec3_Length(apart) + a->stir + b->stir;
    }
    return 2.0 * KeptDistance(a, b) + dt * (speed + falling);
}

#define STEEP 0.5           /* minimum ratio of the offset along the surface to the offset across it, beside a border */
#define FLAT_TRIANGLE 0.25  /* of the distance that pieces keep: maximum height of a probe beside a lip, */
#define INSIDE_TRIANGLE 0.5 /* and maximum distance of its place from the border */

/* Returns the distance of the place from the border, m: from border edges of its triangle, and from corners at which
   other triangles have border edges. HUGE_VAL if there are none. */
static double WayToBorder(const kiriSheetData* sheet, const kiriNear* near)
{
    const kiriTriangle* t = &sheet->mesh.triangles.data[near->triangle];
    double least = HUGE_VAL;
    kiriVec3 x[3];
    kiriSurface_Corners(&sheet->seen.surface, near->triangle, x);
    KIRI_TIMES(k, 3) {
        kiriVec3 edge = kiriVec3_Sub(x[(k + 1) % 3], x[k]), to = kiriVec3_Sub(x[(k + 2) % 3], x[k]);
        double area = kiriVec3_Length(kiriVec3_Cross(edge, to));
        double way = near->share[(k + 2) % 3] * area / kiriVec3_Length(edge);
        bool isBorder = t->twin[k] == KIRI_NONE || (t->marks >> k & 1) != 0;
        least = isBorder && way < least ? way : least;
        kiriVec3 in = kiriVec3_AddScaled(kiriVec3_Scale(near->share[(k + 1) % 3], edge), near->share[(k + 2) % 3], to);
        double off = kiriVec3_Length(in);
        least = sheet->probes.isBorder.data[t->vertex[k]] && off < least ? off : least;
    }
    return least;
}

static kiriVec3 FromPlace(const kiriNear* near, const kiriBody* bodies)
{
    const kiriSurface* surface = &bodies[near->other].sheet->seen.surface;
    kiriVec3 under = kiriSurface_Blend(surface, kiriSurface_Triangle(surface, near->triangle), near->share);
    return kiriVec3_Sub(kiriSurface_At(&bodies[near->body].sheet->seen.surface, near->vertex), under);
}

/* Sets the normal at the place, and the height of the probe. Between pieces the normal is continuous over edges, where
   rounding chooses the triangle. In folds that would add energy. */
static void SetNormal(kiriNear* near, const kiriBody* bodies)
{
    kiriSheetData* sheet = bodies[near->other].sheet;
    kiriVec3 x[3];
    kiriSurface_Corners(&sheet->seen.surface, near->triangle, x);
    near->normal = near->body != near->other
                       ? kiriTriangle_SkinNormal(sheet, near->triangle, near->share)
                       : kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(x[1], x[0]), kiriVec3_Sub(x[2], x[0])));
    near->height = kiriVec3_Dot(near->normal, FromPlace(near, bodies));
}

/* Sets the nearest place on one triangle, if it lies within `most`; on a body that folds with its normal. Returns the square
   of its distance, m^2. */
static double Measure(kiriNear* near, const kiriBody* bodies, int32_t triangle, double most)
{
    kiriNear one = *near;
    kiriVec3 x[3];
    one.triangle = triangle;
    kiriSurface_Corners(&bodies[near->other].sheet->seen.surface, triangle, x);
    kiriTriangle_Nearest(x, kiriSurface_At(&bodies[near->body].sheet->seen.surface, near->vertex), one.share);
    kiriVec3 off = FromPlace(&one, bodies);
    double squared = kiriVec3_Dot(off, off);
    if (squared <= most) {
        *near = one;
        if (bodies[near->other].folds) {
            SetNormal(near, bodies);
        }
    }
    return squared;
}

/* Returns true if the probe lies beside the other body, not on it. Lips of a fresh cut lie in one plane, and may
   overlap slightly when they move. */
static bool IsBeside(const kiriNear* near, const kiriBody* bodies, double distance, double squared)
{
    const kiriSheetData* sheet = bodies[near->other].sheet;
    double across = near->height * near->height, way = WayToBorder(sheet, near);
    bool isLip = bodies[near->body].sheet->probes.isBorder.data[near->vertex];
    return (way <= 0.0 && squared - across >= STEEP * STEEP * across) ||
           (isLip && way < INSIDE_TRIANGLE * distance && fabs(near->height) < FLAT_TRIANGLE * distance);
}

static uint64_t NameOf(kiriFrame a, kiriFrame b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

#define MOST_SHARED 0.5  /* of the weights, on frames that carry both places: if more are shared, places move together */
#define OPEN 0.5         /* of their distance at rest: places farther apart are beside each other, */
#define PASSING 0.125    /* and partly so from this much less on */

/* Returns the distance of a probe and a place of the same piece at rest, m. */
static double DistanceAtRest(const kiriSheetData* sheet, const kiriNear* near)
{
    const kiriSurface* surface = &sheet->seen.surface;
    const int32_t* corners = kiriSurface_Triangle(surface, near->triangle);
    kiriVec2 apart = kiriVec2_Scale(-1.0, surface->rest.data[near->vertex]);
    KIRI_TIMES(c, 3) {
        apart = kiriVec2_AddScaled(apart, near->share[c], surface->rest.data[corners[c]]);
    }
    return kiriVec2_Length(apart);
}

/* Returns the distance that a probe and a place of the same piece keep, m: less where they are near each other at rest,
   or the same frames carry them. Zero if places at this distance are beside each other. */
static double FoldDistance(const kiriSheetData* sheet, const kiriNear* near, double rest, double off)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    const int32_t* corners = kiriSurface_Triangle(&sheet->seen.surface, near->triangle);
    kiriSpan own = skin->spans.data[near->vertex];
    double shared = 0.0;
    if (off >= OPEN * rest) {
        return 0.0;
    }
    KIRI_EACH_IN(k, own) {
        double there = 0.0;
        KIRI_TIMES(c, 3) {
            kiriSpan other = skin->spans.data[corners[c]];
            KIRI_EACH_IN(n, other) {
                const kiriSampleWeight* weight = &skin->weights.data[n];
                there += weight->frame == skin->weights.data[k].frame ? near->share[c] * weight->value : 0.0;
            }
        }
        shared += kiriMin(skin->weights.data[k].value, there);
    }
    double most = kiriMin(sheet->settings.foldThickness, 0.5 * OPEN * rest);
    return most * kiriClamp(2.0 * (1.0 - shared / MOST_SHARED), 0.0, 1.0);
}

/* A search for places near a probe of a body. A fold searches its own body. */
typedef struct Search {
    kiriWorld* world;
    const kiriBody *body, *other;
    kiriVec3 ahead;     /* normal at the probe */
    kiriNear found[2];  /* nearest to the probe; of layers: in front, and behind */
    double least[2];    /* m^2: of their distance */
    double gap;         /* m^2: of the distance to another layer, whichever frames carry it */
    kiriNear layer;     /* nearest place of another layer */
} Search;

/* Keeps the nearest place. At equal distances the lowest triangle counts. */
static double LookAtPlace(void* context, int32_t triangle)
{
    Search* search = context;
    kiriNear one = search->found[0];
    bool isFold = search->body == search->other;
    const int32_t* v = kiriSurface_Triangle(&search->other->sheet->seen.surface, triangle);
    double most = kiriMax(kiriMax(search->least[0], search->least[1]), search->gap);
    if (isFold && (v[0] == one.vertex || v[1] == one.vertex || v[2] == one.vertex)) {
        return most;
    }
    double squared = Measure(&one, search->world->pairs.bodies.data, triangle, most);
    double across = one.height * one.height, rest = 0.0;
    int side = search->other->folds && !(one.height * kiriVec3_Dot(one.normal, search->ahead) < 0.0);
    bool isFirst = squared == search->least[side] && triangle < search->found[side].triangle;
    if (squared <= most) {
        rest = isFold ? DistanceAtRest(search->body->sheet, &one) : HUGE_VAL;
        double behind = (OPEN - sqrt(squared) / rest) / PASSING;
        double gap = behind >= 1.0 ? squared : behind > 0.0 ? squared / (behind * behind) : HUGE_VAL;
        if (gap < search->gap || (gap == search->gap && triangle < search->layer.triangle)) {
            search->gap = gap;
            search->layer = one;
        }
    }
    if (squared < search->least[side] || isFirst) {
        bool isEdge = one.share[0] <= 0.0 || one.share[1] <= 0.0 || one.share[2] <= 0.0;
        double aslant = isEdge && squared > across ? sqrt((squared - across) / across) / STEEP : 0.0;
        if (search->other->folds) { /* less beside the border, and where a neighbor is nearer */
            double kept = isFold ? FoldDistance(search->body->sheet, &one, rest, sqrt(squared))
                                 : KeptDistance(search->body, search->other);
            one.kept = isFold ? kept * kiriMax(1.0 - aslant, 0.0) : aslant < 1.0 ? kept : 0.0;
        }
        if (one.kept > 0.0) {
            search->least[side] = squared;
            search->found[side] = one;
        }
    }
    return kiriMax(kiriMax(search->least[0], search->least[1]), search->gap);
}

#define ROOM_KEPT 0.5    /* of the distance that layers keep: offsets end before */
#define ROOM_STEP 0.25   /* of the distance that layers keep: an offset gets longer by that in a tick, */
#define ROOM_GROWTH 1.25 /* and by this factor */

/* Returns the longest offset of a probe in the detail layer after the tick, m, if a layer begins to be near. */
static double WidestRoom(const kiriSheetData* sheet, int32_t vertex, double kept)
{
    const kiriDetail* detail = &sheet->seen.surface.detail;
    kiriVec3 offset = { 0.0, 0.0, 0.0 };
    if (detail->sweeps > 0) {
        KIRI_ASSERT(3 * vertex < detail->offsets.count);
        offset = kiriVec3_Load(detail->offsets.data + 3 * vertex);
    }
    return ROOM_STEP * kept + ROOM_GROWTH * kiriVec3_Length(offset);
}

/* Limits the offset to half of the gap to another layer, as it will be after the tick. */
static void LimitRoom(const Search* search, int32_t vertex, double widest, double kept, double dt)
{
    kiriSheetData* sheet = search->body->sheet;
    float* limit = &sheet->probes.rooms.data[vertex];
    double room = widest;
    KIRI_ASSERT_HAS(sheet->probes.rooms, vertex);
    if (search->layer.triangle != KIRI_NONE) {
        kiriPlace3 place = TrianglePlace(search->other->sheet, search->layer.triangle, search->layer.share);
        kiriVec3 under = kiriSurface_Blend(&place.sheet->seen.surface, place.vertex, place.share);
        kiriVec3 off = kiriVec3_Sub(kiriSurface_At(&sheet->seen.surface, vertex), under);
        kiriVec3 speed = kiriVec3_Sub(PlaceVelocity(&place), kiriProbe_Velocity(sheet, vertex));
        double closing = dt * kiriMax(kiriVec3_Dot(speed, kiriVec3_Normalize(off)), 0.0);
        double left = sqrt(search->gap) - closing - ROOM_KEPT * kept;
        room = kiriClamp(0.5 * left, 0.0, widest);
    }
    *limit = kiriMin(*limit, (float)room);
    sheet->probes.limits = true;
}

/* Gives vertices that are not probes the least room of their neighbors. From here on marks are rounds of that. */
static void SpreadRooms(kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    uint8_t* marks = sheet->probes.marks.data;
    float* rooms = sheet->probes.rooms.data;
    bool isSpread = sheet->probes.limits && surface->detail.sweeps > 0;
    KIRI_ASSERT(!isSpread || sheet->probes.rooms.count == surface->vertexCount);
    for (uint8_t round = 1; isSpread && round < UINT8_MAX; ++round) {
        isSpread = false;
        KIRI_TIMES(h, 3 * surface->triangleCount) {
            int32_t from = surface->indices.data[h];
            KIRI_TIMES_WHILE(marks[from] == round, k, 3) {
                int32_t to = surface->indices.data[h / 3 * 3 + k];
                if (marks[to] > round) {
                    rooms[to] = kiriMin(rooms[from], rooms[to]);
                    marks[to] = (uint8_t)(round + 1);
                    isSpread = true;
                }
            }
        }
    }
}

/* Finds the places of another body that are nearest to probes of a body, within `reach`; of the same body, in front and
   behind. Places on the border keep no distance if the probe lies beside the other body. Bounds must be up to date. Fails on out
   of memory. */
static bool FindNears(kiriWorld* world, int32_t body, int32_t other, double reach, double dt)
{
    kiriPairs* pairs = &world->pairs;
    const kiriBody *bodies = pairs->bodies.data, *a = &bodies[body], *b = &bodies[other];
    kiriProbes* probes = &a->sheet->probes;
    kiriSpan span = kiriPieceRow_Of(&probes->list, a->piece);
    kiriGroup piece = { b->sheet->probes.vertexPiece.data, b->piece };
    kiriBox box = Widened(&b->box, reach);
    kiriVec3 mean = kiriVec3_Scale(1.0 / a->mass, a->momentum);
    bool isFold = a == b, areAll = AreAllNeeded(a, b), ok = true;
    bool limits = isFold || (!a->asleep && a->sheet->seen.surface.detail.sweeps > 0);
    double kept = KeptDistance(a, b);
    Search search = { .world = world, .body = a, .other = b };
    KIRI_ASSERT(a->mass > 0.0 && probes->velocities.count == probes->list.items.count);
    KIRI_FROM_TO_WHILE(ok, i, span.first, span.first + span.count) {
        kiriNear none = { .body = body, .other = other, .vertex = probes->list.items.data[i], .triangle = KIRI_NONE };
        kiriVec3 x = kiriSurface_At(&a->sheet->seen.surface, none.vertex);
        bool isNeeded = areAll || probes->isBorder.data[none.vertex];
        if (!kiriBox_Meet(&box, &(kiriBox){ x, x }) || !(isNeeded || limits)) {
            continue;
        }
        double own = isFold ? reach + dt * kiriVec3_Distance(probes->velocities.data[i], mean) : reach;
        none.kept = kept;
        search.found[0] = search.found[1] = none;
        search.least[0] = own * own;
        search.least[1] = b->folds ? own * own : 0.0;
        double widest = limits ? WidestRoom(a->sheet, none.vertex, kept) : 0.0;
        double wide = limits ? 2.0 * widest + ROOM_KEPT * kept : 0.0;
        search.gap = wide * wide;
        search.layer = none;
        if (b->folds) {
            search.ahead = kiriVertex_SkinNormal(a->sheet, none.vertex);
        }
        kiriBounds_Nearest(b->sheet->seen.bounds, &b->sheet->seen.surface, piece, &(kiriBox){ x, x },
                           kiriMax(own * own, search.gap), LookAtPlace, &search);
        if (isFold || search.layer.triangle != KIRI_NONE) {
            LimitRoom(&search, none.vertex, widest, kept, dt);
        }
        KIRI_TIMES_WHILE(ok && isNeeded, k, 2) {
            kiriNear* near = &search.found[k];
            if (near->triangle != KIRI_NONE && !b->folds) {
                SetNormal(near, bodies);
            }
            if (near->triangle != KIRI_NONE) {
                near->kept = isFold || !IsBeside(near, bodies, kept, search.least[k]) ? near->kept : 0.0;
                ok = kiriArray_Push(&world->memory, &pairs->nears, *near);
            }
        }
    }
    return ok;
}

/* ---- Sides ---- */

#define FLAT 0.1  /* of the distance that they keep: nearer than that motion says which side it is */
#define ALONG 0.3 /* minimum cosine between surfaces that lie on each other */
#define SURE 4.0  /* of the distance that they keep: a probe farther away is on its own side, whichever the pair has */

/* Returns the side of the normals of the body with the higher id on which the other one lies. It changes if places lie on
   the other side by the distance that they keep, in the mean. 0: a body that folds has no side. */
static int32_t SideOfPair(const kiriPairs* pairs, const kiriBody* one, const kiriBody* other, kiriSpan nears, double dt)
{
    int32_t at;
    uint64_t name = NameOf(one->id, other->id);
    KIRI_SEARCH(at, 0, pairs->pairs.count,
                NameOf(pairs->pairs.data[middle].ids[0], pairs->pairs.data[middle].ids[1]) < name);
    const kiriTouchingPair* old = pairs->pairs.data + at;
    bool isOld = at < pairs->pairs.count && NameOf(old->ids[0], old->ids[1]) == name;
    const kiriBody* of = one->id > other->id ? one : other;
    double sum = isOld ? KeptDistance(one, other) * old->side * nears.count : 0.0;
    KIRI_EACH_IN(i, nears) {
        const kiriNear* near = &pairs->nears.data[i];
        bool isOf = &pairs->bodies.data[near->body] == of;
        double along = isOf ? -kiriVec3_Dot(near->normal, kiriVertex_SkinNormal(of->sheet, near->vertex)) : 1.0;
        sum += along * near->height;
        if (fabs(near->height) < FLAT * KeptDistance(one, other)) { /* at the same height: how it changes in the tick */
            kiriPlace3 place = TrianglePlace(pairs->bodies.data[near->other].sheet, near->triangle, near->share);
            kiriVec3 v = PlaceVelocity(&place);
            v = kiriVec3_Sub(kiriProbe_Velocity(pairs->bodies.data[near->body].sheet, near->vertex), v);
            sum += along * dt * kiriVec3_Dot(near->normal, v);
        }
    }
    return one->folds || other->folds ? 0 : sum >= 0.0 ? 1 : -1;
}

/* ---- Pairs ---- */

/* Updates the bounds and, unless both are unchanged, groups their nodes by pieces. Fails on out of memory. */
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
    return ok && kiriBounds_FitSides(bounds, sheet->memory, surface);
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
    kiriSurface_NeedNormals(&one->sheet->seen.surface);
    kiriSurface_NeedNormals(&other->sheet->seen.surface);
    if (!UpdateBounds(one->sheet) || !UpdateBounds(other->sheet) || !FindNears(world, a, b, reach, dt) ||
        !FindNears(world, b, a, reach, dt)) {
        return false;
    }
    nears.count = pairs->nears.count - nears.first;
    kiriTouchingPair pair = { { one->id, other->id }, SideOfPair(pairs, one, other, nears, dt), 0, nears };
    return nears.count == 0 || kiriArray_Push(&world->memory, &pairs->found, pair);
}

static bool IsFarther(const void* context, int32_t a, int32_t b)
{
    const kiriBody* bodies = context;
    double left = bodies[a].box.lower.x, right = bodies[b].box.lower.x;
    return left < right || (left == right && a < b);
}

/* Searches all pairs of bodies, sorted by the lower x of their boxes. Bodies that begin beyond the end of a box are not
   near it. */
static bool LookAtAll(kiriWorld* world, double dt)
{
    kiriPairs* pairs = &world->pairs;
    double fastest = 0.0, thickest = 0.0;
    KIRI_EACH(const kiriBody, body, pairs->bodies) {
        fastest = kiriMax(body->speed, fastest);
        thickest = kiriMax(KeptDistance(body, body), thickest);
    }
    double reach = 2.0 * thickest + dt * (2.0 * fastest + dt * kiriVec3_Length(world->gravity));
    bool ok = kiriSort_Order(&world->memory, &pairs->order, pairs->bodies.count, IsFarther, pairs->bodies.data);
    KIRI_EACH_INDEX_WHILE(ok, i, pairs->order) {
        int32_t a = pairs->order.data[i];
        double end = pairs->bodies.data[a].box.upper.x + reach;
        KIRI_FROM_TO(k, i + 1, pairs->order.count) {
            int32_t b = pairs->order.data[k];
            if (!ok || pairs->bodies.data[b].box.lower.x > end) {
                break;
            }
            ok = LookAtPair(world, kiriMin(a, b), kiriMax(b, a), dt);
        }
    }
    return ok;
}

/* ---- Touches ----

   A probe touches the nearest place of a piece. Pieces that do not fold stay on one side of each other, so that lips of a
   cut, which begin in one plane, part. Where a piece folds, a probe touches the nearest place in front of it and the nearest
   one behind it, and stays on the side of both on which it is. An edge that crosses a triangle is moved so that the line in
   which the surfaces cross gets shorter (Volino, Magnenat-Thalmann, Resolving surface collisions through intersection
   contour minimization, 2006). */

#define GRAZING 0.2      /* minimum sine of the angle between an edge and a triangle that it crosses */
#define LEAST_TURN 0.2     /* change of the length of the line per length of a move: less gives no direction */

/* Returns the negated change of the length of the line of crossing with a move of the edge. The line begins in the edge
   and goes into its triangles. `normal`: of the triangle that is crossed. */
static kiriVec3 ShortenLine(const kiriSheetData* sheet, int32_t edge, kiriVec3 at, kiriVec3 along, kiriVec3 normal)
{
    double slope = kiriVec3_Dot(normal, along);
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    KIRI_ASSERT(edge >= 0 && edge < 3 * sheet->mesh.triangles.count);
    slope = slope >= 0.0 ? kiriMax(slope, GRAZING) : kiriMin(slope, -GRAZING);
    KIRI_TIMES(n, 2) {
        int32_t h = n == 0 ? edge : kiriMesh_IsOpen(&sheet->mesh, edge) ? KIRI_NONE : kiriMesh_Twin(&sheet->mesh, edge);
        if (h != KIRI_NONE) {
            int32_t apex = kiriMesh_TriangleOf(&sheet->mesh, h)->vertex[(h % 3 + 2) % 3];
            kiriVec3 in = kiriVec3_Sub(kiriSurface_At(&sheet->seen.surface, apex), at);
            in = kiriVec3_AddScaled(in, -kiriVec3_Dot(in, along), along);
            kiriVec3 line = kiriVec3_Normalize(kiriVec3_Cross(normal, kiriVec3_Cross(along, in)));
            line = kiriVec3_Scale(kiriVec3_Dot(line, in) < 0.0 ? -1.0 : 1.0, line);
            sum = kiriVec3_Add(sum, kiriVec3_AddScaled(line, -kiriVec3_Dot(along, line) / slope, normal));
        }
    }
    return sum;
}

/* The sheet of the upper place has the row. If it sleeps, the places change. */
static void TurnToAwake(const kiriBody* body, const kiriBody* other, kiriPairTouch* touch)
{
    if (body->asleep && !other->asleep) {
        kiriPlace3 upper = touch->lower;
        touch->lower = touch->upper;
        touch->upper = upper;
        touch->normal = kiriVec3_Scale(-1.0, touch->normal);
    }
}

/* A search for triangles that an edge at a probe crosses. */
typedef struct Tangle {
    kiriWorld* world;
    const kiriBody *body, *other;
    kiriSpan nears;     /* of the two */
    int32_t edge, a, b; /* half-edge and its ends */
    int32_t first;      /* index of the first touch of the two */
    bool ok;
} Tangle;

/* A vertex on the wrong side keeps no distance, if it is a probe. */
static void FreeProbe(Tangle* tangle, int32_t vertex)
{
    const kiriPairs* pairs = &tangle->world->pairs;
    int32_t body = (int32_t)(tangle->body - pairs->bodies.data), end = tangle->nears.first + tangle->nears.count, at;
    const kiriNear* nears = pairs->nears.data;
    KIRI_SEARCH(at, tangle->nears.first, end,
                nears[middle].body < body || (nears[middle].body == body && nears[middle].vertex < vertex));
    for (; at < end && nears[at].body == body && nears[at].vertex == vertex; ++at) {
        pairs->nears.data[at].kept = 0.0;
    }
}

/* Adds a touch of the edge and a triangle if they cross. */
static double LookAtCrossing(void* context, int32_t triangle)
{
    Tangle* tangle = context;
    kiriSheetData *sheet = tangle->body->sheet, *under = tangle->other->sheet;
    const kiriSurface* surface = &sheet->seen.surface;
    bool isFold = tangle->body == tangle->other;
    const int32_t* c = kiriSurface_Triangle(&under->seen.surface, triangle);
    KIRI_TIMES(k, 3) {
        if (isFold && (c[k] == tangle->a || c[k] == tangle->b)) {
            return 0.0;
        }
    }
    kiriVec3 p = kiriSurface_At(surface, tangle->a), along = kiriVec3_Sub(kiriSurface_At(surface, tangle->b), p), corner[3];
    kiriNear near = { .triangle = triangle };
    double part, kept = KeptDistance(tangle->body, tangle->other);
    kiriSurface_Corners(&under->seen.surface, triangle, corner);
    if (!kiriTriangle_Cross(corner, p, along, &part, near.share) || !(part > 0.0 && part <= 1.0)) {
        return 0.0;
    }
    kiriPairTouch touch = { .upper = { sheet, { tangle->a, tangle->b, KIRI_NONE }, { 1.0 - part, part, 0.0 } },
                            .isFold = true, .touch = KIRI_NONE };
    kiriVec3 at = kiriVec3_AddScaled(p, part, along);
    along = kiriVec3_Normalize(along);
    kiriVec3 normal = kiriVec3_Cross(kiriVec3_Sub(corner[1], corner[0]), kiriVec3_Sub(corner[2], corner[0]));
    kiriVec3 unit = kiriVec3_Normalize(normal), out = ShortenLine(sheet, tangle->edge, at, along, unit);
    bool areLips = !isFold && fabs(kiriVec3_Dot(along, unit)) < GRAZING; /* beside each other in one plane */
    touch.lower = TrianglePlace(under, triangle, near.share);
    if (areLips || AreSewn(&touch.upper, &touch.lower, kept)) {
        return 0.0;
    }
    bool goesUp = kiriVec3_Dot(out, normal) > 0.0, isBelow = kiriVec3_Dot(along, normal) > 0.0;
    FreeProbe(tangle, goesUp == isBelow ? tangle->a : tangle->b);
    near.vertex = part < 0.5 ? tangle->a : tangle->b;
    touch.key = KeyOfTouch(tangle->body->id, tangle->other->id, NameOf((uint32_t)tangle->a, (uint32_t)tangle->b),
                           2 + (uint64_t)triangle);
    touch.normal = kiriVec3_Normalize(out);
    touch.distance = isFold ? FoldDistance(sheet, &near, DistanceAtRest(sheet, &near), 0.0) : kept;
    if (touch.distance > 0.0 && kiriVec3_Length(out) > LEAST_TURN) {
        TurnToAwake(tangle->body, tangle->other, &touch);
        touch.velocity = PlaceVelocity(&touch.lower);
        kiriPairs* pairs = &tangle->world->pairs;
        tangle->ok = tangle->ok && kiriArray_Push(&tangle->world->memory, &pairs->touches, touch);
        /* Sorted by key, since a load builds other trees, which visit triangles in another order. */
        kiriPairTouch* touches = pairs->touches.data;
        for (int32_t i = pairs->touches.count - 1; tangle->ok && i > tangle->first && touches[i - 1].key > touch.key; --i) {
            touches[i] = touches[i - 1];
            touches[i - 1] = touch;
        }
    }
    return 0.0;
}

/* Looks at the edges of a triangle, each once. */
static double LookAtEdges(void* context, int32_t triangle)
{
    Tangle* tangle = context;
    kiriSheetData *sheet = tangle->body->sheet, *under = tangle->other->sheet;
    kiriGroup group = { under->probes.vertexPiece.data, tangle->other->piece };
    KIRI_TIMES_WHILE(tangle->ok, k, 3) {
        int32_t edge = 3 * triangle + k, twin = kiriMesh_Twin(&sheet->mesh, edge);
        if (kiriMesh_IsOpen(&sheet->mesh, edge) || twin < edge) {
            tangle->edge = edge;
            tangle->a = kiriMesh_Tail(&sheet->mesh, edge);
            tangle->b = kiriMesh_Head(&sheet->mesh, edge);
            kiriVec3 p = kiriSurface_At(&sheet->seen.surface, tangle->a), q = kiriSurface_At(&sheet->seen.surface, tangle->b);
            kiriBox box = { kiriVec3_Least(p, q), kiriVec3_Most(p, q) };
            double most = 1e-12 * kiriVec3_Distance(p, q) * kiriVec3_Distance(p, q); /* rounding */
            kiriBounds_Nearest(under->seen.bounds, &under->seen.surface, group, &box, most, LookAtCrossing, tangle);
        }
    }
    return 0.0;
}

/* Adds touches of edges of a body that cross another one, or another layer. */
static bool TouchTangles(kiriWorld* world, int32_t a, int32_t b, kiriSpan nears)
{
    const kiriBody *body = &world->pairs.bodies.data[a], *other = &world->pairs.bodies.data[b];
    Tangle tangle = { .world = world, .body = body, .other = other, .nears = nears, .ok = true };
    tangle.first = world->pairs.touches.count;
    kiriGroup group = { body->sheet->probes.vertexPiece.data, body->piece };
    kiriBounds_Nearest(body->sheet->seen.bounds, &body->sheet->seen.surface, group, &other->box, 0.0, LookAtEdges, &tangle);
    return tangle.ok;
}

/* Adds touches of probes and the places near them. Probes on the wrong side, and lips of a seam, have none. `touches`
   becomes 1 if there are some that push. */
static bool TouchNears(kiriWorld* world, kiriSpan nears, double dt, int32_t sideOfPair, int32_t* touches)
{
    kiriPairs* pairs = &world->pairs;
    int32_t first = pairs->touches.count;
    int32_t a = pairs->nears.data[nears.first].body, b = pairs->nears.data[nears.first].other;
    bool ok = TouchTangles(world, a, b, nears) && (a == b || TouchTangles(world, b, a, nears));
    *touches = pairs->touches.count > first;
    KIRI_FROM_TO_WHILE(ok, i, nears.first, nears.first + nears.count) {
        const kiriNear* near = &pairs->nears.data[i];
        const kiriBody *body = &pairs->bodies.data[near->body], *other = &pairs->bodies.data[near->other];
        bool isFold = body == other;
        KIRI_ASSERT(near->triangle != KIRI_NONE);
        double ahead = kiriVec3_Dot(near->normal, kiriVertex_SkinNormal(body->sheet, near->vertex));
        double belongs = fabs(near->height) < SURE * near->kept ? sideOfPair * (body->id > other->id ? -ahead : 1.0) : 0.0;
        double side = (fabs(belongs) < ALONG ? near->height : belongs) >= 0.0 ? 1.0 : -1.0;
        bool isAhead = side * ahead < 0.0;
        kiriPairTouch touch = { .upper = VertexPlace(body->sheet, near->vertex), .isFold = isFold,
                                .gap = side * near->height, .distance = near->kept };
        touch.lower = TrianglePlace(other->sheet, near->triangle, near->share);
        touch.key = KeyOfTouch(body->id, other->id, (uint64_t)near->vertex, isAhead);
        touch.normal = kiriVec3_Scale(side, near->normal);
        TurnToAwake(body, other, &touch);
        double above = near->kept > 0.0 ? CompleteTouch(world, &touch, KeptDistance(body, other), dt) : HUGE_VAL;
        if (above < (1.0 + MARGIN) * touch.distance) {
            int32_t none = KIRI_NONE, *slot = &body->sheet->probes.touch.data[2 * near->vertex + isAhead];
            ok = AddTouch(world, isFold ? &none : slot, &touch);
        }
        *touches |= above < (1.0 + CLOSE) * touch.distance;
    }
    return ok;
}

static bool TouchPairs(kiriWorld* world, double dt)
{
    bool ok = true;
    world->pairs.touches.count = 0;
    KIRI_EACH_WHILE(ok, kiriTouchingPair, pair, world->pairs.next) {
        ok = pair->nears.count == 0 || TouchNears(world, pair->nears, dt, pair->side, &pair->touches);
    }
    return ok;
}

/* Prepares a sheet with a piece that folds. If no piece folds, probes become stale. */
static bool BeginFolds(kiriSheetData* sheet)
{
    bool folded = sheet->probes.folds;
    sheet->probes.folds =
        sheet->settings.selfContact && !sheet->settings.mechanics.planar && kiriPieces_AnyFolds(sheet);
    sheet->probes.isFresh &= folded || TakesPart(sheet);
    if (!sheet->probes.folds) {
        return true;
    }
    if (!kiriProbes_Update(sheet) || !UpdateBounds(sheet) || !BeginRooms(sheet)) {
        return false;
    }
    KIRI_ASSERT(sheet->probes.marks.count == sheet->seen.surface.vertexCount);
    kiriSurface_NeedNormals(&sheet->seen.surface);
    return true;
}

static bool TouchFolds(kiriWorld* world, double dt)
{
    bool ok = true;
    KIRI_EACH_INDEX_WHILE(ok, k, world->active) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        if (!sheet->rest.asleep) {
            int32_t body = world->pairs.bodies.count;
            ok = BeginFolds(sheet) && (!sheet->probes.folds || ListBodiesOf(world, sheet));
            KIRI_TIMES_WHILE(ok && sheet->probes.folds, p, sheet->layout.pieces.count) {
                const kiriBody* at = &world->pairs.bodies.data[body + p];
                double falling = dt * kiriVec3_Length(world->gravity);
                double reach = 2.0 * sheet->settings.foldThickness + dt * kiriMax(falling, at->stir);
                kiriSpan nears = { world->pairs.nears.count, 0 };
                if (at->folds && !at->asleep) {
                    int32_t touches;
                    ok = FindNears(world, body + p, body + p, reach, dt);
                    nears.count = world->pairs.nears.count - nears.first;
                    ok = ok && (nears.count == 0 || TouchNears(world, nears, dt, 0, &touches));
                }
            }
        }
        SpreadRooms(sheet);
    }
    return ok;
}

static bool IsPairAsleep(const kiriWorld* world, kiriFrame id)
{
    const kiriPiece* piece = PieceOfBody(world, id);
    return piece != NULL && piece->rest.asleep;
}

/* Keeps sleeping pairs without a search. */
static bool KeepSleeping(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    bool ok = true;
    KIRI_EACH_WHILE(ok, kiriTouchingPair, pair, pairs->pairs) {
        pair->nears.count = 0;
        ok = !IsPairAsleep(world, pair->ids[0]) || !IsPairAsleep(world, pair->ids[1]) ||
             kiriArray_Push(&world->memory, &pairs->found, *pair);
    }
    return ok;
}

static bool IsBefore(const void* context, int32_t a, int32_t b)
{
    const kiriTouchingPair* pairs = context;
    return NameOf(pairs[a].ids[0], pairs[a].ids[1]) < NameOf(pairs[b].ids[0], pairs[b].ids[1]);
}

static bool SortFound(kiriWorld* world)
{
    kiriPairs* pairs = &world->pairs;
    if (!kiriSort_Order(&world->memory, &pairs->order, pairs->found.count, IsBefore, pairs->found.data) ||
        !kiriArray_Resize(&world->memory, &pairs->next, pairs->found.count)) {
        return false;
    }
    KIRI_EACH_INDEX(i, pairs->found) {
        pairs->next.data[i] = pairs->found.data[pairs->order.data[i]];
    }
    return true;
}

bool kiriPairs_Find(kiriWorld* world, double dt)
{
    kiriPairs* pairs = &world->pairs;
    Waking waking = { .any = false };
    pairs->nears.count = pairs->found.count = pairs->next.count = pairs->bodies.count = 0;
    KIRI_EACH_INDEX(k, world->active) {
        kiriProbes* probes = &kiriWorld_Active(world, k)->probes;
        probes->rooms.count = probes->marks.count = 0;
        probes->limits = false;
    }
    return (!AreSeveral(world) || FindWaking(world, &waking)) &&
           (!waking.any || (ListBodies(world, &waking, dt) && LookAtAll(world, dt))) && KeepSleeping(world) &&
           SortFound(world) && TouchPairs(world, dt) && TouchFolds(world, dt);
}

/* ---- Sleep ---- */

static bool SleepsOn(const kiriWorld* world, kiriFrame id)
{
    return IsPairAsleep(world, id) && !PieceOfBody(world, id)->rest.isStirred;
}

static bool StirTouching(const kiriWorld* world, const kiriTouchingPairs* pairs)
{
    bool any = false;
    KIRI_EACH(const kiriTouchingPair, pair, *pairs) {
        bool isAsleep = SleepsOn(world, pair->ids[0]);
        if (pair->touches && isAsleep != SleepsOn(world, pair->ids[1])) {
            const kiriSlot* slot = kiriPool_Find(&world->frameIds, pair->ids[!isAsleep]);
            kiriSheetData* sheet = slot->owner;
            kiriSheet_PieceOf(sheet, slot->index)->rest.isStirred = sheet->rest.isStirred = any = true;
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
    KIRI_EACH(const kiriTouchingPair, pair, world->pairs.pairs) {
        bool isNear = false;
        KIRI_EACH_IN(i, pair->nears) {
            isNear |= world->pairs.nears.data[i].kept > 0.0;
        }
        count += isNear;
    }
    return count;
}
